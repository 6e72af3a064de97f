//! Polynomials of degree 1 in a variable that runs between numbers.

use super::builder::Builder;
use super::form::{plus, times};
use crate::algebra::{Polynomial, Symbol};
use crate::formula::Formula;
use crate::kernel::proof::Fact;

impl Builder<'_> {
    /// `p = d*q + r`, d being the distance of a variable from one of its ends: q has one sign, and r
    /// is the value at that end.
    pub(super) fn show_bounded(&mut self, p: &Polynomial, strict: bool) -> Option<Formula> {
        let distances: Vec<(Symbol, Polynomial)> = self
            .relations()
            .filter(|relation| !matches!(relation.fact, Fact::Different(..)))
            .filter_map(|relation| {
                let distance = relation.difference.as_polynomial()?;
                let x = distance.symbols().into_iter().next()?;
                let fits = p.degree(&x) == 1 && self.variable(&x).is_some();
                fits.then(|| (x, distance.clone()))
            })
            .collect();
        distances.into_iter().find_map(|(x, distance)| {
            let (q, r) = divided(p, &x, &distance)?;
            let q = self.show_polynomial(&q, false)?;
            let r = self.show_polynomial(&r, strict)?;
            let distance = self.field.borrow().write_polynomial(&distance);
            Some(plus(r, times(distance, q)))
        })
    }
}

/// `p = distance*q + r` with r free of x, where the distance is `c*x + d` for numbers c and d.
fn divided(p: &Polynomial, x: &Symbol, distance: &Polynomial) -> Option<(Polynomial, Polynomial)> {
    let slope = |p: &Polynomial| p.coefficients(x).get(&1).cloned();
    let still = |p: &Polynomial| p.coefficients(x).get(&0).cloned().unwrap_or_default();
    let c = slope(distance)?.as_constant()?;
    let d = still(distance).as_constant()?;
    let q = slope(p)?.scale(&c.recip());
    let r = still(p).sub(&q.scale(&d));
    // What has a number as its slope is left to the sums of relations.
    (distance.degree(x) == 1 && q.as_constant().is_none()).then_some((q, r))
}
