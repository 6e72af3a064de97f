//! The rule of derivatives, and what it rests on.

use super::super::{derive, is_entire};
use super::{accepts, rejects};
use crate::formula::parse_formula;
use crate::kernel::is_continuous;

const SCOPE: &str = "given int n\ngiven real c\ngiven real x\ngiven real y
    given fn f(t) continuous on 0..1\ndomain n >= 1\ndomain x > 0 and x < 1\ndomain cos(x) != 0
    draw X ~ uniform(0, 1)";
const GIVEN: &str = "1: 1 <= n | given\n2: 0 < x | given\n3: x < 1 | given\n4: cos(x) != 0 | given
    5: 0 <= n - 1 | order\n6: 0 < n | order | n - 1 + 1\n";

#[track_caller]
fn yes(steps: &str) {
    accepts(SCOPE, &format!("{GIVEN}{steps}"));
}

#[track_caller]
fn no(steps: &str, reason: &str) {
    rejects(SCOPE, &format!("{GIVEN}{steps}"), reason);
}

/// A block that shows two formulas to be finite.
fn finite(block: &str, e: &str, slope: &str) -> String {
    format!("{{ {block}\n11: finite {e} | finite\n12: finite {slope} | finite\n}}\n")
}

#[test]
fn derivatives_of_all_reals() {
    let square = finite("t real", "c*t^2", "c*(2*t^(2 - 1)*1)");
    yes(&format!(
        "{square}20: diff(c*x^2, x) == c*(2*x^(2 - 1)*1) | derivative 11 12"
    ));
    yes(&format!(
        "{square}20: diff(c*y^2, y) == c*(2*y^(2 - 1)*1) | derivative 11 12"
    ));
    for (stated, reason) in [
        ("diff(c*x^2, x) == c*(2*x) | derivative 11 12", "gives"),
        (
            "diff(c*x^2, x, 2) == c*(2*x^(2 - 1)*1) | derivative 11 12",
            "for the first",
        ),
        ("c*x^2 == c*(2*x^(2 - 1)*1) | derivative 11 12", "is for"),
        (
            "finite diff(c*x^2, x) | derivative 11 12",
            "concludes an equation",
        ),
        (
            "diff(c*x^2, x) == c*(2*x^(2 - 1)*1) | derivative 12 12",
            "the premise should be",
        ),
        (
            "diff(c*x^2, x) == c*(2*x^(2 - 1)*1) | derivative 11 11",
            "the premise should be",
        ),
        (
            "diff(c*x^2, x) == c*(2*x^(2 - 1)*1) | derivative 11",
            "missing",
        ),
        (
            "diff(c*x^3, x) == c*(3*x^(3 - 1)*1) | derivative 11 12",
            "the premise should be",
        ),
        ("diff(x!, x) == 1 | derivative 11 12", "without a rule"),
        (
            "diff(c*X^2, X) == c*(2*X^(2 - 1)*1) | derivative 11 12",
            "X is not known to be finite",
        ),
    ] {
        no(&format!("{square}20: {stated}"), reason);
    }
    let stated = "20: diff(c*x^2, x) == c*(2*x^(2 - 1)*1) | derivative 11 12";
    let integers = finite("t int", "c*t^2", "c*(2*t^(2 - 1)*1)");
    no(&format!("{integers}{stated}"), "one real variable");
    let two = finite("t real, s real", "c*t^2", "c*(2*t^(2 - 1)*1)");
    no(&format!("{two}{stated}"), "one real variable");
    let here = "11: finite c*x^2 | finite\n12: finite c*(2*x^(2 - 1)*1) | finite\n";
    no(&format!("{here}{stated}"), "one real variable");
    // The t of the formula is another than that of the premise.
    let other = finite("t real", "t*t", "1*t + t*1");
    let clash = "{ t real\n20: diff(t*x, x) == t*1 | derivative 11 12";
    no(&format!("{other}{clash}"), "in use");
}

#[test]
fn derivatives_of_what_is_finite_around_a_point() {
    let stated = "20: diff(1/x, x) == (0*x - 1*1)/x^2 | derivative 11 12";
    let of = |hypotheses: &str| {
        let block = format!("t real {hypotheses}");
        format!("{}{stated}", finite(&block, "1/t", "(0*t - 1*1)/t^2"))
    };
    yes(&of("| 7: 0 < t"));
    yes(&of(
        "| 7: 0 < t | 8: t < 1 | 9: x - 1 < t | 10: x*t < x*x + sin(t)*0 + 1",
    ));
    yes(&of("| 7: t != 0"));
    yes(&of("| 7: 0 < t | 8: x != 0"));
    no(&of("| 7: 0 < t | 8: t <= 1"), "at x alone");
    no(&of("| 7: 0 < t | 8: t == x"), "at x alone");
    no(&of("| 7: 0 < t | 8: finite 1/t"), "at x alone");
    no(&of("| 7: 0 < t | 8: x < t"), "positive");
    no(&of("| 7: 0 < t | 8: t != x"), "nonzero");
    no(&of("| 7: 0 < t | 8: t < y"), "positive");
    no(&of("| 7: 0 < t | 8: 1 < y"), "positive");
    no(&of("| 7: 0 < t | 8: sqrt(t) < 2"), "at x alone");
    no(&of("| 7: 0 < t | 8: -2 < sqrt(t)"), "at x alone");
    // Of the two premises the second supposes too much.
    let apart = format!(
        "{{ t real | 7: 0 < t\n11: finite 1/t | finite\n}}
        {{ t real | 8: x < t\n13: 0 < t | order | t - x + x\n12: finite (0*t - 1*1)/t^2 | finite\n}}
        {stated}"
    );
    no(&apart, "positive");
    let apart = apart.replace("8: x < t", "8: x - x < t");
    yes(&apart);
    let cosine = finite(
        "t real | 7: cos(t) != 0",
        "1/cos(t)",
        "(0*cos(t) - 1*(-sin(t)*1))/cos(t)^2",
    );
    yes(&format!(
        "{cosine}20: diff(1/cos(x), x) == (0*cos(x) - 1*(-sin(x)*1))/cos(x)^2 | derivative 11 12"
    ));
    no(
        &format!(
            "{cosine}20: diff(1/cos(y), y) == (0*cos(y) - 1*(-sin(y)*1))/cos(y)^2 | derivative 11 12"
        ),
        "nonzero",
    );
}

/// The root has no derivative at 0, and x^(3/2) no values on one side of it.
#[test]
fn derivatives_need_values_on_both_sides() {
    let block = "t real | 7: 0 <= t";
    let power = finite(block, "t^(3/2)", "3/2*t^(3/2 - 1)*1");
    let power = power.replace("11:", "10: 0 < 3/2 - 1 | order\n11:");
    no(
        &format!("{power}20: diff(x^(3/2), x) == 3/2*x^(3/2 - 1)*1 | derivative 11 12"),
        "at x alone",
    );
}

#[test]
fn derivatives_of_integrals_and_functions() {
    for (formula, derivative) in [
        ("int(f(s), s = 0..t)", "f(t)*1 - f(0)*0"),
        ("int(s*c, s = t..t^2)", "t^2*c*(2*t^(2 - 1)*1) - t*c*1"),
        ("int(sin(s*c), s = c..2)", "0"),
        ("exp(2*t)", "exp(2*t)*(2*1)"),
        ("sin(2*t)", "cos(2*t)*(2*1)"),
        ("cos(2*t)", "-sin(2*t)*(2*1)"),
        ("abs(t)", "abs(t)/t*1"),
    ] {
        let derived = derive(&parse_formula(formula).expect(formula), &"t".into());
        let derived = derived.map(|derived| derived.to_string());
        assert_eq!(derived.as_deref(), Ok(derivative), "of {formula}");
    }
    for refused in ["int([s < 1], s = 0..t)", "int(t*s, s = 0..1)", "mean(t*X)"] {
        let formula = parse_formula(refused).expect(refused);
        assert!(derive(&formula, &"t".into()).is_err(), "{refused}");
    }
}

#[test]
fn what_is_continuous() {
    let of = |text: &str| {
        let formula = parse_formula(text).expect(text);
        (
            is_continuous(&formula, &"t".into()),
            is_entire(&formula, &"t".into()),
        )
    };
    for text in [
        "1/y + ln(c) + [y < 1]",
        "t",
        "-t",
        "t + t",
        "t - 2*t",
        "exp(t) + sin(t)*cos(-t)",
    ] {
        assert_eq!(of(text), (true, true), "{text}");
    }
    for text in [
        "1/t",
        "t/t",
        "t^2",
        "2 + t^c",
        "t - 1/t",
        "1/t - t",
        "-1/t",
        "exp(1/t)",
        "ln(t)",
        "sqrt(t)",
        "abs(t)",
        "f(t)",
        "int(1/s, s = 1..t)",
        "int(1/s, s = t..t^2)",
    ] {
        assert_eq!(of(text), (true, false), "{text}");
    }
    for text in [
        "c^t",
        "[t < 1]",
        "gamma(t)",
        "int(s*t, s = 0..1)",
        "int(s, s = [t < 1]..2)",
        "int(s, s = 0..[t < 1])",
        "sum(s, s = 1..t)",
    ] {
        assert_eq!(of(text), (false, false), "{text}");
    }
}
