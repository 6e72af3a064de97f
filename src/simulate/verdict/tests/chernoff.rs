use super::super::chernoff::two_sided;
use super::super::{Statistic, expected};
use super::law;
use crate::model::Layout;

/// For a single run the p-value is known: it is that of U.
#[test]
fn a_bound_is_above_the_chance_of_a_single_run() {
    for (inner, size, l) in [
        (1, 1, 1),
        (9, 1, 1),
        (10, 5, 1),
        (10, 5, 5),
        (0, 10, 10),
        (0, 50, 30),
        (0, 5, 1),
    ] {
        let law = law(inner, size, l);
        for step in 1..200 {
            let x = f64::from(step) / 200.0;
            let volume = inner as f64 + size as f64 * x;
            let inside = law.distribution(volume);
            let chance = 2.0 * inside.min(1.0 - inside);
            let mean = (inner + l) as f64 / volume - 1.0;
            let p = two_sided(&law, Statistic::Deviation, 1, mean, 1e-6);
            assert!(p >= chance.min(1.0), "{inner} {size} {l} {x}: {p} {chance}");
        }
    }
}

/// In the limit the bound is that of the normal law.
#[test]
fn many_runs_have_the_bound_of_the_normal_law() {
    let runs = 1u64 << 32;
    for photon in expected(&Layout::Triangular, &[3, 20, 80_200]).expect("photons") {
        let law = super::super::Law::new(photon.photon);
        for statistic in [Statistic::Deviation, Statistic::Square] {
            for z in [-8.0, -3.0, 3.0, 8.0] {
                let error = photon.scatter(statistic) / (runs as f64).sqrt();
                let mean = photon.mean(statistic) + z * error;
                let p = two_sided(&law, statistic, runs, mean, 1e-18);
                let normal = 2.0 * (-z * z / 2.0f64).exp();
                assert!(
                    (p / normal - 1.0).abs() < 0.02,
                    "{statistic:?} {z}: {p:e} {normal:e}"
                );
            }
        }
    }
}

#[test]
fn means_that_cannot_be() {
    let law = law(1, 1, 1);
    for statistic in [Statistic::Deviation, Statistic::Square] {
        let p = |mean| two_sided(&law, statistic, 100, mean, 1e-10);
        assert!(p(1.1) < 1e-100 && p(f64::INFINITY) == 0.0);
        assert!(p(-0.1) < 1e-100 && p(f64::NEG_INFINITY) == 0.0);
        assert_eq!(p(f64::NAN), 1.0);
    }
}

/// Around Va = 0 a mean may be large by one rare run; far enough out, and for photons with many inside them, it
/// contradicts all the same.
#[test]
fn around_nothing_the_upper_side_is_weak() {
    let p = |l, mean| two_sided(&law(0, 100, l), Statistic::Deviation, 1000, mean, 1e-8);
    assert_eq!(p(1, 1e6), 1.0);
    assert!(p(20, 0.3) < 1e-6);
    assert!(p(60, 0.05) < 1e-6);
    assert!(p(1, 0.5) < 1e-6);
}
