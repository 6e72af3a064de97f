//! Variables that run through a range, and integrands rewritten under them.

use super::Builder;
use super::evaluate::Value;
use super::make::integral;
use crate::formula::{Formula, Name, Ranged, substitute};
use crate::kernel::proof::{Fact, Step, Variable};

/// Runs `inside` for a new variable between two ends.
pub(super) fn on_open<T>(
    b: &mut Builder,
    base: &Name,
    (from, to): (&Formula, &Formula),
    inside: impl FnOnce(&mut Builder, &Name) -> Option<T>,
) -> Option<T> {
    let name = b.fresh(base);
    let x = Formula::Name(name.clone());
    let hypotheses = vec![
        Fact::Less(from.clone(), x.clone()),
        Fact::Less(x, to.clone()),
    ];
    on_range(b, name, hypotheses, inside)
}

/// The same with the ends counted in.
pub(super) fn on_closed<T>(
    b: &mut Builder,
    base: &Name,
    (from, to): (&Formula, &Formula),
    inside: impl FnOnce(&mut Builder, &Name) -> Option<T>,
) -> Option<T> {
    let name = b.fresh(base);
    let x = Formula::Name(name.clone());
    let hypotheses = vec![
        Fact::AtMost(from.clone(), x.clone()),
        Fact::AtMost(x, to.clone()),
    ];
    on_range(b, name, hypotheses, inside)
}

fn on_range<T>(
    b: &mut Builder,
    name: Name,
    hypotheses: Vec<Fact>,
    inside: impl FnOnce(&mut Builder, &Name) -> Option<T>,
) -> Option<T> {
    let variable = Variable {
        name: name.clone(),
        integer: false,
    };
    b.block(vec![variable], hypotheses, |b, _| inside(b, &name))
}

/// The body of an integral with another name for its variable.
pub(super) fn body_at(r: &Ranged, x: &Name) -> Option<Formula> {
    substitute(&r.body, &[(r.name.clone(), Formula::Name(x.clone()))]).ok()
}

pub(super) fn whole(r: &Ranged) -> Formula {
    Formula::Ranged(Box::new(r.clone()))
}

/// The integral with a new body: `rewrite` gives it for a variable between the ends, with the
/// step that says that it has the value of the old one.
pub(super) fn rewritten(
    b: &mut Builder,
    r: &Ranged,
    rewrite: impl FnOnce(&mut Builder, &Name, &Formula) -> Option<Value>,
) -> Option<Value> {
    let (name, body, step) = on_open(b, &r.name, (&r.from, &r.to), |b, x| {
        let (body, step) = rewrite(b, x, &body_at(r, x)?)?;
        Some((x.clone(), body, step))
    })?;
    let next = integral(body, &name, r.from.clone(), r.to.clone());
    let step = under(b, &whole(r), &next, step, (&r.from, &r.to))?;
    Some((next, step))
}

/// Two integrals over the same range, whose bodies the step equates.
pub(super) fn under(
    b: &mut Builder,
    one: &Formula,
    other: &Formula,
    step: Step,
    (from, to): (&Formula, &Formula),
) -> Option<Step> {
    let width = Formula::binary(crate::formula::Operator::Subtract, to.clone(), from.clone());
    b.positive(&width)?;
    b.congruent(one, other, &[step])
}
