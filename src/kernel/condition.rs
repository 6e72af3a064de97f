//! Conditions: true, false, or not known. A relation with a side that has no value is false.

use super::integrand::relation_allows;
use super::interval::Value;
use super::scope::Scope;
use super::value::value_in;
use super::{Unknown, unknown};
use crate::formula::{Condition, Relation};
use std::cmp::Ordering;

/// Whether a condition holds.
pub(super) fn holds(condition: &Condition, scope: &Scope) -> Result<bool, Unknown> {
    scope.spend(1)?;
    match condition {
        Condition::Chain(first, links) => {
            let mut left = value_in(first, scope);
            let mut all = Ok(true);
            for (relation, right) in links {
                let right = value_in(right, scope);
                all = both(all, link(&left, *relation, &right));
                left = right;
            }
            all
        }
        // No early end: a part that is false decides, even after one that is not known.
        Condition::And(parts) => {
            let mut all = Ok(true);
            for part in parts {
                all = both(all, holds(part, scope));
            }
            all
        }
        Condition::Or(parts) => {
            let mut none = Ok(true);
            for part in parts {
                none = both(none, negation(holds(part, scope)));
            }
            negation(none)
        }
        Condition::Not(part) => negation(holds(part, scope)),
    }
}

/// Both hold: one that is false decides, whatever the other.
fn both(a: Result<bool, Unknown>, b: Result<bool, Unknown>) -> Result<bool, Unknown> {
    match (a, b) {
        (Ok(false), _) | (_, Ok(false)) => Ok(false),
        (Ok(true), Ok(true)) => Ok(true),
        (Err(why), _) | (_, Err(why)) => Err(why),
    }
}

fn negation(a: Result<bool, Unknown>) -> Result<bool, Unknown> {
    a.map(|holds| !holds)
}

fn link(
    left: &Result<Value, Unknown>,
    relation: Relation,
    right: &Result<Value, Unknown>,
) -> Result<bool, Unknown> {
    if matches!(left, Ok(Value::Undefined)) || matches!(right, Ok(Value::Undefined)) {
        return Ok(false);
    }
    match (left, right) {
        (Ok(left), Ok(right)) => relate(left, relation, right),
        (Err(why), _) | (_, Err(why)) => Err(why.clone()),
    }
}

/// Whether a relation holds of two values that are there.
pub(super) fn relate(left: &Value, relation: Relation, right: &Value) -> Result<bool, Unknown> {
    if let Some(ordering) = left.compare(right) {
        return relation_allows(relation, ordering);
    }
    // Enclosures that share an end only: the weak relation is settled all the same.
    if let (Some(a), Some(b)) = (left.finite(), right.finite()) {
        let less = a.high() <= b.low();
        let greater = a.low() >= b.high();
        match relation {
            Relation::LessEqual if less => return Ok(true),
            Relation::GreaterEqual if greater => return Ok(true),
            Relation::Less if greater => return relation_allows(relation, Ordering::Greater),
            Relation::Greater if less => return relation_allows(relation, Ordering::Less),
            _ => {}
        }
    }
    unknown("a relation is not settled at these bits")
}
