//! What can be read off the structure of a formula and the facts in sight: that it is finite, an
//! integer, positive, nonnegative, nonzero, or has no value.
//!
//! Positive, nonnegative and nonzero are said of formulas that are known to be finite: a caller asks
//! for that first. A fact `a < b` says that everything equal to `b - a` as a rational function is
//! positive, so `k - 1` is positive where `1 < k` is in sight.

use super::{Fact, Proof, Proved, Rejected, Step, links_of};
use crate::formula::{
    Formula, Function, FunctionKind, Law, Name, Operator, ParameterKind, Part, Rational, free_names,
};
use num_traits::{Signed, Zero};

type Known = Result<bool, Rejected>;

/// What is known of the sign of a number.
#[derive(Clone, Copy)]
struct Sign {
    nonnegative: bool,
    nonzero: bool,
}

impl Sign {
    fn positive(self) -> bool {
        self.nonnegative && self.nonzero
    }
}

/// Whether all of a list of questions are answered with yes.
macro_rules! all {
    ($first:expr $(, $next:expr)*) => { Ok($first? $(&& $next?)*) };
}

impl Proof<'_> {
    /// The facts proved in this block and those around it.
    fn sight(&self) -> impl Iterator<Item = (Step, &Proved)> {
        let steps = self.steps.iter().map(|proved| &**proved).enumerate();
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
            Formula::Mean(e, None) | Formula::Variance(e, None)
                if self.is_supposed(formula, e)? =>
            {
                Ok(true)
            }
            _ => self.sees_fact(&Fact::Finite(formula.clone())),
        }
    }

    /// Whether a mean or variance is finite by the law `any`: it occurs in the statement, outside of all
    /// binders, and is that of a polynomial in such draws.
    fn is_supposed(&self, mean: &Formula, e: &Formula) -> Known {
        let names = free_names(e);
        let draws = self.proposition.draws.iter();
        let drawn: Vec<_> = draws.filter(|d| names.contains(&d.name)).collect();
        let any = !drawn.is_empty() && drawn.iter().all(|draw| draw.law == Law::Any);
        let occurs = links_of(&self.proposition.statement).is_some_and(|links| {
            let mut sides = links.into_iter().flat_map(|(a, _, b)| [a, b]);
            sides.any(|side| occurs(mean, Part::Formula(side)))
        });
        let drawn: Vec<&Name> = drawn.into_iter().map(|draw| &draw.name).collect();
        Ok(any && occurs && self.polynomial(e, &drawn)?)
    }

    /// Whether a formula is a polynomial in the names with finite coefficients: a number, whatever
    /// numbers they are.
    fn polynomial(&self, e: &Formula, names: &[&Name]) -> Known {
        match e {
            Formula::Name(name) => Ok(names.contains(&name) || self.finite(e)?),
            Formula::Negate(a) => self.polynomial(a, names),
            Formula::Binary(Operator::Add | Operator::Subtract | Operator::Multiply, a, b) => {
                all!(self.polynomial(a, names), self.polynomial(b, names))
            }
            Formula::Binary(Operator::Power, a, n) if matches!(**n, Formula::Number(_)) => {
                all!(
                    self.polynomial(a, names),
                    self.integer(n),
                    self.nonnegative(n)
                )
            }
            // A mean is taken of its draws; it has none left.
            Formula::Mean(_, None) | Formula::Variance(_, None) => self.finite(e),
            _ => {
                let moves = names.iter().any(|name| free_names(e).contains(*name));
                all!(Ok::<_, Rejected>(!moves), self.finite(e))
            }
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
            (Function::Exp | Function::Sin | Function::Cos, _) => Ok(true),
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
            (
                Some(ParameterKind::Function {
                    kind: FunctionKind::Continuous | FunctionKind::Smooth(_) | FunctionKind::Density,
                    from,
                    to,
                    ..
                }),
                [at],
            ) => {
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
        Ok(self.sign(formula)?.positive())
    }

    /// Whether a finite formula is at least 0.
    pub(super) fn nonnegative(&self, formula: &Formula) -> Known {
        Ok(self.sign(formula)?.nonnegative)
    }

    /// Whether a finite formula is not 0.
    pub(super) fn nonzero(&self, formula: &Formula) -> Known {
        Ok(self.sign(formula)?.nonzero)
    }

    /// What is known of the sign of a finite formula: by its structure, as a number, and by the
    /// relations in sight that have it as their `b - a`.
    fn sign(&self, formula: &Formula) -> Result<Sign, Rejected> {
        self.spend(1)?;
        let mut sign = self.sign_by_structure(formula)?;
        let Ok(own) = self.normal(formula) else {
            return self.spend(1).map(|()| sign);
        };
        if let Some(number) = own.as_constant() {
            return Ok(Sign {
                nonnegative: !number.is_negative(),
                nonzero: !number.is_zero(),
            });
        }
        let negated = own.negated();
        for (step, proved) in self.sight() {
            let Some(difference) = &proved.difference else {
                continue;
            };
            let (strict, ordered) = match proved.fact {
                Fact::Less(..) => (true, true),
                Fact::AtMost(..) => (false, true),
                _ => (true, false),
            };
            let same = difference.equals(&own, &self.fuel)?;
            if same || (strict && difference.equals(&negated, &self.fuel)?) {
                self.seen.borrow_mut().push(step);
                sign.nonnegative |= same && ordered;
                sign.nonzero |= strict;
            }
        }
        Ok(sign)
    }

    fn sign_by_structure(&self, formula: &Formula) -> Result<Sign, Rejected> {
        let sign = |nonnegative, nonzero| Sign {
            nonnegative,
            nonzero,
        };
        Ok(match formula {
            Formula::Pi
            | Formula::Factorial(_)
            | Formula::Call(Function::Beta | Function::Exp, _) => sign(true, true),
            Formula::Negate(a) => sign(false, self.sign(a)?.nonzero),
            Formula::Binary(Operator::Add, a, b) => {
                let (a, b) = (self.sign(a)?, self.sign(b)?);
                let both = a.nonnegative && b.nonnegative;
                sign(both, both && (a.nonzero || b.nonzero))
            }
            Formula::Binary(Operator::Multiply | Operator::Divide, a, b) => {
                let (a, b) = (self.sign(a)?, self.sign(b)?);
                sign(a.nonnegative && b.nonnegative, a.nonzero && b.nonzero)
            }
            Formula::Binary(Operator::Power, a, b) => {
                let a = self.sign(a)?;
                sign(a.nonnegative || is_even(b), a.nonzero)
            }
            Formula::Call(Function::Gamma, parts) => {
                let positive = self.sign(&parts[0])?.positive();
                sign(positive, positive)
            }
            Formula::Call(Function::Sqrt, parts) => sign(true, self.sign(&parts[0])?.positive()),
            Formula::Call(Function::Cos, parts) => {
                // Between -pi/2 and pi/2.
                let half = Formula::binary(Operator::Divide, Formula::Pi, Formula::integer(2));
                let above = self.sign(&minus(&half, &parts[0]))?;
                let below = self.sign(&minus(&parts[0], &Formula::Negate(Box::new(half))))?;
                let inside = above.positive() && below.positive();
                sign(inside, inside)
            }
            Formula::Apply(name, _) => sign(self.is_density(name), false),
            Formula::Indicator(_) => sign(true, false),
            _ => sign(false, false),
        })
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
                let difference = self.normal(a)?.minus(&self.normal(b)?, &self.fuel)?;
                Ok(difference.equals(&wanted, &self.fuel)?
                    || difference.negated().equals(&wanted, &self.fuel)?)
            }
            _ => Ok(false),
        })
    }

    /// Whether two formulas have the same value: written alike, or finite with the difference 0.
    pub(super) fn equal(&self, a: &Formula, b: &Formula) -> Known {
        let difference = Formula::binary(Operator::Subtract, a.clone(), b.clone());
        Ok(a == b || self.zero(&difference)?)
    }

    /// Whether the formula has no value: it divides by 0, takes `ln` of what is not positive, a
    /// negative power of 0, Gamma or a factorial at a pole, inf from inf, or has a part without value
    /// where all parts must have one.
    pub(super) fn undefined(&self, formula: &Formula) -> Known {
        self.spend(1)?;
        let own = match formula {
            Formula::Binary(Operator::Divide, _, b) => self.zero(b)?,
            Formula::Binary(Operator::Power, a, b) => {
                let opposite = Formula::Negate(b.clone());
                self.zero(a)? && self.finite(b)? && self.positive(&opposite)?
            }
            Formula::Call(Function::Ln, parts) => self.not_positive(&parts[0])?,
            Formula::Call(Function::Gamma, parts) => {
                self.not_positive(&parts[0])? && self.integer(&parts[0])?
            }
            Formula::Factorial(a) => {
                let opposite = Formula::Negate(a.clone());
                self.finite(a)? && self.integer(a)? && self.positive(&opposite)?
            }
            Formula::Binary(Operator::Subtract, a, b) => self.endless(a)? && self.endless(b)?,
            _ => false,
        };
        if own || self.sees_fact(&Fact::Undefined(formula.clone()))? {
            return Ok(true);
        }
        match formula {
            Formula::Negate(a) | Formula::Factorial(a) | Formula::Derivative(a, ..) => {
                self.undefined(a)
            }
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

    /// Whether the formula is inf, if it has a value.
    fn endless(&self, formula: &Formula) -> Known {
        match formula {
            Formula::Infinity => Ok(true),
            Formula::Binary(Operator::Power, a, b) => {
                Ok(self.endless(a)? && self.finite(b)? && self.positive(b)?)
            }
            _ => Ok(false),
        }
    }

    fn not_positive(&self, a: &Formula) -> Known {
        let negated = Formula::Negate(Box::new(a.clone()));
        Ok(self.zero(a)? || (self.finite(a)? && self.nonnegative(&negated)?))
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

/// Whether a formula is a part of another, outside of all binders.
fn occurs(formula: &Formula, part: Part) -> bool {
    let mut found = matches!(part, Part::Formula(other) if other == formula);
    part.each(&mut |inner, bound| {
        found = found || (bound.is_empty() && occurs(formula, inner));
    });
    found
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
