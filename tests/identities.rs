//! The prover of identities on the book: without any certificate it proves the equations of the claims
//! that are expected to be proved, as printed or as mended. Every fourth is tried, which takes seconds;
//! the certificates of all are replayed elsewhere.
//!
//! `IDENTITIES=all cargo test --release --test identities` tries all; `IDENTITIES=2.14,2.28 cargo test --release --test identities -- --nocapture` shows some of them,
//! with the certificates; `BOOK=proofs/beyond` reads another chapter.
#![cfg(feature = "engine")]

use claimcheck::book::{Claim, read};
use claimcheck::formula::{
    Condition, Formula, FunctionKind, Operator, Parameter, ParameterKind, Point, Proposition,
    Rational, Relation, Statement, parse_formula,
};
use claimcheck::prover::identity::prove;
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

/// A point of the domain found by trying small numbers.
fn examples(proposition: &Proposition) -> Vec<Point> {
    let mut found = Vec::new();
    extend(
        proposition,
        &proposition.parameters,
        Point::default(),
        &mut found,
    );
    found
}

fn extend(proposition: &Proposition, rest: &[Parameter], point: Point, found: &mut Vec<Point>) {
    if found.len() >= 2 {
        return;
    }
    let values: BTreeMap<&str, f64> = point
        .numbers
        .iter()
        .map(|(name, value)| (&**name, value.to_f64().unwrap_or(f64::NAN)))
        .collect();
    let fails = |condition: &Condition| holds(condition, &values) == Some(false);
    if proposition.domain.iter().any(fails) {
        return;
    }
    let Some((parameter, rest)) = rest.split_first() else {
        found.push(point);
        return;
    };
    let mut next = |value: (i64, i64)| {
        let mut point = point.clone();
        let value = Rational::new(BigInt::from(value.0), BigInt::from(value.1));
        point.numbers.insert(parameter.name.clone(), value);
        extend(proposition, rest, point, found);
    };
    match &parameter.kind {
        ParameterKind::Integer => [3, 4, 5, 2, 1].into_iter().for_each(|n| next((n, 1))),
        ParameterKind::Real => {
            let small = [(1, 2), (1, 3), (2, 3), (1, 1), (2, 1)];
            small.into_iter().for_each(&mut next);
        }
        ParameterKind::Function { kind, .. } => {
            let text = match kind {
                FunctionKind::Density => "6*x*(1 - x)",
                _ => "1 + x",
            };
            let body = parse_formula(text).expect("a formula");
            let mut point = point.clone();
            let name = parameter.name.clone();
            point.functions.insert(name, ("x".into(), body));
            extend(proposition, rest, point, found);
        }
    }
}

fn holds(condition: &Condition, values: &BTreeMap<&str, f64>) -> Option<bool> {
    match condition {
        Condition::Chain(first, links) => {
            let mut left = number(first, values);
            let mut all = Some(true);
            for (relation, right) in links {
                let right = number(right, values);
                match (left, right) {
                    (Some(a), Some(b)) if !related(a, *relation, b) => return Some(false),
                    (Some(_), Some(_)) => {}
                    _ => all = None,
                }
                left = right;
            }
            all
        }
        Condition::And(parts) => {
            let parts: Vec<_> = parts.iter().map(|part| holds(part, values)).collect();
            match parts.contains(&Some(false)) {
                true => Some(false),
                false => Some(true),
            }
        }
        _ => None,
    }
}

fn related(a: f64, relation: Relation, b: f64) -> bool {
    match relation {
        Relation::Equal => a == b,
        Relation::NotEqual => a != b,
        Relation::Less => a < b,
        Relation::LessEqual => a <= b,
        Relation::Greater => a > b,
        _ => a >= b,
    }
}

fn number(e: &Formula, values: &BTreeMap<&str, f64>) -> Option<f64> {
    match e {
        Formula::Number(value) => value.to_f64(),
        Formula::Name(name) => values.get(&**name).copied(),
        Formula::Negate(a) => Some(-number(a, values)?),
        Formula::Binary(operator, a, b) => {
            let (a, b) = (number(a, values)?, number(b, values)?);
            Some(match operator {
                Operator::Add => a + b,
                Operator::Subtract => a - b,
                Operator::Multiply => a * b,
                Operator::Divide => a / b,
                Operator::Power => a.powf(b),
            })
        }
        _ => None,
    }
}

/// How many links are equations that a proof may close.
fn equations(statement: &Statement) -> usize {
    match statement {
        Statement::Chain { links, .. } => links
            .iter()
            .filter(|(relation, right)| *relation == Relation::Equal && !has_order(right))
            .count(),
        Statement::All(parts) => parts.iter().map(equations).sum(),
        _ => 0,
    }
}

fn has_order(e: &Formula) -> bool {
    match e {
        Formula::BigO(_) | Formula::LittleO(_) => true,
        Formula::Binary(_, a, b) => has_order(a) || has_order(b),
        _ => false,
    }
}

fn try_one(id: &str, which: &str, proposition: &Proposition, show: bool) -> Option<bool> {
    let wanted = equations(&proposition.statement);
    if wanted == 0 {
        return None;
    }
    let start = Instant::now();
    let script = prove(proposition, &examples(proposition));
    let time = start.elapsed().as_millis();
    let proved = script.as_ref().map_or(0, |script| script.links.len());
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
        match try_one(&claim.id, which, &proposition, show) {
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
