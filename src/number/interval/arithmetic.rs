//! The field operations, absolute value, order, and powers with integer exponents.

use super::{DomainError, Interval, down, up};
use rug::float::Round;
use rug::ops::Pow;
use rug::{Float, Integer};

/// Exponents with more bits go through the power with a real exponent.
const MAX_EXPONENT_BITS: u32 = 64;

/// The product of two ends. An infinite end stands for arbitrarily large reals, so that with an
/// end 0 the products are 0.
fn end_product(a: &Float, b: &Float, precision: u32, round: Round) -> Float {
    if a.is_zero() || b.is_zero() {
        Float::new(precision)
    } else {
        Float::with_val_round(precision, a * b, round).0
    }
}

/// The quotient of two ends, `b` not zero. A product with the end 0 of 1/b where `b` is infinite.
fn end_quotient(a: &Float, b: &Float, precision: u32, round: Round) -> Float {
    if a.is_zero() || b.is_infinite() {
        Float::new(precision)
    } else {
        Float::with_val_round(precision, a / b, round).0
    }
}

fn smallest(values: impl IntoIterator<Item = Float>, precision: u32) -> Float {
    values
        .into_iter()
        .reduce(|a, b| if b < a { b } else { a })
        .unwrap_or_else(|| Interval::whole_line(precision).low)
}

fn largest(values: impl IntoIterator<Item = Float>, precision: u32) -> Float {
    values
        .into_iter()
        .reduce(|a, b| if b > a { b } else { a })
        .unwrap_or_else(|| Interval::whole_line(precision).high)
}

/// The hull of `f` at the four corners of X x Y, for an `f` that is monotone in each argument.
pub(super) fn hull_of_corners(
    x: &Interval,
    y: &Interval,
    f: impl Fn(&Float, &Float, u32, Round) -> Float,
) -> Interval {
    let precision = x.precision().max(y.precision());
    let corners = [
        (&x.low, &y.low),
        (&x.low, &y.high),
        (&x.high, &y.low),
        (&x.high, &y.high),
    ];
    Interval::new(
        smallest(
            corners.map(|(a, b)| f(a, b, precision, Round::Down)),
            precision,
        ),
        largest(
            corners.map(|(a, b)| f(a, b, precision, Round::Up)),
            precision,
        ),
    )
}

impl Interval {
    /// All x + y.
    pub fn add(&self, other: &Interval) -> Interval {
        let precision = self.precision().max(other.precision());
        Interval::new(
            down(precision, &self.low + &other.low),
            up(precision, &self.high + &other.high),
        )
    }

    /// All x - y.
    pub fn sub(&self, other: &Interval) -> Interval {
        let precision = self.precision().max(other.precision());
        Interval::new(
            down(precision, &self.low - &other.high),
            up(precision, &self.high - &other.low),
        )
    }

    /// All x * y.
    pub fn mul(&self, other: &Interval) -> Interval {
        // Two products of ends instead of eight, where the signs are known.
        if self.low < 0 && self.high <= 0 {
            return self.neg().mul(other).neg();
        }
        if other.low < 0 && other.high <= 0 {
            return self.mul(&other.neg()).neg();
        }
        if self.low >= 0 && other.low >= 0 {
            let precision = self.precision().max(other.precision());
            return Interval::new(
                end_product(&self.low, &other.low, precision, Round::Down),
                end_product(&self.high, &other.high, precision, Round::Up),
            );
        }
        hull_of_corners(self, other, end_product)
    }

    /// All x / y.
    ///
    /// # Errors
    /// `Certain` where y is 0, `Possible` where it may be.
    pub fn div(&self, other: &Interval) -> Result<Interval, DomainError> {
        if other.high < 0 {
            return Ok(self.div(&other.neg())?.neg());
        }
        if other.low > 0 && self.low >= 0 {
            let precision = self.precision().max(other.precision());
            return Ok(Interval::new(
                end_quotient(&self.low, &other.high, precision, Round::Down),
                end_quotient(&self.high, &other.low, precision, Round::Up),
            ));
        }
        if other.low > 0 {
            return Ok(hull_of_corners(self, other, end_quotient));
        }
        Err(if other.is_point() {
            DomainError::Certain
        } else {
            DomainError::Possible
        })
    }

    /// All x * n for one integer n.
    pub fn mul_integer(&self, n: &Integer) -> Interval {
        let precision = self.precision();
        if n.cmp0().is_eq() {
            return Interval::from_i64(0, precision);
        }
        let (least, most) = self.in_order_of(n);
        Interval::new(down(precision, least * n), up(precision, most * n))
    }

    /// All x / n for one integer n.
    ///
    /// # Errors
    /// `Certain` for n = 0.
    pub fn div_integer(&self, n: &Integer) -> Result<Interval, DomainError> {
        if n.cmp0().is_eq() {
            return Err(DomainError::Certain);
        }
        let precision = self.precision();
        let (least, most) = self.in_order_of(n);
        Ok(Interval::new(
            down(precision, least / n),
            up(precision, most / n),
        ))
    }

    /// The ends whose multiples by n are the least and the largest.
    fn in_order_of(&self, n: &Integer) -> (&Float, &Float) {
        if n.cmp0().is_gt() {
            (&self.low, &self.high)
        } else {
            (&self.high, &self.low)
        }
    }

    /// All -x.
    pub fn neg(&self) -> Interval {
        Interval::new(
            down(self.precision(), -&self.high),
            up(self.precision(), -&self.low),
        )
    }

    /// All |x|.
    pub fn abs(&self) -> Interval {
        if self.low >= 0 {
            self.clone()
        } else if self.high <= 0 {
            self.neg()
        } else {
            let flipped = self.neg();
            let high = largest([self.high.clone(), flipped.high], self.precision());
            Interval::new(Float::new(self.precision()), high)
        }
    }

    /// All x^2.
    pub fn square(&self) -> Interval {
        let size = self.abs();
        size.mul(&size)
    }

    /// All min(x, y).
    pub fn min(&self, other: &Interval) -> Interval {
        let precision = self.precision().max(other.precision());
        let (a, b) = (
            self.with_precision(precision),
            other.with_precision(precision),
        );
        Interval::new(
            smallest([a.low, b.low], precision),
            smallest([a.high, b.high], precision),
        )
    }

    /// All max(x, y).
    pub fn max(&self, other: &Interval) -> Interval {
        let precision = self.precision().max(other.precision());
        let (a, b) = (
            self.with_precision(precision),
            other.with_precision(precision),
        );
        Interval::new(
            largest([a.low, b.low], precision),
            largest([a.high, b.high], precision),
        )
    }

    /// The smallest interval that holds both.
    pub fn hull(&self, other: &Interval) -> Interval {
        let precision = self.precision().max(other.precision());
        let (a, b) = (
            self.with_precision(precision),
            other.with_precision(precision),
        );
        Interval::new(
            smallest([a.low, b.low], precision),
            largest([a.high, b.high], precision),
        )
    }

    /// The numbers that both hold; `None` where there are none.
    pub fn intersection(&self, other: &Interval) -> Option<Interval> {
        if self.disjoint(other) {
            return None;
        }
        let precision = self.precision().max(other.precision());
        let (a, b) = (
            self.with_precision(precision),
            other.with_precision(precision),
        );
        Some(Interval::new(
            largest([a.low, b.low], precision),
            smallest([a.high, b.high], precision),
        ))
    }

    /// All x^n for one integer n; x^0 is 1, at x = 0 too.
    ///
    /// # Errors
    /// For n < 0: `Certain` where x is 0, `Possible` where it may be.
    pub fn powi(&self, exponent: i64) -> Result<Interval, DomainError> {
        self.pow_integer(&Integer::from(exponent))
    }

    /// All x^n for one integer n of any size.
    ///
    /// # Errors
    /// As [`Interval::powi`]; for an exponent beyond 64 bits also `Possible` where x may be 0.
    pub fn pow_integer(&self, exponent: &Integer) -> Result<Interval, DomainError> {
        if exponent.cmp0().is_eq() {
            return Ok(Interval::from_i64(1, self.precision()));
        }
        if exponent.cmp0().is_lt() && self.contains_zero() {
            return Err(if self.is_point() {
                DomainError::Certain
            } else {
                DomainError::Possible
            });
        }
        let negative_result = exponent.is_odd() && self.high <= 0;
        if exponent.is_odd() && self.low < 0 && self.high > 0 {
            return self.odd_power_across_zero(exponent);
        }
        let size = self.abs().power_of_size(exponent)?;
        Ok(if negative_result { size.neg() } else { size })
    }

    /// x^n for odd n > 0 and an interval with numbers of both signs: increasing.
    fn odd_power_across_zero(&self, exponent: &Integer) -> Result<Interval, DomainError> {
        let zero = Float::new(self.precision());
        let above = Interval::new(zero.clone(), self.high.clone()).power_of_size(exponent)?;
        let below = Interval::new(zero, self.neg().high).power_of_size(exponent)?;
        Ok(Interval::new(below.neg().low, above.high))
    }

    /// x^n for x >= 0 and n != 0, where x is not 0 if n < 0: monotone.
    fn power_of_size(&self, exponent: &Integer) -> Result<Interval, DomainError> {
        let precision = self.precision();
        if exponent.significant_bits() > MAX_EXPONENT_BITS {
            return self.pow(&Interval::from_integer(exponent, precision));
        }
        let (least, most) = if exponent.cmp0().is_gt() {
            (&self.low, &self.high)
        } else {
            (&self.high, &self.low)
        };
        Ok(Interval::new(
            down(precision, least.pow(exponent)),
            up(precision, most.pow(exponent)),
        ))
    }
}
