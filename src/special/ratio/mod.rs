//! The ratio `Gamma(x)/Gamma(y)` for rational x and y: five ways, one file each, and the choice.
//!
//! | way | domain | bits lost | cost of P bits |
//! |---|---|---|---|
//! | [`Way::Shift`] | x - y a small integer | none: a rational number | products that grow to the size of the answer |
//! | [`Way::Product`] | x - y an integer | log2 of its size | one product a step |
//! | [`Way::Quotient`] | x, y of moderate size, no poles | a few | two Gamma functions |
//! | [`Way::Logarithm`] | x, y > 0 | those before the point of ln Gamma | two ln Gamma, one exp |
//! | [`Way::Asymptotic`] | x, y > 0, not far apart | a few | the square of the number of terms |
//!
//! All are certified. In f64 the third overflows from Gamma(172) on, and the fourth loses
//! log10(x ln x) of 16 digits; the tests show both.

mod asymptotic;
mod logarithm;
mod product;
mod quotient;
mod shift;

pub use shift::gamma_ratio_exact;

use super::gamma_quotient;
use crate::number::{DomainError, Interval};
use rug::{Integer, Rational};

/// A method for `Gamma(x)/Gamma(y)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Way {
    /// A finite product in exact arithmetic.
    Shift,
    /// A finite product of intervals.
    Product,
    /// One Gamma function by the other.
    Quotient,
    /// The exponential of the difference of their logarithms.
    Logarithm,
    /// The expansion for large arguments, with its remainder.
    Asymptotic,
}

impl Way {
    /// All of them.
    pub const ALL: [Way; 5] = [
        Way::Shift,
        Way::Product,
        Way::Quotient,
        Way::Logarithm,
        Way::Asymptotic,
    ];

    /// The work for `precision` bits in about nanoseconds, a guess that costs time at most; `None`
    /// outside the domain of the method.
    pub fn cost(self, x: &Rational, y: &Rational, precision: u32) -> Option<f64> {
        match self {
            Way::Shift => shift::cost(x, y, precision),
            Way::Product => product::cost(x, y, precision),
            Way::Quotient => quotient::cost(x, y, precision),
            Way::Logarithm => logarithm::cost(x, y, precision),
            Way::Asymptotic => asymptotic::cost(x, y, precision),
        }
    }

    /// The ratio by this method.
    ///
    /// # Errors
    /// `Possible` outside the method's domain.
    pub fn ratio(
        self,
        x: &Rational,
        y: &Rational,
        precision: u32,
    ) -> Result<Interval, DomainError> {
        self.cost(x, y, precision).ok_or(DomainError::Possible)?;
        match self {
            Way::Shift => shift::ratio(x, y, precision),
            Way::Product => product::ratio(x, y, precision),
            Way::Quotient => quotient::ratio(x, y, precision),
            Way::Logarithm => logarithm::ratio(x, y, precision),
            Way::Asymptotic => asymptotic::ratio(x, y, precision),
        }
    }
}

/// The methods whose domain holds x and y, cheapest first.
pub fn choose(x: &Rational, y: &Rational, precision: u32) -> Vec<Way> {
    let cost = |way: Way| way.cost(x, y, precision).map(|cost| (way, cost));
    let mut ways: Vec<(Way, f64)> = Way::ALL.into_iter().filter_map(cost).collect();
    ways.sort_by(|a, b| a.1.total_cmp(&b.1));
    ways.into_iter().map(|(way, _)| way).collect()
}

/// `Gamma(x)/Gamma(y)` by the cheapest method, to about `precision` bits.
///
/// ```
/// use claimcheck::special::gamma_ratio;
/// use rug::Rational;
/// // Gamma(k-2)/Gamma(k) = 1/((k-1)(k-2)) where both are far beyond any f64.
/// let k = 1_000_000_000_000u64;
/// let value = gamma_ratio(&Rational::from(k - 2), &Rational::from(k), 100).expect("no pole");
/// assert!(value.contains_rational(&Rational::from((1, u128::from(k - 1) * u128::from(k - 2)))));
/// assert!(value.agrees_to(29));
/// ```
///
/// # Errors
/// `Certain` where Gamma(x) has a pole and Gamma(y) has none; `Possible` where both have, and past
/// the reach of all methods.
pub fn gamma_ratio(x: &Rational, y: &Rational, precision: u32) -> Result<Interval, DomainError> {
    match (is_pole(x), is_pole(y)) {
        (true, true) => return Err(DomainError::Possible),
        (true, false) => return Err(DomainError::Certain),
        (false, true) => return Ok(Interval::from_i64(0, precision)),
        (false, false) => {}
    }
    for way in choose(x, y, precision) {
        if let Ok(value) = way.ratio(x, y, precision) {
            return Ok(value);
        }
    }
    // Below 0: by reflection.
    let point = |q: &Rational| Interval::from_rational(q, guarded(precision, &[x, y]));
    gamma_quotient(&[point(x)], &[point(y)], precision)
}

/// 0, -1, -2, ...
fn is_pole(x: &Rational) -> bool {
    x.is_integer() && *x <= 0
}

/// x - y where it is an integer of at most `most` in size and no factor of the product is 0.
fn steps(x: &Rational, y: &Rational, most: u32) -> Option<i64> {
    let difference = Rational::from(x - y);
    let steps = difference
        .is_integer()
        .then(|| difference.numer().to_i64())??;
    (steps.unsigned_abs() <= u64::from(most) && !is_pole(x) && !is_pole(y)).then_some(steps)
}

/// The binary exponent of the larger of two arguments, at least 1.
fn exponent(x: &Rational, y: &Rational) -> u32 {
    let bits = |q: &Rational| {
        let size = q.numer().significant_bits() as i64 - i64::from(q.denom().significant_bits());
        (size + 1).clamp(1, i64::from(u32::MAX)) as u32
    };
    bits(x).max(bits(y))
}

/// More bits than asked for, for arguments that large.
fn guarded(precision: u32, arguments: &[&Rational]) -> u32 {
    let largest = arguments.iter().map(|q| exponent(q, q)).max();
    precision + 32 + largest.unwrap_or(0)
}

/// About the nanoseconds of a product of two intervals.
fn product_cost(precision: u32) -> f64 {
    let words = f64::from(precision) / 64.0;
    100.0 + 2.0 * words.powf(1.6)
}

/// About the nanoseconds of Gamma or ln Gamma of a number with a binary exponent, by MPFR: Stirling's
/// series has fewer terms where the number is large.
fn gamma_cost(precision: u32, exponent: u32) -> f64 {
    let bits = f64::from(precision);
    let terms = (6.0 / f64::from(exponent)).min(1.0);
    20_000.0 + bits.powi(2) / 5.0 + terms * bits.powi(3) / 4000.0
}

fn positive(x: &Rational, y: &Rational) -> bool {
    *x > 0 && *y > 0
}

/// The least integer not below x.
fn ceil(x: &Rational) -> Integer {
    Rational::from(x.ceil_ref()).numer().clone()
}

#[cfg(test)]
mod tests;
