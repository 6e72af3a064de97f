//! The two power series of F. What they are: `special::shell`, `direct.rs` and `pfaff.rs`.

use super::{Failure, MOST_STEPS, REST, Scene};

/// F at z = -V/Va: `t_(j+1) = -t_j (V/Va) (l+j)/(m+1+j)`.
pub(super) fn direct(scene: &Scene) -> Result<f64, Failure> {
    let ratio = scene.volume / scene.inner;
    let (l, s) = (scene.position, scene.s());
    let (mut term, mut sum) = (1.0f64, 1.0f64);
    for j in 0..MOST_STEPS {
        let j = f64::from(j);
        term *= -ratio * (l + j) / (s + j);
        sum += term;
        if !sum.is_finite() {
            return Err(Failure::Divergence);
        }
        if term.abs() <= REST * sum.abs() {
            return Ok(sum);
        }
    }
    // The ratio of neighbours tends to V/Va.
    Err(match ratio > 1.0 {
        true => Failure::Divergence,
        false => Failure::Cost,
    })
}

/// x = mean((Va+V)/U) - 1 at w = V/(Va+V): `T_(j+1) = T_j w (q+j)/(s+j)`, summed from T_1 on; the terms after T are
/// together at most `T w/(1-w)`.
pub(super) fn pfaff(scene: &Scene) -> Result<f64, Failure> {
    let (s, q) = (scene.s(), scene.q());
    let w = scene.volume / scene.outer();
    let tail = scene.volume / scene.inner;
    let (mut term, mut sum) = (1.0f64, 0.0f64);
    for j in 0..MOST_STEPS {
        let j = f64::from(j);
        term *= w * (q + j) / (s + j);
        sum += term;
        if term * tail <= REST * sum {
            return Ok(sum);
        }
    }
    Err(Failure::Cost)
}
