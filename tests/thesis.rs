//! The book has a claim for everything that the thesis numbers.

use claimcheck::book::read;
use std::collections::BTreeSet;

/// Written by `data/make_thesis_numbers.py` from the thesis; nothing else of it is read here.
const NUMBERS: &str = include_str!("data/thesis-numbers.txt");

#[test]
fn everything_that_the_thesis_numbers_has_a_claim() {
    let book = read(&["proofs".into()]).expect("the book");
    let ids: BTreeSet<&str> = book.claims.iter().map(|claim| &*claim.id).collect();
    // Parts and further readings add to the id.
    let has = |id: &str| {
        let part = format!("{id}-");
        ids.contains(id) || ids.iter().any(|other| other.starts_with(&part))
    };
    let mut missing = Vec::new();
    let mut equations = 0;
    for line in NUMBERS.lines() {
        match line.split(' ').collect::<Vec<_>>().as_slice() {
            ["equation", id] => {
                equations += 1;
                missing.extend((!has(id)).then_some(line));
            }
            ["entry", id] => missing.extend((!has(id)).then_some(line)),
            ["cells", section, count] => {
                let head = format!("cell-B.{section}.");
                let cells = ids.iter().filter_map(|id| id.strip_prefix(&head));
                let cells: BTreeSet<_> = cells.filter_map(|rest| rest.split('-').next()).collect();
                let count: usize = count.parse().expect("a count");
                missing.extend((cells.len() < count).then_some(line));
            }
            _ => panic!("`{line}` is no line of the list"),
        }
    }
    assert_eq!(equations, 180);
    assert_eq!(missing, Vec::<&str>::new(), "without a claim");
}

#[test]
fn what_is_like_another_claim_names_one() {
    let book = read(&["proofs".into()]).expect("the book");
    let ids: BTreeSet<&str> = book.claims.iter().map(|claim| &*claim.id).collect();
    let likes = book.claims.iter().filter_map(|claim| claim.like.as_ref());
    let lost: Vec<_> = likes.filter(|like| !ids.contains(&***like)).collect();
    assert!(lost.is_empty(), "no such claims: {lost:?}");
}
