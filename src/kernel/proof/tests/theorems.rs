//! Whole proofs, of the kinds that the book has.

use super::super::replay;

fn proves(text: &str) {
    if let Err(flaw) = replay(text) {
        panic!(
            "{flaw}: {}",
            text.lines()
                .nth(flaw.line.wrapping_sub(1))
                .unwrap_or_default()
        );
    }
}

#[test]
fn a_shift_of_gamma() {
    proves(
        "theorem
        given int k
        domain k >= 2
        says k*gamma(k - 1)/gamma(k) == k/(k - 1)
        example k = 2
        proof
        1: 2 <= k | given
        2: 0 < k - 1 | order | k - 2 + 1
        3: 0 < k | order | k - 2 + 2
        4: gamma(k) == (k - 1)*gamma(k - 1) | gamma
        5: k*gamma(k - 1)/gamma(k) == k/(k - 1) | ring 4
        qed 5",
    );
}

#[test]
fn an_integral_by_its_primitive() {
    proves(
        "theorem
        given real r
        domain 0 <= r
        says int(2*s, s = 0..r) == r^2
        example r = 1/2
        proof
        1: 0 <= r | given
        { s real | 2: 0 <= s | 3: s <= r
          4: finite s^2 | finite
          5: finite 2*s | finite
          6: 2*s^(2 - 1)*1 == 2*s | ring
        }
        7: int(2*s, s = 0..r) == r^2 - 0^2 | primitive 4 6 5 | s^2
        8: r^2 - 0^2 == r^2 | ring
        9: int(2*s, s = 0..r) == r^2 | chain 7 8
        qed 9",
    );
}

#[test]
fn a_mean_over_a_beta_law() {
    proves(
        "theorem
        given int k
        given int n
        domain k >= 2
        domain k <= n
        draw x ~ beta(k, n - k + 1)
        says mean(1/x) == n/(k - 1)
        example k = 2, n = 3
        proof
        1: 2 <= k | given
        2: k <= n | given
        3: 0 < k - 1 | order | k - 2 + 1
        4: 0 < k | order | k - 2 + 2
        5: 0 < n - k + 1 | order | n - k + 1
        6: mean(1/x) == mean(1/x, x ~ beta(k, n - k + 1)) | draw
        7: mean(1/x, x ~ beta(k, n - k + 1)) == int(x^(k - 1)*(1 - x)^(n - k + 1 - 1)/beta(k, n - k + 1)*(1/x), x = 0..1) | density
        { y real | 8: 0 < y | 9: y < 1
          10: y^(k - 1) == y^(k - 1 - 1)*y^1 | power
          11: y^(k - 1)*(1 - y)^(n - k + 1 - 1)/beta(k, n - k + 1)*(1/y) == 1/beta(k, n - k + 1)*(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1)) | ring 10
        }
        12: int(x^(k - 1)*(1 - x)^(n - k + 1 - 1)/beta(k, n - k + 1)*(1/x), x = 0..1) == int(1/beta(k, n - k + 1)*(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1)), y = 0..1) | congruence 11
        13: int(1/beta(k, n - k + 1)*(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1)), y = 0..1) == 1/beta(k, n - k + 1)*int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) | scale
        14: beta(k - 1, n - k + 1) == int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) | beta-integral
        15: finite int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) | finite 14
        16: int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) == beta(k - 1, n - k + 1) | chain 14
        17: 0 < n | order | n - k + (k - 2) + 2
        18: 0 < k + (n - k + 1) | order | n + 1
        19: 0 < k - 1 + (n - k + 1) | order | n
        20: beta(k, n - k + 1) == gamma(k)*gamma(n - k + 1)/gamma(k + (n - k + 1)) | beta
        21: beta(k - 1, n - k + 1) == gamma(k - 1)*gamma(n - k + 1)/gamma(k - 1 + (n - k + 1)) | beta
        22: gamma(k) == (k - 1)*gamma(k - 1) | gamma
        23: gamma(n + 1) == n*gamma(n) | gamma
        24: 1/beta(k, n - k + 1)*int(y^(k - 1 - 1)*(1 - y)^(n - k + 1 - 1), y = 0..1) == n/(k - 1) | ring 16 20 21 22 23
        25: mean(1/x) == n/(k - 1) | chain 6 7 12 13 24
        qed 25",
    );
}
