//! Products of powers of symbols.

use crate::number::Interval;
use rug::{Integer, Rational};
use std::collections::BTreeMap;

/// A positive real number other than 1 that a monomial is made of.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Symbol {
    /// The square root of pi; integer exponents.
    SqrtPi,
    /// A positive rational power of an integer >= 2, its exponent strictly between 0 and 1.
    Root(Integer),
    /// The natural logarithm of an integer >= 2; integer exponents.
    Ln(Integer),
}

/// A product of powers of symbols, a positive real number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Monomial {
    /// No exponent is 0.
    powers: BTreeMap<Symbol, Rational>,
}

impl Monomial {
    pub(super) fn one() -> Monomial {
        Monomial {
            powers: BTreeMap::new(),
        }
    }

    pub(super) fn power(symbol: Symbol, exponent: Rational) -> Monomial {
        let mut monomial = Monomial::one();
        monomial.multiply(symbol, &exponent);
        monomial
    }

    pub(super) fn is_one(&self) -> bool {
        self.powers.is_empty()
    }

    pub(super) fn powers(&self) -> impl Iterator<Item = (&Symbol, &Rational)> {
        self.powers.iter()
    }

    pub(super) fn exponent(&self, symbol: &Symbol) -> Rational {
        self.powers.get(symbol).cloned().unwrap_or_default()
    }

    /// Multiplies by a power of `SqrtPi` or `Ln`.
    pub(super) fn multiply(&mut self, symbol: Symbol, exponent: &Rational) {
        let entry = self.powers.entry(symbol.clone()).or_default();
        *entry += exponent;
        if entry.cmp0().is_eq() {
            self.powers.remove(&symbol);
        }
    }

    /// Multiplies by `radicand^exponent`: the whole part of the exponent goes into the coefficient.
    /// The whole part is small, since exponents of factors lie between -1 and 1.
    pub(super) fn multiply_root(
        &mut self,
        radicand: &Integer,
        exponent: &Rational,
        coefficient: &mut Rational,
    ) {
        if *radicand == 1 {
            return;
        }
        let symbol = Symbol::Root(radicand.clone());
        let total = self.exponent(&symbol) + exponent;
        let (fraction, whole) = total.fract_floor(Integer::new());
        let whole = whole.to_i32().unwrap_or(0);
        *coefficient *= rug::ops::Pow::pow(Rational::from(radicand.clone()), whole);
        if fraction.cmp0().is_eq() {
            self.powers.remove(&symbol);
        } else {
            self.powers.insert(symbol, fraction);
        }
    }

    /// The product; whole powers of radicands go into the coefficient.
    pub(super) fn times(&self, other: &Monomial, coefficient: &mut Rational) -> Monomial {
        let mut product = self.clone();
        for (symbol, exponent) in &other.powers {
            match symbol {
                Symbol::Root(radicand) => {
                    product.multiply_root(radicand, exponent, coefficient);
                }
                _ => product.multiply(symbol.clone(), exponent),
            }
        }
        product
    }

    /// The inverse; whole powers of radicands go into the coefficient.
    pub(super) fn inverse(&self, coefficient: &mut Rational) -> Monomial {
        let mut inverse = Monomial::one();
        for (symbol, exponent) in &self.powers {
            let negative = Rational::from(-exponent);
            match symbol {
                Symbol::Root(radicand) => {
                    inverse.multiply_root(radicand, &negative, coefficient);
                }
                _ => inverse.multiply(symbol.clone(), &negative),
            }
        }
        inverse
    }

    /// An interval that holds the value.
    pub(super) fn enclose(&self, precision: u32) -> Interval {
        let mut product = Interval::from_i64(1, precision);
        for (symbol, exponent) in &self.powers {
            product = product.mul(&symbol.enclose_power(exponent, precision));
        }
        product
    }
}

impl Symbol {
    fn enclose_power(&self, exponent: &Rational, precision: u32) -> Interval {
        let whole_line = |_| Interval::whole_line(precision);
        let base = match self {
            Symbol::Root(radicand) => Ok(Interval::from_integer(radicand, precision)),
            Symbol::SqrtPi => Interval::pi(precision).sqrt(),
            Symbol::Ln(integer) => Interval::from_integer(integer, precision).ln(),
        };
        let power = base.and_then(|base| base.pow_rational(exponent));
        power.unwrap_or_else(whole_line)
    }
}
