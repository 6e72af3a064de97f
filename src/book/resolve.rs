//! Which names a scope declares, and whether what a line mentions is among them.

use super::{Definition, Scope};
use crate::formula::parser::{Mention, MentionKind, callable};
use crate::formula::{Diagnostic, Draw, Name, Parameter, ParameterKind, nearest};
use std::collections::HashMap;

/// What a declared name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Symbol {
    Parameter,
    Draw,
    Definition,
    /// A function of so many arguments.
    Function(usize),
}

/// The declared names.
#[derive(Clone, Debug, Default)]
pub(super) struct Symbols {
    known: HashMap<Name, Symbol>,
}

impl Symbols {
    pub fn of(scope: &Scope) -> Symbols {
        let mut symbols = Symbols::default();
        for parameter in &scope.parameters {
            symbols.declare(parameter.name.clone(), of_parameter(parameter));
        }
        for definition in &scope.definitions {
            symbols.declare(definition.name.clone(), of_definition(definition));
        }
        for Draw { name, .. } in &scope.draws {
            symbols.declare(name.clone(), Symbol::Draw);
        }
        symbols
    }

    /// Declares a name; `false` if it was declared before.
    pub fn declare(&mut self, name: Name, symbol: Symbol) -> bool {
        self.known.insert(name, symbol).is_none()
    }

    pub fn get(&self, name: &str) -> Option<Symbol> {
        self.known.get(name).copied()
    }

    /// Checks that every mention is of a declared name used as what it is.
    pub fn check(&self, mentions: &[Mention]) -> Result<(), Diagnostic> {
        mentions
            .iter()
            .try_for_each(|mention| self.check_one(mention))
    }

    pub fn check_one(&self, mention: &Mention) -> Result<(), Diagnostic> {
        let name = &*mention.name;
        let (message, hint) = match (mention.kind, self.get(name)) {
            (MentionKind::Truth | MentionKind::Order, _) => return Ok(()),
            (MentionKind::Value, Some(Symbol::Function(_))) => (
                format!("`{name}` is a function"),
                Some(format!("write `{name}(...)`")),
            ),
            (MentionKind::Value, Some(_)) => return Ok(()),
            (MentionKind::Function(found), Some(Symbol::Function(wanted))) => {
                if found == wanted {
                    return Ok(());
                }
                let plural = if wanted == 1 { "" } else { "s" };
                (
                    format!("`{name}` takes {wanted} argument{plural}, found {found}"),
                    None,
                )
            }
            (MentionKind::Function(_), Some(_)) => (
                format!("`{name}` is no function"),
                Some(format!("a product is written with `*`: `{name}*(...)`")),
            ),
            (MentionKind::Value, None) => (
                format!("the name `{name}` is not declared"),
                self.like(name, false),
            ),
            (MentionKind::Function(_), None) => (
                format!("the function `{name}` is not known"),
                self.like(name, true),
            ),
        };
        Err(Diagnostic {
            span: mention.span,
            message,
            hint,
        })
    }

    /// The nearest declared name of the same sort, as a hint.
    fn like(&self, name: &str, function: bool) -> Option<String> {
        let sort = |symbol: &Symbol| matches!(symbol, Symbol::Function(_)) == function;
        let mut declared: Vec<&str> = self
            .known
            .iter()
            .filter(|(_, symbol)| sort(symbol))
            .map(|(known, _)| &**known)
            .collect();
        declared.sort_unstable();
        if function {
            if let Some(ours) = alias(name) {
                return Some(format!("write `{ours}`"));
            }
            for known in callable() {
                declared.push(known);
            }
        }
        nearest(name, declared).map(|near| format!("is `{near}` meant?"))
    }
}

/// Names that other systems give to our functions.
fn alias(name: &str) -> Option<&'static str> {
    Some(match name {
        "log" | "Log" | "Ln" => "ln(...)",
        "E" | "expectation" => "mean(...)",
        "Var" | "variance" => "var(...)",
        "P" | "Prob" => "prob(...)",
        "integral" | "integrate" => "int(e, x = a..b)",
        "factorial" => "n!",
        "choose" | "Binomial" => "binomial(n, k)",
        "Hypergeometric2F1" => "hyp2f1(a, b; c; z)",
        _ => return None,
    })
}

/// What a parameter stands for.
pub(super) fn of_parameter(parameter: &Parameter) -> Symbol {
    match parameter.kind {
        ParameterKind::Function { .. } => Symbol::Function(1),
        _ => Symbol::Parameter,
    }
}

/// What a definition stands for.
pub(super) fn of_definition(definition: &Definition) -> Symbol {
    match definition.arguments.len() {
        0 => Symbol::Definition,
        arity => Symbol::Function(arity),
    }
}
