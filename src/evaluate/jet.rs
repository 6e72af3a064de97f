//! Taylor arithmetic: a jet is the list of Taylor coefficients f^(k)(x)/k! of a function, as intervals.
//!
//! Computed at a point they are the coefficients there; computed over an interval X, coefficient n holds
//! f^(n)(y)/n! for every y in X, which is Lagrange's remainder. Coefficients that are left off are 0, so
//! that polynomials stay short. The recurrences are those of automatic differentiation (Moore, Kearfott and
//! Cloud, Introduction to Interval Analysis, 9.3).
//!
//! An error `Certain` is proved: the operation has a value nowhere on the interval. It comes from the
//! leading coefficients only, which hold the functions' values.

use crate::number::{DomainError, Interval};

/// Taylor coefficients, the value first; never empty.
pub(super) type Jet = Vec<Interval>;

fn is_zero(x: &Interval) -> bool {
    x.is_point() && x.contains_zero()
}

fn small(value: usize, precision: u32) -> Interval {
    Interval::from_i64(i64::try_from(value).unwrap_or(i64::MAX), precision)
}

/// The sum over j = 1..=k of `f(j) * a[j] * b[k-j]`.
fn convolve(
    a: &[Interval],
    b: &[Interval],
    k: usize,
    zero: &Interval,
    f: impl Fn(usize) -> Option<Interval>,
) -> Interval {
    let mut sum = zero.clone();
    for (j, left) in a.iter().enumerate().take(k + 1).skip(1) {
        let Some(right) = b.get(k - j) else { continue };
        if is_zero(left) || is_zero(right) {
            continue;
        }
        let product = left.mul(right);
        sum = sum.add(&match f(j) {
            Some(factor) => product.mul(&factor),
            None => product,
        });
    }
    sum
}

/// Jets up to one order, in one precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jets {
    /// The last coefficient's index.
    pub order: usize,
    pub precision: u32,
}

impl Jets {
    fn zero(self) -> Interval {
        Interval::from_i64(0, self.precision)
    }

    pub fn constant(self, value: &Interval) -> Jet {
        vec![value.with_precision(self.precision)]
    }

    /// The variable itself at `place`.
    pub fn variable(self, place: &Interval) -> Jet {
        vec![
            place.with_precision(self.precision),
            Interval::from_i64(1, self.precision),
        ]
    }

    pub fn add(self, a: &Jet, b: &Jet) -> Jet {
        let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
        let mut sum = long.clone();
        for (total, term) in sum.iter_mut().zip(short) {
            *total = total.add(term);
        }
        sum
    }

    pub fn negate(self, a: &Jet) -> Jet {
        a.iter().map(Interval::neg).collect()
    }

    pub fn multiply(self, a: &Jet, b: &Jet) -> Jet {
        let length = (a.len() + b.len() - 1).min(self.order + 1);
        let mut product = vec![self.zero(); length];
        for (i, left) in a.iter().enumerate().filter(|(_, left)| !is_zero(left)) {
            for (total, right) in product.iter_mut().skip(i).zip(b) {
                *total = total.add(&left.mul(right));
            }
        }
        product
    }

    pub fn divide(self, a: &Jet, b: &Jet) -> Result<Jet, DomainError> {
        let first = a[0].div(&b[0])?;
        let length = if b.len() == 1 {
            a.len()
        } else {
            self.order + 1
        };
        let mut quotient = vec![first];
        for k in 1..length {
            let known = convolve(b, &quotient, k, &self.zero(), |_| None);
            let rest = match a.get(k) {
                Some(above) => above.sub(&known),
                None => known.neg(),
            };
            quotient.push(rest.div(&b[0])?);
        }
        Ok(quotient)
    }

    /// a^n
    pub fn power(self, a: &Jet, n: i64) -> Result<Jet, DomainError> {
        if a.len() == 1 || n == 0 {
            return Ok(vec![a[0].powi(n)?]);
        }
        if !a[0].contains_zero() {
            let exponent = Interval::from_i64(n, self.precision);
            return self.by_recurrence(a, a[0].powi(n)?, &exponent);
        }
        if n < 0 {
            return Err(match a[0].powi(n) {
                Err(error) => error,
                Ok(_) => DomainError::Possible,
            });
        }
        let (mut base, mut rest) = (a.clone(), n);
        let mut product = vec![Interval::from_i64(1, self.precision)];
        while rest > 0 {
            if rest & 1 == 1 {
                product = self.multiply(&product, &base);
            }
            rest >>= 1;
            if rest > 0 {
                base = self.multiply(&base, &base);
            }
        }
        Ok(product)
    }

    /// a^s for a > 0.
    pub fn real_power(self, a: &Jet, s: &Interval) -> Result<Jet, DomainError> {
        let first = a[0].pow(s)?;
        if *a[0].low() <= 0 {
            return Err(DomainError::Possible);
        }
        self.by_recurrence(a, first, s)
    }

    /// From a*(a^s)' = s*a'*a^s: k a_0 c_k = sum over j of ((s+1) j - k) a_j c_{k-j}.
    fn by_recurrence(self, a: &Jet, first: Interval, s: &Interval) -> Result<Jet, DomainError> {
        let one_more = s.add(&Interval::from_i64(1, self.precision));
        let mut power = vec![first];
        if a.len() == 1 {
            return Ok(power);
        }
        for k in 1..=self.order {
            let index = small(k, self.precision);
            let sum = convolve(a, &power, k, &self.zero(), |j| {
                Some(one_more.mul(&small(j, self.precision)).sub(&index))
            });
            power.push(sum.div(&a[0].mul(&index))?);
        }
        Ok(power)
    }

    pub fn exp(self, a: &Jet) -> Result<Jet, DomainError> {
        let mut result = vec![a[0].exp()];
        if a.len() == 1 {
            return Ok(result);
        }
        let slope = self.scaled_slope(a);
        for k in 1..=self.order {
            let sum = convolve(&slope, &result, k, &self.zero(), |_| None);
            result.push(sum.div(&small(k, self.precision))?);
        }
        Ok(result)
    }

    /// j a_j
    fn scaled_slope(self, a: &Jet) -> Jet {
        let scaled = a.iter().enumerate();
        scaled
            .map(|(j, x)| x.mul(&small(j, self.precision)))
            .collect()
    }

    pub fn ln(self, a: &Jet) -> Result<Jet, DomainError> {
        let mut result = vec![a[0].ln()?];
        if a.len() == 1 {
            return Ok(result);
        }
        for k in 1..=self.order {
            // k a_0 l_k = k a_k - sum over j < k of j l_j a_{k-j}, as a sum over i = k-j >= 1.
            let sum = convolve(a, &result, k, &self.zero(), |i| {
                Some(small(k - i, self.precision))
            });
            let known = sum.div(&small(k, self.precision))?;
            let rest = match a.get(k) {
                Some(above) => above.sub(&known),
                None => known.neg(),
            };
            result.push(rest.div(&a[0])?);
        }
        Ok(result)
    }

    /// sin and cos, which need each other.
    pub fn sine_and_cosine(self, a: &Jet) -> Result<(Jet, Jet), DomainError> {
        let (mut sine, mut cosine) = (vec![a[0].sin()], vec![a[0].cos()]);
        if a.len() == 1 {
            return Ok((sine, cosine));
        }
        let slope = self.scaled_slope(a);
        for k in 1..=self.order {
            let index = small(k, self.precision);
            let up = convolve(&slope, &cosine, k, &self.zero(), |_| None).div(&index)?;
            let down = convolve(&slope, &sine, k, &self.zero(), |_| None).div(&index)?;
            sine.push(up);
            cosine.push(down.neg());
        }
        Ok((sine, cosine))
    }
}
