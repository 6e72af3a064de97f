//! Any photons at all, by [`sweep`](crate::special::sweep::sweep) and one rounding.
//!
//! **Theorem.** Let v lie in an interval [x, y] with 0 < x and y <= x (1 + 2^-60). Then
//! `|fl(x) - v| <= 1.02 u fl(x)`, u = 2^-53. Proof. `|fl(x) - x| <= u fl(x)` (Higham, theorem 2.3), so
//! x <= (1+u) fl(x), and `|x - v| <= 2^-60 x = 2^-7 u x`. QED. The sweep's 20 digits, enclosed with 100 bits,
//! are narrower than that.

use super::{Bounds, DoublesError};
use crate::model::Layout;
use crate::special::sweep::{Value, sweep};

const DIGITS: u32 = 20;
const PRECISION: u32 = 100;

/// What the theorem says.
const BOUNDS: Bounds = Bounds {
    excess: 1.02 * f64::EPSILON / 2.0,
    variance: 1.02 * f64::EPSILON / 2.0,
};

/// The values of the photons of a layout from `first` on, as many as the buffers hold.
pub(super) fn fill(
    layout: &Layout,
    first: u64,
    excess: &mut [f64],
    variance: &mut [f64],
) -> Result<Bounds, DoublesError> {
    let mut places = excess.iter_mut().zip(variance);
    let last = first + places.len() as u64 - 1;
    for block in sweep(layout, &first.into(), &last.into(), DIGITS) {
        let block = block?;
        for (photon, (excess, variance)) in block.photons().zip(&mut places) {
            *excess = round(photon.excess());
            *variance = round(photon.variance());
        }
    }
    Ok(BOUNDS)
}

fn round(value: Option<Value>) -> f64 {
    value.map_or(f64::INFINITY, |value| {
        value.enclose(PRECISION).low().to_f64()
    })
}
