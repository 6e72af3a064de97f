//! A shell in doubles: what costs and losses are estimated from. Nothing here is proved or needs to be:
//! a wrong guess costs time, never a digit.
//!
//! Costs are counts of machine instructions. Their constants were fitted (least squares of the relative
//! error, callgrind, x86-64) to the words, splitting and exact methods at 15 to 10,000 digits for k = 4 to
//! 10^12 of strategy 2; each model is within 25 percent of every count. In time an instruction of the word
//! method is dearer by half, since its quotients wait for one another.

use super::ShellError;
use super::quantity::{Quantity, check};
use super::scene::{Fraction, Scene};
use crate::model::Shell;
use crate::number::Interval;
use rug::{Float, Rational};

/// The largest loss that is planned for: where more is lost the choice finds it out by itself.
const MOST_LOSS: f64 = 8192.0;

/// A shell, A = Va+V.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sketch {
    pub(super) l: f64,
    /// m+1-l
    pub(super) q: f64,
    /// m+1
    pub(super) s: f64,
    /// V/A
    pub(super) w: f64,
    /// Va/A; 0 for Va = 0 only
    pub(super) inside: f64,
    /// The denominator of V/A
    below: f64,
    /// mu/A
    mean: f64,
    /// k/mu - 1
    first: f64,
    /// k/A
    k: f64,
}

/// The binary exponent of the upper end: 2^exponent is larger than it.
pub(super) fn exponent(value: &Interval) -> i64 {
    let of = |x: &Float| match x.get_exp() {
        Some(exponent) => i64::from(exponent),
        None if x.is_zero() => i64::MIN,
        None => i64::MAX,
    };
    of(value.high()).max(of(value.low()))
}

/// Instructions, about, for a step of a series in intervals: a product and a quotient by integers, a sum,
/// a bound of the tail.
pub(super) fn interval_step(bits: u32) -> f64 {
    5900.0 + 2.0 * f64::from(bits)
}

/// Instructions, about, for a series of so many terms of so many bits each by binary splitting, without
/// what comes before and after.
pub(super) fn splitting(terms: f64, term_bits: f64, bits: f64) -> f64 {
    90.0 * terms + terms * term_bits / 64.0 * (1700.0 + 72.0 * (bits / 64.0).powf(0.6))
}

impl Sketch {
    /// # Errors
    /// `NoShell` for no shell of the model.
    pub(super) fn new(shell: &Shell) -> Result<Sketch, ShellError> {
        if let Ok(scene) = Scene::new(shell) {
            return Ok(Sketch::of(&scene));
        }
        check(shell)?;
        let (l, m) = (&shell.position, &shell.count);
        let outer = Rational::from(&shell.inner + &shell.volume);
        // What is too small for a double counts as the least one.
        let share = |value: &Rational| match value.cmp0().is_gt() {
            true => Rational::from(value / &outer)
                .to_f64()
                .max(f64::MIN_POSITIVE),
            false => 0.0,
        };
        let q = (rug::Integer::from(m - l) + 1u32).to_f64();
        let (l, s) = (l.to_f64(), m.to_f64() + 1.0);
        let part = Rational::from(&shell.volume * &shell.position) / rug::Integer::from(m + 1u32);
        let mu = &shell.inner + part;
        let first = (Rational::from(&shell.inner + &shell.position) - &mu) / &mu;
        let w = Rational::from(&shell.volume / &outer);
        Ok(Sketch {
            l,
            q,
            s,
            below: w.denom().to_f64(),
            w: share(&shell.volume),
            inside: share(&shell.inner),
            mean: share(&mu),
            first: first.to_f64(),
            k: share(&Rational::from(&shell.inner + &shell.position)),
        })
    }

    /// The same of a shell in words.
    pub(super) fn of(scene: &Scene) -> Sketch {
        let share = |fraction: &Fraction| fraction.above as f64 / fraction.below as f64;
        let (l, q, s) = (scene.l as f64, scene.q as f64, scene.s as f64);
        let (w, k) = (share(&scene.w), share(&scene.k));
        let inside = (scene.w.below - scene.w.above) as f64 / scene.w.below as f64;
        let mean = 1.0 - w * q / s;
        Sketch {
            l,
            q,
            s,
            w,
            inside,
            below: scene.w.below as f64,
            mean,
            first: scene.offset() / mean,
            k,
        }
    }

    /// The bits that follow the point of x = mean(A/U) - 1 before the quantity is known to one: what an
    /// absolute error 2^-bits of x takes away. None at the centre, where the quantities are rational; and no more than
    /// [`MOST_LOSS`], as what overflows here tells nothing.
    pub(super) fn loss(&self, quantity: Quantity) -> f64 {
        let loss = match quantity {
            _ if self.inside == 0.0 => 0.0,
            Quantity::Function | Quantity::Mean => 0.0,
            Quantity::Excess => (self.k / self.excess()).log2(),
            Quantity::Variance => {
                let slope = (self.s - self.w * (self.q + 1.0)) / self.inside;
                ((slope + 3.0 + 2.0 / self.inside) / self.spread()).log2()
            }
        };
        loss.clamp(0.0, MOST_LOSS)
    }

    /// The size of E - 1, about; not so near 0 that it tells nothing.
    fn excess(&self) -> f64 {
        let more = self.spread() * self.mean * self.mean;
        let excess = self.first + (1.0 + self.first) * more;
        excess.abs().max(f64::EPSILON * more)
    }

    /// The variance of A/U, about: that of U over the fourth power of its mean.
    fn spread(&self) -> f64 {
        let of_y = self.q * self.l / (self.s * self.s * (self.s + 1.0));
        self.w * self.w * of_y / self.mean.powi(4)
    }

    /// log2 of `(q)_n/(s)_n`, by Stirling's formula.
    fn falling(&self, n: f64) -> f64 {
        let part = |x: f64| (x - 0.5) * x.log2();
        part(self.q + n) - part(self.q) - part(self.s + n) + part(self.s)
    }

    /// The terms of Pfaff's series for so many bits.
    pub(super) fn pfaff_terms(&self, bits: f64) -> f64 {
        let ratio = (self.w / self.inside).log2();
        self.terms(bits + ratio, self.w.log2(), |n| self.falling(n))
    }

    /// The terms of the direct series for so many bits.
    pub(super) fn direct_terms(&self, bits: f64) -> f64 {
        let mirror = Sketch { q: self.l, ..*self };
        self.terms(bits, (self.w / self.inside).log2(), |n| mirror.falling(n))
    }

    /// The least n, about, with `n slope + rest(n) <= -bits`, rest falling; infinite without one.
    fn terms(&self, bits: f64, slope: f64, rest: impl Fn(f64) -> f64) -> f64 {
        if slope >= 0.0 {
            return f64::INFINITY;
        }
        let mut n = (bits / -slope).max(1.0);
        for _ in 0..8 {
            // Newton's method with the secant from 0, from above.
            let value = n * slope + rest(n);
            n = (n * bits / -value).max(1.0);
        }
        n.ceil()
    }

    /// The terms of the central moments for so many bits: sig_n is about (n-1)!! (rho sqrt(q l))^(n-2).
    pub(super) fn moment_terms(&self, bits: f64) -> f64 {
        if 2.0 * self.mean <= 1.0 || self.inside == 0.0 {
            return f64::INFINITY;
        }
        // sig_(n+1)/sig_n is about the root of n/(s+n) rho^2 q l, and less than rho max(q, l).
        let rho = self.w / (self.mean * self.s);
        let last = rho * self.q.max(self.l);
        let spread = rho * rho * self.q * self.l;
        let mut size = 2.0 * (self.mean / self.inside).log2() + bits;
        let mut n = 2.0;
        while size > 0.0 {
            let step = (n / (self.s + n) * spread).sqrt().min(last).min(0.99);
            let stride = f64::floor(1.0 + n / 8.0);
            size += stride * step.log2() + 1.0 / n;
            n += stride;
        }
        n
    }

    /// The middle of the shell for the contiguous relation.
    pub(super) fn middle(&self) -> f64 {
        ((self.s - 1.0) * self.inside / (1.0 + self.inside)).max(1.0)
    }

    /// The bits that the contiguous relation loses between two photons at most: the largest product of its
    /// multipliers on the way.
    pub(super) fn walk_loss(&self, from: f64, to: f64) -> f64 {
        let m = self.s - 1.0;
        let entropy = |l: f64| {
            let part = |x: f64| if x > 0.0 { x * (x / m).log2() } else { 0.0 };
            -part(l) - part(m - l) + l * self.inside.log2()
        };
        // Not `clamp`: rounded numbers may come in the wrong order.
        let middle = self.middle().max(from).min(to);
        (entropy(middle) - entropy(from).min(entropy(to))).max(0.0)
    }

    /// The bits of a term's denominator in Pfaff's series.
    pub(super) fn term_bits(&self, terms: f64) -> f64 {
        ((self.s + terms) * self.below).log2()
    }
}
