//! `Gamma(y + n)/Gamma(y) = y (y+1) ... (y+n-1)` (DLMF 5.2.5) in exact arithmetic, for an integer n on
//! either side of 0. The answer is a rational number: no bit is lost, and none is wasted where it is short.

use super::{product_cost, steps};
use crate::number::{DomainError, Interval};
use rug::{Integer, Rational};

/// More factors than this are a product of intervals.
const MOST_STEPS: u32 = 1 << 10;

pub(super) fn cost(x: &Rational, y: &Rational, _: u32) -> Option<f64> {
    let steps = steps(x, y, MOST_STEPS)?.unsigned_abs() as f64;
    let bits = f64::from(x.numer().significant_bits() + x.denom().significant_bits());
    // Products of equal halves: as many words as the answer has, in log2 n rounds.
    let size = (steps * bits).min(f64::from(u32::MAX)) as u32;
    Some(400.0 + 60.0 * steps + product_cost(size))
}

pub(super) fn ratio(x: &Rational, y: &Rational, precision: u32) -> Result<Interval, DomainError> {
    let value = gamma_ratio_exact(x, y).ok_or(DomainError::Possible)?;
    Ok(Interval::from_rational(&value, precision))
}

/// `Gamma(x)/Gamma(y)` where x - y is an integer of at most 1024 in size and neither is a pole.
///
/// ```
/// use claimcheck::special::gamma_ratio_exact;
/// use rug::Rational;
/// let value = gamma_ratio_exact(&Rational::from((1, 2)), &Rational::from((7, 2)));
/// assert_eq!(value, Some(Rational::from((8, 15))));
/// ```
pub fn gamma_ratio_exact(x: &Rational, y: &Rational) -> Option<Rational> {
    let steps = steps(x, y, MOST_STEPS)?;
    let (start, count) = if steps >= 0 { (y, steps) } else { (x, -steps) };
    // Numerators p, p + d, ... over d: the product of an arithmetic progression.
    let count = u32::try_from(count).ok()?;
    let above = progression(start.numer(), start.denom(), 0, count);
    let below = Integer::from(rug::ops::Pow::pow(start.denom(), count));
    let product = Rational::from((above, below));
    Some(if steps >= 0 { product } else { product.recip() })
}

/// The product of p + i d over from <= i < to, by halves.
fn progression(p: &Integer, d: &Integer, from: u32, to: u32) -> Integer {
    if to - from <= 8 {
        return (from..to).fold(Integer::from(1), |product, i| {
            product * (p + Integer::from(d * i))
        });
    }
    let middle = from + (to - from) / 2;
    progression(p, d, from, middle) * progression(p, d, middle, to)
}
