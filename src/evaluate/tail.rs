//! Bounds of what is left of an integral up to infinity: from |f(x)| <= K x^m exp(-c x) for x >= T >= 1,
//! read off the integrand's tree,
//!
//! ```text
//! |int(f, x = T..inf)| <= K exp(-c T) * sum over k <= m of m!/(m-k)! T^(m-k)/c^(k+1)
//! ```

use super::integrand::{Node, Tree};
use super::jet::Jets;
use crate::number::Interval;
use rug::Float;
use rug::float::Special;

const BITS: u32 = 64;

/// Polynomial exponents are followed up to this degree, powers of x up to that one.
const MAX_DEGREE: usize = 8;
const MAX_POWER: u32 = 10_000;

/// |f(x)| <= scale * x^power * exp(-decay*x) for all x from the place on.
#[derive(Clone, Debug)]
struct Growth {
    scale: Interval,
    power: u32,
    decay: Interval,
}

fn small(value: i64) -> Interval {
    Interval::from_i64(value, BITS)
}

/// An upper bound of |int(f, x = from..inf)|, for `from` >= 1; `None` where no decay is seen.
pub(super) fn bound(tree: &Tree, from: u32) -> Option<Interval> {
    let start = small(i64::from(from));
    let growth = growth(tree, &start)?;
    if *growth.decay.low() <= 0 || growth.power > MAX_POWER {
        return None;
    }
    let mut term = start
        .powi(i64::from(growth.power))
        .ok()?
        .div(&growth.decay)
        .ok()?;
    let mut sum = term.clone();
    for k in 0..growth.power {
        let ratio = small(i64::from(growth.power - k)).div(&start.mul(&growth.decay));
        term = term.mul(&ratio.ok()?);
        sum = sum.add(&term);
    }
    let bound = growth.scale.mul(&growth.decay.mul(&start).neg().exp());
    Some(bound.mul(&sum).abs())
}

/// The growth by the tree's structure, else by its range from `start` to infinity.
fn growth(tree: &Node, start: &Interval) -> Option<Growth> {
    structural(tree, start).or_else(|| {
        let range = values(tree, start)?.abs();
        range.high().is_finite().then(|| constant(&range))
    })
}

fn constant(value: &Interval) -> Growth {
    Growth {
        scale: value.abs(),
        power: 0,
        decay: small(0),
    }
}

/// All values from `start` on.
fn values(tree: &Node, start: &Interval) -> Option<Interval> {
    let infinity = Float::with_val(BITS, Special::Infinity);
    let range = Interval::from_ends(start.low().clone(), infinity);
    let jets = Jets {
        order: 0,
        precision: BITS,
    };
    tree.jet(&range, jets).ok()?.first().cloned()
}

fn structural(tree: &Node, start: &Interval) -> Option<Growth> {
    match tree {
        Node::Number(value) => Some(constant(&Interval::from_rational(value, BITS))),
        Node::Constant(value) => Some(constant(&value.with_precision(BITS))),
        Node::Variable => Some(Growth {
            power: 1,
            ..constant(&small(1))
        }),
        Node::Negate(a) => growth(a, start),
        Node::Add(a, b) => Some(growth(a, start)?.add(&growth(b, start)?)),
        Node::Multiply(a, b) => Some(growth(a, start)?.multiply(&growth(b, start)?)),
        Node::Divide(a, b) => Some(growth(a, start)?.multiply(&reciprocal(b, &small(1), start)?)),
        Node::Power(a, n) if *n < 0 => reciprocal(a, &small(n.saturating_neg()), start),
        Node::Power(a, n) => growth(a, start)?.to(&small(*n)),
        Node::RealPower(a, s, _) if *s.high() < 0 => {
            reciprocal(a, &s.with_precision(BITS).neg(), start)
        }
        // There is a value for bases >= 0 only.
        Node::RealPower(a, s, _) if *s.low() > 0 && *values(a, start)?.low() >= 0 => {
            growth(a, start)?.to(&s.with_precision(BITS))
        }
        Node::Exp(a) => exponential(a, &small(1), start),
        Node::Ln(a) if *values(a, start)?.low() >= 1 => growth(a, start),
        Node::Sin(a) | Node::Cos(a) => values(a, start).map(|_| constant(&small(1))),
        _ => None,
    }
}

/// |b|^-s for s > 0.
fn reciprocal(b: &Node, s: &Interval, start: &Interval) -> Option<Growth> {
    if let Node::Exp(exponent) = b {
        return exponential(exponent, &s.neg(), start);
    }
    let least = values(b, start)?.abs();
    if *least.low() <= 0 {
        return None;
    }
    let most = Interval::from_ends(least.low().clone(), least.low().clone());
    Some(constant(&most.pow(&s.neg()).ok()?))
}

/// exp(s*g) for a polynomial g = g_0 + ... + g_d x^d: for g_d s < 0 and x >= T
///
/// s g(x) - s g_0 <= -q x^d,  q = -s g_d - sum over 0 < k < d of |s g_k| T^(k-d),
///
/// and x^d >= T^(d-1) x.
fn exponential(exponent: &Node, s: &Interval, start: &Interval) -> Option<Growth> {
    let jets = Jets {
        order: MAX_DEGREE,
        precision: BITS,
    };
    let polynomial = exponent.jet(&small(0), jets).ok()?;
    // A jet that ends before its order is the whole of a polynomial.
    let degree = polynomial.len() - 1;
    if degree >= MAX_DEGREE {
        return None;
    }
    let scale = s.mul(&polynomial[0]).exp();
    let mut rate = match degree {
        0 => small(0),
        _ => s.mul(&polynomial[degree]).neg(),
    };
    for (k, coefficient) in polynomial.iter().enumerate().take(degree).skip(1) {
        let power = i64::try_from(degree - k).ok()?;
        rate = rate.sub(
            &s.mul(coefficient)
                .abs()
                .div(&start.powi(power).ok()?)
                .ok()?,
        );
    }
    if degree > 1 {
        if *rate.low() <= 0 {
            return None;
        }
        rate = rate.mul(&start.powi(i64::try_from(degree - 1).ok()?).ok()?);
    }
    Some(Growth {
        scale,
        power: 0,
        decay: rate,
    })
}

impl Growth {
    fn add(&self, other: &Growth) -> Growth {
        Growth {
            scale: self.scale.add(&other.scale),
            power: self.power.max(other.power),
            decay: self.decay.min(&other.decay),
        }
    }

    fn multiply(&self, other: &Growth) -> Growth {
        Growth {
            scale: self.scale.mul(&other.scale),
            power: self.power.saturating_add(other.power),
            decay: self.decay.add(&other.decay),
        }
    }

    /// The power s > 0 of the bound, or 0.
    fn to(&self, s: &Interval) -> Option<Growth> {
        let power = s.mul(&small(i64::from(self.power)));
        let power = power.high().clone().ceil().to_integer()?.to_u32()?;
        // A bound 0 stays one.
        let scale = match self.scale.pow(s) {
            Ok(scale) => scale,
            Err(_) => self.scale.add(&small(1)).pow(s).ok()?,
        };
        Some(Growth {
            scale,
            power,
            decay: self.decay.mul(s),
        })
    }
}
