//! Small propositions: each proof that is found must replay, as a script and as text.

use super::Builder;
use crate::formula::{Formula, Point, Proposition, Statement, parse_formula, parse_proposition};
use crate::kernel::proof::{Certificate, Script, Step, replay};

/// The sides of the first link.
fn sides(p: &Proposition) -> (Formula, Formula) {
    match &p.statement {
        Statement::Chain { first, links, .. } => (first.clone(), links[0].1.clone()),
        _ => panic!("a chain"),
    }
}

fn point(text: &str) -> Point {
    let mut point = Point::default();
    for part in text.split(',').filter(|part| !part.is_empty()) {
        let (name, value) = part.split_once('=').expect("name=value");
        let value = match value.split_once('/') {
            Some((n, d)) => crate::formula::Rational::new(
                n.parse::<i64>().expect("n").into(),
                d.parse::<i64>().expect("d").into(),
            ),
            None => crate::formula::Rational::from_integer(value.parse::<i64>().expect("n").into()),
        };
        point.numbers.insert(name.trim().into(), value);
    }
    point
}

/// The script for the first link of a proposition.
fn script(
    text: &str,
    at: &str,
    prove: impl FnOnce(&mut Builder, &Formula, &Formula) -> Option<Step>,
) -> Script {
    let p = parse_proposition(text).expect(text);
    let (a, b) = sides(&p);
    let mut builder = Builder::new(&p);
    let Some(step) = prove(&mut builder, &a, &b) else {
        panic!("{text}: {}", builder.refusal());
    };
    let refusal = builder.refusal().to_string();
    let script = builder.script(vec![(0, step)], point(at));
    let script = script.unwrap_or_else(|| panic!("{text}: no script, {refusal}"));
    let certificate = Certificate::Theorem(script.clone()).to_string();
    replay(&certificate).unwrap_or_else(|flaw| panic!("{certificate}\n{flaw}"));
    script
}

fn proves(text: &str, at: &str) -> Script {
    script(text, at, |builder, a, b| builder.equal(a, b))
}

/// Whether the sign is found: 1 positive, 0 nonnegative, 2 nonzero.
fn sign(given: &str, e: &str, sign: i64) -> bool {
    let p = parse_proposition(&format!("{given}\nsays 1 == 1")).expect(given);
    let mut builder = Builder::new(&p);
    let e = parse_formula(e).expect(e);
    let found = match sign {
        1 => builder.positive(&e),
        0 => builder.nonnegative(&e),
        _ => builder.nonzero(&e),
    };
    found.is_some()
}

const SHELL: &str = "given int k, l, m, n; real a, b
domain 1 <= l <= m
domain l <= k <= n
domain m - l <= n - k
domain 0 <= a < b <= 1";

#[test]
fn signs() {
    assert!(sign(SHELL, "n", 1));
    assert!(sign(SHELL, "m - l + 1", 1));
    assert!(sign(SHELL, "n - k + 1", 1));
    assert!(sign(SHELL, "k - 1", 0));
    assert!(!sign(SHELL, "k - 1", 1));
    assert!(sign(SHELL, "1 - a", 1));
    assert!(sign(SHELL, "a - b", 2));
    assert!(sign(SHELL, "b^2 - a^2", 1));
    assert!(sign(SHELL, "b^3 - a^3", 1));
    assert!(sign(SHELL, "1 - (-(b^2 - a^2)/b^2)", 1));
    assert!(sign(SHELL, "(a + b)/(b^3 - a^3)*k", 1));
    assert!(sign("given int m\ndomain m >= 2", "m*(m-1)/2", 1));
    assert!(sign(
        "given int m, l\ndomain m >= 1\ndomain 1 <= l <= m",
        "m*(m-1)/2 + l",
        1
    ));
    assert!(sign("given int k\ndomain k >= 3", "(k-1)^2*(k-2)", 1));
    assert!(sign("given int k\ndomain k >= 3", "(1-k)^2*(2-k)", 2));
    assert!(sign("given int k\ndomain k != 1", "(1-k)^2", 1));
    assert!(sign(
        "given real x, p\ndomain 0 < x < 1\ndomain p > 0",
        "x^p*(1-x)^(p-1) + x",
        1
    ));
}

#[test]
fn rational_identities() {
    proves(
        "given int k, n; real I, r\ndomain 1 <= k <= n\ndomain 0 < r <= 1\nsays I*k/(r*n) == (I/n)*k/r",
        "k=1,n=1,I=1,r=1",
    );
    proves(
        "given real x\ndomain x > 0\nsays (x^2 - 1)/x == x - 1/x",
        "x=1",
    );
}
