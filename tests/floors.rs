//! The floors of the house: a file imports only from floors below its own.

use std::fs;
use std::path::{Path, PathBuf};

/// High to low; names on one line share a floor and do not see each other.
const FLOORS: &[&[&str]] = &[
    &["cli"],
    &["report"],
    &["search"],
    &["corpus"],
    &["judge"],
    &["prover"],
    &["probe", "simulate", "measure"],
    &["evaluate"],
    &["special"],
    &["model"],
    &["algebra"],
    &["number"],
    &["kernel"],
    &["book"],
    &["formula"],
];

struct Source {
    path: PathBuf,
    floor: String,
    /// The text without comments, up to the tests.
    code: String,
    whole: String,
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    files.sort();
    files
        .into_iter()
        .map(|path| {
            let whole = fs::read_to_string(&path).expect("a source file is UTF-8");
            let inside = path.strip_prefix(&root).expect("under src");
            let first = inside.components().next().expect("a file");
            let first = first.as_os_str().to_string_lossy();
            Source {
                floor: first.trim_end_matches(".rs").to_owned(),
                code: without_comments(before_tests(&whole)),
                path,
                whole,
            }
        })
        .collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("src is readable") {
        let path = entry.expect("src is readable").path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

fn before_tests(text: &str) -> &str {
    text.split("#[cfg(test)]\nmod tests")
        .next()
        .expect("at least one part")
}

fn without_comments(text: &str) -> String {
    let lines = text.lines().map(|line| match line.find("//") {
        // `//` in a string (a URL) follows a colon.
        Some(at) if !line[..at].ends_with(':') => &line[..at],
        _ => line,
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn rank(floor: &str) -> Option<usize> {
    FLOORS.iter().position(|names| names.contains(&floor))
}

/// The modules that a text reaches by `crate::name` or `crate::{name, ...}`.
fn reached(code: &str) -> Vec<String> {
    let mut names = Vec::new();
    for part in code.split("crate::").skip(1) {
        let listed = part.strip_prefix('{').map(top_level_names);
        names.extend(listed.unwrap_or_else(|| vec![first_name(part)]));
    }
    names
}

fn first_name(text: &str) -> String {
    text.chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect()
}

/// The first name of each part of a braced list, the opening brace already taken off.
fn top_level_names(list: &str) -> Vec<String> {
    let mut depth = 0;
    let mut names = vec![String::new()];
    for c in list.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => names.push(String::new()),
            _ => names.last_mut().expect("never empty").push(c),
        }
    }
    names
        .iter()
        .map(|part| first_name(part.trim()))
        .filter(|name| !name.is_empty())
        .collect()
}

#[test]
fn a_file_imports_from_lower_floors_only() {
    let mut faults = Vec::new();
    for source in sources() {
        let Some(own) = rank(&source.floor) else {
            assert!(
                ["lib", "main"].contains(&&*source.floor),
                "{:?} has no floor",
                source.path
            );
            continue;
        };
        for name in reached(&source.code) {
            let lower = rank(&name).is_some_and(|other| other > own);
            if !lower && name != source.floor {
                faults.push(format!("{} uses crate::{name}", source.path.display()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_kernel_rests_on_the_formula_alone() {
    for source in sources().iter().filter(|source| source.floor == "kernel") {
        for name in reached(&source.code) {
            assert!(
                ["formula", "kernel"].contains(&&*name),
                "{:?} uses crate::{name}",
                source.path
            );
        }
    }
}

fn words(code: &str) -> impl Iterator<Item = &str> {
    code.split(|c: char| !c.is_alphanumeric() && c != '_')
}

#[test]
fn below_the_numbers_there_is_no_c_library() {
    let pure = ["kernel", "book", "formula"];
    for source in sources()
        .iter()
        .filter(|source| pure.contains(&&*source.floor))
    {
        for word in words(&source.code) {
            assert!(
                word != "rug" && word != "gmp_mpfr_sys",
                "{:?} uses {word}",
                source.path
            );
        }
    }
}

#[test]
fn the_kernel_uses_no_floating_point() {
    for source in sources().iter().filter(|source| source.floor == "kernel") {
        for word in words(&source.code) {
            assert!(
                !["f32", "f64", "to_f64", "unsafe"].contains(&word),
                "{:?} uses {word}",
                source.path
            );
        }
    }
}

/// `Float::with_val` rounds to nearest; the end of an interval must be rounded outwards.
#[test]
fn intervals_never_round_to_nearest() {
    let sources = sources();
    let rigorous = ["number", "special"];
    for source in sources
        .iter()
        .filter(|source| rigorous.contains(&&*source.floor))
    {
        if !is_test_module(source, &sources) {
            let nearest = source.code.contains("Float::with_val(");
            assert!(!nearest, "{:?} rounds to nearest", source.path);
        }
    }
}

/// Whether the file is a module of tests: one that its parent declares under `#[cfg(test)]`.
fn is_test_module(source: &Source, all: &[Source]) -> bool {
    let name = source.path.file_stem().expect("a file").to_string_lossy();
    let folder = source.path.parent().expect("under src");
    let siblings = all
        .iter()
        .filter(|other| other.path.parent() == Some(folder));
    siblings
        .flat_map(|other| other.whole.split("#[cfg(test)]").skip(1))
        .any(|after| {
            let declaration = after.trim_start().lines().next().unwrap_or_default();
            declaration.ends_with(&format!("mod {name};"))
        })
}

/// The program knows no claim: an id such as "2.14" in code (not in a comment or a test) would be a special case.
#[test]
fn no_claim_is_a_special_case() {
    let sources = sources();
    for source in sources
        .iter()
        .filter(|source| !is_test_module(source, &sources))
    {
        for literal in source.code.split('"').skip(1).step_by(2) {
            let chapter = literal.split_once('.').map(|(chapter, number)| {
                ["1", "2", "A"].contains(&chapter)
                    && !number.is_empty()
                    && number.chars().all(|c| c.is_ascii_digit() || c == '-')
            });
            assert!(
                chapter != Some(true),
                "{:?} knows claim {literal}",
                source.path
            );
        }
    }
}

#[test]
fn nothing_is_left_undone() {
    for source in sources() {
        for mark in ["todo!(", "unimplemented!(", "#[ignore", "allow(dead_code)"] {
            assert!(!source.whole.contains(mark), "{:?} has {mark}", source.path);
        }
    }
}

/// The lint against unsafe code is lifted once: for the call of a function in the processor's own instructions.
#[test]
fn one_place_alone_is_unsafe() {
    let mut places = Vec::new();
    for source in sources() {
        let lifted = source.whole.matches("allow(unsafe_code)").count();
        places.extend((0..lifted).map(|_| source.path.clone()));
    }
    assert!(
        matches!(&places[..], [path] if path.ends_with("number/lanes.rs")),
        "{places:?}"
    );
}

#[test]
fn this_test_sees_what_it_should() {
    assert_eq!(
        reached("use crate::formula::{Name};\nlet x = crate::book::read();"),
        ["formula", "book"]
    );
    assert_eq!(
        reached("use crate::{book::{Book, Claim}, judge};"),
        ["book", "judge"]
    );
    assert_eq!(without_comments("a // crate::cli\nb"), "a \nb");
}
