//! The book itself: every claim has the verdict that it pins, and every number of chapter 2 has a claim.
#![cfg(feature = "engine")]

use claimcheck::book::read;
use claimcheck::corpus::{self, Options};
use claimcheck::judge::{Settings, Verdict};
use std::collections::BTreeSet;
use std::path::PathBuf;

fn reports() -> Vec<claimcheck::judge::Report> {
    let book = read(&[PathBuf::from("proofs")]).unwrap_or_else(|errors| panic!("{errors:?}"));
    let run = corpus::run(&book, &Settings::default(), &Options::default(), |_| ());
    run.expect("no internal fault").reports
}

#[test]
fn every_claim_is_as_expected() {
    let surprises: Vec<String> = reports()
        .iter()
        .filter(|report| !report.as_expected)
        .map(|report| {
            format!(
                "{}: expected {:?}, printed {:?} {:?} ({:?}), mended {:?}, needs {:?}",
                report.id,
                report.expected,
                report.printed.verdict,
                report.printed.fault,
                report.printed.reason,
                report
                    .mended
                    .as_ref()
                    .map(|mended| (mended.verdict, &mended.reason)),
                report.needs_fault,
            )
        })
        .collect();
    assert!(surprises.is_empty(), "{}", surprises.join("\n"));
}

#[test]
fn chapter_2_is_whole_and_decided() {
    let reports = reports();
    let ids: BTreeSet<&str> = reports.iter().map(|report| report.id.as_str()).collect();
    for number in 1..=105 {
        assert!(
            ids.contains(format!("2.{number}").as_str()),
            "2.{number} has no claim"
        );
    }
    for report in &reports {
        assert_ne!(report.printed.verdict, Verdict::Undecided, "{}", report.id);
    }
}
