//! What a run found, as text and as a page for people, as JSON, JUnit and SARIF for programs; errors
//! with their place.
//!
//! Every format is a function from a [`crate::corpus::Run`] to a `String`. Colours are written as
//! terminal escapes; the stream that prints a report takes them out where no terminal reads it.

pub mod chart;
pub mod diagnostic;
pub mod proof;
mod style;

#[cfg(feature = "engine")]
pub mod errata;
#[cfg(feature = "engine")]
pub mod figures;
#[cfg(feature = "engine")]
pub mod html;
#[cfg(feature = "engine")]
pub mod human;
#[cfg(feature = "engine")]
pub mod json;
#[cfg(feature = "engine")]
pub mod junit;
#[cfg(feature = "engine")]
mod latex;
#[cfg(feature = "engine")]
mod machine;
#[cfg(feature = "engine")]
pub mod probe;
#[cfg(feature = "engine")]
pub mod sarif;
#[cfg(feature = "engine")]
pub mod simulate;
#[cfg(feature = "engine")]
pub mod survey;
#[cfg(feature = "engine")]
mod tally;
#[cfg(feature = "engine")]
mod typeset;
#[cfg(feature = "engine")]
mod words;
