use super::*;

const COARSE: Grid = Grid {
    columns: 23,
    rows: 15,
};

fn map(name: &str) -> Map {
    let mut all = maps().into_iter();
    all.find(|map| map.name == name).expect("one of them")
}

/// The cells of a panel at a coarse grid, with the scenes behind them.
fn panel(name: &str, quantity: Quantity, recipe: Recipe) -> Vec<(Vec<Scene>, Cell)> {
    let mut map = map(name);
    map.panels = vec![(quantity, recipe)];
    let mut cells = vec![];
    for column in 0..COARSE.columns {
        let rows = map.column(COARSE, column).expect("there is a truth");
        for (index, row) in rows.iter().enumerate() {
            let scenes = COARSE.places(column, index as u32);
            let scenes = scenes.map(|(x, y)| map.plane.scene(x, y)).collect();
            cells.push((scenes, row[0]));
        }
    }
    cells
}

#[test]
fn the_thesis_formula_loses_twice_the_digits_of_k() {
    for (scenes, cell) in panel("photons-moments", Quantity::Variance, Recipe::Formula) {
        let k = scenes[0].inner.log10();
        match cell {
            Cell::Lost(tenths) => {
                let lost = f64::from(tenths) / 10.0;
                assert!(lost > 2.0 * k - 1.5 && lost < 2.0 * k + 5.0, "{k} {lost}");
            }
            cell => assert!(cell == Cell::Wrong && k > 5.0, "{k} {cell}"),
        }
    }
}

#[test]
fn what_is_certified_keeps_its_digits() {
    for quantity in [Quantity::Excess, Quantity::Variance] {
        for (scenes, cell) in panel("photons-moments", quantity, Recipe::Certified) {
            // 28 units are 1.45 digits.
            assert!(cell <= Cell::Lost(15), "{:?} {cell}", scenes[0]);
        }
    }
}

#[test]
fn the_power_series_diverges_where_the_shell_is_thicker_than_what_it_holds() {
    for (scenes, cell) in panel("arguments-function", Quantity::Function, Recipe::Direct) {
        let ratio = |scene: &Scene| scene.volume / scene.inner;
        if scenes.iter().all(|scene| ratio(scene) < 0.9) {
            assert!(cell <= Cell::Lost(10), "{:?} {cell}", scenes[0]);
        }
        let few = |scene: &Scene| ratio(scene) > 2.0 && scene.count < 100.0;
        if scenes.iter().any(few) {
            assert!(cell == Cell::Divergence, "{:?} {cell}", scenes[0]);
        }
    }
}

#[test]
fn series_of_one_sign_and_moments_lose_little_where_they_answer() {
    for (recipe, answered) in [(Recipe::Pfaff, 300), (Recipe::Moments, 250)] {
        let cells = panel("arguments-function", Quantity::Function, recipe);
        let answers = cells.iter().filter(|(_, cell)| *cell <= Cell::Lost(159));
        for (scenes, cell) in answers.clone() {
            // Thousands of terms, each rounded.
            assert!(*cell <= Cell::Lost(25), "{recipe:?} {:?} {cell}", scenes[0]);
        }
        assert!(answers.count() > answered, "{recipe:?}");
    }
}

#[test]
fn the_quadrature_answers_everywhere() {
    for name in ["photons-function", "arguments-function"] {
        for (scenes, cell) in panel(name, Quantity::Function, Recipe::Euler) {
            assert!(cell <= Cell::Lost(25), "{:?} {cell}", scenes[0]);
        }
    }
}

#[test]
fn the_closed_form_has_the_digits_that_cancellation_leaves() {
    let mut wrong = 0;
    for (scenes, cell) in panel("photons-function", Quantity::Function, Recipe::Closed) {
        let (least, most) = (scenes[0].count.min(scenes[8].count), scenes[8].count);
        match cell {
            Cell::Lost(_) => assert!(least <= 40.0, "{:?} {cell}", scenes[0]),
            Cell::Wrong => assert!(most >= 10.0),
            Cell::Overflow => assert!(most >= 100.0),
            _ => panic!("{:?} {cell}", scenes[0]),
        }
        wrong += u32::from(cell == Cell::Wrong);
    }
    assert!(wrong > 10);
}

#[test]
fn cells_are_read_as_they_are_written() {
    let tenths = (0..=255).map(Cell::Lost);
    let others = [
        Cell::Refusal,
        Cell::Cost,
        Cell::Divergence,
        Cell::Overflow,
        Cell::Wrong,
    ];
    for cell in tenths.chain(others) {
        assert_eq!(cell.to_string().parse(), Ok(cell));
    }
    for text in ["", "3", "1.23", "26.0", "x.1", "-1.0", "+1.0", "01.0"] {
        assert_eq!(text.parse::<Cell>(), Err(NoCell), "{text}");
    }
}
