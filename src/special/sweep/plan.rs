//! How many bits a block needs, and the bounds of its errors: before anything is computed.
//!
//! All numbers are multiples of the ulp 2^-scale. The start is within [`START`] ulps, so that after n
//! steps the theorem of the parent gives every g to `G = START + min(n, J)` ulps, and e = k g - 1 to k G.
//!
//! **Bounds of the values**, a >= 1, b = a + m. C of equation (2) is `2 a b + k (a (m-1) + (l-1) m)`, and with
//! k >= a that is at least `a^2 (m+1) + a m (l+1) > l a b`. As Var_k >= 0, (2) gives `e <= l b/C < 1/a`. And with
//! U' independent of U, `Var_k = k^2/2 * mean of (U-U')^2/(U U')^2`, so that
//! `k^2 s2/b^4 <= Var_k <= k^2 s2/a^4`, where `s2 = m^2 l (m+1-l)/((m+1)^2 (m+2))` is the variance of U (DLMF 5.12.1).
//! By Jensen's inequality `e >= k/mu - 1 > l/((m+1) b)`, mu = k - l/(m+1) < b the mean of U.
//!
//! **Errors.** An error of k G ulps in e changes C e/D by (C/D) k G, and e^2 by less than
//! `(2 e + k G ulp) k G < 3 k G`. Rounding adds three ulps at most. So Var_k by (2) is within `(C/D + 3) k G + 3`
//! ulps; this and k G grow with k, and those of the last photon hold for all.

use crate::model::Shell;
use crate::special::digits_to_bits;
use rug::Integer;

/// The start of a block is within so many ulps.
pub(super) const START: u32 = 3;

/// Neighbours in one shell of `size` = m photons and volume m around the volume `inner` = a. The first
/// of them is the one at `position`.
pub(super) struct Neighbours {
    pub(super) inner: Integer,
    pub(super) size: Integer,
    pub(super) position: Integer,
    pub(super) count: usize,
}

/// The precision of a block.
#[derive(Clone)]
pub(super) struct Plan {
    /// An ulp is at most 2^-scale.
    pub(super) scale: u32,
    /// Bounds of the errors of e and of the variance.
    pub(super) excess_ulps: Integer,
    pub(super) variance_ulps: Integer,
    /// How many photons of the block lie before the one to start from.
    pub(super) start: usize,
}

impl Neighbours {
    pub(super) fn new(shell: &Shell, count: usize) -> Neighbours {
        Neighbours {
            inner: shell.inner.numer().clone(),
            size: shell.count.clone(),
            position: shell.position.clone(),
            count,
        }
    }

    /// b = a + m
    pub(super) fn outer(&self) -> Integer {
        Integer::from(&self.inner + &self.size)
    }

    /// l of the photon at an index.
    pub(super) fn place(&self, index: usize) -> Integer {
        Integer::from(&self.position + index as u64)
    }

    fn last(&self) -> Integer {
        self.place(self.count - 1)
    }

    /// l (m+1-l) where it is least: at one of the ends.
    fn spread(&self) -> Integer {
        let at = |l: Integer| {
            let other = Integer::from(&self.size - &l) + 1u32;
            l * other
        };
        at(self.position.clone()).min(at(self.last()))
    }

    /// The least l >= l* = m a/(2a+m), or what of the block is nearest to it, as an index.
    fn middle(&self) -> usize {
        let below = Integer::from(&self.inner * 2u32) + &self.size;
        let middle = Integer::from(&self.size * &self.inner)
            .div_rem_ceil(below)
            .0;
        let steps = Integer::from(&middle - &self.position);
        steps
            .clamp(&Integer::new(), &Integer::from(self.count - 1))
            .to_usize_wrapping()
    }
}

/// C of equation (2).
pub(super) fn slope(a: &Integer, m: &Integer, l: &Integer) -> Integer {
    let (k, b) = (Integer::from(a + l), Integer::from(a + m));
    let bracket = Integer::from(&k * m) - &b;
    Integer::from(a * &b) * 2u32 + k * bracket
}

impl Plan {
    /// The same with more bits.
    pub(super) fn with_scale(&self, scale: u32) -> Plan {
        Plan {
            scale,
            ..self.clone()
        }
    }

    pub(super) fn new(block: &Neighbours, digits: u32) -> Plan {
        let (a, m, l, b) = (&block.inner, &block.size, block.last(), block.outer());
        let steps = ceil_sqrt(m).min(Integer::from(block.count));
        let excess_ulps = (steps + START) * Integer::from(a + &l);
        let slope = slope(a, m, &l) + Integer::from(a * &b) * 3u32;
        let variance_ulps = Integer::from(&slope * &excess_ulps)
            .div_rem_ceil(Integer::from(a * &b))
            .0
            + 3u32;
        // Twice each error is to be below half of 10^-digits of the least value.
        let bits = digits_to_bits(digits) + 2;
        let excess = excess_ulps.significant_bits()
            + Integer::from(m + 1u32).significant_bits()
            + b.significant_bits()
            - (block.position.significant_bits() - 1);
        let k = Integer::from(a + &block.position);
        let variance = variance_ulps.significant_bits()
            + Integer::from(m + 2u32).significant_bits()
            + 2
            + 4 * b.significant_bits()
            - 2 * (k.significant_bits() - 1)
            - (block.spread().significant_bits() - 1);
        Plan {
            scale: bits + excess.max(variance),
            excess_ulps,
            variance_ulps,
            start: block.middle(),
        }
    }
}

/// The least J with J^2 >= m.
fn ceil_sqrt(m: &Integer) -> Integer {
    Integer::from(m - 1u32).sqrt() + 1u32
}
