//! From an integral to the pieces of its range on which the integrand is a fraction: no comparison
//! of the variable changes inside of one.

use super::condition::pairs;
use super::fraction::Fraction;
use super::integrate::{Piece, total};
use super::interval::Interval;
use super::polynomial::Polynomial;
use super::quantity::Quantity;
use super::scope::Scope;
use super::value::{evaluate, finite};
use super::{Found, Gap, Unknown, unknown};
use crate::formula::{Condition, Formula, Function, Name, Part, Ranged, Rational};
use std::cmp::Ordering;

/// An integral between its ends.
pub(super) fn integral(r: &Ranged, scope: &Scope) -> Found<Quantity> {
    let (from, to) = (evaluate(&r.from, scope)?, evaluate(&r.to, scope)?);
    if let (Quantity::Finite(from), Quantity::Finite(to)) = (&from, &to)
        && (from.as_number().is_none() || to.as_number().is_none())
    {
        return between_functions(r, from, to, scope);
    }
    let one = Polynomial::constant(Interval::integer(1));
    let inner = scope.with_variable(&r.name);
    over_range(&r.body, &one, &r.name, (&from, &to), &inner)
}

/// An integral whose ends depend on the variable of an integral around: A(to) - A(from) for a
/// polynomial antiderivative A.
fn between_functions(r: &Ranged, from: &Fraction, to: &Fraction, scope: &Scope) -> Found<Quantity> {
    let body = finite(&r.body, &scope.with_variable(&r.name))?;
    match body.as_polynomial().map(Polynomial::antiderivative) {
        Some(whole) => Ok(whole.of(to)?.plus(&whole.of(from)?.negated())?.into()),
        None => unknown("a pole where the kernel needs a polynomial"),
    }
}

/// The integral of a formula, times a polynomial weight, over a range given by its ends, in the
/// scope of its variable.
pub(super) fn over_range(
    body: &Formula,
    weight: &Polynomial,
    name: &Name,
    (from, to): (&Quantity, &Quantity),
    scope: &Scope,
) -> Found<Quantity> {
    let function = |sample: &Rational| -> Found<Fraction> {
        let body = finite(body, &scope.at(sample))?;
        let weight = Fraction::from(weight.clone());
        scope.spend_on(&body, &weight)?;
        Ok(body.times(&weight)?)
    };
    match from.compare(to)? {
        Ordering::Less => {}
        Ordering::Greater => {
            let reversed = over_range(body, weight, name, (to, from), scope)?;
            return Ok(reversed.negated());
        }
        // A point has no length, whatever the integrand is there.
        Ordering::Equal => {
            from.clone().number()?;
            return Ok(Interval::integer(0).into());
        }
    }
    let (from, to) = (from.clone().number()?, to.clone().number()?);
    let cuts = cuts(Part::Formula(body), name, scope)?;
    let mut pieces = Vec::new();
    for pair in places(cuts, from, to)?.windows(2) {
        let middle = (pair[0].high() + pair[1].low()) / Rational::from_integer(2.into());
        let function = function(&middle)?;
        pieces.push(Piece::new(&function, pair[0].clone(), pair[1].clone())?);
    }
    total(&pieces, scope.bits)
}

/// The ends of a range and the cuts between them, in order.
fn places(cuts: Vec<Interval>, from: Interval, to: Interval) -> Result<Vec<Interval>, Unknown> {
    let mut places = vec![from.clone(), to.clone()];
    for cut in cuts {
        if from.compare(&cut)?.is_lt() && cut.compare(&to)?.is_lt() {
            places.push(cut);
        }
    }
    places.sort_by(|a, b| a.low().cmp(b.low()));
    places.dedup_by(|a, b| a.compare(b) == Ok(Ordering::Equal));
    for pair in places.windows(2) {
        pair[0].compare(&pair[1])?;
    }
    Ok(places)
}

/// The numbers at which a comparison of the variable may change, anywhere in a formula.
fn cuts(part: Part, name: &Name, scope: &Scope) -> Result<Vec<Interval>, Unknown> {
    scope.spend(1)?;
    let mut found = cuts_here(part, name, scope)?;
    let mut answer = Ok(());
    part.each(&mut |inner, bound| {
        if answer.is_ok() {
            let more = cuts(inner, name, &scope.without(bound));
            answer = more.map(|more| found.extend(more));
        }
    });
    answer.map(|()| found)
}

/// The same for the comparisons that a part makes itself.
fn cuts_here(part: Part, name: &Name, scope: &Scope) -> Result<Vec<Interval>, Unknown> {
    let zero = Formula::integer(0);
    let compared: Vec<(&Formula, &Formula)> = match part {
        Part::Condition(Condition::Chain(first, links)) => pairs(first, links)
            .map(|(left, _, right)| (left, right))
            .collect(),
        Part::Formula(Formula::Call(Function::Abs, list)) => vec![(&list[0], &zero)],
        _ => Vec::new(),
    };
    let mut found = Vec::new();
    for (a, b) in compared {
        if scope.occurs(name, Part::Formula(a)) || scope.occurs(name, Part::Formula(b)) {
            found.extend(crossings(a, b, scope)?);
        }
    }
    Ok(found)
}

/// Where a - b may change its sign; nowhere, if one of them has no value at all.
fn crossings(a: &Formula, b: &Formula, scope: &Scope) -> Result<Vec<Interval>, Unknown> {
    let difference = finite(a, scope).and_then(|a| Ok(a.plus(&finite(b, scope)?.negated())?));
    match difference {
        Ok(difference) => difference.sign_changes(),
        Err(Gap::Undefined) => Ok(Vec::new()),
        Err(Gap::Unknown(why)) => Err(why),
    }
}
