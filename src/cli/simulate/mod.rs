//! `claimcheck simulate`: f64 Monte-Carlo against theory.

mod claim;
mod scene;

use super::library::Library;
use super::output::{Exit, Failure};
use crate::simulate::verdict::battery::LEVEL;
use clap::{Args, ValueEnum};

/// Runs of photons: those of the thesis.
const RUNS: u64 = 10_000;

/// Runs of a claim at each point: variances need many before their z counts.
const CLAIM_RUNS: u64 = 100_000;

/// Simulates the photons of a layout, or a claim from its own draws, and compares with theory
#[derive(Debug, Args)]
pub(super) struct Simulate {
    /// A claim of the book; without it photons are simulated
    id: Option<String>,
    #[command(flatten)]
    library: Library,
    /// The point at which a claim is simulated: k=5,n=20 [default: some of its domain]
    #[arg(long, value_name = "NAME=VALUE,...", requires = "id")]
    set: Vec<String>,
    #[command(flatten)]
    photons: scene::Photons,
    /// How often all is drawn [default: 10000, of a claim 100000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(2..))]
    runs: Option<u64>,
    /// Seed of all draws
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// How likely a false alarm may be, in the whole
    #[arg(long, value_name = "P", default_value_t = LEVEL)]
    level: f64,
    /// Threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    Human,
    Json,
}

impl Simulate {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        if !(self.level > 0.0 && self.level < 1.0) {
            return Err(Failure::input(
                "a level lies between 0 and 1",
                Some("write --level 1e-6"),
            ));
        }
        if self.id.is_none() && !self.set.is_empty() {
            return Err(Failure::input(
                "--set belongs to a claim",
                Some("name the claim"),
            ));
        }
        let json = self.format == Format::Json;
        match &self.id {
            Some(id) => claim::Asked {
                id,
                library: &self.library,
                set: &self.set,
                runs: claim_runs(self.runs.unwrap_or(CLAIM_RUNS))?,
                seed: self.seed,
                level: self.level,
            }
            .run(json),
            None => self.photons.run(&scene::Running {
                runs: self.runs.unwrap_or(RUNS),
                seed: self.seed,
                level: self.level,
                jobs: self.jobs.unwrap_or(0).into(),
                quiet: self.quiet,
                json,
            }),
        }
    }
}

/// Each run of a claim is kept until its mean is known.
fn claim_runs(runs: u64) -> Result<u64, Failure> {
    const MOST: u64 = 10_000_000;
    match runs <= MOST {
        true => Ok(runs),
        false => Err(Failure::input(
            "a claim is simulated in at most 10^7 runs",
            None,
        )),
    }
}
