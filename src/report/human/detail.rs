//! All that is known of one claim, as labelled lines.

use super::super::words::{counted, place, sides};
use super::simulation;
use super::tally;
use super::{BAD, FAINT, STRONG, WIDTH, WRONG, paint, style};
use crate::judge::{Answer, Extent, Report, Verdict, WitnessReport};

/// Where text begins, after its label.
const INDENT: usize = 12;

/// The claim's verdicts with their evidence, the print first.
pub fn render(report: &Report) -> String {
    let place = paint(FAINT, &format!("{}:{}", report.file, report.line));
    let mut text = format!("{} {place}\n", paint(STRONG, &report.id));
    optional(&mut text, "page", report.page.as_deref());
    optional(&mut text, "quote", report.quote.as_deref());
    line(&mut text, "expected", tally::expected(report));
    if !report.as_expected {
        text.push_str(&format!("  {}\n", paint(BAD, "not as expected")));
    }
    answer(&mut text, "printed", &report.printed);
    if let Some(mended) = &report.mended {
        answer(&mut text, "mended", mended);
    }
    let sufficient = if report.sufficient {
        " (sufficient, not shown necessary)"
    } else {
        ""
    };
    let needs = report
        .needs
        .as_ref()
        .map(|needs| format!("{needs}{sufficient}"));
    optional(&mut text, "needs", needs.as_deref());
    optional(&mut text, "needs is", report.needs_fault.as_deref());
    optional(&mut text, "slip", report.slip.as_deref());
    optional(&mut text, "scan", report.scan.as_deref());
    optional(&mut text, "like", report.like.as_deref());
    optional(&mut text, "why", report.why.as_deref());
    line(
        &mut text,
        "steps",
        &format!("{} in {:.3} s", report.steps, report.seconds),
    );
    text
}

fn answer(text: &mut String, label: &str, answer: &Answer) {
    let mut verdict = paint(style(answer.verdict), answer.verdict.word());
    if super::Outcome::of(answer) == super::Outcome::ConditionMissing {
        verdict.push_str(&format!(" ({})", paint(WRONG, "a condition is missing")));
    }
    // A proof holds at every point, whatever was tried before.
    if let Some(extent) = answer
        .extent
        .as_ref()
        .filter(|_| answer.verdict != Verdict::Proved)
    {
        verdict.push_str(&format!(" {}", extent_words(extent)));
    }
    text.push_str(&format!("  {label:<9} {verdict}\n"));
    line(text, "written", &answer.written);
    if !answer.statement.is_empty() && answer.statement != answer.written {
        line(text, "unfolded", &answer.statement.replace('\n', "; "));
    }
    optional(text, "because", answer.reason.as_deref());
    if let Some(found) = &answer.witness {
        witness(text, found);
    }
    for link in &answer.links {
        line(
            text,
            "after",
            &format!("{}: {}", link.with, link.verdict.word()),
        );
    }
    optional(text, "series", answer.series.as_deref());
    if let Some(constants) = &answer.constants {
        line(
            text,
            "constants",
            &format!("C = {}, k0 = {}", constants.factor, constants.k0),
        );
    }
    if answer.verdict != Verdict::Proved && !answer.proved_links.is_empty() {
        let links: Vec<String> = answer.proved_links.iter().map(usize::to_string).collect();
        line(text, "proved", &format!("links {}", links.join(", ")));
    }
    if !answer.facts.is_empty() {
        line(text, "rests on", &answer.facts.join(", "));
    }
    optional(text, "saved", answer.certificate.as_deref());
    let simulated = answer.simulation.as_ref().map(simulation::words);
    optional(text, "simulated", simulated.as_deref());
}

fn extent_words(extent: &Extent) -> String {
    let points = counted(extent.points, "point");
    let aside = match extent.set_aside {
        0 => String::new(),
        n => format!(" and {n} set aside, where neither side has a value"),
    };
    format!("at {points}{aside}, to {} digits", extent.digits)
}

fn witness(text: &mut String, witness: &WitnessReport) {
    line(
        text,
        "witness",
        &format!("{} ({})", place(witness), witness.because.word()),
    );
    for (label, value) in ["left", "right"].into_iter().zip(sides(witness)) {
        line(text, label, value);
    }
}

fn optional(text: &mut String, label: &str, content: Option<&str>) {
    if let Some(content) = content {
        line(text, label, content);
    }
}

/// A label and its content, broken at spaces; a word that is too long stands alone and is not broken.
fn line(text: &mut String, label: &str, content: &str) {
    let mut column = INDENT;
    text.push_str(&format!("  {}", paint(FAINT, &format!("{label:<9}"))));
    let mut first = true;
    for word in content.split_whitespace() {
        let length = word.chars().count();
        if !first && column + 1 + length > WIDTH {
            text.push('\n');
            text.push_str(&" ".repeat(INDENT - 1));
            column = INDENT - 1;
        }
        text.push(' ');
        text.push_str(word);
        column += 1 + length;
        first = false;
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn tells_all_that_is_known() {
        let all: Vec<String> = sample::run().reports.iter().map(render).collect();
        insta::assert_snapshot!(anstream::adapter::strip_str(&all.join("\n")).to_string());
    }

    #[test]
    fn long_lines_are_broken_at_spaces() {
        let mut text = String::new();
        line(&mut text, "written", &"abcdefghi ".repeat(40));
        let text = anstream::adapter::strip_str(&text).to_string();
        assert!(text.lines().count() > 3);
        assert!(text.lines().all(|l| l.chars().count() <= WIDTH), "{text}");
    }
}
