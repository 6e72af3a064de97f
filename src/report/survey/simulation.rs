//! Simulation as a method: digits against photons drawn.

use super::super::chart::{Axis, Chart, Marks, Panel, Scale, Series};
use super::super::figures::Pace;
use super::{Error, Sheet, SheetError, Survey, median, raised};
use crate::model::Layout;
use crate::simulate::{Scene, Simulation};
use crate::special::shell::{Quantity, ShellError, enclose_all};
use std::fmt::Write;
use std::ops::ControlFlow;

/// Photons of strategy 2, each in the middle of its shell: of 3, 100, 1414 and 1,414,213 photons.
const PHOTONS: [u64; 4] = [5, 5000, 999_698, 999_999_204_684];

/// Runs are raised so many times by the root of ten, from a hundred on.
const STEPS: usize = 10;
const QUICK_STEPS: usize = 6;

/// Each number of runs is drawn with so many seeds.
const SEEDS: u64 = 21;

pub(super) struct Runs {
    pub(super) pace: Pace,
}

impl Runs {
    fn steps(&self) -> usize {
        match self.pace {
            Pace::Full => STEPS + 1,
            Pace::Quick => QUICK_STEPS + 1,
        }
    }

    /// The photon and the runs of a unit.
    fn scene(&self, unit: usize) -> (u64, u64) {
        let k = PHOTONS[unit / self.steps() % PHOTONS.len()];
        (k, runs(unit % self.steps()))
    }
}

fn runs(step: usize) -> u64 {
    10f64.powf(2.0 + step as f64 / 2.0).round() as u64
}

/// E - 1 and Var as doubles, off by less than a last bit.
fn theory(k: u64) -> Result<[f64; 2], ShellError> {
    let shell = Layout::Triangular
        .shell(&k.into())
        .ok_or(ShellError::NoShell)?;
    let values = enclose_all([Quantity::Excess, Quantity::Variance], &shell, 20)?;
    Ok(values.map(|value| value.midpoint().to_f64()))
}

/// -log10 of the relative error, 0 where it is larger than 1, to two places.
fn digits(value: f64, truth: f64) -> f64 {
    let error = ((value - truth) / truth).abs();
    ((-error.log10()).clamp(0.0, 15.0) * 100.0).round() / 100.0
}

const COLUMNS: [&str; 6] = [
    "k",
    "runs",
    "photons drawn",
    "E-1: digits right",
    "E-1: digits by theory",
    "Var: digits right",
];

impl Survey for Runs {
    fn name(&self) -> String {
        "stability-simulation".to_owned()
    }

    fn title(&self) -> String {
        "Simulation as a method: digits against photons drawn".to_owned()
    }

    fn notes(&self, _: &Sheet) -> Result<Vec<String>, SheetError> {
        Ok(vec![format!(
            "Strategy 2, photons in the middle of their shells. Of a large shell only the place of this photon is drawn, a number a run; of photon 5 all three of its shell. \
             Each mark is the median of {SEEDS} repetitions; at 0 not one digit is right. Broad grey lines, left: the median error by theory."
        )])
    }

    fn columns(&self) -> Vec<String> {
        COLUMNS.map(str::to_owned).to_vec()
    }

    fn units(&self) -> usize {
        PHOTONS.len() * self.steps()
    }

    fn places(&self, unit: usize) -> Vec<Vec<String>> {
        let (k, runs) = self.scene(unit);
        vec![vec![k.to_string(), runs.to_string()]]
    }

    fn side_by_side(&self) -> bool {
        true
    }

    fn measure(&self, unit: usize) -> Result<Vec<Vec<String>>, Error> {
        let (k, runs) = self.scene(unit);
        let [excess, variance] = theory(k)?;
        let (mut of_excess, mut of_variance, mut drawn) = (vec![], vec![], 0);
        for seed in 1..=SEEDS {
            let simulation = Simulation::new(Scene {
                only: Some(vec![k]),
                ..Scene::new(Layout::Triangular, k, runs, seed)
            })?;
            drawn = simulation.drawn_a_run() * runs;
            let sums = simulation.run(None, |_| ControlFlow::Continue(()))?;
            of_excess.push(digits(sums.excess(0), excess));
            of_variance.push(digits(sums.variance(0), variance));
        }
        // The median of |x| for a standard normal x.
        let error = 0.6745 * (variance / runs as f64).sqrt();
        let typical = |digits| median(digits).map_or(String::new(), |digits| digits.to_string());
        Ok(vec![vec![
            drawn.to_string(),
            typical(of_excess),
            digits(excess + error, excess).to_string(),
            typical(of_variance),
        ]])
    }

    fn pictures(&self, sheet: &Sheet) -> Result<Vec<(&'static str, Chart)>, SheetError> {
        let axis = |label: &str, scale| Axis {
            label: label.to_owned(),
            scale,
        };
        let panel = |title: &str, right: &str, theory: Option<&str>| {
            let mut series = vec![];
            for (look, k) in PHOTONS.into_iter().enumerate() {
                if let Some(theory) = theory {
                    series.push(Series {
                        name: "theory".to_owned(),
                        marks: Marks::Front(points(sheet, k, theory)?),
                        look: 0,
                    });
                }
                series.push(Series {
                    name: format!("photon {}", about(k)),
                    marks: Marks::Chain(points(sheet, k, right)?),
                    look,
                });
            }
            Ok(Panel {
                title: title.to_owned(),
                x: axis("photons drawn", Scale::Log),
                y: axis("digits right", Scale::Linear),
                series,
            })
        };
        let panels = vec![
            panel("E \u{2212} 1", COLUMNS[3], Some(COLUMNS[4]))?,
            panel("Var", COLUMNS[5], None)?,
        ];
        Ok(vec![(
            "",
            Chart {
                columns: 2,
                panels,
                ..Chart::default()
            },
        )])
    }

    fn words(&self, sheet: &Sheet) -> Result<String, SheetError> {
        let mut text = "A digit more costs a hundred times the photons. Only the photon itself is drawn here; who draws all up to it, as a simulation of the scene does, draws \
             k times as many. The variance has about the same digits for every photon; those of E - 1 get fewer as k grows, \
             since in the middle of a shell the bias falls faster than the spread.\n\n\
             | photon | photons drawn at most | digits of E - 1 | by theory | digits of Var |\n|---|---|---|---|---|\n"
            .to_owned();
        for k in PHOTONS {
            let last = |column: &str| Ok(points(sheet, k, column)?.last().copied());
            let of = |column: &str| {
                let value = last(column)?.map_or(String::new(), |[_, y]| y.to_string());
                Ok::<String, SheetError>(value)
            };
            let drawn = last(COLUMNS[3])?.map_or(f64::NAN, |[x, _]| x);
            let _ = writeln!(
                text,
                "| {k} | {drawn:.1e} | {} | {} | {} |",
                of(COLUMNS[3])?,
                of(COLUMNS[4])?,
                of(COLUMNS[5])?
            );
        }
        Ok(text)
    }
}

/// Large numbers as the power of ten that they are near.
fn about(k: u64) -> String {
    match k {
        0..10_000 => k.to_string(),
        k => format!("\u{2248} 10{}", raised((k as f64).log10().round() as u32)),
    }
}

/// A column of one photon over the photons drawn.
fn points(sheet: &Sheet, k: u64, column: &str) -> Result<Vec<[f64; 2]>, SheetError> {
    let photons = sheet.column("k", |cell| cell.parse::<u64>().ok())?;
    let drawn = sheet.numbers(COLUMNS[2])?;
    let values = sheet.numbers(column)?;
    let rows = photons.into_iter().zip(drawn).zip(values);
    let own = rows.filter(|((photon, _), _)| *photon == k);
    Ok(own.map(|((_, x), y)| [x, y]).collect())
}
