//! What is asked of a shell, and how it follows from one mean.

use super::ShellError;
use crate::model::Shell;
use crate::number::Interval;
use rug::{Integer, Rational};

/// What is asked of a shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// `F = 2F1(1, l; m+1; -V/Va)`, the mean of `Va/U`.
    Function,
    /// `E`, the mean of `k/U`.
    Mean,
    /// `E - 1`, the relative bias.
    Excess,
    /// The variance of `k/U`.
    Variance,
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Quantity; 4] = [
        Quantity::Function,
        Quantity::Mean,
        Quantity::Excess,
        Quantity::Variance,
    ];
}

/// A value for each quantity.
///
/// # Errors
/// The last one that comes up.
pub(super) fn each<const N: usize>(
    quantities: [Quantity; N],
    mut value: impl FnMut(Quantity) -> Result<Interval, ShellError>,
) -> Result<[Interval; N], ShellError> {
    let mut failed = None;
    let values = quantities.map(|quantity| {
        value(quantity).unwrap_or_else(|error| {
            failed = Some(error);
            Interval::from_i64(0, 2)
        })
    });
    failed.map_or(Ok(values), Err)
}

/// # Errors
/// `NoShell` for no shell of the model.
pub(super) fn check(shell: &Shell) -> Result<(), ShellError> {
    let Shell {
        inner,
        volume,
        position: l,
        count: m,
    } = shell;
    if *l < 1 || l > m || *inner < 0 || *volume <= 0 {
        return Err(ShellError::NoShell);
    }
    Ok(())
}

/// The rational numbers of a shell of the model, A = Va+V.
pub(super) struct Numbers {
    /// w = V/A
    pub(super) w: Rational,
    /// k/A, k = Va+l
    pub(super) k: Rational,
    /// q = m+1-l
    pub(super) q: Integer,
    /// s = m+1
    pub(super) s: Integer,
}

impl Numbers {
    pub(super) fn new(shell: &Shell) -> Numbers {
        let (l, m) = (&shell.position, &shell.count);
        let outer = Rational::from(&shell.inner + &shell.volume);
        let s = Integer::from(m + 1u32);
        Numbers {
            w: Rational::from(&shell.volume / &outer),
            k: Rational::from(&shell.inner + l) / outer,
            q: Integer::from(&s - l),
            s,
        }
    }

    /// The quantities from an enclosure of `x = mean(A/U) - 1`, for `Va > 0`.
    pub(super) fn all<const N: usize>(
        &self,
        quantities: [Quantity; N],
        x: &Interval,
    ) -> Result<[Interval; N], ShellError> {
        each(quantities, |quantity| self.quantity(quantity, x))
    }

    /// One quantity from an enclosure of x.
    ///
    /// Theorem. `F = (1-w)(1+x)`, `E = (k/A)(1+x)` and, with X = A/U - 1,
    /// `(1-w) mean(X^2) = w q - (s - w (q+1)) x`, so that `Var = (k/A)^2 (mean(X^2) - x^2)`.
    /// Proof. A/U = 1/(1 - w y), y ~ Beta(q, l). The means of `(A/U)^2` and of A/U are contiguous functions,
    /// 2F1(2, q; s; w) and 2F1(1, q; s; w), and DLMF 15.5.11 (a = 1) reads
    /// `(1-w) mean((A/U)^2) = (s-1) + (2-s + (q-1) w) mean(A/U)`; put `A/U = 1+X`. QED. (It is the thesis's 2.104.)
    pub(super) fn quantity(
        &self,
        quantity: Quantity,
        x: &Interval,
    ) -> Result<Interval, ShellError> {
        let precision = x.precision();
        let number = |value: &Rational| Interval::from_rational(value, precision);
        let one = Interval::from_i64(1, precision);
        let k = number(&self.k);
        let rest = number(&(1u32 - self.w.clone()));
        Ok(match quantity {
            Quantity::Function => one.add(x).mul(&rest),
            Quantity::Mean => one.add(x).mul(&k),
            // (k/A - 1) + (k/A) x, the first exact.
            Quantity::Excess => number(&(self.k.clone() - 1u32)).add(&k.mul(x)),
            Quantity::Variance => {
                let top = number(&Rational::from(&self.w * &self.q));
                let slope = &self.s - self.w.clone() * Integer::from(&self.q + 1u32);
                let square = top.sub(&number(&slope).mul(x)).div(&rest)?;
                square.sub(&x.square()).mul(&k.square())
            }
        })
    }

    /// The quantities from an enclosure of F, for `Va > 0`.
    pub(super) fn by_function<const N: usize>(
        &self,
        quantities: [Quantity; N],
        function: &Interval,
    ) -> Result<[Interval; N], ShellError> {
        let precision = function.precision();
        let rest = Interval::from_rational(&(1u32 - self.w.clone()), precision);
        let x = function.div(&rest)?.sub(&Interval::from_i64(1, precision));
        each(quantities, |quantity| match quantity {
            Quantity::Function => Ok(function.clone()),
            _ => self.quantity(quantity, &x),
        })
    }
}
