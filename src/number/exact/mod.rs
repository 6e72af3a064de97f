//! Exact reals: Laurent polynomials over Q in logarithms of integers, the square root of pi, and
//! roots of integers.
//!
//! A value is stored as it was built, each logarithm of an integer that is no perfect power, each
//! root with an exponent between 0 and 1. Two forms of one number may look different
//! (`ln 6` and `ln 2 + ln 3`); the questions [`Exact::is_zero`], [`Exact::sign`] and
//! [`Exact::as_rational`] first rewrite over a coprime base (`coprime`), where they do not.

mod coprime;
mod decide;
mod monomial;
mod print;

use monomial::{Monomial, Symbol};
use rug::ops::Pow;
use rug::{Integer, Rational};
use std::collections::BTreeMap;

/// No coefficient of a power has more bits than this.
const MAX_BITS: u64 = 1 << 22;

/// No product has more terms than this.
const MAX_TERMS: usize = 1 << 12;

/// Why an exact operation has no exact result here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum ExactError {
    /// Division by zero, or 0 to a negative power: there is no value.
    #[error("division by zero")]
    Undefined,
    /// The result would hold more terms or bits than the caps allow.
    #[error("the exact value is too large")]
    TooLarge,
    /// The result lies outside the numbers that can be held: a quotient by a sum.
    #[error("the value has no exact form here")]
    NoForm,
}

/// An exact real number: a sum of rational multiples of products of powers of `ln n`, `sqrt(pi)`
/// and roots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exact {
    /// No coefficient is 0.
    terms: BTreeMap<Monomial, Rational>,
}

impl Exact {
    fn zero() -> Exact {
        Exact {
            terms: BTreeMap::new(),
        }
    }

    fn term(monomial: Monomial, coefficient: Rational) -> Exact {
        let mut value = Exact::zero();
        value.add_term(monomial, coefficient);
        value
    }

    fn add_term(&mut self, monomial: Monomial, coefficient: Rational) {
        if coefficient.cmp0().is_eq() {
            return;
        }
        let entry = self.terms.entry(monomial.clone()).or_default();
        *entry += coefficient;
        if entry.cmp0().is_eq() {
            self.terms.remove(&monomial);
        }
    }

    /// A rational number.
    pub fn from_rational(value: &Rational) -> Exact {
        Exact::term(Monomial::one(), value.clone())
    }

    /// An integer.
    pub fn from_i64(value: i64) -> Exact {
        Exact::term(Monomial::one(), Rational::from(value))
    }

    /// ln q = ln(numerator) - ln(denominator); `None` for q <= 0.
    pub fn ln_of(value: &Rational) -> Option<Exact> {
        if value.cmp0().is_le() {
            return None;
        }
        let mut sum = Exact::zero();
        for (integer, sign) in [(value.numer(), 1), (value.denom(), -1)] {
            if *integer != 1 {
                let (base, exponent) = coprime::perfect_power(integer);
                let coefficient = Rational::from(exponent) * sign;
                sum.add_term(Monomial::power(Symbol::Ln(base), 1.into()), coefficient);
            }
        }
        Some(sum)
    }

    /// pi
    pub fn pi() -> Exact {
        Exact::term(Monomial::power(Symbol::SqrtPi, 2.into()), 1.into())
    }

    /// The square root of pi.
    pub fn sqrt_pi() -> Exact {
        Exact::term(Monomial::power(Symbol::SqrtPi, 1.into()), 1.into())
    }

    /// The n-th root of q >= 0; `None` for q < 0 or n = 0.
    pub fn root(value: &Rational, index: u32) -> Option<Exact> {
        if value.cmp0().is_lt() || index == 0 {
            return None;
        }
        if value.cmp0().is_eq() {
            return Some(Exact::zero());
        }
        let exponent = Rational::from((1, index));
        let above = Exact::integer_power(value.numer(), &exponent);
        let below = Exact::integer_power(value.denom(), &-exponent);
        above.mul(&below).ok()
    }

    /// n^e for an integer n > 0 and a rational e in [-1, 1].
    fn integer_power(value: &Integer, exponent: &Rational) -> Exact {
        let (base, power) = coprime::perfect_power(value);
        let mut coefficient = Rational::from(1);
        let mut monomial = Monomial::one();
        monomial.multiply_root(&base, &(exponent.clone() * power), &mut coefficient);
        Exact::term(monomial, coefficient)
    }

    /// The rational number that this is, as far as rewriting over a coprime base can tell.
    pub fn as_rational(&self) -> Option<Rational> {
        let constant = |value: &Exact| {
            let mut terms = value.terms.iter();
            match (terms.next(), terms.next()) {
                (None, _) => Some(Rational::new()),
                (Some((monomial, coefficient)), None) if monomial.is_one() => {
                    Some(coefficient.clone())
                }
                _ => None,
            }
        };
        constant(self).or_else(|| constant(&self.canonical()?))
    }

    /// The sum.
    pub fn add(&self, other: &Exact) -> Exact {
        let mut sum = self.clone();
        for (monomial, coefficient) in &other.terms {
            sum.add_term(monomial.clone(), coefficient.clone());
        }
        sum
    }

    /// The difference.
    pub fn sub(&self, other: &Exact) -> Exact {
        self.add(&other.neg())
    }

    /// The negative.
    pub fn neg(&self) -> Exact {
        Exact {
            terms: self
                .terms
                .iter()
                .map(|(monomial, coefficient)| (monomial.clone(), Rational::from(-coefficient)))
                .collect(),
        }
    }

    /// The product.
    ///
    /// # Errors
    /// [`ExactError::TooLarge`] past the cap of terms or bits.
    pub fn mul(&self, other: &Exact) -> Result<Exact, ExactError> {
        let terms = self.terms.len().saturating_mul(other.terms.len());
        if terms > MAX_TERMS || self.bits().saturating_add(other.bits()) > MAX_BITS {
            return Err(ExactError::TooLarge);
        }
        let mut product = Exact::zero();
        for (a, x) in &self.terms {
            for (b, y) in &other.terms {
                let mut coefficient = Rational::from(x * y);
                let monomial = a.times(b, &mut coefficient);
                product.add_term(monomial, coefficient);
            }
        }
        Ok(product)
    }

    /// The quotient, where the divisor is one term once rewritten over a coprime base; `None` for
    /// any other divisor, zero among them, and past the caps.
    pub fn div(&self, divisor: &Exact) -> Option<Exact> {
        let inverse = divisor
            .inverse()
            .or_else(|_| divisor.canonical().ok_or(ExactError::NoForm)?.inverse())
            .ok()?;
        self.mul(&inverse).ok()
    }

    /// The inverse of a single term. Every symbol is a positive real, so a term is not 0.
    fn inverse(&self) -> Result<Exact, ExactError> {
        let mut terms = self.terms.iter();
        match (terms.next(), terms.next()) {
            (None, _) => Err(ExactError::Undefined),
            (Some((monomial, coefficient)), None) => {
                let mut inverse = Rational::from(coefficient.recip_ref());
                let monomial = monomial.inverse(&mut inverse);
                Ok(Exact::term(monomial, inverse))
            }
            _ => Err(ExactError::NoForm),
        }
    }

    /// The power with an integer exponent; x^0 is 1, at x = 0 too.
    ///
    /// # Errors
    /// [`ExactError::Undefined`] for 0 to a negative power, [`ExactError::NoForm`] for a sum to a
    /// negative power, [`ExactError::TooLarge`] past the caps; sizes are estimated before any work.
    pub fn powi(&self, exponent: i64) -> Result<Exact, ExactError> {
        if exponent < 0 {
            let inverse = self.inverse().or_else(|error| match error {
                ExactError::NoForm => self.canonical().ok_or(ExactError::NoForm)?.inverse(),
                other => Err(other),
            })?;
            return inverse.power(exponent.unsigned_abs());
        }
        self.power(exponent.unsigned_abs())
    }

    fn power(&self, exponent: u64) -> Result<Exact, ExactError> {
        if let Some(constant) = self.constant() {
            return power_of_rational(constant, exponent).map(|q| Exact::from_rational(&q));
        }
        if exponent > MAX_BITS {
            return Err(ExactError::TooLarge);
        }
        let mut result = Exact::from_i64(1);
        let mut square = self.clone();
        let mut left = exponent;
        while left > 0 {
            if left & 1 == 1 {
                result = result.mul(&square)?;
            }
            left >>= 1;
            if left > 0 {
                square = square.mul(&square)?;
            }
        }
        Ok(result)
    }

    /// The value where it is stored without any symbol.
    fn constant(&self) -> Option<&Rational> {
        match self.terms.first_key_value() {
            Some((monomial, coefficient)) if self.terms.len() == 1 && monomial.is_one() => {
                Some(coefficient)
            }
            _ => None,
        }
    }

    /// Bits of the largest coefficient, numerator and denominator together.
    fn bits(&self) -> u64 {
        self.terms.values().map(bits_of).max().unwrap_or(0)
    }
}

fn bits_of(value: &Rational) -> u64 {
    u64::from(value.numer().significant_bits()) + u64::from(value.denom().significant_bits())
}

/// A power of a nonzero rational, its size estimated first.
fn power_of_rational(value: &Rational, exponent: u64) -> Result<Rational, ExactError> {
    if *value == 1 {
        return Ok(value.clone());
    }
    if *value == -1 {
        return Ok(Rational::from(if exponent.is_multiple_of(2) {
            1
        } else {
            -1
        }));
    }
    if bits_of(value).saturating_mul(exponent) > MAX_BITS {
        return Err(ExactError::TooLarge);
    }
    let exponent = u32::try_from(exponent).map_err(|_| ExactError::TooLarge)?;
    Ok(Rational::from(value.pow(exponent)))
}

#[cfg(test)]
mod tests;
