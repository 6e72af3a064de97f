//! Refutations: a statement proved to fail at one point of its domain.
//!
//! The statement says that each of its links holds at every point of the domain, so that one point
//! is enough: its parameters are of their types, all conditions of the domain are certainly true
//! and all laws valid there, and one link fails.

use super::condition::holds;
use super::integrand::relation_allows;
use super::interval::{Interval, Value};
use super::law;
use super::scope::{Binding, Scope, full_tank};
use super::value::value_in;
use super::{Unknown, calculus, unknown};
use crate::formula::{
    Condition, Duty, Formula, FunctionKind, Law, Name, ParameterKind, Point, Proposition,
    RangeKind, Ranged, Rational, Regime, Relation, Statement,
};
use std::collections::BTreeSet;

/// The bits tried one after the other.
const LADDER: [u64; 7] = [64, 128, 256, 512, 1024, 2048, 4096];
/// In how many parts a range is cut to find a place where a duty fails.
const PLACES: i64 = 16;

/// Where a statement is said to fail.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Witness {
    /// Values of all parameters.
    pub point: Point,
    /// Which link fails, from 0, over the whole statement from left to right; the duties of a
    /// definition count as links.
    pub link: usize,
}

/// Why a link fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Because {
    /// The enclosures are disjoint, the wrong way round for the relation.
    Disjoint,
    /// The sides are exactly equal where the relation forbids it.
    Equal,
    /// Just one side has a value.
    Undefined,
    /// A definition fails one of its duties.
    Duty,
}

/// A proof that a statement fails at a point. Only [`check_witness`] makes one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refutation {
    left: Value,
    right: Value,
    because: Because,
}

impl Refutation {
    /// The left side of the link, or what a duty looked at.
    pub fn left(&self) -> &Value {
        &self.left
    }

    /// The right side of the link, or what the duty asks for.
    pub fn right(&self) -> &Value {
        &self.right
    }

    /// Why the two refute the statement.
    pub fn because(&self) -> Because {
        self.because
    }
}

/// One thing that a statement says.
enum Item<'a> {
    Link {
        left: &'a Formula,
        relation: Relation,
        right: &'a Formula,
        regime: Option<&'a Regime>,
    },
    Duty {
        arguments: &'a [Name],
        body: &'a Formula,
        duty: &'a Duty,
    },
}

/// Checks that a statement fails at a point.
///
/// # Errors
/// [`Unknown`] with the reason where that is not proved: a point outside of the domain or not
/// proved inside, a link that holds, an expansion (its constants are not a point's affair), two
/// sides without value, or a value that the kernel cannot find.
pub fn check_witness(proposition: &Proposition, witness: &Witness) -> Result<Refutation, Unknown> {
    let mut items = Vec::new();
    collect(&proposition.statement, &mut items);
    let Some(item) = items.get(witness.link) else {
        return unknown("the statement has no such link");
    };
    check_names(proposition, &witness.point)?;
    let mut reason = unknown("no bits were tried");
    for bits in LADDER {
        let fuel = full_tank();
        let scope = Scope::new(&witness.point, &proposition.draws, bits, &fuel);
        let found = check_domain(proposition, &scope).and_then(|()| failure(item, &scope));
        match found {
            Ok(Some(refutation)) => return Ok(refutation),
            Ok(None) => return unknown("the link holds, or neither side has a value"),
            Err(why) => reason = Err(why),
        }
    }
    reason
}

/// The links and duties of a statement, from left to right.
fn collect<'a>(statement: &'a Statement, items: &mut Vec<Item<'a>>) {
    match statement {
        Statement::Chain {
            first,
            links,
            regime,
        } => {
            let mut left = first;
            for (relation, right) in links {
                items.push(Item::Link {
                    left,
                    relation: *relation,
                    right,
                    regime: regime.as_ref(),
                });
                left = right;
            }
        }
        Statement::All(parts) => parts.iter().for_each(|part| collect(part, items)),
        Statement::Definition {
            arguments,
            body,
            duties,
            ..
        } => items.extend(duties.iter().map(|duty| Item::Duty {
            arguments,
            body,
            duty,
        })),
        Statement::Conditional { .. } | Statement::Words | Statement::Empty => {}
    }
}

/// The point gives exactly the parameters, integers where they are asked for, and no draw has the
/// name of a parameter or of another draw.
fn check_names(proposition: &Proposition, point: &Point) -> Result<(), Unknown> {
    let mut names = BTreeSet::new();
    let (mut numbers, mut functions) = (0, 0);
    for parameter in &proposition.parameters {
        let given = match parameter.kind {
            ParameterKind::Function { .. } => {
                functions += 1;
                point.functions.contains_key(&parameter.name)
            }
            ParameterKind::Integer => {
                numbers += 1;
                point
                    .numbers
                    .get(&parameter.name)
                    .is_some_and(Rational::is_integer)
            }
            ParameterKind::Real => {
                numbers += 1;
                point.numbers.contains_key(&parameter.name)
            }
        };
        if !given || !names.insert(&parameter.name) {
            return Err(Unknown(format!(
                "{} is not given as its type asks",
                parameter.name
            )));
        }
    }
    if point.numbers.len() != numbers || point.functions.len() != functions {
        return unknown("the point gives a name that is no parameter");
    }
    match proposition
        .draws
        .iter()
        .find(|draw| !names.insert(&draw.name))
    {
        Some(draw) => Err(Unknown(format!("{} is declared twice", draw.name))),
        None => Ok(()),
    }
}

/// The point is certainly in the domain, and all laws are laws there.
fn check_domain(proposition: &Proposition, scope: &Scope) -> Result<(), Unknown> {
    for condition in &proposition.domain {
        if !holds(condition, scope)? {
            return unknown("the point is not in the domain");
        }
    }
    for parameter in &proposition.parameters {
        if let ParameterKind::Function { kind, from, to, .. } = &parameter.kind {
            check_function(&parameter.name, *kind, from, to, scope)?;
        }
    }
    for draw in &proposition.draws {
        if law::weight(&draw.law, scope)?.is_none() {
            return unknown("a draw has no law at the point");
        }
    }
    Ok(())
}

/// A function is a polynomial, hence continuous, smooth and integrable; a density is also
/// nonnegative on its range with integral 1.
fn check_function(
    name: &Name,
    kind: FunctionKind,
    from: &Formula,
    to: &Formula,
    scope: &Scope,
) -> Result<(), Unknown> {
    calculus::polynomial_of(name, scope)?;
    let (FunctionKind::Density, Some((argument, body))) = (kind, scope.point.functions.get(name))
    else {
        return Ok(());
    };
    let law = Law::Density {
        argument: argument.clone(),
        body: body.clone(),
        from: from.clone(),
        to: to.clone(),
    };
    match law::weight(&law, scope)? {
        Some(_) => Ok(()),
        None => unknown("a function that is no density"),
    }
}

/// The refutation of a link or duty; `None` where it is proved to hold or neither side has a value.
fn failure(item: &Item, scope: &Scope) -> Result<Option<Refutation>, Unknown> {
    match item {
        Item::Link {
            left,
            relation,
            right,
            regime,
        } => {
            let expansion = matches!(relation, Relation::Asymptotic | Relation::Approximate)
                || has_order_term(left)
                || has_order_term(right)
                || regime.is_some_and(|regime| !regime.along.is_empty());
            if expansion {
                return unknown("the refutation of an expansion waits for constants");
            }
            compare(value_in(left, scope)?, *relation, value_in(right, scope)?)
        }
        Item::Duty {
            arguments: [argument],
            body,
            duty,
        } => duty_failure(argument, body, duty, scope),
        Item::Duty { .. } => unknown("a duty of a definition without exactly one argument"),
    }
}

fn compare(left: Value, relation: Relation, right: Value) -> Result<Option<Refutation>, Unknown> {
    let missing = |value: &Value| *value == Value::Undefined;
    let because = match (missing(&left), missing(&right)) {
        (true, true) => return Ok(None),
        (true, false) | (false, true) => Because::Undefined,
        (false, false) => {
            let Some(ordering) = left.compare(&right) else {
                return unknown("the enclosures of the two sides overlap");
            };
            if relation_allows(relation, ordering)? {
                return Ok(None);
            }
            if ordering.is_eq() {
                Because::Equal
            } else {
                Because::Disjoint
            }
        }
    };
    Ok(Some(Refutation {
        left,
        right,
        because,
    }))
}

fn duty_failure(
    argument: &Name,
    body: &Formula,
    duty: &Duty,
    scope: &Scope,
) -> Result<Option<Refutation>, Unknown> {
    let at =
        |place: &Interval| value_in(body, &scope.with(argument, Binding::Number(place.clone())));
    match duty {
        Duty::Density(from, to) => {
            let total = Formula::Ranged(Box::new(Ranged {
                kind: RangeKind::Integral,
                body: body.clone(),
                name: argument.clone(),
                from: from.clone(),
                to: to.clone(),
            }));
            for place in places(from, to, scope)? {
                let found =
                    at(&place).and_then(|v| compare(v, Relation::GreaterEqual, Value::exact(0)));
                if let Ok(Some(refutation)) = found {
                    return Ok(Some(because_of_duty(refutation)));
                }
            }
            let found = compare(value_in(&total, scope)?, Relation::Equal, Value::exact(1))?;
            Ok(found.map(because_of_duty))
        }
        Duty::Cumulative(from, to) => {
            let places = places(from, to, scope)?;
            let values: Vec<Value> = places.iter().map(at).collect::<Result<_, _>>()?;
            let ends = [(values.first(), 0), (values.last(), 1)];
            for (value, wanted) in ends {
                let value = value.cloned().unwrap_or(Value::Undefined);
                if let Some(found) = compare(value, Relation::Equal, Value::exact(wanted))? {
                    return Ok(Some(because_of_duty(found)));
                }
            }
            for pair in values.windows(2) {
                let found = compare(pair[0].clone(), Relation::LessEqual, pair[1].clone());
                if let Ok(Some(found)) = found {
                    return Ok(Some(because_of_duty(found)));
                }
            }
            unknown("no place was found where the cdf decreases")
        }
        Duty::Agrees(_) => unknown("agreement with another claim is no point's affair"),
    }
}

fn because_of_duty(found: Refutation) -> Refutation {
    Refutation {
        because: Because::Duty,
        ..found
    }
}

/// Equally spaced places from one end to the other, both counted in.
fn places(from: &Formula, to: &Formula, scope: &Scope) -> Result<Vec<Interval>, Unknown> {
    let (from, to) = (
        value_in(from, scope)?.finite(),
        value_in(to, scope)?.finite(),
    );
    let (Some(from), Some(to)) = (from, to) else {
        return unknown("a duty on a range without finite ends");
    };
    let width = to.minus(&from, scope.bits);
    let place = |i: i64| {
        let part = Interval::exact(Rational::new(i.into(), PLACES.into()));
        match i {
            PLACES => to.clone(),
            _ => from.plus(&width.times(&part, scope.bits), scope.bits),
        }
    };
    Ok((0..=PLACES).map(place).collect())
}

/// Whether an O or o stands anywhere in the formula.
fn has_order_term(f: &Formula) -> bool {
    let any = |parts: &[&Formula]| parts.iter().any(|part| has_order_term(part));
    match f {
        Formula::BigO(_) | Formula::LittleO(_) => true,
        Formula::Number(_) | Formula::Pi | Formula::Infinity | Formula::Name(_) => false,
        Formula::Apply(_, parts) | Formula::Call(_, parts) => parts.iter().any(has_order_term),
        Formula::Negate(a) | Formula::Factorial(a) | Formula::Antiderivative(a, _) => any(&[a]),
        Formula::Binary(_, a, b)
        | Formula::Derivative(a, _, b)
        | Formula::Density(a, b)
        | Formula::Cumulative(a, b) => any(&[a, b]),
        Formula::Ranged(r) => any(&[&r.body, &r.from, &r.to]),
        Formula::At(a, places) | Formula::Limit(a, places) => {
            any(&[a]) || places.iter().any(|(_, place)| has_order_term(place))
        }
        Formula::Indicator(c) | Formula::Truth(c) | Formula::Probability(c, _) => {
            condition_has_order_term(c)
        }
        Formula::If(c, a, b) => condition_has_order_term(c) || any(&[a, b]),
        Formula::Mean(a, _) | Formula::Variance(a, _) => any(&[a]),
    }
}

fn condition_has_order_term(condition: &Condition) -> bool {
    match condition {
        Condition::Chain(first, links) => {
            has_order_term(first) || links.iter().any(|(_, right)| has_order_term(right))
        }
        Condition::And(parts) | Condition::Or(parts) => parts.iter().any(condition_has_order_term),
        Condition::Not(part) => condition_has_order_term(part),
    }
}
