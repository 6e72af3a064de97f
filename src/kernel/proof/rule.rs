//! The rules, each with its statement, its side conditions and its source.
//!
//! `e[x:=t]` is e with t in the place of x. A premise "on a..b" is a fact proved in a block that
//! fixes one real variable x and supposes at most `a < x` and `x < b`; "on [a..b]" one that supposes
//! at most `a <= x` and `x <= b`. The variable may have another name than the one bound in the
//! conclusion. Finite, positive, nonnegative, nonzero and integer are read off the structure of a
//! formula and the facts in sight, see [`super::known`]; the sides of every relation concluded by a
//! rule of order are finite in that sense.

/// Generates the enum, the list, the names, the statements and the sources from one table.
macro_rules! rules {
    ($($(#[doc = $law:literal])+ $rule:ident $name:literal $source:literal,)+) => {
        /// A rule of inference.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Rule { $($(#[doc = $law])+ $rule,)+ }

        impl Rule {
            /// Every rule.
            pub const ALL: &'static [Rule] = &[$(Rule::$rule,)+];

            /// The name in a certificate.
            pub fn name(self) -> &'static str {
                match self { $(Rule::$rule => $name,)+ }
            }

            /// What it concludes, and from what.
            pub fn law(self) -> &'static str {
                match self { $(Rule::$rule => concat!($($law, "\n"),+).trim_ascii(),)+ }
            }

            /// The fact of mathematics that it rests on; empty for logic, arithmetic and order.
            pub fn source(self) -> &'static str {
                match self { $(Rule::$rule => $source,)+ }
            }
        }
    };
}

rules! {
    /// A link of the domain whose sides are finite.
    Given "given" "",
    /// `finite e` or `integer e`, from the structure of e and the facts in sight; `finite e` from
    /// `e == t` too, where t is finite.
    Finite "finite" "",
    /// `a < b`, `a <= b` or `a != b`, where the argument (or `b - a` without one) is equal to `b - a`
    /// as a rational function and positive, nonnegative or nonzero by its structure; premises are equations, as for `ring`. `a == b` where both `b - a` and `a - b`
    /// are nonnegative.
    Order "order" "",
    /// `a <= b` for integers, where the argument is equal to `b - a + 1` as a rational function and
    /// positive by its structure; premises are equations, as for `ring`.
    Gap "gap" "",
    /// `a == b` for finite a and b that are equal as rational functions of their atoms, once the
    /// left sides of the premises are replaced by their right sides.
    Ring "ring" "",
    /// `a == b`, where b is a with sides of the premises exchanged. Under a binder a premise may be
    /// one proved on its range.
    Congruence "congruence" "",
    /// `a == c` from `a == b` and `b == c`, each read in either direction; `a <= c` where at least one
    /// of the premises is `b <= c` or `b < c`, `a < c` where one is `b < c`.
    Chain "chain" "",
    /// `undefined e` for a quotient by 0, `ln` of what is not positive, 0 to a negative power,
    /// `gamma(n)` for an integer n <= 0, `n!` for an integer n < 0, `inf - inf`, powers of inf with
    /// positive exponents taken for inf, or anything strict with an undefined part; `a == b` where
    /// both are undefined.
    None "none" "",
    /// `e == q` for a formula without names whose value is the number q; `undefined e` for one
    /// without value.
    Compute "compute" "",
    /// `[C] == 1` and `if(C, a, b) == a` where all relations of C hold, `[C] == 0` and `if(C, a, b) == b`
    /// where one of them fails; their sides finite, C made of chains and `and`.
    Decide "decide" "",
    /// Anything from the same fact proved in a block that supposes P and in one that supposes not P,
    /// P a relation of finite numbers.
    Cases "cases" "",
    /// `at(e, x = t, ...) == e[x:=t, ...]`, every t finite.
    At "at" "",
    /// `int(e, x = a..b) == F[x:=b] - F[x:=a]` for `a <= b`, F the argument, from `finite F` on
    /// [a..b], `F' == e` on a..b, and `finite e` on [a..b]; F and e continuous there.
    Primitive "primitive" "DLMF 1.4(v)",
    /// `diff(e, x) == e'`, e' the derivative of e by the rules of calculus, from `finite e` and
    /// `finite e'` for a real variable in the place of x, each supposing at most what holds around x:
    /// relations `<` and `!=` that hold at x, their sides continuous on the whole line.
    Derivative "derivative" "DLMF 1.4(iii)",
    /// `int(e, x = a..b) == int(g, u = c..d)` for `a < b`, p the argument, from `finite p` on
    /// [a..b], `0 < p'` on a..b, and `e == g[u:=p]*p'` on a..b, where c and d are p at a and b.
    Substitution "substitution" "DLMF 1.4(v)",
    /// `int(c*e, x = a..b) == c*int(e, x = a..b)`, c finite and free of x, and c nonzero or the integral
    /// on the right finite; the same with `mean(.., x ~ LAW)`.
    Scale "scale" "DLMF 1.4(v)",
    /// `int(e + g, x = a..b) == int(e, x = a..b) + int(g, x = a..b)` where the two on the right are
    /// finite; the same with `-`, and with `mean(.., x ~ LAW)`.
    Split "split" "DLMF 1.4(v)",
    /// `finite int(e, x = a..b)` for `a <= b`, from `finite e` on [a..b]; for all finite a and b, from
    /// `finite e` on the whole line; e continuous there.
    Continuous "continuous" "DLMF 1.4(v)",
    /// `int(e, x = a..b) == inf` for `a < b`, g the argument, from `finite g` on [a..b],
    /// `e == g/(x - a)` on a..b, and `0 <= g` on a..b; g continuous, and positive at a. With a number
    /// p >= 1 as second argument, `e == g/(x - a)^p`.
    Diverges "diverges" "comparison with the integral of 1/(x - a)",
    /// `int(e, x = c..d) == int(g, x = a..b)` for `c <= a <= b <= d`, from `e == g` on a..b, `e == 0` on
    /// c..a unless c is a, and `e == 0` on b..d unless b is d.
    Support "support" "DLMF 1.4(v)",
    /// `sum(e, j = a..b) == G[j:=b + 1] - G[j:=a]` for integers with `a <= b + 1`, G the argument,
    /// from `e == G[j:=j + 1] - G` on [a..b] and `finite G` on [a..b + 1], both for an integer j.
    Telescope "telescope" "",
    /// `mean(e) == mean(e, x ~ LAW)`, `var(e) == var(e, x ~ LAW)` for the only draw in e.
    Draw "draw" "",
    /// `prob(C) == mean([C])`, `prob(C, x ~ LAW) == mean([C], x ~ LAW)`.
    Probability "probability" "",
    /// `mean(e, x ~ LAW) == int(f*e, x = a..b)` and, for a draw X and `a <= t <= b`,
    /// `density(X, t) == f[x:=t]`, f the density of the law and a..b its support: for `beta(p, q)`,
    /// p and q positive, `x^(p - 1)*(1 - x)^(q - 1)/beta(p, q)` on 0..1; for `uniform(a, b)`,
    /// `a < b`, `1/(b - a)`; for `density f on a..b`, `a < b`, f, from `0 <= f` on a..b and
    /// `int(f, s = a..b) == 1`; for `order(l, m) of LAW`, integers with 1 <= l <= m, the LAW uniform
    /// or given by its density, `m!/((l - 1)!*(m - l)!)*F^(l - 1)*(1 - F)^(m - l)*f`, F being
    /// `(x - a)/(b - a)` or `int(f, s = a..x)`.
    Density "density" "David & Nagaraja, Order Statistics, 2.1.6",
    /// `var(e, x ~ LAW) == mean(e^2, x ~ LAW) - mean(e, x ~ LAW)^2`; `var(e, x ~ LAW) ==
    /// mean((e - mean(e, x ~ LAW))^2, x ~ LAW)` where the mean of e is finite and the LAW free of x;
    /// `var(e + c, x ~ LAW) == var(e, x ~ LAW)`, the same with `c + e` and `e - c`, c finite and free of x;
    /// `var(c*e, x ~ LAW) == c^2*var(e, x ~ LAW)`, c finite and free of x, and c nonzero or the variance on
    /// the right finite; `undefined var(e, x ~ LAW)` from `mean(e, x ~ LAW) == inf`.
    Variance "variance" "",
    /// `beta(a, b) == int(x^(a - 1)*(1 - x)^(b - 1), x = 0..1)`, a and b positive.
    BetaIntegral "beta-integral" "DLMF 5.12.1",
    /// `hyp2f1(a, b; c; z) == int(x^(b - 1)*(1 - x)^(c - b - 1)*(1 - z*x)^(-a), x = 0..1)/beta(b, c - b)`
    /// for positive b, c - b and 1 - z.
    Euler "euler" "DLMF 15.6.1",
    /// `hyp2f1r(a, b; c; z) == hyp2f1(a, b; c; z)/gamma(c)`, c and 1 - z positive.
    Regularized "regularized" "DLMF 15.2.2",
    /// `gamma(s) == t*gamma(t)` where `s == t + 1` and t is nonzero.
    Gamma "gamma" "DLMF 5.5.1",
    /// `n! == gamma(n + 1)` for an integer n >= 0.
    Factorial "factorial" "DLMF 5.4.1",
    /// `beta(a, b) == gamma(a)*gamma(b)/gamma(a + b)`, a and b positive.
    Beta "beta" "DLMF 5.12.1",
    /// `binomial(n, k) == n!/(k!*(n - k)!)` for integers with 0 <= k <= n.
    Binomial "binomial" "DLMF 1.2.1",
    /// `pochhammer(a, n) == gamma(a + n)/gamma(a)`, a positive, n an integer >= 0.
    Pochhammer "pochhammer" "DLMF 5.2.5",
    /// `ln(a*b) == ln(a) + ln(b)`, `ln(a/b) == ln(a) - ln(b)`, `ln(a^p) == p*ln(a)`,
    /// `ln(sqrt(a)) == ln(a)/2`, a and b positive; `ln(exp(a)) == a`.
    Logarithm "logarithm" "DLMF 4.8(i)",
    /// `a^p == a^q*a^r` where `p == q + r`, `(a^p)^q == a^r` where `r == p*q`,
    /// `(a*b)^p == a^p*b^p`, `(a/b)^p == a^p/b^p`: with positive bases; or nonnegative ones
    /// and positive exponents; or nonzero ones and integer exponents; or integer exponents >= 0 (b
    /// nonzero in a quotient). `sqrt(a) == a^(1/2)`, a nonnegative.
    /// `a^p == 0` where `a == 0` and p is positive. `a^p == 1` where `a == 1`.
    Power "power" "DLMF 4.2(iv)",
    /// `cos(x)^2 == 1 - sin(x)^2`, x finite.
    Circle "circle" "DLMF 4.21.12",
    /// `gamma(1/2) == sqrt(pi)`, `cos(pi) == -1`.
    Constant "constant" "DLMF 5.4.6 and 4.17",
    /// `min(a, b, ...) == a` for an a that is at most each of them, `max(a, b, ...) == a` for one that
    /// is at least each.
    Extreme "extreme" "",
    /// `a^p < b^p` for `0 <= a < b`, `a^p <= b^p` for `0 <= a <= b`, p positive.
    PowerOrder "power-order" "DLMF 4.2(iv)",
    /// `lim(mean(e, x ~ beta(p, q)), m -> s, ...) == mean(e, x ~ beta(p', q'))`, p' and q' being p and
    /// q with the targets in the place of the names: p, q polynomials, p', q' positive, e free of the
    /// names, from `finite e` on [0..1]; e continuous there.
    Limit "limit" "Scheffe's lemma: the beta densities converge in the mean",
    /// `int(f(s), s = a..b) == 1` for `fn f(x) density on a..b`; `finite int(f(s), s = a..b)` for
    /// `fn f(x) integrable on a..b`.
    Function "function" "",
}

impl Rule {
    /// The rule of a name.
    pub fn parse(name: &str) -> Option<Rule> {
        Rule::ALL.iter().copied().find(|rule| rule.name() == name)
    }
}
