//! Formulas for neighbouring photons, eight at a time.

use crate::number::{Lanes, Task, WIDTH, Wide};

/// A formula for the photons of one shell (or one layout).
pub(super) trait Kernel {
    /// `E_k - 1` and `Var_k` of the photons with these numbers: l, or k where a shell holds one photon.
    fn values(&self, photons: Wide) -> [Wide; 2];
}

/// The values of the photons from `first` on, as many as the buffers hold. Numbers of photons are below
/// 2^53, so that sums of them are exact.
pub(super) fn fill<K: Kernel>(
    lanes: Lanes,
    kernel: &K,
    first: f64,
    excess: &mut [f64],
    variance: &mut [f64],
) {
    lanes.run(Fill {
        kernel,
        first,
        excess,
        variance,
    });
}

struct Fill<'a, K> {
    kernel: &'a K,
    first: f64,
    excess: &'a mut [f64],
    variance: &'a mut [f64],
}

impl<K: Kernel> Task for Fill<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut photons = Wide::from(self.first);
        let step = Wide::all(WIDTH as f64);
        let (wide_excess, last_excess) = self.excess.as_chunks_mut();
        let (wide_variance, last_variance) = self.variance.as_chunks_mut();
        for (excess, variance) in wide_excess.iter_mut().zip(wide_variance) {
            let [e, v] = self.kernel.values(photons);
            (*excess, *variance) = (e.0, v.0);
            photons = photons + step;
        }
        if !last_excess.is_empty() {
            // The lanes past the end hold numbers that are no photons: their values are dropped.
            let [e, v] = self.kernel.values(photons);
            last_excess.copy_from_slice(&e.0[..last_excess.len()]);
            last_variance.copy_from_slice(&v.0[..last_variance.len()]);
        }
    }
}
