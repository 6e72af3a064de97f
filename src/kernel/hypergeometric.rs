//! Gauss's 2F1 at rational points: a finite sum, an integral that is exact up to one logarithm, or
//! the series with a geometric bound on its tail.

use super::functions::{SIZE_CAP, binomial, factorial, gamma, integer, power};
use super::integrate::integral;
use super::interval::{Interval, Value};
use super::polynomial::{Fraction, Polynomial};
use super::scope::Scope;
use super::{Unknown, unknown};
use crate::formula::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// No sum of more terms is taken.
const TERMS_CAP: u64 = 20_000;
/// Parameters up to which Euler's integral is expanded.
const EULER_CAP: u32 = 300;

/// hyp2f1(a, b; c; z).
pub(super) fn value(parameters: [&Rational; 4], scope: &Scope) -> Result<Value, Unknown> {
    let [a, b, c, z] = parameters;
    let steps = [a, b].into_iter().filter_map(terminates_after).min();
    if c.is_integer() && !c.is_positive() {
        // A sum that ends before (c)_j vanishes is read in two ways (DLMF 15.2.4 and 15.2.5).
        return match (steps, terminates_after(c)) {
            (Some(steps), Some(last)) if steps <= last => unknown("hyp2f1 at a pole of c"),
            _ if z.is_zero() => unknown("hyp2f1 at a pole of c"),
            _ => Ok(Value::Undefined),
        };
    }
    if z.is_zero() {
        return Ok(Value::exact(1));
    }
    if let Some(steps) = steps {
        return finite_sum(parameters, steps, scope);
    }
    let one = Rational::one();
    if *z > one || (*z == one && *c <= a + b) {
        return Ok(Value::Undefined);
    }
    if *z == one {
        return at_one(a, b, c, scope.bits);
    }
    for (a, b) in [(a, b), (b, a)] {
        if let Some(value) = euler(a, b, c, z, scope)? {
            return Ok(value);
        }
    }
    transformed(a, b, c, z, scope)
}

/// hyp2f1(a, b; c; z)/gamma(c), DLMF 15.2.2.
pub(super) fn regularized(parameters: [&Rational; 4], scope: &Scope) -> Result<Value, Unknown> {
    match gamma(parameters[2], scope.bits)? {
        Some(gamma) => value(parameters, scope)?.over(&gamma.into(), scope.bits),
        None => unknown("hyp2f1r at a pole of c"),
    }
}

/// n for the parameter -n, at which the series ends after the term n.
fn terminates_after(parameter: &Rational) -> Option<BigInt> {
    (parameter.is_integer() && !parameter.is_positive()).then(|| -parameter.numer())
}

/// The factor from the term j to the next: (a+j)(b+j)z/((c+j)(j+1)), DLMF 15.2.1.
fn step([a, b, c, z]: [&Rational; 4], j: u64) -> Rational {
    let j = Rational::from_integer(j.into());
    (a + &j) * (b + &j) * z / ((c + &j) * (&j + Rational::one()))
}

fn finite_sum(p: [&Rational; 4], steps: BigInt, scope: &Scope) -> Result<Value, Unknown> {
    let Some(steps) = steps.to_u64().filter(|&n| n <= TERMS_CAP) else {
        return unknown("a hypergeometric sum of too many terms");
    };
    let (mut sum, mut term) = (Rational::one(), Rational::one());
    for j in 0..steps {
        term *= step(p, j);
        sum += &term;
        scope.spend(1 + super::interval::size(&sum) / 16)?;
    }
    Ok(Interval::exact(sum).into())
}

/// Gamma(c)Gamma(c-a-b)/(Gamma(c-a)Gamma(c-b)) for c > a+b, DLMF 15.4.20; 0 at a pole below.
fn at_one(a: &Rational, b: &Rational, c: &Rational, bits: u64) -> Result<Value, Unknown> {
    let above = [gamma(c, bits)?, gamma(&(c - a - b), bits)?];
    let below = [gamma(&(c - a), bits)?, gamma(&(c - b), bits)?];
    let [Some(first), Some(second)] = above else {
        return unknown("hyp2f1 at 1 with a pole of gamma");
    };
    let mut product = first.times(&second, bits);
    for divisor in below {
        // 1/Gamma is zero at the poles of Gamma.
        let inverse = match divisor {
            None => Some(Interval::integer(0)),
            Some(divisor) => divisor.reciprocal(bits),
        };
        match inverse {
            Some(inverse) => product = product.times(&inverse, bits),
            None => return unknown("gamma too near to zero at these bits"),
        }
    }
    Ok(product.into())
}

/// (c-1)!/((b-1)!(c-b-1)!) times the integral of x^(b-1)(1-x)^(c-b-1)/(1-zx)^a over 0..1, DLMF
/// 15.6.1, for integers a >= 1 and c > b >= 1 and z < 1; `None` for other parameters.
fn euler(
    a: &Rational,
    b: &Rational,
    c: &Rational,
    z: &Rational,
    scope: &Scope,
) -> Result<Option<Value>, Unknown> {
    let (Some(a), Some(b), Some(rest)) = (small(a), small(b), small(&(c - b))) else {
        return Ok(None);
    };
    if super::interval::size(z).saturating_mul(a.into()) > SIZE_CAP {
        return unknown("hyp2f1 at too large a number");
    }
    let bits = scope.bits;
    scope.spend(u64::from(b + rest).pow(2) * u64::from(a))?;
    let mut coefficients = vec![Interval::integer(0); b as usize - 1];
    for i in 0..rest {
        let term = binomial(&integer(&(rest - 1).into()), &i.into(), bits)?;
        coefficients.push(if i % 2 == 0 { term } else { term.negated() });
    }
    // 1 - zx = -z(x - 1/z)
    let outside = super::interval::integer_power(&(-z).recip(), a);
    let scale = Rational::new(
        factorial(&(b + rest - 1).into())?,
        factorial(&(b - 1).into())? * factorial(&(rest - 1).into())?,
    );
    let constant = Polynomial::constant(Interval::exact(outside * scale));
    let integrand = Fraction {
        numerator: Polynomial::new(coefficients).times(&constant, bits)?,
        poles: [(z.recip(), a)].into(),
    };
    integral(&integrand, &Value::exact(0), &Value::exact(1), bits).map(Some)
}

fn small(number: &Rational) -> Option<u32> {
    let n = number.is_integer().then(|| number.numer().to_u32())??;
    (1..=EULER_CAP).contains(&n).then_some(n)
}

/// For z < 0 first Pfaff, DLMF 15.8.1: (1-z)^(-a) hyp2f1(a, c-b; c; z/(z-1)), with 0 < z/(z-1) < 1.
fn transformed(
    a: &Rational,
    b: &Rational,
    c: &Rational,
    z: &Rational,
    scope: &Scope,
) -> Result<Value, Unknown> {
    if !z.is_negative() {
        return series([a, b, c, z], scope);
    }
    let bits = scope.bits;
    let base = Interval::exact(Rational::one() - z);
    let Some(factor) = power(&base, &Interval::exact(-a), bits + 8)? else {
        return unknown("a power of a positive number");
    };
    let inner = value([a, &(c - b), c, &(z / (z - Rational::one()))], scope)?;
    inner.times(&factor.into(), bits)
}

/// The series at 0 < z < 1. From the term j on, with c + j > 0, each factor is at most
/// q = z(1 + |a-c|/(c+j))(1 + |b-1|/(j+1)), which falls with j; where q < 1 the rest from the term
/// T_j on is at most |T_j|/(1-q).
fn series(p: [&Rational; 4], scope: &Scope) -> Result<Value, Unknown> {
    let [a, b, c, z] = p;
    let bits = scope.bits + 24;
    let (mut sum, mut term) = (Interval::integer(0), Interval::integer(1));
    for j in 0..TERMS_CAP {
        scope.spend(4 + bits / 32)?;
        let place = Rational::from_integer(j.into());
        let one = Rational::one();
        if (c + &place).is_positive() {
            let q = z
                * (&one + (a - c).abs() / (c + &place))
                * (&one + (b - &one).abs() / (&place + &one));
            if q < one {
                let size = term.absolute().high().clone();
                let rest = size / (&one - q);
                let negligible =
                    sum.absolute().low() / Rational::from_integer(BigInt::one() << bits);
                if rest <= negligible {
                    let tail = Interval::between(-&rest, rest);
                    return Ok(sum.plus(&tail, bits).into());
                }
            }
        }
        sum = sum.plus(&term, bits);
        let factor = Interval::exact(step(p, j));
        // Rounded from the start: an exact term would grow with every step.
        term = term.times(&factor, bits);
        term = rounded_exact(term, bits);
    }
    unknown("a hypergeometric series that converges too slowly")
}

/// An exact number as an enclosure of limited size.
fn rounded_exact(term: Interval, bits: u64) -> Interval {
    if term.size() <= 4 * bits {
        return term;
    }
    term.widened(bits)
}

#[cfg(test)]
mod tests {
    use super::super::functions::ln;
    use super::*;
    use crate::formula::Point;

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(a.into(), b.into())
    }

    fn at(a: Rational, b: Rational, c: Rational, z: Rational, bits: u64) -> Result<Value, Unknown> {
        let point = Point::default();
        let fuel = super::super::scope::full_tank();
        value([&a, &b, &c, &z], &Scope::new(&point, &[], bits, &fuel))
    }

    fn int(n: i64) -> Rational {
        ratio(n, 1)
    }

    #[test]
    fn no_values_and_finite_sums() {
        assert_eq!(at(int(1), int(1), int(2), int(1), 64), Ok(Value::Undefined));
        assert_eq!(at(int(1), int(1), int(2), int(3), 64), Ok(Value::Undefined));
        assert_eq!(
            at(int(1), int(1), int(-2), ratio(1, 2), 64),
            Ok(Value::Undefined)
        );
        // 1 - 2*3*5/4 + ... = (-2)_j (3)_j/(4)_j 5^j/j!
        let sum = int(1) - ratio(30, 4) + ratio(2 * 12 * 25, 20 * 2);
        assert_eq!(
            at(int(-2), int(3), int(4), int(5), 64),
            Ok(Interval::exact(sum).into())
        );
        // Gauss: 2F1(1,1;4;1) = Gamma(4)Gamma(2)/Gamma(3)^2
        assert_eq!(
            at(int(1), int(1), int(4), int(1), 64),
            Ok(Interval::exact(ratio(3, 2)).into())
        );
    }

    /// 2F1(1,1;2;z) = -ln(1-z)/z, DLMF 15.4.1, with Euler's integral and with the series.
    #[test]
    fn the_logarithm() {
        for z in [int(-3), ratio(-1, 2), ratio(1, 3), ratio(9, 10)] {
            let known = ln(&(int(1) - &z), 200).unwrap();
            let known = known.times(&Interval::exact(-z.recip()), 200);
            let found = at(int(1), int(1), int(2), z.clone(), 64)
                .unwrap()
                .finite()
                .unwrap();
            assert!(found.low() <= known.low() && known.high() <= found.high());
            let point = Point::default();
            let fuel = super::super::scope::full_tank();
            let scope = Scope::new(&point, &[], 64, &fuel);
            if z.is_positive() {
                let found = series([&int(1), &int(1), &int(2), &z], &scope).unwrap();
                let found = found.finite().unwrap();
                assert!(found.low() <= known.low() && known.high() <= found.high());
                assert!(found.high() - found.low() < ratio(1, 1 << 60));
            }
        }
    }

    #[test]
    fn half_integers_by_the_series() {
        // 2F1(1/2,1;3/2;-1) = arctan 1 = pi/4, DLMF 15.4.3
        let found = at(ratio(1, 2), int(1), ratio(3, 2), int(-1), 100).unwrap();
        let quarter = super::super::functions::pi(200).unwrap();
        let quarter = quarter.times(&Interval::exact(ratio(1, 4)), 200);
        let found = found.finite().unwrap();
        assert!(found.low() <= quarter.low() && quarter.high() <= found.high());
    }
}
