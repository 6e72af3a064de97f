//! Random bytes and mutated claims: no panic, and every error points into its text.

use claimcheck::book::{FileError, read_text};
use claimcheck::formula::{
    Diagnostic, parse_condition, parse_formula, parse_law, parse_proposition, parse_statement,
};
use std::path::Path;

/// A plain generator of random numbers (Steele, Lea & Flood 2014, SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound.max(1) as u64) as usize
    }
}

/// How many texts are tried, to be raised by `CLAIMCHECK_FUZZ`.
fn count() -> usize {
    let given = std::env::var("CLAIMCHECK_FUZZ").ok();
    given.and_then(|text| text.parse().ok()).unwrap_or(10_000)
}

const SEEDS: &[&str] = &[
    "```define scene\ngiven int k, n with 1 <= k <= n; real I > 0\nlet F(r) = r^2\n\
     draw r, s ~ order(k, n) of density F on 0..1\n```\n",
    "```claim 2.14\nuse scene\nlet Ihat = I*k/(n*r)\nafter 2.13\n\
     says var(Ihat) == I^2*k^2*(-k+n+1) / ((k-2)*(k-1)^2*n)\nneeds k >= 3 sufficient\n\
     expect printed refuted domain, mended proved\n```\n",
    "```claim 2.13\ngiven fn f(x) smooth(2) on -1..inf; real x\n\
     says f(r) is sum(j!, j = 1..3) + int(x, x) with density on 0..1, agrees 2.14\n```\n",
    "> ```claim 2.103\n> given int k, l, m with 1 <= l <= m and l < k\n\
     > draw x ~ beta(l, m-l+1)\n> says mean(k/(k + x)) == 1 + l/k\n>   + O(1/k) as k -> inf\n\
     >   uniformly in l along m = l^2\n> slip x for y\n> ```\n",
    "```claim 2.103-b\nsame 2.103\nread as l -> 0+ then k, k/l -> inf\n```\n",
    "```claim 3\nsays 2.14 if k > 3 or not [k == 4] == 1\n```\n",
    "```claim 4\ngiven real z with z < 1\nsays hyp2f1(1, 1; 2; z) == at(lim(diff(-ln(1-y), y, 2), y -> z), q = 1) \
     and z != if(z < 0.05, min(1, z), pi)\n```\n",
];

const PIECES: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "*",
    "^",
    "!",
    "==",
    "=",
    "<",
    "~",
    "=~",
    "->",
    "..",
    ",",
    ";",
    "\n",
    "\n ",
    "```",
    "```claim 1",
    "> ",
    "0",
    "1.5",
    "99999999",
    "k",
    "and ",
    "or ",
    "not ",
    "as ",
    "is ",
    "if ",
    "mean(",
    "sum(",
    "O(",
    "says ",
    "given ",
    "let ",
    "use ",
    "same ",
    "²",
    "π",
    "\u{feff}",
    "\r",
    "\t",
    "\0",
    "e\u{301}",
    "𝑘",
];

fn inside(text: &str, error: &Diagnostic) {
    let span = error.span;
    assert!(span.start <= span.end, "{error:?} in {text:?}");
    assert!(
        text.get(span.start..span.end).is_some(),
        "{error:?} in {text:?}"
    );
}

fn check_book(text: &str) {
    match read_text("book.md", text) {
        Ok(book) => {
            for claim in &book.claims {
                for result in [Some(claim.printed()), claim.mended()]
                    .into_iter()
                    .flatten()
                {
                    match result {
                        Ok(proposition) => {
                            let printed = proposition.to_string();
                            assert_eq!(parse_proposition(&printed), Ok(proposition), "{text:?}");
                        }
                        Err(error) => {
                            let span = error.span;
                            assert!(text.get(span.start..span.end).is_some(), "{text:?}");
                        }
                    }
                }
                for before in &book.claims {
                    let _ = claim.link(before);
                }
            }
        }
        Err(errors) => {
            assert!(!errors.is_empty());
            for FileError {
                file, diagnostic, ..
            } in &errors
            {
                assert_eq!(file, Path::new("book.md"));
                inside(text, diagnostic);
            }
        }
    }
}

fn check_all(text: &str) {
    let mut errors = Vec::new();
    errors.extend(parse_formula(text).err());
    errors.extend(parse_condition(text).err());
    errors.extend(parse_law(text).err());
    errors.extend(parse_statement(text).err());
    errors.extend(parse_proposition(text).err());
    for error in &errors {
        inside(text, error);
    }
    check_book(text);
}

#[test]
fn random_bytes() {
    let mut random = Random(1);
    for _ in 0..count() {
        let length = random.below(60);
        let bytes: Vec<u8> = (0..length).map(|_| random.next() as u8).collect();
        check_all(&String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn random_pieces() {
    let mut random = Random(2);
    for _ in 0..count() {
        let length = random.below(20);
        let text: String = (0..length)
            .map(|_| PIECES[random.below(PIECES.len())])
            .collect();
        check_all(&text);
    }
}

/// Cuts, doubles, swaps or inserts a few things.
fn mutate(random: &mut Random, text: &mut String) {
    let mut place = |text: &str| {
        let mut at = random.below(text.len() + 1);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let (a, b) = (place(text), place(text));
    let range = a.min(b)..a.max(b).min(a.min(b) + 12).min(text.len());
    let range = match text.is_char_boundary(range.end) {
        true => range,
        false => a.min(b)..a.max(b),
    };
    match random.below(4) {
        0 => text.replace_range(range, ""),
        1 => {
            let part = text[range].to_string();
            text.insert_str(a, &part);
        }
        2 => text.insert_str(a, PIECES[random.below(PIECES.len())]),
        _ => text.replace_range(range, PIECES[random.below(PIECES.len())]),
    }
}

#[test]
fn mutated_claims() {
    let mut random = Random(3);
    for _ in 0..count() {
        let mut text = String::new();
        for seed in SEEDS {
            if random.below(3) > 0 {
                text += seed;
                text += "\n";
            }
        }
        for _ in 0..random.below(4) {
            mutate(&mut random, &mut text);
        }
        check_book(&text);
    }
}

#[test]
fn the_seeds_are_right() {
    let text = SEEDS.join("\n");
    let errors = read_text("book.md", &text).err();
    assert_eq!(errors, None);
}
