//! `k ln(k/(k-1))` as it stands. The quotient is rounded near 1, by 2^-P: the logarithm, about 1/k, keeps
//! P - log2 k bits, and so does S; S - 1, about 1/(2k), log2 2k fewer; T, about 1/(12 k^2), 2 log2 k + 4 fewer than S.

use super::{Values, from_logarithm, logarithm_cost};
use crate::number::Interval;
use rug::Integer;

/// The bits to work with.
fn working(k: &Integer, bits: u32) -> u32 {
    bits + 3 * k.significant_bits() + 12
}

pub(super) fn cost(k: &Integer, bits: u32) -> f64 {
    logarithm_cost(working(k, bits))
}

pub(super) fn values(k: &Integer, bits: u32) -> Option<Values> {
    let point = Interval::from_integer(k, working(k, bits));
    let ratio = point.div_integer(&Integer::from(k - 1u32)).ok()?;
    from_logarithm(k, &ratio.ln().ok()?, bits)
}
