//! Laws as polynomial weights on a range, and means, variances and probabilities over them.
//!
//! All laws that the kernel knows have a polynomial density, so that a mean of a fraction is the
//! integral of a fraction.

use super::functions::factorial;
use super::integrand::over_range;
use super::integrate::Piece;
use super::interval::Interval;
use super::polynomial::Polynomial;
use super::quantity::Quantity;
use super::scope::Scope;
use super::value::{evaluate, finite, number};
use super::{Found, Gap, Unknown, known, unknown};
use crate::formula::{Condition, Draw, Formula, Law, Name, Operator, Part, Rational, Relation};
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use std::cmp::Ordering;

/// No Beta law or order statistic of a larger sample is expanded.
const SAMPLE_CAP: u32 = 600;

/// A density that is a polynomial between two ends and zero outside.
pub(super) struct Weight {
    pub density: Polynomial,
    pub from: Interval,
    pub to: Interval,
}

/// The weight of a law; none where its parameters are proved to give no law.
pub(super) fn weight(law: &Law, scope: &Scope) -> Found<Weight> {
    match law {
        Law::Beta(a, b) => beta(&number(a, scope)?, &number(b, scope)?, scope),
        Law::Uniform(a, b) => uniform(number(a, scope)?, number(b, scope)?),
        Law::Order(l, m, of) => order(
            &number(l, scope)?,
            &number(m, scope)?,
            weight(of, scope)?,
            scope,
        ),
        Law::Density {
            argument,
            body,
            from,
            to,
        } => Ok(density_law(argument, body, from, to, scope)?),
        Law::Any => unknown("a law that is not given"),
    }
}

/// x^(a-1) (1-x)^(b-1)/B(a, b), DLMF 5.12.1, for integers a and b: the law of the a-th of a+b-1
/// uniform draws.
fn beta(a: &Interval, b: &Interval, scope: &Scope) -> Found<Weight> {
    let zero = Interval::integer(0);
    if a.compare(&zero)?.is_le() || b.compare(&zero)?.is_le() {
        return Err(Gap::Undefined);
    }
    if a.as_integer().is_none() || b.as_integer().is_none() {
        return unknown("a Beta law with parameters that are not integers");
    }
    let one = Interval::integer(1);
    let unit = uniform(zero, one.clone())?;
    order(a, &(&(a + b) - &one), unit, scope)
}

fn uniform(from: Interval, to: Interval) -> Found<Weight> {
    let width = &to - &from;
    if width.sign()?.is_le() {
        return Err(Gap::Undefined);
    }
    let density = Polynomial::constant(width.reciprocal()?);
    Ok(Weight { density, from, to })
}

/// The l-th smallest of m has the density m!/((l-1)!(m-l)!) G^(l-1) (1-G)^(m-l) g for draws with
/// the density g and the cdf G (David & Nagaraja, *Order Statistics*, 2.1.6).
fn order(l: &Interval, m: &Interval, of: Weight, scope: &Scope) -> Found<Weight> {
    let not_integer = |x: &Interval| x.as_exact().is_some_and(|x| !x.is_integer());
    let below_one = l.compare(&Interval::integer(1))?.is_lt();
    if not_integer(l) || not_integer(m) || below_one || l.compare(m)?.is_gt() {
        return Err(Gap::Undefined);
    }
    let small = |x: &Interval| x.as_integer()?.to_u32().filter(|&n| n <= SAMPLE_CAP);
    let (Some(l), Some(m)) = (small(l), small(m)) else {
        return unknown("an order statistic whose numbers are not small integers");
    };
    // The cdf of one draw, and 1 less that.
    let whole = of.density.antiderivative();
    let below = &whole + &Polynomial::constant(-&whole.at(&of.from));
    let minus = below.scaled(&Interval::integer(-1));
    let above = &Polynomial::constant(Interval::integer(1)) + &minus;
    let count = |n: u32| factorial(&BigInt::from(n));
    let scale = Rational::new(count(m)?, count(l - 1)? * count(m - l)?);
    let density = below
        .power(l - 1)?
        .times(&above.power(m - l)?)?
        .times(&of.density)?
        .scaled(&Interval::exact(scale));
    scope.spend((density.length() as u64).pow(2))?;
    Ok(Weight { density, ..of })
}

/// A law given by its density: a polynomial, proved nonnegative and with integral exactly 1.
fn density_law(
    argument: &Name,
    body: &Formula,
    from: &Formula,
    to: &Formula,
    scope: &Scope,
) -> Result<Weight, Unknown> {
    let refused = "a density not proved to be one";
    let settle = |found| known(found, refused);
    let body = known(finite(body, &scope.with_variable(argument)), refused)?;
    let Some(density) = body.as_polynomial().cloned() else {
        return unknown(refused);
    };
    // End by end, as a power of a root is simpler than the root.
    let mut total = Interval::integer(0);
    for (n, c) in (1..).zip(density.antiderivative().coefficients().iter().skip(1)) {
        let power = |end: &Formula| {
            let exponent = Formula::integer(n);
            number(
                &Formula::binary(Operator::Power, end.clone(), exponent),
                scope,
            )
        };
        if !c.is_zero() {
            let difference = &settle(power(to))? - &settle(power(from))?;
            total = &total + &(c * &difference);
        }
    }
    let (from, to) = (settle(number(from, scope))?, settle(number(to, scope))?);
    let piece = Piece::new(&body, from.clone(), to.clone())?;
    let ordered = from.compare(&to)?.is_lt();
    if total == Interval::integer(1) && ordered && piece.sign()? == Some(Ordering::Greater) {
        return Ok(Weight { density, from, to });
    }
    unknown(refused)
}

/// The mean of a formula over its own draw, or over the draw of the scope that occurs in it.
pub(super) fn mean(body: &Formula, own: Option<&Draw>, scope: &Scope) -> Found<Quantity> {
    let Some((draw, inner)) = draw_of(body, own, scope)? else {
        return evaluate(body, scope);
    };
    let weight = weight(&draw.law, scope)?;
    let ends = (&weight.from.into(), &weight.to.into());
    over_range(body, &weight.density, &draw.name, ends, &inner)
}

/// The draw that a mean is over, if any, and the scope of its body.
pub(super) fn draw_of<'a>(
    body: &Formula,
    own: Option<&'a Draw>,
    scope: &Scope<'a>,
) -> Result<Option<(&'a Draw, Scope<'a>)>, Unknown> {
    if let Some(draw) = own {
        // The draw hides a parameter of its name from the body, not from its own law.
        return match scope.draw(&draw.name) {
            Some(_) => unknown("a name that is drawn twice"),
            None => Ok(Some((draw, scope.with_variable(&draw.name)))),
        };
    }
    let part = Part::Formula(body);
    let mut used = scope.draws.iter().filter(|d| scope.occurs(&d.name, part));
    match (used.next(), used.next()) {
        (None, _) => Ok(None),
        (Some(draw), None) if !scope.binds(&draw.name) => {
            Ok(Some((draw, scope.with_draw(&draw.name))))
        }
        _ => unknown("a mean over several draws, or over a name that is bound as well"),
    }
}

/// The variance: mean(e^2) - mean(e)^2, where mean(e) is finite; never negative.
pub(super) fn variance(body: &Formula, own: Option<&Draw>, scope: &Scope) -> Found<Quantity> {
    let Quantity::Finite(first) = mean(body, own, scope)? else {
        return Err(Gap::Undefined);
    };
    let squared = Formula::binary(Operator::Power, body.clone(), Formula::integer(2));
    match mean(&squared, own, scope)? {
        Quantity::Finite(second) => {
            let difference = second.plus(&first.power(2)?.negated())?;
            let difference = Quantity::from(difference).number()?;
            Ok(difference.maximum(&Interval::integer(0)).into())
        }
        infinite => Ok(infinite),
    }
}

/// The probability of a condition: the mean of its indicator.
pub(super) fn probability(
    condition: &Condition,
    own: Option<&Draw>,
    scope: &Scope,
) -> Found<Quantity> {
    mean(&Formula::Indicator(Box::new(condition.clone())), own, scope)
}

/// The density of a draw at a number, ends of its support counted in.
pub(super) fn density_at(drawn: &Formula, place: &Formula, scope: &Scope) -> Found<Quantity> {
    let draw = match drawn {
        Formula::Name(name) if !scope.binds(name) => scope.draw(name),
        _ => None,
    };
    let Some(draw) = draw else {
        return unknown("the density of what is no draw");
    };
    let (weight, place) = (weight(&draw.law, scope)?, number(place, scope)?);
    if place.compare(&weight.from)?.is_lt() || place.compare(&weight.to)?.is_gt() {
        return Ok(Interval::integer(0).into());
    }
    Ok(weight.density.at(&place).into())
}

/// The probability that a random quantity is at most a number. Neither may lack a value: the
/// relation would then be false, and the probability 0.
pub(super) fn cumulative_at(quantity: &Formula, place: &Formula, scope: &Scope) -> Found<Quantity> {
    number(place, scope)?;
    let nothing = Formula::binary(Operator::Multiply, Formula::integer(0), quantity.clone());
    known(mean(&nothing, None, scope), "the cdf of what has no value")?;
    let links = vec![(Relation::LessEqual, place.clone())];
    probability(&Condition::Chain(quantity.clone(), links), None, scope)
}
