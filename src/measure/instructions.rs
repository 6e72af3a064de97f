//! Counted instructions: the program itself, run under valgrind's callgrind where that is installed. Counts do not depend on what
//! else the machine does.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// What is counted: [`Call::run`](super::accuracy::Call::run).
const COUNTED: &str = "claimcheck::measure::accuracy::Call::run";

/// The instructions of each of the calls that a program makes; `None` where they cannot be counted, are not so many, or where it takes
/// longer than `patience`.
pub fn count(
    program: &Path,
    arguments: &[String],
    calls: usize,
    patience: Duration,
) -> Option<Vec<u64>> {
    let folder = Folder::new()?;
    let counter = Command::new("valgrind")
        .arg("--tool=callgrind")
        .arg(format!("--toggle-collect={COUNTED}"))
        .arg(format!("--dump-after={COUNTED}"))
        .arg(format!(
            "--callgrind-out-file={}",
            folder.0.join("out").display()
        ))
        .arg(program)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    if !succeeds(counter, patience) {
        return None;
    }
    (1..=calls)
        .map(|call| counted(&folder.0.join(format!("out.{call}"))))
        .collect()
}

/// Waits for a program, and ends it when patience is at its end.
fn succeeds(mut program: Child, patience: Duration) -> bool {
    let start = Instant::now();
    loop {
        match program.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) if start.elapsed() < patience => thread::sleep(Duration::from_millis(10)),
            _ => {
                // It may have ended meanwhile.
                let _ = program.kill();
                let _ = program.wait();
                return false;
            }
        }
    }
}

/// The sum in a file of callgrind's.
fn counted(path: &Path) -> Option<u64> {
    let text = fs::read_to_string(path).ok()?;
    let sum = |line: &str| {
        let rest = line
            .strip_prefix("totals: ")
            .or_else(|| line.strip_prefix("summary: "));
        rest.and_then(|number| number.trim().parse().ok())
    };
    text.lines().find_map(sum)
}

/// A folder for a moment.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Option<Folder> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let next = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("claimcheck-count-{}-{next}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir(&path).ok()?;
        Some(Folder(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left in the folder of temporary files does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_hangs_is_ended() {
        let sleeper = |seconds: &str| Command::new("sleep").arg(seconds).spawn().expect("sleep");
        assert!(succeeds(sleeper("0"), Duration::from_secs(60)));
        assert!(!succeeds(sleeper("600"), Duration::from_millis(20)));
    }
}
