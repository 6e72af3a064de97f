//! Equations between finite formulas.

use super::builder::Builder;
use crate::formula::Formula;
use crate::kernel::proof::{Fact, Rule, Step};

impl Builder<'_> {
    /// States `a == b`, both being finite.
    pub fn equal(&mut self, a: &Formula, b: &Formula) -> Option<Step> {
        self.equal_with(a, b, &[])
    }

    /// States `a == b` by the equations as well, whose left sides are atoms.
    pub fn equal_with(&mut self, a: &Formula, b: &Formula, equations: &[Step]) -> Option<Step> {
        let fact = Fact::Same(a.clone(), b.clone());
        if let Some(step) = self.seen(&fact) {
            return Some(step);
        }
        if a == b {
            return self.step(fact, Rule::Chain, &[], &[]);
        }
        self.finite(a)?;
        self.finite(b)?;
        self.step(fact, Rule::Ring, equations, &[])
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
}
