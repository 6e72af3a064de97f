//! `claimcheck chart`: pictures with their data.

mod accuracy;
mod figures;
mod stability;
mod survey;

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
