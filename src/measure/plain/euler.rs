//! Euler's integral as a mean, `F = mean(Va/(Va + V x))`, x ~ Beta(l, m-l+1), by Fejér's first rule (`special::shell`, `euler.rs`).
//!
//! The rule takes both the integral and that of the density alone, so that no Gamma function is needed, and the density relative
//! to its peak, so that nothing overflows: `density(x)/density(x*)`, `x* = (l-1)/(m-1)`.

use super::{Failure, Scene};
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Nodes come by so many; at most this many times.
const STEP: usize = 32;
const MOST: usize = 32;

/// A node: x and 1-x, each to full accuracy, and its weight.
#[derive(Clone, Copy)]
struct Node {
    x: f64,
    rest: f64,
    weight: f64,
}

pub(super) fn function(scene: &Scene) -> Result<f64, Failure> {
    let (left, right) = (scene.position - 1.0, scene.count - scene.position);
    let peak = match left + right {
        0.0 => 0.5,
        sum => left / sum,
    };
    let power = |x: f64, peak: f64, exponent: f64| match exponent {
        0.0 => 1.0,
        exponent => (x / peak).powf(exponent),
    };
    let (mut mean, mut mass) = (0.0, 0.0);
    for node in rule(scene)? {
        let density = power(node.x, peak, left) * power(node.rest, 1.0 - peak, right);
        let part = node.weight * density;
        mass += part;
        mean += part * scene.inner / (scene.inner + scene.volume * node.x);
    }
    Ok(mean / mass)
}

/// A rule of enough nodes for a remainder below 2^-56 of F: the bound of `special::shell`, with the least value
/// of F, Va/(Va+V); and exact for the density.
fn rule(scene: &Scene) -> Result<&'static [Node], Failure> {
    static RULES: [OnceLock<Vec<Node>>; MOST] = [const { OnceLock::new() }; MOST];
    let a = 1.0 + scene.inner / scene.volume;
    let rho = a + ((a - 1.0) * (a + 1.0)).sqrt();
    let (l, m) = (scene.position, scene.count);
    // log2 of the constant C, by entropy
    let part = |x: f64| if x > 0.0 { x * x.log2() } else { 0.0 };
    let constant = part(m) - part(l - 1.0) - part(m - l) + m.log2();
    let size = constant + (m - 1.0) * f64::midpoint(1.0, a).log2() + a.log2() - (a - 1.0).log2();
    let series = (1.0 - rho.recip()).log2();
    let nodes = ((56.0 + 3.0 + size - series) / rho.log2()).max(m) + 1.0;
    let index = (nodes / STEP as f64).ceil();
    if index.is_nan() || index > MOST as f64 {
        return Err(Failure::Cost);
    }
    let index = (index as usize).clamp(1, MOST);
    Ok(RULES[index - 1].get_or_init(|| fejer(index * STEP)))
}

/// Fejér's first rule on [0, 1].
fn fejer(n: usize) -> Vec<Node> {
    (1..=n)
        .map(|j| {
            let angle = (2 * j - 1) as f64 * PI / (2 * n) as f64;
            let cosine = |i: usize| {
                let turned = 2 * i * (2 * j - 1) % (4 * n);
                (turned as f64 * PI / (2 * n) as f64).cos()
            };
            let sum: f64 = (1..=n / 2)
                .rev()
                .map(|i| cosine(i) / (4 * i * i - 1) as f64)
                .sum();
            Node {
                x: (angle / 2.0).cos().powi(2),
                rest: (angle / 2.0).sin().powi(2),
                weight: (1.0 - 2.0 * sum) / n as f64,
            }
        })
        .collect()
}
