//! Is an exact value zero, and what is its sign?
//!
//! Let b_1, ..., b_r be a coprime base without perfect powers. Theorems used, each after dividing
//! by common powers of the symbols (positive reals):
//! 1. Products of the b_i to rational exponents in [0, 1) are linearly independent over Q:
//!    a quotient of two such products is rational only if they are the same, and positive real
//!    radicals with pairwise irrational quotients are independent (Besicovitch 1940; Mordell 1953).
//! 2. ln b (b >= 2 an integer) and pi are transcendental (Hermite-Lindemann): a polynomial in one of
//!    them with algebraic coefficients, not all 0, is not 0. So is one in sqrt(pi).
//! 3. 1, pi, ln b_1, ..., ln b_r are linearly independent over the algebraic numbers
//!    (Baker 1966, Theorem 1): i*pi = ln(-1) and the ln b_i are independent over Q, because a
//!    product of coprime integers > 1 to integer powers, not all 0, is not 1.
//!
//! What formally vanishes is zero. What does not, and falls under none of the theorems, is told
//! from zero by an enclosure or not at all.

use super::Exact;
use super::coprime::searched;
use super::monomial::{Monomial, Symbol};
use crate::number::{Interval, Refined, refine};
use rug::Rational;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::convert::Infallible;

/// Bits at which enclosures start to look for a sign.
const FIRST_BITS: u32 = 64;

/// Bits up to which a value that may be 0 is looked at.
const CAP_IF_UNSURE: u32 = 1 << 12;

/// Bits up to which the sign of a value that is not 0 is sought.
const CAP_IF_NONZERO: u32 = 1 << 17;

impl Exact {
    /// Whether the value is zero; `None` where neither a theorem nor an enclosure can tell.
    pub fn is_zero(&self) -> Option<bool> {
        if self.terms.len() <= 1 {
            // A single term is a nonzero rational times positive reals.
            return Some(self.terms.is_empty());
        }
        if let Some(canonical) = self.over_one_base() {
            if canonical.terms.is_empty() {
                return Some(true);
            }
            if canonical.terms.len() == 1 || canonical.without_common_powers().is_independent() {
                return Some(false);
            }
        }
        self.sign_by_enclosure(CAP_IF_UNSURE).map(|_| false)
    }

    /// How the value compares with 0; `None` where [`Exact::is_zero`] cannot tell, or where its
    /// size is below all caps.
    pub fn sign(&self) -> Option<Ordering> {
        if let Some(constant) = self.as_rational() {
            return Some(constant.cmp0());
        }
        if let Some(sign) = self.sign_by_enclosure(FIRST_BITS * 4) {
            return Some(sign);
        }
        match self.is_zero()? {
            true => Some(Ordering::Equal),
            false => self.sign_by_enclosure(CAP_IF_NONZERO),
        }
    }

    /// An interval that holds the value.
    pub fn enclose(&self, precision: u32) -> Interval {
        let working = precision.saturating_add(32);
        let mut sum = Interval::from_i64(0, working);
        for (monomial, coefficient) in &self.terms {
            let size = monomial.enclose(working);
            sum = sum.add(&size.mul(&Interval::from_rational(coefficient, working)));
        }
        sum.with_precision(precision)
    }

    fn sign_by_enclosure(&self, cap: u32) -> Option<Ordering> {
        let compute = |bits| Ok::<_, Infallible>(Some(self.enclose(bits)));
        let known = |interval: &Interval| interval.sign().is_some();
        match refine(FIRST_BITS, cap, compute, known) {
            Ok(Refined::Decided(interval)) => interval.sign(),
            _ => None,
        }
    }

    /// The value times a positive real, over one coprime base and without negative powers, which
    /// could hide a zero.
    fn over_one_base(&self) -> Option<Exact> {
        self.without_common_powers().canonical()
    }

    /// The value divided by the least power of each symbol but roots that occurs in its terms.
    fn without_common_powers(&self) -> Exact {
        let mut least: BTreeMap<Symbol, Rational> = BTreeMap::new();
        for (symbol, _) in self.terms.keys().flat_map(Monomial::powers) {
            if !matches!(symbol, Symbol::Root(_)) && !least.contains_key(symbol) {
                let exponents = self.terms.keys().map(|monomial| monomial.exponent(symbol));
                least.insert(symbol.clone(), exponents.min().unwrap_or_default());
            }
        }
        let mut quotient = Exact::zero();
        for (monomial, coefficient) in &self.terms {
            let mut monomial = monomial.clone();
            for (symbol, exponent) in &least {
                monomial.multiply(symbol.clone(), &Rational::from(-exponent));
            }
            quotient.add_term(monomial, coefficient.clone());
        }
        quotient
    }

    /// Whether a theorem of the header says that a canonical, formally nonzero value is not zero.
    fn is_independent(&self) -> bool {
        let mut powers = self.terms.keys().flat_map(Monomial::powers);
        if powers.any(|(symbol, _)| matches!(symbol, Symbol::Root(n) if !searched(n))) {
            return false;
        }
        let transcendental = |symbol: &Symbol| !matches!(symbol, Symbol::Root(_));
        let symbols: BTreeSet<&Symbol> = self
            .terms
            .keys()
            .flat_map(Monomial::powers)
            .map(|(symbol, _)| symbol)
            .filter(|symbol| transcendental(symbol))
            .collect();
        // Theorems 1 and 2, then 3.
        symbols.len() <= 1 || self.terms.keys().all(is_linear)
    }
}

/// Whether a monomial is algebraic times 1, pi or one logarithm.
fn is_linear(monomial: &Monomial) -> bool {
    let mut degree = Rational::new();
    for (symbol, exponent) in monomial.powers() {
        match symbol {
            Symbol::Root(_) => {}
            Symbol::Ln(_) if *exponent == 1 => degree += 1,
            Symbol::SqrtPi if *exponent == 2 => degree += 1,
            _ => return false,
        }
    }
    degree <= 1
}
