//! The rules of Gamma and its kin, of powers and logarithms, and of other functions.

use super::super::known::{above, minus};
use super::super::{Fact, Rejected, reject, require};
use super::{Check, Checked};
use crate::formula::{Formula, Function, Operator};

use Operator::{Add, Divide, Multiply, Power};

impl<'a> Check<'a, '_> {
    pub(super) fn gamma(&self) -> Checked {
        let (left, right) = self.equation()?;
        let s = argument_of(left, Function::Gamma)?;
        let Formula::Binary(Multiply, t, _) = right else {
            return reject("the rule gives t*gamma(t)");
        };
        // At a pole of the one the other has one too.
        self.is_nonzero(t)?;
        self.is_finite(s)?;
        self.is_same(s, &Formula::binary(Add, (**t).clone(), Formula::integer(1)))?;
        let gamma = Formula::Call(Function::Gamma, vec![(**t).clone()]);
        self.concludes(&Formula::binary(Multiply, (**t).clone(), gamma))
    }

    pub(super) fn factorial(&self) -> Checked {
        let Formula::Factorial(n) = self.equation()?.0 else {
            return reject("the rule is for factorials");
        };
        self.is_integer(n)?;
        self.is_nonnegative(n)?;
        let next = Formula::binary(Add, (**n).clone(), Formula::integer(1));
        self.concludes(&Formula::Call(Function::Gamma, vec![next]))
    }

    pub(super) fn beta(&self) -> Checked {
        let Formula::Call(Function::Beta, parts) = self.equation()?.0 else {
            return reject("the rule is for the beta function");
        };
        let [a, b] = parts.as_slice() else {
            return reject("a beta function of two arguments");
        };
        self.is_positive(a)?;
        self.is_positive(b)?;
        let gamma = |x: Formula| Formula::Call(Function::Gamma, vec![x]);
        let above = Formula::binary(Multiply, gamma(a.clone()), gamma(b.clone()));
        let below = gamma(Formula::binary(Add, a.clone(), b.clone()));
        self.concludes(&Formula::binary(Divide, above, below))
    }

    pub(super) fn binomial(&self) -> Checked {
        let Formula::Call(Function::Binomial, parts) = self.equation()?.0 else {
            return reject("the rule is for binomials");
        };
        let [n, k] = parts.as_slice() else {
            return reject("a binomial of two arguments");
        };
        let rest = minus(n, k);
        for length in [n, k, &rest] {
            self.is_integer(length)?;
            self.is_nonnegative(length)?;
        }
        let factorial = |x: &Formula| Formula::Factorial(Box::new(x.clone()));
        let below = Formula::binary(Multiply, factorial(k), factorial(&rest));
        self.concludes(&Formula::binary(Divide, factorial(n), below))
    }

    pub(super) fn pochhammer(&self) -> Checked {
        let Formula::Call(Function::Pochhammer, parts) = self.equation()?.0 else {
            return reject("the rule is for Pochhammer's symbol");
        };
        let [a, n] = parts.as_slice() else {
            return reject("a Pochhammer symbol of two arguments");
        };
        self.is_positive(a)?;
        self.is_integer(n)?;
        self.is_nonnegative(n)?;
        let gamma = |x: Formula| Formula::Call(Function::Gamma, vec![x]);
        let above = gamma(Formula::binary(Add, a.clone(), n.clone()));
        self.concludes(&Formula::binary(Divide, above, gamma(a.clone())))
    }

    pub(super) fn logarithm(&self) -> Checked {
        let of = argument_of(self.equation()?.0, Function::Ln)?;
        let ln = |x: &Formula| Formula::Call(Function::Ln, vec![x.clone()]);
        let expanded = match of {
            Formula::Binary(Multiply, a, b) => {
                self.is_positive(a)?;
                self.is_positive(b)?;
                Formula::binary(Add, ln(a), ln(b))
            }
            Formula::Binary(Divide, a, b) => {
                self.is_positive(a)?;
                self.is_positive(b)?;
                minus(&ln(a), &ln(b))
            }
            Formula::Binary(Power, a, p) => {
                self.is_positive(a)?;
                self.is_finite(p)?;
                Formula::binary(Multiply, (**p).clone(), ln(a))
            }
            Formula::Call(Function::Sqrt, parts) => {
                self.is_positive(&parts[0])?;
                Formula::binary(Divide, ln(&parts[0]), Formula::integer(2))
            }
            Formula::Call(Function::Exp, parts) => {
                self.is_finite(&parts[0])?;
                parts[0].clone()
            }
            _ => return reject("a logarithm of a product, a quotient, a power, a root or exp"),
        };
        self.concludes(&expanded)
    }

    pub(super) fn power(&self) -> Checked {
        let (left, right) = self.equation()?;
        if let Formula::Call(Function::Sqrt, parts) = left {
            self.is_nonnegative(&parts[0])?;
            let half = Formula::binary(Divide, Formula::integer(1), Formula::integer(2));
            return self.concludes(&Formula::binary(Power, parts[0].clone(), half));
        }
        let Formula::Binary(Power, base, p) = left else {
            return reject("the rule is for powers and square roots");
        };
        self.is_finite(p)?;
        if let Formula::Number(_) = right {
            return self.trivial_power(base, p);
        }
        if let Formula::Binary(Multiply | Divide, x, y) = right
            && let (Formula::Binary(Power, a, q), Formula::Binary(Power, b, r)) = (&**x, &**y)
        {
            if let Formula::Binary(operator, c, d) = &**base
                && matches!(operator, Multiply | Divide)
                && (c, d, p, p) == (a, b, q, r)
            {
                self.splits(&[c, d], &[p])?;
                if *operator == Divide {
                    self.is_nonzero(d)?;
                }
                return self.concludes(&Formula::binary(*operator, (**x).clone(), (**y).clone()));
            }
            require(
                matches!(right, Formula::Binary(Multiply, ..)),
                "a product of powers",
            )?;
            require(
                a == base && b == base,
                "a product of powers of the same base",
            )?;
            self.splits(&[base], &[q, r])?;
            return self.is_same(p, &Formula::binary(Add, (**q).clone(), (**r).clone()));
        }
        match (&**base, right) {
            (Formula::Binary(Power, a, q), Formula::Binary(Power, b, r)) if a == b => {
                self.splits(&[a], &[p, q])?;
                self.is_finite(r)?;
                self.is_same(r, &Formula::binary(Multiply, (**p).clone(), (**q).clone()))
            }
            _ => reject("no law of powers gives this"),
        }
    }

    /// Where powers of these bases with these exponents can be split: all bases are positive; or
    /// nonnegative, with positive exponents; or all exponents are integers, and nonnegative or on
    /// nonzero bases.
    fn splits(&self, bases: &[&Formula], exponents: &[&Formula]) -> Checked {
        let all = |formulas: &[&Formula], check: fn(&Self, &Formula) -> Checked| {
            formulas.iter().try_for_each(|formula| check(self, formula))
        };
        all(bases, Self::is_finite)?;
        all(exponents, Self::is_finite)?;
        let nonnegative = all(bases, Self::is_nonnegative).is_ok();
        if all(bases, Self::is_positive).is_ok()
            || (nonnegative && all(exponents, Self::is_positive).is_ok())
        {
            return Ok(());
        }
        all(exponents, Self::is_integer)?;
        match all(exponents, Self::is_nonnegative) {
            Ok(()) => Ok(()),
            Err(_) => all(bases, Self::is_nonzero),
        }
    }

    /// A power of 0 or of 1.
    fn trivial_power(&self, base: &Formula, p: &Formula) -> Checked {
        if self.proof.zero(base)? {
            self.is_positive(p)?;
            return self.concludes(&Formula::integer(0));
        }
        require(self.is_one(base)?, "a power of what is neither 0 nor 1")?;
        self.concludes(&Formula::integer(1))
    }

    pub(super) fn circle(&self) -> Checked {
        let two = Formula::integer(2);
        let Formula::Binary(Power, cos, order) = self.equation()?.0 else {
            return reject("the rule is for a square");
        };
        require(**order == two, "the rule is for a square")?;
        let x = argument_of(cos, Function::Cos)?;
        self.is_finite(x)?;
        let sin = Formula::Call(Function::Sin, vec![x.clone()]);
        self.concludes(&minus(
            &Formula::integer(1),
            &Formula::binary(Power, sin, two),
        ))
    }

    pub(super) fn constant(&self) -> Checked {
        let known = ["gamma(1/2) == sqrt(pi)", "cos(pi) == -1"];
        let mut known = known.into_iter().map(Fact::parse);
        let own = Ok(self.fact.clone());
        require(known.any(|fact| fact == own), "no such constant")
    }

    pub(super) fn extreme(&self) -> Checked {
        let (left, right) = self.equation()?;
        let Formula::Call(function @ (Function::Min | Function::Max), parts) = left else {
            return reject("the rule is for min and max");
        };
        require(parts.contains(right), "it is none of the arguments")?;
        parts.iter().try_for_each(|part| {
            self.is_finite(part)?;
            match function {
                Function::Min => self.is_nonnegative(&above(right, part)),
                _ => self.is_nonnegative(&above(part, right)),
            }
        })
    }

    pub(super) fn power_order(&self) -> Checked {
        let (low, high) = match self.fact {
            Fact::Less(low, high) | Fact::AtMost(low, high) => (low, high),
            _ => return reject("the rule concludes an order"),
        };
        let (Formula::Binary(Power, a, p), Formula::Binary(Power, b, q)) = (low, high) else {
            return reject("the rule is for two powers");
        };
        require(p == q, "the exponents are the same")?;
        self.is_positive(p)?;
        self.is_nonnegative(a)?;
        let width = above(a, b);
        match self.fact {
            Fact::Less(..) => self.is_positive(&width),
            _ => self.is_nonnegative(&width),
        }
    }
}

/// The argument of a function of one.
fn argument_of(formula: &Formula, function: Function) -> Result<&Formula, Rejected> {
    match formula {
        Formula::Call(f, parts) if *f == function && parts.len() == 1 => Ok(&parts[0]),
        _ => Err(Rejected(format!("the rule is for {}", function.name()))),
    }
}
