//! Gauss's function at rational arguments: where it is the thesis's `2F1(1, l; m+1; z)` with integers `1 <= l <= m`
//! and `z < 1`, by the methods for shells; elsewhere by the general one.

use super::hyp2f1;
use super::shell::{self, Quantity, ShellError};
use crate::model::Shell;
use crate::number::{DomainError, Interval};
use rug::Rational;

/// F(a, b; c; z), DLMF 15.2.1, with about `precision` bits.
///
/// ```
/// use claimcheck::special::hyp2f1_rational;
/// use rug::Rational;
/// // 2F1(1, 1; 2; -1) = ln 2
/// let [one, two] = [Rational::from(1), Rational::from(2)];
/// let value = hyp2f1_rational(&one, &one, &two, &Rational::from(-1), 3400)?;
/// assert!(value.agrees_to(1000));
/// assert_eq!(value.to_decimal(10), "0.6931471806");
/// # Ok::<(), claimcheck::number::DomainError>(())
/// ```
///
/// # Errors
/// As [`hyp2f1`].
pub fn hyp2f1_rational(
    a: &Rational,
    b: &Rational,
    c: &Rational,
    z: &Rational,
    precision: u32,
) -> Result<Interval, DomainError> {
    for (unit, l) in [(a, b), (b, a)] {
        if *unit == 1
            && let Some(shell) = shell(l, c, z)
            && let Ok(value) = by_shell(&shell, precision)
        {
            // F(1, l; c; z) = F(1, c-l; c; z/(z-1))/(1-z) (DLMF 15.8.1)
            let factor = Rational::from(1u32 - z).recip().max(Rational::from(1));
            return Ok(value.mul(&Interval::from_rational(&factor, precision)));
        }
    }
    // Integers stay exact, in reason.
    let bits = |q: &Rational| q.numer().significant_bits().saturating_add(8).min(1 << 12);
    let [a, b, c, z] = [a, b, c, z].map(|q| Interval::from_rational(q, precision.max(bits(q))));
    hyp2f1(&a, &b, &c, &z, precision)
}

/// The shell around 1 whose F is `F(1, l; c; z)` for z < 0, `F(1, c-l; c; z/(z-1))` for 0 < z < 1.
fn shell(l: &Rational, c: &Rational, z: &Rational) -> Option<Shell> {
    if !l.is_integer() || !c.is_integer() || *l < 1 || l >= c || *z == 0 || *z >= 1 {
        return None;
    }
    let (volume, position) = if *z < 0 {
        (Rational::from(-z), l.clone())
    } else {
        (z / Rational::from(1u32 - z), Rational::from(c - l))
    };
    Some(Shell {
        inner: Rational::from(1),
        volume,
        position: position.numer().clone(),
        count: c.numer().clone() - 1u32,
    })
}

fn by_shell(shell: &Shell, precision: u32) -> Result<Interval, ShellError> {
    // 10^-digits < 2^-precision: log10 2 < 30103/100000.
    let digits = u64::from(precision) * 30_103 / 100_000 + 1;
    let digits = u32::try_from(digits).map_err(|_| ShellError::Outside)?;
    let value = shell::enclose(Quantity::Function, shell, digits)?;
    Ok(value.with_precision(precision))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_agree_and_the_family_is_recognised() {
        let q = |a: i64, b: i64| Rational::from((a, b));
        for (l, c) in [(1, 2), (3, 5), (4, 5), (7, 40)] {
            for z in [q(-1, 2), q(-3, 1), q(-1, 1), q(1, 3), q(9, 10)] {
                let (one, l, c) = (q(1, 1), q(l, 1), q(c, 1));
                let shell = shell(&l, &c, &z).expect("in the family");
                assert!(by_shell(&shell, 200).is_ok());
                let [a, b, s, at] = [&one, &l, &c, &z].map(|q| Interval::from_rational(q, 300));
                let general = hyp2f1(&a, &b, &s, &at, 300).expect("z < 1");
                for value in [
                    hyp2f1_rational(&one, &l, &c, &z, 200),
                    hyp2f1_rational(&l, &one, &c, &z, 200),
                ] {
                    let value = value.expect("z < 1");
                    assert!(
                        value.overlaps(&general) && value.agrees_to(58),
                        "{l} {c} {z}"
                    );
                }
            }
        }
    }

    #[test]
    fn elsewhere_it_is_the_general_function() {
        let q = |a: i64, b: i64| Rational::from((a, b));
        let at = |a, b, c, z| hyp2f1_rational(&a, &b, &c, &z, 100);
        assert_eq!(
            at(q(1, 1), q(2, 1), q(3, 1), q(1, 1)),
            Err(DomainError::Certain)
        );
        assert_eq!(
            at(q(1, 1), q(2, 1), q(-3, 1), q(1, 2)),
            Err(DomainError::Certain)
        );
        // (1-z)^-b for c = 1, l = c too
        let power = at(q(1, 1), q(3, 1), q(3, 1), q(-1, 1)).expect("z < 1");
        assert!(power.contains_rational(&q(1, 2)));
        let zero = at(q(1, 1), q(2, 1), q(3, 1), q(0, 1)).expect("z < 1");
        assert!(zero.contains_rational(&q(1, 1)));
        assert!(
            at(q(1, 2), q(2, 1), q(3, 1), q(-1, 2))
                .expect("z < 1")
                .agrees_to(25)
        );
    }
}
