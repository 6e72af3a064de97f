//! E and the variance of a photon in a shell, and the function behind them: every method known, and
//! the choice among them.
//!
//! Photon k is the l-th of m in a shell of volume V around the volume Va, `k = Va + l`:
//!
//! ```text
//! U = Va + V x,  x ~ Beta(l, m-l+1),     F = 2F1(1, l; m+1; -V/Va) = mean(Va/U),
//! E = mean(k/U) = k F/Va,     Var = var(k/U)
//! ```
//!
//! [`enclose`] gives the digits asked for by the method that it expects to be cheapest. Each
//! [`Method`] stands in a file of its own, with its domain, its error bound as a theorem, and its
//! cost; where a method loses digits its interval is wide, where it has no answer it says so.
//!
//! ```
//! use claimcheck::model::Layout;
//! use claimcheck::special::shell::{Quantity, enclose};
//! // Photon 10^12 of strategy 2: the thesis's formula 2.104 has no digit left in doubles.
//! let shell = Layout::Triangular.shell(&1_000_000_000_000u64.into()).expect("a photon");
//! let variance = enclose(Quantity::Variance, &shell, 15).expect("it has one");
//! assert!(variance.agrees_to(15));
//! assert_eq!(variance.to_decimal(5), "8.2707e-20");
//! ```

mod choice;
mod contiguous;
mod direct;
mod downwards;
mod euler;
mod exact;
mod method;
mod middle;
mod moments;
mod pfaff;
mod quantity;
mod scene;
mod sketch;
mod splitting;
mod thesis;
mod upwards;
mod words;

pub use choice::{choose, enclose, enclose_all};
pub use method::Method;
pub use quantity::Quantity;

use crate::number::DomainError;

/// Why there is no enclosure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum ShellError {
    /// No shell of the model; those of a [`crate::model::Layout`] all are.
    #[error("a shell needs 1 <= l <= m, Va >= 0 and V > 0")]
    NoShell,
    /// The method does not converge for this shell, or not within its cap of work.
    #[error("the shell lies outside the method's domain")]
    Outside,
    /// The working precision does not tell the value from 0.
    #[error("the working precision does not suffice")]
    Lost,
    /// The quantity has no value: a mean that is infinite, F for `Va = 0`.
    #[error(transparent)]
    Domain(#[from] DomainError),
}

#[cfg(test)]
mod tests;
