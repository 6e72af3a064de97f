//! Runs the claims of a book over all cores, in an order that no one can see from outside.
//!
//! A claim's verdict depends on the claim, the book and the settings only, never on the claims
//! judged before it or beside it; so any number of threads gives the same reports.

use super::cache::{Cache, Found, MOST_ENTRIES};
use super::certificates::Store;
use super::{Error, chosen};
use crate::book::{Book, Claim};
use crate::judge::{self, Answer, Report, Settings};
use crate::kernel::proof::Certificate;
use rayon::prelude::*;
use std::collections::HashMap;
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
    /// Where certificates are kept; those that still hold are not searched for anew.
    pub certificates: Option<Store>,
    /// Whether the certificates of what is proved or refuted are written there.
    pub save: bool,
    /// Where reports are kept. One that comes from there has no evidence, so nothing of it is saved.
    pub cache: Option<Cache>,
}

/// What a run found, in the order of the book.
#[derive(Clone, Debug)]
pub struct Run {
    pub reports: Vec<Report>,
    pub seed: u64,
    pub digits: u32,
    pub saved: Saved,
    pub cached: FromCache,
}

/// How many files of certificates a run has written, and how many were so already.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Saved {
    pub written: usize,
    pub unchanged: usize,
}

/// What the cache did for a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FromCache {
    /// Reports that were there.
    pub found: usize,
    /// Entries that were not as they were written; those claims were judged anew.
    pub damaged: usize,
    /// Reports that could not be kept.
    pub unwritable: usize,
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
    let work = Work {
        claims: book.by_id(),
        settings,
        options,
        counts: Counts::default(),
    };
    let chosen = chosen(book, &options.only)?;
    let reports = in_parallel(chosen, options.jobs, |claim| work.report(claim), progress)?;
    Ok(Run {
        reports,
        seed: settings.seed,
        digits: settings.digits,
        saved: Saved {
            written: work.counts.written.into_inner(),
            unchanged: work.counts.unchanged.into_inner(),
        },
        cached: FromCache {
            found: work.counts.found.into_inner(),
            damaged: work.counts.damaged.into_inner(),
            unwritable: work.counts.unwritable.into_inner(),
        },
    })
}

/// What the threads of a run share.
struct Work<'a> {
    claims: HashMap<&'a str, &'a Claim>,
    settings: &'a Settings,
    options: &'a Options,
    counts: Counts,
}

#[derive(Default)]
struct Counts {
    written: AtomicUsize,
    unchanged: AtomicUsize,
    found: AtomicUsize,
    damaged: AtomicUsize,
    unwritable: AtomicUsize,
    kept: AtomicUsize,
}

impl Work<'_> {
    /// The report on a claim, from the cache or judged.
    fn report(&self, claim: &Claim) -> Result<Report, Error> {
        let after = claim.after.as_ref();
        let previous = after.and_then(|id| self.claims.get(&**id).copied());
        // What is saved is evidence, which the cache does not have.
        let Some(cache) = self.options.cache.as_ref().filter(|_| !self.options.save) else {
            return self.judged(claim, previous);
        };
        let store = self.options.certificates.as_ref();
        let entry = cache.entry(claim, previous, store, self.settings);
        match entry.read(claim) {
            Found::Report(report) => {
                count(&self.counts.found);
                return Ok(*report);
            }
            Found::Damaged => count(&self.counts.damaged),
            Found::Nothing => (),
        }
        let report = self.judged(claim, previous)?;
        if self.counts.kept.fetch_add(1, Ordering::Relaxed) < MOST_ENTRIES
            && entry.write(&report).is_err()
        {
            count(&self.counts.unwritable);
        }
        Ok(report)
    }

    fn judged(&self, claim: &Claim, previous: Option<&Claim>) -> Result<Report, Error> {
        let Some(store) = &self.options.certificates else {
            return sound(judge::judge(claim, previous, self.settings));
        };
        // A file that is no certificate is as good as none: `recheck` tells what is wrong with it.
        let kept = store.read(claim).unwrap_or_default();
        let mut report = sound(judge::judge_with(claim, previous, &kept, self.settings))?;
        let mut there = kept;
        let found = certificates(&report);
        if self.options.save && !found.is_empty() {
            match save(store, claim, &found)? {
                true => count(&self.counts.written),
                false => count(&self.counts.unchanged),
            }
            there = found;
        }
        for answer in answers(&mut report) {
            let is_there = |found: &Certificate| there.contains(found);
            let saved = answer.evidence.as_ref().is_some_and(is_there);
            answer.certificate = saved.then(|| store.shown(claim));
        }
        Ok(report)
    }
}

fn count(counter: &AtomicUsize) {
    counter.fetch_add(1, Ordering::Relaxed);
}

/// The report, unless it says that this program is not to be believed.
fn sound(report: Report) -> Result<Report, Error> {
    match &report.contradiction {
        None => Ok(report),
        Some(message) => Err(Error::Internal {
            id: report.id.clone(),
            message: message.clone(),
        }),
    }
}

fn answers(report: &mut Report) -> impl Iterator<Item = &mut Answer> {
    std::iter::once(&mut report.printed).chain(&mut report.mended)
}

/// What the report rests on, the print first.
fn certificates(report: &Report) -> Vec<Certificate> {
    let answers = std::iter::once(&report.printed).chain(&report.mended);
    answers
        .filter_map(|answer| answer.evidence.clone())
        .collect()
}

fn save(store: &Store, claim: &Claim, found: &[Certificate]) -> Result<bool, Error> {
    store.write(claim, found).map_err(|error| {
        let path = store.path(claim);
        Error::Unwritable(format!("{} cannot be written: {error}", path.display()))
    })
}

/// The reports in the order of the claims, or the error of the first claim that has one.
pub(super) fn in_parallel<T: Send>(
    claims: Vec<&Claim>,
    jobs: usize,
    work: impl Fn(&Claim) -> Result<T, Error> + Sync,
    progress: impl Fn(usize) + Sync,
) -> Result<Vec<T>, Error> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs)
        .stack_size(STACK_BYTES)
        .build()
        .map_err(|error| Error::Threads(error.to_string()))?;
    let done = AtomicUsize::new(0);
    let one = |claim: &&Claim| {
        let found = guarded(claim, &work);
        progress(done.fetch_add(1, Ordering::Relaxed) + 1);
        found
    };
    // Collected whole before the first error is taken, so that it is the first of the book.
    let found: Vec<_> = pool.install(|| claims.par_iter().map(one).collect());
    found.into_iter().collect()
}

/// One claim; a panic becomes an error that names it.
fn guarded<T>(claim: &Claim, work: &impl Fn(&Claim) -> Result<T, Error>) -> Result<T, Error> {
    catch_unwind(AssertUnwindSafe(|| work(claim))).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
        Err(Error::Internal {
            id: claim.id.to_string(),
            message: text.unwrap_or_else(|| "a panic without a message".to_owned()),
        })
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
        let options = Options {
            only,
            jobs,
            ..Options::default()
        };
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
            _ => Ok(judge::judge(claim, None, &Settings::default())),
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

    #[test]
    fn what_is_in_the_cache_is_not_judged_again() {
        let folder = std::env::temp_dir().join(format!("claimcheck-run-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        let options = Options {
            cache: Some(Cache::within(&folder).expect("the program is there")),
            ..Options::default()
        };
        let cached = |count: usize| {
            let run = run(&book(count), &Settings::default(), &options, |_| ()).expect("a run");
            (run.reports.len(), run.cached.found)
        };
        assert_eq!(cached(20), (20, 0));
        assert_eq!(cached(30), (30, 20));
        assert_eq!(cached(30), (30, 30));
        std::fs::remove_dir_all(&folder).expect("it is there");
    }

    #[test]
    fn a_contradiction_is_an_internal_error() {
        let book = book(1);
        let mut report = judge::judge(&book.claims[0], None, &Settings::default());
        report.contradiction = Some("link 1 is both".into());
        let (id, message) = ("2.0".into(), "link 1 is both".into());
        let error = sound(report).expect_err("a contradiction");
        assert_eq!(error, Error::Internal { id, message });
    }
}
