//! Monte-Carlo in f64, compared with theory by tests whose error rates are known.
//!
//! [`verdict`] says what follows from sums over runs.

pub mod verdict;

use serde::{Deserialize, Serialize};

/// What all runs of a simulation add up to: for each photon asked for, the sums of `d = k/U - 1` and of `d^2`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sums {
    /// How many runs.
    pub runs: u64,
    /// The ks, ascending.
    pub photons: Vec<u64>,
    /// For each the sum over the runs of d.
    pub deviation: Vec<f64>,
    /// For each the sum over the runs of d^2.
    pub square: Vec<f64>,
}
