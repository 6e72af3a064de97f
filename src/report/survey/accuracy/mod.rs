//! Time, and instructions, against proved digits.

mod points;
mod rivals;

pub use rivals::Rivals;

use super::super::chart::Chart;
use super::super::figures::Pace;
use super::maps::quantity_words;
use super::{Error, Sheet, SheetError, Survey, Surveys};
use crate::measure::accuracy::{Call, Question, proved_digits};
use crate::measure::instructions;
use crate::number::Interval;
use crate::special::shell::{Quantity, ShellError};
use points::{Measure, Points, short, told};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How much is measured.
struct Effort {
    /// Photons of strategy 2.
    photons: &'static [u64],
    /// Digits asked for.
    digits: &'static [u32],
    /// No call that is expected to take more instructions is timed, nor are more counted.
    most: f64,
    most_counted: f64,
    /// Calls are timed in so many rounds, all ways in turn.
    rounds: u32,
}

/// The slowest calls take about a second.
const FULL: Effort = Effort {
    photons: &[4, 100, 5050, 1_000_000, 100_000_000, 1_000_000_000_000],
    digits: &[15, 30, 50, 100, 300, 1000, 3000, 10_000],
    most: 4e9,
    most_counted: 3e8,
    rounds: 7,
};

const QUICK: Effort = Effort {
    photons: &[4, 5050, 1_000_000_000_000],
    digits: &[15, 100, 1000],
    most: 1e7,
    most_counted: 1e6,
    rounds: 3,
};

/// A single count takes a second or two, all counts of a question a minute or so.
const PATIENCE: Duration = Duration::from_secs(60);
const PATIENCE_WITH_ALL: Duration = Duration::from_secs(1200);

/// The surveys of `claimcheck chart accuracy`. `counter` is a program that [`count_calls`] runs in when it is called with
/// `chart count` and what [`Question`] the calls are of ([`can_count`]); without one no instructions are counted.
pub fn accuracy(pace: Pace, rivals: &Rivals, counter: Option<PathBuf>) -> Surveys {
    let survey = |quantity| {
        Box::new(Costs {
            quantity,
            effort: match pace {
                Pace::Full => &FULL,
                Pace::Quick => &QUICK,
            },
            rivals: rivals.clone(),
            counter: counter.clone(),
        }) as Box<dyn Survey>
    };
    Surveys {
        group: "accuracy",
        heading: "What digits cost",
        pace,
        options: rivals.option(),
        all: vec![survey(Quantity::Mean), survey(Quantity::Variance)],
    }
}

/// Whether a program that answers to `chart count` can be watched here: whether a small count comes to something.
pub fn can_count(program: &Path) -> bool {
    let question = Question {
        quantity: Quantity::Mean,
        k: 4,
        digits: 15,
    };
    let calls = question.calls();
    counts(program, question, &calls, 1e4, PATIENCE).is_some()
}

/// What instructions the calls of a question take that are not expected to take more than `most`.
fn counts(
    program: &Path,
    question: Question,
    calls: &[Call],
    most: f64,
    patience: Duration,
) -> Option<Vec<u64>> {
    let arguments = [
        "chart".to_owned(),
        "count".to_owned(),
        word(question.quantity).to_owned(),
        question.k.to_string(),
        question.digits.to_string(),
        most.to_string(),
    ];
    let number = calls.iter().filter(|call| call.estimate() <= most).count();
    instructions::count(program, &arguments, number, patience)
}

/// A quantity in the file of rivals, in file names, and for [`count_calls`].
fn word(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Function => "function",
        Quantity::Mean => "mean",
        Quantity::Excess => "excess",
        Quantity::Variance => "variance",
    }
}

/// Makes the calls of a question that instructions are counted of, each once: for a counter that watches.
pub fn count_calls(question: Question, most: f64) {
    for call in question.calls() {
        if call.estimate() <= most {
            call.run();
        }
    }
}

/// A number of one digit and zeros: 3 * 10^8.
fn power(number: f64) -> String {
    let exponent = number.log10().floor();
    match number / 10f64.powf(exponent) {
        1.0 => format!("10^{exponent}"),
        digit => format!("{digit:.0} * 10^{exponent}"),
    }
}

/// Whole numbers as a sentence has them: 15, 30 and 50.
fn listed(numbers: &[u32]) -> String {
    let texts: Vec<String> = numbers.iter().map(u32::to_string).collect();
    match texts.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => texts.concat(),
    }
}

/// What a quantity costs.
struct Costs {
    quantity: Quantity,
    effort: &'static Effort,
    rivals: Rivals,
    counter: Option<PathBuf>,
}

const COLUMNS: [&str; 7] = [
    "k",
    "digits asked",
    "way",
    "digits",
    "seconds",
    "instructions",
    "remark",
];

impl Costs {
    fn questions(&self) -> impl Iterator<Item = Question> {
        (0..self.units()).map(|unit| self.question(unit))
    }

    fn question(&self, unit: usize) -> Question {
        let Effort {
            photons, digits, ..
        } = self.effort;
        Question {
            quantity: self.quantity,
            k: photons[unit / digits.len() % photons.len()],
            digits: digits[unit % digits.len()],
        }
    }

    /// The interval and the digits that it proves, or why there is none.
    fn answered(&self, call: &Call) -> Answer {
        match call.estimate() {
            cost if cost.is_infinite() => return Err(OUTSIDE),
            cost if cost > self.effort.most => return Err(TOO_LONG),
            _ => {}
        }
        let value = call.answer().map_err(|error| match error {
            ShellError::Lost => NO_DIGITS,
            _ => OUTSIDE,
        })?;
        let digits = proved_digits(&value).ok_or(NO_DIGITS)?;
        Ok((value, digits))
    }

    /// The least seconds of each call that has an answer.
    fn timed(&self, calls: &[Call], answers: &[Answer]) -> Vec<f64> {
        let mut best = vec![f64::INFINITY; calls.len()];
        for _ in 0..self.effort.rounds {
            for ((best, call), answer) in best.iter_mut().zip(calls).zip(answers) {
                if answer.is_ok() {
                    *best = best.min(call.seconds());
                }
            }
        }
        best
    }

    /// Instructions of each call, where they can be counted.
    fn counted(&self, question: Question, calls: &[Call]) -> Vec<Option<u64>> {
        let most = self.effort.most_counted;
        let found = self
            .counter
            .as_ref()
            .and_then(|program| counts(program, question, calls, most, PATIENCE_WITH_ALL));
        let mut found = found.unwrap_or_default().into_iter();
        let of = |call: &Call| (call.estimate() <= most).then(|| found.next()).flatten();
        calls.iter().map(of).collect()
    }
}

/// Why there is no answer.
const OUTSIDE: &str = "outside its limits";
const TOO_LONG: &str = "too long";
const NO_DIGITS: &str = "no digits";

type Answer = Result<(Interval, f64), &'static str>;

impl Survey for Costs {
    fn name(&self) -> String {
        format!("accuracy-{}", word(self.quantity))
    }

    fn title(&self) -> String {
        let what = match self.quantity {
            Quantity::Mean => "the mean of k/U",
            Quantity::Variance => "the variance of k/U",
            other => quantity_words(other),
        };
        format!("What digits of {what} cost")
    }

    fn notes(&self, sheet: &Sheet) -> Result<Vec<String>, SheetError> {
        let points = Points::read(sheet)?;
        let counted = match points.are_counted() {
            true => format!(
                "instructions are counted by callgrind, where no more than {} are expected",
                power(self.effort.most_counted)
            ),
            false => "instructions were not counted, for want of valgrind".to_owned(),
        };
        let rivals = !points.rivals().is_empty();
        let each = match rivals {
            true => "Left: each",
            false => "Each",
        };
        let rounds = self.effort.rounds;
        let mut notes = vec![format!(
            "Photon k of strategy 2. {each} mark is one certified method asked for {} digits; across, the digits that its interval proves. \
             Pareto front: the least cost of so many digits or more by any of these methods. Rings: the method that the program chooses by itself. One call on one core, \
             best of {rounds} rounds; {counted}.",
            listed(self.effort.digits)
        )];
        if rivals {
            notes.push(self.rivals.note());
        }
        Ok(notes)
    }

    fn columns(&self) -> Vec<String> {
        COLUMNS.map(str::to_owned).to_vec()
    }

    fn units(&self) -> usize {
        self.effort.photons.len() * self.effort.digits.len()
    }

    fn places(&self, unit: usize) -> Vec<Vec<String>> {
        let question = self.question(unit);
        let (k, digits) = (question.k.to_string(), question.digits.to_string());
        let place = |call: &Call| vec![k.clone(), digits.clone(), call.way.to_string()];
        question.calls().iter().map(place).collect()
    }

    fn beside(&self) -> Vec<Vec<String>> {
        let rows = |question| self.rivals.rows(question, word(self.quantity));
        self.questions().flat_map(rows).collect()
    }

    fn side_by_side(&self) -> bool {
        false
    }

    fn measure(&self, unit: usize) -> Result<Vec<Vec<String>>, Error> {
        let question = self.question(unit);
        let calls = question.calls();
        let answers: Vec<Answer> = calls.iter().map(|call| self.answered(call)).collect();
        agree(question, &answers)?;
        let seconds = self.timed(&calls, &answers);
        let counts = self.counted(question, &calls);
        let rows = calls.iter().zip(&answers).zip(seconds).zip(counts);
        let cells =
            rows.map(|(((call, answer), seconds), count)| cells(call, answer, seconds, count));
        Ok(cells.collect())
    }

    fn pictures(&self, sheet: &Sheet) -> Result<Vec<(&'static str, Chart)>, SheetError> {
        let points = Points::read(sheet)?;
        let photons = self.effort.photons.iter();
        let rivals = !points.rivals().is_empty();
        let own = |&k: &u64| points.own(k, Measure::Seconds);
        let beside = |&k: &u64| rivals.then(|| points.others(k));
        let time = photons
            .clone()
            .flat_map(|k| [Some(own(k)), beside(k)])
            .flatten();
        let chart = |title: &str, panels| Chart {
            title: title.to_owned(),
            columns: 2,
            panels,
            ..Chart::default()
        };
        let mut pictures = vec![("", chart(": time", time.collect()))];
        if points.are_counted() {
            let own = |&k: &u64| points.own(k, Measure::Instructions);
            let panels = photons.map(own).collect();
            pictures.push(("-instructions", chart(": instructions", panels)));
        }
        Ok(pictures)
    }

    fn words(&self, sheet: &Sheet) -> Result<String, SheetError> {
        let points = Points::read(sheet)?;
        let mut text = "What the choice costs more than the fastest method in hindsight that proves the digits asked for is the price of choosing beforehand, by \
             estimates alone. Where both are the same method the ratio is the cost of choosing and, of times, the noise of the clock; instructions do not depend on the load. \
             All methods compute in intervals with as many bits as the digits want: so even the thesis's formula proves digits here, which has none in \
             doubles for large k. The certified \
             doubles, which give the digits that they have, are not among the methods it chooses from; in the smallest shells they are rounded intervals, and slow.\n\n"
            .to_owned();
        text += &points.against_hindsight();
        text += &points.against_rivals();
        text += &self.unanswered(sheet)?;
        Ok(text)
    }
}

impl Costs {
    /// Which methods have no answer, and from how many digits on.
    fn unanswered(&self, sheet: &Sheet) -> Result<String, SheetError> {
        let cells = |name: &str| sheet.column(name, |cell| Some(cell.to_owned()));
        let (k, asked, way) = (cells("k")?, cells("digits asked")?, cells("way")?);
        let (digits, remark) = (cells("digits")?, cells("remark")?);
        let mut text = format!(
            "\nNot in the pictures, from so many digits on (too long: over {} instructions by estimate, our limit; outside its limits: of its domain, \
             or of the terms and nodes that the method allows itself):\n\n",
            power(self.effort.most)
        );
        for photon in self.effort.photons {
            let missing = |i: &usize| k[*i] == photon.to_string() && digits[*i].is_empty();
            let mut first: Vec<usize> = vec![];
            for i in (0..k.len()).filter(missing) {
                if first.iter().all(|other| way[*other] != way[i]) {
                    first.push(i);
                }
            }
            let words = |i: &usize| format!("{} ({}: {})", told(&way[*i]), asked[*i], remark[*i]);
            let words: Vec<String> = first.iter().map(words).collect();
            if !words.is_empty() {
                text += &format!("- photon {}: {}\n", short(*photon), words.join(", "));
            }
        }
        Ok(text)
    }
}

fn cells(call: &Call, answer: &Answer, seconds: f64, count: Option<u64>) -> Vec<String> {
    let cells = match answer {
        Ok((_, proved)) => [
            proved.to_string(),
            format!("{seconds:.3e}"),
            count.map_or(String::new(), |count| count.to_string()),
            call.chosen().map_or(String::new(), |way| way.to_string()),
        ],
        Err(why) => ["", "", "", why].map(str::to_owned),
    };
    cells.to_vec()
}

/// All intervals of a question overlap, or one of them is wrong.
fn agree(question: Question, answers: &[Answer]) -> Result<(), Error> {
    let mut known: Option<Interval> = None;
    for (value, _) in answers.iter().flatten() {
        let both = known.map_or(Some(value.clone()), |known| known.intersection(value));
        let both = both.ok_or_else(|| Error::Contradiction(format!("methods at {question:?}")))?;
        known = Some(both);
    }
    Ok(())
}

#[cfg(test)]
mod tests;
