use super::*;

fn sheet() -> Sheet {
    let text = |words: &[&str]| {
        words
            .iter()
            .map(|word| word.to_string())
            .collect::<Vec<_>>()
    };
    let mut sheet = Sheet::new(text(&["title", "of, a note"]), text(&["a", "b"]));
    sheet.add(vec![
        text(&["1", "x"]),
        text(&["2"]),
        text(&["3", "y, \"z\"", "more"]),
    ]);
    sheet
}

#[test]
fn a_sheet_is_read_as_it_is_written() {
    let sheet = sheet();
    let text = sheet.to_string();
    assert_eq!(text, "# title\n# of, a note\na,b\n1,x\n2,\n3,y;  z \n");
    assert_eq!(text.parse(), Ok(sheet.clone()));
    assert_eq!(sheet.numbers("a"), Ok(vec![1.0, 2.0, 3.0]));
    assert!(matches!(
        sheet.numbers("b"),
        Err(SheetError::Cell { row: 1, .. })
    ));
    assert_eq!(sheet.numbers("c"), Err(SheetError::NoColumn("c".into())));
    assert_eq!("# a\n".parse::<Sheet>(), Err(SheetError::NoHeading));
    assert!(matches!(
        "a,b\n1\n".parse::<Sheet>(),
        Err(SheetError::Ragged { .. })
    ));
}

#[test]
fn an_unfinished_file_gives_its_whole_units() {
    let sheet = sheet();
    let text = sheet.head() + &sheet.part(0, 4);
    let whole = Sheet::unfinished(&text).expect("it was just written");
    assert_eq!(whole, (sheet.clone(), 4));
    // Cut off anywhere after it, or within the last unit.
    for tail in ["5", "5,y", "5,y\n", "5,y\n# do", "5,y\n# done 5"] {
        assert_eq!(
            Sheet::unfinished(&(text.clone() + tail)),
            Ok((sheet.clone(), 4)),
            "{tail}"
        );
    }
    for end in sheet.head().len()..text.len() {
        let cut = Sheet::unfinished(&text[..end]);
        let (rest, done) = cut.unwrap_or((Sheet::new(vec![], vec![]), 0));
        assert!(rest.rows().is_empty() && done == 0, "{}", &text[..end]);
    }
}
