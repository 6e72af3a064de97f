//! Replaying the certificates of a book with the kernel alone.
//!
//! Both ways round: every certificate is replayed and is about its claim's statement, the print or the
//! mended one, tree for tree; and every statement that is expected to be proved or refuted has its
//! certificate. The search that found them has no part in it.

use super::certificates::{Store, text};
use crate::book::{Book, Claim, ExpectedVerdict, has_expansion};
use crate::formula::Proposition;
use crate::kernel::proof::{Certificate, Flaw, Line, Shown, parse, replay};
use std::collections::HashSet;
use std::io;
use std::path::{Path, PathBuf};

/// What became of the certificates of a book.
#[derive(Debug, Default)]
pub struct Recheck {
    pub theorems: usize,
    pub refutations: usize,
    /// Steps of all proofs.
    pub steps: usize,
    /// Expansions that are expected to be refuted: no certificate shows that yet. The claims' ids.
    pub not_replayed: Vec<String>,
    pub failures: Vec<Failed>,
    /// Two certificates that cannot both hold, though the kernel replays them: a fault of ours.
    pub contradictions: Vec<Failed>,
}

/// A certificate that does not hold or is not there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failed {
    pub file: PathBuf,
    /// From 1; 0 for the whole file.
    pub line: usize,
    pub id: String,
    pub reason: String,
}

/// Replays all certificates in the store. Where the book is read as a `whole`, each must belong to
/// one of its claims.
///
/// # Errors
/// Those of listing the folder.
pub fn recheck(book: &Book, store: &Store, whole: bool) -> io::Result<Recheck> {
    let mut found = Recheck::default();
    for claim in &book.claims {
        found.claim(claim, &store.path(claim));
    }
    if whole {
        let known: HashSet<PathBuf> = book.claims.iter().map(|claim| store.path(claim)).collect();
        for file in store.files()? {
            if !known.contains(&file) {
                let id = file.file_stem().unwrap_or_default().to_string_lossy();
                let (id, reason) = (id.into_owned(), "the book has no such claim".to_owned());
                found.failures.push(Failed {
                    file,
                    line: 1,
                    id,
                    reason,
                });
            }
        }
    }
    Ok(found)
}

impl Recheck {
    /// One claim, and the file of its certificates.
    fn claim(&mut self, claim: &Claim, file: &Path) {
        let fail = |line, reason: &str| Failed {
            file: file.to_path_buf(),
            line,
            id: claim.id.to_string(),
            reason: reason.to_owned(),
        };
        let items = match text(file).and_then(|text| text.map_or(Ok(Vec::new()), |t| items(&t))) {
            Ok(items) => items,
            Err(Flaw { line, message }) => return self.failures.push(fail(line, &message)),
        };
        let [printed, mended] = [Some(claim.printed()), claim.mended()].map(|p| p?.ok());
        for item in &items {
            let about = Some(item.proposition());
            if about != printed.as_ref() && about != mended.as_ref() {
                let reason = "this is another statement than the claim's; `check --save` renews it";
                self.failures.push(fail(item.line, reason));
            }
            if let Some(other) = items.iter().find(|other| item.contradicts(other)) {
                let reason = format!("proved here, and refuted in line {}", other.line);
                self.contradictions.push(fail(item.line, &reason));
            }
            self.count(item);
        }
        let expect = claim.expect.as_ref();
        let parts = [
            ("printed", printed, expect.and_then(|e| e.printed)),
            ("mended", mended, expect.and_then(|e| e.mended)),
        ];
        for (part, proposition, expected) in parts {
            let (Some(proposition), Some(expected)) = (proposition, expected) else {
                continue;
            };
            let shown = items.iter().any(|item| item.shows(&proposition, expected));
            match expected {
                _ if shown => (),
                ExpectedVerdict::Refuted(_) if has_expansion(&proposition.statement) => {
                    self.not_replayed.push(claim.id.to_string());
                }
                ExpectedVerdict::Proved | ExpectedVerdict::Refuted(_) => {
                    let word = match expected {
                        ExpectedVerdict::Proved => "proved",
                        _ => "refuted",
                    };
                    let file = file.display();
                    self.failures.push(Failed {
                        file: claim.file.clone(),
                        line: claim.line,
                        id: claim.id.to_string(),
                        reason: format!("expected {part} {word}, and {file} does not show it"),
                    });
                }
                _ => (),
            }
        }
    }

    fn count(&mut self, item: &Item) {
        match &item.certificate {
            Certificate::Theorem(script) => {
                let is_step = |line: &&Line| matches!(line, Line::Step { .. });
                self.theorems += 1;
                self.steps += script.lines.iter().filter(is_step).count();
            }
            Certificate::Refutation { .. } => self.refutations += 1,
        }
    }
}

/// A certificate that the kernel has replayed, and the line at which it begins.
struct Item {
    certificate: Certificate,
    shown: Shown,
    line: usize,
}

/// Replays the certificates of a text.
fn items(text: &str) -> Result<Vec<Item>, Flaw> {
    let begins = |line: &str| matches!(line.trim(), "theorem" | "refutation");
    let lines = text.lines().enumerate();
    let places = lines.filter_map(|(at, line)| begins(line).then_some(at + 1));
    let all = parse(text)?.into_iter().zip(replay(text)?).zip(places);
    let item = |((certificate, shown), line)| Item {
        certificate,
        shown,
        line,
    };
    Ok(all.map(item).collect())
}

impl Item {
    fn proposition(&self) -> &Proposition {
        match &self.shown {
            Shown::Theorem(theorem) => theorem.proposition(),
            Shown::Refutation { proposition, .. } => proposition,
        }
    }

    /// Whether it shows all that is expected of the proposition.
    fn shows(&self, proposition: &Proposition, expected: ExpectedVerdict) -> bool {
        let enough = match (&self.shown, expected) {
            (Shown::Theorem(theorem), ExpectedVerdict::Proved) => theorem.is_whole(),
            (Shown::Refutation { .. }, ExpectedVerdict::Refuted(_)) => true,
            _ => false,
        };
        enough && self.proposition() == proposition
    }

    /// Whether this proves a link that the other refutes.
    fn contradicts(&self, other: &Item) -> bool {
        match (&self.shown, &other.certificate) {
            (Shown::Theorem(theorem), Certificate::Refutation { witness, .. }) => {
                theorem.proposition() == other.proposition()
                    && theorem.links().contains(&witness.link)
            }
            _ => false,
        }
    }
}
