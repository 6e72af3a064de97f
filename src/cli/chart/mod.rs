//! `claimcheck chart`: pictures with their data.

mod figures;

use super::output::{Exit, Failure};
use clap::{Args, Subcommand};

/// Draws pictures, and writes their data beside them
#[derive(Debug, Args)]
pub(super) struct Chart {
    #[command(subcommand)]
    of: Of,
}

#[derive(Debug, Subcommand)]
enum Of {
    Figures(figures::Figures),
}

impl Chart {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        match self.of {
            Of::Figures(figures) => figures.run(),
        }
    }
}
