//! A walk over the shells of a layout, innermost first.

use super::{Layout, Shell};
use rug::{Integer, Rational};

/// The shells of a layout from that of one photon outwards; see [`Layout::walk`].
#[derive(Clone, Debug)]
pub struct Walk<'a> {
    layout: &'a Layout,
    /// The first photon not yet passed.
    photon: Integer,
    /// For a sequence: the shell looked at, and the photons inside it.
    index: usize,
    before: Integer,
}

impl Layout {
    /// The shells that hold the photons `first`, `first + 1`, ...: each with the first of these
    /// photons that lies in it. A layout without photon `first` has an empty walk.
    ///
    /// ```
    /// use claimcheck::model::Layout;
    /// let walk = Layout::Triangular.walk(&5.into());
    /// // Photon 5 is the second of three, photon 7 the first of four.
    /// let places: Vec<_> = walk.take(2).map(|(k, shell)| (k, shell.position, shell.count)).collect();
    /// assert_eq!(places[0], (5.into(), 2.into(), 3.into()));
    /// assert_eq!(places[1], (7.into(), 1.into(), 4.into()));
    /// ```
    pub fn walk(&self, first: &Integer) -> Walk<'_> {
        Walk {
            layout: self,
            photon: first.clone(),
            index: 0,
            before: Integer::new(),
        }
    }
}

impl Walk<'_> {
    /// The shell of the photon; a sequence is not looked through from its start each time.
    fn shell(&mut self) -> Option<Shell> {
        let Layout::Sequence(counts) = self.layout else {
            return self.layout.shell(&self.photon);
        };
        if self.photon < 1 {
            return None;
        }
        while let Some(&count) = counts.get(self.index) {
            if self.photon <= Integer::from(&self.before + count) {
                return Some(Shell {
                    inner: Rational::from(&self.before),
                    volume: count.into(),
                    position: Integer::from(&self.photon - &self.before),
                    count: count.into(),
                });
            }
            self.before += count;
            self.index += 1;
        }
        None
    }
}

impl Iterator for Walk<'_> {
    type Item = (Integer, Shell);

    fn next(&mut self) -> Option<(Integer, Shell)> {
        let shell = self.shell()?;
        let photon = self.photon.clone();
        self.photon += Integer::from(&shell.count - &shell.position) + 1u32;
        Some((photon, shell))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_photon_is_passed_once() {
        let layouts = [
            Layout::Unstratified(50.into()),
            Layout::One,
            Layout::Triangular,
            Layout::Listing,
            Layout::Sequence(vec![3, 0, 5, 1, 0, 0, 41]),
        ];
        for layout in &layouts {
            for first in [2u32, 7, 9] {
                let mut photon = Integer::from(first);
                for (k, shell) in layout.walk(&photon.clone()).take(6) {
                    assert_eq!(k, photon);
                    assert_eq!(layout.shell(&k), Some(shell.clone()));
                    photon += Integer::from(&shell.count - &shell.position) + 1u32;
                }
            }
        }
    }

    #[test]
    fn a_walk_ends_with_the_photons() {
        assert_eq!(Layout::Unstratified(5.into()).walk(&6.into()).next(), None);
        assert_eq!(Layout::Sequence(vec![2, 2]).walk(&1.into()).count(), 2);
        assert_eq!(Layout::Sequence(vec![2]).walk(&0.into()).next(), None);
        assert_eq!(Layout::Listing.walk(&1.into()).next(), None);
    }
}
