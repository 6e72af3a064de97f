//! The rules of integrals and sums.

use super::super::known::{above, minus};
use super::super::{Fact, Rejected, reject, require};
use super::{Check, Checked, body_at, depends, put};
use crate::formula::{Formula, Name, Operator, RangeKind, Ranged, Rational};
use crate::kernel::derivative::{self, derive};
use num_traits::One;

impl<'a> Check<'a, '_> {
    pub(super) fn primitive(&self) -> Checked {
        let r = integral(self.equation()?.0)?;
        let primitive = self.argument(0)?;
        let ends = self.ends(r, false)?;
        let (x, fact) = self.on_range(0, ends, true, false)?;
        states(fact, &Fact::Finite(primitive.clone()))?;
        let e = body_at(r, x)?;
        let derived = Fact::Same(derive(primitive, x)?, e.clone());
        self.states_on(1, (r, x), false, &derived)?;
        self.states_on(2, (r, x), true, &Fact::Finite(e.clone()))?;
        is_continuous(primitive, x)?;
        is_continuous(&e, x)?;
        self.concludes(&minus(
            &put(primitive, x, &r.to)?,
            &put(primitive, x, &r.from)?,
        ))
    }

    pub(super) fn substitution(&self) -> Checked {
        let (left, right) = self.equation()?;
        let (r, s) = (integral(left)?, integral(right)?);
        let place = self.argument(0)?;
        let ends = self.ends(r, true)?;
        let (x, fact) = self.on_range(0, ends, true, false)?;
        states(fact, &Fact::Finite(place.clone()))?;
        is_continuous(place, x)?;
        let slope = derive(place, x)?;
        self.states_on(
            1,
            (r, x),
            false,
            &Fact::Less(Formula::integer(0), slope.clone()),
        )?;
        let free = s.name == *x || !depends(&s.body, x);
        require(free, "the new integrand depends on the old variable")?;
        let there = Formula::binary(Operator::Multiply, put(&s.body, &s.name, place)?, slope);
        self.states_on(2, (r, x), false, &Fact::Same(body_at(r, x)?, there))?;
        for (old, new) in [(&r.from, &s.from), (&r.to, &s.to)] {
            let equal = self.proof.equal(&put(place, x, old)?, new)?;
            require(
                equal,
                "the new ends are not those that the substitution gives",
            )?;
        }
        Ok(())
    }

    pub(super) fn scale(&self) -> Checked {
        let linear = linear(self.equation()?.0)?;
        let Formula::Binary(Operator::Multiply, c, e) = linear.body else {
            return reject("the body is a product");
        };
        require(
            !depends(c, linear.name),
            "the factor depends on the variable",
        )?;
        let rest = (linear.of)(e);
        self.is_finite(c)?;
        // 0 times what is infinite has no value, but the integral of 0 may have one.
        if self.is_nonzero(c).is_err() {
            self.is_finite(&rest)?;
        }
        self.concludes(&Formula::binary(Operator::Multiply, (**c).clone(), rest))
    }

    pub(super) fn split(&self) -> Checked {
        let linear = linear(self.equation()?.0)?;
        let Formula::Binary(operator @ (Operator::Add | Operator::Subtract), e, g) = linear.body
        else {
            return reject("the body is a sum or a difference");
        };
        let (first, second) = ((linear.of)(e), (linear.of)(g));
        self.is_finite(&first)?;
        self.is_finite(&second)?;
        self.concludes(&Formula::binary(*operator, first, second))
    }

    pub(super) fn continuous(&self) -> Checked {
        let Fact::Finite(left) = self.fact else {
            return reject("the rule concludes that an integral is finite");
        };
        let r = integral(left)?;
        let (x, fact) = self.on_range(0, (&r.from, &r.to), true, false)?;
        if self.ends(r, false).is_err() {
            self.is_finite(&above(&r.from, &r.to))?;
            self.on_range(0, (&r.to, &r.from), true, false)?;
        }
        let e = body_at(r, x)?;
        states(fact, &Fact::Finite(e.clone()))?;
        is_continuous(&e, x)
    }

    pub(super) fn diverges(&self) -> Checked {
        let r = integral(self.equation()?.0)?;
        let g = self.argument(0)?;
        let ends = self.ends(r, true)?;
        let (x, fact) = self.on_range(0, ends, true, false)?;
        states(fact, &Fact::Finite(g.clone()))?;
        is_continuous(g, x)?;
        let mut distance = minus(&Formula::Name(x.clone()), &r.from);
        if let Some(p) = self.arguments.get(1) {
            let steep = matches!(p, Formula::Number(p) if *p >= Rational::one());
            require(steep, "the exponent is a number, 1 or more")?;
            distance = Formula::binary(Operator::Power, distance, p.clone());
        }
        let quotient = Formula::binary(Operator::Divide, g.clone(), distance);
        self.states_on(1, (r, x), false, &Fact::Same(body_at(r, x)?, quotient))?;
        self.states_on(
            2,
            (r, x),
            false,
            &Fact::AtMost(Formula::integer(0), g.clone()),
        )?;
        self.is_positive(&put(g, x, &r.from)?)?;
        self.concludes(&Formula::Infinity)
    }

    pub(super) fn support(&self) -> Checked {
        let (left, right) = self.equation()?;
        let (r, s) = (integral(left)?, integral(right)?);
        for (low, high) in [(&r.from, &s.from), (&s.from, &s.to), (&s.to, &r.to)] {
            self.is_nonnegative(&above(low, high))?;
        }
        let (x, fact) = self.on_range(0, (&s.from, &s.to), false, false)?;
        states(fact, &Fact::Same(body_at(r, x)?, body_at(s, x)?))?;
        let beside = [(&r.from, &s.from), (&s.to, &r.to)];
        let beside = beside.into_iter().filter(|(low, high)| low != high);
        for (index, ends) in (1..).zip(beside) {
            let (x, fact) = self.on_range(index, ends, false, false)?;
            states(fact, &Fact::Same(body_at(r, x)?, Formula::integer(0)))?;
        }
        Ok(())
    }

    pub(super) fn telescope(&self) -> Checked {
        let r = match self.equation()?.0 {
            Formula::Ranged(r) if r.kind == RangeKind::Sum => r,
            _ => return reject("the rule is for sums"),
        };
        let sums_to = self.argument(0)?;
        self.is_integer(&r.from)?;
        self.is_integer(&r.to)?;
        let next = plus_one(&r.to);
        self.is_nonnegative(&above(&r.from, &next))?;
        let (j, fact) = self.on_range(0, (&r.from, &r.to), true, true)?;
        let step = minus(
            &put(sums_to, j, &plus_one(&Formula::Name(j.clone())))?,
            sums_to,
        );
        states(fact, &Fact::Same(body_at(r, j)?, step))?;
        let (i, fact) = self.on_range(1, (&r.from, &next), true, true)?;
        require(i == j, "the premises have different variables")?;
        states(fact, &Fact::Finite(sums_to.clone()))?;
        self.concludes(&minus(&put(sums_to, j, &next)?, &put(sums_to, j, &r.from)?))
    }

    /// The ends of an integral, finite and in their order.
    fn ends(&self, r: &'a Ranged, strict: bool) -> Result<(&'a Formula, &'a Formula), Rejected> {
        let width = above(&r.from, &r.to);
        match strict {
            true => self.is_positive(&width)?,
            false => self.is_nonnegative(&width)?,
        }
        Ok((&r.from, &r.to))
    }

    /// A premise states this for the variable on the range of the integral.
    fn states_on(
        &self,
        index: usize,
        (r, x): (&Ranged, &Name),
        closed: bool,
        wanted: &Fact,
    ) -> Checked {
        let (y, fact) = self.on_range(index, (&r.from, &r.to), closed, false)?;
        require(y == x, "the premises have different variables")?;
        states(fact, wanted)
    }
}

/// The fact of a premise is the one that the rule asks for.
pub(super) fn states(fact: &Fact, wanted: &Fact) -> Checked {
    match fact == wanted {
        true => Ok(()),
        false => Err(Rejected(format!("the premise should be {wanted}"))),
    }
}

fn integral(formula: &Formula) -> Result<&Ranged, Rejected> {
    match formula {
        Formula::Ranged(r) if r.kind == RangeKind::Integral => Ok(r),
        _ => reject("the rule is for integrals"),
    }
}

/// What is linear in its body: an integral, or a mean over a draw.
struct Linear<'f> {
    body: &'f Formula,
    name: &'f Name,
    /// The same of another body.
    of: Box<dyn Fn(&Formula) -> Formula + 'f>,
}

fn linear(formula: &Formula) -> Result<Linear<'_>, Rejected> {
    if let Formula::Mean(body, Some(draw)) = formula {
        return Ok(Linear {
            body,
            name: &draw.name,
            of: Box::new(|e| Formula::Mean(Box::new(e.clone()), Some(draw.clone()))),
        });
    }
    let r = integral(formula)?;
    let of = |e: &Formula| {
        Formula::Ranged(Box::new(Ranged {
            body: e.clone(),
            ..r.clone()
        }))
    };
    Ok(Linear {
        body: &r.body,
        name: &r.name,
        of: Box::new(of),
    })
}

fn plus_one(e: &Formula) -> Formula {
    Formula::binary(Operator::Add, e.clone(), Formula::integer(1))
}

/// The formula is continuous in x wherever it is finite.
pub(super) fn is_continuous(e: &Formula, x: &Name) -> Checked {
    require(
        derivative::is_continuous(e, x),
        "the formula is not known to be continuous",
    )
}
