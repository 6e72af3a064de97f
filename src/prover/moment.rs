//! Means and variances over the draws.
//!
//! A body that is a Laurent polynomial in its draws is averaged term by term: by the moments of the
//! Beta law (DLMF 5.12.1), or by direct integrals for uniform and power-law densities. Order
//! statistics and power laws become Beta laws by `u = F(r)`, with F the distribution function
//! `(r^d - A)/(B - A)` of one draw: F(r) of the l-th of m is Beta(l, m-l+1).
//!
//! A body whose denominator holds a draw of a Beta law is expanded under the mean. That is right
//! because a draw u lies in [0, 1]: every divisor is its leading term, free of u, times 1 + O(t)
//! uniformly in u (the expander refuses any other), so the body's remainder is at most `C t^N`, times
//! the powers `u^-e` that were split off. Their moments are asked to be finite; where the law moves
//! with the variable they may grow, and the remainder's mean is at most `C t^N` times them.

use super::Reason;
use super::domain::Sign;
use super::expansion::{Expander, Scope, Value, unsupported};
use super::integral::laurent;
use crate::algebra::{AlgebraError, Monomial, Polynomial, RationalFunction, Series, Symbol};
use crate::formula::{Draw, Formula, Law, Name, Part};
use rug::Rational;
use std::collections::BTreeMap;

/// Moments beyond this are refused.
const MAX_MOMENT: u64 = 256;

/// The draws that a mean is over, by the symbols that stand for them.
type Draws<'d> = Vec<(Symbol, &'d Law)>;

/// How the powers of a draw are averaged.
enum Moments {
    Beta(RationalFunction, RationalFunction),
    /// A density that is a Laurent polynomial, between two bounds.
    Density(BTreeMap<i64, RationalFunction>, Value, Value),
}

/// A draw of one sample has the distribution function `(r^power - low)/(high - low)`.
struct PowerLaw {
    power: u32,
    low: RationalFunction,
    high: RationalFunction,
}

impl Expander<'_> {
    pub(super) fn mean(
        &self,
        body: &Formula,
        own: Option<&Draw>,
        scope: &Scope,
    ) -> Result<Value, Reason> {
        let (body, draws) = self.body(body, own, scope)?;
        self.average(&body, &draws, scope)
    }

    /// The mean of the square less the square of the mean.
    pub(super) fn variance(
        &self,
        body: &Formula,
        own: Option<&Draw>,
        scope: &Scope,
    ) -> Result<Value, Reason> {
        let (body, draws) = self.body(body, own, scope)?;
        let square = match &body {
            Value::Exact(body) => Value::Exact(body.mul(body, self.budget)?),
            other => self.powi(other, 2)?,
        };
        let mean = self.average(&body, &draws, scope)?;
        let square_of_mean = self.powi(&mean, 2)?;
        self.add(
            &self.average(&square, &draws, scope)?,
            &self.negate(&square_of_mean)?,
        )
    }

    fn body<'d>(
        &'d self,
        body: &Formula,
        own: Option<&'d Draw>,
        scope: &Scope,
    ) -> Result<(Value, Draws<'d>), Reason> {
        let (mut inner, mut draws) = (scope.clone(), Draws::new());
        match own {
            None => draws.extend(self.draws.iter().map(|draw| (draw.name.clone(), &draw.law))),
            Some(draw) => {
                let symbol = self.fresh(&draw.name);
                let value = Value::Exact(RationalFunction::symbol(&symbol));
                inner.insert(draw.name.clone(), value);
                draws.push((symbol, &draw.law));
            }
        }
        let value = self.value(body, &inner)?;
        if matches!(value, Value::Expanded(_)) && self.mentions_draw(body, &inner) {
            // Its terms tell nothing of its remainder, which may have no mean.
            return unsupported("a mean of a series in the draws");
        }
        Ok((value, draws))
    }

    /// Whether a formula may depend on a draw or a variable of integration.
    fn mentions_draw(&self, body: &Formula, scope: &Scope) -> bool {
        Part::Formula(body)
            .free_names()
            .iter()
            .any(|name| match scope.get(name) {
                None => self.is_bound(name),
                Some(Value::Exact(value) | Value::Root(value, _)) => self.has_bound(value),
                Some(Value::Expanded(_)) => true,
            })
    }

    fn average(
        &self,
        body: &Value,
        draws: &[(Symbol, &Law)],
        scope: &Scope,
    ) -> Result<Value, Reason> {
        let free = |value: &RationalFunction| !draws.iter().any(|(name, _)| value.contains(name));
        let mut body = match body {
            Value::Exact(body) => body.clone(),
            Value::Root(radicand, _) if free(radicand) => return Ok(body.clone()),
            Value::Expanded(series) if series.terms().all(|(_, value)| free(value)) => {
                return Ok(body.clone());
            }
            _ => return unsupported("a mean of what is no rational function of the draws"),
        };
        let mut laws = Vec::new();
        for (symbol, law) in draws {
            if body.contains(symbol) {
                let (changed, symbol, moments) = self.normalize(&body, symbol, law, scope)?;
                body = changed;
                laws.push((symbol, moments));
            }
        }
        if let Some(value) = self.average_laurent(&body, &laws)? {
            return Ok(value);
        }
        self.average_series(&body, &laws)
    }

    /// The mean of a Laurent polynomial in the draws; nothing for another function.
    fn average_laurent(
        &self,
        body: &RationalFunction,
        laws: &[(Symbol, Moments)],
    ) -> Result<Option<Value>, Reason> {
        let Some(((symbol, moments), rest)) = laws.split_first() else {
            return Ok(Some(Value::Exact(body.clone())));
        };
        let Some(terms) = laurent(body, symbol, self)? else {
            return Ok(None);
        };
        let mut sum = Value::Exact(RationalFunction::zero());
        for (exponent, coefficient) in terms {
            let Some(inner) = self.average_laurent(&coefficient, rest)? else {
                return Ok(None);
            };
            let moment = self.moment(moments, exponent)?;
            sum = self.add(&sum, &self.multiply(&moment, &inner)?)?;
        }
        Ok(Some(sum))
    }

    /// The mean of the body's series, coefficient by coefficient; see the file's head.
    fn average_series(
        &self,
        body: &RationalFunction,
        laws: &[(Symbol, Moments)],
    ) -> Result<Value, Reason> {
        // The order to which the moments of the split off powers grow, the draws being independent.
        let mut growth: i64 = 0;
        for (symbol, moments) in laws {
            if !matches!(moments, Moments::Beta(..)) {
                return unsupported("a mean of a rational function over this law");
            }
            if let Some(exponent) = body.denominator().get(&Polynomial::symbol(symbol)) {
                let moment = self.series(&self.moment(moments, -i64::from(*exponent))?)?;
                let (valuation, lead) = moment.leading().ok_or(AlgebraError::TooFewTerms)?;
                if self.moves(lead)? {
                    return unsupported("a law with a logarithm of the variable");
                }
                growth = growth.saturating_add(valuation.min(0));
            }
        }
        let series = self.series(&Value::Exact(body.clone()))?;
        let order = series.order().map(|order| order.saturating_add(growth));
        let mut sum = order.map_or_else(Series::zero, Series::remainder);
        for (exponent, coefficient) in series.terms() {
            let Some(mean) = self.average_laurent(coefficient, laws)? else {
                return unsupported("a mean whose series has draws in a denominator");
            };
            sum = sum.add(&self.series(&mean)?.shift(exponent), self.budget)?;
        }
        Ok(Value::Expanded(sum))
    }

    fn moment(&self, moments: &Moments, exponent: i64) -> Result<Value, Reason> {
        if exponent.unsigned_abs() > MAX_MOMENT {
            return unsupported("a moment of this order");
        }
        match moments {
            Moments::Beta(a, b) => Ok(Value::Exact(self.beta_moment(a, b, exponent)?)),
            Moments::Density(density, from, to) => {
                let shifted = density
                    .iter()
                    .map(|(power, value)| (power + exponent, value.clone()));
                self.integrate(&shifted.collect(), from, to)
            }
        }
    }

    /// `(a)_j/(a+b)_j`; for negative j it is finite where a + j > 0 only.
    fn beta_moment(
        &self,
        a: &RationalFunction,
        b: &RationalFunction,
        exponent: i64,
    ) -> Result<RationalFunction, Reason> {
        let lowest = RationalFunction::integer(exponent.min(0));
        let (low, sum) = (a.add(&lowest, self.budget)?, a.add(b, self.budget)?);
        let size = exponent.saturating_abs();
        if exponent >= 0 {
            let above = self.rising(a, size)?;
            return Ok(above.div(&self.rising(&sum, size)?, self.budget)?);
        }
        self.require(Sign::Positive, &Value::Exact(low.clone()))?;
        let above = self.rising(&sum.add(&lowest, self.budget)?, size)?;
        Ok(above.div(&self.rising(&low, size)?, self.budget)?)
    }

    // Laws.

    fn parameter(&self, formula: &Formula, scope: &Scope) -> Result<RationalFunction, Reason> {
        match self.value(formula, scope)? {
            Value::Exact(value) if !self.has_bound(&value) => Ok(value),
            _ => unsupported("a law whose parameter is no rational function"),
        }
    }

    fn normalize(
        &self,
        body: &RationalFunction,
        symbol: &Symbol,
        law: &Law,
        scope: &Scope,
    ) -> Result<(RationalFunction, Symbol, Moments), Reason> {
        match law {
            Law::Beta(a, b) => {
                let (a, b) = (self.parameter(a, scope)?, self.parameter(b, scope)?);
                Ok((body.clone(), symbol.clone(), self.beta(a, b)?))
            }
            Law::Order(l, m, one) => {
                let (l, m) = (self.parameter(l, scope)?, self.parameter(m, scope)?);
                let rest = m
                    .sub(&l, self.budget)?
                    .add(&RationalFunction::one(), self.budget)?;
                let law = self.power_law(one, scope)?;
                self.to_beta(body, symbol, &law, self.beta(l, rest)?)
            }
            Law::Uniform(from, to) => {
                let (from, to) = (self.value(from, scope)?, self.value(to, scope)?);
                let length = self.add(&to, &self.negate(&from)?)?;
                self.require(Sign::Positive, &length)?;
                let (Value::Exact(length), true) = (length, laurent(body, symbol, self)?.is_some())
                else {
                    return self.to_unit(body, symbol, law, scope);
                };
                let density = BTreeMap::from([(0, length.recip(self.budget)?)]);
                Ok((
                    body.clone(),
                    symbol.clone(),
                    Moments::Density(density, from, to),
                ))
            }
            Law::Density {
                argument,
                body: density,
                from,
                to,
            } => {
                if laurent(body, symbol, self)?.is_none() {
                    return self.to_unit(body, symbol, law, scope);
                }
                let (from, to) = (self.value(from, scope)?, self.value(to, scope)?);
                let density = self.density(argument, density, scope)?;
                self.require_mass(&density, &from, &to)?;
                Ok((
                    body.clone(),
                    symbol.clone(),
                    Moments::Density(density, from, to),
                ))
            }
            Law::Any => unsupported("a law that is not told"),
        }
    }

    fn beta(&self, a: RationalFunction, b: RationalFunction) -> Result<Moments, Reason> {
        self.require(Sign::Positive, &Value::Exact(a.clone()))?;
        self.require(Sign::Positive, &Value::Exact(b.clone()))?;
        Ok(Moments::Beta(a, b))
    }

    fn density(
        &self,
        argument: &Name,
        body: &Formula,
        scope: &Scope,
    ) -> Result<BTreeMap<i64, RationalFunction>, Reason> {
        let (symbol, mut inner) = (self.fresh(argument), scope.clone());
        inner.insert(
            argument.clone(),
            Value::Exact(RationalFunction::symbol(&symbol)),
        );
        let Value::Exact(body) = self.value(body, &inner)? else {
            return unsupported("a density that is no rational function");
        };
        match laurent(&body, &symbol, self)? {
            Some(terms) if terms.len() == 1 => Ok(terms),
            _ => unsupported("a density that is no power"),
        }
    }

    /// A single power with integral 1 is a density where its coefficient is positive and the range
    /// nonnegative: a reversed range would give it a negative integral.
    fn require_mass(
        &self,
        density: &BTreeMap<i64, RationalFunction>,
        from: &Value,
        to: &Value,
    ) -> Result<(), Reason> {
        self.require(Sign::NonNegative, from)?;
        self.require(Sign::NonNegative, to)?;
        for coefficient in density.values() {
            self.require(Sign::Positive, &Value::Exact(coefficient.clone()))?;
        }
        let minus_one = Value::Exact(RationalFunction::integer(-1));
        let excess = self.add(&self.integrate(density, from, to)?, &minus_one)?;
        match excess {
            Value::Exact(excess) if excess.is_zero() => Ok(()),
            _ => unsupported("a density whose integral is not seen to be 1"),
        }
    }

    fn power_law(&self, law: &Law, scope: &Scope) -> Result<PowerLaw, Reason> {
        match law {
            Law::Uniform(from, to) => {
                let (low, high) = (self.parameter(from, scope)?, self.parameter(to, scope)?);
                let length = Value::Exact(high.sub(&low, self.budget)?);
                self.require(Sign::Positive, &length)?;
                Ok(PowerLaw {
                    power: 1,
                    low,
                    high,
                })
            }
            Law::Density {
                argument,
                body,
                from,
                to,
            } => {
                let density = self.density(argument, body, scope)?;
                let (from, to) = (self.value(from, scope)?, self.value(to, scope)?);
                self.require_mass(&density, &from, &to)?;
                let exponent = density.keys().next().map_or(0, |exponent| exponent + 1);
                let Some(power) = u32::try_from(exponent).ok().filter(|power| *power > 0) else {
                    return unsupported("a density that is a negative power");
                };
                let end = |value: &Value| match self.powi(value, exponent)? {
                    Value::Exact(value) => Ok(value),
                    _ => unsupported("a density between these bounds"),
                };
                let (low, high) = (end(&from)?, end(&to)?);
                let length = Value::Exact(high.sub(&low, self.budget)?);
                self.require(Sign::Positive, &length)?;
                Ok(PowerLaw { power, low, high })
            }
            Law::Beta(a, b) => {
                // Beta(d, 1) has the distribution function r^d.
                let (a, b) = (self.parameter(a, scope)?, self.parameter(b, scope)?);
                let power = a.as_integer().and_then(|a| u32::try_from(a).ok());
                match (power, b.as_integer()) {
                    (Some(power), Some(1)) if power > 0 => {
                        let (low, high) = (RationalFunction::zero(), RationalFunction::one());
                        Ok(PowerLaw { power, low, high })
                    }
                    _ => unsupported("an order statistic of this law"),
                }
            }
            _ => unsupported("an order statistic of this law"),
        }
    }

    /// One draw as the order statistic of itself.
    fn to_unit(
        &self,
        body: &RationalFunction,
        symbol: &Symbol,
        law: &Law,
        scope: &Scope,
    ) -> Result<(RationalFunction, Symbol, Moments), Reason> {
        let one = RationalFunction::one();
        let law = self.power_law(law, scope)?;
        self.to_beta(body, symbol, &law, Moments::Beta(one.clone(), one))
    }

    /// Replaces `r^d` by `A + (B - A) u`.
    fn to_beta(
        &self,
        body: &RationalFunction,
        symbol: &Symbol,
        law: &PowerLaw,
        moments: Moments,
    ) -> Result<(RationalFunction, Symbol, Moments), Reason> {
        let body = self.contract(body, symbol, law.power)?;
        let unit = self.fresh(symbol);
        let length = law.high.sub(&law.low, self.budget)?;
        let image = length.mul(&RationalFunction::symbol(&unit), self.budget)?;
        let image = law.low.add(&image, self.budget)?;
        Ok((body.substitute(symbol, &image, self.budget)?, unit, moments))
    }

    /// The function with `r^d` written r, where r occurs in such powers only.
    fn contract(
        &self,
        body: &RationalFunction,
        symbol: &Symbol,
        power: u32,
    ) -> Result<RationalFunction, Reason> {
        let own = Polynomial::symbol(symbol);
        let below = body.denominator().get(&own).copied().unwrap_or(0);
        let missing = (power - below % power) % power;
        let lift = Polynomial::term(Monomial::power(symbol, missing), Rational::from(1));
        let numerator = body.numerator().mul(&lift, self.budget)?;
        let mut result = RationalFunction::from(contract(&numerator, symbol, power)?);
        for (atom, exponent) in body.denominator() {
            let (atom, exponent) = match *atom == own {
                true => (atom.clone(), (below + missing) / power),
                false => (contract(atom, symbol, power)?, *exponent),
            };
            let factor = RationalFunction::from(atom).powi(-i64::from(exponent), self.budget)?;
            result = result.mul(&factor, self.budget)?;
        }
        Ok(result)
    }
}

fn contract(value: &Polynomial, symbol: &Symbol, power: u32) -> Result<Polynomial, Reason> {
    let mut result = Polynomial::zero();
    for (monomial, coefficient) in value.terms() {
        let (exponent, rest) = monomial.split(symbol);
        if exponent % power != 0 {
            return unsupported("a mean of a fractional power of an order statistic");
        }
        let monomial = rest.mul(&Monomial::power(symbol, exponent / power))?;
        result.add_term(monomial, coefficient.clone());
    }
    Ok(result)
}
