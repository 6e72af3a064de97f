//! What the names of a formula mean while it is evaluated, and the fuel that bounds the work.

use super::interval::Interval;
use super::{Unknown, unknown};
use crate::formula::{Draw, Formula, Name, Part, Point};
use std::cell::Cell;

/// Steps for one value: far more than any claim needs at a small point.
const FUEL: u64 = 20_000_000;

/// What a bound name stands for.
#[derive(Clone, Debug)]
pub(super) enum Binding {
    Number(Interval),
    /// The variable of an integral around.
    Variable,
}

/// The meaning of names: bound names first, then draws, then the parameters of the point.
#[derive(Clone)]
pub(super) struct Scope<'a> {
    pub point: &'a Point,
    pub draws: &'a [Draw],
    pub bits: u64,
    bound: Vec<(Name, Binding)>,
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
            bound: Vec::new(),
            fuel,
        }
    }

    /// A scope without draws and bound names, at another point: for what may use neither.
    pub fn closed<'b>(&'b self, point: &'b Point) -> Scope<'b> {
        Scope::new(point, &[], self.bits, self.fuel)
    }

    /// This scope with one more name.
    pub fn with(&self, name: &Name, binding: Binding) -> Scope<'a> {
        let mut inner = self.clone();
        inner.bound.push((name.clone(), binding));
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

    pub fn binds(&self, name: &Name) -> bool {
        self.bound.iter().any(|(bound, _)| bound == name)
    }

    pub fn is_draw(&self, name: &Name) -> bool {
        self.draws.iter().any(|draw| draw.name == *name)
    }

    /// The number that a name stands for.
    pub fn number(&self, name: &Name) -> Result<Interval, Unknown> {
        match self.bound.iter().rev().find(|(bound, _)| bound == name) {
            Some((_, Binding::Number(number))) => return Ok(number.clone()),
            Some((_, Binding::Variable)) => {
                return unknown("an integral's variable where a number is needed");
            }
            None => {}
        }
        if self.is_draw(name) {
            return unknown("a draw outside of a mean");
        }
        match self.point.numbers.get(name) {
            Some(number) => Ok(Interval::exact(number.clone())),
            None => Err(Unknown(format!("no number is given for {name}"))),
        }
    }

    /// Whether the value of a formula may depend on what the name stands for. A mean over the
    /// scope's draws binds them, and reads their laws.
    pub fn depends(&self, formula: &Formula, name: &Name) -> bool {
        self.part_depends(Part::Formula(formula), name)
    }

    fn part_depends(&self, part: Part, name: &Name) -> bool {
        if let Part::Formula(formula) = part {
            match formula {
                Formula::Name(other) => return other == name,
                // A derivative is taken where its variable stands.
                Formula::Derivative(_, x, _) | Formula::Antiderivative(_, x) if x == name => {
                    return true;
                }
                Formula::Mean(_, None)
                | Formula::Variance(_, None)
                | Formula::Probability(_, None)
                    if self.is_draw(name) =>
                {
                    return self.laws_depend(name);
                }
                Formula::Density(_, place) | Formula::Cumulative(_, place)
                    if self.is_draw(name) =>
                {
                    return self.depends(place, name) || self.laws_depend(name);
                }
                Formula::Mean(_, None)
                | Formula::Variance(_, None)
                | Formula::Probability(_, None)
                | Formula::Density(..)
                | Formula::Cumulative(..)
                    if self.laws_depend(name) =>
                {
                    return true;
                }
                _ => {}
            }
        }
        let mut found = false;
        part.each(&mut |inner, bound| {
            found = found || (!bound.contains(&name) && self.part_depends(inner, name));
        });
        found
    }

    /// Whether the law of some draw of the scope depends on the name.
    pub fn laws_depend(&self, name: &Name) -> bool {
        let depends = |draw: &Draw| self.part_depends(Part::Law(&draw.law), name);
        self.draws.iter().any(depends)
    }
}
