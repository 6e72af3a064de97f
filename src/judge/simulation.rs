//! The simulation of a statement at some points of its domain: evidence beside the verdict, which it never changes.

use super::Settings;
use super::search::points;
use super::statement::{numbered_relations, relation_count};
use crate::evaluate::Context;
use crate::formula::{Budget, Formula, Point, Proposition, Relation};
use crate::simulate::{Draws, Simulated, simulate_relation};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A relation is simulated at so many points whose z counts, if so many are found among the first ones tried.
const POINTS: usize = 3;

/// Points tried for a relation.
const MOST_TRIED: usize = 10;

/// Steps that the making of one experiment may take.
const STEPS: u64 = 200_000;

/// A relation of a statement, simulated at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Which relation of the statement, from 1.
    pub relation: usize,
    pub point: Point,
    pub simulated: Simulated,
    /// How far the sides are from what the relation says, in standard errors: the size of z for an equation, what is
    /// on the wrong side for an inequality.
    pub excess: f64,
}

/// The simulations of a statement in short: that which speaks most against it, of those whose z counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Simulation {
    /// Simulated points of relations whose z counts.
    pub points: usize,
    /// Runs at each.
    pub runs: u64,
    /// The left side less the right one in standard errors, where that speaks most against the relation.
    pub z: f64,
    /// There.
    pub point: BTreeMap<String, String>,
    /// Which relation, from 1; none where there is but one.
    pub relation: Option<usize>,
    /// How far z is on the wrong side: its size, for an equation.
    pub excess: f64,
}

/// What came of simulating a statement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trials {
    pub done: Vec<Trial>,
    /// The relations that were not simulated at any point, and why.
    pub left_out: Vec<(usize, String)>,
}

/// Simulates each relation of a proposition at a few points of its domain, or at one that is given.
pub fn simulate(
    proposition: &Proposition,
    given: Option<&Point>,
    settings: &Settings,
    runs: u64,
) -> Trials {
    let statement = proposition.pointwise();
    let chosen = match given {
        Some(point) => vec![point.clone()],
        None => spread(points(proposition, &Budget::new(settings.budget), settings)),
    };
    let related = numbered_relations(&statement);
    let mut trials = Trials::default();
    for number in 1..=relation_count(&statement) {
        let sides = related.iter().find(|(other, ..)| *other == number);
        let reason = match sides {
            None => Some("it speaks of a limit".to_owned()),
            Some((_, _, Relation::NotEqual | Relation::Asymptotic | Relation::Approximate, _)) => {
                Some("no equation or inequality".to_owned())
            }
            Some((_, left, relation, right)) => {
                let relation = Related {
                    number,
                    left,
                    relation: *relation,
                    right,
                };
                relation.simulate(proposition, &chosen, settings, runs, &mut trials.done)
            }
        };
        trials
            .left_out
            .extend(reason.map(|reason| (number, reason)));
    }
    trials
}

/// A relation of a statement.
struct Related<'a> {
    number: usize,
    left: &'a Formula,
    relation: Relation,
    right: &'a Formula,
}

impl Related<'_> {
    /// Simulates it at points until enough of them count; the reason, if it could be at none.
    fn simulate(
        &self,
        proposition: &Proposition,
        points: &[Point],
        settings: &Settings,
        runs: u64,
        done: &mut Vec<Trial>,
    ) -> Option<String> {
        let before = done.len();
        let mut counted = 0;
        let mut reason = None;
        for (index, point) in (0..).zip(points) {
            if counted == POINTS {
                break;
            }
            let context = Context {
                point,
                draws: &proposition.draws,
                budget: &Budget::new(STEPS),
            };
            let draws = Draws {
                runs,
                seed: settings.seed,
                number: index,
            };
            match simulate_relation(self.left, self.right, &context, draws) {
                Ok(simulated) => {
                    counted += usize::from(simulated.z.counts);
                    done.push(Trial {
                        relation: self.number,
                        point: point.clone(),
                        excess: excess(self.relation, simulated.z.z),
                        simulated,
                    });
                }
                Err(failure) => {
                    reason.get_or_insert(failure.to_string());
                }
            }
        }
        let none = || "there is no point of its domain".to_owned();
        (done.len() == before).then(|| reason.unwrap_or_else(none))
    }
}

/// Some of the points, from the smallest on, evenly over all of them.
fn spread(points: Vec<Point>) -> Vec<Point> {
    let step = points.len().div_ceil(MOST_TRIED).max(1);
    points.into_iter().skip(step / 2).step_by(step).collect()
}

/// What of z speaks against the relation.
fn excess(relation: Relation, z: f64) -> f64 {
    match relation {
        Relation::Less | Relation::LessEqual => z.max(0.0),
        Relation::Greater | Relation::GreaterEqual => (-z).max(0.0),
        Relation::NotEqual => 0.0,
        Relation::Equal | Relation::Asymptotic | Relation::Approximate => z.abs(),
    }
}

impl Trials {
    /// In short; none where no z counts.
    pub fn in_short(&self, proposition: &Proposition, runs: u64) -> Option<Simulation> {
        let counting = || self.done.iter().filter(|trial| trial.simulated.z.counts);
        let worst = counting().max_by(|a, b| a.excess.total_cmp(&b.excess))?;
        let several = relation_count(&proposition.pointwise()) > 1;
        Some(Simulation {
            points: counting().count(),
            runs,
            z: worst.simulated.z.z,
            point: worst.named(),
            relation: several.then_some(worst.relation),
            excess: worst.excess,
        })
    }
}

impl Trial {
    /// The parameters by name, as text.
    pub fn named(&self) -> BTreeMap<String, String> {
        let numbers = self.point.numbers.iter();
        numbers
            .map(|(name, value)| (name.to_string(), value.to_string()))
            .collect()
    }
}
