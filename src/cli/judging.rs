//! What all commands that judge a book have in common: their options, the run, its progress bar.

use super::library::Library;
use super::output::{Failure, of_run};
use crate::corpus::{self, Options, Run};
use crate::judge::Settings;
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Once;
use std::time::{Duration, Instant};

/// A run that takes longer shows a progress bar.
const PATIENCE: Duration = Duration::from_secs(1);

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
    /// No progress bar; of the claims only those that are not as expected
    #[arg(long, short)]
    pub(super) quiet: bool,
}

impl Judging {
    /// Judges the claims of the book: those that `only` names, or all; `save` writes certificates.
    pub(super) fn run(&self, only: Vec<String>, save: bool) -> Result<Run, Failure> {
        let book = self.library.open()?;
        let settings = Settings {
            seed: self.seed,
            digits: self.digits,
            budget: self.budget,
            ..Settings::default()
        };
        let options = Options {
            only,
            jobs: self.jobs.unwrap_or(0).into(),
            certificates: Some(self.library.store()),
            save,
        };
        let count = corpus::chosen(&book, &options.only).map_err(of_run)?.len();
        let bar = Bar::new(count, self.quiet);
        let run = corpus::run(&book, &settings, &options, |done| bar.show(done));
        bar.bar.finish_and_clear();
        run.map_err(of_run)
    }
}

/// A progress bar on stderr, if that is a terminal, from the second second on.
struct Bar {
    bar: ProgressBar,
    quiet: bool,
    started: Instant,
    shown: Once,
}

impl Bar {
    fn new(count: usize, quiet: bool) -> Bar {
        let bar = ProgressBar::with_draw_target(Some(count as u64), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} claims, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Bar {
            bar,
            quiet,
            started: Instant::now(),
            shown: Once::new(),
        }
    }

    fn show(&self, done: usize) {
        if !self.quiet && self.started.elapsed() > PATIENCE {
            self.shown
                .call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
        // Threads may report out of order; the bar never goes back.
        self.bar.set_position(self.bar.position().max(done as u64));
    }
}
