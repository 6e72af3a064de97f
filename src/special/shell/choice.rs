//! The choice: the cheapest method, and the lowest precision, that earn the digits.
//!
//! Costs and losses are estimates, from the shell in doubles; what comes out is looked at before it is given
//! out. Where the digits are not there the same method works with more bits, and a method that refuses
//! is left out. So the choice is never wrong, only slow where an estimate is.

use super::method::Method;
use super::quantity::Quantity;
use super::scene::Scene;
use super::sketch::{self, Sketch};
use super::{ShellError, words};
use crate::model::Shell;
use crate::number::Interval;

/// No more digits than this.
const MOST_DIGITS: u32 = 1_000_000;

/// How often a method may ask for more bits.
const ROUNDS: u32 = 6;

/// The bits of a relative width below 10^-digits: log2 10 < 3322/1000.
fn bits_of(digits: u32) -> u32 {
    (u64::from(digits) * 3322 / 1000) as u32 + 2
}

/// The quantity with a relative width below 10^-digits.
///
/// # Errors
/// [`ShellError`]: `NoShell`, `Domain` where there is no value, `Outside` where no method has one within its
/// cap of work (more than a million digits among them).
pub fn enclose(quantity: Quantity, shell: &Shell, digits: u32) -> Result<Interval, ShellError> {
    if digits > MOST_DIGITS {
        return Err(ShellError::Outside);
    }
    let bits = bits_of(digits);
    if let Ok(scene) = Scene::new(shell) {
        let sketch = Sketch::of(&scene);
        if words::is_cheapest(&sketch, bits) {
            let working = Method::Words.working_bits(quantity, &sketch, bits);
            let value = words::certified(quantity, &scene, working, bits);
            if let Ok(value) = value {
                return Ok(value);
            }
        }
    }
    let sketch = Sketch::new(shell)?;
    let mut methods = ranked(quantity, &sketch, bits);
    while let Some((method, working)) = methods.pop() {
        match climb(method, quantity, shell, working, bits) {
            Err(ShellError::Outside | ShellError::Lost) => {}
            result => return result,
        }
    }
    Err(ShellError::Outside)
}

/// The method that [`enclose`] tries first, and its working precision in bits.
///
/// # Errors
/// As [`enclose`].
pub fn choose(quantity: Quantity, shell: &Shell, digits: u32) -> Result<(Method, u32), ShellError> {
    if digits > MOST_DIGITS {
        return Err(ShellError::Outside);
    }
    let bits = bits_of(digits);
    let sketch = Sketch::new(shell)?;
    if Scene::new(shell).is_ok() && words::is_cheapest(&sketch, bits) {
        let working = Method::Words.working_bits(quantity, &sketch, bits);
        return Ok((Method::Words, working));
    }
    ranked(quantity, &sketch, bits)
        .pop()
        .ok_or(ShellError::Outside)
}

/// The methods with their working precisions, the cheapest last.
fn ranked(quantity: Quantity, sketch: &Sketch, bits: u32) -> Vec<(Method, u32)> {
    let mut methods: Vec<(f64, Method, u32)> = Method::ALL
        .into_iter()
        .map(|method| {
            let working = method.working_bits(quantity, sketch, bits);
            (method.cost(sketch, working), method, working)
        })
        .filter(|(cost, ..)| cost.is_finite())
        .collect();
    methods.sort_by(|a, b| b.0.total_cmp(&a.0));
    methods
        .into_iter()
        .map(|(_, method, bits)| (method, bits))
        .collect()
}

/// One method, with more bits until the relative width is below 2^-bits.
fn climb(
    method: Method,
    quantity: Quantity,
    shell: &Shell,
    mut working: u32,
    bits: u32,
) -> Result<Interval, ShellError> {
    for _ in 0..ROUNDS {
        let missing = match method.enclose(quantity, shell, working) {
            Ok(value) => match missing_bits(&value, bits) {
                0 => return Ok(value),
                missing => missing,
            },
            Err(ShellError::Lost) => working / 2,
            Err(error) => return Err(error),
        };
        working = working
            .saturating_add(missing.min(working))
            .saturating_add(8);
    }
    Err(ShellError::Lost)
}

/// The bits by which the relative width exceeds 2^-bits; 0 where it does not.
fn missing_bits(value: &Interval, bits: u32) -> u32 {
    if value.is_point() {
        return 0;
    }
    if value.contains_zero() || !value.is_bounded() {
        return u32::MAX;
    }
    let least = value.abs().low().get_exp().unwrap_or(i32::MIN);
    let width = Interval::from_ends(value.width(), value.width());
    // |value| >= 2^(least-1), width < 2^exponent
    let missing = i64::from(bits) + sketch::exponent(&width) - (i64::from(least) - 1);
    missing.clamp(0, i64::from(u32::MAX)) as u32
}
