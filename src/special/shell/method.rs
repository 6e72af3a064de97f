//! The methods, as one list.

use super::quantity::{Quantity, check};
use super::sketch::Sketch;
use super::{
    ShellError, choice, direct, downwards, euler, exact, middle, moments, pfaff, scene::Scene,
    splitting, thesis, upwards, words,
};
use crate::model::Shell;
use crate::number::Interval;

/// No working precision is larger.
pub(super) const MOST_BITS: u32 = 1 << 26;

/// A way to compute; each in the file of its name, with its theorem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// The power series at `-V/Va`.
    Direct,
    /// Pfaff's series, all terms positive, in intervals.
    Pfaff,
    /// `a + b ln(1 + V/Va)` with exact a and b.
    Exact,
    /// The contiguous relation from the shell's first photon.
    Upwards,
    /// The contiguous relation from the shell's last photon.
    Downwards,
    /// The contiguous relation from the middle of the shell.
    Middle,
    /// Central moments with a remainder.
    Moments,
    /// Euler's integral by quadrature.
    Euler,
    /// Pfaff's series by binary splitting.
    Splitting,
    /// Pfaff's series in machine words.
    Words,
    /// The thesis's formulas in one precision.
    Thesis,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 11] = [
        Method::Words,
        Method::Splitting,
        Method::Exact,
        Method::Pfaff,
        Method::Moments,
        Method::Direct,
        Method::Middle,
        Method::Upwards,
        Method::Downwards,
        Method::Euler,
        Method::Thesis,
    ];

    /// An enclosure from a working precision of about `bits`: what is lost on the way is missing in the
    /// result, which is then wide.
    ///
    /// # Errors
    /// [`ShellError`]: `Outside` the method's domain, or `Lost` where not one digit would be left.
    pub fn enclose(
        self,
        quantity: Quantity,
        shell: &Shell,
        bits: u32,
    ) -> Result<Interval, ShellError> {
        let [value] = self.enclose_all([quantity], shell, bits)?;
        Ok(value)
    }

    /// As [`Method::enclose`], for several quantities at about the cost of one.
    ///
    /// # Errors
    /// As there.
    pub fn enclose_all<const N: usize>(
        self,
        quantities: [Quantity; N],
        shell: &Shell,
        bits: u32,
    ) -> Result<[Interval; N], ShellError> {
        check(shell)?;
        if bits > MOST_BITS {
            return Err(ShellError::Outside);
        }
        let bits = bits.max(2);
        match self {
            Method::Direct => direct::enclose(quantities, shell, bits),
            Method::Pfaff => pfaff::enclose(quantities, shell, bits),
            Method::Exact => exact::enclose(quantities, shell, bits),
            Method::Upwards => upwards::enclose(quantities, shell, bits),
            Method::Downwards => downwards::enclose(quantities, shell, bits),
            Method::Middle => middle::enclose(quantities, shell, bits),
            Method::Moments => moments::enclose(quantities, shell, bits),
            Method::Euler => euler::enclose(quantities, shell, bits),
            Method::Splitting => splitting::enclose(quantities, shell, bits),
            Method::Words => words::enclose(quantities, &Scene::new(shell)?, bits),
            Method::Thesis => thesis::enclose(quantities, shell, bits),
        }
    }

    /// The bits to work with so that `bits` remain, about.
    pub(super) fn working_bits(self, quantities: &[Quantity], sketch: &Sketch, bits: u32) -> u32 {
        let losses = quantities.iter().map(|&quantity| sketch.loss(quantity));
        let loss = losses.fold(0.0, f64::max);
        let loss = match self {
            // Sums of one sign times exact factors; only E - 1 for k < mean(U) can cancel.
            Method::Moments => 0.0,
            Method::Upwards => loss + sketch.walk_loss(1.0, sketch.l),
            Method::Downwards => loss + sketch.walk_loss(sketch.l, sketch.s - 1.0),
            Method::Thesis => loss + 8.0,
            _ => loss,
        };
        bits.saturating_add(loss.ceil() as u32)
            .saturating_add(5)
            .min(MOST_BITS)
    }

    /// The working precision, in bits, from which so many digits remain, about; 0 for no shell.
    pub fn bits_for(self, quantity: Quantity, shell: &Shell, digits: u32) -> u32 {
        let bits = choice::bits_of(digits);
        Sketch::new(shell).map_or(0, |sketch| self.working_bits(&[quantity], &sketch, bits))
    }

    /// Machine instructions that [`Method::enclose`] is expected to take; infinite outside the domain, and for no shell.
    pub fn estimate(self, shell: &Shell, bits: u32) -> f64 {
        if bits > MOST_BITS {
            return f64::INFINITY;
        }
        Sketch::new(shell).map_or(f64::INFINITY, |sketch| self.cost(&sketch, bits))
    }

    /// Instructions, about, with a working precision of so many bits; infinite outside the domain.
    pub(super) fn cost(self, sketch: &Sketch, bits: u32) -> f64 {
        match self {
            Method::Direct => direct::cost(sketch, bits),
            Method::Pfaff => pfaff::cost(sketch, bits),
            Method::Exact => exact::cost(sketch, bits),
            Method::Upwards => upwards::cost(sketch, bits),
            Method::Downwards => downwards::cost(sketch, bits),
            Method::Middle => middle::cost(sketch, bits),
            Method::Moments => moments::cost(sketch, bits),
            Method::Euler => euler::cost(sketch, bits),
            Method::Splitting => splitting::cost(sketch, bits),
            Method::Words => words::cost(sketch, bits),
            Method::Thesis => thesis::cost(sketch, bits),
        }
    }
}
