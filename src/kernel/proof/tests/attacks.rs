//! Attacks: proofs of something false, by holes that were found in the kernel and closed. Each has its
//! true twin beside it, so that it is refused for its fault alone.

use super::super::replay;
use super::{accepts, rejects};

/// A certificate that must be refused, for a reason with these words.
#[track_caller]
fn refused(text: &str, reason: &str) {
    match replay(text) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(flaw) => assert!(flaw.message.contains(reason), "refused, but: {flaw}"),
    }
}

/// At y = 0 the left side has no value: cancelling forgets poles in exponents too.
#[test]
fn an_exponent_with_a_pole() {
    let scope = "given real x\ngiven real y\ndomain 0 < x\ndomain y != 0";
    let pole = "given real x\ngiven real y\ndomain 0 < x";
    let given = "1: 0 < x | given\n2: y != 0 | given\n";
    accepts(scope, &format!("{given}3: x^(y/y) == x^0*x^1 | power"));
    for step in [
        "3: x^(y/y) == x^0*x^1 | power",
        "3: (x^2)^(y/y) == x^2 | power",
        "3: (x*2)^(y/y) == x^(y/y)*2^(y/y) | power",
        "3: 1^(y/y) == 1 | power",
        "3: gamma(y/y + 1) == 1*gamma(1) | gamma",
    ] {
        rejects(pole, &format!("1: 0 < x | given\n{step}"), "finite");
    }
}

/// Exponents beyond what a machine number holds came round to small ones.
#[test]
fn exponents_come_round() {
    let scope = "given real x\ndomain 0 < x";
    let given = "1: 0 < x | given\n";
    accepts(scope, &format!("{given}2: (x^8)^16*x == x^129 | ring"));
    for (step, reason) in [
        ("x^(-9223372036854775808) == 1", "too high"),
        ("x^9223372036854775808 == 1", "not equal"),
        ("x^(-9223372036854775807) == 1", "too high"),
        ("x^4294967296 == 1", "too high"),
        ("((((x^128)^128)^128)^128)^16*x == x", "too large"),
        ("1/((((x^128)^128)^128)^128)^16*x == x", "too large"),
        ("((((1/x)^128)^128)^128)^128 == 1/x", "too large"),
    ] {
        rejects(scope, &format!("{given}2: {step} | ring"), reason);
    }
}

/// Over a point every integral is 0, whatever its integrand is there: if `compute` and `congruence`
/// see it differently, everything follows.
#[test]
fn integrals_over_a_point() {
    let scope = "given real z";
    let point = "{ x real | 2: 0 <= x | 3: x <= 0
        4: x == 0 | order
        5: 1/x == 1/0 | none
        }
        6: int(1/x, x = 0..0) == int(1/0, x = 0..0) | congruence 5\n";
    accepts(
        scope,
        &format!("{point}7: int(1/0, x = 0..0) == 0 | compute"),
    );
    rejects(
        scope,
        &format!("{point}7: undefined int(1/0, x = 0..0) | compute"),
        "no such",
    );
    refused(
        "theorem
        given real z
        says z^2 == z
        example z = 1
        proof
        { x real | 2: 0 <= x | 3: x <= 0
        4: x == 0 | order
        5: 1/x == 1/0 | none
        }
        6: int(1/x, x = 0..0) == int(1/0, x = 0..0) | congruence 5
        7: int(1/x, x = 0..0) == 0 | compute
        8: undefined int(1/0, x = 0..0) | compute
        9: int(1/0, x = 0..0) == 1/0 | none
        10: 0 == 1/0 | chain 7 6 9
        11: z == z + 0 | ring
        12: z + 0 == z + 1/0 | congruence 10
        13: z + 1/0 == 1/0 | none
        14: z == 0 | chain 11 12 13 10
        15: z^2 == z | ring 14
        qed 15",
        "no such",
    );
}

/// A name may be used again by a later block. The range of a premise about the first y says nothing
/// of a range that ends at the second.
#[test]
fn a_name_that_two_blocks_use() {
    let scope = "given real z\ndomain 0 < z";
    let first = "{ y real | 1: 0 < y | 2: y < 2*y - 1
        3: 0 < y - 1 | order | 2*y - 1 - y
        4: ln(1 - y) == 1/0 | none
        }
        { y real | 10: 1/2 < y | 11: y < 1
        12: 0 < 2*y - 1 | order | 2*(y - 1/2)\n";
    rejects(
        scope,
        &format!(
            "{first}13: int(ln(1 - s), s = 0..2*y - 1) == int(1/0, s = 0..2*y - 1) | congruence 4"
        ),
        "differ",
    );
    let finite = "{ y real | 1: 0 <= y | 2: y <= 2*y - 1
        3: 0 < y - 1/2 | order | 2*y - 1 - y + 1/2
        4: finite 1/(y - 1/2) | finite
        }
        { y real | 10: 1/2 < y | 11: y < 1
        12: 0 < 2*y - 1 | order | 2*(y - 1/2)\n";
    rejects(
        scope,
        &format!("{finite}13: finite int(1/(s - 1/2), s = 0..2*y - 1) | continuous 4"),
        "supposes more",
    );
    // The same with another name for the second.
    let other = "{ y real | 1: 0 < y | 2: y < z
        4: y - y == 0 | ring
        }
        { x real | 10: 0 < x\n9: 0 < z | given\n";
    accepts(
        scope,
        &format!("{other}13: int(s - s, s = 0..z) == int(0, s = 0..z) | congruence 4"),
    );
}

/// A law is read where the mean stands, so a binder of a name in the law would reach it.
#[test]
fn laws_under_binders() {
    let scope = "given real k\ndomain 0 < k\ndraw x ~ uniform(0, k)";
    let hidden = "under a binder";
    for step in [
        "1: sum(mean(x), k = 1..2) == sum(mean(x), j = 1..2) | congruence",
        "1: int(mean(x), x = 0..1) == int(mean(s), s = 0..1) | congruence",
        "1: int(2*var(x), k = 0..1) == 2*int(var(x), k = 0..1) | scale",
        "1: at(prob(x < 1), k = 1) == at(prob(x < 1), k = 1) | chain",
        "1: lim(mean(x), k -> 1) == lim(mean(x), k -> 1) | chain",
        "1: diff(mean(x), k) == diff(mean(x), k) | chain",
        "1: sum(density(x, 0), k = 1..2) == sum(density(x, 0), j = 1..2) | congruence",
        "1: sum(cdf(x, 0), k = 1..2) == sum(cdf(x, 0), j = 1..2) | congruence",
        "1: mean(mean(x), k ~ uniform(0, 1)) == mean(mean(x), s ~ uniform(0, 1)) | congruence",
        "1: mean(mean(x)*x) == mean(mean(x)*x, x ~ uniform(0, k)) | draw",
        "{ | 1: sum(mean(x), k = 1..2) == 2*mean(x)",
    ] {
        rejects(scope, step, hidden);
    }
    accepts(
        scope,
        "1: mean(mean(x)*x) + k == mean(mean(x)*x) + k | chain",
    );
}

/// What no line declares, a block must not give a meaning to.
#[test]
fn names_that_nothing_declares() {
    let claim = |scope: &str| {
        format!(
            "theorem
            given real a
            {scope}says a == a
            example a = 1, f(x) = x
            proof
            1: a == a | chain
            qed 1"
        )
    };
    let function = "given fn f(x) continuous on 0..a\n";
    assert!(replay(&claim(function)).is_ok());
    refused(&claim(&function.replace("..a", "..s")), "does not declare");
    let also = |line: &str| claim(&format!("{function}{line}\n"));
    refused(&also("domain a < s"), "does not declare");
    refused(&also("draw x ~ uniform(0, s)"), "does not declare");
    refused(
        &also("domain a < x\ndraw x ~ uniform(0, 1)"),
        "does not declare",
    );
    refused(&also("given real a"), "does not give exactly");
    refused(&also("draw a ~ uniform(0, 1)"), "declared twice");
    assert!(replay(&also("draw x ~ any")).is_ok());
    refused(&also("draw x ~ order(1, 2) of any"), "not given");
}

/// O-terms, conditions and infinities where a number belongs.
#[test]
fn what_is_no_number() {
    let scope = "given real k\ndomain 0 < k";
    let given = "1: 0 < k | given\n";
    for (step, reason) in [
        ("k == k + O(k) | ring", "finite"),
        ("O(k) == O(2*k) | congruence", "differ"),
        ("k + 0*o(1) == k | ring", "finite"),
        ("(k < 1)*0 == 0 | ring", "finite"),
        ("(k < 1) == 1 | ring", "finite"),
        ("inf - inf == 0 | ring", "finite"),
        ("0*inf == 0 | ring", "finite"),
        ("inf == inf + 1 | ring", "finite"),
        ("k < inf | order", "finite"),
        ("finite inf | finite", "finite"),
        ("int(1, k) == k | ring", "finite"),
        ("diff(k^2, k) == 2*k | ring", "finite"),
        ("if(k < 1, 1, 1) == 1 | ring", "finite"),
        ("at(s, s = k) == k | ring", "finite"),
        ("min(k, k) == k | ring", "finite"),
        ("undefined [1/0 == 1] | none", "without value"),
        ("undefined if(k < 0, 1/0, 1) | none", "without value"),
        ("undefined sum(1/0, j = 1..0) | none", "without value"),
        ("undefined 0/k | none", "without value"),
        ("undefined 0^0 | none", "without value"),
    ] {
        rejects(scope, &format!("{given}2: {step}"), reason);
    }
    rejects(scope, "{ | 1: k < inf", "no number");
    rejects(scope, "{ | 1: k < 1/(k - k)", "division");
    rejects(scope, "{ | 1: k < O(k)", "no number");
    for says in [
        "1/0 == 1/0 + O(k)",
        "O(k) == O(k)",
        "(k < 1) == (k < 1)",
        "k*int(1, k) == k*int(1, k)",
    ] {
        let rule = if says.contains("1/0") {
            "none"
        } else {
            "chain"
        };
        let text = format!(
            "theorem\ngiven real k\nsays {says}\nexample k = 1\nproof\n1: {says} | {rule}\nqed 1"
        );
        refused(&text, "the example shows nothing");
    }
    let along = "theorem\ngiven real k\nsays k == 1 along k = 1\nexample k = 1\nproof\n{ | 1: k == 1\n}\nqed 1";
    refused(along, "no such link");
}

/// Nothing leaves a block but for what it supposes.
#[test]
fn blocks_keep_what_they_suppose() {
    let text = |lines: &str, end: &str| {
        format!(
            "theorem\ngiven real x\nsays x^2 == x\nexample x = 1\nproof\n{}\nqed {end}",
            lines.trim()
        )
    };
    let block = "{ | 1: x == 1\n2: x^2 == x | ring 1\n}\n";
    refused(&text(block, "2"), "outside of all blocks");
    refused(
        &text("{ | 1: x == 1\n2: x^2 == x | ring 1", "2"),
        "still open",
    );
    for (step, reason) in [
        ("3: x^2 == x | chain 2", "in its block only"),
        ("3: x^2 == x | ring 1", "in its block only"),
        ("3: x^2 == x | congruence 2", "differ"),
        ("3: x^2 == x | cases 2 2", "negation"),
        ("3: finite x^2 | finite 2", "in its block only"),
    ] {
        refused(&text(&format!("{block}{step}"), "3"), reason);
    }
    // A sibling does not see it either, though it supposes the same.
    let sibling = format!("{block}{{ | 3: x == 1\n4: x^2 == x | chain 2\n}}");
    refused(&text(&sibling, "4"), "in its block only");
}
