//! Whole proofs, of the kinds that the book has.

use super::super::{Fact, Proof, Rule, replay};
use crate::formula::{Point, Rational, parse_proposition};

fn proves(text: &str) {
    if let Err(flaw) = replay(text) {
        panic!(
            "{flaw}: {}",
            text.lines()
                .nth(flaw.line.wrapping_sub(1))
                .unwrap_or_default()
        );
    }
}

#[test]
fn a_shift_of_gamma() {
    proves(
        "theorem
        given int k
        domain k >= 2
        says k*gamma(k - 1)/gamma(k) == k/(k - 1)
        example k = 2
        proof
        1: 2 <= k | given
        2: 0 < k - 1 | order | k - 2 + 1
        3: 0 < k | order | k - 2 + 2
        4: gamma(k) == (k - 1)*gamma(k - 1) | gamma
        5: k*gamma(k - 1)/gamma(k) == k/(k - 1) | ring 4
        qed 5",
    );
}

#[test]
fn an_integral_by_its_primitive() {
    proves(
        "theorem
        given real r
        domain 0 <= r
        says int(2*s, s = 0..r) == r^2
        example r = 1/2
        proof
        1: 0 <= r | given
        { s real | 2: 0 <= s | 3: s <= r
          4: finite s^2 | finite
          5: finite 2*s | finite
          6: 2*s^(2 - 1)*1 == 2*s | ring
        }
        7: int(2*s, s = 0..r) == r^2 - 0^2 | primitive 4 6 5 | s^2
        8: r^2 - 0^2 == r^2 | ring
        9: int(2*s, s = 0..r) == r^2 | chain 7 8
        qed 9",
    );
}

#[test]
fn a_mean_over_a_beta_law() {
    proves(
        "theorem
        given int k
        given int n
        domain k >= 2
        domain k <= n
        draw x ~ beta(k, n - k + 1)
        says mean(1/x) == n/(k - 1)
        example k = 2, n = 3
        proof
        1: 2 <= k | given
        2: k <= n | given
        3: 0 < k - 1 | order | k - 2 + 1
        4: 0 < k | order | k - 2 + 2
        5: 0 < n - k + 1 | order | n - k + 1
        6: mean(1/x) == mean(1/x, x ~ beta(k, n - k + 1)) | draw
        7: mean(1/x, x ~ beta(k, n - k + 1)) == int(x^(k - 1)*(1 - x)^(n - k + 1 - 1)/beta(k, n - k + 1)*(1/x), x = 0..1) | density
        { y real | 8: 0 < y | 9: y < 1
          10: y^(k - 1) == y^(k - 1 - 1)*y^1 | power
          11: y^(k - 1)*(1 - y)^(n - k + 1 - 1)/beta(k, n - k + 1)*(1/y) == 1/beta(k, n - k + 1)*(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1)) | ring 10
        }
        12: int(x^(k - 1)*(1 - x)^(n - k + 1 - 1)/beta(k, n - k + 1)*(1/x), x = 0..1) == int(1/beta(k, n - k + 1)*(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1)), y = 0..1) | congruence 11
        13: int(1/beta(k, n - k + 1)*(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1)), y = 0..1) == 1/beta(k, n - k + 1)*int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) | scale
        14: beta(k - 1, n - k + 1) == int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) | beta-integral
        15: finite int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) | finite 14
        16: int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) == beta(k - 1, n - k + 1) | chain 14
        17: 0 < n | order | n - k + (k - 2) + 2
        18: 0 < k + (n - k + 1) | order | n + 1
        19: 0 < k - 1 + (n - k + 1) | order | n
        20: beta(k, n - k + 1) == gamma(k)*gamma(n - k + 1)/gamma(k + (n - k + 1)) | beta
        21: beta(k - 1, n - k + 1) == gamma(k - 1)*gamma(n - k + 1)/gamma(k - 1 + (n - k + 1)) | beta
        22: gamma(k) == (k - 1)*gamma(k - 1) | gamma
        23: gamma(n + 1) == n*gamma(n) | gamma
        24: 1/beta(k, n - k + 1)*int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) == n/(k - 1) | ring 16 20 21 22 23
        25: mean(1/x) == n/(k - 1) | chain 6 7 12 13 24
        qed 25",
    );
}

/// An equation with an antiderivative is one of derivatives.
#[test]
fn an_antiderivative() {
    let text = "theorem
        given real x
        domain x > 0
        says 2*ln(x) == int(2/x, x)
        example x = 1
        proof
        1: 0 < x | given
        { t real | 2: 0 < t
          3: finite 2*ln(t) | finite
          4: finite 2*(1/t) | finite
        }
        5: diff(2*ln(x), x) == 2*(1/x) | derivative 3 4
        6: 2*(1/x) == 2/x | ring
        7: diff(2*ln(x), x) == 2/x | chain 5 6
        8: 2*ln(x) == 2*ln(x) | chain
        qed 7";
    proves(text);
    for (old, new, why) in [
        ("qed 7", "qed 8", "does not state the link"),
        (
            "== int(2/x, x)",
            "== x*int(2/x, x)",
            "does not state the link",
        ),
        ("example x = 1", "example x = 0", "not in the domain"),
    ] {
        let flaw = replay(&text.replace(old, new)).expect_err(new);
        assert!(flaw.to_string().contains(why), "{new}: {flaw}");
    }
}

/// A value that the kernel does not find at the example is one where a side is known to be finite.
#[test]
fn an_example_without_values() {
    let text = "theorem
        says sqrt(int(sqrt(t), t = 0..1)^2) == (int(sqrt(t), t = 0..1)^2)^(1/2)
        example
        proof
        { t real | 1: 0 <= t | 2: t <= 1
          3: finite sqrt(t) | finite
        }
        4: finite int(sqrt(t), t = 0..1) | continuous 3
        5: sqrt(int(sqrt(t), t = 0..1)^2) == (int(sqrt(t), t = 0..1)^2)^(1/2) | power
        qed 5";
    proves(text);
    let slope = "theorem
        given real x
        says diff(x*int(sqrt(t), t = 0..1), x) == int(sqrt(t), t = 0..1)
        example x = 0
        proof
        { t real | 1: 0 <= t | 2: t <= 1
          3: finite sqrt(t) | finite
        }
        4: finite int(sqrt(t), t = 0..1) | continuous 3
        { y real
          5: finite y*int(sqrt(t), t = 0..1) | finite
          6: finite 1*int(sqrt(t), t = 0..1) | finite
        }
        7: diff(x*int(sqrt(t), t = 0..1), x) == 1*int(sqrt(t), t = 0..1) | derivative 5 6
        8: 1*int(sqrt(t), t = 0..1) == int(sqrt(t), t = 0..1) | ring
        9: diff(x*int(sqrt(t), t = 0..1), x) == int(sqrt(t), t = 0..1) | chain 7 8
        10: int(sqrt(t), t = 0..1) == diff(x*int(sqrt(t), t = 0..1), x) | chain 9
        11: int(sqrt(t), t = 0..1) < int(sqrt(t), t = 0..1) + 1 | order
        qed 9";
    proves(slope);
    let (left, right) = (
        "diff(x*int(sqrt(t), t = 0..1), x)",
        "int(sqrt(t), t = 0..1)",
    );
    let says = format!("says {left} == {right}");
    for (new, step) in [
        (format!("says {right} == {left}"), "qed 10"),
        (format!("says {right} < {right} + 1"), "qed 11"),
    ] {
        proves(&slope.replace(&says, &new).replace("qed 9", step));
    }
    // Both sides have the same value, but it is not known to be one.
    let open = "theorem
        says int(sqrt(t), t = 0..1) == int(sqrt(s), s = 0..1)
        example
        proof
        1: int(sqrt(t), t = 0..1) == int(sqrt(s), s = 0..1) | congruence
        qed 1";
    let flaw = replay(open).expect_err("no value");
    assert!(flaw.to_string().contains("shows nothing"), "{flaw}");
}

/// The same, step by step: what the facts are, what they rest on, and where a proof ends.
#[test]
fn a_proof_step_by_step() {
    let proposition =
        parse_proposition("given real x\ndomain x >= 0\nsays 0 < x + 1 and 0 < x + 2")
            .expect("a proposition");
    let fact = |text| Fact::parse(text).expect(text);
    let mut proof = Proof::new(&proposition);
    let mut step = |text, rule, premises: &[usize]| {
        let made = proof.step(fact(text), rule, premises, &[]);
        (made, proof.seen())
    };
    assert_eq!(step("0 <= 1", Rule::Order, &[]), (Ok(0), vec![]));
    assert_eq!(step("0 <= x", Rule::Given, &[]), (Ok(1), vec![]));
    assert_eq!(step("0 < x + 1", Rule::Order, &[]), (Ok(2), vec![1]));
    assert_eq!(step("0 < x + 2", Rule::Order, &[]), (Ok(3), vec![1]));
    assert!(step("x == x", Rule::Chain, &[4]).0.is_err());
    assert_eq!(proof.fact(2), Some(&fact("0 < x + 1")));
    assert_eq!(proof.fact(4), None);
    let mut point = Point::default();
    point.numbers.insert("x".into(), Rational::default());
    let ends = |links: &[(usize, usize)]| {
        let theorem = proof.theorem(links, &point);
        theorem
            .map(|theorem| theorem.is_whole())
            .map_err(|why| why.0)
    };
    assert_eq!(ends(&[(0, 2), (1, 3)]), Ok(true));
    assert_eq!(ends(&[(1, 3)]), Ok(false));
    for (links, why) in [
        (&[][..], "no link is proved"),
        (&[(0, 2), (0, 2)], "links are listed in order"),
        (&[(1, 3), (0, 2)], "links are listed in order"),
        (&[(0, 3)], "the step does not state the link"),
        (
            &[(0, 4)],
            "a link is proved by a step outside of all blocks",
        ),
        (&[(2, 2)], "the statement has no such link"),
    ] {
        assert_eq!(ends(links), Err(why.to_string()));
    }
}

/// A direction of limits says nothing of a link that holds at every point.
#[test]
fn a_link_with_a_regime() {
    proves(
        "theorem
        given real k
        says k < k + 1 as k -> inf
        example k = 1
        proof
        1: k < k + 1 | order
        qed 1",
    );
}

/// The law `any` has all the means that the statement has.
#[test]
fn a_law_that_is_not_given() {
    proves(
        "theorem
        given real a
        draw X ~ any
        says var(a*X) == a^2*var(X)
        example a = 0
        proof
        1: var(a*X) == var(a*X, X ~ any) | draw
        2: var(X) == var(X, X ~ any) | draw
        3: finite var(X, X ~ any) | finite 2
        4: var(a*X, X ~ any) == a^2*var(X, X ~ any) | variance
        5: a^2*var(X) == a^2*var(X, X ~ any) | congruence 2
        6: var(a*X) == a^2*var(X) | chain 1 4 5
        qed 6",
    );
    // Two laws that are not given are not one.
    for (says, steps, why) in [
        (
            "mean(X) == mean(Y)",
            "3: mean(X, X ~ any) == mean(Y, Y ~ any) | congruence\n4: mean(X) == mean(Y) | chain 1 3 2\nqed 4",
            "more than the premises",
        ),
        (
            "mean(X) == mean(Z, Z ~ any)",
            "3: mean(X, X ~ any) == mean(Z, Z ~ any) | congruence\n4: mean(X) == mean(Z, Z ~ any) | chain 1 3\nqed 4",
            "more than the premises",
        ),
        (
            "mean(X) == mean(X, X ~ any)",
            "qed 1",
            "of its own over a law",
        ),
    ] {
        let text = format!(
            "theorem\ndraw X ~ any\ndraw Y ~ any\nsays {says}\nexample\nproof\n1: mean(X) == mean(X, X ~ any) | draw\n2: mean(Y) == mean(Y, Y ~ any) | draw\n{steps}"
        );
        let flaw = replay(&text).expect_err(says);
        assert!(flaw.to_string().contains(why), "{says}: {flaw}");
    }
    let finite = |law: &str, says: &str, e: &str| {
        let text =
            format!("given real j\ndraw X ~ {law}\ndraw Y ~ any\ndraw Z ~ beta(2, 2)\nsays {says}");
        let proposition = parse_proposition(&text).expect(&text);
        let fact = Fact::parse(&format!("finite {e}")).expect(e);
        Proof::new(&proposition)
            .step(fact, Rule::Finite, &[], &[])
            .is_ok()
    };
    for (law, says, e, known) in [
        ("any", "var(X) == 0", "var(X)", true),
        ("any", "0 == mean(X)", "mean(X)", true),
        (
            "any",
            "0 == 1 and 0 < 1 - mean((X - mean(X))^2)",
            "mean(X)",
            true,
        ),
        ("any", "mean(X*Y) == 0", "mean(X*Y)", true),
        ("any", "mean(X*Z) == 0", "mean(X*Z)", false),
        ("any", "var(X) == 0", "mean(X)", false),
        ("any", "mean(X) == 0", "var(X)", false),
        ("any", "mean(2*X) == 0", "mean(X)", false),
        ("any", "mean(X, X ~ any) == 0", "mean(X, X ~ any)", false),
        ("any", "mean(j) == 0", "mean(j)", false),
        ("any", "sum(mean(X^j), j = 1..2) == 0", "mean(X^j)", false),
        ("any", "mean(X^j) == 0", "mean(X^j)", false),
        ("any", "mean(X^(1 + 1)) == 0", "mean(X^(1 + 1))", false),
        ("any", "mean(X^2 - j*X) == 0", "mean(X^2 - j*X)", true),
        ("any", "mean(-X + 1) == 0", "mean(-X + 1)", true),
        ("any", "mean(X/j) == 0", "mean(X/j)", false),
        ("any", "mean(X + 1/j) == 0", "mean(X + 1/j)", false),
        ("any", "mean(1/j + X) == 0", "mean(1/j + X)", false),
        ("any", "mean((1/X)^2) == 0", "mean((1/X)^2)", false),
        ("any", "mean(X^(1/2)) == 0", "mean(X^(1/2))", false),
        ("any", "mean(X^(-1)) == 0", "mean(X^(-1))", false),
        ("any", "mean(X*var(2*X)) == 0", "mean(X*var(2*X))", true),
        ("any", "mean(X*mean(1/X)) == 0", "mean(X*mean(1/X))", false),
        ("any", "mean(abs(X)) == 0", "mean(abs(X))", false),
        ("uniform(0, 1)", "mean(1/X) == 0", "mean(1/X)", false),
        ("uniform(0, 1)", "var(X) == 0", "var(X)", false),
    ] {
        assert_eq!(finite(law, says, e), known, "{law}: {says}: {e}");
    }
}
