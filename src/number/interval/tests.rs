use super::*;
use proptest::prelude::*;
use rug::ops::Pow;

fn q(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
}

/// The interval between two rationals.
fn between(a: &Rational, b: &Rational, precision: u32) -> Interval {
    Interval::from_rational(a, precision).hull(&Interval::from_rational(b, precision))
}

fn point(n: i64, d: i64, precision: u32) -> Interval {
    Interval::from_rational(&q(n, d), precision)
}

fn rational() -> impl Strategy<Value = Rational> {
    prop_oneof![
        (-1000i64..1000, 1i64..1000).prop_map(|(n, d)| q(n, d)),
        (-20i64..20).prop_map(|n| q(n, 1)),
        (any::<i64>(), 1..i64::MAX).prop_map(|(n, d)| q(n, d)),
    ]
}

/// An interval and a rational inside it.
fn interval() -> impl Strategy<Value = (Interval, Rational)> {
    (rational(), rational(), 0u32..=8, 2u32..120).prop_map(|(a, b, eighths, precision)| {
        let inside = a.clone() + (b.clone() - &a) * eighths / 8;
        (between(&a, &b, precision), inside)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn exact_operations_lie_inside((x, a) in interval(), (y, b) in interval(), n in -6i64..7) {
        prop_assert!(x.contains_rational(&a));
        prop_assert!(x.add(&y).contains_rational(&Rational::from(&a + &b)));
        prop_assert!(x.sub(&y).contains_rational(&Rational::from(&a - &b)));
        prop_assert!(x.mul(&y).contains_rational(&Rational::from(&a * &b)));
        prop_assert!(x.neg().contains_rational(&Rational::from(-&a)));
        prop_assert!(x.abs().contains_rational(&a.clone().abs()));
        prop_assert!(x.square().contains_rational(&Rational::from(&a * &a)));
        prop_assert!(x.min(&y).contains_rational((&a).min(&b)));
        prop_assert!(x.max(&y).contains_rational((&a).max(&b)));
        prop_assert!(x.hull(&y).contains_rational(&b));
        match x.div(&y) {
            Ok(quotient) => prop_assert!(quotient.contains_rational(&Rational::from(&a / &b))),
            Err(error) => {
                prop_assert!(y.contains_zero());
                prop_assert!(error != DomainError::Certain || b == 0);
            }
        }
        match x.powi(n) {
            Ok(power) => prop_assert!(power.contains_rational(&a.clone().pow(n as i32))),
            Err(error) => prop_assert!(n < 0 && x.contains_zero()
                && (error != DomainError::Certain || a == 0)),
        }
        if let Ok(floor) = x.floor() {
            prop_assert!(floor.contains_rational(&a.clone().floor()));
        }
    }

    #[test]
    fn functions_hold_mpfr_values_and_grow((x, a) in interval(), (y, b) in interval()) {
        let (a, b) = (Float::with_val(200, a), Float::with_val(200, b));
        let small = x.low > -100 && x.high < 100;
        let holds = |f: Result<Interval, DomainError>, value: Float| match f {
            // The plain value is off by at most one in its last of 200 bits.
            Ok(range) => {
                let one = Interval::from_ends(value.clone(), value.clone());
                let slack = Interval::from_ends(Float::with_val(200, -1) >> 190, Float::with_val(200, 1) >> 190);
                value.is_infinite() || range.with_precision(200).overlaps(&one.add(&one.mul(&slack)))
            }
            Err(DomainError::Certain) => !value.is_finite(),
            Err(DomainError::Possible) => true,
        };
        prop_assert!(holds(x.sqrt(), a.clone().sqrt()));
        prop_assert!(holds(x.ln(), a.clone().ln()));
        prop_assert!(holds(Ok(x.sin()), a.clone().sin()));
        prop_assert!(holds(Ok(x.cos()), a.clone().cos()));
        if a > 0 {
            prop_assert!(holds(x.root(3), a.clone().root(3)));
            prop_assert!(holds(x.pow(&y), a.clone().pow(&b)));
            prop_assert!(holds(x.lngamma(), a.clone().ln_gamma()));
        }
        if small {
            prop_assert!(holds(Ok(x.exp()), a.clone().exp()));
            prop_assert!(holds(x.gamma(), a.clone().gamma()));
        }
    }

    #[test]
    fn narrow_lies_in_wide((x, a) in interval(), (y, _) in interval()) {
        let narrow = Interval::from_rational(&a, x.precision());
        let wide = narrow.hull(&x);
        let ordered = |f: Result<Interval, DomainError>, g: Result<Interval, DomainError>| {
            match (f, g) {
                (Ok(inner), Ok(outer)) => outer.contains(&inner),
                (Ok(_), Err(error)) => error == DomainError::Possible,
                (Err(_), Ok(_)) => false,
                (Err(a), Err(b)) => b == DomainError::Possible || a == b,
            }
        };
        prop_assert!(wide.mul(&y).contains(&narrow.mul(&y)));
        prop_assert!(wide.sin().contains(&narrow.sin()));
        prop_assert!(wide.cos().contains(&narrow.cos()));
        prop_assert!(ordered(narrow.div(&y), wide.div(&y)));
        prop_assert!(ordered(y.div(&narrow), y.div(&wide)));
        prop_assert!(ordered(narrow.ln(), wide.ln()));
        prop_assert!(ordered(narrow.pow(&y), wide.pow(&y)));
        prop_assert!(ordered(narrow.lngamma(), wide.lngamma()));
        if wide.low > -1000 && wide.high < 1000 {
            prop_assert!(ordered(narrow.gamma(), wide.gamma()));
        }
    }

    #[test]
    fn more_bits_overlap(a in rational(), precision in 4u32..80) {
        let (coarse, fine) = (
            Interval::from_rational(&a, precision),
            Interval::from_rational(&a, 2 * precision),
        );
        prop_assert!(coarse.contains(&fine));
        prop_assert!(coarse.sin().overlaps(&fine.sin()));
        if let (Ok(c), Ok(f)) = (coarse.lngamma(), fine.lngamma()) {
            prop_assert!(c.contains(&f));
        }
    }

    #[test]
    fn decimal_digits_are_the_values(a in rational(), digits in 1usize..25) {
        let text = Interval::from_rational(&a, 200).to_decimal(digits);
        let read = Interval::from_rational(&Rational::from(&a), 400);
        let printed = Float::with_val(400, Float::parse(&text).expect("a number"));
        let error = Interval::from_ends(printed.clone(), printed).sub(&read).abs();
        // Exactly halfway between two decimals the last digit cannot be told.
        let told = digits as i32 - i32::from(is_halfway(&a, digits));
        let unit = read.abs().high.clone() * Float::with_val(400, 10).pow(1 - told);
        prop_assert!(error.low <= unit, "{} {}", text, a);
    }
}

/// Whether the number lies in the middle of two neighbours of so many significant digits.
fn is_halfway(a: &Rational, digits: usize) -> bool {
    let size = Rational::from(a.abs_ref());
    if size == 0 {
        return false;
    }
    let mut step = Rational::from(1);
    while step <= size {
        step *= 10;
    }
    while step > size {
        step /= 10;
    }
    for _ in 1..digits {
        step /= 10;
    }
    let halves: Rational = size * 2u32 / step;
    *halves.denom() == 1 && halves.numer().is_odd()
}

#[test]
fn the_middle_of_two_decimals() {
    for (a, digits, halfway) in [
        ((-207, 160), 5, true),
        ((-207, 160), 4, false),
        ((-207, 160), 6, false),
        ((1, 3), 5, false),
        ((10, 1), 1, false),
        ((15, 1), 1, true),
        ((0, 1), 1, false),
    ] {
        assert_eq!(
            is_halfway(&Rational::from(a), digits),
            halfway,
            "{a:?} {digits}"
        );
    }
}

#[test]
fn unbounded_products_and_overflow() {
    let half_line = Interval::from_ends(
        Float::with_val(53, 1),
        Float::with_val(53, Special::Infinity),
    );
    let zero = Interval::from_i64(0, 53);
    assert!(zero.mul(&half_line).is_point());
    assert!(
        half_line
            .div(&half_line)
            .is_ok_and(|r| r.low == 0 && r.high.is_infinite())
    );
    let large = Interval::from_i64(1 << 60, 53).exp();
    assert!(large.low.is_finite() && large.high.is_infinite());
    let small = Interval::from_i64(-(1 << 60), 53).exp();
    assert!(small.low == 0 && small.high > 0);
    assert!(
        half_line
            .sub(&half_line)
            .contains(&Interval::whole_line(53))
    );
    assert!(
        half_line
            .gamma()
            .is_ok_and(|g| g.low >= 0 && g.high.is_infinite())
    );
}

#[test]
fn sine_sees_its_extrema() {
    let across = between(&q(1, 1), &q(2, 1), 60);
    assert!(across.sin().high == 1 && across.sin().low < 0.85);
    assert!(across.cos().high < 0.55);
    let around = between(&q(-1, 100), &q(1, 100), 60);
    assert!(around.cos().high == 1 && around.cos().low > 0.99);
    assert!(
        between(&q(0, 1), &q(7, 1), 60)
            .sin()
            .contains(&Interval::from_i64(1, 60).neg())
    );
    let huge = Interval::from_integer(&Integer::from(10).pow(100), 400).sin();
    assert!(huge.agrees_to(30) && huge.low > -0.38 && huge.high < -0.37);
}

#[test]
fn gamma_corners() {
    let factorial = Interval::from_i64(21, 100).gamma().expect("no pole");
    assert!(factorial.contains_rational(&Rational::from(Integer::from(Integer::factorial(20)))));
    assert_eq!(Interval::from_i64(0, 60).gamma(), Err(DomainError::Certain));
    assert_eq!(
        Interval::from_i64(-3, 60).gamma(),
        Err(DomainError::Certain)
    );
    assert_eq!(
        between(&q(-1, 2), &q(1, 2), 60).gamma(),
        Err(DomainError::Possible)
    );
    assert_eq!(
        between(&q(-1, 1), &q(-1, 2), 60).gamma(),
        Err(DomainError::Possible)
    );
    // Gamma(-1/2) = -2 sqrt(pi), Gamma(1/2) = sqrt(pi).
    let root = Interval::pi(100).sqrt().expect("positive");
    assert!(point(1, 2, 100).gamma().is_ok_and(|g| g.overlaps(&root)));
    let twice = root.mul(&Interval::from_i64(-2, 100));
    assert!(point(-1, 2, 100).gamma().is_ok_and(|g| g.overlaps(&twice)));
    // The minimum 0.8856... at 1.46163..., first from a wide, then from a narrow interval.
    let wide = between(&q(1, 1), &q(3, 1), 60).gamma().expect("no pole");
    assert!(wide.low > 0 && wide.low < 0.886 && wide.high == 2);
    let narrow = between(&q(146163, 100000), &q(146164, 100000), 60)
        .gamma()
        .expect("no pole");
    assert!(narrow.low > 0.88560319 && narrow.high < 0.8856032);
    // Far out on the negative axis it underflows, near zero it overflows: both still enclose.
    assert!(
        point(-20_000_001, 2, 60)
            .gamma()
            .is_ok_and(|g| g.high > g.low)
    );
}

#[test]
fn powers_at_corners() {
    let zero = Interval::from_i64(0, 60);
    let half = point(1, 2, 60);
    assert!(zero.pow(&half).is_ok_and(|p| p == zero));
    assert_eq!(zero.pow(&half.neg()), Err(DomainError::Certain));
    assert_eq!(
        Interval::from_i64(-2, 60).pow(&half),
        Err(DomainError::Certain)
    );
    assert!(
        zero.pow(&zero)
            .is_ok_and(|p| p == Interval::from_i64(1, 60))
    );
    let huge = Integer::from(1) << 100;
    assert!(
        Interval::from_i64(-1, 60)
            .pow_integer(&huge)
            .is_ok_and(|p| p.contains_rational(&q(1, 1)))
    );
    assert!(
        Interval::from_i64(2, 60)
            .pow_integer(&huge)
            .is_ok_and(|p| p.high.is_infinite())
    );
}

#[test]
fn decimals() {
    let text = |x: Interval, digits| x.to_decimal(digits);
    assert_eq!(text(point(1, 2, 60), 20), "0.5");
    assert_eq!(text(Interval::from_i64(1200, 60), 20), "1200");
    assert_eq!(text(point(1, 3, 40), 5), "0.33333");
    assert_eq!(text(point(-2, 3, 40), 5), "-0.66667");
    assert_eq!(
        text(Interval::pi(200), 30),
        "3.14159265358979323846264338328"
    );
    assert_eq!(
        text(
            Interval::from_i64(1, 60)
                .exp()
                .mul(&Interval::from_i64(1 << 60, 60)),
            3
        ),
        "3.13e18"
    );
    assert_eq!(
        text(Interval::from_i64(100_000_000, 60).exp(), 3),
        "1.55e43429448"
    );
    assert_eq!(text(Interval::from_i64(0, 60), 5), "0");
    assert_eq!(
        text(between(&q(-1, 3), &q(1, 3), 60), 5),
        "[-0.33334, 0.33334]"
    );
    assert_eq!(text(between(&q(1, 1), &q(9, 1), 60), 5), "[1.0000, 9.0000]");
    assert_eq!(text(Interval::whole_line(60), 5), "[-inf, inf]");
    assert_eq!(
        text(between(&q(12345, 10000), &q(12346, 10000), 60), 9),
        "1.23"
    );
    assert_eq!(text(point(1, 100_000_000, 60), 2), "1.0e-8");
    assert_eq!(
        text(between(&q(99999, 100000), &q(100001, 100000), 60), 9),
        "1.000"
    );
}

#[test]
fn ends_and_agreement() {
    assert!(
        Interval::from_ends(Float::with_val(9, Special::Nan), Float::new(9))
            == Interval::whole_line(9)
    );
    assert!(point(1, 3, 200).agrees_to(59) && !point(1, 3, 200).agrees_to(61));
    assert!(!between(&q(-1, 1), &q(1, 1), 60).agrees_to(0));
    assert!(Interval::from_i64(0, 60).agrees_to(1000));
    let (low, high) = point(1, 3, 50).ends_as_rationals().expect("bounded");
    assert!(low < q(1, 3) && q(1, 3) < high);
    assert!(Interval::whole_line(9).ends_as_rationals().is_none());
    assert!(
        Interval::from_i64(1 << 28, 9)
            .exp()
            .ends_as_rationals()
            .is_none()
    );
}
