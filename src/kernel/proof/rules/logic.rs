//! The rules of logic, order and rational arithmetic.

use super::super::known::{above, minus};
use super::super::normal::Equations;
use super::super::{Fact, reject, require};
use super::{Check, Checked, need};
use crate::formula::{Formula, Function, Operator, Point, free_functions, free_names, substitute};
use crate::kernel::{Value, value};
use num_traits::One;

/// The bits for values of closed formulas; an exact value needs none of them.
const BITS: u32 = 64;
/// What one of them takes from a proof's store of work: a proof computes a few, and small ones.
const COMPUTE_FUEL: u64 = 1_000_000;

impl Check<'_, '_> {
    pub(super) fn given(&self) -> Checked {
        let conditions = self.proof.proposition.domain.iter();
        let mut facts = conditions.filter_map(Fact::of_condition).flatten();
        require(
            facts.any(|fact| fact == *self.fact),
            "the domain does not say so",
        )?;
        self.fact
            .sides()
            .into_iter()
            .try_for_each(|side| self.is_finite(side))
    }

    pub(super) fn finite(&self) -> Checked {
        match self.fact {
            Fact::Integer(e) => self.is_integer(e),
            Fact::Finite(e) if self.premises.is_empty() => self.is_finite(e),
            Fact::Finite(e) => match self.plain(0)? {
                Fact::Same(a, b) if a == e => self.is_finite(b),
                Fact::Same(a, b) if b == e => self.is_finite(a),
                _ => reject("the premise is no equation for the formula"),
            },
            _ => reject("the rule concludes that a formula is finite"),
        }
    }

    pub(super) fn order(&self) -> Checked {
        let (Fact::Less(a, b) | Fact::AtMost(a, b) | Fact::Different(a, b) | Fact::Same(a, b)) =
            self.fact
        else {
            return reject("the rule concludes a relation");
        };
        self.is_finite(a)?;
        self.is_finite(b)?;
        let difference = above(a, b);
        if let Fact::Same(..) = self.fact {
            self.is_nonnegative(&difference)?;
            return self.is_nonnegative(&above(b, a));
        }
        let shown = self.arguments.first().unwrap_or(&difference);
        match self.fact {
            Fact::Less(..) => self.is_positive(shown)?,
            Fact::AtMost(..) => self.is_nonnegative(shown)?,
            _ => self.is_nonzero(shown)?,
        }
        self.is_same(shown, &difference)
    }

    pub(super) fn gap(&self) -> Checked {
        let Fact::AtMost(a, b) = self.fact else {
            return reject("the rule concludes a <= b");
        };
        self.is_integer(a)?;
        self.is_integer(b)?;
        let wider = Formula::binary(Operator::Add, minus(b, a), Formula::integer(1));
        let shown = self.arguments.first().unwrap_or(&wider);
        self.is_positive(shown)?;
        self.is_same(shown, &wider)
    }

    pub(super) fn ring(&self) -> Checked {
        let (a, b) = self.equation()?;
        self.is_finite(a)?;
        self.is_finite(b)?;
        self.is_same(a, b)
    }

    /// Two finite formulas are equal as rational functions of their atoms, once the equations that
    /// are the premises have been put for the atoms on their left.
    pub(super) fn is_same(&self, a: &Formula, b: &Formula) -> Checked {
        let mut equations = Equations::new();
        for index in 0..self.premises.len() {
            let Fact::Same(left, right) = self.plain(index)? else {
                return reject("a premise is no equation");
            };
            self.is_finite(right)?;
            // The parts of an atom are brought to normal form too, so they must be finite.
            if !matches!(
                left,
                Formula::Ranged(_) | Formula::Mean(..) | Formula::Limit(..)
            ) {
                self.is_finite(left)?;
            }
            let atom = self.proof.atom_number(left, &Equations::new(), 0)?;
            equations.insert(atom, right.clone());
        }
        let a = self.proof.normal_with(a, &equations, 0)?;
        let b = self.proof.normal_with(b, &equations, 0)?;
        require(
            a.equals(&b, &self.proof.fuel)?,
            "the two are not equal as rational functions",
        )
    }

    pub(super) fn chain(&self) -> Checked {
        let (a, b) = self.equation()?;
        let mut reached = a;
        for index in 0..self.premises.len() {
            reached = match self.plain(index)? {
                Fact::Same(from, to) if from == reached => to,
                Fact::Same(to, from) if from == reached => to,
                _ => return reject("the premises do not join"),
            };
        }
        require(reached == b, "the premises end elsewhere")
    }

    pub(super) fn none(&self) -> Checked {
        match self.fact {
            Fact::Undefined(e) => need(self.proof.undefined(e), e, "without value"),
            Fact::Same(a, b) => {
                need(self.proof.undefined(a), a, "without value")?;
                need(self.proof.undefined(b), b, "without value")
            }
            _ => reject("the rule concludes that there is no value"),
        }
    }

    pub(super) fn compute(&self) -> Checked {
        let (Fact::Same(e, _) | Fact::Undefined(e)) = self.fact else {
            return reject("the rule concludes a value, or that there is none");
        };
        let closed = free_names(e).is_empty() && free_functions(e).is_empty();
        require(closed, "a formula with names has no one value")?;
        self.proof.spend(COMPUTE_FUEL)?;
        let found = match value(e, &Point::default(), &[], BITS) {
            Ok(found) => found,
            Err(_) => return reject("the value is not found"),
        };
        match (self.fact, found) {
            (Fact::Undefined(_), Value::Undefined) => Ok(()),
            (Fact::Same(_, q), Value::Finite { low, high }) if low == high => {
                self.is_finite(q)?;
                let stated = self.proof.normal(q)?.as_constant();
                require(stated == Some(low), "the value is another")
            }
            _ => reject("the value is no such"),
        }
    }

    pub(super) fn cases(&self) -> Checked {
        let (one, other) = (self.premise(0)?, self.premise(1)?);
        let alike = one.fact == self.fact && other.fact == self.fact;
        require(alike, "the two cases do not end alike")?;
        let fixed = one.variables.is_empty() && other.variables.is_empty();
        require(fixed, "a case fixes no variables")?;
        let ([p], [q]) = (one.hypotheses.as_slice(), other.hypotheses.as_slice()) else {
            return reject("a case supposes one fact");
        };
        require(
            p.negation().as_ref() == Some(q),
            "the second case is not the first's negation",
        )?;
        p.sides()
            .into_iter()
            .try_for_each(|side| self.is_finite(side))
    }

    pub(super) fn at(&self) -> Checked {
        let Formula::At(e, places) = self.equation()?.0 else {
            return reject("the rule is for a formula at a place");
        };
        places.iter().try_for_each(|(_, t)| self.is_finite(t))?;
        self.concludes(&substitute(e, places)?)
    }

    pub(super) fn choice(&self) -> Checked {
        let (left, right) = self.equation()?;
        match left {
            Formula::If(condition, a, b) => {
                let facts = Fact::of_condition(condition);
                let Some([fact]) = facts.as_deref() else {
                    return reject("the condition is one relation");
                };
                fact.sides()
                    .into_iter()
                    .try_for_each(|side| self.is_finite(side))?;
                let premise = self.plain(0)?;
                if premise == fact {
                    return self.concludes(a);
                }
                let opposite = fact.negation().as_ref() == Some(premise);
                require(opposite, "the premise does not settle the condition")?;
                self.concludes(b)
            }
            Formula::Call(function @ (Function::Min | Function::Max), parts) => {
                let other = match parts.as_slice() {
                    [a, b] if a == right => b,
                    [a, b] if b == right => a,
                    _ => return reject("the rule gives one of two"),
                };
                match function {
                    Function::Min => self.is_nonnegative(&above(right, other)),
                    _ => self.is_nonnegative(&above(other, right)),
                }
            }
            Formula::Call(Function::Floor, parts) => {
                self.is_integer(right)?;
                self.is_nonnegative(&above(right, &parts[0]))?;
                let next = Formula::binary(Operator::Add, right.clone(), Formula::integer(1));
                self.is_positive(&minus(&next, &parts[0]))
            }
            _ => reject("the rule is for if, min, max and floor"),
        }
    }

    /// Whether a formula is the number 1 by arithmetic.
    pub(super) fn is_one(&self, e: &Formula) -> Result<bool, super::Rejected> {
        Ok(self.proof.finite(e)?
            && self
                .proof
                .normal(e)?
                .as_constant()
                .is_some_and(|q| q.is_one()))
    }
}
