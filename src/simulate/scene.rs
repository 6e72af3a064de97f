//! What is simulated.

use crate::model::Layout;
use serde::{Deserialize, Serialize};

/// A scene, and how it is drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scene {
    /// How the photons are shared out over shells.
    pub layout: Layout,
    /// The last photon that is looked at; a shell that reaches past it is drawn whole.
    pub photons: u64,
    /// Draw radii in this many dimensions, and take U as `r^d` (radii in units in which a ball of volume u has
    /// the radius `u^(1/d)`); without it U alone is drawn.
    pub dimension: Option<u32>,
    /// How the places inside a shell are drawn.
    pub mode: Mode,
    /// How often the whole scene is drawn.
    pub runs: u64,
    /// The random numbers are a function of it.
    pub seed: u64,
    /// The photons that are asked for, in any order; without it all.
    pub only: Option<Vec<u64>>,
    /// A fault on purpose, to see whether tests find it.
    pub fault: Option<Fault>,
}

/// Ways to draw the places of the photons of a shell: all have the same law of each photon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// One uniform number where a shell holds one photon, `Beta` where few photons are asked for of a large
    /// shell, else `Spacings`.
    #[default]
    Cheapest,
    /// m uniform numbers (radii, in a dimension) a shell, sorted: the thesis's way.
    Sorted,
    /// `x_(l) = S_l/S_(m+1)` with the partial sums S of m+1 exponentials: no sort. Luc Devroye, Non-uniform
    /// random variate generation (1986), V.3.1.
    Spacings,
    /// `x ~ Beta(l, m-l+1)` as a quotient of two gamma variates, only for the photons that are asked for. Each
    /// is drawn by itself: the photons of a shell are then independent, their joint law is not kept.
    Beta,
}

/// Faults such as programs have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Fault {
    /// The estimator is (k-1)/U.
    Estimator,
    /// m+1 photons are drawn in each shell, and the outermost is left out.
    ShellCount,
    /// One photon of each shell is lost: its last one lies on the shell's edge.
    Dropped,
    /// The photons of a shell are not sorted.
    Unsorted,
    /// The photons of a shell are sorted the wrong way.
    Descending,
    /// The generator's volumes are too small by a part of [`Fault::BIAS`]: so all means of k/U are too large
    /// by as much.
    Biased,
}

impl Fault {
    /// The relative error of `Biased`.
    pub const BIAS: f64 = 1e-3;
}

/// Why a scene cannot be simulated.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// There is nothing to draw.
    #[error("there must be at least one run and one photon")]
    Empty,
    /// The layout has no such photon, or its last is before that.
    #[error("the layout has no photon {0}")]
    NoPhoton(u64),
    /// More photons than the memory is meant for.
    #[error("{0} photons; at most {MOST_PHOTONS} are simulated at a time")]
    Photons(u64),
    /// k beyond exact doubles.
    #[error("photon {0} is too far out: at most 2^50")]
    TooFar(u64),
    /// Too many runs.
    #[error("{0} runs; at most 2^32 are simulated")]
    Runs(u64),
    /// No such dimension.
    #[error("dimension {0}; between 1 and {MOST_DIMENSIONS} are simulated")]
    Dimension(u32),
    /// A shell too large to be drawn in this way.
    #[error(
        "a shell of {count} photons is too large to be drawn whole: at most {most}; draw few of its photons in the mode beta"
    )]
    Shell { count: u64, most: u64 },
    /// This fault and this mode do not go together.
    #[error(
        "photons are left unsorted, or sorted the wrong way, only where they are sorted: in the mode sorted"
    )]
    NotSorted,
    /// Too many samples.
    #[error("{0} samples; at most {MOST_SAMPLES} are kept")]
    Samples(u64),
}

/// Photons that sums are kept of: 64 MiB, and in a thread up to 512 MiB if all are of one shell.
pub(super) const MOST_PHOTONS: u64 = 1 << 22;
/// Numbers of photons and volumes up to here are exact doubles, with room for sums.
pub(super) const FARTHEST: u64 = 1 << 50;
/// Runs.
pub(super) const MOST_RUNS: u64 = 1 << 32;
/// Dimensions.
pub(super) const MOST_DIMENSIONS: u32 = 64;
/// Photons of a shell that is drawn whole: some ten seconds a chunk of runs.
pub(super) const LARGEST_DRAWN: u64 = 1 << 26;
/// Photons of a shell that is held in memory: 64 MiB in a thread.
pub(super) const LARGEST_SORTED: u64 = 1 << 18;
/// Samples of one photon: 128 MiB.
pub(super) const MOST_SAMPLES: u64 = 1 << 24;

impl Scene {
    /// All photons up to the last, U alone, in the cheapest way, without fault.
    ///
    /// ```
    /// use claimcheck::{model::Layout, simulate::{Mode, Scene}};
    /// let scene = Scene { dimension: Some(2), mode: Mode::Sorted, ..Scene::new(Layout::Triangular, 21, 100, 1) };
    /// assert_eq!(scene.fault, None);
    /// ```
    pub fn new(layout: Layout, photons: u64, runs: u64, seed: u64) -> Scene {
        Scene {
            layout,
            photons,
            dimension: None,
            mode: Mode::default(),
            runs,
            seed,
            only: None,
            fault: None,
        }
    }

    /// The photons that are asked for, ascending.
    ///
    /// # Errors
    /// Where there are none, too many, or one too far out.
    pub(super) fn asked(&self) -> Result<Vec<u64>, SceneError> {
        let first = if self.layout == Layout::Listing { 2 } else { 1 };
        let within = |k: u64| match k {
            k if k < first || k > self.photons => Err(SceneError::NoPhoton(k)),
            k if k > FARTHEST => Err(SceneError::TooFar(k)),
            k => Ok(k),
        };
        within(self.photons)?;
        let Some(only) = &self.only else {
            let count = self.photons - first + 1;
            return match count <= MOST_PHOTONS {
                true => Ok((first..=self.photons).collect()),
                false => Err(SceneError::Photons(count)),
            };
        };
        let count = only.len() as u64;
        if count > MOST_PHOTONS {
            return Err(SceneError::Photons(count));
        }
        let mut asked = only
            .iter()
            .map(|&k| within(k))
            .collect::<Result<Vec<_>, _>>()?;
        asked.sort_unstable();
        asked.dedup();
        Ok(asked)
    }

    /// # Errors
    /// What is wrong with the numbers of the scene, but for its photons.
    pub(super) fn check(&self) -> Result<(), SceneError> {
        if self.runs == 0 || self.only.as_ref().is_some_and(Vec::is_empty) {
            return Err(SceneError::Empty);
        }
        if self.runs > MOST_RUNS {
            return Err(SceneError::Runs(self.runs));
        }
        if let Some(d) = self
            .dimension
            .filter(|d| !(1..=MOST_DIMENSIONS).contains(d))
        {
            return Err(SceneError::Dimension(d));
        }
        if self.fault.is_some_and(Fault::needs_sorting)
            && !matches!(self.mode, Mode::Cheapest | Mode::Sorted)
        {
            return Err(SceneError::NotSorted);
        }
        Ok(())
    }
}

impl Fault {
    /// Whether the fault is one of the sort.
    pub(super) fn needs_sorting(self) -> bool {
        matches!(self, Fault::Unsorted | Fault::Descending)
    }
}
