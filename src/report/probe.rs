//! What a probe found, for people, as JSON and as CSV.

use super::style::{FAINT, STRONG, WIDTH, paint, wrap};
use crate::number::Interval;
use crate::probe::{Decade, Extreme, Named, Probe, Summary, Tally};
use rug::Float;
use serde_json::json;
use std::fmt::Write;

/// Digits of an extreme that are printed.
const DIGITS: usize = 6;

/// What is told of each decade: a heading, and how to find it.
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
    fn of(self, decade: &Decade) -> Option<Extreme> {
        match self {
            Which::Least => decade.least,
            Which::Greatest => decade.greatest,
            Which::Margin(link) => decade.margins.get(link).copied().flatten(),
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

/// The digits that both ends share.
fn decimal(extreme: &Extreme) -> String {
    let end = |x: f64| Float::with_val(53, x);
    Interval::from_ends(end(extreme.low), end(extreme.high)).to_decimal(DIGITS)
}

/// A report for people.
pub fn human(probe: &Probe, summary: &Summary) -> String {
    let question = probe.question();
    let mut text = format!(
        "layout {}, k = {}..{}: {} of {} photons asked; {} values needed more than doubles\n",
        question.layout,
        question.first,
        question.last,
        summary.photons,
        question.last - question.first + 1,
        summary.refined
    );
    let untold: u64 = summary.decades.values().map(|decade| decade.untold).sum();
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
        let known: Vec<(u32, Extreme)> = summary
            .decades
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
            let place = paint(FAINT, &format!("near k = {}", extreme.k));
            let _ = writeln!(text, "  {range:<36} {:<24} {place}", decimal(&extreme));
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
    let value = json!({ "question": probe.question(), "links": links, "found": summary });
    format!("{value:#}\n")
}

/// One line a decade: its least k and number of photons, and for each thing told the enclosure and its place.
pub fn csv(probe: &Probe, summary: &Summary) -> String {
    let told = told(probe);
    let mut text = "from,photons".to_owned();
    for Told { heading, .. } in &told {
        let _ = write!(text, ",\"{heading}: from\",to,k");
    }
    text.push('\n');
    for (power, decade) in &summary.decades {
        let _ = write!(text, "1e{power},{}", decade.photons);
        for Told { of, .. } in &told {
            match of.of(decade) {
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
