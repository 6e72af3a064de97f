//! Time of the methods of the shell family: photons one by one, whole sweeps, doubles, strategy 1's log
//! forms and ratios of Gamma functions. `benches/rivals` compares them with other programs.

use claimcheck::model::Layout;
use claimcheck::number::Lanes;
use claimcheck::special::doubles::Doubles;
use claimcheck::special::shell::{Method, Quantity, enclose};
use claimcheck::special::sweep::sweep;
use claimcheck::special::{one, ratio};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rug::{Integer, Rational};
use std::hint::black_box;

const DIGITS: [u32; 3] = [15, 50, 1000];

/// The photon of strategy 2, by each method and by the choice.
fn photons(criterion: &mut Criterion) {
    for k in [10u64, 5050, 1_000_000_000_000] {
        let shell = Layout::Triangular
            .shell(&k.into())
            .expect("every k has a shell");
        for digits in DIGITS {
            let mut group = criterion.benchmark_group(format!("photon {k}, {digits} digits"));
            let bits = digits * 10 / 3;
            for method in Method::ALL {
                let run = || method.enclose(Quantity::Variance, black_box(&shell), bits);
                if run().is_ok() {
                    group.bench_function(format!("{method:?}"), |b| b.iter(run));
                }
            }
            group.bench_function("choice", |b| {
                b.iter(|| enclose(Quantity::Variance, black_box(&shell), digits))
            });
            group.finish();
        }
    }
}

/// All photons of some shells.
fn sweeps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sweep 4..5050");
    group.throughput(Throughput::Elements(5047));
    for layout in [Layout::Triangular, Layout::Listing, Layout::One] {
        for digits in DIGITS {
            let (first, last) = (Integer::from(4), Integer::from(5050));
            group.bench_function(format!("{layout:?}, {digits} digits"), |b| {
                b.iter(|| sweep(black_box(&layout), &first, &last, digits).count())
            });
        }
    }
    group.finish();
}

/// The same as doubles: small shells, and shells of 12,000 and 1.4 million photons.
fn doubles(criterion: &mut Criterion) {
    let ranges = [
        (4, 100_000),
        (72_000_000, 73_000_000),
        (1_000_000_000_000, 1_000_001_000_000),
    ];
    for (first, last) in ranges {
        let mut group = criterion.benchmark_group(format!("doubles {first}..{last}"));
        group.throughput(Throughput::Elements(last - first + 1));
        for lanes in Lanes::available() {
            group.bench_function(lanes.to_string(), |b| {
                b.iter(|| {
                    let doubles = Doubles::new(black_box(&Layout::Triangular), first, last);
                    let mut doubles = doubles.expect("in reach").with_lanes(lanes);
                    while let Ok(Some(block)) = doubles.next_block() {
                        black_box(block);
                    }
                })
            });
        }
        group.finish();
    }
}

fn log_forms(criterion: &mut Criterion) {
    for (k, bits) in [
        (10u64, 60),
        (1_000_000, 60),
        (1_000_000, 200),
        (1_000_000, 3330),
    ] {
        let mut group = criterion.benchmark_group(format!("strategy 1, {k}, {bits} bits"));
        for form in one::choose(&k.into(), bits) {
            let k = Integer::from(k);
            group.bench_function(format!("{form:?}"), |b| {
                b.iter(|| form.values(black_box(&k), bits))
            });
        }
        group.finish();
    }
}

fn gamma_ratios(criterion: &mut Criterion) {
    let large = 1_000_000_000_000u64;
    let points = [
        (Rational::from(98), Rational::from(100)),
        (Rational::from((201, 2)), Rational::from(100)),
        (Rational::from((2 * large + 1, 2)), Rational::from(large)),
    ];
    for (x, y) in points {
        for bits in [60, 200, 1000] {
            let mut group =
                criterion.benchmark_group(format!("Gamma({x})/Gamma({y}), {bits} bits"));
            for way in ratio::choose(&x, &y, bits) {
                group.bench_function(format!("{way:?}"), |b| {
                    b.iter(|| way.ratio(black_box(&x), &y, bits))
                });
            }
            group.finish();
        }
    }
}

criterion_group!(benches, photons, sweeps, doubles, log_forms, gamma_ratios);
criterion_main!(benches);
