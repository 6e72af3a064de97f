//! Exact values of the functions that the language knows, where they have a closed form: `gamma` at
//! integers and half-integers (DLMF 5.4.1, 5.4.6), products for the rest of its family, logarithms
//! and roots of numbers some power of which is rational, `hyp2f1` at integer parameters.

use super::closed::{ln_of, rational, sign, times, to_power};
use super::fraction::{Fraction, MAX_BITS, bits, power};
use super::integrate::{Bound, definite};
use super::{Failure, Outcome, unsupported};
use crate::formula::Budget;
use crate::number::Exact;
use rug::{Integer, Rational};
use std::cmp::Ordering;

use Outcome::{Undefined, Value};

type Closed = Result<Outcome<Exact>, Failure>;

/// Largest index of a root that is looked through for a rational power.
const MAX_ROOT: i64 = 12;

fn value(number: Rational) -> Closed {
    Ok(Value(rational(number)))
}

fn too_large(what: &str) -> Failure {
    Failure::TooLarge(what.into())
}

/// The smallest power of `x` that is rational, with its exponent.
fn rational_power(x: &Exact, budget: &Budget) -> Result<Option<(Rational, i64)>, Failure> {
    for exponent in 1..=MAX_ROOT {
        budget.spend(2)?;
        if let Ok(power) = to_power(x, exponent, budget)
            && let Some(value) = power.as_rational()
        {
            return Ok(Some((value, exponent)));
        }
    }
    Ok(None)
}

/// The logarithm of a number known to be positive.
pub(super) fn ln(x: &Exact, budget: &Budget) -> Result<Exact, Failure> {
    let (power, exponent) = rational_power(x, budget)?
        .ok_or_else(|| unsupported("the logarithm of this number in closed form"))?;
    budget.spend(1 + bits(&power) / 64)?;
    times(
        &ln_of(&power)?,
        &rational(Rational::from((1, exponent))),
        budget,
    )
}

/// `ln x`, which has a value for x > 0 only.
pub(super) fn ln_or_none(x: &Exact, budget: &Budget) -> Closed {
    match sign(x)? {
        Ordering::Greater => ln(x, budget).map(Value),
        _ => Ok(Undefined),
    }
}

/// The n-th root of a number known to be positive.
fn root(x: &Exact, index: u32, budget: &Budget) -> Result<Exact, Failure> {
    let (power, exponent) = rational_power(x, budget)?
        .ok_or_else(|| unsupported("the root of this number in closed form"))?;
    let index = index
        .checked_mul(exponent as u32)
        .ok_or_else(|| too_large("the index of a root"))?;
    budget.spend(1 + bits(&power) / 64)?;
    Exact::root(&power, index).ok_or_else(|| unsupported("a root of a negative number"))
}

/// `x^exponent` for an exponent that is not an integer: x > 0, or 0 to a positive one.
pub(super) fn rational_exponent(x: &Exact, exponent: &Rational, budget: &Budget) -> Closed {
    match sign(x)? {
        Ordering::Less => Ok(Undefined),
        Ordering::Equal if exponent.cmp0() == Ordering::Greater => value(Rational::new()),
        Ordering::Equal => Ok(Undefined),
        Ordering::Greater => {
            let index = exponent
                .denom()
                .to_u32()
                .ok_or_else(|| too_large("the index of a root"))?;
            let times = exponent
                .numer()
                .to_i64()
                .ok_or_else(|| too_large("an exponent"))?;
            if index > 64 {
                return Err(too_large("the index of a root"));
            }
            let root = root(x, index, budget)?;
            to_power(&root, times, budget).map(Value)
        }
    }
}

/// n!, its size estimated first.
pub(super) fn factorial(n: &Integer, budget: &Budget) -> Result<Integer, Failure> {
    let n = n.to_u32().ok_or_else(|| too_large("a factorial"))?;
    let size = u64::from(n).saturating_mul(u64::from(u32::BITS - n.leading_zeros()));
    if size > MAX_BITS {
        return Err(too_large("a factorial"));
    }
    budget.spend(1 + size / 64)?;
    Ok(Integer::from(Integer::factorial(n)))
}

/// `gamma(x)`
pub(super) fn gamma(x: &Rational, budget: &Budget) -> Closed {
    if *x.denom() == 1 {
        if x.cmp0() != Ordering::Greater {
            return Ok(Undefined);
        }
        let below = Integer::from(x.numer() - 1);
        return value(Rational::from(factorial(&below, budget)?));
    }
    if *x.denom() != 2 {
        return Err(unsupported("gamma at this place in closed form"));
    }
    // gamma(1/2 + n) = (1/2)_n sqrt(pi), also for negative n (DLMF 5.4.6, 5.5.1).
    let half = Rational::from((1, 2));
    let n = Rational::from(x - &half);
    let product = pochhammer(&half, n.numer(), budget)?;
    let Value(product) = product else {
        return Ok(Undefined);
    };
    times(&Exact::sqrt_pi(), &product, budget).map(Value)
}

/// `x!` = gamma(x + 1)
pub(super) fn factorial_or_gamma(x: &Rational, budget: &Budget) -> Closed {
    gamma(&Rational::from(x + 1u32), budget)
}

/// `lngamma(x)`, which has a value for x > 0 only.
pub(super) fn lngamma(x: &Rational, budget: &Budget) -> Closed {
    if x.cmp0() != Ordering::Greater {
        return Ok(Undefined);
    }
    if *x.denom() != 1 {
        return Err(unsupported("lngamma at this place in closed form"));
    }
    match gamma(x, budget)? {
        Value(gamma) => ln(&gamma, budget).map(Value),
        other => Ok(other),
    }
}

/// (a)_n = gamma(a+n)/gamma(a) for an integer n, DLMF 5.2.4. For n < 0 it is 1/((a+n)...(a-1)), which is
/// asked for only where a is no integer <= 0.
pub(super) fn pochhammer(a: &Rational, n: &Integer, budget: &Budget) -> Closed {
    let count = n.to_i64().ok_or_else(|| too_large("a product"))?;
    let start = if count < 0 {
        Rational::from(a + Rational::from(count))
    } else {
        a.clone()
    };
    let product = rising(&start, count.unsigned_abs(), budget)?;
    if count >= 0 {
        return value(product);
    }
    if *a.denom() == 1 && a.cmp0() != Ordering::Greater {
        return Err(unsupported("pochhammer of this kind"));
    }
    match product.cmp0() {
        Ordering::Equal => Ok(Undefined),
        _ => value(product.recip()),
    }
}

/// a (a+1) ... (a+n-1)
pub(super) fn rising(a: &Rational, n: u64, budget: &Budget) -> Result<Rational, Failure> {
    let step = bits(a).saturating_add(u64::from(u64::BITS - n.leading_zeros()));
    let size = n.saturating_mul(step);
    let last = Rational::from(a + Rational::from(n));
    let passes_zero =
        *a.denom() == 1 && a.cmp0() != Ordering::Greater && last.cmp0() == Ordering::Greater;
    if passes_zero {
        return Ok(Rational::new());
    }
    if size > MAX_BITS {
        return Err(too_large("a product"));
    }
    budget.spend(1 + n.saturating_mul(1 + size / 128))?;
    let mut product = Rational::from(1);
    let mut factor = a.clone();
    for _ in 0..n {
        product *= &factor;
        factor += 1u32;
    }
    Ok(product)
}

/// `binomial(n, k)` for an integer k; over the smaller of k and n-k for integers 0 <= k <= n.
pub(super) fn binomial(n: &Rational, k: &Rational, budget: &Budget) -> Closed {
    if *k.denom() != 1 {
        return Err(unsupported("binomial at a k that is no integer"));
    }
    if k.cmp0() == Ordering::Less {
        return value(Rational::new());
    }
    let mut k = k.numer().clone();
    if *n.denom() == 1 && n.cmp0() != Ordering::Less {
        let rest = Integer::from(n.numer() - &k);
        if rest < 0 {
            return value(Rational::new());
        }
        k = k.min(rest);
    }
    let above = Rational::from(n - Rational::from(&k)) + 1u32;
    let count = k
        .to_u64()
        .ok_or_else(|| too_large("a binomial coefficient"))?;
    let product = rising(&above, count, budget)?;
    value(product / Rational::from(factorial(&k, budget)?))
}

/// `beta(a, b)` for a > 0, b > 0, DLMF 5.12.1.
pub(super) fn beta(a: &Rational, b: &Rational, budget: &Budget) -> Closed {
    if a.cmp0() != Ordering::Greater || b.cmp0() != Ordering::Greater {
        return Err(unsupported("beta at arguments that are not positive"));
    }
    let (integer, other) = if *a.denom() == 1 && (*b.denom() != 1 || a <= b) {
        (a, b)
    } else {
        (b, a)
    };
    if *integer.denom() == 1 {
        // B(n, b) = (n-1)!/(b)_n
        let n = integer.numer();
        let above = factorial(&Integer::from(n - 1), budget)?;
        let count = n.to_u64().ok_or_else(|| too_large("a product"))?;
        return value(Rational::from(above) / rising(other, count, budget)?);
    }
    let sum = Rational::from(a + b);
    let (Value(a), Value(b), Value(sum)) =
        (gamma(a, budget)?, gamma(b, budget)?, gamma(&sum, budget)?)
    else {
        return Ok(Undefined);
    };
    let quotient = times(&a, &b, budget)?.div(&sum);
    quotient
        .map(Value)
        .ok_or_else(|| unsupported("beta in closed form"))
}

/// `floor(x)`
pub(super) fn floor(x: &Exact) -> Closed {
    if let Some(x) = x.as_rational() {
        return value(Rational::from(x.floor_ref()));
    }
    for precision in [64, 256, 1024] {
        let Some((low, high)) = x.enclose(precision).ends_as_rationals() else {
            continue;
        };
        let (low, high) = (low.floor(), high.floor());
        if low == high {
            return value(low);
        }
    }
    Err(super::undecided("a floor"))
}

/// `exp`, `sin` or `cos` at 0, the sines also at multiples of pi/2.
pub(super) fn exp(x: &Exact) -> Closed {
    match x.is_zero() {
        Some(true) => value(Rational::from(1)),
        _ => Err(unsupported("exp in closed form")),
    }
}

/// sin(x + quarter*pi/2) at multiples of pi/2.
pub(super) fn sine(x: &Exact, quarter: u32) -> Closed {
    let multiple = x.div(&Exact::pi()).and_then(|ratio| ratio.as_rational());
    let Some(doubled) = multiple.map(|m| m * 2u32).filter(|m| *m.denom() == 1) else {
        return Err(unsupported("a sine in closed form"));
    };
    let place = Integer::from(doubled.numer() + quarter);
    value(Rational::from(match place.mod_u(4) {
        0 | 2 => 0,
        1 => 1,
        _ => -1,
    }))
}

fn is_nonpositive_integer(x: &Rational) -> bool {
    *x.denom() == 1 && x.cmp0() != Ordering::Greater
}

/// `hyp2f1(a, b; c; z)`, DLMF 15.2.1.
pub(super) fn hyp2f1([a, b, c, z]: &[Rational; 4], budget: &Budget) -> Closed {
    let terminating = [a, b]
        .into_iter()
        .filter(|x| is_nonpositive_integer(x))
        .max();
    if is_nonpositive_integer(c) {
        return match terminating {
            Some(_) => Err(unsupported("hyp2f1 where c is no parameter of the series")),
            None => Ok(Undefined),
        };
    }
    if *z == 0 {
        return value(Rational::from(1));
    }
    if let Some(top) = terminating {
        return terminating_sum([a, b, c, z], &Integer::from(-top.numer()), budget);
    }
    match z.cmp(&Rational::from(1)) {
        Ordering::Greater => Ok(Undefined),
        Ordering::Equal => at_one(a, b, c, budget),
        Ordering::Less => by_integral([a, b, c, z], budget),
    }
}

/// The terms up to z^n of a series that ends there.
fn terminating_sum([a, b, c, z]: [&Rational; 4], n: &Integer, budget: &Budget) -> Closed {
    let n = n
        .to_u64()
        .ok_or_else(|| too_large("a hypergeometric sum"))?;
    let step = bits(a) + bits(b) + bits(c) + bits(z) + 4 * u64::from(64 - n.leading_zeros());
    let size = n.saturating_mul(step);
    if size > MAX_BITS {
        return Err(too_large("a hypergeometric sum"));
    }
    budget.spend(1 + n.saturating_mul(1 + size / 64))?;
    let mut term = Rational::from(1);
    let mut sum = Rational::from(1);
    for j in 0..n {
        let j = Rational::from(j);
        term *= Rational::from(a + &j) * Rational::from(b + &j) * z;
        term /= Rational::from(c + &j) * (j + 1u32);
        sum += &term;
    }
    value(sum)
}

/// Gauss's sum at z = 1, DLMF 15.4.20: a value for c > a + b only.
fn at_one(a: &Rational, b: &Rational, c: &Rational, budget: &Budget) -> Closed {
    let excess = Rational::from(c - a) - b;
    if excess.cmp0() != Ordering::Greater {
        return Ok(Undefined);
    }
    let left = Rational::from(c - a);
    let right = Rational::from(c - b);
    if is_nonpositive_integer(&left) || is_nonpositive_integer(&right) {
        return value(Rational::new());
    }
    let (Value(c), Value(excess), Value(left), Value(right)) = (
        gamma(c, budget)?,
        gamma(&excess, budget)?,
        gamma(&left, budget)?,
        gamma(&right, budget)?,
    ) else {
        return Ok(Undefined);
    };
    let quotient = times(&c, &excess, budget)?.div(&times(&left, &right, budget)?);
    quotient
        .map(Value)
        .ok_or_else(|| unsupported("hyp2f1 at 1 in closed form"))
}

/// Euler's integral (DLMF 15.6.1) at positive integers, after Euler's transformation (15.8.1) where
/// that makes the series end.
fn by_integral([a, b, c, z]: [&Rational; 4], budget: &Budget) -> Closed {
    let integers = [a, b, c].into_iter().all(|x| *x.denom() == 1);
    if !integers || [a, b, c].into_iter().any(|x| x.cmp0() != Ordering::Greater) {
        return Err(unsupported("hyp2f1 at these parameters in closed form"));
    }
    let small = |x: &Rational| {
        x.numer()
            .to_i64()
            .ok_or_else(|| too_large("a hypergeometric function"))
    };
    if c <= a || c <= b {
        let exponent = small(&(Rational::from(c - a) - b))?;
        let factor = power(&(Rational::from(1) - z), exponent, budget)?;
        let rest = [
            Rational::from(c - a),
            Rational::from(c - b),
            c.clone(),
            z.clone(),
        ];
        let Value(rest) = hyp2f1(&rest, budget)? else {
            return Ok(Undefined);
        };
        return times(&rest, &rational(factor), budget).map(Value);
    }
    // t^(b-1) (1-t)^(c-b-1) (1-zt)^-a / B(b, c-b), the pole of the least order.
    let (a, b) = if a <= b { (a, b) } else { (b, a) };
    let (order, left, right) = (small(a)?, small(b)?, small(&Rational::from(c - b))?);
    let Value(scale) = beta(b, &Rational::from(c - b), budget)? else {
        return Ok(Undefined);
    };
    let weight = beta_kernel(left, right, budget)?;
    // (1-zt)^-a = (-z)^-a (t - 1/z)^-a
    let place = Rational::from(z.recip_ref());
    let pole =
        Fraction::linear_power(place, -order).scale(&power(&Rational::from(-z), -order, budget)?);
    let (zero, one) = (rational(Rational::new()), rational(Rational::from(1)));
    let integral = definite(
        &weight.multiply(&pole, budget)?,
        &Bound::Finite(zero),
        &Bound::Finite(one),
        budget,
    )?;
    let Value(integral) = integral else {
        return Ok(integral);
    };
    integral
        .div(&scale)
        .map(Value)
        .ok_or_else(|| unsupported("hyp2f1 in closed form"))
}

/// x^(a-1) (1-x)^(b-1) for integers a, b.
pub(super) fn beta_kernel(a: i64, b: i64, budget: &Budget) -> Result<Fraction, Failure> {
    let left = Fraction::linear_power(Rational::new(), a - 1);
    let right = Fraction::linear_power(Rational::from(1), b - 1);
    let sign = if (b - 1) % 2 == 0 { 1 } else { -1 };
    Ok(left.multiply(&right, budget)?.scale(&Rational::from(sign)))
}
