//! The top: every link of a statement, by the cheapest way that proves it.

use super::Builder;
use super::additive::from_one_end;
use super::evaluate::{Context, evaluate};
use super::linear::{in_moments, linear};
use super::matching::{same, settle, unified};
use super::powers::has_towers;
use super::slope::by_slope;
use super::unfold::{plain, undefined, unfolded};
use crate::formula::{Formula, Name, Point, Proposition, Relation, Statement};
use crate::kernel::proof::{Fact, Script, Step};

/// Cases within cases.
const SPLITS: usize = 2;

/// A certificate for the links of the proposition that the tactics prove, with the first of the
/// examples that shows something.
pub fn prove(proposition: &Proposition, examples: &[Point]) -> Option<Script> {
    let mut b = Builder::new(proposition);
    let mut cx = Context::default();
    let mut proved = Vec::new();
    let mut at = 0;
    let statement = proposition.pointwise();
    chains(&statement, &mut |first, links| {
        let mut left = first;
        for (relation, right) in links {
            let step = match relation {
                Relation::Equal => link(&mut b, &mut cx, (first, left, right)),
                _ => Fact::of_relation(left, *relation, right).and_then(|fact| b.relation(&fact)),
            };
            if let Some(step) = step {
                settle(&mut b, left);
                settle(&mut b, right);
                proved.push((at, step));
            }
            at += 1;
            left = right;
        }
    });
    if proved.is_empty() {
        return None;
    }
    let scripts = examples.iter();
    let mut scripts = scripts.map(|example| b.clone().script(proved.clone(), example.clone()));
    scripts.find_map(|script| script)
}

type Links = [(Relation, Formula)];

/// The chains of a statement, in order.
fn chains<'a>(statement: &'a Statement, each: &mut dyn FnMut(&'a Formula, &'a Links)) {
    match statement {
        Statement::Chain { first, links, .. } => each(first, links),
        Statement::All(parts) => parts.iter().for_each(|part| chains(part, each)),
        _ => {}
    }
}

/// `left == right`, or by way of the chain's first formula.
fn link(
    b: &mut Builder,
    cx: &mut Context,
    (first, left, right): (&Formula, &Formula, &Formula),
) -> Option<Step> {
    if let Some(step) = b.attempt(|b| equation(b, cx, left, right)) {
        return Some(step);
    }
    if first == left {
        return None;
    }
    b.attempt(|b| {
        let whole = equation(b, cx, first, right)?;
        let before = equation(b, cx, first, left)?;
        b.chain(&[before, whole], left, right)
    })
}

/// `x == y`, where needed by cases at the border of the domain.
fn equation(b: &mut Builder, cx: &mut Context, x: &Formula, y: &Formula) -> Option<Step> {
    let fact = Fact::Same(x.clone(), y.clone());
    // What is found on the way is the case's own business.
    let shown = [x, y].map(|side| match plain(&mut b.clone(), cx, side) {
        Some((found, _)) => found,
        None => side.clone(),
    });
    b.by_cases(&fact, &shown, SPLITS, &mut |b| {
        let outside = std::mem::take(&mut cx.known);
        cx.known = known(b);
        cx.forget();
        let found = direct(b, cx, x, y);
        cx.known = outside;
        found
    })
}

/// Names that the case gives a value: squeezed by a number, or by a name that has a value.
fn known(b: &mut Builder) -> Vec<(Name, Formula, Step)> {
    let mut bounds: Vec<(Name, Formula)> = b
        .relations()
        .filter_map(|relation| match &relation.fact {
            Fact::AtMost(Formula::Name(name), bound) => Some((name.clone(), bound.clone())),
            _ => None,
        })
        .collect();
    let mut known = Vec::new();
    while let Some(found) = squeezed(b, &bounds, &known) {
        bounds.retain(|(name, _)| *name != found.0);
        known.push(found);
    }
    known
}

/// The next name with a value.
fn squeezed(
    b: &mut Builder,
    bounds: &[(Name, Formula)],
    known: &[(Name, Formula, Step)],
) -> Option<(Name, Formula, Step)> {
    bounds.iter().find_map(|(name, bound)| {
        let value = match bound {
            Formula::Number(_) => bound,
            Formula::Name(other) => &known.iter().find(|(name, ..)| name == other)?.1,
            _ => return None,
        };
        let step = b.squeeze(&Formula::Name(name.clone()), value)?;
        Some((name.clone(), value.clone(), step))
    })
}

/// `x == y` without cases.
pub(super) fn direct(b: &mut Builder, cx: &mut Context, x: &Formula, y: &Formula) -> Option<Step> {
    type Way = fn(&mut Builder, &mut Context, &Formula, &Formula) -> Option<Step>;
    let recurrence: Way = |b, _, x, y| b.recurrence(x, y);
    let ways: [Way; 9] = [
        same,
        recurrence,
        by_linearity,
        by_definition,
        by_value,
        by_plain_powers,
        from_one_end,
        by_slope,
        undefined,
    ];
    ways.into_iter()
        .find_map(|way| b.attempt(|b| way(b, cx, x, y)))
}

/// Both sides with constants taken out of their means and variances, then compared part by part; or
/// else with the variances as means.
fn by_linearity(b: &mut Builder, cx: &mut Context, x: &Formula, y: &Formula) -> Option<Step> {
    let (u, first) = linear(b, cx, x)?;
    let (v, last) = linear(b, cx, y)?;
    if let Some(middle) = b.attempt(|b| same(b, cx, &u, &v)) {
        return b.chain(&[first, middle, last], x, y);
    }
    let (p, second) = in_moments(b, &u)?;
    let (q, third) = in_moments(b, &v)?;
    let middle = b.equal(&p, &q)?;
    b.chain(&[first, second, middle, third, last], x, y)
}

/// Both sides with means, variances and densities unfolded, then compared part by part.
fn by_definition(b: &mut Builder, cx: &mut Context, x: &Formula, y: &Formula) -> Option<Step> {
    let (u, first) = unfolded(b, cx, x)?;
    let (v, last) = unfolded(b, cx, y)?;
    let middle = same(b, cx, &u, &v)?;
    b.chain(&[first, middle, last], x, y)
}

/// Both sides evaluated, then compared part by part.
fn by_value(b: &mut Builder, cx: &mut Context, x: &Formula, y: &Formula) -> Option<Step> {
    let (u, first) = evaluate(b, cx, x)?;
    let (v, second) = evaluate(b, cx, y)?;
    for (value, step) in [(&u, first), (&v, second)] {
        b.attempt(|b| b.finite_by(value, step));
    }
    let (w, third) = unified(b, cx, &u, &v)?;
    let middle = same(b, cx, &u, &w)?;
    b.chain(&[first, middle, third, second], x, y)
}

/// Both sides evaluated, with powers of powers and roots taken together, then compared.
fn by_plain_powers(b: &mut Builder, cx: &mut Context, x: &Formula, y: &Formula) -> Option<Step> {
    let found = [evaluate(b, cx, x)?.0, evaluate(b, cx, y)?.0];
    found.iter().any(has_towers).then_some(())?;
    let (u, first) = plain(b, cx, x)?;
    let (v, last) = plain(b, cx, y)?;
    let middle = same(b, cx, &u, &v)?;
    b.chain(&[first, middle, last], x, y)
}
