//! A point at which an expansion fails: small values of the other parameters.

use super::domain::{Facts, Sign};
use super::{Approach, Reason};
use crate::algebra::{Polynomial, RationalFunction, Symbol};
use crate::formula::{Budget, Name, ParameterKind, Point, Proposition};
use crate::number::Interval;
use crate::number::convert::from_rug;
use rug::Rational;
use std::collections::BTreeMap;

/// So many points are tried.
const MAX_POINTS: usize = 4000;

/// Values tried for a parameter, the likeliest first.
fn candidates(integer: bool) -> Vec<Rational> {
    let whole = [1, 2, 3, 4, 5, 6, 7, 0, -1, -2].map(|value: i32| Rational::from(value));
    match integer {
        true => whole.into(),
        false => {
            let broken = [(1, 2), (1, 3), (3, 2), (-1, 2)].map(Rational::from);
            whole.into_iter().chain(broken).collect()
        }
    }
}

/// What a point must satisfy, as the variable nears its target.
pub(super) struct Failure<'a> {
    pub approach: &'a Approach,
    /// Must not vanish: the first differing coefficient, and the leading ones of the gauge.
    pub nonzero: Vec<RationalFunction>,
    /// Signs that must hold near the target: what the series rest on, and the domain.
    pub signs: Vec<(Sign, Polynomial)>,
    /// Symbols that stand for `ln |p|`, with p.
    pub logarithms: &'a BTreeMap<Symbol, Polynomial>,
    pub budget: &'a Budget,
}

type Values = BTreeMap<Symbol, Rational>;

impl Failure<'_> {
    /// The first of the small points that fits, over all parameters but those named.
    pub(super) fn find(
        &self,
        proposition: &Proposition,
        facts: &Facts,
        without: &[Name],
    ) -> Result<Option<Point>, Reason> {
        let parameters = proposition.parameters.iter();
        let names: Vec<Name> = parameters
            .filter(|parameter| !matches!(parameter.kind, ParameterKind::Function { .. }))
            .map(|parameter| parameter.name.clone())
            .filter(|name| !without.contains(name))
            .collect();
        let choices: Vec<_> = names
            .iter()
            .map(|name| candidates(facts.is_integer(name)))
            .collect();
        let mut tried = 0;
        for total in 0..=choices.iter().map(Vec::len).sum::<usize>() {
            for indices in compositions(total, &choices, MAX_POINTS) {
                tried += 1;
                if tried > MAX_POINTS {
                    return Ok(None);
                }
                let picked = names.iter().zip(&choices).zip(&indices);
                let values: Values = picked
                    .map(|((name, choice), index)| (name.clone(), choice[*index].clone()))
                    .collect();
                if self.fits(&values)? {
                    let numbers = values.iter();
                    let numbers = numbers.map(|(name, value)| (name.clone(), from_rug(value)));
                    return Ok(Some(Point {
                        numbers: numbers.collect(),
                        ..Point::default()
                    }));
                }
            }
        }
        Ok(None)
    }

    fn fits(&self, values: &Values) -> Result<bool, Reason> {
        self.budget.spend(10)?;
        for (sign, polynomial) in &self.signs {
            if !self.eventually(*sign, &polynomial.evaluate(values, self.budget)?)? {
                return Ok(false);
            }
        }
        for coefficient in &self.nonzero {
            if !self.certainly_nonzero(coefficient, values)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a polynomial in the variable alone has the sign near the target.
    fn eventually(&self, sign: Sign, polynomial: &Polynomial) -> Result<bool, Reason> {
        let series = self.approach.polynomial(polynomial, self.budget)?;
        let Some((exponent, lead)) = series.leading() else {
            return Ok(sign == Sign::NonNegative);
        };
        // A power of pi does not change the sign.
        let mut terms = lead.numerator().terms();
        let (Some((monomial, lead)), None) = (terms.next(), terms.next()) else {
            return Ok(false);
        };
        if monomial
            .powers()
            .iter()
            .any(|(symbol, _)| **symbol != *"pi")
        {
            return Ok(false);
        }
        Ok(match sign {
            Sign::NonZero => true,
            _ => *lead > 0 && (exponent % 2 == 0 || !self.approach.two_sided()),
        })
    }

    fn certainly_nonzero(
        &self,
        coefficient: &RationalFunction,
        values: &Values,
    ) -> Result<bool, Reason> {
        for atom in coefficient.denominator().keys() {
            if atom.evaluate(values, self.budget)?.is_zero() {
                return Ok(false);
            }
        }
        let numerator = coefficient.numerator().evaluate(values, self.budget)?;
        let symbols = numerator.symbols();
        // pi is transcendental, and the variable's logarithm grows: a polynomial in one of them
        // vanishes only if it is zero.
        let free = |symbol: &Symbol| **symbol == *"pi" || *symbol == self.approach.log_symbol();
        if symbols.len() <= 1 && symbols.iter().all(free) {
            return Ok(!numerator.is_zero());
        }
        let mut sum = Interval::from_rational(&Rational::new(), PRECISION);
        for (monomial, value) in numerator.terms() {
            let mut term = Interval::from_rational(value, PRECISION);
            for (symbol, exponent) in monomial.powers() {
                let Some(logarithm) = self.enclose(symbol, values)? else {
                    return Ok(false);
                };
                let Ok(power) = logarithm.powi(i64::from(*exponent)) else {
                    return Ok(false);
                };
                term = term.mul(&power);
            }
            sum = sum.add(&term);
        }
        Ok(!sum.contains_zero())
    }

    /// The value of `ln |p|` or of pi.
    fn enclose(&self, symbol: &Symbol, values: &Values) -> Result<Option<Interval>, Reason> {
        if **symbol == *"pi" {
            return Ok(Some(Interval::pi(PRECISION)));
        }
        let Some(argument) = self.logarithms.get(symbol) else {
            return Ok(None);
        };
        let argument = argument.evaluate(values, self.budget)?.as_constant();
        let argument = argument.filter(|value| *value != 0).map(Rational::abs);
        Ok(argument.and_then(|value| Interval::from_rational(&value, PRECISION).ln().ok()))
    }
}

/// Bits for the sign of a coefficient that holds logarithms.
const PRECISION: u32 = 256;

/// All ways to choose one index a list with the given sum, at most `cap` of them.
fn compositions(total: usize, choices: &[Vec<Rational>], cap: usize) -> Vec<Vec<usize>> {
    let Some((first, rest)) = choices.split_first() else {
        return if total == 0 {
            vec![Vec::new()]
        } else {
            Vec::new()
        };
    };
    let mut found = Vec::new();
    for index in 0..first.len().min(total + 1) {
        for mut tail in compositions(total - index, rest, cap) {
            if found.len() >= cap {
                return found;
            }
            tail.insert(0, index);
            found.push(tail);
        }
    }
    found
}
