//! Plain text inside LaTeX.

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
            _ => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::escape;

    #[test]
    fn nothing_is_a_command() {
        assert_eq!(
            escape(r"a_1^2 \ {x} -> 5%"),
            r"a\_1\textasciicircum{}2 \textbackslash{} \{x\} -{}>{} 5\%"
        );
    }
}
