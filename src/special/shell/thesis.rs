//! The thesis's own route: F by a general 2F1, then E by 2.102 and the variance by 2.104,
//!
//! ```text
//! Var = k^2 ((Va - m Va - l V + V) F + Va m)/(Va^2 (Va+V)) - k^2 F^2/Va^2
//! ```
//!
//! all in one precision. Domain: `Va > 0`, and no more terms than the general function has at most. It is the baseline: the two parts of the variance agree in
//! 2 log2 k bits, which are lost, as is log2 k of E - 1. The intervals say so. (Why 2.104 holds: `quantity`.)

use super::ShellError;
use super::quantity::{Quantity, each};
use super::sketch::{self, Sketch};
use crate::model::Shell;
use crate::number::Interval;
use crate::special::hyp2f1;
use rug::{Integer, Rational};

/// Terms times words, about: the cap of the general function.
const MOST_WORK: u32 = 1 << 21;

pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    if shell.inner == 0 {
        return Err(ShellError::Outside);
    }
    let number = |value: &Rational| Interval::from_rational(value, bits);
    let integer = |value: &Integer| Interval::from_integer(value, bits);
    let (l, m) = (integer(&shell.position), integer(&shell.count));
    let (inner, volume) = (number(&shell.inner), number(&shell.volume));
    let one = Interval::from_i64(1, bits);
    let z = Interval::from_rational(&-Rational::from(&shell.volume / &shell.inner), bits + 8);
    let exact = bits.max(shell.count.significant_bits() + 2);
    let [b, c] = [&shell.position, &Integer::from(&shell.count + 1u32)]
        .map(|n| Interval::from_integer(n, exact));
    let function = hyp2f1(&one, &b, &c, &z, bits)?;
    let k = inner.add(&l);
    let mean = k.mul(&function).div(&inner)?;
    each(quantities, |quantity| {
        Ok(match quantity {
            Quantity::Function => function.clone(),
            Quantity::Mean => mean.clone(),
            Quantity::Excess => mean.sub(&one),
            Quantity::Variance => {
                let factor = inner.sub(&m.mul(&inner)).sub(&l.mul(&volume)).add(&volume);
                let square = factor
                    .mul(&function)
                    .add(&inner.mul(&m))
                    .mul(&k.square())
                    .div(&inner.square().mul(&inner.add(&volume)))?;
                square.sub(&mean.square())
            }
        })
    })
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let terms = sketch.pfaff_terms(f64::from(bits) + 48.0);
    if terms > f64::from(MOST_WORK) / (8.0 + f64::from(bits) / 64.0) {
        return f64::INFINITY;
    }
    // The general function tries harder and allocates more than a series of its own.
    3.0 * terms * sketch::interval_step(bits) + 50_000.0
}
