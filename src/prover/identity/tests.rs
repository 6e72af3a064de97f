//! Small propositions: each proof that is found must replay, as a script and as text.

use super::Builder;
use crate::formula::{Formula, Point, Proposition, Statement, parse_formula, parse_proposition};
use crate::kernel::proof::{Certificate, Fact, Rule, Script, Step, replay};

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
        panic!("{text}: no proof");
    };
    let script = builder.script(vec![(0, step)], point(at));
    let script = script.unwrap_or_else(|| panic!("{text}: no script"));
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

#[test]
fn gamma_shifts() {
    let kn = "given int k, n; real I\ndomain 2 <= k <= n\n";
    proves(
        &format!("{kn}says I*k*gamma(k-1)/gamma(k) == I*k/(k-1)"),
        "k=2,n=2,I=1",
    );
    proves(
        &format!("{kn}says n!/((k-1)!*(n-k)!) == k*binomial(n, k)"),
        "k=2,n=3,I=1",
    );
    proves(
        &format!("{kn}says beta(k, n-k+1)*n!/((k-1)!*(n-k)!) == 1"),
        "k=2,n=3,I=1",
    );
    proves(
        &format!("{kn}says beta(k-1, n-k+1)/beta(k, n-k+1) == n/(k-1)"),
        "k=2,n=3,I=1",
    );
    proves(
        &format!("{kn}says pochhammer(k, n)*gamma(k) == (n+k-1)!"),
        "k=2,n=3,I=1",
    );
    proves(&format!("{kn}says gamma(4)*k == 3!*k"), "k=2,n=3,I=1");
    proves(
        "given int k, n; real I\ndomain 3 <= k <= n\nsays I^2*k^2*n!*beta(k-2, n-k+1)/(n^2*(k-1)!*(n-k)!) - (I*(k/(k-1)))^2 == I^2*k^2*(-k+n+1)/((k-2)*(k-1)^2*n)",
        "k=3,n=3,I=1",
    );
}

#[test]
fn powers_of_one_base() {
    let x = "given int k, l, m; real x, r, a, b\ndomain 1 <= l <= m\ndomain k >= 2\ndomain 0 < x < 1\ndomain 0 < r\ndomain 0 < a < b\n";
    let at = "k=2,l=1,m=2,x=1/2,r=1,a=1,b=2";
    proves(&format!("{x}says x^(k-1)/x == x^(k-2)"), at);
    proves(&format!("{x}says (r^2)^(k-1)*2*r == 2*r^(2*k-1)"), at);
    proves(&format!("{x}says (r^3)^(k-1)*r^(-1)*3 == 3*r^(3*k-4)"), at);
    proves(
        &format!("{x}says x^(l-1)*(1-x)^(m-l)/x^l == (1-x)^(m-l+1)/(x*(1-x))"),
        at,
    );
    proves(&format!("{x}says (x*(1-x))^(l-1) == x^l*(1-x)^(l-1)/x"), at);
    proves(&format!("{x}says x^(k-l)*x^(l-1) == x^(k-1)"), at);
    proves(
        &format!("{x}says (1-(r-a)/(b-a))^k*(b-a)^k == ((b-r)/(b-a))^k*(b-a)^k"),
        at,
    );
    proves(&format!("{x}says sqrt(r)^2 == r"), at);
    proves(&format!("{x}says sqrt(r/a)*sqrt(a) == sqrt(r)"), at);
    proves(&format!("{x}says 1/((r/a)^(1/3))^3 == a/r"), at);
    proves(&format!("{x}says (r*a)^(5/2)/r^2 == a^2*(r*a)^(1/2)"), at);
}

#[test]
fn logarithms() {
    let k = "given int k, n; real I\ndomain 2 <= k <= n\n";
    let at = "k=2,n=3,I=1";
    proves(
        &format!("{k}says I*k*(ln(k/n) - ln((k-1)/n)) == I*k*ln(k/(k-1))"),
        at,
    );
    proves(
        &format!("{k}says 2*ln(sqrt(k/n)) - 2*ln(sqrt((k-1)/n)) == ln(k) - ln(k-1)"),
        at,
    );
    proves(&format!("{k}says 3*ln((k/n)^(1/3)) == ln(k) - ln(n)"), at);
    proves(&format!("{k}says ln((k-1)/k)^2 == (ln(k) - ln(k-1))^2"), at);
    proves(&format!("{k}says ln(k^2-1) == ln(k+1) + ln(k-1)"), at);
    proves(&format!("{k}says ln(1)*k == 0"), at);
    proves(
        "given real Va, V\ndomain Va > 0\ndomain V > 0\nsays ln(1 + V/Va) == ln((Va+V)/Va)",
        "Va=1,V=1",
    );
}

/// By cases at the border, where neither side has a value.
fn equal_or_split(builder: &mut Builder, a: &Formula, b: &Formula) -> Option<Step> {
    let fact = Fact::Same(a.clone(), b.clone());
    builder.by_cases(&fact, &[a.clone(), b.clone()], 2, &mut |builder| {
        builder.attempt(|builder| builder.equal(a, b)).or_else(|| {
            builder.undefined(a)?;
            builder.undefined(b)?;
            builder.step(fact.clone(), Rule::None, &[], &[])
        })
    })
}

#[test]
fn borders() {
    script(
        "given int k; real I\ndomain k >= 1\nsays I/(k-1) + ln(k-1) == I*k/(k-1)+ln(k-1)-I",
        "k=2,I=1",
        equal_or_split,
    );
    script(
        "given int l, m; real I\ndomain 1 <= l <= m\nsays l/(m*(m-1)/2 + l - l) == 2*l/(m*(m-1))",
        "l=1,m=2,I=1",
        equal_or_split,
    );
    script(
        "given real Va, V\ndomain Va >= 0\ndomain V > 0\nsays Va*ln((Va+V)/Va)/V == (ln(Va+V)-ln(Va))*Va/V",
        "Va=1,V=1",
        equal_or_split,
    );
    script(
        "given int k; real r, I\ndomain k >= 1\ndomain 0 <= r <= 1\nsays I*k/(2*r) == I/(r+r)*k",
        "k=1,r=1,I=1",
        equal_or_split,
    );
}

#[test]
fn order_of_powers() {
    let kn = "given int k, n; real r\ndomain 1 <= k <= n\n";
    let kn = kn.trim_end();
    assert!(sign(kn, "1 - sqrt(k/n)", 0));
    assert!(sign(kn, "sqrt(k/n) - sqrt((k-1)/n)", 1));
    assert!(sign(kn, "1 - (k/n)^(1/3)", 0));
    assert!(sign(kn, "(k/n)^(1/3) - ((k-1)/n)^(1/3)", 1));
    let between = format!("{kn}\ndomain sqrt((k-1)/n) < r < sqrt(k/n)");
    assert!(sign(&between, "r", 1));
    assert!(sign(&between, "1 - r", 0));
    let closed = format!("{kn}\ndomain k >= 2\ndomain ((k-1)/n)^(1/3) <= r <= (k/n)^(1/3)");
    assert!(sign(&closed, "r^3", 1));
    assert!(sign(
        "given int k; real r\ndomain 0 < r < 1\ndomain k >= 1",
        "1 - r^k",
        1
    ));
}

#[test]
fn relations_with_denominators() {
    let given = "given int k, n; real r\ndomain 2 <= k <= n\ndomain (k-1)/n <= r <= k/n";
    assert!(sign(given, "r", 1));
    assert!(sign(given, "1 - r", 0));
    assert!(sign(given, "r*n + 1 - k", 0));
    assert!(sign(given, "k/n - (k-1)/n", 1));
}

/// Proves the only link of a proposition by the tactics.
fn proved(text: &str, at: &str) {
    let p = parse_proposition(text).expect(text);
    let script = super::prove(&p, &[point(at)]).unwrap_or_else(|| panic!("{text}"));
    let certificate = Certificate::Theorem(script).to_string();
    replay(&certificate).unwrap_or_else(|flaw| panic!("{certificate}\n{flaw}"));
}

#[test]
fn substitution_in_the_unit_range() {
    proved(
        "given int k, n\ndomain 1 <= k <= n\ndraw R ~ order(k, n) of density x -> 3*x^2 on 0..1\nsays mean(R^3) == k/(n+1)",
        "k=1,n=2",
    );
}

#[test]
fn bounded_variables() {
    proved(
        "given int l, m; real a, b\ndomain 1 <= l <= m\ndomain 0 < a < b\nsays hyp2f1(1, l; m+1; -(b^3-a^3)/a^3) == a^3*int(x^(l-1)*(1-x)^(m-l)/(a^3+(b^3-a^3)*x), x = 0..1)/beta(l, m-l+1)",
        "l=1,m=2,a=1,b=2",
    );
}

#[test]
fn means_over_two_laws() {
    proved(
        "given int d, k, n\ndomain d >= 1\ndomain 1 <= k <= n\ndraw R ~ order(k, n) of density x -> d*x^(d-1) on 0..1\nsays var(1/R^d) == var(1/x, x ~ beta(k, n-k+1))",
        "d=1,k=3,n=3",
    );
    proved(
        "given int k\ndomain k >= 1\ndraw R ~ density x -> 2*x on sqrt(k-1)..sqrt(k)\nsays mean(1/R^2) == mean(1/x, x ~ uniform(k-1, k))",
        "k=2",
    );
}

#[test]
fn constants_in_means() {
    proved(
        "given int k, n; real I\ndomain 1 <= k <= n\ndraw R ~ beta(k, n-k+1)\nsays var(I/R - 1/k) == var(I/R)",
        "k=3,n=3,I=1",
    );
    proved(
        "given real a, b\ndraw X ~ any\nsays var(a + b*X) == b^2*var(X)",
        "a=1,b=1",
    );
    proved(
        "given real a\ndraw X ~ uniform(0, 1)\nsays mean(a*X^2 - 3*X) == a*mean(X^2) - 3*mean(X)",
        "a=1",
    );
    proved(
        "draw X ~ any\nsays var(X^2) == mean((X^2 - mean(X^2))^2)",
        "",
    );
}

#[test]
fn conditions_of_draws() {
    let given = "given real a, b\ndomain 0 <= a <= b and b > 0\ndraw X ~ uniform(0, 1)\nsays ";
    for says in [
        "prob(X <= 2) == 1",
        "prob(X^2 < 0) == 0",
        "prob(sqrt(X*b^2) <= a) == a^2/b^2",
        "prob((X*b^3)^(1/3) > a) == 1 - a^3/b^3",
        "mean([a/b < X < 1]*X) == 1/2 - (a/b)^2/2",
    ] {
        proved(&format!("{given}{says}"), "a=1,b=2");
    }
}

#[test]
fn derivatives() {
    for (text, at) in [
        (
            "given real x\nsays diff(x^2*exp(-x), x) == (2*x - x^2)*exp(-x)",
            "x=1",
        ),
        (
            "given real x, y\ndomain 0 < x < y\nsays diff(ln(x*(y - x)), x) == 1/x - 1/(y - x)",
            "x=1,y=2",
        ),
        (
            "given int d; real x\ndomain d >= 1\nsays diff((x^d + 1)^2, x) == 2*d*x^(d-1)*(x^d + 1)",
            "d=1,x=0",
        ),
        (
            "given real x\nsays diff(1/sin(x), x) == -cos(x)/sin(x)^2",
            "x=1",
        ),
        (
            "given real x\nsays cos(x)*diff(sin(x), x) == 1 - sin(x)^2",
            "x=0",
        ),
        (
            "given real x\ndomain x > 0\nsays int(ln(x), x) == x*ln(x) - x",
            "x=1",
        ),
    ] {
        proved(text, at);
    }
}

#[test]
fn discs() {
    let text = "given real r, c\ndomain r > 0\ndomain c > 0\n";
    for says in [
        "int(sqrt(r^2 - x^2), x = -r..r) == pi*r^2/2",
        "int(c*sqrt(2*r*x - x^2), x = 0..2*r)/c == pi*r^2/2",
        "int(sin(x)/r, x = 0..pi) == 2/r",
    ] {
        proved(&format!("{text}says {says}"), "r=1,c=2");
    }
}

#[test]
fn integrals_with_other_ends() {
    for (text, at) in [
        (
            "given real x\nsays int(1/(1 + t^2), t = 0..x) == int(2/(2 + 2*t^2), t = 0..x)",
            "x=1",
        ),
        (
            "given real x\nsays int(1/(1 + t^2), t = 0..-x) == -int(1/(1 + t^2), t = 0..x)",
            "x=0",
        ),
        (
            "given real x, y\ndomain 0 < x < y\nsays int(exp(-t^2), t = 0..y) == int(exp(-t^2), t = x..y) + int(exp(-s^2), s = 0..x)",
            "x=1,y=2",
        ),
        (
            "given real x\ndomain x > 1\nsays int(t, t = min(x, 1)..max(0, x)) == (x^2 - 1)/2",
            "x=2",
        ),
    ] {
        proved(text, at);
    }
}

#[test]
fn signs_with_roots() {
    assert!(sign("given real x", "x^2 - sqrt(2)*x + 1", 1));
    assert!(sign("given real x", "2*x^2 + 3*x*sqrt(5) + 6", 1));
    assert!(!sign("given real x", "x^2 - sqrt(5)*x + 1", 1));
    assert!(sign("given real x", "3 - sqrt(2)^2", 1));
    assert!(sign("given real x\ndomain -pi/2 < x < 0", "cos(x)", 1));
    assert!(!sign("given real x\ndomain -pi < x < 0", "cos(x)", 2));
}
