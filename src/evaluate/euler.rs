//! Means under a beta law of rational functions with one pole away from the ends, by Euler's integral
//! (DLMF 15.6.1): for r outside of [0, 1] and integers p, q, e
//!
//! ```text
//! E[x^p (1-x)^q (x-r)^-e] = (a)_p (b)_q/(a+b)_{p+q} * (-r)^-e * F(e, a+p; a+b+p+q; 1/r)
//! ```
//!
//! for a+p > 0 and b+q > 0, whatever real numbers a and b are.

use super::enclose::Enclosure;
use super::exact;
use super::fraction::Fraction;
use super::law::{self, Weight, shift};
use super::quantity::{Quantity, Separable};
use super::scope::{Binding, Scope};
use super::{Failure, Outcome, unsupported};
use crate::formula::{Budget, Draw, Formula, Part};
use crate::number::Interval;
use crate::special;
use rug::Rational;
use std::cmp::Ordering;

/// Encloses a mean or a variance over one draw; `failure` is the answer where this method does not apply.
pub(super) fn enclose(
    formula: &Formula,
    scope: &Scope,
    precision: u32,
    failure: Failure,
) -> Enclosure {
    let (body, own, variance) = match formula {
        Formula::Mean(body, own) => (body, own, false),
        Formula::Variance(body, own) => (body, own, true),
        _ => return Err(failure),
    };
    let draws: Vec<&Draw> = match own {
        Some(draw) => vec![draw],
        None => scope.draws_among(&Part::Formula(body).free_names())?,
    };
    let [draw] = draws[..] else {
        return Err(failure);
    };
    let Outcome::Value(Weight::Beta(a, b)) = law::weight(&draw.law, scope)? else {
        return Err(failure);
    };
    let symbol = scope.new_symbol();
    let binding = Binding::Symbol {
        symbol,
        sample: None,
        draw: true,
    };
    let link = scope.bind(&draw.name, binding);
    let Outcome::Value(Quantity::Open(body)) = exact::value(body, &link.scope())? else {
        return Err(failure);
    };
    let method = Method {
        a: &a,
        b: &b,
        budget: scope.budget(),
        precision,
    };
    let mean = method.mean(&body, &failure)?;
    if !variance {
        return Ok(Outcome::Value(mean));
    }
    match Quantity::Open(body).power(2, scope.budget())? {
        Outcome::Value(Quantity::Open(square)) => {
            let second = method.mean(&square, &failure)?;
            Ok(Outcome::Value(second.sub(&mean.square())))
        }
        _ => Err(failure),
    }
}

/// The law's parameters and what the work may cost.
struct Method<'a> {
    a: &'a Rational,
    b: &'a Rational,
    budget: &'a Budget,
    precision: u32,
}

impl Method<'_> {
    fn interval(&self, value: &Rational) -> Interval {
        Interval::from_rational(value, self.precision)
    }

    fn mean(&self, body: &Separable, failure: &Failure) -> Result<Interval, Failure> {
        let mut sum = Interval::from_i64(0, self.precision);
        for term in &body.terms {
            let mut factors = term.factors.values();
            let (Some(factor), None) = (factors.next(), factors.next()) else {
                return Err(failure.clone());
            };
            let mean = self.mean_of_fraction(factor, failure)?;
            sum = sum.add(&term.coefficient.enclose(self.precision).mul(&mean));
        }
        Ok(sum)
    }

    fn mean_of_fraction(
        &self,
        function: &Fraction,
        failure: &Failure,
    ) -> Result<Interval, Failure> {
        let (zero, one) = (Rational::new(), Rational::from(1));
        let split = function.split(self.budget)?;
        let (p, q) = (split.exponent_at(&zero), split.exponent_at(&one));
        let ends = [(self.a + Rational::from(p)), (self.b + Rational::from(q))];
        if ends.iter().any(|end| end.cmp0() != Ordering::Greater) {
            return Err(failure.clone());
        }
        let others = split.factors.iter().filter(|(r, _)| *r != 0 && *r != 1);
        let (poles, zeros): (Vec<_>, Vec<_>) = others.cloned().partition(|(_, e)| *e < 0);
        let [(pole, order)] = &poles[..] else {
            return Err(failure.clone());
        };
        if pole.cmp0() != Ordering::Less && *pole <= 1 {
            return Err(failure.clone());
        }
        let polynomial = Fraction {
            numerator: split.numerator,
            factors: zeros,
        }
        .expanded_numerator(self.budget)?;
        let mut sum = Interval::from_i64(0, self.precision);
        for (index, coefficient) in polynomial.iter().enumerate() {
            let power = i64::try_from(index).ok().and_then(|i| i.checked_add(p));
            let power = power.ok_or_else(|| Failure::TooLarge("an exponent".into()))?;
            let moment = self.moment(power, q, pole, *order)?;
            sum = sum.add(&self.interval(coefficient).mul(&moment));
        }
        // (1-x)^q = (-1)^q (x-1)^q
        Ok(if q % 2 == 0 { sum } else { sum.neg() })
    }

    /// E[x^p (1-x)^q (x-r)^order]
    fn moment(&self, p: i64, q: i64, pole: &Rational, order: i64) -> Result<Interval, Failure> {
        let sum = Rational::from(self.a + self.b);
        let total = p
            .checked_add(q)
            .ok_or_else(|| Failure::TooLarge("an exponent".into()))?;
        let ratio = shift(self.a, p, self.budget)? * shift(self.b, q, self.budget)?
            / shift(&sum, total, self.budget)?;
        self.budget.spend(u64::from(self.precision))?;
        let failed = |_| unsupported("hyp2f1 in a mean");
        let function = special::hyp2f1_rational(
            &Rational::from(order.saturating_neg()),
            &(self.a + Rational::from(p)),
            &(sum + Rational::from(total)),
            &Rational::from(pole.recip_ref()),
            self.precision,
        )
        .map_err(failed)?;
        let scale = self
            .interval(&Rational::from(-pole))
            .powi(order)
            .map_err(failed)?;
        Ok(self.interval(&ratio).mul(&scale).mul(&function))
    }
}
