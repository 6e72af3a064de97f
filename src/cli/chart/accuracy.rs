//! `claimcheck chart accuracy`: what digits cost.

use super::super::output::{Exit, Failure, to_stderr};
use super::survey::Desk;
use super::text_of;
use crate::measure::accuracy::Question;
use crate::report::figures::Pace;
use crate::report::survey::{Rivals, accuracy, can_count, count_calls};
use crate::special::shell::Quantity;
use clap::{Args, ValueEnum};
use std::io;
use std::path::{Path, PathBuf};

/// Times every method against the digits that it proves, and the choice among them
#[derive(Debug, Args)]
#[command(after_help = RESUMED)]
pub(super) struct Accuracy {
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Fewer photons, up to 1000 digits
    #[arg(long)]
    quick: bool,
    /// Figures of other programs to draw beside: the CSV file of benches/rivals
    #[arg(long, value_name = "FILE")]
    rivals: Option<PathBuf>,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
}

const RESUMED: &str = "\
Writes accuracy-mean and accuracy-variance as CSV and SVG, and accuracy.md, which tells them in words. A run that was killed goes on \
where it stopped; what is finished is only drawn again. Instructions are counted where valgrind is installed. Times want a machine \
that does nothing else.";

impl Accuracy {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let rivals = match &self.rivals {
            Some(path) => read(path)?,
            None => Rivals::default(),
        };
        let counter = std::env::current_exe().ok();
        let counter = counter.filter(|program| can_count(program));
        if counter.is_none() {
            to_stderr("note: instructions are not counted, valgrind is not there or fails");
        }
        let desk = Desk {
            out: self.out,
            quiet: self.quiet,
        };
        let surveys = accuracy(Pace::of(self.quick), &rivals, counter);
        if let Some(path) = &self.rivals
            && surveys.all.iter().all(|survey| survey.beside().is_empty())
        {
            let message = format!(
                "{}: no figure is of a question of this chart",
                path.display()
            );
            let hint =
                "the quantity is mean or variance, k and the digits asked are those of the chart";
            return Err(Failure::input(&message, Some(hint)));
        }
        desk.run(&surveys)
    }
}

fn read(path: &Path) -> Result<Rivals, Failure> {
    let failed = |error: &dyn std::fmt::Display, hint| {
        Failure::input(&format!("{}: {error}", path.display()), Some(hint))
    };
    let text = text_of(path).and_then(|text| text.ok_or_else(|| io::Error::other("no such file")));
    let text = text.map_err(|error| failed(&error, "name a CSV file"))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Rivals::read(&name, &text).map_err(|error| {
        let hint = "benches/rivals/run.py --figures FILE writes such a file";
        failed(&error, hint)
    })
}

/// Makes calls for a counter that watches: `chart accuracy` runs it under valgrind
#[derive(Debug, Args)]
pub(super) struct Count {
    quantity: What,
    k: u64,
    digits: u32,
    /// No call that is expected to take more instructions
    most: f64,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    Mean,
    Variance,
}

impl Count {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let quantity = match self.quantity {
            What::Mean => Quantity::Mean,
            What::Variance => Quantity::Variance,
        };
        let question = Question {
            quantity,
            k: self.k,
            digits: self.digits,
        };
        count_calls(question, self.most);
        Ok(Exit::AsExpected)
    }
}
