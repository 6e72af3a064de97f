//! Neighbouring photons as columns of double intervals: one step of an expression at a time for all of
//! them, in wide lanes.

use super::expression::{Arithmetic, Variable};
use crate::formula::Function;
use crate::number::{Double, Interval, Lanes, Task, WIDTH};
use rug::Rational;
use rug::float::Round;

/// One value for all photons, or one for each.
#[derive(Clone, Debug)]
pub(super) enum Column {
    Same(Double),
    Each(Ends),
}

/// Intervals by their ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ends {
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Column {
    /// These numbers themselves.
    fn points(values: Vec<f64>) -> Column {
        Column::Each(Ends {
            low: values.clone(),
            high: values,
        })
    }

    /// The values of `count` photons one by one.
    pub(super) fn ends(self, count: usize) -> Ends {
        match self {
            Column::Same(value) => Ends {
                low: vec![value.low; count],
                high: vec![value.high; count],
            },
            Column::Each(ends) => ends,
        }
    }

    fn map(self, f: impl Fn(Double) -> Double) -> Column {
        match self {
            Column::Same(x) => Column::Same(f(x)),
            Column::Each(mut values) => {
                Lanes::best().run(Map(&mut values, f));
                Column::Each(values)
            }
        }
    }

    fn zip(self, other: Column, f: impl Fn(Double, Double) -> Double) -> Column {
        match (self, other) {
            (x, Column::Same(y)) => x.map(
                #[inline(always)]
                |x| f(x, y),
            ),
            (Column::Same(x), y) => y.map(
                #[inline(always)]
                |y| f(x, y),
            ),
            (Column::Each(mut values), Column::Each(others)) => {
                Lanes::best().run(Zip(&mut values, &others, f));
                Column::Each(values)
            }
        }
    }
}

/// One step for all photons.
struct Map<'a, F>(&'a mut Ends, F);

impl<F: Fn(Double) -> Double> Task for Map<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Map(Ends { low, high }, f) = self;
        for (low, high) in low.iter_mut().zip(high) {
            let y = f(Double {
                low: *low,
                high: *high,
            });
            (*low, *high) = (y.low, y.high);
        }
    }
}

/// One step for all photons with the values of another column.
struct Zip<'a, F>(&'a mut Ends, &'a Ends, F);

impl<F: Fn(Double, Double) -> Double> Task for Zip<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Zip(Ends { low, high }, others, f) = self;
        let others = others.low.iter().zip(&others.high);
        for ((low, high), (&l, &h)) in low.iter_mut().zip(high).zip(others) {
            let x = Double {
                low: *low,
                high: *high,
            };
            let y = f(x, Double { low: l, high: h });
            (*low, *high) = (y.low, y.high);
        }
    }
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
        Lanes::best().run(Least(&self.low, 1.0))
    }

    /// The greatest upper end.
    pub(super) fn greatest(&self) -> f64 {
        -Lanes::best().run(Least(&self.high, -1.0))
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

/// The least of the numbers times 1 or -1, lane by lane: a compiler must not change the order of comparisons by itself.
struct Least<'a>(&'a [f64], f64);

impl Task for Least<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let Least(values, sign) = self;
        let smaller = |a: f64, b: f64| if b < a || b.is_nan() { b } else { a };
        let (wide, last) = values.as_chunks::<WIDTH>();
        let mut lanes = [f64::INFINITY; WIDTH];
        for values in wide {
            for (lane, value) in lanes.iter_mut().zip(values) {
                *lane = smaller(*lane, sign * value);
            }
        }
        let last = last.iter().map(|value| sign * value);
        lanes.into_iter().chain(last).fold(f64::INFINITY, smaller)
    }
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

impl Arithmetic for Photons<'_> {
    type Value = Column;

    fn number(&self, value: &Rational) -> Column {
        let interval = Interval::from_rational(value, 53);
        let low = interval.low().to_f64_round(Round::Down);
        let high = interval.high().to_f64_round(Round::Up);
        Column::Same(Double { low, high })
    }

    fn variable(&self, variable: Variable) -> Column {
        let around = |values: &[f64], bound: f64| {
            Column::points(values.to_vec()).map(
                #[inline(always)]
                |x| Double::around(x.low, bound),
            )
        };
        // Whole numbers up to 2^53 are doubles, and no shell lies so far out.
        let count = self.excess.len() as u64;
        let from = |first: u64| Column::points((first..first + count).map(|n| n as f64).collect());
        match variable {
            Variable::Photon => from(self.first),
            Variable::Position => self.position.map_or(Column::Same(Double::point(1.0)), from),
            Variable::Count => Column::Same(Double::point(self.count as f64)),
            Variable::Excess => around(self.excess, self.excess_bound),
            Variable::Variance => around(self.variance, self.variance_bound),
        }
    }

    fn plus(&self, a: Column, b: Column) -> Column {
        a.zip(b, Double::plus)
    }

    fn times(&self, a: Column, b: Column) -> Column {
        a.zip(b, Double::times)
    }

    fn power(&self, a: Column, n: u32) -> Column {
        let base = match n.is_multiple_of(2) {
            true => a.map(Double::magnitude),
            false => a,
        };
        let mut result = base.clone();
        for bit in (0..n.max(1).ilog2()).rev() {
            result = result.clone().zip(result, Double::times);
            if n >> bit & 1 == 1 {
                result = result.zip(base.clone(), Double::times);
            }
        }
        result
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
