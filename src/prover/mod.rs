//! Finds proofs. So far: expansions, as far as exact Laurent series decide them.

mod along;
mod approach;
mod asymptotics;
mod domain;
mod expansion;
mod failure;
mod gamma;
mod integral;
mod joint;
mod moment;

pub use approach::{Approach, Side};
pub use asymptotics::{ExpansionVerdict, judge_expansion};
pub use domain::{Facts, Sign};
pub use expansion::{Expansion, expand};

use crate::algebra::AlgebraError;
use crate::formula::Rational;
use crate::formula::budget::Exhausted;

/// Why the prover has no answer. Never to be read as an answer of either kind.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Reason {
    #[error("the budget of steps is spent")]
    Exhausted,
    #[error("{0}")]
    TooLarge(String),
    #[error("no method for {0}")]
    Unsupported(String),
    #[error("{0}")]
    Undecided(String),
}

impl From<Exhausted> for Reason {
    fn from(_: Exhausted) -> Reason {
        Reason::Exhausted
    }
}

impl From<AlgebraError> for Reason {
    fn from(error: AlgebraError) -> Reason {
        match error {
            AlgebraError::Exhausted => Reason::Exhausted,
            AlgebraError::TooLarge => Reason::TooLarge(error.to_string()),
            AlgebraError::DivisionByZero | AlgebraError::TooFewTerms => {
                Reason::Undecided(error.to_string())
            }
        }
    }
}

/// A number of the formula tree as one of the engine.
fn engine_number(value: &Rational) -> rug::Rational {
    let part = |integer: &num_bigint::BigInt| {
        let (sign, bytes) = integer.to_bytes_le();
        let size = rug::Integer::from_digits(&bytes, rug::integer::Order::Lsf);
        if sign == num_bigint::Sign::Minus {
            -size
        } else {
            size
        }
    };
    rug::Rational::from((part(value.numer()), part(value.denom())))
}

/// A number of the engine as one of the formula tree.
fn formula_number(value: &rug::Rational) -> Rational {
    let part = |integer: &rug::Integer| {
        let sign = match integer.cmp0() {
            std::cmp::Ordering::Less => num_bigint::Sign::Minus,
            _ => num_bigint::Sign::Plus,
        };
        num_bigint::BigInt::from_bytes_le(sign, &integer.to_digits(rug::integer::Order::Lsf))
    };
    Rational::new(part(value.numer()), part(value.denom()))
}
