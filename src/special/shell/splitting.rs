//! Binary splitting in chunks: thousands of digits.
//!
//! A series `x = r_0 (1 + r_1 (1 + ...))` with rational `r_j = n_j/d_j` is cut off after n terms. A run of terms i..j makes
//! `x_i = (a + b x_j)/c` with integers, exactly, and two runs make one:
//!
//! ```text
//! (a1 + b1 (a2 + b2 x)/c2)/c1 = (a1 c2 + b1 a2 + b1 b2 x)/(c1 c2)
//! ```
//!
//! so that fast multiplication does the work (Haible and Papanikolaou, *Fast multiprecision evaluation of series of rational
//! numbers*, 1998). All terms as one run would have many times the digits asked for; so there are several
//! chunks, joined from the last to the first in fixed point.
//!
//! Theorem (truncation). `0 <= x_n <= W`, W = w/(1-w), for `r_j < w`: with `x_n` put to 0, x is too small by at most
//! `T_n W`, `T_j = r_0 ... r_(j-1)`.
//!
//! Theorem (rounding). Let the chunk that starts at j be rounded down to an integer multiple of `2^-P_j`, where
//! `T_j 2^-P_j <= 2^-bits`. Then x is too small by at most 2^-bits a chunk. Proof: as in `words`. Here T_j is bounded by
//! the sizes of the chunks before, `b/c < 2^(size b - size c + 1)`.
//!
//! Domain: `Va > 0`, at most 2^20 terms.

use super::ShellError;
use super::quantity::{Numbers, Quantity};
use super::sketch::{self, Sketch};
use crate::model::Shell;
use crate::number::{Interval, fixed};
use rug::integer::Order;
use rug::{Integer, Rational};

/// The most terms.
const MOST_TERMS: u32 = 1 << 20;

/// Bits for the rounding errors of the chunks and of what follows.
const GUARD: u32 = 24;

/// The denominator of a run of words has at most so many bits. So the run has at most 58 terms, each
/// below 1, and a < 64 c is a word too.
const WORD: u32 = 58;

/// So many runs of words are put together in words, before whole numbers take over.
const LEAF: usize = 16;

pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    let numbers = Numbers::new(shell);
    let series = Series {
        w: &numbers.w,
        q: &numbers.q,
        s: &numbers.s,
        step: 1,
    };
    let x = series.sum(bits + GUARD)?;
    numbers.all(quantities, &x)
}

/// The series with `r_j = w (q + g j)/(s + g j)`, 0 < q < s and 0 < w < 1.
pub(super) struct Series<'a> {
    pub(super) w: &'a Rational,
    pub(super) q: &'a Integer,
    pub(super) s: &'a Integer,
    /// g, 1 or 2
    pub(super) step: u32,
}

/// `x_i = (a + b x_j)/c`
struct Run {
    a: Integer,
    b: Integer,
    c: Integer,
}

impl Series<'_> {
    /// x, to about 2^-bits.
    ///
    /// # Errors
    /// `Outside` for w = 1 and too many terms.
    pub(super) fn sum(&self, bits: u32) -> Result<Interval, ShellError> {
        if *self.w >= 1 {
            return Err(ShellError::Outside);
        }
        let n = self.terms(bits)?;
        let term_bits = self.below(n).significant_bits();
        // Terms of a run of words, or none.
        let per_word = WORD / term_bits;
        let per_chunk = (chunk_bits(bits) / term_bits).max(1);
        let chunks: Vec<Run> = (0..n)
            .step_by(per_chunk as usize)
            .map(|i| self.run(i, n.min(i + per_chunk), per_word))
            .collect();
        let mut precisions = vec![bits];
        for chunk in &chunks {
            let gained = chunk.c.significant_bits() - chunk.b.significant_bits();
            let last = precisions[precisions.len() - 1];
            precisions.push(last.saturating_sub(gained.saturating_sub(1)));
        }
        let mut x = Integer::new();
        for (i, Run { a, b, c }) in chunks.iter().enumerate().rev() {
            // In multiples of the chunk's own 2^-P, which is at most the next one's.
            let (own, next) = (precisions[i], precisions[i + 1]);
            x *= b;
            x += Integer::from(a << next);
            x <<= own - next;
            x /= c;
        }
        self.with_errors(x, bits, &chunks)
    }

    /// x 2^-bits, and what it is too small by: 2^-bits a chunk, and the tail.
    fn with_errors(&self, x: Integer, bits: u32, chunks: &[Run]) -> Result<Interval, ShellError> {
        let rest = Integer::from(self.w.denom() - self.w.numer());
        let mut tail = Interval::from_integer(self.w.numer(), 64).div_integer(&rest)?;
        for Run { b, c, .. } in chunks {
            tail = tail.mul_integer(b).div_integer(c)?;
        }
        let scale = Interval::from_i64(2, 64).powi(-i64::from(bits))?;
        let rounding = scale.mul_integer(&chunks.len().into());
        let error = Interval::from_i64(0, 64).hull(&tail.add(&rounding));
        let sum = Interval::from_integer(&x, bits).mul(&scale);
        Ok(sum.add(&error))
    }

    /// The least n, about, with `T_n W <= 2^-bits`.
    fn terms(&self, bits: u32) -> Result<u32, ShellError> {
        let w = self.w.to_f64();
        let rest = 1u32 - self.w.clone();
        let (mut q, mut s) = (self.q.to_f64(), self.s.to_f64());
        let step = f64::from(self.step);
        // log2 of T_n W is `size + log2 product`.
        let mut size = f64::from(bits) + (self.w.clone() / rest).to_f64().log2();
        let mut product = 1.0;
        for n in 1..MOST_TERMS {
            product *= w * q / s;
            if product < 1e-200 || f64::from(n) * w.log2() > -size {
                size += f64::log2(product);
                product = 1.0;
            }
            if size + f64::log2(product) <= 0.0 {
                return Ok(n);
            }
            (q, s) = (q + step, s + step);
        }
        Err(ShellError::Outside)
    }

    /// n_j
    fn above(&self, j: u32) -> Integer {
        (Integer::from(j) * self.step + self.q) * self.w.numer()
    }

    /// d_j
    fn below(&self, j: u32) -> Integer {
        (Integer::from(j) * self.step + self.s) * self.w.denom()
    }

    /// The terms i..j, i < j, as one run.
    fn run(&self, i: u32, j: u32, per_word: u32) -> Run {
        if j - i <= (per_word * LEAF as u32).max(1) {
            return self.leaf(i, j, per_word);
        }
        let middle = i + (j - i).div_ceil(2);
        let left = self.run(i, middle, per_word);
        let right = self.run(middle, j, per_word);
        Run {
            a: left.a * &right.c + right.a * &left.b,
            b: left.b * right.b,
            c: left.c * right.c,
        }
    }

    fn leaf(&self, i: u32, j: u32, per_word: u32) -> Run {
        let (above, below) = (self.above(i), self.below(i));
        match (above.to_u64(), below.to_u64()) {
            (Some(n), Some(d)) if per_word > 0 => self.words(n, d, j - i, per_word),
            _ => Run {
                a: above.clone(),
                b: above,
                c: below,
            },
        }
    }

    /// So many terms from n/d on, where n and d stay words.
    fn words(&self, mut n: u64, mut d: u64, mut left: u32, per_word: u32) -> Run {
        // p < d and so both are words.
        let step = |value: &Integer| value.to_u64_wrapping() * u64::from(self.step);
        let (n_step, d_step) = (step(self.w.numer()), step(self.w.denom()));
        let mut leaf = Leaf::new();
        while left > 0 {
            let (mut a, mut b, mut c) = (0, 1, 1);
            for _ in 0..per_word.min(left) {
                b *= n;
                (a, c) = (a * d + b, c * d);
                (n, d) = (n + n_step, d + d_step);
            }
            left -= per_word.min(left);
            leaf.append(a, b, c);
        }
        leaf.run()
    }
}

/// A run in fixed words, least first: at most [`LEAF`] runs of words. With every one b and c grow by a word, and a, the
/// sum of fewer than 2^10 terms of c each, needs one more.
struct Leaf {
    a: [u64; LEAF + 2],
    b: [u64; LEAF + 2],
    c: [u64; LEAF + 2],
    length: usize,
}

impl Leaf {
    fn new() -> Leaf {
        let mut one = [0; LEAF + 2];
        one[0] = 1;
        Leaf {
            a: [0; LEAF + 2],
            b: one,
            c: one,
            length: 1,
        }
    }

    /// Takes in `x_j = (a + b x)/c`.
    fn append(&mut self, a: u64, b: u64, c: u64) {
        self.length += 1;
        let n = self.length;
        // a + b x now: (A + B (a + b x)/c)/C = (A c + B a + B b x)/(C c)
        let mut more = self.b;
        fixed::mul_word(&mut more[..n], a);
        fixed::mul_word(&mut self.a[..n], c);
        fixed::add(&mut self.a[..n], &more[..n]);
        fixed::mul_word(&mut self.b[..n], b);
        fixed::mul_word(&mut self.c[..n], c);
    }

    fn run(&self) -> Run {
        let integer = |words: &[u64]| Integer::from_digits(&words[..self.length], Order::Lsf);
        Run {
            a: integer(&self.a),
            b: integer(&self.b),
            c: integer(&self.c),
        }
    }
}

/// The bits of a chunk: about where whole products and the rounded quotients cost the same.
fn chunk_bits(bits: u32) -> u32 {
    (bits / 10 * 3).max(1024)
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let terms = sketch.pfaff_terms(f64::from(bits + GUARD));
    if terms > f64::from(MOST_TERMS) {
        return f64::INFINITY;
    }
    35_000.0 + sketch::splitting(terms, sketch.term_bits(terms), f64::from(bits))
}
