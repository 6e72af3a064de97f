//! The machine that measures, in words.

use std::env::consts::{ARCH, OS};
use std::fs;
use std::thread::available_parallelism;

/// The processor and its cores.
pub(super) fn words() -> String {
    let cores = match available_parallelism().map_or(1, usize::from) {
        1 => "1 core".to_owned(),
        cores => format!("{cores} cores"),
    };
    let processor = processor().unwrap_or_else(|| "a processor".to_owned());
    format!("{processor} ({ARCH}), {cores}, {OS}")
}

/// As Linux names it.
fn processor() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    let (_, name) = line.split_once(':')?;
    Some(name.split_whitespace().collect::<Vec<_>>().join(" "))
}
