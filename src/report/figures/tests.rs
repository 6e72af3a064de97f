use super::*;

#[test]
fn every_figure_can_be_made() {
    for figure in figures() {
        let made = figure.make(Pace::Quick).expect("it asks for what there is");
        assert!(!made.svg.contains("NaN") && made.csv.contains(&figure.command(Pace::Quick)));
        let values = made.csv.lines().filter(|line| !line.starts_with('#'));
        let values = values.skip(1).flat_map(|line| line.split(','));
        assert!(values.filter(|cell| cell.parse::<f64>().is_ok()).count() > 50);
    }
}

#[test]
fn far_photons_lie_in_the_middle_of_their_shells() {
    let photons = Photons::Thinned(2, 80_200).of(&Layout::Triangular);
    assert_eq!(photons[..49], (2..=50).collect::<Vec<_>>());
    assert!((40..60).contains(&photons[49..].len()));
    for k in &photons[49..] {
        assert_eq!(middle(&Layout::Triangular, *k), Some(*k));
    }
    assert_eq!(middle(&Layout::Triangular, 4), Some(5));
    assert_eq!(middle(&Layout::One, 7), Some(7));
}

#[test]
fn quick_means_few_runs() {
    let scene = Scene::new(Layout::One, 10, 10_000, 1);
    assert_eq!(Pace::Quick.scene(&scene).runs, QUICK_RUNS);
    assert_eq!(Pace::Full.scene(&scene), scene);
    let few = Scene { runs: 10, ..scene };
    assert_eq!(Pace::Quick.scene(&few), few);
}
