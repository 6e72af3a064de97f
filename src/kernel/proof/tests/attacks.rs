//! Attacks: steps that would prove something false, each by a hole that was found in the kernel.

use super::super::replay;

#[test]
#[ignore]
fn explore() {
    let path = std::env::var("AUDIT").expect("a path");
    let text = std::fs::read_to_string(&path).expect("a file");
    for case in text.split("=====\n") {
        let case = case.trim_start();
        let start = std::time::Instant::now();
        let shown = std::panic::catch_unwind(|| {
            if case.starts_with("theorem") || case.starts_with("refutation") {
                match replay(case) {
                    Ok(all) => format!("ACCEPTED ({})", all.len()),
                    Err(flaw) => format!("rejected: {flaw}"),
                }
            } else {
                let (scope, lines) = case.split_once("--\n").expect("--");
                steps(scope, lines)
            }
        })
        .unwrap_or_else(|_| "PANIC".to_string());
        let head = case.lines().next().unwrap_or_default();
        println!("{} ms  {head:.60}: {shown:.300}", start.elapsed().as_millis());
    }
}

fn steps(scope: &str, lines: &str) -> String {
    use super::super::{Proof, certificate::Labels};
    use crate::formula::parse_proposition;
    let scope: Vec<&str> = scope.lines().filter(|l| !l.starts_with('#')).chain(["says 0 == 1"]).collect();
    let proposition = parse_proposition(&scope.join("\n")).expect("scope");
    let mut proof = Proof::new(&proposition);
    let mut labels = Labels::default();
    for text in lines.lines().map(str::trim).filter(|l| !l.is_empty()) {
        let line = match labels.line(text) {
            Ok(line) => line,
            Err(why) => return format!("UNREADABLE {text}: {why}"),
        };
        if let Err(why) = proof.line(&line) {
            return format!("rejected {text:.80}: {why}");
        }
    }
    format!("ALL ACCEPTED, fuel left {}", proof.fuel.get())
}
