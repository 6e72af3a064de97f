//! Linear transformations, for c no pole and z < 1. Facts used:
//! - DLMF 15.8.1, Pfaff: F(a, b; c; z) = (1-z)^(-a) F(a, c-b; c; z/(z-1));
//! - DLMF 15.8.1, Euler: F(a, b; c; z) = (1-z)^(c-a-b) F(c-a, c-b; c; z);
//! - DLMF 15.4.20, Gauss: F(a, b; c; 1) = Gamma(c) Gamma(c-a-b)/(Gamma(c-a) Gamma(c-b)), c > a+b;
//! - DLMF 15.8.4 with 15.8.5 and 5.5.3, for s = c-a-b no integer and 0 < z < 1:
//!   F = Gamma(c) Gamma(s)/(Gamma(c-a) Gamma(c-b)) F(a, b; 1-s; 1-z)
//!   + (1-z)^s Gamma(c) Gamma(-s)/(Gamma(a) Gamma(b)) F(c-a, c-b; 1+s; 1-z).

use super::{Parameters, gamma_quotient, nonpositive_integer, right_of_zero, series};
use crate::number::{DomainError, Interval};

/// Polynomials that a transformation leads to are used up to this degree; longer ones may cancel
/// more than they save.
const MAX_DEGREE: u32 = 1 << 10;

/// Whether c - b (or c - a) makes a short polynomial.
fn short(x: &Interval) -> bool {
    nonpositive_integer(x).is_some_and(|n| n <= MAX_DEGREE)
}

/// Pfaff's transformation, z < 0 to 0 < w < 1.
pub(super) fn pfaff(
    p: &Parameters,
    z: &Interval,
    rest: &Interval,
) -> Result<Interval, DomainError> {
    let one = Interval::from_i64(1, p.precision());
    // 1 - w = 1/(1 - z) is computed by itself: the difference would cancel for w near 1.
    let new_rest = one.div(rest)?;
    let w = z.neg().div(rest)?;
    let (a_kept, b_kept) = (p.c.sub(&p.b), p.c.sub(&p.a));
    let keep_b = short(&b_kept) || (*p.b.low() > 0 && *p.a.low() <= 0 && !short(&a_kept));
    let (q, exponent) = if keep_b {
        (
            Parameters {
                a: b_kept,
                b: p.b.clone(),
                c: p.c.clone(),
            },
            &p.b,
        )
    } else {
        (
            Parameters {
                a: p.a.clone(),
                b: a_kept,
                c: p.c.clone(),
            },
            &p.a,
        )
    };
    let value = match q.degree() {
        Some(n) => series::polynomial(&q, &w, &n).or_else(|_| right_of_zero(&q, &w, &new_rest)),
        None => right_of_zero(&q, &w, &new_rest),
    }?;
    Ok(value.mul(&new_rest.pow(exponent)?))
}

/// Euler's transformation where it leads to a short polynomial.
pub(super) fn euler_polynomial(p: &Parameters, z: &Interval, rest: &Interval) -> Option<Interval> {
    let (a, b) = (p.c.sub(&p.a), p.c.sub(&p.b));
    if !short(&a) && !short(&b) {
        return None;
    }
    let q = Parameters {
        a,
        b,
        c: p.c.clone(),
    };
    let value = series::polynomial(&q, z, &q.degree()?).ok()?;
    Some(value.mul(&rest.pow(&p.excess()).ok()?))
}

/// Gauss's sum at z = 1, for c - a - b > 0.
pub(super) fn gauss(p: &Parameters) -> Result<Interval, DomainError> {
    gamma_quotient(
        &[p.c.clone(), p.excess()],
        &[p.c.sub(&p.a), p.c.sub(&p.b)],
        p.precision(),
    )
}

/// The connection to `rest` = 1 - z, for c - a - b no integer.
///
/// # Errors
/// `Possible` where c - a - b may be an integer, and as the series.
pub(super) fn connection(p: &Parameters, rest: &Interval) -> Result<Interval, DomainError> {
    let excess = p.excess();
    if excess.may_hold_integer() {
        return Err(DomainError::Possible);
    }
    let one = Interval::from_i64(1, p.precision());
    let regular = Parameters {
        a: p.a.clone(),
        b: p.b.clone(),
        c: one.sub(&excess),
    };
    let singular = Parameters {
        a: p.c.sub(&p.a),
        b: p.c.sub(&p.b),
        c: one.add(&excess),
    };
    let first = gauss(p)?.mul(&series::infinite(&regular, rest)?);
    let scale = gamma_quotient(
        &[p.c.clone(), excess.neg()],
        &[p.a.clone(), p.b.clone()],
        p.precision(),
    )?;
    let second = scale
        .mul(&rest.pow(&excess)?)
        .mul(&series::infinite(&singular, rest)?);
    Ok(first.add(&second))
}
