//! `expect` lines: reading them, and whether a verdict meets them.

use super::{Claim, Expectation, ExpectedVerdict, Fault};
use crate::formula::{Diagnostic, Span, nearest};

const WORDS: [(&str, ExpectedVerdict); 8] = [
    ("proved", ExpectedVerdict::Proved),
    ("certified", ExpectedVerdict::Certified),
    ("refuted", ExpectedVerdict::Refuted(None)),
    ("undecided", ExpectedVerdict::Undecided),
    ("vacuous", ExpectedVerdict::Vacuous),
    ("illtyped", ExpectedVerdict::IllTyped),
    ("defined", ExpectedVerdict::Defined),
    ("noted", ExpectedVerdict::Noted),
];

impl ExpectedVerdict {
    /// The verdict that output names `word`, with where a refuted statement is at fault.
    pub fn from_word(word: &str, fault: Option<Fault>) -> Option<ExpectedVerdict> {
        let (_, verdict) = WORDS.iter().find(|(known, _)| *known == word)?;
        Some(match verdict {
            ExpectedVerdict::Refuted(_) => ExpectedVerdict::Refuted(fault),
            other => *other,
        })
    }

    /// Whether the verdict `word` is at least what is expected: `proved` meets `certified`, and
    /// `refuted` is met by any fault.
    pub fn meets(self, word: &str, fault: Option<Fault>) -> bool {
        match (self, ExpectedVerdict::from_word(word, fault)) {
            (_, None) => false,
            (ExpectedVerdict::Certified, Some(ExpectedVerdict::Proved)) => true,
            (ExpectedVerdict::Refuted(None), Some(ExpectedVerdict::Refuted(_))) => true,
            (expected, Some(found)) => expected == found,
        }
    }
}

/// Whether a verdict is good where nothing is said of it.
fn passes(word: &str) -> bool {
    matches!(word, "proved" | "certified" | "defined" | "noted")
}

impl Claim {
    /// Whether the verdict on the print, by its word, is as expected; without `expect` it must be
    /// `proved`, `certified`, `defined` or `noted`.
    pub fn printed_meets(&self, word: &str, fault: Option<Fault>) -> bool {
        match self.expect.as_ref().and_then(|expect| expect.printed) {
            Some(expected) => expected.meets(word, fault),
            None => passes(word),
        }
    }

    /// The same for the mended statement.
    pub fn mended_meets(&self, word: &str, fault: Option<Fault>) -> bool {
        match self.expect.as_ref().and_then(|expect| expect.mended) {
            Some(expected) => expected.meets(word, fault),
            None => passes(word),
        }
    }
}

/// Reads `printed refuted domain, mended proved` or `certified`, which is said of the print.
pub(super) fn expectation(text: &str) -> Result<Expectation, Diagnostic> {
    let mut expectation = Expectation {
        printed: None,
        mended: None,
    };
    let mut start = 0;
    for part in text.split(',') {
        let words = words(part, start);
        start += part.len() + 1;
        let (slot, rest) = match words.as_slice() {
            [("printed", _), rest @ ..] => (&mut expectation.printed, rest),
            [("mended", _), rest @ ..] => (&mut expectation.mended, rest),
            rest => (&mut expectation.printed, rest),
        };
        let found = verdict(rest, start - 1)?;
        if slot.replace(found).is_some() {
            return Err(error(whole(&words, start - 1), "this is given twice", None));
        }
    }
    Ok(expectation)
}

type Word<'t> = (&'t str, Span);

fn words(text: &str, start: usize) -> Vec<Word<'_>> {
    text.split_whitespace()
        .map(|word| {
            let at = start + (word.as_ptr() as usize - text.as_ptr() as usize);
            let end = at + word.len();
            (word, Span { start: at, end })
        })
        .collect()
}

fn whole(words: &[Word<'_>], end: usize) -> Span {
    match (words.first(), words.last()) {
        (Some(first), Some(last)) => Span {
            start: first.1.start,
            end: last.1.end,
        },
        _ => Span { start: end, end },
    }
}

fn verdict(words: &[Word<'_>], end: usize) -> Result<ExpectedVerdict, Diagnostic> {
    let names = || WORDS.iter().map(|(word, _)| *word);
    let Some((word, span)) = words.first() else {
        let message = "expected a verdict such as `certified`";
        return Err(error(whole(words, end), message, None));
    };
    let Some(found) = ExpectedVerdict::from_word(word, None) else {
        let all: Vec<_> = names().collect();
        let message = format!("no verdict: the verdicts are {}", all.join(", "));
        let hint = nearest(word, names().chain(["printed", "mended"]));
        return Err(error(
            *span,
            &message,
            hint.map(|near| format!("write `{near}`")),
        ));
    };
    let fault = match words.get(1) {
        None => return Ok(found),
        Some(("domain", _)) => Fault::Domain,
        Some(("statement", _)) => Fault::Statement,
        Some((_, span)) => {
            return Err(error(
                *span,
                "expected `domain`, `statement`, `,` or the end",
                None,
            ));
        }
    };
    if words.len() > 2 || found != ExpectedVerdict::Refuted(None) {
        let message = "`domain` or `statement` stands after `refuted` only, and ends the verdict";
        return Err(error(whole(words, end), message, None));
    }
    Ok(ExpectedVerdict::Refuted(Some(fault)))
}

fn error(span: Span, message: &str, hint: Option<String>) -> Diagnostic {
    Diagnostic {
        span,
        message: message.to_string(),
        hint,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_verdicts() {
        let both = expectation(" printed refuted domain, mended proved").expect("both");
        assert_eq!(
            both.printed,
            Some(ExpectedVerdict::Refuted(Some(Fault::Domain)))
        );
        assert_eq!(both.mended, Some(ExpectedVerdict::Proved));
        let one = expectation("certified").expect("one");
        assert_eq!(
            (one.printed, one.mended),
            (Some(ExpectedVerdict::Certified), None)
        );
        for text in [
            "",
            "printed",
            "certifed",
            "proved domain",
            "proved, printed proved",
            "refuted x",
        ] {
            assert!(expectation(text).is_err(), "{text}");
        }
    }

    #[test]
    fn proved_meets_certified() {
        assert!(ExpectedVerdict::Certified.meets("proved", None));
        assert!(!ExpectedVerdict::Proved.meets("certified", None));
        assert!(ExpectedVerdict::Refuted(None).meets("refuted", Some(Fault::Domain)));
        let domain = ExpectedVerdict::Refuted(Some(Fault::Domain));
        assert!(!domain.meets("refuted", Some(Fault::Statement)));
    }
}
