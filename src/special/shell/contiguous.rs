//! The contiguous relation along a shell, one step of it, for the three methods that use it.
//!
//! With F_l = 2F1(1, l; m+1; z), z = -V/Va, c = 1-z = (Va+V)/Va:
//!
//! ```text
//! (m-l) F_l + c l F_(l+1) = m
//! ```
//!
//! Proof. `J_l = int of x^(l-1) (1-x)^(m-l)/(1-zx)` over [0, 1]; from 1-zx = (1-x) + c x follows
//! `J_l + c J_(l+1) = B(l, m-l)`, and `F_l = J_l/B(l, m-l+1)` (DLMF 15.6.1).
//!
//! Theorem (errors). A step upwards multiplies an error of F_l by `-(m-l)/(c l)`, one downwards by the inverse:
//! both relations are affine. So upwards errors shrink for `l > m/(1+c)` and grow below, downwards the
//! other way; intervals follow by themselves. From the middle `l0 = m/(1+c)` outwards no error grows.

use super::ShellError;
use super::pfaff;
use super::quantity::{Numbers, Quantity};
use super::sketch::{self, Sketch};
use crate::model::Shell;
use crate::number::Interval;
use rug::{Integer, Rational};

/// The most steps.
const MOST_STEPS: u32 = 1 << 17;

/// Bits for the rounding errors of the steps.
const GUARD: u32 = 24;

/// A shell and where one stands in it.
pub(super) struct Walk<'a> {
    shell: &'a Shell,
    /// (Va+V)/Va
    c: Rational,
    l: Integer,
    function: Interval,
}

impl<'a> Walk<'a> {
    /// Starts at photon l by Pfaff's series.
    fn start(shell: &'a Shell, l: Integer, precision: u32) -> Result<Walk<'a>, ShellError> {
        let there = Shell {
            position: l.clone(),
            ..shell.clone()
        };
        let numbers = Numbers::new(&there);
        let x = pfaff::mean(&numbers, precision)?;
        Ok(Walk {
            shell,
            c: Rational::from(&shell.inner + &shell.volume) / &shell.inner,
            l,
            function: numbers.quantity(Quantity::Function, &x)?,
        })
    }

    /// `F_(l+1) = (m - (m-l) F_l)/(c l)`, for l < m.
    fn up(&mut self) -> Result<(), ShellError> {
        let m = &self.shell.count;
        let known = self.function.mul_integer(&Integer::from(m - &self.l));
        let above = Interval::from_integer(m, self.function.precision()).sub(&known);
        self.function = above
            .mul_integer(self.c.denom())
            .div_integer(&Integer::from(self.c.numer() * &self.l))?;
        self.l += 1;
        Ok(())
    }

    /// `F_l = (m - c l F_(l+1))/(m-l)`, for l >= 1.
    fn down(&mut self) -> Result<(), ShellError> {
        self.l -= 1;
        let m = &self.shell.count;
        let known = self
            .function
            .mul_integer(&Integer::from(self.c.numer() * &self.l))
            .div_integer(self.c.denom())?;
        let above = Interval::from_integer(m, self.function.precision()).sub(&known);
        self.function = above.div_integer(&Integer::from(m - &self.l))?;
        Ok(())
    }
}

/// From photon `start` of the shell to the shell's own.
pub(super) fn walk<const N: usize>(
    quantities: [Quantity; N],
    shell: &Shell,
    start: Integer,
    bits: u32,
) -> Result<[Interval; N], ShellError> {
    let numbers = Numbers::new(shell);
    let steps = Integer::from(&start - &shell.position).abs();
    if steps > MOST_STEPS || shell.inner == 0 {
        return Err(ShellError::Outside);
    }
    let mut walk = Walk::start(shell, start, bits + GUARD)?;
    while walk.l < shell.position {
        walk.up()?;
    }
    while walk.l > shell.position {
        walk.down()?;
    }
    numbers.by_function(quantities, &walk.function)
}

/// The photon from which errors shrink both ways, `m/(1+c) = m Va/(2 Va + V)` rounded into 1..m.
pub(super) fn middle(shell: &Shell) -> Integer {
    let both = Rational::from(&shell.inner * 2u32) + &shell.volume;
    let exact = Rational::from(&shell.inner * &shell.count) / both;
    let whole = exact.round().numer().clone();
    whole.max(Integer::from(1)).min(shell.count.clone())
}

/// The cost of a walk of so many steps from a place like the shell's own.
pub(super) fn cost(sketch: &Sketch, steps: f64, bits: u32) -> f64 {
    if steps > f64::from(MOST_STEPS) {
        return f64::INFINITY;
    }
    pfaff::cost(sketch, bits) + steps * sketch::interval_step(bits)
}
