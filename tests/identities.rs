//! The prover of identities on the book: without any certificate it proves the equations of the claims
//! that are expected to be proved, as printed or as mended; of a certificate only the example is used.
//! Every fourth is tried, which takes seconds; the certificates of all are replayed elsewhere.
//!
//! `IDENTITIES=all cargo test --release --test identities` tries all; `IDENTITIES=2.14,2.28`, with
//! `-- --nocapture`, shows some of them and their certificates; `BOOK=proofs/beyond` reads another
//! chapter.
#![cfg(feature = "engine")]

use claimcheck::book::{Claim, read};
use claimcheck::corpus::certificates::Store;
use claimcheck::formula::{Formula, Point, Proposition, Relation, Statement};
use claimcheck::kernel::proof::Certificate;
use claimcheck::prover::identity::prove;
use std::path::PathBuf;
use std::time::Instant;

/// The points at which the claim's certificates show that it is not true for want of values.
fn examples(store: &Store, claim: &Claim) -> Vec<Point> {
    let kept = store
        .read(claim)
        .unwrap_or_else(|flaw| panic!("{}: {flaw}", claim.id));
    let example = |certificate| match certificate {
        Certificate::Theorem(script) => Some(script.example),
        Certificate::Refutation { .. } => None,
    };
    kept.into_iter().filter_map(example).collect()
}

/// Of each link, whether it is an equation that a proof may close.
fn equations(statement: &Statement) -> Vec<bool> {
    match statement {
        Statement::Chain { links, .. } => links
            .iter()
            .map(|(relation, right)| *relation == Relation::Equal && !has_order(right))
            .collect(),
        Statement::All(parts) => parts.iter().flat_map(equations).collect(),
        _ => Vec::new(),
    }
}

fn has_order(e: &Formula) -> bool {
    match e {
        Formula::BigO(_) | Formula::LittleO(_) => true,
        Formula::Binary(_, a, b) => has_order(a) || has_order(b),
        _ => false,
    }
}

fn try_one(
    id: &str,
    which: &str,
    proposition: &Proposition,
    examples: &[Point],
    show: bool,
) -> Option<bool> {
    let equations = equations(&proposition.statement);
    let wanted = equations.iter().filter(|is_one| **is_one).count();
    if wanted == 0 {
        return None;
    }
    let start = Instant::now();
    let script = prove(proposition, examples);
    let time = start.elapsed().as_millis();
    let links = script.iter().flat_map(|script| &script.links);
    let proved = links.filter(|(link, _)| equations[*link]).count();
    if show && let Some(script) = &script {
        println!("{script}");
    }
    let steps = script.as_ref().map_or(0, |script| script.lines.len());
    let mark = if proved == wanted { "ok  " } else { "FAIL" };
    println!("{mark} {id} {which}: {proved} of {wanted} links, {steps} lines, {time} ms");
    Some(proved == wanted)
}

/// Whether the claim is to be proved, mended where it is mended.
fn is_to_be_proved(claim: &Claim, which: &str) -> bool {
    let expected = claim.expect_text.as_deref().unwrap_or_default();
    expected.contains(&format!("{which} proved"))
}

#[test]
fn the_book() {
    let only = std::env::var("IDENTITIES").ok();
    let step = if only.is_none() { 4 } else { 1 };
    let only = only.filter(|only| only != "all");
    let only: Option<Vec<&str>> = only.as_ref().map(|only| only.split(',').collect());
    let path = std::env::var("BOOK").unwrap_or_else(|_| "proofs/thesis".to_string());
    let store = Store::beside(&[PathBuf::from(&path)]);
    let book = read(&[PathBuf::from(path)]).unwrap_or_else(|errors| panic!("{errors:?}"));
    let (mut proved, mut all) = (0, 0);
    let mut failed = Vec::new();
    let chosen = |claim: &&Claim| match &only {
        Some(only) => only.contains(&&*claim.id),
        None => is_to_be_proved(
            claim,
            if claim.mended().is_some() {
                "mended"
            } else {
                "printed"
            },
        ),
    };
    for claim in book.claims.iter().filter(chosen).step_by(step) {
        let show = only.is_some();
        let (which, proposition) = match claim.mended() {
            Some(mended) => ("mended", mended),
            None => ("printed", claim.printed()),
        };
        let proposition = proposition.unwrap_or_else(|error| panic!("{}: {error}", claim.id));
        match try_one(
            &claim.id,
            which,
            &proposition,
            &examples(&store, claim),
            show,
        ) {
            Some(true) => proved += 1,
            Some(false) => failed.push(claim.id.to_string()),
            None => continue,
        }
        all += 1;
    }
    println!("{proved} of {all} proved; not: {}", failed.join(" "));
    assert!(failed.is_empty(), "not proved: {}", failed.join(" "));
    assert!(only.is_some() || all > 0, "the book has no equations");
}
