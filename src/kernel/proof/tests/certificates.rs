//! Certificates as text: what is read is what is printed, and faults are told with their line.

use super::super::{Rule, Shown, parse, replay};

const SHIFT: &str = "theorem
given int k
domain k >= 2
says k*gamma(k - 1)/gamma(k) == k/(k - 1) and k < k + 1 and k + 1 > k
example k = 5/1
proof
a: 2 <= k | given
b: 0 < k - 1 | order | k - 2 + 1
0: 0 < k | order | k - 2 + 2
{ | h: k == 2
}
{ x real, j int | 1: 0 < x | 2: x < 1
  { y real
    s: 0 < x | order
  }
}
c: gamma(k) == (k - 1)*gamma(k - 1) | gamma
d: k*gamma(k - 1)/gamma(k) == k/(k - 1) | ring c
e: k < k + 1 | order
qed d - e
";

const PRINTED: &str = "theorem
given int k
domain k >= 2
says k*gamma(k - 1)/gamma(k) == k/(k - 1) and k < k + 1 and k + 1 > k
example k = 5
proof
1: 2 <= k | given
2: 0 < k - 1 | order | k - 2 + 1
3: 0 < k | order | k - 2 + 2
{ | 4: k == 2
}
{ x real, j int | 5: 0 < x | 6: x < 1
  { y real
    7: 0 < x | order
  }
}
8: gamma(k) == (k - 1)*gamma(k - 1) | gamma
9: k*gamma(k - 1)/gamma(k) == k/(k - 1) | ring 8
10: k < k + 1 | order
qed 9 - 10
";

const REFUTATION: &str = "refutation
given int k
given real x
given fn f(t) density on 0..1
domain k >= 1
says k == k and k == x
at k = 1, x = -1/2, f(t) = 2*t
link 2
";

#[test]
fn what_is_read_is_what_is_printed() {
    let all = parse(&format!("{SHIFT}\n\n{REFUTATION}")).expect("two certificates");
    assert_eq!(all.len(), 2);
    assert_eq!(all[0].to_string(), PRINTED);
    assert_eq!(all[1].to_string(), REFUTATION);
    assert_eq!(parse(PRINTED).expect("a certificate")[0], all[0]);
}

#[test]
fn a_theorem_says_what_it_shows() {
    let shown = replay(&format!("{SHIFT}{REFUTATION}")).expect("certificates");
    let [
        Shown::Theorem(theorem),
        Shown::Refutation { proposition, .. },
    ] = shown.as_slice()
    else {
        panic!("a theorem and a refutation");
    };
    assert_eq!(theorem.links(), [0, 2]);
    assert!(!theorem.is_whole());
    assert_eq!(
        theorem.rules(),
        [Rule::Given, Rule::Order, Rule::Ring, Rule::Gamma]
    );
    assert!(SHIFT.starts_with(&format!("theorem\n{}", theorem.proposition())));
    assert!(REFUTATION.starts_with(&format!("refutation\n{proposition}")));
    let whole = SHIFT.replace("qed d - e", "f: k < k + 1 | order\nqed d f e");
    match replay(&whole).expect("a theorem").as_slice() {
        [Shown::Theorem(theorem)] => assert!(theorem.is_whole()),
        _ => panic!("a theorem"),
    }
}

/// Faults of the notation and of the proof are told with their line, from 1; those of the end with
/// the last.
#[test]
fn faults_have_a_line() {
    let line = |text: &str| replay(text).expect_err("a flaw").line;
    assert_eq!(line(""), 0);
    assert_eq!(line("\n\nproof"), 3);
    for (old, new, at) in [
        ("k*gamma(k - 1)/gamma(k) == k/(k - 1) and", "(", 4),
        ("example k = 5/1", "example k = k", 5),
        ("example", "Example", 5),
        ("proof", "proof of it", 6),
        ("| order | k - 2 + 1", "| orders", 8),
        ("k - 2 + 2", "k - 2 + 3", 9),
        ("c: gamma(k)", "c: gamma(k + 1)", 17),
        ("qed d - e", "qed e - d", 20),
        ("qed d - e\n", "", 19),
    ] {
        assert_eq!(line(&SHIFT.replacen(old, new, 1)), at, "{new}");
    }
    let second = REFUTATION.replace("x = -1/2", "x = 1");
    assert_eq!(line(&format!("{SHIFT}{second}")), 28);
    assert_eq!(line(&REFUTATION.replace("link 2", "link 0")), 8);
    assert_eq!(line(REFUTATION.trim_end_matches("link 2\n")), 7);
}

#[test]
fn texts_have_a_longest_length() {
    let refused = |length| replay(&" ".repeat(length)).expect_err("a flaw").message;
    assert_eq!(refused(4 << 20), "there is no certificate in the text");
    assert_eq!(refused((4 << 20) + 1), "the certificate is too long");
}

/// A name that is a word of facts is a name all the same.
#[test]
fn names_like_words_of_facts() {
    let text = "theorem
        given real finite
        given real integer
        says finite - integer == -(integer - finite)
        example finite = 1, integer = 2
        proof
        1: finite finite | finite
        2: finite -finite | finite
        3: finite (finite) - 1 | finite
        4: finite - integer == -(integer - finite) | ring
        qed 4";
    assert!(replay(text).is_ok());
}
