//! The trusted floor, first part: values of closed formulas at an exact point, and refutations.
//!
//! What is trusted here: [`value`] gives an enclosure that holds the value of the formula, or
//! [`Value::Undefined`] only where it is *proved* to have none; [`check_witness`] makes a
//! [`Refutation`] only where the statement is proved to fail at a point of its domain. Everything
//! else is [`Unknown`], which is never evidence.
//!
//! Numbers are rationals of num-rational. Exact values stay exact; enclosures are rounded outward
//! to dyadic rationals. Every loop ends: each node and each big operation takes from a fixed store
//! of fuel, and sizes are estimated before every power, factorial and binomial.
//!
//! To read it from below: [`interval`] and [`polynomial`], then [`fraction`] (functions of an
//! integral's variable) and [`integrate`]; [`functions`] and [`hypergeometric`]; [`scope`] (what
//! names mean); [`value`](mod@value), the one walk over formulas, with [`condition`],
//! [`integrand`], [`law`] and [`calculus`] (over [`derivative`]); [`witness`] last.
#![forbid(unsafe_code)]

mod calculus;
mod condition;
mod derivative;
mod fraction;
mod functions;
mod hypergeometric;
mod integrand;
mod integrate;
mod interval;
mod law;
mod polynomial;
pub mod proof;
mod quantity;
mod scope;
#[cfg(test)]
mod tests;
mod value;
mod witness;

pub use derivative::is_continuous;
pub use quantity::Value;
pub use value::value;
pub use witness::{Because, Refutation, Witness, check_example, check_witness};

/// The kernel cannot tell, and why. It says nothing about the formula or the statement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Unknown(pub String);

/// Why there is no number. A function that cannot prove `Undefined` returns [`Unknown`] instead, so
/// that the compiler finds every place where one might be taken for the other.
#[derive(Clone, Debug, PartialEq)]
enum Gap {
    /// Proved to have no value.
    Undefined,
    Unknown(Unknown),
}

/// A number, or why there is none: `?` makes a part without value leave none to the whole.
type Found<T> = Result<T, Gap>;

impl From<Unknown> for Gap {
    fn from(why: Unknown) -> Gap {
        Gap::Unknown(why)
    }
}

/// Gives up, with the reason.
fn unknown<T, E: From<Unknown>>(why: &str) -> Result<T, E> {
    Err(Unknown(why.to_string()).into())
}

/// What is found, where a missing value proves nothing.
fn known<T>(found: Found<T>, why: &str) -> Result<T, Unknown> {
    found.map_err(|gap| match gap {
        Gap::Undefined => Unknown(why.to_string()),
        Gap::Unknown(reason) => reason,
    })
}
