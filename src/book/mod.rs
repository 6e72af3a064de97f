//! Markdown chapters to claims, definitions unfolded.
//!
//! A book is a folder of Markdown files. The CommonMark library finds the fenced blocks; the language
//! inside a `claim` or `define` fence is ours. [`read`] gives every claim with the place it stands at;
//! [`Claim::printed`] and [`Claim::mended`] unfold it to the proposition that is judged.
#![forbid(unsafe_code)]

mod expect;
mod files;
mod line;
mod markdown;
mod read;
mod resolve;
mod scope;
mod typing;
mod unfold;

pub use read::{FileError, read, read_text};
pub use unfold::{IllTyped, has_expansion};

use crate::formula::{Condition, Draw, Formula, Name, Parameter, Regime, Statement};
pub use scope::Places;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::path::PathBuf;

/// All claims of some chapters, in the order of files and lines.
#[derive(Debug, Default)]
pub struct Book {
    pub claims: Vec<Claim>,
}

impl Book {
    /// The claims by their ids.
    pub fn by_id(&self) -> HashMap<&str, &Claim> {
        self.claims
            .iter()
            .map(|claim| (&*claim.id, claim))
            .collect()
    }
}

/// One `claim` block.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    pub id: Name,
    pub file: PathBuf,
    /// The line of the fence, from 1.
    pub line: usize,
    pub scope: Scope,
    /// The statement as printed.
    pub says: Statement,
    /// The text of `says` as written, on one line.
    pub says_text: String,
    /// The right statement, where the print is wrong.
    pub mend: Option<Statement>,
    pub mend_text: Option<String>,
    pub needs: Option<Needs>,
    /// The claim whose right side this line goes on from.
    pub after: Option<Name>,
    /// `read REGIME`: takes the place of the statement's own regime. Where it names no limit, those of
    /// the statement stay.
    pub read: Option<Regime>,
    /// Where in the paper it stands: `22`, `iv`, `22-23`.
    pub page: Option<String>,
    /// The words of the text that the claim judges.
    pub quote: Option<String>,
    pub slip: Option<String>,
    /// What the copy at hand leaves open; it was read in the paper's favour.
    pub scan: Option<String>,
    /// The claim that has the same mistake.
    pub like: Option<Name>,
    pub why: Option<String>,
    pub expect: Option<Expectation>,
    /// The text of the `expect` line as written.
    pub expect_text: Option<String>,
    /// Where the symbols of the statements stand, for messages.
    pub places: Places,
}

/// The symbols of a claim, in the order in which they are declared; a name is declared before it is used.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Scope {
    pub parameters: Vec<Parameter>,
    pub domain: Vec<Condition>,
    pub definitions: Vec<Definition>,
    pub draws: Vec<Draw>,
}

/// `let NAME = EXPR` or `let F(r) = EXPR`
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    pub name: Name,
    pub arguments: Vec<Name>,
    pub body: Formula,
}

/// What the print leaves out.
#[derive(Clone, Debug, PartialEq)]
pub struct Needs {
    pub condition: Condition,
    pub text: String,
    /// `sufficient`: points that the condition shuts out may satisfy the statement.
    pub sufficient: bool,
}

/// `expect printed refuted domain, mended proved`
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expectation {
    pub printed: Option<ExpectedVerdict>,
    pub mended: Option<ExpectedVerdict>,
}

/// A verdict as `expect` names it, the least that will do: `proved` meets `certified`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExpectedVerdict {
    Proved,
    Certified,
    /// `refuted`, `refuted statement`, `refuted domain`
    Refuted(Option<Fault>),
    Undecided,
    Vacuous,
    IllTyped,
    Defined,
    Noted,
}

/// Where a refuted statement is at fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Fault {
    /// The same statement holds under `needs`: a condition is missing.
    Domain,
    /// The statement itself is wrong.
    Statement,
}
