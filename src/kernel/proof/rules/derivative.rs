//! The rule of derivatives.

use super::super::known::above;
use super::super::{Fact, reject, require};
use super::integral::states;
use super::{Check, Checked, depends, put};
use crate::formula::{Formula, Name};
use crate::kernel::derivative::{derive, is_entire};

impl Check<'_, '_> {
    pub(super) fn derivative(&self) -> Checked {
        let Formula::Derivative(e, x, order) = self.equation()?.0 else {
            return reject("the rule is for derivatives");
        };
        require(**order == Formula::integer(1), "the rule is for the first")?;
        self.is_finite(&Formula::Name(x.clone()))?;
        let slope = derive(e, x)?;
        self.is_finite_around(0, x, e)?;
        self.is_finite_around(1, x, &slope)?;
        self.concludes(&slope)
    }

    /// A premise says that the formula is finite for all numbers around x in the place of x.
    fn is_finite_around(&self, index: usize, x: &Name, e: &Formula) -> Checked {
        let premise = self.premise(index)?;
        let y = match premise.variables.as_slice() {
            [y] if !y.integer => &y.name,
            _ => return reject("the premise is for one real variable"),
        };
        require(!depends(e, y), "the variable's new name is in use")?;
        let there = put(e, x, &Formula::Name(y.clone()))?;
        states(premise.fact, &Fact::Finite(there))?;
        let mut hypotheses = premise.hypotheses.iter();
        hypotheses.try_for_each(|fact| self.holds_around(fact, x, y))
    }

    /// A hypothesis on y holds at x, and then around it: between continuous functions a strict
    /// relation does.
    fn holds_around(&self, hypothesis: &Fact, x: &Name, y: &Name) -> Checked {
        let (Fact::Less(a, b) | Fact::Different(a, b)) = hypothesis else {
            return reject("the premise supposes what may hold at x alone");
        };
        let entire = is_entire(a, y) && is_entire(b, y);
        require(entire, "the premise supposes what may hold at x alone")?;
        let at_x = put(&above(a, b), y, &Formula::Name(x.clone()))?;
        match hypothesis {
            Fact::Less(..) => self.is_positive(&at_x),
            _ => self.is_nonzero(&at_x),
        }
    }
}
