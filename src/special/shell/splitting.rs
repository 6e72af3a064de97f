//! Binary splitting: thousands of digits.
//!
//! A series `x = r_0 (1 + r_1 (1 + ...))` with rational r_j = n_j/d_j is cut off after n terms and computed exactly: a
//! run of terms i..j makes `x_i = (a + b x_j)/c` with integers, and two runs make one,
//!
//! ```text
//! (a1 + b1 (a2 + b2 x)/c2)/c1 = (a1 c2 + b1 a2 + b1 b2 x)/(c1 c2)
//! ```
//!
//! so that fast multiplication does the work (Haible and Papanikolaou 1998; DLMF 3.10 has none of it, the identity is its own proof). What
//! remains is one quotient, and the tail, bounded as for `pfaff`: `0 <= x - a/c <= T_n W`.
//!
//! Domain: `Va > 0`, at most 2^20 terms.

use super::ShellError;
use super::quantity::{Numbers, Quantity};
use super::sketch::{self, Sketch};
use crate::model::Shell;
use crate::number::Interval;
use rug::float::Round;
use rug::{Float, Integer, Rational};

/// The most terms.
const MOST_TERMS: u32 = 1 << 20;

/// Bits for the rounding errors of the quotient and what follows.
const GUARD: u32 = 24;

/// The series with `r_j = w (q + g j)/(s + g j)`, q < s and 0 < w < 1.
pub(super) struct Series<'a> {
    pub(super) w: &'a Rational,
    pub(super) q: Integer,
    pub(super) s: Integer,
    /// g, 1 or 2
    pub(super) step: u32,
}

/// `x_i = (a + b x_j)/c`
struct Run {
    a: Integer,
    b: Integer,
    c: Integer,
}

pub(super) fn enclose(
    quantity: Quantity,
    shell: &Shell,
    bits: u32,
) -> Result<Interval, ShellError> {
    let numbers = Numbers::new(shell)?;
    let series = Series {
        w: &numbers.w,
        q: numbers.q.clone(),
        s: numbers.s.clone(),
        step: 1,
    };
    let x = series.sum(bits + GUARD)?;
    numbers.quantity(quantity, &x)
}

impl Series<'_> {
    /// x, to about 2^-bits.
    ///
    /// # Errors
    /// `Outside` for w = 1 and too many terms.
    pub(super) fn sum(&self, bits: u32) -> Result<Interval, ShellError> {
        let runs = self.runs(bits)?;
        let Run { a, c, .. } = join(&runs, false);
        let tail = Interval::from_i64(0, 64).hull(&self.tail(&runs)?);
        Ok(quotient(&a, &c, bits).add(&tail))
    }

    /// The terms in runs, each within 128 bits where its terms are.
    fn runs(&self, bits: u32) -> Result<Vec<Run>, ShellError> {
        let mut runs = Vec::new();
        let mut words = Words::new(self);
        let mut n = 0;
        // log2 of T_n W, about.
        let (p, d) = (self.w.numer().to_f64(), self.w.denom().to_f64());
        let mut size = (p / (d - p)).log2();
        let (w, goal) = (p / d, -f64::from(bits));
        let (mut q, mut s, step) = (self.q.to_f64(), self.s.to_f64(), f64::from(self.step));
        let mut product = 1.0;
        while size + f64::log2(product) > goal {
            product *= w * q / s;
            if product < 1e-200 {
                size += f64::log2(product);
                product = 1.0;
            }
            (q, s, n) = (q + step, s + step, n + 1);
            if n > MOST_TERMS || w >= 1.0 {
                return Err(ShellError::Outside);
            }
        }
        let mut j = 0;
        while j < n {
            let run = match &mut words {
                Some(words) => words.run(&mut j, n),
                None => None,
            };
            runs.push(run.unwrap_or_else(|| self.single(&mut j)));
        }
        Ok(runs)
    }

    /// One term of any size.
    fn single(&self, j: &mut u32) -> Run {
        let shift = Integer::from(*j) * self.step;
        let above = Integer::from(&shift + &self.q) * self.w.numer();
        let below = (shift + &self.s) * self.w.denom();
        *j += 1;
        Run {
            a: above.clone(),
            b: above,
            c: below,
        }
    }

    /// An upper bound of `T_n W` for the n terms of the runs: T_n is the product of all b/c.
    fn tail(&self, runs: &[Run]) -> Result<Interval, ShellError> {
        let rest = Integer::from(self.w.denom() - self.w.numer());
        let mut tail = Interval::from_integer(self.w.numer(), 64);
        tail = tail.div_integer(&rest)?;
        for run in runs {
            tail = tail.mul_integer(&run.b).div_integer(&run.c)?;
        }
        Ok(tail)
    }
}

/// All runs as one; the b of the last is worth nothing where nothing follows.
fn join(runs: &[Run], followed: bool) -> Run {
    match runs {
        [] => Run {
            a: Integer::new(),
            b: Integer::from(1),
            c: Integer::from(1),
        },
        [run] => Run {
            a: run.a.clone(),
            b: run.b.clone(),
            c: run.c.clone(),
        },
        _ => {
            let (left, right) = runs.split_at(runs.len() / 2);
            let (left, right) = (join(left, true), join(right, followed));
            let a = left.a * &right.c + &left.b * right.a;
            Run {
                a,
                b: if followed {
                    left.b * right.b
                } else {
                    Integer::new()
                },
                c: left.c * right.c,
            }
        }
    }
}

/// a/c for positive integers. Three roundings down by less than a factor 1 - 2^(1-bits) each.
fn quotient(a: &Integer, c: &Integer, bits: u32) -> Interval {
    let above = Float::with_val_round(bits, a, Round::Down).0;
    let below = Float::with_val_round(bits, c, Round::Up).0;
    let low = Float::with_val_round(bits, above / &below, Round::Down).0;
    let error = low.clone() >> (bits - 3);
    let high = Float::with_val_round(bits, &low + &error, Round::Up).0;
    Interval::from_ends(low, high)
}

/// The series where its numbers are words.
struct Words {
    above: u128,
    below: u128,
    above_step: u128,
    below_step: u128,
}

impl Words {
    fn new(series: &Series) -> Option<Words> {
        let (p, d) = (series.w.numer().to_u32()?, series.w.denom().to_u32()?);
        let (q, s) = (series.q.to_u32()?, series.s.to_u32()?);
        let wide = |a: u32, b: u32| u128::from(a) * u128::from(b);
        Some(Words {
            above: wide(p, q),
            below: wide(d, s),
            above_step: wide(p, series.step),
            below_step: wide(d, series.step),
        })
    }

    /// As many terms from j on as keep c within 128 bits.
    fn run(&mut self, j: &mut u32, n: u32) -> Option<Run> {
        let (mut a, mut b, mut c) = (0u128, 1u128, 1u128);
        while *j < n {
            let next = || {
                let product = c.checked_mul(self.below)?;
                let more = b.checked_mul(self.above)?;
                let sum = a.checked_mul(self.below)?.checked_add(more)?;
                Some((sum, more, product))
            };
            let Some(next) = next() else { break };
            (a, b, c) = next;
            self.above += self.above_step;
            self.below += self.below_step;
            *j += 1;
        }
        (c > 1).then(|| Run {
            a: a.into(),
            b: b.into(),
            c: c.into(),
        })
    }
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let terms = sketch.pfaff_terms(f64::from(bits + GUARD));
    if terms > f64::from(MOST_TERMS) {
        return f64::INFINITY;
    }
    sketch::splitting(terms, sketch.term_bits(terms), f64::from(bits))
}
