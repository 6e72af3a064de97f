//! A failed expansion in numbers: `|L - S|` over the gauge at two places on the failing path. They
//! illustrate the verdict, which rests on the series alone.

use super::Approach;
use super::asymptotics::Case;
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

/// The quotients as text, for a variable that tends to infinity.
pub(super) fn numbers(
    case: &Case<'_>,
    approach: &Approach,
    fixed: &Point,
    path: &[(Name, Polynomial)],
) -> Option<String> {
    let Approach::Infinity(variable) = approach else {
        return None;
    };
    let mut texts = Vec::new();
    for place in PLACES {
        let mut values: BTreeMap<Name, Rational> = [(variable.clone(), place.into())].into();
        for (name, value) in &fixed.numbers {
            values.insert(name.clone(), to_rug(value));
        }
        let mut point = fixed.clone();
        for (name, value) in path {
            let value = value.evaluate(&values, case.budget).ok()?.as_constant()?;
            point.numbers.insert(name.clone(), from_rug(&value));
        }
        let own = from_rug(&Rational::from(place));
        point.numbers.insert(variable.clone(), own);
        let quotient = quotient(case, &point)?.midpoint().to_f64();
        texts.push(format!("{quotient:.3e} at {variable} = {place}"));
    }
    Some(format!("quotient by the gauge {}", texts.join(", ")))
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
