//! The power series of F itself, DLMF 15.2.1, at z = -V/Va:
//!
//! ```text
//! F = sum of (-1)^j t_j,     t_0 = 1,  t_(j+1) = t_j (V/Va) (l+j)/(m+1+j)
//! ```
//!
//! Domain: `V < Va`. In strategy 2 that is m > 3: for m = 2 the terms grow, for m = 3 they fall like a power of
//! 1/j, too slowly for any digits. Cost: bits/log2(Va/V) terms.
//!
//! Theorem. F lies between any two successive partial sums. Proof. `t_j > 0` fall to 0, since l < m+1 and
//! V < Va: Leibniz's criterion.

use super::quantity::{Numbers, Quantity};
use super::sketch::{self, Sketch};
use super::{ShellError, pfaff::MOST_TERMS};
use crate::model::Shell;
use crate::number::Interval;
use rug::{Integer, Rational};

/// Bits for the rounding errors of the terms.
const GUARD: u32 = 24;

pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    let numbers = Numbers::new(shell);
    if shell.volume >= shell.inner {
        return Err(ShellError::Outside);
    }
    numbers.by_function(quantities, &function(shell, bits + GUARD)?)
}

fn function(shell: &Shell, precision: u32) -> Result<Interval, ShellError> {
    let ratio = Rational::from(&shell.volume / &shell.inner);
    let s = Integer::from(&shell.count + 1u32);
    let mut term = Interval::from_i64(1, precision);
    let mut sum = term.clone();
    for j in 0..MOST_TERMS {
        let above = Integer::from(&shell.position + j) * ratio.numer();
        let below = Integer::from(&s + j) * ratio.denom();
        term = term.mul_integer(&above).div_integer(&below)?.neg();
        let next = sum.add(&term);
        if sketch::exponent(&term) < -i64::from(precision) {
            return Ok(sum.hull(&next));
        }
        sum = next;
    }
    Err(ShellError::Outside)
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let terms = sketch.direct_terms(f64::from(bits + GUARD));
    if terms > f64::from(MOST_TERMS) {
        return f64::INFINITY;
    }
    terms * sketch::interval_step(bits)
}
