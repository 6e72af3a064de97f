//! `Gamma(y + n)/Gamma(y) = y (y+1) ... (y+n-1)` (DLMF 5.2.5) in intervals, for an integer n on either
//! side of 0. Each of the |n| products and factors adds two units in the last place at most, so that
//! log2 |n| bits and a few more are kept in reserve.

use super::{guarded, product_cost, steps};
use crate::number::{DomainError, Interval};
use rug::Rational;

/// More factors than this are not multiplied.
const MOST_STEPS: u32 = 1 << 20;

pub(super) fn cost(x: &Rational, y: &Rational, precision: u32) -> Option<f64> {
    let steps = steps(x, y, MOST_STEPS)?.unsigned_abs() as f64;
    Some(1000.0 + steps * (50.0 + product_cost(precision) / 2.0))
}

pub(super) fn ratio(x: &Rational, y: &Rational, precision: u32) -> Result<Interval, DomainError> {
    let steps = steps(x, y, MOST_STEPS).ok_or(DomainError::Possible)?;
    let working = guarded(precision, &[x, y]);
    let (start, count) = if steps >= 0 { (y, steps) } else { (x, -steps) };
    let product = rising(start, count as u64, working)?;
    let value = if steps >= 0 {
        product
    } else {
        Interval::from_i64(1, working).div(&product)?
    };
    Ok(value.with_precision(precision))
}

/// x (x+1) ... (x+count-1): with x = p/d, the integers p, p + d, ... over d^count.
///
/// # Errors
/// None for a count that fits: d is not 0.
pub(super) fn rising(x: &Rational, count: u64, working: u32) -> Result<Interval, DomainError> {
    let (mut factor, step) = (x.numer().clone(), x.denom());
    let mut product = Interval::from_i64(1, working);
    for _ in 0..count {
        product = product.mul_integer(&factor);
        factor += step;
    }
    let scale = Interval::from_integer(step, working).powi(count.try_into().unwrap_or(i64::MAX))?;
    product.div(&scale)
}
