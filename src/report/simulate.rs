//! What simulations came to, for people and for programs.

use super::chart::{Axis, Chart, Marks, Panel, Scale, Series};
use super::style::{FAINT, STRONG, WIDTH, paint, wrap};
use super::words::counted;
use crate::judge::{Trial, Trials};
use crate::model::Layout;
use crate::simulate::verdict::Report;
use crate::simulate::verdict::battery::{Finding, Verdict};
use crate::simulate::verdict::kolmogorov::Kolmogorov;
use crate::simulate::verdict::sequential::Watch;
use crate::simulate::{Scene, Sums};
use serde_json::json;
use std::fmt::Write;

/// A claim's statement with its simulations.
#[derive(Clone, Debug)]
pub struct Statement {
    /// `printed` or `mended`
    pub label: &'static str,
    pub written: String,
    pub trials: Trials,
}

impl Statement {
    /// Whether a z that counts lies farther than this on the wrong side.
    pub fn contradicts(&self, least: f64) -> bool {
        self.trials
            .done
            .iter()
            .any(|trial| contradicts(trial, least))
    }
}

fn contradicts(trial: &Trial, least: f64) -> bool {
    trial.simulated.z.counts && trial.excess > least
}

/// The simulations of a claim's statements. `least` is the distance in standard errors that contradicts.
pub fn statements(id: &str, statements: &[Statement], runs: u64, least: f64) -> String {
    let mut text =
        format!("{id}, {runs} runs at each point; beyond {least:.1} standard errors contradicts\n");
    for statement in statements {
        let _ = writeln!(text);
        for line in wrap(
            &format!("{}: {}", statement.label, statement.written),
            WIDTH,
        ) {
            let _ = writeln!(text, "{}", paint(STRONG, &line));
        }
        for trial in &statement.trials.done {
            text.push_str(&trial_lines(trial, least));
        }
        if statement.trials.done.is_empty() {
            let reason = statement.trials.reason.as_ref();
            let reason = reason.map_or("no relation to simulate".to_owned(), ToString::to_string);
            let _ = writeln!(text, "  not simulated: {reason}");
        }
    }
    text
}

fn trial_lines(trial: &Trial, least: f64) -> String {
    let place: Vec<String> = trial
        .named()
        .iter()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    let found = &trial.simulated;
    let said = match (found.z.counts, contradicts(trial, least)) {
        (false, _) => "does not count: too few runs, or too rare large values",
        (true, true) => "contradicts",
        (true, false) => "agrees",
    };
    format!(
        "  relation {} at {}\n    left {:.6}, right {:.6}: z = {:.2}, {}\n",
        trial.relation,
        place.join(", "),
        found.left,
        found.right,
        found.z.z,
        paint(
            if contradicts(trial, least) {
                STRONG
            } else {
                FAINT
            },
            said
        )
    )
}

/// The same for programs.
pub fn statements_json(id: &str, statements: &[Statement], runs: u64, least: f64) -> String {
    let trial = |trial: &Trial| {
        json!({
            "relation": trial.relation,
            "point": trial.named(),
            "left": trial.simulated.left,
            "right": trial.simulated.right,
            "z": trial.simulated.z.z,
            "standard_error": trial.simulated.z.standard_error,
            "counts": trial.simulated.z.counts,
            "contradicts": contradicts(trial, least),
        })
    };
    let statement = |statement: &Statement| {
        json!({
            "statement": statement.label,
            "written": statement.written,
            "trials": statement.trials.done.iter().map(trial).collect::<Vec<_>>(),
            "reason": statement.trials.reason.as_ref().map(ToString::to_string),
        })
    };
    let all: Vec<_> = statements.iter().map(statement).collect();
    let value = json!({ "id": id, "runs": runs, "contradicts_beyond": least, "statements": all });
    format!("{value:#}\n")
}

/// A scene that was drawn, and what follows from it.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub sums: Sums,
    /// Each test of the battery: of every photon the mean of d and the mean of d^2.
    pub findings: Vec<Finding>,
    pub report: Report,
    /// Whether U of some photons has its law.
    pub laws: Vec<(u64, Kolmogorov)>,
    /// The sequential test; it decides where there is one.
    pub watch: Option<Watch>,
    /// Photons drawn, and how long it took.
    pub drawn: f64,
    pub seconds: f64,
}

/// A photon's means beside theory.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    k: u64,
    mean: f64,
    expected_mean: f64,
    z: Option<f64>,
    variance: f64,
    expected_variance: f64,
    /// The thesis's fast variance, around the true value.
    fast: f64,
    expected_fast: f64,
    z_fast: Option<f64>,
}

impl Outcome {
    /// Whether theory and the simulation agree, at the level that was asked for.
    pub fn agrees(&self) -> bool {
        let means = match &self.watch {
            Some(watch) => !watch.contradicts(),
            None => self.report.verdict == Verdict::Agrees,
        };
        means && self.laws.iter().all(|(_, law)| self.law_agrees(law))
    }

    /// The laws share a level of their own, as large as that of the means.
    fn law_agrees(&self, law: &Kolmogorov) -> bool {
        law.p > self.report.level / self.laws.len() as f64
    }

    fn rows(&self) -> Vec<Row> {
        let pairs = self.findings.as_chunks::<2>().0.iter().enumerate();
        let theory = |finding: &Finding| finding.expected.unwrap_or(f64::INFINITY);
        let variance = |mean: f64, square: f64| match square.is_finite() {
            true => square - mean * mean,
            false => square,
        };
        let row = |(i, [mean, square]): (usize, &[Finding; 2])| Row {
            k: mean.k,
            mean: 1.0 + mean.mean,
            expected_mean: 1.0 + theory(mean),
            z: mean.z,
            variance: self.sums.variance(i),
            expected_variance: variance(theory(mean), theory(square)),
            fast: square.mean,
            expected_fast: theory(square),
            z_fast: square.z,
        };
        pairs.map(row).collect()
    }

    /// Some of the rows: all where they are few, else about so many, evenly by the logarithm of k.
    fn some_rows(&self, count: usize) -> Vec<Row> {
        let rows = self.rows();
        if rows.len() <= count {
            return rows;
        }
        let (first, last) = (rows[0].k as f64, rows[rows.len() - 1].k as f64);
        let place = |i: usize| first * (last / first).powf(i as f64 / (count - 1) as f64);
        let mut chosen: Vec<usize> = (0..count)
            .map(|i| rows.partition_point(|row| (row.k as f64) < place(i) * (1.0 - 1e-9)))
            .collect();
        chosen.dedup();
        chosen
            .into_iter()
            .filter_map(|i| rows.get(i).copied())
            .collect()
    }
}

/// What was drawn, in words.
pub(super) fn scene_words(scene: &Scene, runs: u64) -> String {
    let layout = match &scene.layout {
        Layout::Unstratified(_) => "no stratification".to_owned(),
        Layout::One => "strategy 1".to_owned(),
        Layout::Triangular => "strategy 2".to_owned(),
        Layout::Listing => "the listing's layout".to_owned(),
        Layout::Sequence(counts) => format!("{} shells", counts.len()),
    };
    let what = match scene.dimension {
        None => "U alone".to_owned(),
        Some(d) => format!("radii in {d}D"),
    };
    let fault = match scene.fault {
        None => String::new(),
        Some(fault) => format!(", WITH THE FAULT {fault:?} ON PURPOSE"),
    };
    format!(
        "{layout}, {} photons, {}, seed {}, {what}{fault}",
        scene.photons,
        counted(runs as usize, "run"),
        scene.seed
    )
}

/// Rows of the table for people.
const ROWS: usize = 16;

/// A report for people.
pub fn human(scene: &Scene, outcome: &Outcome) -> String {
    let Outcome {
        report,
        sums,
        drawn,
        seconds,
        ..
    } = outcome;
    let mut text = scene_words(scene, sums.runs);
    if *drawn > 0.0 {
        let _ = write!(
            text,
            "\n{drawn:.3e} photons drawn in {seconds:.2} s: {:.0} million a second",
            drawn / seconds / 1e6
        );
    }
    let says = match outcome.agrees() {
        true => "simulation and theory agree",
        false => "simulation and theory CONTRADICT each other",
    };
    let _ = writeln!(text, "\n\n{}", paint(STRONG, says));
    match &outcome.watch {
        Some(watch) => {
            let _ = writeln!(
                text,
                "  tested after every chunk of runs, stopped after {}",
                watch.runs()
            );
        }
        None => {
            let _ = writeln!(
                text,
                "  {} means of k/U and of (k/U - 1)^2 tested, {} against theory; a false alarm has a chance of at most {:e}",
                report.tests, report.contradictions, report.level
            );
        }
    }
    if let Some(worst) = &report.worst {
        let _ = writeln!(
            text,
            "  farthest: k = {}, z = {}",
            worst.k,
            z_words(worst.z)
        );
    }
    if !report.named.is_empty() {
        let named: Vec<String> = report.named.iter().map(u64::to_string).collect();
        let _ = writeln!(text, "  against theory: k = {}", named.join(", "));
    }
    let chi = &report.chi_square;
    let _ = writeln!(
        text,
        "  one photon a shell: chi-square {:.1} of {} shells, score {:.2} (an approximation, for the eye)",
        chi.value, chi.shells, chi.score
    );
    if report.weak_from_above > 0 {
        let photons = counted(report.weak_from_above as usize, "photon");
        let _ = writeln!(
            text,
            "  {photons} without any volume inside: hardly tested for too large means"
        );
    }
    for (k, law) in &outcome.laws {
        let says = match outcome.law_agrees(law) {
            true => "agrees",
            false => "CONTRADICTS",
        };
        let _ = writeln!(
            text,
            "  law of U at k = {k}: {says}, distance {:.4} of {} samples, p at most {:.2e}",
            law.distance, law.samples, law.p
        );
    }
    table(&mut text, &outcome.some_rows(ROWS));
    text
}

fn z_words(z: Option<f64>) -> String {
    z.map_or("-".to_owned(), |z| format!("{z:.2}"))
}

fn table(text: &mut String, rows: &[Row]) {
    let head = format!(
        "\n{:>9}  {:>11} {:>11} {:>6}  {:>11} {:>11}  {:>11} {:>11} {:>6}",
        "k", "mean k/U", "theory", "z", "variance", "theory", "around 1", "theory", "z"
    );
    let _ = writeln!(text, "{}", paint(FAINT, &head));
    for row in rows {
        let _ = writeln!(
            text,
            "{:>9}  {:>11.8} {:>11.8} {:>6}  {:>11.4e} {:>11.4e}  {:>11.4e} {:>11.4e} {:>6}",
            row.k,
            row.mean,
            row.expected_mean,
            z_words(row.z),
            row.variance,
            row.expected_variance,
            row.fast,
            row.expected_fast,
            z_words(row.z_fast)
        );
    }
}

/// The same for programs, without the rows of the photons.
pub fn json(scene: &Scene, outcome: &Outcome) -> String {
    let value = json!({
        "scene": scene_words(scene, outcome.sums.runs),
        "runs": outcome.sums.runs,
        "seed": scene.seed,
        "agrees": outcome.agrees(),
        "battery": outcome.report,
        "laws": outcome.laws.iter().map(|(k, law)| json!({ "k": k, "test": law })).collect::<Vec<_>>(),
        "stopped_after": outcome.watch.as_ref().map(Watch::runs),
    });
    format!("{value:#}\n")
}

/// One line a photon: estimates, theory, and z-values; empty where the variance in theory is infinite.
pub fn csv(outcome: &Outcome) -> String {
    let mut text = "k,mean,mean in theory,z,variance,variance in theory,mean of (k/U-1)^2,the same in theory,z\n".to_owned();
    let z = |z: Option<f64>| z.map_or(String::new(), |z| format!("{z}"));
    for row in outcome.rows() {
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{},{},{}",
            row.k,
            row.mean,
            row.expected_mean,
            z(row.z),
            row.variance,
            row.expected_variance,
            row.fast,
            row.expected_fast,
            z(row.z_fast)
        );
    }
    text
}

/// Photons of a picture at most.
const DRAWN: usize = 600;

/// The picture: means, variances and z-values over k.
pub fn picture(scene: &Scene, outcome: &Outcome) -> String {
    let rows = outcome.some_rows(DRAWN);
    let points = |of: &dyn Fn(&Row) -> f64| -> Vec<[f64; 2]> {
        rows.iter().map(|row| [row.k as f64, of(row)]).collect()
    };
    let far = rows.last().zip(rows.first());
    let x = match far.is_some_and(|(last, first)| last.k > 60 * first.k) {
        true => Scale::Log,
        false => Scale::Linear,
    };
    let panel = |label: &str, scale, series| Panel {
        x: Axis {
            label: "photon k".to_owned(),
            scale: x,
        },
        y: Axis {
            label: label.to_owned(),
            scale,
        },
        series,
    };
    let series = |name: &str, marks, look| Series {
        name: name.to_owned(),
        marks,
        look,
    };
    let simulated =
        |of: &dyn Fn(&Row) -> f64, look| series("simulated", Marks::Dots(points(of)), look);
    let theory = |of: &dyn Fn(&Row) -> f64| series("theory", Marks::Line(points(of)), 0);
    let z = |z: Option<f64>| z.unwrap_or(f64::NAN);
    let chart = Chart {
        title: scene_words(scene, outcome.sums.runs),
        notes: vec![],
        panels: vec![
            panel(
                "mean of k/U",
                Scale::Linear,
                vec![
                    simulated(&|row| row.mean, 1),
                    theory(&|row| row.expected_mean),
                ],
            ),
            panel(
                "variance of k/U",
                Scale::Log,
                vec![
                    simulated(&|row| row.variance, 1),
                    theory(&|row| row.expected_variance),
                ],
            ),
            panel(
                "standard errors from theory",
                Scale::Linear,
                vec![
                    series("z of the mean", Marks::Dots(points(&|row| z(row.z))), 1),
                    series(
                        "z of the mean square around 1",
                        Marks::Dots(points(&|row| z(row.z_fast))),
                        2,
                    ),
                ],
            ),
        ],
    };
    chart.to_svg()
}
