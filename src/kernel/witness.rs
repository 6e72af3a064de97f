//! Refutations: a statement proved to fail at one point of its domain.
//!
//! The statement says that each of its links holds at every point of the domain, so that one point
//! is enough: its parameters are of their types, all conditions of the domain are certainly true
//! and all laws valid there, and one link fails.

use super::condition::{allows, holds, pairs, relate};
use super::fraction::Fraction;
use super::polynomial::Polynomial;
use super::quantity::{Value, as_value};
use super::scope::{Scope, full_tank};
use super::value::{evaluate, finite};
use super::{Gap, Unknown, known, law, unknown};
use crate::formula::{
    Condition, Duty, Formula, FunctionKind, Law, Name, Operator, Parameter, ParameterKind, Part,
    Point, Proposition, RangeKind, Ranged, Rational, Regime, Relation, Statement,
};
use std::collections::BTreeSet;

/// The bits tried one after the other.
const LADDER: [u64; 3] = [64, 256, 1024];
/// In how many parts a range is cut to find a place where a duty fails.
const PLACES: i64 = 60;

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

/// A relation that a statement claims at every point.
type Link = (Formula, Relation, Formula);

/// One thing that a statement says.
enum Item<'a> {
    Link(Link),
    /// Not for a single point to decide.
    Expansion,
    Duty(&'a [Name], &'a Formula, &'a Duty),
}

/// Checks that a statement fails at a point.
///
/// # Errors
/// [`Unknown`] with the reason where that is not proved: a point outside of the domain or not
/// proved inside, a link that holds, an expansion (its constants are not a point's affair), two
/// sides without value, or a value that the kernel cannot find.
pub fn check_witness(proposition: &Proposition, witness: &Witness) -> Result<Refutation, Unknown> {
    let statement = proposition.pointwise();
    let items = items(&statement);
    let item = item(&items, witness.link)?;
    at_the_point(proposition, &witness.point, |scope| match item {
        Item::Link(link) => failure(link, scope),
        Item::Duty(arguments, body, duty) => duty_failure(arguments, body, duty, scope),
        Item::Expansion => unknown("the refutation of an expansion waits for constants"),
    })?
    .ok_or_else(|| Unknown("the link is not seen to fail here".into()))
}

/// Checks that a statement says something at a point: it is certainly in the domain with all laws
/// valid, and at each of the links (counted as in [`Witness::link`]) both sides have a value there,
/// which are not proved to contradict the link. Of an equation, which is proved, one value is enough
/// where the other is not found: it is the same. A link is given with whether its sides are known to be
/// finite on the whole domain; then no value need be found. For a law that is not given, one that has
/// all the means is enough: they are finite for the uniform law on 0..1 where the two sides are.
///
/// # Errors
/// [`Unknown`] with the reason where that is not proved.
pub fn check_example(
    proposition: &Proposition,
    point: &Point,
    links: &[(usize, bool)],
) -> Result<(), Unknown> {
    let statement = proposition.pointwise();
    let items = items(&statement);
    let mut given = proposition.clone();
    let mut any = false;
    for draw in given.draws.iter_mut().filter(|d| d.law == Law::Any) {
        draw.law = Law::Uniform(Formula::integer(0), Formula::integer(1));
        any = true;
    }
    at_the_point(&given, point, |scope| {
        links
            .iter()
            .try_for_each(|&(link, finite)| match item(&items, link)? {
                Item::Link(link) if any => agreement_of_numbers(link, scope),
                Item::Link(link) => agreement(link, finite, scope),
                _ => unknown("a link that no single point has values for"),
            })
    })
}

fn item<'a, 'b>(items: &'b [Item<'a>], link: usize) -> Result<&'b Item<'a>, Unknown> {
    match items.get(link) {
        Some(item) => Ok(item),
        None => unknown("the statement has no such link"),
    }
}

/// What is found at a point of the domain, with as many bits as it needs.
fn at_the_point<T>(
    proposition: &Proposition,
    point: &Point,
    look: impl Fn(&Scope) -> Result<T, Unknown>,
) -> Result<T, Unknown> {
    check_names(proposition, point)?;
    let mut found = unknown("no bits were tried");
    for bits in LADDER {
        let fuel = full_tank();
        let scope = Scope::new(point, &proposition.draws, bits, &fuel);
        found = check_domain(proposition, &scope).and_then(|()| look(&scope));
        if found.is_ok() {
            break;
        }
    }
    found
}

/// The links and duties of a statement, from left to right.
fn items(statement: &Statement) -> Vec<Item<'_>> {
    match statement {
        Statement::Chain {
            first,
            links,
            regime,
        } => {
            let link = |(left, relation, right): (&Formula, Relation, &Formula)| {
                let link = (left.clone(), relation, right.clone());
                match is_expansion(&link, regime.as_ref()) {
                    true => Item::Expansion,
                    false => Item::Link(link),
                }
            };
            pairs(first, links).map(link).collect()
        }
        Statement::All(parts) => parts.iter().flat_map(items).collect(),
        Statement::Definition {
            arguments,
            body,
            duties,
            ..
        } => duties
            .iter()
            .map(|duty| Item::Duty(arguments, body, duty))
            .collect(),
        Statement::Conditional { .. } | Statement::Words | Statement::Empty => Vec::new(),
    }
}

fn is_expansion((left, relation, right): &Link, regime: Option<&Regime>) -> bool {
    matches!(relation, Relation::Asymptotic | Relation::Approximate)
        || has_order_term(Part::Formula(left))
        || has_order_term(Part::Formula(right))
        || regime.is_some_and(|regime| !regime.along.is_empty())
}

/// Whether an O or o, or a condition in the place of a number, stands anywhere in the formula.
fn has_order_term(part: Part) -> bool {
    if let Part::Formula(Formula::BigO(_) | Formula::LittleO(_) | Formula::Truth(_)) = part {
        return true;
    }
    let mut found = false;
    part.each(&mut |inner, _| found = found || has_order_term(inner));
    found
}

/// The point gives exactly the parameters, integers where they are asked for, and no draw has the
/// name of a parameter or of another draw.
fn check_names(proposition: &Proposition, point: &Point) -> Result<(), Unknown> {
    let given = |parameter: &Parameter| match parameter.kind {
        ParameterKind::Function { .. } => point.functions.contains_key(&parameter.name),
        ParameterKind::Real => point.numbers.contains_key(&parameter.name),
        ParameterKind::Integer => {
            let number = point.numbers.get(&parameter.name);
            number.is_some_and(Rational::is_integer)
        }
    };
    let parameters = &proposition.parameters;
    if !parameters.iter().all(given)
        || point.numbers.len() + point.functions.len() != parameters.len()
    {
        return unknown("the point does not give exactly the parameters, each of its type");
    }
    let draws = proposition.draws.iter().map(|draw| &draw.name);
    let names: Vec<&Name> = parameters.iter().map(|p| &p.name).chain(draws).collect();
    if names.iter().collect::<BTreeSet<_>>().len() < names.len() {
        return unknown("a name is declared twice");
    }
    Ok(())
}

/// The point is certainly in the domain, and all laws are laws there.
fn check_domain(proposition: &Proposition, scope: &Scope) -> Result<(), Unknown> {
    for condition in &proposition.domain {
        if !holds(condition, scope)? {
            return unknown("the point is not in the domain");
        }
    }
    for parameter in &proposition.parameters {
        check_function(parameter, scope)?;
    }
    for draw in &proposition.draws {
        known(
            law::weight(&draw.law, scope),
            "a draw has no law at the point",
        )?;
    }
    Ok(())
}

/// A function is a polynomial of its argument alone, hence continuous, smooth and integrable; a
/// density is also nonnegative on its range with integral 1.
fn check_function(parameter: &Parameter, scope: &Scope) -> Result<(), Unknown> {
    let ParameterKind::Function { kind, from, to, .. } = &parameter.kind else {
        return Ok(());
    };
    let Some((argument, body)) = scope.point.functions.get(&parameter.name) else {
        return unknown("a function that is not given");
    };
    let nothing = Point::default();
    let closed = scope.closed(&nothing, argument, Fraction::variable());
    let function = known(finite(body, &closed), "a function without values")?;
    if !function.as_polynomial().is_some_and(Polynomial::is_exact) {
        return unknown("a function that is not given as a polynomial");
    }
    if *kind == FunctionKind::Density {
        let law = Law::Density {
            argument: argument.clone(),
            body: body.clone(),
            from: from.clone(),
            to: to.clone(),
        };
        known(law::weight(&law, scope), "a function that is no density")?;
    }
    Ok(())
}

/// The refutation of a link; `None` where it is proved to hold or neither side has a value.
fn failure((left, relation, right): &Link, scope: &Scope) -> Result<Option<Refutation>, Unknown> {
    let sides = [evaluate(left, scope), evaluate(right, scope)];
    let because = match &sides {
        [Err(Gap::Unknown(why)), _] | [_, Err(Gap::Unknown(why))] => return Err(why.clone()),
        [Err(Gap::Undefined), Err(Gap::Undefined)] => return Ok(None),
        [Err(Gap::Undefined), _] | [_, Err(Gap::Undefined)] => Because::Undefined,
        [Ok(left), Ok(right)] => {
            let ordering = left.compare(right)?;
            match allows(*relation, ordering)? {
                true => return Ok(None),
                false if ordering.is_eq() => Because::Equal,
                false => Because::Disjoint,
            }
        }
    };
    let [left, right] = sides.map(as_value);
    Ok(Some(Refutation {
        left: left?,
        right: right?,
        because,
    }))
}

/// Both sides have a value, be it one that the kernel does not find: that of the other side of an
/// equation, or one where the sides are known to be `finite`. The relation is not seen to fail.
fn agreement((left, relation, right): &Link, finite: bool, scope: &Scope) -> Result<(), Unknown> {
    let tells = finite || *relation == Relation::Equal;
    let (left, right) = match (evaluate(left, scope), evaluate(right, scope)) {
        (Err(Gap::Unknown(_)), Err(Gap::Unknown(_))) if finite => return Ok(()),
        (Ok(_), Err(Gap::Unknown(_))) | (Err(Gap::Unknown(_)), Ok(_)) if tells => return Ok(()),
        (left, right) => (
            known(left, "a side without value")?,
            known(right, "a side without value")?,
        ),
    };
    match relate(&left, *relation, &right, scope) {
        Ok(false) => unknown("the two sides contradict the relation"),
        _ => Ok(()),
    }
}

/// Both sides are numbers, and the relation between them is not seen to fail.
fn agreement_of_numbers(link: &Link, scope: &Scope) -> Result<(), Unknown> {
    for side in [&link.0, &link.2] {
        known(evaluate(side, scope), "a side without value")?.number()?;
    }
    agreement(link, false, scope)
}

/// The refutation of a duty: the failure of one of the relations that it means. A place without
/// value is none, as a density may have poles.
fn duty_failure(
    arguments: &[Name],
    body: &Formula,
    duty: &Duty,
    scope: &Scope,
) -> Result<Option<Refutation>, Unknown> {
    let [argument] = arguments else {
        return unknown("a duty of a definition without exactly one argument");
    };
    let (from, to) = match duty {
        Duty::Density(from, to) | Duty::Cumulative(from, to) => (from, to),
        Duty::Agrees(_) => return unknown("agreement with another claim is no point's affair"),
    };
    let ordered = Condition::Chain(from.clone(), vec![(Relation::Less, to.clone())]);
    if !holds(&ordered, scope)? {
        return unknown("a duty on a range whose ends are not in order");
    }
    let mut reason = Ok(None);
    for link in relations(argument, body, duty, from, to) {
        match failure(&link, scope) {
            Ok(Some(found)) if found.because != Because::Undefined => {
                let because = Because::Duty;
                return Ok(Some(Refutation { because, ..found }));
            }
            Ok(None) => {}
            Ok(Some(_)) => reason = unknown("a definition without value on its range"),
            Err(why) => reason = Err(why),
        }
    }
    reason
}

/// What a duty means: a density is nowhere negative with integral 1; a cdf goes from 0 to 1 and
/// never decreases.
fn relations(name: &Name, body: &Formula, duty: &Duty, from: &Formula, to: &Formula) -> Vec<Link> {
    let integer = Formula::integer;
    let width = Formula::binary(Operator::Subtract, to.clone(), from.clone());
    let at = |i: i64| {
        let part = Formula::binary(Operator::Divide, integer(i), integer(PLACES));
        let step = Formula::binary(Operator::Multiply, width.clone(), part);
        let place = Formula::binary(Operator::Add, from.clone(), step);
        Formula::At(Box::new(body.clone()), vec![(name.clone(), place)])
    };
    let mut links = Vec::new();
    if let Duty::Density(..) = duty {
        links.extend((0..=PLACES).map(|i| (at(i), Relation::GreaterEqual, integer(0))));
        let total = Formula::Ranged(Box::new(Ranged {
            kind: RangeKind::Integral,
            body: body.clone(),
            name: name.clone(),
            from: from.clone(),
            to: to.clone(),
        }));
        links.push((total, Relation::Equal, integer(1)));
    } else {
        links.extend((0..PLACES).map(|i| (at(i), Relation::LessEqual, at(i + 1))));
        links.push((at(0), Relation::Equal, integer(0)));
        links.push((at(PLACES), Relation::Equal, integer(1)));
    }
    links
}
