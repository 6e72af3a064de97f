//! Rational functions of one variable over Q, as a numerator times powers of linear factors:
//!
//! ```text
//! numerator(x) * (x - r_1)^e_1 * ... * (x - r_n)^e_n,    r_i distinct rationals, e_i integers, not 0
//! ```
//!
//! Powers such as x^(l-1) (1-x)^(m-l) stay unexpanded until a sum or an integral needs them, so that
//! r^(k-1)/r^2 costs nothing. Sizes are estimated before every power (GMP aborts on huge ones).

use super::Failure;
use crate::formula::Budget;
use rug::Rational;
use rug::ops::Pow;
use std::cmp::Ordering;

/// No polynomial is expanded beyond this degree.
const MAX_DEGREE: u64 = 20_000;
/// No polynomial is expanded whose coefficients would take more bits together.
const MAX_POLYNOMIAL_BITS: u64 = 1 << 28;
/// No number grows beyond so many bits.
pub(super) const MAX_BITS: u64 = 1 << 22;

/// A polynomial, lowest coefficient first, without leading zeros; the empty one is 0.
pub(super) type Polynomial = Vec<Rational>;

/// A rational function of one variable.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fraction {
    pub numerator: Polynomial,
    /// Sorted by root.
    pub factors: Vec<(Rational, i64)>,
}

/// The bits of numerator and denominator together.
pub(super) fn bits(value: &Rational) -> u64 {
    u64::from(value.numer().significant_bits()) + u64::from(value.denom().significant_bits())
}

/// `base^exponent` when its size is allowed.
///
/// # Errors
/// [`Failure::TooLarge`], and [`Failure::Exhausted`]. The base must not be 0 under a negative exponent.
pub(super) fn power(base: &Rational, exponent: i64, budget: &Budget) -> Result<Rational, Failure> {
    let unit = *base.denom() == 1 && matches!(base.numer().to_i32(), Some(-1..=1));
    let size = if unit {
        1
    } else {
        bits(base).saturating_mul(exponent.unsigned_abs())
    };
    if size > MAX_BITS {
        return Err(Failure::TooLarge("a power of a number".into()));
    }
    budget.spend(1 + size / 64)?;
    if unit {
        let odd_negative = *base == -1 && exponent % 2 != 0;
        return Ok(match exponent {
            0 => Rational::from(1),
            _ if odd_negative => Rational::from(-1),
            _ => base.clone().abs(),
        });
    }
    let exponent =
        i32::try_from(exponent).map_err(|_| Failure::TooLarge("a power of a number".into()))?;
    Ok(base.clone().pow(exponent))
}

impl Fraction {
    /// A constant.
    pub fn constant(value: Rational) -> Fraction {
        let numerator = if value == 0 { vec![] } else { vec![value] };
        Fraction {
            numerator,
            factors: vec![],
        }
    }

    /// The variable itself.
    pub fn variable() -> Fraction {
        Fraction::linear_power(Rational::new(), 1)
    }

    /// `(x - root)^exponent`
    pub fn linear_power(root: Rational, exponent: i64) -> Fraction {
        let factors = match exponent {
            0 => vec![],
            _ => vec![(root, exponent)],
        };
        Fraction {
            numerator: vec![Rational::from(1)],
            factors,
        }
    }

    /// Whether it is 0 everywhere.
    pub fn is_zero(&self) -> bool {
        self.numerator.is_empty()
    }

    /// Its value, when it is the same everywhere as written.
    pub fn as_constant(&self) -> Option<Rational> {
        match (&self.numerator[..], &self.factors[..]) {
            ([], _) => Some(Rational::new()),
            ([value], []) => Some(value.clone()),
            _ => None,
        }
    }

    /// The degree at infinity; `None` for 0.
    pub fn degree(&self) -> Option<i64> {
        let top = self.numerator.len().checked_sub(1)?;
        let top = i64::try_from(top).ok()?;
        let exponents = self.factors.iter().map(|(_, e)| *e);
        Some(exponents.fold(top, i64::saturating_add))
    }

    /// The exponent of `x - root` among the factors.
    pub fn exponent_at(&self, root: &Rational) -> i64 {
        match self.factors.binary_search_by(|(r, _)| r.cmp(root)) {
            Ok(index) => self.factors[index].1,
            Err(_) => 0,
        }
    }

    /// A constant multiple.
    pub fn scale(mut self, by: &Rational) -> Fraction {
        if *by == 0 {
            return Fraction::constant(Rational::new());
        }
        for coefficient in &mut self.numerator {
            *coefficient *= by;
        }
        self
    }

    /// The product.
    pub fn multiply(&self, other: &Fraction, budget: &Budget) -> Result<Fraction, Failure> {
        let numerator = multiply(&self.numerator, &other.numerator, budget)?;
        if numerator.is_empty() {
            return Ok(Fraction::constant(Rational::new()));
        }
        let mut factors = self.factors.clone();
        for (root, exponent) in &other.factors {
            change_exponent(&mut factors, root, *exponent)?;
        }
        Ok(Fraction { numerator, factors })
    }

    /// The sum, over the common factors.
    pub fn add(&self, other: &Fraction, budget: &Budget) -> Result<Fraction, Failure> {
        if self.is_zero() {
            return Ok(other.clone());
        }
        if other.is_zero() {
            return Ok(self.clone());
        }
        let mut common: Vec<(Rational, i64)> = vec![];
        for (root, exponent) in &self.factors {
            let least = (*exponent).min(other.exponent_at(root));
            change_exponent(&mut common, root, least)?;
        }
        for (root, exponent) in &other.factors {
            if self.exponent_at(root) == 0 && *exponent < 0 {
                change_exponent(&mut common, root, *exponent)?;
            }
        }
        let mut numerator = self.over(&common, budget)?;
        let right = other.over(&common, budget)?;
        add_assign(&mut numerator, &right);
        let factors = if numerator.is_empty() { vec![] } else { common };
        Ok(Fraction { numerator, factors }.with_linear_numerator_split())
    }

    /// The polynomial `self / common`, where the exponents of `common` are at most those here.
    fn over(&self, common: &[(Rational, i64)], budget: &Budget) -> Result<Polynomial, Failure> {
        let mut rest = self.factors.clone();
        for (root, exponent) in common {
            change_exponent(&mut rest, root, exponent.saturating_neg())?;
        }
        expand(&self.numerator, &rest, budget)
    }

    /// A numerator of degree 1 becomes a factor, so that powers of it stay unexpanded.
    fn with_linear_numerator_split(self) -> Fraction {
        match &self.numerator[..] {
            [constant, slope] => {
                let root = -Rational::from(constant / slope);
                let mut factors = self.factors;
                let slope = slope.clone();
                // Exponents grow by one only, which the checked sum allows or the cap refuses later.
                match change_exponent(&mut factors, &root, 1) {
                    Ok(()) => Fraction {
                        numerator: vec![slope],
                        factors,
                    },
                    Err(_) => Fraction {
                        numerator: self.numerator,
                        factors,
                    },
                }
            }
            _ => self,
        }
    }

    /// The power with an integer exponent; `x^0` is 1.
    ///
    /// # Errors
    /// [`Failure::Unsupported`] when a negative power needs linear factors that are not found.
    pub fn power(&self, exponent: i64, budget: &Budget) -> Result<Fraction, Failure> {
        if exponent == 0 {
            return Ok(Fraction::constant(Rational::from(1)));
        }
        let split = self.split(budget)?;
        let numerator = match &split.numerator[..] {
            [] => return Ok(split),
            [constant] => vec![power(constant, exponent, budget)?],
            many if exponent > 0 => polynomial_power(many, exponent, budget)?,
            _ => {
                return Err(Failure::Unsupported(
                    "a denominator without rational roots".into(),
                ));
            }
        };
        let mut factors = split.factors;
        for (_, e) in &mut factors {
            *e = e
                .checked_mul(exponent)
                .ok_or_else(|| Failure::TooLarge("an exponent".into()))?;
        }
        Ok(Fraction { numerator, factors })
    }

    /// The same function with the linear factors of the numerator that can be found pulled out:
    /// multiple ones by greatest common divisors with the derivative, simple ones from what is left
    /// when it is linear or a quadratic with a square discriminant.
    pub fn split(&self, budget: &Budget) -> Result<Fraction, Failure> {
        if self.numerator.len() < 2 {
            return Ok(self.clone());
        }
        let mut factors = self.factors.clone();
        let zeros = self.numerator.iter().take_while(|c| **c == 0).count();
        let mut rest = self.numerator[zeros..].to_vec();
        change_exponent(&mut factors, &Rational::new(), zeros as i64)?;
        for (root, _) in &self.factors {
            while rest.len() > 1 && evaluate(&rest, root) == 0 {
                budget.spend(rest.len() as u64)?;
                rest = divide_linear(&rest, root).0;
                change_exponent(&mut factors, root, 1)?;
            }
        }
        let roots = if rest.len() > 64 {
            vec![]
        } else {
            rational_roots(&rest, budget)?
        };
        for root in roots {
            while rest.len() > 1 {
                let (quotient, remainder) = divide_linear(&rest, &root);
                if remainder != 0 {
                    break;
                }
                rest = quotient;
                change_exponent(&mut factors, &root, 1)?;
            }
        }
        Ok(Fraction {
            numerator: rest,
            factors,
        })
    }

    /// The numerator times the factors of positive exponent.
    pub fn expanded_numerator(&self, budget: &Budget) -> Result<Polynomial, Failure> {
        let positive: Vec<_> = self
            .factors
            .iter()
            .filter(|(_, e)| *e > 0)
            .cloned()
            .collect();
        expand(&self.numerator, &positive, budget)
    }

    /// The value at `x`; `None` at a pole.
    pub fn at(&self, x: &Rational, budget: &Budget) -> Result<Option<Rational>, Failure> {
        budget.spend(1 + self.numerator.len() as u64)?;
        let mut value = evaluate(&self.numerator, x);
        for (root, exponent) in &self.factors {
            let difference = Rational::from(x - root);
            if difference == 0 && *exponent < 0 {
                return Ok(None);
            }
            value *= power(&difference, *exponent, budget)?;
        }
        Ok(Some(value))
    }

    /// The derivative.
    pub fn derivative(&self, budget: &Budget) -> Result<Fraction, Failure> {
        let mut sum = Fraction {
            numerator: derivative(&self.numerator),
            factors: self.factors.clone(),
        };
        if sum.is_zero() {
            sum.factors.clear();
        }
        for (root, exponent) in &self.factors {
            let mut part = self.clone().scale(&Rational::from(*exponent));
            change_exponent(&mut part.factors, root, -1)?;
            sum = sum.add(&part, budget)?;
        }
        Ok(sum)
    }
}

/// Adds `by` to the exponent of `root`.
fn change_exponent(
    factors: &mut Vec<(Rational, i64)>,
    root: &Rational,
    by: i64,
) -> Result<(), Failure> {
    if by == 0 {
        return Ok(());
    }
    match factors.binary_search_by(|(r, _)| r.cmp(root)) {
        Ok(index) => {
            let sum = factors[index].1.checked_add(by);
            factors[index].1 = sum.ok_or_else(|| Failure::TooLarge("an exponent".into()))?;
            if factors[index].1 == 0 {
                factors.remove(index);
            }
        }
        Err(index) => factors.insert(index, (root.clone(), by)),
    }
    Ok(())
}

/// Refuses polynomials too large to write out, and spends what writing them costs.
fn allow(degree: u64, coefficient_bits: u64, budget: &Budget) -> Result<(), Failure> {
    let total = degree.saturating_mul(coefficient_bits);
    if degree > MAX_DEGREE || total > MAX_POLYNOMIAL_BITS {
        return Err(Failure::TooLarge("a polynomial".into()));
    }
    budget.spend(1 + degree + total / 64)?;
    Ok(())
}

fn largest_bits(polynomial: &[Rational]) -> u64 {
    polynomial.iter().map(bits).max().unwrap_or(0)
}

/// The numerator times linear factors of nonnegative exponent, written out.
fn expand(
    numerator: &[Rational],
    factors: &[(Rational, i64)],
    budget: &Budget,
) -> Result<Polynomial, Failure> {
    let mut product = numerator.to_vec();
    for (root, exponent) in factors {
        let exponent = u64::try_from(*exponent)
            .map_err(|_| Failure::Unsupported("a pole in a polynomial".into()))?;
        if *root == 0 {
            allow(exponent, 1, budget)?;
            let zeros = std::iter::repeat_n(Rational::new(), exponent as usize);
            product.splice(0..0, zeros);
        } else {
            product = multiply(&product, &binomial_power(root, exponent, budget)?, budget)?;
        }
    }
    Ok(product)
}

/// `(x - root)^exponent` by the binomial theorem.
fn binomial_power(root: &Rational, exponent: u64, budget: &Budget) -> Result<Polynomial, Failure> {
    allow(exponent, exponent.saturating_mul(1 + bits(root)), budget)?;
    let minus = Rational::from(-root);
    let mut coefficient = Rational::from(1);
    let mut coefficients = vec![coefficient.clone()];
    for j in 0..exponent {
        coefficient *= &minus;
        coefficient *= Rational::from((exponent - j, j + 1));
        coefficients.push(coefficient.clone());
    }
    coefficients.reverse();
    Ok(coefficients)
}

fn polynomial_power(
    base: &[Rational],
    exponent: i64,
    budget: &Budget,
) -> Result<Polynomial, Failure> {
    let times = exponent.unsigned_abs();
    let degree = times.saturating_mul(base.len() as u64 - 1);
    let size = times.saturating_mul(1 + largest_bits(base));
    allow(degree, size, budget)?;
    let mut result = vec![Rational::from(1)];
    let mut square = base.to_vec();
    let mut rest = times;
    while rest > 0 {
        if rest % 2 == 1 {
            result = multiply(&result, &square, budget)?;
        }
        rest /= 2;
        if rest > 0 {
            square = multiply(&square, &square, budget)?;
        }
    }
    Ok(result)
}

pub(super) fn multiply(
    a: &[Rational],
    b: &[Rational],
    budget: &Budget,
) -> Result<Polynomial, Failure> {
    if a.is_empty() || b.is_empty() {
        return Ok(vec![]);
    }
    if let [constant] = a {
        return Ok(b.iter().map(|c| Rational::from(c * constant)).collect());
    }
    let size = largest_bits(a) + largest_bits(b);
    let products = (a.len() as u64).saturating_mul(b.len() as u64);
    allow((a.len() + b.len()) as u64, size, budget)?;
    budget.spend(products.saturating_mul(1 + size / 64))?;
    let mut product = vec![Rational::new(); a.len() + b.len() - 1];
    for (i, left) in a.iter().enumerate() {
        if *left == 0 {
            continue;
        }
        for (j, right) in b.iter().enumerate() {
            product[i + j] += Rational::from(left * right);
        }
    }
    Ok(product)
}

fn add_assign(sum: &mut Polynomial, other: &[Rational]) {
    if sum.len() < other.len() {
        sum.resize(other.len(), Rational::new());
    }
    for (left, right) in sum.iter_mut().zip(other) {
        *left += right;
    }
    trim(sum);
}

fn trim(polynomial: &mut Polynomial) {
    while polynomial.last().is_some_and(|c| *c == 0) {
        polynomial.pop();
    }
}

/// Horner's rule.
pub(super) fn evaluate(polynomial: &[Rational], x: &Rational) -> Rational {
    let mut value = Rational::new();
    for coefficient in polynomial.iter().rev() {
        value *= x;
        value += coefficient;
    }
    value
}

fn derivative(polynomial: &[Rational]) -> Polynomial {
    let rest = polynomial.iter().enumerate().skip(1);
    rest.map(|(j, c)| Rational::from(c * Rational::from(j)))
        .collect()
}

/// Quotient and remainder of division by `x - root` (synthetic division).
pub(super) fn divide_linear(polynomial: &[Rational], root: &Rational) -> (Polynomial, Rational) {
    let mut quotient = Vec::with_capacity(polynomial.len());
    let mut carry = Rational::new();
    for coefficient in polynomial.iter().rev() {
        carry *= root;
        carry += coefficient;
        quotient.push(carry.clone());
    }
    let remainder = quotient.pop().unwrap_or_default();
    quotient.reverse();
    (quotient, remainder)
}

fn remainder(a: &[Rational], b: &[Rational]) -> Polynomial {
    let mut rest = a.to_vec();
    let Some(leading) = b.last() else {
        return rest;
    };
    while rest.len() >= b.len() {
        let factor = Rational::from(&rest[rest.len() - 1] / leading);
        let shift = rest.len() - b.len();
        for (j, coefficient) in b.iter().enumerate() {
            rest[shift + j] -= Rational::from(coefficient * &factor);
        }
        rest.pop();
        trim(&mut rest);
    }
    rest
}

/// The exact quotient of a division that leaves no remainder.
fn quotient(a: &[Rational], b: &[Rational]) -> Polynomial {
    let mut rest = a.to_vec();
    let mut result = vec![];
    let Some(leading) = b.last() else {
        return rest;
    };
    while rest.len() >= b.len() {
        let factor = Rational::from(&rest[rest.len() - 1] / leading);
        let shift = rest.len() - b.len();
        for (j, coefficient) in b.iter().enumerate() {
            rest[shift + j] -= Rational::from(coefficient * &factor);
        }
        rest.pop();
        result.push(factor);
    }
    result.reverse();
    trim(&mut result);
    result
}

fn greatest_common_divisor(a: &[Rational], b: &[Rational]) -> Polynomial {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    while !b.is_empty() {
        let rest = monic(remainder(&a, &b));
        a = std::mem::replace(&mut b, rest);
    }
    monic(a)
}

fn monic(mut polynomial: Polynomial) -> Polynomial {
    if let Some(leading) = polynomial.last().cloned() {
        for coefficient in &mut polynomial {
            *coefficient /= &leading;
        }
    }
    polynomial
}

/// Rational roots, found through the parts of equal multiplicity (Yun's square-free factors): those
/// parts that are linear or quadratic are solved, others are left alone.
fn rational_roots(polynomial: &[Rational], budget: &Budget) -> Result<Vec<Rational>, Failure> {
    let mut roots = vec![];
    if polynomial.len() < 2 {
        return Ok(roots);
    }
    let degree = polynomial.len() as u64;
    budget.spend(degree.saturating_mul(degree))?;
    // common = gcd(p, p'), part = p/common holds each root once; peeling part against common
    // separates the multiplicities.
    let mut common = greatest_common_divisor(polynomial, &derivative(polynomial));
    let mut part = quotient(polynomial, &common);
    while part.len() > 1 {
        let next = greatest_common_divisor(&part, &common);
        roots.extend(low_degree_roots(&quotient(&part, &next)));
        common = quotient(&common, &next);
        part = next;
    }
    Ok(roots)
}

fn low_degree_roots(polynomial: &[Rational]) -> Vec<Rational> {
    match polynomial {
        [constant, slope] => vec![-Rational::from(constant / slope)],
        [c, b, a] => {
            let square = Rational::from(b * b);
            let product = Rational::from(a * c) * 4u32;
            let Some(root) = square_root(&(square - product)) else {
                return vec![];
            };
            let twice = Rational::from(a * 2u32);
            let first = (Rational::from(-b) + &root) / &twice;
            let second = (Rational::from(-b) - &root) / &twice;
            vec![first, second]
        }
        _ => vec![],
    }
}

/// The square root of a rational square.
pub(super) fn square_root(value: &Rational) -> Option<Rational> {
    let square = value.cmp0() != Ordering::Less
        && value.numer().is_perfect_square()
        && value.denom().is_perfect_square();
    square.then(|| Rational::from((value.numer().clone().sqrt(), value.denom().clone().sqrt())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn q(n: i64, d: i64) -> Rational {
        Rational::from((n, d))
    }

    fn budget() -> Budget {
        Budget::new(1_000_000)
    }

    #[test]
    fn powers_of_expanded_linear_polynomials_are_recognised() {
        let b = budget();
        let line = Fraction::linear_power(q(-1, 2), 1);
        let cube = Fraction {
            numerator: line.power(3, &b).unwrap().expanded_numerator(&b).unwrap(),
            factors: vec![],
        };
        let inverse = cube.power(-1, &b).unwrap();
        assert_eq!(inverse.factors, vec![(q(-1, 2), -3)]);
    }

    #[test]
    fn quadratics_split_over_rational_roots_only() {
        let b = budget();
        let two_roots = Fraction {
            numerator: vec![q(6, 1), q(-5, 1), q(1, 1)],
            factors: vec![],
        };
        let split = two_roots.split(&b).unwrap();
        assert_eq!(split.factors, vec![(q(2, 1), 1), (q(3, 1), 1)]);
        let none = Fraction {
            numerator: vec![q(1, 1), q(0, 1), q(1, 1)],
            factors: vec![],
        };
        assert!(matches!(none.power(-1, &b), Err(Failure::Unsupported(_))));
    }

    #[test]
    fn sums_and_derivatives_agree_with_values() {
        let b = budget();
        let f = Fraction::linear_power(q(0, 1), -2)
            .add(&Fraction::linear_power(q(1, 1), 3), &b)
            .unwrap();
        assert_eq!(f.at(&q(2, 1), &b).unwrap(), Some(q(5, 4)));
        assert_eq!(f.at(&q(0, 1), &b).unwrap(), None);
        let d = f.derivative(&b).unwrap();
        assert_eq!(d.at(&q(2, 1), &b).unwrap(), Some(q(11, 4)));
    }

    #[test]
    fn huge_powers_are_refused() {
        let b = budget();
        assert!(matches!(
            power(&q(2, 1), i64::MAX, &b),
            Err(Failure::TooLarge(_))
        ));
        assert_eq!(power(&q(-1, 1), i64::MAX, &b).unwrap(), -1);
        let sum = Fraction::linear_power(q(0, 1), i64::MAX).add(&Fraction::constant(q(1, 1)), &b);
        assert!(matches!(sum, Err(Failure::TooLarge(_))));
    }
}
