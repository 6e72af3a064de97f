//! The choice of a method for a photon of a shell against the best in hindsight, by counted instructions:
//! `benches/choice.sh` runs this under callgrind. One line a call of [`measured`], in order.
//!
//! Arguments: how many scenes, a seed, the most digits, and how many methods are tried beside the choice, the cheapest by
//! their estimates.

use claimcheck::model::{Layout, Shell};
use claimcheck::special::shell::{Method, Quantity, enclose};
use rand::{RngExt, SeedableRng};
use rug::Integer;

/// No call that is expected to take more instructions than this.
const MOST: f64 = 1e9;

/// One call, counted: of a method with so many bits, or of the choice with so many digits.
#[inline(never)]
fn measured(method: Option<Method>, quantity: Quantity, shell: &Shell, size: u32) -> bool {
    match method {
        Some(method) => method.enclose(quantity, shell, size).is_ok(),
        None => enclose(quantity, shell, size).is_ok(),
    }
}

fn main() {
    let mut arguments = std::env::args()
        .skip(1)
        .filter_map(|a| a.parse::<u64>().ok());
    let mut next = |default| arguments.next().unwrap_or(default);
    let (scenes, seed, most_digits, tried) = (next(10), next(1), next(10_000), next(3));
    let mut random = rand_xoshiro::Xoshiro256PlusPlus::seed_from_u64(seed);
    // Even on a logarithmic scale.
    let mut between = |low: f64, high: f64| {
        let part: f64 = random.random();
        (low.ln() + part * (high / low).ln()).exp() as u64
    };
    for scene in 0..scenes {
        let digits = between(10.0, most_digits as f64) as u32;
        let quantity = Quantity::ALL[between(1.0, 16.0).ilog2() as usize];
        let k = Integer::from(between(2.0, 1e12));
        let shell = Layout::Triangular.shell(&k).expect("every k has a shell");
        let done = measured(None, quantity, &shell, digits);
        println!("{scene} {digits} {quantity:?} {k} choice {done}");
        let mut methods = Method::ALL.map(|method| {
            let bits = method.bits_for(quantity, &shell, digits);
            (method.estimate(&shell, bits), bits, method)
        });
        methods.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, bits, method) in methods
            .into_iter()
            .filter(|m| m.0 < MOST)
            .take(tried as usize)
        {
            let done = measured(Some(method), quantity, &shell, bits);
            println!("{scene} {digits} {quantity:?} {k} {method:?} {done}");
        }
    }
}
