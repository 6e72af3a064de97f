//! A failed expansion in numbers: `|L - S|` over the gauge at two places on the failing path. They
//! illustrate the verdict, which rests on the series alone.

use super::asymptotics::Case;
use super::{Approach, Side};
use crate::algebra::Polynomial;
use crate::evaluate::{Context, Outcome, ladder};
use crate::formula::{Budget, Formula, Name, Point};
use crate::number::Interval;
use crate::number::convert::{from_rug, to_rug};
use rug::Rational;
use std::collections::BTreeMap;

/// Where the variable is put.
const PLACES: [i64; 2] = [1_000, 1_000_000];

/// Steps for one value; what costs more is left out.
const STEPS: u64 = 2_000_000;

/// The quotients as text; nothing for a variable that tends to a point told in parameters.
pub(super) fn numbers(
    case: &Case<'_>,
    approach: &Approach,
    fixed: &Point,
    path: &[(Name, Polynomial)],
) -> Option<String> {
    let variable = approach.variable();
    let mut texts = Vec::new();
    for place in PLACES {
        let own = stand(approach, place)?;
        let mut values: BTreeMap<Name, Rational> = [(variable.clone(), own.clone())].into();
        for (name, value) in &fixed.numbers {
            values.insert(name.clone(), to_rug(value));
        }
        let mut point = fixed.clone();
        for (name, value) in path {
            let value = value.evaluate(&values, case.budget).ok()?.as_constant()?;
            point.numbers.insert(name.clone(), from_rug(&value));
        }
        point.numbers.insert(variable.clone(), from_rug(&own));
        let quotient = quotient(case, &point)?.midpoint().to_f64();
        texts.push(format!("{quotient:.3e} at {variable} = {own}"));
    }
    Some(format!("quotient by the gauge {}", texts.join(", ")))
}

/// The variable near its target.
fn stand(approach: &Approach, place: i64) -> Option<Rational> {
    let step = Rational::from((1, place));
    Some(match approach {
        Approach::Infinity(_) => Rational::from(place),
        Approach::Point(_, at, Side::Below) => at.as_constant()? - step,
        Approach::Point(_, at, Side::Above | Side::Both) => at.as_constant()? + step,
    })
}

fn quotient(case: &Case<'_>, point: &Point) -> Option<Interval> {
    let size = |formula: &Formula| {
        let budget = Budget::new(STEPS);
        let context = Context {
            point,
            draws: &case.proposition.draws,
            budget: &budget,
        };
        match ladder(formula, &context, 4) {
            Ok(Outcome::Value(value)) => Some(value.abs()),
            _ => None,
        }
    };
    let above = size(&case.comparison.difference)?;
    let below: Option<Vec<_>> = case.comparison.gauges.iter().map(size).collect();
    let below = below?.into_iter().reduce(|a, b| a.add(&b))?;
    above.div(&below).ok()
}
