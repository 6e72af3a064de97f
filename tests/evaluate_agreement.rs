//! One formula, three evaluators: the exact value lies in the enclosure, the enclosure narrows, the float is
//! near; and closed forms of the thesis meet the means and integrals that they stand for.
#![cfg(feature = "engine")]

use claimcheck::evaluate::{Context, Failure, Outcome, enclose, exact, float, holds, ladder};
use claimcheck::formula::{
    Budget, Draw, Point, Rational, parse_condition, parse_formula, parse_law,
};
use claimcheck::number::{Exact, Interval};

/// `k=5, n=7`
fn point(values: &str) -> Point {
    let mut point = Point::default();
    for pair in values
        .split(',')
        .map(str::trim)
        .filter(|pair| !pair.is_empty())
    {
        let (name, value) = pair.split_once('=').expect("name=value");
        let value: Rational = value.trim().parse().expect("a rational");
        point.numbers.insert(name.trim().into(), value);
    }
    point
}

/// `x ~ beta(l, m-l+1); y ~ uniform(0, 1)`
fn draws(text: &str) -> Vec<Draw> {
    let parts = text
        .split(';')
        .map(str::trim)
        .filter(|part| !part.is_empty());
    parts
        .map(|part| {
            let (name, law) = part.split_once('~').expect("name ~ law");
            Draw {
                name: name.trim().into(),
                law: parse_law(law.trim()).expect(law),
            }
        })
        .collect()
}

struct Case {
    point: Point,
    draws: Vec<Draw>,
    budget: Budget,
}

impl Case {
    fn new(values: &str, laws: &str) -> Case {
        Case {
            point: point(values),
            draws: draws(laws),
            budget: Budget::new(50_000_000),
        }
    }

    fn context(&self) -> Context<'_> {
        Context {
            point: &self.point,
            draws: &self.draws,
            budget: &self.budget,
        }
    }

    fn exact(&self, formula: &str) -> Result<Outcome<Exact>, Failure> {
        exact(&parse_formula(formula).expect(formula), &self.context())
    }

    fn ladder(&self, formula: &str, digits: u32) -> Result<Outcome<Interval>, Failure> {
        ladder(
            &parse_formula(formula).expect(formula),
            &self.context(),
            digits,
        )
    }

    fn holds(&self, condition: &str) -> Result<bool, Failure> {
        holds(
            &parse_condition(condition).expect(condition),
            &self.context(),
        )
    }
}

/// Formulas with the draws they need, and the points to try.
const TABLE: &[(&str, &str, &str)] = &[
    ("1/3 + 2/5*7 - 2^-3", "", ""),
    ("(1/2)^10 + 0^0 + (-3)^3", "", ""),
    ("sqrt(8) + 2^(1/3)*4^(2/3)", "", ""),
    ("sqrt(k) + k^(3/2)", "", "k=2;k=9;k=5/3"),
    ("ln(k) - ln(k-1)", "", "k=2;k=10;k=7/2"),
    ("k*ln(k/(k-1))", "", "k=2;k=100;k=12345"),
    ("ln(sqrt(6)) - ln(2)/2", "", ""),
    ("pi*k^2 + 1/pi", "", "k=3"),
    ("gamma(5) + gamma(1/2)*gamma(-3/2)", "", ""),
    ("k!/(k-2)! + gamma(k + 1/2)", "", "k=2;k=7"),
    ("lngamma(6)", "", ""),
    ("beta(2, 5) + beta(3, 1/3) + beta(1/2, 3/2)", "", ""),
    (
        "binomial(10, 3) + binomial(1/2, 4) + binomial(3, 5) + binomial(4, -1)",
        "",
        "",
    ),
    (
        "pochhammer(1/3, 4) + pochhammer(-2, 5) + pochhammer(3, -2)",
        "",
        "",
    ),
    ("floor(7/3) + floor(-1/2) + floor(pi)", "", ""),
    ("abs(1 - sqrt(2)) + min(3, pi, 4) + max(1, ln(3))", "", ""),
    ("sin(pi/2) + cos(pi) + sin(0) + exp(0)", "", ""),
    ("if(k > 2, k, -k) + [k == 3]", "", "k=1;k=3"),
    ("sum(1/j^2, j = 1..k) + sum(j, j = 3..2)", "", "k=1;k=10"),
    (
        "sup((-1)^j/j, j = 1..6) + infimum((-1)^j/j, j = 1..6)",
        "",
        "",
    ),
    ("hyp2f1(1, 1; 2; -1/2)", "", ""),
    (
        "hyp2f1(1, l; m+1; -v)",
        "",
        "l=1,m=1,v=3;l=2,m=5,v=1/3;l=5,m=5,v=7/2",
    ),
    ("hyp2f1(2, l; m+1; -v)", "", "l=2,m=5,v=1/3;l=1,m=4,v=9"),
    ("hyp2f1(3, 4; 2; -2)", "", ""),
    ("hyp2f1(-3, 4; 2; 7) + hyp2f1(1/2, -2; 3/2; 5)", "", ""),
    ("hyp2f1(1, 2; 5; 1) + hyp2f1r(1, 2; 4; 1/2)", "", ""),
    ("int(x^2, x = 0..k)", "", "k=3;k=-2;k=0"),
    ("int(1/x, x = 1..k)", "", "k=2;k=1/2"),
    ("int(x/(1+x)^3, x = 0..inf)", "", ""),
    ("int(1/(x^2 - 5*x + 6), x = 4..inf)", "", ""),
    ("int(1/(x*(x+1)^2*(x+3)), x = 1..2)", "", ""),
    ("int(1/(4*x^2 + 4*x + 1), x = 0..1)", "", ""),
    (
        "int(2*I*k/r, r = sqrt((k-1)/n)..sqrt(k/n))",
        "",
        "k=2,n=5,I=1;k=7,n=7,I=3/2",
    ),
    (
        "int(3*I*k/r, r = ((k-1)/n)^(1/3)..(k/n)^(1/3))",
        "",
        "k=2,n=5,I=1",
    ),
    (
        "int((I*k/(r*n))^2*n, r = (k-1)/n..k/n) - (I*k*(ln(k/n) - ln((k-1)/n)))^2",
        "",
        "k=2,n=5,I=1;k=9,n=10,I=2",
    ),
    (
        "int(I^2*k^2*n!*r^(k-3)*(1-r)^(n-k)/(n^2*(k-1)!*(n-k)!), r = 0..1) - (I*k/(k-1))^2",
        "",
        "k=3,n=3,I=1;k=5,n=12,I=2/3",
    ),
    (
        "int(2*I*k*n!/(n*(k-1)!*(n-k)!)*(r^2)^(k-1)*(1-r^2)^(n-k)/r, r = 0..1)",
        "",
        "k=2,n=2,I=1;k=4,n=9,I=5",
    ),
    (
        "int(int(2*t, t = 0..r)^(k-1)*(1 - int(2*t, t = 0..r))^(n-k)*2*r, r = 0..1)",
        "",
        "k=2,n=5",
    ),
    (
        "int(abs(x - 1/3), x = 0..1) + int([x^2 < 1/2]*x, x = 0..1)",
        "",
        "",
    ),
    ("int([a < r < b]*r^2, r = 0..1)", "", "a=1/4,b=3/4;a=0,b=1"),
    (
        "int([sqrt((k-1)/n) < r < sqrt(k/n)]*2*r*I*k/(r^2*n)*n, r = 0..1)",
        "",
        "k=2,n=4,I=1",
    ),
    ("int(min(x, 1-x)*max(x, 1/4), x = 0..1)", "", ""),
    (
        "mean(1/(Va + V*x))",
        "x ~ beta(l, m-l+1)",
        "Va=1,V=1,l=1,m=1;Va=2,V=3,l=2,m=5;Va=1/3,V=7,l=12,m=12",
    ),
    (
        "mean((k/(Va + V*x))^2)",
        "x ~ beta(l, m-l+1)",
        "k=4,Va=3,V=2,l=1,m=2;k=2,Va=5/2,V=1,l=3,m=4",
    ),
    (
        "mean(I*k/(n*r))",
        "r ~ beta(k, n-k+1)",
        "k=2,n=2,I=1;k=5,n=9,I=1/2",
    ),
    (
        "var(I*k/(n*r))",
        "r ~ beta(k, n-k+1)",
        "k=3,n=3,I=1;k=5,n=9,I=2",
    ),
    (
        "var(k/(k - l + v*x))",
        "x ~ beta(l, m-l+1)",
        "k=5,l=2,m=3,v=3;k=9,l=3,m=4,v=4",
    ),
    ("mean(x^2 + 3/x - 1/(1-x))", "x ~ beta(5/2, 7/3)", ""),
    (
        "mean(x*y + x^2) + var(x + y)",
        "x ~ beta(2, 3); y ~ uniform(-1, 2)",
        "",
    ),
    (
        "mean(r^2)",
        "r ~ order(l, m) of density 2*t on 0..1",
        "l=2,m=4",
    ),
    (
        "mean(1/r^2)",
        "r ~ order(l, m) of uniform(1, 3)",
        "l=2,m=4;l=1,m=1",
    ),
    (
        "prob(x < 1/3) + prob(x^2 < 1/2 and x > 1/4)",
        "x ~ beta(2, 3)",
        "",
    ),
    (
        "density(x, 1/3) + cdf(x, 1/3) + cdf(x, 2) + density(x, -1)",
        "x ~ beta(2, 3)",
        "",
    ),
    (
        "density(r, 1/3)",
        "r ~ order(l, m) of uniform(0, 1)",
        "l=2,m=4",
    ),
    (
        "density(r, 1/3)",
        "r ~ order(l, m) of density 2*t on 0..1",
        "l=2,m=4;l=1,m=3",
    ),
    ("int(density(x, t)*t, t = -1..2)", "x ~ beta(2, 3)", ""),
    ("diff(x^3*ln(x), x) + diff(1/x, x, 2)", "", "x=2"),
    ("diff(int(t^2, t = 0..x^2), x)", "", "x=2"),
    ("at(x^2 + y, x = 3, y = x)", "", "x=5"),
    ("lim(sin(x)*0 + (x^2 + 1)/(x + 2), x -> 1)", "", ""),
    (
        "lim(mean(k/(k - l + v*x)), m -> 1, l -> 1)",
        "x ~ beta(l, m-l+1)",
        "k=3,l=2,m=2,v=1",
    ),
    (
        "mean(mean(x)*x) + mean(2, t ~ uniform(0, 1)) + mean(t^2, t ~ uniform(0, k))",
        "x ~ beta(2, 3)",
        "k=4",
    ),
];

fn check(formula: &str, case: &Case) {
    let context = case.context();
    let tree = parse_formula(formula).expect(formula);
    let value = match exact(&tree, &context) {
        Ok(Outcome::Value(value)) => value,
        other => panic!("{formula}: {other:?}"),
    };
    for precision in [64, 256] {
        let interval = match enclose(&tree, &context, precision) {
            Ok(Outcome::Value(interval)) => interval,
            other => panic!("{formula}: {other:?}"),
        };
        let finer = value.enclose(2 * precision);
        assert!(
            interval.overlaps(&finer),
            "{formula}: {interval:?} without {value}"
        );
        if let Some(rational) = value.as_rational() {
            assert!(
                interval.contains_rational(&rational),
                "{formula}: {interval:?}"
            );
        }
    }
    let close = value.enclose(64).midpoint().to_f64();
    let plain = float(&tree, &context).expect(formula);
    let scale = close.abs().max(1e-3);
    assert!(
        (plain - close).abs() <= 1e-6 * scale,
        "{formula}: {plain} is not {close}"
    );
}

#[test]
fn all_evaluators_agree_on_the_table() {
    for (formula, laws, points) in TABLE {
        for values in points.split(';') {
            check(formula, &Case::new(values, laws));
        }
    }
}

/// Identities of the thesis, exact at points.
#[test]
fn closed_forms_meet_their_means() {
    let ball = "r ~ beta(k, n-k+1)";
    let shell = "x ~ beta(l, m-l+1)";
    let cases = [
        ("mean(I*k/(n*r)) == I*k/(k-1)", ball, "k=3,n=7,I=2"),
        (
            "var(I*k/(n*r)) == I^2*k^2*(-k+n+1)/((k-2)*(k-1)^2*n)",
            ball,
            "k=3,n=7,I=2",
        ),
        ("mean(I*k/(n*r)) == +inf", ball, "k=1,n=7,I=2"),
        (
            "mean(k/(Va + V*x)) == k*hyp2f1(1, l; m+1; -V/Va)/Va",
            shell,
            "k=6,Va=4,V=3,l=2,m=3",
        ),
        (
            "mean((k/(Va + V*x))^2) == k^2*((Va*(-m) + Va - l*V + V)*hyp2f1(1, l; m+1; -V/Va) + Va*m)/(Va^2*(Va + V))",
            shell,
            "k=6,Va=4,V=3,l=2,m=3",
        ),
        (
            "hyp2f1r(1, 1; 2; -V/Va) == Va*ln((V + Va)/Va)/V",
            "",
            "V=3,Va=7/5",
        ),
        (
            "int(2*I*k/r, r = sqrt((k-1)/n)..sqrt(k/n)) == I*k*(ln(k) - ln(k-1))",
            "",
            "k=6,n=9,I=3",
        ),
        (
            "lim(mean(I*k/(k - l + v*x)), m -> 1, l -> 1) == I*k*ln(k/(k-1))",
            shell,
            "k=6,l=2,m=3,v=1,I=3",
        ),
        (
            "density(r, t) == n!/((k-1)!*(n-k)!)*(t^2)^(k-1)*(1-t^2)^(n-k)*2*t",
            "r ~ order(k, n) of density 2*s on 0..1",
            "k=3,n=5,t=2/7",
        ),
    ];
    for (condition, laws, values) in cases {
        let condition = condition.replace("+inf", "inf");
        assert_eq!(
            Case::new(values, laws).holds(&condition),
            Ok(true),
            "{condition}"
        );
    }
    let case = Case::new("V=3,Va=7", "");
    assert_eq!(
        case.holds("hyp2f1r(1, 1; 2; V/Va) == Va*ln((V + Va)/Va)/V"),
        Ok(false)
    );
}

#[test]
fn what_has_no_value_is_said_so_and_what_is_unknown_is_not() {
    let no_value = [
        ("1/0", "", ""),
        ("ln(0)", "", ""),
        ("ln(-2)", "", ""),
        ("sqrt(-1)", "", ""),
        ("(-2)^(1/2)", "", ""),
        ("0^-1", "", ""),
        ("gamma(0)", "", ""),
        ("gamma(-3)", "", ""),
        ("(-1)!", "", ""),
        ("hyp2f1(1, 1; 2; 1)", "", ""),
        ("hyp2f1(1, 1; 2; 2)", "", ""),
        ("inf - inf", "", ""),
        ("0*inf", "", ""),
        ("1/inf", "", ""),
        ("int(1/x, x = -1..1)", "", ""),
        ("int(x, x = -inf..inf)", "", ""),
        ("mean(1/x)", "x ~ beta(0, 1)", ""),
        ("mean(x)", "x ~ uniform(1, 1)", ""),
        ("mean(x)", "x ~ order(3, 2) of uniform(0, 1)", ""),
        ("var(1/x)", "x ~ beta(1, 3)", ""),
        ("mean(1/x - 1/(1-x))", "x ~ beta(1, 1)", ""),
    ];
    for (formula, laws, values) in no_value {
        let outcome = Case::new(values, laws).exact(formula);
        assert_eq!(outcome, Ok(Outcome::Undefined), "{formula}");
    }
    let infinite = [
        ("mean(1/x)", "x ~ beta(1, 3)", ""),
        ("var(1/x)", "x ~ beta(2, 3)", ""),
        ("int(1/x, x = 0..1)", "", ""),
        ("int(1/x, x = 1..inf)", "", ""),
        ("mean(1/(1-x)^2)", "x ~ beta(1, 2)", ""),
        ("2*int(1/x^2, x = 0..1) + 3", "", ""),
    ];
    for (formula, laws, values) in infinite {
        let outcome = Case::new(values, laws).exact(formula);
        assert_eq!(outcome, Ok(Outcome::PlusInfinity), "{formula}");
    }
    let unknown = [
        "int(1/(1+x^2), x = 0..1)",
        "2^(10^12)",
        "(10^9)!",
        "diff(abs(x), x)",
        "exp(1)",
        "q",
    ];
    for formula in unknown {
        assert!(Case::new("x=0", "").exact(formula).is_err(), "{formula}");
    }
}

#[test]
fn enclosures_reach_where_exact_values_do_not() {
    let cases = [
        (
            "k*ln(k/(k-1))",
            "",
            "k=10000000000000000000000000000000000000000",
        ),
        (
            "gamma(k-1)/gamma(k)*k",
            "",
            "k=10000000000000000000000000000000000000000",
        ),
        ("hyp2f1(1, l; l+1; -1/l)", "", "l=100000"),
        ("exp(1) + sin(1)*cos(2)", "", ""),
        ("mean(1/(3 + 2*x))", "x ~ beta(5/2, 1/3)", ""),
        (
            "mean(x^2*(1-x)/(3 + 2*x)^2)",
            "x ~ beta(100000, 700000)",
            "",
        ),
        ("2^pi", "", ""),
    ];
    for (formula, laws, values) in cases {
        match Case::new(values, laws).ladder(formula, 40) {
            Ok(Outcome::Value(interval)) => assert!(interval.agrees_to(40), "{formula}"),
            other => panic!("{formula}: {other:?}"),
        }
    }
}

#[test]
fn zero_is_never_concluded_from_a_small_enclosure() {
    let case = Case::new("", "");
    let outcome = case.ladder("exp(1)^2 - exp(2)", 20);
    assert!(matches!(outcome, Err(Failure::Undecided(_))), "{outcome:?}");
    assert!(case.holds("exp(1)^2 == exp(2)").is_err());
    assert_eq!(case.holds("exp(1) < 2.72 and exp(1) > 2.71"), Ok(true));
    assert_eq!(case.holds("1/0 == 1/0 or 1 < 0"), Ok(false));
}

#[test]
fn a_spent_budget_is_a_failure() {
    let mut case = Case::new("k=5", "");
    case.budget = Budget::new(10);
    assert_eq!(case.exact("sum(1/j, j = 1..1000)"), Err(Failure::Exhausted));
}
