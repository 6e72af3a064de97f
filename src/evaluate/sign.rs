//! The sign of a rational function on an open interval, proved: by the parity of the linear factors
//! inside and by coefficients of one sign after the map `x = (low + high*t)/(1 + t)` (or
//! `x = low + t`) of the interval to t > 0.

use super::Failure;
use super::fraction::{Fraction, Polynomial, multiply};
use super::integrate::Bound;
use crate::formula::Budget;
use rug::Rational;
use std::cmp::Ordering;

/// What is known of the sign on an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sign {
    /// Nowhere negative.
    NonNegative,
    /// Nowhere positive.
    NonPositive,
    /// Negative somewhere and positive somewhere.
    Mixed,
    Unknown,
}

/// Rational ends of an interval that holds the one meant (`outer`), and of one inside of it.
struct Ends {
    outer: (Option<Rational>, Option<Rational>),
    inner: (Rational, Rational),
}

fn ends(from: &Bound, to: &Bound) -> Option<Ends> {
    let (low_outer, low_inner) = from.neighbours()?;
    let (high_inner, high_outer) = to.neighbours()?;
    let one = Rational::from(1);
    let inner = match (low_inner, high_inner) {
        (Some(low), Some(high)) => (low, high),
        (Some(low), None) => (low.clone(), low + one),
        (None, Some(high)) => (high.clone() - one, high),
        (None, None) => (Rational::from(-1), one),
    };
    (inner.0 < inner.1).then_some(Ends {
        outer: (low_outer, high_outer),
        inner,
    })
}

/// The sign of `function` between the bounds.
pub(super) fn on(
    function: &Fraction,
    from: &Bound,
    to: &Bound,
    budget: &Budget,
) -> Result<Sign, Failure> {
    let function = function.split(budget)?;
    let Some(ends) = ends(from, to) else {
        return Ok(Sign::Unknown);
    };
    let mut seen = seen_signs(&function, &ends, budget)?;
    seen.dedup();
    if seen.contains(&Ordering::Less) && seen.contains(&Ordering::Greater) {
        return Ok(Sign::Mixed);
    }
    let inside = |root: &Rational| {
        let above = ends.outer.0.as_ref().is_none_or(|low| root > low);
        above && ends.outer.1.as_ref().is_none_or(|high| root < high)
    };
    let changes = function
        .factors
        .iter()
        .any(|(root, e)| e % 2 != 0 && inside(root));
    if changes || !has_one_sign(&function.numerator, &ends.outer, budget)? {
        return Ok(Sign::Unknown);
    }
    Ok(match seen.iter().find(|sign| sign.is_ne()) {
        Some(Ordering::Greater) => Sign::NonNegative,
        Some(Ordering::Less) => Sign::NonPositive,
        _ if function.is_zero() => Sign::NonNegative,
        _ => Sign::Unknown,
    })
}

/// The signs at places inside, among them one in every gap between the known roots.
fn seen_signs(function: &Fraction, ends: &Ends, budget: &Budget) -> Result<Vec<Ordering>, Failure> {
    let (low, high) = &ends.inner;
    let mut marks = vec![low.clone()];
    let inside = |root: &&Rational| *root > low && *root < high;
    marks.extend(
        function
            .factors
            .iter()
            .map(|(root, _)| root)
            .filter(inside)
            .cloned(),
    );
    marks.push(high.clone());
    let mut signs = vec![];
    for pair in marks.windows(2) {
        for part in 1..8u32 {
            let width = Rational::from(&pair[1] - &pair[0]);
            let x = width * Rational::from((part, 8u32)) + &pair[0];
            if let Some(value) = function.at(&x, budget)? {
                signs.push(value.cmp0());
            }
        }
    }
    Ok(signs)
}

/// Whether the coefficients after the map to t > 0 prove that there is no change of sign.
fn has_one_sign(
    polynomial: &Polynomial,
    (low, high): &(Option<Rational>, Option<Rational>),
    budget: &Budget,
) -> Result<bool, Failure> {
    if polynomial.len() < 2 {
        return Ok(true);
    }
    let zero = Rational::new();
    let one = Rational::from(1);
    let (top, bottom) = match (low, high) {
        (Some(low), Some(high)) => (vec![low.clone(), high.clone()], vec![one.clone(), one]),
        (Some(low), None) => (vec![low.clone(), one.clone()], vec![one]),
        (None, Some(high)) => (vec![high.clone(), Rational::from(-1)], vec![one]),
        (None, None) => return Ok(false),
    };
    // Horner's rule on numerator and denominator at once: sum of c_j top^j bottom^(d-j).
    let mut sum = vec![];
    let mut scale = vec![Rational::from(1)];
    for coefficient in polynomial.iter().rev() {
        sum = multiply(&sum, &top, budget)?;
        let addend = multiply(&scale, std::slice::from_ref(coefficient), budget)?;
        sum.resize(sum.len().max(addend.len()), zero.clone());
        for (left, right) in sum.iter_mut().zip(&addend) {
            *left += right;
        }
        scale = multiply(&scale, &bottom, budget)?;
    }
    let negative = sum.iter().any(|c| c.cmp0() == Ordering::Less);
    let positive = sum.iter().any(|c| c.cmp0() == Ordering::Greater);
    Ok(!(negative && positive))
}
