//! What the rows of a survey of costs come to: curves, the front, tables.

use super::super::super::chart::{Axis, Marks, Panel, Scale, Series};
use super::super::{Sheet, SheetError, median, method_words, raised};
use super::rivals::{OURS, RIVAL};
use super::{NO_DIGITS, OUTSIDE, TOO_LONG};
use crate::measure::accuracy::Way;
use std::fmt::Write;

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Measure {
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
    remark: String,
}

/// The rows of a sheet that have numbers.
pub(super) struct Points {
    all: Vec<Point>,
}

impl Points {
    pub(super) fn read(sheet: &Sheet) -> Result<Points, SheetError> {
        let k = sheet.column("k", |cell| cell.parse().ok())?;
        let asked = sheet.column("digits asked", |cell| cell.parse().ok())?;
        let way = sheet.column("way", |cell| Some(cell.to_owned()))?;
        let digits = sheet.some_numbers("digits")?;
        let seconds = sheet.column("seconds", positive)?;
        let instructions = sheet.column("instructions", positive)?;
        let remark = sheet.column("remark", remark)?;
        let point = |i: usize| {
            Some(Point {
                k: k[i],
                asked: asked[i],
                way: way[i].clone(),
                digits: digits[i]?,
                seconds: seconds[i]?,
                instructions: instructions[i],
                remark: remark[i].clone(),
            })
        };
        let all = (0..k.len()).filter_map(point).collect();
        Ok(Points { all })
    }

    /// What the choice answers.
    fn questions(&self) -> Vec<(u64, u32)> {
        let choice = Way::Choice.to_string();
        let own = self.all.iter().filter(|point| point.way == choice);
        own.map(|point| (point.k, point.asked)).collect()
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

    /// A table of the choice and the fastest method, and what both tables come to.
    pub(super) fn against_hindsight(&self) -> String {
        let mut text = "| k | digits asked | the choice takes | its time | fastest | its time | ratio | ratio of instructions |\n\
                        |---|---|---|---|---|---|---|---|\n"
            .to_owned();
        let (mut ratios, mut counts) = (vec![], vec![]);
        for (k, asked) in self.questions() {
            let choice = self.of(k, asked, &Way::Choice.to_string());
            let (Some(fastest), Some(choice)) = (self.fastest(k, asked), choice) else {
                continue;
            };
            let ratio = choice.seconds / fastest.seconds;
            let counted = self.ratio_of_instructions(k, asked);
            ratios.push(ratio);
            counts.extend(counted);
            let _ = writeln!(
                text,
                "| {} | {asked} | {} | {} | {} | {} | {ratio:.2} | {} |",
                short(k),
                told(&choice.remark),
                time(choice.seconds),
                told(&fastest.way),
                time(fastest.seconds),
                counted.map_or(String::new(), |ratio| format!("{ratio:.2}")),
            );
        }
        text.push('\n');
        text += &summary("time", ratios);
        text += &summary("instructions", counts);
        text
    }

    /// A table of what other programs take, as multiples of the choice's time; empty without any.
    pub(super) fn against_rivals(&self) -> String {
        let rivals = self.rivals();
        if rivals.is_empty() {
            return String::new();
        }
        let what = match self.ours() {
            Some(_) => {
                "how many times as long as the choice they take in the same run, and in brackets how many digits are right"
            }
            None => {
                "what they take, and in brackets how many digits are right (no ratios: claimcheck was not in that run)"
            }
        };
        let mut text = format!(
            "\nOther programs: {what}.\n\n| k | digits asked | {} |\n|---|---|{}\n",
            rivals.join(" | "),
            "---|".repeat(rivals.len())
        );
        for (k, asked) in self.questions() {
            let ours = self.ours().and_then(|way| self.of(k, asked, way));
            let cells = rivals.iter().map(|name| {
                let found = self.of(k, asked, &format!("{RIVAL}{name}"));
                found.map_or(String::new(), |point| {
                    let taken = match ours {
                        Some(ours) => multiple(point.seconds / ours.seconds),
                        None => time(point.seconds),
                    };
                    format!("{taken} ({})", point.digits)
                })
            });
            let cells: Vec<String> = cells.collect();
            let _ = writeln!(text, "| {} | {asked} | {} |", short(k), cells.join(" | "));
        }
        text
    }

    /// Whether there is a mark of this way for any photon.
    fn has(&self, way: Way, measure: Measure) -> bool {
        let name = way.to_string();
        let mut own = self.all.iter().filter(|point| point.way == name);
        own.any(|point| point.cost(measure).is_some())
    }

    /// Whether instructions were counted.
    pub(super) fn are_counted(&self) -> bool {
        self.all.iter().any(|point| point.instructions.is_some())
    }

    /// The ways of this program, with what is best and what is chosen.
    pub(super) fn own(&self, k: u64, measure: Measure) -> Panel {
        let mut all = vec![series(FRONT, 0, Marks::Front(self.front(k, measure)))];
        for (look, way) in Way::all().enumerate() {
            // In every panel, so that all have the same order.
            if way != Way::Choice && self.has(way, measure) {
                let points = self.curve(k, &way.to_string(), measure);
                all.push(series(way_words(way), look, Marks::Chain(points)));
            }
        }
        let choice = self.curve(k, &Way::Choice.to_string(), measure);
        all.push(series(CHOICE, 0, Marks::Rings(choice)));
        panel(
            format!("photon {}: methods of claimcheck", short(k)),
            measure,
            all,
        )
    }

    /// Other programs, and what is chosen here in the same run.
    pub(super) fn others(&self, k: u64) -> Panel {
        let ours = self.ours().unwrap_or_default();
        let choice = self.curve(k, ours, Measure::Seconds);
        let mut all = vec![series(CHOICE, 0, Marks::Rings(choice))];
        for (index, name) in self.rivals().into_iter().enumerate() {
            let points = self.curve(k, &format!("{RIVAL}{name}"), Measure::Seconds);
            all.push(series(&name, RIVALS_LOOK + index, Marks::Chain(points)));
        }
        panel(
            format!("photon {}: other programs", short(k)),
            Measure::Seconds,
            all,
        )
    }

    /// This program among the rivals.
    fn ours(&self) -> Option<&str> {
        let mut ways = self.all.iter().map(|point| &*point.way);
        ways.find(|way| way.starts_with(OURS))
    }

    /// The names of the rivals.
    pub(super) fn rivals(&self) -> Vec<String> {
        let others = self.all.iter().filter(|p| !p.way.starts_with(OURS));
        let names = others.filter_map(|point| point.way.strip_prefix(RIVAL));
        let mut unlike: Vec<String> = vec![];
        for name in names {
            if unlike.iter().all(|other| other != name) {
                unlike.push(name.to_owned());
            }
        }
        unlike
    }

    /// Without a right digit a point lies at 1, as far left as one with a single digit.
    fn curve(&self, k: u64, way: &str, measure: Measure) -> Vec<[f64; 2]> {
        let own = self
            .all
            .iter()
            .filter(|point| point.k == k && point.way == way);
        own.filter_map(|point| Some([point.digits.max(1.0), point.cost(measure)?]))
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

/// What the choice takes, or why there is no answer.
fn remark(cell: &str) -> Option<String> {
    let known = ["", OUTSIDE, TOO_LONG, NO_DIGITS].contains(&cell) || cell.parse::<Way>().is_ok();
    known.then(|| cell.to_owned())
}

/// A positive number, or none.
fn positive(cell: &str) -> Option<Option<f64>> {
    match cell {
        "" => Some(None),
        cell => {
            let number = cell.parse().ok();
            number.filter(|x: &f64| x.is_finite() && *x > 0.0).map(Some)
        }
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

fn panel(title: String, measure: Measure, series: Vec<Series>) -> Panel {
    let axis = |label: &str| Axis {
        label: label.to_owned(),
        scale: Scale::Log,
    };
    Panel {
        title,
        x: axis("digits"),
        y: axis(match measure {
            Measure::Seconds => "seconds a call",
            Measure::Instructions => "instructions a call",
        }),
        series,
    }
}

fn series(name: &str, look: usize, marks: Marks) -> Series {
    Series {
        name: name.to_owned(),
        marks,
        look,
    }
}

const FRONT: &str = "Pareto front of the methods";
const CHOICE: &str = "the choice";

/// Looks from here on are the rivals'.
const RIVALS_LOOK: usize = 13;

/// In the legend.
fn way_words(way: Way) -> &'static str {
    match way {
        Way::Choice => CHOICE,
        Way::Doubles => "certified doubles",
        Way::Method(method) => method_words(method),
    }
}

impl Point {
    fn cost(&self, measure: Measure) -> Option<f64> {
        match measure {
            Measure::Seconds => Some(self.seconds),
            Measure::Instructions => self.instructions,
        }
    }
}

/// A way by its words, where it is one.
pub(super) fn told(name: &str) -> &str {
    match name.parse() {
        Ok(way) => way_words(way),
        Err(_) => name,
    }
}

/// What the choice takes over the least in hindsight, in the median and at worst; nothing of nothing.
fn summary(of: &str, ratios: Vec<f64>) -> String {
    let worst = ratios.iter().copied().max_by(f64::total_cmp);
    match (median(ratios), worst) {
        (Some(middle), Some(worst)) => format!(
            "In {of} the choice takes, in the median, {middle:.2} times the least of the methods that it chooses from; at worst {worst:.2} times.\n"
        ),
        _ => String::new(),
    }
}

/// Powers of ten from a million on as such.
pub(super) fn short(k: u64) -> String {
    match k.checked_ilog10() {
        Some(power) if power >= 6 && k == 10u64.pow(power) => format!("10{}", raised(power)),
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
