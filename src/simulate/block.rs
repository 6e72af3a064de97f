//! What is drawn from one stream: a shell, or some neighbouring shells of one photon each.

use super::scene::{FARTHEST, Fault, LARGEST_DRAWN, LARGEST_SORTED, Mode, Scene, SceneError};
use crate::model::{Layout, Shell, Walk};
use std::ops::Range;

/// Shells of one photon that share a stream.
const SINGLES: u64 = 1 << 10;

/// A photon drawn by `Beta` takes as long as about so many drawn by `Spacings`.
const BETA_COST: u64 = 40;

/// A shell, or neighbouring shells of one photon each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Block {
    /// The volume inside, and the number of photons before the first.
    pub(super) inner: u64,
    /// How many photons it holds; also its volume.
    pub(super) count: u64,
    pub(super) way: Way,
    /// The places, in the list of photons that are asked for, of those in this block.
    pub(super) asked: Range<usize>,
}

impl Block {
    /// How many photons are drawn in a run.
    pub(super) fn drawn(&self) -> u64 {
        match self.way {
            Way::Singles | Way::Beta => self.asked.len() as u64,
            Way::Sorted | Way::Spacings => self.count,
        }
    }
}

/// How a block is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Shells of one photon each.
    Singles,
    Sorted,
    Spacings,
    Beta,
}

/// The blocks of a scene that hold photons asked for (ascending), innermost first.
///
/// # Errors
/// Where a photon does not exist, or its shell is too large to be drawn.
pub(super) fn blocks(scene: &Scene, asked: &[u64]) -> Result<Vec<Block>, SceneError> {
    let mut shells = Shells::new(scene);
    let mut blocks = vec![];
    let mut at = 0;
    while let Some(&k) = asked.get(at) {
        let (inner, count) = shells.around(k)?;
        let end = inner.checked_add(count);
        let end = end
            .filter(|&end| end <= FARTHEST)
            .ok_or(SceneError::TooFar(k))?;
        let held = asked[at..].partition_point(|&k| k <= end);
        let way = shells.way(count, held as u64)?;
        blocks.push(Block {
            inner,
            count,
            way,
            asked: at..at + held,
        });
        at += held;
    }
    Ok(blocks)
}

/// Looks for the shells of photons, ascending.
struct Shells<'a> {
    scene: &'a Scene,
    /// For a sequence, which is not looked through from its start each time.
    walk: Walk<'a>,
    at_hand: (u64, u64),
    /// Whether one uniform number a shell is all.
    singles: bool,
}

impl<'a> Shells<'a> {
    fn new(scene: &'a Scene) -> Shells<'a> {
        let miscounted = matches!(scene.fault, Some(Fault::ShellCount | Fault::Dropped));
        let sorted = scene.fault.is_some_and(Fault::needs_sorting);
        Shells {
            scene,
            walk: scene.layout.walk(&1.into()),
            at_hand: (0, 0),
            singles: scene.mode == Mode::Cheapest && !miscounted && !sorted,
        }
    }

    /// The volume inside the block of photon k, and its own.
    fn around(&mut self, k: u64) -> Result<(u64, u64), SceneError> {
        let missing = SceneError::NoPhoton(k);
        match self.scene.layout {
            Layout::One if self.singles => Ok((align(k), SINGLES)),
            Layout::Sequence(_) => {
                while self.at_hand.0.saturating_add(self.at_hand.1) < k {
                    let (_, shell) = self.walk.next().ok_or(missing.clone())?;
                    self.at_hand = in_words(&shell).ok_or(SceneError::TooFar(k))?;
                }
                Ok(self.at_hand)
            }
            _ => {
                let shell = self.scene.layout.shell(&k.into()).ok_or(missing)?;
                in_words(&shell).ok_or(SceneError::TooFar(k))
            }
        }
    }

    /// The way to draw `held` photons of a block.
    fn way(&self, count: u64, held: u64) -> Result<Way, SceneError> {
        let sorts = self.scene.fault.is_some_and(Fault::needs_sorting);
        let way = match self.scene.mode {
            _ if sorts => Way::Sorted,
            Mode::Cheapest if self.singles && (count == 1 || self.scene.layout == Layout::One) => {
                Way::Singles
            }
            Mode::Cheapest if held.saturating_mul(BETA_COST) < count => Way::Beta,
            Mode::Cheapest | Mode::Spacings => Way::Spacings,
            Mode::Sorted => Way::Sorted,
            Mode::Beta => Way::Beta,
        };
        let most = match way {
            Way::Singles | Way::Beta => FARTHEST,
            Way::Spacings => LARGEST_DRAWN,
            Way::Sorted => LARGEST_SORTED,
        };
        match count <= most {
            true => Ok(way),
            false => Err(SceneError::Shell { count, most }),
        }
    }
}

/// How many photons lie before the block of single shells that holds photon k.
fn align(k: u64) -> u64 {
    (k - 1) / SINGLES * SINGLES
}

/// The volume inside a shell, and its own; `None` where they are out of reach.
fn in_words(shell: &Shell) -> Option<(u64, u64)> {
    Some((shell.inner.numer().to_u64()?, shell.count.to_u64()?))
}
