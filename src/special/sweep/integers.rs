//! A block in GMP's integers, for any number of digits and any size of the shell: the relations of the
//! parent as they stand, every value a multiple of 2^-scale.

use super::Column;
use super::plan::{Neighbours, Plan, slope};
use super::start::start;
use crate::number::DomainError;
use rug::Integer;
use rug::integer::Order;

pub(super) fn columns(block: &Neighbours, plan: &Plan) -> Result<[Column; 2], DomainError> {
    // Whole words for e, so that 1 can be added to it.
    let cut = cut(&plan.excess_ulps);
    let plan = &plan.with_scale(plan.scale.saturating_sub(cut).next_multiple_of(64) + cut);
    let means = means(block, plan)?;
    let excesses = || {
        means
            .iter()
            .enumerate()
            .map(|(index, g)| excess(block, plan, index, g))
    };
    let variances = || {
        excesses()
            .enumerate()
            .map(|(index, e)| variance(block, plan, index, e))
    };
    // Var_k <= l/a, from (2).
    let most = block.place(block.count - 1) / &block.inner;
    Ok([
        column(excesses(), &plan.excess_ulps, plan.scale, 0),
        column(
            variances(),
            &plan.variance_ulps,
            plan.scale,
            most.significant_bits(),
        ),
    ])
}

/// g of all photons, outwards from the start.
pub(super) fn means(block: &Neighbours, plan: &Plan) -> Result<Vec<Integer>, DomainError> {
    let (a, m, b) = (&block.inner, &block.size, block.outer());
    let whole = Integer::from(m << plan.scale);
    let mut means = vec![Integer::new(); block.count];
    means[plan.start] = start(block, &block.place(plan.start), plan.scale)?;
    // The factors (m-l) a and l b of (1), at the l of an index and the next.
    let factors = |index: usize| {
        let l = block.place(index);
        (Integer::from(m - &l) * a, l * &b)
    };
    for index in plan.start..block.count - 1 {
        let (near, far) = factors(index);
        means[index + 1] = (&whole - near * &means[index]) / far;
    }
    for index in (0..plan.start).rev() {
        let (near, far) = factors(index);
        means[index] = (&whole - far * &means[index + 1]) / near;
    }
    Ok(means)
}

/// e = k g - 1
fn excess(block: &Neighbours, plan: &Plan, index: usize, g: &Integer) -> Integer {
    let k = &block.inner + block.place(index);
    k * g - (Integer::from(1) << plan.scale)
}

/// Equation (2).
fn variance(block: &Neighbours, plan: &Plan, index: usize, e: Integer) -> Integer {
    let (a, b, l) = (&block.inner, block.outer(), block.place(index));
    let line = (Integer::from(&l * &b) << plan.scale) - slope(a, &block.size, &l) * &e;
    line / Integer::from(a * &b) - (e.square() >> plan.scale)
}

/// How many bits are cut off the values, so that a bound of their errors is about half a word.
fn cut(ulps: &Integer) -> u32 {
    ulps.significant_bits().saturating_sub(32)
}

/// Values within `ulps`, each below 2^whole, as words.
fn column(values: impl Iterator<Item = Integer>, ulps: &Integer, scale: u32, whole: u32) -> Column {
    let cut = cut(ulps);
    let ulps_kept = Integer::from(ulps >> cut) + 1u32;
    let length = (scale + whole - cut).div_ceil(64).max(1);
    let mut words = Vec::new();
    for value in values {
        let end = words.len() + length as usize;
        let low = (value >> cut) - &ulps_kept;
        words.extend(low.to_digits::<u64>(Order::Lsf));
        words.resize(end, 0);
    }
    Column {
        infinite: 0,
        length: length as usize,
        words,
        // Below: the bound and what was cut off; above: the bound.
        ulps: 2 * ulps_kept.to_u64_wrapping() + 1,
        exponent: (64 * length + cut) as i32 - scale as i32,
    }
}
