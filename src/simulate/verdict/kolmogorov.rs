//! Whether samples of U have the photon's law: the test of Kolmogorov and Smirnov, with a bound for every
//! number of samples.
//!
//! `D` is the greatest distance between the share of samples up to a volume and its probability. For n
//! independent samples `P(D > e) <= 2 exp(-2 n e^2)` (Dvoretzky, Kiefer and Wolfowitz 1956; the constant:
//! Massart, Annals of Probability 18, 1990).

use super::{Error, Law};
use serde::{Deserialize, Serialize};

/// What the samples say.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Kolmogorov {
    /// How many.
    pub samples: u64,
    /// D
    pub distance: f64,
    /// A bound of the p-value, for any number of samples; the rounding of the samples is taken off D first.
    pub p: f64,
}

/// Tests independent samples of U.
///
/// ```
/// use claimcheck::simulate::verdict::{Law, Photon, kolmogorov::kolmogorov};
/// let law = Law::new(Photon::new(4, 1, 1).expect("l <= m"));
/// let even: Vec<f64> = (0..1000).map(|i| 4.0 + (i as f64 + 0.5) / 1000.0).collect();
/// let found = kolmogorov(&law, even.clone())?;
/// assert!((found.distance - 0.0005).abs() < 1e-12 && found.p == 1.0);
/// // All of them 0.2 too large.
/// let shifted = even.iter().map(|u| u + 0.2).collect();
/// assert!(kolmogorov(&law, shifted)?.p < 1e-33);
/// # Ok::<(), claimcheck::simulate::verdict::Error>(())
/// ```
///
/// # Errors
/// `Empty` without samples, `NotANumber` for one that is none.
pub fn kolmogorov(law: &Law, mut samples: Vec<f64>) -> Result<Kolmogorov, Error> {
    if samples.is_empty() {
        return Err(Error::Empty);
    }
    if samples.iter().any(|u| u.is_nan()) {
        return Err(Error::NotANumber(law.photon().number()));
    }
    samples.sort_unstable_by(f64::total_cmp);
    let n = samples.len() as f64;
    let mut distance = 0.0f64;
    for (index, volume) in samples.iter().enumerate() {
        let probability = law.distribution(*volume);
        // The share jumps at the sample.
        let (before, after) = (index as f64 / n, (index + 1) as f64 / n);
        distance = distance.max(probability - before).max(after - probability);
    }
    let sure = (distance - law.blur()).max(0.0);
    Ok(Kolmogorov {
        samples: samples.len() as u64,
        distance,
        p: (2.0 * (-2.0 * n * sure * sure).exp()).min(1.0),
    })
}
