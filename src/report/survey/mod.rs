//! Measurements as charts: rows first, then a picture and words from the rows alone.
//!
//! A [`Survey`] is measured unit by unit; its rows are a [`Sheet`], that is a CSV file. Picture and words are functions of the sheet, so that
//! every number in them stands there, and a sheet on disk can be drawn again. [`accuracy`] and [`stability`] have the surveys of
//! `claimcheck chart accuracy` and `claimcheck chart stability`.

mod accuracy;
mod choice;
mod maps;
mod sheet;
mod simulation;

pub use accuracy::{Rivals, accuracy, count_calls};
pub use maps::stability;
pub use sheet::{Sheet, SheetError};

use super::chart::Chart;
use super::figures::Pace;
use crate::simulate::{CheckpointError, SceneError};
use crate::special::shell::{Method, ShellError};

/// Something to measure, and how it is shown.
pub trait Survey: Sync {
    /// The name of its files, without an ending.
    fn name(&self) -> String;

    /// The title of the picture.
    fn title(&self) -> String;

    /// What a reader must know, below the picture.
    fn notes(&self) -> Vec<String>;

    /// The names of the columns.
    fn columns(&self) -> Vec<String>;

    /// How many parts are measured one by one; each is kept once it is done.
    fn units(&self) -> usize;

    /// Whether all units are there: of a file that somebody may have cut.
    fn is_whole(&self, sheet: &Sheet) -> bool;

    /// Whether units may be measured at the same time: not where time is measured.
    fn side_by_side(&self) -> bool;

    /// The rows of a unit.
    ///
    /// # Errors
    /// [`Error`]
    fn measure(&self, unit: usize) -> Result<Vec<Vec<String>>, Error>;

    /// The pictures, but for the notes, each with what its name and its title have beyond those of the survey.
    ///
    /// # Errors
    /// Where the sheet is not one of this survey.
    fn pictures(&self, sheet: &Sheet) -> Result<Vec<(&'static str, Chart)>, SheetError>;

    /// What it shows, as paragraphs of Markdown.
    ///
    /// # Errors
    /// Where the sheet is not one of this survey.
    fn words(&self, sheet: &Sheet) -> Result<String, SheetError>;
}

/// The surveys of one command.
pub struct Surveys {
    /// `accuracy` or `stability`
    pub group: &'static str,
    /// The heading of the page of words.
    pub heading: &'static str,
    pub pace: Pace,
    /// Of the command, beside `--quick`.
    options: String,
    pub all: Vec<Box<dyn Survey>>,
}

/// A picture of a survey.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    pub name: String,
    pub title: String,
    pub svg: String,
}

/// Why nothing could be measured.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No truth to compare with.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// A scene that cannot be simulated.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A simulation that stopped.
    #[error(transparent)]
    Run(#[from] CheckpointError),
    /// Two certified methods contradict each other.
    #[error("{0} contradict each other")]
    Contradiction(String),
}

impl Surveys {
    /// The command, with the program's version.
    pub fn command(&self) -> String {
        let quick = match self.pace {
            Pace::Full => "",
            Pace::Quick => " --quick",
        };
        format!(
            "claimcheck {}: claimcheck chart {}{quick}{} --out .",
            env!("CARGO_PKG_VERSION"),
            self.group,
            self.options
        )
    }

    /// An empty sheet of a survey, headed by what it is, what a reader must know, by which command it was made, on which machine.
    pub fn sheet(&self, survey: &dyn Survey) -> Sheet {
        let made = [self.command(), super::machine::words()];
        let notes = std::iter::once(survey.title())
            .chain(survey.notes())
            .chain(made);
        Sheet::new(notes.collect(), survey.columns())
    }

    /// The pictures of a sheet: their names, without an ending, their titles and the SVG.
    ///
    /// # Errors
    /// Where the sheet is not one of this survey.
    pub fn draw(&self, survey: &dyn Survey, sheet: &Sheet) -> Result<Vec<Picture>, SheetError> {
        let mut notes = sheet.notes().iter().cloned();
        let title = notes.next().unwrap_or_default();
        let notes: Vec<String> = notes.collect();
        let pictures = survey.pictures(sheet)?.into_iter();
        let drawn = pictures.map(|(more, chart)| {
            let title = title.clone() + &chart.title;
            let chart = Chart {
                title: title.clone(),
                notes: notes.clone(),
                ..chart
            };
            Picture {
                name: survey.name() + more,
                title,
                svg: chart.to_svg(),
            }
        });
        Ok(drawn.collect())
    }

    /// The page of words: a section each survey, with its picture.
    ///
    /// # Errors
    /// Where a sheet is not one of its survey.
    pub fn page(&self, sheets: &[Sheet]) -> Result<String, SheetError> {
        let mut page = format!("# {}\n", self.heading);
        for (survey, sheet) in self.all.iter().zip(sheets) {
            page += &format!("\n## {}\n", survey.title());
            for Picture { name, title, .. } in self.draw(survey.as_ref(), sheet)? {
                page += &format!("\n![{title}]({name}.svg)\n");
            }
            let (name, words) = (survey.name(), survey.words(sheet)?);
            page += &format!(
                "\n{}\n\nData: [{name}.csv]({name}.csv).\n",
                words.trim_end()
            );
        }
        if let Some([.., command, machine]) = sheets.first().map(Sheet::notes) {
            page += &format!("\nMade by `{command}` on: {machine}.\n");
        }
        Ok(page)
    }
}

/// A certified method in a few words.
fn method_words(method: Method) -> &'static str {
    match method {
        Method::Words => "Pfaff, machine words",
        Method::Splitting => "Pfaff, binary splitting",
        Method::Pfaff => "Pfaff, intervals",
        Method::Exact => "closed form with ln",
        Method::Moments => "central moments",
        Method::Direct => "power series",
        Method::Middle => "relation from the middle",
        Method::Upwards => "relation upwards",
        Method::Downwards => "relation downwards",
        Method::Euler => "Euler's integral",
        Method::Thesis => "thesis's formula",
    }
}

/// A whole number as an exponent.
fn raised(number: u32) -> String {
    const DIGITS: [char; 10] = [
        '\u{2070}', '\u{b9}', '\u{b2}', '\u{b3}', '\u{2074}', '\u{2075}', '\u{2076}', '\u{2077}',
        '\u{2078}', '\u{2079}',
    ];
    let digits = number.to_string();
    digits
        .bytes()
        .map(|digit| DIGITS[usize::from(digit - b'0')])
        .collect()
}

#[cfg(test)]
mod tests;
