//! One order statistic by itself: `x ~ Beta(a, b)` as `G/(G + H)` of independent gamma variates.
//!
//! George Marsaglia and Wai Wan Tsang, A simple method for generating gamma variables, ACM Transactions on
//! Mathematical Software 26 (2000); normal variates by George Marsaglia's polar method (SIAM Review 6, 1964).
//! Both are exact rejection methods: nothing but the rounding of doubles is approximate. The logarithm is
//! our own, the same on every machine.

use super::logarithm::minus_ln;
use super::stream::Single;

/// A number of the law Beta(a, b), a and b at least 1.
pub(super) fn beta(random: &mut Single<'_>, a: f64, b: f64) -> f64 {
    let g = gamma(random, a);
    g / (g + gamma(random, b))
}

/// A number of the law Gamma(a), a at least 1.
pub(super) fn gamma(random: &mut Single<'_>, a: f64) -> f64 {
    let d = a - 1.0 / 3.0;
    let c = 1.0 / (9.0 * d).sqrt();
    loop {
        let x = normal(random);
        let root = 1.0 + c * x;
        let v = root * root * root;
        if v <= 0.0 {
            continue;
        }
        let u = random.uniform();
        // The squeeze: sure to be taken, and nearly always enough.
        let sure = u < 1.0 - 0.0331 * (x * x) * (x * x);
        if sure || minus_ln(u) > d * (v - 1.0 + minus_ln(v)) - 0.5 * x * x {
            return d * v;
        }
    }
}

/// A number of the normal law, with mean 0 and variance 1.
fn normal(random: &mut Single<'_>) -> f64 {
    loop {
        let (x, y) = (2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0);
        let square = x * x + y * y;
        if square > 0.0 && square < 1.0 {
            return x * (2.0 * minus_ln(square) / square).sqrt();
        }
    }
}
