//! Integrals and means without an exact form, by Taylor's formula with Lagrange's remainder on pieces that
//! are halved until the remainder is small enough:
//!
//! ```text
//! int(f, x = a..b) = sum over k < n of c_k ((b-m)^(k+1) - (a-m)^(k+1))/(k+1)
//!                    + c (b-a)-moment of order n,   c in f^(n)([a, b])/n!,  n even
//! ```
//!
//! where c_k are the Taylor coefficients at the middle m. All of it is in interval arithmetic; samples serve
//! to choose the accuracy only. Ends where the integrand is not analytic are the business of [`ends`].
//!
//! An integrand that certainly has no value on a whole piece has no integral. One that diverges at an end
//! by a proved leading term is infinite where it is of one sign everywhere. What resists halving is
//! [`Failure::Undecided`].

use super::enclose::Enclosure;
use super::ends::{self, Behaviour, End};
use super::integrand::{Splitter, Tree};
use super::jet::Jets;
use super::line::Place;
use super::scope::Scope;
use super::{Failure, Outcome, unsupported};
use crate::number::{DomainError, Interval};
use rug::{Float, Rational};
use std::cmp::Ordering;

use Outcome::{MinusInfinity, PlusInfinity, Undefined, Value};

/// How often a piece is halved, and how many pieces there may be.
const MAX_DEPTH: u32 = 100;
const MAX_PIECES: u32 = 20_000;

/// Pieces on which the sign of a divergent integrand is looked for.
const MAX_SIGNS: u32 = 2_000;

/// Zeros of factors at an end are followed up to this order when signs are asked for.
const MAX_ZERO: usize = 8;

/// Bits in which remainders are found.
const ROUGH: u32 = 64;

/// Bits above the precision asked for.
pub(super) const GUARD: u32 = 64;

/// A piece of the range, and which of the ends it touches.
struct Piece {
    from: Interval,
    to: Interval,
    touches: [bool; 2],
    depth: u32,
}

/// An integral on its way.
struct Quadrature<'q, 'a> {
    tree: &'q Tree,
    scope: &'q Scope<'a>,
    ends: [Option<End>; 2],
    order: usize,
    precision: u32,
    tolerance: Float,
    range: (Interval, Interval),
}

/// The integral over `from < to`.
pub(super) fn over(
    tree: &Tree,
    from: Place,
    to: Place,
    scope: &Scope,
    precision: u32,
) -> Enclosure {
    let working = precision.saturating_add(GUARD);
    let splitter = Splitter {
        ends: [from.rational.clone(), to.rational.clone()],
        budget: scope.budget(),
        precision: working,
    };
    let quadrature = Quadrature {
        tree,
        scope,
        ends: ends::find(tree, &splitter)?,
        order: 2 * (precision as usize / 6) + 8,
        precision: working,
        tolerance: tolerance(tree, &from.interval, &to.interval, precision),
        range: (from.interval, to.interval),
    };
    quadrature.run()
}

/// Values at places inside the range, where they can be had.
fn samples(tree: &Tree, from: &Interval, to: &Interval) -> impl Iterator<Item = Interval> {
    let jets = Jets {
        order: 0,
        precision: ROUGH,
    };
    let length = to.sub(from);
    (1..16).filter_map(move |k| {
        let part = Interval::from_rational(&Rational::from((k, 16)), ROUGH);
        let place = from.add(&length.mul(&part)).midpoint();
        let place = Interval::from_ends(place.clone(), place);
        let inside = from.is_below(&place) && place.is_below(to);
        inside.then(|| tree.jet(&place, jets).ok()?.into_iter().next())?
    })
}

/// A remainder that does not matter: 2^-precision of the largest sample times the length. It proves nothing.
pub(super) fn tolerance(tree: &Tree, from: &Interval, to: &Interval, precision: u32) -> Float {
    let length = to.sub(from);
    let mut largest = Float::new(ROUGH);
    for value in samples(tree, from, to) {
        let size = value.abs().high().clone();
        if size.is_finite() && size > largest {
            largest = size;
        }
    }
    if largest.is_zero() {
        largest = Float::with_val(ROUGH, 1);
    }
    let scale = Interval::from_ends(largest.clone(), largest).mul(&length);
    let bits = Interval::from_i64(2, ROUGH).powi(-i64::from(precision));
    match bits {
        Ok(bits) => scale.mul(&bits).midpoint(),
        Err(_) => Float::new(ROUGH),
    }
}

impl Quadrature<'_, '_> {
    fn run(&self) -> Enclosure {
        let mut sum = Interval::from_i64(0, self.precision);
        let mut stack = vec![self.whole()];
        let mut pieces = 0;
        while let Some(piece) = stack.pop() {
            pieces += 1;
            if pieces > MAX_PIECES {
                return Err(Failure::TooLarge("the pieces of an integral".into()));
            }
            match self.piece(&piece)? {
                Some(Value(part)) => sum = sum.add(&part),
                Some(PlusInfinity) => return self.divergent(Ordering::Greater),
                Some(MinusInfinity) => return self.divergent(Ordering::Less),
                Some(Undefined) => return Ok(Undefined),
                None => match self.halves(&piece) {
                    Ok(halves) => stack.extend(halves),
                    Err(_) if stack.iter().any(|rest| self.has_no_value(rest)) => {
                        return Ok(Undefined);
                    }
                    Err(failure) => return Err(failure),
                },
            }
        }
        Ok(Value(sum))
    }

    /// Whether the integrand certainly has no value anywhere on a half of the piece: the whole may
    /// touch a place where it has one.
    fn has_no_value(&self, piece: &Piece) -> bool {
        let jets = Jets {
            order: 0,
            precision: ROUGH,
        };
        self.halves(piece).is_ok_and(|halves| {
            halves.iter().any(|half| {
                let range = half.from.hull(&half.to).with_precision(ROUGH);
                self.tree.jet(&range, jets) == Err(DomainError::Certain)
            })
        })
    }

    fn halves(&self, piece: &Piece) -> Result<[Piece; 2], Failure> {
        let middle = piece.from.hull(&piece.to).midpoint();
        let middle = Interval::from_ends(middle.clone(), middle);
        let between = piece.from.is_below(&middle) && middle.is_below(&piece.to);
        if piece.depth >= MAX_DEPTH || !between {
            // More bits do not help where halving does not.
            return Err(Failure::TooLarge(
                "the pieces of an integral whose integrand is not seen to be smooth".into(),
            ));
        }
        let depth = piece.depth + 1;
        let upper = Piece {
            from: middle.clone(),
            to: piece.to.clone(),
            touches: [false, piece.touches[1]],
            depth,
        };
        let lower = Piece {
            from: piece.from.clone(),
            to: middle,
            touches: [piece.touches[0], false],
            depth,
        };
        // The last is next: an end that no halving helps is met before the work inside is done.
        Ok(if piece.touches[1] {
            [lower, upper]
        } else {
            [upper, lower]
        })
    }

    /// The integral over a piece; `None` where it is to be halved, `Undefined` where the integrand
    /// has no value anywhere on it.
    fn piece(&self, piece: &Piece) -> Result<Option<Outcome<Interval>>, Failure> {
        let at = [0, 1].map(|side| self.ends[side].as_ref().filter(|_| piece.touches[side]));
        match at {
            [Some(_), Some(_)] => Ok(None),
            [Some(end), None] => self.at_end(end, &piece.to),
            [None, Some(end)] => self.at_end(end, &piece.from),
            [None, None] => self.inside(piece),
        }
    }

    fn whole(&self) -> Piece {
        Piece {
            from: self.range.0.clone(),
            to: self.range.1.clone(),
            touches: [true, true],
            depth: 0,
        }
    }

    /// What an integral is that diverges at an end with this sign: infinite where the integrand has
    /// that sign everywhere, without value where it has the other one somewhere.
    fn divergent(&self, sign: Ordering) -> Enclosure {
        let opposite = |value: Interval| value.sign() == Some(sign.reverse());
        if samples(self.tree, &self.range.0, &self.range.1).any(opposite) {
            return Ok(Undefined);
        }
        let mut stack = vec![self.whole()];
        let mut pieces = 0;
        while let Some(piece) = stack.pop() {
            self.scope.spend(self.tree.size())?;
            pieces += 1;
            match self.sign(&piece, sign) {
                Some(found) if found == sign || found == Ordering::Equal => {}
                Some(_) => return Ok(Undefined),
                None if pieces > MAX_SIGNS => {
                    return Err(unsupported("a divergent integral of unknown sign"));
                }
                None => stack.extend(self.halves(&piece)?),
            }
        }
        Ok(match sign {
            Ordering::Less => MinusInfinity,
            _ => PlusInfinity,
        })
    }

    /// The sign that the integrand has on all of the piece; the wanted one also where it may be 0.
    fn sign(&self, piece: &Piece, wanted: Ordering) -> Option<Ordering> {
        let at = [0, 1].map(|side| self.ends[side].as_ref().filter(|_| piece.touches[side]));
        match at {
            [Some(_), Some(_)] => None,
            [Some(end), None] => end.sign(&piece.to, MAX_ZERO),
            [None, Some(end)] => end.sign(&piece.from, MAX_ZERO),
            [None, None] => {
                let jets = Jets {
                    order: 0,
                    precision: ROUGH,
                };
                let range = piece.from.hull(&piece.to).with_precision(ROUGH);
                let jet = self.tree.jet(&range, jets).ok()?;
                let value = jet.first()?;
                let weakly = match wanted {
                    Ordering::Less => *value.high() <= 0,
                    _ => *value.low() >= 0,
                };
                value.sign().or_else(|| weakly.then_some(wanted))
            }
        }
    }

    fn spend(&self, size: u64, precision: u32) -> Result<(), Failure> {
        let products = (self.order as u64).saturating_pow(2) / 4;
        let words = 1 + u64::from(precision) / 256;
        self.scope
            .spend(size.saturating_mul(products).saturating_mul(words))
    }

    fn at_end(&self, end: &End, cut: &Interval) -> Result<Option<Outcome<Interval>>, Failure> {
        for precision in [ROUGH, self.precision] {
            self.spend(end.size().saturating_mul(2), precision)?;
            match end.piece(cut, self.order, precision)? {
                None => return Ok(None),
                Some(Behaviour::Diverges(Ordering::Less)) => return Ok(Some(MinusInfinity)),
                Some(Behaviour::Diverges(_)) => return Ok(Some(PlusInfinity)),
                Some(Behaviour::Integral { rest, .. }) if rest.width() > self.tolerance => {
                    return Ok(None);
                }
                Some(Behaviour::Integral { main, rest }) => {
                    if precision == self.precision {
                        return Ok(Some(Value(main.add(&rest))));
                    }
                }
            }
        }
        Ok(None)
    }

    fn inside(&self, piece: &Piece) -> Result<Option<Outcome<Interval>>, Failure> {
        let range = piece.from.hull(&piece.to);
        let middle = range.midpoint();
        let middle = Interval::from_ends(middle.clone(), middle);
        self.spend(self.tree.size(), ROUGH)?;
        let jets = Jets {
            order: self.order,
            precision: ROUGH,
        };
        let rest = match self.tree.jet(&range.with_precision(ROUGH), jets) {
            Ok(jet) => self.rest(jet.get(self.order), piece, &middle),
            Err(DomainError::Certain) => return Ok(Some(Undefined)),
            Err(DomainError::Possible) => return Ok(None),
        };
        let Some(rest) = rest.filter(|rest| rest.width() <= self.tolerance) else {
            return Ok(None);
        };
        self.spend(self.tree.size(), self.precision)?;
        let jets = Jets {
            order: self.order,
            precision: self.precision,
        };
        let Ok(jet) = self.tree.jet(&middle, jets) else {
            return Ok(None);
        };
        let (above, below) = (piece.to.sub(&middle), piece.from.sub(&middle));
        let (mut up, mut down) = (above.clone(), below.clone());
        let mut sum = rest;
        for (coefficient, k) in jet.iter().zip(1..).take(self.order) {
            let Ok(moment) = up.sub(&down).div(&Interval::from_i64(k, self.precision)) else {
                return Ok(None);
            };
            sum = sum.add(&coefficient.mul(&moment));
            up = up.mul(&above);
            down = down.mul(&below);
        }
        Ok(Some(Value(sum)))
    }

    /// The remainder's integral; the order is even, so that (x-m)^n is nowhere negative.
    fn rest(&self, last: Option<&Interval>, piece: &Piece, middle: &Interval) -> Option<Interval> {
        let zero = Interval::from_i64(0, ROUGH);
        let Some(last) = last else { return Some(zero) };
        let power = i64::try_from(self.order + 1).ok()?;
        let far = |end: &Interval| end.sub(middle).with_precision(ROUGH).powi(power).ok();
        let moment = far(&piece.to)?.sub(&far(&piece.from)?);
        let moment = moment.div(&Interval::from_i64(power, ROUGH)).ok()?;
        Some(last.mul(&moment))
    }
}
