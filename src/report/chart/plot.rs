//! A panel: its frame, what is written around it, and what is drawn in it.

use super::axis::Ruler;
use super::grid::{self, Grid};
use super::shade::Key;
use super::text::{fitted, shortened, text};
use super::{Marks, Panel, cells, marks, ticks};
use std::fmt::Write;

/// Letters of a label along the upright axis of a wide panel.
const UPRIGHT: usize = 38;

/// The place of a panel's plot on the page, and its rulers.
pub(super) struct Plot {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) x: Ruler,
    pub(super) y: Ruler,
}

impl Plot {
    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// The point at these shares of the width and the height, from below.
    pub(super) fn inside(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + x * self.width,
            self.top + (1.0 - y) * self.height,
        )
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> Option<(f64, f64)> {
        let (x, y) = (self.x.place(x)?, self.y.place(y)?);
        Some(self.inside(x.clamp(-1.0, 2.0), y.clamp(-1.0, 2.0)))
    }

    fn rectangle(&self) -> String {
        let Plot {
            left,
            top,
            width,
            height,
            ..
        } = self;
        format!("<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"")
    }
}

/// A panel as it is drawn.
pub(super) struct Framed<'a> {
    pub(super) panel: &'a Panel,
    /// Its number in the chart.
    pub(super) number: usize,
    pub(super) plot: Plot,
    /// Lines above the plot.
    pub(super) heading: Vec<String>,
    /// Whether the axes' labels are written beside the plot.
    pub(super) labels: [bool; 2],
}

impl Framed<'_> {
    pub(super) fn draw(&self, out: &mut String, key: &[Key], grid: &Grid) {
        let _ = writeln!(out, "<g class=\"{}\">", grid.class);
        self.draw_heading(out, grid);
        let map = grid::holds_cells(self.panel);
        ticks::draw(out, &self.plot, map, grid);
        self.draw_series(out, key);
        let frame = self.plot.rectangle();
        let _ = writeln!(out, "{frame} fill=\"none\" stroke=\"#111\"/>");
        self.draw_labels(out, grid);
        out.push_str("</g>\n");
    }

    fn draw_heading(&self, out: &mut String, grid: &Grid) {
        let lines = self.heading.iter().rev().enumerate();
        for (line, words) in lines {
            let y = self.plot.top - 5.0 - line as f64 * heading_line(grid);
            text(out, self.plot.left, y, "class=\"head\"", words);
        }
    }

    fn draw_series(&self, out: &mut String, key: &[Key]) {
        let (number, rectangle) = (self.number, self.plot.rectangle());
        let _ = write!(
            out,
            "<clipPath id=\"plot{number}\">{rectangle}/></clipPath>\n<g clip-path=\"url(#plot{number})\">\n"
        );
        for series in marks::layered(&self.panel.series) {
            match &series.marks {
                Marks::Cells(map) => cells::draw(out, map, key, &self.plot),
                _ => marks::draw(out, series, &self.plot),
            }
        }
        out.push_str("</g>\n");
    }

    fn draw_labels(&self, out: &mut String, grid: &Grid) {
        let (plot, [below, beside]) = (&self.plot, self.labels);
        let (x, y) = plot.inside(0.5, 0.5);
        if below {
            let label = fitting(&self.panel.x.label, plot.width + grid.gap, usize::MAX, grid);
            let y = plot.bottom() + label_depth(grid);
            text(out, x, y, "class=\"axis\" text-anchor=\"middle\"", &label);
        }
        if beside {
            let label = fitting(&self.panel.y.label, plot.height + 12.0, UPRIGHT, grid);
            let x = grid.upright;
            let turned =
                format!("class=\"axis\" text-anchor=\"middle\" transform=\"rotate(-90 {x} {y})\"");
            text(out, x, y, &turned, &label);
        }
    }
}

/// How far below the plot the label of the level axis stands.
fn label_depth(grid: &Grid) -> f64 {
    2.0 * grid.small + grid.lowered + 7.0
}

/// What is below a plot, with and without a label.
pub(super) fn foot(grid: &Grid, labelled: bool) -> f64 {
    match labelled {
        true => label_depth(grid) + 8.0,
        false => grid.small + grid.lowered + 4.0,
    }
}

/// The height of a line above a plot.
pub(super) fn heading_line(grid: &Grid) -> f64 {
    grid.letters + 3.0
}

/// As much as fits so wide a place, where panels are narrow; else so many letters at most.
fn fitting(words: &str, room: f64, most: usize, grid: &Grid) -> String {
    match grid.is_narrow() {
        true => fitted(words, grid.letters, room),
        false => shortened(words, most),
    }
}

/// So many bold letters fit above a plot.
pub(super) fn heading_letters(grid: &Grid) -> usize {
    (grid.width / (0.66 * grid.letters)) as usize
}
