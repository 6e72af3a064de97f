//! Euler's integral (DLMF 15.6.1) by a quadrature with a proved remainder:
//!
//! ```text
//! F = C int over [0, 1] of x^(l-1) (1-x)^(m-l) Va/(Va + V x),    C = m!/((l-1)! (m-l)!)
//! ```
//!
//! by Fejér's first rule: the integral over [-1, 1] of the polynomial of degree < n that agrees at the zeros
//! `cos t_j`, `t_j = (2j-1) pi/(2n)`, of T_n. As `int of T_2i = -2/(4 i^2-1)` and the cosines at the zeros are orthogonal
//! (geometric progressions), its weights are `(2/n)(1 - 2 sum of cos(2 i t_j)/(4 i^2-1), 1 <= i <= n/2)`. They are positive, since
//! `2/(4 i^2-1) = 1/(2i-1) - 1/(2i+1)` sum up to less than 1, and their sum is 2.
//!
//! Theorem (remainder). Let g be analytic in the ellipse with foci -1, 1 and half axes a and b, rho = a+b, and
//! |g| <= M there. Then the rule's error is at most `8 M rho^(-n)/(1 - 1/rho)`. Proof. With u = (z + 1/z)/2 the Chebyshev
//! coefficient of T_k is `1/(pi i)` times the integral of `g(u) z^(-k-1)` over |z| = 1, and over |z| = r < rho as well: at
//! most `2 M rho^(-k)` in size. On T_k, k < n, the rule is exact; for k >= n the integral and the rule are each at most
//! 2 in size, by the weights. Sum over k >= n. QED.
//!
//! Here x = (1+u)/2, and with `a = 1 + Va/V` the ellipse has |x| and |1-x| <= (1+a)/2 and the real part of x
//! >= -Va/(2V), so that `|Va/(Va+Vx)| <= 2` and M = C ((1+a)/2)^(m-1), the factor 1/2 of dx included.
//!
//! Domain: `Va > 0`, at most 1024 nodes: m + bits/3 or less. Cost: n^2 steps for the weights.

use super::ShellError;
use super::quantity::{Numbers, Quantity};
use super::sketch::{self, Sketch};
use crate::model::Shell;
use crate::number::Interval;
use rug::{Integer, Rational};

/// The most nodes.
const MOST_NODES: f64 = 1024.0;

/// The most photons: C has about as many bits.
const MOST_PHOTONS: u32 = 1 << 20;

/// Bits for the rounding errors.
const GUARD: u32 = 32;

pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    let numbers = Numbers::new(shell);
    let nodes = nodes(&Sketch::new(shell)?, bits);
    // NaN among them.
    if !(1.0..=MOST_NODES).contains(&nodes) {
        return Err(ShellError::Outside);
    }
    let integral = Integral::new(shell, bits + GUARD)?;
    let function = integral.fejer(nodes as u32)?;
    numbers.by_function(quantities, &function)
}

struct Integral<'a> {
    shell: &'a Shell,
    precision: u32,
    /// C, l-1, m-l
    constant: Integer,
    left: Integer,
    right: Integer,
}

impl Integral<'_> {
    fn new(shell: &Shell, precision: u32) -> Result<Integral<'_>, ShellError> {
        let (l, m) = (shell.position.to_u32(), shell.count.to_u32());
        let (Some(l), Some(m)) = (l, m) else {
            return Err(ShellError::Outside);
        };
        if m > MOST_PHOTONS {
            return Err(ShellError::Outside);
        }
        Ok(Integral {
            shell,
            precision,
            constant: Integer::from(Integer::binomial_u(m, l)) * l,
            left: Integer::from(l - 1),
            right: Integer::from(m - l),
        })
    }

    fn number(&self, value: i64) -> Interval {
        Interval::from_i64(value, self.precision)
    }

    /// The integrand with C and dx = du/2, at x.
    fn integrand(&self, x: &Interval) -> Result<Interval, ShellError> {
        let number = |value: &Rational| Interval::from_rational(value, self.precision);
        let inner = number(&self.shell.inner);
        let volume = inner.add(&number(&self.shell.volume).mul(x));
        let weight = x
            .pow_integer(&self.left)?
            .mul(&self.number(1).sub(x).pow_integer(&self.right)?)
            .mul_integer(&self.constant);
        Ok(weight.mul(&inner).div(&volume.mul_integer(&2.into()))?)
    }

    /// F by n nodes.
    fn fejer(&self, n: u32) -> Result<Interval, ShellError> {
        let right_angle = Interval::pi(self.precision).div_integer(&Integer::from(2 * n))?;
        let turn = 4 * n;
        let cosines: Vec<Interval> = (0..turn)
            .map(|t| right_angle.mul_integer(&Integer::from(t)).cos())
            .collect();
        let mut sum = self.number(0);
        for j in 1..=n {
            let t = 2 * j - 1;
            let x = self
                .number(1)
                .add(&cosines[t as usize])
                .div_integer(&2.into())?;
            let mut weight = self.number(0);
            for i in 1..=n / 2 {
                // i, t < 2^12
                let cosine = &cosines[(2 * i * t % turn) as usize];
                let below = Integer::from(4 * i * i - 1);
                weight = weight.add(&cosine.div_integer(&below)?);
            }
            let weight = self.number(1).sub(&weight.mul_integer(&2.into()));
            sum = sum.add(&weight.mul(&self.integrand(&x)?));
        }
        let sum = sum.mul_integer(&2.into()).div_integer(&n.into())?;
        let error = self.remainder(n)?;
        Ok(sum.add(&error.neg().hull(&error)))
    }

    /// The theorem's bound.
    fn remainder(&self, n: u32) -> Result<Interval, ShellError> {
        let ratio = Rational::from(&self.shell.inner / &self.shell.volume);
        let ratio = Interval::from_rational(&ratio, 64);
        let one = Interval::from_i64(1, 64);
        let a = one.add(&ratio);
        let rho = a.add(&a.square().sub(&one).sqrt()?);
        let reach = one.add(&a).div_integer(&2.into())?;
        let size = reach
            .pow_integer(&Integer::from(&self.left + &self.right))?
            .mul_integer(&self.constant);
        let series = rho.pow_integer(&n.into())?.mul(&one.sub(&one.div(&rho)?));
        Ok(size.mul_integer(&8.into()).div(&series)?)
    }
}

/// The nodes for so many bits.
fn nodes(sketch: &Sketch, bits: u32) -> f64 {
    let ratio = sketch.inside / sketch.w;
    let a = 1.0 + ratio;
    // log2 of a + sqrt(a^2 - 1)
    let rho = a.log2() + (1.0 + (1.0 - (a * a).recip()).sqrt()).log2();
    let m = sketch.s - 1.0;
    let part = |x: f64| if x > 0.0 { x * x.log2() } else { 0.0 };
    let constant = part(m) - part(sketch.l - 1.0) - part(sketch.q - 1.0) + m.log2();
    let size = constant + (m - 1.0) * ((1.0 + a) / 2.0).log2();
    ((f64::from(bits) + size + 4.0) / rho).ceil() + 2.0
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let n = nodes(sketch, bits);
    let few = sketch.s <= f64::from(MOST_PHOTONS);
    if sketch.inside == 0.0 || !few || !(1.0..=MOST_NODES).contains(&n) {
        return f64::INFINITY;
    }
    n * (n / 2.0 * sketch::interval_step(bits) + 100.0 * sketch::interval_step(bits))
}
