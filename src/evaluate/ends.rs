//! The piece of an integral that touches an end where the integrand is no power series, only a sum of
//! terms t^p ln(t)^i g(t), t the distance from the end. Each g is replaced by its Taylor polynomial, and
//!
//! ```text
//! int(t^a ln(t)^i, t = 0..d) = (d^(a+1) ln(d)^i - i int(t^a ln(t)^(i-1), t = 0..d))/(a+1),   a > -1
//! ```
//!
//! The weight t^a ln(t)^i has one sign for d <= 1, so that the remainder's integral lies in the range of
//! g's last coefficient times the weight's integral.

use super::integrand::{Node, Splitter, Term, Tree, number, power, product};
use super::jet::Jets;
use super::{Failure, undecided};
use crate::number::{DomainError, Interval};
use rug::Rational;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::rc::Rc;

/// How the integrand behaves at one end.
pub(super) struct End {
    /// 0 for the lower end.
    side: usize,
    place: Rational,
    /// Powers and logarithms of the distance, and the analytic factors.
    terms: Vec<(Rational, u32, Tree)>,
}

/// What is known of the integral near an end.
pub(super) enum Behaviour {
    /// An enclosure of the integral, and the part of it that is the remainder.
    Integral { main: Interval, rest: Interval },
    /// It diverges there, to plus or minus infinity: proved.
    Diverges(Ordering),
}

/// What the ends' pieces need, for the ends where jets alone do not do.
pub(super) fn find(tree: &Tree, splitter: &Splitter) -> Result<[Option<End>; 2], Failure> {
    let terms = splitter.split(tree)?;
    Ok([0, 1].map(|side| {
        let place = splitter.ends[side].clone()?;
        // Poles that cancel are seen by the terms only, not by the jets of the whole.
        let regular = terms.iter().all(|term| term.is_regular(side));
        if regular && has_value(tree, &place, splitter.precision) {
            return None;
        }
        let parts = terms.iter().map(|term| {
            let others = other_end(term, 1 - side, splitter);
            let rest = product(&others, &term.rest);
            (term.powers[side].clone(), term.logs[side], rest)
        });
        Some(End {
            side,
            terms: parts.collect(),
            place,
        })
    }))
}

fn has_value(tree: &Tree, place: &Rational, precision: u32) -> bool {
    let place = Interval::from_rational(place, precision);
    let jets = Jets {
        order: 1,
        precision,
    };
    tree.jet(&place, jets).is_ok()
}

/// The factors of a term that belong to the other end.
fn other_end(term: &Term, side: usize, splitter: &Splitter) -> Tree {
    let one = number(Rational::from(1));
    let Some(end) = &splitter.ends[side] else {
        return one;
    };
    let minus = number(Rational::from(-end));
    let mut distance = Rc::new(Node::Add(Rc::new(Node::Variable), minus));
    if side == 1 {
        distance = Rc::new(Node::Negate(distance));
    }
    let mut factor = one;
    if term.powers[side] != 0 {
        let weight = power(distance.clone(), &term.powers[side], splitter.precision);
        factor = product(&factor, &Rc::new(weight));
    }
    if term.logs[side] > 0 {
        let logarithm = Rc::new(Node::Ln(distance));
        let weight = Node::Power(logarithm, i64::from(term.logs[side]));
        factor = product(&factor, &Rc::new(weight));
    }
    factor
}

/// Coefficients of t^a ln(t)^i.
type Series = BTreeMap<(Rational, u32), Interval>;

impl End {
    /// How many operations a piece takes.
    pub fn size(&self) -> u64 {
        let sizes = self.terms.iter().map(|(_, _, tree)| tree.size());
        sizes.fold(1, u64::saturating_add)
    }

    /// The sign of the integrand between the end and `cut`, where all terms have it.
    pub fn sign(&self, cut: &Interval, order: usize) -> Option<Ordering> {
        let place = Interval::from_rational(&self.place, cut.precision());
        if *cut.sub(&place).abs().high() > 1 {
            return None;
        }
        let mut sign = Ordering::Equal;
        for (_, logs, tree) in &self.terms {
            let of_tree = self.sign_of(tree, &place, cut, order)?;
            // ln t <= 0
            let here = if logs % 2 == 1 {
                of_tree.reverse()
            } else {
                of_tree
            };
            if sign != Ordering::Equal && here != Ordering::Equal && here != sign {
                return None;
            }
            if here != Ordering::Equal {
                sign = here;
            }
        }
        Some(sign)
    }

    /// The sign of a factor: where its first r coefficients at the end are 0, it is t^r times a value
    /// of coefficient r over the piece.
    fn sign_of(
        &self,
        tree: &Tree,
        place: &Interval,
        cut: &Interval,
        order: usize,
    ) -> Option<Ordering> {
        let precision = cut.precision();
        let at_end = tree.jet(place, Jets { order, precision }).ok()?;
        let vanishing = at_end
            .iter()
            .take_while(|c| c.sign() == Some(Ordering::Equal))
            .count();
        let range = place.hull(cut);
        let jets = Jets {
            order: vanishing,
            precision,
        };
        let over_piece = tree.jet(&range, jets).ok()?;
        self.turned(over_piece.get(vanishing)?, vanishing).sign()
    }

    /// The integral between the end and `cut`; `None` where a shorter piece is wanted.
    pub fn piece(
        &self,
        cut: &Interval,
        order: usize,
        precision: u32,
    ) -> Result<Option<Behaviour>, Failure> {
        let place = Interval::from_rational(&self.place, precision);
        let mut length = cut.sub(&place);
        if self.side == 1 {
            length = length.neg();
        }
        if *length.low() <= 0 || *length.high() > 1 {
            return Ok(None);
        }
        match self.expand(&place, cut, order, precision) {
            Ok((series, rest)) => integrate(&series, &rest, &length, precision),
            Err(_) => Ok(None),
        }
    }

    /// The Taylor polynomials' terms, and those of the remainders.
    fn expand(
        &self,
        place: &Interval,
        cut: &Interval,
        order: usize,
        precision: u32,
    ) -> Result<(Series, Series), DomainError> {
        let (mut series, mut rest) = (Series::new(), Series::new());
        let range = place.hull(cut);
        for (power, logs, tree) in &self.terms {
            let at_end = tree.jet(place, Jets { order, precision })?;
            let over_piece = tree.jet(&range, Jets { order, precision })?;
            for (k, coefficient) in at_end.iter().enumerate().take(order) {
                let coefficient = self.turned(coefficient, k);
                add(&mut series, power, k, *logs, coefficient);
            }
            if let Some(last) = over_piece.get(order) {
                add(&mut rest, power, order, *logs, self.turned(last, order));
            }
        }
        Ok((series, rest))
    }

    /// At the upper end x = B - t, so that odd powers change sign.
    fn turned(&self, coefficient: &Interval, k: usize) -> Interval {
        if self.side == 1 && k % 2 == 1 {
            coefficient.neg()
        } else {
            coefficient.clone()
        }
    }
}

fn add(series: &mut Series, power: &Rational, k: usize, logs: u32, coefficient: Interval) {
    let exponent = power + Rational::from(k);
    let sum = match series.remove(&(exponent.clone(), logs)) {
        Some(known) => known.add(&coefficient),
        None => coefficient,
    };
    series.insert((exponent, logs), sum);
}

fn integrate(
    series: &Series,
    rest: &Series,
    length: &Interval,
    precision: u32,
) -> Result<Option<Behaviour>, Failure> {
    if rest.keys().any(|(exponent, _)| *exponent <= -1) {
        return Err(Failure::TooLarge("the order of a pole".into()));
    }
    if let Some(sign) = leading_divergence(series)? {
        return Ok(Some(Behaviour::Diverges(sign)));
    }
    let sum = |series: &Series| {
        let mut sum = Interval::from_i64(0, precision);
        for ((exponent, logs), coefficient) in series {
            if coefficient.sign() != Some(Ordering::Equal) {
                let weight = moment(exponent, *logs, length)?;
                sum = sum.add(&coefficient.mul(&weight));
            }
        }
        Ok::<_, DomainError>(sum)
    };
    Ok(match (sum(series), sum(rest)) {
        (Ok(main), Ok(rest)) => Some(Behaviour::Integral { main, rest }),
        _ => None,
    })
}

/// The sign of the first term that is not integrable, if there is one. The remainders' exponents lie
/// above -1, so that what follows it is of lower order.
fn leading_divergence(series: &Series) -> Result<Option<Ordering>, Failure> {
    let Some((lowest, _)) = series
        .iter()
        .find(|(_, c)| c.sign() != Some(Ordering::Equal))
        .map(|((exponent, _), c)| (exponent.clone(), c))
    else {
        return Ok(None);
    };
    if lowest > -1 {
        return Ok(None);
    }
    // Among equal powers the most logarithms lead.
    let leading = series
        .iter()
        .rfind(|((exponent, _), c)| *exponent == lowest && c.sign() != Some(Ordering::Equal));
    let known = leading.and_then(|((_, logs), c)| Some((logs, c.sign()?)));
    match known {
        // ln t < 0
        Some((logs, sign)) if logs % 2 == 1 => Ok(Some(sign.reverse())),
        Some((_, sign)) => Ok(Some(sign)),
        None => Err(undecided("whether an integral converges at its end")),
    }
}

/// int(t^a ln(t)^i, t = 0..d) for a > -1.
fn moment(a: &Rational, logs: u32, d: &Interval) -> Result<Interval, DomainError> {
    let exponent = Rational::from(a + 1u32);
    let scale = Interval::from_rational(&exponent, d.precision());
    let whole = d.pow_rational(&exponent)?;
    let mut value = whole.div(&scale)?;
    if logs == 0 {
        return Ok(value);
    }
    let ln = d.ln()?;
    for i in 1..=logs {
        let boundary = whole.mul(&ln.powi(i64::from(i))?);
        let lower = value.mul(&Interval::from_i64(i64::from(i), d.precision()));
        value = boundary.sub(&lower).div(&scale)?;
    }
    Ok(value)
}
