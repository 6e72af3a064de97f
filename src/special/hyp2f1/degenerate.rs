//! The connection to u = 1 - z where c - a - b = m is an integer, 0 < u < 1.
//!
//! DLMF 15.8.10, for m >= 0, with (m-k-1)! = (-1)^k (m-1)!/(1-m)_k and Gauss's constant taken out:
//!   F(a, b; a+b+m; z) = G S - (-u)^m Gamma(c)/(Gamma(a) Gamma(b) m!) T,
//!   G = Gamma(c) Gamma(m)/(Gamma(a+m) Gamma(b+m)),
//!   S = sum over k < m of (a)_k (b)_k u^k/(k! (1-m)_k)        (no S term for m = 0),
//!   T = sum over k >= 0 of t_k h_k,  t_k = (a+m)_k (b+m)_k u^k/(k! (m+1)_k),
//!   h_k = ln u - psi(k+1) - psi(k+m+1) + psi(a+m+k) + psi(b+m+k).
//! For m < 0 Euler's transformation (DLMF 15.8.1) leads to -m.
//!
//! Theorem (tail of T). Let a+m+N >= 1, b+m+N >= 1 and
//!   H = |ln u| + 2|a-1|/min(a+m+N, m+1+N) + 2|b+m-1|/min(b+m+N, N+1).
//! Then |sum over k >= N of t_k h_k| <= H |t_N|/(1 - r) with r < 1 as in the theorem of `series`.
//! Proof. For x >= 1: 0 < psi'(x) = sum over n >= 0 of 1/(x+n)^2 <= 1/x^2 + 1/x <= 2/x (DLMF 5.15.1).
//! By the mean value theorem |psi(x) - psi(y)| <= 2|x-y|/min(x, y) for x, y >= 1. Pair psi(a+m+k)
//! with psi(k+m+1) and psi(b+m+k) with psi(k+1): |h_k| <= H for every k >= N, as the quotients
//! fall with k. The |t_k| are bounded by a geometric series. QED.

use super::series::{Ratio, geometric_tail, max_terms, negligible, polynomial, with_tail};
use super::transform::gauss;
use super::{Parameters, gamma_quotient, nonpositive_integer};
use crate::number::{DomainError, Interval};
use rug::{Float, Integer};

/// MPFR's psi takes minutes beyond this precision.
const MOST_DIGAMMA_BITS: u32 = 1 << 13;

/// psi of an integer up to this is a sum of fractions.
const MAX_HARMONIC: u32 = 1 << 10;

/// F(a, b; c; 1 - rest), for c - a - b an integer.
///
/// # Errors
/// `Possible` where c - a - b is no integer or too large, and past the cap of work.
pub(super) fn connection(p: &Parameters, rest: &Interval) -> Result<Interval, DomainError> {
    let excess = p.excess();
    let m = excess.as_integer().ok_or(DomainError::Possible)?;
    if m.cmp0().is_ge() {
        let m = m.to_u32().filter(|m| *m < max_terms(p.precision()));
        return logarithmic(p, rest, m.ok_or(DomainError::Possible)?);
    }
    let q = Parameters {
        a: p.c.sub(&p.a),
        b: p.c.sub(&p.b),
        c: p.c.clone(),
    };
    let m = Integer::from(-&m)
        .to_u32()
        .filter(|m| *m < max_terms(p.precision()));
    let value = logarithmic(&q, rest, m.ok_or(DomainError::Possible)?)?;
    Ok(value.mul(&rest.pow(&excess)?))
}

/// The formula of the header.
fn logarithmic(p: &Parameters, u: &Interval, m: u32) -> Result<Interval, DomainError> {
    // 1/Gamma(a) is 0 there, psi has a pole: the product has a limit, found by other methods.
    if [&p.a, &p.b]
        .iter()
        .any(|x| nonpositive_integer(x).is_some())
    {
        return Err(DomainError::Possible);
    }
    let shift = Interval::from_i64(m.into(), p.precision());
    let one = Interval::from_i64(1, p.precision());
    let upper = shift.add(&one);
    let scale = gamma_quotient(
        std::slice::from_ref(&p.c),
        &[p.a.clone(), p.b.clone(), upper.clone()],
        p.precision(),
    )?;
    let power = u.neg().powi(m.into())?;
    let shifted = Parameters {
        a: p.a.add(&shift),
        b: p.b.add(&shift),
        c: upper,
    };
    let second = scale.mul(&power).mul(&logarithmic_sum(&shifted, u)?);
    if m == 0 {
        return Ok(second.neg());
    }
    let finite = Parameters {
        a: p.a.clone(),
        b: p.b.clone(),
        c: one.sub(&shift),
    };
    let first = gauss(p)?.mul(&polynomial(&finite, u, &Integer::from(m - 1))?);
    Ok(first.sub(&second))
}

/// T, for the parameters a + m, b + m, m + 1.
fn logarithmic_sum(p: &Parameters, u: &Interval) -> Result<Interval, DomainError> {
    let precision = p.precision();
    let one = Interval::from_i64(1, precision);
    let ratio = Ratio::new(p);
    let logarithm = u.ln()?;
    let mut bracket = logarithm.add(&digamma_sum(p)?);
    let mut term = one.clone();
    let mut sum = Interval::from_i64(0, precision);
    for k in 0..max_terms(precision) / 4 {
        if k > 0 && negligible(term.abs().high(), &sum) {
            let tail = tail(p, &ratio, &term, u, &logarithm, k);
            if let Some(tail) = tail.filter(|tail| negligible(tail, &sum)) {
                return Ok(with_tail(&sum, &tail));
            }
        }
        sum = sum.add(&term.mul(&bracket));
        // psi(x + 1) = psi(x) + 1/x (DLMF 5.5.2).
        let step = Interval::from_i64(k.into(), precision);
        let inverse = |x: &Interval| one.div(&x.add(&step));
        let down = inverse(&one)?.add(&inverse(&p.c)?);
        bracket = bracket.add(&inverse(&p.a)?).add(&inverse(&p.b)?).sub(&down);
        term = ratio.times(&term, k)?.mul(u);
    }
    Err(DomainError::Possible)
}

/// psi(a) + psi(b) - psi(c) - psi(1). For small integers Euler's constant drops out of it, since
/// psi(n) = H_{n-1} - gamma with the harmonic numbers H (DLMF 5.4.14).
fn digamma_sum(p: &Parameters) -> Result<Interval, DomainError> {
    let harmonic = |x: &Interval| {
        let n = x
            .as_integer()?
            .to_u32()
            .filter(|n| (1..=MAX_HARMONIC).contains(n))?;
        let one = Interval::from_i64(1, x.precision());
        let term = |k: u32| one.div_integer(&Integer::from(k)).ok();
        (1..n).try_fold(Interval::from_i64(0, x.precision()), |sum, k| {
            Some(sum.add(&term(k)?))
        })
    };
    if let (Some(a), Some(b), Some(c)) = (harmonic(&p.a), harmonic(&p.b), harmonic(&p.c)) {
        return Ok(a.add(&b).sub(&c));
    }
    if p.precision() > MOST_DIGAMMA_BITS {
        return Err(DomainError::Possible);
    }
    let at_one = Interval::from_i64(1, p.precision()).digamma()?;
    Ok(p.a
        .digamma()?
        .add(&p.b.digamma()?)
        .sub(&p.c.digamma()?)
        .sub(&at_one))
}

/// The bound of the header's theorem, N = `from`; `None` where its conditions are not proved.
fn tail(
    p: &Parameters,
    ratio: &Ratio,
    term: &Interval,
    u: &Interval,
    logarithm: &Interval,
    from: u32,
) -> Option<Float> {
    let precision = 64;
    let one = Interval::from_i64(1, precision);
    let step = Interval::from_i64(from.into(), precision);
    let [a, b, c] = [&p.a, &p.b, &p.c].map(|x| x.with_precision(precision).add(&step));
    let first = one.add(&step);
    // |x - y| 2/min(x, y), for x and y >= 1.
    let change = |x: &Interval, y: &Interval| -> Option<Interval> {
        let least = x.min(y);
        if *least.low() < 1 {
            return None;
        }
        x.sub(y)
            .abs()
            .mul(&Interval::from_i64(2, precision))
            .div(&least)
            .ok()
    };
    let bracket = logarithm
        .with_precision(precision)
        .abs()
        .add(&change(&a, &c)?)
        .add(&change(&b, &first)?);
    geometric_tail(
        &term.with_precision(precision).mul(&bracket),
        &ratio.bound(from)?,
        u,
    )
}
