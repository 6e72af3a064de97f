//! Time of drawing and adding up: strategies 1 and 2 in all lanes, and each way to draw.
//! `benches/rivals` compares it with numpy.

use claimcheck::model::Layout;
use claimcheck::number::Lanes;
use claimcheck::simulate::{Mode, Scene, Simulation};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

/// Shells of 1 to 400 photons.
const PHOTONS: u64 = 80_200;

/// Runs, all of one chunk.
const RUNS: u64 = 96;

fn strategies(criterion: &mut Criterion) {
    for (name, layout) in [
        ("strategy 1", Layout::One),
        ("strategy 2", Layout::Triangular),
    ] {
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements(PHOTONS * RUNS));
        let scene = Scene::new(layout, PHOTONS, RUNS, 1);
        for lanes in Lanes::available() {
            let simulation = Simulation::new(scene.clone()).expect("a good scene");
            let simulation = simulation.with_lanes(lanes);
            group.bench_function(lanes.to_string(), |b| {
                b.iter(|| black_box(&simulation).chunk(0))
            });
        }
        group.finish();
    }
}

/// Every way to draw the photons of shell 100, U alone and radii.
fn modes(criterion: &mut Criterion) {
    for dimension in [None, Some(2), Some(3)] {
        let mut group = criterion.benchmark_group(format!("shell 100, dimension {dimension:?}"));
        group.throughput(Throughput::Elements(100 * RUNS));
        for mode in [Mode::Sorted, Mode::Spacings, Mode::Beta] {
            let only = Some((4951..=5050).collect());
            let scene = Scene {
                mode,
                dimension,
                only,
                ..Scene::new(Layout::Triangular, PHOTONS, RUNS, 1)
            };
            let simulation = Simulation::new(scene).expect("a good scene");
            group.bench_function(format!("{mode:?}"), |b| {
                b.iter(|| black_box(&simulation).chunk(0))
            });
        }
        group.finish();
    }
}

criterion_group!(benches, strategies, modes);
criterion_main!(benches);
