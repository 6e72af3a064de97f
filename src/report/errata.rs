//! The errata sheet: what the print says, what it should say, and a point where it fails.

use super::latex;
use super::tally::Outcome;
use crate::judge::{Answer, Report, Verdict, WitnessReport};
use std::fmt::Write;

/// The sheet as Markdown: wrong statements first, then missing conditions, then slips of notation.
pub fn markdown(reports: &[Report]) -> String {
    let mut text = String::from("# Errata\n");
    for (title, entries) in sections(reports) {
        let _ = write!(text, "\n## {title}\n");
        for report in entries {
            let _ = write!(text, "\n### {}\n\n", report.id);
            for (label, content, code) in facts(report) {
                let content = if code {
                    format!("`{content}`")
                } else {
                    content
                };
                let _ = writeln!(text, "- {label}: {content}");
            }
        }
    }
    text
}

/// The same sheet as a LaTeX document; formulas stand in it in the claim language.
pub fn latex(reports: &[Report]) -> String {
    let mut text = String::from(
        "\\documentclass{article}\n\\usepackage[T1]{fontenc}\n\\begin{document}\n\\sloppy\n\\section*{Errata}\n",
    );
    for (title, entries) in sections(reports) {
        let _ = writeln!(text, "\\subsection*{{{}}}", latex::escape(title));
        for report in entries {
            let _ = writeln!(text, "\\paragraph{{{}}}", latex::escape(&report.id));
            for (label, content, code) in facts(report) {
                let content = latex::escape(&content);
                let content = if code {
                    format!("\\texttt{{{content}}}")
                } else {
                    content
                };
                let _ = writeln!(text, "\\par {}: {content}", latex::escape(label));
            }
        }
    }
    text + "\\end{document}\n"
}

/// The sections that have entries.
fn sections(reports: &[Report]) -> Vec<(&'static str, Vec<&Report>)> {
    let wrong = |r: &Report| Outcome::of(&r.printed) == Outcome::Verdict(Verdict::Refuted);
    let ill = |r: &Report| r.printed.verdict == Verdict::IllTyped;
    let missing = |r: &Report| Outcome::of(&r.printed) == Outcome::ConditionMissing;
    let chosen = |test: &dyn Fn(&Report) -> bool| reports.iter().filter(|r| test(r)).collect();
    let all: [(&'static str, Vec<&Report>); 3] = [
        ("Wrong statements", chosen(&|r| wrong(r) || ill(r))),
        ("Conditions missing", chosen(&missing)),
        (
            "Slips of notation",
            chosen(&|r| !wrong(r) && !ill(r) && !missing(r) && r.slip.is_some()),
        ),
    ];
    all.into_iter()
        .filter(|(_, entries)| !entries.is_empty())
        .collect()
}

/// The lines of one entry: label, content, whether the content is a formula.
fn facts(report: &Report) -> Vec<(&'static str, String, bool)> {
    let mut facts = vec![("printed", report.printed.written.clone(), true)];
    let mended = report.mended.as_ref();
    let other = mended.filter(|mended| mended.written != report.printed.written);
    if let Some(other) = other {
        facts.push(("should be", other.written.clone(), true));
    }
    if let Some(needs) = &report.needs {
        facts.push(("needs", needs.clone(), true));
    }
    if let Some(mended) = mended {
        facts.push(("then it is", verdict(mended), false));
    }
    if let Some(found) = &report.printed.witness {
        facts.push(("fails at", witness(found), false));
    }
    let words = [
        ("reason", &report.printed.reason),
        ("why", &report.why),
        ("slip", &report.slip),
    ];
    for (label, content) in words {
        if let Some(content) = content {
            facts.push((label, content.clone(), false));
        }
    }
    facts
}

fn verdict(answer: &Answer) -> String {
    match &answer.extent {
        Some(e) if answer.verdict == Verdict::Certified => {
            format!("certified at {} points to {} digits", e.points, e.digits)
        }
        _ => answer.verdict.word().to_owned(),
    }
}

fn witness(witness: &WitnessReport) -> String {
    let at: Vec<String> = witness
        .point
        .iter()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    let side = |value: &Option<String>| value.clone().unwrap_or_else(|| "no value".to_owned());
    let [left, right] = &witness.values;
    format!(
        "{}: left {}, right {}",
        at.join(", "),
        side(left),
        side(right)
    )
}

#[cfg(test)]
mod tests {
    use super::super::human::sample::run;
    use super::*;

    #[test]
    fn sheet_in_markdown() {
        insta::assert_snapshot!(markdown(&run().reports));
    }

    #[test]
    fn sheet_in_latex() {
        let text = latex(&run().reports);
        assert!(
            text.contains(r"\texttt{var(Ihat) == I\textasciicircum{}2*k"),
            "{text}"
        );
        assert!(text.contains(r"needs: \texttt{k >{}= 3}"), "{text}");
    }
}
