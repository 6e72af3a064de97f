//! The Pratt parser proper: operators, relations, brackets, literals and names.

use super::{MAX_DIGITS, Mention, MentionKind, Parser, RESERVED, callable, is_reserved};
use crate::formula::{
    Condition, Diagnostic, Formula, Name, Operator, Rational, Relation, Span,
    lexer::{Lexeme, Token},
};
use num_bigint::BigInt;

/// A subtree while it is parsed.
pub(super) struct Node {
    pub value: Value,
    pub span: Span,
    pub depth: usize,
}

pub(super) enum Value {
    Number(Formula),
    Truth(Condition),
}

/// How tightly operators bind.
pub(super) mod power {
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

impl Parser<'_> {
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
    pub(super) fn sum_level(&mut self) -> Result<(Formula, usize), Diagnostic> {
        let node = self.expression(power::SUM)?;
        self.as_formula(node)
    }

    pub(super) fn as_formula(&mut self, node: Node) -> Result<(Formula, usize), Diagnostic> {
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

    pub(super) fn as_condition(&self, node: Node) -> Result<(Condition, usize), Diagnostic> {
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

    pub(super) fn mention(&mut self, name: &str, span: Span, kind: MentionKind) {
        self.mentions.push(Mention {
            name: name.into(),
            span,
            kind,
            averaged: false,
        });
    }

    /// Of the symbols mentioned since `from`, those called `name` are bound: they are no longer free.
    pub(super) fn bind(&mut self, from: usize, name: &str) {
        let tail = self.mentions.split_off(from);
        let free = tail
            .into_iter()
            .filter(|m| m.kind != MentionKind::Value || &*m.name != name);
        self.mentions.extend(free);
    }

    /// An expression whose operators bind at least as tightly as `least`.
    pub(super) fn expression(&mut self, least: u8) -> Result<Node, Diagnostic> {
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
    pub(super) fn relation(&self) -> Option<Relation> {
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
    pub(super) fn close(&mut self, bracket: &str, open: Span) -> Result<usize, Diagnostic> {
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
    pub(super) fn name(&mut self) -> Result<(Name, Span), Diagnostic> {
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
