use super::*;
use crate::number::Interval;
use crate::special::sweep::{Value, sweep};
use rug::Float;

/// Digits of the enclosures that the doubles are compared with: some 100 bits.
const DIGITS: u32 = 30;

fn point(number: f64) -> Interval {
    let number = Float::with_val(160, number);
    Interval::from_ends(number.clone(), number)
}

/// The error of a double in units of its bound, at most.
fn error(found: f64, bound: f64, truth: Option<Value>) -> f64 {
    match truth {
        Some(truth) if found.is_finite() => {
            let error = point(found).sub(&truth.enclose(160)).abs();
            let units = error.div(&point(found).mul(&point(bound)));
            units.expect("the bound is positive").high().to_f64()
        }
        None if found == f64::INFINITY => 0.0,
        _ => f64::INFINITY,
    }
}

/// The worst errors of the two values of all photons of a range, in units of the bounds.
fn worst(layout: &Layout, first: u64, last: u64) -> [f64; 2] {
    let mut worst = [0.0f64; 2];
    let mut doubles = Doubles::new(layout, first, last).expect("in reach");
    let mut next = first;
    while let Some(block) = doubles.next_block().expect("it converges") {
        assert_eq!(block.first, next);
        let values = block.excess.iter().zip(block.variance);
        next += values.len() as u64;
        let mut values = values.enumerate();
        for truth in sweep(layout, &block.first.into(), &(next - 1).into(), DIGITS) {
            for photon in truth.expect("it converges").photons() {
                let (index, (excess, variance)) = values.next().expect("as many");
                assert_eq!(photon.number(), block.first + index as u64);
                worst[0] = worst[0].max(error(*excess, block.bounds.excess, photon.excess()));
                worst[1] = worst[1].max(error(*variance, block.bounds.variance, photon.variance()));
            }
        }
        assert!(values.next().is_none());
    }
    assert_eq!(next, last + 1);
    worst
}

fn holds(layout: &Layout, first: u64, last: u64) {
    let worst = worst(layout, first, last);
    println!("{layout:?} {first}..{last}: {worst:?}");
    assert!(
        worst.iter().all(|error| *error <= 1.0),
        "{layout:?}: {worst:?}"
    );
}

#[test]
fn strategy_2_is_within_its_bounds() {
    holds(&Layout::Triangular, 1, 3000);
    for first in [100_000, 10u64.pow(8), 34_359_738_000, 10u64.pow(12)] {
        holds(&Layout::Triangular, first, first + 300);
    }
}
