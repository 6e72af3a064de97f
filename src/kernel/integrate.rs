//! Integrals of fractions with rational poles: exact up to the logarithms, which are enclosed once.
//!
//! In lowest terms a pole in the closed range, or a degree above -2 towards an infinite end, makes
//! the integral diverge: it is then an infinity where the integrand keeps one sign, and has no
//! value where it does not. Otherwise the partial fractions integrate term by term, with a logarithm
//! for the exponent -1 and nowhere else.

use super::functions::ln_interval;
use super::interval::{Interval, Value};
use super::polynomial::{Fraction, Polynomial};
use super::{Unknown, unknown};
use crate::formula::Rational;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;

/// How often a range is halved in the search for the sign of a polynomial.
const HALVINGS: u32 = 8;
/// The sign of no polynomial with more coefficients is looked for.
const LENGTH_CAP: usize = 300;

/// The integral of a fraction from one end to a larger one.
pub(super) fn integral(
    fraction: &Fraction,
    from: &Value,
    to: &Value,
    bits: u64,
) -> Result<Value, Unknown> {
    let fraction = fraction.reduced(bits)?;
    if fraction.numerator.is_zero() {
        return Ok(Value::exact(0));
    }
    let mut diverges = diverges_at_infinity(&fraction, from, to)?;
    for root in fraction.poles.keys() {
        diverges |= lies_in(root, from, to)?;
    }
    if !diverges {
        return convergent(&fraction, from, to, bits);
    }
    Ok(match sign_on(&fraction, from, to, bits)? {
        Some(Ordering::Less) => Value::MinusInfinity,
        Some(_) => Value::PlusInfinity,
        None => Value::Undefined,
    })
}

/// Whether an end is infinite and the integrand does not fall like 1/x^2: by comparison with the
/// integral of x^p, which converges at infinity for p < -1 only.
fn diverges_at_infinity(fraction: &Fraction, from: &Value, to: &Value) -> Result<bool, Unknown> {
    if from.finite().is_some() && to.finite().is_some() {
        return Ok(false);
    }
    let leading = fraction.numerator.coefficients().last();
    if leading.is_none_or(|c| c.sign().is_none()) {
        return unknown("a leading coefficient that may be zero at these bits");
    }
    let below: u64 = fraction.poles.values().map(|&p| u64::from(p)).sum();
    Ok(fraction.numerator.length() as u64 + 1 > below)
}

/// Whether a pole lies in the closed range.
fn lies_in(root: &Rational, from: &Value, to: &Value) -> Result<bool, Unknown> {
    let root = Value::from(Interval::exact(root.clone()));
    match (from.compare(&root), root.compare(to)) {
        (Some(Ordering::Greater), _) | (_, Some(Ordering::Greater)) => Ok(false),
        (Some(_), Some(_)) => Ok(true),
        _ => unknown("a pole too near to an end of the range at these bits"),
    }
}

/// The sign that a fraction keeps on a range (`Greater`: nowhere negative), `None` where it is
/// proved to take both.
pub(super) fn sign_on(
    fraction: &Fraction,
    from: &Value,
    to: &Value,
    bits: u64,
) -> Result<Option<Ordering>, Unknown> {
    let mut signs = fraction.numerator.clone();
    for (root, multiplicity) in &fraction.poles {
        // A factor has the sign of its reciprocal; even powers are not negative.
        if multiplicity % 2 == 1 {
            signs = signs.times(&Polynomial::linear(root), bits)?;
        }
    }
    let Some(signs) = signs.as_exact() else {
        return unknown("the sign of a polynomial with coefficients that are not rational");
    };
    if signs.len() > LENGTH_CAP {
        return unknown("the sign of a polynomial of too high a degree");
    }
    let sign = match (from.finite(), to.finite()) {
        (Some(a), Some(b)) => sign_between(&signs, a.low(), Some(b.high()), HALVINGS)?,
        (Some(a), None) => sign_between(&signs, a.low(), None, HALVINGS)?,
        (None, Some(b)) => sign_between(&mirrored(&signs), &-b.high(), None, HALVINGS)?,
        (None, None) => {
            let zero = Rational::zero();
            let right = sign_between(&signs, &zero, None, HALVINGS)?;
            let left = sign_between(&mirrored(&signs), &zero, None, HALVINGS)?;
            both(left, right)
        }
    };
    // The hull of enclosed ends may hold a change of sign that the range itself has not.
    let enclosed = |end: &Value| end.finite().is_some_and(|end| !end.is_exact());
    if sign.is_none() && (enclosed(from) || enclosed(to)) {
        return unknown("a change of sign that may lie beyond an end of the range");
    }
    Ok(sign)
}

/// p(-x)
fn mirrored(p: &[Rational]) -> Vec<Rational> {
    let odd = |i: usize| i % 2 == 1;
    let turn = |(i, c): (usize, &Rational)| if odd(i) { -c } else { c.clone() };
    p.iter().enumerate().map(turn).collect()
}

/// The sign on two neighbouring ranges together. A polynomial that is zero on one of them is zero,
/// and one that keeps a sign takes it somewhere inside, so opposite signs are both taken.
fn both(left: Option<Ordering>, right: Option<Ordering>) -> Option<Ordering> {
    if left == right { left } else { None }
}

/// The sign of p on a..b (or on a..inf): p(a+t) for t >= 0, or (1+t)^n p((b+a*t)/(1+t)), has
/// coefficients of one sign. Where it has not, the range is halved.
fn sign_between(
    p: &[Rational],
    a: &Rational,
    b: Option<&Rational>,
    halvings: u32,
) -> Result<Option<Ordering>, Unknown> {
    let mut moved = shifted(p, a);
    if let Some(b) = b {
        let width = b - a;
        let mut scale = Rational::one();
        for c in &mut moved {
            *c *= &scale;
            scale *= &width;
        }
        moved.reverse();
        moved = shifted(&moved, &Rational::one());
    }
    if moved.iter().all(|c| !c.is_negative()) {
        return Ok(Some(Ordering::Greater));
    }
    if moved.iter().all(|c| !c.is_positive()) {
        return Ok(Some(Ordering::Less));
    }
    if halvings == 0 {
        return unknown("the sign of an integrand is not settled");
    }
    let middle = match b {
        Some(b) => (a + b) / Rational::from_integer(2.into()),
        None => a + a.abs() + Rational::one(),
    };
    let left = sign_between(p, a, Some(&middle), halvings - 1)?;
    let right = sign_between(p, &middle, b, halvings - 1)?;
    Ok(both(left, right))
}

/// The coefficients of p(x + a): the remainders of repeated division by x - a.
fn shifted(p: &[Rational], a: &Rational) -> Vec<Rational> {
    let mut result = p.to_vec();
    let n = result.len();
    for start in 0..n {
        for i in (start..n.saturating_sub(1)).rev() {
            let carried = &result[i + 1] * a;
            result[i] += carried;
        }
    }
    result
}

/// The integral of a reduced fraction without poles in the closed range.
fn convergent(f: &Fraction, from: &Value, to: &Value, bits: u64) -> Result<Value, Unknown> {
    let (from, to) = (from.finite(), to.finite());
    let parts: Vec<(&Rational, Vec<Interval>)> = f
        .poles
        .keys()
        .map(|root| principal_part(f, root, bits).map(|part| (root, part)))
        .collect::<Result<_, _>>()?;
    // Terms may be large and cancel: the logarithms get as many bits more as the largest has.
    let magnitude = |c: &Interval| c.high().numer().bits().max(c.low().numer().bits());
    let largest = parts
        .iter()
        .flat_map(|(_, part)| part.iter().map(magnitude));
    let bits = bits + largest.max().unwrap_or(0) + 32;
    let mut sum = Interval::integer(0);
    let whole = whole_part(f, bits).antiderivative(bits);
    if let (Some(a), Some(b)) = (&from, &to) {
        sum = whole.at(b, bits).minus(&whole.at(a, bits), bits);
    }
    for (root, part) in &parts {
        let root = Interval::exact((*root).clone());
        let from = from.as_ref().map(|a| a.minus(&root, bits));
        let to = to.as_ref().map(|b| b.minus(&root, bits));
        sum = sum.plus(&pole_integral(part, &from, &to, bits)?, bits);
    }
    Ok(sum.into())
}

/// The polynomial part: dividing by one linear factor after the other drops the remainders.
fn whole_part(f: &Fraction, bits: u64) -> Polynomial {
    let mut quotient = f.numerator.clone();
    for (root, multiplicity) in &f.poles {
        for _ in 0..*multiplicity {
            quotient = quotient.divide(root, bits).0;
        }
    }
    quotient
}

/// c_1, c_2, ... of the sum of c_j/(x - root)^j: the first Taylor coefficients of the fraction
/// without this pole, at the pole, highest power first.
fn principal_part(f: &Fraction, root: &Rational, bits: u64) -> Result<Vec<Interval>, Unknown> {
    let order = f.poles.get(root).copied().unwrap_or(0);
    let mut series = Vec::new();
    let mut rest = f.numerator.clone();
    for _ in 0..order {
        let (quotient, coefficient) = rest.divide(root, bits);
        series.push(coefficient);
        rest = quotient;
    }
    for (other, multiplicity) in f.poles.iter().filter(|(other, _)| *other != root) {
        let Some(inverse) = Interval::exact(root - other).reciprocal(bits) else {
            return unknown("two equal poles");
        };
        for _ in 0..*multiplicity {
            divide_series(&mut series, &inverse, bits);
        }
    }
    series.reverse();
    Ok(series)
}

/// The power series divided by d + t, given 1/d: b_i = (a_i - b_(i-1))/d.
fn divide_series(series: &mut [Interval], inverse: &Interval, bits: u64) {
    let mut before = Interval::integer(0);
    for a in series {
        *a = a.minus(&before, bits).times(inverse, bits);
        before = a.clone();
    }
}

/// The integral of the sum of c_j/t^j between two ends on one side of zero. At an infinite end the
/// powers vanish, and so do the logarithms of all poles together, as their factors sum to zero
/// where the integral converges.
fn pole_integral(
    part: &[Interval],
    from: &Option<Interval>,
    to: &Option<Interval>,
    bits: u64,
) -> Result<Interval, Unknown> {
    let (mut low, mut high) = (Interval::integer(0), Interval::integer(0));
    for (j, c) in part.iter().enumerate().skip(1) {
        // -1/(j*t^j) is the antiderivative of 1/t^(j+1).
        let share = Interval::exact(Rational::new((-1).into(), (j as i64).into()));
        let term = |end: &Interval| {
            let power = end.power(j as u32, bits).reciprocal(bits)?;
            Some(power.times(&share, bits).times(c, bits))
        };
        low = low.plus(&at_end(from, term)?, bits);
        high = high.plus(&at_end(to, term)?, bits);
    }
    let powers = high.minus(&low, bits);
    let Some(residue) = part.first().filter(|c| !c.is_zero()) else {
        return Ok(powers);
    };
    let logarithm = match (from, to) {
        (Some(a), Some(b)) => {
            let ratio = a.reciprocal(bits).map(|inverse| inverse.times(b, bits));
            positive_ln(ratio, bits)?
        }
        (Some(a), None) => positive_ln(Some(a.absolute()), bits)?.negated(),
        (None, Some(b)) => positive_ln(Some(b.absolute()), bits)?,
        (None, None) => Interval::integer(0),
    };
    Ok(powers.plus(&logarithm.times(residue, bits), bits))
}

fn at_end(
    end: &Option<Interval>,
    term: impl Fn(&Interval) -> Option<Interval>,
) -> Result<Interval, Unknown> {
    match end.as_ref().map(term) {
        None => Ok(Interval::integer(0)),
        Some(Some(value)) => Ok(value),
        Some(None) => unknown("a pole too near to an end of the range at these bits"),
    }
}

fn positive_ln(x: Option<Interval>, bits: u64) -> Result<Interval, Unknown> {
    match x {
        Some(x) if x.sign() == Some(Ordering::Greater) => ln_interval(&x, bits),
        _ => unknown("a pole too near to an end of the range at these bits"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(a.into(), b.into())
    }

    fn finite(a: i64, b: i64) -> Value {
        Interval::exact(ratio(a, b)).into()
    }

    /// Numerator coefficients over poles.
    fn fraction(numerator: &[i64], poles: &[(i64, u32)]) -> Fraction {
        let coefficients = numerator.iter().map(|&c| Interval::integer(c)).collect();
        Fraction {
            numerator: Polynomial::new(coefficients),
            poles: poles.iter().map(|&(r, p)| (ratio(r, 1), p)).collect(),
        }
    }

    #[test]
    fn laurent_polynomials_term_by_term() {
        // x^2 + x^-2 from 1 to 2: 7/3 + 1/2
        let f = fraction(&[1, 0, 0, 0, 1], &[(0, 2)]);
        assert_eq!(
            integral(&f, &finite(1, 1), &finite(2, 1), 64),
            Ok(finite(17, 6))
        );
    }

    #[test]
    fn the_exponent_minus_one_gives_a_logarithm() {
        let f = fraction(&[1], &[(0, 1)]);
        let found = integral(&f, &finite(1, 1), &finite(2, 1), 64).unwrap();
        let known = super::super::functions::ln(&ratio(2, 1), 128).unwrap();
        let found = found.finite().unwrap();
        assert!(found.low() <= known.low() && known.high() <= found.high());
        // 1/(x(x+1)) from 1 to inf: ln 2 as well
        let f = fraction(&[1], &[(0, 1), (-1, 1)]);
        let found = integral(&f, &finite(1, 1), &Value::PlusInfinity, 64).unwrap();
        let found = found.finite().unwrap();
        assert!(found.low() <= known.low() && known.high() <= found.high());
    }

    #[test]
    fn poles_in_the_closed_range_diverge() {
        let (zero, one, minus) = (finite(0, 1), finite(1, 1), finite(-1, 1));
        let inverse = fraction(&[1], &[(0, 1)]);
        assert_eq!(integral(&inverse, &zero, &one, 64), Ok(Value::PlusInfinity));
        assert_eq!(
            integral(&inverse, &minus, &zero, 64),
            Ok(Value::MinusInfinity)
        );
        assert_eq!(integral(&inverse, &minus, &one, 64), Ok(Value::Undefined));
        let square = fraction(&[1], &[(0, 2)]);
        assert_eq!(integral(&square, &minus, &one, 64), Ok(Value::PlusInfinity));
        assert_eq!(
            integral(&inverse, &one, &Value::PlusInfinity, 64),
            Ok(Value::PlusInfinity)
        );
        assert_eq!(
            integral(&square, &one, &Value::PlusInfinity, 64),
            Ok(one.clone())
        );
        // x/x has no pole left.
        let cancelled = fraction(&[0, 1], &[(0, 1)]);
        assert_eq!(integral(&cancelled, &zero, &one, 64), Ok(one));
    }

    #[test]
    fn signs_need_a_proof() {
        let (minus, one) = (finite(-1, 1), finite(1, 1));
        let sign = |f: &Fraction| sign_on(f, &minus, &one, 64);
        assert_eq!(
            sign(&fraction(&[1, -1, 1], &[])),
            Ok(Some(Ordering::Greater))
        );
        assert_eq!(sign(&fraction(&[-1, 0, 4], &[])), Ok(None));
        assert_eq!(
            sign(&fraction(&[-1, 0, 0], &[(5, 1)])),
            Ok(Some(Ordering::Greater))
        );
        // The sign changes within the enclosure of the lower end: on the range it may not.
        let end: Value = Interval::between(ratio(0, 1), ratio(2, 1)).into();
        let found = sign_on(&fraction(&[-1, 1], &[]), &end, &Value::PlusInfinity, 64);
        assert!(found.is_err());
        // (3x - 1)^2: the double root is never at an end of a half.
        assert!(sign(&fraction(&[1, -6, 9], &[])).is_err());
    }
}
