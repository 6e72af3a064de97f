//! Enclosures of a formula's value by intervals rounded outwards.
//!
//! The tree is walked once per precision. Integrals and means are taken from their exact value where there is
//! one; else a mean under a beta law of a rational function with one pole is Euler's integral
//!
//! ```text
//! E[(1 - x/r)^-e] = F(e, a; a+b; 1/r),    r outside of [0, 1]                  (DLMF 15.6.1)
//! ```
//!
//! and the rest goes to quadrature. An operation that certainly has no value gives
//! [`Outcome::Undefined`]; one that may have none at this precision is [`Failure::Undecided`].

use super::exact;
use super::quantity::Quantity;
use super::scope::{Binding, Root, Scope};
use super::{
    Context, Failure, Outcome, condition, differentiate, euler, line, outcome, range, undecided,
    unsupported,
};
use crate::formula::{Formula, Function, Name, Operator, RangeKind, Ranged};
use crate::number::{DomainError, Interval, convert};
use crate::special;
use rug::Rational;
use std::cmp::Ordering;

use Outcome::{MinusInfinity, PlusInfinity, Undefined, Value};

/// What enclosing gives.
pub(super) type Enclosure = Result<Outcome<Interval>, Failure>;

/// Bits with which [`ladder`] starts and ends.
const FIRST_PRECISION: u32 = 64;
const LAST_PRECISION: u32 = 1 << 14;

/// An interval that holds the formula's value, computed with `precision` bits.
///
/// # Errors
/// A [`Failure`] where no enclosure is found; with [`Failure::Undecided`] a higher precision may help.
pub fn enclose(formula: &Formula, context: &Context, precision: u32) -> Enclosure {
    let root = Root::new(context);
    within(formula, &Scope::new(&root), precision)
}

/// An enclosure of relative width below 10^-digits, by doubling the precision.
///
/// # Errors
/// [`Failure::Undecided`] when the cap of precision is reached, as for a value that is 0 and not seen to
/// be; other failures as they come.
pub fn ladder(formula: &Formula, context: &Context, digits: u32) -> Enclosure {
    let root = Root::new(context);
    let scope = Scope::new(&root);
    let mut precision = FIRST_PRECISION.max(digits.saturating_mul(4));
    let mut last = undecided("a value to that many digits");
    while precision <= LAST_PRECISION.max(digits.saturating_mul(16)) {
        match within(formula, &scope, precision) {
            Ok(Value(interval)) if !interval.agrees_to(digits) => {}
            Err(Failure::Undecided(why)) => last = Failure::Undecided(why),
            other => return other,
        }
        precision = precision.saturating_mul(2);
    }
    Err(last)
}

/// The outcome of an operation on intervals.
fn defined(result: Result<Interval, DomainError>, what: &str) -> Enclosure {
    match result {
        Ok(interval) => Ok(Value(interval)),
        Err(DomainError::Certain) => Ok(Undefined),
        Err(DomainError::Possible) => Err(undecided(format!("whether {what} has a value here"))),
    }
}

fn sign(interval: &Interval) -> Result<Ordering, Failure> {
    interval
        .sign()
        .ok_or_else(|| undecided("the sign of an interval"))
}

/// An enclosure of the value of a formula in a scope.
pub(super) fn within(formula: &Formula, scope: &Scope, precision: u32) -> Enclosure {
    scope.spend(1 + u64::from(precision) / 256)?;
    match formula {
        Formula::Number(value) => Ok(Value(Interval::from_rational(
            &convert::to_rug(value),
            precision,
        ))),
        Formula::Pi => Ok(Value(Interval::pi(precision))),
        Formula::Infinity => Ok(PlusInfinity),
        Formula::Name(name) => self::name(name, scope, precision),
        Formula::Negate(inner) => Ok(within(inner, scope, precision)?.negate(|x| x.neg())),
        Formula::Binary(operator, left, right) => {
            binary(formula, *operator, left, right, scope, precision)
        }
        Formula::Factorial(inner) => within(inner, scope, precision)?.finite("a factorial", |x| {
            defined(
                x.add(&Interval::from_i64(1, precision)).gamma(),
                "a factorial",
            )
        }),
        Formula::Call(function, arguments) => call(*function, arguments, scope, precision),
        Formula::Ranged(ranged) if ranged.kind != RangeKind::Integral => {
            over_range(ranged, scope, precision)
        }
        Formula::Indicator(truth) => {
            let truth = condition::within(truth, scope)?;
            Ok(Value(Interval::from_i64(i64::from(truth), precision)))
        }
        Formula::If(truth, yes, no) => {
            let branch = if condition::within(truth, scope)? {
                yes
            } else {
                no
            };
            within(branch, scope, precision)
        }
        Formula::Apply(name, arguments) => apply(name, arguments, scope, precision),
        _ => exactly_or_by_series(formula, scope, precision),
    }
}

fn name(name: &Name, scope: &Scope, precision: u32) -> Enclosure {
    match scope.binding(name) {
        Some(Binding::Enclosed(interval)) => Ok(Value(interval.clone())),
        Some(Binding::Symbol { .. }) => match scope.lookup(name)? {
            quantity @ Quantity::Open(_) => match exact::at_samples(&quantity, scope)? {
                Some(value) => Ok(Value(value.enclose(precision))),
                None => Ok(Undefined),
            },
            Quantity::Closed(value) => Ok(Value(value.enclose(precision))),
        },
        _ => match scope.lookup(name)? {
            Quantity::Closed(value) => Ok(Value(value.enclose(precision))),
            Quantity::Open(_) => Err(unsupported(format!("{name}, a function, by an interval"))),
        },
    }
}

fn apply(name: &Name, arguments: &[Formula], scope: &Scope, precision: u32) -> Enclosure {
    let [argument] = arguments else {
        return Err(unsupported(format!("{name} with this number of arguments")));
    };
    let (variable, body) = scope.function(name)?;
    within(argument, scope, precision)?.finite("a function", |place| {
        let outermost = scope.outermost();
        let link = outermost.bind(variable, Binding::Enclosed(place));
        within(body, &link.scope(), precision)
    })
}

fn binary(
    whole: &Formula,
    operator: Operator,
    left: &Formula,
    right: &Formula,
    scope: &Scope,
    precision: u32,
) -> Enclosure {
    if operator == Operator::Power {
        return power(left, right, scope, precision);
    }
    let quotient_like = matches!(operator, Operator::Multiply | Operator::Divide);
    if quotient_like && let Some(value) = gamma_product(whole, scope, precision)? {
        return Ok(Value(value));
    }
    let (a, b) = (
        within(left, scope, precision)?,
        within(right, scope, precision)?,
    );
    match operator {
        Operator::Add => outcome::add(a, b, |a, b| Ok(Value(a.add(&b)))),
        Operator::Subtract => outcome::add(a, b.negate(|b| b.neg()), |a, b| Ok(Value(a.add(&b)))),
        Operator::Multiply => outcome::multiply(a, b, sign, |a, b| Ok(Value(a.mul(&b)))),
        _ => outcome::divide(a, b, sign, |a, b| defined(a.div(&b), "a quotient")),
    }
}

fn power(base: &Formula, exponent: &Formula, scope: &Scope, precision: u32) -> Enclosure {
    let base = within(base, scope, precision)?;
    // Whether an exponent is an integer is a question for exact values.
    let exactly = match exact::closed(exponent, scope) {
        Ok(Value(exponent)) => exponent.as_rational(),
        Ok(Undefined) => return Ok(Undefined),
        Err(Failure::Exhausted) => return Err(Failure::Exhausted),
        _ => None,
    };
    match (base, exactly) {
        (Undefined, _) => Ok(Undefined),
        (Value(base), Some(exponent)) if *exponent.denom() == 1 => {
            defined(base.pow_integer(exponent.numer()), "a power")
        }
        (Value(base), Some(exponent)) => defined(base.pow_rational(&exponent), "a power"),
        (Value(base), None) => within(exponent, scope, precision)?.finite("a power", |exponent| {
            defined(base.pow(&exponent), "a power")
        }),
        (infinite, Some(exponent))
            if exponent.cmp0() == Ordering::Greater && *exponent.denom() == 1 =>
        {
            Ok(match infinite {
                MinusInfinity if exponent.numer().is_odd() => MinusInfinity,
                _ => PlusInfinity,
            })
        }
        _ => Err(unsupported("inf to this power")),
    }
}

/// The factors of a product or quotient: those that are gamma(x) or (x-1)!, and the others.
#[derive(Default)]
struct Product<'f> {
    gammas: [Vec<Interval>; 2],
    others: [Vec<&'f Formula>; 2],
}

/// A product in which several values of gamma meet: alone they may be too large for any exponent.
/// `None` where there are fewer than two, or an argument is not seen to be positive.
fn gamma_product(
    formula: &Formula,
    scope: &Scope,
    precision: u32,
) -> Result<Option<Interval>, Failure> {
    let mut product = Product::default();
    if count_gammas(formula) < 2 || !collect(formula, false, &mut product, scope, precision)? {
        return Ok(None);
    }
    let [above, below] = &product.gammas;
    let Ok(mut value) = special::gamma_quotient(above, below, precision) else {
        return Ok(None);
    };
    for (side, factors) in product.others.iter().enumerate() {
        for factor in factors {
            let Value(factor) = within(factor, scope, precision)? else {
                return Ok(None);
            };
            value = match side {
                0 => value.mul(&factor),
                _ => match value.div(&factor) {
                    Ok(quotient) => quotient,
                    Err(_) => return Ok(None),
                },
            };
        }
    }
    Ok(Some(value))
}

fn count_gammas(formula: &Formula) -> usize {
    match formula {
        Formula::Binary(Operator::Multiply | Operator::Divide, left, right) => {
            count_gammas(left) + count_gammas(right)
        }
        Formula::Factorial(_) | Formula::Call(Function::Gamma, _) => 1,
        _ => 0,
    }
}

fn collect<'f>(
    formula: &'f Formula,
    below: bool,
    product: &mut Product<'f>,
    scope: &Scope,
    precision: u32,
) -> Result<bool, Failure> {
    let side = usize::from(below);
    let (argument, shift) = match formula {
        Formula::Binary(Operator::Multiply, left, right) => {
            return Ok(collect(left, below, product, scope, precision)?
                && collect(right, below, product, scope, precision)?);
        }
        Formula::Binary(Operator::Divide, left, right) => {
            return Ok(collect(left, below, product, scope, precision)?
                && collect(right, !below, product, scope, precision)?);
        }
        Formula::Factorial(inner) => (&**inner, 1),
        Formula::Call(Function::Gamma, arguments) if arguments.len() == 1 => (&arguments[0], 0),
        other => {
            product.others[side].push(other);
            return Ok(true);
        }
    };
    let Value(x) = wide_integer(argument, scope, precision)? else {
        return Ok(false);
    };
    let x = x.add(&Interval::from_i64(shift, x.precision()));
    let positive = *x.low() > 0;
    product.gammas[side].push(x);
    Ok(positive)
}

/// An enclosure with enough bits to hold a large exact integer.
fn wide_integer(formula: &Formula, scope: &Scope, precision: u32) -> Enclosure {
    match exact::closed(formula, scope) {
        Ok(Value(value)) => {
            let bits = match value.as_rational() {
                Some(value) => value.numer().significant_bits().min(1 << 12),
                None => 0,
            };
            Ok(Value(value.enclose(precision.max(bits.saturating_add(8)))))
        }
        Err(Failure::Exhausted) => Err(Failure::Exhausted),
        _ => within(formula, scope, precision),
    }
}

fn call(function: Function, arguments: &[Formula], scope: &Scope, precision: u32) -> Enclosure {
    let what = function.name();
    match (function, arguments) {
        (Function::Min | Function::Max, many) => extreme(function, many, scope, precision),
        (Function::Abs, [x]) => match within(x, scope, precision)? {
            PlusInfinity | MinusInfinity => Ok(PlusInfinity),
            other => Ok(other.map(|x| x.abs())),
        },
        (_, [x]) => {
            within(x, scope, precision)?.finite(what, |x| defined(unary(function, &x)?, what))
        }
        (_, many) => several(function, many, scope, precision),
    }
}

fn unary(function: Function, x: &Interval) -> Result<Result<Interval, DomainError>, Failure> {
    Ok(match function {
        Function::Sqrt => x.sqrt(),
        Function::Exp => Ok(x.exp()),
        Function::Ln => x.ln(),
        Function::Sin => Ok(x.sin()),
        Function::Cos => Ok(x.cos()),
        Function::Gamma => x.gamma(),
        Function::LnGamma => x.lngamma(),
        Function::Floor => x.floor(),
        _ => return Err(unsupported(format!("{} of one argument", function.name()))),
    })
}

fn extreme(function: Function, arguments: &[Formula], scope: &Scope, precision: u32) -> Enclosure {
    let mut best: Option<Interval> = None;
    for argument in arguments {
        let Value(next) = within(argument, scope, precision)? else {
            return Err(unsupported(
                "min or max of something without a finite value",
            ));
        };
        best = Some(match best {
            None => next,
            Some(best) if function == Function::Min => best.min(&next),
            Some(best) => best.max(&next),
        });
    }
    best.map(Value)
        .ok_or_else(|| unsupported("min or max of nothing"))
}

/// The functions of several arguments, by their enclosures; where those do not tell, exactly.
fn several(function: Function, arguments: &[Formula], scope: &Scope, precision: u32) -> Enclosure {
    let mut places = vec![];
    for argument in arguments {
        match wide_integer(argument, scope, precision)? {
            Value(x) => places.push(x),
            Undefined => return Ok(Undefined),
            _ => return Err(unsupported(format!("{} at infinity", function.name()))),
        }
    }
    let result = match (function, &places[..]) {
        (Function::Hyp2F1, [a, b, c, z]) => match rationals(arguments, scope).as_deref() {
            Some([a, b, c, z]) => special::hyp2f1_rational(a, b, c, z, precision),
            _ => special::hyp2f1(a, b, c, z, precision),
        },
        (Function::Hyp2F1Regularized, [a, b, c, z]) => {
            special::hyp2f1_regularized(a, b, c, z, precision)
        }
        (Function::Beta, [a, b]) if *a.low() > 0 && *b.low() > 0 => special::beta(a, b, precision),
        (Function::Binomial, [n, k]) if k.as_integer().is_some() => {
            special::binomial(n, &k.as_integer().unwrap_or_default(), precision)
        }
        (Function::Pochhammer, [a, n]) if n.as_integer().is_some_and(|n| n >= 0) => {
            special::pochhammer(a, &n.as_integer().unwrap_or_default(), precision)
        }
        _ => Err(DomainError::Possible),
    };
    match result {
        Err(DomainError::Possible) => {
            let formula = Formula::Call(function, arguments.to_vec());
            Ok(exact::closed(&formula, scope)?.map(|value| value.enclose(precision)))
        }
        decided => defined(decided, function.name()),
    }
}

/// The arguments, where all are rational numbers.
fn rationals(arguments: &[Formula], scope: &Scope) -> Option<Vec<Rational>> {
    let rational = |argument| match exact::closed(argument, scope) {
        Ok(Value(value)) => value.as_rational(),
        _ => None,
    };
    arguments.iter().map(rational).collect()
}

/// Sums, suprema and infima over integers.
fn over_range(ranged: &Ranged, scope: &Scope, precision: u32) -> Enclosure {
    let Some((from, to)) = range::integer_range(ranged, scope)? else {
        return Ok(Undefined);
    };
    let mut total =
        (ranged.kind == RangeKind::Sum).then(|| Value(Interval::from_i64(0, precision)));
    let mut j = from;
    while j <= to {
        let place = Quantity::rational(Rational::from(&j));
        let link = scope.bind(&ranged.name, Binding::Quantity(place));
        let term = within(&ranged.body, &link.scope(), precision)?;
        total = Some(match total {
            None => term,
            Some(total) => combine(ranged.kind, total, term)?,
        });
        j += 1;
    }
    Ok(total.unwrap_or(Undefined))
}

fn combine(kind: RangeKind, total: Outcome<Interval>, term: Outcome<Interval>) -> Enclosure {
    match (kind, total, term) {
        (RangeKind::Sum, total, term) => outcome::add(total, term, |a, b| Ok(Value(a.add(&b)))),
        (_, Undefined, _) | (_, _, Undefined) => Ok(Undefined),
        (RangeKind::Supremum, Value(a), Value(b)) => Ok(Value(a.max(&b))),
        (_, Value(a), Value(b)) => Ok(Value(a.min(&b))),
        _ => Err(unsupported("an infinite supremum by intervals")),
    }
}

/// Means, integrals, limits, ...: the exact value, else a mean by Euler's integral.
fn exactly_or_by_series(formula: &Formula, scope: &Scope, precision: u32) -> Enclosure {
    match exact::closed(formula, scope) {
        Ok(outcome) => Ok(outcome.map(|value| value.enclose(precision))),
        Err(Failure::Exhausted) => Err(Failure::Exhausted),
        Err(failure) => match formula {
            Formula::Mean(..) | Formula::Variance(..) => {
                match euler::enclose(formula, scope, precision, failure) {
                    Err(Failure::Exhausted) => Err(Failure::Exhausted),
                    Err(failure) => line::mean(formula, scope, precision, failure),
                    outcome => outcome,
                }
            }
            Formula::At(body, places) => at(body, places, scope, precision),
            Formula::Derivative(body, name, times) => {
                derivative(body, name, times, scope, precision)
            }
            Formula::Ranged(ranged) => match failure {
                Failure::Undecided(_) | Failure::Unsupported(_) | Failure::TooLarge(_) => {
                    line::integral(ranged, scope, precision)
                }
                Failure::Exhausted => Err(failure),
            },
            _ => Err(failure),
        },
    }
}

/// As for exact values: the formula itself must have a value, and so must the rules' result.
fn derivative(
    body: &Formula,
    name: &Name,
    times: &Formula,
    scope: &Scope,
    precision: u32,
) -> Enclosure {
    let times = exact::derivative_order(times, scope)?;
    let result = differentiate::repeatedly(body, name, times, scope)?;
    match (
        within(body, scope, precision)?,
        within(&result, scope, precision)?,
    ) {
        (Value(_), Value(slope)) => Ok(Value(slope)),
        (Undefined, _) => Ok(Undefined),
        _ => Err(unsupported("a derivative at a singular place")),
    }
}

fn at(body: &Formula, places: &[(Name, Formula)], scope: &Scope, precision: u32) -> Enclosure {
    let mut values = vec![];
    for (name, place) in places {
        match exact::value(place, scope)? {
            Value(place) => values.push((name, place)),
            Undefined => return Ok(Undefined),
            _ => return Err(unsupported("a value at infinity")),
        }
    }
    exact::bound(body, &values, scope, &mut |body, scope| {
        within(body, scope, precision)
    })
}
