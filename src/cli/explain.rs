//! `claimcheck explain ID`: all that is known of one claim.

use super::check::{exit, unwritable};
use super::judging::Judging;
use super::output::{Exit, Failure, to_stdout};
use crate::report::{human::detail, json};
use clap::{Args, ValueEnum};

/// Tells all about one claim: its statement as written and unfolded, verdict, evidence, witness
#[derive(Debug, Args)]
pub(super) struct Explain {
    /// The claim
    id: String,
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
    #[command(flatten)]
    judging: Judging,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Human,
    Json,
}

impl Explain {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let run = self.judging.run(vec![self.id], false)?;
        let text = match self.format {
            Format::Human => run.reports.iter().map(detail::render).collect(),
            Format::Json => json::render(&run).map_err(unwritable)?,
        };
        to_stdout(&text)?;
        Ok(exit(&run))
    }
}
