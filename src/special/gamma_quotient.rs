//! Quotients of products of Gamma functions, without overflow where only the factors are large.
//!
//! - Two arguments a small integer apart leave a product: Gamma(x + n)/Gamma(x) = (x)_n (DLMF 5.2.5).
//! - Arguments of moderate size: the interval Gamma itself.
//! - Large ones: exp of the sum of ln|Gamma|, with as many more bits as the logarithms have before
//!   the point. Below 0 by reflection, Gamma(x) = pi/(sin(pi x) Gamma(1 - x)) (DLMF 5.5.3).
//! - 1/Gamma is 0 at the poles of Gamma.

use super::{may_be_pole, nonpositive_integer, widen};
use crate::number::{DomainError, Interval};
use std::cmp::Ordering;

/// Arguments up to this size go through Gamma itself.
const MODERATE: i32 = 1 << 10;

/// Arguments with a larger binary exponent are left alone: their logarithm alone would need that
/// many more bits.
const MAX_EXPONENT: i32 = 1 << 12;

/// Arguments this far apart are replaced by a product.
const NEAR: i64 = 256;

/// Gamma(n_1) Gamma(n_2) ... / (Gamma(d_1) Gamma(d_2) ...).
///
/// # Errors
/// `Certain` where a numerator has a pole and no denominator may have one; `Possible` where both
/// have, where a pole may lie inside an argument, or for arguments beyond 2^4096.
pub fn gamma_quotient(
    numerators: &[Interval],
    denominators: &[Interval],
    precision: u32,
) -> Result<Interval, DomainError> {
    if numerators.iter().any(|x| nonpositive_integer(x).is_some()) {
        return Err(if denominators.iter().any(may_be_pole) {
            DomainError::Possible
        } else {
            DomainError::Certain
        });
    }
    if numerators.iter().any(may_be_pole) {
        return Err(DomainError::Possible);
    }
    if denominators
        .iter()
        .any(|x| nonpositive_integer(x).is_some())
    {
        return Ok(Interval::from_i64(0, precision));
    }
    if denominators.iter().any(may_be_pole) {
        return Err(DomainError::Possible);
    }
    let arguments = || numerators.iter().chain(denominators);
    let exponent = arguments().filter_map(size_exponent).max().unwrap_or(0);
    if exponent > MAX_EXPONENT || arguments().any(|x| !x.is_bounded()) {
        return Err(DomainError::Possible);
    }
    // |ln Gamma(x)| < 2^(2e) for |x| < 2^e and e >= 5: that many bits stand before the point.
    let working = precision + 32 + exponent.max(5).unsigned_abs() * 2;
    quotient_of_finite(numerators, denominators, working).map(|q| q.with_precision(precision))
}

/// The largest binary exponent of the two ends.
fn size_exponent(x: &Interval) -> Option<i32> {
    x.low().get_exp().max(x.high().get_exp())
}

/// The quotient where no argument may be a pole.
fn quotient_of_finite(
    numerators: &[Interval],
    denominators: &[Interval],
    working: u32,
) -> Result<Interval, DomainError> {
    let mut below: Vec<Interval> = denominators
        .iter()
        .map(|x| widen([x], working)[0].clone())
        .collect();
    let mut product = Interval::from_i64(1, working);
    let mut logarithm = Interval::from_i64(0, working);
    for x in numerators {
        let [x] = widen([x], working);
        if let Some((index, steps)) = near(&x, &below) {
            let y = below.swap_remove(index);
            product = product.mul(&shift(&x, &y, steps)?);
        } else {
            multiply(&x, &mut product, &mut logarithm)?;
        }
    }
    let mut divisor = Interval::from_i64(1, working);
    for y in &below {
        let mut size = Interval::from_i64(0, working);
        multiply(y, &mut divisor, &mut size)?;
        logarithm = logarithm.sub(&size);
    }
    product.div(&divisor).map(|q| q.mul(&logarithm.exp()))
}

/// The denominator that is a point a small integer `steps` below the point `x`.
fn near(x: &Interval, below: &[Interval]) -> Option<(usize, i64)> {
    below.iter().enumerate().find_map(|(index, y)| {
        if !x.is_point() || !y.is_point() {
            return None;
        }
        let steps = x.sub(y).as_integer()?.to_i64()?;
        (steps.abs() <= NEAR).then_some((index, steps))
    })
}

/// Gamma(x)/Gamma(y) for x = y + steps.
fn shift(x: &Interval, y: &Interval, steps: i64) -> Result<Interval, DomainError> {
    let (start, count) = if steps >= 0 { (y, steps) } else { (x, -steps) };
    let mut product = Interval::from_i64(1, x.precision());
    for step in 0..count {
        product = product.mul(&start.add(&Interval::from_i64(step, x.precision())));
    }
    if steps >= 0 {
        Ok(product)
    } else {
        Interval::from_i64(1, x.precision()).div(&product)
    }
}

/// Takes Gamma(x) into the product, or |Gamma(x)| into the logarithm and its sign into the product.
fn multiply(
    x: &Interval,
    product: &mut Interval,
    logarithm: &mut Interval,
) -> Result<(), DomainError> {
    if *x.low() >= -MODERATE && *x.high() <= MODERATE {
        *product = product.mul(&x.gamma()?);
    } else if *x.low() > 0 {
        *logarithm = logarithm.add(&x.lngamma()?);
    } else {
        let one = Interval::from_i64(1, x.precision());
        let sine = Interval::pi(x.precision()).mul(x).sin();
        let sign = sine.sign().filter(|s| *s != Ordering::Equal);
        let sign = sign.ok_or(DomainError::Possible)?;
        let reflected = one.sub(x).lngamma()?;
        let factor = Interval::pi(x.precision()).div(&sine.abs())?.ln()?;
        *logarithm = logarithm.add(&factor.sub(&reflected));
        if sign == Ordering::Less {
            *product = product.neg();
        }
    }
    Ok(())
}

/// Euler's Beta function Gamma(a) Gamma(b)/Gamma(a + b), DLMF 5.12.1, continued to negative a, b.
///
/// # Errors
/// As [`gamma_quotient`].
pub fn beta(a: &Interval, b: &Interval, precision: u32) -> Result<Interval, DomainError> {
    let [a, b] = widen([a, b], exact_precision(&[a, b], precision));
    let sum = a.add(&b);
    gamma_quotient(&[a, b], &[sum], precision)
}

/// At least `precision` bits, enough to hold sums of a few of the points among the values exactly,
/// as far as that is reasonable.
pub(super) fn exact_precision(values: &[&Interval], precision: u32) -> u32 {
    let points = values.iter().filter(|x| x.is_point()).map(|x| x.low());
    let (least, most) = points.fold((0, 0), |(least, most), x| {
        let top = x.get_exp().unwrap_or(0);
        let significand = x.get_significand();
        let last = significand.map_or(0, |s| s.significant_bits() - s.find_one(0).unwrap_or(0));
        let bottom = top.saturating_sub_unsigned(last);
        (bottom.min(least), top.max(most))
    });
    let span = most.min(MAX_EXPONENT) - least.max(-MAX_EXPONENT);
    precision.max(span.unsigned_abs() + 8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    fn point(n: i64, d: i64) -> Interval {
        Interval::from_rational(&Rational::from((n, d)), 120)
    }

    #[test]
    fn large_arguments_do_not_overflow() {
        let large = 1_000_000_000_000;
        let quotient = gamma_quotient(&[point(large - 1, 1)], &[point(large, 1)], 100);
        let expected = Rational::from((1, large - 1));
        assert!(quotient.is_ok_and(|q| q.contains_rational(&expected) && q.agrees_to(29)));
        // Gamma(x + 1000)/Gamma(x) lies between x^1000 and (x + 1000)^1000.
        let far = gamma_quotient(&[point(large + 1000, 1)], &[point(large, 1)], 100);
        let (low, high) = (
            point(large, 1).powi(1000),
            point(large + 1000, 1).powi(1000),
        );
        assert!(far.is_ok_and(|q| q.agrees_to(28)
            && low.is_ok_and(|l| l.is_below(&q))
            && high.is_ok_and(|h| q.is_below(&h))));
    }

    #[test]
    fn poles_and_signs() {
        assert_eq!(
            gamma_quotient(&[point(-2, 1)], &[point(1, 2)], 60),
            Err(DomainError::Certain)
        );
        assert_eq!(
            gamma_quotient(&[point(-2, 1)], &[point(-1, 1)], 60),
            Err(DomainError::Possible)
        );
        assert!(gamma_quotient(&[point(1, 2)], &[point(-1, 1)], 60).is_ok_and(|q| q.is_point()));
        // Gamma(-4001/2)/Gamma(-4003/2) = -4003/2: one by reflection, both signs right.
        let quotient = quotient_of_finite(&[point(-4001, 2)], &[point(-4003, 2)], 200);
        assert!(quotient.is_ok_and(|q| q.contains_rational(&Rational::from((-4003, 2)))));
        let far = gamma_quotient(&[point(-5001, 2)], &[point(-3001, 2)], 200);
        assert!(far.is_ok_and(|q| q.agrees_to(50) && *q.low() > 0));
    }

    #[test]
    fn beta_of_integers() {
        let value = beta(&point(3, 1), &point(4, 1), 100);
        assert!(
            value.is_ok_and(|b| b.contains_rational(&Rational::from((1, 60))) && b.agrees_to(28))
        );
        assert_eq!(
            beta(&point(0, 1), &point(4, 1), 100),
            Err(DomainError::Certain)
        );
    }
}
