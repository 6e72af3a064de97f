//! Piecewise integrands: the places where the conditions of an integrand may change, and a sample inside
//! each piece between them, at which they are decided.
//!
//! A comparison is followed when its difference has known real zeros: a variable against a number, or a
//! rational function that splits into rational linear factors, or whose rest is shown not to change
//! sign on the range. Others are refused.

use super::closed::order;
use super::fraction::Fraction;
use super::integrate::Bound;
use super::law;
use super::quantity::{Quantity, Separable, Symbol};
use super::scope::Scope;
use super::sign::{self, Sign};
use super::{Failure, Outcome, closed, exact, undecided, unsupported};
use crate::formula::{Condition, Formula, Function, Name, Part};
use crate::number::Exact;
use rug::Rational;
use std::cmp::Ordering;

/// A piece of the range with a rational strictly inside.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub from: Bound,
    pub to: Bound,
    pub sample: Rational,
}

/// The comparisons on which the form of an integrand depends.
struct Search<'s, 'a> {
    scope: &'s Scope<'a>,
    symbol: Symbol,
    from: &'s Bound,
    to: &'s Bound,
    /// The first comparison met, even one that does not depend on the symbol, is remembered here.
    found: bool,
    cuts: Vec<Exact>,
    failure: Option<Failure>,
}

/// The pieces of `from < to` for the integrand `part`; `None` when it is not piecewise.
pub(super) fn of(
    part: Part,
    scope: &Scope,
    symbol: Symbol,
    from: &Bound,
    to: &Bound,
) -> Result<Option<Vec<Piece>>, Failure> {
    let mut search = Search {
        scope,
        symbol,
        from,
        to,
        found: false,
        cuts: vec![],
        failure: None,
    };
    search.visit(part, &mut vec![]);
    if let Some(failure) = search.failure {
        return Err(failure);
    }
    if !search.found {
        return Ok(None);
    }
    let cuts = search.cuts;
    between(cuts, from, to).map(Some)
}

/// Whether anything in it may depend on a comparison.
pub(super) fn has_conditions(part: Part) -> bool {
    let here = match part {
        Part::Condition(_) => true,
        Part::Formula(Formula::Call(f, _)) => {
            matches!(f, Function::Abs | Function::Min | Function::Max)
        }
        Part::Formula(f) => matches!(f, Formula::Density(..) | Formula::Cumulative(..)),
        Part::Law(_) => false,
    };
    let mut found = here;
    part.each(&mut |inner, _| found = found || has_conditions(inner));
    found
}

impl<'n> Search<'_, '_> {
    fn visit(&mut self, part: Part<'n>, hidden: &mut Vec<&'n Name>) {
        if self.failure.is_some() {
            return;
        }
        if let Err(failure) = self.node(part, hidden) {
            self.failure = Some(failure);
            return;
        }
        part.each(&mut |inner, names| {
            let depth = hidden.len();
            hidden.extend(names);
            self.visit(inner, hidden);
            hidden.truncate(depth);
        });
    }

    fn node(&mut self, part: Part<'n>, hidden: &[&'n Name]) -> Result<(), Failure> {
        self.scope.spend(1)?;
        let zero = Formula::integer(0);
        match part {
            Part::Condition(Condition::Chain(first, links)) => {
                let mut left = first;
                for (_, right) in links {
                    self.comparison(left, right, hidden)?;
                    left = right;
                }
                Ok(())
            }
            Part::Formula(Formula::Call(Function::Abs, arguments)) => match &arguments[..] {
                [x] => self.comparison(x, &zero, hidden),
                _ => Ok(()),
            },
            Part::Formula(Formula::Call(Function::Min | Function::Max, arguments)) => {
                for (index, left) in arguments.iter().enumerate() {
                    for right in &arguments[index + 1..] {
                        self.comparison(left, right, hidden)?;
                    }
                }
                Ok(())
            }
            Part::Formula(Formula::Density(quantity, x) | Formula::Cumulative(quantity, x)) => {
                self.support(quantity, x, hidden)
            }
            Part::Formula(Formula::At(body, places) | Formula::Limit(body, places)) => {
                let mut fixed = true;
                for (_, place) in places {
                    fixed &= self.is_fixed(place, hidden)?;
                }
                if !fixed && has_conditions(Part::Formula(body)) {
                    return Err(unsupported(
                        "a condition on a replaced variable in an integrand",
                    ));
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// The ends of a draw's support are places of change of its density and cdf.
    fn support(
        &mut self,
        quantity: &Formula,
        x: &Formula,
        hidden: &[&Name],
    ) -> Result<(), Failure> {
        if self.is_fixed(x, hidden)? {
            return Ok(());
        }
        let Some(draw) = law::named_draw(quantity, self.scope)? else {
            return Err(unsupported("the law of this quantity in an integrand"));
        };
        self.found = true;
        let Outcome::Value(weight) = law::weight(&draw.law, self.scope)? else {
            return Ok(());
        };
        let x = exact::value(x, self.scope)?;
        for end in [weight.from(), weight.to()] {
            if let Bound::Finite(end) = end {
                self.zeros(x.clone(), Outcome::Value(Quantity::Closed(end)))?;
            }
        }
        Ok(())
    }

    fn comparison(
        &mut self,
        left: &Formula,
        right: &Formula,
        hidden: &[&Name],
    ) -> Result<(), Failure> {
        if self.is_fixed(left, hidden)? && self.is_fixed(right, hidden)? {
            return Ok(());
        }
        for side in [left, right] {
            if mentions(side, hidden) {
                return Err(unsupported(
                    "a condition on inner variables in an integrand",
                ));
            }
        }
        self.found = true;
        self.zeros(
            exact::value(left, self.scope)?,
            exact::value(right, self.scope)?,
        )
    }

    /// Whether the formula does not change with the symbol: none of its names outside of inner
    /// bindings is the symbol or a function of it.
    fn is_fixed(&self, formula: &Formula, hidden: &[&Name]) -> Result<bool, Failure> {
        for name in Part::Formula(formula).free_names() {
            if hidden.contains(&&name) {
                continue;
            }
            if let Ok(Quantity::Open(function)) = self.scope.lookup(&name)
                && function.mentions(self.symbol)
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn zeros(&mut self, left: Outcome<Quantity>, right: Outcome<Quantity>) -> Result<(), Failure> {
        let (Outcome::Value(left), Outcome::Value(right)) = (left, right) else {
            // Against infinity, or without a value: the same everywhere.
            return Ok(());
        };
        for (variable, other) in [(&left, &right), (&right, &left)] {
            if let (Quantity::Open(function), Quantity::Closed(value)) = (variable, other)
                && function.is_symbol(self.symbol)
            {
                self.cuts.push(value.clone());
                return Ok(());
            }
        }
        let budget = self.scope.budget();
        match left.add(right.negate(budget)?, budget)? {
            Quantity::Closed(_) => Ok(()),
            Quantity::Open(difference) => self.zeros_of(&difference),
        }
    }

    fn zeros_of(&mut self, difference: &Separable) -> Result<(), Failure> {
        let [term] = &difference.terms[..] else {
            return Err(unsupported("a condition of this kind in an integrand"));
        };
        let mut factors = term.factors.iter();
        let (Some((symbol, function)), None) = (factors.next(), factors.next()) else {
            return Err(unsupported(
                "a condition on several variables in an integrand",
            ));
        };
        if *symbol != self.symbol {
            return Ok(());
        }
        let budget = self.scope.budget();
        let split = function.split(budget)?;
        self.cuts.extend(
            split
                .factors
                .iter()
                .map(|(root, _)| closed::rational(root.clone())),
        );
        if let Some(roots) = binomial_roots(&split) {
            self.cuts.extend(roots);
            return Ok(());
        }
        let rest = Fraction {
            numerator: split.numerator,
            factors: vec![],
        };
        match sign::on(&rest, self.from, self.to, budget)? {
            Sign::NonNegative | Sign::NonPositive => Ok(()),
            Sign::Mixed | Sign::Unknown => {
                Err(unsupported("the zeros of a condition's difference"))
            }
        }
    }
}

/// The real zeros of c x^n - d with d/c > 0, from roots; `None` for other numerators.
fn binomial_roots(function: &Fraction) -> Option<Vec<Exact>> {
    let (constant, rest) = function.numerator.split_first()?;
    let (leading, middle) = rest.split_last()?;
    if middle.iter().any(|c| *c != 0) {
        return None;
    }
    let index = u32::try_from(function.numerator.len() - 1).ok()?;
    let quotient = -Rational::from(constant / leading);
    let sign = quotient.cmp0();
    let root = Exact::root(&quotient.abs(), index)?;
    Some(match (sign, index % 2) {
        (Ordering::Greater, 0) => vec![root.neg(), root],
        (Ordering::Greater, _) => vec![root],
        (_, 0) => vec![],
        _ => vec![root.neg()],
    })
}

fn mentions(formula: &Formula, names: &[&Name]) -> bool {
    let free = Part::Formula(formula).free_names();
    names.iter().any(|name| free.contains(*name))
}

/// The pieces between the cuts that lie inside the range.
fn between(cuts: Vec<Exact>, from: &Bound, to: &Bound) -> Result<Vec<Piece>, Failure> {
    let mut marks: Vec<Bound> = vec![from.clone()];
    for cut in cuts {
        insert(&mut marks, Bound::Finite(cut), to)?;
    }
    marks.push(to.clone());
    let pairs = marks.windows(2);
    pairs
        .map(|pair| {
            Ok(Piece {
                from: pair[0].clone(),
                to: pair[1].clone(),
                sample: inside(&pair[0], &pair[1])?,
            })
        })
        .collect()
}

/// Puts a cut in its place after the first mark, if it is above that one, below `to`, and new.
fn insert(marks: &mut Vec<Bound>, cut: Bound, to: &Bound) -> Result<(), Failure> {
    if cut.compare(to)?.is_ge() {
        return Ok(());
    }
    for index in (0..marks.len()).rev() {
        match cut.compare(&marks[index])? {
            Ordering::Equal => return Ok(()),
            Ordering::Greater => {
                marks.insert(index + 1, cut);
                return Ok(());
            }
            Ordering::Less => {}
        }
    }
    Ok(())
}

/// A rational between two bounds, the first below the second.
fn inside(from: &Bound, to: &Bound) -> Result<Rational, Failure> {
    let fail = || undecided("a place between two bounds");
    let (_, low) = from.neighbours().ok_or_else(fail)?;
    let (high, _) = to.neighbours().ok_or_else(fail)?;
    match (low, high) {
        (Some(low), Some(high)) if low < high => Ok((low + high) / 2u32),
        (Some(_), Some(_)) => order_fails(),
        (Some(low), None) => Ok(low + 1u32),
        (None, Some(high)) => Ok(high - 1u32),
        (None, None) => Ok(Rational::new()),
    }
}

fn order_fails<T>() -> Result<T, Failure> {
    Err(undecided("a place between two close bounds"))
}

/// Whether the range is empty, reversed or proper.
pub(super) fn direction(from: &Bound, to: &Bound) -> Result<Ordering, Failure> {
    match (from, to) {
        (Bound::Finite(a), Bound::Finite(b)) => order(a, b),
        _ => from.compare(to),
    }
}
