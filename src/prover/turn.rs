//! Limits in turn: `as n -> inf then k -> inf`.
//!
//! `L - S` is expanded in 1/n; its coefficients `d_j(k)` are functions of k with expansions of their
//! own. A gauge `h(k) n^-j (1 + o(1))` bounds `d_j` by h as k -> inf; a coefficient before the last
//! gauge that none bounds must vanish. Whether the last gauge is a bound of `d_J` by h, or of the rest
//! of the outer series with a constant that may depend on k, is open where it holds n: there the
//! stricter reading is shown, and what breaks that one only is not judged.

use super::asymptotics::{Case, ExpansionVerdict, near};
use super::domain::Sign;
use super::expansion::{Expansion, Obligation};
use super::failure::Failure;
use super::{Approach, Reason};
use crate::algebra::{RationalFunction, Series};
use crate::formula::Tendency;

/// A coefficient of the difference that is larger than the statement allows.
struct Excess {
    /// The exponent of the outer series.
    outer: i64,
    /// That of the inner one.
    inner: i64,
    coefficient: RationalFunction,
}

/// Judges a limit of one variable followed by one of another.
pub(super) fn judge_turn(
    case: &Case<'_>,
    outer: &Tendency,
    inner: &Tendency,
) -> Result<ExpansionVerdict, Reason> {
    let (outer, inner) = (case.approach(outer)?, case.approach(inner)?);
    let moving = [outer.variable().clone()];
    for (approach, uniformly) in [(&outer, &[][..]), (&inner, &moving[..])] {
        if let Some(why) = case.vacuous(approach, uniformly)? {
            return Ok(ExpansionVerdict::Vacuous { why });
        }
    }
    let (mut gauges, mut parts) = (Vec::new(), Vec::new());
    for formula in &case.comparison.gauges {
        let part = case.leading_part(formula, &outer)?;
        let Some((exponent, head)) = part.series.leading() else {
            return Err(Reason::Undecided("the gauge has no leading term".into()));
        };
        let Some((order, lead)) = leading(head, &part, &inner, case)? else {
            return Err(Reason::Undecided("the gauge has no leading term".into()));
        };
        gauges.push((exponent, order, lead));
        parts.push(part);
    }
    let last = gauges.iter().map(|gauge| gauge.0).max().unwrap_or(0);
    let difference = case.expansion(&case.comparison.difference, &outer, last.saturating_add(1))?;
    let excess = excess(case, &inner, &difference, &gauges, last)?;
    parts.push(difference);
    let obligations: Vec<Obligation> = parts.iter().flat_map(|p| p.obligations.clone()).collect();
    if depends_on_reading(case, &parts, &gauges, last, excess.as_ref()) {
        return Err(Reason::Undecided(
            "it depends on the reading of the last order term".into(),
        ));
    }
    let Some(excess) = excess else {
        for obligation in &obligations {
            let (sign, polynomial) = near(obligation, &outer, case.budget)?;
            let (sign, lead) = near(&Obligation { sign, polynomial }, &inner, case.budget)?;
            case.show_sign(sign, &lead)?;
        }
        for (_, _, lead) in &gauges {
            case.show_sign(Sign::NonZero, lead.numerator())?;
        }
        return Ok(ExpansionVerdict::Holds {
            further: None,
            remainder: case.claimed(),
        });
    };
    let mut signs = Vec::new();
    for (sign, polynomial) in case.signs(&obligations, &[])? {
        signs.push(near(&Obligation { sign, polynomial }, &outer, case.budget)?);
    }
    let mut nonzero: Vec<_> = gauges.iter().map(|gauge| gauge.2.clone()).collect();
    nonzero.push(excess.coefficient.clone());
    for obligation in &obligations {
        // The leading coefficients of denominators are among these; none may vanish at the point.
        let (sign, polynomial) = near(obligation, &outer, case.budget)?;
        let (_, lead) = near(&Obligation { sign, polynomial }, &inner, case.budget)?;
        nonzero.push(lead.into());
    }
    let logarithms = parts
        .iter()
        .flat_map(|part| part.logarithms.clone())
        .collect();
    let failure = Failure {
        approach: &inner,
        nonzero,
        signs,
        logarithms: &logarithms,
        budget: case.budget,
    };
    let without = [outer.variable().clone(), inner.variable().clone()];
    let term = inner.term_text(&excess.coefficient, excess.inner);
    let order = format!(
        "{} in the coefficient of {}",
        inner.power_text(excess.inner),
        outer.power_text(excess.outer)
    );
    match failure.find(case.proposition, &case.facts, &without)? {
        Some(point) => Ok(ExpansionVerdict::Fails {
            term: match excess.outer {
                0 => term,
                exponent => format!("({term})*{}", outer.power_text(exponent)),
            },
            order,
            claimed: case.claimed(),
            point,
            path: None,
            numbers: None,
        }),
        None => Err(Reason::Undecided(
            "no point was found where it is shown to fail".into(),
        )),
    }
}

/// Whether a verdict would rest on how an order term with n is meant: as a bound of a coefficient, or
/// of the rest of the outer series for every k by itself. Nor is it plain whether a gauge of an
/// earlier coefficient covers a later one.
fn depends_on_reading(
    case: &Case<'_>,
    parts: &[Expansion],
    gauges: &[(i64, i64, RationalFunction)],
    last: i64,
    excess: Option<&Excess>,
) -> bool {
    if case.comparison.quotient {
        return false;
    }
    let difference = parts.last();
    match excess {
        Some(excess) => {
            gauges.iter().any(|gauge| gauge.0 < excess.outer) || (excess.outer == last && last != 0)
        }
        // A coefficient that `o` bounds by a quotient in the limit does not vanish for each k.
        None => {
            case.comparison.little
                && last != 0
                && difference.is_some_and(|d| d.series.coefficient(last).is_some())
        }
    }
}

/// The first coefficient of the outer series that no gauge bounds.
fn excess(
    case: &Case<'_>,
    inner: &Approach,
    difference: &Expansion,
    gauges: &[(i64, i64, RationalFunction)],
    last: i64,
) -> Result<Option<Excess>, Reason> {
    for (outer, coefficient) in difference
        .series
        .terms()
        .filter(|(outer, _)| *outer <= last)
    {
        let Some((exponent, lead)) = leading(coefficient, difference, inner, case)? else {
            continue;
        };
        let bounded = gauges
            .iter()
            .filter(|gauge| gauge.0 == outer)
            .any(|(_, order, _)| {
                exponent > *order || (exponent == *order && !case.comparison.little)
            });
        if !bounded {
            return Ok(Some(Excess {
                outer,
                inner: exponent,
                coefficient: lead,
            }));
        }
    }
    Ok(None)
}

/// The leading term of a coefficient in the inner variable.
fn leading(
    value: &RationalFunction,
    expansion: &Expansion,
    inner: &Approach,
    case: &Case<'_>,
) -> Result<Option<(i64, RationalFunction)>, Reason> {
    if value
        .symbols()
        .iter()
        .any(|symbol| expansion.logarithms.contains_key(symbol))
    {
        return Err(Reason::Unsupported(
            "logarithms under limits in turn".into(),
        ));
    }
    let mut series: Series = inner.polynomial(value.numerator(), case.budget)?;
    for (atom, exponent) in value.denominator() {
        let factor = inner.polynomial(atom, case.budget)?;
        let factor = factor.powi(-i64::from(*exponent), 1, case.budget)?;
        series = series.mul(&factor, case.budget)?;
    }
    Ok(series
        .leading()
        .map(|(exponent, lead)| (exponent, lead.clone())))
}
