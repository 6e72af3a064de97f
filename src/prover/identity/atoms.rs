//! Equations that replace atoms by simpler ones.

use super::builder::Builder;
use crate::algebra::{RationalFunction, Symbol};
use crate::formula::{Formula, Function, Operator, free_functions, free_names};
use crate::formula::{Point, Rational};
use crate::kernel::proof::{Fact, Rule, Step};
use crate::kernel::{Value, value};
use std::collections::{BTreeMap, BTreeSet};

/// Rounds of replacing atoms by others; no formula of a paper needs as many.
const ROUNDS: usize = 12;
/// Replacements within replacements.
const DEPTH: usize = 40;

/// Equations with an atom on the left, by its indeterminate.
#[derive(Clone, Debug, Default)]
pub(super) struct Equations {
    steps: BTreeMap<Symbol, Step>,
    /// Atoms met that have no equation so far.
    rest: BTreeMap<Symbol, Formula>,
    /// Atoms that are looked at no more.
    done: BTreeSet<Symbol>,
}

impl Equations {
    /// The equations for the atoms of these formulas, with those that are given.
    pub fn find(builder: &mut Builder, sides: &[&Formula], given: &[Step]) -> Option<Equations> {
        let mut equations = Equations::default();
        for step in given {
            equations.take(builder, *step)?;
        }
        for side in sides {
            equations.meet(builder, side)?;
        }
        for _ in 0..ROUNDS {
            let before = equations.steps.len();
            equations.expand(builder)?;
            let rest: Vec<Formula> = equations.rest.values().cloned().collect();
            let steps = match builder.shifts(&rest) {
                steps if steps.is_empty() => {
                    let mut steps = builder.split_powers(&rest);
                    steps.extend(builder.split_logarithms(&rest));
                    steps
                }
                steps => steps,
            };
            for step in steps {
                equations.take(builder, step)?;
            }
            if equations.steps.len() == before {
                break;
            }
        }
        Some(equations)
    }

    /// Keeps an equation for an atom, and meets the atoms on its right.
    fn take(&mut self, builder: &mut Builder, step: Step) -> Option<()> {
        let Fact::Same(left, right) = builder.fact(step).clone() else {
            return None;
        };
        let symbol = match &left {
            Formula::Name(name) => name.clone(),
            _ => builder.field.borrow_mut().atom(&left)?,
        };
        self.rest.remove(&symbol);
        self.steps.entry(symbol).or_insert(step);
        self.meet(builder, &right)
    }

    /// Notes the atoms of a formula.
    fn meet(&mut self, builder: &mut Builder, e: &Formula) -> Option<()> {
        match e {
            Formula::Number(_) | Formula::Name(_) | Formula::Pi => Some(()),
            Formula::Negate(a) => self.meet(builder, a),
            Formula::Binary(Operator::Power, a, b) => {
                let exponent = builder.field.borrow_mut().normal(b)?;
                match exponent.as_integer() {
                    Some(_) => self.meet(builder, a),
                    None => self.note(builder, e),
                }
            }
            Formula::Binary(_, a, b) => {
                self.meet(builder, a)?;
                self.meet(builder, b)
            }
            _ => self.note(builder, e),
        }
    }

    fn note(&mut self, builder: &mut Builder, atom: &Formula) -> Option<()> {
        let symbol = builder.field.borrow_mut().atom(atom)?;
        if !self.steps.contains_key(&symbol) {
            self.rest.entry(symbol).or_insert_with(|| atom.clone());
        }
        Some(())
    }

    /// Replaces what has a rule of its own, until nothing is left of that kind.
    fn expand(&mut self, builder: &mut Builder) -> Option<()> {
        for _ in 0..ROUNDS {
            let new: Vec<(Symbol, Formula)> = self
                .rest
                .iter()
                .filter(|(symbol, _)| !self.done.contains(*symbol))
                .map(|(symbol, atom)| (symbol.clone(), atom.clone()))
                .collect();
            if new.is_empty() {
                break;
            }
            for (symbol, atom) in new {
                self.done.insert(symbol);
                if let Some(step) = builder.attempt(|builder| builder.expanded(&atom)) {
                    self.take(builder, step)?;
                }
            }
        }
        Some(())
    }

    /// The equations.
    pub fn steps(&self) -> Vec<Step> {
        self.steps.values().copied().collect()
    }

    /// The atoms without one.
    pub fn rest(&self) -> impl Iterator<Item = (&Symbol, &Formula)> {
        self.rest.iter()
    }

    /// `b - a` with all atoms replaced.
    pub fn difference(
        &self,
        builder: &mut Builder,
        a: &Formula,
        b: &Formula,
    ) -> Option<RationalFunction> {
        let difference = builder.field.borrow_mut().difference(a, b)?;
        self.replaced(builder, difference)
    }

    /// A rational function with all atoms replaced.
    pub fn replaced(
        &self,
        builder: &mut Builder,
        mut function: RationalFunction,
    ) -> Option<RationalFunction> {
        for _ in 0..DEPTH {
            let symbols = function.symbols();
            let Some((symbol, step)) = self.steps.iter().find(|(s, _)| symbols.contains(*s)) else {
                return Some(function);
            };
            let right = builder.right(*step)?;
            let mut field = builder.field.borrow_mut();
            let right = field.normal(&right)?;
            function = function.substitute(symbol, &right, &field.budget).ok()?;
        }
        None
    }
}

impl Builder<'_> {
    /// An equation for an atom by the rule for its kind.
    fn expanded(&mut self, atom: &Formula) -> Option<Step> {
        if let Some(step) = self.computed(atom) {
            return Some(step);
        }
        match atom {
            Formula::Factorial(_)
            | Formula::Call(Function::Beta | Function::Binomial | Function::Pochhammer, _) => {
                self.as_gammas(atom)
            }
            Formula::Call(Function::Gamma, parts) => self.half_gamma(parts.first()?),
            Formula::Call(Function::Cos, _) => {
                let minus_one = super::form::negate(super::form::integer(1));
                self.step(
                    Fact::Same(atom.clone(), minus_one),
                    Rule::Constant,
                    &[],
                    &[],
                )
            }
            Formula::Call(Function::Sqrt, _) => self.root(atom),
            Formula::Binary(Operator::Power, base, exponent) => {
                self.expanded_power(atom, base, exponent)
            }
            Formula::Call(Function::Ln, parts) => self.expanded_logarithm(atom, parts.first()?),
            _ => None,
        }
    }

    /// The value of a formula without names, where it is a rational number.
    fn computed(&mut self, e: &Formula) -> Option<Step> {
        let fact = Fact::Same(e.clone(), super::form::number(&exact(e)?));
        self.step(fact, Rule::Compute, &[], &[])
    }
}

/// The rational number that a formula without names is.
pub(super) fn exact(e: &Formula) -> Option<Rational> {
    if !free_names(e).is_empty() || !free_functions(e).is_empty() {
        return None;
    }
    match value(e, &Point::default(), &[], 64) {
        Ok(Value::Finite { low, high }) if low == high => Some(low),
        _ => None,
    }
}
