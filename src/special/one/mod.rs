//! Strategy 1, one photon a shell: U is uniform on k-1..k, and
//!
//! ```text
//! S = E_k = k ln(k/(k-1)),     T = Var_k = k/(k-1) - S^2 = 1/(k-1) - 2 (S-1) - (S-1)^2.
//! ```
//!
//! S - 1 is about 1/(2k) and T about 1/(12 k^2). Three ways, one file each, and the choice:
//!
//! | way | domain | bits lost in S, S-1, T |
//! |---|---|---|
//! | [`Form::Logarithm`] | k >= 2 | log2 k, 2 log2 k, 3 log2 k |
//! | [`Form::Log1p`] | k >= 2 | none, log2 k, 2 log2 k |
//! | [`Form::Series`] | 2 <= k < 2^31, some 500 bits | none, none, none |
//!
//! All are certified: each adds the bits that it is going to lose. In f64, where it cannot, T by the
//! first has no digit left from k = 10^5, by the second from 10^8; the tests show it.

mod log1p;
mod logarithm;
mod series;

pub(super) use series::columns;

use crate::number::Interval;
use rug::Integer;

/// A way to compute S and T.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// `k ln(k/(k-1))`
    Logarithm,
    /// `-k ln(1 - 1/k)`, by a function that takes the 1/k.
    Log1p,
    /// Two series of positive terms, in machine words.
    Series,
}

/// Enclosures of S, S - 1 and T.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    pub mean: Interval,
    pub excess: Interval,
    pub variance: Interval,
}

impl Form {
    /// All of them.
    pub const ALL: [Form; 3] = [Form::Logarithm, Form::Log1p, Form::Series];

    /// The work for `bits` bits in about nanoseconds, a guess that costs time at most; `None`
    /// outside the domain.
    pub fn cost(self, k: &Integer, bits: u32) -> Option<f64> {
        if *k < 2 {
            return None;
        }
        match self {
            Form::Logarithm => Some(logarithm::cost(k, bits)),
            Form::Log1p => Some(log1p::cost(k, bits)),
            Form::Series => series::cost(k, bits),
        }
    }

    /// The values with relative widths of about 2^-bits; `None` outside the domain.
    pub fn values(self, k: &Integer, bits: u32) -> Option<Values> {
        self.cost(k, bits)?;
        match self {
            Form::Logarithm => logarithm::values(k, bits),
            Form::Log1p => log1p::values(k, bits),
            Form::Series => series::values(k, bits),
        }
    }
}

/// The ways whose domain holds k and the precision, cheapest first.
pub fn choose(k: &Integer, bits: u32) -> Vec<Form> {
    let cost = |form: Form| form.cost(k, bits).map(|cost| (form, cost));
    let mut forms: Vec<(Form, f64)> = Form::ALL.into_iter().filter_map(cost).collect();
    forms.sort_by(|a, b| a.1.total_cmp(&b.1));
    forms.into_iter().map(|(form, _)| form).collect()
}

/// S, S - 1 and T by the cheapest way, with relative widths below `10^-digits`; `None` for k < 2,
/// where the mean is infinite or there is no photon.
///
/// ```
/// use claimcheck::special::one::values;
/// let k = 1_000_000_000_000u64;
/// let found = values(&k.into(), 15).expect("k >= 2");
/// assert_eq!(found.variance.to_decimal(5), "8.3333e-26");
/// assert!(found.variance.agrees_to(15) && found.excess.agrees_to(15));
/// assert_eq!(values(&1.into(), 15), None);
/// ```
pub fn values(k: &Integer, digits: u32) -> Option<Values> {
    let bits = super::digits_to_bits(digits) + 4;
    choose(k, bits)
        .into_iter()
        .find_map(|form| form.values(k, bits))
}

/// S and T from the logarithm L = ln(k/(k-1)), with the bits that are lost already added.
fn from_logarithm(k: &Integer, logarithm: &Interval, bits: u32) -> Option<Values> {
    let precision = logarithm.precision();
    let one = Interval::from_i64(1, precision);
    let mean = logarithm.mul_integer(k);
    let ratio = Interval::from_integer(k, precision)
        .div_integer(&Integer::from(k - 1u32))
        .ok()?;
    Some(Values {
        excess: mean.sub(&one).with_precision(bits),
        variance: ratio.sub(&mean.square()).with_precision(bits),
        mean: mean.with_precision(bits),
    })
}

/// About the nanoseconds of a logarithm of an interval, by MPFR.
fn logarithm_cost(bits: u32) -> f64 {
    let bits = f64::from(bits);
    3_000.0 + 60.0 * bits + bits.powi(2) / 100.0
}

#[cfg(test)]
mod tests;
