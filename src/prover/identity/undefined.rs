//! Makes it known that formulas have no value.

use super::builder::Builder;
use super::form::{integer, negate};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule, Step};

impl Builder<'_> {
    /// Makes it known that a formula has no value.
    pub fn undefined(&mut self, e: &Formula) -> Option<()> {
        if self.seen(&Fact::Undefined(e.clone())).is_some() || self.has_no_value(e) {
            return Some(());
        }
        match e {
            Formula::Negate(a) | Formula::Factorial(a) | Formula::Derivative(a, ..) => {
                self.undefined(a)
            }
            Formula::Binary(_, a, b) => self.undefined(a).or_else(|| self.undefined(b)),
            Formula::Call(_, parts) | Formula::Apply(_, parts) => {
                parts.iter().find_map(|part| self.undefined(part))
            }
            _ => None,
        }
    }

    /// Whether the operation itself has no value.
    fn has_no_value(&mut self, e: &Formula) -> bool {
        match e {
            Formula::Binary(Operator::Divide, _, b) => self.zero(b).is_some(),
            Formula::Binary(Operator::Subtract, a, b) => self.is_endless(a) && self.is_endless(b),
            Formula::Binary(Operator::Power, a, b) => self
                .attempt(|builder| {
                    builder.zero(a)?;
                    builder.finite(b)?;
                    builder.positive(&negate((**b).clone()))
                })
                .is_some(),
            Formula::Call(Function::Ln, parts) => {
                parts.first().is_some_and(|a| self.is_not_positive(a))
            }
            Formula::Call(Function::Gamma, parts) => parts
                .first()
                .is_some_and(|a| self.is_integer(a) && self.is_not_positive(a)),
            Formula::Factorial(a) => {
                self.is_integer(a)
                    && self
                        .attempt(|builder| {
                            builder.finite(a)?;
                            builder.positive(&negate((**a).clone()))
                        })
                        .is_some()
            }
            _ => false,
        }
    }

    fn is_endless(&mut self, e: &Formula) -> bool {
        match e {
            Formula::Infinity => true,
            Formula::Binary(Operator::Power, a, b) => {
                self.is_endless(a) && self.finite(b).is_some() && self.positive(b).is_some()
            }
            _ => false,
        }
    }

    fn is_not_positive(&mut self, a: &Formula) -> bool {
        self.zero(a).is_some()
            || self
                .attempt(|builder| {
                    builder.finite(a)?;
                    builder.nonnegative(&negate(a.clone()))
                })
                .is_some()
    }

    /// Makes it known that a formula is finite with the value 0.
    pub fn zero(&mut self, e: &Formula) -> Option<()> {
        self.attempt(|builder| {
            builder.finite(e)?;
            let zero = integer(0);
            if builder.field.borrow_mut().same(e, &zero) {
                return Some(());
            }
            builder
                .squeeze(e, &zero)
                .or_else(|| builder.equal_by_names(e, &zero, &[]))?;
            Some(())
        })
    }

    /// States `a == b` for finite sides where each is shown to be at most the other.
    pub fn squeeze(&mut self, a: &Formula, b: &Formula) -> Option<Step> {
        self.attempt(|builder| {
            builder.nonnegative(&super::form::minus(b.clone(), a.clone()))?;
            builder.nonnegative(&super::form::minus(a.clone(), b.clone()))?;
            let fact = Fact::Same(a.clone(), b.clone());
            builder.step(fact, Rule::Order, &[], &[])
        })
    }
}
