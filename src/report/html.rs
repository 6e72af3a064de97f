//! The report as one page that needs nothing else: a row a claim, its evidence, all else on demand.
//!
//! A verdict is a word and a sign, and only then a colour. The choice of rows is plain CSS, so there
//! is no script; whatever comes from the book is escaped.

use super::tally::{self, Outcome, outcomes};
use super::words::{counted, place, reach, sides};
use crate::corpus::Run;
use crate::judge::{Answer, Cause, Report, Verdict, WitnessReport};
use std::fmt::Write;

/// The whole page.
pub fn render(run: &Run) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>claimcheck: {}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n",
        counted(run.reports.len(), "claim"),
        include_str!("html/style.css"),
        filters(),
    );
    page.push_str(&head(run));
    page.push_str(
        "<table class=\"claims\">\n<colgroup><col class=\"id\"><col><col><col class=\"expected\"></colgroup>\n\
         <thead><tr><th>claim</th><th>as printed</th><th>mended</th><th>expected</th></tr></thead>\n",
    );
    for report in &run.reports {
        page.push_str(&claim(report));
    }
    page.push_str("</table>\n</body>\n</html>\n");
    page
}

/// The text with nothing in it that HTML reads as its own.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c if c.is_control() && c != '\n' => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

/// A choice of rows that is no outcome.
const UNEXPECTED: &str = "unexpected";

/// The rows that a choice hides.
fn filters() -> String {
    let keys = outcomes().map(Outcome::key).chain([UNEXPECTED]);
    keys.map(|key| {
        format!("body:has(#show-{key}:checked) .claims tbody:not(.{key}) {{ display: none; }}\n")
    })
    .collect()
}

/// Sign, words and class of an outcome.
fn look(outcome: Outcome) -> (&'static str, &'static str, &'static str) {
    match outcome {
        Outcome::ConditionMissing => ("△", "condition missing", "warn"),
        Outcome::Verdict(verdict) => match verdict {
            Verdict::Proved => ("✓", "proved", "good"),
            Verdict::Certified => ("✓", "certified", "good"),
            Verdict::Defined => ("✓", "defined", "good"),
            Verdict::Refuted => ("✗", "refuted", "bad"),
            Verdict::IllTyped => ("✗", "illtyped", "bad"),
            Verdict::Undecided => ("?", "undecided", "open"),
            Verdict::Vacuous => ("∅", "vacuous", "open"),
            Verdict::Noted => ("–", "noted", "faint"),
        },
    }
}

fn head(run: &Run) -> String {
    let reports = &run.reports;
    let mut text = format!("<h1>Report on {}</h1>\n", counted(reports.len(), "claim"));
    let unexpected = tally::unexpected(reports);
    let verdict = match unexpected {
        0 => "<span class=\"verdict good\">✓ All as expected</span>".to_owned(),
        n => format!("<span class=\"verdict bad\">✗ {n} not as expected</span>"),
    };
    let stands = [Verdict::Proved, Verdict::Certified, Verdict::Defined];
    let stand = stands.map(|verdict| tally::count(reports, Outcome::Verdict(verdict)));
    let _ = writeln!(
        text,
        "<p>{verdict}. {} of {} stand as printed; undecided and noted claims are no passes.</p>\n\
         <p class=\"faint\">claimcheck {}, seed {}, {} digits</p>",
        stand.iter().sum::<usize>(),
        counted(reports.len(), "statement"),
        env!("CARGO_PKG_VERSION"),
        run.seed,
        run.digits
    );
    text.push_str(&counts(reports));
    text.push_str(&choices(reports));
    text
}

/// How many prints and how many mended statements came to what.
fn counts(reports: &[Report]) -> String {
    let printed: Vec<Outcome> = reports.iter().map(|r| Outcome::of(&r.printed)).collect();
    let mended = reports.iter().filter_map(|report| report.mended.as_ref());
    let mended: Vec<Outcome> = mended.map(Outcome::of).collect();
    let mut text = String::from("<table class=\"counts\">\n<tr><th></th>");
    for outcome in outcomes() {
        let (sign, words, class) = look(outcome);
        let _ = write!(text, "<th class=\"{class}\">{sign} {words}</th>");
    }
    text.push_str("</tr>\n");
    for (label, found) in [("print", printed), ("mended", mended)] {
        let _ = write!(text, "<tr><th>{label}</th>");
        for outcome in outcomes() {
            let count = found.iter().filter(|other| **other == outcome).count();
            let class = if count == 0 { " class=\"zero\"" } else { "" };
            let _ = write!(text, "<td{class}>{count}</td>");
        }
        text.push_str("</tr>\n");
    }
    text + "</table>\n"
}

/// Which rows are shown: by the verdict on the print.
fn choices(reports: &[Report]) -> String {
    let mut text = String::from("<fieldset class=\"show\">\n");
    let mut choice = |key: &str, words: &str, count: usize, checked: &str| {
        let _ = writeln!(
            text,
            "<label><input type=\"radio\" name=\"show\" id=\"show-{key}\"{checked}> {words} ({count})</label>"
        );
    };
    choice("all", "all claims", reports.len(), " checked");
    for outcome in outcomes() {
        let count = tally::count(reports, outcome);
        if count > 0 {
            let (_, words, _) = look(outcome);
            choice(outcome.key(), words, count, "");
        }
    }
    choice(
        UNEXPECTED,
        "not as expected",
        tally::unexpected(reports),
        "",
    );
    text + "</fieldset>\n"
}

fn claim(report: &Report) -> String {
    let key = Outcome::of(&report.printed).key();
    let (unexpected, expected) = match report.as_expected {
        true => ("", "<span class=\"verdict good\">✓ as expected</span>"),
        false => (
            " unexpected",
            "<span class=\"verdict bad\">✗ not as expected</span>",
        ),
    };
    let id = escape(&report.id);
    let page = match &report.page {
        Some(page) => format!("<br><small>page {}</small>", escape(page)),
        None => String::new(),
    };
    format!(
        "<tbody class=\"{key}{unexpected}\" id=\"{id}\">\n\
         <tr><th scope=\"row\"><a href=\"#{id}\">{id}</a>{page}</th>\n\
         <td>{}</td>\n<td>{}</td>\n<td><p>{expected}</p><small>{}</small></td></tr>\n\
         <tr class=\"more\"><td></td><td colspan=\"3\">{}</td></tr>\n</tbody>\n",
        answer(&report.printed, true),
        mended(report),
        escape(tally::expected(report)),
        details(report)
    )
}

fn mended(report: &Report) -> String {
    let mut text = String::new();
    if let Some(needs) = &report.needs {
        let sufficient = if report.sufficient {
            " (sufficient)"
        } else {
            ""
        };
        let _ = write!(
            text,
            "<p>needs <code>{}</code>{sufficient}</p>",
            escape(needs)
        );
    }
    if let Some(fault) = &report.needs_fault {
        let _ = write!(text, "<p class=\"bad\">{}</p>", escape(fault));
    }
    if let Some(mended) = &report.mended {
        text.push_str(&answer(mended, mended.written != report.printed.written));
    }
    text
}

/// The statement as written, the verdict, and what shows it.
fn answer(answer: &Answer, with_statement: bool) -> String {
    let mut text = String::new();
    if with_statement {
        let _ = write!(text, "<p><code>{}</code></p>", escape(&answer.written));
    }
    let (sign, words, class) = look(Outcome::of(answer));
    let _ = write!(
        text,
        "<p><span class=\"verdict {class}\">{sign} {words}</span>"
    );
    if let Some(evidence) = evidence(answer) {
        let _ = write!(text, " <small>{}</small>", escape(&evidence));
    }
    text.push_str("</p>");
    if let Some(found) = &answer.witness {
        let _ = write!(text, "<p><small>{}</small></p>", escape(&witness(found)));
    }
    text
}

fn evidence(answer: &Answer) -> Option<String> {
    match (answer.verdict, &answer.extent) {
        (Verdict::Proved, _) => answer.certificate.clone(),
        (Verdict::Certified, Some(extent)) => Some(reach(extent)),
        (Verdict::Certified, None) => Some("by the exact series of both sides".to_owned()),
        _ => answer.reason.clone(),
    }
}

fn witness(witness: &WitnessReport) -> String {
    let ([left, right], place) = (sides(witness), place(witness));
    match witness.because {
        Cause::Remainder => format!("fails at {place}: the remainder is {left}, not {right}"),
        _ => format!("fails at {place}: left {left}, right {right}"),
    }
}

/// All that is known besides.
fn details(report: &Report) -> String {
    let mut items = String::new();
    let mut item = |label: &str, content: Option<String>| {
        if let Some(content) = content.filter(|content| !content.is_empty()) {
            let _ = writeln!(items, "<dt>{label}</dt><dd>{content}</dd>");
        }
    };
    let words = |text: &Option<String>| text.as_deref().map(escape);
    item(
        "text",
        report
            .quote
            .as_ref()
            .map(|quote| format!("“{}”", escape(quote))),
    );
    item("slip", words(&report.slip));
    item("scan", words(&report.scan));
    item("the same mistake as", words(&report.like));
    item("why", words(&report.why));
    for link in &report.printed.links {
        let verdict = format!("{}: {}", escape(&link.with), link.verdict.word());
        item("goes on from", Some(verdict));
    }
    let mended = report.mended.as_ref();
    for (label, answer) in [("the print", Some(&report.printed)), ("mended", mended)] {
        let Some(answer) = answer else { continue };
        let seen = escape(&answer.statement);
        let seen = (!seen.is_empty()).then(|| format!("<pre>{seen}</pre>"));
        item(&format!("{label}, as the kernel sees it"), seen);
        item(
            "set aside",
            answer
                .extent
                .filter(|extent| extent.set_aside > 0)
                .map(|extent| {
                    let points = counted(extent.set_aside, "point");
                    format!("{points} where neither side has a value")
                }),
        );
        item("series", words(&answer.series));
        item("facts used", Some(escape(&answer.facts.join("; "))));
        item("certificate", words(&answer.certificate));
    }
    let place = format!("{}:{}", escape(&report.file), report.line);
    item("place", Some(place));
    let work = format!("{} steps in {:.3} s", report.steps, report.seconds);
    item("work", Some(work));
    format!("<details><summary>all that is known</summary>\n<dl>\n{items}</dl></details>")
}

#[cfg(test)]
mod tests {
    use super::super::human::sample::{errata, run};
    use super::*;

    #[test]
    fn the_page_without_its_style() {
        let mut run = run();
        run.reports.extend(errata());
        let page = render(&run);
        let body = page.split_once("</style>").expect("a style").1;
        insta::assert_snapshot!(body);
    }

    #[test]
    fn nothing_of_the_book_is_markup() {
        let mut run = run();
        let evil = "<script>alert('1')</script>\" & \u{7}";
        for report in &mut run.reports {
            for words in [
                &mut report.id,
                &mut report.file,
                &mut report.expected,
                &mut report.printed.written,
                &mut report.printed.statement,
            ] {
                *words = evil.into();
            }
            for words in [
                &mut report.page,
                &mut report.quote,
                &mut report.slip,
                &mut report.scan,
                &mut report.like,
                &mut report.why,
                &mut report.needs,
                &mut report.needs_fault,
                &mut report.printed.reason,
                &mut report.printed.series,
                &mut report.printed.certificate,
            ] {
                *words = Some(evil.into());
            }
            report.printed.facts = vec![evil.into()];
            if let Some(witness) = &mut report.printed.witness {
                witness.point = [(evil.into(), evil.into())].into();
                witness.values = [Some(evil.into()), Some(evil.into())];
            }
        }
        let page = render(&run);
        assert!(
            !page.contains("<script") && !page.contains('\u{7}'),
            "{page}"
        );
        assert!(page.contains("&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;&quot; &amp;"));
    }

    #[test]
    fn the_page_needs_nothing_else() {
        let page = render(&run());
        for outside in ["http:", "https:", "src=", "url(", "@import", "<script"] {
            assert!(!page.contains(outside), "{outside}");
        }
    }
}
