//! How many runs find a fault of a given size: a plan, by the normal law, that tests compare with what happens.
//!
//! The fault makes every k/U larger by the factor 1 + e, so the mean of d moves by `e E_k`, which is
//! `e E_k sqrt(R/Var_k)` standard errors after R runs. The battery needs about `sqrt(2 ln(2 N/a))` of them for one of
//! N tests at the family-wise level a (Chernoff's bound for the normal law), and the normal quantile of the
//! power on top. One photon is enough: the one with the least `Var_k/E_k^2`.

use super::battery::critical;
use super::theory::{Expected, expected};
use super::{Error, checked_level};
use crate::model::Layout;
use serde::{Deserialize, Serialize};

/// A standard normal variate is larger than the negative of this with probability 0.99.
const QUANTILE: f64 = 2.326_347_874_040_841;

/// How to find a fault.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// So many runs find it with probability about 0.99.
    pub runs: u64,
    /// The photon that shows it first.
    pub k: u64,
}

/// The runs after which the battery over the photons `ks` finds that every k/U is larger by the factor
/// `1 + fault`.
///
/// ```
/// use claimcheck::model::Layout;
/// use claimcheck::simulate::verdict::power::plan;
/// // Strategy 2, 21 photons: the last has a standard deviation of 3.9 %.
/// let ks: Vec<u64> = (1..=21).collect();
/// let plan = plan(&Layout::Triangular, &ks, 1e-6, 1e-3)?;
/// assert_eq!(plan.k, 21);
/// assert!(105_000 < plan.runs && plan.runs < 106_000);
/// # Ok::<(), claimcheck::simulate::verdict::Error>(())
/// ```
///
/// # Errors
/// [`Error`]: no photons, or none with a variance; photons that the layout has not, a level outside (0, 1), a
/// fault that is not positive.
pub fn plan(layout: &Layout, ks: &[u64], level: f64, fault: f64) -> Result<Plan, Error> {
    if !(fault > 0.0 && fault.is_finite()) {
        return Err(Error::Fault(fault));
    }
    let share = checked_level(level)? / (2.0 * ks.len() as f64);
    let spread = |photon: &Expected| photon.variance / (1.0 + photon.excess).powi(2);
    let theory = expected(layout, ks)?;
    let best = theory
        .iter()
        .filter(|photon| photon.variance.is_finite())
        .min_by(|a, b| spread(a).total_cmp(&spread(b)))
        .ok_or(Error::Empty)?;
    let needed = critical(share) + QUANTILE;
    Ok(Plan {
        runs: (needed.powi(2) * spread(best) / (fault * fault)).ceil() as u64,
        k: best.photon.number(),
    })
}
