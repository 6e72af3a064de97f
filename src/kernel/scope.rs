//! What the names of a formula mean while it is evaluated, and the fuel that bounds the work.

use super::interval::Interval;
use super::{Unknown, unknown};
use crate::formula::{Condition, Draw, Formula, Law, Name, Point};
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
        let on = |part: &Formula| self.depends(part, name);
        match formula {
            Formula::Number(_) | Formula::Pi | Formula::Infinity => false,
            Formula::Name(other) => other == name,
            Formula::Apply(_, parts) | Formula::Call(_, parts) => parts.iter().any(on),
            Formula::Negate(a) | Formula::Factorial(a) | Formula::BigO(a) | Formula::LittleO(a) => {
                on(a)
            }
            Formula::Binary(_, a, b) => on(a) || on(b),
            Formula::Ranged(r) => on(&r.from) || on(&r.to) || (r.name != *name && on(&r.body)),
            Formula::Antiderivative(a, x) => x == name || on(a),
            Formula::Derivative(a, x, order) => x == name || on(a) || on(order),
            Formula::At(a, places) | Formula::Limit(a, places) => {
                places.iter().any(|(_, place)| on(place))
                    || (places.iter().all(|(x, _)| x != name) && on(a))
            }
            Formula::Indicator(c) | Formula::Truth(c) => self.condition_depends(c, name),
            Formula::If(c, a, b) => self.condition_depends(c, name) || on(a) || on(b),
            Formula::Mean(a, own) | Formula::Variance(a, own) => {
                self.drawn_depends(own.as_deref(), name) || (!self.draws_it(own, name) && on(a))
            }
            Formula::Probability(c, own) => {
                self.drawn_depends(own.as_deref(), name)
                    || (!self.draws_it(own, name) && self.condition_depends(c, name))
            }
            Formula::Density(a, x) | Formula::Cumulative(a, x) => {
                on(x) || self.drawn_depends(None, name) || (!self.draws_it(&None, name) && on(a))
            }
        }
    }

    pub fn condition_depends(&self, condition: &Condition, name: &Name) -> bool {
        match condition {
            Condition::Chain(first, links) => {
                self.depends(first, name) || links.iter().any(|(_, f)| self.depends(f, name))
            }
            Condition::And(parts) | Condition::Or(parts) => {
                parts.iter().any(|part| self.condition_depends(part, name))
            }
            Condition::Not(part) => self.condition_depends(part, name),
        }
    }

    /// Whether a mean makes a draw of the name.
    fn draws_it(&self, own: &Option<Box<Draw>>, name: &Name) -> bool {
        match own {
            Some(draw) => draw.name == *name,
            None => self.is_draw(name),
        }
    }

    /// Whether the laws that a mean reads depend on the name.
    fn drawn_depends(&self, own: Option<&Draw>, name: &Name) -> bool {
        match own {
            Some(draw) => self.law_depends(&draw.law, name),
            None => self.draws.iter().any(|d| self.law_depends(&d.law, name)),
        }
    }

    pub fn law_depends(&self, law: &Law, name: &Name) -> bool {
        match law {
            Law::Beta(a, b) | Law::Uniform(a, b) => self.depends(a, name) || self.depends(b, name),
            Law::Order(l, m, of) => {
                self.depends(l, name) || self.depends(m, name) || self.law_depends(of, name)
            }
            Law::Density {
                argument,
                body,
                from,
                to,
            } => {
                self.depends(from, name)
                    || self.depends(to, name)
                    || (argument != name && self.depends(body, name))
            }
            Law::Any => false,
        }
    }
}
