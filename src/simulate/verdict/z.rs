//! The z-value of any sample mean, and whether it counts. By the central limit theorem: an approximation, for
//! alarms, never for a verdict.
//!
//! A mean of n values with a finite variance is about normal for large n; nothing is proved for a given n, and
//! a variable of unknown law may have rare huge values that the sample has not seen. Then the mean is too
//! small *and* its standard error is: z is large and means nothing. So z counts only where
//!
//! - there are at least 1000 values, all finite and not all equal, and
//! - the sample kurtosis (fourth central moment over squared variance; 3 for a normal law) is at most n/1000.
//!
//! Since skewness^2 < kurtosis, the second keeps the first correction to the normal law far out, a factor of
//! about `exp(skewness z^3/(6 sqrt(n)))` (Cramer 1938), below `exp(z^3/189)`: 2 at z = 5, 6 at z = 7. Heavy
//! tails do not pass: with a tail `P(X > x) ~ x^-a`, a < 2, the largest values alone make the kurtosis a share
//! of n. To pass, a sample must have missed them so thoroughly that this is itself rare: for a = 5/3 the
//! chance is about exp(-28).

use serde::{Deserialize, Serialize};

/// Fewer values than this have no z.
const FEWEST: u64 = 1000;

/// n over the kurtosis, at least.
const TAME: f64 = 1000.0;

/// The moments of a sample, in one pass, stable against rounding (Pebay, Sandia report SAND2008-6212, 2008).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    count: u64,
    mean: f64,
    /// Sums of the second, third and fourth powers of the distances from the mean.
    second: f64,
    third: f64,
    fourth: f64,
}

/// A sample mean against a value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Z {
    /// The sample mean.
    pub mean: f64,
    /// Its standard error, from the sample.
    pub standard_error: f64,
    /// The distance from the value in standard errors.
    pub z: f64,
    /// Whether z says anything (see the module).
    pub counts: bool,
}

impl Sample {
    /// Adds a value.
    pub fn add(&mut self, value: f64) {
        self.merge(&Sample {
            count: 1,
            mean: value,
            ..Sample::default()
        });
    }

    /// Adds another sample.
    pub fn merge(&mut self, other: &Sample) {
        if self.count == 0 || other.count == 0 {
            if self.count == 0 {
                *self = *other;
            }
            return;
        }
        let (a, b) = (self.count as f64, other.count as f64);
        let n = a + b;
        let step = (other.mean - self.mean) / n;
        let square = step * step;
        self.fourth += other.fourth
            + a * b * n * (a * a - a * b + b * b) * square * square
            + 6.0 * square * (a * a * other.second + b * b * self.second)
            + 4.0 * step * (a * other.third - b * self.third);
        self.third += other.third
            + a * b * (a - b) * n * square * step
            + 3.0 * step * (a * other.second - b * self.second);
        self.second += other.second + a * b * n * square;
        self.mean += b * step;
        self.count += other.count;
    }

    /// How many values.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Their mean.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Their variance, around the sample mean, over n - 1; NaN of one value.
    pub fn variance(&self) -> f64 {
        self.second / (self.count as f64 - 1.0)
    }

    /// Their fourth central moment over the square of their variance; at least 1, for a normal law 3. NaN
    /// where all values are equal or one is not finite.
    pub fn kurtosis(&self) -> f64 {
        self.count as f64 * self.fourth / (self.second * self.second)
    }

    /// The mean against a value; none where there is no standard error, or an infinite one.
    ///
    /// ```
    /// use claimcheck::simulate::verdict::z::Sample;
    /// let mut sample = Sample::default();
    /// (0..10_000).for_each(|i| sample.add(f64::from(i % 100)));
    /// let z = sample.against(49.5).expect("not all equal");
    /// assert!(z.counts && z.z.abs() < 1e-9 && (z.standard_error - 0.28868).abs() < 1e-5);
    /// // Too few values have a z that does not count.
    /// let mut few = Sample::default();
    /// (0..100).for_each(|i| few.add(f64::from(i)));
    /// assert!(!few.against(40.0).expect("not all equal").counts);
    /// ```
    pub fn against(&self, value: f64) -> Option<Z> {
        let n = self.count as f64;
        let standard_error = (self.second / (n - 1.0) / n).sqrt();
        let z = (self.mean - value) / standard_error;
        (standard_error > 0.0 && z.is_finite()).then_some(Z {
            mean: self.mean,
            standard_error,
            z,
            counts: self.count >= FEWEST && self.kurtosis() * TAME <= n,
        })
    }
}
