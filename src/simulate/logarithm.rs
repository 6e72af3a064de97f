//! `-ln u` by `+ - * /` and the bits of u alone, so that a loop of it becomes vectors.
//!
//! `u = 2^e f` with `sqrt(1/2) <= f < sqrt(2)`, up to the rounding of that bound. With `s = (1-f)/(1+f)`,
//!
//! ```text
//! -ln u = -e ln 2 + 2s + 2s^3 P(s^2),   P(z) = 1/3 + z/5 + z^2/7 + ...,   |s| < 0.1716,
//! ```
//!
//! and P is taken as the polynomial of degree 6 that agrees with it at seven Chebyshev points of the interval;
//! it is off by less than 2^-52, which is 2^-57 of the result.
//!
//! **Theorem.** For every normal u > 0 the result is within `5 * 2^-53` of -ln u, relatively. Proof, in units
//! of 2^-53. 1-f is exact (Sterbenz), 1+f and the quotient are rounded, doubling is exact: y = 2s has 2 units.
//! `y z P` is below 0.0102 y and has less than 12 units, and P is off by 2: together 0.2 units of y. e = 0: the
//! last sum adds one, 3.2 in all. Else |y| <= 0.347 and the result R is at least `|e| ln 2 - 0.347 >= 0.346`.
//! The double for ln 2 has 0.3 units, the product with e one more unless |e| is 1, 2 or another power of 2, and
//! both sums one each. |e| = 1: `(0.3 * 0.694 + 2.2 * 0.347)/0.346 + 2 < 4.9`; |e| = 2: `(0.3 * 1.387 +
//! 0.77)/1.039 + 2 < 3.2`; |e| >= 3: `(1.3 * 0.694 |e| + 0.77)/(0.693 |e| - 0.347) + 2 < 4.1`. What the first sum
//! is larger than R by (one in a hundred), and products of errors, stay below the rest. QED. The tests measure
//! 2.8.

use std::f64::consts::LN_2;

/// The bits of `sqrt(1/2)`, rounded to nearest.
const ROOT: u64 = 0x3fe6_a09e_667f_3bcd;
const FRACTION: u64 = (1 << 52) - 1;

/// P, the highest power first; `tests` compute them.
const P: [f64; 7] = [
    0.07308224842521703,
    0.07665860800278021,
    0.09091444562630861,
    0.1111110556739754,
    0.14285714312987743,
    0.19999999999949752,
    0.3333333333333335,
];

/// `-ln u` for a positive normal number.
#[inline(always)]
pub(super) fn minus_ln(u: f64) -> f64 {
    let (exponent, f) = split(u);
    let s = (1.0 - f) / (1.0 + f);
    let z = s * s;
    let y = s + s;
    (y - exponent * LN_2) + y * (z * polynomial(z))
}

/// P, by pairs (Gerald Estrin, 1960): fewer operations wait for one another than by Horner's rule.
#[inline(always)]
fn polynomial(z: f64) -> f64 {
    let [p6, p5, p4, p3, p2, p1, p0] = P;
    let z2 = z * z;
    let low = (p0 + p1 * z) + (p2 + p3 * z) * z2;
    let high = (p4 + p5 * z) + p6 * z2;
    low + high * (z2 * z2)
}

/// e and f.
#[inline(always)]
fn split(u: f64) -> (f64, f64) {
    const ONE: u64 = 1.0f64.to_bits();
    /// A double whose last bits count ones.
    const COUNTER: f64 = (1u64 << 52) as f64;
    let shifted = u.to_bits().wrapping_add(ONE - ROOT);
    let count = f64::from_bits(shifted >> 52 | COUNTER.to_bits());
    let f = f64::from_bits((shifted & FRACTION) + ROOT);
    (count - (COUNTER + 1023.0), f)
}

#[cfg(test)]
mod tests {
    use super::super::stream::{Key, LANES, Row};
    use super::*;
    use crate::number::{Lanes, Task};
    use rug::Float;
    use rug::float::Constant;

    const BITS: u32 = 200;

    fn float<T>(value: T) -> Float
    where
        Float: rug::Assign<T>,
    {
        Float::with_val(BITS, value)
    }

    /// `atanh(s) = s + s^3 P(s^2)`
    fn p(z: &Float) -> Float {
        (0..60u32)
            .rev()
            .fold(float(0), |sum, j| sum * z + float(1) / (2 * j + 3))
    }

    /// The coefficients by Newton's divided differences, the lowest power first.
    fn interpolate(nodes: &[Float]) -> Vec<Float> {
        let n = nodes.len();
        let mut c: Vec<Float> = nodes.iter().map(p).collect();
        for j in 1..n {
            for i in (j..n).rev() {
                c[i] = (float(&c[i]) - &c[i - 1]) / (float(&nodes[i]) - &nodes[i - j]);
            }
        }
        let mut polynomial: Vec<Float> = vec![];
        for (c, node) in c.iter().zip(nodes).rev() {
            let mut next = vec![float(c)];
            next.extend(polynomial.iter().cloned());
            for (coefficient, old) in next.iter_mut().zip(&polynomial) {
                *coefficient -= float(old * node);
            }
            polynomial = next;
        }
        polynomial
    }

    #[test]
    fn the_polynomial_is_the_interpolation() {
        let root = float(2).sqrt();
        let quotient: Float = (float(&root) - 1) / (root + 1);
        let end = quotient.square();
        let pi = float(Constant::Pi);
        let node = |i: u32| -> Float { Float::cos(float(&pi * (2 * i + 1)) / 14u32) + 1u32 };
        let nodes: Vec<Float> = (0..7).map(|i| node(i) * &end / 2).collect();
        let computed: Vec<f64> = interpolate(&nodes)
            .iter()
            .rev()
            .map(Float::to_f64)
            .collect();
        assert_eq!(computed, P);
        for i in 1..=1000u32 {
            let z = float(&end * i) / 1000;
            let taken = P.into_iter().fold(float(0), |sum, c| sum * &z + c);
            assert!((taken - p(&z)).abs() < 2f64.powi(-52));
        }
    }

    /// Errors in units of 2^-53 of the result: the largest.
    fn worst(arguments: impl Iterator<Item = f64>) -> f64 {
        let error = |u: f64| {
            let computed = minus_ln(u);
            let truth = -float(u).ln();
            ((computed - float(&truth)) / truth).to_f64().abs() * 2f64.powi(53)
        };
        arguments.map(error).fold(0.0, f64::max)
    }

    #[test]
    fn the_error_is_within_the_theorem() {
        let mut stream = Key {
            seed: 1,
            chunk: 0,
            photon: 0,
        }
        .stream();
        let random: Vec<f64> = (0..200).flat_map(|_| stream.uniforms().0).collect();
        let odd = |j: u64| (2 * j + 1) as f64 * 2f64.powi(-53);
        let least = (0..2000).map(odd);
        let greatest = (1..2000).map(|j| odd((1 << 52) - j));
        let around_root = (0..4000u64).map(|j| f64::from_bits(ROOT - 2000 + j));
        let far = random
            .iter()
            .map(|u| u * u * f64::MIN_POSITIVE * 2f64.powi(110));
        let powers = (1..1022).map(|e| 2f64.powi(-e));
        let above = (1..1000).map(|j| 1.0 + f64::from(j) * 0.37);
        let all = [
            worst(random.iter().copied()),
            worst(least),
            worst(greatest),
            worst(around_root),
            worst(far),
            worst(powers),
            worst(above),
        ];
        assert!(all.iter().all(|error| *error < 5.0), "{all:?}");
    }

    struct Logarithms(Row);

    impl Task for Logarithms {
        type Output = [u64; LANES];

        #[inline(always)]
        fn run(self) -> Self::Output {
            self.0.0.map(|u| minus_ln(u).to_bits())
        }
    }

    #[test]
    fn all_lanes_give_the_same_bits() {
        let key = Key {
            seed: 2,
            chunk: 0,
            photon: 0,
        };
        let mut stream = key.stream();
        for _ in 0..100 {
            let row = stream.uniforms();
            for lanes in Lanes::available() {
                assert_eq!(lanes.run(Logarithms(row)), Logarithms(row).run());
            }
        }
    }
}
