//! What digits cost: each certified method of [`special::shell`](crate::special::shell), the choice among them and the
//! certified doubles, timed.
//!
//! A [`Question`] asks for a quantity of a photon of strategy 2 to so many digits; its [`Call`]s are the ways to answer it. What
//! counts is what an answer proves: the digits of its interval, not those asked for.
//!
//! ```
//! use claimcheck::measure::accuracy::{Question, Way};
//! use claimcheck::special::shell::Quantity;
//! let question = Question { quantity: Quantity::Variance, k: 5050, digits: 30 };
//! let calls = question.calls();
//! let choice = calls.iter().find(|call| call.way == Way::Choice).expect("always one of them");
//! assert!(choice.proved_digits().expect("it has a value") >= 30.0);
//! ```

use crate::model::{Layout, Shell};
use crate::number::{Double, Interval};
use crate::special::doubles::{Bounds, neighbours};
use crate::special::shell::{Method, Quantity, ShellError, choose, enclose};
use rug::Float;
use rug::float::Round;
use rug::ops::DivAssignRound;
use std::fmt::{self, Display, Formatter};
use std::hint::black_box;
use std::str::FromStr;
use std::time::Instant;

/// A round of calls lasts at least so long, in seconds.
const ROUND: f64 = 1e-3;

/// A quantity of photon k of strategy 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Question {
    pub quantity: Quantity,
    pub k: u64,
    /// Decimal digits: a relative width below 10^-digits.
    pub digits: u32,
}

/// Who answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Way {
    /// What [`enclose`] does.
    Choice,
    /// [`neighbours`], one photon alone, to as many digits as it has.
    Doubles,
    /// One method, with the bits that it is expected to need.
    Method(Method),
}

/// One way to answer a question.
#[derive(Clone, Debug)]
pub struct Call {
    pub question: Question,
    pub way: Way,
    shell: Shell,
    bits: u32,
    /// Instructions, about; infinite outside the domain.
    estimate: f64,
}

impl Way {
    /// All ways.
    pub fn all() -> impl Iterator<Item = Way> {
        let methods = Method::ALL.into_iter().map(Way::Method);
        [Way::Choice, Way::Doubles].into_iter().chain(methods)
    }
}

impl Display for Way {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Way::Choice => f.write_str("choice"),
            Way::Doubles => f.write_str("doubles"),
            Way::Method(method) => f.write_str(&format!("{method:?}").to_lowercase()),
        }
    }
}

/// No name of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no way to answer")]
pub struct NoWay;

impl FromStr for Way {
    type Err = NoWay;

    fn from_str(text: &str) -> Result<Way, NoWay> {
        Way::all().find(|way| way.to_string() == text).ok_or(NoWay)
    }
}

impl Question {
    /// The ways to answer; doubles to the digits that they have only.
    pub fn calls(self) -> Vec<Call> {
        let Some(shell) = Layout::Triangular.shell(&self.k.into()) else {
            return vec![];
        };
        let wanted = |way: &Way| *way != Way::Doubles || self.digits <= 15;
        Way::all()
            .filter(wanted)
            .map(|way| self.call(way, &shell))
            .collect()
    }

    fn call(self, way: Way, shell: &Shell) -> Call {
        let method = |method: Method| {
            let bits = method.bits_for(self.quantity, shell, self.digits);
            (bits, method.estimate(shell, bits))
        };
        let (bits, estimate) = match way {
            Way::Method(own) => method(own),
            Way::Doubles => (f64::MANTISSA_DIGITS, 0.0),
            Way::Choice => choose(self.quantity, shell, self.digits)
                .map_or((0, f64::INFINITY), |(best, _)| method(best)),
        };
        Call {
            question: self,
            way,
            shell: shell.clone(),
            bits,
            estimate,
        }
    }
}

impl Call {
    /// Instructions that it is expected to take; infinite outside the domain.
    pub fn estimate(&self) -> f64 {
        self.estimate
    }

    /// What the choice tries first; nothing for any other way.
    pub fn chosen(&self) -> Option<Way> {
        let Question {
            quantity, digits, ..
        } = self.question;
        let chosen = (self.way == Way::Choice).then(|| choose(quantity, &self.shell, digits));
        chosen?.ok().map(|(method, _)| Way::Method(method))
    }

    /// The answer.
    ///
    /// # Errors
    /// Outside the domain.
    pub fn answer(&self) -> Result<Interval, ShellError> {
        let quantity = self.question.quantity;
        match self.way {
            Way::Choice => enclose(quantity, &self.shell, self.question.digits),
            Way::Method(method) => method.enclose(quantity, &self.shell, self.bits),
            Way::Doubles => self.double().and_then(|(values, bounds)| {
                let value = enclosed(quantity, values, bounds).ok_or(ShellError::Outside)?;
                let [low, high] = [value.low, value.high].map(|x| Float::with_val(53, x));
                Ok(Interval::from_ends(low, high))
            }),
        }
    }

    /// E - 1 and Var, and their bounds.
    fn double(&self) -> Result<([f64; 2], Bounds), ShellError> {
        let shell = &self.shell;
        let words = [shell.inner.numer(), &shell.count, &shell.position].map(|n| n.to_u64());
        let [Some(inner), Some(size), Some(position)] = words else {
            return Err(ShellError::Outside);
        };
        let (mut excess, mut variance) = ([0.0], [0.0]);
        let bounds = neighbours(inner, size, position, &mut excess, &mut variance);
        let bounds = bounds.map_err(|_| ShellError::Outside)?;
        Ok(([excess[0], variance[0]], bounds))
    }

    /// How many decimal digits the answer proves: -log10 of its relative width, rounded down to a hundredth.
    ///
    /// # Errors
    /// Outside the domain, and `Lost` where it has none.
    pub fn proved_digits(&self) -> Result<f64, ShellError> {
        proved_digits(&self.answer()?).ok_or(ShellError::Lost)
    }

    /// Answers once; what instructions are counted of.
    #[inline(never)]
    pub fn run(&self) {
        match self.way {
            Way::Doubles => {
                let _ = black_box(self.double());
            }
            _ => {
                let _ = black_box(self.answer());
            }
        }
    }

    /// The seconds of a call by the clock: the mean over a round of at least a millisecond.
    pub fn seconds(&self) -> f64 {
        let start = Instant::now();
        for calls in 1.. {
            black_box(self).run();
            let spent = start.elapsed().as_secs_f64();
            if spent > ROUND {
                return spent / f64::from(calls);
            }
        }
        f64::INFINITY
    }
}

/// A quantity from E - 1 and Var with bounds; F is not among them.
fn enclosed(quantity: Quantity, [excess, variance]: [f64; 2], bounds: Bounds) -> Option<Double> {
    let excess = Double::around(excess, bounds.excess);
    match quantity {
        Quantity::Function => None,
        Quantity::Mean => Some(excess.plus(Double::point(1.0))),
        Quantity::Excess => Some(excess),
        Quantity::Variance => Some(Double::around(variance, bounds.variance)),
    }
}

/// -log10 of the relative width, rounded down to a hundredth; the digits of its precision for a point. `None` where nothing is known.
///
/// ```
/// use claimcheck::{measure::accuracy::proved_digits, number::Interval};
/// use rug::Rational;
/// let between = |a, b| Interval::from_ends(rug::Float::with_val(90, a), rug::Float::with_val(90, b));
/// assert_eq!(proved_digits(&between(1.0, 1.25)), Some(0.6));
/// assert_eq!(proved_digits(&between(-1.0, 1.0)), None);
/// ```
pub fn proved_digits(value: &Interval) -> Option<f64> {
    if value.is_point() {
        return Some((f64::from(value.precision()) * 2f64.log10()).floor());
    }
    if value.contains_zero() || !value.is_bounded() {
        return None;
    }
    let least = value.abs().low().clone();
    let mut relative = value.width();
    relative.div_assign_round(&least, Round::Up);
    // The exponent may lie far beyond that of doubles.
    let digits = -relative.log10().to_f64();
    Some((digits * 100.0).floor() / 100.0).filter(|digits| *digits > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_ways_prove_the_same_value() {
        for k in [4, 5, 55, 5050, 1_000_000_000_000] {
            for quantity in [Quantity::Mean, Quantity::Excess, Quantity::Variance] {
                for digits in [15, 60] {
                    let question = Question {
                        quantity,
                        k,
                        digits,
                    };
                    let calls = question.calls();
                    let cheap = calls.iter().filter(|call| call.estimate() < 1e7);
                    let answers: Vec<Interval> =
                        cheap.filter_map(|call| call.answer().ok()).collect();
                    assert!(answers.len() >= 4, "{question:?}: {}", answers.len());
                    // Intervals that overlap in pairs have a point in common.
                    for (index, one) in answers.iter().enumerate() {
                        assert!(answers[..index].iter().all(|other| one.overlaps(other)));
                    }
                }
            }
        }
    }

    #[test]
    fn ways_have_names_of_their_own() {
        for way in Way::all() {
            assert_eq!(way.to_string().parse(), Ok(way));
        }
        assert_eq!("simulation".parse::<Way>(), Err(NoWay));
    }
}
