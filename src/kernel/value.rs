//! The value of a closed formula at an exact point, and of an integrand as a function of its
//! variable: one walk for both.
//!
//! Evaluation is strict: a part without value leaves none to the whole. That a formula has no value
//! is claimed for an exact reason only; an enclosure that touches a forbidden number is an
//! [`Unknown`], and more bits may settle it.

use super::condition::{at_sample, holds};
use super::fraction::Fraction;
use super::functions::{self, SIZE_CAP};
use super::interval::Interval;
use super::polynomial::Polynomial;
use super::quantity::{Quantity, Value, as_value};
use super::scope::{Scope, full_tank};
use super::{Found, Unknown, calculus, hypergeometric, integrand, law, unknown};
use crate::formula::{Draw, Formula, Function, Name, Operator, Point, RangeKind, Ranged, Rational};
use num_bigint::BigInt;
use num_traits::{One, ToPrimitive};
use std::cmp::Ordering;

/// No value is asked for with more bits.
const BITS_CAP: u32 = 1 << 14;
/// No range of more terms is walked.
const TERMS_CAP: u64 = 100_000;

/// The value of a formula with all names given by the point, means over the draws. A finite value
/// is exact or enclosed with a relative width of about 2^-bits, less what cancels.
///
/// # Errors
/// [`Unknown`] where the kernel has no rule, the work is too much, or `bits` do not settle it.
pub fn value(
    formula: &Formula,
    point: &Point,
    draws: &[Draw],
    bits: u32,
) -> Result<Value, Unknown> {
    if bits > BITS_CAP {
        return unknown("more bits than the kernel computes with");
    }
    let fuel = full_tank();
    as_value(evaluate(
        formula,
        &Scope::new(point, draws, bits.into(), &fuel),
    ))
}

/// What a formula comes to in a scope.
pub(super) fn evaluate(f: &Formula, scope: &Scope) -> Found<Quantity> {
    scope.spend(1)?;
    let result = match f {
        Formula::Number(q) => Interval::exact(q.clone()).into(),
        Formula::Name(name) => scope.look_up(name)?,
        Formula::Binary(operator, a, b) => binary(*operator, a, b, scope)?,
        _ => other(f, scope)?,
    };
    Ok(rounded(result, scope)?)
}

/// All but the deep trees: its own function, to keep the frames of [`evaluate`] small.
fn other(f: &Formula, scope: &Scope) -> Found<Quantity> {
    Ok(match f {
        Formula::Pi => functions::pi(scope.bits)?.into(),
        Formula::Infinity => Quantity::Infinite(Ordering::Greater),
        Formula::Negate(a) => evaluate(a, scope)?.negated(),
        Formula::Factorial(a) => {
            let factorial = functions::factorial(whole(&number(a, scope)?)?)?;
            Interval::integer(factorial).into()
        }
        Formula::Call(function, parts) => call(*function, parts, scope)?,
        Formula::Apply(name, parts) => apply(name, parts, scope)?,
        Formula::Ranged(r) => match r.kind {
            RangeKind::Integral => integrand::integral(r, scope)?,
            RangeKind::Sum => sum(r, scope)?,
            _ => return unknown("a bound over a range"),
        },
        Formula::Derivative(a, x, order) => calculus::derivative(a, x, order, scope)?,
        Formula::At(a, places) => at(a, places, scope)?,
        Formula::Limit(a, places) => calculus::limit(a, places, scope)?,
        Formula::Indicator(c) => Interval::integer(u8::from(holds(c, scope)?)).into(),
        Formula::If(c, a, b) => evaluate(if holds(c, scope)? { a } else { b }, scope)?,
        Formula::Mean(a, own) => law::mean(a, own.as_deref(), scope)?,
        Formula::Variance(a, own) => law::variance(a, own.as_deref(), scope)?,
        Formula::Probability(c, own) => law::probability(c, own.as_deref(), scope)?,
        Formula::Density(drawn, place) => law::density_at(drawn, place, scope)?,
        Formula::Cumulative(drawn, place) => law::cumulative_at(drawn, place, scope)?,
        Formula::Antiderivative(..) => return unknown("an antiderivative has no one value"),
        Formula::BigO(_) | Formula::LittleO(_) => return unknown("an O-term has no value"),
        _ => return unknown("a condition in the place of a number"),
    })
}

/// A formula that must be finite.
pub(super) fn finite(f: &Formula, scope: &Scope) -> Found<Fraction> {
    Ok(evaluate(f, scope)?.finite()?)
}

/// A formula that must be a finite number.
pub(super) fn number(f: &Formula, scope: &Scope) -> Found<Interval> {
    Ok(evaluate(f, scope)?.number()?)
}

/// The quantity with its enclosures rounded, paid for by its size.
fn rounded(quantity: Quantity, scope: &Scope) -> Result<Quantity, Unknown> {
    let Quantity::Finite(fraction) = quantity else {
        return Ok(quantity);
    };
    let mut coefficients = Vec::new();
    for c in fraction.numerator.coefficients() {
        let c = match c.as_exact() {
            Some(_) => c.clone(),
            None => c.rounded(scope.bits),
        };
        if c.size() > SIZE_CAP {
            return unknown("a number that is too large");
        }
        scope.spend(c.size() / 64)?;
        coefficients.push(c);
    }
    let numerator = Polynomial::new(coefficients);
    let poles = fraction.poles;
    Ok(Quantity::Finite(Fraction { numerator, poles }))
}

fn binary(operator: Operator, a: &Formula, b: &Formula, scope: &Scope) -> Found<Quantity> {
    if operator == Operator::Power {
        return power(a, b, scope);
    }
    let (left, right) = (evaluate(a, scope)?, evaluate(b, scope)?);
    if let (Quantity::Finite(a), Quantity::Finite(b)) = (&left, &right) {
        scope.spend((a.numerator.length() * b.numerator.length()) as u64)?;
    }
    match operator {
        Operator::Add => left.plus(&right),
        Operator::Subtract => left.plus(&right.negated()),
        Operator::Multiply => left.times(&right),
        _ => left.times(&right.reciprocal()?),
    }
}

/// a^b, where b is a number.
fn power(a: &Formula, b: &Formula, scope: &Scope) -> Found<Quantity> {
    let exponent = number(b, scope)?;
    if let Some((base, exponent)) = power_of_root(a, &exponent, scope)? {
        return Ok(functions::power(&base, &exponent, scope.bits)?.into());
    }
    let mut base = finite(a, scope)?;
    if let Some(base) = base.as_number() {
        return Ok(functions::power(&base, &exponent, scope.bits)?.into());
    }
    let Some(n) = exponent.as_integer().and_then(|n| n.to_i32()) else {
        return unknown("a power inside an integral that is no integer power");
    };
    if n < 0 {
        base = base.reciprocal()?;
    }
    let steps = u64::from(n.unsigned_abs()) * base.numerator.length() as u64;
    scope.spend(steps.saturating_mul(steps))?;
    Ok(base.power(n.unsigned_abs())?.into())
}

/// (q^r)^n as q^(r*n), for q > 0: ends of ranges are often roots, and their powers are exact.
fn power_of_root(
    base: &Formula,
    exponent: &Interval,
    scope: &Scope,
) -> Found<Option<(Interval, Interval)>> {
    let (radicand, root) = match base {
        Formula::Call(Function::Sqrt, parts) => (&parts[0], Rational::new(1.into(), 2.into())),
        Formula::Binary(Operator::Power, q, r) => match number(r, scope)?.as_exact() {
            Some(root) if !root.is_integer() => (&**q, root.clone()),
            _ => return Ok(None),
        },
        _ => return Ok(None),
    };
    let radicand = number(radicand, scope)?;
    if exponent.as_integer().is_none() || !radicand.is_positive() {
        return Ok(None);
    }
    Ok(Some((radicand, exponent * &Interval::exact(root))))
}

/// A function that the point gives, which knows its argument only.
fn apply(name: &Name, parts: &[Formula], scope: &Scope) -> Found<Quantity> {
    let ([place], Some((argument, body))) = (parts, scope.point.functions.get(name)) else {
        return unknown("a function that is not given, or of several arguments");
    };
    let nothing = Point::default();
    evaluate(
        body,
        &scope.closed(&nothing, argument, finite(place, scope)?),
    )
}

/// The formula with names standing for other values, all of them taken outside.
fn at(a: &Formula, places: &[(Name, Formula)], scope: &Scope) -> Found<Quantity> {
    let mut inner = scope.clone();
    for (name, place) in places {
        let value = finite(place, scope)?;
        if value.as_number().is_none() {
            // The cuts of an integral do not see comparisons of such a name.
            inner.sample = None;
        }
        inner = inner.with(name, value);
    }
    evaluate(a, &inner)
}

/// A function of the language.
fn call(function: Function, parts: &[Formula], scope: &Scope) -> Found<Quantity> {
    if let (Function::Abs, [part]) = (function, parts) {
        return absolute(evaluate(part, scope)?, scope);
    }
    scope.spend(scope.bits / 8)?;
    let numbers: Found<Vec<Interval>> = parts.iter().map(|part| number(part, scope)).collect();
    Ok(of_numbers(function, &numbers?, scope)?.into())
}

/// The absolute value; of a function, by its sign at the sample.
fn absolute(value: Quantity, scope: &Scope) -> Found<Quantity> {
    if let Ok(number) = value.clone().number() {
        return Ok(number.absolute().into());
    }
    match at_sample(&value, scope)?.sign()? {
        Ordering::Less => Ok(value.negated()),
        _ => Ok(value),
    }
}

fn of_numbers(function: Function, x: &[Interval], scope: &Scope) -> Found<Interval> {
    let bits = scope.bits;
    match (function, x) {
        (Function::Min, [first, rest @ ..]) => {
            Ok(rest.iter().fold(first.clone(), |a, b| a.minimum(b)))
        }
        (Function::Max, [first, rest @ ..]) => {
            Ok(rest.iter().fold(first.clone(), |a, b| a.maximum(b)))
        }
        (Function::Exp, [x]) => Ok(x.increasing(|q| functions::exp(q, bits))?),
        (Function::Sqrt, [x]) => {
            let half = Interval::exact(Rational::new(1.into(), 2.into()));
            functions::power(x, &half, bits)
        }
        (Function::Ln, [x]) => functions::logarithm(x, bits),
        (Function::Gamma, [x]) => functions::gamma(exact(x)?, bits),
        (Function::Beta, [a, b]) => functions::beta(exact(a)?, exact(b)?, bits),
        (Function::Binomial, [n, k]) => functions::binomial(n, whole(k)?),
        (Function::Pochhammer, [a, n]) => Ok(functions::pochhammer(a, whole(n)?)?),
        (Function::Hyp2F1, [a, b, c, z]) => {
            hypergeometric::hyp2f1([exact(a)?, exact(b)?, exact(c)?, exact(z)?], scope)
        }
        (Function::Hyp2F1Regularized, [a, b, c, z]) => {
            hypergeometric::regularized([exact(a)?, exact(b)?, exact(c)?, exact(z)?], scope)
        }
        _ => unknown("a function that the kernel has no rule for"),
    }
}

fn exact(x: &Interval) -> Result<&Rational, Unknown> {
    match x.as_exact() {
        Some(q) => Ok(q),
        None => unknown("a special function of what is not an exact rational"),
    }
}

fn whole(x: &Interval) -> Result<&BigInt, Unknown> {
    match x.as_integer() {
        Some(n) => Ok(n),
        None => unknown("a count that is not an exact integer"),
    }
}

/// A sum over a finite integer range, term by term. The empty range `a..a-1` sums to 0; a reversed
/// one is refused.
fn sum(r: &Ranged, scope: &Scope) -> Found<Quantity> {
    let (from, to) = (number(&r.from, scope)?, number(&r.to, scope)?);
    let count = whole(&to)? - whole(&from)? + BigInt::one();
    let Some(count) = count.to_u64().filter(|&count| count <= TERMS_CAP) else {
        return unknown("a range that is reversed or too long");
    };
    let mut sum = Quantity::from(Interval::integer(0));
    for j in 0..count {
        let index = &from + &Interval::integer(j);
        sum = sum.plus(&evaluate(&r.body, &scope.with(&r.name, index))?)?;
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{parse_formula, parse_law};
    use proptest::prelude::*;

    fn draw(name: &str, law: &str) -> Draw {
        Draw {
            name: name.into(),
            law: parse_law(law).expect(law),
        }
    }

    fn at(
        text: &str,
        numbers: &[(&str, i64, i64)],
        draws: &[Draw],
        bits: u32,
    ) -> Result<Value, Unknown> {
        let mut point = Point::default();
        for (name, a, b) in numbers {
            let number = Rational::new((*a).into(), (*b).into());
            point.numbers.insert((*name).into(), number);
        }
        value(&parse_formula(text).expect(text), &point, draws, bits)
    }

    fn closed(text: &str) -> Result<Value, Unknown> {
        at(text, &[], &[], 64)
    }

    fn exact(a: i64, b: i64) -> Result<Value, Unknown> {
        as_value(Ok(Interval::exact(Rational::new(a.into(), b.into())).into()))
    }

    fn enclosure(value: &Value) -> Interval {
        match value {
            Value::Finite { low, high } => Interval::between(low.clone(), high.clone()),
            other => panic!("{other:?}"),
        }
    }

    /// The difference of two formulas is enclosed around zero, and tightly.
    fn assert_agree(a: &str, b: &str, numbers: &[(&str, i64, i64)], draws: &[Draw]) {
        let difference = format!("({a}) - ({b})");
        let found = at(&difference, numbers, draws, 128)
            .unwrap_or_else(|why| panic!("{difference}: {why}"));
        let found = enclosure(&found);
        let tiny = Rational::new(1.into(), BigInt::one() << 90_u32);
        assert!(found.sign().is_err() || found.is_zero(), "{difference}");
        assert!(found.high() - found.low() < tiny, "{difference}");
    }

    #[test]
    fn no_value_is_claimed_where_it_is_proved() {
        for text in [
            "1/0",
            "0/0",
            "ln(0)",
            "ln(-1)",
            "sqrt(-2)",
            "(-8)^(1/3)",
            "0^-1",
            "gamma(0)",
            "(-1)!",
            "inf - inf",
            "0*inf",
            "1/inf",
            "hyp2f1(1, 1; 2; 1)",
            "0*(1/0)",
            "int(x/0, x = 1..1)",
            "int(1/x, x = -1..1)",
            "at(x/x, x = 0)",
            "sum(1/j, j = 0..3)",
            "exp(pi + 1/0)",
            "int(1/((x - x)^-2), x = 0..1)",
            "diff(ln(x), x) + at(diff(ln(x), x), x = -1)",
        ] {
            let found = at(text, &[("x", 1, 1)], &[], 64);
            assert_eq!(found, Ok(Value::Undefined), "{text}");
        }
        for text in [
            "1/(ln(2) - ln(2))",
            "ln(pi - pi)",
            "sum(j, j = 3..1)",
            "x",
            "2^2^100",
            "10^9!",
        ] {
            assert!(closed(text).is_err(), "{text}");
        }
    }

    #[test]
    fn exact_values() {
        for (text, a, b) in [
            ("0^0", 1, 1),
            ("2^-3", 1, 8),
            ("(9/4)^(3/2)", 27, 8),
            ("sum(j^2, j = 1..4)", 30, 1),
            ("sum(j, j = 1..0)", 0, 1),
            ("beta(3, 2)", 1, 12),
            ("binomial(5, 2) + binomial(5, -1)", 10, 1),
            ("binomial(1/2, 2)", -1, 8),
            ("pochhammer(1/2, 3)", 15, 8),
            ("abs(-3) + min(1, 2, -4) + max(1, 7)", 6, 1),
            ("gamma(5)/4!", 1, 1),
            ("[1 < 2 <= 2] + if(1 == 2, 5, 7) + [1/0 == 1/0]", 8, 1),
            ("int(x^2, x = 0..1)", 1, 3),
            ("int(x^2, x = 1..0)", -1, 3),
            ("int(abs(x), x = -1..2)", 5, 2),
            ("int([1/4 < x < 1/2]*x, x = 0..1)", 3, 32),
            ("int(x/x, x = 0..1)", 1, 1),
            ("int(int(s, s = 0..r)*r, r = 0..1)", 1, 8),
            ("at(diff(x^3, x, 2), x = 5)", 30, 1),
            ("at(diff(x/(1 + x), x), x = 1)", 1, 4),
            ("at(diff(int(t^2, t = 0..x), x), x = 3)", 9, 1),
            ("lim((x + 1)/(x + 2), x -> 0)", 1, 2),
            ("mean(x, x ~ uniform(1, 4))", 5, 2),
            ("var(x, x ~ uniform(0, 6))", 3, 1),
            ("prob(x < 1/3, x ~ beta(1, 2))", 5, 9),
            ("mean(x, x ~ order(2, 3) of uniform(0, 4))", 2, 1),
            ("hyp2f1(-1, 2; 4; 3)", -1, 2),
            ("int(diff(abs(x), x), x = -1..2)", 1, 1),
            ("int(int(s, s = 0..abs(r)), r = -1..1)", 1, 3),
            ("int(1/((x - x)^0) + 1/x^-2, x = 0..1)", 4, 3),
        ] {
            assert_eq!(closed(text), exact(a, b), "{text}");
        }
        assert!(closed("lim(x/x, x -> 0)").is_err());
        assert!(closed("lim(floor(x), x -> 0)").is_err());
    }

    #[test]
    fn infinite_values() {
        for text in [
            "int(1/x, x = 0..1)",
            "inf + 1",
            "-(-inf)",
            "mean(1/x, x ~ beta(1, 3))",
            "int(1/x^2, x = -1..1)",
        ] {
            assert_eq!(closed(text), Ok(Value::PlusInfinity), "{text}");
        }
    }

    /// At Va = 0 the mean of U^-p is finite for l > p only, and then it is a ratio of Betas.
    #[test]
    fn powers_of_the_volume() {
        let draws = [draw("x", "beta(l, m - l + 1)")];
        let mean = |l, p| {
            at(
                "mean(x^-p)",
                &[("l", l, 1), ("m", 5, 1), ("p", p, 1)],
                &draws,
                64,
            )
        };
        assert_eq!(mean(2, 2), Ok(Value::PlusInfinity));
        assert_eq!(mean(3, 2), exact(5 * 4, 2));
        assert_eq!(
            at("mean(x)", &[("l", 0, 1), ("m", 5, 1)], &draws, 64),
            Ok(Value::Undefined)
        );
    }

    /// The thesis's identities 2.28, 2.30, 2.45 and 2.49, at points where they hold.
    #[test]
    fn identities_of_the_thesis() {
        let draws = [draw("x", "beta(l, m - l + 1)")];
        let f = "hyp2f1(1, l; m + 1; -V/Va)";
        for (l, m, a, b) in [(1, 1, 3, 1), (2, 5, 7, 2), (4, 4, 1, 9), (3, 12, 55, 1)] {
            let numbers = [("l", l, 1), ("m", m, 1), ("Va", a, b), ("V", 5, 3)];
            assert_agree("mean(1/(Va + V*x))", &format!("{f}/Va"), &numbers, &draws);
            let second = format!("((-Va*m + Va - l*V + V)*{f} + Va*m)/(Va^2*(Va + V))");
            assert_agree("mean(1/(Va + V*x)^2)", &second, &numbers, &draws);
        }
        let numbers = [("k", 4, 1), ("n", 7, 1), ("I", 3, 2)];
        assert_agree(
            "int(2*I*k/r, r = sqrt((k-1)/n)..sqrt(k/n))",
            "I*k*ln(k/(k-1))",
            &numbers,
            &[],
        );
        assert_agree(
            "var(I*k/(n*r), r ~ uniform((k-1)/n, k/n))",
            "I^2*k*(1/(k-1) - k*ln((k-1)/k)^2)",
            &numbers,
            &[],
        );
        let root = "int(n*[sqrt((k-1)/n) < r < sqrt(k/n)]*2*r*I*k/(n*r^2), r = 0..1)";
        assert_agree(root, "I*k*(ln(k) - ln(k-1))", &numbers, &[]);
    }

    /// What the rules of calculus say where they do not hold is no value.
    #[test]
    fn derivatives_claim_nothing_beyond_their_rules() {
        for text in [
            // The integral is infinite around x = 1: its ends alone would give 1.
            "at(diff(int(1/t, t = 0..x), x), x = 1)",
            // y*abs(y) has the derivative 0 at 0, which the rule does not see.
            "at(int(diff(y*abs(y)*x, y), x = 0..1), y = 0)",
        ] {
            assert!(closed(text).is_err(), "{text}");
        }
    }

    /// A draw of a mean's own is not the parameter of the same name.
    #[test]
    fn an_own_draw_hides_a_parameter() {
        for text in [
            "mean(sum(1, j = 1..k), k ~ uniform(0, 2))",
            "mean(x*sum(1, j = 1..x), x ~ uniform(0, 2))",
        ] {
            assert!(at(text, &[("k", 3, 1), ("x", 3, 1)], &[], 64).is_err());
        }
        let found = at("mean(k, k ~ uniform(0, k))", &[("k", 3, 1)], &[], 64);
        assert_eq!(found, exact(3, 2));
        assert!(at("density(x, inf)", &[], &[draw("x", "uniform(0, 1)")], 64).is_err());
    }

    #[test]
    fn a_bound_name_hides_a_parameter() {
        // The law of x is read where the mean stands: outside of the sum.
        let draws = [draw("x", "beta(k, 1)"), draw("y", "uniform(0, 1)")];
        let found = at("mean(sum(k*x*y, k = 1..2))", &[("k", 2, 1)], &draws, 64);
        assert!(found.is_err());
        let found = at("sum(k, k = 1..3) + k", &[("k", 5, 1)], &draws, 64);
        assert_eq!(found, exact(11, 1));
        assert!(at("sum(mean(x), x = 1..3)", &[("k", 5, 1)], &draws, 64).is_err());
    }

    /// The deepest trees that the parser makes fit the stack of a thread.
    #[test]
    fn deep_formulas_do_not_overflow() {
        let sum = vec!["x"; 900].join(" + ");
        assert_eq!(at(&sum, &[("x", 1, 1)], &[], 64), exact(900, 1));
        assert_eq!(closed(&format!("int({sum}, x = 0..1)")), exact(450, 1));
        let mean = format!("mean({sum}, x ~ uniform(0, 1))");
        assert_eq!(closed(&mean), exact(450, 1));
        let found = at(&format!("diff({sum}, x)"), &[("x", 1, 1)], &[], 64);
        assert!(found.is_err() || found == exact(900, 1));
        let nested = format!("{}x{}", "int(".repeat(90), ", x = 0..1)".repeat(90));
        let _ = closed(&nested);
    }

    /// The density of an order statistic against the closed product, David & Nagaraja 2.1.6.
    #[test]
    fn order_statistics() {
        let draws = [draw("r", "order(l, m) of density x -> 3*x^2 on 0..1")];
        let product = "m!/((l-1)!*(m-l)!)*(y^3)^(l-1)*(1-y^3)^(m-l)*3*y^2";
        for (l, m) in [(1, 1), (1, 4), (3, 4), (4, 4), (5, 9)] {
            let numbers = [("l", l, 1), ("m", m, 1), ("y", 2, 3)];
            let difference = format!("density(r, y) - {product}");
            assert_eq!(at(&difference, &numbers, &draws, 64), exact(0, 1));
            let total = at("prob(r <= 1)", &numbers, &draws, 64);
            assert_eq!(total, exact(1, 1));
        }
    }

    #[test]
    fn means_are_over_one_draw() {
        let draws = [draw("x", "uniform(0, 1)"), draw("y", "beta(2, 1)")];
        assert_eq!(
            at("mean((x - mean(x))^2) - var(x)", &[], &draws, 64),
            exact(0, 1)
        );
        assert_eq!(at("mean(x)*mean(y)", &[], &draws, 64), exact(1, 3));
        for text in [
            "mean(1/(x + y))",
            "int(mean(x), x = 0..1)",
            "x",
            "mean(x, x ~ uniform(0, 1))",
        ] {
            assert!(at(text, &[], &draws, 64).is_err(), "{text}");
        }
        assert!(at("mean(z)", &[], &[draw("z", "any")], 64).is_err());
    }

    /// Coefficients of a hundred digits cancel: the logarithm is enclosed with as many bits more.
    #[test]
    fn large_linear_forms_keep_their_digits() {
        let found = enclosure(&at("hyp2f1(1, 40; 81; -2/79)", &[], &[], 64).unwrap());
        let width = (found.high() - found.low()) / found.low();
        assert!(width < Rational::new(1.into(), BigInt::one() << 50_u32));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4))]
        #[test]
        fn more_bits_refine(l in 1_i64..6, more in 0_i64..5, a in 1_i64..30, bits in 40_u32..120) {
            let numbers = [("l", l, 1), ("m", l + more, 1), ("Va", a, 7)];
            for text in ["hyp2f1(1, l; m + 1; -3/Va)", "hyp2f1(1/2, l; m + 3/2; -1/(1 + Va))",
                "exp(Va/7)*sqrt(Va + pi)", "int(Va/(x + l)^2 + 1/(x + m), x = 0..sqrt(2))"]
            {
                let few = enclosure(&at(text, &numbers, &[], bits).unwrap());
                let many = enclosure(&at(text, &numbers, &[], 2 * bits).unwrap());
                prop_assert!(few.compare(&many).map_or(true, Ordering::is_eq), "{}", text);
                prop_assert!(few.as_exact().is_some() || many.high() - many.low() < few.high() - few.low());
            }
        }
    }
}
