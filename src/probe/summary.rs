//! What a stretch of photons comes to. Summaries of two stretches make one of both, in whichever order.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// No more photons than this are named for a link.
pub const MOST_NAMED: usize = 10;

/// What was found of some photons.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// How many photons were asked.
    pub photons: u64,
    /// How many values were computed one by one, because doubles did not decide.
    pub refined: u64,
    /// Ten stretches of every decade, by the least number that belongs there: see [`bin`].
    pub bins: BTreeMap<u64, Stretch>,
    /// The shells, by their first photon, where they are asked for.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub shells: BTreeMap<u64, Stretch>,
    /// For each link of the claim.
    pub links: Vec<Tally>,
}

/// Where the bins of a decade begin, in hundredths: the preferred numbers R10 (ISO 3), nearly even by logarithm.
const BINS: [u64; 10] = [100, 125, 160, 200, 250, 315, 400, 500, 630, 800];

/// The first photon of the bin of photon k >= 1, and of the next bin.
///
/// ```
/// use claimcheck::probe::bin;
/// assert_eq!(bin(999), (800, 1000));
/// assert_eq!(bin(1), (1, 2));
/// ```
pub fn bin(k: u64) -> (u64, u64) {
    let decade = 10u64.pow(k.max(1).ilog10());
    let starts = BINS.map(|part| (u128::from(decade) * u128::from(part)).div_ceil(100) as u64);
    let next = starts.into_iter().find(|&start| start > k);
    let first = starts.into_iter().rfind(|&start| start <= k);
    (
        first.unwrap_or(decade),
        next.unwrap_or(decade.saturating_mul(10)),
    )
}

/// Photons in a row, as far as they were asked.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stretch {
    /// How many photons.
    pub photons: u64,
    /// How many of them have no value of the quantity, or none that is known and a finite double.
    pub untold: u64,
    /// The quantity where it is least and where it is greatest, of the others.
    pub least: Option<Extreme>,
    pub greatest: Option<Extreme>,
    /// For each link that is an inequality, the least difference of its sides.
    pub margins: Vec<Option<Extreme>>,
}

/// The least of some numbers: it lies between `low` and `high`, and the number at k does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Extreme {
    pub k: u64,
    pub low: f64,
    pub high: f64,
}

/// How a link fared.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Where it fails.
    pub violations: Named,
    /// Where no precision tried decides it, or a side may have no value.
    pub undecided: Named,
    /// Where E_k or Var_k is infinite: a side has no finite value.
    pub infinite: Named,
}

/// Some photons: their number, and the first of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Named {
    pub count: u64,
    pub first: Vec<u64>,
}

impl Named {
    pub(super) fn add(&mut self, k: u64) {
        self.merge(&Named {
            count: 1,
            first: vec![k],
        });
    }

    fn merge(&mut self, other: &Named) {
        self.count += other.count;
        self.first.extend(&other.first);
        self.first.sort_unstable();
        self.first.truncate(MOST_NAMED);
    }
}

/// The one with the smaller lower end, then the smaller k.
fn least(a: Option<Extreme>, b: Option<Extreme>) -> Option<Extreme> {
    let smaller = |a: Extreme, b: Extreme| {
        if (b.low, b.k) < (a.low, a.k) { b } else { a }
    };
    match (a, b) {
        (Some(a), Some(b)) => Some(smaller(a, b)),
        (a, b) => a.or(b),
    }
}

impl Extreme {
    /// Of the numbers with the other sign.
    pub(super) fn negated(self) -> Extreme {
        Extreme {
            k: self.k,
            low: -self.high,
            high: -self.low,
        }
    }
}

impl Stretch {
    pub(super) fn take_least(&mut self, extreme: Extreme) {
        self.least = least(self.least, Some(extreme));
    }

    pub(super) fn take_greatest(&mut self, extreme: Extreme) {
        let before = self.greatest.map(Extreme::negated);
        self.greatest = least(before, Some(extreme.negated())).map(Extreme::negated);
    }

    pub(super) fn take_margin(&mut self, link: usize, extreme: Extreme) {
        if self.margins.len() <= link {
            self.margins.resize(link + 1, None);
        }
        self.margins[link] = least(self.margins[link], Some(extreme));
    }

    /// Both as one.
    pub(super) fn merge(&mut self, other: &Stretch) {
        self.photons += other.photons;
        self.untold += other.untold;
        self.least = least(self.least, other.least);
        if let Some(extreme) = other.greatest {
            self.take_greatest(extreme);
        }
        for (link, margin) in other.margins.iter().enumerate() {
            if let Some(extreme) = margin {
                self.take_margin(link, *extreme);
            }
        }
    }
}

impl Tally {
    /// Whether the link was shown to hold everywhere.
    pub fn holds(&self) -> bool {
        self.violations.count + self.undecided.count + self.infinite.count == 0
    }
}

impl Summary {
    /// The photons `10^n <= k < 10^(n+1)`, by n.
    pub fn decades(&self) -> BTreeMap<u32, Stretch> {
        let mut decades: BTreeMap<u32, Stretch> = BTreeMap::new();
        for (first, found) in &self.bins {
            let decade = first.max(&1).ilog10();
            decades.entry(decade).or_default().merge(found);
        }
        decades
    }

    /// Both as one.
    pub fn merge(&mut self, other: &Summary) {
        self.photons += other.photons;
        self.refined += other.refined;
        for (first, found) in &other.bins {
            self.bins.entry(*first).or_default().merge(found);
        }
        for (first, found) in &other.shells {
            self.shells.entry(*first).or_default().merge(found);
        }
        if self.links.len() < other.links.len() {
            self.links.resize(other.links.len(), Tally::default());
        }
        for (tally, more) in self.links.iter_mut().zip(&other.links) {
            tally.violations.merge(&more.violations);
            tally.undecided.merge(&more.undecided);
            tally.infinite.merge(&more.infinite);
        }
    }
}
