//! Variables that run through a range, and integrands rewritten under them.

use super::Builder;
use super::evaluate::Value;
use super::make::integral;
use crate::formula::{Formula, Function, Name, Operator, Ranged, substitute};
use crate::kernel::proof::{Fact, Rule, Step, Variable};

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

/// Runs `inside` for a new variable that may be any real number.
pub(super) fn on_line<T>(
    b: &mut Builder,
    base: &Name,
    inside: impl FnOnce(&mut Builder, &Name) -> Option<T>,
) -> Option<T> {
    let name = b.fresh(base);
    on_range(b, name, Vec::new(), inside)
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
    b.block(vec![variable], hypotheses.clone(), |b, _| {
        b.attempt(|b| above_zero(b, hypotheses.first()?));
        b.attempt(|b| below_root(b, hypotheses.last()?));
        inside(b, &name)
    })
}

/// What lies above an end that is not negative has its sign.
fn above_zero(b: &mut Builder, lower: &Fact) -> Option<Step> {
    let (Fact::Less(from, x) | Fact::AtMost(from, x)) = lower else {
        return None;
    };
    if matches!(from, Formula::Number(_) | Formula::Name(_)) {
        return None;
    }
    let rest = Formula::binary(Operator::Subtract, x.clone(), from.clone());
    let shown = Formula::binary(Operator::Add, rest, from.clone());
    let zero = Formula::integer(0);
    let strict = matches!(lower, Fact::Less(..));
    if (strict && b.nonnegative(from).is_some()) || (!strict && b.positive(from).is_some()) {
        return b.step(Fact::Less(zero, x.clone()), Rule::Order, &[], &[shown]);
    }
    b.nonnegative(from)?;
    b.step(Fact::AtMost(zero, x.clone()), Rule::Order, &[], &[shown])
}

/// What lies between `-sqrt(e)` and `sqrt(e)` has a square below e.
fn below_root(b: &mut Builder, upper: &Fact) -> Option<Step> {
    let (Fact::Less(x, root) | Fact::AtMost(x, root)) = upper else {
        return None;
    };
    let Formula::Call(Function::Sqrt, parts) = root else {
        return None;
    };
    let binary = Formula::binary;
    let below = binary(Operator::Subtract, root.clone(), x.clone());
    let above = binary(
        Operator::Subtract,
        x.clone(),
        Formula::Negate(Box::new(root.clone())),
    );
    let product = binary(Operator::Multiply, below, above);
    let square = binary(Operator::Power, x.clone(), Formula::integer(2));
    let rest = binary(Operator::Subtract, parts.first()?.clone(), square);
    let relation = |e: &Formula| match upper {
        Fact::Less(..) => Fact::Less(Formula::integer(0), e.clone()),
        _ => Fact::AtMost(Formula::integer(0), e.clone()),
    };
    b.finite(&product)?;
    let sign = b.step(relation(&product), Rule::Order, &[], &[])?;
    let same = b.equal(&product, &rest)?;
    b.step(relation(&rest), Rule::Chain, &[sign, same], &[])
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
    let mut found = None;
    let inside = |b: &mut Builder, x: &Name| {
        let (body, step) = rewrite(b, x, &body_at(r, x)?)?;
        found = Some((x.clone(), body));
        Some(step)
    };
    let step = on_inside(b, &r.name, (&r.from, &r.to), inside)?;
    let (name, body) = found?;
    let next = integral(body, &name, r.from.clone(), r.to.clone());
    let step = under(b, &whole(r), &next, step)?;
    Some((next, step))
}

/// Two integrals over the same range, whose bodies the step equates.
pub(super) fn under(b: &mut Builder, one: &Formula, other: &Formula, step: Step) -> Option<Step> {
    b.congruent(one, other, &[step])
}

/// A step for a variable between two ends, which may be equal: the ends are counted in unless they
/// are known to differ.
pub(super) fn on_inside(
    b: &mut Builder,
    base: &Name,
    (from, to): (&Formula, &Formula),
    inside: impl FnOnce(&mut Builder, &Name) -> Option<Step>,
) -> Option<Step> {
    let width = Formula::binary(Operator::Subtract, to.clone(), from.clone());
    match b.positive(&width) {
        Some(()) => on_open(b, base, (from, to), inside),
        None => {
            b.nonnegative(&width)?;
            on_closed(b, base, (from, to), inside)
        }
    }
}
