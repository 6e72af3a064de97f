//! Elementary functions and Gamma, from one kind of series with a geometric bound on its tail.

use super::interval::{Interval, integer_power};
use super::{Found, Gap, Unknown, unknown};
use crate::formula::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;

/// No number of more bits than this is made on purpose.
pub(super) const SIZE_CAP: u64 = 1 << 20;
/// No series is summed to more terms.
pub(super) const TERMS_CAP: u64 = 20_000;

/// 1 + r_0 + r_0*r_1 + ... for factors of which all from r_j on have |r_i| <= q_j, where that is
/// known: with q_j < 1 the rest from the term T_j on is at most |T_j|/(1-q_j), a geometric series.
/// Terms and sum are pairs of integers that enclose them, in units of 2^-(bits + 24).
pub(super) fn series(
    bits: u64,
    factor: impl Fn(&Rational) -> Rational,
    bound: impl Fn(&Rational) -> Option<Rational>,
) -> Result<Interval, Unknown> {
    let unit = BigInt::one() << (bits + 24);
    let negligible = Rational::from_integer(BigInt::one() << 20);
    let mut term = [unit.clone(), unit.clone()];
    let mut sum = [BigInt::ZERO, BigInt::ZERO];
    for j in 0..TERMS_CAP {
        let j = Rational::from_integer(j.into());
        let size = Rational::from_integer(term[0].abs().max(term[1].abs()));
        if let Some(gap) = bound(&j).map(|bound| Rational::one() - bound)
            && gap.is_positive()
            && size <= &negligible * &gap
        {
            let end = |n: BigInt| Rational::new(n, unit.clone());
            let rest = (size / gap).ceil().to_integer();
            return Ok(Interval::between(end(&sum[0] - &rest), end(&sum[1] + rest)));
        }
        sum = [&sum[0] + &term[0], &sum[1] + &term[1]];
        let factor = factor(&j);
        term = term.map(|end| end * factor.numer());
        term.sort();
        term = [
            term[0].div_floor(factor.denom()),
            term[1].div_ceil(factor.denom()),
        ];
    }
    unknown("a series that converges too slowly")
}

/// The sum of square^j*z/(2j+1): artanh z for square = z^2 and arctan z for square = -z^2, DLMF
/// 4.38.5 and 4.24.3.
fn arc(z: &Rational, square: &Rational, bits: u64) -> Result<Interval, Unknown> {
    let half = Rational::new(1.into(), 2.into());
    let factor = |j: &Rational| square * (j + &half) / (j + &half + Rational::one());
    let sum = series(bits, factor, |_| Some(square.abs()))?;
    Ok(&sum * &Interval::exact(z.clone()))
}

/// ln q for q > 0: q = 2^e*y with 1/2 < y < 2 and ln y = 2*artanh((y-1)/(y+1)), DLMF 4.6.4.
pub(super) fn ln(q: &Rational, bits: u64) -> Result<Interval, Unknown> {
    if !q.is_positive() {
        return unknown("the logarithm of a number that is not positive");
    }
    let one = Rational::one();
    let ratio = |y: &Rational| (y - &one) / (y + &one);
    // Near 1 nothing is split off, so that small logarithms keep their digits.
    let near = (ratio(q) * Rational::from_integer(5.into()))
        .to_integer()
        .is_zero();
    let exponent = match near {
        true => 0,
        false => q.numer().bits() as i64 - q.denom().bits() as i64,
    };
    let y = q / two_to(exponent);
    let half = |y: &Rational| arc(&ratio(y), &(ratio(y) * ratio(y)), bits);
    let of_two = &half(&two_to(1))? * &Interval::integer(exponent);
    Ok(&(&of_two + &half(&y)?) * &Interval::integer(2))
}

fn two_to(exponent: i64) -> Rational {
    Rational::from_integer(2.into()).pow(exponent)
}

/// pi = 16*arctan(1/5) - 4*arctan(1/239), Machin; follows from DLMF 4.24.15.
pub(super) fn pi(bits: u64) -> Result<Interval, Unknown> {
    let part = |factor: i64, n: i64| {
        let z = Rational::new(1.into(), n.into());
        Ok(&arc(&z, &-(&z * &z), bits)? * &Interval::integer(factor))
    };
    Ok(&part(16, 5)? + &part(-4, 239)?)
}

/// e^x by Taylor's series at y = x/2^s with |y| < 1, DLMF 4.2.19, and s squarings, each of which
/// at most doubles the relative width.
pub(super) fn exp(x: &Rational, bits: u64) -> Result<Interval, Unknown> {
    let squarings = x.abs().ceil().to_integer().bits();
    if squarings > 16 {
        return unknown("exp of a large number");
    }
    let y = x / two_to(squarings as i64);
    let bits = bits + squarings;
    let mut result = series(bits, |j| &y / (j + Rational::one()), |_| Some(y.abs()))?;
    for _ in 0..squarings {
        result = result.power(2).rounded(bits);
    }
    Ok(result)
}

/// sin x by Taylor's series, DLMF 4.19.1.
pub(super) fn sin(x: &Interval, bits: u64) -> Result<Interval, Unknown> {
    around_middle(x, |z| {
        Ok(&circular(z, 2, bits)? * &Interval::exact(z.clone()))
    })
}

/// cos x by Taylor's series, DLMF 4.19.2.
pub(super) fn cos(x: &Interval, bits: u64) -> Result<Interval, Unknown> {
    around_middle(x, |z| circular(z, 1, bits))
}

/// 1 - z^2/(n(n+1)) + z^4/(n(n+1)(n+2)(n+3)) - ...: cos z for n = 1, sin z/z for n = 2.
fn circular(z: &Rational, n: u32, bits: u64) -> Result<Interval, Unknown> {
    if z.abs() > Rational::from_integer(256.into()) {
        return unknown("sin or cos of a large number");
    }
    let n = Rational::from_integer(n.into());
    let factor = |j: &Rational| {
        let place = j + j + &n;
        -z * z / (&place * (&place + Rational::one()))
    };
    series(bits, factor, |j| Some(factor(j).abs()))
}

/// The values of a function that moves no faster than its argument.
fn around_middle(
    x: &Interval,
    value: impl Fn(&Rational) -> Result<Interval, Unknown>,
) -> Result<Interval, Unknown> {
    let middle = (x.low() + x.high()) / Rational::from_integer(2.into());
    let radius = x.high() - &middle;
    let there = value(&middle)?;
    Ok(Interval::between(
        there.low() - &radius,
        there.high() + radius,
    ))
}

/// The index-th root of q >= 0: exact where numerator and denominator are perfect powers, else
/// from floor(floor(y)^(1/n)) = floor(y^(1/n)).
pub(super) fn root(q: &Rational, index: u32, bits: u64) -> Result<Interval, Unknown> {
    let near = Rational::new(q.numer().nth_root(index), q.denom().nth_root(index));
    if integer_power(&near, index) == *q {
        return Ok(Interval::exact(near));
    }
    let scale = bits + q.denom().bits() / u64::from(index);
    let scaled = q.numer() << (scale * u64::from(index));
    let floor = scaled.div_floor(q.denom()).nth_root(index);
    let unit = BigInt::one() << scale;
    let above = Rational::new(&floor + 1, unit.clone());
    Ok(Interval::between(Rational::new(floor, unit), above))
}

/// x^y.
pub(super) fn power(x: &Interval, y: &Interval, bits: u64) -> Found<Interval> {
    match y.as_exact() {
        Some(exponent) if exponent.is_integer() => integer_exponent(x, exponent.numer()),
        Some(exponent) => fractional_exponent(x, exponent, bits),
        None => {
            let exponent = &x.increasing(|q| ln(q, bits))? * y;
            Ok(exponent.increasing(|q| exp(q, bits))?)
        }
    }
}

/// x^n, with x^0 = 1 also at x = 0, and no value for negative powers of zero.
fn integer_exponent(x: &Interval, exponent: &BigInt) -> Found<Interval> {
    let magnitude = match exponent.abs().to_u32() {
        Some(magnitude) if x.size().saturating_mul(magnitude.into()) <= SIZE_CAP => magnitude,
        _ => return unknown("a power that is too large"),
    };
    match (exponent.is_negative(), x.is_zero()) {
        (false, _) => Ok(x.power(magnitude)),
        (true, true) => Err(Gap::Undefined),
        (true, false) => Ok(x.power(magnitude).reciprocal()?),
    }
}

/// x^(p/q) in lowest terms with q > 1: real for x > 0, 0 at x = 0 for p > 0, else without value.
fn fractional_exponent(x: &Interval, exponent: &Rational, bits: u64) -> Found<Interval> {
    if x.high().is_negative() {
        return Err(Gap::Undefined);
    }
    if x.low().is_negative() {
        return unknown("a root of what may be negative at these bits");
    }
    match exponent.denom().to_u32() {
        Some(index) if index <= 1024 => {
            let base = x.increasing(|q| root(q, index, bits))?;
            integer_exponent(&base, exponent.numer())
        }
        _ => unknown("a power with a large denominator in its exponent"),
    }
}

/// ln of a number; there is none for x <= 0.
pub(super) fn logarithm(x: &Interval, bits: u64) -> Found<Interval> {
    match x.sign() {
        _ if !x.high().is_positive() => Err(Gap::Undefined),
        Ok(Ordering::Greater) => Ok(x.increasing(|q| ln(q, bits))?),
        _ => unknown("a logarithm of what may not be positive at these bits"),
    }
}

/// n! with its size bounded first: n! <= n^n. There is none for n < 0, where Gamma has its poles.
pub(super) fn factorial(n: &BigInt) -> Found<BigInt> {
    if n.is_negative() {
        return Err(Gap::Undefined);
    }
    match n.to_u64() {
        Some(count) if count.saturating_mul(n.bits()) <= SIZE_CAP => {
            Ok((2..=count).fold(BigInt::one(), |product, j| product * j))
        }
        _ => unknown("a factorial that is too large"),
    }
}

/// a*(a+1)*...*(a+n-1), DLMF 5.2.4, with its size bounded first.
pub(super) fn pochhammer(a: &Interval, n: &BigInt) -> Result<Interval, Unknown> {
    let count = n.to_u64().unwrap_or(u64::MAX);
    let step_size = a.size().saturating_add(n.bits() + 1);
    if count.saturating_mul(step_size) > SIZE_CAP {
        return unknown("pochhammer of a negative or too large length");
    }
    let product = |product, j| &product * &(a + &Interval::integer(j));
    Ok((0..count).fold(Interval::integer(1), product))
}

/// binomial(n, k) = (n-k+1)_k/k! for integer k; 0 for k < 0.
pub(super) fn binomial(n: &Interval, k: &BigInt) -> Found<Interval> {
    if k.is_negative() {
        return Ok(Interval::integer(0));
    }
    let product = pochhammer(&(n - &Interval::integer(k - 1)), k)?;
    Ok(&product * &Interval::integer(factorial(k)?).reciprocal()?)
}

/// Gamma at an integer or half an odd integer, DLMF 5.4.1, 5.4.6 and 5.5.1; none at its poles.
pub(super) fn gamma(x: &Rational, bits: u64) -> Found<Interval> {
    if x.is_integer() {
        return Ok(Interval::integer(factorial(&(x.numer() - 1))?));
    }
    if *x.denom() != BigInt::from(2) {
        return unknown("gamma away from integers and half integers");
    }
    let half = Rational::new(1.into(), 2.into());
    let root_of_pi = pi(bits)?.increasing(|q| root(q, 2, bits))?;
    let steps = (x - &half).to_integer();
    let factor = if steps.is_negative() {
        // Gamma(1/2) = (x)_n*Gamma(x) with n = 1/2 - x, and no factor is zero.
        pochhammer(&Interval::exact(x.clone()), &-steps)?.reciprocal()?
    } else {
        pochhammer(&Interval::exact(half), &steps)?
    };
    Ok(&factor * &root_of_pi)
}

/// Euler's Beta function at integers and half integers a, b > 0, DLMF 5.12.1.
pub(super) fn beta(a: &Rational, b: &Rational, bits: u64) -> Found<Interval> {
    if !a.is_positive() || !b.is_positive() {
        return unknown("beta of an argument that is not positive");
    }
    let above = &gamma(a, bits)? * &gamma(b, bits)?;
    Ok(&above * &gamma(&(a + b), bits)?.reciprocal()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(a.into(), b.into())
    }

    /// Decimal digits of a number in 0..10, as an interval of width 10^-digits.
    fn digits(text: &str) -> Interval {
        let whole: BigInt = text.replace('.', "").parse().unwrap();
        let places = text.len() - text.find('.').unwrap() - 1;
        let unit = BigInt::from(10).pow(places as u32);
        Interval::between(
            Rational::new(whole.clone(), unit.clone()),
            Rational::new(whole + 1, unit),
        )
    }

    fn check(found: &Interval, known: &str) {
        let known = digits(known);
        assert!(found.low() <= known.high() && known.low() <= found.high());
        assert!(found.high() - found.low() < ratio(1, 1 << 60) * ratio(1, 1 << 30));
    }

    /// OEIS A000796, A002162, A001113, A002193, A002161, A049469, A049470.
    #[test]
    fn constants_agree_with_their_published_digits() {
        check(&pi(128).unwrap(), "3.14159265358979323846264338327950288");
        check(
            &ln(&ratio(2, 1), 128).unwrap(),
            "0.69314718055994530941723212145817656",
        );
        check(
            &exp(&ratio(1, 1), 128).unwrap(),
            "2.71828182845904523536028747135266249",
        );
        check(
            &root(&ratio(2, 1), 2, 128).unwrap(),
            "1.41421356237309504880168872420969807",
        );
        check(
            &gamma(&ratio(1, 2), 128).unwrap(),
            "1.77245385090551602729816748334114518",
        );
        let one = Interval::integer(1);
        check(
            &sin(&one, 128).unwrap(),
            "0.84147098480789650665250232163029899",
        );
        check(
            &cos(&one, 128).unwrap(),
            "0.54030230586813971740093660744297660",
        );
    }

    #[test]
    fn exact_values_stay_exact() {
        assert_eq!(root(&ratio(9, 4), 2, 64), Ok(Interval::exact(ratio(3, 2))));
        assert_eq!(ln(&ratio(1, 1), 64), Ok(Interval::integer(0)));
        assert_eq!(gamma(&ratio(5, 1), 64), Ok(Interval::integer(24)));
        assert_eq!(gamma(&ratio(-3, 1), 64), Err(Gap::Undefined));
        let minus_two = Interval::integer(-2);
        assert_eq!(binomial(&minus_two, &3.into()), Ok(Interval::integer(-4)));
        assert_eq!(
            power(&Interval::integer(0), &Interval::integer(0), 64),
            Ok(Interval::integer(1))
        );
        assert_eq!(
            power(&Interval::integer(0), &Interval::integer(-1), 64),
            Err(Gap::Undefined)
        );
    }

    /// Of small roots, large powers and logarithms near 0 too the digits asked for are there, and not
    /// many more.
    #[test]
    fn enclosures_are_as_narrow_as_asked_for() {
        for (found, size) in [
            (root(&ratio(2, 1).pow(-201_i64), 2, 64), 500),
            (root(&ratio(2, 1).pow(201_i64), 2, 64), 500),
            (root(&ratio(7, 5), 3, 64), 500),
            (ln(&ratio((1 << 30) - 1, 1 << 30), 64), 500),
            (ln(&ratio(2, 1).pow(-100_i64), 64), 500),
            (exp(&ratio(100, 1), 64), 500),
            (exp(&ratio(-100, 3), 64), 500),
            (exp(&ratio(65535, 1), 64), 95_000),
        ] {
            let found = found.unwrap();
            let width = (found.high() - found.low()) / found.low().abs();
            assert!(width < ratio(1, 1 << 60) && found.size() < size);
        }
    }

    /// The values at all numbers of an interval lie in that of the interval, and not much else does.
    #[test]
    fn sin_and_cos_of_intervals() {
        let wide = Interval::between(ratio(1, 1), ratio(2, 1));
        for (function, low, high) in [
            (sin as fn(&Interval, u64) -> _, ratio(84, 100), ratio(1, 1)),
            (cos, ratio(-42, 100), ratio(55, 100)),
        ] {
            let found: Interval = function(&wide, 64).unwrap();
            assert!(*found.low() < low && *found.high() > high);
            assert!(found.high() - found.low() < ratio(101, 100));
            assert!(function(&Interval::integer(257), 64).is_err());
            assert!(function(&Interval::integer(-256), 64).is_ok());
        }
        assert_eq!(sin(&Interval::integer(0), 64), Ok(Interval::integer(0)));
        assert_eq!(cos(&Interval::integer(0), 64), Ok(Interval::integer(1)));
    }

    #[test]
    fn sizes_have_a_cap() {
        let base = |bits: u64| Interval::integer(BigInt::one() << (bits - 2));
        // One factor of this size, and a bit for the length and the sum each.
        assert!(pochhammer(&base(SIZE_CAP - 2), &1.into()).is_ok());
        assert!(pochhammer(&base(SIZE_CAP - 1), &1.into()).is_err());
        assert!(integer_exponent(&base(SIZE_CAP), &1.into()).is_ok());
        assert!(integer_exponent(&base(SIZE_CAP + 1), &1.into()).is_err());
        // n bits(n) is 2^12*13, and 2^16*17.
        assert!(factorial(&4096.into()).is_ok());
        assert!(factorial(&65536.into()).is_err());
        // Only now sizes that nobody could wait for.
        let huge = BigInt::one() << 70_u32;
        assert!(factorial(&huge).is_err());
        assert!(binomial(&Interval::integer(huge.clone()), &(BigInt::one() << 60_u32)).is_err());
        assert!(power(&Interval::integer(2), &Interval::integer(huge.clone()), 64).is_err());
        assert!(exp(&Rational::from_integer(huge), 64).is_err());
        assert!(exp(&ratio(65536, 1), 64).is_err());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn more_bits_lie_within_fewer(a in 1_i64..10_000, b in 1_i64..10_000, bits in 32_u64..200) {
            let q = ratio(a, b);
            for (few, many) in [
                (ln(&q, bits).unwrap(), ln(&q, 2 * bits).unwrap()),
                (root(&q, 3, bits).unwrap(), root(&q, 3, 2 * bits).unwrap()),
                (pi(bits).unwrap(), pi(2 * bits).unwrap()),
            ] {
                prop_assert!(few.low() <= many.low() && many.high() <= few.high());
            }
        }

        #[test]
        fn ln_turns_products_into_sums(a in 1_i64..999, b in 1_i64..999, c in 1_i64..999) {
            let (p, q) = (ratio(a, b), ratio(b, c));
            let sum = &ln(&p, 90).unwrap() + &ln(&q, 90).unwrap();
            let rest = &sum - &ln(&(p * q), 90).unwrap();
            prop_assert!(rest.sign().is_ok_and(|s| s.is_eq()) || rest.sign().is_err());
        }

        #[test]
        fn exp_undoes_ln(a in 1_i64..999, b in 1_i64..999) {
            let q = ratio(a, b);
            let back = ln(&q, 90).unwrap().increasing(|x| exp(x, 90)).unwrap();
            prop_assert!(*back.low() <= q && q <= *back.high());
        }
    }
}
