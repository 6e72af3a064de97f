//! Short ways to write formulas.

use crate::formula::{Formula, Function, Operator, Rational};

pub(super) fn plus(a: Formula, b: Formula) -> Formula {
    Formula::binary(Operator::Add, a, b)
}

pub(super) fn minus(a: Formula, b: Formula) -> Formula {
    Formula::binary(Operator::Subtract, a, b)
}

pub(super) fn times(a: Formula, b: Formula) -> Formula {
    Formula::binary(Operator::Multiply, a, b)
}

pub(super) fn over(a: Formula, b: Formula) -> Formula {
    Formula::binary(Operator::Divide, a, b)
}

pub(super) fn power(a: Formula, b: Formula) -> Formula {
    Formula::binary(Operator::Power, a, b)
}

pub(super) fn negate(a: Formula) -> Formula {
    Formula::Negate(Box::new(a))
}

pub(super) fn integer(value: i64) -> Formula {
    Formula::integer(value)
}

pub(super) fn call(function: Function, argument: Formula) -> Formula {
    Formula::Call(function, vec![argument])
}

/// A rational number as it is written: a quotient of integers, with its sign in front.
pub(super) fn number(value: &Rational) -> Formula {
    use num_traits::{One, Signed};
    let whole = |n: num_bigint::BigInt| Formula::Number(Rational::from_integer(n));
    let size = value.abs();
    let written = match size.denom().is_one() {
        true => whole(size.numer().clone()),
        false => over(whole(size.numer().clone()), whole(size.denom().clone())),
    };
    match value.is_negative() {
        true => negate(written),
        false => written,
    }
}
