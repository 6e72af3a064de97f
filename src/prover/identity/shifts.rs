//! Gamma and its kin: all of it to gammas, and these to the least argument that occurs.

use super::builder::Builder;
use super::form::{call, integer, minus, over, plus, times};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule, Step};

/// No argument is shifted further.
const SHIFT: i64 = 24;

impl Builder<'_> {
    /// A factorial, beta, binomial or Pochhammer symbol by gammas.
    pub(super) fn as_gammas(&mut self, e: &Formula) -> Option<Step> {
        let gamma = |x: Formula| call(Function::Gamma, x);
        let (rule, right) = match e {
            Formula::Factorial(n) => (Rule::Factorial, gamma(plus((**n).clone(), integer(1)))),
            Formula::Call(function, parts) => {
                let [a, b] = parts.as_slice() else {
                    return None;
                };
                let (a, b) = (a.clone(), b.clone());
                match function {
                    Function::Beta => {
                        let above = times(gamma(a.clone()), gamma(b.clone()));
                        (Rule::Beta, over(above, gamma(plus(a, b))))
                    }
                    Function::Binomial => (Rule::Binomial, self.binomial(a, b)?),
                    _ => {
                        let above = gamma(plus(a.clone(), b));
                        (Rule::Pochhammer, over(above, gamma(a)))
                    }
                }
            }
            _ => return None,
        };
        self.finite(&right)?;
        self.step(Fact::Same(e.clone(), right), rule, &[], &[])
    }

    fn binomial(&mut self, n: Formula, k: Formula) -> Option<Formula> {
        let factorial = |x: Formula| Formula::Factorial(Box::new(x));
        let rest = minus(n.clone(), k.clone());
        Some(over(factorial(n), times(factorial(k), factorial(rest))))
    }

    /// Equations that bring gammas whose arguments differ by integers to the least of them.
    pub(super) fn shifts(&mut self, atoms: &[Formula]) -> Vec<Step> {
        let mut steps = Vec::new();
        let gammas: Vec<&Formula> = atoms
            .iter()
            .filter_map(|atom| match atom {
                Formula::Call(Function::Gamma, parts) => parts.first(),
                _ => None,
            })
            .collect();
        for s in &gammas {
            let distances = gammas.iter().map(|t| self.distance(t, s));
            let far = distances.flatten().max().unwrap_or(0);
            if (1..=SHIFT).contains(&far)
                && let Some(step) = self.attempt(|builder| builder.shift(s))
            {
                steps.push(step);
            }
        }
        steps
    }

    /// `s - t`, where it is an integer.
    fn distance(&self, t: &Formula, s: &Formula) -> Option<i64> {
        self.field.borrow_mut().difference(t, s)?.as_integer()
    }

    /// `gamma(s) == t*gamma(t)` with `t = s - 1`.
    fn shift(&mut self, s: &Formula) -> Option<Step> {
        let t = self.simplified(&minus(s.clone(), integer(1)))?;
        let right = times(t.clone(), call(Function::Gamma, t.clone()));
        self.finite(&t)?;
        self.positive(&t)?;
        let fact = Fact::Same(call(Function::Gamma, s.clone()), right);
        self.step(fact, Rule::Gamma, &[], &[])
    }

    /// `gamma(s) == t*gamma(t)` or the other way round, be the two finite or not.
    pub fn recurrence(&mut self, x: &Formula, y: &Formula) -> Option<Step> {
        [(x, y), (y, x)].into_iter().find_map(|(left, right)| {
            let Formula::Binary(Operator::Multiply, t, _) = right else {
                return None;
            };
            self.finite(t)?;
            self.nonzero(t)?;
            let fact = Fact::Same(left.clone(), right.clone());
            let step = self.step(fact, Rule::Gamma, &[], &[])?;
            self.chain(&[step], x, y)
        })
    }

    /// `gamma(1/2) == sqrt(pi)`, and the shift of a gamma at a greater half of an odd number.
    pub(super) fn half_gamma(&mut self, s: &Formula) -> Option<Step> {
        let value = self.field.borrow_mut().normal(s)?.as_constant()?;
        (*value.denom() == 2 && value < SHIFT).then_some(())?;
        if *value.numer() != 1 {
            return self.shift(s);
        }
        let gamma = call(Function::Gamma, over(integer(1), integer(2)));
        let fact = Fact::Same(gamma, call(Function::Sqrt, Formula::Pi));
        self.step(fact, Rule::Constant, &[], &[])
    }

    /// The formula's normal form, written.
    pub(super) fn simplified(&self, e: &Formula) -> Option<Formula> {
        let mut field = self.field.borrow_mut();
        let normal = field.normal(e)?;
        Some(field.write(&normal))
    }
}
