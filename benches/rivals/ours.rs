//! The program's own side of the comparison: the same jobs as `flint.c`, printed the same way.
//!
//!     ours points  K,K,...  D,D,...     point JOB K D SECONDS VALUE   (JOB: B, both from one call)
//!     ours sweep   A B D                all photons A..B: sweep A B D COUNT
//!
//! Seconds are time by the clock of a call, best of several rounds; the sweep is timed from outside.

use claimcheck::model::Layout;
use claimcheck::special::sweep::{Value, sweep};
use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["points", photons, digits] => points(photons, digits),
        ["sweep", first, last, digits] => whole_sweep(first, last, digits),
        _ => None,
    };
    if done.is_none() {
        eprintln!("usage: ours points K,K,... D,D,... | ours sweep A B D");
        return ExitCode::from(2);
    }
    ExitCode::SUCCESS
}

fn points(photons: &str, digits: &str) -> Option<()> {
    for k in photons.split(',') {
        for d in digits.split(',') {
            point(k.parse().ok()?, d.parse().ok()?);
        }
    }
    Some(())
}

fn point(k: u64, digits: u32) {
    let seconds = best(|| {
        black_box(values(k, digits, |mean, variance| {
            black_box((mean.ulps, variance.ulps))
        }));
    });
    let bits = digits * 3322 / 1000 + 64;
    let text = values(k, digits, |_, variance| {
        variance.enclose(bits).to_decimal(digits as usize)
    });
    println!(
        "point B {k} {digits} {seconds:.6e} {}",
        text.unwrap_or_default()
    );
}

/// What `take` makes of the mean and the variance of one photon.
fn values<T>(k: u64, digits: u32, take: impl Fn(Value, Value) -> T) -> Option<T> {
    let block = sweep(&Layout::Triangular, &k.into(), &k.into(), digits)
        .next()?
        .ok()?;
    let photon = block.photons().next()?;
    Some(take(photon.mean()?, photon.variance()?))
}

/// The least seconds a call took, over rounds of at least a millisecond.
fn best(call: impl Fn()) -> f64 {
    let round = || {
        let start = Instant::now();
        for calls in 1.. {
            call();
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
