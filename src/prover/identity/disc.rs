//! Integrals of the root of a quadratic between its zeros, the areas of half discs: beta integrals once
//! the range is brought to 0..1.

use super::Builder;
use super::evaluate::{self, Context, Value};
use super::make::{add, depends, div, int, mul, parts, pow, replaced, sub, var};
use super::range::{rewritten, whole};
use crate::formula::{Formula, Function, Name, Operator, Ranged, substitute};
use crate::kernel::proof::{Fact, Rule, Step};

use Operator::{Divide, Multiply, Power, Subtract};

/// `int(c*sqrt(q), x = a..b) == c*d*pi/8`, q being `(x - a)*(b - x)` and d the square of `b - a`.
pub(super) fn value(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let root = root_of(&r.body, &r.name)?;
    let mark: Name = "##".into();
    let marked = replaced(&r.body, &root, &var(&mark));
    if depends(&marked, &r.name) {
        return None;
    }
    let c = cx.algebra.factor(&marked, &mark)?;
    let square = distance_of_zeros(cx, parts(&root).first()?, &r.name)?;
    let (next, first) = rewritten(b, r, |b, x, body| {
        let root = substitute(&root, &[(r.name.clone(), var(x))]).ok()?;
        let (split, step) = split_root(b, r, x, &root)?;
        let there = replaced(body, &root, &split);
        let moved = b.congruent(body, &there, &[step])?;
        let Formula::Binary(Multiply, width, powers) = split else {
            return None;
        };
        let new = Formula::binary(Multiply, mul(c.clone(), *width), *powers);
        let last = b.ring(&there, &new, &[])?;
        let step = b.chain(&[moved, last], body, &new)?;
        Some((new, step))
    })?;
    let (found, second) = evaluate::value(b, cx, &next)?;
    let area = div(mul(mul(c, square), Formula::Pi), int(8));
    let third = b.equal(&found, &area)?;
    let step = b.chain(&[first, second, third], &whole(r), &area)?;
    Some((area, step))
}

/// The root of what depends on the variable.
fn root_of(e: &Formula, x: &Name) -> Option<Formula> {
    match e {
        Formula::Call(Function::Sqrt, _) if depends(e, x) => Some(e.clone()),
        _ => parts(e).into_iter().find_map(|part| root_of(part, x)),
    }
}

/// The square of the distance of the zeros of a quadratic that begins with `-x^2`.
fn distance_of_zeros(cx: &mut Context, q: &Formula, x: &Name) -> Option<Formula> {
    let powers = cx.algebra.in_powers(q, x)?;
    let coefficient = |j: u32| powers.get(&j).cloned().unwrap_or(int(0));
    let falls = cx
        .algebra
        .same(&coefficient(2), &Formula::Negate(Box::new(int(1))));
    (falls && powers.keys().all(|j| *j <= 2)).then_some(())?;
    let square = pow(coefficient(1), int(2));
    Some(cx.algebra.tidy(&add(square, mul(int(4), coefficient(0)))))
}

/// `sqrt(q) == (b - a)*(p^(1/2)*(1 - p)^(1/2))` with `p = (x - a)/(b - a)`.
fn split_root(b: &mut Builder, r: &Ranged, x: &Name, root: &Formula) -> Option<Value> {
    let binary = Formula::binary;
    let q = parts(root).into_iter().next()?;
    let width = binary(Subtract, r.to.clone(), r.from.clone());
    let p = binary(Divide, sub(var(x), r.from.clone()), width.clone());
    let rest = binary(Subtract, int(1), p.clone());
    let half = binary(Divide, int(1), int(2));
    for part in [&width, &p, &rest] {
        b.finite(part)?;
        b.positive(part)?;
    }
    let product = binary(Multiply, p.clone(), rest.clone());
    let square = binary(Power, width.clone(), int(2));
    let inside = binary(Multiply, square.clone(), product.clone());
    let raised = |e: &Formula| binary(Power, e.clone(), half.clone());
    let there = Formula::Call(Function::Sqrt, vec![inside.clone()]);
    let parted = binary(Multiply, raised(&square), raised(&product));
    let powers = binary(Multiply, raised(&p), raised(&rest));
    let once = binary(Power, width.clone(), int(1));
    let same = b.equal(q, &inside)?;
    let mut by_power = |left: &Formula, right: &Formula| -> Option<Step> {
        let fact = Fact::Same(left.clone(), right.clone());
        b.step(fact, Rule::Power, &[], &[])
    };
    let rooted = by_power(&there, &raised(&inside))?;
    let split = by_power(&raised(&inside), &parted)?;
    let first = by_power(&raised(&square), &once)?;
    let second = by_power(&raised(&product), &powers)?;
    let first = {
        let last = b.ring(&once, &width, &[])?;
        b.chain(&[first, last], &raised(&square), &width)?
    };
    let moved = b.congruent(root, &there, &[same])?;
    let found = binary(Multiply, width, powers);
    let last = b.congruent(&parted, &found, &[first, second])?;
    let step = b.chain(&[moved, rooted, split, last], root, &found)?;
    Some((found, step))
}
