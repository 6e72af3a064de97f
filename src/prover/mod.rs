//! Finds proofs. So far: expansions, as far as exact Laurent series decide them.

mod along;
mod approach;
mod asymptotics;
mod domain;
mod expansion;
mod failure;
mod gamma;
pub mod identity;
mod integral;
mod joint;
mod moment;
mod sample;
mod turn;

pub use approach::{Approach, Side};
pub use asymptotics::{ExpansionVerdict, judge_expansion};
pub use domain::{Facts, Sign};
pub use expansion::{Expansion, expand};

use crate::algebra::AlgebraError;
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
