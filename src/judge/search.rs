//! The search for a point where a relation fails.

use super::Settings;
use super::finding::{Evidence, Finding};
use super::points::{Domain, size};
use super::relate::{AtPoint, STEPS_A_POINT, relate};
use super::statement::relations;
use super::values::Reach;
use super::verdict::{Extent, Verdict};
use crate::evaluate::Context;
use crate::formula::{
    Budget, Formula, Operator, Part, Point, Proposition, Rational, Relation, Statement,
};
use crate::kernel::{self, Witness};
use num_traits::Zero;
use std::collections::BTreeSet;

/// The points that every relation of the proposition is tried at: small ones in order of size, then
/// random near and far ones, no point twice.
pub fn points(proposition: &Proposition, budget: &Budget, settings: &Settings) -> Vec<Point> {
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
    for (left, right) in relations(statement) {
        collect_constants(Part::Formula(left), &mut constants);
        collect_constants(Part::Formula(right), &mut constants);
    }
    let one = Rational::from_integer(1.into());
    let small = Rational::from_integer(12.into());
    let marked = constants
        .iter()
        .filter(|value| !value.is_integer() || **value > small)
        .flat_map(|value| [value.clone(), -value, value + &one, value - &one]);
    marked.take(MAX_MARKS).collect()
}

fn collect_constants(part: Part, found: &mut BTreeSet<Rational>) {
    match part {
        Part::Formula(Formula::Number(value)) => {
            found.insert(value.clone());
        }
        // A fraction is one constant, not two.
        Part::Formula(Formula::Binary(Operator::Divide, over, under)) => {
            match (&**over, &**under) {
                (Formula::Number(over), Formula::Number(under)) if !under.is_zero() => {
                    found.insert(over / under);
                }
                _ => part.each(&mut |inner, _| collect_constants(inner, found)),
            }
        }
        _ => part.each(&mut |inner, _| collect_constants(inner, found)),
    }
}

/// The search for a failure of one relation.
pub struct Search<'a> {
    pub proposition: &'a Proposition,
    pub points: &'a [Point],
    /// The number of the relation, as the kernel counts.
    pub number: usize,
    pub budget: &'a Budget,
    pub settings: &'a Settings,
}

/// How many failing points the kernel is asked about at a time, and how many times.
const KERNEL_TRIES: usize = 6;
const ROUNDS: usize = 3;
/// So many points may cost more where none is cheap, which is given up after so many others.
const COSTLY_POINTS: usize = 3;
const COSTLY_TRIES: usize = 24;

impl Search<'_> {
    /// Tries the relation at every point, and asks the kernel about those where it fails.
    pub fn relation(&self, left: &Formula, relation: Relation, right: &Formula) -> Finding {
        if self.points.is_empty() {
            let reason = match self.budget.spend(1) {
                Ok(()) => "no point of the domain was found",
                Err(_) => "the budget of steps is spent",
            };
            return Finding::because(Verdict::Undecided, reason);
        }
        let mut tally = Tally::default();
        let mut points = self.points.iter();
        let mut seen = None;
        // A failure that the kernel cannot check is no verdict: another may be.
        for _ in 0..ROUNDS {
            for point in points.by_ref() {
                tally.add(
                    point,
                    self.at(point, (left, relation, right), STEPS_A_POINT),
                );
                if tally.two_valued.len() >= KERNEL_TRIES || tally.is_costly() {
                    break;
                }
            }
            let candidates = tally.candidates();
            if candidates.is_empty() {
                break;
            }
            let refuted = self.refute(&candidates);
            if refuted.verdict == Verdict::Refuted {
                return refuted;
            }
            tally.forget_candidates();
            seen = seen.or(Some(refuted));
        }
        if let Some(seen) = seen {
            return seen;
        }
        // Where no value is cheap, a few points may cost more.
        let costly = std::mem::take(&mut tally.too_costly);
        let rest = self.settings.budget.saturating_sub(self.budget.spent());
        let patient = if tally.held == 0 { COSTLY_POINTS } else { 0 };
        for (index, point) in costly.into_iter().enumerate() {
            if index < patient {
                let steps = rest / (3 * COSTLY_POINTS as u64);
                tally.add(point, self.at(point, (left, relation, right), steps));
            } else {
                tally.too_costly.push(point);
            }
        }
        match tally.candidates() {
            candidates if candidates.is_empty() => self.held(tally),
            candidates => self.refute(&candidates),
        }
    }

    fn at(
        &self,
        point: &Point,
        (left, relation, right): (&Formula, Relation, &Formula),
        steps: u64,
    ) -> AtPoint {
        let context = Context {
            point,
            draws: &self.proposition.draws,
            budget: self.budget,
        };
        relate(left, relation, right, &context, self.settings.digits, steps)
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
                format!("points that cannot be told: {unknown}; {why}"),
            )
        } else if !tally.too_costly.is_empty() {
            Finding::because(
                Verdict::Undecided,
                "the values cost too many steps at every point that was tried",
            )
        } else {
            Finding::because(
                Verdict::Undecided,
                "neither side has a value at any point tried",
            )
        };
        finding.extent = extent.filter(|extent| extent.points > 0);
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
                            refutation: Box::new(refutation),
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
    too_costly: Vec<&'a Point>,
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
            AtPoint::TooCostly => self.too_costly.push(point),
            AtPoint::Fails { both_valued: true } => self.two_valued.push(point),
            AtPoint::Fails { both_valued: false } => self.one_valued.push(point),
        }
    }

    /// Whether no value was cheap so far, nor will be: the smallest points come first.
    fn is_costly(&self) -> bool {
        self.held + self.set_aside == 0 && self.too_costly.len() >= COSTLY_TRIES
    }

    fn forget_candidates(&mut self) {
        self.two_valued.clear();
        self.one_valued.clear();
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
