//! Powers: of products and quotients, of powers, and of one base.

use super::builder::Builder;
use super::factor::Factored;
use super::form::{integer, number, over, power, times};
use super::known::Sign;
use super::make::{map_parts, parts};
use crate::algebra::{Monomial, Polynomial};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule, Step};
use crate::number::convert::from_rug;
use rug::Integer;
use std::collections::BTreeMap;

use Operator::{Divide, Multiply};

/// A power whose base is split no further.
struct Simple {
    atom: Formula,
    base: Formula,
    exponent: Polynomial,
}

impl Builder<'_> {
    /// `sqrt(a) == a^(1/2)`
    pub(super) fn root(&mut self, e: &Formula) -> Option<Step> {
        let Formula::Call(Function::Sqrt, parts) = e else {
            return None;
        };
        let half = over(integer(1), integer(2));
        let right = power(parts.first()?.clone(), half);
        self.step(Fact::Same(e.clone(), right), Rule::Power, &[], &[])
    }

    /// A power of a product, a quotient or a power; of 0 or 1.
    pub(super) fn expanded_power(
        &mut self,
        e: &Formula,
        base: &Formula,
        p: &Formula,
    ) -> Option<Step> {
        if let Some(step) = self.trivial_power(e, base, p) {
            return Some(step);
        }
        match base {
            Formula::Binary(operator @ (Multiply | Divide), a, b) => {
                self.splittable(&[a, b], &[p])?;
                if *operator == Divide {
                    self.nonzero(b)?;
                }
                let (a, b) = (
                    power((**a).clone(), p.clone()),
                    power((**b).clone(), p.clone()),
                );
                let right = Formula::binary(*operator, a, b);
                self.step(Fact::Same(e.clone(), right), Rule::Power, &[], &[])
            }
            Formula::Binary(Operator::Power, a, q) => {
                let r = self.simplified(&times((**q).clone(), p.clone()))?;
                self.splittable(&[a], &[p, q])?;
                self.finite(&r)?;
                let right = power((**a).clone(), r);
                self.step(Fact::Same(e.clone(), right), Rule::Power, &[], &[])
            }
            Formula::Call(Function::Sqrt, _) => {
                let step = self.root(base)?;
                self.rebased(e, base, p, step)
            }
            _ => {
                let product = Factored::of(self, base)?.written()?;
                let step = self.ring(base, &product, &[])?;
                self.rebased(e, base, p, step)
            }
        }
    }

    /// The formula with the powers of its powers and roots taken together, and the equation.
    pub fn without_towers(&mut self, e: &Formula) -> Option<(Formula, Step)> {
        let mut steps = Vec::new();
        let inner = map_parts(e, &mut |part| match self.without_towers(part) {
            Some((found, step)) => {
                steps.push(step);
                found
            }
            None => part.clone(),
        });
        let first = self.congruent(e, &inner, &steps)?;
        if let Formula::Binary(Operator::Power, base, p) = &inner
            && is_root(base)
            && let Some(step) = self.attempt(|b| b.expanded_power(&inner, base, p))
        {
            let found = self.right(step)?;
            return Some((found.clone(), self.chain(&[first, step], e, &found)?));
        }
        Some((inner, first))
    }

    /// The power once its base is replaced by what the step says it is.
    fn rebased(&mut self, e: &Formula, base: &Formula, p: &Formula, step: Step) -> Option<Step> {
        let new = self.right(step)?;
        let moved = power(new.clone(), p.clone());
        let there = self.congruent(&power(base.clone(), p.clone()), &moved, &[step])?;
        let next = self.expanded_power(&moved, &new, p)?;
        let right = self.right(next)?;
        self.chain(&[there, next], e, &right)
    }

    /// A power of 0 with a positive exponent, or of 1.
    fn trivial_power(&mut self, e: &Formula, base: &Formula, p: &Formula) -> Option<Step> {
        let constant = self.field.borrow_mut().normal(base)?.as_constant();
        let value = match constant {
            Some(value) if value == 0 || value == 1 => integer(i64::from(value == 1)),
            _ if !self.has_equations() => return None,
            _ => {
                self.zero(base)?;
                integer(0)
            }
        };
        if value == integer(0) {
            self.positive(p)?;
        }
        self.step(Fact::Same(e.clone(), value), Rule::Power, &[], &[])
    }

    /// Makes it known that powers of these bases with these exponents can be split.
    pub(super) fn splittable(&mut self, bases: &[&Formula], exponents: &[&Formula]) -> Option<()> {
        for exponent in exponents {
            self.finite(exponent)?;
        }
        let mut all = |forms: &[&Formula], sign: Sign| -> bool {
            forms.iter().all(|e| self.signed(e, sign).is_some())
        };
        if all(bases, Sign::Positive)
            || (all(exponents, Sign::Positive) && all(bases, Sign::Nonnegative))
        {
            return Some(());
        }
        let integers = exponents.iter().all(|e| self.is_integer(e));
        let mut all = |forms: &[&Formula], sign: Sign| -> bool {
            forms.iter().all(|e| self.signed(e, sign).is_some())
        };
        (integers && (all(exponents, Sign::Nonnegative) || all(bases, Sign::Nonzero))).then_some(())
    }

    /// Equations between powers of the same base.
    pub(super) fn split_powers(&mut self, atoms: &[Formula]) -> Vec<Step> {
        let mut groups: BTreeMap<String, Vec<Simple>> = BTreeMap::new();
        for atom in atoms {
            if let Some(simple) = self.simple(atom) {
                let base = self.simplified(&simple.base);
                let key = base.map_or_else(String::new, |base| base.to_string());
                groups.entry(key).or_default().push(simple);
            }
        }
        let groups: Vec<Vec<Simple>> = groups.into_values().collect();
        groups
            .iter()
            .flat_map(|group| self.split_group(group))
            .collect()
    }

    fn simple(&mut self, atom: &Formula) -> Option<Simple> {
        let Formula::Binary(Operator::Power, base, exponent) = atom else {
            return None;
        };
        let normal = self.field.borrow_mut().normal(exponent)?;
        Some(Simple {
            atom: atom.clone(),
            base: (**base).clone(),
            exponent: normal.as_polynomial()?.clone(),
        })
    }

    /// One moving part: to the lowest of the exponents. More: to powers of each moving part alone.
    fn split_group(&mut self, group: &[Simple]) -> Vec<Step> {
        let mut moving: Vec<Polynomial> = group.iter().map(|s| moving(&s.exponent)).collect();
        moving.sort();
        moving.dedup();
        let rational = moving.iter().all(Polynomial::is_zero);
        if rational || (moving.len() > 1 && self.attempt(|b| b.positive(&group[0].base)).is_some())
        {
            let units = units(group);
            return group
                .iter()
                .filter_map(|simple| self.attempt(|b| b.split_by(simple, &units)))
                .collect();
        }
        let lowest = |simple: &Simple| {
            let own = super::powers::moving(&simple.exponent);
            let same = group
                .iter()
                .filter(|s| super::powers::moving(&s.exponent) == own);
            same.map(|s| still(&s.exponent)).min()
        };
        group
            .iter()
            .filter_map(|simple| {
                let excess = still(&simple.exponent) - lowest(simple)?;
                self.attempt(|b| b.split_off(simple, &excess))
            })
            .collect()
    }

    /// `a^p == a^(p - c)*a^c` for a number c above 0.
    fn split_off(&mut self, simple: &Simple, c: &rug::Rational) -> Option<Step> {
        if *c <= 0 {
            return None;
        }
        let lower = simple.exponent.sub(&Polynomial::constant(c.clone()));
        let lower = self.field.borrow().write_polynomial(&lower);
        self.split_in(simple, lower, number(&from_rug(c)))
    }

    fn split_in(&mut self, simple: &Simple, q: Formula, r: Formula) -> Option<Step> {
        self.splittable(&[&simple.base], &[&q, &r])?;
        let right = times(power(simple.base.clone(), q), power(simple.base.clone(), r));
        self.step(
            Fact::Same(simple.atom.clone(), right),
            Rule::Power,
            &[],
            &[],
        )
    }

    /// `a^(c*u) == (a^u)^c` for a unit u and an integer c, or the first term split off.
    fn split_by(
        &mut self,
        simple: &Simple,
        units: &BTreeMap<Monomial, rug::Rational>,
    ) -> Option<Step> {
        let (monomial, coefficient) = simple.exponent.terms().next_back()?;
        let first = Polynomial::term(monomial.clone(), coefficient.clone());
        let rest = simple.exponent.sub(&first);
        let write = |p: &Polynomial| self.field.borrow().write_polynomial(p);
        if !rest.is_zero() {
            let (q, r) = (write(&first), write(&rest));
            return self.split_in(simple, q, r);
        }
        let unit = units.get(monomial)?;
        let times = rug::Rational::from(coefficient / unit);
        if times == 1 {
            return None;
        }
        let u = write(&Polynomial::term(monomial.clone(), unit.clone()));
        let inner = power(simple.base.clone(), u.clone());
        let outer = power(inner, number(&from_rug(&times)));
        let Formula::Binary(_, _, p) = &outer else {
            return None;
        };
        self.splittable(&[&simple.base], &[&u, p])?;
        let fact = Fact::Same(outer.clone(), simple.atom.clone());
        let step = self.step(fact, Rule::Power, &[], &[])?;
        self.chain(&[step], &simple.atom, &outer)
    }
}

/// Whether a power or a root stands in the base of a power.
pub(super) fn has_towers(e: &Formula) -> bool {
    let own = matches!(e, Formula::Binary(Operator::Power, base, _) if is_root(base));
    own || parts(e).into_iter().any(has_towers)
}

/// Whether it is a power or a square root.
fn is_root(e: &Formula) -> bool {
    matches!(
        e,
        Formula::Binary(Operator::Power, ..) | Formula::Call(Function::Sqrt, _)
    )
}

/// The base and the exponent of a power with a rational exponent.
pub(super) fn rational_exponent(
    builder: &Builder,
    atom: &Formula,
) -> Option<(Formula, rug::Rational)> {
    let Formula::Binary(Operator::Power, base, exponent) = atom else {
        return None;
    };
    let exponent = builder.field.borrow_mut().normal(exponent)?.as_constant()?;
    Some(((**base).clone(), exponent))
}

/// The exponent without its constant term.
fn moving(exponent: &Polynomial) -> Polynomial {
    exponent.sub(&Polynomial::constant(still(exponent)))
}

/// The constant term.
fn still(exponent: &Polynomial) -> rug::Rational {
    let mut terms = exponent.terms();
    let found = terms.find(|(monomial, _)| monomial.is_one());
    found.map_or_else(rug::Rational::new, |(_, value)| value.clone())
}

/// For each monomial of the exponents, the largest number of which all its coefficients are integer
/// multiples.
fn units(group: &[Simple]) -> BTreeMap<Monomial, rug::Rational> {
    let mut units: BTreeMap<Monomial, rug::Rational> = BTreeMap::new();
    for simple in group {
        for (monomial, coefficient) in simple.exponent.terms() {
            let size = coefficient.clone().abs();
            let unit = units
                .entry(monomial.clone())
                .or_insert_with(|| size.clone());
            *unit = common(unit, &size);
        }
    }
    if let Some(unit) = units.get_mut(&Monomial::one()) {
        *unit = common(unit, &rug::Rational::from(1));
    }
    units
}

/// The greatest common divisor of two positive rationals.
fn common(a: &rug::Rational, b: &rug::Rational) -> rug::Rational {
    let below = Integer::from(a.denom().lcm_ref(b.denom()));
    let scaled = |r: &rug::Rational| r.numer() * Integer::from(&below / r.denom());
    rug::Rational::from((scaled(a).gcd(&scaled(b)), below))
}
