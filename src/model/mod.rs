//! The one model behind every formula of the thesis: the volume up to photon k.
//!
//! ```text
//! U = Va + V*x,   x ~ Beta(l, m-l+1),   1 <= l <= m,   Va >= 0,   V > 0
//! ```
//!
//! Photon k is the l-th of the m photons of its shell, `Va` is the volume inside the shell and `V`
//! the shell's own, in units in which a photon has volume 1. A [`Layout`] says which shell holds
//! photon k; [`moments`] gives the exact means of `k/U` and `(k/U)^2`.
//! The dimension d never enters: `u = r^d` takes it away.

mod layout;
mod moments;
mod walk;

pub use layout::Layout;
pub use moments::{LogLinear, Moment, MomentError, Moments, mean_reciprocal, moments};
pub use walk::Walk;

use rug::{Integer, Rational};

/// The shell that holds a photon, and the photon's place in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shell {
    /// `Va >= 0`, the volume inside the shell.
    pub inner: Rational,
    /// `V > 0`, the volume of the shell itself.
    pub volume: Rational,
    /// `l`: the photon is the l-th nearest of its shell, from 1.
    pub position: Integer,
    /// `m`: how many photons the shell holds.
    pub count: Integer,
}
