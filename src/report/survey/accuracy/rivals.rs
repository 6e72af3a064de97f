//! Figures of other programs, from a file.

use super::super::{Sheet, SheetError};
use crate::measure::accuracy::Question;
use std::str::FromStr;

/// Ways of other programs begin so: those of this one have names for themselves.
pub(super) const RIVAL: &str = "rival: ";

/// Figures of other programs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rivals {
    /// Of the machine that they were measured on, and so on.
    notes: Vec<String>,
    rows: Vec<Rival>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Rival {
    quantity: String,
    k: u64,
    asked: u32,
    /// Way, digits, seconds: as they stand in the survey.
    cells: [String; 3],
}

impl FromStr for Rivals {
    type Err = SheetError;

    /// The CSV file that `benches/rivals/run.py --figures` writes.
    fn from_str(text: &str) -> Result<Rivals, SheetError> {
        let sheet: Sheet = text.parse()?;
        let words = |name| sheet.column(name, |cell| Some(cell.to_owned()));
        let (tool, version, quantity) = (words("tool")?, words("version")?, words("quantity")?);
        let k = sheet.column("k", |cell| cell.parse().ok())?;
        let asked = sheet.column("digits asked", |cell| cell.parse().ok())?;
        let right = sheet.column("digits right", |cell| number(cell, 0.0))?;
        let seconds = sheet.column("seconds", |cell| number(cell, f64::MIN_POSITIVE))?;
        let row = |i: usize| Rival {
            quantity: quantity[i].clone(),
            k: k[i],
            asked: asked[i],
            cells: [
                name(&tool[i], &version[i]),
                right[i].clone(),
                seconds[i].clone(),
            ],
        };
        Ok(Rivals {
            notes: sheet.notes().to_vec(),
            rows: (0..tool.len()).map(row).collect(),
        })
    }
}

/// A finite number not below the least, as it is written.
fn number(cell: &str, least: f64) -> Option<String> {
    let value: f64 = cell.parse().ok()?;
    (value.is_finite() && value >= least).then(|| cell.to_owned())
}

/// A tool with its version, without what it stands on.
fn name(tool: &str, version: &str) -> String {
    let own = version.split(" + ").next().unwrap_or_default();
    let words = format!("{RIVAL}{tool} {own}");
    // A bar would end a cell in a table of Markdown, a bracket begin markup.
    words.trim().replace('|', "/").replace(['<', '>'], " ")
}

impl Rivals {
    pub(super) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// What a reader must know of them; nothing without any.
    pub(super) fn notes(&self) -> Vec<String> {
        if self.is_empty() {
            return vec![];
        }
        let words = "Right: other programs, asked for the same digits; across, the digits that were right, at 1 if none was. The FLINTs prove them, the others do \
             not. Their times";
        vec![format!("{words}: {}.", self.notes.join("; "))]
    }

    /// The rows of a survey at one question.
    pub(super) fn rows(
        &self,
        question: Question,
        quantity: &str,
    ) -> impl Iterator<Item = Vec<String>> {
        let own = move |rival: &&Rival| {
            (&*rival.quantity, rival.k, rival.asked) == (quantity, question.k, question.digits)
        };
        self.rows.iter().filter(own).map(|rival| {
            let place = [rival.k.to_string(), rival.asked.to_string()];
            place.into_iter().chain(rival.cells.clone()).collect()
        })
    }
}
