//! What a formula comes to: a number, a function of an integral's variable, or an infinity.

use super::fraction::Fraction;
use super::interval::Interval;
use super::{Found, Gap, Unknown, unknown};
use crate::formula::Rational;
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

/// What the kernel computes with; that there is no value is a [`Gap`] instead.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Quantity {
    Finite(Fraction),
    /// Greater or less than all numbers.
    Infinite(Ordering),
}

impl<T: Into<Fraction>> From<T> for Quantity {
    fn from(finite: T) -> Quantity {
        Quantity::Finite(finite.into())
    }
}

impl Quantity {
    pub fn finite(self) -> Result<Fraction, Unknown> {
        match self {
            Quantity::Finite(fraction) => Ok(fraction),
            _ => unknown("an infinity where the kernel needs a number"),
        }
    }

    pub fn number(self) -> Result<Interval, Unknown> {
        match self.finite()?.as_number() {
            Some(number) => Ok(number),
            None => unknown("a function that the kernel has no rule for inside of an integral"),
        }
    }

    pub fn negated(&self) -> Quantity {
        match self {
            Quantity::Infinite(sign) => Quantity::Infinite(sign.reverse()),
            Quantity::Finite(fraction) => fraction.negated().into(),
        }
    }

    /// The sum; `inf - inf` has no value.
    pub fn plus(&self, other: &Quantity) -> Found<Quantity> {
        match (self, other) {
            (Quantity::Finite(a), Quantity::Finite(b)) => Ok(a.plus(b)?.into()),
            (Quantity::Finite(_), infinity) | (infinity, Quantity::Finite(_)) => {
                Ok(infinity.clone())
            }
            (a, b) if a == b => Ok(a.clone()),
            _ => Err(Gap::Undefined),
        }
    }

    /// The product; `0*inf` has no value.
    pub fn times(&self, other: &Quantity) -> Found<Quantity> {
        if let (Quantity::Finite(a), Quantity::Finite(b)) = (self, other) {
            return Ok(a.times(b)?.into());
        }
        let zero = Interval::integer(0).into();
        match (self.compare(&zero)?, other.compare(&zero)?) {
            (Ordering::Equal, _) | (_, Ordering::Equal) => Err(Gap::Undefined),
            (Ordering::Greater, sign) => Ok(Quantity::Infinite(sign)),
            (Ordering::Less, sign) => Ok(Quantity::Infinite(sign.reverse())),
        }
    }

    /// 1 over this; there is none of zero, nor of an infinity.
    pub fn reciprocal(&self) -> Found<Quantity> {
        match self {
            Quantity::Finite(fraction) => Ok(fraction.reciprocal()?.into()),
            _ => Err(Gap::Undefined),
        }
    }

    /// How two values compare.
    ///
    /// # Errors
    /// Enclosures that meet, and functions.
    pub fn compare(&self, other: &Quantity) -> Result<Ordering, Unknown> {
        match (self, other) {
            (Quantity::Finite(_), Quantity::Finite(_)) => {
                let (a, b) = (self.clone().number()?, other.clone().number()?);
                a.compare(&b)
            }
            (Quantity::Infinite(a), Quantity::Infinite(b)) => Ok(a.cmp(b)),
            (Quantity::Infinite(sign), _) => Ok(*sign),
            (_, Quantity::Infinite(sign)) => Ok(sign.reverse()),
        }
    }
}

/// What is found, as the value of a formula.
pub(super) fn as_value(found: Found<Quantity>) -> Result<Value, Unknown> {
    match found {
        Ok(Quantity::Infinite(Ordering::Less)) => Ok(Value::MinusInfinity),
        Ok(Quantity::Infinite(_)) => Ok(Value::PlusInfinity),
        Ok(finite) => {
            let number = finite.number()?;
            Ok(Value::Finite {
                low: number.low().clone(),
                high: number.high().clone(),
            })
        }
        Err(Gap::Undefined) => Ok(Value::Undefined),
        Err(Gap::Unknown(why)) => Err(why),
    }
}
