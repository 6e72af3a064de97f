//! Mutated claim files from parser to verdict: whatever a file holds, the answer is a verdict or an
//! error with a place, within the budget.
//!
//! `CLAIMCHECK_FUZZ=10000` tries so many files; without it, a few hundred.
#![cfg(feature = "engine")]

use claimcheck::book::read_text;
use claimcheck::judge::{Settings, judge};
use rand::RngExt;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// Words of the language, among them those that make trouble: towers, divisions by zero, poles.
const WORDS: [&str; 44] = [
    "k",
    "n",
    "l",
    "m",
    "I",
    "V",
    "Va",
    "0",
    "1",
    "2",
    "-1",
    "1/0",
    "2^2^100",
    "inf",
    "pi",
    "+",
    "-",
    "*",
    "/",
    "^",
    "!",
    "(",
    ")",
    "[",
    "]",
    "==",
    "<",
    "<=",
    "~",
    "=~",
    "gamma(-3)",
    "ln(0)",
    "mean(",
    "var(",
    "int(1/x, x = 0..1)",
    "sum(j, j = 1..10^9)",
    "hyp2f1(1, 2; 3; 1/2)",
    "O(1/k)",
    "as k -> inf",
    "and",
    "if",
    "\n",
    "\u{2264}",
    "10^10^10",
];

/// The claims of the book that mutants are made from, with the definitions that they use.
fn blocks() -> Vec<String> {
    let mut blocks = Vec::new();
    for entry in std::fs::read_dir("proofs/thesis").unwrap() {
        let text = std::fs::read_to_string(entry.unwrap().path()).unwrap();
        let defines: String = text
            .split("```")
            .filter(|block| block.starts_with("define"))
            .map(|block| format!("```{block}```\n\n"))
            .collect();
        for block in text.split("```").filter(|block| block.starts_with("claim")) {
            let uses = if block.contains("\nuse ") {
                defines.as_str()
            } else {
                ""
            };
            // Other claims are not in the file.
            let alone = |line: &&str| !line.starts_with("after ") && !line.starts_with("same ");
            let block: Vec<&str> = block.lines().filter(alone).collect();
            blocks.push(format!("{uses}```{}\n```\n", block.join("\n")));
        }
    }
    blocks
}

fn mutated(text: &str, rng: &mut Xoshiro256PlusPlus) -> String {
    let mut text: Vec<char> = text.chars().collect();
    for _ in 0..rng.random_range(1..=3) {
        let at = rng.random_range(0..text.len());
        match rng.random_range(0..4) {
            0 => {
                let end = (at + rng.random_range(1..6)).min(text.len());
                text.drain(at..end);
            }
            1 => {
                let end = (at + rng.random_range(1..20)).min(text.len());
                let piece = text[at..end].to_vec();
                text.splice(at..at, piece);
            }
            2 => text[at] = char::from_u32(rng.random_range(1..0x3000)).unwrap_or('x'),
            _ => {
                let word = WORDS[rng.random_range(0..WORDS.len())];
                text.splice(at..at, word.chars());
            }
        }
        if text.is_empty() {
            break;
        }
    }
    text.into_iter().collect()
}

#[test]
fn no_mutated_claim_breaks_the_judge() {
    let count = std::env::var("CLAIMCHECK_FUZZ")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(300);
    let blocks = blocks();
    let settings = Settings {
        budget: 200_000,
        points: 12,
        ..Settings::default()
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .stack_size(64 << 20)
        .build()
        .unwrap();
    let judged: usize = pool.install(|| {
        (0..count as u64)
            .into_par_iter()
            .map(|seed| {
                let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
                let text = mutated(&blocks[rng.random_range(0..blocks.len())], &mut rng);
                match read_text("mutated.md", &text) {
                    Ok(book) => {
                        for claim in &book.claims {
                            judge(claim, None, &settings);
                        }
                        book.claims.len()
                    }
                    Err(errors) => {
                        for error in errors {
                            assert!(error.diagnostic.span.end <= text.len(), "{error:?}");
                        }
                        0
                    }
                }
            })
            .sum()
    });
    println!("{count} files, {judged} claims judged");
    assert!(judged > 0);
}
