use super::super::{Error, Expected, Law, Photon, Statistic, expected};
use super::law;
use crate::model::Layout;
use rug::float::Constant;
use rug::ops::Pow;
use rug::{Float, Rational};

const BITS: u32 = 100;

/// Places of all kinds: Va, m, l.
const PLACES: &[(u64, u64, u64)] = &[
    (0, 1, 1),
    (1, 1, 1),
    (7, 1, 1),
    (1, 2, 1),
    (1, 2, 2),
    (3, 3, 2),
    (15, 6, 6),
    (36, 9, 1),
    (36, 9, 5),
    (1, 40, 3),
    (1, 40, 40),
    (0, 10, 3),
    (0, 10, 7),
    (0, 10, 10),
    (0, 40, 20),
];

fn worst(layout: &Layout, ks: &[u64]) -> f64 {
    let mut worst = 0.0f64;
    for photon in expected(layout, ks).expect("photons") {
        let law = Law::new(photon.photon);
        let size = law.mean_of(f64::abs);
        let pairs = [
            (law.moment(1), photon.excess, size),
            (
                law.moment(2) - law.moment(1).powi(2),
                photon.variance,
                photon.variance,
            ),
        ];
        for (found, truth, unit) in pairs {
            if truth.is_finite() && unit.is_finite() {
                worst = worst.max(((found - truth) / unit).abs());
            }
        }
    }
    println!("{layout:?} {}..: {worst:.1e}", ks[0]);
    worst
}

#[test]
fn moments_are_those_of_certified_doubles() {
    let to = |last: u64| -> Vec<u64> { (1..=last).collect() };
    assert!(worst(&Layout::Triangular, &to(300)) < 1e-12);
    assert!(worst(&Layout::One, &to(100)) < 1e-12);
    assert!(worst(&Layout::Listing, &to(100)[1..]) < 1e-12);
    assert!(worst(&Layout::Unstratified(50.into()), &to(50)) < 1e-10);
    let far = [
        80_200,
        1_000_000,
        1_000_000_000,
        499_999_500_001,
        499_999_999_999,
    ];
    assert!(worst(&Layout::Triangular, &far) < 1e-11);
    let thick = [1, 2, 3, 1000, 500_000, 999_999, 1_000_000];
    assert!(worst(&Layout::Sequence(vec![1, 1_000_000]), &thick) < 1e-10);
    assert!(worst(&Layout::Unstratified(1_000_000.into()), &thick) < 1e-10);
}

#[test]
fn scatter_is_that_of_the_fine_law() {
    for (inner, size, l) in PLACES {
        let photon = Photon::new(*inner, *size, *l).expect("a photon");
        let photon = Expected {
            photon,
            excess: 0.0,
            variance: 0.0,
        };
        let law = law(*inner, *size, *l);
        let square = law.moment(2);
        let truth = match law.moment(4).is_finite() {
            true => law.mean_of(|d| (d * d - square).powi(2)).sqrt(),
            false => f64::INFINITY,
        };
        let found = photon.scatter(Statistic::Square);
        let close = (found / truth - 1.0).abs() < 1e-6;
        assert!(
            found == truth || close,
            "{inner} {size} {l}: {found} {truth}"
        );
    }
}

/// E d^power around Va = 0 from `E x^-p = m (m-1) ... (m-p+1)/((l-1) ... (l-p))`, exactly.
fn exact_moment(size: u64, position: u64, power: u32) -> f64 {
    let (m, l) = (Rational::from(size), Rational::from(position));
    let mut inverse = Rational::from(1);
    let (mut sum, mut binomial) = (Rational::new(), Rational::from(1));
    for p in 0..=power {
        let sign = if (power - p).is_multiple_of(2) { 1 } else { -1 };
        sum += Rational::from(&binomial * &inverse) * sign;
        if p == power {
            break;
        }
        inverse *= Rational::from(&m - p) * &l / (Rational::from(&l - (p + 1)) * &m);
        binomial *= Rational::from((power - p, p + 1));
    }
    sum.to_f64()
}

#[test]
fn moments_around_nothing_are_exact_or_infinite() {
    for (size, position) in [(5, 5), (6, 5), (10, 7), (100, 5), (100, 60), (100, 100)] {
        for power in 1..=4u8 {
            let found = law(0, size, position).moment(power);
            let truth = exact_moment(size, position, power.into());
            let unit = law(0, size, position).mean_of(|d| d.abs().powi(power.into()));
            assert!(
                ((found - truth) / unit).abs() < 1e-11,
                "{size} {position} {power}: {found} {truth}"
            );
        }
    }
    assert_eq!(law(0, 10, 2).moment(2), f64::INFINITY);
    assert!(law(0, 10, 3).moment(2).is_finite());
    assert_eq!(law(0, 10, 4).moment(4), f64::INFINITY);
}

/// `ln E exp(t g)` by the double exponential rule in x, 100 bits.
fn exact_cumulant(place: (u64, u64, u64), statistic: Statistic, t: f64) -> f64 {
    let (inner, size, l) = place;
    let half_pi = Float::with_val(BITS, Constant::Pi) / 2u32;
    let (mut mass, mut sum) = (Float::new(BITS), Float::new(BITS));
    for index in -320i32..=320 {
        let place = Float::with_val(BITS, index) / 64u32;
        let e = Float::with_val(BITS, &half_pi * place.clone().sinh());
        // x and 1 - x, both to all their digits.
        let x = (Float::with_val(BITS, -2 * e.clone()).exp() + 1u32).recip();
        let y = (Float::with_val(BITS, 2 * e).exp() + 1u32).recip();
        let weight = x.clone().pow(l as u32) * y.pow((size - l + 1) as u32) * place.cosh();
        let volume = Float::with_val(BITS, &x * size) + inner;
        let d = (l - Float::with_val(BITS, &x * size)) / volume;
        let g = match statistic {
            Statistic::Deviation => d,
            Statistic::Square => d.square(),
        };
        mass += &weight;
        sum += weight * (g * t).exp();
    }
    (sum / mass).ln().to_f64()
}

#[test]
fn cumulants_are_right_and_rounded_up() {
    let mut worst = 0.0f64;
    for place in PLACES {
        let law = law(place.0, place.1, place.2);
        for statistic in [Statistic::Deviation, Statistic::Square] {
            for size in [0.01, 0.3, 5.0] {
                let t = size / law.size(statistic);
                worst = worst.max(error(&law, *place, statistic, -t).abs());
                match place.0 {
                    0 => assert_eq!(law.cumulant(statistic, t), f64::INFINITY),
                    // Beside the rarest U, so near to nothing, the slack is no measure.
                    1 if place.1 == 40 => _ = error(&law, *place, statistic, t),
                    _ => worst = worst.max(error(&law, *place, statistic, t).abs()),
                }
            }
        }
    }
    println!("error at most {worst:.1e} of the slack");
    assert!(worst < 0.1);
}

/// The error of a cumulant before its slack is added, in units of that.
fn error(law: &Law, place: (u64, u64, u64), statistic: Statistic, t: f64) -> f64 {
    let [inner, size, l] = [place.0, place.1, place.2].map(|n| n as f64);
    let ends = [l / inner, (l - size) / (inner + size)];
    let greatest = ends
        .map(|d| t * statistic.of(d))
        .into_iter()
        .fold(0.0, f64::max);
    let slack = 1e-12 * (1.0 + greatest);
    let raised = law.cumulant(statistic, t) - exact_cumulant(place, statistic, t);
    assert!(raised > 0.0, "{place:?} {statistic:?} {t}: {raised:e}");
    raised / slack - 1.0
}

/// `P(Bin(m, x) >= l)` in rational numbers.
fn exact_distribution(size: u64, l: u64, x: f64) -> f64 {
    let x = Rational::from_f64(x).expect("finite");
    let y = Rational::from(1 - &x);
    let mut binomial = Rational::from(1);
    let mut sum = Rational::new();
    for j in 0..=size {
        if j >= l {
            let powers = x.clone().pow(j as u32) * y.clone().pow((size - j) as u32);
            sum += powers * &binomial;
        }
        binomial *= Rational::from((size - j, j + 1));
    }
    sum.to_f64()
}

#[test]
fn the_distribution_function_is_a_binomial_tail() {
    for (inner, size, l) in PLACES {
        let law = law(*inner, *size, *l);
        for x in [
            1.0 / 1024.0,
            0.125,
            0.25,
            0.5,
            0.625,
            0.875,
            1023.0 / 1024.0,
        ] {
            let found = law.distribution(*inner as f64 + *size as f64 * x);
            let truth = exact_distribution(*size, *l, x);
            assert!(
                (found - truth).abs() < 1e-13,
                "{inner} {size} {l} {x}: {found} {truth}"
            );
        }
    }
}

/// The two tails meet at the peak, and nodes that far out have little beyond them.
#[test]
fn the_distribution_function_of_thick_shells() {
    for l in [1u64, 2, 1000, 500_000, 999_999, 1_000_000] {
        let law = law(5, 1_000_000, l);
        let peak = 5.0 + 1e6 * l as f64 / 1_000_001.0;
        let [below, above] = [peak * (1.0 - 1e-15), peak * (1.0 + 1e-15)];
        let jump = law.distribution(above) - law.distribution(below);
        // The argument moves by 2e-15.
        let share = l as f64 / 1_000_001.0;
        let width = (share * (1.0 - share) / 1e6).sqrt();
        assert!(jump.abs() < 1e-11 + 2e-15 / width, "{l}: {jump:e}");
        assert!(
            (0.3..0.7).contains(&law.distribution(peak)),
            "{l}: {}",
            law.distribution(peak)
        );
    }
}

#[test]
fn what_is_no_photon() {
    assert_eq!(Photon::new(3, 2, 3), None);
    assert_eq!(Photon::new(3, 2, 0), None);
    assert_eq!(Photon::new(1 << 50, 2, 1), None);
    let sequence = Layout::Sequence(vec![2, 0, 3]);
    assert_eq!(expected(&sequence, &[4, 5, 6]), Err(Error::NoPhoton(6)));
    assert_eq!(expected(&sequence, &[2, 2]), Err(Error::Order(2)));
    assert_eq!(expected(&Layout::Listing, &[0]), Err(Error::NoPhoton(0)));
    assert_eq!(expected(&sequence, &[1, 5]).map(|all| all.len()), Ok(2));
    assert!(expected(&Layout::One, &[1 << 60]).is_err());
}

/// The largest and the most lopsided shells make no more nodes than small ones.
#[test]
fn laws_of_extreme_shells() {
    let far = (1u64 << 50) - 1;
    for place in [
        (0, far, 1),
        (0, far, far),
        (0, far, far / 2),
        (far - 1, 1, 1),
        (1, far - 1, 1),
    ] {
        let law = law(place.0, place.1, place.2);
        assert!(law.moment(1).is_finite() || place.2 == 1);
        assert!(law.cumulant(Statistic::Deviation, -1.0) < 1.0);
    }
}
