//! Every rule: steps that follow by it, and near misses that do not.
//!
//! A case is a scope (the lines of a proposition without its `says`) and the lines of a proof. The
//! last line is what is tested: all lines before it must be accepted.

mod attacks;
mod certificates;
mod derivatives;
mod integrals;
mod logic;
mod special;
mod theorems;

use super::certificate::Labels;
use super::{Proof, Rejected};
use crate::formula::parse_proposition;

/// What becomes of the last line; the lines before it are steps.
fn last(scope: &str, lines: &str) -> Result<(), Rejected> {
    let says = "says 0 == 1";
    let text: Vec<&str> = scope.lines().map(str::trim).chain([says]).collect();
    let proposition = parse_proposition(&text.join("\n")).expect(scope);
    let mut proof = Proof::new(&proposition);
    let mut labels = Labels::default();
    let lines: Vec<&str> = lines
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    let mut outcome = Ok(());
    for (at, text) in lines.iter().enumerate() {
        let line = labels
            .line(text)
            .unwrap_or_else(|why| panic!("{text}: {why}"));
        outcome = proof.line(&line);
        if let (Err(why), true) = (&outcome, at + 1 < lines.len()) {
            panic!("{text}: {why}");
        }
    }
    outcome
}

/// All lines are steps.
#[track_caller]
fn accepts(scope: &str, lines: &str) {
    if let Err(why) = last(scope, lines) {
        panic!("{}: {why}", lines.trim().lines().last().unwrap_or_default());
    }
}

/// All lines but the last are steps; the last is rejected for a reason with these words.
#[track_caller]
fn rejects(scope: &str, lines: &str, reason: &str) {
    match last(scope, lines) {
        Ok(()) => panic!(
            "accepted: {}",
            lines.trim().lines().last().unwrap_or_default()
        ),
        Err(Rejected(why)) => assert!(why.contains(reason), "rejected, but: {why}"),
    }
}
