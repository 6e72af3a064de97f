//! What can be read off the structure of a formula and the facts in sight: that it is finite, an
//! integer, positive, nonnegative, nonzero, or has no value.
//!
//! Positive, nonnegative and nonzero are said of formulas that are known to be finite: a caller asks
//! for that first. A fact `a < b` says that everything equal to `b - a` as a rational function is
//! positive, so `k - 1` is positive where `1 < k` is in sight.

use super::normal::Fraction;
use super::{Fact, Proof, Proved, Rejected, Step};
use crate::formula::{
    Condition, Formula, Function, FunctionKind, Name, Operator, ParameterKind, Part, Rational,
    Relation,
};
use num_traits::{Signed, Zero};

type Known = Result<bool, Rejected>;

/// Whether all of a list of questions are answered with yes.
macro_rules! all {
    ($first:expr $(, $next:expr)*) => { Ok($first? $(&& $next?)*) };
}

impl Proof<'_> {
    /// The facts proved in this block and those around it.
    fn sight(&self) -> impl Iterator<Item = (Step, &Proved)> {
        let steps = self.steps.iter().enumerate();
        steps.filter(|(_, proved)| self.open.starts_with(&proved.blocks))
    }

    /// Whether a fact in sight is what is looked for.
    pub(super) fn sees(&self, is_it: impl Fn(&Proved) -> Known) -> Known {
        for (step, proved) in self.sight() {
            self.spend(1)?;
            if is_it(proved)? {
                self.seen.borrow_mut().push(step);
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether the very fact is in sight.
    pub(super) fn sees_fact(&self, fact: &Fact) -> Known {
        self.sees(|proved| Ok(proved.fact == *fact))
    }

    /// Whether the formula is a number with this sign, or a relation in sight has it as its `b - a`.
    fn seen_as(
        &self,
        formula: &Formula,
        sign: fn(&Rational) -> bool,
        allows: fn(&Fact) -> bool,
    ) -> Known {
        let Ok(wanted) = self.normal(formula) else {
            return self.spend(1).map(|()| false);
        };
        if let Some(number) = wanted.as_constant() {
            return Ok(sign(&number));
        }
        self.sees(|proved| match &proved.difference {
            Some(difference) if allows(&proved.fact) => difference.equals(&wanted),
            _ => Ok(false),
        })
    }

    /// Whether the formula has a value that is a number. Arithmetic and functions are so where their
    /// parts are and the operation is defined there; integrals and means where a fact says so.
    pub(super) fn finite(&self, formula: &Formula) -> Known {
        self.spend(1)?;
        match formula {
            Formula::Number(_) | Formula::Pi => Ok(true),
            Formula::Name(name) => Ok(self.is_integer_name(name).is_some()),
            Formula::Negate(a) => self.finite(a),
            Formula::Binary(operator, a, b) => {
                all!(
                    self.finite(a),
                    self.finite(b),
                    self.operates(*operator, a, b)
                )
            }
            Formula::Factorial(a) => all!(self.finite(a), self.integer(a), self.nonnegative(a)),
            Formula::Call(function, parts) => {
                for part in parts {
                    if !self.finite(part)? {
                        return Ok(false);
                    }
                }
                self.calls(*function, parts)
            }
            Formula::Apply(name, parts) => self.applies(name, parts),
            Formula::Indicator(condition) => self.compares(Part::Condition(condition)),
            _ => self.sees_fact(&Fact::Finite(formula.clone())),
        }
    }

    /// Whether an operation on finite numbers has a finite value.
    fn operates(&self, operator: Operator, a: &Formula, b: &Formula) -> Known {
        match operator {
            Operator::Divide => self.nonzero(b),
            Operator::Power => {
                let integer = self.integer(b)?;
                Ok(self.positive(a)?
                    || (integer && (self.nonnegative(b)? || self.nonzero(a)?))
                    || (self.nonnegative(a)? && self.positive(b)?))
            }
            Operator::Add | Operator::Subtract | Operator::Multiply => Ok(true),
        }
    }

    /// Whether a function of finite numbers has a finite value: inside its domain, on no pole.
    fn calls(&self, function: Function, parts: &[Formula]) -> Known {
        match (function, parts) {
            (Function::Sqrt, [a]) => self.nonnegative(a),
            (Function::Ln | Function::Gamma, [a]) => self.positive(a),
            (Function::Beta, [a, b]) => all!(self.positive(a), self.positive(b)),
            (Function::Binomial, [_, k]) => self.integer(k),
            (Function::Pochhammer, [_, n]) => all!(self.integer(n), self.nonnegative(n)),
            (Function::Hyp2F1 | Function::Hyp2F1Regularized, [_, _, c, z]) => {
                all!(self.positive(c), self.positive(&one_minus(z)))
            }
            _ => Ok(false),
        }
    }

    /// Whether a function parameter has a value at its argument: on the range it is given on.
    fn applies(&self, name: &Name, parts: &[Formula]) -> Known {
        let parameters = &self.proposition.parameters;
        let kind = parameters.iter().find(|p| p.name == *name).map(|p| &p.kind);
        match (kind, parts) {
            (Some(ParameterKind::Function { kind, from, to, .. }), [at])
                if matches!(
                    kind,
                    FunctionKind::Continuous | FunctionKind::Smooth(_) | FunctionKind::Density
                ) =>
            {
                let finite = self.finite(from)? && self.finite(at)? && self.finite(to)?;
                Ok(finite && self.between(from, at, to)?)
            }
            _ => Ok(false),
        }
    }

    /// Whether `a <= x <= b`, given that they are finite.
    pub(super) fn between(&self, a: &Formula, x: &Formula, b: &Formula) -> Known {
        all!(
            self.nonnegative(&minus(x, a)),
            self.nonnegative(&minus(b, x))
        )
    }

    /// Whether the sides of all relations of a condition are finite.
    fn compares(&self, part: Part) -> Known {
        let mut parts = Vec::new();
        part.each(&mut |part, _| parts.push(part));
        for part in parts {
            let finite = match part {
                Part::Formula(formula) => self.finite(formula)?,
                part => self.compares(part)?,
            };
            if !finite {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a finite formula has the value of an integer.
    pub(super) fn integer(&self, formula: &Formula) -> Known {
        self.spend(1)?;
        match formula {
            Formula::Number(value) => Ok(value.is_integer()),
            Formula::Name(name) => Ok(self.is_integer_name(name) == Some(true)),
            Formula::Negate(a) => self.integer(a),
            Formula::Factorial(_) => Ok(true),
            Formula::Binary(Operator::Add | Operator::Subtract | Operator::Multiply, a, b) => {
                all!(self.integer(a), self.integer(b))
            }
            Formula::Binary(Operator::Power, a, b) => {
                all!(self.integer(a), self.integer(b), self.nonnegative(b))
            }
            _ => self.sees_fact(&Fact::Integer(formula.clone())),
        }
    }

    /// Whether a finite formula is greater than 0.
    pub(super) fn positive(&self, formula: &Formula) -> Known {
        self.spend(1)?;
        let by_structure = match formula {
            Formula::Pi | Formula::Factorial(_) => true,
            Formula::Binary(Operator::Add, a, b) => {
                (self.positive(a)? && self.nonnegative(b)?)
                    || (self.nonnegative(a)? && self.positive(b)?)
            }
            Formula::Binary(Operator::Multiply | Operator::Divide, a, b) => {
                self.positive(a)? && self.positive(b)?
            }
            Formula::Binary(Operator::Power, a, b) => {
                self.positive(a)? || (is_even(b) && self.nonzero(a)?)
            }
            Formula::Call(Function::Gamma | Function::Sqrt, parts) => self.positive(&parts[0])?,
            Formula::Call(Function::Beta, _) => true,
            _ => false,
        };
        let allows = |fact: &Fact| matches!(fact, Fact::Less(..));
        Ok(by_structure || self.seen_as(formula, Rational::is_positive, allows)?)
    }

    /// Whether a finite formula is at least 0.
    pub(super) fn nonnegative(&self, formula: &Formula) -> Known {
        self.spend(1)?;
        let by_structure = match formula {
            Formula::Indicator(_) | Formula::Call(Function::Sqrt, _) => true,
            Formula::Apply(name, _) => self.is_density(name),
            Formula::Binary(Operator::Add | Operator::Multiply | Operator::Divide, a, b) => {
                self.nonnegative(a)? && self.nonnegative(b)?
            }
            Formula::Binary(Operator::Power, a, b) => is_even(b) || self.nonnegative(a)?,
            _ => false,
        };
        let allows = |fact: &Fact| matches!(fact, Fact::Less(..) | Fact::AtMost(..));
        let sign = |number: &Rational| !number.is_negative();
        Ok(by_structure || self.positive(formula)? || self.seen_as(formula, sign, allows)?)
    }

    fn is_density(&self, name: &Name) -> bool {
        let parameters = &self.proposition.parameters;
        let parameter = parameters.iter().find(|p| p.name == *name);
        matches!(
            parameter.map(|p| &p.kind),
            Some(ParameterKind::Function {
                kind: FunctionKind::Density,
                ..
            })
        )
    }

    /// Whether a finite formula is not 0.
    pub(super) fn nonzero(&self, formula: &Formula) -> Known {
        self.spend(1)?;
        let by_structure = match formula {
            Formula::Negate(a) => self.nonzero(a)?,
            Formula::Binary(Operator::Multiply | Operator::Divide, a, b) => {
                self.nonzero(a)? && self.nonzero(b)?
            }
            Formula::Binary(Operator::Power, a, _) => self.nonzero(a)?,
            _ => false,
        };
        if by_structure || self.positive(formula)? {
            return Ok(true);
        }
        let allows = |fact: &Fact| matches!(fact, Fact::Less(..) | Fact::Different(..));
        let sign = |number: &Rational| !number.is_zero();
        let negated = Formula::Negate(Box::new(formula.clone()));
        Ok(self.seen_as(formula, sign, allows)? || self.seen_as(&negated, sign, allows)?)
    }

    /// Whether a formula is finite with the value 0: by arithmetic, or by an equation in sight.
    pub(super) fn zero(&self, formula: &Formula) -> Known {
        if !self.finite(formula)? {
            return Ok(false);
        }
        let Ok(wanted) = self.normal(formula) else {
            return self.spend(1).map(|()| false);
        };
        if wanted.is_zero() {
            return Ok(true);
        }
        self.sees(|proved| match &proved.fact {
            Fact::Same(a, b) if self.finite(a)? && self.finite(b)? => {
                let difference = self.normal(a)?.minus(&self.normal(b)?)?;
                Ok(difference.equals(&wanted)? || difference.negated().equals(&wanted)?)
            }
            _ => Ok(false),
        })
    }

    /// Whether two formulas have the same value: written alike, finite and equal as rational
    /// functions, or equal by a fact in sight.
    pub(super) fn equal(&self, a: &Formula, b: &Formula) -> Known {
        if a == b {
            return Ok(true);
        }
        let rational = || -> Result<Fraction, Rejected> { self.normal(a)?.minus(&self.normal(b)?) };
        if self.finite(a)? && self.finite(b)? && rational().is_ok_and(|d| d.is_zero()) {
            return Ok(true);
        }
        let (there, back) = (
            Fact::Same(a.clone(), b.clone()),
            Fact::Same(b.clone(), a.clone()),
        );
        Ok(self.sees_fact(&there)? || self.sees_fact(&back)?)
    }

    /// Whether the formula has no value: it divides by 0, takes `ln` of what is not positive or a
    /// negative power of 0, or has a part without value where all parts must have one.
    pub(super) fn undefined(&self, formula: &Formula) -> Known {
        self.spend(1)?;
        let own = match formula {
            Formula::Binary(Operator::Divide, _, b) => self.zero(b)?,
            Formula::Binary(Operator::Power, a, b) => {
                let opposite = Formula::Negate(b.clone());
                self.zero(a)? && self.finite(b)? && self.positive(&opposite)?
            }
            Formula::Call(Function::Ln, parts) => self.not_positive(&parts[0])?,
            _ => false,
        };
        if own || self.sees_fact(&Fact::Undefined(formula.clone()))? {
            return Ok(true);
        }
        match formula {
            Formula::Negate(a) | Formula::Factorial(a) => self.undefined(a),
            Formula::Binary(_, a, b) => Ok(self.undefined(a)? || self.undefined(b)?),
            Formula::Call(_, parts) | Formula::Apply(_, parts) => {
                for part in parts {
                    if self.undefined(part)? {
                        return Ok(true);
                    }
                }
                Ok(false)
            }
            _ => Ok(false),
        }
    }

    fn not_positive(&self, a: &Formula) -> Known {
        let negated = Formula::Negate(Box::new(a.clone()));
        Ok(self.zero(a)? || (self.finite(a)? && self.nonnegative(&negated)?))
    }

    /// Whether what a block supposes holds here.
    pub(super) fn holds(&self, fact: &Fact) -> Known {
        match fact {
            Fact::Less(a, b) => all!(self.finite(a), self.finite(b), self.positive(&above(a, b))),
            Fact::AtMost(a, b) => {
                all!(
                    self.finite(a),
                    self.finite(b),
                    self.nonnegative(&above(a, b))
                )
            }
            Fact::Different(a, b) => {
                all!(self.finite(a), self.finite(b), self.nonzero(&above(a, b)))
            }
            Fact::Same(a, b) => self.equal(a, b),
            Fact::Finite(a) => self.finite(a),
            Fact::Integer(a) => all!(self.finite(a), self.integer(a)),
            Fact::Undefined(a) => self.undefined(a),
        }
    }
}

/// `b - a`, or just b where a is 0: what a relation between a and b says of its structure.
pub(super) fn above(a: &Formula, b: &Formula) -> Formula {
    match a {
        Formula::Number(zero) if zero.is_zero() => b.clone(),
        _ => minus(b, a),
    }
}

/// `a - b`
pub(super) fn minus(a: &Formula, b: &Formula) -> Formula {
    Formula::binary(Operator::Subtract, a.clone(), b.clone())
}

fn one_minus(z: &Formula) -> Formula {
    minus(&Formula::integer(1), z)
}

fn is_even(exponent: &Formula) -> bool {
    match exponent {
        Formula::Number(value) => (value / Rational::from_integer(2.into())).is_integer(),
        _ => false,
    }
}

/// The condition `a < x < b`, as an indicator has it.
pub(super) fn strictly_between(a: &Formula, x: &Formula, b: &Formula) -> Condition {
    let links = vec![(Relation::Less, x.clone()), (Relation::Less, b.clone())];
    Condition::Chain(a.clone(), links)
}
