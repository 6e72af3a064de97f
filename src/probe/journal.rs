//! The journal of a probe: a text file with the question and a line for each chunk that is done. A run that was
//! killed goes on from there, and journals of shards add up.

use super::{Question, Summary};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

/// The first line.
#[derive(Debug, Serialize, Deserialize)]
struct Head {
    probe: Question,
    /// [`SCHEME`] of the program that wrote it.
    scheme: u32,
}

/// Raised by whoever changes what a chunk is or how one is asked: older journals are of no use then.
const SCHEME: u32 = 2;

/// How long a locked journal is waited for.
const LOCK_TRIES: u32 = 20;
const LOCK_PAUSE: Duration = Duration::from_millis(50);

/// Any other line.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    chunk: u64,
    found: Summary,
    /// Of the question and of the line without it: a damaged line is no evidence.
    #[serde(default)]
    check: String,
}

impl Line {
    fn new(question: &Question, chunk: u64, found: Summary) -> io::Result<Line> {
        let mut line = Line {
            chunk,
            found,
            check: String::new(),
        };
        line.check = line.sum(question)?;
        Ok(line)
    }

    /// The hash FNV-1a of 64 bits (Fowler, Noll and Vo) of the two texts.
    fn sum(&self, question: &Question) -> io::Result<String> {
        let bare = Line {
            chunk: self.chunk,
            found: self.found.clone(),
            check: String::new(),
        };
        let texts = text(&head(question))? + &text(&bare)?;
        let step =
            |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        Ok(format!(
            "{:016x}",
            texts.bytes().fold(0xcbf2_9ce4_8422_2325, step)
        ))
    }
}

/// The chunks of a question that are done.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: Option<File>,
    question: Question,
    done: BTreeMap<u64, Summary>,
}

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// It cannot be read or written.
    #[error("{path}: {error}")]
    File { path: PathBuf, error: io::Error },
    /// It is no journal, or a damaged one.
    #[error("{path}:{line}: no journal of a probe, or damaged")]
    Foreign { path: PathBuf, line: usize },
    /// It asks something else.
    #[error("{path} is the journal of another question")]
    Other { path: PathBuf },
    /// Another version of the program wrote it.
    #[error("{path} is the journal of another version of this program")]
    Older { path: PathBuf },
    /// Another run writes to it.
    #[error("{path} is in use by another run")]
    InUse { path: PathBuf },
    /// Two journals of the same question found different things.
    #[error("{path} contradicts another journal in chunk {chunk}")]
    Contradicts { path: PathBuf, chunk: u64 },
}

fn head(question: &Question) -> Head {
    Head {
        probe: question.clone(),
        scheme: SCHEME,
    }
}

fn text(line: &impl Serialize) -> io::Result<String> {
    Ok(serde_json::to_string(line)? + "\n")
}

impl Journal {
    /// A journal kept in memory only.
    pub fn unwritten(question: &Question) -> Journal {
        Journal {
            path: PathBuf::new(),
            file: None,
            question: question.clone(),
            done: BTreeMap::new(),
        }
    }

    /// The journal of this question in a file: what is there already, and more to come.
    ///
    /// # Errors
    /// [`JournalError`]. A last line that a killed run left unfinished is no error: it is written anew.
    pub fn open(path: &Path, question: &Question) -> Result<Journal, JournalError> {
        let failed = |error| JournalError::File {
            path: path.to_owned(),
            error,
        };
        if std::fs::metadata(path).is_ok_and(|data| !data.is_file()) {
            let error = io::Error::other("no ordinary file");
            return Err(failed(error));
        }
        let mut options = OpenOptions::new();
        let mut file = options
            .read(true)
            .append(true)
            .create(true)
            .open(path)
            .map_err(failed)?;
        // Held until the run ends, however it ends; a run that was just killed may still hold it for a moment.
        let mut free = file.try_lock().is_ok();
        for _ in 0..LOCK_TRIES {
            if free {
                break;
            }
            thread::sleep(LOCK_PAUSE);
            free = file.try_lock().is_ok();
        }
        if !free {
            return Err(JournalError::InUse {
                path: path.to_owned(),
            });
        }
        let mut known = vec![];
        file.read_to_end(&mut known).map_err(failed)?;
        let whole = known
            .iter()
            .rposition(|&byte| byte == b'\n')
            .map_or(0, |at| at + 1);
        // A killed run may have left a part of the first line.
        let begun = text(&head(question)).map_err(failed)?;
        let mut journal = match begun.as_bytes().starts_with(&known) {
            true => Journal::unwritten(question),
            false => Journal::read(path)?,
        };
        if journal.question != *question {
            return Err(JournalError::Other {
                path: path.to_owned(),
            });
        }
        file.set_len(whole as u64).map_err(failed)?;
        path.clone_into(&mut journal.path);
        journal.file = Some(file);
        if whole == 0 {
            journal.write(&head(question))?;
        }
        Ok(journal)
    }

    /// Reads a finished or unfinished journal.
    ///
    /// # Errors
    /// [`JournalError`]
    pub fn read(path: &Path) -> Result<Journal, JournalError> {
        let failed = |error| JournalError::File {
            path: path.to_owned(),
            error,
        };
        let foreign = |line| JournalError::Foreign {
            path: path.to_owned(),
            line,
        };
        let mut reader = BufReader::new(File::open(path).map_err(failed)?);
        let mut text = String::new();
        reader.read_line(&mut text).map_err(failed)?;
        let Head { probe, scheme } = serde_json::from_str(&text).map_err(|_| foreign(1))?;
        if scheme != SCHEME {
            return Err(JournalError::Older {
                path: path.to_owned(),
            });
        }
        let mut journal = Journal::unwritten(&probe);
        path.clone_into(&mut journal.path);
        for number in 2.. {
            text.clear();
            reader.read_line(&mut text).map_err(failed)?;
            if !text.ends_with('\n') {
                break;
            }
            let line: Line = serde_json::from_str(&text).map_err(|_| foreign(number))?;
            if line.sum(&probe).map_err(failed)? != line.check {
                return Err(foreign(number));
            }
            journal.done.insert(line.chunk, line.found);
        }
        Ok(journal)
    }

    fn write(&mut self, line: &impl Serialize) -> Result<(), JournalError> {
        let Some(file) = &mut self.file else {
            return Ok(());
        };
        // One write: a line is there or not.
        let written = text(line).and_then(|line| file.write_all(line.as_bytes()));
        written.map_err(|error| {
            // Nothing may follow a line that is there in part.
            self.file = None;
            JournalError::File {
                path: self.path.clone(),
                error,
            }
        })
    }

    /// Takes in a chunk.
    ///
    /// # Errors
    /// `File` where it cannot be written; it counts as done all the same.
    pub fn add(&mut self, chunk: u64, found: Summary) -> Result<(), JournalError> {
        let failed = |error| JournalError::File {
            path: self.path.clone(),
            error,
        };
        let line = Line::new(&self.question, chunk, found).map_err(failed)?;
        let written = self.write(&line);
        self.done.insert(chunk, line.found);
        written
    }

    /// What is asked.
    pub fn question(&self) -> &Question {
        &self.question
    }

    /// Whether a chunk is done.
    pub fn has(&self, chunk: u64) -> bool {
        self.done.contains_key(&chunk)
    }

    /// The chunks that are done, in order.
    pub fn done(&self) -> impl Iterator<Item = u64> {
        self.done.keys().copied()
    }

    /// Takes in the chunks of another journal.
    ///
    /// # Errors
    /// `Other` where that asks something else, `Contradicts` where it found something else.
    pub fn join(&mut self, other: Journal) -> Result<(), JournalError> {
        let path = other.path;
        if other.question != self.question {
            return Err(JournalError::Other { path });
        }
        for (chunk, found) in other.done {
            match self.done.get(&chunk) {
                Some(known) if *known != found => {
                    return Err(JournalError::Contradicts { path, chunk });
                }
                _ => self.done.insert(chunk, found),
            };
        }
        Ok(())
    }

    /// All chunks that are done as one, the same whatever order they were done in.
    pub fn summary(&self) -> Summary {
        let mut all = Summary::default();
        for found in self.done.values() {
            all.merge(found);
        }
        all
    }
}
