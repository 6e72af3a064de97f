use super::*;
use proptest::prelude::*;
use rug::Rational;
use std::time::{Duration, Instant};

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
        let start = Instant::now();
        let found = at(a, b, c, z, 160);
        let time = start.elapsed();
        if time > Duration::from_millis(50) {
            println!("{line} {time:?}");
        }
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
