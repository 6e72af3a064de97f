//! The thesis's quantities in plain machine doubles, as one writes them down: what a user has without enclosures.
//!
//! Each [`Recipe`] is a formula in operations on doubles, without a bound of its error. Its inputs are exact ([`Scene`]), and
//! each is given its best case: coefficients and starting values are rounded correctly, sums run until the rest no longer matters, a
//! quadrature has the nodes that it needs. So what is lost is the formula's own. Where a recipe can tell that it has no
//! answer it says why ([`Failure`]); what it cannot tell are wrong digits.
//!
//! | recipe | formula | what it is known to suffer from |
//! |---|---|---|
//! | [`Recipe::Direct`] | the power series at z, DLMF 15.2.1 | diverges for z < -1, crawls at -1 |
//! | [`Recipe::Pfaff`] | Pfaff's series of positive terms, DLMF 15.8.1 | many terms for large -z |
//! | [`Recipe::Closed`] | `a + b ln(1 + V/Va)`, a and b rounded correctly | a and b ln cancel |
//! | [`Recipe::Upwards`], [`Recipe::Downwards`], [`Recipe::Middle`] | the contiguous relation along the shell | errors that grow, long walks |
//! | [`Recipe::Moments`] | central moments of U | terms that grow in thick shells of few photons |
//! | [`Recipe::Euler`] | Euler's integral, DLMF 15.6.1, by the trapezoidal rule | nothing, with a rule that follows the peak |
//! | [`Recipe::Formula`] | the thesis's 2.102 and 2.104 on the correctly rounded F | both cancel |
//! | [`Recipe::Certified`] | [`special::doubles`](crate::special::doubles) | whole volumes equal to the number of photons only |

mod closed;
mod euler;
mod moments;
mod series;
mod walk;

use crate::model::Shell;
use crate::number::Interval;
use crate::special::doubles::neighbours;
use crate::special::shell::Quantity;
use rug::{Integer, Rational};

/// No recipe takes more terms, steps or nodes than this.
pub const MOST_STEPS: u32 = 10_000;

/// A sum ends before a rest of a quarter of the last bit.
const REST: f64 = f64::EPSILON / 8.0;

/// Photon l of m in a shell of volume V around the volume Va, all exact doubles; l and m are whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    /// Va
    pub inner: f64,
    /// V
    pub volume: f64,
    /// l
    pub position: f64,
    /// m
    pub count: f64,
}

/// A formula in doubles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Recipe {
    /// The power series of F at z = -V/Va.
    Direct,
    /// Pfaff's series for mean((Va+V)/U) - 1, and what follows from it.
    Pfaff,
    /// `a + b ln(1 + V/Va)`, a and b correctly rounded.
    Closed,
    /// The contiguous relation from the shell's first photon.
    Upwards,
    /// The contiguous relation from the shell's last photon.
    Downwards,
    /// The contiguous relation from the photon where no error grows.
    Middle,
    /// Central moments.
    Moments,
    /// Euler's integral by the trapezoidal rule in the logit of x.
    Euler,
    /// Formulas 2.102 and 2.104 on the correctly rounded F.
    Formula,
    /// The doubles with proved bounds of this crate.
    Certified,
}

/// Why a recipe gives no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Failure {
    /// A number beyond the range of doubles.
    #[error("a number on the way overflows")]
    Overflow,
    /// The terms grow.
    #[error("the series diverges")]
    Divergence,
    /// Outside the domain.
    #[error("outside the recipe's domain")]
    Refusal,
    /// More than [`MOST_STEPS`].
    #[error("more than {MOST_STEPS} steps")]
    Cost,
}

impl Recipe {
    /// All recipes.
    pub const ALL: [Recipe; 10] = [
        Recipe::Direct,
        Recipe::Pfaff,
        Recipe::Closed,
        Recipe::Upwards,
        Recipe::Downwards,
        Recipe::Middle,
        Recipe::Moments,
        Recipe::Euler,
        Recipe::Formula,
        Recipe::Certified,
    ];

    /// In two words or so.
    pub fn name(self) -> &'static str {
        match self {
            Recipe::Direct => "power series",
            Recipe::Pfaff => "Pfaff's series",
            Recipe::Closed => "closed form with ln",
            Recipe::Upwards => "relation upwards",
            Recipe::Downwards => "relation downwards",
            Recipe::Middle => "relation from the middle",
            Recipe::Moments => "central moments",
            Recipe::Euler => "Euler's integral",
            Recipe::Formula => "thesis's formula",
            Recipe::Certified => "certified doubles",
        }
    }

    /// The quantity in doubles. `function` encloses F to at least 20 digits: the correctly rounded numbers that some
    /// recipes start from are taken from it.
    ///
    /// ```
    /// use claimcheck::measure::plain::{Recipe, Scene};
    /// use claimcheck::special::shell::{Quantity, enclose};
    /// // Photon 5 of strategy 2: the 2nd of 3 around the volume 3, F = 2F1(1, 2; 4; -1) = 9 - 12 ln 2.
    /// let scene = Scene { inner: 3.0, volume: 3.0, position: 2.0, count: 3.0 };
    /// let function = enclose(Quantity::Function, &scene.shell().expect("a shell"), 25)?;
    /// let found = Recipe::Pfaff.compute(Quantity::Function, &scene, &function)?;
    /// assert!((found - (9.0 - 12.0 * 2f64.ln())).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Failure`]
    pub fn compute(
        self,
        quantity: Quantity,
        scene: &Scene,
        function: &Interval,
    ) -> Result<f64, Failure> {
        if scene.inner <= 0.0 {
            return Err(Failure::Refusal);
        }
        let value = match self {
            Recipe::Pfaff => scene.by_pfaff(quantity, series::pfaff(scene)?),
            Recipe::Moments => moments::value(quantity, scene)?,
            Recipe::Certified => certified(quantity, scene)?,
            Recipe::Direct => scene.by_function(quantity, series::direct(scene)?),
            Recipe::Closed => scene.by_function(quantity, closed::function(scene, function)?),
            Recipe::Upwards => scene.by_function(quantity, walk::function(scene, 1.0)?),
            Recipe::Downwards => scene.by_function(quantity, walk::function(scene, scene.count)?),
            Recipe::Middle => {
                scene.by_function(quantity, walk::function(scene, walk::middle(scene))?)
            }
            Recipe::Euler => scene.by_function(quantity, euler::function(scene)?),
            Recipe::Formula => scene.by_function(quantity, function.midpoint().to_f64()),
        };
        value.is_finite().then_some(value).ok_or(Failure::Overflow)
    }
}

impl Scene {
    /// The same in exact numbers; `None` where a number is not finite.
    pub fn shell(&self) -> Option<Shell> {
        Some(Shell {
            inner: Rational::from_f64(self.inner)?,
            volume: Rational::from_f64(self.volume)?,
            position: Integer::from_f64(self.position)?,
            count: Integer::from_f64(self.count)?,
        })
    }

    /// k = Va + l
    fn k(&self) -> f64 {
        self.inner + self.position
    }

    /// Va + V
    fn outer(&self) -> f64 {
        self.inner + self.volume
    }

    /// m + 1
    fn s(&self) -> f64 {
        self.count + 1.0
    }

    /// m + 1 - l
    fn q(&self) -> f64 {
        self.s() - self.position
    }

    /// From F by 2.102, `E = k F/Va`, and 2.104.
    fn by_function(&self, quantity: Quantity, f: f64) -> f64 {
        let (k, a, v, l, m) = (self.k(), self.inner, self.volume, self.position, self.count);
        match quantity {
            Quantity::Function => f,
            Quantity::Mean => k * f / a,
            Quantity::Excess => k * f / a - 1.0,
            Quantity::Variance => {
                let square = k * k * ((a - m * a - l * v + v) * f + a * m) / (a * a * (a + v));
                square - k * k * f * f / (a * a)
            }
        }
    }

    /// From `x = mean((Va+V)/U) - 1`, by the formulas of [`crate::special::shell`].
    fn by_pfaff(&self, quantity: Quantity, x: f64) -> f64 {
        let (outer, s, q) = (self.outer(), self.s(), self.q());
        let (w, rest, k) = (self.volume / outer, self.inner / outer, self.k() / outer);
        match quantity {
            Quantity::Function => rest * (1.0 + x),
            Quantity::Mean => k * (1.0 + x),
            // k/A - 1 = (l-V)/A
            Quantity::Excess => (self.position - self.volume) / outer + k * x,
            Quantity::Variance => {
                let square = (w * q - (s - w * (q + 1.0)) * x) / rest;
                k * k * (square - x * x)
            }
        }
    }
}

/// One photon of [`neighbours`].
fn certified(quantity: Quantity, scene: &Scene) -> Result<f64, Failure> {
    let whole = |x: f64| (x.fract() == 0.0 && x < 2f64.powi(50)).then_some(x as u64);
    let (Some(inner), Some(size), Some(position)) = (
        whole(scene.inner),
        whole(scene.count),
        whole(scene.position),
    ) else {
        return Err(Failure::Refusal);
    };
    if scene.volume != scene.count {
        return Err(Failure::Refusal);
    }
    let (mut excess, mut variance) = ([0.0], [0.0]);
    neighbours(inner, size, position, &mut excess, &mut variance).map_err(|_| Failure::Refusal)?;
    let mean = 1.0 + excess[0];
    Ok(match quantity {
        Quantity::Function => mean * scene.inner / scene.k(),
        Quantity::Mean => mean,
        Quantity::Excess => excess[0],
        Quantity::Variance => variance[0],
    })
}

#[cfg(test)]
mod tests;
