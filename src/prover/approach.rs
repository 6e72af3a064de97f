//! How a variable tends somewhere, and rational functions as Laurent series there.

use super::Reason;
use crate::algebra::{Polynomial, RationalFunction, Series, Symbol, term_text};
use crate::formula::{Budget, Name};

/// From which side a finite point is approached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Above,
    Below,
    Both,
}

/// A variable that tends somewhere, told by the small quantity t of its series: `variable = 1/t` at
/// infinity, `a + t` above or around `a`, `a - t` below.
#[derive(Clone, Debug, PartialEq)]
pub enum Approach {
    Infinity(Name),
    Point(Name, Polynomial, Side),
}

/// The symbol of t. It is no name of the claim language, so nothing else is called so.
fn small() -> Symbol {
    "#t".into()
}

impl Approach {
    /// The variable that tends somewhere.
    pub fn variable(&self) -> &Name {
        match self {
            Approach::Infinity(name) | Approach::Point(name, _, _) => name,
        }
    }

    /// Whether t takes negative values too.
    pub fn two_sided(&self) -> bool {
        matches!(self, Approach::Point(_, _, Side::Both))
    }

    /// A polynomial as an exact Laurent series in t.
    ///
    /// # Errors
    /// The budget is spent, or the result is too large.
    pub fn polynomial(&self, value: &Polynomial, budget: &Budget) -> Result<Series, Reason> {
        let (moved, symbol, sign) = match self {
            Approach::Infinity(name) => (value.clone(), name.clone(), -1),
            Approach::Point(name, at, side) => {
                let step = match side {
                    Side::Below => Polynomial::symbol(&small()).neg(),
                    Side::Above | Side::Both => Polynomial::symbol(&small()),
                };
                (value.substitute(name, &at.add(&step), budget)?, small(), 1)
            }
        };
        let mut series = Series::zero();
        for (exponent, part) in moved.coefficients(&symbol) {
            let term = Series::term(part.into(), sign * i64::from(exponent));
            series = series.add(&term, budget)?;
        }
        Ok(series)
    }

    /// The symbol that stands for the logarithm of the quantity which [`Approach::sign_of_log`]
    /// relates to ln t: of the variable at infinity, of the distance at a point.
    pub fn log_symbol(&self) -> Symbol {
        format!("ln({})", self.base()).into()
    }

    /// -1 where the symbol of [`Approach::log_symbol`] is `-ln t`, else 1.
    pub fn sign_of_log(&self) -> i64 {
        match self {
            Approach::Infinity(_) => -1,
            Approach::Point(..) => 1,
        }
    }

    /// The quantity in powers of which the series is written.
    fn base(&self) -> String {
        match self {
            Approach::Infinity(name) => name.to_string(),
            Approach::Point(name, at, _) if at.is_zero() => name.to_string(),
            Approach::Point(name, at, Side::Below) => format!("({at} - {name})"),
            Approach::Point(name, at, _) => match at.len() {
                1 => format!("({name} - {at})"),
                _ => format!("({name} - ({at}))"),
            },
        }
    }

    /// `t^exponent` as text.
    pub fn power_text(&self, exponent: i64) -> String {
        self.term_text(&RationalFunction::one(), exponent)
    }

    /// `coefficient * t^exponent` as text.
    pub fn term_text(&self, coefficient: &RationalFunction, exponent: i64) -> String {
        let (negative, text) = self.signed_text(coefficient, exponent);
        if negative { format!("-{text}") } else { text }
    }

    fn signed_text(&self, coefficient: &RationalFunction, exponent: i64) -> (bool, String) {
        term_text(
            coefficient,
            &self.base(),
            exponent.saturating_mul(self.sign_of_log()),
        )
    }

    /// A series as text of the claim language, its remainder as `O(...)`; as `o(...)` of the order
    /// before where a power of the variable's logarithm may hide in it.
    pub fn series_text(&self, series: &Series, logarithmic: bool) -> String {
        let remainder = |order: i64| match logarithmic {
            true => format!("o({})", self.power_text(order.saturating_sub(1))),
            false => format!("O({})", self.power_text(order)),
        };
        let mut text = String::new();
        for (exponent, coefficient) in series.terms() {
            let (negative, term) = self.signed_text(coefficient, exponent);
            text.push_str(match (text.is_empty(), negative) {
                (true, true) => "-",
                (true, false) => "",
                (false, true) => " - ",
                (false, false) => " + ",
            });
            text.push_str(&term);
        }
        match (series.order(), text.is_empty()) {
            (Some(order), true) => remainder(order),
            (Some(order), false) => format!("{text} + {}", remainder(order)),
            (None, true) => "0".to_string(),
            (None, false) => text,
        }
    }
}
