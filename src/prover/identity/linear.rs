//! Means and variances by their linear rules, whatever the law: constants are taken out of both.

use super::Builder;
use super::evaluate::{Context, Value, value};
use super::law::{by_density, by_moments, own_draw};
use super::make::{depends, int, integral, map_parts, replaced, var};
use super::matching::with_quantities;
use super::range::on_open;
use super::weight::continuous;
use crate::formula::{Draw, Formula, Law, Operator, substitute};
use crate::kernel::proof::{Fact, Rule, Step};

use Operator::{Add, Multiply, Power, Subtract};

/// The formula with constants taken out of its means and variances.
pub(super) fn linear(b: &mut Builder, cx: &mut Context, e: &Formula) -> Option<Value> {
    with_quantities(b, e, &mut |b, q| quantity(b, cx, q))
}

/// The formula with variances as what means make of them.
pub(super) fn in_moments(b: &mut Builder, e: &Formula) -> Option<Value> {
    with_quantities(b, e, &mut by_moments)
}

fn quantity(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    let (own, first) = match q {
        Formula::Mean(_, Some(_)) | Formula::Variance(_, Some(_)) => {
            (q.clone(), b.chain(&[], q, q)?)
        }
        _ => own_draw(b, q)?,
    };
    let (found, second) = match &own {
        Formula::Mean(e, Some(draw)) => b
            .attempt(|b| centred(b, cx, e, draw))
            .or_else(|| b.attempt(|b| mean(b, cx, e, draw)))
            .unwrap_or((own.clone(), b.chain(&[], &own, &own)?)),
        Formula::Variance(e, Some(draw)) => variance(b, e, draw)?,
        _ => return None,
    };
    let step = b.chain(&[first, second], q, &found)?;
    Some((found, step))
}

/// `mean((e - mean(e))^2)` as the variance of e.
fn centred(b: &mut Builder, cx: &mut Context, e: &Formula, draw: &Draw) -> Option<Value> {
    let Formula::Binary(Power, difference, _) = e else {
        return None;
    };
    let Formula::Binary(Subtract, g, first) = &**difference else {
        return None;
    };
    let own = Some(Box::new(draw.clone()));
    let mean = |e: &Formula| Formula::Mean(Box::new(e.clone()), own.clone());
    (mean(g) == **first).then_some(())?;
    finite(b, cx, first)?;
    let (whole, found) = (mean(e), Formula::Variance(g.clone(), own.clone()));
    let fact = Fact::Same(found.clone(), whole.clone());
    let step = b.step(fact, Rule::Variance, &[], &[])?;
    let step = b.chain(&[step], &whole, &found)?;
    Some((found, step))
}

/// A variance without the constants that it does not depend on, and its factors before it.
fn variance(b: &mut Builder, e: &Formula, draw: &Draw) -> Option<Value> {
    let own = Some(Box::new(draw.clone()));
    let of = |e: &Formula| Formula::Variance(Box::new(e.clone()), own.clone());
    let still = |e: &Formula| !depends(e, &draw.name);
    let whole = of(e);
    let (c, rest) = match e {
        Formula::Binary(Add | Subtract, g, c) if still(c) => (c, g),
        Formula::Binary(Add | Multiply, c, g) if still(c) => (c, g),
        _ => return Some((whole.clone(), b.chain(&[], &whole, &whole)?)),
    };
    b.finite(c)?;
    let rest_of = of(rest);
    let next = match e {
        Formula::Binary(Multiply, ..) => {
            if b.nonzero(c).is_none() {
                supposed(b, &rest_of)?;
            }
            let factor = Formula::binary(Power, (**c).clone(), int(2));
            Formula::binary(Multiply, factor, rest_of.clone())
        }
        _ => rest_of.clone(),
    };
    let fact = Fact::Same(whole.clone(), next.clone());
    let first = b.step(fact, Rule::Variance, &[], &[])?;
    let (value, second) = variance(b, rest, draw)?;
    let found = replaced(&next, &rest_of, &value);
    let second = b.congruent(&next, &found, &[second])?;
    let step = b.chain(&[first, second], &whole, &found)?;
    Some((found, step))
}

/// A mean as a sum of multiples of means, all of them finite.
fn mean(b: &mut Builder, cx: &mut Context, e: &Formula, draw: &Draw) -> Option<Value> {
    let own = Some(Box::new(draw.clone()));
    let of = |e: &Formula| Formula::Mean(Box::new(e.clone()), own.clone());
    let whole = of(e);
    let (apart, parts, rule) = match e {
        _ if !depends(e, &draw.name) => return known(b, &whole, |b| value(b, cx, &whole)),
        Formula::Binary(Add | Subtract, g, h) => {
            (map_parts(e, &mut |part| of(part)), vec![g, h], Rule::Split)
        }
        Formula::Binary(Multiply, c, g) if !depends(c, &draw.name) => {
            b.finite(c)?;
            let apart = Formula::binary(Multiply, (**c).clone(), of(g));
            (apart, vec![g], Rule::Scale)
        }
        _ => match parted(e, draw) {
            Some(next) => return known(b, &whole, |b| opened(b, cx, e, &next, draw)),
            None => {
                finite(b, cx, &whole)?;
                let step = b.chain(&[], &whole, &whole)?;
                return Some((whole, step));
            }
        },
    };
    known(b, &whole, |b| {
        let mut found = apart.clone();
        let mut steps = Vec::new();
        for part in parts {
            let (value, step) = mean(b, cx, part, draw)?;
            found = replaced(&found, &of(part), &value);
            steps.push(step);
        }
        let first = b.step(Fact::Same(whole.clone(), apart.clone()), rule, &[], &[])?;
        let second = b.congruent(&apart, &found, &steps)?;
        let step = b.chain(&[first, second], &whole, &found)?;
        Some((found, step))
    })
}

/// The value that is found for a mean, which makes it known to be finite.
fn known(
    b: &mut Builder,
    mean: &Formula,
    find: impl FnOnce(&mut Builder) -> Option<Value>,
) -> Option<Value> {
    let (found, step) = find(b)?;
    b.finite(&found)?;
    b.step(Fact::Finite(mean.clone()), Rule::Finite, &[step], &[])?;
    Some((found, step))
}

/// The mean of what has the same value between the ends of the law.
fn opened(
    b: &mut Builder,
    cx: &mut Context,
    e: &Formula,
    next: &Formula,
    draw: &Draw,
) -> Option<Value> {
    let of = |e: &Formula| Formula::Mean(Box::new(e.clone()), Some(Box::new(draw.clone())));
    let (from, to) = support(&draw.law)?;
    let step = on_open(b, &draw.name, (&from, &to), |b, x| {
        let at = |e: &Formula| substitute(e, &[(draw.name.clone(), var(x))]).ok();
        b.equal(&at(e)?, &at(next)?)
    })?;
    let (whole, moved) = (of(e), of(next));
    let first = b.congruent(&whole, &moved, &[step])?;
    let (found, second) = mean(b, cx, next, draw)?;
    let step = b.chain(&[first, second], &whole, &found)?;
    Some((found, step))
}

/// The square of a sum or a difference with a constant, in parts.
fn parted(e: &Formula, draw: &Draw) -> Option<Formula> {
    let Formula::Binary(Power, base, n) = e else {
        return None;
    };
    let Formula::Binary(operator @ (Add | Subtract), g, c) = &**base else {
        return None;
    };
    (**n == int(2) && !depends(c, &draw.name)).then_some(())?;
    let square = |e: &Formula| Formula::binary(Power, e.clone(), int(2));
    let twice = Formula::binary(Multiply, int(2), (**c).clone());
    let twice = Formula::binary(Multiply, twice, (**g).clone());
    let first = Formula::binary(*operator, square(g), twice);
    Some(Formula::binary(Add, first, square(c)))
}

/// The ends between which a draw lies.
fn support(law: &Law) -> Option<(Formula, Formula)> {
    match law {
        Law::Beta(..) => Some((int(0), int(1))),
        Law::Uniform(from, to) | Law::Density { from, to, .. } => Some((from.clone(), to.clone())),
        Law::Order(_, _, of) => support(of),
        Law::Any => None,
    }
}

/// That a mean over a draw is finite: by its law, or by the integral that it is.
fn finite(b: &mut Builder, cx: &mut Context, mean: &Formula) -> Option<Step> {
    let fact = Fact::Finite(mean.clone());
    if let Some(step) = b.seen(&fact).or_else(|| b.attempt(|b| supposed(b, mean))) {
        return Some(step);
    }
    let (integral, step) = by_density(b, cx, mean)?;
    if b.attempt(|b| continuous(b, &integral)).is_none() {
        integrable(b, &integral)?;
    }
    b.step(fact, Rule::Finite, &[step], &[])
}

/// That the integral of a multiple of an integrable function is finite.
fn integrable(b: &mut Builder, e: &Formula) -> Option<Step> {
    let Formula::Ranged(r) = e else {
        return None;
    };
    let Formula::Binary(Multiply, c, f) = &r.body else {
        return None;
    };
    let rest = integral((**f).clone(), &r.name, r.from.clone(), r.to.clone());
    b.step(Fact::Finite(rest.clone()), Rule::Function, &[], &[])?;
    b.finite(c)?;
    let scaled = Formula::binary(Multiply, (**c).clone(), rest);
    let step = b.step(Fact::Same(e.clone(), scaled), Rule::Scale, &[], &[])?;
    b.step(Fact::Finite(e.clone()), Rule::Finite, &[step], &[])
}

/// That a mean or variance over a draw is finite by what its law says.
fn supposed(b: &mut Builder, own: &Formula) -> Option<Step> {
    let whole = match own {
        Formula::Mean(e, Some(_)) => Formula::Mean(e.clone(), None),
        Formula::Variance(e, Some(_)) => Formula::Variance(e.clone(), None),
        _ => return None,
    };
    let (found, step) = own_draw(b, &whole)?;
    (found == *own).then_some(())?;
    b.step(Fact::Finite(own.clone()), Rule::Finite, &[step], &[])
}
