//! Judges expansions: `L == S + O(g)`, `L == S + o(g)`, `L ~ R`, `L =~ R` under a regime.
//!
//! The difference `D = L - S` is expanded with every other parameter a symbol. It holds when all
//! coefficients below the gauge's order vanish identically and what the series rest on is shown on
//! the whole domain. It fails when there is one point of the domain, with everything that the series
//! rest on true there, at which the first coefficient that should vanish does not. In between is a
//! [`Reason`].

use super::domain::{Facts, Sign};
use super::expansion::{Expansion, Obligation, ROOT_OF_VARIABLE, expand};
use super::failure::Failure;
use super::{Approach, Reason, Side, joint, sample, turn};
use crate::algebra::{Polynomial, RationalFunction, Symbol};
use crate::formula::{
    Budget, Formula, Name, Operator, Part, Point, Proposition, Regime, Relation, Target, Tendency,
};
use std::collections::{BTreeMap, BTreeSet};

/// What became of an expansion.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpansionVerdict {
    Holds {
        /// The left side with three orders beyond the gauge; empty for joint limits.
        further: Option<String>,
        /// The order of `L - S`, as text.
        remainder: String,
    },
    Fails {
        /// The first term of `L - S` that should not be there.
        term: String,
        /// Its order, as text.
        order: String,
        /// The order that the statement claims, as text.
        claimed: String,
        /// Values of the other parameters for which the term is there.
        point: Point,
        /// How parameters move with the variable, where they do.
        path: Option<String>,
        /// `|L - S|` over the gauge in numbers, where the evaluator has them.
        numbers: Option<String>,
    },
    Vacuous {
        why: String,
    },
}

/// `L - S` against gauges: `O` of them, or `o` when little.
#[derive(Clone, Debug)]
pub(super) struct Comparison {
    pub left: Formula,
    pub difference: Formula,
    pub gauges: Vec<Formula>,
    pub little: bool,
    /// `~` or `=~`: the quotient by the gauge is to tend to 0. An `o` of the print may mean more.
    pub quotient: bool,
}

/// Everything that the judging of one comparison needs.
pub(super) struct Case<'a> {
    pub comparison: Comparison,
    pub proposition: &'a Proposition,
    pub facts: Facts,
    pub budget: &'a Budget,
}

/// Orders beyond the gauge that are told.
const FURTHER: i64 = 3;

/// A gauge whose terms up to this order cancel is refused.
const GAUGE_ORDER: i64 = 14;

/// Gauges of a higher order than this are refused.
const MAX_EXPONENT: u64 = 64;

/// Judges one expansion link of a proposition.
///
/// # Errors
/// Why it is neither shown nor refuted.
pub fn judge_expansion(
    left: &Formula,
    relation: Relation,
    right: &Formula,
    regime: &Regime,
    proposition: &Proposition,
    budget: &Budget,
) -> Result<ExpansionVerdict, Reason> {
    match judge_powers(left, relation, right, regime, proposition, budget) {
        Err(Reason::Unsupported(why)) if why == ROOT_OF_VARIABLE && regime.along.is_empty() => {
            super::along::judge_root((left, relation, right), regime, proposition, budget)
        }
        verdict => verdict,
    }
}

/// Judges by series in whole powers of the variable.
pub(super) fn judge_powers(
    left: &Formula,
    relation: Relation,
    right: &Formula,
    regime: &Regime,
    proposition: &Proposition,
    budget: &Budget,
) -> Result<ExpansionVerdict, Reason> {
    if !regime.along.is_empty() {
        return super::along::judge_along(left, relation, right, regime, proposition, budget);
    }
    let comparison = comparison(left, relation, right)?;
    let facts = Facts::of(proposition, budget)?;
    let case = Case {
        comparison,
        proposition,
        facts,
        budget,
    };
    match &regime.limits[..] {
        [limit] => match &limit[..] {
            [tendency] => case.single(tendency, &regime.uniformly),
            _ if regime.uniformly.is_empty() => joint::judge_joint(&case, limit),
            _ => Err(Reason::Unsupported(
                "a joint limit that is uniform in more".into(),
            )),
        },
        [outer, inner] if regime.uniformly.is_empty() => match (&outer[..], &inner[..]) {
            ([outer], [inner]) => turn::judge_turn(&case, outer, inner),
            _ => Err(Reason::Unsupported("joint limits in turn".into())),
        },
        _ => Err(Reason::Unsupported("these limits in turn".into())),
    }
}

/// Reads the statement as a difference against gauges.
fn comparison(left: &Formula, relation: Relation, right: &Formula) -> Result<Comparison, Reason> {
    let terms = summands(right);
    let (mut gauges, mut little, mut difference) = (Vec::new(), Vec::new(), left.clone());
    for (negative, term) in &terms {
        match term {
            Formula::BigO(gauge) => gauges.push((**gauge).clone()),
            Formula::LittleO(gauge) => little.push((**gauge).clone()),
            term => {
                let operator = if *negative {
                    Operator::Add
                } else {
                    Operator::Subtract
                };
                difference = Formula::binary(operator, difference, term.clone());
            }
        }
    }
    let plain = gauges.is_empty() && little.is_empty();
    let quotient = relation != Relation::Equal;
    let (gauges, little) = match relation {
        Relation::Asymptotic if plain => (vec![right.clone()], true),
        Relation::Approximate if plain => match terms.last() {
            Some((_, last)) => (vec![last.clone()], true),
            None => return Err(Reason::Unsupported("an empty sum".into())),
        },
        Relation::Equal if little.is_empty() && !gauges.is_empty() => (gauges, false),
        Relation::Equal if gauges.is_empty() && !little.is_empty() => (little, true),
        _ => return Err(Reason::Unsupported("this relation as an expansion".into())),
    };
    Ok(Comparison {
        left: left.clone(),
        difference,
        gauges,
        little,
        quotient,
    })
}

/// The terms of a sum, each with whether it is subtracted. A sum with an O in it is multiplied out:
/// `(a + O(g))*h` is `a*h + O(g*h)`.
fn summands(formula: &Formula) -> Vec<(bool, Formula)> {
    let each = |formula: &Formula, change: &dyn Fn(bool, Formula) -> (bool, Formula)| {
        let terms = summands(formula).into_iter();
        terms
            .map(|(negative, term)| change(negative, term))
            .collect()
    };
    match formula {
        Formula::Binary(operator @ (Operator::Add | Operator::Subtract), left, right) => {
            let negative = *operator == Operator::Subtract;
            let mut terms = summands(left);
            let rights: Vec<_> = each(right, &|own, term| (own != negative, term));
            terms.extend(rights);
            terms
        }
        Formula::Negate(inner) => each(inner, &|own, term| (!own, term)),
        Formula::Binary(operator @ (Operator::Multiply | Operator::Divide), sum, factor)
            if has_order(sum) && !has_order(factor) =>
        {
            each(sum, &|own, term| (own, times(term, *operator, factor)))
        }
        Formula::Binary(Operator::Multiply, factor, sum)
            if has_order(sum) && !has_order(factor) =>
        {
            each(sum, &|own, term| {
                (own, times(term, Operator::Multiply, factor))
            })
        }
        _ => vec![(false, formula.clone())],
    }
}

/// The term times or over the factor, which goes into an O or o.
fn times(term: Formula, operator: Operator, factor: &Formula) -> Formula {
    let of = |gauge: Box<Formula>| Box::new(Formula::binary(operator, *gauge, factor.clone()));
    match term {
        Formula::BigO(gauge) => Formula::BigO(of(gauge)),
        Formula::LittleO(gauge) => Formula::LittleO(of(gauge)),
        term => Formula::binary(operator, term, factor.clone()),
    }
}

fn has_order(formula: &Formula) -> bool {
    match formula {
        Formula::BigO(_) | Formula::LittleO(_) => true,
        Formula::Negate(inner) => has_order(inner),
        Formula::Binary(_, left, right) => has_order(left) || has_order(right),
        _ => false,
    }
}

impl Case<'_> {
    fn single(&self, tendency: &Tendency, uniformly: &[Name]) -> Result<ExpansionVerdict, Reason> {
        let approach = self.approach(tendency)?;
        if let Some(why) = self.vacuous(&approach, uniformly)? {
            return Ok(ExpansionVerdict::Vacuous { why });
        }
        let gauge = self.gauge(&approach)?;
        let difference =
            self.expansion(&self.comparison.difference, &approach, gauge.exponent + 1)?;
        let moving: Vec<&Name> = uniformly
            .iter()
            .filter(|name| {
                self.depends(&self.comparison.difference, &difference, name)
                    || self
                        .gauges(&gauge)
                        .any(|(formula, part)| self.depends(formula, part, name))
            })
            .collect();
        match moving[..] {
            [] => self.compare(&approach, &gauge, &difference, uniformly),
            [name] => joint::judge_uniform(self, approach.variable(), name),
            _ => Err(Reason::Unsupported(
                "uniformity in several names at once".into(),
            )),
        }
    }

    fn gauges<'g>(
        &'g self,
        gauge: &'g Gauge,
    ) -> impl Iterator<Item = (&'g Formula, &'g Expansion)> {
        self.comparison.gauges.iter().zip(&gauge.parts)
    }

    /// Whether a formula's value may depend on a name. The terms of a truncated series do not tell
    /// that of its remainder; there the formula and the laws must not mention the name.
    fn depends(&self, formula: &Formula, expansion: &Expansion, name: &Name) -> bool {
        match &expansion.exact {
            Some(exact) => hides(&exact.symbols(), name, &expansion.logarithms),
            None => {
                let laws = self
                    .proposition
                    .draws
                    .iter()
                    .map(|draw| Part::Law(&draw.law));
                let mut parts = laws.chain([Part::Formula(formula)]);
                parts.any(|part| part.free_names().contains(name))
            }
        }
    }

    pub(super) fn approach(&self, tendency: &Tendency) -> Result<Approach, Reason> {
        let Formula::Name(name) = &tendency.quantity else {
            return Err(Reason::Unsupported("a limit of what is no name".into()));
        };
        let (at, side) = match &tendency.target {
            Target::Infinity => return Ok(Approach::Infinity(name.clone())),
            Target::Point(at) => (at, Side::Both),
            Target::Above(at) => (at, Side::Above),
            Target::Below(at) => (at, Side::Below),
        };
        if self.facts.is_integer(name) {
            return Err(Reason::Unsupported(
                "an integer that tends to a point".into(),
            ));
        }
        let at = super::domain::plain(at, self.budget)?;
        match at.as_polynomial() {
            Some(at) if !at.contains(name) => Ok(Approach::Point(name.clone(), at.clone(), side)),
            _ => Err(Reason::Unsupported("a limit at such a point".into())),
        }
    }

    pub(super) fn expansion(
        &self,
        formula: &Formula,
        approach: &Approach,
        order: i64,
    ) -> Result<Expansion, Reason> {
        expand(
            formula,
            approach,
            order,
            &self.proposition.draws,
            self.budget,
        )
    }

    /// Whether an inequality of the domain fails near the target for every value of the names that
    /// are held fixed.
    pub(super) fn vacuous(
        &self,
        approach: &Approach,
        uniformly: &[Name],
    ) -> Result<Option<String>, Reason> {
        for inequality in self.facts.inequalities() {
            let difference = &inequality.difference;
            let moves = uniformly.iter().any(|name| difference.contains(name));
            if moves || !difference.contains(approach.variable()) {
                continue;
            }
            let series = approach.polynomial(difference, self.budget)?;
            let Some((exponent, lead)) = series.leading() else {
                continue;
            };
            let sided = approach.two_sided() && exponent % 2 != 0;
            let lead = lead.numerator().neg();
            if !sided && self.facts.shows(Sign::Positive, &lead, self.budget)? {
                let relation = if inequality.strict { ">" } else { ">=" };
                let variable = approach.variable();
                return Ok(Some(format!(
                    "the domain has {difference} {relation} 0, which keeps {variable} away from its limit once the others are fixed"
                )));
            }
        }
        Ok(None)
    }

    /// An expansion far enough to show a leading term, where there is one.
    pub(super) fn leading_part(
        &self,
        formula: &Formula,
        approach: &Approach,
    ) -> Result<Expansion, Reason> {
        let mut order = 0;
        loop {
            let part = self.expansion(formula, approach, order)?;
            if part.series.leading().is_some() || part.series.is_zero() || order >= GAUGE_ORDER {
                return Ok(part);
            }
            order = 2 * order + 2;
        }
    }

    /// The leading exponents of the gauges; the comparison is with the weakest.
    fn gauge(&self, approach: &Approach) -> Result<Gauge, Reason> {
        let (mut parts, mut weakest) = (Vec::new(), None);
        for formula in &self.comparison.gauges {
            let part = self.leading_part(formula, approach)?;
            let Some((exponent, lead)) = part.series.leading() else {
                return Err(Reason::Undecided("the gauge has no leading term".into()));
            };
            if lead.contains(&approach.log_symbol()) {
                return Err(Reason::Unsupported("a gauge with a logarithm".into()));
            }
            weakest = Some(weakest.map_or(exponent, |old: i64| old.min(exponent)));
            parts.push(part);
        }
        let exponent = weakest.ok_or_else(|| Reason::Unsupported("no gauge".into()))?;
        // What is compared are small numbers; a gauge beyond is no text that a person writes.
        if exponent.unsigned_abs() > MAX_EXPONENT {
            return Err(Reason::TooLarge("the gauge's exponent is too large".into()));
        }
        Ok(Gauge { parts, exponent })
    }

    fn compare(
        &self,
        approach: &Approach,
        gauge: &Gauge,
        difference: &Expansion,
        uniformly: &[Name],
    ) -> Result<ExpansionVerdict, Reason> {
        let log = approach.log_symbol();
        let excess = difference.series.terms().find(|(exponent, coefficient)| {
            *exponent < gauge.exponent
                || *exponent == gauge.exponent
                    && (self.comparison.little || coefficient.contains(&log))
        });
        match excess {
            None => self.holds(approach, gauge, difference, uniformly),
            Some((exponent, coefficient)) => {
                let excess = (exponent, coefficient.clone());
                self.fails(approach, gauge, difference, excess, uniformly)
            }
        }
    }

    fn holds(
        &self,
        approach: &Approach,
        gauge: &Gauge,
        difference: &Expansion,
        uniformly: &[Name],
    ) -> Result<ExpansionVerdict, Reason> {
        self.show(approach, difference, uniformly)?;
        for part in &gauge.parts {
            self.show(approach, part, uniformly)?;
            if let Some((_, lead)) = part.series.leading() {
                self.show_sign(Sign::NonZero, lead.numerator())?;
            }
        }
        let order = gauge.exponent + FURTHER + 1;
        // What cannot be told beyond the print takes nothing from the verdict.
        let left = self.expansion(&self.comparison.left, approach, order);
        let further = left.ok().map(|left| {
            let logarithmic = left
                .logarithms
                .values()
                .any(|a| a.contains(approach.variable()));
            approach.series_text(&left.series.truncate(order), logarithmic)
        });
        Ok(ExpansionVerdict::Holds {
            further,
            remainder: remainder_text(approach, difference),
        })
    }

    /// Shows what an expansion rests on, on the whole domain.
    fn show(
        &self,
        approach: &Approach,
        expansion: &Expansion,
        uniformly: &[Name],
    ) -> Result<(), Reason> {
        for obligation in &expansion.obligations {
            let symbols = obligation.polynomial.symbols();
            // Where nothing must be uniform, the sign of the leading coefficient is enough.
            if uniformly
                .iter()
                .any(|name| hides(&symbols, name, &expansion.logarithms))
            {
                self.show_uniformly(approach, obligation)?;
            } else {
                let (sign, lead) = near(obligation, approach, self.budget)?;
                self.show_sign(sign, &lead)?;
            }
        }
        Ok(())
    }

    /// Shows an obligation for all values of the variable from some number on.
    fn show_uniformly(&self, approach: &Approach, obligation: &Obligation) -> Result<(), Reason> {
        let mut facts = self.facts.clone();
        if let Approach::Infinity(name) = approach {
            let large = Polynomial::symbol(name).sub(&Polynomial::integer(joint::LARGE));
            facts.assume_sign(large, false);
        }
        match facts.shows(obligation.sign, &obligation.polynomial, self.budget)? {
            true => Ok(()),
            false => Err(not_shown(obligation.sign, &obligation.polynomial)),
        }
    }

    pub(super) fn show_sign(&self, sign: Sign, polynomial: &Polynomial) -> Result<(), Reason> {
        match self.facts.shows(sign, polynomial, self.budget)? {
            true => Ok(()),
            false => Err(not_shown(sign, polynomial)),
        }
    }

    fn fails(
        &self,
        approach: &Approach,
        gauge: &Gauge,
        difference: &Expansion,
        excess: (i64, RationalFunction),
        uniformly: &[Name],
    ) -> Result<ExpansionVerdict, Reason> {
        let (exponent, coefficient) = excess;
        let log = approach.log_symbol();
        if coefficient
            .denominator()
            .keys()
            .any(|atom| atom.contains(&log))
        {
            return Err(Reason::Unsupported("a logarithm in a denominator".into()));
        }
        // Where the coefficient holds the variable's logarithm, its highest power must be there.
        let powers = coefficient.numerator().coefficients(&log);
        let highest = powers.into_values().next_back().unwrap_or_default();
        let mut nonzero = vec![RationalFunction::from(highest)];
        nonzero.extend(
            gauge
                .parts
                .iter()
                .filter_map(|p| p.series.leading())
                .map(|(_, c)| c.clone()),
        );
        let expansions = gauge.parts.iter().chain([difference]);
        let obligations: Vec<_> = expansions
            .clone()
            .flat_map(|e| e.obligations.clone())
            .collect();
        let logarithms = expansions.flat_map(|e| e.logarithms.clone()).collect();
        for path in paths(approach, uniformly) {
            let failure = Failure {
                approach,
                nonzero: nonzero.clone(),
                signs: self.signs(&obligations, &path)?,
                logarithms: &logarithms,
                budget: self.budget,
            };
            let mut without = vec![approach.variable().clone()];
            without.extend(path.iter().map(|(name, _)| name.clone()));
            if let Some(point) = failure.find(self.proposition, &self.facts, &without)? {
                return Ok(ExpansionVerdict::Fails {
                    term: approach.term_text(&coefficient, exponent),
                    order: approach.power_text(exponent),
                    claimed: self.claimed(),
                    numbers: sample::numbers(self, approach, &point, &path),
                    point,
                    path: path_text(&path),
                });
            }
        }
        let term = approach.term_text(&coefficient, exponent);
        Err(Reason::Undecided(format!(
            "the difference has the term {term}, but no point was found where it is shown to be there"
        )))
    }

    /// The order that the statement claims, as text.
    pub(super) fn claimed(&self) -> String {
        let letter = if self.comparison.little { "o" } else { "O" };
        let gauges = self
            .comparison
            .gauges
            .iter()
            .map(|gauge| format!("{letter}({gauge})"));
        gauges.collect::<Vec<_>>().join(" + ")
    }

    /// What must hold along a path: the obligations and the domain.
    ///
    /// # Errors
    /// Some condition of the domain cannot be read, so that no point is known to lie in it.
    pub(super) fn signs(
        &self,
        obligations: &[Obligation],
        path: &[(Name, Polynomial)],
    ) -> Result<Vec<(Sign, Polynomial)>, Reason> {
        if !self.facts.complete() {
            return Err(Reason::Unsupported(
                "a point in a domain of more than inequalities".into(),
            ));
        }
        let domain = self.facts.inequalities().iter().map(|inequality| {
            let sign = if inequality.strict {
                Sign::Positive
            } else {
                Sign::NonNegative
            };
            (sign, inequality.difference.clone())
        });
        let obliged = obligations.iter().map(|o| (o.sign, o.polynomial.clone()));
        let mut signs = Vec::new();
        for (sign, mut polynomial) in domain.chain(obliged) {
            for (name, value) in path {
                polynomial = polynomial.substitute(name, value, self.budget)?;
            }
            signs.push((sign, polynomial));
        }
        Ok(signs)
    }
}

/// Whether symbols may change with a name: it is among them, or inside a logarithm.
fn hides(
    symbols: &BTreeSet<Symbol>,
    name: &Name,
    logarithms: &BTreeMap<Symbol, Polynomial>,
) -> bool {
    symbols.contains(name)
        || symbols.iter().any(|symbol| {
            let argument = logarithms.get(symbol);
            argument.is_some_and(|argument| hides(&argument.symbols(), name, logarithms))
        })
}

/// Gauges under one approach.
struct Gauge {
    parts: Vec<Expansion>,
    exponent: i64,
}

/// An obligation near the target: the sign of its leading coefficient.
pub(super) fn near(
    obligation: &Obligation,
    approach: &Approach,
    budget: &Budget,
) -> Result<(Sign, Polynomial), Reason> {
    let series = approach.polynomial(&obligation.polynomial, budget)?;
    let Some((exponent, lead)) = series.leading() else {
        return Ok((obligation.sign, Polynomial::zero()));
    };
    let varies = obligation.polynomial.contains(approach.variable());
    let sign = match obligation.sign {
        // A leading coefficient that vanishes somewhere leaves the sign to the next.
        Sign::NonNegative if varies => Sign::Positive,
        sign => sign,
    };
    if sign != Sign::NonZero && exponent % 2 != 0 && approach.two_sided() {
        return Err(Reason::Unsupported(
            "a sign that differs on the two sides of a point".into(),
        ));
    }
    Ok((sign, lead.numerator().clone()))
}

/// How names that an expansion does not depend on may move so that the domain lets the variable go.
fn paths(approach: &Approach, uniformly: &[Name]) -> Vec<Vec<(Name, Polynomial)>> {
    let variable = Polynomial::symbol(approach.variable());
    let mut paths = Vec::new();
    if matches!(approach, Approach::Infinity(_)) && !uniformly.is_empty() {
        for value in [
            variable.clone(),
            variable.add(&Polynomial::one()),
            variable.add(&variable),
        ] {
            paths.push(
                uniformly
                    .iter()
                    .map(|name| (name.clone(), value.clone()))
                    .collect(),
            );
        }
    }
    paths.push(Vec::new());
    paths
}

/// The order of a difference as text. A remainder `O(t^N)` may hide logarithms, where the variable's
/// own occurs; it is then told as `o(t^(N-1))`.
fn remainder_text(approach: &Approach, difference: &Expansion) -> String {
    let log = approach.log_symbol();
    let mut arguments = difference.logarithms.values();
    let logarithmic = arguments.any(|argument| argument.contains(approach.variable()));
    match (difference.series.leading(), difference.series.order()) {
        (Some((exponent, coefficient)), _) if coefficient.contains(&log) => {
            format!("O({})", approach.term_text(coefficient, exponent))
        }
        (Some((exponent, _)), _) => format!("O({})", approach.power_text(exponent)),
        (None, Some(order)) if logarithmic => format!("o({})", approach.power_text(order - 1)),
        (None, Some(order)) => format!("O({})", approach.power_text(order)),
        (None, None) => "0".to_string(),
    }
}

fn not_shown(sign: Sign, polynomial: &Polynomial) -> Reason {
    let relation = match sign {
        Sign::Positive => "> 0",
        Sign::NonNegative => ">= 0",
        Sign::NonZero => "!= 0",
    };
    Reason::Undecided(format!("not shown on the domain: {polynomial} {relation}"))
}

/// A path as text.
pub(super) fn path_text(path: &[(Name, Polynomial)]) -> Option<String> {
    let parts: Vec<_> = path
        .iter()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}
