//! Formulas as rational functions of their atoms, and back: how candidates are found. What is found
//! here is believed only once the kernel has seen it.

use super::make::{add, div, int, mul, pow, sub};
use crate::algebra::{Polynomial, RationalFunction, Symbol};
use crate::formula::{Budget, Formula, Name, Operator};
use crate::number::convert::{from_rug, to_rug};
use rug::Rational;
use std::collections::{BTreeMap, HashMap};

/// Steps of algebra for one question.
const STEPS: u64 = 200_000;

/// The atoms met so far, each with a symbol; a name is its own.
#[derive(Default)]
pub(super) struct Algebra {
    symbols: HashMap<Formula, Symbol>,
    atoms: HashMap<Symbol, Formula>,
}

impl Algebra {
    /// The formula as a rational function; arguments of atoms are brought to normal form.
    pub fn read(&mut self, e: &Formula) -> Option<RationalFunction> {
        let budget = Budget::new(STEPS);
        self.rational(e, &budget)
    }

    fn rational(&mut self, e: &Formula, budget: &Budget) -> Option<RationalFunction> {
        match e {
            Formula::Number(value) => Some(RationalFunction::constant(to_rug(value))),
            Formula::Name(name) => Some(RationalFunction::symbol(name)),
            Formula::Negate(a) => Some(self.rational(a, budget)?.neg()),
            Formula::Binary(Operator::Power, a, b) => {
                let exponent = self.rational(b, budget)?;
                let base = self.rational(a, budget)?;
                match exponent.as_integer() {
                    Some(exponent) if exponent.abs() <= 50 => base.powi(exponent, budget).ok(),
                    _ => {
                        let (base, exponent) = (self.write(&base), self.write(&exponent));
                        Some(self.atom(pow(base, exponent)))
                    }
                }
            }
            Formula::Binary(operator, a, b) => {
                let (a, b) = (self.rational(a, budget)?, self.rational(b, budget)?);
                match operator {
                    Operator::Add => a.add(&b, budget),
                    Operator::Subtract => a.sub(&b, budget),
                    Operator::Multiply => a.mul(&b, budget),
                    _ => a.div(&b, budget),
                }
                .ok()
            }
            Formula::Infinity => None,
            Formula::Factorial(..) | Formula::Call(..) | Formula::Apply(..) => {
                let normal = super::make::map_parts(e, &mut |part| self.tidy(part));
                Some(self.atom(normal))
            }
            _ => Some(self.atom(e.clone())),
        }
    }

    fn atom(&mut self, atom: Formula) -> RationalFunction {
        let next = format!("#{}", self.symbols.len());
        let symbol = self.symbols.entry(atom.clone()).or_insert(next.into());
        self.atoms.insert(symbol.clone(), atom);
        RationalFunction::symbol(symbol)
    }

    /// The formula of a rational function.
    pub fn write(&self, f: &RationalFunction) -> Formula {
        let mut below = int(1);
        let mut above = f.numerator().clone();
        for (factor, exponent) in f.denominator() {
            // A denominator is written with a positive leading sign where there is a choice.
            let negative = factor.terms().next_back().is_some_and(|(_, c)| *c < 0);
            let factor = if negative {
                factor.neg()
            } else {
                factor.clone()
            };
            if negative && exponent % 2 == 1 {
                above = above.neg();
            }
            below = mul(
                below,
                pow(self.polynomial(&factor), int((*exponent).into())),
            );
        }
        div(self.polynomial(&above), below)
    }

    fn polynomial(&self, p: &Polynomial) -> Formula {
        let mut sum = int(0);
        let mut terms: Vec<_> = p.terms().rev().collect();
        // A sum begins with a term that is not negative.
        terms.sort_by_key(|(_, c)| **c < 0);
        for (monomial, coefficient) in terms {
            let mut term = int(1);
            for (symbol, exponent) in monomial.powers() {
                let atom = self.atoms.get(symbol).cloned();
                let atom = atom.unwrap_or_else(|| Formula::Name(symbol.clone()));
                term = mul(term, pow(atom, int((*exponent).into())));
            }
            let size = number(&coefficient.clone().abs());
            let term = mul(size, term);
            sum = match *coefficient < 0 {
                false => add(sum, term),
                true if super::make::is_zero(&sum) => Formula::Negate(Box::new(term)),
                true => sub(sum, term),
            };
        }
        sum
    }

    /// The formula in normal form, or itself where it has none.
    pub fn tidy(&mut self, e: &Formula) -> Formula {
        match self.read(e) {
            Some(f) => self.write(&f),
            None => e.clone(),
        }
    }

    /// The integer that the formula is by arithmetic.
    pub fn integer(&mut self, e: &Formula) -> Option<i64> {
        self.read(e)?.as_integer()
    }

    /// Whether two formulas are equal as rational functions.
    pub fn same(&mut self, a: &Formula, b: &Formula) -> bool {
        self.zero(&Formula::binary(Operator::Subtract, a.clone(), b.clone()))
    }

    /// Whether the formula is 0 as a rational function.
    pub fn zero(&mut self, e: &Formula) -> bool {
        self.read(e).is_some_and(|f| f.is_zero())
    }

    /// The coefficients of the powers of a name, where the formula is a polynomial in it.
    pub fn in_powers(&mut self, e: &Formula, x: &Name) -> Option<BTreeMap<u32, Formula>> {
        let f = self.read(e)?;
        if f.denominator().keys().any(|factor| self.holds(factor, x)) {
            return None;
        }
        let mut below = int(1);
        for (factor, exponent) in f.denominator() {
            below = mul(below, pow(self.polynomial(factor), int((*exponent).into())));
        }
        let coefficients = f.numerator().coefficients(x);
        if coefficients.values().any(|c| self.holds(c, x)) {
            return None;
        }
        let written = coefficients.into_iter();
        let written = written.map(|(j, c)| (j, div(self.polynomial(&c), below.clone())));
        Some(written.map(|(j, c)| (j, self.tidied(&c))).collect())
    }

    fn tidied(&self, e: &Formula) -> Formula {
        let mut other = Algebra::default();
        other.tidy(e)
    }

    /// The factor of a name, where the formula is a multiple of it.
    pub fn factor(&mut self, e: &Formula, x: &Name) -> Option<Formula> {
        let mut powers = self.in_powers(e, x)?;
        let only = powers.len() == 1;
        powers.remove(&1).filter(|_| only)
    }

    /// Whether the name occurs, in an atom too.
    pub fn holds(&self, p: &Polynomial, x: &Name) -> bool {
        p.symbols().iter().any(|symbol| {
            symbol == x
                || self
                    .atoms
                    .get(symbol)
                    .is_some_and(|atom| super::make::depends(atom, x))
        })
    }
}

pub(super) fn number(value: &Rational) -> Formula {
    let q = from_rug(value);
    let (above, below) = (q.numer().clone(), q.denom().clone());
    let whole = |n| Formula::Number(crate::formula::Rational::from_integer(n));
    div(whole(above), whole(below))
}
