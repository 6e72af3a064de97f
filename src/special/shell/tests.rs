use super::*;
use crate::model::{Layout, Shell};
use crate::number::Interval;
use proptest::prelude::*;
use rug::Rational;

fn photon(k: u64) -> Shell {
    Layout::Triangular
        .shell(&k.into())
        .expect("every k has a shell")
}

fn shell(l: u64, m: u64, inner: Rational, volume: Rational) -> Shell {
    Shell {
        inner,
        volume,
        position: l.into(),
        count: m.into(),
    }
}

/// The quantity by the general 2F1 and the thesis's formulas, with so many bits that enough are left.
fn reference(quantity: Quantity, shell: &Shell, bits: u32) -> Interval {
    let sketch = sketch::Sketch::new(shell).expect("a shell");
    let working = 2 * bits + 2 * sketch.loss(quantity) as u32 + 64;
    Method::Thesis
        .enclose(quantity, shell, working)
        .expect("Va > 0")
}

/// The digits that the value shows.
fn digits(value: &Interval) -> u32 {
    (0..400).take_while(|&n| value.agrees_to(n)).count() as u32
}

fn agree(
    method: Method,
    quantity: Quantity,
    shell: &Shell,
    bits: u32,
) -> Result<(), TestCaseError> {
    let truth = reference(quantity, shell, bits);
    match method.enclose(quantity, shell, bits) {
        Ok(value) => prop_assert!(
            value.overlaps(&truth),
            "{method:?} {quantity:?} {shell:?} {bits}: {} and {}",
            value.to_decimal(30),
            truth.to_decimal(30)
        ),
        Err(ShellError::Outside | ShellError::Lost) => {}
        Err(error) => panic!("{method:?} {quantity:?} {shell:?}: {error}"),
    }
    Ok(())
}

/// Photons of strategy 2, small and large, and the ends of their shells.
fn strategy_2() -> impl Strategy<Value = Shell> {
    prop_oneof![
        (2u64..200).prop_map(photon),
        (2u64..1_000_000).prop_map(photon),
        (1u64..1_000_000_000_000).prop_map(|k| photon(k + 1)),
        (2u64..1_000_000).prop_map(|m| photon(m * (m - 1) / 2 + 1)),
        (2u64..1_000_000).prop_map(|m| photon(m * (m + 1) / 2)),
    ]
}

/// Shells of any volumes.
fn any_shell() -> impl Strategy<Value = Shell> {
    (1u64..60, 0u64..60, 1u64..2000, 1u64..9, 1u64..400, 1u64..9).prop_map(
        |(l, more, a, b, v, e)| {
            let inner = Rational::from((a, b));
            shell(l, l + more, inner, Rational::from((v, e)))
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn every_method_agrees_with_the_general_function(
        shell in prop_oneof![strategy_2(), any_shell()], bits in 30u32..400,
    ) {
        for method in Method::ALL {
            // The quadrature is slow, the walks are long.
            let heavy = shell.count > 80;
            if heavy && matches!(method, Method::Euler | Method::Upwards | Method::Downwards | Method::Middle | Method::Exact) {
                continue;
            }
            for quantity in Quantity::ALL {
                agree(method, quantity, &shell, bits)?;
            }
        }
    }

    #[test]
    fn the_choice_has_its_digits(
        shell in prop_oneof![strategy_2(), any_shell()], wanted in 1u32..150,
    ) {
        for quantity in Quantity::ALL {
            let value = enclose(quantity, &shell, wanted).expect("it has a value");
            prop_assert!(value.agrees_to(wanted), "{quantity:?} {}", value.to_decimal(30));
            let truth = reference(quantity, &shell, 500);
            prop_assert!(value.overlaps(&truth), "{quantity:?} {} {}", value.to_decimal(30), truth.to_decimal(30));
        }
    }
}

#[test]
fn every_method_covers_its_ground() {
    // Photon 50 of strategy 2 is in every domain.
    for method in Method::ALL {
        for quantity in Quantity::ALL {
            let value = method.enclose(quantity, &photon(50), 200);
            let value = value.unwrap_or_else(|error| panic!("{method:?} {quantity:?} {error}"));
            assert!(value.overlaps(&reference(quantity, &photon(50), 200)));
            assert!(
                digits(&value) >= 50,
                "{method:?} {quantity:?} {}",
                digits(&value)
            );
        }
    }
}
