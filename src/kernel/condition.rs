//! Conditions: true, false, or not known. A relation with a side that has no value is false.

use super::interval::Interval;
use super::quantity::Quantity;
use super::scope::Scope;
use super::value::evaluate;
use super::{Gap, Unknown, unknown};
use crate::formula::{Condition, Formula, Rational, Relation};
use num_traits::Zero;
use std::cmp::Ordering;

/// Whether a condition holds; of an integral's variable, on the piece of the scope's sample.
pub(super) fn holds(condition: &Condition, scope: &Scope) -> Result<bool, Unknown> {
    scope.spend(1)?;
    match condition {
        Condition::Chain(first, links) => {
            all(pairs(first, links)
                .map(|(left, relation, right)| link(left, relation, right, scope)))
        }
        Condition::And(parts) => all(parts.iter().map(|part| holds(part, scope))),
        Condition::Or(parts) => {
            let none = all(parts.iter().map(|part| Ok(!holds(part, scope)?)));
            Ok(!none?)
        }
        Condition::Not(part) => Ok(!holds(part, scope)?),
    }
}

/// The links of a chain, each with its own left side.
pub(super) fn pairs<'a>(
    first: &'a Formula,
    links: &'a [(Relation, Formula)],
) -> impl Iterator<Item = (&'a Formula, Relation, &'a Formula)> {
    let lefts = std::iter::once(first).chain(links.iter().map(|(_, right)| right));
    lefts
        .zip(links)
        .map(|(left, (relation, right))| (left, *relation, right))
}

/// Whether all hold: one that is false decides, even after one that is not known.
fn all(parts: impl Iterator<Item = Result<bool, Unknown>>) -> Result<bool, Unknown> {
    let mut answer = Ok(true);
    for part in parts {
        match part {
            Ok(true) => {}
            Ok(false) => return Ok(false),
            Err(why) => answer = Err(why),
        }
    }
    answer
}

fn link(
    left: &Formula,
    relation: Relation,
    right: &Formula,
    scope: &Scope,
) -> Result<bool, Unknown> {
    match (evaluate(left, scope), evaluate(right, scope)) {
        (Err(Gap::Undefined), _) | (_, Err(Gap::Undefined)) => Ok(false),
        (Ok(left), Ok(right)) => relate(&left, relation, &right, scope),
        (Err(Gap::Unknown(why)), _) | (_, Err(Gap::Unknown(why))) => Err(why),
    }
}

/// Whether a relation holds of two values that are there.
pub(super) fn relate(
    left: &Quantity,
    relation: Relation,
    right: &Quantity,
    scope: &Scope,
) -> Result<bool, Unknown> {
    if let (Quantity::Finite(a), Quantity::Finite(b)) = (left, right) {
        let difference = at_sample(&a.plus(&b.negated())?.into(), scope)?;
        return allowed(relation, &difference);
    }
    allows(relation, left.compare(right)?)
}

/// The number, or the value of a function of the variable at the sample.
pub(super) fn at_sample(value: &Quantity, scope: &Scope) -> Result<Interval, Unknown> {
    let function = value.clone().finite()?;
    match (function.as_number(), &scope.sample) {
        (Some(number), _) => Ok(number),
        (None, Some(sample)) => function.at(sample),
        (None, None) => unknown("a comparison of an integral's variable inside of another"),
    }
}

/// Whether a relation holds of two numbers, given their difference: where all orders that it leaves
/// open are alike.
fn allowed(relation: Relation, difference: &Interval) -> Result<bool, Unknown> {
    let zero = Rational::zero();
    let (low, high) = (difference.low().cmp(&zero), difference.high().cmp(&zero));
    let mut answers = Vec::new();
    for ordering in [Ordering::Less, Ordering::Equal, Ordering::Greater] {
        if low <= ordering && ordering <= high {
            answers.push(allows(relation, ordering)?);
        }
    }
    answers.dedup();
    match answers[..] {
        [settled] => Ok(settled),
        _ => unknown("a relation is not settled at these bits"),
    }
}

/// Whether a relation holds of two numbers, given how they compare.
pub(super) fn allows(relation: Relation, ordering: Ordering) -> Result<bool, Unknown> {
    Ok(match relation {
        Relation::Equal => ordering.is_eq(),
        Relation::NotEqual => ordering.is_ne(),
        Relation::Less => ordering.is_lt(),
        Relation::LessEqual => ordering.is_le(),
        Relation::Greater => ordering.is_gt(),
        Relation::GreaterEqual => ordering.is_ge(),
        Relation::Asymptotic | Relation::Approximate => {
            return unknown("an asymptotic relation holds at no single point");
        }
    })
}
