//! Whether an unfolded proposition makes sense: conditions where conditions are wanted, draws inside
//! means, `O` on the right of an expansion, whole numbers as indices.

use crate::formula::{
    Condition, Draw, Duty, Formula, Law, Name, ParameterKind, Part, Proposition, RangeKind, Ranged,
    Regime, Relation, Statement, Target,
};
use std::collections::HashMap;

/// What makes no sense, and the symbol to point at.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Fault {
    pub message: String,
    pub culprit: Culprit,
}

/// The symbol at fault.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Culprit {
    Name(Name),
    Truth,
    Order,
    Whole,
}

type Checked = Result<(), Fault>;

fn fault(message: impl Into<String>, culprit: Culprit) -> Fault {
    Fault {
        message: message.into(),
        culprit,
    }
}

/// Checks a proposition whose names are all declared.
pub(super) fn check(proposition: &Proposition) -> Checked {
    let mut checker = Checker {
        names: HashMap::new(),
        bound: Vec::new(),
    };
    for parameter in &proposition.parameters {
        let kind = match parameter.kind {
            ParameterKind::Integer => Kind::Integer,
            ParameterKind::Real => Kind::Real,
            ParameterKind::Function { .. } => Kind::Function,
        };
        checker.names.insert(parameter.name.clone(), kind);
    }
    for draw in &proposition.draws {
        checker.names.insert(draw.name.clone(), Kind::Draw);
    }
    for parameter in &proposition.parameters {
        if let ParameterKind::Function { from, to, .. } = &parameter.kind {
            checker.formula(from, PLAIN)?;
            checker.formula(to, PLAIN)?;
        }
    }
    for condition in &proposition.domain {
        checker.condition(condition, PLAIN)?;
    }
    for draw in &proposition.draws {
        checker.law(&draw.law, PLAIN)?;
    }
    checker.statement(&proposition.statement)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Integer,
    Real,
    Function,
    Draw,
}

/// Where a formula stands.
#[derive(Clone, Copy)]
struct Context {
    /// Inside a mean over the draws of the scope.
    averaged: bool,
    /// Where an `O` may stand.
    order: bool,
}

const PLAIN: Context = Context {
    averaged: false,
    order: false,
};

struct Checker {
    names: HashMap<Name, Kind>,
    bound: Vec<Name>,
}

impl Checker {
    fn kind(&self, name: &Name) -> Option<Kind> {
        match self.bound.contains(name) {
            true => None,
            false => self.names.get(name).copied(),
        }
    }

    fn formula(&mut self, formula: &Formula, context: Context) -> Checked {
        let inner = Context {
            order: false,
            ..context
        };
        match formula {
            Formula::Name(name) => self.name(name, context),
            Formula::Truth(_) => Err(fault(
                "a condition stands where a number is wanted",
                Culprit::Truth,
            )),
            Formula::BigO(_) | Formula::LittleO(_) if !context.order => Err(fault(
                "`O(...)` and `o(...)` stand as terms on the right of an expansion only",
                Culprit::Order,
            )),
            Formula::Negate(e) => self.formula(e, context),
            Formula::Binary(_, a, b) => {
                self.formula(a, context)?;
                self.formula(b, context)
            }
            Formula::Mean(e, None) | Formula::Variance(e, None) => self.formula(e, averaged(inner)),
            Formula::Probability(c, None) => self.condition(c, averaged(inner)),
            Formula::Density(quantity, point) | Formula::Cumulative(quantity, point) => {
                self.formula(quantity, averaged(inner))?;
                self.formula(point, inner)
            }
            Formula::Ranged(ranged) => {
                self.indices(ranged)?;
                self.parts(Part::Formula(formula), inner)
            }
            Formula::Derivative(_, name, order) => {
                self.whole(order, "the order of a derivative")?;
                self.name(name, inner)?;
                self.parts(Part::Formula(formula), inner)
            }
            _ => self.parts(Part::Formula(formula), inner),
        }
    }

    fn name(&self, name: &Name, context: Context) -> Checked {
        match self.kind(name) {
            Some(Kind::Draw) if !context.averaged => Err(fault(
                format!("the draw `{name}` stands outside of a mean, variance or probability"),
                Culprit::Name(name.clone()),
            )),
            _ => Ok(()),
        }
    }

    /// The parts one step down, under the names bound there.
    fn parts(&mut self, part: Part<'_>, context: Context) -> Checked {
        let mut result = Ok(());
        part.each(&mut |inner, names| {
            if result.is_ok() {
                let length = self.bound.len();
                self.bound.extend(names.iter().map(|name| (*name).clone()));
                result = match inner {
                    Part::Formula(formula) => self.formula(formula, context),
                    Part::Condition(condition) => self.condition(condition, context),
                    Part::Law(law) => self.law(law, context),
                };
                self.bound.truncate(length);
            }
        });
        result
    }

    fn condition(&mut self, condition: &Condition, context: Context) -> Checked {
        self.parts(Part::Condition(condition), context)
    }

    fn law(&mut self, law: &Law, context: Context) -> Checked {
        if let Law::Order(l, m, _) = law {
            self.whole(l, "the rank of an order statistic")?;
            self.whole(m, "the number of draws of an order statistic")?;
        }
        self.parts(Part::Law(law), context)
    }

    fn indices(&self, ranged: &Ranged) -> Checked {
        if ranged.kind != RangeKind::Sum {
            return Ok(());
        }
        self.whole(&ranged.from, "the bound of a sum")?;
        self.whole(&ranged.to, "the bound of a sum")
    }

    /// Refuses what is plainly no whole number; of what is computed nothing is said here.
    fn whole(&self, formula: &Formula, what: &str) -> Checked {
        let culprit = match formula {
            Formula::Number(value) if !value.is_integer() => Culprit::Whole,
            Formula::Pi => Culprit::Whole,
            Formula::Name(name) if self.kind(name) == Some(Kind::Real) => {
                Culprit::Name(name.clone())
            }
            _ => return Ok(()),
        };
        Err(fault(
            format!("{what} is a whole number, but `{formula}` is real"),
            culprit,
        ))
    }

    // ---- statements

    fn statement(&mut self, statement: &Statement) -> Checked {
        match statement {
            Statement::Chain {
                first,
                links,
                regime,
            } => self.chain(first, links, regime.as_ref()),
            Statement::All(items) => items.iter().try_for_each(|item| self.statement(item)),
            Statement::Definition {
                name,
                arguments,
                body,
                duties,
            } => self.definition(name, arguments, body, duties),
            Statement::Conditional { .. } => Err(fault(
                "`ID if COND` stands alone: it cannot be joined by `and`, nor be about another such",
                Culprit::Whole,
            )),
            Statement::Words | Statement::Empty => Ok(()),
        }
    }

    fn definition(
        &mut self,
        name: &Name,
        arguments: &[Name],
        body: &Formula,
        duties: &[Duty],
    ) -> Checked {
        if self.names.contains_key(name) {
            return Err(fault(
                format!("`{name}` is declared already, so nothing defines it here"),
                Culprit::Name(name.clone()),
            ));
        }
        self.bound.extend(arguments.iter().cloned());
        let result = self.formula(body, PLAIN);
        self.bound.clear();
        result?;
        for duty in duties {
            if let Duty::Density(from, to) | Duty::Cumulative(from, to) = duty {
                self.formula(from, PLAIN)?;
                self.formula(to, PLAIN)?;
            }
        }
        Ok(())
    }

    fn chain(
        &mut self,
        first: &Formula,
        links: &[(Relation, Formula)],
        regime: Option<&Regime>,
    ) -> Checked {
        self.formula(first, PLAIN)?;
        let mut expands = false;
        for (index, (relation, right)) in links.iter().enumerate() {
            // Between two relations a formula is a left side, too.
            let order = *relation == Relation::Equal && index + 1 == links.len();
            self.formula(
                right,
                Context {
                    averaged: false,
                    order,
                },
            )?;
            expands |= matches!(relation, Relation::Asymptotic | Relation::Approximate);
            expands |= order && has_order(right);
        }
        match regime {
            None if expands => Err(fault(
                "an expansion needs to say where: `as k -> inf`",
                Culprit::Whole,
            )),
            Some(_) if !expands => Err(fault(
                "nothing here is an expansion: there is no `O(...)`, `o(...)`, `~` or `=~`",
                Culprit::Whole,
            )),
            Some(regime) => self.regime(regime),
            None => Ok(()),
        }
    }

    fn regime(&mut self, regime: &Regime) -> Checked {
        if regime.limits.is_empty() {
            let message = "the regime does not say what tends where: `as k -> inf`";
            return Err(fault(message, Culprit::Whole));
        }
        for tendency in regime.limits.iter().flatten() {
            self.formula(&tendency.quantity, PLAIN)?;
            match &tendency.target {
                Target::Infinity => (),
                Target::Point(e) | Target::Above(e) | Target::Below(e) => self.formula(e, PLAIN)?,
            }
            let free = Part::Formula(&tendency.quantity).free_names();
            if free.is_empty() {
                let message = format!("`{}` is a constant and tends nowhere", tendency.quantity);
                return Err(fault(message, Culprit::Whole));
            }
        }
        for name in regime
            .uniformly
            .iter()
            .chain(regime.along.iter().map(|(name, _)| name))
        {
            if !matches!(self.names.get(name), Some(Kind::Integer | Kind::Real)) {
                return Err(fault(
                    format!("`{name}` is no number that the statement is about"),
                    Culprit::Name(name.clone()),
                ));
            }
        }
        for (_, value) in &regime.along {
            self.formula(value, PLAIN)?;
        }
        Ok(())
    }
}

fn averaged(context: Context) -> Context {
    Context {
        averaged: true,
        ..context
    }
}

/// Whether an `O` or `o` occurs.
pub(super) fn has_order(formula: &Formula) -> bool {
    if matches!(formula, Formula::BigO(_) | Formula::LittleO(_)) {
        return true;
    }
    let mut found = false;
    Part::Formula(formula).each(&mut |part, _| {
        if let Part::Formula(inner) = part {
            found = found || has_order(inner);
        }
    });
    found
}

/// The draws of the scope that a formula mentions.
pub(super) fn draws_of<'a>(draws: &'a [Draw], formula: &Formula) -> Vec<&'a Draw> {
    let free = Part::Formula(formula).free_names();
    draws
        .iter()
        .filter(|draw| free.contains(&draw.name))
        .collect()
}
