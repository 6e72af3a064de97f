//! Simulations without a fault: false alarms are no more frequent than declared.

use super::super::battery::{Verdict, battery};
use super::super::kolmogorov::kolmogorov;
use super::super::sequential::Watch;
use super::*;

const LEVELS: [f64; 2] = [0.2, 0.05];

/// What too many false alarms are: a chance of one in 10^9.
const RARE: f64 = 1e-9;

fn holds(what: &str, alarms: u64, simulations: u64, level: f64) {
    println!("{what}, level {level}: {alarms} alarms in {simulations}");
    assert!(alarms <= most_alarms(simulations, level, RARE), "{what}");
}

#[test]
fn the_battery_holds_its_level() {
    let simulations = simulations(60);
    for (number, scene) in scenes().iter().enumerate() {
        for runs in [50, 200, 1000] {
            let mut random = random(runs + number as u64);
            let mut alarms = [0; 2];
            for _ in 0..simulations {
                let sums = scene.simulate(&mut random, runs, Fault::None);
                for (count, level) in alarms.iter_mut().zip(LEVELS) {
                    let report = battery(&scene.layout, &sums, level).expect("in order");
                    *count += u64::from(report.verdict == Verdict::Contradicts);
                }
            }
            for (count, level) in alarms.into_iter().zip(LEVELS) {
                let what = format!("battery, {}, {runs} runs", scene.name);
                holds(&what, count, simulations, level);
            }
        }
    }
}

#[test]
fn the_sequential_test_holds_its_level() {
    let simulations = simulations(60);
    for (number, scene) in scenes().iter().enumerate() {
        let mut random = random(100 + number as u64);
        let fresh = LEVELS.map(|level| Watch::new(&scene.layout, &scene.photons(), level));
        let fresh = fresh.map(|watch| watch.expect("photons"));
        let mut alarms = [0; 2];
        let mut astray = 0;
        for _ in 0..simulations {
            let mut watches = fresh.clone();
            let mut left = false;
            for look in 0..40 {
                let chunk = scene.simulate(&mut random, 10, Fault::None);
                for watch in &mut watches {
                    watch.feed(&chunk).expect("the same photons");
                }
                left |= look % 10 == 9 && leaves_theory(&watches[0]);
            }
            for (count, watch) in alarms.iter_mut().zip(&watches) {
                *count += u64::from(watch.contradicts());
            }
            astray += u64::from(left);
        }
        for (count, level) in alarms.into_iter().zip(LEVELS) {
            holds(
                &format!("sequential, {}", scene.name),
                count,
                simulations,
                level,
            );
        }
        holds(
            &format!("intervals, {}", scene.name),
            astray,
            simulations,
            LEVELS[0],
        );
    }
}

/// Whether an interval does not hold the mean that theory has, if it has one.
fn leaves_theory(watch: &Watch) -> bool {
    let pairs = watch.theory().zip(watch.intervals());
    let mut finite = pairs.filter(|(mean, _)| mean.is_finite());
    finite.any(|(mean, interval)| interval.is_none_or(|it| mean < it.low || mean > it.high))
}

#[test]
fn kolmogorov_holds_its_level() {
    let simulations = simulations(300);
    for (number, (inner, size, l)) in [(0, 10, 1), (15, 6, 3), (4, 1, 1)].into_iter().enumerate() {
        let law = law(inner, size, l);
        for samples in [1, 20, 200] {
            let mut random = random(samples + 7 * number as u64);
            let mut alarms = [0; 2];
            for _ in 0..simulations {
                let volumes = (0..samples).map(|_| volume(&mut random, inner, size, l));
                let found = kolmogorov(&law, volumes.collect()).expect("samples");
                for (count, level) in alarms.iter_mut().zip(LEVELS) {
                    *count += u64::from(found.p <= level);
                }
            }
            for (count, level) in alarms.into_iter().zip(LEVELS) {
                let what = format!("Kolmogorov, {inner} {size} {l}, {samples} samples");
                holds(&what, count, simulations, level);
            }
        }
    }
}

fn volume(random: &mut Xoshiro256PlusPlus, inner: u64, size: u64, l: u64) -> f64 {
    let mut shares: Vec<f64> = (0..size).map(|_| uniform(random)).collect();
    shares.sort_unstable_by(f64::total_cmp);
    inner as f64 + size as f64 * shares[l as usize - 1]
}

/// The law of the next photon is another one.
#[test]
fn kolmogorov_finds_the_wrong_photon() {
    let mut random = random(5);
    let samples = (0..300).map(|_| volume(&mut random, 15, 6, 3)).collect();
    let found = kolmogorov(&law(15, 6, 4), samples).expect("samples");
    assert!(found.p < 1e-6, "{found:?}");
}

#[test]
fn the_binomial_bound() {
    // P(Bin(10, 1/2) > 9) = 1/1024, P(> 8) = 11/1024.
    assert_eq!(most_alarms(10, 0.5, 0.001), 9);
    assert_eq!(most_alarms(10, 0.5, 0.0107), 9);
    assert_eq!(most_alarms(10, 0.5, 0.0108), 8);
    // Six standard deviations of 40 above 2000.
    let many = most_alarms(10_000, 0.2, 1e-9);
    assert!((2235..2250).contains(&many), "{many}");
}
