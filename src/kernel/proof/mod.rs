//! Proofs: facts that the rules alone can make, and the theorems that end them.
//!
//! A [`Proof`] of a proposition is a list of steps. Each states a [`Fact`] and the [`Rule`] that it
//! follows by; the rule looks at the steps it names as premises, and at the facts in sight: those
//! proved in this block or in one around it. A block fixes new variables and supposes facts of them.
//! From outside, what was proved in it is read as "for all such variables, where these hold, ...",
//! and only the rules that ask for such a premise can use it. That is natural deduction, with the
//! domain of the proposition as its outermost block.
//!
//! A [`Theorem`] has private fields and is made by [`Proof::theorem`] only.

mod certificate;
mod fact;
mod known;
mod normal;
mod rule;
mod rules;
#[cfg(test)]
mod tests;

pub use certificate::{Certificate, Flaw, Line, Script, Shown, parse, replay};
pub use fact::Fact;
pub use rule::Rule;

pub use super::derivative::{derive, is_entire};
use super::{Unknown, check_example};
use crate::formula::{
    Formula, Law, Name, ParameterKind, Part, Point, Proposition, Relation, Statement,
    is_over_draws, is_reserved,
};
use normal::{Atoms, Fraction};
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// Counted work for one proof; the longest in the book takes a small part of it.
const FUEL: u64 = 20_000_000;
/// Blocks are not nested deeper, and do not fix more variables or suppose more.
const BLOCK_CAP: usize = 32;

/// A store of work.
#[derive(Clone, Debug)]
struct Fuel(Cell<u64>);

impl Fuel {
    fn spend(&self, steps: u64) -> Result<(), Rejected> {
        match self.0.get().checked_sub(steps) {
            Some(rest) => {
                self.0.set(rest);
                Ok(())
            }
            None => reject("too much work for one proof"),
        }
    }
}

/// Why a step is not one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Rejected(pub String);

/// Rejects, with the reason.
fn reject<T>(why: &str) -> Result<T, Rejected> {
    Err(Rejected(why.to_string()))
}

/// Rejects with the reason unless the condition holds.
fn require(holds: bool, why: &str) -> Result<(), Rejected> {
    if holds { Ok(()) } else { reject(why) }
}

impl From<Unknown> for Rejected {
    fn from(Unknown(why): Unknown) -> Rejected {
        Rejected(why)
    }
}

impl From<crate::formula::TooLarge> for Rejected {
    fn from(error: crate::formula::TooLarge) -> Rejected {
        Rejected(error.to_string())
    }
}

/// A step of a proof, by its number from 0. What a block supposes are steps too.
pub type Step = usize;

/// A variable that a block fixes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    pub name: Name,
    pub integer: bool,
}

/// A block: variables, and the steps that it supposes.
#[derive(Clone, Debug)]
struct Block {
    variables: Vec<Variable>,
    hypotheses: Vec<Fact>,
}

/// A fact, the block that it is proved in with all blocks around it, outermost first, and what the
/// rules of order want to know of it.
#[derive(Clone, Debug)]
struct Proved {
    fact: Fact,
    blocks: Vec<usize>,
    /// `b - a` for a relation between finite a and b.
    difference: Option<Fraction>,
}

/// A proof under way.
#[derive(Clone)]
pub struct Proof<'p> {
    proposition: &'p Proposition,
    /// Shared with the copies of the proof that a search makes and drops.
    steps: Vec<Rc<Proved>>,
    blocks: Vec<Block>,
    /// The blocks that are open, outermost first.
    open: Vec<usize>,
    atoms: Rc<RefCell<Atoms>>,
    fuel: Fuel,
    rules: Vec<Rule>,
    /// The facts in sight that the step under way made use of.
    seen: RefCell<Vec<Step>>,
}

/// Links of a statement proved for every point of its domain, and a point that shows that this is
/// not for want of one with values.
#[derive(Clone, Debug)]
pub struct Theorem {
    proposition: Proposition,
    links: Vec<usize>,
    rules: Vec<Rule>,
}

impl Theorem {
    /// What the links belong to.
    pub fn proposition(&self) -> &Proposition {
        &self.proposition
    }

    /// The links that are proved, in order, counted over the whole statement from 0.
    pub fn links(&self) -> &[usize] {
        &self.links
    }

    /// Whether these are all links of the statement.
    pub fn is_whole(&self) -> bool {
        let links = links_of(&self.proposition.statement);
        links.is_some_and(|all| !all.is_empty() && self.links.len() == all.len())
    }

    /// The rules that the proof uses, in their order, each once.
    pub fn rules(&self) -> &[Rule] {
        &self.rules
    }
}

impl<'p> Proof<'p> {
    /// A proof of a proposition, without steps.
    pub fn new(proposition: &'p Proposition) -> Proof<'p> {
        Proof {
            proposition,
            steps: Vec::new(),
            blocks: Vec::new(),
            open: Vec::new(),
            atoms: Rc::default(),
            fuel: Fuel(Cell::new(FUEL)),
            rules: Vec::new(),
            seen: RefCell::default(),
        }
    }

    /// The fact of a step.
    pub fn fact(&self, step: Step) -> Option<&Fact> {
        self.steps.get(step).map(|proved| &proved.fact)
    }

    /// The facts in sight that the last step made use of beside its premises.
    pub fn seen(&self) -> Vec<Step> {
        self.seen.borrow().clone()
    }

    /// Opens a block. The names must be new; the hypotheses become the next steps.
    ///
    /// # Errors
    /// [`Rejected`] for a name in use or a hypothesis about names that are not in scope.
    pub fn open(
        &mut self,
        variables: Vec<Variable>,
        hypotheses: Vec<Fact>,
    ) -> Result<(), Rejected> {
        self.spend(1)?;
        let most = self.open.len().max(variables.len()).max(hypotheses.len());
        require(most < BLOCK_CAP, "a block too deep, or with too much in it")?;
        for (i, variable) in variables.iter().enumerate() {
            let again = variables[..i]
                .iter()
                .any(|other| other.name == variable.name);
            let taken = again || self.is_declared(&variable.name) || is_reserved(&variable.name);
            require(!taken, "a variable's name is in use")?;
        }
        let steps = self.steps.len();
        self.open.push(self.blocks.len());
        self.blocks.push(Block {
            variables,
            hypotheses: hypotheses.clone(),
        });
        let opened = hypotheses.into_iter().try_for_each(|fact| {
            self.check_names(&fact)?;
            self.record(fact).map(|_| ())
        });
        if opened.is_err() {
            self.open.pop();
            self.steps.truncate(steps);
        }
        opened
    }

    /// Closes the innermost block.
    ///
    /// # Errors
    /// [`Rejected`] where none is open.
    pub fn close(&mut self) -> Result<(), Rejected> {
        match self.open.pop() {
            Some(_) => Ok(()),
            None => reject("no block is open"),
        }
    }

    /// Adds a step, which follows by the rule from the premises.
    ///
    /// # Errors
    /// [`Rejected`] with the reason where it does not; the proof is then as it was.
    pub fn step(
        &mut self,
        fact: Fact,
        rule: Rule,
        premises: &[Step],
        arguments: &[Formula],
    ) -> Result<Step, Rejected> {
        self.spend(1)?;
        self.seen.borrow_mut().clear();
        self.check_names(&fact)?;
        for premise in premises {
            require(*premise < self.steps.len(), "a premise that is no step")?;
        }
        self.apply(&fact, rule, premises, arguments)?;
        if let Err(at) = self.rules.binary_search(&rule) {
            self.rules.insert(at, rule);
        }
        self.record(fact)
    }

    /// Ends the proof: each of the links, as it is meant at single points, is the fact of its step.
    /// The point, at which both sides of each have a value, shows that they are not true for want of
    /// one; a value that the kernel does not find there must be known to be finite.
    ///
    /// # Errors
    /// [`Rejected`] where a link is not that fact, or the point shows nothing.
    pub fn theorem(&self, links: &[(usize, Step)], example: &Point) -> Result<Theorem, Rejected> {
        require(self.open.is_empty(), "a block is still open")?;
        require(
            is_closed(self.proposition),
            "the proposition names what it does not declare",
        )?;
        require(!links.is_empty(), "no link is proved")?;
        let statement = self.proposition.pointwise();
        let stated = links_of(&statement);
        let mut shown = Vec::new();
        for (at, (link, step)) in links.iter().enumerate() {
            require(
                at == 0 || links[at - 1].0 < *link,
                "links are listed in order",
            )?;
            let (a, relation, b) = match stated.as_ref().and_then(|all| all.get(*link)) {
                Some(stated) => stated,
                None => return reject("the statement has no such link"),
            };
            let own = [a, b].into_iter().any(|side| is_any(Part::Formula(side)));
            require(!own, "a mean of its own over a law that is not given")?;
            let Some(proved) = self.steps.get(*step).filter(|p| p.blocks.is_empty()) else {
                return reject("a link is proved by a step outside of all blocks");
            };
            let wanted = Fact::of_relation(a, *relation, b);
            require(
                wanted.as_ref() == Some(&proved.fact),
                "the step does not state the link",
            )?;
            let finite = match &proved.fact {
                Fact::Same(a, b) => self.finite(a)? || self.finite(b)?,
                _ => true,
            };
            shown.push((*link, finite));
        }
        check_example(self.proposition, example, &shown)
            .map_err(|Unknown(why)| Rejected(format!("the example shows nothing: {why}")))?;
        let links = shown.into_iter().map(|(link, _)| link).collect();
        Ok(Theorem {
            proposition: self.proposition.clone(),
            links,
            rules: self.rules.clone(),
        })
    }

    /// Keeps a fact that a rule or a block has made.
    fn record(&mut self, fact: Fact) -> Result<Step, Rejected> {
        let difference = match &fact {
            Fact::Less(a, b) | Fact::AtMost(a, b) | Fact::Different(a, b) => {
                Some(self.normal(b)?.minus(&self.normal(a)?, &self.fuel)?)
            }
            _ => None,
        };
        let (step, blocks) = (self.steps.len(), self.open.clone());
        self.steps.push(Rc::new(Proved {
            fact,
            blocks,
            difference,
        }));
        Ok(step)
    }

    /// Every free name of a fact is a parameter, a draw, or a variable of an open block, and no mean
    /// over the proposition's draws stands under a binder, which might bind a name of their laws.
    fn check_names(&self, fact: &Fact) -> Result<(), Rejected> {
        for side in fact.sides() {
            require(
                !hides_draws(Part::Formula(side)),
                "a mean over draws under a binder",
            )?;
        }
        match fact.names().iter().find(|name| !self.is_declared(name)) {
            Some(name) => Err(Rejected(format!("{name} is not declared here"))),
            None => Ok(()),
        }
    }

    fn is_declared(&self, name: &Name) -> bool {
        self.variable(name).is_some()
            || self.proposition.parameters.iter().any(|p| p.name == *name)
            || self.proposition.draws.iter().any(|draw| draw.name == *name)
    }

    /// The variable of an open block.
    fn variable(&self, name: &Name) -> Option<&Variable> {
        let variables = self
            .open
            .iter()
            .flat_map(|&block| &self.blocks[block].variables);
        variables
            .into_iter()
            .find(|variable| variable.name == *name)
    }

    /// Whether the name stands for a number, and if so whether for an integer.
    fn is_integer_name(&self, name: &Name) -> Option<bool> {
        if let Some(variable) = self.variable(name) {
            return Some(variable.integer);
        }
        let parameter = self
            .proposition
            .parameters
            .iter()
            .find(|p| p.name == *name)?;
        match parameter.kind {
            ParameterKind::Integer => Some(true),
            ParameterKind::Real => Some(false),
            ParameterKind::Function { .. } => None,
        }
    }

    fn spend(&self, steps: u64) -> Result<(), Rejected> {
        self.fuel.spend(steps)
    }
}

/// Whether a mean, density or distribution of the proposition's draws stands under a binder.
fn hides_draws(part: Part) -> bool {
    // These two bind without saying so.
    let derives = matches!(
        part,
        Part::Formula(Formula::Derivative(..) | Formula::Antiderivative(..))
    );
    let mut found = false;
    part.each(&mut |inner, names| {
        let bound = derives || !names.is_empty();
        found = found || (bound && is_over_draws(inner)) || hides_draws(inner);
    });
    found
}

/// Whether the law `any` stands in it. In a fact it is the law of the draw that its mean names; what it
/// would be in a statement nobody says.
fn is_any(part: Part) -> bool {
    let mut found = matches!(part, Part::Law(Law::Any));
    part.each(&mut |inner, _| found = found || is_any(inner));
    found
}

/// Whether the ranges of functions, the domain and the laws name nothing but parameters, and draws
/// in a law.
fn is_closed(proposition: &Proposition) -> bool {
    let parameter = |name: &Name| proposition.parameters.iter().any(|p| p.name == *name);
    let draw = |name: &Name| proposition.draws.iter().any(|draw| draw.name == *name);
    let ranges = proposition.parameters.iter().flat_map(|p| match &p.kind {
        ParameterKind::Function { from, to, .. } => vec![from, to],
        _ => Vec::new(),
    });
    let domain = proposition.domain.iter().map(Part::Condition);
    let mut closed = ranges.map(Part::Formula).chain(domain);
    let mut laws = proposition.draws.iter().map(|draw| Part::Law(&draw.law));
    closed.all(|part| part.free_names().iter().all(parameter))
        && laws.all(|part| {
            part.free_names()
                .iter()
                .all(|name| parameter(name) || draw(name))
        })
}

/// The links of a statement from left to right; none where it is no statement about numbers at the
/// points of its domain (`along` puts other formulas for its names). No fact states a link of an
/// expansion: no rule concludes anything of an O-term or of an asymptotic relation.
fn links_of(statement: &Statement) -> Option<Vec<(&Formula, Relation, &Formula)>> {
    match statement {
        Statement::Chain {
            regime: Some(regime),
            ..
        } if !regime.along.is_empty() => None,
        Statement::Chain { first, links, .. } => {
            let mut left = first;
            let mut all = Vec::new();
            for (relation, right) in links {
                all.push((left, *relation, right));
                left = right;
            }
            Some(all)
        }
        Statement::All(parts) => {
            let parts: Option<Vec<_>> = parts.iter().map(links_of).collect();
            Some(parts?.concat())
        }
        _ => None,
    }
}
