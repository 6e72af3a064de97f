//! The program's own side of the comparison: the same jobs as `flint.c`, printed the same way.
//!
//!     ours points  K,K,...  D,D,... [JOBS]     point JOB K D SECONDS VALUE BITS   (JOB: E, V, or B for both)
//!     ours sweep   A B D                all photons A..B: sweep A B D COUNT
//!     ours doubles A B                 the same as doubles: doubles LANES A B SECONDS COUNT, a line for each lanes
//!     ours simulation M R              strategies 1 and 2, M shells of strategy 2, R runs on one core: simulation STRATEGY LANES
//!                                      SECONDS PHOTONS, a line for each lanes
//!
//!     ours version
//!
//! BITS is the relative accuracy proved. Seconds are time by the clock of a call, best of several rounds; the sweep is timed from outside.

use claimcheck::measure::accuracy::proved_digits;
use claimcheck::model::Layout;
use claimcheck::number::Interval;
use claimcheck::number::Lanes;
use claimcheck::simulate::{Scene, Simulation};
use claimcheck::special::doubles::Doubles;
use claimcheck::special::shell::{Quantity, enclose, enclose_all};
use claimcheck::special::sweep::sweep;
use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["points", photons, digits] => points(photons, digits, "EVB"),
        ["points", photons, digits, jobs] => points(photons, digits, jobs),
        ["sweep", first, last, digits] => whole_sweep(first, last, digits),
        ["doubles", first, last] => doubles(first, last),
        ["simulation", shells, runs] => simulation(shells, runs),
        ["version"] => {
            println!("{}", env!("CARGO_PKG_VERSION"));
            Some(())
        }
        _ => None,
    };
    if done.is_none() {
        eprintln!(
            "usage: ours points K,K,... D,D,... [JOBS] | ours sweep A B D | ours doubles A B | ours simulation M R | ours version"
        );
        return ExitCode::from(2);
    }
    ExitCode::SUCCESS
}

fn points(photons: &str, digits: &str, jobs: &str) -> Option<()> {
    for k in photons.split(',') {
        for d in digits.split(',') {
            for job in jobs.chars() {
                point(job, k.parse().ok()?, d.parse().ok()?)?;
            }
        }
    }
    Some(())
}

fn point(job: char, k: u64, digits: u32) -> Option<()> {
    let shell = Layout::Triangular.shell(&k.into())?;
    let one = |quantity| enclose(quantity, black_box(&shell), digits);
    let quantities = [Quantity::Mean, Quantity::Variance];
    let both = || enclose_all(quantities, black_box(&shell), digits);
    let (seconds, value) = match job {
        'E' => (best(|| one(Quantity::Mean)), one(Quantity::Mean)),
        'V' => (best(|| one(Quantity::Variance)), one(Quantity::Variance)),
        'B' => (best(both), both().map(|[_, variance]| variance)),
        _ => return None,
    };
    print_point(job, k, digits, seconds, &value.ok()?)
}

fn print_point(job: char, k: u64, digits: u32, seconds: f64, value: &Interval) -> Option<()> {
    let text = value.to_decimal(digits as usize);
    let bits = (proved_digits(value)? * 10f64.log2()).floor();
    println!("point {job} {k} {digits} {seconds:.6e} {text} {bits}");
    Some(())
}

/// The least seconds a call took, over rounds of at least a millisecond.
fn best<T>(call: impl Fn() -> T) -> f64 {
    let round = || {
        let start = Instant::now();
        for calls in 1.. {
            black_box(call());
            let spent = start.elapsed().as_secs_f64();
            if spent > 1e-3 {
                return spent / f64::from(calls);
            }
        }
        f64::INFINITY
    };
    (0..15).map(|_| round()).fold(f64::INFINITY, f64::min)
}

fn whole_sweep(first: &str, last: &str, digits: &str) -> Option<()> {
    let (a, b, d): (u64, u64, u32) = (
        first.parse().ok()?,
        last.parse().ok()?,
        digits.parse().ok()?,
    );
    let mut count = 0u64;
    for block in sweep(&Layout::Triangular, &a.into(), &b.into(), d) {
        for photon in block.ok()?.photons() {
            black_box((photon.mean()?, photon.variance()?));
            count += 1;
        }
    }
    println!("sweep {a} {b} {d} {count}");
    Some(())
}

fn doubles(first: &str, last: &str) -> Option<()> {
    let (first, last): (u64, u64) = (first.parse().ok()?, last.parse().ok()?);
    for lanes in Lanes::available() {
        let call = || all_doubles(first, last, lanes);
        let count = call()?;
        println!("doubles {lanes} {first} {last} {:.6e} {count}", best(call));
    }
    Some(())
}

fn all_doubles(first: u64, last: u64, lanes: Lanes) -> Option<usize> {
    let mut doubles = Doubles::new(&Layout::Triangular, first, last)
        .ok()?
        .with_lanes(lanes);
    let mut count = 0;
    while let Some(block) = doubles.next_block().ok()? {
        count += black_box(block).excess.len();
    }
    Some(count)
}

fn simulation(shells: &str, runs: &str) -> Option<()> {
    let (shells, runs): (u64, u64) = (shells.parse().ok()?, runs.parse().ok()?);
    let photons = shells * (shells + 1) / 2;
    for (strategy, layout) in [(1, Layout::One), (2, Layout::Triangular)] {
        let scene = Scene::new(layout, photons, runs, 1);
        for lanes in Lanes::available() {
            let simulation = Simulation::new(scene.clone()).ok()?.with_lanes(lanes);
            let start = Instant::now();
            for chunk in 0..simulation.chunks() {
                black_box(simulation.chunk(chunk));
            }
            let seconds = start.elapsed().as_secs_f64();
            println!(
                "simulation {strategy} {lanes} {seconds:.6e} {}",
                photons * runs
            );
        }
    }
    Some(())
}
