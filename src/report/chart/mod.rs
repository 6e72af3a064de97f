//! Charts as SVG: panels below or beside one another, each with two axes and some series or a map.
//!
//! Series differ by dash and by the shape of their marks as well as by colour (the palette of Okabe and Ito, Color
//! Universal Design, 2008), so that a chart can be read in black and white and by the colour-blind; so do the shades
//! of a map, by lightness and texture ([`Shade`]). Drawn for a width of 800 pixels. The same chart is the same bytes
//! everywhere.
//!
//! Panels in one column have a legend each. Panels side by side share one, where each name stands once with the look
//! of its first series. There the label of an upright axis is left of the first panel of a row, and over a panel of the
//! row that has another one; the label of a level axis is below the last panel of a column, and below a panel that has
//! another axis than the next.
//!
//! ```
//! use claimcheck::report::chart::{Axis, Cells, Chart, Key, Marks, Panel, Scale, Series, Shade};
//! let axis = |label: &str, scale| Axis { label: label.into(), scale };
//! let squares = (1..=10).map(|x| [f64::from(x), f64::from(x * x)]).collect();
//! let map = Cells {
//!     x: [0.0, 2.0],
//!     y: [1.0, 10.0],
//!     columns: 2,
//!     cells: vec![Shade::Level(0), Shade::Level(0), Shade::Level(1), Shade::Solid],
//! };
//! let panel = |title: &str, scale, marks| Panel {
//!     title: title.into(),
//!     x: axis("x", Scale::Linear),
//!     y: axis("y", scale),
//!     series: vec![Series { name: title.into(), marks, look: 0 }],
//! };
//! let chart = Chart {
//!     title: "A curve and a map".into(),
//!     notes: vec![],
//!     columns: 2,
//!     key: vec![Key { name: "none".into(), shade: Shade::Solid }],
//!     levels: String::new(),
//!     panels: vec![
//!         panel("squares", Scale::Linear, Marks::Line(squares)),
//!         panel("cells", Scale::Log, Marks::Cells(map)),
//!     ],
//! };
//! assert!(chart.to_svg().starts_with("<svg "));
//! ```

mod axis;
mod cells;
mod grid;
mod legend;
mod marks;
mod plot;
mod shade;
mod svg;
mod text;
mod ticks;

pub use cells::Cells;
pub use shade::{Key, Shade, Texture};

/// A picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    pub title: String,
    /// Small lines at the foot: the command, the machine, what a reader must know.
    pub notes: Vec<String>,
    /// Panels side by side: 1, 2 or 3 (0, the default, counts as 1, more as 3).
    pub columns: usize,
    /// What the shades of cells mean; drawn once, above the panels.
    pub key: Vec<Key>,
    /// What the levels of the key measure, with its unit: stands beside them.
    pub levels: String,
    pub panels: Vec<Panel>,
}

/// Two axes and what is drawn between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Above the plot; none if empty.
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    pub series: Vec<Series>,
}

/// What is along an edge, with its unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    pub label: String,
    pub scale: Scale,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    Linear,
    /// Numbers that are not positive are not drawn.
    Log,
}

/// Some marks with a name in the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Not in the legend if empty.
    pub name: String,
    pub marks: Marks,
    /// Colour, dash and shape; any number.
    pub look: usize,
}

/// What is drawn. Numbers that are not finite are left out; a line breaks there.
#[derive(Clone, Debug, PartialEq)]
pub enum Marks {
    /// x, y
    Line(Vec<[f64; 2]>),
    /// x, y
    Dots(Vec<[f64; 2]>),
    /// x from, x to, y from, y to: from each to the next a box.
    Boxes(Vec<[f64; 4]>),
    /// x, y: a line with a mark at each of its points.
    Chain(Vec<[f64; 2]>),
    /// x, y: a broad pale line behind all series of the panel, from point to point.
    Front(Vec<[f64; 2]>),
    /// x, y: large open rings around points, above all series of the panel: what is chosen.
    Rings(Vec<[f64; 2]>),
    /// A map, below all else. The panel's axes end at its edges. Not in the legend: the chart's key tells its shades.
    Cells(Cells),
}

impl Marks {
    /// The corners of all that is drawn.
    pub(super) fn corners(&self) -> Vec<[f64; 2]> {
        match self {
            Marks::Line(points)
            | Marks::Dots(points)
            | Marks::Chain(points)
            | Marks::Front(points)
            | Marks::Rings(points) => points.clone(),
            Marks::Boxes(boxes) => boxes
                .iter()
                .flat_map(|[a, b, c, d]| [[*a, *c], [*b, *d]])
                .collect(),
            Marks::Cells(cells) => cells.corners().to_vec(),
        }
    }
}

impl Chart {
    /// The picture.
    pub fn to_svg(&self) -> String {
        svg::draw(self)
    }
}

#[cfg(test)]
mod tests;
