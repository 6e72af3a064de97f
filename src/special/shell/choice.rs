//! The choice: the cheapest method, and the lowest precision, that earn the digits.
//!
//! Costs and losses are estimates, from the shell in doubles; what comes out is looked at before it is given
//! out. Where the digits are not there the same method works with more bits, and a method that refuses
//! is left out. So the choice is never wrong, only slow where an estimate is.

use super::method::{MOST_BITS, Method};
use super::quantity::Quantity;
use super::scene::Scene;
use super::sketch::{self, Sketch};
use super::{ShellError, words};
use crate::model::Shell;
use crate::number::{DomainError, Interval};

/// No more digits than this.
const MOST_DIGITS: u32 = 1_000_000;

/// How often a method may ask for more bits.
const ROUNDS: u32 = 6;

/// The bits of a relative width below 10^-digits: log2 10 < 3322/1000.
pub(super) fn bits_of(digits: u32) -> u32 {
    (u64::from(digits) * 3322 / 1000) as u32 + 2
}

/// The quantity with a relative width below 10^-digits.
///
/// # Errors
/// [`ShellError`]: `NoShell`, `Domain` where there is no value, `Outside` where no method has one within its
/// cap of work (more than a million digits among them).
pub fn enclose(quantity: Quantity, shell: &Shell, digits: u32) -> Result<Interval, ShellError> {
    let [value] = enclose_all([quantity], shell, digits)?;
    Ok(value)
}

/// Several quantities, each as [`enclose`] gives it, at about the cost of one.
///
/// ```
/// use claimcheck::model::Layout;
/// use claimcheck::special::shell::{Quantity, enclose_all};
/// let shell = Layout::Triangular.shell(&5050.into()).expect("a photon");
/// let [mean, variance] = enclose_all([Quantity::Mean, Quantity::Variance], &shell, 30)?;
/// assert_eq!(mean.to_decimal(12), "1.00019613538");
/// assert_eq!(variance.to_decimal(5), "3.7744e-8");
/// # Ok::<(), claimcheck::special::shell::ShellError>(())
/// ```
///
/// # Errors
/// As [`enclose`].
pub fn enclose_all<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    digits: u32,
) -> Result<[Interval; N], ShellError> {
    if digits > MOST_DIGITS {
        return Err(ShellError::Outside);
    }
    let bits = bits_of(digits);
    if let Ok(scene) = Scene::new(shell)
        && let Some(values) = by_words(quantities, &scene, bits)
    {
        return Ok(values);
    }
    let sketch = Sketch::new(shell)?;
    for (method, working) in ranked(&quantities, &sketch, bits) {
        match climb(method, quantities, shell, working, bits) {
            Err(ShellError::Outside | ShellError::Lost)
            | Err(ShellError::Domain(DomainError::Possible)) => {}
            result => return result,
        }
    }
    Err(ShellError::Outside)
}

/// The short way for most shells and up to a thousand digits: without a look at the other methods.
fn by_words<const N: usize>(
    quantities: [Quantity; N],
    scene: &Scene,
    bits: u32,
) -> Option<[Interval; N]> {
    let sketch = Sketch::of(scene);
    if !words::is_cheapest(&sketch, bits) {
        return None;
    }
    let mut working = Method::Words.working_bits(&quantities, &sketch, bits);
    for _ in 0..ROUNDS {
        match words::certified(quantities, scene, working, bits) {
            Err(ShellError::Lost) => working += 16,
            result => return result.ok(),
        }
    }
    None
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
        let working = Method::Words.working_bits(&[quantity], &sketch, bits);
        return Ok((Method::Words, working));
    }
    ranked(&[quantity], &sketch, bits)
        .next()
        .ok_or(ShellError::Outside)
}

/// The methods with their working precisions, the cheapest first.
fn ranked(
    quantities: &[Quantity],
    sketch: &Sketch,
    bits: u32,
) -> impl Iterator<Item = (Method, u32)> + use<> {
    let mut methods = Method::ALL.map(|method| {
        let working = method.working_bits(quantities, sketch, bits);
        (method.cost(sketch, working), method, working)
    });
    methods.sort_by(|a, b| a.0.total_cmp(&b.0));
    let usable = methods.into_iter().filter(|(cost, ..)| cost.is_finite());
    usable.map(|(_, method, working)| (method, working))
}

/// One method, with more bits until the relative widths are below 2^-bits.
fn climb<const N: usize>(
    method: Method,
    quantities: [Quantity; N],
    shell: &Shell,
    mut working: u32,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    for _ in 0..ROUNDS {
        let missing = match method.enclose_all(quantities, shell, working) {
            Ok(values) => match values.iter().map(|value| missing_bits(value, bits)).max() {
                None | Some(0) => return Ok(values),
                Some(missing) => missing,
            },
            Err(ShellError::Lost) => working / 2,
            Err(error) => return Err(error),
        };
        working = working
            .saturating_add(missing.min(working))
            .saturating_add(8)
            .min(MOST_BITS);
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
