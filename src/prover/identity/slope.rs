//! Equations between functions of one parameter that agree at 0 and have the same derivative.

use super::Builder;
use super::evaluate::Context;
use super::link::direct;
use super::make::{depends, int, integral, var};
use super::matching::{integrals_of, settle};
use super::primitive::by_primitive;
use crate::formula::{Formula, Name, Operator, ParameterKind, substitute};
use crate::kernel::proof::{Fact, Step};

use Operator::{Add, Subtract};

/// `x == y`, where an integral in them has an end that moves with a real parameter.
pub(super) fn by_slope(
    b: &mut Builder,
    cx: &mut Context,
    x: &Formula,
    y: &Formula,
) -> Option<Step> {
    let name = moving(b, x).or_else(|| moving(b, y))?;
    let start = |e: &Formula| substitute(e, &[(name.clone(), int(0))]).ok();
    let (x0, y0) = (start(x)?, start(y)?);
    let agree = direct(b, cx, &x0, &y0)?;
    let fact = Fact::Same(x.clone(), y.clone());
    let ahead = Fact::AtMost(int(0), var(&name));
    b.cases(&fact, &ahead, |b, _| {
        for side in [x, y, &x0, &y0] {
            settle(b, side);
        }
        let (now, then) = (difference(x, y), difference(&x0, &y0));
        let (from, to, grown, signed) = match b.nonnegative(&var(&name)) {
            Some(()) => (int(0), var(&name), difference(&now, &then), Add),
            None => (var(&name), int(0), difference(&then, &now), Subtract),
        };
        let none = integral(int(0), &name, from, to);
        let Formula::Ranged(r) = &none else {
            return None;
        };
        let at = |t: &Name| substitute(&difference(x, y), &[(name.clone(), var(t))]).ok();
        let (_, first) = by_primitive(b, r, &at)?;
        let (still, second) = by_primitive(b, r, &|_| Some(int(0)))?;
        let constant = b.chain(&[first, second], &grown, &still)?;
        // x == y + (x - y - (x0 - y0)) + (x0 - y0)
        let sum = |grown: &Formula, x0: &Formula| {
            let there = Formula::binary(signed, y.clone(), grown.clone());
            Formula::binary(Add, there, difference(x0, &y0))
        };
        let (there, here) = (sum(&grown, &x0), sum(&still, &y0));
        let first = b.ring(x, &there, &[])?;
        let second = b.congruent(&there, &here, &[constant, agree])?;
        let third = b.ring(&here, y, &[])?;
        b.chain(&[first, second, third], x, y)
    })
}

fn difference(a: &Formula, b: &Formula) -> Formula {
    Formula::binary(Subtract, a.clone(), b.clone())
}

/// A real parameter that an end of an integral depends on.
fn moving(b: &Builder, e: &Formula) -> Option<Name> {
    let mut all = Vec::new();
    integrals_of(e, &mut all);
    let mut reals = b.proposition().parameters.iter();
    let real = reals.find(|p| {
        let moves = |end: &Formula| depends(end, &p.name);
        p.kind == ParameterKind::Real && all.iter().any(|r| moves(&r.from) || moves(&r.to))
    });
    real.map(|p| p.name.clone())
}
