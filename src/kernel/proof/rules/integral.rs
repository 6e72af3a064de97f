//! The rules of integrals and sums.

use super::super::known::{above, minus, strictly_between};
use super::super::{Fact, Rejected, reject, require};
use super::{Check, Checked, body_at, depends, put};
use crate::formula::{Formula, Name, Operator, RangeKind, Ranged};
use crate::kernel::derivative::{self, derive};

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
        let r = integral(self.equation()?.0)?;
        let Formula::Binary(Operator::Multiply, c, e) = &r.body else {
            return reject("the integrand is a product");
        };
        require(!depends(c, &r.name), "the factor depends on the variable")?;
        let rest = with_body(r, e);
        self.is_finite(c)?;
        // 0 times an infinite integral has no value, but the integral of 0 may have one.
        if self.is_nonzero(c).is_err() {
            self.is_finite(&rest)?;
        }
        self.concludes(&Formula::binary(Operator::Multiply, (**c).clone(), rest))
    }

    pub(super) fn split(&self) -> Checked {
        let r = integral(self.equation()?.0)?;
        let Formula::Binary(operator @ (Operator::Add | Operator::Subtract), e, g) = &r.body else {
            return reject("the integrand is a sum or a difference");
        };
        let (first, second) = (with_body(r, e), with_body(r, g));
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
        let distance = minus(&Formula::Name(x.clone()), &r.from);
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

    pub(super) fn indicator(&self) -> Checked {
        let (left, right) = self.equation()?;
        let (r, s) = (integral(left)?, integral(right)?);
        let x = Formula::Name(r.name.clone());
        require(r.name == s.name, "the two integrals have the same variable")?;
        let condition = strictly_between(&s.from, &x, &s.to);
        let indicator = Formula::Indicator(Box::new(condition));
        let cut = Formula::binary(Operator::Multiply, indicator, s.body.clone());
        require(
            r.body == cut,
            "the integrand is the indicator of the range times the other",
        )?;
        let free = !depends(&s.from, &r.name) && !depends(&s.to, &r.name);
        require(free, "the range depends on the variable")?;
        let (y, fact) = self.on_range(0, self.ends(r, true)?, false, false)?;
        states(fact, &Fact::Finite(body_at(s, y)?))?;
        self.ends(s, true)?;
        self.is_nonnegative(&above(&r.from, &s.from))?;
        self.is_nonnegative(&above(&s.to, &r.to))
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

fn with_body(r: &Ranged, body: &Formula) -> Formula {
    Formula::Ranged(Box::new(Ranged {
        body: body.clone(),
        ..r.clone()
    }))
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
