//! The figures of the thesis, made by the program.
#![cfg(feature = "engine")]

use claimcheck::model::Layout;
use claimcheck::report::figures::figures;
use claimcheck::special::shell::{Quantity, enclose_all};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of the test's own, empty at first.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("figures")
        .join(name);
    // It is there only if the test has run before.
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn make(out: &Path, options: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_claimcheck"));
    program.args(["chart", "figures", "--out"]).arg(out);
    program.args(options).output().expect("the program starts")
}

fn printed(output: &Output) -> String {
    assert!(output.status.success(), "{output:?}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The heading and the rows of a CSV file; a cell is NaN where it is empty.
fn read(path: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = fs::read_to_string(path).expect("it was made");
    let mut lines = text.lines().skip_while(|line| line.starts_with('#'));
    // Every name but that of k is quoted.
    let heading = lines.next().expect("a heading").split(",\"");
    let heading: Vec<String> = heading
        .map(|name| name.trim_end_matches('"').to_owned())
        .collect();
    let number = |cell: &str| match cell {
        "" => f64::NAN,
        cell => cell.parse().expect("a number"),
    };
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(number).collect())
        .collect();
    assert!(rows.iter().all(|row| row.len() == heading.len()));
    (heading, rows)
}

fn theory(layout: &Layout, k: u64, quantity: Quantity) -> f64 {
    let shell = layout.shell(&k.into()).expect("a photon");
    let [value] = enclose_all([quantity], &shell, 20).expect("finite");
    value.midpoint().to_f64()
}

#[test]
fn every_figure_stands_in_the_table_once() {
    let numbers = |chapter, first: u8, last: u8| {
        (first..=last).map(move |number| format!("{chapter}.{number}"))
    };
    let all = numbers(2, 9, 12)
        .chain(numbers(2, 18, 21))
        .chain(numbers(3, 1, 15));
    let table = figures()
        .into_iter()
        .map(|figure| figure.number.to_string());
    assert_eq!(table.collect::<Vec<_>>(), all.collect::<Vec<_>>());
}

#[test]
fn data_agree_with_theory() {
    let out = folder("data");
    printed(&make(&out, &["--only", "2.12,3.1,3.12", "--quick"]));

    let (heading, rows) = read(&out.join("figure-2.12.csv"));
    assert_eq!(
        heading[1..],
        [
            "variance of k/U: strategy 2",
            "variance of k/U: the listing"
        ]
    );
    let photons: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    assert_eq!(photons, (2..=50).map(f64::from).collect::<Vec<_>>());
    for row in &rows {
        let k = row[0] as u64;
        let two = theory(&Layout::Triangular, k, Quantity::Variance);
        let listing = theory(&Layout::Listing, k, Quantity::Variance);
        assert!((row[1] / two - 1.0).abs() < 1e-14 && (row[2] / listing - 1.0).abs() < 1e-14);
    }

    let (heading, rows) = read(&out.join("figure-3.1.csv"));
    assert_eq!(heading[4], "k/U: mean, 100 runs");
    assert_eq!(rows.len(), 149);
    for row in &rows {
        let [k, mean, one, run, simulated] = row[..] else {
            panic!("{row:?}");
        };
        assert!((mean / (k * (k / (k - 1.0)).ln()) - 1.0).abs() < 1e-11);
        assert_eq!(one, 1.0);
        // "While always staying above the real irradiance."
        assert!(run > 1.0 && simulated > 1.0);
        let error = (theory(&Layout::One, k as u64, Quantity::Variance) / 100.0).sqrt();
        assert!((simulated - mean).abs() < 6.0 * error, "k = {k}");
    }

    let (heading, rows) = read(&out.join("figure-3.12.csv"));
    assert_eq!(heading[2], "variance of k/U: simulated, 200 runs");
    assert!(rows.iter().all(|row| row[2] > 0.0));
}

/// What a note of figure 2.11 says of the thesis's formula (2.104) in doubles.
#[test]
fn the_variance_formula_cancels() {
    let worst = (900u64..=1000).map(|k| {
        let shell = Layout::Triangular.shell(&k.into()).expect("a photon");
        let [l, m] = [&shell.position, &shell.count].map(|n| n.to_f64());
        let (k_, a, v) = (k as f64, k as f64 - l, m);
        let f = theory(&Layout::Triangular, k, Quantity::Mean) * a / k_;
        let square = k_ * k_ * ((a * -m + a - l * v + v) * f + a * m) / (a * a * (a + v));
        let variance = square - k_ * k_ * f * f / (a * a);
        (variance / theory(&Layout::Triangular, k, Quantity::Variance) - 1.0).abs()
    });
    let worst = worst.fold(0.0, f64::max);
    assert!((1e-10..1e-7).contains(&worst), "{worst}");
}

#[test]
fn what_is_there_is_left() {
    let out = folder("there");
    let options = ["--only", "2.10,3.2", "--quick"];
    let first = printed(&make(&out, &options));
    assert_eq!(
        first,
        "figure-2.10.csv, figure-2.10.svg: made\nfigure-3.2.csv, figure-3.2.svg: made\n"
    );
    let second = printed(&make(&out, &options));
    assert_eq!(second, first.replace("made", "there already"));
    let mut names: Vec<_> = fs::read_dir(&out)
        .expect("the folder")
        .map(|entry| entry.expect("a file").file_name())
        .collect();
    names.sort();
    assert_eq!(
        names,
        [
            "figure-2.10.csv",
            "figure-2.10.svg",
            "figure-3.2.csv",
            "figure-3.2.svg"
        ]
    );

    // One that is missing is made again, one that another command made is never replaced.
    fs::remove_file(out.join("figure-3.2.svg")).expect("it was made");
    let third = printed(&make(&out, &options));
    assert!(third.contains("2.10.svg: there") && third.contains("3.2.svg: made"));
    let full = make(&out, &["--only", "3.3,3.2"]);
    assert_eq!(full.status.code(), Some(2));
    let said = String::from_utf8_lossy(&full.stderr);
    assert!(said.contains("figure-3.2.csv is no file of this command"));
    assert!(full.stdout.is_empty());
}

#[test]
fn threads_make_no_difference() {
    let (one, two) = (folder("one"), folder("two"));
    let options = ["--only", "2.18,3.6", "--quick", "--jobs"];
    for (out, jobs) in [(&one, "1"), (&two, "2")] {
        printed(&make(out, &[&options[..], &[jobs]].concat()));
    }
    for file in [
        "figure-2.18.csv",
        "figure-2.18.svg",
        "figure-3.6.csv",
        "figure-3.6.svg",
    ] {
        let bytes = |folder: &Path| fs::read(folder.join(file)).expect("it was made");
        assert!(bytes(&one) == bytes(&two), "{file}");
    }
}

#[test]
fn bad_input_is_told() {
    let unknown = make(&folder("unknown"), &["--only", "3.1,2.13"]);
    let said = String::from_utf8_lossy(&unknown.stderr);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(
        said.contains("no figure `2.13`") && said.contains("2.9, 2.10") && said.contains("3.15")
    );

    let file = folder("file");
    fs::create_dir_all(file.parent().expect("above it")).expect("it can be made");
    fs::write(&file, "no folder").expect("it can be written");
    let output = make(&file, &["--only", "2.9"]);
    fs::remove_file(&file).expect("it is still there");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("is no folder"));
}
