//! `claimcheck recheck`: replays certificates with the kernel alone.
//!
//! The statement comes from the book, the proof or the point from the certificate, the verdict from the
//! kernel; nothing of the engine that found them is used, so this command is in a build without it too.

mod report;

use super::library::Library;
use super::output::{Exit, Failure, internal, to_stdout};
use crate::corpus::recheck::{self, Failed, Recheck as Found};
use clap::Args;
use std::path::PathBuf;

/// Replays every certificate of the book with the kernel alone
#[derive(Debug, Args)]
pub(super) struct Recheck {
    #[command(flatten)]
    library: Library,
    /// Replays the witnesses of a report (check --format json) instead
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

impl Recheck {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let book = self.library.open()?;
        if let Some(report) = &self.report {
            return report::replay(report, &book);
        }
        if let Some(folder) = self
            .library
            .named_folder()
            .filter(|folder| !folder.is_dir())
        {
            let message = format!("there is no folder {}", folder.display());
            let hint = "write certificates with: claimcheck check --save";
            return Err(Failure::input(&message, Some(hint)));
        }
        let found = recheck::recheck(&book, &self.library.store(), self.library.is_whole());
        let found = found.map_err(|error| {
            Failure::input(&format!("the certificates cannot be listed: {error}"), None)
        })?;
        if let Some(fault) = found.contradictions.first() {
            return Err(internal(&line(fault)));
        }
        to_stdout(&words(&found))?;
        Ok(match found.failures.is_empty() {
            true => Exit::AsExpected,
            false => Exit::NotAsExpected,
        })
    }
}

fn line(failed: &Failed) -> String {
    let Failed {
        file,
        line,
        id,
        reason,
    } = failed;
    format!("{}:{line}: {id}: {reason}", file.display())
}

/// A line for each failure, then the counts.
fn words(found: &Found) -> String {
    let mut text = String::new();
    for failed in &found.failures {
        text.push_str(&line(failed));
        text.push('\n');
    }
    let Found {
        theorems,
        refutations,
        steps,
        not_replayed,
        ..
    } = found;
    text.push_str(&format!(
        "{theorems} theorems and {refutations} refutations replayed by the kernel, in {steps} steps\n"
    ));
    if !not_replayed.is_empty() {
        text.push_str(&format!(
            "{} expansions refuted by their remainder were not replayed: {}\n",
            not_replayed.len(),
            not_replayed.join(", ")
        ));
    }
    match found.failures.len() {
        0 => text.push_str("all certificates hold\n"),
        n => text.push_str(&format!("{n} failed\n")),
    }
    text
}
