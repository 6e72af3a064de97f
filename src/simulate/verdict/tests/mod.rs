//! Simulations for the tests by a sampler of their own, as plain as can be: uniforms, sorted shell by shell.

mod chernoff;
mod faults;
mod heavy;
mod null;
mod theory;

use super::{Law, Photon};
use crate::model::Layout;
use crate::simulate::Sums;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// How many simulations of a kind a test makes: `usual`, or what the environment asks for.
fn simulations(usual: u64) -> u64 {
    let asked = std::env::var("CLAIMCHECK_NULLS").ok();
    asked.and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// What is wrong with a simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    /// Every k/U is larger by this share.
    Mean(f64),
    /// k - 1 instead of k.
    Estimator,
    /// A photon too many in each shell.
    ShellCount,
    /// Each shell lacks its outermost photon, whose place is taken by the shell's edge.
    Dropped,
    /// The photons of a shell in the wrong order.
    Descending,
}

/// A layout's shells: Va and m.
struct Scene {
    name: &'static str,
    layout: Layout,
    shells: Vec<(u64, u64)>,
}

fn scenes() -> [Scene; 3] {
    [
        Scene {
            name: "strategy 2, 21 photons",
            layout: Layout::Triangular,
            shells: (1..=6).map(|m| (m * (m - 1) / 2, m)).collect(),
        },
        Scene {
            name: "strategy 1, 10 photons",
            layout: Layout::One,
            shells: (0..10).map(|inner| (inner, 1)).collect(),
        },
        Scene {
            name: "unstratified, 10 photons",
            layout: Layout::Unstratified(10.into()),
            shells: vec![(0, 10)],
        },
    ]
}

impl Scene {
    fn photons(&self) -> Vec<u64> {
        (1..=self.shells.iter().map(|(_, size)| size).sum()).collect()
    }

    /// `runs` runs.
    fn simulate(&self, random: &mut Xoshiro256PlusPlus, runs: u64, fault: Fault) -> Sums {
        let photons = self.photons();
        let mut sums = Sums {
            runs,
            deviation: vec![0.0; photons.len()],
            square: vec![0.0; photons.len()],
            photons,
        };
        for _ in 0..runs {
            for (inner, size) in &self.shells {
                add_shell(&mut sums, random, *inner, *size, fault);
            }
        }
        sums
    }
}

fn add_shell(
    sums: &mut Sums,
    random: &mut Xoshiro256PlusPlus,
    inner: u64,
    size: u64,
    fault: Fault,
) {
    let count = size + u64::from(fault == Fault::ShellCount);
    let mut shares: Vec<f64> = (0..count).map(|_| uniform(random)).collect();
    shares.sort_unstable_by(f64::total_cmp);
    match fault {
        Fault::Descending => shares.reverse(),
        Fault::Dropped => {
            shares.pop();
            shares.push(1.0);
        }
        _ => {}
    }
    for (index, x) in shares.iter().take(size as usize).enumerate() {
        let k = inner + index as u64 + 1;
        let volume = inner as f64 + size as f64 * x;
        let factor = match fault {
            Fault::Mean(share) => 1.0 + share,
            _ => 1.0,
        };
        let counted = k - u64::from(fault == Fault::Estimator);
        let d = factor * counted as f64 / volume - 1.0;
        sums.deviation[k as usize - 1] += d;
        sums.square[k as usize - 1] += d * d;
    }
}

/// Of the open interval (0, 1).
fn uniform(random: &mut Xoshiro256PlusPlus) -> f64 {
    ((random.random::<u64>() >> 12) as f64 + 0.5) / 2f64.powi(52)
}

fn random(seed: u64) -> Xoshiro256PlusPlus {
    Xoshiro256PlusPlus::seed_from_u64(seed)
}

fn law(inner: u64, size: u64, position: u64) -> Law {
    Law::new(Photon::new(inner, size, position).expect("a photon"))
}

/// The least c with `P(Bin(n, p) > c) <= rare`: more false alarms than this do not happen at the rate p. (In
/// logarithms: the first terms are too small for doubles.)
fn most_alarms(n: u64, p: f64, rare: f64) -> u64 {
    let odds = (p / (1.0 - p)).ln();
    let mut term = n as f64 * (-p).ln_1p();
    let mut above = 1.0 - term.exp();
    let mut count = 0;
    while above > rare {
        term += ((n - count) as f64 / (count + 1) as f64).ln() + odds;
        above -= term.exp();
        count += 1;
    }
    count
}
