//! The two rational types of the program, one from the other: `num-rational`'s in the formula tree
//! and the kernel, GMP's in everything that computes fast.

use crate::formula;
use num_bigint::{BigInt, Sign};
use rug::integer::Order;
use rug::{Integer, Rational};

/// The integer, as GMP's.
pub fn integer_to_rug(value: &BigInt) -> Integer {
    let (sign, bytes) = value.to_bytes_le();
    let magnitude = Integer::from_digits(&bytes, Order::Lsf);
    if sign == Sign::Minus {
        -magnitude
    } else {
        magnitude
    }
}

/// The integer, as num-bigint's.
pub fn integer_from_rug(value: &Integer) -> BigInt {
    let bytes = value.to_digits::<u8>(Order::Lsf);
    let sign = match value.cmp0() {
        std::cmp::Ordering::Less => Sign::Minus,
        std::cmp::Ordering::Equal => Sign::NoSign,
        std::cmp::Ordering::Greater => Sign::Plus,
    };
    BigInt::from_bytes_le(sign, &bytes)
}

/// The rational number, as GMP's.
pub fn to_rug(value: &formula::Rational) -> Rational {
    Rational::from((integer_to_rug(value.numer()), integer_to_rug(value.denom())))
}

/// The rational number, as num-rational's.
pub fn from_rug(value: &Rational) -> formula::Rational {
    // GMP keeps rationals in lowest terms with a positive denominator, which is num-rational's form.
    formula::Rational::new_raw(
        integer_from_rug(value.numer()),
        integer_from_rug(value.denom()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn there_and_back(n in any::<i128>(), d in 1..i64::MAX) {
            let value = formula::Rational::new(n.into(), d.into());
            let other = to_rug(&value);
            prop_assert_eq!(other.to_string(), value.to_string());
            prop_assert_eq!(from_rug(&other), value);
        }
    }

    #[test]
    fn zero() {
        let value = formula::Rational::from_integer(0.into());
        assert_eq!(from_rug(&to_rug(&value)), value);
    }
}
