//! The value of a closed formula at an exact point.
//!
//! Evaluation is strict: a part without value leaves none to the whole, even where another part is
//! not known. That a formula has no value is claimed for an exact reason only; an enclosure that
//! touches a forbidden number is an [`Unknown`], and more bits may settle it.

use super::functions::{self, SIZE_CAP};
use super::interval::{Interval, Value, size};
use super::scope::{Binding, Scope, full_tank};
use super::{Unknown, calculus, condition, hypergeometric, integrand, law, limit, sums, unknown};
use crate::formula::{Draw, Formula, Function, Operator, Point, RangeKind, Ranged, Rational};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;

/// No value is asked for with more bits.
const BITS_CAP: u32 = 1 << 14;

/// The value of a formula with all names given by the point, means over the draws. A finite value
/// is exact or enclosed with a relative width of about 2^-bits, less what cancels.
///
/// # Errors
/// [`Unknown`] where the kernel has no rule, the work is too much, or `bits` do not settle it.
pub fn value(
    formula: &Formula,
    point: &Point,
    draws: &[Draw],
    bits: u32,
) -> Result<Value, Unknown> {
    if bits > BITS_CAP {
        return unknown("more bits than the kernel computes with");
    }
    let fuel = full_tank();
    value_in(formula, &Scope::new(point, draws, bits.into(), &fuel))
}

/// The value of a formula in a scope.
pub(super) fn value_in(f: &Formula, scope: &Scope) -> Result<Value, Unknown> {
    scope.spend(1)?;
    let result = match f {
        Formula::Number(q) => Interval::exact(q.clone()).into(),
        Formula::Pi => functions::pi(scope.bits)?.into(),
        Formula::Infinity => Value::PlusInfinity,
        Formula::Name(name) => scope.number(name)?.into(),
        Formula::Negate(a) => value_in(a, scope)?.negated(),
        Formula::Binary(operator, a, b) => binary(*operator, a, b, scope)?,
        Formula::Factorial(a) => factorial(a, scope)?,
        Formula::Call(function, parts) => call(*function, parts, scope)?,
        Formula::Apply(name, parts) => match parts.as_slice() {
            [a] => {
                let f = calculus::polynomial_of(name, scope)?;
                on_number(a, scope, |x| Ok(f.at(&x, scope.bits).into()))?
            }
            _ => return unknown("a function of several arguments"),
        },
        Formula::Ranged(r) if r.kind == RangeKind::Integral => integral(r, scope)?,
        Formula::Ranged(r) => sums::ranged(r, scope)?,
        Formula::Derivative(a, x, order) => calculus::derivative(a, x, order, scope)?,
        Formula::At(a, places) => at(a, places, scope)?,
        Formula::Limit(a, places) => limit::limit(a, places, scope)?,
        Formula::Indicator(c) => Value::exact(condition::holds(c, scope)?.into()),
        Formula::If(c, a, b) => {
            let chosen = if condition::holds(c, scope)? { a } else { b };
            value_in(chosen, scope)?
        }
        Formula::Mean(a, own) => law::mean(a, own.as_deref(), scope)?,
        Formula::Variance(a, own) => law::variance(a, own.as_deref(), scope)?,
        Formula::Probability(c, own) => law::probability(c, own.as_deref(), scope)?,
        Formula::Density(drawn, place) => law::density_at(drawn, place, scope)?,
        Formula::Cumulative(drawn, place) => law::cumulative_at(drawn, place, scope)?,
        Formula::Antiderivative(..) => return unknown("an antiderivative has no one value"),
        Formula::BigO(_) | Formula::LittleO(_) => return unknown("an O-term has no value"),
        Formula::Truth(_) => return unknown("a condition in the place of a number"),
    };
    measured(result, scope)
}

/// The value, paid for by its size.
fn measured(value: Value, scope: &Scope) -> Result<Value, Unknown> {
    if let Value::Finite { low, high } = &value {
        let bits = size(low).max(size(high));
        if bits > SIZE_CAP {
            return unknown("a number that is too large");
        }
        scope.spend(bits / 64)?;
    }
    Ok(value)
}

/// A function of one finite number; it has no value where its argument has none.
fn on_number(
    a: &Formula,
    scope: &Scope,
    function: impl Fn(Interval) -> Result<Value, Unknown>,
) -> Result<Value, Unknown> {
    match value_in(a, scope)? {
        Value::Undefined => Ok(Value::Undefined),
        value => match value.finite() {
            Some(x) => function(x),
            None => unknown("a function of an infinity"),
        },
    }
}

fn binary(operator: Operator, a: &Formula, b: &Formula, scope: &Scope) -> Result<Value, Unknown> {
    let (a, b) = (value_in(a, scope), value_in(b, scope));
    if matches!(a, Ok(Value::Undefined)) || matches!(b, Ok(Value::Undefined)) {
        return Ok(Value::Undefined);
    }
    operate(operator, &a?, &b?, scope.bits)
}

/// One arithmetic operation on values.
pub(super) fn operate(
    operator: Operator,
    a: &Value,
    b: &Value,
    bits: u64,
) -> Result<Value, Unknown> {
    match operator {
        Operator::Add => Ok(a.plus(b, bits)),
        Operator::Subtract => Ok(a.plus(&b.negated(), bits)),
        Operator::Multiply => a.times(b, bits),
        Operator::Divide => a.over(b, bits),
        Operator::Power => match (a.finite(), b.finite()) {
            (Some(x), Some(y)) => {
                let power = functions::power(&x, &y, bits)?;
                Ok(power.map_or(Value::Undefined, Value::from))
            }
            _ => unknown("a power of an infinity"),
        },
    }
}

/// n! for integers n >= 0; none for negative integers, where Gamma has its poles.
fn factorial(a: &Formula, scope: &Scope) -> Result<Value, Unknown> {
    on_number(a, scope, |x| match x.as_integer() {
        Some(n) if n.is_negative() => Ok(Value::Undefined),
        Some(n) => Ok(functions::integer(&functions::factorial(n)?).into()),
        None => unknown("a factorial of what is not an exact integer"),
    })
}

/// An integral between its ends. Where one of them has no value there is none.
fn integral(r: &Ranged, scope: &Scope) -> Result<Value, Unknown> {
    let (from, to) = (value_in(&r.from, scope)?, value_in(&r.to, scope)?);
    if from == Value::Undefined || to == Value::Undefined {
        return Ok(Value::Undefined);
    }
    let one = super::polynomial::Polynomial::constant(Interval::integer(1));
    let inner = scope.with(&r.name, Binding::Variable);
    integrand::over_range(&r.body, &one, &r.name, (&from, &to), &inner)
}

/// The formula with names standing for other values, all of them taken outside.
fn at(
    a: &Formula,
    places: &[(crate::formula::Name, Formula)],
    scope: &Scope,
) -> Result<Value, Unknown> {
    let mut inner = scope.clone();
    for (name, place) in places {
        match value_in(place, scope)? {
            Value::Undefined => return Ok(Value::Undefined),
            value => match value.finite() {
                Some(number) => inner = inner.with(name, Binding::Number(number)),
                None => return unknown("a formula at infinity"),
            },
        }
    }
    value_in(a, &inner)
}

/// A function of the language. An argument without value leaves none; an infinite one is not known.
fn call(function: Function, parts: &[Formula], scope: &Scope) -> Result<Value, Unknown> {
    let values: Vec<Result<Value, Unknown>> = parts.iter().map(|p| value_in(p, scope)).collect();
    if values.contains(&Ok(Value::Undefined)) {
        return Ok(Value::Undefined);
    }
    let mut arguments = Vec::new();
    for value in values {
        match value?.finite() {
            Some(number) => arguments.push(number),
            None => return unknown("a function of an infinity"),
        }
    }
    apply(function, &arguments, scope)
}

/// A function of finite numbers.
pub(super) fn apply(function: Function, x: &[Interval], scope: &Scope) -> Result<Value, Unknown> {
    let bits = scope.bits;
    scope.spend(bits / 8)?;
    let result = match (function, x) {
        (Function::Abs, [x]) => x.absolute(),
        (Function::Floor, [x]) => functions::floor(x)?,
        (Function::Min, [first, rest @ ..]) => {
            rest.iter().fold(first.clone(), |least, x| least.minimum(x))
        }
        (Function::Max, [first, rest @ ..]) => {
            rest.iter().fold(first.clone(), |most, x| most.maximum(x))
        }
        (Function::Exp, [x]) => functions::exp_interval(x, bits)?,
        (Function::Sin, [x]) => functions::wave(x, true, bits)?,
        (Function::Cos, [x]) => functions::wave(x, false, bits)?,
        (Function::Sqrt, [x]) => return sqrt(x, bits),
        (Function::Ln, [x]) => return ln(x, bits),
        (Function::Gamma, [x]) => {
            let gamma = functions::gamma(exact(x)?, bits)?;
            return Ok(gamma.map_or(Value::Undefined, Value::from));
        }
        (Function::LnGamma, [x]) => return lngamma(x, bits),
        (Function::Beta, [a, b]) => functions::beta(exact(a)?, exact(b)?, bits)?,
        (Function::Binomial, [n, k]) => functions::binomial(n, whole(k)?, bits)?,
        (Function::Pochhammer, [a, n]) => functions::pochhammer(a, whole(n)?, bits)?,
        (Function::Hyp2F1, [a, b, c, z]) => {
            return hypergeometric::value([exact(a)?, exact(b)?, exact(c)?, exact(z)?], scope);
        }
        (Function::Hyp2F1Regularized, [a, b, c, z]) => {
            let parameters = [exact(a)?, exact(b)?, exact(c)?, exact(z)?];
            return hypergeometric::regularized(parameters, scope);
        }
        _ => return unknown("a function with a wrong number of arguments"),
    };
    Ok(result.into())
}

fn exact(x: &Interval) -> Result<&Rational, Unknown> {
    match x.as_exact() {
        Some(q) => Ok(q),
        None => unknown("a special function of what is not an exact rational"),
    }
}

fn whole(x: &Interval) -> Result<&BigInt, Unknown> {
    match x.as_integer() {
        Some(n) => Ok(n),
        None => unknown("a length that is not an exact integer"),
    }
}

fn sqrt(x: &Interval, bits: u64) -> Result<Value, Unknown> {
    match x.sign() {
        Some(Ordering::Less) => Ok(Value::Undefined),
        None if x.low().is_negative() => unknown("a root of what may be negative at these bits"),
        _ => Ok(functions::root_interval(x, 2, bits)?.into()),
    }
}

fn ln(x: &Interval, bits: u64) -> Result<Value, Unknown> {
    match x.sign() {
        Some(Ordering::Greater) => Ok(functions::ln_interval(x, bits)?.into()),
        Some(_) => Ok(Value::Undefined),
        None if x.high().is_zero() => Ok(Value::Undefined),
        None => unknown("a logarithm of what may not be positive at these bits"),
    }
}

/// ln Gamma(x), which has a value for x > 0 only.
fn lngamma(x: &Interval, bits: u64) -> Result<Value, Unknown> {
    if !x.high().is_positive() {
        return Ok(Value::Undefined);
    }
    match functions::gamma(exact(x)?, bits + 16)? {
        Some(gamma) if gamma.as_exact().is_none_or(|g| !g.is_one()) => ln(&gamma, bits),
        Some(_) => Ok(Value::exact(0)),
        None => unknown("gamma at a pole"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{Law, parse_formula, parse_law};
    use proptest::prelude::*;

    fn draw(name: &str, law: &str) -> Draw {
        Draw {
            name: name.into(),
            law: parse_law(law).expect(law),
        }
    }

    fn at(
        text: &str,
        numbers: &[(&str, i64, i64)],
        draws: &[Draw],
        bits: u32,
    ) -> Result<Value, Unknown> {
        let mut point = Point::default();
        for (name, a, b) in numbers {
            let number = Rational::new((*a).into(), (*b).into());
            point.numbers.insert((*name).into(), number);
        }
        value(&parse_formula(text).expect(text), &point, draws, bits)
    }

    fn closed(text: &str) -> Result<Value, Unknown> {
        at(text, &[], &[], 64)
    }

    fn exact(a: i64, b: i64) -> Result<Value, Unknown> {
        Ok(Interval::exact(Rational::new(a.into(), b.into())).into())
    }

    /// The difference of two formulas is enclosed around zero, and tightly.
    fn assert_agree(a: &str, b: &str, numbers: &[(&str, i64, i64)], draws: &[Draw]) {
        let difference = format!("({a}) - ({b})");
        let found = at(&difference, numbers, draws, 128)
            .and_then(|v| v.finite().ok_or(Unknown(format!("{v:?}"))));
        let found = found.unwrap_or_else(|why| panic!("{difference}: {why}"));
        let tiny = Rational::new(1.into(), BigInt::one() << 90_u32);
        assert!(
            !found.low().is_positive() && !found.high().is_negative(),
            "{difference}"
        );
        assert!(found.high() - found.low() < tiny, "{difference}");
    }

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
            "gamma(0)",
            "lngamma(-1/2)",
            "(-1)!",
            "inf - inf",
            "0*inf",
            "1/inf",
            "hyp2f1(1, 1; 2; 1)",
            "0*(1/0)",
            "int(x/0, x = 1..1)",
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
            ("sum(j^2, j = 1..4)", 30, 1),
            ("sum(j, j = 1..0)", 0, 1),
            ("sup(j*(4 - j), j = 0..4)", 4, 1),
            ("infimum(1/j, j = 1..4)", 1, 4),
            ("beta(3, 2)", 1, 12),
            ("binomial(5, 2) + binomial(5, -1)", 10, 1),
            ("binomial(1/2, 2)", -1, 8),
            ("pochhammer(1/2, 3)", 15, 8),
            ("floor(-1/2) + abs(-3) + min(1, 2, -4) + max(1, 7)", 5, 1),
            ("lngamma(2)", 0, 1),
            ("gamma(5)/4!", 1, 1),
            ("[1 < 2 <= 2] + if(1 == 2, 5, 7) + [1/0 == 1/0]", 8, 1),
            ("int(x^2, x = 0..1)", 1, 3),
            ("int(x^2, x = 1..0)", -1, 3),
            ("int(abs(x), x = -1..2)", 5, 2),
            ("int([1/4 < x < 1/2]*x, x = 0..1)", 3, 32),
            ("int(max(x, 1/2), x = 0..1)", 5, 8),
            ("int(1/x^2, x = 2..inf)", 1, 2),
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
            "int(1/x, x = 1..inf)",
            "inf + 1",
            "-(-inf)",
            "mean(1/x, x ~ beta(1, 3))",
            "int(1/x^2, x = -1..1)",
        ] {
            assert_eq!(closed(text), Ok(Value::PlusInfinity), "{text}");
        }
    }

    /// At Va = 0 the mean of U^-p is finite for l > p only, and then it is a ratio of Betas.
    #[test]
    fn powers_of_the_volume() {
        let draws = [draw("x", "beta(l, m - l + 1)")];
        let mean = |l, p| {
            at(
                "mean(x^-p)",
                &[("l", l, 1), ("m", 5, 1), ("p", p, 1)],
                &draws,
                64,
            )
        };
        assert_eq!(mean(2, 2), Ok(Value::PlusInfinity));
        assert_eq!(mean(3, 2), exact(5 * 4, 2));
        assert_eq!(
            at("mean(x)", &[("l", 0, 1), ("m", 5, 1)], &draws, 64),
            Ok(Value::Undefined)
        );
    }

    /// The thesis's identities 2.28, 2.30, 2.45 and 2.49, at points where they hold.
    #[test]
    fn identities_of_the_thesis() {
        let draws = [draw("x", "beta(l, m - l + 1)")];
        let f = "hyp2f1(1, l; m + 1; -V/Va)";
        for (l, m, a, b) in [(1, 1, 3, 1), (2, 5, 7, 2), (4, 4, 1, 9), (3, 12, 55, 1)] {
            let numbers = [("l", l, 1), ("m", m, 1), ("Va", a, b), ("V", 5, 3)];
            assert_agree("mean(1/(Va + V*x))", &format!("{f}/Va"), &numbers, &draws);
            let second = format!("((-Va*m + Va - l*V + V)*{f} + Va*m)/(Va^2*(Va + V))");
            assert_agree("mean(1/(Va + V*x)^2)", &second, &numbers, &draws);
        }
        let numbers = [("k", 4, 1), ("n", 7, 1), ("I", 3, 2)];
        assert_agree(
            "int(2*I*k/r, r = sqrt((k-1)/n)..sqrt(k/n))",
            "I*k*ln(k/(k-1))",
            &numbers,
            &[],
        );
        assert_agree(
            "var(I*k/(n*r), r ~ uniform((k-1)/n, k/n))",
            "I^2*k*(1/(k-1) - k*ln((k-1)/k)^2)",
            &numbers,
            &[],
        );
        let root = "int(n*[sqrt((k-1)/n) < r < sqrt(k/n)]*2*r*I*k/(n*r^2), r = 0..1)";
        assert_agree(root, "I*k*(ln(k) - ln(k-1))", &numbers, &[]);
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

    /// A draw of a mean's own is not the parameter of the same name.
    #[test]
    fn an_own_draw_hides_a_parameter() {
        for text in [
            "mean(sum(1, j = 1..k), k ~ uniform(0, 2))",
            "mean(x*sum(1, j = 1..x), x ~ uniform(0, 2))",
        ] {
            assert!(at(text, &[("k", 3, 1), ("x", 3, 1)], &[], 64).is_err());
        }
        let found = at("mean(k, k ~ uniform(0, k))", &[("k", 3, 1)], &[], 64);
        assert_eq!(found, exact(3, 2));
        assert!(at("density(x, inf)", &[], &[draw("x", "uniform(0, 1)")], 64).is_err());
    }

    #[test]
    fn a_bound_name_hides_a_parameter() {
        // The law of x is read where the mean stands: outside of the sum.
        let draws = [draw("x", "beta(k, 1)"), draw("y", "uniform(0, 1)")];
        let found = at("mean(sum(k*x*y, k = 1..2))", &[("k", 2, 1)], &draws, 64);
        assert!(found.is_err());
        let found = at("sum(k, k = 1..3) + k", &[("k", 5, 1)], &draws, 64);
        assert_eq!(found, exact(11, 1));
        assert!(at("sum(mean(x), x = 1..3)", &[("k", 5, 1)], &draws, 64).is_err());
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

    /// The density of an order statistic against the closed product, David & Nagaraja 2.1.6.
    #[test]
    fn order_statistics() {
        let draws = [draw("r", "order(l, m) of density x -> 3*x^2 on 0..1")];
        let product = "m!/((l-1)!*(m-l)!)*(y^3)^(l-1)*(1-y^3)^(m-l)*3*y^2";
        for (l, m) in [(1, 1), (1, 4), (3, 4), (4, 4), (5, 9)] {
            let numbers = [("l", l, 1), ("m", m, 1), ("y", 2, 3)];
            let difference = format!("density(r, y) - {product}");
            assert_eq!(at(&difference, &numbers, &draws, 64), exact(0, 1));
            let total = at("int(density(r, t), t = 0..2)", &numbers, &draws, 64);
            assert_eq!(total, exact(1, 1));
        }
    }

    #[test]
    fn several_draws_split() {
        let draws = [draw("x", "uniform(0, 1)"), draw("y", "beta(2, 1)")];
        assert_eq!(at("mean(x*y + 2*x - y)", &[], &draws, 64), exact(2, 3));
        assert!(at("mean(1/(x + y))", &[], &draws, 64).is_err());
        assert_eq!(
            at("mean((x - mean(x))^2) - var(x)", &[], &draws, 64),
            exact(0, 1)
        );
        let law = Law::Any;
        let any = Draw {
            name: "z".into(),
            law,
        };
        assert!(at("mean(z)", &[], &[any], 64).is_err());
    }

    /// Coefficients of a hundred digits cancel: the logarithm is enclosed with as many bits more.
    #[test]
    fn large_linear_forms_keep_their_digits() {
        let found = at("hyp2f1(1, 40; 81; -2/79)", &[], &[], 64)
            .unwrap()
            .finite()
            .unwrap();
        let width = (found.high() - found.low()) / found.low();
        assert!(width < Rational::new(1.into(), BigInt::one() << 50_u32));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn more_bits_refine(l in 1_i64..6, more in 0_i64..5, a in 1_i64..30, bits in 40_u32..120) {
            let numbers = [("l", l, 1), ("m", l + more, 1), ("Va", a, 7)];
            for text in ["hyp2f1(1, l; m + 1; -3/Va)", "hyp2f1(1/2, l; m + 3/2; -1/(1 + Va))",
                "exp(sin(Va))*sqrt(Va + pi)", "int(Va/(x + l)^2 + 1/(x + m), x = 0..sqrt(2))"]
            {
                let few = at(text, &numbers, &[], bits).unwrap().finite().unwrap();
                let many = at(text, &numbers, &[], 2 * bits).unwrap().finite().unwrap();
                prop_assert!(few.compare(&many).is_none_or(Ordering::is_eq), "{}", text);
                prop_assert!(few.is_exact() || many.high() - many.low() < few.high() - few.low());
            }
        }
    }
}
