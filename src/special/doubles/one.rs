//! Shells of one photon each (strategy 1), by the two positive series of [`crate::special::one`].
//!
//! With t = 1/(2k-1), p = t^2 and the numbers d_j there (`series.rs`, with the proofs),
//!
//! ```text
//! E - 1 = t (1 + t (1+t) sigma),   sigma = sum of p^(j-1)/(2j+1),   j >= 1,
//! Var   = (t (1+t))^2 tau,         tau   = sum of d_j p^(j-1).
//! ```
//!
//! **Theorem.** For 16 <= k <= 2^51, with six terms each by Horner's rule and one division, E - 1 is
//! computed within 3.1 u and Var within 10.2 u, relative to the result, u = 2^-53. Proof. In the words of
//! `moments.rs`: 2k-1 is exact, so t has the count 1, p 3. Let t <= 1/31, p <= 1/961. The i-th term of either
//! sum (i = 0 the first) has a constant rounded once, i factors p, i products and i+1 sums: the count 2 + 5i
//! at most. It is below 3 p^i times the sum, for the first term is 1/3 and all coefficients are below 1; so
//! sigma and tau have `2 + sum of 15 i p^i < 2.02`. g = 1+t has 1 + t < 1.04. h = t g has 1 + 1.04 + 1 = 3.04
//! and is below 0.034, h sigma 6.06 and is below 0.012, as sigma < 0.334. 1 + h sigma then has 1 + 6.06 *
//! 0.012 < 1.08, and E - 1 has 1 + 1.08 + 1 = 3.08. h^2 has 7.08, Var 7.08 + 2.02 + 1 = 10.1. What the sums
//! lack is below `3 p^6/(1-p) < 0.035 u` of them: 10.135 for Var, 3.09 for E - 1. The rest of 10.2 and 3.1
//! covers the products of errors (all counts are below 30) and that the bounds are multiples of the result.
//! Nothing under- or overflows: all numbers that matter lie between 2^-110 and 2; p^5 d_6 and all else that
//! is added lies above 2^-600. QED.

use super::Bounds;
use super::kernel::Kernel;
use crate::number::Wide;

/// The first photon of the theorem.
pub(super) const FIRST: u64 = 16;

/// How many photons from `first` on can be served in one way.
pub(super) fn room(first: u64) -> u64 {
    if first < FIRST {
        FIRST - first
    } else {
        u64::MAX
    }
}

/// What the theorem says.
pub(super) const BOUNDS: Bounds = Bounds {
    excess: 3.1 * f64::EPSILON / 2.0,
    variance: 10.2 * f64::EPSILON / 2.0,
};

/// `1/(2j+1)`, the last first.
const SIGMA: [f64; 6] = [
    1.0 / 13.0,
    1.0 / 11.0,
    1.0 / 9.0,
    1.0 / 7.0,
    1.0 / 5.0,
    1.0 / 3.0,
];

/// d_j, the last first; `tests.rs` has their recurrence.
const TAU: [f64; 6] = [
    227_246.0 / 315_315.0,
    7_141.0 / 10_395.0,
    1_012.0 / 1_575.0,
    61.0 / 105.0,
    22.0 / 45.0,
    1.0 / 3.0,
];

/// The kernel; its photons have the numbers k.
pub(super) struct One;

impl Kernel for One {
    #[inline(always)]
    fn values(&self, k: Wide) -> [Wide; 2] {
        let one = Wide::all(1.0);
        let t = one / (k + (k - one));
        let p = t * t;
        let sum = |coefficients: [f64; 6]| {
            let next = |sum, next| Wide::all(next) + p * sum;
            coefficients.into_iter().fold(Wide::all(0.0), next)
        };
        let h = t * (one + t);
        [t * (one + h * sum(SIGMA)), h * h * sum(TAU)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    #[test]
    fn the_constants_are_those_of_the_series() {
        let mut d = Rational::from((1, 3));
        for (index, constant) in TAU.into_iter().rev().enumerate() {
            let j = index as u32 + 1;
            if j > 1 {
                d = (d * j + Rational::from((2 * j, 2 * j + 1))) / (j + 1);
            }
            assert_eq!(
                Rational::from(d.numer()).to_f64() / d.denom().to_f64(),
                constant
            );
        }
    }
}
