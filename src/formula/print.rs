//! Trees to canonical text: fewest brackets, one spelling, and it parses back to the same tree.
//!
//! A number that no text denotes by itself (negative, or 1/3: only substitution makes these) is
//! printed as the formula of the same value, in brackets where needed.

use super::parser::density_argument;
use super::{
    Condition, Draw, Duty, Formula, Function, FunctionKind, Law, Operator, Parameter,
    ParameterKind, Proposition, RangeKind, Rational, Regime, Relation, Statement, Target, Tendency,
};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use std::fmt::{Display, Formatter, Result};

/// How tightly a printed text holds together.
mod level {
    pub const SUM: u8 = 1;
    pub const PRODUCT: u8 = 2;
    pub const UNARY: u8 = 3;
    pub const POWER: u8 = 4;
    pub const POSTFIX: u8 = 5;
    pub const ATOM: u8 = 6;
}

impl Display for Formula {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        formula(self, level::SUM, f)
    }
}

fn formula_level(tree: &Formula) -> u8 {
    match tree {
        Formula::Number(value) if decimal_places(value).is_none() => level::PRODUCT,
        Formula::Number(value) if value.is_negative() => level::UNARY,
        Formula::Negate(_) => level::UNARY,
        Formula::Factorial(_) => level::POSTFIX,
        Formula::Binary(operator, _, _) => match operator {
            Operator::Add | Operator::Subtract => level::SUM,
            Operator::Multiply | Operator::Divide => level::PRODUCT,
            Operator::Power => level::POWER,
        },
        _ => level::ATOM,
    }
}

/// Prints the tree, in brackets if it holds together less than `least`.
fn formula(tree: &Formula, least: u8, f: &mut Formatter<'_>) -> Result {
    if formula_level(tree) < least {
        f.write_str("(")?;
        bare(tree, f)?;
        return f.write_str(")");
    }
    bare(tree, f)
}

fn bare(tree: &Formula, f: &mut Formatter<'_>) -> Result {
    match tree {
        Formula::Number(value) => number(value, f),
        Formula::Pi => f.write_str("pi"),
        Formula::Infinity => f.write_str("inf"),
        Formula::Name(name) => f.write_str(name),
        Formula::Negate(inner) => {
            f.write_str("-")?;
            formula(inner, level::UNARY, f)
        }
        Formula::Binary(operator, left, right) => binary(*operator, left, right, f),
        Formula::Factorial(inner) => {
            formula(inner, level::POSTFIX, f)?;
            f.write_str("!")
        }
        Formula::Apply(name, list) => call(name, list, f),
        Formula::Call(function, list) => known(*function, list, f),
        Formula::Truth(condition) => write!(f, "({condition})"),
        Formula::Indicator(condition) => write!(f, "[{condition}]"),
        _ => form(tree, f),
    }
}

fn binary(operator: Operator, left: &Formula, right: &Formula, f: &mut Formatter<'_>) -> Result {
    let (before, sign, after) = match operator {
        Operator::Add => (level::SUM, " + ", level::PRODUCT),
        Operator::Subtract => (level::SUM, " - ", level::PRODUCT),
        Operator::Multiply => (level::PRODUCT, "*", level::UNARY),
        Operator::Divide => (level::PRODUCT, "/", level::UNARY),
        Operator::Power => (level::POSTFIX, "^", level::UNARY),
    };
    formula(left, before, f)?;
    f.write_str(sign)?;
    formula(right, after, f)
}

fn call(name: &str, list: &[Formula], f: &mut Formatter<'_>) -> Result {
    write!(f, "{name}(")?;
    separated(list, ", ", f)?;
    f.write_str(")")
}

fn known(function: Function, list: &[Formula], f: &mut Formatter<'_>) -> Result {
    match (function, list) {
        (Function::Hyp2F1 | Function::Hyp2F1Regularized, [a, b, c, z]) => {
            write!(f, "{}({a}, {b}; {c}; {z})", function.name())
        }
        _ => call(function.name(), list, f),
    }
}

fn form(tree: &Formula, f: &mut Formatter<'_>) -> Result {
    match tree {
        Formula::Ranged(r) => {
            let word = match r.kind {
                RangeKind::Sum => "sum",
                RangeKind::Integral => "int",
                RangeKind::Supremum => "sup",
                RangeKind::Infimum => "infimum",
            };
            write!(f, "{word}({}, {} = {}..{})", r.body, r.name, r.from, r.to)
        }
        Formula::Antiderivative(body, name) => write!(f, "int({body}, {name})"),
        Formula::Derivative(body, name, order) => match order.as_ref() {
            Formula::Number(n) if n.is_one() => write!(f, "diff({body}, {name})"),
            _ => write!(f, "diff({body}, {name}, {order})"),
        },
        Formula::At(body, list) => bound("at", body, "=", list, f),
        Formula::Limit(body, list) => bound("lim", body, "->", list, f),
        Formula::If(condition, yes, no) => write!(f, "if({condition}, {yes}, {no})"),
        Formula::Mean(body, draw) => moment("mean", body.as_ref(), draw.as_deref(), f),
        Formula::Variance(body, draw) => moment("var", body.as_ref(), draw.as_deref(), f),
        Formula::Probability(body, draw) => moment("prob", body.as_ref(), draw.as_deref(), f),
        Formula::Density(quantity, point) => write!(f, "density({quantity}, {point})"),
        Formula::Cumulative(quantity, point) => write!(f, "cdf({quantity}, {point})"),
        Formula::BigO(inner) => write!(f, "O({inner})"),
        Formula::LittleO(inner) => write!(f, "o({inner})"),
        // `bare` prints all others itself.
        _ => Ok(()),
    }
}

fn bound(
    word: &str,
    body: &Formula,
    sign: &str,
    list: &[(super::Name, Formula)],
    f: &mut Formatter<'_>,
) -> Result {
    write!(f, "{word}({body}")?;
    for (name, value) in list {
        write!(f, ", {name} {sign} {value}")?;
    }
    f.write_str(")")
}

fn moment(word: &str, body: &impl Display, draw: Option<&Draw>, f: &mut Formatter<'_>) -> Result {
    match draw {
        Some(draw) => write!(f, "{word}({body}, {draw})"),
        None => write!(f, "{word}({body})"),
    }
}

fn separated<T: Display>(list: &[T], separator: &str, f: &mut Formatter<'_>) -> Result {
    for (index, item) in list.iter().enumerate() {
        if index > 0 {
            f.write_str(separator)?;
        }
        write!(f, "{item}")?;
    }
    Ok(())
}

/// How many decimal places the number has, if they end and are few enough to be written out.
fn decimal_places(value: &Rational) -> Option<u32> {
    let twos = value.denom().trailing_zeros().unwrap_or(0);
    if twos > 20_000 {
        return None;
    }
    let mut rest: BigInt = value.denom() >> twos;
    let mut fives = 0u64;
    let five = BigInt::from(5);
    while !rest.is_one() {
        let (quotient, remainder) = rest.div_rem(&five);
        if !remainder.is_zero() || fives == 20_000 {
            return None;
        }
        rest = quotient;
        fives += 1;
    }
    u32::try_from(twos.max(fives)).ok()
}

fn number(value: &Rational, f: &mut Formatter<'_>) -> Result {
    match decimal_places(value) {
        None => write!(f, "{}/{}", value.numer(), value.denom()),
        Some(0) => write!(f, "{}", value.numer()),
        Some(places) => {
            let scaled = (value * BigInt::from(10).pow(places)).to_integer();
            let sign = if scaled.is_negative() { "-" } else { "" };
            let width = places as usize + 1;
            let digits = format!("{:0>width$}", scaled.magnitude().to_string());
            let (whole, fraction) = digits.split_at(digits.len() - places as usize);
            write!(f, "{sign}{whole}.{fraction}")
        }
    }
}

impl Display for Relation {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Relation::Equal => "==",
            Relation::NotEqual => "!=",
            Relation::Less => "<",
            Relation::LessEqual => "<=",
            Relation::Greater => ">",
            Relation::GreaterEqual => ">=",
            Relation::Asymptotic => "~",
            Relation::Approximate => "=~",
        })
    }
}

impl Display for Condition {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Condition::Chain(first, links) => chain(first, links, f),
            Condition::And(items) => joined(items, " and ", 3, f),
            Condition::Or(items) => joined(items, " or ", 2, f),
            Condition::Not(inner) => {
                f.write_str("not ")?;
                condition(inner, 3, f)
            }
        }
    }
}

fn condition(tree: &Condition, least: u8, f: &mut Formatter<'_>) -> Result {
    let level = match tree {
        Condition::Or(_) => 1,
        Condition::And(_) => 2,
        Condition::Not(_) | Condition::Chain(..) => 3,
    };
    match level < least {
        true => write!(f, "({tree})"),
        false => write!(f, "{tree}"),
    }
}

fn joined(items: &[Condition], word: &str, least: u8, f: &mut Formatter<'_>) -> Result {
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            f.write_str(word)?;
        }
        condition(item, least, f)?;
    }
    Ok(())
}

fn chain(first: &Formula, links: &[(Relation, Formula)], f: &mut Formatter<'_>) -> Result {
    write!(f, "{first}")?;
    for (relation, right) in links {
        write!(f, " {relation} {right}")?;
    }
    Ok(())
}

impl Display for Law {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Law::Beta(a, b) => write!(f, "beta({a}, {b})"),
            Law::Uniform(a, b) => write!(f, "uniform({a}, {b})"),
            Law::Order(l, m, law) => write!(f, "order({l}, {m}) of {law}"),
            Law::Density {
                argument,
                body,
                from,
                to,
            } => {
                match body {
                    Formula::Apply(name, list)
                        if *argument == density_argument(name)
                            && *list == [Formula::Name(argument.clone())] =>
                    {
                        write!(f, "density {name}")?;
                    }
                    _ => write!(f, "density {argument} -> {body}")?,
                }
                write!(f, " on {from}..{to}")
            }
            Law::Any => f.write_str("any"),
        }
    }
}

impl Display for Draw {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{} ~ {}", self.name, self.law)
    }
}

impl Display for Statement {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Statement::Chain {
                first,
                links,
                regime,
            } => {
                chain(first, links, f)?;
                match regime {
                    Some(regime) => write!(f, " {regime}"),
                    None => Ok(()),
                }
            }
            Statement::All(items) => separated(items, " and ", f),
            Statement::Definition {
                name,
                arguments,
                body,
                duties,
            } => {
                f.write_str(name)?;
                if !arguments.is_empty() {
                    f.write_str("(")?;
                    separated(arguments, ", ", f)?;
                    f.write_str(")")?;
                }
                write!(f, " is {body}")?;
                if !duties.is_empty() {
                    f.write_str(" with ")?;
                }
                separated(duties, ", ", f)
            }
            Statement::Conditional { id, condition } => write!(f, "{id} if {condition}"),
            Statement::Words => f.write_str("words"),
            Statement::Empty => f.write_str("empty"),
        }
    }
}

impl Display for Duty {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Duty::Density(from, to) => write!(f, "density on {from}..{to}"),
            Duty::Cumulative(from, to) => write!(f, "cdf on {from}..{to}"),
            Duty::Agrees(id) => write!(f, "agrees {id}"),
        }
    }
}

impl Display for Target {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Target::Infinity => f.write_str("inf"),
            Target::Point(place) => write!(f, "{place}"),
            Target::Above(place) => write!(f, "{place}+"),
            Target::Below(place) => write!(f, "{place}-"),
        }
    }
}

impl Display for Regime {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let mut parts = Vec::new();
        for (index, limit) in self.limits.iter().enumerate() {
            let word = if index == 0 { "as" } else { "then" };
            parts.push(format!("{word} {}", joint(limit)));
        }
        if !self.uniformly.is_empty() {
            parts.push(format!("uniformly in {}", self.uniformly.join(", ")));
        }
        if !self.along.is_empty() {
            let path = self.along.iter().map(|(name, e)| format!("{name} = {e}"));
            parts.push(format!("along {}", path.collect::<Vec<_>>().join(", ")));
        }
        f.write_str(&parts.join(" "))
    }
}

/// `n, k, n/k -> inf, x -> 0+`: quantities in a row with one target share it.
fn joint(limit: &[Tendency]) -> String {
    let mut text = String::new();
    for (index, tendency) in limit.iter().enumerate() {
        text += &tendency.quantity.to_string();
        match limit.get(index + 1) {
            Some(next) if next.target == tendency.target => text += ", ",
            Some(_) => text += &format!(" -> {}, ", tendency.target),
            None => text += &format!(" -> {}", tendency.target),
        }
    }
    text
}

impl Display for Parameter {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.kind {
            ParameterKind::Integer => write!(f, "int {}", self.name),
            ParameterKind::Real => write!(f, "real {}", self.name),
            ParameterKind::Function {
                argument,
                kind,
                from,
                to,
            } => write!(f, "fn {}({argument}) {kind} on {from}..{to}", self.name),
        }
    }
}

impl Display for FunctionKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            FunctionKind::Continuous => f.write_str("continuous"),
            FunctionKind::Integrable => f.write_str("integrable"),
            FunctionKind::Smooth(times) => write!(f, "smooth({times})"),
            FunctionKind::Polynomial => f.write_str("polynomial"),
            FunctionKind::Density => f.write_str("density"),
        }
    }
}

impl Display for Proposition {
    /// One line a declaration: `given`, `domain`, `draw`, then `says`.
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        for parameter in &self.parameters {
            writeln!(f, "given {parameter}")?;
        }
        for condition in &self.domain {
            writeln!(f, "domain {condition}")?;
        }
        for draw in &self.draws {
            writeln!(f, "draw {draw}")?;
        }
        write!(f, "says {}", self.statement)
    }
}
