//! All photons of a simulation at once: do the means of d and of d^2 agree with theory?
//!
//! Each mean has a bound of its two-sided p-value ([`two_sided`]). With N tests at the family-wise level a, a
//! p-value of at most a/N contradicts (Bonferroni: the chance of any false alarm is at most a, however the
//! photons depend on each other). Which of the tests contradict is told by Holm's procedure, at the same level
//! (Scandinavian Journal of Statistics 6, 1979).

use super::theory::{Expected, Law, Photon, Statistic, expected};
use super::{Error, checked_level, two_sided};
use crate::model::Layout;
use crate::simulate::Sums;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The family-wise level where none is asked for.
pub const LEVEL: f64 = 1e-6;

/// No more photons than this are named.
const MOST_NAMED: usize = 10;

/// The part of a test's level that its p-value may lose to the rare runs of [`two_sided`].
const RARE: f64 = 0.01;

/// Whether a simulation and theory agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// No test contradicts. It is no proof.
    Agrees,
    /// At least one does; if theory and simulation did agree, the chance of that was at most the level.
    Contradicts,
}

/// One mean beside its theory.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Whose.
    pub k: u64,
    /// Of what.
    pub statistic: Statistic,
    /// The sample mean.
    pub mean: f64,
    /// The mean in theory, where it is finite.
    pub expected: Option<f64>,
    /// The difference in standard errors (those of theory); none where they are infinite. An effect size: it
    /// does not decide.
    pub z: Option<f64>,
    /// A bound of the p-value; 1 where z is so small that it was not computed.
    pub p: f64,
}

/// What the battery says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The conclusion.
    pub verdict: Verdict,
    /// The family-wise level: how likely a false alarm is, at most.
    pub level: f64,
    /// Runs and photons, and tests: two a photon.
    pub runs: u64,
    pub photons: u64,
    pub tests: u64,
    /// How many tests contradict, and the first photons that do.
    pub contradictions: u64,
    pub named: Vec<u64>,
    /// The test with the least p, of several such the one with the largest |z|.
    pub worst: Option<Finding>,
    /// Photons around Va = 0: their k/U has no exponential moments, so the test from above is weak, and says
    /// nothing for the innermost of them.
    pub weak_from_above: u64,
    /// A summary that does not decide.
    pub chi_square: ChiSquare,
}

/// The sum of the squares of independent z of d: of one photon a shell, the first asked for whose variance is
/// finite. By the central limit theorem about a chi-square with as many degrees of freedom: an approximation,
/// for the eye.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChiSquare {
    /// The degrees of freedom.
    pub shells: u64,
    /// The sum.
    pub value: f64,
    /// About a standard normal variate (Wilson and Hilferty, PNAS 17, 1931); large where the z scatter too
    /// much, negative where too little. 0 without shells.
    pub score: f64,
}

/// Tests the sums of a simulation of a layout at a family-wise level.
///
/// ```
/// use claimcheck::model::Layout;
/// use claimcheck::simulate::{Sums, verdict::{battery, battery::Verdict}};
/// // Photon 2 of strategy 1 lies between the volumes 1 and 2: E d = 0.386, E d^2 = 0.227.
/// let sums = |mean: f64| Sums {
///     runs: 1000,
///     photons: vec![2],
///     deviation: vec![1000.0 * mean],
///     square: vec![227.0],
/// };
/// let report = battery(&Layout::One, &sums(0.39), 1e-6)?;
/// assert_eq!(report.verdict, Verdict::Agrees);
/// let report = battery(&Layout::One, &sums(0.45), 1e-6)?;
/// assert_eq!(report.verdict, Verdict::Contradicts);
/// assert!(report.worst.expect("a test").z.expect("a variance") > 7.0);
/// # Ok::<(), claimcheck::simulate::verdict::Error>(())
/// ```
///
/// # Errors
/// [`Error`]: sums that are none, photons that the layout has not, a level outside (0, 1).
pub fn battery(layout: &Layout, sums: &Sums, level: f64) -> Result<Report, Error> {
    let theory = theory_of(layout, sums)?;
    let findings = tests(&theory, sums, checked_level(level)?);
    let named = contradictions(&findings, level);
    Ok(Report {
        verdict: match named.is_empty() {
            true => Verdict::Agrees,
            false => Verdict::Contradicts,
        },
        level,
        runs: sums.runs,
        photons: sums.photons.len() as u64,
        tests: findings.len() as u64,
        contradictions: named.len() as u64,
        worst: worst(&findings),
        weak_from_above: theory.iter().filter(|e| e.photon.inner() == 0).count() as u64,
        chi_square: chi_square(&theory, &findings),
        named: first_photons(named),
    })
}

/// Every test of the battery, in the order of the photons.
///
/// # Errors
/// As [`battery`].
pub fn findings(layout: &Layout, sums: &Sums, level: f64) -> Result<Vec<Finding>, Error> {
    Ok(tests(
        &theory_of(layout, sums)?,
        sums,
        checked_level(level)?,
    ))
}

/// The moments of the photons of sums that are in order.
fn theory_of(layout: &Layout, sums: &Sums) -> Result<Vec<Expected>, Error> {
    let count = sums.photons.len();
    if sums.runs == 0 || count == 0 || sums.deviation.len() != count || sums.square.len() != count {
        return Err(Error::Empty);
    }
    let values = sums.deviation.iter().zip(&sums.square);
    for (k, (deviation, square)) in sums.photons.iter().zip(values) {
        if deviation.is_nan() || square.is_nan() {
            return Err(Error::NotANumber(*k));
        }
    }
    expected(layout, &sums.photons)
}

fn tests(theory: &[Expected], sums: &Sums, level: f64) -> Vec<Finding> {
    let share = level / (2.0 * theory.len() as f64);
    let test = |expected: &Expected, deviation: f64, square: f64| {
        let test = Test {
            expected,
            runs: sums.runs,
            share,
        };
        [
            test.find(Statistic::Deviation, deviation),
            test.find(Statistic::Square, square),
        ]
    };
    let sums = sums.deviation.par_iter().zip(&sums.square);
    let pairs: Vec<_> = theory
        .par_iter()
        .zip(sums)
        .map(|(expected, (deviation, square))| test(expected, *deviation, *square))
        .collect();
    pairs.into_iter().flatten().collect()
}

/// The tests of one photon.
struct Test<'a> {
    expected: &'a Expected,
    runs: u64,
    /// The p-value that contradicts.
    share: f64,
}

impl Test<'_> {
    fn find(&self, statistic: Statistic, sum: f64) -> Finding {
        let mean = sum / self.runs as f64;
        let expected = self.expected.mean(statistic);
        let error = self.expected.scatter(statistic) / (self.runs as f64).sqrt();
        let z = Some((mean - expected) / error).filter(|_| error.is_finite());
        Finding {
            k: self.expected.photon.number(),
            statistic,
            mean,
            expected: Some(expected).filter(|mean| mean.is_finite()),
            z,
            p: match z.is_some_and(|z| self.is_harmless(z)) {
                true => 1.0,
                false => self.p(statistic, mean),
            },
        }
    }

    fn p(&self, statistic: Statistic, mean: f64) -> f64 {
        let law = Law::new(self.expected.photon);
        two_sided(&law, statistic, self.runs, mean, RARE * self.share)
    }

    /// Whether z is less than half of what contradicts by the normal law's own bound, `2 exp(-z^2/2)`. Then p
    /// is not computed but called 1: not to contradict is never a false alarm, so the level holds.
    fn is_harmless(&self, z: f64) -> bool {
        z.abs() < critical(self.share) / 2.0
    }
}

/// The z that contradicts where Chernoff's bound is that of the normal law: `2 exp(-z^2/2) = share`.
pub fn critical(share: f64) -> f64 {
    (2.0 * (2.0 / share).ln()).sqrt()
}

/// The tests that contradict by Holm's procedure.
fn contradictions(findings: &[Finding], level: f64) -> Vec<&Finding> {
    let mut sorted: Vec<_> = findings.iter().collect();
    sorted.sort_by(|a, b| a.p.total_cmp(&b.p));
    let holds =
        |(rank, finding): &(usize, &Finding)| finding.p <= level / (findings.len() - rank) as f64;
    let found = sorted.iter().copied().enumerate().take_while(holds);
    found.map(|(_, finding)| finding).collect()
}

fn first_photons(findings: Vec<&Finding>) -> Vec<u64> {
    let mut ks: Vec<_> = findings.iter().map(|finding| finding.k).collect();
    ks.sort_unstable();
    ks.dedup();
    ks.truncate(MOST_NAMED);
    ks
}

fn worst(findings: &[Finding]) -> Option<Finding> {
    let size = |finding: &Finding| finding.z.map_or(0.0, f64::abs);
    let worse = |a: &&Finding, b: &&Finding| {
        let order = b.p.total_cmp(&a.p);
        order.then(size(a).total_cmp(&size(b)))
    };
    findings.iter().max_by(worse).copied()
}

fn chi_square(theory: &[Expected], findings: &[Finding]) -> ChiSquare {
    let (mut shells, mut value) = (0u64, 0.0);
    let mut last: Option<Photon> = None;
    let deviations = findings
        .iter()
        .filter(|finding| finding.statistic == Statistic::Deviation);
    for (expected, finding) in theory.iter().zip(deviations) {
        let Some(z) = finding.z else { continue };
        if last.map(Photon::inner) != Some(expected.photon.inner()) {
            shells += 1;
            value += z * z;
            last = Some(expected.photon);
        }
    }
    ChiSquare {
        shells,
        value,
        score: wilson_hilferty(value, shells as f64),
    }
}

/// A chi-square with n degrees of freedom as about a standard normal variate: the cube root is nearly normal.
fn wilson_hilferty(value: f64, n: f64) -> f64 {
    if n == 0.0 {
        return 0.0;
    }
    let spread = 2.0 / (9.0 * n);
    ((value / n).cbrt() - (1.0 - spread)) / spread.sqrt()
}
