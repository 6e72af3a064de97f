//! Euler's Gamma function and its logarithm.
//!
//! Theorem. Between two neighbouring poles (and for x > 0) ln|Gamma| is convex, and so is |Gamma|.
//! Proof: (ln|Gamma|)'' = psi'(x) = sum over n >= 0 of 1/(x + n)^2 > 0 (DLMF 5.15.1); the
//! exponential of a convex function is convex. Hence on an interval [a, b] without pole
//! - the largest |Gamma| is at an end;
//! - where psi(a) >= 0 it increases, where psi(b) <= 0 it decreases (psi itself increases), so that
//!   the least is at an end too;
//! - else the tangents of ln|Gamma| at a and b lie below it: with psi(a) < 0 < psi(b),
//!   ln|Gamma(x)| >= ln|Gamma(a)| + psi(a)(b - a) and >= ln|Gamma(b)| - psi(b)(b - a).
//!
//! The values and psi at an end are MPFR's, correctly rounded in the direction asked for.

use super::{DomainError, Interval, down, up};
use rug::Float;

/// Ends below -2^this are not looked at: between poles there Gamma underflows anyway.
const MAX_NEGATIVE_EXPONENT: i32 = 24;

/// How ln|Gamma| runs over an interval without pole.
enum Run {
    Increasing,
    Decreasing,
    /// It may turn: psi at the lower end rounded down, at the upper end rounded up.
    Turning(Float, Float),
}

impl Interval {
    /// All Gamma(x), DLMF 5.2.1.
    ///
    /// # Errors
    /// `Certain` at a pole (x = 0, -1, -2, ...), `Possible` where a pole may lie inside.
    pub fn gamma(&self) -> Result<Interval, DomainError> {
        self.check_poles()?;
        let precision = self.precision();
        let at =
            |x: &Float| Interval::new(down(precision, x.gamma_ref()), up(precision, x.gamma_ref()));
        let (a, b) = (at(&self.low), at(&self.high));
        let negative = a.high <= 0 && b.high <= 0 && self.low < 0;
        let size = self.convex_range(&a.abs(), &b.abs(), |value, slope| value.mul(&slope.exp()));
        // |Gamma| > 0, whatever the tangent's rounding says.
        let size = size.max(&Interval::from_i64(0, precision));
        Ok(if negative { size.neg() } else { size })
    }

    /// All ln Gamma(x) for x > 0.
    ///
    /// # Errors
    /// `Certain` where x <= 0, `Possible` where it may be.
    pub fn lngamma(&self) -> Result<Interval, DomainError> {
        if self.high <= 0 {
            return Err(DomainError::Certain);
        }
        if self.low <= 0 {
            return Err(DomainError::Possible);
        }
        let precision = self.precision();
        let at = |x: &Float| {
            Interval::new(
                down(precision, x.ln_gamma_ref()),
                up(precision, x.ln_gamma_ref()),
            )
        };
        let (a, b) = (at(&self.low), at(&self.high));
        Ok(self.convex_range(&a, &b, |value, slope| value.add(slope)))
    }

    /// All psi(x) = Gamma'(x)/Gamma(x), DLMF 5.2.2: increasing between its poles 0, -1, -2, ...
    ///
    /// # Errors
    /// As [`Interval::gamma`].
    pub fn digamma(&self) -> Result<Interval, DomainError> {
        self.check_poles()?;
        let precision = self.precision();
        Ok(Interval::new(
            down(precision, self.low.digamma_ref()),
            up(precision, self.high.digamma_ref()),
        ))
    }

    /// An error unless the interval is free of poles.
    fn check_poles(&self) -> Result<(), DomainError> {
        if self.low > 0 {
            return Ok(());
        }
        if self.is_point() && self.low.is_integer() {
            return Err(DomainError::Certain);
        }
        let too_low = self
            .low
            .get_exp()
            .is_some_and(|e| e > MAX_NEGATIVE_EXPONENT);
        if !self.low.is_finite() || too_low || self.may_hold_integer() {
            return Err(DomainError::Possible);
        }
        Ok(())
    }

    /// The range of a function with logarithm (or itself) ln|Gamma|, from enclosures of its values
    /// at both ends; `tangent` moves a value along a change of the logarithm.
    fn convex_range(
        &self,
        at_low: &Interval,
        at_high: &Interval,
        tangent: impl Fn(&Interval, &Interval) -> Interval,
    ) -> Interval {
        let top = at_low.max(at_high).high;
        match self.run() {
            Run::Increasing => Interval::new(at_low.low.clone(), top),
            Run::Decreasing => Interval::new(at_high.low.clone(), top),
            Run::Turning(falling, rising) => {
                let width = Interval::from_ends(self.width(), self.width());
                let slope = |s: Float| Interval::from_ends(s.clone(), s).mul(&width);
                let from_low = tangent(at_low, &slope(falling));
                let from_high = tangent(at_high, &slope(rising).neg());
                Interval::new(from_low.max(&from_high).low, top)
            }
        }
    }

    /// How ln|Gamma| runs over the interval, which holds no pole.
    fn run(&self) -> Run {
        // The only zero of psi on x > 0 is 1.4616... (DLMF 5.4.20).
        if self.is_point() || self.low >= 1.5 {
            return Run::Increasing;
        }
        if self.low > 0 && self.high <= 1.25 {
            return Run::Decreasing;
        }
        let precision = self.precision();
        let falling = down(precision, self.low.digamma_ref());
        let rising = up(precision, self.high.digamma_ref());
        if falling >= 0 {
            Run::Increasing
        } else if rising <= 0 {
            Run::Decreasing
        } else {
            Run::Turning(falling, rising)
        }
    }
}
