//! The derivative of a formula, by the rules of calculus.

use super::{Rejected, reject};
use crate::formula::{Formula, Function, Name, Operator, free_names};

use Operator::{Add, Divide, Multiply, Power, Subtract};

/// The derivative. Wherever the formula and its derivative both have finite values on an open
/// interval, the one is the derivative of the other there: every part is differentiable, since a
/// part at which it is not (a root at 0, a power below the first at 0) leaves the derivative
/// without value.
///
/// # Errors
/// [`Rejected`] for a formula that the rules do not cover.
pub fn derive(e: &Formula, x: &Name) -> Result<Formula, Rejected> {
    if !free_names(e).contains(x) {
        return Ok(Formula::integer(0));
    }
    match e {
        Formula::Name(_) => Ok(Formula::integer(1)),
        Formula::Negate(a) => Ok(Formula::Negate(Box::new(derive(a, x)?))),
        Formula::Binary(operator, a, b) => binary(*operator, a, b, x),
        Formula::Call(function, parts) => match (function, parts.as_slice()) {
            // DLMF 4.7.1
            (Function::Ln, [a]) => Ok(Formula::binary(Divide, derive(a, x)?, a.clone())),
            (Function::Sqrt, [a]) => {
                let twice = Formula::binary(Multiply, Formula::integer(2), e.clone());
                Ok(Formula::binary(Divide, derive(a, x)?, twice))
            }
            _ => reject("the derivative of a function without a rule"),
        },
        _ => reject("the derivative of a formula without a rule"),
    }
}

fn binary(operator: Operator, a: &Formula, b: &Formula, x: &Name) -> Result<Formula, Rejected> {
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
        Power => return reject("the derivative of a power with a moving exponent"),
    })
}
