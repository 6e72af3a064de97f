//! Capture-avoiding substitution of names by formulas and of function symbols by bodies.
//!
//! All replacements are made at once: what is put in is not searched again. A binder whose name
//! occurs in what is put under it is renamed by primes. `diff(e, x)` and the antiderivative
//! `int(e, x)` are functions of the outer `x`: putting `a` for `x` gives `at(diff(e, x), x = a)`.
//!
//! Definitions can double a formula at every step, so the work is bounded: more than [`MAX_NODES`]
//! nodes made, or a tree deeper than [`MAX_DEPTH`], is an error.

use super::names::functions_into;
use super::{
    Condition, Draw, Duty, Formula, Law, MAX_DEPTH, Name, Part, Ranged, Regime, Statement, Target,
    Tendency, free_names, is_over_draws,
};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// How many nodes a substitution may make.
pub const MAX_NODES: usize = 200_000;

/// A substitution's result would be too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TooLarge {
    #[error("with its definitions unfolded the formula has more than {MAX_NODES} nodes")]
    Nodes,
    #[error("with its definitions unfolded the formula is more than {MAX_DEPTH} deep")]
    Depth,
}

/// What to put in the place of names and function symbols.
#[derive(Clone, Debug, Default)]
pub struct Substitution {
    values: Environment,
    functions: BTreeMap<Name, Body>,
}

#[derive(Clone, Debug)]
struct Body {
    arguments: Vec<Name>,
    formula: Formula,
    /// The body's free names that are no arguments.
    free: BTreeSet<Name>,
}

/// A formula to put in, measured once.
#[derive(Debug)]
struct Replacement {
    formula: Formula,
    nodes: usize,
    depth: usize,
    free: BTreeSet<Name>,
}

type Environment = BTreeMap<Name, Arc<Replacement>>;

impl Replacement {
    fn new(formula: Formula) -> Arc<Replacement> {
        let part = Part::Formula(&formula);
        Arc::new(Replacement {
            nodes: part.nodes(MAX_NODES),
            depth: part.depth(),
            free: free_names(&formula),
            formula,
        })
    }
}

/// Puts formulas in the place of names, all at once.
///
/// # Errors
/// [`TooLarge`] when the result is.
pub fn substitute(formula: &Formula, values: &[(Name, Formula)]) -> Result<Formula, TooLarge> {
    let mut substitution = Substitution::default();
    for (name, value) in values {
        substitution.value(name.clone(), value.clone());
    }
    substitution.formula(formula)
}

impl Substitution {
    /// Nothing to replace.
    pub fn new() -> Substitution {
        Substitution::default()
    }

    /// Whether there is nothing to replace.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty() && self.functions.is_empty()
    }

    /// Puts `formula` for `name` from now on.
    pub fn value(&mut self, name: Name, formula: Formula) {
        self.values.insert(name, Replacement::new(formula));
    }

    /// Puts `formula`, with the arguments in it, for applications of `name` to as many arguments.
    pub fn function(&mut self, name: Name, arguments: Vec<Name>, formula: Formula) {
        let mut free = free_names(&formula);
        for argument in &arguments {
            free.remove(argument);
        }
        let body = Body {
            arguments,
            formula,
            free,
        };
        self.functions.insert(name, body);
    }

    /// The free names of what is put for a name, or for an application of it, but for the arguments.
    pub fn brings(&self, name: &Name) -> impl Iterator<Item = &Name> {
        let value = self.values.get(name).map(|value| &value.free);
        let body = self.functions.get(name).map(|body| &body.free);
        value.into_iter().chain(body).flatten()
    }

    /// Whether what is put for a name is taken over draws.
    pub fn is_over_draws(&self, name: &Name) -> bool {
        let value = self.values.get(name).map(|value| &value.formula);
        let body = self.functions.get(name).map(|body| &body.formula);
        let formulas = value.into_iter().chain(body);
        formulas.map(Part::Formula).any(is_over_draws)
    }

    /// The formula with all replacements made.
    ///
    /// # Errors
    /// [`TooLarge`] when the result is.
    pub fn formula(&self, formula: &Formula) -> Result<Formula, TooLarge> {
        self.work().formula(formula, &self.values, 0)
    }

    /// The condition with all replacements made.
    ///
    /// # Errors
    /// [`TooLarge`] when the result is.
    pub fn condition(&self, condition: &Condition) -> Result<Condition, TooLarge> {
        self.work().condition(condition, &self.values, 0)
    }

    /// The law with all replacements made.
    ///
    /// # Errors
    /// [`TooLarge`] when the result is.
    pub fn law(&self, law: &Law) -> Result<Law, TooLarge> {
        self.work().law(law, &self.values, 0)
    }

    /// The statement with all replacements made. The names of `uniformly in` and those to the left in
    /// `along` stay: they are parameters.
    ///
    /// # Errors
    /// [`TooLarge`] when the result is.
    pub fn statement(&self, statement: &Statement) -> Result<Statement, TooLarge> {
        self.work().statement(statement, &self.values)
    }

    /// A body with arguments, all replacements made but for the arguments, which may be renamed.
    ///
    /// # Errors
    /// [`TooLarge`] when the result is.
    pub fn lambda(
        &self,
        arguments: &[Name],
        body: &Formula,
    ) -> Result<(Vec<Name>, Formula), TooLarge> {
        let mut work = self.work();
        let binders: Vec<&Name> = arguments.iter().collect();
        let (arguments, inner) = work.bind(&binders, Part::Formula(body), &self.values);
        Ok((arguments, work.formula(body, &inner, 0)?))
    }

    fn work(&self) -> Work<'_> {
        Work {
            functions: &self.functions,
            left: MAX_NODES,
        }
    }
}

/// A substitution under way.
struct Work<'s> {
    functions: &'s BTreeMap<Name, Body>,
    /// How many nodes may still be made.
    left: usize,
}

impl Work<'_> {
    fn spend(&mut self, nodes: usize, depth: usize) -> Result<(), TooLarge> {
        if depth > MAX_DEPTH {
            return Err(TooLarge::Depth);
        }
        self.left = self.left.checked_sub(nodes).ok_or(TooLarge::Nodes)?;
        Ok(())
    }

    fn formula(
        &mut self,
        formula: &Formula,
        env: &Environment,
        depth: usize,
    ) -> Result<Formula, TooLarge> {
        let depth = depth + 1;
        self.spend(1, depth)?;
        Ok(match formula {
            Formula::Number(_) | Formula::Pi | Formula::Infinity => formula.clone(),
            Formula::Name(name) => return self.put(name, env, depth),
            Formula::Apply(name, list) => return self.apply(name, list, env, depth),
            Formula::Negate(e) => Formula::Negate(self.boxed(e, env, depth)?),
            Formula::Factorial(e) => Formula::Factorial(self.boxed(e, env, depth)?),
            Formula::BigO(e) => Formula::BigO(self.boxed(e, env, depth)?),
            Formula::LittleO(e) => Formula::LittleO(self.boxed(e, env, depth)?),
            Formula::Binary(operator, a, b) => Formula::Binary(
                *operator,
                self.boxed(a, env, depth)?,
                self.boxed(b, env, depth)?,
            ),
            Formula::Density(a, b) => {
                Formula::Density(self.boxed(a, env, depth)?, self.boxed(b, env, depth)?)
            }
            Formula::Cumulative(a, b) => {
                Formula::Cumulative(self.boxed(a, env, depth)?, self.boxed(b, env, depth)?)
            }
            Formula::Call(function, list) => Formula::Call(*function, self.list(list, env, depth)?),
            Formula::Indicator(c) => Formula::Indicator(Box::new(self.condition(c, env, depth)?)),
            Formula::Truth(c) => Formula::Truth(Box::new(self.condition(c, env, depth)?)),
            Formula::If(c, a, b) => Formula::If(
                Box::new(self.condition(c, env, depth)?),
                self.boxed(a, env, depth)?,
                self.boxed(b, env, depth)?,
            ),
            _ => return self.binder(formula, env, depth),
        })
    }

    fn binder(
        &mut self,
        formula: &Formula,
        env: &Environment,
        depth: usize,
    ) -> Result<Formula, TooLarge> {
        Ok(match formula {
            Formula::Ranged(r) => {
                let body = Part::Formula(&r.body);
                let (names, inner) = self.bind(&[&r.name], body, env);
                Formula::Ranged(Box::new(Ranged {
                    kind: r.kind,
                    body: self.formula(&r.body, &inner, depth)?,
                    name: names[0].clone(),
                    from: self.formula(&r.from, env, depth)?,
                    to: self.formula(&r.to, env, depth)?,
                }))
            }
            Formula::Antiderivative(e, x) => {
                return self.function_of(e, x, env, depth, Formula::Antiderivative);
            }
            Formula::Derivative(e, x, order) => {
                let order = self.boxed(order, env, depth)?;
                let make = |e, x| Formula::Derivative(e, x, order);
                return self.function_of(e, x, env, depth, make);
            }
            Formula::At(e, list) => {
                let (e, list) = self.bound(e, list, env, depth)?;
                Formula::At(e, list)
            }
            Formula::Limit(e, list) => {
                let (e, list) = self.bound(e, list, env, depth)?;
                Formula::Limit(e, list)
            }
            Formula::Mean(e, draw) => {
                let (inner, draw) = self.draw(Part::Formula(e), draw.as_deref(), env, depth)?;
                Formula::Mean(self.boxed(e, &inner, depth)?, draw)
            }
            Formula::Variance(e, draw) => {
                let (inner, draw) = self.draw(Part::Formula(e), draw.as_deref(), env, depth)?;
                Formula::Variance(self.boxed(e, &inner, depth)?, draw)
            }
            Formula::Probability(c, draw) => {
                let (inner, draw) = self.draw(Part::Condition(c), draw.as_deref(), env, depth)?;
                Formula::Probability(Box::new(self.condition(c, &inner, depth)?), draw)
            }
            // `formula` itself makes all others.
            other => other.clone(),
        })
    }

    fn boxed(
        &mut self,
        formula: &Formula,
        env: &Environment,
        depth: usize,
    ) -> Result<Box<Formula>, TooLarge> {
        self.formula(formula, env, depth).map(Box::new)
    }

    fn list(
        &mut self,
        list: &[Formula],
        env: &Environment,
        depth: usize,
    ) -> Result<Vec<Formula>, TooLarge> {
        list.iter().map(|e| self.formula(e, env, depth)).collect()
    }

    fn put(&mut self, name: &Name, env: &Environment, depth: usize) -> Result<Formula, TooLarge> {
        let Some(value) = env.get(name) else {
            return Ok(Formula::Name(name.clone()));
        };
        self.spend(value.nodes, depth - 1 + value.depth)?;
        Ok(value.formula.clone())
    }

    fn apply(
        &mut self,
        name: &Name,
        list: &[Formula],
        env: &Environment,
        depth: usize,
    ) -> Result<Formula, TooLarge> {
        let functions = self.functions;
        let body = functions
            .get(name)
            .filter(|body| body.arguments.len() == list.len());
        let Some(body) = body else {
            return Ok(Formula::Apply(name.clone(), self.list(list, env, depth)?));
        };
        let values = self.list(list, env, 0)?;
        let pairs = body.arguments.iter().cloned();
        let inner = pairs
            .zip(values.into_iter().map(Replacement::new))
            .collect();
        let mut plain = Work {
            functions: &BTreeMap::new(),
            left: self.left,
        };
        let result = plain.formula(&body.formula, &inner, depth - 1)?;
        self.left = plain.left;
        Ok(result)
    }

    /// The environment inside a binder of `names` over `body`, and the names it then binds.
    fn bind(&self, names: &[&Name], body: Part<'_>, env: &Environment) -> (Vec<Name>, Environment) {
        let free = body.free_names();
        let mut inner = env.clone();
        for name in names {
            inner.remove(*name);
        }
        inner.retain(|name, _| free.contains(name));
        let mut entering: BTreeSet<Name> = BTreeSet::new();
        for value in inner.values() {
            entering.extend(value.free.iter().cloned());
        }
        let mut applied = BTreeSet::new();
        functions_into(body, &mut applied);
        for name in &applied {
            if let Some(body) = self.functions.get(name) {
                entering.extend(body.free.iter().cloned());
            }
        }
        let mut taken: BTreeSet<Name> = &entering | &free;
        taken.extend(names.iter().map(|name| (*name).clone()));
        let renamed = names.iter().map(|name| {
            if !entering.contains(*name) {
                return (*name).clone();
            }
            let fresh = fresh(name, &taken);
            taken.insert(fresh.clone());
            inner.insert(
                (*name).clone(),
                Replacement::new(Formula::Name(fresh.clone())),
            );
            fresh
        });
        (renamed.collect(), inner)
    }

    /// `diff(e, x)` and `int(e, x)`: functions of the outer `x`.
    fn function_of(
        &mut self,
        body: &Formula,
        name: &Name,
        env: &Environment,
        depth: usize,
        make: impl FnOnce(Box<Formula>, Name) -> Formula,
    ) -> Result<Formula, TooLarge> {
        let (names, inner) = self.bind(&[name], Part::Formula(body), env);
        let own = Formula::Name(name.clone());
        let stays = env.get(name).is_none_or(|value| value.formula == own);
        if names[0] == *name && stays {
            return Ok(make(self.boxed(body, &inner, depth)?, name.clone()));
        }
        self.spend(2, depth + 1)?;
        let place = self.put(name, env, depth + 1)?;
        let inside = make(self.boxed(body, &inner, depth + 1)?, names[0].clone());
        Ok(Formula::At(
            Box::new(inside),
            vec![(names[0].clone(), place)],
        ))
    }

    #[allow(clippy::type_complexity)]
    fn bound(
        &mut self,
        body: &Formula,
        list: &[(Name, Formula)],
        env: &Environment,
        depth: usize,
    ) -> Result<(Box<Formula>, Vec<(Name, Formula)>), TooLarge> {
        let binders: Vec<&Name> = list.iter().map(|(name, _)| name).collect();
        let (names, inner) = self.bind(&binders, Part::Formula(body), env);
        let body = self.boxed(body, &inner, depth)?;
        let values = list
            .iter()
            .map(|(_, value)| self.formula(value, env, depth));
        let values = values.collect::<Result<Vec<_>, _>>()?;
        Ok((body, names.into_iter().zip(values).collect()))
    }

    /// The environment inside `mean(body, draw)`, and the draw with all replacements made.
    fn draw(
        &mut self,
        body: Part<'_>,
        draw: Option<&Draw>,
        env: &Environment,
        depth: usize,
    ) -> Result<(Environment, Option<Box<Draw>>), TooLarge> {
        let Some(draw) = draw else {
            return Ok((env.clone(), None));
        };
        let (names, inner) = self.bind(&[&draw.name], body, env);
        let law = self.law(&draw.law, env, depth)?;
        let name = names[0].clone();
        Ok((inner, Some(Box::new(Draw { name, law }))))
    }

    fn condition(
        &mut self,
        condition: &Condition,
        env: &Environment,
        depth: usize,
    ) -> Result<Condition, TooLarge> {
        let depth = depth + 1;
        self.spend(1, depth)?;
        let all = |work: &mut Self, items: &[Condition]| {
            let items = items.iter().map(|item| work.condition(item, env, depth));
            items.collect::<Result<Vec<_>, _>>()
        };
        Ok(match condition {
            Condition::Chain(first, links) => Condition::Chain(
                self.formula(first, env, depth)?,
                links
                    .iter()
                    .map(|(relation, e)| Ok((*relation, self.formula(e, env, depth)?)))
                    .collect::<Result<_, _>>()?,
            ),
            Condition::And(items) => Condition::And(all(self, items)?),
            Condition::Or(items) => Condition::Or(all(self, items)?),
            Condition::Not(inner) => Condition::Not(Box::new(self.condition(inner, env, depth)?)),
        })
    }

    fn law(&mut self, law: &Law, env: &Environment, depth: usize) -> Result<Law, TooLarge> {
        let depth = depth + 1;
        self.spend(1, depth)?;
        Ok(match law {
            Law::Beta(a, b) => {
                Law::Beta(self.formula(a, env, depth)?, self.formula(b, env, depth)?)
            }
            Law::Uniform(a, b) => {
                Law::Uniform(self.formula(a, env, depth)?, self.formula(b, env, depth)?)
            }
            Law::Order(l, m, inner) => Law::Order(
                self.formula(l, env, depth)?,
                self.formula(m, env, depth)?,
                Box::new(self.law(inner, env, depth)?),
            ),
            Law::Density {
                argument,
                body,
                from,
                to,
            } => {
                let (names, inner) = self.bind(&[argument], Part::Formula(body), env);
                Law::Density {
                    argument: names[0].clone(),
                    body: self.formula(body, &inner, depth)?,
                    from: self.formula(from, env, depth)?,
                    to: self.formula(to, env, depth)?,
                }
            }
            Law::Any => Law::Any,
        })
    }

    fn statement(
        &mut self,
        statement: &Statement,
        env: &Environment,
    ) -> Result<Statement, TooLarge> {
        Ok(match statement {
            Statement::Chain {
                first,
                links,
                regime,
            } => Statement::Chain {
                first: self.formula(first, env, 0)?,
                links: links
                    .iter()
                    .map(|(relation, e)| Ok((*relation, self.formula(e, env, 0)?)))
                    .collect::<Result<_, _>>()?,
                regime: match regime {
                    Some(regime) => Some(self.regime(regime, env)?),
                    None => None,
                },
            },
            Statement::All(items) => Statement::All(
                items
                    .iter()
                    .map(|item| self.statement(item, env))
                    .collect::<Result<_, _>>()?,
            ),
            Statement::Definition {
                name,
                arguments,
                body,
                duties,
            } => {
                let binders: Vec<&Name> = arguments.iter().collect();
                let (arguments, inner) = self.bind(&binders, Part::Formula(body), env);
                Statement::Definition {
                    name: name.clone(),
                    arguments,
                    body: self.formula(body, &inner, 0)?,
                    duties: duties
                        .iter()
                        .map(|duty| self.duty(duty, env))
                        .collect::<Result<_, _>>()?,
                }
            }
            Statement::Conditional { id, condition } => Statement::Conditional {
                id: id.clone(),
                condition: self.condition(condition, env, 0)?,
            },
            Statement::Words => Statement::Words,
            Statement::Empty => Statement::Empty,
        })
    }

    fn duty(&mut self, duty: &Duty, env: &Environment) -> Result<Duty, TooLarge> {
        Ok(match duty {
            Duty::Density(from, to) => {
                Duty::Density(self.formula(from, env, 0)?, self.formula(to, env, 0)?)
            }
            Duty::Cumulative(from, to) => {
                Duty::Cumulative(self.formula(from, env, 0)?, self.formula(to, env, 0)?)
            }
            Duty::Agrees(id) => Duty::Agrees(id.clone()),
        })
    }

    fn regime(&mut self, regime: &Regime, env: &Environment) -> Result<Regime, TooLarge> {
        let mut limits = Vec::new();
        for limit in &regime.limits {
            let joint = limit.iter().map(|tendency| {
                Ok(Tendency {
                    quantity: self.formula(&tendency.quantity, env, 0)?,
                    target: self.target(&tendency.target, env)?,
                })
            });
            limits.push(joint.collect::<Result<Vec<_>, TooLarge>>()?);
        }
        let mut along = Vec::new();
        for (name, value) in &regime.along {
            along.push((name.clone(), self.formula(value, env, 0)?));
        }
        Ok(Regime {
            limits,
            uniformly: regime.uniformly.clone(),
            along,
        })
    }

    fn target(&mut self, target: &Target, env: &Environment) -> Result<Target, TooLarge> {
        Ok(match target {
            Target::Infinity => Target::Infinity,
            Target::Point(e) => Target::Point(self.formula(e, env, 0)?),
            Target::Above(e) => Target::Above(self.formula(e, env, 0)?),
            Target::Below(e) => Target::Below(self.formula(e, env, 0)?),
        })
    }
}

/// The name with as many primes as make it new.
fn fresh(name: &str, taken: &BTreeSet<Name>) -> Name {
    let mut fresh = format!("{name}'");
    while taken.contains(fresh.as_str()) {
        fresh.push('\'');
    }
    fresh.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::parse_formula;

    fn check(text: &str, values: &[(&str, &str)], expected: &str) {
        let formula = parse_formula(text).expect(text);
        let values: Vec<(Name, Formula)> = values
            .iter()
            .map(|(name, value)| ((*name).into(), parse_formula(value).expect(value)))
            .collect();
        let result = substitute(&formula, &values).expect(text);
        assert_eq!(result.to_string(), expected);
    }

    #[test]
    fn replaces_all_at_once() {
        check("a + b", &[("a", "b"), ("b", "a")], "b + a");
        check("a^2", &[("a", "x + 1")], "(x + 1)^2");
    }

    #[test]
    fn binders_are_renamed_where_they_would_capture() {
        check("sum(j*a, j = j..a)", &[("a", "j")], "sum(j'*j, j' = j..j)");
        check("sum(j*a, j = j..a)", &[("j", "2")], "sum(j*a, j = 2..a)");
        check(
            "mean(x*a, x ~ beta(a, 1))",
            &[("a", "x")],
            "mean(x'*x, x' ~ beta(x, 1))",
        );
        check("lim(x*a, x -> a)", &[("a", "x")], "lim(x'*x, x' -> x)");
    }

    #[test]
    fn derivatives_are_functions_of_the_outer_variable() {
        check("diff(x^2, x)", &[("x", "3")], "at(diff(x^2, x), x = 3)");
        check("diff(x*a, x)", &[("a", "b")], "diff(x*b, x)");
        check("diff(x*a, x)", &[("x", "x"), ("a", "b")], "diff(x*b, x)");
        check("diff(x*a, x)", &[("a", "x")], "at(diff(x'*x, x'), x' = x)");
        check("int(x*a, x)", &[("x", "a")], "at(int(x*a, x), x = a)");
        check(
            "at(x*a, x = a)",
            &[("a", "x"), ("x", "7")],
            "at(x'*x, x' = x)",
        );
    }

    #[test]
    fn functions_take_their_bodies_and_nothing_is_captured() {
        let mut substitution = Substitution::new();
        let body = parse_formula("r*n").expect("a formula");
        substitution.function("F".into(), vec!["r".into()], body);
        let formula = parse_formula("sum(F(n)^2, n = 1..3) + F(F(2))").expect("a formula");
        let result = substitution.formula(&formula).expect("small");
        assert_eq!(result.to_string(), "sum((n'*n)^2, n' = 1..3) + 2*n*n");
    }

    #[test]
    fn doubling_is_refused() {
        let mut formula = parse_formula("a + a").expect("a formula");
        let double = formula.clone();
        let result = (0..40).try_for_each(|_| {
            formula = substitute(&double, &[("a".into(), formula.clone())])?;
            Ok(())
        });
        assert_eq!(result, Err(TooLarge::Nodes));
    }

    #[test]
    fn depth_is_refused() {
        let mut formula = parse_formula("-a").expect("a formula");
        let deeper = formula.clone();
        let result = (0..2000).try_for_each(|_| {
            formula = substitute(&deeper, &[("a".into(), formula.clone())])?;
            Ok(())
        });
        assert_eq!(result, Err(TooLarge::Depth));
    }
}
