//! The figures of the thesis, made again: the data of each as CSV, its picture as SVG.
//!
//! A [`Figure`] is plain data ([`figures`]): panels, and in each the photons, curves over them (an expression over the model
//! on a layout, valued by [`crate::probe`]) and series that are simulated. Only the photons that are drawn are simulated. A
//! figure is the same bytes for any number of threads.
//!
//! ```
//! use claimcheck::report::figures::{Pace, figures};
//! let bounds = figures().into_iter().find(|figure| figure.number.to_string() == "2.20").expect("one of them");
//! let made = bounds.make(Pace::Quick)?;
//! // Photon 4 of strategy 2: its mean lies between 1 + 1/16 and 1 + 1/4.
//! let row = made.csv.lines().find(|line| line.starts_with("4,")).expect("a row each photon");
//! assert_eq!(row.split(',').nth(2), Some("1.25"));
//! assert!(made.svg.starts_with("<svg ") && made.svg.contains(&bounds.command(Pace::Quick)));
//! # Ok::<(), claimcheck::report::figures::Error>(())
//! ```

mod table;

pub use table::figures;

use super::chart::{self, Axis, Chart, Marks, Scale};
use super::simulate::scene_words;
use crate::model::Layout;
use crate::probe::{self, Probe, Question};
use crate::simulate::{CheckpointError, Scene, SceneError, Simulation, Sums};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Display, Formatter, Write};
use std::ops::ControlFlow;

/// The runs of a scene at most, where it is to be quick.
const QUICK_RUNS: u64 = 200;

/// Where photons are thinned out, all are drawn up to this one.
const NEAR: u64 = 50;

/// And then so many in a decade.
const A_DECADE: u32 = 16;

/// A chapter and a number in it: 2.9.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Number(u8, u8);

impl Display for Number {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.0, self.1)
    }
}

/// How much is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// As many runs as in the thesis.
    Full,
    /// At most 200 runs of a scene.
    Quick,
}

impl Pace {
    /// Of an option `--quick`.
    pub fn of(quick: bool) -> Pace {
        match quick {
            true => Pace::Quick,
            false => Pace::Full,
        }
    }

    fn scene(self, scene: &Scene) -> Scene {
        let most = match self {
            Pace::Full => u64::MAX,
            Pace::Quick => QUICK_RUNS,
        };
        Scene {
            runs: scene.runs.min(most),
            ..scene.clone()
        }
    }
}

/// A figure of the thesis: what is drawn in it.
#[derive(Clone, Debug)]
pub struct Figure {
    pub number: Number,
    /// The thesis's caption.
    pub title: &'static str,
    /// What a reader must know.
    notes: Vec<&'static str>,
    panels: Vec<Panel>,
}

#[derive(Clone, Debug)]
struct Panel {
    photons: Photons,
    /// Of the axis of k.
    along: Scale,
    label: &'static str,
    scale: Scale,
    series: Vec<Series>,
}

/// The photons of a panel: the first and the last.
#[derive(Clone, Copy, Debug)]
enum Photons {
    All(u64, u64),
    /// All near ones; beyond them some, evenly by the logarithm of k, each in the middle of its shell, so that
    /// neighbours are alike.
    Thinned(u64, u64),
}

#[derive(Clone, Debug)]
struct Series {
    name: &'static str,
    of: Of,
}

#[derive(Clone, Debug)]
enum Of {
    /// An expression over the model on a layout, as a line.
    Line(Layout, &'static str),
    /// The same as marks.
    Dots(Layout, &'static str),
    /// What the runs of a scene come to.
    Simulated(What, Scene),
}

/// What is told of the runs of a scene.
#[derive(Clone, Copy, Debug)]
enum What {
    /// The mean of k/U.
    Mean,
    /// The mean of k/U - 1.
    Excess,
    /// The variance of k/U around the mean of the runs.
    Variance,
    /// The mean square of k/U - 1: the thesis's fast variance.
    AroundOne,
    /// How far the mean lies from `E_k`, in units of `sqrt(Var_k/runs)`.
    Score,
}

/// A figure that was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Made {
    pub svg: String,
    /// Lines that begin with `#` tell where it comes from; then a heading and one line a photon, k first. A cell is
    /// empty where there is no finite value, or none was asked for.
    pub csv: String,
}

/// Why a figure cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// An expression or its layout.
    #[error(transparent)]
    Probe(#[from] probe::Error),
    /// A scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The runs of a scene.
    #[error(transparent)]
    Run(#[from] CheckpointError),
}

/// k with a value; NaN where there is none.
type Points = Vec<[f64; 2]>;

impl Figure {
    /// The command that makes the figure, with the program's version. It stands in both files.
    pub fn command(&self, pace: Pace) -> String {
        let quick = match pace {
            Pace::Full => "",
            Pace::Quick => " --quick",
        };
        format!(
            "claimcheck {}: claimcheck chart figures --only {}{quick} --out .",
            env!("CARGO_PKG_VERSION"),
            self.number
        )
    }

    /// Computes and simulates what is drawn, in rayon's pool of threads.
    ///
    /// # Errors
    /// [`Error`]: what the figure asks for does not exist.
    pub fn make(&self, pace: Pace) -> Result<Made, Error> {
        let panels = self.panels.iter().map(|panel| panel.make(pace));
        let panels = panels.collect::<Result<Vec<_>, _>>()?;
        let chart = Chart {
            title: self.heading(),
            notes: self.all_notes(pace),
            panels,
            ..Chart::default()
        };
        Ok(Made {
            svg: chart.to_svg(),
            csv: csv(&chart),
        })
    }

    fn heading(&self) -> String {
        format!("Figure {}: {}", self.number, self.title)
    }

    fn all_notes(&self, pace: Pace) -> Vec<String> {
        let mut notes: Vec<String> = self.notes.iter().map(ToString::to_string).collect();
        let mut scenes = vec![];
        for series in self.panels.iter().flat_map(|panel| &panel.series) {
            if let Of::Simulated(_, scene) = &series.of {
                let scene = pace.scene(scene);
                let words = scene_words(&scene, scene.runs);
                if !scenes.contains(&words) {
                    scenes.push(words);
                }
            }
        }
        if !scenes.is_empty() {
            notes.push(format!("Simulated: {}.", scenes.join("; ")));
        }
        notes.push(self.command(pace));
        notes.push(super::machine::words());
        notes
    }
}

impl Panel {
    fn make(&self, pace: Pace) -> Result<chart::Panel, Error> {
        let axis = |label: &str, scale| Axis {
            label: label.to_owned(),
            scale,
        };
        let series = self.series.iter().enumerate();
        let series = series.map(|(look, series)| series.make(look, self.photons, pace));
        Ok(chart::Panel {
            title: String::new(),
            x: axis("photon k", self.along),
            y: axis(self.label, self.scale),
            series: series.collect::<Result<_, _>>()?,
        })
    }
}

impl Photons {
    fn of(self, layout: &Layout) -> Vec<u64> {
        let (first, last) = match self {
            Photons::All(first, last) => return (first..=last).collect(),
            Photons::Thinned(first, last) => (first, last),
        };
        let step = 10f64.powf(1.0 / f64::from(A_DECADE));
        let far = (1..).map(|i| (NEAR as f64 * step.powi(i)).round() as u64);
        let far = far.take_while(|k| *k <= last);
        let far = far.filter_map(|k| middle(layout, k)).filter(|k| *k <= last);
        (first..=last.min(NEAR))
            .chain(far)
            .collect::<BTreeSet<u64>>()
            .into_iter()
            .collect()
    }
}

/// The photon in the middle of the shell of photon k.
fn middle(layout: &Layout, k: u64) -> Option<u64> {
    let shell = layout.shell(&k.into())?;
    let (position, count) = (shell.position.to_u64()?, shell.count.to_u64()?);
    Some(k - position + count.div_ceil(2))
}

impl Series {
    fn make(&self, look: usize, photons: Photons, pace: Pace) -> Result<chart::Series, Error> {
        let mut name = self.name.to_owned();
        let marks = match &self.of {
            Of::Line(layout, expression) => {
                Marks::Line(values(layout, expression, &photons.of(layout))?)
            }
            Of::Dots(layout, expression) => {
                Marks::Dots(values(layout, expression, &photons.of(layout))?)
            }
            Of::Simulated(what, scene) => {
                let scene = pace.scene(scene);
                if scene.runs > 1 {
                    let _ = write!(name, ", {} runs", scene.runs);
                }
                Marks::Dots(simulated(*what, scene, photons)?)
            }
        };
        Ok(chart::Series { name, marks, look })
    }
}

/// An expression over the model at some photons.
fn values(layout: &Layout, expression: &str, photons: &[u64]) -> Result<Points, Error> {
    let (Some(first), Some(last)) = (photons.first(), photons.last()) else {
        return Ok(vec![]);
    };
    let probe = Probe::new(Question {
        layout: name_of(layout),
        first: *first,
        last: *last,
        quantity: Some(expression.to_owned()),
        ..Question::default()
    })?;
    let value = |&k: &u64| {
        let value = probe.value(None, k);
        let value = value.map_or(f64::NAN, |value| value.midpoint().to_f64());
        [k as f64, value]
    };
    Ok(photons.par_iter().map(value).collect())
}

/// The layout as a probe has it.
fn name_of(layout: &Layout) -> String {
    match layout {
        Layout::One => "one".to_owned(),
        Layout::Triangular => "triangular".to_owned(),
        Layout::Listing => "listing".to_owned(),
        // No probe has it, and says so.
        Layout::Unstratified(n) => format!("{n} photons in one shell"),
        Layout::Sequence(counts) => {
            let counts: Vec<String> = counts.iter().map(u64::to_string).collect();
            counts.join(",")
        }
    }
}

fn simulated(what: What, scene: Scene, photons: Photons) -> Result<Points, Error> {
    let mut asked = photons.of(&scene.layout);
    asked.retain(|k| *k <= scene.photons);
    let layout = scene.layout.clone();
    let simulation = Simulation::new(Scene {
        only: Some(asked),
        ..scene
    })?;
    let sums = simulation.run(None, |_| ControlFlow::Continue(()))?;
    let points = |of: fn(&Sums, usize) -> f64| {
        let photons = sums.photons.iter().enumerate();
        photons.map(|(i, k)| [*k as f64, of(&sums, i)]).collect()
    };
    Ok(match what {
        What::Mean => points(Sums::mean),
        What::Excess => points(Sums::excess),
        What::Variance => points(Sums::variance),
        What::AroundOne => points(Sums::about_one),
        What::Score => scores(&layout, &sums)?,
    })
}

fn scores(layout: &Layout, sums: &Sums) -> Result<Points, Error> {
    let excess = values(layout, "E_k - 1", &sums.photons)?;
    let variance = values(layout, "Var_k", &sums.photons)?;
    let score = |(i, ([k, excess], [_, variance])): (usize, ([f64; 2], [f64; 2]))| {
        let error = (variance / sums.runs as f64).sqrt();
        [k, (sums.excess(i) - excess) / error]
    };
    Ok(excess
        .into_iter()
        .zip(variance)
        .enumerate()
        .map(score)
        .collect())
}

/// The data of a picture. Series of one name over one axis share a column.
fn csv(chart: &Chart) -> String {
    let mut columns: Vec<(String, BTreeMap<u64, f64>)> = vec![];
    for panel in &chart.panels {
        for series in &panel.series {
            let (Marks::Line(points) | Marks::Dots(points)) = &series.marks else {
                continue;
            };
            let heading = format!("{}: {}", panel.y.label, series.name);
            let cells = points.iter().map(|[k, value]| (*k as u64, *value));
            match columns.iter_mut().find(|(other, _)| *other == heading) {
                Some((_, column)) => column.extend(cells),
                None => columns.push((heading, cells.collect())),
            }
        }
    }
    let notes = std::iter::once(&chart.title).chain(&chart.notes);
    let mut text: String = notes.map(|note| format!("# {note}\n")).collect();
    text.push('k');
    for (heading, _) in &columns {
        let _ = write!(text, ",\"{heading}\"");
    }
    let photons: BTreeSet<u64> = columns
        .iter()
        .flat_map(|(_, column)| column.keys().copied())
        .collect();
    for k in photons {
        let _ = write!(text, "\n{k}");
        for (_, column) in &columns {
            match column.get(&k).filter(|value| value.is_finite()) {
                Some(value) => {
                    let _ = write!(text, ",{value}");
                }
                None => text.push(','),
            }
        }
    }
    text.push('\n');
    text
}

#[cfg(test)]
mod tests;
