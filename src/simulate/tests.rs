//! Tests of the whole floor.

use super::*;
use crate::model::Layout;
use crate::special::doubles::Doubles;

/// `E_k - 1` and `Var_k` of the photons of a scene.
fn theory(layout: &Layout, photons: u64) -> Vec<(u64, f64, f64)> {
    let mut doubles = Doubles::new(layout, 1, photons).expect("in reach");
    let mut all = vec![];
    while let Some(block) = doubles.next_block().expect("in reach") {
        let values = block.excess.iter().zip(block.variance);
        all.extend((block.first..).zip(values).map(|(k, (e, v))| (k, *e, *v)));
    }
    all
}

fn sums(scene: &Scene) -> Sums {
    let simulation = Simulation::new(scene.clone()).expect("a good scene");
    let mut all = Sums::new(simulation.photons.clone());
    for chunk in 0..simulation.chunks() {
        all.merge(&simulation.chunk(chunk))
            .expect("the same photons");
    }
    all
}

/// The largest |z| of the means, over the photons with a finite variance.
fn largest_z(scene: &Scene) -> f64 {
    let sums = sums(scene);
    assert_eq!(sums.runs, scene.runs);
    let theory = theory(&scene.layout, scene.photons);
    let z = |(k, excess, variance): &(u64, f64, f64)| {
        let i = sums.photons.binary_search(k).ok()?;
        let error = (variance / sums.runs as f64).sqrt();
        variance
            .is_finite()
            .then(|| ((sums.excess(i) - excess) / error).abs())
    };
    theory.iter().filter_map(z).fold(0.0, f64::max)
}

const MODES: [Mode; 4] = [Mode::Cheapest, Mode::Sorted, Mode::Spacings, Mode::Beta];

#[test]
fn every_way_agrees_with_theory() {
    let layouts = [
        (Layout::Triangular, 66),
        (Layout::One, 40),
        (Layout::Listing, 50),
        (Layout::Unstratified(30.into()), 30),
        (Layout::Sequence(vec![3, 0, 1, 40, 1, 1, 7]), 53),
    ];
    for (layout, photons) in layouts {
        for mode in MODES {
            for dimension in [None, Some(1), Some(2), Some(3), Some(5)] {
                let scene = Scene {
                    mode,
                    dimension,
                    ..Scene::new(layout.clone(), photons, 1003, 1)
                };
                let z = largest_z(&scene);
                assert!(z < 6.0, "{scene:?}: {z}");
            }
        }
    }
}
