//! The rules of means, densities and the functions that are defined by them.

use super::super::known::{above, minus};
use super::super::{Fact, Rejected, reject, require};
use super::integral::{is_continuous, states};
use super::{Check, Checked, depends, put};
use crate::formula::{
    Draw, Formula, Function, FunctionKind, Law, Name, Operator, ParameterKind, Part, RangeKind,
    Ranged, free_names, substitute,
};

use Operator::{Add, Divide, Multiply, Power, Subtract};

/// A density at a place, and the ends of its support.
type Density = (Formula, Formula, Formula);

impl<'a> Check<'a, '_> {
    pub(super) fn draw(&self) -> Checked {
        let (e, own) = match self.equation()? {
            (Formula::Mean(e, None), Formula::Mean(g, Some(own)))
            | (Formula::Variance(e, None), Formula::Variance(g, Some(own)))
                if e == g =>
            {
                (e, own)
            }
            _ => return reject("the rule gives a mean or a variance its draw"),
        };
        let names = free_names(e);
        let draws = &self.proof.proposition.draws;
        let drawn: Vec<&Draw> = draws
            .iter()
            .filter(|draw| names.contains(&draw.name))
            .collect();
        require(drawn == [&**own], "it is not the only draw in the formula")?;
        let names = Part::Law(&own.law).free_names();
        let closed = draws.iter().all(|draw| !names.contains(&draw.name));
        require(closed, "a law that depends on a draw")
    }

    pub(super) fn probability(&self) -> Checked {
        let Formula::Probability(condition, draw) = self.equation()?.0 else {
            return reject("the rule is for probabilities");
        };
        let indicator = Formula::Indicator(condition.clone());
        self.concludes(&Formula::Mean(Box::new(indicator), draw.clone()))
    }

    pub(super) fn density(&self) -> Checked {
        match self.equation()?.0 {
            Formula::Mean(e, Some(draw)) => {
                let own = Part::Law(&draw.law).free_names().contains(&draw.name);
                require(!own, "the law depends on a name like its draw's")?;
                let x = Formula::Name(draw.name.clone());
                let (density, from, to) = self.density_of(&draw.law, &x)?;
                let body = Formula::binary(Multiply, density, (**e).clone());
                self.concludes(&integral(body, &draw.name, from, to))
            }
            Formula::Density(drawn, at) => {
                let draws = &self.proof.proposition.draws;
                let draw = draws
                    .iter()
                    .find(|draw| **drawn == Formula::Name(draw.name.clone()));
                let Some(draw) = draw else {
                    return reject("the density of what is no draw");
                };
                let (density, from, to) = self.density_of(&draw.law, at)?;
                self.is_nonnegative(&above(&from, at))?;
                self.is_nonnegative(&above(at, &to))?;
                self.concludes(&density)
            }
            _ => reject("the rule is for means and densities"),
        }
    }

    /// The density of a law at x, where the law is one.
    fn density_of(&self, law: &Law, x: &Formula) -> Result<Density, Rejected> {
        let one = Formula::integer(1);
        match law {
            Law::Beta(p, q) => {
                self.is_positive(p)?;
                self.is_positive(q)?;
                let beta = Formula::Call(Function::Beta, vec![p.clone(), q.clone()]);
                let density = Formula::binary(Divide, beta_weight(p, q, x), beta);
                Ok((density, Formula::integer(0), one))
            }
            Law::Uniform(a, b) => {
                let width = minus(b, a);
                self.is_positive(&width)?;
                Ok((Formula::binary(Divide, one, width), a.clone(), b.clone()))
            }
            Law::Density {
                argument,
                body,
                from,
                to,
            } => {
                self.is_positive(&above(from, to))?;
                let (y, fact) = self.on_range(0, (from, to), false, false)?;
                require(
                    y == argument || !depends(body, y),
                    "a name of the density is in use",
                )?;
                let there = put(body, argument, &Formula::Name(y.clone()))?;
                states(fact, &Fact::AtMost(Formula::integer(0), there))?;
                let total = integral(body.clone(), argument, from.clone(), to.clone());
                states(self.plain(1)?, &Fact::Same(total, one))?;
                Ok((put(body, argument, x)?, from.clone(), to.clone()))
            }
            Law::Order(l, m, of) => {
                self.is_integer(l)?;
                self.is_integer(m)?;
                self.is_nonnegative(&minus(l, &one))?;
                self.is_nonnegative(&minus(m, l))?;
                let (f, from, to) = self.density_of(of, x)?;
                let below = match &**of {
                    Law::Uniform(a, b) => Formula::binary(Divide, minus(x, a), minus(b, a)),
                    Law::Density {
                        argument,
                        body,
                        from,
                        ..
                    } => integral(body.clone(), argument, from.clone(), x.clone()),
                    _ => return reject("an order statistic of a law without a rule"),
                };
                Ok((order_density(l, m, below, f), from, to))
            }
            Law::Any => reject("a law that is not given"),
        }
    }

    pub(super) fn variance(&self) -> Checked {
        let (Fact::Same(left, _) | Fact::Undefined(left)) = self.fact else {
            return reject("the rule is for variances");
        };
        let Formula::Variance(e, Some(draw)) = left else {
            return reject("the rule is for variances over a draw");
        };
        let mean = |e: Formula| Formula::Mean(Box::new(e), Some(draw.clone()));
        let variance = |e: &Formula| Formula::Variance(Box::new(e.clone()), Some(draw.clone()));
        let square = |e: Formula| Formula::binary(Power, e, Formula::integer(2));
        let first = mean((**e).clone());
        let right = match self.fact {
            Fact::Same(_, right) => right,
            _ => return states(self.plain(0)?, &Fact::Same(first, Formula::Infinity)),
        };
        if let Formula::Mean(..) = right {
            self.is_finite(&first)?;
            let own = Part::Law(&draw.law).free_names().contains(&draw.name);
            require(!own, "the law depends on a name like its draw's")?;
            return self.concludes(&mean(square(minus(e, &first))));
        }
        let constant = |c: &Formula| {
            require(!depends(c, &draw.name), "what is no constant")?;
            self.is_finite(c)
        };
        match (&**e, right) {
            (Formula::Binary(Add | Subtract, g, c), Formula::Variance(h, _)) if g == h => {
                constant(c)?;
                self.concludes(&variance(g))
            }
            (Formula::Binary(Add, c, g), Formula::Variance(..)) => {
                constant(c)?;
                self.concludes(&variance(g))
            }
            (Formula::Binary(Multiply, c, g), Formula::Binary(Multiply, ..)) => {
                constant(c)?;
                let rest = variance(g);
                // 0 times what is infinite has no value, but the variance of 0 has one.
                if self.is_nonzero(c).is_err() {
                    self.is_finite(&rest)?;
                }
                self.concludes(&Formula::binary(Multiply, square((**c).clone()), rest))
            }
            _ => {
                let second = mean(square((**e).clone()));
                self.concludes(&minus(&second, &square(first)))
            }
        }
    }

    pub(super) fn beta_integral(&self) -> Checked {
        let (left, right) = self.equation()?;
        let (Formula::Call(Function::Beta, parts), Formula::Ranged(r)) = (left, right) else {
            return reject("the rule gives a beta function as an integral");
        };
        let [a, b] = parts.as_slice() else {
            return reject("a beta function of two arguments");
        };
        self.is_positive(a)?;
        self.is_positive(b)?;
        require(!depends(left, &r.name), "the variable's name is in use")?;
        let weight = beta_weight(a, b, &Formula::Name(r.name.clone()));
        self.concludes(&over_unit(weight, &r.name))
    }

    pub(super) fn euler(&self) -> Checked {
        let (left, right) = self.equation()?;
        let (Formula::Call(Function::Hyp2F1, parts), Formula::Binary(Divide, over, _)) =
            (left, right)
        else {
            return reject("the rule gives hyp2f1 as an integral over a beta function");
        };
        let ([a, b, c, z], Formula::Ranged(r)) = (parts.as_slice(), &**over) else {
            return reject("the rule gives hyp2f1 as an integral over a beta function");
        };
        let one = Formula::integer(1);
        let rest = minus(c, b);
        self.is_finite(a)?;
        self.is_positive(b)?;
        self.is_positive(&rest)?;
        self.is_positive(&minus(&one, z))?;
        require(!depends(left, &r.name), "the variable's name is in use")?;
        let x = Formula::Name(r.name.clone());
        let kernel = minus(&one, &Formula::binary(Multiply, z.clone(), x.clone()));
        let kernel = Formula::binary(Power, kernel, Formula::Negate(Box::new(a.clone())));
        let body = Formula::binary(Multiply, beta_weight(b, &rest, &x), kernel);
        let beta = Formula::Call(Function::Beta, vec![b.clone(), rest]);
        self.concludes(&Formula::binary(Divide, over_unit(body, &r.name), beta))
    }

    pub(super) fn regularized(&self) -> Checked {
        let Formula::Call(Function::Hyp2F1Regularized, parts) = self.equation()?.0 else {
            return reject("the rule is for hyp2f1r");
        };
        let plain = Formula::Call(Function::Hyp2F1, parts.clone());
        self.is_finite(&plain)?;
        let gamma = Formula::Call(Function::Gamma, vec![parts[2].clone()]);
        self.concludes(&Formula::binary(Divide, plain, gamma))
    }

    pub(super) fn limit(&self) -> Checked {
        let (left, right) = self.equation()?;
        let Formula::Limit(mean, places) = left else {
            return reject("the rule is for limits");
        };
        let Formula::Mean(e, Some(draw)) = &**mean else {
            return reject("the rule is for limits of means over a draw");
        };
        let Law::Beta(p, q) = &draw.law else {
            return reject("the rule is for means over beta laws");
        };
        let names: Vec<&Name> = places.iter().map(|(name, _)| name).collect();
        let fixed = names
            .iter()
            .all(|name| !depends(e, name) || **name == draw.name);
        require(fixed, "the integrand depends on what moves")?;
        for (_, target) in places {
            self.is_finite(target)?;
        }
        let mut there = Vec::new();
        for parameter in [p, q] {
            is_polynomial(parameter, &names)?;
            let target = substitute(parameter, places)?;
            self.is_positive(&target)?;
            there.push(target);
        }
        let (zero, one) = (Formula::integer(0), Formula::integer(1));
        let (y, fact) = self.on_range(0, (&zero, &one), true, false)?;
        require(
            draw.name == *y || !depends(e, y),
            "a name of the integrand is in use",
        )?;
        let e_there = put(e, &draw.name, &Formula::Name(y.clone()))?;
        states(fact, &Fact::Finite(e_there.clone()))?;
        is_continuous(&e_there, y)?;
        let law = Law::Beta(there.remove(0), there.remove(0));
        let own = Draw {
            name: draw.name.clone(),
            law,
        };
        let found = Formula::Mean(e.clone(), Some(Box::new(own)));
        require(*right == found, "the rule gives another mean")
    }

    pub(super) fn function(&self) -> Checked {
        let (integral, wanted) = match self.fact {
            Fact::Same(integral, one) if *one == Formula::integer(1) => {
                (integral, FunctionKind::Density)
            }
            Fact::Finite(integral) => (integral, FunctionKind::Integrable),
            _ => return reject("the rule concludes that an integral is 1, or finite"),
        };
        let Formula::Ranged(r) = integral else {
            return reject("the rule is for the integral of a function");
        };
        let given = self.proof.proposition.parameters.iter().any(|parameter| {
            let s = Formula::Name(r.name.clone());
            let body = Formula::Apply(parameter.name.clone(), vec![s]);
            let (kind, from, to) = match &parameter.kind {
                ParameterKind::Function { kind, from, to, .. } => (kind, from, to),
                _ => return false,
            };
            *kind == wanted && **r == range(body, &r.name, from.clone(), to.clone())
        });
        require(
            given,
            "it is not the integral of such a function over its range",
        )
    }
}

/// `x^(p - 1)*(1 - x)^(q - 1)`
fn beta_weight(p: &Formula, q: &Formula, x: &Formula) -> Formula {
    let one = Formula::integer(1);
    let first = Formula::binary(Power, x.clone(), minus(p, &one));
    let second = Formula::binary(Power, minus(&one, x), minus(q, &one));
    Formula::binary(Multiply, first, second)
}

/// `m!/((l - 1)!*(m - l)!)*F^(l - 1)*(1 - F)^(m - l)*f`
fn order_density(l: &Formula, m: &Formula, below: Formula, f: Formula) -> Formula {
    let one = Formula::integer(1);
    let factorial = |n: Formula| Formula::Factorial(Box::new(n));
    let (before, after) = (minus(l, &one), minus(m, l));
    let ways = Formula::binary(
        Multiply,
        factorial(before.clone()),
        factorial(after.clone()),
    );
    let count = Formula::binary(Divide, factorial(m.clone()), ways);
    let under = Formula::binary(Power, below.clone(), before);
    let over = Formula::binary(Power, minus(&one, &below), after);
    let product = Formula::binary(Multiply, count, under);
    let product = Formula::binary(Multiply, product, over);
    Formula::binary(Multiply, product, f)
}

fn range(body: Formula, name: &Name, from: Formula, to: Formula) -> Ranged {
    Ranged {
        kind: RangeKind::Integral,
        body,
        name: name.clone(),
        from,
        to,
    }
}

fn integral(body: Formula, name: &Name, from: Formula, to: Formula) -> Formula {
    Formula::Ranged(Box::new(range(body, name, from, to)))
}

fn over_unit(body: Formula, name: &Name) -> Formula {
    integral(body, name, Formula::integer(0), Formula::integer(1))
}

/// The formula is a polynomial in the names, hence continuous.
fn is_polynomial(e: &Formula, names: &[&Name]) -> Checked {
    match e {
        Formula::Name(_) | Formula::Number(_) => Ok(()),
        Formula::Negate(a) => is_polynomial(a, names),
        Formula::Binary(Add | Subtract | Multiply, a, b) => {
            is_polynomial(a, names)?;
            is_polynomial(b, names)
        }
        _ => require(
            names.iter().all(|name| !depends(e, name)),
            "what moves is no polynomial",
        ),
    }
}
