//! Derivatives by the rules of calculus, where the formula and what they make of it are finite around
//! the point.

use super::Builder;
use super::evaluate::{Context, Value, then};
use super::make::{depends, var};
use super::matching::settle;
use crate::formula::{Formula, Name, substitute};
use crate::kernel::proof::{Fact, Rule, Step, Variable, derive, is_entire};

/// No more of what is known of the point is supposed around it.
const SUPPOSED: usize = 8;

/// The derivative, as a formula without `diff`.
pub(super) fn value(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    let Formula::Derivative(e, x, _) = q else {
        return None;
    };
    let slope = derive(e, x).ok()?;
    let known = known_around(b, x);
    [Vec::new(), known].into_iter().find_map(|known| {
        b.attempt(|b| {
            let premises = finite_around(b, x, &known, [e, &slope])?;
            let fact = Fact::Same(q.clone(), slope.clone());
            let step = b.step(fact, Rule::Derivative, &premises, &[])?;
            then(b, cx, q, (slope.clone(), step))
        })
    })
}

/// The relations in sight that hold around x where they hold at x.
fn known_around(b: &Builder, x: &Name) -> Vec<Fact> {
    let strict = |fact: &&Fact| match fact {
        Fact::Less(p, q) | Fact::Different(p, q) => {
            (depends(p, x) || depends(q, x)) && is_entire(p, x) && is_entire(q, x)
        }
        _ => false,
    };
    let relations = b.relations().map(|relation| &relation.fact);
    relations.filter(strict).take(SUPPOSED).cloned().collect()
}

/// States that the formulas are finite for a new variable in the place of x of which so much is known.
fn finite_around(
    b: &mut Builder,
    x: &Name,
    known: &[Fact],
    formulas: [&Formula; 2],
) -> Option<[Step; 2]> {
    let name = b.fresh(x);
    let there = |e: &Formula| substitute(e, &[(x.clone(), var(&name))]).ok();
    let moved = |fact: &Fact| match fact {
        Fact::Less(p, q) => Some(Fact::Less(there(p)?, there(q)?)),
        Fact::Different(p, q) => Some(Fact::Different(there(p)?, there(q)?)),
        _ => None,
    };
    let hypotheses = known.iter().map(moved).collect::<Option<_>>()?;
    let [e, slope] = formulas.map(there);
    let (e, slope) = (e?, slope?);
    let variable = Variable {
        name: name.clone(),
        integer: false,
    };
    b.block(vec![variable], hypotheses, |b, _| {
        settle(b, &e);
        Some([b.finite_step(&e)?, b.finite_step(&slope)?])
    })
}
