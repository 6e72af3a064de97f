//! What the search for order builds its sums from.

use super::builder::{Builder, Relation};
use super::form::{integer, minus, power, times};
use super::handelman::Generator;
use super::known::Sign;
use crate::algebra::{Polynomial, Symbol};
use crate::formula::Formula;
use crate::kernel::proof::Fact;
use std::collections::BTreeSet;

impl Builder<'_> {
    /// The indeterminates that relations join with these.
    pub(super) fn reach(&self, mut symbols: BTreeSet<Symbol>) -> BTreeSet<Symbol> {
        loop {
            let before = symbols.len();
            for relation in self.relations().filter(|relation| !relation.derived) {
                let own = relation.difference.symbols();
                if !own.is_disjoint(&symbols) {
                    symbols.extend(own);
                }
            }
            if symbols.len() == before {
                return symbols;
            }
        }
    }

    /// The relations between these indeterminates, without their denominators.
    pub(super) fn generators(
        &mut self,
        symbols: &BTreeSet<Symbol>,
        atoms: &[Generator],
    ) -> Vec<Generator> {
        let relations: Vec<Relation> = self
            .relations()
            .filter(|relation| {
                !relation.derived
                    && !matches!(relation.fact, Fact::Different(..))
                    && relation.difference.as_constant().is_none()
                    && relation.difference.symbols().is_subset(symbols)
            })
            .cloned()
            .collect();
        let mut all: Vec<Generator> = atoms.to_vec();
        for relation in relations {
            let Some(new) = self.cleared(&relation) else {
                continue;
            };
            match all.iter_mut().find(|old| old.polynomial == new.polynomial) {
                Some(old) => old.strict |= new.strict,
                None => all.push(new),
            }
        }
        all
    }

    /// What the relations between these indeterminates are divided by.
    pub(super) fn denominators(&self, symbols: &BTreeSet<Symbol>) -> BTreeSet<Polynomial> {
        let relations = self.relations().filter(|relation| {
            !relation.derived && relation.difference.symbols().is_subset(symbols)
        });
        relations
            .flat_map(|relation| relation.difference.denominator().keys().cloned())
            .collect()
    }

    /// A relation times its denominator, which must be positive.
    fn cleared(&mut self, relation: &Relation) -> Option<Generator> {
        let strict = matches!(relation.fact, Fact::Less(..));
        let polynomial = relation.difference.numerator().clone();
        if relation.difference.as_polynomial().is_some() {
            let written = self.field.borrow().write_polynomial(&polynomial);
            return Some(Generator {
                polynomial,
                written,
                strict,
            });
        }
        let (Fact::Less(a, b) | Fact::AtMost(a, b)) = &relation.fact else {
            return None;
        };
        let mut written = minus(b.clone(), a.clone());
        for (factor, exponent) in relation.difference.denominator() {
            let factor = self.field.borrow().write_polynomial(factor);
            self.signed(&factor, Sign::Positive)?;
            written = match exponent {
                1 => times(written, factor),
                _ => times(written, power(factor, integer(i64::from(*exponent)))),
            };
        }
        Some(Generator {
            polynomial,
            written,
            strict,
        })
    }

    /// The atoms of a polynomial that are no names, and squares of names in it.
    pub(super) fn atom_generators(&mut self, p: &Polynomial) -> Vec<Generator> {
        let mut all = Vec::new();
        for symbol in p.symbols() {
            let written = self.field.borrow().formula(&symbol);
            let polynomial = Polynomial::symbol(&symbol);
            if !matches!(written, Formula::Name(_)) {
                let strict = self.knows(&written, Sign::Positive)
                    || self.parts_signed(&written, Sign::Positive);
                if strict || self.knows(&written, Sign::Nonnegative) {
                    all.push(Generator {
                        polynomial,
                        written,
                        strict,
                    });
                }
            } else if p.degree(&symbol) > 1 {
                let square = polynomial.mul(&polynomial, &self.field.borrow().budget);
                if let Ok(polynomial) = square {
                    all.push(Generator {
                        polynomial,
                        written: power(written, integer(2)),
                        strict: false,
                    });
                }
            }
        }
        all
    }
}
