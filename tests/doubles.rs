//! Doubles against enclosures of 100 bits, at random photons up to k = 10^12.
//!
//! `CLAIMCHECK_DOUBLES=10000000` tries so many instead of some thousands, and prints the worst errors seen.
#![cfg(feature = "engine")]

use claimcheck::model::{Layout, Shell};
use claimcheck::number::Interval;
use claimcheck::special::doubles::{Doubles, DoublesError, neighbours};
use claimcheck::special::one;
use claimcheck::special::shell::{Quantity, enclose};
use rug::Float;
use std::thread;

const DIGITS: u32 = 30;
const FARTHEST: u64 = 1_000_000_000_000;

/// Steele, Lea and Flood's SplitMix64: the same photons in every run on as many cores.
struct Random(u64);

impl Random {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// From 1 to `most`, all sizes alike: as many below 10 as between 10 and 100, or 100 and 1000.
    fn size(&mut self, most: u64) -> u64 {
        let share = (self.word() >> 11) as f64 / (1u64 << 53) as f64;
        ((most as f64 + 1.0).powf(share) as u64).clamp(1, most)
    }
}

/// Errors in units of 2^-53 times the value found, and the bounds, worst of all for the mean and the variance.
#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    error: [f64; 2],
    bound: [f64; 2],
    /// The largest share of its own bound that an error takes.
    share: [f64; 2],
    tried: u64,
}

fn point(number: f64) -> Interval {
    let number = Float::with_val(200, number);
    Interval::from_ends(number.clone(), number)
}

/// An upper bound of `|found - truth|/found`.
fn error(found: f64, truth: &Interval) -> f64 {
    let error = point(found).sub(truth).abs().div(&point(found));
    error.expect("it is not 0").high().to_f64()
}

impl Worst {
    fn see(&mut self, found: [f64; 2], bounds: [f64; 2], truth: [Option<Interval>; 2]) {
        self.tried += 1;
        let unit = f64::EPSILON / 2.0;
        for index in 0..2 {
            let error = match &truth[index] {
                Some(truth) => error(found[index], truth),
                None => {
                    assert_eq!(found[index], f64::INFINITY);
                    continue;
                }
            };
            let share = error / bounds[index];
            self.error[index] = self.error[index].max(error / unit);
            self.bound[index] = self.bound[index].max(bounds[index] / unit);
            self.share[index] = self.share[index].max(share);
        }
    }

    fn print(&self, kind: &str) {
        println!("{kind}, {} photons, in units of 2^-53:", self.tried);
        for (index, value) in ["E - 1", "Var"].iter().enumerate() {
            let (error, bound) = (self.error[index], self.bound[index]);
            let share = 100.0 * self.share[index];
            println!(
                "  {value}: worst error {error:.2}, largest bound {bound:.2}, worst error of its own bound {share:.0}%"
            );
        }
    }

    fn join(&mut self, other: Worst) {
        for index in 0..2 {
            self.error[index] = self.error[index].max(other.error[index]);
            self.bound[index] = self.bound[index].max(other.bound[index]);
            self.share[index] = self.share[index].max(other.share[index]);
        }
        self.tried += other.tried;
    }
}

/// The mean less 1 and the variance; `None` is infinite.
fn truth(shell: &Shell) -> [Option<Interval>; 2] {
    [Quantity::Excess, Quantity::Variance].map(|quantity| enclose(quantity, shell, DIGITS).ok())
}

fn of_the_layout(random: &mut Random, layout: &Layout, worst: &mut Worst) {
    let k = random.size(FARTHEST);
    let Some(shell) = layout.shell(&k.into()) else {
        return;
    };
    let mut doubles = Doubles::new(layout, k, k).expect("in reach");
    let block = doubles.next_block().expect("it converges");
    let block = block.expect("a photon");
    let found = [block.excess[0], block.variance[0]];
    let bounds = [block.bounds.excess, block.bounds.variance];
    let truth = match layout {
        Layout::One => {
            let values = one::values(&k.into(), DIGITS);
            let [excess, variance] = values
                .map(|v| [v.excess, v.variance])
                .map_or([None, None], |v| v.map(Some));
            [excess, variance]
        }
        _ => truth(&shell),
    };
    worst.see(found, bounds, truth);
}

/// A photon of any shell.
fn of_a_shell(random: &mut Random, worst: &mut Worst) {
    let size = random.size(1 << 24);
    let inner = size / random.size(3) + random.size(size.saturating_mul(size).min(1 << 40));
    let position = match random.word() % 4 {
        0 => random.size(size),
        1 => size + 1 - random.size(size),
        _ => random.word() % size + 1,
    };
    let shell = Shell {
        inner: inner.into(),
        volume: size.into(),
        position: position.into(),
        count: size.into(),
    };
    let (mut excess, mut variance) = ([0.0], [0.0]);
    let bounds = match neighbours(inner, size, position, &mut excess, &mut variance) {
        Ok(bounds) => bounds,
        // Some shells are too thick for a sweep.
        Err(why) => return assert!(matches!(why, DoublesError::Domain(_))),
    };
    let found = [excess[0], variance[0]];
    worst.see(found, [bounds.excess, bounds.variance], truth(&shell));
}

const KINDS: [&str; 4] = ["strategy 2", "listing", "strategy 1", "any shell"];

/// The kinds in turn, until so many photons have been tried: some are not there.
fn try_photons(count: u64, seed: u64) -> [Worst; KINDS.len()] {
    let (mut random, mut worst) = (Random(seed), [Worst::default(); KINDS.len()]);
    for index in 0u64.. {
        if worst.iter().map(|worst| worst.tried).sum::<u64>() == count {
            break;
        }
        match index % 8 {
            0..4 => of_the_layout(&mut random, &Layout::Triangular, &mut worst[0]),
            4 => of_the_layout(&mut random, &Layout::Listing, &mut worst[1]),
            5 => of_the_layout(&mut random, &Layout::One, &mut worst[2]),
            _ => of_a_shell(&mut random, &mut worst[3]),
        }
    }
    worst
}

#[test]
fn random_photons_are_within_the_bounds() {
    let wanted = std::env::var("CLAIMCHECK_DOUBLES").ok();
    let wanted: u64 = wanted.map_or(4000, |text| text.parse().expect("a number of photons"));
    let threads = thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let each = wanted.div_ceil(threads);
    let mut worst = [Worst::default(); KINDS.len()];
    thread::scope(|scope| {
        let start = |seed| scope.spawn(move || try_photons(each, seed));
        let parts: Vec<_> = (0..threads).map(start).collect();
        for part in parts {
            let found = part.join().expect("no photon fails");
            worst
                .iter_mut()
                .zip(found)
                .for_each(|(worst, found)| worst.join(found));
        }
    });
    for (kind, worst) in KINDS.iter().zip(worst) {
        worst.print(kind);
        assert!(worst.share.iter().all(|share| *share <= 1.0), "{kind}");
    }
    assert!(worst.iter().map(|worst| worst.tried).sum::<u64>() >= wanted);
}
