//! Refutations: a statement proved to fail at one point of its domain.
//!
//! The statement says that each of its links holds at every point of the domain, so that one point
//! is enough: its parameters are of their types, all conditions of the domain are certainly true
//! and all laws valid there, and one link fails.

use super::condition::{holds, relate};
use super::integrand::relation_allows;
use super::interval::{Interval, Value};
use super::law;
use super::scope::{Binding, Scope, full_tank};
use super::value::value_in;
use super::{Unknown, calculus, unknown};
use crate::formula::{
    Duty, Formula, FunctionKind, Law, Name, ParameterKind, Part, Point, Proposition, RangeKind,
    Ranged, Rational, Regime, Relation, Statement,
};
use std::collections::BTreeSet;

/// The bits tried one after the other.
const LADDER: [u64; 7] = [64, 128, 256, 512, 1024, 2048, 4096];
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
            Ok(None) => {
                return unknown("the link is not seen to fail here, or neither side has a value");
            }
            Err(why) => reason = Err(why),
        }
    }
    reason
}

/// Checks that a statement says something at a point: it is certainly in the domain with all laws
/// valid, and at each of the links (counted as in [`Witness::link`]) both sides have a value there,
/// which are not proved to contradict the link.
///
/// # Errors
/// [`Unknown`] with the reason where that is not proved.
pub fn check_example(
    proposition: &Proposition,
    point: &Point,
    links: &[usize],
) -> Result<(), Unknown> {
    let mut items = Vec::new();
    collect(&proposition.statement, &mut items);
    check_names(proposition, point)?;
    let mut reason = unknown("no bits were tried");
    for bits in LADDER {
        let fuel = full_tank();
        let scope = Scope::new(point, &proposition.draws, bits, &fuel);
        let example = |link: &usize| match items.get(*link) {
            Some(Item::Link {
                left,
                relation,
                right,
                ..
            }) => agreement(left, *relation, right, &scope),
            _ => unknown("the statement has no such link"),
        };
        reason =
            check_domain(proposition, &scope).and_then(|()| links.iter().try_for_each(example));
        if reason.is_ok() {
            break;
        }
    }
    reason
}

/// Both sides have a value, and the relation between them is not seen to fail.
fn agreement(
    left: &Formula,
    relation: Relation,
    right: &Formula,
    scope: &Scope,
) -> Result<(), Unknown> {
    let (left, right) = (value_in(left, scope)?, value_in(right, scope)?);
    if left == Value::Undefined || right == Value::Undefined {
        return unknown("a side without value");
    }
    match relate(&left, relation, &right) {
        Ok(false) => unknown("the two sides contradict the relation"),
        _ => Ok(()),
    }
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
                || has_order_term(Part::Formula(left))
                || has_order_term(Part::Formula(right))
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
    let at = |place: &Interval| {
        let inner = scope.with(argument, Binding::Number(place.clone()));
        match value_in(body, &inner)? {
            Value::Undefined => unknown("a definition without value at a place of its range"),
            value => Ok(value),
        }
    };
    match duty {
        Duty::Density(from, to) => {
            let negative_somewhere = places(from, to, scope)?.iter().find_map(|place| {
                compare(at(place).ok()?, Relation::GreaterEqual, Value::exact(0)).ok()?
            });
            if let Some(found) = negative_somewhere {
                return Ok(Some(because_of_duty(found)));
            }
            let total = value_in(&integral_of(body, argument, from, to), scope)?;
            Ok(compare(total, Relation::Equal, Value::exact(1))?.map(because_of_duty))
        }
        Duty::Cumulative(from, to) => {
            let places = places(from, to, scope)?;
            let values: Vec<Value> = places.iter().map(at).collect::<Result<_, _>>()?;
            cdf_failure(&values)
        }
        Duty::Agrees(_) => unknown("agreement with another claim is no point's affair"),
    }
}

/// What shows that values at increasing places are not those of a cdf from end to end.
fn cdf_failure(values: &[Value]) -> Result<Option<Refutation>, Unknown> {
    for pair in values.windows(2) {
        let found = compare(pair[0].clone(), Relation::LessEqual, pair[1].clone());
        if let Ok(Some(found)) = found {
            return Ok(Some(because_of_duty(found)));
        }
    }
    for (value, wanted) in [(values.first(), 0), (values.last(), 1)] {
        if let Some(value) = value
            && let Some(found) = compare(value.clone(), Relation::Equal, Value::exact(wanted))?
        {
            return Ok(Some(because_of_duty(found)));
        }
    }
    Ok(None)
}

fn integral_of(body: &Formula, name: &Name, from: &Formula, to: &Formula) -> Formula {
    Formula::Ranged(Box::new(Ranged {
        kind: RangeKind::Integral,
        body: body.clone(),
        name: name.clone(),
        from: from.clone(),
        to: to.clone(),
    }))
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
    if from.compare(&to) != Some(std::cmp::Ordering::Less) {
        return unknown("a duty on a range whose ends are not in order");
    }
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

/// Whether an O or o, or a condition in the place of a number, stands anywhere in the formula.
fn has_order_term(part: Part) -> bool {
    if let Part::Formula(Formula::BigO(_) | Formula::LittleO(_) | Formula::Truth(_)) = part {
        return true;
    }
    let mut found = false;
    part.each(&mut |inner, _| found = found || has_order_term(inner));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{parse_formula, parse_proposition};

    fn rational(text: &str) -> Rational {
        text.parse().expect(text)
    }

    fn point(numbers: &[(&str, &str)]) -> Point {
        Point {
            numbers: numbers
                .iter()
                .map(|(n, q)| ((*n).into(), rational(q)))
                .collect(),
            functions: Default::default(),
        }
    }

    fn check(text: &str, numbers: &[(&str, &str)], link: usize) -> Result<Because, Unknown> {
        let proposition = parse_proposition(text).expect(text);
        let point = point(numbers);
        check_witness(&proposition, &Witness { point, link }).map(|r| r.because())
    }

    const VARIANCE: &str = "given int k\ngiven int n\ngiven real I\n\
        domain 1 <= k <= n\ndomain I > 0\ndraw r ~ beta(k, n - k + 1)\n\
        says var(I*k/(n*r)) == I^2*k^2*(-k + n + 1)/((k - 2)*(k - 1)^2*n)";

    #[test]
    fn the_variance_2_14_lacks_a_condition() {
        let at = |k, n| check(VARIANCE, &[("k", k), ("n", n), ("I", "1")], 0);
        assert_eq!(at("2", "2"), Ok(Because::Undefined));
        assert_eq!(at("2", "5"), Ok(Because::Undefined));
        // Neither side has a value; the sides are equal; the point is outside.
        assert!(at("1", "2").is_err());
        assert!(at("3", "4").is_err());
        assert!(at("3", "2").is_err());
        assert!(at("0", "2").is_err());
        assert!(at("5/2", "4").is_err());
        assert!(check(VARIANCE, &[("k", "2"), ("n", "2"), ("I", "1")], 1).is_err());
        assert!(check(VARIANCE, &[("k", "2"), ("n", "2")], 0).is_err());
        let extra = [("k", "2"), ("n", "2"), ("I", "1"), ("r", "1/2")];
        assert!(check(VARIANCE, &extra, 0).is_err());
    }

    #[test]
    fn the_sign_in_2_61_is_wrong() {
        let claim = |z: &str| {
            format!(
                "given real Va\ngiven real V\ndomain Va > 0\ndomain V > 0\n\
                 says hyp2f1r(1, 1; 2; {z}) == Va*ln((Va + V)/Va)/V"
            )
        };
        let at = [("Va", "1"), ("V", "1/2")];
        assert_eq!(check(&claim("V/Va"), &at, 0), Ok(Because::Disjoint));
        assert!(check(&claim("-V/Va"), &at, 0).is_err());
        let beyond = [("Va", "1"), ("V", "1")];
        assert_eq!(check(&claim("V/Va"), &beyond, 0), Ok(Because::Undefined));
    }

    #[test]
    fn links_are_counted_over_the_whole_statement() {
        let text = "given real x\nsays x == x < x and x != x <= x + 1";
        let at = [("x", "2/3")];
        assert!(check(text, &at, 0).is_err());
        assert_eq!(check(text, &at, 1), Ok(Because::Equal));
        assert_eq!(check(text, &at, 2), Ok(Because::Equal));
        assert!(check(text, &at, 3).is_err());
        assert!(check(text, &at, 4).is_err());
    }

    #[test]
    fn infinities_are_equal_and_far_from_numbers() {
        let text = "given int l\ndomain l >= 1\ndraw x ~ beta(l, 1)\n\
            says mean(1/x) == mean(1/x^2) and mean(1/x) == 2";
        assert!(check(text, &[("l", "1")], 0).is_err());
        assert_eq!(check(text, &[("l", "1")], 1), Ok(Because::Disjoint));
        assert_eq!(check(text, &[("l", "2")], 0), Ok(Because::Disjoint));
        assert!(check(text, &[("l", "2")], 1).is_err());
    }

    #[test]
    fn expansions_wait() {
        let text = "given int k\ndomain k >= 1\nsays 1/k == 1/k^2 + O(1/k^3) as k -> inf";
        assert!(check(text, &[("k", "2")], 0).is_err());
        let hidden = "given int k\ndomain k >= 1\nsays 1/k == 1/(k - k) + O(1/k) as k -> inf";
        assert!(check(hidden, &[("k", "2")], 0).is_err());
        let text = "given int k\ndomain k >= 1\nsays 1/k ~ 2/k as k -> inf";
        assert!(check(text, &[("k", "2")], 0).is_err());
    }

    #[test]
    fn examples_have_two_values_that_agree() {
        let example = |numbers: &[(&str, &str)], links: &[usize]| {
            let proposition = parse_proposition(VARIANCE).expect(VARIANCE);
            check_example(&proposition, &point(numbers), links).is_ok()
        };
        assert!(example(&[("k", "3"), ("n", "4"), ("I", "1/2")], &[0]));
        assert!(example(&[("k", "3"), ("n", "4"), ("I", "1/2")], &[]));
        for (k, n) in [("1", "2"), ("2", "2"), ("5", "4"), ("5/2", "4")] {
            assert!(!example(&[("k", k), ("n", n), ("I", "1")], &[0]));
        }
        assert!(!example(&[("k", "3"), ("n", "4"), ("I", "1/2")], &[1]));
        let text = "given real x\nsays ln(x) == ln(x) < 2 and int(1/t, t = 0..x) == inf";
        let proposition = parse_proposition(text).expect(text);
        for (x, links, holds) in [
            ("3", vec![0, 1, 2], true),
            ("9", vec![0, 2], true),
            ("9", vec![0, 1], false),
            ("0", vec![0], false),
        ] {
            let found = check_example(&proposition, &point(&[("x", x)]), &links);
            assert_eq!(found.is_ok(), holds, "{x} {links:?}");
        }
    }

    #[test]
    fn definitions_have_duties() {
        let duty = |text: &str, link| check(&format!("says {text}"), &[], link);
        assert!(duty("f(r) is 2*r with density on 0..1", 0).is_err());
        assert_eq!(
            duty("f(r) is 3*r with density on 0..1", 0),
            Ok(Because::Duty)
        );
        assert_eq!(
            duty("f(r) is 4*r - 1 with density on 0..1", 0),
            Ok(Because::Duty)
        );
        assert_eq!(
            duty("f(r) is 1/r with density on 0..1", 0),
            Ok(Because::Duty)
        );
        assert!(duty("F(r) is r^2 with cdf on 0..1", 0).is_err());
        assert_eq!(duty("F(r) is r^2/2 with cdf on 0..1", 0), Ok(Because::Duty));
        assert_eq!(
            duty("F(r) is r + 3*r*(1 - r) with cdf on 0..1", 0),
            Ok(Because::Duty)
        );
        assert!(duty("F(r) is r^2 with cdf on 0..1, agrees 2.3", 1).is_err());
    }

    #[test]
    fn functions_must_be_of_their_kind() {
        let claim = "given fn f(x) density on 0..1\ngiven real a\ndomain 0 <= a <= 1\n\
            says int(f(t), t = 0..a) == a";
        let proposition = parse_proposition(claim).expect(claim);
        let with = |body: &str| {
            let mut point = point(&[("a", "1/2")]);
            let body = parse_formula(body).expect(body);
            point.functions.insert("f".into(), ("x".into(), body));
            check_witness(&proposition, &Witness { point, link: 0 }).map(|r| r.because())
        };
        assert_eq!(with("2*x"), Ok(Because::Disjoint));
        assert!(with("1").is_err());
        assert!(with("3*x").is_err());
        assert!(with("4*x - 1").is_err());
        assert!(with("1/x").is_err());
        assert!(with("2*x + a - a").is_err());
    }

    #[test]
    fn draws_must_have_a_law_and_a_name_of_their_own() {
        let text = "given int k\ndraw r ~ beta(k, 1)\nsays mean(r) == 5";
        assert_eq!(check(text, &[("k", "1")], 0), Ok(Because::Disjoint));
        assert!(check(text, &[("k", "0")], 0).is_err());
        let text = "given int k\ndraw r ~ any\nsays 0 == 1";
        assert!(check(text, &[("k", "1")], 0).is_err());
    }

    /// 2.62: k = 1 has an infinite mean on the left and no logarithm on the right.
    #[test]
    fn the_limit_2_62_lacks_a_condition() {
        let text = "given int k\ngiven int l\ngiven int m\ngiven real I\n\
            domain 1 <= l <= m\ndomain 1 <= k\ndomain I > 0\ndraw x ~ beta(l, m - l + 1)\n\
            says lim(mean(I*k/(k - 1 + x)), m -> 1, l -> 1) == I*k*ln(k/(k - 1))";
        let at = |k| check(text, &[("k", k), ("l", "1"), ("m", "2"), ("I", "2")], 0);
        assert_eq!(at("1"), Ok(Because::Undefined));
        assert!(at("2").is_err());
    }
}
