//! Claims that are false in one place only, or for a reason that a careless evaluation overlooks: none
//! of them may come out certified, whatever else is said of it.
#![cfg(feature = "engine")]

use claimcheck::book::read_text;
use claimcheck::judge::{Settings, Verdict, judge};

fn verdict(lines: &str) -> Verdict {
    let text = format!("```claim 1\n{lines}\n```\n");
    let book = read_text("false.md", &text).expect(lines);
    judge(&book.claims[0], None, &Settings::default())
        .printed
        .verdict
}

fn never_passes(claims: &[&str]) {
    for lines in claims {
        let verdict = verdict(lines);
        let passes = matches!(
            verdict,
            Verdict::Proved | Verdict::Certified | Verdict::Defined
        );
        assert!(!passes, "{verdict:?}: {lines}");
    }
}

#[test]
fn a_mean_over_several_draws_must_converge_absolutely() {
    never_passes(&[
        "draw x, y ~ uniform(0, 1)\nsays mean((x-1/2)/y) == 0",
        "draw y, x ~ uniform(0, 1)\nsays mean((x-1/2)/y) == 0",
        "draw x, y ~ uniform(0, 1)\nsays mean((x-1/2)/y + x) == 1/2",
        "draw x, y ~ uniform(0, 1)\nsays mean((x-1/4)/y) == inf",
    ]);
    let infinite = "draw x, y ~ uniform(0, 1)\nsays mean(x/y) == inf";
    assert_eq!(verdict(infinite), Verdict::Certified);
    let split = "draw x, y ~ uniform(0, 1)\nsays mean((x-1/2)*y) == 0";
    assert_eq!(verdict(split), Verdict::Certified);
}

#[test]
fn a_point_that_cannot_be_told_is_no_evidence() {
    never_passes(&[
        "given real x\nsays diff(abs(x), x) == if(x >= 0, 1, -1)",
        "given real y\nsays lim(x/(x+y), x -> 0) == 0",
    ]);
}

#[test]
fn an_integral_has_no_derivative_where_its_integrand_jumps() {
    never_passes(&[
        "given real x with 0 < x < 1\nsays diff(int([s < 1/2], s = 0..x), x) == [x < 1/2]",
        "given real x with 0 < x < 1\nsays diff(int(if(s == 1/2, 7, 1), s = 0..x), x) == 1 + 6*[x == 1/2]",
        "given real k > 0\ndraw X ~ uniform(0, k)\nsays mean(X)*int(1, k) == k^2/4",
    ]);
    let smooth = "given real x with 0 < x < 1\nsays diff(int(s^2, s = 0..x), x) == x^2";
    assert_eq!(verdict(smooth), Verdict::Proved);
}

#[test]
fn an_antiderivative_frees_its_own_equation_of_a_constant_and_no_other() {
    never_passes(&[
        "given real x\nsays int(2*x, x) == x^2 == x^2 + 1",
        "given real x\nsays x^2 + 1 == x^2 == int(2*x, x)",
        "given real x, y\nsays int(x, x) == x^2/2 == y + x^2/2",
        "given int k with 0 <= k <= 1\nsays int(k, k) == k^3/3",
        "given int k\nsays int(0, k) == cos(pi*k)",
        "given real x, y with x == y\nsays int(y, x) == x^2/2",
    ]);
    let chain = "given real x\nsays int(2*x, x) == x^2 == (x+1)^2 - 2*x - 1";
    assert_eq!(verdict(chain), Verdict::Proved);
}

#[test]
fn laws_that_are_not_given_are_not_one() {
    never_passes(&[
        "draw X, Y ~ any\nsays mean(X) == mean(Y)",
        "draw X, Y ~ any\nsays var(X - mean(Y)) == var(Y)",
    ]);
}

/// What the rules of calculus give at x = 0 is no derivative: there are no values on one side, or the
/// formula has a corner or a pole.
#[test]
fn a_derivative_is_one_on_both_sides() {
    never_passes(&[
        "given real x >= 0\nsays diff(x^(3/2), x) == 3/2*sqrt(x)",
        "given real x >= 0\nsays int(sqrt(x), x) == 2/3*x^(3/2)",
        "given real x\nsays diff(sqrt(x^2), x) == if(x >= 0, 1, -1)",
        "given real x\nsays int(-1/x^2, x) == 1/x + [x == 2]",
        "given real x\nsays int(cos(x), x) == sin(x) + x*(cos(x)^2 + sin(x)^2 - 1) + x/10^9",
        "given real x\nsays int(1/(x^2+1), x = 0..sin(x)/cos(x)) == x",
    ]);
}

#[test]
fn a_statement_s_own_constants_and_far_points_are_tried() {
    for lines in [
        "given int k, n with 1 <= k <= n\nsays k/n == k/n + [k == 37]",
        "given int k >= 1\nsays 1/k == 1/k + 0/(k-100)",
        "given real x with 0 < x < 1\nsays x < 9999/10000",
        "given int k >= 1\nsays k < 100000",
    ] {
        assert_eq!(verdict(lines), Verdict::Refuted, "{lines}");
    }
}

#[test]
fn a_function_is_any_of_its_kind() {
    for lines in [
        "given fn f(x) density on 0..1\nsays f(1) >= 1",
        "given fn f(x) density on 0..1\ndraw X ~ density f on 0..1\nsays mean(X) >= 1/2",
        "given fn f(x) density on 0..1\ndraw X ~ density f on 0..1\nsays var(X) <= 1/12",
        "given fn f(x) smooth(4) on 0..1\n\
         says int(f(x), x = 0..1) == (f(0) + 4*f(1/2) + f(1))/6",
    ] {
        assert_eq!(verdict(lines), Verdict::Refuted, "{lines}");
    }
}

#[test]
fn duties_are_tried_over_the_whole_range() {
    for lines in [
        // Negative in the middle, and the parameter of the same name does not cut the range.
        "given real x >= 1\nsays f(x) is 1 + 1000*((x-1/2)^2 - 1/12) with density on 0..1",
        "says f(x) is 3/2 - x with density on 0..2",
        "says F(x) is 12*x^3 - 18*x^2 + 7*x with cdf on 0..1",
    ] {
        assert_eq!(verdict(lines), Verdict::Refuted, "{lines}");
    }
    never_passes(&["says f is 2 with density on 0..1"]);
    let root = "says F(x) is sqrt(x) with cdf on 0..1";
    assert_eq!(verdict(root), Verdict::Defined);
}

#[test]
fn agreement_with_another_claim_is_not_taken_on_trust() {
    let text = "```claim 1\nsays f(x) is 2*x with density on 0..1\n```\n\n\
                ```claim 2\nsays g(x) is 3*x with agrees 1\n```\n";
    let book = read_text("false.md", text).expect(text);
    let report = judge(&book.claims[1], None, &Settings::default());
    assert_eq!(report.printed.verdict, Verdict::Undecided);
}
