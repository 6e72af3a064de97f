//! The exact value: `mean(1/U) = a + b ln(1 + V/Va)` with rational a and b (`model::moments`).
//!
//! Domain: shells of up to 4096 photons; for `Va = 0` all shells, by the moments of the Beta law. Cost: the recurrence
//! for a and b, m + l steps, and one logarithm.
//!
//! a and b ln(1 + V/Va) cancel in about m log2 m bits: evaluated in doubles nothing is left from m = 15 on.
//! Here the cancelled bits are known beforehand, from the size of a, since `mean(1/U) >= 1/(Va+V)`; the
//! logarithm gets so many more.
//!
//! Theorem (logarithm). `ln(1 + V/Va) = 2 artanh u`, u = V/(2Va+V), and `artanh u = u (1 + x)`,
//! `x = sum of u^(2j)/(2j+1)` (DLMF 4.38.5): the series of `splitting` with `r_j = u^2 (2j+1)/(2j+3)`.

use super::ShellError;
use super::quantity::{Numbers, Quantity, each};
use super::sketch::{self, Sketch};
use super::splitting::Series;
use crate::model::{LogLinear, MomentError, Shell, mean_reciprocal};
use crate::number::{DomainError, Interval};
use rug::{Integer, Rational};

/// Bits for the rounding errors.
const GUARD: u32 = 24;

/// The most photons, as `model::moments` has it.
const MOST_PHOTONS: f64 = 4096.0;

/// The largest u for which the series of artanh is summed.
const SHORT: f64 = 0.5;

pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    let numbers = Numbers::new(shell);
    if shell.inner == 0 {
        return each(quantities, |quantity| at_the_centre(quantity, shell, bits));
    }
    let value = mean_reciprocal(shell).map_err(|error| match error {
        MomentError::NoShell => ShellError::NoShell,
        MomentError::TooManyPhotons(_) | MomentError::TooLarge => ShellError::Outside,
    })?;
    let value = value.ok_or(DomainError::Certain)?;
    let function = mean(&value, shell, bits + GUARD)?;
    let function = function.mul(&Interval::from_rational(&shell.inner, bits + GUARD));
    numbers.by_function(quantities, &function)
}

/// a + b ln(1 + V/Va) to about 2^-bits of its size.
fn mean(value: &LogLinear, shell: &Shell, bits: u32) -> Result<Interval, ShellError> {
    let outer = Rational::from(&shell.inner + &shell.volume);
    let size = |q: &Rational| {
        i64::from(q.numer().significant_bits()) - i64::from(q.denom().significant_bits())
    };
    let lost = size(&value.rational) + size(&outer) + 4;
    let working = bits + u32::try_from(lost.max(0)).map_err(|_| ShellError::Outside)?;
    let logarithm = logarithm(shell, working)?;
    let product = logarithm.mul(&Interval::from_rational(&value.logarithm, working));
    let sum = product.add(&Interval::from_rational(&value.rational, working));
    Ok(sum.with_precision(bits))
}

/// ln(1 + V/Va): by its series where that is short, else by MPFR's logarithm of both ends.
fn logarithm(shell: &Shell, precision: u32) -> Result<Interval, ShellError> {
    let both = Rational::from(&shell.inner * 2u32) + &shell.volume;
    let u = &shell.volume / both;
    if u > SHORT {
        let ratio = Rational::from(&shell.volume / &shell.inner) + 1u32;
        return Ok(Interval::from_rational(&ratio, precision + GUARD).ln()?);
    }
    let series = Series {
        w: &u.clone().square(),
        q: &Integer::from(1),
        s: &Integer::from(3),
        step: 2,
    };
    let x = series.sum(precision)?;
    let sum = Interval::from_i64(1, precision).add(&x);
    Ok(sum.mul(&Interval::from_rational(&(u * 2u32), precision)))
}

/// `Va = 0`: k = l, and the moments of the Beta law (DLMF 5.12.1) are
/// `mean(1/U) = m/(V (l-1))`, `mean(1/U^2) = m (m-1)/(V^2 (l-1) (l-2))`, infinite without a positive denominator.
fn at_the_centre(quantity: Quantity, shell: &Shell, bits: u32) -> Result<Interval, ShellError> {
    let (l, m) = (&shell.position, &shell.count);
    let needed = match quantity {
        // Its argument -V/Va is no number.
        Quantity::Function => return Err(DomainError::Certain.into()),
        Quantity::Mean | Quantity::Excess => 1,
        Quantity::Variance => 2,
    };
    if *l <= needed {
        return Err(DomainError::Certain.into());
    }
    let scale = Rational::from(l / &shell.volume);
    let mean = scale.clone() * m / Integer::from(l - 1u32);
    let value = match quantity {
        Quantity::Function | Quantity::Mean => mean,
        Quantity::Excess => mean - 1u32,
        Quantity::Variance => {
            let above = Integer::from(m - 1u32) * m;
            let below = Integer::from(l - 1u32) * Integer::from(l - 2u32);
            scale.square() * Rational::from((above, below)) - mean.square()
        }
    };
    Ok(Interval::from_rational(&value, bits))
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    if sketch.inside == 0.0 {
        return 5000.0;
    }
    if sketch.s > MOST_PHOTONS {
        return f64::INFINITY;
    }
    let (u, m) = (sketch.w / (1.0 + sketch.inside), sketch.s - 1.0);
    // About the bits of a, and as many are cancelled.
    let lost = m * (2.0 * m / sketch.w.recip().min(m)).log2().max(1.0);
    let bits = f64::from(bits + GUARD) + lost;
    let words = lost / 64.0;
    let steps = (m + sketch.l) * (5900.0 + 330.0 * words + 9.0 * words * words);
    // What follows in intervals: products of whole numbers.
    let after = 75.0 * (bits / 64.0).powf(1.7);
    55_000.0 + steps + logarithm_cost(u, bits) + after
}

fn logarithm_cost(u: f64, bits: f64) -> f64 {
    if u > SHORT {
        // MPFR's, by the arithmetic-geometric mean: about 2 log2 bits products.
        return 40_000.0 + 30.0 * bits.log2() * (bits / 64.0).powf(1.6);
    }
    let terms = bits / (-2.0 * u.log2());
    let term_bits = (2.0 * terms + 3.0).log2() - 2.0 * u.log2();
    sketch::splitting(terms, term_bits, bits)
}
