//! The rules of logic, order and rational arithmetic.

use super::super::known::{above, minus};
use super::super::normal::Equations;
use super::super::{Fact, reject, require};
use super::{Check, Checked, need};
use crate::formula::{Formula, Operator, Point, free_functions, free_names, substitute};
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
        let (Fact::Same(a, b) | Fact::AtMost(a, b) | Fact::Less(a, b)) = self.fact else {
            return reject("the rule concludes an equation or an order");
        };
        // The sides of an order are finite; an equation alone does not say so.
        let (mut reached, mut ordered, mut strict) = (a, false, false);
        for index in 0..self.premises.len() {
            let premise = self.plain(index)?;
            reached = match premise {
                Fact::Same(from, to) | Fact::AtMost(from, to) | Fact::Less(from, to)
                    if from == reached =>
                {
                    to
                }
                Fact::Same(to, from) if from == reached => to,
                _ => return reject("the premises do not join"),
            };
            ordered |= !matches!(premise, Fact::Same(..));
            strict |= matches!(premise, Fact::Less(..));
        }
        require(reached == b, "the premises end elsewhere")?;
        let says = match self.fact {
            Fact::Same(..) => !ordered,
            Fact::AtMost(..) => ordered,
            _ => strict,
        };
        require(says, "the premises say something else")
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

    pub(super) fn decide(&self) -> Checked {
        let (left, right) = self.equation()?;
        let (one, zero) = (Formula::integer(1), Formula::integer(0));
        let (condition, yes, no) = match left {
            Formula::Indicator(c) => (c, &one, &zero),
            Formula::If(c, a, b) => (c, &**a, &**b),
            _ => return reject("the rule is for what depends on a condition"),
        };
        let Some(facts) = Fact::of_condition(condition) else {
            return reject("a condition that is not made of relations");
        };
        if right == yes && facts.iter().all(|fact| self.holds(fact).is_ok()) {
            return Ok(());
        }
        let mut opposites = facts.iter().filter_map(Fact::negation);
        let fails = opposites.any(|fact| self.holds(&fact).is_ok());
        require(right == no && fails, "the condition does not decide so")
    }

    /// A relation between finite numbers holds.
    fn holds(&self, fact: &Fact) -> Checked {
        for side in fact.sides() {
            self.is_finite(side)?;
        }
        match fact {
            Fact::Less(a, b) => self.is_positive(&above(a, b)),
            Fact::AtMost(a, b) => self.is_nonnegative(&above(a, b)),
            Fact::Different(a, b) => self.is_nonzero(&minus(b, a)),
            Fact::Same(a, b) => need(self.proof.zero(&minus(b, a)), b, "the same"),
            _ => reject("a relation between numbers"),
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

    pub(super) fn is_one(&self, e: &Formula) -> Result<bool, super::Rejected> {
        Ok(self.proof.finite(e)?
            && self
                .proof
                .normal(e)?
                .as_constant()
                .is_some_and(|q| q.is_one()))
    }
}
