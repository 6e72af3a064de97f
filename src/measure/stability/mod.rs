//! Maps of where formulas in doubles fail: over photons (k, l/m) and over arguments (z, m).
//!
//! A [`Map`] has a plane, a few panels (a quantity by a [`Recipe`]) and a grid. Behind every cell stand 9 scenes; each is
//! computed by every recipe and compared with an enclosure of the truth to 25 digits, for the very doubles that the recipe is
//! given. The cell tells the worst of them.
//!
//! ```
//! use claimcheck::measure::stability::{Cell, Grid, maps};
//! let map = maps().into_iter().find(|map| map.name == "photons-moments").expect("one of them");
//! // The last column: k near 10^12. The first panel is E - 1 by the thesis's formula.
//! let grid = Grid { columns: 40, rows: 2 };
//! let rows = map.column(grid, 39)?;
//! assert!(rows[1][0] >= Cell::Lost(110));
//! # Ok::<(), claimcheck::special::shell::ShellError>(())
//! ```

use super::plain::{Failure, Recipe, Scene};
use crate::model::Layout;
use crate::number::Interval;
use crate::special::shell::{Quantity, ShellError, enclose_all};
use rug::float::Round;
use rug::ops::{AssignRound, DivAssignRound};
use rug::{Float, Integer};
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

/// Digits of the truth.
const TRUTH: u32 = 25;

/// Scenes along each side of a cell.
pub const FINE: u32 = 3;

/// The photons of a map: k from 4 to 10^12, as powers of ten.
const PHOTONS: [f64; 2] = [0.602_059_991_327_962_4, 12.0];
/// |z| from 10^-3 to 10^3.
const ARGUMENTS: [f64; 2] = [-3.0, 3.0];
/// m from 1 to 10^6.
const COUNTS: [f64; 2] = [0.0, 6.0];

/// What is along the edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// Photons of strategy 2: k from 4 to 10^12 on a logarithmic scale, and l/m from 0 to 1.
    Photons,
    /// The photon in the middle of a shell of m and of the volume m: -z = V/Va from 10^-3 to 10^3, and m from 1 to 10^6, both on a
    /// logarithmic scale.
    Arguments,
}

impl Plane {
    /// The ends along x and upwards.
    pub fn ends(self) -> [[f64; 2]; 2] {
        match self {
            Plane::Photons => [PHOTONS.map(|x| 10f64.powf(x)), [0.0, 1.0]],
            Plane::Arguments => [ARGUMENTS, COUNTS].map(|ends| ends.map(|x| 10f64.powf(x))),
        }
    }

    /// The values at parts of the way, between 0 and 1.
    pub fn at(self, along: f64, upwards: f64) -> [f64; 2] {
        let between = |[from, to]: [f64; 2], part: f64| 10f64.powf(from + part * (to - from));
        match self {
            Plane::Photons => [between(PHOTONS, along), upwards],
            Plane::Arguments => [between(ARGUMENTS, along), between(COUNTS, upwards)],
        }
    }

    /// The scene there, in exact doubles.
    pub fn scene(self, along: f64, upwards: f64) -> Scene {
        let [x, y] = self.at(along, upwards);
        match self {
            Plane::Photons => {
                let near = Integer::from(x.round() as u64);
                let shell = Layout::Triangular.shell(&near);
                let count = shell.map_or(1.0, |shell| shell.count.to_f64());
                Scene {
                    inner: count * (count - 1.0) / 2.0,
                    volume: count,
                    position: (count * y).ceil().clamp(1.0, count),
                    count,
                }
            }
            Plane::Arguments => {
                let count = y.round();
                Scene {
                    // Few bits, so that the exact number is short.
                    inner: f64::from((count / x) as f32),
                    volume: count,
                    position: (count / 2.0).ceil(),
                    count,
                }
            }
        }
    }
}

/// Some recipes for some quantities over a plane.
#[derive(Clone, Debug)]
pub struct Map {
    /// In file names.
    pub name: &'static str,
    pub plane: Plane,
    pub panels: Vec<(Quantity, Recipe)>,
}

/// All maps.
pub fn maps() -> Vec<Map> {
    let function = |recipes: &[Recipe]| -> Vec<(Quantity, Recipe)> {
        recipes
            .iter()
            .map(|&recipe| (Quantity::Function, recipe))
            .collect()
    };
    let moments = |recipes: &[Recipe]| {
        let of = |&recipe: &Recipe| {
            [Quantity::Excess, Quantity::Variance].map(|quantity| (quantity, recipe))
        };
        recipes.iter().flat_map(of).collect()
    };
    // The two others start from F, and from E - 1.
    let all: Vec<Recipe> = Recipe::ALL
        .into_iter()
        .filter(|recipe| !matches!(recipe, Recipe::Formula | Recipe::Certified))
        .collect();
    vec![
        Map {
            name: "photons-function",
            plane: Plane::Photons,
            panels: function(&all),
        },
        Map {
            name: "photons-moments",
            plane: Plane::Photons,
            panels: moments(&[
                Recipe::Formula,
                Recipe::Pfaff,
                Recipe::Moments,
                Recipe::Certified,
            ]),
        },
        Map {
            name: "arguments-function",
            plane: Plane::Arguments,
            panels: function(&all),
        },
        Map {
            name: "arguments-moments",
            plane: Plane::Arguments,
            panels: moments(&[Recipe::Formula, Recipe::Pfaff, Recipe::Moments]),
        },
    ]
}

/// How many cells a map has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    pub columns: u32,
    pub rows: u32,
}

impl Grid {
    /// Of a full run: a cell is a pixel.
    pub const FULL: Grid = Grid {
        columns: 230,
        rows: 150,
    };
    /// Of a quick one.
    pub const QUICK: Grid = Grid {
        columns: 46,
        rows: 30,
    };

    /// The middle of a cell, as parts of the way along both edges.
    pub fn middle(self, column: u32, row: u32) -> (f64, f64) {
        let part = |index: u32, count: u32| (f64::from(index) + 0.5) / f64::from(count);
        (part(column, self.columns), part(row, self.rows))
    }

    /// Where the scenes of a cell lie: the middles of its own cells.
    pub fn places(self, column: u32, row: u32) -> impl Iterator<Item = (f64, f64)> {
        let finer = Grid {
            columns: self.columns * FINE,
            rows: self.rows * FINE,
        };
        (0..FINE).flat_map(move |i| {
            (0..FINE).map(move |j| finer.middle(column * FINE + i, row * FINE + j))
        })
    }
}

/// What a recipe gives in a cell, from good to bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Cell {
    /// So many tenths of a digit less than a correctly rounded double has, rounded up.
    Lost(u8),
    /// It says that it has no answer: outside its domain.
    Refusal,
    /// It gives up: too many steps.
    Cost,
    /// It gives up: the terms grow.
    Divergence,
    /// An infinity or no number came out.
    Overflow,
    /// A number without one right digit.
    Wrong,
}

impl Map {
    /// A column of the map, from the bottom: for each place a cell each panel.
    ///
    /// # Errors
    /// None that is known: there is a truth in every cell.
    pub fn column(&self, grid: Grid, column: u32) -> Result<Vec<Vec<Cell>>, ShellError> {
        (0..grid.rows)
            .map(|row| self.worst(grid.places(column, row), truth))
            .collect()
    }

    /// The worst of the scenes at these places, each panel, where the truth is told by `truth`.
    ///
    /// # Errors
    /// Those of `truth`.
    pub fn worst(
        &self,
        places: impl Iterator<Item = (f64, f64)>,
        truth: impl Fn(&Scene) -> Result<Truth, ShellError>,
    ) -> Result<Vec<Cell>, ShellError> {
        let mut cells = vec![Cell::Lost(0); self.panels.len()];
        for (along, upwards) in places {
            let scene = self.plane.scene(along, upwards);
            let truth = truth(&scene)?;
            for (worst, (quantity, recipe)) in cells.iter_mut().zip(&self.panels) {
                *worst = (*worst).max(truth.cell(*recipe, *quantity, &scene));
            }
        }
        Ok(cells)
    }
}

/// Enclosures for one scene.
#[derive(Clone, Debug)]
pub struct Truth {
    pub function: Interval,
    pub excess: Interval,
    pub variance: Interval,
}

impl Truth {
    /// What a recipe comes to.
    pub fn cell(&self, recipe: Recipe, quantity: Quantity, scene: &Scene) -> Cell {
        let truth = match quantity {
            Quantity::Function => self.function.clone(),
            Quantity::Mean => self
                .excess
                .add(&Interval::from_i64(1, self.excess.precision())),
            Quantity::Excess => self.excess.clone(),
            Quantity::Variance => self.variance.clone(),
        };
        Cell::of(recipe.compute(quantity, scene, &self.function), &truth)
    }
}

/// Enclosures of F, E - 1 and Var to 25 digits.
///
/// # Errors
/// Where there is none; in a map there always is.
pub fn truth(scene: &Scene) -> Result<Truth, ShellError> {
    let quantities = [Quantity::Function, Quantity::Excess, Quantity::Variance];
    let shell = scene.shell().ok_or(ShellError::NoShell)?;
    let [function, excess, variance] = enclose_all(quantities, &shell, TRUTH)?;
    Ok(Truth {
        function,
        excess,
        variance,
    })
}

impl Cell {
    /// What came of a recipe.
    pub fn of(found: Result<f64, Failure>, truth: &Interval) -> Cell {
        match found {
            Ok(value) => lost(value, truth),
            Err(Failure::Overflow) => Cell::Overflow,
            Err(Failure::Divergence) => Cell::Divergence,
            Err(Failure::Refusal) => Cell::Refusal,
            Err(Failure::Cost) => Cell::Cost,
        }
    }
}

/// How far a number lies from the truth: an upper bound, for every value in the enclosure.
///
/// ```
/// use claimcheck::{measure::stability::{Cell, lost}, number::Interval};
/// let third = Interval::from_rational(&rug::Rational::from((1, 3)), 100);
/// assert_eq!(lost(1.0 / 3.0, &third), Cell::Lost(0));
/// // An error of 3e-6 of it: ten digits of the 15.95 are lost.
/// assert_eq!(lost(0.333334, &third), Cell::Lost(103));
/// assert_eq!(lost(-1.0, &third), Cell::Wrong);
/// ```
pub fn lost(value: f64, truth: &Interval) -> Cell {
    let precision = truth.precision();
    let off = |end: &Float| {
        let mut off = Float::new(precision);
        // Upwards where it is positive, downwards where it is negative: away from 0 either way.
        off.assign_round(value - end, Round::AwayZero);
        off.abs()
    };
    let mut error = off(truth.low()).max(&off(truth.high()));
    let least = truth.low().clone().abs().min(&truth.high().clone().abs());
    error.div_assign_round(&least, Round::Up);
    let units = error.to_f64_round(Round::Up) / (f64::EPSILON / 2.0);
    if units.is_nan() || units >= 2f64.powi(53) {
        return Cell::Wrong;
    }
    Cell::Lost((10.0 * units.log10()).ceil().clamp(0.0, 255.0) as u8)
}

impl Display for Cell {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Cell::Lost(tenths) => write!(f, "{}.{}", tenths / 10, tenths % 10),
            Cell::Refusal => f.write_str("refused"),
            Cell::Cost => f.write_str("steps"),
            Cell::Divergence => f.write_str("diverges"),
            Cell::Overflow => f.write_str("overflow"),
            Cell::Wrong => f.write_str("wrong"),
        }
    }
}

/// No text of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no cell of a map")]
pub struct NoCell;

impl FromStr for Cell {
    type Err = NoCell;

    fn from_str(text: &str) -> Result<Cell, NoCell> {
        Ok(match text {
            "refused" => Cell::Refusal,
            "steps" => Cell::Cost,
            "diverges" => Cell::Divergence,
            "overflow" => Cell::Overflow,
            "wrong" => Cell::Wrong,
            digits => {
                let (whole, tenth) = digits.split_once('.').ok_or(NoCell)?;
                let whole: u8 = whole.parse().map_err(|_| NoCell)?;
                let tenth: u8 = tenth.parse().map_err(|_| NoCell)?;
                let tenths = whole.checked_mul(10).and_then(|w| w.checked_add(tenth));
                let cell = tenths.map(Cell::Lost).ok_or(NoCell)?;
                // As it is written, not 1.10 or +1.1.
                (cell.to_string() == text).then_some(cell).ok_or(NoCell)?
            }
        })
    }
}

#[cfg(test)]
mod tests;
