//! What all commands that judge a book have in common: their options, the run, its progress bar.

use super::library::Library;
use super::output::{Failure, of_run, to_stderr};
use super::progress::Bar;
use crate::corpus::cache::Cache;
use crate::corpus::{self, Alarm, FromCache, Options, Run};
use crate::judge::Settings;
use clap::Args;

/// Which claims are judged, and how hard.
#[derive(Debug, Args)]
pub(super) struct Judging {
    #[command(flatten)]
    pub(super) library: Library,
    /// Threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Seed of all random points
    #[arg(long, value_name = "S", default_value_t = Settings::default().seed)]
    seed: u64,
    /// Digits to which enclosures must agree
    #[arg(long, value_name = "D", default_value_t = Settings::default().digits,
        value_parser = clap::value_parser!(u32).range(1..=10_000))]
    digits: u32,
    /// Counted steps that a claim may spend
    #[arg(long, value_name = "N", default_value_t = Settings::default().budget)]
    budget: u64,
    /// Judges every claim anew, whatever earlier runs found
    #[arg(long)]
    no_cache: bool,
    /// No progress bar; of the claims only those that are not as expected
    #[arg(long, short)]
    pub(super) quiet: bool,
}

/// What a command wants of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Want {
    /// Reports, those of earlier runs as well.
    Reports,
    /// Reports with their evidence, which is not kept from earlier runs.
    Evidence,
    /// That the evidence is written as certificates.
    Saved,
}

impl Judging {
    /// Judges the claims of the book: those that `only` names, or all.
    pub(super) fn run(&self, only: Vec<String>, want: Want) -> Result<Run, Failure> {
        let book = self.library.open()?;
        let settings = self.settings();
        let options = Options {
            only,
            jobs: self.jobs.unwrap_or(0).into(),
            certificates: Some(self.library.store()),
            save: want == Want::Saved,
            cache: match want {
                Want::Reports if !self.no_cache => Cache::of_user(),
                _ => None,
            },
        };
        let count = corpus::chosen(&book, &options.only).map_err(of_run)?.len();
        let bar = Bar::new(count, "claims", self.quiet);
        let run = corpus::run(&book, &settings, &options, |done| bar.show(done));
        bar.clear();
        let run = run.map_err(of_run)?;
        if !self.quiet {
            cache_notes(&run.cached)
                .iter()
                .for_each(|note| to_stderr(note));
        }
        Ok(run)
    }
}

impl Judging {
    pub(super) fn settings(&self) -> Settings {
        Settings {
            seed: self.seed,
            digits: self.digits,
            budget: self.budget,
            ..Settings::default()
        }
    }

    /// Adds simulations to what a run found to hold; those that contradict a verdict come back.
    pub(super) fn simulate(&self, run: &mut Run) -> Result<Vec<Alarm>, Failure> {
        let book = self.library.open()?;
        let bar = Bar::new(run.reports.len(), "claims simulated", self.quiet);
        let jobs = self.jobs.unwrap_or(0).into();
        let progress = |done| bar.show(done);
        let alarms = corpus::add_simulations(run, &book, &self.settings(), jobs, progress);
        bar.clear();
        alarms.map_err(of_run)
    }
}

/// What the user may want to know of the cache; none of it is an error.
fn cache_notes(cached: &FromCache) -> Vec<String> {
    let mut notes = Vec::new();
    if cached.damaged > 0 {
        notes.push(format!(
            "note: {} damaged in the cache and judged anew",
            reports(cached.damaged)
        ));
    }
    if cached.unwritable > 0 {
        let count = reports(cached.unwritable);
        notes.push(format!("note: {count} could not be kept in the cache"));
    }
    notes
}

fn reports(count: usize) -> String {
    match count {
        1 => "1 report".to_owned(),
        n => format!("{n} reports"),
    }
}
