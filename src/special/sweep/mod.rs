//! Whole shells and sweeps: `E_k`, `E_k - 1` and `Var_k` of all photons `first..=last` of a layout, as one
//! operation.
//!
//! Photon `k = a + l` is the l-th of the m in a shell of volume m around the volume a > 0. Let
//! `U = a + m x`, `x ~ Beta(l, m-l+1)`, let `g_l` be the mean of 1/U and e = k g_l - 1, so that `E_k = 1 + e`.
//!
//! **Relation** (DLMF 15.5(ii) for a = 1, proved here in a line). For 1 <= l < m
//!
//! ```text
//! (m-l) a g_l + l (a+m) g_{l+1} = m                                                        (1)
//! ```
//!
//! Proof. `a (1-x) + (a+m) x = U`. Times `x^(l-1) (1-x)^(m-l-1)/U` and integrated over 0..1 that is
//! `a B(l, m-l+1) g_l + (a+m) B(l+1, m-l) g_{l+1} = B(l, m-l)`; and `B(l, m-l+1) = B(l, m-l) (m-l)/m`,
//! `B(l+1, m-l) = B(l, m-l) l/m` (DLMF 5.12.1, 5.5.1). QED.
//!
//! **Variance.** With D = a (a+m), b = a + m and S the mean of 1/U^2
//!
//! ```text
//! D Var_k = l (a+m) - C e - D e^2,     C = 2 D + k (k m - a - m)                             (2)
//! ```
//!
//! Proof. The derivative of `x^l (1-x)^(m-l+1)/U` integrates to 0. Written in U, where `m x = U - a` and
//! `m (1-x) = b - U`, it says `D S = m - ((m-1) a + (l-1) m) g_l` (equation 2.30 of the thesis). Put
//! g_l = (1+e)/k into k^2 (S - g_l^2): the terms without e add up to l (a+m). QED.
//! Nothing cancels in (2) but `l/a` with `C e/D`, which agree to about `2 log2 m` bits, where equation 2.104
//! of the thesis loses `2 log2 k`, twice that. The precision is planned for it (`plan.rs`).
//!
//! **Theorem (outwards from the middle).** Let l* = m a/(2a+m). Let g be known at one l to `c` ulps. Going up
//! by (1) from an l >= l*, or down from an l <= l* + 1, each value rounded down to an ulp, every value is
//! within `c + min(n, J)` ulps after n steps, J the least integer with J^2 >= m.
//!
//! Proof. One step up has `g_{l+1} = (m - (m-l) a g_l)/(l (a+m))`: the error is multiplied by
//! -rho, rho = (m-l) a/(l (a+m)), and the rounding adds at most 1, so `c_{i+1} <= rho_i c_i + 1`.
//! `1 - rho = (2a+m)(l - l*)/(l (a+m)) >= (l - l*)/m`, since 2a+m >= a+m and l <= m; the i-th step
//! (i = 0, 1, ...) has l >= l* + i, so `rho_i <= 1 - i/m`. A step down to l multiplies by
//! sigma = 1/rho, and `1 - sigma = (2a+m)(l* - l)/((m-l) a) >= 2 (l* - l)/m`; here l <= l* - i for
//! i = 0, 1, ..., so `sigma_i <= 1 - i/m` too. Hence c_n <= c + n. For n = J that is c + J; and if i >= J and
//! c_i <= c + J then `c_{i+1} <= c + J - i (c + J)/m + 1 <= c + J`, as i J >= J^2 >= m. QED.
//!
//! Started at an end of the shell the same relation multiplies the error by 2^m (`tests.rs` shows it).
//!
//! Shells of one photon (strategy 1) need no relation: blocks of them are made by [`super::one`]'s series.
//!
//! **Cost.** A photon costs five products or quotients of a number by one word and one square; the start
//! of a block, of up to some thousand neighbours, a series of as many terms as its digits need.

mod centre;
mod integers;
mod plan;
mod start;
mod words;

use super::one;
use crate::model::{Layout, Shell, Walk};
use crate::number::{DomainError, Interval, fixed};
use plan::{Neighbours, Plan};
use rug::Integer;

/// Blocks hold no more photons than this, so that a sweep over huge shells needs little memory.
const MOST_PHOTONS: u32 = 1 << 12;

/// All photons `first..=last` of a layout in blocks of neighbours in one shell, innermost first; made
/// by [`sweep`].
#[derive(Clone, Debug)]
pub struct Sweep<'a> {
    layout: &'a Layout,
    walk: Walk<'a>,
    /// What is left of the shell at hand.
    rest: Option<(Integer, Shell)>,
    last: Integer,
    digits: u32,
}

/// Neighbours in one shell, with their values.
#[derive(Clone, Debug)]
pub struct Block {
    first: Integer,
    count: usize,
    excess: Column,
    variance: Column,
}

/// One value a photon, all with the same number of words and the same bound of the error.
#[derive(Clone, Debug)]
struct Column {
    /// How many photons at the start have the value `+inf`; they have no words.
    infinite: usize,
    length: usize,
    words: Vec<u64>,
    ulps: u64,
    exponent: i32,
}

/// A photon of a [`Block`].
#[derive(Clone, Copy, Debug)]
pub struct Photon<'a> {
    block: &'a Block,
    index: usize,
}

/// A certified number in fixed point: it lies between `(integer + x) 2^exponent` and
/// `(integer + x + ulps) 2^exponent`, x as in [`crate::number::fixed`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Value<'a> {
    pub integer: u64,
    pub words: &'a [u64],
    pub ulps: u64,
    pub exponent: i32,
}

/// `E_k`, `E_k - 1` and `Var_k` (of k/U) of the photons `first..=last`, as enclosures whose relative width
/// is below `10^-digits`. Photons that the layout has not are left out.
///
/// ```
/// use claimcheck::model::Layout;
/// use claimcheck::special::sweep::sweep;
/// for block in sweep(&Layout::Triangular, &5050.into(), &5052.into(), 50) {
///     for photon in block.expect("it converges").photons() {
///         let mean = photon.mean().expect("it is finite").enclose(200);
///         assert!(mean.agrees_to(50) && *mean.low() > 1);
///     }
/// }
/// ```
///
/// # Errors
/// The items of the sweep: `Possible` where a shell is so thick that the value it is started from is
/// out of reach of [`super::hyp2f1`].
pub fn sweep<'a>(layout: &'a Layout, first: &Integer, last: &Integer, digits: u32) -> Sweep<'a> {
    Sweep {
        layout,
        walk: layout.walk(first),
        rest: None,
        last: last.clone(),
        digits,
    }
}

impl Iterator for Sweep<'_> {
    type Item = Result<Block, DomainError>;

    fn next(&mut self) -> Option<Self::Item> {
        let (first, mut shell) = self.rest.take().or_else(|| self.walk.next())?;
        if first > self.last {
            return None;
        }
        let wanted = Integer::from(&self.last - &first) + 1u32;
        let wanted = wanted.min(MOST_PHOTONS.into());
        if let Some(block) = self.one_by_one(&first, wanted.to_usize_wrapping()) {
            return Some(Ok(block));
        }
        let left = Integer::from(&shell.count - &shell.position) + 1u32;
        let some = wanted.min(left.clone());
        let neighbours = Neighbours::new(&shell, some.to_usize_wrapping());
        if some < left {
            shell.position += &some;
            self.rest = Some((Integer::from(&first + &some), shell));
        }
        Some(neighbours.block(first, self.digits))
    }
}

impl Sweep<'_> {
    /// A block of shells of one photon each, where the series for them reaches.
    fn one_by_one(&mut self, first: &Integer, count: usize) -> Option<Block> {
        if *self.layout != Layout::One {
            return None;
        }
        let columns = one::columns(first, count, self.digits)?;
        self.walk = self.layout.walk(&Integer::from(first + count as u64));
        let [excess, variance] = columns.map(|column| Column {
            infinite: 0,
            length: column.length,
            words: column.words,
            ulps: column.ulps,
            exponent: column.exponent,
        });
        let first = first.clone();
        Some(Block {
            first,
            count,
            excess,
            variance,
        })
    }
}

impl Neighbours {
    fn block(&self, first: Integer, digits: u32) -> Result<Block, DomainError> {
        let [excess, variance] = if self.inner == 0 {
            centre::columns(self, digits)
        } else {
            let plan = Plan::new(self, digits);
            match words::columns(self, &plan)? {
                Some(columns) => columns,
                None => integers::columns(self, &plan)?,
            }
        };
        let count = self.count;
        Ok(Block {
            first,
            count,
            excess,
            variance,
        })
    }
}

impl Block {
    /// The photons, innermost first.
    pub fn photons(&self) -> impl Iterator<Item = Photon<'_>> {
        (0..self.count).map(|index| Photon { block: self, index })
    }
}

impl Photon<'_> {
    /// k
    pub fn number(&self) -> Integer {
        Integer::from(&self.block.first + self.index as u64)
    }

    /// `E_k - 1`; `None` where it is `+inf`.
    pub fn excess(&self) -> Option<Value<'_>> {
        self.block.excess.value(self.index)
    }

    /// `E_k`, the mean of k/U; `None` where it is `+inf`.
    pub fn mean(&self) -> Option<Value<'_>> {
        let excess = self.excess()?;
        let integer = excess.integer + (1 << -excess.exponent);
        Some(Value { integer, ..excess })
    }

    /// `Var_k`, the variance of k/U; `None` where it is `+inf`.
    pub fn variance(&self) -> Option<Value<'_>> {
        self.block.variance.value(self.index)
    }
}

impl Column {
    fn value(&self, index: usize) -> Option<Value<'_>> {
        let start = index.checked_sub(self.infinite)? * self.length;
        Some(Value {
            integer: 0,
            words: &self.words[start..start + self.length],
            ulps: self.ulps,
            exponent: self.exponent,
        })
    }
}

impl Value<'_> {
    /// The narrowest interval with ends of `precision` bits that holds both ends.
    pub fn enclose(&self, precision: u32) -> Interval {
        fixed::enclose(
            self.integer,
            self.words,
            self.ulps,
            self.exponent,
            precision,
        )
    }
}

#[cfg(test)]
mod tests;
