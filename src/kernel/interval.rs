//! Enclosures of real numbers between two rationals, and values with infinities.
//!
//! `Interval::exact(q)` stands for the number q itself: operations on exact numbers are exact. All
//! other results are rounded outward to about `bits` significant bits: every real result of an
//! operation on real members lies in the resulting interval (the fundamental theorem of interval
//! arithmetic; Moore, Kearfott & Cloud, *Introduction to Interval Analysis*, theorem 5.1).

use super::{Unknown, unknown};
use crate::formula::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;

/// The value of a formula. A finite value is exact where `low == high`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// Proved to have no value.
    Undefined,
    PlusInfinity,
    MinusInfinity,
    /// The value lies between the two, ends included.
    Finite {
        low: Rational,
        high: Rational,
    },
}

/// A real number known to lie between `low` and `high`, with `low <= high`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Interval {
    low: Rational,
    high: Rational,
}

impl Interval {
    pub fn exact(number: Rational) -> Interval {
        Interval {
            low: number.clone(),
            high: number,
        }
    }

    pub fn integer(number: i64) -> Interval {
        Interval::exact(Rational::from_integer(number.into()))
    }

    /// The interval from one number to another, in whichever order they come.
    pub fn between(a: Rational, b: Rational) -> Interval {
        if a <= b {
            Interval { low: a, high: b }
        } else {
            Interval { low: b, high: a }
        }
    }

    pub fn low(&self) -> &Rational {
        &self.low
    }

    pub fn high(&self) -> &Rational {
        &self.high
    }

    pub fn is_exact(&self) -> bool {
        self.low == self.high
    }

    pub fn as_exact(&self) -> Option<&Rational> {
        self.is_exact().then_some(&self.low)
    }

    /// The exact integer that this is, if it is one.
    pub fn as_integer(&self) -> Option<&BigInt> {
        let number = self.as_exact()?;
        number.is_integer().then_some(number.numer())
    }

    pub fn is_zero(&self) -> bool {
        self.low.is_zero() && self.high.is_zero()
    }

    /// The sign, or `None` where the enclosure does not settle it.
    pub fn sign(&self) -> Option<Ordering> {
        if self.low.is_positive() {
            Some(Ordering::Greater)
        } else if self.high.is_negative() {
            Some(Ordering::Less)
        } else if self.is_zero() {
            Some(Ordering::Equal)
        } else {
            None
        }
    }

    /// How the two numbers compare, or `None`. `Equal` only for exact numbers.
    pub fn compare(&self, other: &Interval) -> Option<Ordering> {
        if self.high < other.low {
            Some(Ordering::Less)
        } else if self.low > other.high {
            Some(Ordering::Greater)
        } else if self.is_exact() && self == other {
            Some(Ordering::Equal)
        } else {
            None
        }
    }

    /// The ends rounded outward to `bits` significant bits; an exact number stays as it is.
    pub fn rounded(self, bits: u64) -> Interval {
        if self.is_exact() {
            return self;
        }
        Interval {
            low: floor_to_bits(&self.low, bits),
            high: -floor_to_bits(&-self.high, bits),
        }
    }

    pub fn negated(&self) -> Interval {
        Interval {
            low: -&self.high,
            high: -&self.low,
        }
    }

    pub fn plus(&self, other: &Interval, bits: u64) -> Interval {
        if self.is_exact() && other.is_exact() {
            return Interval::exact(&self.low + &other.low);
        }
        Interval {
            low: &self.low + &other.low,
            high: &self.high + &other.high,
        }
        .rounded(bits)
    }

    pub fn minus(&self, other: &Interval, bits: u64) -> Interval {
        self.plus(&other.negated(), bits)
    }

    /// The product; extremes of a bilinear map on a box lie at its corners. An exact zero factor
    /// gives an exact zero.
    pub fn times(&self, other: &Interval, bits: u64) -> Interval {
        if self.is_exact() && other.is_exact() {
            return Interval::exact(&self.low * &other.low);
        }
        let corners = [
            &self.low * &other.low,
            &self.low * &other.high,
            &self.high * &other.low,
            &self.high * &other.high,
        ];
        hull_of(corners).rounded(bits)
    }

    /// 1/x, or `None` where zero is not excluded. Decreasing on either side of zero.
    pub fn reciprocal(&self, bits: u64) -> Option<Interval> {
        match self.sign() {
            Some(Ordering::Greater | Ordering::Less) => Some(
                Interval {
                    low: self.high.recip(),
                    high: self.low.recip(),
                }
                .rounded(bits),
            ),
            _ => None,
        }
    }

    /// x^n; monotone for x >= 0 and for odd n, and even powers are powers of |x|.
    pub fn power(&self, exponent: u32, bits: u64) -> Interval {
        if self.is_exact() {
            return Interval::exact(integer_power(&self.low, exponent));
        }
        let base = if exponent.is_multiple_of(2) {
            self.absolute()
        } else {
            self.clone()
        };
        if base.sign().is_none() && base.low.is_negative() {
            // An odd power of an interval around zero: it increases.
            let low = integer_power(&base.low, exponent);
            let high = integer_power(&base.high, exponent);
            return Interval { low, high }.rounded(bits);
        }
        let mut result = Interval::integer(1);
        let (mut square, mut left) = (base.clone(), exponent);
        while left > 0 {
            if left % 2 == 1 {
                result = result.times(&square, bits);
            }
            square = square.times(&square, bits);
            left /= 2;
        }
        result
    }

    /// An enclosure of limited size, also of an exact number.
    pub fn widened(&self, bits: u64) -> Interval {
        Interval {
            low: floor_to_bits(&self.low, bits),
            high: -floor_to_bits(&-&self.high, bits),
        }
    }

    pub fn absolute(&self) -> Interval {
        match self.sign() {
            Some(Ordering::Less) => self.negated(),
            Some(_) => self.clone(),
            None => Interval {
                low: Rational::zero(),
                high: self.high.clone().max(-&self.low),
            },
        }
    }

    pub fn minimum(&self, other: &Interval) -> Interval {
        Interval {
            low: self.low.clone().min(other.low.clone()),
            high: self.high.clone().min(other.high.clone()),
        }
    }

    pub fn maximum(&self, other: &Interval) -> Interval {
        self.negated().minimum(&other.negated()).negated()
    }

    /// The size in bits of the larger end: numerator and denominator together.
    pub fn size(&self) -> u64 {
        size(&self.low).max(size(&self.high))
    }
}

fn hull_of(corners: [Rational; 4]) -> Interval {
    let low = corners.iter().min().cloned();
    let high = corners.into_iter().max();
    match (low, high) {
        (Some(low), Some(high)) => Interval { low, high },
        _ => Interval::integer(0),
    }
}

/// Numerator and denominator, in bits.
pub(super) fn size(number: &Rational) -> u64 {
    number.numer().bits() + number.denom().bits()
}

/// Exact; the caller has estimated the size.
pub(super) fn integer_power(base: &Rational, exponent: u32) -> Rational {
    // Powers of coprime numbers are coprime, so that no gcd is needed.
    Rational::new_raw(base.numer().pow(exponent), base.denom().pow(exponent))
}

/// The largest multiple of 2^(e-bits) not above the number, where 2^e is about its size.
fn floor_to_bits(number: &Rational, bits: u64) -> Rational {
    let magnitude = number.numer().bits() as i64 - number.denom().bits() as i64;
    let shift = bits as i64 - magnitude;
    if shift >= 0 {
        let scaled: BigInt = number.numer() << shift as u64;
        dyadic(scaled.div_floor(number.denom()), shift as u64)
    } else {
        let unit: BigInt = number.denom() << shift.unsigned_abs();
        Rational::from_integer(number.numer().div_floor(&unit) << shift.unsigned_abs())
    }
}

/// n / 2^scale
pub(super) fn dyadic(number: BigInt, scale: u64) -> Rational {
    Rational::new(number, BigInt::one() << scale)
}

impl From<Interval> for Value {
    fn from(interval: Interval) -> Value {
        Value::Finite {
            low: interval.low,
            high: interval.high,
        }
    }
}

impl Value {
    pub(super) fn exact(number: i64) -> Value {
        Interval::integer(number).into()
    }

    /// The enclosure of a finite value.
    pub(super) fn finite(&self) -> Option<Interval> {
        match self {
            Value::Finite { low, high } => Some(Interval {
                low: low.clone(),
                high: high.clone(),
            }),
            _ => None,
        }
    }

    /// The sign of a value that is there, infinities included.
    pub(super) fn sign(&self) -> Option<Ordering> {
        match self {
            Value::Undefined => None,
            Value::PlusInfinity => Some(Ordering::Greater),
            Value::MinusInfinity => Some(Ordering::Less),
            Value::Finite { .. } => self.finite().and_then(|interval| interval.sign()),
        }
    }

    pub(super) fn negated(&self) -> Value {
        match self {
            Value::Undefined => Value::Undefined,
            Value::PlusInfinity => Value::MinusInfinity,
            Value::MinusInfinity => Value::PlusInfinity,
            Value::Finite { low, high } => Value::Finite {
                low: -high,
                high: -low,
            },
        }
    }

    /// The sum; `inf - inf` has no value.
    pub(super) fn plus(&self, other: &Value, bits: u64) -> Value {
        match (self.finite(), other.finite()) {
            (Some(a), Some(b)) => a.plus(&b, bits).into(),
            _ if *self == Value::Undefined || *other == Value::Undefined => Value::Undefined,
            (Some(_), None) => other.clone(),
            (None, Some(_)) => self.clone(),
            _ if self == other => self.clone(),
            _ => Value::Undefined,
        }
    }

    /// The product; `0*inf` has no value.
    ///
    /// # Errors
    /// An infinity times a number whose sign is not settled.
    pub(super) fn times(&self, other: &Value, bits: u64) -> Result<Value, Unknown> {
        if *self == Value::Undefined || *other == Value::Undefined {
            return Ok(Value::Undefined);
        }
        if let (Some(a), Some(b)) = (self.finite(), other.finite()) {
            return Ok(a.times(&b, bits).into());
        }
        match (self.sign(), other.sign()) {
            (Some(Ordering::Equal), _) | (_, Some(Ordering::Equal)) => Ok(Value::Undefined),
            (Some(a), Some(b)) if a == b => Ok(Value::PlusInfinity),
            (Some(_), Some(_)) => Ok(Value::MinusInfinity),
            _ => unknown("an infinity times a number whose sign is not settled at these bits"),
        }
    }

    /// The quotient; there is none by an exact zero or by an infinity.
    ///
    /// # Errors
    /// A divisor that zero is not excluded from.
    pub(super) fn over(&self, other: &Value, bits: u64) -> Result<Value, Unknown> {
        let Some(divisor) = other.finite() else {
            return Ok(Value::Undefined);
        };
        if *self == Value::Undefined || divisor.is_zero() {
            return Ok(Value::Undefined);
        }
        match divisor.reciprocal(bits) {
            Some(inverse) => self.times(&inverse.into(), bits),
            None => unknown("a divisor that may be zero at these bits"),
        }
    }

    /// How two values compare; `None` where it is not settled or one of them is not there.
    pub(super) fn compare(&self, other: &Value) -> Option<Ordering> {
        let rank = |value: &Value| match value {
            Value::MinusInfinity => Some(-1),
            Value::Finite { .. } => Some(0),
            Value::PlusInfinity => Some(1),
            Value::Undefined => None,
        };
        match (self.finite(), other.finite()) {
            (Some(a), Some(b)) => a.compare(&b),
            _ => Some(rank(self)?.cmp(&rank(other)?)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(a.into(), b.into())
    }

    /// An interval and a member of it.
    fn member() -> impl Strategy<Value = (Interval, Rational)> {
        (-50_i64..50, 1_i64..20, 0_i64..20, 0_i64..=7).prop_map(|(a, b, width, place)| {
            let low = ratio(a, b);
            let width = ratio(width, 7);
            let inside = &low + &width * ratio(place, 7);
            (Interval::between(low.clone(), low + width), inside)
        })
    }

    fn holds(interval: &Interval, number: &Rational) -> bool {
        interval.low() <= number && number <= interval.high()
    }

    proptest! {
        #[test]
        fn members_stay_members((a, x) in member(), (b, y) in member(), n in 0_u32..6, bits in 8_u64..64) {
            prop_assert!(holds(&a.plus(&b, bits), &(&x + &y)));
            prop_assert!(holds(&a.minus(&b, bits), &(&x - &y)));
            prop_assert!(holds(&a.times(&b, bits), &(&x * &y)));
            prop_assert!(holds(&a.power(n, bits), &integer_power(&x, n)));
            prop_assert!(holds(&a.absolute(), &x.abs()));
            prop_assert!(holds(&a.minimum(&b), &x.clone().min(y.clone())));
            prop_assert!(holds(&a.maximum(&b), &x.clone().max(y.clone())));
            if let Some(inverse) = a.reciprocal(bits) {
                prop_assert!(holds(&inverse, &x.recip()));
            }
        }

        #[test]
        fn rounding_is_outward((a, x) in member(), bits in 1_u64..40, shift in 0_u32..80) {
            let scale = Rational::from_integer(BigInt::from(2).pow(shift));
            let wide = Interval::between(a.low() * &scale, a.high() * &scale);
            prop_assert!(holds(&wide.rounded(bits), &(x * scale)));
        }
    }

    #[test]
    fn infinities_follow_the_rules() {
        let (zero, two) = (Value::exact(0), Value::exact(2));
        let infinity = Value::PlusInfinity;
        assert_eq!(infinity.plus(&two, 64), infinity);
        assert_eq!(infinity.plus(&infinity.negated(), 64), Value::Undefined);
        assert_eq!(infinity.times(&zero, 64), Ok(Value::Undefined));
        assert_eq!(infinity.times(&two.negated(), 64), Ok(Value::MinusInfinity));
        assert_eq!(two.over(&infinity, 64), Ok(Value::Undefined));
        assert_eq!(two.over(&zero, 64), Ok(Value::Undefined));
        let around = Value::from(Interval::between(ratio(-1, 9), ratio(1, 9)));
        assert!(two.over(&around, 64).is_err());
    }
}
