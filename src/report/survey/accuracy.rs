//! Time, and instructions, against proved digits.

use super::super::chart::{Axis, Chart, Marks, Panel, Scale, Series};
use super::super::figures::Pace;
use super::maps::quantity_words;
use super::{Error, Sheet, SheetError, Survey, Surveys};
use crate::measure::accuracy::{Call, Question, Way, proved_digits};
use crate::measure::instructions::count;
use crate::number::Interval;
use crate::special::shell::{Quantity, ShellError};
use std::fmt::Write;
use std::path::PathBuf;
use std::str::FromStr;

/// Photons of strategy 2.
const PHOTONS: [u64; 6] = [4, 100, 5050, 1_000_000, 100_000_000, 1_000_000_000_000];
const QUICK_PHOTONS: [u64; 3] = [4, 5050, 1_000_000_000_000];

/// Digits asked for.
const DIGITS: [u32; 8] = [15, 30, 50, 100, 300, 1000, 3000, 10_000];
const QUICK_DIGITS: [u32; 4] = [15, 50, 300, 1000];

/// No call that is expected to take more instructions is timed: about a second.
const MOST: f64 = 4e9;
const QUICK_MOST: f64 = 1e7;
/// Nor are more counted.
const MOST_COUNTED: f64 = 3e8;
const QUICK_COUNTED: f64 = 1e6;

/// Calls are timed in so many rounds, all ways in turn.
const ROUNDS: u32 = 7;
const QUICK_ROUNDS: u32 = 3;

/// Figures of other programs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rivals {
    /// Of the machine that they were measured on, and so on.
    notes: Vec<String>,
    rows: Vec<Rival>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Rival {
    tool: String,
    quantity: String,
    k: String,
    asked: String,
    right: String,
    seconds: String,
}

/// No file of figures.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RivalsError {
    /// No table, or not of these columns.
    #[error(transparent)]
    Sheet(#[from] SheetError),
}

impl FromStr for Rivals {
    type Err = RivalsError;

    /// The CSV file that `benches/rivals/run.py --figures` writes.
    fn from_str(text: &str) -> Result<Rivals, RivalsError> {
        let sheet: Sheet = text.parse()?;
        let column = |name: &str| sheet.column(name, |cell| Some(cell.to_owned()));
        let (tool, version) = (column("tool")?, column("version")?);
        let (quantity, k) = (column("quantity")?, column("k")?);
        let numbers = ["k", "digits asked", "digits right", "seconds"];
        for name in numbers {
            sheet.numbers(name)?;
        }
        let [asked, right, seconds] = ["digits asked", "digits right", "seconds"].map(column);
        let (asked, right, seconds) = (asked?, right?, seconds?);
        let row = |i: usize| Rival {
            tool: tool_words(&tool[i], &version[i]),
            quantity: quantity[i].clone(),
            k: k[i].clone(),
            asked: asked[i].clone(),
            right: right[i].clone(),
            seconds: seconds[i].clone(),
        };
        Ok(Rivals {
            notes: sheet.notes().to_vec(),
            rows: (0..tool.len()).map(row).collect(),
        })
    }
}

/// A tool with its version, without what it stands on.
fn tool_words(tool: &str, version: &str) -> String {
    let own = version.split(" + ").next().unwrap_or_default();
    format!("{tool} {own}").trim().to_owned()
}

/// The surveys of `claimcheck chart accuracy`. `counter` is a program that [`count_calls`] runs in when it is called with
/// `chart count` and what [`Question`] the calls are of; without one no instructions are counted.
pub fn accuracy(pace: Pace, rivals: &Rivals, counter: Option<PathBuf>) -> Surveys {
    let survey = |quantity| {
        Box::new(Costs {
            quantity,
            pace,
            rivals: rivals.clone(),
            counter: counter.clone(),
        }) as Box<dyn Survey>
    };
    Surveys {
        group: "accuracy",
        heading: "What digits cost",
        pace,
        options: match rivals.rows.is_empty() {
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
    pace: Pace,
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
    "why not",
];

/// Ways that are no rivals have their names for themselves.
const RIVAL: &str = "rival: ";

impl Costs {
    fn photons(&self) -> &'static [u64] {
        match self.pace {
            Pace::Full => &PHOTONS,
            Pace::Quick => &QUICK_PHOTONS,
        }
    }

    fn digits(&self) -> &'static [u32] {
        match self.pace {
            Pace::Full => &DIGITS,
            Pace::Quick => &QUICK_DIGITS,
        }
    }

    fn most(&self) -> f64 {
        match self.pace {
            Pace::Full => MOST,
            Pace::Quick => QUICK_MOST,
        }
    }

    fn most_counted(&self) -> f64 {
        match self.pace {
            Pace::Full => MOST_COUNTED,
            Pace::Quick => QUICK_COUNTED,
        }
    }

    fn rounds(&self) -> u32 {
        match self.pace {
            Pace::Full => ROUNDS,
            Pace::Quick => QUICK_ROUNDS,
        }
    }

    fn question(&self, unit: usize) -> Question {
        let digits = self.digits();
        Question {
            quantity: self.quantity,
            k: self.photons()[unit / digits.len() % self.photons().len()],
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

    /// The rows of rivals at one question.
    fn rivals(&self, question: Question) -> impl Iterator<Item = Vec<String>> {
        let (k, digits) = (question.k.to_string(), question.digits.to_string());
        let own = move |rival: &&Rival| {
            rival.quantity == self.word() && rival.k == k && rival.asked == digits
        };
        self.rivals.rows.iter().filter(own).map(|rival| {
            let name = format!("{RIVAL}{}", rival.tool);
            let (right, seconds) = (rival.right.clone(), rival.seconds.clone());
            let (k, asked) = (rival.k.clone(), rival.asked.clone());
            vec![k, asked, name, right, seconds]
        })
    }
}

/// The least seconds of each call; infinite where it was not made.
fn timed(calls: &[&Call], rounds: u32) -> Vec<f64> {
    let mut best = vec![f64::INFINITY; calls.len()];
    for _ in 0..rounds {
        for (best, call) in best.iter_mut().zip(calls) {
            *best = best.min(call.seconds());
        }
    }
    best
}

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
        format!("What digits of {what} cost, one photon of strategy 2")
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = vec![
            "Each mark is one method asked for 15 to 10,000 digits; across, the digits that its interval proves. Pareto front: the least that so many digits \
             or more cost. Rings: what the program chooses by itself. One call on one core, best of several rounds; instructions are counted by callgrind."
                .to_owned(),
        ];
        if !self.rivals.rows.is_empty() {
            notes.push(
                "Marks without a line: other programs, at the digits that were right. FLINT proves them, the others do not."
                    .to_owned(),
            );
            notes.extend(
                self.rivals
                    .notes
                    .iter()
                    .map(|note| format!("Other programs: {note}")),
            );
        }
        notes
    }

    fn columns(&self) -> Vec<String> {
        COLUMNS.map(str::to_owned).to_vec()
    }

    fn units(&self) -> usize {
        self.photons().len() * self.digits().len()
    }

    fn side_by_side(&self) -> bool {
        false
    }

    fn measure(&self, unit: usize) -> Result<Vec<Vec<String>>, Error> {
        let question = self.question(unit);
        let calls = question.calls();
        let answers: Vec<_> = calls.iter().map(|call| self.answered(call)).collect();
        agree(question, &answers)?;
        let made: Vec<&Call> = calls
            .iter()
            .zip(&answers)
            .filter_map(|(call, answer)| answer.is_ok().then_some(call))
            .collect();
        let mut seconds = timed(&made, self.rounds()).into_iter();
        let mut counts = self.counted(question, &calls).into_iter();
        let mut rows = vec![];
        for (call, answer) in calls.iter().zip(&answers) {
            let instructions = counts.next().flatten();
            let digits = answer.as_ref().ok().and_then(proved_digits);
            let cells = match (answer, digits) {
                (Ok(_), Some(digits)) => {
                    let seconds = seconds.next().unwrap_or(f64::NAN);
                    let count = instructions.map_or(String::new(), |count| count.to_string());
                    [
                        digits.to_string(),
                        format!("{seconds:.3e}"),
                        count,
                        String::new(),
                    ]
                }
                (Ok(_), None) => {
                    seconds.next();
                    ["", "", "", "no digits"].map(str::to_owned)
                }
                (Err(why), _) => ["", "", "", why].map(str::to_owned),
            };
            let place = [question.k.to_string(), question.digits.to_string()];
            let way = [call.way.to_string()];
            rows.push(place.into_iter().chain(way).chain(cells).collect());
        }
        rows.extend(self.rivals(question));
        Ok(rows)
    }

    fn picture(&self, sheet: &Sheet) -> Result<Chart, SheetError> {
        let points = Points::read(sheet)?;
        let counted = points.all.iter().any(|point| point.instructions.is_some());
        let measures: &[Measure] = match counted {
            true => &[Measure::Seconds, Measure::Instructions],
            false => &[Measure::Seconds],
        };
        let panels = self
            .photons()
            .iter()
            .flat_map(|&k| measures.iter().map(move |&measure| (k, measure)));
        Ok(Chart {
            columns: 2,
            panels: panels
                .map(|(k, measure)| points.panel(k, measure))
                .collect(),
            ..Chart::default()
        })
    }

    fn words(&self, sheet: &Sheet) -> Result<String, SheetError> {
        let points = Points::read(sheet)?;
        let mut text = "What the choice costs more than the fastest way in hindsight that proves the digits asked for is the price of choosing beforehand, by \
             estimates alone.\n\n\
             | k | digits asked | fastest | its time | the choice's time | ratio | ratio of instructions |\n|---|---|---|---|---|---|---|\n"
            .to_owned();
        let (mut ratios, mut counts) = (vec![], vec![]);
        for (k, asked) in points.questions() {
            let fastest = points.fastest(k, asked);
            let choice = points.of(k, asked, &Way::Choice.to_string());
            if let (Some(fastest), Some(choice)) = (fastest, choice) {
                let ratio = choice.seconds / fastest.seconds;
                ratios.push(ratio);
                let times = [fastest, choice].map(|point| time(point.seconds));
                let counted = points.ratio_of_instructions(k, asked);
                let counted_words = counted.map_or(String::new(), |ratio| format!("{ratio:.2}"));
                counts.extend(counted);
                let _ = writeln!(
                    text,
                    "| {} | {asked} | {} | {} | {ratio:.2} | {counted_words} |",
                    short(k),
                    fastest.way,
                    times.join(" | ")
                );
            }
        }
        text.push('\n');
        text += &summary("time", ratios);
        text += &summary("instructions", counts);
        text += &points.against_rivals();
        Ok(text)
    }
}

impl Costs {
    fn answered(&self, call: &Call) -> Result<Interval, &'static str> {
        match call.estimate() {
            cost if cost.is_infinite() => Err("outside its domain"),
            cost if cost > self.most() => Err("too long"),
            _ => call.answer().map_err(|error| match error {
                ShellError::Lost => "no digits",
                _ => "outside its domain",
            }),
        }
    }

    /// Instructions of each call.
    fn counted(&self, question: Question, calls: &[Call]) -> Vec<Option<u64>> {
        let most = self.most_counted();
        let wanted = |call: &&Call| call.estimate() <= most;
        let Some(program) = &self.counter else {
            return vec![];
        };
        let arguments = [
            "chart".to_owned(),
            "count".to_owned(),
            self.word().to_owned(),
            question.k.to_string(),
            question.digits.to_string(),
            most.to_string(),
        ];
        let counts = count(program, &arguments, calls.iter().filter(wanted).count());
        let mut counts = counts.unwrap_or_default().into_iter();
        let of = |call| wanted(&call).then(|| counts.next()).flatten();
        calls.iter().map(of).collect()
    }
}

/// All intervals of a question overlap, or one of them is wrong.
fn agree(question: Question, answers: &[Result<Interval, &str>]) -> Result<(), Error> {
    let mut known: Option<Interval> = None;
    for answer in answers.iter().flatten() {
        known = match known {
            None => Some(answer.clone()),
            Some(known) => Some(
                known
                    .intersection(answer)
                    .ok_or_else(|| Error::Contradiction(format!("methods at {question:?}")))?,
            ),
        };
    }
    Ok(())
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Measure {
    Seconds,
    Instructions,
}

/// A row with numbers.
struct Point {
    k: u64,
    asked: u32,
    way: String,
    digits: f64,
    seconds: f64,
    instructions: Option<f64>,
}

struct Points {
    all: Vec<Point>,
}

impl Points {
    fn read(sheet: &Sheet) -> Result<Points, SheetError> {
        let k = sheet.column("k", |cell| cell.parse().ok())?;
        let asked = sheet.column("digits asked", |cell| cell.parse().ok())?;
        let way = sheet.column("way", |cell| Some(cell.to_owned()))?;
        let digits = sheet.some_numbers("digits")?;
        let seconds = sheet.some_numbers("seconds")?;
        let instructions = sheet.some_numbers("instructions")?;
        let point = |i: usize| {
            Some(Point {
                k: k[i],
                asked: asked[i],
                way: way[i].clone(),
                digits: digits[i]?,
                seconds: seconds[i]?,
                instructions: instructions[i],
            })
        };
        let all = (0..k.len()).filter_map(point).collect();
        Ok(Points { all })
    }

    fn questions(&self) -> Vec<(u64, u32)> {
        let mut all: Vec<_> = self
            .all
            .iter()
            .map(|point| (point.k, point.asked))
            .collect();
        all.dedup();
        all
    }

    fn of(&self, k: u64, asked: u32, way: &str) -> Option<&Point> {
        let mut own = self.all.iter();
        own.find(|point| point.k == k && point.asked == asked && point.way == way)
    }

    /// The methods that the choice is among, where they prove the digits asked for.
    fn methods(&self, k: u64, asked: u32) -> impl Iterator<Item = &Point> {
        let is_method = |point: &&Point| matches!(point.way.parse(), Ok(Way::Method(_)));
        let proves = move |point: &&Point| point.k == k && point.digits >= f64::from(asked);
        self.all.iter().filter(proves).filter(is_method)
    }

    fn fastest(&self, k: u64, asked: u32) -> Option<&Point> {
        self.methods(k, asked)
            .min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }

    /// The instructions of the choice over the fewest that a method takes.
    fn ratio_of_instructions(&self, k: u64, asked: u32) -> Option<f64> {
        let choice = self.of(k, asked, &Way::Choice.to_string())?.instructions?;
        let counts = self
            .methods(k, asked)
            .filter_map(|point| point.instructions);
        let least = counts.min_by(f64::total_cmp)?;
        Some(choice / least)
    }

    /// A table of what other programs take, as multiples of the choice's time; empty without any.
    fn against_rivals(&self) -> String {
        let rivals = self.rivals();
        if rivals.is_empty() {
            return String::new();
        }
        let mut text = format!(
            "\nOther programs: how many times as long as the choice they take, and how many digits are right.\n\n| k | digits asked | {} |\n|---|---|{}\n",
            rivals.join(" | "),
            "---|".repeat(rivals.len())
        );
        for (k, asked) in self.questions() {
            let choice = self.of(k, asked, &Way::Choice.to_string());
            let seconds = choice.map_or(f64::NAN, |point| point.seconds);
            let cells = rivals.iter().map(|name| {
                let found = self.of(k, asked, &format!("{RIVAL}{name}"));
                found.map_or(String::new(), |point| {
                    format!("{} ({})", multiple(point.seconds / seconds), point.digits)
                })
            });
            let cells: Vec<String> = cells.collect();
            let _ = writeln!(text, "| {} | {asked} | {} |", short(k), cells.join(" | "));
        }
        text
    }

    fn panel(&self, k: u64, measure: Measure) -> Panel {
        let (label, what) = match measure {
            Measure::Seconds => ("seconds a call", "time"),
            Measure::Instructions => ("instructions a call", "instructions"),
        };
        let axis = |label: &str| Axis {
            label: label.to_owned(),
            scale: Scale::Log,
        };
        let series = |name: &str, look, marks| Series {
            name: name.to_owned(),
            marks,
            look,
        };
        let mut all = vec![series(
            "Pareto front",
            0,
            Marks::Front(self.front(k, measure)),
        )];
        for (look, way) in Way::all().enumerate() {
            let points = self.curve(k, &way.to_string(), measure);
            // In every panel, so that all have the same order.
            if way != Way::Choice {
                all.push(series(&way.to_string(), look, Marks::Chain(points)));
            }
        }
        let choice = self.curve(k, &Way::Choice.to_string(), measure);
        all.push(series("the choice", 0, Marks::Rings(choice)));
        for (index, name) in self.rivals().into_iter().enumerate() {
            let points = self.curve(k, &format!("{RIVAL}{name}"), measure);
            all.push(series(&name, RIVALS_LOOK + index, Marks::Dots(points)));
        }
        Panel {
            title: format!("photon {}: {what}", short(k)),
            x: axis("digits proved (other programs: right)"),
            y: axis(label),
            series: all,
        }
    }

    /// The names of the rivals.
    fn rivals(&self) -> Vec<String> {
        let names = self
            .all
            .iter()
            .filter_map(|point| point.way.strip_prefix(RIVAL));
        let mut unlike: Vec<String> = vec![];
        for name in names {
            if unlike.iter().all(|other| other != name) {
                unlike.push(name.to_owned());
            }
        }
        unlike
    }

    fn curve(&self, k: u64, way: &str, measure: Measure) -> Vec<[f64; 2]> {
        let own = self
            .all
            .iter()
            .filter(|point| point.k == k && point.way == way);
        own.filter_map(|point| Some([point.digits, point.cost(measure)?]))
            .collect()
    }

    /// The least cost of so many digits or more, over the ways of this program. Between the digits that a way was measured at its cost
    /// is taken from the straight line between neighbours, both axes logarithmic.
    fn front(&self, k: u64, measure: Measure) -> Vec<[f64; 2]> {
        let ways = Way::all().filter(|way| *way != Way::Choice);
        let curves: Vec<_> = ways
            .map(|way| self.curve(k, &way.to_string(), measure))
            .collect();
        let mut digits: Vec<f64> = curves.iter().flatten().map(|[x, _]| *x).collect();
        digits.sort_by(f64::total_cmp);
        let mut least = f64::INFINITY;
        let mut front: Vec<[f64; 2]> = vec![];
        for x in digits.into_iter().rev() {
            let here = curves.iter().filter_map(|curve| between(curve, x));
            least = here.fold(least, f64::min);
            front.push([x, least]);
        }
        front.reverse();
        front
    }
}

/// The value at x of the curve through these points, straight on logarithmic axes. Little beyond its right end it has the value
/// there, since ways that are asked for the same digits end at slightly different ones; else `None` beyond its ends.
fn between(curve: &[[f64; 2]], x: f64) -> Option<f64> {
    if let Some([_, y]) = curve.iter().find(|[at, _]| *at == x) {
        return Some(*y);
    }
    if let Some([end, y]) = curve.last()
        && (*end..1.05 * end).contains(&x)
    {
        return Some(*y);
    }
    let right = curve.iter().position(|[at, _]| *at > x)?;
    let [[x0, y0], [x1, y1]] = [curve.get(right.checked_sub(1)?)?, &curve[right]];
    let part = (x / x0).ln() / (x1 / x0).ln();
    Some(y0 * (y1 / y0).powf(part))
}

/// Looks from here on are the rivals'.
const RIVALS_LOOK: usize = 13;

impl Point {
    fn cost(&self, measure: Measure) -> Option<f64> {
        match measure {
            Measure::Seconds => Some(self.seconds),
            Measure::Instructions => self.instructions,
        }
    }
}

/// What the choice takes over the least, in the median and at worst; nothing of nothing.
fn summary(of: &str, mut ratios: Vec<f64>) -> String {
    ratios.sort_by(f64::total_cmp);
    match (ratios.get(ratios.len() / 2), ratios.last()) {
        (Some(middle), Some(worst)) => format!(
            "In {of} the choice takes {middle:.2} times the least of all methods in hindsight in the median, {worst:.2} times at worst.\n"
        ),
        _ => String::new(),
    }
}

/// Powers of ten from a million on as such.
fn short(k: u64) -> String {
    match k.ilog10() {
        power if power >= 6 && k == 10u64.pow(power) => format!("10^{power}"),
        _ => k.to_string(),
    }
}

/// With two digits or so.
fn multiple(ratio: f64) -> String {
    match ratio {
        ratio if ratio < 10.0 => format!("{ratio:.1}"),
        ratio => format!("{ratio:.0}"),
    }
}

/// Seconds with a fitting unit and three digits.
fn time(seconds: f64) -> String {
    let units = [(1.0, "s"), (1e-3, "ms"), (1e-6, "\u{b5}s"), (1e-9, "ns")];
    let fitting = units.into_iter().find(|(unit, _)| seconds >= *unit);
    let (unit, name) = fitting.unwrap_or((1e-9, "ns"));
    match seconds / unit {
        value if value < 10.0 => format!("{value:.2} {name}"),
        value if value < 100.0 => format!("{value:.1} {name}"),
        value => format!("{value:.0} {name}"),
    }
}
