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

/// Normalised partial sums of exponentials. They are kept where a near cache holds them; else the same numbers
/// are drawn once more when the totals are known.
struct Spacings<'a, V>(Batch<'a, V>);

/// Rows that a near cache holds: 1 MiB.
const NEAR: u64 = 1 << 12;

impl<V: Visitor> Task for Spacings<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let place = self.0.place();
        let mut batch = self.0;
        let mut again = Again::new(&batch);
        let totals = batch.partial_sums();
        let volumes = Row(totals.0.map(|total| place.volume / total));
        for (index, &k) in batch.asked.iter().enumerate() {
            let l = k - batch.block.inner;
            let row = match batch.rows.get(l as usize - 1) {
                Some(row) => place.store(&volumes, row),
                None => place.store(&volumes, again.sums_to(l)),
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
        if count > NEAR {
            let mut all = Again::new(self);
            let totals = *all.sums_to(count);
            self.rows.clear();
            *self.stream = all.stream;
            return totals;
        }
        let mut sums = Row::all(0.0);
        self.rows.resize(count as usize, sums);
        let (pairs, last) = self.rows.as_chunks_mut::<2>();
        for [first, second] in pairs {
            *first = add_two(self.stream, &mut sums);
            *second = sums;
        }
        for row in last {
            add_one(self.stream, &mut sums);
            *row = sums;
        }
        sums
    }
}

/// Partial sums one after the other, none of them kept.
struct Again {
    stream: Stream,
    /// How many there are, and how many are drawn.
    count: u64,
    drawn: u64,
    /// The last two.
    before: Row,
    sums: Row,
}

impl Again {
    fn new<V: Visitor>(batch: &Batch<'_, V>) -> Again {
        Again {
            stream: *batch.stream,
            count: batch.drawn() + 1,
            drawn: 0,
            before: Row::all(0.0),
            sums: Row::all(0.0),
        }
    }

    /// The sums of l exponentials; l must not fall.
    #[inline(always)]
    fn sums_to(&mut self, l: u64) -> &Row {
        while self.drawn < l {
            if self.drawn + 2 <= self.count {
                self.before = add_two(&mut self.stream, &mut self.sums);
                self.drawn += 2;
            } else {
                add_one(&mut self.stream, &mut self.sums);
                self.drawn += 1;
            }
        }
        if l == self.drawn {
            &self.sums
        } else {
            &self.before
        }
    }
}

/// An exponential more for each sum.
#[inline(always)]
fn add_one(stream: &mut Stream, sums: &mut Row) {
    let u = stream.uniforms();
    for lane in 0..LANES {
        sums.0[lane] += minus_ln(u.0[lane]);
    }
}

/// Two exponentials more for each sum; returns the sums after the first.
///
/// The sum of two is `-ln(u v)`, and given it the first is a uniform part of it: so one logarithm serves two.
#[inline(always)]
fn add_two(stream: &mut Stream, sums: &mut Row) -> Row {
    let [u, v, part] = [stream.uniforms(), stream.uniforms(), stream.uniforms()];
    let mut first = *sums;
    for lane in 0..LANES {
        let both = minus_ln(u.0[lane] * v.0[lane]);
        first.0[lane] += part.0[lane] * both;
        sums.0[lane] += both;
    }
    first
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
