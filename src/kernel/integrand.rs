//! From a formula to integrands that the kernel can integrate: on each piece of the range, where no
//! comparison of the variable changes, the formula is a fraction.
//!
//! A fraction speaks of the formula but for finitely many points of the piece, which no integral
//! sees.

use super::calculus;
use super::integrate::integral;
use super::interval::{Interval, Value};
use super::law;
use super::polynomial::{Fraction, Polynomial, linear_factors};
use super::scope::{Binding, Scope};
use super::sums;
use super::value::value_in;
use super::{Unknown, unknown};
use crate::formula::{
    Condition, Formula, Function, Name, Operator, RangeKind, Ranged, Rational, Relation,
};
use num_traits::{One, ToPrimitive};
use std::cmp::Ordering;

/// The variable of an integral, and a number of the piece at which comparisons are decided.
pub(super) struct Variable<'a> {
    pub name: &'a Name,
    pub sample: Option<Rational>,
}

/// The integral of a formula, times a polynomial weight, over a range given by its ends.
pub(super) fn over_range(
    body: &Formula,
    weight: &Polynomial,
    name: &Name,
    ends: (&Value, &Value),
    scope: &Scope,
) -> Result<Value, Unknown> {
    let (from, to) = ends;
    match from.compare(to) {
        // A point has no length, whatever the integrand is there.
        Some(Ordering::Equal) if from.finite().is_some() => return Ok(Value::exact(0)),
        Some(Ordering::Equal) => return unknown("an integral from infinity to infinity"),
        Some(Ordering::Greater) => {
            return Ok(over_range(body, weight, name, (to, from), scope)?.negated());
        }
        Some(Ordering::Less) => {}
        None => return unknown("the order of an integral's ends is not settled at these bits"),
    }
    let mut pieces = Vec::new();
    let cuts = inner_cuts(body, name, from, to, scope)?;
    for pair in cuts.windows(2) {
        let sample = Some(between(&pair[0], &pair[1]));
        let Some(f) = fraction(body, &Variable { name, sample }, scope)? else {
            return Ok(Value::Undefined);
        };
        let f = f.times(&Fraction::polynomial(weight.clone()), scope.bits)?;
        if f.numerator.is_zero() {
            continue;
        }
        scope.spend((f.numerator.length() * 20) as u64)?;
        pieces.push(integral(&f, &pair[0], &pair[1], scope.bits)?);
    }
    sum_of_pieces(&pieces, scope.bits)
}

/// Infinite pieces add to pieces that are infinite alike only: elsewhere the integrand may change
/// its sign. Pieces where the integrand is zero have been left out.
fn sum_of_pieces(pieces: &[Value], bits: u64) -> Result<Value, Unknown> {
    if let Some(infinite) = pieces.iter().find(|piece| piece.finite().is_none()) {
        if !pieces.iter().all(|piece| piece == infinite) {
            return unknown("an integral that diverges on some pieces of its range only");
        }
        return Ok(infinite.clone());
    }
    let add = |sum: Value, piece: &Value| sum.plus(piece, bits);
    Ok(pieces.iter().fold(Value::exact(0), add))
}

/// The ends and the cuts between them, in order.
fn inner_cuts(
    body: &Formula,
    name: &Name,
    from: &Value,
    to: &Value,
    scope: &Scope,
) -> Result<Vec<Value>, Unknown> {
    let mut found = cuts_of(body, name, scope)?;
    found.sort_by(|a, b| a.low().cmp(b.low()));
    let mut result = vec![from.clone()];
    for cut in found.into_iter().map(Value::from) {
        match (result[result.len() - 1].compare(&cut), cut.compare(to)) {
            (Some(Ordering::Less), Some(Ordering::Less)) => result.push(cut),
            (Some(Ordering::Greater | Ordering::Equal), _) => {}
            (_, Some(Ordering::Greater | Ordering::Equal)) => {}
            _ => return unknown("the order of an integrand's cuts is not settled at these bits"),
        }
    }
    result.push(to.clone());
    Ok(result)
}

/// A number strictly between two values of which the first is less.
fn between(low: &Value, high: &Value) -> Rational {
    match (low.finite(), high.finite()) {
        (Some(a), Some(b)) => (a.high() + b.low()) / Rational::from_integer(2.into()),
        (Some(a), None) => a.high() + Rational::one(),
        (None, Some(b)) => b.low() - Rational::one(),
        (None, None) => Rational::from_integer(0.into()),
    }
}

/// The numbers at which a comparison inside the formula may change.
pub(super) fn cuts_of(f: &Formula, x: &Name, scope: &Scope) -> Result<Vec<Interval>, Unknown> {
    let mut found = Vec::new();
    cuts(f, x, scope, &mut found)?;
    Ok(found)
}

/// Adds the numbers at which a comparison inside the formula may change.
fn cuts(f: &Formula, x: &Name, scope: &Scope, out: &mut Vec<Interval>) -> Result<(), Unknown> {
    scope.spend(1)?;
    if !scope.depends(f, x) {
        return Ok(());
    }
    match f {
        Formula::Negate(a) => cuts(a, x, scope, out),
        Formula::Binary(_, a, b) => {
            cuts(a, x, scope, out)?;
            cuts(b, x, scope, out)
        }
        Formula::Apply(_, parts) => parts.iter().try_for_each(|part| cuts(part, x, scope, out)),
        Formula::Call(function, parts) => {
            match (function, parts.as_slice()) {
                (Function::Abs, [a]) => zeros(a, None, x, scope, out)?,
                (Function::Min | Function::Max, _) => {
                    for (i, a) in parts.iter().enumerate() {
                        for b in &parts[..i] {
                            zeros(a, Some(b), x, scope, out)?;
                        }
                    }
                }
                _ => {}
            }
            parts.iter().try_for_each(|part| cuts(part, x, scope, out))
        }
        Formula::Indicator(c) => condition_cuts(c, x, scope, out),
        Formula::If(c, a, b) => {
            condition_cuts(c, x, scope, out)?;
            cuts(a, x, scope, out)?;
            cuts(b, x, scope, out)
        }
        Formula::Ranged(r) if r.kind == RangeKind::Sum => {
            sums::each(r, scope, |inner| cuts(&r.body, x, inner, out))
        }
        Formula::Density(drawn, at) | Formula::Cumulative(drawn, at) => {
            if let Some(weight) = law::of_draw(drawn, scope)? {
                for end in [weight.from, weight.to] {
                    let place = fraction(
                        at,
                        &Variable {
                            name: x,
                            sample: None,
                        },
                        scope,
                    )?;
                    let end = Fraction::constant(end.negated());
                    let Some(place) = place else { continue };
                    fraction_zeros(&place.plus(&end, scope.bits)?, scope.bits, out)?;
                }
            }
            Ok(())
        }
        Formula::Ranged(r) if r.kind == RangeKind::Integral => {
            cuts(&r.from, x, scope, out)?;
            cuts(&r.to, x, scope, out)
        }
        Formula::At(_, places) => places
            .iter()
            .try_for_each(|(_, place)| cuts(place, x, scope, out)),
        Formula::Derivative(a, name, order) => {
            cuts(&calculus::derived(a, name, order, scope)?, x, scope, out)
        }
        Formula::Name(_) => Ok(()),
        _ => unknown("an integrand that is no rational function of its variable"),
    }
}

fn condition_cuts(
    condition: &Condition,
    x: &Name,
    scope: &Scope,
    out: &mut Vec<Interval>,
) -> Result<(), Unknown> {
    match condition {
        Condition::Chain(first, links) => {
            let mut left = first;
            for (_, right) in links {
                zeros(left, Some(right), x, scope, out)?;
                left = right;
            }
            Ok(())
        }
        Condition::And(parts) | Condition::Or(parts) => parts
            .iter()
            .try_for_each(|part| condition_cuts(part, x, scope, out)),
        Condition::Not(part) => condition_cuts(part, x, scope, out),
    }
}

/// Where a - b may change its sign: at zeros and poles.
fn zeros(
    a: &Formula,
    b: Option<&Formula>,
    x: &Name,
    scope: &Scope,
    out: &mut Vec<Interval>,
) -> Result<(), Unknown> {
    match difference(
        a,
        b,
        &Variable {
            name: x,
            sample: None,
        },
        scope,
    )? {
        Some(f) => fraction_zeros(&f, scope.bits, out),
        None => Ok(()),
    }
}

fn fraction_zeros(f: &Fraction, bits: u64, out: &mut Vec<Interval>) -> Result<(), Unknown> {
    out.extend(f.poles.keys().cloned().map(Interval::exact));
    match f.numerator.coefficients() {
        [] => {}
        [constant, slope] => {
            let Some(inverse) = slope.reciprocal(bits) else {
                return unknown("a slope that may be zero at these bits");
            };
            out.push(constant.negated().times(&inverse, bits));
        }
        _ => {
            let (_, roots) = linear_factors(&f.numerator, bits)?;
            out.extend(roots.into_keys().map(Interval::exact));
        }
    }
    Ok(())
}

fn difference(
    a: &Formula,
    b: Option<&Formula>,
    variable: &Variable,
    scope: &Scope,
) -> Result<Option<Fraction>, Unknown> {
    let a = fraction(a, variable, scope)?;
    let Some(b) = b else { return Ok(a) };
    match (a, fraction(b, variable, scope)?) {
        (Some(a), Some(b)) => Ok(Some(a.plus(&b.negated(), scope.bits)?)),
        _ => Ok(None),
    }
}

/// The formula as a fraction of the variable; `None` where it has no value on the whole piece.
///
/// # Errors
/// A formula that is no fraction of the kind.
pub(super) fn fraction(
    f: &Formula,
    x: &Variable,
    scope: &Scope,
) -> Result<Option<Fraction>, Unknown> {
    scope.spend(1)?;
    if !scope.depends(f, x.name) {
        return match value_in(f, scope)? {
            Value::Undefined => Ok(None),
            Value::Finite { low, high } => {
                Ok(Some(Fraction::constant(Interval::between(low, high))))
            }
            _ => unknown("an infinity inside an integral"),
        };
    }
    match f {
        Formula::Name(_) => Ok(Some(Fraction::variable())),
        Formula::Negate(a) => Ok(fraction(a, x, scope)?.map(|a| a.negated())),
        Formula::Binary(operator, a, b) => binary(*operator, a, b, x, scope),
        Formula::Apply(name, parts) => match parts.as_slice() {
            [inner] => {
                let function = calculus::polynomial_of(name, scope)?;
                composed(&function, inner, x, scope)
            }
            _ => unknown("a function of several arguments"),
        },
        Formula::Call(function, parts) => call(*function, parts, x, scope),
        Formula::Indicator(c) => {
            let holds = truth_at(c, x, scope)?;
            Ok(Some(Fraction::constant(Interval::integer(holds.into()))))
        }
        Formula::If(c, a, b) => {
            let chosen = if truth_at(c, x, scope)? { a } else { b };
            fraction(chosen, x, scope)
        }
        Formula::Ranged(r) => ranged(r, x, scope),
        // What is derived must have values itself; that its rule has none proves nothing.
        Formula::Derivative(a, name, order) => match fraction(a, x, scope)? {
            Some(_) => match fraction(&calculus::derived(a, name, order, scope)?, x, scope)? {
                Some(f) => Ok(Some(f)),
                None => unknown("a derivative whose rule has no value here"),
            },
            None => Ok(None),
        },
        Formula::At(a, places) => match places.as_slice() {
            [(name, place)] if !scope.depends(a, x.name) || name == x.name => {
                let inner = Variable { name, sample: None };
                match fraction(a, &inner, &scope.with(name, Binding::Variable))? {
                    Some(outer) => composed(polynomial(&outer)?, place, x, scope),
                    None => Ok(None),
                }
            }
            _ => unknown("a substitution inside an integral"),
        },
        Formula::Density(drawn, at) => density(drawn, at, x, scope, false),
        Formula::Cumulative(drawn, at) => density(drawn, at, x, scope, true),
        _ => unknown("an integrand that is no rational function of its variable"),
    }
}

fn polynomial(f: &Fraction) -> Result<&Polynomial, Unknown> {
    match f.as_polynomial() {
        Some(polynomial) => Ok(polynomial),
        None => unknown("a pole where the kernel needs a polynomial"),
    }
}

/// outer(inner(x)) by Horner's rule on fractions.
fn composed(
    outer: &Polynomial,
    inner: &Formula,
    x: &Variable,
    scope: &Scope,
) -> Result<Option<Fraction>, Unknown> {
    let Some(inner) = fraction(inner, x, scope)? else {
        return Ok(None);
    };
    let mut sum = Fraction::constant(Interval::integer(0));
    for c in outer.coefficients().iter().rev() {
        sum = sum
            .times(&inner, scope.bits)?
            .plus(&Fraction::constant(c.clone()), scope.bits)?;
    }
    Ok(Some(sum))
}

fn binary(
    operator: Operator,
    a: &Formula,
    b: &Formula,
    x: &Variable,
    scope: &Scope,
) -> Result<Option<Fraction>, Unknown> {
    if operator == Operator::Power {
        return power(a, b, false, x, scope);
    }
    let left = fraction(a, x, scope)?;
    let right = match operator {
        Operator::Divide => reciprocal(b, x, scope)?,
        Operator::Subtract => fraction(b, x, scope)?.map(|b| b.negated()),
        _ => fraction(b, x, scope)?,
    };
    let (Some(left), Some(right)) = (left, right) else {
        return Ok(None);
    };
    scope.spend((left.numerator.length() * right.numerator.length()) as u64)?;
    match operator {
        Operator::Add | Operator::Subtract => left.plus(&right, scope.bits).map(Some),
        _ => left.times(&right, scope.bits).map(Some),
    }
}

/// 1/f, factor by factor, so that each factor is split into linear ones by itself.
fn reciprocal(f: &Formula, x: &Variable, scope: &Scope) -> Result<Option<Fraction>, Unknown> {
    match f {
        Formula::Binary(Operator::Multiply, a, b) => {
            match (reciprocal(a, x, scope)?, reciprocal(b, x, scope)?) {
                (Some(a), Some(b)) => a.times(&b, scope.bits).map(Some),
                _ => Ok(None),
            }
        }
        Formula::Binary(Operator::Power, base, exponent) => power(base, exponent, true, x, scope),
        _ => match fraction(f, x, scope)? {
            Some(f) => f.reciprocal(scope.bits),
            None => Ok(None),
        },
    }
}

/// base^n, or 1/base^n, for an integer n that does not depend on the variable.
fn power(
    base: &Formula,
    exponent: &Formula,
    inverted: bool,
    x: &Variable,
    scope: &Scope,
) -> Result<Option<Fraction>, Unknown> {
    if scope.depends(exponent, x.name) {
        return unknown("an exponent that depends on the integral's variable");
    }
    let exponent = match value_in(exponent, scope)? {
        Value::Undefined => return Ok(None),
        value => value.finite(),
    };
    let integer = exponent.as_ref().and_then(|e| e.as_integer());
    let Some(n) = integer.and_then(|n| n.to_i32()) else {
        return unknown("a power inside an integral that is no integer power");
    };
    let Some(upright) = fraction(base, x, scope)? else {
        return Ok(None);
    };
    let mut factor = upright.clone();
    if n < 0 || (inverted && n > 0) {
        // Without a reciprocal there is no value, even where two of them would undo each other.
        let Some(inverse) = reciprocal(base, x, scope)? else {
            return Ok(None);
        };
        factor = if inverted && n < 0 { upright } else { inverse };
    }
    let steps = u64::from(n.unsigned_abs()) * factor.numerator.length() as u64;
    scope.spend(steps.saturating_mul(steps))?;
    factor.power(n.unsigned_abs(), scope.bits).map(Some)
}

/// abs, min and max, decided at the sample: their cuts are ends of the piece.
fn call(
    function: Function,
    parts: &[Formula],
    x: &Variable,
    scope: &Scope,
) -> Result<Option<Fraction>, Unknown> {
    match (function, parts) {
        (Function::Abs, [a]) => {
            let sign = sign_at(a, None, x, scope)?;
            let inner = fraction(a, x, scope)?;
            Ok(inner.map(|f| if sign.is_lt() { f.negated() } else { f }))
        }
        (Function::Min | Function::Max, [first, rest @ ..]) => {
            let mut chosen = first;
            for other in rest {
                let less = sign_at(other, Some(chosen), x, scope)?.is_lt();
                if less == (function == Function::Min) {
                    chosen = other;
                }
            }
            fraction(chosen, x, scope)
        }
        _ => unknown("an integrand that is no rational function of its variable"),
    }
}

/// The sign of a - b at the sample.
fn sign_at(
    a: &Formula,
    b: Option<&Formula>,
    x: &Variable,
    scope: &Scope,
) -> Result<Ordering, Unknown> {
    let Some(sample) = &x.sample else {
        return unknown("a comparison of the variable inside another");
    };
    let f = difference(a, b, x, scope)?;
    let at = f.and_then(|f| f.at(&Interval::exact(sample.clone()), scope.bits));
    match at.and_then(|value| value.sign()) {
        Some(sign) => Ok(sign),
        None => unknown("a comparison in an integrand is not settled at these bits"),
    }
}

fn truth_at(condition: &Condition, x: &Variable, scope: &Scope) -> Result<bool, Unknown> {
    match condition {
        Condition::Chain(first, links) => {
            let mut left = first;
            for (relation, right) in links {
                let sign = sign_at(left, Some(right), x, scope)?;
                if !relation_allows(*relation, sign)? {
                    return Ok(false);
                }
                left = right;
            }
            Ok(true)
        }
        Condition::And(parts) => parts
            .iter()
            .try_fold(true, |all, part| Ok(all & truth_at(part, x, scope)?)),
        Condition::Or(parts) => parts
            .iter()
            .try_fold(false, |any, part| Ok(any | truth_at(part, x, scope)?)),
        Condition::Not(part) => Ok(!truth_at(part, x, scope)?),
    }
}

/// Whether a relation holds of two numbers, given how they compare.
pub(super) fn relation_allows(relation: Relation, ordering: Ordering) -> Result<bool, Unknown> {
    Ok(match relation {
        Relation::Equal => ordering.is_eq(),
        Relation::NotEqual => ordering.is_ne(),
        Relation::Less => ordering.is_lt(),
        Relation::LessEqual => ordering.is_le(),
        Relation::Greater => ordering.is_gt(),
        Relation::GreaterEqual => ordering.is_ge(),
        Relation::Asymptotic | Relation::Approximate => {
            return unknown("an asymptotic relation inside a condition");
        }
    })
}

/// A sum over an integer range term by term, and an inner integral whose ends depend on the
/// variable: A(to) - A(from) for a polynomial antiderivative A.
fn ranged(r: &Ranged, x: &Variable, scope: &Scope) -> Result<Option<Fraction>, Unknown> {
    match r.kind {
        RangeKind::Sum => {
            let mut sum = Some(Fraction::constant(Interval::integer(0)));
            sums::each(r, scope, |inner| {
                sum = match (sum.take(), fraction(&r.body, x, inner)?) {
                    (Some(sum), Some(term)) => Some(sum.plus(&term, scope.bits)?),
                    _ => None,
                };
                Ok(())
            })?;
            Ok(sum)
        }
        RangeKind::Integral if r.name == *x.name || !scope.depends(&r.body, x.name) => {
            let inner = Variable {
                name: &r.name,
                sample: None,
            };
            let body = fraction(&r.body, &inner, &scope.with(&r.name, Binding::Variable))?;
            let Some(body) = body else { return Ok(None) };
            let whole = polynomial(&body)?.antiderivative(scope.bits);
            match (
                composed(&whole, &r.to, x, scope)?,
                composed(&whole, &r.from, x, scope)?,
            ) {
                (Some(to), Some(from)) => to.plus(&from.negated(), scope.bits).map(Some),
                _ => Ok(None),
            }
        }
        _ => unknown("a nested integral, supremum or infimum"),
    }
}

/// The density of a draw at a place, or its integral up to there.
fn density(
    drawn: &Formula,
    at: &Formula,
    x: &Variable,
    scope: &Scope,
    cumulative: bool,
) -> Result<Option<Fraction>, Unknown> {
    let Some(weight) = law::of_draw(drawn, scope)? else {
        return Ok(None);
    };
    let (Some(sample), Some(place)) = (&x.sample, fraction(at, x, scope)?) else {
        return unknown("a density inside a comparison");
    };
    let Some(place) = place.at(&Interval::exact(sample.clone()), scope.bits) else {
        return unknown("a density at a pole");
    };
    let constant = |n| Ok(Some(Fraction::constant(Interval::integer(n))));
    match (weight.from.compare(&place), place.compare(&weight.to)) {
        (Some(Ordering::Greater), _) => constant(0),
        (_, Some(Ordering::Greater)) => constant(cumulative.into()),
        (Some(Ordering::Less), Some(Ordering::Less)) if cumulative => {
            composed(&weight.cumulative(scope.bits), at, x, scope)
        }
        (Some(Ordering::Less), Some(Ordering::Less)) => composed(&weight.density, at, x, scope),
        _ => unknown("a density at an end of its support"),
    }
}
