"""E_k and Var_k of strategy 2 with mpmath: guarded, and in the thesis's own way (2F1 to the digits asked
for, then formula 2.104), which loses 2 log10 k of them.

    python3 slow.py points K,K,... D,D,...

Lines: `point mpmath|thesis JOB K D SECONDS VALUE`, seconds are CPU time of a call, best of some rounds.
"""

import math
import sys
import time

import mpmath
from mpmath import mp, mpf


def place(k):
    m = (1 + math.isqrt(8 * k - 7)) // 2
    return m, k - m * (m - 1) // 2


def both(k):
    """E_k and Var_k at the precision that is set, by 2F1 and formula 2.104."""
    m, l = place(k)
    inner = m * (m - 1) // 2
    f = mpmath.hyp2f1(1, l, m + 1, mpf(-2) / (m - 1))
    mean = f * k / inner
    square = (mpf(inner * m) - (inner * (m - 1) + (l - 1) * m) * f) / (inner + m)
    return mean, (square - f * f) * (mpf(k) / inner) ** 2


def guarded(k, digits):
    with mp.workdps(digits + 2 + math.ceil(2 * math.log10(k))):
        return both(k)


def thesis(k, digits):
    with mp.workdps(digits):
        return both(k)


def seconds(call):
    best = math.inf
    for _ in range(3):
        calls, start = 0, time.process_time()
        while (spent := time.process_time() - start) < 0.005:
            call()
            calls += 1
        best = min(best, spent / calls)
    return best


def main():
    if len(sys.argv) != 4 or sys.argv[1] != "points":
        sys.exit(__doc__)
    for k in map(int, sys.argv[2].split(",")):
        for digits in map(int, sys.argv[3].split(",")):
            for name, way in (("mpmath", guarded), ("thesis", thesis)):
                cost = seconds(lambda: way(k, digits))
                for job, value in zip("EV", way(k, digits)):
                    print("point", name, job, k, digits, f"{cost:.6g}", mpmath.nstr(value, digits + 5))


if __name__ == "__main__":
    main()
