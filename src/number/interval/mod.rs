//! Closed intervals of reals with MPFR ends.
//!
//! Contract: for every operation `f` and all reals x in X, y in Y where f has a value,
//! f(x, y) lies in f(X, Y). Lower ends are rounded towards minus infinity, upper ends towards plus
//! infinity, by MPFR's correct rounding in the direction asked for; no operator of `rug` that
//! rounds to nearest is used. An end may be infinite: the interval is then an unbounded set of
//! reals (infinity itself is not in it), so that in a product of ends `0 * inf` is 0. An exponent
//! that overflows gives the largest finite number downwards and infinity upwards, which encloses.

mod arithmetic;
mod decimal;
mod elementary;
mod gamma;
mod trigonometric;

use rug::float::{Constant, Round, Special};
use rug::ops::AssignRound;
use rug::{Float, Integer, Rational};
use std::cmp::Ordering;

/// No interval has more bits than this: a caller that asks for more gets this many, which still
/// encloses.
const MAX_PRECISION: u32 = 1 << 26;

/// Ends whose binary exponent is larger than this in size are not turned into rationals.
const MAX_RATIONAL_EXPONENT: u32 = 1 << 24;

/// Why a function of an interval has no enclosure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum DomainError {
    /// The function has a real value nowhere in the input: proved.
    #[error("there is no real value")]
    Certain,
    /// The function may have no value somewhere in the input; a narrower input may tell.
    #[error("there may be no real value")]
    Possible,
}

/// A closed interval of reals, both ends with the same precision, `low <= high`, never NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    low: Float,
    high: Float,
}

/// The value rounded towards minus infinity.
fn down<T>(precision: u32, value: T) -> Float
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    Float::with_val_round(precision, value, Round::Down).0
}

/// The value rounded towards plus infinity.
fn up<T>(precision: u32, value: T) -> Float
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    Float::with_val_round(precision, value, Round::Up).0
}

pub(super) fn clamp_precision(precision: u32) -> u32 {
    precision.clamp(2, MAX_PRECISION)
}

impl Interval {
    /// The interval from ends that are known to be in order and of one precision. What MPFR could
    /// not say (NaN) becomes the whole line, the sign of a zero is dropped.
    pub(super) fn new(mut low: Float, mut high: Float) -> Interval {
        let precision = low.prec().max(high.prec());
        if low.is_nan() || high.is_nan() || low > high {
            return Interval::whole_line(precision);
        }
        if low.is_zero() {
            low = Float::new(precision);
        }
        if high.is_zero() {
            high = Float::new(precision);
        }
        Interval { low, high }
    }

    /// All reals.
    pub fn whole_line(precision: u32) -> Interval {
        let precision = clamp_precision(precision);
        Interval {
            low: Float::with_val_round(precision, Special::NegInfinity, Round::Down).0,
            high: Float::with_val_round(precision, Special::Infinity, Round::Up).0,
        }
    }

    /// The narrowest interval that holds the rational number.
    pub fn from_rational(value: &Rational, precision: u32) -> Interval {
        let precision = clamp_precision(precision);
        Interval::new(down(precision, value), up(precision, value))
    }

    /// The narrowest interval that holds the integer.
    pub fn from_integer(value: &Integer, precision: u32) -> Interval {
        let precision = clamp_precision(precision);
        Interval::new(down(precision, value), up(precision, value))
    }

    /// The narrowest interval that holds the small integer.
    pub fn from_i64(value: i64, precision: u32) -> Interval {
        let precision = clamp_precision(precision);
        Interval::new(down(precision, value), up(precision, value))
    }

    /// The interval between two numbers, in the larger of their precisions. The whole line where
    /// they say nothing: NaN, the ends in the wrong order, both the same infinity.
    pub fn from_ends(low: Float, high: Float) -> Interval {
        let precision = clamp_precision(low.prec().max(high.prec()));
        let no_real = (low.is_infinite() && low.is_sign_positive())
            || (high.is_infinite() && high.is_sign_negative());
        if no_real {
            return Interval::whole_line(precision);
        }
        Interval::new(down(precision, &low), up(precision, &high))
    }

    /// The narrowest interval that holds pi.
    pub fn pi(precision: u32) -> Interval {
        let precision = clamp_precision(precision);
        Interval::new(down(precision, Constant::Pi), up(precision, Constant::Pi))
    }

    /// The same set with ends rounded outwards to another precision.
    pub fn with_precision(&self, precision: u32) -> Interval {
        let precision = clamp_precision(precision);
        Interval::new(down(precision, &self.low), up(precision, &self.high))
    }

    /// The precision of both ends, in bits.
    pub fn precision(&self) -> u32 {
        self.low.prec()
    }

    /// The lower end, or minus infinity.
    pub fn low(&self) -> &Float {
        &self.low
    }

    /// The upper end, or plus infinity.
    pub fn high(&self) -> &Float {
        &self.high
    }

    /// A real inside the interval, near its middle where it is bounded. It proves nothing.
    pub fn midpoint(&self) -> Float {
        let precision = self.precision();
        match (self.low.is_finite(), self.high.is_finite()) {
            (true, true) => {
                let half_low = down(precision, &self.low >> 1);
                let half_high = down(precision, &self.high >> 1);
                let middle = down(precision, &half_low + &half_high);
                middle.clamp(&self.low, &self.high)
            }
            (true, false) => self.low.clone(),
            (false, true) => self.high.clone(),
            (false, false) => Float::new(precision),
        }
    }

    /// An upper bound of the width; plus infinity for an unbounded interval.
    pub fn width(&self) -> Float {
        up(self.precision(), &self.high - &self.low)
    }

    /// The sign that all numbers of the interval have; `None` where they have not the same.
    pub fn sign(&self) -> Option<Ordering> {
        if self.low > 0 {
            Some(Ordering::Greater)
        } else if self.high < 0 {
            Some(Ordering::Less)
        } else if self.low.is_zero() && self.high.is_zero() {
            Some(Ordering::Equal)
        } else {
            None
        }
    }

    /// Whether 0 lies in the interval.
    pub fn contains_zero(&self) -> bool {
        self.low <= 0 && self.high >= 0
    }

    /// Whether the rational number lies in the interval.
    pub fn contains_rational(&self, value: &Rational) -> bool {
        self.low <= *value && self.high >= *value
    }

    /// Whether every number of `inner` lies in `self`.
    pub fn contains(&self, inner: &Interval) -> bool {
        self.low <= inner.low && self.high >= inner.high
    }

    /// Whether the two intervals have a number in common.
    pub fn overlaps(&self, other: &Interval) -> bool {
        self.low <= other.high && other.low <= self.high
    }

    /// Whether the two intervals have no number in common: the values they enclose differ.
    pub fn disjoint(&self, other: &Interval) -> bool {
        !self.overlaps(other)
    }

    /// Whether every number of `self` is less than every number of `other`.
    pub fn is_below(&self, other: &Interval) -> bool {
        self.high < other.low
    }

    /// Whether the interval is one number, which is then the value itself.
    pub fn is_point(&self) -> bool {
        self.low == self.high
    }

    /// Whether both ends are finite.
    pub fn is_bounded(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// The integer that the interval is, if it is one point and that an integer below 2^4096.
    pub fn as_integer(&self) -> Option<Integer> {
        let small = self.low.get_exp().is_none_or(|e| e <= 4096);
        if self.is_point() && self.low.is_integer() && small {
            self.low.to_integer()
        } else {
            None
        }
    }

    /// Whether the relative width is below 10^-digits: any two numbers a, b of the interval
    /// satisfy |a - b| < 10^-digits * min(|a|, |b|). The point 0 agrees to any number of digits.
    pub fn agrees_to(&self, digits: u32) -> bool {
        if self.is_point() {
            return true;
        }
        if self.contains_zero() || !self.is_bounded() {
            return false;
        }
        let precision = self.precision();
        let scale = up(64, Float::u_pow_u(10, digits));
        let scaled = up(precision, self.width() * &scale);
        let smaller = if self.low > 0 { &self.low } else { &self.high };
        scaled.cmp_abs(smaller) == Some(Ordering::Less)
    }

    /// Both ends as rational numbers; `None` for an unbounded interval and for ends so large or
    /// small (about 2^±16,000,000) that the rationals would fill the memory.
    pub fn ends_as_rationals(&self) -> Option<(Rational, Rational)> {
        let small = |x: &Float| {
            x.get_exp()
                .is_none_or(|e| e.unsigned_abs() <= MAX_RATIONAL_EXPONENT)
        };
        if !small(&self.low) || !small(&self.high) {
            return None;
        }
        Some((self.low.to_rational()?, self.high.to_rational()?))
    }
}

#[cfg(test)]
mod tests;
