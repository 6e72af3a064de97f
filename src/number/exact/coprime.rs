//! Rewriting over a coprime base: integers >= 2, pairwise coprime, none a perfect power, of which
//! all radicands and arguments of logarithms are products. It is found by gcd alone; nothing is
//! ever factored.
//!
//! The refinement ends because every step replaces two integers a, b with a common divisor g > 1 by
//! g, a/g, b/g, whose product is smaller by the factor g.

use super::monomial::{Monomial, Symbol};
use super::{Exact, MAX_TERMS};
use rug::{Integer, Rational};

/// Integers beyond this many bits are not searched for perfect powers; their logarithms stay whole.
const MAX_POWER_BITS: u32 = 1 << 12;

/// No power of a rewritten logarithm is expanded beyond this exponent.
const MAX_LN_EXPONENT: i32 = 64;

/// No base has more elements than this.
const MAX_BASE: usize = 256;

/// Whether an integer is small enough to be searched for perfect powers. One that is not may be a
/// perfect power, and its root rational.
pub(super) fn searched(value: &Integer) -> bool {
    value.significant_bits() <= MAX_POWER_BITS
}

/// n = b^e with the largest e, for n >= 1 (1 is 1^1). An integer too large to search is given back
/// as it is.
pub(super) fn perfect_power(value: &Integer) -> (Integer, u32) {
    let mut base = value.clone();
    let mut exponent = 1;
    if *value <= 1 || !searched(value) {
        return (base, exponent);
    }
    let mut degree = 2;
    while degree < base.significant_bits() && base.is_perfect_power() {
        let (root, rest) = base.clone().root_rem(Integer::new(), degree);
        if rest.cmp0().is_eq() {
            base = root;
            exponent *= degree;
        } else {
            degree += 1;
        }
    }
    (base, exponent)
}

/// A coprime base of the integers, each >= 2; `None` past the cap.
fn coprime_base(integers: impl IntoIterator<Item = Integer>) -> Option<Vec<Integer>> {
    let mut base: Vec<Integer> = Vec::new();
    let mut waiting: Vec<Integer> = integers.into_iter().collect();
    'next: while let Some(candidate) = waiting.pop() {
        if candidate == 1 {
            continue;
        }
        for index in 0..base.len() {
            let common = Integer::from(candidate.gcd_ref(&base[index]));
            if common != 1 {
                let known = base.swap_remove(index);
                waiting.push(known.div_exact(&common));
                waiting.push(candidate.div_exact(&common));
                waiting.push(common);
                continue 'next;
            }
        }
        if base.len() == MAX_BASE {
            return None;
        }
        base.push(candidate);
    }
    // Powers of coprime integers are coprime, and so are their bases.
    Some(base.iter().map(|b| perfect_power(b).0).collect())
}

/// The exponents of `value` over the base, for a value that is a product of its elements.
fn exponents<'a>(value: &Integer, base: &'a [Integer]) -> impl Iterator<Item = (&'a Integer, u32)> {
    base.iter().filter_map(move |element| {
        let (_, count) = Integer::from(value).remove_factor(element);
        (count > 0).then_some((element, count))
    })
}

impl Exact {
    /// The same number over a coprime base of all its radicands and logarithms; negative powers of
    /// logarithms are left as they are. `None` past the caps.
    pub(super) fn canonical(&self) -> Option<Exact> {
        let integers = self.terms.keys().flat_map(Monomial::powers);
        let integers = integers.filter_map(|(symbol, _)| match symbol {
            Symbol::Root(n) | Symbol::Ln(n) => Some(n.clone()),
            Symbol::SqrtPi => None,
        });
        let mut integers: Vec<Integer> = integers.collect();
        integers.sort();
        integers.dedup();
        let base = coprime_base(integers)?;
        let mut sum = Exact::zero();
        for (monomial, coefficient) in &self.terms {
            let part = rewrite(monomial, coefficient, &base)?;
            for (monomial, coefficient) in part.terms {
                sum.add_term(monomial, coefficient);
            }
            if sum.terms.len() > MAX_TERMS {
                return None;
            }
        }
        Some(sum)
    }
}

/// One term over the base.
fn rewrite(monomial: &Monomial, coefficient: &Rational, base: &[Integer]) -> Option<Exact> {
    let mut coefficient = coefficient.clone();
    let mut plain = Monomial::one();
    let mut logarithms = Exact::from_i64(1);
    for (symbol, exponent) in monomial.powers() {
        match symbol {
            Symbol::SqrtPi => plain.multiply(Symbol::SqrtPi, exponent),
            Symbol::Root(radicand) => {
                for (element, count) in exponents(radicand, base) {
                    let power = Rational::from(exponent * count);
                    plain.multiply_root(element, &power, &mut coefficient);
                }
            }
            Symbol::Ln(integer) => {
                let power = ln_power(integer, exponent.numer().to_i32()?, base)?;
                logarithms = logarithms.mul(&power).ok()?;
            }
        }
    }
    logarithms.mul(&Exact::term(plain, coefficient)).ok()
}

/// (ln n)^e over the base.
fn ln_power(integer: &Integer, exponent: i32, base: &[Integer]) -> Option<Exact> {
    let mut sum = Exact::zero();
    for (element, count) in exponents(integer, base) {
        let symbol = Monomial::power(Symbol::Ln(element.clone()), 1.into());
        sum.add_term(symbol, count.into());
    }
    if sum.terms.len() > 1 && exponent < 0 {
        let whole = Symbol::Ln(integer.clone());
        return Some(Exact::term(
            Monomial::power(whole, exponent.into()),
            1.into(),
        ));
    }
    if sum.terms.len() > 1 && exponent > MAX_LN_EXPONENT {
        return None;
    }
    match exponent < 0 {
        true => sum
            .inverse()
            .ok()?
            .power(exponent.unsigned_abs().into())
            .ok(),
        false => sum.power(exponent.unsigned_abs().into()).ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn perfect_powers() {
        for (value, base, exponent) in [
            (1, 1, 1),
            (2, 2, 1),
            (4, 2, 2),
            (64, 2, 6),
            (72, 72, 1),
            (46656, 6, 6),
        ] {
            let found = perfect_power(&Integer::from(value));
            assert_eq!(found, (Integer::from(base), exponent));
        }
    }

    #[test]
    fn bases_are_coprime_and_generate() {
        let integers = [12, 18, 50, 7, 49].map(Integer::from);
        let base = coprime_base(integers.clone()).unwrap_or_default();
        for (i, a) in base.iter().enumerate() {
            assert!(base[..i].iter().all(|b| Integer::from(a.gcd_ref(b)) == 1));
        }
        for value in integers {
            let product = exponents(&value, &base).fold(Integer::from(1), |p, (b, e)| {
                p * rug::ops::Pow::pow(b.clone(), e)
            });
            assert_eq!(product, value);
        }
    }
}
