//! Definitions: what the text asks of the symbol that it brings in.

use super::Settings;
use super::finding::Finding;
use super::search::{Search, points};
use super::verdict::Verdict;
use crate::formula::{
    Budget, Condition, Duty, Formula, Name, Parameter, ParameterKind, Proposition, RangeKind,
    Ranged, Relation, Statement, TooLarge, free_names, substitute,
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
    if arguments.len() != 1 && !duties.is_empty() {
        let reason = "a duty of a definition without exactly one argument";
        return Finding::because(Verdict::Undecided, reason);
    }
    for (index, duty) in duties.iter().enumerate() {
        let relations = match duty_relations(arguments, body, duty, proposition) {
            Ok(relations) => relations,
            Err(too_large) => return Finding::because(Verdict::Undecided, too_large.to_string()),
        };
        for (duty_proposition, relation) in relations {
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
    if duties.iter().any(|duty| matches!(duty, Duty::Agrees(_))) {
        let reason = "no method for the agreement with another claim: state it as an equation";
        return Finding::because(Verdict::Undecided, reason);
    }
    finding
}

/// The relations that a duty asks for, over the parameters and, where needed, the argument.
fn duty_relations(
    arguments: &[Name],
    body: &Formula,
    duty: &Duty,
    proposition: &Proposition,
) -> Result<Vec<(Proposition, Relation)>, TooLarge> {
    let Some(argument) = arguments.first() else {
        return Ok(Vec::new());
    };
    // The argument is bound: a parameter of that name is another, and keeps its own domain.
    let place = place_name(argument, body, proposition);
    let moved = [(argument.clone(), Formula::Name(place.clone()))];
    let (body, argument) = (&substitute(body, &moved)?, &place);
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
                // Inside of the range: at an end a density may have a pole and a cdf no slope.
                vec![
                    (Relation::Less, Formula::Name(argument.clone())),
                    (Relation::Less, range.1.clone()),
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
    Ok(match duty {
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
        // No relation at a point: `judge_duties` answers.
        Duty::Agrees(_) => Vec::new(),
    })
}

/// A name for the places of a definition's range that nothing else has.
fn place_name(argument: &Name, body: &Formula, proposition: &Proposition) -> Name {
    let mut name: Name = format!("{argument}'").into();
    let inside = free_names(body);
    let parameters = proposition.parameters.iter();
    let taken: Vec<&Name> = parameters
        .map(|parameter| &parameter.name)
        .chain(proposition.draws.iter().map(|draw| &draw.name))
        .chain(&inside)
        .collect();
    while taken.contains(&&name) {
        name = format!("{name}'").into();
    }
    name
}
