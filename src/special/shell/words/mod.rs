//! Pfaff's series in fixed-point words: the fastest way to 15 and to a thousand digits.
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
//! a, b, c, so that i terms cost one product and one quotient by a word. All `x_j < W = w/(1-w) <= 2^g`, and
//! the numbers in words are `y_j = x_j 2^-g`; g = 0 where `Va >= V`.
//!
//! Theorem (truncation). `0 <= x_n <= W`. So with `x_n` put to 0, x is too small by at most
//! `T_n W`. Proof: all `r_j < w`.
//!
//! Theorem (rounding). Let a block that starts at j be computed in ulps u_j with `T_j u_j <= ulp`. Then
//! y is too small by at most one ulp a block. Proof: a block's product is exact and its quotient rounded down
//! once, by less than u_j; in y this error is multiplied by `b/c` of all blocks further out, together
//! T_j. A number with larger ulps is one with smaller ulps. QED. So the inner blocks are shorter.
//!
//! The second moment needs no second series:
//!
//! ```text
//! (d-p) mean(X^2) = p q - (d s - p (q+1)) x,      var(k/U) = (k/A)^2 (mean(X^2) - x^2)
//! ```
//!
//! (proved in `quantity`), and what it cancels, about 2 log2 k bits, is added to the bits of x.
//!
//! Domain: all numbers of the shell and of a term are words, and `V <= 2^16 Va`. Cost: a quotient of a number by a word for
//! each block.

mod series;

use super::ShellError;
use super::quantity::{Quantity, each};
use super::scene::{Fraction, Scene};
use super::sketch::Sketch;
use crate::number::Interval;
use crate::number::fixed::{self, Divisor};

/// Numbers of at most this many words are kept on the stack.
const FEW: usize = 8;

/// The most words of a number: beyond, splitting is faster by far.
const MOST: usize = 1024;

/// A number from `low` to `low + ulps`, `low = integer + x`.
struct Enclosed<'a> {
    integer: u64,
    x: &'a mut [u64],
    ulps: u64,
}

/// The quantities, from x to about 2^-bits; the results have the relative accuracy that this leaves.
///
/// # Errors
/// `Outside` where a shell's numbers exceed a word, or `V > 2^16 Va`; `Lost` where the bits do not
/// suffice to tell a result from 0.
pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    scene: &Scene,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    certified(quantities, scene, bits, 0)
}

/// As [`enclose`], and `Lost` where a relative width is not below 2^-needed.
pub(super) fn certified<const N: usize>(
    quantities: [Quantity; N],
    scene: &Scene,
    bits: u32,
    needed: u32,
) -> Result<[Interval; N], ShellError> {
    // So many blocks at most that their ulps stay below 2^-bits.
    let guard = 33 - bits.leading_zeros();
    let words = (bits + guard + scene.shift).div_ceil(64) as usize;
    // And so few bits unused that all errors, counted in ulps, are words.
    let mut unused = ROOM;
    for quantity in quantities {
        unused = unused.min(room(quantity, scene)?);
    }
    let bits = bits.max((64 * words as u32 - scene.shift).saturating_sub(unused));
    if words <= FEW {
        let mut buffer = [0; 6 * FEW];
        evaluate(quantities, scene, bits, needed, &mut buffer[..6 * words])
    } else if words <= MOST {
        evaluate(quantities, scene, bits, needed, &mut vec![0; 6 * words])
    } else {
        Err(ShellError::Outside)
    }
}

/// The bits of a word for errors and what they are multiplied by.
const ROOM: u32 = 58;

/// The bits of a word that the error of y may fill, so that the error of the quantity fits one too.
fn room(quantity: Quantity, scene: &Scene) -> Result<u32, ShellError> {
    let photon = 64 - (scene.k.above / scene.k.below).leading_zeros();
    let counts = match quantity {
        Quantity::Function => scene.shift,
        Quantity::Mean | Quantity::Excess => scene.shift + photon,
        // x = y 2^g, and an error of x counts (d s)/(d-p) <= s (2^g + 1) times, and a few times more.
        Quantity::Variance => 64 - scene.s.leading_zeros() + 2 * scene.shift + 2 * photon,
    };
    ROOM.checked_sub(counts)
        .filter(|&room| room > 0)
        .ok_or(ShellError::Outside)
}

/// As [`certified`], with six numbers' room, all 0.
fn evaluate<const N: usize>(
    quantities: [Quantity; N],
    scene: &Scene,
    bits: u32,
    needed: u32,
    buffer: &mut [u64],
) -> Result<[Interval; N], ShellError> {
    let words = buffer.len() / 6;
    let (y, work) = buffer.split_at_mut(words);
    let ulps = series::sum(scene, bits, y, work)?;
    let (x, work) = work.split_at_mut(words);
    each(quantities, |quantity| {
        x.copy_from_slice(y);
        let mut sum = Enclosed {
            integer: 0,
            x: &mut *x,
            ulps,
        };
        sum.shift(scene.shift);
        one(quantity, scene, sum, needed, work)
    })
}

/// A quantity from x, with four numbers' room.
fn one(
    quantity: Quantity,
    scene: &Scene,
    mut sum: Enclosed,
    needed: u32,
    work: &mut [u64],
) -> Result<Interval, ShellError> {
    if quantity != Quantity::Variance {
        sum.integer += 1;
    }
    let result = match quantity {
        Quantity::Function => sum.times(Fraction {
            above: scene.w.below - scene.w.above,
            below: scene.w.below,
        })?,
        Quantity::Mean => sum.times(scene.k)?,
        Quantity::Excess => {
            let mut mean = sum.times(scene.k)?;
            if mean.integer == 0 {
                return below_one(mean, needed);
            }
            mean.integer -= 1;
            mean
        }
        Quantity::Variance => variance(scene, sum, work)?,
    };
    result.certified(needed)
}

/// `mean - 1` for a mean below 1: `-(1 - x)` with `1 - x` an ulp more than the complement.
fn below_one(mut mean: Enclosed, needed: u32) -> Result<Interval, ShellError> {
    fixed::complement(mean.x);
    if fixed::sub_ulps(mean.x, mean.ulps) {
        return Err(ShellError::Lost);
    }
    mean.ulps = mean.ulps.checked_add(1).ok_or(ShellError::Lost)?;
    Ok(mean.certified(needed)?.neg())
}

impl Enclosed<'_> {
    /// n with a relative width of at most 2^-n, the rounding of an interval's ends included.
    fn accuracy(&self) -> u32 {
        let words = 64 * self.x.len() as u32;
        let above = 64 - self.integer.leading_zeros();
        let value = match above {
            0 => words - fixed::leading_zeros(self.x),
            _ => words + above,
        };
        // value >= 2^(value-1) ulps, and an end moves by less than 2^(above+1).
        let width = u128::from(self.ulps) + (4 << above);
        value.saturating_sub(129 - width.leading_zeros())
    }

    /// The interval, if it is as narrow as needed.
    fn certified(&self, needed: u32) -> Result<Interval, ShellError> {
        if self.accuracy() < needed {
            return Err(ShellError::Lost);
        }
        let precision = 64 * self.x.len() as u32;
        Ok(fixed::enclose(
            self.integer,
            self.x,
            self.ulps,
            0,
            precision,
        ))
    }

    /// Times 2^bits, bits < 64.
    fn shift(&mut self, bits: u32) {
        if bits > 0 {
            self.integer = fixed::mul_word(self.x, 1 << bits);
            self.ulps <<= bits;
        }
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

/// The variance from x, by the formula of the header. Where x is too small by e ulps at most, `mean(X^2)` is
/// too large by `(d s - p (q+1)) e/(d-p)`, and `x^2` too small by `2 x e + e^2 <= (2 i + 3) e`, i the integer part of x.
/// By rounding the first is too small by 2, the second by 1.
fn variance<'a>(
    scene: &Scene,
    mut sum: Enclosed<'a>,
    work: &mut [u64],
) -> Result<Enclosed<'a>, ShellError> {
    let (square, work) = work.split_at_mut(sum.x.len());
    let square_integer = squared(&sum, square, work).ok_or(ShellError::Outside)?;
    let rest = scene.w.below - scene.w.above;
    let (top, slope) = scene.second_moment().ok_or(ShellError::Outside)?;
    let ulps = u128::from(sum.ulps);
    let down =
        ulps * u128::from(slope) / u128::from(rest) + (2 * u128::from(sum.integer) + 3) * ulps + 2;
    let down = u64::try_from(down).map_err(|_| ShellError::Lost)?;
    // top - slope (i + x) = (top - slope i - carry - 1) + (1 - x'), the last too small by an ulp.
    let carry = fixed::mul_word(sum.x, slope);
    fixed::complement(sum.x);
    let taken = slope
        .checked_mul(sum.integer)
        .and_then(|t| t.checked_add(carry));
    let integer = taken.and_then(|t| top.checked_sub(t)?.checked_sub(1));
    let integer = integer.ok_or(ShellError::Lost)?;
    divide(sum.x, integer % rest, rest)?;
    let borrow = u64::from(fixed::sub(sum.x, square)) + u64::from(fixed::sub_ulps(sum.x, down));
    let integer = (integer / rest).checked_sub(square_integer);
    sum.integer = integer
        .and_then(|i| i.checked_sub(borrow))
        .ok_or(ShellError::Lost)?;
    sum.ulps = down.checked_add(2).ok_or(ShellError::Lost)?;
    sum.times(scene.k)?.times(scene.k)
}

/// The square of `i + x`, its lower end, rounded down: the part below 1 in `square`, the integer part returned.
fn squared(sum: &Enclosed, square: &mut [u64], work: &mut [u64]) -> Option<u64> {
    let n = sum.x.len();
    fixed::mul(square, sum.x, sum.x, work);
    if sum.integer == 0 {
        return Some(0);
    }
    let twice = &mut work[..n];
    twice.copy_from_slice(sum.x);
    let carry = fixed::mul_word(twice, 2 * sum.integer);
    let more = u64::from(fixed::add(square, twice));
    sum.integer
        .checked_mul(sum.integer)?
        .checked_add(carry)?
        .checked_add(more)
}

/// Less than the cost of every other method in its cheapest case.
const OTHERS: f64 = 35_000.0;

/// Whether no other method can be cheaper: without a look at them for the usual shells and up to a thousand
/// digits, where products of whole numbers gain nothing.
pub(super) fn is_cheapest(sketch: &Sketch, bits: u32) -> bool {
    (bits <= 3400 && sketch.w <= 0.5) || cost(sketch, bits) < OTHERS
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    if bits as usize > 64 * MOST {
        return f64::INFINITY;
    }
    let terms = sketch.pfaff_terms(f64::from(bits));
    if terms > 65_000.0 {
        return f64::INFINITY;
    }
    let blocks = terms / (64.0 / sketch.term_bits(terms)).floor().max(1.0);
    let words = f64::from(bits) / 64.0;
    1400.0 + 12.0 * terms + blocks * (220.0 + 14.0 * words) + 12.5 * words * words
}
