//! Finding and opening the book and the certificates that belong to it.

use super::output::Failure;
use crate::book::{self, Book, FileError};
use crate::corpus::certificates::Store;
use crate::report::diagnostic;
use clap::Args;
use std::path::{Path, PathBuf};

/// Where the book is when no path is given.
const DEFAULT: &str = "proofs";

/// How many errors are shown; a reader mends the first ones first.
const SHOWN_ERRORS: usize = 20;

/// The chapters that are read, and where their certificates are.
#[derive(Debug, Args)]
pub(super) struct Library {
    /// Chapters, or folders of chapters [default: proofs]
    #[arg(value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// The folder of certificates [default: `certificates` in the folder or beside the chapter]
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
}

impl Library {
    /// The book of all chapters under the paths, or under `proofs` where none is given.
    pub(super) fn open(&self) -> Result<Book, Failure> {
        if self.paths.is_empty() && !Path::new(DEFAULT).exists() {
            let hint = "name the chapters, or go to the folder that holds `proofs`";
            return Err(Failure::input(
                "there is no folder `proofs` here",
                Some(hint),
            ));
        }
        read(&self.paths())
    }

    /// The store of certificates, which need not be there yet.
    pub(super) fn store(&self) -> Store {
        match &self.certificates {
            Some(folder) => Store::at(folder),
            None => Store::beside(&self.paths()),
        }
    }

    /// The folder of certificates that the command line names.
    pub(super) fn named_folder(&self) -> Option<&Path> {
        self.certificates.as_deref()
    }

    /// Whether all chapters of all folders are read, so that a certificate without a claim is one too
    /// many.
    pub(super) fn is_whole(&self) -> bool {
        self.paths().iter().all(|path| path.is_dir())
    }

    fn paths(&self) -> Vec<PathBuf> {
        match self.paths.is_empty() {
            true => vec![PathBuf::from(DEFAULT)],
            false => self.paths.clone(),
        }
    }
}

fn read(paths: &[PathBuf]) -> Result<Book, Failure> {
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
