//! Refutations and examples.

use super::super::{Because, Witness, check_example, check_witness};
use super::*;
use crate::formula::parse_proposition;

fn rational(text: &str) -> Rational {
    text.parse().expect(text)
}

fn point(numbers: &[(&str, &str)]) -> Point {
    Point {
        numbers: numbers
            .iter()
            .map(|(n, q)| ((*n).into(), rational(q)))
            .collect(),
        functions: Default::default(),
    }
}

fn check(text: &str, numbers: &[(&str, &str)], link: usize) -> Result<Because, Unknown> {
    let proposition = parse_proposition(text).expect(text);
    let point = point(numbers);
    check_witness(&proposition, &Witness { point, link }).map(|r| r.because())
}

const VARIANCE: &str = "given int k\ngiven int n\ngiven real I\n\
    domain 1 <= k <= n\ndomain I > 0\ndraw r ~ beta(k, n - k + 1)\n\
    says var(I*k/(n*r)) == I^2*k^2*(-k + n + 1)/((k - 2)*(k - 1)^2*n)";

#[test]
fn the_variance_2_14_lacks_a_condition() {
    let at = |k, n| check(VARIANCE, &[("k", k), ("n", n), ("I", "1")], 0);
    assert_eq!(at("2", "2"), Ok(Because::Undefined));
    assert_eq!(at("2", "5"), Ok(Because::Undefined));
    // Neither side has a value; the sides are equal; the point is outside.
    assert!(at("1", "2").is_err());
    assert!(at("3", "4").is_err());
    assert!(at("3", "2").is_err());
    assert!(at("0", "2").is_err());
    assert!(at("5/2", "4").is_err());
    assert!(check(VARIANCE, &[("k", "2"), ("n", "2"), ("I", "1")], 1).is_err());
    assert!(check(VARIANCE, &[("k", "2"), ("n", "2")], 0).is_err());
    let extra = [("k", "2"), ("n", "2"), ("I", "1"), ("r", "1/2")];
    assert!(check(VARIANCE, &extra, 0).is_err());
}

#[test]
fn the_sign_in_2_61_is_wrong() {
    let claim = |z: &str| {
        format!(
            "given real Va\ngiven real V\ndomain Va > 0\ndomain V > 0\n\
             says hyp2f1r(1, 1; 2; {z}) == Va*ln((Va + V)/Va)/V"
        )
    };
    let at = [("Va", "1"), ("V", "1/2")];
    assert_eq!(check(&claim("V/Va"), &at, 0), Ok(Because::Disjoint));
    assert!(check(&claim("-V/Va"), &at, 0).is_err());
    let beyond = [("Va", "1"), ("V", "1")];
    assert_eq!(check(&claim("V/Va"), &beyond, 0), Ok(Because::Undefined));
}

#[test]
fn links_are_counted_over_the_whole_statement() {
    let text = "given real x\nsays x == x < x and x != x <= x + 1";
    let at = [("x", "2/3")];
    assert!(check(text, &at, 0).is_err());
    assert_eq!(check(text, &at, 1), Ok(Because::Equal));
    assert_eq!(check(text, &at, 2), Ok(Because::Equal));
    assert!(check(text, &at, 3).is_err());
    assert!(check(text, &at, 4).is_err());
}

#[test]
fn infinities_are_equal_and_far_from_numbers() {
    let text = "given int l\ndomain l >= 1\ndraw x ~ beta(l, 1)\n\
        says mean(1/x) == mean(1/x^2) and mean(1/x) == 2";
    assert!(check(text, &[("l", "1")], 0).is_err());
    assert_eq!(check(text, &[("l", "1")], 1), Ok(Because::Disjoint));
    assert_eq!(check(text, &[("l", "2")], 0), Ok(Because::Disjoint));
    assert!(check(text, &[("l", "2")], 1).is_err());
}

#[test]
fn expansions_wait() {
    let text = "given int k\ndomain k >= 1\nsays 1/k == 1/k^2 + O(1/k^3) as k -> inf";
    assert!(check(text, &[("k", "2")], 0).is_err());
    for hidden in ["1/k == 1/(k - k) + O(1/k)", "1/(k - k) + O(1/k) == 1/k"] {
        let text = format!("given int k\ndomain k >= 1\nsays {hidden} as k -> inf");
        assert!(check(&text, &[("k", "2")], 0).is_err());
    }
    let text = "given int k\ndomain k >= 1\nsays 1/k ~ 2/k as k -> inf";
    assert!(check(text, &[("k", "2")], 0).is_err());
    // A relation is one at every point, wherever the limit is, but not along other formulas.
    let text = "given int k\nsays k == 1 as k -> inf";
    assert_eq!(check(text, &[("k", "2")], 0), Ok(Because::Disjoint));
    let text = "given int k\nsays k == 1 along k = 1";
    assert!(check(text, &[("k", "2")], 0).is_err());
    for says in [
        "k ~ k as k -> inf",
        "k == k along k = 1",
        "k == k as k -> inf",
    ] {
        let text = format!("given int k\nsays {says}");
        let proposition = parse_proposition(&text).expect(says);
        let found = check_example(&proposition, &point(&[("k", "2")]), &[(0, false)]);
        assert_eq!(found.is_ok(), says == "k == k as k -> inf", "{says}");
    }
}

#[test]
fn examples_have_two_values_that_agree() {
    let example = |numbers: &[(&str, &str)], links: &[usize]| {
        let proposition = parse_proposition(VARIANCE).expect(VARIANCE);
        let links: Vec<_> = links.iter().map(|link| (*link, false)).collect();
        check_example(&proposition, &point(numbers), &links).is_ok()
    };
    assert!(example(&[("k", "3"), ("n", "4"), ("I", "1/2")], &[0]));
    assert!(example(&[("k", "3"), ("n", "4"), ("I", "1/2")], &[]));
    for (k, n) in [("1", "2"), ("2", "2"), ("5", "4"), ("5/2", "4")] {
        assert!(!example(&[("k", k), ("n", n), ("I", "1")], &[0]));
    }
    assert!(!example(&[("k", "3"), ("n", "4"), ("I", "1/2")], &[1]));
    let text = "given real x\nsays ln(x) == ln(x) < 2 and int(1/t, t = 0..x) == inf";
    let proposition = parse_proposition(text).expect(text);
    for (x, links, holds) in [
        ("3", vec![(0, false), (1, false), (2, false)], true),
        ("9", vec![(0, false), (2, false)], true),
        ("9", vec![(0, false), (1, false)], false),
        ("9", vec![(1, true)], false),
        ("0", vec![(0, false)], false),
        ("0", vec![(0, true)], false),
    ] {
        let found = check_example(&proposition, &point(&[("x", x)]), &links);
        assert_eq!(found.is_ok(), holds, "{x} {links:?}");
    }
}

/// A value that the kernel does not find is that of the other side of the equation, or one where the
/// sides are known to be finite.
#[test]
fn examples_may_be_known_to_have_values() {
    let says = "int(sqrt(t), t = 0..1) == 1/(x - 1) and int(x, x) == x^2 and int(sqrt(t), t = 0..1) == \
        int(sqrt(s), s = 0..1) and 0 < int(sqrt(t), t = 0..1)";
    let proposition = parse_proposition(&format!("given real x\nsays {says}")).expect(says);
    let shows = |x: &str, link| check_example(&proposition, &point(&[("x", x)]), &[link]).is_ok();
    assert!(shows("2", (0, false)));
    assert!(!shows("1", (0, true)));
    // An antiderivative is judged by derivatives.
    assert!(shows("0", (1, false)));
    assert!(!shows("2", (1, false)));
    for link in [2, 3] {
        assert!(shows("2", (link, true)));
        assert!(!shows("2", (link, false)));
    }
}

/// The kernel has no rule for a root of a draw: of an equation that is proved the other side tells.
#[test]
fn examples_of_an_equation_have_one_value() {
    for (says, shown) in [
        ("prob(sqrt(X) < 1/2) == 1/4", true),
        ("1/4 == prob(sqrt(X) < 1/2)", true),
        ("prob(sqrt(X) < 1/2) == prob(sqrt(X) < 1/2)", false),
        ("prob(sqrt(X) < 1/2) == ln(0)", false),
        ("ln(0) == prob(sqrt(X) < 1/2)", false),
        ("ln(0) == ln(0)", false),
        ("1/4 == ln(0)", false),
        ("ln(0) == 1/4", false),
        ("1/4 == 1/5", false),
        ("prob(sqrt(X) < 1/2) < 1", false),
        ("0 < prob(sqrt(X) < 1/2)", false),
        ("0 != prob(sqrt(X) < 1/2)", false),
    ] {
        let text = format!("draw X ~ uniform(0, 1)\nsays {says}");
        let proposition = parse_proposition(&text).expect(&text);
        let found = check_example(&proposition, &point(&[]), &[(0, false)]);
        assert_eq!(found.is_ok(), shown, "{text}");
    }
}

/// For a law that is not given an example has one, under which the sides are numbers; a refutation
/// would need all laws.
#[test]
fn examples_of_a_law_that_is_not_given() {
    for (law, says, shown) in [
        ("any", "var(X) == mean(X^2) - mean(X)^2", true),
        ("any", "mean(X) == 2", false),
        ("any", "mean(1/X) == mean(2/X)", false),
        ("any", "mean(X) < mean(1/X)", false),
        ("any", "mean(1/X) > mean(X)", false),
        ("uniform(0, 1)", "mean(1/X) == mean(2/X)", true),
        ("uniform(0, 1)", "mean(X) < mean(1/X)", true),
    ] {
        let text = format!("draw X ~ {law}\nsays {says}");
        let proposition = parse_proposition(&text).expect(&text);
        let found = check_example(&proposition, &point(&[]), &[(0, true)]);
        assert_eq!(found.is_ok(), shown, "{text}");
        if law == "any" {
            assert!(check(&text, &[], 0).is_err(), "{text}");
        }
    }
}

#[test]
fn definitions_have_duties() {
    let duty = |text: &str, link| check(&format!("says {text}"), &[], link);
    assert!(duty("f(r) is 2*r with density on 0..1", 0).is_err());
    assert!(duty("f(r) is 2*r^2/r with density on 0..1", 0).is_err());
    assert_eq!(
        duty("f(r) is 3*r with density on 0..1", 0),
        Ok(Because::Duty)
    );
    assert_eq!(
        duty("f(r) is 4*r - 1 with density on 0..1", 0),
        Ok(Because::Duty)
    );
    assert_eq!(
        duty("f(r) is 1/r with density on 0..1", 0),
        Ok(Because::Duty)
    );
    assert!(duty("F(r) is r^2 with cdf on 0..1", 0).is_err());
    assert_eq!(duty("F(r) is r^2/2 with cdf on 0..1", 0), Ok(Because::Duty));
    assert_eq!(
        duty("F(r) is r + 3*r*(1 - r) with cdf on 0..1", 0),
        Ok(Because::Duty)
    );
    assert!(duty("F(r) is r^2 with cdf on 0..1, agrees 2.3", 1).is_err());
}

#[test]
fn functions_must_be_of_their_kind() {
    let claim = "given fn f(x) density on 0..1\ngiven real a\ndomain 0 <= a <= 1\n\
        says int(f(t), t = 0..a) == a";
    let proposition = parse_proposition(claim).expect(claim);
    let with = |body: &str| {
        let mut point = point(&[("a", "1/2")]);
        let body = parse_formula(body).expect(body);
        point.functions.insert("f".into(), ("x".into(), body));
        check_witness(&proposition, &Witness { point, link: 0 }).map(|r| r.because())
    };
    assert_eq!(with("2*x"), Ok(Because::Disjoint));
    assert!(with("1").is_err());
    assert!(with("3*x").is_err());
    assert!(with("4*x - 1").is_err());
    assert!(with("1/x").is_err());
    assert!(with("2*x + a - a").is_err());
}

#[test]
fn draws_must_have_a_law_and_a_name_of_their_own() {
    let text = "given int k\ndraw r ~ beta(k, 1)\nsays mean(r) == 5";
    assert_eq!(check(text, &[("k", "1")], 0), Ok(Because::Disjoint));
    assert!(check(text, &[("k", "0")], 0).is_err());
    let text = "given int k\ndraw r ~ any\nsays 0 == 1";
    assert!(check(text, &[("k", "1")], 0).is_err());
}

/// 2.62: k = 1 has an infinite mean on the left and no logarithm on the right.
#[test]
fn the_limit_2_62_lacks_a_condition() {
    let text = "given int k\ngiven int l\ngiven int m\ngiven real I\n\
        domain 1 <= l <= m\ndomain 1 <= k\ndomain I > 0\ndraw x ~ beta(l, m - l + 1)\n\
        says lim(mean(I*k/(k - 1 + x)), m -> 1, l -> 1) == I*k*ln(k/(k - 1))";
    let at = |k| check(text, &[("k", k), ("l", "1"), ("m", "2"), ("I", "2")], 0);
    assert_eq!(at("1"), Ok(Because::Undefined));
    assert!(at("2").is_err());
}

/// Two bits more or a hundred: each rung of the ladder is tried, and there is a last one.
#[test]
fn close_values_are_told_apart_by_more_bits() {
    for (bits, told) in [(10, true), (100, true), (600, true), (3000, false)] {
        let text = format!("says sqrt(2) == sqrt(2) + 1/2^{bits}");
        let known = told.then_some(Because::Disjoint);
        assert_eq!(check(&text, &[], 0).ok(), known, "{bits}");
    }
}

#[test]
fn names_are_declared_once_and_given_once() {
    let at = |text: &str, numbers: &[(&str, &str)]| check(text, numbers, 0).is_ok();
    assert!(at("given real a\nsays a == a + 1", &[("a", "1/2")]));
    assert!(!at("given real a\nsays a == a + 1", &[("b", "1/2")]));
    assert!(!at("given int a\nsays a == a + 1", &[("a", "1/2")]));
    let twice = parse_proposition("given real a\nsays a == a + 1").unwrap();
    let mut proposition = twice.clone();
    proposition.parameters.push(twice.parameters[0].clone());
    let point = point(&[("a", "1")]);
    let witness = |point| Witness { point, link: 0 };
    assert!(check_witness(&twice, &witness(point.clone())).is_ok());
    assert!(check_witness(&proposition, &witness(point.clone())).is_err());
    let mut proposition = twice.clone();
    proposition.draws.push(draw("a", "uniform(0, 1)"));
    assert!(check_witness(&proposition, &witness(point.clone())).is_err());
    let mut more = point;
    let body = parse_formula("x").unwrap();
    more.functions.insert("f".into(), ("x".into(), body));
    assert!(check_witness(&twice, &witness(more)).is_err());
}

#[test]
fn a_refutation_shows_both_values() {
    let proposition = parse_proposition("says 1/2 == 1/0 and 1/3 > 1").unwrap();
    let refutation = |link| {
        let point = Point::default();
        check_witness(&proposition, &Witness { point, link }).unwrap()
    };
    let first = refutation(0);
    assert_eq!(first.because(), Because::Undefined);
    assert_eq!(
        (Ok(first.left().clone()), first.right()),
        (exact(1, 2), &Value::Undefined)
    );
    let second = refutation(1);
    assert_eq!(second.because(), Because::Disjoint);
    assert_eq!(Ok(second.left().clone()), exact(1, 3));
}

/// The law of a draw may name what a derivative is taken in: all of these hold.
#[test]
fn derivatives_of_means_know_the_laws() {
    for says in [
        "diff(mean(X), k) == 1/2",
        "diff(k*mean(X), k) == k",
        "diff(int(mean(X)*s, s = 0..1), k) == 1/4",
        "int(1/2, k) == mean(X)",
        "diff(k*prob(X < 1/2), k) == [k < 1/2]",
        "diff(var(X), k) == k/6",
        "diff(cdf(X, 1/2)*k, k) == 0",
    ] {
        let claim = format!("given real k\ndomain k > 0\ndraw X ~ uniform(0, k)\nsays {says}");
        assert!(check(&claim, &[("k", "1")], 0).is_err(), "{says}");
    }
}

/// Equations with antiderivatives are refuted where the derivatives differ.
#[test]
fn antiderivatives_are_compared_by_derivatives() {
    let at = |says: &str, x: &str| check(&format!("given real x\nsays {says}"), &[("x", x)], 0);
    assert_eq!(at("int(x, x) == x^2", "1"), Ok(Because::Disjoint));
    assert_eq!(at("ln(x) == int(1/x, x)", "-1"), Ok(Because::Undefined));
    assert!(at("int(x, x) == x^2/2 + 7", "1").is_err());
    assert!(at("ln(x) == int(1/x, x)", "2").is_err());
}
