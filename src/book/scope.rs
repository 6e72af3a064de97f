//! A claim's lines to a [`Claim`]: its scope, in which a name is declared once and before it is used.

use super::line::{Item, Keyword, Line};
use super::resolve::{Symbol, Symbols, of_definition, of_parameter};
use super::unfold::has_expansion;
use super::{Claim, Needs, Scope};
use crate::formula::parser::{Given, Mention};
use crate::formula::{Diagnostic, Draw, Name, Span, Statement};
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// Where the symbols of a claim's statements stand, and the claim that `ID if COND` is about.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Places {
    pub(super) says: Place,
    pub(super) mend: Option<Place>,
    pub(super) needs: Option<Place>,
    pub(super) target: Option<Arc<Claim>>,
}

/// A line's bytes in the claim's file, and the symbols in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Place {
    pub span: Span,
    pub mentions: Vec<Mention>,
}

/// Where a claim stands.
pub(super) struct Header<'a> {
    pub id: &'a Name,
    pub file: usize,
    pub path: &'a Path,
    /// The line of the fence, from 1.
    pub line: usize,
    /// The bytes of the fence line.
    pub span: Span,
}

/// An error with the number of its file.
pub(super) type Located = (usize, Diagnostic);

/// Builds the claim from its lines, `use` and `same` resolved.
pub(super) fn claim(header: &Header<'_>, lines: &[Arc<Line>]) -> Result<Claim, Vec<Located>> {
    let mut builder = Builder::default();
    let mut errors = Vec::new();
    for line in lines {
        if let Err(error) = builder.declare(line) {
            errors.push((line.file, error));
        }
    }
    let find = |keyword| lines.iter().find(|line| line.keyword == keyword);
    let Some(says) = find(Keyword::Says) else {
        let error = Diagnostic {
            span: header.span,
            message: format!("the claim `{}` has no `says` line", header.id),
            hint: None,
        };
        errors.push((header.file, error));
        return Err(errors);
    };
    let Item::Says(statement) = &says.item else {
        return Err(errors);
    };
    let mut claim = Claim {
        id: header.id.clone(),
        file: header.path.to_path_buf(),
        line: header.line,
        scope: builder.scope,
        says: statement.clone(),
        says_text: says.text.clone(),
        mend: None,
        mend_text: None,
        needs: None,
        after: None,
        read: None,
        page: None,
        quote: None,
        slip: None,
        scan: None,
        like: None,
        why: None,
        expect: None,
        expect_text: None,
        places: Places::default(),
    };
    for line in lines {
        fill(&mut claim, line, header);
    }
    errors.extend(contradictions(&claim, lines));
    match errors.is_empty() {
        true => Ok(claim),
        false => Err(errors),
    }
}

/// The line's place in the claim's file: of a line taken over from another file, the fence.
fn place(line: &Line, header: &Header<'_>) -> Place {
    let mut place = Place {
        span: line.span,
        mentions: line.mentions.clone(),
    };
    if line.file != header.file {
        place.span = header.span;
        for mention in &mut place.mentions {
            mention.span = header.span;
        }
    }
    place
}

fn fill(claim: &mut Claim, line: &Line, header: &Header<'_>) {
    match &line.item {
        Item::Says(_) => claim.places.says = place(line, header),
        Item::Mend(statement) => {
            claim.mend = Some(statement.clone());
            claim.mend_text = Some(line.text.clone());
            claim.places.mend = Some(place(line, header));
        }
        Item::Needs {
            condition,
            text,
            sufficient,
        } => {
            claim.needs = Some(Needs {
                condition: condition.clone(),
                text: text.clone(),
                sufficient: *sufficient,
            });
            claim.places.needs = Some(place(line, header));
        }
        Item::After(id) => claim.after = Some(id.clone()),
        Item::Read(regime) => claim.read = Some(regime.clone()),
        Item::Page(page) => claim.page = Some(page.clone()),
        Item::Quote(words) => claim.quote = Some(words.clone()),
        Item::Slip(words) => claim.slip = Some(words.clone()),
        Item::Scan(words) => claim.scan = Some(words.clone()),
        Item::Like(id) => claim.like = Some(id.clone()),
        Item::Why(words) => claim.why = Some(words.clone()),
        Item::Expect(expect) => {
            claim.expect = Some(expect.clone());
            claim.expect_text = Some(line.text.clone());
        }
        Item::Given(_) | Item::Draw(_) | Item::Let(..) | Item::Use(_) | Item::Same(_) => (),
    }
}

/// Lines that cannot stand together.
fn contradictions(claim: &Claim, lines: &[Arc<Line>]) -> Vec<Located> {
    let mut errors = Vec::new();
    let mut refuse = |keyword: Keyword, message: &str| {
        if let Some(line) = lines.iter().find(|line| line.keyword == keyword) {
            let error = Diagnostic {
                span: line.span,
                message: message.to_string(),
                hint: None,
            };
            errors.push((line.file, error));
        }
    };
    let expects_mended = claim.expect.as_ref().is_some_and(|e| e.mended.is_some());
    if expects_mended && claim.mend.is_none() && claim.needs.is_none() {
        refuse(
            Keyword::Expect,
            "a verdict on the mended statement is expected, but there is neither `mend` nor `needs`",
        );
    }
    let expands = has_expansion(&claim.says) || claim.mend.as_ref().is_some_and(has_expansion);
    if claim.read.is_some() && !expands {
        refuse(Keyword::Read, "there is no expansion that could be read so");
    }
    if matches!(claim.says, Statement::Conditional { .. }) {
        for keyword in [Keyword::Given, Keyword::Draw, Keyword::Let] {
            refuse(
                keyword,
                "`ID if COND` has the scope of ID, and no declarations of its own",
            );
        }
    }
    errors
}

/// A scope under construction.
#[derive(Default)]
struct Builder {
    scope: Scope,
    symbols: Symbols,
}

impl Builder {
    fn declare(&mut self, line: &Line) -> Result<(), Diagnostic> {
        match &line.item {
            Item::Given(given) => self.given(given, &line.mentions),
            Item::Draw(draws) => {
                self.symbols.check(&line.mentions)?;
                for (draw, span) in draws {
                    self.new_name(&draw.name, *span, Symbol::Draw)?;
                    self.scope.draws.push(Draw::clone(draw));
                }
                Ok(())
            }
            Item::Let(definition, span) => {
                self.symbols.check(&line.mentions)?;
                self.new_name(&definition.name, *span, of_definition(definition))?;
                self.scope.definitions.push(definition.clone());
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Within the line, too, a name is declared before it is used.
    fn given(&mut self, given: &Given, mentions: &[Mention]) -> Result<(), Diagnostic> {
        let mut places = HashMap::new();
        for (parameter, span) in &given.parameters {
            self.new_name(&parameter.name, *span, of_parameter(parameter))?;
            places.insert(parameter.name.clone(), *span);
            self.scope.parameters.push(parameter.clone());
        }
        for mention in mentions {
            self.symbols.check_one(mention)?;
            let declared = places.get(&mention.name);
            if declared.is_some_and(|span| span.start > mention.span.start) {
                return Err(Diagnostic {
                    span: mention.span,
                    message: format!("`{}` is used before it is declared", mention.name),
                    hint: None,
                });
            }
        }
        self.scope.domain.extend(given.domain.iter().cloned());
        Ok(())
    }

    fn new_name(&mut self, name: &Name, span: Span, symbol: Symbol) -> Result<(), Diagnostic> {
        if self.symbols.declare(name.clone(), symbol) {
            return Ok(());
        }
        Err(Diagnostic {
            span,
            message: format!("the name `{name}` is declared already"),
            hint: Some("a name is declared once in a claim".to_string()),
        })
    }
}
