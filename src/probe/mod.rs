//! Certified sweeps: what a quantity does, and whether a claim holds, for every k of a long range of photons.
//!
//! A [`Probe`] asks a layout for all photons `first..=last`: the extremes of a quantity, and for each link of a claim
//! its least margin and every violation. Doubles with proved bounds ([`crate::special::doubles`]) decide nearly all
//! photons; the others are done again one by one with as many digits as it takes. So every verdict is proved,
//! for the range; what stays open is counted as undecided.
//!
//! The range is cut into chunks that depend on nothing but the range; each comes to a [`Summary`], and these
//! add up in any order. So threads, runs that are resumed and shards on several machines give the same
//! result to the byte.
//!
//! ```
//! use claimcheck::probe::{Probe, Question};
//! let probe = Probe::new(Question {
//!     layout: "triangular".into(),
//!     first: 4,
//!     last: 100_000,
//!     quantity: Some("k*Var_k".into()),
//!     claim: Some("1 + 1/k^2 < E_k < 1 + 1/k".into()),
//!     ..Question::default()
//! })?;
//! let mut all = claimcheck::probe::Summary::default();
//! for chunk in 0..probe.chunks() {
//!     all.merge(&probe.ask(chunk)?);
//! }
//! assert_eq!(all.photons, 99_997);
//! assert!(all.links.iter().all(|link| link.violations.count == 0 && link.undecided.count == 0));
//! # Ok::<(), claimcheck::probe::Error>(())
//! ```

mod column;
mod expression;
mod journal;
mod photon;
mod summary;

pub use expression::NotAsked;
pub use journal::{Journal, JournalError};
pub use summary::{Extreme, Named, Stretch, Summary, Tally, bin};

use crate::formula::{
    Diagnostic, Formula, Operator, Relation, Statement, parse_formula, parse_statement,
};
use crate::model::{Layout, Shell};
use crate::number::{Double, Interval};
use crate::special::doubles::{Block, Doubles, DoublesError, MOST_STRETCHES};
use column::{Ends, Photons};
use expression::Term;
use photon::Found;
use rug::Integer;
use rug::float::Round;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::iter;

/// Photons of a chunk at least; a longer range has larger ones.
const CHUNK: u64 = 1 << 20;

/// Chunks of a range at most.
const MOST_CHUNKS: u64 = 1 << 12;

/// No photon beyond this: doubles serve shells up to the volume 2^50.
const FARTHEST: u64 = 1_000_000_000_000_000;

/// No more shells than this are told of one by one.
const MOST_SHELLS: u64 = 1 << 20;

/// Digits to which the extremes of a quantity are told where doubles do not tell them.
const DIGITS: u32 = 15;

/// What is asked, as it was written.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Question {
    /// `triangular`, `listing`, `one`, or the shells' numbers of photons: `5,7,9`.
    pub layout: String,
    /// The first and the last k.
    pub first: u64,
    pub last: u64,
    /// A formula over k, l, m, Va, V, E_k and Var_k.
    pub quantity: Option<String>,
    /// A chain of inequalities over the same.
    pub claim: Option<String>,
    /// Not all photons: of each shell so many stretches of eight neighbours, see [`Doubles::sampled`].
    pub sample: Option<u64>,
    /// Whether each shell is told of by itself.
    pub shells: bool,
}

/// Why there is nothing to ask, or no answer.
#[derive(Clone, Debug, thiserror::Error)]
pub enum Error {
    /// No such layout.
    #[error("`{0}` is no layout")]
    Layout(String),
    /// The range is empty or reaches too far.
    #[error("k = {0}..{1} is no range between 1 and 10^15")]
    Range(u64, u64),
    /// The layout has no such photon.
    #[error("the layout has no photon {0}")]
    NoPhoton(u64),
    /// The sample is too small or too large.
    #[error("of a shell 2 to {MOST_STRETCHES} stretches are taken, not {0}")]
    Sample(u64),
    /// All shells have one photon.
    #[error("shells of one photon are asked whole: there is nothing to sample")]
    NoSample,
    /// Too many shells.
    #[error("{0} shells are too many to be told of one by one")]
    Shells(u64),
    /// Shells of one photon.
    #[error("each shell has one photon: there is nothing to tell of shells")]
    NoShells,
    /// No such chunk.
    #[error("there is no chunk {0}")]
    NoChunk(u64),
    /// The text of the quantity or the claim does not parse.
    #[error("{diagnostic}")]
    Syntax {
        /// `--quantity` or `--claim`
        option: &'static str,
        text: String,
        diagnostic: Diagnostic,
    },
    /// The claim is no chain of `<`, `<=`, `>`, `>=`, `==` and `!=`.
    #[error("a claim about photons is a chain of `<`, `<=`, `>`, `>=`, `==` or `!=`")]
    NoChain,
    /// A part of it cannot be asked for.
    #[error(transparent)]
    NotAsked(#[from] NotAsked),
    /// A shell is out of reach.
    #[error(transparent)]
    Doubles(#[from] DoublesError),
}

/// A question, ready to be asked.
#[derive(Clone, Debug)]
pub struct Probe {
    question: Question,
    layout: Layout,
    quantity: Option<Term>,
    links: Vec<Link>,
}

/// A link of the claim: what its difference must be.
#[derive(Clone, Debug)]
struct Link {
    text: String,
    /// The larger side less the smaller one.
    difference: Term,
    wanted: Wanted,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    Positive,
    NotNegative,
    Zero,
    NotZero,
}

impl Wanted {
    /// Whether a number between two ends with these signs is as wanted, where that can be told.
    fn holds(self, low: Option<Ordering>, high: Option<Ordering>) -> Option<bool> {
        let (low, high) = (low?, high?);
        let told = |yes: bool, no: bool| (yes || no).then_some(yes);
        let apart = low.is_gt() || high.is_lt();
        let zero = low.is_eq() && high.is_eq();
        match self {
            Wanted::Positive => told(low.is_gt(), high.is_le()),
            Wanted::NotNegative => told(low.is_ge(), high.is_lt()),
            Wanted::Zero => told(zero, apart),
            Wanted::NotZero => told(apart, zero),
        }
    }

    /// Whether a difference tells how nearly the link fails.
    fn has_margin(self) -> bool {
        matches!(self, Wanted::Positive | Wanted::NotNegative)
    }
}

impl Probe {
    /// # Errors
    /// [`Error`]; all that is wrong with the question, before anything is computed.
    pub fn new(question: Question) -> Result<Probe, Error> {
        let layout = layout(&question.layout)?;
        if question.first < 1 || question.first > question.last || question.last > FARTHEST {
            return Err(Error::Range(question.first, question.last));
        }
        // The photons of a layout are neighbours: if it has both ends it has all.
        for k in [question.first, question.last] {
            if layout.shell(&Integer::from(k)).is_none() {
                return Err(Error::NoPhoton(k));
            }
        }
        if let Some(stretches) = question.sample
            && !(2..=MOST_STRETCHES).contains(&stretches)
        {
            return Err(Error::Sample(stretches));
        }
        if question.sample.is_some() && layout == Layout::One {
            return Err(Error::NoSample);
        }
        if question.shells {
            if layout == Layout::One {
                return Err(Error::NoShells);
            }
            let shells = shells_between(&layout, question.first, question.last);
            if shells > MOST_SHELLS {
                return Err(Error::Shells(shells));
            }
        }
        let quantity = match &question.quantity {
            Some(text) => {
                let formula = parse_formula(text).map_err(|e| syntax("--quantity", text, e))?;
                Some(Term::new(&formula)?)
            }
            None => None,
        };
        let links = match &question.claim {
            Some(text) => links_of(parse_statement(text).map_err(|e| syntax("--claim", text, e))?)?,
            None => vec![],
        };
        Ok(Probe {
            question,
            layout,
            quantity,
            links,
        })
    }

    /// What is asked.
    pub fn question(&self) -> &Question {
        &self.question
    }

    /// The links of the claim, as text.
    pub fn links(&self) -> impl Iterator<Item = &str> {
        self.links.iter().map(|link| link.text.as_str())
    }

    /// How many photons the shell of photon k holds; 0 where the layout has no such photon.
    pub fn shell_size(&self, k: u64) -> u64 {
        let shell = self.layout.shell(&k.into());
        shell.and_then(|shell| shell.count.to_u64()).unwrap_or(0)
    }

    /// Photons a chunk, the last one perhaps fewer.
    pub fn chunk_size(&self) -> u64 {
        let photons = self.question.last - self.question.first + 1;
        photons.div_ceil(MOST_CHUNKS).max(CHUNK)
    }

    /// The number of chunks.
    pub fn chunks(&self) -> u64 {
        (self.question.last - self.question.first + 1).div_ceil(self.chunk_size())
    }

    /// Asks the photons of one chunk.
    ///
    /// # Errors
    /// `NoChunk`, and `Doubles` where a shell is out of reach.
    pub fn ask(&self, chunk: u64) -> Result<Summary, Error> {
        if chunk >= self.chunks() {
            return Err(Error::NoChunk(chunk));
        }
        let first = self.question.first + chunk * self.chunk_size();
        let last = self.question.last.min(first + (self.chunk_size() - 1));
        let mut summary = Summary {
            links: vec![Tally::default(); self.links.len()],
            ..Summary::default()
        };
        let mut doubles = Doubles::new(&self.layout, first, last)?;
        if let Some(stretches) = self.question.sample {
            doubles = doubles.sampled(stretches);
        }
        while let Some(block) = doubles.next_block()? {
            self.ask_block(&block, &mut summary);
        }
        Ok(summary)
    }

    fn ask_block(&self, block: &Block, summary: &mut Summary) {
        let mut start = 0;
        while start < block.excess.len() {
            let first = block.first + start as u64;
            let (bin, next) = summary::bin(first);
            let end = block.excess.len().min(start + (next - first) as usize);
            let photons = Photons {
                first,
                position: if block.size == 1 {
                    None
                } else {
                    Some(first - block.inner)
                },
                count: block.size,
                excess: &block.excess[start..end],
                variance: &block.variance[start..end],
                excess_bound: block.bounds.excess,
                variance_bound: block.bounds.variance,
            };
            let mut stretch = Stretch {
                photons: (end - start) as u64,
                ..Stretch::default()
            };
            Asked {
                probe: self,
                photons: &photons,
                stretch: &mut stretch,
                refined: &mut summary.refined,
            }
            .ask(&mut summary.links);
            summary.photons += stretch.photons;
            if self.question.shells {
                let shell = summary.shells.entry(block.inner + 1).or_default();
                shell.merge(&stretch);
            }
            summary.bins.entry(bin).or_default().merge(&stretch);
            start = end;
        }
    }

    /// The value of the quantity, or of a link's difference, at a photon: for a person to read.
    /// `None` where it has no finite one.
    pub fn value(&self, link: Option<usize>, k: u64) -> Option<Interval> {
        let term = match link {
            Some(index) => &self.links.get(index)?.difference,
            None => self.quantity.as_ref()?,
        };
        let shell = self.layout.shell(&Integer::from(k))?;
        match photon::value(term, &shell, DIGITS) {
            Found::Value(value) => Some(value),
            Found::Infinite | Found::Unknown => None,
        }
    }
}

/// Neighbours of one bin, being asked.
struct Asked<'a> {
    probe: &'a Probe,
    photons: &'a Photons<'a>,
    stretch: &'a mut Stretch,
    refined: &'a mut u64,
}

impl Asked<'_> {
    fn ask(&mut self, tallies: &mut [Tally]) {
        if let Some(quantity) = &self.probe.quantity {
            self.ask_quantity(quantity);
        }
        for (number, (link, tally)) in self.probe.links.iter().zip(tallies).enumerate() {
            self.ask_link(number, link, tally);
        }
    }

    fn count(&self) -> usize {
        self.photons.excess.len()
    }

    /// The term in doubles; unknown where it may have no value.
    fn column(&self, term: &Term) -> Ends {
        let mut values = term.value.value(self.photons).ends(self.count());
        for divisor in &term.divisors {
            let divisor = divisor.value(self.photons).ends(self.count());
            // The usual case: it is 0 nowhere.
            if divisor.least() > 0.0 || divisor.greatest() < 0.0 {
                continue;
            }
            for index in 0..self.count() {
                let Double { low, high } = divisor.at(index);
                if !(low > 0.0 || high < 0.0) {
                    values.forget(index);
                }
            }
        }
        for (named, numbers) in [
            (term.names_excess, self.photons.excess),
            (term.names_variance, self.photons.variance),
        ] {
            let infinite = |x: &f64| x.is_infinite();
            if !named || !numbers.iter().fold(false, |some, x| some | infinite(x)) {
                continue;
            }
            for (index, _) in numbers.iter().enumerate().filter(|(_, x)| infinite(x)) {
                values.forget(index);
            }
        }
        values
    }

    fn ask_quantity(&mut self, quantity: &Term) {
        let column = self.column(quantity);
        if column.least().is_finite() && column.greatest().is_finite() {
            let (least, greatest) = (column.where_least(), column.where_greatest());
            self.stretch
                .take_least(self.extreme(least, column.at(least)));
            self.stretch
                .take_greatest(self.extreme(greatest, column.at(greatest)));
            return;
        }
        for index in 0..self.count() {
            let mut value = column.at(index);
            if !value.is_finite() {
                *self.refined += 1;
                let shell = self.shell(index);
                match shell.map(|shell| photon::value(quantity, &shell, DIGITS)) {
                    Some(Found::Value(finer)) => value = double(&finer),
                    _ => value = Double::UNKNOWN,
                }
            }
            if !value.is_finite() {
                self.stretch.untold += 1;
                continue;
            }
            let extreme = self.extreme(index, value);
            self.stretch.take_least(extreme);
            self.stretch.take_greatest(extreme);
        }
    }

    fn ask_link(&mut self, number: usize, link: &Link, tally: &mut Tally) {
        let column = self.column(&link.difference);
        let positive = column.least() > 0.0 && column.greatest().is_finite();
        if link.wanted == Wanted::Positive && positive {
            // The usual case: it holds for all.
            let least = column.where_least();
            self.stretch
                .take_margin(number, self.extreme(least, column.at(least)));
            return;
        }
        for index in 0..self.count() {
            let mut value = column.at(index);
            let sign = |end: f64| end.partial_cmp(&0.0);
            let mut holds = link.wanted.holds(sign(value.low), sign(value.high));
            if holds.is_none() {
                *self.refined += 1;
                let shell = self.shell(index);
                match shell.map(|shell| photon::signed(&link.difference, &shell)) {
                    Some(Found::Value(finer)) => {
                        let (low, high) = (finer.low().cmp0(), finer.high().cmp0());
                        holds = link.wanted.holds(low, high);
                        value = double(&finer);
                    }
                    Some(Found::Infinite) => {
                        tally.infinite.add(self.number(index));
                        continue;
                    }
                    _ => value = Double::UNKNOWN,
                }
            }
            match holds {
                Some(true) => {}
                Some(false) => tally.violations.add(self.number(index)),
                None => tally.undecided.add(self.number(index)),
            }
            if link.wanted.has_margin() && value.is_finite() {
                self.stretch.take_margin(number, self.extreme(index, value));
            }
        }
    }

    /// k
    fn number(&self, index: usize) -> u64 {
        self.photons.first + index as u64
    }

    fn shell(&self, index: usize) -> Option<Shell> {
        self.probe.layout.shell(&Integer::from(self.number(index)))
    }

    fn extreme(&self, index: usize, value: Double) -> Extreme {
        Extreme {
            k: self.number(index),
            low: value.low,
            high: value.high,
        }
    }
}

/// Rounded outwards.
fn double(value: &Interval) -> Double {
    Double {
        low: value.low().to_f64_round(Round::Down),
        high: value.high().to_f64_round(Round::Up),
    }
}

fn syntax(option: &'static str, text: &str, diagnostic: Diagnostic) -> Error {
    Error::Syntax {
        option,
        text: text.to_owned(),
        diagnostic,
    }
}

fn layout(text: &str) -> Result<Layout, Error> {
    match text {
        "triangular" => Ok(Layout::Triangular),
        "listing" => Ok(Layout::Listing),
        "one" => Ok(Layout::One),
        shells => {
            let counts = shells
                .split(',')
                .map(|count| count.trim().parse().ok().filter(|&n: &u64| n > 0));
            let counts: Option<Vec<u64>> = counts.collect();
            counts
                .map(Layout::Sequence)
                .ok_or_else(|| Error::Layout(text.to_owned()))
        }
    }
}

/// How many shells hold the photons `first..=last`.
fn shells_between(layout: &Layout, first: u64, last: u64) -> u64 {
    match layout {
        Layout::Triangular | Layout::Listing => {
            let count = |k: u64| {
                layout
                    .shell(&k.into())
                    .and_then(|shell| shell.count.to_u64())
            };
            count(last).unwrap_or(u64::MAX) - count(first).unwrap_or(0) + 1
        }
        Layout::Sequence(counts) => counts.len() as u64,
        Layout::One | Layout::Unstratified(_) => 1,
    }
}

fn links_of(statement: Statement) -> Result<Vec<Link>, Error> {
    match statement {
        Statement::Chain {
            first,
            links,
            regime: None,
        } if !links.is_empty() => {
            let lefts = iter::once(&first).chain(links.iter().map(|(_, right)| right));
            let pairs = lefts.zip(&links);
            pairs
                .map(|(left, (relation, right))| link(left, *relation, right))
                .collect()
        }
        Statement::All(parts) => {
            let parts: Result<Vec<_>, _> = parts.into_iter().map(links_of).collect();
            Ok(parts?.into_iter().flatten().collect())
        }
        _ => Err(Error::NoChain),
    }
}

fn link(left: &Formula, relation: Relation, right: &Formula) -> Result<Link, Error> {
    let (wanted, larger, smaller) = match relation {
        Relation::Less => (Wanted::Positive, right, left),
        Relation::LessEqual => (Wanted::NotNegative, right, left),
        Relation::Greater => (Wanted::Positive, left, right),
        Relation::GreaterEqual => (Wanted::NotNegative, left, right),
        Relation::Equal => (Wanted::Zero, right, left),
        Relation::NotEqual => (Wanted::NotZero, right, left),
        _ => return Err(Error::NoChain),
    };
    let difference = Formula::binary(Operator::Subtract, larger.clone(), smaller.clone());
    Ok(Link {
        text: format!("{left} {relation} {right}"),
        difference: Term::new(&difference)?,
        wanted,
    })
}
