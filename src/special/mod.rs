//! Special functions with proved enclosures: Gauss's hypergeometric function, quotients of Gamma
//! functions, Beta, binomial coefficients and Pochhammer's symbol.
//!
//! Arguments are intervals; the answer holds every value that the function takes on them. A
//! [`DomainError`] says why there is none: `Certain` where the function has no value, `Possible`
//! where a pole may lie inside or the method's cap of work was reached.
//!
//! The means and variances of the model have methods of their own, several for each job and a choice
//! among them: [`shell`] for a photon of a shell, [`sweep`] for all photons of a range, [`doubles`] for
//! ranges of any length in f64 with proved bounds, [`one`] for strategy 1's logarithms, [`ratio`] for `Gamma(x)/Gamma(y)`.
//!
//! [`DomainError`]: crate::number::DomainError

pub mod doubles;
mod family;
mod gamma_quotient;
mod hyp2f1;
pub mod one;
mod pochhammer;
pub mod ratio;
pub mod shell;
pub mod sweep;

pub use family::hyp2f1_rational;
pub use gamma_quotient::{beta, gamma_quotient};
pub use hyp2f1::{hyp2f1, hyp2f1_regularized};
pub use pochhammer::{binomial, pochhammer};
pub use ratio::{gamma_ratio, gamma_ratio_exact};

use crate::number::Interval;
use rug::Integer;

/// Bits whose unit is below 10^-digits: at least digits*log2(10), which is below 3.32193.
fn digits_to_bits(digits: u32) -> u32 {
    let bits = (u64::from(digits) * 332_193).div_ceil(100_000);
    bits.try_into().unwrap_or(u32::MAX / 4)
}

/// n where the interval is the point -n, n = 0, 1, 2, ...
fn nonpositive_integer(x: &Interval) -> Option<Integer> {
    x.as_integer().filter(|n| n.cmp0().is_le()).map(|n| -n)
}

/// Whether 0, -1, -2, ... may lie in the interval.
fn may_be_pole(x: &Interval) -> bool {
    *x.low() <= 0
        && x.min(&Interval::from_i64(0, x.precision()))
            .may_hold_integer()
}

/// All intervals with ends of `precision` bits, rounded outwards; a point that fits stays the same.
fn widen<const N: usize>(values: [&Interval; N], precision: u32) -> [Interval; N] {
    values.map(|x| x.with_precision(precision))
}
