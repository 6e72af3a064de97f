//! Exact algebra over the rationals: sparse polynomials, rational functions whose denominators stay
//! factored, and Laurent series with an explicit remainder.
//!
//! Nothing here rests on a greatest common divisor: two rational functions are equal exactly when
//! the numerator of their difference is the zero polynomial. Every product is counted against a
//! [`Budget`](crate::formula::Budget) before it is made, which also bounds the size of all numbers.

mod monomial;
mod polynomial;
mod print;
mod rational;
mod series;

pub use monomial::{Monomial, Symbol};
pub use polynomial::Polynomial;
pub use print::term_text;
pub use rational::RationalFunction;
pub use series::Series;

use crate::formula::budget::Exhausted;

/// Why an operation has no result.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AlgebraError {
    /// The budget of steps is spent.
    #[error("the budget of steps is spent")]
    Exhausted,
    /// An exponent or a number of terms beyond what the tool handles.
    #[error("an expression grows too large")]
    TooLarge,
    /// The divisor is identically zero.
    #[error("a divisor is zero")]
    DivisionByZero,
    /// A series' leading term lies beyond its remainder: more terms are needed.
    #[error("the terms computed cancel: more are needed")]
    TooFewTerms,
}

impl From<Exhausted> for AlgebraError {
    fn from(_: Exhausted) -> AlgebraError {
        AlgebraError::Exhausted
    }
}
