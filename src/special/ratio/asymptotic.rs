//! The expansion of `Gamma(x)/Gamma(y)` for large arguments (DLMF 5.11.14), with its remainder.
//!
//! **Theorem.** Let X > 0, 0 < beta <= 1, p = 1 - beta, w = X - p/2 > 0, and c_k the coefficients of
//! `((t/2)/sinh(t/2))^p = c_0 + c_1 t^2 + c_2 t^4 + ...`. Then for every n
//!
//! ```text
//! Gamma(X)/Gamma(X + beta) = w^-beta (sum over k < n of T_k + R_n),   T_k = c_k (beta)_{2k} w^-2k,
//! ```
//!
//! where R_n lies between 0 and T_n: it has the sign of the first term left out and is no larger.
//!
//! Proof. With x = e^-t in Euler's integral (DLMF 5.12.1), and 1 - e^-t = 2 e^(-t/2) sinh(t/2),
//! `Gamma(X)/Gamma(X+beta) = 1/Gamma(beta) * integral over t > 0 of e^(-w t) t^(beta-1) f(t^2)`, where
//! `f(t^2) = ((t/2)/sinh(t/2))^p`. By the product of sinh (DLMF 4.36.1), f(s) is the product over n >= 1 of
//! `(1 + s/(2 pi n)^2)^-p`. The derivatives of each factor alternate in sign on s >= 0, hence those of the
//! product do (Leibniz; the product converges with its derivatives). So in Taylor's formula
//! `f(s) = sum over k < n of c_k s^k + f^(n)(xi) s^n/n!` the last term has the sign of c_n and, as |f^(n)| falls,
//! is at most |c_n| s^n. Integrate: `integral of e^(-w t) t^(beta-1+2k) = Gamma(beta) (beta)_{2k} w^(-beta-2k)`. QED.
//!
//! **Coefficients.** With b_j = B_2j/(2j)!: 2k c_k = -p (b_1 c_{k-1} + ... + b_k c_0), from the logarithmic
//! derivative and the series of the hyperbolic cotangent (DLMF 4.19.6), and
//! (2j+1) b_j = -(b_1 b_{j-1} + ... + b_{j-1} b_1), b_1 = 1/12 (DLMF 24.14.2). All terms of each sum have one sign.
//!
//! **Any x, y.** Both are raised by integers to X and X + beta, the product of the factors passed over is
//! taken out (DLMF 5.5.1). The terms fall until about e^(-2 pi w): with w > P/8 that is below 2^-P, P
//! the bits worked with.

use super::product::rising;
use super::{ceil, guarded, positive, product_cost};
use crate::number::{DomainError, Interval};
use rug::{Integer, Rational};

/// No more factors than this are passed over, as in an expansion for large arguments they should not be.
const MOST_STEPS: u32 = 1 << 12;

/// How far the two arguments are raised.
struct Raised {
    x_steps: u64,
    y_steps: u64,
    /// X and beta of the theorem.
    first: Rational,
    beta: Rational,
}

fn raise(x: &Rational, y: &Rational, precision: u32) -> Option<Raised> {
    if !positive(x, y) {
        return None;
    }
    // X = x + i and Y = y + j with Y - X in (0, 1], X >= the least argument, i, j >= 0.
    let least = Rational::from((precision + 40) / 8 + 2);
    let apart = ceil(&Rational::from(y - x)) - 1u32;
    let x_steps = ceil(&Rational::from(&least - x))
        .max(apart.clone())
        .max(Integer::new());
    let y_steps = Integer::from(&x_steps - &apart);
    let steps = |n: &Integer| n.to_u64().filter(|n| *n <= u64::from(MOST_STEPS));
    let first = Rational::from(x + &x_steps);
    let beta = Rational::from(y + &y_steps) - &first;
    Some(Raised {
        x_steps: steps(&x_steps)?,
        y_steps: steps(&y_steps)?,
        first,
        beta,
    })
}

pub(super) fn cost(x: &Rational, y: &Rational, precision: u32) -> Option<f64> {
    let raised = raise(x, y, precision)?;
    let each = product_cost(precision);
    let steps = (raised.x_steps + raised.y_steps) as f64;
    // Two sums of k products for the k-th term, and a power at the end.
    let sums = terms(raised.first.to_f64(), precision.into()).powi(2) * 8.0 * each;
    Some(10_000.0 + 10.0 * f64::from(precision) + steps * each + sums)
}

/// About how many terms there are: T_k is about (k/(pi e w))^2k in size.
fn terms(w: f64, bits: f64) -> f64 {
    use std::f64::consts::{E, PI};
    (0..4).fold(1.0, |n, _| {
        1.0 + bits / (2.0 * (PI * E * w / n).log2()).max(0.5)
    })
}

pub(super) fn ratio(x: &Rational, y: &Rational, precision: u32) -> Result<Interval, DomainError> {
    let raised = raise(x, y, precision).ok_or(DomainError::Possible)?;
    let working = guarded(precision, &[x, y]);
    let above = rising(y, raised.y_steps, working)?;
    let below = rising(x, raised.x_steps, working)?;
    let value = large(&raised.first, &raised.beta, working)?;
    Ok(value.mul(&above).div(&below)?.with_precision(precision))
}

/// The theorem's left side.
///
/// # Errors
/// `Possible` where the terms stop falling before they are below the precision.
fn large(first: &Rational, beta: &Rational, working: u32) -> Result<Interval, DomainError> {
    let p = 1u32 - Rational::from(beta);
    let w = first - Rational::from(&p / 2u32);
    let inverse_square = Interval::from_rational(&Rational::from(w.square_ref()).recip(), working);
    let power = Interval::from_rational(&w, working).pow_rational(&Rational::from(-beta))?;
    let mut coefficients = Coefficients::new(&p, working);
    let mut scale = Interval::from_i64(1, working);
    let mut sum = scale.clone();
    for k in 1..working {
        let two = Rational::from(beta + (2 * k - 2));
        let pair = Rational::from(&two + 1u32) * two;
        scale = scale
            .mul(&Interval::from_rational(&pair, working))
            .mul(&inverse_square);
        let term = coefficients.next().mul(&scale);
        let end = term.abs();
        if end.high().get_exp().is_none_or(|e| e < -(working as i32)) {
            let rest = term.hull(&Interval::from_i64(0, working));
            return Ok(sum.add(&rest).mul(&power));
        }
        sum = sum.add(&term);
    }
    Err(DomainError::Possible)
}

/// c_1, c_2, ...
struct Coefficients {
    minus_p: Interval,
    bernoulli: Vec<Interval>,
    found: Vec<Interval>,
}

impl Coefficients {
    fn new(p: &Rational, working: u32) -> Coefficients {
        Coefficients {
            minus_p: Interval::from_rational(p, working).neg(),
            bernoulli: Vec::new(),
            found: vec![Interval::from_i64(1, working)],
        }
    }

    fn next(&mut self) -> Interval {
        let k = self.found.len();
        let working = self.minus_p.precision();
        let next = match k {
            1 => Interval::from_rational(&Rational::from((1, 12)), working),
            _ => over(
                &convolution(&self.bernoulli, &self.bernoulli).neg(),
                2 * k + 1,
            ),
        };
        self.bernoulli.push(next);
        let sum = convolution(&self.bernoulli, &self.found).mul(&self.minus_p);
        let value = over(&sum, 2 * k);
        self.found.push(value.clone());
        value
    }
}

/// x_0 y_n + x_1 y_{n-1} + ... + x_n y_0, n the last index.
fn convolution(x: &[Interval], y: &[Interval]) -> Interval {
    let mut pairs = x.iter().zip(y.iter().rev());
    let Some((a, b)) = pairs.next() else {
        return Interval::from_i64(0, 2);
    };
    pairs.fold(a.mul(b), |sum, (a, b)| sum.add(&a.mul(b)))
}

/// x/n for n > 0.
fn over(x: &Interval, n: usize) -> Interval {
    let reciprocal = Rational::from((1, n));
    x.mul(&Interval::from_rational(&reciprocal, x.precision()))
}
