//! Free names, sizes, and the nearest known spelling.

use super::{Condition, Draw, Formula, Law, Name};
use std::collections::BTreeSet;

/// A part of a tree, one step down.
#[derive(Clone, Copy, Debug)]
pub enum Part<'a> {
    Formula(&'a Formula),
    Condition(&'a Condition),
    Law(&'a Law),
}

impl<'a> Part<'a> {
    /// Visits the parts one step down, each with the names that are bound in it.
    pub fn each(self, visit: &mut dyn FnMut(Part<'a>, &[&'a Name])) {
        match self {
            Part::Formula(formula) => each_of_formula(formula, visit),
            Part::Condition(condition) => each_of_condition(condition, visit),
            Part::Law(law) => each_of_law(law, visit),
        }
    }

    /// How many nodes the tree has, at most `cap + 1`.
    pub fn nodes(self, cap: usize) -> usize {
        let mut count = 1;
        self.each(&mut |part, _| {
            if count <= cap {
                count += part.nodes(cap - count);
            }
        });
        count
    }

    /// How deep the tree is.
    pub fn depth(self) -> usize {
        let mut deepest = 0;
        self.each(&mut |part, _| deepest = deepest.max(part.depth()));
        deepest + 1
    }
}

/// Whether anything in it is taken over the draws of the claim: its value depends on the names of
/// their laws, which are not among its free names.
pub fn is_over_draws(part: Part) -> bool {
    use Formula::{Cumulative, Density, Mean, Probability, Variance};
    if let Part::Formula(
        Mean(_, None) | Variance(_, None) | Probability(_, None) | Density(..) | Cumulative(..),
    ) = part
    {
        return true;
    }
    let mut found = false;
    part.each(&mut |inner, _| found = found || is_over_draws(inner));
    found
}

fn each_of_formula<'a>(formula: &'a Formula, visit: &mut dyn FnMut(Part<'a>, &[&'a Name])) {
    use Part::{Condition as C, Formula as F};
    match formula {
        Formula::Number(_) | Formula::Pi | Formula::Infinity | Formula::Name(_) => (),
        Formula::Apply(_, list) | Formula::Call(_, list) => {
            list.iter().for_each(|part| visit(F(part), &[]));
        }
        Formula::Negate(e) | Formula::Factorial(e) | Formula::BigO(e) | Formula::LittleO(e) => {
            visit(F(e), &[]);
        }
        Formula::Binary(_, a, b) | Formula::Density(a, b) | Formula::Cumulative(a, b) => {
            visit(F(a), &[]);
            visit(F(b), &[]);
        }
        Formula::Ranged(r) => {
            visit(F(&r.body), &[&r.name]);
            visit(F(&r.from), &[]);
            visit(F(&r.to), &[]);
        }
        Formula::Antiderivative(e, _) => visit(F(e), &[]),
        Formula::Derivative(e, _, order) => {
            visit(F(e), &[]);
            visit(F(order), &[]);
        }
        Formula::At(e, list) | Formula::Limit(e, list) => {
            let bound: Vec<&Name> = list.iter().map(|(name, _)| name).collect();
            visit(F(e), &bound);
            list.iter().for_each(|(_, value)| visit(F(value), &[]));
        }
        Formula::Indicator(c) | Formula::Truth(c) => visit(C(c), &[]),
        Formula::If(c, a, b) => {
            visit(C(c), &[]);
            visit(F(a), &[]);
            visit(F(b), &[]);
        }
        Formula::Mean(e, draw) | Formula::Variance(e, draw) => own(F(e), draw, visit),
        Formula::Probability(c, draw) => own(C(c), draw, visit),
    }
}

fn own<'a>(
    body: Part<'a>,
    draw: &'a Option<Box<Draw>>,
    visit: &mut dyn FnMut(Part<'a>, &[&'a Name]),
) {
    match draw {
        None => visit(body, &[]),
        Some(draw) => {
            visit(body, &[&draw.name]);
            visit(Part::Law(&draw.law), &[]);
        }
    }
}

fn each_of_condition<'a>(condition: &'a Condition, visit: &mut dyn FnMut(Part<'a>, &[&'a Name])) {
    match condition {
        Condition::Chain(first, links) => {
            visit(Part::Formula(first), &[]);
            for (_, right) in links {
                visit(Part::Formula(right), &[]);
            }
        }
        Condition::And(items) | Condition::Or(items) => {
            items.iter().for_each(|c| visit(Part::Condition(c), &[]));
        }
        Condition::Not(inner) => visit(Part::Condition(inner), &[]),
    }
}

fn each_of_law<'a>(law: &'a Law, visit: &mut dyn FnMut(Part<'a>, &[&'a Name])) {
    match law {
        Law::Beta(a, b) | Law::Uniform(a, b) => {
            visit(Part::Formula(a), &[]);
            visit(Part::Formula(b), &[]);
        }
        Law::Order(l, m, inner) => {
            visit(Part::Formula(l), &[]);
            visit(Part::Formula(m), &[]);
            visit(Part::Law(inner), &[]);
        }
        Law::Density {
            argument,
            body,
            from,
            to,
        } => {
            visit(Part::Formula(body), &[argument]);
            visit(Part::Formula(from), &[]);
            visit(Part::Formula(to), &[]);
        }
        Law::Any => (),
    }
}

/// The names that a formula's value depends on: parameters, draws, outer variables. In `diff(e, x)`
/// and in the antiderivative `int(e, x)` the name `x` is one of them.
pub fn free_names(formula: &Formula) -> BTreeSet<Name> {
    Part::Formula(formula).free_names()
}

/// The functions of the scope that a formula applies.
pub fn free_functions(formula: &Formula) -> BTreeSet<Name> {
    let mut found = BTreeSet::new();
    functions_into(Part::Formula(formula), &mut found);
    found
}

impl Part<'_> {
    /// The names that are free in this part; see [`free_names`].
    pub fn free_names(self) -> BTreeSet<Name> {
        let mut found = BTreeSet::new();
        names_into(self, &mut Vec::new(), &mut found);
        found
    }
}

pub(super) fn functions_into(part: Part<'_>, found: &mut BTreeSet<Name>) {
    if let Part::Formula(Formula::Apply(name, _)) = part {
        found.insert(name.clone());
    }
    part.each(&mut |inner, _| functions_into(inner, found));
}

fn names_into<'a>(part: Part<'a>, bound: &mut Vec<&'a Name>, found: &mut BTreeSet<Name>) {
    if let Part::Formula(
        Formula::Name(name) | Formula::Derivative(_, name, _) | Formula::Antiderivative(_, name),
    ) = part
        && !bound.contains(&name)
    {
        found.insert(name.clone());
    }
    part.each(&mut |inner, names| {
        let length = bound.len();
        bound.extend(names);
        names_into(inner, bound, found);
        bound.truncate(length);
    });
}

/// The candidate that is spelled most like `word`: equal but for case, or no further than a third of
/// its letters away.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > 60 {
        return None;
    }
    let lower = word.to_ascii_lowercase();
    let (distance, best) = candidates
        .into_iter()
        .filter(|candidate| candidate.len() <= 60)
        .map(|candidate| {
            let distance = distance(&lower, &candidate.to_ascii_lowercase());
            (distance, candidate)
        })
        .min_by_key(|(distance, _)| *distance)?;
    let near = word.len().max(best.len()).div_ceil(3);
    (distance < best.len() && distance <= near).then_some(best)
}

/// Letters to insert, delete, replace or swap with a neighbour to get from `a` to `b`.
fn distance(a: &str, b: &str) -> usize {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replace = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replace.min(last[j] + 1).min(row[j - 1] + 1);
            let swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if swapped {
                best = best.min(before[j - 2] + 1);
            }
            row.push(best);
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::parse_formula;

    fn free(text: &str) -> Vec<String> {
        let formula = parse_formula(text).expect(text);
        free_names(&formula).iter().map(|n| n.to_string()).collect()
    }

    #[test]
    fn binders_hide_their_names_only_inside() {
        assert_eq!(free("sum(j*a, j = j..n)"), ["a", "j", "n"]);
        assert_eq!(free("int(x^2, x = 0..1)"), Vec::<String>::new());
        assert_eq!(free("int(1, x)"), ["x"]);
        assert_eq!(free("diff(y^2, x)"), ["x", "y"]);
        assert_eq!(free("at(diff(x*b, x), x = a)"), ["a", "b"]);
        assert_eq!(free("mean(x*r, x ~ beta(x, 1))"), ["r", "x"]);
        assert_eq!(free("lim(F(x), x -> 0)"), Vec::<String>::new());
    }

    #[test]
    fn nearest_spelling() {
        let words = ["hyp2f1", "sqrt", "ln", "beta"];
        assert_eq!(nearest("hyp2F1", words), Some("hyp2f1"));
        assert_eq!(nearest("sqr", words), Some("sqrt"));
        assert_eq!(nearest("bata", words), Some("beta"));
        assert_eq!(nearest("wurzel", words), None);
    }
}
