//! Bases of powers and arguments of logarithms as products of factors that are not negative.

use super::builder::Builder;
use super::form::{integer, number, over, power, times};
use super::known::Sign;
use crate::algebra::Polynomial;
use crate::formula::Formula;
use crate::number::convert::from_rug;
use rug::Rational;

/// `content * product of factors to their exponents`
pub(super) struct Factored {
    content: Rational,
    factors: Vec<(Formula, i64)>,
}

impl Factored {
    /// The factors of a formula, each with the sign that makes it nonnegative.
    pub fn of(builder: &mut Builder, e: &Formula) -> Option<Factored> {
        let (mut content, powers) = {
            let mut field = builder.field.borrow_mut();
            let normal = field.normal(e)?;
            normal.factored(&field.budget).ok()?
        };
        let mut factors = Vec::new();
        for (factor, exponent) in powers {
            let (written, negative) = written(builder, &factor)?;
            if negative && exponent % 2 != 0 {
                content = -content;
            }
            factors.push((written, exponent));
        }
        (content > 0).then_some(Factored { content, factors })
    }

    /// The product, where it is one.
    pub fn written(&self) -> Option<Formula> {
        let single = matches!(self.factors.as_slice(), [(_, 1)]) && self.content == 1;
        if single || self.factors.is_empty() {
            return None;
        }
        let (above, below) = (self.content.numer().clone(), self.content.denom().clone());
        let mut above: Vec<Formula> = whole(above).into_iter().collect();
        let mut below: Vec<Formula> = whole(below).into_iter().collect();
        for (factor, exponent) in &self.factors {
            let size = exponent.abs();
            let raised = match size {
                1 => factor.clone(),
                _ => power(factor.clone(), integer(size)),
            };
            match *exponent > 0 {
                true => above.push(raised),
                false => below.push(raised),
            }
        }
        let above = above
            .into_iter()
            .reduce(times)
            .unwrap_or_else(|| integer(1));
        Some(match below.into_iter().reduce(times) {
            None => above,
            Some(below) => over(above, below),
        })
    }
}

/// The integer, unless it is 1.
fn whole(value: rug::Integer) -> Option<Formula> {
    (value != 1).then(|| number(&from_rug(&Rational::from(value))))
}

/// The factor or its negative, whichever is known to be nonnegative.
fn written(builder: &mut Builder, factor: &Polynomial) -> Option<(Formula, bool)> {
    let there = builder.field.borrow().write_polynomial(factor);
    if builder.signed(&there, Sign::Nonnegative).is_some() {
        return Some((there, false));
    }
    let back = builder.field.borrow().write_polynomial(&factor.neg());
    builder.signed(&back, Sign::Nonnegative)?;
    Some((back, true))
}
