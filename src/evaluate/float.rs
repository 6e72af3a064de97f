//! The value of a formula as a float: plain arithmetic where the tree is plain, enclosures of 64 bits for
//! the rest. Nothing is proved by it; it is for drawing and for simulations.

use super::scope::{Root, Scope};
use super::{Context, Failure, Outcome, condition, enclose};
use crate::formula::{Formula, Function, Operator};

/// Bits of the enclosures that stand in for what floats do not compute.
const PRECISION: u32 = 64;

/// The value in double precision; NaN where there is none.
///
/// # Errors
/// A [`Failure`] where the formula cannot be evaluated.
pub fn float(formula: &Formula, context: &Context) -> Result<f64, Failure> {
    let root = Root::new(context);
    within(formula, &Scope::new(&root))
}

fn within(formula: &Formula, scope: &Scope) -> Result<f64, Failure> {
    scope.spend(1)?;
    Ok(match formula {
        Formula::Negate(inner) => -within(inner, scope)?,
        Formula::Binary(operator, left, right) => {
            arithmetic(*operator, within(left, scope)?, within(right, scope)?)
        }
        Formula::Call(function, arguments) => match plain(*function) {
            Some(plain) if arguments.len() == 1 => plain(within(&arguments[0], scope)?),
            _ => enclosed(formula, scope)?,
        },
        Formula::If(truth, yes, no) => within(
            if condition::within(truth, scope)? {
                yes
            } else {
                no
            },
            scope,
        )?,
        _ => enclosed(formula, scope)?,
    })
}

pub(super) fn arithmetic(operator: Operator, a: f64, b: f64) -> f64 {
    match operator {
        Operator::Add => a + b,
        Operator::Subtract => a - b,
        Operator::Multiply => a * b,
        Operator::Divide if b == 0.0 || b.is_infinite() => f64::NAN,
        Operator::Divide => a / b,
        Operator::Power if a == 0.0 && b < 0.0 => f64::NAN,
        Operator::Power if a.is_nan() => a,
        Operator::Power => a.powf(b),
    }
}

pub(super) fn plain(function: Function) -> Option<fn(f64) -> f64> {
    Some(match function {
        Function::Abs => f64::abs,
        Function::Sqrt => f64::sqrt,
        Function::Exp => f64::exp,
        Function::Ln => |x| if x > 0.0 { x.ln() } else { f64::NAN },
        Function::Sin => f64::sin,
        Function::Cos => f64::cos,
        Function::Floor => f64::floor,
        _ => return None,
    })
}

fn enclosed(formula: &Formula, scope: &Scope) -> Result<f64, Failure> {
    Ok(match enclose::within(formula, scope, PRECISION)? {
        Outcome::Value(interval) => interval.midpoint().to_f64(),
        Outcome::PlusInfinity => f64::INFINITY,
        Outcome::MinusInfinity => f64::NEG_INFINITY,
        Outcome::Undefined => f64::NAN,
    })
}
