//! Central moments of U (`special::shell`, `moments.rs`): nothing cancels, so doubles suffice.

use super::{Failure, MOST_STEPS, REST, Scene};
use crate::special::shell::Quantity;

pub(super) fn value(quantity: Quantity, scene: &Scene) -> Result<f64, Failure> {
    let (l, s, q) = (scene.position, scene.s(), scene.q());
    let mu = scene.inner + scene.volume * l / s;
    // Outside the terms need not fall: H = (Va+V)/mu - 1 < 1 is asked for.
    if scene.outer() >= 2.0 * mu {
        return Err(Failure::Refusal);
    }
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

/// P1 and P2, until the remainder after an even number of terms no longer matters.
fn sums(scene: &Scene, mu: f64, rho: f64) -> Result<(f64, f64), Failure> {
    let (l, s, q) = (scene.position, scene.s(), scene.q());
    let (near, far) = ((l - q) * rho, q * l * rho * rho);
    let reach = mu / scene.inner;
    let (mut before, mut term) = (0.0, 1.0);
    let (mut first, mut second) = (0.0, 0.0);
    for n in 2..MOST_STEPS {
        let even = n % 2 == 0;
        let n = f64::from(n);
        if even && term * reach * reach * 2.0 * n <= REST * second {
            return Ok((first, second));
        }
        first += term;
        second += (n - 1.0) * term;
        let next = n / (s + n) * (near * term + far * before);
        before = term;
        term = next;
    }
    Err(Failure::Cost)
}
