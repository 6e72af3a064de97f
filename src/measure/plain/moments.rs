//! Central moments of U (`special::shell`, `moments.rs`): nothing cancels, so doubles suffice.

use super::{Failure, MOST_STEPS, REST, Scene};
use crate::special::shell::Quantity;

pub(super) fn value(quantity: Quantity, scene: &Scene) -> Result<f64, Failure> {
    let (l, s, q) = (scene.position, scene.s(), scene.q());
    let mu = scene.inner + scene.volume * l / s;
    let rho = scene.volume / (mu * s);
    let t2 = rho * rho * q * l / (s + 1.0);
    let (first, second) = sums(scene, mu, rho)?;
    // k - mu = l (s-V)/s
    let offset = l * (s - scene.volume) / (s * mu);
    let (ratio, more) = (1.0 + offset, t2 * first);
    Ok(match quantity {
        Quantity::Function => scene.inner / mu * (1.0 + more),
        Quantity::Mean => ratio * (1.0 + more),
        Quantity::Excess => offset + ratio * more,
        Quantity::Variance => ratio * ratio * t2 * (second - more * first),
    })
}

/// P1 and P2, until the remainder after an even number of terms no longer matters: its bound holds whether or not the
/// terms fall for good.
fn sums(scene: &Scene, mu: f64, rho: f64) -> Result<(f64, f64), Failure> {
    let (l, s, q) = (scene.position, scene.s(), scene.q());
    let (near, far) = ((l - q) * rho, q * l * rho * rho);
    let reach = mu / scene.inner;
    // H = (Va+V)/mu - 1
    let height = scene.outer() / mu - 1.0;
    let (mut before, mut term) = (0.0, 1.0f64);
    let (mut first, mut second) = (0.0, 0.0);
    for n in 2..MOST_STEPS {
        let even = n % 2 == 0;
        let n = f64::from(n);
        if even && term * reach * reach * n * (1.0 + height) <= REST * second {
            return Ok((first, second));
        }
        first += term;
        second += (n - 1.0) * term;
        let next = n / (s + n) * (near * term + far * before);
        before = term;
        term = next;
        if !term.is_finite() {
            return Err(Failure::Divergence);
        }
    }
    // The terms fall for good where H < 1, or they are at a crawl.
    Err(match height > 1.0 {
        true => Failure::Divergence,
        false => Failure::Cost,
    })
}
