//! Exact means, variances and probabilities over the draws that occur free in a body, and the densities
//! and cdfs of draws. The draws become symbols; each is then integrated against its law's weight.

use super::exact::{Evaluation, negate, number, value};
use super::fraction::Fraction;
use super::law::{self, Weight};
use super::pieces::{self, Piece};
use super::quantity::{Quantity, Separable, Symbol, Term};
use super::range::{add_pieces, sampled_at, unsampled};
use super::scope::Scope;
use super::sign::{self, Sign};
use super::{Failure, Outcome, closed, condition, integrate, outcome, unsupported};
use crate::formula::{Budget, Condition, Draw, Formula, Part, Relation};
use rug::Rational;

use Outcome::{Undefined, Value};

/// The body of a mean with its draws as symbols.
pub(super) struct Body<'b> {
    part: Part<'b>,
    draws: &'b [&'b Draw],
    symbols: &'b [Symbol],
}

/// Evaluates something under the draws that occur free in it.
pub(super) fn over_draws(
    part: Part,
    own: &Option<Box<Draw>>,
    scope: &Scope,
    f: fn(&Body, &Scope) -> Evaluation,
) -> Evaluation {
    let names = part.free_names();
    let draws: Vec<&Draw> = match own {
        Some(draw) => vec![draw],
        None => scope.draws_among(&names)?,
    };
    let symbols: Vec<Symbol> = draws.iter().map(|_| scope.new_symbol()).collect();
    let body = Body {
        part,
        draws: &draws,
        symbols: &symbols,
    };
    f(&body, scope)
}

impl Body<'_> {
    /// The value with the draws as symbols; with a piece, its sample is taken for the only draw.
    fn value(&self, piece: Option<&Piece>, scope: &Scope) -> Evaluation {
        self.under(0, piece, scope)
    }

    fn under(&self, depth: usize, piece: Option<&Piece>, scope: &Scope) -> Evaluation {
        match (self.draws.get(depth), self.symbols.get(depth)) {
            (Some(draw), Some(symbol)) => {
                let binding = match piece {
                    Some(piece) => sampled_at(*symbol, piece, true),
                    None => unsampled(*symbol, true),
                };
                let link = scope.bind(&draw.name, binding);
                self.under(depth + 1, piece, &link.scope())
            }
            _ => match self.part {
                Part::Formula(formula) => value(formula, scope),
                Part::Condition(truth) => {
                    number(Rational::from(u32::from(condition::within(truth, scope)?)))
                }
                Part::Law(_) => Err(unsupported("the mean of a law")),
            },
        }
    }

    fn weights(&self, scope: &Scope) -> Result<Outcome<Vec<Weight>>, Failure> {
        let mut weights = vec![];
        for draw in self.draws {
            match law::weight(&draw.law, scope)? {
                Value(weight) => weights.push(weight),
                _ => return Ok(Undefined),
            }
        }
        Ok(Value(weights))
    }

    /// The body on each piece of the support of the only draw; `None` when it is not piecewise.
    fn pieces(&self, weights: &[Weight], scope: &Scope) -> Result<Option<Vec<Piece>>, Failure> {
        let [draw] = self.draws else {
            let piecewise = pieces::has_conditions(self.part);
            return if piecewise && !self.draws.is_empty() {
                Err(unsupported("a piecewise function of several draws"))
            } else {
                Ok(None)
            };
        };
        let link = scope.bind(&draw.name, unsampled(self.symbols[0], true));
        let (from, to) = (weights[0].from(), weights[0].to());
        pieces::of(self.part, &link.scope(), self.symbols[0], &from, &to)
    }

    /// The mean of `f` of the body.
    fn mean(&self, scope: &Scope, f: impl Fn(Quantity) -> Evaluation) -> Evaluation {
        let Value(weights) = self.weights(scope)? else {
            return Ok(Undefined);
        };
        let Some(pieces) = self.pieces(&weights, scope)? else {
            return self.value(None, scope)?.finite("a mean", |body| {
                f(body)?.finite("a mean", |body| {
                    self.mean_of_function(body, &weights, scope)
                })
            });
        };
        let mut parts = vec![];
        for piece in pieces {
            match self.value(Some(&piece), scope)? {
                Value(body) => match f(body)? {
                    Value(body) => parts.push((body.open(), piece)),
                    other => return other.finite("a mean", |_| Ok(Undefined)),
                },
                Undefined => return Ok(Undefined),
                _ => return Err(unsupported("the mean of something infinite")),
            }
        }
        let (weight, symbol, budget) = (&weights[0], self.symbols[0], scope.budget());
        add_pieces(&parts, symbol, scope, |function, piece| {
            integrate::map_terms(function, symbol, budget, |factor| {
                weight.mean_between(factor, &piece.from, &piece.to, budget)
            })
        })
    }

    /// The mean over all draws, one after the other: they are independent.
    fn mean_of_function(&self, body: Quantity, weights: &[Weight], scope: &Scope) -> Evaluation {
        let budget = scope.budget();
        if let Quantity::Open(function) = &body
            && let Some(divergent) = self.divergence(function, weights, budget)?
        {
            return Ok(divergent);
        }
        let mut total = Value(body);
        for (symbol, weight) in self.symbols.iter().zip(weights) {
            total = total.finite("a mean over several draws", |body| {
                if matches!(&body, Quantity::Open(f) if f.mentions(*symbol)) {
                    integrate::map_terms(&body.open(), *symbol, budget, |f| weight.mean(f, budget))
                } else {
                    Ok(Value(body))
                }
            })?;
        }
        Ok(total)
    }
}

impl Body<'_> {
    /// What a mean over several draws is that does not converge absolutely; `None` where it does. One
    /// draw after the other may be integrated then only: in `(x - 1/2)/y` the mean over x alone
    /// would be 0 and hide that the one over y diverges.
    fn divergence(
        &self,
        function: &Separable,
        weights: &[Weight],
        budget: &Budget,
    ) -> Result<Option<Outcome<Quantity>>, Failure> {
        let mentioned = |symbol: &&Symbol| function.mentions(**symbol);
        if self.symbols.iter().filter(mentioned).count() < 2 {
            return Ok(None);
        }
        for term in &function.terms {
            let mut finite = true;
            for (factor, weight) in self.factors(term, weights) {
                finite &= matches!(weight.mean(factor, budget)?, Value(_));
            }
            if finite {
                continue;
            }
            if function.terms.len() > 1 || self.factors(term, weights).count() < term.factors.len()
            {
                return Err(unsupported("a divergent mean among other terms"));
            }
            return self.divergent(term, weights, budget).map(Some);
        }
        Ok(None)
    }

    /// The factors of a term that belong to the draws, with the draws' weights.
    fn factors<'f>(
        &'f self,
        term: &'f Term,
        weights: &'f [Weight],
    ) -> impl Iterator<Item = (&'f Fraction, &'f Weight)> {
        let pairs = self.symbols.iter().zip(weights);
        pairs.filter_map(|(symbol, weight)| Some((term.factors.get(symbol)?, weight)))
    }

    /// A mean that diverges is infinite where every factor keeps one sign: the factors are
    /// independent, and the mean of none of them is zero. A factor of both signs leaves no value.
    fn divergent(
        &self,
        term: &Term,
        weights: &[Weight],
        budget: &Budget,
    ) -> Result<Outcome<Quantity>, Failure> {
        let mut negative = closed::sign(&term.coefficient)?.is_lt();
        let mut unknown = false;
        for (factor, weight) in self.factors(term, weights) {
            match sign::on(factor, &weight.from(), &weight.to(), budget)? {
                Sign::Mixed => return Ok(Undefined),
                Sign::NonPositive => negative = !negative,
                Sign::NonNegative => {}
                Sign::Unknown => unknown = true,
            }
        }
        integrate::infinite(match (unknown, negative) {
            (true, _) => Sign::Unknown,
            (false, true) => Sign::NonPositive,
            (false, false) => Sign::NonNegative,
        })
    }
}

pub(super) fn mean_of(body: &Body, scope: &Scope) -> Evaluation {
    body.mean(scope, |body| Ok(Value(body)))
}

/// E[X^2] - E[X]^2; no value where the mean is not finite, infinite where only E[X^2] is.
pub(super) fn variance_of(body: &Body, scope: &Scope) -> Evaluation {
    let budget = scope.budget();
    let mean = match mean_of(body, scope)? {
        Value(mean) => mean,
        _ => return Ok(Undefined),
    };
    let square = body.mean(scope, |body| body.power(2, budget))?;
    let minus = mean.power(2, budget)?.map(|square| square);
    let minus = negate(minus, scope)?;
    outcome::add(square, minus, |a, b| Ok(Value(a.add(b, budget)?)))
}

/// `density(X, x)` or `cdf(X, x)`.
pub(super) fn at_draw(
    quantity: &Formula,
    x: &Formula,
    cumulative: bool,
    scope: &Scope,
) -> Evaluation {
    if let Some(draw) = law::named_draw(quantity, scope)? {
        return match value(x, scope)? {
            Value(x) => law::at_place(draw, x, cumulative, scope),
            Undefined => Ok(Undefined),
            _ => Err(unsupported("a law at infinity")),
        };
    }
    if !cumulative {
        return Err(unsupported("the density of a function of draws"));
    }
    let below = Condition::Chain(quantity.clone(), vec![(Relation::LessEqual, x.clone())]);
    let names = Part::Formula(quantity).free_names();
    let draws = scope.draws_among(&names)?;
    let shadowed = Part::Formula(x)
        .free_names()
        .iter()
        .any(|n| draws.iter().any(|d| d.name == *n));
    if shadowed {
        return Err(unsupported("a place that is named like a draw"));
    }
    over_draws(Part::Condition(&below), &None, scope, mean_of)
}
