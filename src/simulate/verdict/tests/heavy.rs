//! The z of any sample mean: no alarms by heavy tails.

use super::super::z::Sample;
use super::*;

/// Alarms, and how often z counts, of `simulations` samples of `count` values.
fn alarms(count: u64, simulations: u64, mean: f64, value: impl Fn(f64) -> f64) -> (u64, u64) {
    let mut random = random(count);
    let (mut alarms, mut counted) = (0, 0);
    for _ in 0..simulations {
        let mut sample = Sample::default();
        (0..count).for_each(|_| sample.add(value(uniform(&mut random))));
        if let Some(z) = sample.against(mean).filter(|z| z.counts) {
            counted += 1;
            alarms += u64::from(z.z.abs() > 5.0);
        }
    }
    (alarms, counted)
}

#[test]
fn heavy_tails_make_no_alarms() {
    let simulations = simulations(40);
    for power in [0.3, 0.45, 0.6, 0.8, 0.95] {
        for count in [1000, 10_000] {
            let mean = 1.0 / (1.0 - power);
            let (alarms, counted) = alarms(count, simulations, mean, |x| x.powf(-power));
            println!(
                "1/x^{power}, {count} values: {alarms} alarms, {counted} of {simulations} count"
            );
            assert_eq!(alarms, 0);
            assert!(power < 0.5 || counted * 10 <= simulations);
        }
    }
}

#[test]
fn tame_samples_count() {
    for count in [5000, 10_000] {
        let (alarms, counted) = alarms(count, 20, 0.5, |x| x);
        assert_eq!((alarms, counted), (0, 20));
    }
    let (alarms, counted) = alarms(20_000, 20, 1.0, |x| -x.ln());
    assert_eq!((alarms, counted), (0, 20));
    // The mean is off by 7 standard errors.
    let (alarms, _) = alarms_of_a_fault();
    assert!(alarms >= 19);
}

fn alarms_of_a_fault() -> (u64, u64) {
    let off = 7.0 / (12.0f64 * 10_000.0).sqrt();
    alarms(10_000, 20, 0.5 + off, |x| x)
}

#[test]
fn one_pass_is_two_passes() {
    let mut random = random(1);
    let values: Vec<f64> = (0..1000).map(|_| 1e6 - uniform(&mut random).ln()).collect();
    let (mut whole, mut parts) = (Sample::default(), Sample::default());
    values.iter().for_each(|value| whole.add(*value));
    for part in values.chunks(37) {
        let mut sample = Sample::default();
        part.iter().for_each(|value| sample.add(*value));
        parts.merge(&sample);
    }
    let mean = values.iter().sum::<f64>() / 1000.0;
    let power = |p| {
        values
            .iter()
            .map(|value| (value - mean).powi(p))
            .sum::<f64>()
    };
    let kurtosis = 1000.0 * power(4) / power(2).powi(2);
    for sample in [whole, parts] {
        assert_eq!(sample.count(), 1000);
        assert!((sample.mean() - mean).abs() < 1e-8);
        assert!((sample.kurtosis() / kurtosis - 1.0).abs() < 1e-8);
    }
}

#[test]
fn what_has_no_z() {
    let of = |values: &[f64]| {
        let mut sample = Sample::default();
        values.iter().for_each(|value| sample.add(*value));
        sample.against(1.0)
    };
    assert_eq!(of(&[]), None);
    assert_eq!(of(&[1.0]), None);
    assert_eq!(of(&[2.0; 2000]), None);
    assert_eq!(of(&[1.0, f64::NAN, 2.0]), None);
    assert_eq!(of(&[1.0, f64::INFINITY, 2.0]), None);
    assert_eq!(Sample::default().against(f64::NAN), None);
}
