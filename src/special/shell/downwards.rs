//! The contiguous relation from the last photon of the shell downwards (see `contiguous`).
//!
//! Domain: `Va > 0`, at most 2^17 steps. The error of the last F is multiplied by
//! `prod c i/(m-i)`, l <= i < m, which grows until `l = m/(1+c)`: about m bits are lost there.

use super::quantity::Quantity;
use super::sketch::Sketch;
use super::{ShellError, contiguous};
use crate::model::Shell;
use crate::number::Interval;

pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    contiguous::walk(quantities, shell, shell.count.clone(), bits)
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let last = sketch.s - 1.0;
    let bits = bits.saturating_add(sketch.walk_loss(sketch.l, last) as u32);
    contiguous::cost(sketch, last - sketch.l, bits)
}
