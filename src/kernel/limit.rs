//! Limits by continuity: the value at the target, where every operation on the way is continuous
//! there.
//!
//! A mean or integral of a body without pole on the closed range is continuous in its parameters:
//! the body is so uniformly, and the densities of Beta and uniform laws converge in the mean
//! (Scheffe's lemma).

use super::calculus::is_continuous;
use super::integrand::{Variable, cuts_of, fraction};
use super::interval::{Interval, Value};
use super::law;
use super::scope::{Binding, Scope};
use super::value::{apply, operate, value_in};
use super::{Unknown, unknown};
use crate::formula::{Draw, Formula, Function, Law, Name, Operator};
use std::cmp::Ordering;

/// The limit of a formula as names tend to finite targets, from all sides.
pub(super) fn limit(
    f: &Formula,
    places: &[(Name, Formula)],
    scope: &Scope,
) -> Result<Value, Unknown> {
    let mut inner = scope.clone();
    for (name, place) in places {
        match value_in(place, scope)?.finite() {
            Some(number) => inner = inner.with(name, Binding::Number(number)),
            None => return unknown("a limit at infinity"),
        }
    }
    let names: Vec<&Name> = places.iter().map(|(name, _)| name).collect();
    approach(f, &names, &inner)
}

/// The limit of a formula whose moving names are bound to their targets. `Undefined` is claimed
/// only for a part that does not move and has no value.
fn approach(f: &Formula, moving: &[&Name], scope: &Scope) -> Result<Value, Unknown> {
    scope.spend(1)?;
    if !moves(f, moving, scope) {
        return value_in(f, scope);
    }
    match f {
        Formula::Name(name) => Ok(scope.number(name)?.into()),
        Formula::Negate(a) => Ok(approach(a, moving, scope)?.negated()),
        Formula::Binary(operator, a, b) => binary(*operator, a, b, moving, scope),
        Formula::Call(function, parts) => call(*function, parts, moving, scope),
        Formula::Mean(body, own) => mean(body, own.as_deref(), moving, scope),
        _ => unknown("a limit of a formula without a rule of continuity"),
    }
}

fn moves(f: &Formula, moving: &[&Name], scope: &Scope) -> bool {
    moving.iter().any(|name| scope.depends(f, name))
}

fn binary(
    operator: Operator,
    a: &Formula,
    b: &Formula,
    moving: &[&Name],
    scope: &Scope,
) -> Result<Value, Unknown> {
    let (x, y) = (approach(a, moving, scope)?, approach(b, moving, scope)?);
    if x == Value::Undefined || y == Value::Undefined {
        return Ok(Value::Undefined);
    }
    let continuous = match operator {
        Operator::Add | Operator::Subtract | Operator::Multiply => true,
        Operator::Divide => is_nonzero(&y),
        Operator::Power => {
            let exponent = y.finite();
            let integer = exponent.as_ref().and_then(|e| e.as_integer());
            x.sign() == Some(Ordering::Greater)
                || (!moves(b, moving, scope)
                    && integer.is_some_and(|n| {
                        is_nonzero(&x) || n.bits() == 0 || n.sign() == num_bigint::Sign::Plus
                    }))
        }
    };
    if !continuous {
        return unknown("a limit at a border of a domain");
    }
    match operate(operator, &x, &y, scope.bits)? {
        Value::Undefined => unknown("a limit of an indeterminate form"),
        value => Ok(value),
    }
}

fn is_nonzero(value: &Value) -> bool {
    value.sign().is_some_and(Ordering::is_ne)
}

/// A function at the limits of its arguments, inside its domain.
fn call(
    function: Function,
    parts: &[Formula],
    moving: &[&Name],
    scope: &Scope,
) -> Result<Value, Unknown> {
    let mut x: Vec<Interval> = Vec::new();
    for part in parts {
        match approach(part, moving, scope)? {
            Value::Undefined => return Ok(Value::Undefined),
            value => match value.finite() {
                Some(number) => x.push(number),
                None => return unknown("a limit of a function at infinity"),
            },
        }
    }
    let positive = |x: &Interval| x.sign() == Some(Ordering::Greater);
    let fixed = |i: usize| parts.get(i).is_some_and(|part| !moves(part, moving, scope));
    let continuous = match function {
        Function::Abs | Function::Min | Function::Max => true,
        Function::Exp | Function::Sin | Function::Cos => true,
        Function::Sqrt | Function::Ln | Function::Gamma | Function::LnGamma | Function::Beta => {
            x.iter().all(positive)
        }
        // Polynomials in the first argument.
        Function::Binomial | Function::Pochhammer => fixed(1),
        // Analytic in all four for c > 0 and z < 1, DLMF 15.2(i) and 15.2(ii).
        Function::Hyp2F1 | Function::Hyp2F1Regularized => match x.as_slice() {
            [_, _, c, z] => positive(c) && z.compare(&Interval::integer(1)) == Some(Ordering::Less),
            _ => false,
        },
        Function::Floor => false,
    };
    if !continuous {
        return unknown("a limit at a border of a domain");
    }
    match apply(function, &x, scope)? {
        Value::Undefined => unknown("a limit at a border of a domain"),
        value => Ok(value),
    }
}

/// The limit of a mean over one draw.
fn mean(
    body: &Formula,
    own: Option<&Draw>,
    moving: &[&Name],
    scope: &Scope,
) -> Result<Value, Unknown> {
    let mut draws = own
        .into_iter()
        .chain(scope.draws)
        .filter(|d| scope.depends(body, &d.name));
    let (Some(draw), None) = (draws.next(), draws.next()) else {
        return unknown("a limit of a mean over several draws");
    };
    let parameters = match &draw.law {
        Law::Beta(a, b) | Law::Uniform(a, b) => [a, b],
        _ => return unknown("a limit of a mean over a law without a rule of continuity"),
    };
    for parameter in parameters {
        if approach(parameter, moving, scope)?.finite().is_none() {
            return unknown("a limit of a law's parameter that is not finite");
        }
    }
    let value = law::mean(body, own, scope)?;
    if is_regular(body, draw, scope)? {
        return match value {
            Value::Finite { .. } => Ok(value),
            _ => unknown("a limit of a mean that is not finite"),
        };
    }
    // Fatou's lemma: a fixed body that is nonnegative on 0..1 has an infinite mean in the limit of
    // laws whose densities converge. The mean was found infinite only for a body of one sign.
    let fixed = !moves(body, moving, scope) && matches!(draw.law, Law::Beta(..));
    if fixed && value == Value::PlusInfinity {
        return Ok(value);
    }
    unknown("a limit of a mean with a pole in its support")
}

/// Whether the body is continuous on the closed support, with no divisor that is zero there.
fn is_regular(body: &Formula, draw: &Draw, scope: &Scope) -> Result<bool, Unknown> {
    let Some(weight) = law::weight(&draw.law, scope)? else {
        return unknown("a limit towards no law");
    };
    if !is_continuous(body) || !cuts_of(body, &draw.name, scope)?.is_empty() {
        return unknown("a limit of a mean of a body that is not continuous");
    }
    let variable = Variable {
        name: &draw.name,
        sample: None,
    };
    let Some(body) = fraction(body, &variable, scope)? else {
        return unknown("a limit of a mean of a body without value");
    };
    let outside =
        |root: &num_rational::BigRational| root < weight.from.low() || root > weight.to.high();
    Ok(body.poles.keys().all(outside))
}
