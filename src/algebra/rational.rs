//! Rational functions: a numerator over a product of powers of primitive polynomials ("atoms").
//!
//! No greatest common divisor is computed. A sum is reduced by trying to divide its numerator by
//! the atoms of its denominator, which is all that shortness needs; equality needs nothing, since
//! the function is zero exactly when its numerator is.

use super::{AlgebraError, Monomial, Polynomial, Symbol};
use crate::formula::{Budget, Formula, Operator};
use crate::number::convert::to_rug;
use rug::Rational;
use std::collections::{BTreeMap, BTreeSet};

/// A quotient of polynomials, as a formal object: whether the denominator vanishes at a point is for
/// the caller to ask.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RationalFunction {
    numerator: Polynomial,
    /// Primitive, not constant, without monomial factors unless a lone symbol.
    denominator: BTreeMap<Polynomial, u32>,
}

type Atoms = BTreeMap<Polynomial, u32>;

impl From<Polynomial> for RationalFunction {
    fn from(numerator: Polynomial) -> RationalFunction {
        RationalFunction {
            numerator,
            denominator: Atoms::new(),
        }
    }
}

impl RationalFunction {
    /// 0
    pub fn zero() -> RationalFunction {
        Polynomial::zero().into()
    }

    /// 1
    pub fn one() -> RationalFunction {
        Polynomial::one().into()
    }

    /// A constant integer.
    pub fn integer(value: i64) -> RationalFunction {
        Polynomial::integer(value).into()
    }

    /// A constant.
    pub fn constant(value: Rational) -> RationalFunction {
        Polynomial::constant(value).into()
    }

    /// An indeterminate.
    pub fn symbol(symbol: &Symbol) -> RationalFunction {
        Polynomial::symbol(symbol).into()
    }

    /// A formula of field operations and integer powers on names and pi; `None` for any other.
    ///
    /// # Errors
    /// [`AlgebraError`], a division by 0 among them.
    pub fn from_formula(formula: &Formula, budget: &Budget) -> Result<Option<Self>, AlgebraError> {
        budget.spend(1)?;
        let inner = |formula: &Formula| Self::from_formula(formula, budget);
        Ok(match formula {
            Formula::Number(value) => Some(Self::constant(to_rug(value))),
            Formula::Pi => Some(Self::symbol(&"pi".into())),
            Formula::Name(name) => Some(Self::symbol(name)),
            Formula::Negate(value) => inner(value)?.map(|value| value.neg()),
            Formula::Binary(operator, left, right) => {
                let (Some(left), Some(right)) = (inner(left)?, inner(right)?) else {
                    return Ok(None);
                };
                match operator {
                    Operator::Add => Some(left.add(&right, budget)?),
                    Operator::Subtract => Some(left.sub(&right, budget)?),
                    Operator::Multiply => Some(left.mul(&right, budget)?),
                    Operator::Divide => Some(left.div(&right, budget)?),
                    Operator::Power => match right.as_integer() {
                        Some(exponent) => Some(left.powi(exponent, budget)?),
                        None => None,
                    },
                }
            }
            _ => None,
        })
    }

    /// The numerator.
    pub fn numerator(&self) -> &Polynomial {
        &self.numerator
    }

    /// The factors of the denominator with their exponents.
    pub fn denominator(&self) -> &BTreeMap<Polynomial, u32> {
        &self.denominator
    }

    /// Whether this is identically zero.
    pub fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }

    /// The value of a constant.
    pub fn as_constant(&self) -> Option<Rational> {
        match self.denominator.is_empty() {
            true => self.numerator.as_constant(),
            false => None,
        }
    }

    /// The value of a constant integer that fits.
    pub fn as_integer(&self) -> Option<i64> {
        let value = self.as_constant()?;
        match value.is_integer() {
            true => value.numer().to_i64(),
            false => None,
        }
    }

    /// The polynomial, where there is no denominator.
    pub fn as_polynomial(&self) -> Option<&Polynomial> {
        self.denominator.is_empty().then_some(&self.numerator)
    }

    /// The symbols that occur.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let below = self.denominator.keys().flat_map(Polynomial::symbols);
        self.numerator.symbols().into_iter().chain(below).collect()
    }

    /// Whether a symbol occurs.
    pub fn contains(&self, symbol: &str) -> bool {
        self.numerator.contains(symbol) || self.denominator.keys().any(|atom| atom.contains(symbol))
    }

    /// The sum.
    ///
    /// # Errors
    /// The budget is spent, or the result is too large; so for all operations below.
    pub fn add(&self, other: &Self, budget: &Budget) -> Result<Self, AlgebraError> {
        if self.is_zero() {
            return Ok(other.clone());
        }
        let mut common = self.denominator.clone();
        for (atom, exponent) in &other.denominator {
            let place = common.entry(atom.clone()).or_default();
            *place = (*place).max(*exponent);
        }
        let left = self.over(&common, budget)?;
        let right = other.over(&common, budget)?;
        RationalFunction {
            numerator: left.add(&right),
            denominator: common,
        }
        .reduce(budget)
    }

    /// The numerator over a multiple of the denominator.
    fn over(&self, common: &Atoms, budget: &Budget) -> Result<Polynomial, AlgebraError> {
        let mut numerator = self.numerator.clone();
        for (atom, exponent) in common {
            let missing = exponent
                - self
                    .denominator
                    .get(atom)
                    .copied()
                    .unwrap_or(0)
                    .min(*exponent);
            numerator = numerator.mul(&atom.pow(missing, budget)?, budget)?;
        }
        Ok(numerator)
    }

    fn reduce(mut self, budget: &Budget) -> Result<Self, AlgebraError> {
        if self.numerator.is_zero() {
            return Ok(RationalFunction::zero());
        }
        for (atom, exponent) in &mut self.denominator {
            while *exponent > 0 {
                let Some(quotient) = self.numerator.div_exact(atom, budget)? else {
                    break;
                };
                self.numerator = quotient;
                *exponent -= 1;
            }
        }
        self.denominator.retain(|_, exponent| *exponent > 0);
        Ok(self)
    }

    /// The negative.
    pub fn neg(&self) -> Self {
        RationalFunction {
            numerator: self.numerator.neg(),
            denominator: self.denominator.clone(),
        }
    }

    /// The difference.
    ///
    /// # Errors
    /// As for [`RationalFunction::add`].
    pub fn sub(&self, other: &Self, budget: &Budget) -> Result<Self, AlgebraError> {
        self.add(&other.neg(), budget)
    }

    /// The product.
    ///
    /// # Errors
    /// As for [`RationalFunction::add`].
    pub fn mul(&self, other: &Self, budget: &Budget) -> Result<Self, AlgebraError> {
        let numerator = self.numerator.mul(&other.numerator, budget)?;
        let mut denominator = self.denominator.clone();
        for (atom, exponent) in &other.denominator {
            insert(&mut denominator, atom.clone(), *exponent, budget)?;
        }
        RationalFunction {
            numerator,
            denominator,
        }
        .reduce(budget)
    }

    /// The reciprocal.
    ///
    /// # Errors
    /// [`AlgebraError::DivisionByZero`] for 0; else as for [`RationalFunction::add`].
    pub fn recip(&self, budget: &Budget) -> Result<Self, AlgebraError> {
        if self.is_zero() {
            return Err(AlgebraError::DivisionByZero);
        }
        let (content, primitive) = self.numerator.primitive();
        let mut numerator = Polynomial::constant(content.recip());
        for (atom, exponent) in &self.denominator {
            numerator = numerator.mul(&atom.pow(*exponent, budget)?, budget)?;
        }
        let mut denominator = Atoms::new();
        for (atom, exponent) in factors(primitive, budget)? {
            insert(&mut denominator, atom, exponent, budget)?;
        }
        Ok(RationalFunction {
            numerator,
            denominator,
        })
    }

    /// The quotient.
    ///
    /// # Errors
    /// As for [`RationalFunction::recip`].
    pub fn div(&self, other: &Self, budget: &Budget) -> Result<Self, AlgebraError> {
        self.mul(&other.recip(budget)?, budget)
    }

    /// An integer power.
    ///
    /// # Errors
    /// As for [`RationalFunction::recip`].
    pub fn powi(&self, exponent: i64, budget: &Budget) -> Result<Self, AlgebraError> {
        let size = u32::try_from(exponent.unsigned_abs()).map_err(|_| AlgebraError::TooLarge)?;
        let base = match exponent < 0 {
            true => self.recip(budget)?,
            false => self.clone(),
        };
        let mut denominator = Atoms::new();
        for (atom, count) in &base.denominator {
            let count = count.checked_mul(size).ok_or(AlgebraError::TooLarge)?;
            if count > 0 {
                denominator.insert(atom.clone(), count);
            }
        }
        Ok(RationalFunction {
            numerator: base.numerator.pow(size, budget)?,
            denominator,
        })
    }

    /// The function as `content * product of powers of primitive polynomials`; 0 has the content 0.
    /// The polynomials need not be irreducible.
    ///
    /// # Errors
    /// The budget is spent.
    pub fn factored(
        &self,
        budget: &Budget,
    ) -> Result<(Rational, BTreeMap<Polynomial, i64>), AlgebraError> {
        let (content, primitive) = self.numerator.primitive();
        let mut powers = BTreeMap::new();
        for (atom, exponent) in factors(primitive, budget)? {
            *powers.entry(atom).or_default() += i64::from(exponent);
        }
        for (atom, exponent) in &self.denominator {
            *powers.entry(atom.clone()).or_default() -= i64::from(*exponent);
        }
        powers.retain(|_, exponent| *exponent != 0);
        Ok((content, powers))
    }

    /// The function with one symbol replaced; [`AlgebraError::DivisionByZero`] when that makes the
    /// denominator identically zero.
    ///
    /// # Errors
    /// As for [`RationalFunction::recip`].
    pub fn substitute(
        &self,
        symbol: &str,
        value: &RationalFunction,
        budget: &Budget,
    ) -> Result<Self, AlgebraError> {
        if !self.contains(symbol) {
            return Ok(self.clone());
        }
        let mut result = compose(&self.numerator, symbol, value, budget)?;
        for (atom, exponent) in &self.denominator {
            let factor = compose(atom, symbol, value, budget)?;
            result = result.mul(&factor.powi(-i64::from(*exponent), budget)?, budget)?;
        }
        Ok(result)
    }

    /// The function with some symbols given values.
    ///
    /// # Errors
    /// As for [`RationalFunction::substitute`].
    pub fn evaluate(
        &self,
        values: &BTreeMap<Symbol, Rational>,
        budget: &Budget,
    ) -> Result<Self, AlgebraError> {
        let mut result: RationalFunction = self.numerator.evaluate(values, budget)?.into();
        for (atom, exponent) in &self.denominator {
            let factor: RationalFunction = atom.evaluate(values, budget)?.into();
            result = result.mul(&factor.powi(-i64::from(*exponent), budget)?, budget)?;
        }
        Ok(result)
    }
}

/// The value of a polynomial with a rational function in the place of a symbol.
fn compose(
    polynomial: &Polynomial,
    symbol: &str,
    value: &RationalFunction,
    budget: &Budget,
) -> Result<RationalFunction, AlgebraError> {
    if let Some(value) = value.as_polynomial() {
        return Ok(polynomial.substitute(symbol, value, budget)?.into());
    }
    let (mut sum, mut at) = (RationalFunction::zero(), 0);
    for (exponent, part) in polynomial.coefficients(symbol).into_iter().rev() {
        if !sum.is_zero() {
            sum = sum.mul(&value.powi(i64::from(at - exponent), budget)?, budget)?;
        }
        sum = sum.add(&part.into(), budget)?;
        at = exponent;
    }
    sum.mul(&value.powi(i64::from(at), budget)?, budget)
}

/// Adds an atom to a denominator; where an atom that is there already divides it, that is used.
fn insert(
    atoms: &mut Atoms,
    atom: Polynomial,
    exponent: u32,
    budget: &Budget,
) -> Result<(), AlgebraError> {
    let mut rest = atom;
    let known: Vec<Polynomial> = atoms.keys().cloned().collect();
    for divisor in known {
        while let Some(quotient) = rest.div_exact(&divisor, budget)? {
            let count = atoms.entry(divisor.clone()).or_default();
            *count = count.checked_add(exponent).ok_or(AlgebraError::TooLarge)?;
            rest = quotient;
        }
    }
    // Both are primitive, so by Gauss' lemma what is left of a constant is 1.
    if rest.as_constant().is_none() {
        let count = atoms.entry(rest).or_default();
        *count = count.checked_add(exponent).ok_or(AlgebraError::TooLarge)?;
    }
    Ok(())
}

/// Integer roots that are split off a polynomial in one symbol; beyond them nothing is factored.
const ROOTS: std::ops::RangeInclusive<i64> = -12..=12;

/// A primitive polynomial as a product: its monomial factor, small integer roots, and the rest.
fn factors(primitive: Polynomial, budget: &Budget) -> Result<Vec<(Polynomial, u32)>, AlgebraError> {
    let content = primitive.monomial_content();
    let powers = content.powers().iter();
    let mut found: Vec<_> = powers.map(|(s, e)| (Polynomial::symbol(s), *e)).collect();
    let monomial = Polynomial::term(content, Rational::from(1));
    let mut rest = primitive.div_exact(&monomial, budget)?.unwrap_or(primitive);
    let symbols: Vec<Symbol> = rest.symbols().into_iter().collect();
    if let ([symbol], true) = (&symbols[..], rest.len() > 1) {
        for root in ROOTS.filter(|root| *root != 0) {
            let mut linear = Polynomial::symbol(symbol);
            linear.add_term(Monomial::one(), Rational::from(-root));
            while let (true, Some(quotient)) =
                (rest.degree(symbol) > 1, rest.div_exact(&linear, budget)?)
            {
                found.push((linear.clone(), 1));
                rest = quotient;
            }
        }
    }
    if rest.as_constant().is_none() {
        found.push((rest, 1));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn budget() -> Budget {
        Budget::new(1 << 30)
    }

    fn linear(a: i64, b: i64, c: i64) -> RationalFunction {
        let term = |name: &str, value| {
            RationalFunction::symbol(&name.into()).mul(&RationalFunction::integer(value), &budget())
        };
        let sum = term("x", a).and_then(|x| x.add(&term("y", b)?, &budget()));
        sum.and_then(|s| s.add(&RationalFunction::integer(c), &budget()))
            .expect("small")
    }

    fn quotient() -> impl Strategy<Value = RationalFunction> {
        (
            (-3i64..4, -3i64..4, -3i64..4),
            (-3i64..4, -3i64..4, 1i64..4),
        )
            .prop_map(|(p, q)| {
                linear(p.0, p.1, p.2)
                    .div(&linear(q.0, q.1, q.2), &budget())
                    .expect("nonzero")
            })
    }

    proptest! {
        #[test]
        fn field_laws(a in quotient(), b in quotient(), c in quotient()) {
            let w = budget();
            let same = |p: Result<RationalFunction, AlgebraError>, q: Result<RationalFunction, AlgebraError>| {
                p.expect("small").sub(&q.expect("small"), &w).expect("small").is_zero()
            };
            prop_assert!(same(a.add(&b, &w), b.add(&a, &w)));
            prop_assert!(same(a.mul(&b.add(&c, &w).expect("small"), &w),
                a.mul(&b, &w).expect("small").add(&a.mul(&c, &w).expect("small"), &w)));
            if !a.is_zero() {
                prop_assert!(same(b.div(&a, &w).expect("small").mul(&a, &w), Ok(b.clone())));
                prop_assert!(same(a.powi(-2, &w).expect("small").mul(&a, &w), a.recip(&w)));
            }
            let swapped = a.substitute("x", &b, &w).and_then(|s| s.add(&c, &w));
            if let Ok(swapped) = swapped {
                let values = std::collections::BTreeMap::from([
                    ("x".into(), Rational::from((7, 5))), ("y".into(), Rational::from((11, 3)))]);
                let at = |f: &RationalFunction| f.evaluate(&values, &w).ok().and_then(|v| v.as_constant());
                if let (Some(x), Some(left), Some(z)) = (at(&b), at(&swapped), at(&c)) {
                    let moved = std::collections::BTreeMap::from([
                        ("x".into(), x), ("y".into(), Rational::from((11, 3)))]);
                    if let Some(y) = a.evaluate(&moved, &w).ok().and_then(|v| v.as_constant()) {
                        prop_assert_eq!(left, y + z);
                    }
                }
            }
        }
    }

    #[test]
    fn a_denominator_of_one_symbol_splits_at_small_roots() {
        let k = Polynomial::symbol(&"k".into());
        let shifted = |by| RationalFunction::from(k.add(&Polynomial::integer(by)));
        let w = budget();
        let product = shifted(-1)
            .mul(&shifted(-2), &w)
            .and_then(|p| p.mul(&shifted(0), &w));
        let inverse = product.and_then(|p| p.recip(&w)).expect("nonzero");
        assert_eq!(inverse.denominator().len(), 3);
    }
}
