//! `claimcheck chart figures`: the figures of the thesis, made again.

use super::super::output::{Exit, Failure, internal, replace_file, to_stdout};
use super::super::progress::Bar;
use crate::report::figures::{Error, Figure, Made, Pace, figures};
use clap::Args;
use std::fs;
use std::path::{Path, PathBuf};

/// Makes the figures of the thesis again: the data of each as CSV, its picture as SVG
#[derive(Debug, Args)]
#[command(after_help = RESUMED)]
pub(super) struct Figures {
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// These figures alone: 2.9,3.1 [default: all]
    #[arg(long, value_name = "NUMBER,...", value_delimiter = ',')]
    only: Vec<String>,
    /// At most 200 runs of a scene
    #[arg(long)]
    quick: bool,
    /// Threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
}

const RESUMED: &str = "\
A figure is left as it is where both of its files are there and name the command and the version of the
program that would make them. The same command gives the same bytes, for any number of threads.";

impl Figures {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let chosen = self.chosen()?;
        let pace = match self.quick {
            true => Pace::Quick,
            false => Pace::Full,
        };
        fs::create_dir_all(&self.out).map_err(|error| {
            let message = format!("{} cannot be made: {error}", self.out.display());
            Failure::input(&message, Some("name a folder that can be written to"))
        })?;
        let threads = rayon::ThreadPoolBuilder::new().num_threads(self.jobs.unwrap_or(0).into());
        let threads = threads
            .build()
            .map_err(|error| internal(&error.to_string()))?;
        let bar = Bar::new(chosen.len(), "figures", self.quiet);
        for (done, figure) in chosen.iter().enumerate() {
            bar.show(done);
            let files = Files::new(&self.out, figure);
            let said = match files.hold(&figure.command(pace)) {
                true => "there already",
                false => {
                    let made = threads.install(|| figure.make(pace)).map_err(faulty)?;
                    files.write(&made)?;
                    "made"
                }
            };
            let name = format!("figure-{}", figure.number);
            bar.aside(|| to_stdout(&format!("{name}.csv, {name}.svg: {said}\n")))?;
        }
        bar.clear();
        Ok(Exit::AsExpected)
    }

    fn chosen(&self) -> Result<Vec<Figure>, Failure> {
        let all = figures();
        let known: Vec<String> = all.iter().map(|figure| figure.number.to_string()).collect();
        let only: Vec<&str> = self.only.iter().map(|number| number.trim()).collect();
        if let Some(unknown) = only
            .iter()
            .find(|number| !known.iter().any(|k| k == *number))
        {
            let message = format!("there is no figure `{unknown}` to make");
            let hint = format!("there are {}", known.join(", "));
            return Err(Failure::input(&message, Some(&hint)));
        }
        let pairs = all.into_iter().zip(known);
        let wanted = pairs.filter(|(_, number)| only.is_empty() || only.contains(&number.as_str()));
        Ok(wanted.map(|(figure, _)| figure).collect())
    }
}

/// The files of a figure.
struct Files {
    csv: PathBuf,
    svg: PathBuf,
}

impl Files {
    fn new(folder: &Path, figure: &Figure) -> Files {
        let file = |ending| folder.join(format!("figure-{}.{ending}", figure.number));
        Files {
            csv: file("csv"),
            svg: file("svg"),
        }
    }

    /// Whether both are there and were made by this command.
    fn hold(&self, command: &str) -> bool {
        let holds = |path| fs::read_to_string(path).is_ok_and(|text| text.contains(command));
        holds(&self.csv) && holds(&self.svg)
    }

    fn write(&self, made: &Made) -> Result<(), Failure> {
        replace_file(&self.csv, &made.csv)?;
        replace_file(&self.svg, &made.svg)
    }
}

/// The table of figures asks for nothing but what there is.
fn faulty(error: Error) -> Failure {
    internal(&error.to_string())
}
