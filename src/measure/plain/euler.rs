//! Euler's integral (DLMF 15.6.1) as a mean, `F = mean(Va/(Va + V x))`, x ~ Beta(l, q), q = m+1-l, by the trapezoidal rule.
//!
//! With x = 1/(1 + e^-t) the density in t is `x^l (1-x)^q` times a constant: one peak at x0 = l/s, s = m+1, with a width of about
//! `sigma = sqrt(s/(l q))`, and tails that fall like `e^(l t)` and `e^(-q t)`. Density and integrand are analytic for |Im t| < pi, so
//! that the rule's error falls like `exp(-2 pi^2/step)`, or `exp(-2 pi^2 sigma^2/step^2)` for narrow peaks (Trefethen and Weideman, The exponentially
//! convergent trapezoidal rule, SIAM Review 56, 2014); with half of that step for peaks that lean to a side some hundred nodes suffice for any
//! shell.
//!
//! The rule takes both the integral and that of the density alone, so that no Gamma function is needed, and the density relative to its
//! peak, so that nothing overflows: with t = t0 + d,
//! `ln x/x0 = -ln(1 + (1-x0)(e^-d - 1))`, `ln (1-x)/(1-x0) = -ln(1 + x0 (e^d - 1))`.

use super::{Failure, MOST_STEPS, Scene};

/// Nodes this far below the peak, as a power of e, do not matter.
const DEEP: f64 = -50.0;

pub(super) fn function(scene: &Scene) -> Result<f64, Failure> {
    let (l, q, s) = (scene.position, scene.q(), scene.s());
    let step = (0.25 * (s / (l * q)).sqrt()).min(0.2);
    // Mean and mass, relative to the peak's.
    let mut sums = (scene.inner / (scene.inner + scene.volume * (l / s)), 1.0);
    for direction in [step, -step] {
        add_side(scene, direction, &mut sums)?;
    }
    Ok(sums.0 / sums.1)
}

/// The nodes on one side of the peak.
fn add_side(scene: &Scene, step: f64, (mean, mass): &mut (f64, f64)) -> Result<(), Failure> {
    let (l, q, s) = (scene.position, scene.q(), scene.s());
    let (peak, rest) = (l / s, q / s);
    for node in 1..MOST_STEPS {
        let d = f64::from(node) * step;
        let height = -l * (rest * (-d).exp_m1()).ln_1p() - q * (peak * d.exp_m1()).ln_1p();
        if height < DEEP {
            return Ok(());
        }
        let x = peak / (peak + rest * (-d).exp());
        let density = height.exp();
        *mass += density;
        *mean += density * scene.inner / (scene.inner + scene.volume * x);
    }
    Err(Failure::Cost)
}
