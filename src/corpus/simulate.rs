//! Simulations beside the verdicts of a run: what they say never changes a verdict, but one that speaks against a
//! positive verdict is a fault of ours.

use super::Error;
use super::run::{Run, answers, in_parallel};
use crate::book::{Book, Claim};
use crate::judge::{Answer, Report, Settings, Simulation, Verdict, simulate};
use crate::simulate::verdict::battery::critical;
use std::collections::HashMap;

/// How likely a false alarm is, in the whole run; about, since z-values are approximations.
pub const LEVEL: f64 = 1e-6;

/// Runs of each simulation.
pub const RUNS: u64 = 50_000;

/// What a simulation contradicts.
#[derive(Clone, Debug, PartialEq)]
pub struct Alarm {
    pub id: String,
    pub verdict: Verdict,
    pub simulation: Simulation,
}

/// Simulates every statement that a run found to hold, as far as it can be, and adds what comes of it to the reports.
/// Returns the simulations that contradict a verdict.
///
/// # Errors
/// [`Error::Threads`]
pub fn add_simulations(
    run: &mut Run,
    book: &Book,
    settings: &Settings,
    jobs: usize,
    progress: impl Fn(usize) + Sync,
) -> Result<Vec<Alarm>, Error> {
    let claims = book.by_id();
    let held: HashMap<&str, &Report> = run.reports.iter().map(|r| (&*r.id, r)).collect();
    let wanted = run
        .reports
        .iter()
        .filter_map(|r| claims.get(&*r.id).copied());
    let one = |claim: &Claim| {
        let report = held.get(&*claim.id);
        let holds = |answer: Option<&Answer>| answer.is_some_and(positive);
        let printed = match holds(report.map(|r| &r.printed)) {
            true => claim.printed().ok(),
            false => None,
        };
        let mended = match holds(report.and_then(|r| r.mended.as_ref())) {
            true => claim.mended().and_then(Result::ok),
            false => None,
        };
        Ok([printed, mended].map(|proposition| {
            let proposition = proposition?;
            simulate(&proposition, None, settings, RUNS).in_short(&proposition, RUNS)
        }))
    };
    let found = in_parallel(wanted.collect(), jobs, one, progress)?;
    for (report, [printed, mended]) in run.reports.iter_mut().zip(found) {
        report.printed.simulation = printed;
        if let Some(answer) = &mut report.mended {
            answer.simulation = mended;
        }
    }
    Ok(alarms(run))
}

fn positive(answer: &Answer) -> bool {
    matches!(
        answer.verdict,
        Verdict::Proved | Verdict::Certified | Verdict::Defined
    )
}

/// By Bonferroni's inequality over all points that were simulated.
fn alarms(run: &mut Run) -> Vec<Alarm> {
    let all: Vec<(String, Verdict, Simulation)> = run
        .reports
        .iter_mut()
        .flat_map(|report| {
            let id = report.id.clone();
            let simulated = answers(report)
                .filter_map(move |a| Some((id.clone(), a.verdict, a.simulation.clone()?)));
            simulated.collect::<Vec<_>>()
        })
        .collect();
    let tests: usize = all.iter().map(|(_, _, simulation)| simulation.points).sum();
    let least = critical(LEVEL / tests.max(1) as f64);
    all.into_iter()
        .filter(|(_, _, simulation)| simulation.excess > least)
        .map(|(id, verdict, simulation)| Alarm {
            id,
            verdict,
            simulation,
        })
        .collect()
}
