//! `claimcheck probe`: certified sweeps over k.

use super::output::{Exit, Failure, internal, to_stdout, write_file};
use super::progress::Bar;
use crate::probe::{Error, Journal, JournalError, NotAsked, Probe as Sweep, Question, Tally};
use crate::report;
use crate::report::diagnostic;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::Mutex;

/// Sweeps over all photons of a range: extremes of a quantity, and whether a claim holds for each
#[derive(Debug, Args)]
#[command(after_help = MODEL)]
pub(super) struct Probe {
    /// triangular (strategy 2), listing, one (strategy 1), or the photons of each shell: 5,7,9
    #[arg(long, default_value = "triangular", value_name = "LAYOUT")]
    layout: String,
    /// The photons: 4..1e9
    #[arg(long, value_name = "A..B", value_parser = range, required_unless_present = "merge")]
    k: Option<(u64, u64)>,
    /// A formula over k, l, m, Va, V, E_k and Var_k: its extremes
    #[arg(long, value_name = "EXPR", allow_hyphen_values = true)]
    quantity: Option<String>,
    /// A chain such as 1 + 1/k^2 < E_k < 1 + 1/k: where it fails, and how nearly
    #[arg(long, value_name = "CLAIM", allow_hyphen_values = true)]
    claim: Option<String>,
    /// Of each shell N stretches of 8 neighbours only, the first and the last photon among them
    #[arg(long, value_name = "N")]
    sample: Option<u64>,
    /// A file that keeps what is done: the same command goes on from there
    #[arg(long, value_name = "FILE")]
    journal: Option<PathBuf>,
    /// Does the i-th of n parts only; --merge writes what files are asked for
    #[arg(long, value_name = "I/N", value_parser = shard, requires = "journal")]
    shard: Option<(u64, u64)>,
    /// Joins the journals of shards and prints what they come to
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["layout", "k", "sample", "quantity", "claim", "journal", "shard"])]
    merge: Vec<PathBuf>,
    /// The table by decades as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// The same for each shell as CSV; each shard needs the option as well
    #[arg(long, value_name = "FILE")]
    shells: Option<PathBuf>,
    /// A picture of it
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
}

/// What the names mean.
const MODEL: &str = "\
Photon k is the l-th of the m in its shell, which has the volume V = m around the volume Va = k - l:
E_k = mean(k/U) and Var_k = var(k/U) for U = Va + V*x, x ~ beta(l, m-l+1). triangular: shells of
1, 2, 3, ... photons; listing: the same around one empty unit of volume, from photon 2 on; one: a
shell for each photon. Formulas: + - * / ^ (exponents n and n/2), abs, sqrt, min, max; ln and exp
are computed photon by photon, some 30 microseconds each.
Exit code: 0 where all links hold for every k, 1 where not; of a shard 0 when it is done.";

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Human,
    Json,
}

/// A whole number: 4, 1e9 or 10^9.
fn whole(text: &str) -> Option<u64> {
    let (base, exponent) = match (text.split_once('e'), text.split_once('^')) {
        (Some((digits, exponent)), _) => {
            let scale = 10u64.checked_pow(exponent.parse().ok()?)?;
            return digits.parse::<u64>().ok()?.checked_mul(scale);
        }
        (None, Some(power)) => power,
        (None, None) => return text.parse().ok(),
    };
    base.parse::<u64>()
        .ok()?
        .checked_pow(exponent.parse().ok()?)
}

fn range(text: &str) -> Result<(u64, u64), String> {
    let ends = text
        .split_once("..")
        .and_then(|(a, b)| Some((whole(a)?, whole(b)?)));
    ends.ok_or_else(|| "write 4..1e9".to_owned())
}

fn shard(text: &str) -> Result<(u64, u64), String> {
    let parts = text
        .split_once('/')
        .and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    parts
        .filter(|&(i, n): &(u64, u64)| 1 <= i && i <= n)
        .ok_or_else(|| "write 1/8 to 8/8".to_owned())
}

impl Probe {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (sweep, journal) = match self.merge.split_first() {
            None => self.sweep()?,
            Some((first, others)) => {
                let mut all = Journal::read(first).map_err(unusable)?;
                for path in others {
                    all.join(Journal::read(path).map_err(unusable)?)
                        .map_err(unusable)?;
                }
                (Sweep::new(all.question().clone()).map_err(refused)?, all)
            }
        };
        let missing = (0..sweep.chunks())
            .filter(|chunk| !journal.has(*chunk))
            .count();
        if missing > 0 && self.shard.is_none() {
            let hint = Some("give the journals of all shards, each run to its end");
            let message = format!("{missing} of {} chunks are missing", sweep.chunks());
            return Err(Failure::input(&message, hint));
        }
        if journal.done().any(|chunk| chunk >= sweep.chunks()) {
            return Err(Failure::input(
                "the journal has chunks that the range has not",
                None,
            ));
        }
        let summary = journal.summary();
        if summary.photons == 0 && self.shard.is_none() {
            let hint = Some("ask for a longer range, or for more stretches");
            return Err(Failure::input(
                "the sample has no photon of this range",
                hint,
            ));
        }
        if self.shells.is_some() && !sweep.question().shells {
            let hint = Some("give --shells to each shard as well");
            return Err(Failure::input("the journals do not tell of shells", hint));
        }
        if let Some((part, parts)) = self.shard {
            let done = journal.done().count();
            to_stdout(&format!(
                "shard {part} of {parts} is done: {done} of {} chunks, {} photons; join the journals with --merge\n",
                sweep.chunks(),
                summary.photons
            ))?;
            return Ok(Exit::AsExpected);
        }
        if let Some(path) = &self.csv {
            write_file(path, &report::probe::csv(&sweep, &summary))?;
        }
        if let Some(path) = &self.shells {
            write_file(path, &report::probe::shells(&sweep, &summary))?;
        }
        if let Some(path) = &self.svg {
            write_file(path, &report::probe::picture(&sweep, &summary))?;
        }
        to_stdout(&match self.format {
            Format::Human => report::probe::human(&sweep, &summary),
            Format::Json => report::probe::json(&sweep, &summary),
        })?;
        Ok(if summary.links.iter().all(Tally::holds) {
            Exit::AsExpected
        } else {
            Exit::NotAsExpected
        })
    }

    /// Asks all chunks that are not done.
    fn sweep(&self) -> Result<(Sweep, Journal), Failure> {
        let (first, last) = self.k.unwrap_or_default();
        if self.quantity.is_none() && self.claim.is_none() {
            let hint = Some("add --claim '1 + 1/k^2 < E_k < 1 + 1/k' or --quantity 'k*Var_k'");
            return Err(Failure::input("nothing is asked", hint));
        }
        let sweep = Sweep::new(Question {
            layout: self.layout.clone(),
            first,
            last,
            quantity: self.quantity.clone(),
            claim: self.claim.clone(),
            sample: self.sample,
            shells: self.shells.is_some(),
        })
        .map_err(refused)?;
        let journal = match &self.journal {
            Some(path) => Journal::open(path, sweep.question()).map_err(unusable)?,
            None => Journal::unwritten(sweep.question()),
        };
        let (part, parts) = self.shard.unwrap_or((1, 1));
        let wanted: Vec<u64> = (0..sweep.chunks())
            .filter(|chunk| chunk % parts == part - 1 && !journal.has(*chunk))
            .collect();
        let bar = Bar::new(wanted.len(), "chunks", self.quiet);
        let journal = Mutex::new((journal, 0));
        let ask = |chunk: &u64| {
            let found = sweep.ask(*chunk).map_err(refused)?;
            let Ok(mut shared) = journal.lock() else {
                return Err(internal("another thread failed"));
            };
            shared.0.add(*chunk, found).map_err(unusable)?;
            shared.1 += 1;
            bar.show(shared.1);
            Ok(())
        };
        let threads = rayon::ThreadPoolBuilder::new().num_threads(self.jobs.unwrap_or(0).into());
        let threads = threads
            .build()
            .map_err(|error| internal(&error.to_string()))?;
        let asked = threads.install(|| wanted.par_iter().try_for_each(ask));
        bar.clear();
        asked?;
        match journal.into_inner() {
            Ok((journal, _)) => Ok((sweep, journal)),
            Err(_) => Err(internal("a thread failed")),
        }
    }
}

fn unusable(error: JournalError) -> Failure {
    let hint = match error {
        JournalError::Other { .. } => Some("name a new file, or ask what it asks"),
        _ => None,
    };
    Failure::input(&error.to_string(), hint)
}

fn refused(error: Error) -> Failure {
    let hint = match &error {
        Error::Syntax {
            option,
            text,
            diagnostic,
        } => {
            return Failure::rendered(diagnostic::render(option, text, diagnostic));
        }
        Error::Layout(_) => Some("triangular, listing, one, or numbers of photons: 5,7,9"),
        Error::NoSample => Some("leave out --sample"),
        Error::NoShells => Some("leave out --shells"),
        Error::Shells(_) => Some("ask for fewer photons, or leave out --shells"),
        Error::NoPhoton(_) => Some("ask for photons that it has: --k A..B"),
        Error::NotAsked(NotAsked::UnknownName(_)) => {
            Some("the model has k, l, m, Va, V, E_k and Var_k")
        }
        Error::NotAsked(NotAsked::Unsupported(_)) => {
            Some("a probe knows + - * /, powers n and n/2, abs, sqrt, ln, exp, min and max")
        }
        _ => None,
    };
    Failure::input(&error.to_string(), hint)
}

#[cfg(test)]
mod tests {
    use super::{range, shard};

    #[test]
    fn ranges_and_shards() {
        assert_eq!(range("4..1e9"), Ok((4, 1_000_000_000)));
        assert_eq!(range("10^3..12"), Ok((1000, 12)));
        assert!(range("4").is_err() && range("4..1e99").is_err() && range("..").is_err());
        assert_eq!(shard("2/8"), Ok((2, 8)));
        assert!(shard("0/8").is_err() && shard("9/8").is_err() && shard("x").is_err());
    }
}
