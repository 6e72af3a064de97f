//! What the judge found out about a statement, before it is put into words.

use super::verdict::{Extent, Verdict};
use crate::formula::Point;
use crate::kernel::proof::{Script, Theorem};
use crate::kernel::{Refutation, Witness};

/// What was found out about one part of a statement, or about the whole.
#[derive(Debug)]
pub struct Finding {
    pub verdict: Verdict,
    pub extent: Option<Extent>,
    pub reason: Option<String>,
    pub witness: Option<Evidence>,
    pub series: Option<String>,
    pub proof: Option<Box<Proof>>,
    /// What is both proved and refuted: a fault of ours.
    pub contradiction: Option<String>,
}

/// A proof, and what the kernel makes of it.
#[derive(Debug)]
pub struct Proof {
    pub script: Script,
    pub theorem: Theorem,
}

/// Why a part is refuted.
#[derive(Debug)]
pub enum Evidence {
    /// The kernel checked this witness.
    Checked {
        witness: Witness,
        refutation: Box<Refutation>,
    },
    /// The exact series of both sides differ: until expansions have constants, this is not the
    /// kernel's word.
    Series {
        point: Point,
        claimed: String,
        found: String,
    },
}

impl Finding {
    /// A verdict and nothing else.
    pub fn plain(verdict: Verdict) -> Finding {
        Finding {
            verdict,
            extent: None,
            reason: None,
            witness: None,
            series: None,
            proof: None,
            contradiction: None,
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

/// The finding that decides a chain: a refuted link refutes it, else the worse verdict stands.
pub fn worse(a: Finding, b: Finding) -> Finding {
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
    // A refutation rests on its witness alone, not on the points at which other links hold.
    worst.extent = extent.filter(|_| worst.verdict != Verdict::Refuted);
    worst.series = series;
    worst
}
