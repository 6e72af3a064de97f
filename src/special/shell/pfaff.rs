//! Pfaff's series, DLMF 15.8.1: with w = V/(Va+V), q = m+1-l, s = m+1 and A = Va+V,
//!
//! ```text
//! mean(A/U) - 1 = sum of T_j, j >= 1,     T_0 = 1,  T_(j+1) = T_j w (q+j)/(s+j)
//! ```
//!
//! Domain: `Va > 0`; cost: about bits/log2(1/w) terms, at most [`MOST_TERMS`].
//!
//! Theorem. All terms are positive, so nothing cancels; and `0 <= T_(n+1) + T_(n+2) + ... <= T_n w/(1-w)`.
//! Proof. A/U = 1/(1 - w y), y ~ Beta(q, l) with moments (q)_j/(s)_j (DLMF 5.12.1); q < s, so that
//! `T_(j+1) < w T_j`: a geometric series.

use super::quantity::{Numbers, Quantity};
use super::sketch::Sketch;
use super::{ShellError, sketch};
use crate::model::Shell;
use crate::number::Interval;
use rug::Integer;

/// The most terms: a second's work, about.
pub(super) const MOST_TERMS: u32 = 1 << 17;

/// Bits for the rounding errors of the terms.
const GUARD: u32 = 24;

pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    let numbers = Numbers::new(shell);
    let x = mean(&numbers, bits + GUARD)?;
    numbers.all(quantities, &x)
}

/// mean(A/U) - 1
pub(super) fn mean(numbers: &Numbers, precision: u32) -> Result<Interval, ShellError> {
    if numbers.w == 1 {
        return Err(ShellError::Outside);
    }
    let (p, d) = (numbers.w.numer(), numbers.w.denom());
    let rest = Integer::from(d - p);
    let mut term = Interval::from_i64(1, precision);
    let mut sum = Interval::from_i64(0, precision);
    for j in 0..MOST_TERMS {
        let above = Integer::from(&numbers.q + j) * p;
        let below = Integer::from(&numbers.s + j) * d;
        term = term.mul_integer(&above).div_integer(&below)?;
        sum = sum.add(&term);
        let tail = term.mul_integer(p).div_integer(&rest)?;
        if sketch::exponent(&tail) < -i64::from(precision) {
            let zero = Interval::from_i64(0, precision);
            return Ok(sum.add(&zero.hull(&tail)));
        }
    }
    Err(ShellError::Outside)
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let terms = sketch.pfaff_terms(f64::from(bits + GUARD));
    if terms > f64::from(MOST_TERMS) {
        return f64::INFINITY;
    }
    terms * sketch::interval_step(bits)
}
