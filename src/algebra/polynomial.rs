//! Sparse polynomials over the rationals.

use super::{AlgebraError, Monomial, Symbol};
use crate::formula::Budget;
use rug::{Integer, Rational};
use std::collections::{BTreeMap, BTreeSet};

/// Coefficients beyond this many bits are refused: GMP aborts where memory ends.
const MAX_BITS: u32 = 1 << 24;

/// A polynomial: monomials with nonzero rational coefficients. Equal polynomials have equal
/// representations, so `==` decides identity.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Polynomial {
    terms: BTreeMap<Monomial, Rational>,
}

fn bits(value: &Rational) -> u32 {
    value
        .numer()
        .significant_bits()
        .max(value.denom().significant_bits())
}

impl Polynomial {
    /// 0
    pub fn zero() -> Polynomial {
        Polynomial::default()
    }

    /// 1
    pub fn one() -> Polynomial {
        Polynomial::integer(1)
    }

    /// A constant integer.
    pub fn integer(value: i64) -> Polynomial {
        Polynomial::constant(Rational::from(value))
    }

    /// A constant.
    pub fn constant(value: Rational) -> Polynomial {
        Polynomial::term(Monomial::one(), value)
    }

    /// An indeterminate.
    pub fn symbol(symbol: &Symbol) -> Polynomial {
        Polynomial::term(Monomial::power(symbol, 1), Rational::from(1))
    }

    /// `coefficient * monomial`
    pub fn term(monomial: Monomial, coefficient: Rational) -> Polynomial {
        let mut sum = Polynomial::zero();
        sum.add_term(monomial, coefficient);
        sum
    }

    /// The monomials with their coefficients, ascending.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &Rational)> {
        self.terms.iter()
    }

    /// How many monomials there are.
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether this is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Whether there is no monomial: the same as [`Polynomial::is_zero`].
    pub fn is_empty(&self) -> bool {
        self.is_zero()
    }

    /// The value of a constant polynomial.
    pub fn as_constant(&self) -> Option<Rational> {
        match self.terms.len() {
            0 => Some(Rational::new()),
            1 => self.terms.get(&Monomial::one()).cloned(),
            _ => None,
        }
    }

    /// The symbols that occur.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let powers = self.terms.keys().flat_map(|monomial| monomial.powers());
        powers.map(|(symbol, _)| symbol.clone()).collect()
    }

    /// Whether a symbol occurs.
    pub fn contains(&self, symbol: &str) -> bool {
        self.terms
            .keys()
            .any(|monomial| monomial.exponent(symbol) > 0)
    }

    /// The degree in a symbol, 0 for the zero polynomial.
    pub fn degree(&self, symbol: &str) -> u32 {
        let exponents = self.terms.keys().map(|monomial| monomial.exponent(symbol));
        exponents.max().unwrap_or(0)
    }

    /// The coefficients of the powers of one symbol, each nonzero.
    pub fn coefficients(&self, symbol: &str) -> BTreeMap<u32, Polynomial> {
        let mut parts: BTreeMap<u32, Polynomial> = BTreeMap::new();
        for (monomial, coefficient) in &self.terms {
            let (exponent, rest) = monomial.split(symbol);
            let part = parts.entry(exponent).or_default();
            part.terms.insert(rest, coefficient.clone());
        }
        parts
    }

    /// Adds one term in place.
    pub fn add_term(&mut self, monomial: Monomial, coefficient: Rational) {
        if coefficient == 0 {
            return;
        }
        match self.terms.entry(monomial) {
            std::collections::btree_map::Entry::Vacant(place) => {
                place.insert(coefficient);
            }
            std::collections::btree_map::Entry::Occupied(mut place) => {
                *place.get_mut() += coefficient;
                if *place.get() == 0 {
                    place.remove();
                }
            }
        }
    }

    /// The sum.
    pub fn add(&self, other: &Polynomial) -> Polynomial {
        let mut sum = self.clone();
        for (monomial, coefficient) in &other.terms {
            sum.add_term(monomial.clone(), coefficient.clone());
        }
        sum
    }

    /// The negative.
    pub fn neg(&self) -> Polynomial {
        self.scale(&Rational::from(-1))
    }

    /// The difference.
    pub fn sub(&self, other: &Polynomial) -> Polynomial {
        self.add(&other.neg())
    }

    /// The product with a constant.
    pub fn scale(&self, factor: &Rational) -> Polynomial {
        if *factor == 0 {
            return Polynomial::zero();
        }
        let terms = self.terms.iter();
        let terms =
            terms.map(|(monomial, value)| (monomial.clone(), Rational::from(value * factor)));
        Polynomial {
            terms: terms.collect(),
        }
    }

    /// The product with a monomial.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] when an exponent overflows.
    pub fn shift(&self, by: &Monomial) -> Result<Polynomial, AlgebraError> {
        let mut terms = BTreeMap::new();
        for (monomial, value) in &self.terms {
            terms.insert(monomial.mul(by)?, value.clone());
        }
        Ok(Polynomial { terms })
    }

    fn words(&self) -> u64 {
        let words = self
            .terms
            .values()
            .map(|value| 1 + u64::from(bits(value)) / 64);
        words.sum()
    }

    /// The product.
    ///
    /// # Errors
    /// The budget is spent, or the result is too large.
    pub fn mul(&self, other: &Polynomial, budget: &Budget) -> Result<Polynomial, AlgebraError> {
        budget.spend(self.words().saturating_mul(other.words()))?;
        let largest = |p: &Polynomial| p.terms.values().map(bits).max().unwrap_or(0);
        if largest(self).saturating_add(largest(other)) > MAX_BITS {
            return Err(AlgebraError::TooLarge);
        }
        let mut product = Polynomial::zero();
        for (left, a) in &self.terms {
            for (right, b) in &other.terms {
                product.add_term(left.mul(right)?, Rational::from(a * b));
            }
        }
        Ok(product)
    }

    /// A power.
    ///
    /// # Errors
    /// As for [`Polynomial::mul`].
    pub fn pow(&self, exponent: u32, budget: &Budget) -> Result<Polynomial, AlgebraError> {
        let mut power = Polynomial::one();
        for bit in (0..u32::BITS - exponent.leading_zeros()).rev() {
            power = power.mul(&power, budget)?;
            if exponent >> bit & 1 == 1 {
                power = power.mul(self, budget)?;
            }
        }
        Ok(power)
    }

    /// The exact quotient, or nothing when the division leaves a remainder.
    ///
    /// # Errors
    /// The budget is spent.
    pub fn div_exact(
        &self,
        divisor: &Polynomial,
        budget: &Budget,
    ) -> Result<Option<Polynomial>, AlgebraError> {
        let Some((lead, head)) = divisor.terms.last_key_value() else {
            return Err(AlgebraError::DivisionByZero);
        };
        let (mut rest, mut quotient) = (self.clone(), Polynomial::zero());
        // The leading monomial of `rest` falls in every turn, and the order is a well-order.
        while let Some((monomial, value)) = rest.terms.last_key_value() {
            let Some(monomial) = monomial.div(lead) else {
                return Ok(None);
            };
            let value = Rational::from(value / head);
            budget.spend(
                divisor
                    .words()
                    .saturating_mul(1 + u64::from(bits(&value)) / 64),
            )?;
            for (factor, coefficient) in &divisor.terms {
                rest.add_term(monomial.mul(factor)?, -Rational::from(&value * coefficient));
            }
            quotient.add_term(monomial, value);
        }
        Ok(Some(quotient))
    }

    /// The largest monomial that divides every term (1 for the zero polynomial).
    pub fn monomial_content(&self) -> Monomial {
        let mut terms = self.terms.keys();
        let first = terms.next().cloned().unwrap_or_default();
        terms.fold(first, |common, monomial| common.common(monomial))
    }

    /// Splits into `content * primitive`, the primitive part with coprime integer coefficients and
    /// a positive leading one. The content of 0 is 0.
    pub fn primitive(&self) -> (Rational, Polynomial) {
        let Some((_, lead)) = self.terms.last_key_value() else {
            return (Rational::new(), Polynomial::one());
        };
        let (mut numerators, mut denominators) = (Integer::new(), Integer::from(1));
        for value in self.terms.values() {
            numerators.gcd_mut(value.numer());
            denominators.lcm_mut(value.denom());
        }
        let mut content = Rational::from((numerators, denominators));
        if *lead < 0 {
            content = -content;
        }
        let inverse = Rational::from(content.recip_ref());
        (content, self.scale(&inverse))
    }

    /// The polynomial with one symbol replaced.
    ///
    /// # Errors
    /// As for [`Polynomial::mul`].
    pub fn substitute(
        &self,
        symbol: &str,
        value: &Polynomial,
        budget: &Budget,
    ) -> Result<Polynomial, AlgebraError> {
        if !self.contains(symbol) {
            return Ok(self.clone());
        }
        // Horner's rule over the powers that occur, highest first.
        let (mut sum, mut at) = (Polynomial::zero(), None);
        for (exponent, part) in self.coefficients(symbol).into_iter().rev() {
            if let Some(above) = at {
                sum = sum.mul(&value.pow(above - exponent, budget)?, budget)?;
            }
            sum = sum.add(&part);
            at = Some(exponent);
        }
        match at {
            Some(lowest) if lowest > 0 => sum.mul(&value.pow(lowest, budget)?, budget),
            _ => Ok(sum),
        }
    }

    /// The polynomial with some symbols given values.
    ///
    /// # Errors
    /// As for [`Polynomial::mul`].
    pub fn evaluate(
        &self,
        values: &BTreeMap<Symbol, Rational>,
        budget: &Budget,
    ) -> Result<Polynomial, AlgebraError> {
        let mut result = self.clone();
        for (symbol, value) in values {
            result = result.substitute(symbol, &Polynomial::constant(value.clone()), budget)?;
        }
        Ok(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn small() -> impl Strategy<Value = Polynomial> {
        let term = (0u32..3, 0u32..3, -4i64..5, 1i64..4);
        proptest::collection::vec(term, 0..5).prop_map(|terms| {
            let (x, y): (Symbol, Symbol) = ("x".into(), "y".into());
            let mut sum = Polynomial::zero();
            for (i, j, p, q) in terms {
                let monomial = Monomial::power(&x, i).mul(&Monomial::power(&y, j));
                sum.add_term(monomial.expect("small"), Rational::from((p, q)));
            }
            sum
        })
    }

    proptest! {
        #[test]
        fn ring_laws(a in small(), b in small(), c in small()) {
            let budget = Budget::new(1 << 30);
            let mul = |p: &Polynomial, q: &Polynomial| p.mul(q, &budget).expect("small");
            prop_assert_eq!(mul(&a, &b), mul(&b, &a));
            prop_assert_eq!(mul(&a, &mul(&b, &c)), mul(&mul(&a, &b), &c));
            prop_assert_eq!(mul(&a, &b.add(&c)), mul(&a, &b).add(&mul(&a, &c)));
            prop_assert!(a.sub(&a).is_zero());
            prop_assert_eq!(a.pow(3, &budget).expect("small"), mul(&a, &mul(&a, &a)));
        }

        #[test]
        fn exact_division_inverts_multiplication(a in small(), b in small()) {
            prop_assume!(!b.is_zero());
            let budget = Budget::new(1 << 30);
            let product = a.mul(&b, &budget).expect("small");
            prop_assert_eq!(product.div_exact(&b, &budget).expect("small"), Some(a));
        }

        #[test]
        fn substitution_is_evaluation(a in small(), p in -5i64..6, q in -5i64..6) {
            let budget = Budget::new(1 << 30);
            let values = BTreeMap::from([("x".into(), Rational::from(p)), ("y".into(), Rational::from(q))]);
            let value = a.evaluate(&values, &budget).expect("small").as_constant().expect("closed");
            let mut direct = Rational::new();
            for (monomial, coefficient) in a.terms() {
                let mut term = coefficient.clone();
                for _ in 0..monomial.exponent("x") { term *= p; }
                for _ in 0..monomial.exponent("y") { term *= q; }
                direct += term;
            }
            prop_assert_eq!(value, direct);
        }
    }

    #[test]
    fn a_remainder_is_seen() {
        let budget = Budget::new(1000);
        let x = Polynomial::symbol(&"x".into());
        let shifted = x.add(&Polynomial::one());
        assert_eq!(x.div_exact(&shifted, &budget), Ok(None));
    }

    #[test]
    fn a_power_stops_at_the_budget() {
        let budget = Budget::new(100_000);
        let two = Polynomial::integer(2);
        assert!(two.pow(u32::MAX, &budget).is_err());
    }
}
