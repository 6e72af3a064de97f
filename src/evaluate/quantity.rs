//! What exact evaluation computes with: a closed number, or a function of the variables of integration
//! around, as a sum of products of one rational function for each variable:
//!
//! ```text
//! sum over terms of  coefficient * f_1(x_1) * ... * f_n(x_n),    coefficient exact, f_i in Q(x_i)
//! ```
//!
//! At rational parameters an integrand is nearly always a single term; roots, logarithms and pi make
//! further ones.

use super::closed::{plus, rational, sign, times, to_power};
use super::fraction::Fraction;
use super::{Failure, Outcome, undecided, unsupported};
use crate::formula::Budget;
use crate::number::Exact;
use rug::Rational;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A variable of integration, numbered as they are bound, so that no two share a name.
pub(super) type Symbol = u32;

/// A power of a sum is expanded up to so many terms.
const MAX_TERMS: usize = 4096;

/// A number or a function of variables of integration.
#[derive(Clone, Debug)]
pub(super) enum Quantity {
    Closed(Exact),
    Open(Separable),
}

/// A sum of terms.
#[derive(Clone, Debug)]
pub(super) struct Separable {
    pub terms: Vec<Term>,
}

/// A product of rational functions of different variables, none of them constant.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub coefficient: Exact,
    pub factors: BTreeMap<Symbol, Fraction>,
}

impl Term {
    fn constant(coefficient: Exact) -> Term {
        Term {
            coefficient,
            factors: BTreeMap::new(),
        }
    }

    /// Multiplies one variable's function in; a constant one joins the coefficient.
    pub fn multiply_factor(
        &mut self,
        symbol: Symbol,
        by: &Fraction,
        budget: &Budget,
    ) -> Result<(), Failure> {
        let product = match self.factors.get(&symbol) {
            Some(factor) => factor.multiply(by, budget)?,
            None => by.clone(),
        };
        match product.as_constant() {
            Some(constant) => {
                self.factors.remove(&symbol);
                self.coefficient = times(&self.coefficient, &rational(constant), budget)?;
            }
            None => {
                self.factors.insert(symbol, product);
            }
        }
        Ok(())
    }

    fn multiply(&self, other: &Term, budget: &Budget) -> Result<Term, Failure> {
        let mut product = self.clone();
        product.coefficient = times(&self.coefficient, &other.coefficient, budget)?;
        for (symbol, factor) in &other.factors {
            product.multiply_factor(*symbol, factor, budget)?;
        }
        Ok(product)
    }

    /// The sum as one term, if both differ in one variable only and have rational coefficients.
    fn merge(&self, other: &Term, budget: &Budget) -> Result<Option<Term>, Failure> {
        let (Some(left), Some(right)) = (
            self.coefficient.as_rational(),
            other.coefficient.as_rational(),
        ) else {
            return Ok(None);
        };
        let names: std::collections::BTreeSet<Symbol> = self
            .factors
            .keys()
            .chain(other.factors.keys())
            .copied()
            .collect();
        let mut differing = names
            .into_iter()
            .filter(|symbol| self.factors.get(symbol) != other.factors.get(symbol));
        let one = Fraction::constant(Rational::from(1));
        let Some(symbol) = differing.next() else {
            let sum = rational(left + right);
            return Ok(Some(Term {
                coefficient: sum,
                factors: self.factors.clone(),
            }));
        };
        if differing.next().is_some() {
            return Ok(None);
        }
        let a = self
            .factors
            .get(&symbol)
            .unwrap_or(&one)
            .clone()
            .scale(&left);
        let b = other
            .factors
            .get(&symbol)
            .unwrap_or(&one)
            .clone()
            .scale(&right);
        let mut sum = self.clone();
        sum.coefficient = rational(Rational::from(1));
        sum.factors.remove(&symbol);
        sum.multiply_factor(symbol, &a.add(&b, budget)?, budget)?;
        Ok(Some(sum))
    }
}

impl Separable {
    pub fn symbol(symbol: Symbol) -> Separable {
        Separable::single(symbol, Fraction::variable())
    }

    /// A function of one variable.
    pub fn single(symbol: Symbol, function: Fraction) -> Separable {
        let term = match function.as_constant() {
            Some(constant) => Term::constant(rational(constant)),
            None => Term {
                coefficient: rational(Rational::from(1)),
                factors: BTreeMap::from([(symbol, function)]),
            },
        };
        Separable { terms: vec![term] }
    }

    /// Whether the variable occurs.
    pub fn mentions(&self, symbol: Symbol) -> bool {
        self.terms
            .iter()
            .any(|term| term.factors.contains_key(&symbol))
    }

    /// The variable that this is.
    pub fn as_symbol(&self) -> Option<Symbol> {
        let [term] = &self.terms[..] else {
            return None;
        };
        let (symbol, factor) = term.factors.first_key_value()?;
        let plain = term.factors.len() == 1 && *factor == Fraction::variable();
        let one = term.coefficient.as_rational().is_some_and(|c| c == 1);
        (plain && one).then_some(*symbol)
    }

    /// Whether this is the variable itself.
    pub fn is_symbol(&self, symbol: Symbol) -> bool {
        self.as_symbol() == Some(symbol)
    }

    /// One more term.
    pub fn push(&mut self, term: Term, budget: &Budget) -> Result<(), Failure> {
        budget.spend(1)?;
        if term.coefficient.is_zero() == Some(true) {
            return Ok(());
        }
        for index in 0..self.terms.len() {
            if let Some(sum) = self.terms[index].merge(&term, budget)? {
                self.terms.swap_remove(index);
                return match sum.coefficient.is_zero() {
                    Some(true) => Ok(()),
                    _ => self.push(sum, budget),
                };
            }
        }
        if self.terms.len() >= MAX_TERMS {
            return Err(Failure::TooLarge("a sum of products".into()));
        }
        self.terms.push(term);
        Ok(())
    }

    /// A number again, when no variable is left.
    pub fn simplified(self) -> Quantity {
        let closed = match &self.terms[..] {
            [] => Some(rational(Rational::new())),
            [term] if term.factors.is_empty() => Some(term.coefficient.clone()),
            _ => None,
        };
        closed.map_or(Quantity::Open(self), Quantity::Closed)
    }

    fn add(mut self, other: Separable, budget: &Budget) -> Result<Separable, Failure> {
        for term in other.terms {
            self.push(term, budget)?;
        }
        Ok(self)
    }

    fn multiply(&self, other: &Separable, budget: &Budget) -> Result<Separable, Failure> {
        let mut product = Separable { terms: vec![] };
        for left in &self.terms {
            for right in &other.terms {
                product.push(left.multiply(right, budget)?, budget)?;
            }
        }
        Ok(product)
    }

    /// An integer power. A negative one needs a single term with a coefficient known not to be 0.
    fn power(&self, exponent: i64, budget: &Budget) -> Result<Separable, Failure> {
        if let [term] = &self.terms[..] {
            let mut power = Term::constant(to_power(&term.coefficient, exponent, budget)?);
            for (symbol, factor) in &term.factors {
                power.multiply_factor(*symbol, &factor.power(exponent, budget)?, budget)?;
            }
            return Ok(Separable { terms: vec![power] });
        }
        let count = u32::try_from(exponent)
            .map_err(|_| unsupported("a quotient by a sum of unlike terms"))?;
        if count > 256 {
            return Err(Failure::TooLarge("a power of a sum of unlike terms".into()));
        }
        let one = Term::constant(rational(Rational::from(1)));
        let mut result = Separable { terms: vec![one] };
        for _ in 0..count {
            result = result.multiply(self, budget)?;
        }
        Ok(result)
    }

    /// The value at rational places of the variables; `None` at a pole.
    pub fn at<'q>(
        &self,
        place: impl Fn(Symbol) -> Option<&'q Rational>,
        budget: &Budget,
    ) -> Result<Option<Exact>, Failure> {
        let mut sum = rational(Rational::new());
        for term in &self.terms {
            let mut value = term.coefficient.clone();
            for (symbol, factor) in &term.factors {
                let x = place(*symbol)
                    .ok_or_else(|| unsupported("a condition on this variable of integration"))?;
                let Some(factor) = factor.at(x, budget)? else {
                    return Ok(None);
                };
                value = times(&value, &rational(factor), budget)?;
            }
            sum = plus(&sum, &value, budget)?;
        }
        Ok(Some(sum))
    }
}

impl Quantity {
    pub fn rational(value: Rational) -> Quantity {
        Quantity::Closed(rational(value))
    }

    /// A function of one variable.
    pub fn function(symbol: Symbol, function: Fraction) -> Quantity {
        Separable::single(symbol, function).simplified()
    }

    /// The rational function over Q of one variable and nothing else that this is.
    pub fn single_function(&self, symbol: Symbol) -> Option<Fraction> {
        match self {
            Quantity::Closed(value) => Some(Fraction::constant(value.as_rational()?)),
            Quantity::Open(function) => {
                let term = match &function.terms[..] {
                    [] => return Some(Fraction::constant(Rational::new())),
                    [term] => term,
                    _ => return None,
                };
                let scale = term.coefficient.as_rational()?;
                if term.factors.is_empty() {
                    return Some(Fraction::constant(scale));
                }
                let factor = term.factors.get(&symbol)?;
                (term.factors.len() == 1).then(|| factor.clone().scale(&scale))
            }
        }
    }

    /// The number.
    ///
    /// # Errors
    /// [`Failure::Unsupported`] for a function of a variable of integration; `what` says where.
    pub fn closed(self, what: &str) -> Result<Exact, Failure> {
        match self {
            Quantity::Closed(value) => Ok(value),
            Quantity::Open(_) => Err(unsupported(format!("{what} of a variable of integration"))),
        }
    }

    pub fn open(self) -> Separable {
        match self {
            Quantity::Closed(value) => Separable {
                terms: vec![Term::constant(value)],
            },
            Quantity::Open(function) => function,
        }
    }

    pub fn negate(self, budget: &Budget) -> Result<Quantity, Failure> {
        Quantity::rational(Rational::from(-1)).multiply(self, budget)
    }

    pub fn add(self, other: Quantity, budget: &Budget) -> Result<Quantity, Failure> {
        if let (Quantity::Closed(a), Quantity::Closed(b)) = (&self, &other) {
            return Ok(Quantity::Closed(plus(a, b, budget)?));
        }
        Ok(self.open().add(other.open(), budget)?.simplified())
    }

    pub fn multiply(self, other: Quantity, budget: &Budget) -> Result<Quantity, Failure> {
        if let (Quantity::Closed(a), Quantity::Closed(b)) = (&self, &other) {
            return Ok(Quantity::Closed(times(a, b, budget)?));
        }
        Ok(self.open().multiply(&other.open(), budget)?.simplified())
    }

    /// The integer power; `x^0` is 1, a negative power of 0 has no value.
    pub fn power(self, exponent: i64, budget: &Budget) -> Result<Outcome<Quantity>, Failure> {
        if exponent == 0 {
            return Ok(Outcome::Value(Quantity::rational(Rational::from(1))));
        }
        match self {
            Quantity::Closed(value) => {
                if exponent < 0 {
                    match value.is_zero() {
                        Some(true) => return Ok(Outcome::Undefined),
                        None => return Err(undecided("whether a divisor is 0")),
                        Some(false) => {}
                    }
                }
                Ok(Outcome::Value(Quantity::Closed(to_power(
                    &value, exponent, budget,
                )?)))
            }
            Quantity::Open(function) => {
                let power = function.power(exponent, budget)?;
                Ok(Outcome::Value(power.simplified()))
            }
        }
    }

    /// The sign of a number.
    pub fn sign(&self) -> Result<Ordering, Failure> {
        match self {
            Quantity::Closed(value) => sign(value),
            Quantity::Open(_) => Err(unsupported("the sign of an integrand")),
        }
    }
}
