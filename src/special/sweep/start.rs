//! The value that a block is started from: g, the mean of 1/U, at one l.
//!
//! **Pfaff's series** (DLMF 15.8.1; also the Beta means of `1/U = 1/(b (1 - w y))`, y = 1 - x). With
//! b = a+m, w = m/b, q = m+1-l, s = m+1
//!
//! ```text
//! b g = 1 + r_0 (1 + r_1 (1 + ...)) = H_0,   H_j = 1 + r_j H_{j+1},   r_j = w (q+j)/(s+j) < w
//! ```
//!
//! all terms positive. H_j <= 1/(1-w) = b/a, which is at most 2 where a >= m.
//!
//! **Error.** Let p_j = r_0 ... r_{j-1}. Setting H_N = 0 changes H_0 by p_N H_N <= 2 p_N: half an ulp for
//! p_N <= 2^-(bits+2). An error in H_j counts p_j times in H_0; so H_j is kept to as many bits fewer as
//! p_j has zeros after the point. Where n groups of factors are taken together, each rounded down by an ulp
//! of its own 2^-(bits+guard), 2^guard > 2n, all of them make half an ulp. So H_0 comes out at most one ulp too
//! small; g = H_0/b, rounded down again, at most two.
//! The p_j are bounded in f64: every product is correctly rounded, and a factor 1 + 2^-48 outweighs the
//! roundings of a step (each 2^-53 in size, fewer than eight).

use super::plan::{Neighbours, START};
use crate::number::{DomainError, Interval};
use crate::special::hyp2f1;
use rug::Integer;
use rug::float::Round;

/// Consecutive factors taken together: H = (offset + factor*H')/divisor.
struct Group {
    offset: u64,
    factor: u64,
    divisor: u64,
    /// An error in this H counts in H_0 less than 2^-zeros times.
    zeros: u32,
}

/// A rational `r_j`, as numerator and denominator.
struct Ratios {
    numerator: u64,
    denominator: u64,
    q: u64,
    s: u64,
}

/// At most g 2^scale and less than [`START`] below it, g the mean of 1/U at l.
///
/// # Errors
/// As [`hyp2f1`], which is asked where the series is slow (a < m) or the numbers are large.
pub(super) fn start(block: &Neighbours, l: &Integer, scale: u32) -> Result<Integer, DomainError> {
    if block.inner >= block.size
        && let Some(ratios) = Ratios::new(block, l)
        && let Some(value) = ratios.pfaff(&block.outer(), scale)
    {
        return Ok(value);
    }
    general(block, l, scale)
}

impl Ratios {
    fn new(block: &Neighbours, l: &Integer) -> Option<Ratios> {
        let b = block.outer();
        let common = Integer::from(b.gcd_ref(&block.size));
        Some(Ratios {
            numerator: Integer::from(&block.size / &common).to_u64()?,
            denominator: Integer::from(&b / &common).to_u64()?,
            q: (Integer::from(&block.size - l) + 1u32).to_u64()?,
            s: Integer::from(&block.size + 1u32).to_u64()?,
        })
    }

    /// r_j; `None` past a word.
    fn at(&self, j: u64) -> Option<(u64, u64)> {
        let above = self.numerator.checked_mul(self.q.checked_add(j)?)?;
        let below = self.denominator.checked_mul(self.s.checked_add(j)?)?;
        // Half of a word, so that the offsets of a group, less than twice the divisor, fit too.
        (below < 1 << 62).then_some((above, below))
    }

    /// The groups until p_j is below 2^-bits.
    fn groups(&self, bits: u32) -> Option<Vec<Group>> {
        let mut groups = Vec::new();
        let mut size = Size::default();
        let mut j = 0;
        while size.zeros() < bits {
            let mut group = Group {
                offset: 0,
                factor: 1,
                divisor: 1,
                zeros: size.zeros(),
            };
            let mut taken = false;
            while let Some((above, below)) = self.at(j)
                && let Some(divisor) = group.divisor.checked_mul(below).filter(|d| *d < 1 << 62)
            {
                // 1 + (above/below) H', in place of the innermost H.
                group.offset = (group.offset + group.factor) * below;
                group.factor *= above;
                group.divisor = divisor;
                size.times(above, below);
                taken = true;
                j += 1;
            }
            if !taken {
                return None;
            }
            groups.push(group);
        }
        Some(groups)
    }

    fn pfaff(&self, b: &Integer, scale: u32) -> Option<Integer> {
        let bits = (scale + 2).saturating_sub(b.significant_bits());
        let groups = self.groups(bits + 2)?;
        let most = bits + 2 + usize::BITS - groups.len().leading_zeros();
        let mut sum = Integer::new();
        let mut before = 0;
        for group in groups.iter().rev() {
            let kept = most.saturating_sub(group.zeros);
            sum *= group.factor;
            sum <<= kept - before;
            sum += Integer::from(group.offset) << kept;
            sum /= group.divisor;
            before = kept;
        }
        let scaled = if scale > before {
            sum << (scale - before)
        } else {
            sum >> (before - scale)
        };
        Some(scaled / b)
    }
}

/// An upper bound of a product of factors below 1, as `fraction*2^-shifted`.
struct Size {
    fraction: f64,
    shifted: u32,
}

impl Default for Size {
    fn default() -> Size {
        Size {
            fraction: 1.0,
            shifted: 0,
        }
    }
}

impl Size {
    fn times(&mut self, above: u64, below: u64) {
        const SLACK: f64 = 1.0 + 1.0 / (1u64 << 48) as f64;
        const LARGE: f64 = (1u64 << 63) as f64;
        self.fraction *= above as f64 / below as f64 * SLACK;
        // A factor is more than 2^-62.
        if self.fraction < LARGE.recip() {
            self.fraction *= LARGE;
            self.shifted += 63;
        }
    }

    /// z with product < 2^-z, or 0.
    fn zeros(&self) -> u32 {
        // A positive normal number is below 2^(e - 1022), e its biased exponent.
        let exponent = (self.fraction.to_bits() >> 52) as u32;
        (self.shifted + 1022).saturating_sub(exponent)
    }
}

/// By the hypergeometric function, a g = F(1, l; m+1; -m/a) (DLMF 15.6.1).
fn general(block: &Neighbours, l: &Integer, scale: u32) -> Result<Integer, DomainError> {
    let mut bits = scale + 32;
    loop {
        let point = |x: &Integer| Interval::from_integer(x, bits.max(x.significant_bits()));
        let lower = Integer::from(&block.size + 1u32);
        let z = point(&block.size)
            .neg()
            .with_precision(bits)
            .div_integer(&block.inner)?;
        let one = Integer::from(1);
        let value = hyp2f1(&point(&one), &point(l), &point(&lower), &z, bits)?;
        let scaled = value
            .mul_integer(&(one << scale))
            .div_integer(&block.inner)?;
        let ends = (
            scaled.low().to_integer_round(Round::Down),
            scaled.high().to_integer_round(Round::Up),
        );
        if let (Some((low, _)), Some((high, _))) = ends
            && Integer::from(&high - &low) <= START
        {
            return Ok(low);
        }
        if bits > scale.saturating_mul(4) {
            return Err(DomainError::Possible);
        }
        bits *= 2;
    }
}
