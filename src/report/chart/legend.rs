//! What the looks of series and the shades of cells mean.

use super::grid::{Grid, WIDTH};
use super::shade::{Key, Shade};
use super::text::{self, escaped, shortened};
use super::{Chart, Marks, Series, marks};
use std::fmt::Write;

const LINE: f64 = 19.0;

/// Letters of a name.
const NAME: usize = 84;

/// Of a letter, on average, and the size of letters.
const LETTER: f64 = 7.4;
const SIZE: f64 = 13.0;

/// All series of a chart, each name once.
pub(super) fn shared(chart: &Chart) -> Vec<&Series> {
    let mut unlike: Vec<&Series> = vec![];
    for series in chart.panels.iter().flat_map(|panel| &panel.series) {
        if is_listed(series) && unlike.iter().all(|other| other.name != series.name) {
            unlike.push(series);
        }
    }
    unlike
}

fn is_listed(series: &Series) -> bool {
    !series.name.is_empty() && !matches!(series.marks, Marks::Cells(_))
}

/// The names of the series, in as many lines as they need; returns where they end.
pub(super) fn draw(out: &mut String, series: &[&Series], grid: &Grid, top: f64) -> f64 {
    let left = grid.left;
    let mut x = left;
    let mut y = match series.iter().any(|series| is_listed(series)) {
        true => top + LINE,
        false => top,
    };
    for series in series.iter().filter(|series| is_listed(series)) {
        let width = 44.0 + breadth(&series.name, grid);
        if x + width > WIDTH && x > left {
            (x, y) = (left, y + LINE);
        }
        marks::sample(out, series, x, y - 4.5);
        text::text(out, x + 34.0, y, "", &shortened(&series.name, NAME));
        x += width;
    }
    y
}

fn breadth(name: &str, grid: &Grid) -> f64 {
    match grid.is_narrow() {
        true => text::width(&shortened(name, NAME), SIZE) + 4.0,
        false => name.chars().count().min(NAME) as f64 * LETTER,
    }
}

/// A swatch of the key in its place.
struct Swatch<'a> {
    key: &'a Key,
    /// With what is free right of it.
    width: f64,
    /// One of a bar of levels: its breadth.
    level: Option<f64>,
    /// Right of a bar: what its levels measure.
    measure: &'a str,
}

/// Of a swatch, and of one of a bar with the name below it.
const SWATCH: f64 = 14.0;
const BAR: f64 = 30.0;

/// The broadest swatch of a bar, and its letters' size.
const BROADEST: f64 = 44.0;
const SMALL: f64 = 11.0;

/// The key, in as many lines as it needs; returns where it ends.
pub(super) fn draw_key(out: &mut String, chart: &Chart, left: f64, top: f64) -> f64 {
    let mut y = top;
    for line in lines(swatches(chart), WIDTH - left) {
        y += 8.0;
        let mut x = left;
        for swatch in &line {
            draw_swatch(out, swatch, x, y);
            x += swatch.width;
        }
        let bar = line.iter().any(|swatch| swatch.level.is_some());
        y += if bar { BAR } else { SWATCH };
    }
    y
}

fn swatches(chart: &Chart) -> Vec<Swatch<'_>> {
    let runs = chart
        .key
        .chunk_by(|a, b| is_short_level(a) && is_short_level(b));
    runs.flat_map(|run| match run {
        [key] => vec![single(key)],
        _ => bar(run, &chart.levels),
    })
    .collect()
}

fn single(key: &Key) -> Swatch<'_> {
    Swatch {
        key,
        width: 48.0 + text::width(&shortened(&key.name, NAME), SIZE),
        level: None,
        measure: "",
    }
}

/// A level whose name is no broader than a swatch of a bar.
fn is_short_level(key: &Key) -> bool {
    matches!(key.shade, Shade::Level(_)) && text::width(&key.name, SMALL) + 2.0 <= BROADEST
}

/// Levels side by side, and what they measure.
fn bar<'a>(levels: &'a [Key], measure: &'a str) -> Vec<Swatch<'a>> {
    let widths = levels.iter().map(|key| text::width(&key.name, SMALL) + 2.0);
    let breadth = widths.fold(26.0, f64::max).min(BROADEST).ceil();
    let mut bar: Vec<Swatch> = levels
        .iter()
        .map(|key| Swatch {
            key,
            width: breadth,
            level: Some(breadth),
            measure: "",
        })
        .collect();
    if let Some(last) = bar.last_mut() {
        last.measure = measure;
        last.width += 20.0 + text::width(measure, SIZE);
    }
    bar
}

/// Broken into lines no wider than this, of one swatch at least.
fn lines(swatches: Vec<Swatch<'_>>, width: f64) -> Vec<Vec<Swatch<'_>>> {
    let mut lines: Vec<Vec<Swatch<'_>>> = vec![];
    let mut x = 0.0;
    for swatch in swatches {
        match lines.last_mut() {
            Some(line) if x + swatch.width <= width => {
                x += swatch.width;
                line.push(swatch);
            }
            _ => {
                x = swatch.width;
                lines.push(vec![swatch]);
            }
        }
    }
    lines
}

fn draw_swatch(out: &mut String, swatch: &Swatch<'_>, x: f64, y: f64) {
    let fill = swatch.key.shade.fill();
    let width = swatch.level.unwrap_or(28.0);
    let _ = writeln!(
        out,
        "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{SWATCH}\" fill=\"{fill}\" stroke=\"#111\" stroke-width=\"0.6\"/>"
    );
    let (right, top) = (x + width, y);
    let name = escaped(&shortened(&swatch.key.name, NAME));
    let (x, y, style) = match swatch.level {
        Some(width) => (x + width / 2.0, y + BAR - 4.0, "class=\"level\""),
        None => (x + 34.0, y + 12.0, ""),
    };
    let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" {style}>{name}</text>");
    if !swatch.measure.is_empty() {
        text::text(
            out,
            right + 8.0,
            top + 12.0,
            "",
            &shortened(swatch.measure, NAME),
        );
    }
}
