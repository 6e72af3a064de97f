//! Runs the claims of a book over all cores, in an order that no one can see from outside.
//!
//! A claim's verdict depends on the claim, the book and the settings only, never on the claims
//! judged before it or beside it; so any number of threads gives the same reports.

use crate::book::{Book, Claim};
use crate::formula::nearest;
use crate::judge::Report;
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Formulas are trees as deep as the parser allows; the walks over them recurse.
const STACK_BYTES: usize = 64 << 20;

/// Which claims are run, and how.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Ids of the claims to run; all, if there is none.
    pub only: Vec<String>,
    /// Threads; as many as the machine has cores, if 0.
    pub jobs: usize,
}

/// What a run found, in the order of the book.
#[derive(Clone, Debug)]
pub struct Run {
    pub reports: Vec<Report>,
    pub seed: u64,
    pub digits: u32,
}

/// Why a run has no reports.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// `only` names a claim that the book does not have; the id spelled most like it.
    #[error("no claim has the id `{id}`")]
    UnknownId { id: String, nearest: Option<String> },
    /// A fault of this program, not of the book.
    #[error("claim {id}: {message}")]
    Internal { id: String, message: String },
    #[error("the threads cannot be started: {0}")]
    Threads(String),
}

/// Judges the claims that `options` choose and returns their reports in the order of the book.
/// `progress` is told after each claim how many are done, from any thread.
///
/// # Errors
/// [`Error`]; a claim's own trouble is a verdict in its report, never an error here.
pub fn run(
    book: &Book,
    options: &Options,
    judge: impl Fn(&Claim) -> Report + Sync,
    progress: impl Fn(usize) + Sync,
) -> Result<Vec<Report>, Error> {
    let claims = chosen(book, &options.only)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.jobs)
        .stack_size(STACK_BYTES)
        .build()
        .map_err(|error| Error::Threads(error.to_string()))?;
    let done = AtomicUsize::new(0);
    let one = |claim: &&Claim| {
        let report = guarded(claim, &judge);
        progress(done.fetch_add(1, Ordering::Relaxed) + 1);
        report
    };
    // Collected whole before the first error is taken, so that it is the first of the book.
    let reports: Vec<_> = pool.install(|| claims.par_iter().map(one).collect());
    reports.into_iter().collect()
}

/// How many claims `only` chooses.
///
/// # Errors
/// [`Error::UnknownId`]
pub fn chosen<'a>(book: &'a Book, only: &[String]) -> Result<Vec<&'a Claim>, Error> {
    for id in only {
        if !book.claims.iter().any(|claim| *claim.id == **id) {
            return Err(unknown(book, id));
        }
    }
    let wanted = |claim: &&Claim| only.is_empty() || only.iter().any(|id| **id == *claim.id);
    Ok(book.claims.iter().filter(wanted).collect())
}

fn unknown(book: &Book, id: &str) -> Error {
    let ids = book.claims.iter().map(|claim| &*claim.id);
    Error::UnknownId {
        id: id.to_owned(),
        nearest: nearest(id, ids).map(str::to_owned),
    }
}

/// One claim; a panic becomes an error that names it.
fn guarded(claim: &Claim, judge: &impl Fn(&Claim) -> Report) -> Result<Report, Error> {
    catch_unwind(AssertUnwindSafe(|| judge(claim))).map_err(|panic| {
        let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
        Error::Internal {
            id: claim.id.to_string(),
            message: text.unwrap_or_else(|| "a panic without a message".to_owned()),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::Scope;
    use crate::formula::Statement;
    use crate::judge::{Answer, Kind, Verdict};

    fn book(count: usize) -> Book {
        let claim = |i: usize| Claim {
            id: format!("2.{i}").into(),
            file: "book.md".into(),
            line: i + 1,
            scope: Scope::default(),
            says: Statement::Words,
            says_text: "words".into(),
            mend: None,
            mend_text: None,
            needs: None,
            after: None,
            read: None,
            slip: None,
            why: None,
            expect: None,
            expect_text: None,
        };
        Book {
            claims: (0..count).map(claim).collect(),
        }
    }

    fn noted(claim: &Claim) -> Report {
        Report {
            id: claim.id.to_string(),
            file: claim.file.display().to_string(),
            line: claim.line,
            kind: Kind::Words,
            printed: Answer {
                verdict: Verdict::Noted,
                fault: None,
                written: String::new(),
                statement: String::new(),
                extent: None,
                reason: None,
                witness: None,
                links: Vec::new(),
                series: None,
                constants: None,
                facts: Vec::new(),
                certificate: None,
            },
            mended: None,
            needs: None,
            needs_fault: None,
            sufficient: false,
            slip: None,
            why: None,
            expected: String::new(),
            as_expected: true,
            steps: 0,
            seconds: 0.0,
        }
    }

    fn ids(options: &Options) -> Vec<String> {
        let reports = run(&book(100), options, noted, |_| ()).expect("no fault");
        reports.into_iter().map(|report| report.id).collect()
    }

    #[test]
    fn reports_are_in_book_order_for_any_number_of_threads() {
        let expected: Vec<String> = (0..100).map(|i| format!("2.{i}")).collect();
        for jobs in [0, 1, 2, 7] {
            let only = Vec::new();
            assert_eq!(ids(&Options { only, jobs }), expected);
        }
    }

    #[test]
    fn only_the_chosen_claims_in_book_order() {
        let only = vec!["2.17".to_owned(), "2.3".to_owned()];
        assert_eq!(ids(&Options { only, jobs: 1 }), ["2.3", "2.17"]);
    }

    #[test]
    fn an_unknown_id_names_the_nearest() {
        let options = Options {
            only: vec!["2,17".into()],
            jobs: 1,
        };
        let error = run(&book(30), &options, noted, |_| ()).expect_err("no such claim");
        let nearest = Some("2.17".to_owned());
        assert_eq!(
            error,
            Error::UnknownId {
                id: "2,17".into(),
                nearest
            }
        );
        let empty = run(&book(0), &options, noted, |_| ()).expect_err("no claim at all");
        assert_eq!(
            empty,
            Error::UnknownId {
                id: "2,17".into(),
                nearest: None
            }
        );
    }

    #[test]
    fn a_panic_is_an_error_that_names_the_claim() {
        let faulty = |claim: &Claim| match &*claim.id {
            "2.5" | "2.8" => panic!("broken"),
            _ => noted(claim),
        };
        let error = run(&book(10), &Options::default(), faulty, |_| ()).expect_err("a panic");
        let (id, message) = ("2.5".into(), "broken".into());
        assert_eq!(error, Error::Internal { id, message });
    }

    #[test]
    fn progress_counts_every_claim() {
        let most = AtomicUsize::new(0);
        let count = |done| {
            most.fetch_max(done, Ordering::Relaxed);
        };
        run(&book(50), &Options::default(), noted, count).expect("no fault");
        assert_eq!(most.into_inner(), 50);
    }
}
