//! Words on a page: how wide they are, where they break, and how XML holds them.

use std::fmt::Write;

pub(super) fn text(out: &mut String, x: f64, y: f64, attributes: &str, words: &str) {
    let _ = writeln!(
        out,
        "<text x=\"{x}\" y=\"{y}\" {attributes}>{}</text>",
        escaped(words)
    );
}

/// Lines of so many letters at most, broken at spaces where there are any.
pub(super) fn broken(words: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words.split(' ') {
        let line = lines.last_mut();
        match line {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The words, or as many letters of them as fit.
pub(super) fn shortened(words: &str, most: usize) -> String {
    match words.chars().count() <= most {
        true => words.to_owned(),
        false => words
            .chars()
            .take(most.saturating_sub(1))
            .chain(['\u{2026}'])
            .collect(),
    }
}

/// The words, or as many letters of them as fit so many pixels.
pub(super) fn fitted(words: &str, size: f64, room: f64) -> String {
    if width(words, size) <= room {
        return words.to_owned();
    }
    let mut end = breadth('\u{2026}') * size;
    let fitting = words.chars().take_while(|letter| {
        end += breadth(*letter) * size;
        end <= room
    });
    fitting.chain(['\u{2026}']).collect()
}

/// For XML: what it cannot hold is dropped.
pub(super) fn escaped(words: &str) -> String {
    let mut text = String::new();
    for letter in words.chars() {
        match letter {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            // No letters of XML 1.0.
            letter if letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}') => {
                text.push(' ');
            }
            letter => text.push(letter),
        }
    }
    text
}

/// About so many pixels wide, in letters of this size; rather too many.
pub(super) fn width(words: &str, size: f64) -> f64 {
    words.chars().map(breadth).sum::<f64>() * size
}

/// The breadth of a letter of DejaVu Sans, the broadest of the fonts asked for but Verdana, as a share of its size.
fn breadth(letter: char) -> f64 {
    match letter {
        'i' | 'j' | 'l' | 'I' | '|' | '\'' => 0.3,
        'c' | 's' | 'z' => 0.55,
        'k' | 'v' | 'x' | 'y' => 0.6,
        ' ' | '.' | ',' | ':' | ';' => 0.33,
        'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '-' | '/' => 0.41,
        'm' | 'w' | 'M' | 'W' | '%' | '\u{2026}' => 0.98,
        '\u{2212}' | '+' | '=' | '<' | '>' => 0.84,
        'A'..='Z' => 0.72,
        _ => 0.64,
    }
}
