//! Evidence in words: what shows a verdict, where a statement fails.

use crate::judge::{Answer, Extent, Verdict, WitnessReport};

/// A verdict with what shows it: `proved: certificates/2.61.proof`, `certified at 412 points to 50 digits`.
pub(super) fn shown(answer: &Answer) -> String {
    let word = answer.verdict.word();
    match (answer.verdict, &answer.certificate, &answer.extent) {
        (Verdict::Proved, Some(file), _) => format!("{word}: {file}"),
        (Verdict::Certified, _, Some(extent)) => format!("{word} {}", reach(extent)),
        (Verdict::Certified, _, None) => format!("{word} by the exact series of both sides"),
        (Verdict::Undecided | Verdict::Vacuous | Verdict::IllTyped, ..) => match &answer.reason {
            Some(reason) => format!("{word}: {reason}"),
            None => word.to_owned(),
        },
        _ => word.to_owned(),
    }
}

/// How far an answer was tried: `at 412 points to 50 digits`.
pub(super) fn reach(extent: &Extent) -> String {
    format!(
        "at {} to {} digits",
        counted(extent.points, "point"),
        extent.digits
    )
}

/// Where the witness stands: `k = 2, n = 2`.
pub(super) fn place(witness: &WitnessReport) -> String {
    let point = witness.point.iter();
    let parts: Vec<String> = point
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    match parts.is_empty() {
        true => "the only point".to_owned(),
        false => parts.join(", "),
    }
}

/// The value of the left side and that of the right side at the witness.
pub(super) fn sides(witness: &WitnessReport) -> [&str; 2] {
    [0, 1].map(|side| witness.values[side].as_deref().unwrap_or("no value"))
}

/// `1 point`, `2 points`
pub(super) fn counted(count: usize, noun: &str) -> String {
    match count {
        1 => format!("1 {noun}"),
        n => format!("{n} {noun}s"),
    }
}
