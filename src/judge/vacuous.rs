//! Domains that are seen to have no point.

use super::points::{Relating, split};
use crate::formula::{Formula, Name, ParameterKind, Proposition, Rational, Relation};
use num_traits::One;
use std::collections::BTreeMap;

/// Whether the conditions contradict each other by their constant bounds alone: a proof that the domain
/// has no point. Lower bounds travel along `a <= b`; a strict link between integers adds one.
pub fn contradictory(proposition: &Proposition) -> bool {
    let integer = |formula: &Formula| match formula {
        Formula::Name(name) => proposition
            .parameters
            .iter()
            .any(|parameter| parameter.name == *name && parameter.kind == ParameterKind::Integer),
        Formula::Number(value) => value.is_integer(),
        _ => false,
    };
    let mut edges: Vec<(&Formula, &Formula, bool)> = Vec::new();
    for relating in proposition.domain.iter().flat_map(split) {
        if let Relating::Pair(left, relation, right, _) = relating {
            match relation {
                Relation::Less => edges.push((left, right, true)),
                Relation::LessEqual => edges.push((left, right, false)),
                Relation::Greater => edges.push((right, left, true)),
                Relation::GreaterEqual => edges.push((right, left, false)),
                Relation::Equal => edges.extend([(left, right, false), (right, left, false)]),
                _ => {}
            }
        }
    }
    let mut lower: BTreeMap<&Name, (Rational, bool)> = Default::default();
    for _ in 0..=proposition.parameters.len() {
        for (small, large, strict) in &edges {
            let from = match small {
                Formula::Number(value) => (value.clone(), false),
                Formula::Name(name) => match lower.get(name) {
                    Some(bound) => bound.clone(),
                    None => continue,
                },
                _ => continue,
            };
            let whole = integer(small) && integer(large);
            let bound = match (strict, whole) {
                (true, true) => (from.0 + Rational::one(), false),
                (strict, _) => (from.0, from.1 || *strict),
            };
            match large {
                Formula::Number(value) if bound.0 > *value || (bound.0 == *value && bound.1) => {
                    return true;
                }
                Formula::Name(name) => {
                    let known = lower.get(name);
                    if known.is_none_or(|known| bound > *known) {
                        lower.insert(name, bound);
                    }
                }
                _ => {}
            }
        }
    }
    false
}
