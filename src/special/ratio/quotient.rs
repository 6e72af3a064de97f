//! `Gamma(x)/Gamma(y)` as it stands, each factor MPFR's, correctly rounded outwards: a few bits are lost in
//! the quotient. Exact in principle for any size, but Gamma(x) costs more and more, and in f64 it overflows.

use super::{gamma_cost, is_pole};
use crate::number::{DomainError, Interval};
use rug::Rational;

/// Larger arguments are left to the logarithms.
const MODERATE: u32 = 1 << 10;

pub(super) fn cost(x: &Rational, y: &Rational, precision: u32) -> Option<f64> {
    let fits = |q: &Rational| !is_pole(q) && *q.as_abs() <= MODERATE;
    (fits(x) && fits(y)).then(|| 4.0 * gamma_cost(working(x, y, precision), 1))
}

/// |Gamma'(x)/Gamma(x)| grows at most as 1/distance to a pole, at least 1/denominator.
fn working(x: &Rational, y: &Rational, precision: u32) -> u32 {
    let bits = |q: &Rational| q.denom().significant_bits();
    let distance = bits(x).max(bits(y));
    precision
        .saturating_add(32)
        .saturating_add(distance.saturating_mul(2))
}

pub(super) fn ratio(x: &Rational, y: &Rational, precision: u32) -> Result<Interval, DomainError> {
    let working = working(x, y, precision);
    let gamma = |q: &Rational| Interval::from_rational(q, working).gamma();
    let value = gamma(x)?.div(&gamma(y)?)?;
    Ok(value.with_precision(precision))
}
