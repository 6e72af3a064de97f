//! What the judge answers, as plain data: the JSON of the command line is this, field by field, and
//! what is read back from there is the same.

use super::simulation::Simulation;
use crate::book::Fault;
use crate::kernel::proof::Certificate;
use serde::{Deserialize, Serialize};

/// A verdict, best first. `undecided` and `noted` never count as a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    Proved,
    Certified,
    Refuted,
    Undecided,
    Vacuous,
    IllTyped,
    Defined,
    Noted,
}

impl Verdict {
    /// Every verdict, best first.
    pub const ALL: [Verdict; 8] = [
        Verdict::Proved,
        Verdict::Certified,
        Verdict::Refuted,
        Verdict::Undecided,
        Verdict::Vacuous,
        Verdict::IllTyped,
        Verdict::Defined,
        Verdict::Noted,
    ];

    /// The word of the claim language and of all output.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Proved => "proved",
            Verdict::Certified => "certified",
            Verdict::Refuted => "refuted",
            Verdict::Undecided => "undecided",
            Verdict::Vacuous => "vacuous",
            Verdict::IllTyped => "illtyped",
            Verdict::Defined => "defined",
            Verdict::Noted => "noted",
        }
    }
}

/// What kind of statement a claim makes: that of its worst link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    Identity,
    Expansion,
    Inequality,
    Definition,
    Words,
}

/// The answer to one claim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    pub id: String,
    pub file: String,
    pub line: usize,
    pub kind: Kind,
    pub printed: Answer,
    pub mended: Option<Answer>,
    pub needs: Option<String>,
    /// What is wrong with `needs`, if anything ("stronger than necessary").
    pub needs_fault: Option<String>,
    pub sufficient: bool,
    /// Where in the paper the claim stands.
    pub page: Option<String>,
    /// The words of the text that it judges.
    pub quote: Option<String>,
    pub slip: Option<String>,
    /// What the copy at hand leaves open.
    pub scan: Option<String>,
    /// The claim that has the same mistake.
    pub like: Option<String>,
    pub why: Option<String>,
    pub expected: String,
    pub as_expected: bool,
    pub steps: u64,
    pub seconds: f64,
    /// The kernel proves and refutes the same: a fault of this program, not of the book.
    #[serde(skip)]
    pub contradiction: Option<String>,
}

/// The verdict on one statement, with its evidence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    pub verdict: Verdict,
    pub fault: Option<Fault>,
    /// The statement as written.
    pub written: String,
    /// The statement as the kernel sees it: definitions unfolded.
    pub statement: String,
    pub extent: Option<Extent>,
    /// Why it is undecided, vacuous or ill-typed.
    pub reason: Option<String>,
    pub witness: Option<WitnessReport>,
    pub links: Vec<LinkReport>,
    /// Terms of an expansion beyond the print, as text.
    pub series: Option<String>,
    pub constants: Option<Constants>,
    /// The links that are proved, from 1 as certificates count them.
    pub proved_links: Vec<usize>,
    /// The facts of mathematics that the proof rests on.
    pub facts: Vec<String>,
    /// The file that holds the certificate, relative to the book; none where it is not saved.
    pub certificate: Option<String>,
    /// What a simulation says, where one was asked for; it is no part of the verdict.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub simulation: Option<Simulation>,
    /// What the kernel replays: the proof, or the witness.
    #[serde(skip)]
    pub evidence: Option<Certificate>,
}

/// How far a certified or refuted verdict was tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Extent {
    pub points: usize,
    pub set_aside: usize,
    pub digits: u32,
}

/// A witness for the reader: numbers as text, `null` where there is no value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WitnessReport {
    pub point: std::collections::BTreeMap<String, String>,
    pub values: [Option<String>; 2],
    /// How far the values lie apart: |left - right| / max(|left|, |right|), where both are finite.
    pub difference: Option<f64>,
    pub because: Cause,
    /// Which relation of the statement fails, from 1; none where it has but one.
    pub relation: Option<usize>,
}

/// Why a point is a witness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// The values lie apart.
    Disjoint,
    /// The values are equal, where they must not be.
    Equal,
    /// Just one side has a value.
    Undefined,
    /// A duty of a definition fails.
    Duty,
    /// An expansion has other terms.
    Remainder,
}

impl Cause {
    /// The word of all output.
    pub fn word(self) -> &'static str {
        match self {
            Cause::Disjoint => "disjoint",
            Cause::Equal => "equal",
            Cause::Undefined => "undefined",
            Cause::Duty => "duty",
            Cause::Remainder => "remainder",
        }
    }
}

/// The verdict on the link to the claim that this one goes on from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinkReport {
    pub with: String,
    pub verdict: Verdict,
}

/// Explicit constants of a proved expansion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Constants {
    #[serde(rename = "C")]
    pub factor: String,
    pub k0: String,
}
