//! Leaves out the steps of a proof that nothing needs.

use crate::kernel::proof::{Line, Script, Step};
use std::collections::HashMap;
use std::rc::Rc;

/// The script without the steps that its ends do not rest on. `uses` lists for each step those
/// that it rests on itself.
pub(super) fn prune(script: &Script, uses: &[Rc<Vec<Step>>], ends: Vec<Step>) -> Script {
    let needed = needed(uses, ends);
    let mut renumbered: HashMap<Step, Step> = HashMap::new();
    let mut lines = Vec::new();
    let mut step = 0;
    for (line, keep) in script.lines.iter().zip(keep(script, &needed)) {
        let count = states(line);
        if keep {
            for at in step..step + count {
                renumbered.insert(at, renumbered.len());
            }
            lines.push(with_premises(line, &renumbered));
        }
        step += count;
    }
    let links = script.links.iter();
    let links = links.filter_map(|(link, step)| Some((*link, *renumbered.get(step)?)));
    Script {
        proposition: script.proposition.clone(),
        example: script.example.clone(),
        links: links.collect(),
        lines,
    }
}

/// How many steps a line is.
fn states(line: &Line) -> usize {
    match line {
        Line::Open { hypotheses, .. } => hypotheses.len(),
        Line::Step { .. } => 1,
        Line::Close => 0,
    }
}

fn needed(uses: &[Rc<Vec<Step>>], mut open: Vec<Step>) -> Vec<bool> {
    let mut needed = vec![false; uses.len()];
    while let Some(step) = open.pop() {
        if let Some(mark) = needed.get_mut(step).filter(|mark| !**mark) {
            *mark = true;
            open.extend(uses[step].iter());
        }
    }
    needed
}

/// Whether each line stays: a needed step, and a block that holds one.
fn keep(script: &Script, needed: &[bool]) -> Vec<bool> {
    let mut keep = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut step = 0;
    for (at, line) in script.lines.iter().enumerate() {
        let stays = match line {
            Line::Open { .. } => {
                open.push(at);
                false
            }
            Line::Close => open.pop().is_some_and(|opened| keep[opened]),
            Line::Step { .. } => needed.get(step).copied().unwrap_or(false),
        };
        keep.push(stays);
        if stays && matches!(line, Line::Step { .. }) {
            for &around in &open {
                keep[around] = true;
            }
        }
        step += states(line);
    }
    keep
}

fn with_premises(line: &Line, renumbered: &HashMap<Step, Step>) -> Line {
    match line {
        Line::Step {
            fact,
            rule,
            premises,
            arguments,
        } => Line::Step {
            fact: fact.clone(),
            rule: *rule,
            premises: premises
                .iter()
                .map(|premise| renumbered.get(premise).copied().unwrap_or(*premise))
                .collect(),
            arguments: arguments.clone(),
        },
        other => other.clone(),
    }
}
