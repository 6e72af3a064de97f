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
fn the_beginning_of_a_file_is_what_is_whole() {
    let sheet = sheet();
    let text = sheet.to_string();
    assert_eq!(Sheet::beginning(&text), Ok(sheet.clone()));
    // A row that is cut, or of another length.
    for tail in ["5", "5,y", "5,y,z\n6,w\n"] {
        let damaged = text.clone() + tail;
        assert_eq!(Sheet::beginning(&damaged), Ok(sheet.clone()), "{tail}");
    }
    let cut = Sheet::beginning(&text[..text.len() - 1]).expect("a heading");
    assert_eq!(cut.rows(), &sheet.rows()[..2]);
}

#[test]
fn the_median_is_in_the_middle() {
    assert_eq!(median(vec![]), None);
    assert_eq!(median(vec![3.0]), Some(3.0));
    assert_eq!(median(vec![3.0, 1.0]), Some(2.0));
    assert_eq!(median(vec![9.0, 1.0, 2.0]), Some(2.0));
    assert_eq!(median(vec![9.0, 1.0, 2.0, 3.0]), Some(2.5));
}

/// Two units of two rows, each its place and its square.
struct Squares;

impl Survey for Squares {
    fn name(&self) -> String {
        "squares".into()
    }
    fn title(&self) -> String {
        "Squares".into()
    }
    fn columns(&self) -> Vec<String> {
        ["x", "y", "x^2"].map(str::to_owned).to_vec()
    }
    fn units(&self) -> usize {
        2
    }
    fn places(&self, unit: usize) -> Vec<Vec<String>> {
        let place = |y: usize| vec![unit.to_string(), y.to_string()];
        (0..2).map(place).collect()
    }
    fn side_by_side(&self) -> bool {
        true
    }
    fn measure(&self, unit: usize) -> Result<Vec<Vec<String>>, Error> {
        let square = vec![(unit * unit).to_string()];
        Ok(vec![square.clone(), square])
    }
    fn beside(&self) -> Vec<Vec<String>> {
        vec![["9", "9", "81"].map(str::to_owned).to_vec()]
    }
    fn notes(&self, sheet: &Sheet) -> Result<Vec<String>, SheetError> {
        Ok(vec![format!("{} rows", sheet.rows().len())])
    }
    fn pictures(&self, sheet: &Sheet) -> Result<Vec<(&'static str, Chart)>, SheetError> {
        sheet.numbers("x^2")?;
        Ok(vec![("-all", Chart::default())])
    }
    fn words(&self, _: &Sheet) -> Result<String, SheetError> {
        Ok("Words.".into())
    }
}

fn squares(options: &str) -> Surveys {
    Surveys {
        group: "stability",
        heading: "Squares",
        pace: Pace::Quick,
        options: options.into(),
        all: vec![Box::new(Squares)],
    }
}

/// All units measured, and what is beside.
fn complete(surveys: &Surveys) -> Sheet {
    let mut sheet = surveys.sheet(&Squares);
    for unit in 0..2 {
        sheet.add(Squares.rows(unit).expect("squares"));
    }
    surveys.complete(&Squares, sheet).expect("its own")
}

#[test]
fn whole_units_are_known_by_their_places() {
    let surveys = squares("");
    let sheet = complete(&surveys);
    let whole = |change: fn(&str) -> String| {
        let changed = Sheet::beginning(&change(&sheet.to_string())).expect("a heading");
        let (rest, units) = surveys.whole(&Squares, &changed);
        assert_eq!(rest.rows(), &sheet.rows()[..2 * units]);
        units
    };
    assert_eq!(whole(str::to_owned), 2);
    assert_eq!(whole(|text| text.replace("9,9,81\n", "")), 2);
    assert_eq!(whole(|text| text.replace("1,1,1\n", "")), 1);
    assert_eq!(whole(|text| text.replace("1,0,1\n", "1,0,1\n1,0,1\n")), 1);
    assert_eq!(whole(|text| text.replace("1,0,1\n", "1,0\n")), 1);
    assert_eq!(whole(|text| text.replace("0,1,0\n", "")), 0);
    assert_eq!(whole(|text| text.replace("1,1,1\n", "1,1,NaN\n")), 0);
}

#[test]
fn a_file_is_known_by_its_command() {
    let (plain, beside) = (squares(""), squares(" --rivals a.csv"));
    let sheet = complete(&beside);
    let command = "claimcheck chart stability --quick --out . --rivals a.csv";
    assert!(sheet.to_string().contains(command) && sheet.to_string().contains("# 5 rows\n"));
    assert!(plain.owns(&Squares, &sheet) && beside.owns(&Squares, &plain.sheet(&Squares)));
    let full = Surveys {
        pace: Pace::Full,
        ..squares("")
    };
    assert!(!full.owns(&Squares, &sheet));
    for (was, is) in [("# Squares", "# Cubes"), ("x^2", "x^3"), (" --out", "-out")] {
        let other: Sheet = sheet.to_string().replace(was, is).parse().expect("a sheet");
        assert!(!plain.owns(&Squares, &other), "{is}");
    }
    let page = plain.page(&[sheet]).expect("its own");
    assert!(page.contains("![Squares](squares-all.svg)\n\nWords.\n\nData: [squares.csv]"));
}
