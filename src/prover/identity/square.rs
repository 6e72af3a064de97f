//! What is positive once its roots are raised to their powers, and quadratics that are so as a square
//! and a rest.

use super::builder::Builder;
use super::form::{integer, number, plus, power, times};
use super::make::parts;
use crate::algebra::Polynomial;
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule, Step};
use crate::number::convert::from_rug;
use rug::Rational;

impl Builder<'_> {
    /// `0 < e`, which is so once its roots are raised to their powers.
    pub(super) fn show_raised(&mut self, e: &Formula) -> Option<()> {
        has_root(e).then_some(())?;
        let (raised, same) = self.without_roots(e)?;
        if self.field.borrow_mut().same(e, &raised) {
            return None;
        }
        self.positive(&raised)?;
        self.show_same(&raised, e, same)
    }

    /// `0 < a*x^2 + b*x + c` as `a*(x + b/(2*a))^2 + (c - b^2/(4*a))`, roots standing in b or c.
    pub(super) fn show_square(&mut self, e: &Formula) -> Option<()> {
        let p = self.field.borrow_mut().normal(e)?.as_polynomial()?.clone();
        let mut names = p.symbols().into_iter().filter(|s| !s.starts_with('@'));
        let x = names.find(|x| p.degree(x) == 2).filter(|_| has_root(e))?;
        let coefficients = p.coefficients(&x);
        let of = |j: u32| coefficients.get(&j).cloned().unwrap_or_default();
        let a = of(2).as_constant().filter(|a| *a > 0)?;
        let shift = of(1).scale(&Rational::from(2 * &a).recip());
        let square = shift.mul(&shift, &self.field.borrow().budget).ok()?;
        let write = |b: &Self, p: &Polynomial| b.field.borrow().write_polynomial(p);
        let rest = write(self, &of(0).sub(&square.scale(&a)));
        let (rest, _) = self.without_roots(&rest)?;
        self.positive(&rest)?;
        let base = plus(Formula::Name(x), write(self, &shift));
        let square = times(number(&from_rug(&a)), power(base, integer(2)));
        let shown = plus(square, rest);
        self.finite(&shown)?;
        let same = self.equal(&shown, e)?;
        self.show_same(&shown, e, same)
    }

    /// `0 < e`, as `0 < shown` is known by its structure and the step says that they are equal.
    fn show_same(&mut self, shown: &Formula, e: &Formula, same: Step) -> Option<()> {
        let positive = |e: &Formula| Fact::Less(integer(0), e.clone());
        let sign = self.step(positive(shown), Rule::Order, &[], &[])?;
        self.step(positive(e), Rule::Chain, &[sign, same], &[])?;
        Some(())
    }
}

/// Whether a root, or a power whose exponent is a quotient, stands in the formula.
fn has_root(e: &Formula) -> bool {
    match e {
        Formula::Call(Function::Sqrt, _) => true,
        Formula::Binary(Operator::Power, _, b)
            if matches!(**b, Formula::Binary(Operator::Divide, ..)) =>
        {
            true
        }
        _ => parts(e).into_iter().any(has_root),
    }
}
