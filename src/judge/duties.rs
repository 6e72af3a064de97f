//! Definitions: what the text asks of the symbol that it brings in.

use super::Settings;
use super::finding::Finding;
use super::search::{Search, points};
use super::verdict::Verdict;
use crate::formula::{
    Budget, Condition, Duty, Formula, Name, Parameter, ParameterKind, Proposition, RangeKind,
    Ranged, Relation, Statement,
};

/// A definition stands when no duty fails: each is put as a relation of its own.
pub fn judge_duties(
    arguments: &[Name],
    body: &Formula,
    duties: &[Duty],
    proposition: &Proposition,
    number: usize,
    budget: &Budget,
    settings: &Settings,
) -> Finding {
    let mut finding = Finding::plain(Verdict::Defined);
    for (index, duty) in duties.iter().enumerate() {
        for (duty_proposition, relation) in duty_relations(arguments, body, duty, proposition) {
            let Statement::Chain { first, links, .. } = &duty_proposition.statement else {
                continue;
            };
            let points = points(&duty_proposition, budget, settings);
            // The kernel checks the duty on the definition itself; the relation only finds the point.
            let search = Search {
                proposition,
                points: &points,
                number: number + index,
                budget,
                settings,
            };
            let found = search.relation(first, relation, &links[0].1);
            match found.verdict {
                Verdict::Certified => finding.extent = found.extent,
                _ => return found,
            }
        }
    }
    finding
}

/// The relations that a duty asks for, over the parameters and, where needed, the argument.
fn duty_relations(
    arguments: &[Name],
    body: &Formula,
    duty: &Duty,
    proposition: &Proposition,
) -> Vec<(Proposition, Relation)> {
    let Some(argument) = arguments.first() else {
        return Vec::new();
    };
    let relation = |first: Formula,
                    relation: Relation,
                    right: Formula,
                    over: bool,
                    range: (&Formula, &Formula)| {
        let mut duty_proposition = proposition.clone();
        if over {
            duty_proposition.parameters.push(Parameter {
                name: argument.clone(),
                kind: ParameterKind::Real,
            });
            duty_proposition.domain.push(Condition::Chain(
                range.0.clone(),
                vec![
                    (Relation::LessEqual, Formula::Name(argument.clone())),
                    (Relation::LessEqual, range.1.clone()),
                ],
            ));
        }
        duty_proposition.statement = Statement::Chain {
            first,
            links: vec![(relation, right)],
            regime: None,
        };
        (duty_proposition, relation)
    };
    let at = |place: &Formula| {
        Formula::At(
            Box::new(body.clone()),
            vec![(argument.clone(), place.clone())],
        )
    };
    match duty {
        Duty::Density(from, to) => {
            let total = Formula::Ranged(Box::new(Ranged {
                kind: RangeKind::Integral,
                body: body.clone(),
                name: argument.clone(),
                from: from.clone(),
                to: to.clone(),
            }));
            vec![
                relation(
                    total,
                    Relation::Equal,
                    Formula::integer(1),
                    false,
                    (from, to),
                ),
                relation(
                    body.clone(),
                    Relation::GreaterEqual,
                    Formula::integer(0),
                    true,
                    (from, to),
                ),
            ]
        }
        Duty::Cumulative(from, to) => {
            let slope = Formula::Derivative(
                Box::new(body.clone()),
                argument.clone(),
                Box::new(Formula::integer(1)),
            );
            vec![
                relation(
                    at(from),
                    Relation::Equal,
                    Formula::integer(0),
                    false,
                    (from, to),
                ),
                relation(
                    at(to),
                    Relation::Equal,
                    Formula::integer(1),
                    false,
                    (from, to),
                ),
                relation(
                    slope,
                    Relation::GreaterEqual,
                    Formula::integer(0),
                    true,
                    (from, to),
                ),
            ]
        }
        // The book unfolds `agrees ID` to an equation between the two bodies.
        Duty::Agrees(_) => Vec::new(),
    }
}
