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
    PlusInfinity,
    MinusInfinity,
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

    /// The sign, infinities included.
    fn sign(&self) -> Result<Ordering, Unknown> {
        match self {
            Quantity::PlusInfinity => Ok(Ordering::Greater),
            Quantity::MinusInfinity => Ok(Ordering::Less),
            Quantity::Finite(_) => self.clone().number()?.sign(),
        }
    }

    pub fn negated(&self) -> Quantity {
        match self {
            Quantity::PlusInfinity => Quantity::MinusInfinity,
            Quantity::MinusInfinity => Quantity::PlusInfinity,
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
        match (self.sign()?, other.sign()?) {
            (Ordering::Equal, _) | (_, Ordering::Equal) => Err(Gap::Undefined),
            (a, b) if a == b => Ok(Quantity::PlusInfinity),
            _ => Ok(Quantity::MinusInfinity),
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
            (a, b) if a == b => Ok(Ordering::Equal),
            (Quantity::PlusInfinity, _) | (_, Quantity::MinusInfinity) => Ok(Ordering::Greater),
            _ => Ok(Ordering::Less),
        }
    }
}

/// What is found, as the value of a formula.
pub(super) fn as_value(found: Found<Quantity>) -> Result<Value, Unknown> {
    match found {
        Ok(Quantity::PlusInfinity) => Ok(Value::PlusInfinity),
        Ok(Quantity::MinusInfinity) => Ok(Value::MinusInfinity),
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
