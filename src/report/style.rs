//! Colours and line breaks of text for people.

/// Columns of a terminal that a report may fill.
pub(super) const WIDTH: usize = 100;

/// Terminal styles, as the numbers of ECMA-48's SGR.
pub(super) const FAINT: &str = "2";
pub(super) const STRONG: &str = "1";

/// The text in a style.
pub(super) fn paint(style: &str, text: &str) -> String {
    format!("\u{1b}[{style}m{text}\u{1b}[0m")
}

/// Breaks a text into lines of so many characters: at spaces, or in a formula without any behind a
/// sign, or anywhere.
pub(super) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut rest: Vec<char> = text.chars().collect();
    let mut lines = Vec::new();
    while rest.len() > width {
        let at = break_of(&rest[..=width.max(1)]);
        let tail = rest.split_off(at);
        lines.push(rest.iter().collect::<String>().trim_end().to_owned());
        rest = tail.into_iter().skip_while(|c| *c == ' ').collect();
    }
    lines.push(rest.into_iter().collect());
    lines
}

/// Where a line ends that is one character too long; not at its very beginning.
fn break_of(line: &[char]) -> usize {
    let last = line.len() - 1;
    let space = (1..=last).rev().find(|at| line[*at] == ' ');
    let sign = |at: &usize| "*/+-,^(".contains(line[at - 1]);
    // A space near the beginning would leave most of the line empty.
    let space = space.filter(|at| 2 * at > last);
    space
        .or_else(|| (1..=last).rev().find(sign))
        .unwrap_or(last)
}

#[cfg(test)]
mod tests {
    use super::wrap;

    #[test]
    fn lines_break_at_spaces_or_else_behind_signs() {
        assert_eq!(wrap("a + b == c", 6), ["a + b", "== c"]);
        assert_eq!(wrap("(a*b*c)/gamma(k)", 9), ["(a*b*c)/", "gamma(k)"]);
        assert_eq!(wrap("abcdefgh", 3), ["abc", "def", "gh"]);
        assert_eq!(wrap("", 3), [""]);
        assert_eq!(wrap("abc", 3), ["abc"]);
        let long = "x^(k - 1)*(1 - x)^(n - k)/beta(k, n - k + 1) + ".repeat(9);
        for width in 1..40 {
            let lines = wrap(&long, width);
            assert!(lines.iter().all(|line| line.chars().count() <= width));
            let joined = lines.concat().replace(' ', "");
            assert_eq!(joined, long.replace(' ', ""));
        }
    }
}
