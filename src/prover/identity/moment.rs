//! Integrals of a beta weight over powers of a linear form u = A + B*x: the derivative of
//! `x^(p+1)*(1-x)^(q+1)/u^(j-1)` relates the powers j, j - 1 and j - 2, so all come down to the first.

use super::Builder;
use super::evaluate::{Context, Value, value};
use super::make::{add, div, int, integral, is_zero, mul, sub, var};
use super::primitive::by_primitive;
use super::range::whole;
use super::weight::{Weighted, continuous, scaled, term};
use crate::formula::{Formula, Name, Operator, Ranged, substitute};
use crate::kernel::proof::{Fact, Rule, Step};

use Operator::{Add, Multiply};

/// The relation for one power: `sum of factors[i]*int(x^p*(1-x)^q/u^(j-i)) == 0`, i = 0, 1, 2.
struct Relation<'a> {
    p: &'a Formula,
    q: &'a Formula,
    form: Formula,
    /// The name that the form depends on.
    own: Name,
    order: i64,
    factors: [Formula; 3],
}

/// The integral over `u^order`, order at least 2, by those over lower powers.
pub(super) fn reduced(
    b: &mut Builder,
    cx: &mut Context,
    r: &Ranged,
    weighted: &Weighted,
    (form, order): (&Formula, i64),
) -> Option<Value> {
    let relation = Relation::of(cx, weighted, form, order, &r.name)?;
    let core = |x: &Name| relation.term(0, x);
    let (target, first) = scaled(b, r, &weighted.coefficient, &core)?;
    let Formula::Ranged(target_range) = &target else {
        return None;
    };
    let (found, second) = relation.solve(b, cx, target_range)?;
    let between = Formula::binary(Multiply, weighted.coefficient.clone(), target.clone());
    let found_whole = Formula::binary(Multiply, weighted.coefficient.clone(), found);
    let second = b.congruent(&between, &found_whole, &[second])?;
    let step = b.chain(&[first, second], &whole(r), &found_whole)?;
    Some((found_whole, step))
}

impl<'a> Relation<'a> {
    fn of(
        cx: &mut Context,
        weighted: &'a Weighted,
        form: &Formula,
        order: i64,
        x: &Name,
    ) -> Option<Relation<'a>> {
        let powers = cx.algebra.in_powers(form, x)?;
        (*powers.keys().next_back()? == 1).then_some(())?;
        let slope = powers.get(&1)?.clone();
        let origin = powers.get(&0).cloned().unwrap_or(int(0));
        let (p, q) = (&weighted.p, &weighted.q);
        let n = int(order - 1);
        // p + q + 2
        let total = add(add(p.clone(), q.clone()), int(2));
        let end = add(origin.clone(), slope.clone());
        let last = div(
            mul(n.clone(), mul(origin.clone(), end.clone())),
            slope.clone(),
        );
        let turned = sub(
            mul(total.clone(), origin.clone()),
            mul(n.clone(), add(origin, end)),
        );
        let middle = add(add(p.clone(), int(1)), div(turned, slope.clone()));
        let first = div(sub(n, total), slope);
        let factors = [last, middle, first].map(|factor| cx.algebra.tidy(&factor));
        Some(Relation {
            p,
            q,
            form: form.clone(),
            own: x.clone(),
            order,
            factors,
        })
    }

    fn form(&self, x: &Name) -> Option<Formula> {
        substitute(&self.form, &[(self.own.clone(), var(x))]).ok()
    }

    /// `x^p*(1-x)^q/u^(order - i)`
    fn term(&self, i: i64, x: &Name) -> Option<Formula> {
        Some(term(
            &var(x),
            self.p,
            self.q,
            &self.form(x)?,
            self.order - i,
        ))
    }

    /// The integral of the first term by the others.
    fn solve(&self, b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
        let mut parts = Vec::new();
        for (i, factor) in (0..).zip(&self.factors) {
            if is_zero(factor) {
                continue;
            }
            let core = self.term(i, &r.name)?;
            parts.push((factor.clone(), core));
        }
        let terms = parts.iter();
        let mut terms = terms.map(|(c, core)| Formula::binary(Multiply, c.clone(), core.clone()));
        let first = terms.next()?;
        let sum = terms.fold(first, |sum, term| Formula::binary(Add, sum, term));
        let parts: Vec<_> = parts
            .into_iter()
            .map(|(c, core)| (c, over(r, core)))
            .collect();
        let total = over(r, sum);
        let linear = split(b, &total, &parts)?;
        let zero = self.vanishes(b, &total)?;
        let Fact::Same(_, combined) = b.fact(linear).clone() else {
            return None;
        };
        let zero = b.chain(&[linear, zero], &combined, &int(0))?;
        solved(b, cx, (&combined, zero), &parts)
    }

    /// The integral of the whole derivative is 0: its primitive is 0 at both ends.
    fn vanishes(&self, b: &mut Builder, total: &Formula) -> Option<Step> {
        let Formula::Ranged(r) = total else {
            return None;
        };
        let next = |e: &Formula| Formula::binary(Add, e.clone(), int(1));
        let primitive = |x: &Name| {
            let (p, q, form) = (next(self.p), next(self.q), self.form(x)?);
            Some(term(&var(x), &p, &q, &form, self.order - 1))
        };
        let (difference, first) = by_primitive(b, r, &primitive)?;
        let second = b.equal(&difference, &int(0))?;
        b.chain(&[first, second], total, &int(0))
    }
}

fn over(r: &Ranged, body: Formula) -> Formula {
    integral(body, &r.name, r.from.clone(), r.to.clone())
}

/// `int(c0*t0 + c1*t1 + ...) == c0*int(t0) + c1*int(t1) + ...`, all of them finite.
fn split(b: &mut Builder, total: &Formula, parts: &[(Formula, Formula)]) -> Option<Step> {
    let Formula::Ranged(r) = total else {
        return None;
    };
    let ((c, last), before) = parts.split_last()?;
    if before.is_empty() {
        return scale(b, total, c, last);
    }
    let Formula::Binary(Add, sum, own) = &r.body else {
        return None;
    };
    let (left, right) = (over(r, (**sum).clone()), over(r, (**own).clone()));
    let first = split(b, &left, before)?;
    let second = scale(b, &right, c, last)?;
    for (side, step) in [(&left, first), (&right, second)] {
        b.step(Fact::Finite(side.clone()), Rule::Finite, &[step], &[])?;
    }
    let all = Formula::binary(Add, b.right(first)?, b.right(second)?);
    let apart = Formula::binary(Add, left, right);
    let fact = Fact::Same(total.clone(), apart.clone());
    let third = b.step(fact, Rule::Split, &[], &[])?;
    let fourth = b.congruent(&apart, &all, &[first, second])?;
    b.chain(&[third, fourth], total, &all)
}

/// `int(c*t) == c*int(t)`; c may be 0, as the integral on the right is finite.
fn scale(b: &mut Builder, whole: &Formula, c: &Formula, rest: &Formula) -> Option<Step> {
    continuous(b, rest)?;
    b.finite(c)?;
    let scaled = Formula::binary(Multiply, c.clone(), rest.clone());
    b.step(Fact::Same(whole.clone(), scaled), Rule::Scale, &[], &[])
}

/// From `c0*I0 + c1*I1 + ... == 0`: I0 by the others, these by their values.
fn solved(
    b: &mut Builder,
    cx: &mut Context,
    (combined, zero): (&Formula, Step),
    parts: &[(Formula, Formula)],
) -> Option<Value> {
    let (c, target) = parts.first()?;
    let rest = |start: Formula| {
        let terms = parts[1..].iter();
        let sum = terms.fold(start, |sum, (c, i)| {
            Formula::binary(
                Operator::Subtract,
                sum,
                Formula::binary(Multiply, c.clone(), i.clone()),
            )
        });
        Formula::binary(Operator::Divide, sum, c.clone())
    };
    let (with, without) = (rest(combined.clone()), rest(int(0)));
    let first = b.equal(target, &with)?;
    let second = b.congruent(&with, &without, &[zero])?;
    let mut found = without.clone();
    let mut equations = Vec::new();
    for (_, lower) in &parts[1..] {
        if let Some((simple, step)) = value(b, cx, lower) {
            found = super::make::replaced(&found, lower, &simple);
            equations.push(step);
        }
    }
    let third = b.congruent(&without, &found, &equations)?;
    let step = b.chain(&[first, second, third], target, &found)?;
    Some((found, step))
}
