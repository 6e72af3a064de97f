//! Laws, means and what draws hide.

use super::*;

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

/// Equations that hold, at a few points of their domains.
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

/// The density of an order statistic against the closed product, David & Nagaraja 2.1.6.
#[test]
fn order_statistics() {
    let draws = [draw("r", "order(l, m) of density x -> 3*x^2 on 0..1")];
    let product = "m!/((l-1)!*(m-l)!)*(y^3)^(l-1)*(1-y^3)^(m-l)*3*y^2";
    for (l, m) in [(1, 1), (1, 4), (3, 4), (4, 4), (5, 9)] {
        let numbers = [("l", l, 1), ("m", m, 1), ("y", 2, 3)];
        let difference = format!("density(r, y) - {product}");
        assert_eq!(at(&difference, &numbers, &draws, 64), exact(0, 1));
        let total = at("prob(r <= 1)", &numbers, &draws, 64);
        assert_eq!(total, exact(1, 1));
    }
}

#[test]
fn means_are_over_one_draw() {
    let draws = [draw("x", "uniform(0, 1)"), draw("y", "beta(2, 1)")];
    assert_eq!(
        at("mean((x - mean(x))^2) - var(x)", &[], &draws, 64),
        exact(0, 1)
    );
    assert_eq!(at("mean(x)*mean(y)", &[], &draws, 64), exact(1, 3));
    assert_eq!(
        at("mean(x + mean(y)) + mean(2)", &[], &draws, 64),
        exact(19, 6)
    );
    assert!(at("x", &[("x", 1, 1)], &draws, 64).is_err());
    for text in [
        "mean(1/(x + y))",
        "int(mean(x), x = 0..1)",
        "x",
        "mean(x, x ~ uniform(0, 1))",
    ] {
        assert!(at(text, &[], &draws, 64).is_err(), "{text}");
    }
    assert!(at("mean(z)", &[], &[draw("z", "any")], 64).is_err());
    // A comparison that does not have the variable, of an infinite mean.
    let found = at("int([mean(1/x) > 3]*s, s = 0..1)", &[], &draws, 64);
    assert_eq!(found, exact(1, 2));
}

/// Moments from the closed forms of the laws.
#[test]
fn moments() {
    for (text, a, b) in [
        ("mean(x, x ~ beta(3, 2))", 3, 5),
        ("var(x, x ~ beta(3, 2))", 1, 25),
        ("mean(1/x, x ~ beta(3, 2))", 2, 1),
        ("mean((1 - x)^2, x ~ beta(1, 4))", 2, 3),
        ("mean(x, x ~ uniform(-1, 4))", 3, 2),
        ("var(3*x + 1, x ~ uniform(-1, 4))", 75, 4),
        ("mean(x, x ~ order(3, 3) of uniform(1, 5))", 4, 1),
        (
            "mean(x, x ~ order(2, 3) of density v -> 2*v on 0..1)",
            24,
            35,
        ),
        ("mean(x^2, x ~ density v -> 2*v/3 on 1..2)", 5, 2),
        ("mean(x^2, x ~ density v -> 2*v on sqrt(2)..sqrt(3))", 5, 2),
        ("prob(1/4 < x <= 1/2, x ~ uniform(0, 1))", 1, 4),
        ("prob(x^2 > 1/4, x ~ uniform(-1, 1))", 1, 2),
    ] {
        let found = enclosure(&closed(text).unwrap_or_else(|why| panic!("{text}: {why}")));
        let known = Rational::new(a.into(), b.into());
        assert!(*found.low() <= known && known <= *found.high(), "{text}");
        assert!(found.high() - found.low() < tiny(50), "{text}");
    }
    let infinite = "var(1/x, x ~ beta(2, 2))";
    assert_eq!(closed(infinite), Ok(Value::PlusInfinity));
}

/// What is proved to be no law has no mean; what is not seen to be one is not known.
#[test]
fn laws_are_checked() {
    for law in [
        "beta(0, 1)",
        "beta(2, -1/2)",
        "uniform(1, 1)",
        "uniform(2, 1)",
        "order(0, 3) of uniform(0, 1)",
        "order(4, 3) of uniform(0, 1)",
        "order(3/2, 3) of uniform(0, 1)",
        "order(1, 5/2) of uniform(0, 1)",
    ] {
        assert_eq!(
            closed(&format!("mean(x, x ~ {law})")),
            Ok(Value::Undefined),
            "{law}"
        );
    }
    for law in [
        "beta(1/2, 1)",
        "beta(700, 1)",
        "density v -> 2*v on 0..2",
        "density v -> 4*v - 1 on 0..1",
        "density v -> 1/v on 1..2",
        "density v -> -1 on 1..0",
        "density v -> v/v on 0..1",
    ] {
        assert!(closed(&format!("mean(x, x ~ {law})")).is_err(), "{law}");
    }
}

#[test]
fn densities_and_distributions_of_draws() {
    let draws = [draw("x", "beta(2, 1)"), draw("y", "uniform(1, 3)")];
    for (text, a, b) in [
        ("density(x, 1/2)", 1, 1),
        ("density(x, 1)", 2, 1),
        ("density(x, -1)", 0, 1),
        ("density(y, 4) + density(y, 1)", 1, 2),
        ("cdf(x, 1/2)", 1, 4),
        ("cdf(y, 0)", 0, 1),
        ("cdf(y, 5)", 1, 1),
        ("cdf(2*y, 3)", 1, 4),
    ] {
        assert_eq!(at(text, &[], &draws, 64), exact(a, b), "{text}");
    }
    let nowhere = at("cdf(x, 1/inf)", &[], &draws, 64);
    assert_eq!(nowhere, Ok(Value::Undefined));
    assert!(at("cdf(x/0, 1)", &[], &draws, 64).is_err());
    for text in [
        "density(2*x, 1)",
        "sum(density(x, 1/2), x = 1..2)",
        "density(z, 1)",
        "cdf(x, y)",
        "density(x, 1/0 + y)",
    ] {
        let found = at(text, &[], &draws, 64);
        assert!(found.is_err() || found == Ok(Value::Undefined), "{text}");
    }
}

/// The limit of a mean over Beta laws, finite and infinite, and what moves besides the law.
#[test]
fn limits_of_means() {
    let draws = [draw("x", "beta(l, 1)"), draw("y", "beta(l, 2)")];
    let limit = |body: &str| at(&format!("lim(mean({body}), l -> 2)"), &[], &draws, 64);
    assert_eq!(limit("x"), exact(2, 3));
    assert_eq!(limit("1/x^2"), Ok(Value::PlusInfinity));
    assert_eq!(limit("-1/x^2"), Ok(Value::MinusInfinity));
    assert_eq!(
        limit("1/(x + 1)").map(|v| enclosure(&v).is_positive()),
        Ok(true)
    );
    for body in ["1/x", "x*l", "x*mean(y)", "x/x", "abs(x - 1/2)"] {
        assert!(limit(body).is_err(), "{body}");
    }
}
