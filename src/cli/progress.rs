//! How far a long run has come.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Once;
use std::time::{Duration, Instant};

/// A run that takes longer shows a progress bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// A progress bar on stderr, if that is a terminal, from the second second on.
pub(super) struct Bar {
    bar: ProgressBar,
    quiet: bool,
    started: Instant,
    shown: Once,
}

impl Bar {
    /// For so many things to do, by their name in the plural.
    pub(super) fn new(count: usize, things: &str, quiet: bool) -> Bar {
        let bar = ProgressBar::with_draw_target(Some(count as u64), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template(&format!(
            "{{wide_bar}} {{pos}}/{{len}} {things}, {{eta}} left"
        ));
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Bar {
            bar,
            quiet,
            started: Instant::now(),
            shown: Once::new(),
        }
    }

    /// Takes the bar away while something is printed.
    pub(super) fn aside<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// From any thread.
    pub(super) fn show(&self, done: usize) {
        if !self.quiet && self.started.elapsed() > PATIENCE {
            self.shown
                .call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
        // Threads may report out of order; the bar never goes back.
        self.bar.set_position(self.bar.position().max(done as u64));
    }
}
