//! The bottom floor: formulas, conditions, laws and statements as syntax trees, and the text they
//! are written in.
//!
//! One tree serves every evaluator (exact, interval, f64, series, kernel) and every printer. A tree
//! knows nothing of values: it says what was written, binary operators as they associate in the
//! text, so that printing a parsed formula and parsing it again gives the same tree.
//!
//! The numbers of this floor are `num-rational`'s, so that the kernel, which imports this floor
//! only, needs no C library.
#![forbid(unsafe_code)]

pub mod budget;
pub mod error;
mod lexer;
mod names;
pub(crate) mod parser;
mod print;
mod proposition;
mod statement;
mod substitute;

pub use budget::Budget;
pub use error::{Diagnostic, Span};
pub use names::{Part, free_functions, free_names, is_over_draws, nearest};
pub use parser::{
    MAX_DEPTH, MAX_DIGITS, MAX_NESTING, is_reserved, parse_condition, parse_formula, parse_law,
    parse_proposition, parse_statement,
};
pub use proposition::{Draw, FunctionKind, Law, Parameter, ParameterKind, Point, Proposition};
pub use statement::{Duty, Regime, Statement, Target, Tendency};
pub use substitute::{MAX_NODES, Substitution, TooLarge, substitute};

use std::sync::Arc;

/// An exact rational number of arbitrary size.
pub type Rational = num_rational::BigRational;

/// The name of a parameter, draw, definition or bound variable.
pub type Name = Arc<str>;

/// A syntax tree of a real-valued formula.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Formula {
    /// An integer or decimal as written: `0.05` is the rational 1/20. Never negative from the
    /// parser (a sign is [`Formula::Negate`]), but substitution may put a negative value here.
    Number(Rational),
    /// `pi`
    Pi,
    /// `inf`, meaningful as a bound and as the place of a limit only.
    Infinity,
    /// A parameter, draw, definition or bound variable.
    Name(Name),
    /// `f(x)` for a function that the scope declares (`fn`) or defines (`let`).
    Apply(Name, Vec<Formula>),
    /// `-a`
    Negate(Box<Formula>),
    /// `a + b`, `a - b`, `a * b`, `a / b`, `a ^ b`
    Binary(Operator, Box<Formula>, Box<Formula>),
    /// `a!`
    Factorial(Box<Formula>),
    /// A function that the language knows.
    Call(Function, Vec<Formula>),
    /// `sum(e, j = a..b)`, `int(e, x = a..b)`, `sup(e, k = a..b)`, `infimum(e, k = a..b)`
    Ranged(Box<Ranged>),
    /// `int(e, x)`: an antiderivative, equal up to a constant in `x`.
    Antiderivative(Box<Formula>, Name),
    /// `diff(e, x, n)`; `diff(e, x)` has order 1.
    Derivative(Box<Formula>, Name, Box<Formula>),
    /// `at(e, x = a, y = b)`
    At(Box<Formula>, Vec<(Name, Formula)>),
    /// `lim(e, x -> a, y -> b)`
    Limit(Box<Formula>, Vec<(Name, Formula)>),
    /// `[COND]`: 1 where the condition holds, else 0.
    Indicator(Box<Condition>),
    /// `if(COND, a, b)`
    If(Box<Condition>, Box<Formula>, Box<Formula>),
    /// `mean(e)` over the draws of the scope, or `mean(e, x ~ LAW)` over a draw of its own.
    Mean(Box<Formula>, Option<Box<Draw>>),
    /// `var(e)`, `var(e, x ~ LAW)`
    Variance(Box<Formula>, Option<Box<Draw>>),
    /// `prob(COND)`, `prob(COND, x ~ LAW)`
    Probability(Box<Condition>, Option<Box<Draw>>),
    /// `density(X, x)`: the density of the random quantity `X` at `x`.
    Density(Box<Formula>, Box<Formula>),
    /// `cdf(X, x)`: the probability that `X <= x`.
    Cumulative(Box<Formula>, Box<Formula>),
    /// `O(g)`, on the right of an expansion only.
    BigO(Box<Formula>),
    /// `o(g)`, on the right of an expansion only.
    LittleO(Box<Formula>),
    /// A condition in the place of a number. It parses, so that the judge can call it ill-typed.
    Truth(Box<Condition>),
}

/// `sum`, `int`, `sup` or `infimum` of `body` for `name` from `from` to `to`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Ranged {
    pub kind: RangeKind,
    pub body: Formula,
    pub name: Name,
    pub from: Formula,
    pub to: Formula,
}

/// What a [`Ranged`] formula does over its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RangeKind {
    Sum,
    Integral,
    Supremum,
    Infimum,
}

/// A binary arithmetic operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

/// A function that the language knows, with the names of DLMF.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    Abs,
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    /// Euler's Gamma function, DLMF 5.2.1.
    Gamma,
    /// ln |Gamma(x)|; `lngamma` has a value for x > 0 only.
    LnGamma,
    /// Euler's Beta function, DLMF 5.12.1.
    Beta,
    /// `binomial(n, k)` for real n and integer k >= 0 is (n-k+1)_k / k!; 0 for integers k < 0.
    Binomial,
    /// `pochhammer(a, n)` = a (a+1) ... (a+n-1), DLMF 5.2.4.
    Pochhammer,
    /// `hyp2f1(a, b; c; z)`, DLMF 15.2.1.
    Hyp2F1,
    /// `hyp2f1r(a, b; c; z)` = `hyp2f1(a, b; c; z)/gamma(c)`, DLMF 15.2.2.
    Hyp2F1Regularized,
    Min,
    Max,
    Floor,
}

impl Function {
    /// Every function, in the order of the documentation.
    pub const ALL: [Function; 16] = [
        Function::Abs,
        Function::Sqrt,
        Function::Exp,
        Function::Ln,
        Function::Sin,
        Function::Cos,
        Function::Gamma,
        Function::LnGamma,
        Function::Beta,
        Function::Binomial,
        Function::Pochhammer,
        Function::Hyp2F1,
        Function::Hyp2F1Regularized,
        Function::Min,
        Function::Max,
        Function::Floor,
    ];

    /// The name in the claim language.
    pub fn name(self) -> &'static str {
        match self {
            Function::Abs => "abs",
            Function::Sqrt => "sqrt",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Gamma => "gamma",
            Function::LnGamma => "lngamma",
            Function::Beta => "beta",
            Function::Binomial => "binomial",
            Function::Pochhammer => "pochhammer",
            Function::Hyp2F1 => "hyp2f1",
            Function::Hyp2F1Regularized => "hyp2f1r",
            Function::Min => "min",
            Function::Max => "max",
            Function::Floor => "floor",
        }
    }

    /// How many arguments the function takes; `min` and `max` take two or more.
    pub fn arity(self) -> usize {
        match self {
            Function::Beta | Function::Binomial | Function::Pochhammer => 2,
            Function::Min | Function::Max => 2,
            Function::Hyp2F1 | Function::Hyp2F1Regularized => 4,
            _ => 1,
        }
    }
}

/// A condition on numbers, made of relations, chains, `and`, `or` and `not`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Condition {
    /// `a < b <= c`: every link holds.
    Chain(Formula, Vec<(Relation, Formula)>),
    And(Vec<Condition>),
    Or(Vec<Condition>),
    Not(Box<Condition>),
}

/// A relation between two formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// `==`
    Equal,
    /// `!=`
    NotEqual,
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
    /// `L ~ R`: the quotient tends to 1. In statements only.
    Asymptotic,
    /// `L =~ R`: `L - R` is o of the last term of `R`. In statements only.
    Approximate,
}

impl Formula {
    /// An integer.
    pub fn integer(value: i64) -> Formula {
        Formula::Number(Rational::from_integer(value.into()))
    }

    /// A name.
    pub fn name(name: &str) -> Formula {
        Formula::Name(name.into())
    }

    /// `left OPERATOR right`
    pub fn binary(operator: Operator, left: Formula, right: Formula) -> Formula {
        Formula::Binary(operator, Box::new(left), Box::new(right))
    }
}
