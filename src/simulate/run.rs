//! All chunks of a simulation, on all cores, added up in their order.

use super::{Checkpoint, CheckpointError, Simulation, Sums};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Sums of so many photons, about, are held until all chunks of a wave are drawn: a wave takes some tenths of
/// a second.
const HELD: u64 = 1 << 20;

impl Simulation {
    /// Draws all chunks that the checkpoint does not hold, in rayon's pool of threads.
    ///
    /// `watch` is shown all sums up to here after each chunk, always in order, and may stop: to show progress,
    /// to cancel, or because the runs tell enough already. The sums up to there are then returned. What is
    /// returned has the same bytes for any number of threads, and if the run was killed or stopped and went on
    /// from its checkpoint.
    ///
    /// # Errors
    /// Where the checkpoint cannot be written.
    ///
    /// ```
    /// use claimcheck::{model::Layout, simulate::{Scene, Simulation}};
    /// use std::ops::ControlFlow;
    /// // Strategy 2, shells of 1 to 6 photons.
    /// let simulation = Simulation::new(Scene::new(Layout::Triangular, 21, 10_000, 1))?;
    /// let sums = simulation.run(None, |_| ControlFlow::Continue(()))?;
    /// assert_eq!(sums.runs, 10_000);
    /// // Theory: the last photon of the shell of six around the volume 15.
    /// let (mut excess, mut variance) = ([0.0], [0.0]);
    /// claimcheck::special::doubles::neighbours(15, 6, 6, &mut excess, &mut variance)?;
    /// let z = (sums.excess(20) - excess[0]) / (variance[0] / 10_000.0).sqrt();
    /// assert!(z.abs() < 4.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run(
        &self,
        mut checkpoint: Option<&mut Checkpoint>,
        mut watch: impl FnMut(&Sums) -> ControlFlow<()>,
    ) -> Result<Sums, CheckpointError> {
        let mut sums = match &mut checkpoint {
            Some(checkpoint) => checkpoint.sums(self),
            None => self.no_runs(),
        };
        let mut next = sums.runs.div_ceil(self.chunk_runs);
        while next < self.chunks() {
            for more in self.wave(next) {
                sums.add(&more);
                next += 1;
                if let Some(checkpoint) = &mut checkpoint {
                    checkpoint.write_now_and_then(&sums)?;
                }
                if watch(&sums).is_break() {
                    next = self.chunks();
                    break;
                }
            }
        }
        if let Some(checkpoint) = checkpoint {
            checkpoint.write(&sums)?;
        }
        Ok(sums)
    }

    /// Some chunks from one on: as many as keep all threads busy.
    fn wave(&self, first: u64) -> Vec<Sums> {
        let threads = rayon::current_num_threads() as u64;
        let held = HELD / self.photons.len().max(1) as u64;
        let count = held.clamp(2 * threads, 64 * threads);
        let chunks = first..self.chunks().min(first + count);
        let chunks: Vec<u64> = chunks.collect();
        chunks
            .into_par_iter()
            .map(|chunk| self.chunk(chunk))
            .collect()
    }
}
