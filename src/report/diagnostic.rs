//! Errors with their place: file, line and column, the text with a caret, a hint.

use crate::formula::Diagnostic;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

/// An error in the text of a file, or in an argument (then `path` names the argument).
pub fn render(path: &str, source: &str, diagnostic: &Diagnostic) -> String {
    let (start, end) = within(source, diagnostic.span.start, diagnostic.span.end);
    let snippet = Snippet::source(source)
        .path(path)
        .annotation(AnnotationKind::Primary.span(start..end));
    let message = printable(&diagnostic.message);
    let mut group = Level::ERROR.primary_title(&message).element(snippet);
    let hint = diagnostic.hint.as_deref().map(printable);
    if let Some(hint) = &hint {
        group = group.element(Level::HELP.message(hint));
    }
    Renderer::styled().render(&[group])
}

/// An error without a text to point at.
pub fn plain(message: &str, hint: Option<&str>) -> String {
    let message = printable(message);
    let mut group = annotate_snippets::Group::with_title(Level::ERROR.primary_title(&message));
    let hint = hint.map(printable);
    if let Some(hint) = &hint {
        group = group.element(Level::HELP.message(hint));
    }
    Renderer::styled().render(&[group])
}

/// The span cut to the text, its ends moved outwards to character boundaries.
fn within(source: &str, start: usize, end: usize) -> (usize, usize) {
    let mut start = start.min(source.len());
    let mut end = end.clamp(start, source.len());
    while !source.is_char_boundary(start) {
        start -= 1;
    }
    while !source.is_char_boundary(end) {
        end += 1;
    }
    (start, end)
}

/// A file may hold anything; a terminal must not be steered by it.
fn printable(text: &str) -> String {
    let keep = |c: char| c == '\n' || !c.is_control();
    text.chars()
        .map(|c| if keep(c) { c } else { '\u{fffd}' })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Span;

    fn plainly(text: &str) -> String {
        anstream::adapter::strip_str(text).to_string()
    }

    fn error(start: usize, end: usize) -> Diagnostic {
        Diagnostic {
            span: Span { start, end },
            message: "expected an operator".into(),
            hint: Some("write 2*k".into()),
        }
    }

    #[test]
    fn shows_place_caret_and_hint() {
        let text = plainly(&render("a.md", "says\n2k == 3\n", &error(6, 7)));
        assert!(text.contains("error: expected an operator"), "{text}");
        assert!(text.contains("a.md:2:2"), "{text}");
        assert!(text.contains("2k == 3"), "{text}");
        assert!(text.contains(" ^"), "{text}");
        assert!(text.contains("help: write 2*k"), "{text}");
    }

    #[test]
    fn any_span_of_any_text_is_shown() {
        for source in ["", "é", "\n", "a\r\n\u{1b}[31mb", "π == ∞"] {
            for start in 0..source.len() + 3 {
                for end in 0..source.len() + 3 {
                    let text = plainly(&render("x", source, &error(start, end)));
                    assert!(text.contains("expected an operator"));
                    assert!(!text.contains('\u{1b}'));
                }
            }
        }
    }

    #[test]
    fn plain_errors_have_hints_too() {
        assert_eq!(
            plainly(&plain("no", Some("yes"))),
            "error: no\n |\n = help: yes"
        );
    }
}
