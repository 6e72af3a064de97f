//! Exact means of `k/U` and `(k/U)^2`, `U = Va + V*x`, `x ~ Beta(l, m-l+1)`.
//!
//! Write `F(l, m)` and `S(l, m)` for the means of `1/U` and `1/U^2`, and let the two ends stand in as
//! order statistics of rank 0 and m+1: `F(0, m) = 1/Va`, `F(m+1, m) = 1/(Va+V)`. For `Va > 0`:
//!
//! ```text
//! F(1, 1)                 = ln(1 + V/Va)/V
//! V*i/(i+1) * F(1, i+1)   = (Va+V)*F(1, i) - 1                (the mean of (1-x)/U in two ways)
//! i*(Va+V) * F(i+1, m)    = m - (m-i)*Va*F(i, m)              (the same, along a shell)
//! V * S(l, m)             = m*(F(l-1, m-1) - F(l, m-1))       (by parts)
//! ```
//!
//! So F and S are `A + B*ln(1 + V/Va)` with rational A and B, never divided by zero: `V > 0`, `i >= 1`.
//! For `Va = 0` the Beta moments themselves, DLMF 5.12.1: `F = m/(V(l-1))`, `S = m(m-1)/(V^2 (l-1)(l-2))`,
//! infinite where a denominator is not positive.

use super::Shell;
use crate::number::Exact;
use rug::{Integer, Rational};

/// The most photons of a shell for which [`moments`] computes: the numbers grow by some bits a step.
const MOST_PHOTONS: u32 = 4096;

/// Each step of the recurrence adds about the bits of the volumes to the numbers; no more than this in all.
const MOST_BITS: u64 = 1 << 20;

/// The means of `k/U` and `(k/U)^2`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Moments {
    pub mean: Moment,
    pub mean_square: Moment,
}

/// A mean of something positive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Moment {
    /// In `Q[ln(1 + V/Va)]`.
    Finite(Exact),
    /// `+inf`
    Infinite,
}

/// `rational + logarithm * ln(1 + V/Va)`; where `Va = 0` the second is 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogLinear {
    pub rational: Rational,
    pub logarithm: Rational,
}

/// Why there are no exact moments.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MomentError {
    /// Exact numbers would be out of proportion.
    #[error("the shell holds {0} photons, exact moments are computed for up to {MOST_PHOTONS}")]
    TooManyPhotons(Integer),
    /// The volumes have too many digits for the number of photons.
    #[error("the exact moments of this shell are too large")]
    TooLarge,
    /// No shell of the model; those of a [`super::Layout`] all are.
    #[error("a shell needs 1 <= l <= m, Va >= 0 and V > 0")]
    NoShell,
}

/// The exact means of `k/U` and `(k/U)^2` for photon `k` in `shell`.
///
/// # Errors
/// [`MomentError`]: a shell of too many photons, or no shell at all.
pub fn moments(k: &Integer, shell: &Shell) -> Result<Moments, MomentError> {
    let (l, m) = small(shell)?;
    let (first, second) = linear_means(shell, l, m);
    let square = Rational::from(k.clone() * k);
    Ok(Moments {
        mean: Moment::new(first.map(|f| f.times(&Rational::from(k))), shell)?,
        mean_square: Moment::new(second.map(|s| s.times(&square)), shell)?,
    })
}

/// The exact mean of `1/U`; `None` where it is infinite.
///
/// # Errors
/// As [`moments`].
pub fn mean_reciprocal(shell: &Shell) -> Result<Option<LogLinear>, MomentError> {
    let (l, m) = small(shell)?;
    Ok(match shell.inner == 0 {
        true => at_the_centre(&shell.volume, l, m).0,
        false => Some(inverse(shell, l, m)),
    })
}

/// l and m, where the exact numbers stay in proportion.
fn small(shell: &Shell) -> Result<(u32, u32), MomentError> {
    let (l, m) = (&shell.position, &shell.count);
    if *l < 1 || l > m || shell.inner < 0 || shell.volume <= 0 {
        return Err(MomentError::NoShell);
    }
    let few = |n: &Integer| n.to_u32().filter(|&n| n <= MOST_PHOTONS);
    let (Some(l), Some(m)) = (few(l), few(m)) else {
        return Err(MomentError::TooManyPhotons(m.clone()));
    };
    let bits = [&shell.inner, &shell.volume]
        .map(|q| u64::from(q.numer().significant_bits()) + u64::from(q.denom().significant_bits()));
    if (bits[0] + bits[1]).saturating_mul(m.into()) > MOST_BITS {
        return Err(MomentError::TooLarge);
    }
    Ok((l, m))
}

/// F and S; `None` is `+inf`.
fn linear_means(shell: &Shell, l: u32, m: u32) -> (Option<LogLinear>, Option<LogLinear>) {
    if shell.inner == 0 {
        return at_the_centre(&shell.volume, l, m);
    }
    let square = inverse_square(shell, l, m);
    (Some(inverse(shell, l, m)), Some(square))
}

impl Moments {
    /// The variance of `k/U`; `None` where the mean is not finite, or the exact value out of
    /// proportion.
    pub fn variance(&self) -> Option<Moment> {
        let Moment::Finite(mean) = &self.mean else {
            return None;
        };
        match &self.mean_square {
            Moment::Infinite => Some(Moment::Infinite),
            Moment::Finite(square) => Some(Moment::Finite(square.sub(&mean.mul(mean).ok()?))),
        }
    }
}

impl Moment {
    fn new(value: Option<LogLinear>, shell: &Shell) -> Result<Moment, MomentError> {
        let Some(value) = value else {
            return Ok(Moment::Infinite);
        };
        let rational = Exact::from_rational(&value.rational);
        if value.logarithm == 0 {
            return Ok(Moment::Finite(rational));
        }
        let argument = Rational::from(&shell.volume / &shell.inner) + 1u32;
        let logarithm = Exact::ln_of(&argument).ok_or(MomentError::NoShell)?;
        let term = logarithm.mul(&Exact::from_rational(&value.logarithm));
        let term = term.map_err(|_| MomentError::TooLarge)?;
        Ok(Moment::Finite(rational.add(&term)))
    }
}

impl LogLinear {
    fn rational(value: Rational) -> LogLinear {
        LogLinear {
            rational: value,
            logarithm: Rational::new(),
        }
    }

    fn times(mut self, factor: &Rational) -> LogLinear {
        self.rational *= factor;
        self.logarithm *= factor;
        self
    }

    fn plus(mut self, term: &Rational) -> LogLinear {
        self.rational += term;
        self
    }

    fn minus(mut self, other: &LogLinear) -> LogLinear {
        self.rational -= &other.rational;
        self.logarithm -= &other.logarithm;
        self
    }
}

/// F and S for `Va = 0`.
fn at_the_centre(volume: &Rational, l: u32, m: u32) -> (Option<LogLinear>, Option<LogLinear>) {
    let first = (l > 1).then(|| Rational::from((m, l - 1)) / volume);
    let second = (l > 2).then(|| {
        let above = Integer::from(m) * (m - 1);
        let below = Integer::from(l - 1) * (l - 2);
        Rational::from((above, below)) / volume / volume
    });
    (
        first.map(LogLinear::rational),
        second.map(LogLinear::rational),
    )
}

/// F(l, m) for `Va > 0` and `0 <= l <= m+1`.
fn inverse(shell: &Shell, l: u32, m: u32) -> LogLinear {
    let (a, v) = (&shell.inner, &shell.volume);
    let outer = Rational::from(a + v);
    if l == 0 {
        return LogLinear::rational(a.clone().recip());
    }
    if l > m {
        return LogLinear::rational(outer.recip());
    }
    let mut f = LogLinear {
        rational: Rational::new(),
        logarithm: v.clone().recip(),
    };
    for i in 1..m {
        let factor = Rational::from((i + 1, i)) / v;
        f = f.times(&outer).plus(&Rational::from(-1)).times(&factor);
    }
    for i in 1..l {
        let factor = Rational::from(a * (m - i));
        f = f.times(&-factor).plus(&Rational::from(m));
        f = f.times(&(Rational::from(&outer * i)).recip());
    }
    f
}

/// S(l, m) for `Va > 0` and `1 <= l <= m`.
fn inverse_square(shell: &Shell, l: u32, m: u32) -> LogLinear {
    let below = inverse(shell, l - 1, m - 1);
    let above = inverse(shell, l, m - 1);
    below
        .minus(&above)
        .times(&(Rational::from(m) / &shell.volume))
}

#[cfg(test)]
mod tests {
    use super::super::Layout;
    use super::*;
    use rug::ops::Pow;
    use std::cmp::Ordering;

    /// The mean of `U^-p` from the integral itself: with `r = Va/V`, divide the polynomial
    /// `x^(l-1) (1-x)^(m-l)` by `(x + r)^p` and integrate the quotient and the remainder.
    fn by_division(shell: &Shell, power: u32) -> LogLinear {
        let (l, m) = (
            shell.position.to_u32().expect("small"),
            shell.count.to_u32().expect("small"),
        );
        let r = Rational::from(&shell.inner / &shell.volume);
        let mut density = vec![Rational::new(); m as usize];
        for j in 0..=m - l {
            let sign = if j % 2 == 0 { 1 } else { -1 };
            density[(l - 1 + j) as usize] = Rational::from(Integer::from(m - l).binomial(j) * sign);
        }
        let mut remainders = Vec::new();
        for _ in 0..power {
            let mut carry = Rational::new();
            for c in density.iter_mut().rev() {
                let next = &*c - &r * carry.clone();
                *c = std::mem::replace(&mut carry, next);
            }
            remainders.push(carry);
        }
        let mut rational = Rational::new();
        for (i, c) in density.iter().enumerate() {
            rational += Rational::from(c / (i as u32 + 1));
        }
        if power == 2 {
            // The remainder of the first division sits over (x + r)^2, that of the second over x + r.
            let one = Rational::from(1);
            let ends = r.clone().recip() - (one + &r).recip();
            rational += &remainders[0] * ends;
        }
        let constant = Integer::from(Integer::factorial(m))
            / Integer::from(Integer::factorial(l - 1))
            / Integer::from(Integer::factorial(m - l));
        let logarithm = remainders.pop().expect("one or two");
        let mut value = LogLinear {
            rational,
            logarithm,
        }
        .times(&Rational::from(constant));
        for _ in 0..power {
            value = value.times(&shell.volume.clone().recip());
        }
        value
    }

    fn triangular(k: u32) -> Shell {
        Layout::Triangular
            .shell(&k.into())
            .expect("every k has a shell")
    }

    /// k F and k^2 S, before they become exact numbers.
    fn both(k: u32, shell: &Shell) -> (LogLinear, LogLinear) {
        let (l, m) = (shell.position.to_u32(), shell.count.to_u32());
        let (l, m) = (l.expect("small"), m.expect("small"));
        let (first, second) = linear_means(shell, l, m);
        (
            first.expect("finite").times(&Rational::from(k)),
            second.expect("finite").times(&Rational::from(k * k)),
        )
    }

    #[test]
    fn strategy_2_agrees_with_the_integral() {
        for k in 2..=60u32 {
            let shell = triangular(k);
            let (mean, square) = both(k, &shell);
            assert_eq!(mean, by_division(&shell, 1).times(&k.into()), "k = {k}");
            assert_eq!(
                square,
                by_division(&shell, 2).times(&Rational::from(k * k)),
                "k = {k}"
            );
        }
    }

    #[test]
    fn shells_of_fractional_volume_agree_with_the_integral() {
        for m in 1..=7u32 {
            for l in 1..=m {
                let shell = Shell {
                    inner: Rational::from((5, 7)),
                    volume: Rational::from((11, 3)),
                    position: l.into(),
                    count: m.into(),
                };
                let (mean, square) = both(1, &shell);
                assert_eq!(mean, by_division(&shell, 1));
                assert_eq!(square, by_division(&shell, 2));
            }
        }
    }

    #[test]
    fn the_first_shells_by_hand() {
        // k = 2: l = 1, m = 2, Va = 1, V = 2: E = 2*2*int (1-x)/(1+2x) = 3 ln 3 - 2.
        let (mean, _) = both(2, &triangular(2));
        assert_eq!(
            (mean.rational, mean.logarithm),
            (Rational::from(-2), Rational::from(3))
        );
        // k = 3: l = 2: 3*2*int x/(1+2x) = 3 - 3/2 ln 3.
        let (mean, _) = both(3, &triangular(3));
        assert_eq!(
            (mean.rational, mean.logarithm),
            (Rational::from(3), Rational::from((-3, 2)))
        );
    }

    #[test]
    fn a_whole_shell_adds_up_to_its_logarithm() {
        // The m photons of a shell are uniform in it: sum of E_k/k = m*ln(1+V/Va)/V, which is
        // ln((m+1)/(m-1)) in strategy 2.
        for m in [2u32, 3, 7, 20, 101] {
            let before = m * (m - 1) / 2;
            let mut sum = LogLinear::rational(Rational::new());
            for k in before + 1..=before + m {
                let (mean, _) = both(k, &triangular(k));
                sum = mean
                    .times(&Rational::from((1, k)))
                    .minus(&sum.times(&Rational::from(-1)));
            }
            assert_eq!(
                (sum.rational, sum.logarithm),
                (Rational::new(), Rational::from(1))
            );
        }
    }

    #[test]
    fn without_strata_the_means_are_those_of_the_beta_law() {
        let layout = Layout::Unstratified(10.into());
        let at = |k: u32| {
            let shell = layout.shell(&k.into()).expect("k <= n");
            moments(&k.into(), &shell).expect("small")
        };
        let finite = |p: u32, q: u32| Moment::Finite(Exact::from_rational(&Rational::from((p, q))));
        assert_eq!(at(1).mean, Moment::Infinite);
        assert_eq!(at(1).variance(), None);
        assert_eq!(at(2).mean, finite(2, 1));
        assert_eq!(at(2).variance(), Some(Moment::Infinite));
        // Of n photons: E = k/(k-1), E2 = k^2 (n-1)/(n (k-1) (k-2)).
        assert_eq!(at(4).mean, finite(4, 3));
        assert_eq!(at(4).mean_square, finite(16 * 9, 10 * 3 * 2));
        // Var = k^2 (n-k+1)/((k-2) (k-1)^2 n).
        assert_eq!(at(4).variance(), Some(finite(16 * 7, 2 * 9 * 10)));
    }

    #[test]
    fn one_photon_a_shell_has_the_moments_of_a_uniform_law() {
        // E = k ln(k/(k-1)), Var = k/(k-1) - E^2 for U uniform on [k-1, k].
        let exact = |k: u32| {
            let shell = Layout::One.shell(&k.into()).expect("every k has a shell");
            moments(&k.into(), &shell).expect("one photon")
        };
        for k in 2..=50u32 {
            let log = Exact::ln_of(&Rational::from((k, k - 1))).expect("positive");
            let mean = log.mul(&Exact::from_i64(k.into())).expect("small");
            let square = Exact::from_rational(&Rational::from((k, k - 1)));
            let variance = square.sub(&mean.mul(&mean).expect("small"));
            assert_eq!(exact(k).variance(), Some(Moment::Finite(variance)));
            assert_eq!(exact(k).mean, Moment::Finite(mean));
        }
        assert_eq!(exact(1).mean, Moment::Infinite);
    }

    #[test]
    fn strategy_2_overestimates_by_less_than_one_part_in_k() {
        // 1 + 1/k^2 < E_k < 1 + 1/k for k > 3, the thesis's conjecture, exactly and shell by shell.
        for k in 4..=130u32 {
            let exact = moments(&k.into(), &triangular(k)).expect("small");
            let Moment::Finite(mean) = exact.mean else {
                panic!("k = {k} is infinite");
            };
            let bound = |p: u32, q: u32| Exact::from_rational(&Rational::from((p, q)));
            let above = mean.sub(&bound(k * k + 1, k * k));
            let below = bound(k + 1, k).sub(&mean);
            assert_eq!(above.sign(), Some(Ordering::Greater), "k = {k}");
            assert_eq!(below.sign(), Some(Ordering::Greater), "k = {k}");
        }
    }

    #[test]
    fn large_shells_are_refused_not_attempted() {
        let k = Integer::from(10u64.pow(18));
        let shell = Layout::Triangular.shell(&k).expect("every k has a shell");
        assert_eq!(
            moments(&k, &shell),
            Err(MomentError::TooManyPhotons(shell.count.clone()))
        );
        let long = Rational::from((1, Integer::from(3).pow(1_000_000)));
        let shell = Shell {
            inner: long,
            ..triangular(5000)
        };
        assert_eq!(moments(&k, &shell), Err(MomentError::TooLarge));
        let shell = Shell {
            inner: Rational::from(-1),
            ..triangular(10)
        };
        assert_eq!(moments(&k, &shell), Err(MomentError::NoShell));
    }
}
