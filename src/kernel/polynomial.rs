//! Plain polynomials in one variable with enclosed coefficients, and fractions of them by products
//! of linear factors with rational roots: the integrands that the kernel can integrate.

use super::interval::Interval;
use super::{Unknown, unknown};
use crate::formula::Rational;
use num_traits::{Signed, Zero};
use std::collections::BTreeMap;

/// No polynomial of a higher degree is made.
const DEGREE_CAP: usize = 1500;

/// Coefficients from the constant one up; exact zeros at the top are dropped.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polynomial(Vec<Interval>);

impl Polynomial {
    pub fn new(mut coefficients: Vec<Interval>) -> Polynomial {
        while coefficients.last().is_some_and(Interval::is_zero) {
            coefficients.pop();
        }
        Polynomial(coefficients)
    }

    pub fn constant(value: Interval) -> Polynomial {
        Polynomial::new(vec![value])
    }

    /// x - root
    pub fn linear(root: &Rational) -> Polynomial {
        Polynomial::new(vec![Interval::exact(-root), Interval::integer(1)])
    }

    pub fn coefficients(&self) -> &[Interval] {
        &self.0
    }

    /// Number of coefficients: the degree and one, or 0 for the zero polynomial.
    pub fn length(&self) -> usize {
        self.0.len()
    }

    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The exact coefficients, if they all are.
    pub fn as_exact(&self) -> Option<Vec<Rational>> {
        self.0.iter().map(|c| c.as_exact().cloned()).collect()
    }

    pub fn plus(&self, other: &Polynomial, bits: u64) -> Polynomial {
        let zero = Interval::integer(0);
        let length = self.length().max(other.length());
        let pick = |p: &Polynomial, i: usize| p.0.get(i).cloned().unwrap_or_else(|| zero.clone());
        let sum = |i| pick(self, i).plus(&pick(other, i), bits);
        Polynomial::new((0..length).map(sum).collect())
    }

    pub fn negated(&self) -> Polynomial {
        Polynomial(self.0.iter().map(Interval::negated).collect())
    }

    /// # Errors
    /// A degree above the cap.
    pub fn times(&self, other: &Polynomial, bits: u64) -> Result<Polynomial, Unknown> {
        if self.is_zero() || other.is_zero() {
            return Ok(Polynomial(Vec::new()));
        }
        let length = self.length() + other.length() - 1;
        if length > DEGREE_CAP {
            return unknown("a polynomial of too high a degree");
        }
        let mut product = vec![Interval::integer(0); length];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = product[i + j].plus(&a.times(b, bits), bits);
            }
        }
        Ok(Polynomial::new(product))
    }

    /// # Errors
    /// A degree above the cap.
    pub fn power(&self, exponent: u32, bits: u64) -> Result<Polynomial, Unknown> {
        let mut result = Polynomial::constant(Interval::integer(1));
        if self.length() <= 1 && exponent as usize > DEGREE_CAP {
            return unknown("a power that is too large");
        }
        for _ in 0..exponent {
            if result.is_zero() {
                break;
            }
            result = result.times(self, bits)?;
        }
        Ok(result)
    }

    /// The value by Horner's rule.
    pub fn at(&self, x: &Interval, bits: u64) -> Interval {
        let step = |sum: Interval, c: &Interval| sum.times(x, bits).plus(c, bits);
        self.0.iter().rev().fold(Interval::integer(0), step)
    }

    /// The polynomial that takes the value `self(inner(x))`.
    ///
    /// # Errors
    /// A degree above the cap.
    pub fn compose(&self, inner: &Polynomial, bits: u64) -> Result<Polynomial, Unknown> {
        let mut sum = Polynomial(Vec::new());
        for c in self.0.iter().rev() {
            sum = sum
                .times(inner, bits)?
                .plus(&Polynomial::constant(c.clone()), bits);
        }
        Ok(sum)
    }

    /// Quotient and remainder by x - root (Ruffini): the remainder is the value at the root.
    pub fn divide(&self, root: &Rational, bits: u64) -> (Polynomial, Interval) {
        let root = Interval::exact(root.clone());
        let mut carried = Interval::integer(0);
        let mut quotient = Vec::with_capacity(self.length());
        for c in self.0.iter().rev() {
            carried = carried.times(&root, bits).plus(c, bits);
            quotient.push(carried.clone());
        }
        quotient.pop();
        quotient.reverse();
        (Polynomial::new(quotient), carried)
    }

    pub fn derivative(&self, bits: u64) -> Polynomial {
        let term = |(i, c): (usize, &Interval)| c.times(&Interval::integer(i as i64), bits);
        Polynomial::new(self.0.iter().enumerate().skip(1).map(term).collect())
    }

    /// The antiderivative that is zero at 0, term by term (no exponent is -1).
    pub fn antiderivative(&self, bits: u64) -> Polynomial {
        let mut result = vec![Interval::integer(0)];
        for (i, c) in self.0.iter().enumerate() {
            let share = Rational::new(1.into(), (i as i64 + 1).into());
            result.push(c.times(&Interval::exact(share), bits));
        }
        Polynomial::new(result)
    }
}

/// `numerator` over the product of (x - root)^multiplicity. It is kept as it was written, common
/// factors included: a root of multiplicity 0 marks where a part of the formula has a pole that
/// another part cancels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fraction {
    pub numerator: Polynomial,
    pub poles: BTreeMap<Rational, u32>,
}

impl Fraction {
    pub fn polynomial(numerator: Polynomial) -> Fraction {
        Fraction {
            numerator,
            poles: BTreeMap::new(),
        }
    }

    pub fn constant(value: Interval) -> Fraction {
        Fraction::polynomial(Polynomial::constant(value))
    }

    /// The variable itself.
    pub fn variable() -> Fraction {
        Fraction::polynomial(Polynomial::linear(&Rational::zero()))
    }

    /// The numerator, if no part has a pole.
    pub fn as_polynomial(&self) -> Option<&Polynomial> {
        self.poles.is_empty().then_some(&self.numerator)
    }

    pub fn negated(&self) -> Fraction {
        Fraction {
            numerator: self.numerator.negated(),
            poles: self.poles.clone(),
        }
    }

    pub fn times(&self, other: &Fraction, bits: u64) -> Result<Fraction, Unknown> {
        let mut poles = self.poles.clone();
        for (root, multiplicity) in &other.poles {
            *poles.entry(root.clone()).or_insert(0) += multiplicity;
        }
        let numerator = self.numerator.times(&other.numerator, bits)?;
        Ok(Fraction { numerator, poles })
    }

    /// The sum over the least common denominator.
    pub fn plus(&self, other: &Fraction, bits: u64) -> Result<Fraction, Unknown> {
        let mut poles = self.poles.clone();
        for (root, multiplicity) in &other.poles {
            let entry = poles.entry(root.clone()).or_insert(0);
            *entry = (*entry).max(*multiplicity);
        }
        let left = self.raised(&poles, bits)?;
        let numerator = left.plus(&other.raised(&poles, bits)?, bits);
        Ok(Fraction { numerator, poles })
    }

    /// The numerator over the larger denominator.
    fn raised(&self, poles: &BTreeMap<Rational, u32>, bits: u64) -> Result<Polynomial, Unknown> {
        let mut numerator = self.numerator.clone();
        for (root, multiplicity) in poles {
            let own = self.poles.get(root).copied().unwrap_or(0);
            let factor = Polynomial::linear(root).power(multiplicity.saturating_sub(own), bits)?;
            numerator = numerator.times(&factor, bits)?;
        }
        Ok(numerator)
    }

    pub fn power(&self, exponent: u32, bits: u64) -> Result<Fraction, Unknown> {
        let mut poles = self.poles.clone();
        for multiplicity in poles.values_mut() {
            *multiplicity = match multiplicity.checked_mul(exponent) {
                Some(product) if product as usize <= DEGREE_CAP => product,
                _ => return unknown("a pole of too high an order"),
            };
        }
        let numerator = self.numerator.power(exponent, bits)?;
        Ok(Fraction { numerator, poles })
    }

    /// 1 over this; `None` for the zero fraction, which has no reciprocal anywhere.
    ///
    /// # Errors
    /// A numerator that is not found to be a constant times linear factors with rational roots.
    pub fn reciprocal(&self, bits: u64) -> Result<Option<Fraction>, Unknown> {
        if self.numerator.is_zero() {
            return Ok(None);
        }
        let (constant, mut poles) = linear_factors(&self.numerator, bits)?;
        let Some(inverse) = constant.reciprocal(bits) else {
            return unknown("a divisor that may be zero at these bits");
        };
        let mut numerator = Polynomial::constant(inverse);
        for (root, multiplicity) in &self.poles {
            let factor = Polynomial::linear(root).power(*multiplicity, bits)?;
            numerator = numerator.times(&factor, bits)?;
            poles.entry(root.clone()).or_insert(0);
        }
        Ok(Some(Fraction { numerator, poles }))
    }

    /// The value at a number that is no pole, else `None`.
    pub fn at(&self, x: &Interval, bits: u64) -> Option<Interval> {
        let mut value = self.numerator.at(x, bits);
        for (root, multiplicity) in &self.poles {
            let distance = x.minus(&Interval::exact(root.clone()), bits);
            let inverse = distance.reciprocal(bits)?;
            value = value.times(&inverse.power(*multiplicity, bits), bits);
        }
        Some(value)
    }

    /// The same function in lowest terms: common linear factors divided out.
    ///
    /// # Errors
    /// A numerator that may or may not vanish at a pole.
    pub fn reduced(&self, bits: u64) -> Result<Fraction, Unknown> {
        let mut numerator = self.numerator.clone();
        let mut poles = BTreeMap::new();
        if numerator.is_zero() {
            return Ok(Fraction { numerator, poles });
        }
        for (root, multiplicity) in &self.poles {
            let mut left = *multiplicity;
            while left > 0 {
                let (quotient, rest) = numerator.divide(root, bits);
                if !rest.is_zero() {
                    if rest.sign().is_none() {
                        return unknown("a pole that may cancel at these bits");
                    }
                    break;
                }
                numerator = quotient;
                left -= 1;
            }
            if left > 0 {
                poles.insert(root.clone(), left);
            }
        }
        Ok(Fraction { numerator, poles })
    }
}

/// The leading coefficient and the rational roots of a nonzero polynomial that is x^j times the
/// power of a linear factor, or times a quadratic with rational roots. The product is compared with
/// the polynomial, so that a wrong guess is found out.
pub(super) fn linear_factors(
    polynomial: &Polynomial,
    bits: u64,
) -> Result<(Interval, BTreeMap<Rational, u32>), Unknown> {
    let mut roots = BTreeMap::new();
    let all = polynomial.coefficients();
    let low = all.iter().take_while(|c| c.is_zero()).count();
    if low > 0 {
        roots.insert(Rational::zero(), low as u32);
    }
    let rest = &all[low..];
    if let [constant] = rest {
        return Ok((constant.clone(), roots));
    }
    let exact: Option<Vec<Rational>> = rest.iter().map(|c| c.as_exact().cloned()).collect();
    let Some(exact) = exact else {
        return unknown("a divisor with coefficients that are not rational");
    };
    let guesses = guessed_roots(&exact);
    let leading = Interval::exact(exact[exact.len() - 1].clone());
    let mut product = Polynomial::constant(leading.clone());
    for (root, multiplicity) in &guesses {
        product = product.times(&Polynomial::linear(root).power(*multiplicity, bits)?, bits)?;
    }
    if product.as_exact().as_deref() != Some(exact.as_slice()) {
        return unknown("a divisor that does not split into rational linear factors");
    }
    for (root, multiplicity) in guesses {
        *roots.entry(root).or_insert(0) += multiplicity;
    }
    Ok((leading, roots))
}

/// The roots of c*(x - r)^n from its two highest coefficients, or those of a quadratic.
fn guessed_roots(exact: &[Rational]) -> Vec<(Rational, u32)> {
    let degree = exact.len() - 1;
    let leading = &exact[degree];
    let center = -&exact[degree - 1] / (leading * Rational::from_integer((degree as i64).into()));
    if degree == 2 {
        // Half the distance of the roots, squared: center^2 - product of the roots.
        let square = &center * &center - &exact[0] / leading;
        if square.is_positive()
            && let Ok(half) = super::functions::root(&square, 2, 8)
            && let Some(half) = half.as_exact()
        {
            return vec![(&center - half, 1), (&center + half, 1)];
        }
    }
    vec![(center, degree as u32)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(a.into(), b.into())
    }

    fn polynomial(coefficients: &[i64]) -> Polynomial {
        Polynomial::new(coefficients.iter().map(|&c| Interval::integer(c)).collect())
    }

    #[test]
    fn reduction_finds_cancelled_poles() {
        let x = Fraction::variable();
        let one = x.times(&x.reciprocal(64).unwrap().unwrap(), 64).unwrap();
        assert_eq!(one.poles.len(), 1);
        let reduced = one.reduced(64).unwrap();
        assert_eq!(reduced, Fraction::constant(Interval::integer(1)));
    }

    #[test]
    fn divisors_split_or_are_refused() {
        let quadratic = Fraction::polynomial(polynomial(&[0, 6, -5, 1]));
        let inverse = quadratic.reciprocal(64).unwrap().unwrap();
        assert_eq!(
            inverse.poles.into_iter().collect::<Vec<_>>(),
            vec![(ratio(0, 1), 1), (ratio(2, 1), 1), (ratio(3, 1), 1)]
        );
        assert!(
            Fraction::polynomial(polynomial(&[1, 0, 1]))
                .reciprocal(64)
                .is_err()
        );
        assert_eq!(
            Fraction::polynomial(polynomial(&[])).reciprocal(64),
            Ok(None)
        );
    }

    proptest! {
        #[test]
        fn operations_commute_with_values(
            a in proptest::collection::vec(-9_i64..9, 0..5),
            b in proptest::collection::vec(-9_i64..9, 0..5),
            x in -9_i64..9,
        ) {
            let (p, q, x) = (polynomial(&a), polynomial(&b), Interval::exact(ratio(x, 7)));
            let (u, v) = (p.at(&x, 64), q.at(&x, 64));
            prop_assert_eq!(p.plus(&q, 64).at(&x, 64), u.plus(&v, 64));
            prop_assert_eq!(p.times(&q, 64).unwrap().at(&x, 64), u.times(&v, 64));
            prop_assert_eq!(p.compose(&q, 64).unwrap().at(&x, 64), p.at(&v, 64));
            prop_assert_eq!(p.antiderivative(64).derivative(64), p);
        }
    }
}
