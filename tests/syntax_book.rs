//! Reading chapters and unfolding claims: the examples of the language's description, and what goes
//! wrong.

use claimcheck::book::{Book, Claim, FileError, read_text};

const EXAMPLES: &str = r"# Examples

```claim 2.13
given  int k, n with 1 <= k <= n;  real I > 0
draw   r ~ beta(k, n-k+1)
let    Ihat = I*k/(n*r)
says   var(Ihat) == mean(Ihat^2) - (I*k/(k-1))^2
```

```claim 2.14
given  int k, n with 1 <= k <= n;  real I > 0
draw   r ~ beta(k, n-k+1)
let    Ihat = I*k/(n*r)
after  2.13
says   var(Ihat) == I^2*k^2*(-k+n+1) / ((k-2)*(k-1)^2*n)
needs  k >= 3
expect printed refuted domain, mended proved
```

```claim 2.61
given  real Va >= 0, V > 0
let    Vb = Va + V
says   hyp2f1r(1, 1; 2; V/Va) == Va*ln(Vb/Va)/V
mend   hyp2f1r(1, 1; 2; -V/Va) == Va*ln(Vb/Va)/V
why    the argument must be negative: ln(1-z) at z = -V/Va
expect printed refuted, mended proved
```

```claim 2.103
given  int k, l, m with 1 <= l <= m and l < k;  real v > 0, I > 0
draw   x ~ beta(l, m-l+1)
let    Ihat = I*k/(k - l + v*x)
says   mean(Ihat) == I + I*(l - l*v/(m+1))/k
         + I*(-(2*l^2)*v/(m+1) + l^2 + l*(l+1)*v^2/((m+1)*(m+2)))/k^2 + O((1/k)^3)   as k -> inf
```

```claim 2.103-strategy-2
same   2.103
read   along k = m*(m-1)/2 + l, v = m
```

```claim 2.14-cond
says 2.14 if k >= 3
```
";

fn book(text: &str) -> Book {
    read_text("book.md", text).unwrap_or_else(|errors| panic!("{errors:#?}"))
}

fn printed(claim: &Claim) -> String {
    match claim.printed() {
        Ok(proposition) => proposition.to_string(),
        Err(error) => format!("illtyped: {error}"),
    }
}

fn mended(claim: &Claim) -> Option<String> {
    claim
        .mended()
        .map(|mended| mended.expect("typed").to_string())
}

#[test]
fn the_examples_unfold() {
    let book = book(EXAMPLES);
    let claims = book.by_id();
    let scope = "given int k\ngiven int n\ngiven real I\ndomain 1 <= k <= n\ndomain I > 0\n";
    let says = "draw r ~ beta(k, n - k + 1)\n\
                says var(I*k/(n*r)) == I^2*k^2*(-k + n + 1)/((k - 2)*(k - 1)^2*n)";
    assert_eq!(printed(claims["2.14"]), format!("{scope}{says}"));
    let under = format!("{scope}domain k >= 3\n{says}");
    assert_eq!(mended(claims["2.14"]), Some(under.clone()));
    assert_eq!(printed(claims["2.14-cond"]), under);
    assert_eq!(
        mended(claims["2.61"]).as_deref(),
        Some(
            "given real Va\ngiven real V\ndomain Va >= 0\ndomain V > 0\n\
             says hyp2f1r(1, 1; 2; -V/Va) == Va*ln((Va + V)/Va)/V"
        )
    );
    assert!(printed(claims["2.103"]).ends_with(" + O((1/k)^3) as k -> inf"));
    let path = " + O((1/k)^3) as k -> inf along k = m*(m - 1)/2 + l, v = m";
    assert!(printed(claims["2.103-strategy-2"]).ends_with(path));
    assert_eq!(mended(claims["2.103"]), None);
}

#[test]
fn canonical_texts_parse_to_the_same_proposition() {
    for claim in &book(EXAMPLES).claims {
        let proposition = claim.printed().expect("typed");
        let text = proposition.to_string();
        let again = claimcheck::formula::parse_proposition(&text).expect("canonical text");
        assert_eq!(again, proposition);
    }
}

#[test]
fn the_link_goes_on_from_the_line_before() {
    let book = book(EXAMPLES);
    let claims = book.by_id();
    let link = claims["2.14"].link(claims["2.13"]).expect("a link");
    let says =
        "says mean((I*k/(n*r))^2) - (I*k/(k - 1))^2 == I^2*k^2*(-k + n + 1)/((k - 2)*(k - 1)^2*n)";
    assert!(link.to_string().ends_with(says), "{link}");
    assert_eq!(claims["2.14"].link(claims["2.61"]), None);
}

#[test]
fn texts_and_places_are_those_of_the_file() {
    let book = book(EXAMPLES);
    let claims = book.by_id();
    let claim = claims["2.14"];
    assert_eq!(EXAMPLES.lines().nth(claim.line - 1), Some("```claim 2.14"));
    assert_eq!(
        claim.says_text,
        "var(Ihat) == I^2*k^2*(-k+n+1) / ((k-2)*(k-1)^2*n)"
    );
    assert_eq!(
        claim.needs.as_ref().map(|needs| &*needs.text),
        Some("k >= 3")
    );
    assert!(claim.printed_meets("refuted", Some(claimcheck::book::Fault::Domain)));
    assert!(!claim.printed_meets("proved", None));
    assert!(claims["2.103"].printed_meets("certified", None));
}

#[test]
fn page_and_quote_are_taken_over_by_same() {
    let book = book(
        "```claim a\nsays words\npage 22-23\nquote the error is\n  at most 5%\n```\n\n\
         ```claim b\nsame a\npage iv\n```\n",
    );
    let found = |index: usize| {
        let claim = &book.claims[index];
        (claim.page.as_deref(), claim.quote.as_deref())
    };
    assert_eq!(found(0), (Some("22-23"), Some("the error is at most 5%")));
    assert_eq!(found(1), (Some("iv"), Some("the error is at most 5%")));
}

#[test]
fn define_blocks_are_used() {
    let text = "```claim 1\nuse scene\nsays mean(2*Y) == n\n```\n\
                ```define scene\ngiven int n\ndraw x ~ beta(1, n)\nlet Y = x*n\n```\n";
    assert_eq!(
        printed(&book(text).claims[0]),
        "given int n\ndraw x ~ beta(1, n)\nsays mean(2*(x*n)) == n"
    );
}

#[test]
fn functions_unfold_in_laws_too() {
    let text = "```claim 1\ngiven real a > 0\nlet f(r) = 2*r/a\n\
                draw R ~ order(1, 2) of density f on 0..a\nsays mean(R) == f(a) \n```";
    assert_eq!(
        printed(&book(text).claims[0]),
        "given real a\ndomain a > 0\ndraw R ~ order(1, 2) of density x -> 2*x/a on 0..a\n\
         says mean(R) == 2*a/a"
    );
}

/// A claim and what is ill-typed in it: the message's beginning and the text it points at.
const ILL_TYPED: &[(&str, &str, &str)] = &[
    (
        "given int kay\nsays kai == 1",
        "the name `kai` is not declared; is `kay` meant?",
        "kai",
    ),
    (
        "given int k\nsays sqr(k) == 1",
        "the function `sqr` is not known; is `sqrt` meant?",
        "sqr",
    ),
    (
        "given int k\nsays log(k) == 1",
        "the function `log` is not known; write `ln(...)`",
        "log",
    ),
    (
        "given int k\nsays k(k+1) == 1",
        "`k` is no function; a product is written",
        "k",
    ),
    (
        "let F(r, s) = r*s\nsays F(1) == 1",
        "`F` takes 2 arguments, found 1",
        "F",
    ),
    (
        "let F(r) = r\nsays F == 1",
        "`F` is a function; write `F(...)`",
        "F",
    ),
    (
        "given int k\nsays k == 2 + (k < 3)",
        "a condition stands where a number is wanted",
        "(k < 3)",
    ),
    (
        "given int k\ndraw x ~ any\nlet Y = k*x\nsays mean(x) == k*Y",
        "the draw `x` stands outside",
        "Y",
    ),
    (
        "given int k\nsays O(k) == k",
        "`O(...)` and `o(...)` stand as terms on the right",
        "O",
    ),
    (
        "given int k\nsays k == O(k)",
        "an expansion needs to say where",
        "says k == O(k)",
    ),
    (
        "given int k\nsays k == k^1 as k -> inf",
        "nothing here is an expansion",
        "says k == k^1 as k -> inf",
    ),
    (
        "given real k\nsays sum(j, j = 1..k) == 1",
        "the bound of a sum is a whole number",
        "k",
    ),
    (
        "given real k\nlet j = k\nsays k ~ k as j -> inf uniformly in j",
        "`j` is no number that",
        "j",
    ),
    (
        "given real r > 0\nlet X = r^2\nsays diff(X, r) == 2*r",
        "`X` is defined with another `r` than the one bound where it stands; define it as `X(r)`",
        "X",
    ),
    (
        "given real k > 0\ndraw X ~ uniform(0, k)\nlet m = mean(X)\nsays sum(m, k = 1..3) == 3*k/2",
        "`m` is defined with another `k`",
        "m",
    ),
    (
        "given real k > 0\ndraw X ~ uniform(0, k)\nsays sum(mean(X), k = 1..3) == 3*k/2",
        "a draw's law has another `k` than the one bound here",
        "k",
    ),
    (
        "given real r, c > 0\nlet F(s) = s + r\nsays int(F(c), r = 0..1) == c + r",
        "`F` is defined with another `r`",
        "F",
    ),
    (
        "given int j\nsays sum(j, j = 1..2) + i == j",
        "the name `i` is not declared",
        "i",
    ),
];

#[test]
fn ill_typed_statements_tell_the_place() {
    for (lines, message, place) in ILL_TYPED {
        let text = format!("```claim 1\n{lines}\n```\n");
        let book = book(&text);
        let error = book.claims[0].printed().expect_err(lines);
        assert!(
            error.message.starts_with(message),
            "{lines}: {}",
            error.message
        );
        assert_eq!(&text[error.span.start..error.span.end], *place, "{lines}");
    }
}

fn refused(text: &str) -> Vec<FileError> {
    read_text("book.md", text).expect_err(text)
}

/// A block's lines and what is wrong: the message's beginning, the hint, the text it points at.
const FAULTY: &[(&str, &str, &str, &str)] = &[
    (
        "given int k\nsays 2k == 1",
        "a number stands against a name",
        "write `2*k`",
        "2k",
    ),
    (
        "says words\npage see page 22",
        "this is no page",
        "write one page or a range of pages: `22`, `iv`, `22-23`",
        "see page 22",
    ),
    ("says words\nquote", "this line says nothing", "", "quote"),
    (
        "says words\npage 22\npage 23",
        "a second `page` line",
        "",
        "page 23",
    ),
    ("sais 1 == 1", "no line begins so", "write `says`", "sais"),
    (
        "given int k",
        "the claim `1` has no `says` line",
        "",
        "```claim 1",
    ),
    (
        "given int k\nsays k = 1",
        "expected a relation such as `==`, found `=`",
        "equality is written `==`",
        "=",
    ),
    (
        "given int k\nsays (k == 1",
        "this bracket is never closed: `)` is missing",
        "",
        "(",
    ),
    (
        "given int k\nsays k) == 1",
        "expected a relation",
        "there is no `(` that this bracket closes",
        ")",
    ),
    (
        "given int k\nsays k ≤ 1",
        "the character `≤`",
        "write `<=`",
        "≤",
    ),
    (
        "given int k\nsays k² == 1",
        "the character `²`",
        "write `^2`",
        "²",
    ),
    (
        "given int k\nsays π × k − 1 == 1",
        "the character `π`",
        "write `pi`",
        "π",
    ),
    (
        "given int k\nsays ｋ == 1",
        "`ｋ` is a fullwidth character",
        "write `k`",
        "ｋ",
    ),
    (
        "given int k\nsays k (k) (k) == 1",
        "expected a relation",
        "a product is written with `*`",
        "(",
    ),
    (
        "given int k\nsays ln k == 1",
        "`ln` is a word of the language, not a name",
        "its arguments stand in brackets: `ln(...)`",
        "ln",
    ),
    (
        "given int k\nsays beta(k) == 1",
        "`beta` takes 2 arguments, found 1",
        "",
        "beta(k)",
    ),
    (
        "given int k\nsays k",
        "expected a relation such as `==`, the text ends",
        "",
        "",
    ),
    (
        "given int k\nlet k = 2\nsays k == 1",
        "the name `k` is declared already",
        "a name is declared once in a claim",
        "k",
    ),
    (
        "let a = b\nsays a == 1",
        "the name `b` is not declared",
        "",
        "b",
    ),
    (
        "given int k with k < n; int n\nsays k == 1",
        "`n` is used before it is declared",
        "",
        "n",
    ),
    (
        "given int k, real n\nsays k == 1",
        "expected a name, found `real`",
        "write `;` before the next type",
        "real",
    ),
    (
        "given int k\nsays k == 1\nsays k == 2",
        "a second `says` line",
        "join statements by `and`, or give the part an id of its own",
        "says k == 2",
    ),
    (
        "says 1 == 1\nexpect mended proved",
        "a verdict on the mended statement is expected",
        "",
        "expect mended proved",
    ),
    (
        "says 1 == 1\nexpect prooved",
        "no verdict",
        "write `proved`",
        "prooved",
    ),
    ("same 2\nsays 1 == 1", "there is no claim `2`", "", "same 2"),
    (
        "same 1",
        "`same` leads back to this claim",
        "",
        "```claim 1",
    ),
    (
        "use scene\nsays 1 == 1",
        "there is no block `define scene`",
        "",
        "use scene",
    ),
    (
        "after 0.9\nsays 1 == 1",
        "there is no claim `0.9`",
        "",
        "after 0.9",
    ),
    (
        "draw x ~ bet(1, 2)\nsays 1 == 1",
        "expected a law, found `bet`",
        "laws are beta(a, b), uniform(a, b), order(l, m) of LAW, density f on a..b, any",
        "bet",
    ),
    (
        "given int k\nsays sum(k, k == 1..2) == 1",
        "expected `=`, found `==`",
        "write `sum(e, j = a..b)`",
        "==",
    ),
    (
        "given fn f(x) continous on 0..1\nsays 1 == 1",
        "expected `continuous`",
        "write `continuous`",
        "continous",
    ),
    (
        "given int k\nsays k == 1 or k == 2",
        "expected `and` or the end",
        "statements are joined by `and`; a condition is a number in brackets: `[COND] == 1`",
        "or",
    ),
    (
        "given int k\nneeds k\nsays k == 1",
        "expected a condition such as `a < b`, found a number",
        "",
        "k",
    ),
];

#[test]
fn faults_tell_the_place_and_what_to_do() {
    for (lines, message, hint, place) in FAULTY {
        let text = format!("# Title\n\n```claim 1\n{lines}\n```\n");
        let errors = refused(&text);
        let error = &errors[0].diagnostic;
        assert!(error.message.starts_with(message), "{lines}: {error:?}");
        assert_eq!(
            error.hint.as_deref().unwrap_or(""),
            *hint,
            "{lines}: {error:?}"
        );
        assert_eq!(&text[error.span.start..error.span.end], *place, "{lines}");
    }
}

#[test]
fn ids_are_given_once() {
    let errors = refused("```claim 1\nsays words\n```\n\n```claim 1\nsays words\n```\n");
    let error = &errors[0].diagnostic;
    assert_eq!(error.message, "a second claim `1`");
    assert_eq!(
        error.hint.as_deref(),
        Some("the first stands in book.md, line 1")
    );
}

#[test]
fn same_in_a_circle_is_refused() {
    let errors = refused("```claim 1\nsame 2\n```\n\n```claim 2\nsame 1\n```\n");
    assert!(
        errors[0]
            .diagnostic
            .message
            .starts_with("`same` leads back")
    );
}

#[test]
fn nesting_and_size_are_capped() {
    let deep = |open: &str, close: &str| format!("{}1{}", open.repeat(5000), close.repeat(5000));
    for text in [
        deep("(", ")"),
        deep("[", "]"),
        deep("sqrt(", ")"),
        deep("-", ""),
        deep("2^", ""),
        deep("mean(", ", x ~ any)"),
        deep("1 + ", ""),
        deep("1*", ""),
        format!("{}1", "not ".repeat(5000)),
        format!("1{}", "!".repeat(5000)),
        "1".repeat(10_001),
    ] {
        let error = claimcheck::formula::parse_formula(&text).expect_err("too deep");
        assert!(error.span.end <= text.len());
    }
    assert!(claimcheck::formula::parse_formula(&"1".repeat(10_000)).is_ok());
    let sum = format!("1{}", " + 1".repeat(900));
    assert!(claimcheck::formula::parse_formula(&sum).is_ok());
}

#[test]
fn unfolding_is_capped() {
    let mut text = "```claim 1\ngiven int k\nlet a0 = k + k\n".to_string();
    for i in 1..100 {
        text += &format!("let a{i} = a{} + a{}\n", i - 1, i - 1);
    }
    text += "says a99 == k\n```\n";
    let book = book(&text);
    let error = book.claims[0].printed().expect_err("large");
    assert!(error.message.contains("nodes"), "{error}");
}

#[test]
fn the_deepest_trees_are_unfolded_and_checked() {
    let sum = "k + ".repeat(498);
    let text = format!(
        "```claim 1\ngiven int k\nlet a = {sum}k\nsays {sum}a == mean({sum}a)\nneeds a == a\n```"
    );
    let book = book(&text);
    let proposition = book.claims[0].printed().expect("typed");
    let printed = proposition.to_string();
    assert_eq!(
        claimcheck::formula::parse_proposition(&printed),
        Ok(proposition)
    );
}

#[test]
fn many_claims_take_linear_time() {
    let count = 20_000;
    let mut text = "```define scene\ngiven int n\ndraw x ~ beta(1, n)\n```\n".to_string();
    for i in 0..count {
        text += &format!("text\n\n```claim 1.{i}\nuse scene\nsays mean(x) == 1/(n + {i})\n```\n\n");
    }
    let start = std::time::Instant::now();
    assert_eq!(book(&text).claims.len(), count);
    assert!(start.elapsed().as_secs() < 20);
}
