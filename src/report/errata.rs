//! The errata sheet: for the paper's author, what misleads a reader most first.
//!
//! The order is computed, never that of the ids: by how far the two sides of a statement lie apart
//! where it fails.

use super::latex::escape;
use super::tally::Outcome;
use super::words::{counted, place, shown, sides};
use super::{latex, typeset};
use crate::formula::{parse_condition, parse_statement};
use crate::judge::{Cause, Kind, Report, Verdict, WitnessReport};
use std::fmt::Write;

/// The sheet as Markdown; formulas stand in it in the claim language.
pub fn markdown(reports: &[Report]) -> String {
    let mut text = format!("# Errata\n\n{}\n", summary(reports));
    for (section, entries) in sections(reports) {
        let _ = write!(text, "\n## {}\n\n{}\n", section.title(), section.lead());
        for report in entries {
            let _ = write!(text, "\n### {}\n\n", heading(report));
            for (label, content) in facts(section, report) {
                let content = match content {
                    Content::Words(words) => plain_markdown(&words),
                    Content::Quote(words) => format!("“{}”", plain_markdown(&words)),
                    Content::Statement(code) | Content::Condition(code) | Content::Code(code) => {
                        format!("`{code}`")
                    }
                };
                let _ = writeln!(text, "- {label}: {content}");
            }
        }
    }
    text
}

/// The same sheet as a LaTeX document; formulas are typeset.
pub fn latex(reports: &[Report]) -> String {
    let mut text = format!(
        "{}\\section*{{Errata}}\n{}\n",
        latex::HEAD,
        escape(&summary(reports))
    );
    for (section, entries) in sections(reports) {
        let (title, lead) = (escape(section.title()), escape(section.lead()));
        let _ = writeln!(text, "\n\\subsection*{{{title}}}\n{lead}");
        for report in entries {
            let _ = writeln!(text, "\n\\paragraph{{{}}}", escape(&heading(report)));
            text.push_str("\\begin{description}\n");
            for (label, content) in facts(section, report) {
                let content = match content {
                    Content::Words(words) => escape(&words),
                    Content::Quote(words) => format!("``{}''", escape(&words)),
                    Content::Statement(code) => typeset_or_code(
                        &code,
                        parse_statement(&code)
                            .ok()
                            .map(|tree| typeset::statement(&tree)),
                    ),
                    Content::Condition(code) => typeset_or_code(
                        &code,
                        parse_condition(&code)
                            .ok()
                            .map(|tree| typeset::condition(&tree)),
                    ),
                    Content::Code(code) => typeset_or_code(&code, None),
                };
                let _ = writeln!(text, "\\item[{}] {content}", escape(label));
            }
            text.push_str("\\end{description}\n");
        }
    }
    text + "\\end{document}\n"
}

/// The formula as mathematics, or what could not be read as it is written.
fn typeset_or_code(code: &str, math: Option<String>) -> String {
    match math {
        Some(math) => format!("$\\displaystyle {math}$"),
        None => format!("\\texttt{{{}}}", escape(code)),
    }
}

/// Words in which Markdown finds nothing of its own.
fn plain_markdown(words: &str) -> String {
    let mut text = String::with_capacity(words.len());
    for c in words.chars() {
        if "\\`*_[]<>|~".contains(c) {
            text.push('\\');
        }
        text.push(c);
    }
    text
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Wrong,
    ConditionMissing,
    Slip,
    Text,
}

impl Section {
    const ALL: [Section; 4] = [
        Section::Wrong,
        Section::ConditionMissing,
        Section::Slip,
        Section::Text,
    ];

    /// The section that a claim belongs to, if it is an erratum at all.
    fn of(report: &Report) -> Option<Section> {
        match Outcome::of(&report.printed) {
            Outcome::Verdict(Verdict::Refuted | Verdict::IllTyped) => Some(Section::Wrong),
            Outcome::ConditionMissing => Some(Section::ConditionMissing),
            _ if report.slip.is_none() => None,
            _ if report.kind == Kind::Words => Some(Section::Text),
            _ => Some(Section::Slip),
        }
    }

    fn title(self) -> &'static str {
        match self {
            Section::Wrong => "Wrong statements",
            Section::ConditionMissing => "Conditions missing",
            Section::Slip => "Slips of notation",
            Section::Text => "Errata of the text",
        }
    }

    fn lead(self) -> &'static str {
        match self {
            Section::Wrong => "Each fails at the point that is given with it, or has no meaning.",
            Section::ConditionMissing => {
                "Each holds, but not without a condition that is not printed."
            }
            Section::Slip => "Each makes no sense as printed; it was read as meant, and so judged.",
            Section::Text => "These were read by a person, not computed.",
        }
    }

    fn count(self, n: usize) -> String {
        match self {
            Section::Wrong => counted(n, "wrong statement"),
            Section::ConditionMissing if n == 1 => "1 statement that lacks a condition".to_owned(),
            Section::ConditionMissing => format!("{n} statements that lack a condition"),
            Section::Slip if n == 1 => "1 slip of notation".to_owned(),
            Section::Slip => format!("{n} slips of notation"),
            Section::Text if n == 1 => "1 erratum of the text".to_owned(),
            Section::Text => format!("{n} errata of the text"),
        }
    }
}

/// The sections that have entries; in each what misleads most comes first.
fn sections(reports: &[Report]) -> Vec<(Section, Vec<&Report>)> {
    let filled = Section::ALL.into_iter().filter_map(|section| {
        let of_it = |report: &&Report| Section::of(report) == Some(section);
        let mut entries: Vec<&Report> = reports.iter().filter(of_it).collect();
        // Stable: what misleads alike stays in the order of the book.
        entries.sort_by(|a, b| {
            let ((group, size), (other, other_size)) = (misleads(a), misleads(b));
            group.cmp(&other).then(other_size.total_cmp(&size))
        });
        (!entries.is_empty()).then_some((section, entries))
    });
    filled.collect()
}

/// The group of an erratum, the worst first, and within the first how far the sides lie apart.
fn misleads(report: &Report) -> (u8, f64) {
    let Some(witness) = &report.printed.witness else {
        return (4, 0.0);
    };
    match (witness.because, &witness.values, witness.difference) {
        (Cause::Duty, ..) => (3, 0.0),
        (Cause::Remainder, ..) => (2, 0.0),
        (_, _, Some(apart)) => (0, apart),
        // Infinite against finite.
        (_, [Some(_), Some(_)], None) => (0, f64::INFINITY),
        _ => (1, 0.0),
    }
}

/// How many errata there are of each kind, and what the sheet does not speak of.
fn summary(reports: &[Report]) -> String {
    let sections = sections(reports);
    let mut counts: Vec<String> = sections
        .iter()
        .map(|(section, entries)| section.count(entries.len()))
        .collect();
    let claims = counted(reports.len(), "claim");
    let mut text = match (counts.pop(), counts.is_empty()) {
        (None, _) => format!("No errata were found among {claims}."),
        (Some(only), true) => format!("Among {claims}: {only}."),
        (Some(last), false) => {
            format!("Among {claims}: {} and {last}.", counts.join(", "))
        }
    };
    if !sections.is_empty() {
        text.push_str(" In each section those come first that mislead a reader most.");
    }
    let undecided = |report: &&Report| report.printed.verdict == Verdict::Undecided;
    match reports.iter().filter(undecided).count() {
        0 => (),
        1 => text.push_str(" One statement is undecided; nothing is said of it here."),
        n => {
            let _ = write!(
                text,
                " {n} statements are undecided; nothing is said of them here."
            );
        }
    }
    text
}

fn heading(report: &Report) -> String {
    match &report.page {
        Some(page) => format!("{}, page {page}", report.id),
        None => report.id.clone(),
    }
}

/// What stands behind a label.
enum Content {
    Words(String),
    Quote(String),
    Statement(String),
    Condition(String),
    /// A point or values, in the claim language.
    Code(String),
}

/// The lines of one entry.
fn facts(section: Section, report: &Report) -> Vec<(&'static str, Content)> {
    let mut facts = Vec::new();
    if let Some(quote) = &report.quote {
        facts.push(("text", Content::Quote(quote.clone())));
    }
    if report.kind != Kind::Words {
        facts.push(("print", Content::Statement(report.printed.written.clone())));
    }
    let mended = report.mended.as_ref();
    if let Some(other) = mended.filter(|mended| mended.written != report.printed.written) {
        facts.push(("should be", Content::Statement(other.written.clone())));
    }
    if let Some(needs) = &report.needs {
        let label = if report.sufficient {
            "holds if"
        } else {
            "holds only if"
        };
        facts.push((label, Content::Condition(needs.clone())));
    }
    if let Some(witness) = &report.printed.witness {
        witnessed(witness, &mut facts);
    }
    if let Some(reason) = &report.printed.reason {
        facts.push(("reason", Content::Words(reason.clone())));
    }
    if let Some(slip) = &report.slip {
        let label = match section {
            Section::Text => "read, not computed",
            _ => "slip",
        };
        facts.push((label, Content::Words(slip.clone())));
    }
    match (section, mended) {
        (_, Some(mended)) => facts.push(("the correction is", Content::Words(shown(mended)))),
        (Section::Slip, None) => {
            facts.push(("so read it is", Content::Words(shown(&report.printed))));
        }
        _ => (),
    }
    if let Some(why) = &report.why {
        facts.push(("why", Content::Words(why.clone())));
    }
    facts
}

fn witnessed(witness: &WitnessReport, facts: &mut Vec<(&'static str, Content)>) {
    let [left, right] = sides(witness);
    facts.push(("fails at", Content::Code(place(witness))));
    if witness.because == Cause::Remainder {
        facts.push(("the remainder is", Content::Code(left.to_owned())));
        facts.push(("the print says", Content::Code(right.to_owned())));
        return;
    }
    facts.push(("left side there", Content::Code(left.to_owned())));
    facts.push(("right side there", Content::Code(right.to_owned())));
    if let Some(apart) = witness.difference {
        facts.push(("they differ by", Content::Words(percent(apart))));
    }
}

/// A share of the larger value.
fn percent(share: f64) -> String {
    match share >= 1e-3 {
        true => format!("{:.1} % of the larger", 100.0 * share),
        false => format!("{share:.2e} of the larger"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::human::sample::{errata, run};
    use super::*;

    #[test]
    fn sheet_in_markdown() {
        insta::assert_snapshot!(markdown(&errata()));
    }

    #[test]
    fn sheet_in_latex() {
        insta::assert_snapshot!(latex(&errata()));
    }

    #[test]
    fn a_book_without_errata() {
        let reports: Vec<Report> = run().reports.drain(1..3).collect();
        let text = markdown(&reports);
        assert!(
            text.starts_with("# Errata\n\nNo errata were found among 2 claims."),
            "{text}"
        );
        assert!(text.contains("One statement is undecided"), "{text}");
    }

    #[test]
    fn the_order_is_how_much_they_mislead_not_their_ids() {
        let reports = errata();
        let order: Vec<&str> = sections(&reports)
            .into_iter()
            .flat_map(|(_, entries)| entries)
            .map(|report| report.id.as_str())
            .collect();
        let expected = [
            "infinite",
            "far",
            "near",
            "one-sided",
            "order",
            "duty",
            "no-sense",
            "2.14",
            "slip",
            "text",
        ];
        assert_eq!(order, expected);
    }
}
