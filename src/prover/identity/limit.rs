//! Limits of means over beta laws.

use super::Builder;
use super::evaluate::{Context, Value, then};
use super::make::{int, var};
use super::range::on_closed;
use crate::formula::{Draw, Formula, Law, Name, substitute};
use crate::kernel::proof::{Fact, Rule};

/// The mean over the law that the laws tend to.
pub(super) fn value(
    b: &mut Builder,
    cx: &mut Context,
    e: &Formula,
    places: &[(Name, Formula)],
) -> Option<Value> {
    let q = Formula::Limit(Box::new(e.clone()), places.to_vec());
    let Formula::Mean(inner, Some(draw)) = e else {
        return None;
    };
    let Law::Beta(p, r) = &draw.law else {
        return None;
    };
    let (p, r) = (substitute(p, places).ok()?, substitute(r, places).ok()?);
    b.positive(&p)?;
    b.positive(&r)?;
    let finite = on_closed(b, &draw.name, (&int(0), &int(1)), |b, x| {
        let there = substitute(inner, &[(draw.name.clone(), var(x))]).ok()?;
        b.finite_step(&there)
    });
    let finite = finite?;
    let own = Draw {
        name: draw.name.clone(),
        law: Law::Beta(p, r),
    };
    let next = Formula::Mean(inner.clone(), Some(Box::new(own)));
    let step = b.step(
        Fact::Same(q.clone(), next.clone()),
        Rule::Limit,
        &[finite],
        &[],
    )?;
    then(b, cx, &q, (next, step))
}
