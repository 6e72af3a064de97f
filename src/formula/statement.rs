//! Statements: what a claim says of its formulas.

use super::{
    Condition, Formula, Name, Operator, ParameterKind, Part, Proposition, Relation, free_names,
    is_over_draws,
};
use std::borrow::Cow;

/// What a claim states of its formulas.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Statement {
    /// `a == b < c`, judged link by link. A link whose right side holds an `O` or `o`, or whose
    /// relation is `~` or `=~`, is an expansion under the regime.
    Chain {
        first: Formula,
        links: Vec<(Relation, Formula)>,
        regime: Option<Regime>,
    },
    /// Statements joined by `and`.
    All(Vec<Statement>),
    /// `f(r) is EXPR`, for a symbol that nothing else fixes, with the duties that the text puts
    /// on it.
    Definition {
        name: Name,
        arguments: Vec<Name>,
        body: Formula,
        duties: Vec<Duty>,
    },
    /// `ID if COND`: the statement of another claim holds where the condition does.
    Conditional { id: Name, condition: Condition },
    /// `words`: a person reads it, nothing is computed.
    Words,
    /// `empty`: a number without an equation.
    Empty,
}

/// What a definition must satisfy; a failed duty refutes it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Duty {
    /// `density on a..b`: nowhere negative, integral 1.
    Density(Formula, Formula),
    /// `cdf on a..b`: from 0 to 1, never decreasing.
    Cumulative(Formula, Formula),
    /// `agrees ID`: equal to the symbol of the same name that claim ID defines.
    Agrees(Name),
}

/// Under which limit an expansion is meant: `as n -> inf then k -> inf uniformly in l`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct Regime {
    /// Limits in turn (`then`), each of one or more quantities tending jointly.
    pub limits: Vec<Vec<Tendency>>,
    /// Names that the constants must not depend on.
    pub uniformly: Vec<Name>,
    /// `along k = EXPR, v = EXPR`: substituted before the limit is taken.
    pub along: Vec<(Name, Formula)>,
}

/// `k -> inf`, `n/k -> inf`, `x -> 0+`
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tendency {
    pub quantity: Formula,
    pub target: Target,
}

/// Where a quantity tends.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// `inf`
    Infinity,
    /// `a`, from both sides.
    Point(Formula),
    /// `a+`, from above.
    Above(Formula),
    /// `a-`, from below.
    Below(Formula),
}

impl Proposition {
    /// What the statement says at single points. An equation with `int(e, x)`, an antiderivative, is
    /// one up to a constant in x on every interval: it says that the derivatives are equal. One whose
    /// antiderivatives are not added up, with factors free of x, stays as it is, and so do the other
    /// relations of its chain, and an equation whose x is no real parameter that may move.
    pub fn pointwise(&self) -> Cow<'_, Statement> {
        pointwise(&self.statement, &|x| self.may_move(x))
    }

    /// Whether the domain has intervals in the name: it is real, and no equation ties it.
    fn may_move(&self, x: &Name) -> bool {
        let mut parameters = self.parameters.iter();
        parameters.any(|p| p.name == *x && p.kind == ParameterKind::Real)
            && !self.domain.iter().any(|condition| ties(condition, x))
    }
}

/// Whether a condition may leave single values of the name only.
fn ties(condition: &Condition, x: &Name) -> bool {
    match condition {
        Condition::Chain(_, links) => {
            let equation = |(relation, _): &(Relation, _)| *relation == Relation::Equal;
            links.iter().any(equation) && Part::Condition(condition).free_names().contains(x)
        }
        Condition::And(parts) | Condition::Or(parts) => parts.iter().any(|part| ties(part, x)),
        Condition::Not(part) => Part::Condition(part).free_names().contains(x),
    }
}

fn pointwise<'s>(statement: &'s Statement, may_move: &dyn Fn(&Name) -> bool) -> Cow<'s, Statement> {
    match statement {
        Statement::Chain {
            first,
            links,
            regime: None,
        } => derived_links(first, links, may_move).map_or(Cow::Borrowed(statement), Cow::Owned),
        Statement::All(parts) => {
            let parts: Vec<_> = parts.iter().map(|part| pointwise(part, may_move)).collect();
            match parts.iter().any(|part| matches!(part, Cow::Owned(_))) {
                true => Cow::Owned(Statement::All(
                    parts.into_iter().map(Cow::into_owned).collect(),
                )),
                false => Cow::Borrowed(statement),
            }
        }
        _ => Cow::Borrowed(statement),
    }
}

/// The relations of a chain one by one, those with an antiderivative by their derivatives; none where no
/// relation is so.
fn derived_links(
    first: &Formula,
    links: &[(Relation, Formula)],
    may_move: &dyn Fn(&Name) -> bool,
) -> Option<Statement> {
    let lefts = std::iter::once(first).chain(links.iter().map(|(_, right)| right));
    let derived: Vec<_> = lefts
        .clone()
        .zip(links)
        .map(|(left, (relation, right))| derivatives((left, *relation, right), may_move))
        .collect();
    derived.iter().flatten().next()?;
    let chains = lefts.zip(links).zip(derived);
    let chains = chains.map(|((left, (relation, right)), derived)| {
        let (first, right) = derived.unwrap_or_else(|| (left.clone(), right.clone()));
        Statement::Chain {
            first,
            links: vec![(*relation, right)],
            regime: None,
        }
    });
    let mut chains: Vec<_> = chains.collect();
    match chains.len() {
        1 => chains.pop(),
        _ => Some(Statement::All(chains)),
    }
}

/// The derivatives of both sides of an equation with an antiderivative.
fn derivatives(
    (left, relation, right): (&Formula, Relation, &Formula),
    may_move: &dyn Fn(&Name) -> bool,
) -> Option<(Formula, Formula)> {
    let sides = [left, right].map(Part::Formula);
    let x = sides.into_iter().find_map(variable)?;
    let equation = relation == Relation::Equal && may_move(&x);
    equation.then(|| Some((derivative(left, &x)?, derivative(right, &x)?)))?
}

/// The variable of an antiderivative in the formula.
fn variable(part: Part) -> Option<Name> {
    if let Part::Formula(Formula::Antiderivative(_, x)) = part {
        return Some(x.clone());
    }
    let mut found = None;
    part.each(&mut |inner, _| found = found.take().or_else(|| variable(inner)));
    found
}

/// The derivative of a sum of antiderivatives and other terms, nothing of it over draws: their laws may
/// name x.
fn derivative(formula: &Formula, x: &Name) -> Option<Formula> {
    if is_over_draws(Part::Formula(formula)) {
        return None;
    }
    if variable(Part::Formula(formula)).is_none() {
        let once = Box::new(Formula::integer(1));
        return Some(Formula::Derivative(
            Box::new(formula.clone()),
            x.clone(),
            once,
        ));
    }
    let still = |factor: &Formula| !free_names(factor).contains(x);
    match formula {
        Formula::Antiderivative(e, own) if own == x && variable(Part::Formula(e)).is_none() => {
            Some((**e).clone())
        }
        Formula::Negate(a) => Some(Formula::Negate(Box::new(derivative(a, x)?))),
        Formula::Binary(operator @ (Operator::Add | Operator::Subtract), a, b) => Some(
            Formula::binary(*operator, derivative(a, x)?, derivative(b, x)?),
        ),
        Formula::Binary(Operator::Multiply, a, b) if still(a) => Some(Formula::binary(
            Operator::Multiply,
            (**a).clone(),
            derivative(b, x)?,
        )),
        Formula::Binary(operator @ (Operator::Multiply | Operator::Divide), a, b) if still(b) => {
            Some(Formula::binary(*operator, derivative(a, x)?, (**b).clone()))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::formula::{parse_proposition, parse_statement};

    #[test]
    fn equations_up_to_a_constant_are_equations_of_derivatives() {
        for (statement, pointwise) in [
            ("int(1/x, x) == ln(x)", "1/x == diff(ln(x), x, 1)"),
            ("2*int(x, x) - int(1, x)/3 == -int(a, x)", "2*x - 1/3 == -a"),
            ("x*int(x, x) == x^3/2", "x*int(x, x) == x^3/2"),
            ("int(int(x, x), x) == x^3/6", "int(int(x, x), x) == x^3/6"),
            ("int(x, x) < x^2", "int(x, x) < x^2"),
            ("1 == 1 and int(0, x) == 2", "1 == 1 and 0 == diff(2, x, 1)"),
            (
                "int(2*x, x) == x^2 == x^2 + 1",
                "2*x == diff(x^2, x, 1) and x^2 == x^2 + 1",
            ),
            (
                "a == b == int(1, x) == int(2, x)",
                "a == b and diff(b, x, 1) == 1 and 1 == 2",
            ),
        ] {
            let text = format!("given real a, b, x\ndomain 0 < x < 1\nsays {statement}");
            let read = parse_proposition(&text).expect(statement);
            let expected = parse_statement(pointwise).expect(pointwise);
            assert_eq!(*read.pointwise(), expected, "{statement}");
        }
    }

    #[test]
    fn a_name_that_cannot_move_has_no_antiderivatives() {
        for scope in [
            "given int x",
            "given real a, x\ndomain x == a",
            "given real a, x\ndomain a > 0 and 0 < x == a",
            "given real a, x\ndomain x < 1 or x == a",
            "given real a, x\ndomain not x != a",
        ] {
            let text = format!("{scope}\nsays int(x, x) == x^2/2");
            let read = parse_proposition(&text).expect(scope);
            assert_eq!(*read.pointwise(), read.statement, "{scope}");
        }
    }
}
