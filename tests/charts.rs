//! Charts of measurements: the documents are what their data say, and the data are right.
#![cfg(feature = "engine")]

use claimcheck::measure::plain::{Recipe, Scene};
use claimcheck::measure::stability::{Cell, Grid, Truth, maps, truth};
use claimcheck::report::figures::Pace;
use claimcheck::report::survey::{Rivals, Sheet, Surveys, accuracy, stability};
use claimcheck::special::shell::{Method, Quantity, ShellError, choose};
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The grid of the documents.
const GRID: Grid = Grid::FULL;

fn documents() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/charts")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn sheet(name: &str) -> Sheet {
    let text = read(&documents().join(format!("{name}.csv")));
    text.parse()
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Pictures and pages of the documents are those of their CSV files.
fn agree(surveys: &Surveys) {
    let mut sheets = vec![];
    for survey in &surveys.all {
        let name = survey.name();
        let sheet = sheet(&name);
        let pictures = surveys.pictures(survey.as_ref(), &sheet);
        for (name, chart) in pictures.expect("its own sheet") {
            let file = format!("{name}.svg");
            assert!(chart.to_svg() == read(&documents().join(&file)), "{file}");
        }
        sheets.push(sheet);
    }
    let page = surveys.page(&sheets).expect("their own sheets");
    assert_eq!(
        page,
        read(&documents().join(format!("{}.md", surveys.group)))
    );
}

#[test]
fn the_documents_are_drawn_from_their_data() {
    agree(&stability(Pace::Full));
    agree(&accuracy(Pace::Full, &Rivals::default(), None));
}

/// F, E - 1 and Var to 25 digits by the cheapest method that the choice would not take.
fn second_truth(scene: &Scene) -> Truth {
    let quantities = [Quantity::Function, Quantity::Excess, Quantity::Variance];
    let shell = scene.shell().expect("finite");
    let (first, _) = choose(Quantity::Variance, &shell, 25).expect("a method");
    let bits = |method: Method| method.bits_for(Quantity::Variance, &shell, 25) + 64;
    let mut others: Vec<Method> = Method::ALL.into_iter().filter(|m| *m != first).collect();
    others.sort_by(|a, b| {
        let [a, b] = [a, b].map(|method| method.estimate(&shell, bits(*method)));
        a.total_cmp(&b)
    });
    let answers = others
        .into_iter()
        .filter_map(|method| method.enclose_all(quantities, &shell, bits(method)).ok());
    let mut good = answers.filter(|values| values.iter().all(|value| value.agrees_to(25)));
    let [function, excess, variance] = good.next().expect("a second method answers");
    Truth {
        function,
        excess,
        variance,
    }
}

/// The same, once it has been held against the one that was drawn.
fn checked_truth(scene: &Scene) -> Result<Truth, ShellError> {
    let (first, second) = (truth(scene)?, second_truth(scene));
    assert!(first.function.overlaps(&second.function), "{scene:?}");
    assert!(first.excess.overlaps(&second.excess), "{scene:?}");
    assert!(first.variance.overlaps(&second.variance), "{scene:?}");
    Ok(second)
}

/// Some cells of a map, each drawn at random: its column and row.
fn some_cells(count: usize, seed: u64) -> Vec<(u32, u32)> {
    let mut random = rand_xoshiro::Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut cell = || {
        (
            random.random_range(0..GRID.columns),
            random.random_range(0..GRID.rows),
        )
    };
    (0..count).map(|_| cell()).collect()
}

/// Powers, logarithms and cosines are the system's: another one may round them in another way.
fn is_close(recipe: Recipe, drawn: Cell, again: Cell) -> bool {
    match (recipe, drawn, again) {
        (Recipe::Closed | Recipe::Euler, Cell::Lost(a), Cell::Lost(b)) => a.abs_diff(b) <= 5,
        _ => drawn == again,
    }
}

#[test]
fn ten_thousand_cells_again_by_a_second_method() {
    for (number, map) in maps().into_iter().enumerate() {
        let sheet = sheet(&format!("stability-{}", map.name));
        assert_eq!(sheet.rows().len() as u32, GRID.columns * GRID.rows);
        some_cells(2500, number as u64)
            .par_iter()
            .for_each(|&(column, row)| {
                let drawn = &sheet.rows()[(column * GRID.rows + row) as usize];
                let cells = map.worst(GRID.places(column, row), checked_truth);
                let cells = cells.expect("there is a truth");
                for ((text, cell), (_, recipe)) in drawn[2..].iter().zip(cells).zip(&map.panels) {
                    let drawn: Cell = text.parse().expect("a cell");
                    assert!(
                        is_close(*recipe, drawn, cell),
                        "{} {column} {row}: {drawn} {cell}",
                        map.name
                    );
                }
            });
    }
}

/// A folder of the test's own, empty at first.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("charts")
        .join(name);
    // It is there only if the test has run before.
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn chart(out: &Path, options: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_claimcheck"));
    program.arg("chart").args(options).arg("--out").arg(out);
    program.output().expect("the program starts")
}

fn printed(output: &Output) -> String {
    assert!(output.status.success(), "{output:?}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What a command that refuses says on stderr.
fn refused(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn write(path: &Path, text: &str) {
    fs::write(path, text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

#[test]
fn a_killed_run_goes_on_and_comes_to_the_same_bytes() {
    let out = folder("stability");
    let quick = ["stability", "--quick"];
    let said = printed(&chart(&out, &quick));
    assert_eq!(said.matches(": made\n").count(), 7, "{said}");
    let name = |ending: &str| out.join(format!("stability-arguments-moments.{ending}"));
    let (data, picture) = (read(&name("csv")), read(&name("svg")));
    let lines: Vec<&str> = data.split_inclusive('\n').collect();
    let notes = lines.iter().filter(|line| line.starts_with('#')).count();
    // As a killed run leaves it: 20 columns of 30 cells, and half a row.
    let whole = notes + 1 + 600;
    let part = lines[..whole].concat() + &lines[whole][..9];
    // Or with a row twice, a row less, a cell that is none.
    let row = lines[whole - 40];
    let twice = data.replacen(row, &format!("{row}{row}"), 1);
    let less = data.replacen(row, "", 1);
    let none = data.replacen(",0.", ",NaN0.", 1);
    for (ending, damaged) in [
        ("csv.part", &part),
        ("csv", &part),
        ("csv", &twice),
        ("csv", &less),
        ("csv.part", &none),
    ] {
        assert_ne!(damaged, &data);
        fs::remove_file(name("csv")).expect("it was there");
        fs::remove_file(name("svg")).expect("it was there");
        write(&name(ending), damaged);
        let said = printed(&chart(&out, &["stability", "--quick", "--jobs", "1"]));
        assert_eq!(said.matches("there already").count(), 5, "{said}");
        assert!(read(&name("csv")) == data && read(&name("svg")) == picture);
        assert!(!name("csv.part").exists());
    }
    // Of another command, and of nobody's.
    let said = refused(&chart(&out, &["stability"]));
    assert!(said.contains("no file of this command") && said.contains("name another folder"));
    write(&name("csv.part"), "# another\na,b\n1,2\n");
    assert!(refused(&chart(&out, &quick)).contains("moments.csv.part is no file of this"));
    assert!(read(&name("csv")) == data);
}

#[test]
fn the_quick_chart_of_costs_has_every_way() {
    let out = folder("accuracy");
    fs::create_dir_all(&out).expect("writable");
    let file = out.join("other figures.csv");
    let figures = |digits: &str| {
        let text = "# a machine\ntool,version,quantity,k,digits asked,digits right,seconds\n\
            other,1.2 + 3,mean,5050,15,9.5,1e-3\nother,1.2 + 3,mean,77,15,9.5,1e-3\n";
        write(&file, &text.replace("9.5", digits));
    };
    figures("9.5");
    let options = [
        "accuracy",
        "--quick",
        "--rivals",
        file.to_str().expect("a name"),
    ];
    assert!(printed(&chart(&out, &options)).contains("accuracy.md: made"));
    let [mean, page] = ["accuracy-mean.csv", "accuracy.md"].map(|name| out.join(name));
    let data = read(&mean);
    for way in [
        "choice",
        "doubles",
        "words",
        "splitting",
        "exact",
        "euler",
        "thesis",
    ] {
        assert!(data.contains(&format!("\n5050,15,{way},")), "{way}");
    }
    assert!(data.contains("asked for 15, 100 and 1000 digits"));
    assert!(data.ends_with("\n5050,15,rival: other 1.2,9.5,1e-3,,\n") && !data.contains("\n77,"));
    assert!(data.contains("--quick --out . --rivals FILE\n"));
    assert!(read(&page).contains("| other 1.2 |") && read(&page).contains("(9.5) |"));
    // The other programs' figures are those of now, what was measured stays.
    figures("9.8");
    assert!(printed(&chart(&out, &options)).contains("accuracy-mean: there already"));
    assert_eq!(read(&mean), data.replace(",9.5,", ",9.8,"));
    assert!(read(&page).contains("(9.8) |"));
    let said = printed(&chart(&out, &["accuracy", "--quick"]));
    assert!(said.contains("accuracy-mean: there already"));
    assert!(!read(&mean).contains("rival") && !read(&page).contains("Other programs"));
}

#[test]
fn what_is_no_file_of_figures_is_told() {
    let out = folder("none");
    let file = out.with_extension("csv");
    fs::create_dir_all(out.parent().expect("it has one")).expect("writable");
    for (text, message) in [
        ("", "no heading"),
        ("a,b\n1\n", "row 1 has 1 cells where the heading has 2"),
        ("a,b\n1,2\n", "no column `tool`"),
        (
            "tool,version,quantity,k,digits asked,digits right,seconds\nx,1,mean,4,y,1,1\n",
            "`y` in the column `digits asked`, row 1",
        ),
    ] {
        write(&file, text);
        let file = file.to_str().expect("a name");
        let said = refused(&chart(&out, &["accuracy", "--quick", "--rivals", file]));
        assert!(
            said.contains(message) && said.contains("--figures"),
            "{said}"
        );
    }
    let folder = out.parent().expect("it has one").to_str().expect("a name");
    let said = refused(&chart(&out, &["accuracy", "--quick", "--rivals", folder]));
    assert!(said.contains("no ordinary file"), "{said}");
    let said = refused(&chart(&file, &["accuracy", "--quick"]));
    assert!(said.contains("is no folder"), "{said}");
}
