//! Random numbers: generators xoshiro256++ side by side, one for each lane.
//!
//! David Blackman and Sebastiano Vigna, Scrambled linear pseudorandom number generators, ACM Transactions on
//! Mathematical Software 47 (2021). A stream is a function of its key alone, so that whoever draws may start
//! anywhere. The state of a lane is hashed from the key and the lane's number by the finisher of SplitMix64
//! (Guy Steele, Doug Lea and Christine Flood, OOPSLA 2014), word by word:
//!
//! ```text
//! h0 = mix(seed),  h1 = mix(h0 + chunk),  h2 = mix(h1 + photon),  h3 = mix(h2 + lane),
//! s0 = h3,  s1 = mix(h3 + h0),  s2 = mix(s1 + h1),  s3 = mix(s2 + h2).
//! ```
//!
//! `mix` is a bijection, so s0 and s1 tell h0, s2 then h1, s3 then h2, and these the key: no two lanes of any
//! two streams have the same state, and every word depends on the whole key.

/// Runs that are drawn together. Loops over so many lanes are long enough that the compiler makes vectors of
/// them, and that one step's waiting is filled with other lanes' work.
pub(super) const LANES: usize = 32;

/// A number for each of these runs; aligned, so that no vector lies across two lines of the cache.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(super) struct Row(pub(super) [f64; LANES]);

impl Row {
    #[inline(always)]
    pub(super) fn all(number: f64) -> Row {
        Row([number; LANES])
    }

    /// A function of each number.
    #[inline(always)]
    pub(super) fn each(&self, function: impl Fn(f64) -> f64) -> Row {
        let mut row = *self;
        for number in &mut row.0 {
            *number = function(*number);
        }
        row
    }
}

/// Which stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Key {
    pub(super) seed: u64,
    /// Which chunk of the runs.
    pub(super) chunk: u64,
    /// The first photon of the shell (of the block of shells) that is drawn.
    pub(super) photon: u64,
}

/// A generator for each lane: the four words of their states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(64))]
pub(super) struct Stream {
    words: [[u64; LANES]; 4],
}

impl Key {
    pub(super) fn stream(self) -> Stream {
        let mut words = [[0; LANES]; 4];
        for lane in 0..LANES {
            let state = self.state(lane as u64);
            for (word, part) in words.iter_mut().zip(state) {
                word[lane] = part;
            }
        }
        Stream { words }
    }

    fn state(self, lane: u64) -> [u64; 4] {
        let h0 = mix(self.seed);
        let h1 = mix(h0.wrapping_add(self.chunk));
        let h2 = mix(h1.wrapping_add(self.photon));
        let s0 = mix(h2.wrapping_add(lane));
        let s1 = mix(s0.wrapping_add(h0));
        let s2 = mix(s1.wrapping_add(h1));
        [s0, s1, s2, mix(s2.wrapping_add(h2))]
    }
}

/// What SplitMix64 makes of its state.
fn mix(state: u64) -> u64 {
    let z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl Stream {
    /// For each lane a number between 0 and 1, neither of them: `(j + 1/2)/2^52`, j the first 52 bits of the
    /// next word.
    #[inline(always)]
    pub(super) fn uniforms(&mut self) -> Row {
        let [a, b, c, d] = &mut self.words;
        let mut row = Row::all(0.0);
        for lane in 0..LANES {
            let sum = a[lane].wrapping_add(d[lane]);
            row.0[lane] = uniform(sum.rotate_left(23).wrapping_add(a[lane]));
            let shifted = b[lane] << 17;
            c[lane] ^= a[lane];
            d[lane] ^= b[lane];
            b[lane] ^= c[lane];
            a[lane] ^= d[lane];
            c[lane] ^= shifted;
            d[lane] = d[lane].rotate_left(45);
        }
        row
    }
}

/// The bits make the fraction of a double in [1, 2); what is taken off is a double, and so is what is left.
#[inline(always)]
fn uniform(word: u64) -> f64 {
    f64::from_bits(word >> 12 | 1.0f64.to_bits()) - (1.0 - f64::EPSILON / 2.0)
}

/// The numbers of all lanes one after the other, for whoever draws until a number suits.
pub(super) struct Single<'a> {
    stream: &'a mut Stream,
    numbers: std::array::IntoIter<f64, LANES>,
}

impl<'a> Single<'a> {
    pub(super) fn new(stream: &'a mut Stream) -> Single<'a> {
        let numbers = stream.uniforms().0.into_iter();
        Single { stream, numbers }
    }

    /// The next number between 0 and 1.
    pub(super) fn uniform(&mut self) -> f64 {
        loop {
            if let Some(number) = self.numbers.next() {
                return number;
            }
            self.numbers = self.stream.uniforms().0.into_iter();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};
    use rand_xoshiro::Xoshiro256PlusPlus;

    const KEY: Key = Key {
        seed: 1,
        chunk: 2,
        photon: 3,
    };

    #[test]
    fn every_lane_is_the_generator_of_the_paper() {
        let mut stream = KEY.stream();
        let seed = |lane| {
            let state = KEY.state(lane);
            let bytes: Vec<u8> = state.iter().flat_map(|word| word.to_le_bytes()).collect();
            bytes.try_into().expect("32 bytes")
        };
        let lanes = (0..LANES as u64).map(seed);
        let mut lanes: Vec<_> = lanes.map(Xoshiro256PlusPlus::from_seed).collect();
        for _ in 0..1000 {
            let expected = lanes
                .iter_mut()
                .map(|lane| (2 * (lane.next_u64() >> 12) + 1) as f64);
            let drawn = stream.uniforms().0.map(|x| x * 2f64.powi(53));
            assert_eq!(drawn.to_vec(), expected.collect::<Vec<f64>>());
        }
    }

    #[test]
    fn the_ends_are_left_out() {
        assert_eq!(uniform(0), 2f64.powi(-53));
        assert_eq!(uniform(u64::MAX), 1.0 - 2f64.powi(-53));
    }

    #[test]
    fn the_hash_is_that_of_split_mix() {
        let mut split = rand_xoshiro::SplitMix64::from_seed(7u64.to_le_bytes());
        assert_eq!(mix(7), split.next_u64());
    }

    #[test]
    fn numbers_one_by_one_are_those_of_the_lanes() {
        let (mut stream, mut same) = (KEY.stream(), KEY.stream());
        let mut single = Single::new(&mut stream);
        for _ in 0..10 {
            for x in same.uniforms().0 {
                assert_eq!(single.uniform(), x);
            }
        }
    }
}
