//! Integrals brought to 0..1: the new variable is the distribution function that stands in them as
//! the base of a power, `p = A*x^d + B` with p = 0 and p = 1 at the ends.

use super::Builder;
use super::evaluate::{Context, Value};
use super::integrand::{Product, product_of};
use super::make::{
    add, depends, div, int, integral, is_one, is_zero, map_parts, mul, parts, replaced, sub, var,
};
use super::range::{body_at, on_closed, on_open, whole};
use crate::formula::{Formula, Name, Operator, Ranged, substitute};
use crate::kernel::proof::{Fact, Rule, derive};

/// `p = A*x^d + B`
#[derive(Clone)]
struct Place {
    p: Formula,
    /// `x^d`, as it stands in p.
    power: Formula,
    exponent: Formula,
    slope: Formula,
    origin: Formula,
}

pub(super) fn to_unit(
    b: &mut Builder,
    cx: &mut Context,
    r: &Ranged,
    product: &Product,
) -> Option<Value> {
    let mut bases = product.factors.iter();
    let place = bases.find_map(|(base, exponent)| match cx.algebra.integer(exponent) {
        None => Place::of(cx, base, r),
        Some(_) => None,
    })?;
    let u = b.fresh("u");
    let g = place.integrand(cx, product, r, &u)?;
    // As it stands, for the kernel knows a power by its base; or else in its shortest form.
    let short = Place {
        p: cx.algebra.tidy(&place.p),
        ..place.clone()
    };
    [place, short]
        .into_iter()
        .find_map(|place| b.attempt(|b| place.substitute(b, r, (&u, &g))))
}

impl Place {
    fn of(cx: &mut Context, base: &Formula, r: &Ranged) -> Option<Place> {
        let p = cx.algebra.tidy(base);
        if p == var(&r.name) {
            return None; // it runs from 0 to 1 already
        }
        let at = |end: &Formula| substitute(&p, &[(r.name.clone(), end.clone())]).ok();
        let (low, high) = (at(&r.from)?, at(&r.to)?);
        if !cx.algebra.zero(&trivial(&low)) || !cx.algebra.same(&trivial(&high), &int(1)) {
            return None;
        }
        let power = power_of(&p, &r.name)?;
        let exponent = match &power {
            Formula::Binary(_, _, d) => (**d).clone(),
            _ => int(1),
        };
        // The power stands for itself under the variable's name.
        let linear = replaced(&p, &power, &var(&"##".into()));
        if depends(&linear, &r.name) {
            return None;
        }
        let powers = cx.algebra.in_powers(&linear, &"##".into())?;
        (*powers.keys().next_back()? == 1).then_some(())?;
        Some(Place {
            power,
            exponent,
            slope: powers.get(&1)?.clone(),
            origin: powers.get(&0).cloned().unwrap_or(int(0)),
            p: base.clone(),
        })
    }

    /// The integrand for the new variable.
    fn integrand(
        &self,
        cx: &mut Context,
        product: &Product,
        r: &Ranged,
        u: &Name,
    ) -> Option<Formula> {
        let algebra = &mut cx.algebra;
        let origin = div(sub(int(0), self.origin.clone()), self.slope.clone());
        let scale = algebra.tidy(&div(int(1), self.slope.clone()));
        let power = add(algebra.tidy(&origin), mul(scale, var(u)));
        let rest = sub(int(1), self.p.clone());
        let mut factors = Vec::new();
        // The power of x, less that of the slope.
        let mut total = sub(int(1), self.exponent.clone());
        for (base, exponent) in &product.factors {
            if algebra.same(base, &self.p) {
                factors.push((var(u), exponent.clone()));
            } else if algebra.same(base, &rest) {
                factors.push((sub(int(1), var(u)), exponent.clone()));
            } else if *base == var(&r.name) {
                total = add(total, exponent.clone());
            } else {
                let moved = replaced(base, &self.power, &power);
                (!depends(&moved, &r.name)).then_some(())?;
                factors.push((moved, exponent.clone()));
            }
        }
        let times = algebra.tidy(&div(total, self.exponent.clone()));
        algebra.read(&times)?.as_constant()?;
        factors.push((power, times));
        let slope = mul(self.slope.clone(), self.exponent.clone());
        let c = div(product.coefficient.clone(), slope);
        Some(mul(c, product_of(&factors)))
    }

    fn substitute(&self, b: &mut Builder, r: &Ranged, (u, g): (&Name, &Formula)) -> Option<Value> {
        let ends = (&r.from, &r.to);
        let p = |x: &Formula| substitute(&self.p, &[(r.name.clone(), x.clone())]).ok();
        let width = Formula::binary(Operator::Subtract, r.to.clone(), r.from.clone());
        b.positive(&width)?;
        let finite = on_closed(b, &r.name, ends, |b, x| b.finite_step(&p(&var(x))?))?;
        let (x, [sign, same]) = on_open(b, &r.name, ends, |b, x| {
            let place = p(&var(x))?;
            let slope = derive(&place, x).ok()?;
            b.finite(&slope)?;
            b.positive(&slope)?;
            let fact = Fact::Less(int(0), slope.clone());
            let sign = b.step(fact, Rule::Order, &[], std::slice::from_ref(&slope))?;
            let there = substitute(g, &[(u.clone(), place)]).ok()?;
            let there = Formula::binary(Operator::Multiply, there, slope);
            let same = b.equal(&body_at(r, x)?, &there)?;
            Some((x.clone(), [sign, same]))
        })?;
        b.equal(&p(&r.from)?, &int(0))?;
        b.equal(&p(&r.to)?, &int(1))?;
        let next = integral(g.clone(), u, int(0), int(1));
        let fact = Fact::Same(whole(r), next.clone());
        let premises = [finite, sign, same];
        let step = b.step(fact, Rule::Substitution, &premises, &[p(&var(&x))?])?;
        Some((next, step))
    }
}

/// Powers of 0 and 1 by value, for a first look.
fn trivial(e: &Formula) -> Formula {
    match e {
        Formula::Binary(Operator::Power, a, _) if is_zero(a) || is_one(a) => (**a).clone(),
        _ => map_parts(e, &mut trivial),
    }
}

/// The power of x that occurs, x itself being one.
fn power_of(e: &Formula, x: &Name) -> Option<Formula> {
    match e {
        Formula::Name(name) if name == x => Some(e.clone()),
        Formula::Binary(Operator::Power, a, d) if **a == var(x) && !depends(d, x) => {
            Some(e.clone())
        }
        _ => parts(e).into_iter().find_map(|part| power_of(part, x)),
    }
}
