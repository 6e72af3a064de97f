//! Cube roots in wide lanes, the same bits on every machine.
//!
//! **Theorem.** For `2^-1000 <= x <= 2^1000`: `|cube_root(x) - x^(1/3)| <= 2.1u x^(1/3)`, u = 2^-53. Proof. The upper half of a double's
//! bits, read as a whole number, is nearly linear in its logarithm; a third of it, with the offset of the exponent put right, is
//! the upper half of a first guess. Its relative error depends on the place of x in three octaves only, but for the lower half of x,
//! which moves it by less than 2^-20; a test tries all upper halves: at most 0.033. A step of Halley's method,
//! `y - y (y^3 - x)/(2 y^3 + x)`, takes an error e to less than `|e|^3`: three steps to 4e-5, 1e-13 and 1e-39. In the last one y^3 is
//! computed with an error below `2.01u x`, and so is the difference to x, which is less than `1e-12 x`; the quotient, a third of it
//! over x about, is off by less than 0.7u, and nothing else in it matters. The product and the subtraction add less than 1.1u. QED.

/// `x^(1/3)` for x between 2^-1000 and 2^1000; see the module.
#[inline(always)]
pub(super) fn cube_root(x: f64) -> f64 {
    // A whole number below 2^32 as the low bits of 2^52 and more.
    const WHOLE: f64 = 4_503_599_627_370_496.0;
    // Two thirds of the exponent's offset, 1023 2^20, less what makes the guess too large as often as too small.
    const OFFSET: f64 = 715_094_000.0;
    let high = f64::from_bits(x.to_bits() >> 32 | WHOLE.to_bits()) - WHOLE;
    let mut y = f64::from_bits((high * (1.0 / 3.0) + (WHOLE + OFFSET)).to_bits() << 32);
    for _ in 0..3 {
        let cube = y * y * y;
        y -= y * ((cube - x) / (cube + cube + x));
    }
    y
}

#[cfg(test)]
mod tests {
    use super::cube_root;
    use rug::Float;

    /// In units of 2^-53.
    fn error(x: f64) -> f64 {
        let exact = Float::with_val(200, x).cbrt();
        let off = Float::with_val(200, cube_root(x)) - &exact;
        (off / exact).to_f64().abs() * 2f64.powi(53)
    }

    #[test]
    fn roots_are_within_their_bound() {
        let mut worst: f64 = 0.0;
        // Three octaves, in which the guess goes once through its errors, and others.
        for part in (0..3 << 20).step_by(17) {
            let x = f64::from_bits(1.0f64.to_bits() + (part << 32) + part);
            worst = worst.max(error(x));
        }
        for power in -1000..=1000 {
            worst = worst.max(error(1.1 * 2f64.powi(power)));
        }
        assert!(worst < 2.1, "{worst}");
        assert!((1..1000u32).all(|n| error(f64::from(n)) < 2.1));
    }

    #[test]
    fn the_guess_is_as_near_as_the_proof_needs() {
        for part in 0..3u64 << 20 {
            let x = f64::from_bits(1.0f64.to_bits() + (part << 32));
            let high = (x.to_bits() >> 32) as f64;
            let guess = f64::from_bits(((high / 3.0 + 715_094_000.0) as u64) << 32);
            assert!((guess / x.cbrt() - 1.0).abs() < 0.033, "{x}");
        }
    }
}
