//! Time of parsing and of exact and interval evaluation, on formulas of the size that claims have.
//!
//! `make bench`; results are compared with those of the last run on the same machine.

use claimcheck::evaluate::{self, Context};
use claimcheck::formula::{Budget, Point, Rational, parse_formula, parse_statement};
use claimcheck::model::{Layout, moments};
use criterion::{Criterion, criterion_group, criterion_main};
use rug::Integer;
use std::hint::black_box;

const VARIANCE: &str = "I^2*k^2*((-m*Va + Va - l*V + V)*hyp2f1(1, l; m+1; -V/Va) + Va*m)/(Va^2*(Va + V)) \
                        - I^2*k^2*hyp2f1(1, l; m+1; -V/Va)^2/Va^2";

const EXPANSION: &str = "I*k*ln(k/(k-1)) == I + I/(2*k) + I/(3*k^2) + O((1/k)^3) as k -> inf";

fn parsing(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("parse");
    group.bench_function("formula", |b| b.iter(|| parse_formula(black_box(VARIANCE))));
    group.bench_function("statement", |b| {
        b.iter(|| parse_statement(black_box(EXPANSION)))
    });
    let formula = parse_formula(VARIANCE).expect("it parses");
    group.bench_function("print", |b| b.iter(|| black_box(&formula).to_string()));
    group.finish();
}

/// One formula at one point, exactly and to 50 and 1000 digits.
fn evaluation(criterion: &mut Criterion) {
    let formula = parse_formula(VARIANCE).expect("it parses");
    let mut point = Point::default();
    for (name, value) in [
        ("I", 1),
        ("k", 55),
        ("l", 10),
        ("m", 10),
        ("V", 10),
        ("Va", 45),
    ] {
        point
            .numbers
            .insert(name.into(), Rational::from_integer(value.into()));
    }
    let mut group = criterion.benchmark_group("evaluate");
    let run = |evaluate: &dyn Fn(&Context)| {
        let budget = Budget::new(u64::MAX);
        evaluate(&Context {
            point: &point,
            draws: &[],
            budget: &budget,
        });
    };
    group.bench_function("exact", |b| {
        b.iter(|| run(&|context| drop(evaluate::exact(black_box(&formula), context))))
    });
    for digits in [50, 1000] {
        group.bench_function(format!("{digits} digits"), |b| {
            b.iter(|| run(&|context| drop(evaluate::ladder(black_box(&formula), context, digits))))
        });
    }
    group.finish();
}

fn model(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("moments");
    for k in [10u32, 1_000, 20_000] {
        let k = Integer::from(k);
        let shell = Layout::Triangular.shell(&k).expect("every k has a shell");
        group.bench_function(format!("k = {k}"), |b| {
            b.iter(|| moments(black_box(&k), &shell))
        });
    }
    group.finish();
}

criterion_group!(benches, parsing, evaluation, model);
criterion_main!(benches);
