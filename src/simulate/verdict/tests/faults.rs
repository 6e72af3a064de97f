//! Planted faults are found.

use super::super::battery::{Verdict, battery, findings};
use super::super::power::plan;
use super::super::sequential::Watch;
use super::super::{Error, Report};
use super::*;

const LEVEL: f64 = 1e-6;

fn report(scene: &Scene, seed: u64, runs: u64, fault: Fault) -> Report {
    let sums = scene.simulate(&mut random(seed), runs, fault);
    battery(&scene.layout, &sums, LEVEL).expect("in order")
}

#[test]
fn a_sound_simulation_agrees() {
    for scene in scenes() {
        let report = report(&scene, 3, 2000, Fault::None);
        assert_eq!(report.verdict, Verdict::Agrees, "{report:?}");
        assert_eq!(report.contradictions, 0);
        assert_eq!(report.tests, 2 * report.photons);
        assert!(report.chi_square.score.abs() < 4.0);
    }
}

#[test]
fn gross_faults_are_found() {
    let faults = [
        Fault::Estimator,
        Fault::ShellCount,
        Fault::Dropped,
        Fault::Descending,
    ];
    for (scene, runs) in scenes().iter().zip([1000, 1000, 2000]) {
        for fault in faults {
            // One photon has no order, and its shell none without it.
            if scene.layout == Layout::One && fault == Fault::Descending {
                continue;
            }
            let report = report(scene, 4, runs, fault);
            assert_eq!(
                report.verdict,
                Verdict::Contradicts,
                "{} {fault:?} {report:?}",
                scene.name
            );
            assert!(!report.named.is_empty() && report.contradictions > 0);
        }
    }
}

/// Finds the fault in at least 99 of 100 simulations, as planned.
fn measure(scene: &Scene, fault: f64, simulations: u64) {
    let plan = plan(&scene.layout, &scene.photons(), LEVEL, fault).expect("a plan");
    let mut random = random(11);
    let mut missed = 0;
    for _ in 0..simulations {
        let sums = scene.simulate(&mut random, plan.runs, Fault::Mean(fault));
        let report = battery(&scene.layout, &sums, LEVEL).expect("in order");
        missed += u64::from(report.verdict == Verdict::Agrees);
    }
    println!(
        "{}, fault {fault}: {plan:?}, missed {missed} of {simulations}",
        scene.name
    );
    assert!(missed <= most_alarms(simulations, 0.01, 1e-9));
}

#[test]
fn small_faults_of_the_mean_are_found_as_planned() {
    let [triangular, one, _] = scenes();
    measure(&triangular, 0.01, simulations(30));
    measure(&one, 0.01, simulations(30));
    measure(&triangular, 0.001, simulations(100) / 100);
    measure(&one, 0.001, simulations(100) / 100);
}

#[test]
fn the_sequential_test_stops_by_itself() {
    let [scene, ..] = scenes();
    let plan = plan(&scene.layout, &scene.photons(), LEVEL, 0.01).expect("a plan");
    let mut random = random(12);
    for _ in 0..5 {
        let mut watch = Watch::new(&scene.layout, &scene.photons(), LEVEL).expect("photons");
        while !watch.contradicts() && watch.runs() < 4 * plan.runs {
            let chunk = scene.simulate(&mut random, 50, Fault::Mean(0.01));
            watch.feed(&chunk).expect("the same photons");
        }
        println!(
            "found after {} runs, the battery plans {}",
            watch.runs(),
            plan.runs
        );
        assert!(watch.contradicts());
    }
}

#[test]
fn the_sequential_test_reaches_a_precision() {
    let [scene, _, unstratified] = scenes();
    let ks = scene.photons();
    let mut random = random(13);
    let mut watch = Watch::new(&scene.layout, &ks[2..], 0.01).expect("photons");
    assert!(watch.intervals().iter().all(Option::is_none));
    while !watch.is_precise(0.1) {
        assert!(watch.runs() < 10_000);
        let mut chunk = scene.simulate(&mut random, 50, Fault::None);
        chunk.photons.drain(..2);
        chunk.deviation.drain(..2);
        chunk.square.drain(..2);
        watch.feed(&chunk).expect("the same photons");
    }
    println!("precise to 0.1 after {} runs", watch.runs());
    assert!(!watch.contradicts());
    // Around Va = 0 there is no lower end: one rare run may have made the mean.
    let mut watch =
        Watch::new(&unstratified.layout, &unstratified.photons(), 0.01).expect("photons");
    let chunk = unstratified.simulate(&mut random, 1000, Fault::None);
    watch.feed(&chunk).expect("the same photons");
    let interval = watch.intervals()[9].expect("runs");
    assert_eq!(interval.low, f64::NEG_INFINITY);
    assert!(interval.high.is_finite() && !watch.is_precise(1e6));
}

#[test]
fn what_is_no_simulation() {
    let good = Sums {
        runs: 10,
        photons: vec![2, 3],
        deviation: vec![0.0; 2],
        square: vec![0.0; 2],
    };
    let fails = |sums: Sums| battery(&Layout::One, &sums, 0.1).expect_err("it is wrong");
    let none = Sums {
        runs: 0,
        ..good.clone()
    };
    assert_eq!(fails(none), Error::Empty);
    let short = Sums {
        square: vec![0.0],
        ..good.clone()
    };
    assert_eq!(fails(short.clone()), Error::Empty);
    let nan = Sums {
        square: vec![0.0, f64::NAN],
        ..good.clone()
    };
    assert_eq!(fails(nan.clone()), Error::NotANumber(3));
    let wrong = battery(&Layout::One, &good, 1.5);
    assert_eq!(wrong.expect_err("no level"), Error::Level(1.5));
    let mut watch = Watch::new(&Layout::One, &[2, 3], 0.1).expect("photons");
    assert_eq!(watch.feed(&short), Err(Error::Empty));
    assert_eq!(watch.feed(&nan), Err(Error::NotANumber(3)));
    assert_eq!(watch.runs(), 0);
    assert!(Watch::new(&Layout::One, &[], 0.1).is_err());
    assert_eq!(plan(&Layout::One, &[], 0.1, 0.1), Err(Error::Empty));
    assert_eq!(plan(&Layout::One, &[1], 0.1, 0.1), Err(Error::Empty));
    assert_eq!(plan(&Layout::One, &[2], 0.1, -1.0), Err(Error::Fault(-1.0)));
}

/// An infinite sum, as of a run with U = 0, has no chance.
#[test]
fn infinite_sums() {
    let infinite = |photons: Vec<u64>| Sums {
        runs: 10,
        photons,
        deviation: vec![f64::INFINITY, 3.9],
        square: vec![f64::INFINITY, 2.2],
    };
    for photons in [vec![1, 2], vec![2, 3]] {
        let found = findings(&Layout::One, &infinite(photons), LEVEL).expect("in order");
        assert!(found[0].p < 1e-8 && found[1].p < 1e-8);
    }
    let report = battery(&Layout::One, &infinite(vec![1, 2]), LEVEL).expect("in order");
    assert_eq!(report.named, [1]);
    assert_eq!(report.weak_from_above, 1);
}
