//! Values of one parameter: all of a size, or random ones between bounds.

use crate::formula::{Rational, Relation};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, ToPrimitive};
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;

/// How far random values reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Integers to a dozen, fractions of such.
    Near,
    /// Integers to ten thousand, spread evenly over their logarithm.
    Far,
}

/// The bounds that the conditions put on one parameter, the others being known.
#[derive(Default)]
pub struct Bounds {
    pub low: Option<Rational>,
    pub high: Option<Rational>,
}

impl Bounds {
    /// Takes `parameter RELATION value` into account.
    pub fn tighten(&mut self, relation: Relation, value: Rational) {
        match relation {
            Relation::Less | Relation::LessEqual => {
                self.high = Some(match self.high.take() {
                    Some(high) => high.min(value),
                    None => value,
                });
            }
            Relation::Greater | Relation::GreaterEqual => {
                self.low = Some(match self.low.take() {
                    Some(low) => low.max(value),
                    None => value,
                });
            }
            Relation::Equal => {
                self.tighten(Relation::LessEqual, value.clone());
                self.tighten(Relation::GreaterEqual, value);
            }
            _ => {}
        }
    }

    /// Whether a value lies between the bounds; their strictness is left to the conditions.
    pub fn admit(&self, value: &Rational) -> bool {
        self.low.as_ref().is_none_or(|low| low <= value)
            && self.high.as_ref().is_none_or(|high| value <= high)
    }
}

/// The values p/q in lowest terms with |p| + q = size, nonnegative first.
pub fn values_of_size(size: usize, integer: bool) -> Vec<Rational> {
    let mut values = Vec::new();
    let size = size as i64;
    let denominators = if integer { 1..=1 } else { 1..=size };
    for denominator in denominators {
        let numerator = size - denominator;
        if numerator.gcd(&denominator) != 1 {
            continue;
        }
        let value = Rational::new(numerator.into(), denominator.into());
        if numerator > 0 {
            values.push(-&value);
        }
        values.push(value);
    }
    values.sort_by(|a, b| {
        b.is_negative()
            .cmp(&a.is_negative())
            .reverse()
            .then(a.cmp(b))
    });
    values
}

/// A random integer between the bounds, their ends more often than the rest.
pub fn random_integer(
    bounds: &Bounds,
    reach: Reach,
    rng: &mut Xoshiro256PlusPlus,
) -> Option<Rational> {
    let low = bounds.low.as_ref().map(|low| low.ceil().to_integer());
    let high = bounds.high.as_ref().map(|high| high.floor().to_integer());
    let value = match (low, high) {
        (Some(low), Some(high)) => {
            let width = (&high - &low).to_u64()?;
            match rng.random_range(0..4u32) {
                0 => low + BigInt::from(rng.random_range(0..=width.min(2))),
                1 => high - BigInt::from(rng.random_range(0..=width.min(2))),
                _ => low + BigInt::from(rng.random_range(0..=width)),
            }
        }
        (Some(low), None) => low + step_out(reach, rng),
        (None, Some(high)) => high - step_out(reach, rng),
        (None, None) => step_out(reach, rng) * if rng.random_bool(0.5) { 1 } else { -1 },
    };
    Some(Rational::from_integer(value))
}

/// How far from a bound a random integer lies.
fn step_out(reach: Reach, rng: &mut Xoshiro256PlusPlus) -> BigInt {
    match reach {
        Reach::Near => rng.random_range(0..=9u64).into(),
        Reach::Far => {
            let digits = rng.random_range(1..=4u32);
            rng.random_range(0..10u64.pow(digits)).into()
        }
    }
}

/// A random fraction between the bounds.
pub fn random_rational(bounds: &Bounds, reach: Reach, rng: &mut Xoshiro256PlusPlus) -> Rational {
    let most = match reach {
        Reach::Near => 12u64,
        Reach::Far => 10_000,
    };
    let denominator = rng.random_range(1..=most);
    match (&bounds.low, &bounds.high) {
        (Some(low), Some(high)) => {
            let part = Rational::new(rng.random_range(0..=denominator).into(), denominator.into());
            low + (high - low) * part
        }
        (low, high) => {
            let value = Rational::new(rng.random_range(0..=most).into(), denominator.into());
            match (low, high) {
                (Some(low), _) => low + value,
                (_, Some(high)) => high - value,
                _ if rng.random_bool(0.5) => -value,
                _ => value,
            }
        }
    }
}
