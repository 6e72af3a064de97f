//! Sums of polynomials, which telescope.

use super::Builder;
use super::evaluate::{Context, Value, evaluate, has_quantity, then};
use super::make::{add, div, int, mul, pow, sub, var};
use crate::formula::{Formula, Name, Operator, RangeKind, Ranged, substitute};
use crate::kernel::proof::{Fact, Rule, Variable};

use Operator::{Add, Subtract};

pub(super) fn value(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    (r.kind == RangeKind::Sum).then_some(())?;
    if has_quantity(&r.body) {
        let next = evaluated(b, cx, r)?;
        return then(b, cx, &Formula::Ranged(Box::new(r.clone())), next);
    }
    let g = antidifference(cx, &r.body, &r.name)?;
    let at = |e: &Formula| substitute(&g, &[(r.name.clone(), e.clone())]).ok();
    let next_end = Formula::binary(Add, r.to.clone(), int(1));
    b.nonnegative(&Formula::binary(Subtract, next_end.clone(), r.from.clone()))?;
    let name = b.fresh(&r.name);
    let j = var(&name);
    let variable = || {
        vec![Variable {
            name: name.clone(),
            integer: true,
        }]
    };
    let within = |to: &Formula| {
        vec![
            Fact::AtMost(r.from.clone(), j.clone()),
            Fact::AtMost(j.clone(), to.clone()),
        ]
    };
    let step = b.block(variable(), within(&r.to), |b, _| {
        let next = at(&Formula::binary(Add, j.clone(), int(1)))?;
        let difference = Formula::binary(Subtract, next, at(&j)?);
        let body = substitute(&r.body, &[(r.name.clone(), j.clone())]).ok()?;
        b.equal(&body, &difference)
    })?;
    let finite = b.block(variable(), within(&next_end), |b, _| {
        b.finite_step(&at(&j)?)
    })?;
    let found = Formula::binary(Subtract, at(&next_end)?, at(&r.from)?);
    let fact = Fact::Same(Formula::Ranged(Box::new(r.clone())), found.clone());
    let step = b.step(fact, Rule::Telescope, &[step, finite], &[at(&j)?])?;
    Some((found, step))
}

/// The sum once the quantities inside its body are evaluated, all of them.
fn evaluated(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let name = b.fresh(&r.name);
    let j = var(&name);
    let variable = Variable {
        name: name.clone(),
        integer: true,
    };
    let within = vec![
        Fact::AtMost(r.from.clone(), j.clone()),
        Fact::AtMost(j.clone(), r.to.clone()),
    ];
    let body = substitute(&r.body, &[(r.name.clone(), j)]).ok()?;
    let (found, step) = b.block(vec![variable], within, |b, _| evaluate(b, cx, &body))?;
    if has_quantity(&found) {
        return None;
    }
    let next = Formula::Ranged(Box::new(Ranged {
        body: found,
        name,
        ..r.clone()
    }));
    let step = b.congruent(&Formula::Ranged(Box::new(r.clone())), &next, &[step])?;
    Some((next, step))
}

/// A polynomial G with `G(j + 1) - G(j) == e(j)`: from the highest power down, `j^(n+1)/(n+1)` has
/// the difference `j^n` and lower powers, which are taken off what is left.
fn antidifference(cx: &mut Context, e: &Formula, j: &Name) -> Option<Formula> {
    let mut rest = e.clone();
    let mut sum = int(0);
    let degree = *cx.algebra.in_powers(e, j)?.keys().next_back()?;
    for n in (0..=i64::from(degree)).rev() {
        let powers = cx.algebra.in_powers(&rest, j)?;
        let Some(c) = powers.get(&u32::try_from(n).ok()?) else {
            continue;
        };
        let c = div(c.clone(), int(n + 1));
        let power = |at: Formula| mul(c.clone(), pow(at, int(n + 1)));
        let difference = sub(power(add(var(j), int(1))), power(var(j)));
        rest = cx.algebra.tidy(&sub(rest, difference));
        sum = add(sum, power(var(j)));
    }
    Some(cx.algebra.tidy(&sum))
}
