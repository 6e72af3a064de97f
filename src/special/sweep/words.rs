//! A block in fixed point on a few machine words: for a >= m where all factors of one word suffice.
//!
//! With t the largest power of two that is at most a/2, the numbers t g, t e and t Var_k are held as N
//! words, an ulp being 2^(-64 N)/t. They are below 1: g < 1/a, e < 1/a (see `plan.rs`), and
//! `Var_k <= k^2 s2/a^4 < 1/a`, as k <= a+m <= 2a and s2 < m/4 <= a/4. The common divisor of a and m is taken
//! out of (1) and (2), and t is put in:
//!
//! ```text
//! (m-l) a' g_l + l b' g_{l+1} = m' t,      D' Var_k = l b' t - C' e - D' e^2/t
//! ```
//!
//! Each right side is an integer less a product: the integer less its whole part less 1, and the
//! complement of its fraction, which is one ulp short. Before a division by a word d that makes
//! `floor((X-1)/d) >= X/d - 1`, so no step is off by more than the ulp that the theorem allows; and the quotient
//! of a positive integer X less 1 is not negative. What stands before the point is less than d, as the quotient
//! is below 1 (the sum of t Var_k and t e^2 is below 1/2 + 1/4).

use super::Column;
use super::plan::{Neighbours, Plan, slope};
use super::start::start;
use crate::number::DomainError;
use crate::number::fixed::{self, Divisor};
use rug::Integer;
use rug::integer::Order;

/// The numbers of words with code of their own.
const MOST_WORDS: u32 = 8;

/// What is the same for the whole shell; one word each.
struct Shell {
    /// a, and t = 2^shift.
    inner: u64,
    shift: u32,
    size: u64,
    /// a', b', m' t and D'
    near: u64,
    far: u64,
    whole: u64,
    below: Divisor,
    /// C' = 2 D' + k (k m' - b')
    twice_below: u64,
    reduced_size: u64,
}

/// `None` where the block needs more words, or a < m, or larger factors.
///
/// # Errors
/// As [`start`].
pub(super) fn columns(block: &Neighbours, plan: &Plan) -> Result<Option<[Column; 2]>, DomainError> {
    let Some(shell) = Shell::new(block) else {
        return Ok(None);
    };
    let count = plan.scale.saturating_sub(shell.shift).div_ceil(64);
    let run = match count {
        0 | 1 => run::<1>,
        2 => run::<2>,
        3 => run::<3>,
        4 => run::<4>,
        5 => run::<5>,
        6 => run::<6>,
        7 => run::<7>,
        MOST_WORDS => run::<8>,
        _ => return Ok(None),
    };
    let plan = plan.with_scale(64 * count.max(1) + shell.shift);
    run(&shell, block, &plan)
}

impl Shell {
    fn new(block: &Neighbours) -> Option<Shell> {
        if block.inner < block.size || block.inner < 2 {
            return None;
        }
        let (a, m, b) = (&block.inner, &block.size, block.outer());
        let common = Integer::from(a.gcd_ref(m));
        let [near, far, reduced] = [a, &b, m].map(|x| Integer::from(x / &common));
        let below = Integer::from(a * &far);
        let shift = a.significant_bits() - 2;
        // The largest of each kind in the shell must fit: l = m.
        let fits = [
            slope(a, m, m) / &common,
            Integer::from(m * &far) << shift,
            Integer::from(m * &near),
        ];
        if fits.iter().any(|x| x.to_u64().is_none()) {
            return None;
        }
        Some(Shell {
            inner: a.to_u64()?,
            shift,
            size: m.to_u64()?,
            whole: (Integer::from(&reduced) << shift).to_u64()?,
            twice_below: Integer::from(&below * 2u32).to_u64()?,
            below: Divisor::new(below.to_u64()?)?,
            near: near.to_u64()?,
            far: far.to_u64()?,
            reduced_size: reduced.to_u64()?,
        })
    }

    /// g at l+1 from that at l.
    #[inline]
    fn up<const N: usize>(&self, g: &mut [u64; N], l: u64) {
        solve(g, (self.size - l) * self.near, self.whole, l * self.far);
    }

    /// g at l from that at l+1.
    #[inline]
    fn down<const N: usize>(&self, g: &mut [u64; N], l: u64) {
        solve(g, l * self.far, self.whole, (self.size - l) * self.near);
    }

    /// t e = k t g - t: the whole part of the product is t.
    #[inline]
    fn excess<const N: usize>(&self, g: &[u64; N], l: u64) -> [u64; N] {
        let mut e = *g;
        let whole = fixed::mul_word(&mut e, self.inner + l);
        debug_assert_eq!(whole, 1 << self.shift);
        e
    }

    #[inline]
    fn variance<const N: usize>(&self, e: &[u64; N], l: u64) -> [u64; N] {
        let k = self.inner + l;
        let slope = self.twice_below + k * (k * self.reduced_size - self.far);
        let mut line = *e;
        let whole = fixed::mul_word(&mut line, slope);
        fixed::complement(&mut line);
        fixed::div_word(
            &mut line,
            ((l * self.far) << self.shift) - whole - 1,
            &self.below,
        );
        let square = square(e, self.shift);
        fixed::sub(&mut line, &square);
        line
    }
}

/// `x := (whole - factor*x)/divisor`, rounded down by an ulp at most.
#[inline]
fn solve<const N: usize>(x: &mut [u64; N], factor: u64, whole: u64, divisor: u64) {
    let product = fixed::mul_word(x, factor);
    fixed::complement(x);
    let integer = whole - product - 1;
    if let Some(divisor) = Divisor::new(divisor) {
        fixed::div_word(x, integer, &divisor);
    }
}

/// (t e)^2/t, at most two ulps too small.
#[inline]
fn square<const N: usize>(e: &[u64; N], shift: u32) -> [u64; N] {
    let mut square = [0; N];
    let mut work = [0; 2 * MOST_WORDS as usize];
    fixed::mul(&mut square, e, e, &mut work[..2 * N]);
    shift_right(&mut square, shift);
    square
}

/// `x := x/2^shift` rounded down, shift < 64.
#[inline]
fn shift_right<const N: usize>(x: &mut [u64; N], shift: u32) {
    for i in 0..N {
        let above = x.get(i + 1).copied().unwrap_or(0);
        x[i] = ((u128::from(above) << 64 | u128::from(x[i])) >> shift) as u64;
    }
}

/// The columns of a block, outwards from its start.
fn run<const N: usize>(
    shell: &Shell,
    block: &Neighbours,
    plan: &Plan,
) -> Result<Option<[Column; 2]>, DomainError> {
    let bounds =
        [&plan.excess_ulps, &plan.variance_ulps].map(|ulps| ulps.to_u64().filter(|n| n >> 62 == 0));
    let ([Some(excess_ulps), Some(variance_ulps)], Some(position)) =
        (bounds, block.position.to_u64())
    else {
        return Ok(None);
    };
    let first = start(block, &block.place(plan.start), plan.scale)?;
    let mut g = [0; N];
    first.write_digits(&mut g, Order::Lsf);
    let mut excess = vec![[0; N]; block.count];
    let mut variance = vec![[0; N]; block.count];
    let mut keep = |index: usize, g: &[u64; N]| {
        let l = position + index as u64;
        let mut e = shell.excess(g, l);
        let mut v = shell.variance(&e, l);
        fixed::sub_ulps(&mut e, excess_ulps);
        fixed::sub_ulps(&mut v, variance_ulps);
        excess[index] = e;
        variance[index] = v;
    };
    let middle = g;
    keep(plan.start, &g);
    for index in plan.start + 1..block.count {
        shell.up(&mut g, position + index as u64 - 1);
        keep(index, &g);
    }
    g = middle;
    for index in (0..plan.start).rev() {
        shell.down(&mut g, position + index as u64);
        keep(index, &g);
    }
    let column = |words: Vec<[u64; N]>, ulps: u64| Column {
        infinite: 0,
        length: N,
        words: words.into_flattened(),
        ulps: 2 * ulps,
        exponent: -(shell.shift as i32),
    };
    Ok(Some([
        column(excess, excess_ulps),
        column(variance, variance_ulps),
    ]))
}
