//! Tests of a simulation against theory. A declared error rate holds for every number of runs, not only in the
//! limit.
//!
//! For a photon with volume U the simulation sums `d = k/U - 1` and `d^2` ([`Sums`](super::Sums)); theory
//! knows the whole law of U ([`theory`]). What each test rests on:
//!
//! | test | asks | rate |
//! |---|---|---|
//! | [`battery`] | do the means of d and d^2 agree, for all photons at once? | Chernoff's inequality, Bonferroni: proved |
//! | [`kolmogorov`] | does U have its law? | Dvoretzky, Kiefer and Wolfowitz, Massart's constant: proved |
//! | [`sequential`] | the same as the battery, after any run one likes to look | Ville's inequality: proved |
//! | [`z`] | does any sample mean agree with a value? | the normal law, an approximation: for alarms |
//! | [`power`] | how many runs find a fault of a given size? | the normal law, an approximation: for planning |
//!
//! *Proved* is the inequality with the true cumulants. Those are computed here in doubles by a quadrature whose
//! error is tested, not proved; a slack of ten times the error seen is added on the safe side
//! ([`Law::cumulant`]). The rates further suppose independent runs whose sums are right to many more digits
//! than their own scatter.
//!
//! To agree is not to be proved: a fault smaller than the scatter is not seen ([`power`] says how small).

pub mod battery;
mod chernoff;
pub mod kolmogorov;
pub mod power;
pub mod sequential;
pub mod theory;
pub mod z;

pub use battery::{Report, battery};
pub use chernoff::two_sided;
pub use theory::{Expected, Law, Photon, Statistic, expected};

use crate::special::doubles::DoublesError;

/// Why there is no verdict.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// The layout has no such photon.
    #[error("the layout has no photon {0}")]
    NoPhoton(u64),
    /// Photons not in ascending order.
    #[error("photons must ascend, {0} does not")]
    Order(u64),
    /// No runs, no photons, or lists of different lengths.
    #[error("there must be runs, photons, and a sum of each kind for each photon")]
    Empty,
    /// A sum or a sample that is no number.
    #[error("a sum or sample of photon {0} is no number")]
    NotANumber(u64),
    /// A level outside (0, 1).
    #[error("a level lies between 0 and 1, {0} does not")]
    Level(f64),
    /// A relative fault that is no positive number.
    #[error("a relative fault is a positive number, {0} is not")]
    Fault(f64),
    /// A shell is out of reach.
    #[error(transparent)]
    Doubles(#[from] DoublesError),
}

/// A level as it must be.
fn checked_level(level: f64) -> Result<f64, Error> {
    match level > 0.0 && level < 1.0 {
        true => Ok(level),
        false => Err(Error::Level(level)),
    }
}

#[cfg(test)]
mod tests;
