//! The polynomials that function parameters are tried with.

use crate::formula::{Formula, FunctionKind, Name, Rational};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// The n-th polynomial of its kind, as a formula in `argument`; a density needs a range with ends.
pub fn nth(
    n: usize,
    argument: &Name,
    kind: FunctionKind,
    range: Option<(Rational, Rational)>,
) -> Option<Formula> {
    let sample = &SAMPLES[n % COUNT];
    match kind {
        FunctionKind::Density => {
            let (from, to) = range.filter(|(from, to)| from < to)?;
            Some(density(argument, sample, &from, &to))
        }
        _ => {
            let coefficients = sample
                .coefficients
                .map(|c| Rational::from_integer(c.into()));
            Some(powers(&Formula::Name(argument.clone()), &coefficients))
        }
    }
}

/// A function that parameters are tried with: coefficients, constant term first, of a polynomial. For
/// a density they are taken in absolute value and multiply powers of the distance to an origin.
struct Sample {
    coefficients: [i64; DEGREE + 1],
    origin: Origin,
}

/// From where the distance counts of which a density is a polynomial.
#[derive(Clone, Copy)]
enum Origin {
    Lower,
    Upper,
    /// Even powers only.
    Middle,
}

/// Rules that are exact for cubics, such as Simpson's, hold for no polynomial of a higher degree.
const DEGREE: usize = 5;

const fn sample(coefficients: [i64; DEGREE + 1], origin: Origin) -> Sample {
    Sample {
        coefficients,
        origin,
    }
}

/// Among the densities there must be falling ones as well as rising ones, and one that is not monotone.
const SAMPLES: [Sample; COUNT] = [
    sample([0, 1, 0, 0, 0, 0], Origin::Lower),
    sample([1, 0, 0, 0, 0, 0], Origin::Lower),
    sample([1, 2, 0, 0, 0, 0], Origin::Lower),
    sample([0, 0, 1, 0, 0, 0], Origin::Lower),
    sample([0, 2, 0, 0, 0, 0], Origin::Upper),
    sample([2, -1, 3, 0, 0, 0], Origin::Lower),
    sample([1, 1, -2, 1, 0, 0], Origin::Lower),
    sample([0, 0, 3, 0, 0, 0], Origin::Middle),
    sample([-3, 0, 0, 0, 5, 0], Origin::Upper),
    sample([3, -2, 0, 5, 1, -40], Origin::Lower),
];
pub const COUNT: usize = 10;

/// The formula of `sum c_i base^i`.
fn powers(base: &Formula, coefficients: &[Rational]) -> Formula {
    use crate::formula::Operator::{Add, Multiply, Power};
    let mut sum: Option<Formula> = None;
    for (power, coefficient) in coefficients.iter().enumerate() {
        if coefficient.is_zero() {
            continue;
        }
        let number = Formula::Number(coefficient.clone());
        let term = match power {
            0 => number,
            1 => Formula::binary(Multiply, number, base.clone()),
            _ => Formula::binary(
                Multiply,
                number,
                Formula::binary(Power, base.clone(), Formula::integer(power as i64)),
            ),
        };
        sum = Some(match sum {
            None => term,
            Some(sum) => Formula::binary(Add, sum, term),
        });
    }
    sum.unwrap_or_else(|| Formula::integer(0))
}

/// A density between `from` and `to`: nonnegative coefficients in a distance, divided by the integral.
fn density(argument: &Name, sample: &Sample, from: &Rational, to: &Rational) -> Formula {
    use crate::formula::Operator::Subtract;
    let name = Formula::Name(argument.clone());
    let number = |value: &Rational| Formula::Number(value.clone());
    let two = Rational::from_integer(2.into());
    let (base, reach, sides) = match sample.origin {
        Origin::Lower if from.is_zero() => (name, to - from, Rational::one()),
        Origin::Lower => (
            Formula::binary(Subtract, name, number(from)),
            to - from,
            Rational::one(),
        ),
        Origin::Upper => (
            Formula::binary(Subtract, number(to), name),
            to - from,
            Rational::one(),
        ),
        Origin::Middle => {
            let middle = (from + to) / &two;
            let base = Formula::binary(Subtract, name, number(&middle));
            (base, (to - from) / &two, two)
        }
    };
    let mut integral = Rational::zero();
    let mut power = reach.clone() * sides;
    for (i, coefficient) in sample.coefficients.iter().enumerate() {
        integral += Rational::new(coefficient.abs().into(), BigInt::from(i + 1)) * &power;
        power *= &reach;
    }
    let scaled = sample
        .coefficients
        .map(|c| Rational::from_integer(c.abs().into()) / &integral);
    powers(&base, &scaled)
}
