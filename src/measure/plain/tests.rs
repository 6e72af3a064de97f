use super::*;
use crate::measure::stability::{Cell, truth};
use proptest::prelude::*;

fn photon(l: f64, m: f64) -> Scene {
    Scene {
        inner: m * (m - 1.0) / 2.0,
        volume: m,
        position: l,
        count: m,
    }
}

fn cell(recipe: Recipe, quantity: Quantity, scene: &Scene) -> Cell {
    let truth = truth(scene).expect("it has values");
    truth.cell(recipe, quantity, scene)
}

#[test]
fn every_recipe_has_photon_50() {
    // The 5th of 10: here even the closed form has some digits of F.
    for recipe in Recipe::ALL {
        let scene = photon(5.0, 10.0);
        let most = match recipe {
            Recipe::Closed => 110,
            // Half a bit a step or so.
            Recipe::Upwards | Recipe::Downwards => 30,
            _ => 20,
        };
        let holds = |quantity, most| {
            let found = cell(recipe, quantity, &scene);
            assert!(found <= Cell::Lost(most), "{recipe:?} {quantity:?} {found}");
        };
        holds(Quantity::Function, most);
        holds(Quantity::Mean, most);
        // E - 1 loses the digits of k more, the variance twice as many: that leaves none of the closed form's.
        holds(Quantity::Excess, most + 20);
        if recipe != Recipe::Closed {
            holds(Quantity::Variance, most + 40);
        }
    }
}

#[test]
fn each_failure_is_told() {
    let at = |recipe, scene: Scene| cell(recipe, Quantity::Function, &scene);
    // z = -2 and z = -1: the terms grow, the terms crawl.
    assert_eq!(at(Recipe::Direct, photon(1.0, 2.0)), Cell::Divergence);
    assert_eq!(at(Recipe::Direct, photon(3.0, 3.0)), Cell::Cost);
    // Coefficients beyond 2^1024; and tiny ones.
    assert_eq!(at(Recipe::Closed, photon(200.0, 400.0)), Cell::Overflow);
    let thick = Scene {
        inner: 100.0,
        volume: 30_000.0,
        position: 15_000.0,
        count: 30_000.0,
    };
    assert!(at(Recipe::Closed, thick) <= Cell::Lost(20));
    // Long walks: errors that grow, and too many steps.
    let far = photon(30_000.0, 60_000.0);
    assert_eq!(at(Recipe::Upwards, far), Cell::Overflow);
    assert_eq!(at(Recipe::Downwards, far), Cell::Overflow);
    assert!(at(Recipe::Middle, far) <= Cell::Lost(20));
    assert_eq!(at(Recipe::Middle, photon(1.0, 60_000.0)), Cell::Cost);
    // A shell much thicker than what it holds, and volumes that are no whole numbers.
    let thick = Scene {
        inner: 0.25,
        volume: 8.0,
        position: 1.0,
        count: 8.0,
    };
    assert_eq!(at(Recipe::Moments, thick), Cell::Divergence);
    assert_eq!(at(Recipe::Certified, thick), Cell::Refusal);
    let centre = Scene {
        inner: 0.0,
        ..thick
    };
    for recipe in Recipe::ALL {
        let any = Interval::from_i64(1, 60);
        let found = recipe.compute(Quantity::Function, &centre, &any);
        assert_eq!(found, Err(Failure::Refusal));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// The wrong end of the shell loses a bit a step, the middle nothing.
    #[test]
    fn the_relation_from_the_middle_keeps_its_digits(m in 2u32..3000, part in 0.0f64..1.0) {
        let m = f64::from(m);
        let scene = photon((m * part).ceil().max(1.0), m);
        prop_assert!(cell(Recipe::Middle, Quantity::Function, &scene) <= Cell::Lost(20));
    }

    /// (l-V)/A + (k/A) x cancels: in mid-shell half the digits of k are lost, at its first photon up to all. Moments lose none.
    #[test]
    fn moments_keep_the_excess_where_pfaff_loses_digits_of_k(k in 4.0f64..1e12, part in 0.0f64..1.0) {
        let m = (2.0 * k).sqrt().round().max(3.0);
        let scene = photon((m * part).ceil().max(1.0), m);
        prop_assert!(cell(Recipe::Moments, Quantity::Excess, &scene) <= Cell::Lost(20), "{scene:?}");
        let all = Cell::Lost((10.0 * k.log10()) as u8 + 25);
        prop_assert!(cell(Recipe::Pfaff, Quantity::Excess, &scene) <= all, "{scene:?}");
    }

    /// The rule follows the peak wherever it is, however narrow.
    #[test]
    fn the_trapezoidal_rule_has_nodes_enough(log_m in 0.0f64..6.0, part in 0.0f64..1.0, log_z in -3.0f64..3.0) {
        let m = 10f64.powf(log_m).round();
        let scene = Scene {
            inner: f64::from((m / 10f64.powf(log_z)) as f32),
            volume: m,
            position: (m * part).ceil().max(1.0),
            count: m,
        };
        prop_assert!(cell(Recipe::Euler, Quantity::Function, &scene) <= Cell::Lost(25), "{scene:?}");
    }
}
