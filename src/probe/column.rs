//! Neighbouring photons as columns of double intervals: one step of an expression at a time for all of
//! them, which compilers turn into wide lanes.

use super::expression::{Arithmetic, Variable};
use crate::formula::Function;
use crate::number::{Double, Interval};
use rug::Rational;
use rug::float::Round;

/// One value for all photons, or one for each.
#[derive(Clone, Debug)]
pub(super) enum Column {
    Same(Double),
    Each { low: Vec<f64>, high: Vec<f64> },
}

impl Column {
    /// The value of each of `count` photons.
    pub(super) fn each(values: impl Iterator<Item = Double>) -> Column {
        let (low, high) = values.map(|x| (x.low, x.high)).unzip();
        Column::Each { low, high }
    }

    /// The values of `count` photons one by one.
    pub(super) fn ends(self, count: usize) -> Ends {
        match self {
            Column::Same(value) => Ends {
                low: vec![value.low; count],
                high: vec![value.high; count],
            },
            Column::Each { low, high } => Ends { low, high },
        }
    }

    fn map(self, f: impl Fn(Double) -> Double) -> Column {
        match self {
            Column::Same(x) => Column::Same(f(x)),
            Column::Each { mut low, mut high } => {
                for (low, high) in low.iter_mut().zip(&mut high) {
                    let y = f(Double {
                        low: *low,
                        high: *high,
                    });
                    (*low, *high) = (y.low, y.high);
                }
                Column::Each { low, high }
            }
        }
    }

    fn zip(self, other: Column, f: impl Fn(Double, Double) -> Double) -> Column {
        match (self, other) {
            (x, Column::Same(y)) => x.map(|x| f(x, y)),
            (Column::Same(x), y) => y.map(|y| f(x, y)),
            (Column::Each { mut low, mut high }, Column::Each { low: l, high: h }) => {
                for (((low, high), &l), &h) in low.iter_mut().zip(&mut high).zip(&l).zip(&h) {
                    let x = Double {
                        low: *low,
                        high: *high,
                    };
                    let y = f(x, Double { low: l, high: h });
                    (*low, *high) = (y.low, y.high);
                }
                Column::Each { low, high }
            }
        }
    }
}

/// Intervals by their ends.
pub(super) struct Ends {
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Ends {
    /// The value at a photon.
    pub(super) fn at(&self, index: usize) -> Double {
        Double {
            low: self.low[index],
            high: self.high[index],
        }
    }

    /// The least lower end; a NaN if there is one, `+inf` of none.
    pub(super) fn least(&self) -> f64 {
        least(self.low.iter().copied())
    }

    /// The greatest upper end.
    pub(super) fn greatest(&self) -> f64 {
        -least(self.high.iter().map(|x| -x))
    }

    /// Forgets the value at a photon.
    pub(super) fn forget(&mut self, index: usize) {
        (self.low[index], self.high[index]) = (f64::NAN, f64::NAN);
    }

    pub(super) fn where_least(&self) -> usize {
        let least = self.least();
        self.low.iter().position(|&x| x == least).unwrap_or(0)
    }

    pub(super) fn where_greatest(&self) -> usize {
        let greatest = self.greatest();
        self.high.iter().position(|&x| x == greatest).unwrap_or(0)
    }
}

/// In lanes: a compiler must not change the order of comparisons by itself.
fn least(values: impl Iterator<Item = f64>) -> f64 {
    const LANES: usize = 8;
    let smaller = |a: f64, b: f64| if b < a || b.is_nan() { b } else { a };
    let mut lanes = [f64::INFINITY; LANES];
    for (index, value) in values.enumerate() {
        let lane = &mut lanes[index % LANES];
        *lane = smaller(*lane, value);
    }
    lanes.into_iter().fold(f64::INFINITY, smaller)
}

/// Neighbouring photons of one shell, or of shells of one photon each.
pub(super) struct Photons<'a> {
    /// k of the first.
    pub(super) first: u64,
    /// l of the first; `None` where all have a shell of their own.
    pub(super) position: Option<u64>,
    /// m
    pub(super) count: u64,
    pub(super) excess: &'a [f64],
    pub(super) variance: &'a [f64],
    /// Bounds of the relative errors.
    pub(super) excess_bound: f64,
    pub(super) variance_bound: f64,
}

/// A whole number below 2^53 as it is, a larger one rounded outwards.
fn whole(n: u64) -> Double {
    let x = n as f64;
    if n < 1 << 53 {
        Double::point(x)
    } else {
        Double::around(x, f64::EPSILON)
    }
}

impl Arithmetic for Photons<'_> {
    type Value = Column;

    fn number(&self, value: &Rational) -> Column {
        let interval = Interval::from_rational(value, 53);
        let low = interval.low().to_f64_round(Round::Down);
        let high = interval.high().to_f64_round(Round::Up);
        Column::Same(Double { low, high })
    }

    fn variable(&self, variable: Variable) -> Column {
        let values = |values: &[f64], bound: f64| {
            Column::each(values.iter().map(|&x| Double::around(x, bound)))
        };
        let count = self.excess.len() as u64;
        match variable {
            Variable::Photon => Column::each((0..count).map(|i| whole(self.first + i))),
            Variable::Position => match self.position {
                Some(first) => Column::each((0..count).map(|i| whole(first + i))),
                None => Column::Same(whole(1)),
            },
            Variable::Count => Column::Same(whole(self.count)),
            Variable::Excess => values(self.excess, self.excess_bound),
            Variable::Variance => values(self.variance, self.variance_bound),
        }
    }

    fn plus(&self, a: Column, b: Column) -> Column {
        a.zip(b, Double::plus)
    }

    fn times(&self, a: Column, b: Column) -> Column {
        a.zip(b, Double::times)
    }

    fn power(&self, a: Column, n: u32) -> Column {
        a.map(|x| x.power(n))
    }

    fn reciprocal(&self, a: Column) -> Column {
        a.map(Double::reciprocal)
    }

    fn call(&self, function: Function, mut arguments: Vec<Column>) -> Column {
        let Some(last) = arguments.pop() else {
            return Column::Same(Double::UNKNOWN);
        };
        let all = arguments.into_iter();
        match function {
            Function::Abs => last.map(Double::magnitude),
            Function::Sqrt => last.map(Double::root),
            Function::Min => all.fold(last, |a, b| a.zip(b, Double::smaller)),
            Function::Max => all.fold(last, |a, b| a.zip(b, Double::larger)),
            // No function of the machine's library is proved to a bound.
            _ => Column::Same(Double::UNKNOWN),
        }
    }
}
