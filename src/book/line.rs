//! One logical line of a block: keyword and content.

use super::expect::expectation;
use super::markdown::LogicalLine;
use super::{Definition, Expectation};
use crate::formula::parser::{Given, Mention, Parsed, Parser, whole};
use crate::formula::{Condition, Diagnostic, Draw, Name, Regime, Span, Statement, nearest};

/// What a line says; every place is one of the file.
#[derive(Debug)]
pub(super) enum Item {
    Given(Given),
    Draw(Vec<(Draw, Span)>),
    Let(Definition, Span),
    Use(Name),
    Same(Name),
    Read(Regime),
    Says(Statement),
    Mend(Statement),
    Needs {
        condition: Condition,
        text: String,
        sufficient: bool,
    },
    After(Name),
    Page(String),
    Quote(String),
    Slip(String),
    Scan(String),
    Like(Name),
    Why(String),
    Expect(Expectation),
}

/// A line that has been read.
#[derive(Debug)]
pub(super) struct Line {
    /// The file's number in the read.
    pub file: usize,
    pub keyword: Keyword,
    /// From the keyword to the end.
    pub span: Span,
    /// What follows the keyword, on one line.
    pub text: String,
    pub item: Item,
    pub mentions: Vec<Mention>,
}

/// The words that lines begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Keyword {
    Use,
    Same,
    Given,
    Draw,
    Let,
    Read,
    After,
    Says,
    Mend,
    Needs,
    Page,
    Quote,
    Slip,
    Scan,
    Like,
    Why,
    Expect,
}

const KEYWORDS: [(&str, Keyword); 17] = [
    ("given", Keyword::Given),
    ("draw", Keyword::Draw),
    ("let", Keyword::Let),
    ("use", Keyword::Use),
    ("same", Keyword::Same),
    ("read", Keyword::Read),
    ("says", Keyword::Says),
    ("mend", Keyword::Mend),
    ("needs", Keyword::Needs),
    ("after", Keyword::After),
    ("page", Keyword::Page),
    ("quote", Keyword::Quote),
    ("slip", Keyword::Slip),
    ("scan", Keyword::Scan),
    ("like", Keyword::Like),
    ("why", Keyword::Why),
    ("expect", Keyword::Expect),
];

impl Keyword {
    /// Whether a claim may have several lines with this word.
    pub fn repeats(self) -> bool {
        matches!(
            self,
            Keyword::Use | Keyword::Given | Keyword::Draw | Keyword::Let
        )
    }

    pub fn word(self) -> &'static str {
        let known = KEYWORDS.iter().find(|(_, keyword)| *keyword == self);
        known.map_or("", |(word, _)| word)
    }
}

/// Reads a line of the file number `file`.
pub(super) fn line(source: &LogicalLine<'_>, word: &str, file: usize) -> Result<Line, Diagnostic> {
    let known = KEYWORDS.iter().find(|(known, _)| *known == word);
    let Some((_, keyword)) = known else {
        return Err(unknown(word, source.keyword));
    };
    let (item, mentions) = content(*keyword, source)?;
    let end = source.start + source.text.trim_end().len();
    Ok(Line {
        file,
        keyword: *keyword,
        span: Span {
            start: source.keyword.start,
            end: end.max(source.keyword.end),
        },
        text: one_line(&source.text),
        item,
        mentions,
    })
}

fn unknown(word: &str, span: Span) -> Diagnostic {
    let words = || KEYWORDS.iter().map(|(known, _)| *known);
    let all: Vec<_> = words().collect();
    let hint = nearest(word.trim_end_matches(':'), words());
    Diagnostic {
        span,
        message: format!("no line begins so; lines begin with {}", all.join(", ")),
        hint: hint.map(|near| format!("write `{near}`")),
    }
}

/// The words with single spaces between them.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn content(keyword: Keyword, source: &LogicalLine<'_>) -> Result<(Item, Vec<Mention>), Diagnostic> {
    let plain = |item| Ok((item, Vec::new()));
    match keyword {
        Keyword::Given => given(source),
        Keyword::Draw => draw(source),
        Keyword::Let => definition(source),
        Keyword::Use => parse(source, |parser| {
            parser.identifier().map(|id| Item::Use(id.0))
        }),
        Keyword::Same => parse(source, |parser| {
            parser.identifier().map(|id| Item::Same(id.0))
        }),
        Keyword::Like => parse(source, |parser| {
            parser.identifier().map(|id| Item::Like(id.0))
        }),
        Keyword::After => parse(source, |parser| {
            parser.identifier().map(|id| Item::After(id.0))
        }),
        Keyword::Read => parse(source, |parser| parser.regime().map(Item::Read)),
        Keyword::Says => parse(source, |parser| parser.statement().map(Item::Says)),
        Keyword::Mend => parse(source, |parser| parser.statement().map(Item::Mend)),
        Keyword::Needs => needs(source),
        Keyword::Page => plain(Item::Page(page(source)?)),
        Keyword::Quote => plain(Item::Quote(words(source)?)),
        Keyword::Slip => plain(Item::Slip(words(source)?)),
        Keyword::Scan => plain(Item::Scan(words(source)?)),
        Keyword::Why => plain(Item::Why(words(source)?)),
        Keyword::Expect => {
            let expect = expectation(&source.text).map_err(|error| error.shifted(source.start))?;
            plain(Item::Expect(expect))
        }
    }
}

/// Reads the whole content; places in the result are still those of the content.
fn parsed<T>(
    source: &LogicalLine<'_>,
    read: impl FnOnce(&mut Parser<'_>) -> Result<T, Diagnostic>,
) -> Result<Parsed<T>, Diagnostic> {
    let mut parsed = whole(&source.text, read).map_err(|error| error.shifted(source.start))?;
    for mention in &mut parsed.mentions {
        mention.span = mention.span.shifted(source.start);
    }
    Ok(parsed)
}

fn parse(
    source: &LogicalLine<'_>,
    read: impl FnOnce(&mut Parser<'_>) -> Result<Item, Diagnostic>,
) -> Result<(Item, Vec<Mention>), Diagnostic> {
    let parsed = parsed(source, read)?;
    Ok((parsed.value, parsed.mentions))
}

fn given(source: &LogicalLine<'_>) -> Result<(Item, Vec<Mention>), Diagnostic> {
    let mut parsed = parsed(source, |parser| parser.given())?;
    for (_, span) in &mut parsed.value.parameters {
        *span = span.shifted(source.start);
    }
    Ok((Item::Given(parsed.value), parsed.mentions))
}

fn draw(source: &LogicalLine<'_>) -> Result<(Item, Vec<Mention>), Diagnostic> {
    let mut parsed = parsed(source, |parser| parser.draws())?;
    for (_, span) in &mut parsed.value {
        *span = span.shifted(source.start);
    }
    Ok((Item::Draw(parsed.value), parsed.mentions))
}

fn definition(source: &LogicalLine<'_>) -> Result<(Item, Vec<Mention>), Diagnostic> {
    let parsed = parsed(source, |parser| parser.definition_line())?;
    let (name, span, arguments, body) = parsed.value;
    let definition = Definition {
        name,
        arguments,
        body,
    };
    let item = Item::Let(definition, span.shifted(source.start));
    Ok((item, parsed.mentions))
}

fn needs(source: &LogicalLine<'_>) -> Result<(Item, Vec<Mention>), Diagnostic> {
    let parsed = parsed(source, |parser| parser.needs())?;
    let (condition, sufficient, span) = parsed.value;
    let item = Item::Needs {
        condition,
        text: one_line(&source.text[span.start..span.end]),
        sufficient,
    };
    Ok((item, parsed.mentions))
}

fn words(source: &LogicalLine<'_>) -> Result<String, Diagnostic> {
    let words = one_line(&source.text);
    if words.is_empty() {
        return Err(Diagnostic {
            span: source.keyword,
            message: "this line says nothing".to_string(),
            hint: None,
        });
    }
    Ok(words)
}

/// How long the name of a page may be.
const MAX_PAGE: usize = 20;

/// A page as the text counts it, or a range of pages.
fn page(source: &LogicalLine<'_>) -> Result<String, Diagnostic> {
    let page = words(source)?;
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-');
    if page.len() <= MAX_PAGE && page.chars().all(is_part) {
        return Ok(page);
    }
    let start = source.start + (source.text.len() - source.text.trim_start().len());
    Err(Diagnostic {
        span: Span {
            start,
            end: source.start + source.text.trim_end().len(),
        },
        message: "this is no page".to_string(),
        hint: Some("write one page or a range of pages: `22`, `iv`, `22-23`".to_string()),
    })
}
