//! Integrals and means without an exact form: what is to be integrated over which range, infinite ones
//! among them. Those are cut off where the rest is proved small ([`tail`]), else folded onto [0, 1] by
//!
//! ```text
//! x = A + u/(1-u),   dx = du/(1-u)^2.
//! ```

use super::enclose::{self, Enclosure};
use super::integrand::{Node, Reader, Tree, number, power, product};
use super::law::{self, Weight};
use super::quadrature::{GUARD, over, tolerance};
use super::scope::Scope;
use super::{Failure, Outcome, exact, integrate, outcome, tail, undecided, unsupported};
use crate::formula::{Draw, Formula, Part, Ranged};
use crate::number::Interval;
use crate::special;
use rug::Rational;
use std::rc::Rc;

use Outcome::{MinusInfinity, PlusInfinity, Undefined, Value};

/// Infinite ranges are cut off below this place.
const LAST_CUT: u32 = 1 << 20;

/// A finite bound.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub interval: Interval,
    pub rational: Option<Rational>,
}

impl Place {
    pub fn rational(value: Rational, precision: u32) -> Place {
        Place {
            interval: Interval::from_rational(&value, precision),
            rational: Some(value),
        }
    }
}

/// A bound.
#[derive(Clone, Debug)]
enum Bound {
    Finite(Place),
    PlusInfinity,
    MinusInfinity,
}

/// `int(e, x = a..b)`
pub(super) fn integral(ranged: &Ranged, scope: &Scope, precision: u32) -> Enclosure {
    let working = precision.saturating_add(GUARD);
    let (Some(from), Some(to)) = (
        bound(&ranged.from, scope, working)?,
        bound(&ranged.to, scope, working)?,
    ) else {
        return Ok(Undefined);
    };
    let read = |variable: Tree| {
        let reader = Reader {
            scope,
            names: &[(&ranged.name, variable)],
            precision: working,
        };
        reader.read(&ranged.body)
    };
    let line = Line {
        read: &read,
        scope,
        precision,
    };
    line.between(from, to)
}

/// A bound, exactly where that can be had; `None` where it has no value.
fn bound(formula: &Formula, scope: &Scope, precision: u32) -> Result<Option<Bound>, Failure> {
    let place = match exact::closed(formula, scope) {
        Ok(outcome) => outcome.map(|value| Place {
            interval: value.enclose(precision),
            rational: value.as_rational(),
        }),
        Err(Failure::Exhausted) => return Err(Failure::Exhausted),
        Err(_) => enclose::within(formula, scope, precision)?.map(|interval| Place {
            interval,
            rational: None,
        }),
    };
    Ok(match place {
        Value(place) => Some(Bound::Finite(place)),
        PlusInfinity => Some(Bound::PlusInfinity),
        MinusInfinity => Some(Bound::MinusInfinity),
        Undefined => None,
    })
}

/// An integrand on the line.
struct Line<'l, 'a> {
    /// The integrand with a tree put for its variable.
    read: &'l dyn Fn(Tree) -> Result<Outcome<Tree>, Failure>,
    scope: &'l Scope<'a>,
    precision: u32,
}

impl Line<'_, '_> {
    fn between(&self, from: Bound, to: Bound) -> Enclosure {
        let variable = Rc::new(Node::Variable);
        match (from, to) {
            (Bound::Finite(a), Bound::Finite(b)) => self.finite(a, b),
            (Bound::Finite(a), Bound::PlusInfinity) => self.onwards(&variable, a),
            (Bound::PlusInfinity, Bound::Finite(a)) => {
                Ok(self.onwards(&variable, a)?.negate(|value| value.neg()))
            }
            (Bound::MinusInfinity, Bound::Finite(b)) => self.backwards(b),
            (Bound::Finite(b), Bound::MinusInfinity) => {
                Ok(self.backwards(b)?.negate(|value| value.neg()))
            }
            (Bound::MinusInfinity, Bound::PlusInfinity) => self.everywhere(),
            (Bound::PlusInfinity, Bound::MinusInfinity) => {
                Ok(self.everywhere()?.negate(|value| value.neg()))
            }
            _ => Err(unsupported("an integral from infinity to itself")),
        }
    }

    fn finite(&self, a: Place, b: Place) -> Enclosure {
        let Value(tree) = (self.read)(Rc::new(Node::Variable))? else {
            return Ok(Undefined);
        };
        if a.interval.is_below(&b.interval) {
            over(&tree, a, b, self.scope, self.precision)
        } else if b.interval.is_below(&a.interval) {
            let reversed = over(&tree, b, a, self.scope, self.precision)?;
            Ok(reversed.negate(|value| value.neg()))
        } else {
            Err(undecided("whether a range of integration is empty"))
        }
    }

    /// From -inf to b.
    fn backwards(&self, b: Place) -> Enclosure {
        let start = Place {
            interval: b.interval.neg(),
            rational: b.rational.map(|b| -b),
        };
        self.onwards(&Rc::new(Node::Negate(Rc::new(Node::Variable))), start)
    }

    /// Infinite halves of one sign, or a finite one and an infinite one, are not told apart from
    /// those that cancel: only a sum of two values is one.
    fn everywhere(&self) -> Enclosure {
        let zero = || Place::rational(Rational::new(), self.precision.saturating_add(GUARD));
        let below = self.backwards(zero())?;
        let above = self.onwards(&Rc::new(Node::Variable), zero())?;
        match (below, above) {
            (Value(a), Value(b)) => Ok(Value(a.add(&b))),
            (Undefined, _) | (_, Undefined) => Ok(Undefined),
            (PlusInfinity, PlusInfinity) => Ok(PlusInfinity),
            (MinusInfinity, MinusInfinity) => Ok(MinusInfinity),
            _ => Err(unsupported("an integral that diverges on one side")),
        }
    }

    /// From `start` to infinity of what the variable stands for.
    fn onwards(&self, variable: &Tree, start: Place) -> Enclosure {
        let Value(tree) = (self.read)(variable.clone())? else {
            return Ok(Undefined);
        };
        match self.cut(&tree, &start) {
            Some((place, rest)) => {
                let symmetric = rest.neg().hull(&rest);
                let main = over(&tree, start, place, self.scope, self.precision)?;
                Ok(main.map(|main| main.add(&symmetric)))
            }
            None => self.folded(variable, start),
        }
    }

    /// A place after which the rest does not matter, and a bound of the rest.
    fn cut(&self, tree: &Tree, start: &Place) -> Option<(Place, Interval)> {
        let working = self.precision.saturating_add(GUARD);
        let mut place = 2u32;
        while place < LAST_CUT {
            let end = Place::rational(Rational::from(place), working);
            if start.interval.is_below(&end.interval)
                && let Some(rest) = tail::bound(tree, place)
                && *rest.high() <= tolerance(tree, &start.interval, &end.interval, self.precision)
            {
                return Some((end, rest));
            }
            place = place.saturating_mul(5) / 4 + 1;
        }
        None
    }

    /// x = A + u/(1-u) for a rational A.
    fn folded(&self, variable: &Tree, start: Place) -> Enclosure {
        let Some(place) = start.rational else {
            return Err(unsupported("an infinite range from an irrational place"));
        };
        let u = Rc::new(Node::Variable);
        let rest = Rc::new(Node::Add(
            number(Rational::from(1)),
            Rc::new(Node::Negate(u.clone())),
        ));
        let quotient = Rc::new(Node::Divide(u, rest.clone()));
        let mut x = Rc::new(Node::Add(number(place), quotient));
        if matches!(&**variable, Node::Negate(_)) {
            x = Rc::new(Node::Negate(x));
        }
        let Value(tree) = (self.read)(x)? else {
            return Ok(Undefined);
        };
        let tree = product(&tree, &Rc::new(Node::Power(rest, -2)));
        let working = self.precision.saturating_add(GUARD);
        let ends = [0, 1].map(|end| Place::rational(Rational::from(end), working));
        let [zero, one] = ends;
        over(&tree, zero, one, self.scope, self.precision)
    }
}

/// A mean or a variance over one draw; `failure` is the answer where this method does not apply.
pub(super) fn mean(
    formula: &Formula,
    scope: &Scope,
    precision: u32,
    failure: Failure,
) -> Enclosure {
    let (body, own, variance) = match formula {
        Formula::Mean(body, own) => (body, own, false),
        Formula::Variance(body, own) => (body, own, true),
        _ => return Err(failure),
    };
    let draws: Vec<&Draw> = match own {
        Some(draw) => vec![draw],
        None => scope.draws_among(&Part::Formula(body).free_names())?,
    };
    let [draw] = draws[..] else {
        return Err(failure);
    };
    let Value(weight) = law::weight(&draw.law, scope)? else {
        return Ok(Undefined);
    };
    let reader = Reader {
        scope,
        names: &[(&draw.name, Rc::new(Node::Variable))],
        precision: precision.saturating_add(GUARD),
    };
    let Value(body) = reader.read(body)? else {
        return Ok(Undefined);
    };
    let mean = under(&body, &weight, scope, precision)?;
    match (variance, mean) {
        (false, mean) => Ok(mean),
        (true, Value(mean)) => {
            let square = Rc::new(Node::Power(body, 2));
            let minus = mean.square().neg();
            outcome::add(
                under(&square, &weight, scope, precision)?,
                Value(minus),
                |a, b| Ok(Value(a.add(&b))),
            )
        }
        // Without a finite mean there is no variance.
        (true, _) => Ok(Undefined),
    }
}

/// The mean of a tree under a law.
fn under(body: &Tree, weight: &Weight, scope: &Scope, precision: u32) -> Enclosure {
    let working = precision.saturating_add(GUARD);
    let density = density(weight, scope, working)?;
    let end = |bound: integrate::Bound| match bound {
        integrate::Bound::Finite(value) => Ok(Place {
            interval: value.enclose(working),
            rational: value.as_rational(),
        }),
        _ => Err(unsupported("a law on an unbounded range")),
    };
    let (from, to) = (end(weight.from())?, end(weight.to())?);
    over(&product(body, &density), from, to, scope, precision)
}

/// The density of a law: x^(a-1) (1-x)^(b-1)/B(a, b) for beta(a, b).
fn density(weight: &Weight, scope: &Scope, precision: u32) -> Result<Tree, Failure> {
    let Weight::Beta(a, b) = weight else {
        return Ok(Rc::new(Node::Fraction(weight.density(scope.budget())?)));
    };
    let x = Rc::new(Node::Variable);
    let rest = Rc::new(Node::Add(
        number(Rational::from(1)),
        Rc::new(Node::Negate(x.clone())),
    ));
    let less = |parameter: &Rational| Rational::from(parameter - 1u32);
    let left = Rc::new(power(x, &less(a), precision));
    let right = Rc::new(power(rest, &less(b), precision));
    let enclosed = |value| Interval::from_rational(value, precision);
    let scale = special::beta(&enclosed(a), &enclosed(b), precision)
        .and_then(|beta| Interval::from_i64(1, precision).div(&beta))
        .map_err(|_| unsupported("the density of a beta law"))?;
    Ok(product(
        &Rc::new(Node::Constant(scale)),
        &product(&left, &right),
    ))
}
