//! Integrals of fractions over finite pieces: exact up to the logarithms, which are enclosed once.
//!
//! In lowest terms a pole in a closed piece makes the integral diverge: it is then an infinity where
//! the integrand keeps one sign on the whole range, and has no value where it does not. Otherwise
//! the partial fractions integrate term by term, with a logarithm for the exponent -1 only.

use super::fraction::Fraction;
use super::functions::logarithm;
use super::interval::Interval;
use super::polynomial::Polynomial;
use super::quantity::Quantity;
use super::{Found, Gap, Unknown, known, unknown};
use crate::formula::Rational;
use num_traits::{One, Signed};
use std::cmp::Ordering;

/// How often a range is halved in the search for the sign of a polynomial.
const HALVINGS: u32 = 8;
/// The sign of no polynomial with more coefficients is looked for.
const LENGTH_CAP: usize = 100;

/// A part of a range, from one end to a larger one, and the integrand there.
pub(super) struct Piece {
    function: Fraction,
    from: Interval,
    to: Interval,
}

/// The integral over all pieces of a range.
pub(super) fn total(pieces: &[Piece], bits: u64) -> Found<Quantity> {
    let diverge: Vec<bool> = pieces
        .iter()
        .map(Piece::diverges)
        .collect::<Result<_, _>>()?;
    if diverge.contains(&true) {
        return infinite(pieces);
    }
    let mut sum = Interval::integer(0);
    for piece in pieces {
        sum = &sum + &piece.integral(bits)?;
    }
    Ok(sum.into())
}

/// A divergent integral, which is infinite where the integrand has one sign.
fn infinite(pieces: &[Piece]) -> Found<Quantity> {
    let mut signs = Vec::new();
    for piece in pieces.iter().filter(|piece| !piece.is_zero()) {
        match piece.sign()? {
            Some(sign) => signs.push(sign),
            None => return Err(Gap::Undefined),
        }
    }
    signs.dedup();
    match signs[..] {
        [sign] => Ok(Quantity::Infinite(sign)),
        _ => Err(Gap::Undefined),
    }
}

impl Piece {
    /// # Errors
    /// A fraction whose lowest terms are not settled.
    pub fn new(function: &Fraction, from: Interval, to: Interval) -> Result<Piece, Unknown> {
        let function = function.reduced()?;
        Ok(Piece { function, from, to })
    }

    fn is_zero(&self) -> bool {
        self.function.numerator.is_zero()
    }

    /// Whether a pole lies in the closed piece.
    fn diverges(&self) -> Result<bool, Unknown> {
        for root in self.function.poles.keys() {
            let root = Interval::exact(root.clone());
            if root.compare(&self.from)?.is_ge() && root.compare(&self.to)?.is_le() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The sign that the function keeps (`Greater`: nowhere negative), `None` where it is proved to
    /// take both.
    pub fn sign(&self) -> Result<Option<Ordering>, Unknown> {
        let mut signs = self.function.numerator.clone();
        for (root, multiplicity) in &self.function.poles {
            // A factor has the sign of its reciprocal; even powers are not negative.
            signs = signs.times(&Polynomial::linear(root).power(multiplicity % 2)?)?;
        }
        if !signs.is_exact() || signs.length() > LENGTH_CAP {
            return unknown("the sign of a polynomial with irrational or too many coefficients");
        }
        let sign = sign_between(&signs, self.from.low(), self.to.high(), HALVINGS)?;
        // The hull of enclosed ends may hold a change of sign that the piece itself has not.
        match (sign, self.from.as_exact(), self.to.as_exact()) {
            (Some(sign), ..) => Ok(Some(sign)),
            (None, Some(_), Some(_)) => Ok(None),
            _ => unknown("a change of sign that may lie beyond an end of the range"),
        }
    }

    /// The integral, where no pole lies in the closed piece.
    fn integral(&self, bits: u64) -> Result<Interval, Unknown> {
        let mut whole = self.function.numerator.clone();
        let mut parts = Vec::new();
        for (root, multiplicity) in &self.function.poles {
            parts.push((root, self.principal_part(root, *multiplicity)?));
            // The polynomial part: dividing by one factor after the other drops the remainders.
            for _ in 0..*multiplicity {
                whole = whole.divide(root).0;
            }
        }
        // Terms may be large and cancel: the logarithms get as many bits more as the largest has.
        let size = |(_, part): &(_, Vec<Interval>)| part.iter().map(Interval::size).max();
        let bits = bits + parts.iter().filter_map(size).max().unwrap_or(0);
        let whole = whole.antiderivative();
        let mut sum = &whole.at(&self.to) - &whole.at(&self.from);
        for (root, part) in parts {
            let root = Interval::exact(root.clone());
            let ends = (&self.from - &root, &self.to - &root);
            sum = &sum + &pole_integral(&part, &ends.0, &ends.1, bits)?;
        }
        Ok(sum)
    }

    /// c_1, c_2, ... of the sum of c_j/(x - root)^j: the first Taylor coefficients of the fraction
    /// without this pole, at the pole, highest power first.
    fn principal_part(&self, root: &Rational, order: u32) -> Result<Vec<Interval>, Unknown> {
        let mut series = self.function.numerator.taylor(root, order as usize);
        for (other, multiplicity) in &self.function.poles {
            if other != root {
                let inverse = Interval::exact((root - other).recip());
                for _ in 0..*multiplicity {
                    divide_series(&mut series, &inverse);
                }
            }
        }
        series.reverse();
        Ok(series)
    }
}

/// The power series divided by d + t, given 1/d: b_i = (a_i - b_(i-1))/d.
fn divide_series(series: &mut [Interval], inverse: &Interval) {
    let mut before = Interval::integer(0);
    for a in series {
        *a = &(&*a - &before) * inverse;
        before = a.clone();
    }
}

/// The integral of the sum of c_j/t^j between two ends on one side of zero.
fn pole_integral(
    part: &[Interval],
    from: &Interval,
    to: &Interval,
    bits: u64,
) -> Result<Interval, Unknown> {
    let ratio = &from.reciprocal()? * to;
    let logarithm = known(
        logarithm(&ratio, bits),
        "a pole too near to an end of the range",
    )?;
    let mut sum = Interval::integer(0);
    for (exponent, c) in (0_u32..).zip(part) {
        let antiderivative = match exponent {
            0 => logarithm.clone(),
            // -1/(j*t^j) is the antiderivative of 1/t^(j+1).
            j => {
                let share = Interval::exact(Rational::new((-1).into(), j.into()));
                let powers = &to.power(j).reciprocal()? - &from.power(j).reciprocal()?;
                &powers * &share
            }
        };
        sum = &sum + &(&antiderivative * c);
    }
    Ok(sum)
}

/// The sign of an exact p on a..b: (1+t)^n p((b+a*t)/(1+t)) for t >= 0 has coefficients of one sign.
/// Where it has not, the range is halved: a polynomial that is zero on a part of it is zero, and one
/// that keeps a sign takes it somewhere inside, so that opposite signs are both taken.
fn sign_between(
    p: &Polynomial,
    a: &Rational,
    b: &Rational,
    halvings: u32,
) -> Result<Option<Ordering>, Unknown> {
    // p(a + (b-a)s), then s = 1/(1+t): the coefficients reversed, and 1+t for t.
    let mut moved = p.taylor(a, p.length());
    let width = Interval::exact(b - a);
    let mut scale = Interval::integer(1);
    for c in &mut moved {
        *c = &*c * &scale;
        scale = &scale * &width;
    }
    moved.reverse();
    let moved = Polynomial::new(moved).taylor(&Rational::one(), p.length());
    if moved.iter().all(|c| !c.low().is_negative()) {
        return Ok(Some(Ordering::Greater));
    }
    if moved.iter().all(|c| !c.low().is_positive()) {
        return Ok(Some(Ordering::Less));
    }
    let Some(halvings) = halvings.checked_sub(1) else {
        return unknown("the sign of an integrand is not settled");
    };
    let middle = (a + b) / Rational::from_integer(2.into());
    let left = sign_between(p, a, &middle, halvings)?;
    let right = sign_between(p, &middle, b, halvings)?;
    Ok(left.filter(|_| left == right))
}

#[cfg(test)]
mod tests {
    use super::super::functions::ln;
    use super::*;

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(a.into(), b.into())
    }

    /// Numerator coefficients over poles, between two integers.
    fn piece(numerator: &[i64], poles: &[(i64, u32)], from: i64, to: i64) -> Piece {
        let coefficients = numerator.iter().map(|&c| Interval::integer(c)).collect();
        let function = Fraction {
            numerator: Polynomial::new(coefficients),
            poles: poles.iter().map(|&(r, p)| (ratio(r, 1), p)).collect(),
        };
        Piece::new(&function, Interval::integer(from), Interval::integer(to)).unwrap()
    }

    fn integral(piece: Piece) -> Found<Quantity> {
        total(&[piece], 64)
    }

    #[test]
    fn laurent_polynomials_term_by_term() {
        // x^2 + x^-2 from 1 to 2: 7/3 + 1/2
        let found = integral(piece(&[1, 0, 0, 0, 1], &[(0, 2)], 1, 2));
        assert_eq!(found, Ok(Interval::exact(ratio(17, 6)).into()));
    }

    #[test]
    fn the_exponent_minus_one_gives_a_logarithm() {
        let known = ln(&ratio(2, 1), 128).unwrap();
        let found = integral(piece(&[1], &[(0, 1)], 1, 2))
            .unwrap()
            .number()
            .unwrap();
        assert!(found.low() <= known.low() && known.high() <= found.high());
        assert!(found.high() - found.low() < ratio(1, 1 << 60) && found.size() < 250);
    }

    #[test]
    fn poles_in_the_closed_range_diverge() {
        for (numerator, poles, from, to, known) in [
            (
                &[1][..],
                &[(0, 1)][..],
                0,
                1,
                Ok(Quantity::Infinite(Ordering::Greater)),
            ),
            (
                &[1],
                &[(0, 1)],
                -1,
                0,
                Ok(Quantity::Infinite(Ordering::Less)),
            ),
            (&[1], &[(0, 1)], -1, 1, Err(Gap::Undefined)),
            (
                &[1],
                &[(0, 2)],
                -1,
                1,
                Ok(Quantity::Infinite(Ordering::Greater)),
            ),
            // x/x has no pole left.
            (&[0, 1], &[(0, 1)], 0, 1, Ok(Interval::integer(1).into())),
        ] {
            assert_eq!(integral(piece(numerator, poles, from, to)), known);
        }
    }

    #[test]
    fn signs_need_a_proof() {
        let sign = |numerator, poles| piece(numerator, poles, -1, 1).sign();
        assert_eq!(sign(&[1, -1, 1], &[]), Ok(Some(Ordering::Greater)));
        assert_eq!(sign(&[-1, 0, 4], &[]), Ok(None));
        assert_eq!(sign(&[-1, 0, 0], &[(5, 1)]), Ok(Some(Ordering::Greater)));
        // The sign changes within the enclosure of the lower end: on the range it may not.
        let mut enclosed = piece(&[-1, 1], &[], 0, 3);
        enclosed.from = Interval::between(ratio(0, 1), ratio(2, 1));
        assert!(enclosed.sign().is_err());
        // (3x - 1)^2: the double root is never at an end of a half.
        assert!(sign(&[1, -6, 9], &[]).is_err());
        // A coefficient that may be of either sign.
        let mut vague = piece(&[1], &[], 0, 1);
        vague.function = Interval::between(ratio(-1, 1), ratio(2, 1)).into();
        assert!(vague.sign().is_err());
        let monomial = |length| {
            let mut coefficients = vec![0; length];
            coefficients[length - 1] = 1;
            piece(&coefficients, &[], 0, 1).sign()
        };
        assert_eq!(monomial(LENGTH_CAP), Ok(Some(Ordering::Greater)));
        assert!(monomial(LENGTH_CAP + 1).is_err());
    }
}
