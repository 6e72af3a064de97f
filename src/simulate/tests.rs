//! Tests of the whole floor; random ones at fixed seeds.

use super::*;
use crate::model::Layout;
use crate::special::doubles::Doubles;
use std::fs;
use std::ops::ControlFlow;
use std::path::PathBuf;

/// `(k, E_k - 1, Var_k)` of the photons of a scene.
fn theory(layout: &Layout, photons: u64) -> Vec<(u64, f64, f64)> {
    let mut doubles = Doubles::new(layout, 1, photons).expect("in reach");
    if *layout == Layout::Listing {
        doubles = Doubles::new(layout, 2, photons).expect("in reach");
    }
    let mut all = vec![];
    while let Some(block) = doubles.next_block().expect("in reach") {
        let values = block.excess.iter().zip(block.variance);
        all.extend((block.first..).zip(values).map(|(k, (e, v))| (k, *e, *v)));
    }
    all
}

fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene.clone()).expect("a good scene")
}

fn run(scene: &Scene) -> Sums {
    let sums = simulation(scene).run(None, |_| ControlFlow::Continue(()));
    sums.expect("no file is written")
}

/// The z-value that is farthest from 0, of the means of the photons with a finite variance.
fn largest_z(scene: &Scene) -> f64 {
    let sums = run(scene);
    assert_eq!(sums.runs, scene.runs);
    let z = |(k, excess, variance): &(u64, f64, f64)| {
        let i = sums.photons.binary_search(k).ok()?;
        let error = (variance / sums.runs as f64).sqrt();
        let z = (sums.excess(i) - excess) / error;
        assert!(
            z.is_finite() || variance.is_infinite(),
            "{scene:?}: k = {k}"
        );
        variance.is_finite().then_some(z.abs())
    };
    let theory = theory(&scene.layout, scene.photons);
    let all: Vec<f64> = theory.iter().filter_map(z).collect();
    assert!(!all.is_empty(), "{scene:?}");
    all.into_iter().fold(0.0, f64::max)
}

const MODES: [Mode; 4] = [Mode::Cheapest, Mode::Sorted, Mode::Spacings, Mode::Beta];

fn layouts() -> [(Layout, u64); 5] {
    [
        (Layout::Triangular, 21),
        (Layout::One, 20),
        (Layout::Listing, 16),
        (Layout::Unstratified(12.into()), 12),
        (Layout::Sequence(vec![3, 0, 1, 1, 8, 1]), 12),
    ]
}

#[test]
fn every_way_agrees_with_theory() {
    for (layout, photons) in layouts() {
        for mode in MODES {
            let scene = Scene {
                mode,
                ..Scene::new(layout.clone(), photons, 4003, 1)
            };
            let z = largest_z(&scene);
            assert!(z < 6.0, "{scene:?}: {z}");
        }
    }
}

#[test]
fn no_dimension_makes_a_difference() {
    for (layout, photons) in layouts() {
        for dimension in [1, 2, 3, 7] {
            for mode in [Mode::Cheapest, Mode::Sorted] {
                let scene = Scene {
                    dimension: Some(dimension),
                    mode,
                    ..Scene::new(layout.clone(), photons, 1003, 2)
                };
                let z = largest_z(&scene);
                assert!(z < 6.0, "{scene:?}: {z}");
                // The same random numbers as without.
                let plain = run(&Scene {
                    dimension: None,
                    ..scene.clone()
                });
                for (a, b) in run(&scene).deviation.iter().zip(&plain.deviation) {
                    assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{scene:?}: {a} {b}");
                }
            }
        }
    }
}

#[test]
fn variances_agree_with_theory() {
    // Far out k/U is nearly normal: then the sample variance has the relative error sqrt(2/n).
    let scene = Scene {
        only: Some((4900..5000).collect()),
        ..Scene::new(Layout::Triangular, 5000, 2000, 3)
    };
    let (sums, theory) = (run(&scene), theory(&scene.layout, 5000));
    for (i, k) in sums.photons.iter().enumerate() {
        let (_, excess, variance) = theory[*k as usize - 1];
        let error = (2.0 / 2000f64).sqrt();
        assert!(
            (sums.variance(i) / variance - 1.0).abs() < 6.0 * error,
            "k = {k}"
        );
        let about_one = variance + excess * excess;
        assert!(
            (sums.about_one(i) / about_one - 1.0).abs() < 6.0 * error,
            "k = {k}"
        );
    }
}

#[test]
fn a_huge_shell_is_drawn_twice_or_by_beta() {
    // More photons than are kept in memory, so that the numbers are drawn again; the last ones, the first, and
    // some between.
    let only = vec![1, 3, 2500, 2501, 4999, 5000, 5001];
    let layout = Layout::Sequence(vec![0, 5000, 1]);
    for mode in [Mode::Spacings, Mode::Cheapest, Mode::Sorted] {
        let scene = Scene {
            mode,
            only: Some(only.clone()),
            ..Scene::new(layout.clone(), 5001, 65, 4)
        };
        assert!(largest_z(&scene) < 6.0, "{scene:?}");
    }
    // 2^40 photons; x is near l/m, and the standard deviation is below 2^-20.
    let n = 1u64 << 40;
    let scene = Scene {
        only: Some(vec![n / 2]),
        ..Scene::new(Layout::Unstratified(n.into()), n, 100, 5)
    };
    assert!(run(&scene).excess(0).abs() < 6.0 * 2f64.powi(-20) / 10.0);
}

#[test]
fn photons_alone_are_those_of_all() {
    for (layout, photons) in layouts() {
        let all = Scene::new(layout, photons, 100, 6);
        let every = run(&all);
        let only = Scene {
            only: Some(vec![12, 9, 5, 9]),
            ..all
        };
        let few = run(&only);
        assert_eq!(few.photons, [5, 9, 12]);
        for (i, k) in few.photons.iter().enumerate() {
            let at = every.photons.binary_search(k).expect("one of all");
            assert_eq!(few.deviation[i], every.deviation[at], "{only:?}");
            assert_eq!(few.square[i], every.square[at]);
        }
    }
}

#[test]
fn samples_are_the_runs() {
    for mode in MODES {
        let scene = Scene {
            mode,
            ..Scene::new(Layout::Triangular, 21, 1003, 7)
        };
        let sums = run(&scene);
        for k in [1u64, 12, 21] {
            let samples = simulation(&scene).samples(k).expect("few");
            assert_eq!(samples.len(), 1003);
            let d = samples.iter().map(|u| k as f64 / u - 1.0);
            let sum = sums.deviation[k as usize - 1];
            assert!((d.sum::<f64>() - sum).abs() < 1e-9 * (1.0 + sum.abs()));
        }
        let missing = simulation(&scene).samples(22);
        assert_eq!(missing, Err(SceneError::NoPhoton(22)));
    }
    let scene = Scene::new(Layout::One, 1, MOST_SAMPLES + 1, 7);
    let many = simulation(&scene).samples(1);
    assert_eq!(many, Err(SceneError::Samples(MOST_SAMPLES + 1)));
}

#[test]
fn sums_are_those_of_higher_precision() {
    use rug::Float;
    let scene = Scene::new(Layout::Triangular, 210, 500, 8);
    let sums = run(&scene);
    for k in [1u64, 7, 200, 210] {
        let i = k as usize - 1;
        let samples = simulation(&scene).samples(k).expect("few");
        let d: Vec<Float> = samples
            .iter()
            .map(|u| Float::with_val(200, k) / u - 1u32)
            .collect();
        let mean = Float::with_val(200, Float::sum(d.iter())) / 500u32;
        let squares: Vec<Float> = d
            .iter()
            .map(|d| Float::with_val(200, d - &mean).square())
            .collect();
        let variance = Float::with_val(200, Float::sum(squares.iter())) / 499u32;
        assert!((sums.excess(i) - mean.to_f64()).abs() < 1e-13 * (1.0 + mean.to_f64().abs()));
        assert!(
            (sums.variance(i) / variance.to_f64() - 1.0).abs() < 1e-12,
            "k = {k}"
        );
    }
}

#[test]
fn sums_add_up() {
    let simulation = simulation(&Scene::new(Layout::One, 50_000, 500, 9));
    assert!(simulation.chunks() > 2);
    let (a, b) = (simulation.chunk(0), simulation.chunk(1));
    let mut both = a.clone();
    both.merge(&b).expect("the same photons");
    let mut other = b.clone();
    other.merge(&a).expect("the same photons");
    assert_eq!(both, other);
    assert_eq!(both.runs, a.runs + b.runs);
    let mut nothing = Sums::new(a.photons.clone());
    nothing.merge(&a).expect("the same photons");
    assert_eq!(nothing, a);
    assert_eq!(both.merge(&Sums::new(vec![1])), Err(OtherPhotons));
    assert_ne!(a.deviation, b.deviation);
    let past = simulation.chunk(simulation.chunks());
    assert_eq!(past, Sums::new(a.photons));
    assert_eq!(simulation.chunk(u64::MAX).runs, 0);
}

#[test]
fn few_runs_have_no_variance() {
    let one = run(&Scene::new(Layout::One, 3, 1, 1));
    assert!(one.mean(0).is_finite() && one.variance(0).is_nan());
    assert!(one.mean(3).is_nan() && one.variance(3).is_nan());
    let equal = Sums {
        runs: 3,
        photons: vec![1],
        deviation: vec![0.3],
        square: vec![0.03],
    };
    assert!(equal.variance(0) >= 0.0);
}

#[test]
fn all_lanes_give_the_same_bits() {
    for (layout, photons) in layouts() {
        for dimension in [None, Some(3)] {
            let scene = Scene {
                dimension,
                ..Scene::new(layout.clone(), photons, 45, 10)
            };
            let mut all =
                Lanes::available().map(|lanes| simulation(&scene).with_lanes(lanes).chunk(0));
            let first = all.next().expect("plain lanes");
            assert!(all.all(|other| other == first), "{scene:?}");
        }
    }
}

#[test]
fn extremes_have_numbers() {
    // One photon in all; k = 1 in the innermost shell, where the mean is infinite.
    for mode in MODES {
        for fault in FAULTS {
            let scene = Scene {
                mode,
                fault,
                ..Scene::new(Layout::Unstratified(1.into()), 1, 100, 11)
            };
            let Ok(simulation) = Simulation::new(scene.clone()) else {
                assert!(fault.is_some_and(Fault::needs_sorting));
                continue;
            };
            let sums = simulation.chunk(0);
            assert!(
                sums.mean(0).is_finite() && sums.variance(0).is_finite(),
                "{scene:?}"
            );
        }
    }
}

/// Some chunks of a small scene.
fn chunky() -> Scene {
    let only = Some((390..=400).collect());
    Scene {
        only,
        ..Scene::new(Layout::Triangular, 200_000, 200, 12)
    }
}

#[test]
fn threads_make_no_difference() {
    let scene = chunky();
    assert!(simulation(&scene).chunks() > 4);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| run(&scene))
    };
    let one = with(1);
    assert_eq!(one.runs, 200);
    assert_eq!(with(2), one);
    assert_eq!(with(7), one);
}

/// A folder of the test's own, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("simulate-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder");
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind is no failure.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Runs with a checkpoint, but stops after some chunks.
fn run_some(scene: &Scene, path: &std::path::Path, chunks: usize) -> Sums {
    let simulation = simulation(scene);
    let mut checkpoint = Checkpoint::open(path, &simulation).expect("a checkpoint");
    let mut left = chunks;
    let watch = |_: &Sums| {
        left -= 1;
        if left == 0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    simulation
        .run(Some(&mut checkpoint), watch)
        .expect("it can be written")
}

#[test]
fn a_run_that_was_cut_goes_on() {
    let folder = Folder::new("cut");
    let (scene, path) = (chunky(), folder.0.join("sums"));
    let whole = run(&scene);
    let some = run_some(&scene, &path, 2);
    assert!(0 < some.runs && some.runs < whole.runs);
    let more = run_some(&scene, &path, 1);
    assert!(some.runs < more.runs && more.runs < whole.runs);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
    let all = pool
        .expect("threads")
        .install(|| run_some(&scene, &path, 1000));
    assert_eq!(all, whole);
    // A finished one is only read.
    assert_eq!(run_some(&scene, &path, 1000), whole);
}

#[test]
fn damaged_checkpoints_are_refused() {
    let folder = Folder::new("damaged");
    let (scene, path) = (chunky(), folder.0.join("sums"));
    run_some(&scene, &path, 2);
    let good = fs::read(&path).expect("it is there");
    let open = |bytes: &[u8], scene: &Scene| {
        fs::write(&path, bytes).expect("it can be written");
        Checkpoint::open(&path, &simulation(scene))
    };
    let runs = open(&good, &scene).expect("a good one").runs();
    assert!(runs > 0);
    let line = good.iter().position(|byte| *byte == b'\n').expect("a line");
    let mut damaged: Vec<Vec<u8>> = vec![vec![], good[..line].to_vec(), good[..=line].to_vec()];
    damaged.push(good[..good.len() - 1].to_vec());
    damaged.push(good[..good.len() - 8].to_vec());
    damaged.push([&good[..], &[0]].concat());
    for place in [0, line, line + 1, line + 100, good.len() - 1] {
        let mut bytes = good.clone();
        bytes[place] ^= 1;
        damaged.push(bytes);
    }
    for bytes in damaged {
        let found = open(&bytes, &scene);
        assert!(
            matches!(
                found,
                Err(CheckpointError::Foreign { .. } | CheckpointError::Other { .. })
            ),
            "{found:?}"
        );
    }
    let other = Scene {
        seed: 13,
        ..scene.clone()
    };
    assert!(matches!(
        open(&good, &other),
        Err(CheckpointError::Other { .. })
    ));
    let longer = Scene {
        only: None,
        ..scene.clone()
    };
    assert!(matches!(
        open(&good, &longer),
        Err(CheckpointError::Other { .. })
    ));
    let text = String::from_utf8_lossy(&good[..=line]).replace("\"scheme\":", "\"scheme\":9");
    assert!(matches!(
        open(text.as_bytes(), &scene),
        Err(CheckpointError::Older { .. })
    ));
    let folder = Checkpoint::open(&folder.0, &simulation(&scene));
    assert!(matches!(folder, Err(CheckpointError::File { .. })));
}

const FAULTS: [Option<Fault>; 7] = [
    None,
    Some(Fault::Estimator),
    Some(Fault::ShellCount),
    Some(Fault::Dropped),
    Some(Fault::Unsorted),
    Some(Fault::Descending),
    Some(Fault::Biased),
];

#[test]
fn every_fault_shows() {
    for fault in FAULTS {
        for mode in MODES {
            let sorting = fault.is_some_and(Fault::needs_sorting);
            let scene = Scene {
                mode,
                fault,
                ..Scene::new(Layout::Triangular, 120, 4096, 14)
            };
            if sorting && matches!(mode, Mode::Spacings | Mode::Beta) {
                assert_eq!(Simulation::new(scene).err(), Some(SceneError::NotSorted));
                continue;
            }
            // The bias of a thousandth is just below what so few runs tell.
            if fault != Some(Fault::Biased) {
                let z = largest_z(&scene);
                assert_eq!(z > 8.0, fault.is_some(), "{scene:?}: {z}");
            }
        }
    }
}

#[test]
fn the_bias_is_a_thousandth() {
    let scene = Scene::new(Layout::Triangular, 120, 200, 15);
    let biased = Scene {
        fault: Some(Fault::Biased),
        ..scene.clone()
    };
    let (good, biased) = (run(&scene), run(&biased));
    for i in 0..120 {
        let ratio = biased.mean(i) / good.mean(i);
        assert!((ratio * (1.0 - Fault::BIAS) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn bad_scenes_are_refused() {
    let good = Scene::new(Layout::Triangular, 21, 10, 1);
    let error = |scene: Scene| Simulation::new(scene).expect_err("a bad scene");
    let of = |layout, photons| Scene {
        layout,
        photons,
        ..good.clone()
    };
    assert_eq!(
        error(Scene {
            runs: 0,
            ..good.clone()
        }),
        SceneError::Empty
    );
    assert_eq!(
        error(Scene {
            only: Some(vec![]),
            ..good.clone()
        }),
        SceneError::Empty
    );
    let many = (1 << 32) + 1;
    assert_eq!(
        error(Scene {
            runs: many,
            ..good.clone()
        }),
        SceneError::Runs(many)
    );
    for d in [0, 65, u32::MAX] {
        let scene = Scene {
            dimension: Some(d),
            ..good.clone()
        };
        assert_eq!(error(scene), SceneError::Dimension(d));
    }
    assert_eq!(error(of(Layout::One, 0)), SceneError::NoPhoton(0));
    assert_eq!(error(of(Layout::Listing, 1)), SceneError::NoPhoton(1));
    assert_eq!(
        error(of(Layout::Unstratified(5.into()), 6)),
        SceneError::NoPhoton(6)
    );
    assert_eq!(
        error(of(Layout::Unstratified(0.into()), 1)),
        SceneError::NoPhoton(1)
    );
    assert_eq!(
        error(of(Layout::Sequence(vec![]), 1)),
        SceneError::NoPhoton(1)
    );
    assert_eq!(
        error(of(Layout::Sequence(vec![2, 0]), 3)),
        SceneError::NoPhoton(3)
    );
    assert_eq!(
        error(of(Layout::Triangular, MOST + 1)),
        SceneError::Photons(MOST + 1)
    );
    assert_eq!(
        error(of(Layout::Triangular, u64::MAX)),
        SceneError::TooFar(u64::MAX)
    );
    for k in [0, 22] {
        let scene = Scene {
            only: Some(vec![3, k]),
            ..good.clone()
        };
        assert_eq!(error(scene), SceneError::NoPhoton(k));
    }
    let huge = of(Layout::Sequence(vec![1 << 27]), 100);
    for mode in [Mode::Sorted, Mode::Spacings] {
        let scene = Scene {
            mode,
            ..huge.clone()
        };
        assert!(matches!(error(scene), SceneError::Shell { .. }));
    }
    assert!(Simulation::new(huge).is_ok());
    for (far, k) in [
        (of(Layout::Sequence(vec![u64::MAX, u64::MAX]), 100), 1),
        (of(Layout::Sequence(vec![5, u64::MAX]), 7), 6),
        (of(Layout::Unstratified(rug::Integer::from(1) << 80), 7), 1),
    ] {
        assert_eq!(error(far), SceneError::TooFar(k));
    }
}

const MOST: u64 = scene::MOST_PHOTONS;
