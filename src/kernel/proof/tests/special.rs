//! Gamma and its kin, powers, logarithms, order of powers.

use super::{accepts, rejects};

const REALS: &str = "given real a\ngiven real b\ngiven real p\ngiven int n\ngiven int k
    domain a > 0\ndomain b >= 0\ndomain 0 <= k\ndomain k <= n";
const GIVEN: &str = "1: 0 < a | given\n2: 0 <= b | given\n3: 0 <= k | given\n4: k <= n | given
    5: 0 <= n | order | n - k + k\n";

#[track_caller]
fn yes(step: &str) {
    accepts(REALS, &format!("{GIVEN}{step}"));
}

#[track_caller]
fn no(step: &str, reason: &str) {
    rejects(REALS, &format!("{GIVEN}{step}"), reason);
}

#[test]
fn gamma() {
    yes("9: gamma(a + 1) == a*gamma(a) | gamma");
    yes("9: gamma(1 + a) == a*gamma(a) | gamma");
    yes("9: gamma(5/2) == 3/2*gamma(3/2) | gamma");
    no(
        "9: gamma(a + 2) == a*gamma(a) | gamma",
        "not equal as rational functions",
    );
    yes("9: gamma(1/2) == -1/2*gamma(-1/2) | gamma");
    yes("9: gamma(-a + 1) == -a*gamma(-a) | gamma");
    no("9: gamma(b + 1) == b*gamma(b) | gamma", "nonzero");
    no("9: gamma(p + 1) == p*gamma(p) | gamma", "nonzero");
    no("9: gamma(1) == 0*gamma(0) | gamma", "nonzero");
    no(
        "9: gamma(a + 1) == (a + 0/p)*gamma(a + 0/p) | gamma",
        "finite",
    );
    no("9: gamma(3/2) == sqrt(pi) | gamma", "t*gamma(t)");
    no(
        "9: gamma(1/2) == sqrt(pi) | gamma",
        "the rule gives t*gamma(t)",
    );
    no(
        "9: gamma(a + 1) == a*gamma(a + 1) | gamma",
        "the rule gives",
    );
    no("9: gamma(a + 1) == a + gamma(a) | gamma", "t*gamma(t)");
    no(
        "9: lngamma(a + 1) == a*gamma(a) | gamma",
        "the rule is for gamma",
    );
    no(
        "9: gamma(a + 1) < a*gamma(a) | gamma",
        "concludes an equation",
    );
    no("9: gamma(a + 1 + 0/p) == a*gamma(a) | gamma", "finite");
}

#[test]
fn factorials() {
    yes("9: n! == gamma(n + 1) | factorial");
    yes("9: (n - k)! == gamma(n - k + 1) | factorial");
    no("9: n! == gamma(n) | factorial", "the rule gives");
    no("9: (n - 1)! == gamma(n - 1 + 1) | factorial", "nonnegative");
    no("9: a! == gamma(a + 1) | factorial", "an integer");
    no("9: gamma(n) == gamma(n) | factorial", "factorials");
}

#[test]
fn beta_binomial_pochhammer() {
    yes("9: beta(a, 2) == gamma(a)*gamma(2)/gamma(a + 2) | beta");
    no(
        "9: beta(a, b) == gamma(a)*gamma(b)/gamma(a + b) | beta",
        "b is not known to be positive",
    );
    no(
        "9: beta(b, a) == gamma(b)*gamma(a)/gamma(b + a) | beta",
        "b is not known to be positive",
    );
    no(
        "9: beta(a, 2) == gamma(a)*gamma(2)/gamma(a + 1) | beta",
        "the rule gives",
    );
    no("9: gamma(a) == gamma(a) | beta", "beta function");
    yes("9: binomial(n, k) == n!/(k!*(n - k)!) | binomial");
    no(
        "9: binomial(k, n) == k!/(n!*(k - n)!) | binomial",
        "nonnegative",
    );
    no(
        "9: binomial(n, k - 1) == n!/((k - 1)!*(n - (k - 1))!) | binomial",
        "nonnegative",
    );
    no(
        "9: binomial(a, k) == a!/(k!*(a - k)!) | binomial",
        "an integer",
    );
    no(
        "9: binomial(n, k) == n!/((n - k)!*k!) | binomial",
        "the rule gives",
    );
    no("9: n! == n! | binomial", "binomials");
    yes("9: pochhammer(a, n) == gamma(a + n)/gamma(a) | pochhammer");
    no(
        "9: pochhammer(b, n) == gamma(b + n)/gamma(b) | pochhammer",
        "positive",
    );
    no(
        "9: pochhammer(a, n - 1) == gamma(a + (n - 1))/gamma(a) | pochhammer",
        "nonnegative",
    );
    no(
        "9: pochhammer(a, a) == gamma(a + a)/gamma(a) | pochhammer",
        "an integer",
    );
    no(
        "9: pochhammer(a, n) == gamma(a + n) | pochhammer",
        "the rule gives",
    );
    no("9: n! == n! | pochhammer", "Pochhammer");
}

#[test]
fn logarithms() {
    yes("9: ln(a*2) == ln(a) + ln(2) | logarithm");
    yes("9: ln(a/3) == ln(a) - ln(3) | logarithm");
    yes("9: ln(a^p) == p*ln(a) | logarithm");
    yes("9: ln(sqrt(a)) == ln(a)/2 | logarithm");
    yes("9: ln(exp(-b)) == -b | logarithm");
    no("9: ln(exp(b)) == a | logarithm", "the rule gives b");
    no("9: ln(exp(1/b)) == 1/b | logarithm", "1/b is not known");
    no(
        "9: ln(a*b) == ln(a) + ln(b) | logarithm",
        "b is not known to be positive",
    );
    no(
        "9: ln(b*a) == ln(b) + ln(a) | logarithm",
        "b is not known to be positive",
    );
    no(
        "9: ln(a/b) == ln(a) - ln(b) | logarithm",
        "b is not known to be positive",
    );
    no(
        "9: ln(b/a) == ln(b) - ln(a) | logarithm",
        "b is not known to be positive",
    );
    no("9: ln(b^2) == 2*ln(b) | logarithm", "positive");
    no(
        "9: ln(a^(1/b)) == 1/b*ln(a) | logarithm",
        "1/b is not known to be finite",
    );
    no("9: ln(sqrt(b)) == ln(b)/2 | logarithm", "positive");
    no("9: ln(a*2) == ln(a) - ln(2) | logarithm", "the rule gives");
    no(
        "9: ln(a + 2) == ln(a) + ln(2) | logarithm",
        "a product, a quotient",
    );
}

#[test]
fn powers_are_split() {
    yes("9: a^(p + b) == a^p*a^b | power");
    yes("9: b^(n + k) == b^n*b^k | power");
    yes("9: p^(n + k) == p^n*p^k | power");
    yes("9: b^(1/2 + a) == b^(1/2)*b^a | power");
    no(
        "9: a^(p + b) == a^p*a^p | power",
        "not equal as rational functions",
    );
    no("9: p^(n + 1/2) == p^n*p^(1/2) | power", "an integer");
    no(
        "9: p^0 == p^n*p^(-n) | power",
        "p is not known to be nonzero",
    );
    no("9: b^p == b^(1/2)*b^(p - 1/2) | power", "an integer");
    no("9: a^(p + b) == a^p*b^b | power", "the same base");
    no("9: a^(p - b) == a^p/a^b | power", "a product of powers");
    no("9: a^p == a^p*p | power", "no law of powers");
    no("9: a + p == a^p*p | power", "powers and square roots");
}

#[test]
fn powers_of_powers_and_of_products() {
    yes("9: (a^p)^b == a^(p*b) | power");
    yes("9: (p^n)^k == p^(n*k) | power");
    yes("9: (b^(1/2))^2 == b^1 | power");
    no(
        "9: (a^p)^b == a^(p + b) | power",
        "not equal as rational functions",
    );
    no("9: (p^2)^(1/2) == p^1 | power", "an integer");
    no("9: (a^p)^b == b^(p*b) | power", "no law of powers");
    yes("9: (a*2)^p == a^p*2^p | power");
    yes("9: (p*b)^n == p^n*b^n | power");
    yes("9: (b*a)^(1/3) == b^(1/3)*a^(1/3) | power");
    yes("9: (p/a)^n == p^n/a^n | power");
    no("9: (p*b)^(-1) == p^(-1)*b^(-1) | power", "nonzero");
    no(
        "9: (a/b)^n == a^n/b^n | power",
        "b is not known to be nonzero",
    );
    no("9: (a/2)^p == a^p*2^p | power", "");
    no("9: (a*2)^p == a^p*2^b | power", "");
    no("9: (p*a)^(1/2) == p^(1/2)*a^(1/2) | power", "an integer");
    no("9: (a + 2)^p == a^p + 2^p | power", "no law of powers");
}

#[test]
fn roots_and_powers_of_0_and_1() {
    yes("9: sqrt(b) == b^(1/2) | power");
    no("9: sqrt(p) == p^(1/2) | power", "nonnegative");
    no("9: sqrt(b) == b^(1/3) | power", "the rule gives");
    yes("9: (a - a)^(n + 1) == 0 | power");
    yes("9: 1^p == 1 | power");
    yes("9: (2 - 1)^p == 1 | power");
    no("9: (a - a)^n == 0 | power", "positive");
    no("9: 0^(n + 1) == 1 | power", "the rule gives 0");
    no("9: 1^p == 0 | power", "the rule gives 1");
    no("9: 1^(1/b) == 1 | power", "finite");
    no("9: a^p == 1 | power", "neither 0 nor 1");
    no("9: (p/p)^n == 1 | power", "neither 0 nor 1");
}

#[test]
fn the_order_of_powers() {
    yes("9: b^a <= (b + 1)^a | power-order");
    yes("9: b^a < (b + 1)^a | power-order");
    yes("9: b^2 <= b^2 | power-order");
    no("9: b^2 < b^2 | power-order", "positive");
    no(
        "9: p^2 < (p + 1)^2 | power-order",
        "p is not known to be nonnegative",
    );
    no(
        "9: b^n < (b + 1)^n | power-order",
        "n is not known to be positive",
    );
    no("9: b^2 < (b + 1)^3 | power-order", "the same");
    no("9: (b + 1)^2 <= b^2 | power-order", "nonnegative");
    no("9: b^2 == b^2 | power-order", "an order");
    no("9: b <= b + 1 | power-order", "two powers");
}

#[test]
fn the_circle() {
    yes("9: cos(p)^2 == 1 - sin(p)^2 | circle");
    yes("9: cos(1/a)^2 == 1 - sin(1/a)^2 | circle");
    no("9: cos(1/p)^2 == 1 - sin(1/p)^2 | circle", "finite");
    no("9: cos(p)^2 == 1 - sin(a)^2 | circle", "the rule gives");
    no("9: cos(p)^3 == 1 - sin(p)^2 | circle", "for a square");
    no("9: sin(p)^2 == 1 - sin(p)^2 | circle", "for cos");
    no("9: 2*cos(p) == 1 - sin(p)^2 | circle", "for a square");
    no("9: cos(p)^2 <= 1 - sin(p)^2 | circle", "an equation");
}

#[test]
fn constants() {
    yes("9: gamma(1/2) == sqrt(pi) | constant");
    yes("9: cos(pi) == -1 | constant");
    no("9: cos(pi) == 1 | constant", "no such");
    no("9: gamma(1/2) == pi | constant", "no such");
    no("9: sin(pi) == 0 | constant", "no such");
}

#[test]
fn the_least_and_the_greatest() {
    yes("9: min(0, a) == 0 | extreme");
    yes("9: max(0, a) == a | extreme");
    yes("9: min(b + 1, 0, b) == 0 | extreme");
    yes("9: max(b, b + 1, 0) == b + 1 | extreme");
    no("9: min(0, a) == a | extreme", "nonnegative");
    no("9: max(0, a) == 0 | extreme", "nonnegative");
    no("9: min(0, p) == 0 | extreme", "nonnegative");
    no("9: max(b, p, 0) == b | extreme", "nonnegative");
    no("9: min(a, b + 1) == 0 | extreme", "none of the arguments");
    no("9: min(0, 1/p) == 0 | extreme", "finite");
    no("9: abs(a) == a | extreme", "min and max");
}
