//! The power series F(a, b; c; z) = sum of t_n, t_0 = 1,
//! t_{n+1} = t_n (a+n)(b+n) z / ((c+n)(n+1)) (DLMF 15.2.1).
//!
//! Theorem (tail). Let c + N > 0, A = max(1, |a+N|/(c+N)), B = max(1, |b+N|/(N+1)) and
//! r = |z| A B < 1. Then |t_N + t_{N+1} + ...| <= |t_N|/(1 - r).
//! Proof. x -> (a+x)/(c+x) = 1 + (a-c)/(c+x) is monotone on x >= N with limit 1, so its values lie
//! between that at N and 1, and in size they are at most A; likewise (b+x)/(1+x) and B. So
//! |t_{n+1}| <= r |t_n| for all n >= N, and the tail is at most the geometric series. QED.
//! The theorem holds with a and b exchanged; the smaller r is taken.
//!
//! The loop ends: r tends to |z| < 1 and t_N to 0, so the bound falls below the rounding errors
//! already made; before that the cap of work ends it.

use super::Parameters;
use crate::number::{DomainError, Interval};
use rug::{Float, Integer};
use std::cmp::Ordering;

/// Terms times machine words of a number (and some for the overhead): about a second's work.
const MAX_WORK: u32 = 1 << 21;

/// Numbers of terms that the cap of work allows.
pub(super) fn max_terms(precision: u32) -> u32 {
    MAX_WORK / (8 + precision / 64)
}

/// The factors (a+n)(b+n)/((c+n)(n+1)), exact where the parameters are integers.
pub(super) struct Ratio<'a> {
    p: &'a Parameters,
    integers: Option<[Integer; 3]>,
}

impl<'a> Ratio<'a> {
    pub(super) fn new(p: &'a Parameters) -> Ratio<'a> {
        let integers = match (p.a.as_integer(), p.b.as_integer(), p.c.as_integer()) {
            (Some(a), Some(b), Some(c)) => Some([a, b, c]),
            _ => None,
        };
        Ratio { p, integers }
    }

    /// t (a+n)(b+n)/((c+n)(n+1)).
    pub(super) fn times(&self, t: &Interval, n: u32) -> Result<Interval, DomainError> {
        if let Some([a, b, c]) = &self.integers {
            let above = Integer::from(a + n) * Integer::from(b + n);
            let below = Integer::from(c + n) * (u64::from(n) + 1);
            return t.mul_integer(&above).div_integer(&below);
        }
        let step = Interval::from_i64(n.into(), self.p.precision());
        let above = self.p.a.add(&step).mul(&self.p.b.add(&step));
        let below = self.p.c.add(&step);
        let below = below.mul_integer(&Integer::from(u64::from(n) + 1));
        t.mul(&above).div(&below)
    }

    /// An upper bound of |(a+n)(b+n)/((c+n)(n+1))| for all n >= `from`; `None` where c + n is not
    /// proved positive.
    pub(super) fn bound(&self, from: u32) -> Option<Interval> {
        let precision = 64;
        let [a, b, c] = [&self.p.a, &self.p.b, &self.p.c].map(|x| x.with_precision(precision));
        let step = Interval::from_i64(from.into(), precision);
        let one = Interval::from_i64(1, precision);
        let (first, second) = (c.add(&step), one.add(&step));
        if *first.low() <= 0 {
            return None;
        }
        let over = |x: &Interval, y: &Interval| -> Option<Interval> {
            Some(x.add(&step).abs().div(y).ok()?.max(&one))
        };
        let one_way = over(&a, &first)?.mul(&over(&b, &second)?);
        let other_way = over(&b, &first)?.mul(&over(&a, &second)?);
        Some(one_way.min(&other_way))
    }
}

/// |t|/(1 - ratio |z|) as an upper bound; `None` where the quotient of terms is not proved < 1.
pub(super) fn geometric_tail(t: &Interval, ratio: &Interval, z: &Interval) -> Option<Float> {
    let one = Interval::from_i64(1, 64);
    let rest = one.sub(&ratio.mul(&z.with_precision(64).abs()));
    if rest.sign() != Some(Ordering::Greater) {
        return None;
    }
    let bound = t.with_precision(64).abs().div(&rest).ok()?;
    Some(bound.high().clone())
}

/// Whether a tail is so small that more terms would not show: below the precision of the sum, or
/// below the errors made so far.
pub(super) fn negligible(tail: &Float, sum: &Interval) -> bool {
    if tail.is_zero() {
        return true;
    }
    let exponent = |x: &Float| x.get_exp().map_or(i64::MIN, i64::from);
    let size = exponent(sum.low()).max(exponent(sum.high()));
    let fine = size.saturating_sub(i64::from(sum.precision()));
    exponent(tail) < fine.max(exponent(&sum.width()).saturating_sub(4))
}

/// The sum with [-tail, tail] added.
pub(super) fn with_tail(sum: &Interval, tail: &Float) -> Interval {
    let size = Interval::from_ends(tail.clone(), tail.clone());
    sum.add(&size.neg().hull(&size))
}

/// Watches how fast the terms fall, so that a series that cannot end within the cap of work is given
/// up early. A guess that costs an answer at most, never its truth.
struct Pace {
    max_terms: u32,
    next: u32,
    exponent: i64,
}

impl Pace {
    fn new(max_terms: u32) -> Pace {
        Pace {
            max_terms,
            next: 1 << 10,
            exponent: 0,
        }
    }

    /// Asked at n = 2^10, 2^11, ...: whether the terms, at four times the pace of the last half,
    /// would still be too large at the cap.
    fn is_hopeless(&mut self, n: u32, term: &Interval, sum: &Interval) -> bool {
        if n != self.next {
            return false;
        }
        let exponent = |x: &Float| x.get_exp().map_or(0, i64::from);
        let now = exponent(term.abs().high());
        let gained = self.exponent - now;
        let needed = now - exponent(sum.abs().high()) + i64::from(sum.precision());
        let halves = i64::from((self.max_terms - n) / (n / 2));
        self.next = n.saturating_mul(2);
        self.exponent = now;
        // Terms that still grow may fall fast later.
        gained >= 0 && needed > gained.saturating_mul(halves).saturating_mul(4)
    }
}

/// The sum for |z| < 1 and c no pole.
///
/// # Errors
/// `Possible` where |z| is not proved < 1, and past the cap of work.
pub(super) fn infinite(p: &Parameters, z: &Interval) -> Result<Interval, DomainError> {
    if *z.abs().high() >= 1 {
        return Err(DomainError::Possible);
    }
    let ratio = Ratio::new(p);
    let mut term = Interval::from_i64(1, p.precision());
    let mut sum = Interval::from_i64(0, p.precision());
    let mut pace = Pace::new(max_terms(p.precision()));
    for n in 0..max_terms(p.precision()) {
        if pace.is_hopeless(n, &term, &sum) {
            break;
        }
        // The bound is dear: it is asked for where the term itself is small.
        if n > 0 && negligible(term.abs().high(), &sum) {
            let tail = ratio.bound(n).and_then(|r| geometric_tail(&term, &r, z));
            if let Some(tail) = tail.filter(|tail| negligible(tail, &sum)) {
                return Ok(with_tail(&sum, &tail));
            }
        }
        sum = sum.add(&term);
        term = ratio.times(&term, n)?.mul(z);
    }
    Err(DomainError::Possible)
}

/// The first n + 1 terms, which are all of them where a or b is -n. No c + j with j < n is 0 there.
///
/// # Errors
/// `Possible` past the cap of work.
pub(super) fn polynomial(
    p: &Parameters,
    z: &Interval,
    n: &Integer,
) -> Result<Interval, DomainError> {
    let degree = n.to_u32().filter(|n| *n < max_terms(p.precision()));
    let degree = degree.ok_or(DomainError::Possible)?;
    let ratio = Ratio::new(p);
    let mut term = Interval::from_i64(1, p.precision());
    let mut sum = term.clone();
    for j in 0..degree {
        term = ratio.times(&term, j)?.mul(z);
        sum = sum.add(&term);
    }
    Ok(sum)
}
