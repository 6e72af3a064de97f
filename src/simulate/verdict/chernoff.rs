//! How unlikely a sample mean is: Chernoff's inequality with the whole law, for every number of runs.
//!
//! For the mean of R independent values of g with `K(t) = ln E exp(t g)`, and every t >= 0,
//!
//! ```text
//! P(mean >= a) <= exp(-R (t a - K(t)))
//! ```
//!
//! by Markov's inequality for `exp(t R mean)` (Chernoff, Annals of Mathematical Statistics 23, 1952); below
//! alike with t <= 0. Since every t will do, the search for the best one need not be exact, and a t may not be
//! found at all.
//!
//! Around Va = 0 the cumulant is infinite for t > 0, and in other shells thicker than the volume inside them
//! the rarest U raise it much. There the runs are first supposed to have no U below a volume u:
//!
//! ```text
//! P(mean >= a) <= R P(U < u) + exp(-R (t a - ln E[exp(t g); U >= u]))
//! ```
//!
//! That is a bound for every u chosen before the runs are seen. For the innermost photons, whose mean is
//! carried by rare small U, it says little, rightly.

use super::theory::{Law, Statistic};

/// Steps of the search for the best t.
const STEPS: usize = 60;

/// The largest t, in units of `1/E min(|g|, 1)`: so far cumulants are tested. The best t for a mean that is z
/// standard errors off is about `z/sqrt(R)` of these.
const LARGEST: f64 = 5.0;

/// A bound of the p-value of the sample mean of a statistic over `runs` runs, against both sides: twice the
/// smaller bound of the two, at most 1. If the runs follow the law, the chance that it is `<= p` is at most p,
/// for every p and every number of runs. `rare` is the probability that may be spent in thick shells (see the
/// module): a hundredth of the p-value looked for.
///
/// ```
/// use claimcheck::simulate::verdict::{Law, Photon, Statistic, two_sided};
/// // Ten runs of the photon between the volumes 1 and 2, whose mean of d is 2 ln 2 - 1 = 0.386.
/// let law = Law::new(Photon::new(1, 1, 1).expect("l <= m"));
/// let p = |mean| two_sided(&law, Statistic::Deviation, 10, mean, 1e-8);
/// assert_eq!(p(0.386), 1.0);
/// assert!(p(0.5) > 0.1 && p(0.8) < 1e-4);
/// // The greatest value is 1: ten of them need ten times U = 1.
/// assert!(p(0.99999) < 1e-9);
/// ```
pub fn two_sided(law: &Law, statistic: Statistic, runs: u64, mean: f64, rare: f64) -> f64 {
    let below = one_sided(law, statistic, runs, mean, Side::Below, rare);
    let above = one_sided(law, statistic, runs, mean, Side::Above, rare);
    (2.0 * below.min(above)).min(1.0)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Below,
    Above,
}

/// A bound of the probability of a mean so far to one side, or farther.
fn one_sided(law: &Law, statistic: Statistic, runs: u64, mean: f64, side: Side, rare: f64) -> f64 {
    let runs = runs as f64;
    let thick = law.photon().inner() < law.photon().size();
    let (start, beyond) = match thick && side == Side::Above {
        true => law.start(rare / runs),
        false => (0, 0.0),
    };
    let search = Search {
        law,
        statistic,
        start,
        side,
    };
    (runs * beyond + (-runs * search.rate(mean)).exp()).min(1.0)
}

struct Search<'a> {
    law: &'a Law,
    statistic: Statistic,
    start: usize,
    side: Side,
}

impl Search<'_> {
    /// The greatest `t a - K(t)` found on a side, at least 0. It is concave in t, so Newton's method serves,
    /// kept between the last t on either side of the top.
    fn rate(&self, mean: f64) -> f64 {
        let sign = match self.side {
            Side::Below => -1.0,
            Side::Above => 1.0,
        };
        if mean * sign == f64::INFINITY {
            return f64::INFINITY;
        }
        let tilted = |t: f64| self.law.tilted(self.statistic, sign * t, self.start);
        let largest = LARGEST / self.law.size(self.statistic);
        let rest = tilted(0.0);
        let mut t = ((mean - rest.mean) * sign / rest.variance).min(largest);
        let (mut low, mut high, mut best) = (0.0, largest, 0.0f64);
        // No step for a mean on the other side, and for one that is no number.
        for _ in 0..STEPS {
            if !(t > low && t <= high) {
                break;
            }
            let found = tilted(t);
            best = best.max(sign * t * mean - found.cumulant);
            let slope = sign * (mean - found.mean);
            match slope > 0.0 {
                true => low = t,
                false => high = t,
            }
            let next = within(t + slope / found.variance, low, high);
            if (next - t).abs() <= 1e-6 * t {
                break;
            }
            t = next;
        }
        best
    }
}

/// A step of Newton's method, where it stays between the ends; else one to the middle of them on a scale of
/// ratios, for the best t may be many powers of ten below the largest.
fn within(newton: f64, low: f64, high: f64) -> f64 {
    match newton > low && newton < high {
        true => newton,
        false => (low.max(high * 1e-6) * high).sqrt(),
    }
}
