//! What a step of a proof says.

use crate::formula::{
    Condition, Diagnostic, Formula, Name, Relation, Span, free_names, parse_condition,
    parse_formula,
};
use std::collections::BTreeSet;
use std::fmt::{Display, Formatter, Result as Printed};

/// A fact about formulas at every point of the scope that it is proved in.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Fact {
    /// `a == b`: both have the same value, a number or an infinity, or neither has one.
    Same(Formula, Formula),
    /// `a < b`, both being finite.
    Less(Formula, Formula),
    /// `a <= b`, both being finite.
    AtMost(Formula, Formula),
    /// `a != b`, both being finite.
    Different(Formula, Formula),
    /// `finite a`: the formula has a value, and it is a number.
    Finite(Formula),
    /// `integer a`: its value is an integer.
    Integer(Formula),
    /// `undefined a`: it has no value.
    Undefined(Formula),
}

use Fact::{AtMost, Different, Finite, Integer, Less, Same, Undefined};

impl Fact {
    /// Reads a fact as it is printed.
    ///
    /// # Errors
    /// A [`Diagnostic`] whose span lies in `text`.
    pub fn parse(text: &str) -> Result<Fact, Diagnostic> {
        type Word = (&'static str, fn(Formula) -> Fact);
        let words: [Word; 3] = [
            ("finite ", Finite),
            ("integer ", Integer),
            ("undefined ", Undefined),
        ];
        match parse_condition(text) {
            Ok(condition) => Fact::of_condition(&condition)
                .filter(|facts| facts.len() == 1)
                .and_then(|mut facts| facts.pop())
                .ok_or_else(|| Diagnostic {
                    span: Span {
                        start: 0,
                        end: text.len(),
                    },
                    message: "a fact is one relation".to_string(),
                    hint: None,
                }),
            Err(error) => {
                for (word, fact) in words {
                    if let Some(rest) = text.strip_prefix(word) {
                        return match parse_formula(rest) {
                            Ok(formula) => Ok(fact(formula)),
                            Err(error) => Err(error.shifted(word.len())),
                        };
                    }
                }
                Err(error)
            }
        }
    }

    /// The facts that a condition made of chains and `and` consists of.
    pub fn of_condition(condition: &Condition) -> Option<Vec<Fact>> {
        match condition {
            Condition::Chain(first, links) => {
                let mut left = first;
                let mut facts = Vec::new();
                for (relation, right) in links {
                    facts.push(Fact::of_relation(left, *relation, right)?);
                    left = right;
                }
                Some(facts)
            }
            Condition::And(parts) => {
                let facts: Option<Vec<_>> = parts.iter().map(Fact::of_condition).collect();
                Some(facts?.concat())
            }
            Condition::Or(_) | Condition::Not(_) => None,
        }
    }

    /// One relation; `a > b` is `b < a`.
    pub fn of_relation(a: &Formula, relation: Relation, b: &Formula) -> Option<Fact> {
        let (a, b) = (a.clone(), b.clone());
        Some(match relation {
            Relation::Equal => Same(a, b),
            Relation::NotEqual => Different(a, b),
            Relation::Less => Less(a, b),
            Relation::LessEqual => AtMost(a, b),
            Relation::Greater => Less(b, a),
            Relation::GreaterEqual => AtMost(b, a),
            Relation::Asymptotic | Relation::Approximate => return None,
        })
    }

    /// The formulas that it is about.
    pub fn sides(&self) -> Vec<&Formula> {
        match self {
            Same(a, b) | Less(a, b) | AtMost(a, b) | Different(a, b) => vec![a, b],
            Finite(a) | Integer(a) | Undefined(a) => vec![a],
        }
    }

    /// The names whose meaning it depends on.
    pub(super) fn names(&self) -> BTreeSet<Name> {
        self.sides().into_iter().flat_map(free_names).collect()
    }

    /// What holds where it does not, for relations between finite numbers.
    pub fn negation(&self) -> Option<Fact> {
        match self.clone() {
            Same(a, b) => Some(Different(a, b)),
            Different(a, b) => Some(Same(a, b)),
            Less(a, b) => Some(AtMost(b, a)),
            AtMost(a, b) => Some(Less(b, a)),
            Finite(_) | Integer(_) | Undefined(_) => None,
        }
    }
}

impl Display for Fact {
    fn fmt(&self, f: &mut Formatter<'_>) -> Printed {
        match self {
            Same(a, b) => write!(f, "{a} == {b}"),
            Less(a, b) => write!(f, "{a} < {b}"),
            AtMost(a, b) => write!(f, "{a} <= {b}"),
            Different(a, b) => write!(f, "{a} != {b}"),
            Finite(a) => write!(f, "finite {a}"),
            Integer(a) => write!(f, "integer {a}"),
            Undefined(a) => write!(f, "undefined {a}"),
        }
    }
}
