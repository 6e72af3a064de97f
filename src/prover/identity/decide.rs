//! Conditions that the facts in sight decide.

use super::builder::Builder;
use super::form::{integer, minus, over, power};
use super::make::{is_one, is_zero};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule, Step};
use num_traits::One;

impl Builder<'_> {
    /// What an indicator is by its condition.
    pub(super) fn decided(&mut self, e: &Formula) -> Option<(Formula, Step)> {
        let Formula::Indicator(condition) = e else {
            return None;
        };
        let facts = Fact::of_condition(condition)?;
        let value = match facts.iter().all(|fact| self.shows(fact)) {
            true => 1,
            false => {
                let mut opposites = facts.iter().filter_map(Fact::negation);
                opposites.any(|fact| self.shows(&fact)).then_some(0)?
            }
        };
        let found = integer(value);
        let fact = Fact::Same(e.clone(), found.clone());
        let step = self.step(fact, Rule::Decide, &[], &[])?;
        Some((found, step))
    }

    fn shows(&mut self, fact: &Fact) -> bool {
        self.attempt(|b| b.hold(fact)).is_some()
    }

    /// Makes it known that a relation between finite numbers holds.
    fn hold(&mut self, fact: &Fact) -> Option<()> {
        let (Fact::Less(a, b) | Fact::AtMost(a, b)) = fact else {
            return None;
        };
        self.finite(a)?;
        self.finite(b)?;
        let difference = match is_zero(a) {
            true => b.clone(),
            false => minus(b.clone(), a.clone()),
        };
        let strict = matches!(fact, Fact::Less(..));
        let shown = match strict {
            true => self.positive(&difference),
            false => self.nonnegative(&difference),
        };
        shown.or_else(|| self.attempt(|builder| builder.hold_by_power(a, b, strict)))
    }

    /// The same, one of the two being a root, by the order of their powers.
    fn hold_by_power(&mut self, a: &Formula, b: &Formula, strict: bool) -> Option<()> {
        let d = degree(a).or_else(|| degree(b))?;
        let p = over(integer(1), d.clone());
        let mut equations = Vec::new();
        let (low, high) = (
            self.raised(a, &d, &p, &mut equations)?,
            self.raised(b, &d, &p, &mut equations)?,
        );
        self.compare_powers(&low, &high, &p, strict)?;
        let shown = minus(power(high, p.clone()), power(low, p));
        let (a, b) = (a.clone(), b.clone());
        let fact = match strict {
            true => Fact::Less(a, b),
            false => Fact::AtMost(a, b),
        };
        self.step(fact, Rule::Order, &equations, &[shown])?;
        Some(())
    }

    /// The d-th power of a formula that is not negative, with an equation between the formula and its root.
    fn raised(
        &mut self,
        e: &Formula,
        d: &Formula,
        p: &Formula,
        equations: &mut Vec<Step>,
    ) -> Option<Formula> {
        let (left, raised, right) = match e {
            Formula::Call(Function::Sqrt, parts) if degree(e).as_ref() == Some(d) => {
                let base = parts.first()?.clone();
                (e.clone(), base.clone(), power(base, p.clone()))
            }
            Formula::Binary(Operator::Power, base, _) if degree(e).as_ref() == Some(d) => {
                return Some((**base).clone());
            }
            _ => {
                self.nonnegative(e)?;
                let raised = power(e.clone(), d.clone());
                let left = power(raised.clone(), p.clone());
                (left, raised, power(e.clone(), integer(1)))
            }
        };
        let fact = Fact::Same(left, right);
        equations.push(self.step(fact, Rule::Power, &[], &[])?);
        Some(raised)
    }
}

/// The d of a d-th root.
pub(super) fn degree(e: &Formula) -> Option<Formula> {
    match e {
        Formula::Call(Function::Sqrt, _) => Some(integer(2)),
        Formula::Binary(Operator::Power, _, q) => match &**q {
            Formula::Binary(Operator::Divide, one, d) if is_one(one) => Some((**d).clone()),
            Formula::Number(q) if q.numer().is_one() && !q.is_one() => {
                Some(Formula::Number(q.recip()))
            }
            _ => None,
        },
        _ => None,
    }
}
