//! What names mean while a formula is evaluated: bound variables from the inside out, then the point.

use super::quantity::{Quantity, Separable, Symbol};
use super::{Context, Failure, unsupported};
use crate::formula::{Budget, Draw, Formula, Name};
use crate::number::{Exact, Interval, convert};
use rug::Rational;
use std::cell::Cell;
use std::collections::BTreeMap;

/// What a bound variable stands for.
#[derive(Clone, Debug)]
pub(super) enum Binding {
    /// A number, or a function of symbols further out.
    Quantity(Quantity),
    /// A number that is known by enclosure only.
    Enclosed(Interval),
    /// A variable of integration. The sample is a place inside the piece that is integrated over, where
    /// the conditions of a piecewise integrand are decided.
    Symbol {
        symbol: Symbol,
        sample: Option<Rational>,
        draw: bool,
    },
}

/// The point, converted once.
pub(super) struct Root<'a> {
    context: &'a Context<'a>,
    numbers: BTreeMap<&'a Name, Exact>,
    symbols: Cell<Symbol>,
}

impl<'a> Root<'a> {
    pub fn new(context: &'a Context<'a>) -> Root<'a> {
        let numbers = context.point.numbers.iter();
        Root {
            context,
            numbers: numbers
                .map(|(name, value)| (name, Exact::from_rational(&convert::to_rug(value))))
                .collect(),
            symbols: Cell::new(0),
        }
    }
}

/// A chain of bindings that ends in the point.
#[derive(Clone, Copy)]
pub(super) struct Scope<'a> {
    root: &'a Root<'a>,
    inner: Option<&'a Link<'a>>,
}

/// One binding and what lies outside of it.
pub(super) struct Link<'a> {
    outer: Scope<'a>,
    name: &'a Name,
    binding: Binding,
}

impl<'a> Link<'a> {
    pub fn scope(&'a self) -> Scope<'a> {
        Scope {
            root: self.outer.root,
            inner: Some(self),
        }
    }
}

impl<'a> Scope<'a> {
    pub fn new(root: &'a Root<'a>) -> Scope<'a> {
        Scope { root, inner: None }
    }

    /// One more binding; [`Link::scope`] is the scope with it.
    pub fn bind<'b>(&self, name: &'b Name, binding: Binding) -> Link<'b>
    where
        'a: 'b,
    {
        Link {
            outer: *self,
            name,
            binding,
        }
    }

    /// Without any bindings but the point.
    pub fn outermost(&self) -> Scope<'a> {
        Scope::new(self.root)
    }

    pub fn budget(&self) -> &'a Budget {
        self.root.context.budget
    }

    pub fn spend(&self, steps: u64) -> Result<(), Failure> {
        Ok(self.budget().spend(steps)?)
    }

    /// The binding of a name, if it is a bound variable.
    pub fn binding(&self, name: &Name) -> Option<&'a Binding> {
        let mut next = self.inner;
        while let Some(link) = next {
            if link.name == name {
                return Some(&link.binding);
            }
            next = link.outer.inner;
        }
        None
    }

    /// The value of a name.
    pub fn lookup(&self, name: &Name) -> Result<Quantity, Failure> {
        match self.binding(name) {
            Some(Binding::Quantity(quantity)) => Ok(quantity.clone()),
            Some(Binding::Enclosed(_)) => Err(unsupported(format!("{name} exactly"))),
            Some(Binding::Symbol { symbol, .. }) => Ok(Quantity::Open(Separable::symbol(*symbol))),
            None => self
                .parameter(name)
                .map(|value| Quantity::Closed(value.clone())),
        }
    }

    /// The value of a parameter.
    pub fn parameter(&self, name: &Name) -> Result<&'a Exact, Failure> {
        let known = self.root.numbers.get(name);
        known.ok_or_else(|| match self.draw(name) {
            Some(_) => unsupported(format!("the draw {name} outside of a mean")),
            None => unsupported(format!("{name}, which has no value")),
        })
    }

    /// The polynomial that stands for a function parameter: its argument and body.
    pub fn function(&self, name: &Name) -> Result<(&'a Name, &'a Formula), Failure> {
        let known = self.root.context.point.functions.get(name);
        let (argument, body) =
            known.ok_or_else(|| unsupported(format!("the function {name}, which has no value")))?;
        Ok((argument, body))
    }

    /// The draw of that name.
    pub fn draw(&self, name: &Name) -> Option<&'a Draw> {
        self.root
            .context
            .draws
            .iter()
            .find(|draw| draw.name == *name)
    }

    /// A symbol that no other binding has.
    pub fn new_symbol(&self) -> Symbol {
        let symbol = self.root.symbols.get();
        self.root.symbols.set(symbol.wrapping_add(1));
        symbol
    }

    /// The sample of a symbol in scope.
    pub fn sample(&self, wanted: Symbol) -> Option<&'a Rational> {
        let mut next = self.inner;
        while let Some(link) = next {
            match &link.binding {
                Binding::Symbol { symbol, sample, .. } if *symbol == wanted => {
                    return sample.as_ref();
                }
                _ => next = link.outer.inner,
            }
        }
        None
    }

    /// The draws among the names, none of which may be a bound variable of another kind.
    pub fn draws_among<'n>(
        &self,
        names: impl IntoIterator<Item = &'n Name>,
    ) -> Result<Vec<&'a Draw>, Failure> {
        let mut draws = vec![];
        for name in names {
            let Some(draw) = self.draw(name) else {
                continue;
            };
            match self.binding(name) {
                None | Some(Binding::Symbol { draw: true, .. }) => draws.push(draw),
                Some(_) => {
                    return Err(unsupported(format!(
                        "{name} both as draw and bound variable"
                    )));
                }
            }
        }
        Ok(draws)
    }
}
