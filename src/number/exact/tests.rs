use super::*;
use proptest::prelude::*;
use std::cmp::Ordering;

fn q(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
}

fn ln(n: i64, d: i64) -> Exact {
    Exact::ln_of(&q(n, d)).expect("positive")
}

fn root(n: i64, index: u32) -> Exact {
    Exact::root(&q(n, 1), index).expect("positive")
}

fn times(a: &Exact, b: &Exact) -> Exact {
    a.mul(b).expect("small")
}

#[test]
fn logarithms_over_a_coprime_base() {
    assert_eq!(ln(6, 1).sub(&ln(2, 1)).sub(&ln(3, 1)).is_zero(), Some(true));
    assert_eq!(
        ln(8, 1).div(&ln(2, 1)).and_then(|x| x.as_rational()),
        Some(q(3, 1))
    );
    assert_eq!(ln(12, 7).add(&ln(7, 12)).is_zero(), Some(true));
    assert_eq!(ln(2, 1).sub(&ln(3, 1)).is_zero(), Some(false));
    let six = times(&ln(6, 1), &ln(6, 1));
    let parts = ln(2, 1).add(&ln(3, 1));
    assert_eq!(six.sub(&times(&parts, &parts)).is_zero(), Some(true));
}

#[test]
fn negative_powers_of_a_logarithm_do_not_hide_a_zero() {
    let inverse = ln(6, 1).powi(-1).expect("a single term");
    let one = times(&inverse, &ln(2, 1)).add(&times(&inverse, &ln(3, 1)));
    assert_eq!(one.sub(&Exact::from_i64(1)).is_zero(), Some(true));
}

#[test]
fn roots() {
    assert_eq!(
        root(2, 3).powi(3).map(|x| x.as_rational()),
        Ok(Some(q(2, 1)))
    );
    assert_eq!(root(4, 2).as_rational(), Some(q(2, 1)));
    assert_eq!(times(&root(8, 2), &root(2, 2)).as_rational(), Some(q(4, 1)));
    assert_eq!(
        times(&root(2, 2), &root(3, 2)).sub(&root(6, 2)).is_zero(),
        Some(true)
    );
    assert_eq!(
        root(2, 2).add(&root(3, 2)).sub(&root(10, 2)).is_zero(),
        Some(false)
    );
    assert_eq!(
        root(2, 2).add(&root(3, 2)).sub(&root(10, 2)).sign(),
        Some(Ordering::Less)
    );
    let half = Exact::root(&q(1, 2), 2).expect("positive");
    assert_eq!(times(&half, &root(2, 2)).as_rational(), Some(q(1, 1)));
    assert!(Exact::root(&q(-1, 1), 2).is_none());
    assert_eq!(Exact::root(&q(0, 1), 2), Some(Exact::zero()));
}

#[test]
fn theorems_decide_without_digits() {
    // Theorem 3 with pi and an algebraic coefficient.
    let mixed = times(&root(2, 2), &ln(3, 1)).add(&Exact::pi());
    assert_eq!(mixed.sub(&ln(5, 1)).is_zero(), Some(false));
    let pi2 = times(&Exact::pi(), &Exact::pi());
    assert_eq!(pi2.sub(&Exact::from_i64(10)).sign(), Some(Ordering::Less));
    let sqrt_pi2 = times(&Exact::sqrt_pi(), &Exact::sqrt_pi());
    assert_eq!(sqrt_pi2.sub(&Exact::pi()).is_zero(), Some(true));
}

#[test]
fn a_tiny_difference_is_seen() {
    // ln(1 + 10^-200) - 10^-200 is about -10^-400/2.
    let tiny = Rational::from((Integer::from(1), Integer::from(10).pow(200)));
    let value = Exact::ln_of(&(tiny.clone() + 1)).expect("positive");
    let difference = value.sub(&Exact::from_rational(&tiny));
    assert_eq!(difference.is_zero(), Some(false));
    assert_eq!(difference.sign(), Some(Ordering::Less));
}

#[test]
fn sizes_are_capped() {
    assert_eq!(Exact::from_i64(2).powi(1 << 40), Err(ExactError::TooLarge));
    assert_eq!(Exact::from_i64(-1).powi(i64::MIN), Ok(Exact::from_i64(1)));
    assert_eq!(Exact::zero().powi(-1), Err(ExactError::Undefined));
    assert_eq!(Exact::zero().powi(0), Ok(Exact::from_i64(1)));
    let many = (2..200).fold(Exact::zero(), |sum, n| sum.add(&ln(n, 1)));
    assert_eq!(many.powi(3), Err(ExactError::TooLarge));
    assert_eq!(many.powi(-3), Err(ExactError::NoForm));
}

#[test]
fn prints_as_a_formula() {
    let value = Exact::from_rational(&q(3, 2))
        .sub(&times(&Exact::from_i64(2), &ln(2, 1)))
        .add(&times(&Exact::from_i64(5), &ln(3, 1)));
    assert_eq!(value.to_string(), "3/2 - 2*ln(2) + 5*ln(3)");
    assert_eq!(
        Exact::pi().powi(-1).map(|x| x.to_string()),
        Ok("pi^(-1)".to_owned())
    );
    assert_eq!(Exact::sqrt_pi().neg().to_string(), "-sqrt(pi)");
    assert_eq!(root(2, 3).to_string(), "2^(1/3)");
}

/// A small exact value of every kind of symbol.
fn exact() -> impl Strategy<Value = Exact> {
    let symbol = prop_oneof![
        Just(Exact::from_i64(1)),
        (2i64..40, 1i64..40).prop_map(|(n, d)| ln(n, d)),
        Just(Exact::pi()),
        Just(Exact::sqrt_pi()),
        (1i64..40, 2u32..4).prop_map(|(n, index)| root(n, index)),
    ];
    let term = (symbol.clone(), symbol, -9i64..9, 1i64..9)
        .prop_map(|(a, b, n, d)| times(&times(&a, &b), &Exact::from_rational(&q(n, d))));
    prop::collection::vec(term, 1..4)
        .prop_map(|terms| terms.iter().fold(Exact::zero(), |sum, term| sum.add(term)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn ring_laws(a in exact(), b in exact(), c in exact()) {
        prop_assert_eq!(a.add(&b), b.add(&a));
        prop_assert_eq!(times(&a, &b), times(&b, &a));
        prop_assert_eq!(times(&a, &b.add(&c)), times(&a, &b).add(&times(&a, &c)));
        prop_assert_eq!(times(&times(&a, &b), &c), times(&a, &times(&b, &c)));
        prop_assert_eq!(a.sub(&a).is_zero(), Some(true));
    }

    #[test]
    fn enclosures_agree(a in exact(), b in exact()) {
        let product = times(&a, &b);
        prop_assert!(product.enclose(200).overlaps(&a.enclose(200).mul(&b.enclose(200))));
        prop_assert!(a.add(&b).enclose(200).overlaps(&a.enclose(200).add(&b.enclose(200))));
        if let Some(canonical) = product.canonical() {
            prop_assert!(product.enclose(200).overlaps(&canonical.enclose(200)));
        }
        if product.is_zero() == Some(true) {
            prop_assert!(product.enclose(200).contains_zero());
        }
        if let Some(quotient) = a.div(&b) {
            prop_assert!(times(&quotient, &b).sub(&a).is_zero() != Some(false));
        }
    }
}
