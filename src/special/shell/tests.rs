use super::*;
use crate::model::{Layout, Shell, mean_reciprocal};
use crate::number::Interval;
use proptest::prelude::*;
use rug::{Integer, Rational};

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

/// F in doubles' 53 bits from the exact a + b ln(1 + V/Va), without the bits that cancel.
fn closed_form_in_doubles(shell: &Shell) -> Interval {
    let exact = mean_reciprocal(shell).expect("small").expect("finite");
    let number = |q: &Rational| Interval::from_rational(q, 53);
    let ratio = Rational::from(&shell.volume / &shell.inner) + 1u32;
    let logarithm = number(&ratio).ln().expect("positive");
    number(&exact.rational).add(&number(&exact.logarithm).mul(&logarithm))
}

#[test]
fn the_closed_form_has_no_digits_in_doubles_from_15_photons_on() {
    for m in 5u64..=60 {
        let shell = photon(m * (m - 1) / 2 + m / 2);
        let lost = digits(&closed_form_in_doubles(&shell));
        assert!(m < 15 || lost == 0, "m = {m}: {lost}");
        assert!(m > 7 || lost > 8, "m = {m}: {lost}");
        for method in [Method::Exact, Method::Words] {
            let value = method
                .enclose(Quantity::Mean, &shell, 60)
                .expect("in both domains");
            assert!(value.agrees_to(16), "{method:?} {m}");
        }
    }
}

#[test]
fn the_thesis_formula_loses_twice_the_digits_of_k() {
    for (k, left) in [
        (100u64, 11),
        (10_000, 7),
        (1_000_000, 4),
        (100_000_000, 0),
        (1_000_000_000_000, 0),
    ] {
        let shell = photon(k);
        let value = Method::Thesis.enclose(Quantity::Variance, &shell, 53);
        let found = digits(&value.expect("Va > 0"));
        assert!(found <= left, "k = {k}: {found}");
        assert!(
            enclose(Quantity::Variance, &shell, 15)
                .expect("it has one")
                .agrees_to(15)
        );
        // With the bits that it loses it is as good as any.
        let bits = Method::Thesis.bits_for(Quantity::Variance, &shell, 15);
        let value = Method::Thesis.enclose(Quantity::Variance, &shell, bits + 8);
        assert!(value.expect("Va > 0").agrees_to(15), "k = {k}");
    }
}

#[test]
fn the_relation_from_the_wrong_end_loses_about_m_bits() {
    // At the middle of shell m, from either end; the far end gets its digits back.
    let m = 150u64;
    let bits = 300;
    let at = |method: Method, l: u64| {
        let shell = photon(m * (m - 1) / 2 + l);
        let value = method.enclose(Quantity::Function, &shell, bits);
        digits(&value.expect("Va > 0"))
    };
    for method in [Method::Upwards, Method::Downwards] {
        let lost = f64::from(at(Method::Middle, m / 2) - at(method, m / 2)) * 3.32;
        assert!(
            (m as f64 - 20.0..m as f64 + 20.0).contains(&lost),
            "{method:?}: {lost}"
        );
    }
    assert!(at(Method::Upwards, m) >= 90);
    assert!(at(Method::Downwards, 1) >= 90);
    for l in [1, 20, 60, 74, 90, 130, m] {
        assert!(at(Method::Middle, l) >= 90, "l = {l}");
    }
}

#[test]
fn the_direct_series_refuses_the_first_shells() {
    for k in 2..=6 {
        let refused = Method::Direct.enclose(Quantity::Mean, &photon(k), 53);
        assert_eq!(refused, Err(ShellError::Outside), "k = {k}");
        for quantity in Quantity::ALL {
            let value = enclose(quantity, &photon(k), 100).expect("it has one");
            assert!(value.agrees_to(100));
        }
    }
    let value = Method::Direct.enclose(Quantity::Mean, &photon(7), 53);
    assert!(value.expect("m = 4").agrees_to(15));
}

#[test]
fn the_moments_lose_nothing_where_formula_2_104_loses_all() {
    for k in [55u64, 10_000, 100_000_000, 1_000_000_000_000] {
        for quantity in [Quantity::Excess, Quantity::Variance] {
            let value = Method::Moments.enclose(quantity, &photon(k), 53);
            assert!(value.expect("H < 1").agrees_to(15), "{quantity:?} k = {k}");
        }
    }
}

#[test]
fn at_the_centre_the_moments_are_those_of_the_beta_law() {
    // Of n photons in one ball: E = k/(k-1), Var = k^2 (n-k+1)/((k-2) (k-1)^2 n).
    let at =
        |quantity, k: u64, n: u64| enclose(quantity, &shell(k, n, Rational::new(), n.into()), 30);
    let none = Err(ShellError::Domain(crate::number::DomainError::Certain));
    assert_eq!(at(Quantity::Mean, 1, 10), none);
    assert_eq!(at(Quantity::Variance, 2, 10), none);
    assert_eq!(at(Quantity::Function, 5, 10), none);
    for (k, n) in [(3u64, 3u64), (5, 10), (70, 1000), (123_456, 10_000_000)] {
        let holds = |quantity, value: Rational| {
            let found = at(quantity, k, n).expect("finite");
            assert!(found.contains_rational(&value) && found.agrees_to(30));
        };
        holds(Quantity::Mean, Rational::from((k, k - 1)));
        holds(Quantity::Excess, Rational::from((1, k - 1)));
        let above = Rational::from(k) * k * (n - k + 1);
        holds(
            Quantity::Variance,
            above / (Rational::from(k - 2) * (k - 1) * (k - 1) * n),
        );
    }
}

#[test]
fn one_photon_a_shell_has_a_logarithm() {
    // Strategy 1: E = k ln(k/(k-1)), Var = k/(k-1) - E^2.
    for k in [2u64, 3, 10, 1000, 1_000_000_000] {
        let shell = Layout::One.shell(&k.into()).expect("every k has a shell");
        let ratio = Interval::from_rational(&Rational::from((k, k - 1)), 600);
        let mean = ratio.ln().expect("positive").mul_integer(&k.into());
        let variance = ratio.sub(&mean.square());
        assert!(
            enclose(Quantity::Mean, &shell, 60)
                .expect("finite")
                .overlaps(&mean)
        );
        let found = enclose(Quantity::Variance, &shell, 60).expect("finite");
        assert!(found.overlaps(&variance) && found.agrees_to(60), "k = {k}");
    }
}

#[test]
fn no_shell_is_refused() {
    let one = || Rational::from(1);
    let wrong = [
        shell(0, 5, one(), one()),
        shell(6, 5, one(), one()),
        shell(1, 5, -one(), one()),
        shell(1, 5, one(), Rational::new()),
    ];
    for shell in wrong {
        for quantity in Quantity::ALL {
            assert_eq!(enclose(quantity, &shell, 15), Err(ShellError::NoShell));
            for method in Method::ALL {
                let found = method.enclose(quantity, &shell, 100);
                assert_eq!(found, Err(ShellError::NoShell), "{method:?} {shell:?}");
            }
        }
    }
}

#[test]
fn hard_shells_are_answered_or_refused_in_time() {
    // Far more volume in the shell than inside it, numbers beyond words, many photons.
    let huge = Integer::from(Integer::u_pow_u(10, 30));
    let shells = [
        shell(3, 2000, Rational::from((1, 1000)), 2000.into()),
        shell(1, 5, Rational::from((1, &huge)), 5.into()),
        shell(7, 12, Rational::from(&huge), 12.into()),
        Layout::Triangular
            .shell(&huge)
            .expect("every k has a shell"),
    ];
    for shell in shells {
        for quantity in Quantity::ALL {
            let value = enclose(quantity, &shell, 40).expect("a method has it");
            assert!(value.agrees_to(40));
            assert!(
                value.overlaps(&reference(quantity, &shell, 500)),
                "{quantity:?} {shell:?}"
            );
        }
    }
}

#[test]
fn several_quantities_are_those_of_each() {
    let quantities = Quantity::ALL;
    let thick = shell(13, 52, Rational::from((1, 5)), Rational::from(9781));
    for (shell, digits) in [
        (photon(4), 15),
        (photon(5050), 50),
        (photon(5050), 3000),
        (photon(1_000_000_000_000), 400),
        (thick, 30),
    ] {
        let together = enclose_all(quantities, &shell, digits).expect("they have values");
        for (quantity, value) in quantities.into_iter().zip(together) {
            let alone = enclose(quantity, &shell, digits).expect("it has a value");
            assert!(
                value.agrees_to(digits) && value.overlaps(&alone),
                "{quantity:?} {shell:?}"
            );
        }
    }
    for method in Method::ALL {
        let shell = photon(50);
        let bits = method.bits_for(Quantity::Variance, &shell, 30);
        let together = method.enclose_all(quantities, &shell, bits);
        for (quantity, value) in quantities
            .into_iter()
            .zip(together.expect("in all domains"))
        {
            let alone = method.enclose(quantity, &shell, bits);
            let overlap = alone.is_ok_and(|alone| value.overlaps(&alone));
            assert!(overlap, "{method:?} {quantity:?}");
        }
    }
    // One without a value leaves none to the others.
    let centre = shell(2, 9, Rational::new(), 9.into());
    let both = enclose_all([Quantity::Mean, Quantity::Variance], &centre, 15);
    assert!(both.is_err() && enclose(Quantity::Mean, &centre, 15).is_ok());
}

#[test]
fn the_last_photon_of_a_large_shell() {
    // Here m = l: an early form of the splitting had enclosures apart from the truth.
    let m = 357_231u64;
    let shell = photon(m * (m + 1) / 2);
    for bits in [53, 200, 267, 400] {
        let truth = reference(Quantity::Excess, &shell, bits);
        for method in [
            Method::Splitting,
            Method::Words,
            Method::Moments,
            Method::Pfaff,
        ] {
            let value = method
                .enclose(Quantity::Excess, &shell, bits)
                .expect("it converges");
            assert!(value.overlaps(&truth), "{method:?} {bits}");
        }
    }
}

#[test]
fn shells_of_extreme_numbers_are_answered_or_refused() {
    let power = |exponent: u32| Rational::from(Integer::from(1) << exponent);
    let last: Integer = Integer::from(1) << 53u32;
    let full = Layout::Unstratified(last.clone()).shell(&last);
    let mean = enclose(Quantity::Mean, &full.expect("the last one"), 15);
    assert!(mean.is_ok_and(|mean| mean.agrees_to(15)));
    let thick = shell(2, 2, power(1100).recip(), Rational::from(1));
    let value = enclose(Quantity::Variance, &thick, 15).expect("it is finite");
    assert!(value.agrees_to(15));
    let thin = shell(1, 1, power(1100), Rational::from(1));
    let value = enclose(Quantity::Function, &thin, 400).expect("it is finite");
    assert!(value.agrees_to(400) && *value.low() < 1);
    let found = Method::Euler.enclose(Quantity::Function, &thin, 53);
    assert!(found.is_ok_and(|found| found.overlaps(&value)));
    let many = shell(1 << 31, (1 << 32) - 1, power(600), Rational::from(1));
    let found = Method::Euler.enclose(Quantity::Function, &many, 53);
    assert_eq!(found, Err(ShellError::Outside));
    // More digits than any method has within its cap.
    let wide = shell(1, 5000, Rational::from(1), Rational::from(9));
    let refused = Err(ShellError::Outside);
    assert_eq!(enclose(Quantity::Function, &wide, 60_000), refused);
    let middle = shell(2500, 5000, Rational::from(1), Rational::from(1));
    assert_eq!(enclose(Quantity::Function, &middle, 1_000_000), refused);
}

#[test]
fn every_method_answers_or_refuses_at_the_centre() {
    let centre = shell(5, 10, Rational::new(), Rational::from(10));
    for quantity in Quantity::ALL {
        for method in Method::ALL {
            let found = method.enclose(quantity, &centre, 53);
            let answers = method == Method::Exact && quantity != Quantity::Function;
            assert_eq!(found.is_ok(), answers, "{method:?} {quantity:?}");
        }
    }
    let (_, bits) = choose(Quantity::Variance, &centre, 15).expect("a method");
    assert!(bits < 100, "{bits}");
}

#[test]
fn more_bits_than_there_are_is_refused() {
    for method in Method::ALL {
        let found = method.enclose(Quantity::Mean, &photon(50), u32::MAX);
        assert_eq!(found, Err(ShellError::Outside), "{method:?}");
        assert_eq!(method.estimate(&photon(50), u32::MAX), f64::INFINITY);
    }
    assert_eq!(enclose_all([], &photon(5050), 17), Ok([]));
}

#[test]
fn thousands_of_digits_agree() {
    for k in [4u64, 55, 10_000, 1_000_000_000_000] {
        for quantity in [Quantity::Mean, Quantity::Variance] {
            let value = enclose(quantity, &photon(k), 5000).expect("it has one");
            assert!(value.agrees_to(5000));
            let other = Method::Splitting.enclose(quantity, &photon(k), 20_000);
            assert!(value.overlaps(&other.expect("Va > 0")));
        }
    }
}

#[test]
fn shells_much_larger_than_what_they_surround_are_answered_in_time() {
    for (l, m, inner, volume) in [
        (1u64, 1u64, (1, 7), (1555, 7)),
        (13, 52, (1, 5), (9781, 1)),
        (109, 152, (6, 5), (26, 5)),
    ] {
        let shell = shell(l, m, Rational::from(inner), Rational::from(volume));
        for quantity in Quantity::ALL {
            for wanted in [15, 50, 300] {
                let value = enclose(quantity, &shell, wanted).expect("it has one");
                assert!(value.agrees_to(wanted), "{quantity:?} {shell:?}");
                assert!(
                    value.overlaps(&reference(quantity, &shell, 1500)),
                    "{quantity:?} {shell:?}"
                );
            }
        }
    }
}

#[test]
fn the_choice_follows_shell_and_digits() {
    let first = |k: u64, digits: u32| {
        let (method, bits) = choose(Quantity::Variance, &photon(k), digits).expect("a method");
        // The digits and what the quantity loses, no more.
        let lost = 5.0 * (k as f64).log2() + 16.0;
        assert!(
            f64::from(bits) < f64::from(digits) * 3.3220 + lost,
            "k = {k}"
        );
        method
    };
    for k in [4u64, 100, 10_000, 1_000_000_000_000] {
        for digits in [1, 15, 50, 120, 1000] {
            assert_eq!(first(k, digits), Method::Words, "k = {k}, {digits} digits");
        }
    }
    assert_eq!(first(4, 10_000), Method::Exact);
    assert_eq!(first(1_000_000_000_000, 10_000), Method::Splitting);
    let centre = shell(5, 9, Rational::new(), 9.into());
    let (method, _) = choose(Quantity::Mean, &centre, 15).expect("a method");
    assert_eq!(method, Method::Exact);
}
