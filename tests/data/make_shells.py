"""Writes shells.csv: E_k - 1 and Var_k of strategy 2, for outside judgement.

    pip install python-flint
    python3 make_shells.py > shells.csv
    python3 make_shells.py 1000000 7       a million points of another seed, as the full test has them

Each value is a rigorous ball of FLINT (Arb), refined until 210 digits are proved: 2F1 and formula 2.104 of the
thesis, E_k = k F/Va, with as many more bits as they lose. The points: the first photons, ends of shells, then k
at random, its logarithm uniform up to 10^13.
"""

import math
import random
import sys

import flint
from flint import arb, ctx

DIGITS = 210
BITS = 710


def place(k):
    m = (1 + math.isqrt(8 * k - 7)) // 2
    return m, k - m * (m - 1) // 2


def values(k):
    """E_k - 1 and Var_k as decimal texts."""
    m, l = place(k)
    inner = m * (m - 1) // 2
    ctx.prec = BITS + 3 * k.bit_length()
    while True:
        f = (arb(-2) / (m - 1)).hypgeom_2f1(1, l, m + 1)
        excess = f * k / inner - 1
        square = (inner * m - (inner * (m - 1) + (l - 1) * m) * f) / (inner + m)
        variance = (square - f * f) * arb(k) ** 2 / arb(inner) ** 2
        if min(excess.rel_accuracy_bits(), variance.rel_accuracy_bits()) > BITS - 8:
            return [x.str(DIGITS, radius=False) for x in (excess, variance)]
        ctx.prec *= 2


def points(count, seed):
    rng = random.Random(seed)
    firsts = [*range(2, 80), 10**12, 10**15]
    ends = [m * (m + 1) // 2 + d for m in (20, 141, 447, 1414, 10**6) for d in (0, 1)]
    yield from (firsts + ends)[:count]
    for _ in range(count - len(firsts) - len(ends)):
        yield max(2, int(10 ** rng.uniform(0.5, 13)))


def main():
    count, seed = (int(x) for x in (sys.argv[1:] + ["2000", "1"][len(sys.argv) - 1 :]))
    print(f"# python-flint {flint.__version__} (FLINT {flint.__FLINT_VERSION__}), seed {seed}")
    print(f"# made by make_shells.py; values correct to {DIGITS - 1} digits")
    print("k,excess,variance")
    for k in points(count, seed):
        print(k, *values(k), sep=",")


if __name__ == "__main__":
    main()
