//! The drawing itself.

use super::axis::{Label, Ruler, Tick};
use super::{Chart, Marks, Panel, Series};
use std::fmt::Write;

/// Lengths in pixels.
const WIDTH: f64 = 800.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 22.0;
/// Of the plot of a panel.
const HEIGHT: f64 = 300.0;
const LINE: f64 = 19.0;
/// Letters of the title.
const TITLE: usize = 210;
/// Letters of a name in the legend, and of a label along the upright axis.
const LEGEND: usize = 84;
const UPRIGHT: usize = 38;
/// Of a letter, on average, at the legend's size.
const LETTER: f64 = 7.4;

/// Black, blue, vermilion, green, purple, orange, sky (Okabe and Ito).
const COLOURS: [&str; 7] = [
    "#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];

const DASHES: [&str; 5] = ["", "7 3", "2 3", "9 3 2 3", "14 4"];

/// The place of a panel's plot on the page, and its rulers.
struct Plot {
    top: f64,
    x: Ruler,
    y: Ruler,
}

impl Plot {
    fn at(&self, [x, y]: [f64; 2]) -> Option<(f64, f64)> {
        let (x, y) = (self.x.place(x)?, self.y.place(y)?);
        let (x, y) = (x.clamp(-1.0, 2.0), y.clamp(-1.0, 2.0));
        Some((
            LEFT + x * (WIDTH - LEFT - RIGHT),
            self.top + (1.0 - y) * HEIGHT,
        ))
    }
}

pub(super) fn draw(chart: &Chart) -> String {
    let mut body = String::new();
    let mut y = 26.0;
    for (number, line) in broken(&shortened(&chart.title, TITLE), 70)
        .iter()
        .enumerate()
    {
        y += if number > 0 { LINE } else { 0.0 };
        text(&mut body, LEFT, y, "class=\"title\"", line);
    }
    for (number, panel) in chart.panels.iter().enumerate() {
        // Panels of the same thing have the same range.
        let alike = chart.panels.iter().filter(|other| other.x == panel.x);
        let along = alike.flat_map(corners).map(|[x, _]| x);
        let alike = chart.panels.iter().filter(|other| other.y == panel.y);
        let upwards = alike.flat_map(corners).map(|[_, y]| y);
        let rulers = [
            Ruler::new(panel.x.scale, along),
            Ruler::new(panel.y.scale, upwards),
        ];
        y = draw_panel(&mut body, panel, rulers, number, y + 12.0);
    }
    for note in &chart.notes {
        for line in broken(note, 112) {
            y += 15.0;
            text(&mut body, 12.0, y, "class=\"note\"", &line);
        }
    }
    let height = y + 14.0;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" \
         role=\"img\">\n<title>{title}</title>\n<style>{STYLE}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n",
        title = escaped(&chart.title)
    )
}

const STYLE: &str = "text{font:13px 'DejaVu Sans',Verdana,sans-serif;fill:#111}\
.title{font-size:16px;font-weight:bold}.note{font-size:11px;fill:#444}.power{font-size:10px}\
.grid{stroke:#ddd;stroke-width:1}.minor{stroke:#f0f0f0;stroke-width:1}";

fn corners(panel: &Panel) -> impl Iterator<Item = [f64; 2]> {
    panel.series.iter().flat_map(|s| s.marks.corners())
}

/// Returns where it ends.
fn draw_panel(out: &mut String, panel: &Panel, [x, y]: [Ruler; 2], number: usize, top: f64) -> f64 {
    let top = draw_legend(out, &panel.series, top) + 8.0;
    let plot = Plot { top, x, y };
    let (right, bottom) = (WIDTH - RIGHT, top + HEIGHT);
    for tick in plot.x.ticks() {
        draw_tick(out, &tick, &plot, true);
    }
    for tick in plot.y.ticks() {
        draw_tick(out, &tick, &plot, false);
    }
    let _ = write!(
        out,
        "<clipPath id=\"plot{number}\"><rect x=\"{LEFT}\" y=\"{top}\" width=\"{w}\" height=\"{HEIGHT}\"/></clipPath>\n\
         <g clip-path=\"url(#plot{number})\">\n",
        w = right - LEFT
    );
    for series in &panel.series {
        draw_series(out, series, &plot);
    }
    out.push_str("</g>\n");
    let _ = writeln!(
        out,
        "<rect x=\"{LEFT}\" y=\"{top}\" width=\"{}\" height=\"{HEIGHT}\" fill=\"none\" stroke=\"#111\"/>",
        right - LEFT
    );
    let middle = f64::midpoint(LEFT, right);
    text(
        out,
        middle,
        bottom + 38.0,
        "text-anchor=\"middle\"",
        &panel.x.label,
    );
    let turned = format!(
        "text-anchor=\"middle\" transform=\"rotate(-90 18 {y})\"",
        y = top + HEIGHT / 2.0
    );
    let label = shortened(&panel.y.label, UPRIGHT);
    text(out, 18.0, top + HEIGHT / 2.0, &turned, &label);
    bottom + 46.0
}

/// The names of the series, in as many lines as they need; returns where they end.
fn draw_legend(out: &mut String, series: &[Series], top: f64) -> f64 {
    let (mut x, mut y) = (LEFT, top + LINE);
    for series in series.iter().filter(|series| !series.name.is_empty()) {
        let letters = series.name.chars().count().min(LEGEND);
        let width = 44.0 + letters as f64 * LETTER;
        if x + width > WIDTH && x > LEFT {
            (x, y) = (LEFT, y + LINE);
        }
        let (colour, middle) = (colour(series.look), y - 4.5);
        match &series.marks {
            Marks::Line(_) => {
                let _ = writeln!(
                    out,
                    "<path d=\"M{x} {middle}h28\" {}/>",
                    stroke(series.look)
                );
            }
            Marks::Dots(_) => dot(out, series.look, x + 14.0, middle),
            Marks::Boxes(_) => {
                let _ = writeln!(
                    out,
                    "<rect x=\"{x}\" y=\"{}\" width=\"28\" height=\"9\" fill=\"{colour}\" fill-opacity=\"0.35\" stroke=\"{colour}\"/>",
                    middle - 4.5
                );
            }
        }
        text(out, x + 34.0, y, "", &shortened(&series.name, LEGEND));
        x += width;
    }
    y
}

fn draw_tick(out: &mut String, tick: &Tick, plot: &Plot, along_x: bool) {
    let place = match along_x {
        true => plot.x.place(tick.value),
        false => plot.y.place(tick.value),
    };
    let Some(place) = place else { return };
    let class = match tick.label {
        Label::None => "minor",
        _ => "grid",
    };
    let (right, bottom) = (WIDTH - RIGHT, plot.top + HEIGHT);
    let x = LEFT + place * (right - LEFT);
    let y = plot.top + (1.0 - place) * HEIGHT;
    let _ = match along_x {
        true => writeln!(
            out,
            "<path class=\"{class}\" d=\"M{x:.1} {}V{bottom}\"/>",
            plot.top
        ),
        false => writeln!(
            out,
            "<path class=\"{class}\" d=\"M{LEFT} {y:.1}H{right}\"/>"
        ),
    };
    let (x, y, anchor) = match along_x {
        true => (x, bottom + 18.0, "middle"),
        false => (LEFT - 7.0, y + 4.5, "end"),
    };
    let label = match &tick.label {
        Label::Plain(label) => escaped(label).replace('-', "\u{2212}"),
        Label::Power(0) => "1".to_owned(),
        Label::Power(1) => "10".to_owned(),
        Label::Power(power) => format!(
            "10<tspan class=\"power\" dy=\"-6\">{}</tspan>",
            power.to_string().replace('-', "\u{2212}")
        ),
        Label::None => return,
    };
    let _ = writeln!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{label}</text>"
    );
}

fn draw_series(out: &mut String, series: &Series, plot: &Plot) {
    match &series.marks {
        // A line of one point would not be seen.
        Marks::Line(points) if points.len() == 1 => {
            for (x, y) in points.iter().filter_map(|point| plot.at(*point)) {
                dot(out, series.look, x, y);
            }
        }
        Marks::Line(points) => {
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
            let _ = writeln!(out, "<path d=\"{path}\" {}/>", stroke(series.look));
        }
        Marks::Dots(points) => {
            for (x, y) in points.iter().filter_map(|point| plot.at(*point)) {
                dot(out, series.look, x, y);
            }
        }
        Marks::Boxes(boxes) => {
            let colour = colour(series.look);
            for [a, b, c, d] in boxes {
                if let (Some((left, low)), Some((right, high))) =
                    (plot.at([*a, *c]), plot.at([*b, *d]))
                {
                    let _ = writeln!(
                        out,
                        "<rect x=\"{left:.1}\" y=\"{high:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{colour}\" \
                         fill-opacity=\"0.35\" stroke=\"{colour}\"/>",
                        (right - left).max(0.5),
                        (low - high).max(0.5)
                    );
                }
            }
        }
    }
}

fn colour(look: usize) -> &'static str {
    COLOURS[look % COLOURS.len()]
}

fn stroke(look: usize) -> String {
    let dash = DASHES[look % DASHES.len()];
    format!(
        "fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-dasharray=\"{dash}\" stroke-linejoin=\"round\"",
        colour(look)
    )
}

/// A circle, square, triangle, diamond or cross.
fn dot(out: &mut String, look: usize, x: f64, y: f64) {
    let colour = colour(look);
    let path = match look % 5 {
        0 => "m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0z",
        1 => "m-2.5-2.5h5v5h-5z",
        2 => "m0-3.5l3.5 6h-7z",
        3 => "m0-3.8l3.8 3.8l-3.8 3.8l-3.8-3.8z",
        _ => "m-3-3l6 6m0-6l-6 6",
    };
    let _ = writeln!(
        out,
        "<path d=\"M{x:.1} {y:.1}{path}\" fill=\"{colour}\" fill-opacity=\"0.6\" stroke=\"{colour}\"/>"
    );
}

fn text(out: &mut String, x: f64, y: f64, attributes: &str, words: &str) {
    let _ = writeln!(
        out,
        "<text x=\"{x}\" y=\"{y}\" {attributes}>{}</text>",
        escaped(words)
    );
}

/// Lines of so many letters at most, broken at spaces where there are any.
fn broken(words: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words.split(' ') {
        let line = lines.last_mut();
        match line {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The words, or as many letters of them as fit.
fn shortened(words: &str, most: usize) -> String {
    match words.chars().count() <= most {
        true => words.to_owned(),
        false => words.chars().take(most - 1).chain(['\u{2026}']).collect(),
    }
}

/// For XML: what it cannot hold is dropped.
fn escaped(words: &str) -> String {
    let mut text = String::new();
    for letter in words.chars() {
        match letter {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            letter if letter.is_control() => text.push(' '),
            letter => text.push(letter),
        }
    }
    text
}
