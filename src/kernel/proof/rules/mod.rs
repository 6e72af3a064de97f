//! What each rule checks. A check looks at the stated fact, the premises and the arguments, and
//! says nothing but yes or why not.

mod congruence;
mod derivative;
mod integral;
mod law;
mod logic;
mod special;

use super::{Fact, Proof, Rejected, Rule, Step, Variable, reject, require};
use crate::formula::{Formula, Name, Ranged, free_names, substitute};

/// A premise as it is seen from here: for all variables of the blocks that were closed since, where
/// what they suppose holds, the fact.
pub(super) struct General<'a> {
    pub variables: Vec<&'a Variable>,
    pub hypotheses: Vec<&'a Fact>,
    pub fact: &'a Fact,
}

/// One step under check.
pub(super) struct Check<'a, 'p> {
    pub proof: &'a Proof<'p>,
    pub fact: &'a Fact,
    pub premises: &'a [Step],
    pub arguments: &'a [Formula],
}

type Checked = Result<(), Rejected>;

impl Proof<'_> {
    /// Checks that the fact follows by the rule.
    pub(super) fn apply(
        &self,
        fact: &Fact,
        rule: Rule,
        premises: &[Step],
        arguments: &[Formula],
    ) -> Checked {
        let check = Check {
            proof: self,
            fact,
            premises,
            arguments,
        };
        match rule {
            Rule::Given => check.given(),
            Rule::Finite => check.finite(),
            Rule::Order => check.order(),
            Rule::Gap => check.gap(),
            Rule::Ring => check.ring(),
            Rule::Congruence => check.congruence(),
            Rule::Chain => check.chain(),
            Rule::None => check.none(),
            Rule::Compute => check.compute(),
            Rule::Decide => check.decide(),
            Rule::Cases => check.cases(),
            Rule::At => check.at(),
            Rule::Primitive => check.primitive(),
            Rule::Derivative => check.derivative(),
            Rule::Substitution => check.substitution(),
            Rule::Scale => check.scale(),
            Rule::Split => check.split(),
            Rule::Continuous => check.continuous(),
            Rule::Diverges => check.diverges(),
            Rule::Support => check.support(),
            Rule::Telescope => check.telescope(),
            Rule::Draw => check.draw(),
            Rule::Probability => check.probability(),
            Rule::Density => check.density(),
            Rule::Variance => check.variance(),
            Rule::BetaIntegral => check.beta_integral(),
            Rule::Euler => check.euler(),
            Rule::Regularized => check.regularized(),
            Rule::Gamma => check.gamma(),
            Rule::Factorial => check.factorial(),
            Rule::Beta => check.beta(),
            Rule::Binomial => check.binomial(),
            Rule::Pochhammer => check.pochhammer(),
            Rule::Logarithm => check.logarithm(),
            Rule::Power => check.power(),
            Rule::Circle => check.circle(),
            Rule::Constant => check.constant(),
            Rule::Extreme => check.extreme(),
            Rule::PowerOrder => check.power_order(),
            Rule::Limit => check.limit(),
            Rule::Function => check.function(),
        }
    }

    /// A step as a premise from here.
    fn general(&self, step: Step) -> General<'_> {
        let proved = &self.steps[step];
        let shared = self
            .open
            .iter()
            .zip(&proved.blocks)
            .take_while(|(a, b)| a == b)
            .count();
        let closed = proved.blocks[shared..]
            .iter()
            .map(|&block| &self.blocks[block]);
        General {
            variables: closed.clone().flat_map(|block| &block.variables).collect(),
            hypotheses: closed.flat_map(|block| &block.hypotheses).collect(),
            fact: &proved.fact,
        }
    }
}

impl<'a> Check<'a, '_> {
    /// The premise of this index.
    fn premise(&self, index: usize) -> Result<General<'a>, Rejected> {
        match self.premises.get(index) {
            Some(&step) => Ok(self.proof.general(step)),
            None => reject("a premise is missing"),
        }
    }

    /// The premise of this index, which must be in sight.
    fn plain(&self, index: usize) -> Result<&'a Fact, Rejected> {
        let premise = self.premise(index)?;
        let open = premise.variables.is_empty() && premise.hypotheses.is_empty();
        require(open, "a premise holds in its block only")?;
        Ok(premise.fact)
    }

    /// The argument of this index.
    fn argument(&self, index: usize) -> Result<&'a Formula, Rejected> {
        match self.arguments.get(index) {
            Some(argument) => Ok(argument),
            None => reject("an argument is missing"),
        }
    }

    /// The two sides of the equation that is stated.
    fn equation(&self) -> Result<(&'a Formula, &'a Formula), Rejected> {
        match self.fact {
            Fact::Same(a, b) => Ok((a, b)),
            _ => reject("the rule concludes an equation"),
        }
    }

    /// The right side of the stated equation is this formula.
    fn concludes(&self, right: &Formula) -> Checked {
        match self.equation()?.1 == right {
            true => Ok(()),
            false => Err(Rejected(format!("the rule gives {right} on the right"))),
        }
    }

    fn is_finite(&self, formula: &Formula) -> Checked {
        need(self.proof.finite(formula), formula, "finite")
    }

    fn is_positive(&self, formula: &Formula) -> Checked {
        self.is_finite(formula)?;
        need(self.proof.positive(formula), formula, "positive")
    }

    fn is_nonnegative(&self, formula: &Formula) -> Checked {
        self.is_finite(formula)?;
        need(self.proof.nonnegative(formula), formula, "nonnegative")
    }

    fn is_nonzero(&self, formula: &Formula) -> Checked {
        self.is_finite(formula)?;
        need(self.proof.nonzero(formula), formula, "nonzero")
    }

    fn is_integer(&self, formula: &Formula) -> Checked {
        self.is_finite(formula)?;
        need(self.proof.integer(formula), formula, "an integer")
    }

    /// The formula is the fact of a premise proved for one variable that runs between two ends, the
    /// ends counted in or not. Gives the variable and the fact.
    fn on_range(
        &self,
        index: usize,
        (a, b): (&Formula, &Formula),
        closed: bool,
        integer: bool,
    ) -> Result<(&'a Name, &'a Fact), Rejected> {
        let premise = self.premise(index)?;
        let [variable] = premise.variables.as_slice() else {
            return reject("the premise is for one variable");
        };
        let covered = fits(&premise, (a, b), closed, integer);
        require(
            covered,
            "the premise supposes more than that its variable is in the range",
        )?;
        Ok((&variable.name, premise.fact))
    }
}

/// Whether the premise, for one variable, supposes no more of it than that it runs between the two
/// ends, the ends counted in or not. What holds for all reals holds for the integers among them.
fn fits(premise: &General, (a, b): (&Formula, &Formula), closed: bool, integer: bool) -> bool {
    let [variable] = premise.variables.as_slice() else {
        return false;
    };
    let x = Formula::Name(variable.name.clone());
    let beside =
        |low: &Formula, high: &Formula| (low == a && *high == x) || (*low == x && high == b);
    // A name of the range is another variable than the premise's, though it be called the same.
    let free = !depends(a, &variable.name) && !depends(b, &variable.name);
    free && (integer || !variable.integer)
        && premise.hypotheses.iter().all(|fact| match fact {
            Fact::AtMost(low, high) => beside(low, high),
            Fact::Less(low, high) => !closed && beside(low, high),
            _ => false,
        })
}

/// The answer must be yes.
fn need(answer: Result<bool, Rejected>, formula: &Formula, what: &str) -> Checked {
    match answer? {
        true => Ok(()),
        false => Err(Rejected(format!("{formula} is not known to be {what}"))),
    }
}

/// The body of an integral or sum, with another name for its variable.
fn body_at(range: &Ranged, name: &Name) -> Result<Formula, Rejected> {
    if range.name == *name {
        return Ok(range.body.clone());
    }
    require(
        !free_names(&range.body).contains(name),
        "the variable's new name is in use",
    )?;
    put(&range.body, &range.name, &Formula::Name(name.clone()))
}

/// `e[x:=t]`
fn put(e: &Formula, x: &Name, t: &Formula) -> Result<Formula, Rejected> {
    Ok(substitute(e, &[(x.clone(), t.clone())])?)
}

fn depends(formula: &Formula, name: &Name) -> bool {
    free_names(formula).contains(name)
}
