//! Two evaluators that share no code: the kernel's on num-bigint, the engine's on GMP and MPFR.
//! What both of them know must agree: enclosures overlap, infinities and missing values are alike.
//!
//! `CLAIMCHECK_CROSS_CHECK=1000000` tries as many random formulas; without it some thousands.
#![cfg(feature = "engine")]

#[path = "support/dice.rs"]
mod dice;
#[path = "support/values.rs"]
mod values;

use claimcheck::book::read;
use claimcheck::evaluate::{Context, Failure, Outcome, enclose, exact, holds};
use claimcheck::formula::{
    Budget, Draw, Formula, ParameterKind, Point, Proposition, Rational, Statement, parse_formula,
    parse_law,
};
use claimcheck::kernel::{Unknown, Value, value};
use claimcheck::number::{Interval, convert};
use dice::Dice;
use rayon::prelude::*;
use std::path::PathBuf;

const BITS: u32 = 128;
/// Steps of the engine for one value.
const STEPS: u64 = 400_000;
/// Names that every random formula may use, and what stands for them.
const NAMES: [&str; 6] = ["k", "n", "l", "m", "a", "V"];

/// How often which of the two knew a value.
#[derive(Default)]
struct Tally {
    both: usize,
    kernel_only: usize,
    engine_only: usize,
    neither: usize,
    /// Of those that both know, the ones without a finite value.
    special: usize,
    disagreements: Vec<String>,
}

impl Tally {
    fn merged(mut self, other: Tally) -> Tally {
        self.both += other.both;
        self.kernel_only += other.kernel_only;
        self.engine_only += other.engine_only;
        self.neither += other.neither;
        self.special += other.special;
        self.disagreements.extend(other.disagreements);
        self
    }

    fn report(&self, of: &str) {
        println!(
            "{of}: {} known to both ({} of them infinite or without value), {} to the kernel only, \
             {} to the engine only, {} to neither; {} disagreements",
            self.both,
            self.special,
            self.kernel_only,
            self.engine_only,
            self.neither,
            self.disagreements.len()
        );
        let shown = self.disagreements.iter().take(40).cloned();
        assert!(
            self.disagreements.is_empty(),
            "{}",
            shown.collect::<Vec<_>>().join("\n")
        );
    }
}

fn cases() -> u64 {
    let wanted = std::env::var("CLAIMCHECK_CROSS_CHECK").ok();
    wanted.and_then(|n| n.parse().ok()).unwrap_or(4000)
}

/// Deep trees recurse deeply in a build without optimisation.
fn on_large_stacks<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().stack_size(64 << 20);
    pool.build().expect("threads").install(work)
}

/// Whether the kernel's value is consistent with one of the engine's.
fn agrees(kernel: &Value, engine: &Outcome<Interval>) -> bool {
    match (kernel, engine) {
        (Value::Finite { low, high }, Outcome::Value(interval)) => {
            let end = |q| Interval::from_rational(&convert::to_rug(q), 4 * BITS);
            end(low).hull(&end(high)).overlaps(interval)
        }
        (Value::PlusInfinity, Outcome::PlusInfinity)
        | (Value::MinusInfinity, Outcome::MinusInfinity)
        | (Value::Undefined, Outcome::Undefined) => true,
        _ => false,
    }
}

fn compare(tree: &Formula, point: &Point, draws: &[Draw], tally: &mut Tally) {
    let found = value(tree, point, draws, BITS);
    let budget = Budget::new(STEPS);
    let context = Context {
        point,
        draws,
        budget: &budget,
    };
    let exactly = exact(tree, &context).map(|outcome| outcome.map(|x| x.enclose(2 * BITS)));
    let budget = Budget::new(STEPS);
    let context = Context {
        budget: &budget,
        ..context
    };
    let enclosed = enclose(tree, &context, BITS);
    if exactly.is_err() && enclosed.is_err() {
        match found {
            Ok(_) => tally.kernel_only += 1,
            Err(_) => tally.neither += 1,
        }
        return;
    }
    let Ok(kernel) = &found else {
        tally.engine_only += 1;
        return;
    };
    tally.both += 1;
    tally.special += usize::from(!matches!(kernel, Value::Finite { .. }));
    for engine in [&exactly, &enclosed].into_iter().flatten() {
        if !agrees(kernel, engine) {
            let line = described(tree, point, &found, &exactly, &enclosed);
            tally.disagreements.push(line);
            break;
        }
    }
}

fn described(
    tree: &Formula,
    point: &Point,
    kernel: &Result<Value, Unknown>,
    exactly: &Result<Outcome<Interval>, Failure>,
    enclosed: &Result<Outcome<Interval>, Failure>,
) -> String {
    let short = |text: String| text.chars().take(160).collect::<String>();
    let numbers: Vec<String> = point
        .numbers
        .iter()
        .map(|(name, q)| format!("{name}={q}"))
        .collect();
    format!(
        "{tree}   at {}\n  kernel {}\n  exact {}\n  enclosed {}",
        numbers.join(" "),
        short(format!("{kernel:?}")),
        short(format!("{exactly:?}")),
        short(format!("{enclosed:?}")),
    )
}

fn random_case(seed: u64) -> Tally {
    let mut dice = Dice(seed.wrapping_mul(0x5851_f42d_4c95_7f2d));
    let mut tally = Tally::default();
    let mut point = Point::default();
    for (i, name) in NAMES.into_iter().enumerate() {
        let number: Rational = dice.number(i < 4).parse().expect("a fraction");
        point.numbers.insert(name.into(), number);
    }
    let law = |text| parse_law(text).expect(text);
    let draws = [
        Draw {
            name: "x".into(),
            law: law("beta(l, m - l + 1)"),
        },
        Draw {
            name: "y".into(),
            law: law("uniform(a, a + V)"),
        },
    ];
    let depth = 1 + dice.roll(3) as u32;
    let text = dice.formula(depth, &NAMES);
    let tree = parse_formula(&text).unwrap_or_else(|why| panic!("{text}: {why:?}"));
    compare(&tree, &point, &draws, &mut tally);
    tally
}

#[test]
fn random_formulas_have_one_value() {
    let tally = on_large_stacks(|| {
        let all = (0..cases()).into_par_iter().map(random_case);
        all.reduce(Tally::default, Tally::merged)
    });
    tally.report("random formulas");
    assert!(3 * tally.both > cases() as usize, "too few cases are known");
}

/// All formulas that a statement relates, or defines.
fn sides(statement: &Statement) -> Vec<&Formula> {
    match statement {
        Statement::Chain { first, links, .. } => {
            let rights = links.iter().map(|(_, right)| right);
            std::iter::once(first).chain(rights).collect()
        }
        Statement::All(parts) => parts.iter().flat_map(sides).collect(),
        Statement::Definition { body, .. } => vec![body],
        _ => Vec::new(),
    }
}

/// A point of the domain, and a value for the arguments of a definition; `None` if none is found.
fn point_of(proposition: &Proposition, dice: &mut Dice) -> Option<Point> {
    for _ in 0..60 {
        let mut point = Point::default();
        for parameter in &proposition.parameters {
            let name = parameter.name.clone();
            if let ParameterKind::Function { argument, .. } = &parameter.kind {
                let bodies = ["1", "2*t", "3*t^2", "t - t^2", "6*t - 6*t^2"];
                let body = bodies[dice.roll(5) as usize].replace('t', argument);
                let body = parse_formula(&body).expect("a polynomial");
                point.functions.insert(name, (argument.clone(), body));
            } else {
                let integer = parameter.kind == ParameterKind::Integer;
                let number = dice.number(integer).parse().expect("a fraction");
                point.numbers.insert(name, number);
            }
        }
        let budget = Budget::new(STEPS);
        let context = Context {
            point: &point,
            draws: &proposition.draws,
            budget: &budget,
        };
        if proposition
            .domain
            .iter()
            .all(|condition| holds(condition, &context) == Ok(true))
        {
            return Some(point);
        }
    }
    None
}

fn claim_points(proposition: &Proposition, points: u64) -> Tally {
    let mut tally = Tally::default();
    let mut dice = Dice(points);
    for _ in 0..points {
        let Some(mut point) = point_of(proposition, &mut dice) else {
            break;
        };
        if let Statement::Definition { arguments, .. } = &proposition.statement {
            for argument in arguments {
                let number = dice.number(false).parse().expect("a fraction");
                point.numbers.insert(argument.clone(), number);
            }
        }
        for side in sides(&proposition.statement) {
            compare(side, &point, &proposition.draws, &mut tally);
        }
    }
    tally
}

#[test]
fn both_sides_of_every_claim_have_one_value() {
    let book = read(&[PathBuf::from("proofs")]).unwrap_or_else(|errors| panic!("{errors:?}"));
    let mut propositions: Vec<Proposition> = Vec::new();
    for claim in &book.claims {
        propositions.extend(claim.printed());
        propositions.extend(claim.mended().into_iter().flatten());
    }
    let points = (cases() / 1000).max(4);
    let tally = on_large_stacks(|| {
        let all = propositions.par_iter().map(|p| claim_points(p, points));
        all.reduce(Tally::default, Tally::merged)
    });
    tally.report("sides of claims");
    assert!(tally.both > tally.engine_only, "too few sides are known");
}
