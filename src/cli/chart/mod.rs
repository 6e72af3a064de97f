//! `claimcheck chart`: pictures with their data.

mod accuracy;
mod figures;
mod stability;
mod survey;

use super::output::{Exit, Failure, internal};
use clap::{Args, Subcommand};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// No file that is read here is larger, in bytes; a map of a full run has two million.
const LARGEST: u64 = 1 << 26;

/// Draws pictures, and writes their data beside them
#[derive(Debug, Args)]
pub(super) struct Chart {
    #[command(subcommand)]
    of: Of,
}

#[derive(Debug, Subcommand)]
enum Of {
    Accuracy(accuracy::Accuracy),
    #[command(hide = true)]
    Count(accuracy::Count),
    Figures(figures::Figures),
    Stability(stability::Stability),
}

impl Chart {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        match self.of {
            Of::Accuracy(accuracy) => accuracy.run(),
            Of::Count(count) => count.run(),
            Of::Figures(figures) => figures.run(),
            Of::Stability(stability) => stability.run(),
        }
    }
}

/// Makes a folder where there is none.
fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| {
        let path = path.display();
        let message = match error.kind() {
            ErrorKind::AlreadyExists => format!("{path} is no folder"),
            _ => format!("{path} cannot be made: {error}"),
        };
        Failure::input(&message, Some("name a folder that can be written to"))
    })
}

/// So many threads, or one a core.
fn threads(jobs: Option<u16>) -> Result<ThreadPool, Failure> {
    let threads = ThreadPoolBuilder::new().num_threads(jobs.unwrap_or(0).into());
    threads
        .build()
        .map_err(|error| internal(&error.to_string()))
}

/// The text of a file, `None` where there is none: of an ordinary one, so that nothing is waited for.
fn text_of(path: &Path) -> io::Result<Option<String>> {
    let file = match fs::metadata(path) {
        Ok(data) if data.is_file() => File::open(path)?,
        Ok(_) => return Err(io::Error::other("no ordinary file")),
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    let mut text = String::new();
    match file.take(LARGEST + 1).read_to_string(&mut text)? as u64 > LARGEST {
        true => Err(io::Error::other("larger than such a file can be")),
        false => Ok(Some(text)),
    }
}

/// The text of a file that must not be replaced unless it is ours.
fn found(path: &Path) -> Result<Option<String>, Failure> {
    text_of(path).map_err(|error| {
        let message = format!("{} cannot be read: {error}", path.display());
        Failure::input(&message, Some(ELSEWHERE))
    })
}

/// A file that another command made, or that does not tell.
fn not_ours(path: &Path) -> Failure {
    let path = path.display();
    let message = format!("{path} is no file of this command, version and machine");
    Failure::input(&message, Some(ELSEWHERE))
}

const ELSEWHERE: &str = "name another folder with --out, or remove the file";
