//! `mean(1/U) = a + b ln(1 + V/Va)` with rational a and b, each rounded to the nearest double: the best that doubles can
//! do with it.
//!
//! Theorem. `b = (C/V) (-r)^(l-1) (1+r)^(m-l)`, r = Va/V, C = m!/((l-1)! (m-l)!). Proof. mean(1/U) is `C/V` times the integral over [0, 1]
//! of `P(x)/(x+r)`, `P = x^(l-1) (1-x)^(m-l)`; and `P(x) = P(-r) + (x+r) Q(x)` with a polynomial Q. QED.

use super::{Failure, Scene};
use crate::number::Interval;
use rug::{Integer, Rational};

/// The most photons, as in `special::shell`: more have coefficients that are too long.
const MOST_PHOTONS: f64 = 4096.0;

/// Bits that follow those of b before the point.
const BITS: u32 = 128;

pub(super) fn function(scene: &Scene, function: &Interval) -> Result<f64, Failure> {
    if scene.count > MOST_PHOTONS {
        return Err(Failure::Cost);
    }
    let (a, b) = coefficients(scene, function).ok_or(Failure::Overflow)?;
    Ok(scene.inner * (a + b * (scene.volume / scene.inner).ln_1p()))
}

/// a and b; `None` where one is beyond the doubles.
fn coefficients(scene: &Scene, function: &Interval) -> Option<(f64, f64)> {
    let size = logarithmic(scene, 64)?.abs().high().get_exp()?;
    if i64::from(size) > i64::from(f64::MAX_EXP) {
        return None;
    }
    let precision = BITS + size.max(0).unsigned_abs();
    let b = logarithmic(scene, precision)?;
    let shell = scene.shell()?;
    let number = |value: &Rational| Interval::from_rational(value, precision);
    let logarithm = number(&Rational::from(&shell.volume / &shell.inner))
        .ln_1p()
        .ok()?;
    // a is what F leaves: mean(1/U) = F/Va.
    let mean = function.div(&number(&shell.inner)).ok()?;
    let a = mean.sub(&b.mul(&logarithm));
    let [a, b] = [a, b].map(|x| x.midpoint().to_f64());
    (a.is_finite() && b.is_finite()).then_some((a, b))
}

/// b
fn logarithmic(scene: &Scene, precision: u32) -> Option<Interval> {
    let shell = scene.shell()?;
    let (l, m) = (shell.position.to_u32()?, shell.count.to_u32()?);
    let constant = Integer::from(Integer::binomial_u(m, l)) * l;
    let r = Rational::from(&shell.inner / &shell.volume);
    let number = |value: &Rational| Interval::from_rational(value, precision);
    let below = number(&-r.clone()).powi(i64::from(l) - 1).ok()?;
    let above = number(&(r + 1u32)).powi(i64::from(m - l)).ok()?;
    let product = below.mul(&above).mul_integer(&constant);
    product.div(&number(&shell.volume)).ok()
}
