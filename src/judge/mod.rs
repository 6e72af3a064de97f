//! Statement to verdict.

mod verdict;

pub use verdict::{Answer, Constants, Extent, Kind, LinkReport, Report, Verdict, WitnessReport};
