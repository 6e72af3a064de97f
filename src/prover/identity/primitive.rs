//! Integrals by a primitive: Laurent polynomials in a linear form, and single powers.

use super::Builder;
use super::evaluate::{Context, Value};
use super::integrand::Product;
use super::make::{add, depends, div, int, is_one, is_zero, ln, mul, pow, replaced, sub, var};
use super::matching::settle;
use super::range::{body_at, on_closed, on_open, whole};
use crate::formula::{Formula, Function, Name, Operator, Ranged, substitute};
use crate::kernel::proof::{Fact, Rule, Step, derive};

/// Poles of a higher order are not looked for.
const STEEPEST: i64 = 4;

/// `F[x:=b] - F[x:=a]`, F given for any name of the variable.
pub(super) fn by_primitive(
    b: &mut Builder,
    r: &Ranged,
    primitive: &dyn Fn(&Name) -> Option<Formula>,
) -> Option<Value> {
    let ends = (&r.from, &r.to);
    let width = Formula::binary(Operator::Subtract, r.to.clone(), r.from.clone());
    b.nonnegative(&width)?;
    let (x, f, finite) = on_closed(b, &r.name, ends, |b, x| {
        let f = primitive(x)?;
        settle(b, &f);
        let first = b.finite_step(&f)?;
        let second = b.finite_step(&body_at(r, x)?)?;
        Some((x.clone(), f, [first, second]))
    })?;
    let derived = on_open(b, &r.name, ends, |b, x| {
        let slope = derive(&primitive(x)?, x).ok()?;
        b.equal(&slope, &body_at(r, x)?)
    })?;
    let at = |end: &Formula| substitute(&f, &[(x.clone(), end.clone())]).ok();
    let next = Formula::binary(Operator::Subtract, at(&r.to)?, at(&r.from)?);
    let fact = Fact::Same(whole(r), next.clone());
    let premises = [finite[0], derived, finite[1]];
    let step = b.step(fact, Rule::Primitive, &premises, &[f])?;
    Some((next, step))
}

/// The integral of what does not depend on the variable.
pub(super) fn constant(b: &mut Builder, r: &Ranged) -> Option<Value> {
    by_primitive(b, r, &|x| Some(mul(r.body.clone(), var(x))))
}

/// The integral of `c*x^p`.
pub(super) fn power(
    b: &mut Builder,
    cx: &mut Context,
    r: &Ranged,
    product: &Product,
) -> Option<Value> {
    let [(base, p)] = product.factors.as_slice() else {
        return None;
    };
    (*base == Formula::Name(r.name.clone()) && !depends(p, &r.name)).then_some(())?;
    let next = cx.algebra.tidy(&add(p.clone(), int(1)));
    if is_zero(&next) {
        return None;
    }
    let c = cx
        .algebra
        .tidy(&div(product.coefficient.clone(), next.clone()));
    let at = |x: &Formula| mul(c.clone(), pow(x.clone(), next.clone()));
    let (found, step) = by_primitive(b, r, &|x| Some(at(&var(x))))?;
    // The power of 0 is left out.
    let upper = at(&r.to);
    if is_zero(&r.from)
        && let Some(second) = b.attempt(|b| b.equal(&found, &upper))
    {
        let step = b.chain(&[step, second], &whole(r), &upper)?;
        return Some((upper, step));
    }
    Some((found, step))
}

/// The integral of `c*sin(x)`.
pub(super) fn sine(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let call = |f, x: &Name| Formula::Call(f, vec![var(x)]);
    let mark: Name = "##".into();
    let body = cx.algebra.tidy(&r.body);
    let marked = replaced(&body, &call(Function::Sin, &r.name), &var(&mark));
    let c = cx.algebra.factor(&marked, &mark)?;
    if depends(&marked, &r.name) {
        return None;
    }
    let cosine = |x: &Name| Formula::Negate(Box::new(call(Function::Cos, x)));
    by_primitive(b, r, &|x| Some(mul(c.clone(), cosine(x))))
}

/// A sum of `c_j*u^j` for a linear form u of the variable.
pub(super) struct Laurent {
    pub form: Formula,
    pub slope: Formula,
    pub terms: Vec<(i64, Formula)>,
}

impl Laurent {
    /// Reads a rational function of x whose denominator is a power of one linear form.
    pub fn of(cx: &mut Context, e: &Formula, x: &Name) -> Option<Laurent> {
        let algebra = &mut cx.algebra;
        let f = algebra.read(e)?;
        let moving = f.denominator().iter().filter(|(p, _)| algebra.holds(p, x));
        let moving: Vec<_> = moving.map(|(p, j)| (p.clone(), i64::from(*j))).collect();
        let (form, order) = match moving.as_slice() {
            [] => (Formula::Name(x.clone()), 0),
            [(p, order)] => (algebra.write(&p.clone().into()), *order),
            _ => return None,
        };
        let powers = algebra.in_powers(&form, x)?;
        let degree = powers.keys().next_back()?;
        (*degree == 1).then_some(())?;
        let slope = powers.get(&1)?.clone();
        let origin = powers.get(&0).cloned().unwrap_or(int(0));
        // x = (u - origin)/slope, u under the name of x.
        let place = div(sub(Formula::Name(x.clone()), origin), slope.clone());
        let above = Formula::binary(Operator::Multiply, e.clone(), pow(form.clone(), int(order)));
        let above = algebra.tidy(&above);
        let moved = substitute(&above, &[(x.clone(), place)]).ok()?;
        let terms = algebra.in_powers(&moved, x)?.into_iter();
        let terms = terms.map(|(j, c)| (i64::from(j) - order, c)).collect();
        Some(Laurent { form, slope, terms })
    }

    /// The same sum by powers of `-u`.
    fn turned(self, cx: &mut Context) -> Laurent {
        let mut opposite = |e: &Formula| cx.algebra.tidy(&Formula::Negate(Box::new(e.clone())));
        let terms = self.terms.into_iter();
        Laurent {
            form: opposite(&self.form),
            slope: opposite(&self.slope),
            terms: terms
                .map(|(j, c)| (j, if j % 2 == 0 { c } else { opposite(&c) }))
                .collect(),
        }
    }

    /// A primitive.
    fn primitive(&self, cx: &mut Context) -> Formula {
        let mut sum = int(0);
        for (j, c) in &self.terms {
            let below = match j {
                -1 => self.slope.clone(),
                _ => mul(int(j + 1), self.slope.clone()),
            };
            let c = cx.algebra.tidy(&div(c.clone(), below));
            let term = match j + 1 {
                0 => mul(c, ln(self.form.clone())),
                n if n < 0 => div(c, pow(self.form.clone(), int(-n))),
                n => mul(c, pow(self.form.clone(), int(n))),
            };
            sum = add(sum, term);
        }
        sum
    }
}

/// The integral of a Laurent polynomial in a linear form.
pub(super) fn laurent(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let mut laurent = Laurent::of(cx, &r.body, &r.name)?;
    let name = r.name.clone();
    let low = substitute(&laurent.form, &[(name.clone(), r.from.clone())]).ok()?;
    let opposite = cx.algebra.tidy(&Formula::Negate(Box::new(low)));
    if b.attempt(|b| b.positive(&opposite)).is_some() {
        laurent = laurent.turned(cx);
    }
    let f = laurent.primitive(cx);
    let at = |x: &Name| substitute(&f, &[(name.clone(), var(x))]).ok();
    if let Some(found) = b.attempt(|b| by_primitive(b, r, &at)) {
        return Some(found);
    }
    b.attempt(|b| diverges(b, cx, r))
}

/// That an integral is infinite: the body is `g/(x - a)^p`, g positive at the lower end a.
pub(super) fn diverges(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    (1..=STEEPEST).find_map(|p| b.attempt(|b| diverges_as(b, cx, r, p)))
}

fn diverges_as(b: &mut Builder, cx: &mut Context, r: &Ranged, p: i64) -> Option<Value> {
    let distance = |x: &Name| {
        let distance = Formula::binary(Operator::Subtract, var(x), r.from.clone());
        pow(distance, int(p))
    };
    let g = Formula::binary(Operator::Multiply, r.body.clone(), distance(&r.name));
    let g = match Product::of(&g, &r.name, &mut cx.algebra) {
        product if product.is_rational(&mut cx.algebra) => cx.algebra.tidy(&g),
        product => mul(product.coefficient.clone(), product.core()),
    };
    let ends = (&r.from, &r.to);
    let at = |x: &Name| substitute(&g, &[(r.name.clone(), var(x))]).ok();
    let width = Formula::binary(Operator::Subtract, r.to.clone(), r.from.clone());
    b.positive(&width)?;
    let (x, finite) = on_closed(b, &r.name, ends, |b, x| {
        let step = b.finite_step(&at(x)?)?;
        Some((x.clone(), step))
    })?;
    let premises: [Step; 2] = on_open(b, &r.name, ends, |b, x| {
        let g = at(x)?;
        let quotient = Formula::binary(Operator::Divide, g.clone(), distance(x));
        let same = b.equal(&body_at(r, x)?, &quotient)?;
        b.finite(&g)?;
        b.nonnegative(&g)?;
        let sign = b.step(Fact::AtMost(int(0), g.clone()), Rule::Order, &[], &[g])?;
        Some([same, sign])
    })?;
    let start = substitute(&g, &[(r.name.clone(), r.from.clone())]).ok()?;
    b.positive(&start)?;
    let fact = Fact::Same(whole(r), Formula::Infinity);
    let premises = [finite, premises[0], premises[1]];
    let mut arguments = vec![at(&x)?];
    arguments.extend((p > 1).then(|| int(p)));
    let step = b.step(fact, Rule::Diverges, &premises, &arguments)?;
    Some((Formula::Infinity, step))
}

/// Whether the ends are 0 and 1.
pub(super) fn is_unit(r: &Ranged) -> bool {
    is_zero(&r.from) && is_one(&r.to)
}
