//! Finding and opening the book.

use super::output::Failure;
use crate::book::{self, Book, FileError};
use crate::report::diagnostic;
use std::path::{Path, PathBuf};

/// Where the book is when no path is given.
const DEFAULT: &str = "proofs";

/// How many errors are shown; a reader mends the first ones first.
const SHOWN_ERRORS: usize = 20;

/// The book of all chapters under `paths`, or under `proofs` where none is given.
pub(super) fn open(paths: &[PathBuf]) -> Result<Book, Failure> {
    let default = [PathBuf::from(DEFAULT)];
    let paths = if paths.is_empty() {
        if !Path::new(DEFAULT).exists() {
            let hint = "name the chapters, or go to the folder that holds `proofs`";
            return Err(Failure::input(
                "there is no folder `proofs` here",
                Some(hint),
            ));
        }
        &default[..]
    } else {
        paths
    };
    let book = book::read(paths).map_err(|errors| unreadable(&errors))?;
    if book.claims.is_empty() {
        let places: Vec<String> = paths
            .iter()
            .map(|path| path.display().to_string())
            .collect();
        let hint = "claims are fenced blocks of Markdown files (.md) that begin with ```claim ID";
        let message = format!("there is no claim in {}", places.join(", "));
        return Err(Failure::input(&message, Some(hint)));
    }
    Ok(book)
}

/// The first errors with their places, and how many more there are.
fn unreadable(errors: &[FileError]) -> Failure {
    let mut texts: Vec<String> = errors.iter().take(SHOWN_ERRORS).map(one).collect();
    if errors.len() > SHOWN_ERRORS {
        let more = format!("{} more errors", errors.len() - SHOWN_ERRORS);
        texts.push(diagnostic::plain(&more, None));
    }
    Failure::rendered(texts.join("\n\n"))
}

fn one(error: &FileError) -> String {
    let file = error.file.display().to_string();
    if error.text.is_empty() {
        let message = format!("{file}: {}", error.diagnostic.message);
        return diagnostic::plain(&message, error.diagnostic.hint.as_deref());
    }
    diagnostic::render(&file, &error.text, &error.diagnostic)
}
