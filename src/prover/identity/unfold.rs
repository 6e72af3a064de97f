//! Means, variances and densities as what their definitions make of them, integrals not evaluated.

use super::Builder;
use super::evaluate::{Context, Value, evaluate};
use super::matching::{map_quantities, with_quantities};
use super::{law, support};
use crate::formula::{Formula, RangeKind};
use crate::kernel::proof::{Fact, Rule, Step};

/// The formula with its means, variances and densities unfolded.
pub(super) fn unfolded(b: &mut Builder, cx: &mut Context, e: &Formula) -> Option<Value> {
    with_quantities(b, e, &mut |b, q| quantity(b, cx, q))
}

fn quantity(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    let (next, first) = match q {
        Formula::Mean(_, None) | Formula::Variance(_, None) | Formula::Probability(..) => {
            law::own_draw(b, q)?
        }
        Formula::Mean(_, Some(_)) => law::by_density(b, cx, q)?,
        Formula::Density(..) => return law::by_density(b, cx, q),
        Formula::Variance(_, Some(_)) => law::by_moments(b, q)?,
        Formula::Ranged(r) if r.kind == RangeKind::Integral => support::narrowed(b, cx, r)?,
        _ => return None,
    };
    let (found, second) = unfolded(b, cx, &next)?;
    let step = b.chain(&[first, second], q, &found)?;
    Some((found, step))
}

/// States that neither formula has a value: a variance has none where the mean is infinite.
pub(super) fn undefined(
    b: &mut Builder,
    cx: &mut Context,
    x: &Formula,
    y: &Formula,
) -> Option<Step> {
    let (u, first) = without(b, cx, x)?;
    let (v, last) = without(b, cx, y)?;
    let middle = b.step(Fact::Same(u.clone(), v.clone()), Rule::None, &[], &[])?;
    b.chain(&[first, middle, last], x, y)
}

/// A formula of the same value that is seen to have none.
fn without(b: &mut Builder, cx: &mut Context, e: &Formula) -> Option<Value> {
    let found = b.attempt(|b| {
        let (own, step) = with_quantities(b, e, &mut law::own_draw)?;
        map_quantities(&own, &mut |q| {
            b.attempt(|b| law::without_variance(b, cx, q));
            q.clone()
        });
        b.undefined(&own)?;
        Some((own, step))
    });
    found.or_else(|| {
        [evaluate, plain].into_iter().find_map(|way| {
            b.attempt(|b| {
                let (found, step) = way(b, cx, e)?;
                b.undefined(&found)?;
                Some((found, step))
            })
        })
    })
}

/// The formula evaluated, with powers of powers and roots taken together.
pub(super) fn plain(b: &mut Builder, cx: &mut Context, e: &Formula) -> Option<Value> {
    let (found, first) = evaluate(b, cx, e)?;
    let (plain, second) = b.without_towers(&found)?;
    let step = b.chain(&[first, second], e, &plain)?;
    Some((plain, step))
}
