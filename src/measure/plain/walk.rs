//! The contiguous relation along the shell, `(m-l) F_l + c l F_(l+1) = m` with c = (Va+V)/Va (`special::shell`,
//! `contiguous.rs`).

use super::{Failure, MOST_STEPS, Scene};
use crate::special::shell::{Quantity, enclose};

/// Digits that round to the nearest double, but for rare ties.
const DIGITS: u32 = 25;

/// F of the scene's photon from that of photon `start`, correctly rounded.
pub(super) fn function(scene: &Scene, start: f64) -> Result<f64, Failure> {
    let there = Scene {
        position: start,
        ..*scene
    };
    let shell = there.shell().ok_or(Failure::Refusal)?;
    let known = enclose(Quantity::Function, &shell, DIGITS).map_err(|_| Failure::Refusal)?;
    let mut f = known.midpoint().to_f64();
    let (m, c) = (scene.count, scene.outer() / scene.inner);
    let mut l = start;
    for _ in 0..MOST_STEPS {
        if !f.is_finite() {
            return Err(Failure::Overflow);
        }
        if l < scene.position {
            f = (m - (m - l) * f) / (c * l);
            l += 1.0;
        } else if l > scene.position {
            l -= 1.0;
            f = (m - c * l * f) / (m - l);
        } else {
            return Ok(f);
        }
    }
    Err(Failure::Cost)
}

/// The photon from which errors shrink both ways, `m Va/(2 Va + V)` rounded into 1..m.
pub(super) fn middle(scene: &Scene) -> f64 {
    let exact = scene.count * scene.inner / (2.0 * scene.inner + scene.volume);
    exact.round().clamp(1.0, scene.count)
}
