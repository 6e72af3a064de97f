//! Expansions along a curve: `along k = m*(m-1)/2 + l, v = m`.
//!
//! The names are replaced, and the names in their values tend to infinity. One such name is a limit
//! of one variable. With several, the constants may depend on none of them: such a statement can be
//! refuted on a path through them, not yet shown.

use super::asymptotics::{ExpansionVerdict, judge_expansion};
use super::domain::{Facts, plain};
use super::{Approach, Reason};
use crate::formula::{
    Budget, Draw, Formula, Name, Operator, Part, Proposition, Regime, Relation, Substitution,
    Target, Tendency,
};
use std::collections::BTreeSet;

/// A statement whose names are being replaced.
#[derive(Clone)]
struct Curve {
    left: Formula,
    right: Formula,
    /// The quantity that is to tend to infinity.
    large: Formula,
    proposition: Proposition,
}

/// Judges an expansion along a curve.
pub(super) fn judge_along(
    left: &Formula,
    relation: Relation,
    right: &Formula,
    regime: &Regime,
    proposition: &Proposition,
    budget: &Budget,
) -> Result<ExpansionVerdict, Reason> {
    let start = Curve {
        left: left.clone(),
        right: right.clone(),
        large: large(regime)?,
        proposition: proposition.clone(),
    };
    let curve = start.replace(&regime.along)?;
    let mut names = BTreeSet::new();
    for (_, value) in &regime.along {
        names.extend(Part::Formula(value).free_names());
    }
    let names: Vec<Name> = names.into_iter().collect();
    match &names[..] {
        [variable] => curve.judge(relation, variable, budget),
        [first, second] => {
            for (variable, path) in paths(first, second) {
                let verdict = curve.replace(&path)?.judge(relation, variable, budget);
                if let Ok(ExpansionVerdict::Fails {
                    term,
                    order,
                    claimed,
                    point,
                    ..
                }) = verdict
                {
                    let path = path.iter().map(|(name, value)| format!("{name} = {value}"));
                    let path = Some(path.collect::<Vec<_>>().join(", "));
                    return Ok(ExpansionVerdict::Fails {
                        term,
                        order,
                        claimed,
                        point,
                        path,
                    });
                }
            }
            Err(Reason::Unsupported(
                "an expansion along a curve, uniform in two names".into(),
            ))
        }
        _ => Err(Reason::Unsupported(
            "an expansion along a curve in these names".into(),
        )),
    }
}

/// The name that tends to infinity: that of the limit, or the first that is replaced.
fn large(regime: &Regime) -> Result<Formula, Reason> {
    match &regime.limits[..] {
        [] => match regime.along.first() {
            Some((name, _)) => Ok(Formula::Name(name.clone())),
            None => Err(Reason::Unsupported("an empty curve".into())),
        },
        [limit] => match &limit[..] {
            [
                Tendency {
                    quantity,
                    target: Target::Infinity,
                },
            ] => Ok(quantity.clone()),
            _ => Err(Reason::Unsupported("a curve under this limit".into())),
        },
        _ => Err(Reason::Unsupported("limits in turn along a curve".into())),
    }
}

/// One name as a multiple of the other, or held at 1.
fn paths<'n>(first: &'n Name, second: &'n Name) -> Vec<(&'n Name, Vec<(Name, Formula)>)> {
    let mut paths = Vec::new();
    for (variable, other) in [(first, second), (second, first)] {
        let moving = Formula::Name(variable.clone());
        for factor in [1, 2, 3] {
            let multiple =
                Formula::binary(Operator::Multiply, Formula::integer(factor), moving.clone());
            let value = if factor == 1 {
                moving.clone()
            } else {
                multiple
            };
            paths.push((variable, vec![(other.clone(), value)]));
        }
        paths.push((variable, vec![(other.clone(), Formula::integer(1))]));
    }
    paths
}

fn too_large<T>(_: T) -> Reason {
    Reason::TooLarge("the statement grows too large along the curve".into())
}

impl Curve {
    fn replace(&self, values: &[(Name, Formula)]) -> Result<Curve, Reason> {
        let mut substitution = Substitution::new();
        for (name, value) in values {
            substitution.value(name.clone(), value.clone());
        }
        let mut proposition = self.proposition.clone();
        proposition
            .parameters
            .retain(|parameter| !values.iter().any(|(name, _)| *name == parameter.name));
        for condition in &mut proposition.domain {
            *condition = substitution.condition(condition).map_err(too_large)?;
        }
        let mut draws = Vec::new();
        for draw in &proposition.draws {
            let law = substitution.law(&draw.law).map_err(too_large)?;
            draws.push(Draw {
                name: draw.name.clone(),
                law,
            });
        }
        proposition.draws = draws;
        Ok(Curve {
            left: substitution.formula(&self.left).map_err(too_large)?,
            right: substitution.formula(&self.right).map_err(too_large)?,
            large: substitution.formula(&self.large).map_err(too_large)?,
            proposition,
        })
    }

    fn judge(
        &self,
        relation: Relation,
        variable: &Name,
        budget: &Budget,
    ) -> Result<ExpansionVerdict, Reason> {
        let quantity = Formula::Name(variable.clone());
        let approach = Approach::Infinity(variable.clone());
        let large = plain(&self.large, budget)?;
        let grows = match large.as_polynomial() {
            Some(large) => {
                let series = approach.polynomial(large, budget)?;
                let facts = Facts::of(&self.proposition, budget)?;
                match series.leading() {
                    Some((exponent, lead)) if exponent < 0 => {
                        facts.shows(super::Sign::Positive, lead.numerator(), budget)?
                    }
                    _ => false,
                }
            }
            None => false,
        };
        if !grows {
            return Err(Reason::Undecided(
                "the curve is not seen to go to infinity".into(),
            ));
        }
        let limits = vec![vec![Tendency {
            quantity,
            target: Target::Infinity,
        }]];
        let regime = Regime {
            limits,
            ..Regime::default()
        };
        judge_expansion(
            &self.left,
            relation,
            &self.right,
            &regime,
            &self.proposition,
            budget,
        )
    }
}
