//! Finds proofs of identities: steps that the kernel checks, from which it makes a theorem.
//!
//! A [`Builder`] keeps a proof and its record. What a step needs to know of the formulas in it, that
//! they are finite or positive, is made known by the search for order ([`order`]); equations between
//! finite formulas are made by [`equal`]; the tactics for integrals, sums and means rest on both.

#![allow(dead_code)] // until the tactics use all of it

mod atoms;
mod border;
mod builder;
mod equal;
mod factor;
mod field;
mod finite;
mod form;
mod handelman;
mod known;
mod logs;
mod order;
mod powers;
mod prune;
mod roots;
mod shifts;
mod simplex;
#[cfg(test)]
mod tests;
mod undefined;

pub(crate) use builder::Builder;
mod evaluate;
mod indicator;
mod integral;
mod integrand;
mod law;
mod limit;
mod link;
mod make;
mod matching;
mod moment;
mod primitive;
mod range;
mod rational;
mod special;
mod substitution;
mod sum;
mod unfold;
mod weight;

pub use link::prove;
