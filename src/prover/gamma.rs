//! Products of Gamma functions whose quotients are rational, and hypergeometric series of a small
//! argument.
//!
//! `Gamma(z + s) = z (z+1) ... (z+s-1) Gamma(z)` (DLMF 5.5.1, 5.2.5): in a product, the arguments
//! that differ by integers are brought to the least of them, whose powers must then cancel. Every
//! Gamma is asked to have a positive argument, which is more than it needs.

use super::Reason;
use super::domain::Sign;
use super::expansion::{Expander, Scope, Value, unsupported};
use crate::algebra::{RationalFunction, Series};
use crate::formula::{Formula, Function, Operator};
use rug::Rational;

/// Shifts of a Gamma function beyond this are refused.
const MAX_SHIFT: i64 = 512;

/// Powers of products beyond this are not taken factor by factor; sums of smaller ones do not overflow.
const MAX_POWER: u64 = 1 << 32;

/// A product under construction: a value and powers of Gamma functions.
struct Product {
    value: Value,
    gammas: Vec<(RationalFunction, i64)>,
}

impl Expander<'_> {
    /// The value of a product, a quotient or one of the functions made of Gamma functions.
    pub(super) fn product(&self, formula: &Formula, scope: &Scope) -> Result<Value, Reason> {
        let one = Value::Exact(RationalFunction::one());
        let mut product = Product {
            value: one,
            gammas: Vec::new(),
        };
        self.collect(formula, 1, scope, &mut product)?;
        let rational = self.cancel(product.gammas)?;
        self.multiply(&product.value, &Value::Exact(rational))
    }

    /// Multiplies `formula^power` into the product, power being 1 or -1 or a product of exponents.
    fn collect(
        &self,
        formula: &Formula,
        power: i64,
        scope: &Scope,
        product: &mut Product,
    ) -> Result<(), Reason> {
        self.budget.spend(1)?;
        match formula {
            Formula::Binary(Operator::Multiply, left, right) => {
                self.collect(left, power, scope, product)?;
                self.collect(right, power, scope, product)
            }
            Formula::Binary(Operator::Divide, left, right) => {
                self.collect(left, power, scope, product)?;
                self.collect(right, -power, scope, product)
            }
            Formula::Binary(Operator::Power, base, exponent) if is_product(base) => {
                self.collect_power(formula, base, exponent, power, scope, product)
            }
            Formula::Factorial(argument) => {
                let argument = self.exact(argument, scope)?;
                let shifted = argument.add(&RationalFunction::one(), self.budget)?;
                self.gamma(shifted, power, product)
            }
            Formula::Call(function, arguments) if is_gamma(*function) => {
                self.collect_call(*function, arguments, power, scope, product)
            }
            _ => self.factor(&self.value(formula, scope)?, power, product),
        }
    }

    fn collect_power(
        &self,
        formula: &Formula,
        base: &Formula,
        exponent: &Formula,
        power: i64,
        scope: &Scope,
        product: &mut Product,
    ) -> Result<(), Reason> {
        let Formula::Number(exponent) = exponent else {
            return self.factor(&self.value(formula, scope)?, power, product);
        };
        let exponent = crate::number::convert::to_rug(exponent);
        let whole = exponent
            .is_integer()
            .then(|| exponent.numer().to_i64())
            .flatten();
        let combined = whole.and_then(|whole| power.checked_mul(whole));
        let combined = combined.filter(|power| power.unsigned_abs() <= MAX_POWER);
        match combined {
            Some(0) | None => self.factor(&self.value(formula, scope)?, power, product),
            Some(combined) => self.collect(base, combined, scope, product),
        }
    }

    fn factor(&self, value: &Value, power: i64, product: &mut Product) -> Result<(), Reason> {
        product.value = self.multiply(&product.value, &self.powi(value, power)?)?;
        Ok(())
    }

    fn exact(&self, formula: &Formula, scope: &Scope) -> Result<RationalFunction, Reason> {
        match self.value(formula, scope)? {
            Value::Exact(value) if !self.has_bound(&value) => Ok(value),
            _ => unsupported("a parameter of a special function that is no rational function"),
        }
    }

    fn gamma(
        &self,
        argument: RationalFunction,
        power: i64,
        product: &mut Product,
    ) -> Result<(), Reason> {
        self.require(Sign::Positive, &Value::Exact(argument.clone()))?;
        product.gammas.push((argument, power));
        Ok(())
    }

    fn collect_call(
        &self,
        function: Function,
        arguments: &[Formula],
        power: i64,
        scope: &Scope,
        product: &mut Product,
    ) -> Result<(), Reason> {
        match (function, arguments) {
            (Function::Gamma, [argument]) => {
                self.gamma(self.exact(argument, scope)?, power, product)
            }
            (Function::Beta, [a, b]) => {
                let (a, b) = (self.exact(a, scope)?, self.exact(b, scope)?);
                let sum = a.add(&b, self.budget)?;
                self.gamma(a, power, product)?;
                self.gamma(b, power, product)?;
                self.gamma(sum, -power, product)
            }
            (Function::Pochhammer, [a, n]) => {
                let (a, n) = (self.exact(a, scope)?, self.exact(n, scope)?);
                if let Some(n) = n.as_integer().filter(|n| (0..=MAX_SHIFT).contains(n)) {
                    return self.factor(&Value::Exact(self.rising(&a, n)?), power, product);
                }
                let sum = a.add(&n, self.budget)?;
                self.gamma(sum, power, product)?;
                self.gamma(a, -power, product)
            }
            (Function::Binomial, [n, k]) => {
                let (n, k) = (self.exact(n, scope)?, self.exact(k, scope)?);
                self.binomial(&n, &k, power, product)
            }
            (Function::Hyp2F1Regularized, [_, _, c, _]) => {
                let value = self.hypergeometric(arguments, scope)?;
                self.factor(&value, power, product)?;
                self.gamma(self.exact(c, scope)?, -power, product)
            }
            _ => unsupported("this number of arguments"),
        }
    }

    fn binomial(
        &self,
        n: &RationalFunction,
        k: &RationalFunction,
        power: i64,
        product: &mut Product,
    ) -> Result<(), Reason> {
        let one = RationalFunction::one();
        let rest = n.sub(k, self.budget)?.add(&one, self.budget)?;
        if let Some(k) = k.as_integer().filter(|k| (0..=MAX_SHIFT).contains(k)) {
            let above = Value::Exact(self.rising(&rest, k)?);
            self.factor(&above, power, product)?;
            let below = Value::Exact(self.rising(&one, k)?);
            return self.factor(&below, -power, product);
        }
        self.gamma(n.add(&one, self.budget)?, power, product)?;
        self.gamma(k.add(&one, self.budget)?, -power, product)?;
        self.gamma(rest, -power, product)
    }

    /// `a (a+1) ... (a+n-1)`, DLMF 5.2.4.
    pub(super) fn rising(&self, a: &RationalFunction, n: i64) -> Result<RationalFunction, Reason> {
        let mut product = RationalFunction::one();
        for step in 0..n {
            let factor = a.add(&RationalFunction::integer(step), self.budget)?;
            product = product.mul(&factor, self.budget)?;
        }
        Ok(product)
    }

    /// The product of Gamma powers as a rational function.
    fn cancel(&self, gammas: Vec<(RationalFunction, i64)>) -> Result<RationalFunction, Reason> {
        // Groups of arguments that differ by integers: a base, and shifts with their powers.
        let mut groups: Vec<(RationalFunction, Vec<(i64, i64)>)> = Vec::new();
        for (argument, power) in gammas {
            let base = match argument.as_constant() {
                Some(value) => {
                    let whole = Rational::from(value.floor_ref());
                    RationalFunction::constant(value - whole + 1u32)
                }
                None => argument.clone(),
            };
            let mut placed = false;
            for (group, members) in &mut groups {
                let shift = argument.sub(group, self.budget)?.as_integer();
                if let Some(shift) = shift {
                    members.push((shift, power));
                    placed = true;
                    break;
                }
            }
            if !placed {
                let shift = argument.sub(&base, self.budget)?.as_integer().unwrap_or(0);
                groups.push((base, vec![(shift, power)]));
            }
        }
        let mut product = RationalFunction::one();
        for (base, members) in groups {
            product = product.mul(&self.cancel_group(&base, &members)?, self.budget)?;
        }
        Ok(product)
    }

    fn cancel_group(
        &self,
        base: &RationalFunction,
        members: &[(i64, i64)],
    ) -> Result<RationalFunction, Reason> {
        let total: i64 = members.iter().map(|(_, power)| power).sum();
        // Gamma(1) = 1, so that factorials of numbers need not cancel.
        let is_one = base.as_integer() == Some(1);
        if total != 0 && !is_one {
            return unsupported("Gamma functions that do not cancel");
        }
        let least = match is_one {
            true => 0,
            false => members.iter().map(|(shift, _)| *shift).min().unwrap_or(0),
        };
        let start = base.add(&RationalFunction::integer(least), self.budget)?;
        let mut product = RationalFunction::one();
        for (shift, power) in members {
            let distance = shift.saturating_sub(least);
            if !(0..=MAX_SHIFT).contains(&distance) {
                return unsupported("a shift of this size in a Gamma function");
            }
            let rising = self.rising(&start, distance)?.powi(*power, self.budget)?;
            product = product.mul(&rising, self.budget)?;
        }
        Ok(product)
    }

    /// `hyp2f1(a, b; c; z)` by its series (DLMF 15.2.1), z tending to 0.
    pub(super) fn hypergeometric(
        &self,
        arguments: &[Formula],
        scope: &Scope,
    ) -> Result<Value, Reason> {
        let [a, b, c, z] = arguments else {
            return unsupported("this number of arguments");
        };
        let parameter = |formula| self.exact(formula, scope);
        let (a, b, c) = (parameter(a)?, parameter(b)?, parameter(c)?);
        for value in [&a, &b, &c] {
            if self.moves(value)? {
                return unsupported("a hypergeometric function whose parameters vary");
            }
        }
        self.require(Sign::Positive, &Value::Exact(c.clone()))?;
        let argument = self.value(&arguments[3], scope)?;
        if matches!(&argument, Value::Exact(value) if self.has_bound(value)) {
            return unsupported("a hypergeometric function of a draw");
        }
        let z = self.series(&argument).map_err(|reason| match z {
            Formula::Infinity => Reason::Unsupported("an infinite argument".into()),
            _ => reason,
        })?;
        if z.valuation().is_some_and(|valuation| valuation < 1) {
            return unsupported("a hypergeometric function whose argument does not tend to 0");
        }
        let one = Series::constant(RationalFunction::one());
        let (mut sum, mut term) = (one.clone(), one);
        for j in 0..self.terms {
            let step = RationalFunction::integer(j);
            let next = RationalFunction::integer(j + 1);
            let above = a
                .add(&step, self.budget)?
                .mul(&b.add(&step, self.budget)?, self.budget)?;
            let below = c.add(&step, self.budget)?.mul(&next, self.budget)?;
            let ratio = above.div(&below, self.budget)?;
            term = term
                .mul(&z, self.budget)?
                .scale(&ratio, self.budget)?
                .truncate(self.terms);
            sum = sum.add(&term, self.budget)?;
        }
        let rest = match z.is_zero() {
            true => Series::zero(),
            false => Series::remainder(self.terms),
        };
        Ok(Value::Expanded(sum.add(&rest, self.budget)?))
    }
}

fn is_gamma(function: Function) -> bool {
    matches!(
        function,
        Function::Gamma
            | Function::Beta
            | Function::Pochhammer
            | Function::Binomial
            | Function::Hyp2F1Regularized
    )
}

/// Whether a power of the formula is better taken factor by factor.
fn is_product(formula: &Formula) -> bool {
    match formula {
        Formula::Binary(operator, ..) => {
            matches!(operator, Operator::Multiply | Operator::Divide)
        }
        Formula::Factorial(_) => true,
        Formula::Call(function, _) => is_gamma(*function),
        _ => false,
    }
}
