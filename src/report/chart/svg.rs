//! The page: title, legend, key, panels in rows, notes.

use super::axis::Ruler;
use super::grid::{Grid, WIDTH};
use super::plot::{self, Framed, Plot};
use super::shade::{self, Shade};
use super::text::{broken, escaped, shortened, text};
use super::{Cells, Chart, Marks, Panel, legend};

const LINE: f64 = 19.0;

/// Letters of the title.
const TITLE: usize = 210;

/// Lines of a panel's title.
const HEADING: usize = 2;

const STYLE: &str = "text{font:13px 'DejaVu Sans',Verdana,sans-serif;fill:#111}\
.title{font-size:16px;font-weight:bold}.note{font-size:11px;fill:#444}.power{font-size:10px}\
.grid{stroke:#ddd;stroke-width:1}.minor{stroke:#f0f0f0;stroke-width:1}.tick{stroke:#111;stroke-width:1}\
.two text{font-size:11px}.two .head,.two .axis{font-size:12px}\
.three text{font-size:10px}.three .head,.three .axis{font-size:11px}.one .head,.two .head,.three .head{font-weight:bold}\
.level{font-size:11px;text-anchor:middle}\
.region{text-anchor:middle;fill:#000;stroke:#fff;stroke-width:3px;stroke-linejoin:round;paint-order:stroke}";

pub(super) fn draw(chart: &Chart) -> String {
    let grid = Grid::of(chart);
    let mut body = shade::definitions(shades(chart));
    let y = draw_title(&mut body, chart, grid);
    let y = draw_legends(&mut body, chart, grid, y);
    let y = draw_rows(&mut body, chart, grid, y);
    let height = draw_notes(&mut body, &chart.notes, y) + 14.0;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" \
         role=\"img\">\n<title>{title}</title>\n<style>{STYLE}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n",
        title = escaped(&chart.title)
    )
}

/// All shades of a chart that are drawn.
fn shades(chart: &Chart) -> impl Iterator<Item = Shade> {
    let key = chart.key.iter().map(|key| key.shade);
    let maps = chart.panels.iter().flat_map(maps);
    key.chain(maps.flat_map(|cells| cells.cells.iter().copied()))
}

fn maps(panel: &Panel) -> impl Iterator<Item = &Cells> {
    panel
        .series
        .iter()
        .filter_map(|series| match &series.marks {
            Marks::Cells(cells) => Some(cells),
            _ => None,
        })
}

// Each of these returns where it ends.

fn draw_title(out: &mut String, chart: &Chart, grid: &Grid) -> f64 {
    let mut y = 26.0;
    let lines = broken(&shortened(&chart.title, TITLE), 70);
    for (number, line) in lines.iter().enumerate() {
        y += if number > 0 { LINE } else { 0.0 };
        text(out, grid.left, y, "class=\"title\"", line);
    }
    y
}

/// What is said once for all panels.
fn draw_legends(out: &mut String, chart: &Chart, grid: &Grid, top: f64) -> f64 {
    let mut y = top;
    if grid.is_narrow() {
        y = legend::draw(out, &legend::shared(chart), grid, y + 4.0);
    }
    match chart.key.is_empty() {
        true => y,
        false => legend::draw_key(out, chart, grid.left, y + 4.0),
    }
}

fn draw_rows(out: &mut String, chart: &Chart, grid: &Grid, top: f64) -> f64 {
    let mut y = top;
    for first in (0..chart.panels.len()).step_by(grid.columns) {
        y = draw_row(out, chart, grid, first, y + 12.0);
    }
    y
}

fn draw_notes(out: &mut String, notes: &[String], top: f64) -> f64 {
    let mut y = top;
    for line in notes.iter().flat_map(|note| broken(note, 125)) {
        y += 15.0;
        text(out, 12.0, y, "class=\"note\"", &line);
    }
    y
}

/// A row that begins with this panel.
fn draw_row(out: &mut String, chart: &Chart, grid: &Grid, first: usize, top: f64) -> f64 {
    let row = || {
        chart
            .panels
            .iter()
            .enumerate()
            .skip(first)
            .take(grid.columns)
    };
    let headings: Vec<Vec<String>> = row().map(|(n, _)| heading(chart, grid, n)).collect();
    let lines = headings.iter().map(Vec::len).max().unwrap_or(0);
    let mut top = top;
    if !grid.is_narrow() {
        let series: Vec<_> = row().flat_map(|(_, panel)| &panel.series).collect();
        top = legend::draw(out, &series, grid, top) + 8.0;
    }
    top += lines as f64 * plot::heading_line(grid);
    let mut end = top;
    for ((number, panel), heading) in row().zip(headings) {
        let [x, y] = rulers(chart, panel, grid.spare);
        let plot = Plot {
            left: grid.left_of(number - first),
            top,
            width: grid.width,
            height: grid.height_of(panel),
            x,
            y,
        };
        let labels = [is_last(chart, grid, number), number == first];
        end = end.max(plot.bottom() + plot::foot(grid, labels[0]));
        let framed = Framed {
            panel,
            number,
            plot,
            heading,
            labels,
        };
        framed.draw(out, &chart.key, grid);
    }
    end
}

/// Whether no panel of the same level axis is below this one.
fn is_last(chart: &Chart, grid: &Grid, number: usize) -> bool {
    let (this, below) = (
        chart.panels.get(number),
        chart.panels.get(number + grid.columns),
    );
    !grid.is_narrow() || below.is_none_or(|below| this.is_none_or(|this| this.x != below.x))
}

/// The title of a panel, and the label of its upright axis where that is another than
/// the first panel's of the row.
fn heading(chart: &Chart, grid: &Grid, number: usize) -> Vec<String> {
    let Some(panel) = chart.panels.get(number) else {
        return vec![];
    };
    let width = plot::heading_letters(grid);
    let mut lines = match panel.title.is_empty() {
        true => vec![],
        false => broken(&shortened(&panel.title, HEADING * width), width),
    };
    let row = number - number % grid.columns;
    let first = chart.panels.get(row).unwrap_or(panel);
    if first.y.label != panel.y.label {
        lines.push(shortened(&format!("\u{2191} {}", panel.y.label), width));
    }
    lines
}

/// Along x and y. Panels of the same thing have the same range, but those with cells end where these do.
fn rulers(chart: &Chart, panel: &Panel, spare: f64) -> [Ruler; 2] {
    let (x, y) = (&panel.x, &panel.y);
    let edges: Vec<[f64; 2]> = maps(panel).flat_map(Cells::corners).collect();
    if !edges.is_empty() {
        return [
            Ruler::new(x.scale, edges.iter().map(|[x, _]| *x), 0.0),
            Ruler::new(y.scale, edges.iter().map(|[_, y]| *y), 0.0),
        ];
    }
    let alike = chart.panels.iter().filter(|other| other.x == panel.x);
    let along = alike.flat_map(corners).map(|[x, _]| x);
    let alike = chart.panels.iter().filter(|other| other.y == panel.y);
    let upwards = alike.flat_map(corners).map(|[_, y]| y);
    [
        Ruler::new(x.scale, along, spare),
        Ruler::new(y.scale, upwards, spare),
    ]
}

fn corners(panel: &Panel) -> impl Iterator<Item = [f64; 2]> {
    panel.series.iter().flat_map(|s| s.marks.corners())
}
