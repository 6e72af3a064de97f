//! A proposition to a verdict: every part of its statement is judged, and the whole is as good as the
//! worst of them.

use super::Settings;
use super::duties::judge_duties;
use super::finding::{Evidence, Finding, worse};
use super::relate::{AtPoint, STEPS_A_POINT, relate};
use super::search::{Search, points};
use super::vacuous::contradictory;
use super::verdict::Verdict;
use crate::evaluate::Context;
use crate::formula::{
    Budget, Duty, Formula, Name, Point, Proposition, Regime, Relation, Statement,
};
use crate::prover::{ExpansionVerdict, judge_expansion};

/// One part of a statement; relations and duties are numbered as the kernel numbers them.
pub enum Part<'a> {
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

/// Judges a proposition by what its parts do at points of the domain.
pub fn judge_proposition(
    proposition: &Proposition,
    budget: &Budget,
    settings: &Settings,
) -> Finding {
    let statement = proposition.pointwise();
    match Trial::new(proposition, &statement, budget, settings) {
        Ok(trial) => trial.whole(),
        Err(finding) => *finding,
    }
}

/// What the parts of a statement came to, one after the other, up to the first that is refuted.
pub struct Trial<'a> {
    pub points: Vec<Point>,
    pub parts: Vec<Part<'a>>,
    pub findings: Vec<Finding>,
}

impl<'a> Trial<'a> {
    /// Tries the parts of the statement, which is that of the proposition as it speaks of points.
    ///
    /// # Errors
    /// What there is to say of a proposition without anything to try.
    pub fn new(
        proposition: &Proposition,
        statement: &'a Statement,
        budget: &Budget,
        settings: &Settings,
    ) -> Result<Trial<'a>, Box<Finding>> {
        let parts = parts(statement);
        if parts.iter().all(|part| matches!(part, Part::Noted)) {
            return Err(Box::new(Finding::plain(Verdict::Noted)));
        }
        if contradictory(proposition) {
            let why = "the conditions contradict each other";
            return Err(Box::new(Finding::because(Verdict::Vacuous, why)));
        }
        let points = points(proposition, budget, settings);
        let mut number = 0;
        let mut findings = Vec::new();
        let written = self::parts(&proposition.statement);
        for (part, written) in parts.iter().zip(&written) {
            if written.says_nothing() {
                findings.push(Finding::because(
                    Verdict::Vacuous,
                    "both sides are the same formula once definitions are unfolded",
                ));
                number += part.count();
                continue;
            }
            let finding = judge_part(part, proposition, &points, number, budget, settings);
            number += part.count();
            let refuted = finding.verdict == Verdict::Refuted;
            findings.push(finding);
            if refuted {
                break;
            }
        }
        Ok(Trial {
            points,
            parts,
            findings,
        })
    }

    /// The statement is as good as its worst part.
    pub fn whole(self) -> Finding {
        let worst = self.findings.into_iter().reduce(worse);
        worst.unwrap_or_else(|| Finding::plain(Verdict::Noted))
    }
}

/// Whether a proof would be better than this.
pub fn is_open(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Certified | Verdict::Undecided)
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
    let statement = proposition.pointwise();
    for part in parts(&statement) {
        if let Part::Relation {
            left,
            relation,
            right,
        } = part
        {
            match relate(
                left,
                relation,
                right,
                &context,
                settings.digits,
                STEPS_A_POINT,
            ) {
                AtPoint::Fails { .. } => return Some(false),
                AtPoint::Holds { .. } => held = Some(true),
                AtPoint::SetAside | AtPoint::Unknown(_) | AtPoint::TooCostly => return None,
            }
        }
    }
    held
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

/// How many relations a statement has, expansions among them.
pub fn relation_count(statement: &Statement) -> usize {
    let relation = |part: &&Part| matches!(part, Part::Relation { .. } | Part::Expansion { .. });
    parts(statement).iter().filter(relation).count()
}

/// The two sides of each relation of a statement that can be tried at a point.
pub fn relations(statement: &Statement) -> Vec<(&Formula, &Formula)> {
    let sides = |part| match part {
        Part::Relation { left, right, .. } => Some((left, right)),
        _ => None,
    };
    parts(statement).into_iter().filter_map(sides).collect()
}

/// The relations of a statement that can be tried at a point, with their numbers from 1.
pub fn numbered_relations(statement: &Statement) -> Vec<(usize, &Formula, Relation, &Formula)> {
    let related = |part: &&Part| matches!(part, Part::Relation { .. } | Part::Expansion { .. });
    let parts = parts(statement);
    let numbered = parts.iter().filter(related).zip(1..);
    let sides = numbered.filter_map(|(part, number)| match *part {
        Part::Relation {
            left,
            relation,
            right,
        } => Some((number, left, relation, right)),
        _ => None,
    });
    sides.collect()
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
    /// Whether it speaks of a limit, not of single points.
    pub fn is_expansion(&self) -> bool {
        matches!(self, Part::Expansion { .. })
    }

    /// Whether it equates a formula with itself.
    fn says_nothing(&self) -> bool {
        let Part::Relation {
            left,
            relation,
            right,
        } = self
        else {
            return false;
        };
        left == right && *relation == Relation::Equal
    }

    /// How many of the kernel's numbers the part takes up.
    fn count(&self) -> usize {
        match self {
            Part::Definition { duties, .. } => duties.len(),
            Part::Relation { .. } | Part::Expansion { .. } => 1,
            Part::Noted | Part::Unresolved => 0,
        }
    }
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
            numbers,
        } => {
            let along = path.map_or_else(String::new, |path| format!(" along {path}"));
            let numbers = numbers.map_or_else(String::new, |numbers| format!("; {numbers}"));
            let found = format!("{term}, of order {order}{along}{numbers}");
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
