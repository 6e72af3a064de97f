//! Enclosures of real numbers between two rationals.
//!
//! `Interval::exact(q)` stands for the number q itself: operations on exact numbers are exact. Every
//! real result of an operation on real members lies in the resulting interval (the fundamental
//! theorem of interval arithmetic; Moore, Kearfott & Cloud, *Introduction to Interval Analysis*,
//! theorem 5.1). Operations do not round; whoever repeats them rounds outward.

use super::{Unknown, unknown};
use crate::formula::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

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

    pub fn integer(number: impl Into<BigInt>) -> Interval {
        Interval::exact(Rational::from_integer(number.into()))
    }

    /// The interval from one number to another, in whichever order they come.
    pub fn between(a: Rational, b: Rational) -> Interval {
        let (low, high) = if a <= b { (a, b) } else { (b, a) };
        Interval { low, high }
    }

    pub fn low(&self) -> &Rational {
        &self.low
    }

    pub fn high(&self) -> &Rational {
        &self.high
    }

    pub fn as_exact(&self) -> Option<&Rational> {
        (self.low == self.high).then_some(&self.low)
    }

    /// The exact integer that this is, if it is one.
    pub fn as_integer(&self) -> Option<&BigInt> {
        let number = self.as_exact()?;
        number.is_integer().then_some(number.numer())
    }

    pub fn is_zero(&self) -> bool {
        self.low.is_zero() && self.high.is_zero()
    }

    /// # Errors
    /// An enclosure that does not settle the sign.
    pub fn sign(&self) -> Result<Ordering, Unknown> {
        let zero = Rational::zero();
        match (self.low.cmp(&zero), self.high.cmp(&zero)) {
            (a, b) if a == b => Ok(a),
            _ => unknown("a sign or an order is not settled at these bits"),
        }
    }

    pub fn is_positive(&self) -> bool {
        self.low.is_positive()
    }

    /// How the two numbers compare; `Equal` for exact numbers only.
    ///
    /// # Errors
    /// Enclosures that meet.
    pub fn compare(&self, other: &Interval) -> Result<Ordering, Unknown> {
        (self - other).sign()
    }

    /// The ends rounded outward to `bits` significant bits.
    pub fn rounded(&self, bits: u64) -> Interval {
        Interval {
            low: floor_to_bits(&self.low, bits),
            high: -floor_to_bits(&-&self.high, bits),
        }
    }

    /// All numbers at most 2^-bits away.
    pub fn around(&self, bits: u64) -> Interval {
        let near = Rational::new(1.into(), BigInt::one() << bits);
        Interval {
            low: &self.low - &near,
            high: &self.high + near,
        }
    }

    /// 1/x, which decreases on either side of zero.
    ///
    /// # Errors
    /// Zero is not excluded.
    pub fn reciprocal(&self) -> Result<Interval, Unknown> {
        match self.sign()? {
            Ordering::Equal => unknown("a divisor that is zero"),
            _ => Ok(Interval {
                low: self.high.recip(),
                high: self.low.recip(),
            }),
        }
    }

    /// x^n; it increases for x >= 0 and for odd n, and even powers are powers of |x|. The caller
    /// has estimated the size.
    pub fn power(&self, exponent: u32) -> Interval {
        let even = exponent.is_multiple_of(2);
        let base = if even { self.absolute() } else { self.clone() };
        Interval {
            low: integer_power(&base.low, exponent),
            high: integer_power(&base.high, exponent),
        }
    }

    pub fn absolute(&self) -> Interval {
        let larger = self.maximum(&-self);
        Interval {
            low: larger.low.max(Rational::zero()),
            high: larger.high,
        }
    }

    pub fn minimum(&self, other: &Interval) -> Interval {
        Interval {
            low: self.low.clone().min(other.low.clone()),
            high: self.high.clone().min(other.high.clone()),
        }
    }

    pub fn maximum(&self, other: &Interval) -> Interval {
        -&(-self).minimum(&-other)
    }

    /// The enclosure of an increasing function from those at the ends.
    pub fn increasing(
        &self,
        function: impl Fn(&Rational) -> Result<Interval, Unknown>,
    ) -> Result<Interval, Unknown> {
        let low = function(&self.low)?;
        if self.low == self.high {
            return Ok(low);
        }
        let high = function(&self.high)?.high;
        Ok(Interval { low: low.low, high })
    }

    /// The size in bits of the larger end: numerator and denominator together.
    pub fn size(&self) -> u64 {
        size(&self.low).max(size(&self.high))
    }
}

impl Neg for &Interval {
    type Output = Interval;

    fn neg(self) -> Interval {
        Interval {
            low: -&self.high,
            high: -&self.low,
        }
    }
}

impl Add for &Interval {
    type Output = Interval;

    fn add(self, other: &Interval) -> Interval {
        Interval {
            low: &self.low + &other.low,
            high: &self.high + &other.high,
        }
    }
}

impl Sub for &Interval {
    type Output = Interval;

    fn sub(self, other: &Interval) -> Interval {
        self + &-other
    }
}

impl Mul for &Interval {
    type Output = Interval;

    /// The extremes of a bilinear map on a box lie at its corners.
    fn mul(self, other: &Interval) -> Interval {
        if let (Some(a), Some(b)) = (self.as_exact(), other.as_exact()) {
            return Interval::exact(a * b);
        }
        let row = |a: &Rational| Interval::between(a * &other.low, a * &other.high);
        let (first, second) = (row(&self.low), row(&self.high));
        Interval {
            low: first.low.min(second.low),
            high: first.high.max(second.high),
        }
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
    let (above, below) = (number.numer(), number.denom());
    let shift = bits as i64 + below.bits() as i64 - above.bits() as i64;
    let unit = BigInt::one() << shift.unsigned_abs();
    if shift >= 0 {
        let floor = (above * &unit).div_floor(below);
        debug_assert!(floor.bits() <= bits + 2, "more than is kept");
        Rational::new(floor, unit)
    } else {
        Rational::from_integer(above.div_floor(&(below * &unit)) * unit)
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
        fn members_stay_members((a, x) in member(), (b, y) in member(), n in 0_u32..6) {
            prop_assert!(holds(&(&a + &b), &(&x + &y)));
            prop_assert!(holds(&(&a - &b), &(&x - &y)));
            prop_assert!(holds(&(&a * &b), &(&x * &y)));
            prop_assert!(holds(&a.power(n), &integer_power(&x, n)));
            prop_assert!(holds(&a.absolute(), &x.abs()));
            prop_assert!(holds(&a.minimum(&b), &x.clone().min(y.clone())));
            prop_assert!(holds(&a.maximum(&b), &x.clone().max(y.clone())));
            if let Ok(inverse) = a.reciprocal() {
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

    fn interval(low: i64, high: i64) -> Interval {
        Interval::between(ratio(low, 1), ratio(high, 1))
    }

    #[test]
    fn signs_and_orders_need_a_gap() {
        for (low, high, sign) in [
            (1, 3, Some(Ordering::Greater)),
            (-3, -1, Some(Ordering::Less)),
            (0, 0, Some(Ordering::Equal)),
            (0, 1, None),
            (-1, 0, None),
            (-1, 1, None),
        ] {
            let moved = interval(low + 7, high + 7);
            assert_eq!(interval(low, high).sign().ok(), sign);
            assert_eq!(moved.compare(&interval(7, 7)).ok(), sign);
            assert_eq!(interval(low, high).is_positive(), low > 0);
            assert_eq!(interval(low, high).is_zero(), low == 0 && high == 0);
            let inverse = interval(low, high).reciprocal();
            assert_eq!(inverse.is_ok(), sign.is_some_and(Ordering::is_ne));
        }
        assert!(interval(1, 2).compare(&interval(1, 2)).is_err());
    }

    /// The smallest intervals that hold all results, from schoolbook examples.
    #[test]
    fn results_are_as_narrow_as_can_be() {
        let (a, b) = (interval(-2, 3), interval(4, 5));
        for (found, low, high) in [
            (&a + &b, 2, 8),
            (&a - &b, -7, -1),
            (&a * &b, -10, 15),
            (&a * &interval(-5, -4), -15, 10),
            (-&a, -3, 2),
            (a.power(2), 0, 9),
            (a.power(3), -8, 27),
            (a.power(0), 1, 1),
            (interval(-3, -2).power(2), 4, 9),
            (a.absolute(), 0, 3),
            (interval(-3, -2).absolute(), 2, 3),
            (b.absolute(), 4, 5),
            (a.minimum(&interval(0, 1)), -2, 1),
            (a.maximum(&interval(0, 1)), 0, 3),
            (interval(3, -2), -2, 3),
        ] {
            assert_eq!(found, interval(low, high));
        }
        let halves = Interval::between(ratio(1, 5), ratio(1, 4));
        assert_eq!(b.reciprocal(), Ok(halves));
        assert_eq!(a.around(1), Interval::between(ratio(-5, 2), ratio(7, 2)));
        assert_eq!(
            (b.as_exact(), interval(4, 4).as_integer()),
            (None, Some(&4.into()))
        );
        assert_eq!(Interval::exact(ratio(1, 2)).as_integer(), None);
        let doubled = |x: &Rational| Ok(Interval::between(x + x, x + x + ratio(1, 1)));
        assert_eq!(b.increasing(doubled), Ok(interval(8, 11)));
        assert_eq!(interval(4, 4).increasing(doubled), Ok(interval(8, 9)));
        assert_eq!(Interval::between(ratio(1, 4), ratio(3, 1)).size(), 4);
    }

    #[test]
    fn rounding_keeps_the_bits_asked_for() {
        for (n, scale) in [(1, 0_u32), (-1, 0), (355, 0), (1, 200), (-1, 200)] {
            for number in [ratio(n, 3), ratio(3, n)] {
                let number = number * Rational::from_integer(BigInt::from(2).pow(scale));
                let found = Interval::exact(number.clone()).rounded(20);
                let width = (found.high() - found.low()) / number.abs();
                assert!(holds(&found, &number));
                assert!(width < ratio(1, 1 << 17) && found.size() < 500);
                let found = Interval::exact(number.recip()).rounded(20);
                assert!(holds(&found, &number.recip()) && found.size() < 500);
            }
        }
        assert_eq!(interval(5, 9).rounded(8), interval(5, 9));
    }
}
