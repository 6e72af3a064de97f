//! Simulation: the estimator k/U of the thesis's chapter 3, drawn many times, in doubles.
//!
//! A [`Scene`] says which photons of which layout are drawn, how, and how often; a [`Simulation`] draws it. U
//! is drawn as `Va + V*x`, x the l-th smallest of m uniform numbers of the photon's shell ([`crate::model`]);
//! no position ever is. The ways to draw x ([`Mode`]) have one law and are tested against each other; the
//! cheapest one takes about 2 ns a photon on a core with AVX-512. For each photon [`Sums`] of `d = k/U - 1`
//! and d^2 are kept, so memory does not grow with the runs.
//!
//! The runs are cut into chunks that depend on the scene only, and the random numbers (`stream.rs`) on the
//! seed, the chunk and the shell only. Chunks are added up in their order. So any number of threads, a run
//! that was killed and went on from its [`Checkpoint`], and all vectors of the processor ([`Lanes`]) give the
//! same bytes. Radii in four and more dimensions are powers by the system's library: there the last digits may
//! be others on another system.
//!
//! What a simulation shows is evidence, never proof; a planted [`Fault`] shows what tests of it can find.
//!
//! ```
//! use claimcheck::{model::Layout, simulate::{Scene, Simulation}};
//! // Photon 5 of strategy 2 lies in the shell of three around Va = 3; radii in the plane.
//! let scene = Scene { dimension: Some(2), only: Some(vec![5]), ..Scene::new(Layout::Triangular, 6, 10_000, 1) };
//! let sums = Simulation::new(scene)?.chunk(0);
//! // Theory: shell of three around the volume 3, its second photon.
//! let (mut excess, mut variance) = ([0.0], [0.0]);
//! claimcheck::special::doubles::neighbours(3, 3, 2, &mut excess, &mut variance)?;
//! let z = (sums.excess(0) - excess[0]) / (variance[0] / sums.runs as f64).sqrt();
//! assert!(z.abs() < 4.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod beta;
mod block;
mod checkpoint;
mod claim;
mod draw;
mod law;
mod logarithm;
mod place;
mod root;
mod run;
mod scene;
mod stream;
mod sums;
pub mod verdict;
mod visit;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use claim::{Draws, Simulated, simulate_relation};
pub use scene::{Fault, Mode, Scene, SceneError};
pub use sums::{OtherPhotons, Sums};

use crate::number::Lanes;
use block::Block;
use draw::{Batch, Visitor};
use scene::MOST_SAMPLES;
use stream::{Key, LANES, Row};
use visit::{Adder, Sampler};

/// Photons of a chunk, all runs together, about: some tens of milliseconds.
const CHUNK: u64 = 1 << 23;

/// Runs of a chunk at most.
const MOST_CHUNK_RUNS: u64 = 1 << 13;

/// A scene, ready to be drawn.
#[derive(Clone, Debug)]
pub struct Simulation {
    scene: Scene,
    photons: Vec<u64>,
    blocks: Vec<Block>,
    chunk_runs: u64,
    lanes: Lanes,
}

impl Simulation {
    /// Prepares a scene: looks up its shells and decides how each is drawn.
    ///
    /// # Errors
    /// [`SceneError`]: the scene has nothing to draw, photons that the layout has not, or more than fits.
    pub fn new(scene: Scene) -> Result<Simulation, SceneError> {
        scene.check()?;
        let photons = scene.asked()?;
        let blocks = block::blocks(&scene, &photons)?;
        let lanes = LANES as u64;
        let chunk_runs = (CHUNK / scene.photons).clamp(lanes, MOST_CHUNK_RUNS) / lanes * lanes;
        Ok(Simulation {
            scene,
            photons,
            blocks,
            chunk_runs,
            lanes: Lanes::best(),
        })
    }

    /// The same numbers, computed in another way.
    #[must_use]
    pub fn with_lanes(self, lanes: Lanes) -> Simulation {
        Simulation { lanes, ..self }
    }

    /// What is drawn.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How many chunks the runs are cut into; it depends on the scene only.
    pub fn chunks(&self) -> u64 {
        self.scene.runs.div_ceil(self.chunk_runs)
    }

    /// The photons that are asked for, ascending.
    pub fn photons(&self) -> &[u64] {
        &self.photons
    }

    /// How many photons are drawn in a run: of the shells that hold those asked for, all that their way of drawing needs.
    pub fn drawn_a_run(&self) -> u64 {
        self.blocks.iter().map(Block::drawn).sum()
    }

    /// Sums of no runs.
    fn no_runs(&self) -> Sums {
        Sums::new(self.photons.clone())
    }

    /// Whether so many runs are some chunks, or all.
    fn ends_a_chunk(&self, runs: u64) -> bool {
        runs == self.scene.runs || runs < self.scene.runs && runs.is_multiple_of(self.chunk_runs)
    }

    /// How many runs a chunk has; none past the last.
    fn runs_of(&self, chunk: u64) -> u64 {
        let before = chunk.saturating_mul(self.chunk_runs);
        self.scene.runs.saturating_sub(before).min(self.chunk_runs)
    }

    /// Draws a chunk of the runs. One past the last has no runs.
    pub fn chunk(&self, chunk: u64) -> Sums {
        let mut sums = self.no_runs();
        sums.runs = self.runs_of(chunk);
        let mut adder = Adder::default();
        let mut rows = vec![];
        for block in &self.blocks {
            adder.start(block.asked.len());
            self.draw(chunk, block, &mut rows, &mut adder);
            let deviation = &mut sums.deviation[block.asked.clone()];
            let square = &mut sums.square[block.asked.clone()];
            adder.fold(deviation, square);
        }
        sums
    }

    /// U of photon k in all runs, in order, in photon units: the very numbers that
    /// [`chunk`](Simulation::chunk) adds up.
    ///
    /// ```
    /// use claimcheck::{model::Layout, simulate::{Scene, Simulation}};
    /// let simulation = Simulation::new(Scene::new(Layout::One, 10, 1000, 1))?;
    /// // Photon 10 lies between the volumes 9 and 10.
    /// assert!(simulation.samples(10)?.iter().all(|u| (9.0..10.0).contains(u)));
    /// # Ok::<(), claimcheck::simulate::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// `NoPhoton` where photon k is not asked for, `Samples` where there are more than 2^24 runs.
    pub fn samples(&self, k: u64) -> Result<Vec<f64>, SceneError> {
        let holds = |block: &&Block| self.photons[block.asked.clone()].contains(&k);
        let block = self
            .blocks
            .iter()
            .find(holds)
            .ok_or(SceneError::NoPhoton(k))?;
        if self.scene.runs > MOST_SAMPLES {
            return Err(SceneError::Samples(self.scene.runs));
        }
        let index = self.photons[block.asked.clone()].partition_point(|&other| other < k);
        let mut sampler = Sampler::new(index);
        let mut rows = vec![];
        for chunk in 0..self.chunks() {
            self.draw(chunk, block, &mut rows, &mut sampler);
        }
        Ok(sampler.volumes)
    }

    /// Draws the runs of a chunk of one block: some at a time.
    fn draw<V: Visitor>(&self, chunk: u64, block: &Block, rows: &mut Vec<Row>, visitor: &mut V) {
        let key = Key {
            seed: self.scene.seed,
            chunk,
            photon: block.inner + 1,
        };
        let mut stream = key.stream();
        let mut runs = self.runs_of(chunk);
        while runs > 0 {
            let live = runs.min(LANES as u64);
            visitor.runs(live as usize);
            let batch = Batch {
                scene: &self.scene,
                block,
                asked: &self.photons[block.asked.clone()],
                stream: &mut stream,
                rows,
                visitor,
            };
            batch.draw(self.lanes);
            runs -= live;
        }
    }
}

#[cfg(test)]
mod tests;
