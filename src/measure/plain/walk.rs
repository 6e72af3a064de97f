//! The contiguous relation along the shell, `(m-l) F_l + c l F_(l+1) = m` with c = (Va+V)/Va (`special::shell`,
//! `contiguous.rs`).

use super::{Failure, MOST_STEPS, Scene, series};
use crate::special::shell::Quantity;

/// F of the scene's photon from that of photon `start`, which Pfaff's series gives.
pub(super) fn function(scene: &Scene, start: f64) -> Result<f64, Failure> {
    if (start - scene.position).abs() > f64::from(MOST_STEPS) {
        return Err(Failure::Cost);
    }
    let there = Scene {
        position: start,
        ..*scene
    };
    let mut f = there.by_pfaff(Quantity::Function, series::pfaff(&there)?);
    let (m, c) = (scene.count, scene.outer() / scene.inner);
    let mut l = start;
    while l < scene.position {
        f = (m - (m - l) * f) / (c * l);
        l += 1.0;
    }
    while l > scene.position {
        l -= 1.0;
        f = (m - c * l * f) / (m - l);
    }
    Ok(f)
}

/// The photon from which errors shrink both ways, `m Va/(2 Va + V)` rounded into 1..m.
pub(super) fn middle(scene: &Scene) -> f64 {
    let exact = scene.count * scene.inner / (2.0 * scene.inner + scene.volume);
    exact.round().clamp(1.0, scene.count)
}
