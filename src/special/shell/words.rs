//! Pfaff's series in fixed-point words: the fastest way to 15 and to several hundred digits.
//!
//! With w = V/(Va+V) = p/d, s = m+1, q = s-l and A = Va+V the law of the volume is `U = A(1 - w y)`,
//! y ~ Beta(q, l), and Pfaff's transformation (DLMF 15.8.1) gives the mean of `X = A/U - 1`:
//!
//! ```text
//! x = mean(X) = sum of T_j, j >= 1,   T_j = w^j (q)_j/(s)_j = r_0 r_1 ... r_(j-1),   r_j = p (q+j)/(d (s+j))
//! ```
//!
//! all positive. It is computed from the inside of `x = r_0 (1 + r_1 (1 + ...))`: for
//! `x_j = r_j (1 + x_(j+1))` several steps together are one, `x_j = (a + b x_(j+i))/c` with words
//! a, b, c, so that i terms cost one product and one quotient by a word.
//!
//! Theorem (truncation). `0 <= x_n <= W = w/(1-w)`. So with `x_n` put to 0, x is too small by at most
//! `T_n W`. Proof: all `r_j < w`.
//!
//! Theorem (rounding). Let a block that starts at j be computed in ulps u_j with `T_j u_j <= ulp`. Then
//! x is too small by at most one ulp a block. Proof: a block's product is exact and its quotient rounded down
//! once, by less than u_j; in x this error is multiplied by `b/c` of all blocks further out, together
//! T_j. A number with larger ulps is one with smaller ulps. QED. So the inner blocks are shorter.
//!
//! The T_j are bounded by floats: p q, d s and their n-th successors are off by at most n+2 units 2^-53, for
//! n <= MOST_TERMS less than 2^-38; a product of n such ratios by less than (2^-37 + 2^-52) n <= 2^-22 in all, which is added first.
//!
//! The second moment needs no second series. The contiguous relation that gives the thesis's variance
//! (its 2.104 with F = (1-w)(1+x)) reads
//!
//! ```text
//! (d-p) mean(X^2) = p q - (d s - p (q+1)) x,      var(k/U) = (k/A)^2 (mean(X^2) - x^2)
//! ```
//!
//! and what it cancels, about 2 log2 k bits, is added to the bits of x.

use super::ShellError;
use super::quantity::Quantity;
use super::scene::{Fraction, Scene};
use super::sketch::Sketch;
use crate::number::Interval;
use crate::number::fixed::{self, Divisor};

/// Numbers of at most this many words are kept on the stack.
const FEW: usize = 8;

/// The most words of a number: beyond, splitting is faster by far.
const MOST: usize = 1024;

/// The most terms: the bound of the floats' errors holds up to here.
const MOST_TERMS: u64 = 1 << 16;

/// A number from `low` to `low + ulps`, `low = integer + x`.
struct Enclosed<'a> {
    integer: u64,
    x: &'a mut [u64],
    ulps: u64,
}

/// The quantity, from x to about 2^-bits; the result has the relative accuracy that this leaves.
///
/// # Errors
/// `Outside` where a shell's numbers exceed a word, or `Va < V`; `Lost` where the bits do not
/// suffice to tell the result from 0.
pub(super) fn enclose(
    quantity: Quantity,
    scene: &Scene,
    bits: u32,
) -> Result<Interval, ShellError> {
    certified(quantity, scene, bits, 0)
}

/// As [`enclose`], and `Lost` where the relative width is not below 2^-needed.
pub(super) fn certified(
    quantity: Quantity,
    scene: &Scene,
    bits: u32,
    needed: u32,
) -> Result<Interval, ShellError> {
    // So many blocks at most that their ulps stay below 2^-bits; then all counts fit a word.
    let guard = 33 - bits.leading_zeros();
    let words = (bits + guard).div_ceil(64) as usize;
    let bits = bits.max(64 * words as u32 - room(quantity, scene));
    if words <= FEW {
        evaluate(
            quantity,
            scene,
            bits,
            needed,
            &mut [0; 5 * FEW][..5 * words],
        )
    } else if words <= MOST {
        evaluate(quantity, scene, bits, needed, &mut vec![0; 5 * words])
    } else {
        Err(ShellError::Outside)
    }
}

/// The bits of a word that the error of x may fill, so that the error of the quantity fits one too.
fn room(quantity: Quantity, scene: &Scene) -> u32 {
    match quantity {
        // An error of x counts s/(1-w) <= 2 s times.
        Quantity::Variance => scene.s.leading_zeros().saturating_sub(5).max(1),
        _ => 60,
    }
}

/// As [`certified`], with five numbers' room, all 0.
fn evaluate(
    quantity: Quantity,
    scene: &Scene,
    bits: u32,
    needed: u32,
    buffer: &mut [u64],
) -> Result<Interval, ShellError> {
    let (x, work) = buffer.split_at_mut(buffer.len() / 5);
    let precision = 64 * x.len() as u32;
    let ulps = series(scene, bits, x, work)?;
    let sum = Enclosed {
        integer: 1,
        x,
        ulps,
    };
    let result = match quantity {
        Quantity::Function => sum.times(Fraction {
            above: scene.w.below - scene.w.above,
            below: scene.w.below,
        })?,
        Quantity::Mean => sum.times(scene.k)?,
        Quantity::Excess => {
            let mut mean = sum.times(scene.k)?;
            mean.integer = mean.integer.checked_sub(1).ok_or(ShellError::Lost)?;
            mean
        }
        Quantity::Variance => variance(scene, sum, work)?,
    };
    if result.accuracy() < needed {
        return Err(ShellError::Lost);
    }
    Ok(fixed::enclose(
        result.integer,
        result.x,
        result.ulps,
        0,
        precision,
    ))
}

impl Enclosed<'_> {
    /// n with a relative width of at most 2^-n, the rounding of an interval's ends included.
    fn accuracy(&self) -> u32 {
        let value = match self.integer {
            0 => 64 * self.x.len() as u32 - fixed::leading_zeros(self.x),
            _ => 64 * self.x.len() as u32 + 1,
        };
        // value >= 2^(value-1), and the ends move by less than an ulp of 64 bits less.
        let width = 64 - self.ulps.saturating_add(2).leading_zeros();
        value.saturating_sub(width + 1)
    }

    /// Times a fraction.
    fn times(mut self, factor: Fraction) -> Result<Self, ShellError> {
        let carry = fixed::mul_word(self.x, factor.above);
        let integer = self.integer.checked_mul(factor.above);
        let integer = integer.and_then(|i| i.checked_add(carry));
        let integer = integer.ok_or(ShellError::Outside)?;
        divide(self.x, integer % factor.below, factor.below)?;
        self.integer = integer / factor.below;
        // One more for the quotient rounded down, one for the error's own.
        let ulps = u128::from(self.ulps) * u128::from(factor.above) / u128::from(factor.below);
        self.ulps = u64::try_from(ulps + 2).map_err(|_| ShellError::Lost)?;
        Ok(self)
    }
}

fn divide(x: &mut [u64], integer: u64, divisor: u64) -> Result<(), ShellError> {
    if x.len() <= 2 {
        fixed::div_once(x, integer, divisor);
    } else {
        let divisor = Divisor::new(divisor).ok_or(ShellError::Outside)?;
        fixed::div_word(x, integer, &divisor);
    }
    Ok(())
}

/// The variance from x = `mean.x`, by the formula of the header. With e ulps of x, rounded down:
/// `(d s - p (q+1)) e/(d-p)` and `2 x e + e^2 < 3 e` are what the two parts can be too large, 2 and 1 what
/// they can be too small or too large by rounding.
fn variance<'a>(
    scene: &Scene,
    sum: Enclosed<'a>,
    work: &mut [u64],
) -> Result<Enclosed<'a>, ShellError> {
    let n = sum.x.len();
    let (square, work) = work.split_at_mut(n);
    fixed::mul(square, sum.x, sum.x, work);
    let (p, d) = (scene.w.above, scene.w.below);
    let slope = || {
        let falls = p.checked_mul(scene.q.checked_add(1)?)?;
        d.checked_mul(scene.s)?.checked_sub(falls)
    };
    let slope = slope().ok_or(ShellError::Outside)?;
    let top = p.checked_mul(scene.q).ok_or(ShellError::Outside)?;
    let carry = fixed::mul_word(sum.x, slope);
    fixed::complement(sum.x);
    let integer = top.checked_sub(carry + 1).ok_or(ShellError::Lost)?;
    if integer >= d - p {
        return Err(ShellError::Lost);
    }
    divide(sum.x, integer, d - p)?;
    let down =
        u128::from(sum.ulps) * u128::from(slope) / u128::from(d - p) + 3 * u128::from(sum.ulps) + 2;
    let down = u64::try_from(down).map_err(|_| ShellError::Lost)?;
    if fixed::sub(sum.x, square) || fixed::sub_ulps(sum.x, down) {
        return Err(ShellError::Lost);
    }
    let variance = Enclosed {
        integer: 0,
        ulps: down.checked_add(2).ok_or(ShellError::Lost)?,
        ..sum
    };
    variance.times(scene.k)?.times(scene.k)
}

/// x of the header, rounded down, for `Va >= V`: then `x < 1`. What it may be too small by, in ulps.
fn series(scene: &Scene, bits: u32, x: &mut [u64], work: &mut [u64]) -> Result<u64, ShellError> {
    let (p, d) = (scene.w.above, scene.w.below);
    if p > d - p {
        return Err(ShellError::Outside);
    }
    let mut plan = Plan {
        crossings: work,
        known: 0,
    };
    let terms = plan.terms(scene, bits)?;
    // The last and largest p (q+j) and d (s+j), and one more.
    let mut below = d.checked_mul(scene.s + terms).ok_or(ShellError::Outside)?;
    let mut above = p * (scene.q + terms);
    let mut left = terms;
    let mut blocks = 0;
    while left > 0 {
        (above, below, left) = (above - p, below - d, left - 1);
        let (mut a, mut b, mut c) = (above, above, below);
        while left > 0 {
            let Some(product) = c.checked_mul(below - d) else {
                break;
            };
            (above, below, left) = (above - p, below - d, left - 1);
            // x_j = above/below (1 + (a + b x)/c). Nothing overflows: x_j < 1 with x >= 0.
            (a, b, c) = (above * (c + a), above * b, product);
        }
        let part = &mut x[plan.cut(left)..];
        let carry = fixed::mul_word(part, b);
        divide(part, a + carry, c)?;
        blocks += 1;
    }
    Ok(blocks + (1 << (64 * x.len() as u32 - bits)))
}

/// How many terms, and how many words a block needs.
struct Plan<'a> {
    /// The least j with `T_j <= 2^(-64 (i+1))`, for the first i.
    crossings: &'a mut [u64],
    known: usize,
}

impl Plan<'_> {
    /// The least n, about, with `T_n W <= 2^-bits`.
    fn terms(&mut self, scene: &Scene, bits: u32) -> Result<u64, ShellError> {
        const WORD: f64 = 18_446_744_073_709_551_616.0;
        let (p, d) = (scene.w.above as f64, scene.w.below as f64);
        let ratio = p / (d - p);
        let (mut above, mut below) = (p * scene.q as f64, d * scene.s as f64);
        let mut goal = power(-i64::from(bits));
        // T_n W 2^(64 known), too large.
        let mut size = ratio * (1.0 + 1.0 / (1u64 << 16) as f64);
        for n in 0..MOST_TERMS {
            if size <= goal {
                return Ok(n);
            }
            if size <= ratio / WORD {
                self.crossings[self.known] = n;
                self.known += 1;
                size *= WORD;
                goal = power(64 * self.known as i64 - i64::from(bits));
            }
            size *= above / below;
            above += p;
            below += d;
        }
        Err(ShellError::Outside)
    }

    /// How many of the lowest words a block that starts at j can do without.
    fn cut(&mut self, j: u64) -> usize {
        while self.known > 0 && self.crossings[self.known - 1] > j {
            self.known -= 1;
        }
        self.known
    }
}

/// 2^exponent, or 0 below the least normal number; exponent <= 1023.
fn power(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023).max(0) as u64) << 52)
}

/// Whether no other method can be cheaper: a shell whose volumes are in the domain, and so few bits that
/// products of whole numbers gain nothing.
pub(super) fn is_cheapest(sketch: &Sketch, bits: u32) -> bool {
    bits <= 3400 && sketch.w <= 0.5
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    if sketch.w > 0.5 || sketch.inside == 0.0 || bits as usize > 64 * MOST {
        return f64::INFINITY;
    }
    let terms = sketch.pfaff_terms(f64::from(bits));
    let blocks = terms / (64.0 / sketch.term_bits(terms)).floor().max(1.0);
    let words = f64::from(bits) / 64.0;
    1400.0 + 12.0 * terms + blocks * (220.0 + 14.0 * words) + 12.5 * words * words
}
