//! `Gamma(x)/Gamma(y)` as it stands, each factor MPFR's, correctly rounded outwards: a few bits are lost in
//! the quotient. Exact in principle for any size, but Gamma(x) costs more and more, and in f64 it overflows.

use super::{gamma_cost, is_pole};
use crate::number::{DomainError, Interval};
use rug::Rational;

/// Larger arguments are left to the logarithms.
const MODERATE: u32 = 1 << 10;

pub(super) fn cost(x: &Rational, y: &Rational, precision: u32) -> Option<f64> {
    let fits = |q: &Rational| !is_pole(q) && *q.as_abs() <= MODERATE;
    (fits(x) && fits(y)).then(|| 4.0 * gamma_cost(precision, 1))
}

pub(super) fn ratio(x: &Rational, y: &Rational, precision: u32) -> Result<Interval, DomainError> {
    // |Gamma'(x)/Gamma(x)| grows at most as 1/distance to a pole, at least 1/denominator.
    let distance = x
        .denom()
        .significant_bits()
        .max(y.denom().significant_bits());
    let working = precision + 32 + 2 * distance;
    let gamma = |q: &Rational| Interval::from_rational(q, working).gamma();
    let value = gamma(x)?.div(&gamma(y)?)?;
    Ok(value.with_precision(precision))
}
