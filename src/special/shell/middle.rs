//! The contiguous relation from the middle of the shell outwards (see `contiguous`): from
//! `l0 = m/(1+c)`, where its two multipliers are 1 in size, no error grows either way.
//!
//! Domain: `Va > 0`, at most 2^17 steps. The way to do whole shells; for one photon it costs the steps to it
//! beside the series that it starts with.

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
    contiguous::walk(quantities, shell, contiguous::middle(shell), bits)
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    contiguous::cost(sketch, (sketch.l - sketch.middle()).abs(), bits)
}
