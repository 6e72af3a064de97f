//! Formula to number: the one tree seen as an exact value ([`exact`]), as an outward rounded interval
//! ([`enclose`], [`ladder`]), as a float ([`float`]) and as a truth value ([`holds`]).
//!
//! All of them share one meaning (the design's "What a statement means") and never guess: a value that is
//! proved not to exist is [`Outcome::Undefined`], a value that could not be found is a [`Failure`].
//!
//! Names are looked up from the inside out: bound variables, then the point. A mean is taken over
//! the draws that occur free in its body, under their laws with the parameters as they are bound
//! where the mean stands; so `lim(mean(e), l -> 1)` takes the law at `l = 1`.

mod closed;
mod condition;
mod differentiate;
mod enclose;
mod ends;
mod euler;
mod exact;
mod float;
mod fraction;
mod functions;
mod integrand;
mod integrate;
mod jet;
mod law;
mod limit;
mod line;
mod mean;
mod outcome;
mod pieces;
mod program;
mod quadrature;
mod quantity;
mod range;
mod scope;
mod sign;
mod tail;

pub use condition::holds;
pub use enclose::{enclose, ladder};
pub use exact::exact;
pub use float::float;
pub use program::{Program, Test};

use crate::formula::budget::Exhausted;
use crate::formula::{Budget, Draw, Point};

/// Where a formula is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// Values of the parameters.
    pub point: &'a Point,
    /// The draws of the scope, independent of each other.
    pub draws: &'a [Draw],
    /// Steps that may be spent.
    pub budget: &'a Budget,
}

/// What a formula is at a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome<T> {
    /// A real value.
    Value(T),
    /// `+inf`: a mean, integral or sum of something nonnegative that diverges, or `inf` itself.
    PlusInfinity,
    /// `-inf`
    MinusInfinity,
    /// Proved to have no value.
    Undefined,
}

/// Why a value could not be told. Never to be read as [`Outcome::Undefined`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// The budget is spent.
    #[error("the budget of steps is spent")]
    Exhausted,
    /// No method of this evaluator applies.
    #[error("cannot evaluate {0}")]
    Unsupported(String),
    /// The numbers on the way would be too large.
    #[error("too large: {0}")]
    TooLarge(String),
    /// Enclosures do not decide, at any precision tried.
    #[error("cannot decide {0}")]
    Undecided(String),
}

impl From<Exhausted> for Failure {
    fn from(_: Exhausted) -> Failure {
        Failure::Exhausted
    }
}

/// A [`Failure::Unsupported`].
fn unsupported(what: impl Into<String>) -> Failure {
    Failure::Unsupported(what.into())
}

/// A [`Failure::Undecided`].
fn undecided(what: impl Into<String>) -> Failure {
    Failure::Undecided(what.into())
}
