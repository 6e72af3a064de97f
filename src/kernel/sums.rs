//! Sums, suprema and infima over finite integer ranges, term by term.
//!
//! An empty range `a..a-1` sums to 0; a reversed one is refused, and a range with an infinite end
//! needs a proof, not a value.

use super::interval::{Interval, Value};
use super::scope::{Binding, Scope};
use super::value::value_in;
use super::{Unknown, unknown};
use crate::formula::{RangeKind, Ranged};
use num_traits::{One, Signed, ToPrimitive};

/// No range of more terms is walked.
const TERMS_CAP: u64 = 100_000;

/// Calls `visit` with the range's name bound to every integer of the range in turn.
pub(super) fn each<'a>(
    range: &Ranged,
    scope: &Scope<'a>,
    mut visit: impl FnMut(&Scope<'a>) -> Result<(), Unknown>,
) -> Result<(), Unknown> {
    let (from, to) = (value_in(&range.from, scope)?, value_in(&range.to, scope)?);
    let (Some(from), Some(to)) = (from.finite(), to.finite()) else {
        return unknown("a range without finite ends");
    };
    let (Some(from), Some(to)) = (from.as_integer(), to.as_integer()) else {
        return unknown("a range whose ends are not exact integers");
    };
    let count = to - from + num_bigint::BigInt::one();
    if count.is_negative() {
        return unknown("a reversed range");
    }
    match count.to_u64() {
        Some(count) if count <= TERMS_CAP => {
            for j in 0..count {
                let index = super::functions::integer(&(from + j));
                visit(&scope.with(&range.name, Binding::Number(index)))?;
            }
            Ok(())
        }
        _ => unknown("a range of too many terms"),
    }
}

/// The value of a sum, supremum or infimum. One term without value leaves none to a sum.
pub(super) fn ranged(range: &Ranged, scope: &Scope) -> Result<Value, Unknown> {
    let mut result: Option<Value> = None;
    each(range, scope, |inner| {
        let term = value_in(&range.body, inner)?;
        result = Some(match result.take() {
            None => term,
            Some(so_far) => combined(range.kind, &so_far, &term, scope.bits)?,
        });
        Ok(())
    })?;
    match (result, range.kind) {
        (Some(Value::Undefined), RangeKind::Supremum | RangeKind::Infimum) => {
            unknown("a bound over terms of which one has no value")
        }
        (Some(value), _) => Ok(value),
        (None, RangeKind::Sum) => Ok(Value::exact(0)),
        (None, _) => unknown("a bound over an empty range"),
    }
}

fn combined(kind: RangeKind, a: &Value, b: &Value, bits: u64) -> Result<Value, Unknown> {
    if kind == RangeKind::Sum {
        return Ok(a.plus(b, bits));
    }
    match (a.finite(), b.finite()) {
        (Some(a), Some(b)) => Ok(pick(kind, &a, &b).into()),
        _ => unknown("a bound over terms that are not all finite"),
    }
}

fn pick(kind: RangeKind, a: &Interval, b: &Interval) -> Interval {
    match kind {
        RangeKind::Infimum => a.minimum(b),
        _ => a.maximum(b),
    }
}
