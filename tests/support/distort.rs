//! Edits bolder than misprints: exchanged operators, functions and names, and something more or less.

use claimcheck::formula::{
    Condition, Formula, Function, Name, Operator, Ranged, Relation, Statement,
};
use num_traits::{Signed, Zero};

const RELATIONS: [Relation; 6] = [
    Relation::Equal,
    Relation::NotEqual,
    Relation::Less,
    Relation::LessEqual,
    Relation::Greater,
    Relation::GreaterEqual,
];

/// Distortions at the root of `formula`, some by putting one of the `names` there.
pub fn distortions(formula: &Formula, names: &[Name]) -> Vec<Formula> {
    use Operator::{Add, Divide, Multiply, Power, Subtract};
    let negated = Formula::Negate(Box::new(formula.clone()));
    let beside = |operator, n| Formula::binary(operator, formula.clone(), Formula::integer(n));
    let mut all = vec![
        beside(Add, 1),
        beside(Subtract, 2),
        beside(Multiply, 3),
        beside(Divide, 2),
        beside(Power, 2),
        negated,
    ];
    match formula {
        Formula::Number(value) => {
            for by in [-2, -1, 3, 10] {
                let other = value + num_rational::BigRational::from_integer(by.into());
                all.push(match other.is_negative() {
                    true => Formula::Negate(Box::new(Formula::Number(-other))),
                    false => Formula::Number(other),
                });
            }
            if !value.is_zero() {
                all.push(Formula::Number(value.recip()));
            }
        }
        Formula::Name(name) => {
            let others = names.iter().filter(|other| *other != name);
            all.extend(others.cloned().map(Formula::Name));
        }
        Formula::Binary(operator, a, b) => {
            let operators = [Add, Subtract, Multiply, Divide, Power];
            let others = operators.into_iter().filter(|other| other != operator);
            all.extend(others.map(|other| Formula::Binary(other, a.clone(), b.clone())));
            all.push(Formula::Binary(*operator, b.clone(), a.clone()));
            all.extend([(**a).clone(), (**b).clone()]);
        }
        Formula::Call(function, parts) => {
            let alike = |other: &&Function| {
                *other != function && other.arity() == function.arity() && parts.len() < 3
            };
            let others = Function::ALL.iter().filter(alike);
            all.extend(others.map(|other| Formula::Call(*other, parts.clone())));
            all.push(Formula::Call(
                *function,
                parts.iter().rev().cloned().collect(),
            ));
            all.extend(parts.iter().cloned());
        }
        Formula::Ranged(ranged) => {
            let exchanged = Ranged {
                from: ranged.to.clone(),
                to: ranged.from.clone(),
                ..Ranged::clone(ranged)
            };
            all.push(Formula::Ranged(Box::new(exchanged)));
        }
        Formula::Factorial(a) => all.push((**a).clone()),
        Formula::Mean(a, draw) => all.push(Formula::Variance(a.clone(), draw.clone())),
        Formula::Variance(a, draw) => all.push(Formula::Mean(a.clone(), draw.clone())),
        _ => {}
    }
    all
}

/// The statement with another relation for one of its links.
pub fn other_relations(statement: &Statement) -> Vec<Statement> {
    let mut all = Vec::new();
    match statement {
        Statement::Chain {
            first,
            links,
            regime,
        } => {
            for at in 0..links.len() {
                for relation in RELATIONS {
                    let mut links = links.clone();
                    links[at].0 = relation;
                    all.push(Statement::Chain {
                        first: first.clone(),
                        links,
                        regime: regime.clone(),
                    });
                }
            }
        }
        Statement::All(parts) => {
            for (at, part) in parts.iter().enumerate() {
                for other in other_relations(part) {
                    let mut parts = parts.clone();
                    parts[at] = other;
                    all.push(Statement::All(parts));
                }
            }
        }
        _ => {}
    }
    all
}

/// Conditions that ask for less, with as many links: one is not strict, or reaches further by 1, or
/// says nothing.
pub fn weaker(condition: &Condition) -> Vec<Condition> {
    let Condition::Chain(first, links) = condition else {
        return Vec::new();
    };
    let mut all = Vec::new();
    for (at, (relation, _)) in links.iter().enumerate() {
        let mut links = links.clone();
        links[at].0 = match relation {
            Relation::Less => Relation::LessEqual,
            Relation::Greater => Relation::GreaterEqual,
            other => *other,
        };
        all.push(Condition::Chain(first.clone(), links));
    }
    let last = links.len() - 1;
    let before_last = last.checked_sub(1).map_or(first, |at| &links[at].1);
    let one =
        |operator, side: &Formula| Formula::binary(operator, side.clone(), Formula::integer(1));
    let firsts = [
        links[0].1.clone(),
        one(Operator::Add, first),
        one(Operator::Subtract, first),
    ];
    all.extend(firsts.map(|first| Condition::Chain(first, links.clone())));
    let side = &links[last].1;
    let lasts = [
        before_last.clone(),
        one(Operator::Add, side),
        one(Operator::Subtract, side),
    ];
    all.extend(lasts.map(|side| {
        let mut links = links.clone();
        links[last].1 = side;
        Condition::Chain(first.clone(), links)
    }));
    all
}
