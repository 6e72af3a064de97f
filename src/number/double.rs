//! Intervals of machine doubles, rounded outwards: quick, and wide after many steps. What they do not
//! decide, [`Interval`](super::Interval) does.
//!
//! Only `+ - * /` and the square root are used, which IEEE 754 rounds correctly: every machine has the same bits.
//!
//! **Theorem.** Let y be the exact result of one such operation on doubles and x the rounded one. Then [`down`]`(x) <= y <=`
//! [`up`]`(x)`. Proof. `|x - y| <= u |x| + 2^-1075`, u = 2^-53. For finite x the difference `x - (3u |x| + t)`, t = 2^-1022, is
//! computed with three roundings, off by at most `u |x| (1 + 9u) + t/2` together, so that it is at most
//! `x - 3u |x| - t + u |x| (1 + 9u) + t/2 <= x - u |x| - 2^-1075 <= y`. An infinite x becomes the whole line's end. QED.

/// A set of reals between two doubles; an infinite end is no bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double {
    pub low: f64,
    pub high: f64,
}

/// 3u
const SLACK: f64 = 1.5 * f64::EPSILON;

/// Not above what was rounded to x.
#[inline]
fn down(x: f64) -> f64 {
    let y = x - (x.abs() * SLACK + f64::MIN_POSITIVE);
    if y.is_nan() { f64::NEG_INFINITY } else { y }
}

/// Not below what was rounded to x.
#[inline]
fn up(x: f64) -> f64 {
    let y = x + (x.abs() * SLACK + f64::MIN_POSITIVE);
    if y.is_nan() { f64::INFINITY } else { y }
}

impl Double {
    /// All reals.
    pub const LINE: Double = Double {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// One double; [`Double::LINE`] for one that is not finite.
    #[inline]
    pub fn point(x: f64) -> Double {
        if x.is_finite() {
            Double { low: x, high: x }
        } else {
            Double::LINE
        }
    }

    /// What lies within `bound |x|` of x, for 0 <= bound < 1/2.
    #[inline]
    pub fn around(x: f64, bound: f64) -> Double {
        let radius = up(x.abs() * bound);
        Double {
            low: down(x - radius),
            high: up(x + radius),
        }
    }

    /// -1, 0 or 1 where all of it has that sign.
    #[inline]
    pub fn sign(self) -> Option<i8> {
        if self.low > 0.0 {
            Some(1)
        } else if self.high < 0.0 {
            Some(-1)
        } else if self.low == 0.0 && self.high == 0.0 {
            Some(0)
        } else {
            None
        }
    }

    /// a + b
    #[inline]
    pub fn plus(self, other: Double) -> Double {
        Double {
            low: down(self.low + other.low),
            high: up(self.high + other.high),
        }
    }

    /// a - b
    #[inline]
    pub fn minus(self, other: Double) -> Double {
        self.plus(other.negated())
    }

    /// -a
    #[inline]
    pub fn negated(self) -> Double {
        Double {
            low: -self.high,
            high: -self.low,
        }
    }

    /// a b
    #[inline]
    pub fn times(self, other: Double) -> Double {
        // 0 times an end that is no bound is 0: the numbers themselves are finite. `min` and `max` drop the NaN.
        let products = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        let zero = |x: f64| if x.is_nan() { 0.0 } else { x };
        let [a, b, c, d] = products.map(zero);
        Double {
            low: down(a.min(b).min(c.min(d))),
            high: up(a.max(b).max(c.max(d))),
        }
    }

    /// 1/a; the whole line where a may be 0.
    #[inline]
    pub fn reciprocal(self) -> Double {
        if self.low > 0.0 || self.high < 0.0 {
            Double {
                low: down(1.0 / self.high),
                high: up(1.0 / self.low),
            }
        } else {
            Double::LINE
        }
    }

    /// |a|
    #[inline]
    pub fn magnitude(self) -> Double {
        let low = self.low.max(-self.high).max(0.0);
        Double {
            low,
            high: self.high.max(-self.low),
        }
    }

    /// a^n, n >= 1
    pub fn power(self, n: u32) -> Double {
        let base = if n % 2 == 0 { self.magnitude() } else { self };
        let mut result = base;
        for bit in (0..31 - n.leading_zeros().min(31)).rev() {
            result = result.times(result);
            if n >> bit & 1 == 1 {
                result = result.times(base);
            }
        }
        result
    }

    /// The square root; the whole line where a may be negative.
    #[inline]
    pub fn root(self) -> Double {
        if self.low >= 0.0 {
            Double {
                low: down(self.low.sqrt()).max(0.0),
                high: up(self.high.sqrt()),
            }
        } else {
            Double::LINE
        }
    }

    /// The smaller one of two numbers.
    #[inline]
    pub fn smaller(self, other: Double) -> Double {
        Double {
            low: self.low.min(other.low),
            high: self.high.min(other.high),
        }
    }

    /// The larger one of two numbers.
    #[inline]
    pub fn larger(self, other: Double) -> Double {
        Double {
            low: self.low.max(other.low),
            high: self.high.max(other.high),
        }
    }
}
