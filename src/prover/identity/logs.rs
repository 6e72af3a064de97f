//! Logarithms of products, quotients, powers and roots.

use super::builder::Builder;
use super::factor::Factored;
use super::form::{call, integer, minus, over, plus, times};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule, Step};

impl Builder<'_> {
    /// A logarithm of a product, a quotient, a power, a root or exp.
    pub(super) fn expanded_logarithm(&mut self, e: &Formula, of: &Formula) -> Option<Step> {
        let ln = |x: &Formula| call(Function::Ln, x.clone());
        let right = match of {
            Formula::Binary(Operator::Multiply, a, b) => {
                self.positive(a)?;
                self.positive(b)?;
                plus(ln(a), ln(b))
            }
            Formula::Binary(Operator::Divide, a, b) => {
                self.positive(a)?;
                self.positive(b)?;
                minus(ln(a), ln(b))
            }
            Formula::Binary(Operator::Power, a, p) => {
                self.positive(a)?;
                self.finite(p)?;
                times((**p).clone(), ln(a))
            }
            Formula::Call(Function::Sqrt, parts) => {
                let a = parts.first()?;
                self.positive(a)?;
                over(ln(a), integer(2))
            }
            Formula::Call(Function::Exp, parts) => parts.first()?.clone(),
            _ => {
                let product = Factored::of(self, of)?.written()?;
                return self.logarithm_of(e, of, &product);
            }
        };
        self.step(Fact::Same(e.clone(), right), Rule::Logarithm, &[], &[])
    }

    /// The logarithm once its argument is written as this product.
    fn logarithm_of(&mut self, e: &Formula, of: &Formula, product: &Formula) -> Option<Step> {
        let step = self.ring(of, product, &[])?;
        let moved = call(Function::Ln, product.clone());
        let there = self.congruent(&call(Function::Ln, of.clone()), &moved, &[step])?;
        let next = self.expanded_logarithm(&moved, product)?;
        let right = self.right(next)?;
        self.chain(&[there, next], e, &right)
    }

    /// Logarithms of multiples of the arguments of others.
    pub(super) fn split_logarithms(&mut self, atoms: &[Formula]) -> Vec<Step> {
        let arguments: Vec<&Formula> = atoms
            .iter()
            .filter_map(|atom| match atom {
                Formula::Call(Function::Ln, parts) => parts.first(),
                _ => None,
            })
            .collect();
        let mut steps = Vec::new();
        for of in &arguments {
            let found = arguments.iter().find_map(|by| {
                let rest = self.quotient(of, by)?;
                self.attempt(|builder| {
                    let product = times((*by).clone(), rest.clone());
                    let e = call(Function::Ln, (*of).clone());
                    builder.positive(by)?;
                    builder.positive(&rest)?;
                    builder.logarithm_of(&e, of, &product)
                })
            });
            steps.extend(found);
        }
        steps
    }

    /// `e/by` where it is a polynomial of lower degree, or a smaller integer.
    fn quotient(&self, e: &Formula, by: &Formula) -> Option<Formula> {
        let mut field = self.field.borrow_mut();
        let (e, by) = (field.normal(e)?, field.normal(by)?);
        let (above, below) = (e.as_polynomial()?, by.as_polynomial()?);
        let number = |p: &crate::algebra::Polynomial| p.as_constant();
        if let (Some(a), Some(b)) = (number(above), number(below)) {
            let quotient = rug::Rational::from(&a / &b);
            let smaller = *quotient.denom() == 1 && quotient != 1 && b > 1;
            return smaller
                .then(|| super::form::number(&crate::number::convert::from_rug(&quotient)));
        }
        if number(below).is_some() || above == below {
            return None;
        }
        let quotient = above.div_exact(below, &field.budget).ok()??;
        Some(field.write_polynomial(&quotient))
    }
}
