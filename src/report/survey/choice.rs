//! Which method the choice takes.

use super::super::chart::{Axis, Chart, Key, Scale, Shade};
use super::maps::{axes, cells_panel, percent, shows};
use super::{Error, Sheet, SheetError, Survey, method_words};
use crate::measure::stability::{Grid, Plane};
use crate::special::shell::{Method, Quantity, choose};
use std::fmt::Write;

/// Of the panel over k and digits: 10 to 100,000.
const DIGITS: [f64; 2] = [1.0, 5.0];

/// What is asked in a panel: of the scene in the middle of a cell.
#[derive(Clone, Copy)]
enum Asked {
    /// The variance of the photon in the middle of the shell of photon k, over k and digits.
    Digits,
    /// A quantity to so many digits over a plane.
    Over(Plane, Quantity, u32),
}

const PANELS: [(&str, Asked); 4] = [
    ("Var of a photon in mid-shell: by digits", Asked::Digits),
    (
        "Var to 2000 digits: by place in the shell",
        Asked::Over(Plane::Photons, Quantity::Variance, 2000),
    ),
    (
        "F to 15 digits: by z and m",
        Asked::Over(Plane::Arguments, Quantity::Function, 15),
    ),
    (
        "F to 1000 digits: by z and m",
        Asked::Over(Plane::Arguments, Quantity::Function, 1000),
    ),
];

/// The methods chosen over four planes.
pub(super) struct Choice {
    grid: Grid,
}

impl Choice {
    /// With half of the cells of a map along each side.
    pub(super) fn new(grid: Grid) -> Choice {
        Choice {
            grid: Grid {
                columns: grid.columns / 2,
                rows: grid.rows / 2,
            },
        }
    }
}

impl Asked {
    fn plane(self) -> Plane {
        match self {
            Asked::Digits => Plane::Photons,
            Asked::Over(plane, ..) => plane,
        }
    }

    /// The method; none where no method answers.
    fn method(self, along: f64, upwards: f64) -> Option<Method> {
        let (place, quantity, digits) = match self {
            Asked::Digits => (0.5, Quantity::Variance, digits(upwards).round() as u32),
            Asked::Over(_, quantity, digits) => (upwards, quantity, digits),
        };
        let shell = self.plane().scene(along, place).shell()?;
        let (method, _) = choose(quantity, &shell, digits).ok()?;
        Some(method)
    }

    fn axes(self) -> [Axis; 2] {
        let [x, y] = axes(self.plane());
        match self {
            Asked::Over(..) => [x, y],
            Asked::Digits => {
                let digits = Axis {
                    label: "digits asked for".to_owned(),
                    scale: Scale::Log,
                };
                [x, digits]
            }
        }
    }

    fn ends(self) -> [[f64; 2]; 2] {
        let [x, y] = self.plane().ends();
        match self {
            Asked::Over(..) => [x, y],
            Asked::Digits => [x, DIGITS.map(|power| 10f64.powf(power))],
        }
    }
}

fn digits(part: f64) -> f64 {
    10f64.powf(DIGITS[0] + part * (DIGITS[1] - DIGITS[0]))
}

fn name(method: Option<Method>) -> String {
    method.map_or("none".to_owned(), |m| format!("{m:?}").to_lowercase())
}

fn shade(cell: &str) -> Option<Shade> {
    if cell == "none" {
        return Some(Shade::None);
    }
    let index = Method::ALL
        .into_iter()
        .position(|method| name(Some(method)) == cell)?;
    Some(Shade::Kind(index as u8))
}

impl Survey for Choice {
    fn name(&self) -> String {
        "stability-choice".to_owned()
    }

    fn title(&self) -> String {
        "Which certified method is tried first".to_owned()
    }

    fn notes(&self, _: &Sheet) -> Result<Vec<String>, SheetError> {
        Ok(vec![
            "The method that is cheapest by estimates of its instructions, in the middle of each cell; another one is tried only where it does not reach the \
             digits. Steps and slivers: estimates jump where numbers need one machine word more. Above V = m, Va = m(m-1)/2; below V = m, Va = -m/z, l = m/2 rounded up."
                .to_owned(),
        ])
    }

    fn columns(&self) -> Vec<String> {
        let places = ["k", "digits", "l/m", "-z", "m"].into_iter();
        let panels = PANELS.into_iter().map(|(title, _)| title);
        places.chain(panels).map(str::to_owned).collect()
    }

    fn units(&self) -> usize {
        self.grid.columns as usize
    }

    fn places(&self, unit: usize) -> Vec<Vec<String>> {
        let place = |row: u32| {
            let (along, upwards) = self.grid.middle(unit as u32, row);
            let [k, place] = Plane::Photons.at(along, upwards);
            let [z, m] = Plane::Arguments.at(along, upwards);
            let values = [k, digits(upwards), place, z, m];
            values.map(|x| format!("{x:.4e}")).to_vec()
        };
        (0..self.grid.rows).map(place).collect()
    }

    fn side_by_side(&self) -> bool {
        true
    }

    fn measure(&self, unit: usize) -> Result<Vec<Vec<String>>, Error> {
        let methods = |row: u32| {
            let (along, upwards) = self.grid.middle(unit as u32, row);
            PANELS.map(|(_, asked)| name(asked.method(along, upwards)))
        };
        let rows = 0..self.grid.rows;
        Ok(rows.map(|row| methods(row).to_vec()).collect())
    }

    fn pictures(&self, sheet: &Sheet) -> Result<Vec<(&'static str, Chart)>, SheetError> {
        let panels = PANELS.map(|(title, asked)| {
            let shades = sheet.column(title, shade)?;
            let sides = (asked.axes(), asked.ends());
            Ok(cells_panel(title.to_owned(), sides, &shades, self.grid))
        });
        let panels = panels.into_iter().collect::<Result<Vec<_>, _>>()?;
        let used = |key: &Key| panels.iter().any(|panel| shows(panel, key.shade));
        let key = Method::ALL
            .into_iter()
            .enumerate()
            .map(|(index, method)| Key {
                name: method_words(method).to_owned(),
                shade: Shade::Kind(index as u8),
            });
        let chart = Chart {
            columns: 2,
            key: key.filter(used).collect(),
            ..Chart::default()
        };
        Ok(vec![("", Chart { panels, ..chart })])
    }

    fn words(&self, sheet: &Sheet) -> Result<String, SheetError> {
        let mut text = "Where one method takes over from another; no cell has a right or a wrong here, only a cheaper one. Pfaff's series in machine words serves most \
             photons up to some thousand digits, the same series by binary splitting what lies beyond; where shells hold few photons the closed form is cheapest for many digits, \
             since only its logarithm grows with them, and for few ones, too, where the shell is thick and the series long.\n\n\
             | panel | methods, % of cells |\n|---|---|\n"
            .to_owned();
        for (title, _) in PANELS {
            let cells = sheet.column(title, |cell| Some(cell.to_owned()))?;
            let of = |method| cells.iter().filter(|cell| **cell == name(method)).count();
            let methods = Method::ALL.into_iter().map(Some).chain([None]);
            let mut found: Vec<(usize, &str)> = methods
                .map(|method| (of(method), method.map_or("none", method_words)))
                .filter(|(count, _)| *count > 0)
                .collect();
            found.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
            let shares = found
                .iter()
                .map(|(count, name)| format!("{name} {}", percent(*count, cells.len())));
            let _ = writeln!(
                text,
                "| {title} | {} |",
                shares.collect::<Vec<_>>().join(", ")
            );
        }
        Ok(text)
    }
}
