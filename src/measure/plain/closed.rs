//! `mean(1/U) = a + b ln(1 + V/Va)` with rational a and b, each rounded to the nearest double: the best that doubles can
//! do with it.
//!
//! Theorem. `b = (C/V) (-r)^(l-1) (1+r)^(m-l)`, r = Va/V, C = m!/((l-1)! (m-l)!). Proof. mean(1/U) is `C/V` times the integral over [0, 1]
//! of `P(x)/(x+r)`, `P = x^(l-1) (1-x)^(m-l)`; and `P(x) = P(-r) + (x+r) Q(x)` with a polynomial Q. QED.

use super::{Failure, Scene};
use crate::number::Interval;
use rug::{Integer, Rational};

/// Bits that follow those of b before the point.
const BITS: u32 = 160;

pub(super) fn function(scene: &Scene, function: &Interval) -> Result<f64, Failure> {
    let (a, b) = coefficients(scene, function).ok_or(Failure::Overflow)?;
    Ok(scene.inner * (a + b * (scene.volume / scene.inner).ln_1p()))
}

/// a and b; `None` where one is beyond the doubles.
fn coefficients(scene: &Scene, function: &Interval) -> Option<(f64, f64)> {
    let bits = logarithm_of_b(scene, BITS)?.midpoint().to_f64() / std::f64::consts::LN_2;
    if bits > f64::from(f64::MAX_EXP) + 1.0 {
        return None;
    }
    // ln b has an absolute error; b has as many bits before the point as it is large.
    let precision = BITS + bits.max(0.0) as u32;
    let size = logarithm_of_b(scene, precision)?.exp();
    let b = match scene.position % 2.0 == 0.0 {
        true => size.neg(),
        false => size,
    };
    let shell = scene.shell()?;
    let number = |value: &Rational| Interval::from_rational(value, precision);
    let logarithm = number(&Rational::from(&shell.volume / &shell.inner));
    let logarithm = logarithm.ln_1p().ok()?;
    // a is what F leaves: mean(1/U) = F/Va.
    let mean = function.div(&number(&shell.inner)).ok()?;
    let a = mean.sub(&b.mul(&logarithm));
    let [a, b] = [a, b].map(|x| x.midpoint().to_f64());
    (a.is_finite() && b.is_finite()).then_some((a, b))
}

/// ln |b|
fn logarithm_of_b(scene: &Scene, precision: u32) -> Option<Interval> {
    let shell = scene.shell()?;
    let (l, m) = (&shell.position, &shell.count);
    let number = |value: &Rational| Interval::from_rational(value, precision);
    let factorial = |n: Integer| number(&Rational::from(n + 1u32)).lngamma().ok();
    let constant = factorial(m.clone())?
        .sub(&factorial(Integer::from(l - 1u32))?)
        .sub(&factorial(Integer::from(m - l))?);
    let r = Rational::from(&shell.inner / &shell.volume);
    let below = number(&r).ln().ok()?.mul_integer(&Integer::from(l - 1u32));
    let above = number(&r).ln_1p().ok()?.mul_integer(&Integer::from(m - l));
    let volume = number(&shell.volume).ln().ok()?;
    Some(constant.add(&below).add(&above).sub(&volume))
}
