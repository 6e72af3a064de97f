//! What the search for order builds its sums from.

use super::builder::Builder;
use super::form::{integer, power};
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

    /// The relations between these indeterminates.
    pub(super) fn generators(
        &self,
        symbols: &BTreeSet<Symbol>,
        atoms: &[Generator],
    ) -> Vec<Generator> {
        let field = self.field.borrow();
        let mut all: Vec<Generator> = atoms.to_vec();
        for relation in self.relations() {
            let Some(polynomial) = relation.difference.as_polynomial() else {
                continue;
            };
            let strict = matches!(relation.fact, Fact::Less(..));
            let wanted = !relation.derived
                && !matches!(relation.fact, Fact::Different(..))
                && polynomial.as_constant().is_none()
                && polynomial.symbols().is_subset(symbols);
            if !wanted {
                continue;
            }
            match all.iter_mut().find(|other| other.polynomial == *polynomial) {
                Some(other) => other.strict |= strict,
                None => all.push(Generator {
                    written: field.write_polynomial(polynomial),
                    polynomial: polynomial.clone(),
                    strict,
                }),
            }
        }
        all
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
