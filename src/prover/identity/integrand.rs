//! Integrands as products: a factor free of the variable, and powers of what depends on it.

use super::make::{add, depends, div, int, is_one, is_zero, mul, pow, sub};
use super::rational::Algebra;
use crate::formula::{Formula, Name, Operator};

/// `coefficient * product of base^exponent`, the bases depending on the variable.
#[derive(Clone, Debug)]
pub(super) struct Product {
    pub coefficient: Formula,
    pub factors: Vec<(Formula, Formula)>,
}

impl Product {
    /// Takes a formula apart. Equal bases are joined.
    pub fn of(e: &Formula, x: &Name, algebra: &mut Algebra) -> Product {
        let mut parts = Vec::new();
        flatten(e, &int(1), &mut parts);
        let mut product = Product {
            coefficient: int(1),
            factors: Vec::new(),
        };
        let (mut above, mut below) = (int(1), int(1));
        for (base, exponent) in parts {
            if depends(&base, x) || depends(&exponent, x) {
                product.join(base, exponent, algebra);
                continue;
            }
            match algebra.integer(&exponent) {
                Some(n) if n < 0 => below = mul(below, pow(base, int(-n))),
                _ => above = mul(above, pow(base, exponent)),
            }
        }
        product.coefficient = div(above, below);
        product
    }

    fn join(&mut self, base: Formula, exponent: Formula, algebra: &mut Algebra) {
        let like = |(own, _): &&mut (Formula, Formula)| *own == base || algebra.same(own, &base);
        match self.factors.iter_mut().find(like) {
            Some((_, own)) => *own = add(own.clone(), exponent),
            None => self.factors.push((base, exponent)),
        }
        for (_, own) in &mut self.factors {
            *own = algebra.tidy(own);
        }
    }

    /// The product of the factors that depend on the variable.
    pub fn core(&self) -> Formula {
        product_of(&self.factors)
    }

    /// Whether every exponent is an integer by arithmetic.
    pub fn is_rational(&self, algebra: &mut Algebra) -> bool {
        let mut factors = self.factors.iter();
        factors.all(|(base, exponent)| {
            algebra.integer(exponent).is_some() && is_plain(base, algebra)
        })
    }
}

/// Whether a base is made by rational arithmetic with number exponents.
fn is_plain(e: &Formula, algebra: &mut Algebra) -> bool {
    match e {
        Formula::Binary(Operator::Power, a, b) => {
            algebra.integer(b).is_some() && is_plain(a, algebra)
        }
        Formula::Binary(_, a, b) => is_plain(a, algebra) && is_plain(b, algebra),
        Formula::Negate(a) => is_plain(a, algebra),
        _ => true,
    }
}

/// The product of powers, those with negative numbers as exponents below the line.
pub(super) fn product_of(factors: &[(Formula, Formula)]) -> Formula {
    let (mut above, mut below) = (int(1), int(1));
    for (base, exponent) in factors {
        match exponent {
            _ if is_zero(exponent) => {}
            Formula::Negate(n) if matches!(**n, Formula::Number(_)) => {
                below = mul(below, pow(base.clone(), (**n).clone()));
            }
            _ => above = mul(above, pow(base.clone(), exponent.clone())),
        }
    }
    div(above, below)
}

/// Collects the factors of `e^exponent`.
fn flatten(e: &Formula, exponent: &Formula, parts: &mut Vec<(Formula, Formula)>) {
    let whole = is_whole(exponent);
    match e {
        Formula::Number(_) if is_one(e) => {}
        Formula::Negate(a) if whole => {
            parts.push((Formula::Negate(Box::new(int(1))), exponent.clone()));
            flatten(a, exponent, parts);
        }
        Formula::Binary(Operator::Multiply, a, b) if whole => {
            flatten(a, exponent, parts);
            flatten(b, exponent, parts);
        }
        Formula::Binary(Operator::Divide, a, b) if whole => {
            flatten(a, exponent, parts);
            flatten(b, &opposite(exponent), parts);
        }
        Formula::Binary(Operator::Power, a, b) if whole && is_whole(b) => {
            flatten(a, &times(exponent, b), parts);
        }
        Formula::Binary(Operator::Power, a, b) if is_one(exponent) => {
            parts.push(((**a).clone(), (**b).clone()));
        }
        Formula::Binary(Operator::Power, a, b) if whole => {
            parts.push(((**a).clone(), times(exponent, b)));
        }
        _ => parts.push((e.clone(), exponent.clone())),
    }
}

/// Whether it is a whole number as it stands.
fn is_whole(e: &Formula) -> bool {
    whole(e).is_some()
}

fn whole(e: &Formula) -> Option<i64> {
    match e {
        Formula::Number(value) if value.is_integer() => value.numer().try_into().ok(),
        Formula::Negate(a) => whole(a)?.checked_neg(),
        Formula::Binary(Operator::Subtract, a, b) => whole(a)?.checked_sub(whole(b)?),
        Formula::Binary(Operator::Add, a, b) => whole(a)?.checked_add(whole(b)?),
        _ => None,
    }
}

fn signed(n: i64) -> Formula {
    match n < 0 {
        true => Formula::Negate(Box::new(int(-n))),
        false => int(n),
    }
}

fn opposite(e: &Formula) -> Formula {
    match whole(e) {
        Some(n) => signed(-n),
        None => sub(int(0), e.clone()),
    }
}

fn times(a: &Formula, b: &Formula) -> Formula {
    match (whole(a), whole(b)) {
        (Some(n), Some(m)) => signed(n.saturating_mul(m)),
        _ => mul(a.clone(), b.clone()),
    }
}
