//! What the names of a formula mean while it is evaluated, and the fuel that bounds the work.

use super::fraction::Fraction;
use super::interval::Interval;
use super::quantity::Quantity;
use super::{Unknown, unknown};
use crate::formula::{Draw, Formula, Name, Part, Point, Rational};
use std::cell::Cell;

/// Steps for one value: far more than any claim needs at a small point.
const FUEL: u64 = 20_000_000;

/// The meaning of names: bound names first, then draws, then the parameters of the point.
#[derive(Clone)]
pub(super) struct Scope<'a> {
    pub point: &'a Point,
    pub draws: &'a [Draw],
    pub bits: u64,
    /// A number of the piece of an integral at which comparisons of its variable are decided.
    pub sample: Option<Rational>,
    /// The draw that a mean around integrates over.
    drawn: Option<Name>,
    /// What bound names stand for; `None` where that may not be asked.
    bound: Vec<(Name, Option<Fraction>)>,
    fuel: &'a Cell<u64>,
}

/// The fuel for one value.
pub(super) fn full_tank() -> Cell<u64> {
    Cell::new(FUEL)
}

impl<'a> Scope<'a> {
    pub fn new(point: &'a Point, draws: &'a [Draw], bits: u64, fuel: &'a Cell<u64>) -> Scope<'a> {
        Scope {
            point,
            draws,
            bits,
            sample: None,
            drawn: None,
            bound: Vec::new(),
            fuel,
        }
    }

    /// A scope that knows one name, at a point without any other, and decides no comparison.
    pub fn closed<'b>(&'b self, nothing: &'b Point, name: &Name, value: Fraction) -> Scope<'b> {
        Scope::new(nothing, &[], self.bits, self.fuel).with(name, value)
    }

    /// This scope with one more name.
    pub fn with(&self, name: &Name, value: impl Into<Fraction>) -> Scope<'a> {
        let mut inner = self.clone();
        inner.bound.push((name.clone(), Some(value.into())));
        inner
    }

    /// This scope, where some names may not be used.
    pub fn without(&self, names: &[&Name]) -> Scope<'a> {
        let mut inner = self.clone();
        inner
            .bound
            .extend(names.iter().map(|&name| (name.clone(), None)));
        inner
    }

    /// This scope with the variable of an integral. What depends on the variable of an integral
    /// around is hidden: a fraction has one variable.
    pub fn with_variable(&self, name: &Name) -> Scope<'a> {
        let mut inner = self.clone();
        for (_, value) in &mut inner.bound {
            *value = value.take().filter(|value| value.as_number().is_some());
        }
        (inner.sample, inner.drawn) = (None, None);
        inner.with(name, Fraction::variable())
    }

    /// The same with a draw of the scope, which no name in it hides.
    pub fn with_draw(&self, name: &Name) -> Scope<'a> {
        let mut inner = self.with_variable(name);
        inner.bound.pop();
        inner.drawn = Some(name.clone());
        inner
    }

    /// This scope on the piece of an integral that a number is from.
    pub fn at(&self, sample: &Rational) -> Scope<'a> {
        let mut inner = self.clone();
        inner.sample = Some(sample.clone());
        inner
    }

    /// Takes steps from the store; every recursion and loop does, so that all of them end.
    pub fn spend(&self, steps: u64) -> Result<(), Unknown> {
        match self.fuel.get().checked_sub(steps) {
            Some(rest) => {
                self.fuel.set(rest);
                Ok(())
            }
            None => unknown("too much work for the kernel"),
        }
    }

    /// Takes the steps of an operation on two functions.
    pub fn spend_on(&self, a: &Fraction, b: &Fraction) -> Result<(), Unknown> {
        self.spend((a.numerator.length() * b.numerator.length()) as u64)
    }

    pub fn binds(&self, name: &Name) -> bool {
        self.bound.iter().any(|(bound, _)| bound == name)
    }

    pub fn draw(&self, name: &Name) -> Option<&'a Draw> {
        self.draws.iter().find(|draw| draw.name == *name)
    }

    /// What a name stands for.
    pub fn look_up(&self, name: &Name) -> Result<Quantity, Unknown> {
        match self.bound.iter().rev().find(|(bound, _)| bound == name) {
            Some((_, Some(value))) => return Ok(value.clone().into()),
            Some((_, None)) => return unknown("an integral of a function of two variables"),
            None => {}
        }
        match self.point.numbers.get(name) {
            _ if self.drawn.as_ref() == Some(name) => Ok(Fraction::variable().into()),
            _ if self.draw(name).is_some() => unknown("a draw outside of a mean"),
            Some(number) => Ok(Interval::exact(number.clone()).into()),
            None => Err(Unknown(format!("no number is given for {name}"))),
        }
    }

    /// Whether the value of a part may depend on a name. A mean over the scope's draws binds them,
    /// and reads their laws.
    pub fn occurs(&self, name: &Name, part: Part) -> bool {
        match part {
            Part::Formula(Formula::Name(other)) => return other == name,
            Part::Formula(
                Formula::Mean(_, None) | Formula::Variance(_, None) | Formula::Probability(_, None),
            ) if self.draw(name).is_some() => return false,
            Part::Formula(
                Formula::Mean(_, None)
                | Formula::Variance(_, None)
                | Formula::Probability(_, None)
                | Formula::Density(..)
                | Formula::Cumulative(..),
            ) if self
                .draws
                .iter()
                .any(|d| self.occurs(name, Part::Law(&d.law))) =>
            {
                return true;
            }
            _ => {}
        }
        let mut found = false;
        part.each(&mut |inner, bound| {
            found = found || (!bound.contains(&name) && self.occurs(name, inner));
        });
        found
    }
}
