//! Integrals over 0..1 with the weight `x^p*(1 - x)^q` of a beta law: beta functions, and what else
//! stands under the weight as a multiple of an integral without constant factors.

use super::Builder;
use super::evaluate::{Context, Value};
use super::integrand::{Product, product_of};
use super::make::{add, int, integral, is_zero, pow, sub, var};
use super::range::{on_closed, on_line, rewritten, whole};
use super::special::beta_weight;
use super::{moment, primitive};
use crate::formula::{Formula, Function, Name, Operator, Ranged, substitute};
use crate::kernel::proof::{Fact, Rule, Step};

use Operator::{Multiply, Subtract};

/// The factors of an integrand over 0..1.
pub(super) struct Weighted {
    pub coefficient: Formula,
    /// The exponents of x and of 1 - x.
    pub p: Formula,
    pub q: Formula,
    /// All other factors, with their exponents.
    pub rest: Vec<(Formula, Formula)>,
}

impl Weighted {
    fn of(cx: &mut Context, product: &Product, x: &Name) -> Weighted {
        let mut weighted = Weighted {
            coefficient: product.coefficient.clone(),
            p: int(0),
            q: int(0),
            rest: Vec::new(),
        };
        let other = sub(int(1), var(x));
        for (base, exponent) in &product.factors {
            if cx.algebra.same(base, &var(x)) {
                weighted.p = add(weighted.p, exponent.clone());
            } else if cx.algebra.same(base, &other) {
                weighted.q = add(weighted.q, exponent.clone());
            } else {
                weighted.rest.push((base.clone(), exponent.clone()));
            }
        }
        weighted.p = cx.algebra.tidy(&weighted.p);
        weighted.q = cx.algebra.tidy(&weighted.q);
        weighted
    }

    /// The factors that depend on the variable, in a fixed order.
    fn core(&self, x: &Name) -> Formula {
        let mut factors = Vec::new();
        for (base, exponent) in [(var(x), &self.p), (sub(int(1), var(x)), &self.q)] {
            if !is_zero(exponent) {
                factors.push((base, exponent.clone()));
            }
        }
        let mut rest = self.rest.clone();
        rest.sort_by_key(|(base, _)| base.to_string());
        factors.extend(rest);
        product_of(&factors)
    }
}

pub(super) fn value(
    b: &mut Builder,
    cx: &mut Context,
    r: &Ranged,
    product: &Product,
) -> Option<Value> {
    let weighted = Weighted::of(cx, product, &r.name);
    match weighted.rest.as_slice() {
        [] => beta(b, cx, r, &weighted),
        [(form, order)] => {
            let order = cx.algebra.integer(order);
            match order {
                Some(order) if order < -1 => {
                    b.attempt(|b| moment::reduced(b, cx, r, &weighted, (form, -order)))
                }
                _ => None,
            }
            .or_else(|| multiple(b, r, &weighted))
        }
        _ => multiple(b, r, &weighted),
    }
}

/// A multiple of a beta function, where both exponents are above -1; infinite at -1.
fn beta(b: &mut Builder, cx: &mut Context, r: &Ranged, weighted: &Weighted) -> Option<Value> {
    let p = cx.algebra.tidy(&add(weighted.p.clone(), int(1)));
    let q = cx.algebra.tidy(&add(weighted.q.clone(), int(1)));
    if is_zero(&p) {
        return primitive::diverges(b, cx, r);
    }
    for exponent in [&p, &q] {
        b.positive(exponent)?;
    }
    let weight = |x: &Name| Some(beta_weight(&p, &q, &var(x)));
    let (next, first) = scaled(b, r, &weighted.coefficient, &weight)?;
    let beta = Formula::Call(Function::Beta, vec![p.clone(), q.clone()]);
    let fact = Fact::Same(beta.clone(), next.clone());
    let second = b.step(fact, Rule::BetaIntegral, &[], &[])?;
    let found = Formula::binary(Multiply, weighted.coefficient.clone(), beta);
    let between = Formula::binary(Multiply, weighted.coefficient.clone(), next);
    let second = b.congruent(&between, &found, &[second])?;
    let step = b.chain(&[first, second], &whole(r), &found)?;
    Some((found, step))
}

/// A multiple of an integral that is finite, its integrand being continuous on 0..1.
fn multiple(b: &mut Builder, r: &Ranged, weighted: &Weighted) -> Option<Value> {
    let own = weighted.core(&r.name);
    let core = |x: &Name| substitute(&own, &[(r.name.clone(), var(x))]).ok();
    let (next, first) = scaled(b, r, &weighted.coefficient, &core)?;
    continuous(b, &next)?;
    let found = Formula::binary(Multiply, weighted.coefficient.clone(), next);
    Some((found, first))
}

/// `int(e) == c*int(core)`; gives the integral on the right, and the step. The coefficient stays,
/// be it 1.
pub(super) fn scaled(
    b: &mut Builder,
    r: &Ranged,
    c: &Formula,
    core: &dyn Fn(&Name) -> Option<Formula>,
) -> Option<Value> {
    let (next, first) = rewritten(b, r, |b, x, body| {
        let new = Formula::binary(Multiply, c.clone(), core(x)?);
        let step = b.equal(body, &new)?;
        Some((new, step))
    })?;
    b.finite(c)?;
    b.nonzero(c)?;
    let Formula::Ranged(made) = &next else {
        return None;
    };
    let rest = integral(core(&made.name)?, &made.name, r.from.clone(), r.to.clone());
    let split = Formula::binary(Multiply, c.clone(), rest.clone());
    let fact = Fact::Same(next.clone(), split.clone());
    let second = b.step(fact, Rule::Scale, &[], &[])?;
    let step = b.chain(&[first, second], &whole(r), &split)?;
    Some((rest, step))
}

/// `finite int(e)` where e is continuous on the closed range, or all over.
pub(super) fn continuous(b: &mut Builder, e: &Formula) -> Option<Step> {
    let fact = Fact::Finite(e.clone());
    if let Some(step) = b.seen(&fact) {
        return Some(step);
    }
    let Formula::Ranged(r) = e else {
        return None;
    };
    let width = Formula::binary(Subtract, r.to.clone(), r.from.clone());
    let inside = |b: &mut Builder, x: &Name| b.finite_step(&super::range::body_at(r, x)?);
    let step = match b.nonnegative(&width) {
        Some(()) => on_closed(b, &r.name, (&r.from, &r.to), inside)?,
        None => {
            b.finite(&width)?;
            on_line(b, &r.name, inside)?
        }
    };
    b.step(fact, Rule::Continuous, &[step], &[])
}

/// `x^p*(1 - x)^q/form^j` with the trivial factors left out.
pub(super) fn term(x: &Formula, p: &Formula, q: &Formula, form: &Formula, j: i64) -> Formula {
    let mut factors = Vec::new();
    for (base, exponent) in [(x.clone(), p), (sub(int(1), x.clone()), q)] {
        if !is_zero(exponent) {
            factors.push((base, exponent.clone()));
        }
    }
    let weight = product_of(&factors);
    match j {
        0 => weight,
        j => Formula::binary(Operator::Divide, weight, pow(form.clone(), int(j))),
    }
}
