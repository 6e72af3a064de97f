//! Order between powers with the same exponent, and between a power and 1.

use super::builder::Builder;
use super::form::{integer, minus, power};
use crate::algebra::{Polynomial, Symbol};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule};
use std::collections::BTreeSet;

impl Builder<'_> {
    /// A difference of two powers with the same exponent, one of which may be 1.
    pub(super) fn show_powers(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        let (_, primitive) = p.primitive();
        let terms: Vec<_> = primitive.terms().collect();
        let [one, other] = terms.as_slice() else {
            return None;
        };
        if one.1.clone().abs() != 1 || other.1.clone().abs() != 1 {
            return None;
        }
        // The signs are those of p itself.
        let positive = |monomial| p.terms().any(|(own, c)| own == monomial && *c > 0);
        let (high, low) = match (positive(one.0), positive(other.0)) {
            (true, false) => (one.0, other.0),
            (false, true) => (other.0, one.0),
            _ => return None,
        };
        let single = |powers: &[(Symbol, u32)]| match powers {
            [] => Some(None),
            [(symbol, 1)] => self.as_power(symbol).map(Some),
            _ => None,
        };
        let (high, low) = (single(high.powers())?, single(low.powers())?);
        let exponent = match (&high, &low) {
            (Some((_, p)), Some((_, q))) if self.field.borrow_mut().same(p, q) => p.clone(),
            (Some((_, p)), None) | (None, Some((_, p))) => p.clone(),
            _ => return None,
        };
        let base = |side: &Option<(Formula, Formula)>| {
            side.as_ref()
                .map_or_else(|| integer(1), |(base, _)| base.clone())
        };
        let (high, low) = (base(&high), base(&low));
        self.attempt(|builder| {
            builder.compare_powers(&low, &high, &exponent, strict)?;
            builder.show_related(p, strict)
        })
    }

    /// `low^p < high^p` or `<=`, with 1 for a power of 1.
    pub(super) fn compare_powers(
        &mut self,
        low: &Formula,
        high: &Formula,
        p: &Formula,
        strict: bool,
    ) -> Option<()> {
        self.finite(p)?;
        self.positive(p)?;
        self.nonnegative(low)?;
        let width = minus(high.clone(), low.clone());
        let relation = match strict {
            true => {
                self.positive(&width)?;
                Fact::Less
            }
            false => {
                self.nonnegative(&width)?;
                Fact::AtMost
            }
        };
        let (below, above) = (
            power(low.clone(), p.clone()),
            power(high.clone(), p.clone()),
        );
        let fact = relation(below.clone(), above.clone());
        self.step(fact, Rule::PowerOrder, &[], &[])?;
        let one = integer(1);
        if *low != one && *high != one {
            return Some(());
        }
        let trivial = power(one.clone(), p.clone());
        let equation = Fact::Same(trivial.clone(), one.clone());
        let equation = self.step(equation, Rule::Power, &[], &[])?;
        let shown = minus(above.clone(), below.clone());
        let fact = match *low == one {
            true => relation(one, above),
            false => relation(below, one),
        };
        self.step(fact, Rule::Order, &[equation], &[shown])?;
        Some(())
    }

    /// The base and the exponent of an atom that is a power.
    fn as_power(&self, symbol: &Symbol) -> Option<(Formula, Formula)> {
        match self.field.borrow().formula(symbol) {
            Formula::Binary(Operator::Power, base, exponent) => Some((*base, *exponent)),
            _ => None,
        }
    }

    /// Makes it known of the roots among these atoms that they are at most 1, where they are.
    pub(super) fn bound_powers(&mut self, symbols: &BTreeSet<Symbol>) {
        for symbol in symbols {
            let atom = self.field.borrow().formula(symbol);
            let root = matches!(
                atom,
                Formula::Call(Function::Sqrt, _) | Formula::Binary(Operator::Power, ..)
            );
            if root {
                self.nonnegative(&minus(integer(1), atom));
            }
        }
    }
}
