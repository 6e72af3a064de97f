//! Integrals brought to 0..1: the new variable is the distribution function that stands in them as
//! the base of a power, or else the part of the range below, `p = A*x^d + B` with p = 0 and p = 1 at
//! the ends.

use super::Builder;
use super::decide::degree;
use super::evaluate::{Context, Value};
use super::integrand::{Product, product_of};
use super::make::{
    add, depends, div, int, integral, is_one, is_zero, map_parts, mul, parts, pow, replaced, sub,
    var,
};
use super::range::{body_at, on_closed, on_open, whole};
use crate::formula::{Formula, Function, Name, Operator, Ranged, substitute};
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
    place.put(b, cx, r, product)
}

/// The same where no power tells the place: by the powers that the ends of the range are roots of.
pub(super) fn by_ends(
    b: &mut Builder,
    cx: &mut Context,
    r: &Ranged,
    product: &Product,
) -> Option<Value> {
    let exponent = [&r.to, &r.from].into_iter().find_map(degree);
    Place::between(r, exponent.unwrap_or(int(1)))?.put(b, cx, r, product)
}

impl Place {
    /// The integral over 0..1, by the place as it stands, for the kernel knows a power by its base;
    /// or else in its shortest form.
    fn put(
        self,
        b: &mut Builder,
        cx: &mut Context,
        r: &Ranged,
        product: &Product,
    ) -> Option<Value> {
        let u = b.fresh("u");
        let g = self.integrand(cx, product, r, &u)?;
        let short = Place {
            p: cx.algebra.tidy(&self.p),
            ..self.clone()
        };
        [self, short]
            .into_iter()
            .find_map(|place| b.attempt(|b| place.substitute(b, r, (&u, &g))))
    }

    /// `(x^d - A)/(B - A)`, the ends being the d-th roots of A and B.
    fn between(r: &Ranged, exponent: Formula) -> Option<Place> {
        let (low, high) = (raised(&r.from, &exponent)?, raised(&r.to, &exponent)?);
        let power = pow(var(&r.name), exponent.clone());
        let width = sub(high, low.clone());
        Some(Place {
            p: div(sub(power.clone(), low.clone()), width.clone()),
            slope: div(int(1), width.clone()),
            origin: div(sub(int(0), low), width),
            power,
            exponent,
        })
    }

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

    fn substitute(&self, b: &mut Builder, r: &Ranged, new: (&Name, &Formula)) -> Option<Value> {
        exchanged(b, r, &self.p, new, (&int(0), &int(1)))
    }
}

/// The integral over a new variable, which stands for `p` and runs between the new ends.
fn exchanged(
    b: &mut Builder,
    r: &Ranged,
    p: &Formula,
    (u, g): (&Name, &Formula),
    (low, high): (&Formula, &Formula),
) -> Option<Value> {
    let ends = (&r.from, &r.to);
    let p = |x: &Formula| substitute(p, &[(r.name.clone(), x.clone())]).ok();
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
    b.equal(&p(&r.from)?, low)?;
    b.equal(&p(&r.to)?, high)?;
    let next = integral(g.clone(), u, low.clone(), high.clone());
    let fact = Fact::Same(whole(r), next.clone());
    let premises = [finite, sign, same];
    let step = b.step(fact, Rule::Substitution, &premises, &[p(&var(&x))?])?;
    Some((next, step))
}

/// An integral of a function that is given, at a root: over the root as the new variable.
pub(super) fn by_argument(b: &mut Builder, cx: &mut Context, r: &Ranged) -> Option<Value> {
    let root = root_inside(&r.body, &r.name)?;
    let d = degree(root)?;
    let powers = cx.algebra.in_powers(&raised(root, &d)?, &r.name)?;
    (*powers.keys().next_back()? == 1).then_some(())?;
    let (slope, origin) = (
        powers.get(&1)?.clone(),
        powers.get(&0).cloned().unwrap_or(int(0)),
    );
    let u = b.fresh("u");
    let (power, less) = (
        pow(var(&u), d.clone()),
        cx.algebra.tidy(&sub(d.clone(), int(1))),
    );
    let place = div(sub(power, origin.clone()), slope.clone());
    let body = replaced(&r.body, root, &var(&u));
    let body = substitute(&body, &[(r.name.clone(), place)]).ok()?;
    let g = mul(body, div(mul(d.clone(), pow(var(&u), less)), slope.clone()));
    let mut end = |x: &Formula| {
        let raised = add(mul(slope.clone(), x.clone()), origin.clone());
        match cx.algebra.tidy(&raised) {
            Formula::Binary(Operator::Power, base, e) if *e == d => Some(*base),
            _ => None,
        }
    };
    let ends = (end(&r.from)?, end(&r.to)?);
    exchanged(b, r, root, (&u, &g), (&ends.0, &ends.1))
}

/// The root of the variable that a function that is given is taken at.
fn root_inside<'a>(e: &'a Formula, x: &Name) -> Option<&'a Formula> {
    match e {
        Formula::Apply(_, list) => list
            .iter()
            .find(|part| degree(part).is_some() && depends(part, x)),
        _ => parts(e).into_iter().find_map(|part| root_inside(part, x)),
    }
}

/// Powers of 0, of 1 and of roots by value, for a first look.
fn trivial(e: &Formula) -> Formula {
    match e {
        Formula::Binary(Operator::Power, a, _) if is_zero(a) || is_one(a) => (**a).clone(),
        Formula::Binary(Operator::Power, a, d) if degree(a).as_ref() == Some(&**d) => {
            raised(a, d).unwrap_or_else(|| e.clone())
        }
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

/// The d-th power of 0, of 1, or of a d-th root; anything is its own first.
fn raised(e: &Formula, d: &Formula) -> Option<Formula> {
    match e {
        _ if is_one(d) || is_zero(e) || is_one(e) => Some(e.clone()),
        Formula::Call(Function::Sqrt, parts) if *d == int(2) => parts.first().cloned(),
        Formula::Binary(Operator::Power, a, _) if degree(e).as_ref() == Some(d) => {
            Some((**a).clone())
        }
        _ => None,
    }
}
