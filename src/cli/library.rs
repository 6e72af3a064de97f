//! Finding and opening the book.

use super::output::Failure;
use crate::book::{self, Book};
use std::path::{Path, PathBuf};

/// Where the book is when no path is given.
const DEFAULT: &str = "proofs";

/// The book of all chapters under `paths`, or under `proofs` where none is given.
pub(super) fn open(paths: &[PathBuf]) -> Result<Book, Failure> {
    let default = [PathBuf::from(DEFAULT)];
    let paths = if paths.is_empty() {
        if !Path::new(DEFAULT).exists() {
            let hint = "name the chapters (claimcheck check PATH...) or go to the folder that holds `proofs`";
            return Err(Failure::input(
                "there is no folder `proofs` here",
                Some(hint),
            ));
        }
        &default[..]
    } else {
        paths
    };
    let book = book::read(paths).map_err(unreadable)?;
    if book.claims.is_empty() {
        let places: Vec<String> = paths
            .iter()
            .map(|path| path.display().to_string())
            .collect();
        let hint = "claims are fenced blocks of Markdown files (.md) that begin with ```claim ID";
        return Err(Failure::input(
            &format!("there is no claim in {}", places.join(", ")),
            Some(hint),
        ));
    }
    Ok(book)
}

fn unreadable(errors: Vec<crate::formula::Diagnostic>) -> Failure {
    Failure::at("stub", "", &errors[0])
}
