//! Claims to propositions: definitions unfolded, everything explicit.

use super::resolve::Symbols;
use super::scope::Place;
use super::typing::{Culprit, check, draws_of, has_order};
use super::{Claim, Scope};
use crate::formula::parser::{Mention, MentionKind};
use crate::formula::{
    Condition, Draw, Formula, Name, Parameter, ParameterKind, Part, Proposition, Regime, Span,
    Statement, Substitution, TooLarge, free_names,
};
use std::collections::{BTreeMap, BTreeSet};

/// A statement that makes no sense as written, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct IllTyped {
    pub message: String,
    /// Bytes of the claim's file.
    pub span: Span,
}

impl Claim {
    /// The print as a proposition.
    ///
    /// # Errors
    /// [`IllTyped`] where the statement makes no sense: a free name, a condition used as a number, a
    /// draw outside a mean, an `O` on the left, or one too large to unfold.
    pub fn printed(&self) -> Result<Proposition, IllTyped> {
        self.unfolded(&self.says, &self.places.says, false)
    }

    /// The mended statement as a proposition: `mend`, or else `says`, under `needs`, which is the
    /// last condition of the domain. `None` for a claim that has neither.
    ///
    /// # Errors
    /// As [`Claim::printed`].
    pub fn mended(&self) -> Option<Result<Proposition, IllTyped>> {
        if self.mend.is_none() && self.needs.is_none() {
            return None;
        }
        Some(match (&self.mend, &self.places.mend) {
            (Some(mend), Some(place)) => self.unfolded(mend, place, true),
            _ => self.unfolded(&self.says, &self.places.says, true),
        })
    }

    /// The link to the claim that this one goes on from: the last right side of `before`, and the
    /// first relation and right side of this print. `None` where there is no such link: for
    /// statements that are no chains, and where `before` speaks of symbols that this claim does not
    /// declare in the same way.
    pub fn link(&self, before: &Claim) -> Option<Proposition> {
        let left = last_right_side(&before.says).filter(|left| !has_order(left))?;
        let left = Unfolding::new(&before.scope)
            .ok()?
            .substitution
            .formula(left)
            .ok()?;
        let unfolding = Unfolding::new(&self.scope).ok()?;
        if !self.shares_symbols(&unfolding, before, &left) {
            return None;
        }
        let Statement::Chain { links, regime, .. } = first_chain(&self.says)? else {
            return None;
        };
        let (relation, right) = links.first()?;
        let right = unfolding.substitution.formula(right).ok()?;
        let expands = has_order(&right) || relation_expands(*relation);
        let regime = read_as(regime.as_ref(), self.read.as_ref()).filter(|_| expands);
        let chain = Statement::Chain {
            first: Formula::Pi,
            links: Vec::new(),
            regime,
        };
        let Statement::Chain { regime, .. } = unfolding.substitution.statement(&chain).ok()? else {
            return None;
        };
        let statement = Statement::Chain {
            first: left,
            links: vec![(*relation, right)],
            regime,
        };
        let proposition = unfolding.proposition(Vec::new(), statement);
        check(&proposition).is_ok().then_some(proposition)
    }

    /// Whether every symbol of `left`, which is unfolded in the scope of `before`, means the same here.
    fn shares_symbols(&self, here: &Unfolding, before: &Claim, left: &Formula) -> bool {
        let Ok(there) = Unfolding::new(&before.scope) else {
            return false;
        };
        let mut free = free_names(left);
        free.extend(crate::formula::free_functions(left));
        for draw in draws_of(&there.draws, left) {
            if !here.draws.contains(draw) {
                return false;
            }
            free.remove(&draw.name);
            free.extend(crate::formula::Part::Law(&draw.law).free_names());
        }
        free.iter().all(|name| {
            let kind = |list: &[Parameter]| {
                let found = list.iter().find(|parameter| parameter.name == *name);
                found.map(|parameter| parameter.kind.clone())
            };
            kind(&here.parameters).is_some_and(|here| Some(here) == kind(&there.parameters))
        })
    }

    /// The statement in full; `place` tells where its symbols stand.
    fn unfolded(
        &self,
        statement: &Statement,
        place: &Place,
        mended: bool,
    ) -> Result<Proposition, IllTyped> {
        let needs = self.needs.as_ref().filter(|_| mended);
        if let (Statement::Conditional { id, condition }, Some(target)) =
            (statement, &self.places.target)
            && target.id == *id
        {
            return self.conditional(condition, target, place, needs.map(|n| &n.condition));
        }
        let symbols = Symbols::of(&self.scope);
        resolved(&symbols, place)?;
        let mut conditions = Vec::new();
        if let (Some(needs), Some(place)) = (needs, &self.places.needs) {
            resolved(&symbols, place)?;
            conditions.push(&needs.condition);
        }
        let statement = with_regime(statement, self.read.as_ref());
        finish(&self.scope, &conditions, &statement, place)
    }

    /// `ID if COND`: the statement of ID, in its scope, with COND the last condition of the domain.
    fn conditional(
        &self,
        condition: &Condition,
        target: &Claim,
        place: &Place,
        needs: Option<&Condition>,
    ) -> Result<Proposition, IllTyped> {
        let symbols = Symbols::of(&target.scope);
        resolved(&symbols, place)?;
        let at_target = Place {
            span: place.span,
            mentions: Vec::new(),
        };
        if symbols.check(&target.places.says.mentions).is_err() {
            return Err(IllTyped {
                message: format!("the statement of `{}` makes no sense itself", target.id),
                span: place.span,
            });
        }
        let mut conditions = vec![condition];
        if let (Some(needs), Some(place)) = (needs, &self.places.needs) {
            resolved(&symbols, place)?;
            conditions.push(needs);
        }
        let statement = with_regime(&target.says, target.read.as_ref());
        finish(&target.scope, &conditions, &statement, &at_target)
    }
}

fn resolved(symbols: &Symbols, place: &Place) -> Result<(), IllTyped> {
    symbols.check(&place.mentions).map_err(|error| IllTyped {
        message: match error.hint {
            Some(hint) => format!("{}; {hint}", error.message),
            None => error.message,
        },
        span: error.span,
    })
}

/// Unfolds, then checks the result.
fn finish(
    scope: &Scope,
    conditions: &[&Condition],
    statement: &Statement,
    place: &Place,
) -> Result<Proposition, IllTyped> {
    let too_large = |error: TooLarge| IllTyped {
        message: error.to_string(),
        span: place.span,
    };
    let unfolding = Unfolding::new(scope).map_err(too_large)?;
    let symbols = Hidden::of(scope, &unfolding);
    let bodies = scope.definitions.iter().map(|d| Part::Formula(&d.body));
    let mut parts: Vec<Part> = bodies.collect();
    parts.extend(
        conditions
            .iter()
            .map(|condition| Part::Condition(condition)),
    );
    parts.extend(parts_of(statement));
    for part in parts {
        match symbols.shadowed(part, &mut Vec::new()) {
            None => {}
            Some((Some(name), bound)) => {
                return Err(IllTyped {
                    message: format!(
                        "`{name}` is defined with another `{bound}` than the one bound where it stands; \
                         define it as `{name}({bound})`"
                    ),
                    span: place_of(&Culprit::Name(name), place, &unfolding.substitution),
                });
            }
            Some((None, bound)) => {
                return Err(IllTyped {
                    message: format!(
                        "a draw's law has another `{bound}` than the one bound here; give the mean a \
                         draw of its own"
                    ),
                    span: place_of(&Culprit::Name(bound), place, &unfolding.substitution),
                });
            }
        }
    }
    let last = conditions
        .iter()
        .map(|condition| unfolding.substitution.condition(condition))
        .collect::<Result<Vec<_>, _>>()
        .map_err(too_large)?;
    let statement = unfolding
        .substitution
        .statement(statement)
        .map_err(too_large)?;
    let substitution = unfolding.substitution.clone();
    let proposition = unfolding.proposition(last, statement);
    check(&proposition).map_err(|fault| IllTyped {
        span: place_of(&fault.culprit, place, &substitution),
        message: fault.message,
    })?;
    Ok(proposition)
}

/// What symbols stand for without showing it.
struct Hidden<'a> {
    /// What each definition brings along.
    definitions: BTreeMap<&'a Name, BTreeSet<Name>>,
    /// The names in the laws of the draws.
    laws: BTreeSet<Name>,
}

impl<'a> Hidden<'a> {
    fn of(scope: &'a Scope, unfolding: &Unfolding) -> Hidden<'a> {
        let laws = unfolding.draws.iter().map(|draw| Part::Law(&draw.law));
        let laws: BTreeSet<Name> = laws.flat_map(Part::free_names).collect();
        let mut definitions = BTreeMap::new();
        for definition in &scope.definitions {
            let brings = unfolding.substitution.brings(&definition.name);
            let mut names: BTreeSet<Name> = brings.cloned().collect();
            if unfolding.substitution.is_over_draws(&definition.name) {
                names.extend(laws.iter().cloned());
            }
            definitions.insert(&definition.name, names);
        }
        Hidden { definitions, laws }
    }

    /// A symbol under a binder of a name that it brings along, and that name: a definition, or else
    /// what is taken over draws. The two names are different symbols, which is hardly ever meant:
    /// `let X = r^2` makes `diff(X, r)` zero.
    fn shadowed(&self, part: Part<'a>, bound: &mut Vec<&'a Name>) -> Option<(Option<Name>, Name)> {
        let of = |names: &BTreeSet<Name>| names.iter().find(|name| bound.contains(name)).cloned();
        match part {
            Part::Formula(Formula::Name(name) | Formula::Apply(name, _))
                if !bound.contains(&name) =>
            {
                if let Some(other) = self.definitions.get(name).and_then(of) {
                    return Some((Some(name.clone()), other));
                }
            }
            Part::Formula(
                Formula::Mean(_, None)
                | Formula::Variance(_, None)
                | Formula::Probability(_, None)
                | Formula::Density(..)
                | Formula::Cumulative(..),
            ) => {
                if let Some(other) = of(&self.laws) {
                    return Some((None, other));
                }
            }
            _ => {}
        }
        // These two bind without saying so.
        let own = match part {
            Part::Formula(Formula::Derivative(_, x, _) | Formula::Antiderivative(_, x)) => Some(x),
            _ => None,
        };
        let mut found = None;
        part.each(&mut |inner, names| {
            if found.is_none() {
                let outside = bound.len();
                bound.extend(own.iter().chain(names));
                found = self.shadowed(inner, bound);
                bound.truncate(outside);
            }
        });
        found
    }
}

/// The formulas of a statement.
fn parts_of(statement: &Statement) -> Vec<Part<'_>> {
    match statement {
        Statement::Chain { first, links, .. } => {
            let rights = links.iter().map(|(_, right)| right);
            std::iter::once(first)
                .chain(rights)
                .map(Part::Formula)
                .collect()
        }
        Statement::All(items) => items.iter().flat_map(parts_of).collect(),
        _ => Vec::new(),
    }
}

/// Where the symbol at fault stands: itself, or a definition that holds it.
fn place_of(culprit: &Culprit, place: &Place, substitution: &Substitution) -> Span {
    let holds = |mention: &&Mention| match culprit {
        Culprit::Name(name) => {
            let formula = match mention.kind {
                MentionKind::Value => Formula::Name(mention.name.clone()),
                MentionKind::Function(arity) => {
                    Formula::Apply(mention.name.clone(), vec![Formula::Pi; arity])
                }
                _ => return false,
            };
            let unfolded = substitution.formula(&formula);
            mention.name == *name || unfolded.is_ok_and(|e| free_names(&e).contains(name))
        }
        Culprit::Truth => mention.kind == MentionKind::Truth,
        Culprit::Order => mention.kind == MentionKind::Order,
        Culprit::Whole => false,
    };
    // A draw inside of a mean is right where it stands.
    let mut outside = place.mentions.iter().filter(|mention| !mention.averaged);
    let found = outside.find(holds);
    let found = found.or_else(|| place.mentions.iter().find(holds));
    found.map_or(place.span, |mention| mention.span)
}

/// A scope with its definitions unfolded.
struct Unfolding {
    substitution: Substitution,
    parameters: Vec<Parameter>,
    domain: Vec<Condition>,
    draws: Vec<Draw>,
}

impl Unfolding {
    fn new(scope: &Scope) -> Result<Unfolding, TooLarge> {
        let mut substitution = Substitution::new();
        for definition in &scope.definitions {
            let (arguments, body) = substitution.lambda(&definition.arguments, &definition.body)?;
            let name = definition.name.clone();
            match arguments.is_empty() {
                true => substitution.value(name, body),
                false => substitution.function(name, arguments, body),
            }
        }
        let parameters = scope.parameters.iter().map(|p| parameter(p, &substitution));
        let domain = scope.domain.iter().map(|c| substitution.condition(c));
        let draws = scope.draws.iter().map(|draw| {
            Ok(Draw {
                name: draw.name.clone(),
                law: substitution.law(&draw.law)?,
            })
        });
        Ok(Unfolding {
            parameters: parameters.collect::<Result<_, TooLarge>>()?,
            domain: domain.collect::<Result<_, _>>()?,
            draws: draws.collect::<Result<_, TooLarge>>()?,
            substitution,
        })
    }

    /// The statement, which is unfolded, in this scope, `last` ending the domain.
    fn proposition(self, last: Vec<Condition>, statement: Statement) -> Proposition {
        let mut domain = self.domain;
        domain.extend(last);
        Proposition {
            parameters: self.parameters,
            domain,
            draws: self.draws,
            statement,
        }
    }
}

fn parameter(parameter: &Parameter, substitution: &Substitution) -> Result<Parameter, TooLarge> {
    let kind = match &parameter.kind {
        ParameterKind::Function {
            argument,
            kind,
            from,
            to,
        } => ParameterKind::Function {
            argument: argument.clone(),
            kind: *kind,
            from: substitution.formula(from)?,
            to: substitution.formula(to)?,
        },
        other => other.clone(),
    };
    let name: Name = parameter.name.clone();
    Ok(Parameter { name, kind })
}

/// The regime that a `read` line makes of a statement's own: its limits, if it names any, and always
/// its paths and uniformities.
fn read_as(own: Option<&Regime>, read: Option<&Regime>) -> Option<Regime> {
    let Some(read) = read else {
        return own.cloned();
    };
    let mut regime = read.clone();
    if let (true, Some(own)) = (regime.limits.is_empty(), own) {
        regime.limits.clone_from(&own.limits);
    }
    Some(regime)
}

/// The statement with the regime of its expansions read so.
fn with_regime(statement: &Statement, read: Option<&Regime>) -> Statement {
    match statement {
        Statement::Chain {
            first,
            links,
            regime,
        } if expands(links) => Statement::Chain {
            first: first.clone(),
            links: links.clone(),
            regime: read_as(regime.as_ref(), read),
        },
        Statement::All(items) => {
            Statement::All(items.iter().map(|item| with_regime(item, read)).collect())
        }
        other => other.clone(),
    }
}

/// Whether there is an expansion in the statement: a link that speaks of a limit.
pub fn has_expansion(statement: &Statement) -> bool {
    match statement {
        Statement::Chain { links, .. } => expands(links),
        Statement::All(items) => items.iter().any(has_expansion),
        _ => false,
    }
}

fn expands(links: &[(crate::formula::Relation, Formula)]) -> bool {
    links
        .iter()
        .any(|(relation, right)| relation_expands(*relation) || has_order(right))
}

fn relation_expands(relation: crate::formula::Relation) -> bool {
    use crate::formula::Relation;
    matches!(relation, Relation::Asymptotic | Relation::Approximate)
}

fn first_chain(statement: &Statement) -> Option<&Statement> {
    match statement {
        Statement::Chain { .. } => Some(statement),
        Statement::All(items) => items.iter().find_map(first_chain),
        _ => None,
    }
}

fn last_right_side(statement: &Statement) -> Option<&Formula> {
    match statement {
        Statement::Chain { links, .. } => links.last().map(|(_, right)| right),
        Statement::All(items) => items.iter().rev().find_map(last_right_side),
        _ => None,
    }
}
