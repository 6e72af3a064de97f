//! Means, variances and densities over laws.

use super::Builder;
use super::evaluate::{Context, Value, then, value};
use super::make::{int, integral};
use super::matching::map_quantities;
use super::range::on_open;
use super::special::beta_weight;
use crate::formula::{Draw, Formula, Function, Law, Name, Operator, free_names, substitute};
use crate::kernel::proof::{Fact, Rule, Step};

use Operator::{Divide, Multiply, Power, Subtract};

/// A mean or a variance over the draws of the proposition.
pub(super) fn drawn(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    let (next, step) = own_draw(b, q)?;
    then(b, cx, q, (next, step))
}

/// The same mean or variance with a draw of its own; a probability as a mean.
pub(super) fn own_draw(b: &mut Builder, q: &Formula) -> Option<Value> {
    if let Formula::Probability(condition, draw) = q {
        let indicator = Formula::Indicator(condition.clone());
        let mean = Formula::Mean(Box::new(indicator), draw.clone());
        let first = b.step(
            Fact::Same(q.clone(), mean.clone()),
            Rule::Probability,
            &[],
            &[],
        )?;
        return match draw {
            Some(_) => Some((mean, first)),
            None => {
                let (found, second) = own_draw(b, &mean)?;
                let step = b.chain(&[first, second], q, &found)?;
                Some((found, step))
            }
        };
    }
    let (Formula::Mean(e, None) | Formula::Variance(e, None)) = q else {
        return None;
    };
    let (e, steps) = drawn_inside(b, e);
    let names = free_names(&e);
    let mut draws = b.proposition().draws.iter();
    let draw = draws.find(|draw| names.contains(&draw.name))?.clone();
    let with = |draw: Option<Box<Draw>>| match q {
        Formula::Mean(..) => Formula::Mean(Box::new(e.clone()), draw),
        _ => Formula::Variance(Box::new(e.clone()), draw),
    };
    let (between, next) = (with(None), with(Some(Box::new(draw))));
    let fact = Fact::Same(between.clone(), next.clone());
    let step = match between == *q {
        true => b.step(fact, Rule::Draw, &[], &[])?,
        false => {
            let first = b.congruent(q, &between, &steps)?;
            let second = b.step(fact, Rule::Draw, &[], &[])?;
            b.chain(&[first, second], q, &next)?
        }
    };
    Some((next, step))
}

/// The formula with draws of their own for the means in it.
fn drawn_inside(b: &mut Builder, e: &Formula) -> (Formula, Vec<Step>) {
    let mut steps = Vec::new();
    let found = map_quantities(e, &mut |q| match b.attempt(|b| own_draw(b, q)) {
        Some((next, step)) => {
            steps.push(step);
            next
        }
        None => q.clone(),
    });
    (found, steps)
}

/// A mean as an integral, the density of a draw as a formula; then their values.
pub(super) fn mean(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    let next = by_density(b, cx, q)?;
    then(b, cx, q, next)
}

/// What the density of its law makes of a mean or a density.
pub(super) fn by_density(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Value> {
    let (next, premises) = match q {
        Formula::Mean(e, Some(draw)) => {
            let x = Formula::Name(draw.name.clone());
            let (density, from, to, premises) = density_of(b, cx, &draw.law, &x)?;
            let body = Formula::binary(Multiply, density, (**e).clone());
            (integral(body, &draw.name, from, to), premises)
        }
        Formula::Density(drawn, at) => {
            let mut draws = b.proposition().draws.iter();
            let draw = draws.find(|draw| **drawn == Formula::Name(draw.name.clone()))?;
            let (density, from, to, premises) = density_of(b, cx, &draw.law, at)?;
            b.nonnegative(&Formula::binary(Subtract, (**at).clone(), from))?;
            b.nonnegative(&Formula::binary(Subtract, to, (**at).clone()))?;
            (density, premises)
        }
        _ => return None,
    };
    let fact = Fact::Same(q.clone(), next.clone());
    let step = b.step(fact, Rule::Density, &premises, &[])?;
    Some((next, step))
}

/// A density at x, the ends of its support, and the premises of the rule.
fn density_of(
    b: &mut Builder,
    cx: &mut Context,
    law: &Law,
    x: &Formula,
) -> Option<(Formula, Formula, Formula, Vec<Step>)> {
    match law {
        Law::Beta(p, q) => {
            b.positive(p)?;
            b.positive(q)?;
            let beta = Formula::Call(Function::Beta, vec![p.clone(), q.clone()]);
            let density = Formula::binary(Divide, beta_weight(p, q, x), beta);
            Some((density, int(0), int(1), Vec::new()))
        }
        Law::Uniform(from, to) => {
            let width = Formula::binary(Subtract, to.clone(), from.clone());
            b.positive(&width)?;
            let density = Formula::binary(Divide, int(1), width);
            Some((density, from.clone(), to.clone(), Vec::new()))
        }
        Law::Density {
            argument,
            body,
            from,
            to,
        } => {
            b.positive(&Formula::binary(Subtract, to.clone(), from.clone()))?;
            let premises = is_density(b, cx, argument, body, (from, to))?;
            let density = substitute(body, &[(argument.clone(), x.clone())]).ok()?;
            Some((density, from.clone(), to.clone(), premises))
        }
        Law::Order(l, m, of) => order_density(b, cx, (l, m), of, x),
        Law::Any => None,
    }
}

/// That a function is nonnegative on its range and has the integral 1 over it.
fn is_density(
    b: &mut Builder,
    cx: &mut Context,
    argument: &Name,
    body: &Formula,
    (from, to): (&Formula, &Formula),
) -> Option<Vec<Step>> {
    let sign = on_open(b, argument, (from, to), |b, y| {
        let there = substitute(body, &[(argument.clone(), Formula::Name(y.clone()))]).ok()?;
        b.finite(&there)?;
        b.nonnegative(&there)?;
        let fact = Fact::AtMost(int(0), there.clone());
        b.step(fact, Rule::Order, &[], &[there])
    })?;
    let total = integral(body.clone(), argument, from.clone(), to.clone());
    let fact = Fact::Same(total.clone(), int(1));
    if let Some(step) = b.attempt(|b| b.step(fact, Rule::Function, &[], &[])) {
        return Some(vec![sign, step]);
    }
    let (found, step) = value(b, cx, &total)?;
    let one = b.equal(&found, &int(1))?;
    let total = b.chain(&[step, one], &total, &int(1))?;
    Some(vec![sign, total])
}

fn order_density(
    b: &mut Builder,
    cx: &mut Context,
    (l, m): (&Formula, &Formula),
    of: &Law,
    x: &Formula,
) -> Option<(Formula, Formula, Formula, Vec<Step>)> {
    b.nonnegative(&Formula::binary(Subtract, l.clone(), int(1)))?;
    b.nonnegative(&Formula::binary(Subtract, m.clone(), l.clone()))?;
    let (f, from, to, premises) = density_of(b, cx, of, x)?;
    let minus = |a: &Formula, b: &Formula| Formula::binary(Subtract, a.clone(), b.clone());
    let below = match of {
        Law::Uniform(a, c) => Formula::binary(Divide, minus(x, a), minus(c, a)),
        Law::Density {
            argument,
            body,
            from,
            ..
        } => integral(body.clone(), argument, from.clone(), x.clone()),
        _ => return None,
    };
    let factorial = |n: &Formula| Formula::Factorial(Box::new(n.clone()));
    let (before, after) = (minus(l, &int(1)), minus(m, l));
    let ways = Formula::binary(Multiply, factorial(&before), factorial(&after));
    let count = Formula::binary(Divide, factorial(m), ways);
    let under = Formula::binary(Power, below.clone(), before);
    let over = Formula::binary(Power, minus(&int(1), &below), after);
    let product = Formula::binary(Multiply, count, under);
    let product = Formula::binary(Multiply, product, over);
    let density = Formula::binary(Multiply, product, f);
    Some((density, from, to, premises))
}

/// A variance as the mean of the square minus the square of the mean.
pub(super) fn variance(
    b: &mut Builder,
    cx: &mut Context,
    e: &Formula,
    draw: &Draw,
) -> Option<Value> {
    let q = Formula::Variance(Box::new(e.clone()), Some(Box::new(draw.clone())));
    let next = by_moments(b, &q)?;
    let (found, step) = then(b, cx, &q, next)?;
    Some((found, step))
}

/// What the definition makes of a variance over its draw.
pub(super) fn by_moments(b: &mut Builder, q: &Formula) -> Option<Value> {
    let Formula::Variance(e, Some(draw)) = q else {
        return None;
    };
    let mean = |e: Formula| Formula::Mean(Box::new(e), Some(draw.clone()));
    let second = mean(Formula::binary(Power, (**e).clone(), int(2)));
    let first = Formula::binary(Power, mean((**e).clone()), int(2));
    let next = Formula::binary(Subtract, second, first);
    let fact = Fact::Same(q.clone(), next.clone());
    let step = b.step(fact, Rule::Variance, &[], &[])?;
    Some((next, step))
}

/// That a variance has no value, the mean being infinite.
pub(super) fn without_variance(b: &mut Builder, cx: &mut Context, q: &Formula) -> Option<Step> {
    let Formula::Variance(e, Some(draw)) = q else {
        return None;
    };
    let mean = Formula::Mean(e.clone(), Some(draw.clone()));
    let (found, step) = value(b, cx, &mean)?;
    (found == Formula::Infinity).then_some(())?;
    b.step(Fact::Undefined(q.clone()), Rule::Variance, &[step], &[])
}
