//! Time, and instructions, against proved digits.

mod points;
mod rivals;

pub use rivals::Rivals;

use super::super::chart::Chart;
use super::super::figures::Pace;
use super::maps::quantity_words;
use super::{Error, Sheet, SheetError, Survey, Surveys};
use crate::measure::accuracy::{Call, Question, proved_digits};
use crate::measure::instructions::count;
use crate::number::Interval;
use crate::special::shell::{Quantity, ShellError};
use points::{Measure, Points, short, told};
use std::path::PathBuf;

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

/// The surveys of `claimcheck chart accuracy`. `counter` is a program that [`count_calls`] runs in when it is called with
/// `chart count` and what [`Question`] the calls are of; without one no instructions are counted.
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
        options: match rivals.is_empty() {
            true => String::new(),
            false => " --rivals figures.csv".to_owned(),
        },
        all: vec![survey(Quantity::Mean), survey(Quantity::Variance)],
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

    /// The word of the quantity in the file of rivals and in file names.
    fn word(&self) -> &'static str {
        match self.quantity {
            Quantity::Function => "function",
            Quantity::Mean => "mean",
            Quantity::Excess => "excess",
            Quantity::Variance => "variance",
        }
    }

    /// The interval and the digits that it proves, or why there is none.
    fn answered(&self, call: &Call) -> Answer {
        match call.estimate() {
            cost if cost.is_infinite() => return Err("outside its domain"),
            cost if cost > self.effort.most => return Err("too long"),
            _ => {}
        }
        let value = call.answer().map_err(|error| match error {
            ShellError::Lost => "no digits",
            _ => "outside its domain",
        })?;
        let digits = proved_digits(&value).ok_or("no digits")?;
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
        let wanted = |call: &&Call| call.estimate() <= most;
        let arguments = [
            "chart".to_owned(),
            "count".to_owned(),
            self.word().to_owned(),
            question.k.to_string(),
            question.digits.to_string(),
            most.to_string(),
        ];
        let number = calls.iter().filter(wanted).count();
        let counts = self.counter.as_ref();
        let counts = counts.and_then(|program| count(program, &arguments, number));
        let mut counts = counts.unwrap_or_default().into_iter();
        let of = |call| wanted(&call).then(|| counts.next()).flatten();
        calls.iter().map(of).collect()
    }
}

type Answer = Result<(Interval, f64), &'static str>;

impl Survey for Costs {
    fn name(&self) -> String {
        format!("accuracy-{}", self.word())
    }

    fn title(&self) -> String {
        let what = match self.quantity {
            Quantity::Mean => "the mean of k/U",
            Quantity::Variance => "the variance of k/U",
            other => quantity_words(other),
        };
        format!("What digits of {what} cost")
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = vec![
            "Photon k of strategy 2. Left: each mark is one certified method asked for 15, 30, 50, 100, 300, ... digits; across, the digits that its interval proves. \
             Pareto front: the least cost of so many digits or more by any of these methods. Rings: the method that the program chooses by itself. One call on one core, \
             best of several rounds; instructions are counted by callgrind."
                .to_owned(),
        ];
        notes.extend(self.rivals.notes());
        notes
    }

    fn columns(&self) -> Vec<String> {
        COLUMNS.map(str::to_owned).to_vec()
    }

    fn units(&self) -> usize {
        self.effort.photons.len() * self.effort.digits.len()
    }

    fn is_whole(&self, sheet: &Sheet) -> bool {
        let chosen = sheet.column("way", |cell| Some(cell == "choice"));
        chosen.is_ok_and(|chosen| chosen.iter().filter(|is| **is).count() == self.units())
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
        let rows = rows.map(|(((call, answer), seconds), count)| row(call, answer, seconds, count));
        Ok(rows
            .chain(self.rivals.rows(question, self.word()))
            .collect())
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
             estimates alone. (The certified doubles, which give the digits that they have, are not among the methods it chooses from.)\n\n"
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
        let mut text = "\nNot in the pictures, from so many digits on:\n\n".to_owned();
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

fn row(call: &Call, answer: &Answer, seconds: f64, count: Option<u64>) -> Vec<String> {
    let Question { k, digits, .. } = call.question;
    let place = [k.to_string(), digits.to_string(), call.way.to_string()];
    let cells = match answer {
        Ok((_, proved)) => [
            proved.to_string(),
            format!("{seconds:.3e}"),
            count.map_or(String::new(), |count| count.to_string()),
            call.chosen().map_or(String::new(), |way| way.to_string()),
        ],
        Err(why) => ["", "", "", why].map(str::to_owned),
    };
    place.into_iter().chain(cells).collect()
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
