//! `claimcheck errata`: the errata sheet.

use super::check::exit;
use super::judging::{Judging, Want};
use super::output::{Exit, Failure, to_stdout};
use crate::report::errata;
use clap::{Args, ValueEnum};

/// Writes the errata sheet: wrong statements, missing conditions, slips; the most misleading first
#[derive(Debug, Args)]
pub(super) struct Errata {
    #[arg(long, value_enum, default_value_t = Format::Markdown)]
    format: Format,
    /// Only the claims with these ids
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    only: Vec<String>,
    #[command(flatten)]
    judging: Judging,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Markdown,
    Latex,
}

impl Errata {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let run = self.judging.run(self.only, Want::Reports)?;
        let text = match self.format {
            Format::Markdown => errata::markdown(&run.reports),
            Format::Latex => errata::latex(&run.reports),
        };
        to_stdout(&text)?;
        Ok(exit(&run))
    }
}
