//! The derivative of a formula, by the rules of calculus, and what is continuous.

use super::{Unknown, unknown};
use crate::formula::{
    Formula, Function, Name, Operator, Part, RangeKind, free_names, is_over_draws, substitute,
};

use Operator::{Add, Divide, Multiply, Power, Subtract};

/// The derivative. Wherever the formula and its derivative both have finite values on an open
/// interval, the one is the derivative of the other there: every part is differentiable, since a
/// part at which it is not (a root at 0, a power below the first at 0) leaves the derivative
/// without value.
///
/// # Errors
/// [`Unknown`] for a formula that the rules do not cover.
pub fn derive(e: &Formula, x: &Name) -> Result<Formula, Unknown> {
    // The laws of the draws may name x.
    if is_over_draws(Part::Formula(e)) {
        return unknown("the derivative of what is taken over draws");
    }
    if !free_names(e).contains(x) {
        return Ok(Formula::integer(0));
    }
    match e {
        Formula::Name(_) => Ok(Formula::integer(1)),
        Formula::Negate(a) => Ok(Formula::Negate(Box::new(derive(a, x)?))),
        Formula::Binary(operator, a, b) => binary(*operator, a, b, x),
        Formula::Call(function, parts) => match parts.as_slice() {
            [a] => call(*function, e, a, derive(a, x)?),
            _ => unknown("the derivative of a function without a rule"),
        },
        Formula::Ranged(r) if r.kind == RangeKind::Integral => {
            // The fundamental theorem, for a body that is continuous where it has a value.
            if free_names(&r.body).contains(x) || !is_continuous(&r.body, &r.name) {
                return unknown("the derivative of an integral whose body moves, or may jump");
            }
            let end = |place: &Formula| {
                let value = substitute(&r.body, &[(r.name.clone(), place.clone())]);
                let value = value.map_err(|why| Unknown(why.to_string()))?;
                Ok(Formula::binary(Multiply, value, derive(place, x)?))
            };
            Ok(Formula::binary(Subtract, end(&r.to)?, end(&r.from)?))
        }
        _ => unknown("the derivative of a formula without a rule"),
    }
}

fn binary(operator: Operator, a: &Formula, b: &Formula, x: &Name) -> Result<Formula, Unknown> {
    let times = |a: &Formula, b: Formula| Formula::binary(Multiply, a.clone(), b);
    let still = |e: &Formula| !free_names(e).contains(x);
    Ok(match operator {
        Add | Subtract if still(b) => derive(a, x)?,
        Add if still(a) => derive(b, x)?,
        Add | Subtract => Formula::binary(operator, derive(a, x)?, derive(b, x)?),
        Multiply if still(a) => times(a, derive(b, x)?),
        Multiply if still(b) => Formula::binary(Multiply, derive(a, x)?, b.clone()),
        Multiply => {
            let left = Formula::binary(Multiply, derive(a, x)?, b.clone());
            Formula::binary(Add, left, times(a, derive(b, x)?))
        }
        Divide if still(b) => Formula::binary(Divide, derive(a, x)?, b.clone()),
        Divide => {
            let above = Formula::binary(
                Subtract,
                Formula::binary(Multiply, derive(a, x)?, b.clone()),
                times(a, derive(b, x)?),
            );
            let square = Formula::binary(Power, b.clone(), Formula::integer(2));
            Formula::binary(Divide, above, square)
        }
        Power if still(b) => {
            let less = Formula::binary(Subtract, b.clone(), Formula::integer(1));
            let power = Formula::binary(Power, a.clone(), less);
            Formula::binary(Multiply, times(b, power), derive(a, x)?)
        }
        // (e^(b*ln(a)))', which has a value for a > 0 only.
        Power => {
            let logarithm = Formula::Call(Function::Ln, vec![a.clone()]);
            let exponent = Formula::binary(Multiply, b.clone(), logarithm);
            let power = Formula::binary(Power, a.clone(), b.clone());
            Formula::binary(Multiply, power, derive(&exponent, x)?)
        }
    })
}

/// The derivative of `e`, a function of `a`; DLMF 4.7.1, 4.7.4, 4.20.1 and 4.20.2.
fn call(function: Function, e: &Formula, a: &Formula, da: Formula) -> Result<Formula, Unknown> {
    let times = |factor| Formula::binary(Multiply, factor, da.clone());
    Ok(match function {
        Function::Ln => Formula::binary(Divide, da, a.clone()),
        Function::Sqrt => {
            let twice = Formula::binary(Multiply, Formula::integer(2), e.clone());
            Formula::binary(Divide, da, twice)
        }
        Function::Exp => times(e.clone()),
        Function::Sin => times(Formula::Call(Function::Cos, vec![a.clone()])),
        Function::Cos => {
            let sin = Formula::Call(Function::Sin, vec![a.clone()]);
            times(Formula::Negate(Box::new(sin)))
        }
        Function::Abs => times(Formula::binary(Divide, e.clone(), a.clone())),
        _ => return unknown("the derivative of a function without a rule"),
    })
}

/// Whether the formula is continuous in x wherever it has finite values: it is made of operations
/// that are so. A power with an exponent free of x is one of them: it is finite by its base's sign or
/// by its integer exponent, the same way all over. So is an integral with moving ends.
pub fn is_continuous(e: &Formula, x: &Name) -> bool {
    if is_over_draws(Part::Formula(e)) {
        return false;
    }
    if !free_names(e).contains(x) {
        return true;
    }
    match e {
        Formula::Name(_) => true,
        Formula::Negate(a) => is_continuous(a, x),
        Formula::Binary(Power, a, b) => !free_names(b).contains(x) && is_continuous(a, x),
        Formula::Binary(_, a, b) => is_continuous(a, x) && is_continuous(b, x),
        Formula::Call(Function::Exp | Function::Ln | Function::Sqrt | Function::Abs, parts)
        | Formula::Call(Function::Sin | Function::Cos, parts)
        | Formula::Apply(_, parts) => parts.iter().all(|part| is_continuous(part, x)),
        Formula::Ranged(r) if r.kind == RangeKind::Integral => {
            !free_names(&r.body).contains(x) && is_continuous(&r.from, x) && is_continuous(&r.to, x)
        }
        _ => false,
    }
}

/// Whether the formula is continuous in x on the whole line, given that its parts free of x have
/// finite values.
pub fn is_entire(e: &Formula, x: &Name) -> bool {
    if !free_names(e).contains(x) {
        return true;
    }
    match e {
        Formula::Name(_) => true,
        Formula::Negate(a) => is_entire(a, x),
        Formula::Binary(Add | Subtract | Multiply, a, b) => is_entire(a, x) && is_entire(b, x),
        Formula::Call(Function::Exp | Function::Sin | Function::Cos, parts) => {
            parts.iter().all(|part| is_entire(part, x))
        }
        _ => false,
    }
}
