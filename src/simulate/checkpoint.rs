//! The file from which a run that was killed goes on.
//!
//! A line of JSON, the scene and the scheme; then in 64 bits each, the least byte first: the number of runs,
//! for each photon the sum of d, for each the sum of d^2, and the hash FNV-1a (Fowler, Noll and Vo) of all
//! bytes before.

use super::{Fault, Mode, Scene, Simulation, Sums};
use crate::model::Layout;
use serde::Serialize;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Raised by whoever changes what is drawn for a scene, or the file: older files are of no use then.
const SCHEME: u32 = 1;

/// How often the file is written.
const PAUSE: Duration = Duration::from_secs(5);

/// The sums of the chunks that are done, in a file.
#[derive(Debug)]
pub struct Checkpoint {
    path: PathBuf,
    head: String,
    /// Of the last writing.
    written: Instant,
    found: Option<Sums>,
}

/// Why a checkpoint cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// It cannot be read or written.
    #[error("{path}: {error}")]
    File { path: PathBuf, error: io::Error },
    /// It is no checkpoint, or a damaged one.
    #[error("{path}: no checkpoint of a simulation, or damaged")]
    Foreign { path: PathBuf },
    /// Another scene was simulated.
    #[error("{path} is the checkpoint of another simulation")]
    Other { path: PathBuf },
    /// Another version of the program wrote it.
    #[error("{path} is the checkpoint of another version of this program")]
    Older { path: PathBuf },
}

/// The first line.
#[derive(Serialize)]
struct Head<'a> {
    simulation: &'static str,
    scheme: u32,
    layout: String,
    photons: u64,
    dimension: Option<u32>,
    mode: Mode,
    runs: u64,
    seed: u64,
    only: &'a Option<Vec<u64>>,
    fault: Option<Fault>,
}

/// What `simulation` of the first line says.
const TITLE: &str = "k/U - 1";

fn head(scene: &Scene) -> io::Result<String> {
    let head = Head {
        simulation: TITLE,
        scheme: SCHEME,
        layout: words(&scene.layout),
        photons: scene.photons,
        dimension: scene.dimension,
        mode: scene.mode,
        runs: scene.runs,
        seed: scene.seed,
        only: &scene.only,
        fault: scene.fault,
    };
    Ok(serde_json::to_string(&head)? + "\n")
}

fn words(layout: &Layout) -> String {
    match layout {
        Layout::Unstratified(n) => format!("unstratified {n}"),
        Layout::One => "one".into(),
        Layout::Triangular => "triangular".into(),
        Layout::Listing => "listing".into(),
        Layout::Sequence(counts) => {
            let counts: Vec<String> = counts.iter().map(u64::to_string).collect();
            counts.join(",")
        }
    }
}

fn fnv(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

impl Checkpoint {
    /// The checkpoint of this simulation in a file: what is there already, if anything is, and more to come.
    ///
    /// # Errors
    /// [`CheckpointError`], where the file is there but holds something else.
    pub fn open(path: &Path, simulation: &Simulation) -> Result<Checkpoint, CheckpointError> {
        let failed = |error| CheckpointError::File {
            path: path.to_owned(),
            error,
        };
        let mut checkpoint = Checkpoint {
            path: path.to_owned(),
            head: head(simulation.scene()).map_err(failed)?,
            written: Instant::now(),
            found: None,
        };
        let size = checkpoint.head.len() + 16 * simulation.photons().len() + 16;
        match File::open(path) {
            Ok(file) if file.metadata().is_ok_and(|data| data.is_file()) => {
                let mut bytes = vec![];
                file.take(size as u64 + 1)
                    .read_to_end(&mut bytes)
                    .map_err(failed)?;
                checkpoint.found = Some(checkpoint.read(&bytes, simulation)?);
            }
            Ok(_) => return Err(failed(io::Error::other("no ordinary file"))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(failed(error)),
        }
        Ok(checkpoint)
    }

    /// How many runs are done already.
    pub fn runs(&self) -> u64 {
        self.found.as_ref().map_or(0, |sums| sums.runs)
    }

    /// Takes out the sums that were found, or none yet.
    pub(super) fn sums(&mut self, simulation: &Simulation) -> Sums {
        self.found.take().unwrap_or_else(|| simulation.no_runs())
    }

    fn read(&self, bytes: &[u8], simulation: &Simulation) -> Result<Sums, CheckpointError> {
        let Some(body) = bytes.strip_prefix(self.head.as_bytes()) else {
            return Err(self.stranger(bytes));
        };
        self.sums_in(bytes, body, simulation)
            .ok_or_else(|| self.foreign())
    }

    /// The sums in the bytes after the first line.
    fn sums_in(&self, bytes: &[u8], body: &[u8], simulation: &Simulation) -> Option<Sums> {
        let count = simulation.photons().len();
        let (words, []) = body.as_chunks::<8>() else {
            return None;
        };
        let words: Vec<u64> = words.iter().map(|word| u64::from_le_bytes(*word)).collect();
        let [runs, sums @ .., hash] = &words[..] else {
            return None;
        };
        let checked = bytes.get(..bytes.len() - 8)?;
        if sums.len() != 2 * count || fnv(checked) != *hash || !simulation.ends_a_chunk(*runs) {
            return None;
        }
        let (deviation, square) = sums.split_at(count);
        let doubles = |words: &[u64]| words.iter().map(|word| f64::from_bits(*word)).collect();
        Some(Sums {
            runs: *runs,
            photons: simulation.photons().to_vec(),
            deviation: doubles(deviation),
            square: doubles(square),
        })
    }

    fn foreign(&self) -> CheckpointError {
        CheckpointError::Foreign {
            path: self.path.clone(),
        }
    }

    /// Whose file it is that does not begin with the right line.
    fn stranger(&self, bytes: &[u8]) -> CheckpointError {
        let path = self.path.clone();
        let line = bytes
            .split(|byte| *byte == b'\n')
            .next()
            .unwrap_or_default();
        // The line of another scene may be longer than what was read: its beginning tells whose it is.
        let begins = |text: String| line.starts_with(text.as_bytes());
        let title = format!("{{\"simulation\":\"{TITLE}\",\"scheme\":");
        if begins(format!("{title}{SCHEME},")) {
            CheckpointError::Other { path }
        } else if begins(title) {
            CheckpointError::Older { path }
        } else {
            CheckpointError::Foreign { path }
        }
    }

    /// Writes the sums, if the last time is some seconds ago.
    pub(super) fn write_now_and_then(&mut self, sums: &Sums) -> Result<(), CheckpointError> {
        match self.written.elapsed() < PAUSE {
            true => Ok(()),
            false => self.write(sums),
        }
    }

    /// Writes the sums: a new file takes the place of the old one, so that one of both is always there, whole.
    pub(super) fn write(&mut self, sums: &Sums) -> Result<(), CheckpointError> {
        let mut bytes = self.head.clone().into_bytes();
        bytes.extend(sums.runs.to_le_bytes());
        for sum in sums.deviation.iter().chain(&sums.square) {
            bytes.extend(sum.to_le_bytes());
        }
        bytes.extend(fnv(&bytes).to_le_bytes());
        let mut part = self.path.clone().into_os_string();
        part.push(".part");
        let written = replace(&self.path, Path::new(&part), &bytes);
        self.written = Instant::now();
        written.map_err(|error| CheckpointError::File {
            path: self.path.clone(),
            error,
        })
    }
}

fn replace(path: &Path, part: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(part)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    fs::rename(part, path)
}
