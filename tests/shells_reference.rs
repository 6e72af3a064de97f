//! `E_k - 1` and `Var_k` of strategy 2 against values from outside: every enclosure holds the truth, and is
//! no wider than two units of the last digit asked for.
//!
//! The points are those of `tests/data/shells.csv`, made by `make_shells.py` beside it with python-flint. With
//! `CLAIMCHECK_SHELLS=1000000` (and python-flint installed) the script makes as many more, seed
//! `CLAIMCHECK_SEED` or 2, and all of them are tried.
#![cfg(feature = "engine")]

use claimcheck::model::Layout;
use claimcheck::number::Interval;
use claimcheck::special::shell::{Quantity, enclose, enclose_all};
use claimcheck::special::sweep::sweep;
use rug::{Float, Integer};
use std::env;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// Digits asked for; the truth has nine more.
const DIGITS: u32 = 200;
const TRUTH: i64 = 209;
const BITS: u32 = 760;

/// What the text stands for: a unit of its last digit to both sides.
fn truth(text: &str) -> Interval {
    let value = Float::with_val(BITS, Float::parse(text).expect("a decimal"));
    let point = Interval::from_ends(value.clone(), value);
    let unit = Interval::from_i64(10, BITS).powi(1 - TRUTH);
    let error = point.abs().mul(&unit.expect("10 is not 0"));
    point.add(&error.neg().hull(&error))
}

/// E_k, E_k - 1 and Var_k: each by itself, together, and by a sweep over this photon.
fn found(k: &Integer) -> [[Interval; 3]; 3] {
    let shell = Layout::Triangular.shell(k).expect("every k has a shell");
    let quantities = [Quantity::Mean, Quantity::Excess, Quantity::Variance];
    let alone = quantities.map(|q| enclose(q, &shell, DIGITS).expect("it is finite"));
    let together = enclose_all(quantities, &shell, DIGITS).expect("they are finite");
    let mut blocks = sweep(&Layout::Triangular, k, k, DIGITS);
    let block = blocks.next().expect("one").expect("it converges");
    let photon = block.photons().next().expect("one");
    let swept = [photon.mean(), photon.excess(), photon.variance()];
    let swept = swept.map(|value| value.expect("it is finite").enclose(BITS));
    [alone, together, swept]
}

fn check(line: &str) {
    let fields: Vec<&str> = line.split(',').collect();
    let [k, excess, variance] = fields[..] else {
        panic!("no point: {line}");
    };
    let k: Integer = k.parse().expect("an integer");
    let [excess, variance] = [excess, variance].map(truth);
    let mean = excess.add(&Interval::from_i64(1, BITS));
    for values in found(&k) {
        for (value, truth) in values.iter().zip([&mean, &excess, &variance]) {
            assert!(value.overlaps(truth), "k = {k}: {value:?}, not {truth:?}");
            // A relative width below 10^-200: less than a unit of the 200th digit.
            assert!(value.agrees_to(DIGITS), "k = {k}: {value:?} is too wide");
        }
    }
}

/// All points of the lines; how many there are.
fn check_all(lines: impl Iterator<Item = String>) -> usize {
    let points = lines.filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    points.map(|line| check(&line)).count()
}

#[test]
fn stored_points() {
    let text = include_str!("data/shells.csv");
    assert_eq!(check_all(text.lines().map(str::to_owned)), 2000);
}

#[test]
fn points_made_now() {
    let Ok(count) = env::var("CLAIMCHECK_SHELLS") else {
        return;
    };
    let seed = env::var("CLAIMCHECK_SEED").unwrap_or_else(|_| "2".into());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/make_shells.py");
    let mut python = Command::new("python3")
        .args([script, &count, &seed])
        .stdout(Stdio::piped())
        .spawn()
        .expect("python3 with python-flint");
    let output = python.stdout.take().expect("piped");
    let lines = BufReader::new(output)
        .lines()
        .map(|line| line.expect("text"));
    let checked = check_all(lines);
    assert!(python.wait().expect("it ends").success());
    assert_eq!(checked.to_string(), count);
    println!("{checked} points of seed {seed}");
}
