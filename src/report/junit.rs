//! JUnit: a test suite a file of the book, a test case a claim.
//!
//! A claim that is not as expected fails. `undecided` and `noted` are no passes even where they are
//! expected, so they are skipped tests.

use super::human::detail;
use super::tally;
use crate::corpus::Run;
use crate::judge::{Report, Verdict};
use quick_junit::{NonSuccessKind, TestCase, TestCaseStatus, TestSuite};
use std::time::Duration;

/// The run as JUnit XML.
///
/// # Errors
/// Those of the XML writer.
pub fn render(run: &Run) -> Result<String, quick_junit::SerializeError> {
    let mut document = quick_junit::Report::new("claimcheck");
    let mut suites: Vec<TestSuite> = Vec::new();
    for report in &run.reports {
        let place = suites
            .iter()
            .position(|suite| suite.name.as_str() == report.file);
        let place = place.unwrap_or_else(|| {
            suites.push(TestSuite::new(report.file.as_str()));
            suites.len() - 1
        });
        suites[place].add_test_case(case(report));
    }
    document.add_test_suites(suites);
    document.to_string()
}

fn case(report: &Report) -> TestCase {
    let mut case = TestCase::new(report.id.as_str(), status(report));
    case.set_classname(report.file.as_str());
    // `try_from`: a clock that ran backwards must not end the program.
    case.set_time(Duration::try_from_secs_f64(report.seconds).unwrap_or_default());
    case
}

fn status(report: &Report) -> TestCaseStatus {
    let verdict = report.printed.verdict;
    if !report.as_expected {
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
        status.set_type("not as expected");
        status.set_message(format!(
            "{}, expected {}",
            verdict.word(),
            tally::expected(report)
        ));
        status.set_description(anstream::adapter::strip_str(&detail::render(report)).to_string());
        return status;
    }
    if matches!(verdict, Verdict::Undecided | Verdict::Noted) {
        let mut status = TestCaseStatus::skipped();
        let reason = report.printed.reason.as_deref();
        status.set_message(reason.unwrap_or(verdict.word()).to_owned());
        return status;
    }
    TestCaseStatus::success()
}

#[cfg(test)]
mod tests {
    use super::super::human::sample::run;
    use super::*;

    #[test]
    fn counts_failures_and_escapes() {
        let text = render(&run()).expect("serialises");
        assert!(text.contains(r#"tests="4""#), "{text}");
        assert!(text.contains(r#"failures="1""#), "{text}");
        assert!(text.contains(r#"<skipped message="no method"#), "{text}");
        assert!(text.contains("k &gt;= 3"), "{text}");
        assert!(!text.contains('\u{1b}'));
    }
}
