//! One row a claim, in 100 columns.
//!
//! `condition` says "missing" where the print is true as soon as `needs` is added: those errata
//! mislead less than the wrong statements. `points`, `aside` and `digits` belong to the certified
//! verdicts of the row, the print's and the mended one's.

use super::{BAD, STRONG, WIDTH, paint, style};
use crate::judge::{Answer, Extent, Report, Verdict};

/// Longer ids push their own row out.
const LONGEST_ID: usize = 24;

pub(super) fn render(reports: &[&Report]) -> String {
    let ids = reports.iter().map(|report| report.id.chars().count());
    let id_width = ids.max().unwrap_or(0).clamp(5, LONGEST_ID);
    let head = format!(
        "  {:id_width$} {:9} {:9} {:9} {:>7} {:>5} {:>6}  at",
        "claim", "printed", "condition", "mended", "points", "aside", "digits"
    );
    let mut text = paint(STRONG, &head) + "\n";
    for report in reports {
        text.push_str(&row(report, id_width));
        text.push('\n');
    }
    text
}

fn row(report: &Report, id_width: usize) -> String {
    let mark = if report.as_expected {
        " ".to_owned()
    } else {
        paint(BAD, "!")
    };
    let condition = match super::Outcome::of(&report.printed) {
        super::Outcome::ConditionMissing => "missing",
        super::Outcome::Verdict(_) => "",
    };
    let [points, aside, digits] = extents(report);
    let left = format!(
        "{:id_width$} {} {condition:9} {} {points:>7} {aside:>5} {digits:>6}  ",
        report.id,
        word(Some(&report.printed)),
        word(report.mended.as_ref()),
    );
    let used = 2 + visible(&left);
    let place = format!("{}:{}", report.file, report.line);
    format!(
        "{mark} {left}{}",
        shortened(&place, WIDTH.saturating_sub(used))
    )
}

/// A verdict in its colour, 9 columns wide.
fn word(answer: Option<&Answer>) -> String {
    let Some(answer) = answer else {
        return " ".repeat(9);
    };
    paint(
        style(answer.verdict),
        &format!("{:9}", answer.verdict.word()),
    )
}

/// Points, points set aside and digits of the certified verdicts, `/` between two. An expansion is
/// certified by its exact series, not at points.
fn extents(report: &Report) -> [String; 3] {
    let answers = [Some(&report.printed), report.mended.as_ref()];
    let certified = answers
        .into_iter()
        .flatten()
        .filter(|a| a.verdict == Verdict::Certified);
    let extents: Vec<Extent> = certified
        .clone()
        .filter_map(|answer| answer.extent)
        .collect();
    let join = |number: &dyn Fn(&Extent) -> String| {
        let numbers: Vec<String> = extents.iter().map(number).collect();
        numbers.join("/")
    };
    let by_series = |answer: &Answer| answer.series.is_some() && answer.extent.is_none();
    if extents.is_empty() && certified.clone().any(by_series) {
        return ["series".to_owned(), String::new(), String::new()];
    }
    [
        join(&|e| e.points.to_string()),
        join(&|e| e.set_aside.to_string()),
        join(&|e| e.digits.to_string()),
    ]
}

/// The end of a text that is too long for its room.
fn shortened(text: &str, room: usize) -> String {
    let length = text.chars().count();
    if length <= room {
        return text.to_owned();
    }
    let skip = length - room.saturating_sub(1).min(length);
    "…".chars().chain(text.chars().skip(skip)).collect()
}

fn visible(text: &str) -> usize {
    anstream::adapter::strip_str(text)
        .to_string()
        .chars()
        .count()
}

#[cfg(test)]
mod tests {
    use super::shortened;

    #[test]
    fn keeps_the_end_of_a_path() {
        assert_eq!(shortened("proofs/a.md:7", 20), "proofs/a.md:7");
        assert_eq!(
            shortened("proofs/a.md:7", 7),
            "….md:7".replacen('…', "…a", 1)
        );
        assert_eq!(shortened("abc", 0), "…");
    }
}
