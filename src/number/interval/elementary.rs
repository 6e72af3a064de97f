//! Roots, exponential, logarithm, real powers, floor: each monotone, so its ends come from the ends.

use super::arithmetic::hull_of_corners;
use super::{DomainError, Interval, down, up};
use rug::float::Round;
use rug::ops::Pow;
use rug::{Float, Rational};

/// The power of two ends, base >= 0, by MPFR's correctly rounded `pow`, whose values at 0 and
/// infinity are the limits along the edges (ISO C, annex F.10.4.4).
fn end_power(base: &Float, exponent: &Float, precision: u32, round: Round) -> Float {
    Float::with_val_round(precision, base.pow(exponent), round).0
}

impl Interval {
    /// All square roots of numbers >= 0.
    ///
    /// # Errors
    /// `Certain` where x < 0, `Possible` where it may be.
    pub fn sqrt(&self) -> Result<Interval, DomainError> {
        self.root(2)
    }

    /// All n-th roots of numbers >= 0. As the claim language has it, a negative number has none,
    /// whatever n is.
    ///
    /// # Errors
    /// `Certain` where x < 0 or n = 0, `Possible` where x may be negative.
    pub fn root(&self, n: u32) -> Result<Interval, DomainError> {
        if self.high < 0 || n == 0 {
            return Err(DomainError::Certain);
        }
        if self.low < 0 {
            return Err(DomainError::Possible);
        }
        let precision = self.precision();
        Ok(Interval::new(
            down(precision, self.low.root_ref(n)),
            up(precision, self.high.root_ref(n)),
        ))
    }

    /// All e^x.
    pub fn exp(&self) -> Interval {
        let precision = self.precision();
        Interval::new(
            down(precision, self.low.exp_ref()),
            up(precision, self.high.exp_ref()),
        )
    }

    /// All ln x.
    ///
    /// # Errors
    /// `Certain` where x <= 0, `Possible` where it may be.
    pub fn ln(&self) -> Result<Interval, DomainError> {
        if self.high <= 0 {
            return Err(DomainError::Certain);
        }
        if self.low <= 0 {
            return Err(DomainError::Possible);
        }
        let precision = self.precision();
        Ok(Interval::new(
            down(precision, self.low.ln_ref()),
            up(precision, self.high.ln_ref()),
        ))
    }

    /// All ln(1 + x), without the rounding of 1 + x.
    ///
    /// # Errors
    /// `Certain` where x <= -1, `Possible` where it may be.
    pub fn ln_1p(&self) -> Result<Interval, DomainError> {
        if self.high <= -1 {
            return Err(DomainError::Certain);
        }
        if self.low <= -1 {
            return Err(DomainError::Possible);
        }
        let precision = self.precision();
        Ok(Interval::new(
            down(precision, self.low.ln_1p_ref()),
            up(precision, self.high.ln_1p_ref()),
        ))
    }

    /// All x^y. For x > 0 it is exp(y ln x), monotone in each argument, so that the corners of
    /// X x Y bound it; x may touch 0 where y > 0. Where y is one integer, [`Interval::powi`].
    ///
    /// # Errors
    /// `Certain` where no x^y has a value (x < 0 and no integer in Y; x = 0 and y < 0), `Possible`
    /// where some may not have one.
    pub fn pow(&self, exponent: &Interval) -> Result<Interval, DomainError> {
        if let Some(n) = exponent.as_integer()
            && n.significant_bits() <= 64
        {
            return self.pow_integer(&n);
        }
        if self.low > 0 || (self.low.is_zero() && exponent.low > 0) {
            return Ok(hull_of_corners(self, exponent, end_power));
        }
        let only_negative = self.high < 0 && !exponent.may_hold_integer();
        let only_zero = self.low.is_zero() && self.high.is_zero() && exponent.high < 0;
        Err(if only_negative || only_zero {
            DomainError::Certain
        } else {
            DomainError::Possible
        })
    }

    /// All x^(p/q), as (x^(1/q))^p, or through logarithms where p or q is large.
    ///
    /// # Errors
    /// As [`Interval::powi`] where the exponent is an integer, else as [`Interval::pow`].
    pub fn pow_rational(&self, exponent: &Rational) -> Result<Interval, DomainError> {
        match (exponent.numer().to_i64(), exponent.denom().to_u32()) {
            (Some(p), Some(1)) => self.powi(p),
            (Some(p), Some(q)) => self.root(q)?.powi(p),
            _ => self.pow(&Interval::from_rational(exponent, self.precision())),
        }
    }

    /// Whether some integer lies in the interval.
    pub fn may_hold_integer(&self) -> bool {
        if !self.is_bounded() {
            return true;
        }
        // The least integer >= low is exact in the precision of low, or low is itself an integer.
        let next = down(self.precision(), self.low.ceil_ref());
        next <= self.high
    }

    /// The integer part, where it is the same for all numbers of the interval.
    ///
    /// # Errors
    /// `Possible` where the floors differ: the function jumps inside.
    pub fn floor(&self) -> Result<Interval, DomainError> {
        let precision = self.precision();
        let low = down(precision, self.low.floor_ref());
        let high = up(precision, self.high.floor_ref());
        if low == high && low.is_finite() {
            Ok(Interval::new(low, high))
        } else {
            Err(DomainError::Possible)
        }
    }
}
