//! A claim, simulated from its own `draw` lines: the means, variances and probabilities of both sides are estimated from
//! the same runs, and the sides compared.
//!
//! Write the difference of the sides as a function D of the expectations v in it. Its estimate D(v') scatters, to first order,
//! as the mean over the runs of `sum_i (dD/dv_i) psi_i`, psi being `x - mean` for a mean, `(x - mean)^2 - var` for a variance
//! (the delta method; C. R. Rao, Linear Statistical Inference, 6a.2): from that comes the standard error, covariances and all.
//! The z-value is an approximation and counts only where [`z`](super::verdict::z) says so of each expectation by itself (of two
//! infinite ones, the difference may be tame) and of the whole, and where the sides do scatter apart by more than
//! rounding and than what the first order leaves out. Nothing is proved by it.

use super::law::Sampler;
use super::stream::{Key, Single};
use super::verdict::z::{Sample, Z};
use crate::evaluate::{Context, Failure, Program, Test};
use crate::formula::{Condition, Draw, Formula, Name, Operator, Part};

/// Both sides of a relation, simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Simulated {
    /// Each side, with its expectations estimated.
    pub left: f64,
    pub right: f64,
    /// The left side less the right one against 0.
    pub z: Z,
}

/// What one run gives to an expectation.
#[derive(Clone, Debug)]
enum Body {
    Mean(Program),
    Variance(Program),
    Probability(Test),
}

/// Both sides with names for the expectations in them.
#[derive(Clone, Debug)]
struct Experiment {
    samplers: Vec<Sampler>,
    bodies: Vec<Body>,
    left: Program,
    right: Program,
}

/// The least standard error of the difference, over the larger side: rounding is some 10^-15 of that.
const LEAST_ERROR: f64 = 1e-11;

/// What is left out of the delta method may be so much of the standard error.
const MOST_BEND: f64 = 0.1;

/// Numbers that are drawn in all runs, at most: some tenths of a second.
const MOST_DRAWN: u64 = 20_000_000;

/// Numbers that the runs may hold together.
const MOST_NUMBERS: u64 = 1 << 26;

/// How often, and with which random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draws {
    pub runs: u64,
    pub seed: u64,
    /// Experiments with one seed and different numbers are independent.
    pub number: u64,
}

/// Simulates `left` and `right` at a point.
///
/// ```
/// use claimcheck::evaluate::Context;
/// use claimcheck::formula::{Budget, Draw, Law, Point, parse_formula};
/// use claimcheck::simulate::{Draws, simulate_relation};
/// let formula = |text| parse_formula(text).expect("a formula");
/// let laws = [Draw { name: "x".into(), law: Law::Beta(formula("2"), formula("3")) }];
/// let context = Context { point: &Point::default(), draws: &laws, budget: &Budget::new(100_000) };
/// let draws = Draws { runs: 20_000, seed: 1, number: 0 };
/// let right = simulate_relation(&formula("var(x)"), &formula("1/25"), &context, draws)?;
/// assert!(right.z.counts && right.z.z.abs() < 5.0);
/// let wrong = simulate_relation(&formula("var(x)"), &formula("1/20"), &context, draws)?;
/// assert!(wrong.z.z < -10.0);
/// # Ok::<(), claimcheck::evaluate::Failure>(())
/// ```
///
/// # Errors
/// [`Failure::Unsupported`] where there is nothing to simulate, or an expectation stands where it cannot be (under a sum, a
/// limit, ...), or a run has no value; others as the evaluation of the rest meets them.
pub fn simulate_relation(
    left: &Formula,
    right: &Formula,
    context: &Context,
    draws: Draws,
) -> Result<Simulated, Failure> {
    let Draws { runs, seed, number } = draws;
    let experiment = Experiment::new(left, right, context)?;
    let cost: u64 = experiment.samplers.iter().map(Sampler::cost).sum();
    let kept = runs.saturating_mul(experiment.bodies.len() as u64);
    if runs < 2 || kept > MOST_NUMBERS || runs.saturating_mul(cost) > MOST_DRAWN {
        return Err(Failure::TooLarge(format!("{runs} runs of {cost} draws")));
    }
    let key = Key {
        seed,
        chunk: number,
        photon: 0,
    };
    let values = experiment.run(key, runs)?;
    experiment.conclude(&values)
}

impl Experiment {
    fn new(left: &Formula, right: &Formula, context: &Context) -> Result<Experiment, Failure> {
        let mut found = Found::default();
        let (left, right) = (found.without(left)?, found.without(right)?);
        if found.expectations.is_empty() {
            return Err(unsupported("a statement without expectations"));
        }
        let used = found.draws_used(context.draws)?;
        let names: Vec<Name> = used.iter().map(|draw| draw.name.clone()).collect();
        let samplers = used.iter().map(|draw| Sampler::new(&draw.law, context));
        let bodies = found.expectations.iter().map(|e| e.body(&names, context));
        let stands: Vec<Name> = (0..found.expectations.len()).map(stand_in).collect();
        Ok(Experiment {
            samplers: samplers.collect::<Result<_, _>>()?,
            bodies: bodies.collect::<Result<_, _>>()?,
            left: Program::new(&left, &stands, context)?,
            right: Program::new(&right, &stands, context)?,
        })
    }

    /// What each expectation gets from each run.
    fn run(&self, key: Key, runs: u64) -> Result<Vec<Vec<f64>>, Failure> {
        let mut stream = key.stream();
        let mut random = Single::new(&mut stream);
        let mut kept = vec![];
        let mut values = vec![Vec::with_capacity(runs as usize); self.bodies.len()];
        for _ in 0..runs {
            let drawn: Vec<f64> = self
                .samplers
                .iter()
                .map(|sampler| sampler.draw(&mut random, &mut kept))
                .collect();
            for (body, values) in self.bodies.iter().zip(&mut values) {
                let value = body.value(&drawn);
                if !value.is_finite() {
                    return Err(unsupported("a run without a value"));
                }
                values.push(value);
            }
        }
        Ok(values)
    }

    fn conclude(&self, values: &[Vec<f64>]) -> Result<Simulated, Failure> {
        let samples: Vec<Sample> = values.iter().map(|values| sample(values)).collect();
        let both = self.bodies.iter().zip(&samples);
        let estimates: Vec<f64> = both.map(|(body, sample)| body.estimate(sample)).collect();
        let influences: Vec<Vec<f64>> = (0..values.len())
            .map(|i| self.influences(i, &values[i], samples[i].mean(), estimates[i]))
            .collect();
        let errors: Vec<Option<Z>> = influences
            .iter()
            .map(|influences| sample(influences).against(0.0))
            .collect();
        let taylor = Taylor {
            difference: &|v| self.left.value(v) - self.right.value(v),
            middle: &estimates,
            widths: errors
                .iter()
                .map(|z| z.map_or(0.0, |z| z.standard_error))
                .collect(),
        };
        let mut scattered = vec![taylor.at(&[]); values.first().map_or(0, Vec::len)];
        for (index, influences) in influences.iter().enumerate() {
            let slope = taylor.slope(index);
            for (sum, influence) in scattered.iter_mut().zip(influences) {
                *sum += slope * influence;
            }
        }
        let mut z = sample(&scattered)
            .against(0.0)
            .ok_or_else(|| unsupported("sides that do not scatter, or have no value"))?;
        let (left, right) = (self.left.value(&estimates), self.right.value(&estimates));
        let rounding = LEAST_ERROR * left.abs().max(right.abs());
        z.counts = z.counts
            && z.standard_error > rounding
            && taylor.bend() < MOST_BEND * z.standard_error
            // What never varied may be rare, not constant.
            && errors.iter().all(|error| error.is_some_and(|z| z.counts));
        Ok(Simulated { left, right, z })
    }

    /// psi of each run: what it adds to the error of an estimate.
    fn influences(&self, index: usize, values: &[f64], mean: f64, estimate: f64) -> Vec<f64> {
        let centred = values.iter().map(|value| value - mean);
        match self.bodies[index] {
            Body::Variance(_) => centred.map(|x| x * x - estimate).collect(),
            Body::Mean(_) | Body::Probability(_) => centred.collect(),
        }
    }
}

/// The difference of the sides around the estimates, as far out as these scatter.
struct Taylor<'a> {
    difference: &'a dyn Fn(&[f64]) -> f64,
    middle: &'a [f64],
    widths: Vec<f64>,
}

impl Taylor<'_> {
    /// D with these estimates moved by these widths.
    fn at(&self, moves: &[(usize, f64)]) -> f64 {
        let mut moved = self.middle.to_vec();
        for (index, step) in moves {
            moved[*index] += step * self.widths[*index];
        }
        (self.difference)(&moved)
    }

    /// dD/dv
    fn slope(&self, index: usize) -> f64 {
        match self.widths[index] > 0.0 {
            true => {
                (self.at(&[(index, 1.0)]) - self.at(&[(index, -1.0)])) / (2.0 * self.widths[index])
            }
            false => 0.0,
        }
    }

    /// The terms of second order: about what they shift the estimate of D by.
    fn bend(&self) -> f64 {
        let pairs = (0..self.middle.len()).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let term = |(i, j): (usize, usize)| {
            let both = self.at(&[(i, 1.0), (j, 1.0)]) + self.at(&[]);
            (both - self.at(&[(i, 1.0)]) - self.at(&[(j, 1.0)])).abs()
        };
        pairs.map(term).sum()
    }
}

fn sample(values: &[f64]) -> Sample {
    let mut sample = Sample::default();
    values.iter().for_each(|value| sample.add(*value));
    sample
}

impl Body {
    fn value(&self, drawn: &[f64]) -> f64 {
        match self {
            Body::Mean(program) | Body::Variance(program) => program.value(drawn),
            Body::Probability(test) => test
                .holds(drawn)
                .map_or(f64::NAN, |holds| f64::from(u8::from(holds))),
        }
    }

    fn estimate(&self, sample: &Sample) -> f64 {
        match self {
            Body::Mean(_) | Body::Probability(_) => sample.mean(),
            Body::Variance(_) => sample.variance(),
        }
    }
}

/// An expectation, as it stands in a formula.
#[derive(Clone, Debug)]
enum Expectation {
    Mean(Formula, Option<Draw>),
    Variance(Formula, Option<Draw>),
    Probability(Condition, Option<Draw>),
}

/// The expectations of two sides.
#[derive(Clone, Debug, Default)]
struct Found {
    expectations: Vec<Expectation>,
}

/// The name that stands for the expectation with this number; no formula has such a name.
fn stand_in(index: usize) -> Name {
    format!("expectation {index}").into()
}

fn unsupported(what: &str) -> Failure {
    Failure::Unsupported(what.to_owned())
}

impl Expectation {
    fn own(&self) -> Option<&Draw> {
        match self {
            Expectation::Mean(_, own)
            | Expectation::Variance(_, own)
            | Expectation::Probability(_, own) => own.as_ref(),
        }
    }

    fn part(&self) -> Part<'_> {
        match self {
            Expectation::Mean(body, _) | Expectation::Variance(body, _) => Part::Formula(body),
            Expectation::Probability(condition, _) => Part::Condition(condition),
        }
    }

    fn body(&self, names: &[Name], context: &Context) -> Result<Body, Failure> {
        Ok(match self {
            Expectation::Mean(body, _) => Body::Mean(Program::new(body, names, context)?),
            Expectation::Variance(body, _) => Body::Variance(Program::new(body, names, context)?),
            Expectation::Probability(condition, _) => {
                Body::Probability(Test::new(condition, names, context)?)
            }
        })
    }
}

impl Found {
    /// The formula with a name for each expectation that stands in its arithmetic.
    fn without(&mut self, formula: &Formula) -> Result<Formula, Failure> {
        let own = |own: &Option<Box<Draw>>| own.as_deref().cloned();
        let expectation = match formula {
            Formula::Mean(body, draw) => Expectation::Mean((**body).clone(), own(draw)),
            Formula::Variance(body, draw) => Expectation::Variance((**body).clone(), own(draw)),
            Formula::Probability(condition, draw) => {
                Expectation::Probability((**condition).clone(), own(draw))
            }
            Formula::Cumulative(quantity, bound) => {
                let links = vec![(crate::formula::Relation::LessEqual, (**bound).clone())];
                Expectation::Probability(Condition::Chain((**quantity).clone(), links), None)
            }
            Formula::Negate(a) => return Ok(Formula::Negate(Box::new(self.without(a)?))),
            Formula::Binary(operator, a, b) => {
                let (operator, a): (Operator, _) = (*operator, self.without(a)?);
                return Ok(Formula::binary(operator, a, self.without(b)?));
            }
            Formula::Call(function, parts) => {
                let parts = parts.iter().map(|part| self.without(part));
                return Ok(Formula::Call(*function, parts.collect::<Result<_, _>>()?));
            }
            other if holds_expectation(Part::Formula(other)) => {
                return Err(Failure::Unsupported(format!(
                    "the expectation in `{other}`"
                )));
            }
            other => return Ok(other.clone()),
        };
        let name = stand_in(self.expectations.len());
        self.expectations.push(expectation);
        Ok(Formula::Name(name))
    }

    /// The draws that the expectations need: those of the scope, and their own.
    fn draws_used(&self, scope: &[Draw]) -> Result<Vec<Draw>, Failure> {
        let mut used: Vec<Draw> = vec![];
        for expectation in &self.expectations {
            let names = expectation.part().free_names();
            let own = expectation.own();
            let of_scope = scope.iter().filter(|draw| {
                names.contains(&draw.name) && own.is_none_or(|own| own.name != draw.name)
            });
            for draw in own.into_iter().chain(of_scope) {
                match used.iter().find(|other| other.name == draw.name) {
                    Some(other) if other.law != draw.law => {
                        return Err(unsupported("two draws of one name"));
                    }
                    Some(_) => {}
                    None => used.push(draw.clone()),
                }
            }
        }
        Ok(used)
    }
}

/// Whether an expectation, or a density of a draw, stands anywhere in it.
fn holds_expectation(part: Part) -> bool {
    let mut found = matches!(
        part,
        Part::Formula(
            Formula::Mean(..)
                | Formula::Variance(..)
                | Formula::Probability(..)
                | Formula::Density(..)
                | Formula::Cumulative(..)
        )
    );
    part.each(&mut |inner, _| found = found || holds_expectation(inner));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{Budget, Law, Point, parse_formula};

    fn simulated(left: &str, right: &str, draws: &[(&str, Law)]) -> Result<Simulated, Failure> {
        let formula = |text: &str| parse_formula(text).expect("a formula");
        let draws: Vec<Draw> = draws
            .iter()
            .map(|(name, law)| Draw {
                name: (*name).into(),
                law: law.clone(),
            })
            .collect();
        let context = Context {
            point: &Point::default(),
            draws: &draws,
            budget: &Budget::new(1_000_000),
        };
        let draws = super::Draws {
            runs: 20_000,
            seed: 7,
            number: 0,
        };
        simulate_relation(&formula(left), &formula(right), &context, draws)
    }

    fn beta(a: &str, b: &str) -> Law {
        let formula = |text| parse_formula(text).expect("a formula");
        Law::Beta(formula(a), formula(b))
    }

    #[test]
    fn what_is_so_agrees_and_what_is_not_does_not() {
        let order = Law::Order(
            parse_formula("2").expect("a formula"),
            parse_formula("4").expect("a formula"),
            Box::new(beta("1", "1")),
        );
        let density = Law::Density {
            argument: "r".into(),
            body: parse_formula("2*r").expect("a formula"),
            from: parse_formula("0").expect("a formula"),
            to: parse_formula("1").expect("a formula"),
        };
        let small = beta("1/2", "3/2");
        for (left, right, law) in [
            ("mean(x)", "2/5", order.clone()),
            ("var(x)", "1/25", order.clone()),
            ("prob(x < 1/2)", "11/16", order),
            ("mean(1/(1 + x))", "2 - 2*ln(2)", density.clone()),
            ("cdf(x, 1/2)", "1/4", density),
            ("mean(x)/var(x)", "4", small),
        ] {
            let draws = [("x", law)];
            let found = simulated(left, right, &draws).expect(left);
            assert!(found.z.counts && found.z.z.abs() < 5.0, "{left}: {found:?}");
            let wrong = simulated(left, &format!("({right})*1.1"), &draws).expect(left);
            assert!(wrong.z.z < -5.0, "{left}: {wrong:?}");
        }
    }

    #[test]
    fn draws_of_their_own_and_several_draws() {
        let found = simulated(
            "mean(x*y)",
            "1/3*mean(z, z ~ uniform(0, 1))",
            &[("x", beta("1", "1")), ("y", beta("1", "2"))],
        );
        assert!(found.expect("simulated").z.z.abs() < 5.0);
    }

    #[test]
    fn what_cannot_be_simulated_is_said() {
        let draws = [("x", beta("1", "1"))];
        for left in [
            "1",
            "sum(mean(x^j), j = 1..3)",
            "density(x, 1/2)",
            "mean(gamma(x))",
            "mean(1/(x - x))",
        ] {
            assert!(simulated(left, "2", &draws).is_err(), "{left}");
        }
        assert!(simulated("mean(x)", "2", &[("x", Law::Any)]).is_err());
        // Infinite variance: there is a z, but it does not count.
        let heavy = simulated("mean(x^(-3/5))", "5/2", &draws).expect("simulated");
        assert!(!heavy.z.counts);
        // Infinite means whose difference is tame.
        let both = simulated("mean(1/x + x)", "mean(1/x)", &draws).expect("simulated");
        assert!(!both.z.counts);
        // The same number of every run, but for rounding.
        let same = simulated("var(x - 1/3)", "var(x)", &draws);
        assert!(same.is_err() || same.is_ok_and(|same| !same.z.counts));
        // The same but for n - 1: no scatter of first order.
        let same = simulated("var(x)", "mean(x^2) - mean(x)^2", &draws).expect("simulated");
        assert!(!same.z.counts);
    }
}
