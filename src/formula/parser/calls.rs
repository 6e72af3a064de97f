//! Calls: known functions, sums and integrals, derivatives, limits, means, and functions of the scope.

use super::{MentionKind, Node, Parser, power};
use crate::formula::{
    Diagnostic, Draw, Formula, Function, Name, RangeKind, Ranged, Span, lexer::Token,
};

/// What the form of a call gave: a formula, the depth of its deepest part.
type Made = Result<(Formula, usize), Diagnostic>;

impl Parser<'_> {
    /// `word(...)`, the current token being the word.
    pub(super) fn call(&mut self, word: &str) -> Result<Node, Diagnostic> {
        let name = self.advance();
        let open = self.advance();
        let signed = std::mem::replace(&mut self.signed, false);
        let place = Place { name, open };
        let (formula, depth) = match word {
            "sum" => self.ranged(RangeKind::Sum),
            "int" => self.ranged(RangeKind::Integral),
            "sup" => self.ranged(RangeKind::Supremum),
            "infimum" => self.ranged(RangeKind::Infimum),
            "diff" => self.derivative(),
            "at" => self.bindings("=", Formula::At),
            "lim" => self.bindings("->", Formula::Limit),
            "if" => self.choice(),
            "mean" => self.moment(Formula::Mean),
            "var" => self.moment(Formula::Variance),
            "prob" => self.probability(),
            "density" => self.of_law(Formula::Density),
            "cdf" => self.of_law(Formula::Cumulative),
            "O" => self.order(place, Formula::BigO),
            "o" => self.order(place, Formula::LittleO),
            _ => match Function::ALL.into_iter().find(|f| f.name() == word) {
                Some(function) => self.known(function, place),
                None => self.applied(word, place),
            },
        }?;
        self.signed = signed;
        let span = Span {
            start: name.start,
            end: self.close(")", open)?,
        };
        self.number(formula, span, depth + 1)
    }

    /// One argument: a number; a condition there is for the judge to refuse.
    fn argument(&mut self) -> Made {
        let node = self.expression(power::OR)?;
        self.as_formula(node)
    }

    fn arguments(&mut self, semicolons: bool) -> Result<(Vec<Formula>, usize), Diagnostic> {
        let mut list = Vec::new();
        let mut depth = 0;
        if self.at_symbol(")") {
            return Ok((list, depth));
        }
        loop {
            let (argument, deep) = self.argument()?;
            depth = depth.max(deep);
            list.push(argument);
            if !(self.eat_symbol(",") || semicolons && self.eat_symbol(";")) {
                return Ok((list, depth));
            }
        }
    }

    fn known(&mut self, function: Function, place: Place) -> Made {
        let hypergeometric = matches!(function, Function::Hyp2F1 | Function::Hyp2F1Regularized);
        let (list, depth) = self.arguments(hypergeometric)?;
        let open_ended = matches!(function, Function::Min | Function::Max);
        let fits = list.len() == function.arity() || open_ended && list.len() > function.arity();
        // A wrong number of arguments is told only where nothing worse stands.
        if !fits && (self.at_symbol(")") || self.at_symbol(";")) {
            return Err(self.arity(function, list.len(), open_ended, place));
        }
        Ok((Formula::Call(function, list), depth))
    }

    fn arity(&self, function: Function, found: usize, more: bool, place: Place) -> Diagnostic {
        let name = function.name();
        let wanted = function.arity();
        let plural = if wanted == 1 { "" } else { "s" };
        let least = if more { "at least " } else { "" };
        let span = Span {
            start: place.name.start,
            end: self.current.span.end.max(place.open.end),
        };
        let mut error = self.error(
            span,
            format!("`{name}` takes {least}{wanted} argument{plural}, found {found}"),
        );
        error.hint = match function {
            Function::Hyp2F1 | Function::Hyp2F1Regularized => {
                Some(format!("write `{name}(a, b; c; z)`"))
            }
            _ => None,
        };
        error
    }

    fn applied(&mut self, word: &str, place: Place) -> Made {
        let index = self.mentions.len();
        // The mention stands before those of the arguments, in the order of the text.
        self.mention(word, place.name, MentionKind::Function(0));
        let (list, depth) = self.arguments(false)?;
        if list.is_empty() {
            return Err(self.error(place.name, format!("`{word}` has no arguments")));
        }
        self.mentions[index].kind = MentionKind::Function(list.len());
        Ok((Formula::Apply(word.into(), list), depth))
    }

    fn order(&mut self, place: Place, make: fn(Box<Formula>) -> Formula) -> Made {
        self.mention("", place.name, MentionKind::Order);
        let (formula, depth) = self.argument()?;
        Ok((make(Box::new(formula)), depth))
    }

    /// `a..b`
    pub(super) fn range(&mut self) -> Result<(Formula, Formula, usize), Diagnostic> {
        let (from, first) = self.sum_level()?;
        self.expect_symbol("..")?;
        let (to, second) = self.sum_level()?;
        Ok((from, to, first.max(second)))
    }

    fn comma(&mut self, form: &str) -> Result<(), Diagnostic> {
        if self.eat_symbol(",") {
            return Ok(());
        }
        let mut error = self.unexpected("`,`");
        error.hint = error.hint.or_else(|| Some(format!("write `{form}`")));
        Err(error)
    }

    fn ranged(&mut self, kind: RangeKind) -> Made {
        let form = match kind {
            RangeKind::Sum => "sum(e, j = a..b)",
            RangeKind::Integral => "int(e, x = a..b)",
            RangeKind::Supremum => "sup(e, k = a..b)",
            RangeKind::Infimum => "infimum(e, k = a..b)",
        };
        let start = self.mentions.len();
        let (body, deep) = self.argument()?;
        self.comma(form)?;
        let (name, span) = self.name()?;
        if kind == RangeKind::Integral && self.at_symbol(")") {
            self.mention(&name, span, MentionKind::Value);
            return Ok((Formula::Antiderivative(Box::new(body), name), deep));
        }
        self.bind(start, &name);
        self.expect_binding("=", form)?;
        let (from, to, depth) = self.range()?;
        let ranged = Ranged {
            kind,
            body,
            name,
            from,
            to,
        };
        Ok((Formula::Ranged(Box::new(ranged)), depth.max(deep)))
    }

    fn expect_binding(&mut self, symbol: &str, form: &str) -> Result<(), Diagnostic> {
        if self.eat_symbol(symbol) {
            return Ok(());
        }
        let mut error = self.unexpected(&format!("`{symbol}`"));
        error.hint = Some(format!("write `{form}`"));
        Err(error)
    }

    fn derivative(&mut self) -> Made {
        let (body, mut depth) = self.argument()?;
        self.comma("diff(e, x)")?;
        let (name, span) = self.name()?;
        self.mention(&name, span, MentionKind::Value);
        let mut order = Formula::integer(1);
        if self.eat_symbol(",") {
            let (given, deep) = self.argument()?;
            order = given;
            depth = depth.max(deep);
        }
        let formula = Formula::Derivative(Box::new(body), name, Box::new(order));
        Ok((formula, depth))
    }

    /// `e, x = a, y = b` or `e, x -> a, y -> b`
    fn bindings(
        &mut self,
        symbol: &str,
        make: fn(Box<Formula>, Vec<(Name, Formula)>) -> Formula,
    ) -> Made {
        let form = match symbol {
            "=" => "at(e, x = a)",
            _ => "lim(e, x -> a)",
        };
        let start = self.mentions.len();
        let (body, mut depth) = self.argument()?;
        let mut outside = self.mentions.split_off(start);
        std::mem::swap(&mut outside, &mut self.mentions);
        // Now `self.mentions` holds the body's, `outside` what came before.
        let mut list: Vec<(Name, Formula)> = Vec::new();
        self.comma(form)?;
        let inside = self.mentions.len();
        loop {
            let (name, span) = self.name()?;
            if list.iter().any(|(other, _)| *other == name) {
                return Err(self.error(span, format!("`{name}` is given twice")));
            }
            self.expect_binding(symbol, form)?;
            let (value, deep) = self.sum_level()?;
            depth = depth.max(deep);
            list.push((name, value));
            if !self.eat_symbol(",") {
                break;
            }
        }
        let values = self.mentions.split_off(inside);
        for (name, _) in &list {
            self.bind(0, name);
        }
        outside.append(&mut self.mentions);
        outside.extend(values);
        self.mentions = outside;
        Ok((make(Box::new(body), list), depth))
    }

    fn choice(&mut self) -> Made {
        let node = self.expression(power::OR)?;
        let (condition, first) = self.as_condition(node)?;
        self.comma("if(COND, a, b)")?;
        let (yes, second) = self.argument()?;
        self.comma("if(COND, a, b)")?;
        let (no, third) = self.argument()?;
        let formula = Formula::If(Box::new(condition), Box::new(yes), Box::new(no));
        Ok((formula, first.max(second).max(third)))
    }

    /// The `, x ~ LAW` that may end a mean, and the depth of the law; binds what stands since `start`.
    fn own_draw(&mut self, start: usize) -> Result<(Option<Box<Draw>>, usize), Diagnostic> {
        if !self.eat_symbol(",") {
            self.average(start);
            return Ok((None, 0));
        }
        let (name, _) = self.name()?;
        self.bind(start, &name);
        self.expect_symbol("~")?;
        let (law, depth) = self.law_with_depth()?;
        Ok((Some(Box::new(Draw { name, law })), depth))
    }

    /// What is mentioned since `start` stands inside a mean.
    fn average(&mut self, start: usize) {
        for mention in &mut self.mentions[start..] {
            mention.averaged = true;
        }
    }

    fn moment(&mut self, make: fn(Box<Formula>, Option<Box<Draw>>) -> Formula) -> Made {
        let start = self.mentions.len();
        let (body, depth) = self.argument()?;
        let (draw, deep) = self.own_draw(start)?;
        Ok((make(Box::new(body), draw), depth.max(deep)))
    }

    fn probability(&mut self) -> Made {
        let start = self.mentions.len();
        let node = self.expression(power::OR)?;
        let (condition, depth) = self.as_condition(node)?;
        let (draw, deep) = self.own_draw(start)?;
        let formula = Formula::Probability(Box::new(condition), draw);
        Ok((formula, depth.max(deep)))
    }

    fn of_law(&mut self, make: fn(Box<Formula>, Box<Formula>) -> Formula) -> Made {
        let start = self.mentions.len();
        let (quantity, first) = self.argument()?;
        self.average(start);
        self.comma("density(X, x)")?;
        let (point, second) = self.argument()?;
        Ok((make(Box::new(quantity), Box::new(point)), first.max(second)))
    }

    /// Whether the current token is a name that the symbol follows.
    pub(super) fn at_name_then(&self, symbol: &'static str) -> bool {
        self.current.token == Token::Word && self.second().token == Token::Symbol(symbol)
    }
}

/// Where a call begins.
#[derive(Clone, Copy)]
struct Place {
    name: Span,
    open: Span,
}
