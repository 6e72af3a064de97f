//! Which ticks an axis has room for, and how they are drawn.

use super::axis::{Label, Ruler, Tick};
use super::grid::{Grid, WIDTH};
use super::plot::Plot;
use super::text;
use std::fmt::Write;

/// Ticks with a label, about, from the number asked first to that asked last.
const COUNTS: [f64; 5] = [7.0, 5.0, 4.0, 3.0, 2.0];

/// Half the height of a digit, as a share of the letters' size.
const HALF: f64 = 4.5 / 13.0;

/// Of the letters of an exponent.
const POWER: f64 = 10.0;

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Along {
    X,
    Y,
}

impl Label {
    /// As SVG, and about how wide.
    fn drawn(&self, grid: &Grid) -> Option<(String, f64)> {
        let size = grid.small;
        match self {
            Label::Plain(label) => {
                let label = text::escaped(label).replace('-', "\u{2212}");
                let width = text::width(&label, size);
                Some((label, width))
            }
            Label::Power(0) => Some(("1".to_owned(), text::width("1", size))),
            Label::Power(1) => Some(("10".to_owned(), text::width("10", size))),
            Label::Power(exponent) => {
                let exponent = exponent.to_string().replace('-', "\u{2212}");
                let width = text::width("10", size) + text::width(&exponent, POWER);
                let label = format!(
                    "10<tspan class=\"power\" dy=\"-{}\">{exponent}</tspan>",
                    grid.raised
                );
                Some((label, width))
            }
            Label::None => None,
        }
    }
}

/// As many ticks as there is room for.
fn chosen(ruler: &Ruler, along: Along, length: f64, grid: &Grid) -> Vec<Tick> {
    // Wide panels have as many as ever.
    if !grid.is_narrow() {
        return ruler.ticks(COUNTS[0]);
    }
    let fewer = COUNTS.into_iter().map(|count| ruler.ticks(count));
    let mut fewest = vec![];
    for ticks in fewer {
        let free = without_overlap(ticks.clone(), ruler, along, length, grid);
        if free == ticks {
            return ticks;
        }
        fewest = free;
    }
    fewest
}

/// The ticks, where a label that would touch the one before is left out.
fn without_overlap(
    mut ticks: Vec<Tick>,
    ruler: &Ruler,
    along: Along,
    length: f64,
    grid: &Grid,
) -> Vec<Tick> {
    let size = grid.small;
    let mut free = f64::NEG_INFINITY;
    for tick in &mut ticks {
        let Some((_, width)) = tick.label.drawn(grid) else {
            continue;
        };
        let (half, gap) = match along {
            Along::X => (width / 2.0, 0.8 * size),
            Along::Y => (size / 2.0, 0.5 * size),
        };
        let middle = ruler.place(tick.value).unwrap_or(0.0) * length;
        match middle - half >= free {
            true => free = middle + half + gap,
            false => tick.label = Label::None,
        }
    }
    ticks
}

/// The ticks of both axes: lines across the plot, or short ones outside where cells would hide them.
pub(super) fn draw(out: &mut String, plot: &Plot, outside: bool, grid: &Grid) {
    for along in [Along::X, Along::Y] {
        let (ruler, length) = match along {
            Along::X => (&plot.x, plot.width),
            Along::Y => (&plot.y, plot.height),
        };
        for tick in chosen(ruler, along, length, grid) {
            let Some(place) = ruler.place(tick.value) else {
                continue;
            };
            draw_line(out, &tick, plot, along, place, outside);
            draw_label(out, &tick, plot, along, place, grid);
        }
    }
}

fn draw_line(out: &mut String, tick: &Tick, plot: &Plot, along: Along, place: f64, outside: bool) {
    let (class, length) = match (outside, &tick.label) {
        (true, Label::None) => ("tick", 2.0),
        (true, _) => ("tick", 4.0),
        (false, Label::None) => ("minor", 0.0),
        (false, _) => ("grid", 0.0),
    };
    let (x, y) = plot.inside(place, place);
    let (left, right, top, bottom) = (plot.left, plot.right(), plot.top, plot.bottom());
    let path = match (along, outside) {
        (Along::X, false) => format!("M{x:.1} {top}V{bottom}"),
        (Along::Y, false) => format!("M{left} {y:.1}H{right}"),
        (Along::X, true) => format!("M{x:.1} {bottom}v{length}"),
        (Along::Y, true) => format!("M{left} {y:.1}h-{length}"),
    };
    let _ = writeln!(out, "<path class=\"{class}\" d=\"{path}\"/>");
}

fn draw_label(out: &mut String, tick: &Tick, plot: &Plot, along: Along, place: f64, grid: &Grid) {
    let Some((label, width)) = tick.label.drawn(grid) else {
        return;
    };
    let (x, y) = plot.inside(place, place);
    let (x, y, anchor) = match along {
        Along::X => (
            inside_page(x, width, grid),
            plot.bottom() + grid.small + grid.lowered,
            "middle",
        ),
        Along::Y => (plot.left - grid.apart, y + HALF * grid.small, "end"),
    };
    let pressed = match along == Along::Y && grid.is_narrow() && width > grid.room() {
        true => format!(
            " textLength=\"{:.1}\" lengthAdjust=\"spacingAndGlyphs\"",
            grid.room()
        ),
        false => String::new(),
    };
    let _ = writeln!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\"{pressed}>{label}</text>"
    );
}

/// The middle of a label so wide, moved so that it is not cut off.
fn inside_page(x: f64, width: f64, grid: &Grid) -> f64 {
    match grid.is_narrow() {
        true => x.min(WIDTH - 1.0 - width / 2.0),
        false => x,
    }
}
