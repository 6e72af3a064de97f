//! The maps of where formulas in doubles fail.

use super::super::chart::{Axis, Cells, Chart, Key, Marks, Panel, Scale, Series, Shade, Texture};
use super::super::figures::Pace;
use super::choice::Choice;
use super::simulation::Runs;
use super::{Error, Sheet, SheetError, Survey, Surveys, median};
use crate::measure::plain::{MOST_STEPS, Recipe};
use crate::measure::stability::{Cell, FINE, Grid, Map, Plane, maps};
use crate::special::shell::Quantity;
use std::collections::BTreeSet;
use std::fmt::Write;

const FAILURES: [Cell; 5] = [
    Cell::Wrong,
    Cell::Overflow,
    Cell::Divergence,
    Cell::Cost,
    Cell::Refusal,
];

/// Digits lost, where one shade ends and the next begins.
const SHADES: [u8; 10] = [0, 1, 2, 4, 6, 8, 10, 12, 14, 16];

/// The surveys of `claimcheck chart stability`: the maps, the method that the choice takes, and simulation.
pub fn stability(pace: Pace) -> Surveys {
    let grid = match pace {
        Pace::Full => Grid::FULL,
        Pace::Quick => Grid::QUICK,
    };
    let maps = maps()
        .into_iter()
        .map(|map| Box::new(Failures { map, grid }) as Box<dyn Survey>);
    let others: [Box<dyn Survey>; 2] = [Box::new(Choice::new(grid)), Box::new(Runs { pace })];
    Surveys {
        group: "stability",
        heading: "Where methods fail",
        pace,
        options: String::new(),
        all: maps.chain(others).collect(),
    }
}

/// A map of digits lost.
struct Failures {
    map: Map,
    grid: Grid,
}

/// E - 1 and so on, as in a panel's title.
pub(super) fn quantity_words(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Function => "F",
        Quantity::Mean => "E",
        Quantity::Excess => "E \u{2212} 1",
        Quantity::Variance => "Var",
    }
}

/// The axes of a plane.
pub(super) fn axes(plane: Plane) -> [Axis; 2] {
    let axis = |label: &str, scale| Axis {
        label: label.to_owned(),
        scale,
    };
    match plane {
        Plane::Photons => [axis("photon k", Scale::Log), axis("l/m", Scale::Linear)],
        Plane::Arguments => [
            axis("\u{2212}z = V/Va", Scale::Log),
            axis("photons m", Scale::Log),
        ],
    }
}

/// The names of the columns that tell a place.
fn place_columns(plane: Plane) -> [&'static str; 2] {
    match plane {
        Plane::Photons => ["k", "l/m"],
        Plane::Arguments => ["-z", "m"],
    }
}

fn column_name((quantity, recipe): (Quantity, Recipe)) -> String {
    let quantity = quantity_words(quantity).replace('\u{2212}', "-");
    format!("{quantity}: {}", recipe.name())
}

fn panel_title((quantity, recipe): (Quantity, Recipe)) -> String {
    format!("{}: {}", quantity_words(quantity), recipe.name())
}

fn shade(cell: Cell) -> Shade {
    match cell {
        Cell::Lost(tenths) => {
            let above = SHADES[1..9].iter().filter(|edge| tenths >= 10 * **edge);
            Shade::Level(above.count() as u8)
        }
        Cell::Refusal => Shade::None,
        Cell::Cost => Shade::Texture(Texture::Dots),
        Cell::Divergence => Shade::Texture(Texture::Rising),
        Cell::Overflow => Shade::Texture(Texture::Vertical),
        Cell::Wrong => Shade::Solid,
    }
}

/// All shades of digits, and what else is in the panels.
fn key(panels: &[Panel]) -> Vec<Key> {
    let entry = |name: &str, shade| Key {
        name: name.to_owned(),
        shade,
    };
    let levels = SHADES.windows(2).zip(0..).map(|(ends, level)| {
        let name = format!("{}\u{2013}{}", ends[0], ends[1]);
        entry(&name, Shade::Level(level))
    });
    let others = [
        ("wrong: no digit right", Cell::Wrong),
        ("overflow", Cell::Overflow),
        ("given up: terms grow", Cell::Divergence),
        ("given up: over 10,000 steps", Cell::Cost),
        ("refused: outside its domain", Cell::Refusal),
    ];
    let others = others.map(|(name, cell)| entry(name, shade(cell)));
    let seen = |key: &Key| panels.iter().any(|panel| shows(panel, key.shade));
    levels.chain(others.into_iter().filter(seen)).collect()
}

/// Whether a cell of the panel has this shade.
pub(super) fn shows(panel: &Panel, shade: Shade) -> bool {
    panel.series.iter().any(|series| match &series.marks {
        Marks::Cells(cells) => cells.cells.contains(&shade),
        _ => false,
    })
}

impl Failures {
    fn is_of_function(&self) -> bool {
        matches!(self.map.panels.first(), Some((Quantity::Function, _)))
    }

    fn cells(&self, sheet: &Sheet, panel: (Quantity, Recipe)) -> Result<Vec<Cell>, SheetError> {
        sheet.column(&column_name(panel), |cell| cell.parse().ok())
    }

    /// A row each panel, a column each decade along x.
    fn by_decades(&self, sheet: &Sheet) -> Result<String, SheetError> {
        let [along, _] = place_columns(self.map.plane);
        let decade = |x: &f64| x.log10().floor() as i32;
        let decades: Vec<i32> = sheet.numbers(along)?.iter().map(decade).collect();
        let all: BTreeSet<i32> = decades.iter().copied().collect();
        let heads = all
            .iter()
            .map(|at| format!("{}\u{2013}{}", power(*at), power(at + 1)));
        let mut text = format!(
            "| {along} | {} |\n|---|{}\n",
            heads.collect::<Vec<_>>().join(" | "),
            "---|".repeat(all.len())
        );
        for &panel in &self.map.panels {
            let cells = self.cells(sheet, panel)?;
            let cell = |at: &i32| {
                let own = decades
                    .iter()
                    .zip(&cells)
                    .filter(|(decade, _)| *decade == at);
                let own: Vec<Cell> = own.map(|(_, cell)| *cell).collect();
                typical(&own)
            };
            let row: Vec<String> = all.iter().map(cell).collect();
            let _ = writeln!(text, "| {} | {} |", panel_title(panel), row.join(" | "));
        }
        Ok(text)
    }

    /// What is to be seen, and why it is so: nothing that depends on a number measured.
    fn lesson(&self) -> &'static str {
        match (self.map.plane, self.is_of_function()) {
            (Plane::Photons, true) => {
                "From left to right k grows, and with it the shell: the shells grow thin, Va becomes much larger than V. From bottom to top one goes from the first \
                 photon of a shell to its last. Both series, the moments and Euler's integral are good everywhere but for the power series in the first \
                 shell shown, where z = -1 and its terms crawl. The relation from an end of the shell loses digits on its way to the middle, until no number is left, and wins \
                 them back towards the other end; from the middle it loses none, but walks of more than 10,000 steps are not made. In the closed form a and b ln(1 + V/Va) \
                 cancel to more digits than a double has; then they overflow."
            }
            (Plane::Photons, false) => {
                "The same plane, for what the thesis is after. Its formula takes the correctly rounded F, the best that any F in doubles can be, and still loses the digits of \
                 k in E - 1 and twice as many in Var, since 2.102 and 2.104 cancel. From Pfaff's series for x = mean((Va+V)/U) - 1 less is lost: half the digits of k in E - 1 in \
                 mid-shell, more towards its first photon, where (l-V)/A + (k/A) x cancels, A = Va+V; and one and a half times the digits of k in Var. The central moments, and \
                 the certified doubles, which rest on them, lose nothing that grows with k."
            }
            (Plane::Arguments, true) => {
                "From left to right the shell grows thick: at the left z is near 0, at the right V is much larger than Va. From bottom to top it holds more photons. The power \
                 series has its border at z = -1, but for many photons its first terms fall so fast that it ends before they grow. Pfaff's series converges everywhere, \
                 more and more slowly to the right. The terms of the moments grow where the shell is thick and holds few photons, less so \
                 where m is odd and the photon in the very middle, so that every second term vanishes: hence the stripes. The closed form is good for few photons, and \
                 where the shell is thick. Euler's integral is good everywhere, by a rule that follows the peak of its integrand."
            }
            (Plane::Arguments, false) => {
                "E - 1 and Var over the same plane. The thesis's formulas lose more the more photons a shell holds; 2.102 also the thinner the shell is, and 2.104 both where it is \
                 thin and where it is thick. The moments do not cancel; their terms grow where the shell is thick and holds few photons."
            }
        }
    }
}

impl Survey for Failures {
    fn name(&self) -> String {
        format!("stability-{}", self.map.name)
    }

    fn title(&self) -> String {
        let what = match self.is_of_function() {
            true => "F = 2F1(1, l; m+1; \u{2212}V/Va) loses",
            false => "E \u{2212} 1 and Var of k/U lose",
        };
        let plane = match self.map.plane {
            Plane::Photons => "over the photons of strategy 2",
            Plane::Arguments => "over z and m, in the middle of a shell",
        };
        format!("Digits that {what} in doubles, {plane}")
    }

    fn notes(&self, sheet: &Sheet) -> Result<Vec<String>, SheetError> {
        let scenes = FINE * FINE;
        let plane = match self.map.plane {
            Plane::Photons => "Photon k is the l-th of the m in its shell, V = m, Va = m(m-1)/2.",
            Plane::Arguments => {
                "One shell with V = m around Va = -m/z, l = m/2 rounded up (so odd and even m differ); dotted line: the shells of strategy 2."
            }
        };
        let mut steps = String::new();
        for &panel in &self.map.panels {
            if self.cells(sheet, panel)?.contains(&Cell::Cost) {
                steps = format!(
                    " Over {MOST_STEPS} steps is our limit: the formula may be right, but slow."
                );
            }
        }
        Ok(vec![format!(
            "Each formula is computed in IEEE doubles. A cell is the worst of {scenes} inputs (Va, V, l, m); digits are lost against the correctly rounded double, which has \
             15.95, and the truth is an enclosure. {plane}{steps}"
        )])
    }

    fn columns(&self) -> Vec<String> {
        let places = place_columns(self.map.plane).map(str::to_owned);
        let panels = self.map.panels.iter().copied().map(column_name);
        places.into_iter().chain(panels).collect()
    }

    fn units(&self) -> usize {
        self.grid.columns as usize
    }

    fn places(&self, unit: usize) -> Vec<Vec<String>> {
        let place = |row: u32| {
            let (along, upwards) = self.grid.middle(unit as u32, row);
            let [x, y] = self.map.plane.at(along, upwards);
            vec![format!("{x:.5e}"), format!("{y:.4}")]
        };
        (0..self.grid.rows).map(place).collect()
    }

    fn side_by_side(&self) -> bool {
        true
    }

    fn measure(&self, unit: usize) -> Result<Vec<Vec<String>>, Error> {
        let rows = self.map.column(self.grid, unit as u32)?;
        let texts = |cells: &Vec<Cell>| cells.iter().map(ToString::to_string).collect();
        Ok(rows.iter().map(texts).collect())
    }

    fn pictures(&self, sheet: &Sheet) -> Result<Vec<(&'static str, Chart)>, SheetError> {
        let panels = self.map.panels.iter().map(|&panel| {
            let cells = self.cells(sheet, panel)?;
            let shades: Vec<Shade> = cells.into_iter().map(shade).collect();
            let sides = (axes(self.map.plane), self.map.plane.ends());
            let mut drawn = cells_panel(panel_title(panel), sides, &shades, self.grid);
            drawn.series.extend(strategy_2(self.map.plane));
            Ok(drawn)
        });
        let panels = panels.collect::<Result<Vec<_>, SheetError>>()?;
        let chart = Chart {
            columns: match self.is_of_function() {
                true => 3,
                // E - 1 beside Var.
                false => 2,
            },
            key: key(&panels),
            levels: "digits lost".to_owned(),
            ..Chart::default()
        };
        Ok(vec![("", Chart { panels, ..chart })])
    }

    fn words(&self, sheet: &Sheet) -> Result<String, SheetError> {
        let mut text = format!(
            "{}\n\nThe lighter, the better. A black cell holds a number without one right digit, given without a warning; where there are lines or dots there is no number.\n\n\
             | formula in doubles | digits lost where one is right: median, most | wrong, % of cells | overflow | diverges | steps | refused |\n\
             |---|---|---|---|---|---|---|\n",
            self.lesson()
        );
        for &panel in &self.map.panels {
            let cells = self.cells(sheet, panel)?;
            let _ = writeln!(text, "| {} | {}", panel_title(panel), tally(&cells));
        }
        text += "\nBy decades: the median of the digits lost where at least half of the cells have a right digit, else the most common failure \
             and its share of the cells.\n\n";
        text += &self.by_decades(sheet)?;
        Ok(text)
    }
}

/// Cells as a panel between two axes with their ends: they are given column by column, from the bottom.
pub(super) fn cells_panel(
    title: String,
    ([x, y], [across, upwards]): ([Axis; 2], [[f64; 2]; 2]),
    columns: &[Shade],
    grid: Grid,
) -> Panel {
    Panel {
        title,
        x,
        y,
        series: vec![Series {
            name: String::new(),
            look: 0,
            marks: Marks::Cells(Cells {
                x: across,
                y: upwards,
                columns: grid.columns as usize,
                cells: by_rows(columns, grid),
            }),
        }],
    }
}

/// Where the shells of strategy 2 lie among all z and m: -z = 2/(m-1).
fn strategy_2(plane: Plane) -> Option<Series> {
    let m = |step: i32| 10f64.powf(f64::from(step) / 20.0) + 1.0;
    let points = (0..70).map(|step| [2.0 / (m(step) - 1.0), m(step)]);
    (plane == Plane::Arguments).then(|| Series {
        name: "shells of strategy 2".to_owned(),
        marks: Marks::Line(points.collect()),
        look: 2,
    })
}

/// Cells row by row from those column by column.
fn by_rows(columns: &[Shade], grid: Grid) -> Vec<Shade> {
    let (across, up) = (grid.columns as usize, grid.rows as usize);
    let at = |row: usize, column: usize| columns.get(column * up + row).copied();
    (0..up)
        .flat_map(|row| (0..across).map(move |column| at(row, column).unwrap_or(Shade::None)))
        .collect()
}

/// Median and most digits lost, and the percentages of what is no number or a wrong one.
fn tally(cells: &[Cell]) -> String {
    let most = cells.iter().filter(|cell| is_lost(cell)).max();
    let digits = match (typical_loss(cells), most) {
        (Some(median), Some(most)) => format!("{median}, {most}"),
        _ => "none".to_owned(),
    };
    let share = |of: Cell| {
        let count = cells.iter().filter(|cell| **cell == of).count();
        percent(count, cells.len())
    };
    let shares = FAILURES.map(share);
    format!("{digits} | {} |", shares.join(" | "))
}

fn is_lost(cell: &Cell) -> bool {
    matches!(cell, Cell::Lost(_))
}

/// The median of the digits lost where one is right.
fn typical_loss(cells: &[Cell]) -> Option<Cell> {
    let tenths = cells.iter().filter_map(|cell| match cell {
        Cell::Lost(tenths) => Some(f64::from(*tenths)),
        _ => None,
    });
    median(tenths.collect()).map(|tenths| Cell::Lost(tenths.ceil() as u8))
}

/// 0 where there is none, and never 0 or 100 where there is one, or not all are.
pub(super) fn percent(count: usize, all: usize) -> String {
    match 100.0 * count as f64 / all.max(1) as f64 {
        _ if count == 0 => "0".to_owned(),
        _ if count == all => "100".to_owned(),
        share if share < 0.05 => "< 0.1".to_owned(),
        share if share > 99.95 => "> 99.9".to_owned(),
        share => format!("{share:.1}"),
    }
}

fn power(exponent: i32) -> String {
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        exponent => format!("10^{exponent}"),
    }
}

/// The median of the digits lost where at least half of the cells have a right digit; else the most common failure with its share.
fn typical(cells: &[Cell]) -> String {
    let right = cells.iter().filter(|cell| is_lost(cell)).count();
    if let Some(median) = typical_loss(cells)
        && 2 * right >= cells.len()
    {
        return median.to_string();
    }
    let count = |of: Cell| cells.iter().filter(|cell| **cell == of).count();
    let most = FAILURES.into_iter().max_by_key(|failure| count(*failure));
    most.map_or(String::new(), |failure| {
        format!("{failure} {} %", percent(count(failure), cells.len()))
    })
}
