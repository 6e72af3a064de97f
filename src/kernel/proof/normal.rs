//! Formulas as quotients of polynomials in their atoms: the normal form of rational arithmetic.
//!
//! An atom is whatever is not built by rational arithmetic: a name, `gamma(k)`, an integral. The
//! normal form says nothing of values: `x/x` is 1 here. It is used for formulas that are known to be
//! finite, part by part; then every divisor has a value other than 0 and the two agree.

use super::{Fuel, Proof, Rejected, reject, require};
use crate::formula::{Formula, Function, Name, Operator, Rational};
use num_traits::{One, ToPrimitive, Zero};
use std::collections::{BTreeMap, HashMap};

/// No power beyond this is expanded.
const EXPONENT_CAP: u64 = 200;
/// No atom or factor of a denominator gets a higher exponent.
const DEGREE_CAP: u32 = 1_000;
/// No coefficient gets much longer, in bits.
const BITS_CAP: u64 = 4_096;
/// No polynomial of more terms is made.
const TERMS_CAP: usize = 20_000;
/// Equations are not put into each other beyond this depth: they may run in a circle.
const REPLACEMENT_CAP: usize = 40;

/// What an atom is. Functions are told apart by the normal forms of their arguments: where the
/// value is finite so are those, and equal normal forms are equal numbers.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Atom {
    Factorial(Fraction),
    Power(Fraction, Fraction),
    Call(Function, Vec<Fraction>),
    Apply(Name, Vec<Fraction>),
    /// As it is written.
    Other(Formula),
}

/// The atoms of a proof, by number.
pub(super) type Atoms = HashMap<Atom, usize>;

/// Atoms with their exponents, all of them positive.
type Monomial = BTreeMap<usize, u32>;

/// A polynomial with rational coefficients, none of them zero.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Polynomial(BTreeMap<Monomial, Rational>);

impl Polynomial {
    fn constant(value: Rational) -> Polynomial {
        Polynomial::term(Monomial::new(), value)
    }

    fn term(monomial: Monomial, coefficient: Rational) -> Polynomial {
        let terms = [(monomial, coefficient)];
        Polynomial(terms.into_iter().filter(|(_, c)| !c.is_zero()).collect())
    }

    fn as_constant(&self) -> Option<Rational> {
        match self.0.first_key_value() {
            None => Some(Rational::zero()),
            Some((monomial, c)) if self.0.len() == 1 && monomial.is_empty() => Some(c.clone()),
            Some(_) => None,
        }
    }

    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    fn add_term(&mut self, monomial: Monomial, coefficient: Rational) {
        let entry = self.0.entry(monomial);
        let sum = entry.or_insert_with(Rational::zero);
        *sum += coefficient;
    }

    fn plus(mut self, other: &Polynomial) -> Polynomial {
        for (monomial, c) in &other.0 {
            self.add_term(monomial.clone(), c.clone());
        }
        self.0.retain(|_, c| !c.is_zero());
        self
    }

    /// The length of its longest coefficient.
    fn bits(&self) -> u64 {
        let bits = |c: &Rational| c.numer().bits() + c.denom().bits();
        self.0.values().map(bits).max().unwrap_or(0)
    }

    fn times(&self, other: &Polynomial, fuel: &Fuel) -> Result<Polynomial, Rejected> {
        let size = self.0.len().saturating_mul(other.0.len());
        require(size <= TERMS_CAP, "a polynomial with too many terms")?;
        let bits = self.bits() + other.bits();
        require(bits <= BITS_CAP, "a coefficient that is too large")?;
        fuel.spend(size as u64 * (1 + bits / 64))?;
        let mut product = Polynomial::default();
        for (m, c) in &self.0 {
            for (n, d) in &other.0 {
                let mut both = m.clone();
                raise(&mut both, n)?;
                product.add_term(both, c * d);
            }
        }
        product.0.retain(|_, c| !c.is_zero());
        Ok(product)
    }
}

/// Adds exponents.
fn raise<K: Ord + Clone>(
    powers: &mut BTreeMap<K, u32>,
    more: &BTreeMap<K, u32>,
) -> Result<(), Rejected> {
    for (factor, exponent) in more {
        let sum = powers.entry(factor.clone()).or_insert(0);
        *sum = sum.saturating_add(*exponent);
        require(*sum <= DEGREE_CAP, "an exponent that is too large")?;
    }
    Ok(())
}

/// A quotient: the product of the factors below, each to its exponent, is the denominator.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Fraction {
    above: Polynomial,
    below: BTreeMap<Polynomial, u32>,
}

impl Fraction {
    fn of(above: Polynomial) -> Fraction {
        Fraction {
            above,
            below: BTreeMap::new(),
        }
    }

    pub fn constant(value: Rational) -> Fraction {
        Fraction::of(Polynomial::constant(value))
    }

    pub fn is_zero(&self) -> bool {
        self.above.is_zero()
    }

    pub fn as_constant(&self) -> Option<Rational> {
        self.above
            .as_constant()
            .filter(|value| value.is_zero() || self.below.is_empty())
    }

    pub fn as_integer(&self) -> Option<i64> {
        self.as_constant().filter(Rational::is_integer)?.to_i64()
    }

    pub fn negated(&self) -> Fraction {
        let above = self.above.0.iter().map(|(m, c)| (m.clone(), -c)).collect();
        Fraction {
            above: Polynomial(above),
            below: self.below.clone(),
        }
    }

    /// The numerator over a denominator that has at least these factors.
    fn over(&self, below: &BTreeMap<Polynomial, u32>, fuel: &Fuel) -> Result<Polynomial, Rejected> {
        let mut above = self.above.clone();
        for (factor, exponent) in below {
            let own = self.below.get(factor).copied().unwrap_or(0);
            for _ in own..*exponent {
                above = above.times(factor, fuel)?;
            }
        }
        Ok(above)
    }

    /// The factors of both denominators.
    fn common(&self, other: &Fraction) -> BTreeMap<Polynomial, u32> {
        let mut below = self.below.clone();
        for (factor, exponent) in &other.below {
            let own = below.entry(factor.clone()).or_insert(0);
            *own = (*own).max(*exponent);
        }
        below
    }

    pub fn plus(&self, other: &Fraction, fuel: &Fuel) -> Result<Fraction, Rejected> {
        let below = self.common(other);
        let (a, b) = (self.over(&below, fuel)?, other.over(&below, fuel)?);
        let bits = a.bits() + b.bits();
        require(bits <= BITS_CAP, "a coefficient that is too large")?;
        fuel.spend(a.0.len().max(b.0.len()) as u64)?;
        Ok(Fraction {
            above: a.plus(&b),
            below,
        })
    }

    pub fn minus(&self, other: &Fraction, fuel: &Fuel) -> Result<Fraction, Rejected> {
        self.plus(&other.negated(), fuel)
    }

    fn times(&self, other: &Fraction, fuel: &Fuel) -> Result<Fraction, Rejected> {
        let mut below = self.below.clone();
        raise(&mut below, &other.below)?;
        let above = self.above.times(&other.above, fuel)?;
        Ok(Fraction { above, below })
    }

    /// One over it; a constant factor is kept above.
    fn inverse(&self, fuel: &Fuel) -> Result<Fraction, Rejected> {
        require(!self.is_zero(), "a division by what is 0")?;
        let one = Fraction::constant(Rational::one());
        let mut above = one.over(&self.below, fuel)?;
        if let Some(value) = self.above.as_constant() {
            above = above.times(&Polynomial::constant(value.recip()), fuel)?;
            return Ok(Fraction::of(above));
        }
        Ok(Fraction {
            above,
            below: BTreeMap::from([(self.above.clone(), 1)]),
        })
    }

    fn power(&self, exponent: i64, fuel: &Fuel) -> Result<Fraction, Rejected> {
        let times = exponent.unsigned_abs();
        require(times <= EXPONENT_CAP, "a power too high to expand")?;
        let base = if exponent < 0 {
            self.inverse(fuel)?
        } else {
            self.clone()
        };
        let mut result = Fraction::constant(Rational::one());
        for _ in 0..times {
            result = result.times(&base, fuel)?;
        }
        Ok(result)
    }

    /// Whether the two are equal as rational functions of their atoms.
    pub fn equals(&self, other: &Fraction, fuel: &Fuel) -> Result<bool, Rejected> {
        Ok(self.minus(other, fuel)?.is_zero())
    }
}

/// Equations, by the number of the atom on their left.
pub(super) type Equations = HashMap<usize, Formula>;

impl Proof<'_> {
    /// The normal form.
    pub(super) fn normal(&self, formula: &Formula) -> Result<Fraction, Rejected> {
        self.normal_with(formula, &Equations::new(), 0)
    }

    /// The normal form once every atom on the left of an equation is replaced by its right.
    pub(super) fn normal_with(
        &self,
        formula: &Formula,
        equations: &Equations,
        depth: usize,
    ) -> Result<Fraction, Rejected> {
        self.spend(1)?;
        require(depth <= REPLACEMENT_CAP, "equations that run in a circle")?;
        let fuel = &self.fuel;
        let normal = |part: &Formula| self.normal_with(part, equations, depth);
        match formula {
            Formula::Number(value) => Ok(Fraction::constant(value.clone())),
            Formula::Negate(a) => Ok(normal(a)?.negated()),
            Formula::Binary(Operator::Add, a, b) => normal(a)?.plus(&normal(b)?, fuel),
            Formula::Binary(Operator::Subtract, a, b) => normal(a)?.minus(&normal(b)?, fuel),
            Formula::Binary(Operator::Multiply, a, b) => normal(a)?.times(&normal(b)?, fuel),
            Formula::Binary(Operator::Divide, a, b) => {
                normal(a)?.times(&normal(b)?.inverse(fuel)?, fuel)
            }
            Formula::Binary(Operator::Power, a, b) => match normal(b)?.as_integer() {
                Some(exponent) => normal(a)?.power(exponent, fuel),
                None => self.atom(formula, equations, depth),
            },
            Formula::BigO(_) | Formula::LittleO(_) | Formula::Truth(_) | Formula::Infinity => {
                reject("what is no number in a number's place")
            }
            _ => self.atom(formula, equations, depth),
        }
    }

    /// An atom: what an equation puts for it, with or without the equations applied to its
    /// arguments, or else itself.
    fn atom(
        &self,
        formula: &Formula,
        equations: &Equations,
        depth: usize,
    ) -> Result<Fraction, Rejected> {
        let mut number = self.atom_number(formula, &Equations::new(), depth)?;
        if !equations.is_empty() {
            if !equations.contains_key(&number) {
                number = self.atom_number(formula, equations, depth)?;
            }
            if let Some(right) = equations.get(&number) {
                return self.normal_with(right, equations, depth + 1);
            }
        }
        let monomial = Monomial::from([(number, 1)]);
        Ok(Fraction::of(Polynomial::term(monomial, Rational::one())))
    }

    /// The number of an atom.
    pub(super) fn atom_number(
        &self,
        formula: &Formula,
        equations: &Equations,
        depth: usize,
    ) -> Result<usize, Rejected> {
        let normal = |part: &Formula| self.normal_with(part, equations, depth);
        let all = |parts: &[Formula]| parts.iter().map(normal).collect::<Result<_, _>>();
        let atom = match formula {
            Formula::Factorial(a) => Atom::Factorial(normal(a)?),
            Formula::Binary(Operator::Power, a, b) => Atom::Power(normal(a)?, normal(b)?),
            Formula::Call(function, parts) => Atom::Call(*function, all(parts)?),
            Formula::Apply(name, parts) => Atom::Apply(name.clone(), all(parts)?),
            _ => Atom::Other(formula.clone()),
        };
        let mut atoms = self.atoms.borrow_mut();
        let next = atoms.len();
        Ok(*atoms.entry(atom).or_insert(next))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// A product takes a step for each pair of terms, times the words of its coefficients.
    #[test]
    fn products_are_paid_for() {
        let power_of_two = |bits: u32| Rational::from_integer(2.into()).pow(bits as i32);
        let monomial = |atom| Monomial::from([(atom, 1)]);
        let sum = |bits| {
            let one = Polynomial::term(monomial(0), Rational::one());
            one.plus(&Polynomial::term(monomial(1), power_of_two(bits)))
        };
        for (left, right, steps) in [
            (sum(0), sum(1), 4),
            (sum(62), sum(62), 4 * (1 + 2)),
            (sum(62), Polynomial::constant(Rational::one()), 2 * (1 + 1)),
        ] {
            let fuel = Fuel(Cell::new(100));
            assert!(left.times(&right, &fuel).is_ok());
            assert_eq!(fuel.0.get(), 100 - steps);
        }
    }
}
