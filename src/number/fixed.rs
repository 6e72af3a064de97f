//! Fixed-point numbers in [0, 1) on 64-bit words, without allocation.
//!
//! A slice `x` of N words, least first, stands for the number `sum of x[i] 2^(64(i-N))`; its unit in
//! the last place, the *ulp*, is `2^(-64N)`. The words `x[i..]` are the same number cut off below, in
//! larger ulps: a computation that needs fewer digits works on a part of its slice.
//!
//! Every operation here is exact modulo one floor, and says so: [`mul_word`], [`add`] and [`sub`] are
//! exact (what leaves the range is returned), [`div_word`] is the exact quotient rounded down to an
//! ulp, with its remainder, and [`mul`] the exact product rounded down. So who uses them counts errors in
//! ulps, and [`enclose`] turns a number and its count into an interval.

use super::Interval;
use super::interval::clamp_precision;
use rug::float::Round;
use rug::integer::Order;
use rug::{Float, Integer};

/// The two words of a product, least first.
const fn split(wide: u128) -> (u64, u64) {
    (wide as u64, (wide >> 64) as u64)
}

const fn join(low: u64, high: u64) -> u128 {
    (high as u128) << 64 | low as u128
}

/// A word to divide by, with its reciprocal.
///
/// Möller and Granlund, *Improved division by invariant integers*, IEEE Trans. Comput. 60 (2011),
/// 165-175: for B = 2^64 and B/2 <= d < B let v = floor((B^2-1)/d) - B. Their algorithm 4 gives
/// the quotient and remainder of `u1 B + u0` by d, u1 < d, from two products (their theorem 3). A
/// smaller divisor is shifted until its first bit is set, and the dividend with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divisor {
    shift: u32,
    shifted: u64,
    reciprocal: u64,
}

impl Divisor {
    /// `None` for 0.
    #[inline]
    pub fn new(divisor: u64) -> Option<Divisor> {
        if divisor == 0 {
            return None;
        }
        let shift = divisor.leading_zeros();
        let shifted = divisor << shift;
        // (B^2-1)/d - B = ((B-1-d) B + B-1)/d, a quotient of one word.
        let reciprocal = (join(u64::MAX, !shifted) / u128::from(shifted)) as u64;
        Some(Divisor {
            shift,
            shifted,
            reciprocal,
        })
    }

    /// The divisor itself.
    pub fn value(&self) -> u64 {
        self.shifted >> self.shift
    }

    /// Quotient and remainder of `high B + low` by the shifted divisor, `high` less than it.
    #[inline]
    fn step(&self, low: u64, high: u64) -> (u64, u64) {
        let product = u128::from(self.reciprocal) * u128::from(high);
        let (q0, q1) = split(product.wrapping_add(join(low, high)));
        let quotient = q1.wrapping_add(1);
        let remainder = low.wrapping_sub(quotient.wrapping_mul(self.shifted));
        // Both corrections of the paper; the second is rare.
        let (quotient, remainder) = if remainder > q0 {
            (
                quotient.wrapping_sub(1),
                remainder.wrapping_add(self.shifted),
            )
        } else {
            (quotient, remainder)
        };
        if remainder >= self.shifted {
            (quotient.wrapping_add(1), remainder - self.shifted)
        } else {
            (quotient, remainder)
        }
    }
}

/// The upper part of `high B + low` shifted left by less than 64 bits.
#[inline]
fn shifted_in(high: u64, low: u64, shift: u32) -> u64 {
    split(join(low, high) << shift).1
}

/// `x := fraction of x*factor`; the integer part is returned. Exact.
#[inline]
pub fn mul_word(x: &mut [u64], factor: u64) -> u64 {
    let mut carry = 0;
    for word in x {
        // (B-1)^2 + (B-1) < B^2
        (*word, carry) = split(u128::from(*word) * u128::from(factor) + u128::from(carry));
    }
    carry
}

/// `x := (integer + x)/divisor` rounded down to an ulp, for `integer < divisor`; the remainder is
/// returned: `divisor*x_new + remainder ulp = integer + x_old`.
#[inline]
pub fn div_word(x: &mut [u64], integer: u64, divisor: &Divisor) -> u64 {
    debug_assert!(integer < divisor.value());
    let shift = divisor.shift;
    let Some((first, _)) = x.split_last() else {
        return integer;
    };
    let mut remainder = shifted_in(integer, *first, shift);
    for i in (1..x.len()).rev() {
        let low = shifted_in(x[i], x[i - 1], shift);
        (x[i], remainder) = divisor.step(low, remainder);
    }
    (x[0], remainder) = divisor.step(x[0] << shift, remainder);
    remainder >> shift
}

/// `x := (integer + x)/divisor` as [`div_word`] does, by the processor's own division: without a
/// reciprocal, so faster for one or two words.
#[inline]
pub fn div_once(x: &mut [u64], integer: u64, divisor: u64) -> u64 {
    debug_assert!(integer < divisor);
    let mut remainder = integer;
    for word in x.iter_mut().rev() {
        let dividend = join(*word, remainder);
        let wide = u128::from(divisor);
        *word = (dividend / wide) as u64;
        remainder = (dividend % wide) as u64;
    }
    remainder
}

/// `x := x + y`, y of the same length; the carry out of the first word is returned. Exact.
#[inline]
pub fn add(x: &mut [u64], y: &[u64]) -> bool {
    let mut carry = false;
    for (a, &b) in x.iter_mut().zip(y) {
        (*a, carry) = a.carrying(b, carry);
    }
    carry
}

/// `x := x - y`, y of the same length; the borrow is returned: where it is set, x holds 1 + x - y.
#[inline]
pub fn sub(x: &mut [u64], y: &[u64]) -> bool {
    let mut borrow = false;
    for (a, &b) in x.iter_mut().zip(y) {
        (*a, borrow) = a.borrowing(b, borrow);
    }
    borrow
}

/// `x := x + ulps`; the carry out of the first word is returned. Exact.
#[inline]
pub fn add_ulps(x: &mut [u64], ulps: u64) -> bool {
    let mut carry = ulps;
    for word in x {
        let (sum, overflow) = word.overflowing_add(carry);
        *word = sum;
        if !overflow {
            return false;
        }
        carry = 1;
    }
    carry != 0
}

/// `x := x - ulps`; the borrow is returned. Exact.
#[inline]
pub fn sub_ulps(x: &mut [u64], ulps: u64) -> bool {
    let mut borrow = ulps;
    for word in x {
        let (difference, overflow) = word.overflowing_sub(borrow);
        *word = difference;
        if !overflow {
            return false;
        }
        borrow = 1;
    }
    borrow != 0
}

/// `x := (1 - x) - ulp`: all words inverted. Exact.
#[inline]
pub fn complement(x: &mut [u64]) {
    for word in x {
        *word = !*word;
    }
}

/// `out := x*y` rounded down to an ulp; all three of one length. `work` holds twice as many words.
#[inline]
pub fn mul(out: &mut [u64], x: &[u64], y: &[u64], work: &mut [u64]) {
    work.fill(0);
    for (i, &a) in x.iter().enumerate() {
        let mut carry = 0;
        for (&b, word) in y.iter().zip(&mut work[i..]) {
            // (B-1)^2 + 2(B-1) = B^2 - 1
            let sum = u128::from(a) * u128::from(b) + u128::from(*word) + u128::from(carry);
            (*word, carry) = split(sum);
        }
        work[i + y.len()] = carry;
    }
    out.copy_from_slice(&work[x.len()..2 * x.len()]);
}

/// How many bits are 0 before the first that is 1.
#[inline]
pub fn leading_zeros(x: &[u64]) -> u32 {
    let words = x.iter().rev().take_while(|&&word| word == 0).count();
    let rest = x[..x.len() - words].last();
    words as u32 * 64 + rest.map_or(0, |word| word.leading_zeros())
}

/// The interval from `(integer + x) 2^exponent` to `(integer + x + ulps) 2^exponent`, ends rounded outwards to
/// `precision` bits.
pub fn enclose(integer: u64, x: &[u64], ulps: u64, exponent: i32, precision: u32) -> Interval {
    let precision = clamp_precision(precision);
    let scale = exponent - 64 * x.len() as i32;
    let (low, high) = match *x {
        [word] if integer < u64::MAX => {
            let low = join(word, integer);
            let high = low + u128::from(ulps);
            (
                Float::with_val_round(precision, low, Round::Down).0,
                Float::with_val_round(precision, high, Round::Up).0,
            )
        }
        _ => {
            let mut whole = whole(integer, x);
            let low = Float::with_val_round(precision, &whole, Round::Down).0;
            whole += ulps;
            (low, Float::with_val_round(precision, &whole, Round::Up).0)
        }
    };
    // A power of two changes no digit.
    Interval::new(low << scale, high << scale)
}

/// All words as one integer.
fn whole(integer: u64, x: &[u64]) -> Integer {
    const FEW: usize = 16;
    let n = x.len();
    if n < FEW {
        let mut words = [integer; FEW];
        words[..n].copy_from_slice(x);
        return Integer::from_digits(&words[..=n], Order::Lsf);
    }
    let mut value = Integer::from_digits(x, Order::Lsf);
    if integer != 0 {
        value += Integer::from(integer) << (64 * n as u32);
    }
    value
}

/// Addition and subtraction of words with carry.
trait Carry: Sized {
    fn carrying(self, other: Self, carry: bool) -> (Self, bool);
    fn borrowing(self, other: Self, borrow: bool) -> (Self, bool);
}

impl Carry for u64 {
    #[inline]
    fn carrying(self, other: u64, carry: bool) -> (u64, bool) {
        let (sum, first) = self.overflowing_add(other);
        let (sum, second) = sum.overflowing_add(u64::from(carry));
        (sum, first | second)
    }

    #[inline]
    fn borrowing(self, other: u64, borrow: bool) -> (u64, bool) {
        let (difference, first) = self.overflowing_sub(other);
        let (difference, second) = difference.overflowing_sub(u64::from(borrow));
        (difference, first | second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn integer(x: &[u64]) -> Integer {
        Integer::from_digits(x, Order::Lsf)
    }

    fn one(length: usize) -> Integer {
        Integer::from(1) << (64 * length as u32)
    }

    /// Words with many bits all 0 or all 1, where carries run far.
    fn word() -> impl Strategy<Value = u64> {
        prop_oneof![
            any::<u64>(),
            Just(0),
            Just(1),
            Just(u64::MAX),
            Just(u64::MAX - 1),
            Just(1 << 63),
            Just((1 << 63) - 1),
            any::<u32>().prop_map(u64::from),
            (0u32..64).prop_map(|n| 1 << n),
            (0u32..64).prop_map(|n| u64::MAX << n),
        ]
    }

    fn number() -> impl Strategy<Value = Vec<u64>> {
        prop::collection::vec(word(), 1..9)
    }

    fn two_numbers() -> impl Strategy<Value = (Vec<u64>, Vec<u64>)> {
        (1usize..9).prop_flat_map(|n| {
            let x = prop::collection::vec(word(), n);
            (x, prop::collection::vec(word(), n))
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn products_by_a_word_are_exact(x in number(), factor in word()) {
            let mut product = x.clone();
            let carry = mul_word(&mut product, factor);
            let found = integer(&product) + Integer::from(carry) * one(x.len());
            prop_assert_eq!(found, integer(&x) * factor);
        }

        #[test]
        fn quotients_by_a_word_round_down(x in number(), divisor in word(), high in word()) {
            let divisor = divisor.max(1);
            let high = high % divisor;
            let prepared = Divisor::new(divisor).expect("not 0");
            prop_assert_eq!(prepared.value(), divisor);
            let mut quotient = x.clone();
            let rest = div_word(&mut quotient, high, &prepared);
            let dividend = integer(&x) + Integer::from(high) * one(x.len());
            prop_assert!(rest < divisor);
            prop_assert_eq!(integer(&quotient) * divisor + rest, dividend);
            let mut again = x.clone();
            prop_assert_eq!(div_once(&mut again, high, divisor), rest);
            prop_assert_eq!(again, quotient);
        }

        #[test]
        fn sums_and_differences((x, y) in two_numbers(), ulps in word()) {
            let mut sum = x.clone();
            let carry = Integer::from(add(&mut sum, &y)) * one(x.len());
            prop_assert_eq!(integer(&sum) + carry, integer(&x) + integer(&y));
            let mut difference = x.clone();
            let borrow = Integer::from(sub(&mut difference, &y)) * one(x.len());
            prop_assert_eq!(integer(&difference) - borrow, integer(&x) - integer(&y));
            let mut sum = x.clone();
            let carry = Integer::from(add_ulps(&mut sum, ulps)) * one(x.len());
            prop_assert_eq!(integer(&sum) + carry, integer(&x) + ulps);
            let mut difference = x.clone();
            let borrow = Integer::from(sub_ulps(&mut difference, ulps)) * one(x.len());
            prop_assert_eq!(integer(&difference) - borrow, integer(&x) - ulps);
            let mut opposite = x.clone();
            complement(&mut opposite);
            prop_assert_eq!(integer(&opposite) + integer(&x) + 1u32, one(x.len()));
        }

        #[test]
        fn products_round_down((x, y) in two_numbers()) {
            let mut out = vec![0; x.len()];
            mul(&mut out, &x, &y, &mut vec![7; 2 * x.len()]);
            let exact = integer(&x) * integer(&y);
            prop_assert_eq!(integer(&out), exact >> (64 * x.len() as u32));
        }

        #[test]
        fn intervals_hold_both_ends(
            x in number(), high in word(), ulps in word(), exponent in -99i32..99, precision in 2u32..200,
        ) {
            let found = enclose(high, &x, ulps, exponent, precision);
            let low = integer(&x) + Integer::from(high) * one(x.len());
            let top = Integer::from(&low + ulps);
            let exact = |n: &Integer| {
                let n = Interval::from_integer(n, 1000);
                let scale = Interval::from_i64(2, 1000).powi((exponent - 64 * x.len() as i32).into());
                n.mul(&scale.expect("2 is not 0"))
            };
            let hull = exact(&low).hull(&exact(&top));
            prop_assert_eq!(hull.with_precision(precision), found);
        }

        #[test]
        fn leading_zeros_are_the_integers(x in number()) {
            let bits = integer(&x).significant_bits();
            prop_assert_eq!(leading_zeros(&x), 64 * x.len() as u32 - bits);
        }
    }

    #[test]
    fn there_is_no_division_by_zero() {
        assert_eq!(Divisor::new(0), None);
    }
}
