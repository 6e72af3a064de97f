//! Plain polynomials in one variable with enclosed coefficients.

use super::interval::Interval;
use super::{Unknown, unknown};
use crate::formula::Rational;
use std::ops::Add;

/// No polynomial of a higher degree is made.
pub(super) const DEGREE_CAP: usize = 1500;

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

    pub fn is_exact(&self) -> bool {
        self.0.iter().all(|c| c.as_exact().is_some())
    }

    pub fn scaled(&self, by: &Interval) -> Polynomial {
        Polynomial::new(self.0.iter().map(|c| c * by).collect())
    }

    /// # Errors
    /// A degree above the cap.
    pub fn times(&self, other: &Polynomial) -> Result<Polynomial, Unknown> {
        let length = (self.length() + other.length()).saturating_sub(1);
        if length > DEGREE_CAP {
            return unknown("a polynomial of too high a degree");
        }
        let mut product = vec![Interval::integer(0); length];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = &product[i + j] + &(a * b);
            }
        }
        Ok(Polynomial::new(product))
    }

    /// # Errors
    /// A degree above the cap.
    pub fn power(&self, exponent: u32) -> Result<Polynomial, Unknown> {
        if let [] | [_] = self.0.as_slice() {
            let base = self.0.first().cloned().unwrap_or(Interval::integer(0));
            return Ok(Polynomial::constant(base.power(exponent)));
        }
        let mut result = Polynomial::constant(Interval::integer(1));
        for _ in 0..exponent {
            result = result.times(self)?;
        }
        Ok(result)
    }

    /// The value by Horner's rule.
    pub fn at(&self, x: &Interval) -> Interval {
        let step = |sum: Interval, c: &Interval| &(&sum * x) + c;
        self.0.iter().rev().fold(Interval::integer(0), step)
    }

    /// Quotient and remainder by x - root (Ruffini): the remainder is the value at the root.
    pub fn divide(&self, root: &Rational) -> (Polynomial, Interval) {
        let root = Interval::exact(root.clone());
        let mut carried = Interval::integer(0);
        let mut quotient = Vec::with_capacity(self.length());
        for c in self.0.iter().rev() {
            carried = &(&carried * &root) + c;
            quotient.push(carried.clone());
        }
        quotient.pop();
        quotient.reverse();
        (Polynomial::new(quotient), carried)
    }

    /// The first coefficients of p(x + a): the remainders of repeated division by x - a.
    pub fn taylor(&self, a: &Rational, count: usize) -> Vec<Interval> {
        let mut rest = self.clone();
        let mut series = Vec::with_capacity(count);
        for _ in 0..count {
            let (quotient, coefficient) = rest.divide(a);
            series.push(coefficient);
            rest = quotient;
        }
        series
    }

    /// The antiderivative that is zero at 0, term by term (no exponent is -1).
    pub fn antiderivative(&self) -> Polynomial {
        let share = |i: usize| Interval::exact(Rational::new(1.into(), (i + 1).into()));
        let terms = self.0.iter().enumerate().map(|(i, c)| c * &share(i));
        Polynomial::new(std::iter::once(Interval::integer(0)).chain(terms).collect())
    }
}

impl Add for &Polynomial {
    type Output = Polynomial;

    fn add(self, other: &Polynomial) -> Polynomial {
        let (longer, shorter) = if self.length() >= other.length() {
            (self, other)
        } else {
            (other, self)
        };
        let mut sum = longer.0.clone();
        for (place, c) in sum.iter_mut().zip(&shorter.0) {
            *place = &*place + c;
        }
        Polynomial::new(sum)
    }
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

    proptest! {
        #[test]
        fn operations_commute_with_values(
            a in proptest::collection::vec(-9_i64..9, 0..5),
            b in proptest::collection::vec(-9_i64..9, 0..5),
            x in -9_i64..9,
        ) {
            let (p, q, x) = (polynomial(&a), polynomial(&b), Interval::exact(ratio(x, 7)));
            let (u, v) = (p.at(&x), q.at(&x));
            prop_assert_eq!((&p + &q).at(&x), &u + &v);
            prop_assert_eq!(p.times(&q).unwrap().at(&x), &u * &v);
        }
    }

    #[test]
    fn known_results() {
        let p = polynomial(&[2, -3, 1]);
        assert_eq!(
            p.divide(&ratio(2, 1)),
            (polynomial(&[-1, 1]), Interval::integer(0))
        );
        assert_eq!(
            p.divide(&ratio(3, 1)),
            (polynomial(&[0, 1]), Interval::integer(2))
        );
        // (x+4)^2 - 3(x+4) + 2 = x^2 + 5x + 6
        let moved = Polynomial::new(p.taylor(&ratio(4, 1), 3));
        assert_eq!(moved, polynomial(&[6, 5, 1]));
        assert_eq!(polynomial(&[1, 1]).power(3), Ok(polynomial(&[1, 3, 3, 1])));
        assert_eq!(polynomial(&[5]).power(2), Ok(polynomial(&[25])));
        assert_eq!(polynomial(&[]).power(0), Ok(polynomial(&[1])));
        assert_eq!(
            polynomial(&[1, 4, 9]).antiderivative(),
            polynomial(&[0, 1, 2, 3])
        );
        assert_eq!(polynomial(&[1, 2, 0, 0]).length(), 2);
        assert_eq!(
            &polynomial(&[1, 2]) + &polynomial(&[0, -2]),
            polynomial(&[1])
        );
        assert_eq!(Polynomial::linear(&ratio(7, 1)), polynomial(&[-7, 1]));
        assert_eq!(p.scaled(&Interval::integer(-2)), polynomial(&[-4, 6, -2]));
    }

    #[test]
    fn degrees_have_a_cap() {
        let mut long = vec![0; DEGREE_CAP - 1];
        long[DEGREE_CAP - 2] = 1;
        let long = polynomial(&long);
        assert!(long.times(&polynomial(&[0, 1])).is_ok());
        assert!(long.times(&polynomial(&[0, 0, 1])).is_err());
    }
}
