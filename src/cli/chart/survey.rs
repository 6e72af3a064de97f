//! Measures surveys, unit by unit, and writes their files.
//!
//! While a survey is measured its rows are in `NAME.csv.part`: what a run that was killed had finished is there, and the next one goes on
//! from it. The picture is drawn, and the page of words written, from the finished `NAME.csv`.

use super::super::output::{Exit, Failure, internal, replace_file, to_stdout};
use super::super::progress::Bar;
use super::{found, make_folder, not_ours};
use crate::report::survey::{Sheet, Survey, Surveys};
use rayon::prelude::*;
use std::fmt::Display;
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
        make_folder(&self.out)?;
        let all = surveys.all.iter().map(AsRef::as_ref);
        let begun = all.clone().map(|survey| self.begun(surveys, survey));
        let begun = begun.collect::<Result<Vec<_>, _>>()?;
        let mut sheets = vec![];
        for (survey, (sheet, done)) in all.zip(begun) {
            let sheet = self.measured(survey, sheet, done)?;
            let sheet = surveys.complete(survey, sheet).map_err(faulty)?;
            let data = self.data(survey);
            replace_file(&data, &sheet.to_string())?;
            // Left behind, it would be found finished by a later run, and no harm done.
            let _ = fs::remove_file(part(&data));
            for (name, chart) in surveys.pictures(survey, &sheet).map_err(faulty)? {
                self.draw(&format!("{name}.svg"), &chart.to_svg())?;
            }
            sheets.push(sheet);
            let said = match done == survey.units() {
                true => "there already, drawn again",
                false => "made",
            };
            to_stdout(&format!("{}: {said}\n", survey.name()))?;
        }
        let page = format!("{}.md", surveys.group);
        let words = surveys.page(&sheets).map_err(faulty)?;
        self.draw(&page, &words)?;
        to_stdout(&format!("{page}: made\n"))?;
        Ok(Exit::AsExpected)
    }

    /// Writes what is drawn from the data: in the place of what such a command drew, and of nothing else.
    fn draw(&self, name: &str, text: &str) -> Result<(), Failure> {
        let path = self.out.join(name);
        match found(&path)? {
            Some(old) if !old.contains("claimcheck chart ") => Err(not_ours(&path)),
            _ => replace_file(&path, text),
        }
    }

    fn data(&self, survey: &dyn Survey) -> PathBuf {
        self.out.join(format!("{}.csv", survey.name()))
    }

    /// What earlier runs of the same command left, and how many units those are: the finished file, or an unfinished one.
    fn begun(&self, surveys: &Surveys, survey: &dyn Survey) -> Result<(Sheet, usize), Failure> {
        let mut most = (surveys.sheet(survey), 0);
        let data = self.data(survey);
        for path in [&data, &part(&data)] {
            let Some(text) = found(path)? else {
                continue;
            };
            let sheet = Sheet::beginning(&text).ok();
            let sheet = sheet.filter(|sheet| surveys.owns(survey, sheet));
            let sheet = sheet.ok_or_else(|| not_ours(path))?;
            let whole = surveys.whole(survey, &sheet);
            if whole.1 > most.1 {
                most = whole;
            }
        }
        Ok(most)
    }

    /// The rows of all units, of which some are done.
    fn measured(
        &self,
        survey: &dyn Survey,
        mut sheet: Sheet,
        done: usize,
    ) -> Result<Sheet, Failure> {
        if done == survey.units() {
            return Ok(sheet);
        }
        let mut journal = Journal::new(part(&self.data(survey)), &sheet)?;
        let things = format!("parts of {}", survey.name());
        let bar = Bar::new(survey.units(), &things, self.quiet);
        let at_once = match survey.side_by_side() {
            true => rayon::current_num_threads(),
            false => 1,
        };
        let mut first = done;
        while first < survey.units() {
            bar.show(first);
            let last = survey.units().min(first + at_once);
            let units = (first..last).into_par_iter();
            let parts: Vec<_> = units.map(|unit| survey.rows(unit)).collect();
            let before = sheet.rows().len();
            for part in parts {
                sheet.add(part.map_err(faulty)?);
            }
            journal.add(&sheet.lines(before))?;
            first = last;
        }
        bar.clear();
        Ok(sheet)
    }
}

/// Where a survey's rows are until it is finished.
fn part(path: &Path) -> PathBuf {
    path.with_added_extension("part")
}

/// An unfinished file.
struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Written anew with what is there, so that nothing half written stays.
    fn new(path: PathBuf, sheet: &Sheet) -> Result<Journal, Failure> {
        replace_file(&path, &sheet.to_string())?;
        let file = OpenOptions::new().append(true).open(&path);
        let file = file.map_err(|error| unwritable(&path, &error))?;
        Ok(Journal { path, file })
    }

    fn add(&mut self, text: &str) -> Result<(), Failure> {
        let written = self.file.write_all(text.as_bytes());
        written.map_err(|error| unwritable(&self.path, &error))
    }
}

fn unwritable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::input(
        &format!("{} cannot be written: {error}", path.display()),
        None,
    )
}

/// What is measured has a truth, and what was just measured can be drawn.
fn faulty(error: impl Display) -> Failure {
    internal(&error.to_string())
}
