//! Values of derivatives, by the rules of calculus, and of limits, by continuity.
//!
//! Both are taken around a place: a formula that has a value with the name bound to an enclosure has
//! one at each of its numbers, and every function that the kernel knows of such an enclosure is
//! continuous on it (what jumps or has gaps refuses an enclosure around the place where it does).

use super::derivative::derive;
use super::interval::Interval;
use super::law;
use super::quantity::Quantity;
use super::scope::Scope;
use super::value::{evaluate, finite, number};
use super::{Found, Unknown, known, unknown};
use crate::formula::{Draw, Formula, Law, Name, Part, Substitution};
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
