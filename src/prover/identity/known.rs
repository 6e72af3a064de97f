//! What the kernel reads off the structure of a formula and the relations in sight, foreseen here.
//!
//! A wrong yes costs no soundness: the kernel refuses the step that was to rest on it.

use super::builder::Builder;
use super::form::{integer, minus, negate, over};
use crate::algebra::RationalFunction;
use crate::formula::{Formula, Function, FunctionKind, Name, Operator, ParameterKind, Rational};
use crate::kernel::proof::Fact;
use num_traits::Zero;

/// What is asked of a formula's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Sign {
    Positive,
    Nonnegative,
    Nonzero,
}

impl Sign {
    /// Whether a relation says so of its `b - a`.
    pub fn given_by(self, fact: &Fact) -> bool {
        match fact {
            Fact::Less(..) => true,
            Fact::AtMost(..) => self == Sign::Nonnegative,
            Fact::Different(..) => self == Sign::Nonzero,
            _ => false,
        }
    }

    fn of(self, value: &rug::Rational) -> bool {
        match self {
            Sign::Positive => *value > 0,
            Sign::Nonnegative => *value >= 0,
            Sign::Nonzero => *value != 0,
        }
    }
}

impl Builder<'_> {
    /// Whether the kernel sees this sign of a finite formula already.
    pub(super) fn knows(&self, e: &Formula, sign: Sign) -> bool {
        let by_structure = match sign {
            Sign::Positive => self.knows_positive(e),
            Sign::Nonnegative => self.knows_nonnegative(e) || self.knows_positive(e),
            Sign::Nonzero => self.knows_nonzero(e) || self.knows_positive(e),
        };
        by_structure || self.sees_sign(e, sign)
    }

    fn knows_positive(&self, e: &Formula) -> bool {
        let positive = |a: &Formula| self.knows(a, Sign::Positive);
        match e {
            Formula::Pi | Formula::Factorial(_) => true,
            Formula::Binary(Operator::Add, a, b) => {
                let nonnegative = |a: &Formula| self.knows(a, Sign::Nonnegative);
                (positive(a) && nonnegative(b)) || (nonnegative(a) && positive(b))
            }
            Formula::Binary(Operator::Multiply | Operator::Divide, a, b) => {
                positive(a) && positive(b)
            }
            Formula::Binary(Operator::Power, a, b) => {
                positive(a) || (is_even(b) && self.knows(a, Sign::Nonzero))
            }
            Formula::Call(Function::Gamma | Function::Sqrt, parts) => {
                parts.first().is_some_and(positive)
            }
            Formula::Call(Function::Beta | Function::Exp, _) => true,
            Formula::Call(Function::Cos, parts) => parts
                .iter()
                .flat_map(beside_zeros)
                .all(|gap| positive(&gap)),
            _ => false,
        }
    }

    fn knows_nonnegative(&self, e: &Formula) -> bool {
        let nonnegative = |a: &Formula| self.knows(a, Sign::Nonnegative);
        match e {
            Formula::Indicator(_) | Formula::Call(Function::Sqrt, _) => true,
            Formula::Apply(name, _) => self.is_density(name),
            Formula::Binary(Operator::Add | Operator::Multiply | Operator::Divide, a, b) => {
                nonnegative(a) && nonnegative(b)
            }
            Formula::Binary(Operator::Power, a, b) => is_even(b) || nonnegative(a),
            _ => false,
        }
    }

    fn knows_nonzero(&self, e: &Formula) -> bool {
        let nonzero = |a: &Formula| self.knows(a, Sign::Nonzero);
        match e {
            Formula::Negate(a) => nonzero(a),
            Formula::Binary(Operator::Multiply | Operator::Divide, a, b) => {
                nonzero(a) && nonzero(b)
            }
            Formula::Binary(Operator::Power, a, _) => nonzero(a),
            _ => false,
        }
    }

    /// Whether a relation in sight says so.
    fn sees_sign(&self, e: &Formula, sign: Sign) -> bool {
        let wanted = self.field.borrow_mut().normal(e);
        let Some(wanted) = wanted else {
            return false;
        };
        if let Some(value) = wanted.as_constant() {
            return sign.of(&value);
        }
        self.sees_difference(&wanted, sign)
            || (sign == Sign::Nonzero && self.sees_difference(&wanted.neg(), sign))
    }

    fn sees_difference(&self, wanted: &RationalFunction, sign: Sign) -> bool {
        let field = self.field.borrow();
        let mut relations = self.relations().filter(|r| sign.given_by(&r.fact));
        relations.any(|relation| {
            let rest = relation.difference.sub(wanted, &field.budget);
            rest.is_ok_and(|rest| rest.is_zero())
        })
    }

    /// Whether a finite formula is seen to be an integer.
    pub fn is_integer(&self, e: &Formula) -> bool {
        match e {
            Formula::Number(value) => value.is_integer(),
            Formula::Name(name) => self.is_integer_name(name),
            Formula::Negate(a) => self.is_integer(a),
            Formula::Factorial(_) => true,
            Formula::Binary(Operator::Add | Operator::Subtract | Operator::Multiply, a, b) => {
                self.is_integer(a) && self.is_integer(b)
            }
            Formula::Binary(Operator::Power, a, b) => {
                self.is_integer(a) && self.is_integer(b) && self.knows(b, Sign::Nonnegative)
            }
            _ => self.seen(&Fact::Integer(e.clone())).is_some(),
        }
    }

    fn is_density(&self, name: &Name) -> bool {
        let mut parameters = self.proposition().parameters.iter();
        let density = |kind: &ParameterKind| {
            matches!(
                kind,
                ParameterKind::Function {
                    kind: FunctionKind::Density,
                    ..
                }
            )
        };
        parameters.any(|p| p.name == *name && density(&p.kind))
    }
}

/// What is positive for a number between the zeros of cosine at -pi/2 and pi/2.
pub(super) fn beside_zeros(e: &Formula) -> [Formula; 2] {
    let half = over(Formula::Pi, integer(2));
    [
        minus(half.clone(), e.clone()),
        minus(e.clone(), negate(half)),
    ]
}

pub(super) fn is_even(exponent: &Formula) -> bool {
    match exponent {
        Formula::Number(value) => {
            let half = value / Rational::from_integer(2.into());
            half.is_integer() && !half.is_zero()
        }
        _ => false,
    }
}
