//! Draws from any law of the claim language, for one point of a claim's domain.

use super::beta::{beta, gamma};
use super::stream::Single;
use crate::evaluate::{Context, Failure, Program, float};
use crate::formula::{Formula, Law};

/// How far the mass of a table may be from 1: far less than what any number of runs here tells apart.
const MASS: f64 = 1e-5;

/// Steps of the table of a density.
const STEPS: u32 = 1 << 14;

/// Draws that are sorted for one order statistic, at most.
const MOST_SORTED: f64 = 1e6;

/// A law with numbers for its parameters.
#[derive(Clone, Debug)]
pub(super) enum Sampler {
    Beta(f64, f64),
    Uniform(f64, f64),
    /// The l-th smallest of m.
    Order(usize, usize, Box<Sampler>),
    Table(Table),
}

/// A density on an interval by its values at even steps, with straight lines between: the distribution function at the
/// same places.
#[derive(Clone, Debug)]
pub(super) struct Table {
    from: f64,
    step: f64,
    density: Vec<f64>,
    cumulative: Vec<f64>,
}

impl Sampler {
    /// # Errors
    /// [`Failure::Unsupported`] for `any`, for parameters that are no law, for a density that is not finite or on no
    /// finite interval, and for order statistics of very many draws.
    pub(super) fn new(law: &Law, context: &Context) -> Result<Sampler, Failure> {
        let number = |formula: &Formula| float(formula, context);
        let refused = || Err(Failure::Unsupported(format!("draws from `{law}`")));
        match law {
            Law::Beta(a, b) => match (number(a)?, number(b)?) {
                (a, b) if a > 0.0 && b > 0.0 => Ok(Sampler::Beta(a, b)),
                _ => refused(),
            },
            Law::Uniform(a, b) => match (number(a)?, number(b)?) {
                (a, b) if a < b && (b - a).is_finite() => Ok(Sampler::Uniform(a, b)),
                _ => refused(),
            },
            Law::Order(l, m, of) => {
                let (l, m) = (number(l)?, number(m)?);
                if !(l >= 1.0 && l <= m && l.fract() == 0.0 && m.fract() == 0.0) {
                    return refused();
                }
                match Sampler::new(of, context)? {
                    _ if m > MOST_SORTED => refused(),
                    of => Ok(Sampler::Order(l as usize, m as usize, Box::new(of))),
                }
            }
            Law::Density {
                argument,
                body,
                from,
                to,
            } => {
                let program = Program::new(body, std::slice::from_ref(argument), context)?;
                let table = Table::new(&program, number(from)?, number(to)?);
                table.map_or_else(refused, |table| Ok(Sampler::Table(table)))
            }
            Law::Any => refused(),
        }
    }

    /// How many numbers are drawn for one draw.
    pub(super) fn cost(&self) -> u64 {
        match self {
            Sampler::Order(_, m, of) => (*m as u64).saturating_mul(of.cost()),
            _ => 1,
        }
    }

    /// One draw. `kept` is room for those that are sorted.
    pub(super) fn draw(&self, random: &mut Single<'_>, kept: &mut Vec<f64>) -> f64 {
        match self {
            Sampler::Beta(a, b) => small_beta(random, *a, *b),
            Sampler::Uniform(a, b) => a + (b - a) * random.uniform(),
            Sampler::Order(l, m, of) => {
                let mut inner = vec![];
                kept.clear();
                kept.extend((0..*m).map(|_| of.draw(random, &mut inner)));
                *kept.select_nth_unstable_by(l - 1, f64::total_cmp).1
            }
            Sampler::Table(table) => table.quantile(random.uniform()),
        }
    }
}

/// Gamma variates with a parameter below 1 come from those above: `G(a) = G(a+1) u^(1/a)` (Marsaglia and Tsang, section 6).
fn small_beta(random: &mut Single<'_>, a: f64, b: f64) -> f64 {
    if a >= 1.0 && b >= 1.0 {
        return beta(random, a, b);
    }
    let mut small = |a: f64| match a >= 1.0 {
        true => gamma(random, a),
        false => gamma(random, a + 1.0) * random.uniform().powf(1.0 / a),
    };
    let (g, h) = (small(a), small(b));
    g / (g + h)
}

impl Table {
    fn new(density: &Program, from: f64, to: f64) -> Option<Table> {
        let step = (to - from) / f64::from(STEPS);
        let values = (0..=STEPS).map(|i| density.value(&[from + f64::from(i) * step]));
        let density: Vec<f64> = values.collect();
        let sound = |value: &f64| *value >= 0.0 && value.is_finite();
        if !(step > 0.0 && step.is_finite() && density.iter().all(sound)) {
            return None;
        }
        let mut cumulative = vec![0.0];
        let mut sum = 0.0;
        for pair in density.windows(2) {
            sum += (pair[0] + pair[1]) / 2.0 * step;
            cumulative.push(sum);
        }
        // A density has the mass 1; if the sum has not, it is none, or too steep for the table.
        ((sum - 1.0).abs() < MASS).then_some(Table {
            from,
            step,
            density,
            cumulative,
        })
    }

    /// Where the distribution function is u times its last value.
    fn quantile(&self, u: f64) -> f64 {
        let goal = u * self.cumulative.last().copied().unwrap_or(0.0);
        let after = self.cumulative.partition_point(|&value| value <= goal);
        let index = after.clamp(1, self.density.len() - 1) - 1;
        let (low, high) = (self.density[index], self.density[index + 1]);
        let rest = (goal - self.cumulative[index]) / self.step;
        // The root of `low t + (high - low) t^2/2 = rest`, in the form without cancellation.
        let root = (low * low + 2.0 * (high - low) * rest).max(0.0).sqrt();
        let t = match low + root {
            0.0 => 0.0,
            sum => 2.0 * rest / sum,
        };
        self.from + (index as f64 + t.clamp(0.0, 1.0)) * self.step
    }
}
