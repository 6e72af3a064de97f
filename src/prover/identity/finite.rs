//! Makes it known that formulas are finite.

use super::builder::Builder;
use super::form::{integer, minus};
use super::known::Sign;
use crate::formula::{
    Condition, Formula, Function, FunctionKind, Name, Operator, ParameterKind, Part,
};
use crate::kernel::proof::{Fact, Rule, Step};

impl Builder<'_> {
    /// Makes it known that a formula has a value that is a number.
    pub fn finite(&mut self, e: &Formula) -> Option<()> {
        match e {
            Formula::Number(_) | Formula::Pi => Some(()),
            Formula::Name(name) => self.is_number(name).then_some(()),
            Formula::Negate(a) => self.finite(a),
            Formula::Binary(operator, a, b) => {
                self.finite(a)?;
                self.finite(b)?;
                self.operates(*operator, a, b)
            }
            Formula::Factorial(a) => {
                self.finite(a)?;
                self.is_integer(a).then(|| self.nonnegative(a))?
            }
            Formula::Call(function, parts) => {
                parts.iter().try_for_each(|part| self.finite(part))?;
                self.calls(*function, parts)
            }
            Formula::Apply(name, parts) => self.applies(name, parts),
            Formula::Indicator(condition) => self.compares(condition),
            _ => self.seen(&Fact::Finite(e.clone())).map(|_| ()),
        }
    }

    /// States that a formula is finite.
    pub fn finite_step(&mut self, e: &Formula) -> Option<Step> {
        self.finite(e)?;
        self.step(Fact::Finite(e.clone()), Rule::Finite, &[], &[])
    }

    /// States that a formula is finite which the step says to have this value.
    pub fn finite_by(&mut self, value: &Formula, step: Step) -> Option<Step> {
        let Fact::Same(e, _) = self.fact(step).clone() else {
            return None;
        };
        self.finite(value)?;
        self.step(Fact::Finite(e), Rule::Finite, &[step], &[])
    }

    fn operates(&mut self, operator: Operator, a: &Formula, b: &Formula) -> Option<()> {
        match operator {
            Operator::Add | Operator::Subtract | Operator::Multiply => Some(()),
            Operator::Divide => self.nonzero(b),
            Operator::Power => {
                let integer = self.is_integer(b);
                if self.knows(a, Sign::Positive)
                    || (integer
                        && (self.knows(b, Sign::Nonnegative) || self.knows(a, Sign::Nonzero)))
                    || (self.knows(a, Sign::Nonnegative) && self.knows(b, Sign::Positive))
                {
                    return Some(());
                }
                if integer && (self.nonnegative(b).is_some() || self.nonzero(a).is_some()) {
                    return Some(());
                }
                self.positive(a).or_else(|| {
                    self.nonnegative(a)?;
                    self.positive(b)
                })
            }
        }
    }

    fn calls(&mut self, function: Function, parts: &[Formula]) -> Option<()> {
        match (function, parts) {
            (Function::Exp | Function::Sin | Function::Cos, _) => Some(()),
            (Function::Sqrt, [a]) => self.nonnegative(a),
            (Function::Ln | Function::Gamma, [a]) => self.positive(a),
            (Function::Beta, [a, b]) => {
                self.positive(a)?;
                self.positive(b)
            }
            (Function::Binomial, [_, k]) => self.is_integer(k).then_some(()),
            (Function::Pochhammer, [_, n]) => self.is_integer(n).then(|| self.nonnegative(n))?,
            (Function::Hyp2F1 | Function::Hyp2F1Regularized, [_, _, c, z]) => {
                self.positive(c)?;
                self.positive(&minus(integer(1), z.clone()))
            }
            _ => None,
        }
    }

    fn applies(&mut self, name: &Name, parts: &[Formula]) -> Option<()> {
        let mut parameters = self.proposition().parameters.iter();
        let kind = &parameters.find(|p| p.name == *name)?.kind;
        let (ParameterKind::Function { kind, from, to, .. }, [at]) = (kind, parts) else {
            return None;
        };
        if matches!(kind, FunctionKind::Integrable | FunctionKind::Polynomial) {
            return None;
        }
        for part in [from, at, to] {
            self.finite(part)?;
        }
        self.nonnegative(&minus(at.clone(), from.clone()))?;
        self.nonnegative(&minus(to.clone(), at.clone()))
    }

    /// The sides of all relations of a condition are finite.
    fn compares(&mut self, condition: &Condition) -> Option<()> {
        let mut sides = Vec::new();
        Part::Condition(condition).each(&mut |part, _| sides.push(part));
        sides.into_iter().try_for_each(|side| match side {
            Part::Formula(e) => self.finite(e),
            Part::Condition(c) => self.compares(c),
            Part::Law(_) => None,
        })
    }

    fn is_number(&self, name: &Name) -> bool {
        let parameter = self
            .proposition()
            .parameters
            .iter()
            .find(|p| p.name == *name);
        let number = parameter.is_some_and(|p| !matches!(p.kind, ParameterKind::Function { .. }));
        number || self.variable(name).is_some()
    }

    /// Whether a name stands for integers.
    pub(super) fn is_integer_name(&self, name: &Name) -> bool {
        let parameter = self
            .proposition()
            .parameters
            .iter()
            .find(|p| p.name == *name);
        self.variable(name)
            .unwrap_or_else(|| parameter.is_some_and(|p| p.kind == ParameterKind::Integer))
    }
}
