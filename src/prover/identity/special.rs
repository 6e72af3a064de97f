//! Hypergeometric functions by Euler's integral.

use super::Builder;
use super::evaluate::{Context, Value, then};
use super::make::{int, integral};
use crate::formula::{Formula, Function, Operator};
use crate::kernel::proof::{Fact, Rule};

use Operator::{Divide, Multiply, Power, Subtract};

/// The value of a hypergeometric function.
pub(super) fn value(
    b: &mut Builder,
    cx: &mut Context,
    function: Function,
    parts: &[Formula],
) -> Option<Value> {
    let q = Formula::Call(function, parts.to_vec());
    let next = match function {
        Function::Hyp2F1 => euler(b, parts)?,
        Function::Hyp2F1Regularized => regularized(b, parts)?,
        _ => return None,
    };
    then(b, cx, &q, next)
}

fn minus(a: &Formula, b: &Formula) -> Formula {
    Formula::binary(Subtract, a.clone(), b.clone())
}

/// `hyp2f1` as an integral over a beta function.
fn euler(b: &mut Builder, parts: &[Formula]) -> Option<Value> {
    let [a, p, c, z] = parts else {
        return None;
    };
    let q = Formula::Call(Function::Hyp2F1, parts.to_vec());
    let rest = minus(c, p);
    b.finite(a)?;
    b.positive(p)?;
    b.positive(&rest)?;
    let distance = minus(&int(1), z);
    b.finite(z)?;
    b.positive(&distance)?;
    let name = b.fresh("u");
    let x = Formula::Name(name.clone());
    let kernel = minus(&int(1), &Formula::binary(Multiply, z.clone(), x.clone()));
    let kernel = Formula::binary(Power, kernel, Formula::Negate(Box::new(a.clone())));
    let body = Formula::binary(Multiply, beta_weight(p, &rest, &x), kernel);
    let beta = Formula::Call(Function::Beta, vec![p.clone(), rest]);
    let over = integral(body, &name, int(0), int(1));
    let next = Formula::binary(Divide, over, beta);
    let step = b.step(Fact::Same(q, next.clone()), Rule::Euler, &[], &[])?;
    Some((next, step))
}

fn regularized(b: &mut Builder, parts: &[Formula]) -> Option<Value> {
    let q = Formula::Call(Function::Hyp2F1Regularized, parts.to_vec());
    let plain = Formula::Call(Function::Hyp2F1, parts.to_vec());
    b.finite(&plain)?;
    let gamma = Formula::Call(Function::Gamma, vec![parts.get(2)?.clone()]);
    let next = Formula::binary(Divide, plain, gamma);
    let step = b.step(Fact::Same(q, next.clone()), Rule::Regularized, &[], &[])?;
    Some((next, step))
}

/// `x^(p - 1)*(1 - x)^(q - 1)`, as the kernel writes it.
pub(super) fn beta_weight(p: &Formula, q: &Formula, x: &Formula) -> Formula {
    let one = int(1);
    let first = Formula::binary(Power, x.clone(), minus(p, &one));
    let second = Formula::binary(Power, minus(&one, x), minus(q, &one));
    Formula::binary(Multiply, first, second)
}
