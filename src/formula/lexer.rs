//! Text to tokens, one at a time, so that the parser may also read an id such as `2.103-strategy-2`
//! from where it stands. A token that no formula can hold is an error as data: it is reported when
//! the parser gets there, not before.

use super::{Diagnostic, Span};

/// What stands at a place of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Token {
    /// `12` or `0.05`; the digits are in the text.
    Number,
    /// A name or a word of the language.
    Word,
    Symbol(&'static str),
    End,
    /// Nothing that the language knows, and what to say of it.
    Bad(Box<Diagnostic>),
}

/// A token and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Lexeme {
    pub token: Token,
    pub span: Span,
}

/// Symbols, longer ones first where one begins another.
const SYMBOLS: [&str; 23] = [
    "==", "=~", "!=", "<=", ">=", "->", "..", "+", "-", "*", "/", "^", "!", "(", ")", "[", "]",
    ",", ";", "<", ">", "~", "=",
];

/// Spellings of other languages, and ours.
const FOREIGN: [(&str, &str); 16] = [
    ("...", ".."),
    ("**", "^"),
    ("&&", "and"),
    ("||", "or"),
    ("=>", ">="),
    ("=<", "<="),
    ("<>", "!="),
    ("/=", "!="),
    ("~=", "=~"),
    (":=", "=="),
    ("&", "and"),
    ("{", "("),
    ("}", ")"),
    ("%", "/100"),
    (":", ";"),
    ("|", "abs(...)"),
];

/// Characters of typeset mathematics, and our spelling.
const TYPOGRAPHIC: [(char, &str); 61] = [
    ('×', "*"),
    ('·', "*"),
    ('⋅', "*"),
    ('∗', "*"),
    ('÷', "/"),
    ('⁄', "/"),
    ('∕', "/"),
    ('−', "-"),
    ('–', "-"),
    ('—', "-"),
    ('‐', "-"),
    ('‑', "-"),
    ('≤', "<="),
    ('≥', ">="),
    ('⩽', "<="),
    ('⩾', ">="),
    ('≠', "!="),
    ('≈', "=~"),
    ('≃', "=~"),
    ('∼', "~"),
    ('≡', "=="),
    ('→', "->"),
    ('∞', "inf"),
    ('π', "pi"),
    ('¹', "^1"),
    ('²', "^2"),
    ('³', "^3"),
    ('⁴', "^4"),
    ('½', "1/2"),
    ('√', "sqrt(...)"),
    ('∑', "sum(e, j = a..b)"),
    ('Σ', "sum(e, j = a..b)"),
    ('∫', "int(e, x = a..b)"),
    ('∧', "and"),
    ('∨', "or"),
    ('¬', "not"),
    ('…', ".."),
    ('’', "'"),
    ('‘', "'"),
    ('′', "'"),
    ('″', "''"),
    ('⌊', "floor(...)"),
    ('⌋', "floor(...)"),
    ('Γ', "gamma(...)"),
    ('α', "alpha"),
    ('β', "beta_"),
    ('γ', "gamma_"),
    ('δ', "delta"),
    ('Δ', "Delta"),
    ('ε', "epsilon"),
    ('θ', "theta"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('µ', "mu"),
    ('ρ', "rho"),
    ('σ', "sigma"),
    ('τ', "tau"),
    ('φ', "phi"),
    ('ϕ', "phi"),
    ('Φ', "Phi"),
    ('ω', "omega"),
];

/// The token at or after the byte `from`, which must be a character's first.
pub(crate) fn lex(text: &str, from: usize) -> Lexeme {
    let rest = &text[from..];
    let start = from + (rest.len() - rest.trim_start_matches([' ', '\t', '\n', '\r']).len());
    let rest = &text[start..];
    let Some(first) = rest.chars().next() else {
        return place(Token::End, start, 0);
    };
    if first.is_ascii_digit() {
        return number(rest, start);
    }
    if is_name_start(first) {
        return place(Token::Word, start, name_length(rest));
    }
    // `n!==1` is a factorial and an equality.
    if rest.starts_with("!==") {
        return place(Token::Symbol("!"), start, 1);
    }
    if let Some(bad) = foreign(rest, start) {
        return bad;
    }
    match SYMBOLS.iter().find(|symbol| rest.starts_with(**symbol)) {
        Some(symbol) => place(Token::Symbol(symbol), start, symbol.len()),
        None => stranger(rest, first, start),
    }
}

/// Whether a name may begin with this character.
pub(crate) fn is_name_start(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

/// The number of bytes of the name that the text begins with.
pub(crate) fn name_length(text: &str) -> usize {
    text.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '\''))
        .unwrap_or(text.len())
}

fn place(token: Token, start: usize, length: usize) -> Lexeme {
    let end = start + length;
    Lexeme {
        token,
        span: Span { start, end },
    }
}

fn bad(start: usize, length: usize, message: String, hint: Option<String>) -> Lexeme {
    let span = Span {
        start,
        end: start + length,
    };
    let diagnostic = Diagnostic {
        span,
        message,
        hint,
    };
    place(Token::Bad(Box::new(diagnostic)), start, length)
}

fn digits(text: &str) -> usize {
    text.find(|c: char| !c.is_ascii_digit())
        .unwrap_or(text.len())
}

fn number(rest: &str, start: usize) -> Lexeme {
    let mut length = digits(rest);
    if let Some(fraction) = rest[length..].strip_prefix('.') {
        let places = digits(fraction);
        if places > 0 {
            length += 1 + places;
        } else if !fraction.starts_with('.') {
            let hint = format!("write `{}` or `{}.0`", &rest[..length], &rest[..length]);
            let message = "digits are missing after the decimal point".to_string();
            return bad(start, length + 1, message, Some(hint));
        }
    }
    let after = &rest[length..];
    if after.starts_with(is_name_start) {
        return juxtaposed(&rest[..length], &after[..name_length(after)], start);
    }
    place(Token::Number, start, length)
}

/// `2k`, `1e10`
fn juxtaposed(number: &str, name: &str, start: usize) -> Lexeme {
    let power = name.strip_prefix(['e', 'E']).filter(|digits| {
        !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit()) && digits.len() < 40
    });
    let hint = match power {
        Some(power) => format!("write `{}*10^{power}`", shortened(number)),
        None => format!("write `{}*{}`", shortened(number), shortened(name)),
    };
    let message = "a number stands against a name: a product is written with `*`".to_string();
    bad(start, number.len() + name.len(), message, Some(hint))
}

/// At most 40 bytes of a text that is ASCII.
fn shortened(text: &str) -> &str {
    &text[..text.len().min(40)]
}

fn foreign(rest: &str, start: usize) -> Option<Lexeme> {
    let (other, ours) = FOREIGN.iter().find(|(other, _)| rest.starts_with(other))?;
    let message = format!("`{other}` is not of this language");
    Some(bad(
        start,
        other.len(),
        message,
        Some(format!("write `{ours}`")),
    ))
}

fn stranger(rest: &str, first: char, start: usize) -> Lexeme {
    let length = first.len_utf8();
    if let Some((_, ours)) = TYPOGRAPHIC.iter().find(|(c, _)| *c == first) {
        let message = format!("the character `{first}` is not of this language");
        return bad(start, length, message, Some(format!("write `{ours}`")));
    }
    if let Some(plain) = halfwidth(first) {
        let message = format!("`{first}` is a fullwidth character");
        return bad(start, length, message, Some(format!("write `{plain}`")));
    }
    if first == '.' {
        let places = digits(&rest[1..]);
        let hint = (places > 0).then(|| format!("write `0.{}`", shortened(&rest[1..1 + places])));
        let message = "a number begins with a digit".to_string();
        return bad(start, 1, message, hint);
    }
    let hint = match first {
        '\\' | '$' => Some("formulas are written as plain text, not in LaTeX".to_string()),
        '"' | '`' | '#' | '@' | '?' => None,
        c if c.is_whitespace() => Some("write a plain space".to_string()),
        c if c.is_alphabetic() => Some("names are made of the letters a-z, A-Z".to_string()),
        _ => None,
    };
    let message = format!(
        "the character `{}` has no meaning here",
        first.escape_debug()
    );
    bad(start, length, message, hint)
}

fn halfwidth(c: char) -> Option<char> {
    let code = u32::from(c);
    (0xFF01..=0xFF5E)
        .contains(&code)
        .then(|| char::from_u32(code - 0xFEE0))
        .flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<(Token, &str)> {
        let mut at = 0;
        let mut found = Vec::new();
        loop {
            let lexeme = lex(text, at);
            if lexeme.token == Token::End {
                return found;
            }
            at = lexeme.span.end;
            found.push((lexeme.token, &text[lexeme.span.start..lexeme.span.end]));
        }
    }

    #[test]
    fn ranges_are_no_decimals() {
        let words: Vec<_> = tokens("0..1.5 n!==2 x->0+")
            .into_iter()
            .map(|t| t.1)
            .collect();
        let expected = ["0", "..", "1.5", "n", "!", "==", "2", "x", "->", "0", "+"];
        assert_eq!(words, expected);
    }

    #[test]
    fn typographic_characters_name_their_spelling() {
        for (c, ours) in TYPOGRAPHIC {
            let Token::Bad(error) = lex(&c.to_string(), 0).token else {
                panic!("{c} should be refused");
            };
            assert!(error.hint.is_some_and(|hint| hint.contains(ours)));
        }
    }
}
