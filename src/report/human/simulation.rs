//! What simulations say beside the verdicts of a run.

use super::super::style::{STRONG, paint};
use super::super::words::counted;
use crate::corpus::Run;
use crate::judge::{Answer, Simulation};

/// A line for each statement that was simulated, and a summary; nothing where none was.
pub fn render(run: &Run) -> String {
    let answers = |report| -> [(&'static str, Option<&Answer>); 2] {
        let report: &crate::judge::Report = report;
        [
            ("printed", Some(&report.printed)),
            ("mended", report.mended.as_ref()),
        ]
    };
    let mut lines = vec![];
    let (mut points, mut largest) = (0, 0.0f64);
    for report in &run.reports {
        for (label, answer) in answers(report) {
            let Some(simulation) = answer.and_then(|answer| answer.simulation.as_ref()) else {
                continue;
            };
            points += simulation.points;
            largest = largest.max(simulation.excess);
            lines.push(format!(
                "  {:<28} {label:<8} {}\n",
                report.id,
                words(simulation)
            ));
        }
    }
    let Some(runs) = run.reports.iter().find_map(|report| {
        let found = answers(report).map(|(_, answer)| answer?.simulation.as_ref());
        found
            .into_iter()
            .flatten()
            .next()
            .map(|simulation| simulation.runs)
    }) else {
        return String::new();
    };
    let statements = counted(lines.len(), "statement");
    format!(
        "{}\n{}{statements} simulated at {}, {runs} runs each; at most {largest:.1} standard errors against a verdict\n\n",
        paint(STRONG, "simulations"),
        lines.concat(),
        counted(points, "point"),
    )
}

/// `z = 1.32 at k = 5, n = 7 (3 points)`
pub(super) fn words(simulation: &Simulation) -> String {
    let place: Vec<String> = simulation
        .point
        .iter()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    let relation = simulation
        .relation
        .map_or(String::new(), |number| format!(", relation {number}"));
    let at = if place.is_empty() { "" } else { " at " };
    format!(
        "z = {:.2}{at}{}{relation} (the farthest of {})",
        simulation.z,
        place.join(", "),
        counted(simulation.points, "point"),
    )
}
