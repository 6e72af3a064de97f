//! Definite integrals of rational functions by partial fractions:
//!
//! ```text
//! f(x) = p(x) + sum over poles r of  c_1/(x-r) + c_2/(x-r)^2 + ...
//! ```
//!
//! The integral converges unless a pole lies on the closed range, or the degree at an infinite bound is
//! above -2. A divergent one is infinite when the integrand is of one sign, else it has no value.

use super::closed::{ln_of, minus, order, plus, rational, times, to_power};
use super::fraction::{Fraction, Polynomial, divide_linear, evaluate, power};
use super::quantity::{Quantity, Separable, Symbol, Term};
use super::sign::{self, Sign};
use super::{Failure, Outcome, undecided, unsupported};
use crate::formula::Budget;
use crate::number::Exact;
use rug::Rational;
use std::cmp::Ordering;

/// An end of a range.
#[derive(Clone, Debug)]
pub(super) enum Bound {
    Finite(Exact),
    PlusInfinity,
    MinusInfinity,
}

impl Bound {
    pub fn compare(&self, other: &Bound) -> Result<Ordering, Failure> {
        match (self, other) {
            (Bound::Finite(a), Bound::Finite(b)) => order(a, b),
            (Bound::PlusInfinity, Bound::PlusInfinity)
            | (Bound::MinusInfinity, Bound::MinusInfinity) => Ok(Ordering::Equal),
            (Bound::PlusInfinity, _) | (_, Bound::MinusInfinity) => Ok(Ordering::Greater),
            (Bound::MinusInfinity, _) | (_, Bound::PlusInfinity) => Ok(Ordering::Less),
        }
    }

    /// Rationals at or below and at or above the bound, close together; `None` inside for infinity.
    pub fn neighbours(&self) -> Option<(Option<Rational>, Option<Rational>)> {
        match self {
            Bound::Finite(value) => match value.as_rational() {
                Some(value) => Some((Some(value.clone()), Some(value))),
                None => {
                    let (low, high) = value.enclose(128).ends_as_rationals()?;
                    Some((Some(low), Some(high)))
                }
            },
            _ => Some((None, None)),
        }
    }
}

/// A function in partial fractions.
struct Parts {
    polynomial: Polynomial,
    /// For each pole the coefficients of (x-r)^-1, (x-r)^-2, ...
    poles: Vec<(Rational, Vec<Rational>)>,
}

/// The integral of `function` from `from` to `to`, where `from < to`.
pub(super) fn definite(
    function: &Fraction,
    from: &Bound,
    to: &Bound,
    budget: &Budget,
) -> Result<Outcome<Exact>, Failure> {
    if function.is_zero() {
        return Ok(Outcome::Value(rational(Rational::new())));
    }
    let function = function.split(budget)?;
    if diverges(&function, from, to)? {
        return divergent(&function, from, to, budget);
    }
    let parts = partial_fractions(&function, budget)?;
    between(&parts, from, to, budget).map(Outcome::Value)
}

fn diverges(function: &Fraction, from: &Bound, to: &Bound) -> Result<bool, Failure> {
    let unbounded = !matches!((from, to), (Bound::Finite(_), Bound::Finite(_)));
    if unbounded && function.degree().is_some_and(|degree| degree >= -1) {
        return Ok(true);
    }
    for (root, exponent) in &function.factors {
        let root = Bound::Finite(rational(root.clone()));
        if *exponent < 0 && from.compare(&root)?.is_le() && root.compare(to)?.is_le() {
            return Ok(true);
        }
    }
    Ok(false)
}

fn divergent(
    function: &Fraction,
    from: &Bound,
    to: &Bound,
    budget: &Budget,
) -> Result<Outcome<Exact>, Failure> {
    infinite(sign::on(function, from, to, budget)?)
}

/// What a divergent integral of an integrand of that sign is.
pub(super) fn infinite<T>(sign: Sign) -> Result<Outcome<T>, Failure> {
    match sign {
        Sign::NonNegative => Ok(Outcome::PlusInfinity),
        Sign::NonPositive => Ok(Outcome::MinusInfinity),
        Sign::Mixed => Ok(Outcome::Undefined),
        Sign::Unknown => Err(undecided("the sign of a divergent integrand")),
    }
}

fn partial_fractions(function: &Fraction, budget: &Budget) -> Result<Parts, Failure> {
    let numerator = function.expanded_numerator(budget)?;
    let poles: Vec<(Rational, u64)> = function
        .factors
        .iter()
        .filter(|(_, e)| *e < 0)
        .map(|(r, e)| (r.clone(), e.unsigned_abs()))
        .collect();
    let mut parts = Parts {
        polynomial: numerator.clone(),
        poles: vec![],
    };
    for (root, order) in &poles {
        for _ in 0..*order {
            if parts.polynomial.is_empty() {
                break;
            }
            spend_pass(&parts.polynomial, budget)?;
            parts.polynomial = divide_linear(&parts.polynomial, root).0;
        }
        let principal = principal_part(&numerator, root, *order, &poles, budget)?;
        parts.poles.push((root.clone(), principal));
    }
    Ok(parts)
}

/// A pass over all coefficients, which are about as long as the longest.
fn spend_pass(polynomial: &[Rational], budget: &Budget) -> Result<(), Failure> {
    let middle = polynomial.len() / 2;
    let bits = polynomial.get(middle).map_or(0, super::fraction::bits);
    budget.spend((polynomial.len() as u64).saturating_mul(1 + bits / 64) / 4 + 1)?;
    Ok(())
}

/// The coefficients of (x-r)^-1, ... at the pole `r`: the Taylor coefficients there of the numerator
/// times the other poles' factors.
fn principal_part(
    numerator: &Polynomial,
    root: &Rational,
    order: u64,
    poles: &[(Rational, u64)],
    budget: &Budget,
) -> Result<Vec<Rational>, Failure> {
    let lone = poles.len() == 1;
    let terms = if lone {
        order.min(numerator.len() as u64)
    } else {
        order
    };
    if terms > 10_000 {
        return Err(Failure::TooLarge("a pole's order".into()));
    }
    let mut taylor = vec![];
    let mut rest = numerator.clone();
    for _ in 0..terms {
        spend_pass(&rest, budget)?;
        let (quotient, value) = divide_linear(&rest, root);
        taylor.push(value);
        rest = quotient;
    }
    for (other, exponent) in poles.iter().filter(|(other, _)| other != root) {
        let series = inverse_power_series(&Rational::from(root - other), *exponent, terms, budget)?;
        taylor = truncated_product(&taylor, &series, budget)?;
    }
    // taylor[i] belongs to (x-r)^(i-order).
    let absent =
        usize::try_from(order - terms).map_err(|_| Failure::TooLarge("a pole's order".into()))?;
    if absent > 10_000 {
        return Err(Failure::TooLarge("a pole's order".into()));
    }
    let mut principal = vec![Rational::new(); absent];
    principal.extend(taylor.into_iter().rev());
    Ok(principal)
}

/// (d + t)^-n to so many terms: the binomial series.
fn inverse_power_series(
    d: &Rational,
    n: u64,
    terms: u64,
    budget: &Budget,
) -> Result<Vec<Rational>, Failure> {
    let exponent = i64::try_from(n).map_err(|_| Failure::TooLarge("a pole's order".into()))?;
    let mut coefficient = power(d, -exponent, budget)?;
    let mut series = vec![];
    for i in 0..terms {
        series.push(coefficient.clone());
        coefficient *= Rational::from((-exponent - i as i64, i + 1));
        coefficient /= d;
    }
    Ok(series)
}

fn truncated_product(
    a: &[Rational],
    b: &[Rational],
    budget: &Budget,
) -> Result<Vec<Rational>, Failure> {
    budget.spend((a.len() as u64).saturating_mul(b.len() as u64))?;
    let mut product = vec![Rational::new(); a.len()];
    for (i, left) in a.iter().enumerate() {
        for (j, right) in b.iter().enumerate().take(a.len() - i) {
            product[i + j] += Rational::from(left * right);
        }
    }
    Ok(product)
}

/// The difference of the antiderivative.
fn between(parts: &Parts, from: &Bound, to: &Bound, budget: &Budget) -> Result<Exact, Failure> {
    if let (Some(a), Some(b)) = (from.rational(), to.rational()) {
        return between_rationals(parts, &a, &b, budget);
    }
    let upper = at_bound(parts, to, budget)?;
    let lower = at_bound(parts, from, budget)?;
    minus(&upper, &lower, budget)
}

impl Bound {
    fn rational(&self) -> Option<Rational> {
        match self {
            Bound::Finite(value) => value.as_rational(),
            _ => None,
        }
    }
}

fn between_rationals(
    parts: &Parts,
    a: &Rational,
    b: &Rational,
    budget: &Budget,
) -> Result<Exact, Failure> {
    let integral = antiderivative(&parts.polynomial);
    spend_pass(&integral, budget)?;
    let mut sum = evaluate(&integral, b) - evaluate(&integral, a);
    let mut logarithms = vec![];
    for (root, coefficients) in &parts.poles {
        let upper = Rational::from(b - root);
        let lower = Rational::from(a - root);
        sum += rational_part(coefficients, &upper, budget)?
            - rational_part(coefficients, &lower, budget)?;
        match coefficients.first() {
            Some(first) if *first != 0 => logarithms.push((first, (upper / lower).abs())),
            _ => {}
        }
    }
    let mut total = rational(sum);
    for (coefficient, ratio) in logarithms {
        let part = times(&rational(coefficient.clone()), &ln_of(&ratio)?, budget)?;
        total = plus(&total, &part, budget)?;
    }
    Ok(total)
}

/// The sum of c_j/(1-j) * d^(1-j) over j >= 2.
fn rational_part(
    coefficients: &[Rational],
    d: &Rational,
    budget: &Budget,
) -> Result<Rational, Failure> {
    let Some(higher) = coefficients.get(1..) else {
        return Ok(Rational::new());
    };
    budget.spend(1 + higher.len() as u64)?;
    let inverse = Rational::from(d.recip_ref());
    let mut value = Rational::new();
    for (index, coefficient) in higher.iter().enumerate().rev() {
        value -= coefficient / Rational::from(index as u64 + 1);
        value *= &inverse;
    }
    Ok(value)
}

pub(super) fn antiderivative(polynomial: &[Rational]) -> Polynomial {
    let mut integral = vec![Rational::new()];
    let terms = polynomial.iter().enumerate();
    integral.extend(terms.map(|(j, c)| c / Rational::from(j as u64 + 1)));
    integral
}

/// The antiderivative at a bound; at infinity its limit, where the integral converges: then there is
/// no polynomial part and the residues add up to 0.
fn at_bound(parts: &Parts, bound: &Bound, budget: &Budget) -> Result<Exact, Failure> {
    let mut sum = rational(Rational::new());
    let Bound::Finite(x) = bound else {
        return Ok(sum);
    };
    for coefficient in antiderivative(&parts.polynomial).iter().rev() {
        sum = plus(
            &times(&sum, x, budget)?,
            &rational(coefficient.clone()),
            budget,
        )?;
    }
    for (root, coefficients) in &parts.poles {
        let distance = minus(x, &rational(root.clone()), budget)?;
        for (index, coefficient) in coefficients.iter().enumerate() {
            if *coefficient == 0 {
                continue;
            }
            let part = if index == 0 {
                super::functions::ln(&super::closed::absolute(&distance)?, budget)?
            } else {
                to_power(&distance, -(index as i64), budget)?
            };
            let factor = match index {
                0 => coefficient.clone(),
                _ => -(coefficient / Rational::from(index as u64)),
            };
            sum = plus(&sum, &times(&part, &rational(factor), budget)?, budget)?;
        }
    }
    Ok(sum)
}

/// The integral over one symbol of a sum of products, `from < to`.
pub(super) fn over(
    function: &Separable,
    symbol: Symbol,
    from: &Bound,
    to: &Bound,
    budget: &Budget,
) -> Result<Outcome<Quantity>, Failure> {
    map_terms(function, symbol, budget, |factor| {
        definite(factor, from, to, budget)
    })
}

/// Replaces the factor of `symbol` in every term by a number. One that is infinite is so only for a
/// single term without other variables.
pub(super) fn map_terms(
    function: &Separable,
    symbol: Symbol,
    budget: &Budget,
    number: impl Fn(&Fraction) -> Result<Outcome<Exact>, Failure>,
) -> Result<Outcome<Quantity>, Failure> {
    let one = Fraction::constant(Rational::from(1));
    let mut sum = Separable { terms: vec![] };
    for term in &function.terms {
        // The integral of 0 is 0, over a range without end too.
        if term.coefficient.is_zero() == Some(true) {
            continue;
        }
        let value = match number(term.factors.get(&symbol).unwrap_or(&one))? {
            Outcome::Value(value) => value,
            other if function.terms.len() == 1 && term.others(symbol) == 0 => {
                let scale = Outcome::Value(term.coefficient.clone());
                let product =
                    super::outcome::multiply(scale, other, super::closed::sign, |_, _| {
                        Err(unsupported("a divergent integral"))
                    });
                return Ok(product?.map(Quantity::Closed));
            }
            _ => return Err(unsupported("a divergent integral among other terms")),
        };
        let mut rest: Term = term.clone();
        rest.factors.remove(&symbol);
        rest.coefficient = times(&rest.coefficient, &value, budget)?;
        sum.push(rest, budget)?;
    }
    Ok(Outcome::Value(sum.simplified()))
}

impl Term {
    /// How many variables other than `symbol` the term has.
    fn others(&self, symbol: Symbol) -> usize {
        self.factors
            .keys()
            .filter(|other| **other != symbol)
            .count()
    }
}

/// The integral of a polynomial in one symbol between bounds that are functions of other symbols.
pub(super) fn between_functions(
    function: &Separable,
    symbol: Symbol,
    from: Quantity,
    to: Quantity,
    budget: &Budget,
) -> Result<Outcome<Quantity>, Failure> {
    let one = Fraction::constant(Rational::from(1));
    let mut sum = Quantity::rational(Rational::new());
    for term in &function.terms {
        let factor = term.factors.get(&symbol).unwrap_or(&one).split(budget)?;
        if factor.factors.iter().any(|(_, e)| *e < 0) {
            return Err(unsupported(
                "an integral of this kind between variable bounds",
            ));
        }
        let integral = antiderivative(&factor.expanded_numerator(budget)?);
        let upper = at_quantity(&integral, &to, budget)?;
        let lower = at_quantity(&integral, &from, budget)?.negate(budget)?;
        let mut rest = term.clone();
        rest.factors.remove(&symbol);
        let rest = Separable { terms: vec![rest] }.simplified();
        sum = sum.add(upper.add(lower, budget)?.multiply(rest, budget)?, budget)?;
    }
    Ok(Outcome::Value(sum))
}

/// A polynomial at a quantity.
pub(super) fn at_quantity(
    polynomial: &[Rational],
    x: &Quantity,
    budget: &Budget,
) -> Result<Quantity, Failure> {
    let mut value = Quantity::rational(Rational::new());
    for coefficient in polynomial.iter().rev() {
        value = value.multiply(x.clone(), budget)?;
        value = value.add(Quantity::rational(coefficient.clone()), budget)?;
    }
    Ok(value)
}
