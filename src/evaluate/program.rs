//! A formula as a program over floats, for its values at many places: for simulations. Nothing is proved by it.

use super::enclose::ladder;
use super::float::{arithmetic, float, plain};
use super::{Context, Failure, Outcome, unsupported};
use crate::formula::{Condition, Formula, Function, Name, Operator, Part, Relation};

/// Digits of what is computed once.
const DIGITS: u32 = 17;

/// A formula of some variables; all else is computed once.
#[derive(Clone, Debug)]
pub struct Program(Node);

/// A condition on some variables.
#[derive(Clone, Debug)]
pub struct Test(Truth);

#[derive(Clone, Debug)]
enum Node {
    Constant(f64),
    Variable(usize),
    Negate(Box<Node>),
    Binary(Operator, Box<[Node; 2]>),
    Call(fn(f64) -> f64, Box<Node>),
    /// The extreme of some numbers.
    Fold(fn(f64, f64) -> f64, Vec<Node>),
    If(Box<Truth>, Box<[Node; 2]>),
}

#[derive(Clone, Debug)]
enum Truth {
    Chain(Node, Vec<(Relation, Node)>),
    And(Vec<Truth>),
    Or(Vec<Truth>),
    Not(Box<Truth>),
}

impl Program {
    /// The program of a formula whose other names have values in the context.
    ///
    /// ```
    /// use claimcheck::evaluate::{Context, Program};
    /// use claimcheck::formula::{Budget, Point, parse_formula};
    /// let context = Context { point: &Point::default(), draws: &[], budget: &Budget::new(1000) };
    /// let formula = parse_formula("3*x^2 + [x < y]").expect("a formula");
    /// let program = Program::new(&formula, &["x".into(), "y".into()], &context)?;
    /// assert_eq!(program.value(&[2.0, 2.5]), 13.0);
    /// # Ok::<(), claimcheck::evaluate::Failure>(())
    /// ```
    ///
    /// # Errors
    /// A [`Failure`] where a variable stands in something that is no arithmetic, or the rest has no value.
    pub fn new(formula: &Formula, variables: &[Name], context: &Context) -> Result<Self, Failure> {
        node(formula, &Scope { variables, context }).map(Program)
    }

    /// The value, NaN where there is none. A variable that is not given is NaN.
    pub fn value(&self, variables: &[f64]) -> f64 {
        self.0.value(variables)
    }
}

impl Test {
    /// The program of a condition, as [`Program::new`].
    ///
    /// # Errors
    /// As there.
    pub fn new(
        condition: &Condition,
        variables: &[Name],
        context: &Context,
    ) -> Result<Self, Failure> {
        truth(condition, &Scope { variables, context }).map(Test)
    }

    /// Whether it holds; `None` where a number in it has no value.
    pub fn holds(&self, variables: &[f64]) -> Option<bool> {
        self.0.holds(variables)
    }
}

struct Scope<'a> {
    variables: &'a [Name],
    context: &'a Context<'a>,
}

fn node(formula: &Formula, scope: &Scope) -> Result<Node, Failure> {
    scope.context.budget.spend(1)?;
    let free = Part::Formula(formula).free_names();
    if !scope.variables.iter().any(|name| free.contains(name)) {
        return constant(formula, scope.context).map(Node::Constant);
    }
    let inner = |formula: &Formula| node(formula, scope).map(Box::new);
    let both = |a: &Formula, b: &Formula| -> Result<_, Failure> {
        Ok(Box::new([node(a, scope)?, node(b, scope)?]))
    };
    Ok(match formula {
        Formula::Name(name) => match scope.variables.iter().position(|other| other == name) {
            Some(index) => Node::Variable(index),
            None => Node::Constant(f64::NAN),
        },
        Formula::Negate(a) => Node::Negate(inner(a)?),
        Formula::Binary(operator, a, b) => Node::Binary(*operator, both(a, b)?),
        Formula::Call(function, parts) => match (plain(*function), function, parts.as_slice()) {
            (Some(plain), _, [a]) => Node::Call(plain, inner(a)?),
            (_, Function::Min, parts) => Node::Fold(smaller, nodes(parts, scope)?),
            (_, Function::Max, parts) => Node::Fold(larger, nodes(parts, scope)?),
            _ => return Err(unsupported(format!("`{formula}`"))),
        },
        Formula::Indicator(condition) => Node::If(
            Box::new(truth(condition, scope)?),
            Box::new([Node::Constant(1.0), Node::Constant(0.0)]),
        ),
        Formula::If(condition, a, b) => Node::If(Box::new(truth(condition, scope)?), both(a, b)?),
        _ => return Err(unsupported(format!("`{formula}`"))),
    })
}

/// What is computed once may as well be computed without cancellation.
fn constant(formula: &Formula, context: &Context) -> Result<f64, Failure> {
    match ladder(formula, context, DIGITS) {
        Ok(Outcome::Value(interval)) => Ok(interval.midpoint().to_f64()),
        _ => float(formula, context),
    }
}

fn nodes(formulas: &[Formula], scope: &Scope) -> Result<Vec<Node>, Failure> {
    formulas
        .iter()
        .map(|formula| node(formula, scope))
        .collect()
}

fn truth(condition: &Condition, scope: &Scope) -> Result<Truth, Failure> {
    let all = |parts: &[Condition]| -> Result<Vec<Truth>, Failure> {
        parts.iter().map(|part| truth(part, scope)).collect()
    };
    Ok(match condition {
        Condition::Chain(first, links) => {
            let links = links
                .iter()
                .map(|(relation, right)| Ok((*relation, node(right, scope)?)));
            Truth::Chain(node(first, scope)?, links.collect::<Result<_, Failure>>()?)
        }
        Condition::And(parts) => Truth::And(all(parts)?),
        Condition::Or(parts) => Truth::Or(all(parts)?),
        Condition::Not(inner) => Truth::Not(Box::new(truth(inner, scope)?)),
    })
}

/// The smaller number, NaN if either is.
fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b { a } else { b }
}

/// The larger number, NaN if either is.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

impl Node {
    fn value(&self, variables: &[f64]) -> f64 {
        match self {
            Node::Constant(value) => *value,
            Node::Variable(index) => variables.get(*index).copied().unwrap_or(f64::NAN),
            Node::Negate(a) => -a.value(variables),
            Node::Binary(operator, sides) => {
                let [a, b] = sides.as_ref();
                arithmetic(*operator, a.value(variables), b.value(variables))
            }
            Node::Call(function, a) => function(a.value(variables)),
            Node::Fold(extreme, parts) => {
                let values = parts.iter().map(|part| part.value(variables));
                values.reduce(extreme).unwrap_or(f64::NAN)
            }
            Node::If(truth, sides) => {
                let [yes, no] = sides.as_ref();
                match truth.holds(variables) {
                    Some(true) => yes.value(variables),
                    Some(false) => no.value(variables),
                    None => f64::NAN,
                }
            }
        }
    }
}

impl Truth {
    fn holds(&self, variables: &[f64]) -> Option<bool> {
        let all = |parts: &[Truth], wanted: bool| {
            let told: Option<Vec<bool>> = parts.iter().map(|part| part.holds(variables)).collect();
            Some(told?.into_iter().all(|holds| holds == wanted))
        };
        match self {
            Truth::Chain(first, links) => {
                let mut left = first.value(variables);
                let mut holds = true;
                for (relation, right) in links {
                    let right = right.value(variables);
                    holds &= related(left, *relation, right)?;
                    left = right;
                }
                Some(holds)
            }
            Truth::And(parts) => all(parts, true),
            Truth::Or(parts) => all(parts, false).map(|none| !none),
            Truth::Not(inner) => inner.holds(variables).map(|holds| !holds),
        }
    }
}

fn related(a: f64, relation: Relation, b: f64) -> Option<bool> {
    let order = a.partial_cmp(&b)?;
    match relation {
        Relation::Equal => Some(order.is_eq()),
        Relation::NotEqual => Some(order.is_ne()),
        Relation::Less => Some(order.is_lt()),
        Relation::LessEqual => Some(order.is_le()),
        Relation::Greater => Some(order.is_gt()),
        Relation::GreaterEqual => Some(order.is_ge()),
        // In statements only.
        Relation::Asymptotic | Relation::Approximate => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{Budget, Point, parse_formula};

    fn value(text: &str, x: f64, y: f64) -> Result<f64, Failure> {
        let budget = Budget::new(10_000);
        let context = Context {
            point: &Point::default(),
            draws: &[],
            budget: &budget,
        };
        let formula = parse_formula(text).expect("a formula");
        let program = Program::new(&formula, &["x".into(), "y".into()], &context)?;
        Ok(program.value(&[x, y]))
    }

    #[test]
    fn arithmetic_and_conditions() {
        for (text, expected) in [
            ("x - y/4", 1.25),
            ("-x^3 + gamma(4)", -2.0),
            ("min(x, y, 7) + max(x, 1)", 4.0),
            ("[x < y <= 3] + 10*[not (x == 2) or y > 5]", 1.0),
            ("if(y > x, sqrt(x + 2), x/0)", 2.0),
            ("sum(j, j = 1..4)*x", 20.0),
        ] {
            assert_eq!(value(text, 2.0, 3.0), Ok(expected), "{text}");
        }
    }

    #[test]
    fn no_value_is_nan_and_no_method_is_an_error() {
        for text in [
            "x/(y - 3)",
            "ln(-x)",
            "min(x, ln(-x))",
            "max(ln(-x), x)",
            "[not ln(-x) < 1]",
        ] {
            assert!(value(text, 2.0, 3.0).expect("a program").is_nan(), "{text}");
        }
        assert!(matches!(
            value("gamma(x)", 2.0, 3.0),
            Err(Failure::Unsupported(_))
        ));
        assert!(matches!(
            value("sum(x, j = 1..4)", 2.0, 3.0),
            Err(Failure::Unsupported(_))
        ));
    }
}
