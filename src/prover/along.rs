//! Expansions along a curve: `along k = m*(m-1)/2 + l, v = m`.
//!
//! The names are replaced, and the names in their values tend to infinity. One such name is a limit
//! of one variable. With several, the constants may depend on none of them: such a statement can be
//! refuted on a path through them, not yet shown.

use super::asymptotics::{ExpansionVerdict, judge_powers};
use super::domain::{Facts, plain};
use super::expansion::ROOT_OF_VARIABLE;
use super::{Approach, Reason, Sign};
use crate::algebra::Polynomial;
use crate::formula::{
    Budget, Condition, Draw, Formula, Name, Operator, Parameter, ParameterKind, Part, Proposition,
    Regime, Relation, Substitution, Target, Tendency,
};
use std::collections::BTreeSet;

/// A name that is never below minus this is gone along upwards only.
const FAR: i64 = 1_000_000;

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
    for (name, value) in &regime.along {
        start.require_integers(name, value, budget)?;
    }
    let curve = start.replace(&regime.along)?;
    let mut names = BTreeSet::new();
    for (_, value) in &regime.along {
        names.extend(Part::Formula(value).free_names());
    }
    let names: Vec<Name> = names.into_iter().collect();
    // The constants depend on none of the curve's own names in any case.
    let uniformly: Vec<Name> = regime
        .uniformly
        .iter()
        .filter(|name| !names.contains(name))
        .cloned()
        .collect();
    match &names[..] {
        [variable] => {
            let verdict = curve.judge(relation, variable, &uniformly, budget)?;
            curve.other_way(
                relation,
                variable,
                &uniformly,
                budget,
                with_curve(verdict, regime, &[]),
            )
        }
        [first, second] => {
            for (variable, path) in paths(first, second) {
                let verdict = curve.replace(&path)?.judge(relation, variable, &[], budget);
                if let Ok(verdict @ ExpansionVerdict::Fails { .. }) = verdict {
                    return Ok(with_curve(verdict, regime, &path));
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

/// Roots that are tried for a variable.
const ROOTS: [i64; 3] = [2, 3, 6];

/// Judges a limit at infinity of a variable that stands under roots, as one of its root: `k = s^2`
/// goes through all large k as s does, s being real; and where it fails, it fails for whole s.
pub(super) fn judge_root(
    statement: (&Formula, Relation, &Formula),
    regime: &Regime,
    proposition: &Proposition,
    budget: &Budget,
) -> Result<ExpansionVerdict, Reason> {
    let (left, relation, right) = statement;
    let variable = match &regime.limits[..] {
        [limit] => match &limit[..] {
            [
                Tendency {
                    quantity: Formula::Name(name),
                    target: Target::Infinity,
                },
            ] => name.clone(),
            _ => return Err(Reason::Unsupported(ROOT_OF_VARIABLE.into())),
        },
        _ => return Err(Reason::Unsupported(ROOT_OF_VARIABLE.into())),
    };
    let root = unused(proposition);
    let mut rooted = proposition.clone();
    rooted.parameters.push(Parameter {
        name: root.clone(),
        kind: ParameterKind::Real,
    });
    let positive = vec![(Relation::Greater, Formula::integer(0))];
    rooted
        .domain
        .push(Condition::Chain(Formula::Name(root.clone()), positive));
    let mut verdict = Err(Reason::Unsupported(ROOT_OF_VARIABLE.into()));
    for index in ROOTS {
        let power = Formula::binary(
            Operator::Power,
            Formula::Name(root.clone()),
            Formula::integer(index),
        );
        let regime = Regime {
            along: vec![(variable.clone(), power)],
            ..regime.clone()
        };
        verdict = judge_along(left, relation, right, &regime, &rooted, budget);
        if verdict.is_ok() || verdict == Err(Reason::Exhausted) {
            break;
        }
    }
    verdict
}

/// A name that the proposition does not have.
pub(super) fn unused(proposition: &Proposition) -> Name {
    let taken = |name: &str| {
        let parameters = proposition.parameters.iter().map(|p| &p.name);
        let draws = proposition.draws.iter().map(|draw| &draw.name);
        parameters.chain(draws).any(|other| **other == *name)
    };
    let mut name = "s".to_string();
    while taken(&name) {
        name.push('\'');
    }
    name.as_str().into()
}

/// A failure's path begins with the curve itself.
fn with_curve(
    mut verdict: ExpansionVerdict,
    regime: &Regime,
    path: &[(Name, Formula)],
) -> ExpansionVerdict {
    if let ExpansionVerdict::Fails { path: told, .. } = &mut verdict {
        let steps = regime.along.iter().chain(path);
        let mut parts: Vec<_> = steps
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        parts.extend(told.take());
        *told = Some(parts.join(", "));
    }
    verdict
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

    /// An integer is given integer values, for some multiples of the curve's names at least: else a
    /// failure on the curve is none in the domain.
    fn require_integers(
        &self,
        name: &Name,
        value: &Formula,
        budget: &Budget,
    ) -> Result<(), Reason> {
        if !Facts::of(&self.proposition, budget)?.is_integer(name) {
            return Ok(());
        }
        let whole = plain(value, budget)?.as_polynomial().is_some_and(|value| {
            let mut terms = value.terms().filter(|(monomial, _)| monomial.is_one());
            terms.all(|(_, constant)| constant.is_integer())
        });
        match whole {
            true => Ok(()),
            false => Err(Reason::Unsupported(
                "a curve that misses the integers".into(),
            )),
        }
    }

    /// A curve whose name may be negative is gone along in both directions.
    fn other_way(
        &self,
        relation: Relation,
        variable: &Name,
        uniformly: &[Name],
        budget: &Budget,
        verdict: ExpansionVerdict,
    ) -> Result<ExpansionVerdict, Reason> {
        if !matches!(verdict, ExpansionVerdict::Holds { .. }) {
            return Ok(verdict);
        }
        let facts = Facts::of(&self.proposition, budget)?;
        let bounded = Polynomial::symbol(variable).add(&Polynomial::integer(FAR));
        if facts.shows(Sign::NonNegative, &bounded, budget)? {
            return Ok(verdict);
        }
        let opposite = Formula::Negate(Box::new(Formula::Name(variable.clone())));
        let back = self.reflect(variable, &opposite)?;
        let downward = back.direction(variable, true, budget)?;
        if downward {
            return Ok(verdict);
        }
        match back.judge(relation, variable, uniformly, budget)? {
            ExpansionVerdict::Fails {
                term,
                order,
                claimed,
                point,
                numbers,
                ..
            } => Ok(ExpansionVerdict::Fails {
                term,
                order,
                claimed,
                point,
                path: Some(format!("{variable} written {opposite}")),
                numbers,
            }),
            _ => Ok(verdict),
        }
    }

    /// The curve with its name's sign changed.
    fn reflect(&self, variable: &Name, opposite: &Formula) -> Result<Curve, Reason> {
        let mut back = self.replace(&[(variable.clone(), opposite.clone())])?;
        back.proposition.parameters = self.proposition.parameters.clone();
        Ok(back)
    }

    /// Whether the large quantity is seen to tend to infinity, or to minus infinity.
    fn direction(&self, variable: &Name, opposite: bool, budget: &Budget) -> Result<bool, Reason> {
        let approach = Approach::Infinity(variable.clone());
        let large = plain(&self.large, budget)?;
        let Some(large) = large.as_polynomial() else {
            return Ok(false);
        };
        let series = approach.polynomial(large, budget)?;
        let facts = Facts::of(&self.proposition, budget)?;
        match series.leading() {
            Some((exponent, lead)) if exponent < 0 => {
                let lead = lead.numerator();
                let lead = if opposite { lead.neg() } else { lead.clone() };
                facts.shows(Sign::Positive, &lead, budget)
            }
            _ => Ok(false),
        }
    }

    fn judge(
        &self,
        relation: Relation,
        variable: &Name,
        uniformly: &[Name],
        budget: &Budget,
    ) -> Result<ExpansionVerdict, Reason> {
        let quantity = Formula::Name(variable.clone());
        if !self.direction(variable, false, budget)? {
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
            uniformly: uniformly.to_vec(),
            ..Regime::default()
        };
        judge_powers(
            &self.left,
            relation,
            &self.right,
            &regime,
            &self.proposition,
            budget,
        )
    }
}
