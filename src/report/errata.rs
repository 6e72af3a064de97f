//! The errata sheet: for the paper's author, what misleads a reader most first.
//!
//! The order is computed, never that of the ids: by how far the two sides of a statement lie apart
//! where it fails.

use super::latex::escape;
use super::tally::Outcome;
use super::words::{counted, place, shown, sides};
use super::{latex, typeset};
use crate::formula::{parse_condition, parse_statement};
use crate::judge::{Answer, Cause, Kind, Report, Verdict, WitnessReport};
use std::fmt::Write;

/// The sheet as Markdown; formulas stand in it in the claim language.
pub fn markdown(reports: &[Report]) -> String {
    let mut text = format!("# Errata\n\n{}\n", summary(reports));
    for (section, mistakes) in sections(reports) {
        let _ = write!(text, "\n## {}\n\n{}\n", section.title(), section.lead());
        for mistake in mistakes {
            let _ = write!(text, "\n### {}\n\n", mistake.title(markdown_content));
            for (label, content) in mistake.described() {
                let _ = writeln!(text, "- {label}: {}", markdown_content(content));
            }
            for (place, line) in mistake.listed(markdown_content) {
                let _ = writeln!(text, "- **{place}**: {line}");
            }
        }
    }
    text
}

fn markdown_content(content: Content) -> String {
    match content {
        Content::Words(words) => plain_markdown(&words),
        Content::Quote(words) => format!("“{}”", plain_markdown(&words)),
        Content::Statement(code) | Content::Condition(code) | Content::Code(code) => {
            format!("`{code}`")
        }
    }
}

/// The same sheet as a LaTeX document; formulas are typeset.
pub fn latex(reports: &[Report]) -> String {
    let mut text = format!(
        "{}\\section*{{Errata}}\n{}\n",
        latex::HEAD,
        escape(&summary(reports))
    );
    for (section, mistakes) in sections(reports) {
        let (title, lead) = (escape(section.title()), escape(section.lead()));
        let _ = writeln!(text, "\n\\subsection*{{{title}}}\n{lead}");
        for mistake in mistakes {
            let _ = writeln!(text, "\n\\paragraph{{{}}}", mistake.title(latex_content));
            text.push_str("\\begin{description}\n");
            for (label, content) in mistake.described() {
                let _ = writeln!(text, "\\item[{}] {}", escape(label), latex_content(content));
            }
            for (place, line) in mistake.listed(latex_content) {
                let _ = writeln!(text, "\\item[{}] {line}", escape(&place));
            }
            text.push_str("\\end{description}\n");
        }
    }
    text + "\\end{document}\n"
}

fn latex_content(content: Content) -> String {
    match content {
        Content::Words(words) => escape(&words),
        Content::Quote(words) => format!("``{}''", escape(&words)),
        Content::Statement(code) => {
            let tree = parse_statement(&code).ok();
            typeset_or_code(&code, tree.map(|tree| typeset::statement(&tree)))
        }
        Content::Condition(code) => {
            let tree = parse_condition(&code).ok();
            typeset_or_code(&code, tree.map(|tree| typeset::condition(&tree)))
        }
        Content::Code(code) => typeset_or_code(&code, None),
    }
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
    Scan,
}

impl Section {
    const ALL: [Section; 5] = [
        Section::Wrong,
        Section::ConditionMissing,
        Section::Slip,
        Section::Text,
        Section::Scan,
    ];

    /// The section that a claim belongs to, if it is an erratum at all.
    fn of(report: &Report) -> Option<Section> {
        match Outcome::of(&report.printed) {
            Outcome::Verdict(Verdict::Refuted | Verdict::IllTyped) => Some(Section::Wrong),
            Outcome::ConditionMissing => Some(Section::ConditionMissing),
            _ if report.slip.is_none() => report.scan.as_ref().map(|_| Section::Scan),
            _ if report.kind == Kind::Words => Some(Section::Text),
            _ => Some(Section::Slip),
        }
    }

    /// What the entries of one mistake have in common.
    fn key(self, report: &Report) -> &str {
        let common = match self {
            Section::ConditionMissing => report.needs.as_deref(),
            Section::Slip | Section::Text => report.slip.as_deref(),
            Section::Scan => report.scan.as_deref(),
            Section::Wrong => None,
        };
        common.unwrap_or(&report.id)
    }

    /// Whether what the places have in common says all, and each takes a line.
    fn lists(self) -> bool {
        matches!(self, Section::ConditionMissing | Section::Scan)
    }

    fn title(self) -> &'static str {
        match self {
            Section::Wrong => "Wrong statements",
            Section::ConditionMissing => "Conditions missing",
            Section::Slip => "Slips of notation",
            Section::Text => "Errata of the text",
            Section::Scan => "Left open by the copy at hand",
        }
    }

    fn lead(self) -> &'static str {
        match self {
            Section::Wrong => "Each fails at the point that is given with it, or has no meaning.",
            Section::ConditionMissing => {
                "Each holds under a condition that is not printed; they are listed by it."
            }
            Section::Slip => "Each makes no sense as printed; it was read as meant, and so judged.",
            Section::Text => "These were read by a person, not computed.",
            Section::Scan => {
                "One look at the paper decides; each was read in its favour, and is no fault of it so far."
            }
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
            Section::Scan if n == 1 => "1 place that the copy leaves open".to_owned(),
            Section::Scan => format!("{n} places that the copy leaves open"),
        }
    }
}

/// One mistake in all places where it stands.
struct Mistake<'a> {
    section: Section,
    /// The place that tells most; the others follow in the order of the book.
    first: &'a Report,
    others: Vec<&'a Report>,
}

impl<'a> Mistake<'a> {
    fn places(&self) -> impl Iterator<Item = &'a Report> {
        std::iter::once(self.first).chain(self.others.iter().copied())
    }

    /// What the places have in common, where that is all there is to say; else the first of them.
    fn title(&self, render: fn(Content) -> String) -> String {
        let one = self.others.is_empty();
        match (self.section, &self.first.needs, &self.first.scan) {
            (Section::ConditionMissing, Some(needs), _) => {
                let holds = if one { "Holds" } else { "Hold" };
                let only = if self.first.sufficient { "" } else { "only " };
                let needs = render(Content::Condition(needs.clone()));
                format!("{holds} {only}if {needs}")
            }
            (Section::Scan, _, Some(scan)) => render(Content::Words(scan.clone())),
            _ => render(Content::Words(heading(self.first))),
        }
    }

    /// What is told in full.
    fn described(&self) -> Vec<(&'static str, Content)> {
        match self.section.lists() {
            true => Vec::new(),
            false => facts(self.section, self.first),
        }
    }

    /// The other places, each on one line.
    fn listed(&self, render: fn(Content) -> String) -> Vec<(String, String)> {
        let (told, also) = match self.section.lists() {
            true => (0, ""),
            false => (1, "also "),
        };
        let line = |report: &Report| {
            let parts: Vec<String> = facts(self.section, report)
                .into_iter()
                .map(|(label, content)| format!("{label}: {}", render(content)))
                .collect();
            (format!("{also}{}", heading(report)), parts.join("; "))
        };
        self.places().skip(told).map(line).collect()
    }

    /// What misleads most comes first: by the worst of its places, then by their number.
    fn rank(&self) -> (u8, f64, usize) {
        let worst = self.places().map(misleads);
        let worst = worst.min_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        let (group, apart) = worst.unwrap_or((u8::MAX, 0.0));
        (group, apart, 1 + self.others.len())
    }
}

/// The sections that have entries; in each what misleads most comes first.
fn sections(reports: &[Report]) -> Vec<(Section, Vec<Mistake<'_>>)> {
    let filled = Section::ALL.into_iter().filter_map(|section| {
        let of_it = |report: &&Report| Section::of(report) == Some(section);
        let mut mistakes = mistakes(section, &reports.iter().filter(of_it).collect::<Vec<_>>());
        // Stable: what misleads alike stays in the order of the book.
        mistakes.sort_by(|a, b| {
            let ((group, apart, places), (other, less, fewer)) = (a.rank(), b.rank());
            group
                .cmp(&other)
                .then(less.total_cmp(&apart))
                .then(fewer.cmp(&places))
        });
        (!mistakes.is_empty()).then_some((section, mistakes))
    });
    filled.collect()
}

/// The entries of a section, those of one mistake together: what is said to be like another, and what
/// lacks the same condition, or has the same slip.
fn mistakes<'a>(section: Section, entries: &[&'a Report]) -> Vec<Mistake<'a>> {
    let mut mistakes: Vec<Mistake<'a>> = Vec::new();
    for report in entries {
        let first = first_like(report, entries);
        let same = |mistake: &Mistake| section.key(mistake.first) == section.key(first);
        let at = mistakes.iter().position(same).unwrap_or(mistakes.len());
        if at == mistakes.len() {
            mistakes.push(Mistake {
                section,
                first,
                others: Vec::new(),
            });
        }
        // The first may stand behind one that is like it.
        if report.id != mistakes[at].first.id {
            mistakes[at].others.push(report);
        }
    }
    mistakes
}

/// The entry that this one is like, or that one is like, to the last that is like no other; itself where
/// they go round in a circle.
fn first_like<'a>(report: &'a Report, entries: &[&'a Report]) -> &'a Report {
    let mut first = report;
    for _ in entries {
        let like = first.like.as_ref();
        match like.and_then(|like| entries.iter().find(|entry| entry.id == *like)) {
            Some(entry) => first = entry,
            None => return first,
        }
    }
    report
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
        // Infinite against finite: all of it.
        (_, [Some(_), Some(_)], None) => (0, 1.0),
        _ => (1, 0.0),
    }
}

/// How many errata there are of each kind, and what the sheet does not speak of.
fn summary(reports: &[Report]) -> String {
    let sections = sections(reports);
    let mut counts: Vec<String> = sections
        .iter()
        .map(|(section, mistakes)| {
            let places = mistakes
                .iter()
                .map(|mistake| mistake.places().count())
                .sum();
            let count = section.count(places);
            match (section, mistakes.len()) {
                (Section::Wrong, n) if n < places => {
                    format!("{count} by {}", counted(n, "mistake"))
                }
                _ => count,
            }
        })
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
        1 => text.push_str(" One statement is undecided; whether it holds is not said here."),
        n => {
            let _ = write!(
                text,
                " {n} statements are undecided; whether they hold is not said here."
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

/// The lines of one entry. A condition that stands above a list of entries is not told again.
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
    if let Some(needs) = report
        .needs
        .as_ref()
        .filter(|_| section != Section::ConditionMissing)
    {
        let label = if report.sufficient {
            "which holds if"
        } else {
            "which holds only if"
        };
        facts.push((label, Content::Condition(needs.clone())));
    }
    if let Some(witness) = &report.printed.witness {
        witnessed(witness, report.kind, &mut facts);
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
    if let Some(scan) = report.scan.as_ref().filter(|_| section != Section::Scan) {
        facts.push(("the copy", Content::Words(scan.clone())));
    }
    match (section, mended) {
        (Section::ConditionMissing, Some(mended)) => {
            facts.push(("with it", Content::Words(backed(mended))));
        }
        (_, Some(mended)) => facts.push(("the correction is", Content::Words(backed(mended)))),
        (Section::Slip | Section::Scan, None) => {
            facts.push(("so read it is", Content::Words(backed(&report.printed))));
        }
        _ => (),
    }
    if let Some(why) = &report.why {
        facts.push(("why", Content::Words(why.clone())));
    }
    facts
}

/// A verdict with what shows it, and what that is worth.
fn backed(answer: &Answer) -> String {
    match answer.verdict {
        Verdict::Certified => format!("{}, not proved", shown(answer)),
        _ => shown(answer),
    }
}

fn witnessed(witness: &WitnessReport, kind: Kind, facts: &mut Vec<(&'static str, Content)>) {
    let [left, right] = sides(witness);
    if witness.because == Cause::Remainder {
        facts.push(("for example with", Content::Code(place(witness))));
        facts.push(("the remainder is", Content::Code(left.to_owned())));
        facts.push(("which is not", Content::Code(right.to_owned())));
        return;
    }
    let place = Content::Code(place(witness));
    facts.push(match witness.relation {
        // In a chain the right side of a relation is the left side of the next.
        Some(1) | None => ("fails at", place),
        Some(2) => ("the second relation fails at", place),
        Some(3) => ("the third relation fails at", place),
        Some(_) => ("a later relation fails at", place),
    });
    facts.push(("left side there", Content::Code(left.to_owned())));
    facts.push(("right side there", Content::Code(right.to_owned())));
    if let Some(apart) = witness.difference.filter(|_| kind == Kind::Identity) {
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
    fn what_is_like_each_other_is_told_once_each() {
        let mut reports = errata();
        for (id, like) in [("near", "far"), ("far", "near")] {
            let report = reports.iter_mut().find(|report| report.id == id);
            report.expect("in the sample").like = Some(like.to_string());
        }
        let wrong = sections(&reports).remove(0).1;
        let places: usize = wrong.iter().map(|mistake| mistake.places().count()).sum();
        assert_eq!(places, 8);
    }

    #[test]
    fn the_order_is_how_much_they_mislead_not_their_ids() {
        let reports = errata();
        let order: Vec<&str> = sections(&reports)
            .into_iter()
            .flat_map(|(_, mistakes)| mistakes)
            .flat_map(|mistake| mistake.places().collect::<Vec<_>>())
            .map(|report| report.id.as_str())
            .collect();
        let expected = [
            "infinite",
            "far",
            "near",
            "near-again",
            "one-sided",
            "order",
            "duty",
            "no-sense",
            "2.14",
            "2.15",
            "slip",
            "text",
            "open",
        ];
        assert_eq!(order, expected);
    }
}
