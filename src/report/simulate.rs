//! What simulations came to, for people and for programs.

use super::style::{FAINT, STRONG, WIDTH, paint, wrap};
use crate::judge::{Trial, Trials};
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
