//! Statements: chains, expansions with their regimes, definitions, conditional ids.
//!
//! Outside brackets `and` joins statements; a condition's own `and` stands in brackets, or after
//! `ID if`, which therefore takes all that follows and comes last.

use super::{MentionKind, Node, Parser, RELATION, Value, power};
use crate::formula::{
    Diagnostic, Duty, Formula, Name, Regime, Relation, Span, Statement, Target, Tendency,
    lexer::{Token, lex},
};

impl Parser<'_> {
    pub(crate) fn statement(&mut self) -> Result<Statement, Diagnostic> {
        match self.text.trim() {
            "words" => return Ok(self.whole_word(Statement::Words)),
            "empty" => return Ok(self.whole_word(Statement::Empty)),
            _ => (),
        }
        let mut items = vec![self.single()?];
        while self.eat_word("and") {
            items.push(self.single()?);
        }
        if self.at_word("or") || self.at_word("not") {
            let mut error = self.unexpected("`and` or the end");
            error.hint = Some("statements are joined by `and`; a condition is a number in brackets: `[COND] == 1`".into());
            return Err(error);
        }
        Ok(match items.len() {
            1 => items.remove(0),
            _ => Statement::All(items),
        })
    }

    fn whole_word(&mut self, statement: Statement) -> Statement {
        self.advance();
        statement
    }

    fn single(&mut self) -> Result<Statement, Diagnostic> {
        if let Some(id) = self.conditional_id() {
            let condition = self.condition()?;
            return Ok(Statement::Conditional { id, condition });
        }
        let start = self.mentions.len();
        let left = self.expression(power::SUM)?;
        if self.at_word("is") {
            return self.definition(left, start);
        }
        let (first, _) = self.as_formula(left)?;
        let mut links = Vec::new();
        while let Some(relation) = self.statement_relation() {
            self.advance();
            let (right, _) = self.sum_level()?;
            links.push((relation, right));
        }
        if links.is_empty() {
            return Err(self.unexpected(RELATION));
        }
        let regime = if ["as", "uniformly", "along"].iter().any(|w| self.at_word(w)) {
            Some(self.regime()?)
        } else {
            None
        };
        Ok(Statement::Chain {
            first,
            links,
            regime,
        })
    }

    fn statement_relation(&self) -> Option<Relation> {
        match self.current.token {
            Token::Symbol("~") => Some(Relation::Asymptotic),
            Token::Symbol("=~") => Some(Relation::Approximate),
            _ => self.relation(),
        }
    }

    // ---- ids

    /// The id that starts with the current token; the token after it becomes the current one.
    pub(crate) fn identifier(&mut self) -> Result<(Name, Span), Diagnostic> {
        let start = self.current.span.start;
        let length = id_length(&self.text[start..]);
        if length == 0 {
            return Err(self.unexpected("an id"));
        }
        let span = Span {
            start,
            end: start + length,
        };
        self.previous = span.end;
        self.current = lex(self.text, span.end);
        Ok((self.slice(span).into(), span))
    }

    /// `ID if`, read and passed over, if it stands here.
    fn conditional_id(&mut self) -> Option<Name> {
        let start = self.current.span.start;
        let length = id_length(&self.text[start..]);
        let next = lex(self.text, start + length);
        let is_if = next.token == Token::Word && self.slice(next.span) == "if";
        if length == 0 || !is_if || next.span.start == start + length {
            return None;
        }
        let id = self.text[start..start + length].into();
        self.current = next;
        self.advance();
        Some(id)
    }

    // ---- definitions

    /// `f(r) is EXPR with density on a..b, agrees ID`
    fn definition(&mut self, left: Node, start: usize) -> Result<Statement, Diagnostic> {
        self.mentions.truncate(start);
        let span = left.span;
        let (name, arguments) = match left.value {
            Value::Number(Formula::Name(name)) => (name, Vec::new()),
            Value::Number(Formula::Apply(name, list)) => {
                let names = list.into_iter().map(|argument| match argument {
                    Formula::Name(name) => Ok(name),
                    _ => Err(self.error(span, "the arguments of a definition are names")),
                });
                (name, names.collect::<Result<Vec<Name>, _>>()?)
            }
            _ => {
                let mut error = self.error(span, "what stands before `is` is no symbol");
                error.hint = Some("write `f(r) is EXPR`".to_string());
                return Err(error);
            }
        };
        if let Some(twice) = repeated(&arguments) {
            return Err(self.error(span, format!("`{twice}` is given twice")));
        }
        self.expect_word("is")?;
        let (body, _) = self.sum_level()?;
        for argument in &arguments {
            self.bind(start, argument);
        }
        let duties = self.duties()?;
        Ok(Statement::Definition {
            name,
            arguments,
            body,
            duties,
        })
    }

    fn duties(&mut self) -> Result<Vec<Duty>, Diagnostic> {
        let mut duties = Vec::new();
        if self.eat_word("with") && !self.at_duty() {
            return Err(self.unexpected("`density on a..b`, `cdf on a..b` or `agrees ID`"));
        }
        while self.at_duty() {
            duties.push(self.duty()?);
            let joined = self.at_symbol(",") || self.at_word("and");
            if joined && self.duty_follows() {
                self.advance();
            }
        }
        Ok(duties)
    }

    fn at_duty(&self) -> bool {
        self.is_duty(self.slice(self.current.span), self.current.span.end)
    }

    fn duty_follows(&self) -> bool {
        let next = self.second();
        self.is_duty(self.slice(next.span), next.span.end)
    }

    fn is_duty(&self, word: &str, end: usize) -> bool {
        let next = lex(self.text, end);
        match word {
            "density" | "cdf" => self.slice(next.span) == "on",
            "agrees" => id_length(&self.text[next.span.start..]) > 0,
            _ => false,
        }
    }

    fn duty(&mut self) -> Result<Duty, Diagnostic> {
        if self.eat_word("agrees") {
            return Ok(Duty::Agrees(self.identifier()?.0));
        }
        let density = self.eat_word("density");
        if !density {
            self.expect_word("cdf")?;
        }
        self.expect_word("on")?;
        let (from, to, _) = self.range()?;
        Ok(match density {
            true => Duty::Density(from, to),
            false => Duty::Cumulative(from, to),
        })
    }

    // ---- regimes

    /// `as n -> inf then k -> inf uniformly in l along m = EXPR`; any part may be left out.
    pub(crate) fn regime(&mut self) -> Result<Regime, Diagnostic> {
        let start = self.current.span.start;
        let mut regime = Regime::default();
        if self.eat_word("as") {
            regime.limits.push(self.joint_limit()?);
            while self.eat_word("then") {
                regime.limits.push(self.joint_limit()?);
            }
        }
        loop {
            if regime.uniformly.is_empty() && self.eat_word("uniformly") {
                regime.uniformly = self.uniform_names()?;
            } else if regime.along.is_empty() && self.eat_word("along") {
                regime.along = self.path()?;
            } else {
                break;
            }
        }
        if regime == Regime::default() {
            let mut error = self.unexpected("a regime");
            error.span.start = start;
            error.hint = Some("write `as k -> inf`, `uniformly in l` or `along k = EXPR`".into());
            return Err(error);
        }
        Ok(regime)
    }

    /// `n, k, n/k -> inf, x -> 0+`
    fn joint_limit(&mut self) -> Result<Vec<Tendency>, Diagnostic> {
        let mut limit = Vec::new();
        loop {
            let mut quantities = vec![self.sum_level()?.0];
            while self.eat_symbol(",") {
                quantities.push(self.sum_level()?.0);
            }
            if !self.eat_symbol("->") {
                let mut error = self.unexpected("`->`");
                error.hint = error.hint.or_else(|| Some("write `as k -> inf`".into()));
                return Err(error);
            }
            let target = self.target()?;
            limit.extend(quantities.into_iter().map(|quantity| Tendency {
                quantity,
                target: target.clone(),
            }));
            if !self.eat_symbol(",") {
                return Ok(limit);
            }
        }
    }

    fn target(&mut self) -> Result<Target, Diagnostic> {
        let signed = std::mem::replace(&mut self.signed, true);
        let (place, _) = self.sum_level()?;
        self.signed = signed;
        if self.eat_symbol("+") {
            return Ok(Target::Above(place));
        }
        if self.eat_symbol("-") {
            return Ok(Target::Below(place));
        }
        Ok(match place {
            Formula::Infinity => Target::Infinity,
            _ => Target::Point(place),
        })
    }

    fn uniform_names(&mut self) -> Result<Vec<Name>, Diagnostic> {
        self.expect_word("in")?;
        let mut names = Vec::new();
        loop {
            let (name, span) = self.name()?;
            if names.contains(&name) {
                return Err(self.error(span, format!("`{name}` is given twice")));
            }
            self.mention(&name, span, MentionKind::Value);
            names.push(name);
            if !self.eat_symbol(",") {
                return Ok(names);
            }
        }
    }

    fn path(&mut self) -> Result<Vec<(Name, Formula)>, Diagnostic> {
        let mut path: Vec<(Name, Formula)> = Vec::new();
        loop {
            let (name, span) = self.name()?;
            if path.iter().any(|(other, _)| *other == name) {
                return Err(self.error(span, format!("`{name}` is given twice")));
            }
            self.mention(&name, span, MentionKind::Value);
            if !self.eat_symbol("=") {
                let mut error = self.unexpected("`=`");
                error.hint = Some("write `along k = EXPR, v = EXPR`".to_string());
                return Err(error);
            }
            path.push((name, self.sum_level()?.0));
            if !self.eat_symbol(",") {
                return Ok(path);
            }
        }
    }
}

/// The number of bytes of the id that the text begins with: letters, digits, `.`, `-`, beginning with
/// a letter or a digit.
pub(crate) fn id_length(text: &str) -> usize {
    if !text.starts_with(|c: char| c.is_ascii_alphanumeric()) {
        return 0;
    }
    text.find(|c: char| !(c.is_ascii_alphanumeric() || c == '.' || c == '-'))
        .unwrap_or(text.len())
}

/// The first name that occurs twice.
pub(super) fn repeated(names: &[Name]) -> Option<&Name> {
    let mut seen = std::collections::BTreeSet::new();
    names.iter().find(|name| !seen.insert(*name))
}
