//! What series look like.

use super::plot::Plot;
use super::{Marks, Series};
use std::fmt::Write;

/// Black, blue, vermilion, green, purple, orange, sky (Okabe and Ito). The numbers of colours, dashes and shapes have no
/// common divisor, so that many looks differ.
const COLOURS: [&str; 7] = [
    "#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];

const DASHES: [&str; 5] = ["", "7 3", "2 3", "9 3 2 3", "14 4"];

/// How a mark is painted.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Body {
    Filled,
    Open,
}

/// Circle, square, triangle, diamond, cross, plus, triangle downwards, then open: circle, square, diamond; and a star.
const SHAPES: [(&str, Body); 11] = [
    ("m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0z", Body::Filled),
    ("m-2.5-2.5h5v5h-5z", Body::Filled),
    ("m0-3.5l3.5 6h-7z", Body::Filled),
    ("m0-3.8l3.8 3.8l-3.8 3.8l-3.8-3.8z", Body::Filled),
    ("m-3-3l6 6m0-6l-6 6", Body::Filled),
    ("m-4 0h8m-4-4v8", Body::Filled),
    ("m0 3.5l3.5-6h-7z", Body::Filled),
    ("m-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0z", Body::Open),
    ("m-3-3h6v6h-6z", Body::Open),
    ("m0-4.2l4.2 4.2l-4.2 4.2l-4.2-4.2z", Body::Open),
    ("m-4 0h8m-6-3.5l4 7m0-7l-4 7", Body::Filled),
];

/// Shapes of dots without a line.
const DOTS: usize = 5;

pub(super) fn colour(look: usize) -> &'static str {
    COLOURS
        .get(look % COLOURS.len())
        .copied()
        .unwrap_or("#000000")
}

fn stroke(look: usize) -> String {
    let dash = DASHES.get(look % DASHES.len()).copied().unwrap_or("");
    format!(
        "fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-dasharray=\"{dash}\" stroke-linejoin=\"round\"",
        colour(look)
    )
}

/// Series in the order in which they are drawn: fronts are below, rings above.
pub(super) fn layered(series: &[Series]) -> Vec<&Series> {
    let mut layered: Vec<&Series> = series.iter().collect();
    layered.sort_by_key(|series| match series.marks {
        Marks::Cells(_) => 0,
        Marks::Front(_) => 1,
        Marks::Line(_) | Marks::Dots(_) | Marks::Boxes(_) | Marks::Chain(_) => 2,
        Marks::Rings(_) => 3,
    });
    layered
}

/// All but cells.
pub(super) fn draw(out: &mut String, series: &Series, plot: &Plot) {
    let look = series.look;
    match &series.marks {
        // A line of one point would not be seen.
        Marks::Line(points) if points.len() == 1 => each(out, points, plot, look, dot),
        Marks::Line(points) => line(out, points, plot, &stroke(look)),
        Marks::Dots(points) => each(out, points, plot, look, dot),
        Marks::Boxes(boxes) => draw_boxes(out, boxes, plot, look),
        Marks::Chain(points) => {
            line(out, points, plot, &stroke(look));
            each(out, points, plot, look, link);
        }
        Marks::Front(points) => line(out, points, plot, &broad(look)),
        Marks::Rings(points) => each(out, points, plot, look, ring),
        Marks::Cells(_) => {}
    }
}

/// The same in the legend, in a place 28 pixels wide from x, around this height.
pub(super) fn sample(out: &mut String, series: &Series, x: f64, middle: f64) {
    let look = series.look;
    match &series.marks {
        Marks::Line(_) => dash(out, &stroke(look), x, middle),
        Marks::Dots(_) => dot(out, look, x + 14.0, middle),
        Marks::Boxes(_) => draw_sample_box(out, look, x, middle),
        Marks::Chain(_) => {
            dash(out, &stroke(look), x, middle);
            link(out, look, x + 14.0, middle);
        }
        Marks::Front(_) => dash(out, &broad(look), x, middle),
        Marks::Rings(_) => ring(out, look, x + 14.0, middle),
        Marks::Cells(_) => {}
    }
}

fn each(
    out: &mut String,
    points: &[[f64; 2]],
    plot: &Plot,
    look: usize,
    mark: fn(&mut String, usize, f64, f64),
) {
    for (x, y) in points.iter().filter_map(|point| plot.at(*point)) {
        mark(out, look, x, y);
    }
}

fn line(out: &mut String, points: &[[f64; 2]], plot: &Plot, stroke: &str) {
    let mut path = String::new();
    let mut pen = 'M';
    for point in points {
        match plot.at(*point) {
            Some((x, y)) => {
                let _ = write!(path, "{pen}{x:.1} {y:.1}");
                pen = 'L';
            }
            None => pen = 'M',
        }
    }
    let _ = writeln!(out, "<path d=\"{path}\" {stroke}/>");
}

fn dash(out: &mut String, stroke: &str, x: f64, middle: f64) {
    let _ = writeln!(out, "<path d=\"M{x} {middle}h28\" {stroke}/>");
}

fn broad(look: usize) -> String {
    format!(
        "fill=\"none\" stroke=\"{}\" stroke-opacity=\"0.25\" stroke-width=\"9\" stroke-linejoin=\"round\"",
        colour(look)
    )
}

fn draw_boxes(out: &mut String, boxes: &[[f64; 4]], plot: &Plot, look: usize) {
    let colour = colour(look);
    for [a, b, c, d] in boxes {
        let Some(((left, low), (right, high))) = plot.at([*a, *c]).zip(plot.at([*b, *d])) else {
            continue;
        };
        let _ = writeln!(
            out,
            "<rect x=\"{left:.1}\" y=\"{high:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{colour}\" \
             fill-opacity=\"0.35\" stroke=\"{colour}\"/>",
            (right - left).max(0.5),
            (low - high).max(0.5)
        );
    }
}

fn draw_sample_box(out: &mut String, look: usize, x: f64, middle: f64) {
    let colour = colour(look);
    let _ = writeln!(
        out,
        "<rect x=\"{x}\" y=\"{}\" width=\"28\" height=\"9\" fill=\"{colour}\" fill-opacity=\"0.35\" stroke=\"{colour}\"/>",
        middle - 4.5
    );
}

/// A circle, square, triangle, diamond or cross.
fn dot(out: &mut String, look: usize, x: f64, y: f64) {
    mark(out, look % DOTS, colour(look), x, y);
}

/// The mark of a chain: of more shapes.
fn link(out: &mut String, look: usize, x: f64, y: f64) {
    mark(out, look % SHAPES.len(), colour(look), x, y);
}

fn mark(out: &mut String, shape: usize, colour: &str, x: f64, y: f64) {
    let (path, body) = SHAPES.get(shape).copied().unwrap_or(("", Body::Filled));
    let fill = match body {
        Body::Filled => format!("fill=\"{colour}\" fill-opacity=\"0.6\""),
        Body::Open => "fill=\"#fff\"".to_owned(),
    };
    let _ = writeln!(
        out,
        "<path d=\"M{x:.1} {y:.1}{path}\" {fill} stroke=\"{colour}\"/>"
    );
}

fn ring(out: &mut String, look: usize, x: f64, y: f64) {
    let _ = writeln!(
        out,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>",
        colour(look)
    );
}
