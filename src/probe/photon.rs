//! One photon, to any precision.

use super::expression::{Arithmetic, Expression, Term, Variable};
use crate::formula::Function;
use crate::model::Shell;
use crate::number::{DomainError, Interval};
use crate::special::shell::{Quantity, ShellError, enclose_all};
use rug::Rational;

/// Digits of the first attempt; twice as many each time.
const FIRST_DIGITS: u32 = 30;

/// No more digits than about this.
const MOST_DIGITS: u32 = 2000;

/// A photon's numbers.
struct Photon<'a> {
    shell: &'a Shell,
    excess: Option<Interval>,
    variance: Option<Interval>,
    bits: u32,
}

/// What a term is at a photon.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Found {
    Value(Interval),
    /// E_k or Var_k is named and infinite.
    Infinite,
    /// No precision that was tried tells a value; there may be none.
    Unknown,
}

/// The term at photon l of a shell with a relative width below `10^-digits`, or else the narrowest enclosure found.
pub(super) fn value(term: &Term, shell: &Shell, digits: u32) -> Found {
    found(term, shell, |value| value.agrees_to(digits))
}

/// The term at a photon so narrow that it has a sign, if it gets one.
pub(super) fn signed(term: &Term, shell: &Shell) -> Found {
    found(term, shell, |value| value.sign().is_some())
}

fn found(term: &Term, shell: &Shell, enough: impl Fn(&Interval) -> bool) -> Found {
    let infinite = |named, quantity| {
        let none = Err(ShellError::Domain(DomainError::Certain));
        named && enclose_all([quantity], shell, FIRST_DIGITS) == none
    };
    if infinite(term.names_excess, Quantity::Excess)
        || infinite(term.names_variance, Quantity::Variance)
    {
        return Found::Infinite;
    }
    let apart = |value: &Interval| value.sign().is_some_and(|sign| sign.is_ne());
    let divided = term
        .divisors
        .iter()
        .all(|divisor| climb(divisor, shell, apart).is_some_and(|value| apart(&value)));
    match climb(&term.value, shell, enough).filter(|_| divided) {
        Some(value) => Found::Value(value),
        None => Found::Unknown,
    }
}

/// The narrowest enclosure found, with more and more digits until it is narrow enough.
fn climb(
    expression: &Expression,
    shell: &Shell,
    enough: impl Fn(&Interval) -> bool,
) -> Option<Interval> {
    let mut best: Option<Interval> = None;
    let mut digits = FIRST_DIGITS;
    while digits <= MOST_DIGITS {
        if let Some(next) = expression.value(&Photon::new(expression, shell, digits)) {
            let value = best
                .and_then(|best| best.intersection(&next))
                .unwrap_or(next);
            if enough(&value) {
                return Some(value);
            }
            best = Some(value);
        }
        digits *= 2;
    }
    best
}

impl Photon<'_> {
    fn new<'a>(expression: &Expression, shell: &'a Shell, digits: u32) -> Photon<'a> {
        let of = |quantity, variable| {
            let needed = expression.needs(variable);
            let [value] = needed
                .then(|| enclose_all([quantity], shell, digits).ok())
                .flatten()?;
            Some(value)
        };
        Photon {
            shell,
            excess: of(Quantity::Excess, Variable::Excess),
            variance: of(Quantity::Variance, Variable::Variance),
            bits: digits * 10 / 3 + 64,
        }
    }
}

impl Arithmetic for Photon<'_> {
    type Value = Option<Interval>;

    fn number(&self, value: &Rational) -> Option<Interval> {
        Some(Interval::from_rational(value, self.bits))
    }

    fn variable(&self, variable: Variable) -> Option<Interval> {
        let integer = |value| Some(Interval::from_integer(value, self.bits));
        match variable {
            Variable::Photon => {
                self.number(&Rational::from(&self.shell.inner + &self.shell.position))
            }
            Variable::Position => integer(&self.shell.position),
            Variable::Count => integer(&self.shell.count),
            Variable::Excess => self.excess.clone(),
            Variable::Variance => self.variance.clone(),
        }
    }

    fn plus(&self, a: Option<Interval>, b: Option<Interval>) -> Option<Interval> {
        Some(a?.add(&b?))
    }

    fn times(&self, a: Option<Interval>, b: Option<Interval>) -> Option<Interval> {
        Some(a?.mul(&b?))
    }

    fn power(&self, a: Option<Interval>, n: u32) -> Option<Interval> {
        a?.powi(n.into()).ok()
    }

    fn reciprocal(&self, a: Option<Interval>) -> Option<Interval> {
        Interval::from_i64(1, self.bits).div(&a?).ok()
    }

    fn call(&self, function: Function, arguments: Vec<Option<Interval>>) -> Option<Interval> {
        let all: Vec<Interval> = arguments.into_iter().collect::<Option<_>>()?;
        let first = all.first()?;
        match function {
            Function::Abs => Some(first.abs()),
            Function::Sqrt => first.sqrt().ok(),
            Function::Ln => first.ln().ok(),
            Function::Exp => Some(first.exp()),
            Function::Min => all.iter().cloned().reduce(|a, b| a.min(&b)),
            Function::Max => all.iter().cloned().reduce(|a, b| a.max(&b)),
            _ => None,
        }
    }
}
