//! Single-edit mutants of a statement, made by walking its tree: the misprints that a checker must catch.

use claimcheck::formula::{Condition, Formula, Name, Operator, Ranged, Statement};
use num_traits::{One, Zero};

/// Every statement that differs from `statement` by one edit of a formula. Order terms are left alone
/// (a coarser order is true), and so are limits' targets.
pub fn mutants(
    statement: &Statement,
    edits_of: &dyn Fn(&Formula) -> Vec<Formula>,
) -> Vec<Statement> {
    match statement {
        Statement::Chain {
            first,
            links,
            regime,
        } => {
            let mut all = Vec::new();
            for edited in edits(first, edits_of) {
                all.push(Statement::Chain {
                    first: edited,
                    links: links.clone(),
                    regime: regime.clone(),
                });
            }
            for (index, (relation, right)) in links.iter().enumerate() {
                for edited in edits(right, edits_of) {
                    let mut links = links.clone();
                    links[index] = (*relation, edited);
                    all.push(Statement::Chain {
                        first: first.clone(),
                        links,
                        regime: regime.clone(),
                    });
                }
            }
            all
        }
        Statement::All(parts) => {
            let mut all = Vec::new();
            for (index, part) in parts.iter().enumerate() {
                for edited in mutants(part, edits_of) {
                    let mut parts = parts.clone();
                    parts[index] = edited;
                    all.push(Statement::All(parts));
                }
            }
            all
        }
        _ => Vec::new(),
    }
}

/// Every formula that differs from `formula` by one edit, at its root or below.
fn edits(formula: &Formula, edits_of: &dyn Fn(&Formula) -> Vec<Formula>) -> Vec<Formula> {
    let mut all = edits_of(formula);
    for (index, child) in children(formula).into_iter().enumerate() {
        for edited in edits(child, edits_of) {
            all.push(with_child(formula, index, edited));
        }
    }
    all
}

/// Misprints at the root of `formula`: a sign, an exponent, an index, a factor or a constant.
pub fn misprints(formula: &Formula, integers: &[Name]) -> Vec<Formula> {
    let binary = Formula::binary;
    match formula {
        Formula::Number(value) => {
            let mut all = vec![Formula::Number(value + num_rational::BigRational::one())];
            if !value.is_zero() {
                let two = num_rational::BigRational::from_integer(2.into());
                all.push(Formula::Number(value * two));
            }
            all
        }
        Formula::Name(name) if integers.contains(name) => {
            let mut all = vec![
                binary(Operator::Add, formula.clone(), Formula::integer(1)),
                binary(Operator::Subtract, formula.clone(), Formula::integer(1)),
            ];
            let position = integers.iter().position(|other| other == name).unwrap_or(0);
            let other = &integers[(position + 1) % integers.len()];
            if other != name {
                all.push(Formula::Name(other.clone()));
            }
            all
        }
        Formula::Negate(inner) => vec![(**inner).clone()],
        Formula::Binary(Operator::Add, a, b) => {
            vec![binary(Operator::Subtract, (**a).clone(), (**b).clone())]
        }
        Formula::Binary(Operator::Subtract, a, b) => {
            vec![binary(Operator::Add, (**a).clone(), (**b).clone())]
        }
        Formula::Binary(Operator::Multiply, a, b) => vec![
            binary(Operator::Divide, (**a).clone(), (**b).clone()),
            binary(Operator::Multiply, Formula::integer(2), formula.clone()),
        ],
        Formula::Binary(Operator::Divide, a, b) => vec![
            binary(Operator::Multiply, (**a).clone(), (**b).clone()),
            binary(Operator::Divide, formula.clone(), Formula::integer(2)),
            Formula::Negate(Box::new(formula.clone())),
        ],
        Formula::Binary(Operator::Power, a, b) => vec![
            binary(
                Operator::Power,
                (**a).clone(),
                binary(Operator::Add, (**b).clone(), Formula::integer(1)),
            ),
            binary(
                Operator::Power,
                (**a).clone(),
                binary(Operator::Subtract, (**b).clone(), Formula::integer(1)),
            ),
        ],
        _ => Vec::new(),
    }
}

/// The parts that are edited, in order.
pub fn children(formula: &Formula) -> Vec<&Formula> {
    match formula {
        Formula::Apply(_, arguments) | Formula::Call(_, arguments) => arguments.iter().collect(),
        Formula::Negate(inner)
        | Formula::Factorial(inner)
        | Formula::Mean(inner, _)
        | Formula::Variance(inner, _)
        | Formula::Antiderivative(inner, _)
        | Formula::Derivative(inner, _, _)
        | Formula::At(inner, _)
        | Formula::Limit(inner, _) => vec![inner],
        Formula::Binary(_, a, b) => vec![a, b],
        Formula::Ranged(ranged) => vec![&ranged.body, &ranged.from, &ranged.to],
        Formula::Indicator(condition) => match &**condition {
            Condition::Chain(first, links) => std::iter::once(first)
                .chain(links.iter().map(|(_, right)| right))
                .collect(),
            _ => Vec::new(),
        },
        Formula::Density(_, at) => vec![at],
        _ => Vec::new(),
    }
}

/// `formula` with one of its [`children`] replaced.
pub fn with_child(formula: &Formula, index: usize, child: Formula) -> Formula {
    let replaced = |arguments: &[Formula]| {
        let mut arguments = arguments.to_vec();
        arguments[index] = child.clone();
        arguments
    };
    match formula {
        Formula::Apply(name, arguments) => Formula::Apply(name.clone(), replaced(arguments)),
        Formula::Call(function, arguments) => Formula::Call(*function, replaced(arguments)),
        Formula::Negate(_) => Formula::Negate(Box::new(child)),
        Formula::Factorial(_) => Formula::Factorial(Box::new(child)),
        Formula::Mean(_, draw) => Formula::Mean(Box::new(child), draw.clone()),
        Formula::Variance(_, draw) => Formula::Variance(Box::new(child), draw.clone()),
        Formula::Antiderivative(_, name) => Formula::Antiderivative(Box::new(child), name.clone()),
        Formula::Derivative(_, name, order) => {
            Formula::Derivative(Box::new(child), name.clone(), order.clone())
        }
        Formula::At(_, places) => Formula::At(Box::new(child), places.clone()),
        Formula::Limit(_, places) => Formula::Limit(Box::new(child), places.clone()),
        Formula::Binary(operator, a, b) => match index {
            0 => Formula::binary(*operator, child, (**b).clone()),
            _ => Formula::binary(*operator, (**a).clone(), child),
        },
        Formula::Ranged(ranged) => {
            let mut ranged = Ranged::clone(ranged);
            match index {
                0 => ranged.body = child,
                1 => ranged.from = child,
                _ => ranged.to = child,
            }
            Formula::Ranged(Box::new(ranged))
        }
        Formula::Indicator(condition) => match &**condition {
            Condition::Chain(first, links) => {
                let mut links = links.clone();
                let mut first = first.clone();
                match index {
                    0 => first = child,
                    _ => links[index - 1].1 = child,
                }
                Formula::Indicator(Box::new(Condition::Chain(first, links)))
            }
            _ => formula.clone(),
        },
        Formula::Density(of, _) => Formula::Density(of.clone(), Box::new(child)),
        _ => formula.clone(),
    }
}
