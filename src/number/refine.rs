//! The precision ladder: a computation is repeated with doubled bits until its enclosure decides a
//! question.
//!
//! The loop ends because the precision doubles up to a cap. It ends earlier where more bits cannot
//! help: a point is the value itself, and two rungs with the same finite ends have no rounding in
//! them that a finer rung could remove.

use super::Interval;

/// How a climb of the ladder ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Refined {
    /// This enclosure decides the question.
    Decided(Interval),
    /// The enclosure does not decide, and more bits cannot help.
    Stuck(Interval),
    /// The cap was reached; the last enclosure, if any rung gave one.
    Capped(Option<Interval>),
}

/// Repeats `compute` with `first` bits, twice as many, and so on up to `cap` bits, until `decides`
/// says yes. `compute` gives `None` where a precision is too low to enclose anything.
///
/// # Errors
/// The first error of `compute`.
pub fn refine<E>(
    first: u32,
    cap: u32,
    mut compute: impl FnMut(u32) -> Result<Option<Interval>, E>,
    decides: impl Fn(&Interval) -> bool,
) -> Result<Refined, E> {
    let mut bits = first.max(2);
    let mut last: Option<Interval> = None;
    loop {
        if let Some(next) = compute(bits)? {
            if decides(&next) {
                return Ok(Refined::Decided(next));
            }
            if next.is_point() || (next.is_bounded() && last.as_ref() == Some(&next)) {
                return Ok(Refined::Stuck(next));
            }
            last = Some(next);
        }
        if bits >= cap {
            return Ok(Refined::Capped(last));
        }
        bits = bits.saturating_mul(2).min(cap);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;
    use std::convert::Infallible;

    fn third(bits: u32) -> Result<Option<Interval>, Infallible> {
        Ok(Some(Interval::from_rational(&Rational::from((1, 3)), bits)))
    }

    #[test]
    fn decides_when_narrow_enough() {
        let Ok(Refined::Decided(found)) = refine(8, 1024, third, |i| i.agrees_to(50)) else {
            panic!("1/3 has 50 digits below 1024 bits");
        };
        assert_eq!(found.precision(), 256);
    }

    #[test]
    fn stops_at_the_cap_and_at_a_point() {
        let capped = refine(8, 64, third, |i| i.agrees_to(50));
        assert!(matches!(capped, Ok(Refined::Capped(Some(_)))));
        let half = |bits| {
            Ok::<_, Infallible>(Some(Interval::from_rational(&Rational::from((1, 2)), bits)))
        };
        let stuck = refine(8, 1 << 20, half, |i| i.contains_zero());
        assert!(matches!(stuck, Ok(Refined::Stuck(_))));
    }
}
