//! Where panels stand: in one column, or side by side.

use super::{Chart, Marks, Panel};

/// Of the page, in pixels; all lengths are.
pub(super) const WIDTH: f64 = 800.0;

/// Sizes that follow from the number of columns. Whole numbers, so that a cell of a map can be a pixel.
#[derive(Debug)]
pub(super) struct Grid {
    pub(super) columns: usize,
    /// Of the first plot.
    pub(super) left: f64,
    /// Between plots.
    pub(super) gap: f64,
    /// Of a plot.
    pub(super) width: f64,
    pub(super) height: f64,
    /// The height of a plot that holds cells.
    pub(super) map: f64,
    /// Where the label of an upright axis stands.
    pub(super) upright: f64,
    /// Between the plot and its ticks' labels.
    pub(super) apart: f64,
    /// Left free around what is drawn, as a share of it: a ring fits in.
    pub(super) spare: f64,
    /// How far an exponent is raised, and the labels of level axes are lowered for it.
    pub(super) raised: f64,
    pub(super) lowered: f64,
    /// Letters of ticks and of other words.
    pub(super) small: f64,
    pub(super) letters: f64,
    /// The style of words in panels.
    pub(super) class: &'static str,
}

const ONE: Grid = Grid {
    columns: 1,
    left: 84.0,
    gap: 0.0,
    width: 694.0,
    height: 300.0,
    map: 300.0,
    upright: 18.0,
    apart: 7.0,
    spare: 0.03,
    raised: 6.0,
    lowered: 5.0,
    small: 13.0,
    letters: 13.0,
    class: "one",
};

const TWO: Grid = Grid {
    columns: 2,
    left: 72.0,
    gap: 56.0,
    width: 327.0,
    height: 203.0,
    map: 203.0,
    upright: 15.0,
    apart: 6.0,
    spare: 0.06,
    raised: 5.0,
    lowered: 8.0,
    small: 11.0,
    letters: 12.0,
    class: "two",
};

const THREE: Grid = Grid {
    columns: 3,
    left: 44.0,
    gap: 30.0,
    width: 230.0,
    height: 143.0,
    map: 150.0,
    upright: 11.0,
    apart: 5.0,
    spare: 0.06,
    raised: 4.0,
    lowered: 8.0,
    small: 10.0,
    letters: 11.0,
    class: "three",
};

impl Grid {
    pub(super) fn of(chart: &Chart) -> &'static Grid {
        match chart.columns {
            0 | 1 => &ONE,
            2 => &TWO,
            _ => &THREE,
        }
    }

    pub(super) fn is_narrow(&self) -> bool {
        self.columns > 1
    }

    /// Of the plot in this column.
    pub(super) fn left_of(&self, column: usize) -> f64 {
        self.left + column as f64 * (self.width + self.gap)
    }

    pub(super) fn height_of(&self, panel: &Panel) -> f64 {
        match holds_cells(panel) {
            true => self.map,
            false => self.height,
        }
    }

    /// For the labels of an upright axis's ticks.
    pub(super) fn room(&self) -> f64 {
        let label = self.upright + 0.25 * self.letters;
        let free = match self.gap > 0.0 {
            true => self.gap.min(self.left - label),
            false => self.left - label,
        };
        free - self.apart
    }
}

pub(super) fn holds_cells(panel: &Panel) -> bool {
    panel
        .series
        .iter()
        .any(|series| matches!(series.marks, Marks::Cells(_)))
}
