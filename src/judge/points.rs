//! Points of a claim's domain: the small ones in order of size, and seeded random ones.
//!
//! The size of a point is the total of its numerators and denominators, so that the first failure
//! found among the small points is the smallest witness.

use crate::evaluate::{self, Context, Outcome};
use crate::formula::{
    Budget, Condition, Draw, Formula, FunctionKind, Name, Parameter, ParameterKind, Part, Point,
    Proposition, Rational, Relation,
};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use std::collections::BTreeMap;

/// How often a point is sought that has a given value of one parameter.
const MARK_TRIES: usize = 4;

/// How far random values reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Integers to a dozen, fractions of such.
    Near,
    /// Integers to ten thousand, spread evenly over their logarithm.
    Far,
}

/// The domain of a proposition, prepared for the search of its points.
pub struct Domain<'a> {
    steps: Vec<Step<'a>>,
    functions: Vec<&'a Parameter>,
    draws: &'a [Draw],
    /// Conditions without a numeric parameter: they hold everywhere or nowhere.
    closed: Vec<Relating<'a>>,
    budget: &'a Budget,
}

/// One numeric parameter and the conditions that can be tested once it has a value.
struct Step<'a> {
    name: &'a Name,
    integer: bool,
    ready: Vec<Relating<'a>>,
}

/// A part of the domain: a single relation where it could be split so far, else a whole condition.
enum Relating<'a> {
    Pair(&'a Formula, Relation, &'a Formula, Condition),
    Whole(&'a Condition),
}

impl Relating<'_> {
    fn condition(&self) -> &Condition {
        match self {
            Relating::Pair(_, _, _, condition) => condition,
            Relating::Whole(condition) => condition,
        }
    }
}

/// The bounds that the conditions put on one parameter, the others being known.
#[derive(Default)]
struct Bounds {
    low: Option<Rational>,
    high: Option<Rational>,
}

impl<'a> Domain<'a> {
    /// Splits the domain of `proposition` into conditions that can be tested as values come in.
    pub fn new(proposition: &'a Proposition, budget: &'a Budget) -> Domain<'a> {
        let mut steps: Vec<Step> = Vec::new();
        let mut functions = Vec::new();
        for parameter in &proposition.parameters {
            match parameter.kind {
                ParameterKind::Integer | ParameterKind::Real => steps.push(Step {
                    name: &parameter.name,
                    integer: parameter.kind == ParameterKind::Integer,
                    ready: Vec::new(),
                }),
                ParameterKind::Function { .. } => functions.push(parameter),
            }
        }
        let mut closed = Vec::new();
        for relating in proposition.domain.iter().flat_map(split) {
            let names = Part::Condition(relating.condition()).free_names();
            match steps.iter().rposition(|step| names.contains(step.name)) {
                Some(last) => steps[last].ready.push(relating),
                None => closed.push(relating),
            }
        }
        Domain {
            steps,
            functions,
            draws: &proposition.draws,
            closed,
            budget,
        }
    }

    /// At most `count` points in order of size. The search ends when `visits` partial points have been
    /// tried, so a domain without small points costs no more than that.
    pub fn small(&self, count: usize, visits: usize) -> Vec<Point> {
        let mut found = Vec::new();
        if !self.closed_holds() {
            return found;
        }
        if self.steps.is_empty() {
            self.with_functions(Point::default(), &mut found, count, usize::MAX);
            return found;
        }
        let mut left = visits;
        let smallest = self.steps.len();
        for total in smallest..smallest + 60 {
            self.descend(
                0,
                total,
                &mut Point::default(),
                &mut found,
                count,
                &mut left,
            );
            if found.len() >= count || left == 0 {
                break;
            }
        }
        found
    }

    /// At most `count` random points, the same for the same seed.
    pub fn random(&self, count: usize, reach: Reach, seed: u64) -> Vec<Point> {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut found: Vec<Point> = Vec::new();
        if self.steps.is_empty() || !self.closed_holds() {
            return found;
        }
        for _ in 0..count * 8 {
            if found.len() >= count {
                break;
            }
            if let Some(point) = self.draw_point(reach, None, &mut rng) {
                let pick = rng.random_range(0..FUNCTIONS);
                let before = found.len();
                self.with_functions_from(point, &mut found, before + 1, pick);
            }
        }
        found
    }

    fn closed_holds(&self) -> bool {
        let point = Point::default();
        self.closed
            .iter()
            .all(|relating| self.holds(relating.condition(), &point))
    }

    fn holds(&self, condition: &Condition, point: &Point) -> bool {
        let context = Context {
            point,
            draws: self.draws,
            budget: self.budget,
        };
        evaluate::holds(condition, &context).unwrap_or(false)
    }

    fn descend(
        &self,
        index: usize,
        total: usize,
        point: &mut Point,
        found: &mut Vec<Point>,
        count: usize,
        left: &mut usize,
    ) {
        let step = &self.steps[index];
        let rest = self.steps.len() - index - 1;
        let sizes = if rest == 0 {
            total..=total
        } else {
            1..=total - rest
        };
        let bounds = self.bounds(step, point);
        for size in sizes {
            for value in values_of_size(size, step.integer) {
                if found.len() >= count || *left == 0 {
                    return;
                }
                if !bounds.admit(&value) {
                    continue;
                }
                *left -= 1;
                point.numbers.insert(step.name.clone(), value);
                if step
                    .ready
                    .iter()
                    .all(|relating| self.holds(relating.condition(), point))
                {
                    if rest == 0 {
                        self.with_functions(point.clone(), found, count, FUNCTIONS);
                    } else {
                        self.descend(index + 1, total - size, point, found, count, left);
                    }
                }
                point.numbers.remove(step.name);
            }
        }
    }

    /// Random points at which one parameter has one of the values: a statement's own constants are
    /// where its pieces meet and its bounds end.
    pub fn marked(&self, values: &[Rational], seed: u64) -> Vec<Point> {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut found: Vec<Point> = Vec::new();
        if !self.closed_holds() {
            return found;
        }
        for (step, value) in self
            .steps
            .iter()
            .flat_map(|step| values.iter().map(move |value| (step, value)))
        {
            let near = |rng: &mut _| self.draw_point(Reach::Near, Some((step.name, value)), rng);
            if let Some(point) = (0..MARK_TRIES).find_map(|_| near(&mut rng)) {
                let pick = rng.random_range(0..FUNCTIONS);
                let most = found.len() + 1;
                self.with_functions_from(point, &mut found, most, pick);
            }
        }
        found
    }

    /// A random point; `marked` parameter and value are part of it.
    fn draw_point(
        &self,
        reach: Reach,
        marked: Option<(&Name, &Rational)>,
        rng: &mut Xoshiro256PlusPlus,
    ) -> Option<Point> {
        let mut point = Point::default();
        for step in &self.steps {
            let bounds = self.bounds(step, &point);
            let mut settled = false;
            for _ in 0..6 {
                let value = if let Some((_, value)) = marked.filter(|(name, _)| *name == step.name)
                {
                    value.clone()
                } else if step.integer {
                    random_integer(&bounds, reach, rng)?
                } else {
                    random_rational(&bounds, reach, rng)
                };
                point.numbers.insert(step.name.clone(), value);
                let fits = !step.integer || point.numbers[step.name].is_integer();
                if fits
                    && step
                        .ready
                        .iter()
                        .all(|relating| self.holds(relating.condition(), &point))
                {
                    settled = true;
                    break;
                }
            }
            if !settled {
                return None;
            }
        }
        Some(point)
    }

    /// Bounds read off the relations that have the parameter alone on one side.
    fn bounds(&self, step: &Step, point: &Point) -> Bounds {
        let mut bounds = Bounds::default();
        for relating in &step.ready {
            if let Relating::Pair(left, relation, right, _) = relating {
                let (other, relation) = match (left, right) {
                    (Formula::Name(name), other) if name == step.name => (other, *relation),
                    (other, Formula::Name(name)) if name == step.name => {
                        (other, mirrored(*relation))
                    }
                    _ => continue,
                };
                if let Some(value) = self.number(other, point) {
                    bounds.tighten(relation, value);
                }
            }
        }
        bounds
    }

    fn number(&self, formula: &Formula, point: &Point) -> Option<Rational> {
        let context = Context {
            point,
            draws: self.draws,
            budget: self.budget,
        };
        match evaluate::exact(formula, &context) {
            Ok(Outcome::Value(value)) => value
                .as_rational()
                .map(|rational| crate::number::convert::from_rug(&rational)),
            _ => None,
        }
    }

    /// Adds the point with each of the first `most` choices of function parameters.
    fn with_functions(&self, point: Point, found: &mut Vec<Point>, count: usize, most: usize) {
        if self.functions.is_empty() {
            found.push(point);
            return;
        }
        for pick in 0..most.min(FUNCTIONS) {
            self.with_functions_from(point.clone(), found, count, pick);
        }
    }

    /// Adds the point with the `pick`-th choice of function parameters, if that choice is possible.
    fn with_functions_from(
        &self,
        mut point: Point,
        found: &mut Vec<Point>,
        count: usize,
        pick: usize,
    ) {
        for (index, parameter) in self.functions.iter().enumerate() {
            let ParameterKind::Function {
                argument,
                kind,
                from,
                to,
            } = &parameter.kind
            else {
                return;
            };
            let sample = &SAMPLES[(pick + 2 * index) % FUNCTIONS];
            let body = match kind {
                FunctionKind::Density => {
                    let (Some(from), Some(to)) =
                        (self.number(from, &point), self.number(to, &point))
                    else {
                        return;
                    };
                    if from >= to {
                        return;
                    }
                    density(argument, sample, &from, &to)
                }
                _ => powers(
                    &Formula::Name(argument.clone()),
                    &sample
                        .coefficients
                        .map(|c| Rational::from_integer(c.into())),
                ),
            };
            point
                .functions
                .insert(parameter.name.clone(), (argument.clone(), body));
        }
        if found.len() < count {
            found.push(point);
        }
    }
}

/// A function that parameters are tried with: coefficients, constant term first, of a polynomial. For
/// a density they are taken in absolute value and multiply powers of the distance to an origin.
struct Sample {
    coefficients: [i64; DEGREE + 1],
    origin: Origin,
}

/// From where the distance counts of which a density is a polynomial.
#[derive(Clone, Copy)]
enum Origin {
    Lower,
    Upper,
    /// Even powers only.
    Middle,
}

/// Rules that are exact for cubics, such as Simpson's, hold for no polynomial of a higher degree.
const DEGREE: usize = 5;

const fn sample(coefficients: [i64; DEGREE + 1], origin: Origin) -> Sample {
    Sample {
        coefficients,
        origin,
    }
}

/// Among the densities there must be falling ones as well as rising ones, and one that is not monotone.
const SAMPLES: [Sample; FUNCTIONS] = [
    sample([0, 1, 0, 0, 0, 0], Origin::Lower),
    sample([1, 0, 0, 0, 0, 0], Origin::Lower),
    sample([1, 2, 0, 0, 0, 0], Origin::Lower),
    sample([0, 0, 1, 0, 0, 0], Origin::Lower),
    sample([0, 2, 0, 0, 0, 0], Origin::Upper),
    sample([2, -1, 3, 0, 0, 0], Origin::Lower),
    sample([1, 1, -2, 1, 0, 0], Origin::Lower),
    sample([0, 0, 3, 0, 0, 0], Origin::Middle),
    sample([-3, 0, 0, 0, 5, 0], Origin::Upper),
    sample([3, -2, 0, 5, 1, -40], Origin::Lower),
];
const FUNCTIONS: usize = 10;

/// The formula of `sum c_i base^i`.
fn powers(base: &Formula, coefficients: &[Rational]) -> Formula {
    use crate::formula::Operator::{Add, Multiply, Power};
    let mut sum: Option<Formula> = None;
    for (power, coefficient) in coefficients.iter().enumerate() {
        if coefficient.is_zero() {
            continue;
        }
        let number = Formula::Number(coefficient.clone());
        let term = match power {
            0 => number,
            1 => Formula::binary(Multiply, number, base.clone()),
            _ => Formula::binary(
                Multiply,
                number,
                Formula::binary(Power, base.clone(), Formula::integer(power as i64)),
            ),
        };
        sum = Some(match sum {
            None => term,
            Some(sum) => Formula::binary(Add, sum, term),
        });
    }
    sum.unwrap_or_else(|| Formula::integer(0))
}

/// A density between `from` and `to`: nonnegative coefficients in a distance, divided by the integral.
fn density(argument: &Name, sample: &Sample, from: &Rational, to: &Rational) -> Formula {
    use crate::formula::Operator::Subtract;
    let name = Formula::Name(argument.clone());
    let number = |value: &Rational| Formula::Number(value.clone());
    let two = Rational::from_integer(2.into());
    let (base, reach, sides) = match sample.origin {
        Origin::Lower if from.is_zero() => (name, to - from, Rational::one()),
        Origin::Lower => (
            Formula::binary(Subtract, name, number(from)),
            to - from,
            Rational::one(),
        ),
        Origin::Upper => (
            Formula::binary(Subtract, number(to), name),
            to - from,
            Rational::one(),
        ),
        Origin::Middle => {
            let middle = (from + to) / &two;
            let base = Formula::binary(Subtract, name, number(&middle));
            (base, (to - from) / &two, two)
        }
    };
    let mut integral = Rational::zero();
    let mut power = reach.clone() * sides;
    for (i, coefficient) in sample.coefficients.iter().enumerate() {
        integral += Rational::new(coefficient.abs().into(), BigInt::from(i + 1)) * &power;
        power *= &reach;
    }
    let scaled = sample
        .coefficients
        .map(|c| Rational::from_integer(c.abs().into()) / &integral);
    powers(&base, &scaled)
}

impl Bounds {
    fn tighten(&mut self, relation: Relation, value: Rational) {
        match relation {
            Relation::Less | Relation::LessEqual => {
                if self.high.as_ref().is_none_or(|high| value < *high) {
                    self.high = Some(value);
                }
            }
            Relation::Greater | Relation::GreaterEqual => {
                if self.low.as_ref().is_none_or(|low| value > *low) {
                    self.low = Some(value);
                }
            }
            Relation::Equal => {
                self.tighten(Relation::LessEqual, value.clone());
                self.tighten(Relation::GreaterEqual, value);
            }
            _ => {}
        }
    }

    fn admit(&self, value: &Rational) -> bool {
        self.low.as_ref().is_none_or(|low| low <= value)
            && self.high.as_ref().is_none_or(|high| value <= high)
    }
}

/// The pairwise relations of a condition, as far as it is a conjunction.
fn split(condition: &Condition) -> Vec<Relating<'_>> {
    match condition {
        Condition::And(parts) => parts.iter().flat_map(split).collect(),
        Condition::Chain(first, links) => {
            let mut left = first;
            let mut pairs = Vec::new();
            for (relation, right) in links {
                let alone = Condition::Chain(left.clone(), vec![(*relation, right.clone())]);
                pairs.push(Relating::Pair(left, *relation, right, alone));
                left = right;
            }
            pairs
        }
        _ => vec![Relating::Whole(condition)],
    }
}

fn mirrored(relation: Relation) -> Relation {
    match relation {
        Relation::Less => Relation::Greater,
        Relation::LessEqual => Relation::GreaterEqual,
        Relation::Greater => Relation::Less,
        Relation::GreaterEqual => Relation::LessEqual,
        other => other,
    }
}

/// The size of a point: numerators and denominators in total.
pub fn size(point: &Point) -> BigInt {
    point
        .numbers
        .values()
        .map(|value| value.numer().abs() + value.denom())
        .sum()
}

/// The values p/q in lowest terms with |p| + q = size, nonnegative first.
fn values_of_size(size: usize, integer: bool) -> Vec<Rational> {
    let mut values = Vec::new();
    let size = size as i64;
    let denominators = if integer { 1..=1 } else { 1..=size };
    for denominator in denominators {
        let numerator = size - denominator;
        if numerator.gcd(&denominator) != 1 {
            continue;
        }
        let value = Rational::new(numerator.into(), denominator.into());
        if numerator > 0 {
            values.push(-&value);
        }
        values.push(value);
    }
    values.sort_by(|a, b| {
        b.is_negative()
            .cmp(&a.is_negative())
            .reverse()
            .then(a.cmp(b))
    });
    values
}

fn random_integer(bounds: &Bounds, reach: Reach, rng: &mut Xoshiro256PlusPlus) -> Option<Rational> {
    let low = bounds.low.as_ref().map(|low| low.ceil().to_integer());
    let high = bounds.high.as_ref().map(|high| high.floor().to_integer());
    let value = match (low, high) {
        (Some(low), Some(high)) => {
            let width = (&high - &low).to_u64()?;
            match rng.random_range(0..4u32) {
                0 => low + BigInt::from(rng.random_range(0..=width.min(2))),
                1 => high - BigInt::from(rng.random_range(0..=width.min(2))),
                _ => low + BigInt::from(rng.random_range(0..=width)),
            }
        }
        (Some(low), None) => low + step_out(reach, rng),
        (None, Some(high)) => high - step_out(reach, rng),
        (None, None) => step_out(reach, rng) * if rng.random_bool(0.5) { 1 } else { -1 },
    };
    Some(Rational::from_integer(value))
}

/// How far from a bound a random integer lies.
fn step_out(reach: Reach, rng: &mut Xoshiro256PlusPlus) -> BigInt {
    match reach {
        Reach::Near => rng.random_range(0..=9u64).into(),
        Reach::Far => {
            let digits = rng.random_range(1..=4u32);
            rng.random_range(0..10u64.pow(digits)).into()
        }
    }
}

fn random_rational(bounds: &Bounds, reach: Reach, rng: &mut Xoshiro256PlusPlus) -> Rational {
    let most = match reach {
        Reach::Near => 12u64,
        Reach::Far => 10_000,
    };
    let denominator = rng.random_range(1..=most);
    match (&bounds.low, &bounds.high) {
        (Some(low), Some(high)) => {
            let part = Rational::new(rng.random_range(0..=denominator).into(), denominator.into());
            low + (high - low) * part
        }
        (low, high) => {
            let value = Rational::new(rng.random_range(0..=most).into(), denominator.into());
            match (low, high) {
                (Some(low), _) => low + value,
                (_, Some(high)) => high - value,
                _ if rng.random_bool(0.5) => -value,
                _ => value,
            }
        }
    }
}

/// Whether the conditions contradict each other by their constant bounds alone: a proof that the domain
/// has no point. Lower bounds travel along `a <= b`; a strict link between integers adds one.
pub fn contradictory(proposition: &Proposition) -> bool {
    let integer = |formula: &Formula| match formula {
        Formula::Name(name) => proposition
            .parameters
            .iter()
            .any(|parameter| parameter.name == *name && parameter.kind == ParameterKind::Integer),
        Formula::Number(value) => value.is_integer(),
        _ => false,
    };
    let mut edges: Vec<(&Formula, &Formula, bool)> = Vec::new();
    for relating in proposition.domain.iter().flat_map(split) {
        if let Relating::Pair(left, relation, right, _) = relating {
            match relation {
                Relation::Less => edges.push((left, right, true)),
                Relation::LessEqual => edges.push((left, right, false)),
                Relation::Greater => edges.push((right, left, true)),
                Relation::GreaterEqual => edges.push((right, left, false)),
                Relation::Equal => edges.extend([(left, right, false), (right, left, false)]),
                _ => {}
            }
        }
    }
    let mut lower: BTreeMap<&Name, (Rational, bool)> = Default::default();
    for _ in 0..=proposition.parameters.len() {
        for (small, large, strict) in &edges {
            let from = match small {
                Formula::Number(value) => (value.clone(), false),
                Formula::Name(name) => match lower.get(name) {
                    Some(bound) => bound.clone(),
                    None => continue,
                },
                _ => continue,
            };
            let whole = integer(small) && integer(large);
            let bound = match (strict, whole) {
                (true, true) => (from.0 + Rational::one(), false),
                (strict, _) => (from.0, from.1 || *strict),
            };
            match large {
                Formula::Number(value) if bound.0 > *value || (bound.0 == *value && bound.1) => {
                    return true;
                }
                Formula::Name(name) => {
                    let known = lower.get(name);
                    if known.is_none_or(|known| bound > *known) {
                        lower.insert(name, bound);
                    }
                }
                _ => {}
            }
        }
    }
    false
}
