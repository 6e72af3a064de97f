//! Formulas at a place, and those that choose: `if`, `min` and `max`.

use super::Builder;
use super::evaluate::{Context, Value, evaluate, then};
use super::form::minus;
use crate::formula::{Formula, Function, Name, substitute};
use crate::kernel::proof::{Fact, Rule, Step};

impl Builder<'_> {
    /// States a relation.
    pub fn relation(&mut self, fact: &Fact) -> Option<Step> {
        self.attempt(|builder| {
            let (Fact::Same(a, b) | Fact::Less(a, b) | Fact::AtMost(a, b) | Fact::Different(a, b)) =
                fact
            else {
                return None;
            };
            builder.finite(a)?;
            builder.finite(b)?;
            let difference = minus(b.clone(), a.clone());
            match fact {
                Fact::Same(..) => return builder.squeeze(a, b),
                Fact::Less(..) => builder.positive(&difference)?,
                Fact::AtMost(..) => builder.nonnegative(&difference)?,
                _ => builder.nonzero(&difference)?,
            }
            builder.step(fact.clone(), Rule::Order, &[], &[difference])
        })
    }
}

/// The formula with the places put in.
pub(super) fn at_places(
    b: &mut Builder,
    cx: &mut Context,
    q: &Formula,
    (e, places): (&Formula, &[(Name, Formula)]),
) -> Option<Value> {
    places.iter().try_for_each(|(_, t)| b.finite(t))?;
    let next = substitute(e, places).ok()?;
    // A derivative at a place is one still.
    if matches!(next, Formula::At(..)) {
        return None;
    }
    let step = b.step(Fact::Same(q.clone(), next.clone()), Rule::At, &[], &[])?;
    then(b, cx, q, (next, step))
}

/// The branch of an `if` whose condition is settled.
pub(super) fn branch(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    let Formula::If(condition, yes, no) = q else {
        return None;
    };
    let fact = Fact::of_condition(condition)?;
    let [fact] = fact.as_slice() else {
        return None;
    };
    let next = match b.relation(fact) {
        Some(_) => yes,
        None => b.relation(&fact.negation()?).map(|_| no)?,
    };
    let next = (**next).clone();
    let fact = Fact::Same(q.clone(), next.clone());
    let step = b.step(fact, Rule::Decide, &[], &[])?;
    then(b, cx, q, (next, step))
}

/// The lesser or greater of two, once they are evaluated.
pub(super) fn extreme(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    let Formula::Call(function, parts) = q else {
        return None;
    };
    let [x, y] = parts.as_slice() else {
        return None;
    };
    let ((u, first), (v, second)) = (evaluate(b, cx, x)?, evaluate(b, cx, y)?);
    let whole = Formula::Call(*function, vec![u.clone(), v.clone()]);
    let step = b.congruent(q, &whole, &[first, second])?;
    let (low, high) = match function {
        Function::Min => (&u, &v),
        _ => (&v, &u),
    };
    b.finite(&u)?;
    b.finite(&v)?;
    let ordered = |b: &mut Builder, low: &Formula, high: &Formula| {
        b.nonnegative(&minus(high.clone(), low.clone()))
    };
    let found = match ordered(b, low, high) {
        Some(()) => u.clone(),
        None => {
            ordered(b, high, low)?;
            v.clone()
        }
    };
    let fact = Fact::Same(whole, found.clone());
    let last = b.step(fact, Rule::Extreme, &[], &[])?;
    let step = b.chain(&[step, last], q, &found)?;
    Some((found, step))
}
