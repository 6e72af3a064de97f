//! Integrals, sums, means and the functions that are defined by integrals.

use super::{accepts, rejects};

const SCOPE: &str = "given int k\ngiven int n\ngiven real x\ngiven real y\ngiven real z
    given fn f(t) density on 0..1\ngiven fn h(t) integrable on 0..1\ndomain 1 <= k <= n and x > 0\ndomain y >= 0
    draw X ~ beta(x, 2)\ndraw Y ~ uniform(x, x + y)\ndraw U ~ uniform(0, X)
    draw T ~ order(k, n) of uniform(1, 3)\ndraw D ~ density f on 0..1\ndraw A ~ any
    draw S ~ order(k, n) of density s -> 2*s on 0..1\ndraw B ~ order(1, 2) of beta(1, 1)";
const GIVEN: &str =
    "101: 1 <= k | given\n102: k <= n | given\n103: 0 < x | given\n104: 0 <= y | given
    105: 0 < k | order | k - 1 + 1\n106: 0 <= n | order | n - k + k\n";

#[track_caller]
fn yes(steps: &str) {
    accepts(SCOPE, &format!("{GIVEN}{steps}"));
}

#[track_caller]
fn no(steps: &str, reason: &str) {
    rejects(SCOPE, &format!("{GIVEN}{steps}"), reason);
}

/// A block for one variable on a range, the ends counted in (`<=`) or not (`<`), with its lines.
fn on(range: &str, lines: &str) -> String {
    format!("{{ {range}\n{lines}\n}}\n")
}

#[test]
fn primitives() {
    let closed = "t real | 1: 0 <= t | 2: t <= y";
    let open = "t real | 1: 0 < t | 2: t < y";
    let facts =
        "3: finite t^2 + 1 | finite\n4: 2*t^(2 - 1)*1 == 2*t | ring\n5: finite 2*t | finite";
    let result = "9: int(2*s, s = 0..y) == y^2 + 1 - (0^2 + 1) | primitive 3 4 5 | t^2 + 1";
    let proof = on(closed, facts);
    yes(&format!("{proof}{result}"));
    yes(&format!(
        "{proof}9: int(2*t, t = 0..y) == y^2 + 1 - (0^2 + 1) | primitive 3 4 5 | t^2 + 1"
    ));
    no(&format!("{}{result}", on(open, facts)), "supposes more");
    no(
        &format!("{proof}{}", result.replace("== y^2", "== y^3")),
        "the rule gives",
    );
    no(
        &format!("{proof}{}", result.replace("int(2*s", "int(3*s")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("3 4 5", "5 4 5")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("3 4 5", "3 3 5")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("3 4 5", "3 4 3")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("3 4 5", "3 4 103")),
        "for one variable",
    );
    no(
        &format!("{proof}{}", result.replace("0..y", "0..x")),
        "supposes more",
    );
    no(
        &format!("{proof}{}", result.replace("0..y", "y..0")),
        "nonnegative",
    );
    no(
        &format!("{proof}{}", result.replace("int(2*s, s", "sum(2*s, s")),
        "for integrals",
    );
    no(
        &format!("{proof}{}", result.replace(" | t^2 + 1", "")),
        "argument is missing",
    );
    let twice = format!(
        "{}{}",
        on(open, "4: 2*t^(2 - 1)*1 == 2*t | ring"),
        on(
            "t real | 6: 0 <= t | 7: t <= y",
            "3: finite t^2 + 1 | finite\n5: finite 2*t | finite"
        )
    );
    yes(&format!("{twice}{result}"));
    let other = format!(
        "{}{}",
        on(
            "r real | 1: 0 < r | 2: r < y",
            "4: 2*r^(2 - 1)*1 == 2*r | ring"
        ),
        on(
            "t real | 6: 0 <= t | 7: t <= y",
            "3: finite t^2 + 1 | finite\n5: finite 2*t | finite"
        )
    );
    no(&format!("{other}{result}"), "different variables");
    let indicator = on(
        closed,
        "3: finite [t < 1]*t | finite\n5: finite [t < 1] | finite",
    );
    no(
        &format!("{indicator}9: int([s < 1], s = 0..y) == 0 | primitive 3 3 5 | [t < 1]*t"),
        "",
    );
    let integers = proof.replace("t real", "t int");
    no(&format!("{integers}{result}"), "supposes more");
}

#[test]
fn derivatives() {
    let range = "t real | 1: 1 <= t | 2: t <= 2 | 3: 0 < t | 4: 0 < t + x";
    for (primitive, derivative) in [
        ("x", "0"),
        ("t", "1"),
        ("-t", "-1"),
        ("t + x", "1"),
        ("x + t", "1"),
        ("x - t", "0 - 1"),
        ("t - ln(t)", "1 - 1/t"),
        ("x*t", "x*1"),
        ("t*x", "1*x"),
        ("t*ln(t)", "1*ln(t) + t*(1/t)"),
        ("t/x", "1/x"),
        ("x/t", "(0*t - x*1)/t^2"),
        ("t^x", "x*t^(x - 1)*1"),
        ("sqrt(t)", "1/(2*sqrt(t))"),
        ("x^t", "x^t*(1*ln(x))"),
    ] {
        let name = "t".into();
        let formula = crate::formula::parse_formula(primitive).expect(primitive);
        let derived = super::super::derive(&formula, &name).expect(primitive);
        assert_eq!(derived.to_string(), derivative, "of {primitive}");
        yes(&format!("{{ {range}\n9: finite {derivative} | finite"));
    }
    for refused in [
        "gamma(t)",
        "f(t)",
        "int(s*t, s = 0..t)",
        "sum(s, s = 0..t)",
        "t!",
    ] {
        let formula = crate::formula::parse_formula(refused).expect(refused);
        assert!(
            super::super::derive(&formula, &"t".into()).is_err(),
            "{refused}"
        );
    }
}

#[test]
fn substitutions() {
    let closed = on("t real | 1: 0 <= t | 2: t <= x", "3: finite t^2 | finite");
    let inside = "t real | 4: 0 < t | 5: t < x";
    let open = on(
        inside,
        "6: 0 < 2*t^(2 - 1)*1 | order | 2*t\n7: t^3 == t^2*(1/2)*(2*t^(2 - 1)*1) | ring",
    );
    let proof = format!("{closed}{open}");
    let result = "9: int(s^3, s = 0..x) == int(u*(1/2), u = 0..x^2) | substitution 3 6 7 | t^2";
    yes(&format!("{proof}{result}"));
    no(
        &format!("{proof}{}", result.replace("x^2)", "x)")),
        "new ends",
    );
    no(
        &format!("{proof}{}", result.replace("u = 0", "u = 1")),
        "new ends",
    );
    no(
        &format!("{proof}{}", result.replace("u*(1/2)", "u*(1/3)")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("3 6 7", "6 6 7")),
        "supposes more",
    );
    no(
        &format!("{proof}{}", result.replace("3 6 7", "3 3 7")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("3 6 7", "3 6 6")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("0..x)", "0..y)")),
        "y is not known to be",
    );
    no(
        &format!("{proof}{}", result.replace(") == int(", ") == sum(")),
        "for integrals",
    );
    let weak = on(
        inside,
        "6: 0 <= 2*t^(2 - 1)*1 | order | 2*t\n7: t^3 == t^2*(1/2)*(2*t^(2 - 1)*1) | ring",
    );
    no(&format!("{closed}{weak}{result}"), "the premise should be");
    let clash = "{ t real\n9: int(s^3, s = 0..x) == int(t*0 + u*(1/2), u = 0..x^2) | substitution 3 6 7 | t^2";
    no(&format!("{proof}{clash}"), "depends on the old variable");
}

#[test]
fn factors_and_sums_of_integrals() {
    yes("9: int(x*t, t = 0..y) == x*int(t, t = 0..y) | scale");
    yes("9: int(-x*(1/t), t = 0..1) == -x*int(1/t, t = 0..1) | scale");
    no(
        "9: int(t*x, t = 0..y) == t*int(x, t = 0..y) | scale",
        "t is not declared",
    );
    no(
        "{ t real\n9: int(t*x, t = 0..y) == t*int(x, t = 0..y) | scale",
        "depends on the variable",
    );
    no(
        "9: int(y*t, t = 0..1) == y*int(t, t = 0..1) | scale",
        "finite",
    );
    no(
        "9: int(1/y*t, t = 0..1) == 1/y*int(t, t = 0..1) | scale",
        "finite",
    );
    no(
        "9: int(x*t, t = 0..y) == x*int(t, t = 0..x) | scale",
        "the rule gives",
    );
    no(
        "9: int(x + t, t = 0..y) == x*int(t, t = 0..x) | scale",
        "a product",
    );
    let finite = "{ | 1: finite int(ln(t), t = 0..1) | 2: finite int(t, t = 0..1)\n";
    yes(&format!(
        "{finite}9: int(ln(t) + t, t = 0..1) == int(ln(t), t = 0..1) + int(t, t = 0..1) | split"
    ));
    yes(&format!(
        "{finite}9: int(ln(t) - t, t = 0..1) == int(ln(t), t = 0..1) - int(t, t = 0..1) | split"
    ));
    no(
        &format!(
            "{finite}9: int(ln(t) + t, t = 0..1) == int(ln(t), t = 0..1) - int(t, t = 0..1) | split"
        ),
        "the rule gives",
    );
    no(
        &format!(
            "{finite}9: int(ln(t)*t, t = 0..1) == int(ln(t), t = 0..1)*int(t, t = 0..1) | split"
        ),
        "a sum",
    );
    no(
        &format!(
            "{finite}9: int(1/t + t, t = 0..1) == int(1/t, t = 0..1) + int(t, t = 0..1) | split"
        ),
        "finite",
    );
    no(
        &format!(
            "{finite}9: int(t + 1/t, t = 0..1) == int(t, t = 0..1) + int(1/t, t = 0..1) | split"
        ),
        "finite",
    );
}

#[test]
fn continuous_integrands() {
    let block = |lines: &str| on("t real | 1: 0 <= t | 2: t <= 1", lines);
    for e in [
        "t",
        "-t/(1 + t)",
        "(t + x)^y",
        "ln(t + x)",
        "sqrt(t)",
        "f(t)",
        "t*x^(1/2) - 1",
        "gamma(x)",
    ] {
        let proof = block(&format!(
            "5: 0 < t + x | order | x + t\n6: 0 < 1 + t | order | t + 1\n3: finite {e} | finite"
        ));
        yes(&format!(
            "{proof}9: finite int({e}, t = 0..1) | continuous 3"
        ));
    }
    for e in ["[t < 1]", "t*[t < 1]", "[t < 1]*t", "gamma(t + x)", "x^t"] {
        let proof = block(&format!(
            "5: 0 < t + x | order | x + t\n3: finite {e} | finite"
        ));
        no(
            &format!("{proof}9: finite int({e}, t = 0..1) | continuous 3"),
            "",
        );
    }
    let open = on("t real | 1: 0 < t | 2: t < 1", "3: finite 1/t | finite");
    no(
        &format!("{open}9: finite int(1/t, t = 0..1) | continuous 3"),
        "supposes more",
    );
    let t = block("3: finite t | finite");
    no(
        &format!("{t}9: finite int(t^2, t = 0..1) | continuous 3"),
        "the premise should be",
    );
    no(
        &format!("{t}9: finite int(t, t = 1..0) | continuous 3"),
        "supposes more",
    );
    let all = on("t real", "3: finite t | finite");
    yes(&format!("{all}9: finite int(t, t = 0..1) | continuous 3"));
    yes(&format!("{all}9: finite int(t, t = 1..0) | continuous 3"));
    yes(&format!("{all}9: finite int(t, t = z..x) | continuous 3"));
    no(
        &format!("{all}9: finite int(t, t = 0..1/z) | continuous 3"),
        "finite",
    );
    no(
        &format!("{all}9: finite int(t, t = 0..inf) | continuous 3"),
        "finite",
    );
    for range in ["t real | 1: z <= t", "t real | 1: t <= x"] {
        let some = on(range, "3: finite t | finite");
        no(
            &format!("{some}9: finite int(t, t = z..x) | continuous 3"),
            "supposes more",
        );
    }
    no(
        &format!("{t}9: int(t, t = 0..1) == 1 | continuous 3"),
        "concludes that an integral",
    );
    no(
        &format!("{t}9: finite sum(t, t = 0..1) | continuous 3"),
        "for integrals",
    );
}

#[test]
fn divergence() {
    let closed = on("t real | 1: 0 <= t | 2: t <= x", "3: finite 1 + t | finite");
    let open = on(
        "t real | 4: 0 < t | 5: t < x",
        "6: (1 + t)/t == (1 + t)/(t - 0) | ring\n7: 0 <= 1 + t | order",
    );
    let proof = format!("{closed}{open}");
    let result = "9: int((1 + s)/s, s = 0..x) == inf | diverges 3 6 7 | 1 + t";
    yes(&format!("{proof}{result}"));
    no(
        &format!("{proof}{}", result.replace("== inf", "== 1")),
        "the rule gives inf",
    );
    no(
        &format!("{proof}{}", result.replace("0..x", "0..y")),
        "positive",
    );
    no(
        &format!("{proof}{}", result.replace("3 6 7", "7 6 7")),
        "supposes more",
    );
    no(
        &format!("{proof}{}", result.replace("3 6 7", "3 7 7")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("3 6 7", "3 6 6")),
        "the premise should be",
    );
    no(
        &format!("{proof}{}", result.replace("(1 + s)/s", "(2 + s)/s")),
        "the premise should be",
    );
    let steep = proof.replace("(1 + t)/t ==", "(1 + t)/t^2 ==");
    let steep = steep.replace("(1 + t)/(t - 0)", "(1 + t)/(t - 0)^2");
    let result = "9: int((1 + s)/s^2, s = 0..x) == inf | diverges 3 6 7 | 1 + t | 2";
    yes(&format!("{steep}{result}"));
    no(
        &format!("{steep}{}", result.replace("| 2", "| 3")),
        "the premise should be",
    );
    no(
        &format!("{steep}{}", result.replace("| 2", "")),
        "the premise should be",
    );
    for (exponent, steep) in [("1", true), ("0", false), ("x", false)] {
        let proof = proof.replace("(t - 0)", &format!("(t - 0)^{exponent}"));
        let body = match exponent {
            "1" => "(1 + t)/t",
            "0" => "1 + t",
            _ => "(1 + t)/t^x",
        };
        let proof = proof.replace("(1 + t)/t ==", &format!("{body} =="));
        let body = body.replace('t', "s");
        let step =
            format!("{proof}9: int({body}, s = 0..x) == inf | diverges 3 6 7 | 1 + t | {exponent}");
        match steep {
            true => yes(&step),
            false => no(&step, "a number, 1 or more"),
        }
    }
    let vanishing = format!(
        "{}{}",
        on("t real | 1: 0 <= t | 2: t <= x", "3: finite t | finite"),
        on(
            "t real | 4: 0 < t | 5: t < x",
            "6: t/t == t/(t - 0) | ring\n7: 0 <= t | order"
        )
    );
    no(
        &format!("{vanishing}9: int(s/s, s = 0..x) == inf | diverges 3 6 7 | t"),
        "positive",
    );
    let jumping = on(
        "t real | 1: 0 <= t | 2: t <= x",
        "3: finite 1 + [t < 0] | finite\n7: 0 <= 1 + [t < 0] | order",
    );
    no(
        &format!("{jumping}9: int(1/s, s = 0..x) == inf | diverges 3 3 7 | 1 + [t < 0]"),
        "continuous",
    );
}

#[test]
fn supports() {
    let inside = on(
        "t real | 1: 1 < t | 2: t < 2",
        "3: [1 < t < 2] == 1 | decide\n4: [1 < t < 2]*(1/t) == 1*(1/t) | congruence 3",
    );
    let below = on(
        "t real | 5: 0 < t | 6: t < 1",
        "7: [1 < t < 2] == 0 | decide\n8: [1 < t < 2]*(1/t) == 0 | ring 7",
    );
    let above = on(
        "t real | 11: 2 < t | 12: t < 3",
        "13: [1 < t < 2] == 0 | decide\n14: 0 < t | order | t - 2 + 2\n15: [1 < t < 2]*(1/t) == 0 | ring 13",
    );
    let proof = format!("{inside}{below}{above}");
    let result = "9: int([1 < s < 2]*(1/s), s = 0..3) == int(1*(1/s), s = 1..2) | support 4 8 15";
    yes(&format!("{proof}{result}"));
    yes(&format!(
        "{proof}{}",
        result
            .replace("0..3", "1..3")
            .replace("support 4 8", "support 4")
    ));
    yes(&format!(
        "{proof}{}",
        result.replace("0..3", "0..2").replace("8 15", "8")
    ));
    for (old, new, reason) in [
        ("int(1*", "int(2*", "the premise should be"),
        ("*(1/s), s = 0", "*(2/s), s = 0", "the premise should be"),
        ("0..3", "3/2..3", "nonnegative"),
        ("1..2", "2..1", "nonnegative"),
        ("0..3", "0..3/2", "nonnegative"),
        ("0..3", "0..y", "nonnegative"),
        ("1..2", "1..3/2", "supposes more"),
        ("0..3", "-1..3", "supposes more"),
        ("0..3", "0..4", "supposes more"),
        ("4 8 15", "4 15 8", "supposes more"),
        ("4 8 15", "8 8 15", "supposes more"),
        ("4 8 15", "4 4 15", "supposes more"),
        ("4 8 15", "4 8", "missing"),
        ("4 8 15", "4", "missing"),
        ("0..3", "1..3", "supposes more"),
        ("int(1*(1/s), s =", "sum(1*(1/s), s =", "for integrals"),
        ("int([1 <", "sum([1 <", "for integrals"),
    ] {
        no(&format!("{proof}{}", result.replacen(old, new, 1)), reason);
    }
    for (facts, reason) in [
        (proof.replace("t real | 1:", "t int | 1:"), "supposes more"),
        (proof.replace("t real | 5:", "t int | 5:"), "supposes more"),
        (
            proof.replace("8: [1 < t < 2]*(1/t)", "8: [1 < t < 2]/t"),
            "the premise should be",
        ),
        (
            proof.replace("15: [1 < t < 2]*(1/t) == 0", "15: [1 < t < 2]*(1/t) == 0*t"),
            "the premise should be",
        ),
    ] {
        no(&format!("{facts}{result}"), reason);
    }
    // Over a point the integral is 0.
    let nowhere = on("t real | 1: 0 < t | 2: t < 0", "3: [t < 0] == 1 | decide");
    let elsewhere = on("t real | 5: 0 < t | 6: t < 3", "7: [t < 0] == 0 | decide");
    yes(&format!(
        "{nowhere}{elsewhere}9: int([s < 0], s = 0..3) == int(1, s = 0..0) | support 3 7"
    ));
}

#[test]
fn factors_and_sums_of_means() {
    let law = "t ~ beta(x, 1)";
    yes(&format!("9: mean(x*t, {law}) == x*mean(t, {law}) | scale"));
    yes(&format!(
        "{{ | 1: finite mean(t, {law})\n9: mean(y*t, {law}) == y*mean(t, {law}) | scale"
    ));
    for (stated, reason) in [
        (
            format!("mean(x*t, {law}) == x*mean(t, t ~ beta(x, 2))"),
            "the rule gives",
        ),
        (format!("mean(y*t, {law}) == y*mean(t, {law})"), "finite"),
        (
            format!("mean(1/y*t, {law}) == 1/y*mean(t, {law})"),
            "finite",
        ),
        (
            format!("var(x*t, {law}) == x*var(t, {law})"),
            "for integrals",
        ),
        ("mean(x*X) == x*mean(X)".to_string(), "for integrals"),
        (
            format!("mean(x + t, {law}) == x*mean(t, {law})"),
            "a product",
        ),
    ] {
        no(&format!("9: {stated} | scale"), reason);
    }
    no(
        &format!("{{ t real\n9: mean(t*x, {law}) == t*mean(x, {law}) | scale"),
        "depends on the variable",
    );
    let finite = format!("{{ | 1: finite mean(t, {law}) | 2: finite mean(1/t, {law})\n");
    for (stated, reason) in [
        (
            format!("mean(t - 1/t, {law}) == mean(t, {law}) - mean(1/t, {law})"),
            "",
        ),
        (
            format!("mean(t - 1/t, {law}) == mean(t, {law}) + mean(1/t, {law})"),
            "the rule gives",
        ),
        (
            format!("mean(t - ln(t), {law}) == mean(t, {law}) - mean(ln(t), {law})"),
            "finite",
        ),
        (
            format!("mean(ln(t) - t, {law}) == mean(ln(t), {law}) - mean(t, {law})"),
            "finite",
        ),
        (
            format!("mean(t*(1/t), {law}) == mean(t, {law})*mean(1/t, {law})"),
            "a sum",
        ),
    ] {
        let proof = format!("{finite}9: {stated} | split");
        match reason {
            "" => yes(&proof),
            reason => no(&proof, reason),
        }
    }
}

#[test]
fn telescoping_sums() {
    let steps = on(
        "j int | 1: 1 <= j | 2: j <= n",
        "3: j == (j + 1)*(j + 1 - 1)/2 - j*(j - 1)/2 | ring",
    );
    let ends = on(
        "j int | 4: 1 <= j | 5: j <= n + 1",
        "6: finite j*(j - 1)/2 | finite",
    );
    let result =
        "9: sum(i, i = 1..n) == (n + 1)*(n + 1 - 1)/2 - 1*(1 - 1)/2 | telescope 3 6 | j*(j - 1)/2";
    yes(&format!("{steps}{ends}{result}"));
    no(
        &format!("{steps}{ends}{}", result.replace("sum(i,", "sum(i^2,")),
        "the premise should be",
    );
    no(
        &format!(
            "{steps}{ends}{}",
            result.replace("== (n + 1)", "== (n + 2)")
        ),
        "the rule gives",
    );
    no(
        &format!("{steps}{ends}{}", result.replace("1..n", "1..k")),
        "supposes more",
    );
    no(
        &format!("{steps}{ends}{}", result.replace("3 6", "6 6")),
        "supposes more",
    );
    no(
        &format!("{steps}{ends}{}", result.replace("3 6", "3 3")),
        "supposes more",
    );
    no(
        &format!("{steps}{ends}{}", result.replace("1..n", "1..x")),
        "an integer",
    );
    no(
        &format!("{steps}{ends}{}", result.replace("1..n", "x..n")),
        "an integer",
    );
    no(
        &format!("{steps}{ends}{}", result.replace("sum(", "int(")),
        "for sums",
    );
    let short = on(
        "j int | 4: 1 <= j | 5: j <= n",
        "6: finite j*(j - 1)/2 | finite",
    );
    no(&format!("{steps}{short}{result}"), "supposes more");
    let other = on(
        "i int | 4: 1 <= i | 5: i <= n + 1",
        "6: finite i*(i - 1)/2 | finite",
    );
    no(&format!("{steps}{other}{result}"), "different variables");
    let back = "9: sum(i, i = n..k) == 0 | telescope 3 6 | j*(j - 1)/2";
    no(&format!("{steps}{ends}{back}"), "nonnegative");
}

#[test]
fn draws() {
    yes("9: mean(1/X) == mean(1/X, X ~ beta(x, 2)) | draw");
    yes("9: var(X*k) == var(X*k, X ~ beta(x, 2)) | draw");
    no(
        "9: mean(1/X) == mean(1/X, X ~ beta(x, 3)) | draw",
        "the only draw",
    );
    no(
        "9: mean(1/X) == var(1/X, X ~ beta(x, 2)) | draw",
        "gives a mean",
    );
    no(
        "9: mean(1/X) == mean(2/X, X ~ beta(x, 2)) | draw",
        "gives a mean",
    );
    no(
        "9: mean(X*Y) == mean(X*Y, X ~ beta(x, 2)) | draw",
        "the only draw",
    );
    no(
        "9: mean(k) == mean(k, X ~ beta(x, 2)) | draw",
        "the only draw",
    );
    no(
        "9: mean(U) == mean(U, U ~ uniform(0, X)) | draw",
        "depends on a draw",
    );
}

#[test]
fn means_inside_of_means() {
    let block = "{ | 1: mean(X) == x\n";
    yes(&format!(
        "{block}9: mean((X - mean(X))^2) == mean((X - x)^2) | congruence 1"
    ));
    yes(&format!(
        "{block}9: var(X*mean(X)) == var(X*x) | congruence 1"
    ));
    for (stated, premises) in [
        ("mean((X - mean(X))^2) == mean((X - x)^2)", ""),
        ("mean(X*mean(X)) == var(X*x)", "1"),
        ("var(X*mean(X)) == mean(X*x)", "1"),
        ("mean(Y*mean(X)) == mean(Y*x)", "1"),
        ("var(mean(X)) == var(x)", "1"),
        ("mean(X*mean(X)) == mean(X*x, X ~ beta(x, 2))", "1"),
    ] {
        no(
            &format!("{block}9: {stated} | congruence {premises}"),
            "differ",
        );
    }
}

#[test]
fn probabilities() {
    let own = "t ~ beta(x, 1)";
    yes("9: prob(X < x) == mean([X < x]) | probability");
    yes(&format!(
        "9: prob(t < y, {own}) == mean([t < y], {own}) | probability"
    ));
    for stated in [
        "prob(X < x) == mean([X <= x])".to_string(),
        "prob(X < x) == mean([X < x], X ~ beta(x, 2))".to_string(),
        "prob(X < x) == var([X < x])".to_string(),
        format!("prob(t < y, {own}) == mean([t < y], t ~ beta(x, 2))"),
        format!("prob(X < y, {own}) == mean([X < y])"),
    ] {
        no(&format!("9: {stated} | probability"), "the rule gives");
    }
    no(
        "9: mean([X < x]) == prob(X < x) | probability",
        "for probabilities",
    );
    no("9: prob(X < x) < 1 | probability", "an equation");
}

#[test]
fn densities_of_laws() {
    yes(
        "9: mean(t^2, t ~ beta(x, k)) == int(t^(x - 1)*(1 - t)^(k - 1)/beta(x, k)*t^2, t = 0..1) | density",
    );
    no(
        "9: mean(t^2, t ~ beta(y, k)) == int(t^(y - 1)*(1 - t)^(k - 1)/beta(y, k)*t^2, t = 0..1) | density",
        "positive",
    );
    no(
        "9: mean(t^2, t ~ beta(k, y)) == int(t^(k - 1)*(1 - t)^(y - 1)/beta(k, y)*t^2, t = 0..1) | density",
        "positive",
    );
    no(
        "9: mean(t^2, t ~ beta(x, k)) == int(t^(x - 1)*(1 - t)^(k - 1)/beta(x, k)*t, t = 0..1) | density",
        "the rule gives",
    );
    yes(
        "9: mean(t, t ~ uniform(y, y + x)) == int(1/(y + x - y)*t, t = y..y + x) | density 0"
            .replace(" 0", "")
            .as_str(),
    );
    no(
        "9: mean(t, t ~ uniform(0, y)) == int(1/(y - 0)*t, t = 0..y) | density",
        "positive",
    );
    no(
        "{ t real | 1: 0 < t\n9: mean(t, t ~ uniform(0, t)) == int(1/(t - 0)*t, t = 0..t) | density",
        "a name like its draw's",
    );
    no("9: mean(A, A ~ any) == 0 | density", "not given");
    no("9: x == x | density", "means and densities");
    no("9: mean(X) == 0 | density", "means and densities");
    yes(
        "1: 0 <= 1/2 | order\n9: density(X, 1/2) == (1/2)^(x - 1)*(1 - 1/2)^(2 - 1)/beta(x, 2) | density",
    );
    no(
        "9: density(X, 2) == 2^(x - 1)*(1 - 2)^(2 - 1)/beta(x, 2) | density",
        "nonnegative",
    );
    no(
        "9: density(X, -1) == (-1)^(x - 1)*(1 - -1)^(2 - 1)/beta(x, 2) | density",
        "nonnegative",
    );
    no("9: density(x, 1/2) == 1 | density", "no draw");
    no("9: density(Y, x) == 1/(x + y - x) | density", "positive");
}

#[test]
fn densities_given_and_of_order_statistics() {
    let f = "1: int(f(s), s = 0..1) == 1 | function\n5: int(f(x), x = 0..1) == 1 | function\n";
    let sign = on("s real | 2: 0 < s | 3: s < 1", "4: 0 <= f(s) | order");
    let stated = "9: mean(D, D ~ density f on 0..1) == int(f(D)*D, D = 0..1) | density 4 5";
    yes(&format!("{f}{sign}{stated}"));
    no(
        &format!("{f}{sign}{}", stated.replace("4 5", "1 5")),
        "for one variable",
    );
    no(
        &format!("{f}{sign}{}", stated.replace("4 5", "4 103")),
        "the premise should be",
    );
    no(
        &format!("{f}{sign}{}", stated.replace("f on 0..1", "f on 0..2")),
        "supposes more",
    );
    let order =
        |l: &str, m: &str, law: &str| format!("9: mean(t, t ~ order({l}, {m}) of {law}) == ");
    let weight = |l: &str, m: &str, below: &str, f: &str| {
        format!(
            "{m}!/(({l} - 1)!*({m} - {l})!)*({below})^({l} - 1)*(1 - {below})^({m} - {l})*({f})"
        )
    };
    let uniform = |l: &str, m: &str| {
        let weight = weight(l, m, "(t - 1)/(3 - 1)", "1/(3 - 1)");
        format!(
            "{}int({weight}*t, t = 1..3) | density",
            order(l, m, "uniform(1, 3)")
        )
    };
    yes(&uniform("k", "n"));
    no(&uniform("n", "k"), "nonnegative");
    no(&uniform("x", "n"), "an integer");
    no(&uniform("1", "x"), "an integer");
    no(&uniform("0", "n"), "nonnegative");
    no(
        &uniform("k", "n").replace("^(n - k)", "^(n - k + 1)"),
        "the rule gives",
    );
    no(
        "9: mean(t, t ~ order(1, 2) of beta(1, 1)) == 0 | density",
        "without a rule",
    );
    let s =
        "{ s real | 5: 0 <= s | 6: s <= 1\n7: finite s^2 | finite\n8: 2*s^(2 - 1)*1 == 2*s | ring
        10: finite 2*s | finite\n11: 0 <= 2*s | order\n}\n
        12: int(2*s, s = 0..1) == 1^2 - 0^2 | primitive 7 8 10 | s^2\n13: 1^2 - 0^2 == 1 | ring
        14: int(2*s, s = 0..1) == 1 | chain 12 13\n15: 0 <= y/(y + x) | order\n
        16: y/(y + x) <= 1 | order | x/(y + x)\n";
    let at = "y/(y + x)";
    let below = format!("int(2*s, s = 0..{at})");
    let found = weight("k", "n", &below, &format!("2*({at})"))
        .replace(&format!("({below})^"), &format!("{below}^"));
    let density = format!("9: density(S, {at}) == {} | density 11 14", found);
    yes(&format!("{s}{density}"));
    no(
        &format!("{s}{}", density.replace("11 14", "10 14")),
        "the premise should be",
    );
    no(
        &format!("{s}{}", density.replace("11 14", "11 13")),
        "the premise should be",
    );
}

#[test]
fn variances() {
    let (e, law) = ("k*t", "t ~ uniform(0, x)");
    yes(&format!(
        "9: var({e}, {law}) == mean(({e})^2, {law}) - mean({e}, {law})^2 | variance"
    ));
    no(
        &format!("9: var({e}, {law}) == mean(({e})^2, {law}) - mean({e}, {law}) | variance"),
        "the rule gives",
    );
    no(
        &format!("9: mean({e}, {law}) == mean({e}, {law}) | variance"),
        "over a draw",
    );
    no(
        "9: var(X) == mean(X^2) - mean(X)^2 | variance",
        "over a draw",
    );
    let finite = format!("{{ | 1: finite mean(t, {law})\n");
    let centred = format!("9: var(t, {law}) == mean((t - mean(t, {law}))^2, {law}) | variance");
    yes(&format!("{finite}{centred}"));
    no(&centred, "finite");
    no(
        &format!("{finite}{}", centred.replace(")^2", ")^3")),
        "the rule gives",
    );
    no(
        &format!(
            "{{ t real\n{}{}",
            finite.replace("0, x", "0, t"),
            centred.replace("0, x", "0, t")
        ),
        "a name like its draw's",
    );
    let block = format!("{{ | 1: mean({e}, {law}) == inf | 2: mean({e}, {law}) == 2\n");
    yes(&format!("{block}9: undefined var({e}, {law}) | variance 1"));
    no(
        &format!("{block}9: undefined var({e}, {law}) | variance 2"),
        "the premise should be",
    );
    no(
        &format!("{block}9: undefined var({e}, {law}) | variance"),
        "missing",
    );
    no(
        &format!("{block}9: finite var({e}, {law}) | variance 1"),
        "for variances",
    );
}

#[test]
fn variances_of_linear_forms() {
    let law = "t ~ uniform(0, x)";
    for e in ["t + k", "k + t", "t - k", "t + mean(s, s ~ beta(1, 1))"] {
        let stated = format!("9: var({e}, {law}) == var(t, {law}) | variance");
        yes(&format!("{{ | 1: finite mean(s, s ~ beta(1, 1))\n{stated}"));
        no(
            &format!(
                "{{ | 1: finite mean(s, s ~ beta(1, 1))\n{}",
                stated.replace("== var(t, t ~ uniform(0, x)", "== var(t, t ~ uniform(0, 1)")
            ),
            "the rule gives",
        );
    }
    yes(&format!(
        "9: var(k*t, {law}) == k^2*var(t, {law}) | variance"
    ));
    yes(&format!(
        "{{ | 1: finite var(t, {law})\n9: var(y*t, {law}) == y^2*var(t, {law}) | variance"
    ));
    for (stated, reason) in [
        (
            format!("var(k - t, {law}) == var(t, {law})"),
            "the rule gives",
        ),
        (format!("var(t + 1/y, {law}) == var(t, {law})"), "finite"),
        (format!("var(1/y + t, {law}) == var(t, {law})"), "finite"),
        (format!("var(t - 1/y, {law}) == var(t, {law})"), "finite"),
        (format!("var(t + t, {law}) == var(t, {law})"), "no constant"),
        (format!("var(t - t, {law}) == var(t, {law})"), "no constant"),
        (
            format!("var(t^2 + t, {law}) == var(t, {law})"),
            "no constant",
        ),
        (
            format!("var(t*k, {law}) == var(t, {law})"),
            "the rule gives",
        ),
        (
            format!("var(k*t, {law}) == k*var(t, {law})"),
            "the rule gives",
        ),
        (
            format!("var(k*t, {law}) == k^2*var(t, t ~ uniform(0, 1))"),
            "the rule gives",
        ),
        (format!("var(y*t, {law}) == y^2*var(t, {law})"), "finite"),
        (
            format!("var(1/y*t, {law}) == (1/y)^2*var(t, {law})"),
            "finite",
        ),
        (
            format!("var(k/t, {law}) == k^2*var(t, {law})"),
            "the rule gives",
        ),
    ] {
        no(&format!("9: {stated} | variance"), reason);
    }
    no(
        &format!("{{ t real\n9: var(t*k, {law}) == t^2*var(k, {law}) | variance"),
        "no constant",
    );
}

#[test]
fn beta_and_euler_integrals() {
    yes("9: beta(x, 2) == int(s^(x - 1)*(1 - s)^(2 - 1), s = 0..1) | beta-integral");
    no(
        "9: beta(y, 2) == int(s^(y - 1)*(1 - s)^(2 - 1), s = 0..1) | beta-integral",
        "positive",
    );
    no(
        "9: beta(2, y) == int(s^(2 - 1)*(1 - s)^(y - 1), s = 0..1) | beta-integral",
        "positive",
    );
    no(
        "9: beta(x, 2) == int(s^(x - 1)*(1 - s)^2, s = 0..1) | beta-integral",
        "the rule gives",
    );
    no(
        "9: beta(x, 2) == int(x^(x - 1)*(1 - x)^(2 - 1), x = 0..1) | beta-integral",
        "in use",
    );
    no(
        "9: gamma(x) == int(s^(x - 1)*(1 - s)^(2 - 1), s = 0..1) | beta-integral",
        "as an integral",
    );
    let euler = "9: hyp2f1(y, x; x + 1; -y) == int(s^(x - 1)*(1 - s)^(x + 1 - x - 1)*(1 - -y*s)^(-y), s = 0..1)/beta(x, x + 1 - x) | euler";
    let below = "1: 0 < 1 - -y | order | 1 + y\n2: 0 < x + 1 - x | order | 1\n";
    yes(&format!("{below}{euler}"));
    no(
        &format!("2: 0 < x + 1 - x | order | 1\n{euler}"),
        "positive",
    );
    no(
        &format!("{below}{}", euler.replace("-y*s", "y*s")),
        "the rule gives",
    );
    no(
        "9: hyp2f1(y, x; x; -1) == int(s^(x - 1)*(1 - s)^(x - x - 1)*(1 - -1*s)^(-y), s = 0..1)/beta(x, x - x) | euler",
        "positive",
    );
    no(
        "9: hyp2f1(y, y; 2 + y; -1) == int(s^(y - 1)*(1 - s)^(2 + y - y - 1)*(1 - -1*s)^(-y), s = 0..1)/beta(y, 2 + y - y) | euler",
        "positive",
    );
    no(
        "9: hyp2f1(1/y, 1; 2; -1) == int(s^(1 - 1)*(1 - s)^(2 - 1 - 1)*(1 - -1*s)^(-(1/y)), s = 0..1)/beta(1, 2 - 1) | euler",
        "finite",
    );
    no(
        "9: hyp2f1(y, 1; 2; -1) == int(y^(1 - 1)*(1 - y)^(2 - 1 - 1)*(1 - -1*y)^(-y), y = 0..1)/beta(1, 2 - 1) | euler",
        "in use",
    );
    no(
        "9: hyp2f1(y, 1; 2; -1) == 1/beta(1, 2 - 1) | euler",
        "as an integral",
    );
    no("9: hyp2f1(y, 1; 2; -1) == 1 | euler", "as an integral");
    yes("9: hyp2f1r(y, y; x; 1/2) == hyp2f1(y, y; x; 1/2)/gamma(x) | regularized");
    no(
        "9: hyp2f1r(y, y; y; 1/2) == hyp2f1(y, y; y; 1/2)/gamma(y) | regularized",
        "finite",
    );
    no(
        "9: hyp2f1r(y, y; x; 1/2) == hyp2f1(y, y; x; 1/2)*gamma(x) | regularized",
        "the rule gives",
    );
    no(
        "9: hyp2f1(y, y; x; 1/2) == hyp2f1(y, y; x; 1/2) | regularized",
        "for hyp2f1r",
    );
}

#[test]
fn limits_of_means() {
    let block = on(
        "t real | 1: 0 <= t | 2: t <= 1",
        "4: 0 < x + t | order\n3: finite 1/(x + t) | finite\n5: finite [t < 1] | finite",
    );
    let result = "9: lim(mean(1/(x + s), s ~ beta(p, q - p + 1)), p -> 1, q -> 1) == mean(1/(x + s), s ~ beta(1, 1 - 1 + 1)) | limit 3";
    yes(&format!("{block}{result}"));
    let negated = result.replace("q - p", "-(p - q)");
    let negated = negated.replace("1 - 1", "-(1 - 1)");
    yes(&format!("{block}{negated}"));
    no(
        &format!("{block}{}", result.replacen("1/(x", "p/(x", 1)),
        "what moves",
    );
    no(
        &format!("{block}{}", result.replace("p -> 1", "p -> y")),
        "positive",
    );
    no(
        &format!("{block}{}", result.replace("p -> 1", "p -> inf")),
        "finite",
    );
    no(
        &format!("{block}{}", result.replace("p -> 1", "p -> 0")),
        "positive",
    );
    no(
        &format!("{block}{}", result.replace("beta(1,", "beta(2,")),
        "another mean",
    );
    no(
        &format!("{block}{}", result.replace("1/(x + s)", "2/(x + s)")),
        "the premise should be",
    );
    no(
        &format!(
            "{block}{}",
            result
                .replace("1/(x + s)", "[s < 1]")
                .replace("limit 3", "limit 5")
        ),
        "continuous",
    );
    no(
        &format!("{block}{}", result.replacen("q - p + 1", "q/p", 1)),
        "no polynomial",
    );
    no(
        &format!(
            "{block}{}",
            result.replace("beta(p, q - p + 1)", "uniform(p, q + 1)")
        ),
        "over beta laws",
    );
    no(
        &format!(
            "{block}{}",
            result.replace("lim(mean(1/(x + s), s ~ beta(p, q - p + 1))", "lim(x")
        ),
        "limits of means",
    );
    no(&format!("{block}9: x == x | limit 3"), "for limits");
    let block = on(
        "t real | 1: 0 <= t | 2: t <= 1",
        "4: 0 < t + t + x | order\n3: finite 1/(t + t + x) | finite",
    );
    yes(&format!("{block}{}", result.replace("x + s", "s + s + x")));
    yes(&format!(
        "{block}{}",
        result.replace("x + s", "t + t + x").replace("s ~", "t ~")
    ));
    no(
        &format!("{block}{{ t real\n{}", result.replace("x + s", "t + s + x")),
        "in use",
    );
}

#[test]
fn function_parameters() {
    yes("9: int(f(s), s = 0..1) == 1 | function");
    yes("9: finite int(h(s), s = 0..1) | function");
    for (stated, reason) in [
        ("int(f(s), s = 0..2) == 1", "of such a function"),
        ("int(f(s), s = 0..1) == 2", "is 1, or finite"),
        ("int(f(s)^2, s = 0..1) == 1", "of such a function"),
        ("sum(f(s), s = 0..1) == 1", "of such a function"),
        ("x == 1", "the integral of a function"),
        ("int(h(s), s = 0..1) == 1", "of such a function"),
        ("finite int(f(s), s = 0..1)", "of such a function"),
        ("finite int(h(s), s = 0..2)", "of such a function"),
        ("finite int(h(s)^2, s = 0..1)", "of such a function"),
        ("finite sum(h(s), s = 0..1)", "of such a function"),
        ("finite x", "the integral of a function"),
        ("0 < x", "is 1, or finite"),
    ] {
        no(&format!("9: {stated} | function"), reason);
    }
}
