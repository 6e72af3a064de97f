//! What simulations came to, for people and for programs.

use super::chart::{Axis, Chart, Marks, Panel, Scale, Series};
use super::style::{FAINT, STRONG, WIDTH, paint, wrap};
use super::words::counted;
use crate::judge::{Trial, Trials};
use crate::model::Layout;
use crate::simulate::verdict::Report;
use crate::simulate::verdict::battery::{Finding, Verdict, critical};
use crate::simulate::verdict::kolmogorov::Kolmogorov;
use crate::simulate::verdict::sequential::{Interval, Watch};
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
        for (relation, reason) in &statement.trials.left_out {
            let _ = writeln!(text, "  relation {relation} is not simulated: {reason}");
        }
        if statement.trials.done.is_empty() && statement.trials.left_out.is_empty() {
            let _ = writeln!(text, "  there is no relation to simulate");
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
        (false, _) => "does not count: rare large values decide, or the sides hardly scatter apart",
        (true, true) => "contradicts",
        (true, false) => "agrees",
    };
    format!(
        "  relation {} at {}\n    left {}, right {}: z = {}, {}\n",
        trial.relation,
        place.join(", "),
        short(found.left),
        short(found.right),
        z_words(Some(found.z.z)),
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
            "left_out": statement.trials.left_out,
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
    /// To what the means were to be known.
    pub width: Option<f64>,
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

    /// The laws of some photons share a level as large as that of all means.
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
        Layout::Sequence(counts) if counts.len() <= 8 => {
            let counts: Vec<String> = counts.iter().map(u64::to_string).collect();
            format!("shells of {}", counts.join(", "))
        }
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

/// What the test of all means at once says.
fn tested(text: &mut String, report: &Report) {
    let _ = writeln!(
        text,
        "  {} means of k/U and of (k/U - 1)^2 tested, {} against theory; a false alarm has a chance of at most {:e}",
        report.tests, report.contradictions, report.level
    );
    if let Some((worst, z)) = report.worst.and_then(|worst| Some((worst, worst.z?))) {
        let _ = writeln!(
            text,
            "  farthest: k = {}, z = {}",
            worst.k,
            z_words(Some(z))
        );
    }
    if !report.named.is_empty() {
        let named: Vec<String> = report.named.iter().map(u64::to_string).collect();
        let _ = writeln!(text, "  against theory: k = {}", named.join(", "));
    }
}

/// What the sequential test says, whenever it was stopped.
fn watched(text: &mut String, watch: &Watch, outcome: &Outcome) {
    let width = outcome.width.unwrap_or(f64::INFINITY);
    let reached = match watch.is_precise(width) {
        true => "known to",
        false => "not yet known to",
    };
    let _ = writeln!(
        text,
        "  tested after every chunk of runs, stopped after {}; the means are {reached} {width:e}:",
        watch.runs()
    );
    for (k, interval) in outcome.sums.photons.iter().zip(watch.intervals()) {
        let known = interval.map_or("nothing".to_owned(), |interval| {
            let Interval { low, high } = interval;
            format!(
                "E - 1 between {} and {}, half a width of {:.1e}",
                short(low),
                short(high),
                interval.half_width()
            )
        });
        let _ = writeln!(text, "    k = {k}: {known}");
    }
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
    if *drawn > 0.0 && *seconds > 0.01 {
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
        Some(watch) => watched(&mut text, watch, outcome),
        None => tested(&mut text, report),
    }
    let chi = &report.chi_square;
    let _ = writeln!(
        text,
        "  one photon a shell: chi-square {:.1} of {}, score {:.2} (an approximation, for the eye)",
        chi.value,
        counted(chi.shells as usize, "shell"),
        chi.score
    );
    if report.weak_from_above > 0 {
        let photons = counted(report.weak_from_above as usize, "photon");
        let _ = writeln!(
            text,
            "  {photons} without volume inside (Va = 0): means that are too large are hardly noticed there"
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
    match z {
        None => "-".to_owned(),
        Some(z) if z.abs() < 1e4 => format!("{z:.2}"),
        Some(z) => format!("{z:.0e}"),
    }
}

/// Seven digits, with a power of ten where that is shorter.
fn short(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e7).contains(&size) => format!("{x:.6}"),
        _ => format!("{x:.6e}"),
    }
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
    let mut text = "k,mean,mean in theory,z of the mean,variance,variance in theory,mean of (k/U-1)^2,the same in theory,z of that\n".to_owned();
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
        title: String::new(),
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
    let simulated = |of: &dyn Fn(&Row) -> f64| series("simulated", Marks::Dots(points(of)), 1);
    let theory = |of: &dyn Fn(&Row) -> f64| series("theory", Marks::Line(points(of)), 0);
    // Where theory has no finite value a sample has one that means nothing.
    let known = |value: f64, theory: f64| if theory.is_finite() { value } else { f64::NAN };
    let least = critical(outcome.report.level / outcome.report.tests.max(1) as f64);
    let line = |height: f64| Marks::Line(points(&|_| height));
    let z = |z: Option<f64>| z.unwrap_or(f64::NAN);
    let chart = Chart {
        title: scene_words(scene, outcome.sums.runs),
        panels: vec![
            panel(
                "mean of k/U, less 1",
                Scale::Log,
                vec![
                    simulated(&|row| known(row.mean - 1.0, row.expected_mean)),
                    theory(&|row| row.expected_mean - 1.0),
                ],
            ),
            panel(
                "variance of k/U",
                Scale::Log,
                vec![
                    simulated(&|row| known(row.variance, row.expected_variance)),
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
                    series("", line(0.0), 0),
                    series("contradicts, about", line(least), 5),
                    series("", line(-least), 5),
                ],
            ),
        ],
        ..Chart::default()
    };
    chart.to_svg()
}
