//! Files to a [`Book`]: finding chapters, `use`, `same`, ids.

use super::files::{chapters, load};
use super::line::{Item, Keyword, Line, line};
use super::markdown::{Block, BlockKind, blocks};
use super::scope::{Header, Located, claim};
use super::{Book, Claim};
use crate::formula::{Diagnostic, Duty, Name, Span, Statement, nearest};
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

/// How many errors are told before reading is given up.
const MAX_ERRORS: usize = 1000;
/// How many lines a claim may have, `use` and `same` resolved.
const MAX_LINES: usize = 1000;
/// How many `same` may follow one another.
const MAX_SAME: usize = 16;

/// What is wrong with a file, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}: {diagnostic}", file.display())]
pub struct FileError {
    pub file: PathBuf,
    /// The text that the span points into; empty where the file could not be read.
    pub text: Arc<str>,
    pub diagnostic: Diagnostic,
}

/// Reads files, and folders with all their chapters (`.md`) in sorted order, but for folders called
/// `certificates` and hidden ones.
///
/// # Errors
/// All that is wrong with the files, at most a thousand things. A statement that is ill-typed is no
/// error here: that is a verdict.
pub fn read(paths: &[PathBuf]) -> Result<Book, Vec<FileError>> {
    let mut errors = Vec::new();
    let mut files = Vec::new();
    for path in paths {
        chapters(path, &mut files, &mut errors);
    }
    let mut seen = HashSet::new();
    files.retain(|path| seen.insert(path.clone()));
    let mut sources = Vec::new();
    for path in files {
        match load(&path) {
            Ok(text) => sources.push(Source { path, text }),
            Err(error) => errors.push(error),
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    assemble(&sources)
}

/// Reads one text as the file `name`.
///
/// # Errors
/// As [`read`].
pub fn read_text(name: impl Into<PathBuf>, text: &str) -> Result<Book, Vec<FileError>> {
    assemble(&[Source {
        path: name.into(),
        text: text.into(),
    }])
}

struct Source {
    path: PathBuf,
    text: Arc<str>,
}

/// A block with its lines read.
struct Raw {
    name: Name,
    file: usize,
    /// The line of the fence, from 1.
    line: usize,
    span: Span,
    lines: Vec<Arc<Line>>,
    /// Whether an error in it was told, so that nothing more is said of what follows from it.
    broken: bool,
}

/// All blocks of a read.
struct Reader<'s> {
    sources: &'s [Source],
    claims: Vec<Raw>,
    defines: Vec<Raw>,
    errors: Vec<Located>,
}

fn assemble(sources: &[Source]) -> Result<Book, Vec<FileError>> {
    let mut reader = Reader {
        sources,
        claims: Vec::new(),
        defines: Vec::new(),
        errors: Vec::new(),
    };
    for file in 0..sources.len() {
        reader.chapter(file);
    }
    let claims = reader.claims();
    match reader.errors.is_empty() {
        true => Ok(Book { claims }),
        false => Err(reader.told()),
    }
}

impl Reader<'_> {
    fn full(&self) -> bool {
        self.errors.len() >= MAX_ERRORS
    }

    /// The errors in the order of files and places.
    fn told(mut self) -> Vec<FileError> {
        self.errors
            .sort_by_key(|(file, error)| (*file, error.span.start));
        self.errors.dedup();
        self.errors.truncate(MAX_ERRORS);
        let tell = |(file, diagnostic): Located| FileError {
            file: self.sources[file].path.clone(),
            text: self.sources[file].text.clone(),
            diagnostic,
        };
        self.errors.into_iter().map(tell).collect()
    }

    fn error(&mut self, file: usize, span: Span, message: String, hint: Option<String>) {
        let diagnostic = Diagnostic {
            span,
            message,
            hint,
        };
        self.errors.push((file, diagnostic));
    }

    // ---- blocks

    fn chapter(&mut self, file: usize) {
        let text = &*self.sources[file].text;
        let (blocks, errors) = blocks(text);
        self.errors
            .extend(errors.into_iter().map(|error| (file, error)));
        let mut counted = (0, 1);
        for block in blocks {
            let lines = text[counted.0..block.span.start].matches('\n').count();
            counted = (block.span.start, counted.1 + lines);
            if self.full() {
                return;
            }
            self.block(file, text, &block, counted.1);
        }
    }

    fn block(&mut self, file: usize, text: &str, block: &Block<'_>, number: usize) {
        let before = self.errors.len();
        let mut lines: Vec<Arc<Line>> = Vec::new();
        let mut single: HashSet<Keyword> = HashSet::new();
        for source in &block.lines {
            let word = &text[source.keyword.start..source.keyword.end];
            match line(source, word, file) {
                Err(error) => self.errors.push((file, error)),
                Ok(line) => {
                    self.check_line(block, &line, &mut single);
                    lines.push(Arc::new(line));
                }
            }
            if self.full() {
                break;
            }
        }
        let raw = Raw {
            name: block.name.clone(),
            file,
            line: number,
            span: block.span,
            lines,
            broken: self.errors.len() > before,
        };
        match block.kind {
            BlockKind::Claim => self.claims.push(raw),
            BlockKind::Define => self.defines.push(raw),
        }
    }

    fn check_line(&mut self, block: &Block<'_>, line: &Line, single: &mut HashSet<Keyword>) {
        let word = line.keyword.word();
        if !line.keyword.repeats() && !single.insert(line.keyword) {
            let message = format!("a second `{word}` line in one claim");
            let hint = (line.keyword == Keyword::Says)
                .then(|| "join statements by `and`, or give the part an id of its own".to_string());
            self.error(line.file, line.span, message, hint);
        }
        let declares = [Keyword::Given, Keyword::Draw, Keyword::Let];
        if block.kind == BlockKind::Define && !declares.contains(&line.keyword) {
            let message = "a `define` block holds `given`, `draw` and `let` lines".to_string();
            self.error(line.file, line.span, message, None);
        }
    }

    // ---- claims

    fn claims(&mut self) -> Vec<Claim> {
        let ids = self.unique_ids();
        let defines = self.unique_defines();
        let mut resolved: Vec<Option<Resolved>> = (0..self.claims.len()).map(|_| None).collect();
        let mut claims = Vec::new();
        for index in 0..self.claims.len() {
            if self.full() {
                return Vec::new();
            }
            self.resolve(index, &ids, &mut resolved);
            let lines = match &resolved[index] {
                Some(Resolved::Lines(lines, _)) => lines.clone(),
                _ => continue,
            };
            let Some(lines) = self.with_defines(index, &lines, &defines) else {
                continue;
            };
            let raw = &self.claims[index];
            let header = Header {
                id: &raw.name,
                file: raw.file,
                path: &self.sources[raw.file].path,
                line: raw.line,
                span: raw.span,
            };
            match claim(&header, &lines) {
                Ok(claim) => {
                    self.references(&lines, &claim, &ids);
                    claims.push(claim);
                }
                Err(errors) => self.errors.extend(errors),
            }
        }
        if self.errors.is_empty() {
            self.targets(&mut claims);
        }
        claims
    }

    fn unique_ids(&mut self) -> HashMap<Name, usize> {
        let mut ids = HashMap::new();
        let mut twice = Vec::new();
        for (index, raw) in self.claims.iter().enumerate() {
            if let Some(first) = ids.insert(raw.name.clone(), index) {
                let first: &Raw = &self.claims[first];
                let path = self.sources[first.file].path.display();
                let message = format!("a second claim `{}`", raw.name);
                let hint = format!("the first stands in {path}, line {}", first.line);
                twice.push((raw.file, raw.span, message, hint));
            }
        }
        for (file, span, message, hint) in twice {
            self.error(file, span, message, Some(hint));
        }
        ids
    }

    fn unique_defines(&mut self) -> HashMap<Name, Vec<usize>> {
        let mut found: HashMap<Name, Vec<usize>> = HashMap::new();
        let mut files = HashSet::new();
        let mut twice = Vec::new();
        for (index, raw) in self.defines.iter().enumerate() {
            if !files.insert((raw.file, raw.name.clone())) {
                let message = format!("a second block `define {}` in this file", raw.name);
                twice.push((raw.file, raw.span, message));
            }
            found.entry(raw.name.clone()).or_default().push(index);
        }
        for (file, span, message) in twice {
            self.error(file, span, message, None);
        }
        found
    }

    /// The claim's lines with those that `same` takes over.
    fn resolve(
        &mut self,
        index: usize,
        ids: &HashMap<Name, usize>,
        resolved: &mut [Option<Resolved>],
    ) {
        let mut path = Vec::new();
        let mut next = Some(index);
        while let Some(at) = next.filter(|at| resolved[*at].is_none()) {
            // Reached again before it is resolved, it is its own origin.
            resolved[at] = Some(Resolved::Faulty);
            path.push(at);
            next = match self.same(at, ids) {
                Ok(base) => base,
                Err((span, message, hint)) => {
                    self.error(self.claims[at].file, span, message, hint);
                    self.claims[at].broken = true;
                    None
                }
            };
        }
        let mut base = next;
        for at in path.into_iter().rev() {
            resolved[at] = Some(self.merged(at, base, resolved));
            base = Some(at);
        }
    }

    fn same(
        &self,
        index: usize,
        ids: &HashMap<Name, usize>,
    ) -> Result<Option<usize>, (Span, String, Option<String>)> {
        let lines = &self.claims[index].lines;
        for line in lines {
            if let Item::Same(id) = &line.item {
                return match ids.get(id) {
                    Some(base) => Ok(Some(*base)),
                    None => Err((line.span, no_claim(id), near_id(id, ids))),
                };
            }
        }
        Ok(None)
    }

    fn merged(
        &mut self,
        index: usize,
        base: Option<usize>,
        resolved: &[Option<Resolved>],
    ) -> Resolved {
        let raw = &self.claims[index];
        if raw.broken {
            return Resolved::Faulty;
        }
        let span = raw.span;
        let file = raw.file;
        let mut merged = (raw.lines.clone(), 0);
        if let Some(base) = base {
            match &resolved[base] {
                Some(Resolved::Lines(lines, depth)) => {
                    merged = (merge(lines, &raw.lines), depth + 1);
                }
                // A fault of the base was told there, unless the base is waiting for this very claim.
                _ if self.claims[base].broken => return Resolved::Faulty,
                _ => {
                    let message = "`same` leads back to this claim".to_string();
                    self.error(file, span, message, None);
                    self.claims[index].broken = true;
                    return Resolved::Faulty;
                }
            }
        }
        if merged.0.len() > MAX_LINES || merged.1 > MAX_SAME {
            let message = format!(
                "a claim has at most {MAX_LINES} lines and {MAX_SAME} `same` one after another"
            );
            self.error(file, span, message, None);
            self.claims[index].broken = true;
            return Resolved::Faulty;
        }
        Resolved::Lines(merged.0, merged.1)
    }

    /// The lines with those of the `define` blocks in the place of `use`; `None` after an error.
    fn with_defines(
        &mut self,
        index: usize,
        lines: &[Arc<Line>],
        defines: &HashMap<Name, Vec<usize>>,
    ) -> Option<Vec<Arc<Line>>> {
        let mut all = Vec::new();
        for line in lines {
            let Item::Use(name) = &line.item else {
                all.push(line.clone());
                continue;
            };
            let found = self.define(name, line.file, defines);
            match found {
                Ok(define) if define.broken => return None,
                Ok(define) => all.extend(define.lines.iter().cloned()),
                Err((message, hint)) => {
                    self.error(line.file, line.span, message, hint);
                    return None;
                }
            }
        }
        if all.len() > MAX_LINES {
            let raw = &self.claims[index];
            let message = format!("a claim has at most {MAX_LINES} lines");
            self.error(raw.file, raw.span, message, None);
            return None;
        }
        Some(all)
    }

    /// The block of that name: of the same file, or else the only one of the others.
    fn define(
        &self,
        name: &Name,
        file: usize,
        defines: &HashMap<Name, Vec<usize>>,
    ) -> Result<&Raw, (String, Option<String>)> {
        let found = defines.get(name).map_or(&[][..], Vec::as_slice);
        let here = found.iter().find(|at| self.defines[**at].file == file);
        match (here, found) {
            (Some(at), _) => Ok(&self.defines[*at]),
            (None, [only]) => Ok(&self.defines[*only]),
            (None, []) => {
                let near = nearest(name, sorted(defines.keys()));
                let hint = near.map(|near| format!("is `{near}` meant?"));
                Err((format!("there is no block `define {name}`"), hint))
            }
            (None, _) => Err((
                format!("several files have a block `define {name}`"),
                Some("give them different names".to_string()),
            )),
        }
    }

    /// Claims that are only named: by `after` and `agrees`, and by `like` if that is the claim itself.
    fn references(&mut self, lines: &[Arc<Line>], claim: &Claim, ids: &HashMap<Name, usize>) {
        for line in lines {
            let id = match &line.item {
                Item::After(id) => id,
                // It may stand in a chapter that is not read.
                Item::Like(id) if *id == claim.id => id,
                Item::Says(statement) | Item::Mend(statement) => match named(statement) {
                    Some(id) => id,
                    None => continue,
                },
                _ => continue,
            };
            if !ids.contains_key(id) {
                let hint = near_id(id, ids);
                self.error(line.file, line.span, no_claim(id), hint);
            } else if *id == claim.id {
                let message = "a claim cannot refer to itself".to_string();
                self.error(line.file, line.span, message, None);
            }
        }
    }

    /// Gives every `ID if COND` the claim that it is about.
    fn targets(&mut self, claims: &mut [Claim]) {
        let ids: HashMap<Name, usize> = claims
            .iter()
            .enumerate()
            .map(|(index, claim)| (claim.id.clone(), index))
            .collect();
        let mut shared: HashMap<usize, Arc<Claim>> = HashMap::new();
        for index in 0..claims.len() {
            let claim = &claims[index];
            let statements = [Some(&claim.says), claim.mend.as_ref()];
            let found = statements
                .into_iter()
                .flatten()
                .find_map(|statement| match statement {
                    Statement::Conditional { id, .. } => Some(id),
                    _ => None,
                });
            let Some(id) = found else {
                continue;
            };
            let Some(target) = ids.get(id).copied() else {
                continue;
            };
            let target = shared
                .entry(target)
                .or_insert_with(|| Arc::new(claims[target].clone()))
                .clone();
            claims[index].places.target = Some(target);
        }
    }
}

/// What became of a claim's `same`.
enum Resolved {
    /// All lines, and how many `same` they came through.
    Lines(Vec<Arc<Line>>, usize),
    /// An error was told, or the claim is being resolved.
    Faulty,
}

/// The first claim that a statement names.
fn named(statement: &Statement) -> Option<&Name> {
    match statement {
        Statement::Conditional { id, .. } => Some(id),
        Statement::Definition { duties, .. } => duties.iter().find_map(|duty| match duty {
            Duty::Agrees(id) => Some(id),
            _ => None,
        }),
        Statement::All(items) => items.iter().find_map(named),
        _ => None,
    }
}

fn no_claim(id: &str) -> String {
    format!("there is no claim `{id}` in what is read")
}

/// A hint for an unknown id, looked for only in books of human size.
fn near_id(id: &str, ids: &HashMap<Name, usize>) -> Option<String> {
    if ids.len() > 10_000 {
        return None;
    }
    nearest(id, sorted(ids.keys())).map(|near| format!("is `{near}` meant?"))
}

fn sorted<'a>(names: impl Iterator<Item = &'a Name>) -> Vec<&'a str> {
    let mut names: Vec<&str> = names.map(|name| &**name).collect();
    names.sort_unstable();
    names
}

/// The lines of `base` but for those that `own` gives: a line takes the place of that with the same
/// keyword, a `let` or `draw` of that which declares the same name, `given` lines of all `given` lines.
fn merge(base: &[Arc<Line>], own: &[Arc<Line>]) -> Vec<Arc<Line>> {
    let mut own: Vec<Option<&Arc<Line>>> = own
        .iter()
        .filter(|line| line.keyword != Keyword::Same)
        .map(Some)
        .collect();
    let all: Vec<&Arc<Line>> = own.iter().flatten().copied().collect();
    let mut merged = Vec::new();
    for old in base {
        if !all.iter().any(|new| replaces(new, old)) {
            merged.push(old.clone());
            continue;
        }
        for slot in &mut own {
            if slot.is_some_and(|new| replaces(new, old)) {
                merged.extend(slot.take().cloned());
            }
        }
    }
    merged.extend(own.into_iter().flatten().cloned());
    merged
}

fn replaces(new: &Line, old: &Line) -> bool {
    match (&new.item, &old.item) {
        (Item::Use(_), _) => false,
        (Item::Let(new, _), Item::Let(old, _)) => new.name == old.name,
        (Item::Draw(new), Item::Draw(old)) => new
            .iter()
            .any(|(draw, _)| old.iter().any(|(other, _)| draw.name == other.name)),
        _ => new.keyword == old.keyword,
    }
}
