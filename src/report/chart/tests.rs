use super::*;

fn chart(scale: Scale, points: Vec<[f64; 2]>) -> String {
    let axis = |label: &str, scale| Axis {
        label: label.into(),
        scale,
    };
    Chart {
        title: "a < b & c".into(),
        notes: vec!["word ".repeat(60)],
        columns: 1,
        key: vec![],
        levels: String::new(),
        panels: vec![Panel {
            title: String::new(),
            x: axis("x", scale),
            y: axis("y", scale),
            series: vec![
                Series {
                    name: "line".into(),
                    marks: Marks::Line(points.clone()),
                    look: 8,
                },
                Series {
                    name: "dots".into(),
                    marks: Marks::Dots(points),
                    look: 1,
                },
            ],
        }],
    }
    .to_svg()
}

#[test]
fn what_has_no_place_is_left_out() {
    let nan = f64::NAN;
    for scale in [Scale::Linear, Scale::Log] {
        for points in [
            vec![],
            vec![[1.0, 1.0]],
            vec![[0.0, -1.0], [nan, 2.0], [3.0, f64::INFINITY]],
            vec![[1e-300, 1e300], [1e300, 1e-300]],
            vec![[-1e308, -1e308], [1e308, 1e308]],
        ] {
            let svg = chart(scale, points);
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(svg.contains("a &lt; b &amp; c") && svg.ends_with("</svg>\n"));
        }
    }
}

#[test]
fn a_line_breaks_where_there_is_no_number() {
    let svg = chart(
        Scale::Linear,
        vec![[0.0, 0.0], [1.0, f64::NAN], [2.0, 1.0], [3.0, 2.0]],
    );
    let path = svg
        .split("<path d=\"M")
        .filter(|part| part.contains('L'))
        .collect::<Vec<_>>();
    assert!(
        path.iter()
            .any(|path| path.split('"').next().is_some_and(|d| d.contains('M')))
    );
}

#[test]
fn axes_have_round_numbers() {
    let svg = chart(Scale::Linear, vec![[0.0, 1.0], [10.0, 1.25]]);
    for label in [">0<", ">2<", ">10<", ">1.05<", ">1.25<"] {
        assert!(svg.contains(label), "{label}");
    }
    let svg = chart(Scale::Log, vec![[1.0, 1e-12], [1e9, 1.0]]);
    assert!(svg.contains(">8</tspan>") && svg.contains("\u{2212}12</tspan>"));
}

/// Two axes with these marks between them.
fn panel(scale: Scale, marks: Marks) -> Panel {
    let axis = |label: &str| Axis {
        label: label.into(),
        scale,
    };
    Panel {
        title: "a panel with a title".into(),
        x: axis("x"),
        y: axis("y"),
        series: vec![Series {
            name: "s & t".into(),
            marks,
            look: 3,
        }],
    }
}

fn cells(columns: usize, cells: Vec<Shade>) -> Cells {
    Cells {
        x: [1.0, 10.0],
        y: [1.0, 1000.0],
        columns,
        cells,
    }
}

fn shades() -> Vec<Shade> {
    let textures = [
        Texture::Rising,
        Texture::Vertical,
        Texture::Horizontal,
        Texture::Dots,
        Texture::Checked,
    ];
    let levels = (0..12).map(Shade::Level);
    let kinds = (0..14).map(Shade::Kind);
    let others = textures
        .map(Shade::Texture)
        .into_iter()
        .chain([Shade::None, Shade::Solid]);
    levels.chain(kinds).chain(others).collect()
}

#[test]
fn every_mark_in_every_number_of_columns_is_drawn_or_left_out() {
    let nan = f64::NAN;
    let odd = [
        vec![],
        vec![[1.0, 1.0]],
        vec![[2.0, nan], [nan, 3.0], [f64::INFINITY, 1.0], [-1.0, 0.0]],
        vec![[1e-300, 1e300], [1e300, 1e-300], [-1e308, 1e308]],
    ];
    type Of = fn(Vec<[f64; 2]>) -> Marks;
    let marks: [Of; 5] = [
        Marks::Line,
        Marks::Dots,
        Marks::Chain,
        Marks::Front,
        Marks::Rings,
    ];
    let maps = [
        cells(0, shades()),
        cells(7, shades()),
        cells(1000, shades()),
        cells(3, vec![]),
        Cells {
            x: [nan, 1.0],
            y: [0.0, 0.0],
            ..cells(2, shades())
        },
        Cells {
            x: [5.0, 5.0],
            y: [10.0, 1.0],
            ..cells(2, shades())
        },
    ];
    for scale in [Scale::Linear, Scale::Log] {
        for columns in 0..5 {
            let mut panels: Vec<Panel> = maps
                .iter()
                .map(|map| panel(scale, Marks::Cells(map.clone())))
                .collect();
            for points in &odd {
                panels.extend(marks.iter().map(|mark| panel(scale, mark(points.clone()))));
            }
            let key = shades()
                .into_iter()
                .map(|shade| Key {
                    name: "<k>".into(),
                    shade,
                })
                .collect();
            let chart = Chart {
                title: "t".into(),
                columns,
                key,
                levels: "m".into(),
                panels,
                ..Chart::default()
            };
            let svg = chart.to_svg();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(svg.ends_with("</svg>\n") && !svg.contains("<k>"));
        }
    }
}

#[test]
fn every_cell_lies_in_one_block() {
    let mut random = 1u32;
    let mut next = |most: u32| {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (random >> 16) % most
    };
    for _ in 0..200 {
        let (columns, rows) = (1 + next(9) as usize, next(9) as usize);
        let all: Vec<Shade> = (0..columns * rows)
            .map(|_| [Shade::None, Shade::Solid, Shade::Level(3)][next(3) as usize])
            .collect();
        let map = cells(columns, all.clone());
        let mut left = all;
        for block in map.blocks() {
            for row in block.row..block.row + block.high {
                for column in block.column..block.column + block.wide {
                    let cell = &mut left[row * columns + column];
                    assert_eq!(*cell, block.shade);
                    *cell = Shade::None;
                }
            }
        }
        assert!(left.iter().all(|cell| *cell == Shade::None));
    }
    // Equal neighbours are one.
    assert_eq!(cells(20, vec![Shade::Solid; 200]).blocks().len(), 1);
}

#[test]
fn what_panels_share_is_said_once() {
    let map = || panel(Scale::Log, Marks::Cells(cells(2, vec![Shade::Level(0); 4])));
    let line = || panel(Scale::Log, Marks::Chain(vec![[1.0, 2.0], [3.0, 4.0]]));
    let level = |name: &str, level| Key {
        name: name.into(),
        shade: Shade::Level(level),
    };
    let svg = Chart {
        title: "t".into(),
        columns: 2,
        key: vec![level("0\u{2013}2", 0), level("2\u{2013}4", 1)],
        levels: "digits".into(),
        panels: vec![line(), map(), map(), line()],
        ..Chart::default()
    }
    .to_svg();
    for once in ["s &amp; t", ">0\u{2013}2<", ">2\u{2013}4<", ">digits<"] {
        assert_eq!(svg.matches(once).count(), 1, "{once}");
    }
    // Plots side by side lie apart, on the page.
    let mut lefts: Vec<f64> = svg
        .split("<clipPath")
        .skip(1)
        .filter_map(|part| part.split(" x=\"").nth(1)?.split('"').next()?.parse().ok())
        .collect();
    assert_eq!(lefts.len(), 4);
    lefts.sort_by(f64::total_cmp);
    lefts.dedup();
    assert!(lefts.len() == 2 && lefts[0] + 327.0 < lefts[1] && lefts[1] + 327.0 < 800.0);
}

#[test]
fn the_name_of_a_kind_stands_in_its_region() {
    let key = vec![Key {
        name: "kind".into(),
        shade: Shade::Kind(2),
    }];
    let chart = |cells| Chart {
        columns: 2,
        key: key.clone(),
        panels: vec![panel(Scale::Log, Marks::Cells(cells))],
        ..Chart::default()
    };
    let large = chart(cells(10, vec![Shade::Kind(2); 100])).to_svg();
    assert_eq!(large.matches(">kind<").count(), 2);
    // No room for it.
    let mut small = vec![Shade::Solid; 10_000];
    small[5000] = Shade::Kind(2);
    assert_eq!(
        chart(cells(100, small)).to_svg().matches(">kind<").count(),
        1
    );
}
