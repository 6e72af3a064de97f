//! From places inside a shell to volumes and to the estimator.

use super::scene::{Fault, Scene};
use crate::number::Wide;

/// A shell as the estimator sees it.
///
/// What is stored of a photon is `V*x`, its volume past the shell's inner edge; in d dimensions its radius,
/// `(Va + V*x)^(1/d)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Va
    pub(super) inner: f64,
    /// V
    pub(super) volume: f64,
    /// What is added to l to have the estimator's k less Va: 0 but for faults.
    shift: f64,
    dimension: Option<u32>,
}

impl Place {
    /// The shell of this volume around another.
    pub(super) fn new(scene: &Scene, inner: f64, volume: f64) -> Place {
        let dimension = scene.dimension;
        match scene.fault {
            Some(Fault::Biased) => {
                let kept = 1.0 - Fault::BIAS;
                Place {
                    inner: inner * kept,
                    volume: volume * kept,
                    shift: inner * Fault::BIAS,
                    dimension,
                }
            }
            fault => Place {
                inner,
                volume,
                shift: if fault == Some(Fault::Estimator) {
                    -1.0
                } else {
                    0.0
                },
                dimension,
            },
        }
    }

    /// What is stored of photons at the volumes `past` the inner edge.
    #[inline(always)]
    pub(super) fn stored(&self, past: Wide) -> Wide {
        match self.dimension {
            None => past,
            Some(d) => radii(Wide::all(self.inner) + past, d),
        }
    }

    /// U of photons.
    #[inline(always)]
    pub(super) fn volumes(&self, stored: Wide) -> Wide {
        match self.dimension {
            None => Wide::all(self.inner) + stored,
            Some(d) => powers(stored, d),
        }
    }

    /// `k/U - 1 = (k - U)/U` of the l-th photon.
    ///
    /// Where U alone is drawn, `k - U = l - V*x`, without the cancellation of Va.
    #[inline(always)]
    pub(super) fn deviations(&self, l: f64, stored: Wide) -> Wide {
        let k_past = l + self.shift;
        let volumes = self.volumes(stored);
        match self.dimension {
            None => (Wide::all(k_past) - stored) / volumes,
            Some(_) => (Wide::all(self.inner + k_past) - volumes) / volumes,
        }
    }
}

/// `U^(1/d)`
#[inline(never)]
fn radii(volumes: Wide, d: u32) -> Wide {
    let exponent = 1.0 / f64::from(d);
    Wide(volumes.0.map(|volume| match d {
        1 => volume,
        2 => volume.sqrt(),
        3 => volume.cbrt(),
        _ => volume.powf(exponent),
    }))
}

/// `r^d`, by repeated squaring.
#[inline(never)]
fn powers(radii: Wide, d: u32) -> Wide {
    let mut square = radii;
    let mut power = Wide::all(1.0);
    let mut rest = d;
    while rest > 0 {
        if rest % 2 == 1 {
            power = power * square;
        }
        square = square * square;
        rest /= 2;
    }
    power
}
