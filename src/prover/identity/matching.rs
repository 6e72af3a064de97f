//! Two formulas that are alike but for parts that are shown equal one by one: integrals over the
//! same range by their integrands, be they finite or not.

use super::Builder;
use super::evaluate::{Context, Value, evaluate, has_quantity};
use super::integral::evaluated;
use super::integrand::Product;
use super::make::{integral, map_parts, parts, replaced};
use super::range::{body_at, on_inside, under, whole};
use super::substitution;
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
            b.attempt(|b| integrals(b, cx, r, s))
                .or_else(|| b.attempt(|b| substituted(b, cx, (x, r), y)))
                .or_else(|| {
                    let back = substituted(b, cx, (y, s), x)?;
                    b.chain(&[back], x, y)
                })
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
fn settle(b: &mut Builder, e: &Formula) {
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

/// The first integral brought to 0..1 by the distribution function in it, be it finite or not.
fn substituted(
    b: &mut Builder,
    cx: &mut Context,
    (x, r): (&Formula, &Ranged),
    y: &Formula,
) -> Option<Step> {
    if has_quantity(&r.body) {
        let (next, first) = evaluated(b, cx, r)?;
        let Formula::Ranged(s) = &next else {
            return None;
        };
        let second = substituted(b, cx, (&next, s), y)?;
        return b.chain(&[first, second], x, y);
    }
    let product = Product::of(&r.body, &r.name, &mut cx.algebra);
    let (next, first) = substitution::to_unit(b, cx, r, &product)?;
    let second = same(b, cx, &next, y)?;
    b.chain(&[first, second], x, y)
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

fn integrals_of(e: &Formula, found: &mut Vec<Ranged>) {
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
