//! The report for people: a table of verdicts, the counts, and the details of what is not as expected.

pub mod detail;
mod simulation;
mod table;

#[cfg(test)]
pub(super) mod sample;

use super::style::{FAINT, STRONG, WIDTH, paint};
use super::tally::{self, Outcome};
use super::words::counted;
use crate::corpus::Run;
use crate::judge::Verdict;

/// Whether the claims that are as expected have rows too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rows {
    All,
    Unexpected,
}

/// The whole report, with colours.
pub fn render(run: &Run, rows: Rows) -> String {
    let shown = |as_expected: bool| rows == Rows::All || !as_expected;
    let listed: Vec<_> = run
        .reports
        .iter()
        .filter(|r| shown(r.as_expected))
        .collect();
    let mut text = String::new();
    if !listed.is_empty() {
        text.push_str(&table::render(&listed));
        text.push('\n');
    }
    for report in run.reports.iter().filter(|report| !report.as_expected) {
        text.push_str(&detail::render(report));
        text.push('\n');
    }
    text.push_str(&simulation::render(run));
    text.push_str(&summary(run));
    text
}

/// The counts, by the verdict on the print, and whether all is as expected.
fn summary(run: &Run) -> String {
    let mut parts = Vec::new();
    for outcome in tally::outcomes() {
        let count = tally::count(&run.reports, outcome);
        if count > 0 {
            parts.push(format!("{count} {}", words(outcome)));
        }
    }
    let claims = counted(run.reports.len(), "claim");
    let counts = if parts.is_empty() {
        String::new()
    } else {
        format!(": {}", parts.join(", "))
    };
    let sufficient = run.reports.iter().filter(|r| r.sufficient).count();
    let sufficient = match sufficient {
        0 => String::new(),
        n => format!("; {n} with a condition that is sufficient, not shown necessary"),
    };
    let verdict = match tally::unexpected(&run.reports) {
        0 => paint(GOOD, "all as expected"),
        n => paint(BAD, &format!("{n} not as expected")),
    };
    format!(
        "{claims}{counts}{sufficient}\n{verdict} (seed {}, {} digits)\n",
        run.seed, run.digits
    )
}

fn words(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::ConditionMissing => "with a condition missing",
        Outcome::Verdict(verdict) => verdict.word(),
    }
}

/// More terminal styles.
const GOOD: &str = "32";
const BAD: &str = "1;31";
const WRONG: &str = "31";
const OPEN: &str = "33";

fn style(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Proved | Verdict::Certified | Verdict::Defined => GOOD,
        Verdict::Refuted | Verdict::IllTyped => WRONG,
        Verdict::Undecided | Verdict::Vacuous => OPEN,
        Verdict::Noted => FAINT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plainly(rows: Rows) -> String {
        anstream::adapter::strip_str(&render(&sample::run(), rows)).to_string()
    }

    #[test]
    fn all_of_it() {
        insta::assert_snapshot!(plainly(Rows::All));
    }

    #[test]
    fn only_what_is_not_as_expected() {
        let text = plainly(Rows::Unexpected);
        assert!(text.contains("2.62"));
        assert!(!text.contains("2.14"));
        assert!(
            text.ends_with("1 not as expected (seed 1, 50 digits)\n"),
            "{text}"
        );
    }

    #[test]
    fn fits_100_columns() {
        for line in plainly(Rows::All).lines() {
            assert!(line.chars().count() <= 100, "{line}");
        }
    }

    #[test]
    fn an_empty_book_is_no_fault() {
        let run = Run {
            reports: Vec::new(),
            seed: 1,
            digits: 50,
            saved: crate::corpus::Saved::default(),
            cached: crate::corpus::FromCache::default(),
        };
        let text = anstream::adapter::strip_str(&render(&run, Rows::All)).to_string();
        assert_eq!(text, "0 claims\nall as expected (seed 1, 50 digits)\n");
    }
}
