//! Arithmetic with infinities: `inf - inf`, `0*inf` and anything over `inf` have no value, a positive
//! number times `inf` is `inf`.

use super::{Failure, Outcome, unsupported};
use std::cmp::Ordering;

use Outcome::{MinusInfinity, PlusInfinity, Undefined, Value};

impl<T> Outcome<T> {
    /// The same with the value replaced.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Outcome<U> {
        match self {
            Value(value) => Value(f(value)),
            PlusInfinity => PlusInfinity,
            MinusInfinity => MinusInfinity,
            Undefined => Undefined,
        }
    }

    /// `f` of a value; no value stays none; infinities are refused.
    pub(super) fn finite<U>(
        self,
        what: &str,
        f: impl FnOnce(T) -> Result<Outcome<U>, Failure>,
    ) -> Result<Outcome<U>, Failure> {
        match self {
            Value(value) => f(value),
            Undefined => Ok(Undefined),
            PlusInfinity | MinusInfinity => Err(unsupported(format!("{what} at infinity"))),
        }
    }

    /// The opposite.
    pub(super) fn negate(self, f: impl FnOnce(T) -> T) -> Outcome<T> {
        match self {
            Value(value) => Value(f(value)),
            PlusInfinity => MinusInfinity,
            MinusInfinity => PlusInfinity,
            Undefined => Undefined,
        }
    }

    fn infinite(sign: Ordering) -> Outcome<T> {
        match sign {
            Ordering::Greater => PlusInfinity,
            Ordering::Less => MinusInfinity,
            Ordering::Equal => Undefined,
        }
    }
}

/// `a + b`
pub(super) fn add<T>(
    a: Outcome<T>,
    b: Outcome<T>,
    f: impl FnOnce(T, T) -> Result<Outcome<T>, Failure>,
) -> Result<Outcome<T>, Failure> {
    Ok(match (a, b) {
        (Value(a), Value(b)) => return f(a, b),
        (Undefined, _) | (_, Undefined) => Undefined,
        (PlusInfinity, MinusInfinity) | (MinusInfinity, PlusInfinity) => Undefined,
        (PlusInfinity, _) | (_, PlusInfinity) => PlusInfinity,
        (MinusInfinity, _) | (_, MinusInfinity) => MinusInfinity,
    })
}

/// `a*b`; `sign` tells that of a value.
pub(super) fn multiply<T>(
    a: Outcome<T>,
    b: Outcome<T>,
    sign: impl Fn(&T) -> Result<Ordering, Failure>,
    f: impl FnOnce(T, T) -> Result<Outcome<T>, Failure>,
) -> Result<Outcome<T>, Failure> {
    let of = |outcome: &Outcome<T>| match outcome {
        Value(value) => sign(value),
        MinusInfinity => Ok(Ordering::Less),
        PlusInfinity | Undefined => Ok(Ordering::Greater),
    };
    match (a, b) {
        (Value(a), Value(b)) => f(a, b),
        (Undefined, _) | (_, Undefined) => Ok(Undefined),
        (a, b) => {
            let (left, right) = (of(&a)?, of(&b)?);
            Ok(Outcome::infinite(match left {
                Ordering::Equal => Ordering::Equal,
                Ordering::Greater => right,
                Ordering::Less => right.reverse(),
            }))
        }
    }
}

/// `a/b`; `f` answers a zero divisor.
pub(super) fn divide<T>(
    a: Outcome<T>,
    b: Outcome<T>,
    sign: impl Fn(&T) -> Result<Ordering, Failure>,
    f: impl FnOnce(T, T) -> Result<Outcome<T>, Failure>,
) -> Result<Outcome<T>, Failure> {
    match (a, b) {
        (Value(a), Value(b)) => f(a, b),
        (Undefined, _) | (_, Undefined | PlusInfinity | MinusInfinity) => Ok(Undefined),
        (PlusInfinity, Value(b)) => Ok(Outcome::infinite(sign(&b)?)),
        (MinusInfinity, Value(b)) => Ok(Outcome::infinite(sign(&b)?.reverse())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sign(value: &i32) -> Result<Ordering, Failure> {
        Ok(value.cmp(&0))
    }

    #[test]
    fn infinities_follow_the_conventions() {
        let sum = |a, b| add(a, b, |a: i32, b| Ok(Value(a + b))).unwrap();
        let product = |a, b| multiply(a, b, sign, |a, b| Ok(Value(a * b))).unwrap();
        let quotient = |a, b| divide(a, b, sign, |a, b| Ok(Value(a / b))).unwrap();
        assert_eq!(sum(PlusInfinity, MinusInfinity), Undefined);
        assert_eq!(sum(Value(1), MinusInfinity), MinusInfinity);
        assert_eq!(product(Value(0), PlusInfinity), Undefined);
        assert_eq!(product(Value(-2), PlusInfinity), MinusInfinity);
        assert_eq!(product(MinusInfinity, MinusInfinity), PlusInfinity);
        assert_eq!(quotient(Value(1), PlusInfinity), Undefined);
        assert_eq!(quotient(PlusInfinity, Value(-1)), MinusInfinity);
    }
}
