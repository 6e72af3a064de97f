//! Simulations beside the verdicts of a run: what they say never changes a verdict, but one that speaks against a
//! positive verdict is a fault of ours.

use super::Error;
use super::run::{Run, in_parallel};
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
fn alarms(run: &Run) -> Vec<Alarm> {
    let simulated = || {
        run.reports.iter().flat_map(|report| {
            let answers = std::iter::once(&report.printed).chain(&report.mended);
            answers.filter_map(move |answer| {
                Some((report, answer.verdict, answer.simulation.as_ref()?))
            })
        })
    };
    let tests: usize = simulated().map(|(_, _, found)| found.points).sum();
    let least = critical(LEVEL / tests.max(1) as f64);
    simulated()
        .filter(|(_, _, found)| found.excess > least)
        .map(|(report, verdict, found)| Alarm {
            id: report.id.clone(),
            verdict,
            simulation: found.clone(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::read_text;
    use crate::corpus::{Options, run};

    const BOOK: &str = "
```claim order-mean
given  int l, m with 1 <= l <= m
draw   x ~ order(l, m) of uniform(0, 1)
says   mean(x) == l/(m + 1)
```

```claim order-variance
given  int l, m with 1 <= l <= m
draw   x ~ beta(l, m - l + 1)
says   var(x) == l*(m - l + 1)/((m + 1)^2*(m + 2))
```

```claim no-draws
given  real x > 0
says   ln(x^2) == 2*ln(x)
```
";

    fn simulated() -> (Run, Vec<Alarm>) {
        let book = read_text("chapter.md", BOOK).expect("a book");
        let settings = Settings::default();
        let mut run = run(&book, &settings, &Options::default(), |_| ()).expect("judged");
        let alarms = add_simulations(&mut run, &book, &settings, 1, |_| ()).expect("threads");
        (run, alarms)
    }

    #[test]
    fn what_holds_is_simulated_where_it_has_draws() {
        let (run, alarms) = simulated();
        assert_eq!(alarms, []);
        let found: Vec<_> = run
            .reports
            .iter()
            .map(|r| r.printed.simulation.as_ref())
            .collect();
        for simulation in &found[..2] {
            let simulation = simulation.expect("simulated");
            assert!(
                simulation.points > 0 && simulation.excess < 6.0,
                "{simulation:?}"
            );
        }
        assert_eq!(found[2], None);
    }

    #[test]
    fn a_simulation_that_contradicts_what_holds_is_an_alarm() {
        let (mut run, _) = simulated();
        for report in &mut run.reports {
            if let Some(found) = &mut report.printed.simulation {
                found.excess = if report.id == "order-mean" { 9.0 } else { 4.0 };
            }
        }
        let alarms = alarms(&run);
        assert_eq!(alarms.len(), 1);
        assert_eq!(alarms[0].id, "order-mean");
    }
}
