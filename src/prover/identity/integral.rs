//! The value of an integral: its body is simplified, then each tactic is tried in turn.

use super::Builder;
use super::atoms::exact;
use super::evaluate::{Context, Value, evaluate, has_quantity, then};
use super::integrand::Product;
use super::make::{depends, int, integral, is_one, is_zero, var};
use super::range::{body_at, rewritten, whole};
use super::substitution::by_argument;
use super::support::narrowed;
use super::{disc, primitive, substitution, weight};
use crate::formula::{Formula, Name, Ranged, substitute};
use crate::kernel::proof::{Fact, Rule, Step};

pub(super) fn value(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let tactics = [
        of_density,
        put_known,
        evaluate_body,
        narrowed,
        tidy_ends,
        at_a_point,
        by_argument,
        by_shape,
    ];
    tactics.into_iter().find_map(|tactic| {
        b.attempt(|b| {
            let next = tactic(b, cx, r)?;
            match &next.0 {
                Formula::Ranged(_) => then(b, cx, &whole(r), next),
                _ => Some(next),
            }
        })
    })
}

/// The integral of a density that is only given is 1.
fn of_density(b: &mut Builder, _: &mut Context, r: &Ranged) -> Option<Value> {
    let fact = Fact::Same(whole(r), int(1));
    let step = b.step(fact, Rule::Function, &[], &[])?;
    Some((int(1), step))
}

/// Puts the numbers that the case under way gives names.
fn put_known(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let e = whole(r);
    let known: Vec<_> = cx
        .known
        .iter()
        .filter(|(name, ..)| depends(&e, name))
        .cloned()
        .collect();
    if known.is_empty() {
        return None;
    }
    let values: Vec<_> = known
        .iter()
        .map(|(name, t, _)| (name.clone(), t.clone()))
        .collect();
    let steps: Vec<Step> = known.iter().map(|(_, _, step)| *step).collect();
    let next = substitute(&e, &values).ok()?;
    let step = b.congruent(&e, &next, &steps)?;
    Some((next, step))
}

/// Evaluates the quantities inside the body.
fn evaluate_body(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    match has_quantity(&r.body) {
        true => evaluated(b, cx, r),
        false => None,
    }
}

/// The integral once the quantities inside the body are evaluated, all of them.
pub(super) fn evaluated(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let found = rewritten(b, r, |b, _, body| evaluate(b, cx, body))?;
    match &found.0 {
        Formula::Ranged(next) if !has_quantity(&next.body) => Some(found),
        _ => None,
    }
}

/// The quantities in the ends are evaluated; ends that are numbers by arithmetic are written as such.
fn tidy_ends(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let mut steps = Vec::new();
    let mut tidied = |b: &mut Builder, end: &Formula| -> Option<Formula> {
        if has_quantity(end) {
            let (found, step) = evaluate(b, cx, end)?;
            steps.push(step);
            return Some(found);
        }
        let found = number_of(cx, end);
        match found {
            Some(found) if found != *end => {
                steps.push(b.equal(end, &found)?);
                Some(found)
            }
            _ => Some(end.clone()),
        }
    };
    let (from, to) = (tidied(b, &r.from)?, tidied(b, &r.to)?);
    if steps.is_empty() {
        return None;
    }
    let next = integral(r.body.clone(), &r.name, from, to);
    let step = b.congruent(&whole(r), &next, &steps)?;
    Some((next, step))
}

/// The integral from a number to itself is 0: that to any other is its own primitive.
fn at_a_point(b: &mut Builder, _: &mut Context, r: &Ranged) -> Option<Value> {
    (r.from == r.to).then_some(())?;
    let other = b.fresh(&format!("{}'", r.name));
    let body = body_at(r, &other)?;
    let to = |end: &Name| integral(body.clone(), &other, r.from.clone(), var(end));
    let (found, first) = primitive::by_primitive(b, r, &|end| Some(to(end)))?;
    let second = b.ring(&found, &int(0), &[])?;
    let step = b.chain(&[first, second], &whole(r), &int(0))?;
    Some((int(0), step))
}

/// The number that a formula without names is by simple arithmetic; roots of 0 and 1 too.
fn number_of(cx: &mut Context, e: &Formula) -> Option<Formula> {
    let tidy = cx.algebra.tidy(e);
    let trivial = |a: &Formula| is_zero(a) || is_one(a);
    match &tidy {
        Formula::Number(_) => Some(tidy),
        Formula::Call(crate::formula::Function::Sqrt, parts) if trivial(&parts[0]) => {
            Some(parts[0].clone())
        }
        Formula::Binary(crate::formula::Operator::Power, a, n)
            if trivial(a) && matches!(**n, Formula::Number(_) | Formula::Binary(..)) =>
        {
            Some((**a).clone())
        }
        _ => Some(super::form::number(&exact(e)?)),
    }
}

/// The tactic that the shape of the body asks for.
fn by_shape(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    if !depends(&r.body, &r.name) {
        return primitive::constant(b, r);
    }
    for tactic in [disc::value, primitive::sine] {
        if let Some(found) = b.attempt(|b| tactic(b, cx, r)) {
            return Some(found);
        }
    }
    let product = Product::of(&r.body, &r.name, &mut cx.algebra);
    if product.is_rational(&mut cx.algebra) {
        return primitive::laurent(b, cx, r);
    }
    if let Some(found) = b.attempt(|b| primitive::power(b, cx, r, &product)) {
        return Some(found);
    }
    if let Some(found) = b.attempt(|b| substitution::to_unit(b, cx, r, &product)) {
        return Some(found);
    }
    match primitive::is_unit(r) {
        true => weight::value(b, cx, r, &product),
        false => None,
    }
}
