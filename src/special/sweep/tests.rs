use super::*;
use crate::model::{Moment, moments};
use crate::number::Exact;
use proptest::prelude::*;
use rug::Rational;
use rug::ops::Pow;

/// Enclosures of the exact mean, its excess over 1 and the variance; `None` is `+inf`.
fn truth(k: &Integer, shell: &Shell, bits: u32) -> [Option<Interval>; 3] {
    let exact = moments(k, shell).expect("small");
    let mut variance = None;
    let Moment::Finite(mean) = &exact.mean else {
        return [None, None, None];
    };
    if let Some(Moment::Finite(value)) = exact.variance() {
        variance = Some(value.enclose(bits));
    }
    let excess = mean.sub(&Exact::from_i64(1));
    [
        Some(mean.enclose(bits)),
        Some(excess.enclose(bits)),
        variance,
    ]
}

fn values<'a>(photon: &'a Photon) -> [Option<Value<'a>>; 3] {
    [photon.mean(), photon.excess(), photon.variance()]
}

/// All photons of the range, each compared with the exact values.
fn agrees_with_the_exact_moments(layout: &Layout, last: u32, digits: u32) {
    let bits = digits * 4 + 200;
    let mut k = if layout.shell(&1.into()).is_some() {
        1
    } else {
        2
    };
    for block in sweep(layout, &k.into(), &last.into(), digits) {
        for photon in block.expect("it converges").photons() {
            assert_eq!(photon.number(), k);
            let shell = layout.shell(&k.into()).expect("it has a shell");
            for (found, exact) in values(&photon)
                .iter()
                .zip(truth(&k.into(), &shell, 2 * bits))
            {
                assert_eq!(found.is_some(), exact.is_some(), "{layout:?}, k = {k}");
                if let (Some(found), Some(exact)) = (found, exact) {
                    let found = found.enclose(bits);
                    assert!(found.contains(&exact), "{layout:?}, k = {k}: {found:?}");
                    assert!(found.agrees_to(digits), "{layout:?}, k = {k}: {found:?}");
                }
            }
            k += 1;
        }
    }
    assert_eq!(k, last + 1);
}

#[test]
fn strategy_2_holds_the_exact_values() {
    for (last, digits) in [(400, 15), (400, 50), (150, 120), (60, 200), (60, 1000)] {
        agrees_with_the_exact_moments(&Layout::Triangular, last, digits);
    }
}

#[test]
fn other_layouts_hold_the_exact_values() {
    let layouts = [
        Layout::Listing,
        Layout::One,
        Layout::Unstratified(60.into()),
        Layout::Sequence(vec![1, 50, 2, 0, 7]),
        Layout::Sequence(vec![5, 40, 1, 14]),
    ];
    for layout in &layouts {
        for digits in [1, 15, 60, 400] {
            agrees_with_the_exact_moments(layout, 60, digits);
        }
    }
}

/// All photons of one shell of strategy 2.
fn shell(m: u64, digits: u32) -> Vec<(Integer, [Interval; 2])> {
    let first = Integer::from(m) * (m - 1) / 2u32 + 1u32;
    let last = Integer::from(&first + (m - 1));
    let bits = digits * 4 + 200;
    let mut all = Vec::new();
    for block in sweep(&Layout::Triangular, &first, &last, digits) {
        for photon in block.expect("it converges").photons() {
            let [mean, _, variance] =
                values(&photon).map(|value| value.expect("finite").enclose(bits));
            all.push((photon.number(), [mean, variance]));
        }
    }
    assert_eq!(all.len() as u64, m);
    all
}

#[test]
fn a_whole_shell_adds_up() {
    // The m photons of a shell are uniform in it: the means of 1/U add up to ln((m+1)/(m-1)), those
    // of 1/U^2 to m/(Va (Va+m)).
    for (m, digits) in [
        (2, 50),
        (3, 50),
        (45, 30),
        (300, 50),
        (300, 1000),
        (5000, 15),
        (20_000, 60),
    ] {
        let (mut first, mut second) = (Interval::from_i64(0, 4000), Interval::from_i64(0, 4000));
        for (k, [mean, variance]) in shell(m, digits) {
            let square = mean.square().add(&variance);
            first = first.add(&mean.div_integer(&k).expect("k > 0"));
            second = second.add(&square.div_integer(&k.square()).expect("k > 0"));
        }
        let m = Integer::from(m);
        let inner: Integer = (&m * Integer::from(&m - 1u32)) / 2u32;
        let ratio = Rational::from((Integer::from(&m + 1u32), Integer::from(&m - 1u32)));
        let logarithm = Interval::from_rational(&ratio, 5000)
            .ln()
            .expect("positive");
        let square = Rational::from((m.clone(), Integer::from(&inner + &m) * &inner));
        assert!(
            first.overlaps(&logarithm) && first.agrees_to(digits - 1),
            "m = {m}"
        );
        assert!(
            second.contains_rational(&square) && second.agrees_to(digits - 1),
            "m = {m}"
        );
    }
}

#[test]
fn shells_of_one_photon_come_in_blocks() {
    let blocks: Vec<_> = sweep(&Layout::One, &2.into(), &9000.into(), 40).collect();
    assert_eq!(blocks.len(), 3);
    for block in blocks {
        let block = block.expect("it converges");
        for photon in block.photons().step_by(97) {
            let truth = one::values(&photon.number(), 80).expect("k >= 2");
            let truth = [truth.mean, truth.excess, truth.variance];
            for (found, truth) in values(&photon).into_iter().zip(truth) {
                let found = found.expect("finite").enclose(400);
                assert!(found.contains(&truth) && found.agrees_to(40));
            }
        }
    }
}

fn neighbours(m: u64) -> Neighbours {
    let first = Integer::from(m) * (m - 1) / 2u32 + 1u32;
    let shell = Layout::Triangular
        .shell(&first)
        .expect("every k has a shell");
    Neighbours::new(&shell, m as usize)
}

/// The error of each g in ulps, started at an index and rounded as the theorem has it.
fn errors(block: &Neighbours, scale: u32, start: usize) -> Vec<Integer> {
    let plan = Plan {
        start,
        ..Plan::new(block, 1).with_scale(scale)
    };
    let fine = Plan::new(block, 1).with_scale(scale + 300);
    let means = |plan: &Plan| {
        let mut means = vec![Integer::new(); block.count];
        integers::outwards(block, plan, |index, g| means[index].clone_from(g))
            .expect("it converges");
        means
    };
    let (rough, truth) = (means(&plan), means(&fine));
    rough
        .iter()
        .zip(truth)
        .map(|(r, t)| (r - (t >> 300u32)).abs())
        .collect()
}

#[test]
fn outwards_from_the_middle_no_error_grows() {
    for m in [3, 10, 100, 1414, 4000] {
        let block = neighbours(m);
        let plan = Plan::new(&block, 30);
        let bound = plan::START + (m as f64).sqrt().ceil() as u32 + 1;
        let worst = errors(&block, plan.scale, plan.start).into_iter().max();
        assert!(worst.is_some_and(|worst| worst <= bound), "m = {m}");
    }
}

#[test]
fn from_an_end_the_relation_loses_a_bit_a_photon() {
    let block = neighbours(100);
    for start in [0, 99] {
        let errors = errors(&block, 400, start);
        let lost = errors[49].significant_bits();
        assert!((90..=105).contains(&lost), "{lost} bits lost by the middle");
        // It regains them on the way to the other end.
        assert!(errors[99 - start] <= 40);
    }
}

#[test]
fn words_and_integers_hold_the_same_values() {
    for (m, digits) in [
        (3, 15),
        (40, 15),
        (40, 30),
        (447, 50),
        (2000, 60),
        (300, 110),
    ] {
        let block = neighbours(m);
        let plan = Plan::new(&block, digits);
        let words = words::columns(&block, &plan).expect("it converges");
        let words = words.expect("one word suffices");
        let integers = integers::columns(&block, &plan).expect("it converges");
        for (one, other) in words.iter().zip(&integers) {
            for index in 0..block.count {
                let enclose = |column: &Column| column.value(index).map(|value| value.enclose(600));
                let both = enclose(one).zip(enclose(other));
                assert!(
                    both.is_some_and(|(a, b)| a.overlaps(&b)),
                    "m = {m}, index {index}"
                );
            }
        }
    }
}

#[test]
fn ranges_begin_and_end_anywhere() {
    // More photons of one shell than a block holds, in three pieces.
    let first: Integer = Integer::from(10).pow(12);
    let last = Integer::from(&first + 10_000u32);
    let blocks: Vec<_> = sweep(&Layout::Triangular, &first, &last, 15).collect();
    let blocks: Vec<Block> = blocks
        .into_iter()
        .map(|block| block.expect("it converges"))
        .collect();
    assert_eq!(
        blocks.iter().map(|block| block.count).sum::<usize>(),
        10_001
    );
    for (index, photon) in blocks.iter().flat_map(Block::photons).enumerate() {
        assert_eq!(photon.number(), Integer::from(&first + index as u64));
    }
    assert!(
        sweep(&Layout::Triangular, &5.into(), &4.into(), 15)
            .next()
            .is_none()
    );
    assert_eq!(
        sweep(&Layout::Sequence(vec![3, 4]), &2.into(), &100.into(), 15).count(),
        2
    );
}

#[test]
fn huge_photons_and_thick_shells() {
    for exponent in [18u32, 30, 60] {
        let k = Integer::from(10).pow(exponent) + 12_345u32;
        let last = Integer::from(&k + 3u32);
        for block in sweep(&Layout::Triangular, &k, &last, 40) {
            let block = block.expect("it converges");
            for photon in block.photons() {
                let [_, excess, variance] =
                    values(&photon).map(|v| v.expect("finite").enclose(300));
                assert!(excess.agrees_to(40) && variance.agrees_to(40));
                // 0 < E_k - 1 < 1/k.
                let most = Interval::from_i64(1, 300)
                    .div_integer(&photon.number())
                    .expect("k > 0");
                assert!(*excess.low() > 0 && excess.is_below(&most));
            }
        }
    }
    let thick = Layout::Sequence(vec![1, 100_000]);
    let some = sweep(&thick, &2.into(), &40.into(), 30)
        .next()
        .expect("one block");
    for photon in some.expect("it converges").photons() {
        let mean = photon.mean().expect("finite").enclose(200);
        assert!(mean.agrees_to(30) && mean.is_below(&Interval::from_i64(2, 200)));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_photon_alone_and_in_company(
        k in 2u64..2_000_000_000, before in 0u64..50, after in 0u64..50, digits in 1u32..130,
    ) {
        let (first, last) = (k.saturating_sub(before).max(2), k + after);
        let alone = sweep(&Layout::Triangular, &k.into(), &k.into(), digits).next();
        let alone = alone.expect("one block").expect("it converges");
        let alone = alone.photons().next().expect("one photon");
        for block in sweep(&Layout::Triangular, &first.into(), &last.into(), digits + 5) {
            let block = block.expect("it converges");
            for photon in block.photons().filter(|photon| photon.number() == k) {
                for (one, other) in values(&alone).into_iter().zip(values(&photon)) {
                    let [one, other] = [one, other].map(|v| v.expect("finite").enclose(700));
                    prop_assert!(one.overlaps(&other) && one.agrees_to(digits) && other.agrees_to(digits + 5));

                }
            }
        }
    }
}
