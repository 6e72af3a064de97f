//! Signs of polynomials on the domain of a proposition.
//!
//! Relations of the domain that are linear in some parameter give it lower bounds: `l <= m` says
//! `m = l + m'` with `m' >= 0`. When every symbol of a polynomial has been replaced so, by its bound
//! plus a nonnegative rest, nonnegative coefficients show that it is nonnegative, and a positive
//! coefficient of a product of positive rests that it is positive. The test is sufficient only.

use super::Reason;
use crate::algebra::{Monomial, Polynomial, RationalFunction, Symbol};
use crate::formula::{Budget, Condition, Formula, ParameterKind, Proposition, Relation};
use rug::Rational;
use std::collections::BTreeSet;

/// What is to be shown of a polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    Positive,
    NonNegative,
    NonZero,
}

/// `symbol >= bound` or, when strict, `symbol > bound`.
#[derive(Clone, Debug, PartialEq)]
struct LowerBound {
    symbol: Symbol,
    bound: Polynomial,
    strict: bool,
}

/// `difference >= 0`, or `> 0` when strict.
#[derive(Clone, Debug, PartialEq)]
pub struct Inequality {
    pub difference: Polynomial,
    pub strict: bool,
}

/// What the domain says of signs.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    integers: BTreeSet<Symbol>,
    inequalities: Vec<Inequality>,
    bounds: Vec<LowerBound>,
    /// Conditions that are no inequality between rational functions.
    unread: usize,
}

/// So many choices among several lower bounds of a symbol are tried.
const MAX_CHOICES: usize = 64;

impl Facts {
    /// Reads the domain of a proposition. What it cannot use it leaves out.
    ///
    /// # Errors
    /// The budget is spent.
    pub fn of(proposition: &Proposition, budget: &Budget) -> Result<Facts, Reason> {
        let parameters = proposition.parameters.iter();
        let integers = parameters.filter(|parameter| parameter.kind == ParameterKind::Integer);
        let mut facts = Facts {
            integers: integers.map(|parameter| parameter.name.clone()).collect(),
            ..Facts::default()
        };
        for condition in &proposition.domain {
            facts.assume(condition, budget)?;
        }
        let pi = LowerBound {
            symbol: "pi".into(),
            bound: Polynomial::zero(),
            strict: true,
        };
        facts.bounds.push(pi);
        Ok(facts)
    }

    /// The inequalities that were read.
    pub fn inequalities(&self) -> &[Inequality] {
        &self.inequalities
    }

    /// Whether every condition of the domain is among [`Facts::inequalities`].
    pub fn complete(&self) -> bool {
        self.unread == 0
    }

    /// Whether a symbol takes integer values only.
    pub fn is_integer(&self, symbol: &str) -> bool {
        self.integers.contains(symbol)
    }

    fn assume(&mut self, condition: &Condition, budget: &Budget) -> Result<(), Reason> {
        match condition {
            Condition::And(parts) => parts.iter().try_for_each(|part| self.assume(part, budget)),
            Condition::Chain(first, links) => {
                let mut left = first;
                for (relation, right) in links {
                    self.assume_link(left, *relation, right, budget)?;
                    left = right;
                }
                Ok(())
            }
            Condition::Or(_) | Condition::Not(_) => {
                self.unread += 1;
                Ok(())
            }
        }
    }

    fn assume_link(
        &mut self,
        left: &Formula,
        relation: Relation,
        right: &Formula,
        budget: &Budget,
    ) -> Result<(), Reason> {
        let sides = (plain(left, budget), plain(right, budget));
        let (Ok(left), Ok(right)) = sides else {
            self.unread += 1;
            return Ok(());
        };
        let up = right.sub(&left, budget)?;
        // A denominator that is a positive number only was absorbed; any other is not read.
        let Some(up) = up.as_polynomial().cloned() else {
            self.unread += 1;
            return Ok(());
        };
        match relation {
            Relation::Less => self.assume_sign(up, true),
            Relation::LessEqual => self.assume_sign(up, false),
            Relation::Greater => self.assume_sign(up.neg(), true),
            Relation::GreaterEqual => self.assume_sign(up.neg(), false),
            Relation::Equal => {
                self.assume_sign(up.neg(), false);
                self.assume_sign(up, false);
            }
            _ => self.unread += 1,
        }
        Ok(())
    }

    /// Takes `difference >= 0` (`> 0` when strict) as given.
    pub fn assume_sign(&mut self, difference: Polynomial, strict: bool) {
        for symbol in difference.symbols() {
            let parts = difference.coefficients(&symbol);
            let head = parts.get(&1).and_then(Polynomial::as_constant);
            let (Some(head), 1) = (head, difference.degree(&symbol)) else {
                continue;
            };
            if head > 0 {
                let rest = parts.get(&0).cloned().unwrap_or_default();
                let bound = rest.scale(&-Rational::from(head.recip_ref()));
                self.bounds.push(self.lower_bound(symbol, bound, strict));
            }
        }
        self.inequalities.push(Inequality { difference, strict });
    }

    /// Between integers `a > b` is `a >= b + 1`.
    fn lower_bound(&self, symbol: Symbol, bound: Polynomial, strict: bool) -> LowerBound {
        let whole = bound.terms().all(|(_, value)| value.is_integer())
            && bound
                .symbols()
                .iter()
                .all(|other| self.integers.contains(other));
        match strict && whole && self.integers.contains(&symbol) {
            true => LowerBound {
                symbol,
                bound: bound.add(&Polynomial::one()),
                strict: false,
            },
            false => LowerBound {
                symbol,
                bound,
                strict,
            },
        }
    }

    /// Whether the sign is shown on the whole domain.
    ///
    /// # Errors
    /// The budget is spent, or the result is too large.
    pub fn shows(&self, sign: Sign, value: &Polynomial, budget: &Budget) -> Result<bool, Reason> {
        if let Some(value) = value.as_constant() {
            return Ok(match sign {
                Sign::Positive => value > 0,
                Sign::NonNegative => value >= 0,
                Sign::NonZero => value != 0,
            });
        }
        match sign {
            Sign::Positive => self.bounded_below(value, true, budget),
            Sign::NonNegative => self.bounded_below(value, false, budget),
            Sign::NonZero => self.nonzero(value, budget),
        }
    }

    fn nonzero(&self, value: &Polynomial, budget: &Budget) -> Result<bool, Reason> {
        let (content, factors) = RationalFunction::from(value.clone()).factored(budget)?;
        if content == 0 {
            return Ok(false);
        }
        for factor in factors.keys() {
            let shown = self.bounded_below(factor, true, budget)?
                || self.bounded_below(&factor.neg(), true, budget)?;
            if !shown {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn bounded_below(
        &self,
        value: &Polynomial,
        strict: bool,
        budget: &Budget,
    ) -> Result<bool, Reason> {
        let mut tries = MAX_CHOICES;
        let start = Shifted {
            value: value.clone(),
            positive: BTreeSet::new(),
            done: Vec::new(),
        };
        self.search(&start, strict, &mut tries, budget)
    }

    /// Replaces one symbol after the other by each of its bounds, then looks at the coefficients.
    fn search(
        &self,
        state: &Shifted,
        strict: bool,
        tries: &mut usize,
        budget: &Budget,
    ) -> Result<bool, Reason> {
        if state.is_bounded_below(strict) {
            return Ok(true);
        }
        let open = state.value.symbols();
        let Some(symbol) = open.iter().find(|symbol| !symbol.starts_with('#')) else {
            return Ok(false);
        };
        // Symbols on which others' bounds rest must be replaced after these.
        for symbol in std::iter::once(symbol).chain(open.iter().filter(|s| *s != symbol)) {
            for bound in self.bounds.iter().filter(|bound| bound.symbol == *symbol) {
                let circular = bound.bound.symbols().iter().any(|s| state.done.contains(s));
                if circular || *tries == 0 {
                    continue;
                }
                *tries -= 1;
                if self.search(&state.replace(bound, budget)?, strict, tries, budget)? {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }
}

struct Shifted {
    value: Polynomial,
    /// Rests that are positive, not just nonnegative.
    positive: BTreeSet<Symbol>,
    /// Symbols that were replaced.
    done: Vec<Symbol>,
}

impl Shifted {
    fn replace(&self, bound: &LowerBound, budget: &Budget) -> Result<Shifted, Reason> {
        let rest: Symbol = format!("#{}", bound.symbol).into();
        let by = bound.bound.add(&Polynomial::symbol(&rest));
        let (mut positive, mut done) = (self.positive.clone(), self.done.clone());
        if bound.strict {
            positive.insert(rest);
        }
        done.push(bound.symbol.clone());
        let value = self.value.substitute(&bound.symbol, &by, budget)?;
        Ok(Shifted {
            value,
            positive,
            done,
        })
    }

    fn is_bounded_below(&self, strict: bool) -> bool {
        let fits = |monomial: &Monomial, value: &Rational| {
            *value > 0
                && monomial
                    .powers()
                    .iter()
                    .all(|(symbol, _)| symbol.starts_with('#'))
        };
        let certain = |monomial: &Monomial| {
            monomial
                .powers()
                .iter()
                .all(|(symbol, _)| self.positive.contains(symbol))
        };
        self.value
            .terms()
            .all(|(monomial, value)| fits(monomial, value))
            && (!strict || self.value.terms().any(|(monomial, _)| certain(monomial)))
    }
}

/// A formula of field operations and integer powers on names, as a rational function.
pub(super) fn plain(formula: &Formula, budget: &Budget) -> Result<RationalFunction, Reason> {
    RationalFunction::from_formula(formula, budget)?
        .ok_or_else(|| Reason::Unsupported("a condition on more than field operations".into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_bounds_what_stands_on_its_right() {
        let integers = ["k", "l", "m", "n"].map(Symbol::from);
        let mut facts = Facts {
            integers: integers.into(),
            ..Facts::default()
        };
        let (k, l, m) = (["k", "l", "m"].map(|s| Polynomial::symbol(&s.into()))).into();
        let n = Polynomial::symbol(&"n".into());
        facts.assume_sign(l.sub(&Polynomial::one()), false);
        facts.assume_sign(m.sub(&l), false);
        facts.assume_sign(k.sub(&l), true);
        facts.assume_sign(n.sub(&k), false);
        let w = Budget::new(1 << 24);
        let shows = |sign, value: &Polynomial| facts.shows(sign, value, &w).expect("small");
        assert!(shows(Sign::Positive, &m.sub(&l).add(&Polynomial::one())));
        assert!(shows(Sign::NonNegative, &m.sub(&l)));
        assert!(!shows(Sign::Positive, &m.sub(&l)));
        assert!(shows(Sign::Positive, &k.sub(&l)));
        assert!(shows(Sign::NonZero, &l.sub(&n)));
        assert!(!shows(Sign::NonZero, &k.sub(&m)));
        assert!(!shows(
            Sign::Positive,
            &k.sub(&Polynomial::integer(2)).sub(&l)
        ));
    }
}
