//! Statement to verdict: refute if possible, else prove, else certify, within a budget of counted
//! steps.
//!
//! The judge finds; it is not believed. A failure that it sees counts only when the kernel checks it
//! ([`crate::kernel::check_witness`]), a proof only when the kernel makes a
//! [`crate::kernel::proof::Theorem`] of it; what it cannot decide stays `undecided`.

mod duties;
mod finding;
mod functions;
mod points;
mod proof;
mod relate;
mod search;
mod simulation;
mod statement;
mod vacuous;
mod values;
mod verdict;

pub use simulation::{Simulation, Trial, Trials, simulate};
pub use verdict::{
    Answer, Cause, Constants, Extent, Kind, LinkReport, Report, Verdict, WitnessReport,
};

use crate::book::{Claim, Fault, IllTyped};
use crate::formula::{Budget, Condition, Point, Proposition, Rational, Relation, Statement};
use crate::kernel::proof::{Certificate, Theorem};
use crate::kernel::{Because, Value};
use crate::number::Interval;
use crate::number::convert::to_rug;
use finding::{Evidence, Finding, Proof};
use num_traits::{Signed, ToPrimitive, Zero};
use points::Domain;
use proof::decide;
use statement::{holds_at, is_expansion, judge_proposition, relation_count};
use std::collections::BTreeMap;
use std::time::Instant;

/// How hard the judge tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The seed of all random points.
    pub seed: u64,
    /// Digits that agreeing enclosures must reach.
    pub digits: u32,
    /// Steps a claim may spend.
    pub budget: u64,
    /// Small points tried a statement; half as many near random ones and an eighth far ones follow.
    pub points: usize,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            seed: 1,
            digits: 50,
            budget: 10_000_000,
            points: 120,
        }
    }
}

/// Judges one claim. `previous` is the claim that its `after` line names.
pub fn judge(claim: &Claim, previous: Option<&Claim>, settings: &Settings) -> Report {
    judge_with(claim, previous, &[], settings)
}

/// Judges one claim, of which these certificates are kept. They are replayed before anything is
/// searched for; those of other statements, and broken ones, count for nothing.
pub fn judge_with(
    claim: &Claim,
    previous: Option<&Claim>,
    kept: &[Certificate],
    settings: &Settings,
) -> Report {
    let started = Instant::now();
    let budget = Budget::new(settings.budget);
    let bench = Bench {
        claim,
        kept,
        settings,
        budget: &budget,
    };
    let (printed, mended) = (claim.printed(), claim.mended());
    let printed_finding = bench.find(&printed);
    let mended_finding = mended.as_ref().map(|mended| bench.find(mended));
    let needs_fault = mended
        .as_ref()
        .and_then(|mended| bench.needs_fault(mended.as_ref().ok()?));
    let (fault, clearer) = bench.fault(
        &printed_finding,
        &printed,
        mended.as_ref(),
        mended_finding.as_ref(),
    );
    let findings = [Some(&printed_finding), mended_finding.as_ref()];
    let contradiction = findings
        .into_iter()
        .flatten()
        .find_map(|finding| finding.contradiction.clone());
    let printed_finding = clearer.unwrap_or(printed_finding);
    let mut printed = answer(printed_finding, &printed, &claim.says_text, fault);
    printed.links = bench.links(previous);
    let mended = mended.zip(mended_finding).map(|(mended, finding)| {
        let text = claim.mend_text.as_ref().unwrap_or(&claim.says_text);
        answer(finding, &mended, text, Fault::Statement)
    });
    let as_expected = needs_fault.is_none() && bench.as_expected(&printed, mended.as_ref());
    Report {
        id: claim.id.to_string(),
        file: claim.file.display().to_string(),
        line: claim.line,
        kind: kind(&claim.says),
        printed,
        mended,
        needs: claim.needs.as_ref().map(|needs| needs.text.clone()),
        needs_fault,
        sufficient: claim.needs.as_ref().is_some_and(|needs| needs.sufficient),
        page: claim.page.clone(),
        quote: claim.quote.clone(),
        slip: claim.slip.clone(),
        scan: claim.scan.clone(),
        like: claim.like.as_ref().map(ToString::to_string),
        why: claim.why.clone(),
        expected: claim.expect_text.clone().unwrap_or_default(),
        as_expected,
        steps: budget.spent(),
        seconds: started.elapsed().as_secs_f64(),
        contradiction,
    }
}

/// One claim on the bench, with what may be spent on it.
struct Bench<'a> {
    claim: &'a Claim,
    kept: &'a [Certificate],
    settings: &'a Settings,
    budget: &'a Budget,
}

/// How many points that `needs` shuts out are tried.
const SHUT_OUT_POINTS: usize = 60;

impl Bench<'_> {
    fn find(&self, unfolded: &Result<Proposition, IllTyped>) -> Finding {
        match unfolded {
            Ok(proposition) => decide(proposition, self.kept, self.budget, self.settings),
            Err(illtyped) => Finding::because(Verdict::IllTyped, illtyped.to_string()),
        }
    }

    /// A refuted print is at fault in its domain where the same statement holds under `needs`. Where
    /// it does not, what refutes it there tells the reader more than a missing condition would.
    fn fault(
        &self,
        finding: &Finding,
        printed: &Result<Proposition, IllTyped>,
        mended: Option<&Result<Proposition, IllTyped>>,
        mended_finding: Option<&Finding>,
    ) -> (Fault, Option<Finding>) {
        let (Verdict::Refuted, Some(_), Ok(printed), Some(Ok(mended))) =
            (finding.verdict, &self.claim.needs, printed, mended)
        else {
            return (Fault::Statement, None);
        };
        if self.claim.mend.is_none() {
            return match mended_finding.is_some_and(Finding::positive) {
                true => (Fault::Domain, None),
                false => (Fault::Statement, None),
            };
        }
        let under_needs = Proposition {
            statement: printed.statement.clone(),
            ..mended.clone()
        };
        let clearer = judge_proposition(&under_needs, self.budget, self.settings);
        if clearer.positive() {
            (Fault::Domain, None)
        } else {
            let refuted = clearer.verdict == Verdict::Refuted;
            (Fault::Statement, refuted.then_some(clearer))
        }
    }

    /// `needs` is tried: every point that it shuts out must fail, or have no value on either side.
    fn needs_fault(&self, mended: &Proposition) -> Option<String> {
        if self.claim.needs.as_ref()?.sufficient {
            return None;
        }
        let mut outside = mended.clone();
        let needs = outside.domain.pop()?;
        outside.domain.push(Condition::Not(Box::new(needs)));
        let domain = Domain::new(&outside, self.budget);
        let points = domain.small(SHUT_OUT_POINTS, 100 * SHUT_OUT_POINTS);
        let held = points
            .iter()
            .find(|point| holds_at(&outside, point, self.budget, self.settings) == Some(true))?;
        let values: Vec<String> = held
            .numbers
            .iter()
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        Some(format!(
            "stronger than necessary: the statement holds at {}",
            values.join(", ")
        ))
    }

    fn links(&self, previous: Option<&Claim>) -> Vec<LinkReport> {
        let Some((previous, proposition)) =
            previous.and_then(|previous| Some((previous, self.claim.link(previous)?)))
        else {
            return Vec::new();
        };
        let verdict = judge_proposition(&proposition, self.budget, self.settings).verdict;
        vec![LinkReport {
            with: previous.id.to_string(),
            verdict,
        }]
    }

    fn as_expected(&self, printed: &Answer, mended: Option<&Answer>) -> bool {
        self.claim
            .printed_meets(printed.verdict.word(), printed.fault)
            && mended
                .is_none_or(|mended| self.claim.mended_meets(mended.verdict.word(), mended.fault))
    }
}

fn answer(
    finding: Finding,
    unfolded: &Result<Proposition, IllTyped>,
    written: &str,
    fault: Fault,
) -> Answer {
    let theorem = finding.proof.as_ref().map(|proof| &proof.theorem);
    let relations = unfolded
        .as_ref()
        .map_or(0, |it| relation_count(&it.statement));
    Answer {
        verdict: finding.verdict,
        fault: (finding.verdict == Verdict::Refuted).then_some(fault),
        written: written.to_string(),
        statement: unfolded
            .as_ref()
            .map(ToString::to_string)
            .unwrap_or_default(),
        extent: finding.extent,
        reason: finding.reason,
        links: Vec::new(),
        series: finding.series,
        constants: None,
        proved_links: theorem.map_or_else(Vec::new, |t| t.links().iter().map(|l| l + 1).collect()),
        facts: theorem.map_or_else(Vec::new, facts),
        certificate: None,
        simulation: None,
        evidence: certificate(unfolded, finding.proof.as_deref(), finding.witness.as_ref()),
        witness: finding
            .witness
            .map(|evidence| report_witness(evidence, relations)),
    }
}

/// The facts of mathematics that a theorem rests on, each once, in the order of the kernel's rules.
fn facts(theorem: &Theorem) -> Vec<String> {
    let mut facts: Vec<String> = Vec::new();
    for source in theorem.rules().iter().map(|rule| rule.source()) {
        if !source.is_empty() && !facts.iter().any(|known| known == source) {
            facts.push(source.to_string());
        }
    }
    facts
}

/// What the kernel can replay of a finding: its proof, or else its witness.
fn certificate(
    unfolded: &Result<Proposition, IllTyped>,
    proof: Option<&Proof>,
    witness: Option<&Evidence>,
) -> Option<Certificate> {
    match (unfolded, proof, witness) {
        (_, Some(proof), _) => Some(Certificate::Theorem(proof.script.clone())),
        (Ok(proposition), None, Some(Evidence::Checked { witness, .. })) => {
            Some(Certificate::Refutation {
                proposition: proposition.clone(),
                witness: witness.clone(),
            })
        }
        _ => None,
    }
}

fn report_witness(evidence: Evidence, relations: usize) -> WitnessReport {
    match evidence {
        Evidence::Checked {
            witness,
            refutation,
        } => WitnessReport {
            point: point_text(&witness.point),
            values: [
                value_text(refutation.left()),
                value_text(refutation.right()),
            ],
            difference: difference(refutation.left(), refutation.right()),
            because: cause(refutation.because()),
            relation: (relations > 1).then_some(witness.link + 1),
        },
        Evidence::Series {
            point,
            claimed,
            found,
        } => WitnessReport {
            point: point_text(&point),
            values: [Some(found), Some(claimed)],
            difference: None,
            because: Cause::Remainder,
            relation: None,
        },
    }
}

fn point_text(point: &Point) -> BTreeMap<String, String> {
    let numbers = point
        .numbers
        .iter()
        .map(|(name, value)| (name.to_string(), value.to_string()));
    let functions = point
        .functions
        .iter()
        .map(|(name, (argument, body))| (format!("{name}({argument})"), body.to_string()));
    numbers.chain(functions).collect()
}

/// A value for the reader: exact, or the digits on which the ends of the enclosure agree.
fn value_text(value: &Value) -> Option<String> {
    match value {
        Value::Undefined => None,
        Value::PlusInfinity => Some("+inf".into()),
        Value::MinusInfinity => Some("-inf".into()),
        Value::Finite { low, high } if low == high => Some(low.to_string()),
        Value::Finite { low, high } => {
            let ends = (to_rug(low), to_rug(high));
            let low = Interval::from_rational(&ends.0, SHOWN_BITS);
            let high = Interval::from_rational(&ends.1, SHOWN_BITS);
            Some(low.hull(&high).to_decimal(SHOWN_DIGITS))
        }
    }
}

/// |left - right| / max(|left|, |right|), of enclosures from their middles.
fn difference(left: &Value, right: &Value) -> Option<f64> {
    let middle = |value: &Value| match value {
        Value::Finite { low, high } => Some((low + high) / Rational::from_integer(2.into())),
        _ => None,
    };
    let (left, right) = (middle(left)?, middle(right)?);
    let size = left.abs().max(right.abs());
    if size.is_zero() {
        return Some(0.0);
    }
    ((left - right).abs() / size).to_f64()
}

fn cause(because: Because) -> Cause {
    match because {
        Because::Disjoint => Cause::Disjoint,
        Because::Equal => Cause::Equal,
        Because::Undefined => Cause::Undefined,
        Because::Duty => Cause::Duty,
    }
}

/// Digits of a witness's values that a reader is shown, and bits that hold them.
const SHOWN_DIGITS: usize = 17;
const SHOWN_BITS: u32 = 80;

fn kind(statement: &Statement) -> Kind {
    match statement {
        Statement::All(parts) => parts
            .iter()
            .map(kind)
            .find(|kind| *kind == Kind::Expansion)
            .unwrap_or_else(|| parts.first().map(kind).unwrap_or(Kind::Words)),
        Statement::Chain { links, .. } => {
            if links
                .iter()
                .any(|(relation, right)| is_expansion(*relation, right))
            {
                Kind::Expansion
            } else if links
                .iter()
                .all(|(relation, _)| *relation == Relation::Equal)
            {
                Kind::Identity
            } else {
                Kind::Inequality
            }
        }
        Statement::Definition { .. } => Kind::Definition,
        Statement::Conditional { .. } => Kind::Identity,
        Statement::Words | Statement::Empty => Kind::Words,
    }
}
