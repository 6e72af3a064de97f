//! The exact value of a formula: an [`Exact`] in logarithms, roots and powers of sqrt(pi).
//!
//! Under an integral or a mean the variable of integration is a symbol, and the same walk over the tree
//! gives a rational function of it (`quantity`), which is then integrated term by term. What has no
//! closed form here is [`Failure::Unsupported`].

use super::closed::order;
use super::integrate::{self, Bound};
use super::law::{self, Weight};
use super::outcome;
use super::pieces::{self, Piece};
use super::quantity::{Quantity, Separable, Symbol};
use super::scope::{Binding, Root, Scope};
use super::sign::{self, Sign};
use super::{Context, Failure, Outcome, condition, functions, limit, undecided, unsupported};
use crate::formula::{Condition, Draw, Formula, Function, Name, Operator, Part, RangeKind, Ranged};
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

fn number(value: Rational) -> Evaluation {
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
        Formula::Ranged(ranged) => self::ranged(ranged, scope),
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

fn negate(outcome: Outcome<Quantity>, scope: &Scope) -> Evaluation {
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

fn more_extreme(
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

fn derivative(body: &Formula, name: &Name, times: &Formula, scope: &Scope) -> Evaluation {
    let times = match value(times, scope)? {
        Value(times) => times.closed("an order of a derivative")?.as_rational(),
        _ => None,
    };
    let times = times
        .filter(|n| *n.denom() == 1)
        .and_then(|n| n.numer().to_u32());
    let times = times.ok_or_else(|| unsupported("a derivative of this order"))?;
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

fn ranged(ranged: &Ranged, scope: &Scope) -> Evaluation {
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
            let body = value(&ranged.body, &link.scope())?;
            body.finite("an integrand", |_| number(Rational::new()))
        }
    }
}

fn unsampled(symbol: Symbol, draw: bool) -> Binding {
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

fn sampled_at(symbol: Symbol, piece: &Piece, draw: bool) -> Binding {
    Binding::Symbol {
        symbol,
        sample: Some(piece.sample.clone()),
        draw,
    }
}

/// The sum of the pieces' integrals. A divergent piece makes the whole infinite only if all pieces have
/// its sign.
fn add_pieces(
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

/// The body of a mean with its draws as symbols.
struct Body<'b> {
    part: Part<'b>,
    draws: &'b [&'b Draw],
    symbols: &'b [Symbol],
}

/// Evaluates something under the draws that occur free in it.
fn over_draws(
    part: Part,
    own: &Option<Box<Draw>>,
    scope: &Scope,
    f: fn(&Body, &Scope) -> Evaluation,
) -> Evaluation {
    let names = part.free_names();
    let draws: Vec<&Draw> = match own {
        Some(draw) => vec![draw],
        None => scope.draws_among(&names)?,
    };
    let symbols: Vec<Symbol> = draws.iter().map(|_| scope.new_symbol()).collect();
    let body = Body {
        part,
        draws: &draws,
        symbols: &symbols,
    };
    f(&body, scope)
}

impl Body<'_> {
    /// The value with the draws as symbols; with a piece, its sample is taken for the only draw.
    fn value(&self, piece: Option<&Piece>, scope: &Scope) -> Evaluation {
        self.under(0, piece, scope)
    }

    fn under(&self, depth: usize, piece: Option<&Piece>, scope: &Scope) -> Evaluation {
        match (self.draws.get(depth), self.symbols.get(depth)) {
            (Some(draw), Some(symbol)) => {
                let binding = match piece {
                    Some(piece) => sampled_at(*symbol, piece, true),
                    None => unsampled(*symbol, true),
                };
                let link = scope.bind(&draw.name, binding);
                self.under(depth + 1, piece, &link.scope())
            }
            _ => match self.part {
                Part::Formula(formula) => value(formula, scope),
                Part::Condition(truth) => {
                    number(Rational::from(u32::from(condition::within(truth, scope)?)))
                }
                Part::Law(_) => Err(unsupported("the mean of a law")),
            },
        }
    }

    fn weights(&self, scope: &Scope) -> Result<Outcome<Vec<Weight>>, Failure> {
        let mut weights = vec![];
        for draw in self.draws {
            match law::weight(&draw.law, scope)? {
                Value(weight) => weights.push(weight),
                _ => return Ok(Undefined),
            }
        }
        Ok(Value(weights))
    }

    /// The body on each piece of the support of the only draw; `None` when it is not piecewise.
    fn pieces(&self, weights: &[Weight], scope: &Scope) -> Result<Option<Vec<Piece>>, Failure> {
        let [draw] = self.draws else {
            let piecewise = pieces::has_conditions(self.part);
            return if piecewise && !self.draws.is_empty() {
                Err(unsupported("a piecewise function of several draws"))
            } else {
                Ok(None)
            };
        };
        let link = scope.bind(&draw.name, unsampled(self.symbols[0], true));
        let (from, to) = (weights[0].from(), weights[0].to());
        pieces::of(self.part, &link.scope(), self.symbols[0], &from, &to)
    }

    /// The mean of `f` of the body.
    fn mean(&self, scope: &Scope, f: impl Fn(Quantity) -> Evaluation) -> Evaluation {
        let Value(weights) = self.weights(scope)? else {
            return Ok(Undefined);
        };
        let Some(pieces) = self.pieces(&weights, scope)? else {
            return self.value(None, scope)?.finite("a mean", |body| {
                f(body)?.finite("a mean", |body| {
                    self.mean_of_function(body, &weights, scope)
                })
            });
        };
        let mut parts = vec![];
        for piece in pieces {
            match self.value(Some(&piece), scope)? {
                Value(body) => match f(body)? {
                    Value(body) => parts.push((body.open(), piece)),
                    other => return other.finite("a mean", |_| Ok(Undefined)),
                },
                Undefined => return Ok(Undefined),
                _ => return Err(unsupported("the mean of something infinite")),
            }
        }
        let (weight, symbol, budget) = (&weights[0], self.symbols[0], scope.budget());
        add_pieces(&parts, symbol, scope, |function, piece| {
            integrate::map_terms(function, symbol, budget, |factor| {
                weight.mean_between(factor, &piece.from, &piece.to, budget)
            })
        })
    }

    /// The mean over all draws, one after the other: they are independent.
    fn mean_of_function(&self, body: Quantity, weights: &[Weight], scope: &Scope) -> Evaluation {
        let budget = scope.budget();
        let mut total = Value(body);
        for (symbol, weight) in self.symbols.iter().zip(weights) {
            total = total.finite("a mean over several draws", |body| {
                if matches!(&body, Quantity::Open(f) if f.mentions(*symbol)) {
                    integrate::map_terms(&body.open(), *symbol, budget, |f| weight.mean(f, budget))
                } else {
                    Ok(Value(body))
                }
            })?;
        }
        Ok(total)
    }
}

fn mean_of(body: &Body, scope: &Scope) -> Evaluation {
    body.mean(scope, |body| Ok(Value(body)))
}

/// E[X^2] - E[X]^2; no value where the mean is not finite, infinite where only E[X^2] is.
fn variance_of(body: &Body, scope: &Scope) -> Evaluation {
    let budget = scope.budget();
    let mean = match mean_of(body, scope)? {
        Value(mean) => mean,
        _ => return Ok(Undefined),
    };
    let square = body.mean(scope, |body| body.power(2, budget))?;
    let minus = mean.power(2, budget)?.map(|square| square);
    let minus = negate(minus, scope)?;
    outcome::add(square, minus, |a, b| Ok(Value(a.add(b, budget)?)))
}

/// `density(X, x)` or `cdf(X, x)`.
fn at_draw(quantity: &Formula, x: &Formula, cumulative: bool, scope: &Scope) -> Evaluation {
    if let Some(draw) = law::named_draw(quantity, scope)? {
        return match value(x, scope)? {
            Value(x) => law::at_place(draw, x, cumulative, scope),
            Undefined => Ok(Undefined),
            PlusInfinity if cumulative => number(Rational::from(1)),
            _ => number(Rational::new()),
        };
    }
    if !cumulative {
        return Err(unsupported("the density of a function of draws"));
    }
    let below = Condition::Chain(
        quantity.clone(),
        vec![(crate::formula::Relation::LessEqual, x.clone())],
    );
    let names = Part::Formula(quantity).free_names();
    let draws = scope.draws_among(&names)?;
    let shadowed = Part::Formula(x)
        .free_names()
        .iter()
        .any(|n| draws.iter().any(|d| d.name == *n));
    if shadowed {
        return Err(unsupported("a place that is named like a draw"));
    }
    over_draws(Part::Condition(&below), &None, scope, mean_of)
}
