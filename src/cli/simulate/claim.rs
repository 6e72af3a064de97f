//! `claimcheck simulate ID`: both sides of a claim from its own `draw` lines.

use super::super::library::Library;
use super::super::output::{Exit, Failure, of_run, to_stdout};
use super::super::setting::settings;
use crate::book::IllTyped;
use crate::corpus;
use crate::evaluate::{Context, holds};
use crate::formula::{Budget, Formula, Parameter, ParameterKind, Point, Proposition};
use crate::judge::{Settings, simulate};
use crate::report;
use crate::report::simulate::Statement;
use crate::simulate::verdict::battery::critical;

/// Steps that the values of `--set` may take.
const STEPS: u64 = 1_000_000;

/// What is asked of a claim.
pub(super) struct Asked<'a> {
    pub(super) id: &'a str,
    pub(super) library: &'a Library,
    pub(super) set: &'a [String],
    pub(super) runs: u64,
    pub(super) seed: u64,
    pub(super) level: f64,
}

impl Asked<'_> {
    /// Exit code 1 where a simulation contradicts a statement.
    pub(super) fn run(&self, json: bool) -> Result<Exit, Failure> {
        let book = self.library.open()?;
        let claims = corpus::chosen(&book, &[self.id.to_owned()]).map_err(of_run)?;
        let point = self.point()?;
        let mut statements = vec![];
        for claim in claims {
            let mended = claim.mended();
            let both = [("printed", Some(claim.printed())), ("mended", mended)];
            for (label, proposition) in both {
                if let Some(proposition) = proposition {
                    statements.push(self.statement(label, proposition, point.as_ref())?);
                }
            }
        }
        let tests = statements
            .iter()
            .map(|s| s.trials.done.len())
            .sum::<usize>();
        let least = critical(self.level / tests.max(1) as f64);
        to_stdout(&match json {
            false => report::simulate::statements(self.id, &statements, self.runs, least),
            true => report::simulate::statements_json(self.id, &statements, self.runs, least),
        })?;
        let contradicts = |statement: &Statement| statement.contradicts(least);
        Ok(match statements.iter().any(contradicts) {
            true => Exit::NotAsExpected,
            false => Exit::AsExpected,
        })
    }

    fn statement(
        &self,
        label: &'static str,
        proposition: Result<Proposition, IllTyped>,
        point: Option<&Point>,
    ) -> Result<Statement, Failure> {
        let proposition = proposition.map_err(|error| Failure::input(&error.to_string(), None))?;
        let given = point.map(|point| whole(point, &proposition)).transpose()?;
        let settings = Settings {
            seed: self.seed,
            ..Settings::default()
        };
        Ok(Statement {
            label,
            written: proposition.statement.to_string(),
            trials: simulate(&proposition, given.as_ref(), &settings, self.runs),
        })
    }

    /// The point that `--set` names, if it names any.
    fn point(&self) -> Result<Option<Point>, Failure> {
        let mut point = Point::default();
        for (name, value) in settings(self.set, &Budget::new(STEPS))? {
            let Formula::Number(number) = value else {
                let message = format!("the value of `{name}` is no rational number");
                return Err(Failure::input(&message, Some("write --set k=5,v=1/3")));
            };
            point.numbers.insert(name, number);
        }
        Ok((!point.numbers.is_empty()).then_some(point))
    }
}

/// The point, if it has a value for every parameter, and for these only.
fn whole(point: &Point, proposition: &Proposition) -> Result<Point, Failure> {
    let parameters = || {
        proposition
            .parameters
            .iter()
            .map(|parameter| &parameter.name)
    };
    let unknown = point
        .numbers
        .keys()
        .find(|name| parameters().all(|other| other != *name));
    if let Some(name) = unknown {
        let message = format!("the claim has no parameter `{name}`");
        return Err(Failure::input(&message, None));
    }
    if let Some(name) = parameters().find(|name| !point.numbers.contains_key(*name)) {
        let message = format!("the parameter `{name}` has no value");
        return Err(Failure::input(
            &message,
            Some(&format!("add {name}=... to --set")),
        ));
    }
    let fraction = proposition.parameters.iter().find(|parameter| {
        let value = point.numbers.get(&parameter.name);
        parameter.kind == ParameterKind::Integer && value.is_some_and(|value| !value.is_integer())
    });
    if let Some(Parameter { name, .. }) = fraction {
        let message = format!("the parameter `{name}` is an integer");
        return Err(Failure::input(&message, None));
    }
    let context = Context {
        point,
        draws: &[],
        budget: &Budget::new(STEPS),
    };
    let outside = proposition
        .domain
        .iter()
        .find(|condition| holds(condition, &context) == Ok(false));
    match outside {
        None => Ok(point.clone()),
        Some(condition) => {
            let message =
                format!("the point lies outside of the domain of the claim: `{condition}`");
            Err(Failure::input(&message, None))
        }
    }
}
