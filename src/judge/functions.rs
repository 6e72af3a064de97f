//! The polynomials that function parameters are tried with.

use crate::formula::{Formula, FunctionKind, Name, Rational};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};

/// Coefficients, constant term first, of the polynomials that function parameters are tried with.
/// For densities they multiply powers of the distance to the lower end, in absolute value.
const POLYNOMIALS: [[i64; 4]; COUNT] = [
    [0, 1, 0, 0],
    [1, 0, 0, 0],
    [1, 2, 0, 0],
    [0, 0, 1, 0],
    [2, -1, 3, 0],
    [1, 1, -2, 1],
];
pub const COUNT: usize = 6;

/// The n-th polynomial of its kind, as a formula in `argument`; a density needs a range with ends.
pub fn nth(
    n: usize,
    argument: &Name,
    kind: FunctionKind,
    range: Option<(Rational, Rational)>,
) -> Option<Formula> {
    let polynomial = POLYNOMIALS[n % COUNT];
    match kind {
        FunctionKind::Density => {
            let (from, to) = range.filter(|(from, to)| from < to)?;
            Some(density(argument, polynomial, &from, &to))
        }
        _ => {
            let coefficients = polynomial.map(|c| Rational::from_integer(c.into()));
            Some(horner(argument, &coefficients, &Rational::zero()))
        }
    }
}

/// The formula of `sum c_i (argument - shift)^i`.
fn horner(argument: &Name, coefficients: &[Rational; 4], shift: &Rational) -> Formula {
    use crate::formula::Operator::{Add, Multiply, Power, Subtract};
    let base = if shift.is_zero() {
        Formula::Name(argument.clone())
    } else {
        Formula::binary(
            Subtract,
            Formula::Name(argument.clone()),
            Formula::Number(shift.clone()),
        )
    };
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

/// A density between `from` and `to`: nonnegative coefficients in the distance to `from`, divided by
/// the integral.
fn density(argument: &Name, polynomial: [i64; 4], from: &Rational, to: &Rational) -> Formula {
    let width = to - from;
    let mut integral = Rational::zero();
    let mut power = width.clone();
    for (i, coefficient) in polynomial.iter().enumerate() {
        integral += Rational::new(coefficient.abs().into(), BigInt::from(i + 1)) * &power;
        power *= &width;
    }
    let scaled = polynomial.map(|c| Rational::from_integer(c.abs().into()) / &integral);
    horner(argument, &scaled, from)
}
