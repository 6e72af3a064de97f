//! Printing and parsing again gives the same tree, and canonical texts stay as they are.

mod support;

use claimcheck::formula::{
    Formula, Operator, Statement, parse_condition, parse_formula, parse_law, parse_proposition,
    parse_statement,
};
use claimcheck::formula::{free_names, substitute};
use proptest::prelude::*;

/// Text and its canonical form.
const FORMULAS: &[(&str, &str)] = &[
    ("-a^2", "-a^2"),
    ("(-a)^2", "(-a)^2"),
    ("2^-k", "2^-k"),
    ("2^-k^2*3", "2^-k^2*3"),
    ("a-(b-c)-d", "a - (b - c) - d"),
    ("a/b/c*d", "a/b/c*d"),
    ("a/(b*c)", "a/(b*c)"),
    ("a^b^c", "a^b^c"),
    ("(a^b)^c", "(a^b)^c"),
    ("n!^2!", "n!^2!"),
    ("(-n)!", "(-n)!"),
    ("a--b*-c", "a - -b*-c"),
    ("-(a*b)", "-(a*b)"),
    ("-a*b", "-a*b"),
    ("0.050", "0.05"),
    ("007", "7"),
    ("hyp2f1(1,l,m+1,z)", "hyp2f1(1, l; m + 1; z)"),
    ("hyp2f1r(1, l; m+1; -V/Va)", "hyp2f1r(1, l; m + 1; -V/Va)"),
    ("sum(j^2, j=1..n)", "sum(j^2, j = 1..n)"),
    ("int(e^-x, x = 0..inf)", "int(e^-x, x = 0..inf)"),
    ("int(1/x, x)", "int(1/x, x)"),
    ("diff(x^2, x, 1)", "diff(x^2, x)"),
    ("diff(x^2, x, n)", "diff(x^2, x, n)"),
    ("at(x*y, x = a, y = b+1)", "at(x*y, x = a, y = b + 1)"),
    ("lim(x*y, x -> 0, y -> inf)", "lim(x*y, x -> 0, y -> inf)"),
    (
        "sup(1/k, k = 1..inf) + infimum(1/k, k = 1..inf)",
        "sup(1/k, k = 1..inf) + infimum(1/k, k = 1..inf)",
    ),
    (
        "[a<b and not (c==d or e>f)]",
        "[a < b and not (c == d or e > f)]",
    ),
    ("if(0 <= r <= 1, 2*r, 0)", "if(0 <= r <= 1, 2*r, 0)"),
    ("(a<b)+1", "(a < b) + 1"),
    ("((a<b)) == c", "((a < b) == c)"),
    (
        "mean(x*k, x ~ beta(l, m-l+1))",
        "mean(x*k, x ~ beta(l, m - l + 1))",
    ),
    (
        "var(x) + prob(x < 1 or x > 2)",
        "var(x) + prob(x < 1 or x > 2)",
    ),
    (
        "prob(x < 1, x ~ order(1, 2) of uniform(0, 1))",
        "prob(x < 1, x ~ order(1, 2) of uniform(0, 1))",
    ),
    ("density(X, x) - cdf(X, x)", "density(X, x) - cdf(X, x)"),
    ("O((1/k)^3) + o(1)", "O((1/k)^3) + o(1)"),
    ("min(a, b, c)*max(a, b)", "min(a, b, c)*max(a, b)"),
    ("f'(r_1, 2)", "f'(r_1, 2)"),
];

const STATEMENTS: &[(&str, &str)] = &[
    ("a==b<c", "a == b < c"),
    ("n! == n*(n-1)!", "n! == n*(n - 1)!"),
    ("n!==1", "n! == 1"),
    ("a ~ b as k -> inf", "a ~ b as k -> inf"),
    (
        "L =~ S + O(1/k) as n->inf then k->inf uniformly in l, m along k = m*(m-1)/2 + l, v = m",
        "L =~ S + O(1/k) as n -> inf then k -> inf uniformly in l, m along k = m*(m - 1)/2 + l, v = m",
    ),
    ("a == b + o(x) as x -> 0+", "a == b + o(x) as x -> 0+"),
    (
        "a == b as x -> 1 - and c == d as n, k, n/k -> inf, x -> 0- uniformly in l",
        "a == b as x -> 1- and c == d as n, k, n/k -> inf, x -> 0- uniformly in l",
    ),
    (
        "f(r) is 2*r with density on 0..1, agrees 2.33",
        "f(r) is 2*r with density on 0..1, agrees 2.33",
    ),
    (
        "F(r) is r^2 cdf on 0..1 and a == b",
        "F(r) is r^2 with cdf on 0..1 and a == b",
    ),
    ("phi is 2*I/n", "phi is 2*I/n"),
    (
        "2.103-strategy-2 if k >= 3 and n > k",
        "2.103-strategy-2 if k >= 3 and n > k",
    ),
    (
        "a == [k > 1 and n > 2] and b == c",
        "a == [k > 1 and n > 2] and b == c",
    ),
    ("words", "words"),
    (" empty ", "empty"),
];

#[test]
fn formulas_print_canonically() {
    for (text, canonical) in FORMULAS {
        let formula = parse_formula(text).or_else(|_| parse_formula(&format!("({text})")));
        let formula = formula.unwrap_or_else(|error| panic!("{text}: {error:?}"));
        assert_eq!(formula.to_string(), *canonical, "{text}");
        assert_eq!(parse_formula(canonical).as_ref(), Ok(&formula), "{text}");
    }
}

#[test]
fn statements_print_canonically() {
    for (text, canonical) in STATEMENTS {
        let statement = parse_statement(text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        assert_eq!(statement.to_string(), *canonical, "{text}");
        assert_eq!(
            parse_statement(canonical).as_ref(),
            Ok(&statement),
            "{text}"
        );
    }
}

#[test]
fn precedence() {
    let parse = |text| parse_formula(text).expect(text);
    assert_eq!(parse("-a^2"), parse("-(a^2)"));
    assert_eq!(parse("a^b^c"), parse("a^(b^c)"));
    assert_eq!(parse("a - b - c"), parse("(a - b) - c"));
    assert_eq!(parse("-a*b"), parse("(-a)*b"));
    assert_eq!(parse("2^n!"), parse("2^(n!)"));
    let half = Formula::binary(Operator::Divide, Formula::integer(1), Formula::integer(2));
    assert_eq!(parse("1/2"), half);
}

#[test]
fn and_of_a_condition_is_not_that_between_statements() {
    let Ok(Statement::All(items)) = parse_statement("a == [b < c and d < e] and f == g") else {
        panic!("two statements");
    };
    assert_eq!(items.len(), 2);
    assert!(matches!(
        parse_statement("2.5 if k > 2 and n > 3"),
        Ok(Statement::Conditional { .. })
    ));
}

#[test]
fn laws_and_conditions() {
    for text in [
        "beta(k, n - k + 1)",
        "order(l, m) of order(1, 2) of density f on a..b",
        "density x -> 2*x on 0..1",
        "any",
    ] {
        assert_eq!(parse_law(text).expect(text).to_string(), text);
    }
    for text in [
        "1 <= k <= n",
        "a < b or c != d and not e == f",
        "(a < b or c < d) and not not e > f",
    ] {
        assert_eq!(parse_condition(text).expect(text).to_string(), text);
    }
    assert_eq!(
        parse_law("density x -> f(x) on 0..1"),
        parse_law("density f on 0..1")
    );
}

#[test]
fn propositions() {
    let text = "given int k\ngiven int n\ngiven real I\ngiven fn f(x) smooth(2) on 0..1\n\
                domain 1 <= k <= n\ndomain I > 0\ndraw r ~ beta(k, n - k + 1)\n\
                says mean(I*k/(n*r)) == I*k/(k - 1)";
    let proposition = parse_proposition(text).expect(text);
    assert_eq!(proposition.to_string(), text);
    assert!(parse_proposition("says a == b\ngiven int a").is_err());
    assert!(parse_proposition("given int a\n").is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(300), failure_persistence: None, ..Default::default() })]

    #[test]
    fn every_formula_survives_printing(formula in support::formula()) {
        let text = formula.to_string();
        prop_assert_eq!(parse_formula(&text), Ok(formula), "{}", text);
    }

    #[test]
    fn every_condition_survives_printing(condition in support::condition()) {
        let text = condition.to_string();
        prop_assert_eq!(parse_condition(&text), Ok(condition), "{}", text);
    }

    #[test]
    fn every_proposition_survives_printing(proposition in support::proposition()) {
        let text = proposition.to_string();
        prop_assert_eq!(parse_proposition(&text), Ok(proposition), "{}", text);
    }

    #[test]
    fn substitution_leaves_no_name_behind(formula in support::formula()) {
        let value = parse_formula("x*k + 1").expect("a formula");
        let result = substitute(&formula, &[("a".into(), value)]).expect("small");
        let mut expected = free_names(&formula);
        if expected.remove("a") {
            expected.extend(["x".into(), "k".into()]);
        }
        prop_assert_eq!(free_names(&result), expected, "{} -> {}", formula, result);
    }
}

/// The number of random cases, to be raised by `CLAIMCHECK_CASES`.
fn cases(default: u32) -> u32 {
    std::env::var("CLAIMCHECK_CASES")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(default)
}
