//! Rows with a heading: a CSV file whose first lines, after `#`, say what it is.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

/// Tells in an unfinished file how many units are whole.
const DONE: &str = "# done ";

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

    /// Whether two sheets differ in their rows at most.
    pub fn is_of(&self, other: &Sheet) -> bool {
        self.notes == other.notes && self.columns == other.columns
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

    /// The lines before the rows.
    pub fn head(&self) -> String {
        let notes = self.notes.iter().map(|note| format!("# {note}\n"));
        notes.collect::<String>() + &self.columns.join(",") + "\n"
    }

    /// What a unit adds to an unfinished file: its rows, and that so many units are done.
    pub fn part(&self, from: usize, done: usize) -> String {
        let rows = self.rows.get(from..).unwrap_or_default();
        lines(rows) + &format!("{DONE}{done}\n")
    }

    /// Reads an unfinished file: the rows of whole units, and how many those are.
    ///
    /// # Errors
    /// [`SheetError`]
    pub fn unfinished(text: &str) -> Result<(Sheet, usize), SheetError> {
        let whole = text.rfind(DONE).map(|at| {
            let line = text[at..].split_inclusive('\n').next().unwrap_or_default();
            let done = line.strip_prefix(DONE).and_then(|n| n.strip_suffix('\n'));
            (at, done.and_then(|n| n.parse::<usize>().ok()))
        });
        match whole {
            None => Ok((text.parse()?, 0)).map(|(sheet, done): (Sheet, usize)| {
                let rows = vec![];
                (Sheet { rows, ..sheet }, done)
            }),
            Some((at, Some(done))) => Ok((text[..at].parse()?, done)),
            // The last line of all is cut off: what is before it counts.
            Some((at, None)) => Sheet::unfinished(&text[..at]),
        }
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

    /// A column of numbers.
    ///
    /// # Errors
    /// As [`Sheet::column`].
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, SheetError> {
        self.column(name, |cell| cell.parse().ok())
    }

    /// A column of numbers, some of them missing.
    ///
    /// # Errors
    /// As [`Sheet::column`].
    pub fn some_numbers(&self, name: &str) -> Result<Vec<Option<f64>>, SheetError> {
        self.column(name, |cell| match cell {
            "" => Some(None),
            cell => cell.parse().ok().map(Some),
        })
    }
}

impl Display for Sheet {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.head())?;
        f.write_str(&lines(&self.rows))
    }
}

impl FromStr for Sheet {
    type Err = SheetError;

    fn from_str(text: &str) -> Result<Sheet, SheetError> {
        let (notes, rows): (Vec<&str>, Vec<&str>) =
            text.lines().partition(|line| line.starts_with('#'));
        let notes = notes.iter().filter(|line| !line.starts_with(DONE));
        let notes = notes.map(|line| line[1..].trim().to_owned()).collect();
        let cells = |line: &&str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let mut rows = rows.iter().map(cells);
        let columns = rows.next().ok_or(SheetError::NoHeading)?;
        let rows: Vec<Vec<String>> = rows.collect();
        match rows.iter().position(|row| row.len() != columns.len()) {
            Some(index) => Err(SheetError::Ragged {
                row: index + 1,
                cells: rows[index].len(),
                columns: columns.len(),
            }),
            None => Ok(Sheet {
                notes,
                columns,
                rows,
            }),
        }
    }
}

fn lines(rows: &[Vec<String>]) -> String {
    rows.iter().map(|row| row.join(",") + "\n").collect()
}

fn cleaned(cell: &str) -> String {
    cell.replace(',', ";").replace(['"', '\n', '\r'], " ")
}
