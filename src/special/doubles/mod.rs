//! Certified doubles: `E_k - 1` and `Var_k` (of k/U) of whole shells and long ranges of photons as f64, with
//! proved bounds of the relative error, some nanoseconds a photon or less.
//!
//! [`Doubles`] walks over the photons of a layout, block by block; [`neighbours`] fills the caller's buffers
//! with the values of a part of one shell. Every value x comes with a bound B, the same for all of its block:
//! the true value v satisfies `|x - v| <= B x`. An infinite value is `+inf`.
//!
//! | photons | way | bounds of E - 1, Var in units of 2^-53 |
//! |---|---|---|
//! | most shells | central moments, `moments.rs` | 3.1 to 13, 13.1 to 28, computed for each |
//! | one a shell | two series, `one.rs` | 3.1, 10.2 |
//! | the innermost shell | rational, `centre.rs` | 1.001, 6.001 |
//! | few photons a shell, thick shells | [`sweep`](super::sweep), rounded | 1.02, 1.02 |
//!
//! For strategy 2 central moments serve all shells of 8 photons and more; from 40 on the bounds are at most
//! 3.6 and 13.2, from about 262,000 (k = 2^35) on 5.1 and 17.1.
//!
//! All but the last compute eight photons at a time by the operations `+ - * /` alone, each rounded to
//! nearest, on any processor in the same order: the results are the same to the bit everywhere. AVX-512 or
//! AVX2 is used where the processor has it ([`Lanes`]).
//!
//! ```
//! use claimcheck::model::Layout;
//! use claimcheck::special::doubles::Doubles;
//!
//! // An upper bound of Var_k for a million photons of strategy 2 from k = 10^12 on.
//! let first = 1_000_000_000_000;
//! let mut doubles = Doubles::new(&Layout::Triangular, first, first + 1_000_000)?;
//! let mut largest: f64 = 0.0;
//! while let Some(block) = doubles.next_block()? {
//!     assert!(block.bounds.variance < 18.0 * 2f64.powi(-53));
//!     for variance in block.variance {
//!         largest = largest.max(variance * (1.0 + block.bounds.variance));
//!     }
//! }
//! assert!(3.5e-19 < largest && largest < 3.6e-19);
//! # Ok::<(), claimcheck::special::doubles::DoublesError>(())
//! ```

mod centre;
mod kernel;
mod moments;
mod one;
mod places;
mod rounded;

use crate::model::Layout;
use crate::number::{DomainError, Lanes};
use centre::Centre;
use moments::Moments;
use one::One;
use places::{Place, Places};

/// Numbers of photons and volumes up to here are exact doubles, with room for sums.
const FARTHEST: u64 = 1 << 50;

/// Blocks hold no more photons than this, so that they stay in the processor's nearest cache.
const MOST_PHOTONS: usize = 1 << 11;

/// No more stretches of a shell are taken in a sample.
pub const MOST_STRETCHES: u64 = 1 << 12;

/// Bounds of relative errors: the true value v and the double x have `|x - v| <= bound * x`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Of `E_k - 1`.
    pub excess: f64,
    /// Of `Var_k`.
    pub variance: f64,
}

/// Neighbours in one shell (of [`Layout::One`]: in as many shells), with their values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block<'a> {
    /// k of the first.
    pub first: u64,
    /// The volume inside its shell.
    pub inner: u64,
    /// How many photons the shell holds; also its volume.
    pub size: u64,
    /// `E_k - 1` for each.
    pub excess: &'a [f64],
    /// `Var_k` for each.
    pub variance: &'a [f64],
    /// How far the values may be off.
    pub bounds: Bounds,
}

/// Why there are no values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DoublesError {
    /// Not photons of one shell, or buffers of two lengths.
    #[error("a shell holds photons 1 <= l <= m, and there must be a place for each of both values")]
    NoShell,
    /// The shell reaches past 2^50, where sums of doubles are no longer exact.
    #[error("doubles serve shells up to the volume 2^50")]
    TooFar,
    /// A shell so thick that [`super::sweep`] does not reach it.
    #[error(transparent)]
    Domain(#[from] DomainError),
}

/// All photons of a range, block by block, innermost first.
#[derive(Clone, Debug)]
pub struct Doubles<'a> {
    places: Places<'a>,
    last: u64,
    lanes: Lanes,
    sample: Option<u64>,
    excess: Vec<f64>,
    variance: Vec<f64>,
}

impl<'a> Doubles<'a> {
    /// The photons `first..=last`; those that the layout has not are left out.
    ///
    /// # Errors
    /// `TooFar` where the shell of the first is.
    pub fn new(layout: &'a Layout, first: u64, last: u64) -> Result<Doubles<'a>, DoublesError> {
        Ok(Doubles {
            places: Places::new(layout, first)?,
            last,
            lanes: Lanes::best(),
            sample: None,
            excess: vec![0.0; MOST_PHOTONS],
            variance: vec![0.0; MOST_PHOTONS],
        })
    }

    /// The same values, computed in another way.
    #[must_use]
    pub fn with_lanes(self, lanes: Lanes) -> Doubles<'a> {
        Doubles { lanes, ..self }
    }

    /// Of each shell only so many stretches of eight neighbours, evenly spaced, its first and its last photon among them;
    /// a shell of no more photons than that is walked through whole. At least 2 and at most [`MOST_STRETCHES`] are taken.
    ///
    /// ```
    /// use claimcheck::model::Layout;
    /// use claimcheck::special::doubles::Doubles;
    /// // Shell 100 of strategy 2 holds the photons 4951..=5050.
    /// let mut doubles = Doubles::new(&Layout::Triangular, 4951, 5050)?.sampled(3);
    /// let mut stretches = vec![];
    /// while let Some(block) = doubles.next_block()? {
    ///     stretches.push((block.first, block.excess.len()));
    /// }
    /// assert_eq!(stretches, [(4951, 8), (4997, 8), (5043, 8)]);
    /// # Ok::<(), claimcheck::special::doubles::DoublesError>(())
    /// ```
    #[must_use]
    pub fn sampled(self, stretches: u64) -> Doubles<'a> {
        Doubles {
            sample: Some(stretches.clamp(2, MOST_STRETCHES)),
            ..self
        }
    }

    /// The next photons, at most 2048; `None` after the last.
    ///
    /// # Errors
    /// `TooFar` and `Domain`, for the shell at hand; an error stays.
    pub fn next_block(&mut self) -> Result<Option<Block<'_>>, DoublesError> {
        let Some(mut place) = self.places.at_hand() else {
            return Ok(None);
        };
        let mut left = place.left();
        if let Some(stretches) = self.sample {
            let stretch = place.stretch(stretches);
            self.places.pass(stretch.start - place.position);
            place.position = stretch.start;
            left = stretch.end - stretch.start;
        }
        let first = place.photon();
        if first > self.last {
            return Ok(None);
        }
        let layout = self.places.layout();
        let single = *layout == Layout::One;
        let room = if single { one::room(first) } else { left };
        let count = room.min(self.last - first + 1).min(MOST_PHOTONS as u64);
        let excess = &mut self.excess[..count as usize];
        let variance = &mut self.variance[..count as usize];
        let bounds = match single {
            true => fill_singles(self.lanes, place, excess, variance)?,
            false => fill(self.lanes, place, excess, variance)?,
        };
        self.places.pass(count);
        Ok(Some(Block {
            first,
            inner: place.inner,
            size: place.size,
            excess,
            variance,
            bounds,
        }))
    }
}

/// The values of the photons `position..` (l, from 1) of the shell of `size` photons and volume `size` around
/// the volume `inner`, as many as the buffers hold, and their bounds.
///
/// ```
/// use claimcheck::special::doubles::neighbours;
/// // Photons 5041..=5050 of strategy 2.
/// let (mut excess, mut variance) = ([0.0; 10], [0.0; 10]);
/// let bounds = neighbours(4950, 100, 91, &mut excess, &mut variance)?;
/// assert!((excess[9] - 1.96136e-4).abs() < 1e-9);
/// assert!(bounds.excess < 4e-16 && bounds.variance < 2e-15);
/// # Ok::<(), claimcheck::special::doubles::DoublesError>(())
/// ```
///
/// # Errors
/// [`DoublesError`].
pub fn neighbours(
    inner: u64,
    size: u64,
    position: u64,
    excess: &mut [f64],
    variance: &mut [f64],
) -> Result<Bounds, DoublesError> {
    let count = excess.len() as u64;
    if position < 1
        || variance.len() != excess.len()
        || position > size
        || count > size - position + 1
    {
        return Err(DoublesError::NoShell);
    }
    let place = Place {
        inner,
        size,
        position,
    };
    fill(Lanes::best(), place, excess, variance)
}

/// Photons of one shell from a place on.
fn fill(
    lanes: Lanes,
    place: Place,
    excess: &mut [f64],
    variance: &mut [f64],
) -> Result<Bounds, DoublesError> {
    let Place {
        inner,
        size,
        position,
    } = place.checked()?;
    let first = position as f64;
    if inner == 0 {
        let size = size as f64;
        kernel::fill(lanes, &Centre { size }, first, excess, variance);
        return Ok(centre::BOUNDS);
    }
    if let Some((moments, bounds)) = Moments::new(inner, size) {
        kernel::fill(lanes, &moments, first, excess, variance);
        return Ok(bounds);
    }
    let layout = Layout::Sequence(vec![inner, size]);
    rounded::fill(&layout, place.photon(), excess, variance)
}

/// Photons of one shell each.
fn fill_singles(
    lanes: Lanes,
    place: Place,
    excess: &mut [f64],
    variance: &mut [f64],
) -> Result<Bounds, DoublesError> {
    let first = place.checked()?.photon();
    if first < one::FIRST {
        return rounded::fill(&Layout::One, first, excess, variance);
    }
    kernel::fill(lanes, &One, first as f64, excess, variance);
    Ok(one::BOUNDS)
}

#[cfg(test)]
mod tests;
