//! What theory says of one photon: `E_k - 1` and `Var_k` by certified doubles, and by quadrature the means
//! that need the whole law, such as `E d^4` and the cumulants `ln E exp(t d)`, `ln E exp(t d^2)`, where
//! `d = k/U - 1`.
//!
//! The quadrature is the trapezoidal rule on the whole line of `s = ln(x/(1-x))`. There the density of
//! `x ~ Beta(l, m-l+1)` is `x^l (1-x)^(m-l+1)` up to a factor: analytic for `|Im s| < pi`, log-concave, of width
//! about `w = 1/sqrt((m+1) p (1-p))` around its peak `p = l/(m+1)`. So the rule converges exponentially
//! (Trefethen and Weideman, SIAM Review 56, 2014, theorem 5.1); with steps of w/8 its error is below that of
//! rounding. The same rule normalises the density, so no Gamma function is needed.
//!
//! What lies outside the nodes is not forgotten. A log-concave density f falls outwards of s at least as fast
//! as an exponential of rate `r = |(ln f)'(s)|`, so the mass out there is at most `f(s)/r`; it counts with the
//! worst value it could have.

use super::Error;
use crate::model::Layout;
use crate::special::doubles::{Block, Doubles};
use serde::{Deserialize, Serialize};

/// Mass left outside the nodes on either side, at most.
const OUTSIDE: f64 = 1e-30;

/// Steps of the quadrature in a width of the density.
const STEPS: f64 = 8.0;

/// The same where only moments are asked for, to some digits.
const FEW_STEPS: f64 = 3.0;

/// What cumulants are raised by, for one and for each unit of the largest exponent. In tests their errors are
/// below a tenth of it.
const SLACK: f64 = 1e-12;

/// What is summed over the runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Statistic {
    /// `d = k/U - 1`
    Deviation,
    /// `d^2`
    Square,
}

impl Statistic {
    /// Its value for a run with deviation d.
    pub fn of(self, d: f64) -> f64 {
        match self {
            Statistic::Deviation => d,
            Statistic::Square => d * d,
        }
    }
}

/// The l-th of the m photons of a shell of volume m around the volume Va; photon `k = Va + l` of its layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Photon {
    inner: u64,
    size: u64,
    position: u64,
}

impl Photon {
    /// `None` unless `1 <= l <= m` and the shell lies within the volume 2^50.
    pub fn new(inner: u64, size: u64, position: u64) -> Option<Photon> {
        let outer = inner.checked_add(size)?;
        let exists = 1 <= position && position <= size && outer <= 1 << 50;
        exists.then_some(Photon {
            inner,
            size,
            position,
        })
    }

    /// Va, the volume inside the shell, in photons.
    pub fn inner(self) -> u64 {
        self.inner
    }

    /// m, the photons and the volume of the shell.
    pub fn size(self) -> u64 {
        self.size
    }

    /// l, its place in the shell.
    pub fn position(self) -> u64 {
        self.position
    }

    /// k, its place in the layout.
    pub fn number(self) -> u64 {
        self.inner + self.position
    }

    /// Photon k of a block; shells of one photon each share blocks.
    fn of_block(block: &Block, k: u64) -> Photon {
        let inner = match block.size {
            1 => k - 1,
            _ => block.inner,
        };
        Photon {
            inner,
            size: block.size,
            position: k - inner,
        }
    }
}

/// The first moments of a photon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Which photon.
    pub photon: Photon,
    /// `E_k - 1`, `+inf` where it is infinite.
    pub excess: f64,
    /// `Var_k`, likewise.
    pub variance: f64,
}

impl Expected {
    /// The mean of a statistic.
    pub fn mean(&self, statistic: Statistic) -> f64 {
        match statistic {
            Statistic::Deviation => self.excess,
            Statistic::Square => self.variance + self.excess * self.excess,
        }
    }

    /// The standard deviation of a statistic in one run, to 6 digits at least; `+inf` where it is infinite.
    pub fn scatter(&self, statistic: Statistic) -> f64 {
        match statistic {
            Statistic::Deviation => self.variance.sqrt(),
            Statistic::Square => Law::rough(self.photon).square_variance().sqrt(),
        }
    }
}

/// The moments of some photons of a layout.
///
/// ```
/// use claimcheck::model::Layout;
/// use claimcheck::simulate::verdict::expected;
/// // Strategy 1: photon 2 lies anywhere between the volumes 1 and 2, so E_2 = 2 ln 2.
/// let photons = expected(&Layout::One, &[2, 5])?;
/// assert!((photons[0].excess - (2.0 * 2f64.ln() - 1.0)).abs() < 1e-15);
/// assert_eq!(photons[1].photon.inner(), 4);
/// # Ok::<(), claimcheck::simulate::verdict::Error>(())
/// ```
///
/// # Errors
/// `NoPhoton`, `Order` where the ks do not ascend, `Doubles` where a shell is out of reach.
pub fn expected(layout: &Layout, ks: &[u64]) -> Result<Vec<Expected>, Error> {
    if let Some(pair) = ks.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(Error::Order(pair[1]));
    }
    let mut all = Vec::with_capacity(ks.len());
    for stretch in ks.chunk_by(|a, b| a + 1 == *b) {
        if let [first, .., last] | [first @ last] = stretch {
            add_stretch(layout, *first, *last, &mut all)?;
        }
    }
    Ok(all)
}

/// The moments of the photons `first..=last`.
fn add_stretch(
    layout: &Layout,
    first: u64,
    last: u64,
    all: &mut Vec<Expected>,
) -> Result<(), Error> {
    let mut next = first;
    let mut doubles = Doubles::new(layout, first, last)?;
    while let Some(block) = doubles.next_block()? {
        for (excess, variance) in block.excess.iter().zip(block.variance) {
            all.push(Expected {
                photon: Photon::of_block(&block, next),
                excess: *excess,
                variance: *variance,
            });
            next += 1;
        }
    }
    match next > last {
        true => Ok(()),
        false => Err(Error::NoPhoton(next)),
    }
}

/// The law of a photon's volume U, in a few hundred nodes at most.
#[derive(Clone, Debug)]
pub struct Law {
    photon: Photon,
    /// Innermost first.
    nodes: Vec<Node>,
    /// Inside the first node and outside the last.
    tails: [Tail; 2],
    /// The density in s at the peak.
    height: f64,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// d
    deviation: f64,
    /// The mass that the node stands for.
    weight: f64,
    /// A bound of the mass outwards of the node, seen from the peak.
    beyond: f64,
}

/// What the nodes leave out on one side.
#[derive(Clone, Copy, Debug)]
struct Tail {
    mass: f64,
    /// d at its two ends.
    near: f64,
    far: f64,
}

impl Tail {
    /// A bound of `E exp(t g)` over the tail, divided by `exp(scale)`. Between the ends d is monotone, so
    /// `t g` is largest at one of them or, for the square, where d = 0.
    fn weight(self, statistic: Statistic, t: f64, scale: f64) -> f64 {
        let exponent = |d: f64| t * statistic.of(d);
        let worst = exponent(self.near).max(exponent(self.far)).max(0.0);
        self.mass * (worst - scale).exp()
    }
}

/// The law after its density is multiplied by `exp(t g)`: the cumulant, and mean and variance of g.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tilted {
    pub(super) cumulant: f64,
    pub(super) mean: f64,
    pub(super) variance: f64,
}

/// The density in s around its peak; `u = s - ln(p/(1-p))`.
struct Density {
    photon: Photon,
    /// l and m + 1
    a: f64,
    count: f64,
    /// p and 1 - p, the peak
    p: f64,
    q: f64,
}

/// The density at a place, over its height at the peak.
struct Place {
    x: f64,
    density: f64,
    /// d ln f/ds
    slope: f64,
    deviation: f64,
}

impl Density {
    fn new(photon: Photon) -> Density {
        let (a, b) = (
            photon.position as f64,
            (photon.size - photon.position + 1) as f64,
        );
        let count = a + b;
        Density {
            photon,
            a,
            count,
            p: a / count,
            q: b / count,
        }
    }

    /// Without differences of near numbers: `x - p = p (1-p) (e^u - 1)/D`, `D = 1 + p (e^u - 1)`, and so
    /// `l - m x = x - l (1-p) (e^u - 1)/D`.
    fn at(&self, u: f64) -> Place {
        let rise = u.exp_m1();
        let divisor = 1.0 + self.p * rise;
        let x = self.p * u.exp() / divisor;
        let slope = -self.a * self.q * rise / divisor;
        let volume = self.photon.inner as f64 + self.photon.size as f64 * x;
        Place {
            x,
            density: self.logarithm(u).exp(),
            slope,
            deviation: (x + slope) / volume,
        }
    }

    /// `l u - (m+1) ln(1 + p (e^u - 1))`, from the nearer end of the shell, where the terms are smaller.
    fn logarithm(&self, u: f64) -> f64 {
        let (l, share, u) = match self.p <= 0.5 {
            true => (self.a, self.p, u),
            false => (self.count - self.a, self.q, -u),
        };
        l * u - self.count * (share * u.exp_m1()).ln_1p()
    }

    /// d at x = 0 and x = 1.
    fn ends(&self) -> [f64; 2] {
        let [inner, size, l] =
            [self.photon.inner, self.photon.size, self.photon.position].map(|n| n as f64);
        [l / inner, (l - size) / (inner + size)]
    }

    /// `w = 1/sqrt((m+1) p (1-p))`
    fn width(&self) -> f64 {
        1.0 / (self.a * self.q).sqrt()
    }

    /// Places from the peak outwards, until so little is left outside that not even d^4, where its mean is
    /// finite, notices: around Va = 0 it grows inwards like x^-4.
    fn outwards(&self, step: f64) -> Vec<Place> {
        let growth = match self.photon.inner {
            0 => 4.min(self.photon.position - 1) as i32,
            _ => 0,
        };
        let mut places = vec![];
        for number in 1u32.. {
            let place = self.at(f64::from(number) * step);
            let left = place.density / place.slope.abs() * (self.p / place.x).powi(growth);
            places.push(place);
            if left < OUTSIDE * step.abs() {
                break;
            }
        }
        places
    }
}

impl Law {
    /// By one quadrature; 20 to 100 microseconds.
    pub fn new(photon: Photon) -> Law {
        Law::in_steps(photon, STEPS)
    }

    /// Fewer nodes, for moments alone.
    pub(super) fn rough(photon: Photon) -> Law {
        Law::in_steps(photon, FEW_STEPS)
    }

    fn in_steps(photon: Photon, steps: f64) -> Law {
        let density = Density::new(photon);
        let step = density.width() / steps;
        let mut places = density.outwards(-step);
        places.reverse();
        places.push(density.at(0.0));
        places.extend(density.outwards(step));
        let height = 1.0 / (step * places.iter().map(|place| place.density).sum::<f64>());
        let nodes: Vec<Node> = places
            .iter()
            .map(|place| Node {
                deviation: place.deviation,
                weight: place.density * height * step,
                beyond: (place.density * height / place.slope.abs()).min(1.0),
            })
            .collect();
        let tail = |node: Option<&Node>, far| Tail {
            mass: node.map_or(1.0, |node| node.beyond),
            near: node.map_or(far, |node| node.deviation),
            far,
        };
        let [inmost, outmost] = density.ends();
        let tails = [tail(nodes.first(), inmost), tail(nodes.last(), outmost)];
        Law {
            photon,
            nodes,
            tails,
            height,
        }
    }

    /// Whose law it is.
    pub fn photon(&self) -> Photon {
        self.photon
    }

    /// Whether `E d^power` is finite: U^-p has a mean for l > p only where Va = 0.
    fn has_moment(&self, power: u64) -> bool {
        self.photon.inner > 0 || self.photon.position > power
    }

    /// `E d^power` for a power from 1 to 4, by quadrature: relative to `E |d|^power` right to 11 digits at
    /// least in tests up to m = 10^6. `+inf` where it is infinite.
    ///
    /// ```
    /// use claimcheck::simulate::verdict::{Law, Photon};
    /// // U is uniform between 1 and 2: d = 2/U - 1 has E d^2 = 4/2 - 4 ln 2 + 1.
    /// let law = Law::new(Photon::new(1, 1, 1).expect("l <= m"));
    /// assert!((law.moment(2) - (3.0 - 4.0 * 2f64.ln())).abs() < 1e-14);
    /// ```
    pub fn moment(&self, power: u8) -> f64 {
        let power = power.clamp(1, 4);
        match self.has_moment(power.into()) {
            true => self.mean_of(|d| d.powi(power.into())),
            false => f64::INFINITY,
        }
    }

    /// `var d^2`, without the difference of `E d^4` and `(E d^2)^2`.
    fn square_variance(&self) -> f64 {
        if !self.has_moment(4) {
            return f64::INFINITY;
        }
        let mean = self.mean_of(|d| d * d);
        self.mean_of(|d| (d * d - mean).powi(2))
    }

    /// The usual size of g: `E min(|g|, 1)`.
    pub(super) fn size(&self, statistic: Statistic) -> f64 {
        self.mean_of(|d| statistic.of(d).abs().min(1.0))
    }

    pub(super) fn mean_of(&self, g: impl Fn(f64) -> f64) -> f64 {
        let terms = self
            .nodes
            .iter()
            .map(|node| node.weight * g(node.deviation));
        terms.sum()
    }

    /// `K(t) = ln E exp(t g)`, rounded up: a slack of `1e-12 (1 + max(t g))` is added. In tests the error of
    /// the quadrature is below a tenth of that, for |t| up to 5 in units of `1/E min(|g|, 1)`. `+inf` where it
    /// is infinite: around Va = 0 for t > 0.
    pub fn cumulant(&self, statistic: Statistic, t: f64) -> f64 {
        match t == 0.0 {
            true => 0.0,
            false => self.tilted(statistic, t, 0).cumulant,
        }
    }

    /// The cumulant and its slopes. The nodes before `start`, and with them the innermost tail, are left out
    /// unless it is 0. (A node at the cut has its whole weight. Where the integrand falls from the cut on,
    /// such a sum is more than the integral, step for step.)
    pub(super) fn tilted(&self, statistic: Statistic, t: f64, start: usize) -> Tilted {
        let nodes = self.nodes.get(start..).unwrap_or_default();
        let ends = [nodes.first(), nodes.last()];
        // Both d and d^2 have no maximum inside, nor has -d; -d^2 is at most 0.
        let scale = ends
            .iter()
            .flatten()
            .map(|node| t * statistic.of(node.deviation))
            .fold(0.0, f64::max);
        let [mut mass, mut first, mut second] = [0.0; 3];
        for node in nodes {
            let g = statistic.of(node.deviation);
            let weight = node.weight * (t * g - scale).exp();
            mass += weight;
            first += weight * g;
            second += weight * g * g;
        }
        let mean = first / mass;
        let tails = &self.tails[usize::from(start > 0)..];
        let outside: f64 = tails
            .iter()
            .map(|tail| tail.weight(statistic, t, scale))
            .sum();
        Tilted {
            cumulant: scale + (mass + outside).ln() + SLACK * (1.0 + scale),
            mean,
            variance: second / mass - mean * mean,
        }
    }

    /// The node from which on a volume lies but for a probability of at most `rare`, and that probability.
    pub(super) fn start(&self, rare: f64) -> (usize, f64) {
        let inside = self.nodes.iter().take_while(|node| node.beyond <= rare);
        let start = inside.count().max(2) - 1;
        let beyond = self.nodes.get(start).map_or(1.0, |node| node.beyond);
        (start, beyond)
    }

    /// `P(U <= volume)`. For integers this is the tail of a binomial law, `P(Bin(m, x) >= l)` (DLMF 8.17.5);
    /// of its two tails the one is summed whose terms fall from the first on, so that nothing cancels: some
    /// `8 sqrt(m)` terms at most. The first term is the density of s at x, over `l (1-x)` or `(m-l+1) x`.
    ///
    /// ```
    /// use claimcheck::simulate::verdict::{Law, Photon};
    /// // The middle one of three in the volumes 5 to 8.
    /// let law = Law::new(Photon::new(5, 3, 2).expect("l <= m"));
    /// assert!((law.distribution(6.5) - 0.5).abs() < 1e-15);
    /// assert!((law.distribution(6.0) - 7.0 / 27.0).abs() < 1e-15);
    /// ```
    pub fn distribution(&self, volume: f64) -> f64 {
        let m = self.photon.size as f64;
        let x = (volume - self.photon.inner as f64) / m;
        if x <= 0.0 {
            return 0.0;
        }
        if x >= 1.0 {
            return 1.0;
        }
        let density = Density::new(self.photon);
        let height = self.height * density.at_share(x);
        let (l, others) = (density.a, density.count - density.a);
        let odds = x / (1.0 - x);
        if x <= density.p {
            let first = height / (l * (1.0 - x));
            sum_falling(first, |i| (m - l - i) / (l + 1.0 + i) * odds).min(1.0)
        } else {
            let first = height / (others * x);
            let rest = sum_falling(first, |i| (l - 1.0 - i) / (others + 1.0 + i) / odds);
            (1.0 - rest).max(0.0)
        }
    }

    /// How much `P(U <= volume)` may be off: rounding moves U by a unit of the outermost volume, and the
    /// density of U is at most 1 (it is a probability of the binomial law, `P(Bin(m-1, x) = l-1)`); the rest
    /// for the function itself.
    pub(super) fn blur(&self) -> f64 {
        (self.photon.inner + self.photon.size) as f64 * f64::EPSILON + 1e-11
    }
}

impl Density {
    /// The density at x, over its height. Where x is near p, both logarithms are of the one difference, so
    /// that its rounding cancels.
    fn at_share(&self, x: f64) -> f64 {
        let near = x - self.p;
        let logarithm = |x: f64, near: f64, p: f64| match x > p / 2.0 {
            true => (near / p).ln_1p(),
            false => (x / p).ln(),
        };
        let inner = self.a * logarithm(x, near, self.p);
        let outer = (self.count - self.a) * logarithm(1.0 - x, -near, self.q);
        (inner + outer).exp()
    }
}

/// The sum of terms each of which is the one before times the ratio; ratios fall and reach 0.
fn sum_falling(first: f64, ratio: impl Fn(f64) -> f64) -> f64 {
    let (mut sum, mut term, mut index) = (first, first, 0.0);
    while term > sum * f64::EPSILON / 16.0 {
        term *= ratio(index);
        sum += term;
        index += 1.0;
    }
    sum
}
