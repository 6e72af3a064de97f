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
    fn drawn(&self) -> usize {
        let count = self.block.count as usize;
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
            while before + 1 < k {
                batch.stream.uniforms();
                before += 1;
            }
            let place = Place::new(batch.scene, before as f64, 1.0);
            let mut row = batch.stream.uniforms();
            scale(&mut row, &[place.volume; LANES]);
            place.store(&mut row);
            batch.visitor.photon(index, &place, 1.0, &row);
            before += 1;
        }
    }
}

/// Normalised partial sums of exponentials.
struct Spacings<'a, V>(Batch<'a, V>);

impl<V: Visitor> Task for Spacings<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let place = self.0.place();
        let batch = self.0;
        let drawn = batch.drawn();
        batch.rows.resize(drawn + 1, [0.0; LANES]);
        let mut sums = [0.0; LANES];
        for row in batch.rows.iter_mut() {
            add_exponentials(batch.stream, &mut sums);
            *row = sums;
        }
        let volumes = sums.map(|total| place.volume / total);
        for (index, &k) in batch.asked.iter().enumerate() {
            let l = k - batch.block.inner;
            let Some(mut row) = batch.rows.get(l as usize - 1).copied() else {
                return;
            };
            scale(&mut row, &volumes);
            place.store(&mut row);
            batch.visitor.photon(index, &place, l as f64, &row);
        }
    }
}

/// Each number times a factor.
#[inline(always)]
fn scale(row: &mut Row, factors: &Row) {
    for (number, factor) in row.iter_mut().zip(factors) {
        *number *= factor;
    }
}

/// An exponential more for each sum.
#[inline(always)]
fn add_exponentials(stream: &mut Stream, sums: &mut Row) {
    let row = stream.uniforms();
    for (sum, u) in sums.iter_mut().zip(&row) {
        *sum += minus_ln(*u);
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
            .resize(drawn.max(self.block.count as usize), [1.0; LANES]);
        for row in self.rows.iter_mut() {
            scale(row, &[place.volume; LANES]);
            place.store(row);
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
            let l = (k - self.block.inner) as usize;
            let mut row = [place.volume; LANES];
            // A lost photon's place is the edge.
            if l <= drawn {
                for number in &mut row {
                    *number *= beta(&mut random, l as f64, (drawn - l + 1) as f64);
                }
            }
            place.store(&mut row);
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
            *number = row[lane];
        }
        run.sort_unstable_by(f64::total_cmp);
        if fault == Some(Fault::Descending) {
            run.reverse();
        }
        for (number, row) in run.iter().zip(rows.iter_mut()) {
            row[lane] = *number;
        }
    }
}
