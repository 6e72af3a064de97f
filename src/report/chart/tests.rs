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
