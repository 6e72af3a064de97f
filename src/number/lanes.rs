//! Wide lanes: the same arithmetic for eight neighbours at a time, in whatever vectors the processor has.
//!
//! A [`Task`] is written once. The compiler makes three programs of it: for the target that it was told of (on
//! plain x86-64, vectors of two numbers), for AVX2 and for AVX-512; which one runs is asked of the processor.
//! All do the same operations, each rounded to nearest (IEEE 754), none fused: so the results have the same
//! bits on every machine.

use std::array;
use std::fmt;
use std::ops::{Add, Div, Mul, Sub};

/// Numbers computed together.
pub const WIDTH: usize = 8;

/// A number for each of some neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wide(pub [f64; WIDTH]);

/// Work to do in wide lanes. `run`, and what it calls, must be `#[inline(always)]`: only what is inlined is compiled
/// for the wide vectors.
pub trait Task {
    /// What comes of it.
    type Output;
    /// Does the work.
    fn run(self) -> Self::Output;
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
    /// use claimcheck::number::Lanes;
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

    /// Does the work in these lanes.
    #[allow(unsafe_code)]
    pub fn run<T: Task>(self, task: T) -> T::Output {
        let run: unsafe fn(T) -> T::Output = match self.0 {
            Set::Plain => T::run,
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => avx2,
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => avx512,
        };
        // SAFETY: `T::run` is a safe function. The others ask for one thing only, that the processor has the
        // instructions they are named after; `Lanes::available` makes no value with them where it has not.
        unsafe { run(task) }
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
fn avx512<T: Task>(task: T) -> T::Output {
    task.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<T: Task>(task: T) -> T::Output {
    task.run()
}

impl Wide {
    /// The same number for all.
    #[inline(always)]
    pub fn all(number: f64) -> Wide {
        Wide([number; WIDTH])
    }

    /// `first`, `first + 1`, and so on.
    #[inline(always)]
    pub fn from(first: f64) -> Wide {
        Wide(array::from_fn(|lane| first + lane as f64))
    }

    /// The larger number of each pair.
    #[inline(always)]
    pub fn max(self, other: Wide) -> Wide {
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
