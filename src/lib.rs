//! Checks the formulas of a paper: every claim gets a verdict that carries its evidence.
//!
//! # The floors
//!
//! A file imports only from floors below its own (`tests/floors.rs` sees to it):
//!
//! `cli > report > corpus > judge > prover > probe, simulate, measure > evaluate > special > model > algebra > number >
//! kernel > book > formula`
//!
//! [`formula`], [`book`] and [`kernel`] use no C library and are trusted; the kernel imports
//! `formula` only. Everything above searches, with GMP and MPFR (feature `engine`), and is never
//! believed: what it finds, the kernel checks.
//!
//! # The life of a claim
//!
//! Equation 2.61 of the thesis lacks a sign. The [`book`] reads its claim from Markdown and unfolds its
//! definitions to a [`formula::Proposition`]:
//!
//! ~~~
//! let chapter = "
//! ```claim 2.61
//! given  real Va >= 0, V > 0
//! let    Vb = Va + V
//! says   hyp2f1r(1, 1; 2; V/Va) == Va*ln(Vb/Va)/V
//! mend   hyp2f1r(1, 1; 2; -V/Va) == Va*ln(Vb/Va)/V
//! expect printed refuted, mended certified
//! ```
//! ";
//! let book = claimcheck::book::read_text("chapter.md", chapter).expect("a claim");
//! let printed = book.claims[0].printed().expect("well typed");
//! assert_eq!(
//!     printed.statement.to_string(),
//!     "hyp2f1r(1, 1; 2; V/Va) == Va*ln((Va + V)/Va)/V"
//! );
//!
//! // The kernel values both sides at a point in rational arithmetic; they lie apart, so the
//! // statement is refuted. Nothing but this function makes a refutation.
//! use claimcheck::formula::{Point, Rational};
//! let number = |n: i32, d: i32| Rational::new(n.into(), d.into());
//! let mut point = Point::default();
//! point.numbers.insert("Va".into(), number(1, 1));
//! point.numbers.insert("V".into(), number(1, 2));
//! let witness = claimcheck::kernel::Witness { point, link: 0 };
//! let refutation = claimcheck::kernel::check_witness(&printed, &witness).expect("it fails there");
//! assert_eq!(refutation.because(), claimcheck::kernel::Because::Disjoint);
//! ~~~
//!
//! Finding such a point is the work of the upper floors. The judge tries small points of the
//! domain in order of size, then random ones; `evaluate` sees each side as an exact number
//! (`number::Exact`, here `2*ln(2)` against `2*ln(3) - 2*ln(2)`), or else as an interval rounded outward
//! (`number::Interval`, with `special` for 2F1 and Gamma); a failing point goes to the kernel as a
//! witness. Expansions go to `prover`, which compares exact series over `algebra`. `corpus` runs a
//! whole book and compares with what each claim expects; `report` and `cli` put it into words:
//!
//! ~~~
//! # #[cfg(feature = "engine")] {
//! # let chapter = "
//! # ```claim 2.61
//! # given  real Va >= 0, V > 0
//! # let    Vb = Va + V
//! # says   hyp2f1r(1, 1; 2; V/Va) == Va*ln(Vb/Va)/V
//! # mend   hyp2f1r(1, 1; 2; -V/Va) == Va*ln(Vb/Va)/V
//! # expect printed refuted, mended proved
//! # ```
//! # ";
//! # let book = claimcheck::book::read_text("chapter.md", chapter).expect("a claim");
//! use claimcheck::judge::{Settings, Verdict, judge};
//! let report = judge(&book.claims[0], None, &Settings::default());
//! assert_eq!(report.printed.verdict, Verdict::Refuted);
//! assert_eq!(report.mended.expect("it has a mend").verdict, Verdict::Proved);
//! assert!(report.as_expected);
//! # }
//! ~~~
#![deny(unsafe_code)]

pub mod book;
pub mod formula;
pub mod kernel;

#[cfg(feature = "engine")]
pub mod algebra;
#[cfg(feature = "engine")]
pub mod evaluate;
#[cfg(feature = "engine")]
pub mod judge;
#[cfg(feature = "engine")]
pub mod measure;
#[cfg(feature = "engine")]
pub mod model;
#[cfg(feature = "engine")]
pub mod number;
#[cfg(feature = "engine")]
pub mod probe;
#[cfg(feature = "engine")]
pub mod prover;
#[cfg(feature = "engine")]
pub mod simulate;
#[cfg(feature = "engine")]
pub mod special;

pub mod cli;
pub mod corpus;
pub mod report;
