//! Verdicts on expansions against numbers: `|L - S|/g` at k = 10^3 .. 10^12, by the evaluator, which
//! shares nothing with the series of the prover; and against what was worked out by hand.
#![cfg(feature = "engine")]

mod expansions;

use claimcheck::evaluate::{Context, Outcome, enclose, ladder};
use claimcheck::formula::{
    Budget, Formula, Name, Operator, Point, Proposition, Rational, Regime, Relation, Statement,
    Target, parse_formula, parse_proposition,
};
use claimcheck::prover::{ExpansionVerdict, judge_expansion};
use expansions::{Case, Truth};

/// Exponents of ten at which the large variable is put.
const SIZES: [u32; 4] = [3, 6, 9, 12];

struct Read {
    proposition: Proposition,
    left: Formula,
    relation: Relation,
    right: Formula,
    regime: Regime,
}

fn read(text: &str) -> Read {
    let proposition = parse_proposition(text).unwrap_or_else(|e| panic!("{text}: {e}"));
    let Statement::Chain {
        first,
        links,
        regime,
    } = proposition.statement.clone()
    else {
        panic!("no chain: {text}")
    };
    let (relation, right) = links[0].clone();
    Read {
        proposition,
        left: first,
        relation,
        right,
        regime: regime.unwrap_or_else(|| panic!("no regime: {text}")),
    }
}

/// The summands of the right side with their signs, read anew.
fn parts(formula: &Formula, plus: bool, found: &mut Vec<(bool, Formula)>) {
    match formula {
        Formula::Binary(Operator::Add, a, b) => {
            parts(a, plus, found);
            parts(b, plus, found);
        }
        Formula::Binary(Operator::Subtract, a, b) => {
            parts(a, plus, found);
            parts(b, !plus, found);
        }
        Formula::Negate(a) => parts(a, !plus, found),
        other => found.push((plus, other.clone())),
    }
}

impl Read {
    /// `L - S`, the gauges, and whether they are for `o`.
    fn comparison(&self) -> (Formula, Vec<Formula>, bool) {
        let mut found = Vec::new();
        parts(&self.right, true, &mut found);
        let (mut rest, mut gauges) = (self.left.clone(), Vec::new());
        let mut little = self.relation != Relation::Equal;
        let last = found.last().map(|(_, term)| term.clone());
        for (plus, term) in found {
            match term {
                Formula::BigO(gauge) => gauges.push(*gauge),
                Formula::LittleO(gauge) => {
                    little = true;
                    gauges.push(*gauge);
                }
                term => {
                    let operator = if plus {
                        Operator::Subtract
                    } else {
                        Operator::Add
                    };
                    rest = Formula::binary(operator, rest, term);
                }
            }
        }
        match self.relation {
            Relation::Asymptotic => gauges.push(self.right.clone()),
            Relation::Approximate => gauges.extend(last),
            _ => {}
        }
        (rest, gauges, little)
    }

    /// `|L - S|/(|g1| + |g2| + ..)` at a point; nothing where the evaluator has no number.
    fn ratio(&self, point: &Point) -> Option<f64> {
        let (difference, gauges, _) = self.comparison();
        let above = self.size(&difference, point)?;
        let below: Option<Vec<_>> = gauges.iter().map(|g| self.size(g, point)).collect();
        let below = below?.into_iter().reduce(|a, b| a + b)?;
        Some((above / below).to_f64())
    }

    fn size(&self, formula: &Formula, point: &Point) -> Option<rug::Float> {
        let budget = Budget::new(100_000_000);
        let context = Context {
            point,
            draws: &self.proposition.draws,
            budget: &budget,
        };
        let value = match ladder(formula, &context, 8) {
            Ok(Outcome::Value(value)) => value,
            // A value that is 0 agrees to no number of digits.
            _ => match enclose(formula, &context, 4096) {
                Ok(Outcome::Value(value)) if value.is_bounded() => value,
                _ => return None,
            },
        };
        Some(value.midpoint().abs())
    }
}

fn number(text: &str, point: &Point) -> Rational {
    let formula = parse_formula(text).unwrap_or_else(|e| panic!("{text}: {e}"));
    arithmetic(&formula, point)
}

/// Field operations and whole powers of rationals.
fn arithmetic(formula: &Formula, point: &Point) -> Rational {
    match formula {
        Formula::Number(value) => value.clone(),
        Formula::Name(name) => point.numbers[name].clone(),
        Formula::Negate(value) => -arithmetic(value, point),
        Formula::Binary(operator, left, right) => {
            let (left, right) = (arithmetic(left, point), arithmetic(right, point));
            match operator {
                Operator::Add => left + right,
                Operator::Subtract => left - right,
                Operator::Multiply => left * right,
                Operator::Divide => left / right,
                Operator::Power => left.pow(right.to_string().parse().expect("whole")),
            }
        }
        other => panic!("{other:?} on a path"),
    }
}

/// `name = value, ..` put into a point, later ones first: earlier values are written in them.
fn place(point: &mut Point, text: &str) {
    for step in text
        .split(", ")
        .filter(|step| !step.is_empty())
        .collect::<Vec<_>>()
        .iter()
        .rev()
    {
        let (name, value) = step.split_once('=').expect("name = value");
        let value = number(value.trim(), point);
        point.numbers.insert(name.trim().into(), value);
    }
}

fn ten_to(exponent: u32) -> Rational {
    Rational::from_integer(num_bigint::BigInt::from(10).pow(exponent))
}

/// Where the variable stands when the large quantity is `10^size`.
fn stand(regime: &Regime, variable: &Name, size: u32) -> Rational {
    let target = regime
        .limits
        .iter()
        .flatten()
        .find(|tendency| matches!(&tendency.quantity, Formula::Name(name) if name == variable));
    let at = |formula: &Formula| number(&formula.to_string(), &Point::default());
    match target.map(|tendency| &tendency.target) {
        None | Some(Target::Infinity) => ten_to(size),
        Some(Target::Above(a) | Target::Point(a)) => at(a) + ten_to(size).recip(),
        Some(Target::Below(a)) => at(a) - ten_to(size).recip(),
    }
}

/// The ratios with the values given, the variable going its way.
fn ratios(read: &Read, fixed: &Point, path: &str, variable: &Name) -> Vec<f64> {
    let ratio = |size: &u32| {
        let mut point = fixed.clone();
        point
            .numbers
            .insert(variable.clone(), stand(&read.regime, variable, *size));
        place(&mut point, path);
        read.ratio(&point)
    };
    SIZES.iter().filter_map(ratio).collect()
}

/// The one name that neither the point nor the path gives.
fn moving(read: &Read, fixed: &Point, path: &str) -> Option<Name> {
    let steps: Vec<&str> = path
        .split(", ")
        .filter_map(|step| step.split('=').next())
        .map(str::trim)
        .collect();
    let free = |name: &Name| !fixed.numbers.contains_key(name) && !steps.contains(&&**name);
    let names = read
        .proposition
        .parameters
        .iter()
        .map(|parameter| parameter.name.clone());
    let open: Vec<Name> = names.filter(free).collect();
    match &open[..] {
        [] => path.contains('s').then(|| "s".into()),
        [one] => Some(one.clone()),
        _ => None,
    }
}

fn describe(case: &Case, ratios: &[f64]) -> String {
    format!("{}\n    |L - S|/g = {ratios:?}", case.text())
}

/// Bounded for `O`, falling for `o`.
fn assert_small(case: &Case, read: &Read, ratios: &[f64]) {
    let (_, _, little) = read.comparison();
    let (first, last) = (ratios[0], ratios[ratios.len() - 1]);
    let fits = match little {
        true => last <= first / 2.0 || last < 1e-6,
        false => last <= 3.0 * first + 1e-6,
    };
    assert!(fits, "true, but grows: {}", describe(case, ratios));
}

/// Growing for `O`, not falling to 0 for `o`.
fn assert_large(case: &Case, read: &Read, ratios: &[f64]) {
    let (_, _, little) = read.comparison();
    let (first, last) = (ratios[0], ratios[ratios.len() - 1]);
    let fits = match little {
        true => last >= first / 5.0 && last > 1e-9,
        false => last >= 1.5 * first,
    };
    assert!(fits, "false, but stays small: {}", describe(case, ratios));
}

/// Whether numbers were had.
fn check(case: &Case) -> bool {
    let text = case.text();
    let read = read(&text);
    let budget = Budget::new(200_000_000);
    let start = std::time::Instant::now();
    let verdict = judge_expansion(
        &read.left,
        read.relation,
        &read.right,
        &read.regime,
        &read.proposition,
        &budget,
    );
    println!("{text}\n    {verdict:?} in {:?}", start.elapsed());
    let fits = matches!(
        (&verdict, case.truth),
        (Ok(ExpansionVerdict::Holds { .. }), Truth::Holds)
            | (Ok(ExpansionVerdict::Fails { .. }), Truth::Fails)
            | (Ok(ExpansionVerdict::Vacuous { .. }), Truth::Vacuous)
            | (Err(_), Truth::OpenTrue | Truth::OpenFalse | Truth::Open)
    );
    assert!(fits, "{text}\n    should be {:?}: {verdict:?}", case.truth);
    let mut fixed = Point::default();
    let (path, witness) = match &verdict {
        Ok(ExpansionVerdict::Fails { point, path, .. }) => {
            fixed = point.clone();
            (path.clone().unwrap_or_default(), true)
        }
        _ => {
            place(&mut fixed, case.values);
            (case.path.to_string(), false)
        }
    };
    let Some(variable) = moving(&read, &fixed, &path) else {
        return false;
    };
    let found = match case.truth {
        Truth::Vacuous | Truth::Open => return false,
        _ => ratios(&read, &fixed, &path, &variable),
    };
    println!("    along {path:?} of {variable}: {found:?}");
    if found.len() < 2 {
        return false;
    }
    match witness || case.truth == Truth::OpenFalse {
        true => assert_large(case, &read, &found),
        false => assert_small(case, &read, &found),
    }
    true
}

#[test]
fn verdicts_agree_with_numbers() {
    let (mut counted, mut failed) = (0, Vec::new());
    let all = expansions::cases();
    for case in &all {
        match std::panic::catch_unwind(|| check(case)) {
            Ok(seen) => counted += usize::from(seen),
            Err(error) => failed.push(error.downcast_ref::<String>().cloned().unwrap_or_default()),
        }
    }
    assert!(
        failed.is_empty(),
        "{} wrong:\n{}",
        failed.len(),
        failed.join("\n")
    );
    println!("{counted} of {} seen in numbers", all.len());
    assert!(
        counted * 10 >= all.len() * 7,
        "{counted} of {} seen in numbers",
        all.len()
    );
}
