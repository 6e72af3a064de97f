//! Laws as polynomial weights on a range, and means, variances and probabilities over them.
//!
//! All laws that the kernel knows have a polynomial density, so that a mean of a fraction is the
//! integral of a fraction.

use super::functions::{binomial, factorial, integer};
use super::integrand::{Variable, fraction, over_range};
use super::integrate::{integral, sign_on};
use super::interval::{Interval, Value, integer_power};
use super::polynomial::Polynomial;
use super::scope::{Binding, Scope};
use super::value::value_in;
use super::{Unknown, unknown};
use crate::formula::{
    Condition, Draw, Formula, Function, Law, Name, Operator, RangeKind, Rational,
};
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;

/// No Beta law or order statistic of a larger sample is expanded.
const SAMPLE_CAP: u32 = 600;

/// A density that is a polynomial between two ends and zero outside.
pub(super) struct Weight {
    pub density: Polynomial,
    pub from: Interval,
    pub to: Interval,
}

impl Weight {
    /// The integral of the density from the lower end on.
    pub fn cumulative(&self, bits: u64) -> Polynomial {
        let whole = self.density.antiderivative(bits);
        let start = Polynomial::constant(whole.at(&self.from, bits).negated());
        whole.plus(&start, bits)
    }
}

/// The weight of a law; `None` where its parameters are proved to give no law.
pub(super) fn weight(law: &Law, scope: &Scope) -> Result<Option<Weight>, Unknown> {
    match law {
        Law::Beta(a, b) => {
            let (a, b) = (number(a, scope)?, number(b, scope)?);
            let (Some(a), Some(b)) = (a, b) else {
                return Ok(None);
            };
            beta(&a, &b, scope)
        }
        Law::Uniform(a, b) => {
            let (a, b) = (number(a, scope)?, number(b, scope)?);
            let (Some(a), Some(b)) = (a, b) else {
                return Ok(None);
            };
            uniform(a, b, scope)
        }
        Law::Order(l, m, of) => {
            let (l, m) = (number(l, scope)?, number(m, scope)?);
            let (Some(l), Some(m), Some(of)) = (l, m, weight(of, scope)?) else {
                return Ok(None);
            };
            order(&l, &m, of, scope)
        }
        Law::Density {
            argument,
            body,
            from,
            to,
        } => density_law(argument, body, from, to, scope),
        Law::Any => unknown("a law that is not given"),
    }
}

/// A finite parameter of a law; `None` where it has no finite value.
fn number(formula: &Formula, scope: &Scope) -> Result<Option<Interval>, Unknown> {
    Ok(value_in(formula, scope)?.finite())
}

/// x^(a-1) (1-x)^(b-1)/B(a, b), DLMF 5.12.1, for integers a and b.
fn beta(a: &Interval, b: &Interval, scope: &Scope) -> Result<Option<Weight>, Unknown> {
    if !a.high().is_positive() || !b.high().is_positive() {
        return Ok(None);
    }
    let (Some(a), Some(b)) = (small(a), small(b)) else {
        return unknown("a Beta law with parameters that are not small integers");
    };
    scope.spend(u64::from(a + b).pow(2))?;
    let below = factorial(&(a - 1).into())? * factorial(&(b - 1).into())?;
    let scale = Rational::new(factorial(&(a + b - 1).into())?, below);
    // The coefficient of x^i in (1-x)^(b-1) is (-1)^i binomial(b-1, i).
    let mut coefficients = vec![Interval::integer(0); a as usize - 1];
    let mut term = scale;
    for i in 0..b {
        coefficients.push(Interval::exact(term.clone()));
        term *= Rational::new((i64::from(i) + 1 - i64::from(b)).into(), (i + 1).into());
    }
    Ok(Some(Weight {
        density: Polynomial::new(coefficients),
        from: Interval::integer(0),
        to: Interval::integer(1),
    }))
}

fn small(number: &Interval) -> Option<u32> {
    let n = number.as_integer()?.to_u32()?;
    (1..=SAMPLE_CAP).contains(&n).then_some(n)
}

fn uniform(a: Interval, b: Interval, scope: &Scope) -> Result<Option<Weight>, Unknown> {
    match a.compare(&b) {
        Some(Ordering::Less) => {}
        Some(_) => return Ok(None),
        None => return unknown("the order of a law's ends is not settled at these bits"),
    }
    let height = b.minus(&a, scope.bits).reciprocal(scope.bits);
    let Some(height) = height else {
        return unknown("a law's ends are too near at these bits");
    };
    Ok(Some(Weight {
        density: Polynomial::constant(height),
        from: a,
        to: b,
    }))
}

/// The l-th smallest of m: its cdf is the chance H(G) that at least l of m draws are at most x,
/// H(u) the sum over j = l..m of binomial(m, j) u^j (1-u)^(m-j), G the cdf of one draw (David &
/// Nagaraja, *Order Statistics*, 2.1.3); the density is H'(G)*g.
fn order(l: &Interval, m: &Interval, of: Weight, scope: &Scope) -> Result<Option<Weight>, Unknown> {
    let one = Interval::integer(1);
    let not_integer = |x: &Interval| x.is_exact() && x.as_integer().is_none();
    let out_of_order = |a: &Interval, b: &Interval| a.compare(b) == Some(Ordering::Greater);
    if not_integer(l) || not_integer(m) || out_of_order(&one, l) || out_of_order(l, m) {
        return Ok(None);
    }
    let (Some(l), Some(m)) = (small(l), small(m)) else {
        return unknown("an order statistic whose numbers are not small integers");
    };
    let bits = scope.bits;
    let length = of.density.length() as u64 + 1;
    scope.spend(u64::from(m).pow(2) * (1 + length))?;
    let share = chance_of_at_least(l, m, bits)?.derivative(bits);
    let density = share
        .compose(&of.cumulative(bits), bits)?
        .times(&of.density, bits)?;
    Ok(Some(Weight { density, ..of }))
}

/// H(u) with all powers of 1-u expanded: the coefficient of u^i is the sum over j = l..i of
/// binomial(m, j) binomial(m-j, i-j) (-1)^(i-j).
fn chance_of_at_least(l: u32, m: u32, bits: u64) -> Result<Polynomial, Unknown> {
    let mut coefficients = vec![Interval::integer(0); m as usize + 1];
    for j in l..=m {
        let mut term = binomial(&integer(&m.into()), &j.into(), bits)?;
        for i in j..=m {
            let place = &mut coefficients[i as usize];
            *place = place.plus(&term, bits);
            let step = Rational::new((-i64::from(m - i)).into(), (i - j + 1).into());
            term = term.times(&Interval::exact(step), bits);
        }
    }
    Ok(Polynomial::new(coefficients))
}

/// The integral of a polynomial between ends that are roots of rationals, where only powers occur
/// of which the ends are rational: c r between sqrt(p) and sqrt(q) has c (q - p)/2.
fn total_between_roots(
    density: &Polynomial,
    (from, to): (&Formula, &Formula),
    scope: &Scope,
) -> Result<Option<Rational>, Unknown> {
    let mut total = Rational::zero();
    for (exponent, coefficient) in density.coefficients().iter().enumerate() {
        if coefficient.is_zero() {
            continue;
        }
        let power = exponent as u32 + 1;
        let ends = (
            power_of_root(to, power, scope)?,
            power_of_root(from, power, scope)?,
        );
        let (Some(coefficient), (Some(to), Some(from))) = (coefficient.as_exact(), ends) else {
            return Ok(None);
        };
        total += coefficient * (to - from) / Rational::from_integer(power.into());
    }
    Ok(Some(total))
}

/// The power of a formula as a rational: of `q^(1/n)` with q >= 0 or `sqrt(q)`, n dividing the
/// exponent, it is a power of q, whether or not the root is rational.
fn power_of_root(
    formula: &Formula,
    exponent: u32,
    scope: &Scope,
) -> Result<Option<Rational>, Unknown> {
    let (radicand, index) = match formula {
        Formula::Call(Function::Sqrt, arguments) => (&arguments[0], 2),
        Formula::Binary(Operator::Power, base, root) => match number(root, scope)?.as_ref() {
            Some(root) => match root.as_exact() {
                Some(root) if root.numer().is_one() => match root.denom().to_u32() {
                    Some(index) => (&**base, index),
                    None => return Ok(None),
                },
                _ => return Ok(None),
            },
            None => return Ok(None),
        },
        other => (other, 1),
    };
    let Some(radicand) = number(radicand, scope)? else {
        return Ok(None);
    };
    Ok(match radicand.as_exact() {
        Some(radicand)
            if exponent.is_multiple_of(index) && (index == 1 || !radicand.is_negative()) =>
        {
            Some(integer_power(radicand, exponent / index))
        }
        _ => None,
    })
}

/// A law given by its density: a polynomial, proved nonnegative and with integral exactly 1.
fn density_law(
    argument: &Name,
    body: &Formula,
    from: &Formula,
    to: &Formula,
    scope: &Scope,
) -> Result<Option<Weight>, Unknown> {
    let places = (from, to);
    let (Some(from), Some(to)) = (number(from, scope)?, number(to, scope)?) else {
        return unknown("a density on a range without finite ends");
    };
    let variable = Variable {
        name: argument,
        sample: None,
    };
    let inner = scope.with(argument, Binding::Variable);
    let Some(density) = fraction(body, &variable, &inner)? else {
        return unknown("a density without value");
    };
    let ends = (Value::from(from.clone()), Value::from(to.clone()));
    let total = integral(&density, &ends.0, &ends.1, scope.bits)?;
    let ordered = from.compare(&to) == Some(Ordering::Less);
    let positive = sign_on(&density, &ends.0, &ends.1, scope.bits)? == Some(Ordering::Greater);
    match density.as_polynomial() {
        Some(polynomial)
            if ordered
                && positive
                && (total == Value::exact(1)
                    || total_between_roots(polynomial, places, scope)?
                        == Some(Rational::one())) =>
        {
            Ok(Some(Weight {
                density: polynomial.clone(),
                from,
                to,
            }))
        }
        _ => unknown("a density not proved to be one"),
    }
}

/// The weight of a draw of the scope, named by a formula; `None` where it has no law.
pub(super) fn of_draw(drawn: &Formula, scope: &Scope) -> Result<Option<Weight>, Unknown> {
    match drawn {
        Formula::Name(name) if !scope.binds(name) => {
            match scope.draws.iter().find(|draw| draw.name == *name) {
                Some(draw) => weight(&draw.law, scope),
                None => unknown("the density of what is no draw"),
            }
        }
        _ => unknown("the density of a compound random quantity"),
    }
}

/// The draws that a mean is over: its own, or those of the scope that occur in the body.
fn draws_of<'a>(
    own: Option<&'a Draw>,
    occurs: impl Fn(&Name) -> bool,
    scope: &Scope<'a>,
) -> Result<Vec<&'a Draw>, Unknown> {
    if let Some(draw) = own {
        if scope.is_draw(&draw.name) {
            return unknown("a name that is drawn twice");
        }
        return Ok(vec![draw]);
    }
    let used: Vec<&Draw> = scope.draws.iter().filter(|d| occurs(&d.name)).collect();
    if used.iter().any(|draw| scope.binds(&draw.name)) {
        return unknown("a name that is both a draw and bound");
    }
    Ok(used)
}

/// The mean of a formula.
pub(super) fn mean<'a>(
    body: &Formula,
    own: Option<&'a Draw>,
    scope: &Scope<'a>,
) -> Result<Value, Unknown> {
    let draws = draws_of(own, |name| scope.depends(body, name), scope)?;
    let Some(draw) = own else {
        return mean_over(body, &draws, scope);
    };
    // The draw hides a parameter of its name from the body, not from its own law.
    let Some(weight) = weight(&draw.law, scope)? else {
        return Ok(Value::Undefined);
    };
    weighted(
        body,
        weight,
        &draw.name,
        &scope.with(&draw.name, Binding::Variable),
    )
}

fn mean_over(body: &Formula, draws: &[&Draw], scope: &Scope) -> Result<Value, Unknown> {
    scope.spend(1)?;
    let occurring = |part: &Formula| {
        let occurs = |d: &&&Draw| scope.depends(part, &d.name);
        draws.iter().filter(occurs).copied().collect::<Vec<&Draw>>()
    };
    match occurring(body).as_slice() {
        [] if draws.is_empty() => value_in(body, scope),
        [] => one_mean(body, draws[0], scope),
        [draw] => one_mean(body, draw, scope),
        _ => split_mean(body, &occurring, scope),
    }
}

fn one_mean(body: &Formula, draw: &Draw, scope: &Scope) -> Result<Value, Unknown> {
    match weight(&draw.law, scope)? {
        Some(weight) => weighted(body, weight, &draw.name, scope),
        None => Ok(Value::Undefined),
    }
}

fn weighted(body: &Formula, weight: Weight, name: &Name, scope: &Scope) -> Result<Value, Unknown> {
    let ends = (Value::from(weight.from), Value::from(weight.to));
    over_range(body, &weight.density, name, (&ends.0, &ends.1), scope)
}

/// The mean over several independent draws, where it splits: the mean of a sum of finite means is
/// their sum, and that of a product of parts with different draws the product (Fubini).
fn split_mean<'d>(
    body: &Formula,
    occurring: &impl Fn(&Formula) -> Vec<&'d Draw>,
    scope: &Scope,
) -> Result<Value, Unknown> {
    let mean_of = |part: &Formula| mean_over(part, &occurring(part), scope);
    let bits = scope.bits;
    let (a, b, operator) = match body {
        Formula::Negate(a) => return Ok(mean_of(a)?.negated()),
        Formula::Binary(operator, a, b) => (a, b, *operator),
        Formula::Ranged(r) if r.kind == RangeKind::Sum => {
            if scope.is_draw(&r.name) || scope.laws_depend(&r.name) {
                return unknown("a sum over a name that the draws know too");
            }
            let mut sum = Value::exact(0);
            super::sums::each(r, scope, |inner| {
                let term = mean_over(&r.body, &occurring(&r.body), inner)?;
                sum = sum.plus(&finite(term)?, bits);
                Ok(())
            })?;
            return Ok(sum);
        }
        _ => return unknown("a mean over several draws that does not split"),
    };
    let shared = occurring(a).iter().any(|d| scope.depends(b, &d.name));
    match operator {
        Operator::Add => Ok(finite(mean_of(a)?)?.plus(&finite(mean_of(b)?)?, bits)),
        Operator::Subtract => Ok(finite(mean_of(a)?)?.plus(&finite(mean_of(b)?)?.negated(), bits)),
        Operator::Multiply if !shared => finite(mean_of(a)?)?.times(&finite(mean_of(b)?)?, bits),
        // A part of the draws stands above, so that the recursion ends.
        Operator::Divide if !shared && !occurring(a).is_empty() => {
            let inverse = Formula::binary(Operator::Divide, Formula::integer(1), (**b).clone());
            finite(mean_of(a)?)?.times(&finite(mean_of(&inverse)?)?, bits)
        }
        _ => unknown("a mean over several draws that does not split"),
    }
}

fn finite(value: Value) -> Result<Value, Unknown> {
    match value {
        Value::Finite { .. } => Ok(value),
        _ => unknown("a mean over several draws with a part that is not finite"),
    }
}

/// The variance: mean(e^2) - mean(e)^2, where mean(e) is finite; never negative.
pub(super) fn variance<'a>(
    body: &Formula,
    own: Option<&'a Draw>,
    scope: &Scope<'a>,
) -> Result<Value, Unknown> {
    let first = mean(body, own, scope)?;
    let Some(first) = first.finite() else {
        return Ok(Value::Undefined);
    };
    let squared = Formula::binary(Operator::Power, body.clone(), Formula::integer(2));
    let second = mean(&squared, own, scope)?;
    let Some(second) = second.finite() else {
        return Ok(second);
    };
    let difference = second.minus(&first.power(2, scope.bits), scope.bits);
    Ok(difference.maximum(&Interval::integer(0)).into())
}

/// The probability of a condition: the mean of its indicator.
pub(super) fn probability<'a>(
    condition: &Condition,
    own: Option<&'a Draw>,
    scope: &Scope<'a>,
) -> Result<Value, Unknown> {
    let indicator = Formula::Indicator(Box::new(condition.clone()));
    mean(&indicator, own, scope)
}

/// The density of a draw at a number, ends of its support counted in.
pub(super) fn density_at(drawn: &Formula, at: &Formula, scope: &Scope) -> Result<Value, Unknown> {
    let (weight, place) = (of_draw(drawn, scope)?, value_in(at, scope)?);
    let (Some(weight), false) = (weight, place == Value::Undefined) else {
        return Ok(Value::Undefined);
    };
    let Some(place) = place.finite() else {
        return unknown("a density at infinity");
    };
    match (weight.from.compare(&place), place.compare(&weight.to)) {
        (Some(Ordering::Greater), _) | (_, Some(Ordering::Greater)) => Ok(Value::exact(0)),
        (Some(_), Some(_)) => Ok(weight.density.at(&place, scope.bits).into()),
        _ => unknown("a density too near to an end of its support at these bits"),
    }
}

/// The probability that a random quantity is at most a number.
pub(super) fn cumulative_at(
    quantity: &Formula,
    at: &Formula,
    scope: &Scope,
) -> Result<Value, Unknown> {
    let links = vec![(crate::formula::Relation::LessEqual, at.clone())];
    let condition = Condition::Chain(quantity.clone(), links);
    if scope.draws.iter().any(|draw| scope.depends(at, &draw.name)) {
        return unknown("a cdf at a random place");
    }
    probability(&condition, None, scope)
}
