//! How often the checker catches a misprint: single-edit mutants of every statement of the book.
//!
//! A mutant counts when it is wrong somewhere: mutants of which a far longer search finds no failing
//! point (another seed, ten times the points) are set apart as equivalent. At least 95% of those that count must be refuted by the judge in its everyday settings.
//!
//! `CLAIMCHECK_MUTANTS=1` tries every mutant; without it every 83rd, which takes seconds.
#![cfg(feature = "engine")]

#[path = "support/mutate.rs"]
mod mutate;

use claimcheck::book::{Book, Claim, read};
use claimcheck::formula::{Name, ParameterKind};
use claimcheck::judge::{Settings, Verdict, judge};
use rayon::prelude::*;
use std::path::PathBuf;

/// A claim that says one mutant, and nothing of what it should say instead.
struct Mutant {
    claim: Claim,
}

#[derive(Debug, PartialEq)]
enum Fate {
    Refuted,
    Equivalent,
    Survived,
}

#[test]
fn misprints_are_refuted() {
    let book = read(&[PathBuf::from("proofs")]).unwrap_or_else(|errors| panic!("{errors:?}"));
    let step = std::env::var("CLAIMCHECK_MUTANTS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(83);
    let mutants: Vec<Mutant> = all_mutants(&book).into_iter().step_by(step).collect();
    let pool = rayon::ThreadPoolBuilder::new()
        .stack_size(64 << 20)
        .build()
        .unwrap();
    let fates: Vec<Fate> = pool.install(|| mutants.par_iter().map(fate).collect());
    let count = |wanted: Fate| fates.iter().filter(|fate| **fate == wanted).count();
    let (refuted, survived) = (count(Fate::Refuted), count(Fate::Survived));
    println!(
        "{} mutants: {refuted} refuted, {} equivalent, {survived} survived",
        mutants.len(),
        count(Fate::Equivalent)
    );
    for (mutant, fate) in mutants.iter().zip(&fates) {
        if *fate == Fate::Survived {
            println!("survived: {} {}", mutant.claim.id, mutant.claim.says);
        }
    }
    assert!(refuted > 100, "too few mutants to say anything: {refuted}");
    assert!(
        100 * refuted >= 95 * (refuted + survived),
        "fewer than 95% of the misprints are caught"
    );
}

fn all_mutants(book: &Book) -> Vec<Mutant> {
    book.claims.iter().flat_map(mutants_of).collect()
}

/// The mutants of what a claim says, and of what it should say.
fn mutants_of(claim: &Claim) -> Vec<Mutant> {
    let integers: Vec<Name> = claim
        .scope
        .parameters
        .iter()
        .filter(|parameter| parameter.kind == ParameterKind::Integer)
        .map(|parameter| parameter.name.clone())
        .collect();
    std::iter::once(&claim.says)
        .chain(&claim.mend)
        .flat_map(|statement| {
            mutate::mutants(statement, &|formula| mutate::misprints(formula, &integers))
        })
        .map(|statement| {
            let mut claim = claim.clone();
            claim.says = statement;
            claim.mend = None;
            claim.after = None;
            claim.expect = None;
            Mutant { claim }
        })
        .collect()
}

/// The verdict on a mutant, under the claim's `needs` where it has any.
fn verdict(mutant: &Mutant, settings: &Settings) -> Verdict {
    let report = judge(&mutant.claim, None, settings);
    report.mended.unwrap_or(report.printed).verdict
}

fn fate(mutant: &Mutant) -> Fate {
    let everyday = Settings::default();
    match verdict(mutant, &everyday) {
        Verdict::Refuted => Fate::Refuted,
        // A mutant that is no claim any more (an order of a derivative that is none, say).
        Verdict::IllTyped | Verdict::Vacuous => Fate::Equivalent,
        Verdict::Undecided => Fate::Survived,
        _ => {
            let longer = Settings {
                points: 10 * everyday.points,
                seed: 20,
                ..everyday
            };
            match verdict(mutant, &longer) {
                Verdict::Certified | Verdict::Proved => Fate::Equivalent,
                _ => Fate::Survived,
            }
        }
    }
}
