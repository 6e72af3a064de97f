//! How cells are filled, so that shades are told apart by lightness and texture as well as by colour.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fmt::Write;

/// A swatch with its meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    pub name: String,
    pub shade: Shade,
}

/// What a cell is filled with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shade {
    /// Blank.
    None,
    /// Of an ordered scale: 0 the best (palest) to 8 the worst (darkest, but not black); more counts as 8.
    /// Lightness falls evenly. Consecutive levels of a key are drawn as a bar.
    Level(u8),
    /// Solid black.
    Solid,
    /// Dark lines on white.
    Texture(Texture),
    /// One of 12 kinds without an order, 0 to 11 (12 is 0 again): pale enough for black words. The kind's name in
    /// the key stands also in its largest region of each map, where it fits.
    Kind(u8),
}

/// Dark lines on white.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Texture {
    /// Diagonals.
    Rising,
    Vertical,
    Horizontal,
    Dots,
    /// A checkerboard.
    Checked,
}

/// Cividis (Nuñez, Anderton and Renslow, PLoS ONE 13, 2018) from light to dark, by the polynomials of d3-scale-chromatic,
/// at CIELAB's lightness 91.7, 83.4, 75, ... 25: even steps.
const LEVELS: [&str; 9] = [
    "#fdea45", "#e8d057", "#cab96a", "#aca376", "#918d78", "#7a7773", "#5f626e", "#3f4f6e",
    "#193b6d",
];

/// The palette of Okabe and Ito and a grey, each mixed with white up to a lightness of 61 to 94 in CIELAB. Those of one
/// grain differ by 9 at least.
const KINDS: [(&str, Grain); 12] = [
    ("#a2d6f3", Grain::Plain),
    ("#e7a40e", Grain::Plain),
    ("#f7f19e", Grain::Plain),
    ("#17a780", Grain::Plain),
    ("#eac8db", Grain::Lines),
    ("#62a8d0", Grain::Lines),
    ("#e8a876", Grain::Lines),
    ("#e5e5e5", Grain::Lines),
    ("#f1e754", Grain::Dots),
    ("#5db7ea", Grain::Dots),
    ("#8ed4c1", Grain::Dots),
    ("#dc7a2c", Grain::Dots),
];

/// The light texture of a kind.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Grain {
    Plain,
    Lines,
    Dots,
}

impl Shade {
    /// What stands in an attribute `fill`.
    pub(super) fn fill(self) -> Cow<'static, str> {
        match self.canonical() {
            Shade::None => "#fff".into(),
            Shade::Solid => "#000".into(),
            Shade::Level(level) => LEVELS
                .get(usize::from(level))
                .copied()
                .unwrap_or("#000")
                .into(),
            Shade::Texture(texture) => format!("url(#{})", texture.name()).into(),
            Shade::Kind(kind) => match kind_of(kind) {
                (colour, Grain::Plain) => colour.into(),
                _ => format!("url(#kind{kind})").into(),
            },
        }
    }

    /// The same for all numbers that are drawn alike.
    pub(super) fn canonical(self) -> Shade {
        match self {
            Shade::Level(level) => Shade::Level(level.min(LEVELS.len() as u8 - 1)),
            Shade::Kind(kind) => Shade::Kind(kind % KINDS.len() as u8),
            other => other,
        }
    }

    /// The pattern that [`Shade::fill`] names, if any.
    fn pattern(self) -> Option<String> {
        match self.canonical() {
            Shade::Texture(texture) => Some(texture.pattern()),
            Shade::Kind(kind) => grained(kind),
            _ => None,
        }
    }
}

impl Texture {
    fn name(self) -> &'static str {
        match self {
            Texture::Rising => "rising",
            Texture::Vertical => "vertical",
            Texture::Horizontal => "horizontal",
            Texture::Dots => "dots",
            Texture::Checked => "checked",
        }
    }

    fn pattern(self) -> String {
        let (size, marks) = match self {
            Texture::Rising => (
                6,
                "<path d=\"M-1 1l2-2M0 6l6-6M5 7l2-2\" stroke=\"#000\" stroke-width=\"1.4\"/>",
            ),
            Texture::Vertical => (4, "<path d=\"M1 0h1v4h-1z\"/>"),
            Texture::Horizontal => (4, "<path d=\"M0 1h4v1h-4z\"/>"),
            Texture::Dots => (
                6,
                "<circle cx=\"1.5\" cy=\"1.5\" r=\"1.1\"/><circle cx=\"4.5\" cy=\"4.5\" r=\"1.1\"/>",
            ),
            Texture::Checked => (8, "<path d=\"M0 0h4v4h-4zM4 4h4v4h-4z\"/>"),
        };
        tile(self.name(), size, "#fff", marks)
    }
}

fn kind_of(kind: u8) -> (&'static str, Grain) {
    let kind = usize::from(kind) % KINDS.len();
    KINDS.get(kind).copied().unwrap_or(("#fff", Grain::Plain))
}

/// The pattern of a kind that is not plain.
fn grained(kind: u8) -> Option<String> {
    let (colour, grain) = kind_of(kind);
    let (size, marks) = match grain {
        Grain::Plain => return None,
        Grain::Lines => (
            7,
            "<path d=\"M-1 1l2-2M0 7l7-7M6 8l2-2\" stroke=\"#000\" stroke-opacity=\"0.4\"/>",
        ),
        Grain::Dots => (
            7,
            "<circle cx=\"3.5\" cy=\"3.5\" r=\"1\" fill-opacity=\"0.55\"/>",
        ),
    };
    Some(tile(&format!("kind{kind}"), size, colour, marks))
}

/// A square that is repeated in all directions.
fn tile(name: &str, size: u8, ground: &str, marks: &str) -> String {
    format!(
        "<pattern id=\"{name}\" width=\"{size}\" height=\"{size}\" patternUnits=\"userSpaceOnUse\">\
         <rect width=\"{size}\" height=\"{size}\" fill=\"{ground}\"/>{marks}</pattern>\n"
    )
}

/// The patterns of these shades, each once; nothing where there are none.
pub(super) fn definitions(shades: impl Iterator<Item = Shade>) -> String {
    let shades: BTreeSet<Shade> = shades.map(Shade::canonical).collect();
    let patterns: String = shades.into_iter().filter_map(Shade::pattern).collect();
    let mut out = String::new();
    if !patterns.is_empty() {
        let _ = writeln!(out, "<defs>\n{patterns}</defs>");
    }
    out
}
