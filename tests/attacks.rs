//! Attacks on the kernel: false statements in the place of true ones, with proofs to match.
//!
//! For every theorem among the certificates of the book, mutants of what it says are taken that fail
//! at a point, as the kernel's witness check shows: one or two edits of its sides, another relation,
//! or a domain that reaches too far. The proof is then offered for the mutant: with its
//! steps as they were; with the stated results changed to what the mutant needs, all of them or one;
//! with steps dropped, doubled, swapped or borrowed from other proofs; with another rule or other
//! premises for its last step. None may be accepted. No attack is counted twice.
//!
//! `CLAIMCHECK_ATTACKS=MUTANTS,ATTACKS` sets how many mutants a theorem and attacks a mutant; without
//! it there are a few of each. A theorem with fewer mutants fails the test, unless the kernel finds
//! no values for it.

#[path = "support/dice.rs"]
mod dice;
#[path = "support/distort.rs"]
mod distort;
#[path = "support/mutate.rs"]
mod mutate;

use claimcheck::formula::{
    Condition, Formula, Law, Name, ParameterKind, Point, Proposition, Rational, Relation,
    Statement, parse_formula,
};
use claimcheck::kernel::proof::{Certificate, Fact, Line, Rule, Script, parse};
use claimcheck::kernel::{Witness, check_witness, value};
use dice::Dice;
use distort::{distortions, other_relations, weaker};
use mutate::{children, misprints, with_child};
use std::collections::HashSet;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How many points are tried for a witness: few at first, as most mutants fail at many.
const POINTS: [usize; 3] = [2, 40, 400];

#[test]
fn no_false_statement_is_proved() {
    let wanted = std::env::var("CLAIMCHECK_ATTACKS").ok();
    let wanted = wanted.as_deref().and_then(|text| text.split_once(','));
    let number = |text: &str| text.parse::<usize>().ok();
    let (mutants, attacks) = wanted
        .and_then(|(a, b)| Some((number(a)?, number(b)?)))
        .unwrap_or((2, 4));
    let scripts = scripts(Path::new("proofs/certificates"));
    assert!(scripts.len() > 50, "only {} theorems", scripts.len());
    let next = AtomicUsize::new(0);
    let worker = || {
        let (mut done, mut least) = (0, usize::MAX);
        while let Some((file, script)) = scripts.get(next.fetch_add(1, Ordering::Relaxed)) {
            let mut dice = Dice(script.lines.len() as u64);
            let false_ones = false_mutants(script, mutants, &mut dice);
            let found = false_ones.len();
            assert!(
                found >= mutants || !has_values(script),
                "{file}: only {found} of {mutants} false mutants of\n{}",
                script.proposition
            );
            least = least.min(found);
            for mutant in &false_ones {
                let mut tried = HashSet::new();
                for _ in 0..10 * attacks {
                    if tried.len() == attacks {
                        break;
                    }
                    let attacked = attack(script, mutant, &scripts, &mut dice);
                    if tried.insert(attacked.to_string()) {
                        assert!(
                            attacked.check().is_err(),
                            "accepted:\n{attacked}\nin the place of\n{script}"
                        );
                    }
                }
                done += tried.len();
            }
        }
        (done, least)
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let results: Vec<(usize, usize)> = std::thread::scope(|scope| {
        let all: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        let joined = all.into_iter().map(|thread| thread.join());
        joined
            .map(|result| result.expect("enough mutants, and no attack is accepted"))
            .collect()
    });
    let done: usize = results.iter().map(|(done, _)| done).sum();
    let least = results.iter().map(|(_, least)| *least).min();
    let files: HashSet<&String> = scripts.iter().map(|(file, _)| file).collect();
    println!(
        "{done} attacks on {} theorems of {} certificates, at least {least:?} false mutants each",
        scripts.len(),
        files.len()
    );
}

/// Whether the kernel finds the values of all sides at the example: without them it can refute no mutant.
fn has_values(script: &Script) -> bool {
    let draws = concrete(&script.proposition).draws;
    let statement = script.proposition.pointwise();
    let found = |side: &Formula| value(side, &script.example, &draws, 64).is_ok();
    let mut chains = stated(&statement).into_iter();
    chains.all(|(first, links)| found(first) && links.iter().all(|(_, right)| found(right)))
}

/// The proposition for one law in the place of `any`, which has all the means: what fails for it fails.
fn concrete(proposition: &Proposition) -> Proposition {
    let mut concrete = proposition.clone();
    for draw in &mut concrete.draws {
        if draw.law == Law::Any {
            draw.law = Law::Uniform(Formula::integer(0), Formula::integer(1));
        }
    }
    concrete
}

/// The theorems of a folder, each with the name of its file.
fn scripts(folder: &Path) -> Vec<(String, Script)> {
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the certificates of the book")
        .map(|entry| entry.expect("a file").path())
        .collect();
    files.sort();
    let mut all = Vec::new();
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a text");
        for certificate in parse(&text).expect("a certificate") {
            if let Certificate::Theorem(script) = certificate {
                all.push((file.display().to_string(), script));
            }
        }
    }
    all
}

/// A proposition that fails, and where it differs from the true one in a formula.
struct Mutant {
    proposition: Proposition,
    link: usize,
    difference: Option<(Formula, Formula)>,
}

/// Mutants of what a script proves that the kernel refutes at a point: of one edit, then of two.
fn false_mutants(script: &Script, count: usize, dice: &mut Dice) -> Vec<Mutant> {
    let truth = &script.proposition;
    let mut found: Vec<Mutant> = Vec::new();
    let mut seen = HashSet::from([truth.to_string()]);
    for points in POINTS {
        let mut single = edited(truth);
        let mut double = 20 * count;
        while found.len() < count {
            let candidate = if !single.is_empty() {
                single.swap_remove(dice.roll(single.len() as u64) as usize)
            } else if double > 0 {
                double -= 1;
                one_of(edited(&one_of(edited(truth), dice)), dice)
            } else {
                break;
            };
            if seen.contains(&candidate.to_string()) {
                continue;
            }
            if let Some(mutant) = refuted(script, candidate, points, dice) {
                seen.insert(mutant.proposition.to_string());
                found.push(mutant);
            }
        }
    }
    found
}

fn one_of<T>(mut all: Vec<T>, dice: &mut Dice) -> T {
    all.swap_remove(dice.roll(all.len() as u64) as usize)
}

/// Every proposition that differs by one edit.
fn edited(proposition: &Proposition) -> Vec<Proposition> {
    let names = |wanted: fn(&ParameterKind) -> bool| -> Vec<Name> {
        let parameters = proposition.parameters.iter();
        parameters
            .filter(|parameter| wanted(&parameter.kind))
            .map(|parameter| parameter.name.clone())
            .collect()
    };
    let integers = names(|kind| *kind == ParameterKind::Integer);
    let numbers = names(|kind| !matches!(kind, ParameterKind::Function { .. }));
    let edits = |formula: &Formula| {
        let mut all = misprints(formula, &integers);
        all.extend(distortions(formula, &numbers));
        all
    };
    let mut statements = mutate::mutants(&proposition.statement, &edits);
    statements.extend(other_relations(&proposition.statement));
    let mut all: Vec<Proposition> = statements
        .into_iter()
        .map(|statement| Proposition {
            statement,
            ..proposition.clone()
        })
        .collect();
    for (at, condition) in proposition.domain.iter().enumerate() {
        for weaker in weaker(condition) {
            let mut wider = proposition.clone();
            wider.domain[at] = weaker;
            all.push(wider);
        }
    }
    all
}

fn refuted(
    script: &Script,
    proposition: Proposition,
    points: usize,
    dice: &mut Dice,
) -> Option<Mutant> {
    // Without parameters there is one point.
    let points = match proposition.parameters.is_empty() {
        true => 1,
        false => points,
    };
    for attempt in 0..points {
        let point = match attempt {
            0 => script.example.clone(),
            _ => some_point(script, dice),
        };
        for (link, _) in &script.links {
            let witness = Witness {
                point: point.clone(),
                link: *link,
            };
            if check_witness(&concrete(&proposition), &witness).is_ok() {
                let difference = first_difference(&script.proposition, &proposition);
                return Some(Mutant {
                    proposition,
                    link: *link,
                    difference,
                });
            }
        }
    }
    None
}

/// A point with small numbers, some of them those of the example: most lie in the domain or not far
/// from it.
fn some_point(script: &Script, dice: &mut Dice) -> Point {
    let mut point = script.example.clone();
    let kept = dice.roll(4);
    for parameter in &script.proposition.parameters {
        if dice.roll(4) < kept {
            continue;
        }
        let name = parameter.name.clone();
        let number = match &parameter.kind {
            ParameterKind::Integer => Rational::from_integer(dice.roll(7).into()),
            ParameterKind::Real => {
                let above = dice.roll(9) as i64 - 1;
                Rational::new(above.into(), (1 + dice.roll(4)).into())
            }
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

/// The chains of relations that the domain and the statement are made of.
fn chains(proposition: &Proposition) -> Vec<(&Formula, &[(Relation, Formula)])> {
    let mut all = Vec::new();
    for condition in &proposition.domain {
        if let Condition::Chain(first, links) = condition {
            all.push((first, links.as_slice()));
        }
    }
    all.extend(stated(&proposition.statement));
    all
}

fn stated(statement: &Statement) -> Vec<(&Formula, &[(Relation, Formula)])> {
    match statement {
        Statement::Chain { first, links, .. } => vec![(first, links.as_slice())],
        Statement::All(parts) => parts.iter().flat_map(stated).collect(),
        _ => Vec::new(),
    }
}

fn first_difference(a: &Proposition, b: &Proposition) -> Option<(Formula, Formula)> {
    let sides = |proposition| {
        let chains = chains(proposition).into_iter();
        let sides = chains.flat_map(|(first, links)| {
            std::iter::once(first).chain(links.iter().map(|(_, right)| right))
        });
        sides.collect::<Vec<&Formula>>()
    };
    let (a, b) = sides(a).into_iter().zip(sides(b)).find(|(a, b)| a != b)?;
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

/// The relations of chains as facts, in order.
fn facts(chains: Vec<(&Formula, &[(Relation, Formula)])>) -> Vec<Option<Fact>> {
    let mut all = Vec::new();
    for (first, links) in chains {
        let mut left = first;
        for (relation, right) in links {
            all.push(Fact::of_relation(left, *relation, right));
            left = right;
        }
    }
    all
}

/// The proof of a true statement, turned into one of the mutant.
fn attack(script: &Script, mutant: &Mutant, all: &[(String, Script)], dice: &mut Dice) -> Script {
    let mut attacked = script.clone();
    attacked.proposition = mutant.proposition.clone();
    let (was, needed) = (
        facts(chains(&script.proposition)),
        facts(chains(&mutant.proposition)),
    );
    let way = dice.roll(12);
    if way > 0 {
        // The steps that state a link or a condition state the mutant's.
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
            let (_, other) = &all[dice.roll(all.len() as u64) as usize];
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
    let Some((old, new)) = &mutant.difference else {
        return;
    };
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
    let links = facts(stated(&mutant.proposition.statement));
    let needed = links.into_iter().nth(mutant.link)??;
    script
        .lines
        .iter_mut()
        .rev()
        .find(|line| matches!(line, Line::Step { fact, .. } if *fact == needed))
}
