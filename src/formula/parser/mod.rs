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
mod law;
mod statement;

pub(crate) use declare::Given;
pub(crate) use law::density_argument;
pub(crate) use statement::id_length;

use super::lexer::{Lexeme, Token, lex};
use super::{
    Condition, Diagnostic, Formula, Function, Law, Name, Operator, Proposition, Rational, Relation,
    Span, Statement,
};
use num_bigint::BigInt;

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

/// A subtree while it is parsed.
pub(crate) struct Node {
    value: Value,
    span: Span,
    depth: usize,
}

enum Value {
    Number(Formula),
    Truth(Condition),
}

/// How tightly operators bind.
mod power {
    pub const OR: u8 = 1;
    pub const AND: u8 = 2;
    pub const NOT: u8 = 3;
    pub const RELATION: u8 = 4;
    pub const SUM: u8 = 5;
    pub const PRODUCT: u8 = 6;
    pub const UNARY: u8 = 7;
    pub const POWER: u8 = 8;
    pub const POSTFIX: u8 = 9;
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

    // ---- expressions

    /// A whole formula.
    pub(crate) fn formula(&mut self) -> Result<Formula, Diagnostic> {
        self.sum_level().map(|(formula, _)| formula)
    }

    /// A whole condition.
    pub(crate) fn condition(&mut self) -> Result<Condition, Diagnostic> {
        let node = self.expression(power::OR)?;
        self.as_condition(node).map(|(condition, _)| condition)
    }

    /// A formula with its depth; a relation ends it.
    fn sum_level(&mut self) -> Result<(Formula, usize), Diagnostic> {
        let node = self.expression(power::SUM)?;
        self.as_formula(node)
    }

    fn as_formula(&mut self, node: Node) -> Result<(Formula, usize), Diagnostic> {
        match node.value {
            Value::Number(formula) => Ok((formula, node.depth)),
            Value::Truth(condition) => {
                let formula = Formula::Truth(Box::new(condition));
                self.mention("", node.span, MentionKind::Truth);
                self.node(Value::Number(Formula::Pi), node.span, node.depth + 1)?;
                Ok((formula, node.depth + 1))
            }
        }
    }

    fn as_condition(&self, node: Node) -> Result<(Condition, usize), Diagnostic> {
        match node.value {
            Value::Truth(condition) => Ok((condition, node.depth)),
            Value::Number(_) => {
                let message = "expected a condition such as `a < b`, found a number";
                let mut error = self.error(node.span, message);
                if self.at_symbol("=") {
                    error.span = self.current.span;
                    error.hint = Some("equality is written `==`".to_string());
                }
                Err(match self.current.token {
                    Token::Bad(_) => self.unexpected("a relation"),
                    _ => error,
                })
            }
        }
    }

    fn mention(&mut self, name: &str, span: Span, kind: MentionKind) {
        self.mentions.push(Mention {
            name: name.into(),
            span,
            kind,
            averaged: false,
        });
    }

    /// Of the symbols mentioned since `from`, those called `name` are bound: they are no longer free.
    fn bind(&mut self, from: usize, name: &str) {
        let tail = self.mentions.split_off(from);
        let free = tail
            .into_iter()
            .filter(|m| m.kind != MentionKind::Value || &*m.name != name);
        self.mentions.extend(free);
    }

    /// An expression whose operators bind at least as tightly as `least`.
    fn expression(&mut self, least: u8) -> Result<Node, Diagnostic> {
        self.enter()?;
        let mut left = self.prefix(least)?;
        while let Some(binding) = self.infix() {
            if binding < least {
                break;
            }
            left = match binding {
                power::OR | power::AND => self.junction(left, binding)?,
                power::RELATION => self.relations(left)?,
                _ => self.arithmetic(left, binding)?,
            };
        }
        self.nesting -= 1;
        Ok(left)
    }

    /// How tightly the current token binds as an operator after an operand.
    fn infix(&self) -> Option<u8> {
        match self.current.token {
            Token::Symbol("+" | "-") => {
                let ends = self.signed && !self.starts_operand(&self.second());
                (!ends).then_some(power::SUM)
            }
            Token::Symbol("*" | "/") => Some(power::PRODUCT),
            Token::Symbol("^") => Some(power::POWER),
            Token::Symbol("!") => Some(power::POSTFIX),
            Token::Symbol(_) => self.relation().map(|_| power::RELATION),
            Token::Word if self.at_word("and") => Some(power::AND),
            Token::Word if self.at_word("or") => Some(power::OR),
            _ => None,
        }
    }

    fn starts_operand(&self, lexeme: &Lexeme) -> bool {
        match lexeme.token {
            Token::Number | Token::Bad(_) | Token::Symbol("(" | "[" | "-") => true,
            Token::Word => {
                let word = self.slice(lexeme.span);
                !RESERVED.contains(&word) || matches!(word, "if" | "inf" | "pi")
            }
            _ => false,
        }
    }

    /// The relation of the current token, if conditions know it.
    fn relation(&self) -> Option<Relation> {
        match self.current.token {
            Token::Symbol("==") => Some(Relation::Equal),
            Token::Symbol("!=") => Some(Relation::NotEqual),
            Token::Symbol("<") => Some(Relation::Less),
            Token::Symbol("<=") => Some(Relation::LessEqual),
            Token::Symbol(">") => Some(Relation::Greater),
            Token::Symbol(">=") => Some(Relation::GreaterEqual),
            _ => None,
        }
    }

    fn junction(&mut self, left: Node, binding: u8) -> Result<Node, Diagnostic> {
        let word = if binding == power::AND { "and" } else { "or" };
        let mut span = left.span;
        let (first, mut depth) = self.as_condition(left)?;
        let mut items = vec![first];
        while self.eat_word(word) {
            let next = self.expression(binding + 1)?;
            span.end = next.span.end;
            let (item, deep) = self.as_condition(next)?;
            depth = depth.max(deep);
            items.push(item);
        }
        let condition = match binding {
            power::AND => Condition::And(items),
            _ => Condition::Or(items),
        };
        self.node(Value::Truth(condition), span, depth + 1)
    }

    fn relations(&mut self, left: Node) -> Result<Node, Diagnostic> {
        let mut span = left.span;
        let (first, mut depth) = self.as_formula(left)?;
        let mut links = Vec::new();
        while let Some(relation) = self.relation() {
            self.advance();
            let right = self.expression(power::SUM)?;
            span.end = right.span.end;
            let (formula, deep) = self.as_formula(right)?;
            depth = depth.max(deep);
            links.push((relation, formula));
        }
        self.node(
            Value::Truth(Condition::Chain(first, links)),
            span,
            depth + 1,
        )
    }

    fn arithmetic(&mut self, left: Node, binding: u8) -> Result<Node, Diagnostic> {
        let (operator, operand) = match self.current.token {
            Token::Symbol("+") => (Operator::Add, power::PRODUCT),
            Token::Symbol("-") => (Operator::Subtract, power::PRODUCT),
            Token::Symbol("*") => (Operator::Multiply, power::UNARY),
            Token::Symbol("/") => (Operator::Divide, power::UNARY),
            _ => (Operator::Power, power::UNARY),
        };
        let sign = self.advance();
        let mut span = left.span;
        let (first, depth) = self.as_formula(left)?;
        if binding == power::POSTFIX {
            span.end = sign.end;
            return self.number(Formula::Factorial(Box::new(first)), span, depth + 1);
        }
        let right = self.expression(operand)?;
        span.end = right.span.end;
        let (second, deep) = self.as_formula(right)?;
        let formula = Formula::binary(operator, first, second);
        self.number(formula, span, depth.max(deep) + 1)
    }

    fn prefix(&mut self, least: u8) -> Result<Node, Diagnostic> {
        let start = self.current.span.start;
        if self.at_symbol("-") {
            self.advance();
            let operand = self.expression(power::UNARY)?;
            let span = Span {
                start,
                end: operand.span.end,
            };
            let (formula, depth) = self.as_formula(operand)?;
            return self.number(Formula::Negate(Box::new(formula)), span, depth + 1);
        }
        if self.at_word("not") {
            return self.negation(least);
        }
        self.primary()
    }

    fn negation(&mut self, least: u8) -> Result<Node, Diagnostic> {
        let mut span = self.advance();
        if least > power::NOT {
            let mut error = self.error(span, "`not` stands where a number is wanted");
            error.hint = Some("put the condition into brackets: `[not ...]` is 1 or 0".into());
            return Err(error);
        }
        let operand = self.expression(power::NOT)?;
        span.end = operand.span.end;
        let (condition, depth) = self.as_condition(operand)?;
        let condition = Condition::Not(Box::new(condition));
        self.node(Value::Truth(condition), span, depth + 1)
    }

    fn primary(&mut self) -> Result<Node, Diagnostic> {
        match self.current.token {
            Token::Number => self.literal(),
            Token::Word => self.word(),
            Token::Symbol("(") => self.brackets(),
            Token::Symbol("[") => self.indicator(),
            Token::Symbol("+") => {
                let mut error = self.unexpected("a number");
                error.hint = Some("leave the sign `+` away".to_string());
                Err(error)
            }
            _ => Err(self.unexpected("a number, a name or `(`")),
        }
    }

    fn brackets(&mut self) -> Result<Node, Diagnostic> {
        let open = self.advance();
        let signed = std::mem::replace(&mut self.signed, false);
        let mut inner = self.expression(power::OR)?;
        self.signed = signed;
        inner.span.start = open.start;
        inner.span.end = self.close(")", open)?;
        Ok(inner)
    }

    fn indicator(&mut self) -> Result<Node, Diagnostic> {
        let open = self.advance();
        let signed = std::mem::replace(&mut self.signed, false);
        let inner = self.expression(power::OR)?;
        self.signed = signed;
        let is_number = matches!(inner.value, Value::Number(_)) && self.at_symbol("]");
        let (condition, depth) = self.as_condition(inner).map_err(|mut error| {
            if is_number {
                error.hint = Some("for numbers use `( )`; `[COND]` is 1 or 0".to_string());
            }
            error
        })?;
        let span = Span {
            start: open.start,
            end: self.close("]", open)?,
        };
        self.number(Formula::Indicator(Box::new(condition)), span, depth + 1)
    }

    /// The bracket that closes the one at `open`; its end.
    fn close(&mut self, bracket: &str, open: Span) -> Result<usize, Diagnostic> {
        if self.at_symbol(bracket) {
            return Ok(self.advance().end);
        }
        let mut error = self.unexpected(&format!("`{bracket}`"));
        if self.current.token == Token::End {
            error.span = open;
            error.message = format!("this bracket is never closed: `{bracket}` is missing");
        }
        Err(error)
    }

    fn literal(&mut self) -> Result<Node, Diagnostic> {
        let span = self.advance();
        let text = self.slice(span);
        if text.len() > MAX_DIGITS {
            let message = format!("a number of more than {MAX_DIGITS} digits");
            return Err(self.error(span, message));
        }
        let value = decimal(text).ok_or_else(|| self.error(span, "this number cannot be read"))?;
        self.number(Formula::Number(value), span, 1)
    }

    fn word(&mut self) -> Result<Node, Diagnostic> {
        let word = self.slice(self.current.span);
        if self.second().token == Token::Symbol("(") && (word == "if" || !RESERVED.contains(&word))
        {
            return self.call(word);
        }
        match word {
            "pi" => {
                let span = self.advance();
                self.number(Formula::Pi, span, 1)
            }
            "inf" => {
                let span = self.advance();
                self.number(Formula::Infinity, span, 1)
            }
            _ => {
                let (name, span) = self.name()?;
                self.mention(&name, span, MentionKind::Value);
                self.number(Formula::Name(name), span, 1)
            }
        }
    }

    /// A name that is not a word of the language.
    fn name(&mut self) -> Result<(Name, Span), Diagnostic> {
        if self.current.token != Token::Word {
            return Err(self.unexpected("a name"));
        }
        let word = self.slice(self.current.span);
        if !is_reserved(word) {
            return Ok((word.into(), self.advance()));
        }
        let mut error = self.unexpected("a name");
        error.message = format!("`{word}` is a word of the language, not a name");
        error.hint = callable()
            .any(|known| known == word)
            .then(|| format!("its arguments stand in brackets: `{word}(...)`"));
        Err(error)
    }
}

/// The exact value of `12` or `0.05`.
fn decimal(text: &str) -> Option<Rational> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let fraction = fraction.trim_end_matches('0');
    let digits: BigInt = format!("{whole}{fraction}").parse().ok()?;
    let places = u32::try_from(fraction.len()).ok()?;
    Some(Rational::new(digits, BigInt::from(10).pow(places)))
}

/// The first 40 characters.
fn clip(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_string(),
    }
}
