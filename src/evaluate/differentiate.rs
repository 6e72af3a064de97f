//! Symbolic derivatives. Every rule holds where all parts of the formula have derivatives; the
//! evaluator refuses places where the result has no value, so that nothing is concluded from a rule
//! outside of its domain.

use super::exact;
use super::scope::Scope;
use super::{Failure, Outcome, unsupported};
use crate::formula::{
    Formula, Function, Name, Operator, Part, RangeKind, Ranged, free_functions, substitute,
};
use crate::kernel::is_continuous;

/// Larger derivatives are refused.
const MAX_NODES: usize = 20_000;
const MAX_DEPTH: usize = 300;

/// The derivative of the given order with respect to a name.
pub(super) fn repeatedly(
    formula: &Formula,
    name: &Name,
    times: u32,
    scope: &Scope,
) -> Result<Formula, Failure> {
    let mut result = formula.clone();
    for _ in 0..times {
        result = derivative(&result, name, scope)?;
        let size = Part::Formula(&result).nodes(MAX_NODES);
        if size > MAX_NODES || Part::Formula(&result).depth() > MAX_DEPTH {
            return Err(Failure::TooLarge("a derivative".into()));
        }
        scope.spend(size as u64)?;
    }
    Ok(result)
}

fn zero() -> Formula {
    Formula::integer(0)
}

fn one() -> Formula {
    Formula::integer(1)
}

fn is_zero(formula: &Formula) -> bool {
    *formula == zero()
}

fn add(a: Formula, b: Formula) -> Formula {
    match (is_zero(&a), is_zero(&b)) {
        (true, _) => b,
        (_, true) => a,
        _ => Formula::binary(Operator::Add, a, b),
    }
}

fn subtract(a: Formula, b: Formula) -> Formula {
    if is_zero(&b) {
        a
    } else {
        Formula::binary(Operator::Subtract, a, b)
    }
}

fn multiply(a: Formula, b: Formula) -> Formula {
    if is_zero(&a) || is_zero(&b) {
        zero()
    } else if a == one() {
        b
    } else if b == one() {
        a
    } else {
        Formula::binary(Operator::Multiply, a, b)
    }
}

fn divide(a: Formula, b: Formula) -> Formula {
    if is_zero(&a) {
        zero()
    } else {
        Formula::binary(Operator::Divide, a, b)
    }
}

fn power(a: Formula, b: Formula) -> Formula {
    Formula::binary(Operator::Power, a, b)
}

fn call(function: Function, argument: Formula) -> Formula {
    Formula::Call(function, vec![argument])
}

/// Whether the formula's value depends on the name; a mean's does through its laws too.
fn depends(formula: &Formula, name: &Name, scope: &Scope) -> Result<bool, Failure> {
    let free = Part::Formula(formula).free_names();
    if free.contains(name) {
        return Ok(true);
    }
    let draws = scope.draws_among(&free)?;
    Ok(draws
        .iter()
        .any(|draw| Part::Law(&draw.law).free_names().contains(name)))
}

fn derivative(formula: &Formula, name: &Name, scope: &Scope) -> Result<Formula, Failure> {
    scope.spend(1)?;
    if !depends(formula, name, scope)? {
        return Ok(zero());
    }
    match formula {
        Formula::Name(_) => Ok(one()),
        Formula::Negate(inner) => Ok(Formula::Negate(Box::new(derivative(inner, name, scope)?))),
        Formula::Binary(operator, left, right) => binary(*operator, left, right, name, scope),
        Formula::Call(function, arguments) => match &arguments[..] {
            [x] => Ok(multiply(outer(*function, x)?, derivative(x, name, scope)?)),
            _ => Err(unsupported(format!(
                "the derivative of {}",
                function.name()
            ))),
        },
        Formula::Apply(function, arguments) => {
            let [argument] = &arguments[..] else {
                return Err(unsupported(
                    "the derivative of a function of several variables",
                ));
            };
            let (variable, body) = scope.function(function)?;
            let inner = derivative(body, variable, scope)?;
            let outer = substitute(&inner, &[(variable.clone(), argument.clone())])
                .map_err(|_| Failure::TooLarge("a derivative".into()))?;
            Ok(multiply(outer, derivative(argument, name, scope)?))
        }
        Formula::Ranged(ranged) => ranged_derivative(ranged, name, scope),
        Formula::Antiderivative(body, variable) if variable == name => Ok((**body).clone()),
        Formula::Cumulative(quantity, x) => {
            let density = Formula::Density(quantity.clone(), x.clone());
            if depends(quantity, name, scope)? {
                return Err(unsupported("the derivative of a law"));
            }
            Ok(multiply(density, derivative(x, name, scope)?))
        }
        _ => Err(unsupported("the derivative of a formula of this kind")),
    }
}

fn binary(
    operator: Operator,
    left: &Formula,
    right: &Formula,
    name: &Name,
    scope: &Scope,
) -> Result<Formula, Failure> {
    if operator == Operator::Power {
        return power_derivative(left, right, name, scope);
    }
    let (dl, dr) = (
        derivative(left, name, scope)?,
        derivative(right, name, scope)?,
    );
    let (l, r) = (left.clone(), right.clone());
    Ok(match operator {
        Operator::Add => add(dl, dr),
        Operator::Subtract => subtract(dl, dr),
        Operator::Multiply => add(multiply(dl, r), multiply(l, dr)),
        // (l/r)' = l'/r - l r'/r^2
        _ => {
            let square = power(r.clone(), Formula::integer(2));
            subtract(divide(dl, r), divide(multiply(l, dr), square))
        }
    })
}

/// (u^n)' = n u^(n-1) u' for an exponent that does not change, with u^n/u for u^(n-1) unless the value
/// of n here is known to be an integer, so that u = 0 is excluded; else u^v (v' ln u + v u'/u).
fn power_derivative(
    base: &Formula,
    exponent: &Formula,
    name: &Name,
    scope: &Scope,
) -> Result<Formula, Failure> {
    let (u, v) = (base.clone(), exponent.clone());
    let du = derivative(base, name, scope)?;
    if !depends(exponent, name, scope)? {
        let lower = match whole(exponent, scope) {
            Some(0) => return Ok(zero()),
            Some(n) => power(u, Formula::integer(n - 1)),
            None => divide(power(u.clone(), v.clone()), u),
        };
        return Ok(multiply(multiply(v, lower), du));
    }
    let dv = derivative(exponent, name, scope)?;
    let logarithmic = add(
        multiply(dv, call(Function::Ln, u.clone())),
        divide(multiply(v.clone(), du), u.clone()),
    );
    Ok(multiply(power(u, v), logarithmic))
}

/// The value of an exponent that is a small integer here.
fn whole(exponent: &Formula, scope: &Scope) -> Option<i64> {
    let Ok(Outcome::Value(value)) = exact::closed(exponent, scope) else {
        return None;
    };
    let value = value.as_rational()?;
    let value = value.is_integer().then(|| value.numer().to_i64())??;
    value.checked_sub(1).map(|_| value)
}

/// The derivative of a function at its argument.
fn outer(function: Function, x: &Formula) -> Result<Formula, Failure> {
    let x = x.clone();
    Ok(match function {
        Function::Abs => divide(call(Function::Abs, x.clone()), x),
        Function::Sqrt => divide(
            Formula::binary(Operator::Divide, one(), Formula::integer(2)),
            call(Function::Sqrt, x),
        ),
        Function::Exp => call(Function::Exp, x),
        Function::Ln => divide(one(), x),
        Function::Sin => call(Function::Cos, x),
        Function::Cos => Formula::Negate(Box::new(call(Function::Sin, x))),
        _ => {
            return Err(unsupported(format!(
                "the derivative of {}",
                function.name()
            )));
        }
    })
}

/// Sums term by term; integrals by Leibniz's rule.
fn ranged_derivative(ranged: &Ranged, name: &Name, scope: &Scope) -> Result<Formula, Failure> {
    if ranged.name == *name {
        let fixed = !depends(&ranged.from, name, scope)? && !depends(&ranged.to, name, scope)?;
        return match (fixed, ranged.kind) {
            (true, _) => Ok(zero()),
            (false, RangeKind::Integral) => boundary_terms(ranged, name, scope),
            _ => Err(unsupported("the derivative of a sum in its bound")),
        };
    }
    let inner = Ranged {
        body: derivative(&ranged.body, name, scope)?,
        ..ranged.clone()
    };
    let inner = if is_zero(&inner.body) {
        zero()
    } else {
        Formula::Ranged(Box::new(inner))
    };
    match ranged.kind {
        RangeKind::Sum
            if !depends(&ranged.from, name, scope)? && !depends(&ranged.to, name, scope)? =>
        {
            Ok(inner)
        }
        RangeKind::Integral if is_zero(&inner) => boundary_terms(ranged, name, scope),
        _ => Err(unsupported("the derivative of a range of this kind")),
    }
}

/// f(b) b' - f(a) a', for a body that is continuous where it has values.
fn boundary_terms(ranged: &Ranged, name: &Name, scope: &Scope) -> Result<Formula, Failure> {
    let mut continuous = is_continuous(&ranged.body, &ranged.name);
    for function in free_functions(&ranged.body) {
        let (argument, body) = scope.function(&function)?;
        continuous &= is_continuous(body, argument);
    }
    if !continuous {
        return Err(unsupported(
            "the derivative of an integral that may have kinks",
        ));
    }
    let term = |end: &Formula| -> Result<Formula, Failure> {
        let value = substitute(&ranged.body, &[(ranged.name.clone(), end.clone())])
            .map_err(|_| Failure::TooLarge("a derivative".into()))?;
        Ok(multiply(value, derivative(end, name, scope)?))
    };
    Ok(subtract(term(&ranged.to)?, term(&ranged.from)?))
}
