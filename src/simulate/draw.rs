//! Draws blocks, some runs at a time.

use super::beta::beta;
use super::block::{Block, Way};
use super::logarithm::minus_ln;
use super::place::Place;
use super::scene::{Fault, Scene};
use super::stream::{LANES, Row, Single, Stream};
use crate::number::{Lanes, Task};

/// What is done with the photons that are drawn.
pub(super) trait Visitor {
    /// Only the first `live` lanes of what comes next are runs.
    fn runs(&mut self, live: usize);
    /// A photon asked for, at place `index` among those of its block: the l-th of its shell, in each run.
    fn photon(&mut self, index: usize, place: &Place, l: f64, stored: &Row);
}

/// Some runs of a block.
pub(super) struct Batch<'a, V> {
    pub(super) scene: &'a Scene,
    pub(super) block: &'a Block,
    /// The photons asked for of this block.
    pub(super) asked: &'a [u64],
    pub(super) stream: &'a mut Stream,
    /// Room for a shell.
    pub(super) rows: &'a mut Vec<Row>,
    pub(super) visitor: &'a mut V,
}

impl<V: Visitor> Batch<'_, V> {
    /// Draws them.
    pub(super) fn draw(self, lanes: Lanes) {
        match self.block.way {
            Way::Singles => lanes.run(Singles(self)),
            Way::Spacings => lanes.run(Spacings(self)),
            Way::Sorted => self.sorted(),
            Way::Beta => self.betas(),
        }
    }

    /// The shell.
    fn place(&self) -> Place {
        Place::new(self.scene, self.block.inner as f64, self.block.count as f64)
    }

    /// How many photons are drawn in it.
    fn drawn(&self) -> u64 {
        let count = self.block.count;
        match self.scene.fault {
            Some(Fault::ShellCount) => count + 1,
            Some(Fault::Dropped) => count - 1,
            _ => count,
        }
    }
}

/// One uniform number for each shell.
struct Singles<'a, V>(Batch<'a, V>);

impl<V: Visitor> Task for Singles<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let batch = self.0;
        let mut before = batch.block.inner;
        for (index, &k) in batch.asked.iter().enumerate() {
            skip(batch.stream, k - 1 - before);
            let place = Place::new(batch.scene, (k - 1) as f64, 1.0);
            let row = place.store(&Row::all(place.volume), &batch.stream.uniforms());
            batch.visitor.photon(index, &place, 1.0, &row);
            before = k;
        }
        // The next runs draw the same whichever photons are asked for.
        let end = batch.block.inner + batch.block.count;
        skip(batch.stream, end.min(batch.scene.photons) - before);
    }
}

/// Passes over the numbers of some photons.
fn skip(stream: &mut Stream, photons: u64) {
    for _ in 0..photons {
        stream.uniforms();
    }
}

/// Normalised partial sums of exponentials. They are kept where a near cache holds them; else the same numbers are drawn
/// once more when the totals are known.
struct Spacings<'a, V>(Batch<'a, V>);

/// Rows that a near cache holds: 1 MiB.
const NEAR: u64 = 1 << 12;

impl<V: Visitor> Task for Spacings<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let place = self.0.place();
        let mut batch = self.0;
        let mut again = *batch.stream;
        let totals = batch.partial_sums();
        let volumes = Row(totals.0.map(|total| place.volume / total));
        let (mut sums, mut passed) = (Row::all(0.0), 0);
        for (index, &k) in batch.asked.iter().enumerate() {
            let l = k - batch.block.inner;
            let row = match batch.rows.get(l as usize - 1) {
                Some(row) => place.store(&volumes, row),
                None => {
                    while passed < l {
                        add_exponentials(&mut again, &mut sums);
                        passed += 1;
                    }
                    place.store(&volumes, &sums)
                }
            };
            batch.visitor.photon(index, &place, l as f64, &row);
        }
    }
}

impl<V: Visitor> Batch<'_, V> {
    /// Fills the rows with partial sums of exponentials, if there are not too many; returns the totals.
    #[inline(always)]
    fn partial_sums(&mut self) -> Row {
        let count = self.drawn() + 1;
        let mut sums = Row::all(0.0);
        if count > NEAR {
            self.rows.clear();
            for _ in 0..count {
                add_exponentials(self.stream, &mut sums);
            }
            return sums;
        }
        self.rows.resize(count as usize, sums);
        for row in self.rows.iter_mut() {
            add_exponentials(self.stream, &mut sums);
            *row = sums;
        }
        sums
    }
}

/// An exponential more for each sum.
#[inline(always)]
fn add_exponentials(stream: &mut Stream, sums: &mut Row) {
    let row = stream.uniforms();
    for lane in 0..LANES {
        sums.0[lane] += minus_ln(row.0[lane]);
    }
}

impl<V: Visitor> Batch<'_, V> {
    /// Uniform numbers, sorted run by run.
    fn sorted(self) {
        let place = self.place();
        let drawn = self.drawn();
        self.rows.clear();
        for _ in 0..drawn {
            self.rows.push(self.stream.uniforms());
        }
        // The lost photon's place is the edge.
        self.rows
            .resize(drawn.max(self.block.count) as usize, Row::all(1.0));
        for row in self.rows.iter_mut() {
            *row = place.store(&Row::all(place.volume), row);
        }
        sort(self.rows, self.scene.fault);
        for (index, &k) in self.asked.iter().enumerate() {
            let l = k - self.block.inner;
            if let Some(row) = self.rows.get(l as usize - 1) {
                self.visitor.photon(index, &place, l as f64, row);
            }
        }
    }

    /// Each photon by itself.
    fn betas(self) {
        let place = self.place();
        let drawn = self.drawn();
        let mut random = Single::new(self.stream);
        for (index, &k) in self.asked.iter().enumerate() {
            let l = k - self.block.inner;
            // A lost photon's place is the edge.
            let mut row = Row::all(1.0);
            if l <= drawn {
                row = Row(row
                    .0
                    .map(|_| beta(&mut random, l as f64, (drawn - l + 1) as f64)));
            }
            let row = place.store(&Row::all(place.volume), &row);
            self.visitor.photon(index, &place, l as f64, &row);
        }
    }
}

/// Sorts each run by itself.
fn sort(rows: &mut [Row], fault: Option<Fault>) {
    if fault == Some(Fault::Unsorted) {
        return;
    }
    let mut run = vec![0.0; rows.len()];
    for lane in 0..LANES {
        for (number, row) in run.iter_mut().zip(rows.iter()) {
            *number = row.0[lane];
        }
        run.sort_unstable_by(f64::total_cmp);
        if fault == Some(Fault::Descending) {
            run.reverse();
        }
        for (number, row) in run.iter().zip(rows.iter_mut()) {
            row.0[lane] = *number;
        }
    }
}
