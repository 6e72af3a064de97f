//! Integrals of what a condition cuts off: they run over the range where it holds.

use super::Builder;
use super::decide::degree;
use super::evaluate::{Context, Value};
use super::make::{depends, div, int, integral, is_one, is_zero, map_parts, parts, pow, sub};
use super::range::{body_at, on_open, rewritten, whole};
use crate::formula::{Condition, Formula, Function, Name, Operator, Ranged};
use crate::kernel::proof::{Fact, Rule, Step};

use Operator::{Divide, Multiply, Subtract};

/// The integral with the conditions in its body decided, over the part of its range where it is not 0.
pub(super) fn narrowed(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let condition = find(&r.body)?;
    if let Some(found) = b.attempt(|b| rewritten(b, r, |b, _, body| decided(b, body))) {
        return Some(found);
    }
    let mut ranges = Vec::new();
    match places(cx, condition, &r.name)?.as_slice() {
        [place] => {
            ranges.push((r.from.clone(), place.clone()));
            ranges.push((place.clone(), r.to.clone()));
        }
        [low, high] => ranges.push((low.clone(), high.clone())),
        _ => {}
    }
    let mut ranges = ranges.iter();
    ranges.find_map(|(from, to)| b.attempt(|b| supported(b, r, (from, to))))
}

/// The integral from one place to the other, outside of which the body is 0.
fn supported(b: &mut Builder, r: &Ranged, (from, to): (&Formula, &Formula)) -> Option<Value> {
    for (low, high) in [(&r.from, from), (from, to), (to, &r.to)] {
        let width = Formula::binary(Subtract, high.clone(), low.clone());
        b.nonnegative(&width)?;
    }
    let (x, body, step) = on_open(b, &r.name, (from, to), |b, x| {
        clear(b, x, (from, to));
        let (body, step) = decided(b, &body_at(r, x)?)?;
        Some((x.clone(), body, step))
    })?;
    let mut premises = vec![step];
    for (low, high) in [(&r.from, from), (to, &r.to)] {
        if low != high {
            premises.push(on_open(b, &r.name, (low, high), |b, x| {
                clear(b, x, (low, high));
                let body = body_at(r, x)?;
                let (found, step) = decided(b, &body)?;
                let zero = b.equal(&found, &int(0))?;
                b.chain(&[step, zero], &body, &int(0))
            })?);
        }
    }
    let found = integral(body, &x, from.clone(), to.clone());
    let fact = Fact::Same(whole(r), found.clone());
    let step = b.step(fact, Rule::Support, &premises, &[])?;
    Some((found, step))
}

/// Makes it known on which side of ends that are quotients the variable is, without the quotients.
fn clear(b: &mut Builder, x: &Name, (from, to): (&Formula, &Formula)) {
    let x = Formula::Name(x.clone());
    for (low, high, end) in [(from, &x, from), (&x, to, to)] {
        if let Formula::Binary(Divide, above, below) = end {
            b.attempt(|b| {
                b.positive(below)?;
                let times = Formula::binary(Multiply, x.clone(), (**below).clone());
                let distance = Formula::binary(Subtract, high.clone(), low.clone());
                let shown = Formula::binary(Multiply, (**below).clone(), distance);
                let fact = match end == low {
                    true => Fact::Less((**above).clone(), times),
                    false => Fact::Less(times, (**above).clone()),
                };
                b.step(fact, Rule::Order, &[], &[shown])
            });
        }
    }
}

/// The formula with the conditions in it decided.
fn decided(b: &mut Builder, e: &Formula) -> Option<Value> {
    let mut steps = Vec::new();
    let next = decide_in(b, e, &mut steps);
    (!steps.is_empty()).then_some(())?;
    let first = b.congruent(e, &next, &steps)?;
    let short = without_ones(&next);
    match b.attempt(|b| b.equal(&next, &short)) {
        Some(second) => {
            let step = b.chain(&[first, second], e, &short)?;
            Some((short, step))
        }
        None => Some((next, first)),
    }
}

fn decide_in(b: &mut Builder, e: &Formula, steps: &mut Vec<Step>) -> Formula {
    match e {
        Formula::Indicator(_) => match b.attempt(|b| b.decided(e)) {
            Some((found, step)) => {
                steps.push(step);
                found
            }
            None => e.clone(),
        },
        _ => map_parts(e, &mut |part| decide_in(b, part, steps)),
    }
}

/// The condition among the factors of a product.
fn find(e: &Formula) -> Option<&Condition> {
    match e {
        Formula::Indicator(condition) => Some(condition),
        Formula::Binary(Multiply | Divide, ..) => parts(e).into_iter().find_map(find),
        _ => None,
    }
}

/// The numbers at which the relations of a chain change, in its order.
fn places(cx: &mut Context, condition: &Condition, x: &Name) -> Option<Vec<Formula>> {
    let Condition::Chain(first, links) = condition else {
        return None;
    };
    let mut left = first;
    let mut found = Vec::new();
    for (_, right) in links {
        found.push(match depends(left, x) {
            true => place(cx, left, right, x)?,
            false => place(cx, right, left, x)?,
        });
        left = right;
    }
    Some(found)
}

/// The number at which e is as large as another formula.
fn place(cx: &mut Context, e: &Formula, other: &Formula, x: &Name) -> Option<Formula> {
    match (degree(e), e) {
        (Some(d), Formula::Binary(_, base, _)) => place(cx, base, &pow(other.clone(), d), x),
        (Some(d), Formula::Call(Function::Sqrt, parts)) => {
            place(cx, parts.first()?, &pow(other.clone(), d), x)
        }
        _ => {
            let powers = cx.algebra.in_powers(e, x)?;
            (*powers.keys().next_back()? == 1).then_some(())?;
            let origin = powers.get(&0).cloned().unwrap_or(int(0));
            let found = div(sub(other.clone(), origin), powers.get(&1)?.clone());
            (!depends(&found, x)).then_some(found)
        }
    }
}

fn without_ones(e: &Formula) -> Formula {
    match map_parts(e, &mut without_ones) {
        Formula::Binary(Multiply, a, b) if is_one(&a) || is_zero(&b) => *b,
        Formula::Binary(Multiply, a, b) if is_one(&b) || is_zero(&a) => *a,
        other => other,
    }
}
