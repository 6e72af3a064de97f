//! Derivatives by the rules of calculus, and function parameters as the polynomials they are.
//!
//! Where the formula and its derived tree both have finite values, every part is differentiable at
//! the point (roots and logarithms are inside their domains, divisors are not zero), so that the
//! rules hold. A derived tree without value proves nothing.

use super::integrand::{Variable, fraction};
use super::interval::Value;
use super::polynomial::Polynomial;
use super::scope::{Binding, Scope};
use super::value::value_in;
use super::{Unknown, unknown};
use crate::formula::{Formula, Function, Name, Operator, Point, RangeKind};
use num_traits::ToPrimitive;

/// No higher derivative is taken.
const ORDER_CAP: u64 = 12;

/// A function of the point as a polynomial in its argument, with rational coefficients.
pub(super) fn polynomial_of(name: &Name, scope: &Scope) -> Result<Polynomial, Unknown> {
    let Some((argument, body)) = scope.point.functions.get(name) else {
        return Err(Unknown(format!("no function is given for {name}")));
    };
    let nothing = Point::default();
    let closed = scope.closed(&nothing).with(argument, Binding::Variable);
    let variable = Variable {
        name: argument,
        sample: None,
    };
    match fraction(body, &variable, &closed)? {
        Some(f) if f.poles.is_empty() && f.numerator.as_exact().is_some() => Ok(f.numerator),
        _ => Err(Unknown(format!("{name} is not given as a polynomial"))),
    }
}

/// The value of a derivative at the place that its variable stands for.
pub(super) fn derivative(
    f: &Formula,
    x: &Name,
    order: &Formula,
    scope: &Scope,
) -> Result<Value, Unknown> {
    match value_in(f, scope)? {
        Value::Undefined => return Ok(Value::Undefined),
        Value::Finite { .. } => {}
        _ => return unknown("a derivative of what is infinite"),
    }
    match value_in(&derived(f, x, order, scope)?, scope)? {
        Value::Finite { low, high } => Ok(Value::Finite { low, high }),
        _ => unknown("a derivative whose rule has no value here"),
    }
}

/// The formula of a derivative of a given order.
pub(super) fn derived(
    f: &Formula,
    x: &Name,
    order: &Formula,
    scope: &Scope,
) -> Result<Formula, Unknown> {
    let order = value_in(order, scope)?.finite();
    let order = order.as_ref().and_then(|n| n.as_integer()?.to_u64());
    let Some(order) = order.filter(|&n| n <= ORDER_CAP) else {
        return unknown("a derivative whose order is no small integer");
    };
    let mut result = f.clone();
    for _ in 0..order {
        result = derive(&result, x, scope)?;
    }
    Ok(result)
}

fn sum(a: Formula, b: Formula) -> Formula {
    if a == Formula::integer(0) {
        return b;
    }
    if b == Formula::integer(0) {
        return a;
    }
    Formula::binary(Operator::Add, a, b)
}

fn product(a: Formula, b: Formula) -> Formula {
    if b == Formula::integer(0) {
        return b;
    }
    if b == Formula::integer(1) {
        return a;
    }
    Formula::binary(Operator::Multiply, a, b)
}

fn quotient(a: Formula, b: Formula) -> Formula {
    Formula::binary(Operator::Divide, a, b)
}

fn negated(a: Formula) -> Formula {
    if a == Formula::integer(0) {
        return a;
    }
    Formula::Negate(Box::new(a))
}

fn call(function: Function, argument: &Formula) -> Formula {
    Formula::Call(function, vec![argument.clone()])
}

/// One derivative.
fn derive(f: &Formula, x: &Name, scope: &Scope) -> Result<Formula, Unknown> {
    scope.spend(20)?;
    if !scope.depends(f, x) {
        return Ok(Formula::integer(0));
    }
    match f {
        Formula::Name(_) => Ok(Formula::integer(1)),
        Formula::Negate(a) => Ok(negated(derive(a, x, scope)?)),
        Formula::Binary(operator, a, b) => derive_binary(*operator, a, b, x, scope),
        Formula::Call(function, parts) => match parts.as_slice() {
            [a] => {
                let outer = derive_call(*function, a)?;
                Ok(product(outer, derive(a, x, scope)?))
            }
            _ => unknown("a derivative of a function without a rule"),
        },
        Formula::Apply(name, parts) => match (parts.as_slice(), scope.point.functions.get(name)) {
            ([a], Some((argument, body))) => {
                polynomial_of(name, scope)?;
                let outer = derive(body, argument, scope)?;
                let there = vec![(argument.clone(), a.clone())];
                let outer = Formula::At(Box::new(outer), there);
                Ok(product(outer, derive(a, x, scope)?))
            }
            _ => unknown("a derivative of a function that is not given"),
        },
        Formula::Ranged(r) if r.kind == RangeKind::Integral && r.name != *x => {
            // The fundamental theorem, for a body that is continuous where it has a value.
            if scope.depends(&r.body, x) || !is_continuous(&r.body) {
                return unknown("a derivative under the integral");
            }
            let end = |place: &Formula| -> Result<Formula, Unknown> {
                let there = vec![(r.name.clone(), place.clone())];
                let value = Formula::At(Box::new(r.body.clone()), there);
                Ok(product(value, derive(place, x, scope)?))
            };
            Ok(sum(end(&r.to)?, negated(end(&r.from)?)))
        }
        _ => unknown("a derivative of a formula without a rule"),
    }
}

/// Whether the formula is built of functions continuous inside their domains, where it is known to
/// have values around every point that has one.
pub(super) fn is_continuous(f: &Formula) -> bool {
    match f {
        Formula::Number(_) | Formula::Pi | Formula::Name(_) => true,
        Formula::Negate(a) => is_continuous(a),
        Formula::Binary(Operator::Power, a, b) => {
            is_continuous(a) && matches!(**b, Formula::Number(ref n) if n.is_integer())
        }
        Formula::Binary(_, a, b) => is_continuous(a) && is_continuous(b),
        Formula::Apply(_, parts) => parts.iter().all(is_continuous),
        Formula::Call(Function::Exp | Function::Ln | Function::Sin | Function::Cos, parts) => {
            parts.iter().all(is_continuous)
        }
        _ => false,
    }
}

fn derive_binary(
    operator: Operator,
    a: &Formula,
    b: &Formula,
    x: &Name,
    scope: &Scope,
) -> Result<Formula, Unknown> {
    if operator == Operator::Power {
        return derive_power(a, b, x, scope);
    }
    let (da, db) = (derive(a, x, scope)?, derive(b, x, scope)?);
    Ok(match operator {
        Operator::Add => sum(da, db),
        Operator::Subtract => sum(da, negated(db)),
        Operator::Multiply => sum(product(b.clone(), da), product(a.clone(), db)),
        _ => {
            let square = Formula::binary(Operator::Power, b.clone(), Formula::integer(2));
            let top = sum(product(b.clone(), da), negated(product(a.clone(), db)));
            quotient(top, square)
        }
    })
}

/// n*a^(n-1)*a' for an integer n that does not depend on x, else a^b*(b'*ln(a) + b*a'/a), a > 0.
fn derive_power(a: &Formula, b: &Formula, x: &Name, scope: &Scope) -> Result<Formula, Unknown> {
    let da = derive(a, x, scope)?;
    if !scope.depends(b, x)
        && let Some(n) = value_in(b, scope)?
            .finite()
            .filter(|n| n.as_integer().is_some())
    {
        let n = n.low().clone();
        let less = Formula::Number(&n - num_rational::BigRational::from_integer(1.into()));
        let power = Formula::binary(Operator::Power, a.clone(), less);
        return Ok(product(product(Formula::Number(n), power), da));
    }
    let db = derive(b, x, scope)?;
    let whole = Formula::binary(Operator::Power, a.clone(), b.clone());
    let growth = sum(
        product(call(Function::Ln, a), db),
        product(quotient(b.clone(), a.clone()), da),
    );
    Ok(product(whole, growth))
}

/// The derivative of a function at its argument, DLMF 4.7.1, 4.7.4, 4.20.1 and 4.20.2.
fn derive_call(function: Function, a: &Formula) -> Result<Formula, Unknown> {
    let one = Formula::integer(1);
    Ok(match function {
        Function::Exp => call(Function::Exp, a),
        Function::Ln => quotient(one, a.clone()),
        Function::Sin => call(Function::Cos, a),
        Function::Cos => negated(call(Function::Sin, a)),
        Function::Sqrt => {
            let twice = Formula::binary(
                Operator::Multiply,
                Formula::integer(2),
                call(Function::Sqrt, a),
            );
            quotient(one, twice)
        }
        Function::Abs => quotient(call(Function::Abs, a), a.clone()),
        _ => return unknown("a derivative of a function without a rule"),
    })
}
