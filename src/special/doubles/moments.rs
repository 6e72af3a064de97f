//! A shell by its central moments.
//!
//! The formulas are those of [`crate::special::shell`]'s file `moments.rs`, with their proofs. Photon l of
//! the m in a shell of volume m around the volume a; s = m+1, q = s-l, and mu = a + m l/s is the mean of U.
//! With D = s mu = s a + m l, rho = m/D and c_n = n/(s+n):
//!
//! ```text
//! e0 = l/D (k/mu = 1 + e0),   f = 1 + e0,   t2 = rho^2 l q/(s+1),   x = rho (l-q),   y = rho^2 l q,
//! sig_1 = 0,  sig_2 = 1,  sig_(n+1) = c_n (x sig_n + y sig_(n-1)),
//! P1 = sum of sig_n,   P2 = sum of (n-1) sig_n,   n >= 2,
//! E - 1 = e0 + f t2 P1,    Var = f^2 t2 Q,   Q = P2 - t2 P1^2.
//! ```
//!
//! Computed with the terms n < N, N even, the sums as 1 + (those of n >= 3, in turn), with t2 as
//! `(l q C) (1/D)^2`, C = m^2/(s+1), and one division a photon, 1/D.
//!
//! # The bounds
//!
//! Let u = 2^-53. In the words of Higham (Accuracy and Stability of Numerical Algorithms, 2nd edition,
//! section 3.1), theta_c is a number with `|theta_c| <= gamma_c = c u/(1 - c u)`; n roundings in products and
//! quotients make a factor 1 + theta_n (lemma 3.1), and `(1 + theta_b)(1 + theta_c) = 1 + theta_(b+c)` (lemma
//! 3.3, whose proof needs no integers). A computed value *has the count c* if it is the exact one times 1 +
//! theta_c. Let d = 0 where s (a+m) <= 2^53, d = 2 elsewhere.
//!
//! **Majorants.** As D >= s a + m, `|x| <= h` and, l q being at most s^2/4, `y <= h^2/4`. So
//! `|sig_n| <= sigma_n`, and over the whole shell
//!
//! ```text
//! h = m s/(s a + m),
//! sigma_1 = 0,  sigma_2 = 1,  sigma_(n+1) = c_n h (sigma_n + (h/4) sigma_(n-1)),
//! S1 = sum of sigma_n,    S2 = sum of (n-1) sigma_n,    3 <= n < N,
//! e0 <= e = m/(s a + m^2),    mu/a <= M = 1 + m^2/(s a),    t2 <= T = h^2/(4 (s+1)),
//! (a+m)/mu - 1 = m q/D <= H = m^2/(s a + m),
//! f t2/e0 = f m^2 q/(D (s+1)) <= R = (1+e) m^3/((s a + m)(s+1)).
//! ```
//!
//! **Truncation** (theorem of `moments.rs`). P1 and P2 lack a part between 0 and
//! `r1 = sigma_N M`, `r2 = sigma_N ((N-1) + (N-2) H) M^2`.
//!
//! **Terms.** s, q, l-q, l q, m l and m^2 are exact, as m < 2^26; D is exact where it is an integer below
//! 2^53, else it has the count d = 2 (s a and the sum are rounded). Hence 1/D has the count d+1, e0 and rho
//! d+2, x d+3, y 2d+6, t2 2d+6. In the recurrence x sig_n and y sig_(n-1) have the same sign (sig_n has that
//! of l-q for odd n, and is positive for even n), so nothing cancels, and sig_n has the count `(n-2)(d+7)`: 0
//! for n = 2, d+5 for n = 3 (three roundings without effect), and if it is so up to n, then sig_(n+1) has at
//! most `max((n-2)(d+7) + d+4, (n-3)(d+7) + 2d+7) + 3 <= (n-1)(d+7)`.
//!
//! **Sums.** A term takes part in at most N-4 roundings of the sum from n = 3 on, one more by its weight n-1,
//! and the last addition of 1 rounds once. So, with j_n = (n-2)(d+7), P1 is computed with an error of at most
//! `A1` units u, P2 of `A2`:
//!
//! ```text
//! A1 = sum of (j_n + N-4) sigma_n + 1 + S1,     A2 = sum of (n-1) (j_n + N-3) sigma_n + 1 + S2,   3 <= n < N.
//! ```
//!
//! **Theorem (mean).** With g = 1 + (d+2) e, `|computed - (E-1)| <= B (E-1)`, where
//!
//! ```text
//! B/u = d+3 + R ((2d+9+g) (1+S1) + A1 + r1/u).
//! ```
//!
//! Proof. f has the count g. `f t2 P1` takes g + 2d+6 from its factors and two from its products, times
//! 1+S1 >= |P1|, and A1 from P1; the last sum rounds once, d+2 being in e0 already. All but e0's share is
//! f t2 <= R e0 times what stands in the bracket, and E - 1 >= e0, since t2 P1, the mean of u^2/(1-u) (u = -T of
//! `moments.rs`), is positive. QED.
//!
//! **Theorem (variance).** With `L = 1 - S2 - T (1 + S1 + r1)^2`, where it is positive,
//! `|computed - Var| <= B Var`, where
//!
//! ```text
//! B/u = 2g + 2d + 9 + (A2 + T ((2d+8) (1+S1)^2 + 2 (1+S1) A1) + 1 + S2 + T (1+S1)^2 + W/u)/L,
//! W = r2 + T (2 (1+S1) + r1) r1.
//! ```
//!
//! Proof. f^2 has 2g+1, t2 2d+6, the two products after them 2. In Q, P2 has A2; t2 P1^2 has 2d+6 from t2,
//! two roundings, and twice A1 times 1+S1; the difference, at most 1 + S2 + T (1+S1)^2, is rounded once; W is
//! what the truncation changes. All that is relative to the exact Q >= L: P2 is at least 1 - S2, for its tail
//! is positive, and |P1| at most 1 + S1 + r1. QED.
//!
//! **What is left out above, and covered by [`SLACK`]**: (1) sums of errors `weight * gamma_c` were counted
//! as weight c u, and products of two errors not at all. All counts and their sums are below 2^11 (h <= 1/2
//! and L >= 1/2 keep S1 and S2 below 1/2), so that this is a factor below 1 + 2^-22. (2) The bounds stand for
//! multiples of the exact value; as a multiple of the computed one they grow by a factor 1 + B, B < 2^-40.
//! (3) The figures here are computed in f64, by less than 2^9 operations on positive numbers, and L >= 1/2 by
//! one difference: a factor below 1 + 2^-40. (4) Underflow: 2^-78 < 1/D, so that e0, rho, t2, y and every
//! factor at the end are above 2^-400 and no product of them underflows; a sig_n may, and is then off by some
//! 2^-1074 in each of three operations, which x + y < 1 does not increase: below 2^-1000 in P1 and P2.
//! Nothing overflows: all is below 2^78.

use super::Bounds;
use super::kernel::Kernel;
use crate::number::Wide;

/// For what the theorems' counts leave out.
const SLACK: f64 = 1.0 + 1.0 / (1 << 20) as f64;

/// The most terms, N.
const MOST_TERMS: usize = 32;

/// What the truncation may change, relative to the values: u/32.
const FAR_BELOW: f64 = f64::EPSILON / 64.0;

/// The roundings' unit u.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The kernel for one shell.
pub(super) struct Moments {
    /// s a, or that rounded.
    edge: f64,
    /// m
    size: f64,
    /// C
    factor: f64,
    /// c_n and n, from n = 2 on: what makes sig_(n+1), and its weight in P2.
    steps: [[f64; 2]; MOST_TERMS],
    /// How many of them, N-3.
    length: usize,
}

impl Kernel for Moments {
    #[inline(always)]
    fn values(&self, l: Wide) -> [Wide; 2] {
        let [one, size] = [1.0, self.size].map(Wide::all);
        let q = Wide::all(self.size + 1.0) - l;
        let r = one / (Wide::all(self.edge) + size * l);
        let (e0, rho, product) = (l * r, size * r, l * q);
        let (x, y) = ((l - q) * rho, product * rho * rho);
        let t2 = (product * Wide::all(self.factor)) * (r * r);
        let [mut before, mut first, mut second] = [Wide::all(0.0); 3];
        let mut term = one;
        for &[ratio, weight] in &self.steps[..self.length] {
            let next = Wide::all(ratio) * (x * term + y * before);
            (before, term) = (term, next);
            first = first + term;
            second = second + term * Wide::all(weight);
        }
        let (first, second) = (one + first, one + second);
        let f = one + e0;
        let spread = second - t2 * (first * first);
        [e0 + f * t2 * first, f * f * t2 * spread]
    }
}

impl Moments {
    /// The kernel for a shell of volume m and m photons around the volume a > 0, a + m <= 2^50, and its bounds;
    /// `None` where the theorems do not reach, for want of terms: shells of few photons and thick ones.
    pub(super) fn new(inner: u64, size: u64) -> Option<(Moments, Bounds)> {
        if size >= 1 << 26 {
            return None;
        }
        let shell = Majorants::new(inner, size);
        let s = shell.s;
        let mut moments = Moments {
            edge: s * inner as f64,
            size: size as f64,
            factor: (size * size) as f64 / (s + 1.0),
            steps: [[0.0; 2]; MOST_TERMS],
            length: 0,
        };
        let mut sums = Sums::default();
        let (mut before, mut term) = (0.0, 1.0);
        for index in 2..=MOST_TERMS {
            let n = index as f64;
            if index > 3
                && index % 2 == 0
                && let Some(bounds) = shell.bounds(n, term, &sums)
            {
                moments.length = index - 3;
                return Some((moments, bounds));
            }
            if index > 2 {
                sums.add(n, term, shell.count(n));
            }
            let ratio = n / (s + n);
            moments.steps[index - 2] = [ratio, n];
            let next = ratio * shell.h * (term + shell.h / 4.0 * before);
            (before, term) = (term, next);
        }
        None
    }
}

/// The numbers of a shell that the bounds are made of; their names are those of the header.
struct Majorants {
    s: f64,
    d: f64,
    h: f64,
    /// g
    count_of_f: f64,
    /// M
    lift: f64,
    /// H
    height: f64,
    /// T
    t2: f64,
    /// R
    share: f64,
}

/// Sums over n from 3 on.
#[derive(Default)]
struct Sums {
    /// S1
    first: f64,
    /// S2
    second: f64,
    /// sum of j_n sigma_n
    first_count: f64,
    /// sum of (n-1) j_n sigma_n
    second_count: f64,
}

impl Majorants {
    fn new(inner: u64, size: u64) -> Majorants {
        let (a, m) = (inner as f64, size as f64);
        let s = m + 1.0;
        let exact = u128::from(size + 1) * u128::from(inner + size) <= 1 << 53;
        let d = if exact { 0.0 } else { 2.0 };
        let (low, high) = (s * a + m, s * a + m * m);
        let h = m * s / low;
        let e = m / high;
        Majorants {
            s,
            d,
            h,
            count_of_f: 1.0 + (d + 2.0) * e,
            lift: 1.0 + m * m / (s * a),
            height: m * m / low,
            t2: h * h / (4.0 * (s + 1.0)),
            share: (1.0 + e) * (m * m * m) / (low * (s + 1.0)),
        }
    }

    /// j_n
    fn count(&self, n: f64) -> f64 {
        (n - 2.0) * (self.d + 7.0)
    }

    /// The theorems' bounds for N = `n`, sigma_N = `term`, where the truncation is far below u.
    fn bounds(&self, n: f64, term: f64, sums: &Sums) -> Option<Bounds> {
        let (d, g) = (self.d, self.count_of_f);
        let rest = term * self.lift;
        let rest_of_second = rest * self.lift * ((n - 1.0) + (n - 2.0) * self.height);
        let first = 1.0 + sums.first;
        let least = 1.0 - sums.second - self.t2 * (first + rest).powi(2);
        let cut = rest_of_second + self.t2 * (2.0 * first + rest) * rest;
        let share = self.share * rest;
        if self.h > 0.5 || least < 0.5 || cut > FAR_BELOW * least || share > FAR_BELOW {
            return None;
        }
        let error = sums.first_count + (n - 4.0) * sums.first + first;
        let error_of_second = sums.second_count + (n - 3.0) * sums.second + 1.0 + sums.second;
        let mean = d + 3.0 + self.share * ((2.0 * d + 9.0 + g) * first + error);
        let square = self.t2 * ((2.0 * d + 8.0) * first * first + 2.0 * first * error);
        let rounded = 1.0 + sums.second + self.t2 * first * first;
        let spread = (error_of_second + square + rounded) / least;
        Some(Bounds {
            excess: SLACK * (UNIT * mean + share),
            variance: SLACK * (UNIT * (2.0 * g + 2.0 * d + 9.0 + spread) + cut / least),
        })
    }
}

impl Sums {
    fn add(&mut self, n: f64, term: f64, count: f64) {
        self.first += term;
        self.second += (n - 1.0) * term;
        self.first_count += count * term;
        self.second_count += (n - 1.0) * count * term;
    }
}
