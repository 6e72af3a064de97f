//! Formula to series: one variable tends somewhere, all other parameters stay symbols.
//!
//! A value stays an exact rational function (over the parameters and logarithms of polynomials in
//! them) as long as it can, and becomes a truncated series where it must. What the result rests on
//! (a divisor that is not zero, a logarithm's argument that is positive) is recorded as an
//! [`Obligation`], to be shown on the domain or at a point by who judges.

use super::domain::Sign;
use super::{Approach, Reason};
use crate::algebra::{AlgebraError, Polynomial, RationalFunction, Series, Symbol};
use crate::formula::{Budget, Draw, Formula, Function, Name, Operator, RangeKind, Ranged};
use crate::number::convert::to_rug;
use rug::Rational;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

/// The value of a formula.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Exact(RationalFunction),
    /// The nonnegative root of a nonnegative function, with its index >= 2.
    Root(RationalFunction, u32),
    Expanded(Series),
}

/// A sign on which a value rests. It must hold where the variable is near its target.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Obligation {
    pub sign: Sign,
    pub polynomial: Polynomial,
}

/// The names that stand for something, in force at some place of a formula.
pub(super) type Scope = BTreeMap<Name, Value>;

/// Reads formulas as values.
pub(super) struct Expander<'a> {
    /// Without it only exact values can be had.
    approach: Option<&'a Approach>,
    /// Relative terms that an infinite series is given.
    pub(super) terms: i64,
    pub(super) draws: &'a [Draw],
    pub(super) budget: &'a Budget,
    logarithms: RefCell<BTreeMap<Symbol, Polynomial>>,
    obligations: RefCell<Vec<Obligation>>,
    /// Draws and variables of integration.
    bound: RefCell<BTreeSet<Symbol>>,
    fresh: Cell<usize>,
}

/// Why a series in powers of the variable does not exist; one in powers of a root of it may.
pub(super) const ROOT_OF_VARIABLE: &str = "a root whose leading term has none";

/// A sum over a range longer than this is refused.
const MAX_SUMMANDS: i64 = 1000;

pub(super) fn unsupported<T>(what: impl Into<String>) -> Result<T, Reason> {
    Err(Reason::Unsupported(what.into()))
}

impl<'a> Expander<'a> {
    pub(super) fn new(
        approach: Option<&'a Approach>,
        terms: i64,
        draws: &'a [Draw],
        budget: &'a Budget,
    ) -> Expander<'a> {
        Expander {
            approach,
            terms,
            draws,
            budget,
            logarithms: RefCell::default(),
            obligations: RefCell::default(),
            bound: RefCell::new(draws.iter().map(|draw| draw.name.clone()).collect()),
            fresh: Cell::new(0),
        }
    }

    /// What the values so far rest on.
    pub(super) fn obligations(&self) -> Vec<Obligation> {
        self.obligations.borrow().clone()
    }

    /// The symbols that stand for `ln |p|`, with p.
    pub(super) fn logarithms(&self) -> BTreeMap<Symbol, Polynomial> {
        self.logarithms.borrow().clone()
    }

    /// A symbol that occurs nowhere else, for a draw or a variable of integration.
    pub(super) fn fresh(&self, name: &str) -> Symbol {
        self.fresh.set(self.fresh.get() + 1);
        let symbol: Symbol = format!("{name}#{}", self.fresh.get()).into();
        self.bound.borrow_mut().insert(symbol.clone());
        symbol
    }

    /// The value of a formula without draws outside of means.
    pub(super) fn closed(&self, formula: &Formula) -> Result<Value, Reason> {
        let value = self.value(formula, &Scope::new())?;
        let symbols = match &value {
            Value::Exact(value) | Value::Root(value, _) => value.symbols(),
            Value::Expanded(series) => series
                .terms()
                .flat_map(|(_, coefficient)| coefficient.symbols())
                .collect(),
        };
        match symbols.iter().any(|symbol| self.is_bound(symbol)) {
            true => unsupported("a draw outside of a mean"),
            false => Ok(value),
        }
    }

    pub(super) fn value(&self, formula: &Formula, scope: &Scope) -> Result<Value, Reason> {
        self.budget.spend(1)?;
        match formula {
            Formula::Number(value) => Ok(Value::Exact(RationalFunction::constant(to_rug(value)))),
            Formula::Pi => Ok(Value::Exact(RationalFunction::symbol(&"pi".into()))),
            Formula::Name(name) => Ok(match scope.get(name) {
                Some(value) => value.clone(),
                None => Value::Exact(RationalFunction::symbol(name)),
            }),
            Formula::Negate(inner) => self.negate(&self.value(inner, scope)?),
            Formula::Binary(operator, left, right) => {
                self.binary(formula, *operator, left, right, scope)
            }
            Formula::Factorial(_) => self.product(formula, scope),
            Formula::Call(function, arguments) => self.call(formula, *function, arguments, scope),
            Formula::Ranged(ranged) => self.ranged(ranged, scope),
            Formula::At(body, places) => {
                let mut inner = scope.clone();
                for (name, place) in places {
                    inner.insert(name.clone(), self.value(place, scope)?);
                }
                self.value(body, &inner)
            }
            Formula::Mean(body, own) => self.mean(body, own.as_deref(), scope),
            Formula::Variance(body, own) => self.variance(body, own.as_deref(), scope),
            _ => unsupported("a series of this kind of formula"),
        }
    }

    fn binary(
        &self,
        formula: &Formula,
        operator: Operator,
        left: &Formula,
        right: &Formula,
        scope: &Scope,
    ) -> Result<Value, Reason> {
        match operator {
            Operator::Add => self.add(&self.value(left, scope)?, &self.value(right, scope)?),
            Operator::Subtract => {
                let right = self.negate(&self.value(right, scope)?)?;
                self.add(&self.value(left, scope)?, &right)
            }
            Operator::Multiply | Operator::Divide => self.product(formula, scope),
            Operator::Power => self.power(left, right, scope),
        }
    }

    fn power(&self, base: &Formula, exponent: &Formula, scope: &Scope) -> Result<Value, Reason> {
        let Value::Exact(exponent) = self.value(exponent, scope)? else {
            return unsupported("an exponent that is a series");
        };
        let base = self.value(base, scope)?;
        if let Some(exponent) = exponent.as_integer() {
            return self.powi(&base, exponent);
        }
        if let Some(exponent) = exponent.as_constant() {
            let index = exponent.denom().to_u32();
            let (Some(index), Some(power)) = (index, exponent.numer().to_i64()) else {
                return Err(Reason::TooLarge("an exponent is too large".into()));
            };
            return self.powi(&self.root(&base, index)?, power);
        }
        self.symbolic_power(&base, &exponent)
    }

    /// `(1 + y)^r` with y tending to 0 and r free of the variable.
    fn symbolic_power(&self, base: &Value, exponent: &RationalFunction) -> Result<Value, Reason> {
        if self.moves(exponent)? || self.has_bound(exponent) {
            return unsupported("a power whose exponent varies");
        }
        let base = self.series(base)?;
        match base.leading() {
            Some((0, lead)) if lead.as_constant().is_some_and(|lead| lead == 1) => Ok(
                Value::Expanded(base.unit_power(exponent, self.terms, self.budget)?),
            ),
            _ => unsupported("a symbolic power of what does not tend to 1"),
        }
    }

    fn call(
        &self,
        formula: &Formula,
        function: Function,
        arguments: &[Formula],
        scope: &Scope,
    ) -> Result<Value, Reason> {
        let argument = || match arguments {
            [argument] => self.value(argument, scope),
            _ => unsupported("this number of arguments"),
        };
        match function {
            Function::Sqrt => self.root(&argument()?, 2),
            Function::Ln => self.ln(&argument()?),
            Function::Exp => self.exp(&argument()?),
            Function::Abs => {
                let value = argument()?;
                self.require(Sign::NonNegative, &value)?;
                Ok(value)
            }
            Function::Hyp2F1 => self.hypergeometric(arguments, scope),
            Function::Gamma
            | Function::Beta
            | Function::Binomial
            | Function::Pochhammer
            | Function::Hyp2F1Regularized => self.product(formula, scope),
            _ => unsupported(format!("a series of {}", function.name())),
        }
    }

    fn ranged(&self, ranged: &Ranged, scope: &Scope) -> Result<Value, Reason> {
        match ranged.kind {
            RangeKind::Sum => self.sum(ranged, scope),
            RangeKind::Integral => self.integral(ranged, scope),
            _ => unsupported("a series of a supremum"),
        }
    }

    fn sum(&self, ranged: &Ranged, scope: &Scope) -> Result<Value, Reason> {
        let end = |formula| match self.value(formula, scope)? {
            Value::Exact(value) => value
                .as_integer()
                .ok_or_else(|| Reason::Unsupported("a sum over a symbolic range".into())),
            _ => unsupported("a sum over a symbolic range"),
        };
        let (from, to) = (end(&ranged.from)?, end(&ranged.to)?);
        if from.checked_sub(1).is_none_or(|least| to < least)
            || to.saturating_sub(from) > MAX_SUMMANDS
        {
            return unsupported("this range of a sum");
        }
        let (mut total, mut inner) = (Value::Exact(RationalFunction::zero()), scope.clone());
        for index in from..=to {
            inner.insert(
                ranged.name.clone(),
                Value::Exact(RationalFunction::integer(index)),
            );
            total = self.add(&total, &self.value(&ranged.body, &inner)?)?;
        }
        Ok(total)
    }

    // Arithmetic of values.

    pub(super) fn approach(&self) -> Result<&'a Approach, Reason> {
        match self.approach {
            Some(approach) => Ok(approach),
            None => unsupported("a joint limit of what is no rational function"),
        }
    }

    pub(super) fn negate(&self, value: &Value) -> Result<Value, Reason> {
        self.multiply(value, &Value::Exact(RationalFunction::integer(-1)))
    }

    pub(super) fn add(&self, left: &Value, right: &Value) -> Result<Value, Reason> {
        if let (Value::Exact(left), Value::Exact(right)) = (left, right) {
            return Ok(Value::Exact(left.add(right, self.budget)?));
        }
        let sum = self.series(left)?.add(&self.series(right)?, self.budget)?;
        Ok(Value::Expanded(sum))
    }

    pub(super) fn multiply(&self, left: &Value, right: &Value) -> Result<Value, Reason> {
        match (left, right) {
            (Value::Exact(left), Value::Exact(right)) => {
                Ok(Value::Exact(left.mul(right, self.budget)?))
            }
            (Value::Root(left, i), Value::Root(right, j)) if i == j => {
                self.root(&Value::Exact(left.mul(right, self.budget)?), *i)
            }
            _ => {
                let product = self.series(left)?.mul(&self.series(right)?, self.budget)?;
                Ok(Value::Expanded(product))
            }
        }
    }

    /// An integer power; a negative one rests on the base not being zero.
    pub(super) fn powi(&self, base: &Value, exponent: i64) -> Result<Value, Reason> {
        if exponent < 0 {
            self.require(Sign::NonZero, base)?;
        }
        match base {
            Value::Exact(base) => Ok(Value::Exact(base.powi(exponent, self.budget)?)),
            Value::Root(radicand, index) => {
                let common = gcd(exponent.unsigned_abs(), u64::from(*index));
                let (Ok(common), Ok(divisor)) = (i64::try_from(common), u32::try_from(common))
                else {
                    return unsupported("an exponent of this size");
                };
                // gcd(0, index) = index, so neither division is by zero.
                let power = radicand.powi(exponent / common, self.budget)?;
                self.root(&Value::Exact(power), index / divisor)
            }
            Value::Expanded(base) => Ok(Value::Expanded(base.powi(
                exponent,
                self.terms,
                self.budget,
            )?)),
        }
    }

    /// The nonnegative root; it rests on the radicand not being negative.
    pub(super) fn root(&self, value: &Value, index: u32) -> Result<Value, Reason> {
        if index == 1 {
            return Ok(value.clone());
        }
        match value {
            Value::Exact(radicand) => {
                self.require(Sign::NonNegative, value)?;
                match self.exact_root(radicand, index)? {
                    Some(root) => Ok(Value::Exact(root)),
                    None => Ok(Value::Root(radicand.clone(), index)),
                }
            }
            Value::Root(radicand, inner) => match inner.checked_mul(index) {
                Some(index) => Ok(Value::Root(radicand.clone(), index)),
                None => Err(Reason::TooLarge("the index of a root is too large".into())),
            },
            Value::Expanded(series) => Ok(Value::Expanded(self.series_root(series, index)?)),
        }
    }

    /// The root where every factor has one, the factors being positive.
    fn exact_root(
        &self,
        radicand: &RationalFunction,
        index: u32,
    ) -> Result<Option<RationalFunction>, Reason> {
        let (content, factors) = radicand.factored(self.budget)?;
        let step = i64::from(index);
        let root = |integer: &rug::Integer| {
            let (root, rest) = integer.clone().root_rem(rug::Integer::new(), index);
            (rest == 0).then_some(root)
        };
        if content <= 0 || factors.values().any(|exponent| exponent % step != 0) {
            return Ok((content == 0).then(RationalFunction::zero));
        }
        let (Some(above), Some(below)) = (root(content.numer()), root(content.denom())) else {
            return Ok(None);
        };
        let mut result = RationalFunction::constant(Rational::from((above, below)));
        for (factor, exponent) in factors {
            self.require(Sign::NonNegative, &Value::Exact(factor.clone().into()))?;
            let power = RationalFunction::from(factor).powi(exponent / step, self.budget)?;
            result = result.mul(&power, self.budget)?;
        }
        Ok(Some(result))
    }

    fn series_root(&self, series: &Series, index: u32) -> Result<Series, Reason> {
        if series.is_zero() {
            return Ok(Series::zero());
        }
        self.require(Sign::Positive, &Value::Expanded(series.clone()))?;
        let (exponent, lead) = series.leading().ok_or(AlgebraError::TooFewTerms)?;
        let root = self.exact_root(lead, index)?;
        let (Some(root), 0) = (root, exponent % i64::from(index)) else {
            return unsupported(ROOT_OF_VARIABLE);
        };
        let power = RationalFunction::constant(Rational::from((1, index)));
        let unit = series.unit_power(&power, self.terms, self.budget)?;
        Ok(unit
            .scale(&root, self.budget)?
            .shift(exponent / i64::from(index)))
    }

    pub(super) fn ln(&self, value: &Value) -> Result<Value, Reason> {
        self.require(Sign::Positive, value)?;
        match value {
            Value::Exact(value) => Ok(Value::Exact(self.ln_exact(value)?)),
            Value::Root(radicand, index) => {
                let part = RationalFunction::constant(Rational::from((1, *index)));
                Ok(Value::Exact(
                    self.ln_exact(radicand)?.mul(&part, self.budget)?,
                ))
            }
            Value::Expanded(series) => Ok(Value::Expanded(self.ln_series(series)?)),
        }
    }

    /// `ln |q|` as a sum of the logarithms of its factors: right wherever q is not 0.
    fn ln_exact(&self, value: &RationalFunction) -> Result<RationalFunction, Reason> {
        if self.has_bound(value) {
            return unsupported("a logarithm of a draw");
        }
        let (content, factors) = value.factored(self.budget)?;
        let mut sum = self.ln_number(&content.abs())?;
        for (factor, exponent) in factors {
            let symbol = self.ln_symbol(&factor);
            let term = RationalFunction::integer(exponent).mul(&symbol, self.budget)?;
            sum = sum.add(&term, self.budget)?;
        }
        Ok(sum)
    }

    fn ln_symbol(&self, argument: &Polynomial) -> RationalFunction {
        let symbol: Symbol = format!("ln({argument})").into();
        self.logarithms
            .borrow_mut()
            .insert(symbol.clone(), argument.clone());
        RationalFunction::symbol(&symbol)
    }

    /// The logarithm of a positive number, small prime factors told apart.
    fn ln_number(&self, value: &Rational) -> Result<RationalFunction, Reason> {
        let mut sum = RationalFunction::zero();
        for (part, sign) in [(value.numer(), 1), (value.denom(), -1)] {
            let mut rest = part.clone();
            for prime in 2u32..1000 {
                // A composite never divides, its factors having gone before.
                let (reduced, count) = rest.remove_factor(&prime.into());
                rest = reduced;
                if count > 0 {
                    let symbol = self.ln_symbol(&Polynomial::integer(prime.into()));
                    let weight = RationalFunction::integer(sign * i64::from(count));
                    sum = sum.add(&symbol.mul(&weight, self.budget)?, self.budget)?;
                }
            }
            if rest != 1 {
                let symbol = self.ln_symbol(&Polynomial::constant(rest.into()));
                let weight = RationalFunction::integer(sign);
                sum = sum.add(&symbol.mul(&weight, self.budget)?, self.budget)?;
            }
        }
        Ok(sum)
    }

    fn ln_series(&self, series: &Series) -> Result<Series, Reason> {
        let approach = self.approach()?;
        let (exponent, lead) = series.leading().ok_or(AlgebraError::TooFewTerms)?;
        if self.moves(lead)? {
            return unsupported("a logarithm of a logarithm of the variable");
        }
        let weight = RationalFunction::integer(exponent.saturating_mul(approach.sign_of_log()));
        let log = RationalFunction::symbol(&approach.log_symbol()).mul(&weight, self.budget)?;
        let head = self.ln_exact(lead)?.add(&log, self.budget)?;
        let tail = series.unit_ln(self.terms, self.budget)?;
        Ok(Series::constant(head).add(&tail, self.budget)?)
    }

    fn exp(&self, value: &Value) -> Result<Value, Reason> {
        match self.series(value)?.exp(self.terms, self.budget)? {
            Some(series) => Ok(Value::Expanded(series)),
            None => unsupported("exp of what does not tend to 0"),
        }
    }

    // Exact values as series.

    pub(super) fn series(&self, value: &Value) -> Result<Series, Reason> {
        match value {
            Value::Exact(value) => self.expand_exact(value),
            Value::Root(radicand, index) => {
                let radicand = self.expand_exact(radicand)?;
                self.series_root(&radicand, *index)
            }
            Value::Expanded(series) => Ok(series.clone()),
        }
    }

    fn expand_exact(&self, value: &RationalFunction) -> Result<Series, Reason> {
        let mut result = self.expand_polynomial(value.numerator())?;
        for (atom, exponent) in value.denominator() {
            let series = self.expand_polynomial(atom)?;
            self.require_head(atom, &series)?;
            let power = series.powi(-i64::from(*exponent), self.terms, self.budget)?;
            result = result.mul(&power, self.budget)?;
        }
        Ok(result)
    }

    /// A divisor's leading coefficient must not be zero, nor depend on a draw: then the remainder of
    /// its reciprocal is uniform in the draws, whose laws have bounded supports. The draw itself as
    /// a factor is the concern of who takes the mean.
    fn require_head(&self, atom: &Polynomial, series: &Series) -> Result<(), Reason> {
        let (_, lead) = series.leading().ok_or(AlgebraError::TooFewTerms)?;
        if !self.has_bound(lead) {
            return self.require(Sign::NonZero, &Value::Exact(lead.clone()));
        }
        match atom.len() {
            1 => Ok(()),
            _ => unsupported("a divisor that is not bounded away from 0 uniformly in a draw"),
        }
    }

    /// A polynomial whose logarithms of the variable are expanded too.
    fn expand_polynomial(&self, value: &Polynomial) -> Result<Series, Reason> {
        let approach = self.approach()?;
        let known = self.logarithms.borrow().clone();
        let symbols = value.symbols();
        let found = symbols.iter().find_map(|symbol| {
            // The variable's own logarithm is the one symbol that series keep.
            let own = *symbol == approach.log_symbol();
            let argument = known.get(symbol).filter(|_| !own)?;
            varies(symbol, approach, &known).then(|| (symbol, argument.clone()))
        });
        let Some((symbol, argument)) = found else {
            return approach.polynomial(value, self.budget);
        };
        // The argument may hold logarithms of the variable itself.
        let logarithm = self.ln_series(&self.expand_polynomial(&argument)?)?;
        let mut sum = Series::zero();
        for (exponent, part) in value.coefficients(symbol) {
            let power = logarithm.powi(i64::from(exponent), self.terms, self.budget)?;
            let part = self.expand_polynomial(&part)?;
            sum = sum.add(&part.mul(&power, self.budget)?, self.budget)?;
        }
        Ok(sum)
    }

    // What values rest on.

    pub(super) fn is_bound(&self, symbol: &str) -> bool {
        self.bound.borrow().contains(symbol)
    }

    /// Whether a value changes with the variable, be it inside a logarithm only.
    pub(super) fn moves(&self, value: &RationalFunction) -> Result<bool, Reason> {
        let (approach, known) = (self.approach()?, self.logarithms.borrow());
        let symbols = value.symbols();
        Ok(symbols
            .iter()
            .any(|symbol| varies(symbol, approach, &known)))
    }

    pub(super) fn has_bound(&self, value: &RationalFunction) -> bool {
        value.symbols().iter().any(|symbol| self.is_bound(symbol))
    }

    /// Records that a value has a sign.
    ///
    /// A divisor that holds a draw needs to be nonzero almost everywhere only (a mean or an integral
    /// does not see null sets, and whether it exists is decided from the simplified integrand): it
    /// is, when one of its coefficients as a polynomial in the draws is not zero.
    pub(super) fn require(&self, sign: Sign, value: &Value) -> Result<(), Reason> {
        match value {
            Value::Exact(value) => {
                let mut polynomial = value.numerator().clone();
                if sign != Sign::NonZero {
                    for (atom, _) in value.denominator().iter().filter(|(_, e)| *e % 2 == 1) {
                        polynomial = polynomial.mul(atom, self.budget)?;
                    }
                }
                self.record(sign, polynomial)
            }
            Value::Root(radicand, _) => {
                let sign = match sign {
                    Sign::NonNegative => return Ok(()),
                    Sign::Positive | Sign::NonZero => Sign::Positive,
                };
                self.require(sign, &Value::Exact(radicand.clone()))
            }
            Value::Expanded(series) => {
                if series.is_zero() && sign == Sign::NonNegative {
                    return Ok(());
                }
                let (exponent, lead) = series.leading().ok_or(AlgebraError::TooFewTerms)?;
                if sign != Sign::NonZero && exponent % 2 != 0 && self.approach()?.two_sided() {
                    return unsupported("a sign that differs on the two sides of a point");
                }
                let sign = if sign == Sign::NonNegative {
                    Sign::Positive
                } else {
                    sign
                };
                self.require(sign, &Value::Exact(lead.clone()))
            }
        }
    }

    fn record(&self, sign: Sign, polynomial: Polynomial) -> Result<(), Reason> {
        let mut polynomial = polynomial;
        let bound: Vec<Symbol> = polynomial
            .symbols()
            .into_iter()
            .filter(|symbol| self.is_bound(symbol))
            .collect();
        if !bound.is_empty() && sign != Sign::NonZero {
            return unsupported("the sign of a draw's function");
        }
        for symbol in bound {
            let parts = polynomial.coefficients(&symbol);
            let constant = parts.values().find(|part| part.as_constant().is_some());
            let chosen = constant.or_else(|| parts.values().next_back());
            polynomial = chosen.cloned().unwrap_or_default();
        }
        let obligation = Obligation { sign, polynomial };
        let mut known = self.obligations.borrow_mut();
        if !known.contains(&obligation) {
            known.push(obligation);
        }
        Ok(())
    }
}

/// Whether a symbol changes with the variable: the variable, or a logarithm of what changes.
fn varies(symbol: &Symbol, approach: &Approach, known: &BTreeMap<Symbol, Polynomial>) -> bool {
    symbol == approach.variable()
        || *symbol == approach.log_symbol()
        || known.get(symbol).is_some_and(|argument| {
            // An argument's own logarithms were named before it, so this ends.
            let symbols = argument.symbols();
            symbols.iter().any(|inner| varies(inner, approach, known))
        })
}

fn gcd(a: u64, b: u64) -> u64 {
    match b {
        0 => a,
        _ => gcd(b, a % b),
    }
}

/// A formula's expansion.
#[derive(Clone, Debug)]
pub struct Expansion {
    /// The terms and the remainder.
    pub series: Series,
    /// The formula itself as a rational function of all parameters (and of logarithms, which are
    /// symbols), where it is one.
    pub exact: Option<RationalFunction>,
    /// The symbols that stand for `ln |p|`, with p.
    pub logarithms: BTreeMap<Symbol, Polynomial>,
    pub(super) obligations: Vec<Obligation>,
}

/// Series of more relative terms than this are not tried.
const MAX_TERMS: i64 = 96;

/// Expands a formula, with all terms below t^`order` known.
///
/// # Errors
/// Why there is no such series: the budget, a formula without a method, or terms that still cancel
/// after many.
pub fn expand(
    formula: &Formula,
    approach: &Approach,
    order: i64,
    draws: &[Draw],
    budget: &Budget,
) -> Result<Expansion, Reason> {
    // Most bodies lose no more than one order to a factor such as k.
    let mut terms = order.clamp(0, MAX_TERMS) + 1;
    loop {
        let expander = Expander::new(Some(approach), terms, draws, budget);
        let series = expander.closed(formula).and_then(|value| {
            let exact = match &value {
                Value::Exact(value) => Some(value.clone()),
                _ => None,
            };
            Ok((expander.series(&value)?, exact))
        });
        let enough = match &series {
            Ok((series, _)) => series.order().is_none_or(|known| known >= order),
            Err(Reason::Undecided(_)) => false,
            Err(_) => true,
        };
        if enough || terms >= MAX_TERMS {
            let (series, exact) = series?;
            let (logarithms, obligations) = (expander.logarithms(), expander.obligations());
            require_constant(&series, approach, &logarithms)?;
            return match enough {
                true => Ok(Expansion {
                    series,
                    exact,
                    logarithms,
                    obligations,
                }),
                false => Err(Reason::Undecided(
                    "leading terms cancel beyond the cap".into(),
                )),
            };
        }
        terms = (terms + terms / 2 + 2).min(MAX_TERMS);
    }
}

/// Coefficients are compared as constants: none may hide the variable, but for the logarithm that the
/// comparison looks for.
fn require_constant(
    series: &Series,
    approach: &Approach,
    logarithms: &BTreeMap<Symbol, Polynomial>,
) -> Result<(), Reason> {
    let own = approach.log_symbol();
    let hidden = |symbol: &Symbol| *symbol != own && varies(symbol, approach, logarithms);
    match series
        .terms()
        .any(|(_, value)| value.symbols().iter().any(hidden))
    {
        true => unsupported("a coefficient that changes with the variable"),
        false => Ok(()),
    }
}
