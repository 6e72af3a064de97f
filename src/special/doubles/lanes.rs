//! Wide lanes: the same arithmetic for eight neighbours at a time, in whatever vectors the processor has.
//!
//! A [`Kernel`] is written once, over [`Wide`]. The compiler makes three programs of it: for the target that
//! it was told of (on plain x86-64, vectors of two numbers), for AVX2 and for AVX-512; which one runs is
//! asked of the processor. All do the same operations, each rounded to nearest (IEEE 754), none fused: so the
//! results have the same bits on every machine.

use std::array;
use std::fmt;
use std::ops::{Add, Div, Mul, Sub};

/// Photons computed together.
const WIDTH: usize = 8;

/// A number for each of some neighbours.
#[derive(Clone, Copy)]
pub(super) struct Wide([f64; WIDTH]);

/// A formula for the photons of one shell (or one layout).
pub(super) trait Kernel {
    /// `E_k - 1` and `Var_k` of the photons with these numbers: l, or k where a shell holds one photon.
    fn values(&self, photons: Wide) -> [Wide; 2];
}

/// A way to compute that this processor has; all give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lanes(Set);

/// Instruction sets. Only those that the processor has get into a [`Lanes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Set {
    Plain,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Lanes {
    /// What this processor has, the fastest last.
    ///
    /// ```
    /// use claimcheck::special::doubles::Lanes;
    /// assert_eq!(Lanes::available().last(), Some(Lanes::best()));
    /// ```
    pub fn available() -> impl Iterator<Item = Lanes> {
        let sets = [
            (true, Set::Plain),
            #[cfg(target_arch = "x86_64")]
            (is_x86_feature_detected!("avx2"), Set::Avx2),
            #[cfg(target_arch = "x86_64")]
            (is_x86_feature_detected!("avx512f"), Set::Avx512),
        ];
        sets.into_iter()
            .filter_map(|(has, set)| has.then_some(Lanes(set)))
    }

    /// The fastest.
    pub fn best() -> Lanes {
        Lanes::available().last().unwrap_or(Lanes(Set::Plain))
    }

    /// The values of the photons from `first` on, as many as the buffers hold.
    #[allow(unsafe_code)]
    pub(super) fn run<K: Kernel>(
        self,
        kernel: &K,
        first: f64,
        excess: &mut [f64],
        variance: &mut [f64],
    ) {
        let run: unsafe fn(&K, f64, &mut [f64], &mut [f64]) = match self.0 {
            Set::Plain => plain,
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => avx2,
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => avx512,
        };
        // SAFETY: `plain` is a safe function. The others ask for one thing only, that the processor has the
        // instructions they are named after; `Lanes::available` makes no value with them where it has not.
        unsafe { run(kernel, first, excess, variance) }
    }
}

impl fmt::Display for Lanes {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.pad(match self.0 {
            Set::Plain => "plain",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => "avx512",
        })
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
fn avx512<K: Kernel>(kernel: &K, first: f64, excess: &mut [f64], variance: &mut [f64]) {
    plain(kernel, first, excess, variance);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<K: Kernel>(kernel: &K, first: f64, excess: &mut [f64], variance: &mut [f64]) {
    plain(kernel, first, excess, variance);
}

/// The numbers of the photons are below 2^53, so that sums of them are exact.
#[inline(always)]
fn plain<K: Kernel>(kernel: &K, first: f64, excess: &mut [f64], variance: &mut [f64]) {
    let mut photons = Wide(array::from_fn(|lane| first + lane as f64));
    let step = Wide::all(WIDTH as f64);
    let (wide_excess, last_excess) = excess.as_chunks_mut();
    let (wide_variance, last_variance) = variance.as_chunks_mut();
    for (excess, variance) in wide_excess.iter_mut().zip(wide_variance) {
        let [e, v] = kernel.values(photons);
        (*excess, *variance) = (e.0, v.0);
        photons = photons + step;
    }
    if !last_excess.is_empty() {
        // The lanes past the end hold numbers that are no photons: their values are dropped.
        let [e, v] = kernel.values(photons);
        last_excess.copy_from_slice(&e.0[..last_excess.len()]);
        last_variance.copy_from_slice(&v.0[..last_variance.len()]);
    }
}

impl Wide {
    /// The same number for all.
    #[inline(always)]
    pub(super) fn all(number: f64) -> Wide {
        Wide([number; WIDTH])
    }

    /// The larger number of each pair.
    #[inline(always)]
    pub(super) fn max(self, other: Wide) -> Wide {
        self.with(other, f64::max)
    }

    #[inline(always)]
    fn with(self, other: Wide, operation: impl Fn(f64, f64) -> f64) -> Wide {
        let mut result = self.0;
        for (x, y) in result.iter_mut().zip(other.0) {
            *x = operation(*x, y);
        }
        Wide(result)
    }
}

macro_rules! operation {
    ($name:ident, $method:ident) => {
        impl $name for Wide {
            type Output = Wide;
            #[inline(always)]
            fn $method(self, other: Wide) -> Wide {
                self.with(other, f64::$method)
            }
        }
    };
}

operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);
operation!(Div, div);
