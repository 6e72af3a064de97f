//! Sine and cosine.
//!
//! Between two neighbouring multiples of pi/2 both are monotone. So the range over [a, b] is the
//! hull of the values at a and b, and of 1 or -1 where a multiple k*pi/2 with the right k mod 4 lies
//! in (a, b]. Which k do is told by floor(a/(pi/2)) and floor(b/(pi/2)), each decided by an
//! enclosure: a nonzero dyadic number over pi/2 is irrational, so enough bits decide.

use super::{Interval, down, up};
use rug::{Float, Integer};

/// Arguments beyond 2^this are not reduced (the bits needed grow with the exponent): the answer is
/// [-1, 1].
const MAX_EXPONENT: i32 = 1 << 14;

/// Tries, each with twice the guard bits, to tell a quadrant.
const ROUNDS: u32 = 6;

/// floor(x/(pi/2)), or `None` where it could not be told.
fn quadrant(x: &Float) -> Option<Integer> {
    if x.is_zero() {
        return Some(Integer::new());
    }
    let exponent = x.get_exp().filter(|e| *e <= MAX_EXPONENT)?;
    let whole = x.prec() + exponent.max(0).unsigned_abs();
    for round in 0..ROUNDS {
        let precision = whole + (32 << round);
        let point = Interval::from_ends(x.clone(), x.clone()).with_precision(precision);
        let two = Interval::from_i64(2, precision);
        let quotient = point.mul(&two).div(&Interval::pi(precision)).ok()?;
        if let Ok(floor) = quotient.floor() {
            return floor.low.to_integer();
        }
    }
    None
}

/// Whether some k with first < k <= last is `residue` modulo 4.
fn holds_residue(first: &Integer, last: &Integer, residue: u32) -> bool {
    let shift = Integer::from(residue);
    let count = |k: &Integer| (k.clone() - &shift).div_rem_floor(Integer::from(4)).0;
    count(last) > count(first)
}

impl Interval {
    /// All sin x.
    pub fn sin(&self) -> Interval {
        let precision = self.precision();
        self.periodic(1, 3, |x| {
            (down(precision, x.sin_ref()), up(precision, x.sin_ref()))
        })
    }

    /// All cos x.
    pub fn cos(&self) -> Interval {
        let precision = self.precision();
        self.periodic(0, 2, |x| {
            (down(precision, x.cos_ref()), up(precision, x.cos_ref()))
        })
    }

    /// The range of a function that is 1 at the quarter turns `top` modulo 4, -1 at `bottom`, and
    /// monotone between; `at` gives its value at an end, rounded down and up.
    fn periodic(&self, top: u32, bottom: u32, at: impl Fn(&Float) -> (Float, Float)) -> Interval {
        let precision = self.precision();
        let whole = Interval::new(down(precision, -1), up(precision, 1));
        if !self.is_bounded() {
            return whole;
        }
        let (Some(first), Some(last)) = (quadrant(&self.low), quadrant(&self.high)) else {
            return whole;
        };
        let (a_low, a_high) = at(&self.low);
        let (b_low, b_high) = at(&self.high);
        let mut range = Interval::new(a_low, a_high).hull(&Interval::new(b_low, b_high));
        if holds_residue(&first, &last, top) {
            range.high = whole.high;
        }
        if holds_residue(&first, &last, bottom) {
            range.low = whole.low;
        }
        range
    }
}
