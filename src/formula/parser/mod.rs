//! Text to trees: a Pratt parser over the [lexer](super::lexer).
//!
//! Loosest first: `or`; `and`; `not`; relations, which chain; `+ -`; `* /` from the left; unary `-`;
//! `^` from the right; `!`; calls. So `-a^2` is `-(a^2)`, and `2^-k` is a power. Numbers and
//! conditions are parsed by one function, since `(` may open either; a condition where a number is
//! wanted becomes [`Formula::Truth`], for the judge to refuse.
//!
//! Nesting is capped while text is read ([`MAX_NESTING`]), and so is the depth of the tree
//! ([`MAX_DEPTH`], which a long sum reaches without any nesting): recursion over trees is safe
//! everywhere because of these two.

mod calls;
mod declare;
mod expression;
mod law;
mod statement;

pub(crate) use declare::Given;
pub(crate) use law::density_argument;
pub(crate) use statement::id_length;

use super::lexer::{Lexeme, Token, lex};
use super::{Condition, Diagnostic, Formula, Function, Law, Name, Proposition, Span, Statement};
use expression::{Node, Value};

/// How deep brackets, operands and calls may nest in a text.
pub const MAX_NESTING: usize = 200;
/// How deep a tree may be.
pub const MAX_DEPTH: usize = 1000;
/// How many digits a number may have.
pub const MAX_DIGITS: usize = 10_000;

/// Words that cannot be names because of their place in formulas and statements.
const RESERVED: [&str; 11] = [
    "and",
    "or",
    "not",
    "as",
    "then",
    "uniformly",
    "along",
    "is",
    "if",
    "inf",
    "pi",
];
/// What a statement needs, in the words of errors.
const RELATION: &str = "a relation such as `==`";
/// Forms that look like calls.
const FORMS: [&str; 14] = [
    "sum", "int", "sup", "infimum", "diff", "at", "lim", "mean", "var", "prob", "density", "cdf",
    "O", "o",
];

/// A symbol of the text that is free in what was parsed, or another place worth remembering.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Mention {
    pub name: Name,
    pub span: Span,
    pub kind: MentionKind,
    /// Whether it stands inside a mean over the draws of the scope.
    pub averaged: bool,
}

/// What a [`Mention`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MentionKind {
    Value,
    /// A function with so many arguments.
    Function(usize),
    /// A condition in the place of a number.
    Truth,
    /// `O(...)` or `o(...)`
    Order,
}

/// A tree with the places of its free symbols.
#[derive(Clone, Debug)]
pub(crate) struct Parsed<T> {
    pub value: T,
    pub mentions: Vec<Mention>,
}

/// Parses a formula, such as `I*k/(n*r)`.
///
/// # Errors
/// A [`Diagnostic`] whose span lies in `text`.
pub fn parse_formula(text: &str) -> Result<Formula, Diagnostic> {
    whole(text, Parser::formula).map(|parsed| parsed.value)
}

/// Parses a condition, such as `1 <= k <= n and not k == 2`.
///
/// # Errors
/// A [`Diagnostic`] whose span lies in `text`.
pub fn parse_condition(text: &str) -> Result<Condition, Diagnostic> {
    whole(text, Parser::condition).map(|parsed| parsed.value)
}

/// Parses a law, such as `order(l, m) of uniform(0, 1)`.
///
/// # Errors
/// A [`Diagnostic`] whose span lies in `text`.
pub fn parse_law(text: &str) -> Result<Law, Diagnostic> {
    whole(text, Parser::law).map(|parsed| parsed.value)
}

/// Parses a statement, such as `a == b + O(1/k) as k -> inf`.
///
/// # Errors
/// A [`Diagnostic`] whose span lies in `text`.
pub fn parse_statement(text: &str) -> Result<Statement, Diagnostic> {
    whole(text, Parser::statement).map(|parsed| parsed.value)
}

/// Parses the canonical text of a proposition, as its `Display` prints it.
///
/// # Errors
/// A [`Diagnostic`] whose span lies in `text`.
pub fn parse_proposition(text: &str) -> Result<Proposition, Diagnostic> {
    declare::proposition(text)
}

/// Whether the language has its own use for the word, so that no symbol can have this name.
pub fn is_reserved(word: &str) -> bool {
    RESERVED.contains(&word)
        || FORMS.contains(&word)
        || Function::ALL.iter().any(|function| function.name() == word)
}

/// Every word that may stand before a bracket: known functions and forms.
pub(crate) fn callable() -> impl Iterator<Item = &'static str> {
    let functions = Function::ALL.iter().map(|function| function.name());
    functions.chain(FORMS).chain(["if"])
}

/// Reads the whole text with `read`.
pub(crate) fn whole<'t, T>(
    text: &'t str,
    read: impl FnOnce(&mut Parser<'t>) -> Result<T, Diagnostic>,
) -> Result<Parsed<T>, Diagnostic> {
    let mut parser = Parser::new(text);
    let value = read(&mut parser)?;
    parser.finish()?;
    Ok(Parsed {
        value,
        mentions: parser.mentions,
    })
}

/// The state of reading a text.
pub(crate) struct Parser<'t> {
    text: &'t str,
    current: Lexeme,
    /// The end of the token before the current one.
    previous: usize,
    nesting: usize,
    mentions: Vec<Mention>,
    /// Whether `+` or `-` may end an expression, as in `x -> 0+`.
    signed: bool,
}

impl<'t> Parser<'t> {
    pub(crate) fn new(text: &'t str) -> Parser<'t> {
        Parser {
            text,
            current: lex(text, 0),
            previous: 0,
            nesting: 0,
            mentions: Vec::new(),
            signed: false,
        }
    }

    // ---- tokens

    fn advance(&mut self) -> Span {
        let span = self.current.span;
        self.previous = span.end;
        self.current = lex(self.text, span.end);
        span
    }

    /// The token after the current one.
    fn second(&self) -> Lexeme {
        lex(self.text, self.current.span.end)
    }

    fn slice(&self, span: Span) -> &'t str {
        &self.text[span.start..span.end]
    }

    fn at_symbol(&self, symbol: &str) -> bool {
        matches!(self.current.token, Token::Symbol(s) if s == symbol)
    }

    fn at_word(&self, word: &str) -> bool {
        self.current.token == Token::Word && self.slice(self.current.span) == word
    }

    fn eat_symbol(&mut self, symbol: &str) -> bool {
        let found = self.at_symbol(symbol);
        if found {
            self.advance();
        }
        found
    }

    fn eat_word(&mut self, word: &str) -> bool {
        let found = self.at_word(word);
        if found {
            self.advance();
        }
        found
    }

    fn expect_symbol(&mut self, symbol: &str) -> Result<Span, Diagnostic> {
        if self.at_symbol(symbol) {
            Ok(self.advance())
        } else {
            Err(self.unexpected(&format!("`{symbol}`")))
        }
    }

    fn expect_word(&mut self, word: &str) -> Result<Span, Diagnostic> {
        if self.at_word(word) {
            Ok(self.advance())
        } else {
            Err(self.unexpected(&format!("`{word}`")))
        }
    }

    /// Nothing but the end may follow.
    pub(crate) fn finish(&mut self) -> Result<(), Diagnostic> {
        match self.current.token {
            Token::End => Ok(()),
            _ => Err(self.unexpected("the end")),
        }
    }

    // ---- errors

    fn error(&self, span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            span,
            message: message.into(),
            hint: None,
        }
    }

    /// What is wrong with the current token where `expected` should stand.
    fn unexpected(&self, expected: &str) -> Diagnostic {
        if let Token::Bad(error) = &self.current.token {
            return (**error).clone();
        }
        let span = self.current.span;
        let found = match self.current.token {
            Token::End => "the text ends".to_string(),
            _ => format!("found `{}`", clip(self.slice(span))),
        };
        Diagnostic {
            span,
            message: format!("expected {expected}, {found}"),
            hint: self.hint(expected),
        }
    }

    fn hint(&self, expected: &str) -> Option<String> {
        let ends = ["`)`", "`]`", "`,`", "`..`", "the end", RELATION].contains(&expected);
        let hint = match self.current.token {
            Token::Symbol("=") => "equality is written `==`",
            Token::Symbol(")") => "there is no `(` that this bracket closes",
            Token::Symbol("]") => "there is no `[` that this bracket closes",
            Token::Symbol("~" | "=~") => "this relation stands in statements only",
            Token::Symbol("(" | "[") | Token::Number | Token::Word
                if ends && self.after_operand() =>
            {
                "a product is written with `*`"
            }
            _ => return None,
        };
        Some(hint.to_string())
    }

    /// Whether what stands before the current token could end an operand and what stands there
    /// could begin another.
    fn after_operand(&self) -> bool {
        let ends = self.text[..self.previous].ends_with(|c: char| {
            c.is_ascii_alphanumeric() || matches!(c, ')' | ']' | '!' | '_' | '\'')
        });
        let word = self.slice(self.current.span);
        ends && !RESERVED.contains(&word)
    }

    fn enter(&mut self) -> Result<(), Diagnostic> {
        self.nesting += 1;
        if self.nesting > MAX_NESTING {
            let message = format!("nested more than {MAX_NESTING} deep");
            return Err(self.error(self.current.span, message));
        }
        Ok(())
    }

    fn node(&self, value: Value, span: Span, depth: usize) -> Result<Node, Diagnostic> {
        if depth > MAX_DEPTH {
            let message = format!("the formula is a tree more than {MAX_DEPTH} deep");
            let mut error = self.error(span, message);
            error.hint = Some("give parts of it a name with `let`".to_string());
            return Err(error);
        }
        Ok(Node { value, span, depth })
    }

    fn number(&self, formula: Formula, span: Span, depth: usize) -> Result<Node, Diagnostic> {
        self.node(Value::Number(formula), span, depth)
    }
}

/// The first 40 characters.
fn clip(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_string(),
    }
}
