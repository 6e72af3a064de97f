//! The series of `words` itself: x in fixed point.

use super::divide;
use crate::number::fixed;
use crate::special::shell::ShellError;
use crate::special::shell::scene::Scene;

/// The most terms: the bound of the floats' errors holds up to here.
const MOST_TERMS: u64 = 1 << 16;

/// 2^64
const WORD: f64 = 18_446_744_073_709_551_616.0;

/// The y with `x = y 2^shift` of the header, rounded down, and x to about 2^-bits. What y may be too small by,
/// in ulps. `work` holds as many words.
pub(super) fn sum(
    scene: &Scene,
    bits: u32,
    y: &mut [u64],
    work: &mut [u64],
) -> Result<u64, ShellError> {
    let (p, d) = (scene.w.above, scene.w.below);
    let shift = scene.shift;
    let mut plan = Plan {
        crossings: work,
        known: 0,
    };
    let terms = plan.terms(scene, bits)?;
    // The last and largest p (q+j) and d (s+j), and one more.
    let last = scene.s.checked_add(terms).and_then(|s| s.checked_mul(d));
    let mut below = last.ok_or(ShellError::Outside)?;
    let mut above = p * (scene.q + terms);
    let most = u64::MAX >> shift;
    if below > most {
        return Err(ShellError::Outside);
    }
    let mut left = terms;
    let mut blocks = 0;
    while left > 0 {
        (above, below, left) = (above - p, below - d, left - 1);
        let (mut a, mut b, mut c) = (above, above, below);
        while left > 0 {
            let product = c.checked_mul(below - d).filter(|&c| c <= most);
            let Some(product) = product else { break };
            (above, below, left) = (above - p, below - d, left - 1);
            // x_j = above/below (1 + (a + b x)/c) < 2^shift for all x >= 0, so that a < c 2^shift is a word.
            (a, b, c) = (above * (c + a), above * b, product);
        }
        block(&mut y[plan.cut(left)..], (a, b, c), shift)?;
        blocks += 1;
    }
    Ok(blocks + (1 << (64 * y.len() as u32 - shift - bits)))
}

/// `y := (a 2^-shift + b y)/c`, rounded down; less than 1.
fn block(y: &mut [u64], (a, b, c): (u64, u64, u64), shift: u32) -> Result<(), ShellError> {
    let carry = fixed::mul_word(y, b);
    let mut integer = (a >> shift) + carry;
    if shift > 0
        && let Some(first) = y.last_mut()
    {
        let (sum, overflow) = first.overflowing_add(a << (64 - shift));
        *first = sum;
        integer += u64::from(overflow);
    }
    divide(y, integer, c)
}

/// How many terms, and how many words a block needs.
struct Plan<'a> {
    /// The least j with `T_j <= 2^(-64 (i+1))`, for the first i.
    crossings: &'a mut [u64],
    known: usize,
}

impl Plan<'_> {
    /// The least n, about, with `T_n W <= 2^-bits`.
    ///
    /// Errors of the floats, u = 2^-53, n <= 2^16: `above` and `below` are off by at most n+2 units u, as sums of n+1 positive
    /// numbers; a quotient and a product add two. So the product of n ratios is off by a factor within
    /// `1 + n (2n+6) u` < 1 + 2^-19, and the first factor 1 + 2^-16 covers it.
    fn terms(&mut self, scene: &Scene, bits: u32) -> Result<u64, ShellError> {
        let (p, d) = (scene.w.above as f64, scene.w.below as f64);
        let ratio = p / (scene.w.below - scene.w.above) as f64;
        let (mut above, mut below) = (p * scene.q as f64, d * scene.s as f64);
        let mut goal = power(-i64::from(bits));
        // T_n W 2^(64 known), too large; and what it is where T_n 2^(64 known) = 2^-64.
        let mut size = ratio * (1.0 + 1.0 / 65536.0);
        let crossing = ratio / WORD;
        for n in 0..MOST_TERMS {
            if size <= goal {
                return Ok(n);
            }
            if size <= crossing {
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
