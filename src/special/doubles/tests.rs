use super::*;
use crate::model::Shell;
use crate::number::Interval;
use crate::special::shell::{Quantity, enclose};
use crate::special::sweep::{Value, sweep};
use proptest::prelude::*;
use rug::{Float, Rational};

/// Digits of the enclosures that the doubles are compared with: some 100 bits.
const DIGITS: u32 = 30;

fn point(number: f64) -> Interval {
    let number = Float::with_val(160, number);
    Interval::from_ends(number.clone(), number)
}

/// The error of a finite double in units of its bound, at most.
fn share(found: f64, bound: f64, truth: &Interval) -> f64 {
    let units = point(found)
        .sub(truth)
        .abs()
        .div(&point(found).mul(&point(bound)));
    units.expect("the bound is positive").high().to_f64()
}

/// The same; for infinite values, whether both are.
fn error(found: f64, bound: f64, truth: Option<Value>) -> f64 {
    match truth {
        Some(truth) if found.is_finite() => share(found, bound, &truth.enclose(160)),
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
    holds(&Layout::Triangular, 1, 2500);
    // At 34,359,738,368 = 2^35 the numbers D stop being exact.
    for first in [100_000, 10u64.pow(8), (1 << 35) - 150, 10u64.pow(12)] {
        holds(&Layout::Triangular, first, first + 200);
    }
}

#[test]
fn the_other_layouts_are_within_their_bounds() {
    holds(&Layout::Listing, 2, 800);
    holds(&Layout::One, 1, 400);
    for first in [10u64.pow(6), 10u64.pow(9), 10u64.pow(12)] {
        holds(&Layout::Listing, first, first + 100);
        holds(&Layout::One, first, first + 100);
    }
    holds(&Layout::Unstratified(1.into()), 1, 1);
    holds(&Layout::Unstratified(700.into()), 1, 700);
    let huge = Layout::Unstratified(10u64.pow(12).into());
    holds(&huge, 1, 30);
    holds(&huge, 10u64.pow(12) - 30, 10u64.pow(12));
    // Empty shells, thin ones, and one that is thick.
    let sequence = Layout::Sequence(vec![0, 40, 0, 0, 1, 1, 7, 600, 2, 1500, 3, 0]);
    holds(&sequence, 1, 2154);
}

#[test]
fn one_photon_layouts_meet_at_the_series_first() {
    let first = one::FIRST;
    holds(&Layout::One, first - 1, first + 9);
    let [mut excess, mut variance] = [[0.0; 3]; 2];
    assert!(neighbours(first, 1, 1, &mut excess[..1], &mut variance[..1]).is_ok());
}

/// What the header says of strategy 2.
#[test]
fn the_bounds_of_strategy_2() {
    let unit = f64::EPSILON / 2.0;
    let counts = (8..3000).chain((3000..1_500_000).step_by(997));
    for m in counts {
        let (_, bounds) = Moments::new(m * (m - 1) / 2, m).expect("in reach");
        let most = match m {
            ..40 => continue,
            40..262_000 => [3.6, 13.2],
            _ => [5.1, 17.1],
        };
        assert!(
            bounds.excess <= most[0] * unit && bounds.variance <= most[1] * unit,
            "{m}: {bounds:?}"
        );
    }
}

/// The share of the bound that a photon of any shell takes, for both values.
fn shares(inner: u64, size: u64, position: u64) -> [f64; 2] {
    let (mut excess, mut variance) = ([0.0], [0.0]);
    let bounds = neighbours(inner, size, position, &mut excess, &mut variance);
    let bounds = bounds.expect("it converges");
    let shell = Shell {
        inner: inner.into(),
        volume: size.into(),
        position: position.into(),
        count: size.into(),
    };
    let truth = |quantity| enclose(quantity, &shell, DIGITS).expect("it has a value");
    [
        share(excess[0], bounds.excess, &truth(Quantity::Excess)),
        share(variance[0], bounds.variance, &truth(Quantity::Variance)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn photons_of_strategy_2(exponent in 1.0..12.0f64) {
        let k = 10f64.powf(exponent) as u64;
        let shell = Layout::Triangular.shell(&k.into()).expect("a photon");
        let word = |number: &Rational| number.numer().to_u64().expect("small");
        let position = shell.position.to_u64().expect("small");
        for share in shares(word(&shell.inner), word(&shell.volume), position) {
            prop_assert!(share <= 1.0);
        }
    }

    #[test]
    fn photons_of_any_shell(
        volumes in (0.0..25.9f64, 1.0..24.0f64), place in 0.0..1.0f64, at_an_end in any::<bool>(),
    ) {
        let size = volumes.0.exp2() as u64;
        let inner = 2 * size + volumes.0.max(volumes.1).exp2() as u64 * size / 8;
        let position = match at_an_end {
            true => ((size as f64).powf(place)) as u64,
            false => (size as f64 * place) as u64 + 1,
        };
        for share in shares(inner, size, position) {
            prop_assert!(share <= 1.0, "{inner} {size} {position}: {share}");
        }
    }
}

/// All values of a range as bits, and the bounds.
fn bits(layout: &Layout, first: u64, last: u64, lanes: Lanes) -> Vec<u64> {
    let mut doubles = Doubles::new(layout, first, last)
        .expect("in reach")
        .with_lanes(lanes);
    let mut bits = Vec::new();
    while let Some(block) = doubles.next_block().expect("it converges") {
        let bounds = [block.bounds.excess, block.bounds.variance];
        let values = block.excess.iter().chain(block.variance).chain(&bounds);
        bits.extend(values.map(|value| value.to_bits()));
    }
    bits
}

#[test]
fn all_lanes_give_the_same_bits() {
    let sequence = Layout::Sequence(vec![1000, 33, 2_000, 5, 1]);
    let ranges = [
        (&Layout::Triangular, 30, 20_000),
        (
            &Layout::Triangular,
            10u64.pow(12) - 777,
            10u64.pow(12) + 5_000,
        ),
        (&Layout::Listing, 1_000_000, 1_005_000),
        (&Layout::One, 1, 5_001),
        (&sequence, 1, 3_039),
    ];
    for (layout, first, last) in ranges {
        let plain = bits(
            layout,
            first,
            last,
            Lanes::available().next().expect("plain"),
        );
        for lanes in Lanes::available() {
            assert_eq!(bits(layout, first, last, lanes), plain, "{lanes:?}");
        }
    }
}

/// What the tests above would miss if they could not see a wrong bound.
#[test]
fn a_bound_that_is_too_small_is_noticed() {
    let mut worst = [0.0f64; 2];
    let mut doubles = Doubles::new(&Layout::Triangular, 5000, 8000).expect("in reach");
    while let Some(block) = doubles.next_block().expect("it converges") {
        let tenth = [block.bounds.excess, block.bounds.variance].map(|bound| bound / 10.0);
        let truths = sweep(
            &Layout::Triangular,
            &block.first.into(),
            &8000.into(),
            DIGITS,
        );
        let truth = truths
            .into_iter()
            .next()
            .expect("a block")
            .expect("it converges");
        for (index, photon) in truth.photons().enumerate().take(block.excess.len()) {
            worst[0] = worst[0].max(error(block.excess[index], tenth[0], photon.excess()));
            worst[1] = worst[1].max(error(block.variance[index], tenth[1], photon.variance()));
        }
    }
    assert!(worst.iter().all(|error| *error > 1.0), "{worst:?}");
}

#[test]
fn what_is_no_shell_or_too_far_is_refused() {
    let fill = |inner, size, position, places| {
        let (mut excess, mut variance) = (vec![0.0; places], vec![0.0; places]);
        neighbours(inner, size, position, &mut excess, &mut variance).err()
    };
    assert_eq!(fill(10, 4, 1, 4), None);
    assert_eq!(fill(10, 4, 4, 0), None);
    for (position, places) in [(0, 1), (5, 1), (5, 0), (2, 4), (u64::MAX, 1)] {
        assert_eq!(fill(10, 4, position, places), Some(DoublesError::NoShell));
    }
    assert_eq!(
        neighbours(10, 4, 1, &mut [0.0], &mut []),
        Err(DoublesError::NoShell)
    );
    assert_eq!(fill(FARTHEST, 1, 1, 1), Some(DoublesError::TooFar));
    assert_eq!(fill(u64::MAX, u64::MAX, 1, 1), Some(DoublesError::TooFar));
    let layout = Layout::Sequence(vec![5, u64::MAX]);
    let mut doubles = Doubles::new(&layout, 1, 10).expect("the first shell is near");
    assert!(doubles.next_block().expect("5 photons").is_some());
    for _ in 0..2 {
        assert_eq!(doubles.next_block(), Err(DoublesError::TooFar));
    }
    let whole = Layout::Unstratified(u64::MAX.into());
    assert!(matches!(
        Doubles::new(&whole, 1, 2),
        Err(DoublesError::TooFar)
    ));
}

#[test]
fn photons_that_are_not_there_are_left_out() {
    for (layout, first, last) in [
        (Layout::Listing, 1, 9),
        (Layout::Triangular, 0, 9),
        (Layout::Triangular, 9, 8),
        (Layout::Unstratified(5.into()), 6, 9),
        (Layout::Sequence(vec![]), 1, 9),
    ] {
        let mut doubles = Doubles::new(&layout, first, last).expect("in reach");
        assert_eq!(doubles.next_block(), Ok(None), "{layout:?}");
    }
    holds(&Layout::Sequence(vec![2, 3, 0]), 4, 5);
    let layout = Layout::Sequence(vec![2, 3, 0]);
    let mut doubles = Doubles::new(&layout, 4, 100).expect("in reach");
    let block = doubles
        .next_block()
        .expect("it converges")
        .expect("2 photons");
    assert_eq!(
        (block.first, block.inner, block.size, block.excess.len()),
        (4, 2, 3, 2)
    );
    assert_eq!(doubles.next_block(), Ok(None));
}
