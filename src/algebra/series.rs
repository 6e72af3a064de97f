//! Truncated Laurent series in one small variable t.
//!
//! A series is `c_v t^v + ... + O(t^N)`: coefficients are rational functions of everything else, and
//! without a remainder the sum is exact and finite. Coefficients may hold the logarithm of t as a
//! symbol; "O(t^N)" then means `O(t^N |ln t|^j)` for some j, which every operation preserves. Who
//! compares orders must therefore look at terms, and keep N above the order compared with.

use super::{AlgebraError, RationalFunction};
use crate::formula::Budget;
use rug::Rational;
use std::collections::BTreeMap;

/// More relative terms than this are refused.
const MAX_TERMS: i64 = 4096;

/// A Laurent series; see the file's head.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    coefficients: BTreeMap<i64, RationalFunction>,
    order: Option<i64>,
}

impl Series {
    /// 0, exactly.
    pub fn zero() -> Series {
        Series {
            coefficients: BTreeMap::new(),
            order: None,
        }
    }

    /// `coefficient * t^exponent`
    pub fn term(coefficient: RationalFunction, exponent: i64) -> Series {
        let mut series = Series::zero();
        if !coefficient.is_zero() {
            series.coefficients.insert(exponent, coefficient);
        }
        series
    }

    /// A constant in t.
    pub fn constant(value: RationalFunction) -> Series {
        Series::term(value, 0)
    }

    /// `O(t^order)`
    pub fn remainder(order: i64) -> Series {
        Series {
            coefficients: BTreeMap::new(),
            order: Some(order),
        }
    }

    /// The terms, lowest exponent first; all coefficients are nonzero.
    pub fn terms(&self) -> impl Iterator<Item = (i64, &RationalFunction)> {
        self.coefficients
            .iter()
            .map(|(exponent, value)| (*exponent, value))
    }

    /// The exponent of the remainder; nothing for an exact sum.
    pub fn order(&self) -> Option<i64> {
        self.order
    }

    /// The lowest term that is known to be there.
    pub fn leading(&self) -> Option<(i64, &RationalFunction)> {
        self.terms().next()
    }

    /// Whether this is exactly zero.
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty() && self.order.is_none()
    }

    /// The coefficient of a power.
    pub fn coefficient(&self, exponent: i64) -> Option<&RationalFunction> {
        self.coefficients.get(&exponent)
    }

    /// A lower bound of all exponents, the remainder's included; nothing for 0.
    pub fn valuation(&self) -> Option<i64> {
        self.leading().map(|(exponent, _)| exponent).or(self.order)
    }

    /// Forgets all terms from an exponent on.
    pub fn truncate(mut self, order: i64) -> Series {
        let cut = self.coefficients.split_off(&order);
        if !cut.is_empty() || self.order.is_some_and(|old| old > order) {
            self.order = Some(order);
        }
        self
    }

    /// The sum.
    ///
    /// # Errors
    /// The budget is spent, or the result is too large; so for all operations below.
    pub fn add(&self, other: &Series, budget: &Budget) -> Result<Series, AlgebraError> {
        let mut coefficients = self.coefficients.clone();
        for (exponent, value) in &other.coefficients {
            let sum = match coefficients.remove(exponent) {
                Some(old) => old.add(value, budget)?,
                None => value.clone(),
            };
            if !sum.is_zero() {
                coefficients.insert(*exponent, sum);
            }
        }
        let order = self.order.into_iter().chain(other.order).min();
        if let Some(order) = order {
            coefficients.split_off(&order);
        }
        Ok(Series {
            coefficients,
            order,
        })
    }

    /// The negative.
    pub fn neg(&self) -> Series {
        let terms = self.coefficients.iter();
        Series {
            coefficients: terms
                .map(|(exponent, value)| (*exponent, value.neg()))
                .collect(),
            order: self.order,
        }
    }

    /// The difference.
    ///
    /// # Errors
    /// As for [`Series::add`].
    pub fn sub(&self, other: &Series, budget: &Budget) -> Result<Series, AlgebraError> {
        self.add(&other.neg(), budget)
    }

    /// The product.
    ///
    /// # Errors
    /// As for [`Series::add`].
    pub fn mul(&self, other: &Series, budget: &Budget) -> Result<Series, AlgebraError> {
        let (Some(left), Some(right)) = (self.valuation(), other.valuation()) else {
            return Ok(Series::zero());
        };
        let shifted = |order: Option<i64>, by| order.map(|order| order.saturating_add(by));
        let order = shifted(self.order, right)
            .into_iter()
            .chain(shifted(other.order, left))
            .min();
        let mut product = Series {
            coefficients: BTreeMap::new(),
            order,
        };
        for (i, a) in self.terms() {
            for (j, b) in other.terms() {
                let exponent = i.checked_add(j).ok_or(AlgebraError::TooLarge)?;
                if order.is_none_or(|order| exponent < order) {
                    product.accumulate(exponent, &a.mul(b, budget)?, budget)?;
                }
            }
        }
        Ok(product)
    }

    fn accumulate(
        &mut self,
        exponent: i64,
        value: &RationalFunction,
        budget: &Budget,
    ) -> Result<(), AlgebraError> {
        let sum = match self.coefficients.remove(&exponent) {
            Some(old) => old.add(value, budget)?,
            None => value.clone(),
        };
        if !sum.is_zero() {
            self.coefficients.insert(exponent, sum);
        }
        Ok(())
    }

    /// The product with a rational function of the other symbols.
    ///
    /// # Errors
    /// As for [`Series::add`].
    pub fn scale(&self, by: &RationalFunction, budget: &Budget) -> Result<Series, AlgebraError> {
        self.mul(&Series::constant(by.clone()), budget)
    }

    /// The product with a power of t.
    pub fn shift(&self, by: i64) -> Series {
        let terms = self.coefficients.iter();
        let terms = terms.map(|(exponent, value)| (exponent.saturating_add(by), value.clone()));
        Series {
            coefficients: terms.collect(),
            order: self.order.map(|order| order.saturating_add(by)),
        }
    }

    /// Splits into `c * t^v * (1 + y)`: the coefficients of `1 + y` up to (not including) a relative
    /// exponent of at most `terms`, and whether all of `y` was told.
    fn normal(&self, terms: i64, budget: &Budget) -> Result<Normal, AlgebraError> {
        let Some((exponent, lead)) = self.leading() else {
            return Err(match self.order {
                None => AlgebraError::DivisionByZero,
                Some(_) => AlgebraError::TooFewTerms,
            });
        };
        if terms > MAX_TERMS {
            return Err(AlgebraError::TooLarge);
        }
        let known = self
            .order
            .map_or(i64::MAX, |order| order.saturating_sub(exponent));
        let inverse = lead.recip(budget)?;
        let mut tail = Vec::new();
        for relative in 0..terms.min(known) {
            let value = self.coefficient(exponent.saturating_add(relative));
            let value = value.map(|value| value.mul(&inverse, budget)).transpose()?;
            tail.push(value.unwrap_or_else(RationalFunction::zero));
        }
        Ok(Normal {
            exponent,
            lead: lead.clone(),
            tail,
            single: self.coefficients.len() == 1 && self.order.is_none(),
        })
    }

    fn dense(values: Vec<RationalFunction>) -> Series {
        let order = i64::try_from(values.len()).unwrap_or(i64::MAX);
        let terms = (0..).zip(values).filter(|(_, value)| !value.is_zero());
        Series {
            coefficients: terms.collect(),
            order: Some(order),
        }
    }

    /// A power with a constant exponent that may hold symbols, of the part `1 + y` of
    /// `c * t^v * (1 + y)`, to `terms` relative terms; `c` and `v` are told apart.
    ///
    /// # Errors
    /// As for [`Series::add`]; [`AlgebraError::TooFewTerms`] when the leading term is not known.
    pub fn unit_power(
        &self,
        exponent: &RationalFunction,
        terms: i64,
        budget: &Budget,
    ) -> Result<Series, AlgebraError> {
        let normal = self.normal(terms, budget)?;
        if normal.single {
            return Ok(Series::constant(RationalFunction::one()));
        }
        // (1 + y)^r = sum p_n t^n with n p_n = sum_{i=1..n} (r i - (n - i)) y_i p_{n-i}.
        let mut power: Vec<RationalFunction> = Vec::new();
        for n in 0..normal.tail.len() {
            let mut sum = RationalFunction::zero();
            for i in 1..=n {
                let (index, rest) = (signed(i), signed(n - i));
                let weight = exponent.mul(&RationalFunction::integer(index), budget)?;
                let weight = weight.add(&RationalFunction::integer(-rest), budget)?;
                let term = weight
                    .mul(&normal.tail[i], budget)?
                    .mul(&power[n - i], budget)?;
                sum = sum.add(&term, budget)?;
            }
            power.push(match n {
                0 => RationalFunction::one(),
                _ => sum.mul(
                    &RationalFunction::constant(Rational::from((1, signed(n)))),
                    budget,
                )?,
            });
        }
        Ok(Series::dense(power))
    }

    /// An integer power, to `terms` relative terms where it does not end by itself.
    ///
    /// # Errors
    /// As for [`Series::unit_power`]; [`AlgebraError::DivisionByZero`] for a negative power of 0.
    pub fn powi(&self, exponent: i64, terms: i64, budget: &Budget) -> Result<Series, AlgebraError> {
        if exponent == 0 {
            return Ok(Series::constant(RationalFunction::one()));
        }
        if (1..=4).contains(&exponent) {
            let mut power = self.clone();
            for _ in 1..exponent {
                power = power.mul(self, budget)?;
            }
            return Ok(power);
        }
        if self.is_zero() && exponent > 0 {
            return Ok(Series::zero());
        }
        let normal = self.normal(1, budget)?;
        let unit = self.unit_power(&RationalFunction::integer(exponent), terms, budget)?;
        let shift = normal
            .exponent
            .checked_mul(exponent)
            .ok_or(AlgebraError::TooLarge)?;
        Ok(unit
            .scale(&normal.lead.powi(exponent, budget)?, budget)?
            .shift(shift))
    }

    /// `ln(1 + y)` for the part `1 + y` of `c * t^v * (1 + y)`, to `terms` terms.
    ///
    /// # Errors
    /// As for [`Series::unit_power`].
    pub fn unit_ln(&self, terms: i64, budget: &Budget) -> Result<Series, AlgebraError> {
        let normal = self.normal(terms, budget)?;
        if normal.single {
            return Ok(Series::zero());
        }
        // n y_n = sum_{i=1..n} i L_i y_{n-i}, solved for L_n.
        let mut logarithm: Vec<RationalFunction> = Vec::new();
        for n in 0..normal.tail.len() {
            let mut sum = RationalFunction::zero();
            for i in 1..n {
                let weight = RationalFunction::constant(Rational::from((-signed(i), signed(n))));
                let term = logarithm[i]
                    .mul(&normal.tail[n - i], budget)?
                    .mul(&weight, budget)?;
                sum = sum.add(&term, budget)?;
            }
            logarithm.push(match n {
                0 => RationalFunction::zero(),
                _ => sum.add(&normal.tail[n], budget)?,
            });
        }
        Ok(Series::dense(logarithm))
    }

    /// `exp(y)` for a series that tends to 0, to `terms` terms; nothing when it does not.
    ///
    /// # Errors
    /// As for [`Series::add`].
    pub fn exp(&self, terms: i64, budget: &Budget) -> Result<Option<Series>, AlgebraError> {
        let one = Series::constant(RationalFunction::one());
        match self.valuation() {
            None => return Ok(Some(one)),
            Some(valuation) if valuation < 1 => return Ok(None),
            Some(_) => {}
        }
        let (mut sum, mut power) = (one.clone(), one);
        // The j-th power has valuation j at least, so the loop ends at `terms`.
        for j in 1..terms.clamp(1, MAX_TERMS) {
            let weight = RationalFunction::constant(Rational::from((1, j)));
            power = power
                .mul(self, budget)?
                .scale(&weight, budget)?
                .truncate(terms);
            sum = sum.add(&power, budget)?;
        }
        Ok(Some(sum.add(&Series::remainder(terms), budget)?))
    }
}

struct Normal {
    exponent: i64,
    lead: RationalFunction,
    /// The coefficients of `1 + y`, from t^0 on.
    tail: Vec<RationalFunction>,
    /// `y` is exactly 0.
    single: bool,
}

/// An index as a signed number; series are far shorter than either type.
fn signed(index: usize) -> i64 {
    i64::try_from(index).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn budget() -> Budget {
        Budget::new(1 << 32)
    }

    fn polynomial(values: &[i64]) -> Series {
        let w = budget();
        (0..)
            .zip(values)
            .fold(Series::zero(), |sum, (exponent, value)| {
                let term = Series::term(RationalFunction::integer(*value), exponent);
                sum.add(&term, &w).expect("small")
            })
    }

    fn equal_to(series: &Series, other: &Series, order: i64) -> bool {
        let difference = series.sub(other, &budget()).expect("small").truncate(order);
        difference.leading().is_none() && difference.order().is_none_or(|known| known >= order)
    }

    proptest! {
        #[test]
        fn powers_invert(values in proptest::collection::vec(-4i64..5, 1..5), head in 1i64..4) {
            let mut values = values;
            values[0] = head;
            let (series, w) = (polynomial(&values), budget());
            let inverse = series.powi(-1, 9, &w).expect("a unit");
            let one = polynomial(&[1]);
            prop_assert!(equal_to(&series.mul(&inverse, &w).expect("small"), &one, 9));
            let high = series.powi(6, 9, &w).expect("small");
            let cube = series.powi(3, 9, &w).expect("small");
            prop_assert!(equal_to(&cube.mul(&cube, &w).expect("small"), &high, 9));
        }

        #[test]
        fn exp_inverts_ln(values in proptest::collection::vec(-4i64..5, 1..5)) {
            let mut values = values;
            values[0] = 1;
            let (series, w) = (polynomial(&values), budget());
            let logarithm = series.unit_ln(8, &w).expect("a unit");
            let back = logarithm.exp(8, &w).expect("small").expect("tends to 0");
            prop_assert!(equal_to(&back, &series, 8));
        }

        #[test]
        fn a_root_squares(values in proptest::collection::vec(-4i64..5, 1..5)) {
            let mut values = values;
            values[0] = 1;
            let (series, w) = (polynomial(&values), budget());
            let half = RationalFunction::constant(Rational::from((1, 2)));
            let root = series.unit_power(&half, 8, &w).expect("a unit");
            prop_assert!(equal_to(&root.mul(&root, &w).expect("small"), &series, 8));
        }

        /// The remainder is what it says: |1/(a + b t) - sum| <= C t^N at small rational t.
        #[test]
        fn a_truncation_is_close(a in 1i64..5, b in -5i64..6, scale in 2i64..5) {
            let w = budget();
            let sum = polynomial(&[a, b]).powi(-1, 6, &w).expect("a unit");
            let t = Rational::from((1, 10i64.pow(u32::try_from(scale).expect("small"))));
            let mut value = Rational::new();
            for (exponent, coefficient) in sum.terms() {
                let mut term = coefficient.as_constant().expect("a number");
                for _ in 0..exponent { term *= &t; }
                value += term;
            }
            let exact = Rational::from(1) / (Rational::from(a) + Rational::from(b) * &t);
            let mut bound = Rational::from(100_000);
            for _ in 0..6 { bound *= &t; }
            prop_assert!((exact - value).abs() <= bound);
        }
    }

    #[test]
    fn a_product_with_a_remainder_knows_its_order() {
        let w = budget();
        let series = Series::term(RationalFunction::one(), 2).add(&Series::remainder(5), &w);
        let square = series.and_then(|s| s.mul(&s, &w)).expect("small");
        assert_eq!(square.order(), Some(7));
    }
}
