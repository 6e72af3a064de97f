//! The search for order: makes known what a step needs to know of the signs of formulas.
//!
//! A sign is looked for by structure first, part by part. What then is left is a rational function:
//! its polynomials are written as sums of products of relations in sight, and that sum is the
//! argument by which the rule `order` sees the sign.

use super::atoms::Equations;
use super::builder::Builder;
use super::form::{integer, negate, number, over, power, times};
use super::handelman::{Generator, degree, show};
use super::known::{Sign, is_even};
use crate::algebra::{Polynomial, RationalFunction, Symbol};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule, Step};
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
        if self.knows(e, sign) {
            return Some(());
        }
        if self.has_failed(e, sign) {
            return None;
        }
        // What is being looked for counts as not found: a search that comes back to it ends.
        let mark = self.fail(e, sign);
        let found = self.parts_signed(e, sign) || self.show_sign(e, sign).is_some();
        if found {
            self.forget(&mark);
        }
        found.then_some(())
    }

    /// States the sign of a formula.
    fn show_sign(&mut self, e: &Formula, sign: Sign) -> Option<()> {
        self.finite(e)?;
        let normal = self.field.borrow_mut().normal(e)?;
        let found = self.show_with(e, &normal, sign, &[]);
        found.or_else(|| self.attempt(|builder| builder.show_by_atoms(e, sign)))
    }

    /// The same once powers and roots are split.
    fn show_by_atoms(&mut self, e: &Formula, sign: Sign) -> Option<()> {
        let equations = Equations::find(self, &[e], &[])?;
        let steps = equations.steps();
        if steps.is_empty() {
            return None;
        }
        let normal = self.field.borrow_mut().normal(e)?;
        let normal = equations.replaced(self, normal)?;
        self.show_with(e, &normal, sign, &steps)
    }

    /// States the sign of a formula that has this normal form by the equations.
    fn show_with(
        &mut self,
        e: &Formula,
        normal: &RationalFunction,
        sign: Sign,
        equations: &[Step],
    ) -> Option<()> {
        let zero = integer(0);
        let (fact, shown) = match sign {
            Sign::Positive => {
                let shown = self.show_function(normal, sign)?;
                (Fact::Less(zero, e.clone()), shown)
            }
            Sign::Nonnegative => {
                let shown = self.show_function(normal, sign)?;
                (Fact::AtMost(zero, e.clone()), shown)
            }
            Sign::Nonzero => self.show_nonzero(e, normal)?,
        };
        self.step(fact, Rule::Order, equations, &[shown])?;
        Some(())
    }

    /// The signs of the parts of a product, a quotient, a power or a function say enough.
    pub(super) fn parts_signed(&mut self, e: &Formula, sign: Sign) -> bool {
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

    /// `0 < e`, `e < 0`, or `e != 0` factor by factor, and by what it is shown.
    fn show_nonzero(&mut self, e: &Formula, normal: &RationalFunction) -> Option<(Fact, Formula)> {
        let zero = integer(0);
        if let Some(shown) = self.show_function(normal, Sign::Positive) {
            return Some((Fact::Less(zero, e.clone()), shown));
        }
        if let Some(shown) = self.show_function(&normal.neg(), Sign::Positive) {
            return Some((Fact::Less(e.clone(), zero), shown));
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
        Some((Fact::Different(e.clone(), zero), negate(shown)))
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
    pub(super) fn show_polynomial(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        if let Some(value) = p.as_constant() {
            let fits = value > 0 || (value == 0 && !strict);
            return fits.then(|| number(&from_rug(&value)));
        }
        self.show_related(p, strict)
            .or_else(|| self.show_monomial(p, strict))
            .or_else(|| self.show_divided(p, strict))
            .or_else(|| self.show_powers(p, strict))
            .or_else(|| self.show_sum(p, strict))
            .or_else(|| self.show_bounded(p, strict))
    }

    /// By a relation in sight, up to a factor.
    pub(super) fn show_related(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        let (content, primitive) = p.primitive();
        let sign = match strict {
            true => Sign::Positive,
            false => Sign::Nonnegative,
        };
        let known = self.relations().find_map(|relation| {
            let difference = relation.difference.as_polynomial()?;
            let (other, same) = difference.primitive();
            (other != 0).then_some(())?;
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

    /// As a sum of products of relations: of those between the indeterminates of the polynomial,
    /// then of those that lead to others.
    fn show_sum(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        let atoms = self.atom_generators(p);
        let near = self.generators(&p.symbols(), &atoms);
        if let Some(sum) = self.show_by(p, &near, strict) {
            return Some(sum);
        }
        let reached = self.reach(p.symbols());
        self.bound_powers(&reached);
        let mut atoms = atoms;
        for symbol in reached.iter().filter(|symbol| symbol.starts_with('@')) {
            if !p.contains(symbol) {
                atoms.extend(self.atom_generators(&Polynomial::symbol(symbol)));
            }
        }
        let far = self.generators(&reached, &atoms);
        if far.len() > near.len()
            && let Some(sum) = self.show_by(p, &far, strict)
        {
            return Some(sum);
        }
        self.show_multiplied(p, &reached, &far, strict)
            .or_else(|| self.show_below(p, &far, strict))
    }

    /// As a sum over a positive denominator of one of the relations.
    fn show_multiplied(
        &mut self,
        p: &Polynomial,
        reached: &BTreeSet<Symbol>,
        by: &[Generator],
        strict: bool,
    ) -> Option<Formula> {
        self.denominators(reached).into_iter().find_map(|divisor| {
            let product = p.mul(&divisor, &self.field.borrow().budget).ok()?;
            let sum = self.show_by(&product, by, strict)?;
            let written = self.field.borrow().write_polynomial(&divisor);
            self.signed(&written, Sign::Positive)?;
            Some(over(sum, written))
        })
    }

    fn show_by(&self, p: &Polynomial, by: &[Generator], strict: bool) -> Option<Formula> {
        let field = self.field.borrow();
        let factors = usize::try_from(degree(p)).unwrap_or(FACTORS).min(FACTORS);
        (1..=factors).find_map(|factors| show(p, by, strict, (factors, degree(p)), &field))
    }

    /// By relations of a higher degree than the polynomial's own, with products of two that cancel
    /// against them.
    fn show_below(&self, p: &Polynomial, by: &[Generator], strict: bool) -> Option<Formula> {
        let cap = by
            .iter()
            .map(|generator| degree(&generator.polynomial))
            .max()?;
        let higher = cap > degree(p) && cap == 2;
        higher.then(|| show(p, by, strict, (2, cap), &self.field.borrow()))?
    }
}
