//! `exp(ln Gamma(x) - ln Gamma(y))` for x, y > 0. For 0 < x < 2^e, e >= 5, |ln Gamma(x)| < 2^(2e): that many bits
//! stand before the point and are lost to the ratio, and they are added beforehand. In f64, where they cannot be, the
//! ratio has log10(x ln x) digits fewer.

use super::{exponent, gamma_cost, positive};
use crate::number::{DomainError, Interval};
use rug::Rational;

/// Arguments beyond 2^4096 are left alone.
const MOST_EXPONENT: u32 = 1 << 12;

pub(super) fn cost(x: &Rational, y: &Rational, precision: u32) -> Option<f64> {
    let exponent = exponent(x, y);
    (positive(x, y) && exponent <= MOST_EXPONENT)
        .then(|| 4.0 * gamma_cost(precision + 2 * exponent, exponent))
}

pub(super) fn ratio(x: &Rational, y: &Rational, precision: u32) -> Result<Interval, DomainError> {
    let working = precision + 32 + 2 * exponent(x, y).max(5);
    let logarithm = |q: &Rational| Interval::from_rational(q, working).lngamma();
    let value = logarithm(x)?.sub(&logarithm(y)?).exp();
    Ok(value.with_precision(precision))
}
