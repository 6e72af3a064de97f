//! Runs the claims of a book over all cores, in an order that no one can see from outside.
//!
//! A claim's verdict depends on the claim, the book and the settings only, never on the claims
//! judged before it or beside it; so any number of threads gives the same reports.

use crate::book::{Book, Claim};
use crate::formula::nearest;
use crate::judge::{self, Report, Settings};
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

/// Judges the claims that `options` choose; their reports come in the order of the book.
/// `progress` is told after each claim how many are done, from any thread.
///
/// # Errors
/// [`Error`]; a claim's own trouble is a verdict in its report, never an error here.
pub fn run(
    book: &Book,
    settings: &Settings,
    options: &Options,
    progress: impl Fn(usize) + Sync,
) -> Result<Run, Error> {
    let claims = book.by_id();
    let judge = |claim: &Claim| {
        let previous = claim
            .after
            .as_ref()
            .and_then(|id| claims.get(&**id).copied());
        judge::judge(claim, previous, settings)
    };
    Ok(Run {
        reports: in_parallel(chosen(book, &options.only)?, options.jobs, judge, progress)?,
        seed: settings.seed,
        digits: settings.digits,
    })
}

/// The reports in the order of the claims, or the error of the first claim that has one.
fn in_parallel(
    claims: Vec<&Claim>,
    jobs: usize,
    judge: impl Fn(&Claim) -> Report + Sync,
    progress: impl Fn(usize) + Sync,
) -> Result<Vec<Report>, Error> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs)
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

/// The claims that `only` names, or all where it names none, in the order of the book.
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
    use crate::book::read_text;

    /// Claims 2.0, 2.1, ... with nothing to compute.
    fn book(count: usize) -> Book {
        let claim = |i| format!("```claim 2.{i}\nsays words\n```\n");
        let text: String = (0..count).map(claim).collect();
        read_text("book.md", &text).expect("a book")
    }

    fn ids(count: usize, only: &[&str], jobs: usize) -> Result<Vec<String>, Error> {
        let only = only.iter().map(|id| (*id).to_owned()).collect();
        let options = Options { only, jobs };
        let run = run(&book(count), &Settings::default(), &options, |_| ())?;
        Ok(run.reports.into_iter().map(|report| report.id).collect())
    }

    #[test]
    fn reports_are_in_book_order_for_any_number_of_threads() {
        let expected: Vec<String> = (0..100).map(|i| format!("2.{i}")).collect();
        for jobs in [0, 1, 2, 7] {
            assert_eq!(ids(100, &[], jobs), Ok(expected.clone()));
        }
    }

    #[test]
    fn only_the_chosen_claims_in_book_order() {
        let expected = ["2.3", "2.17"].map(str::to_owned).to_vec();
        assert_eq!(ids(100, &["2.17", "2.3"], 1), Ok(expected));
    }

    #[test]
    fn an_unknown_id_names_the_nearest() {
        let unknown = |nearest: Option<&str>| Error::UnknownId {
            id: "2,17".into(),
            nearest: nearest.map(str::to_owned),
        };
        assert_eq!(ids(30, &["2,17"], 1), Err(unknown(Some("2.17"))));
        assert_eq!(ids(0, &["2,17"], 1), Err(unknown(None)));
    }

    #[test]
    fn a_panic_is_an_error_that_names_the_first_such_claim() {
        let book = book(10);
        let faulty = |claim: &Claim| match &*claim.id {
            "2.5" | "2.8" => panic!("broken"),
            _ => judge::judge(claim, None, &Settings::default()),
        };
        let error = in_parallel(book.claims.iter().collect(), 2, faulty, |_| ());
        let (id, message) = ("2.5".into(), "broken".into());
        assert_eq!(error.expect_err("a panic"), Error::Internal { id, message });
    }

    #[test]
    fn progress_counts_every_claim() {
        let most = AtomicUsize::new(0);
        let count = |done| {
            most.fetch_max(done, Ordering::Relaxed);
        };
        let run = run(&book(50), &Settings::default(), &Options::default(), count);
        assert!(run.is_ok());
        assert_eq!(most.into_inner(), 50);
    }
}
