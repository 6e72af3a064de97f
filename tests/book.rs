//! The book itself: every claim has the verdict that it pins, and what is undecided says so.
#![cfg(feature = "engine")]

use claimcheck::book::read;
use claimcheck::corpus::certificates::Store;
use claimcheck::corpus::{self, Options};
use claimcheck::judge::{Report, Settings, Verdict};
use std::path::PathBuf;

/// A surprise as one reads it: what was expected, and what came.
fn surprise(report: &Report) -> String {
    let mut text = format!("{} expected {}", report.id, report.expected);
    let answers = [
        ("printed", Some(&report.printed)),
        ("mended", report.mended.as_ref()),
    ];
    for (label, answer) in answers {
        if let Some(answer) = answer {
            text += &format!("\n    {label} {}", answer.verdict.word());
            if let Some(fault) = answer.fault {
                text += &format!(" {fault:?}");
            }
            if let Some(reason) = &answer.reason {
                text += &format!(": {reason}");
            }
        }
    }
    if let Some(fault) = &report.needs_fault {
        text += &format!("\n    needs: {fault}");
    }
    text
}

/// With the certificates that are kept: what they prove is replayed, not searched for.
#[test]
fn every_claim_is_as_expected() {
    let path = PathBuf::from("proofs");
    let book = read(std::slice::from_ref(&path)).unwrap_or_else(|errors| panic!("{errors:?}"));
    let options = Options {
        certificates: Some(Store::beside(&[path])),
        ..Options::default()
    };
    let run = corpus::run(&book, &Settings::default(), &options, |_| ());
    let reports = run.expect("no internal fault").reports;
    let surprises: Vec<String> = reports
        .iter()
        .filter(|report| !report.as_expected)
        .map(surprise)
        .collect();
    assert!(surprises.is_empty(), "{}", surprises.join("\n"));
    // An undecided print is told as such in the book, with its reason.
    for report in &reports {
        let open = report.printed.verdict == Verdict::Undecided;
        assert!(
            !open || (report.expected.contains("printed undecided") && report.why.is_some()),
            "{}",
            surprise(report)
        );
    }
}
