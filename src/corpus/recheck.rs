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
    /// From 1.
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
        let kept = match text(file).and_then(|text| text.map_or(Ok(Vec::new()), |t| items(&t))) {
            Ok(items) => Kept { claim, file, items },
            Err(Flaw { line, message }) => {
                let nothing = Kept {
                    claim,
                    file,
                    items: Vec::new(),
                };
                return self.failures.push(nothing.failed(line, &message));
            }
        };
        let [printed, mended] = [Some(claim.printed()), claim.mended()].map(|p| p?.ok());
        self.items(&kept, [printed.as_ref(), mended.as_ref()]);
        let expect = claim.expect.as_ref();
        let parts = [
            ("printed", printed, expect.and_then(|e| e.printed)),
            ("mended", mended, expect.and_then(|e| e.mended)),
        ];
        for (part, proposition, expected) in parts {
            if let (Some(proposition), Some(expected)) = (proposition, expected) {
                self.expected(&kept, part, &proposition, expected);
            }
        }
    }

    /// Each certificate is about one of the statements, and no two contradict each other.
    fn items(&mut self, kept: &Kept, statements: [Option<&Proposition>; 2]) {
        for item in &kept.items {
            if !statements.contains(&Some(item.proposition())) {
                let reason = "this is another statement than the claim's; `check --save` renews it, or delete it";
                self.failures.push(kept.failed(item.line, reason));
            }
            if let Some(other) = kept.items.iter().find(|other| item.contradicts(other)) {
                let reason = format!("proved here, and refuted in line {}", other.line);
                self.contradictions.push(kept.failed(item.line, &reason));
            }
            self.count(item);
        }
    }

    /// What is expected to be proved or refuted has its certificate.
    fn expected(
        &mut self,
        kept: &Kept,
        part: &str,
        proposition: &Proposition,
        expected: ExpectedVerdict,
    ) {
        let word = match expected {
            ExpectedVerdict::Proved => "proved",
            ExpectedVerdict::Refuted(_) => "refuted",
            _ => return,
        };
        let mut items = kept.items.iter();
        if items.any(|item| item.shows(proposition, expected)) {
            return;
        }
        if word == "refuted" && has_expansion(&proposition.statement) {
            return self.not_replayed.push(kept.claim.id.to_string());
        }
        let reason = format!(
            "expected {part} {word}, and {} does not show it",
            kept.file.display()
        );
        self.failures.push(Failed {
            file: kept.claim.file.clone(),
            line: kept.claim.line,
            ..kept.failed(0, &reason)
        });
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

/// The certificates of a claim.
struct Kept<'a> {
    claim: &'a Claim,
    file: &'a Path,
    items: Vec<Item>,
}

impl Kept<'_> {
    fn failed(&self, line: usize, reason: &str) -> Failed {
        Failed {
            file: self.file.to_path_buf(),
            line: line.max(1),
            id: self.claim.id.to_string(),
            reason: reason.to_owned(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::read_text;

    const BOOK: &str = "\
```claim right
given  int k with k >= 1
says   (k + 1)^2 == k^2 + 2*k + 1
expect proved
```

```claim wrong
given  int k with k >= 1
says   k^2 == 2*k
expect refuted
```
";
    const RIGHT: &str = "theorem\ngiven int k\ndomain k >= 1\nsays (k + 1)^2 == k^2 + 2*k + 1\n\
        example k = 1\nproof\n1: (k + 1)^2 == k^2 + 2*k + 1 | ring\nqed 1\n";
    const WRONG: &str =
        "refutation\ngiven int k\ndomain k >= 1\nsays k^2 == 2*k\nat k = 1\nlink 1\n";

    /// Rechecks the book with these certificates, each an id and a text; the failures as file and line
    /// and reason.
    fn rechecked(name: &str, certificates: &[(&str, &str)]) -> (Recheck, Vec<String>) {
        let name = format!("claimcheck-recheck-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("can be made");
        for (id, text) in certificates {
            std::fs::write(folder.join(format!("{id}.proof")), text).expect("can be written");
        }
        let book = read_text("chapter.md", BOOK).expect("a book");
        let found = recheck(&book, &Store::at(&folder), true).expect("listed");
        std::fs::remove_dir_all(&folder).expect("it is there");
        let told = found.failures.iter().map(|failed| {
            let file = failed.file.file_name().unwrap_or_default();
            format!("{}:{}: {}", file.display(), failed.line, failed.reason)
        });
        let told = told.collect();
        (found, told)
    }

    /// Each failure begins with the text at its place.
    fn fails(name: &str, certificates: &[(&str, &str)], expected: &[&str]) {
        let (_, told) = rechecked(name, certificates);
        assert_eq!(told.len(), expected.len(), "{told:?}");
        for (told, expected) in told.iter().zip(expected) {
            assert!(told.starts_with(expected), "{told}");
        }
    }

    #[test]
    fn certificates_that_hold_are_counted() {
        let (found, told) = rechecked("good", &[("right", RIGHT), ("wrong", WRONG)]);
        assert_eq!(told, [""; 0]);
        assert_eq!((found.theorems, found.refutations, found.steps), (1, 1, 1));
    }

    #[test]
    fn what_is_expected_must_be_shown() {
        let missing = [
            "chapter.md:1: expected printed proved",
            "chapter.md:7: expected",
        ];
        fails("missing", &[], &missing);
        let both = [("right", RIGHT), ("wrong", WRONG), ("gone", RIGHT)];
        fails("gone", &both, &["gone.proof:1: the book has no such claim"]);
    }

    #[test]
    fn an_altered_certificate_fails_at_its_line() {
        let right = ("right", RIGHT);
        let wrong = ("wrong", WRONG);
        let cut = &RIGHT[..RIGHT.len() - 6];
        fails(
            "cut",
            &[("right", cut), wrong],
            &["right.proof:7: the proof has no `qed`"],
        );
        let false_step = RIGHT.replace("2*k + 1", "2*k + 2");
        fails(
            "false",
            &[("right", &false_step), wrong],
            &["right.proof:7: "],
        );
        let other_point = WRONG.replace("k = 1", "k = 2");
        fails(
            "point",
            &[right, ("wrong", &other_point)],
            &["wrong.proof:6: "],
        );
        let stale = RIGHT.replace(">= 1", ">= 0");
        let places = [
            "right.proof:1: this is another statement",
            "chapter.md:1: expected",
        ];
        fails("stale", &[("right", &stale), wrong], &places);
        fails(
            "binary",
            &[("right", "\0\u{1b}"), wrong],
            &["right.proof:1: "],
        );
    }
}
