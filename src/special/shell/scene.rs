//! A shell in machine words.

use super::ShellError;
use crate::model::Shell;
use rug::Rational;

/// No larger shift than this: beyond, series in w converge too slowly.
const MOST_SHIFT: u32 = 16;

/// A positive fraction of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fraction {
    pub(super) above: u64,
    pub(super) below: u64,
}

impl Fraction {
    /// In lowest terms; `None` for a denominator 0.
    fn reduced(above: u64, below: u64) -> Option<Fraction> {
        let (mut a, mut b) = (below, above);
        while b != 0 {
            (a, b) = (b, a % b);
        }
        Some(Fraction {
            above: above.checked_div(a)?,
            below: below.checked_div(a)?,
        })
    }
}

/// The numbers of a shell with `Va > 0`, A = Va+V, that the series need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Scene {
    /// V/A
    pub(super) w: Fraction,
    /// k/A, k = Va+l
    pub(super) k: Fraction,
    pub(super) l: u64,
    /// m+1-l
    pub(super) q: u64,
    /// m+1
    pub(super) s: u64,
    /// The least g with `w/(1-w) <= 2^g`
    pub(super) shift: u32,
    /// The denominator of the volumes: A = `k.below/unit`.
    unit: u64,
}

impl Scene {
    /// # Errors
    /// `Outside` where a number is no positive word, `Va` among them.
    pub(super) fn new(shell: &Shell) -> Result<Scene, ShellError> {
        Scene::in_words(shell).ok_or(ShellError::Outside)
    }

    fn in_words(shell: &Shell) -> Option<Scene> {
        let (l, m) = (shell.position.to_u64()?, shell.count.to_u64()?);
        let word = |value: &Rational| Some((value.numer().to_u64()?, value.denom().to_u64()?));
        let (inner, unit) = word(&shell.inner)?;
        let (volume, other) = word(&shell.volume)?;
        if l < 1 || l > m || inner == 0 || volume == 0 {
            return None;
        }
        // Over the denominator of both.
        let (inside, own) = (inner.checked_mul(other)?, volume.checked_mul(unit)?);
        let outer = inside.checked_add(own)?;
        let photon = inner
            .checked_add(l.checked_mul(unit)?)?
            .checked_mul(other)?;
        let s = m.checked_add(1)?;
        let w = Fraction::reduced(own, outer)?;
        let shift = (0..=MOST_SHIFT)
            .find(|&g| u128::from(w.above) <= u128::from(w.below - w.above) << g)?;
        Some(Scene {
            w,
            k: Fraction {
                above: photon,
                below: outer,
            },
            l,
            q: s - l,
            s,
            shift,
            unit: unit.checked_mul(other)?,
        })
    }

    /// p q and d s - p (q+1), w = p/d.
    pub(super) fn second_moment(&self) -> Option<(u64, u64)> {
        let (p, d) = (self.w.above, self.w.below);
        let falls = p.checked_mul(self.q.checked_add(1)?)?;
        let slope = d.checked_mul(self.s)?.checked_sub(falls)?;
        Some((p.checked_mul(self.q)?, slope))
    }

    /// (k - mu)/A = (l/A)(1 - V/s), about.
    pub(super) fn offset(&self) -> f64 {
        let outer = self.k.below as f64 / self.unit as f64;
        let volume = outer * (self.w.above as f64 / self.w.below as f64);
        self.l as f64 / outer * (1.0 - volume / self.s as f64)
    }
}
