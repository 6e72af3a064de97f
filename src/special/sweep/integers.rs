//! A block in GMP's integers, for any number of digits and any size of the shell: the relations of the
//! parent as they stand, every value a multiple of 2^-scale. Work is done in place: at a thousand digits a
//! photon costs two quotients by a short number, a square, and little else.

use super::Column;
use super::plan::{Neighbours, Plan};
use super::start::start;
use crate::number::DomainError;
use rug::integer::Order;
use rug::ops::SubFrom;
use rug::{Assign, Integer};

pub(super) fn columns(block: &Neighbours, plan: &Plan) -> Result<[Column; 2], DomainError> {
    // Whole words for e, so that 1 can be added to it.
    let cut = cut(&plan.excess_ulps);
    let plan = &plan.with_scale(plan.scale.saturating_sub(cut).next_multiple_of(64) + cut);
    // Var_k <= l/a, from (2).
    let most = block.place(block.count - 1) / &block.inner;
    let mut excess = Rounded::new(block, &plan.excess_ulps, plan.scale, 0);
    let whole = most.significant_bits();
    let mut variance = Rounded::new(block, &plan.variance_ulps, plan.scale, whole);
    let mut photon = Photon::new(block, plan);
    outwards(block, plan, |index, g| {
        photon.set(index, g);
        excess.put(index, &mut photon.excess);
        variance.put(index, &mut photon.variance);
    })?;
    Ok([excess.column, variance.column])
}

/// Shows g of all photons, outwards from the start.
///
/// # Errors
/// As [`start`].
pub(super) fn outwards(
    block: &Neighbours,
    plan: &Plan,
    mut show: impl FnMut(usize, &Integer),
) -> Result<(), DomainError> {
    let (a, m, b) = (&block.inner, &block.size, block.outer());
    let whole = Integer::from(m << plan.scale);
    let middle = start(block, &block.place(plan.start), plan.scale)?;
    show(plan.start, &middle);
    // The factors (m-l) a and l b of (1), at the l of the start.
    let l = block.place(plan.start);
    let (mut near, mut far) = (Integer::from(m - &l) * a, l * &b);
    let (mut up, first) = (middle.clone(), (near.clone(), far.clone()));
    for index in plan.start + 1..block.count {
        solve(&mut up, &near, &whole, &far);
        show(index, &up);
        near -= a;
        far += &b;
    }
    (near, far) = first;
    let mut down = middle;
    for index in (0..plan.start).rev() {
        near += a;
        far -= &b;
        solve(&mut down, &far, &whole, &near);
        show(index, &down);
    }
    Ok(())
}

/// `x := (whole - factor*x)/divisor` rounded down.
fn solve(x: &mut Integer, factor: &Integer, whole: &Integer, divisor: &Integer) {
    *x *= factor;
    x.sub_from(whole);
    *x /= divisor;
}

/// The values of a photon, from its g.
struct Photon<'a> {
    block: &'a Neighbours,
    scale: u32,
    /// b, D = a b, and one ulp times 2^scale
    outer: Integer,
    below: Integer,
    one: Integer,
    excess: Integer,
    variance: Integer,
    /// Held between photons for their memory alone.
    slope: Integer,
    square: Integer,
}

impl<'a> Photon<'a> {
    fn new(block: &'a Neighbours, plan: &Plan) -> Photon<'a> {
        let outer = block.outer();
        Photon {
            block,
            scale: plan.scale,
            below: Integer::from(&block.inner * &outer),
            outer,
            one: Integer::from(1) << plan.scale,
            excess: Integer::new(),
            variance: Integer::new(),
            slope: Integer::new(),
            square: Integer::new(),
        }
    }

    fn set(&mut self, index: usize, g: &Integer) {
        let l = self.block.place(index);
        let k = Integer::from(&self.block.inner + &l);
        // e = k g - 1
        self.excess.assign(g * &k);
        self.excess -= &self.one;
        // C = 2 D + k (k m - b)
        self.slope.assign(&k * &self.block.size);
        self.slope -= &self.outer;
        self.slope *= k;
        self.slope += &self.below;
        self.slope += &self.below;
        // Equation (2), e^2 by itself.
        self.variance.assign(l * &self.outer);
        self.variance <<= self.scale;
        self.slope *= &self.excess;
        self.variance -= &self.slope;
        self.variance /= &self.below;
        self.square.assign(self.excess.square_ref());
        self.square >>= self.scale;
        self.variance -= &self.square;
    }
}

/// How many bits are cut off the values, so that a bound of their errors is about half a word.
fn cut(ulps: &Integer) -> u32 {
    ulps.significant_bits().saturating_sub(32)
}

/// Values within a bound of their errors, on their way into words.
struct Rounded {
    cut: u32,
    /// The bound, after the cut.
    ulps: Integer,
    column: Column,
}

impl Rounded {
    /// For values below 2^whole, in multiples of 2^-scale.
    fn new(block: &Neighbours, ulps: &Integer, scale: u32, whole: u32) -> Rounded {
        let cut = cut(ulps);
        let ulps = Integer::from(ulps >> cut) + 1u32;
        let length = (scale + whole - cut).div_ceil(64).max(1);
        Rounded {
            cut,
            column: Column {
                infinite: 0,
                length: length as usize,
                words: vec![0; length as usize * block.count],
                // Below: the bound and what is cut off; above: the bound.
                ulps: 2 * ulps.to_u64_wrapping() + 1,
                exponent: (64 * length + cut) as i32 - scale as i32,
            },
            ulps,
        }
    }

    fn put(&mut self, index: usize, value: &mut Integer) {
        *value >>= self.cut;
        *value -= &self.ulps;
        let start = index * self.column.length;
        let words = &mut self.column.words[start..start + self.column.length];
        value.write_digits(words, Order::Lsf);
    }
}
