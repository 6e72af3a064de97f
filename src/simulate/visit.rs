//! What is done with photons that are drawn: they are added up, or kept.

use super::draw::Visitor;
use super::place::Place;
use crate::number::{WIDTH, Wide};

/// Adds up d and its square, each lane by itself, for the photons of a block.
#[derive(Default)]
pub(super) struct Adder {
    sums: Vec<[Wide; 2]>,
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
        for ((deviation, square), [sum, squares]) in
            deviation.iter_mut().zip(square).zip(&self.sums)
        {
            *deviation = sum.0.iter().sum();
            *square = squares.0.iter().sum();
        }
    }
}

impl Visitor for Adder {
    fn runs(&mut self, live: usize) {
        self.live = live;
    }

    #[inline(always)]
    fn photon<const G: usize>(&mut self, index: usize, place: &Place, l: f64, stored: [Wide; G]) {
        let Some([sum, squares]) = self.sums.get_mut(index) else {
            return;
        };
        let (mut a, mut b) = (*sum, *squares);
        for stored in stored {
            let mut d = place.deviations(l, stored);
            if G == 1 {
                silence(&mut d, self.live);
            }
            a = a + d;
            b = b + d * d;
        }
        (*sum, *squares) = (a, b);
    }
}

/// Nothing in the lanes from `live` on.
#[inline(always)]
fn silence(wide: &mut Wide, live: usize) {
    for (lane, value) in wide.0.iter_mut().enumerate() {
        if lane >= live {
            *value = 0.0;
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
        self.live = live;
    }

    #[inline(always)]
    fn photon<const G: usize>(&mut self, index: usize, place: &Place, _: f64, stored: [Wide; G]) {
        if index == self.index {
            let runs = stored
                .into_iter()
                .flat_map(|stored| place.volumes(stored).0);
            self.volumes.extend(runs.take(self.live.min(G * WIDTH)));
        }
    }
}
