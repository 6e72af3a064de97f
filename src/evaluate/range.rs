//! Exact sums, suprema and infima over integers, and integrals, piecewise ones among them.

use super::exact::{Evaluation, more_extreme, negate, number, value};
use super::integrate::{self, Bound};
use super::outcome;
use super::pieces::{self, Piece};
use super::quantity::{Quantity, Separable, Symbol};
use super::scope::{Binding, Scope};
use super::sign::{self, Sign};
use super::{Failure, Outcome, unsupported};
use crate::formula::{Formula, Name, Part, RangeKind, Ranged};
use rug::{Integer, Rational};
use std::cmp::Ordering;

use Outcome::{MinusInfinity, PlusInfinity, Undefined, Value};

/// The value of a sum, integral, supremum or infimum.
pub(super) fn ranged(ranged: &Ranged, scope: &Scope) -> Evaluation {
    if ranged.kind == RangeKind::Integral {
        return integral(ranged, scope);
    }
    let Some((from, to)) = integer_range(ranged, scope)? else {
        return Ok(Undefined);
    };
    let mut total =
        (ranged.kind == RangeKind::Sum).then(|| Value(Quantity::rational(Rational::new())));
    let mut j = from;
    while j <= to {
        scope.spend(1)?;
        let place = Quantity::rational(Rational::from(&j));
        let link = scope.bind(&ranged.name, Binding::Quantity(place));
        let term = value(&ranged.body, &link.scope())?;
        total = Some(match total {
            None => term,
            Some(total) => combine(ranged.kind, total, term, scope)?,
        });
        j += 1;
    }
    // The supremum of nothing has no value.
    Ok(total.unwrap_or(Undefined))
}

fn combine(
    kind: RangeKind,
    total: Outcome<Quantity>,
    term: Outcome<Quantity>,
    scope: &Scope,
) -> Evaluation {
    match kind {
        RangeKind::Supremum => more_extreme(total, term, Ordering::Greater, scope),
        RangeKind::Infimum => more_extreme(total, term, Ordering::Less, scope),
        _ => outcome::add(total, term, |a, b| Ok(Value(a.add(b, scope.budget())?))),
    }
}

/// The ends of a range of integers, `None` where they have no value. The empty range from a to a-1 is
/// one, a range further reversed is refused.
pub(super) fn integer_range(
    ranged: &Ranged,
    scope: &Scope,
) -> Result<Option<(Integer, Integer)>, Failure> {
    let mut ends = vec![];
    for end in [&ranged.from, &ranged.to] {
        match value(end, scope)? {
            Value(end) => {
                let end = end
                    .closed("a bound")?
                    .as_rational()
                    .filter(|end| *end.denom() == 1);
                let end =
                    end.ok_or_else(|| unsupported("a range between numbers that are no integers"))?;
                ends.push(end.into_numer_denom().0);
            }
            Undefined => return Ok(None),
            _ => return Err(unsupported("a range without end")),
        }
    }
    match <[Integer; 2]>::try_from(ends) {
        Ok([from, to]) if Integer::from(&from - 1) <= to => Ok(Some((from, to))),
        _ => Err(unsupported("a reversed range")),
    }
}

fn integral(ranged: &Ranged, scope: &Scope) -> Evaluation {
    let (from, to) = (value(&ranged.from, scope)?, value(&ranged.to, scope)?);
    if matches!(from, Undefined) || matches!(to, Undefined) {
        return Ok(Undefined);
    }
    let open = |end: &Outcome<Quantity>| matches!(end, Value(Quantity::Open(_)));
    let symbol = scope.new_symbol();
    let link = scope.bind(&ranged.name, unsampled(symbol, false));
    if let (true, Value(from), Value(to)) = (open(&from) || open(&to), &from, &to) {
        if pieces_needed(&ranged.body, &link.scope(), symbol)? {
            return Err(unsupported("a piecewise integrand between variable bounds"));
        }
        return value(&ranged.body, &link.scope())?.finite("an integrand", |body| {
            integrate::between_functions(
                &body.open(),
                symbol,
                from.clone(),
                to.clone(),
                scope.budget(),
            )
        });
    }
    let (from, to) = (as_bound(from)?, as_bound(to)?);
    match pieces::direction(&from, &to)? {
        Ordering::Less => between(&ranged.body, &ranged.name, &from, &to, scope),
        Ordering::Greater => {
            let reversed = between(&ranged.body, &ranged.name, &to, &from, scope)?;
            negate(reversed, scope)
        }
        Ordering::Equal => {
            // A point has no length, whatever the integrand is there.
            match from {
                Bound::Finite(_) => number(Rational::new()),
                _ => Err(unsupported("an integral from infinity to infinity")),
            }
        }
    }
}

pub(super) fn unsampled(symbol: Symbol, draw: bool) -> Binding {
    Binding::Symbol {
        symbol,
        sample: None,
        draw,
    }
}

/// Whether an integrand is piecewise; asked over the whole line.
fn pieces_needed(body: &Formula, scope: &Scope, symbol: Symbol) -> Result<bool, Failure> {
    let ends = (Bound::MinusInfinity, Bound::PlusInfinity);
    Ok(pieces::of(Part::Formula(body), scope, symbol, &ends.0, &ends.1)?.is_some())
}

fn as_bound(end: Outcome<Quantity>) -> Result<Bound, Failure> {
    match end {
        Value(end) => Ok(Bound::Finite(end.closed("a bound")?)),
        PlusInfinity => Ok(Bound::PlusInfinity),
        MinusInfinity => Ok(Bound::MinusInfinity),
        Undefined => Err(unsupported("a bound without a value")),
    }
}

/// The integral of `body` over `from < to`.
fn between(body: &Formula, name: &Name, from: &Bound, to: &Bound, scope: &Scope) -> Evaluation {
    let symbol = scope.new_symbol();
    let link = scope.bind(name, unsampled(symbol, false));
    let pieces = pieces::of(Part::Formula(body), &link.scope(), symbol, from, to)?;
    let Some(pieces) = pieces else {
        return value(body, &link.scope())?.finite("an integrand", |body| {
            integrate::over(&body.open(), symbol, from, to, scope.budget())
        });
    };
    let mut parts = vec![];
    for piece in pieces {
        let link = scope.bind(name, sampled_at(symbol, &piece, false));
        match value(body, &link.scope())? {
            Value(function) => parts.push((function.open(), piece)),
            Undefined => return Ok(Undefined),
            _ => return Err(unsupported("an infinite integrand")),
        }
    }
    let budget = scope.budget();
    add_pieces(&parts, symbol, scope, |function, piece| {
        integrate::over(function, symbol, &piece.from, &piece.to, budget)
    })
}

pub(super) fn sampled_at(symbol: Symbol, piece: &Piece, draw: bool) -> Binding {
    Binding::Symbol {
        symbol,
        sample: Some(piece.sample.clone()),
        draw,
    }
}

/// The sum of the pieces' integrals. A divergent piece makes the whole infinite only if all pieces have
/// its sign.
pub(super) fn add_pieces(
    parts: &[(Separable, Piece)],
    symbol: Symbol,
    scope: &Scope,
    integral: impl Fn(&Separable, &Piece) -> Evaluation,
) -> Evaluation {
    let mut total = Quantity::rational(Rational::new());
    let mut infinite = false;
    for (function, piece) in parts {
        match integral(function, piece)? {
            Value(part) => total = total.add(part, scope.budget())?,
            Undefined => return Ok(Undefined),
            _ => infinite = true,
        }
    }
    if !infinite {
        return Ok(Value(total));
    }
    let mut signs = vec![];
    for (function, piece) in parts {
        let function = Quantity::Open(function.clone()).single_function(symbol);
        let function = function.ok_or_else(|| unsupported("a divergent piecewise integral"))?;
        if !function.is_zero() {
            signs.push(sign::on(&function, &piece.from, &piece.to, scope.budget())?);
        }
    }
    let mixed = signs.contains(&Sign::NonNegative) && signs.contains(&Sign::NonPositive);
    let first = signs.first().copied().unwrap_or(Sign::Unknown);
    match signs
        .iter()
        .find(|sign| matches!(sign, Sign::Unknown | Sign::Mixed))
    {
        Some(sign) => integrate::infinite(*sign),
        None if mixed => Ok(Undefined),
        None => integrate::infinite(first),
    }
}
