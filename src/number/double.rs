//! Intervals of machine doubles, rounded outwards: quick, and wide after many steps. What they do not
//! decide, [`Interval`](super::Interval) does.
//!
//! Only `+ - * /` and the square root are used, which IEEE 754 rounds correctly: every machine has the same bits.
//!
//! **Theorem.** Let y be the exact result of one such operation on doubles and x the rounded one. Then [`down`]`(x) <= y <=`
//! [`up`]`(x)`. Proof. `|x - y| <= u |x| + 2^-1075`, u = 2^-53. For finite x the difference `x - (3u |x| + t)`, t = 2^-1022, is
//! computed with three roundings, off by at most `u |x| (1 + 9u) + t/2` together, so that it is at most
//! `x - 3u |x| - t + u |x| (1 + 9u) + t/2 <= x - u |x| - 2^-1075 <= y`. An infinite x stays or becomes a NaN. QED.
//!
//! A NaN as an end says that nothing is known there, not even that there is a value: every operation hands it on,
//! and no comparison holds for it.

/// A set of reals between two doubles; an infinite end is no bound, a NaN says that there may be no value at all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double {
    pub low: f64,
    pub high: f64,
}

/// 3u
const SLACK: f64 = 1.5 * f64::EPSILON;

/// Not above what was rounded to x.
#[inline(always)]
fn down(x: f64) -> f64 {
    x - (x.abs() * SLACK + f64::MIN_POSITIVE)
}

/// Not below what was rounded to x.
#[inline(always)]
fn up(x: f64) -> f64 {
    x + (x.abs() * SLACK + f64::MIN_POSITIVE)
}

/// The smaller number, or a NaN if there is one.
#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b || a.is_nan() { a } else { b }
}

/// The larger number, or a NaN if there is one.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

impl Double {
    /// Perhaps no value.
    pub const UNKNOWN: Double = Double {
        low: f64::NAN,
        high: f64::NAN,
    };

    /// One finite double.
    #[inline(always)]
    pub fn point(x: f64) -> Double {
        Double { low: x, high: x }
    }

    /// Whether both ends are finite numbers.
    #[inline(always)]
    pub fn is_finite(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// What lies within `bound |x|` of x, for 0 <= bound < 1/2; unknown around what is not finite.
    #[inline(always)]
    pub fn around(x: f64, bound: f64) -> Double {
        if !x.is_finite() {
            return Double::UNKNOWN;
        }
        let radius = up(x.abs() * bound);
        Double {
            low: down(x - radius),
            high: up(x + radius),
        }
    }

    /// a + b
    #[inline(always)]
    pub fn plus(self, other: Double) -> Double {
        Double {
            low: down(self.low + other.low),
            high: up(self.high + other.high),
        }
    }

    /// a - b
    #[inline(always)]
    pub fn minus(self, other: Double) -> Double {
        self.plus(other.negated())
    }

    /// -a
    #[inline(always)]
    pub fn negated(self) -> Double {
        Double {
            low: -self.high,
            high: -self.low,
        }
    }

    /// a b
    #[inline(always)]
    pub fn times(self, other: Double) -> Double {
        let (a, b) = (self.low * other.low, self.low * other.high);
        let (c, d) = (self.high * other.low, self.high * other.high);
        Double {
            low: down(smaller(smaller(a, b), smaller(c, d))),
            high: up(larger(larger(a, b), larger(c, d))),
        }
    }

    /// 1/a; unknown where a may be 0.
    #[inline(always)]
    pub fn reciprocal(self) -> Double {
        if self.low > 0.0 || self.high < 0.0 {
            Double {
                low: down(1.0 / self.high),
                high: up(1.0 / self.low),
            }
        } else {
            Double::UNKNOWN
        }
    }

    /// |a|
    #[inline(always)]
    pub fn magnitude(self) -> Double {
        Double {
            low: larger(larger(self.low, -self.high), 0.0),
            high: larger(self.high, -self.low),
        }
    }

    /// The square root; unknown where a may be negative.
    #[inline(always)]
    pub fn root(self) -> Double {
        if self.low >= 0.0 {
            Double {
                low: larger(down(self.low.sqrt()), 0.0),
                high: up(self.high.sqrt()),
            }
        } else {
            Double::UNKNOWN
        }
    }

    /// The smaller one of two numbers.
    #[inline(always)]
    pub fn smaller(self, other: Double) -> Double {
        Double {
            low: smaller(self.low, other.low),
            high: smaller(self.high, other.high),
        }
    }

    /// The larger one of two numbers.
    #[inline(always)]
    pub fn larger(self, other: Double) -> Double {
        Double {
            low: larger(self.low, other.low),
            high: larger(self.high, other.high),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rug::Rational;

    fn exact(x: f64) -> Rational {
        Rational::from_f64(x).expect("finite")
    }

    fn holds(x: Double, value: &Rational) -> bool {
        exact(x.low) <= *value && *value <= exact(x.high)
    }

    /// Numbers of all sizes whose products do not overflow.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            (-1e6..1e6f64),
            (-60i32..60, -9i64..10).prop_map(|(e, n)| n as f64 * 2f64.powi(e)),
            Just(0.0),
            Just(f64::MIN_POSITIVE),
            Just(5e-324),
        ]
    }

    proptest! {
        #[test]
        fn operations_hold_the_exact_results(a in number(), b in number()) {
            let (x, y) = (Double::point(a), Double::point(b));
            let (p, q) = (exact(a), exact(b));
            prop_assert!(holds(x.plus(y), &Rational::from(&p + &q)));
            prop_assert!(holds(x.minus(y), &Rational::from(&p - &q)));
            prop_assert!(holds(x.times(y), &Rational::from(&p * &q)));
            prop_assert!(holds(x.magnitude(), &Rational::from(p.abs_ref())));
            let reciprocal = y.reciprocal();
            if b == 0.0 {
                prop_assert!(!reciprocal.is_finite());
            } else if reciprocal.is_finite() {
                prop_assert!(holds(reciprocal, &q.clone().recip()));
            }
            let root = x.magnitude().root();
            prop_assert!(exact(root.low).square() <= p.clone().abs());
            prop_assert!(exact(root.high).square() >= p.abs());
        }

        #[test]
        fn operations_hold_what_is_inside(
            a in number(), b in number(), c in number(), d in number(), t in 0.0..1.0f64,
        ) {
            let wide = |a: f64, b: f64| Double { low: a.min(b), high: a.max(b) };
            let inside = |x: Double| (x.low + t * (x.high - x.low)).clamp(x.low, x.high);
            let (x, y) = (wide(a, b), wide(c, d));
            let (p, q) = (exact(inside(x)), exact(inside(y)));
            prop_assert!(holds(x.plus(y), &Rational::from(&p + &q)));
            prop_assert!(holds(x.times(y), &Rational::from(&p * &q)));
            prop_assert!(holds(x.smaller(y), &p.clone().min(q.clone())));
            prop_assert!(holds(x.larger(y), &p.max(q)));
        }
    }

    #[test]
    fn what_may_have_no_value_stays_so() {
        let void = Double::point(0.0).reciprocal();
        let three = Double::point(3.0);
        for x in [
            void.plus(three),
            void.times(Double::point(0.0)),
            Double::point(0.0).times(void),
            void.magnitude(),
            void.smaller(three),
            three.larger(void),
            void.root(),
            Double {
                low: -1.0,
                high: 1.0,
            }
            .root(),
            Double::around(f64::INFINITY, 1e-15),
        ] {
            assert!(x.low.is_nan() && x.high.is_nan(), "{x:?}");
        }
    }

    #[test]
    fn around_holds_what_is_within_the_bound() {
        for x in [1.0, -3.5, 1e-300, 123_456.789] {
            let wide = Double::around(x, 1e-15);
            for part in [-1i32, 0, 1] {
                let error = exact(1e-15) * exact(x).abs() * part;
                assert!(holds(wide, &(exact(x) + error)));
            }
        }
    }
}
