//! The contiguous relation from the first photon of the shell upwards (see `contiguous`).
//!
//! Domain: `Va > 0`, at most 2^17 steps. The error of the first F is multiplied by
//! `prod (m-i)/(c i)`, i < l, which grows until `l = m/(1+c)`: about m bits are lost there, and regained at
//! the far end. A method that shows why to start in the middle.

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
    contiguous::walk(quantities, shell, 1.into(), bits)
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let bits = bits.saturating_add(sketch.walk_loss(1.0, sketch.l) as u32);
    contiguous::cost(sketch, sketch.l - 1.0, bits)
}
