//! Counted steps: a claim may spend so many, so that a book has the same verdicts on every machine.

use std::cell::Cell;

/// A number of steps that may still be spent. A step is about a microsecond of work: an operation on
/// numbers of `n` machine words spends about `1 + n` of them, and size is estimated *before* the
/// work is done.
#[derive(Debug)]
pub struct Budget {
    left: Cell<u64>,
    spent: Cell<u64>,
}

/// The steps are used up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the budget of steps is spent")]
pub struct Exhausted;

impl Budget {
    /// A budget of `steps`.
    pub fn new(steps: u64) -> Budget {
        Budget {
            left: Cell::new(steps),
            spent: Cell::new(0),
        }
    }

    /// Takes `steps` away.
    ///
    /// # Errors
    /// [`Exhausted`] when fewer are left; the budget is empty from then on.
    pub fn spend(&self, steps: u64) -> Result<(), Exhausted> {
        let left = self.left.get();
        self.spent
            .set(self.spent.get().saturating_add(steps.min(left)));
        match left.checked_sub(steps) {
            Some(rest) => {
                self.left.set(rest);
                Ok(())
            }
            None => {
                self.left.set(0);
                Err(Exhausted)
            }
        }
    }

    /// The steps spent so far.
    pub fn spent(&self) -> u64 {
        self.spent.get()
    }
}
