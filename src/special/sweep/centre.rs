//! The innermost shell: a = 0, so that k = l and the means are those of the Beta law (DLMF 5.12.1),
//! `E_k - 1 = 1/(k-1)` and `Var_k = k^2 (m-k+1)/((k-2) (k-1)^2 m)`; infinite for k = 1, the variance for k = 2.

use super::Column;
use super::plan::Neighbours;
use crate::special::digits_to_bits;
use rug::Integer;
use rug::integer::Order;

/// The variances are below 9/4: they are stored as a quarter of their value.
const QUARTER: i32 = 2;

pub(super) fn columns(block: &Neighbours, digits: u32) -> [Column; 2] {
    // Both values are at least 1/m^2, and are rounded down by at most two ulps.
    let bits = digits_to_bits(digits) + 2 * block.size.significant_bits() + 8;
    let length = bits.div_ceil(64) as usize;
    let one = Integer::from(1) << (64 * length as u32);
    let m = &block.size;
    // 1/(k-1) is 1 for k = 2: an ulp less is still within two.
    let excess = |k: &Integer| Integer::from(&one - 1u32) / Integer::from(k - 1u32);
    let variance = |k: &Integer| {
        let above = Integer::from(k * k) * (Integer::from(m - k) + 1u32);
        let below = Integer::from(k - 2u32) * Integer::from(k - 1u32).square() * m;
        (Integer::from(&one >> QUARTER as u32) * above) / below
    };
    [
        column(block, 1, length, 0, &excess),
        column(block, 2, length, QUARTER, &variance),
    ]
}

/// The values of all photons but the first `poles` of the shell.
fn column(
    block: &Neighbours,
    poles: u32,
    length: usize,
    exponent: i32,
    value: &dyn Fn(&Integer) -> Integer,
) -> Column {
    let finite = (0..block.count)
        .map(|index| block.place(index))
        .filter(|k| *k > poles);
    let mut words = Vec::with_capacity(length * block.count);
    for k in finite {
        let end = words.len() + length;
        words.extend(value(&k).to_digits::<u64>(Order::Lsf));
        words.resize(end, 0);
    }
    Column {
        infinite: block.count - words.len() / length,
        length,
        words,
        ulps: 2,
        exponent,
    }
}
