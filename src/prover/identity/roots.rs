//! Roots raised to their power: `(b^(1/3))^3 == b` inside rational functions.

use super::atoms::Equations;
use super::builder::Builder;
use super::form::{integer, minus, over, plus, power, times};
use super::powers::rational_exponent;
use crate::algebra::{Polynomial, RationalFunction, Symbol};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule, Step};
use std::collections::BTreeMap;

/// A root that is left as an atom: its formula, its degree, and the equation for its power.
struct Root {
    power: Formula,
    degree: u32,
    step: Step,
    atom: Formula,
}

type Roots = BTreeMap<Symbol, Root>;

impl Builder<'_> {
    /// States `a == b`, which differ by powers of roots once the equations are used.
    pub(super) fn equal_by_roots(
        &mut self,
        a: &Formula,
        b: &Formula,
        equations: &Equations,
    ) -> Option<Step> {
        let roots = self.roots(equations)?;
        let (first, from) = self.reduced(a, &roots, equations)?;
        let (second, to) = self.reduced(b, &roots, equations)?;
        let rest = equations.difference(self, &first, &second)?;
        if !rest.is_zero() {
            let middle = self.equal_by_rest((&first, &second), &rest, &roots, equations)?;
            return self.chain(&[from, middle, to], a, b);
        }
        let middle = self.ring(&first, &second, &equations.steps())?;
        self.chain(&[from, middle, to], a, b)
    }

    /// `a == b`, where the numerator of their difference is 0 once roots are raised in it.
    fn equal_by_rest(
        &mut self,
        (a, b): (&Formula, &Formula),
        rest: &RationalFunction,
        roots: &Roots,
        equations: &Equations,
    ) -> Option<Step> {
        let rest = self.field.borrow().write(rest);
        let (above, below) = match &rest {
            Formula::Binary(Operator::Divide, above, below) => (&**above, &**below),
            whole => (whole, &integer(1)),
        };
        let (raised, first) = self.reduced(above, roots, equations)?;
        let second = self.ring(&raised, &integer(0), &equations.steps())?;
        let vanishes = self.chain(&[first, second], above, &integer(0))?;
        let with = |above: &Formula| plus(a.clone(), over(above.clone(), below.clone()));
        let (sum, none) = (with(above), with(&integer(0)));
        self.finite(&sum)?;
        let first = self.ring(a, &none, &[])?;
        let second = self.congruent(&sum, &none, &[vanishes])?;
        let third = self.ring(&sum, b, &equations.steps())?;
        self.chain(&[first, second, third], a, b)
    }

    /// The formula with its roots raised to their powers.
    pub(super) fn without_roots(&mut self, e: &Formula) -> Option<(Formula, Step)> {
        let equations = Equations::find(self, &[e], &[])?;
        let roots = self.roots(&equations)?;
        self.reduced(e, &roots, &equations)
    }

    /// The roots among the atoms that no equation replaces, if there are any.
    fn roots(&mut self, equations: &Equations) -> Option<Roots> {
        let atoms: Vec<(Symbol, Formula)> = equations
            .rest()
            .map(|(symbol, atom)| (symbol.clone(), atom.clone()))
            .collect();
        let mut roots = Roots::new();
        for (symbol, atom) in atoms {
            if let Some(root) = self.attempt(|builder| builder.raised_root(&atom)) {
                roots.insert(symbol, root);
            }
        }
        (!roots.is_empty()).then_some(roots)
    }

    /// `(b^(c/d))^d == b^c`; a cosine is the root of `1 - sin(x)^2`.
    fn raised_root(&mut self, atom: &Formula) -> Option<Root> {
        if let Formula::Call(Function::Cos, parts) = atom {
            let sine = Formula::Call(Function::Sin, parts.clone());
            let square = |e: &Formula| power(e.clone(), integer(2));
            let (raised, right) = (square(atom), minus(integer(1), square(&sine)));
            let step = self.step(Fact::Same(raised.clone(), right), Rule::Circle, &[], &[])?;
            return Some(Root {
                power: raised,
                degree: 2,
                step,
                atom: atom.clone(),
            });
        }
        let (base, exponent) = rational_exponent(self, atom)?;
        let degree = exponent.denom().to_u32()?;
        let d = integer(i64::from(degree));
        let raised = power(atom.clone(), d.clone());
        let numerator = exponent.numer().to_i64()?;
        let right = power(base.clone(), integer(numerator));
        let Formula::Binary(_, _, p) = atom else {
            return None;
        };
        self.splittable(&[&base], &[p, &d])?;
        let step = self.step(Fact::Same(raised.clone(), right), Rule::Power, &[], &[])?;
        Some(Root {
            power: raised,
            degree,
            step,
            atom: atom.clone(),
        })
    }

    /// The formula with powers of roots replaced, and the equation that says so.
    fn reduced(
        &mut self,
        e: &Formula,
        roots: &Roots,
        equations: &Equations,
    ) -> Option<(Formula, Step)> {
        let normal = self.field.borrow_mut().normal(e)?;
        let normal = equations.replaced(self, normal)?;
        let shown = write(self, &normal, roots, &|root| root.power.clone());
        let new = write(self, &normal, roots, &|root| {
            self.right(root.step).unwrap_or_else(|| root.power.clone())
        });
        self.finite(&shown)?;
        let first = self.ring(e, &shown, &equations.steps())?;
        let steps: Vec<Step> = roots.values().map(|root| root.step).collect();
        let second = self.congruent(&shown, &new, &steps)?;
        self.finite(&new)?;
        Some((new.clone(), self.chain(&[first, second], e, &new)?))
    }
}

type Raised<'a> = &'a dyn Fn(&Root) -> Formula;

fn write(builder: &Builder, function: &RationalFunction, roots: &Roots, raised: Raised) -> Formula {
    let above = write_polynomial(builder, function.numerator(), roots, raised);
    let factors = function.denominator().iter();
    let below = factors.map(|(factor, e)| {
        let lone = (factor.len() == 1)
            .then(|| factor.symbols().into_iter().next())
            .flatten();
        match lone.and_then(|symbol| Some((roots.get(&symbol)?, symbol))) {
            Some((root, _)) => write_root(root, *e, raised),
            None => exponentiated(write_polynomial(builder, factor, roots, raised), *e),
        }
    });
    match below.reduce(times) {
        None => above,
        Some(below) => over(above, below),
    }
}

fn write_polynomial(
    builder: &Builder,
    polynomial: &Polynomial,
    roots: &Roots,
    raised: Raised,
) -> Formula {
    let field = builder.field.borrow();
    let terms = polynomial.terms().rev().map(|(monomial, coefficient)| {
        let mut term = super::form::number(&crate::number::convert::from_rug(coefficient));
        for (symbol, exponent) in monomial.powers() {
            let factor = match roots.get(symbol) {
                Some(root) => write_root(root, *exponent, raised),
                None => exponentiated(field.formula(symbol), *exponent),
            };
            term = times(term, factor);
        }
        term
    });
    terms.reduce(plus).unwrap_or_else(|| integer(0))
}

/// The power of a root: as many whole powers as there are in it, and the rest.
fn write_root(root: &Root, exponent: u32, raised: Raised) -> Formula {
    let (whole, rest) = (exponent / root.degree, exponent % root.degree);
    let whole = (whole > 0).then(|| exponentiated(raised(root), whole));
    let rest = (rest > 0).then(|| exponentiated(root.atom.clone(), rest));
    let parts = [whole, rest].into_iter().flatten();
    parts.reduce(times).unwrap_or_else(|| integer(1))
}

fn exponentiated(base: Formula, exponent: u32) -> Formula {
    match exponent {
        1 => base,
        _ => power(base, integer(i64::from(exponent))),
    }
}
