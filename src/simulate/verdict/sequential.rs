//! A test that may look at the simulation as often as it likes, and stop when it has seen enough.
//!
//! For a statistic g with `K(t) = ln E exp(t g)`, runs n and their sum S, `exp(t S - n K(t))` is a martingale
//! with mean 1 if the runs follow the law, and so is any average of such over t, photons and statistics,
//! however the photons of a run depend on each other. A martingale that is never negative ever reaches 1/a
//! with probability at most a (Ville 1939). So the average over a grid of t (the method of mixtures: Robbins,
//! Annals of Mathematical Statistics 41, 1970; Howard, Ramdas, McAuliffe and Sekhon, Annals of Statistics 49,
//! 2021) contradicts theory once it has reached 1/a; the chance that it does so by mistake, at whatever run,
//! is at most a.
//!
//! The same turned round gives intervals: if the law of d is that of theory but for a shift, the true mean
//! lies at all times between those shifts that are not contradicted.

use super::theory::{Expected, Law, Statistic, expected};
use super::{Error, checked_level};
use crate::model::Layout;
use crate::simulate::Sums;

/// The largest t, in units of `1/E min(|g|, 1)`; the others are halves, quarters, ... of it.
const LARGEST: f64 = 4.0;

/// How many on either side: the least one is best after some 10^12 runs.
const GRID: i32 = 21;

/// Halvings of a distance: ends of intervals to 12 digits of their length.
const HALVINGS: u32 = 40;

/// Doublings of a distance before it is called infinite.
const DOUBLINGS: u32 = 200;

/// Photons under watch, run by run or in chunks of any sizes.
#[derive(Clone, Debug)]
pub struct Watch {
    level: f64,
    runs: u64,
    photons: Vec<Watched>,
    /// The greatest ln of the martingale so far.
    peak: f64,
}

#[derive(Clone, Debug)]
struct Watched {
    expected: Expected,
    deviation: Mixture,
    square: Mixture,
}

/// The martingale of one statistic.
#[derive(Clone, Debug)]
struct Mixture {
    /// t and K(t), those that are finite.
    tilts: Vec<(f64, f64)>,
    /// E min(|g|, 1), a measure of distance.
    scale: f64,
    sum: f64,
}

/// What is known of a mean after the runs so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Its ends, of `E k/U - 1`; infinite where nothing is known.
    pub low: f64,
    pub high: f64,
}

impl Interval {
    /// Half its length.
    pub fn half_width(&self) -> f64 {
        (self.high - self.low) / 2.0
    }
}

impl Mixture {
    fn new(law: &Law, statistic: Statistic) -> Mixture {
        let scale = law.size(statistic);
        let sizes = (0..GRID).map(|halvings| LARGEST / scale * 0.5f64.powi(halvings));
        let tilts = sizes
            .flat_map(|t| [-t, t])
            .map(|t| (t, law.cumulant(statistic, t)))
            .filter(|(_, cumulant)| cumulant.is_finite());
        Mixture {
            tilts: tilts.collect(),
            scale,
            sum: 0.0,
        }
    }

    /// ln of the martingale if g is larger by `shift` than theory has it. The t without a finite cumulant
    /// count as 0.
    fn evidence(&self, runs: f64, shift: f64) -> f64 {
        let exponents = self
            .tilts
            .iter()
            .map(|(t, cumulant)| t * (self.sum - runs * shift) - runs * cumulant);
        log_mean(exponents, 2.0 * f64::from(GRID))
    }

    /// The distance from `middle`, in the direction of `step`, at which the evidence reaches a bound. (The
    /// martingale is convex in the shift, so that is one place.)
    fn reach(&self, runs: f64, middle: f64, step: f64, bound: f64) -> f64 {
        let reached = |distance: f64| self.evidence(runs, middle + distance) >= bound;
        let mut far = step;
        for _ in 0..DOUBLINGS {
            if reached(far) {
                break;
            }
            far *= 2.0;
        }
        if !reached(far) {
            return step * f64::INFINITY;
        }
        let mut near = 0.0;
        for _ in 0..HALVINGS {
            let between = near + (far - near) / 2.0;
            match reached(between) {
                true => far = between,
                false => near = between,
            }
        }
        far
    }
}

impl Watch {
    /// Watches some photons of a layout at a level. Some 100 microseconds and 2 kilobytes a photon: for a
    /// hundred or a thousand of them.
    ///
    /// ```
    /// use claimcheck::model::Layout;
    /// use claimcheck::simulate::{Sums, verdict::sequential::Watch};
    /// let mut watch = Watch::new(&Layout::One, &[2], 1e-6)?;
    /// // Chunks of 100 runs with a mean of 0.45, where theory has 0.386.
    /// let chunk = Sums { runs: 100, photons: vec![2], deviation: vec![45.0], square: vec![28.0] };
    /// while !watch.contradicts() {
    ///     watch.feed(&chunk)?;
    /// }
    /// assert!(500 < watch.runs() && watch.runs() < 1000);
    /// # Ok::<(), claimcheck::simulate::verdict::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error`]: no photons, photons that the layout has not, a level outside (0, 1).
    pub fn new(layout: &Layout, ks: &[u64], level: f64) -> Result<Watch, Error> {
        let photons: Vec<_> = expected(layout, ks)?
            .into_iter()
            .map(Watched::new)
            .collect();
        match photons.is_empty() {
            true => Err(Error::Empty),
            false => Ok(Watch {
                level: checked_level(level)?,
                runs: 0,
                photons,
                peak: 0.0,
            }),
        }
    }

    /// Adds a chunk of runs, and looks. It must hold the same photons, and be taken in whatever it says: which
    /// chunk comes next must not depend on what is in it.
    ///
    /// # Errors
    /// `Empty` for a chunk of other photons or without sums for each; `NotANumber`. Nothing is added then.
    pub fn feed(&mut self, chunk: &Sums) -> Result<(), Error> {
        let count = self.photons.len();
        let ks = self
            .photons
            .iter()
            .map(|watched| watched.expected.photon.number());
        if !ks.eq(chunk.photons.iter().copied())
            || chunk.deviation.len() != count
            || chunk.square.len() != count
        {
            return Err(Error::Empty);
        }
        let sums = chunk.deviation.iter().zip(&chunk.square);
        for (k, (deviation, square)) in chunk.photons.iter().zip(sums.clone()) {
            if deviation.is_nan() || square.is_nan() {
                return Err(Error::NotANumber(*k));
            }
        }
        for (watched, (deviation, square)) in self.photons.iter_mut().zip(sums) {
            watched.deviation.sum += deviation;
            watched.square.sum += square;
        }
        self.runs = self.runs.saturating_add(chunk.runs);
        self.peak = self.peak.max(self.evidence());
        Ok(())
    }

    /// The runs so far.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    /// `E_k - 1` in theory, photon by photon.
    pub fn theory(&self) -> impl Iterator<Item = f64> {
        self.photons.iter().map(|watched| watched.expected.excess)
    }

    /// ln of the martingale now: the average over all photons and both statistics.
    pub fn evidence(&self) -> f64 {
        let runs = self.runs as f64;
        let each = self.photons.iter().flat_map(|watched| {
            [&watched.deviation, &watched.square].map(|mixture| mixture.evidence(runs, 0.0))
        });
        log_mean(each, 2.0 * self.photons.len() as f64)
    }

    /// Whether the runs contradict theory, or did so at an earlier look. The chance that this ever happens to
    /// runs that follow theory is at most the level.
    pub fn contradicts(&self) -> bool {
        self.peak >= -self.level.ln()
    }

    /// For each photon what is known of the true `E k/U - 1`, if the law of k/U is that of theory but for a
    /// shift: then all intervals at all looks hold it, with probability 1 - level at least. None before the
    /// first run, where theory has no mean, and where no shift is left.
    pub fn intervals(&self) -> Vec<Option<Interval>> {
        let bound = (self.photons.len() as f64 / self.level).ln();
        let each = self
            .photons
            .iter()
            .map(|watched| watched.interval(self.runs as f64, bound));
        each.collect()
    }

    /// Whether every photon has an interval no wider than `half_width` to both sides: a precision at which to
    /// stop.
    pub fn is_precise(&self, half_width: f64) -> bool {
        let mut intervals = self.intervals().into_iter();
        intervals.all(|interval| interval.is_some_and(|it| it.half_width() <= half_width))
    }
}

impl Watched {
    fn new(expected: Expected) -> Watched {
        let law = Law::new(expected.photon);
        Watched {
            expected,
            deviation: Mixture::new(&law, Statistic::Deviation),
            square: Mixture::new(&law, Statistic::Square),
        }
    }

    fn interval(&self, runs: f64, bound: f64) -> Option<Interval> {
        let mixture = &self.deviation;
        let theory = self.expected.excess;
        let middle = mixture.sum / runs - theory;
        if !middle.is_finite() || mixture.evidence(runs, middle) >= bound {
            return None;
        }
        let step = mixture.scale / runs.sqrt();
        let end = |step| theory + middle + mixture.reach(runs, middle, step, bound);
        Some(Interval {
            low: end(-step),
            high: end(step),
        })
    }
}

/// ln of the mean of `exp` of some numbers, those missing to the count being exp(-inf).
fn log_mean(exponents: impl Iterator<Item = f64>, count: f64) -> f64 {
    let exponents: Vec<f64> = exponents.collect();
    let largest = exponents.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if largest.is_infinite() {
        return largest;
    }
    let sum: f64 = exponents.iter().map(|x| (x - largest).exp()).sum();
    largest + (sum / count).ln()
}
