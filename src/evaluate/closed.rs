//! Arithmetic of closed exact numbers with counted steps, and errors as [`Failure`].

use super::{Failure, undecided, unsupported};
use crate::formula::Budget;
use crate::number::{Exact, ExactError};
use rug::Rational;
use std::cmp::Ordering;

/// A rational number. This is the plain case; most values are.
pub(super) fn rational(value: Rational) -> Exact {
    Exact::from_rational(&value)
}

fn failure(error: ExactError) -> Failure {
    match error {
        ExactError::TooLarge => Failure::TooLarge("an exact value".into()),
        ExactError::NoForm | ExactError::Undefined => unsupported("a quotient in closed form"),
    }
}

/// `a + b`
pub(super) fn plus(a: &Exact, b: &Exact, budget: &Budget) -> Result<Exact, Failure> {
    budget.spend(1)?;
    Ok(a.add(b))
}

/// `a - b`
pub(super) fn minus(a: &Exact, b: &Exact, budget: &Budget) -> Result<Exact, Failure> {
    budget.spend(1)?;
    Ok(a.sub(b))
}

/// `a*b`
pub(super) fn times(a: &Exact, b: &Exact, budget: &Budget) -> Result<Exact, Failure> {
    budget.spend(1)?;
    a.mul(b).map_err(failure)
}

/// The integer power. The caller excludes negative powers of 0.
pub(super) fn to_power(a: &Exact, exponent: i64, budget: &Budget) -> Result<Exact, Failure> {
    if let Some(value) = a.as_rational()
        && value != 0
    {
        return super::fraction::power(&value, exponent, budget).map(rational);
    }
    budget.spend(1 + exponent.unsigned_abs().min(1 << 20))?;
    a.powi(exponent).map_err(failure)
}

/// The sign.
pub(super) fn sign(value: &Exact) -> Result<Ordering, Failure> {
    value
        .sign()
        .ok_or_else(|| undecided("the sign of a closed form"))
}

/// How two numbers compare.
pub(super) fn order(a: &Exact, b: &Exact) -> Result<Ordering, Failure> {
    if let (Some(a), Some(b)) = (a.as_rational(), b.as_rational()) {
        return Ok(a.cmp(&b));
    }
    sign(&a.sub(b))
}

/// The absolute value.
pub(super) fn absolute(value: &Exact) -> Result<Exact, Failure> {
    Ok(match sign(value)? {
        Ordering::Less => value.neg(),
        _ => value.clone(),
    })
}

/// The logarithm of a positive rational.
pub(super) fn ln_of(value: &Rational) -> Result<Exact, Failure> {
    Exact::ln_of(value).ok_or_else(|| unsupported("a logarithm of a negative number"))
}
