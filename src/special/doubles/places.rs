//! The shells of a layout in words, outwards from a photon.

use super::{DoublesError, FARTHEST};
use crate::model::{Layout, Shell};
use crate::number::WIDTH;
use rug::{Integer, Rational};
use std::ops::Range;

/// A photon's place: the l-th of `size` in a shell of volume `size` around `inner`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) inner: u64,
    pub(super) size: u64,
    pub(super) position: u64,
}

/// The places of a layout in turn.
#[derive(Clone, Debug)]
pub(super) struct Places<'a> {
    layout: &'a Layout,
    next: Option<Place>,
    /// For a sequence: the index of the shell after this one.
    index: usize,
}

impl Place {
    /// k
    pub(super) fn photon(self) -> u64 {
        self.inner + self.position
    }

    /// How many photons of the shell are left, this one among them.
    pub(super) fn left(self) -> u64 {
        self.size - self.position + 1
    }

    /// The stretch of a sample that this place lies in, from here on, or else the next one in its shell; as positions.
    /// Stretch i of n begins at `1 + i (m - 8)/(n - 1)`, rounded down, for i from 0 to n - 1 >= 1.
    pub(super) fn stretch(self, stretches: u64) -> Range<u64> {
        let width = WIDTH as u64;
        if self.size <= width * stretches {
            return self.position..self.size + 1;
        }
        let (gaps, room) = (stretches - 1, self.size - width);
        let start = |index: u64| 1 + index * room / gaps;
        // The last one that begins not after this place, or the one before it.
        let near = (self.position - 1) * gaps / room;
        let mut starts = (near..=gaps).map(start);
        let start = starts
            .find(|start| start + width > self.position)
            .unwrap_or(1 + room);
        start.max(self.position)..start + width
    }

    fn new(shell: &Shell) -> Result<Place, DoublesError> {
        let word = |number: &Integer| {
            let word = number.to_u64().filter(|&number| number <= FARTHEST);
            word.ok_or(DoublesError::TooFar)
        };
        let whole = |number: &Rational| word(number.numer());
        let (inner, size) = (whole(&shell.inner)?, whole(&shell.volume)?);
        let place = Place {
            inner,
            size,
            position: word(&shell.position)?,
        };
        place.checked()
    }

    /// The same, where its shell lies within [`FARTHEST`].
    pub(super) fn checked(self) -> Result<Place, DoublesError> {
        match self.inner.checked_add(self.size) {
            Some(outer) if outer <= FARTHEST => Ok(self),
            _ => Err(DoublesError::TooFar),
        }
    }
}

impl<'a> Places<'a> {
    /// From photon `first` on; none where the layout has no such photon.
    pub(super) fn new(layout: &'a Layout, first: u64) -> Result<Places<'a>, DoublesError> {
        let shell = layout.shell(&first.into());
        let next = shell.map(|shell| Place::new(&shell)).transpose()?;
        let index = match (layout, next) {
            (Layout::Sequence(counts), Some(place)) => shells_within(counts, place) + 1,
            _ => 0,
        };
        Ok(Places {
            layout,
            next,
            index,
        })
    }

    pub(super) fn layout(&self) -> &'a Layout {
        self.layout
    }

    /// The place at hand, if there is one.
    pub(super) fn at_hand(&self) -> Option<Place> {
        self.next
    }

    /// Goes on by `count` photons of the shell at hand; for one photon a shell, by as many shells.
    pub(super) fn pass(&mut self, count: u64) {
        let Some(place) = self.next else { return };
        self.next = if *self.layout == Layout::One {
            let inner = place.inner + count;
            Some(Place { inner, ..place })
        } else if count < place.left() {
            let position = place.position + count;
            Some(Place { position, ..place })
        } else {
            self.following(place.size).map(|size| Place {
                inner: place.inner + place.size,
                size,
                position: 1,
            })
        };
    }

    /// How many photons the shell after one of `size` has.
    fn following(&mut self, size: u64) -> Option<u64> {
        match self.layout {
            Layout::Unstratified(_) => None,
            Layout::One => Some(1),
            Layout::Triangular | Layout::Listing => Some(size + 1),
            Layout::Sequence(counts) => {
                let (empty, count) = counts
                    .get(self.index..)?
                    .iter()
                    .enumerate()
                    .find(|(_, count)| **count > 0)?;
                self.index += empty + 1;
                Some(*count)
            }
        }
    }
}

/// The index of a place's shell in a sequence.
fn shells_within(counts: &[u64], place: Place) -> usize {
    let mut before = 0;
    let inside = |count: &&u64| {
        before += **count;
        before < place.photon()
    };
    counts.iter().take_while(inside).count()
}
