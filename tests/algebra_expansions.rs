//! The expansions of the thesis's second chapter, and altered ones that must fail.
#![cfg(feature = "engine")]

use claimcheck::formula::{
    Budget, Formula, Proposition, Regime, Relation, Statement, parse_proposition,
};
use claimcheck::prover::{ExpansionVerdict, Reason, judge_expansion};

fn judge(text: &str) -> Result<ExpansionVerdict, Reason> {
    let proposition = parse_proposition(text).expect(text);
    let (left, relation, right, regime) = parts(&proposition);
    let budget = Budget::new(200_000_000);
    let verdict = judge_expansion(&left, relation, &right, &regime, &proposition, &budget);
    println!("{text}\n    {verdict:?} after {} steps\n", budget.spent());
    verdict
}

fn parts(proposition: &Proposition) -> (Formula, Relation, Formula, Regime) {
    match &proposition.statement {
        Statement::Chain {
            first,
            links,
            regime,
        } => {
            let (relation, right) = links.first().expect("a link").clone();
            (
                first.clone(),
                relation,
                right,
                regime.clone().expect("a regime"),
            )
        }
        other => panic!("no expansion: {other:?}"),
    }
}

/// Terms beyond the print, where it holds.
fn holds(text: &str) -> String {
    match judge(text) {
        Ok(ExpansionVerdict::Holds { further, .. }) => further.unwrap_or_default(),
        other => panic!("{text}: {other:?}"),
    }
}

/// The first wrong term and the path, where it fails.
fn fails(text: &str) -> (String, Option<String>) {
    match judge(text) {
        Ok(ExpansionVerdict::Fails { term, path, .. }) => (term, path),
        other => panic!("{text}: {other:?}"),
    }
}

fn vacuous(text: &str) {
    match judge(text) {
        Ok(ExpansionVerdict::Vacuous { .. }) => {}
        other => panic!("{text}: {other:?}"),
    }
}

const PHOTONS: &str = "given int k, n with 1 <= k <= n; real I > 0\ndraw r ~ beta(k, n-k+1)\n";
const ONE_A_SHELL: &str =
    "given int k, n with 1 <= k <= n; real I > 0\ndraw r ~ uniform((k-1)/n, k/n)\n";
const SHELL: &str =
    "given int k, l, m with 1 <= l <= m and l < k; real v > 0, I > 0\ndraw x ~ beta(l, m-l+1)\n";

fn photons(says: &str) -> String {
    canonical(PHOTONS, says)
}

fn one_a_shell(says: &str) -> String {
    canonical(ONE_A_SHELL, says)
}

fn shell(says: &str) -> String {
    canonical(SHELL, says)
}

/// The scope in the canonical form, one declaration a line.
fn canonical(scope: &str, says: &str) -> String {
    format!("{scope}says {says}")
}

#[test]
fn without_shells_the_mean_is_i_k_over_k_minus_1() {
    // 2.11
    let further = holds(&photons(
        "mean(I*k/(n*r)) == I + I/k + I/k^2 + O(1/k^3) as k -> inf uniformly in n",
    ));
    assert_eq!(
        further,
        "I + I/k + I/k^2 + I/k^3 + I/k^4 + I/k^5 + I/k^6 + O(1/k^7)"
    );
    let (term, _) = fails(&photons(
        "mean(I*k/(n*r)) == I + I/k + O(1/k^3) as k -> inf uniformly in n",
    ));
    assert_eq!(term, "I/k^2");
    let (term, _) = fails(&photons(
        "I*k*gamma(k-1)/gamma(k) == I + 2*I/k + O(1/k^2) as k -> inf uniformly in n",
    ));
    assert_eq!(term, "-I/k");
    holds(&photons(
        "mean(I*k/(n*r)) == I + O(1/k) as k -> inf uniformly in n",
    ));
    // 2.40
    holds(&photons("I*k/(k-1) =~ I + I/k as k -> inf uniformly in n"));
    fails(&photons(
        "I*k/(k-1) =~ I + 2*I/k as k -> inf uniformly in n",
    ));
}

#[test]
fn a_limit_that_the_domain_forbids_is_vacuous() {
    vacuous(&photons(
        "mean(I*k/(n*r)) == I + I/k + O(1/k^2) as k -> inf",
    ));
    vacuous(
        "given int k, l, m with 1 <= l <= m and m*(m-1)/2 < k <= m*(m+1)/2\nsays k/(k-l) == 1 + O(1/k) as k -> inf",
    );
}

#[test]
fn the_variance_without_shells_under_joint_limits() {
    // 2.16
    let (_, path) = fails(&photons(
        "var(I*k/(n*r)) == I^2/k - I^2/n + O(1/(n*k)) as n, k -> inf",
    ));
    assert!(path.is_some());
    fails(&photons(
        "var(I*k/(n*r)) == I^2/k - I^2/n + O(1/(n*k)) as n, k, n/k -> inf",
    ));
    holds(&photons(
        "var(I*k/(n*r)) == I^2/k - I^2/n + O(1/(n*k)) + O(1/k^2) as n, k -> inf",
    ));
    holds(&photons("I^2/k - I^2/n ~ I^2/k as n, k, n/k -> inf"));
    fails(&photons("I^2/k - I^2/n ~ I^2/k as n, k -> inf"));
    // 2.43
    holds(&photons("var(I*k/(n*r)) ~ I^2/k as n, k, n/k -> inf"));
    fails(&photons("var(I*k/(n*r)) ~ 2*I^2/k as n, k, n/k -> inf"));
    fails(&photons("var(I*k/(n*r)) ~ I^2/k as n, k -> inf"));
    // 2.72
    let (term, _) = fails(&photons("var(I*k/(n*r)) =~ I^2/k as n -> inf"));
    assert!(term.contains("I^2"), "{term}");
    // 2.93
    let (_, path) = fails(&photons(
        "var(I*k/(n*r)) =~ I^2/k as k -> inf uniformly in n",
    ));
    assert_eq!(path.as_deref(), Some("n = k"));
    holds(&photons(
        "var(I*k/(n*r)) == O(1/k) as k -> inf uniformly in n",
    ));
}

#[test]
fn one_photon_a_shell() {
    // 2.20, 2.48, 2.77, 2.97
    let further = holds(&one_a_shell(
        "mean(I*k/(n*r)) == I + I/(2*k) + I/(3*k^2) + O((1/k)^3) as k -> inf uniformly in n",
    ));
    assert!(
        further.starts_with("I + I/(2*k) + I/(3*k^2) + I/(4*k^3) + I/(5*k^4)"),
        "{further}"
    );
    let (term, _) = fails(&one_a_shell(
        "mean(I*k/(n*r)) == I + I/(2*k) + I/(4*k^2) + O((1/k)^3) as k -> inf uniformly in n",
    ));
    assert_eq!(term, "I/(12*k^2)");
    holds(&one_a_shell(
        "int(2*I*k/r, r = sqrt((k-1)/n)..sqrt(k/n)) == I + I/(2*k) + I/(3*k^2) + O(1/k^3) as k -> inf uniformly in n",
    ));
    holds(&one_a_shell(
        "int(3*I*k/r, r = ((k-1)/n)^(1/3)..(k/n)^(1/3)) == I + I/(2*k) + I/(3*k^2) + O(1/k^3) as k -> inf uniformly in n",
    ));
    holds(&one_a_shell(
        "I*k*(ln(k) - ln(k-1)) == I + I/(2*k) + I/(3*k^2) + O(1/k^3) as k -> inf uniformly in n",
    ));
    // 2.24, 2.50, 2.79, 2.99
    let further = holds(&one_a_shell(
        "var(I*k/(n*r)) == I^2/(12*k^2) + O((1/k)^3) as k -> inf uniformly in n",
    ));
    assert!(
        further.starts_with("I^2/(12*k^2) + I^2/(6*k^3) + 43*I^2/(180*k^4)")
            || further.starts_with("I^2/(12*k^2) + "),
        "{further}"
    );
    fails(&one_a_shell(
        "var(I*k/(n*r)) == I^2/(12*k^2) + O(1/k^4) as k -> inf uniformly in n",
    ));
    holds(&one_a_shell(
        "I^2*k*(1/(k-1) - k*ln((k-1)/k)^2) == I^2/(12*k^2) + O(1/k^3) as k -> inf uniformly in n",
    ));
    holds(&one_a_shell(
        "I^2*k^2/(k+k^2) - I^2*k^2*(-ln(k/n) + ln((1+k)/n))^2 == I^2/(12*k^2) + O(1/k^3) as k -> inf uniformly in n",
    ));
    holds(&one_a_shell(
        "I^2*k/(k-1) - I^2*k^2*(ln(k/n) - ln((k-1)/n))^2 == I^2/(12*k^2) + O(1/k^3) as k -> inf uniformly in n",
    ));
    fails(&one_a_shell(
        "I^2*k/(k-1) - I^2*k^2*(ln(k/n) - ln((k-1)/n))^2 == I^2/(6*k^2) + O(1/k^3) as k -> inf uniformly in n",
    ));
}

#[test]
fn several_photons_a_shell() {
    // 2.103
    let mean =
        "I + I*(l - l*v/(m+1))/k + I*(-(2*l^2)*v/(m+1) + l^2 + l*(l+1)*v^2/((m+1)*(m+2)))/k^2";
    let further = holds(&shell(&format!(
        "mean(I*k/(k - l + v*x)) == {mean} + O((1/k)^3) as k -> inf"
    )));
    assert!(
        further.contains("/k^5)") || further.contains("*k^5)"),
        "{further}"
    );
    holds(&shell(&format!(
        "I*k*hyp2f1(1, l; m+1; -v/(k-l))/(k-l) == {mean} + O((1/k)^3) as k -> inf"
    )));
    fails(&shell(&format!(
        "mean(I*k/(k - l + v*x)) == {mean} + O((1/k)^4) as k -> inf"
    )));
    let (term, _) = fails(&shell(
        "mean(I*k/(k - l + v*x)) == I + I*(l - l*v/(m+2))/k + O(1/k^2) as k -> inf",
    ));
    assert!(term.ends_with("*k)"), "{term}");
    // 2.105
    let first = "I^2*l*v^2*(-l + m + 1)/(k^2*(m+1)^2*(m+2))";
    let second = "4*(I^2*l*v^2*(l - m - 1)*(l*(m - v + 3) - v))/(k^3*((m+1)^2*(m+2)*(m+3)))";
    let further = holds(&shell(&format!(
        "var(I*k/(k - l + v*x)) == {first} - {second} + O((1/k)^4) as k -> inf"
    )));
    assert!(further.contains("O(1/k^8)"), "{further}");
    fails(&shell(&format!(
        "var(I*k/(k - l + v*x)) == {first} + {second} + O((1/k)^4) as k -> inf"
    )));
    fails(&shell(&format!(
        "var(I*k/(k - l + v*x)) == {first} - {second} + O((1/k)^5) as k -> inf"
    )));
}
