//! Measures surveys, unit by unit, and writes their files.
//!
//! While a survey is measured its rows are in `NAME.csv.part`: what a run that was killed had finished is there, and the next one goes on
//! from it. The picture is drawn, and the page of words written, from the finished `NAME.csv`.

use super::super::output::{Exit, Failure, internal, replace_file, to_stdout};
use super::super::progress::Bar;
use crate::report::survey::{Error, Sheet, SheetError, Survey, Surveys};
use rayon::prelude::*;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Where files go, and what is shown meanwhile.
pub(super) struct Desk {
    pub(super) out: PathBuf,
    pub(super) quiet: bool,
}

impl Desk {
    /// Measures what is not there yet, and draws all.
    pub(super) fn run(&self, surveys: &Surveys) -> Result<Exit, Failure> {
        fs::create_dir_all(&self.out).map_err(|error| {
            let message = format!("{} cannot be made: {error}", self.out.display());
            Failure::input(&message, Some("name a folder that can be written to"))
        })?;
        let mut sheets = vec![];
        for survey in &surveys.all {
            let survey = survey.as_ref();
            let empty = surveys.sheet(survey);
            let (sheet, said) = match self.finished(survey, &empty) {
                Some(sheet) => (sheet, "there already, drawn again"),
                None => (self.measured(survey, empty)?, "made"),
            };
            let name = survey.name();
            for picture in surveys.draw(survey, &sheet).map_err(not_ours)? {
                replace_file(&self.file(&format!("{}.svg", picture.name)), &picture.svg)?;
            }
            sheets.push(sheet);
            to_stdout(&format!("{name}: {said}\n"))?;
        }
        let page = format!("{}.md", surveys.group);
        let words = surveys.page(&sheets).map_err(not_ours)?;
        replace_file(&self.file(&page), &words)?;
        to_stdout(&format!("{page}: made\n"))?;
        Ok(Exit::AsExpected)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.out.join(name)
    }

    /// The sheet, if it is there and was made by this command on this machine.
    fn finished(&self, survey: &dyn Survey, empty: &Sheet) -> Option<Sheet> {
        let text = fs::read_to_string(self.file(&format!("{}.csv", survey.name()))).ok()?;
        let sheet: Sheet = text.parse().ok()?;
        // One that another version of the program, or another hand, made of it is measured again.
        let good = sheet.is_of(empty) && survey.is_whole(&sheet) && survey.pictures(&sheet).is_ok();
        good.then_some(sheet)
    }

    fn measured(&self, survey: &dyn Survey, empty: Sheet) -> Result<Sheet, Failure> {
        let path = self.file(&format!("{}.csv.part", survey.name()));
        let (mut sheet, done) = begun(&path, &empty, survey.units()).unwrap_or((empty, 0));
        let mut journal = Journal::new(path, &sheet, done)?;
        let bar = Bar::new(
            survey.units(),
            &format!("parts of {}", survey.name()),
            self.quiet,
        );
        let at_once = match survey.side_by_side() {
            true => 2 * rayon::current_num_threads(),
            false => 1,
        };
        let mut first = done;
        while first < survey.units() {
            bar.show(first);
            let last = survey.units().min(first + at_once);
            let parts: Vec<_> = (first..last)
                .into_par_iter()
                .map(|unit| survey.measure(unit))
                .collect();
            let before = sheet.rows().len();
            for part in parts {
                sheet.add(part.map_err(|error| not_measured(&error))?);
            }
            journal.add(&sheet.part(before, last))?;
            first = last;
        }
        bar.clear();
        replace_file(
            &self.file(&format!("{}.csv", survey.name())),
            &sheet.to_string(),
        )?;
        journal.done();
        Ok(sheet)
    }
}

/// What an earlier run of the same command left.
fn begun(path: &Path, empty: &Sheet, units: usize) -> Option<(Sheet, usize)> {
    let text = fs::read_to_string(path).ok()?;
    let (sheet, done) = Sheet::unfinished(&text).ok()?;
    (sheet.is_of(empty) && done <= units).then_some((sheet, done))
}

/// An unfinished file.
struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Written anew with what is there, so that nothing half written stays.
    fn new(path: PathBuf, sheet: &Sheet, done: usize) -> Result<Journal, Failure> {
        replace_file(&path, &(sheet.head() + &sheet.part(0, done)))?;
        let file = OpenOptions::new().append(true).open(&path);
        let file = file.map_err(|error| unwritable(&path, &error))?;
        Ok(Journal { path, file })
    }

    fn add(&mut self, text: &str) -> Result<(), Failure> {
        let written = self.file.write_all(text.as_bytes());
        written.map_err(|error| unwritable(&self.path, &error))
    }

    fn done(self) {
        // Left behind, it would be found finished by a later run, and no harm done.
        let _ = fs::remove_file(self.path);
    }
}

fn unwritable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::input(
        &format!("{} cannot be written: {error}", path.display()),
        None,
    )
}

fn not_measured(error: &Error) -> Failure {
    internal(&error.to_string())
}

/// A sheet that was just measured, or looked at, can be drawn.
fn not_ours(error: SheetError) -> Failure {
    internal(&error.to_string())
}
