//! `claimcheck eval EXPR`: a value with rigorous digits.

use super::check::unwritable;
use super::output::{Exit, Failure, to_stdout};
use super::setting::settings;
use crate::evaluate::{self, Context, Failure as Failed, Outcome};
use crate::formula::{
    Budget, Draw, Formula, Name, Operator, Part, Point, Substitution, free_names, parse_formula,
    parse_law,
};
use clap::{Args, ValueEnum};
use std::collections::BTreeSet;

/// Evaluates a formula: digits that are proved, and the closed form where there is one
#[derive(Debug, Args)]
pub(super) struct Eval {
    /// The formula, as in claims
    #[arg(value_name = "EXPR", allow_hyphen_values = true)]
    formula: String,
    /// Values of names: k=5,n=10^3
    #[arg(long, value_name = "NAME=EXPR,...")]
    set: Vec<String>,
    /// A draw for mean, var and prob: x ~ beta(2, 3)
    #[arg(long, value_name = "NAME ~ LAW")]
    draw: Vec<String>,
    /// Digits of the value
    #[arg(long, value_name = "D", default_value_t = 50,
        value_parser = clap::value_parser!(u32).range(1..=100_000))]
    digits: u32,
    /// Counted steps that may be spent
    #[arg(long, value_name = "N", default_value_t = 20_000_000)]
    budget: u64,
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Human,
    Json,
}

/// What a formula came to.
#[derive(serde::Serialize)]
struct Answer {
    formula: String,
    /// The proved digits, `+inf` or `-inf`.
    value: String,
    /// The closed form.
    exact: Option<String>,
}

impl Eval {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let formula = parse(&self.formula, "EXPR")?;
        let budget = Budget::new(self.budget);
        let settings = settings(&self.set, &budget)?;
        let draws = self
            .draw
            .iter()
            .map(|draw| read_draw(draw))
            .collect::<Result<Vec<_>, _>>()?;
        let given = Given::new(&formula, settings, draws)?;
        let answer = given.evaluate(self.digits, &budget)?;
        to_stdout(&match self.format {
            Format::Human => human(&answer),
            Format::Json => serde_json::to_string_pretty(&answer).map_err(unwritable)? + "\n",
        })?;
        Ok(Exit::AsExpected)
    }
}

fn parse(text: &str, argument: &str) -> Result<Formula, Failure> {
    parse_formula(text).map_err(|error| Failure::at(argument, text, &error))
}

/// `NAME ~ LAW`
fn read_draw(text: &str) -> Result<Draw, Failure> {
    let Some((name, law)) = text.split_once('~') else {
        let hint = Some("write --draw 'x ~ beta(2, 3)'");
        return Err(Failure::input(&format!("`{text}` is no draw"), hint));
    };
    let law = parse_law(law).map_err(|error| Failure::at("--draw", law, &error))?;
    Ok(Draw {
        name: name.trim().into(),
        law,
    })
}

/// A formula of which all names have values or laws.
struct Given {
    formula: Formula,
    point: Point,
    draws: Vec<Draw>,
}

impl Given {
    fn new(
        formula: &Formula,
        settings: Vec<(Name, Formula)>,
        draws: Vec<Draw>,
    ) -> Result<Given, Failure> {
        let mut point = Point::default();
        let mut symbolic = Substitution::new();
        for (name, value) in settings {
            match value {
                Formula::Number(number) => {
                    point.numbers.insert(name, number);
                }
                other => symbolic.value(name, other),
            }
        }
        let too_large = |error| Failure::input(&format!("{error}"), None);
        let law = |draw: Draw| {
            let law = symbolic.law(&draw.law)?;
            Ok(Draw { law, ..draw })
        };
        let given = Given {
            formula: symbolic.formula(formula).map_err(too_large)?,
            draws: draws
                .into_iter()
                .map(law)
                .collect::<Result<_, _>>()
                .map_err(too_large)?,
            point,
        };
        match given.unknown().first() {
            None => Ok(given),
            Some(name) => Err(Failure::input(
                &format!("`{name}` has no value"),
                Some(&format!("add --set {name}=... or --draw '{name} ~ ...'")),
            )),
        }
    }

    /// Names in the formula that have neither a value nor a law, and names in laws without a value.
    fn unknown(&self) -> BTreeSet<Name> {
        let valued = |name: &Name| self.point.numbers.contains_key(name);
        let drawn = |name: &Name| self.draws.iter().any(|draw| draw.name == *name);
        let in_laws = self
            .draws
            .iter()
            .flat_map(|draw| Part::Law(&draw.law).free_names());
        let mut unknown: BTreeSet<Name> = in_laws.filter(|name| !valued(name)).collect();
        let free = free_names(&self.formula);
        unknown.extend(
            free.into_iter()
                .filter(|name| !valued(name) && !drawn(name)),
        );
        unknown
    }

    fn evaluate(&self, digits: u32, budget: &Budget) -> Result<Answer, Failure> {
        let context = Context {
            point: &self.point,
            draws: &self.draws,
            budget,
        };
        let exact = evaluate::exact(&self.formula, &context);
        let value = match evaluate::ladder(&self.formula, &context, digits) {
            Ok(Outcome::Value(interval)) => interval.to_decimal(digits as usize),
            Ok(Outcome::PlusInfinity) => "+inf".to_owned(),
            Ok(Outcome::MinusInfinity) => "-inf".to_owned(),
            Ok(Outcome::Undefined) => return Err(no_value(&self.formula, &context)),
            // The exact way knows better what is wrong with a number that is too large.
            Err(failure) => match exact {
                Err(too_large @ Failed::TooLarge(_)) => return Err(untold(&too_large)),
                _ => return Err(untold(&failure)),
            },
        };
        Ok(Answer {
            formula: self.formula.to_string(),
            value,
            exact: match exact {
                Ok(Outcome::Value(exact)) => Some(exact.to_string()),
                _ => None,
            },
        })
    }
}

/// The formula has no value, and the part of it that is to blame.
fn no_value(formula: &Formula, context: &Context) -> Failure {
    let part = culprit(formula, context);
    let reason = match part {
        Formula::Binary(Operator::Divide, _, divisor) => {
            format!("the divisor `{divisor}` is 0")
        }
        Formula::Call(function, _) => format!("it is no place where {} has one", function.name()),
        Formula::Binary(Operator::Power, ..) => "no such power is a real number".to_owned(),
        Formula::Factorial(_) => "no such factorial exists".to_owned(),
        _ => "the language gives it none".to_owned(),
    };
    Failure::input(&format!("`{part}` has no value: {reason}"), None)
}

/// The innermost part that has no value although all its own parts have one.
fn culprit<'a>(formula: &'a Formula, context: &Context) -> &'a Formula {
    let mut inner = None;
    Part::Formula(formula).each(&mut |part, bound| {
        if let (None, Part::Formula(part), []) = (inner, part, bound)
            && matches!(evaluate::exact(part, context), Ok(Outcome::Undefined))
        {
            inner = Some(part);
        }
    });
    inner.map_or(formula, |part| culprit(part, context))
}

/// The value cannot be told: no error of the user's, no fault of the program.
fn untold(reason: &Failed) -> Failure {
    Failure {
        exit: Exit::NotAsExpected,
        ..Failure::input(&format!("the value cannot be told: {reason}"), None)
    }
}

/// A closed form longer than a line tells a reader nothing; `--format json` has it.
const WIDTH: usize = 98;

fn human(answer: &Answer) -> String {
    let value = &answer.value;
    match &answer.exact {
        Some(exact) if exact != value && exact.len() <= WIDTH => format!("{value}\n= {exact}\n"),
        _ => format!("{value}\n"),
    }
}
