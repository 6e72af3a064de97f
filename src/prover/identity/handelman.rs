//! Positive polynomials as sums of products of what is known to be nonnegative.
//!
//! `p = c0 + sum of c[i]*(product of relations)` with nonnegative rationals c, found by linear
//! programming. (Handelman: on a polytope every positive polynomial is such a sum, if the products
//! may be long enough; here they are short.)

use super::field::Field;
use super::form::{number, plus, times};
use super::simplex::solve;
use crate::algebra::{Monomial, Polynomial};
use crate::formula::Formula;
use crate::number::convert::from_rug;
use rug::Rational;
use std::collections::BTreeSet;

/// No larger linear program is set up.
const COLUMNS: usize = 160;

/// A polynomial that is known to be nonnegative, or positive where strict.
#[derive(Clone, Debug)]
pub(super) struct Generator {
    pub polynomial: Polynomial,
    pub written: Formula,
    pub strict: bool,
}

/// The goal as a sum of products of at most so many generators, none of a degree above the cap; of its
/// terms, in the strict case, one is positive and comes first.
pub(super) fn show(
    goal: &Polynomial,
    generators: &[Generator],
    strict: bool,
    (factors, cap): (usize, u32),
    field: &Field,
) -> Option<Formula> {
    let products = products(generators, factors, cap, field)?;
    let monomials: BTreeSet<&Monomial> = products
        .iter()
        .map(|product| &product.polynomial)
        .chain([goal])
        .flat_map(|polynomial| polynomial.terms().map(|(monomial, _)| monomial))
        .collect();
    let column = |polynomial: &Polynomial, last: i64| -> Vec<Rational> {
        let mut column: Vec<Rational> = monomials
            .iter()
            .map(|monomial| coefficient(polynomial, monomial))
            .collect();
        if strict {
            column.push(Rational::from(last));
        }
        column
    };
    let mut columns: Vec<_> = products
        .iter()
        .map(|product| column(&product.polynomial, product.strict.into()))
        .collect();
    let scale = match strict {
        // s*goal = sum, where the strict products weigh at least 1 together.
        true => {
            columns.push(column(&goal.neg(), 0));
            columns.push(column(&Polynomial::zero(), -1));
            let weights = solve(&columns, &column(&Polynomial::zero(), 1))?;
            let scale = weights[products.len()].clone();
            if scale == 0 {
                return None;
            }
            (weights, scale)
        }
        false => (solve(&columns, &column(goal, 0))?, Rational::from(1)),
    };
    write(&products, &scale.0, &scale.1)
}

fn write(products: &[Generator], weights: &[Rational], scale: &Rational) -> Option<Formula> {
    let used = products.iter().zip(weights).filter(|(_, w)| **w != 0);
    let mut terms: Vec<(&Generator, Rational)> = used
        .map(|(product, weight)| (product, Rational::from(weight / scale)))
        .collect();
    terms.sort_by_key(|(product, _)| !product.strict);
    let written = terms.into_iter().map(|(product, weight)| {
        let one = weight == 1;
        let weight = number(&from_rug(&weight));
        match (product.polynomial.as_constant().is_some(), one) {
            (true, _) => weight,
            (false, true) => product.written.clone(),
            (false, false) => times(weight, product.written.clone()),
        }
    });
    written.reduce(plus)
}

/// 1 and all products of so many generators whose degree is not above the cap.
fn products(
    generators: &[Generator],
    factors: usize,
    cap: u32,
    field: &Field,
) -> Option<Vec<Generator>> {
    let one = Generator {
        polynomial: Polynomial::one(),
        written: Formula::integer(1),
        strict: true,
    };
    let mut all = vec![one];
    let mut last: Vec<(usize, Generator)> = Vec::new();
    for (at, generator) in generators.iter().enumerate() {
        if degree(&generator.polynomial) <= cap.max(1) {
            last.push((at, generator.clone()));
        }
    }
    for _ in 0..factors {
        all.extend(last.iter().map(|(_, product)| product.clone()));
        if all.len() > COLUMNS {
            return None;
        }
        let mut longer = Vec::new();
        for (at, product) in &last {
            for (next, generator) in generators.iter().enumerate().skip(*at) {
                let length = degree(&product.polynomial) + degree(&generator.polynomial);
                if length > cap || all.len() + longer.len() > COLUMNS {
                    continue;
                }
                let polynomial = product.polynomial.mul(&generator.polynomial, &field.budget);
                longer.push((
                    next,
                    Generator {
                        polynomial: polynomial.ok()?,
                        written: times(product.written.clone(), generator.written.clone()),
                        strict: product.strict && generator.strict,
                    },
                ));
            }
        }
        last = longer;
    }
    Some(all)
}

fn coefficient(polynomial: &Polynomial, monomial: &Monomial) -> Rational {
    let mut terms = polynomial.terms();
    let found = terms.find(|(other, _)| *other == monomial);
    found.map_or_else(Rational::new, |(_, value)| value.clone())
}

/// The total degree.
pub(super) fn degree(polynomial: &Polynomial) -> u32 {
    let terms = polynomial.terms();
    let degrees = terms.map(|(monomial, _)| monomial.powers().iter().map(|(_, e)| e).sum());
    degrees.max().unwrap_or(0)
}
