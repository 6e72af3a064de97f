//! What is read off structure and facts in sight, against the values at a point where the facts hold.

use super::super::{Fact, Proof, Rule};
use crate::formula::{Condition, Formula, Point, Rational, parse_proposition};
use crate::kernel::{Value, value};
use num_traits::{Signed, Zero};

struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % sides
    }

    fn pick<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.roll(list.len() as u64) as usize]
    }
}

/// A formula in the integers k, n and the reals x, y.
fn formula(dice: &mut Dice, depth: u32) -> String {
    if depth == 0 || dice.roll(6) == 0 {
        return dice
            .pick(&["k", "n", "x", "y", "0", "1", "2", "3", "1/2", "k", "x"])
            .to_string();
    }
    let mut part = |dice: &mut Dice| format!("({})", formula(dice, depth - 1));
    let (a, b) = (part(dice), part(dice));
    match dice.roll(16) {
        0..=2 => format!("{a} + {b}"),
        3..=5 => format!("{a} - {b}"),
        6..=7 => format!("{a}*{b}"),
        8..=9 => format!("{a}/{b}"),
        10..=11 => format!("{a}^{b}"),
        12 => format!("-{a}"),
        13 => format!("{a}!"),
        14 => format!("sqrt{a}"),
        _ => format!("ln{a}"),
    }
}

#[test]
fn what_is_known_is_so() {
    let rounds = std::env::var("ROUNDS")
        .ok()
        .and_then(|t| t.parse().ok())
        .unwrap_or(300_u64);
    let mut dice = Dice(
        std::env::var("SEED")
            .ok()
            .and_then(|t| t.parse().ok())
            .unwrap_or(7),
    );
    let mut seen = [0_u64; 8];
    for _ in 0..rounds {
        let numbers = ["k", "n", "x", "y"].map(|name| {
            let n = dice.roll(7) as i64 - 3;
            let d = if name == "k" || name == "n" {
                1
            } else {
                1 + dice.roll(2) as i64
            };
            (name, Rational::new(n.into(), d.into()))
        });
        let mut point = Point::default();
        for (name, number) in &numbers {
            point.numbers.insert((*name).into(), number.clone());
        }
        let mut text = "given int k\ngiven int n\ngiven real x\ngiven real y\n".to_string();
        let at = |f: &Formula| value(f, &point, &[], 64);
        let mut facts = Vec::new();
        for _ in 0..4 {
            let (d, e) = (dice.roll(2) as u32, dice.roll(2) as u32);
            let (a, b) = (formula(&mut dice, d), formula(&mut dice, e));
            let (Ok(Value::Finite { low, high }), Ok(Value::Finite { low: l, high: h })) = (
                at(&crate::formula::parse_formula(&a).unwrap()),
                at(&crate::formula::parse_formula(&b).unwrap()),
            ) else {
                continue;
            };
            if low != high || l != h {
                continue;
            }
            let relation = match low.cmp(&l) {
                std::cmp::Ordering::Less => ["<", "<=", "!="][dice.roll(3) as usize],
                std::cmp::Ordering::Equal => ["==", "<="][dice.roll(2) as usize],
                std::cmp::Ordering::Greater => [">", ">=", "!="][dice.roll(3) as usize],
            };
            let line = format!("{a} {relation} {b}");
            text += &format!("domain {line}\n");
            facts.push(Fact::parse(&line).unwrap());
        }
        text += "says 0 == 1";
        let proposition = parse_proposition(&text).unwrap();
        let mut proof = Proof::new(&proposition);
        for fact in facts {
            let _ = proof.step(fact, Rule::Given, &[], &[]);
        }
        for _ in 0..40 {
            let d = 1 + dice.roll(3) as u32;
            let f = crate::formula::parse_formula(&formula(&mut dice, d)).unwrap();
            let found = at(&f);
            let fail = |what: &str| panic!("{what}: {f} is {found:?} at {numbers:?}\n{text}");
            let exact = match &found {
                Ok(Value::Finite { low, high }) => Some((low.clone(), high.clone())),
                _ => None,
            };
            if proof.undefined(&f) == Ok(true) {
                seen[0] += 1;
                if !matches!(found, Ok(Value::Undefined) | Err(_)) {
                    fail("undefined")
                }
                if found.is_err() {
                    seen[7] += 1;
                }
            }
            if proof.finite(&f) != Ok(true) {
                continue;
            }
            seen[1] += 1;
            if found.is_err() {
                seen[6] += 1;
                continue;
            }
            let Some((low, high)) = exact else {
                fail("finite");
                unreachable!()
            };
            for (i, (what, known, so)) in [
                ("positive", proof.positive(&f), high.is_positive()),
                ("nonnegative", proof.nonnegative(&f), !high.is_negative()),
                (
                    "nonzero",
                    proof.nonzero(&f),
                    !(low.is_zero() && high.is_zero()),
                ),
                (
                    "integer",
                    proof.integer(&f),
                    low != high || low.is_integer(),
                ),
            ]
            .into_iter()
            .enumerate()
            {
                if known == Ok(true) {
                    seen[2 + i] += 1;
                    if !so {
                        fail(what)
                    }
                }
            }
            // ring
            let d = 1 + dice.roll(2) as u32;
            let g = crate::formula::parse_formula(&formula(&mut dice, d)).unwrap();
            let both = [
                Formula::binary(crate::formula::Operator::Subtract, f.clone(), g.clone()),
                g.clone(),
            ];
            for g in both {
                let same = Fact::Same(f.clone(), g.clone());
                for rule in [Rule::Ring, Rule::Power, Rule::Order, Rule::None] {
                    if proof.clone().step(same.clone(), rule, &[], &[]).is_ok() {
                        let (a, b) = (at(&f), at(&g));
                        if let (Ok(a), Ok(b)) = (a, b)
                            && a != b
                            && !matches!((&a, &b), (Value::Finite{low, high}, Value::Finite{low: l, high: h}) if high >= l && h >= low)
                        {
                            fail(&format!("{rule:?} {g}"))
                        }
                    }
                }
            }
        }
    }
    println!("{seen:?}");
    let _ = Condition::And(Vec::new());
}
