use super::*;
use proptest::prelude::*;
use rug::Rational;

fn parts(values: &Values) -> [&Interval; 3] {
    [&values.mean, &values.excess, &values.variance]
}

/// All ways agree with the logarithm of many more bits, and have the bits asked for.
fn all_agree(k: &Integer, bits: u32) {
    let reference = Form::Logarithm.values(k, 2 * bits + 100).expect("k >= 2");
    for form in choose(k, bits) {
        let values = form.values(k, bits).expect("in its domain");
        for (found, truth) in parts(&values).into_iter().zip(parts(&reference)) {
            assert!(
                found.contains(truth),
                "{form:?} of {k}, {bits} bits: {found:?}"
            );
            let digits = (f64::from(bits) * std::f64::consts::LOG10_2 - 1.3).max(0.0) as u32;
            assert!(
                found.agrees_to(digits),
                "{form:?} of {k}, {bits} bits: {found:?}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn all_ways_agree(k in 2u64..5_000_000_000, cut in 0u32..32, bits in 8u32..900) {
        all_agree(&Integer::from((k >> cut).max(2)), bits);
    }
}

#[test]
fn small_and_huge_photons() {
    for bits in [10, 53, 64, 170, 497] {
        for k in 2u32..60 {
            all_agree(&k.into(), bits);
        }
        all_agree(&((1u64 << 31) - 2).into(), bits);
        all_agree(&(Integer::from(1) << 200), bits);
    }
    for form in Form::ALL {
        assert_eq!(form.values(&1.into(), 53), None);
        assert_eq!(form.values(&Integer::from(-5), 53), None);
    }
}

#[test]
fn the_coefficients_are_those_of_the_square() {
    // T of the series against its first two terms, 1/3 and 22/45, exactly: the rest is below p_3.
    for k in [5u32, 100, 100_000] {
        let odd = Rational::from((1, 2 * k - 1));
        let square = odd.clone() * &odd;
        let factor = Rational::from(&odd + 1u32) * odd;
        let factor = Rational::from(factor.square_ref());
        let low = (Rational::from((1, 3)) + Rational::from((22, 45)) * &square) * &factor;
        let rest = Rational::from(square.square_ref()) * Rational::from((10, 9)) * &factor;
        let found = Form::Series
            .values(&k.into(), 200)
            .expect("in its domain")
            .variance;
        assert!(
            *found.low() >= low && *found.high() <= low + rest,
            "k = {k}"
        );
    }
}

#[test]
fn the_choice_takes_what_suffices() {
    let best = |k: u64, bits| choose(&k.into(), bits)[0];
    assert_eq!(best(1000, 53), Form::Series);
    assert_eq!(best(1 << 40, 53), Form::Log1p);
    assert_eq!(best(2, 3000), Form::Log1p);
}

/// Right digits of an f64.
fn digits(value: f64, truth: &Interval) -> f64 {
    let truth = truth.midpoint();
    let error = (truth.clone() - value) / truth;
    -error.to_f64().abs().max(1e-17).log10()
}

#[test]
fn doubles_lose_what_the_table_says() {
    // S by log and log1p, T by log and log1p: right digits at most (or at least, where none is lost).
    for (k, s_log, t_log, t_log1p) in [
        (10_000u32, 13.5, 5.0, 9.0),
        (100_000, 12.5, 2.0, 7.0),
        (1_000_000, 11.5, 0.5, 5.0),
        (100_000_000, 9.5, 0.5, 1.5),
    ] {
        let truth = values(&k.into(), 30).expect("k >= 2");
        let x = f64::from(k);
        let by_log = x * (x / (x - 1.0)).ln();
        let by_log1p = -x * (-1.0 / x).ln_1p();
        assert!(digits(by_log, &truth.mean) < s_log, "k = {k}");
        assert!(digits(by_log1p, &truth.mean) > 15.0, "k = {k}");
        let variance = |mean: f64| x / (x - 1.0) - mean * mean;
        assert!(digits(variance(by_log), &truth.variance) < t_log, "k = {k}");
        assert!(
            digits(variance(by_log1p), &truth.variance) < t_log1p,
            "k = {k}"
        );
        assert!(truth.variance.agrees_to(30) && truth.excess.agrees_to(30));
    }
}
