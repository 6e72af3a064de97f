//! `claimcheck chart figures`: the figures of the thesis, made again.

use super::super::output::{Exit, Failure, internal, replace_file, to_stdout};
use super::super::progress::Bar;
use super::{found, make_folder, not_ours, threads};
use crate::report::figures::{Error, Figure, Made, Pace, figures};
use clap::Args;
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
A figure that is there already, by the same command and version, is left as it is. The same command gives the same bytes, for any \
number of threads.";

impl Figures {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let chosen = self.chosen()?;
        let pace = Pace::of(self.quick);
        make_folder(&self.out)?;
        let threads = threads(self.jobs)?;
        let files = chosen.iter().map(|figure| {
            let files = Files::new(&self.out, figure);
            let there = files.hold(&figure.command(pace))?;
            Ok((files, there))
        });
        let files = files.collect::<Result<Vec<_>, Failure>>()?;
        let bar = Bar::new(chosen.len(), "figures", self.quiet);
        for (done, (figure, (files, there))) in chosen.iter().zip(files).enumerate() {
            bar.show(done);
            let said = match there {
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

    /// Whether both are there; what is there was made by this command.
    fn hold(&self, command: &str) -> Result<bool, Failure> {
        let holds = |path| match found(path)? {
            Some(text) if !text.contains(command) => Err(not_ours(path)),
            text => Ok(text.is_some()),
        };
        Ok(holds(&self.csv)? && holds(&self.svg)?)
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
