//! Pochhammer's symbol and binomial coefficients.
//!
//! A short product is multiplied out. A long one is a quotient of Gamma functions (DLMF 5.2.5);
//! where the start is a nonpositive integer -p, (−p)_n = (-1)^n (p - n + 1)_n (DLMF 5.2.6), whose
//! factors are positive, and 0 for n > p.

use super::gamma_quotient::{exact_precision, gamma_quotient};
use super::{nonpositive_integer, widen};
use crate::number::{DomainError, Interval};
use rug::Integer;

/// Products of at most so many factors are multiplied out.
const SHORT: u32 = 512;

/// Pochhammer's symbol (a)_n = a (a+1) ... (a+n-1), DLMF 5.2.4; for n < 0 it is
/// Gamma(a + n)/Gamma(a) = 1/((a+n)(a+n+1)...(a-1)).
///
/// # Errors
/// For n < 0 `Certain` where one of these factors is 0, `Possible` where one may be. For |n| > 512
/// also `Possible` where a nonpositive integer may lie in a wide interval `a` or `a + n`.
pub fn pochhammer(a: &Interval, n: &Integer, precision: u32) -> Result<Interval, DomainError> {
    let size = Interval::from_integer(n, precision.max(n.significant_bits()));
    let [a, shift] = widen([a, &size], exact_precision(&[a, &size], precision) + 32);
    if n.cmp0().is_lt() {
        let rising = pochhammer(&a.add(&shift), &Integer::from(-n), a.precision())?;
        let inverse = Interval::from_i64(1, a.precision()).div(&rising)?;
        return Ok(inverse.with_precision(precision));
    }
    if let Some(count) = n.to_u32()
        && count <= SHORT
    {
        return Ok(product(&a, count).with_precision(precision));
    }
    if let Some(p) = nonpositive_integer(&a) {
        return falling(&p, n, precision);
    }
    gamma_quotient(&[a.add(&shift)], &[a], precision)
}

fn product(start: &Interval, count: u32) -> Interval {
    let precision = start.precision();
    (0..count).fold(Interval::from_i64(1, precision), |product, step| {
        product.mul(&start.add(&Interval::from_i64(step.into(), precision)))
    })
}

/// (-p)_n for p >= 0.
fn falling(p: &Integer, n: &Integer, precision: u32) -> Result<Interval, DomainError> {
    if n > p {
        return Ok(Interval::from_i64(0, precision));
    }
    let bits = precision.max(p.significant_bits() + 1);
    let top = Interval::from_integer(&Integer::from(p + 1), bits);
    let bottom = Interval::from_integer(&(Integer::from(p - n) + 1), bits);
    let size = gamma_quotient(&[top], &[bottom], precision)?;
    Ok(if n.is_odd() { size.neg() } else { size })
}

/// The binomial coefficient (n - k + 1)_k / k! for real n and integer k (DLMF 1.2.6); 0 for k < 0.
///
/// # Errors
/// `Possible` for k > 512 where a nonpositive integer may lie in the wide interval n - k + 1.
pub fn binomial(n: &Interval, k: &Integer, precision: u32) -> Result<Interval, DomainError> {
    if k.cmp0().is_lt() {
        return Ok(Interval::from_i64(0, precision));
    }
    let count = Interval::from_integer(k, precision.max(k.significant_bits()));
    let [n, count] = widen([n, &count], exact_precision(&[n, &count], precision) + 32);
    let one = Interval::from_i64(1, n.precision());
    let rising = pochhammer(&n.sub(&count).add(&one), k, n.precision())?;
    let factorial = gamma_quotient(&[], &[count.add(&one)], n.precision())?;
    if factorial.contains_zero() {
        // 1/k! underflows: take the quotient as one.
        return large_binomial(&n, &count, k, precision);
    }
    Ok(rising.mul(&factorial).with_precision(precision))
}

/// The binomial coefficient for a k whose factorial overflows.
fn large_binomial(
    n: &Interval,
    count: &Interval,
    k: &Integer,
    precision: u32,
) -> Result<Interval, DomainError> {
    let one = Interval::from_i64(1, n.precision());
    let below = [n.sub(count).add(&one), count.add(&one)];
    if nonpositive_integer(&n.add(&one)).is_none() {
        return gamma_quotient(&[n.add(&one)], &below, precision);
    }
    // n < 0 an integer: (-1)^k (k - n - 1 choose k).
    let size = gamma_quotient(&[count.sub(n)], &[n.neg(), count.add(&one)], precision)?;
    Ok(if k.is_odd() { size.neg() } else { size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rug::Rational;

    fn point(n: i64, d: i64) -> Interval {
        Interval::from_rational(&Rational::from((n, d)), 120)
    }

    fn exact_pochhammer(a: &Rational, n: u32) -> Rational {
        (0..n).fold(Rational::from(1), |p, i| p * (a.clone() + i))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn products_hold_exact_values(n in -4000i64..4000, d in 1i64..5, count in 0u32..900) {
            let a = Rational::from((n, d));
            let exact = exact_pochhammer(&a, count);
            let k = Integer::from(count);
            let value = pochhammer(&point(n, d), &k, 100);
            prop_assert!(value == Err(DomainError::Possible) && count > SHORT && d > 2
                || value.is_ok_and(|v| v.contains_rational(&exact)));
            let factorial = Integer::from(Integer::factorial(count));
            let top = Rational::from((n, d)) - 1 + count;
            let chosen = binomial(&Interval::from_rational(&top, 160), &k, 100);
            prop_assert!(chosen == Err(DomainError::Possible) && count > SHORT && d > 2
                || chosen.is_ok_and(|v| v.contains_rational(&(exact / factorial))));
        }
    }

    #[test]
    fn corners() {
        let value = |a, n: i64| pochhammer(&point(a, 1), &Integer::from(n), 60);
        assert_eq!(value(3, -3), Err(DomainError::Certain));
        assert!(value(3, -2).is_ok_and(|v| v.contains_rational(&Rational::from((1, 2)))));
        assert!(value(-5, 1 << 40).is_ok_and(|v| v.is_point() && v.contains_zero()));
        assert!(value(0, 0).is_ok_and(|v| v == Interval::from_i64(1, 60)));
        assert!(binomial(&point(5, 1), &Integer::from(-1), 60).is_ok_and(|v| v.contains_zero()));
        // (10^12 choose 10^12 - 2) from both ends of the triangle.
        let large = 1_000_000_000_000i64;
        let exact = Rational::from(Integer::from(large) * Integer::from(large - 1) / 2);
        let chosen = binomial(&point(large, 1), &Integer::from(large - 2), 100);
        assert!(chosen.is_ok_and(|v| v.contains_rational(&exact) && v.agrees_to(25)));
        // (-2 choose k) = (-1)^k (k + 1).
        let negative = binomial(&point(-2, 1), &Integer::from(large + 1), 100);
        assert!(
            negative
                .is_ok_and(|v| v.contains_rational(&Rational::from(-large - 2)) && v.agrees_to(25))
        );
    }
}
