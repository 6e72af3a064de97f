//! A claim with its definitions unfolded: the text that the kernel reads and a certificate opens with.

use super::{Condition, Formula, Name, Rational, Statement};
use std::collections::BTreeMap;

/// A statement in full: typed parameters, their domain, the laws of its draws. Nothing in it is
/// short for anything else, so two propositions are the same claim exactly when the trees are equal.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Proposition {
    pub parameters: Vec<Parameter>,
    /// All of them hold on the domain. `needs`, where it applies, is the last.
    pub domain: Vec<Condition>,
    /// Independent draws.
    pub draws: Vec<Draw>,
    pub statement: Statement,
}

/// A symbol that the statement is quantified over.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Parameter {
    pub name: Name,
    pub kind: ParameterKind,
}

/// The type of a parameter.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ParameterKind {
    Integer,
    Real,
    /// `fn f(x) continuous on a..b`: any such function.
    Function {
        argument: Name,
        kind: FunctionKind,
        from: Formula,
        to: Formula,
    },
}

/// What is known of a function parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FunctionKind {
    Continuous,
    Integrable,
    /// n times continuously differentiable.
    Smooth(u32),
    Polynomial,
    /// Nonnegative and continuous, with integral 1.
    Density,
}

/// `draw name ~ law`
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Draw {
    pub name: Name,
    pub law: Law,
}

/// The law of a draw.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Law {
    /// `beta(a, b)`, a > 0 and b > 0, on [0, 1].
    Beta(Formula, Formula),
    /// `uniform(a, b)`, a < b.
    Uniform(Formula, Formula),
    /// `order(l, m) of LAW`: the l-th smallest of m independent draws.
    Order(Formula, Formula, Box<Law>),
    /// `density f on a..b`: the density is `f` (a function of the scope) between a and b. Unfolding
    /// turns a defined `f` into its body, a formula in `argument`.
    Density {
        argument: Name,
        body: Formula,
        from: Formula,
        to: Formula,
    },
    /// `any`: some law for which all means that occur are finite.
    Any,
}

/// Values for the parameters of a proposition. A function parameter is a polynomial, given as a
/// formula in its argument's name.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Point {
    pub numbers: BTreeMap<Name, Rational>,
    pub functions: BTreeMap<Name, (Name, Formula)>,
}
