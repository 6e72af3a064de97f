//! `claimcheck simulate`: the photons of a layout, drawn many times, against theory.

use super::super::output::{Exit, Failure, internal, to_stdout, write_file};
use super::super::progress::Bar;
use crate::model::Layout;
use crate::report::simulate::{Outcome, csv, human, json, picture};
use crate::simulate::verdict::{self, kolmogorov, sequential::Watch};
use crate::simulate::{
    Checkpoint, CheckpointError, Fault, Mode, Scene, SceneError, Simulation, Sums,
};
use clap::{Args, ValueEnum};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

/// What is drawn, and what becomes of it.
#[derive(Debug, Args)]
pub(super) struct Photons {
    /// none (unstratified), 1, 2, listing, or the photons of each shell: 5,7,9 [default: 2]
    #[arg(long, value_name = "STRATEGY", conflicts_with = "id")]
    strategy: Option<String>,
    /// The last photon [default: 80200, or all of a sequence]
    #[arg(long, value_name = "N", conflicts_with = "id")]
    photons: Option<u64>,
    /// Draws radii in so many dimensions, and takes U as r^d [default: U alone]
    #[arg(long, value_name = "D", conflicts_with = "id")]
    dim: Option<u32>,
    /// The photons that are asked for, and their shells alone: 4,50,1000 [default: all]
    #[arg(
        long,
        value_name = "K,...",
        value_delimiter = ',',
        conflicts_with = "id"
    )]
    k: Vec<u64>,
    /// How the photons of a shell are drawn
    #[arg(long, value_enum, default_value_t = Draw::Cheapest, conflicts_with = "id")]
    mode: Draw,
    /// A fault on purpose, to see it found
    #[arg(long, value_enum, conflicts_with = "id")]
    fault: Option<Planted>,
    /// Also tests whether U of these photons has its law (Kolmogorov and Smirnov)
    #[arg(
        long,
        value_name = "K,...",
        value_delimiter = ',',
        conflicts_with = "id"
    )]
    law: Vec<u64>,
    /// Stops as soon as each mean asked for by --k is known to this, or contradicts theory
    #[arg(long, value_name = "WIDTH", requires = "k", conflicts_with = "id")]
    until: Option<f64>,
    /// A file that keeps what is done: the same command goes on from there
    #[arg(long, value_name = "FILE", conflicts_with = "id")]
    journal: Option<PathBuf>,
    /// Means and variances of each photon beside theory, as CSV
    #[arg(long, value_name = "FILE", conflicts_with = "id")]
    csv: Option<PathBuf>,
    /// A picture of it
    #[arg(long, value_name = "FILE", conflicts_with = "id")]
    svg: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Draw {
    /// Whatever costs least
    Cheapest,
    /// Uniform numbers or radii, sorted: the thesis's way
    Sorted,
    /// Sums of exponential spacings: no sort
    Spacings,
    /// Each photon asked for by itself
    Beta,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Planted {
    /// k - 1 for k in the estimator
    Estimator,
    /// A photon too many in each shell
    Shell,
    /// A photon of each shell lost
    Dropped,
    /// Photons not sorted
    Unsorted,
    /// Photons sorted the wrong way
    Descending,
    /// A generator off by a thousandth
    Biased,
}

/// How it is to be run.
pub(super) struct Running {
    pub(super) runs: u64,
    pub(super) seed: u64,
    pub(super) level: f64,
    pub(super) jobs: usize,
    pub(super) quiet: bool,
    pub(super) json: bool,
}

impl Photons {
    /// Exit code 1 where the simulation contradicts theory.
    pub(super) fn run(&self, running: &Running) -> Result<Exit, Failure> {
        let scene = self.scene(running)?;
        let simulation = Simulation::new(scene.clone()).map_err(refused)?;
        let threads = rayon::ThreadPoolBuilder::new().num_threads(running.jobs);
        let threads = threads
            .build()
            .map_err(|error| internal(&error.to_string()))?;
        let outcome = threads.install(|| self.outcome(&simulation, running))?;
        to_stdout(&match running.json {
            false => human(&scene, &outcome),
            true => json(&scene, &outcome),
        })?;
        if let Some(path) = &self.csv {
            write_file(path, &csv(&outcome))?;
        }
        if let Some(path) = &self.svg {
            write_file(path, &picture(&scene, &outcome))?;
        }
        Ok(match outcome.agrees() {
            true => Exit::AsExpected,
            false => Exit::NotAsExpected,
        })
    }

    fn outcome(&self, simulation: &Simulation, running: &Running) -> Result<Outcome, Failure> {
        let scene = simulation.scene();
        // The tests of means and those of laws have half of the level each.
        let level = match self.law.is_empty() {
            true => running.level,
            false => running.level / 2.0,
        };
        let mut checkpoint = match &self.journal {
            Some(path) => Some(Checkpoint::open(path, simulation).map_err(unusable)?),
            None => None,
        };
        let before = checkpoint.as_ref().map_or(0, Checkpoint::runs);
        let mut watch = match self.until {
            Some(width) => Some(self.watch(scene, width, level, before)?),
            None => None,
        };
        let bar = Bar::new(scene.runs as usize, "runs", running.quiet);
        let started = Instant::now();
        let mut last = Sums::new(simulation.photons().to_vec());
        let mut failed = None;
        let sums = simulation.run(checkpoint.as_mut(), |sums| {
            bar.show(sums.runs as usize);
            let (Some(watch), Some(width)) = (&mut watch, self.until) else {
                return ControlFlow::Continue(());
            };
            let Ok(chunk) = sums.since(&last) else {
                return ControlFlow::Break(());
            };
            let fed = watch.feed(&chunk);
            last.clone_from(sums);
            match fed {
                Ok(()) if watch.contradicts() || watch.is_precise(width) => ControlFlow::Break(()),
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    failed = Some(error);
                    ControlFlow::Break(())
                }
            }
        });
        bar.clear();
        let seconds = started.elapsed().as_secs_f64();
        if let Some(error) = failed {
            return Err(unknown(error));
        }
        let sums = sums.map_err(unusable)?;
        let findings = verdict::battery::findings(&scene.layout, &sums, level);
        Ok(Outcome {
            report: verdict::battery(&scene.layout, &sums, level).map_err(unknown)?,
            findings: findings.map_err(unknown)?,
            drawn: simulation.drawn_a_run() as f64 * (sums.runs - before) as f64,
            laws: self.laws(simulation, &sums)?,
            sums,
            seconds,
            watch,
            width: self.until,
        })
    }

    fn watch(&self, scene: &Scene, width: f64, level: f64, before: u64) -> Result<Watch, Failure> {
        if width.is_nan() || width <= 0.0 {
            return Err(Failure::input(
                "a width is positive",
                Some("write --until 1e-4"),
            ));
        }
        if before > 0 {
            let hint = Some("leave out --journal, or --until");
            return Err(Failure::input("a watch begins with the first run", hint));
        }
        let mut ks = [&self.k[..], &self.law].concat();
        ks.sort_unstable();
        ks.dedup();
        Watch::new(&scene.layout, &ks, level).map_err(unknown)
    }

    /// Whether U of some photons has its law.
    fn laws(
        &self,
        simulation: &Simulation,
        sums: &Sums,
    ) -> Result<Vec<(u64, kolmogorov::Kolmogorov)>, Failure> {
        let layout = &simulation.scene().layout;
        let mut found = vec![];
        for &k in &self.law {
            let samples = simulation.samples(k).map_err(refused)?;
            let samples = samples.into_iter().take(sums.runs as usize).collect();
            let expected = verdict::expected(layout, &[k]).map_err(unknown)?;
            for expected in expected {
                let law = verdict::Law::new(expected.photon);
                let tested = kolmogorov::kolmogorov(&law, Vec::clone(&samples)).map_err(unknown)?;
                found.push((k, tested));
            }
        }
        Ok(found)
    }

    fn scene(&self, running: &Running) -> Result<Scene, Failure> {
        let (layout, all) = self.layout()?;
        let photons = self.photons.unwrap_or(all);
        let only = match self.k.is_empty() {
            true => None,
            false => Some(self.k.iter().chain(&self.law).copied().collect()),
        };
        Ok(Scene {
            dimension: self.dim,
            mode: match self.mode {
                Draw::Cheapest => Mode::Cheapest,
                Draw::Sorted => Mode::Sorted,
                Draw::Spacings => Mode::Spacings,
                Draw::Beta => Mode::Beta,
            },
            only,
            fault: self.fault.map(|fault| match fault {
                Planted::Estimator => Fault::Estimator,
                Planted::Shell => Fault::ShellCount,
                Planted::Dropped => Fault::Dropped,
                Planted::Unsorted => Fault::Unsorted,
                Planted::Descending => Fault::Descending,
                Planted::Biased => Fault::Biased,
            }),
            ..Scene::new(layout, photons, running.runs, running.seed)
        })
    }

    /// The layout, and its last photon if none is named.
    fn layout(&self) -> Result<(Layout, u64), Failure> {
        // 400 shells of strategy 2, as in the thesis.
        const PHOTONS: u64 = 80_200;
        let last = self.k.iter().chain(&self.law).copied().max();
        let photons = self.photons.or(last).unwrap_or(PHOTONS);
        Ok(match self.strategy.as_deref().unwrap_or("2") {
            "none" => {
                let n = self.photons.unwrap_or(PHOTONS.max(photons));
                (Layout::Unstratified(n.into()), n)
            }
            "1" => (Layout::One, photons),
            "2" => (Layout::Triangular, photons),
            "listing" => (Layout::Listing, photons),
            shells => {
                let counts = shells
                    .split(',')
                    .map(|count| count.trim().parse::<u64>().ok());
                let counts: Option<Vec<u64>> = counts.collect();
                let sum = |counts: &Vec<u64>| {
                    let mut sum = 0u64;
                    counts.iter().try_for_each(|count| {
                        sum = sum.checked_add(*count)?;
                        Some(())
                    })?;
                    Some(sum)
                };
                match counts.as_ref().and_then(sum).zip(counts) {
                    Some((sum, counts)) => (Layout::Sequence(counts), sum),
                    None => {
                        let message = format!("`{shells}` is no strategy");
                        let hint = "none, 1, 2, listing, or numbers of photons: 5,7,9";
                        return Err(Failure::input(&message, Some(hint)));
                    }
                }
            }
        })
    }
}

fn refused(error: SceneError) -> Failure {
    let hint = match error {
        SceneError::Shell { .. } => Some("ask for few photons with --k, drawn with --mode beta"),
        SceneError::NotSorted => Some("leave out --mode"),
        SceneError::NoPhoton(_) => Some("photons go from 1 (of the listing from 2) to --photons"),
        _ => None,
    };
    Failure::input(&error.to_string(), hint)
}

fn unknown(error: verdict::Error) -> Failure {
    Failure::input(&error.to_string(), None)
}

fn unusable(error: CheckpointError) -> Failure {
    let hint = match error {
        CheckpointError::Other { .. } => Some("name a new file, or simulate what it simulates"),
        _ => None,
    };
    Failure::input(&error.to_string(), hint)
}
