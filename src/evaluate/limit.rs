//! Limits at finite places by continuity: the value there, for formulas made of operations that are
//! continuous where they have a value. In the interior of their domains:
//!
//! sums, products, quotients by what is not 0, powers of what is positive (or to fixed natural exponents),
//! `sqrt`, `ln`, `gamma`, ... of what is positive, `hyp2f1` for c > 0 and z < 1; means and integrals of
//! rational functions whose poles stay away from the closed range. Everything else is refused.

use super::exact::{Evaluation, bound, value};
use super::integrate::Bound;
use super::quantity::Quantity;
use super::scope::{Binding, Scope};
use super::{Failure, Outcome, enclose, law, undecided, unsupported};
use crate::formula::{Draw, Formula, Function, Law, Name, Operator, Part, RangeKind, Ranged};
use crate::number::Interval;
use rug::Rational;
use std::cmp::Ordering;

use Outcome::{PlusInfinity, Undefined, Value};

/// `lim(body, name -> place, ...)`
pub(super) fn exact(body: &Formula, places: &[(Name, Formula)], scope: &Scope) -> Evaluation {
    let mut values = vec![];
    for (name, place) in places {
        match value(place, scope)? {
            Value(place) => values.push((name, Quantity::Closed(place.closed("a limit's place")?))),
            Undefined => return Ok(Undefined),
            _ => return Err(unsupported("a limit at infinity")),
        }
    }
    let names: Vec<&Name> = places.iter().map(|(name, _)| name).collect();
    bound(body, &values, scope, &mut |body, scope| {
        at_place(body, &names, scope)
    })
}

fn at_place(body: &Formula, names: &[&Name], scope: &Scope) -> Evaluation {
    let outcome = value(body, scope)?;
    match outcome {
        Value(_) => {
            continuous(body, names, scope)?;
            Ok(outcome)
        }
        // Fatou's lemma: the limit of the means is at least the mean of the limit.
        PlusInfinity if is_nonnegative_mean(body, names, scope)? => Ok(PlusInfinity),
        _ => Err(undecided("a limit where the formula has no finite value")),
    }
}

/// Whether the formula depends on the names; a mean does through its laws.
fn depends(formula: &Formula, names: &[&Name], scope: &Scope) -> Result<bool, Failure> {
    let free = Part::Formula(formula).free_names();
    if names.iter().any(|name| free.contains(*name)) {
        return Ok(true);
    }
    for draw in scope.draws_among(&free)? {
        let law = Part::Law(&draw.law).free_names();
        if names.iter().any(|name| law.contains(*name)) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Refuses what may not be continuous in the names at their places, where the formula has a value.
pub(super) fn continuous(formula: &Formula, names: &[&Name], scope: &Scope) -> Result<(), Failure> {
    scope.spend(1)?;
    if !depends(formula, names, scope)? {
        return Ok(());
    }
    match formula {
        Formula::Name(_) => Ok(()),
        Formula::Negate(inner) => continuous(inner, names, scope),
        Formula::Binary(operator, left, right) => {
            continuous(left, names, scope)?;
            continuous(right, names, scope)?;
            match operator {
                Operator::Power => continuous_power(left, right, names, scope),
                // A quotient that has a value has a divisor that is not 0.
                _ => Ok(()),
            }
        }
        Formula::Factorial(inner) => {
            continuous(inner, names, scope)?;
            require_positive(inner, scope, 1)
        }
        Formula::Call(function, arguments) => continuous_call(*function, arguments, names, scope),
        Formula::Mean(body, draw) | Formula::Variance(body, draw) => {
            continuous_mean(body, draw.as_deref(), names, scope)
        }
        Formula::Ranged(ranged) if ranged.kind == RangeKind::Integral => {
            continuous_integral(ranged, names, scope)
        }
        _ => Err(unsupported("the limit of a formula of this kind")),
    }
}

fn continuous_integral(ranged: &Ranged, names: &[&Name], scope: &Scope) -> Result<(), Failure> {
    let mut ends = vec![];
    for end in [&ranged.from, &ranged.to] {
        continuous(end, names, scope)?;
        match value(end, scope)? {
            Value(Quantity::Closed(end)) => ends.push(Bound::Finite(end)),
            _ => return Err(unsupported("the limit of an integral with these bounds")),
        }
    }
    if ends[0].compare(&ends[1])?.is_gt() {
        ends.reverse();
    }
    continuous_integrand(&ranged.body, &ranged.name, &ends[0], &ends[1], scope)
}

fn continuous_power(
    base: &Formula,
    exponent: &Formula,
    names: &[&Name],
    scope: &Scope,
) -> Result<(), Failure> {
    let fixed = !depends(exponent, names, scope)?;
    let whole = match value(exponent, scope)? {
        Value(Quantity::Closed(e)) => e.as_rational().is_some_and(|e| *e.denom() == 1),
        _ => false,
    };
    // An integer power that has a value is no pole.
    if fixed && whole {
        Ok(())
    } else {
        require_positive(base, scope, 0)
    }
}

fn require_positive(formula: &Formula, scope: &Scope, shift: i64) -> Result<(), Failure> {
    let Value(quantity) = value(formula, scope)? else {
        return Err(unsupported("the limit of a formula of this kind"));
    };
    let shift = Quantity::rational(Rational::from(shift));
    match quantity.add(shift, scope.budget())?.sign()? {
        Ordering::Greater => Ok(()),
        _ => Err(undecided("a limit at the border of a domain")),
    }
}

fn continuous_call(
    function: Function,
    arguments: &[Formula],
    names: &[&Name],
    scope: &Scope,
) -> Result<(), Failure> {
    for argument in arguments {
        continuous(argument, names, scope)?;
    }
    match (function, arguments) {
        (Function::Abs | Function::Exp | Function::Sin | Function::Cos, _)
        | (Function::Min | Function::Max, _) => Ok(()),
        (
            Function::Sqrt | Function::Ln | Function::Gamma | Function::LnGamma | Function::Beta,
            all,
        ) => all
            .iter()
            .try_for_each(|argument| require_positive(argument, scope, 0)),
        (Function::Hyp2F1 | Function::Hyp2F1Regularized, [_, _, c, z]) => {
            require_positive(c, scope, 0)?;
            let one_minus = Formula::binary(Operator::Subtract, Formula::integer(1), z.clone());
            require_positive(&one_minus, scope, 0)
        }
        _ => Err(unsupported(format!("the limit of {}", function.name()))),
    }
}

/// Under a beta or uniform law the mean of a function that is continuous on the closed support, jointly
/// with the names, is continuous in the law's parameters and the names.
fn continuous_mean(
    body: &Formula,
    own: Option<&Draw>,
    names: &[&Name],
    scope: &Scope,
) -> Result<(), Failure> {
    let free = Part::Formula(body).free_names();
    let draws = match own {
        Some(draw) => vec![draw],
        None => scope.draws_among(&free)?,
    };
    let [draw] = draws[..] else {
        return Err(unsupported("the limit of a mean over several draws"));
    };
    continuous_law(draw, names, scope)?;
    let Value(weight) = law::weight(&draw.law, scope)? else {
        return Err(unsupported("the limit of a mean under no law"));
    };
    continuous_integrand(body, &draw.name, &weight.from(), &weight.to(), scope)
}

fn continuous_law(draw: &Draw, names: &[&Name], scope: &Scope) -> Result<(), Failure> {
    match &draw.law {
        Law::Beta(a, b) | Law::Uniform(a, b) => {
            continuous(a, names, scope)?;
            continuous(b, names, scope)
        }
        _ => Err(unsupported("the limit of a mean under this law")),
    }
}

/// How many parts of the range are enclosed, one by one.
const PARTS: u32 = 32;

/// The integrand must be built of operations that are continuous wherever they have a value, and it is
/// enclosed over the whole closed range, where a pole would show: by compactness it is then
/// continuous near it, for names near their places.
fn continuous_integrand(
    body: &Formula,
    name: &Name,
    from: &Bound,
    to: &Bound,
    scope: &Scope,
) -> Result<(), Failure> {
    if !is_elementary(body) {
        return Err(unsupported("the limit of an integral of this kind"));
    }
    let (Some((Some(low), _)), Some((_, Some(high)))) = (from.neighbours(), to.neighbours()) else {
        return Err(unsupported(
            "the limit of an integral over an unbounded range",
        ));
    };
    let width = Rational::from(&high - &low);
    let mark = |part: u32| Rational::from(&width * Rational::from((part, PARTS))) + &low;
    for part in 0..PARTS {
        let start = Interval::from_rational(&mark(part), 64);
        let piece = start.hull(&Interval::from_rational(&mark(part + 1), 64));
        let link = scope.bind(name, Binding::Enclosed(piece));
        match enclose::within(body, &link.scope(), 64)? {
            Value(range) if range.is_bounded() => {}
            _ => return Err(undecided("a limit of an integral near a pole")),
        }
    }
    Ok(())
}

/// Whether the formula is made of operations that are continuous where they have a value, those of
/// which an interval that holds no pole is free of poles.
fn is_elementary(formula: &Formula) -> bool {
    match formula {
        Formula::Number(_) | Formula::Pi | Formula::Name(_) => true,
        Formula::Negate(inner) => is_elementary(inner),
        Formula::Binary(Operator::Power, base, exponent) => {
            is_elementary(base) && matches!(&**exponent, Formula::Number(n) if n.is_integer())
        }
        Formula::Binary(_, left, right) => is_elementary(left) && is_elementary(right),
        Formula::Call(Function::Abs | Function::Exp | Function::Sin | Function::Cos, arguments) => {
            arguments.iter().all(is_elementary)
        }
        _ => false,
    }
}

/// Whether it is the mean, of something that does not change with the names, under a law that does
/// continuously. That its value is `+inf` says that what is under the mean is nowhere negative.
fn is_nonnegative_mean(formula: &Formula, names: &[&Name], scope: &Scope) -> Result<bool, Failure> {
    let Formula::Mean(body, own) = formula else {
        return Ok(false);
    };
    let free = Part::Formula(body).free_names();
    let draws = match own {
        Some(draw) => vec![&**draw],
        None => scope.draws_among(&free)?,
    };
    let [draw] = draws[..] else {
        return Ok(false);
    };
    continuous_law(draw, names, scope)?;
    Ok(is_elementary(body) && !names.iter().any(|name| free.contains(*name)))
}
