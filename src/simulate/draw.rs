//! Draws blocks: eight runs at a time, one a lane, and some such groups together.

use super::beta::beta;
use super::block::{Block, Way};
use super::logarithm::minus_ln;
use super::place::Place;
use super::scene::{Fault, Scene};
use super::stream::{Single, Stream};
use crate::number::{Task, WIDTH, Wide};

/// What is done with the photons that are drawn.
pub(super) trait Visitor {
    /// How many runs come next: all lanes of all groups, or fewer where there is one group.
    fn runs(&mut self, live: usize);
    /// A photon asked for, at place `index` among those of its block: the l-th of its shell, for each run.
    fn photon<const G: usize>(&mut self, index: usize, place: &Place, l: f64, stored: [Wide; G]);
}

/// Eight times G runs of a block.
pub(super) struct Batch<'a, V, const G: usize> {
    pub(super) scene: &'a Scene,
    pub(super) block: &'a Block,
    /// The photons asked for of this block.
    pub(super) asked: &'a [u64],
    pub(super) stream: &'a mut Stream,
    /// Room for the places of a shell.
    pub(super) rows: &'a mut Vec<Wide>,
    pub(super) visitor: &'a mut V,
}

impl<V: Visitor, const G: usize> Task for Batch<'_, V, G> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        match self.block.way {
            Way::Singles => self.singles(),
            Way::Spacings => self.spacings(),
            Way::Sorted => self.sorted(),
            Way::Beta => self.betas(),
        }
    }
}

impl<V: Visitor, const G: usize> Batch<'_, V, G> {
    /// The place of the block.
    fn place(&self) -> Place {
        Place::new(self.scene, self.block.inner as f64, self.block.count as f64)
    }

    /// How many photons are drawn in a shell.
    fn drawn(&self) -> usize {
        let count = self.block.count as usize;
        match self.scene.fault {
            Some(Fault::ShellCount) => count + 1,
            Some(Fault::Dropped) => count - 1,
            _ => count,
        }
    }

    /// One uniform number for each shell.
    #[inline(always)]
    fn singles(self) {
        let mut stream = *self.stream;
        let mut k = self.block.inner;
        for (index, &asked) in self.asked.iter().enumerate() {
            while k + 1 < asked {
                let _skipped = uniforms::<G>(&mut stream);
                k += 1;
            }
            let place = Place::new(self.scene, k as f64, 1.0);
            let volume = Wide::all(place.volume);
            let stored = uniforms::<G>(&mut stream).map(|x| place.stored(volume * x));
            self.visitor.photon(index, &place, 1.0, stored);
            k += 1;
        }
        *self.stream = stream;
    }

    /// Normalised partial sums of exponentials. They are kept where they fit into a near cache; else the same numbers are
    /// drawn twice, first for their total.
    #[inline(always)]
    fn spacings(self) {
        let place = self.place();
        let sums = self.drawn() + 1;
        let mut stream = *self.stream;
        let mut row = [Wide::all(0.0); G];
        self.rows.resize(sums * G, Wide::all(0.0));
        let (rows, _) = self.rows.as_chunks_mut::<G>();
        for kept in rows.iter_mut() {
            row = next_sums(&mut stream, row);
            *kept = row;
        }
        let scale = row.map(|total| Wide::all(place.volume) / total);
        for (index, &k) in self.asked.iter().enumerate() {
            let l = k - self.block.inner;
            let Some(row) = rows.get(l as usize - 1) else {
                break;
            };
            let stored: [_; G] = std::array::from_fn(|g| place.stored(row[g] * scale[g]));
            self.visitor.photon(index, &place, l as f64, stored);
        }
        *self.stream = stream;
    }

    /// Uniform numbers, sorted run by run.
    #[inline(always)]
    fn sorted(self) {
        let place = self.place();
        let volume = Wide::all(place.volume);
        let drawn = self.drawn();
        self.rows.clear();
        for _ in 0..drawn * G {
            let x = self.stream.uniforms();
            self.rows.push(place.stored(volume * x));
        }
        let lost = drawn < self.block.count as usize;
        if lost {
            let edge = place.stored(volume);
            self.rows.extend([edge; G]);
        }
        let (rows, _) = self.rows.as_chunks_mut::<G>();
        sort(rows, self.scene.fault);
        for (index, &k) in self.asked.iter().enumerate() {
            let l = k - self.block.inner;
            if let Some(row) = rows.get(l as usize - 1) {
                self.visitor.photon(index, &place, l as f64, *row);
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
            let mut x = || match l <= drawn {
                true => beta(&mut random, l as f64, (drawn - l + 1) as f64),
                // The lost photon's place.
                false => 1.0,
            };
            let stored = std::array::from_fn(|_| {
                let x = Wide(std::array::from_fn(|_| x()));
                place.stored(Wide::all(place.volume) * x)
            });
            self.visitor.photon::<G>(index, &place, l as f64, stored);
        }
    }
}

#[inline(always)]
fn uniforms<const G: usize>(stream: &mut Stream) -> [Wide; G] {
    std::array::from_fn(|_| stream.uniforms())
}

/// The partial sums with one exponential more.
#[inline(always)]
fn next_sums<const G: usize>(stream: &mut Stream, sums: [Wide; G]) -> [Wide; G] {
    sums.map(|sum| sum + minus_ln(stream.uniforms()))
}

/// Sorts each run by itself.
fn sort<const G: usize>(rows: &mut [[Wide; G]], fault: Option<Fault>) {
    if fault == Some(Fault::Unsorted) {
        return;
    }
    let mut run = vec![0.0; rows.len()];
    for group in 0..G {
        for lane in 0..WIDTH {
            for (number, row) in run.iter_mut().zip(rows.iter()) {
                *number = row[group].0[lane];
            }
            run.sort_unstable_by(f64::total_cmp);
            if fault == Some(Fault::Descending) {
                run.reverse();
            }
            for (number, row) in run.iter().zip(rows.iter_mut()) {
                row[group].0[lane] = *number;
            }
        }
    }
}
