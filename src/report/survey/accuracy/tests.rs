use super::*;
use crate::report::chart::Marks;

fn sheet(rows: &str) -> Sheet {
    let text = format!("# t\n{}\n{rows}", COLUMNS.join(","));
    text.parse().expect("a sheet")
}

#[test]
fn the_front_is_the_least_of_all_curves() {
    // Words cost 1 and 100, splitting 10 and 20; they cross between, and splitting ends a little later.
    let points = Points::read(&sheet(
        "4,10,words,10,1,,\n4,100,words,100,100,,\n4,10,splitting,10,10,,\n4,100,splitting,102,20,,\n4,10,euler,,,,too long\n",
    ));
    let front = points.expect("its columns").own(4, Measure::Seconds).series;
    let (chart_front, choice) = (&front[0].marks, &front[front.len() - 1].marks);
    let expected = vec![
        [10.0, 1.0],
        [10.0, 1.0],
        [
            100.0,
            20.0 * (100.0f64 / 102.0).powf(2f64.ln() / 10.2f64.ln()),
        ],
        [102.0, 20.0],
    ];
    let Marks::Front(found) = chart_front else {
        panic!("{chart_front:?}")
    };
    for ([x, y], [a, b]) in found.iter().zip(&expected) {
        assert!(
            (x - a).abs() < 1e-9 && (y - b).abs() < 1e-2,
            "{found:?} {expected:?}"
        );
    }
    assert_eq!(found.len(), 4);
    assert_eq!(choice, &Marks::Rings(vec![]));
}

#[test]
fn the_choice_is_held_against_the_best_that_proves_the_digits() {
    let points = Points::read(&sheet(
        "100,15,choice,19,3e-6,30,words\n100,15,words,19,2e-6,20,\n100,15,direct,14.9,1e-6,10,\n100,15,rival: other 1,16,6e-6,,\n",
    ));
    let points = points.expect("its columns");
    assert!(
        points
            .against_rivals()
            .contains("| 100 | 15 | 6.00 \u{b5}s (16) |")
    );
    // Ratios are of one run.
    let both = Points::read(&sheet(
        "100,15,choice,19,3e-6,30,words\n100,15,rival: claimcheck 1,16,2e-6,,\n100,15,rival: other 1,16,6e-6,,\n",
    ));
    let both = both.expect("its columns");
    assert_eq!(both.rivals(), ["other 1"]);
    assert!(both.against_rivals().contains("| 100 | 15 | 3.0 (16) |"));
    let Marks::Rings(rings) = &both.others(100).series[0].marks else {
        panic!("the choice")
    };
    assert_eq!(rings, &[[16.0, 2e-6]]);
    let table = points.against_hindsight();
    let row = "| 100 | 15 | Pfaff, machine words | 3.00 \u{b5}s | Pfaff, machine words | 2.00 \u{b5}s | 1.50 | 1.50 |";
    assert!(table.contains(row), "{table}");
}

#[test]
fn figures_of_other_programs_are_read_with_care() {
    let file = |row: &str| {
        let head = "# here\ntool,version,quantity,k,digits asked,digits right,seconds";
        Rivals::read("here.csv", &format!("\u{feff}{head}\n{row}\n"))
    };
    let question = Question {
        quantity: Quantity::Mean,
        k: 4,
        digits: 15,
    };
    let good = file("a|b,2 + c,mean,4,15,14.5,2e-6").expect("a figure");
    let rows = good.rows(question, "mean");
    assert_eq!(rows, [["4", "15", "rival: a/b 2", "14.5", "2e-6"]]);
    assert!(good.rows(question, "variance").is_empty());
    assert_eq!(good.option(), " --rivals here.csv");
    let twice = file("a,2,mean,4,15,14.5,2e-6\na,2 + d,mean,4,15,14,2e-6");
    assert_eq!(twice, Err(SheetError::Twice { row: 2 }));
    for bad in [
        "a,1,mean,4,15,nan,1",
        "a,1,mean,4,15,-1,1",
        "a,1,mean,4,15,1,0",
        "a,1,mean,4,15,1,inf",
        "a,1,mean,4,15,1,1e300",
        "a,1,mean,-4,15,1,1",
        "a,1,mean,4,1e1,1,1",
        " ,1,mean,4,15,1,1",
    ] {
        assert!(
            matches!(file(bad), Err(SheetError::Cell { row: 1, .. })),
            "{bad}"
        );
    }
}
