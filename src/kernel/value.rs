//! The value of a closed formula at an exact point.
//!
//! Evaluation is strict: a part without value leaves none to the whole, even where another part is
//! not known. That a formula has no value is claimed for an exact reason only; an enclosure that
//! touches a forbidden number is an [`Unknown`], and more bits may settle it.

use super::functions::{self, SIZE_CAP};
use super::interval::{Interval, Value, size};
use super::scope::{Binding, Scope, full_tank};
use super::{Unknown, calculus, condition, hypergeometric, integrand, law, limit, sums, unknown};
use crate::formula::{Draw, Formula, Function, Operator, Point, RangeKind, Ranged, Rational};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;

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
    let fuel = full_tank();
    value_in(formula, &Scope::new(point, draws, bits.into(), &fuel))
}

/// The value of a formula in a scope.
pub(super) fn value_in(f: &Formula, scope: &Scope) -> Result<Value, Unknown> {
    scope.spend(1)?;
    let result = match f {
        Formula::Number(q) => Interval::exact(q.clone()).into(),
        Formula::Pi => functions::pi(scope.bits)?.into(),
        Formula::Infinity => Value::PlusInfinity,
        Formula::Name(name) => scope.number(name)?.into(),
        Formula::Negate(a) => value_in(a, scope)?.negated(),
        Formula::Binary(operator, a, b) => binary(*operator, a, b, scope)?,
        Formula::Factorial(a) => factorial(a, scope)?,
        Formula::Call(function, parts) => call(*function, parts, scope)?,
        Formula::Apply(name, parts) => match parts.as_slice() {
            [a] => {
                let f = calculus::polynomial_of(name, scope)?;
                on_number(a, scope, |x| Ok(f.at(&x, scope.bits).into()))?
            }
            _ => return unknown("a function of several arguments"),
        },
        Formula::Ranged(r) if r.kind == RangeKind::Integral => integral(r, scope)?,
        Formula::Ranged(r) => sums::ranged(r, scope)?,
        Formula::Derivative(a, x, order) => calculus::derivative(a, x, order, scope)?,
        Formula::At(a, places) => at(a, places, scope)?,
        Formula::Limit(a, places) => limit::limit(a, places, scope)?,
        Formula::Indicator(c) => Value::exact(condition::holds(c, scope)?.into()),
        Formula::If(c, a, b) => {
            let chosen = if condition::holds(c, scope)? { a } else { b };
            value_in(chosen, scope)?
        }
        Formula::Mean(a, own) => law::mean(a, own.as_deref(), scope)?,
        Formula::Variance(a, own) => law::variance(a, own.as_deref(), scope)?,
        Formula::Probability(c, own) => law::probability(c, own.as_deref(), scope)?,
        Formula::Density(drawn, place) => law::density_at(drawn, place, scope)?,
        Formula::Cumulative(drawn, place) => law::cumulative_at(drawn, place, scope)?,
        Formula::Antiderivative(..) => return unknown("an antiderivative has no one value"),
        Formula::BigO(_) | Formula::LittleO(_) => return unknown("an O-term has no value"),
        Formula::Truth(_) => return unknown("a condition in the place of a number"),
    };
    measured(result, scope)
}

/// The value, paid for by its size.
fn measured(value: Value, scope: &Scope) -> Result<Value, Unknown> {
    if let Value::Finite { low, high } = &value {
        let bits = size(low).max(size(high));
        if bits > SIZE_CAP {
            return unknown("a number that is too large");
        }
        scope.spend(bits / 64)?;
    }
    Ok(value)
}

/// A function of one finite number; it has no value where its argument has none.
fn on_number(
    a: &Formula,
    scope: &Scope,
    function: impl Fn(Interval) -> Result<Value, Unknown>,
) -> Result<Value, Unknown> {
    match value_in(a, scope)? {
        Value::Undefined => Ok(Value::Undefined),
        value => match value.finite() {
            Some(x) => function(x),
            None => unknown("a function of an infinity"),
        },
    }
}

fn binary(operator: Operator, a: &Formula, b: &Formula, scope: &Scope) -> Result<Value, Unknown> {
    let (a, b) = (value_in(a, scope), value_in(b, scope));
    if matches!(a, Ok(Value::Undefined)) || matches!(b, Ok(Value::Undefined)) {
        return Ok(Value::Undefined);
    }
    operate(operator, &a?, &b?, scope.bits)
}

/// One arithmetic operation on values.
pub(super) fn operate(
    operator: Operator,
    a: &Value,
    b: &Value,
    bits: u64,
) -> Result<Value, Unknown> {
    match operator {
        Operator::Add => Ok(a.plus(b, bits)),
        Operator::Subtract => Ok(a.plus(&b.negated(), bits)),
        Operator::Multiply => a.times(b, bits),
        Operator::Divide => a.over(b, bits),
        Operator::Power => match (a.finite(), b.finite()) {
            (Some(x), Some(y)) => {
                let power = functions::power(&x, &y, bits)?;
                Ok(power.map_or(Value::Undefined, Value::from))
            }
            _ => unknown("a power of an infinity"),
        },
    }
}

/// n! for integers n >= 0; none for negative integers, where Gamma has its poles.
fn factorial(a: &Formula, scope: &Scope) -> Result<Value, Unknown> {
    on_number(a, scope, |x| match x.as_integer() {
        Some(n) if n.is_negative() => Ok(Value::Undefined),
        Some(n) => Ok(functions::integer(&functions::factorial(n)?).into()),
        None => unknown("a factorial of what is not an exact integer"),
    })
}

/// An integral between its ends. Where one of them has no value there is none.
fn integral(r: &Ranged, scope: &Scope) -> Result<Value, Unknown> {
    let (from, to) = (value_in(&r.from, scope)?, value_in(&r.to, scope)?);
    if from == Value::Undefined || to == Value::Undefined {
        return Ok(Value::Undefined);
    }
    let one = super::polynomial::Polynomial::constant(Interval::integer(1));
    let inner = scope.with(&r.name, Binding::Variable);
    integrand::over_range(&r.body, &one, &r.name, (&from, &to), &inner)
}

/// The formula with names standing for other values, all of them taken outside.
fn at(
    a: &Formula,
    places: &[(crate::formula::Name, Formula)],
    scope: &Scope,
) -> Result<Value, Unknown> {
    let mut inner = scope.clone();
    for (name, place) in places {
        match value_in(place, scope)? {
            Value::Undefined => return Ok(Value::Undefined),
            value => match value.finite() {
                Some(number) => inner = inner.with(name, Binding::Number(number)),
                None => return unknown("a formula at infinity"),
            },
        }
    }
    value_in(a, &inner)
}

/// A function of the language. An argument without value leaves none; an infinite one is not known.
fn call(function: Function, parts: &[Formula], scope: &Scope) -> Result<Value, Unknown> {
    let values: Vec<Result<Value, Unknown>> = parts.iter().map(|p| value_in(p, scope)).collect();
    if values.contains(&Ok(Value::Undefined)) {
        return Ok(Value::Undefined);
    }
    let mut arguments = Vec::new();
    for value in values {
        match value?.finite() {
            Some(number) => arguments.push(number),
            None => return unknown("a function of an infinity"),
        }
    }
    apply(function, &arguments, scope)
}

/// A function of finite numbers.
pub(super) fn apply(function: Function, x: &[Interval], scope: &Scope) -> Result<Value, Unknown> {
    let bits = scope.bits;
    scope.spend(bits / 8)?;
    let result = match (function, x) {
        (Function::Abs, [x]) => x.absolute(),
        (Function::Floor, [x]) => functions::floor(x)?,
        (Function::Min, [first, rest @ ..]) => {
            rest.iter().fold(first.clone(), |least, x| least.minimum(x))
        }
        (Function::Max, [first, rest @ ..]) => {
            rest.iter().fold(first.clone(), |most, x| most.maximum(x))
        }
        (Function::Exp, [x]) => functions::exp_interval(x, bits)?,
        (Function::Sin, [x]) => functions::wave(x, true, bits)?,
        (Function::Cos, [x]) => functions::wave(x, false, bits)?,
        (Function::Sqrt, [x]) => return sqrt(x, bits),
        (Function::Ln, [x]) => return ln(x, bits),
        (Function::Gamma, [x]) => {
            let gamma = functions::gamma(exact(x)?, bits)?;
            return Ok(gamma.map_or(Value::Undefined, Value::from));
        }
        (Function::LnGamma, [x]) => return lngamma(x, bits),
        (Function::Beta, [a, b]) => functions::beta(exact(a)?, exact(b)?, bits)?,
        (Function::Binomial, [n, k]) => functions::binomial(n, whole(k)?, bits)?,
        (Function::Pochhammer, [a, n]) => functions::pochhammer(a, whole(n)?, bits)?,
        (Function::Hyp2F1, [a, b, c, z]) => {
            return hypergeometric::value([exact(a)?, exact(b)?, exact(c)?, exact(z)?], scope);
        }
        (Function::Hyp2F1Regularized, [a, b, c, z]) => {
            let parameters = [exact(a)?, exact(b)?, exact(c)?, exact(z)?];
            return hypergeometric::regularized(parameters, scope);
        }
        _ => return unknown("a function with a wrong number of arguments"),
    };
    Ok(result.into())
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
        None => unknown("a length that is not an exact integer"),
    }
}

fn sqrt(x: &Interval, bits: u64) -> Result<Value, Unknown> {
    match x.sign() {
        Some(Ordering::Less) => Ok(Value::Undefined),
        None if x.low().is_negative() => unknown("a root of what may be negative at these bits"),
        _ => Ok(functions::root_interval(x, 2, bits)?.into()),
    }
}

fn ln(x: &Interval, bits: u64) -> Result<Value, Unknown> {
    match x.sign() {
        Some(Ordering::Greater) => Ok(functions::ln_interval(x, bits)?.into()),
        Some(_) => Ok(Value::Undefined),
        None if x.high().is_zero() => Ok(Value::Undefined),
        None => unknown("a logarithm of what may not be positive at these bits"),
    }
}

/// ln Gamma(x), which has a value for x > 0 only.
fn lngamma(x: &Interval, bits: u64) -> Result<Value, Unknown> {
    if !x.high().is_positive() {
        return Ok(Value::Undefined);
    }
    match functions::gamma(exact(x)?, bits + 16)? {
        Some(gamma) if gamma.as_exact().is_none_or(|g| !g.is_one()) => ln(&gamma, bits),
        Some(_) => Ok(Value::exact(0)),
        None => unknown("gamma at a pole"),
    }
}
