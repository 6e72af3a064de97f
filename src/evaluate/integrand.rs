//! An integrand as a tree in one variable whose constants are enclosed once, its jets, and its behaviour at
//! the ends of the range: a sum of terms
//!
//! ```text
//! (x-A)^p (B-x)^q ln(x-A)^i ln(B-x)^j g(x)
//! ```
//!
//! with rational p, q, where g is meant to be analytic at both ends (its jets tell).

use super::enclose;
use super::fraction::{Fraction, divide_linear, evaluate};
use super::jet::{Jet, Jets};
use super::scope::Scope;
use super::{Failure, Outcome, exact, unsupported};
use crate::formula::{Budget, Formula, Function, Name, Operator, Part};
use crate::number::{DomainError, Interval, convert};
use rug::{Integer, Rational};
use std::rc::Rc;

use Outcome::{Undefined, Value};

/// Products of sums at the ends are expanded up to so many terms.
const MAX_TERMS: usize = 64;

/// A function of one variable.
#[derive(Debug)]
pub(super) enum Node {
    Number(Rational),
    Constant(Interval),
    Variable,
    /// A rational function.
    Fraction(Fraction),
    Negate(Tree),
    Add(Tree, Tree),
    Multiply(Tree, Tree),
    Divide(Tree, Tree),
    Power(Tree, i64),
    /// A constant exponent that is no small integer, with its value where that is rational.
    RealPower(Tree, Interval, Option<Rational>),
    /// An exponent that varies: for positive bases only.
    VariablePower(Tree, Tree),
    Exp(Tree),
    Ln(Tree),
    Sin(Tree),
    Cos(Tree),
}

pub(super) type Tree = Rc<Node>;

/// Reads formulas in which some names are functions of the variable.
pub(super) struct Reader<'r, 'a> {
    pub scope: &'r Scope<'a>,
    pub names: &'r [(&'r Name, Tree)],
    pub precision: u32,
}

impl Reader<'_, '_> {
    /// The formula as a tree; `Undefined` where a part that does not vary has no value.
    pub fn read(&self, formula: &Formula) -> Result<Outcome<Tree>, Failure> {
        self.scope.spend(1)?;
        let free = Part::Formula(formula).free_names();
        if !self.names.iter().any(|(name, _)| free.contains(*name)) {
            return self.constant(formula);
        }
        match formula {
            Formula::Name(name) => Ok(Value(self.name(name)?)),
            Formula::Negate(inner) => self.one(inner, Node::Negate),
            Formula::Binary(Operator::Power, base, exponent) => self.power(base, exponent),
            Formula::Binary(operator, left, right) => self.binary(*operator, left, right),
            Formula::Call(function, arguments) => match (function, &arguments[..]) {
                (Function::Sqrt, [x]) => self.one(x, |x| {
                    real_power(x, &Rational::from((1, 2)), self.precision)
                }),
                (Function::Exp, [x]) => self.one(x, Node::Exp),
                (Function::Ln, [x]) => self.one(x, Node::Ln),
                (Function::Sin, [x]) => self.one(x, Node::Sin),
                (Function::Cos, [x]) => self.one(x, Node::Cos),
                _ => Err(unsupported(format!("{} in an integrand", function.name()))),
            },
            Formula::Apply(name, arguments) => self.apply(name, arguments),
            _ => Err(unsupported("an integrand of this kind")),
        }
    }

    fn name(&self, name: &Name) -> Result<Tree, Failure> {
        let known = self.names.iter().find(|(known, _)| *known == name);
        known
            .map(|(_, tree)| tree.clone())
            .ok_or_else(|| unsupported(format!("{name} in an integrand")))
    }

    fn one(
        &self,
        inner: &Formula,
        make: impl FnOnce(Tree) -> Node,
    ) -> Result<Outcome<Tree>, Failure> {
        Ok(self.read(inner)?.map(|inner| Rc::new(make(inner))))
    }

    fn constant(&self, formula: &Formula) -> Result<Outcome<Tree>, Failure> {
        if let Formula::Number(value) = formula {
            return Ok(Value(Rc::new(Node::Number(convert::to_rug(value)))));
        }
        let exactly = match exact::closed(formula, self.scope) {
            Ok(Value(value)) => value.as_rational(),
            Err(Failure::Exhausted) => return Err(Failure::Exhausted),
            _ => None,
        };
        if let Some(value) = exactly {
            return Ok(Value(Rc::new(Node::Number(value))));
        }
        enclose::within(formula, self.scope, self.precision)?.finite("an integrand", |value| {
            Ok(Value(Rc::new(Node::Constant(value))))
        })
    }

    fn binary(
        &self,
        operator: Operator,
        left: &Formula,
        right: &Formula,
    ) -> Result<Outcome<Tree>, Failure> {
        let (Value(a), Value(b)) = (self.read(left)?, self.read(right)?) else {
            return Ok(Undefined);
        };
        Ok(Value(Rc::new(match operator {
            Operator::Add => Node::Add(a, b),
            Operator::Subtract => Node::Add(a, Rc::new(Node::Negate(b))),
            Operator::Multiply => Node::Multiply(a, b),
            _ => Node::Divide(a, b),
        })))
    }

    fn power(&self, base: &Formula, exponent: &Formula) -> Result<Outcome<Tree>, Failure> {
        let (Value(base), Value(exponent)) = (self.read(base)?, self.read(exponent)?) else {
            return Ok(Undefined);
        };
        Ok(Value(Rc::new(match &*exponent {
            Node::Number(s) => power(base, s, self.precision),
            Node::Constant(s) => Node::RealPower(base, s.clone(), None),
            _ => Node::VariablePower(base, exponent),
        })))
    }

    fn apply(&self, name: &Name, arguments: &[Formula]) -> Result<Outcome<Tree>, Failure> {
        let [argument] = arguments else {
            return Err(unsupported(format!("{name} with this number of arguments")));
        };
        let (variable, body) = self.scope.function(name)?;
        let Value(argument) = self.read(argument)? else {
            return Ok(Undefined);
        };
        let inner = Reader {
            scope: &self.scope.outermost(),
            names: &[(variable, argument)],
            precision: self.precision,
        };
        inner.read(body)
    }
}

fn real_power(base: Tree, s: &Rational, precision: u32) -> Node {
    Node::RealPower(base, Interval::from_rational(s, precision), Some(s.clone()))
}

/// base^s for a rational s.
pub(super) fn power(base: Tree, s: &Rational, precision: u32) -> Node {
    match s.numer().to_i64() {
        Some(n) if *s.denom() == 1 => Node::Power(base, n),
        _ => real_power(base, s, precision),
    }
}

pub(super) fn number(value: Rational) -> Tree {
    Rc::new(Node::Number(value))
}

pub(super) fn product(a: &Tree, b: &Tree) -> Tree {
    match (&**a, &**b) {
        (Node::Number(one), _) if *one == 1 => b.clone(),
        (_, Node::Number(one)) if *one == 1 => a.clone(),
        _ => Rc::new(Node::Multiply(a.clone(), b.clone())),
    }
}

impl Node {
    /// The jet at a place or over an interval.
    pub fn jet(&self, place: &Interval, jets: Jets) -> Result<Jet, DomainError> {
        let of = |tree: &Tree| tree.jet(place, jets);
        Ok(match self {
            Node::Number(value) => vec![Interval::from_rational(value, jets.precision)],
            Node::Constant(value) => jets.constant(value),
            Node::Variable => jets.variable(place),
            Node::Fraction(function) => fraction_jet(function, place, jets)?,
            Node::Negate(a) => jets.negate(&of(a)?),
            Node::Add(a, b) => jets.add(&of(a)?, &of(b)?),
            Node::Multiply(a, b) => jets.multiply(&of(a)?, &of(b)?),
            Node::Divide(a, b) => jets.divide(&of(a)?, &of(b)?)?,
            Node::Power(a, n) => jets.power(&of(a)?, *n)?,
            Node::RealPower(a, s, _) => {
                jets.real_power(&of(a)?, &s.with_precision(jets.precision))?
            }
            Node::VariablePower(a, s) => {
                let (a, s) = (of(a)?, of(s)?);
                if *a[0].low() <= 0 {
                    return Err(DomainError::Possible);
                }
                jets.exp(&jets.multiply(&s, &jets.ln(&a)?))?
            }
            Node::Exp(a) => jets.exp(&of(a)?)?,
            Node::Ln(a) => jets.ln(&of(a)?)?,
            Node::Sin(a) => jets.sine_and_cosine(&of(a)?)?.0,
            Node::Cos(a) => jets.sine_and_cosine(&of(a)?)?.1,
        })
    }

    /// How many operations a jet takes.
    pub fn size(&self) -> u64 {
        match self {
            Node::Number(_) | Node::Constant(_) | Node::Variable => 1,
            Node::Fraction(f) => (f.numerator.len() + f.factors.len()) as u64 + 1,
            Node::Negate(a)
            | Node::Power(a, _)
            | Node::RealPower(a, ..)
            | Node::Exp(a)
            | Node::Ln(a)
            | Node::Sin(a)
            | Node::Cos(a) => a.size().saturating_add(1),
            Node::Add(a, b)
            | Node::Multiply(a, b)
            | Node::Divide(a, b)
            | Node::VariablePower(a, b) => a.size().saturating_add(b.size()).saturating_add(1),
        }
    }

    /// The rational function over Q that this is, if that can be told.
    pub fn fraction(&self, budget: &Budget) -> Option<Fraction> {
        match self {
            Node::Number(value) => Some(Fraction::constant(value.clone())),
            Node::Variable => Some(Fraction::variable()),
            Node::Fraction(function) => Some(function.clone()),
            Node::Negate(a) => Some(a.fraction(budget)?.scale(&Rational::from(-1))),
            Node::Add(a, b) => a.fraction(budget)?.add(&b.fraction(budget)?, budget).ok(),
            Node::Multiply(a, b) => a
                .fraction(budget)?
                .multiply(&b.fraction(budget)?, budget)
                .ok(),
            Node::Divide(a, b) => {
                let below = b.fraction(budget)?;
                let inverse = (!below.is_zero()).then(|| below.power(-1, budget).ok())??;
                a.fraction(budget)?.multiply(&inverse, budget).ok()
            }
            Node::Power(a, n) => {
                let base = a.fraction(budget)?;
                let allowed = *n >= 0 || !base.is_zero();
                allowed.then(|| base.power(*n, budget).ok())?
            }
            _ => None,
        }
    }
}

fn fraction_jet(function: &Fraction, place: &Interval, jets: Jets) -> Result<Jet, DomainError> {
    let x = jets.variable(place);
    let mut value = vec![Interval::from_i64(0, jets.precision)];
    for coefficient in function.numerator.iter().rev() {
        let coefficient = vec![Interval::from_rational(coefficient, jets.precision)];
        value = jets.add(&jets.multiply(&value, &x), &coefficient);
    }
    for (root, exponent) in &function.factors {
        let mut distance = x.clone();
        distance[0] = distance[0].sub(&Interval::from_rational(root, jets.precision));
        value = jets.multiply(&value, &jets.power(&distance, *exponent)?);
    }
    Ok(value)
}

/// A term of the sum above; side 0 is the lower end.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub powers: [Rational; 2],
    pub logs: [u32; 2],
    pub rest: Tree,
}

impl Term {
    fn regular(rest: &Tree) -> Term {
        Term {
            powers: [Rational::new(), Rational::new()],
            logs: [0, 0],
            rest: rest.clone(),
        }
    }

    fn has_logs(&self) -> bool {
        self.logs != [0, 0]
    }

    fn multiply(&self, other: &Term) -> Term {
        let sum = |side: usize| Rational::from(&self.powers[side] + &other.powers[side]);
        Term {
            powers: [sum(0), sum(1)],
            logs: [
                self.logs[0].saturating_add(other.logs[0]),
                self.logs[1].saturating_add(other.logs[1]),
            ],
            rest: product(&self.rest, &other.rest),
        }
    }

    /// Whether the term is analytic at an end, as far as its powers and logarithms go.
    pub fn is_regular(&self, side: usize) -> bool {
        let power = &self.powers[side];
        self.logs[side] == 0 && *power.denom() == 1 && power.numer() >= &Integer::new()
    }
}

/// Splits integrands at two rational ends.
pub(super) struct Splitter<'s> {
    pub ends: [Option<Rational>; 2],
    pub budget: &'s Budget,
    pub precision: u32,
}

impl Splitter<'_> {
    /// The integrand as a sum of terms. What cannot be taken apart is left whole.
    pub fn split(&self, tree: &Tree) -> Result<Vec<Term>, Failure> {
        self.budget.spend(4)?;
        if let Some(function) = tree.fraction(self.budget)
            && !function.is_zero()
        {
            return Ok(vec![self.fraction(function)]);
        }
        Ok(match &**tree {
            Node::Negate(a) => self.scaled(a, -1)?,
            Node::Add(a, b) => {
                let mut terms = self.split(a)?;
                terms.extend(self.split(b)?);
                terms
            }
            Node::Multiply(a, b) => expand(&self.split(a)?, &self.split(b)?)
                .unwrap_or_else(|| vec![Term::regular(tree)]),
            Node::Divide(a, b) => match &self.split(b)?[..] {
                [below] if !below.has_logs() => {
                    let inverse = self.power(below, &Rational::from(-1));
                    expand(&self.split(a)?, &[inverse]).unwrap_or_else(|| vec![Term::regular(tree)])
                }
                _ => vec![Term::regular(tree)],
            },
            Node::Power(a, n) => self.integer_power(a, *n, tree)?,
            Node::RealPower(a, _, Some(s)) => match &self.split(a)?[..] {
                [base] if !base.has_logs() => vec![self.power(base, s)],
                _ => vec![Term::regular(tree)],
            },
            Node::Ln(a) => match &self.split(a)?[..] {
                [inner] if !inner.has_logs() => logarithm(inner),
                _ => vec![Term::regular(tree)],
            },
            _ => vec![Term::regular(tree)],
        })
    }

    fn scaled(&self, tree: &Tree, by: i32) -> Result<Vec<Term>, Failure> {
        let mut terms = self.split(tree)?;
        for term in &mut terms {
            term.rest = product(&number(Rational::from(by)), &term.rest);
        }
        Ok(terms)
    }

    /// Pulls the zeros and poles at the ends out; (x-B)^e = (-1)^e (B-x)^e.
    fn fraction(&self, mut function: Fraction) -> Term {
        let mut powers = [Rational::new(), Rational::new()];
        for (side, end) in self.ends.iter().enumerate() {
            let Some(end) = end else { continue };
            let mut exponent = function.exponent_at(end);
            function.factors.retain(|(root, _)| root != end);
            while evaluate(&function.numerator, end) == 0 {
                function.numerator = divide_linear(&function.numerator, end).0;
                exponent = exponent.saturating_add(1);
            }
            if side == 1 && exponent % 2 != 0 {
                function = function.scale(&Rational::from(-1));
            }
            powers[side] = Rational::from(exponent);
        }
        Term {
            powers,
            logs: [0, 0],
            rest: Rc::new(Node::Fraction(function)),
        }
    }

    /// A power of a term without logarithms; inside the range its factors at the ends are positive.
    fn power(&self, base: &Term, s: &Rational) -> Term {
        Term {
            powers: [
                Rational::from(&base.powers[0] * s),
                Rational::from(&base.powers[1] * s),
            ],
            logs: [0, 0],
            rest: Rc::new(power(base.rest.clone(), s, self.precision)),
        }
    }

    fn integer_power(&self, a: &Tree, n: i64, whole: &Tree) -> Result<Vec<Term>, Failure> {
        let base = self.split(a)?;
        if let [base] = &base[..]
            && !base.has_logs()
        {
            return Ok(vec![self.power(base, &Rational::from(n))]);
        }
        if !(0..=8).contains(&n) {
            return Ok(vec![Term::regular(whole)]);
        }
        let mut result = vec![Term::regular(&number(Rational::from(1)))];
        for _ in 0..n {
            match expand(&result, &base) {
                Some(product) => result = product,
                None => return Ok(vec![Term::regular(whole)]),
            }
        }
        Ok(result)
    }
}

/// The product of two sums; `None` where it has too many terms.
fn expand(a: &[Term], b: &[Term]) -> Option<Vec<Term>> {
    let products = a
        .iter()
        .flat_map(|left| b.iter().map(move |right| left.multiply(right)));
    (a.len().saturating_mul(b.len()) <= MAX_TERMS).then(|| products.collect())
}

/// ln of a product.
fn logarithm(inner: &Term) -> Vec<Term> {
    let mut terms = vec![Term::regular(&Rc::new(Node::Ln(inner.rest.clone())))];
    for side in 0..2 {
        if inner.powers[side] != 0 {
            let mut term = Term::regular(&number(inner.powers[side].clone()));
            term.logs[side] = 1;
            terms.push(term);
        }
    }
    terms
}
