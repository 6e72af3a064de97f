//! Means over draws. A law is a weight on a range; a mean is an integral against it.
//!
//! Under beta(a, b) products of powers of x and 1-x have the moments
//!
//! ```text
//! E[x^p (1-x)^q] = (a)_p (b)_q / (a+b)_{p+q},   finite for a+p > 0 and b+q > 0      (DLMF 5.12.1)
//! ```
//!
//! for integers p, q of either sign, whatever the size of a and b; other integrands are integrated
//! against the weight written out. The l-th of m draws with density g and cdf G has the density
//! m!/((l-1)!(m-l)!) G^(l-1) (1-G)^(m-l) g (David and Nagaraja, Order Statistics, 2.1).

use super::closed::{minus, order, rational};
use super::fraction::{Fraction, multiply};
use super::functions::{self, beta_kernel};
use super::integrate::{self, Bound, definite};
use super::quantity::Quantity;
use super::scope::{Binding, Scope};
use super::{Failure, Outcome, exact, sign, unsupported};
use crate::formula::{Budget, Draw, Formula, Law, Name};
use crate::number::Exact;
use rug::{Integer, Rational};
use std::cmp::Ordering;

use Outcome::{Undefined, Value};

/// A law at a point.
#[derive(Clone, Debug)]
pub(super) enum Weight {
    /// beta(a, b) on [0, 1].
    Beta(Rational, Rational),
    /// A density between two ends.
    Density {
        density: Fraction,
        from: Exact,
        to: Exact,
    },
    /// The l-th of m draws from a density.
    Order {
        l: Integer,
        m: Integer,
        density: Fraction,
        from: Exact,
        to: Exact,
    },
}

/// The draw that a formula names, and nothing more.
pub(super) fn named_draw<'a>(
    quantity: &Formula,
    scope: &Scope<'a>,
) -> Result<Option<&'a Draw>, Failure> {
    match quantity {
        Formula::Name(name) => Ok(scope.draws_among([name])?.first().copied()),
        _ => Ok(None),
    }
}

/// The law with its parameters at the point; `Undefined` where they are invalid.
pub(super) fn weight(law: &Law, scope: &Scope) -> Result<Outcome<Weight>, Failure> {
    match law {
        Law::Beta(a, b) => {
            let (Some(a), Some(b)) = (parameter(a, scope)?, parameter(b, scope)?) else {
                return Ok(Undefined);
            };
            let positive = a.cmp0() == Ordering::Greater && b.cmp0() == Ordering::Greater;
            Ok(if positive {
                Value(Weight::Beta(a, b))
            } else {
                Undefined
            })
        }
        Law::Uniform(a, b) => {
            let (Some(a), Some(b)) = (parameter(a, scope)?, parameter(b, scope)?) else {
                return Ok(Undefined);
            };
            Ok(uniform(a, b))
        }
        Law::Order(l, m, base) => order_statistic(l, m, base, scope),
        Law::Density {
            argument,
            body,
            from,
            to,
        } => density_law(argument, body, from, to, scope),
        Law::Any => Err(unsupported("a mean under a law that is not given")),
    }
}

/// A rational parameter; `None` where it has no value.
fn parameter(formula: &Formula, scope: &Scope) -> Result<Option<Rational>, Failure> {
    match exact::value(formula, scope)? {
        Value(quantity) => quantity
            .closed("a law's parameter")?
            .as_rational()
            .map(Some)
            .ok_or_else(|| unsupported("a law with an irrational parameter")),
        _ => Ok(None),
    }
}

fn uniform(a: Rational, b: Rational) -> Outcome<Weight> {
    if a >= b {
        return Undefined;
    }
    if a == 0 && b == 1 {
        return Value(Weight::Beta(b.clone(), b));
    }
    let height = Rational::from(&b - &a).recip();
    Value(Weight::Density {
        density: Fraction::constant(height),
        from: rational(a),
        to: rational(b),
    })
}

fn order_statistic(
    l: &Formula,
    m: &Formula,
    base: &Law,
    scope: &Scope,
) -> Result<Outcome<Weight>, Failure> {
    let (Some(l), Some(m)) = (parameter(l, scope)?, parameter(m, scope)?) else {
        return Ok(Undefined);
    };
    if *l.denom() != 1 || *m.denom() != 1 || l < 1 || l > m {
        return Ok(Undefined);
    }
    Ok(match weight(base, scope)? {
        Value(Weight::Beta(a, b)) if a == 1 && b == 1 => {
            Value(Weight::Beta(l.clone(), m - l + 1u32))
        }
        Value(Weight::Order { .. }) => {
            return Err(unsupported("an order statistic of order statistics"));
        }
        Value(base) => Value(Weight::Order {
            l: l.into_numer_denom().0,
            m: m.into_numer_denom().0,
            density: base.density(scope.budget())?,
            from: base.from_end(),
            to: base.to_end(),
        }),
        _ => Undefined,
    })
}

/// A density that is no density (negative somewhere, or with another integral than 1) is refused.
fn density_law(
    argument: &Name,
    body: &Formula,
    from: &Formula,
    to: &Formula,
    scope: &Scope,
) -> Result<Outcome<Weight>, Failure> {
    let (Value(from), Value(to)) = (exact::value(from, scope)?, exact::value(to, scope)?) else {
        return Err(unsupported("a law on an unbounded range"));
    };
    let (from, to) = (from.closed("a bound")?, to.closed("a bound")?);
    let symbol = scope.new_symbol();
    let link = scope.bind(
        argument,
        Binding::Symbol {
            symbol,
            sample: None,
            draw: false,
        },
    );
    let Value(density) = exact::value(body, &link.scope())? else {
        return Err(unsupported("a density without a value"));
    };
    let density = density
        .single_function(symbol)
        .ok_or_else(|| unsupported("a density that is no rational function over Q"))?;
    let (low, high) = (Bound::Finite(from.clone()), Bound::Finite(to.clone()));
    let budget = scope.budget();
    let total = match order(&from, &to)? {
        Ordering::Less => definite(&density, &low, &high, budget)?,
        _ => Undefined,
    };
    let is_one = matches!(&total, Value(total) if total.as_rational().is_some_and(|t| t == 1));
    if !is_one || sign::on(&density, &low, &high, budget)? != sign::Sign::NonNegative {
        return Err(unsupported("a law whose density is not one"));
    }
    Ok(Value(Weight::Density { density, from, to }))
}

impl Weight {
    fn from_end(&self) -> Exact {
        match self {
            Weight::Beta(..) => rational(Rational::new()),
            Weight::Density { from, .. } | Weight::Order { from, .. } => from.clone(),
        }
    }

    fn to_end(&self) -> Exact {
        match self {
            Weight::Beta(..) => rational(Rational::from(1)),
            Weight::Density { to, .. } | Weight::Order { to, .. } => to.clone(),
        }
    }

    /// The lower end of the support.
    pub fn from(&self) -> Bound {
        Bound::Finite(self.from_end())
    }

    /// The upper end of the support.
    pub fn to(&self) -> Bound {
        Bound::Finite(self.to_end())
    }

    /// The density inside the support, as a weight of means.
    pub fn density(&self, budget: &Budget) -> Result<Fraction, Failure> {
        match self {
            Weight::Beta(a, b) => beta_density(a, b, budget),
            Weight::Density { density, .. } => Ok(density.clone()),
            Weight::Order { l, m, density, .. } => {
                let (below, above) = self.base_cdf(density, budget)?;
                let l = small(l)?;
                let rest = small(m)? - l;
                let ways = multiplicity(l, rest, budget)?;
                let powers = below
                    .power(l - 1, budget)?
                    .multiply(&above.power(rest, budget)?, budget)?;
                Ok(powers.multiply(density, budget)?.scale(&ways))
            }
        }
    }

    /// The cdf inside the support.
    pub fn cumulative(&self, budget: &Budget) -> Result<Fraction, Failure> {
        match self {
            Weight::Order { l, m, density, .. } => {
                let (below, above) = self.base_cdf(density, budget)?;
                at_least(small(l)?, small(m)?, &below, &above, budget)
            }
            Weight::Beta(a, b) if *b == 1 && *a.denom() == 1 => {
                let power = a
                    .numer()
                    .to_i64()
                    .ok_or_else(|| Failure::TooLarge("a law".into()))?;
                Fraction::variable().power(power, budget)
            }
            _ => Ok(self.base_cdf(&self.density(budget)?, budget)?.0),
        }
    }

    /// The density as the derivative of the cdf, for `density(X, x)`: so that it checks the product
    /// formula instead of repeating it.
    pub fn derived_density(&self, budget: &Budget) -> Result<Fraction, Failure> {
        match self {
            Weight::Order { .. } => self.cumulative(budget)?.derivative(budget),
            _ => self.density(budget),
        }
    }

    /// The integral of a polynomial density from the lower end, and what it leaves up to 1.
    fn base_cdf(
        &self,
        density: &Fraction,
        budget: &Budget,
    ) -> Result<(Fraction, Fraction), Failure> {
        let split = density.split(budget)?;
        if split.factors.iter().any(|(_, e)| *e < 0) {
            return Err(unsupported(
                "the cdf of a law whose density is no polynomial",
            ));
        }
        let integral = integrate::antiderivative(&split.expanded_numerator(budget)?);
        let start = integrate::at_quantity(&integral, &Quantity::Closed(self.from_end()), budget)?
            .closed("a cdf")?
            .as_rational()
            .ok_or_else(|| unsupported("the cdf of a law with an irrational end"))?;
        let below = Fraction {
            numerator: integral,
            factors: vec![],
        }
        .add(&Fraction::constant(-start), budget)?;
        let minus = below.clone().scale(&Rational::from(-1));
        let above = Fraction::constant(Rational::from(1)).add(&minus, budget)?;
        Ok((below, above))
    }

    /// The mean of a rational function.
    pub fn mean(&self, function: &Fraction, budget: &Budget) -> Result<Outcome<Exact>, Failure> {
        if let Weight::Beta(a, b) = self {
            let split = function.split(budget)?;
            let poles_at_ends = split
                .factors
                .iter()
                .all(|(r, e)| *e > 0 || *r == 0 || *r == 1);
            if poles_at_ends {
                return beta_moments(&split, a, b, budget);
            }
        }
        self.mean_between(function, &self.from(), &self.to(), budget)
    }

    /// The part of the mean between two places of the support.
    pub fn mean_between(
        &self,
        function: &Fraction,
        from: &Bound,
        to: &Bound,
        budget: &Budget,
    ) -> Result<Outcome<Exact>, Failure> {
        let integrand = function.multiply(&self.density(budget)?, budget)?;
        definite(&integrand, from, to, budget)
    }
}

fn small(value: &Integer) -> Result<i64, Failure> {
    value
        .to_i64()
        .ok_or_else(|| Failure::TooLarge("a law's parameter".into()))
}

/// (l + rest)!/((l-1)! rest!) = l * binomial(l + rest, l)
fn multiplicity(l: i64, rest: i64, budget: &Budget) -> Result<Rational, Failure> {
    let m = Rational::from(l) + Rational::from(rest);
    match functions::binomial(&m, &Rational::from(l), budget)? {
        Value(ways) => {
            let ways = ways.as_rational().unwrap_or_default();
            Ok(ways * Rational::from(l))
        }
        _ => Err(unsupported("the number of orders")),
    }
}

/// The probability that at least l of m draws lie below: sum over j >= l of
/// binomial(m, j) G^j (1-G)^(m-j).
fn at_least(
    l: i64,
    m: i64,
    below: &Fraction,
    above: &Fraction,
    budget: &Budget,
) -> Result<Fraction, Failure> {
    if m > 2000 {
        return Err(Failure::TooLarge("an order statistic".into()));
    }
    let mut sum = Fraction::constant(Rational::new());
    for j in l..=m {
        let count = functions::binomial(&Rational::from(m), &Rational::from(j), budget)?;
        let Value(count) = count else {
            return Err(unsupported("a binomial coefficient"));
        };
        let product = below
            .power(j, budget)?
            .multiply(&above.power(m - j, budget)?, budget)?;
        let part = product.scale(&count.as_rational().unwrap_or_default());
        sum = sum.add(&part, budget)?;
    }
    Ok(sum)
}

fn beta_density(a: &Rational, b: &Rational, budget: &Budget) -> Result<Fraction, Failure> {
    let integers = (a.numer().to_i64(), b.numer().to_i64());
    let (Some(left), Some(right)) = integers else {
        return Err(Failure::TooLarge("a law's parameter".into()));
    };
    if *a.denom() != 1 || *b.denom() != 1 {
        return Err(unsupported(
            "a beta law with parameters that are no integers",
        ));
    }
    if left.checked_add(right).is_none() {
        return Err(Failure::TooLarge("a law's parameter".into()));
    }
    let ways = multiplicity(left, right - 1, budget)?;
    Ok(beta_kernel(left, right, budget)?.scale(&ways))
}

/// The mean of a numerator times powers of x and of x-1 and polynomial factors.
fn beta_moments(
    function: &Fraction,
    a: &Rational,
    b: &Rational,
    budget: &Budget,
) -> Result<Outcome<Exact>, Failure> {
    let (zero, one) = (Rational::new(), Rational::from(1));
    let (p, q) = (function.exponent_at(&zero), function.exponent_at(&one));
    let others = Fraction {
        numerator: function.numerator.clone(),
        factors: function
            .factors
            .iter()
            .filter(|(r, _)| *r != 0 && *r != 1)
            .cloned()
            .collect(),
    };
    if others.is_zero() {
        return Ok(Value(rational(zero)));
    }
    let diverges = Rational::from(a + Rational::from(p)).cmp0() != Ordering::Greater
        || Rational::from(b + Rational::from(q)).cmp0() != Ordering::Greater;
    if diverges {
        let ends = (Bound::Finite(rational(zero)), Bound::Finite(rational(one)));
        return integrate::infinite(sign::on(function, &ends.0, &ends.1, budget)?);
    }
    let sign = if q % 2 == 0 { 1 } else { -1 };
    let polynomial = others.expanded_numerator(budget)?;
    let polynomial = multiply(&polynomial, &[Rational::from(sign)], budget)?;
    let mut moment = shift(a, p, budget)? * shift(b, q, budget)?;
    let sum = Rational::from(a + b);
    let total = p
        .checked_add(q)
        .ok_or_else(|| Failure::TooLarge("an exponent".into()))?;
    moment /= shift(&sum, total, budget)?;
    let mut mean = Rational::new();
    let mut above = Rational::from(a + Rational::from(p));
    let mut below = sum + Rational::from(total);
    for coefficient in &polynomial {
        budget.spend(1 + super::fraction::bits(&moment) / 64)?;
        mean += Rational::from(coefficient * &moment);
        moment *= &above;
        moment /= &below;
        above += 1u32;
        below += 1u32;
    }
    Ok(Value(rational(mean)))
}

/// gamma(a + n)/gamma(a) for a > 0, a + n > 0.
fn shift(a: &Rational, n: i64, budget: &Budget) -> Result<Rational, Failure> {
    let product = match n {
        0.. => functions::rising(a, n.unsigned_abs(), budget)?,
        _ => functions::rising(
            &Rational::from(a + Rational::from(n)),
            n.unsigned_abs(),
            budget,
        )?
        .recip(),
    };
    Ok(product)
}

/// The density or cdf of a draw at a quantity.
pub(super) fn at_place(
    draw: &Draw,
    x: Quantity,
    cumulative: bool,
    scope: &Scope,
) -> Result<Outcome<Quantity>, Failure> {
    let Value(weight) = weight(&draw.law, scope)? else {
        return Ok(Undefined);
    };
    let place = exact::at_samples(&x, scope)?;
    let Some(place) = place else {
        return Ok(Undefined);
    };
    let outside = |value: u32| Ok(Value(Quantity::rational(Rational::from(value))));
    if super::closed::sign(&minus(&place, &weight.from_end(), scope.budget())?)? == Ordering::Less {
        return outside(0);
    }
    if super::closed::sign(&minus(&place, &weight.to_end(), scope.budget())?)? == Ordering::Greater
    {
        return outside(u32::from(cumulative));
    }
    let budget = scope.budget();
    let function = if cumulative {
        weight.cumulative(budget)?
    } else {
        weight.derived_density(budget)?
    };
    compose(&function, x, budget)
}

/// A rational function at a quantity.
fn compose(
    function: &Fraction,
    x: Quantity,
    budget: &Budget,
) -> Result<Outcome<Quantity>, Failure> {
    if let Quantity::Open(place) = &x
        && let Some(symbol) = place.as_symbol()
    {
        return Ok(Value(Quantity::function(symbol, function.clone())));
    }
    let split = function.split(budget)?;
    let mut value = integrate::at_quantity(&split.numerator, &x, budget)?;
    for (root, exponent) in &split.factors {
        let distance = x
            .clone()
            .add(Quantity::rational(Rational::from(-root)), budget)?;
        let Value(power) = distance.power(*exponent, budget)? else {
            return Ok(Undefined);
        };
        value = value.multiply(power, budget)?;
    }
    Ok(Value(value))
}
