//! An exact value as a formula of the claim language: `3/2 - 2*ln(2) + 5*ln(3)`.

use super::Exact;
use super::monomial::{Monomial, Symbol};
use rug::Rational;
use std::fmt;

impl fmt::Display for Exact {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.terms.is_empty() {
            return out.write_str("0");
        }
        for (index, (monomial, coefficient)) in self.terms.iter().enumerate() {
            let negative = coefficient.cmp0().is_lt();
            match (index, negative) {
                (0, false) => {}
                (0, true) => out.write_str("-")?,
                (_, false) => out.write_str(" + ")?,
                (_, true) => out.write_str(" - ")?,
            }
            write_term(out, monomial, &coefficient.clone().abs())?;
        }
        Ok(())
    }
}

/// A term with a positive coefficient.
fn write_term(out: &mut fmt::Formatter<'_>, monomial: &Monomial, size: &Rational) -> fmt::Result {
    if monomial.is_one() {
        return write!(out, "{size}");
    }
    let mut first = true;
    if *size != 1 {
        write!(out, "{size}")?;
        first = false;
    }
    for (symbol, exponent) in monomial.powers() {
        if !first {
            out.write_str("*")?;
        }
        first = false;
        match symbol {
            Symbol::SqrtPi => write_pi(out, exponent)?,
            Symbol::Root(radicand) => write_power(out, &radicand.to_string(), exponent)?,
            Symbol::Ln(integer) => write_power(out, &format!("ln({integer})"), exponent)?,
        }
    }
    Ok(())
}

fn write_pi(out: &mut fmt::Formatter<'_>, exponent: &Rational) -> fmt::Result {
    write_power(out, "pi", &Rational::from(exponent / 2))
}

fn write_power(out: &mut fmt::Formatter<'_>, base: &str, exponent: &Rational) -> fmt::Result {
    if *exponent == 1 {
        out.write_str(base)
    } else if *exponent == Rational::from((1, 2)) {
        write!(out, "sqrt({base})")
    } else if exponent.is_integer() && exponent.cmp0().is_gt() {
        write!(out, "{base}^{exponent}")
    } else {
        write!(out, "{base}^({exponent})")
    }
}
