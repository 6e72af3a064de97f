//! Integrals of an indicator times something, which run over the indicator's range.

use super::Builder;
use super::evaluate::Value;
use super::make::{integral, is_one, map_parts, parts, replaced};
use super::range::{on_open, rewritten, whole};
use crate::formula::{Condition, Formula, Operator, Ranged, Relation};
use crate::kernel::proof::{Fact, Rule};

use Operator::{Multiply, Subtract};

/// The integral over the range of the indicator in its body.
pub(super) fn narrowed(b: &mut Builder, r: &Ranged) -> Option<Value> {
    find(&r.body)?;
    let (next, first) = rewritten(b, r, |b, _, body| {
        let indicator = find(body)?.clone();
        let rest = without_ones(&replaced(body, &indicator, &Formula::integer(1)));
        let new = Formula::binary(Multiply, indicator, rest);
        let step = b.equal(body, &new)?;
        Some((new, step))
    })?;
    let Formula::Ranged(cut) = &next else {
        return None;
    };
    let Formula::Binary(Multiply, indicator, rest) = &cut.body else {
        return None;
    };
    let (from, to) = range_of(indicator, &Formula::Name(cut.name.clone()))?;
    for (low, high) in [(&r.from, from), (from, to), (to, &r.to)] {
        b.nonnegative(&Formula::binary(Subtract, high.clone(), low.clone()))?;
    }
    b.positive(&Formula::binary(Subtract, to.clone(), from.clone()))?;
    let narrow = Ranged {
        body: (**rest).clone(),
        from: from.clone(),
        to: to.clone(),
        ..(**cut).clone()
    };
    let finite = on_open(b, &cut.name, (&r.from, &r.to), |b, x| {
        b.finite_step(&super::range::body_at(&narrow, x)?)
    })?;
    let narrow = integral(narrow.body, &narrow.name, narrow.from, narrow.to);
    let fact = Fact::Same(next.clone(), narrow.clone());
    let second = b.step(fact, Rule::Indicator, &[finite], &[])?;
    let step = b.chain(&[first, second], &whole(r), &narrow)?;
    Some((narrow, step))
}

/// The indicator among the factors of a product.
fn find(e: &Formula) -> Option<&Formula> {
    match e {
        Formula::Indicator(_) => Some(e),
        Formula::Binary(Multiply | Operator::Divide, ..) => parts(e).into_iter().find_map(find),
        _ => None,
    }
}

/// The ends of `a < x < b`.
fn range_of<'a>(indicator: &'a Formula, x: &Formula) -> Option<(&'a Formula, &'a Formula)> {
    let Formula::Indicator(condition) = indicator else {
        return None;
    };
    match &**condition {
        Condition::Chain(from, links) => match links.as_slice() {
            [(Relation::Less, middle), (Relation::Less, to)] if middle == x => Some((from, to)),
            _ => None,
        },
        _ => None,
    }
}

fn without_ones(e: &Formula) -> Formula {
    match map_parts(e, &mut without_ones) {
        Formula::Binary(Multiply, a, b) if is_one(&a) => *b,
        Formula::Binary(Multiply, a, b) if is_one(&b) => *a,
        other => other,
    }
}
