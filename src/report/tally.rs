//! How many claims have which verdict.

use crate::book::Fault;
use crate::judge::{Answer, Report, Verdict};

/// What the print of a claim came to. A missing condition is counted apart from a wrong statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Verdict(Verdict),
    /// Refuted, but true under the claim's `needs`.
    ConditionMissing,
}

impl Outcome {
    /// The outcome of one answer.
    pub(super) fn of(answer: &Answer) -> Outcome {
        match (answer.verdict, answer.fault) {
            (Verdict::Refuted, Some(Fault::Domain)) => Outcome::ConditionMissing,
            (verdict, _) => Outcome::Verdict(verdict),
        }
    }

    /// The word in counts, as JSON spells it.
    pub(super) fn key(self) -> &'static str {
        match self {
            Outcome::Verdict(verdict) => verdict.word(),
            Outcome::ConditionMissing => "condition_missing",
        }
    }
}

/// The outcomes in the order of all tables and counts.
pub(super) fn outcomes() -> impl Iterator<Item = Outcome> {
    Verdict::ALL.into_iter().flat_map(|verdict| {
        let missing = (verdict == Verdict::Refuted).then_some(Outcome::ConditionMissing);
        std::iter::once(Outcome::Verdict(verdict)).chain(missing)
    })
}

/// How many of the reports came to `outcome`.
pub(super) fn count(reports: &[Report], outcome: Outcome) -> usize {
    let outcomes = reports.iter().map(|report| Outcome::of(&report.printed));
    outcomes.filter(|&o| o == outcome).count()
}

/// How many of the reports are not what the book expects.
pub(super) fn unexpected(reports: &[Report]) -> usize {
    reports.iter().filter(|report| !report.as_expected).count()
}

/// What the book expects of a claim, in words; without an `expect` line the print is expected to stand.
pub(super) fn expected(report: &Report) -> &str {
    match report.expected.as_str() {
        "" => "printed proved, certified, defined or noted",
        written => written,
    }
}
