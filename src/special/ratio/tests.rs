use super::*;
use proptest::prelude::*;
use rug::Float;

fn rational(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
}

/// Every method that has x and y in its domain gives overlapping enclosures of about `precision` bits.
fn all_agree(x: &Rational, y: &Rational, precision: u32) {
    let digits = precision * 3 / 10 - 4;
    let reference = gamma_ratio(x, y, 2 * precision + 64).expect("no pole");
    for way in choose(x, y, precision) {
        let value = way.ratio(x, y, precision).expect("in its domain");
        assert!(value.overlaps(&reference), "{way:?} of {x}, {y}: {value:?}");
        assert!(value.agrees_to(digits), "{way:?} of {x}, {y}: {value:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn all_ways_agree(
        n in 1i64..40_000, d in 1i64..9, apart in -300i64..300, e in 1i64..9, bits in 20u32..300,
    ) {
        let (x, y) = (rational(n, d), rational(n, d) + rational(apart, e));
        if !is_pole(&y) {
            all_agree(&x, &y, bits);
        }
        all_agree(&x, &rational(n + d * (apart + 300), d), bits);
    }

    #[test]
    fn exact_shifts_are_what_the_others_enclose(n in -3000i64..3000, d in 1i64..7, steps in -200i64..200) {
        let x = rational(n, d);
        let y = x.clone() + steps;
        if let Some(value) = gamma_ratio_exact(&x, &y) {
            for way in choose(&x, &y, 100) {
                let found = way.ratio(&x, &y, 100);
                prop_assert!(found.is_ok_and(|found| found.contains_rational(&value)), "{way:?}");
            }
        }
    }
}

#[test]
fn poles() {
    let ratio = |x: i64, y: i64| gamma_ratio(&rational(x, 2), &rational(y, 2), 60);
    assert_eq!(ratio(-4, 3), Err(DomainError::Certain));
    assert_eq!(ratio(-4, -2), Err(DomainError::Possible));
    assert_eq!(ratio(3, -2), Ok(Interval::from_i64(0, 60)));
    // By reflection: Gamma(-1/2) = -2 sqrt(pi), Gamma(1/3) > 0.
    let negative = gamma_ratio(&rational(-1, 2), &rational(1, 3), 100);
    assert!(negative.is_ok_and(|value| value.agrees_to(28) && *value.high() < 0));
}

#[test]
fn half_integers() {
    // Gamma(n + 1/2)/Gamma(n) tends to sqrt(n), from below: n - 1/4 < square < n.
    for n in [10i64, 1000, 1_000_000_000_000] {
        let value = gamma_ratio(&rational(2 * n + 1, 2), &rational(n, 1), 200).expect("no pole");
        assert!(value.agrees_to(59));
        let square = value.square();
        let [low, high] = [rational(4 * n - 1, 4), rational(n, 1)];
        assert!(*square.low() > low && *square.high() < high);
    }
}

#[test]
fn the_expansion_reaches_high_precision_by_raising() {
    let (x, y) = (rational(1, 3), rational(7, 5));
    for precision in [53, 333, 1000] {
        let value = Way::Asymptotic.ratio(&x, &y, precision).expect("positive");
        let other = Way::Quotient.ratio(&x, &y, precision).expect("moderate");
        assert!(value.overlaps(&other) && value.agrees_to(precision * 3 / 10 - 3));
    }
}

#[test]
fn the_choice_takes_what_suffices() {
    let best = |x: Rational, y: Rational, bits| choose(&x, &y, bits)[0];
    let large = 1_000_000_000_000i64;
    assert_eq!(
        best(rational(large - 2, 1), rational(large, 1), 53),
        Way::Shift
    );
    assert_eq!(
        best(rational(5 * large, 1), rational(5 * large + 1, 2), 53),
        Way::Logarithm
    );
    assert_eq!(
        best(rational(2 * large + 1, 2), rational(large, 1), 53),
        Way::Asymptotic
    );
}

/// Right digits of an f64 against the exact value.
fn digits(value: f64, exact: &Rational) -> f64 {
    let difference = Rational::from_f64(value).expect("finite") - exact;
    -(difference / exact).to_f64().abs().max(1e-17).log10()
}

/// (k-1)! by products of f64.
fn gamma_f64(k: u32) -> f64 {
    (1..k).map(f64::from).product()
}

#[test]
fn the_quotient_of_doubles_overflows_at_172() {
    // 1/((k-1)(k-2)) = Gamma(k-2)/Gamma(k).
    let exact = |k: u32| Rational::from((1, (k - 1) * (k - 2)));
    assert!(digits(gamma_f64(169) / gamma_f64(171), &exact(171)) > 14.0);
    assert!(gamma_f64(171).is_finite() && gamma_f64(172).is_infinite());
    assert_eq!(gamma_f64(170) / gamma_f64(172), 0.0);
    assert!((gamma_f64(172) / gamma_f64(174)).is_nan());
    for k in [171u32, 172, 174, 10_000] {
        let value = gamma_ratio(&Rational::from(k - 2), &Rational::from(k), 53);
        assert!(value.is_ok_and(|value| value.contains_rational(&exact(k)) && value.agrees_to(14)));
    }
}

#[test]
fn differences_of_logarithms_of_doubles_lose_their_digits() {
    // ln Gamma correctly rounded to 53 bits, so that nothing but the difference is to blame.
    let logarithm = |k: u64| Float::with_val(53, Float::with_val(53, k).ln_gamma()).to_f64();
    for (k, least, most) in [
        (100u64, 12.0, 15.0),
        (10_000, 10.0, 13.0),
        (1_000_000, 7.0, 11.0),
        (1_000_000_000_000, 0.0, 4.5),
    ] {
        let exact = Rational::from((1, Integer::from(k - 1) * (k - 2)));
        let right = digits((logarithm(k - 2) - logarithm(k)).exp(), &exact);
        assert!((least..most).contains(&right), "{right} digits at {k}");
        for way in choose(&Rational::from(k - 2), &Rational::from(k), 53) {
            let value = way.ratio(&Rational::from(k - 2), &Rational::from(k), 53);
            assert!(
                value.is_ok_and(|v| v.contains_rational(&exact) && v.agrees_to(14)),
                "{way:?}"
            );
        }
    }
}

#[test]
fn a_denominator_of_many_bits_costs_the_quotient_its_place() {
    let near = Rational::from((1, 3)) + (Rational::from(1) >> 200_000u32);
    let ways = choose(&near, &Rational::from((1, 2)), 100);
    assert_ne!(ways.first(), Some(&Way::Quotient));
}
