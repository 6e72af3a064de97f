//! A proposition to a verdict: every part of its statement is judged, and the whole is as good as the
//! worst of them.

use super::Settings;
use super::points::{Domain, Reach, contradictory, size};
use super::relate::{AtPoint, relate};
use super::verdict::{Extent, Verdict};
use crate::evaluate::Context;
use crate::formula::{
    self, Budget, Condition, Duty, Formula, Name, Parameter, ParameterKind, Point, Proposition,
    RangeKind, Ranged, Rational, Regime, Relation, Statement, TooLarge, free_names, substitute,
};
use crate::kernel::{self, Refutation, Witness};
use crate::prover::{ExpansionVerdict, judge_expansion};
use std::collections::BTreeSet;

/// What was found out about one part of a statement, or about the whole.
#[derive(Debug)]
pub struct Finding {
    pub verdict: Verdict,
    pub extent: Option<Extent>,
    pub reason: Option<String>,
    pub witness: Option<Evidence>,
    pub series: Option<String>,
}

/// Why a part is refuted.
#[derive(Debug)]
pub enum Evidence {
    /// The kernel checked this witness.
    Checked {
        witness: Witness,
        refutation: Refutation,
    },
    /// The exact series of both sides differ: until expansions have constants, this is not the
    /// kernel's word.
    Series {
        point: Point,
        claimed: String,
        found: String,
    },
}

/// One part of a statement; relations and duties are numbered as the kernel numbers them.
enum Part<'a> {
    Relation {
        left: &'a Formula,
        relation: Relation,
        right: &'a Formula,
    },
    Expansion {
        left: &'a Formula,
        relation: Relation,
        right: &'a Formula,
        regime: &'a Regime,
    },
    Definition {
        arguments: &'a [Name],
        body: &'a Formula,
        duties: &'a [Duty],
    },
    Noted,
    /// A condition on another claim that the book could not unfold.
    Unresolved,
}

impl Finding {
    fn plain(verdict: Verdict) -> Finding {
        Finding {
            verdict,
            extent: None,
            reason: None,
            witness: None,
            series: None,
        }
    }

    /// A verdict with its reason.
    pub fn because(verdict: Verdict, reason: impl Into<String>) -> Finding {
        Finding {
            reason: Some(reason.into()),
            ..Finding::plain(verdict)
        }
    }

    /// Whether the statement may be relied on.
    pub fn positive(&self) -> bool {
        matches!(
            self.verdict,
            Verdict::Proved | Verdict::Certified | Verdict::Defined
        )
    }
}

/// Judges a proposition.
pub fn judge_proposition(
    proposition: &Proposition,
    budget: &Budget,
    settings: &Settings,
) -> Finding {
    let parts = parts(&proposition.statement);
    if parts.iter().all(|part| matches!(part, Part::Noted)) {
        return Finding::plain(Verdict::Noted);
    }
    if contradictory(proposition) {
        return Finding::because(Verdict::Vacuous, "the conditions contradict each other");
    }
    let points = points(proposition, budget, settings);
    let mut number = 0;
    let mut worst: Option<Finding> = None;
    for part in &parts {
        let finding = judge_part(part, proposition, &points, number, budget, settings);
        number += part.count();
        let refuted = finding.verdict == Verdict::Refuted;
        worst = Some(match worst {
            Some(worst) => worse(worst, finding),
            None => finding,
        });
        if refuted {
            break;
        }
    }
    worst.unwrap_or_else(|| Finding::plain(Verdict::Noted))
}

/// Whether the statement's relations (not its expansions) all hold at one point; `None` where they
/// cannot be told or none has a value there.
pub fn holds_at(
    proposition: &Proposition,
    point: &Point,
    budget: &Budget,
    settings: &Settings,
) -> Option<bool> {
    let context = Context {
        point,
        draws: &proposition.draws,
        budget,
    };
    let mut held = None;
    for part in parts(&proposition.statement) {
        if let Part::Relation {
            left,
            relation,
            right,
        } = part
        {
            match relate(left, relation, right, &context, settings.digits) {
                AtPoint::Fails { .. } => return Some(false),
                AtPoint::Holds { .. } => held = Some(true),
                AtPoint::SetAside | AtPoint::Unknown(_) | AtPoint::TooCostly => return None,
            }
        }
    }
    held
}

/// The points that every relation of the proposition is tried at: small ones in order of size, then
/// random near and far ones, no point twice.
fn points(proposition: &Proposition, budget: &Budget, settings: &Settings) -> Vec<Point> {
    let domain = Domain::new(proposition, budget);
    let mut points = domain.small(settings.points, 40 * settings.points);
    let random = [(Reach::Near, 2), (Reach::Far, 8)];
    let random = random
        .into_iter()
        .flat_map(|(reach, share)| domain.random(settings.points / share, reach, settings.seed));
    let marks = marks(&proposition.statement);
    for point in random.chain(domain.marked(&marks, settings.seed)) {
        if !points.contains(&point) {
            points.push(point);
        }
    }
    points
}

/// So many of a statement's constants are tried.
const MAX_MARKS: usize = 24;

/// The constants of a statement beyond the smallest, which are tried anyway, and their neighbours.
fn marks(statement: &Statement) -> Vec<Rational> {
    let mut constants = BTreeSet::new();
    for part in parts(statement) {
        if let Part::Relation { left, right, .. } = part {
            collect_constants(formula::Part::Formula(left), &mut constants);
            collect_constants(formula::Part::Formula(right), &mut constants);
        }
    }
    let one = Rational::from_integer(1.into());
    let small = Rational::from_integer(12.into());
    let marked = constants
        .iter()
        .filter(|value| !value.is_integer() || **value > small)
        .flat_map(|value| [value.clone(), -value, value + &one, value - &one]);
    marked.take(MAX_MARKS).collect()
}

fn collect_constants(part: formula::Part, found: &mut BTreeSet<Rational>) {
    if let formula::Part::Formula(Formula::Number(value)) = part {
        found.insert(value.clone());
    }
    part.each(&mut |inner, _| collect_constants(inner, found));
}

fn parts(statement: &Statement) -> Vec<Part<'_>> {
    match statement {
        Statement::All(all) => all.iter().flat_map(parts).collect(),
        Statement::Chain {
            first,
            links,
            regime,
        } => {
            let lefts = std::iter::once(first).chain(links.iter().map(|(_, right)| right));
            lefts
                .zip(links)
                .map(|(left, (relation, right))| match regime {
                    Some(regime) if is_expansion(*relation, right) => Part::Expansion {
                        left,
                        relation: *relation,
                        right,
                        regime,
                    },
                    _ => Part::Relation {
                        left,
                        relation: *relation,
                        right,
                    },
                })
                .collect()
        }
        Statement::Definition {
            arguments,
            body,
            duties,
            ..
        } => {
            vec![Part::Definition {
                arguments,
                body,
                duties,
            }]
        }
        Statement::Conditional { .. } => vec![Part::Unresolved],
        Statement::Words | Statement::Empty => vec![Part::Noted],
    }
}

/// Whether a link speaks of a limit.
pub fn is_expansion(relation: Relation, right: &Formula) -> bool {
    matches!(relation, Relation::Asymptotic | Relation::Approximate) || has_order_term(right)
}

fn has_order_term(formula: &Formula) -> bool {
    match formula {
        Formula::BigO(_) | Formula::LittleO(_) => true,
        Formula::Negate(inner) => has_order_term(inner),
        Formula::Binary(_, left, right) => has_order_term(left) || has_order_term(right),
        _ => false,
    }
}

impl Part<'_> {
    /// How many of the kernel's numbers the part takes up.
    fn count(&self) -> usize {
        match self {
            Part::Definition { duties, .. } => duties.len(),
            Part::Relation { .. } | Part::Expansion { .. } => 1,
            Part::Noted | Part::Unresolved => 0,
        }
    }
}

/// The finding that decides a chain: a refuted link refutes it, else the worse verdict stands.
fn worse(a: Finding, b: Finding) -> Finding {
    let rank = |finding: &Finding| match finding.verdict {
        Verdict::Refuted => 8,
        other => other as usize,
    };
    let extent = match (a.extent, b.extent) {
        (Some(a), Some(b)) => Some(Extent {
            points: a.points.min(b.points),
            set_aside: a.set_aside.max(b.set_aside),
            digits: a.digits.min(b.digits),
        }),
        (a, b) => a.or(b),
    };
    let series = a.series.clone().or_else(|| b.series.clone());
    let mut worst = if rank(&b) > rank(&a) { b } else { a };
    worst.extent = extent;
    worst.series = series;
    worst
}

fn judge_part(
    part: &Part,
    proposition: &Proposition,
    points: &[Point],
    number: usize,
    budget: &Budget,
    settings: &Settings,
) -> Finding {
    match part {
        Part::Relation {
            left,
            relation,
            right,
        } => {
            if left == right && *relation == Relation::Equal {
                return Finding::because(
                    Verdict::Vacuous,
                    "both sides are the same formula once definitions are unfolded",
                );
            }
            let search = Search {
                proposition,
                points,
                number,
                budget,
                settings,
            };
            search.relation(left, *relation, right)
        }
        Part::Expansion {
            left,
            relation,
            right,
            regime,
        } => match judge_expansion(left, *relation, right, regime, proposition, budget) {
            Ok(verdict) => expansion_finding(verdict),
            Err(reason) => Finding::because(Verdict::Undecided, reason.to_string()),
        },
        Part::Definition {
            arguments,
            body,
            duties,
        } => judge_duties(
            arguments,
            body,
            duties,
            proposition,
            number,
            budget,
            settings,
        ),
        Part::Noted => Finding::plain(Verdict::Noted),
        Part::Unresolved => Finding::because(Verdict::Undecided, "the claim it names is not here"),
    }
}

fn expansion_finding(verdict: ExpansionVerdict) -> Finding {
    match verdict {
        ExpansionVerdict::Holds { further, remainder } => {
            let series = match further {
                Some(further) => format!("{further}; remainder of the print: {remainder}"),
                None => format!("remainder of the print: {remainder}"),
            };
            Finding {
                series: Some(series),
                ..Finding::plain(Verdict::Certified)
            }
        }
        ExpansionVerdict::Fails {
            term,
            order,
            claimed,
            point,
            path,
        } => {
            let along = path
                .map(|path| format!(" along {path}"))
                .unwrap_or_default();
            let found = format!("{term}, of order {order}{along}");
            Finding {
                witness: Some(Evidence::Series {
                    point,
                    claimed,
                    found,
                }),
                ..Finding::plain(Verdict::Refuted)
            }
        }
        ExpansionVerdict::Vacuous { why } => Finding::because(Verdict::Vacuous, why),
    }
}

/// The search for a failure of one relation.
struct Search<'a> {
    proposition: &'a Proposition,
    points: &'a [Point],
    number: usize,
    budget: &'a Budget,
    settings: &'a Settings,
}

/// How many failing points the kernel is asked about before the judge gives up on it.
const KERNEL_TRIES: usize = 6;

impl Search<'_> {
    fn relation(&self, left: &Formula, relation: Relation, right: &Formula) -> Finding {
        if self.points.is_empty() {
            return Finding::because(Verdict::Undecided, "no point of the domain was found");
        }
        let mut tally = Tally::default();
        for point in self.points {
            let context = Context {
                point,
                draws: &self.proposition.draws,
                budget: self.budget,
            };
            tally.add(
                point,
                relate(left, relation, right, &context, self.settings.digits),
            );
            if tally.two_valued.len() >= KERNEL_TRIES {
                break;
            }
        }
        let candidates = tally.candidates();
        if candidates.is_empty() {
            self.held(tally)
        } else {
            self.refute(&candidates)
        }
    }

    /// No point failed.
    fn held(&self, tally: Tally) -> Finding {
        let extent = Some(Extent {
            points: tally.held,
            set_aside: tally.set_aside,
            digits: self.settings.digits,
        });
        let unknown = tally.unknown.len();
        // One point that nobody can tell may be the one where the statement fails.
        let mut finding = if tally.held > 0 && unknown == 0 {
            Finding::plain(Verdict::Certified)
        } else if let Some(why) = tally.unknown.first() {
            Finding::because(
                Verdict::Undecided,
                format!("{unknown} points undecided: {why}"),
            )
        } else {
            Finding::because(
                Verdict::Undecided,
                "neither side has a value at any point tried",
            )
        };
        finding.extent = extent;
        finding
    }

    /// The point without the place of a definition's range: the kernel finds places by itself.
    fn parameters_of(&self, point: &Point) -> Point {
        let mut point = point.clone();
        let parameters = &self.proposition.parameters;
        point
            .numbers
            .retain(|name, _| parameters.iter().any(|parameter| parameter.name == *name));
        point
    }

    /// The first candidate that the kernel confirms refutes.
    fn refute(&self, candidates: &[&Point]) -> Finding {
        let mut reason = String::new();
        for point in candidates {
            let witness = Witness {
                point: self.parameters_of(point),
                link: self.number,
            };
            match kernel::check_witness(self.proposition, &witness) {
                Ok(refutation) => {
                    return Finding {
                        witness: Some(Evidence::Checked {
                            witness,
                            refutation,
                        }),
                        ..Finding::plain(Verdict::Refuted)
                    };
                }
                Err(unknown) => reason = unknown.0,
            }
        }
        Finding::because(
            Verdict::Undecided,
            format!("seen to fail, but not checked by the kernel: {reason}"),
        )
    }
}

/// What a relation did at the points so far.
#[derive(Default)]
struct Tally<'a> {
    held: usize,
    set_aside: usize,
    /// Points that count neither way: their values would cost too much.
    too_costly: usize,
    unknown: Vec<String>,
    two_valued: Vec<&'a Point>,
    one_valued: Vec<&'a Point>,
}

impl<'a> Tally<'a> {
    fn add(&mut self, point: &'a Point, at: AtPoint) {
        match at {
            AtPoint::Holds { .. } => self.held += 1,
            AtPoint::SetAside => self.set_aside += 1,
            AtPoint::Unknown(why) => self.unknown.push(why),
            AtPoint::TooCostly => self.too_costly += 1,
            AtPoint::Fails { both_valued: true } => self.two_valued.push(point),
            AtPoint::Fails { both_valued: false } => self.one_valued.push(point),
        }
    }

    /// Failing points, those with two values first, the smallest first.
    fn candidates(&self) -> Vec<&'a Point> {
        let smallest = |points: &[&'a Point]| {
            let mut sorted = points.to_vec();
            sorted.sort_by_cached_key(|point| size(point));
            sorted.truncate(KERNEL_TRIES);
            sorted
        };
        let mut candidates = smallest(&self.two_valued);
        candidates.extend(smallest(&self.one_valued));
        candidates
    }
}

/// A definition stands when no duty fails: each is put as a relation of its own.
fn judge_duties(
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
