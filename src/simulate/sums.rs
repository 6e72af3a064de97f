//! What the runs of a scene come to: two sums for each photon, added up in one pass.
//!
//! Both sums are of `d = k/U - 1`, the estimator's relative error, which is itself drawn without cancellation,
//! as `(l - V*x)/U`. So the mean and the variance of k/U are those of shifted data, and the shift is the true
//! value: relative to the variance, n sums lose a factor `1 + (mean d)^2/Var` of their digits only (Tony Chan,
//! Gene Golub and Randall LeVeque, The American Statistician 37, 1983, formulas 1.6 and 2.3 with the shift of
//! 1.7). For one photon a shell that is 1 + 3 at most, because `Var` is about `(mean d)^2/3`; for larger
//! shells it is nearly 1.

use serde::{Deserialize, Serialize};

/// Sums over runs, for some photons.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sums {
    /// How many runs.
    pub runs: u64,
    /// The k of each photon, ascending.
    pub photons: Vec<u64>,
    /// For each photon the sum of `d = k/U - 1` over the runs.
    pub deviation: Vec<f64>,
    /// For each photon the sum of `d^2` over the runs.
    pub square: Vec<f64>,
}

impl Sums {
    /// No runs yet.
    pub fn new(photons: Vec<u64>) -> Sums {
        let zeros = vec![0.0; photons.len()];
        Sums {
            runs: 0,
            photons,
            deviation: zeros.clone(),
            square: zeros,
        }
    }

    /// The mean of k/U over the runs, for the photon at place `i` of `photons`; NaN where there is none.
    ///
    /// ```
    /// use claimcheck::simulate::Sums;
    /// // Two runs, in which k/U was 0.5 and 2.
    /// let sums = Sums { runs: 2, photons: vec![1], deviation: vec![0.5], square: vec![1.25] };
    /// assert_eq!((sums.mean(0), sums.variance(0)), (1.25, 1.125));
    /// assert_eq!(sums.about_one(0), 0.625);
    /// ```
    pub fn mean(&self, i: usize) -> f64 {
        1.0 + self.excess(i)
    }

    /// The mean of `k/U - 1`: [`mean`](Sums::mean) less 1, with all its digits.
    pub fn excess(&self, i: usize) -> f64 {
        self.over_runs(&self.deviation, i)
    }

    /// The variance of k/U, without bias: squares around the mean of the runs, over the runs less one. NaN for
    /// less than two runs.
    pub fn variance(&self, i: usize) -> f64 {
        if self.runs < 2 {
            return f64::NAN;
        }
        let runs = self.runs as f64;
        let around_mean = self.about_one(i) - self.excess(i) * self.excess(i);
        // Rounding may leave less than nothing where all runs agree.
        around_mean.max(0.0) * (runs / (runs - 1.0))
    }

    /// The thesis's fast variance (section 3.6): squares around the true value 1. Its mean is not `Var` but
    /// `Var + (E - 1)^2`.
    pub fn about_one(&self, i: usize) -> f64 {
        self.over_runs(&self.square, i)
    }

    fn over_runs(&self, sums: &[f64], i: usize) -> f64 {
        sums.get(i).map_or(f64::NAN, |sum| sum / self.runs as f64)
    }

    /// Takes in further runs of the same photons.
    ///
    /// Sums of doubles depend on their order: who wants the same bytes adds in the same order.
    ///
    /// # Errors
    /// [`OtherPhotons`]; nothing is taken in then.
    pub fn merge(&mut self, other: &Sums) -> Result<(), OtherPhotons> {
        if self.photons != other.photons {
            return Err(OtherPhotons);
        }
        self.add(other);
        Ok(())
    }

    /// What was taken in since there were fewer runs of the same photons.
    ///
    /// # Errors
    /// [`OtherPhotons`]
    pub fn since(&self, before: &Sums) -> Result<Sums, OtherPhotons> {
        if self.photons != before.photons {
            return Err(OtherPhotons);
        }
        let less =
            |all: &[f64], before: &[f64]| all.iter().zip(before).map(|(a, b)| a - b).collect();
        Ok(Sums {
            runs: self.runs.saturating_sub(before.runs),
            photons: self.photons.clone(),
            deviation: less(&self.deviation, &before.deviation),
            square: less(&self.square, &before.square),
        })
    }

    /// Takes in further runs of the same photons, as is known.
    pub(super) fn add(&mut self, other: &Sums) {
        self.runs += other.runs;
        for (sum, more) in self.deviation.iter_mut().zip(&other.deviation) {
            *sum += more;
        }
        for (sum, more) in self.square.iter_mut().zip(&other.square) {
            *sum += more;
        }
    }
}

/// Sums of two sets of photons do not add up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("these are sums of other photons")]
pub struct OtherPhotons;
