//! A proof as a person reads it: numbered steps, each with its reason, and the rules that they rest on.

use super::style::{FAINT, STRONG, WIDTH, paint, wrap};
use crate::book::{Claim, IllTyped};
use crate::formula::{Point, Proposition};
use crate::kernel::proof::{Certificate, Fact, Line, Rule, Script, Step, Variable};
use std::collections::BTreeSet;

/// Where a reason begins if it stands in the line of its step.
const REASON: usize = 50;

/// What a certificate may be about.
pub const PRINTED: &str = "the statement as printed";
pub const MENDED: &str = "the mended statement";
/// A certificate that has outlived its statement.
pub const OTHER: &str = "another statement than the claim's";

/// What the certificate is about.
pub fn title(claim: &Claim, certificate: &Certificate) -> &'static str {
    let about = match certificate {
        Certificate::Theorem(script) => &script.proposition,
        Certificate::Refutation { proposition, .. } => proposition,
    };
    let is = |proposition: Option<Result<Proposition, IllTyped>>| {
        proposition.is_some_and(|proposition| proposition.as_ref() == Ok(about))
    };
    match (is(Some(claim.printed())), is(claim.mended())) {
        (true, _) => PRINTED,
        (_, true) => MENDED,
        _ => OTHER,
    }
}

/// The claim as the book has it.
pub fn head(claim: &Claim) -> String {
    let mut page = Page::default();
    let place = format!("{}:{}", claim.file.display(), claim.line);
    page.title(&format!("{} {}", claim.id, paint(FAINT, &place)));
    let lines = [
        ("page", claim.page.as_ref()),
        ("quote", claim.quote.as_ref()),
        ("expect", claim.expect_text.as_ref()),
        ("says", Some(&claim.says_text)),
        ("mend", claim.mend_text.as_ref()),
        ("needs", claim.needs.as_ref().map(|needs| &needs.text)),
        ("slip", claim.slip.as_ref()),
        ("scan", claim.scan.as_ref()),
        ("why", claim.why.as_ref()),
    ];
    for (label, text) in lines {
        if let Some(text) = text {
            page.text(2, &format!("{label:<6} {text}"));
        }
    }
    page.text
}

/// A certificate in words; the title says what it is about.
pub fn render(title: &str, certificate: &Certificate) -> String {
    let mut page = Page::default();
    match certificate {
        Certificate::Theorem(script) => page.theorem(title, script),
        Certificate::Refutation {
            proposition,
            witness,
        } => {
            page.title(&format!("Refutation of {title}"));
            page.proposition(proposition);
            let fails = format!(
                "Link {} fails at {}.",
                witness.link + 1,
                place(&witness.point)
            );
            page.text(2, &fails);
        }
    }
    page.text
}

/// The values of the parameters at a point.
fn place(point: &Point) -> String {
    let numbers = point.numbers.iter();
    let mut parts: Vec<String> = numbers.map(|(name, v)| format!("{name} = {v}")).collect();
    let functions = point.functions.iter();
    parts.extend(functions.map(|(name, (x, body))| format!("{name}({x}) = {body}")));
    match parts.is_empty() {
        true => "the only point".to_owned(),
        false => parts.join(", "),
    }
}

#[derive(Default)]
struct Page {
    text: String,
    /// Blocks that are open.
    depth: usize,
    /// The number of the next step, from 1.
    next: Step,
    /// Columns of the longest number.
    digits: usize,
}

impl Page {
    fn theorem(&mut self, title: &str, script: &Script) {
        self.title(&format!("Proof of {title}"));
        self.proposition(&script.proposition);
        let point = place(&script.example);
        self.text(2, &format!("Both sides have values at {point}."));
        self.text.push('\n');
        self.next = 1;
        let facts: usize = script.lines.iter().map(facts_of).sum();
        self.digits = facts.to_string().len();
        for line in &script.lines {
            self.line(line);
        }
        self.text.push('\n');
        for (link, step) in &script.links {
            self.text(2, &format!("Step {} is link {}.", step + 1, link + 1));
        }
        self.rules(&script.lines);
    }

    fn title(&mut self, title: &str) {
        self.text.push_str(&paint(STRONG, title));
        self.text.push('\n');
    }

    /// The canonical text: the statement as the kernel sees it.
    fn proposition(&mut self, proposition: &Proposition) {
        for line in proposition.to_string().lines() {
            self.text(2, line);
        }
    }

    /// Indented text; where it is too long it goes on two columns further in.
    fn text(&mut self, indent: usize, text: &str) {
        let lines = wrap(text, WIDTH.saturating_sub(indent + 2).max(WIDTH / 4));
        for (at, line) in lines.iter().enumerate() {
            let indent = indent + if at == 0 { 0 } else { 2 };
            self.text.push_str(&format!("{:indent$}{line}\n", ""));
        }
    }

    fn line(&mut self, line: &Line) {
        match line {
            Line::Open {
                variables,
                hypotheses,
            } => {
                let head = self.block(variables, hypotheses);
                self.text(2 + 2 * self.depth, &head);
                self.depth += 1;
            }
            Line::Close => self.depth = self.depth.saturating_sub(1),
            Line::Step {
                fact,
                rule,
                premises,
                arguments,
            } => {
                let from = premises.iter().map(|step| (step + 1).to_string()).collect();
                let with: Vec<String> = arguments.iter().map(ToString::to_string).collect();
                self.step(fact, &reason(*rule, from, with));
            }
        }
    }

    /// `For every real x with 0 < x (3) and x < 1 (4):`
    fn block(&mut self, variables: &[Variable], hypotheses: &[Fact]) -> String {
        let kind = |v: &Variable| match v.integer {
            true => format!("integer {}", v.name),
            false => format!("real {}", v.name),
        };
        let variables: Vec<String> = variables.iter().map(kind).collect();
        let hypotheses = hypotheses.iter().map(|fact| {
            self.next += 1;
            format!("{fact} ({})", self.next - 1)
        });
        let hypotheses: Vec<String> = hypotheses.collect();
        match (variables.is_empty(), hypotheses.is_empty()) {
            (false, false) => format!("For every {} with {}:", and(&variables), and(&hypotheses)),
            (false, true) => format!("For every {}:", and(&variables)),
            (true, false) => format!("Where {}:", and(&hypotheses)),
            (true, true) => "Apart:".to_owned(),
        }
    }

    /// A numbered step; its reason stands behind it, or below where there is no room.
    fn step(&mut self, fact: &Fact, reason: &str) {
        let indent = 2 + 2 * self.depth;
        let number = format!("{:>1$}.", self.next, self.digits);
        self.next += 1;
        let column = indent + number.len() + 1;
        let fact = fact.to_string();
        let begin = (column + fact.chars().count() + 2).max(REASON);
        if begin + reason.chars().count() <= WIDTH {
            let room = begin - column;
            let reason = paint(FAINT, reason);
            let line = format!("{:indent$}{number} {fact:room$}{reason}\n", "");
            return self.text.push_str(&line);
        }
        self.text(indent, &format!("{number} {fact}"));
        for line in wrap(reason, WIDTH.saturating_sub(column + 2).max(WIDTH / 4)) {
            let line = paint(FAINT, &line);
            self.text
                .push_str(&format!("{:1$}{line}\n", "", column + 2));
        }
    }

    /// The rules that the proof uses, with what they say and what they rest on.
    fn rules(&mut self, lines: &[Line]) {
        let used = lines.iter().filter_map(|line| match line {
            Line::Step { rule, .. } => Some(*rule),
            _ => None,
        });
        let used: BTreeSet<Rule> = used.collect();
        self.text.push('\n');
        self.title("Facts used");
        for rule in used {
            let source = match rule.source() {
                "" => String::new(),
                source => format!(" ({source})"),
            };
            self.text(2, &format!("{}{source}", rule.name()));
            let words: Vec<&str> = rule.law().split_whitespace().collect();
            for line in wrap(&words.join(" "), WIDTH - 6) {
                self.text.push_str(&format!("{:6}{line}\n", ""));
            }
        }
    }
}

/// How many numbers a line takes up.
fn facts_of(line: &Line) -> usize {
    match line {
        Line::Open { hypotheses, .. } => hypotheses.len(),
        Line::Close => 0,
        Line::Step { .. } => 1,
    }
}

/// `gamma from 3 and 5, with t (DLMF 5.5.1)`
fn reason(rule: Rule, from: Vec<String>, with: Vec<String>) -> String {
    let mut text = rule.name().to_owned();
    if !from.is_empty() {
        text.push_str(&format!(" from {}", and(&from)));
    }
    if !with.is_empty() {
        text.push_str(&format!(", with {}", and(&with)));
    }
    if !rule.source().is_empty() {
        text.push_str(&format!(" ({})", rule.source()));
    }
    text
}

/// `a`, `a and b`, `a, b and c`
fn and(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::proof::parse;

    /// Shows the layout only: nothing here is checked.
    const CERTIFICATE: &str = "\
theorem
given int k; real a
domain k >= 2 and a > 0
says int((k - 1)*x^(k - 2), x = 0..a) == a^(k - 1) == a^k/a
example a = 1, k = 2
proof
1: 2 <= k | given
2: 0 < k - 1 | order | k - 2 + 1
{ x real | 3: 0 < x | 4: x < a
5: diff(x^(k - 1)*(a + 1)*(a + 2)*(a + 3)*(a + 4)*(a + 5), x) == (k - 1)*x^(k - 2)*(a + 1)*(a + 2)*(a + 3)*(a + 4)*(a + 5) | ring 2 3 | x^(k - 1)
{ | 6: k == 2
7: finite x | finite
}
}
8: int((k - 1)*x^(k - 2), x = 0..a) == a^(k - 1) | primitive 5 7 | x^(k - 1)
qed 8
";

    #[test]
    fn a_proof_is_readable_in_100_columns() {
        let certificate = parse(CERTIFICATE).expect("a certificate");
        let text = render(PRINTED, &certificate[0]);
        let text = anstream::adapter::strip_str(&text).to_string();
        assert!(
            text.lines().all(|line| line.chars().count() <= 100),
            "{text}"
        );
        insta::assert_snapshot!(text);
    }
}
