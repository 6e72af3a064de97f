//! Simulations against theory from outside: scenes of every kind agree, planted faults are found, and alarms are as rare as
//! declared.
//!
//! `CLAIMCHECK_NULLS=10000` makes so many runs of the battery on scenes without fault, and `CLAIMCHECK_POWER=1000` so many on
//! scenes with a fault of a thousandth; both print what they count.
#![cfg(feature = "engine")]

use claimcheck::model::Layout;
use claimcheck::simulate::verdict::battery::Verdict;
use claimcheck::simulate::verdict::{battery, power::plan};
use claimcheck::simulate::{Fault, Mode, Scene, Simulation, Sums};
use std::ops::ControlFlow;

const LEVEL: f64 = 1e-6;

fn sums(scene: Scene) -> Sums {
    let simulation = Simulation::new(scene).expect("a scene");
    let all = simulation.run(None, |_| ControlFlow::Continue(()));
    all.expect("no file is written")
}

fn verdict(scene: Scene, level: f64) -> Verdict {
    let layout = scene.layout.clone();
    battery(&layout, &sums(scene), level)
        .expect("theory")
        .verdict
}

/// How often a thing is done.
fn count(variable: &str, otherwise: u64) -> u64 {
    let asked = std::env::var(variable).ok();
    asked
        .and_then(|text| text.parse().ok())
        .unwrap_or(otherwise)
}

/// What a count of alarms exceeds with a chance of 10^-9 at most, if each has this chance (Hoeffding's inequality in its
/// form by relative entropy).
fn exceeds(alarms: u64, runs: u64, chance: f64) -> bool {
    let share = alarms as f64 / runs as f64;
    if share <= chance {
        return false;
    }
    let part = |p: f64, q: f64| if p == 0.0 { 0.0 } else { p * (p / q).ln() };
    let entropy = part(share, chance) + part(1.0 - share, 1.0 - chance);
    runs as f64 * entropy > 9.0 * std::f64::consts::LN_10
}

#[test]
fn scenes_of_every_kind_agree_with_theory() {
    let layouts = [
        (Layout::Unstratified(200.into()), 200),
        (Layout::One, 300),
        (Layout::Triangular, 300),
        (Layout::Listing, 300),
        (Layout::Sequence(vec![5, 1, 40, 2, 1, 1]), 50),
    ];
    for (layout, photons) in layouts {
        for dimension in [None, Some(1), Some(2), Some(3)] {
            for mode in [Mode::Sorted, Mode::Spacings, Mode::Beta] {
                let scene = Scene {
                    dimension,
                    mode,
                    ..Scene::new(layout.clone(), photons, 1000, 5)
                };
                let told = format!("{scene:?}");
                assert_eq!(verdict(scene, LEVEL), Verdict::Agrees, "{told}");
            }
        }
    }
}

#[test]
fn planted_faults_are_found() {
    for fault in [
        Fault::Estimator,
        Fault::ShellCount,
        Fault::Dropped,
        Fault::Unsorted,
        Fault::Descending,
        Fault::Biased,
    ] {
        let scene = Scene {
            fault: Some(fault),
            ..Scene::new(Layout::Triangular, 1275, 4000, 3)
        };
        assert_eq!(verdict(scene, LEVEL), Verdict::Contradicts, "{fault:?}");
    }
}

#[test]
fn false_alarms_are_as_rare_as_declared() {
    let nulls = count("CLAIMCHECK_NULLS", 200);
    for (layout, photons) in [(Layout::Triangular, 21), (Layout::One, 10)] {
        for level in [0.2, 0.05] {
            let null = |seed: &u64| {
                let scene = Scene::new(layout.clone(), photons, 100, *seed);
                verdict(scene, level) == Verdict::Contradicts
            };
            let alarms = (1..=nulls).filter(null).count() as u64;
            println!("{layout:?}, level {level}: {alarms} false alarms of {nulls}");
            assert!(!exceeds(alarms, nulls, level), "{alarms} of {nulls}");
        }
    }
}

#[test]
fn a_fault_of_a_thousandth_is_found_at_the_planned_cost() {
    let tries = count("CLAIMCHECK_POWER", 20);
    for (layout, photons) in [(Layout::Triangular, 21u64), (Layout::One, 10)] {
        let ks: Vec<u64> = (1..=photons).collect();
        let runs = plan(&layout, &ks, LEVEL, Fault::BIAS).expect("a plan").runs;
        let missed = |seed: &u64| {
            let scene = Scene {
                fault: Some(Fault::Biased),
                ..Scene::new(layout.clone(), photons, runs, *seed)
            };
            verdict(scene, LEVEL) == Verdict::Agrees
        };
        let missed = (1..=tries).filter(missed).count() as u64;
        println!("{layout:?}, {photons} photons, {runs} runs: {missed} of {tries} missed");
        assert!(!exceeds(missed, tries, 0.01), "{missed} of {tries}");
    }
}

#[test]
fn a_run_that_is_cut_goes_on_to_the_same_bytes() {
    use claimcheck::simulate::Checkpoint;
    let folder = std::env::temp_dir().join(format!("claimcheck-simulate-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("journal");
    let scene = Scene::new(Layout::Triangular, 20_100, 4000, 9);
    let whole = sums(scene.clone());
    let simulation = Simulation::new(scene).expect("a scene");
    assert!(simulation.chunks() > 4);
    let mut rounds = 0;
    loop {
        let mut checkpoint = Checkpoint::open(&path, &simulation).expect("a journal");
        let before = checkpoint.runs();
        let stop = |_: &Sums| ControlFlow::Break(());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1 + rounds % 2);
        let pool = pool.build().expect("threads");
        let part = pool.install(|| simulation.run(Some(&mut checkpoint), stop));
        let part = part.expect("written");
        assert!(part.runs > before);
        rounds += 1;
        if part.runs == 4000 {
            assert_eq!(part, whole);
            break;
        }
    }
    assert!(rounds > 4);
    std::fs::remove_dir_all(folder).expect("removed");
}
