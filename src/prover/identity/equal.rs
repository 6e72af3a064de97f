//! Equations between finite formulas.
//!
//! Both sides become rational functions of a few atoms by equations that replace the others: powers
//! and logarithms are split, and all of Gamma's kin are brought to the least argument that occurs
//! ([`Equations`]). What then is equal as a rational function is so by the rule `ring`; roots are
//! raised to their power where the two differ by that only.

use super::atoms::Equations;
use super::builder::Builder;
use super::make::map_parts;
use crate::formula::Formula;
use crate::kernel::proof::{Fact, Rule, Step};

impl Builder<'_> {
    /// States `a == b`, both being finite.
    pub fn equal(&mut self, a: &Formula, b: &Formula) -> Option<Step> {
        self.equal_with(a, b, &[])
    }

    /// States `a == b` by the equations as well, whose left sides are atoms.
    pub fn equal_with(&mut self, a: &Formula, b: &Formula, given: &[Step]) -> Option<Step> {
        let fact = Fact::Same(a.clone(), b.clone());
        if let Some(step) = self.seen(&fact) {
            return Some(step);
        }
        if a == b {
            return self.step(fact, Rule::Chain, &[], &[]);
        }
        self.finite(a)?;
        self.finite(b)?;
        if self.field.borrow_mut().same(a, b)
            && let Some(step) = self.step(fact.clone(), Rule::Ring, &[], &[])
        {
            return Some(step);
        }
        self.attempt(|builder| builder.equal_by_atoms(a, b, given))
            .or_else(|| self.attempt(|builder| builder.equal_by_names(a, b, given)))
            .or_else(|| self.attempt(|builder| builder.equal_by_arguments(a, b, given)))
    }

    /// With the arguments of unknown functions in normal form: the kernel does not reduce fractions.
    fn equal_by_arguments(&mut self, a: &Formula, b: &Formula, given: &[Step]) -> Option<Step> {
        let (u, first) = self.with_arguments(a)?;
        let (v, last) = self.with_arguments(b)?;
        if u == *a && v == *b {
            return None;
        }
        let middle = self.equal_with(&u, &v, given)?;
        self.chain(&[first, middle, last], a, b)
    }

    fn with_arguments(&mut self, e: &Formula) -> Option<(Formula, Step)> {
        let mut steps = Vec::new();
        let found = self.in_arguments(e, &mut steps);
        let step = self.congruent(e, &found, &steps)?;
        Some((found, step))
    }

    fn in_arguments(&mut self, e: &Formula, steps: &mut Vec<Step>) -> Formula {
        let inside = matches!(e, Formula::Apply(..));
        map_parts(e, &mut |part| {
            if inside
                && let Some(new) = self.simplified(part)
                && new != *part
                && let Some(step) = self.ring(part, &new, &[])
            {
                steps.push(step);
                return new;
            }
            self.in_arguments(part, steps)
        })
    }

    fn equal_by_atoms(&mut self, a: &Formula, b: &Formula, given: &[Step]) -> Option<Step> {
        let equations = Equations::find(self, &[a, b], given)?;
        match equations.difference(self, a, b)?.is_zero() {
            true => self.ring(a, b, &equations.steps()),
            false => self.equal_by_roots(a, b, &equations),
        }
    }

    /// By an equation in sight for a name, or one that gives a function a number, as well.
    pub(super) fn equal_by_names(
        &mut self,
        a: &Formula,
        b: &Formula,
        given: &[Step],
    ) -> Option<Step> {
        let steps = self.equations();
        let named = |step: &Step| {
            matches!(
                self.fact(*step),
                Fact::Same(Formula::Name(_), _) | Fact::Same(Formula::Call(..), Formula::Number(_))
            )
        };
        let steps: Vec<Step> = steps.into_iter().filter(named).collect();
        steps
            .into_iter()
            .filter(|step| !given.contains(step))
            .find_map(|step| {
                let mut given = given.to_vec();
                given.push(step);
                self.attempt(|builder| builder.equal_by_atoms(a, b, &given))
            })
    }

    /// States `a == b` by the rule `ring`; sides that are written alike need none.
    pub(super) fn ring(&mut self, a: &Formula, b: &Formula, equations: &[Step]) -> Option<Step> {
        let rule = match a == b {
            true => Rule::Chain,
            false => Rule::Ring,
        };
        let premises = if a == b { &[] } else { equations };
        let fact = Fact::Same(a.clone(), b.clone());
        self.step(fact, rule, premises, &[])
    }

    /// States `a == b`, where b is a with sides of the premises exchanged.
    pub fn congruent(&mut self, a: &Formula, b: &Formula, premises: &[Step]) -> Option<Step> {
        let fact = Fact::Same(a.clone(), b.clone());
        self.step(fact, Rule::Congruence, premises, &[])
    }

    /// States `a == b` by equations that join them, each read in either direction.
    pub fn chain(&mut self, steps: &[Step], a: &Formula, b: &Formula) -> Option<Step> {
        let fact = Fact::Same(a.clone(), b.clone());
        self.step(fact, Rule::Chain, steps, &[])
    }

    /// The right side of an equation.
    pub(super) fn right(&self, step: Step) -> Option<Formula> {
        match self.fact(step) {
            Fact::Same(_, right) => Some(right.clone()),
            _ => None,
        }
    }
}
