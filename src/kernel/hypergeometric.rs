//! Gauss's 2F1 at rational points: a finite sum, or the series with a bound on its tail.

use super::functions::{TERMS_CAP, gamma, power, series};
use super::interval::{Interval, size};
use super::scope::Scope;
use super::{Found, Gap, Unknown, unknown};
use crate::formula::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;

/// hyp2f1(a, b; c; z).
pub(super) fn hyp2f1([a, b, c, z]: [&Rational; 4], scope: &Scope) -> Found<Interval> {
    let last = [a, b].into_iter().filter_map(terminates_after).min();
    if let Some(pole) = terminates_after(c) {
        // A sum that ends before (c)_j vanishes is read in two ways (DLMF 15.2.4 and 15.2.5).
        return match last {
            Some(last) if last <= pole => unknown("hyp2f1 at a pole of c"),
            _ if z.is_zero() => unknown("hyp2f1 at a pole of c"),
            _ => Err(Gap::Undefined),
        };
    }
    if let Some(last) = last {
        return Ok(finite_sum([a, b, c, z], &last, scope)?);
    }
    match z.cmp(&Rational::one()) {
        Ordering::Greater => Err(Gap::Undefined),
        Ordering::Equal if *c <= a + b => Err(Gap::Undefined),
        Ordering::Equal => unknown("hyp2f1 at 1"),
        Ordering::Less if z.is_negative() => pfaff([a, b, c, z], scope),
        Ordering::Less => {
            scope.spend(TERMS_CAP)?;
            Ok(gauss([a, b, c, z], scope.bits)?)
        }
    }
}

/// hyp2f1(a, b; c; z)/gamma(c), DLMF 15.2.2.
pub(super) fn regularized(parameters: [&Rational; 4], scope: &Scope) -> Found<Interval> {
    match gamma(parameters[2], scope.bits) {
        Err(Gap::Undefined) => unknown("hyp2f1r at a pole of c"),
        gamma => Ok(&hyp2f1(parameters, scope)? * &gamma?.reciprocal()?),
    }
}

/// n for the parameter -n, at which the series ends after the term n.
fn terminates_after(parameter: &Rational) -> Option<BigInt> {
    (parameter.is_integer() && !parameter.is_positive()).then(|| -parameter.numer())
}

/// The factor from the term j to the next: (a+j)(b+j)z/((c+j)(j+1)), DLMF 15.2.1.
fn factor([a, b, c, z]: [&Rational; 4], j: &Rational) -> Rational {
    (a + j) * (b + j) * z / ((c + j) * (j + Rational::one()))
}

fn finite_sum(p: [&Rational; 4], last: &BigInt, scope: &Scope) -> Result<Interval, Unknown> {
    let Some(last) = last.to_u64().filter(|&n| n <= TERMS_CAP) else {
        return unknown("a hypergeometric sum of too many terms");
    };
    let (mut sum, mut term) = (Rational::one(), Rational::one());
    for j in 0..last {
        term *= factor(p, &Rational::from_integer(j.into()));
        sum += &term;
        scope.spend(size(&sum))?;
    }
    Ok(Interval::exact(sum))
}

/// For z < 0, DLMF 15.8.1: (1-z)^(-a) hyp2f1(a, c-b; c; z/(z-1)), with 0 < z/(z-1) < 1.
fn pfaff([a, b, c, z]: [&Rational; 4], scope: &Scope) -> Found<Interval> {
    let base = Interval::exact(Rational::one() - z);
    let scale = power(&base, &Interval::exact(-a), scope.bits)?;
    let place = z / (z - Rational::one());
    Ok(&scale * &hyp2f1([a, &(c - b), c, &place], scope)?)
}

/// The series at |z| < 1. From the term j on, with c + j > 0, each factor is at most
/// q = |z|(1 + |a-c|/(c+j))(1 + |b|/(j+1)), which falls with j.
fn gauss(p: [&Rational; 4], bits: u64) -> Result<Interval, Unknown> {
    let [a, b, c, z] = p;
    let one = Rational::one();
    let bound = |j: &Rational| {
        let below = c + j;
        if !below.is_positive() {
            return None;
        }
        let first = &one + (a - c).abs() / below;
        let second = &one + b.abs() / (j + &one);
        Some(z.abs() * first * second)
    };
    series(bits, |j| factor(p, j), bound)
}

#[cfg(test)]
mod tests {
    use super::super::functions::ln;
    use super::*;
    use crate::formula::Point;

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(a.into(), b.into())
    }

    fn at(a: Rational, b: Rational, c: Rational, z: Rational, bits: u64) -> Found<Interval> {
        let point = Point::default();
        let fuel = super::super::scope::full_tank();
        hyp2f1([&a, &b, &c, &z], &Scope::new(&point, &[], bits, &fuel))
    }

    fn int(n: i64) -> Rational {
        ratio(n, 1)
    }

    #[test]
    fn no_values_and_finite_sums() {
        assert_eq!(at(int(1), int(1), int(2), int(1), 64), Err(Gap::Undefined));
        assert_eq!(at(int(1), int(1), int(2), int(3), 64), Err(Gap::Undefined));
        assert_eq!(
            at(int(1), int(1), int(-2), ratio(1, 2), 64),
            Err(Gap::Undefined)
        );
        let at_one = at(int(1), int(1), int(3), int(1), 64);
        assert!(matches!(at_one, Err(Gap::Unknown(_))));
        // 1 - 2*3*5/4 + ... = (-2)_j (3)_j/(4)_j 5^j/j!
        let sum = int(1) - ratio(30, 4) + ratio(2 * 12 * 25, 20 * 2);
        assert_eq!(
            at(int(-2), int(3), int(4), int(5), 64),
            Ok(Interval::exact(sum))
        );
    }

    /// The poles of c cut a sum off that is longer, not one that ends there (DLMF 15.2.4 and 15.2.5).
    #[test]
    fn poles_of_c() {
        let at = |a, c, z| at(int(a), int(1), int(c), z, 64);
        assert_eq!(at(-3, -2, ratio(1, 2)), Err(Gap::Undefined));
        for (a, c, z) in [
            (-2, -2, ratio(1, 2)),
            (-1, -2, ratio(1, 2)),
            (1, -2, int(0)),
        ] {
            assert!(matches!(at(a, c, z), Err(Gap::Unknown(_))));
        }
    }

    /// Terms of some units of the last place that grow before they fall: after those that are summed
    /// here all are positive, so that the sum is greater.
    #[test]
    fn a_tail_is_not_cut_before_it_falls() {
        let small = |bits: u32| Rational::new(1.into(), BigInt::one() << bits);
        for (a, b, c, z) in [
            (int(300), small(90), int(10), ratio(1, 8)),
            (ratio(3, 2), small(80), ratio(-3, 2), ratio(1, 4)),
        ] {
            let (mut known, mut term) = (int(0), int(1));
            for j in 0..50 {
                known += &term;
                let above = (&a + int(j)) * (&b + int(j)) * &z;
                term *= above / ((&c + int(j)) * int(j + 1));
            }
            for [a, b] in [[&a, &b], [&b, &a]] {
                let found = at(a.clone(), b.clone(), c.clone(), z.clone(), 64).unwrap();
                assert!(*found.high() > known && found.high() - found.low() < ratio(1, 1 << 60));
            }
        }
    }

    /// 2F1(1,1;2;z) = -ln(1-z)/z, DLMF 15.4.1, with and without Pfaff's transformation.
    #[test]
    fn the_logarithm() {
        for z in [int(-3), ratio(-1, 2), ratio(1, 3), ratio(9, 10)] {
            let known = ln(&(int(1) - &z), 200).unwrap();
            let known = &known * &Interval::exact(-z.recip());
            let found = at(int(1), int(1), int(2), z.clone(), 64).unwrap();
            assert!(found.low() <= known.low() && known.high() <= found.high());
            assert!(found.high() - found.low() < ratio(1, 1 << 60));
        }
    }

    #[test]
    fn half_integers_by_the_series() {
        // 2F1(1/2,1;3/2;-1) = arctan 1 = pi/4, DLMF 15.4.3
        let found = at(ratio(1, 2), int(1), ratio(3, 2), int(-1), 100).unwrap();
        let quarter = super::super::functions::pi(200).unwrap();
        let quarter = &quarter * &Interval::exact(ratio(1, 4));
        assert!(found.low() <= quarter.low() && quarter.high() <= found.high());
    }
}
