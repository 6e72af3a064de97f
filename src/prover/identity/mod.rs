//! Finds proofs of identities: steps that the kernel checks, from which it makes a theorem.
//!
//! A [`Builder`] keeps a proof and its record. What a step needs to know of the formulas in it, that
//! they are finite or positive, is made known by the search for order ([`order`]); equations between
//! finite formulas are made by [`equal`]; the tactics for integrals, sums and means rest on both.

#![allow(dead_code)] // until the tactics use all of it

mod builder;
mod equal;
mod field;
mod finite;
mod form;
mod handelman;
mod known;
mod order;
mod prune;
mod simplex;
#[cfg(test)]
mod tests;
mod undefined;

pub(crate) use builder::Builder;
