//! Integrals of Laurent polynomials between symbolic bounds, roots among them.

use super::Reason;
use super::domain::Sign;
use super::expansion::{Expander, Scope, Value, unsupported};
use crate::algebra::{Polynomial, RationalFunction, Symbol};
use crate::formula::Ranged;
use rug::Rational;
use std::collections::BTreeMap;

/// The coefficients of the powers of a symbol, where the symbol divides by itself only.
pub(super) fn laurent(
    value: &RationalFunction,
    symbol: &Symbol,
    expander: &Expander<'_>,
) -> Result<Option<BTreeMap<i64, RationalFunction>>, Reason> {
    let own = Polynomial::symbol(symbol);
    let (mut shift, mut rest) = (0, RationalFunction::one());
    for (atom, exponent) in value.denominator() {
        match (*atom == own, atom.contains(symbol)) {
            (true, _) => shift = i64::from(*exponent),
            (false, true) => return Ok(None),
            (false, false) => {
                let factor = RationalFunction::from(atom.clone());
                let factor = factor.powi(-i64::from(*exponent), expander.budget)?;
                rest = rest.mul(&factor, expander.budget)?;
            }
        }
    }
    let mut terms = BTreeMap::new();
    for (exponent, part) in value.numerator().coefficients(symbol) {
        let coefficient = rest.mul(&part.into(), expander.budget)?;
        terms.insert(i64::from(exponent) - shift, coefficient);
    }
    Ok(Some(terms))
}

impl Expander<'_> {
    /// `int(e, x = a..b)` for e a Laurent polynomial in x.
    pub(super) fn integral(&self, ranged: &Ranged, scope: &Scope) -> Result<Value, Reason> {
        let (from, to) = (
            self.value(&ranged.from, scope)?,
            self.value(&ranged.to, scope)?,
        );
        let (symbol, mut inner) = (self.fresh(&ranged.name), scope.clone());
        inner.insert(
            ranged.name.clone(),
            Value::Exact(RationalFunction::symbol(&symbol)),
        );
        let Value::Exact(body) = self.value(&ranged.body, &inner)? else {
            return unsupported("an integral of a series");
        };
        let Some(terms) = laurent(&body, &symbol, self)? else {
            return unsupported("an integrand that is no Laurent polynomial");
        };
        self.integrate(&terms, &from, &to)
    }

    /// The integral of a sum of `coefficient * x^exponent`. A negative exponent rests on both bounds
    /// being positive.
    pub(super) fn integrate(
        &self,
        terms: &BTreeMap<i64, RationalFunction>,
        from: &Value,
        to: &Value,
    ) -> Result<Value, Reason> {
        let mut sum = Value::Exact(RationalFunction::zero());
        for (exponent, coefficient) in terms {
            let part = self.power_integral(*exponent, from, to)?;
            let part = self.multiply(&part, &Value::Exact(coefficient.clone()))?;
            sum = self.add(&sum, &part)?;
        }
        Ok(sum)
    }

    fn power_integral(&self, exponent: i64, from: &Value, to: &Value) -> Result<Value, Reason> {
        if exponent < 0 {
            self.require(Sign::Positive, from)?;
            self.require(Sign::Positive, to)?;
        }
        let above = exponent.saturating_add(1);
        if above == 0 {
            return self.add(&self.ln(to)?, &self.negate(&self.ln(from)?)?);
        }
        let lower = self.negate(&self.powi(from, above)?)?;
        let difference = self.add(&self.powi(to, above)?, &lower)?;
        let weight = RationalFunction::constant(Rational::from((1, above)));
        self.multiply(&difference, &Value::Exact(weight))
    }
}
