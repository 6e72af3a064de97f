//! Elementary functions and Gamma at exact points, by series whose tails are bounded here.
//!
//! Series are summed twice in fixed point, once rounding every step down and once up, so that the
//! two sums enclose the partial sum; the tail is then added. Terms shrink at least by one half from
//! where a loop may stop, so that it ends after at most about `scale` rounds and the tail is at
//! most the last term.

use super::interval::{Interval, dyadic, integer_power, size};
use super::{Unknown, unknown};
use crate::formula::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;

/// No number of more bits than this is made on purpose.
pub(super) const SIZE_CAP: u64 = 1 << 20;
/// No series is summed to more bits than this.
const SCALE_CAP: u64 = 1 << 15;

/// Two integers that enclose a real number times a power of two.
struct Fixed {
    low: BigInt,
    high: BigInt,
}

impl Fixed {
    fn over(self, scale: u64) -> Interval {
        Interval::between(dyadic(self.low, scale), dyadic(self.high, scale))
    }
}

/// The number times 2^scale, rounded both ways.
fn fixed(number: &Rational, scale: u64) -> Fixed {
    let scaled: BigInt = number.numer() << scale;
    Fixed {
        low: scaled.div_floor(number.denom()),
        high: ceiling(&scaled, number.denom()),
    }
}

fn ceiling(a: &BigInt, b: &BigInt) -> BigInt {
    -((-a).div_floor(b))
}

/// a*b/2^scale for nonnegative a and b, rounded both ways.
fn product(a: &Fixed, b: &Fixed, scale: u64) -> Fixed {
    let unit: BigInt = BigInt::one() << scale;
    Fixed {
        low: (&a.low * &b.low) >> scale,
        high: ceiling(&(&a.high * &b.high), &unit),
    }
}

fn check_scale(scale: u64) -> Result<(), Unknown> {
    if scale > SCALE_CAP {
        return unknown("more bits than a series is summed to");
    }
    Ok(())
}

/// atanh(t) for 0 <= t <= 1/3: the sum of t^(2j+1)/(2j+1), DLMF 4.38.5. The terms shrink by
/// t^2 <= 1/9, so all that follow a term are together less than it.
fn atanh(t: &Rational, scale: u64) -> Fixed {
    let mut power = fixed(t, scale);
    let square = product(&power, &power, scale);
    let mut sum = Fixed {
        low: BigInt::zero(),
        high: BigInt::zero(),
    };
    let mut odd = BigInt::one();
    loop {
        sum.low += power.low.div_floor(&odd);
        sum.high += ceiling(&power.high, &odd);
        if power.high <= BigInt::one() {
            sum.high += &power.high;
            return sum;
        }
        power = product(&power, &square, scale);
        odd += 2;
    }
}

/// ln q for q > 0: q = 2^e*y with 1/2 < y < 2 and ln y = 2*atanh((y-1)/(y+1)), DLMF 4.6.4.
/// `bits` of it are right even near q = 1.
pub(super) fn ln(q: &Rational, bits: u64) -> Result<Interval, Unknown> {
    if !q.is_positive() {
        return unknown("the logarithm of a number that is not positive");
    }
    if q.is_one() {
        return Ok(Interval::integer(0));
    }
    let exponent = q.numer().bits() as i64 - q.denom().bits() as i64;
    let closeness = q.denom().bits() as i64 - (q.numer() - q.denom()).bits() as i64;
    let scale = bits + closeness.max(0) as u64 + 70;
    check_scale(scale)?;
    let y = q / two_to(exponent);
    let t = (&y - Rational::one()) / (&y + Rational::one());
    let positive = atanh(&t.abs(), scale).over(scale - 1);
    let ln_y = if t.is_negative() {
        positive.negated()
    } else {
        positive
    };
    let third = Rational::new(1.into(), 3.into());
    let ln_2 = atanh(&third, scale).over(scale - 1);
    let whole = ln_2.times(&Interval::integer(exponent), scale);
    Ok(whole.plus(&ln_y, bits))
}

fn two_to(exponent: i64) -> Rational {
    let power = Rational::from_integer(BigInt::one() << exponent.unsigned_abs());
    if exponent < 0 { power.recip() } else { power }
}

/// ln of every number of a positive interval: ln increases.
pub(super) fn ln_interval(x: &Interval, bits: u64) -> Result<Interval, Unknown> {
    if let Some(q) = x.as_exact() {
        return ln(q, bits);
    }
    let low = ln(x.low(), bits)?;
    let high = ln(x.high(), bits)?;
    Ok(Interval::between(low.low().clone(), high.high().clone()))
}

/// arctan(1/n) for n >= 2, DLMF 4.24.3: alternating terms that shrink by 1/n^2, so the rest after
/// a term is less than it.
fn arctan_inverse(n: u32, scale: u64) -> Fixed {
    let square = BigInt::from(n).pow(2);
    let unit: BigInt = BigInt::one() << scale;
    let mut power = Fixed {
        low: unit.div_floor(&n.into()),
        high: ceiling(&unit, &n.into()),
    };
    let mut sum = Fixed {
        low: BigInt::zero(),
        high: BigInt::zero(),
    };
    let (mut odd, mut positive) = (BigInt::one(), true);
    while power.high > BigInt::one() {
        let (low, high) = (power.low.div_floor(&odd), ceiling(&power.high, &odd));
        add_signed(&mut sum, low, high, positive);
        power.low = power.low.div_floor(&square);
        power.high = ceiling(&power.high, &square);
        odd += 2;
        positive = !positive;
    }
    sum.low -= &power.high;
    sum.high += &power.high;
    sum
}

fn add_signed(sum: &mut Fixed, low: BigInt, high: BigInt, positive: bool) {
    if positive {
        sum.low += low;
        sum.high += high;
    } else {
        sum.low -= high;
        sum.high -= low;
    }
}

/// pi = 16*arctan(1/5) - 4*arctan(1/239), Machin; follows from DLMF 4.24.15.
pub(super) fn pi(bits: u64) -> Result<Interval, Unknown> {
    let scale = bits + 16;
    check_scale(scale)?;
    let first = arctan_inverse(5, scale).over(scale - 4);
    let second = arctan_inverse(239, scale).over(scale - 2);
    Ok(first.minus(&second, bits))
}

/// e^x for an exact x. With 2^s > 2|x| the Taylor terms at |x|/2^s <= 1/2 shrink by one half at
/// least; then s squarings, each of which at most doubles the relative width.
pub(super) fn exp(x: &Rational, bits: u64) -> Result<Interval, Unknown> {
    if x.is_zero() {
        return Ok(Interval::integer(1));
    }
    if x.is_negative() {
        return match exp(&-x, bits + 2)?.reciprocal(bits) {
            Some(result) => Ok(result),
            None => unknown("exp: an enclosure that touches zero"),
        };
    }
    let ceiling = x.ceil().to_integer();
    if ceiling.bits() > 16 {
        return unknown("exp of a large number");
    }
    let squarings = ceiling.bits() + 1;
    let scale = bits + 2 * squarings + 16;
    check_scale(scale)?;
    let reduced = x / two_to(squarings as i64);
    let mut result = exp_taylor(&reduced, scale).over(scale);
    for _ in 0..squarings {
        result = result.times(&result.clone(), scale);
    }
    Ok(result.rounded(bits))
}

/// The sum of y^j/j! for 0 <= y <= 1/2.
fn exp_taylor(y: &Rational, scale: u64) -> Fixed {
    let step = fixed(y, scale);
    let mut term = fixed(&Rational::one(), scale);
    let mut sum = fixed(&Rational::zero(), scale);
    let mut j = BigInt::zero();
    loop {
        sum.low += &term.low;
        sum.high += &term.high;
        if term.high <= BigInt::one() {
            sum.high += &term.high;
            return sum;
        }
        j += 1;
        term = product(&term, &step, scale);
        term.low = term.low.div_floor(&j);
        term.high = ceiling(&term.high, &j);
    }
}

/// e^x on an interval: it increases.
pub(super) fn exp_interval(x: &Interval, bits: u64) -> Result<Interval, Unknown> {
    let low = exp(x.low(), bits)?;
    if x.is_exact() {
        return Ok(low);
    }
    let high = exp(x.high(), bits)?;
    Ok(Interval::between(low.low().clone(), high.high().clone()))
}

/// sin x or cos x on an interval: the value at its low end, widened by its width, since the
/// derivative is at most 1; never outside -1..1.
pub(super) fn wave(x: &Interval, sine: bool, bits: u64) -> Result<Interval, Unknown> {
    if x.is_zero() {
        return Ok(Interval::integer(i64::from(!sine)));
    }
    let width = x.high() - x.low();
    let at = wave_at(&x.low().abs(), sine, bits)?;
    let value = if sine && x.low().is_negative() {
        at.negated()
    } else {
        at
    };
    let one = Rational::one();
    let low = (value.low() - &width).max(-&one).min(one.clone());
    let high = (value.high() + &width).min(one.clone()).max(-one);
    Ok(Interval::between(low, high).rounded(bits))
}

/// sin or cos of x >= 0 by Taylor's series, DLMF 4.19.1 and 4.19.2. From j > 2x on the terms
/// x^j/j! shrink by one half at least, so the rest after a term is less than it.
fn wave_at(x: &Rational, sine: bool, bits: u64) -> Result<Interval, Unknown> {
    let bound = x.ceil().to_integer().to_u64().unwrap_or(u64::MAX);
    if bound > 64 {
        return unknown("sin or cos of a number beyond 64");
    }
    let scale = bits + 4 * bound + 16;
    check_scale(scale)?;
    let step = fixed(x, scale);
    let mut term = fixed(&Rational::one(), scale);
    let mut sum = fixed(&Rational::zero(), scale);
    let mut j = 0_u64;
    while j <= 2 * bound || term.high > BigInt::one() {
        if (j % 2 == 1) == sine {
            add_signed(&mut sum, term.low.clone(), term.high.clone(), j % 4 < 2);
        }
        j += 1;
        term = product(&term, &step, scale);
        term.low = term.low.div_floor(&j.into());
        term.high = ceiling(&term.high, &j.into());
    }
    // The terms from j on, of either parity, sum to at most twice the first of them.
    sum.low -= &term.high * 2;
    sum.high += &term.high * 2;
    Ok(sum.over(scale))
}

/// The index-th root of q >= 0: exact where numerator and denominator are perfect powers, else
/// from floor(floor(y)^(1/n)) = floor(y^(1/n)).
pub(super) fn root(q: &Rational, index: u32, bits: u64) -> Result<Interval, Unknown> {
    let numerator = q.numer().nth_root(index);
    let denominator = q.denom().nth_root(index);
    let candidate = Rational::new(numerator, denominator);
    if size(&candidate).saturating_mul(index.into()) <= SIZE_CAP
        && integer_power(&candidate, index) == *q
    {
        return Ok(Interval::exact(candidate));
    }
    let smallness = q.denom().bits().saturating_sub(q.numer().bits()) / u64::from(index);
    let scale = bits + smallness + 2;
    let shift = scale.saturating_mul(index.into());
    if shift > SIZE_CAP {
        return unknown("a root of too high an index");
    }
    let scaled: BigInt = q.numer() << shift;
    let floor = scaled.div_floor(q.denom()).nth_root(index);
    let next = &floor + 1;
    Ok(Interval::between(dyadic(floor, scale), dyadic(next, scale)))
}

/// The root on an interval of nonnegative numbers: it increases.
pub(super) fn root_interval(x: &Interval, index: u32, bits: u64) -> Result<Interval, Unknown> {
    let low = root(x.low(), index, bits)?;
    if x.is_exact() {
        return Ok(low);
    }
    let high = root(x.high(), index, bits)?;
    Ok(Interval::between(low.low().clone(), high.high().clone()))
}

/// n! with its size bounded first: n! <= n^n.
pub(super) fn factorial(n: &BigInt) -> Result<BigInt, Unknown> {
    match n.to_u64() {
        Some(n) if n.saturating_mul(64 - u64::from(n.leading_zeros())) <= SIZE_CAP => {
            Ok((2..=n).fold(BigInt::one(), |product, j| product * j))
        }
        _ => unknown("a factorial that is too large"),
    }
}

/// a*(a+1)*...*(a+n-1), DLMF 5.2.4, of an enclosure, with its size bounded first.
pub(super) fn pochhammer(a: &Interval, n: &BigInt, bits: u64) -> Result<Interval, Unknown> {
    let count = n.to_u64().unwrap_or(u64::MAX);
    let step_size = a.size().saturating_add(n.bits() + 1);
    if n.is_negative() || count.saturating_mul(step_size) > SIZE_CAP {
        return unknown("pochhammer of a negative or too large length");
    }
    let mut product = Interval::integer(1);
    let mut factor = a.clone();
    for _ in 0..count {
        product = product.times(&factor, bits);
        factor = factor.plus(&Interval::integer(1), bits);
    }
    Ok(product)
}

/// binomial(n, k) = (n-k+1)_k/k! for integer k; 0 for k < 0.
pub(super) fn binomial(n: &Interval, k: &BigInt, bits: u64) -> Result<Interval, Unknown> {
    if k.is_negative() {
        return Ok(Interval::integer(0));
    }
    // By symmetry the shorter product for integers 0 <= k <= n.
    let shorter = match n.as_integer() {
        Some(n) if n >= k => (n - k).min(k.clone()),
        _ => k.clone(),
    };
    let start = n
        .minus(&integer(&shorter), bits)
        .plus(&Interval::integer(1), bits);
    let product = pochhammer(&start, &shorter, bits)?;
    let divisor = integer(&factorial(&shorter)?);
    match divisor.reciprocal(bits) {
        Some(inverse) => Ok(product.times(&inverse, bits)),
        None => unknown("a factorial is never zero"),
    }
}

pub(super) fn integer(n: &BigInt) -> Interval {
    Interval::exact(Rational::from_integer(n.clone()))
}

/// Gamma at an integer or half an odd integer, DLMF 5.4.1, 5.4.6 and 5.5.1; `None` at its poles.
pub(super) fn gamma(x: &Rational, bits: u64) -> Result<Option<Interval>, Unknown> {
    if x.is_integer() {
        if !x.is_positive() {
            return Ok(None);
        }
        return Ok(Some(integer(&factorial(&(x.numer() - 1))?)));
    }
    if *x.denom() != BigInt::from(2) {
        return unknown("gamma away from integers and half integers");
    }
    let half = Rational::new(1.into(), 2.into());
    let root_of_pi = root_interval(&pi(bits + 8)?, 2, bits + 8)?;
    let steps = (x - &half).to_integer();
    let result = if steps.is_negative() {
        // Gamma(1/2) = (x)_n*Gamma(x) with n = 1/2 - x, and no factor is zero.
        let factor = pochhammer(&Interval::exact(x.clone()), &-steps, bits)?;
        factor.reciprocal(bits).map(|f| f.times(&root_of_pi, bits))
    } else {
        let factor = pochhammer(&Interval::exact(half), &steps, bits)?;
        Some(factor.times(&root_of_pi, bits))
    };
    match result {
        Some(value) => Ok(Some(value)),
        None => unknown("a half integer's product is never zero"),
    }
}

/// Euler's Beta function at integers and half integers a, b > 0, DLMF 5.12.1.
pub(super) fn beta(a: &Rational, b: &Rational, bits: u64) -> Result<Interval, Unknown> {
    if !a.is_positive() || !b.is_positive() {
        return unknown("beta of an argument that is not positive");
    }
    let parts = [gamma(a, bits)?, gamma(b, bits)?, gamma(&(a + b), bits)?];
    if let [Some(first), Some(second), Some(third)] = parts
        && let Some(inverse) = third.reciprocal(bits)
    {
        return Ok(first.times(&second, bits).times(&inverse, bits));
    }
    unknown("beta at a pole")
}

/// floor x, where the enclosure settles it.
pub(super) fn floor(x: &Interval) -> Result<Interval, Unknown> {
    let (low, high) = (x.low().floor(), x.high().floor());
    if low != high {
        return unknown("floor: the enclosure holds an integer");
    }
    Ok(Interval::exact(low))
}

/// x^y for numbers x and y; `Ok(None)` where there is proved to be no value.
pub(super) fn power(x: &Interval, y: &Interval, bits: u64) -> Result<Option<Interval>, Unknown> {
    match y.as_exact() {
        Some(exponent) if exponent.is_integer() => integer_exponent(x, exponent.numer(), bits),
        Some(exponent) => fractional_exponent(x, exponent, bits),
        None if x.sign() == Some(Ordering::Greater) => {
            let exponent = ln_interval(x, bits + 8)?.times(y, bits + 8);
            Ok(Some(exp_interval(&exponent, bits)?))
        }
        None => unknown("a power whose exponent is not exact, of a number not known positive"),
    }
}

/// x^n, with x^0 = 1 also at x = 0, and no value for negative powers of zero.
fn integer_exponent(
    x: &Interval,
    exponent: &BigInt,
    bits: u64,
) -> Result<Option<Interval>, Unknown> {
    let magnitude = match exponent.abs().to_u32() {
        Some(magnitude) if x.size().saturating_mul(magnitude.into()) <= SIZE_CAP => magnitude,
        _ => return unknown("a power that is too large"),
    };
    if !exponent.is_negative() {
        return Ok(Some(x.power(magnitude, bits)));
    }
    if x.is_zero() {
        return Ok(None);
    }
    match x.power(magnitude, bits).reciprocal(bits) {
        Some(value) => Ok(Some(value)),
        None => unknown("a negative power of what may be zero at these bits"),
    }
}

/// x^(p/q) in lowest terms with q > 1: real for x > 0, 0 at x = 0 for p > 0, else without value.
fn fractional_exponent(
    x: &Interval,
    exponent: &Rational,
    bits: u64,
) -> Result<Option<Interval>, Unknown> {
    match x.sign() {
        Some(Ordering::Less) => return Ok(None),
        Some(Ordering::Equal) if exponent.is_negative() => return Ok(None),
        None if x.low().is_negative() || exponent.is_negative() => {
            return unknown("a power of a number whose sign is not settled at these bits");
        }
        _ => {}
    }
    match exponent.denom().to_u32() {
        Some(index) if index <= 1 << 10 => {
            let base = root_interval(x, index, bits + 8)?;
            integer_exponent(&base, exponent.numer(), bits)
        }
        _ => unknown("a power with a large denominator in its exponent"),
    }
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

    /// OEIS A000796, A002162, A001113, A049469, A049470, A002193, A002161.
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
        let one = Interval::integer(1);
        check(
            &wave(&one, true, 128).unwrap(),
            "0.84147098480789650665250232163029899",
        );
        check(
            &wave(&one, false, 128).unwrap(),
            "0.54030230586813971740093660744297660",
        );
        check(
            &root(&ratio(2, 1), 2, 128).unwrap(),
            "1.41421356237309504880168872420969807",
        );
        check(
            &gamma(&ratio(1, 2), 128).unwrap().unwrap(),
            "1.77245385090551602729816748334114518",
        );
    }

    #[test]
    fn exact_values_stay_exact() {
        assert_eq!(root(&ratio(9, 4), 2, 64), Ok(Interval::exact(ratio(3, 2))));
        assert_eq!(ln(&ratio(1, 1), 64), Ok(Interval::integer(0)));
        assert_eq!(gamma(&ratio(5, 1), 64), Ok(Some(Interval::integer(24))));
        assert_eq!(gamma(&ratio(-3, 1), 64), Ok(None));
        let minus_two = Interval::integer(-2);
        assert_eq!(
            binomial(&minus_two, &3.into(), 64),
            Ok(Interval::integer(-4))
        );
        assert_eq!(
            power(&Interval::integer(0), &Interval::integer(0), 64),
            Ok(Some(Interval::integer(1)))
        );
        assert_eq!(
            power(&Interval::integer(0), &Interval::integer(-1), 64),
            Ok(None)
        );
    }

    #[test]
    fn huge_sizes_are_refused() {
        let huge = BigInt::one() << 70_u32;
        assert!(factorial(&huge).is_err());
        assert!(binomial(&integer(&huge), &(BigInt::one() << 60_u32), 64).is_err());
        assert!(power(&Interval::integer(2), &integer(&huge), 64).is_err());
        assert!(exp(&Rational::from_integer(huge), 64).is_err());
    }

    proptest! {
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
            let sum = ln(&p, 90).unwrap().plus(&ln(&q, 90).unwrap(), 90);
            prop_assert!(sum.minus(&ln(&(p * q), 90).unwrap(), 90).sign().is_none_or(|s| s.is_eq()));
        }

        #[test]
        fn exp_undoes_ln(a in 1_i64..999, b in 1_i64..999) {
            let q = ratio(a, b);
            let back = exp_interval(&ln(&q, 90).unwrap(), 90).unwrap();
            prop_assert!(*back.low() <= q && q <= *back.high());
        }

        #[test]
        fn squares_of_sine_and_cosine_sum_to_one(a in -999_i64..999, b in 20_i64..99) {
            let x = Interval::exact(ratio(a, b));
            let sum = wave(&x, true, 80).unwrap().power(2, 80)
                .plus(&wave(&x, false, 80).unwrap().power(2, 80), 80);
            prop_assert!(*sum.low() <= ratio(1, 1) && ratio(1, 1) <= *sum.high());
        }
    }
}
