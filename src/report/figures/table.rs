//! What is drawn in each figure.

use super::{Figure, Number, Of, Panel, Photons, Series, What};
use crate::model::Layout;
use crate::report::chart::Scale::{self, Linear, Log};
use crate::simulate::{Mode, Scene};
use Layout::{Listing, One, Triangular};
use Photons::{All, Thinned};
use What::{AroundOne, Excess, Mean, Score, Variance};

const MEAN: &str = "mean of k/U";
/// Of one run, or a mean.
const VALUE: &str = "k/U";
const EXCESS: &str = "mean of k/U, less 1";
const VARIANCE: &str = "variance of k/U";
const SCORE: &str = "standard errors from theory";

/// The expansions of section 2.4.4: of E_k less 1, and of Var_k.
const EXCESS_EXPANDED: &str = "(l - l*V/(m+1))/k \
    + (-(2*l^2)*V/(m+1) + l^2 + l*(l+1)*V^2/((m+1)*(m+2)))/k^2";
const VARIANCE_EXPANDED: &str = "l*V^2*(-l+m+1)/(k^2*(m+1)^2*(m+2)) \
    - 4*(l*V^2*(l-m-1)*(l*(m-V+3)-V))/(k^3*((m+1)^2*(m+2)*(m+3)))";

const LISTING: &str = "The listing on page 22 starts with k = 1 and raises it before it is used: its shells hold \
    1, 1, 2, 3, ... photons, a unit of volume more than in strategy 2 lies inside each, and photon 1 is never computed.";
const SHIFTED: &str = "What it gives for k differs from photon k of strategy 2: each minimum and maximum stands one \
    photon later.";
const CANCELS: &str = "The thesis's formula of the variance cancels: computed in doubles it keeps some eight digits at k = 1000, \
    more than can be seen here.";
const THINNED: &str =
    "Drawn are all photons to 50, beyond them some, each in the middle of its shell.";
const SCORES: &str = "A standard error is the root of Var_k over the runs: some 95 of 100 marks should lie between -2 and 2. \
    Neighbours in a shell vary together.";
const RADII: &str = "Radii are drawn and U is r^d; each dimension has a seed of its own.";
const AROUND: &str =
    "The fast method takes squares around the true value 1, and so comes to Var_k + (E_k - 1)^2.";

/// All figures with curves of chapter 2, and all of chapter 3, in their order. Figure 2.13 is the caption of 2.9 to 2.12.
///
/// ```
/// let numbers: Vec<String> =
///     claimcheck::report::figures::figures().iter().map(|figure| figure.number.to_string()).collect();
/// assert_eq!((numbers.len(), &*numbers[0], &*numbers[22]), (23, "2.9", "3.15"));
/// ```
pub fn figures() -> Vec<Figure> {
    let mut all = calculated();
    all.extend(simulated_means());
    all.extend(simulated_variances());
    all
}

/// Chapter 2.
fn calculated() -> Vec<Figure> {
    let both = |photons, label, scale, expression| Panel {
        photons,
        along: Linear,
        label,
        scale,
        series: vec![
            line("strategy 2", Triangular, expression),
            line("the listing", Listing, expression),
        ],
    };
    let bounds = |number, title, first, last| Figure {
        number: Number(2, number),
        title,
        notes: vec![
            "The conjecture of the chapter: for k > 3 the mean lies between 1 + 1/k^2 and 1 + 1/k.",
        ],
        panels: vec![panel(
            All(first, last),
            [Linear, Linear],
            MEAN,
            vec![
                line("strategy 2", Triangular, "E_k"),
                line("1 + 1/k", Triangular, "1 + 1/k"),
                line("1 + 1/k^2", Triangular, "1 + 1/k^2"),
                line("their average", Triangular, "1 + (1/k + 1/k^2)/2"),
            ],
        )],
    };
    vec![
        Figure {
            number: Number(2, 9),
            title: "Expectation Value of \u{ce}",
            notes: vec![LISTING, SHIFTED],
            panels: vec![
                both(All(2, 1000), MEAN, Linear, "E_k"),
                both(All(2, 1000), EXCESS, Log, "E_k - 1"),
            ],
        },
        Figure {
            number: Number(2, 10),
            title: "Expectation value for small k",
            notes: vec![LISTING, SHIFTED],
            panels: vec![both(All(2, 50), MEAN, Linear, "E_k")],
        },
        Figure {
            number: Number(2, 11),
            title: "Variance",
            notes: vec![LISTING, SHIFTED, CANCELS],
            panels: vec![both(All(2, 1000), VARIANCE, Log, "Var_k")],
        },
        Figure {
            number: Number(2, 12),
            title: "Variance value for small k",
            notes: vec![LISTING, SHIFTED],
            panels: vec![both(All(2, 50), VARIANCE, Log, "Var_k")],
        },
        Figure {
            number: Number(2, 18),
            title: "Comparison of different the approximations",
            notes: vec![
                "Lines are exact, marks are the approximations as printed: 2.91 and 2.93, 2.97 and 2.99, 2.103 and 2.105. \
                 Without stratification there are n = 100000 photons.",
                "1/k for 2.92 needs n much larger than k as well. 2.103 and 2.105 are right for a fixed shell; as k runs \
                 through the shells the first term left out is larger by sqrt(k), and by k.",
            ],
            panels: vec![
                panel(
                    All(3, 50),
                    [Linear, Log],
                    EXCESS,
                    vec![
                        line("no stratification", One, "1/(k-1)"),
                        line("strategy 1", One, "E_k - 1"),
                        line("strategy 2", Triangular, "E_k - 1"),
                        dots("1 + 1/k", One, "1/k"),
                        dots("1 + 1/(2k) + 1/(3k^2)", One, "1/(2*k) + 1/(3*k^2)"),
                        dots("expansion 2.103", Triangular, EXCESS_EXPANDED),
                    ],
                ),
                panel(
                    All(3, 50),
                    [Linear, Log],
                    VARIANCE,
                    vec![
                        line(
                            "no stratification",
                            One,
                            "k^2*(100000-k+1)/((k-2)*(k-1)^2*100000)",
                        ),
                        line("strategy 1", One, "Var_k"),
                        line("strategy 2", Triangular, "Var_k"),
                        dots("1/k", One, "1/k"),
                        dots("1/(12k^2)", One, "1/(12*k^2)"),
                        dots("expansion 2.105", Triangular, VARIANCE_EXPANDED),
                    ],
                ),
            ],
        },
        bounds(19, "Expectation value of stratification strategy 2", 4, 150),
        bounds(
            20,
            "Expectation value of stratification strategy 2 - k < 50",
            4,
            49,
        ),
        bounds(
            21,
            "Expectation value of stratification strategy 2 - k > 50",
            51,
            150,
        ),
    ]
}

/// Chapter 3 up to its section on the variance.
fn simulated_means() -> Vec<Figure> {
    let basic = |number, title, layout: fn() -> Layout, runs| Figure {
        number: Number(3, number),
        title,
        notes: vec!["Photon 1 is left out: its mean is infinite."],
        panels: vec![panel(
            All(2, 150),
            [Linear, Linear],
            VALUE,
            vec![
                line("theory", layout(), "E_k"),
                line("true value", layout(), "1"),
                drawn("one run", Mean, scene(layout(), 150, 1, 1)),
                drawn("mean", Mean, scene(layout(), 150, runs, 2)),
            ],
        )],
    };
    let reruns = |runs, seed| {
        panel(
            All(2, 150),
            [Linear, Linear],
            MEAN,
            vec![
                line("theory", Triangular, "E_k"),
                drawn("mean", Mean, scene(Triangular, 150, runs, seed)),
            ],
        )
    };
    let dimensions = |number, title, layout: fn() -> Layout, photons| {
        let series = |what| {
            let one = |name, dimension| {
                let scene = scene(layout(), photons, 10_000, u64::from(dimension));
                // The thesis's way: radii, sorted.
                let scene = Scene {
                    dimension: Some(dimension),
                    mode: Mode::Sorted,
                    ..scene
                };
                drawn(name, what, scene)
            };
            vec![one("1D", 1), one("2D", 2), one("3D", 3)]
        };
        Figure {
            number: Number(3, number),
            title,
            notes: vec![RADII, THINNED, SCORES],
            panels: means_and_scores(layout(), photons, series),
        }
    };
    let numbers = |number, title, layout: fn() -> Layout, photons: [(&'static str, u64); 3]| {
        let last = photons[2].1;
        let series = |what| numbers_of_photons(layout, photons, what);
        Figure {
            number: Number(3, number),
            title,
            notes: vec![THINNED, SCORES],
            panels: means_and_scores(layout(), last, series),
        }
    };
    vec![
        basic(1, "Simulation - Strategy 1 - 100 runs", || One, 100),
        basic(2, "Simulation - Strategy 2 - 200 runs", || Triangular, 200),
        basic(
            3,
            "Simulation - Strategy 2 - 1000 runs",
            || Triangular,
            1000,
        ),
        Figure {
            number: Number(3, 4),
            title: "Comparison of different number of reruns to average over",
            notes: vec!["Strategy 2."],
            panels: vec![
                reruns(10, 1),
                reruns(100, 2),
                reruns(1000, 3),
                reruns(10_000, 4),
            ],
        },
        dimensions(
            5,
            "Comparison of different dimensions - Strategy 1",
            || One,
            100_000,
        ),
        dimensions(
            6,
            "Comparison of different dimensions - Strategy 2",
            || Triangular,
            80_200,
        ),
        numbers(
            7,
            "Comparison of different number of photons - Strategy 1",
            || One,
            ANY_NUMBERS,
        ),
        numbers(
            8,
            "Comparison of different number of photons - Strategy 2",
            || Triangular,
            WHOLE_SHELLS,
        ),
    ]
}

/// The section on the variance.
fn simulated_variances() -> Vec<Figure> {
    let methods = |layout: fn() -> Layout, photons, along| {
        let scene = scene(layout(), 1000, 10_000, 1);
        panel(
            photons,
            [along, Log],
            VARIANCE,
            vec![
                line("Var_k", layout(), "Var_k"),
                line("Var_k + (E_k - 1)^2", layout(), "Var_k + (E_k - 1)^2"),
                drawn("around the mean", Variance, scene.clone()),
                drawn("fast", AroundOne, scene),
            ],
        )
    };
    let basic = |number, title, layout: fn() -> Layout, runs| Figure {
        number: Number(3, number),
        title,
        notes: vec!["Squares around the mean of the runs."],
        panels: vec![panel(
            All(2, 150),
            [Linear, Log],
            VARIANCE,
            vec![
                line("theory", layout(), "Var_k"),
                drawn("simulated", Variance, scene(layout(), 150, runs, 1)),
            ],
        )],
    };
    let numbers = |number, title, layout: fn() -> Layout, photons: [(&'static str, u64); 3]| {
        let mut series = vec![line("theory", layout(), "Var_k")];
        series.extend(numbers_of_photons(layout, photons, Variance));
        Figure {
            number: Number(3, number),
            title,
            notes: vec![THINNED],
            panels: vec![panel(
                Thinned(2, photons[2].1),
                [Log, Log],
                VARIANCE,
                series,
            )],
        }
    };
    vec![
        Figure {
            number: Number(3, 9),
            title: "Comparison of different methods in general",
            notes: vec![
                "Strategy 1. Both methods have the same runs and the same mean.",
                AROUND,
                "Here this is some four times Var_k, for large k as well.",
                THINNED,
            ],
            panels: vec![
                panel(
                    Thinned(2, 1000),
                    [Log, Log],
                    EXCESS,
                    vec![
                        line("theory", One, "E_k - 1"),
                        drawn("simulated", Excess, scene(One, 1000, 10_000, 1)),
                    ],
                ),
                methods(|| One, Thinned(2, 1000), Log),
            ],
        },
        numbers(
            10,
            "Comparison of different numbers of photons - Variance - Strategy 1",
            || One,
            ANY_NUMBERS,
        ),
        basic(11, "Simulation - Strategy 1 - 1000 runs", || One, 1000),
        basic(
            12,
            "Simulation - Strategy 2 - 1000 runs",
            || Triangular,
            1000,
        ),
        Figure {
            number: Number(3, 13),
            title: "Comparison of different methods to calculate Variance",
            notes: vec!["Strategy 2.", AROUND],
            panels: vec![methods(|| Triangular, All(2, 100), Linear)],
        },
        basic(
            14,
            "Simulation - Strategy 2 - 10 000 runs",
            || Triangular,
            10_000,
        ),
        numbers(
            15,
            "Comparison of different numbers of photons - Variance - Strategy 2",
            || Triangular,
            WHOLE_SHELLS,
        ),
    ]
}

/// Numbers of photons for strategy 1.
const ANY_NUMBERS: [(&str, u64); 3] = [
    ("1000 photons", 1000),
    ("10000 photons", 10_000),
    ("100000 photons", 100_000),
];

/// For strategy 2: 44, 141 and 400 shells.
const WHOLE_SHELLS: [(&str, u64); 3] = [
    ("990 photons", 990),
    ("10011 photons", 10_011),
    ("80200 photons", 80_200),
];

fn numbers_of_photons(
    layout: fn() -> Layout,
    photons: [(&'static str, u64); 3],
    what: What,
) -> Vec<Series> {
    let series = photons.into_iter().zip(1..);
    let series = series
        .map(|((name, photons), seed)| drawn(name, what, scene(layout(), photons, 10_000, seed)));
    series.collect()
}

/// The means of near photons beside theory, and how far all lie from it.
fn means_and_scores(
    layout: Layout,
    photons: u64,
    series: impl Fn(What) -> Vec<Series>,
) -> Vec<Panel> {
    let mut scores = vec![line("theory", layout.clone(), "0")];
    scores.extend(series(Score));
    let mut means = vec![line("theory", layout, "E_k")];
    means.extend(series(Mean));
    vec![
        panel(All(2, 150), [Linear, Linear], MEAN, means),
        panel(Thinned(2, photons), [Log, Linear], SCORE, scores),
    ]
}

fn panel(
    photons: Photons,
    [along, scale]: [Scale; 2],
    label: &'static str,
    series: Vec<Series>,
) -> Panel {
    Panel {
        photons,
        along,
        label,
        scale,
        series,
    }
}

fn line(name: &'static str, layout: Layout, expression: &'static str) -> Series {
    let of = Of::Line(layout, expression);
    Series { name, of }
}

fn dots(name: &'static str, layout: Layout, expression: &'static str) -> Series {
    let of = Of::Dots(layout, expression);
    Series { name, of }
}

fn drawn(name: &'static str, what: What, scene: Scene) -> Series {
    let of = Of::Simulated(what, scene);
    Series { name, of }
}

fn scene(layout: Layout, photons: u64, runs: u64, seed: u64) -> Scene {
    Scene::new(layout, photons, runs, seed)
}
