//! Markdown to fenced blocks and their logical lines.
//!
//! The CommonMark library says where the text of a fence stands, piece by piece; a fence may lie in
//! a quotation or a list. A line that begins with white space continues the one above. What stands
//! between the pieces of a logical line (`> `, indentation) is blanked out, so that every byte of its
//! text keeps its distance from the first: places in the text are places in the file.

use crate::formula::{Diagnostic, Name, Span, nearest, parser::id_length};
use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};
use std::borrow::Cow;
use std::ops::Range;

/// A `claim ID` or `define NAME` fence.
#[derive(Debug)]
pub(super) struct Block<'t> {
    pub kind: BlockKind,
    pub name: Name,
    /// The fence line's words.
    pub span: Span,
    pub lines: Vec<LogicalLine<'t>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BlockKind {
    Claim,
    Define,
}

/// A keyword and what follows it, continuations included.
#[derive(Debug)]
pub(super) struct LogicalLine<'t> {
    pub keyword: Span,
    /// What follows the keyword.
    pub text: Cow<'t, str>,
    /// Where `text` begins in the file.
    pub start: usize,
}

/// The blocks of a file, and what is wrong with their fences.
pub(super) fn blocks(text: &str) -> (Vec<Block<'_>>, Vec<Diagnostic>) {
    let mut found = Vec::new();
    let mut errors = Vec::new();
    let mut open: Option<Fence> = None;
    for (event, range) in Parser::new_ext(text, Options::empty()).into_offset_iter() {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                open = fence(text, &info, range).unwrap_or_else(|error| {
                    errors.push(error);
                    None
                });
            }
            Event::Text(_) => {
                if let Some(fence) = &mut open {
                    fence.pieces.push(range);
                }
            }
            Event::End(TagEnd::CodeBlock) => {
                if let Some(fence) = open.take() {
                    errors.extend(unclosed(text, &fence));
                    match logical_lines(text, &fence.pieces) {
                        Ok(lines) => found.push(Block {
                            kind: fence.kind,
                            name: fence.name,
                            span: fence.span,
                            lines,
                        }),
                        Err(error) => errors.push(error),
                    }
                }
            }
            _ => (),
        }
    }
    (found, errors)
}

/// A fence while its text is read.
struct Fence {
    kind: BlockKind,
    name: Name,
    span: Span,
    whole: Range<usize>,
    pieces: Vec<Range<usize>>,
}

/// The fence with these words after its backticks, if it is one of ours.
fn fence(text: &str, info: &str, whole: Range<usize>) -> Result<Option<Fence>, Diagnostic> {
    let mut words = info.split_whitespace();
    let Some(first) = words.next() else {
        return Ok(None);
    };
    let span = first_line(text, &whole);
    let error = |message: String, hint: Option<String>| Diagnostic {
        span,
        message,
        hint,
    };
    let kind = match first {
        "claim" => BlockKind::Claim,
        "define" => BlockKind::Define,
        other => {
            return match nearest(other, ["claim", "define"]) {
                Some(near) => Err(error(
                    format!("a block of an unknown kind: `{}`", clip(other)),
                    Some(format!("write `{near}`")),
                )),
                None => Ok(None),
            };
        }
    };
    let name = words.next().unwrap_or("");
    if name.is_empty() || id_length(name) != name.len() || words.next().is_some() {
        let message = format!("`{first}` is followed by one id");
        let hint = "an id is made of letters, digits, `.` and `-`: `2.103-strategy-2`";
        return Err(error(message, Some(hint.to_string())));
    }
    Ok(Some(Fence {
        kind,
        name: name.into(),
        span,
        whole,
        pieces: Vec::new(),
    }))
}

fn first_line(text: &str, range: &Range<usize>) -> Span {
    let line = text[range.clone()].lines().next().unwrap_or("");
    Span {
        start: range.start,
        end: range.start + line.len(),
    }
}

/// A fence that the end of the file closes has swallowed all that follows.
fn unclosed(text: &str, fence: &Fence) -> Option<Diagnostic> {
    let mut lines = text[fence.whole.clone()].lines();
    let first = lines.next();
    let closes = |line: &str| {
        let line = line.trim_matches(|c: char| c.is_whitespace() || c == '>');
        line.len() >= 3 && (line.chars().all(|c| c == '`') || line.chars().all(|c| c == '~'))
    };
    if first.is_some() && lines.next_back().is_some_and(closes) {
        return None;
    }
    Some(Diagnostic {
        span: fence.span,
        message: format!("the block `{}` is never closed", fence.name),
        hint: Some("end it with a line of three backticks".to_string()),
    })
}

fn clip(text: &str) -> String {
    text.chars().take(40).collect()
}

/// The lines of the pieces: ranges of the file without line ends.
fn physical_lines(text: &str, pieces: &[Range<usize>]) -> Vec<Range<usize>> {
    let mut lines = Vec::new();
    let mut current: Option<Range<usize>> = None;
    for piece in pieces {
        let mut start = piece.start;
        for part in text[piece.clone()].split_inclusive('\n') {
            let end = start + part.len();
            let line = current.get_or_insert(start..start);
            line.end = end - (part.len() - part.trim_end_matches(['\r', '\n']).len());
            if part.ends_with('\n') {
                lines.extend(current.take());
            }
            start = end;
        }
    }
    lines.extend(current);
    lines
}

fn logical_lines<'t>(
    text: &'t str,
    pieces: &[Range<usize>],
) -> Result<Vec<LogicalLine<'t>>, Diagnostic> {
    let mut groups: Vec<Vec<Range<usize>>> = Vec::new();
    for line in physical_lines(text, pieces) {
        let content = &text[line.clone()];
        if content.trim().is_empty() {
            continue;
        }
        if !content.starts_with([' ', '\t']) {
            groups.push(vec![line]);
        } else if let Some(group) = groups.last_mut() {
            group.push(line);
        } else {
            return Err(Diagnostic {
                span: Span {
                    start: line.start,
                    end: line.end,
                },
                message: "an indented line continues the one above, but there is none".to_string(),
                hint: None,
            });
        }
    }
    Ok(groups.iter().map(|group| logical(text, group)).collect())
}

fn logical<'t>(text: &'t str, group: &[Range<usize>]) -> LogicalLine<'t> {
    let first = group[0].clone();
    let line = &text[first.clone()];
    let length = line.find(char::is_whitespace).unwrap_or(line.len());
    let keyword = Span {
        start: first.start,
        end: first.start + length,
    };
    let end = group.last().map_or(first.end, |line| line.end);
    LogicalLine {
        keyword,
        text: blanked(text, group, keyword.end..end),
        start: keyword.end,
    }
}

/// The text of the range, with all but white space blanked out between the lines of the group.
fn blanked<'t>(text: &'t str, group: &[Range<usize>], range: Range<usize>) -> Cow<'t, str> {
    let gaps = group.windows(2).map(|pair| pair[0].end..pair[1].start);
    if gaps.clone().all(|gap| text[gap].trim().is_empty()) {
        return Cow::Borrowed(&text[range]);
    }
    let mut result = String::with_capacity(range.len());
    let mut at = range.start;
    for gap in gaps {
        result.push_str(&text[at..gap.start]);
        result.push_str(&" ".repeat(gap.len()));
        at = gap.end;
    }
    result.push_str(&text[at..range.end]);
    Cow::Owned(result)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<(String, String)> {
        let (blocks, errors) = blocks(text);
        assert_eq!(errors, []);
        let lines = blocks.iter().flat_map(|block| &block.lines);
        lines
            .map(|line| {
                let words: Vec<_> = line.text.split_whitespace().collect();
                assert!(text[line.start..].starts_with(line.text.split('\n').next().unwrap_or("")));
                (
                    text[line.keyword.start..line.keyword.end].to_string(),
                    words.join(" "),
                )
            })
            .collect()
    }

    #[test]
    fn continuations_quotations_and_carriage_returns() {
        let expected = [("given", "int k"), ("says", "a == b + c")];
        for text in [
            "```claim 2.1\ngiven int k\nsays a ==\n  b\n\n  + c\n```\n",
            "> ```claim 2.1\n> given int k\n> says a ==\n>   b\n>   + c\n> ```\n",
            "* x\n\n  ```claim 2.1\n  given int k\n  says a ==\n    b\n    + c\n  ```\n",
            "```claim 2.1\r\ngiven int k\r\nsays a ==\r\n  b\r\n  + c\r\n```\r\n",
        ] {
            let found = words(text);
            let found: Vec<_> = found.iter().map(|(a, b)| (&**a, &**b)).collect();
            assert_eq!(found, expected, "{text:?}");
        }
    }

    #[test]
    fn faulty_fences() {
        for (text, message) in [
            ("```claim\nsays words\n```", "`claim` is followed by one id"),
            (
                "```claim 2.1 x\nsays words\n```",
                "`claim` is followed by one id",
            ),
            (
                "```clam 2.1\nsays words\n```",
                "a block of an unknown kind: `clam`",
            ),
            (
                "```claim 2.1\nsays words\n",
                "the block `2.1` is never closed",
            ),
            (
                "```claim 2.1\n  says words\n```",
                "an indented line continues the one above, but there is none",
            ),
        ] {
            let (_, errors) = blocks(text);
            assert_eq!(errors.first().map(|e| &*e.message), Some(message));
        }
    }
}
