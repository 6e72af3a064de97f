//! Two formulas that are alike but for parts that are shown equal one by one: integrals over the
//! same range by their integrands, be they finite or not.

use super::Builder;
use super::evaluate::{Context, Value, evaluate, has_quantity};
use super::integrand::Product;
use super::make::{integral, map_parts, parts, replaced};
use super::primitive::is_unit;
use super::range::{body_at, on_inside, rewritten, under, whole};
use super::substitution::{by_ends, to_unit};
use super::weight::{continuous, scaled};
use crate::formula::{Condition, Formula, Operator, RangeKind, Ranged};
use crate::kernel::proof::Step;

/// States that two formulas have the same value.
pub(super) fn same(b: &mut Builder, cx: &mut Context, x: &Formula, y: &Formula) -> Option<Step> {
    if x == y {
        return b.congruent(x, y, &[]);
    }
    for side in [x, y] {
        settle(b, side);
    }
    if let Some(step) = b.equal(x, y) {
        return Some(step);
    }
    b.attempt(|b| match (x, y) {
        (Formula::Ranged(r), Formula::Ranged(s))
            if r.kind == RangeKind::Integral && s.kind == RangeKind::Integral =>
        {
            let direct = b.attempt(|b| integrals(b, cx, r, s));
            direct.or_else(|| aligned(b, cx, r, s))
        }
        (Formula::Indicator(c), Formula::Indicator(d)) => {
            let mut steps = Vec::new();
            conditions(b, c, d, &mut steps)?;
            b.congruent(x, y, &steps)
        }
        (Formula::Negate(a), Formula::Negate(c)) => {
            let step = same(b, cx, a, c)?;
            b.congruent(x, y, &[step])
        }
        (Formula::Binary(o, a, c), Formula::Binary(p, d, e)) if o == p => {
            let steps = [same(b, cx, a, d)?, same(b, cx, c, e)?];
            b.congruent(x, y, &steps)
        }
        _ => None,
    })
}

/// Makes it known of the integrals in a formula that they are finite, where they are continuous.
pub(super) fn settle(b: &mut Builder, e: &Formula) {
    match e {
        Formula::Ranged(r) if r.kind == RangeKind::Integral => {
            b.attempt(|b| continuous(b, e));
        }
        _ => parts(e).into_iter().for_each(|part| settle(b, part)),
    }
}

/// Equations between the sides of two conditions, relation by relation.
fn conditions(b: &mut Builder, c: &Condition, d: &Condition, steps: &mut Vec<Step>) -> Option<()> {
    match (c, d) {
        (Condition::And(p), Condition::And(q)) => {
            let mut pairs = p.iter().zip(q);
            pairs.try_for_each(|(c, d)| conditions(b, c, d, steps))
        }
        (Condition::Chain(x, links), Condition::Chain(y, others)) => {
            let pairs = links.iter().zip(others).map(|((_, x), (_, y))| (x, y));
            for (x, y) in std::iter::once((x, y)).chain(pairs) {
                steps.push(b.equal(x, y)?);
            }
            Some(())
        }
        _ => None,
    }
}

/// Integrals with equal ends and integrands that are equal between them.
fn integrals(b: &mut Builder, cx: &mut Context, r: &Ranged, s: &Ranged) -> Option<Step> {
    let ends = [(&r.from, &s.from), (&r.to, &s.to)];
    let steps: Vec<Step> = ends
        .into_iter()
        .map(|(end, other)| same(b, cx, end, other))
        .collect::<Option<_>>()?;
    let moved = Ranged {
        from: r.from.clone(),
        to: r.to.clone(),
        ..s.clone()
    };
    let back = b.congruent(&whole(&moved), &whole(s), &steps)?;
    let step = on_inside(b, &r.name, (&r.from, &r.to), |b, x| {
        bodies(b, cx, &body_at(r, x)?, &body_at(&moved, x)?)
    })?;
    let step = under(b, &whole(r), &whole(&moved), step)?;
    b.chain(&[step, back], &whole(r), &whole(s))
}

/// Integrals that are alike once both run from 0 to 1.
fn aligned(b: &mut Builder, cx: &mut Context, r: &Ranged, s: &Ranged) -> Option<Step> {
    let (u, first) = over_unit(b, cx, r)?;
    let (v, last) = over_unit(b, cx, s)?;
    let (Formula::Ranged(p), Formula::Ranged(q)) = (&u, &v) else {
        return None;
    };
    (**p != *r || **q != *s).then_some(())?;
    let middle = integrals(b, cx, p, q)?;
    b.chain(&[first, middle, last], &whole(r), &whole(s))
}

/// The integral over 0..1, its body evaluated.
fn over_unit(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let (next, first) = match has_quantity(&r.body) {
        true => rewritten(b, r, |b, _, body| evaluate(b, cx, body))?,
        false => (whole(r), b.chain(&[], &whole(r), &whole(r))?),
    };
    let Formula::Ranged(own) = &next else {
        return None;
    };
    let product = Product::of(&own.body, &own.name, &mut cx.algebra);
    let (found, second) = match b.attempt(|b| to_unit(b, cx, own, &product)) {
        Some(found) => found,
        None if is_unit(own) => return Some((next, first)),
        None => by_ends(b, cx, own, &product)?,
    };
    let step = b.chain(&[first, second], &whole(r), &found)?;
    Some((found, step))
}

fn bodies(b: &mut Builder, cx: &mut Context, x: &Formula, y: &Formula) -> Option<Step> {
    if !has_quantity(x) && !has_quantity(y) {
        return same(b, cx, x, y);
    }
    let (u, first) = evaluate(b, cx, x)?;
    let (v, last) = evaluate(b, cx, y)?;
    let middle = same(b, cx, &u, &v)?;
    b.chain(&[first, middle, last], x, y)
}

/// The second formula with its integrals written as multiples of those in the first, where they are.
pub(super) fn unified(
    b: &mut Builder,
    cx: &mut Context,
    first: &Formula,
    second: &Formula,
) -> Option<Value> {
    let (mut models, mut others) = (Vec::new(), Vec::new());
    integrals_of(first, &mut models);
    integrals_of(second, &mut others);
    let mut found = second.clone();
    let mut steps = Vec::new();
    for other in others {
        if models.contains(&other) {
            continue;
        }
        let multiple = models
            .iter()
            .find_map(|model| b.attempt(|b| proportional(b, cx, &other, model)));
        if let Some((value, step)) = multiple {
            found = replaced(&found, &Formula::Ranged(Box::new(other)), &value);
            steps.push(step);
        }
    }
    let step = b.congruent(second, &found, &steps)?;
    Some((found, step))
}

pub(super) fn integrals_of(e: &Formula, found: &mut Vec<Ranged>) {
    match e {
        Formula::Ranged(r) if r.kind == RangeKind::Integral => {
            if !found.contains(r) {
                found.push((**r).clone());
            }
        }
        _ => parts(e)
            .into_iter()
            .for_each(|part| integrals_of(part, found)),
    }
}

/// `int(e) == c*int(model)`
fn proportional(b: &mut Builder, cx: &mut Context, r: &Ranged, model: &Ranged) -> Option<Value> {
    if (&r.from, &r.to) != (&model.from, &model.to) {
        return None;
    }
    let body = body_at(model, &r.name)?;
    let ratio = Formula::binary(Operator::Divide, r.body.clone(), body);
    let c = cx.algebra.tidy(&ratio);
    if super::make::depends(&c, &r.name) {
        return None;
    }
    let (rest, step) = scaled(b, r, &c, &|x| body_at(model, x))?;
    let (product, own) = (
        Formula::binary(Operator::Multiply, c.clone(), rest.clone()),
        integral(
            model.body.clone(),
            &model.name,
            model.from.clone(),
            model.to.clone(),
        ),
    );
    let found = Formula::binary(Operator::Multiply, c, own);
    // The two differ in the name of their variable.
    let last = b.congruent(&product, &found, &[])?;
    let step = b.chain(&[step, last], &whole(r), &found)?;
    Some((found, step))
}

/// The formula with each of its quantities mapped.
pub(super) fn map_quantities(e: &Formula, map: &mut dyn FnMut(&Formula) -> Formula) -> Formula {
    match super::evaluate::is_quantity(e) {
        true => map(e),
        false => map_parts(e, &mut |part| map_quantities(part, map)),
    }
}

/// The formula with each of its quantities replaced by what is found for it, as far as that is.
pub(super) fn with_quantities(
    b: &mut Builder,
    e: &Formula,
    find: &mut dyn FnMut(&mut Builder, &Formula) -> Option<Value>,
) -> Option<Value> {
    let mut steps = Vec::new();
    let found = map_quantities(e, &mut |q| match b.attempt(|b| find(b, q)) {
        Some((found, step)) => {
            steps.push(step);
            found
        }
        None => q.clone(),
    });
    let step = b.congruent(e, &found, &steps)?;
    Some((found, step))
}
