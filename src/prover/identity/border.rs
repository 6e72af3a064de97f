//! Cases at the border of the domain, where a divisor vanishes or a logarithm has no value.

use super::builder::Builder;
use super::form::integer;
use super::known::Sign;
use crate::algebra::{Polynomial, Symbol};
use crate::formula::{Condition, Formula, Function, Operator, Rational};
use crate::kernel::proof::{Fact, Step};

/// Small integers that a name may be split at.
const ROOTS: std::ops::RangeInclusive<i64> = -3..=6;
impl Builder<'_> {
    /// Proves a fact, and where that fails, by cases at the borders of the formulas shown.
    pub fn by_cases(
        &mut self,
        fact: &Fact,
        shown: &[Formula],
        splits: usize,
        prove: &mut dyn FnMut(&mut Self) -> Option<Step>,
    ) -> Option<Step> {
        if let Some(step) = prove(self) {
            return Some(step);
        }
        if splits == 0 {
            return None;
        }
        let mut conditions: Vec<Fact> = Vec::new();
        for e in shown {
            self.borders_into(e, &mut conditions);
        }
        conditions.into_iter().find_map(|condition| {
            self.cases(fact, &condition, |builder, _| {
                builder.by_cases(fact, shown, splits - 1, prove)
            })
        })
    }

    /// Conditions `t <= c` that hold on the border of the domain, where a part of the formula is not
    /// known to have a value, and those that a choice in it depends on.
    fn borders_into(&mut self, e: &Formula, found: &mut Vec<Fact>) {
        let suspect = match e {
            Formula::Binary(Operator::Divide, _, b) => Some((&**b, Sign::Nonzero)),
            Formula::Binary(Operator::Power, a, _) => Some((&**a, Sign::Nonzero)),
            Formula::Call(Function::Ln | Function::Gamma, parts) => {
                parts.first().map(|a| (a, Sign::Positive))
            }
            _ => None,
        };
        match e {
            Formula::Negate(a) | Formula::Factorial(a) => self.borders_into(a, found),
            Formula::Binary(_, a, b) => {
                self.borders_into(a, found);
                self.borders_into(b, found);
            }
            Formula::Call(_, parts) => {
                for part in parts {
                    self.borders_into(part, found);
                }
            }
            _ => {}
        }
        if let Some((part, sign)) = suspect
            && self.attempt(|builder| builder.finite(part)).is_some()
            && self.attempt(|builder| builder.signed(part, sign)).is_none()
        {
            for condition in self.splits_at(part) {
                if !found.contains(&condition) {
                    found.push(condition);
                }
            }
        }
        if let Some(condition) = self.parted(e)
            && !found.contains(&condition)
        {
            found.push(condition);
        }
    }

    /// What it depends on whether a factorial has a value, or which way a choice goes.
    fn parted(&mut self, e: &Formula) -> Option<Fact> {
        let (a, b) = match e {
            Formula::Factorial(n) if self.is_integer(n) => (&integer(0), &**n),
            Formula::If(condition, ..) => match &**condition {
                Condition::Chain(a, links) => (a, &links.first()?.1),
                _ => return None,
            },
            Formula::Call(Function::Min | Function::Max, parts) => (parts.first()?, parts.get(1)?),
            _ => return None,
        };
        let orders = [(a, b), (b, a)].map(|(a, b)| Fact::AtMost(a.clone(), b.clone()));
        orders.into_iter().find(|fact| {
            let mut both = [Some(fact.clone()), fact.negation()].into_iter().flatten();
            both.all(|fact| self.relation(&fact).is_none())
        })
    }

    /// Conditions that may make a formula 0 in their one case and not in the other.
    fn splits_at(&mut self, e: &Formula) -> Vec<Fact> {
        let Some(normal) = self.field.borrow_mut().normal(e) else {
            return Vec::new();
        };
        let factors = {
            let field = self.field.borrow();
            normal.factored(&field.budget)
        };
        let Ok((_, factors)) = factors else {
            return Vec::new();
        };
        let mut all = Vec::new();
        for factor in factors.into_keys() {
            for symbol in factor.symbols() {
                all.extend(self.root_of(&factor, &symbol));
            }
        }
        all
    }

    /// `name <= root` for a name in which the factor is linear, or that has a small integer root;
    /// `atom == 0` for a factor that is an atom.
    fn root_of(&mut self, factor: &Polynomial, symbol: &Symbol) -> Option<Fact> {
        if symbol.starts_with('@') {
            let atom = self.field.borrow().formula(symbol);
            let alone = *factor == Polynomial::symbol(symbol);
            return alone.then(|| Fact::Same(atom, integer(0)));
        }
        let name = Formula::Name(symbol.clone());
        for root in ROOTS {
            let at = Polynomial::integer(root);
            let value = factor.substitute(symbol, &at, &self.field.borrow().budget);
            if value.is_ok_and(|value| value.is_zero()) {
                let root = Formula::Number(Rational::from_integer(root.into()));
                return Some(Fact::AtMost(name, root));
            }
        }
        // A factor `c*name + rest`: the difference itself is split.
        let written = self.field.borrow().write_polynomial(factor);
        let nonnegative = self
            .attempt(|b| b.signed(&written, Sign::Nonnegative))
            .is_some();
        if nonnegative {
            return Some(Fact::AtMost(written, integer(0)));
        }
        let opposite = self.field.borrow().write_polynomial(&factor.neg());
        self.attempt(|b| b.signed(&opposite, Sign::Nonnegative))?;
        Some(Fact::AtMost(opposite, integer(0)))
    }
}
