//! Points of a claim's domain: the small ones in order of size, and seeded random ones.
//!
//! The size of a point is the total of its numerators and denominators, so that the first failure
//! found among the small points is the smallest witness.

use super::functions;
use super::values::{Bounds, Reach, random_integer, random_rational, values_of_size};
use crate::evaluate::{self, Context, Outcome};
use crate::formula::{
    Budget, Condition, Draw, Formula, Name, Parameter, ParameterKind, Part, Point, Proposition,
    Rational, Relation,
};
use num_bigint::BigInt;
use num_traits::Signed;
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

/// How often a point is sought that has a given value of one parameter.
const MARK_TRIES: usize = 4;

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
pub enum Relating<'a> {
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
                let pick = rng.random_range(0..functions::COUNT);
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
                        self.with_functions(point.clone(), found, count, functions::COUNT);
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
                let pick = rng.random_range(0..functions::COUNT);
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
        for pick in 0..most.min(functions::COUNT) {
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
            let range = self.number(from, &point).zip(self.number(to, &point));
            let Some(body) = functions::nth(pick + 2 * index, argument, *kind, range) else {
                return;
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

/// The pairwise relations of a condition, as far as it is a conjunction.
pub fn split(condition: &Condition) -> Vec<Relating<'_>> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::parse_proposition;

    fn points(text: &str, count: usize) -> Vec<String> {
        let proposition = parse_proposition(text).unwrap();
        let budget = Budget::new(1_000_000);
        let domain = Domain::new(&proposition, &budget);
        let text = |point: &Point| {
            let values: Vec<String> = point.numbers.values().map(ToString::to_string).collect();
            values.join(" ")
        };
        domain.small(count, 100_000).iter().map(text).collect()
    }

    const CHAIN: &str = "given int k\ngiven int n\ndomain 1 <= k <= n\nsays k <= n";

    #[test]
    fn small_points_come_in_order_of_size_and_none_is_missed() {
        let found = points(CHAIN, 6);
        assert_eq!(found, ["1 1", "1 2", "1 3", "2 2", "1 4", "2 3"]);
    }

    #[test]
    fn reals_are_fractions_in_lowest_terms() {
        let found = points("given real x\ndomain 0 <= x < 1\nsays x < 1", 6);
        assert_eq!(found, ["0", "1/2", "1/3", "1/4", "2/3", "1/5"]);
    }

    #[test]
    fn random_points_lie_in_the_domain_and_repeat_with_the_seed() {
        let proposition = parse_proposition(CHAIN).unwrap();
        let budget = Budget::new(1_000_000);
        let domain = Domain::new(&proposition, &budget);
        for reach in [Reach::Near, Reach::Far] {
            let found = domain.random(40, reach, 7);
            assert_eq!(found.len(), 40);
            for point in &found {
                assert!(point.numbers["k"] >= Rational::from_integer(1.into()));
                assert!(point.numbers["k"] <= point.numbers["n"]);
            }
            assert_eq!(found, domain.random(40, reach, 7));
        }
    }

    #[test]
    fn contradictions_are_seen_only_where_they_are() {
        let contradictory = |domain: &str| {
            let text = format!("given int k\ngiven int n\ndomain {domain}\nsays k <= n");
            crate::judge::vacuous::contradictory(&parse_proposition(&text).unwrap())
        };
        assert!(contradictory("3 <= k <= n and n < 3"));
        assert!(contradictory("0 < k and k < n and n < 2"));
        assert!(!contradictory("0 < k and k < n and n <= 2"));
        assert!(!contradictory("k <= n"));
    }
}
