//! Numbers that never lie: exact reals and intervals whose ends are rounded outwards.
//!
//! An [`Interval`] is a set of reals that is known to hold the value meant; every operation gives a
//! set that holds all results. An [`Exact`] is a closed form in logarithms, pi and roots, whose
//! equality with zero is decided by theorems, not by digits. Where neither can tell, the answer is
//! an error value or `None`, never a guess.

pub mod convert;
mod double;
mod exact;
pub mod fixed;
mod interval;
mod lanes;
mod refine;

pub use double::Double;
pub use exact::{Exact, ExactError};
pub use interval::{DomainError, Interval};
pub use lanes::{Lanes, Task, WIDTH, Wide};
pub use refine::{Refined, refine};
