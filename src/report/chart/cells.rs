//! Maps: cells as few rectangles, and the names of kinds in their largest regions.

use super::plot::Plot;
use super::shade::{Key, Shade};
use super::text;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;

/// A grid of cells, evenly spaced along both axes' scales.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// The outer edges along x.
    pub x: [f64; 2],
    /// The outer edges along y.
    pub y: [f64; 2],
    /// Cells in a row; nothing is drawn if 0.
    pub columns: usize,
    /// Row by row from the bottom, each from the left. Where the last row ends early the rest is blank.
    pub cells: Vec<Shade>,
}

/// A rectangle of equal cells; places count from the left and from the bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    pub(super) shade: Shade,
    pub(super) column: usize,
    pub(super) row: usize,
    pub(super) wide: usize,
    pub(super) high: usize,
}

impl Cells {
    pub(super) fn corners(&self) -> [[f64; 2]; 2] {
        let ([left, right], [bottom, top]) = (self.x, self.y);
        [[left, bottom], [right, top]]
    }

    fn rows(&self) -> impl Iterator<Item = &[Shade]> {
        let count = if self.columns == 0 { 0 } else { usize::MAX };
        self.cells.chunks(self.columns.max(1)).take(count)
    }

    fn at(&self, column: usize, row: usize) -> Shade {
        let index = row.checked_mul(self.columns);
        let index = index.and_then(|start| start.checked_add(column));
        let inside = index.filter(|_| column < self.columns);
        let shade = inside.and_then(|index| self.cells.get(index));
        shade.map_or(Shade::None, |shade| shade.canonical())
    }

    /// Every cell that is not blank is in one of them.
    pub(super) fn blocks(&self) -> Vec<Block> {
        let mut done = vec![];
        // Those that end in the row below, by their first columns.
        let mut open = BTreeMap::new();
        for (row, cells) in self.rows().enumerate() {
            let next = runs(cells, row).map(|run| (run.column, grown(run, &mut open)));
            let next = next.collect();
            done.extend(std::mem::replace(&mut open, next).into_values());
        }
        done.extend(open.into_values());
        done.retain(|block: &Block| block.shade != Shade::None);
        done
    }
}

/// Equal neighbours in a row.
fn runs(cells: &[Shade], row: usize) -> impl Iterator<Item = Block> {
    let mut column = 0;
    let alike = cells.chunk_by(|a, b| a.canonical() == b.canonical());
    alike.filter_map(move |run| {
        let start = column;
        column += run.len();
        let shade = run.first()?.canonical();
        Some(Block {
            shade,
            column: start,
            row,
            wide: run.len(),
            high: 1,
        })
    })
}

/// The run with what lies below it, if that is as wide and of the same shade.
fn grown(run: Block, open: &mut BTreeMap<usize, Block>) -> Block {
    let same = |below: &Block| below.wide == run.wide && below.shade == run.shade;
    match open.get(&run.column).copied().filter(same) {
        Some(below) => {
            open.remove(&run.column);
            Block {
                high: below.high + 1,
                ..below
            }
        }
        None => run,
    }
}

/// Where cells are on the page, in steps of half a pixel: these and their sums are exact in the floating-point numbers of
/// whatever draws them, so that neighbours of different shades leave no gap.
struct Lattice {
    left: f64,
    bottom: f64,
    /// Of a cell, in pixels.
    wide: f64,
    high: f64,
}

impl Lattice {
    fn new(cells: &Cells, plot: &Plot) -> Option<Lattice> {
        let [from, to] = cells.corners();
        let ((left, bottom), (right, top)) = plot.at(from).zip(plot.at(to))?;
        let rows = cells.rows().count();
        Some(Lattice {
            left,
            bottom,
            wide: (right - left) / cells.columns as f64,
            high: (bottom - top) / rows as f64,
        })
    }

    fn x(&self, column: usize) -> i64 {
        halves(self.left + self.wide * column as f64)
    }

    fn y(&self, row: usize) -> i64 {
        halves(self.bottom - self.high * row as f64)
    }
}

fn halves(length: f64) -> i64 {
    (length * 2.0).round() as i64
}

/// Half as much, as a decimal number.
fn decimal(halves: i64) -> String {
    let sign = if halves < 0 { "-" } else { "" };
    let size = halves.unsigned_abs();
    let fraction = if size.is_multiple_of(2) { "" } else { ".5" };
    format!("{sign}{}{fraction}", size / 2)
}

/// The cells, and in them the names of kinds.
pub(super) fn draw(out: &mut String, cells: &Cells, key: &[Key], plot: &Plot) {
    let Some(lattice) = Lattice::new(cells, plot) else {
        return;
    };
    let mut of_shade: BTreeMap<Shade, Vec<Block>> = BTreeMap::new();
    for block in cells.blocks() {
        of_shade.entry(block.shade).or_default().push(block);
    }
    for (shade, blocks) in of_shade {
        let _ = writeln!(
            out,
            "<path fill=\"{}\" shape-rendering=\"crispEdges\" d=\"{}\"/>",
            shade.fill(),
            path(&blocks, &lattice)
        );
    }
    for (kind, square) in largest(cells) {
        let named = key
            .iter()
            .find(|key| key.shade.canonical() == kind && !key.name.is_empty());
        if let Some(key) = named {
            draw_name(out, &key.name, cells, square, &lattice);
        }
    }
}

/// Each rectangle begins where the one before does, which keeps numbers short.
fn path(blocks: &[Block], lattice: &Lattice) -> String {
    let mut path = String::new();
    let (mut x, mut y) = (0, 0);
    for block in blocks {
        let (left, top) = (lattice.x(block.column), lattice.y(block.row + block.high));
        let wide = lattice.x(block.column + block.wide) - left;
        let high = lattice.y(block.row) - top;
        let (right, down) = (decimal(left - x), decimal(top - y));
        // A sign parts numbers as well as a space does.
        let gap = if down.starts_with('-') { "" } else { " " };
        let (wide, high, back) = (decimal(wide), decimal(high), decimal(-wide));
        let _ = write!(path, "m{right}{gap}{down}h{wide}v{high}h{back}z");
        (x, y) = (left, top);
    }
    path
}

/// A square of equal cells by its last column and its last row.
#[derive(Clone, Copy)]
struct Square {
    column: usize,
    row: usize,
    side: usize,
}

/// The largest square of each kind, the first of equal ones.
fn largest(cells: &Cells) -> BTreeMap<Shade, Square> {
    let mut found: BTreeMap<Shade, Square> = BTreeMap::new();
    let mut below: Vec<usize> = vec![];
    for (row, line) in cells.rows().enumerate() {
        let sides = sides(cells, row, line.len(), &below);
        for (column, side) in sides.iter().copied().enumerate() {
            let shade = cells.at(column, row);
            let least = found.get(&shade).map_or(0, |square| square.side);
            if matches!(shade, Shade::Kind(_)) && side > least {
                found.insert(shade, Square { column, row, side });
            }
        }
        below = sides;
    }
    found
}

/// Of each cell of a row the side of the largest square of equal cells whose last row and column it is in, from
/// those of the row below.
fn sides(cells: &Cells, row: usize, count: usize, below: &[usize]) -> Vec<usize> {
    let mut sides: Vec<usize> = vec![];
    for column in 0..count {
        let inner = column.checked_sub(1).zip(row.checked_sub(1));
        let side = inner.and_then(|(left, under)| {
            let shade = cells.at(column, row);
            let around = [(left, row), (column, under), (left, under)];
            let equal = around
                .iter()
                .all(|(column, row)| cells.at(*column, *row) == shade);
            let three = [sides.last(), below.get(column), below.get(left)];
            let least = three.into_iter().flatten().min().copied();
            equal.then_some(least.unwrap_or(0))
        });
        sides.push(1 + side.unwrap_or(0));
    }
    sides
}

/// The sizes of letters that are tried in a map.
const SIZES: [f64; 2] = [11.0, 10.0];

/// What must be free around a name, in pixels.
const MARGIN: f64 = 2.0;

fn draw_name(out: &mut String, name: &str, cells: &Cells, square: Square, lattice: &Lattice) {
    let fitting = SIZES.into_iter().find_map(|size| {
        let pixels = (text::width(name, size) + 2.0 * MARGIN, size + MARGIN);
        Some((size, free_place(cells, square, lattice, pixels)?))
    });
    if let Some((size, (x, y))) = fitting {
        // The middle of capitals is this far above the line they stand on.
        let y = y + 0.36 * size;
        let _ = writeln!(
            out,
            "<text class=\"region\" style=\"font-size:{size}px\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>",
            text::escaped(name)
        );
    }
}

/// The middle of a rectangle at least so wide and high, in pixels, that holds equal cells only: some rows of the square,
/// middle ones if they do, as far as they reach to either side.
fn free_place(
    cells: &Cells,
    square: Square,
    lattice: &Lattice,
    (wide, high): (f64, f64),
) -> Option<(f64, f64)> {
    let rows = (high / lattice.high.abs()).ceil().max(1.0) as usize;
    let spare = square.side.checked_sub(rows)?;
    let lowest = square.row + 1 - square.side;
    let mut firsts: Vec<usize> = (lowest..=lowest + spare).collect();
    firsts.sort_by_key(|first| first.abs_diff(lowest + spare / 2));
    firsts.into_iter().find_map(|first| {
        let (left, right) = reach(cells, square, first..first + rows)?;
        let x = lattice.left + lattice.wide * f64::midpoint(left as f64, right as f64);
        let y = lattice.bottom - lattice.high * (first as f64 + rows as f64 / 2.0);
        ((right - left) as f64 * lattice.wide.abs() >= wide).then_some((x, y))
    })
}

/// From which column to before which all cells in these rows are of the square's shade.
fn reach(cells: &Cells, square: Square, rows: Range<usize>) -> Option<(usize, usize)> {
    let shade = cells.at(square.column, square.row);
    let alike = |column: &usize| rows.clone().all(|row| cells.at(*column, row) == shade);
    let right = (square.column..cells.columns).take_while(alike).last()?;
    let left = (0..=square.column).rev().take_while(alike).last()?;
    Some((left, right + 1))
}
