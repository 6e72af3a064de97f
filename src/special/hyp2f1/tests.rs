use super::*;
use proptest::prelude::*;
use rug::Rational;

fn q(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
}

fn at(
    a: &Rational,
    b: &Rational,
    c: &Rational,
    z: &Rational,
    precision: u32,
) -> Result<Interval, DomainError> {
    let [a, b, c, z] = [a, b, c, z].map(|x| Interval::from_rational(x, precision + 64));
    hyp2f1(&a, &b, &c, &z, precision)
}

fn integer(a: i64, b: i64, c: i64, z: &Rational, precision: u32) -> Result<Interval, DomainError> {
    at(&q(a, 1), &q(b, 1), &q(c, 1), z, precision)
}

/// The decimal text with a unit of its last digit to both sides.
fn reference(text: &str) -> Option<Interval> {
    let value = rug::Float::parse(text).ok()?;
    let value = rug::Float::with_val(250, value);
    let point = Interval::from_ends(value.clone(), value);
    let unit = Interval::from_i64(10, 250).powi(-49).ok()?;
    let error = point.abs().mul(&unit);
    Some(point.add(&error.neg().hull(&error)))
}

#[test]
fn reference_values() {
    let mut rows = 0;
    for line in include_str!("../../../tests/data/hyp2f1.csv").lines() {
        let fields: Vec<&str> = line.split(',').collect();
        let parsed: Option<Vec<Rational>> = fields.iter().take(4).map(|f| f.parse().ok()).collect();
        let (Some(arguments), [.., text]) = (parsed, fields.as_slice()) else {
            assert!(line.starts_with('#') || line.starts_with('a'), "{line}");
            continue;
        };
        let [a, b, c, z] = arguments.as_slice() else {
            panic!("{line}");
        };
        let [a, b, c, z] = [a, b, c, z].map(|x| Interval::from_rational(x, 700));
        let found = hyp2f1(&a, &b, &c, &z, 160);
        if *text == "none" {
            assert_eq!(found, Err(DomainError::Certain), "{line}");
        } else {
            let found = found.unwrap_or_else(|e| panic!("{line}: {e}"));
            let expected = reference(text).expect("a number");
            assert!(
                found.overlaps(&expected),
                "{line}: {}",
                found.to_decimal(50)
            );
            assert!(
                found.agrees_to(35) || found.contains_zero(),
                "{line}: {}",
                found.to_decimal(50)
            );
        }
        rows += 1;
    }
    assert!(rows > 300);
}

fn close(left: &Interval, right: &Interval) -> bool {
    left.overlaps(right) && (left.agrees_to(20) || left.contains_zero())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    // DLMF 15.5.11: (c-a) F(a-1) + (2a-c+(b-a)z) F(a) + a(z-1) F(a+1) = 0.
    #[test]
    fn contiguous_in_a(a in 1i64..40, b in 1i64..40, c in 1i64..60, d in 1i64..4, n in -300i64..95) {
        let (a, z) = (q(a, d), q(n, 100));
        let (b, c) = (q(b, 1), q(c, 1));
        let f = |shift: i64| at(&(a.clone() + shift), &b, &c, &z, 200);
        let weights = [
            Rational::from(&c - &a),
            a.clone() * 2 - &c + Rational::from(&b - &a) * &z,
            a.clone() * (z.clone() - 1),
        ];
        let mut sum = Interval::from_i64(0, 200);
        for (shift, weight) in (-1..).zip(&weights) {
            let weight = Interval::from_rational(weight, 200);
            let Ok(value) = f(shift) else { return Err(TestCaseError::fail("no value")) };
            sum = sum.add(&weight.mul(&value));
        }
        prop_assert!(sum.contains_zero());
    }

    // DLMF 15.8.1, Euler's transformation.
    #[test]
    fn euler(a in 1i64..60, b in 1i64..60, c in 1i64..60, n in -300i64..99) {
        let z = q(n, 100);
        let (a, b, c) = (q(a, 4), q(b, 4), q(c, 3));
        let (a1, b1) = (Rational::from(&c - &a), Rational::from(&c - &b));
        let (Ok(left), Ok(right)) = (at(&a, &b, &c, &z, 200), at(&a1, &b1, &c, &z, 200)) else {
            return Err(TestCaseError::fail("no value"));
        };
        let excess = Interval::from_rational(&(a1 - b), 260);
        let rest = Interval::from_rational(&(q(1, 1) - &z), 260);
        let scale = rest.pow(&excess).expect("positive base");
        prop_assert!(close(&left, &right.mul(&scale)));
    }

    // The narrow argument's value lies in the wide one's, two precisions overlap.
    #[test]
    fn wide_arguments_and_more_bits(b in 1i64..50, m in 1i64..90, n in 1i64..2000) {
        let (z, other) = (q(-n, 97), q(-n, 96));
        let c = b + m;
        let wide = Interval::from_rational(&z, 80).hull(&Interval::from_rational(&other, 80));
        let whole = |x: i64| Interval::from_i64(x, 80);
        let (Ok(coarse), Ok(fine)) = (integer(1, b, c, &z, 60), integer(1, b, c, &z, 120)) else {
            return Err(TestCaseError::fail("no value"));
        };
        prop_assert!(close(&fine, &coarse));
        if let Ok(range) = hyp2f1(&whole(1), &whole(b), &whole(c), &wide, 60) {
            prop_assert!(range.overlaps(&fine));
        }
    }

    // F(1, 1; 2; z) = -ln(1-z)/z (DLMF 15.4.1), F(a, b; b; z) = (1-z)^(-a) (DLMF 15.4.6).
    #[test]
    fn closed_forms(n in -1_000_000i64..999_999, power in 1i64..30, b in 1i64..30) {
        prop_assume!(n != 0);
        let z = q(n, 1_000_000);
        let (point, rest) = (Interval::from_rational(&z, 260), Interval::from_rational(&(q(1, 1) - &z), 260));
        let logarithm = rest.ln().and_then(|l| l.neg().div(&point)).expect("z is not 0");
        prop_assert!(integer(1, 1, 2, &z, 200).is_ok_and(|f| close(&f, &logarithm)));
        let value = rest.powi(-power).expect("not 0");
        prop_assert!(integer(power, b, b, &z, 200).is_ok_and(|f| close(&f, &value)));
    }
}

#[test]
fn beyond_the_unit_interval() {
    assert_eq!(integer(1, 1, 2, &q(1, 1), 60), Err(DomainError::Certain));
    assert_eq!(integer(1, 1, 2, &q(7, 1), 60), Err(DomainError::Certain));
    assert_eq!(integer(1, 1, 0, &q(1, 2), 60), Err(DomainError::Certain));
    assert!(integer(1, 1, 3, &q(1, 1), 60).is_ok_and(|f| f.contains_rational(&q(2, 1))));
    // 1 - 2*3*4/2 + 3*4/(2*3)*16 with (-2)_2 = 2.
    assert!(integer(-2, 3, 2, &q(4, 1), 60).is_ok_and(|f| f.contains_rational(&q(21, 1))));
    let around_one = Interval::from_rational(&q(1, 3), 60).mul(&Interval::from_i64(3, 60));
    let [one, two] = [1, 2].map(|n| Interval::from_i64(n, 60));
    // b may be -1, which would end the series before c = -3 is reached.
    let [five, three] = [-5, -3].map(|n| Interval::from_i64(n, 60));
    assert_eq!(
        hyp2f1(&five, &around_one.neg(), &three, &one, 60),
        Err(DomainError::Possible)
    );
    assert_eq!(
        hyp2f1(&one, &one, &two, &around_one, 60),
        Err(DomainError::Possible)
    );
    assert_eq!(
        hyp2f1(
            &around_one.sub(&one),
            &one,
            &two,
            &Interval::from_i64(3, 60),
            60
        ),
        Err(DomainError::Possible)
    );
}

#[test]
fn regularized() {
    // DLMF 15.2.3_5 at c = 0: (a)(b) z F(a+1, b+1; 2; z); a = 1, b = 0 makes it 0.
    let point = |n: i64, d: i64| Interval::from_rational(&q(n, d), 200);
    let value = hyp2f1_regularized(&point(1, 1), &point(1, 1), &point(0, 1), &point(-1, 2), 150);
    // z F(2, 2; 2; z) = z (1-z)^(-2) = -1/2 * 4/9.
    assert!(value.is_ok_and(|v| v.contains_rational(&q(-2, 9)) && v.agrees_to(40)));
    let zero = hyp2f1_regularized(&point(1, 1), &point(0, 1), &point(0, 1), &point(-1, 2), 150);
    assert!(zero.is_ok_and(|v| v.contains_zero() && v.is_point()));
    let plain = integer(1, 2, 4, &q(-1, 2), 150)
        .expect("a value")
        .div_integer(&Integer::from(6));
    let value = hyp2f1_regularized(&point(1, 1), &point(2, 1), &point(4, 1), &point(-1, 2), 150);
    assert!(value.is_ok_and(|v| plain.is_ok_and(|p| close(&v, &p))));
}

#[test]
fn large_parameters_and_many_digits() {
    // (m-l) F_l + (1-z) l F_{l+1} = m for F_l = F(1, l; m+1; z), from DLMF 15.5.15.
    for (l, m, z, bits) in [
        (49, 100, q(-100, 4950), 3400),
        (100_000, 200_000, q(-2, 199_999), 400),
        (
            500_000_000_000,
            1_000_000_000_000,
            q(-2, 1_000_000_000_000),
            400,
        ),
        (3, 1_000_000_000_000, q(-5, 1), 400),
    ] {
        let (f, g) = (
            integer(1, l, m + 1, &z, bits),
            integer(1, l + 1, m + 1, &z, bits),
        );
        let (Ok(f), Ok(g)) = (f, g) else {
            panic!("no value for l = {l}")
        };
        assert!(f.agrees_to(bits * 29 / 100), "{l} {m}");
        let rest = Interval::from_rational(&(q(1, 1) - &z), bits);
        let left = f
            .mul_integer(&Integer::from(m - l))
            .add(&g.mul_integer(&Integer::from(l)).mul(&rest));
        assert!(left.contains_rational(&q(m, 1)), "{l} {m}");
    }
}

#[test]
fn too_much_work_is_possible_never_wrong() {
    // z next to 1 with c - a - b a wide integer: no method is quick, none guesses.
    let tiny = q(1, 1_000_000_000_000);
    let value = at(&q(1, 3), &q(2, 3), &q(2, 1), &(q(1, 1) - tiny), 100);
    assert_eq!(value, Err(DomainError::Possible));
}
