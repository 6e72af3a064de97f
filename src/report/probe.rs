//! What a probe found, for people, as JSON and CSV, and as a picture.

use super::chart::{Axis, Chart, Marks, Panel, Scale, Series};
use super::style::{FAINT, STRONG, WIDTH, paint, wrap};
use crate::number::Interval;
use crate::probe::{Extreme, Named, Probe, Question, Stretch, Summary, Tally, bin};
use rug::Float;
use serde_json::json;
use std::fmt::Write;

/// Digits of a margin that are printed.
const DIGITS: usize = 6;

/// Of a quantity: many differ little from 1.
const MORE_DIGITS: usize = 12;

/// What is told of each stretch: a heading, and how to find it.
struct Told {
    heading: String,
    of: Which,
}

#[derive(Clone, Copy)]
enum Which {
    Least,
    Greatest,
    /// Of a link, by its place in the claim.
    Margin(usize),
}

impl Which {
    fn of(self, stretch: &Stretch) -> Option<Extreme> {
        match self {
            Which::Least => stretch.least,
            Which::Greatest => stretch.greatest,
            Which::Margin(link) => stretch.margins.get(link).copied().flatten(),
        }
    }
}

fn told(probe: &Probe) -> Vec<Told> {
    let mut all = vec![];
    if let Some(quantity) = &probe.question().quantity {
        all.push(Told {
            heading: format!("least {quantity}"),
            of: Which::Least,
        });
        all.push(Told {
            heading: format!("greatest {quantity}"),
            of: Which::Greatest,
        });
    }
    for (index, link) in probe.links().enumerate() {
        all.push(Told {
            heading: format!("least margin of {link}"),
            of: Which::Margin(index),
        });
    }
    all
}

/// The digits that both ends share, so many at most.
fn decimal(extreme: &Extreme, digits: usize) -> String {
    let end = |x: f64| Float::with_val(53, x);
    Interval::from_ends(end(extreme.low), end(extreme.high)).to_decimal(digits)
}

/// A report for people.
pub fn human(probe: &Probe, summary: &Summary) -> String {
    let question = probe.question();
    let decades = summary.decades();
    let mut text = format!(
        "layout {}, k = {}..{}: {} of {} photons asked; {} values needed more than doubles\n",
        question.layout,
        question.first,
        question.last,
        summary.photons,
        question.last - question.first + 1,
        summary.refined
    );
    if let Some(stretches) = question.sample {
        let _ = writeln!(
            text,
            "of each shell {stretches} stretches of 8 neighbours, the first and the last photon among them"
        );
    }
    let untold: u64 = decades.values().map(|decade| decade.untold).sum();
    if untold > 0 {
        let _ = writeln!(text, "left out: {}", photons_without(untold));
    }
    if !summary.links.is_empty() {
        text.push('\n');
    }
    for (index, (link, tally)) in probe.links().zip(&summary.links).enumerate() {
        for line in wrap(&format!("{link}: {}", verdict(tally)), WIDTH) {
            let _ = writeln!(text, "{}", paint(STRONG, &line));
        }
        for &k in &tally.violations.first {
            let value = probe.value(Some(index), k);
            let margin = value.map_or("unknown".to_owned(), |value| value.to_decimal(DIGITS));
            let _ = writeln!(text, "  k = {k}: the sides differ by {margin}");
        }
    }
    for Told { heading, of } in told(probe) {
        let known: Vec<(u32, Extreme)> = decades
            .iter()
            .filter_map(|(power, decade)| Some((*power, of.of(decade)?)))
            .collect();
        if known.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{}", paint(STRONG, &heading));
        for (power, extreme) in known {
            let from = 10u64.pow(power).max(question.first);
            let to = (10u64.pow(power + 1) - 1).min(question.last);
            let range = format!("k = {from}..{to}");
            let digits = match of {
                Which::Margin(_) => DIGITS,
                Which::Least | Which::Greatest => MORE_DIGITS,
            };
            let place = paint(FAINT, &format!("near k = {}", extreme.k));
            let _ = writeln!(
                text,
                "  {range:<36} {:<24} {place}",
                decimal(&extreme, digits)
            );
        }
    }
    text
}

fn verdict(tally: &Tally) -> String {
    if tally.holds() {
        return "holds for every k asked".to_owned();
    }
    let parts = [
        ("fails at", &tally.violations),
        ("undecided or without a value at", &tally.undecided),
        ("E_k or Var_k infinite at", &tally.infinite),
    ];
    let some = parts.into_iter().filter(|(_, named)| named.count > 0);
    let told: Vec<String> = some
        .map(|(words, named)| format!("{words} {}", places(named)))
        .collect();
    told.join("; ")
}

fn photons_without(count: u64) -> String {
    let noun = if count == 1 { "photon" } else { "photons" };
    format!(
        "{count} {noun} where the quantity has no value, none that is known, or none a double can hold"
    )
}

/// `3 photons: k = 5, 6, 9`
fn places(named: &Named) -> String {
    let first: Vec<String> = named.first.iter().map(u64::to_string).collect();
    let more = if named.count > named.first.len() as u64 {
        ", ..."
    } else {
        ""
    };
    let noun = if named.count == 1 {
        "photon"
    } else {
        "photons"
    };
    format!("{} {noun}: k = {}{more}", named.count, first.join(", "))
}

/// The same for programs.
pub fn json(probe: &Probe, summary: &Summary) -> String {
    let links: Vec<&str> = probe.links().collect();
    let value = json!({
        "question": probe.question(),
        "links": links,
        "found": summary,
        "decades": summary.decades(),
    });
    format!("{value:#}\n")
}

/// One line a decade: its least k and number of photons, and for each thing told the enclosure and its place.
pub fn csv(probe: &Probe, summary: &Summary) -> String {
    let decades = summary.decades();
    let rows = decades
        .iter()
        .map(|(power, stretch)| (format!("1e{power}"), stretch));
    table(probe, "from", rows)
}

/// One line a shell: its number of photons, the first of them, how many were asked, and the same as in [`csv`].
pub fn shells(probe: &Probe, summary: &Summary) -> String {
    let rows = summary
        .shells
        .iter()
        .map(|(first, stretch)| (format!("{},{first}", probe.shell_size(*first)), stretch));
    table(probe, "m,first", rows)
}

fn table<'a>(
    probe: &Probe,
    head: &str,
    rows: impl Iterator<Item = (String, &'a Stretch)>,
) -> String {
    let told = told(probe);
    let mut text = format!("{head},photons");
    for Told { heading, .. } in &told {
        for column in ["from", "to", "k"] {
            let _ = write!(text, ",\"{heading}: {column}\"");
        }
    }
    text.push('\n');
    for (start, stretch) in rows {
        let _ = write!(text, "{start},{}", stretch.photons);
        for Told { of, .. } in &told {
            match of.of(stretch) {
                Some(Extreme { k, low, high }) => {
                    let _ = write!(text, ",{low:e},{high:e},{k}");
                }
                None => text.push_str(",,,"),
            }
        }
        text.push('\n');
    }
    text
}

/// No more photons than this are drawn one by one.
const MOST_DRAWN: u64 = 4096;

/// No more shells than this.
const MOST_SHELLS: usize = 300;

/// The picture of what was found: the quantity between its extremes, and the margins of the claim's links.
pub fn picture(probe: &Probe, summary: &Summary) -> String {
    let question = probe.question();
    let drawn = Drawn::new(probe, summary);
    let mut panels = vec![];
    if let Some(quantity) = &question.quantity {
        panels.push(drawn.quantity(quantity));
    }
    if probe.links().next().is_some() {
        panels.push(drawn.margins());
    }
    let chart = Chart {
        title: format!(
            "Photons {} to {}, layout {}",
            question.first, question.last, question.layout
        ),
        notes: vec![drawn.legend(summary), command(question)],
        panels,
        ..Chart::default()
    };
    chart.to_svg()
}

/// The command that asks this question.
fn command(question: &Question) -> String {
    let mut text = format!(
        "claimcheck probe --layout {} --k {}..{}",
        question.layout, question.first, question.last
    );
    if let Some(stretches) = question.sample {
        let _ = write!(text, " --sample {stretches}");
    }
    for (option, value) in [
        ("--quantity", &question.quantity),
        ("--claim", &question.claim),
    ] {
        if let Some(value) = value {
            let _ = write!(text, " {option} '{value}'");
        }
    }
    text
}

/// What one mark of a picture stands for.
enum Drawn<'a> {
    /// A photon.
    Photons(&'a Probe),
    /// Stretches from the first photon to the next one's first, as far as they were asked.
    Stretches(&'a Probe, Vec<(f64, f64, &'a Stretch)>, &'static str),
}

impl<'a> Drawn<'a> {
    fn new(probe: &'a Probe, summary: &'a Summary) -> Drawn<'a> {
        let Question { first, last, .. } = *probe.question();
        let within = |from: u64, to: u64| (from.max(first) as f64, to.min(last + 1) as f64);
        if last - first < MOST_DRAWN && summary.photons == last - first + 1 {
            return Drawn::Photons(probe);
        }
        if (3..=MOST_SHELLS).contains(&summary.shells.len()) {
            // A shell that the range cuts would look like news.
            let whole = |start: u64| start >= first && start + probe.shell_size(start) <= last + 1;
            let shells = summary.shells.iter().filter(|(start, _)| whole(**start));
            let shells = shells.map(|(start, stretch)| {
                let (from, to) = within(*start, start + probe.shell_size(*start));
                (from, to, stretch)
            });
            return Drawn::Stretches(probe, shells.collect(), "Each mark is a shell.");
        }
        // A round last number has a bin to itself, which would look like news.
        let bins = summary.bins.iter().filter(|(start, _)| **start < last);
        let bins = bins.map(|(start, stretch)| {
            let (from, to) = within(*start, bin(*start).1);
            (from, to, stretch)
        });
        let words = "Each mark is a tenth of a decade of photons.";
        Drawn::Stretches(probe, bins.collect(), words)
    }

    fn legend(&self, summary: &Summary) -> String {
        let (probe, mut words) = match self {
            Drawn::Photons(probe) => (probe, "Every photon is drawn.".to_owned()),
            Drawn::Stretches(probe, _, words) => (probe, (*words).to_owned()),
        };
        if probe.question().sample.is_some() {
            words.push_str(" Of each shell a sample is asked.");
        }
        let untold: u64 = summary.bins.values().map(|stretch| stretch.untold).sum();
        if untold > 0 {
            let _ = write!(words, " Left out: {}.", photons_without(untold));
        }
        words
    }

    /// The values at each photon, of the quantity or of a link's difference.
    fn values(probe: &Probe, link: Option<usize>) -> Vec<[f64; 2]> {
        let Question { first, last, .. } = *probe.question();
        let value = |k| {
            let value = probe.value(link, k);
            value.map_or(f64::NAN, |value| value.midpoint().to_f64())
        };
        (first..=last).map(|k| [k as f64, value(k)]).collect()
    }

    fn quantity(&self, quantity: &str) -> Panel {
        let (name, marks, look) = match self {
            Drawn::Photons(probe) => {
                let line = Marks::Line(Self::values(probe, None));
                (quantity.to_owned(), line, 0)
            }
            Drawn::Stretches(_, stretches, _) => {
                let boxes = stretches.iter().filter_map(|(from, to, stretch)| {
                    Some([*from, *to, stretch.least?.low, stretch.greatest?.high])
                });
                let name = format!("{quantity}, from the least to the greatest");
                (name, Marks::Boxes(boxes.collect()), 1)
            }
        };
        let series = Series { name, marks, look };
        self.panel(quantity, vec![series])
    }

    /// Margins of either sign; those that a logarithmic scale cannot show have marks at the foot.
    fn margins(&self) -> Panel {
        let words = match self {
            Drawn::Photons(_) => "margin of",
            Drawn::Stretches(..) => "least margin of",
        };
        let (probe, lines): (&Probe, Vec<Vec<[f64; 2]>>) = match self {
            Drawn::Photons(probe) => {
                let links = 0..probe.links().count();
                (
                    probe,
                    links.map(|link| Self::values(probe, Some(link))).collect(),
                )
            }
            Drawn::Stretches(probe, stretches, _) => {
                let line = |link: usize| {
                    let steps = stretches.iter().flat_map(|(from, to, stretch)| {
                        let least = Which::Margin(link).of(stretch);
                        let y = least.map_or(f64::NAN, |least| least.low);
                        [[*from, y], [*to, y]]
                    });
                    steps.collect()
                };
                (probe, (0..probe.links().count()).map(line).collect())
            }
        };
        let positive = lines.iter().flatten().map(|[_, y]| *y).filter(|y| *y > 0.0);
        let foot = positive.fold(f64::INFINITY, f64::min).min(1.0) / 2.0;
        let mut series = vec![];
        for (link, (name, line)) in probe.links().zip(lines).enumerate() {
            series.push(Series {
                name: format!("{words} {name}"),
                marks: Marks::Line(line),
                look: link,
            });
        }
        let failures = self.failures(foot);
        if !failures.is_empty() {
            series.push(Series {
                name: "a margin that is not positive".into(),
                marks: Marks::Dots(failures),
                look: 4,
            });
        }
        Panel {
            y: Axis {
                label: "larger side less smaller side".into(),
                scale: Scale::Log,
            },
            ..self.panel("", series)
        }
    }

    /// Where a margin is 0 or negative, a mark at this height in the middle of what is drawn.
    fn failures(&self, foot: f64) -> Vec<[f64; 2]> {
        match self {
            Drawn::Photons(probe) => {
                let links = 0..probe.links().count();
                let values = links.flat_map(|link| Self::values(probe, Some(link)));
                let bad = values.filter(|[_, y]| *y <= 0.0);
                bad.map(|[k, _]| [k, foot]).collect()
            }
            Drawn::Stretches(_, stretches, _) => {
                let bad = stretches.iter().filter(|(_, _, stretch)| {
                    let margins = stretch.margins.iter().flatten();
                    margins.clone().any(|least| least.low <= 0.0)
                });
                bad.map(|(from, to, _)| [f64::midpoint(*from, *to), foot])
                    .collect()
            }
        }
    }

    /// Over k, logarithmic where the numbers reach far.
    fn panel(&self, label: &str, series: Vec<Series>) -> Panel {
        let probe = match self {
            Drawn::Photons(probe) | Drawn::Stretches(probe, ..) => probe,
        };
        let Question { first, last, .. } = *probe.question();
        let far = |low: f64, high: f64| match low > 0.0 && high / low > 30.0 {
            true => Scale::Log,
            false => Scale::Linear,
        };
        let heights: Vec<f64> = series
            .iter()
            .flat_map(|series| series.marks.corners())
            .map(|[_, y]| y)
            .filter(|y| y.is_finite())
            .collect();
        let least = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Panel {
            title: String::new(),
            x: Axis {
                label: "photon k".into(),
                scale: far(first as f64, last as f64),
            },
            y: Axis {
                label: label.to_owned(),
                scale: far(least, greatest),
            },
            series,
        }
    }
}
