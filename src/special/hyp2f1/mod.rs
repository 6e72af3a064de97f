//! Gauss's hypergeometric function F(a, b; c; z) on the real line (DLMF chapter 15).
//!
//! What has a value: z < 1; every z where a or b is a nonpositive integer -n (a polynomial of
//! degree n; with c = -m for n <= m only, DLMF 15.2.5); z = 1 where c > a + b. Nothing else, and
//! nothing for c = 0, -1, ... but those polynomials.
//!
//! Ways, one file each:
//! - `series`: the power series with a proved tail, for |z| <= 3/4, and for polynomials;
//! - `transform`: Pfaff's and Euler's transformations, Gauss's sum at 1, and the connection to
//!   1 - z for z near 1 where c - a - b is no integer;
//! - `degenerate`: the same connection where c - a - b is an integer (a logarithm appears).
//!
//! Cancellation shows as a wide result. The computation is then repeated with twice the bits, a
//! few times, as long as that gains digits: it cannot where the arguments themselves are wide.

mod degenerate;
mod series;
mod transform;

use super::gamma_quotient::{exact_precision, gamma_quotient};
use super::{may_be_pole, nonpositive_integer, pochhammer, widen};
use crate::number::{DomainError, Interval};
use rug::Integer;
use std::cmp::Ordering;

/// Bits beyond those asked for, at first.
const GUARD: u32 = 48;

/// How often the bits may be doubled.
const DOUBLINGS: u32 = 4;

/// Bits of the arguments' own accuracy that a result is allowed to lose before it is repeated.
const LOSS: i64 = 16;

/// Where (|a| + |b| + |c|)(1-z) is larger, the terms of the connection to 1 - z grow to about
/// e to this power before they fall, and the plain series is tried first.
const LARGE: u32 = 64;

/// A repetition that gains fewer bits than this is the last.
const WORTHWHILE: i64 = 8;

/// The parameters of the function, in the working precision.
#[derive(Clone, Debug)]
struct Parameters {
    a: Interval,
    b: Interval,
    c: Interval,
}

impl Parameters {
    fn precision(&self) -> u32 {
        self.c.precision()
    }

    /// c - a - b
    fn excess(&self) -> Interval {
        self.c.sub(&self.a).sub(&self.b)
    }

    /// The degree where the series ends for certain.
    fn degree(&self) -> Option<Integer> {
        match (nonpositive_integer(&self.a), nonpositive_integer(&self.b)) {
            (Some(m), Some(n)) => Some(m.min(n)),
            (one, other) => one.or(other),
        }
    }

    /// Whether a wide parameter may end the series, at a degree that cannot be told.
    fn may_end_unseen(&self) -> bool {
        let unseen = |x| may_be_pole(x) && nonpositive_integer(x).is_none();
        unseen(&self.a) || unseen(&self.b)
    }

    /// Whether the series may end.
    fn may_terminate(&self) -> bool {
        may_be_pole(&self.a) || may_be_pole(&self.b)
    }
}

/// F(a, b; c; z), DLMF 15.2.1, with about `precision` bits where the arguments are points.
///
/// # Errors
/// `Certain` where there is no value (see the header); `Possible` where an argument is too wide to
/// tell, or where the work of all methods is past its cap.
pub fn hyp2f1(
    a: &Interval,
    b: &Interval,
    c: &Interval,
    z: &Interval,
    precision: u32,
) -> Result<Interval, DomainError> {
    let exact = exact_precision(&[a, b, c], precision);
    let mut working = precision.saturating_add(GUARD);
    let known = [a, b, c, z].map(accurate_bits).into_iter().min();
    let goal = i64::from(precision).min(known.unwrap_or(0) - LOSS);
    let mut best: Option<Interval> = None;
    for _ in 0..=DOUBLINGS {
        let [a, b, c, z] = widen([a, b, c, z], working.max(exact));
        let next = match (attempt(&Parameters { a, b, c }, &z), &best) {
            (Ok(next), _) => next,
            (Err(DomainError::Possible), Some(_)) => break,
            (Err(error), _) => return Err(error),
        };
        let before = best.as_ref().map_or(i64::MIN / 2, accurate_bits);
        let bits = accurate_bits(&next);
        let narrowed = best.and_then(|old| old.intersection(&next)).unwrap_or(next);
        best = Some(narrowed);
        if bits >= goal || bits < before + WORTHWHILE {
            break;
        }
        working = working.saturating_mul(2);
    }
    best.map(|value| value.with_precision(precision))
        .ok_or(DomainError::Possible)
}

/// F(a, b; c; z)/Gamma(c), DLMF 15.2.2: it has a value for every c. At c = -n it is
/// (a)_{n+1} (b)_{n+1} z^{n+1} F(a+n+1, b+n+1; n+2; z)/(n+1)! (DLMF 15.2.3_5).
///
/// # Errors
/// As [`hyp2f1`] but for c.
pub fn hyp2f1_regularized(
    a: &Interval,
    b: &Interval,
    c: &Interval,
    z: &Interval,
    precision: u32,
) -> Result<Interval, DomainError> {
    let working = exact_precision(&[a, b, c], precision) + GUARD;
    let [a, b, c, z] = widen([a, b, c, z], working);
    let Some(n) = nonpositive_integer(&c) else {
        let scale = gamma_quotient(&[], std::slice::from_ref(&c), working)?;
        let value = hyp2f1(&a, &b, &c, &z, working)?.mul(&scale);
        return Ok(value.with_precision(precision));
    };
    let steps = n + 1u32;
    let shift = Interval::from_integer(&steps, working.max(steps.significant_bits()));
    let one = Interval::from_i64(1, working);
    let value = hyp2f1(
        &a.add(&shift),
        &b.add(&shift),
        &shift.add(&one),
        &z,
        working,
    )?;
    let scale = pochhammer(&a, &steps, working)?
        .mul(&pochhammer(&b, &steps, working)?)
        .mul(&gamma_quotient(&[], &[shift.add(&one)], working)?);
    let power = z.pow_integer(&steps)?;
    Ok(value.mul(&scale).mul(&power).with_precision(precision))
}

/// About how many leading bits of the value are known.
fn accurate_bits(value: &Interval) -> i64 {
    if value.is_point() {
        return i64::MAX / 2;
    }
    if value.contains_zero() || !value.is_bounded() {
        return 0;
    }
    let exponent = |x: &rug::Float| i64::from(x.get_exp().unwrap_or(i32::MIN));
    exponent(value.low()).min(exponent(value.high())) - exponent(&value.width())
}

/// One computation in the working precision of the parameters.
fn attempt(p: &Parameters, z: &Interval) -> Result<Interval, DomainError> {
    if let Some(m) = nonpositive_integer(&p.c) {
        return match p.degree() {
            Some(n) if n <= m => series::polynomial(p, z, &n),
            _ if p.may_end_unseen() => Err(DomainError::Possible),
            _ => Err(DomainError::Certain),
        };
    }
    if may_be_pole(&p.c) {
        return Err(DomainError::Possible);
    }
    if let Some(n) = p.degree() {
        return terminating(p, z, &n);
    }
    let one = Interval::from_i64(1, p.precision());
    let rest = one.sub(z);
    match rest.sign() {
        Some(Ordering::Greater) => below_one(p, z, &rest),
        Some(Ordering::Equal) => at_one(p),
        Some(Ordering::Less) if !p.may_terminate() => Err(DomainError::Certain),
        _ => Err(DomainError::Possible),
    }
}

/// A polynomial of degree n, c no pole. One too long to be summed may still converge fast.
fn terminating(p: &Parameters, z: &Interval, n: &Integer) -> Result<Interval, DomainError> {
    match series::polynomial(p, z, n) {
        Err(DomainError::Possible) if *z.high() < 1 => {
            let rest = Interval::from_i64(1, p.precision()).sub(z);
            below_one(p, z, &rest)
        }
        other => other,
    }
}

/// z = 1: Gauss's sum where c - a - b > 0, no value where it is not.
fn at_one(p: &Parameters) -> Result<Interval, DomainError> {
    let excess = p.excess();
    if *excess.low() > 0 {
        transform::gauss(p)
    } else if *excess.high() <= 0 && !p.may_terminate() {
        Err(DomainError::Certain)
    } else {
        Err(DomainError::Possible)
    }
}

/// z < 1, c no pole; `rest` is 1 - z.
fn below_one(p: &Parameters, z: &Interval, rest: &Interval) -> Result<Interval, DomainError> {
    if *z.low() < -0.5 {
        transform::pfaff(p, z, rest)
    } else {
        right_of_zero(p, z, rest)
    }
}

/// -3/4 <= z < 1, c no pole; `rest` is 1 - z.
fn right_of_zero(p: &Parameters, z: &Interval, rest: &Interval) -> Result<Interval, DomainError> {
    if let Some(value) = transform::euler_polynomial(p, z, rest) {
        return Ok(value);
    }
    if *z.high() <= 0.75 {
        return series::infinite(p, z);
    }
    let size = p.a.abs().add(&p.b.abs()).add(&p.c.abs());
    if *size.mul(rest).high() > LARGE
        && let Ok(value) = series::infinite(p, z)
    {
        return Ok(value);
    }
    let near = match p.excess().as_integer() {
        Some(_) => degenerate::connection(p, rest),
        None => transform::connection(p, rest),
    };
    near.or_else(|_| series::infinite(p, z))
}

#[cfg(test)]
mod tests;
