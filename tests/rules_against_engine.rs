//! Instances of the kernel's rules with numbers for everything, against the engine's exact values.
//!
//! The kernel computes with num-bigint and rules, the engine with GMP and its own algorithms. What the
//! kernel accepts must be true; what was made by the rule's own pattern must be accepted. Every fourth
//! instance has one of its numbers changed, so that most of those are false.
//!
//! `CLAIMCHECK_INSTANCES=1000000` tries as many; without it some thousands.
#![cfg(feature = "engine")]

#[path = "support/dice.rs"]
mod dice;

use claimcheck::evaluate::{Context, Outcome, exact};
use claimcheck::formula::{Budget, Formula, Operator, Point};
use claimcheck::kernel::proof::{Certificate, Fact, Line, Proof, Script, parse};
use dice::Dice;
use rayon::prelude::*;

/// What became of the instances of one kind.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    accepted: usize,
    rejected: usize,
    /// Accepted, and the engine has no exact value for a side.
    unknown: usize,
}

#[test]
fn what_the_rules_accept_is_true() {
    let wanted = std::env::var("CLAIMCHECK_INSTANCES").ok();
    let count: usize = wanted.and_then(|n| n.parse().ok()).unwrap_or(6000);
    for (name, pattern) in PATTERNS {
        let each = count.div_ceil(PATTERNS.len());
        let tally = (0..each)
            .into_par_iter()
            .map(|i| instance(name, *pattern, i as u64))
            .reduce(Tally::default, |a, b| Tally {
                accepted: a.accepted + b.accepted,
                rejected: a.rejected + b.rejected,
                unknown: a.unknown + b.unknown,
            });
        println!("{name:14} {tally:?}");
        assert!(2 * tally.accepted > each, "{name}: too few are accepted");
        assert!(
            10 * tally.unknown <= tally.accepted,
            "{name}: too few are checked"
        );
    }
}

/// One instance: accepted means true.
fn instance(name: &str, pattern: fn(&mut Dice) -> String, seed: u64) -> Tally {
    let mut dice = Dice(seed.wrapping_mul(977).wrapping_add(name.len() as u64));
    let mut lines = pattern(&mut dice);
    let changed = seed % 4 == 3;
    if changed {
        lines = misprinted(&lines, &mut dice);
    }
    let text = format!("theorem\nsays 0 == 0\nexample\nproof\n{lines}\nqed");
    let script = match parse(&text).as_deref() {
        Ok([Certificate::Theorem(script)]) => script.clone(),
        other => panic!("{lines}: {other:?}"),
    };
    if let Err(why) = replayed(&script) {
        assert!(changed, "{lines}\nis rejected: {why}");
        return Tally {
            rejected: 1,
            ..Tally::default()
        };
    }
    let Some(Line::Step { fact, .. }) = script.lines.last() else {
        panic!("{lines} ends without a fact");
    };
    let unknown = match holds(fact) {
        Some(holds) => {
            assert!(holds, "the kernel accepts what is false:\n{lines}");
            0
        }
        None => 1,
    };
    Tally {
        accepted: 1,
        unknown,
        rejected: 0,
    }
}

fn replayed(script: &Script) -> Result<(), String> {
    let mut proof = Proof::new(&script.proposition);
    for line in &script.lines {
        proof.line(line).map_err(|error| error.to_string())?;
    }
    Ok(())
}

/// Whether a fact without names holds, by the engine's exact values; `None` where it has none.
fn holds(fact: &Fact) -> Option<bool> {
    match fact {
        Fact::Same(a, b) => match (engine(a)?, engine(b)?) {
            (Outcome::Value(_), Outcome::Value(_)) => {
                let difference = Formula::binary(Operator::Subtract, a.clone(), b.clone());
                match engine(&difference)? {
                    Outcome::Value(difference) => difference.is_zero(),
                    _ => Some(false),
                }
            }
            (a, b) => Some(a == b),
        },
        Fact::Less(a, b) => match (engine(a)?, engine(b)?) {
            (Outcome::Value(a), Outcome::Value(b)) => Some(a.as_rational()? < b.as_rational()?),
            _ => Some(false),
        },
        _ => None,
    }
}

fn engine(formula: &Formula) -> Option<Outcome<claimcheck::number::Exact>> {
    let budget = Budget::new(200_000);
    let point = Point::default();
    let context = Context {
        point: &point,
        draws: &[],
        budget: &budget,
    };
    exact(formula, &context).ok()
}

/// The text with one of its digits, outside of labels, changed.
fn misprinted(lines: &str, dice: &mut Dice) -> String {
    let last = lines.rfind('\n').map_or(0, |at| at + 1);
    let start = last + lines[last..].find(':').map_or(0, |at| at + 1);
    let end = lines[start..]
        .find('|')
        .map_or(lines.len(), |at| start + at);
    let digit = |at: &usize| lines.as_bytes()[*at].is_ascii_digit();
    // `hyp2f1` has digits of its own.
    let own = |at: &usize| {
        at.checked_sub(3)
            .is_some_and(|s| lines[s..].starts_with("hyp2f1"))
            || at
                .checked_sub(5)
                .is_some_and(|s| lines[s..].starts_with("hyp2f1"))
    };
    let places: Vec<usize> = (start..end).filter(digit).filter(|at| !own(at)).collect();
    let at = places[dice.roll(places.len() as u64) as usize];
    let new = (lines.as_bytes()[at] - b'0' + 1 + dice.roll(8) as u8) % 10;
    format!("{}{new}{}", &lines[..at], &lines[at + 1..])
}

/// Writes a step of a rule with numbers from the dice.
type Pattern = fn(&mut Dice) -> String;

const PATTERNS: &[(&str, Pattern)] = &[
    ("ring", |d| {
        let (a, b, c) = (many(d), many(d), many(d));
        format!("1: ({a} + {b}/{c})^2 == {a}^2 + 2*{a}*{b}/{c} + ({b}/{c})^2 | ring")
    }),
    ("order", |d| {
        let (a, b) = (many(d), many(d));
        format!("1: {a}/{b} < ({a} + 1)/{b} | order")
    }),
    ("gamma", |d| {
        let t = ratio(d);
        format!("1: gamma({t} + 1) == ({t})*gamma({t}) | gamma")
    }),
    ("factorial", |d| {
        let n = d.roll(3000);
        format!("1: {n}! == gamma({n} + 1) | factorial")
    }),
    ("beta", |d| {
        let (a, b) = (some(d), some(d));
        format!("1: beta({a}, {b}) == gamma({a})*gamma({b})/gamma({a} + {b}) | beta")
    }),
    ("binomial", |d| {
        let k = d.roll(300);
        let n = k + d.roll(300);
        format!("1: binomial({n}, {k}) == {n}!/({k}!*({n} - {k})!) | binomial")
    }),
    ("pochhammer", |d| {
        let (a, n) = (ratio(d), d.roll(60));
        format!("1: pochhammer({a}, {n}) == gamma({a} + {n})/gamma({a}) | pochhammer")
    }),
    ("power", |d| {
        let (a, b, p, q) = (some(d), some(d), d.roll(5), d.roll(5));
        match d.roll(4) {
            0 => format!("1: {a}^({p} + {q}) == {a}^{p}*{a}^{q} | power"),
            1 => format!("1: ({a}^{p})^{q} == {a}^({p}*{q}) | power"),
            2 => format!("1: ({a}*{b})^(-{p}) == {a}^(-{p})*{b}^(-{p}) | power"),
            _ => format!("1: ({a}/{b})^{p} == {a}^{p}/{b}^{p} | power"),
        }
    }),
    ("logarithm", |d| {
        let (a, b) = (some(d), some(d));
        match d.roll(4) {
            0 => format!("1: ln({a}*{b}) == ln({a}) + ln({b}) | logarithm"),
            1 => format!("1: ln({a}/{b}) == ln({a}) - ln({b}) | logarithm"),
            2 => format!("1: ln({a}^{b}) == {b}*ln({a}) | logarithm"),
            _ => format!("1: ln(sqrt({a})) == ln({a})/2 | logarithm"),
        }
    }),
    ("beta-integral", |d| {
        let (a, b) = (some(d), some(d));
        format!("1: beta({a}, {b}) == int(x^({a} - 1)*(1 - x)^({b} - 1), x = 0..1) | beta-integral")
    }),
    ("euler", |d| {
        let (a, b, rest, z) = (few(d) % 3 + 1, few(d), few(d), few(d));
        let c = b + rest;
        format!(
            "1: hyp2f1({a}, {b}; {c}; -{z}/2) == \
             int(x^({b} - 1)*(1 - x)^({c} - {b} - 1)*(1 - -{z}/2*x)^(-{a}), x = 0..1)/beta({b}, {c} - {b}) | euler"
        )
    }),
    ("beta-mean", |d| {
        let (p, q, e) = (some(d), some(d), body(d));
        format!(
            "1: mean({e}, x ~ beta({p}, {q})) == \
             int(x^({p} - 1)*(1 - x)^({q} - 1)/beta({p}, {q})*({e}), x = 0..1) | density"
        )
    }),
    ("uniform-mean", |d| {
        let (a, w, e) = (some(d), some(d), body(d));
        let b = a + w;
        format!(
            "1: mean({e}, x ~ uniform({a}, {b})) == int(1/({b} - {a})*({e}), x = {a}..{b}) | density"
        )
    }),
    ("order-mean", |d| {
        let l = few(d) % 5 + 1;
        let (m, e) = (l + d.roll(4), body(d));
        format!(
            "1: mean({e}, x ~ order({l}, {m}) of uniform(1, 3)) == \
             int({m}!/(({l} - 1)!*({m} - {l})!)*((x - 1)/(3 - 1))^({l} - 1)*(1 - (x - 1)/(3 - 1))^({m} - {l})\
             *(1/(3 - 1))*({e}), x = 1..3) | density"
        )
    }),
    ("variance", |d| {
        let (p, q) = (some(d), some(d));
        let law = format!("x ~ beta({p}, {q})");
        format!(
            "1: var(3*x + 1, {law}) == mean((3*x + 1)^2, {law}) - mean(3*x + 1, {law})^2 | variance"
        )
    }),
    ("primitive", |d| {
        let (a, w, c, n) = (some(d), some(d), some(d), few(d));
        let b = a + w;
        format!(
            "{{ x real | 1: {a} <= x | 2: x <= {b}\n\
             0: 0 < x | order | x - {a} + {a}\n\
             3: finite {c}*x^{n} + ln(x) | finite\n\
             4: {c}*({n}*x^({n} - 1)*1) + 1/x == {c}*{n}*x^({n} - 1) + 1/x | ring\n\
             5: finite {c}*{n}*x^({n} - 1) + 1/x | finite\n}}\n\
             6: int({c}*{n}*t^({n} - 1) + 1/t, t = {a}..{b}) == \
             {c}*{b}^{n} + ln({b}) - ({c}*{a}^{n} + ln({a})) | primitive 3 4 5 | {c}*x^{n} + ln(x)"
        )
    }),
    ("chain", |d| {
        let (a, b, c) = (some(d), some(d), some(d));
        format!(
            "1: {a}/{b} == {c}*{a}/({b}*{c}) | ring\n2: {c}*{a}/({b}*{c}) < {a}/{b} + {c} | order\n\
             3: {a}/{b} + {c} <= {a}/{b} + {c} + 1 | order\n\
             4: {a}/{b} < {a}/{b} + {c} + 1 | chain 1 2 3"
        )
    }),
    ("extreme", |d| {
        let (a, b, c) = (some(d), some(d), some(d));
        let (name, found) = match d.roll(2) {
            0 => ("min", a.min(b).min(c)),
            _ => ("max", a.max(b).max(c)),
        };
        format!("1: {name}({a}, {b}, {c}) == {found} | extreme")
    }),
    ("decide", |d| {
        let (a, b, c) = (some(d), some(d), some(d));
        match d.roll(2) {
            0 => format!("1: [{a} <= {b}] == {} | decide", u8::from(a <= b)),
            _ => {
                let found = if a < b { c } else { c + 30 };
                format!("1: if({a} < {b}, {c}, {}) == {found} | decide", c + 30)
            }
        }
    }),
    ("at", |d| {
        let (a, b, c) = (some(d), some(d), some(d));
        format!("1: at(x^2/y + y*{c}, x = {a}, y = {b}) == {a}^2/{b} + {b}*{c} | at")
    }),
    ("probability", |d| {
        let (p, q, a) = (few(d), few(d), some(d));
        let law = format!("x ~ beta({p}, {q})");
        format!("1: prob(x < 1/{a}, {law}) == mean([x < 1/{a}], {law}) | probability")
    }),
    ("telescope", |d| {
        let (a, w) = (some(d), d.roll(9));
        let b = a + w;
        format!(
            "{{ j int | 1: {a} <= j | 2: j <= {b}\n\
             3: j^2 == (j + 1)*(j + 1 - 1)*(2*(j + 1) - 1)/6 - j*(j - 1)*(2*j - 1)/6 | ring\n}}\n\
             {{ j int | 4: {a} <= j | 5: j <= {b} + 1\n\
             6: finite j*(j - 1)*(2*j - 1)/6 | finite\n}}\n\
             7: sum(i^2, i = {a}..{b}) == ({b} + 1)*({b} + 1 - 1)*(2*({b} + 1) - 1)/6 \
             - {a}*({a} - 1)*(2*{a} - 1)/6 | telescope 3 6 | j*(j - 1)*(2*j - 1)/6"
        )
    }),
];

/// 1 to 9
fn few(dice: &mut Dice) -> u64 {
    1 + dice.roll(9)
}

/// 1 to 24
fn some(dice: &mut Dice) -> u64 {
    1 + dice.roll(24)
}

/// 1 to a million
fn many(dice: &mut Dice) -> u64 {
    1 + dice.roll(1_000_000)
}

/// Halves, at which the Gamma function is known.
fn ratio(dice: &mut Dice) -> String {
    format!("{}/{}", some(dice), 1 + dice.roll(2))
}

/// Something to take the mean of, over a law on positive numbers.
fn body(dice: &mut Dice) -> String {
    let (a, b) = (some(dice), some(dice));
    match dice.roll(4) {
        0 => format!("{a}*x^2 - {b}"),
        1 => format!("1/({a} + {b}*x)"),
        2 => format!("{a}/x"),
        _ => format!("{a}*x/(x + {b})^2"),
    }
}
