//! `claimcheck check`: the main job.

use super::judging::{Judging, Want};
use super::output::{Exit, Failure, internal, to_stderr, to_stdout};
use crate::corpus::certificates::Store;
use crate::corpus::{Alarm, Run};
use crate::report::human::{self, Rows};
use crate::report::{json, junit, sarif};
use clap::{Args, ValueEnum};

/// Judges the claims of a book and compares the verdicts with what is expected
#[derive(Debug, Args)]
pub(super) struct Check {
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
    /// Only the claims with these ids
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    only: Vec<String>,
    /// Writes the certificates of what is proved or refuted
    #[arg(long)]
    save: bool,
    /// Simulates what holds as well: a z-value beside each verdict with draws, which never changes it
    #[arg(long)]
    simulate: bool,
    #[command(flatten)]
    judging: Judging,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Human,
    Json,
    Junit,
    Sarif,
}

impl Check {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let want = if self.save {
            Want::Saved
        } else {
            Want::Reports
        };
        let mut run = self.judging.run(self.only, want)?;
        let alarms = match self.simulate {
            true => self.judging.simulate(&mut run)?,
            false => vec![],
        };
        let rows = if self.judging.quiet {
            Rows::Unexpected
        } else {
            Rows::All
        };
        to_stdout(&render(&run, self.format, rows)?)?;
        if self.save && !self.judging.quiet {
            to_stderr(&saved(&run, &self.judging.library.store()));
        }
        match alarms.is_empty() {
            true => Ok(exit(&run)),
            false => Err(alarmed(&alarms)),
        }
    }
}

/// A simulation and a verdict that contradict each other: one of them is wrong, whatever was expected.
fn alarmed(alarms: &[Alarm]) -> Failure {
    let told = alarms.iter().map(|alarm| {
        let Alarm {
            id,
            verdict,
            simulation,
        } = alarm;
        let words = verdict.word();
        format!(
            "{id} is {words}, but its simulation says z = {:.1}",
            simulation.z
        )
    });
    internal(&told.collect::<Vec<_>>().join("; "))
}

/// What became of the certificates, in words.
fn saved(run: &Run, store: &Store) -> String {
    let folders: Vec<String> = store
        .folders()
        .iter()
        .map(|folder| folder.display().to_string())
        .collect();
    format!(
        "certificates in {}: {} written, {} unchanged",
        folders.join(", "),
        run.saved.written,
        run.saved.unchanged
    )
}

fn render(run: &Run, format: Format, rows: Rows) -> Result<String, Failure> {
    match format {
        Format::Human => Ok(human::render(run, rows)),
        Format::Json => json::render(run).map_err(unwritable),
        Format::Junit => junit::render(run).map_err(unwritable),
        Format::Sarif => sarif::render(run).map_err(unwritable),
    }
}

/// A format that cannot hold the report: a fault of ours.
pub(super) fn unwritable(error: impl std::fmt::Display) -> Failure {
    Failure {
        exit: Exit::Internal,
        ..Failure::input(&format!("the report cannot be written: {error}"), None)
    }
}

/// 0 where every claim is as expected, else 1.
pub(super) fn exit(run: &Run) -> Exit {
    if run.reports.iter().all(|report| report.as_expected) {
        Exit::AsExpected
    } else {
        Exit::NotAsExpected
    }
}
