//! The exact value of a formula: an [`Exact`] in logarithms, roots and powers of sqrt(pi).
//!
//! Under an integral or a mean the variable of integration is a symbol, and the same walk over the tree
//! gives a rational function of it (`quantity`), which is then integrated term by term. What has no
//! closed form here is [`Failure::Unsupported`].

use super::closed::order;
use super::mean::{at_draw, mean_of, over_draws, variance_of};
use super::outcome;
use super::quantity::Quantity;
use super::scope::{Binding, Root, Scope};
use super::{
    Context, Failure, Outcome, condition, functions, limit, range, undecided, unsupported,
};
use crate::formula::{Formula, Function, Name, Operator, Part};
use crate::number::{Exact, convert};
use rug::{Integer, Rational};
use std::cmp::Ordering;

use Outcome::{MinusInfinity, PlusInfinity, Undefined, Value};

/// What evaluation gives.
pub(super) type Evaluation = Result<Outcome<Quantity>, Failure>;

/// The exact value of a formula at a point.
///
/// # Errors
/// A [`Failure`] where there is no closed form, or finding it would cost too much.
pub fn exact(formula: &Formula, context: &Context) -> Result<Outcome<Exact>, Failure> {
    let root = Root::new(context);
    closed(formula, &Scope::new(&root))
}

/// The exact value of a formula that does not depend on a variable of integration.
pub(super) fn closed(formula: &Formula, scope: &Scope) -> Result<Outcome<Exact>, Failure> {
    value(formula, scope)?.finite_or_infinite(|quantity| Ok(Value(quantity.closed("a value")?)))
}

impl<T> Outcome<T> {
    /// `f` of a value; anything else stays.
    fn finite_or_infinite<U>(
        self,
        f: impl FnOnce(T) -> Result<Outcome<U>, Failure>,
    ) -> Result<Outcome<U>, Failure> {
        match self {
            Value(value) => f(value),
            PlusInfinity => Ok(PlusInfinity),
            MinusInfinity => Ok(MinusInfinity),
            Undefined => Ok(Undefined),
        }
    }
}

/// The value where variables of integration are at their samples.
pub(super) fn sampled(formula: &Formula, scope: &Scope) -> Evaluation {
    value(formula, scope)?.finite_or_infinite(|quantity| {
        Ok(match at_samples(&quantity, scope)? {
            Some(value) => Value(Quantity::Closed(value)),
            None => Undefined,
        })
    })
}

/// A quantity with variables of integration at their samples; `None` at a pole.
pub(super) fn at_samples(quantity: &Quantity, scope: &Scope) -> Result<Option<Exact>, Failure> {
    match quantity {
        Quantity::Closed(value) => Ok(Some(value.clone())),
        Quantity::Open(function) => function.at(|symbol| scope.sample(symbol), scope.budget()),
    }
}

pub(super) fn number(value: Rational) -> Evaluation {
    Ok(Value(Quantity::rational(value)))
}

/// The value of a formula in a scope.
pub(super) fn value(formula: &Formula, scope: &Scope) -> Evaluation {
    scope.spend(1)?;
    match formula {
        Formula::Number(value) => number(convert::to_rug(value)),
        Formula::Pi => Ok(Value(Quantity::Closed(Exact::pi()))),
        Formula::Infinity => Ok(PlusInfinity),
        Formula::Name(name) => scope.lookup(name).map(Value),
        Formula::Apply(name, arguments) => apply(name, arguments, scope),
        Formula::Negate(inner) => negate(value(inner, scope)?, scope),
        Formula::Binary(operator, left, right) => binary(*operator, left, right, scope),
        Formula::Factorial(inner) => {
            let budget = scope.budget();
            rational_call("a factorial", inner, scope, |x| {
                functions::factorial_or_gamma(x, budget)
            })
        }
        Formula::Call(function, arguments) => call(*function, arguments, scope),
        Formula::Ranged(ranged) => range::ranged(ranged, scope),
        Formula::Antiderivative(..) => Err(unsupported("an antiderivative at a point")),
        Formula::Derivative(body, name, times) => derivative(body, name, times, scope),
        Formula::At(body, places) => at(body, places, scope),
        Formula::Limit(body, places) => limit::exact(body, places, scope),
        Formula::Indicator(truth) => {
            number(Rational::from(u32::from(condition::within(truth, scope)?)))
        }
        Formula::If(truth, yes, no) => value(
            if condition::within(truth, scope)? {
                yes
            } else {
                no
            },
            scope,
        ),
        Formula::Mean(body, draw) => over_draws(Part::Formula(body), draw, scope, mean_of),
        Formula::Variance(body, draw) => over_draws(Part::Formula(body), draw, scope, variance_of),
        Formula::Probability(truth, draw) => {
            over_draws(Part::Condition(truth), draw, scope, mean_of)
        }
        Formula::Density(quantity, x) => at_draw(quantity, x, false, scope),
        Formula::Cumulative(quantity, x) => at_draw(quantity, x, true, scope),
        Formula::BigO(_) | Formula::LittleO(_) => Err(unsupported("an order symbol")),
        Formula::Truth(_) => Err(unsupported("a condition as a number")),
    }
}

pub(super) fn negate(outcome: Outcome<Quantity>, scope: &Scope) -> Evaluation {
    Ok(match outcome {
        Value(quantity) => Value(quantity.negate(scope.budget())?),
        other => other.negate(|quantity| quantity),
    })
}

fn apply(name: &Name, arguments: &[Formula], scope: &Scope) -> Evaluation {
    let [argument] = arguments else {
        return Err(unsupported(format!("{name} with this number of arguments")));
    };
    let (variable, body) = scope.function(name)?;
    value(argument, scope)?.finite("a function", |place| {
        let outermost = scope.outermost();
        let link = outermost.bind(variable, Binding::Quantity(place));
        value(body, &link.scope())
    })
}

fn binary(operator: Operator, left: &Formula, right: &Formula, scope: &Scope) -> Evaluation {
    let budget = scope.budget();
    let (left, right) = (value(left, scope)?, value(right, scope)?);
    match operator {
        Operator::Add => outcome::add(left, right, |a, b| Ok(Value(a.add(b, budget)?))),
        Operator::Subtract => {
            let right = negate(right, scope)?;
            outcome::add(left, right, |a, b| Ok(Value(a.add(b, budget)?)))
        }
        Operator::Multiply => multiply(left, right, scope),
        Operator::Divide => {
            outcome::divide(left, right, Quantity::sign, |a, b| divide(a, b, scope))
        }
        Operator::Power => power(left, right, scope),
    }
}

fn multiply(left: Outcome<Quantity>, right: Outcome<Quantity>, scope: &Scope) -> Evaluation {
    let budget = scope.budget();
    outcome::multiply(left, right, Quantity::sign, |a, b| {
        Ok(Value(a.multiply(b, budget)?))
    })
}

fn divide(a: Quantity, b: Quantity, scope: &Scope) -> Evaluation {
    let budget = scope.budget();
    if let (Quantity::Closed(a), Quantity::Closed(b)) = (&a, &b) {
        return match b.is_zero() {
            Some(true) => Ok(Undefined),
            None => Err(undecided("whether a divisor is 0")),
            Some(false) => {
                let quotient = a.div(b);
                quotient
                    .map(|q| Value(Quantity::Closed(q)))
                    .ok_or_else(|| unsupported("a quotient in closed form"))
            }
        };
    }
    match b.power(-1, budget)? {
        Value(inverse) => Ok(Value(a.multiply(inverse, budget)?)),
        other => Ok(other),
    }
}

fn power(base: Outcome<Quantity>, exponent: Outcome<Quantity>, scope: &Scope) -> Evaluation {
    let (base, exponent) = match (base, exponent) {
        (Undefined, _) | (_, Undefined) => return Ok(Undefined),
        (base, Value(exponent)) => (base, exponent.closed("a power")?),
        _ => return Err(unsupported("an infinite exponent")),
    };
    let Some(exponent) = exponent.as_rational() else {
        return Err(unsupported("an irrational exponent in closed form"));
    };
    if *exponent.denom() == 1 {
        return integer_power(base, exponent.numer(), scope);
    }
    base.finite("a root", |base| {
        let base = base.closed("a root")?;
        let power = functions::rational_exponent(&base, &exponent, scope.budget())?;
        Ok(power.map(Quantity::Closed))
    })
}

fn integer_power(base: Outcome<Quantity>, exponent: &Integer, scope: &Scope) -> Evaluation {
    match base {
        Value(base) => {
            let Some(small) = exponent.to_i64() else {
                return huge_power(&base, exponent);
            };
            base.power(small, scope.budget())
        }
        Undefined => Ok(Undefined),
        _ if *exponent <= 0 => Err(unsupported("inf to this power")),
        MinusInfinity if exponent.is_odd() => Ok(MinusInfinity),
        _ => Ok(PlusInfinity),
    }
}

/// Powers of 0, 1 and -1 have values whatever the exponent.
fn huge_power(base: &Quantity, exponent: &Integer) -> Evaluation {
    let too_large = || Failure::TooLarge("a power".into());
    let Quantity::Closed(base) = base else {
        return Err(too_large());
    };
    let base = base
        .as_rational()
        .filter(|b| *b.denom() == 1)
        .ok_or_else(too_large)?;
    match base.numer().to_i32() {
        Some(0) if *exponent < 0 => Ok(Undefined),
        Some(-1) if exponent.is_even() => number(Rational::from(1)),
        Some(-1..=1) => number(base),
        _ => Err(too_large()),
    }
}

/// A function that has closed values at rational places.
fn rational_call(
    what: &str,
    argument: &Formula,
    scope: &Scope,
    f: impl FnOnce(&Rational) -> Result<Outcome<Exact>, Failure>,
) -> Evaluation {
    value(argument, scope)?.finite(what, |x| {
        let x = x.closed(what)?.as_rational();
        let x = x.ok_or_else(|| unsupported(format!("{what} at an irrational place")))?;
        Ok(f(&x)?.map(Quantity::Closed))
    })
}

/// A function that has closed values at some irrational places too.
fn closed_call(
    what: &str,
    argument: &Formula,
    scope: &Scope,
    f: impl FnOnce(&Exact) -> Result<Outcome<Exact>, Failure>,
) -> Evaluation {
    value(argument, scope)?.finite(what, |x| Ok(f(&x.closed(what)?)?.map(Quantity::Closed)))
}

fn call(function: Function, arguments: &[Formula], scope: &Scope) -> Evaluation {
    let budget = scope.budget();
    let what = function.name();
    let half = Rational::from((1, 2));
    match (function, arguments) {
        (Function::Abs, [x]) => absolute(x, scope),
        (Function::Sqrt, [x]) => closed_call(what, x, scope, |x| {
            functions::rational_exponent(x, &half, budget)
        }),
        (Function::Exp, [x]) => closed_call(what, x, scope, functions::exp),
        (Function::Ln, [x]) => closed_call(what, x, scope, |x| functions::ln_or_none(x, budget)),
        (Function::Sin, [x]) => closed_call(what, x, scope, |x| functions::sine(x, 0)),
        (Function::Cos, [x]) => closed_call(what, x, scope, |x| functions::sine(x, 1)),
        (Function::Floor, [x]) => closed_call(what, x, scope, functions::floor),
        (Function::Gamma, [x]) => rational_call(what, x, scope, |x| functions::gamma(x, budget)),
        (Function::LnGamma, [x]) => {
            rational_call(what, x, scope, |x| functions::lngamma(x, budget))
        }
        (Function::Min, many) => extreme(many, Ordering::Less, scope),
        (Function::Max, many) => extreme(many, Ordering::Greater, scope),
        (_, many) => rational_function(function, many, scope),
    }
}

/// The functions of several rational arguments.
fn rational_function(function: Function, arguments: &[Formula], scope: &Scope) -> Evaluation {
    let budget = scope.budget();
    let mut places = vec![];
    for argument in arguments {
        match value(argument, scope)? {
            Value(x) => {
                let x = x.closed(function.name())?.as_rational();
                places.push(x.ok_or_else(|| {
                    unsupported(format!("{} at an irrational place", function.name()))
                })?);
            }
            Undefined => return Ok(Undefined),
            _ => return Err(unsupported(format!("{} at infinity", function.name()))),
        }
    }
    let value = match (function, &places[..]) {
        (Function::Beta, [a, b]) => functions::beta(a, b, budget)?,
        (Function::Binomial, [n, k]) => functions::binomial(n, k, budget)?,
        (Function::Pochhammer, [a, n]) if *n.denom() == 1 => {
            functions::pochhammer(a, n.numer(), budget)?
        }
        (Function::Hyp2F1, [a, b, c, z]) => {
            functions::hyp2f1(&[a.clone(), b.clone(), c.clone(), z.clone()], budget)?
        }
        (Function::Hyp2F1Regularized, [a, b, c, z]) => {
            if *c.denom() == 1 && c.cmp0() != Ordering::Greater {
                return Err(unsupported("hyp2f1r at this c in closed form"));
            }
            let plain = functions::hyp2f1(&[a.clone(), b.clone(), c.clone(), z.clone()], budget)?;
            let (Value(plain), Value(gamma)) = (plain, functions::gamma(c, budget)?) else {
                return Ok(Undefined);
            };
            let quotient = plain.div(&gamma);
            Value(quotient.ok_or_else(|| unsupported("hyp2f1r in closed form"))?)
        }
        _ => return Err(unsupported(format!("{} at this place", function.name()))),
    };
    Ok(value.map(Quantity::Closed))
}

fn absolute(x: &Formula, scope: &Scope) -> Evaluation {
    match value(x, scope)? {
        Value(x) => match at_samples(&x, scope)? {
            Some(place) if super::closed::sign(&place)? == Ordering::Less => {
                Ok(Value(x.negate(scope.budget())?))
            }
            Some(_) => Ok(Value(x)),
            None => Ok(Undefined),
        },
        Undefined => Ok(Undefined),
        _ => Ok(PlusInfinity),
    }
}

/// `min` or `max`; in an integrand the one that is so at the sample.
fn extreme(arguments: &[Formula], wanted: Ordering, scope: &Scope) -> Evaluation {
    let mut best: Option<Outcome<Quantity>> = None;
    for argument in arguments {
        let next = value(argument, scope)?;
        best = Some(match best {
            None => next,
            Some(best) => more_extreme(best, next, wanted, scope)?,
        });
    }
    best.ok_or_else(|| unsupported("min or max of nothing"))
}

pub(super) fn more_extreme(
    best: Outcome<Quantity>,
    next: Outcome<Quantity>,
    wanted: Ordering,
    scope: &Scope,
) -> Evaluation {
    Ok(match (best, next) {
        (Undefined, _) | (_, Undefined) => Undefined,
        (Value(a), Value(b)) => {
            let (Some(x), Some(y)) = (at_samples(&a, scope)?, at_samples(&b, scope)?) else {
                return Ok(Undefined);
            };
            Value(if order(&x, &y)? == wanted { a } else { b })
        }
        (PlusInfinity, other) | (other, PlusInfinity) if wanted == Ordering::Less => other,
        (MinusInfinity, other) | (other, MinusInfinity) if wanted == Ordering::Greater => other,
        (infinite @ (PlusInfinity | MinusInfinity), _) => infinite,
        (_, infinite) => infinite,
    })
}

/// How often to differentiate.
pub(super) fn derivative_order(times: &Formula, scope: &Scope) -> Result<u32, Failure> {
    let times = match value(times, scope)? {
        Value(times) => times.closed("an order of a derivative")?.as_rational(),
        _ => None,
    };
    let times = times
        .filter(|n| *n.denom() == 1)
        .and_then(|n| n.numer().to_u32());
    times.ok_or_else(|| unsupported("a derivative of this order"))
}

fn derivative(body: &Formula, name: &Name, times: &Formula, scope: &Scope) -> Evaluation {
    let times = derivative_order(times, scope)?;
    let result = super::differentiate::repeatedly(body, name, times, scope)?;
    let plain = value(body, scope)?;
    if times == 0 || !matches!(plain, Value(_)) {
        return plain.finite("a derivative", |plain| Ok(Value(plain)));
    }
    match value(&result, scope)? {
        Value(value) => Ok(Value(value)),
        // The rules need every part to have a derivative; the whole may have one without.
        _ => Err(undecided("a derivative at a singular place")),
    }
}

fn at(body: &Formula, places: &[(Name, Formula)], scope: &Scope) -> Evaluation {
    let mut values = vec![];
    for (name, place) in places {
        match value(place, scope)? {
            Value(place) => values.push((name, place)),
            Undefined => return Ok(Undefined),
            _ => return Err(unsupported("a value at infinity")),
        }
    }
    bound(body, &values, scope, &mut |body, scope| value(body, scope))
}

/// Runs `f` on the body with the names bound.
pub(super) fn bound<T>(
    body: &Formula,
    values: &[(&Name, Quantity)],
    scope: &Scope,
    f: &mut dyn FnMut(&Formula, &Scope) -> Result<T, Failure>,
) -> Result<T, Failure> {
    match values.split_first() {
        None => f(body, scope),
        Some(((name, quantity), rest)) => {
            let link = scope.bind(name, Binding::Quantity(quantity.clone()));
            bound(body, rest, &link.scope(), f)
        }
    }
}
