//! Finds proofs of identities: steps that the kernel checks, from which it makes a theorem.
//!
//! A [`Builder`] keeps a proof and its record. What a step needs to know of the formulas in it, that
//! they are finite or positive, is made known by the search for order ([`order`]); equations between
//! finite formulas are made by [`equal`]; the tactics for integrals, sums and means rest on both.

mod additive;
mod atoms;
mod border;
mod bounded;
mod builder;
mod choice;
mod decide;
mod derivative;
mod disc;
mod equal;
mod evaluate;
mod factor;
mod field;
mod finite;
mod form;
mod generators;
mod handelman;
mod integral;
mod integrand;
mod known;
mod law;
mod limit;
mod linear;
mod link;
mod logs;
mod make;
mod matching;
mod moment;
mod monotone;
mod order;
mod powers;
mod primitive;
mod prune;
mod range;
mod rational;
mod roots;
mod shifts;
mod simplex;
mod slope;
mod special;
mod square;
mod substitution;
mod sum;
mod support;
#[cfg(test)]
mod tests;
mod undefined;
mod unfold;
mod weight;

pub(crate) use builder::Builder;
pub use link::prove;
