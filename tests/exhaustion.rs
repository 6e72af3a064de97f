//! Certificates that ask for more work or room than there is: each ends soon, with a line of its text.

use claimcheck::kernel::proof::replay;

#[track_caller]
fn refused(text: &str, reason: &str) {
    let flaw = replay(text).expect_err("no certificate");
    assert!(flaw.message.contains(reason), "{flaw}");
    assert!(flaw.line > 0 || text.len() > 4 << 20, "{flaw}");
}

/// A theorem about three reals, two of them positive, with these steps.
fn claim(lines: &str) -> String {
    format!(
        "theorem\ngiven real x\ngiven real y\ngiven real z\ndomain 0 < x\ndomain 0 < y\nsays x == x\n\
         example x = 1, y = 1, z = 1\nproof\n1: 0 < x | given\n2: 0 < y | given\n{lines}\nqed 1"
    )
}

/// Work that no machine does: the store of work or a cap ends it, with a line of the text.
#[test]
fn endless_normal_forms() {
    let power = |base: &str, n: usize| format!("{base}^{n}");
    let sum = "(x + y + z + 1)";
    for (left, reason) in [
        (power("x", 1_000_000_000), "too high"),
        ("x^(10^10)".to_string(), "too high"),
        ("x^(10^10^10)".to_string(), "too high"),
        ("2^(2^(2^100))".to_string(), "not equal"),
        (power(sum, 200), "too many terms"),
        (power("(x + 1)", 200) + "*(y + 1)^200", "too"),
        (format!("(((({sum}^9)^9)^9)^9)^9"), "too many terms"),
        (
            power(&format!("1/({sum}^3 + 1)"), 150) + "+ 1/(x + 3)",
            "finite",
        ),
        ("((7^199)^199)^199*x".to_string(), "too large"),
    ] {
        refused(&claim(&format!("3: {left} == z | ring")), reason);
    }
}

/// Each equation doubles what the one before it puts in.
#[test]
fn equations_that_double() {
    let mut block = "{ x0 real".to_string();
    (1..30).for_each(|i| block += &format!(", x{i} real"));
    (1..30).for_each(|i| block += &format!(" | a{i}: x{} == x{i}*x{i} + x{i}/x{i}", i - 1));
    let premises: String = (1..30).map(|i| format!(" a{i}")).collect();
    refused(
        &claim(&format!("{block}\n3: x0 == 1 | ring{premises}\n}}")),
        "finite",
    );
    let block = block.replace("/x", "*x");
    refused(
        &claim(&format!("{block}\n3: x0 == 1 | ring{premises}\n}}")),
        "too",
    );
    let linear = block.replace('*', "+");
    refused(
        &claim(&format!("{linear}\n3: x0 == 1 | ring{premises}\n}}")),
        "too much work",
    );
}

/// Thousands of steps that are small enough one by one.
#[test]
fn thousands_of_large_steps() {
    let lines: Vec<String> = (3..6_000)
        .map(|i| format!("{i}: 0 < x + y + (x - y)^2 + {i} | order"))
        .collect();
    refused(&claim(&lines.join("\n")), "too much work");
}

#[test]
fn deep_nesting() {
    let nested = |open: &str, close: &str, n: usize| open.repeat(n) + "x" + &close.repeat(n);
    for open in [
        "sqrt(1 + ",
        "-(",
        "ln(1 + ",
        "gamma(1 + ",
        "(x*",
        "1/(1 + ",
        "(1 + x)^(",
        "y^-(",
    ] {
        let deep = nested(open, ")", 190);
        for rule in [
            "ring",
            "order",
            "chain",
            "none",
            "congruence",
            "power",
            "gamma",
            "logarithm",
        ] {
            assert!(replay(&claim(&format!("3: {deep} == 1 + {deep}*2 | {rule}"))).is_err());
        }
        assert!(replay(&claim(&format!("3: 0 < {deep} - {deep} | order"))).is_err());
        assert!(replay(&claim(&format!("3: undefined {deep} | none"))).is_err());
        let steps = format!("3: int({deep}, x = 0..1) == 1 | primitive 1 1 1 | {deep}");
        assert!(replay(&claim(&steps)).is_err());
        let deeper = nested(open, ")", 5_000);
        refused(&claim(&format!("3: {deeper} == 1 | ring")), "deep");
    }
    let long = " + x".repeat(900);
    refused(&claim(&format!("3: x{long} == x | ring")), "not equal");
    refused(
        &claim(&format!("3: x{} == x | ring", long.repeat(9))),
        "deep",
    );
    let integrals = "int(".repeat(150) + "x" + &", x = 0..x)".repeat(150);
    refused(
        &claim(&format!("3: {integrals} == 2*{integrals} | congruence")),
        "",
    );
    let sums = "sum(".repeat(100) + "j" + &", j = 1..3)".repeat(100);
    refused(&claim(&format!("3: {sums} == 2 | compute")), "not found");
    refused(&claim("{\n".repeat(9_000).trim_end()), "too deep");
    refused(&claim(&"{\n}\n".repeat(200_000)), "");
}

#[test]
fn values_too_large() {
    for large in [
        "2^2^100",
        "10^10^10",
        "(10^9)!",
        "1000000!",
        "(2^(-2^60))!",
        "binomial(10^9, 10^8)",
        "binomial(1/3, 10^9)",
        "pochhammer(1/3, 10^9)",
        "pochhammer(10^9, 10^7)",
        "gamma(10^9)",
        "gamma(10^9 + 1/2)",
        "beta(10^9, 10^9)",
        "lngamma(10^12)",
        "exp(10^9)",
        "sin(10^1000)",
        "hyp2f1(1/3, 10^9; 1/2; 1/2)",
        "hyp2f1(-10^9, 2; 3; 1/2)",
        "hyp2f1(1/2, 1/2; 1; 1 - 1/10^9)",
        "sum(j^j, j = 1..10^9)",
        "sum(1/j, j = 1..10^5)",
        "sup(j^2, j = 1..10^9)",
        "int((x + 1)^100000, x = 0..1)",
        "int((x + 1)^3000/(x + 2)^3000, x = 0..1)",
        "int(1/(x^40 + x + 1), x = 0..1)",
        "mean(x^2, x ~ beta(10^6, 10^6))",
        "mean(x, x ~ order(5000, 10000) of uniform(0, 1))",
        "at(diff(x^x^x, x, 1000), x = 1)",
        "at(diff(1/(1 + x^2), x, 500), x = 1)",
    ] {
        refused(&claim(&format!("3: {large} == 0 | compute")), "");
    }
    let many: Vec<String> = (3..4_000)
        .map(|i| format!("{i}: sum(j, j = 0..9999) == 49995000 | compute"))
        .collect();
    refused(&claim(&many.join("\n")), "");
    for says in [
        "k! == k!",
        "2^2^k == 2^2^k",
        "sum(j!, j = 1..k) == sum(j!, j = 1..k)",
    ] {
        let text = format!(
            "theorem\ngiven int k\nsays {says}\nexample k = 1000000000\nproof\n1: {says} | chain\nqed 1"
        );
        refused(&text, "the example shows nothing");
    }
}

#[test]
fn megabytes_of_text() {
    let many = |line: &str| line.repeat((4 << 20) / line.len() - 100);
    refused(&claim(&many("{\n}\n").repeat(2)), "too long");
    refused(&claim(&many("1: 0 == 0 | chain\n")), "in use");
    refused(
        &claim(&format!("3: x == x | chain{}", many(" 1"))),
        "too large",
    );
    refused(
        &claim(&format!("3: x == x | chain{}", many(" | x"))),
        "too large",
    );
    refused(
        &claim(&format!("3: x == x*f({} x) | chain", many("x, "))),
        "",
    );
    refused(
        &claim(&format!("3: x == {} | chain", "9".repeat(1 << 20))),
        "digits",
    );
    refused(&claim(&format!("{{ {} y9 real", many("y8 real, "))), "");
    refused(&claim(&format!("{{ {}", many("| 3: 0 < x"))), "in use");
    refused(&claim(&many("{ | ")), "");
    let numbered = |line: &dyn Fn(usize) -> String| (3..60_000).map(line).collect::<String>();
    let steps = |line: &dyn Fn(usize) -> String| claim(numbered(line).trim_end());
    refused(&steps(&|i| format!("{i}: x == x | chain\n")), "");
    refused(
        &steps(&|i| format!("{i}: finite int({i}, s = 0..1) | continuous\n")),
        "missing",
    );
    let wide = |line: &str| {
        format!("theorem\n{line}says 0 == 0\nexample\nproof\n1: 0 == 0 | chain\nqed 1")
    };
    refused(&wide(&many("domain 0 < 1\n")), "too large");
    refused(
        &wide(&numbered(&|i| format!("given real x{i}\n"))),
        "too large",
    );
    refused(&wide(&many("given real x\n")), "too large");
    refused(
        &wide(&numbered(&|i| format!("draw x{i} ~ uniform(0, 1)\n"))),
        "too large",
    );
    let one = "theorem\nsays 0 == 0\nexample\nproof\n1: 0 == 0 | chain\nqed 1\n";
    assert!(replay(&one.repeat(16)).is_ok());
    refused(&one.repeat(10_000), "too many certificates");
}
