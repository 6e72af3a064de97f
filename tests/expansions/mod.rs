//! Expansions with what was worked out about them by hand.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    Holds,
    Fails,
    Vacuous,
    /// True, and known to be beyond the prover.
    OpenTrue,
    /// False, and known to be beyond the prover.
    OpenFalse,
    /// Not to be judged: its meaning is open, or it has no value somewhere.
    Open,
}

use Truth::{Fails, Holds, Open, OpenFalse, OpenTrue, Vacuous};

pub struct Case {
    pub scope: &'static str,
    pub says: &'static str,
    pub truth: Truth,
    /// Values at which a true statement is tried.
    pub values: &'static str,
    /// Values that move with the variable.
    pub path: &'static str,
}

impl Case {
    pub fn text(&self) -> String {
        match self.scope {
            "" => format!("says {}", self.says),
            scope => format!("{scope}\nsays {}", self.says),
        }
    }
}

const PHOTONS: &str = "given int k, n with 1 <= k <= n; real I > 0\ndraw r ~ beta(k, n-k+1)";
const SHELLS: &str = "given int k, n with 1 <= k <= n; real I > 0\ndraw r ~ uniform((k-1)/n, k/n)";
const SHELL: &str =
    "given int k, l, m with 1 <= l <= m and l < k; real v > 0, I > 0\ndraw x ~ beta(l, m-l+1)";
const K: &str = "given real k with k >= 1";
const X: &str = "given real x with 0 < x < 1";
const REAL: &str = "given real x";
const A: &str = "given real k, a with k >= 1 and a > 0";
const ANY: &str = "given real k, a with k >= 1";
const TWO: &str = "given real k, n with 1 <= k <= n";
const FREE: &str = "given real k, n with k >= 1 and n >= 1";

type Row = (Truth, &'static str, &'static str, &'static str);

/// The second chapter.
const THESIS: &[(&str, Row)] = &[
    (
        PHOTONS,
        (
            Fails,
            "mean(I*k/(n*r)) == I + I/k + O(1/k^3) as k -> inf uniformly in n",
            "",
            "",
        ),
    ),
    (
        PHOTONS,
        (
            Holds,
            "mean(I*k/(n*r)) == I + I/k + O(1/k^2) as k -> inf uniformly in n",
            "I = 3",
            "n = 2*k",
        ),
    ),
    (
        PHOTONS,
        (
            Fails,
            "var(I*k/(n*r)) == I^2/k - I^2/n + O(1/(n*k)) as n, k -> inf",
            "",
            "",
        ),
    ),
    (
        PHOTONS,
        (
            Holds,
            "var(I*k/(n*r)) == I^2/k - I^2/n + O(1/k^2) as n, k -> inf",
            "I = 2",
            "n = 3*k",
        ),
    ),
    (
        PHOTONS,
        (
            Holds,
            "var(I*k/(n*r)) ~ I^2/k as n, k, n/k -> inf",
            "I = 2",
            "n = k^2",
        ),
    ),
    (
        PHOTONS,
        (Fails, "var(I*k/(n*r)) ~ I^2/k as n, k -> inf", "", ""),
    ),
    (
        PHOTONS,
        (
            Holds,
            "I*(k/(k-1)) =~ I + I/k as k -> inf uniformly in n",
            "I = 2",
            "n = k",
        ),
    ),
    (
        PHOTONS,
        (
            Fails,
            "var(I*k/(n*r)) =~ I^2/k as k -> inf uniformly in n",
            "",
            "",
        ),
    ),
    (
        PHOTONS,
        (Fails, "var(I*k/(n*r)) =~ I^2/k as n -> inf", "", ""),
    ),
    (
        PHOTONS,
        (
            Holds,
            "var(I*k/(n*r)) =~ I^2/k as n, k, n/k -> inf",
            "I = 2",
            "n = k^2",
        ),
    ),
    (
        SHELLS,
        (
            Holds,
            "mean(I*k/(n*r)) == I + I/(2*k) + I/(3*k^2) + O((1/k)^3) as k -> inf uniformly in n",
            "I = 1",
            "n = k",
        ),
    ),
    (
        SHELLS,
        (
            Fails,
            "mean(I*k/(n*r)) == I + I/(2*k) + I/(3*k^2) + O((1/k)^4) as k -> inf uniformly in n",
            "",
            "",
        ),
    ),
    (
        SHELLS,
        (
            Fails,
            "mean(I*k/(n*r)) == I + I/(3*k) + I/(3*k^2) + O((1/k)^3) as k -> inf uniformly in n",
            "",
            "",
        ),
    ),
    (
        SHELLS,
        (
            Holds,
            "var(I*k/(n*r)) == I^2/(12*k^2) + O((1/k)^3) as k -> inf uniformly in n",
            "I = 1",
            "n = k",
        ),
    ),
    (
        SHELLS,
        (
            Fails,
            "var(I*k/(n*r)) == I^2/(11*k^2) + O((1/k)^3) as k -> inf uniformly in n",
            "",
            "",
        ),
    ),
    (
        SHELLS,
        (Vacuous, "mean(I*k/(n*r)) == I + O(1/k) as k -> inf", "", ""),
    ),
    (
        SHELL,
        (
            Holds,
            "mean(I*k/(k - l + v*x)) == I + I*(l - l*v/(m+1))/k + I*(-(2*l^2)*v/(m+1) + l^2 + l*(l+1)*v^2/((m+1)*(m+2)))/k^2 + O((1/k)^3) as k -> inf",
            "I = 1, l = 2, m = 3, v = 5",
            "",
        ),
    ),
    (
        SHELL,
        (
            Fails,
            "mean(I*k/(k - l + v*x)) == I + I*(l - l*v/(m+1))/k + I*(-(2*l^2)*v/(m+1) + l^2 - l*(l+1)*v^2/((m+1)*(m+2)))/k^2 + O((1/k)^3) as k -> inf",
            "",
            "",
        ),
    ),
    (
        SHELL,
        (
            Holds,
            "var(I*k/(k - l + v*x)) == I^2*l*v^2*(-l+m+1)/(k^2*(m+1)^2*(m+2)) - 4*(I^2*l*v^2*(l-m-1)*(l*(m-v+3)-v))/(k^3*((m+1)^2*(m+2)*(m+3))) + O((1/k)^4) as k -> inf",
            "I = 1, l = 2, m = 3, v = 5",
            "",
        ),
    ),
    (
        SHELL,
        (
            Fails,
            "var(I*k/(k - l + v*x)) == I^2*l*v^2*(-l+m+1)/(k^2*(m+1)^2*(m+2)) - 3*(I^2*l*v^2*(l-m-1)*(l*(m-v+3)-v))/(k^3*((m+1)^2*(m+2)*(m+3))) + O((1/k)^4) as k -> inf",
            "",
            "",
        ),
    ),
    (
        SHELL,
        (
            Fails,
            "mean(I*k/(k - l + v*x)) == I + I*(l - l*v/(m+1))/k + I*(-(2*l^2)*v/(m+1) + l^2 + l*(l+1)*v^2/((m+1)*(m+2)))/k^2 + O((1/k)^3) as k -> inf along k = m*(m-1)/2 + l, v = m",
            "",
            "",
        ),
    ),
];

/// Logarithms: of the variable, of others, nested, in parameters.
const LOGARITHMS: &[(&str, Row)] = &[
    (K, (Fails, "ln(k)/k == O(1/k) as k -> inf", "", "")),
    (K, (Holds, "ln(k)/k == o(1) as k -> inf", "", "")),
    (
        K,
        (
            Holds,
            "ln(k+1) - ln(k) == 1/k + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (K, (Fails, "ln(k+1)/k == O(1/k) as k -> inf", "", "")),
    (
        K,
        (
            Fails,
            "ln(k + ln(k+1)) - ln(k) == O(1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (Fails, "ln(k + ln(k)) - ln(k) == O(1/k) as k -> inf", "", ""),
    ),
    (
        K,
        (Holds, "ln(k + ln(k+1)) - ln(k) == o(1) as k -> inf", "", ""),
    ),
    (
        K,
        (
            OpenFalse,
            "(1 + 1/k)^ln(k+1) == 1 + O(1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            OpenFalse,
            "(1 + 1/k)^ln(k) == 1 + O(1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            OpenFalse,
            "hyp2f1(ln(k+1), 1; 1; 1/k) == 1 + O(1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (K, (OpenFalse, "ln(1 + ln(k)) == O(1) as k -> inf", "", "")),
    (K, (OpenTrue, "1/ln(k+2) == O(1) as k -> inf", "", "")),
    (K, (OpenTrue, "1/ln(k+2) == o(1) as k -> inf", "", "")),
    (
        K,
        (
            Holds,
            "k*ln(1 + 1/k) == 1 - 1/(2*k) + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (K, (Holds, "1/k ~ ln(1 + 1/k) as k -> inf", "", "")),
    (K, (Fails, "2/k ~ ln(1 + 1/k) as k -> inf", "", "")),
    (
        A,
        (
            Holds,
            "ln(a*k + 1) - ln(k) - ln(a) == O(1/k) as k -> inf",
            "a = 2",
            "",
        ),
    ),
    (
        ANY,
        (
            Open,
            "ln(a*k + 1) - ln(k) - ln(a) == O(1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        A,
        (
            OpenFalse,
            "ln(a*k + 1) - ln(k) - ln(a) == O(1/k) as k -> inf uniformly in a",
            "",
            "a = 1/k",
        ),
    ),
    (X, (Holds, "x*ln(x) == o(1) as x -> 0+", "", "")),
    (X, (Fails, "x*ln(x) == O(x) as x -> 0+", "", "")),
    (X, (Fails, "x*ln(x)^2 == O(x) as x -> 0+", "", "")),
    (X, (Holds, "x*ln(x)^2 == O(x^(1/1)*1/x) as x -> 0+", "", "")),
];

/// Values that may not exist, or not for every parameter.
const OBLIGATIONS: &[(&str, Row)] = &[
    (ANY, (Open, "1/(a*k + 1) == O(1/k) as k -> inf", "", "")),
    (
        A,
        (Holds, "1/(a*k + 1) == O(1/k) as k -> inf", "a = 1/7", ""),
    ),
    (
        A,
        (
            OpenFalse,
            "1/(a*k + 1) == O(1/k) as k -> inf uniformly in a",
            "",
            "a = 1/k",
        ),
    ),
    (
        ANY,
        (
            Open,
            "(a-3)/((a-3)*k) == 1/k + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (ANY, (Open, "k + 1 ~ k + a*ln(a) as k -> inf", "", "")),
    (ANY, (Fails, "1/k ~ a/k as k -> inf", "", "")),
    (A, (Fails, "1/k ~ a/k as k -> inf", "", "")),
    (
        ANY,
        (
            Holds,
            "(a*k + 1)^5/k^5 == a^5 + 5*a^4/k + O(1/k^2) as k -> inf",
            "a = 0",
            "",
        ),
    ),
    (
        A,
        (
            Holds,
            "sqrt(k^2 + a*k) == k + a/2 + O(1/k) as k -> inf",
            "a = 3",
            "",
        ),
    ),
    (
        A,
        (
            Fails,
            "sqrt(k^2 + a*k) == k + a/3 + O(1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        ANY,
        (
            Holds,
            "sqrt(k^2 + a*k) == k + a/2 + O(1/k) as k -> inf",
            "a = -3",
            "",
        ),
    ),
    (
        "given real k with k >= 1\ndraw x ~ beta(1, 1)",
        (Open, "mean(exp(1/(x*k)^5)) == O(1) as k -> inf", "", ""),
    ),
    (
        "given real k with k >= 1\ndraw x ~ beta(1, 1)",
        (Open, "mean(k/(k*x + 1)) == O(1) as k -> inf", "", ""),
    ),
    (
        "given real k with k >= 1\ndraw x ~ beta(1, 1)",
        (
            Holds,
            "mean(k/(x + k)) == 1 - 1/(2*k) + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (
        "given real k with k >= 1\ndraw x ~ beta(1, 1)",
        (
            Fails,
            "mean(k/(x + k)) == 1 - 1/(3*k) + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (
        "given real k with k >= 1\ndraw x ~ beta(1, 1)",
        (Open, "mean(1/(x*(x + k))) == O(1/k) as k -> inf", "", ""),
    ),
    (
        "given real k with k >= 1\ndraw x ~ beta(2, 1)",
        (
            Holds,
            "mean(1/(x*(x + k))) == 2/k + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    // E(1/x) = 1 + k^4: the law comes near the pole as k grows.
    (
        "given real k with k >= 1\ndraw x ~ beta(1 + 1/k^4, 1)",
        (
            Fails,
            "mean(1/(x*(x + k + 1))) == k^3 - k^2 + k + O(1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        "given real k with k >= 1\ndraw x ~ beta(1 + 1/k^4, 1)",
        (
            Holds,
            "mean(1/(x*(x + k + 1))) == k^3 - k^2 + O(k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        "given int k >= 3\ndraw x ~ beta(k, 1)",
        (Holds, "mean(1/x) == 1 + 1/k + O(1/k^2) as k -> inf", "", ""),
    ),
    (
        "given int k >= 3\ndraw x ~ beta(k, 1)",
        (
            Holds,
            "mean(1/(1 + x/k)) == 1 - 1/k + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
];

/// Uniformity and joint limits.
const JOINT: &[(&str, Row)] = &[
    (
        TWO,
        (
            Holds,
            "1/k + 1/n == O(1/k) as k -> inf uniformly in n",
            "",
            "n = k",
        ),
    ),
    (
        TWO,
        (
            Fails,
            "1/k + 1/n == O(1/n) as k -> inf uniformly in n",
            "",
            "",
        ),
    ),
    (
        TWO,
        (Fails, "k/n == o(1) as k -> inf uniformly in n", "", ""),
    ),
    (
        TWO,
        (Holds, "k/n == O(1) as k -> inf uniformly in n", "", "n = k"),
    ),
    (
        TWO,
        (Fails, "n/k == O(1) as k -> inf uniformly in n", "", ""),
    ),
    (
        TWO,
        (Holds, "k/n == o(1) as n, k, n/k -> inf", "", "n = k^2"),
    ),
    (TWO, (Fails, "k^2/n == O(1) as n, k, n/k -> inf", "", "")),
    (TWO, (Fails, "k/n == o(1) as n, k -> inf", "", "")),
    (
        TWO,
        (Holds, "1/(n + k) == O(1/n) as n, k -> inf", "", "n = 3*k"),
    ),
    (
        TWO,
        (
            Holds,
            "1/(n*k + n + 7) == 1/(n*k) + O(1/(n*k^2)) as n, k -> inf",
            "",
            "n = 3*k",
        ),
    ),
    (TWO, (Open, "1/(n - k) == O(1/n) as n, k -> inf", "", "")),
    (
        TWO,
        (
            OpenTrue,
            "1/(2*n - k) == O(1/n) as n, k -> inf",
            "",
            "n = k",
        ),
    ),
    (
        TWO,
        (
            Open,
            "(k - ln(n))/(k - ln(n)) == 1 + O(1/k) as k -> inf uniformly in n",
            "",
            "",
        ),
    ),
    (FREE, (Fails, "k/n == O(1) as n, k -> inf", "", "")),
    (
        FREE,
        (Fails, "n/k^3 == O(1/k) + O(1/n) as n, k -> inf", "", ""),
    ),
    (
        FREE,
        (
            Fails,
            "1/(n*k) == O(1/k^2) as k -> inf uniformly in n",
            "",
            "",
        ),
    ),
    (
        FREE,
        (
            Holds,
            "1/(n*k) == O(1/k) as k -> inf uniformly in n",
            "",
            "n = 5",
        ),
    ),
    (
        FREE,
        (Holds, "1/(n*k) == o(1/k) as n, k -> inf", "", "n = k"),
    ),
    (
        FREE,
        (
            OpenTrue,
            "1/(n + k) == O(1/n) + O(1/k^2) as n, k -> inf",
            "",
            "n = k",
        ),
    ),
    (
        FREE,
        (
            OpenTrue,
            "k*n/(k + n)^2 == O(1) as n, k -> inf",
            "",
            "n = k",
        ),
    ),
    (
        FREE,
        (Fails, "1/n - 1/n + 1/k == O(1/n) as n, k -> inf", "", ""),
    ),
    (
        "given real k, n with 1 <= n <= 2*k",
        (Fails, "k/n == O(1) as n, k -> inf", "", ""),
    ),
    (
        "given real k, n with n >= k^2 and k >= 1",
        (
            OpenTrue,
            "k/n == O(1/k) as k -> inf uniformly in n",
            "",
            "n = k^2",
        ),
    ),
    (
        "given real k, n with n >= k^2 and k >= 1",
        (Fails, "k/n == O(1/k^2) as k -> inf uniformly in n", "", ""),
    ),
    (
        "given real k, n with 1 <= k <= 5 and n >= k",
        (Vacuous, "k/n == O(1) as n, k -> inf", "", ""),
    ),
    (
        TWO,
        (
            Holds,
            "1/k - 1/n ~ 1/k as n -> inf then k -> inf",
            "n = 10^40",
            "",
        ),
    ),
    (
        TWO,
        (Open, "1/(k*n) == o(1/n) as n -> inf then k -> inf", "", ""),
    ),
    (
        TWO,
        (
            Open,
            "k/n == O(1) + O(1/n^2) as n -> inf then k -> inf",
            "",
            "",
        ),
    ),
    (
        TWO,
        (Vacuous, "k/n == O(1) as k -> inf then n -> inf", "", ""),
    ),
];

/// What is compared with what: little o, ~, =~ and their last terms; points; curves; other functions.
const SHAPES: &[(&str, Row)] = &[
    (
        K,
        (Fails, "sqrt(k+1) - sqrt(k) == O(1/k) as k -> inf", "", ""),
    ),
    (
        K,
        (
            Fails,
            "sqrt(k+1) - sqrt(k) == 1/(3*sqrt(k)) + O(1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Holds,
            "k^(1/3) - (k-1)^(1/3) == O(1/k^(2/3)) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Holds,
            "1/k + 1/k^2 == 1/k + o(1/k^(3/2)) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Fails,
            "1/k + 1/k^2 == 1/k + O(1/k^(5/2)) as k -> inf",
            "",
            "",
        ),
    ),
    (K, (Holds, "1/(k+1) == 1/k + o(1/k) as k -> inf", "", "")),
    (K, (Fails, "1/(k+1) == 1/k + o(1/k^2) as k -> inf", "", "")),
    (K, (Holds, "1 + 1/k + 1/k^2 =~ 1 + 1/k as k -> inf", "", "")),
    (K, (Fails, "1 + 1/k + 1/k^2 =~ 1 + 2/k as k -> inf", "", "")),
    (K, (Holds, "1 + 2/k =~ 1/k + 1 as k -> inf", "", "")),
    (K, (Fails, "-2/k^2 =~ -1/k^2 as k -> inf", "", "")),
    (K, (Holds, "-1/k^2 + 1/k^3 =~ -1/k^2 as k -> inf", "", "")),
    (
        K,
        (
            Fails,
            "(1 + 1/k)*(1 + 2/k) =~ (1 + 1/k)*(2 + 1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Holds,
            "(1 + 1/k)*(1 + 2/k) =~ (1 + 1/k)*(1 + 1/k) as k -> inf",
            "",
            "",
        ),
    ),
    (K, (Fails, "1 + 3/k =~ (1 + 1/k) + 1/k as k -> inf", "", "")),
    (
        K,
        (
            Holds,
            "1 + 3/k =~ 1/k + (1 + 1/k) - (1/k - 1/2) - 1/2 as k -> inf",
            "",
            "",
        ),
    ),
    (K, (Open, "1/k ~ k - k as k -> inf", "", "")),
    (K, (Holds, "1/(k-1) == O(1/k) as k -> inf", "", "")),
    (K, (Fails, "k/(k-1) == O(1/k) as k -> inf", "", "")),
    (
        K,
        (Holds, "exp(1/k) == 1 + 1/k + O(1/k^2) as k -> inf", "", ""),
    ),
    (
        K,
        (Fails, "exp(1/k) == 1 + 1/k + O(1/k^3) as k -> inf", "", ""),
    ),
    (
        K,
        (
            Holds,
            "(1 + 1/k)^(1/3) == 1 + 1/(3*k) - 1/(9*k^2) + O(1/k^3) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Fails,
            "(1 + 1/k)^(1/3) == 1 + 1/(3*k) + 1/(9*k^2) + O(1/k^3) as k -> inf",
            "",
            "",
        ),
    ),
    (
        A,
        (
            Holds,
            "(1 + 1/k)^a == 1 + a/k + O(1/k^2) as k -> inf",
            "a = 5/2",
            "",
        ),
    ),
    (
        K,
        (
            Holds,
            "sqrt(k+1) - sqrt(k) == O(1/sqrt(k)) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Holds,
            "gamma(k+2)/gamma(k) == k^2 + k + O(1) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Holds,
            "pi*k/(k+1) == pi - pi/k + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Fails,
            "pi*k/(k+1) == pi - 3*pi/k + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Holds,
            "hyp2f1(1, 2; 3; -1/k) == 1 - 2/(3*k) + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (
        K,
        (
            Fails,
            "hyp2f1(1, 2; 3; -1/k) == 1 - 1/k + O(1/k^2) as k -> inf",
            "",
            "",
        ),
    ),
    (
        X,
        (Holds, "exp(x) == 1 + x + x^2/2 + O(x^3) as x -> 0+", "", ""),
    ),
    (
        X,
        (Fails, "exp(x) == 1 + x + x^2/3 + O(x^3) as x -> 0+", "", ""),
    ),
    (
        REAL,
        (Holds, "1/(1 + x^2) == 1 - x^2 + O(x^4) as x -> 0", "", ""),
    ),
    (REAL, (Fails, "1/(1 + x^2) == 1 + O(x^3) as x -> 0", "", "")),
    (REAL, (Open, "sqrt(x^2) == x + O(x^2) as x -> 0", "", "")),
    (REAL, (Open, "abs(x) == x + O(x^2) as x -> 0", "", "")),
    (
        REAL,
        (Holds, "1/x == 1/2 - (x-2)/4 + O((x-2)^2) as x -> 2", "", ""),
    ),
    (
        REAL,
        (Fails, "1/x == 1/2 - (x-2)/3 + O((x-2)^2) as x -> 2", "", ""),
    ),
    (
        "given real x with x < 2",
        (Holds, "1/(2-x)^2 == O((2-x)^(-2)) as x -> 2-", "", ""),
    ),
    (
        "given real x with x < 2",
        (Fails, "1/(2-x)^2 == O(1/(2-x)) as x -> 2-", "", ""),
    ),
    (
        "given int k, p with k >= 1 and p >= 1",
        (
            Holds,
            "1/(k+1) == O(1/p^2) as k -> inf along k = p^2",
            "",
            "k = p^2",
        ),
    ),
    (
        "given int k, p with k >= 1 and p >= 1",
        (
            Fails,
            "1/(k+1) == O(1/p^3) as k -> inf along k = p^2",
            "",
            "",
        ),
    ),
    (
        "given int k, p with k >= 1",
        (Open, "abs(p) - p == O(1) as k -> inf along k = p^2", "", ""),
    ),
    (
        "given int k, p with k >= 1 and p >= 1",
        (
            Open,
            "1/k == O(1/p^3) as k -> inf along k = p^2 + 1/2",
            "",
            "",
        ),
    ),
    (
        "given int k, p with k >= 1 and p >= 1; real a > 0",
        (
            OpenFalse,
            "1/(a*k + 1) == O(1/k) as k -> inf uniformly in a along k = p^2",
            "",
            "k = p^2, a = 1/p^2",
        ),
    ),
];

pub fn cases() -> Vec<Case> {
    let tables = [THESIS, LOGARITHMS, OBLIGATIONS, JOINT, SHAPES];
    let rows = tables.into_iter().flatten();
    rows.map(|(scope, (truth, says, values, path))| Case {
        scope,
        says,
        truth: *truth,
        values,
        path,
    })
    .collect()
}
