//! Laws of draws: `beta(a, b)`, `uniform(a, b)`, `order(l, m) of LAW`, `density f on a..b`, `any`.
//!
//! `density x -> 2*x on 0..1` gives the density as a formula in `x`; `density f on a..b` is short
//! for `density x -> f(x) on a..b`, so that the canonical text of an unfolded law parses.

use super::{MentionKind, Parser};
use crate::formula::{Diagnostic, Formula, Law, Name, lexer::Token};

/// The argument's name in `density f on a..b`.
pub(crate) fn density_argument(function: &str) -> Name {
    if function == "x" { "y" } else { "x" }.into()
}

impl Parser<'_> {
    pub(crate) fn law(&mut self) -> Result<Law, Diagnostic> {
        self.law_with_depth().map(|(law, _)| law)
    }

    pub(super) fn law_with_depth(&mut self) -> Result<(Law, usize), Diagnostic> {
        self.enter()?;
        let (law, depth) = if self.eat_word("beta") {
            let (a, b, depth) = self.pair()?;
            (Law::Beta(a, b), depth)
        } else if self.eat_word("uniform") {
            let (a, b, depth) = self.pair()?;
            (Law::Uniform(a, b), depth)
        } else if self.eat_word("order") {
            let (l, m, depth) = self.pair()?;
            self.expect_word("of")?;
            let (law, deep) = self.law_with_depth()?;
            (Law::Order(l, m, Box::new(law)), depth.max(deep))
        } else if self.eat_word("density") {
            self.density_law()?
        } else if self.eat_word("any") {
            (Law::Any, 0)
        } else {
            return Err(self.unknown_law());
        };
        self.nesting -= 1;
        Ok((law, depth + 1))
    }

    fn unknown_law(&self) -> Diagnostic {
        let mut error = self.unexpected("a law");
        if self.current.token == Token::Word {
            let forms = "beta(a, b), uniform(a, b), order(l, m) of LAW, density f on a..b, any";
            error.hint = Some(format!("laws are {forms}"));
        }
        error
    }

    fn pair(&mut self) -> Result<(Formula, Formula, usize), Diagnostic> {
        let open = self.expect_symbol("(")?;
        let signed = std::mem::replace(&mut self.signed, false);
        let (first, a) = self.sum_level()?;
        self.expect_symbol(",")?;
        let (second, b) = self.sum_level()?;
        self.signed = signed;
        self.close(")", open)?;
        Ok((first, second, a.max(b)))
    }

    fn density_law(&mut self) -> Result<(Law, usize), Diagnostic> {
        let start = self.mentions.len();
        let (argument, body, deep) = if self.at_name_then("->") {
            let (argument, _) = self.name()?;
            self.expect_symbol("->")?;
            let (body, deep) = self.sum_level()?;
            self.bind(start, &argument);
            (argument, body, deep)
        } else {
            let (function, span) = self.name()?;
            self.mention(&function, span, MentionKind::Function(1));
            let argument = density_argument(&function);
            let body = Formula::Apply(function, vec![Formula::Name(argument.clone())]);
            (argument, body, 2)
        };
        self.expect_word("on")?;
        let (from, to, depth) = self.range()?;
        let law = Law::Density {
            argument,
            body,
            from,
            to,
        };
        Ok((law, depth.max(deep)))
    }
}
