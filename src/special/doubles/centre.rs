//! The innermost shell: the volume around it is 0, k = l, and the values are rational (`centre.rs` of
//! [`crate::special::sweep`]):
//!
//! ```text
//! E - 1 = 1/(k-1),     Var = k^2 (m-k+1)/((k-2) (k-1)^2 m);     infinite for k = 1, the variance for k = 2.
//! ```
//!
//! **Theorem.** Computed as they stand, for m <= 2^50, within u and 6 u of the values, u = 2^-53; infinite
//! values are `+inf`. Proof. All differences are exact; there is one quotient in the mean, and in the
//! variance two roundings above, three below and the quotient: theta_6 by Higham's lemma 3.1 (see
//! `moments.rs`). All lies between 2^-200 and 2^200. With k-2 taken as 0 for k = 1 both denominators are +0
//! exactly where the values are infinite, the numerators positive. QED. [`BOUNDS`] has a little more, for the
//! gamma_c and as they are multiples of the result.

use super::Bounds;
use super::kernel::Kernel;
use crate::number::Wide;

/// What the theorem says.
pub(super) const BOUNDS: Bounds = Bounds {
    excess: 1.001 * f64::EPSILON / 2.0,
    variance: 6.001 * f64::EPSILON / 2.0,
};

/// The kernel of a shell of `size` photons.
pub(super) struct Centre {
    pub(super) size: f64,
}

impl Kernel for Centre {
    #[inline(always)]
    fn values(&self, k: Wide) -> [Wide; 2] {
        let [one, two, size] = [1.0, 2.0, self.size].map(Wide::all);
        let before = k - one;
        let above = k * k * (size - before);
        let below = (k - two).max(Wide::all(0.0)) * (before * before) * size;
        [one / before, above / below]
    }
}
