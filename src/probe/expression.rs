//! What is asked of a photon: an expression over the model, seen as doubles for many photons at once
//! or as intervals of any precision for one.

use crate::algebra::{Monomial, Polynomial, RationalFunction, Symbol};
use crate::formula::{Budget, Formula, Function, Name, Operator, Part, free_names};
use rug::Rational;

/// A number of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Variable {
    /// k
    Photon,
    /// l
    Position,
    /// m
    Count,
    /// E_k - 1
    Excess,
    /// Var_k
    Variance,
}

/// The names of the language, and what they stand for. The volume of a shell is its number of photons, and
/// the volume inside is `k - l`.
const NAMES: [(&str, &str); 7] = [
    ("k", "k"),
    ("l", "l"),
    ("m", "m"),
    ("Va", "k - l"),
    ("V", "m"),
    ("E_k", "1 + e"),
    ("Var_k", "v"),
];

/// Symbols of the algebra, with the numbers they are.
const SYMBOLS: [(&str, Variable); 5] = [
    ("k", Variable::Photon),
    ("l", Variable::Position),
    ("m", Variable::Count),
    ("e", Variable::Excess),
    ("v", Variable::Variance),
];

/// An expression over the model.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expression {
    Number(Rational),
    Variable(Variable),
    Sum(Vec<Expression>),
    Product(Vec<Expression>),
    /// n >= 1
    Power(Box<Expression>, u32),
    Reciprocal(Box<Expression>),
    Call(Function, Vec<Expression>),
}

/// A kind of numbers in which expressions are valued. What may have no value is unknown, and so is all that is made of it.
pub(super) trait Arithmetic {
    type Value;
    fn number(&self, value: &Rational) -> Self::Value;
    fn variable(&self, variable: Variable) -> Self::Value;
    fn plus(&self, a: Self::Value, b: Self::Value) -> Self::Value;
    fn times(&self, a: Self::Value, b: Self::Value) -> Self::Value;
    fn power(&self, a: Self::Value, n: u32) -> Self::Value;
    fn reciprocal(&self, a: Self::Value) -> Self::Value;
    fn call(&self, function: Function, arguments: Vec<Self::Value>) -> Self::Value;
}

/// Why a formula cannot be asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotAsked {
    /// A name that the model has not.
    #[error("`{0}` is no number of the model")]
    UnknownName(Name),
    /// No arithmetic for it here.
    #[error("cannot probe {0}")]
    Unsupported(String),
}

impl Expression {
    /// An expression that has the formula's value wherever it has one. Where it is made of field operations only, it is
    /// put into lowest terms over `E_k - 1`, so that `E_k - 1 - 1/k^2` does not pass through `1 + (E_k - 1)`.
    pub(super) fn new(formula: &Formula) -> Result<Expression, NotAsked> {
        if let Some(name) = free_names(formula)
            .into_iter()
            .find(|name| !NAMES.iter().any(|(known, _)| **known == **name))
        {
            return Err(NotAsked::UnknownName(name));
        }
        match rational(formula).as_ref().and_then(Expression::of_function) {
            Some(expression) => Ok(expression),
            None => Expression::of_formula(formula),
        }
    }

    /// `None` where there are other symbols, such as pi.
    fn of_function(function: &RationalFunction) -> Option<Expression> {
        let mut factors = vec![Expression::of_polynomial(function.numerator())?];
        for (atom, exponent) in function.denominator() {
            let below = Expression::Reciprocal(Box::new(Expression::of_polynomial(atom)?));
            factors.push(raised(below, *exponent));
        }
        Some(one_or(Expression::Product, factors))
    }

    fn of_polynomial(polynomial: &Polynomial) -> Option<Expression> {
        let term = |(monomial, coefficient): (&Monomial, &Rational)| {
            let mut factors = vec![];
            if *coefficient != 1 || monomial.is_one() {
                factors.push(Expression::Number(coefficient.clone()));
            }
            for (symbol, exponent) in monomial.powers() {
                let (_, variable) = SYMBOLS.iter().find(|(name, _)| **name == **symbol)?;
                factors.push(raised(Expression::Variable(*variable), *exponent));
            }
            Some(one_or(Expression::Product, factors))
        };
        let terms: Vec<Expression> = polynomial.terms().map(term).collect::<Option<_>>()?;
        Some(match terms.is_empty() {
            true => Expression::Number(Rational::new()),
            false => one_or(Expression::Sum, terms),
        })
    }

    fn of_formula(formula: &Formula) -> Result<Expression, NotAsked> {
        let inner = |formula: &Formula| Expression::new(formula);
        Ok(match formula {
            Formula::Negate(a) => minus(inner(a)?),
            Formula::Binary(Operator::Add, a, b) => Expression::Sum(vec![inner(a)?, inner(b)?]),
            Formula::Binary(Operator::Subtract, a, b) => {
                Expression::Sum(vec![inner(a)?, minus(inner(b)?)])
            }
            Formula::Binary(Operator::Multiply, a, b) => {
                Expression::Product(vec![inner(a)?, inner(b)?])
            }
            Formula::Binary(Operator::Divide, a, b) => {
                let below = inner(b)?;
                if below == Expression::Number(Rational::new()) {
                    return Err(NotAsked::Unsupported(format!(
                        "the division by 0 in `{formula}`"
                    )));
                }
                Expression::Product(vec![inner(a)?, Expression::Reciprocal(Box::new(below))])
            }
            Formula::Binary(Operator::Power, a, n) => power(inner(a)?, n)?,
            Formula::Call(
                function @ (Function::Abs
                | Function::Sqrt
                | Function::Ln
                | Function::Exp
                | Function::Min
                | Function::Max),
                parts,
            ) => Expression::Call(
                *function,
                parts.iter().map(inner).collect::<Result<_, _>>()?,
            ),
            other => return Err(NotAsked::Unsupported(format!("`{other}`"))),
        })
    }

    /// Whether the expression may be 0: it is no power product of k, l and m.
    fn may_vanish(&self) -> bool {
        match self {
            Expression::Number(value) => *value == 0,
            Expression::Variable(Variable::Photon | Variable::Position | Variable::Count) => false,
            Expression::Product(parts) => parts.iter().any(Expression::may_vanish),
            Expression::Power(a, _) => a.may_vanish(),
            _ => true,
        }
    }

    /// Whether the expression depends on E_k, or on Var_k.
    pub(super) fn needs(&self, wanted: Variable) -> bool {
        match self {
            Expression::Number(_) => false,
            Expression::Variable(variable) => *variable == wanted,
            Expression::Sum(parts) | Expression::Product(parts) | Expression::Call(_, parts) => {
                parts.iter().any(|part| part.needs(wanted))
            }
            Expression::Power(a, _) | Expression::Reciprocal(a) => a.needs(wanted),
        }
    }

    /// The value in an arithmetic.
    pub(super) fn value<A: Arithmetic>(&self, numbers: &A) -> A::Value {
        let all = |parts: &[Expression], f: fn(&A, A::Value, A::Value) -> A::Value| {
            let values = parts.iter().map(|part| part.value(numbers));
            values.reduce(|a, b| f(numbers, a, b))
        };
        match self {
            Expression::Number(value) => numbers.number(value),
            Expression::Variable(variable) => numbers.variable(*variable),
            Expression::Sum(parts) => {
                all(parts, A::plus).unwrap_or_else(|| numbers.number(&Rational::new()))
            }
            Expression::Product(parts) => {
                all(parts, A::times).unwrap_or_else(|| numbers.number(&Rational::from(1)))
            }
            Expression::Power(a, n) => numbers.power(a.value(numbers), *n),
            Expression::Reciprocal(a) => numbers.reciprocal(a.value(numbers)),
            Expression::Call(function, parts) => {
                let values = parts.iter().map(|part| part.value(numbers)).collect();
                numbers.call(*function, values)
            }
        }
    }
}

/// The formula over the symbols of the algebra, where it is made of field operations.
fn rational(formula: &Formula) -> Option<RationalFunction> {
    let budget = Budget::new(100_000);
    let function = RationalFunction::from_formula(formula, &budget).ok()??;
    // Names and symbols share letters, but no name is the symbol of another's meaning: all at once.
    let meanings = NAMES.map(|(name, meaning)| {
        let meaning = crate::formula::parse_formula(meaning).ok()?;
        let meaning = RationalFunction::from_formula(&meaning, &budget).ok()??;
        Some((Symbol::from(name), meaning))
    });
    meanings.into_iter().try_fold(function, |function, pair| {
        let (name, meaning) = pair?;
        function.substitute(&name, &meaning, &budget).ok()
    })
}

/// A formula as it is asked of photons. It has a value where no divisor is 0 and what it names is finite, whatever
/// cancels.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) value: Expression,
    /// Whatever the formula divides by that may be 0.
    pub(super) divisors: Vec<Expression>,
    /// Whether it names E_k, or Var_k.
    pub(super) names_excess: bool,
    pub(super) names_variance: bool,
}

impl Term {
    pub(super) fn new(formula: &Formula) -> Result<Term, NotAsked> {
        let value = Expression::new(formula)?;
        let mut divisors = vec![];
        collect_divisors(formula, &mut divisors)?;
        let names = free_names(formula);
        let has = |name: &str| names.iter().any(|other| **other == *name);
        Ok(Term {
            value,
            divisors,
            names_excess: has("E_k"),
            names_variance: has("Var_k"),
        })
    }
}

fn collect_divisors(formula: &Formula, found: &mut Vec<Expression>) -> Result<(), NotAsked> {
    let divisor = match formula {
        Formula::Binary(Operator::Divide, _, b) => Some(b),
        Formula::Binary(Operator::Power, a, n) => {
            let exponent = rational(n).and_then(|n| n.as_constant());
            exponent.is_none_or(|n| n < 0).then_some(a)
        }
        _ => None,
    };
    if let Some(divisor) = divisor {
        let expression = Expression::new(divisor)?;
        if expression.may_vanish() {
            found.push(expression);
        }
    }
    let mut result = Ok(());
    Part::Formula(formula).each(&mut |part, _| {
        if let (Part::Formula(inner), Ok(())) = (part, &result) {
            result = collect_divisors(inner, found);
        }
    });
    result
}

fn minus(a: Expression) -> Expression {
    Expression::Product(vec![Expression::Number(Rational::from(-1)), a])
}

/// a^n for an integer or half an odd integer n.
fn power(a: Expression, exponent: &Formula) -> Result<Expression, NotAsked> {
    let refused = || NotAsked::Unsupported(format!("the exponent `{exponent}`"));
    let function = rational(exponent).ok_or_else(refused)?;
    let value = function.as_constant().ok_or_else(refused)?;
    let (top, half) = match value.denom().to_u32() {
        Some(1) => (value.numer().to_i32(), false),
        Some(2) => (value.numer().to_i32(), true),
        _ => (None, false),
    };
    let top = top.ok_or_else(refused)?;
    let base = match half {
        true => Expression::Call(Function::Sqrt, vec![a]),
        false => a,
    };
    Ok(match top {
        // 1, but only where a has a value.
        0 => return Err(refused()),
        n if n > 0 => raised(base, n.unsigned_abs()),
        n => Expression::Reciprocal(Box::new(raised(base, n.unsigned_abs()))),
    })
}

fn raised(a: Expression, n: u32) -> Expression {
    match n {
        1 => a,
        _ => Expression::Power(Box::new(a), n),
    }
}

fn one_or(make: fn(Vec<Expression>) -> Expression, mut parts: Vec<Expression>) -> Expression {
    match (parts.len(), parts.pop()) {
        (1, Some(only)) => only,
        (_, last) => {
            parts.extend(last);
            make(parts)
        }
    }
}
