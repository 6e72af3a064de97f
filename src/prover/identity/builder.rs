//! A proof under way with the record of its steps.
//!
//! A step that the kernel refuses is no error here: the tactic that tried it gives up, and
//! [`Builder::attempt`] puts everything back as it was.

use super::field::Field;
use super::form::{integer, minus, number, plus};
use super::known::Sign;
use super::make::parts;
use super::prune::prune;
use crate::algebra::RationalFunction;
use crate::formula::{Condition, Formula, Name, Point, Proposition, is_reserved};
use crate::kernel::proof::{Fact, Line, Proof, Rule, Script, Step, Variable};
use crate::number::convert::from_rug;
use std::cell::{Cell, RefCell};
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// A relation in sight, `b - a` being positive, nonnegative, or only known to be other than 0.
#[derive(Clone, Debug)]
pub(super) struct Relation {
    pub fact: Fact,
    pub difference: RationalFunction,
    /// What the rules of order made of others adds nothing to the search for order.
    pub derived: bool,
}

/// A block that is open, the root first.
#[derive(Clone, Debug, Default)]
struct Frame {
    facts: HashMap<Rc<Fact>, Step>,
    relations: Vec<Rc<Relation>>,
    equations: Vec<Step>,
    variables: Vec<Variable>,
}

/// A sign that was looked for in vain, with the state of what was known.
pub(super) type Failure = (Formula, Sign, u64);

/// A proof and its lines.
#[derive(Clone)]
pub(crate) struct Builder<'p> {
    proposition: &'p Proposition,
    proof: Proof<'p>,
    lines: Vec<Rc<Line>>,
    /// For each step, those that it rests on.
    uses: Vec<Rc<Vec<Step>>>,
    frames: Vec<Frame>,
    pub(super) field: Rc<RefCell<Field>>,
    /// Signs that were looked for in vain, each with what was known then.
    failed: Rc<RefCell<HashSet<Failure>>>,
    /// Stands for what is known; a new one whenever something is learnt.
    state: u64,
    states: Rc<Cell<u64>>,
}

impl<'p> Builder<'p> {
    /// A proof that states what the domain says, as far as it is between finite numbers.
    pub fn new(proposition: &'p Proposition) -> Builder<'p> {
        let mut builder = Builder {
            proposition,
            proof: Proof::new(proposition),
            lines: Vec::new(),
            uses: Vec::new(),
            frames: vec![Frame::default()],
            field: Rc::new(RefCell::new(Field::new())),
            failed: Rc::default(),
            state: 0,
            states: Rc::default(),
        };
        for condition in &proposition.domain {
            builder.give(condition);
        }
        builder
    }

    fn give(&mut self, condition: &Condition) {
        match condition {
            Condition::Chain(first, links) => {
                let mut left = first;
                for (relation, right) in links {
                    if let Some(fact) = Fact::of_relation(left, *relation, right) {
                        self.give_fact(fact);
                    }
                    left = right;
                }
            }
            Condition::And(parts) => parts.iter().for_each(|part| self.give(part)),
            Condition::Or(_) | Condition::Not(_) => {}
        }
    }

    fn give_fact(&mut self, fact: Fact) {
        let sides: Vec<Formula> = fact.sides().into_iter().cloned().collect();
        if sides.iter().all(|side| self.finite(side).is_some()) {
            self.step(fact, Rule::Given, &[], &[]);
        }
    }

    /// The proposition that is to be proved.
    pub fn proposition(&self) -> &'p Proposition {
        self.proposition
    }

    /// Adds a step; one that is in sight already is not made twice.
    pub fn step(
        &mut self,
        fact: Fact,
        rule: Rule,
        premises: &[Step],
        arguments: &[Formula],
    ) -> Option<Step> {
        if let Some(step) = self.seen(&fact) {
            return Some(step);
        }
        match self.proof.step(fact.clone(), rule, premises, arguments) {
            Ok(step) => {
                let mut uses = self.proof.seen();
                uses.extend_from_slice(premises);
                self.uses.push(Rc::new(uses));
                self.lines.push(Rc::new(Line::Step {
                    fact: fact.clone(),
                    rule,
                    premises: premises.to_vec(),
                    arguments: arguments.to_vec(),
                }));
                self.note(fact, step, rule == Rule::Order && premises.is_empty());
                Some(step)
            }
            Err(_) => None,
        }
    }

    /// The step in sight that states the fact.
    pub fn seen(&self, fact: &Fact) -> Option<Step> {
        self.frames
            .iter()
            .find_map(|frame| frame.facts.get(fact).copied())
    }

    /// Keeps what the search looks at. Of a strict relation between integers it keeps the wide one.
    fn note(&mut self, fact: Fact, step: Step, derived: bool) {
        let relation = match &fact {
            Fact::Less(a, b) | Fact::AtMost(a, b) | Fact::Different(a, b) => {
                self.field.borrow_mut().difference(a, b)
            }
            _ => None,
        };
        if !derived && !matches!(fact, Fact::Same(..) | Fact::Undefined(_)) {
            self.states.set(self.states.get() + 1);
            self.state = self.states.get();
        }
        let Some(frame) = self.frames.last_mut() else {
            return;
        };
        if let Fact::Same(..) = fact {
            frame.equations.push(step);
        }
        frame.facts.entry(Rc::new(fact.clone())).or_insert(step);
        if let Some(difference) = relation {
            frame.relations.push(Rc::new(Relation {
                fact: fact.clone(),
                difference,
                derived,
            }));
        }
        if let (Fact::Less(a, b), false) = (fact, derived) {
            self.round(a, b);
        }
    }

    /// `a + 1 <= b` from `a < b` for integers; of a number that is none, the integer above it.
    fn round(&mut self, a: Formula, b: Formula) {
        if !self.is_integer(&b) {
            return;
        }
        let normal = self.field.borrow_mut().normal(&a);
        if let Some(value) = normal.and_then(|normal| normal.as_constant()) {
            let next = value.clone().floor() + 1;
            let rest = number(&from_rug(&(value + 1 - &next)));
            let shown = plus(minus(b.clone(), a), rest);
            let fact = Fact::AtMost(number(&from_rug(&next)), b);
            self.step(fact, Rule::Gap, &[], &[shown]);
        } else if self.is_integer(&a) {
            let fact = Fact::AtMost(plus(a, integer(1)), b);
            self.step(fact, Rule::Gap, &[], &[]);
        }
    }

    /// The relations in sight.
    pub(super) fn relations(&self) -> impl Iterator<Item = &Relation> {
        self.frames
            .iter()
            .flat_map(|frame| &frame.relations)
            .map(|relation| &**relation)
    }

    /// The equations in sight.
    pub fn equations(&self) -> Vec<Step> {
        let frames = self.frames.iter();
        frames.flat_map(|frame| frame.equations.clone()).collect()
    }

    /// Whether a sign was looked for in vain when no more was known than now.
    pub(super) fn has_failed(&self, e: &Formula, sign: Sign) -> bool {
        self.failed
            .borrow()
            .contains(&(e.clone(), sign, self.state))
    }

    /// Keeps that a sign was looked for in vain.
    pub(super) fn fail(&self, e: &Formula, sign: Sign) -> Failure {
        let failure = (e.clone(), sign, self.state);
        self.failed.borrow_mut().insert(failure.clone());
        failure
    }

    /// Takes that back.
    pub(super) fn forget(&self, failure: &Failure) {
        self.failed.borrow_mut().remove(failure);
    }

    /// Whether an equation is in sight.
    pub(super) fn has_equations(&self) -> bool {
        self.frames.iter().any(|frame| !frame.equations.is_empty())
    }

    /// The fact of a step.
    ///
    /// A step that is none gives `undefined inf`, which no rule concludes.
    pub fn fact(&self, step: Step) -> &Fact {
        static NONE: Fact = Fact::Undefined(Formula::Infinity);
        self.proof.fact(step).unwrap_or(&NONE)
    }

    /// Runs `inside` in a block that fixes the variables and supposes the hypotheses, which are the
    /// steps that it is given. Where it finds nothing, the block was never there.
    pub fn block<T>(
        &mut self,
        variables: Vec<Variable>,
        hypotheses: Vec<Fact>,
        inside: impl FnOnce(&mut Self, &[Step]) -> Option<T>,
    ) -> Option<T> {
        self.attempt(|builder| {
            let (first, state) = (builder.uses.len(), builder.state);
            builder
                .proof
                .open(variables.clone(), hypotheses.clone())
                .ok()?;
            let steps: Vec<Step> = (first..first + hypotheses.len()).collect();
            builder.uses.extend(steps.iter().map(|_| Rc::default()));
            builder.frames.push(Frame {
                variables: variables.clone(),
                ..Frame::default()
            });
            builder.lines.push(Rc::new(Line::Open {
                variables,
                hypotheses: hypotheses.clone(),
            }));
            for (fact, step) in hypotheses.into_iter().zip(&steps) {
                builder.note(fact, *step, false);
            }
            let found = inside(builder, &steps)?;
            builder.proof.close().ok()?;
            builder.state = state;
            builder.frames.pop();
            builder.lines.push(Rc::new(Line::Close));
            Some(found)
        })
    }

    /// Runs `f`; where it finds nothing, all is as it was.
    pub fn attempt<T>(&mut self, f: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        let before = self.clone();
        let found = f(self);
        if found.is_none() {
            *self = before;
        }
        found
    }

    /// Proves a fact where P holds and where it does not. `inside` is given the step that supposes
    /// the one or the other, and must state the fact.
    pub fn cases(
        &mut self,
        fact: &Fact,
        condition: &Fact,
        mut inside: impl FnMut(&mut Self, Step) -> Option<Step>,
    ) -> Option<Step> {
        let opposite = condition.negation()?;
        self.attempt(|builder| {
            for side in condition.sides() {
                builder.finite(side)?;
            }
            let mut ends = Vec::new();
            for case in [condition.clone(), opposite] {
                let end = builder.block(Vec::new(), vec![case], |b, steps| inside(b, steps[0]))?;
                ends.push(end);
            }
            builder.step(fact.clone(), Rule::Cases, &ends, &[])
        })
    }

    /// A name like this one that no parameter, draw or open block has.
    pub fn fresh(&self, base: &str) -> Name {
        let mut name: Name = base.into();
        let mut count = 1;
        while self.is_taken(&name) {
            name = format!("{base}{count}").into();
            count += 1;
        }
        name
    }

    fn is_taken(&self, name: &Name) -> bool {
        is_reserved(name)
            || self.proposition.parameters.iter().any(|p| p.name == *name)
            || self.proposition.draws.iter().any(|d| d.name == *name)
            || self.variable(name).is_some()
    }

    /// Ends the proof: the certificate without the steps that nothing needs, once it replays.
    pub fn script(self, links: Vec<(usize, Step)>, example: Point) -> Option<Script> {
        let whole = Script {
            proposition: self.proposition.clone(),
            example,
            lines: self.lines.iter().map(|line| (**line).clone()).collect(),
            links,
        };
        let mut ends: Vec<Step> = whole.links.iter().map(|(_, step)| *step).collect();
        let pruned = prune(&whole, &self.uses, ends.clone());
        if pruned.check().is_ok() {
            return Some(pruned);
        }
        // That a side is finite may stand in for its value at the example.
        for (_, step) in &whole.links {
            let sides = self.fact(*step).sides();
            sides
                .into_iter()
                .for_each(|e| self.finite_parts(e, &mut ends));
        }
        let pruned = prune(&whole, &self.uses, ends);
        [pruned, whole]
            .into_iter()
            .find(|script| script.check().is_ok())
    }

    /// The steps that say that parts of a formula are finite.
    fn finite_parts(&self, e: &Formula, steps: &mut Vec<Step>) {
        match self.seen(&Fact::Finite(e.clone())) {
            Some(step) => steps.push(step),
            None => parts(e)
                .into_iter()
                .for_each(|part| self.finite_parts(part, steps)),
        }
    }

    /// Whether the variable of an open block stands for integers.
    pub(super) fn variable(&self, name: &Name) -> Option<bool> {
        let mut variables = self.frames.iter().flat_map(|frame| &frame.variables);
        variables.find(|v| v.name == *name).map(|v| v.integer)
    }
}
