//! Logic, order, rational arithmetic, equals for equals.

use super::{accepts, rejects};

const SCOPE: &str = "given int k\ngiven int n\ngiven real x\ngiven real y\ngiven fn f(t) density on 0..1
    given fn h(t) integrable on 0..1\ndomain 1 <= k <= n and x > 0\ndomain y >= 0\ndomain k == n or x < 5
    domain 1/y < 2\ndomain y <= inf";
const GIVEN: &str = "1: 1 <= k | given\n2: k <= n | given\n3: 0 < x | given\n4: 0 <= y | given\n0: 0 < k | order | k - 1 + 1\n";

#[track_caller]
fn yes(steps: &str) {
    accepts(SCOPE, &format!("{GIVEN}{steps}"));
}

#[track_caller]
fn no(steps: &str, reason: &str) {
    rejects(SCOPE, &format!("{GIVEN}{steps}"), reason);
}

#[test]
fn what_is_given() {
    yes("9: 0 < x | given");
    no("9: 0 <= x | given", "the domain does not say so");
    no("9: k == n | given", "the domain does not say so");
    no("9: x < 5 | given", "the domain does not say so");
    no("9: 1/y < 2 | given", "1/y is not known to be finite");
    no("9: y <= inf | given", "finite");
    no("9: 0 < z | given", "z is not declared");
}

#[test]
fn finite_and_integer() {
    yes("9: finite (x + y)*k - 2^k/x | finite");
    yes("9: finite exp(-x) | finite");
    yes("9: finite sqrt(y) + ln(x) + gamma(x) + beta(x, k) + pi | finite");
    yes("9: finite k! + binomial(y, k) + pochhammer(y, k) | finite");
    yes("9: finite hyp2f1(y, y; x; 1/2) + hyp2f1r(y, y; x; -2) | finite");
    yes("9: finite x^y + y^x + y^k + x^(-k) + [x < y] | finite");
    yes("9: finite f(1/2) + f(0) + f(1) | finite");
    yes("9: finite exp(y) + sin(y) + cos(y) | finite");
    for (bad, reason) in [
        ("1/y", ""),
        ("sqrt(-x)", ""),
        ("ln(y)", ""),
        ("exp(1/y)", ""),
        ("sin(1/y)", ""),
        ("cos(1/y)", ""),
        ("gamma(y)", ""),
        ("beta(x, y)", ""),
        ("beta(y, x)", ""),
        ("(k - 2)!", ""),
        ("x!", ""),
        ("binomial(k, y)", ""),
        ("pochhammer(x, y)", ""),
        ("pochhammer(x, k - 2)", ""),
        ("hyp2f1(x, x; y; 1/2)", ""),
        ("hyp2f1(x, x; x; 1)", ""),
        ("hyp2f1r(x, x; x; x)", ""),
        ("y^(-k)", ""),
        ("y^y", ""),
        ("(-x)^y", ""),
        ("(x - 1)^(1/2)", ""),
        ("[1/y < 2]", ""),
        ("f(2)", ""),
        ("f(-1)", ""),
        ("f(x)", ""),
        ("h(1/2)", ""),
        ("inf", ""),
        ("f", ""),
        ("int(t, t = 0..1)", ""),
        ("lngamma(x)", ""),
        ("1/y - 1/y", ""),
        ("-(1/y)", ""),
        ("exp(1/y)", ""),
        ("0*(1/y)", ""),
    ] {
        no(&format!("9: finite {bad} | finite"), reason);
    }
    yes("5: 0 <= n | order | n - k + k\n9: integer k*n - 2^k + n! - (k + 1) | finite");
    no("9: integer x | finite", "an integer");
    no("9: integer k/2 | finite", "an integer");
    no("9: integer 1/2 | finite", "an integer");
    no("9: integer 2^(-k) | finite", "an integer");
    no("9: integer k + x | finite", "an integer");
    no("9: integer x - k | finite", "an integer");
    no("9: integer -x | finite", "an integer");
    no("9: x == x | finite", "that a formula is finite");
}

/// A function has values on its range only: at x*y/y it has none where y is 0.
#[test]
fn functions_on_their_range() {
    yes("{ | 5: x <= 1\n9: finite f(x*k/k) | finite");
    no("{ | 5: x <= 1\n9: finite f(x*y/y) | finite", "finite");
}

#[test]
fn finite_by_an_equation() {
    let block = "{ | 5: f(x) == y | 6: y == f(x) | 7: f(x) == 1/y\n";
    yes(&format!("{block}9: finite f(x) | finite 5"));
    yes(&format!("{block}9: finite f(x) | finite 6"));
    no(
        &format!("{block}9: finite f(x) | finite 7"),
        "1/y is not known",
    );
    no(
        &format!("{block}9: finite f(y) | finite 5"),
        "no equation for the formula",
    );
    no(
        &format!("{block}9: finite f(x) | finite 3"),
        "no equation for the formula",
    );
}

#[test]
fn order() {
    yes("9: 0 < n | order | n - k + k");
    yes("9: 0 <= n - k | order");
    yes("9: x != 0 | order");
    yes("9: 0 != x | order");
    yes("9: 0 < x*x/(x + y) | order");
    yes("9: 0 <= x + y + 0 | order");
    yes("9: 0 <= y*y/x | order");
    yes("9: 0 < (k - 1)^2 + x | order");
    yes("9: 0 <= (x - y)^2 | order");
    yes("9: 0 < (-x)^2 | order");
    yes("9: 0 < pi*k! | order");
    yes("9: 0 < exp(-y) | order");
    yes("9: 0 != -k! | order");
}

#[test]
fn order_is_not_guessed() {
    let continuous = "given fn g(t) continuous on 0..1";
    accepts(continuous, "9: finite g(1/2) | finite");
    rejects(continuous, "9: 0 <= g(1/2) | order", "nonnegative");
    no("9: 0 < y | order", "y is not known to be positive");
    no("9: 0 <= k - 2 | order", "nonnegative");
    no(
        "9: 0 < k | order | k - 1 + 2",
        "not equal as rational functions",
    );
    no("9: 0 < x - y | order", "positive");
    no("9: 0 < x*y | order", "positive");
    no("9: 0 < y*x | order", "positive");
    no("9: 0 <= y*(x - k) | order", "nonnegative");
    no("9: 0 <= (x - k)*y | order", "nonnegative");
    no("9: 0 <= y + (x - k) | order", "nonnegative");
    no("9: 0 <= x - k + y | order", "nonnegative");
    no("9: 0 < y + y*y | order", "positive");
    no("9: 0 != x*y | order", "nonzero");
    no("9: 0 != y*x | order", "nonzero");
    no("9: 0 <= x - y | order", "nonnegative");
    no("9: y != 0 | order", "nonzero");
    no("9: 0 < (x - y)^2 | order", "positive");
    no("9: 0 <= (x - y)^3 | order", "nonnegative");
    no("9: 0 < x/y | order", "finite");
    no("9: 0 < x + 0*(1/y) | order | x", "finite");
    no("9: 0*(1/y) < x | order | x", "finite");
    no("9: 0 < x | order | x + 0*(1/y)", "finite");
    no("9: 0 <= y | order | y + 0*(1/y)", "finite");
    no("9: 0 != x | order | x + 0*(1/y)", "finite");
    no("9: finite x | order", "a relation");
}

#[test]
fn order_joins_what_is_known() {
    yes("{ | 5: y != 0\n9: 0 < y | order");
    yes("{ | 5: 0 != y\n9: 0 < y | order");
    yes("{ | 5: k <= 1\n9: k == 1 | order");
    yes("{ | 5: k <= 1\n9: 1 == k | order");
    no("9: k == 1 | order", "nonnegative");
    no("{ | 5: k <= 2\n9: k == 1 | order", "nonnegative");
    yes("{ | 5: sqrt(x) == k\n9: 0 < x + sqrt(x) - k | order 5 | x");
    no(
        "{ | 5: sqrt(x) == k\n9: 0 < x + sqrt(x) - k | order | x",
        "not equal",
    );
    no(
        "{ | 5: sqrt(x) == 1/y\n9: 0 < x | order 5",
        "1/y is not known to be finite",
    );
    no("{ | 5: 0 < x\n9: 0 < x | order 5", "no equation");
    no(
        "{ | 5: f(x) == 1\n9: 0 < x | order 5",
        "f(x) is not known to be finite",
    );
}

#[test]
fn gaps_between_integers() {
    yes("{ | 5: k < n\n9: k + 1 <= n | gap | n - k");
    yes("{ | 5: k < n\n9: k <= n - 1 | gap | n - k");
    no("9: k + 1 <= n | gap", "positive");
    no("{ | 5: k < n\n9: k + 2 <= n | gap | n - k", "not equal");
    no(
        "{ | 5: x < n\n9: x + 1 <= n | gap",
        "x + 1 is not known to be an integer",
    );
    no(
        "{ | 5: k < y\n9: k + 1 <= y | gap",
        "y is not known to be an integer",
    );
    no("{ | 5: k < n\n9: k < n | gap", "concludes a <= b");
}

#[test]
fn rational_arithmetic() {
    yes("9: (x + y)^2/x == x + 2*y + y^2/x | ring");
    yes("9: (x + 1)^(-2) == 1/(x^2 + 2*x + 1) | ring");
    yes("9: x^k*x^k == (x^k)^2 | ring");
    yes("9: ln(x + x) == ln(2*x) | ring");
    yes("9: x^(k + 1 - 1) == x^k | ring");
    yes("9: x^(k - k) == 1 | ring");
    yes("9: f(1/4 + 1/4) == f(1/2) | ring");
    yes("9: (k + k)! == (2*k)! | ring");
    yes("9: 1/x + 1/x*(1/x) == (x + 1)/x^2 | ring");
    yes("9: 2^100 + 2^101 == 3*2^100 | ring");
    yes("9: (x - x)^0 == 1 | ring");
    no("9: (x + y)^2 == x^2 + y^2 | ring", "not equal");
    no("9: x == y | ring", "not equal");
    no("9: y/y == 1 | ring", "finite");
    no("9: 1 == y/y | ring", "finite");
    no("9: ln(x) == ln(2*x) | ring", "not equal");
    no("9: ln(x) == sqrt(x) | ring", "not equal");
    no("9: x^k == y^k | ring", "not equal");
    no("9: x < x + 1 | ring", "concludes an equation");
    no("9: 1/x + 1/x*(1/x) == (x^3 + 1)/x^2 | ring", "not equal");
    no("9: x^201 == x*x^200 | ring", "too high");
    no(
        "9: (2^200)^30 == 0 | ring",
        "a coefficient that is too large",
    );
    no("9: (1 + x + y + k + n)^60 == 0 | ring", "too many terms");
}

#[test]
fn rational_arithmetic_with_equations() {
    let block = "{ | 5: sqrt(x) == y | 6: k == 1 | 7: y == sqrt(x) | 8: x == x + 0\n";
    yes(&format!("{block}9: 2*sqrt(x) == y + sqrt(x) | ring 5"));
    yes(&format!("{block}9: x^k == x | ring 6"));
    yes(&format!("{block}9: gamma(k) == gamma(1) | ring 6"));
    yes(&format!("{block}9: sqrt(x) + k == y + 1 | ring 5 6"));
    no(&format!("{block}9: sqrt(x) == y | ring 6"), "not equal");
    no(&format!("{block}9: sqrt(x) == y | ring 5 7"), "circle");
    no(&format!("{block}9: x == y | ring 8"), "circle");
    no(&format!("{block}9: sqrt(x) == y | ring 3"), "no equation");
}

#[test]
fn cosines_between_their_zeros() {
    let of = |below: &str, above: &str| {
        format!("{{ | 5: {below} < y | 6: y < {above}\n9: 0 < cos(y) | order")
    };
    yes(&of("-pi/2", "pi/2"));
    yes("5: 0 < pi/2 | order\n9: 0 < cos(0) | order");
    no(&of("-pi/2", "pi"), "positive");
    no(&of("-pi", "pi/2"), "positive");
    no(&of("-pi/2", "pi/2").replace("cos", "sin"), "positive");
    no(
        "{ | 5: -pi/2 < y | 6: y <= pi/2\n9: 0 <= cos(y) | order",
        "nonnegative",
    );
    no(
        "{ | 5: -pi/2 <= y | 6: y < pi/2\n9: cos(y) != 0 | order",
        "nonzero",
    );
}

#[test]
fn chains() {
    let block = "{ | 5: f(x) == y | 6: h(x) == y | 7: h(x) == k\n";
    yes(&format!("{block}9: f(x) == k | chain 5 6 7"));
    yes(&format!("{block}9: y == f(x) | chain 5"));
    yes(&format!("{block}9: h(y) == h(y) | chain"));
    no(&format!("{block}9: f(x) == k | chain 5 7"), "do not join");
    no(&format!("{block}9: f(x) == k | chain 5 6"), "end elsewhere");
    no(&format!("{block}9: f(x) == y | chain 3"), "do not join");
    no(
        &format!("{block}9: f(x) <= y | chain 5"),
        "say something else",
    );
    no(&format!("{block}9: x <= x | chain"), "say something else");
    no(&format!("{block}9: x != y | chain 5"), "concludes an");
}

#[test]
fn chains_of_order() {
    let block = "{ | 5: f(x) == x | 6: x < y | 7: y <= k | 8: k == h(x)\n";
    yes(&format!("{block}9: f(x) < h(x) | chain 5 6 7 8"));
    yes(&format!("{block}9: f(x) <= h(x) | chain 5 6 7 8"));
    yes(&format!("{block}9: x < k | chain 6 7"));
    yes("{ | 5: x < y | 6: y < k\n9: x < k | chain 5 6");
    yes(&format!("{block}9: y <= h(x) | chain 7 8"));
    no(
        &format!("{block}9: y < h(x) | chain 7 8"),
        "say something else",
    );
    no(&format!("{block}9: x == y | chain 6"), "say something else");
    no(&format!("{block}9: y == k | chain 7"), "say something else");
    no(&format!("{block}9: y < x | chain 6"), "do not join");
    no(&format!("{block}9: k <= y | chain 7"), "do not join");
    no(&format!("{block}9: f(x) < k | chain 5 6"), "end elsewhere");
}

#[test]
fn what_has_no_value() {
    yes("9: undefined 1/(k - k) | none");
    yes("9: undefined x + -(1/0)! | none");
    yes("9: undefined gamma(1/0) + 1 | none");
    yes("9: undefined 2 - ln(-x) | none");
    yes("9: undefined ln(k - k) | none");
    yes("9: undefined (k - k)^(-k) | none");
    yes("9: undefined f(1/0) | none");
    yes("9: undefined diff(x/(k - k), x) | none");
    yes("9: undefined gamma(k - k) + gamma(-1) | none");
    yes("9: undefined x*gamma(1 - k) | none");
    yes("9: undefined (-k)! | none");
    yes("9: undefined inf - inf | none");
    yes("9: undefined x + (inf^k - inf^(1/2)) | none");
    yes("{ | 5: y == 0\n9: undefined x/y | none");
    yes("{ | 5: 0 == y\n9: undefined ln(y) | none");
    yes("{ | 5: undefined h(x)\n9: undefined h(x) + 1 | none");
    yes("9: 1/(x - x) == ln(-y) | none");
    no("9: undefined 1/y | none", "without value");
    no("9: undefined ln(y) | none", "without value");
    no("9: undefined diff(x/y, x) | none", "without value");
    no("9: undefined (k - k)^k | none", "without value");
    no("9: undefined (k - k)^(-y) | none", "without value");
    no("9: undefined y^(-k) | none", "without value");
    no("9: undefined int(1/0, t = 0..1) | none", "without value");
    no("9: undefined 1/(y/y - 1) | none", "without value");
    for partial in [
        "gamma(2 - k)",
        "gamma(-y)",
        "gamma(-1/2)",
        "(k - k)!",
        "(1 - k)!",
        "(-x)!",
        "inf - x",
        "x - inf",
        "inf + inf",
        "inf - inf^(-k)",
        "inf - inf^y",
        "inf^y - inf",
        "inf - inf^(0/y + 1)",
        "inf - x^k",
        "inf - (inf + x)",
    ] {
        no(&format!("9: undefined {partial} | none"), "without value");
    }
    let whole = "{ | 5: integer 1/y\n";
    no(
        &format!("{whole}9: undefined (-k - 0*(1/y))! | none"),
        "without value",
    );
    for equation in ["1/y + x == 1/y", "x == 2*x*y/y", "2*x*y/y == x"] {
        let block = format!("{{ | 5: {equation}\n");
        no(
            &format!("{block}9: undefined ln(x) | none"),
            "without value",
        );
    }
    no("9: 1/(x - x) == 1 | none", "without value");
    no("9: 1 == 1/(x - x) | none", "without value");
    no(
        "{ | 5: h(x) == 1/y\n9: undefined 1/(h(x) - 1/y) | none",
        "without value",
    );
    no("9: finite x | none", "no value");
}

#[test]
fn computed_values() {
    yes("9: 3! + 1/2 == 13/2 | compute");
    yes("9: gamma(4) == 6 | compute");
    yes("9: sqrt(4) == 2 | compute");
    yes("9: sum(j, j = 1..3) == 6 | compute");
    yes("9: undefined gamma(-1) | compute");
    no("9: 3! == 7 | compute", "another");
    no("9: 3! == 6 + x - x + 0/y | compute", "finite");
    no("9: 3! == gamma(-1) - gamma(-1) + 6 | compute", "finite");
    no("9: sqrt(2) == 1.41 | compute", "no such");
    no("9: undefined 3! | compute", "no such");
    no("9: x == x | compute", "with names");
    no("9: f(1/2) == 1 | compute", "with names");
    no("9: sum(1/j, j = 1..10^9) == 1 | compute", "not found");
    no("9: finite 3! | compute", "concludes a value");
    let many = |count| (0..count).map(|i| format!("c{i}: 1 == 1 | compute\n"));
    yes(&many(19).collect::<String>());
    no(&many(20).collect::<String>(), "too much work");
}

#[test]
fn what_a_condition_decides() {
    for stated in [
        "[0 < x] == 1",
        "[x > 0] == 1",
        "[0 <= y] == 1",
        "[x != 0] == 1",
        "[x == x + 0] == 1",
        "[1 <= k <= n] == 1",
        "[0 < x and 1 <= k] == 1",
        "[x <= 0] == 0",
        "[y < 0] == 0",
        "[x == 0] == 0",
        "[y != y + 0] == 0",
        "[0 < y < 0] == 0",
        "[1/y < 1 and k < 1] == 0",
        "if(0 < x, 1/y, y) == 1/y",
        "if(x <= 0, 1/y, y) == y",
    ] {
        yes(&format!("9: {stated} | decide"));
    }
    for (stated, reason) in [
        ("[0 < y] == 1", "decide so"),
        ("[0 < y] == 0", "decide so"),
        ("[y <= 0] == 1", "decide so"),
        ("[y <= 0] == 0", "decide so"),
        ("[y != 0] == 1", "decide so"),
        ("[y == 0] == 1", "decide so"),
        ("[y == 0] == 0", "decide so"),
        ("[0 < x] == 0", "decide so"),
        ("[x <= 0] == 1", "decide so"),
        ("[0 < x] == x", "decide so"),
        ("[0 < x and 0 < y] == 1", "decide so"),
        ("[1/y < 1/y + 1] == 1", "decide so"),
        ("[1/y == 1/y] == 1", "decide so"),
        ("[1/y + 1 <= 1/y] == 0", "decide so"),
        ("[0 < x or 0 < y] == 1", "not made of relations"),
        ("[not x <= 0] == 1", "not made of relations"),
        ("if(0 < x, y, x) == x", "decide so"),
        ("if(x <= 0, y, x) == y", "decide so"),
        ("if(0 < y, y, x) == y", "decide so"),
        ("x == 1", "depends on a condition"),
        ("0 < [0 < x]", "an equation"),
    ] {
        no(&format!("9: {stated} | decide"), reason);
    }
}

#[test]
fn cases() {
    let cases = "{ | 5: k == 1\n6: 0 < x | order\n}\n{ | 7: k != 1\n8: 0 < x | order\n}\n
        { | 10: k < 1\n11: 0 < x | order\n}\n{ z real | 12: k != 1\n13: 0 < x | order\n}\n
        { | 14: 1/y == 0\n15: 0 < x | order\n}\n{ | 16: 1/y != 0\n17: 0 < x | order\n}\n
        { | 20: 1 <= k\n21: 0 < x | order\n}\n
        { | 30: k == 1\n31: 0 <= x | order\n}\n{ | 32: k != 1\n33: 0 <= x | order\n}\n";
    yes(&format!("{cases}9: 0 < x | cases 6 8"));
    yes(&format!("{cases}9: 0 < x | cases 8 6"));
    yes(&format!("{cases}9: 0 < x | cases 11 21"));
    yes(&format!("{cases}9: 0 < x | cases 21 11"));
    no(&format!("{cases}9: 0 < x | cases 6 6"), "negation");
    no(&format!("{cases}9: 0 < x | cases 6 11"), "negation");
    no(&format!("{cases}9: 0 < x | cases 6 13"), "no variables");
    no(&format!("{cases}9: 0 < x | cases 13 6"), "no variables");
    no(
        &format!("{cases}9: 0 < x | cases 15 17"),
        "1/y is not known to be finite",
    );
    no(&format!("{cases}9: 0 <= x | cases 6 8"), "end alike");
    no(&format!("{cases}9: 0 < x | cases 6 33"), "end alike");
    no(&format!("{cases}9: 0 < x | cases 31 8"), "end alike");
    no(&format!("{cases}9: 0 < x | cases 6"), "missing");
    no(&format!("{cases}9: 0 < x | cases 3 8"), "supposes one fact");
}

#[test]
fn at_a_place() {
    yes("9: at(x*k, x = y, k = n) == y*n | at");
    yes("9: at(x/k, x = k, k = 2) == k/2 | at");
    yes("9: at(int(t*x, t = 0..1), x = y) == int(t*y, t = 0..1) | at");
    yes("9: at(diff(x^2, x), x = y) == at(diff(x^2, x), x = y) | at");
    no("9: at(x/k, x = k, k = 2) == 2/2 | at", "the rule gives k/2");
    no("9: at(x, y = 2, k = 1/y) == x | at", "1/y is not known");
    no("9: at(x, k = 1/y, y = 2) == x | at", "1/y is not known");
    no(
        "9: at(diff(x^2, x), x = y) == diff(y^2, y) | at",
        "the rule gives",
    );
    no("9: x == x | at", "at a place");
    no("9: at(x, x = y) <= y | at", "concludes an equation");
    rejects(
        "given real a\ndomain a > 0\ndraw X ~ beta(a, 1)",
        "9: at(mean(X), a = 2) == mean(X) | at",
        "under a binder",
    );
}

#[test]
fn equals_for_equals() {
    let facts = "{ | 5: x == f(y) | 6: y == f(k)\n";
    yes(&format!(
        "{facts}9: -x + y! == -f(y) + f(k)! | congruence 5 6"
    ));
    yes(&format!(
        "{facts}9: beta(x, 1) == beta(f(y), 1) | congruence 5"
    ));
    yes(&format!("{facts}9: h(f(y)) == h(x) | congruence 5"));
    yes(&format!("{facts}9: [x < y] == [f(y) < y] | congruence 5"));
    yes(&format!(
        "{facts}9: [x < y and 1 < x < 2] == [f(y) < y and 1 < f(y) < 2] | congruence 5"
    ));
    yes(&format!(
        "{facts}9: int(x*t, t = y..1) == int(f(y)*t, t = f(k)..1) | congruence 5 6"
    ));
    yes(&format!(
        "{facts}9: int(x*t, t = 0..1) == int(x*s, s = 0..1) | congruence"
    ));
    yes(&format!(
        "{facts}9: var(x*t, t ~ beta(y, 1)) == var(f(y)*s, s ~ beta(f(k), 1)) | congruence 5 6"
    ));
    yes(&format!(
        "{facts}9: mean(t, t ~ order(1, 2) of uniform(0, x)) == mean(t, t ~ order(1, 2) of uniform(0, f(y))) | congruence 5"
    ));
    for (stated, premises) in [
        ("x + y == f(y) - y", "5"),
        ("x + y == f(y) + k", "5"),
        ("y + x == k + f(y)", "5"),
        ("x == f(k)", "5 6"),
        ("x == k", "5"),
        ("k == x", "5"),
        ("f(y) == k", "5"),
        ("k == f(y)", "5"),
        ("beta(x, 1) == gamma(f(y))", "5"),
        ("h(x) == f(f(y))", "5"),
        ("gamma(x) == ln(f(y))", "5"),
        ("beta(x, 1) == beta(f(y), 2)", "5"),
        ("beta(1, x) == beta(2, f(y))", "5"),
        ("[x < y] == [f(y) <= y]", "5"),
        ("[x < y and x < 1] == [f(y) < k and x < 1]", "5"),
        ("[x < y and x < 1] == [f(y) < y and x < 2]", "5"),
        ("[x < y and x < 1] == [x < y and f(y) < 1 and y < 1]", "5"),
        ("[x < y and x < 1] == [x < y or f(y) < 1]", "5"),
        ("[x < y or x < 1] == [x < y or f(y) < 1]", "5"),
        ("[x < y] == [f(y) < y < 1]", "5"),
        ("int(t, t = 0..x) == sum(t, t = 0..f(y))", "5"),
        ("int(t, t = 0..x) == int(t, t = 0..k)", "5"),
        ("int(t, t = x..1) == int(t, t = k..1)", "5"),
        ("int(y*t, y = 0..1) == int(f(k)*t, y = 0..1)", "6"),
        (
            "mean(t, t ~ beta(x, 1)) == mean(t, t ~ uniform(f(y), 1))",
            "5",
        ),
        ("mean(t, t ~ beta(x, 1)) == var(t, t ~ beta(f(y), 1))", "5"),
        ("mean(t, t ~ beta(x, 1)) == mean(t, t ~ beta(f(y), 2))", "5"),
        ("mean(t, t ~ beta(1, x)) == mean(t, t ~ beta(2, f(y)))", "5"),
        (
            "mean(t, t ~ order(1, 2) of uniform(0, x)) == mean(t, t ~ order(1, 2) of uniform(0, y))",
            "5",
        ),
        (
            "mean(t, t ~ order(1, 3) of uniform(0, x)) == mean(t, t ~ order(1, 2) of uniform(0, f(y)))",
            "5",
        ),
        (
            "mean(t, t ~ order(1, 3) of uniform(0, x)) == mean(t, t ~ order(2, 3) of uniform(0, f(y)))",
            "5",
        ),
        ("diff(x^2, x) == diff(f(y)^2, x)", "5"),
        ("at(x, y = 1) == at(f(y), y = 1)", "5"),
        ("lim(x, y -> 1) == lim(f(y), y -> 1)", "5"),
    ] {
        no(&format!("{facts}9: {stated} | congruence {premises}"), "");
    }
    no(
        &format!("{facts}9: x < y | congruence 5"),
        "concludes an equation",
    );
    no(
        &format!("{facts}9: x == f(y) | congruence 3"),
        "an equation for one variable",
    );
}

#[test]
fn equals_under_binders() {
    let open = "{ s real | 5: 0 < s | 6: s < 1\n7: s*(x + 1) == s*x + s | ring\n}\n";
    let closed = "{ s real | 5: 0 <= s | 6: s <= y\n7: s*(x + 1) == s*x + s | ring\n}\n";
    let other = "{ s real | 5: 0 < s | 6: s < 2\n7: s*(x + 1) == s*x + s | ring\n}\n";
    let (a, b) = ("t*(x + 1)", "t*x + t");
    let stated = |from: &str, to: &str| {
        format!("9: int({a}, t = {from}..{to}) == int({b}, t = {from}..{to}) | congruence 7")
    };
    yes(&format!("{open}{}", stated("0", "1")));
    yes(&format!("{closed}{}", stated("0", "y")));
    no(&format!("{open}{}", stated("0", "2")), "differ");
    no(&format!("{open}{}", stated("1", "0")), "differ");
    no(&format!("{other}{}", stated("0", "1")), "differ");
    no(&format!("{closed}{}", stated("y", "0")), "differ");
    let open_to_y = open.replace("s < 1", "s < y");
    no(&format!("{open_to_y}{}", stated("0", "y")), "differ");
    yes(&format!(
        "{open}9: mean({a}, t ~ beta(2, 3)) == mean({b}, t ~ beta(2, 3)) | congruence 7"
    ));
    yes(&format!(
        "{open}9: mean({a}, t ~ uniform(0, 1)) == mean({b}, t ~ uniform(0, 1)) | congruence 7"
    ));
    no(
        &format!(
            "{open}9: mean({a}, t ~ uniform(0, 2)) == mean({b}, t ~ uniform(0, 2)) | congruence 7"
        ),
        "differ",
    );
    let whole = "{ j int | 5: 1 <= j | 6: j <= n\n7: j*(x + 1) == j*x + j | ring\n}\n";
    yes(&format!(
        "{whole}9: sum(t*(x + 1), t = 1..n) == sum(t*x + t, t = 1..n) | congruence 7"
    ));
    no(
        &format!("{whole}9: sum(t*(x + 1), t = 1..k) == sum(t*x + t, t = 1..k) | congruence 7"),
        "differ",
    );
    no(
        &format!("{whole}9: int(t*(x + 1), t = 1..n) == int(t*x + t, t = 1..n) | congruence 7"),
        "differ",
    );
    let supposes = "{ s real | 5: 0 < s | 6: s < 1 | 7: x == 2\n8: s*x == 2*s | ring 7\n}\n";
    no(
        &format!("{supposes}9: int(t*x, t = 0..1) == int(2*t, t = 0..1) | congruence 8"),
        "differ",
    );
    for more in ["0 < y", "y < s", "s < y", "y < 1"] {
        let supposes = open.replace("| 6:", &format!("| 8: {more} | 6:"));
        no(&format!("{supposes}{}", stated("0", "1")), "differ");
    }
    let other = "{ s real\n";
    for (a, b) in [(a, "t*x + s"), ("s*(x + 1)", b)] {
        no(
            &format!("{open}{other}9: int({a}, t = 0..1) == int({b}, t = 0..1) | congruence 7"),
            "in use",
        );
    }
    let two = "{ s real, r real\n8: s*1 == s | ring\n}\n";
    no(
        &format!("{two}9: int(t*1, t = 0..1) == int(t, t = 0..1) | congruence 8"),
        "for one variable",
    );
    let captured =
        "9: int(int(t*(x + 1), t = 0..1), x = 0..2) == int(int(t*x + t, t = 0..1), x = 0..2)";
    no(&format!("{open}{captured} | congruence 7"), "differ");
    no(
        &format!("{open}9: int(t*(x + 1), s = 0..1) == int(t*x + t, s = 0..1) | congruence 7"),
        "t is not declared",
    );
}

/// The premise is for reals above the x of the proposition, which is positive; a bound x is not.
#[test]
fn a_range_that_a_binder_hides() {
    let block = "{ | 5: x < 2
        { t real | 6: x < t | 7: t < 2\n8: 0 < t | order | t - x + x
        9: ln(t*t) == ln(t) + ln(t) | logarithm\n}\n";
    let (a, b) = ("ln(t*t)", "ln(t) + ln(t)");
    for (inner, range) in [("int", "t = x..2"), ("mean", "t ~ uniform(x, 2)")] {
        let (a, b) = (
            format!("{inner}({a}, {range})"),
            format!("{inner}({b}, {range})"),
        );
        yes(&format!("{block}10: {a} == {b} | congruence 9"));
        no(
            &format!("{block}10: int({a}, x = -1..1) == int({b}, x = -1..1) | congruence 9"),
            "differ",
        );
    }
}

/// An end that is not known to be finite.
#[test]
fn an_endless_range() {
    let stated = |end: &str| {
        format!(
            "{{ s real | 5: 0 <= s | 6: s <= {end}\n7: s + s == 2*s | ring\n}}
            9: int(t + t, t = 0..{end}) == int(2*t, t = 0..{end}) | congruence 7"
        )
    };
    yes(&stated("y^2"));
    no(&stated("int(1/t, t = 0..1)^2"), "differ");
}

/// From y to 0 there is nothing that a premise for y <= s <= 0 covers, but an integral.
#[test]
fn a_reversed_range() {
    let block = "{ s real | 5: y <= s | 6: s <= 0\n7: 0 <= s | order | s - y + y
        8: s == 0 | order\n9: ln(s) == 1/0 | none\n}\n";
    no(
        &format!("{block}10: int(ln(t), t = y..0) == int(1/0, t = y..0) | congruence 9"),
        "differ",
    );
}

#[test]
fn blocks() {
    no("{ k real\n", "in use");
    no("{ f real\n", "in use");
    no("{ z real, z int\n", "in use");
    no("{ z real | 5: z < w\n", "w is not declared");
    no("}", "no block is open");
    no(
        "{ z real | 5: z < x\n}\n9: z < x | order",
        "z is not declared",
    );
    no("{ z real | 5: x < 1\n}\n9: x < 1 | order", "positive");
    no(
        "{ z real | 5: x < 1\n}\n9: f(x) == f(x) | chain 5",
        "holds in its block only",
    );
    yes("{ z real | 5: 0 < z\n}\n{ z real | 6: 0 <= z\n9: 0 <= z | order");
    no(
        "{ z real | 5: 0 < z\n}\n{ z real | 6: 0 <= z\n9: 0 < z | order",
        "positive",
    );
    yes(&"{\n".repeat(32));
    no(&"{\n".repeat(33), "too deep");
    let many = |count| (0..count).map(|i| format!("z{i} real")).collect::<Vec<_>>();
    yes(&format!("{{ {}", many(31).join(", ")));
    no(&format!("{{ {}", many(32).join(", ")), "too much in it");
    let many = |count| {
        (0..count)
            .map(|i| format!(" | h{i}: x < {i}"))
            .collect::<String>()
    };
    yes(&format!("{{{}", many(31)));
    no(&format!("{{{}", many(32)), "too much in it");
}
