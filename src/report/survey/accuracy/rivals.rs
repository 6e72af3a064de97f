//! Figures of other programs, from a file.

use super::super::{Sheet, SheetError};
use crate::measure::accuracy::Question;
use std::collections::HashSet;
use std::ops::RangeInclusive;

/// Ways of other programs begin so: those of this one have names for themselves.
pub(super) const RIVAL: &str = "rival: ";

/// This program in the same run as the others, which they are measured by.
pub(super) const OURS: &str = "rival: claimcheck ";

/// Figures of other programs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rivals {
    /// The name of their file.
    name: String,
    /// Of the machine that they were measured on, and so on.
    notes: Vec<String>,
    rows: Vec<Rival>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Rival {
    quantity: String,
    k: u64,
    asked: u32,
    way: String,
    /// Digits and seconds, as they stand in the file.
    cells: [String; 2],
}

impl Rivals {
    /// Reads the CSV file that `benches/rivals/run.py --figures` writes.
    ///
    /// # Errors
    /// [`SheetError`]: no columns of that name, cells that cannot be read, a tool without a name, the same figure twice.
    pub fn read(name: &str, text: &str) -> Result<Rivals, SheetError> {
        let sheet: Sheet = text.parse()?;
        let words = |name| sheet.column(name, |cell| Some(cell.to_owned()));
        let named = |cell: &str| (!cell.trim().is_empty()).then(|| cell.to_owned());
        let (tool, version) = (sheet.column("tool", named)?, words("version")?);
        let quantity = words("quantity")?;
        let k = sheet.column("k", |cell| cell.parse().ok())?;
        let asked = sheet.column("digits asked", |cell| cell.parse().ok())?;
        let right = sheet.column("digits right", |cell| number(cell, 0.0..=1e9))?;
        let seconds = sheet.column("seconds", |cell| number(cell, 1e-12..=1e9))?;
        let row = |i: usize| Rival {
            quantity: quantity[i].clone(),
            k: k[i],
            asked: asked[i],
            way: way(&tool[i], &version[i]),
            cells: [right[i].clone(), seconds[i].clone()],
        };
        let rows: Vec<Rival> = (0..tool.len()).map(row).collect();
        let mut seen = HashSet::new();
        let of = |row: &Rival| (row.quantity.clone(), row.k, row.asked, row.way.clone());
        match rows.iter().position(|row| !seen.insert(of(row))) {
            Some(index) => Err(SheetError::Twice { row: index + 1 }),
            None => Ok(Rivals {
                name: name.to_owned(),
                notes: sheet.notes().to_vec(),
                rows,
            }),
        }
    }

    /// As it stands in the command; nothing without any.
    pub(super) fn option(&self) -> String {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
        match &*self.name {
            "" => String::new(),
            name if name.chars().all(is_plain) => format!(" --rivals {name}"),
            _ => " --rivals FILE".to_owned(),
        }
    }

    /// What a reader must know of them.
    pub(super) fn note(&self) -> String {
        let words = "Right: other programs, asked for the same digits; across, the digits that were right, at 1 if none was. claimcheck and the FLINTs prove them, \
             the others do not. All of them in one run";
        format!("{words}: {}.", self.notes.join("; "))
    }

    /// The rows of a survey at one question.
    pub(super) fn rows(&self, question: Question, quantity: &str) -> Vec<Vec<String>> {
        let own = |rival: &&Rival| {
            (&*rival.quantity, rival.k, rival.asked) == (quantity, question.k, question.digits)
        };
        let row = |rival: &Rival| {
            let place = [rival.k.to_string(), rival.asked.to_string()];
            let way = [rival.way.clone()];
            [place.as_slice(), &way, &rival.cells].concat()
        };
        self.rows.iter().filter(own).map(row).collect()
    }
}

/// A number of a range, as it is written.
fn number(cell: &str, range: RangeInclusive<f64>) -> Option<String> {
    let value: f64 = cell.parse().ok()?;
    range.contains(&value).then(|| cell.to_owned())
}

/// A tool with its version, without what it stands on.
fn way(tool: &str, version: &str) -> String {
    let own = version.split(" + ").next().unwrap_or_default();
    let words = format!("{RIVAL}{tool} {own}");
    // A bar would end a cell in a table of Markdown, a bracket begin markup.
    words.trim().replace('|', "/").replace(['<', '>'], " ")
}
