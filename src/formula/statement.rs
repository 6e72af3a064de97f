//! Statements: what a claim says of its formulas.

use super::{Condition, Formula, Name, Relation};

/// What a claim states of its formulas.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Statement {
    /// `a == b < c`, judged link by link. A link whose right side holds an `O` or `o`, or whose
    /// relation is `~` or `=~`, is an expansion under the regime.
    Chain {
        first: Formula,
        links: Vec<(Relation, Formula)>,
        regime: Option<Regime>,
    },
    /// Statements joined by `and`.
    All(Vec<Statement>),
    /// `f(r) is EXPR`, for a symbol that nothing else fixes, with the duties that the text puts
    /// on it.
    Definition {
        name: Name,
        arguments: Vec<Name>,
        body: Formula,
        duties: Vec<Duty>,
    },
    /// `ID if COND`: the statement of another claim holds where the condition does.
    Conditional { id: Name, condition: Condition },
    /// `words`: a person reads it, nothing is computed.
    Words,
    /// `empty`: a number without an equation.
    Empty,
}

/// What a definition must satisfy; a failed duty refutes it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Duty {
    /// `density on a..b`: nowhere negative, integral 1.
    Density(Formula, Formula),
    /// `cdf on a..b`: from 0 to 1, never decreasing.
    Cumulative(Formula, Formula),
    /// `agrees ID`: equal to the symbol of the same name that claim ID defines.
    Agrees(Name),
}

/// Under which limit an expansion is meant: `as n -> inf then k -> inf uniformly in l`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct Regime {
    /// Limits in turn (`then`), each of one or more quantities tending jointly.
    pub limits: Vec<Vec<Tendency>>,
    /// Names that the constants must not depend on.
    pub uniformly: Vec<Name>,
    /// `along k = EXPR, v = EXPR`: substituted before the limit is taken.
    pub along: Vec<(Name, Formula)>,
}

/// `k -> inf`, `n/k -> inf`, `x -> 0+`
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tendency {
    pub quantity: Formula,
    pub target: Target,
}

/// Where a quantity tends.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// `inf`
    Infinity,
    /// `a`, from both sides.
    Point(Formula),
    /// `a+`, from above.
    Above(Formula),
    /// `a-`, from below.
    Below(Formula),
}
