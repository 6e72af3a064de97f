//! `-k ln(1 - 1/k)` by a logarithm that takes the 1/k: its relative error is the argument's, so S loses nothing,
//! S - 1, about 1/(2k), log2 2k bits, and T, about 1/(12 k^2), 2 log2 k + 4 bits.

use super::{Values, from_logarithm, logarithm_cost};
use crate::number::Interval;
use rug::Integer;

/// The bits to work with.
fn working(k: &Integer, bits: u32) -> u32 {
    bits + 2 * k.significant_bits() + 12
}

pub(super) fn cost(k: &Integer, bits: u32) -> f64 {
    logarithm_cost(working(k, bits))
}

pub(super) fn values(k: &Integer, bits: u32) -> Option<Values> {
    let one = Interval::from_i64(1, working(k, bits));
    let small = one.div_integer(k).ok()?.neg();
    from_logarithm(k, &small.ln_1p().ok()?.neg(), bits)
}
