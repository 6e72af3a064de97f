//! Functions of an integral's variable: a polynomial over linear factors with rational roots.
//!
//! A fraction speaks of a formula but for finitely many numbers, which no integral sees. A fraction
//! without variable is a number.

use super::functions::root;
use super::interval::Interval;
use super::polynomial::{DEGREE_CAP, Polynomial};
use super::{Found, Gap, Unknown, unknown};
use crate::formula::Rational;
use num_traits::{Signed, Zero};
use std::collections::BTreeMap;

/// Roots with their multiplicities.
type Roots = BTreeMap<Rational, u32>;

/// `numerator` over the product of (x - root)^multiplicity. It is kept as it was written, common
/// factors included: a root of multiplicity 0 marks where a part of the formula has a pole that
/// another part cancels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fraction {
    pub numerator: Polynomial,
    pub poles: Roots,
}

impl From<Polynomial> for Fraction {
    fn from(numerator: Polynomial) -> Fraction {
        Fraction {
            numerator,
            poles: Roots::new(),
        }
    }
}

impl From<Interval> for Fraction {
    fn from(number: Interval) -> Fraction {
        Polynomial::constant(number).into()
    }
}

impl Fraction {
    /// The variable itself.
    pub fn variable() -> Fraction {
        Polynomial::linear(&Rational::zero()).into()
    }

    /// The number that this is, if nothing in it varies.
    pub fn as_number(&self) -> Option<Interval> {
        match self.as_polynomial()?.coefficients() {
            [] => Some(Interval::integer(0)),
            [number] => Some(number.clone()),
            _ => None,
        }
    }

    /// The numerator, if no part has a pole.
    pub fn as_polynomial(&self) -> Option<&Polynomial> {
        self.poles.is_empty().then_some(&self.numerator)
    }

    pub fn negated(&self) -> Fraction {
        Fraction {
            numerator: self.numerator.scaled(&Interval::integer(-1)),
            poles: self.poles.clone(),
        }
    }

    pub fn times(&self, other: &Fraction) -> Result<Fraction, Unknown> {
        let mut poles = self.poles.clone();
        for (root, multiplicity) in &other.poles {
            *poles.entry(root.clone()).or_insert(0) += multiplicity;
        }
        let numerator = self.numerator.times(&other.numerator)?;
        Ok(Fraction { numerator, poles })
    }

    /// The sum over the least common denominator.
    pub fn plus(&self, other: &Fraction) -> Result<Fraction, Unknown> {
        let mut poles = self.poles.clone();
        for (root, &multiplicity) in &other.poles {
            let entry = poles.entry(root.clone()).or_insert(0);
            *entry = multiplicity.max(*entry);
        }
        let numerator = &self.raised(&poles)? + &other.raised(&poles)?;
        Ok(Fraction { numerator, poles })
    }

    /// The numerator over the larger denominator.
    fn raised(&self, poles: &Roots) -> Result<Polynomial, Unknown> {
        let mut numerator = self.numerator.clone();
        for (root, multiplicity) in poles {
            let own = self.poles.get(root).unwrap_or(&0);
            numerator = numerator.times(&Polynomial::linear(root).power(multiplicity - own)?)?;
        }
        Ok(numerator)
    }

    pub fn power(&self, exponent: u32) -> Result<Fraction, Unknown> {
        let mut poles = self.poles.clone();
        for multiplicity in poles.values_mut() {
            *multiplicity = multiplicity.saturating_mul(exponent);
            if *multiplicity as usize > DEGREE_CAP {
                return unknown("a pole of too high an order");
            }
        }
        let numerator = self.numerator.power(exponent)?;
        Ok(Fraction { numerator, poles })
    }

    /// 1 over this; the zero fraction has no reciprocal anywhere.
    pub fn reciprocal(&self) -> Found<Fraction> {
        if self.numerator.is_zero() {
            return Err(Gap::Undefined);
        }
        let (constant, mut poles) = linear_factors(&self.numerator)?;
        let mut numerator = Polynomial::constant(constant.reciprocal()?);
        for (root, multiplicity) in &self.poles {
            numerator = numerator.times(&Polynomial::linear(root).power(*multiplicity)?)?;
            poles.entry(root.clone()).or_insert(0);
        }
        Ok(Fraction { numerator, poles })
    }

    /// The value at a number that is no pole.
    pub fn at(&self, x: &Rational) -> Result<Interval, Unknown> {
        let mut value = self.numerator.at(&Interval::exact(x.clone()));
        for (root, multiplicity) in &self.poles {
            let distance = Interval::exact(x - root).reciprocal()?;
            value = &value * &distance.power(*multiplicity);
        }
        Ok(value)
    }

    /// The same function in lowest terms: common linear factors divided out.
    ///
    /// # Errors
    /// A numerator that may or may not vanish at a pole.
    pub fn reduced(&self) -> Result<Fraction, Unknown> {
        let mut numerator = self.numerator.clone();
        let mut poles = Roots::new();
        for (root, multiplicity) in &self.poles {
            for left in (1..=*multiplicity).rev() {
                let (quotient, rest) = numerator.divide(root);
                if rest.sign()?.is_ne() {
                    poles.insert(root.clone(), left);
                    break;
                }
                numerator = quotient;
            }
        }
        Ok(Fraction { numerator, poles })
    }

    /// The rational numbers at which the function may change its sign, or the one enclosed root of
    /// a linear numerator.
    pub fn sign_changes(&self) -> Result<Vec<Interval>, Unknown> {
        let mut found: Vec<Interval> = self.poles.keys().cloned().map(Interval::exact).collect();
        match self.numerator.coefficients() {
            [] => {}
            [constant, slope] => found.push(&-constant * &slope.reciprocal()?),
            _ => found.extend(
                linear_factors(&self.numerator)?
                    .1
                    .into_keys()
                    .map(Interval::exact),
            ),
        }
        Ok(found)
    }
}

impl Polynomial {
    /// The function that takes the value `self(inner(x))`, by Horner's rule.
    pub fn of(&self, inner: &Fraction) -> Result<Fraction, Unknown> {
        let mut sum = Fraction::from(Interval::integer(0));
        for c in self.coefficients().iter().rev() {
            sum = sum.times(inner)?.plus(&c.clone().into())?;
        }
        Ok(sum)
    }
}

/// The leading coefficient and the rational roots of a nonzero polynomial that is x^j times the
/// power of a linear factor, or times a quadratic with rational roots. The product is compared with
/// the polynomial, so that a wrong guess is found out.
fn linear_factors(polynomial: &Polynomial) -> Result<(Interval, Roots), Unknown> {
    let all = polynomial.coefficients();
    let low = all.iter().take_while(|c| c.is_zero()).count();
    let mut roots = Roots::new();
    if low > 0 {
        roots.insert(Rational::zero(), low as u32);
    }
    if let [constant] = &all[low..] {
        return Ok((constant.clone(), roots));
    }
    let exact = all[low..].iter().map(|c| c.as_exact().cloned());
    let Some(exact) = exact.collect::<Option<Vec<Rational>>>() else {
        return unknown("a divisor with coefficients that are not rational");
    };
    roots.extend(guessed_roots(&exact));
    let leading = all[all.len() - 1].clone();
    let mut product = Polynomial::constant(leading.clone());
    for (root, multiplicity) in &roots {
        product = product.times(&Polynomial::linear(root).power(*multiplicity)?)?;
    }
    if product != *polynomial {
        return unknown("a divisor that does not split into rational linear factors");
    }
    Ok((leading, roots))
}

/// The roots of c*(x - r)^n from its two highest coefficients, or those of a quadratic.
fn guessed_roots(exact: &[Rational]) -> Vec<(Rational, u32)> {
    let degree = exact.len() - 1;
    let leading = &exact[degree];
    let center = -&exact[degree - 1] / (leading * Rational::from_integer(degree.into()));
    if degree == 2 {
        // Half the distance of the roots, squared: center^2 - product of the roots.
        let square = &center * &center - &exact[0] / leading;
        if square.is_positive()
            && let Ok(half) = root(&square, 2, 8)
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

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(a.into(), b.into())
    }

    fn polynomial(coefficients: &[i64]) -> Polynomial {
        Polynomial::new(coefficients.iter().map(|&c| Interval::integer(c)).collect())
    }

    #[test]
    fn reduction_finds_cancelled_poles() {
        let x = Fraction::variable();
        let one = x.times(&x.reciprocal().unwrap()).unwrap();
        assert_eq!(one.poles.len(), 1);
        let reduced = one.reduced().unwrap();
        assert_eq!(reduced, Fraction::from(Interval::integer(1)));
    }

    #[test]
    fn divisors_split_or_are_refused() {
        let quadratic = Fraction::from(polynomial(&[0, 6, -5, 1]));
        let inverse = quadratic.reciprocal().unwrap();
        assert_eq!(
            inverse.poles.into_iter().collect::<Vec<_>>(),
            vec![(ratio(0, 1), 1), (ratio(2, 1), 1), (ratio(3, 1), 1)]
        );
        // 2x^2 - 6x + 4 = 2(x - 1)(x - 2)
        let twice = Fraction::from(polynomial(&[4, -6, 2]))
            .reciprocal()
            .unwrap();
        assert_eq!(
            twice.poles.into_keys().collect::<Vec<_>>(),
            vec![ratio(1, 1), ratio(2, 1)]
        );
        assert!(Fraction::from(polynomial(&[1, 0, 1])).reciprocal().is_err());
        assert_eq!(
            Fraction::from(polynomial(&[])).reciprocal(),
            Err(Gap::Undefined)
        );
    }

    /// (x - a)/(x - b)
    fn quotient(a: i64, b: i64) -> Fraction {
        let below = Fraction::from(polynomial(&[-b, 1])).reciprocal().unwrap();
        below.times(&polynomial(&[-a, 1]).into()).unwrap()
    }

    #[test]
    fn operations_are_those_of_the_values() {
        let (f, g) = (
            quotient(1, 2),
            quotient(3, 2).times(&quotient(0, 5)).unwrap(),
        );
        // At 7: f = 6/5 and g = 4/5*7/2 = 14/5.
        let at = |f: &Fraction| f.at(&ratio(7, 1)).unwrap().as_exact().cloned();
        for (found, known) in [
            (f.plus(&g), ratio(4, 1)),
            (g.plus(&f.negated()), ratio(8, 5)),
            (f.times(&g), ratio(84, 25)),
            (f.power(3), ratio(216, 125)),
            (f.power(0), ratio(1, 1)),
            (polynomial(&[1, 0, 2]).of(&f), ratio(97, 25)),
            (f.times(&f).unwrap().plus(&f), ratio(66, 25)),
        ] {
            assert_eq!(at(&found.unwrap()), Some(known));
        }
        assert_eq!(at(&f.reciprocal().unwrap()), Some(ratio(5, 6)));
        assert!(f.at(&ratio(2, 1)).is_err());
        let pole = Fraction::variable().reciprocal().unwrap();
        assert!(pole.power(DEGREE_CAP as u32).is_ok());
        assert!(pole.power(DEGREE_CAP as u32 + 1).is_err());
    }

    #[test]
    fn numbers_are_fractions_without_variable() {
        assert_eq!(
            Fraction::from(Interval::integer(3)).as_number(),
            Some(Interval::integer(3))
        );
        assert_eq!(
            Fraction::from(polynomial(&[])).as_number(),
            Some(Interval::integer(0))
        );
        for varying in [Fraction::variable(), quotient(1, 2), quotient(2, 2)] {
            assert_eq!(varying.as_number(), None);
        }
        assert!(Fraction::variable().as_polynomial().is_some());
        assert!(quotient(2, 2).as_polynomial().is_none());
    }

    #[test]
    fn signs_change_at_zeros_and_poles() {
        let found = |f: &Fraction| {
            let mut found = f.sign_changes().unwrap();
            found.sort_by(|a, b| a.low().cmp(b.low()));
            found
        };
        let places = |places: &[i64]| {
            places
                .iter()
                .map(|&n| Interval::integer(n))
                .collect::<Vec<_>>()
        };
        assert_eq!(found(&quotient(1, 2)), places(&[1, 2]));
        assert_eq!(found(&polynomial(&[-4, 0, 1]).into()), places(&[-2, 2]));
        assert_eq!(found(&polynomial(&[0, 0, 2]).into()), places(&[0]));
        assert_eq!(found(&polynomial(&[-8, 12, -6, 1]).into()), places(&[2]));
        assert_eq!(found(&polynomial(&[5]).into()), places(&[]));
        assert_eq!(found(&polynomial(&[]).into()), places(&[]));
        assert!(
            Fraction::from(polynomial(&[-2, 0, 1]))
                .sign_changes()
                .is_err()
        );
    }
}
