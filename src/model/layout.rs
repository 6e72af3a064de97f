//! Which shell holds photon k: exact integers throughout, so that a shell's edge is never missed.

use super::Shell;
use rug::{Integer, Rational};

/// How the photons are shared out over shells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Layout {
    /// All n photons in the one ball of volume n.
    Unstratified(Integer),
    /// Strategy 1: one photon a shell of volume 1.
    One,
    /// Strategy 2: shells of 1, 2, 3, ... photons; shell m holds the photons
    /// `m(m-1)/2 < k <= m(m+1)/2` and has volume m.
    Triangular,
    /// What the listing on page 22 of the thesis walks through. It starts from `k = 1`, adds one
    /// *before* each use, and takes `a = k - l` and `v = m`: its first photon is k = 2 with
    /// `Va = 1`. So all shells of strategy 2 are pushed outwards by one empty unit of volume, and
    /// photon 1 is never looked at.
    Listing,
    /// Shells of any numbers of photons, innermost first, each with volume equal to its number.
    Sequence(Vec<u64>),
}

impl Layout {
    /// The shell of photon `k`, or `None` where the layout has no such photon.
    pub fn shell(&self, k: &Integer) -> Option<Shell> {
        if *k < 1 {
            return None;
        }
        match self {
            Layout::Unstratified(n) => (k <= n).then(|| shell(k, k.clone(), n.clone())),
            Layout::One => Some(shell(k, 1.into(), 1.into())),
            Layout::Triangular => {
                let (l, m) = triangular(k);
                Some(shell(k, l, m))
            }
            Layout::Listing => {
                let walked = Integer::from(k - 1u32);
                if walked < 1 {
                    return None;
                }
                let (l, m) = triangular(&walked);
                Some(shell(k, l, m))
            }
            Layout::Sequence(counts) => sequence(k, counts),
        }
    }
}

/// Photon `k`, the l-th of m in a shell of volume m: the volume inside is `k - l`.
fn shell(k: &Integer, l: Integer, m: Integer) -> Shell {
    Shell {
        inner: Rational::from(k - &l),
        volume: Rational::from(&m),
        position: l,
        count: m,
    }
}

/// The l and m of photon `k >= 1` of strategy 2: the largest m with `m(m-1)/2 < k`, that is with
/// `(2m-1)^2 <= 8k-7`, so `m = floor((1 + isqrt(8k-7))/2)` by an exact integer root.
fn triangular(k: &Integer) -> (Integer, Integer) {
    let root = (Integer::from(k * 8u32) - 7u32).sqrt();
    let m: Integer = (root + 1u32) >> 1;
    let before: Integer = (&m * Integer::from(&m - 1u32)) >> 1;
    (Integer::from(k - &before), m)
}

fn sequence(k: &Integer, counts: &[u64]) -> Option<Shell> {
    let mut before = Integer::new();
    for &count in counts {
        let after = Integer::from(&before + count);
        if *k <= after {
            return Some(shell(k, Integer::from(k - &before), count.into()));
        }
        before = after;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(layout: &Layout, k: u64) -> (u64, u64, u64, u64) {
        let shell = layout.shell(&k.into()).expect("the photon exists");
        let whole = |q: &Rational| {
            assert!(q.is_integer());
            q.numer().to_u64().expect("small")
        };
        (
            whole(&shell.inner),
            whole(&shell.volume),
            shell.position.to_u64().expect("small"),
            shell.count.to_u64().expect("small"),
        )
    }

    #[test]
    fn triangular_walks_through_shells_in_order() {
        let mut k = 0;
        for m in 1..=60u64 {
            for l in 1..=m {
                k += 1;
                assert_eq!(place(&Layout::Triangular, k), (k - l, m, l, m));
            }
        }
    }

    #[test]
    fn listing_is_the_program_of_page_22() {
        assert_eq!(Layout::Listing.shell(&1.into()), None);
        // The program itself, its variables by their own names.
        let mut k = 1;
        for m in 1..40u64 {
            for l in 1..m + 1 {
                k += 1;
                let v = m;
                let a = k - l;
                assert_eq!(place(&Layout::Listing, k), (a, v, l, m));
            }
        }
    }

    #[test]
    fn triangular_at_the_edges_of_huge_shells() {
        // Around each of these m, both edges of the shell; the largest k is near 5*10^59.
        for m in [
            "44721359",
            "44721360",
            "1414213562",
            "1000000000000000000000000000000",
        ] {
            let m: Integer = m.parse().expect("digits");
            let before: Integer = (&m * Integer::from(&m - 1u32)) >> 1;
            let first = Layout::Triangular
                .shell(&Integer::from(&before + 1u32))
                .expect("first");
            assert_eq!((first.position, &first.count), (Integer::from(1), &m));
            assert_eq!(first.inner, before);
            let last = Layout::Triangular
                .shell(&Integer::from(&before + &m))
                .expect("last");
            assert_eq!((&last.position, &last.count), (&m, &m));
            let earlier = Layout::Triangular.shell(&before).expect("the shell inside");
            assert_eq!(earlier.count, Integer::from(&m - 1u32));
            assert_eq!(earlier.position, earlier.count);
        }
    }

    #[test]
    fn triangular_shells_hold_their_photon() {
        for k in [10u64.pow(15), 10u64.pow(18), u64::MAX] {
            let (inner, volume, l, m) = place(&Layout::Triangular, k);
            assert_eq!(inner + l, k);
            assert_eq!(volume, m);
            let m = u128::from(m);
            assert!(m * (m - 1) / 2 < u128::from(k) && u128::from(k) <= m * (m + 1) / 2);
        }
    }

    #[test]
    fn the_other_layouts() {
        assert_eq!(place(&Layout::Unstratified(10.into()), 4), (0, 10, 4, 10));
        assert_eq!(Layout::Unstratified(10.into()).shell(&11.into()), None);
        assert_eq!(place(&Layout::One, 7), (6, 1, 1, 1));
        assert_eq!(Layout::One.shell(&0.into()), None);
        let sequence = Layout::Sequence(vec![3, 0, 5]);
        assert_eq!(place(&sequence, 3), (0, 3, 3, 3));
        assert_eq!(place(&sequence, 4), (3, 5, 1, 5));
        assert_eq!(sequence.shell(&9.into()), None);
        let natural = Layout::Sequence((1..=30).collect());
        for k in 1..=400u64 {
            assert_eq!(
                natural.shell(&k.into()),
                Layout::Triangular.shell(&k.into())
            );
        }
    }
}
