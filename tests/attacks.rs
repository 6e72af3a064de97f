//! Attacks on the kernel: false statements in the place of true ones, with proofs to match.
//!
//! For every theorem among the certificates of the book, mutants of its statement are taken that fail
//! at a point, as the kernel's witness check shows. The proof is then offered for the mutant: with its
//! steps as they were; with the stated results changed to what the mutant needs, all of them or one;
//! with steps dropped, doubled, swapped or borrowed from other proofs; with another rule or other
//! premises for its last step. None may be accepted.
//!
//! `CLAIMCHECK_ATTACKS=MUTANTS,ATTACKS` sets how many mutants a theorem and attacks a mutant; without
//! it there are a few of each.

#[path = "support/dice.rs"]
mod dice;
#[path = "support/mutate.rs"]
mod mutate;

use claimcheck::formula::{
    Formula, Name, ParameterKind, Point, Proposition, Rational, Statement, parse_formula,
};
use claimcheck::kernel::proof::{Certificate, Fact, Line, Rule, Script, parse};
use claimcheck::kernel::{Witness, check_witness};
use dice::Dice;
use mutate::{children, with_child};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How many points are tried for a witness.
const POINTS: u64 = 60;

#[test]
fn no_false_statement_is_proved() {
    let wanted = std::env::var("CLAIMCHECK_ATTACKS").ok();
    let wanted = wanted.as_deref().and_then(|text| text.split_once(','));
    let number = |text: &str| text.parse::<usize>().ok();
    let (mutants, attacks) = wanted
        .and_then(|(a, b)| Some((number(a)?, number(b)?)))
        .unwrap_or((1, 12));
    let scripts = scripts(Path::new("proofs/certificates"));
    assert!(scripts.len() > 50, "only {} theorems", scripts.len());
    let next = AtomicUsize::new(0);
    let worker = || {
        let (mut done, mut least) = (0, usize::MAX);
        while let Some(script) = scripts.get(next.fetch_add(1, Ordering::Relaxed)) {
            let mut dice = Dice(script.lines.len() as u64);
            let false_ones = false_mutants(script, mutants, &mut dice);
            least = least.min(false_ones.len());
            for mutant in &false_ones {
                for _ in 0..attacks {
                    let attacked = attack(script, mutant, &scripts, &mut dice);
                    done += 1;
                    assert!(
                        attacked.check().is_err(),
                        "accepted:\n{attacked}\nin the place of\n{script}"
                    );
                }
            }
        }
        (done, least)
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let results: Vec<(usize, usize)> = std::thread::scope(|scope| {
        let all: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        let joined = all.into_iter().map(|thread| thread.join());
        joined
            .map(|result| result.expect("no attack is accepted"))
            .collect()
    });
    let done: usize = results.iter().map(|(done, _)| done).sum();
    let least = results.iter().map(|(_, least)| *least).min();
    println!(
        "{done} attacks on {} theorems, at least {least:?} false mutants each",
        scripts.len()
    );
}

fn scripts(folder: &Path) -> Vec<Script> {
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the certificates of the book")
        .map(|entry| entry.expect("a file").path())
        .collect();
    files.sort();
    let texts = files
        .iter()
        .map(|file| std::fs::read_to_string(file).expect("a text"));
    texts
        .flat_map(|text| parse(&text).expect("a certificate"))
        .filter_map(|certificate| match certificate {
            Certificate::Theorem(script) => Some(script),
            Certificate::Refutation { .. } => None,
        })
        .collect()
}

/// A statement that fails, and where it differs from the true one.
struct Mutant {
    statement: Statement,
    link: usize,
    old: Formula,
    new: Formula,
}

/// Mutants of what a script proves that the kernel refutes at a point.
fn false_mutants(script: &Script, count: usize, dice: &mut Dice) -> Vec<Mutant> {
    let parameters = script.proposition.parameters.iter();
    let integers: Vec<Name> = parameters
        .filter(|parameter| parameter.kind == ParameterKind::Integer)
        .map(|parameter| parameter.name.clone())
        .collect();
    let mut all = mutate::mutants(&script.proposition.statement, &integers);
    let mut found = Vec::new();
    while found.len() < count && !all.is_empty() {
        let statement = all.swap_remove(dice.roll(all.len() as u64) as usize);
        found.extend(refuted(script, statement, dice));
    }
    found
}

fn refuted(script: &Script, statement: Statement, dice: &mut Dice) -> Option<Mutant> {
    let (old, new) = first_difference(&script.proposition.statement, &statement)?;
    let proposition = Proposition {
        statement,
        ..script.proposition.clone()
    };
    for attempt in 0..POINTS {
        let point = match attempt {
            0 => script.example.clone(),
            _ => some_point(&proposition, dice),
        };
        for (link, _) in &script.links {
            let witness = Witness {
                point: point.clone(),
                link: *link,
            };
            if check_witness(&proposition, &witness).is_ok() {
                let statement = proposition.statement;
                return Some(Mutant {
                    statement,
                    link: *link,
                    old,
                    new,
                });
            }
        }
    }
    None
}

/// A point with small numbers; most lie in the domain or not far from it.
fn some_point(proposition: &Proposition, dice: &mut Dice) -> Point {
    let mut point = Point::default();
    for parameter in &proposition.parameters {
        let name = parameter.name.clone();
        let number = match &parameter.kind {
            ParameterKind::Integer => Rational::from_integer((1 + dice.roll(5)).into()),
            ParameterKind::Real => Rational::new(dice.roll(7).into(), (1 + dice.roll(4)).into()),
            ParameterKind::Function { argument, .. } => {
                let bodies = ["1", "2*(x)", "6*(x)*(1 - (x))", "3*(x)^2"];
                let body = bodies[dice.roll(4) as usize].replace("(x)", argument);
                let body = parse_formula(&body).expect("a polynomial");
                point.functions.insert(name, (argument.clone(), body));
                continue;
            }
        };
        point.numbers.insert(name, number);
    }
    point
}

/// The links of a statement, as pairs of sides.
fn sides(statement: &Statement) -> Vec<&Formula> {
    match statement {
        Statement::Chain { first, links, .. } => std::iter::once(first)
            .chain(links.iter().map(|(_, right)| right))
            .collect(),
        Statement::All(parts) => parts.iter().flat_map(sides).collect(),
        _ => Vec::new(),
    }
}

fn first_difference(a: &Statement, b: &Statement) -> Option<(Formula, Formula)> {
    let (a, b) = (sides(a), sides(b));
    let (a, b) = a.into_iter().zip(b).find(|(a, b)| a != b)?;
    Some(innermost(a, b))
}

/// The smallest parts that differ.
fn innermost(a: &Formula, b: &Formula) -> (Formula, Formula) {
    let (parts, others) = (children(a), children(b));
    let mut differing = (0..parts.len()).filter(|&i| others.get(i) != Some(&parts[i]));
    if let (Some(i), None) = (differing.next(), differing.next())
        && parts.len() == others.len()
        && with_child(a, i, others[i].clone()) == *b
    {
        return innermost(parts[i], others[i]);
    }
    (a.clone(), b.clone())
}

/// The formula with every part that is `old` replaced by `new`.
fn replaced(formula: &Formula, old: &Formula, new: &Formula) -> Formula {
    if formula == old {
        return new.clone();
    }
    let mut result = formula.clone();
    for index in 0..children(formula).len() {
        let part = replaced(children(&result)[index], old, new);
        result = with_child(&result, index, part);
    }
    result
}

fn fact_replaced(fact: &Fact, old: &Formula, new: &Formula) -> Fact {
    let put = |formula: &Formula| replaced(formula, old, new);
    match fact {
        Fact::Same(a, b) => Fact::Same(put(a), put(b)),
        Fact::Less(a, b) => Fact::Less(put(a), put(b)),
        Fact::AtMost(a, b) => Fact::AtMost(put(a), put(b)),
        Fact::Different(a, b) => Fact::Different(put(a), put(b)),
        Fact::Finite(a) => Fact::Finite(put(a)),
        Fact::Integer(a) => Fact::Integer(put(a)),
        Fact::Undefined(a) => Fact::Undefined(put(a)),
    }
}

/// The links of a statement as facts, in order.
fn facts(statement: &Statement) -> Vec<Option<Fact>> {
    match statement {
        Statement::Chain { first, links, .. } => {
            let mut left = first;
            let mut all = Vec::new();
            for (relation, right) in links {
                all.push(Fact::of_relation(left, *relation, right));
                left = right;
            }
            all
        }
        Statement::All(parts) => parts.iter().flat_map(facts).collect(),
        _ => Vec::new(),
    }
}

/// The proof of a true statement, turned into one of the mutant.
fn attack(script: &Script, mutant: &Mutant, all: &[Script], dice: &mut Dice) -> Script {
    let mut attacked = script.clone();
    attacked.proposition.statement = mutant.statement.clone();
    let (was, needed) = (
        facts(&script.proposition.statement),
        facts(&mutant.statement),
    );
    let way = dice.roll(12);
    if way > 0 {
        // The steps that state a link state the mutant's.
        for line in &mut attacked.lines {
            if let Line::Step { fact, .. } = line
                && let Some(link) = was.iter().position(|link| link.as_ref() == Some(fact))
                && let Some(new) = &needed[link]
            {
                *fact = new.clone();
            }
        }
    }
    let some = |dice: &mut Dice, lines: &[Line]| dice.roll(lines.len() as u64) as usize;
    let at = some(dice, &attacked.lines);
    match way {
        0 | 1 => {}
        2 => attacked
            .lines
            .iter_mut()
            .for_each(|line| needs(line, mutant)),
        3 => needs(&mut attacked.lines[at], mutant),
        4 => attacked.lines[at..]
            .iter_mut()
            .for_each(|line| needs(line, mutant)),
        5 => {
            attacked
                .lines
                .iter_mut()
                .for_each(|line| needs(line, mutant));
            drop_line(&mut attacked, at);
        }
        6 => drop_line(&mut attacked, at),
        7 => {
            let line = attacked.lines[at].clone();
            insert_line(&mut attacked, at, line);
        }
        8 => {
            let with = some(dice, &attacked.lines);
            attacked.lines.swap(at, with);
        }
        9 => {
            let other = &all[dice.roll(all.len() as u64) as usize];
            let from = some(dice, &other.lines);
            insert_line(&mut attacked, at, other.lines[from].clone());
        }
        10 => {
            if let Some(Line::Step { rule, .. }) = last_of(&mut attacked, mutant) {
                *rule = Rule::ALL[dice.roll(Rule::ALL.len() as u64) as usize];
            }
        }
        _ => {
            let steps = attacked.lines.len() as u64;
            let rule = Rule::ALL[dice.roll(Rule::ALL.len() as u64) as usize];
            if let Some(Line::Step {
                premises,
                rule: own,
                ..
            }) = last_of(&mut attacked, mutant)
            {
                *premises = (0..dice.roll(4))
                    .map(|_| dice.roll(steps) as usize)
                    .collect();
                if dice.roll(2) == 0 {
                    *own = rule;
                }
            }
        }
    }
    attacked
}

/// How many steps a line makes.
fn steps_of(line: &Line) -> usize {
    match line {
        Line::Open { hypotheses, .. } => hypotheses.len(),
        Line::Step { .. } => 1,
        Line::Close => 0,
    }
}

/// Drops a line; what names later steps still names them.
fn drop_line(script: &mut Script, at: usize) {
    let first: usize = script.lines[..at].iter().map(steps_of).sum();
    let gone = steps_of(&script.lines.remove(at));
    renumber(script, |step| {
        if step < first + gone {
            step
        } else {
            step - gone
        }
    });
}

/// Inserts a line; what names later steps still names them.
fn insert_line(script: &mut Script, at: usize, line: Line) {
    let first: usize = script.lines[..at].iter().map(steps_of).sum();
    let new = steps_of(&line);
    renumber(script, |step| if step < first { step } else { step + new });
    script.lines.insert(at, line);
}

fn renumber(script: &mut Script, number: impl Fn(usize) -> usize) {
    for line in &mut script.lines {
        if let Line::Step { premises, .. } = line {
            premises.iter_mut().for_each(|step| *step = number(*step));
        }
    }
    script
        .links
        .iter_mut()
        .for_each(|(_, step)| *step = number(*step));
}

/// The line states what the mutant needs of it.
fn needs(line: &mut Line, mutant: &Mutant) {
    let (old, new) = (&mutant.old, &mutant.new);
    match line {
        Line::Step {
            fact, arguments, ..
        } => {
            *fact = fact_replaced(fact, old, new);
            arguments
                .iter_mut()
                .for_each(|argument| *argument = replaced(argument, old, new));
        }
        Line::Open { hypotheses, .. } => {
            hypotheses
                .iter_mut()
                .for_each(|fact| *fact = fact_replaced(fact, old, new));
        }
        Line::Close => {}
    }
}

/// The line that states the mutant's false link.
fn last_of<'s>(script: &'s mut Script, mutant: &Mutant) -> Option<&'s mut Line> {
    let needed = facts(&mutant.statement).into_iter().nth(mutant.link)??;
    script
        .lines
        .iter_mut()
        .rev()
        .find(|line| matches!(line, Line::Step { fact, .. } if *fact == needed))
}
