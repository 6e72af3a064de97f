//! Certificates: proofs and refutations as text.
//!
//! A certificate opens with the proposition that it is about, in full. A step is one line: its
//! label, its fact, the rule with the labels of its premises, and the rule's arguments.
//!
//! ```text
//! theorem
//! given int k
//! domain k >= 2
//! says k*gamma(k - 1)/gamma(k) == k/(k - 1)
//! example k = 2
//! proof
//! 1: 2 <= k | given
//! 2: 0 < k - 1 | order | k - 2 + 1
//! 3: 0 < k | order | k - 2 + 2
//! 4: gamma(k) == (k - 1)*gamma(k - 1) | gamma
//! 5: k*gamma(k - 1)/gamma(k) == k/(k - 1) | ring 4
//! qed 5
//! ```
//!
//! A block opens with `{`, its variables and what it supposes (`{ x real | 5: 0 < x | 6: x < 1`) and
//! closes with `}`. `qed` lists a step for each link of the statement, `-` for one left open.
//! A refutation has `refutation` for `theorem`, and ends with its point and the number of the link
//! that fails there, from 1: `at k = 1` and `link 1`.

use super::{Fact, Proof, Rejected, Rule, Step, Theorem, Variable};
use crate::formula::{
    Formula, Name, Operator, Point, Proposition, Rational, parse_formula, parse_proposition,
};
use crate::kernel::{Refutation, Unknown, Witness, check_witness};
use num_traits::{One, Signed};
use std::collections::HashMap;
use std::fmt::{Display, Formatter, Result as Printed};
use std::iter::Zip;
use std::ops::RangeFrom;

/// No longer certificate is read.
const TEXT_CAP: usize = 4 << 20;

/// One line of a proof.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    Open {
        variables: Vec<Variable>,
        hypotheses: Vec<Fact>,
    },
    Close,
    Step {
        fact: Fact,
        rule: Rule,
        premises: Vec<Step>,
        arguments: Vec<Formula>,
    },
}

/// What a certificate holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Certificate {
    Theorem(Script),
    Refutation {
        proposition: Proposition,
        witness: Witness,
    },
}

/// A proof as it is written, not yet checked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Script {
    pub proposition: Proposition,
    pub example: Point,
    pub lines: Vec<Line>,
    /// The links that are proved, in order, each with its step.
    pub links: Vec<(usize, Step)>,
}

/// What a certificate shows.
#[derive(Clone, Debug)]
pub enum Shown {
    Theorem(Box<Theorem>),
    Refutation {
        proposition: Box<Proposition>,
        refutation: Box<Refutation>,
    },
}

/// Why a certificate is none, and the line of the text, from 1; 0 for a script without text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct Flaw {
    pub line: usize,
    pub message: String,
}

/// Reads and checks all certificates of a text.
///
/// # Errors
/// The first [`Flaw`].
pub fn replay(text: &str) -> Result<Vec<Shown>, Flaw> {
    read(text)?.iter().map(Read::check).collect()
}

/// Reads all certificates of a text without checking them.
///
/// # Errors
/// The first [`Flaw`] of the notation.
pub fn parse(text: &str) -> Result<Vec<Certificate>, Flaw> {
    Ok(read(text)?
        .into_iter()
        .map(|read| read.certificate)
        .collect())
}

/// A certificate with the lines of its text: of every line of the proof, and of its end.
struct Read {
    certificate: Certificate,
    places: Vec<usize>,
    end: usize,
}

impl Read {
    fn check(&self) -> Result<Shown, Flaw> {
        match &self.certificate {
            Certificate::Theorem(script) => match script.check() {
                Ok(theorem) => Ok(Shown::Theorem(Box::new(theorem))),
                Err((at, Rejected(message))) => {
                    let line = at.and_then(|at| self.places.get(at)).unwrap_or(&self.end);
                    Err(Flaw {
                        line: *line,
                        message,
                    })
                }
            },
            Certificate::Refutation {
                proposition,
                witness,
            } => match check_witness(proposition, witness) {
                Ok(refutation) => {
                    let proposition = Box::new(proposition.clone());
                    let refutation = Box::new(refutation);
                    Ok(Shown::Refutation {
                        proposition,
                        refutation,
                    })
                }
                Err(Unknown(message)) => Err(Flaw {
                    line: self.end,
                    message,
                }),
            },
        }
    }
}

impl Script {
    /// Replays the proof.
    ///
    /// # Errors
    /// Why it is none, with the number of the line that fails, none for the end.
    pub fn check(&self) -> Result<Theorem, (Option<usize>, Rejected)> {
        let mut proof = Proof::new(&self.proposition);
        for (at, line) in self.lines.iter().enumerate() {
            proof.line(line).map_err(|error| (Some(at), error))?;
        }
        proof
            .theorem(&self.links, &self.example)
            .map_err(|error| (None, error))
    }
}

impl Proof<'_> {
    /// Does what a line says.
    ///
    /// # Errors
    /// [`Rejected`] with the reason where it is no step of this proof.
    pub fn line(&mut self, line: &Line) -> Result<(), Rejected> {
        match line {
            Line::Open {
                variables,
                hypotheses,
            } => self.open(variables.clone(), hypotheses.clone()),
            Line::Close => self.close(),
            Line::Step {
                fact,
                rule,
                premises,
                arguments,
            } => self
                .step(fact.clone(), *rule, premises, arguments)
                .map(|_| ()),
        }
    }
}

/// The lines of a text, one after the other, with their numbers from 1.
struct Lines<'t> {
    rest: Zip<RangeFrom<usize>, std::str::Lines<'t>>,
    /// The number of the last line taken.
    at: usize,
}

impl<'t> Lines<'t> {
    fn flaw<T>(&self, message: impl Display) -> Result<T, Flaw> {
        Err(Flaw {
            line: self.at,
            message: message.to_string(),
        })
    }

    /// The next line, which begins with the word; what follows it.
    fn expect(&mut self, word: &str) -> Result<&'t str, Flaw> {
        if let Some((at, line)) = self.rest.next() {
            self.at = at;
            if let Some(rest) = line.trim().strip_prefix(word) {
                return Ok(rest.trim());
            }
        }
        self.flaw(format!("`{word}` is expected here"))
    }
}

fn read(text: &str) -> Result<Vec<Read>, Flaw> {
    let mut lines = Lines {
        rest: (1..).zip(text.lines()),
        at: 0,
    };
    if text.len() > TEXT_CAP {
        return lines.flaw("the certificate is too long");
    }
    let mut all = Vec::new();
    while let Some((at, line)) = lines.rest.next() {
        lines.at = at;
        match line.trim() {
            "" => {}
            "theorem" => all.push(theorem(&mut lines)?),
            "refutation" => all.push(refutation(&mut lines)?),
            _ => return lines.flaw("`theorem` or `refutation` is expected here"),
        }
    }
    match all.is_empty() {
        true => lines.flaw("there is no certificate in the text"),
        false => Ok(all),
    }
}

fn theorem(lines: &mut Lines) -> Result<Read, Flaw> {
    let proposition = proposition(lines)?;
    let example = lines.expect("example")?;
    let example = point(example).or_else(|why| lines.flaw(why))?;
    if !lines.expect("proof")?.is_empty() {
        return lines.flaw("`proof` stands alone");
    }
    let mut script = Script {
        proposition,
        example,
        lines: Vec::new(),
        links: Vec::new(),
    };
    let mut labels = Labels::default();
    let mut places = Vec::new();
    loop {
        let Some((at, line)) = lines.rest.next() else {
            return lines.flaw("the proof has no `qed`");
        };
        lines.at = at;
        let line = line.trim();
        if let Some(ends) = line.strip_prefix("qed") {
            for (link, label) in ends.split_whitespace().enumerate() {
                if label != "-" {
                    let step = labels.find(label).or_else(|why| lines.flaw(why))?;
                    script.links.push((link, step));
                }
            }
            let certificate = Certificate::Theorem(script);
            return Ok(Read {
                certificate,
                places,
                end: lines.at,
            });
        }
        script
            .lines
            .push(labels.line(line).or_else(|why| lines.flaw(why))?);
        places.push(lines.at);
    }
}

fn refutation(lines: &mut Lines) -> Result<Read, Flaw> {
    let proposition = proposition(lines)?;
    let at = lines.expect("at")?;
    let point = point(at).or_else(|why| lines.flaw(why))?;
    let link = lines
        .expect("link")?
        .parse::<usize>()
        .ok()
        .and_then(|link| link.checked_sub(1));
    let Some(link) = link else {
        return lines.flaw("the number of a link, from 1");
    };
    let witness = Witness { point, link };
    let certificate = Certificate::Refutation {
        proposition,
        witness,
    };
    Ok(Read {
        certificate,
        places: Vec::new(),
        end: lines.at,
    })
}

/// The canonical text of a proposition ends with its `says` line.
fn proposition(lines: &mut Lines) -> Result<Proposition, Flaw> {
    let mut text = String::new();
    while let Some((at, line)) = lines.rest.next() {
        lines.at = at;
        let line = line.trim();
        text.push_str(line);
        if line.starts_with("says ") {
            return parse_proposition(&text).or_else(|error| lines.flaw(error));
        }
        text.push('\n');
    }
    lines.flaw("a proposition ends with a `says` line")
}

/// `k = 2, f(x) = 6*x*(1 - x)`
fn point(text: &str) -> Result<Point, String> {
    let mut point = Point::default();
    for part in text
        .split(',')
        .map(str::trim)
        .filter(|part| !part.is_empty())
    {
        let Some((name, value)) = part.split_once('=') else {
            return Err("a point is written `k = 2, n = 3`".to_string());
        };
        let value = parse_formula(value.trim()).map_err(|error| error.to_string())?;
        let new = match name
            .trim()
            .strip_suffix(')')
            .and_then(|head| head.split_once('('))
        {
            Some((name, x)) => point
                .functions
                .insert(name.into(), (x.into(), value))
                .is_none(),
            None => {
                let value = rational(&value).ok_or("the value of a name is a rational")?;
                point.numbers.insert(name.trim().into(), value).is_none()
            }
        };
        if !new {
            return Err(format!("{name} is given twice"));
        }
    }
    Ok(point)
}

/// A number, with its sign or as a quotient.
fn rational(formula: &Formula) -> Option<Rational> {
    match formula {
        Formula::Number(value) => Some(value.clone()),
        Formula::Negate(a) => Some(-rational(a)?),
        Formula::Binary(Operator::Divide, a, b) => {
            let below = rational(b).filter(|b| b.is_positive())?;
            Some(rational(a)? / below)
        }
        _ => None,
    }
}

/// The labels read so far, and the steps that they stand for.
#[derive(Default)]
pub(super) struct Labels {
    steps: HashMap<String, Step>,
    next: Step,
}

impl Labels {
    fn find(&self, label: &str) -> Result<Step, String> {
        self.steps
            .get(label)
            .copied()
            .ok_or_else(|| format!("no step has the label {label}"))
    }

    /// `LABEL: FACT`
    fn labelled(&mut self, text: &str) -> Result<Fact, String> {
        let Some((label, fact)) = text.split_once(':') else {
            return Err("a step begins with its label and a colon".to_string());
        };
        if self
            .steps
            .insert(label.trim().to_string(), self.next)
            .is_some()
        {
            return Err(format!("the label {label} is in use"));
        }
        self.next += 1;
        Fact::parse(fact.trim()).map_err(|error| error.to_string())
    }

    pub fn line(&mut self, text: &str) -> Result<Line, String> {
        if text == "}" {
            return Ok(Line::Close);
        }
        let mut parts = text.split('|').map(str::trim);
        let first = parts.next().unwrap_or_default();
        if let Some(names) = first.strip_prefix('{') {
            let names = names
                .split(',')
                .map(str::trim)
                .filter(|name| !name.is_empty());
            let variables = names.map(variable).collect::<Result<_, _>>()?;
            let hypotheses = parts
                .map(|part| self.labelled(part))
                .collect::<Result<_, _>>()?;
            return Ok(Line::Open {
                variables,
                hypotheses,
            });
        }
        // The premises come first: a step is none of its own.
        let mut words = parts.next().unwrap_or_default().split_whitespace();
        let rule = words.next().unwrap_or_default();
        let rule = Rule::parse(rule).ok_or_else(|| format!("there is no rule `{rule}`"))?;
        let premises = words
            .map(|label| self.find(label))
            .collect::<Result<_, _>>()?;
        let argument = |text| parse_formula(text).map_err(|error| error.to_string());
        let arguments = parts.map(argument).collect::<Result<_, _>>()?;
        Ok(Line::Step {
            fact: self.labelled(first)?,
            rule,
            premises,
            arguments,
        })
    }
}

/// `x real` or `j int`
fn variable(text: &str) -> Result<Variable, String> {
    let (name, integer) = match text.split_once(' ') {
        Some((name, "int")) => (name, true),
        Some((name, "real")) => (name, false),
        _ => return Err("a variable is written `x real` or `j int`".to_string()),
    };
    match parse_formula(name) {
        Ok(Formula::Name(name)) => Ok(Variable { name, integer }),
        _ => Err(format!("{name} is no name")),
    }
}

impl Display for Certificate {
    fn fmt(&self, f: &mut Formatter<'_>) -> Printed {
        match self {
            Certificate::Theorem(script) => script.fmt(f),
            Certificate::Refutation {
                proposition,
                witness,
            } => {
                writeln!(f, "refutation\n{proposition}")?;
                writeln!(f, "at {}", Place(&witness.point))?;
                writeln!(f, "link {}", witness.link + 1)
            }
        }
    }
}

impl Display for Script {
    fn fmt(&self, f: &mut Formatter<'_>) -> Printed {
        writeln!(f, "theorem\n{}", self.proposition)?;
        writeln!(f, "example {}\nproof", Place(&self.example))?;
        let (mut next, mut depth) = (1, 0);
        for line in &self.lines {
            depth = usize::saturating_sub(depth, usize::from(*line == Line::Close));
            write!(f, "{:1$}", "", 2 * depth)?;
            match line {
                Line::Open {
                    variables,
                    hypotheses,
                } => {
                    let kind = |v: &Variable| if v.integer { "int" } else { "real" };
                    let names: Vec<String> = variables
                        .iter()
                        .map(|v| format!(" {} {}", v.name, kind(v)))
                        .collect();
                    write!(f, "{{{}", names.join(","))?;
                    for fact in hypotheses {
                        write!(f, " | {next}: {fact}")?;
                        next += 1;
                    }
                    writeln!(f)?;
                    depth += 1;
                }
                Line::Close => writeln!(f, "}}")?,
                Line::Step {
                    fact,
                    rule,
                    premises,
                    arguments,
                } => {
                    write!(f, "{next}: {fact} | {}", rule.name())?;
                    premises
                        .iter()
                        .try_for_each(|premise| write!(f, " {}", premise + 1))?;
                    arguments
                        .iter()
                        .try_for_each(|argument| write!(f, " | {argument}"))?;
                    writeln!(f)?;
                    next += 1;
                }
            }
        }
        write!(f, "qed")?;
        let mut next = 0;
        for (link, step) in &self.links {
            let open = link.saturating_sub(next);
            write!(f, "{} {}", " -".repeat(open), step + 1)?;
            next = link + 1;
        }
        writeln!(f)
    }
}

/// A point, as certificates write it.
struct Place<'a>(&'a Point);

impl Display for Place<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Printed {
        let number = |(name, value): (&Name, &Rational)| match value.denom().is_one() {
            true => format!("{name} = {}", value.numer()),
            false => format!("{name} = {}/{}", value.numer(), value.denom()),
        };
        let mut parts: Vec<String> = self.0.numbers.iter().map(number).collect();
        let functions = self.0.functions.iter();
        parts.extend(functions.map(|(name, (x, body))| format!("{name}({x}) = {body}")));
        f.write_str(&parts.join(", "))
    }
}
