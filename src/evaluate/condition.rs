//! The truth of conditions: by exact values, else by enclosures that lie apart. A side without value
//! makes its relation false.

use super::quantity::Quantity;
use super::scope::{Root, Scope};
use super::{Context, Failure, Outcome, closed, enclose, exact, undecided, unsupported};
use crate::formula::{Condition, Formula, Relation};
use crate::number::Interval;
use std::cmp::Ordering;

/// Precisions at which enclosures are compared.
const PRECISIONS: [u32; 4] = [64, 192, 768, 3072];

/// Whether the condition holds at the point.
///
/// # Errors
/// A [`Failure`] when neither exact values nor enclosures decide.
pub fn holds(condition: &Condition, context: &Context) -> Result<bool, Failure> {
    let root = Root::new(context);
    within(condition, &Scope::new(&root))
}

/// Whether the condition holds in the scope; variables of integration take their samples.
pub(super) fn within(condition: &Condition, scope: &Scope) -> Result<bool, Failure> {
    match condition {
        Condition::Chain(first, links) => chain(first, links, scope),
        Condition::And(parts) => any(parts, scope, false).map(|found| !found),
        Condition::Or(parts) => any(parts, scope, true),
        Condition::Not(inner) => Ok(!within(inner, scope)?),
    }
}

/// Whether a part is `wanted`; a part that cannot be told matters only if no other part is.
fn any(parts: &[Condition], scope: &Scope, wanted: bool) -> Result<bool, Failure> {
    let mut open = None;
    for part in parts {
        match within(part, scope) {
            Ok(truth) if truth == wanted => return Ok(true),
            Ok(_) => {}
            Err(failure) => open = Some(failure),
        }
    }
    open.map_or(Ok(false), Err)
}

fn chain(first: &Formula, links: &[(Relation, Formula)], scope: &Scope) -> Result<bool, Failure> {
    let mut left = first;
    let mut open = None;
    for (relation, right) in links {
        match related(left, *relation, right, scope) {
            Ok(true) => {}
            Ok(false) => return Ok(false),
            Err(failure) => open = Some(failure),
        }
        left = right;
    }
    open.map_or(Ok(true), Err)
}

fn related(
    left: &Formula,
    relation: Relation,
    right: &Formula,
    scope: &Scope,
) -> Result<bool, Failure> {
    scope.spend(1)?;
    let exactly = exact::sampled(left, scope)
        .and_then(|l| Ok((l, exact::sampled(right, scope)?)))
        .and_then(|(l, r)| {
            compare(l, r, |a, b| {
                closed::order(&closed_number(a)?, &closed_number(b)?)
            })
        });
    let order = match exactly {
        Ok(order) => order,
        Err(Failure::Exhausted) => return Err(Failure::Exhausted),
        Err(_) => enclosed_order(left, right, scope)?,
    };
    order.map_or(Ok(false), |order| satisfies(order, relation))
}

fn closed_number(quantity: Quantity) -> Result<crate::number::Exact, Failure> {
    quantity.closed("a condition")
}

/// How two outcomes compare; `None` when one has no value.
fn compare<T>(
    left: Outcome<T>,
    right: Outcome<T>,
    values: impl FnOnce(T, T) -> Result<Ordering, Failure>,
) -> Result<Option<Ordering>, Failure> {
    use Outcome::{MinusInfinity, PlusInfinity, Undefined, Value};
    Ok(Some(match (left, right) {
        (Undefined, _) | (_, Undefined) => return Ok(None),
        (Value(left), Value(right)) => values(left, right)?,
        (PlusInfinity, PlusInfinity) | (MinusInfinity, MinusInfinity) => Ordering::Equal,
        (PlusInfinity, _) | (_, MinusInfinity) => Ordering::Greater,
        (MinusInfinity, _) | (_, PlusInfinity) => Ordering::Less,
    }))
}

fn enclosed_order(
    left: &Formula,
    right: &Formula,
    scope: &Scope,
) -> Result<Option<Ordering>, Failure> {
    let mut last = undecided("a comparison");
    for precision in PRECISIONS {
        let left = enclose::within(left, scope, precision)?;
        let right = enclose::within(right, scope, precision)?;
        match compare(left, right, |a, b| separated(&a, &b)) {
            Ok(order) => return Ok(order),
            Err(failure) => last = failure,
        }
    }
    Err(last)
}

/// How two numbers compare whose enclosures lie apart or are the same point.
fn separated(a: &Interval, b: &Interval) -> Result<Ordering, Failure> {
    if a.high() < b.low() {
        return Ok(Ordering::Less);
    }
    if b.high() < a.low() {
        return Ok(Ordering::Greater);
    }
    if a.is_point() && b.is_point() && a.low() == b.low() {
        return Ok(Ordering::Equal);
    }
    Err(undecided("a comparison: the enclosures overlap"))
}

fn satisfies(order: Ordering, relation: Relation) -> Result<bool, Failure> {
    Ok(match relation {
        Relation::Equal => order.is_eq(),
        Relation::NotEqual => order.is_ne(),
        Relation::Less => order.is_lt(),
        Relation::LessEqual => order.is_le(),
        Relation::Greater => order.is_gt(),
        Relation::GreaterEqual => order.is_ge(),
        Relation::Asymptotic | Relation::Approximate => {
            return Err(unsupported("~ and =~ as a condition"));
        }
    })
}
