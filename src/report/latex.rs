//! Plain text inside LaTeX.

/// A document's beginning. It needs amsmath only; formulas may be longer than a line, so lines may be
/// loose.
pub(super) const HEAD: &str = "\\documentclass{article}\n\
    \\usepackage[T1]{fontenc}\n\
    \\usepackage[utf8]{inputenc}\n\
    \\usepackage{amsmath}\n\
    \\begin{document}\n\
    \\sloppy\\raggedright\n";

/// The text with every character that TeX reads as a command made printable.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => escaped.push_str("\\textbackslash{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(c);
            }
            // `--`, `<<` and the like would become ligatures.
            '-' | '<' | '>' => {
                escaped.push(c);
                escaped.push_str("{}");
            }
            // In an optional argument a bracket would end it.
            '[' | ']' => {
                escaped.push('{');
                escaped.push(c);
                escaped.push('}');
            }
            _ if c == ' ' || c.is_ascii_graphic() || is_known(c) => escaped.push(c),
            _ if c.is_whitespace() => escaped.push(' '),
            _ => match MATHEMATICAL.iter().find(|(sign, _)| *sign == c) {
                Some((_, command)) => escaped.push_str(&format!("${command}$")),
                None => escaped.push_str(&format!("{{[}}U+{:04X}{{]}}", u32::from(c))),
            },
        }
    }
    escaped
}

/// Letters of western languages, quotes and dashes: LaTeX sets these as they are.
fn is_known(c: char) -> bool {
    matches!(c, 'À'..='Ö' | 'Ø'..='ö' | 'ø'..='ÿ' | '‘' | '’' | '“' | '”' | '„' | '–' | '—' | '…')
}

/// Signs that stand in words about formulas.
const MATHEMATICAL: [(char, &str); 22] = [
    ('≤', "\\le"),
    ('≥', "\\ge"),
    ('≠', "\\ne"),
    ('≈', "\\approx"),
    ('∼', "\\sim"),
    ('→', "\\to"),
    ('∞', "\\infty"),
    ('·', "\\cdot"),
    ('×', "\\times"),
    ('−', "-"),
    ('±', "\\pm"),
    ('²', "^2"),
    ('³', "^3"),
    ('√', "\\surd"),
    ('∑', "\\sum"),
    ('∫', "\\int"),
    ('∈', "\\in"),
    ('Γ', "\\Gamma"),
    ('π', "\\pi"),
    ('σ', "\\sigma"),
    ('μ', "\\mu"),
    ('φ', "\\varphi"),
];

#[cfg(test)]
mod tests {
    use super::escape;

    #[test]
    fn nothing_is_a_command() {
        assert_eq!(
            escape(r"a_1^2 \ {x} -> 5%"),
            r"a\_1\textasciicircum{}2 \textbackslash{} \{x\} -{}>{} 5\%"
        );
        assert_eq!(escape("é ≤ \u{4e2d} [1]"), "é $\\le$ {[}U+4E2D{]} {[}1{]}");
    }
}
