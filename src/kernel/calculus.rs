//! Derivatives by the rules of calculus, and limits by continuity.
//!
//! Both are taken around a place: a formula that has a value with the name bound to an enclosure has
//! one at each of its numbers, and every function that the kernel knows of such an enclosure is
//! continuous on it (what jumps or has gaps refuses an enclosure around the place where it does).

use super::interval::Interval;
use super::law;
use super::quantity::Quantity;
use super::scope::Scope;
use super::value::{evaluate, finite, number};
use super::{Found, Unknown, known, unknown};
use crate::formula::{
    Draw, Formula, Function, Law, Name, Operator, Part, RangeKind, Rational, Substitution,
    free_names,
};
use num_traits::ToPrimitive;

/// No higher derivative is taken.
const ORDER_CAP: u64 = 12;

/// The value of a derivative at the place that its variable stands for.
pub(super) fn derivative(f: &Formula, x: &Name, order: &Formula, scope: &Scope) -> Found<Quantity> {
    let order = number(order, scope)?.as_integer().and_then(|n| n.to_u64());
    let Some(order) = order.filter(|&n| n <= ORDER_CAP) else {
        return unknown("a derivative whose order is no small integer");
    };
    // Of an integral's variable, all but finitely many numbers have such a neighbourhood.
    let around = match scope.look_up(x)?.finite()?.as_number() {
        Some(place) => scope.with(x, place.around(scope.bits)),
        None => scope.clone(),
    };
    finite(f, &around)?;
    let no_rule = "a derivative whose rule has no value here";
    let mut derived = unfolded(f, scope)?;
    for _ in 0..order {
        derived = derive(&derived, x)?;
        scope.spend(Part::Formula(&derived).nodes(1 << 16) as u64)?;
        known(finite(&derived, &around), no_rule)?;
    }
    Ok(known(evaluate(&derived, scope), no_rule)?)
}

/// The formula with the function parameters as the bodies that the point gives them.
fn unfolded(f: &Formula, scope: &Scope) -> Result<Formula, Unknown> {
    let mut substitution = Substitution::new();
    for (name, (argument, body)) in &scope.point.functions {
        substitution.function(name.clone(), vec![argument.clone()], body.clone());
    }
    let unfolded = substitution.formula(f);
    unfolded.map_err(|why| Unknown(why.to_string()))
}

/// The limit of a formula as names tend to finite targets, from all sides: the value there, of a
/// formula that has values all around.
pub(super) fn limit(f: &Formula, places: &[(Name, Formula)], scope: &Scope) -> Found<Quantity> {
    let (mut target, mut around) = (scope.clone(), scope.clone());
    for (name, place) in places {
        let place = number(place, scope)?;
        around = around.with(name, place.around(scope.bits));
        target = target.with(name, place);
    }
    let moves = |(name, _): &(Name, Formula), f| scope.occurs(name, Part::Formula(f));
    if let Formula::Mean(body, own) = f
        && let Some((draw, _)) = law::draw_of(body, own.as_deref(), scope)?
        && let Law::Beta(a, b) = &draw.law
        && !places.iter().any(|place| moves(place, body))
    {
        // The parameters tend to those at the target.
        number(a, &around)?;
        number(b, &around)?;
        return Ok(limit_of_mean(body, own.as_deref(), &target)?);
    }
    finite(f, &around)?;
    evaluate(f, &target)
}

/// The limit of the mean of a fixed body over Beta laws whose parameters converge: their densities
/// do, hence in the mean (Scheffe's lemma), and a body that is continuous on 0..1 is bounded. Of one
/// that is nonnegative with an infinite mean at the target, the means grow beyond all bounds
/// (Fatou's lemma); the mean was found infinite for a body of one sign only.
fn limit_of_mean(body: &Formula, own: Option<&Draw>, target: &Scope) -> Result<Quantity, Unknown> {
    let why = "a limit of a mean without value";
    let mean = known(law::mean(body, own, target), why)?;
    if let (Quantity::Finite(_), Some((_, inner))) = (&mean, law::draw_of(body, own, target)?) {
        let body = known(finite(body, &inner), why)?;
        for pole in body.poles.into_keys().map(Interval::exact) {
            if pole.compare(&Interval::integer(0))?.is_ge()
                && pole.compare(&Interval::integer(1))?.is_le()
            {
                return unknown("a limit of a mean with a pole in its support");
            }
        }
    }
    Ok(mean)
}

/// The derived formula: wherever it and the formula both have finite values on an open interval, it
/// is the derivative there.
pub(super) fn derive(f: &Formula, x: &Name) -> Result<Formula, Unknown> {
    if !free_names(f).contains(x) {
        return Ok(Formula::integer(0));
    }
    match f {
        Formula::Name(_) => Ok(Formula::integer(1)),
        Formula::Negate(a) => Ok(Formula::Negate(Box::new(derive(a, x)?))),
        Formula::Binary(operator, a, b) => derive_binary(*operator, a, b, x),
        Formula::Call(function, parts) => match parts.as_slice() {
            [a] => Ok(binary(
                Operator::Multiply,
                derive_call(*function, a)?,
                derive(a, x)?,
            )),
            _ => unknown("a derivative of a function without a rule"),
        },
        Formula::Ranged(r) if r.kind == RangeKind::Integral && r.name != *x => {
            // The fundamental theorem, for a body that is continuous where it has a value.
            if free_names(&r.body).contains(x) || !is_continuous(&r.body) {
                return unknown("a derivative under the integral");
            }
            let end = |place: &Formula| {
                let there = vec![(r.name.clone(), place.clone())];
                let value = Formula::At(Box::new(r.body.clone()), there);
                Ok(binary(Operator::Multiply, value, derive(place, x)?))
            };
            Ok(binary(Operator::Subtract, end(&r.to)?, end(&r.from)?))
        }
        _ => unknown("a derivative of a formula without a rule"),
    }
}

fn derive_binary(
    operator: Operator,
    a: &Formula,
    b: &Formula,
    x: &Name,
) -> Result<Formula, Unknown> {
    use Operator::{Add, Divide, Multiply, Power, Subtract};
    let (da, db) = (derive(a, x)?, derive(b, x)?);
    let (a, b) = (a.clone(), b.clone());
    Ok(match operator {
        Add | Subtract => binary(operator, da, db),
        Multiply => binary(Add, binary(Multiply, b, da), binary(Multiply, a, db)),
        Divide => {
            let (first, second) = (binary(Multiply, b.clone(), da), binary(Multiply, a, db));
            let square = binary(Power, b, Formula::integer(2));
            binary(Divide, binary(Subtract, first, second), square)
        }
        Power if db == Formula::integer(0) => {
            let less = binary(Subtract, b.clone(), Formula::integer(1));
            binary(Multiply, binary(Multiply, b, binary(Power, a, less)), da)
        }
        // (e^(b*ln(a)))', which has a value for a > 0 only.
        Power => {
            let logarithm = Formula::Call(Function::Ln, vec![a.clone()]);
            let growth = binary(Multiply, binary(Divide, b.clone(), a.clone()), da);
            let growth = binary(Add, binary(Multiply, logarithm, db), growth);
            binary(Multiply, binary(Power, a, b), growth)
        }
    })
}

/// The derivative of a function at its argument, DLMF 4.7.1, 4.7.4, 4.20.1 and 4.20.2.
fn derive_call(function: Function, a: &Formula) -> Result<Formula, Unknown> {
    let call = |function| Formula::Call(function, vec![a.clone()]);
    let over = |above, below| Formula::binary(Operator::Divide, above, below);
    Ok(match function {
        Function::Exp => call(Function::Exp),
        Function::Ln => over(Formula::integer(1), a.clone()),
        Function::Sin => call(Function::Cos),
        Function::Cos => Formula::Negate(Box::new(call(Function::Sin))),
        Function::Sqrt => over(
            Formula::Number(Rational::new(1.into(), 2.into())),
            call(Function::Sqrt),
        ),
        Function::Abs => over(call(Function::Abs), a.clone()),
        _ => return unknown("a derivative of a function without a rule"),
    })
}

/// Whether a formula is built of functions that are continuous wherever they have values.
pub(super) fn is_continuous(f: &Formula) -> bool {
    match f {
        Formula::Number(_) | Formula::Pi | Formula::Name(_) => true,
        Formula::Negate(a) => is_continuous(a),
        Formula::Binary(Operator::Power, a, b) => {
            is_continuous(a) && matches!(**b, Formula::Number(_))
        }
        Formula::Binary(_, a, b) => is_continuous(a) && is_continuous(b),
        Formula::Call(Function::Exp | Function::Ln | Function::Sqrt, parts)
        | Formula::Call(Function::Sin | Function::Cos | Function::Abs, parts) => {
            parts.iter().all(is_continuous)
        }
        _ => false,
    }
}

/// The operation, or what it comes to where one side of a sum or product is 0 or 1.
fn binary(operator: Operator, a: Formula, b: Formula) -> Formula {
    let (zero, one) = (Formula::integer(0), Formula::integer(1));
    match operator {
        Operator::Add if a == zero => b,
        Operator::Add | Operator::Subtract if b == zero => a,
        Operator::Multiply if b == zero || b == one => {
            if b == one {
                a
            } else {
                b
            }
        }
        _ => Formula::binary(operator, a, b),
    }
}
