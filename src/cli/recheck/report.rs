//! `recheck --report FILE`: the witnesses of a JSON report, replayed against the book.

use super::super::output::{Exit, Failure, to_stdout};
use crate::book::{Book, Claim};
use crate::formula::{Point, Proposition, Rational, Statement, parse_formula};
use crate::kernel::{Witness, check_witness};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

/// The parts of a report that are replayed.
#[derive(Deserialize)]
struct Document {
    claims: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    id: String,
    printed: Answer,
    mended: Option<Answer>,
}

#[derive(Deserialize)]
struct Answer {
    verdict: String,
    witness: Option<FoundWitness>,
}

#[derive(Deserialize)]
struct FoundWitness {
    point: BTreeMap<String, String>,
    because: String,
}

/// What became of one refutation.
enum Replay {
    Holds,
    /// The kernel of this version does not replay this kind of evidence.
    NotOfTheKernel,
    Fails(String),
}

/// Replays every witness of the report and prints what came of it.
pub(super) fn replay(report: &Path, book: &Book) -> Result<Exit, Failure> {
    let document = read(report)?;
    let mut text = String::new();
    let (mut hold, mut aside, mut fail) = (0, 0, 0);
    for (id, part, replay) in replays(&document, book) {
        match replay {
            Replay::Holds => hold += 1,
            Replay::NotOfTheKernel => aside += 1,
            Replay::Fails(reason) => {
                fail += 1;
                text.push_str(&format!("{id} ({part}): {reason}\n"));
            }
        }
    }
    text.push_str(&format!(
        "{hold} witnesses replayed by the kernel, {fail} failed"
    ));
    if aside > 0 {
        text.push_str(&format!(
            "; {aside} expansions refuted by their terms were not replayed"
        ));
    }
    to_stdout(&(text + "\n"))?;
    Ok(match fail {
        0 => Exit::AsExpected,
        _ => Exit::NotAsExpected,
    })
}

fn read(path: &Path) -> Result<Document, Failure> {
    let failure = |message: String| {
        let hint = "write one with: claimcheck check --format json";
        Failure::input(&format!("{}: {message}", path.display()), Some(hint))
    };
    let text = std::fs::read_to_string(path).map_err(|error| failure(error.to_string()))?;
    serde_json::from_str(&text).map_err(|error| failure(format!("not a report: {error}")))
}

/// Every refutation of the report, with its claim's id and part.
fn replays<'a>(
    document: &'a Document,
    book: &'a Book,
) -> impl Iterator<Item = (&'a str, &'static str, Replay)> {
    document.claims.iter().flat_map(|entry| {
        let claim = book.claims.iter().find(|claim| *claim.id == *entry.id);
        let parts = [
            ("printed", Some(&entry.printed)),
            ("mended", entry.mended.as_ref()),
        ];
        parts.into_iter().filter_map(move |(part, answer)| {
            let answer = answer.filter(|answer| answer.verdict == "refuted")?;
            Some((entry.id.as_str(), part, replay_one(claim, part, answer)))
        })
    })
}

fn replay_one(claim: Option<&Claim>, part: &str, answer: &Answer) -> Replay {
    let Some(claim) = claim else {
        return Replay::Fails("the book has no such claim".into());
    };
    let Some(witness) = &answer.witness else {
        return Replay::Fails("refuted without a witness".into());
    };
    if witness.because == "remainder" {
        return Replay::NotOfTheKernel;
    }
    let unfolded = if part == "printed" {
        Some(claim.printed())
    } else {
        claim.mended()
    };
    let proposition = match unfolded {
        Some(Ok(proposition)) => proposition,
        Some(Err(illtyped)) => return Replay::Fails(illtyped.to_string()),
        None => return Replay::Fails("the book has no mended statement".into()),
    };
    match read_point(&witness.point) {
        Some(point) => replay_at(&proposition, &point),
        None => Replay::Fails("the witness is no point".into()),
    }
}

/// The report does not say which link fails at the point: any will do.
fn replay_at(proposition: &Proposition, point: &Point) -> Replay {
    let mut reason = String::from("the statement has no link");
    for link in 0..links(&proposition.statement) {
        let witness = Witness {
            point: point.clone(),
            link,
        };
        match check_witness(proposition, &witness) {
            Ok(_) => return Replay::Holds,
            Err(unknown) => reason = unknown.0,
        }
    }
    Replay::Fails(reason)
}

/// Links and duties of a statement, as [`Witness::link`] numbers them.
fn links(statement: &Statement) -> usize {
    match statement {
        Statement::Chain { links, .. } => links.len(),
        Statement::All(parts) => parts.iter().map(links).sum(),
        Statement::Definition { duties, .. } => 1 + duties.len(),
        Statement::Conditional { .. } => 1,
        Statement::Words | Statement::Empty => 0,
    }
}

/// A point as reports write it: `k` to `1/3`, and for a function parameter `f(x)` to a polynomial.
fn read_point(text: &BTreeMap<String, String>) -> Option<Point> {
    let mut point = Point::default();
    for (name, value) in text {
        match name.split_once('(') {
            None => {
                let value: Rational = value.parse().ok()?;
                point.numbers.insert(name.as_str().into(), value);
            }
            Some((function, argument)) => {
                let argument = argument.strip_suffix(')')?;
                let body = parse_formula(value).ok()?;
                point
                    .functions
                    .insert(function.into(), (argument.into(), body));
            }
        }
    }
    Some(point)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(name: &str, value: &str) -> Option<Point> {
        read_point(&BTreeMap::from([(name.to_owned(), value.to_owned())]))
    }

    #[test]
    fn points_are_read_exactly_or_not_at_all() {
        let third = point("I", "-1/3").expect("a rational");
        assert_eq!(third.numbers["I"], Rational::new((-1).into(), 3.into()));
        assert!(
            point("f(x)", "x^2 + 1")
                .expect("a polynomial")
                .functions
                .contains_key("f")
        );
        for bad in ["", "1/0", "0.5e", "k", "1/2/3"] {
            assert_eq!(point("k", bad), None, "{bad}");
        }
    }
}
