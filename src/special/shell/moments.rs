//! Central moments with a remainder of known sign.
//!
//! Let mu = Va + V l/s be the mean of U, T = U/mu - 1, q = m+1-l, s = m+1 and tau_n the mean of (-T)^n.
//! With rho = V/(mu s), `t2 = rho^2 q l/(s+1)` and `tau_n = t2 sig_n`:
//!
//! ```text
//! sig_1 = 0,  sig_2 = 1,  sig_(n+1) = n rho/(s+n) ((l-q) sig_n + q l rho sig_(n-1))
//! E = (k/mu)(1 + t2 P1),         P1 = sum of sig_n, n >= 2
//! Var = (k/mu)^2 t2 (P2 - t2 P1^2),  P2 = sum of (n-1) sig_n
//! ```
//!
//! Nothing cancels inside: the sig_n of even n are positive, those of odd n have the sign of l-q; k/mu - 1 and the
//! factor t2 are exact. So E - 1 and the variance come without the loss of formula 2.104.
//!
//! Theorem (recurrence). For y ~ Beta(q, l) and e_n the mean of (y - q/s)^n:
//! `(s+n) e_(n+1) = n ((l-q)/s e_n + (q l/s^2) e_(n-1))`. Proof. With d = y - q/s is `y(1-y) = q l/s^2 + d (l-q)/s - d^2`,
//! and by parts `mean(n d^(n-1) y(1-y)) = mean(d^n (s y - q)) = s e_(n+1)`. And -T = (V/mu)(y - q/s). QED.
//!
//! Theorem (remainders). Let N be even and u = -T. P1 and P2 cut off before n = N are too small by at most
//! `sig_N mu/Va` and `sig_N ((N-1) + (N-2) H) (mu/Va)^2`, H = (Va+V)/mu - 1. Proof. u < 1, and
//!
//! ```text
//! 1/(1-u) = 1 + u + ... + u^(N-1) + u^N/(1-u)
//! 1/(1-u)^2 - 2/(1-u) = -1 + u^2 + 2 u^3 + ... + (N-2) u^(N-1) + u^N ((N-1) - (N-2) u)/(1-u)^2
//! ```
//!
//! where u^N >= 0, 0 < 1/(1-u) = mu/U <= mu/Va and -u <= H: both last terms lie between 0 and the bounds
//! times u^N. QED.
//!
//! Domain: `Va > 0` and H < 1, where the terms fall; cost: terms with two products each.

use super::ShellError;
use super::quantity::{Numbers, Quantity, each};
use super::sketch::{self, Sketch};
use crate::model::Shell;
use crate::number::Interval;
use rug::{Integer, Rational};

/// The most terms.
const MOST_TERMS: u32 = 1 << 16;

/// Bits for the rounding errors of the terms.
const GUARD: u32 = 24;

/// P1 and P2 of the header, and t2.
struct Sums {
    first: Interval,
    second: Interval,
    t2: Interval,
}

pub(super) fn enclose<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    let numbers = Numbers::new(shell);
    let precision = bits + GUARD;
    let (l, m) = (&shell.position, &shell.count);
    let own = Rational::from(&shell.volume * l) / Integer::from(m + 1u32);
    let mu = own + &shell.inner;
    let outer = Rational::from(&shell.inner + &shell.volume);
    if shell.inner == 0 || outer >= Rational::from(&mu * 2u32) {
        return Err(ShellError::Outside);
    }
    let number = |value: Rational| Interval::from_rational(&value, precision);
    let Sums { first, second, t2 } = sums(shell, &numbers, &mu, precision)?;
    let k = Rational::from(&shell.inner + l);
    let offset = number(Rational::from(&k - &mu) / &mu);
    let (ratio, inside) = (number(k / &mu), number(shell.inner.clone() / mu));
    let more = t2.mul(&first);
    let mean = Interval::from_i64(1, precision).add(&more);
    each(quantities, |quantity| {
        Ok(match quantity {
            Quantity::Function => inside.mul(&mean),
            Quantity::Mean => ratio.mul(&mean),
            Quantity::Excess => ratio.mul(&more).add(&offset),
            Quantity::Variance => {
                let spread = second.sub(&more.mul(&first));
                ratio.square().mul(&t2).mul(&spread)
            }
        })
    })
}

fn sums(
    shell: &Shell,
    numbers: &Numbers,
    mu: &Rational,
    precision: u32,
) -> Result<Sums, ShellError> {
    let number = |value: &Rational| Interval::from_rational(value, precision);
    let (l, q, s) = (&shell.position, &numbers.q, &numbers.s);
    let rho = Rational::from(&shell.volume / mu) / s;
    let product = Integer::from(l * q);
    let t2 = rho.clone().square() * &product / Integer::from(s + 1u32);
    let near = number(&(Rational::from(l - q) * &rho));
    let far = number(&(rho.square() * &product));
    let bound = number(&Rational::from(mu / &shell.inner));
    let height = number(&(Rational::from(&shell.inner + &shell.volume) / mu - 1u32));
    let zero = Interval::from_i64(0, precision);
    let (mut before, mut term) = (zero.clone(), Interval::from_i64(1, precision));
    let (mut first, mut second) = (zero.clone(), zero.clone());
    for n in 2..MOST_TERMS {
        if n % 2 == 0 {
            let rest = term.mul(&bound);
            let weight = Interval::from_i64(i64::from(n) - 1, precision)
                .add(&height.mul_integer(&Integer::from(n - 2)));
            let rest_of_second = rest.mul(&bound).mul(&weight);
            if sketch::exponent(&rest_of_second) < -i64::from(precision) {
                return Ok(Sums {
                    first: first.add(&zero.hull(&rest)),
                    second: second.add(&zero.hull(&rest_of_second)),
                    t2: number(&t2),
                });
            }
        }
        first = first.add(&term);
        second = second.add(&term.mul_integer(&Integer::from(n - 1)));
        let next = near.mul(&term).add(&far.mul(&before));
        let next = next
            .mul_integer(&Integer::from(n))
            .div_integer(&Integer::from(s + n))?;
        before = std::mem::replace(&mut term, next);
    }
    Err(ShellError::Outside)
}

pub(super) fn cost(sketch: &Sketch, bits: u32) -> f64 {
    let terms = sketch.moment_terms(f64::from(bits + GUARD));
    if terms > f64::from(MOST_TERMS) {
        return f64::INFINITY;
    }
    5.5 * terms * sketch::interval_step(bits)
}
