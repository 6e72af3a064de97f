//! `claimcheck simulate`: f64 Monte-Carlo against theory.

mod claim;

use super::library::Library;
use super::output::{Exit, Failure};
use crate::simulate::verdict::battery::LEVEL;
use clap::{Args, ValueEnum};

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
    /// How often all is drawn [default: 10000]
    #[arg(long, value_name = "N", default_value_t = 10_000, hide_default_value = true,
        value_parser = clap::value_parser!(u64).range(2..))]
    runs: u64,
    /// Seed of all draws
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// How likely a false alarm may be, in the whole
    #[arg(long, value_name = "P", default_value_t = LEVEL)]
    level: f64,
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
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
        let json = self.format == Format::Json;
        match &self.id {
            Some(id) => claim::Asked {
                id,
                library: &self.library,
                set: &self.set,
                runs: self.runs,
                seed: self.seed,
                level: self.level,
            }
            .run(json),
            None => Err(Failure::input("no claim", None)),
        }
    }
}
