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

mod calculus;
mod condition;
mod functions;
mod hypergeometric;
mod integrand;
mod integrate;
mod interval;
mod law;
mod limit;
mod polynomial;
mod scope;
mod sums;
mod value;
mod witness;

pub use interval::Value;
pub use value::value;
pub use witness::{Because, Refutation, Witness, check_example, check_witness};

/// The kernel cannot tell, and why. It says nothing about the formula or the statement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Unknown(pub String);

/// Gives up, with the reason.
fn unknown<T>(why: &str) -> Result<T, Unknown> {
    Err(Unknown(why.to_string()))
}
