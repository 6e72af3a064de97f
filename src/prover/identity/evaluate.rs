//! Values of quantities: means, variances, densities, integrals, sums, limits and hypergeometric
//! functions, each by its own tactic, and of the formulas that are made of them.

use super::Builder;
use super::make::{map_parts, parts};
use super::rational::Algebra;
use super::{choice, derivative, integral, law, limit, special, sum};
use crate::formula::{Formula, Function, Name, RangeKind};
use crate::kernel::proof::{Fact, Step};
use std::collections::HashMap;

/// What the tactics share.
#[derive(Default)]
pub(super) struct Context {
    pub algebra: Algebra,
    /// Names that the case under way gives a value, with the equation.
    pub known: Vec<(Name, Formula, Step)>,
    /// Values found before; good where their equation is in sight.
    values: HashMap<Formula, (Formula, Step)>,
}

impl Context {
    /// Forgets the values found before: what had none may have one in the next case.
    pub fn forget(&mut self) {
        self.values.clear();
    }
}

/// A value and the step that states that the quantity has it.
pub(super) type Value = (Formula, Step);

/// The formula with every quantity in it replaced by its value as far as one is found.
pub(super) fn evaluate(b: &mut Builder, cx: &mut Context, e: &Formula) -> Option<Value> {
    let mut equations = Vec::new();
    let found = walk(b, cx, e, &mut equations);
    let step = b.congruent(e, &found, &equations)?;
    Some((found, step))
}

fn walk(b: &mut Builder, cx: &mut Context, e: &Formula, equations: &mut Vec<Step>) -> Formula {
    if !is_quantity(e) {
        return map_parts(e, &mut |part| walk(b, cx, part, equations));
    }
    match value(b, cx, e) {
        Some((found, step)) => {
            equations.push(step);
            found
        }
        None => e.clone(),
    }
}

/// Whether a formula is evaluated as a whole.
pub(super) fn is_quantity(e: &Formula) -> bool {
    match e {
        Formula::Mean(..) | Formula::Variance(..) | Formula::Probability(..) => true,
        Formula::Density(..) | Formula::Limit(..) | Formula::Derivative(..) => true,
        Formula::At(..) | Formula::If(..) => true,
        Formula::Ranged(r) => matches!(r.kind, RangeKind::Integral | RangeKind::Sum),
        Formula::Call(Function::Hyp2F1 | Function::Hyp2F1Regularized, _) => true,
        Formula::Call(Function::Min | Function::Max, _) => true,
        _ => false,
    }
}

/// Whether there is something to evaluate in a formula, outside of binders.
pub(super) fn has_quantity(e: &Formula) -> bool {
    is_quantity(e) || parts(e).into_iter().any(has_quantity)
}

/// The value of a quantity.
pub(super) fn value(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    if let Some((found, _)) = cx.values.get(q)
        && let Some(step) = b.seen(&Fact::Same(q.clone(), found.clone()))
    {
        return Some((found.clone(), step));
    }
    let found = b.attempt(|b| match q {
        Formula::Mean(_, None) | Formula::Variance(_, None) | Formula::Probability(..) => {
            law::drawn(b, cx, q)
        }
        Formula::Mean(_, Some(_)) | Formula::Density(..) => law::mean(b, cx, q),
        Formula::Variance(e, Some(draw)) => law::variance(b, cx, e, draw),
        Formula::Ranged(r) if r.kind == RangeKind::Integral => integral::value(b, cx, r),
        Formula::Ranged(r) => sum::value(b, cx, r),
        Formula::Derivative(..) => derivative::value(b, cx, q),
        Formula::Limit(e, places) => limit::value(b, cx, e, places),
        Formula::At(e, places) => choice::at_places(b, cx, q, (e, places)),
        Formula::If(..) => choice::branch(b, cx, q),
        Formula::Call(Function::Min | Function::Max, _) => choice::extreme(b, cx, q),
        Formula::Call(function, parts) => special::value(b, cx, *function, parts),
        _ => None,
    })?;
    cx.values.insert(q.clone(), found.clone());
    Some(found)
}

/// The value of what a first step found the quantity to be; what has no value stays.
pub(super) fn then(
    b: &mut Builder,
    cx: &mut Context,
    q: &Formula,
    (next, step): Value,
) -> Option<Value> {
    let found = match is_quantity(&next) {
        true => value(b, cx, &next),
        false => evaluate(b, cx, &next),
    };
    match found {
        Some((found, second)) if found != next => {
            let joined = b.chain(&[step, second], q, &found)?;
            Some((found, joined))
        }
        _ => Some((next, step)),
    }
}
