//! Formulas made with the trivial parts left out, and parts of formulas exchanged.

use crate::formula::{Formula, Function, Name, Operator, RangeKind, Ranged, free_names};
use num_traits::{One, Zero};

pub(super) fn int(value: i64) -> Formula {
    Formula::integer(value)
}

pub(super) fn var(name: &Name) -> Formula {
    Formula::Name(name.clone())
}

pub(super) fn is_zero(e: &Formula) -> bool {
    matches!(e, Formula::Number(value) if value.is_zero())
}

pub(super) fn is_one(e: &Formula) -> bool {
    matches!(e, Formula::Number(value) if value.is_one())
}

/// `a + b`
pub(super) fn add(a: Formula, b: Formula) -> Formula {
    match (is_zero(&a), is_zero(&b)) {
        (true, _) => b,
        (_, true) => a,
        _ => Formula::binary(Operator::Add, a, b),
    }
}

/// `a - b`
pub(super) fn sub(a: Formula, b: Formula) -> Formula {
    match is_zero(&b) {
        true => a,
        false => Formula::binary(Operator::Subtract, a, b),
    }
}

/// `a*b`
pub(super) fn mul(a: Formula, b: Formula) -> Formula {
    match (is_one(&a), is_one(&b)) {
        (true, _) => b,
        (_, true) => a,
        _ => Formula::binary(Operator::Multiply, a, b),
    }
}

/// `a/b`
pub(super) fn div(a: Formula, b: Formula) -> Formula {
    match is_one(&b) {
        true => a,
        false => Formula::binary(Operator::Divide, a, b),
    }
}

/// `a^b`
pub(super) fn pow(a: Formula, b: Formula) -> Formula {
    match is_one(&b) {
        true => a,
        false => Formula::binary(Operator::Power, a, b),
    }
}

pub(super) fn ln(a: Formula) -> Formula {
    Formula::Call(Function::Ln, vec![a])
}

/// `int(body, name = from..to)`
pub(super) fn integral(body: Formula, name: &Name, from: Formula, to: Formula) -> Formula {
    let (kind, name) = (RangeKind::Integral, name.clone());
    Formula::Ranged(Box::new(Ranged {
        kind,
        body,
        name,
        from,
        to,
    }))
}

pub(super) fn depends(e: &Formula, x: &Name) -> bool {
    free_names(e).contains(x)
}

/// The formula with one formula in another's place, outside of binders; what is under a binder is
/// a part of its own.
pub(super) fn replaced(e: &Formula, old: &Formula, new: &Formula) -> Formula {
    if e == old {
        return new.clone();
    }
    map_parts(e, &mut |part| replaced(part, old, new))
}

/// The formula with its direct parts mapped, where it is arithmetic or a function; else itself.
pub(super) fn map_parts(e: &Formula, map: &mut dyn FnMut(&Formula) -> Formula) -> Formula {
    match e {
        Formula::Negate(a) => Formula::Negate(Box::new(map(a))),
        Formula::Factorial(a) => Formula::Factorial(Box::new(map(a))),
        Formula::Binary(operator, a, b) => Formula::binary(*operator, map(a), map(b)),
        Formula::Call(function, parts) => {
            Formula::Call(*function, parts.iter().map(&mut *map).collect())
        }
        Formula::Apply(name, parts) => {
            Formula::Apply(name.clone(), parts.iter().map(&mut *map).collect())
        }
        _ => e.clone(),
    }
}

/// The direct parts that [`map_parts`] maps.
pub(super) fn parts(e: &Formula) -> Vec<&Formula> {
    match e {
        Formula::Negate(a) | Formula::Factorial(a) => vec![a],
        Formula::Binary(_, a, b) => vec![a, b],
        Formula::Call(_, parts) | Formula::Apply(_, parts) => parts.iter().collect(),
        _ => Vec::new(),
    }
}
