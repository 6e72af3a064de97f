//! Values of closed formulas.

use super::super::fraction::Fraction;
use super::super::scope::{Scope, full_tank};
use super::super::value::evaluate;
use super::*;
use proptest::prelude::*;
use std::cmp::Ordering;

#[test]
fn no_value_is_claimed_where_it_is_proved() {
    for text in [
        "1/0",
        "0/0",
        "ln(0)",
        "ln(-1)",
        "sqrt(-2)",
        "(-8)^(1/3)",
        "0^-1",
        "sqrt(-2)^2",
        "((-8)^(1/3))^3",
        "gamma(0)",
        "(-1)!",
        "inf - inf",
        "0*inf",
        "1/inf",
        "hyp2f1(1, 1; 2; 1)",
        "0*(1/0)",
        "int(1/x, x = -1..1)",
        "at(x/x, x = 0)",
        "sum(1/j, j = 0..3)",
        "exp(pi + 1/0)",
        "int(1/((x - x)^-2), x = 0..1)",
        "diff(ln(x), x) + at(diff(ln(x), x), x = -1)",
    ] {
        let found = at(text, &[("x", 1, 1)], &[], 64);
        assert_eq!(found, Ok(Value::Undefined), "{text}");
    }
    for text in [
        "1/(ln(2) - ln(2))",
        "ln(pi - pi)",
        "sum(j, j = 3..1)",
        "x",
        "2^2^100",
        "2^(1/1025)",
        "10^9!",
    ] {
        assert!(closed(text).is_err(), "{text}");
    }
}

#[test]
fn exact_values() {
    for (text, a, b) in [
        ("0^0", 1, 1),
        ("2^-3", 1, 8),
        ("(9/4)^(3/2)", 27, 8),
        ("(2^(1/3))^3 + sqrt(2)^4 + (16^(1/3))^(3/2)", 10, 1),
        ("sum(j^2, j = 1..4)", 30, 1),
        ("sum(j, j = 1..0)", 0, 1),
        ("beta(3, 2)", 1, 12),
        ("binomial(5, 2) + binomial(5, -1)", 10, 1),
        ("binomial(1/2, 2)", -1, 8),
        ("pochhammer(1/2, 3)", 15, 8),
        ("abs(-3) + min(1, 2, -4) + max(1, 7)", 6, 1),
        ("gamma(5)/4!", 1, 1),
        ("[1 < 2 <= 2] + if(1 == 2, 5, 7) + [1/0 == 1/0]", 8, 1),
        ("int(x^2, x = 0..1)", 1, 3),
        ("int(x^2, x = 1..0)", -1, 3),
        ("int((x^2)^3 + (x^2 + 1)^0, x = 0..1)", 8, 7),
        ("int([-1 < x < 5]*x, x = 0..2)", 2, 1),
        ("int(abs(x), x = -1..2)", 5, 2),
        ("int([1/4 < x < 1/2]*x, x = 0..1)", 3, 32),
        ("int(x/x, x = 0..1)", 1, 1),
        ("int(int(s, s = 0..r)*r, r = 0..1)", 1, 8),
        ("at(diff(x^3, x, 2), x = 5)", 30, 1),
        ("at(diff(x/(1 + x), x), x = 1)", 1, 4),
        ("at(diff(int(t^2, t = 0..x), x), x = 3)", 9, 1),
        ("lim((x + 1)/(x + 2), x -> 0)", 1, 2),
        ("mean(x, x ~ uniform(1, 4))", 5, 2),
        ("var(x, x ~ uniform(0, 6))", 3, 1),
        ("prob(x < 1/3, x ~ beta(1, 2))", 5, 9),
        ("mean(x, x ~ order(2, 3) of uniform(0, 4))", 2, 1),
        ("hyp2f1(-1, 2; 4; 3)", -1, 2),
        ("int(diff(abs(x), x), x = -1..2)", 1, 1),
        ("int(int(s, s = 0..abs(r)), r = -1..1)", 1, 3),
        ("int(1/((x - x)^0) + 1/x^-2, x = 0..1)", 4, 3),
    ] {
        assert_eq!(closed(text), exact(a, b), "{text}");
    }
    assert!(closed("lim(x/x, x -> 0)").is_err());
    assert!(closed("lim(floor(x), x -> 0)").is_err());
}

#[test]
fn infinite_values() {
    for text in [
        "int(1/x, x = 0..1)",
        "inf + 1",
        "-(-inf)",
        "mean(1/x, x ~ beta(1, 3))",
        "int(1/x^2, x = -1..1)",
        "int(1/abs(x), x = -1..1)",
        "int([x < 1]/x, x = 0..2)",
        "int(1/(3*x - 1)^2, x = -1..1)",
    ] {
        assert_eq!(closed(text), Ok(Value::PlusInfinity), "{text}");
    }
    // Where it is zero a function has no other sign than elsewhere.
    let cut = closed("int([x < 1]/(x - 1), x = 0..2)");
    assert_eq!(cut, Ok(Value::MinusInfinity));
}

/// What the rules of calculus say where they do not hold is no value.
#[test]
fn derivatives_claim_nothing_beyond_their_rules() {
    for text in [
        // The integral is infinite around x = 1: its ends alone would give 1.
        "at(diff(int(1/t, t = 0..x), x), x = 1)",
        // y*abs(y) has the derivative 0 at 0, which the rule does not see.
        "at(int(diff(y*abs(y)*x, y), x = 0..1), y = 0)",
    ] {
        assert!(closed(text).is_err(), "{text}");
    }
}

/// The deepest trees that the parser makes fit the stack of a thread.
#[test]
fn deep_formulas_do_not_overflow() {
    let sum = vec!["x"; 900].join(" + ");
    assert_eq!(at(&sum, &[("x", 1, 1)], &[], 64), exact(900, 1));
    assert_eq!(closed(&format!("int({sum}, x = 0..1)")), exact(450, 1));
    let mean = format!("mean({sum}, x ~ uniform(0, 1))");
    assert_eq!(closed(&mean), exact(450, 1));
    let found = at(&format!("diff({sum}, x)"), &[("x", 1, 1)], &[], 64);
    assert!(found.is_err() || found == exact(900, 1));
    let nested = format!("{}x{}", "int(".repeat(90), ", x = 0..1)".repeat(90));
    let _ = closed(&nested);
}

/// Coefficients of a hundred digits cancel.
#[test]
fn large_linear_forms_keep_their_digits() {
    let found = enclosure(&at("hyp2f1(1, 40; 81; -2/79)", &[], &[], 64).unwrap());
    let width = (found.high() - found.low()) / found.low();
    assert!(width < Rational::new(1.into(), BigInt::one() << 50_u32));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]
    #[test]
    fn more_bits_refine(l in 1_i64..6, more in 0_i64..5, a in 9_i64..30, bits in 40_u32..80) {
        let numbers = [("l", l, 1), ("m", l + more, 1), ("Va", a, 7)];
        for text in ["hyp2f1(1, l; m + 1; -3/Va)", "hyp2f1(1/2, l; m + 3/2; -1/(1 + Va))",
            "exp(Va/7)*sqrt(Va + pi)", "int(Va/(x + l)^2 + 1/(x + m), x = 0..sqrt(2))"]
        {
            let few = enclosure(&at(text, &numbers, &[], bits).unwrap());
            let many = enclosure(&at(text, &numbers, &[], 2 * bits).unwrap());
            prop_assert!(few.compare(&many).map_or(true, Ordering::is_eq), "{}", text);
            prop_assert!(few.as_exact().is_some() || many.high() - many.low() < few.high() - few.low());
        }
    }
}

#[test]
fn bits_and_sizes_have_a_cap() {
    assert_eq!(at("1", &[], &[], 1024), exact(1, 1));
    assert!(at("1", &[], &[], 1025).is_err());
    // A number of so many bits, and its denominator of one.
    let given = |bits: u32| {
        let number = Rational::from_integer(BigInt::one() << (bits - 1));
        let mut point = Point::default();
        point.numbers.insert("x".into(), number);
        value(&parse_formula("x").expect("a name"), &point, &[], 64)
    };
    assert!(given((1 << 20) - 1).is_ok());
    assert!(given(1 << 20).is_err());
}

/// Steps by hand: one for each node, and more for large numbers, long polynomials and series.
#[test]
fn work_is_paid_for() {
    let work = |text: &str, bits| {
        let (point, fuel) = (Point::default(), full_tank());
        let before = fuel.get();
        let scope = Scope::new(&point, &[], bits, &fuel);
        evaluate(&parse_formula(text).expect(text), &scope).expect(text);
        before - fuel.get()
    };
    // 2^200 has 201 bits above and 1 below: 3 words.
    for (text, bits, steps) in [("1 + 1", 64, 4), ("2^200", 64, 3 + 3)] {
        assert_eq!(work(text, bits), steps, "{text}");
    }
    let (point, fuel) = (Point::default(), full_tank());
    let power = |n| Fraction::variable().power(n).unwrap();
    let before = fuel.get();
    let scope = Scope::new(&point, &[], 64, &fuel);
    assert_eq!(scope.spend_on(&power(2), &power(3)), Ok(()));
    assert_eq!(before - fuel.get(), 3 * 4);
}

/// Conditions in the place of numbers: 1 where they hold, 0 where they do not.
#[test]
fn conditions() {
    for (text, a) in [
        ("1 < 2 <= 2 < 3", 1),
        ("1 < 2 < 2", 0),
        ("2 >= 2 > 1 != 0", 1),
        ("2 == 2 and 1 > 2", 0),
        ("2 == 3 or 1 < 2", 1),
        ("2 == 3 or 1 > 2", 0),
        ("not (1 < 2)", 0),
        ("1/0 == 1/0 or 1/0 != 1/0", 0),
        ("not (1/0 == 1)", 1),
        ("inf == inf", 1),
        ("-inf < 0 < inf", 1),
        ("inf <= -inf", 0),
        ("sqrt(2) < pi", 1),
        ("exp(1) >= pi", 0),
        // A part that is false decides, whatever is not known.
        ("pi - pi == 0 and 1 > 2", 0),
        ("pi - pi == 0 or 1 < 2", 1),
    ] {
        assert_eq!(closed(&format!("[{text}]")), exact(a, 1), "{text}");
    }
    for text in [
        "pi - pi == 0",
        "pi - pi < 0",
        "not (pi - pi >= 0)",
        "pi - pi == 0 and 1 < 2",
    ] {
        assert!(closed(&format!("[{text}]")).is_err(), "{text}");
    }
}

#[test]
fn infinities_follow_the_rules() {
    for (text, sign) in [
        ("inf + inf", 1),
        ("3 - inf", -1),
        ("-inf - inf", -1),
        ("inf*(-2)", -1),
        ("(-inf)*(-inf)", 1),
        ("(-1/2)*(-inf)", 1),
        ("inf/2", 1),
        ("inf/(-2)", -1),
        ("int(1/x, x = -1..0)", -1),
        ("int(1/x, x = 1..0)", -1),
    ] {
        let known = if sign > 0 {
            Value::PlusInfinity
        } else {
            Value::MinusInfinity
        };
        assert_eq!(closed(text), Ok(known), "{text}");
    }
    for text in ["-inf + inf", "inf/inf", "inf/0", "0/inf", "(-inf)*0"] {
        assert_eq!(closed(text), Ok(Value::Undefined), "{text}");
    }
    for text in [
        "inf^2",
        "2^inf",
        "inf!",
        "exp(inf)",
        "inf*(pi - pi)",
        "sum(1, j = 1..inf)",
    ] {
        assert!(closed(text).is_err(), "{text}");
    }
}

/// Rational integrals from tables, and those that comparisons cut.
#[test]
fn integrals() {
    for (text, a, b) in [
        ("int(1/x^3, x = 1..2)", 3, 8),
        ("int(1/(x + 1)^2, x = 0..3)", 3, 4),
        ("int((2*x + 1)/(x^2 + x)^2, x = 1..2)", 1, 3),
        ("int(x^3/(x - 5)^0, x = 0..2)", 4, 1),
        ("int((x^2 - 1)/(x - 1), x = 0..2)", 4, 1),
        ("int(abs(x^2 - 1), x = 0..2)", 2, 1),
        ("int(abs(x - 1)*[x > 1/2], x = 0..3)", 17, 8),
        ("int(if(x < 1, x, if(x < 2, 1, 0)), x = 0..3)", 3, 2),
        ("int([x < 1 or x > 2], x = 0..3)", 2, 1),
        ("int([not (1 <= x <= 2)]*x, x = 0..3)", 3, 1),
        ("int([1/0 < x], x = 0..3)", 0, 1),
        ("int(sum(x^j, j = 0..2), x = 0..1)", 11, 6),
        ("int(at(y^2, y = 2*x), x = 0..3)", 36, 1),
        ("int(int(s^2, s = r..2*r), r = 0..1)", 7, 12),
        ("int(sqrt(2)^2*x, x = 0..1)", 1, 1),
        ("int(2*x, x = 0..3^(1/2))^2", 9, 1),
    ] {
        let difference = format!("{text} - {a}/{b}");
        let found = closed(&difference).unwrap_or_else(|why| panic!("{text}: {why}"));
        let found = enclosure(&found);
        assert!(
            found.low() <= &Rational::default() && &Rational::default() <= found.high(),
            "{text}"
        );
        assert!(found.high() - found.low() < tiny(50), "{text}");
    }
    for (a, b) in [
        ("int(1/(x^2 - 1), x = 2..3)", "ln(3/2)/2"),
        ("int(x/(x + 2), x = 0..1)", "1 - 2*ln(3/2)"),
        ("int(1/(x*(x + 1)), x = 1..2)", "ln(4/3)"),
        ("int(1/(3 - 2*x), x = 0..1)", "ln(3)/2"),
        ("int((x + 3)/(x + 1)^2, x = 0..1)", "ln(2) + 1"),
        ("int([x < sqrt(2)]*x^2, x = 0..2)", "2^(3/2)/3"),
    ] {
        assert_agree(a, b, &[], &[]);
    }
    // Two variables, a comparison inside of another, a divisor without rational roots, and cuts
    // whose enclosures meet: their order is not known at any bits.
    for text in [
        "int(int(x*y, y = 0..1), x = 0..1)",
        "int([abs(x) < 1/2], x = -1..1)",
        "int(1/(x^2 + 1), x = 0..1)",
        "int(at(abs(y), y = x), x = -1..1)",
        "int([x < sqrt(2)]*[x < sqrt(2) + 1/10^40], x = 0..2)",
        "int(sqrt(x), x = 0..1)",
    ] {
        assert!(closed(text).is_err(), "{text}");
    }
}

#[test]
fn functions() {
    for (text, a, b) in [
        ("0! + 1! + 5!", 122, 1),
        ("gamma(1) + gamma(4)", 7, 1),
        ("gamma(5/2)/gamma(1/2)", 3, 4),
        ("gamma(-3/2)/gamma(1/2)", 4, 3),
        ("beta(1/2, 5/2)/gamma(1/2)^2", 3, 8),
        ("binomial(7, 0) + binomial(7, 7) + binomial(7, 3)", 37, 1),
        ("binomial(3, 5)", 0, 1),
        ("binomial(-1, 3)", -1, 1),
        (
            "pochhammer(3, 0) + pochhammer(3, 2) + pochhammer(-2, 3)",
            13,
            1,
        ),
        ("(-2)^3 + (-2)^-2 + 0^2", -31, 4),
        ("27^(2/3) + 4^(-1/2) + 0^(1/2)", 19, 2),
        ("sqrt(1/16) + exp(0) + ln(1)", 5, 4),
        ("sqrt(2)^4 + (3^(1/3))^3", 7, 1),
        ("hyp2f1(3, -2; 1/2; 2)", 41, 1),
        ("hyp2f1(5, 7; 9; 0) + hyp2f1r(0, 1; 3; 7)", 3, 2),
    ] {
        let found = closed(&format!("{text} - ({a}/{b})"));
        let found = enclosure(&found.unwrap_or_else(|why| panic!("{text}: {why}")));
        let zero = Rational::default();
        assert!(*found.low() <= zero && zero <= *found.high(), "{text}");
        assert!(found.high() - found.low() < tiny(50), "{text}");
    }
    // DLMF 4.2.2, 4.8.1, 4.21.2, 15.4.6, 15.4.1 and 15.4.3.
    for (a, b) in [
        ("exp(ln(7/3))", "7/3"),
        ("exp(-3)*exp(7/2)", "sqrt(exp(1))"),
        ("ln(1000)", "3*ln(10)"),
        ("ln(1 + 1/10^6)", "-ln(10^6/(10^6 + 1))"),
        ("2^pi", "exp(pi*ln(2))"),
        ("sin(1)*cos(2) + cos(1)*sin(2)", "sin(3)"),
        ("hyp2f1(1/2, 3; 3; -2)", "3^(-1/2)"),
        ("hyp2f1(5/2, 7; 7; 1/4)", "(3/4)^(-5/2)"),
        ("hyp2f1(1, 1; 2; -5)", "ln(6)/5"),
        ("hyp2f1(1/2, 1; 3/2; -1)", "pi/4"),
        ("hyp2f1r(1, 1; 4; 1/2)", "hyp2f1(1, 1; 4; 1/2)/6"),
        ("gamma(1/2)^2", "pi"),
    ] {
        assert_agree(a, b, &[], &[]);
    }
    for text in [
        "hyp2f1(1, 2; -1; 1/2)",
        "hyp2f1(1, 2; 3; 2)",
        "gamma(-2)",
        "(-1)^(1/2)",
        "0^(-1/2)",
    ] {
        assert_eq!(closed(text), Ok(Value::Undefined), "{text}");
    }
    for text in [
        "gamma(1/3)",
        "beta(-1/2, 1)",
        "(1/2)!",
        "binomial(3, 1/2)",
        "pochhammer(2, -1)",
        "hyp2f1(-1, 1; -2; 1/2)",
        "exp(10^6)",
        "sqrt(pi - pi)",
        "(pi - pi)^-1",
        "sin(300)",
        "floor(1)",
    ] {
        assert!(closed(text).is_err(), "{text}");
    }
}

/// Derivatives of every rule, against the formulas of a table, at an exact place.
#[test]
fn derivatives() {
    for (f, known) in [
        ("x^3 - 2*x + 5", "3*x^2 - 2"),
        ("-x^2*(x + 1)", "-3*x^2 - 2*x"),
        ("(x + 1)/(x - 1)", "-2/(x - 1)^2"),
        ("x^a", "a*x^(a - 1)"),
        ("x^(1/2)", "1/(2*sqrt(x))"),
        ("sqrt(3*x + 1)", "3/(2*sqrt(3*x + 1))"),
        ("2^x", "2^x*ln(2)"),
        ("x^x", "x^x*(ln(x) + 1)"),
        ("exp(2*x)", "2*exp(2*x)"),
        ("ln(x^2 + 1)", "2*x/(x^2 + 1)"),
        ("abs(x - 5)", "-1"),
        ("int(t^2 + 1, t = x..x^2)", "2*x*(x^4 + 1) - x^2 - 1"),
        ("a^3", "0"),
    ] {
        let numbers = [("x", 7, 3), ("a", 5, 2)];
        assert_agree(&format!("diff({f}, x)"), known, &numbers, &[]);
    }
    assert_agree("diff(x^5, x, 3)", "60*x^2", &[("x", 2, 1)], &[]);
    for text in [
        "at(diff(x^(3/2), x), x = 0)",
        "at(diff(abs(x), x), x = 0)",
        "at(diff(sqrt(x), x), x = 0)",
        "at(diff(gamma(x), x), x = 2)",
        "at(diff(int(x*t, t = 0..1), x), x = 2)",
        "at(diff(x^2, x, 1/2), x = 2)",
    ] {
        assert!(closed(text).is_err(), "{text}");
    }
}

#[test]
fn limits() {
    for (text, a, b) in [
        ("lim((x^2 + 1)/(x - 3), x -> 2)", -5, 1),
        ("lim(abs(x)*y, x -> 0, y -> 5)", 0, 1),
        ("lim([x < 3], x -> 2)", 1, 1),
    ] {
        assert_eq!(closed(text), exact(a, b), "{text}");
    }
    assert_agree("lim(sqrt(x)*ln(x), x -> 2)", "sqrt(2)*ln(2)", &[], &[]);
    let undefined = closed("lim(ln(-1 - x), x -> 0)");
    assert_eq!(undefined, Ok(Value::Undefined));
    for text in [
        "lim([x < 2], x -> 2)",
        "lim(sqrt(x), x -> 0)",
        "lim(x^y, x -> 0, y -> 0)",
        "lim(1/x, x -> inf)",
    ] {
        assert!(closed(text).is_err(), "{text}");
    }
}
