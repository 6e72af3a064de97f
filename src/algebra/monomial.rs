//! Power products of indeterminates.

use super::AlgebraError;
use crate::formula::Name;
use std::cmp::Ordering;

/// An indeterminate, known by its name. Texts that are no names of the claim language, such as
/// `ln(n)`, serve as further indeterminates.
pub type Symbol = Name;

/// A product of powers of indeterminates, symbols ascending, exponents positive.
///
/// The order is the pure lexicographic term order with the alphabetically first symbol largest. It
/// is admissible (`a < b` implies `a*c < b*c`, and 1 is smallest), as exact division needs.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct Monomial(Vec<(Symbol, u32)>);

impl Monomial {
    /// The empty product.
    pub fn one() -> Monomial {
        Monomial::default()
    }

    /// `symbol^exponent`
    pub fn power(symbol: &Symbol, exponent: u32) -> Monomial {
        match exponent {
            0 => Monomial::one(),
            _ => Monomial(vec![(symbol.clone(), exponent)]),
        }
    }

    /// The symbols with their exponents, ascending.
    pub fn powers(&self) -> &[(Symbol, u32)] {
        &self.0
    }

    /// The exponent of a symbol, 0 when it does not occur.
    pub fn exponent(&self, symbol: &str) -> u32 {
        let found = self.0.iter().find(|(name, _)| &**name == symbol);
        found.map_or(0, |(_, exponent)| *exponent)
    }

    /// Whether this is the empty product.
    pub fn is_one(&self) -> bool {
        self.0.is_empty()
    }

    /// The product.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] when an exponent overflows.
    pub fn mul(&self, other: &Monomial) -> Result<Monomial, AlgebraError> {
        self.merge(other, |a, b| a.checked_add(b).ok_or(AlgebraError::TooLarge))
    }

    /// The quotient, or nothing when an exponent would be negative.
    pub fn div(&self, other: &Monomial) -> Option<Monomial> {
        self.merge(other, |a, b| a.checked_sub(b).ok_or(())).ok()
    }

    /// The greatest common divisor.
    pub fn common(&self, other: &Monomial) -> Monomial {
        let powers = self
            .0
            .iter()
            .map(|(symbol, exponent)| (symbol.clone(), other.exponent(symbol).min(*exponent)));
        Monomial(powers.filter(|(_, exponent)| *exponent > 0).collect())
    }

    /// Splits off the power of one symbol.
    pub fn split(&self, symbol: &str) -> (u32, Monomial) {
        let rest = self.0.iter().filter(|(name, _)| &**name != symbol);
        (self.exponent(symbol), Monomial(rest.cloned().collect()))
    }

    fn merge<E>(
        &self,
        other: &Monomial,
        join: impl Fn(u32, u32) -> Result<u32, E>,
    ) -> Result<Monomial, E> {
        let (mut left, mut right) = (self.0.iter().peekable(), other.0.iter().peekable());
        let mut powers = Vec::with_capacity(self.0.len() + other.0.len());
        loop {
            let (symbol, exponent) = match (left.peek(), right.peek()) {
                (None, None) => return Ok(Monomial(powers)),
                (Some((a, i)), Some((b, j))) if a == b => {
                    let pair = (a.clone(), join(*i, *j)?);
                    left.next();
                    right.next();
                    pair
                }
                (Some((a, i)), other) if other.is_none_or(|(b, _)| a < b) => {
                    let pair = (a.clone(), join(*i, 0)?);
                    left.next();
                    pair
                }
                (_, Some((b, j))) => {
                    let pair = (b.clone(), join(0, *j)?);
                    right.next();
                    pair
                }
                (Some(_), None) => return Ok(Monomial(powers)),
            };
            if exponent > 0 {
                powers.push((symbol, exponent));
            }
        }
    }
}

impl Ord for Monomial {
    fn cmp(&self, other: &Monomial) -> Ordering {
        for (a, b) in self.0.iter().zip(&other.0) {
            match a.0.cmp(&b.0) {
                // The side that holds the earlier symbol is the larger one.
                Ordering::Less => return Ordering::Greater,
                Ordering::Greater => return Ordering::Less,
                Ordering::Equal if a.1 != b.1 => return a.1.cmp(&b.1),
                Ordering::Equal => {}
            }
        }
        self.0.len().cmp(&other.0.len())
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Monomial) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
