//! Declarations, as claims and canonical propositions write them: `given` and `draw` lines.

use super::statement::repeated;
use super::{Parsed, Parser, whole};
use crate::formula::{
    Condition, Diagnostic, Draw, Formula, FunctionKind, Law, Name, Parameter, ParameterKind,
    Proposition, Span, lexer::Token, nearest,
};

/// What a `given` line declares.
#[derive(Clone, Debug, Default)]
pub(crate) struct Given {
    pub parameters: Vec<(Parameter, Span)>,
    pub domain: Vec<Condition>,
}

impl Parser<'_> {
    /// `int k, n with 1 <= k <= n; real I > 0; fn f(x) continuous on a..b`
    pub(crate) fn given(&mut self) -> Result<Given, Diagnostic> {
        let mut given = Given::default();
        loop {
            if self.eat_word("int") {
                self.numbers(&ParameterKind::Integer, &mut given)?;
            } else if self.eat_word("real") {
                self.numbers(&ParameterKind::Real, &mut given)?;
            } else if self.eat_word("fn") {
                self.functions(&mut given)?;
            } else {
                return Err(self.unexpected("`int`, `real` or `fn`"));
            }
            if self.eat_word("with") {
                match self.condition()? {
                    Condition::And(items) => given.domain.extend(items),
                    condition => given.domain.push(condition),
                }
            }
            if !self.eat_symbol(";") || self.current.token == Token::End {
                break;
            }
        }
        match self.current.token {
            Token::End => Ok(given),
            _ => Err(self.after_group()),
        }
    }

    fn after_group(&self) -> Diagnostic {
        let mut error = self.unexpected("`,`, `;` or `with`");
        if self.at_symbol(",") {
            error.hint = Some("after `with COND` comes `;` and the next type".to_string());
        }
        error
    }

    fn numbers(&mut self, kind: &ParameterKind, given: &mut Given) -> Result<(), Diagnostic> {
        loop {
            if self.current.token == Token::Number {
                let mut error = self.unexpected("a name");
                error.hint = Some("write `int k with 1 <= k`".to_string());
                return Err(error);
            }
            let (name, span) = self.name()?;
            let parameter = Parameter {
                name: name.clone(),
                kind: kind.clone(),
            };
            given.parameters.push((parameter, span));
            let mut links = Vec::new();
            while let Some(relation) = self.relation() {
                self.advance();
                links.push((relation, self.formula()?));
            }
            if !links.is_empty() {
                let condition = Condition::Chain(Formula::Name(name), links);
                given.domain.push(condition);
            }
            if !self.eat_symbol(",") {
                return Ok(());
            }
            if ["int", "real", "fn"].iter().any(|w| self.at_word(w)) {
                let mut error = self.unexpected("a name");
                error.hint = Some("write `;` before the next type".to_string());
                return Err(error);
            }
        }
    }

    fn functions(&mut self, given: &mut Given) -> Result<(), Diagnostic> {
        let mut heads = Vec::new();
        loop {
            let (name, span) = self.name()?;
            let open = self.expect_symbol("(")?;
            let (argument, _) = self.name()?;
            self.close(")", open)?;
            heads.push((name, span, argument));
            if !self.eat_symbol(",") {
                break;
            }
        }
        let kind = self.function_kind()?;
        let (from, to) = if self.eat_word("on") {
            let (from, to, _) = self.range()?;
            (from, to)
        } else if kind == FunctionKind::Polynomial {
            let below = Formula::Negate(Box::new(Formula::Infinity));
            (below, Formula::Infinity)
        } else {
            return Err(self.unexpected("`on a..b`"));
        };
        for (name, span, argument) in heads {
            let kind = ParameterKind::Function {
                argument,
                kind,
                from: from.clone(),
                to: to.clone(),
            };
            given.parameters.push((Parameter { name, kind }, span));
        }
        Ok(())
    }

    fn function_kind(&mut self) -> Result<FunctionKind, Diagnostic> {
        let kinds = [
            ("continuous", FunctionKind::Continuous),
            ("integrable", FunctionKind::Integrable),
            ("polynomial", FunctionKind::Polynomial),
            ("density", FunctionKind::Density),
        ];
        for (word, kind) in kinds {
            if self.eat_word(word) {
                return Ok(kind);
            }
        }
        if !self.eat_word("smooth") {
            return Err(self.unknown_kind());
        }
        let open = self.expect_symbol("(")?;
        let span = self.current.span;
        let times = self.slice(span).parse::<u32>();
        let times = times.map_err(|_| self.unexpected("a small whole number"))?;
        self.advance();
        self.close(")", open)?;
        Ok(FunctionKind::Smooth(times))
    }

    fn unknown_kind(&self) -> Diagnostic {
        let words = [
            "continuous",
            "integrable",
            "smooth",
            "polynomial",
            "density",
        ];
        let mut error =
            self.unexpected("`continuous`, `integrable`, `smooth(n)`, `polynomial` or `density`");
        let near = nearest(self.slice(self.current.span), words);
        error.hint = near.map(|near| format!("write `{near}`"));
        error
    }

    /// `X, Y ~ LAW`, with the places of the names.
    pub(crate) fn draws(&mut self) -> Result<Vec<(Draw, Span)>, Diagnostic> {
        let mut names = vec![self.name()?];
        while self.eat_symbol(",") {
            names.push(self.name()?);
        }
        self.expect_symbol("~")?;
        let law = self.law()?;
        Ok(names
            .into_iter()
            .map(|(name, span)| {
                let law: Law = law.clone();
                (Draw { name, law }, span)
            })
            .collect())
    }

    /// `NAME = EXPR` or `F(r, s) = EXPR`: the name, its place, the arguments and the body.
    pub(crate) fn definition_line(
        &mut self,
    ) -> Result<(Name, Span, Vec<Name>, Formula), Diagnostic> {
        let (name, span) = self.name()?;
        let mut arguments = Vec::new();
        if self.at_symbol("(") {
            let open = self.advance();
            loop {
                arguments.push(self.name()?.0);
                if !self.eat_symbol(",") {
                    break;
                }
            }
            self.close(")", open)?;
        }
        if let Some(twice) = repeated(&arguments) {
            return Err(self.error(span, format!("`{twice}` is given twice")));
        }
        if !self.eat_symbol("=") {
            let mut error = self.unexpected("`=`");
            error.hint = Some("write `let NAME = EXPR` or `let F(r) = EXPR`".to_string());
            return Err(error);
        }
        let start = self.mentions.len();
        let body = self.formula()?;
        for argument in &arguments {
            self.bind(start, argument);
        }
        Ok((name, span, arguments, body))
    }

    /// `COND` or `COND sufficient`
    pub(crate) fn needs(&mut self) -> Result<(Condition, bool, Span), Diagnostic> {
        let start = self.current.span.start;
        let condition = self.condition()?;
        let span = Span {
            start,
            end: self.previous,
        };
        let sufficient = self.eat_word("sufficient");
        if self.current.token == Token::Word {
            let mut error = self.unexpected("`sufficient` or the end");
            let near = nearest(self.slice(self.current.span), ["sufficient"]);
            error.hint = near.map(|near| format!("write `{near}`"));
            return Err(error);
        }
        Ok((condition, sufficient, span))
    }
}

/// The order of the lines of a canonical proposition.
const LINES: [&str; 4] = ["given", "domain", "draw", "says"];

pub(super) fn proposition(text: &str) -> Result<Proposition, Diagnostic> {
    let mut parameters = Vec::new();
    let mut domain = Vec::new();
    let mut draws = Vec::new();
    let mut statement = None;
    let mut reached = 0;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let offset = start;
        start += line.len();
        let line = line.strip_suffix('\n').unwrap_or(line);
        let (keyword, rest) = line.split_once(' ').unwrap_or((line, ""));
        let at = offset + line.len() - rest.len();
        let rank = LINES.iter().position(|known| *known == keyword);
        let Some(rank) = rank.filter(|rank| *rank >= reached && statement.is_none()) else {
            return Err(misplaced(offset, keyword));
        };
        reached = rank;
        match keyword {
            "given" => {
                let given = shifted(whole(rest, Parser::given), at)?;
                parameters.extend(given.parameters.into_iter().map(|(p, _)| p));
                domain.extend(given.domain);
            }
            "domain" => domain.push(shifted(whole(rest, Parser::condition), at)?),
            "draw" => {
                let list = shifted(whole(rest, Parser::draws), at)?;
                draws.extend(list.into_iter().map(|(draw, _)| draw));
            }
            _ => statement = Some(shifted(whole(rest, Parser::statement), at)?),
        }
    }
    let statement = statement.ok_or_else(|| Diagnostic {
        span: Span {
            start: text.len(),
            end: text.len(),
        },
        message: "a proposition ends with a `says` line".to_string(),
        hint: None,
    })?;
    Ok(Proposition {
        parameters,
        domain,
        draws,
        statement,
    })
}

fn misplaced(start: usize, keyword: &str) -> Diagnostic {
    Diagnostic {
        span: Span {
            start,
            end: start + keyword.len(),
        },
        message: "expected `given`, `domain`, `draw` and one `says`, in this order".to_string(),
        hint: None,
    }
}

fn shifted<T>(parsed: Result<Parsed<T>, Diagnostic>, by: usize) -> Result<T, Diagnostic> {
    parsed
        .map(|parsed| parsed.value)
        .map_err(|error| error.shifted(by))
}
