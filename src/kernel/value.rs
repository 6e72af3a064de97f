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
const BITS_CAP: u32 = 1024;
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
        _ => return unknown("an antiderivative, an O-term or a condition has no one value"),
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
        scope.spend_on(a, b)?;
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
    let power = base.power(n.unsigned_abs())?;
    scope.spend_on(&power, &power)?;
    Ok(power.into())
}

/// (q^r)^s as q^(r*s), for q > 0: ends of ranges are often roots, and their powers are exact.
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
    let product = exponent * &Interval::exact(root);
    Ok(radicand.is_positive().then_some((radicand, product)))
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
    scope.spend(scope.bits)?;
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
        (Function::Sin, [x]) => Ok(functions::sin(x, bits)?),
        (Function::Cos, [x]) => Ok(functions::cos(x, bits)?),
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
