//! From places inside a shell to volumes and to the estimator.

use super::root::cube_root;
use super::scene::{Fault, Scene};
use super::stream::{LANES, Row};

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

    /// What is stored of photons at `share` of these volumes past the inner edge.
    #[inline(always)]
    pub(super) fn store(&self, volumes: &Row, share: &Row) -> Row {
        let mut row = Row::all(0.0);
        for lane in 0..LANES {
            row.0[lane] = volumes.0[lane] * share.0[lane];
        }
        match self.dimension {
            None => row,
            Some(d) => self.radii(row, d),
        }
    }

    /// The radii of photons at these volumes past the inner edge.
    #[inline(always)]
    fn radii(&self, mut past: Row, d: u32) -> Row {
        for past in &mut past.0 {
            *past += self.inner;
        }
        match d {
            1 => past,
            2 => past.each(f64::sqrt),
            3 => past.each(cube_root),
            d => past.each(|volume| volume.powf(1.0 / f64::from(d))),
        }
    }

    /// U of photons.
    #[inline(always)]
    pub(super) fn volumes(&self, stored: &Row) -> Row {
        match self.dimension {
            None => stored.each(|past| self.inner + past),
            Some(1) => *stored,
            Some(2) => stored.each(|radius| radius * radius),
            Some(3) => stored.each(|radius| radius * radius * radius),
            Some(d) => stored.each(|radius| power(radius, d)),
        }
    }

    /// `k/U - 1 = (k - U)/U` of the l-th photon.
    ///
    /// Where U alone is drawn, `k - U = l - V*x`, without the cancellation of Va.
    #[inline(always)]
    pub(super) fn deviations(&self, l: f64, stored: &Row) -> Row {
        let past = l + self.shift;
        if self.dimension.is_some() {
            return self.radial_deviations(past, stored);
        }
        let inner = self.inner;
        let mut row = Row::all(0.0);
        for lane in 0..LANES {
            row.0[lane] = (past - stored.0[lane]) / (inner + stored.0[lane]);
        }
        row
    }

    #[inline(always)]
    fn radial_deviations(&self, past: f64, radii: &Row) -> Row {
        let k = self.inner + past;
        self.volumes(radii).each(|volume| (k - volume) / volume)
    }
}

/// `r^d`, by repeated squaring.
fn power(radius: f64, d: u32) -> f64 {
    let (mut power, mut square, mut rest) = (1.0, radius, d);
    while rest > 0 {
        if rest % 2 == 1 {
            power *= square;
        }
        square *= square;
        rest /= 2;
    }
    power
}
