//! The search for order: makes known what a step needs to know of the signs of formulas.
//!
//! A sign is looked for by structure first, part by part. What then is left is a rational function:
//! its polynomials are written as sums of products of relations in sight, and that sum is the
//! argument by which the rule `order` sees the sign.

use super::builder::Builder;
use super::form::{integer, negate, number, over, power, times};
use super::handelman::{Generator, degree, show};
use super::known::{Sign, is_even};
use crate::algebra::{Polynomial, RationalFunction, Symbol};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule};
use crate::number::convert::from_rug;
use std::collections::BTreeSet;

/// Factors of one product of relations.
const FACTORS: usize = 3;

impl Builder<'_> {
    /// Makes it known that a finite formula is greater than 0.
    pub fn positive(&mut self, e: &Formula) -> Option<()> {
        self.signed(e, Sign::Positive)
    }

    /// Makes it known that a finite formula is at least 0.
    pub fn nonnegative(&mut self, e: &Formula) -> Option<()> {
        self.signed(e, Sign::Nonnegative)
    }

    /// Makes it known that a finite formula is not 0.
    pub fn nonzero(&mut self, e: &Formula) -> Option<()> {
        self.signed(e, Sign::Nonzero)
    }

    /// Makes the sign of a finite formula known.
    pub(super) fn signed(&mut self, e: &Formula, sign: Sign) -> Option<()> {
        if self.knows(e, sign) || self.parts_signed(e, sign) {
            return Some(());
        }
        let normal = self.field.borrow_mut().normal(e)?;
        self.finite(e)?;
        let zero = integer(0);
        match sign {
            Sign::Positive => {
                let shown = self.show_function(&normal, sign)?;
                let fact = Fact::Less(zero, e.clone());
                self.step(fact, Rule::Order, &[], &[shown])?;
            }
            Sign::Nonnegative => {
                let shown = self.show_function(&normal, sign)?;
                let fact = Fact::AtMost(zero, e.clone());
                self.step(fact, Rule::Order, &[], &[shown])?;
            }
            Sign::Nonzero => self.show_nonzero(e, &normal)?,
        }
        Some(())
    }

    /// The signs of the parts of a product, a quotient, a power or a function say enough.
    fn parts_signed(&mut self, e: &Formula, sign: Sign) -> bool {
        match e {
            Formula::Negate(a) => sign == Sign::Nonzero && self.signed(a, sign).is_some(),
            Formula::Binary(Operator::Multiply | Operator::Divide, a, b) => {
                self.signed(a, sign).is_some() && self.signed(b, sign).is_some()
            }
            Formula::Binary(Operator::Power, a, b) => {
                self.signed(a, sign).is_some()
                    || (sign == Sign::Positive && is_even(b) && self.nonzero(a).is_some())
            }
            Formula::Call(Function::Gamma | Function::Sqrt, parts) => {
                parts.first().is_some_and(|a| self.positive(a).is_some())
            }
            _ => false,
        }
    }

    /// `0 < e`, `e < 0`, or `e != 0` factor by factor.
    fn show_nonzero(&mut self, e: &Formula, normal: &RationalFunction) -> Option<()> {
        let zero = integer(0);
        if let Some(shown) = self.show_function(normal, Sign::Positive) {
            let fact = Fact::Less(zero, e.clone());
            return self.step(fact, Rule::Order, &[], &[shown]).map(|_| ());
        }
        if let Some(shown) = self.show_function(&normal.neg(), Sign::Positive) {
            let fact = Fact::Less(e.clone(), zero);
            return self.step(fact, Rule::Order, &[], &[shown]).map(|_| ());
        }
        let (content, factors) = {
            let field = self.field.borrow();
            normal.factored(&field.budget).ok()?
        };
        if factors.len() < 2 && factors.values().all(|exponent| exponent.abs() == 1) {
            return None;
        }
        let mut shown = number(&from_rug(&content));
        for (factor, exponent) in factors {
            let written = self.field.borrow().write_polynomial(&factor);
            self.nonzero(&written)?;
            shown = times(shown, power(written, integer(exponent)));
        }
        let fact = Fact::Different(e.clone(), zero);
        self.step(fact, Rule::Order, &[], &[negate(shown)])
            .map(|_| ())
    }

    /// A rational function written so that its sign is seen.
    fn show_function(&mut self, normal: &RationalFunction, sign: Sign) -> Option<Formula> {
        let mut numerator = normal.numerator().clone();
        let mut below: Option<Formula> = None;
        for (factor, exponent) in normal.denominator() {
            let shown = match self.show_polynomial(factor, true) {
                Some(shown) => shown,
                None => {
                    let shown = self.show_polynomial(&factor.neg(), true)?;
                    if exponent % 2 == 1 {
                        numerator = numerator.neg();
                    }
                    shown
                }
            };
            let shown = match exponent {
                1 => shown,
                _ => power(shown, integer(i64::from(*exponent))),
            };
            below = Some(match below {
                None => shown,
                Some(below) => times(below, shown),
            });
        }
        let above = self.show_polynomial(&numerator, sign == Sign::Positive)?;
        Some(match below {
            None => above,
            Some(below) => over(above, below),
        })
    }

    /// A polynomial written so that it is seen to be positive (nonnegative, where not strict).
    fn show_polynomial(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        if let Some(value) = p.as_constant() {
            let fits = value > 0 || (value == 0 && !strict);
            return fits.then(|| number(&from_rug(&value)));
        }
        self.show_related(p, strict)
            .or_else(|| self.show_monomial(p, strict))
            .or_else(|| self.show_divided(p, strict))
            .or_else(|| self.show_sum(p, strict))
    }

    /// By a relation in sight, up to a factor.
    fn show_related(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        let (content, primitive) = p.primitive();
        let sign = match strict {
            true => Sign::Positive,
            false => Sign::Nonnegative,
        };
        let known = self.relations().find_map(|relation| {
            let difference = relation.difference.as_polynomial()?;
            let (other, same) = difference.primitive();
            let factor = rug::Rational::from(&content / &other);
            let fits = same == primitive && factor > 0 && sign.given_by(&relation.fact);
            fits.then(|| (factor, difference.clone()))
        });
        let (factor, difference) = known?;
        let written = self.field.borrow().write_polynomial(&difference);
        Some(match factor == 1 {
            true => written,
            false => times(number(&from_rug(&factor)), written),
        })
    }

    /// The signs of the indeterminates that divide it, and of the rest.
    fn show_monomial(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        let content = p.monomial_content();
        if content.is_one() || (p.len() == 1 && degree(p) == 1) {
            return None;
        }
        let mut rest = {
            let field = self.field.borrow();
            let monomial = Polynomial::term(content.clone(), rug::Rational::from(1));
            p.div_exact(&monomial, &field.budget).ok()??
        };
        let mut shown: Option<Formula> = None;
        for (symbol, exponent) in content.powers() {
            let (base, negative) = self.show_symbol(symbol, strict, exponent % 2 == 0)?;
            if negative && exponent % 2 == 1 {
                rest = rest.neg();
            }
            let factor = match exponent {
                1 => base,
                _ => power(base, integer(i64::from(*exponent))),
            };
            shown = Some(match shown {
                None => factor,
                Some(shown) => times(shown, factor),
            });
        }
        let rest = self.show_polynomial(&rest, strict)?;
        Some(match (&rest, shown) {
            (_, None) => rest,
            (Formula::Number(one), Some(shown)) if *one == num_traits::One::one() => shown,
            (_, Some(shown)) => times(shown, rest),
        })
    }

    /// An indeterminate, or its negative, as something positive or nonnegative.
    fn show_symbol(
        &mut self,
        symbol: &Symbol,
        strict: bool,
        even: bool,
    ) -> Option<(Formula, bool)> {
        let e = self.field.borrow().formula(symbol);
        let sign = match (strict, even) {
            (false, true) => return Some((e, false)),
            (true, true) => Sign::Nonzero,
            (true, false) => Sign::Positive,
            (false, false) => Sign::Nonnegative,
        };
        if self.signed(&e, sign).is_some() {
            return Some((e, false));
        }
        let opposite = negate(e);
        self.signed(&opposite, sign)?;
        Some((opposite, true))
    }

    /// By a relation in sight that divides it.
    fn show_divided(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        let differences: Vec<Polynomial> = self
            .relations()
            .filter(|relation| matches!(relation.fact, Fact::Less(..)) || !strict)
            .filter(|relation| !matches!(relation.fact, Fact::Different(..)))
            .filter_map(|relation| relation.difference.as_polynomial().cloned())
            .filter(|other| other.as_constant().is_none() && degree(other) < degree(p))
            .collect();
        for divisor in differences {
            let quotient = p.div_exact(&divisor, &self.field.borrow().budget).ok()?;
            if let Some(quotient) = quotient
                && let Some(rest) = self.show_polynomial(&quotient, strict)
            {
                let written = self.field.borrow().write_polynomial(&divisor);
                return Some(times(written, rest));
            }
        }
        None
    }

    /// As a sum of products of relations.
    fn show_sum(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        let atoms = self.atom_generators(p);
        let near = self.generators(&p.symbols(), &atoms);
        let far = self.generators(&self.reach(p.symbols()), &atoms);
        let field = self.field.clone();
        let field = field.borrow();
        let factors = usize::try_from(degree(p)).unwrap_or(FACTORS).min(FACTORS);
        (1..=factors).find_map(|factors| {
            let sum = show(p, &near, strict, factors, &field);
            sum.or_else(|| match far.len() > near.len() {
                true => show(p, &far, strict, factors, &field),
                false => None,
            })
        })
    }

    /// The indeterminates that relations join with these.
    fn reach(&self, mut symbols: BTreeSet<Symbol>) -> BTreeSet<Symbol> {
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
    fn generators(&self, symbols: &BTreeSet<Symbol>, atoms: &[Generator]) -> Vec<Generator> {
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
    fn atom_generators(&mut self, p: &Polynomial) -> Vec<Generator> {
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
