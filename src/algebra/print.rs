//! Algebra as text of the claim language.

use super::{Monomial, Polynomial, RationalFunction};
use rug::Rational;
use std::fmt::{Display, Formatter, Result};

fn power_text(base: &str, exponent: u32) -> String {
    match exponent {
        1 => base.to_string(),
        _ => format!("{base}^{exponent}"),
    }
}

fn monomial_factors(monomial: &Monomial) -> Vec<String> {
    let powers = monomial.powers().iter();
    powers
        .map(|(symbol, exponent)| power_text(symbol, *exponent))
        .collect()
}

/// Terms by falling total degree, as people write them.
fn ordered(polynomial: &Polynomial) -> Vec<(&Monomial, &Rational)> {
    let mut terms: Vec<_> = polynomial.terms().rev().collect();
    let degree = |m: &Monomial| m.powers().iter().map(|(_, e)| u64::from(*e)).sum::<u64>();
    terms.sort_by_key(|(monomial, _)| std::cmp::Reverse(degree(monomial)));
    terms
}

fn sum_text(polynomial: &Polynomial) -> String {
    let mut text = String::new();
    for (monomial, coefficient) in ordered(polynomial) {
        let (negative, size) = (*coefficient < 0, coefficient.clone().abs());
        text.push_str(match (text.is_empty(), negative) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        });
        text.push_str(&product_text(&size, monomial_factors(monomial), &[]));
    }
    match text.is_empty() {
        true => "0".to_string(),
        false => text,
    }
}

/// `size * above / below` with the fraction of `size` spread over both.
fn product_text(size: &Rational, above: Vec<String>, below: &[String]) -> String {
    let mut above = above;
    if above.is_empty() || *size.numer() != 1 {
        above.insert(0, size.numer().to_string());
    }
    let mut below = below.to_vec();
    if *size.denom() != 1 {
        below.insert(0, size.denom().to_string());
    }
    match below.len() {
        0 => above.join("*"),
        1 => format!("{}/{}", above.join("*"), below[0]),
        _ => format!("{}/({})", above.join("*"), below.join("*")),
    }
}

fn atom_text(atom: &Polynomial) -> String {
    match atom.len() {
        1 => sum_text(atom),
        _ => format!("({})", sum_text(atom)),
    }
}

/// `coefficient * base^exponent` as one signed term: whether it is negative, and its size.
pub fn term_text(coefficient: &RationalFunction, base: &str, exponent: i64) -> (bool, String) {
    let (content, primitive) = coefficient.numerator().primitive();
    let common = primitive.monomial_content();
    let mut rest = Polynomial::zero();
    for (monomial, value) in primitive.terms() {
        rest.add_term(monomial.div(&common).unwrap_or_default(), value.clone());
    }
    // The sign of the term that is written first, so that none begins with a minus.
    let flip = ordered(&rest).first().is_some_and(|(_, value)| **value < 0);
    let (content, rest) = match flip {
        true => (-content, rest.neg()),
        false => (content, rest),
    };
    let mut above = monomial_factors(&common);
    if rest.as_constant().is_none() {
        above.push(atom_text(&rest));
    }
    let atoms = coefficient.denominator().iter();
    let mut below: Vec<String> = atoms.map(|(a, e)| power_text(&atom_text(a), *e)).collect();
    let size = u32::try_from(exponent.unsigned_abs()).unwrap_or(u32::MAX);
    match exponent.signum() {
        1 => above.push(power_text(base, size)),
        -1 => below.push(power_text(base, size)),
        _ => {}
    }
    (content < 0, product_text(&content.abs(), above, &below))
}

impl Display for Polynomial {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(&sum_text(self))
    }
}

impl Display for RationalFunction {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        let plain = self.denominator().is_empty() && self.numerator().monomial_content().is_one();
        if plain {
            return f.write_str(&sum_text(self.numerator()));
        }
        let (negative, text) = term_text(self, "", 0);
        f.write_str(if negative { "-" } else { "" })?;
        f.write_str(&text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Budget;

    #[test]
    fn a_term_reads_as_written() {
        let w = Budget::new(100_000);
        let symbol = |name: &str| RationalFunction::symbol(&name.into());
        let rest = symbol("m")
            .sub(&symbol("v"), &w)
            .and_then(|d| d.add(&RationalFunction::one(), &w));
        let top = symbol("I")
            .mul(&symbol("l"), &w)
            .and_then(|t| t.mul(&rest?, &w));
        let below = symbol("m").add(&RationalFunction::one(), &w);
        let value = top.and_then(|t| t.div(&below?, &w)).expect("small");
        assert_eq!(
            term_text(&value.neg(), "k", -2),
            (true, "I*l*(m - v + 1)/((m + 1)*k^2)".into())
        );
        assert_eq!(value.neg().to_string(), "-I*l*(m - v + 1)/(m + 1)");
    }

    #[test]
    fn a_fraction_is_spread_over_both_parts() {
        let value = RationalFunction::constant(Rational::from((-3, 4)));
        assert_eq!(term_text(&value, "x", 1), (true, "3*x/4".into()));
        assert_eq!(value.to_string(), "-3/4");
    }
}
