//! The kernel against values that are known from elsewhere, through its public functions.

mod random;
mod values;
mod witnesses;

use super::interval::Interval;
use super::quantity::as_value;
use super::{Unknown, Value, value};
use crate::formula::{Draw, Point, Rational, parse_formula, parse_law};
use num_bigint::BigInt;
use num_traits::One;

fn draw(name: &str, law: &str) -> Draw {
    Draw {
        name: name.into(),
        law: parse_law(law).expect(law),
    }
}

fn at(
    text: &str,
    numbers: &[(&str, i64, i64)],
    draws: &[Draw],
    bits: u32,
) -> Result<Value, Unknown> {
    let mut point = Point::default();
    for (name, a, b) in numbers {
        let number = Rational::new((*a).into(), (*b).into());
        point.numbers.insert((*name).into(), number);
    }
    value(&parse_formula(text).expect(text), &point, draws, bits)
}

fn closed(text: &str) -> Result<Value, Unknown> {
    at(text, &[], &[], 64)
}

fn exact(a: i64, b: i64) -> Result<Value, Unknown> {
    as_value(Ok(Interval::exact(Rational::new(a.into(), b.into())).into()))
}

fn enclosure(value: &Value) -> Interval {
    match value {
        Value::Finite { low, high } => Interval::between(low.clone(), high.clone()),
        other => panic!("{other:?}"),
    }
}

/// The difference of two formulas is enclosed around zero, and tightly.
fn assert_agree(a: &str, b: &str, numbers: &[(&str, i64, i64)], draws: &[Draw]) {
    let difference = format!("({a}) - ({b})");
    let found =
        at(&difference, numbers, draws, 128).unwrap_or_else(|why| panic!("{difference}: {why}"));
    let found = enclosure(&found);
    assert!(found.sign().is_err() || found.is_zero(), "{difference}");
    assert!(found.high() - found.low() < tiny(90), "{difference}");
}

/// 2^-bits
fn tiny(bits: u32) -> Rational {
    Rational::new(1.into(), BigInt::one() << bits)
}
