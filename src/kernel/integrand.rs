//! From an integral to the pieces of its range on which the integrand is a fraction: no comparison
//! of the variable changes inside of one.

use super::condition::pairs;
use super::fraction::Fraction;
use super::integrate::{Piece, total};
use super::interval::Interval;
use super::law;
use super::polynomial::Polynomial;
use super::quantity::Quantity;
use super::scope::Scope;
use super::value::{evaluate, finite};
use super::{Found, Gap, Unknown, known, unknown};
use crate::formula::{Condition, Formula, Function, Name, Part, Ranged, Rational};
use num_traits::One;
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
        scope.spend((body.numerator.length() * (20 + weight.length())) as u64)?;
        Ok(body.times(&weight.clone().into())?)
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
    let cuts = cuts(Part::Formula(body), name, scope)?;
    let places = places(cuts, from, to)?;
    let mut pieces = Vec::new();
    for pair in places.windows(2) {
        let middle = (pair[0].high() + pair[1].low()) / Rational::from_integer(2.into());
        let (low, high) = (pair[0].clone(), pair[1].clone());
        pieces.push(Piece::new(&function(&middle)?, low, high)?);
    }
    let zero = Interval::integer(0);
    let (first, last) = (&places[0], &places[places.len() - 1]);
    if *from == Quantity::MinusInfinity {
        let tail = function(&(first.low() - Rational::one()))?.inverted()?;
        pieces.push(Piece::new(&tail, first.reciprocal()?, zero.clone())?);
    }
    if *to == Quantity::PlusInfinity {
        let tail = function(&(last.high() + Rational::one()))?.inverted()?;
        pieces.push(Piece::new(&tail, zero, last.reciprocal()?)?);
    }
    total(&pieces, scope.bits)
}

/// The finite ends of a range and the cuts between them, in order. Towards an infinite end the last
/// one is a number beyond all cuts, and beyond 0.
fn places(cuts: Vec<Interval>, from: &Quantity, to: &Quantity) -> Result<Vec<Interval>, Unknown> {
    let mut places = Vec::new();
    for cut in cuts {
        let place = cut.clone().into();
        if from.compare(&place)?.is_lt() && to.compare(&place)?.is_gt() {
            places.push(cut);
        }
    }
    for end in [from, to] {
        if let Quantity::Finite(end) = end {
            places.extend(end.as_number());
        }
    }
    let zero = Interval::integer(0);
    let one = Rational::one();
    if *from == Quantity::MinusInfinity {
        let least = places.iter().fold(zero.clone(), |a, b| a.minimum(b));
        places.push(Interval::exact(least.low().floor() - &one));
    }
    if *to == Quantity::PlusInfinity {
        let greatest = places.iter().fold(zero, |a, b| a.maximum(b));
        places.push(Interval::exact(greatest.high().ceil() + one));
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
            let more = match bound {
                [] => cuts(inner, name, scope),
                _ => cuts(inner, name, &scope.without(bound)),
            };
            answer = more.map(|more| found.extend(more));
        }
    });
    answer.map(|()| found)
}

/// The same for the comparisons that a part makes itself.
fn cuts_here(part: Part, name: &Name, scope: &Scope) -> Result<Vec<Interval>, Unknown> {
    let zero = Formula::integer(0);
    let mut compared = Vec::new();
    match part {
        Part::Condition(Condition::Chain(first, links)) => {
            compared.extend(pairs(first, links).map(|(left, _, right)| (left, right)));
        }
        Part::Formula(Formula::Call(Function::Abs, list)) => compared.push((&list[0], &zero)),
        Part::Formula(Formula::Call(Function::Min | Function::Max, list)) => {
            for (i, a) in list.iter().enumerate() {
                compared.extend(list[..i].iter().map(|b| (a, b)));
            }
        }
        Part::Formula(Formula::Density(drawn, place) | Formula::Cumulative(drawn, place)) => {
            if scope.occurs(name, Part::Formula(place)) {
                return known(support_cuts(drawn, place, scope), "a density without value");
            }
        }
        _ => {}
    }
    let mut found = Vec::new();
    for (a, b) in compared {
        if scope.occurs(name, Part::Formula(a)) || scope.occurs(name, Part::Formula(b)) {
            found.extend(crossings(a, b, scope)?);
        }
    }
    Ok(found)
}

/// Where a place crosses an end of a draw's support.
fn support_cuts(drawn: &Formula, place: &Formula, scope: &Scope) -> Found<Vec<Interval>> {
    let weight = law::of_draw(drawn, scope)?;
    let place = finite(place, scope)?;
    let mut found = place.plus(&Fraction::from(-&weight.from))?.sign_changes()?;
    found.extend(place.plus(&Fraction::from(-&weight.to))?.sign_changes()?);
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
