//! Integrals and means without an exact form: their enclosures meet closed forms and values computed
//! elsewhere, hold at every precision, and nothing finite is said where nothing finite is.
#![cfg(feature = "engine")]

use claimcheck::evaluate::{Context, Failure, Outcome, enclose, ladder};
use claimcheck::formula::{Budget, Point, parse_formula};
use claimcheck::number::Interval;

type Answer = Result<Outcome<Interval>, Failure>;

fn with<T>(text: &str, f: impl FnOnce(&claimcheck::formula::Formula, &Context) -> T) -> T {
    let (point, budget) = (Point::default(), Budget::new(50_000_000));
    let context = Context {
        point: &point,
        draws: &[],
        budget: &budget,
    };
    f(&parse_formula(text).expect(text), &context)
}

fn at(text: &str, precision: u32) -> Answer {
    with(text, |formula, context| {
        enclose(formula, context, precision)
    })
}

fn digits(text: &str, digits: u32) -> Answer {
    with(text, |formula, context| ladder(formula, context, digits))
}

fn value(text: &str, answer: Answer) -> Interval {
    match answer {
        Ok(Outcome::Value(value)) => value,
        other => panic!("{text}: {other:?}"),
    }
}

/// Quadratures, and closed forms that have the same values.
const CLOSED: &[(&str, &str)] = &[
    ("4*int(1/(1+x^2), x = 0..1)", "pi"),
    ("int(sqrt(1-x^2), x = 0..1)", "pi/4"),
    ("int(sqrt(1-x^2), x = 1..0)", "-pi/4"),
    ("int(ln(x), x = 0..1)", "-1"),
    ("int(ln(x)^2/sqrt(x), x = 0..1)", "16"),
    ("int(exp(x), x = 0..ln(3))", "2"),
    ("int(sin(x), x = 0..pi)", "2"),
    ("int(x*cos(x), x = 0..pi/2)", "pi/2 - 1"),
    ("int(2^x, x = 0..1)", "1/ln(2)"),
    ("int(x^pi, x = 1..2)", "(2^(pi+1) - 1)/(pi+1)"),
    ("int(1/(x^2 + x + 1), x = 0..1)", "pi/(3*sqrt(3))"),
    ("int(1/(x^2 - 2), x = 0..1)", "ln(sqrt(2) - 1)/sqrt(2)"),
    ("int(x^(-1/2)*(1-x)^(-1/3), x = 0..1)", "beta(1/2, 2/3)"),
    (
        "int((x-1)^(1/3)*(3-x)^(-1/4), x = 1..3)",
        "2^(13/12)*beta(4/3, 3/4)",
    ),
    ("int(1/sqrt(x - x^2), x = 0..1)", "pi"),
    ("int(x^(1/3)*exp(-x), x = 0..inf)", "gamma(4/3)"),
    ("int(x^4*exp(-2*x), x = 0..inf)", "3/4"),
    ("int(exp(-x^2), x = -inf..inf)", "sqrt(pi)"),
    ("int(exp(-x)*sin(x), x = 0..inf)", "1/2"),
    ("int(exp(x), x = -inf..1)", "exp(1)"),
    ("int((1+x^2)^(-3/2), x = 0..inf)", "1"),
    ("int(1/(1+x^2), x = -inf..inf)", "pi"),
    (
        "mean(sqrt(x), x ~ beta(1/3, 1/7))",
        "beta(5/6, 1/7)/beta(1/3, 1/7)",
    ),
    (
        "mean(x^(1/3)/(1-x)^(1/8), x ~ beta(1/2, 2/3))",
        "beta(5/6, 13/24)/beta(1/2, 2/3)",
    ),
    ("mean(ln(x), x ~ beta(3, 1))", "-1/3"),
    ("var(ln(x), x ~ uniform(0, 1))", "1"),
    ("mean(exp(x), x ~ uniform(1, 3))", "(exp(3) - exp(1))/2"),
    ("mean(sqrt(x), x ~ order(1, 2) of uniform(0, 4))", "16/15"),
];

#[test]
fn quadratures_meet_closed_forms() {
    for (integral, closed) in CLOSED {
        let left = value(integral, digits(integral, 25));
        let right = value(closed, digits(closed, 25));
        assert!(
            left.overlaps(&right),
            "{integral} = {}",
            left.to_decimal(30)
        );
    }
}

#[test]
fn more_bits_give_a_narrower_enclosure_of_the_same_value() {
    for (integral, closed) in CLOSED {
        let (rough, fine) = (
            value(integral, at(integral, 48)),
            value(integral, at(integral, 96)),
        );
        let known = value(closed, at(closed, 300));
        assert!(
            rough.contains(&known) || rough.overlaps(&known),
            "{integral} roughly"
        );
        assert!(fine.overlaps(&known), "{integral} finely");
        assert!(
            fine.width() < rough.width() || fine.is_point(),
            "{integral}"
        );
        assert!(fine.agrees_to(20), "{integral}: {}", fine.to_decimal(30));
    }
}

/// Values from mpmath with 60 digits.
#[test]
fn quadratures_meet_values_from_elsewhere() {
    let table = [
        (
            "int(exp(-x^2), x = 0..1)",
            "0.74682413281242702539946743613185300535449968681261",
        ),
        (
            "int(sin(x)/x, x = 0..1)",
            "0.94608307036718301494135331382317965781233795473811",
        ),
        (
            "int(1/sqrt((1-x^2)*(1-x^2/2)), x = 0..1)",
            "1.8540746773013719184338503471952600462175988235218",
        ),
        (
            "int(sqrt((1-x^2/2)/(1-x^2)), x = 0..1)",
            "1.3506438810476755025201747353387258413495223669244",
        ),
        (
            "int(1/sqrt(1 - sin(x)^2/4), x = 0..pi/2)",
            "1.6857503548125960428712036577990769895008008941411",
        ),
    ];
    for (integral, known) in table {
        let found = value(integral, digits(integral, 50));
        assert_eq!(found.to_decimal(50), known, "{integral}");
    }
}

#[test]
fn divergent_integrals_are_infinite_where_that_is_proved() {
    let table = [
        ("int(exp(x)/x, x = 0..1)", Outcome::PlusInfinity),
        ("int(exp(x)/x, x = 1..0)", Outcome::MinusInfinity),
        ("int(ln(x)/x, x = 0..1)", Outcome::MinusInfinity),
        ("int(sin(x)/x^2, x = 0..1)", Outcome::PlusInfinity),
        ("int(cos(3*x)/x^2, x = 0..1)", Outcome::Undefined),
        ("int((1-x)^(-4/3), x = 0..1)", Outcome::PlusInfinity),
        ("int(1/sqrt(1+x^2), x = 0..inf)", Outcome::PlusInfinity),
        ("mean(x^(-1/2), x ~ beta(1/2, 2))", Outcome::PlusInfinity),
        ("var(x^(-1/2), x ~ uniform(0, 1))", Outcome::PlusInfinity),
        ("var(exp(x)/x, x ~ uniform(0, 1))", Outcome::Undefined),
        ("int(sqrt(x), x = -1..1)", Outcome::Undefined),
        (
            "int(exp(-x)*sqrt(1000 - x), x = 0..inf)",
            Outcome::Undefined,
        ),
        ("int(ln(x - 2), x = 0..1)", Outcome::Undefined),
        ("int(exp(x)*ln(-1), x = 0..1)", Outcome::Undefined),
    ];
    for (integral, known) in table {
        assert_eq!(digits(integral, 20), Ok(known), "{integral}");
    }
}

#[test]
fn poles_inside_and_unclear_ends_are_refused() {
    for integral in [
        "int(exp(x)/(x - 1/3)^2, x = 0..1)",
        "int(exp(x)/(x - 1/3), x = 0..1)",
        "int(1/(x^2 - 1/2), x = 0..1)",
        "int(1/sin(x), x = -1..2)",
        "int(1/ln(x), x = 1/2..2)",
        "int(exp(x), x = 0..inf)",
        "int(sin(x)/x, x = 0..inf)",
        "int(exp(-1/x), x = 0..1)",
        "mean(exp(x)/(x - 1/2), x ~ beta(1/2, 2))",
    ] {
        let answer = digits(integral, 15);
        assert!(answer.is_err(), "{integral}: {answer:?}");
    }
}
