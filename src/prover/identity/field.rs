//! Formulas as quotients of polynomials in their atoms, as the kernel reads them.
//!
//! An atom is what rational arithmetic does not build: a name, `gamma(k)`, `x^k`, an integral. A name
//! is its own indeterminate; any other atom has one named `@` and its number.

use super::form::{integer, negate, number, over, plus, power, times};
use crate::algebra::{Monomial, Polynomial, RationalFunction, Symbol};
use crate::formula::{Budget, Formula, Operator};
use crate::number::convert::{from_rug, to_rug};
use std::collections::HashMap;

/// Steps of algebra for one proof.
const BUDGET: u64 = 50_000_000;
/// No power beyond this is expanded.
const EXPONENT_CAP: i64 = 64;

/// The atoms of a proof.
#[derive(Debug)]
pub(crate) struct Field {
    /// Each atom as it was first met.
    list: Vec<Formula>,
    /// Their indeterminates, found by the atom with its arguments in normal form.
    symbols: HashMap<Formula, Symbol>,
    pub budget: Budget,
}

impl Field {
    pub fn new() -> Field {
        Field {
            list: Vec::new(),
            symbols: HashMap::new(),
            budget: Budget::new(BUDGET),
        }
    }

    /// The normal form of a formula.
    pub fn normal(&mut self, e: &Formula) -> Option<RationalFunction> {
        let found = match e {
            Formula::Number(value) => Ok(RationalFunction::constant(to_rug(value))),
            Formula::Name(name) => Ok(RationalFunction::symbol(name)),
            Formula::Negate(a) => Ok(self.normal(a)?.neg()),
            Formula::Binary(Operator::Power, a, b) => match self.normal(b)?.as_integer() {
                Some(exponent) if exponent.abs() <= EXPONENT_CAP => {
                    self.normal(a)?.powi(exponent, &self.budget)
                }
                _ => return Some(RationalFunction::symbol(&self.atom(e)?)),
            },
            Formula::Binary(operator, a, b) => {
                let (a, b) = (self.normal(a)?, self.normal(b)?);
                match operator {
                    Operator::Add => a.add(&b, &self.budget),
                    Operator::Subtract => a.sub(&b, &self.budget),
                    Operator::Multiply => a.mul(&b, &self.budget),
                    _ => a.div(&b, &self.budget),
                }
            }
            Formula::BigO(_) | Formula::LittleO(_) | Formula::Truth(_) | Formula::Infinity => {
                return None;
            }
            _ => return Some(RationalFunction::symbol(&self.atom(e)?)),
        };
        found.ok()
    }

    /// `b - a`
    pub fn difference(&mut self, a: &Formula, b: &Formula) -> Option<RationalFunction> {
        let (a, b) = (self.normal(a)?, self.normal(b)?);
        b.sub(&a, &self.budget).ok()
    }

    /// Whether two formulas are equal as rational functions.
    pub fn same(&mut self, a: &Formula, b: &Formula) -> bool {
        self.difference(a, b).is_some_and(|d| d.is_zero())
    }

    /// The indeterminate of an atom.
    pub fn atom(&mut self, e: &Formula) -> Option<Symbol> {
        let key = match e {
            Formula::Factorial(a) => Formula::Factorial(Box::new(self.key(a)?)),
            Formula::Binary(operator, a, b) => {
                Formula::binary(*operator, self.key(a)?, self.key(b)?)
            }
            Formula::Call(function, parts) => Formula::Call(*function, self.keys(parts)?),
            Formula::Apply(name, parts) => Formula::Apply(name.clone(), self.keys(parts)?),
            _ => e.clone(),
        };
        if let Some(symbol) = self.symbols.get(&key) {
            return Some(symbol.clone());
        }
        let symbol: Symbol = format!("@{}", self.list.len()).into();
        self.list.push(e.clone());
        self.symbols.insert(key, symbol.clone());
        Some(symbol)
    }

    fn keys(&mut self, parts: &[Formula]) -> Option<Vec<Formula>> {
        parts.iter().map(|part| self.key(part)).collect()
    }

    /// The same formula for all that are equal as rational functions.
    fn key(&mut self, e: &Formula) -> Option<Formula> {
        let normal = self.normal(e)?;
        Some(self.write(&normal))
    }

    /// The formula of an indeterminate.
    pub fn formula(&self, symbol: &Symbol) -> Formula {
        let number = symbol.strip_prefix('@').and_then(|n| n.parse().ok());
        let atom = number.and_then(|n: usize| self.list.get(n));
        atom.cloned()
            .unwrap_or_else(|| Formula::Name(symbol.clone()))
    }

    /// A formula for a rational function.
    pub fn write(&self, function: &RationalFunction) -> Formula {
        let above = self.write_polynomial(function.numerator());
        let factors = function.denominator().iter();
        let below = factors.map(|(factor, e)| raised(self.write_polynomial(factor), *e));
        match below.reduce(times) {
            Some(below) => over(above, below),
            None => above,
        }
    }

    /// A formula for a polynomial, the highest terms first, but none with a minus if there are
    /// others.
    pub fn write_polynomial(&self, polynomial: &Polynomial) -> Formula {
        let mut sum: Option<Formula> = None;
        let mut terms: Vec<_> = polynomial.terms().rev().collect();
        if let Some(at) = terms.iter().position(|(_, c)| **c > 0) {
            terms[..=at].rotate_right(1);
        }
        for (monomial, coefficient) in terms {
            let negative = *coefficient < 0;
            let size = coefficient.clone().abs();
            let term = self.write_term(monomial, &size);
            sum = Some(match (sum, negative) {
                (None, false) => term,
                (None, true) => negate(term),
                (Some(sum), false) => plus(sum, term),
                (Some(sum), true) => super::form::minus(sum, term),
            });
        }
        sum.unwrap_or_else(|| integer(0))
    }

    fn write_term(&self, monomial: &Monomial, coefficient: &rug::Rational) -> Formula {
        let powers = monomial.powers().iter();
        let factors = powers.map(|(symbol, e)| raised(self.formula(symbol), *e));
        let product = factors.reduce(times);
        let coefficient = from_rug(coefficient);
        match product {
            None => number(&coefficient),
            Some(product) if coefficient == crate::formula::Rational::from_integer(1.into()) => {
                product
            }
            Some(product) => times(number(&coefficient), product),
        }
    }
}

fn raised(base: Formula, exponent: u32) -> Formula {
    match exponent {
        1 => base,
        _ => power(base, integer(exponent.into())),
    }
}
