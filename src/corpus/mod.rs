//! A whole book: running its claims, keeping their reports and certificates, replaying what is kept.
//!
//! Only the running needs the engine; certificates are read, written and replayed without it.

#[cfg(feature = "engine")]
pub mod cache;
pub mod certificates;
pub mod file;
pub mod recheck;
#[cfg(feature = "engine")]
mod run;
#[cfg(feature = "engine")]
mod simulate;

#[cfg(feature = "engine")]
pub use run::{FromCache, Options, Run, Saved, run};
#[cfg(feature = "engine")]
pub use simulate::{Alarm, add_simulations};

use crate::book::{Book, Claim};
use crate::formula::nearest;

/// Why a run has no reports.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// `only` names a claim that the book does not have; the id spelled most like it.
    #[error("no claim has the id `{id}`")]
    UnknownId { id: String, nearest: Option<String> },
    /// A fault of this program, not of the book.
    #[error("claim {id}: {message}")]
    Internal { id: String, message: String },
    /// A certificate that was to be saved cannot be.
    #[error("{0}")]
    Unwritable(String),
    #[error("the threads cannot be started: {0}")]
    Threads(String),
}

/// The claims that `only` names, or all where it names none, in the order of the book.
///
/// # Errors
/// [`Error::UnknownId`]
pub fn chosen<'a>(book: &'a Book, only: &[String]) -> Result<Vec<&'a Claim>, Error> {
    for id in only {
        if !book.claims.iter().any(|claim| *claim.id == **id) {
            return Err(unknown(book, id));
        }
    }
    let wanted = |claim: &&Claim| only.is_empty() || only.iter().any(|id| **id == *claim.id);
    Ok(book.claims.iter().filter(wanted).collect())
}

fn unknown(book: &Book, id: &str) -> Error {
    let ids = book.claims.iter().map(|claim| &*claim.id);
    Error::UnknownId {
        id: id.to_owned(),
        nearest: nearest(id, ids).map(str::to_owned),
    }
}
