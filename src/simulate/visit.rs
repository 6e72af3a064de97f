//! What is done with photons that are drawn: they are added up, or kept.

use super::draw::Visitor;
use super::place::Place;
use super::stream::{LANES, Row};
use crate::number::{WIDTH, Wide};

/// Adds up d and its square for the photons of a block, in each wide lane by itself.
#[derive(Default)]
pub(super) struct Adder {
    sums: Vec<[Wide; 2]>,
    /// How many of the lanes are runs.
    live: usize,
}

impl Adder {
    /// Starts a block of so many photons.
    pub(super) fn start(&mut self, photons: usize) {
        self.sums.clear();
        self.sums.resize(photons, [Wide::all(0.0); 2]);
    }

    /// The sums of all lanes.
    pub(super) fn fold(&self, deviation: &mut [f64], square: &mut [f64]) {
        for ((deviation, square), sums) in deviation.iter_mut().zip(square).zip(&self.sums) {
            [*deviation, *square] = sums.map(|sum| sum.0.iter().sum());
        }
    }
}

impl Visitor for Adder {
    fn runs(&mut self, live: usize) {
        self.live = live.min(LANES);
    }

    #[inline(always)]
    fn photon(&mut self, index: usize, place: &Place, l: f64, stored: &Row) {
        let Some([sum, squares]) = self.sums.get_mut(index) else {
            return;
        };
        let mut row = place.deviations(l, stored);
        if self.live < LANES {
            row.0[self.live..].fill(0.0);
        }
        let (groups, _) = row.0.as_chunks::<WIDTH>();
        for group in groups {
            let d = Wide(*group);
            *sum = *sum + d;
            *squares = *squares + d * d;
        }
    }
}

/// Keeps U of one photon.
pub(super) struct Sampler {
    index: usize,
    live: usize,
    pub(super) volumes: Vec<f64>,
}

impl Sampler {
    /// Of the photon at this place of its block.
    pub(super) fn new(index: usize) -> Sampler {
        Sampler {
            index,
            live: 0,
            volumes: vec![],
        }
    }
}

impl Visitor for Sampler {
    fn runs(&mut self, live: usize) {
        self.live = live.min(LANES);
    }

    fn photon(&mut self, index: usize, place: &Place, _: f64, stored: &Row) {
        if index == self.index {
            let volumes = place.volumes(stored);
            self.volumes.extend(volumes.0.iter().take(self.live));
        }
    }
}
