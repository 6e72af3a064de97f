//! Integrals of one integrand between different ends, as differences of those from one lower end.

use super::Builder;
use super::evaluate::Context;
use super::make::{integral, replaced};
use super::matching::{integrals_of, settle};
use super::primitive::by_primitive;
use super::range::{body_at, whole};
use crate::formula::{Formula, Ranged};
use crate::kernel::proof::Step;

/// `x == y` once all integrals of the integrand of one of them are from its lower end.
pub(super) fn from_one_end(
    b: &mut Builder,
    _: &mut Context,
    x: &Formula,
    y: &Formula,
) -> Option<Step> {
    let mut all = Vec::new();
    integrals_of(x, &mut all);
    integrals_of(y, &mut all);
    all.iter().find_map(|model| {
        b.attempt(|b| {
            let (mut u, mut v, mut steps) = (x.clone(), y.clone(), Vec::new());
            for r in all.iter().filter(|r| is_moved(r, model)) {
                let from_there =
                    |end| integral(model.body.clone(), &model.name, model.from.clone(), end);
                let (found, step) =
                    by_primitive(b, r, &|x| Some(from_there(Formula::Name(x.clone()))))?;
                u = replaced(&u, &whole(r), &found);
                v = replaced(&v, &whole(r), &found);
                steps.push(step);
            }
            let first = b.congruent(x, &u, &steps)?;
            let last = b.congruent(y, &v, &steps)?;
            settle(b, &u);
            settle(b, &v);
            let middle = b.equal(&u, &v)?;
            b.chain(&[first, middle, last], x, y)
        })
    })
}

/// Whether an integral has the integrand of the model, and another lower end.
fn is_moved(r: &Ranged, model: &Ranged) -> bool {
    r.from != model.from && body_at(r, &model.name).as_ref() == Some(&model.body)
}
