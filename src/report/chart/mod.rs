//! Charts as SVG: panels one below the other, each with two axes and some series.
//!
//! Series differ by dash and by the shape of their marks as well as by colour (the palette of Okabe and Ito, Color
//! Universal Design, 2008), so that a chart can be read in black and white and by the colour-blind. Drawn for a
//! width of 800 pixels. The same chart is the same bytes everywhere.
//!
//! ```
//! use claimcheck::report::chart::{Axis, Chart, Marks, Panel, Scale, Series};
//! let squares = (1..=10).map(|x| [f64::from(x), f64::from(x * x)]).collect();
//! let chart = Chart {
//!     title: "Squares".into(),
//!     notes: vec![],
//!     panels: vec![Panel {
//!         x: Axis { label: "x".into(), scale: Scale::Linear },
//!         y: Axis { label: "x^2".into(), scale: Scale::Log },
//!         series: vec![Series { name: "squares".into(), marks: Marks::Line(squares), look: 0 }],
//!     }],
//! };
//! assert!(chart.to_svg().starts_with("<svg "));
//! ```

mod axis;
mod svg;

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    pub title: String,
    /// Small lines at the foot: the command, the machine, what a reader must know.
    pub notes: Vec<String>,
    pub panels: Vec<Panel>,
}

/// Two axes and what is drawn between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
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
}

impl Marks {
    /// The corners of all that is drawn.
    fn corners(&self) -> Vec<[f64; 2]> {
        match self {
            Marks::Line(points) | Marks::Dots(points) => points.clone(),
            Marks::Boxes(boxes) => boxes
                .iter()
                .flat_map(|[a, b, c, d]| [[*a, *c], [*b, *d]])
                .collect(),
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
