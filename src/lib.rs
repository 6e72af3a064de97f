//! Checks the formulas of a paper: every claim gets a verdict that carries its evidence.
#![forbid(unsafe_code)]

pub mod book;
pub mod formula;
pub mod kernel;

#[cfg(feature = "engine")]
pub mod algebra;
#[cfg(feature = "engine")]
pub mod corpus;
#[cfg(feature = "engine")]
pub mod evaluate;
#[cfg(feature = "engine")]
pub mod judge;
#[cfg(feature = "engine")]
pub mod model;
#[cfg(feature = "engine")]
pub mod number;
#[cfg(feature = "engine")]
pub mod prover;
#[cfg(feature = "engine")]
pub mod special;

pub mod cli;
pub mod report;
