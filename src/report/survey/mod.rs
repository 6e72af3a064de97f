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

pub use accuracy::{Rivals, accuracy, can_count, count_calls};
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

    /// The names of the columns.
    fn columns(&self) -> Vec<String>;

    /// How many parts are measured one by one; each is kept once it is done.
    fn units(&self) -> usize;

    /// The first cells of each row of a unit: what is measured there. By these rows are known again.
    fn places(&self, unit: usize) -> Vec<Vec<String>>;

    /// Whether units may be measured at the same time: not where time is measured.
    fn side_by_side(&self) -> bool;

    /// The cells that follow those of [`Survey::places`], row by row.
    ///
    /// # Errors
    /// [`Error`]
    fn measure(&self, unit: usize) -> Result<Vec<Vec<String>>, Error>;

    /// The rows of a unit.
    ///
    /// # Errors
    /// [`Error`]
    fn rows(&self, unit: usize) -> Result<Vec<Vec<String>>, Error> {
        let places = self.places(unit).into_iter();
        let row = |(place, cells): (Vec<String>, Vec<String>)| [place, cells].concat();
        Ok(places.zip(self.measure(unit)?).map(row).collect())
    }

    /// Rows that are not measured here, but drawn beside; they come last.
    fn beside(&self) -> Vec<Vec<String>> {
        vec![]
    }

    /// What a reader of all rows must know, below the picture.
    ///
    /// # Errors
    /// Where the sheet is not one of this survey.
    fn notes(&self, sheet: &Sheet) -> Result<Vec<String>, SheetError>;

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
    /// Of the command: what is drawn beside what is measured.
    options: String,
    pub all: Vec<Box<dyn Survey>>,
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
    /// The command that measures, with the program's version.
    fn command(&self) -> String {
        let quick = match self.pace {
            Pace::Full => "",
            Pace::Quick => " --quick",
        };
        let (version, group) = (env!("CARGO_PKG_VERSION"), self.group);
        format!("claimcheck {version}: claimcheck chart {group}{quick} --out .")
    }

    /// A survey's sheet before anything is measured: what it is, by which command, on which machine.
    pub fn sheet(&self, survey: &dyn Survey) -> Sheet {
        let notes = vec![survey.title(), self.command(), super::machine::words()];
        Sheet::new(notes, survey.columns())
    }

    /// Whether a file is of this command, version and machine, finished or not.
    pub fn owns(&self, survey: &dyn Survey, found: &Sheet) -> bool {
        let own = self.sheet(survey);
        let ([title, command, machine], [other, .., made, place]) = (own.notes(), found.notes())
        else {
            return false;
        };
        // What is drawn beside comes last.
        let options = made.strip_prefix(command.as_str());
        (title, machine) == (other, place)
            && options.is_some_and(|options| options.is_empty() || options.starts_with(' '))
            && own.columns() == found.columns()
    }

    /// The whole units that a file begins with, and how many those are. None where a cell of these cannot be read.
    pub fn whole(&self, survey: &dyn Survey, found: &Sheet) -> (Sheet, usize) {
        let (mut units, mut rows) = (0, 0);
        while units < survey.units() {
            let places = survey.places(units);
            let own = found.rows().get(rows..rows + places.len());
            let fit = |own: &[Vec<String>]| {
                let mut both = own.iter().zip(&places);
                both.all(|(row, place)| row.starts_with(place))
            };
            if !own.is_some_and(fit) {
                break;
            }
            rows += places.len();
            units += 1;
        }
        let mut sheet = self.sheet(survey);
        sheet.add(found.rows()[..rows].to_vec());
        match survey.pictures(&sheet) {
            Ok(_) => (sheet, units),
            Err(_) => (self.sheet(survey), 0),
        }
    }

    /// A sheet with all that was measured, ready to be drawn: with the rows that come beside, and with what a reader must know.
    ///
    /// # Errors
    /// Where the sheet is not one of this survey.
    pub fn complete(&self, survey: &dyn Survey, mut sheet: Sheet) -> Result<Sheet, SheetError> {
        sheet.add(survey.beside());
        let mut notes = vec![survey.title()];
        notes.extend(survey.notes(&sheet)?);
        notes.push(self.command() + &self.options);
        notes.push(super::machine::words());
        Ok(sheet.with_notes(notes))
    }

    /// The pictures of a complete sheet, with the names of their files, without an ending.
    ///
    /// # Errors
    /// Where the sheet is not one of this survey.
    pub fn pictures(
        &self,
        survey: &dyn Survey,
        sheet: &Sheet,
    ) -> Result<Vec<(String, Chart)>, SheetError> {
        let (title, notes) = match sheet.notes() {
            [title, notes @ ..] => (title.as_str(), notes),
            [] => ("", [].as_slice()),
        };
        let pictures = survey.pictures(sheet)?.into_iter();
        let named = pictures.map(|(more, chart)| {
            let chart = Chart {
                title: title.to_owned() + &chart.title,
                notes: notes.to_vec(),
                ..chart
            };
            (survey.name() + more, chart)
        });
        Ok(named.collect())
    }

    /// The page of words: a section each survey, with its pictures.
    ///
    /// # Errors
    /// Where a sheet is not one of its survey.
    pub fn page(&self, sheets: &[Sheet]) -> Result<String, SheetError> {
        let mut page = format!("# {}\n", self.heading);
        for (survey, sheet) in self.all.iter().zip(sheets) {
            page += &format!("\n## {}\n", survey.title());
            for (name, chart) in self.pictures(survey.as_ref(), sheet)? {
                page += &format!("\n![{}]({name}.svg)\n", chart.title);
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

/// The middle one of the values, or the mean of the two in the middle; `None` of none.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = values.len() / 2;
    let lower = values.len().checked_sub(1)? / 2;
    Some((values.get(lower)? + values.get(upper)?) / 2.0)
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
