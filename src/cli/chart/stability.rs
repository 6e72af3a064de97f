//! `claimcheck chart stability`: where formulas fail.

use super::super::output::{Exit, Failure};
use super::survey::Desk;
use super::threads;
use crate::report::figures::Pace;
use crate::report::survey::stability;
use clap::Args;
use std::path::PathBuf;

/// Maps the digits that formulas in doubles lose, the method that is chosen, and what simulation reaches
#[derive(Debug, Args)]
#[command(after_help = RESUMED)]
pub(super) struct Stability {
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Fewer cells and runs
    #[arg(long)]
    quick: bool,
    /// Threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
}

const RESUMED: &str = "\
Writes six charts as CSV and SVG, and stability.md, which tells them in words. A run that was killed goes on where it stopped; \
what is finished is only drawn again. Any number of threads gives the same bytes on the same machine.";

impl Stability {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let desk = Desk {
            out: self.out,
            quiet: self.quiet,
        };
        let surveys = stability(Pace::of(self.quick));
        threads(self.jobs)?.install(|| desk.run(&surveys))
    }
}
