//! Rows with a heading: a CSV file whose first lines, after `#`, say what it is.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

/// A table of texts. No cell holds a comma, a quote or a line's end; where one would, the comma becomes a semicolon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    notes: Vec<String>,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// Why a file is no sheet, or not the one that was expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SheetError {
    /// There is no line with the names of the columns.
    #[error("no heading")]
    NoHeading,
    /// A row of another length.
    #[error("row {row} has {cells} cells where the heading has {columns}")]
    Ragged {
        row: usize,
        cells: usize,
        columns: usize,
    },
    /// A row that says what another one says.
    #[error("row {row} has the same tool, quantity, k and digits as one before")]
    Twice { row: usize },
    /// A column that is not there.
    #[error("no column `{0}`")]
    NoColumn(String),
    /// A cell that cannot be read.
    #[error("`{cell}` in the column `{column}`, row {row}, cannot be read")]
    Cell {
        row: usize,
        column: String,
        cell: String,
    },
}

impl Sheet {
    /// Without rows.
    pub fn new(notes: Vec<String>, columns: Vec<String>) -> Sheet {
        let clean = |texts: Vec<String>| texts.iter().map(|text| cleaned(text)).collect();
        Sheet {
            notes: notes
                .iter()
                .map(|note| note.replace(['\n', '\r'], " "))
                .collect(),
            columns: clean(columns),
            rows: vec![],
        }
    }

    /// What it is, by which command, on which machine.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The rows, each as long as the heading.
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    /// The names of the columns.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// With other notes.
    pub fn with_notes(self, notes: Vec<String>) -> Sheet {
        Sheet {
            rows: self.rows,
            ..Sheet::new(notes, self.columns)
        }
    }

    /// Adds rows; one that is too short is filled with empty cells, one too long is cut.
    pub fn add(&mut self, rows: Vec<Vec<String>>) {
        let width = self.columns.len();
        self.rows.extend(rows.into_iter().map(|row| {
            let mut row: Vec<String> = row.iter().map(|cell| cleaned(cell)).collect();
            row.resize(width, String::new());
            row
        }));
    }

    /// The rows from one on, as they stand in the file.
    pub fn lines(&self, from: usize) -> String {
        let rows = self.rows.get(from..).unwrap_or_default();
        rows.iter().map(|row| row.join(",") + "\n").collect()
    }

    /// Reads what is whole at the beginning of a file that was cut, or damaged further down: the rows before the first that has another length
    /// than the heading or does not end.
    ///
    /// # Errors
    /// Where there is no heading.
    pub fn beginning(text: &str) -> Result<Sheet, SheetError> {
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let mut sheet = read(whole)?;
        if let Some(index) = sheet.ragged() {
            sheet.rows.truncate(index);
        }
        Ok(sheet)
    }

    fn ragged(&self) -> Option<usize> {
        let width = self.columns.len();
        self.rows.iter().position(|row| row.len() != width)
    }

    /// The cells of a column, read.
    ///
    /// # Errors
    /// Where there is no such column, and where a cell cannot be read.
    pub fn column<T>(
        &self,
        name: &str,
        read: impl Fn(&str) -> Option<T>,
    ) -> Result<Vec<T>, SheetError> {
        let index = self
            .columns
            .iter()
            .position(|column| *column == cleaned(name));
        let index = index.ok_or_else(|| SheetError::NoColumn(name.to_owned()))?;
        let cell = |(number, row): (usize, &Vec<String>)| {
            read(&row[index]).ok_or_else(|| SheetError::Cell {
                row: number + 1,
                column: name.to_owned(),
                cell: row[index].clone(),
            })
        };
        self.rows.iter().enumerate().map(cell).collect()
    }

    /// A column of finite numbers.
    ///
    /// # Errors
    /// As [`Sheet::column`].
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, SheetError> {
        self.column(name, number)
    }

    /// A column of finite numbers, some of them missing.
    ///
    /// # Errors
    /// As [`Sheet::column`].
    pub fn some_numbers(&self, name: &str) -> Result<Vec<Option<f64>>, SheetError> {
        self.column(name, |cell| match cell {
            "" => Some(None),
            cell => number(cell).map(Some),
        })
    }
}

impl Display for Sheet {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for note in &self.notes {
            writeln!(f, "# {note}")?;
        }
        writeln!(f, "{}", self.columns.join(","))?;
        f.write_str(&self.lines(0))
    }
}

impl FromStr for Sheet {
    type Err = SheetError;

    fn from_str(text: &str) -> Result<Sheet, SheetError> {
        let sheet = read(text)?;
        match sheet.ragged() {
            Some(index) => Err(SheetError::Ragged {
                row: index + 1,
                cells: sheet.rows[index].len(),
                columns: sheet.columns.len(),
            }),
            None => Ok(sheet),
        }
    }
}

/// The notes, the heading, and rows of any length.
fn read(text: &str) -> Result<Sheet, SheetError> {
    // Some programs begin a file with a mark of its encoding.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    let (notes, rows): (Vec<&str>, Vec<&str>) = lines.partition(|line| line.starts_with('#'));
    let notes = notes.iter().map(|line| line[1..].trim().to_owned());
    let mut rows = rows
        .iter()
        .map(|line| line.split(',').map(str::to_owned).collect());
    Ok(Sheet {
        notes: notes.collect(),
        columns: rows.next().ok_or(SheetError::NoHeading)?,
        rows: rows.collect(),
    })
}

fn number(cell: &str) -> Option<f64> {
    cell.parse().ok().filter(|number: &f64| number.is_finite())
}

fn cleaned(cell: &str) -> String {
    cell.replace(',', ";").replace(['"', '\n', '\r'], " ")
}
