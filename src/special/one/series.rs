//! S and T by two series of positive terms, in words: nothing cancels, so no bit is lost at any k.
//!
//! With t = 1/(2k-1), k/(k-1) = (1+t)/(1-t) and k = (1+t)/(2t). So S = (1+t) artanh(t)/t (DLMF 4.37.24), and
//! T = (1+t)^2 (1/(1-t^2) - (artanh(t)/t)^2). By the series of artanh (DLMF 4.38.5), whose square has the
//! coefficients `a_j = (1/(j+1)) (1 + 1/3 + ... + 1/(2j+1))`, and with p_j = t^(2j-2), d_j = 1 - a_j,
//!
//! ```text
//! S - 1 = t (1 + t (1+t) sigma),     sigma = sum over j >= 1 of p_j/(2j+1),
//! T = (1+t)^2 t^2 tau,               tau   = sum over j >= 1 of d_j p_j,
//! d_1 = 1/3,   d_j = (j d_{j-1} + 2j/(2j+1))/(j+1),   0 < d_j < 1.
//! ```
//!
//! **Error**, in ulps, every quotient rounded down, so that all comes out too small. Let Q = (2k-1)^2 >= 9.
//! p_j, from p_{j-1}/Q, is within 1 + 2/9 < 2. A term of sigma is within 2/(2j+1) + 1 < 2. A term D_j = d_j p_j of tau is
//! (j (D_{j-1}/Q) + 2j (p_j/(2j+1)))/(j+1), each bracket rounded down; with D_{j-1} within 5 it is within
//! (j (1 + 5/9) + 2j + 2)/(j+1) + 1 < 5. The sums stop where p_{n+1} < 2 ulps; what is left out, less than p_{n+1}/(1 - 1/9)
//! of either, is below 3. So after n terms, the first of them 1/3, sigma is within 2n + 2, tau within 5n.
//!
//! Then t and 1+t = 2k t are put in, by words, and a scale 2^s <= (2k-1)/2, so that the numbers held,
//! 2^s (S-1) and 2^(2s) T, are neither small nor above 1: 1/4 and 1/48 at least if 2^s is the largest such. Following the factors
//! (4/3, 1/3, 1/2 and 4/3, 4/3, 1/2, 1/2, and an ulp each) gives n + 3 and 3n + 3.

use super::Values;
use crate::number::fixed::{self, Divisor};
use crate::special::digits_to_bits;
use rug::Integer;

/// The numbers of words with code of their own.
const MOST_WORDS: u32 = 8;

/// The bits that the error of a photon alone takes: (3n + 3) 48 < 2^15, as n < 500.
const LOST: u32 = 15;

/// Values of consecutive photons: x stands for anything between x 2^exponent and (x + ulps) 2^exponent.
pub(in crate::special) struct Column {
    pub(in crate::special) words: Vec<u64>,
    pub(in crate::special) length: usize,
    pub(in crate::special) ulps: u64,
    pub(in crate::special) exponent: i32,
}

/// The odd number 2k-1 where its square is a word and k >= 2.
fn odd(k: &Integer) -> Option<u64> {
    let k = k.to_u64().filter(|k| (2..1 << 31).contains(k))?;
    Some(2 * k - 1)
}

pub(super) fn cost(k: &Integer, bits: u32) -> Option<f64> {
    let words = f64::from((bits + LOST).div_ceil(64));
    let terms = words * 32.0 / (odd(k)? as f64).log2() + 1.0;
    (words <= f64::from(MOST_WORDS)).then_some(400.0 + terms * (40.0 + 20.0 * words))
}

pub(super) fn values(k: &Integer, bits: u32) -> Option<Values> {
    let [excess, variance] = within(k, 1, bits + LOST)?;
    let enclose = |integer: u64, column: &Column| {
        fixed::enclose(integer, &column.words, column.ulps, column.exponent, bits)
    };
    Some(Values {
        mean: enclose(1 << -excess.exponent, &excess),
        excess: enclose(0, &excess),
        variance: enclose(0, &variance),
    })
}

/// S - 1 and T of `count` photons from `first` on, with relative widths below 10^-digits; `None`
/// outside the domain.
pub(in crate::special) fn columns(
    first: &Integer,
    count: usize,
    digits: u32,
) -> Option<[Column; 2]> {
    // The scale is that of the first photon; T of the last is smaller by the square of their ratio.
    let last = Integer::from(first + count as u64);
    let fall = 2 * (last.significant_bits() - first.significant_bits() + 1);
    within(first, count, digits_to_bits(digits) + fall + LOST)
}

/// The same, with ulps of at most 2^-bits.
fn within(first: &Integer, count: usize, bits: u32) -> Option<[Column; 2]> {
    let run = match bits.div_ceil(64) {
        0 | 1 => run::<1>,
        2 => run::<2>,
        3 => run::<3>,
        4 => run::<4>,
        5 => run::<5>,
        6 => run::<6>,
        7 => run::<7>,
        MOST_WORDS => run::<8>,
        _ => return None,
    };
    odd(&Integer::from(first + count as u64))?;
    run(odd(first)?, count)
}

fn run<const N: usize>(first: u64, count: usize) -> Option<[Column; 2]> {
    let shift = first.ilog2() - 1;
    let mut small = Small(Vec::new());
    let mut terms = 0;
    let mut values = [Vec::with_capacity(count * N), Vec::with_capacity(count * N)];
    for index in 0..count as u64 {
        let odd = Odd::new(first + 2 * index, shift)?;
        let (sums, n) = odd.sums::<N>(&mut small)?;
        // Fewer and fewer terms as k grows.
        terms = terms.max(n);
        let [sigma, tau] = sums;
        values[0].extend(odd.excess(sigma));
        values[1].extend(odd.variance(tau));
    }
    let [excess, variance] = values;
    let column = |words, ulps, scale: u32| Column {
        words,
        length: N,
        ulps,
        exponent: -(scale as i32),
    };
    Some([
        column(excess, terms + 3, shift),
        column(variance, 3 * terms + 3, 2 * shift),
    ])
}

/// The divisors of all photons: 2j+1 and j+1, j = 0, 1, 2, ...
struct Small(Vec<[Divisor; 2]>);

impl Small {
    #[inline]
    fn at(&mut self, j: u64) -> Option<[Divisor; 2]> {
        while self.0.len() as u64 <= j {
            let next = self.0.len() as u64;
            self.0
                .push([Divisor::new(2 * next + 1)?, Divisor::new(next + 1)?]);
        }
        self.0.get(j as usize).copied()
    }
}

/// 2k-1, its square, and the scale of its block.
struct Odd {
    odd: Divisor,
    square: Divisor,
    shift: u32,
}

impl Odd {
    fn new(odd: u64, shift: u32) -> Option<Odd> {
        Some(Odd {
            odd: Divisor::new(odd)?,
            square: Divisor::new(odd * odd)?,
            shift,
        })
    }

    /// sigma, tau and how many terms each has.
    #[inline]
    fn sums<const N: usize>(&self, small: &mut Small) -> Option<([[u64; N]; 2], u64)> {
        let mut sigma = [0; N];
        fixed::div_word(&mut sigma, 1, &small.at(1)?[0]);
        let (mut tau, mut last) = (sigma, sigma);
        let mut power = [0; N];
        fixed::div_word(&mut power, 1, &self.square);
        let mut j = 2;
        while power != [0; N] {
            let [odd, next] = small.at(j)?;
            let mut part = power;
            fixed::div_word(&mut part, 0, &odd);
            fixed::add(&mut sigma, &part);
            fixed::mul_word(&mut part, 2 * j);
            fixed::div_word(&mut last, 0, &self.square);
            fixed::mul_word(&mut last, j);
            fixed::add(&mut last, &part);
            fixed::div_word(&mut last, 0, &next);
            fixed::add(&mut tau, &last);
            fixed::div_word(&mut power, 0, &self.square);
            j += 1;
        }
        Some(([sigma, tau], j - 1))
    }

    /// `x := x*factor/odd` rounded down, where that is below 1.
    #[inline]
    fn scale<const N: usize>(&self, x: &mut [u64; N], factor: u64) {
        let integer = fixed::mul_word(x, factor);
        fixed::div_word(x, integer, &self.odd);
    }

    /// `2^shift (S-1) = (2^shift + 2^shift (2k/odd) sigma/odd)/odd`
    #[inline]
    fn excess<const N: usize>(&self, mut x: [u64; N]) -> [u64; N] {
        let unit = 1 << self.shift;
        self.scale(&mut x, self.odd.value() + 1);
        self.scale(&mut x, 1);
        let integer = fixed::mul_word(&mut x, unit);
        fixed::div_word(&mut x, integer + unit, &self.odd);
        x
    }

    /// `2^(2 shift) T = (2k/odd)^2 (2^shift/odd)^2 tau`
    #[inline]
    fn variance<const N: usize>(&self, mut x: [u64; N]) -> [u64; N] {
        let twice = self.odd.value() + 1;
        for factor in [twice, twice, 1 << self.shift, 1 << self.shift] {
            self.scale(&mut x, factor);
        }
        x
    }
}
