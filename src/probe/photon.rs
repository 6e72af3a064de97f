//! One photon, to any precision.

use super::expression::{Arithmetic, Expression, Variable};
use crate::formula::Function;
use crate::model::Shell;
use crate::number::{DomainError, Interval};
use crate::special::shell::{Quantity, ShellError, enclose_all};
use rug::{Integer, Rational};

/// Digits of the first attempt; twice as many each time.
const FIRST_DIGITS: u32 = 30;

/// No more digits than about this.
const MOST_DIGITS: u32 = 2000;

/// A photon's numbers.
struct Photon<'a> {
    shell: &'a Shell,
    excess: Interval,
    variance: Interval,
    bits: u32,
}

/// The expression at photon l of a shell with a relative width below `10^-digits`, or else the narrowest enclosure found;
/// `None` where E_k or Var_k is needed and infinite.
pub(super) fn value(expression: &Expression, shell: &Shell, digits: u32) -> Option<Interval> {
    climb(expression, shell, |value| value.agrees_to(digits))
}

/// The expression at a photon so narrow that it has a sign, if it gets one.
pub(super) fn signed(expression: &Expression, shell: &Shell) -> Option<Interval> {
    climb(expression, shell, |value| value.sign().is_some())
}

fn climb(
    expression: &Expression,
    shell: &Shell,
    enough: impl Fn(&Interval) -> bool,
) -> Option<Interval> {
    let mut best: Option<Interval> = None;
    let mut digits = FIRST_DIGITS;
    while digits <= MOST_DIGITS {
        let photon = Photon::new(expression, shell, digits)?;
        let next = expression.value(&photon);
        let value = best
            .and_then(|best| best.intersection(&next))
            .unwrap_or(next);
        if enough(&value) {
            return Some(value);
        }
        best = Some(value);
        digits *= 2;
    }
    best
}

impl Photon<'_> {
    fn new<'a>(expression: &Expression, shell: &'a Shell, digits: u32) -> Option<Photon<'a>> {
        let bits = digits * 10 / 3 + 64;
        let of = |quantity, variable| {
            if !expression.needs(variable) {
                return Some(Interval::whole_line(bits));
            }
            match enclose_all([quantity], shell, digits + 10) {
                Ok([value]) => Some(value),
                Err(ShellError::Domain(DomainError::Certain)) => None,
                Err(_) => Some(Interval::whole_line(bits)),
            }
        };
        Some(Photon {
            shell,
            excess: of(Quantity::Excess, Variable::Excess)?,
            variance: of(Quantity::Variance, Variable::Variance)?,
            bits,
        })
    }

    fn integer(&self, value: &Integer) -> Interval {
        Interval::from_integer(value, self.bits)
    }

    fn or_line(&self, value: Result<Interval, DomainError>) -> Interval {
        value.unwrap_or_else(|_| Interval::whole_line(self.bits))
    }
}

impl Arithmetic for Photon<'_> {
    type Value = Interval;

    fn number(&self, value: &Rational) -> Interval {
        Interval::from_rational(value, self.bits)
    }

    fn variable(&self, variable: Variable) -> Interval {
        match variable {
            Variable::Photon => {
                let k = Rational::from(&self.shell.inner + &self.shell.position);
                self.number(&k)
            }
            Variable::Position => self.integer(&self.shell.position),
            Variable::Count => self.integer(&self.shell.count),
            Variable::Excess => self.excess.clone(),
            Variable::Variance => self.variance.clone(),
        }
    }

    fn plus(&self, a: Interval, b: Interval) -> Interval {
        a.add(&b)
    }

    fn times(&self, a: Interval, b: Interval) -> Interval {
        a.mul(&b)
    }

    fn power(&self, a: Interval, n: u32) -> Interval {
        self.or_line(a.powi(n.into()))
    }

    fn reciprocal(&self, a: Interval) -> Interval {
        self.or_line(Interval::from_i64(1, self.bits).div(&a))
    }

    fn call(&self, function: Function, mut arguments: Vec<Interval>) -> Interval {
        let line = Interval::whole_line(self.bits);
        let Some(last) = arguments.pop() else {
            return line;
        };
        let all = arguments.iter();
        match function {
            Function::Abs => last.abs(),
            Function::Sqrt => self.or_line(last.sqrt()),
            Function::Ln => self.or_line(last.ln()),
            Function::Exp => last.exp(),
            Function::Min => all.fold(last, |a, b| a.min(b)),
            Function::Max => all.fold(last, |a, b| a.max(b)),
            _ => line,
        }
    }
}
