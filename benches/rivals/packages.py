"""Rivals that are Python packages: E_k and Var_k of strategy 2 by one 2F1 and formula 2.104.

    python3 packages.py TOOL version
    python3 packages.py TOOL points K,K,... D,D,... [JOBS]     lines: point JOB K D SECONDS VALUE [BITS]

TOOL is one of
    mpmath         with guard digits: 2.104 loses 2 log10 k of them
    thesis         mpmath in the thesis's own way: 2F1 to the digits asked for, then 2.104
    sympy          the same way by N(hyper(...), digits)
    python-flint   enclosures at the least precision that gives the digits; BITS is the relative accuracy proved
    scipy          doubles, whatever the digits asked for

Seconds are time by the clock of a call, best of several rounds. Where a tool raises there is no line.
"""

import math
import sys
import timeit


def place(k):
    """Photon k is the l-th of the m of its shell."""
    m = (1 + math.isqrt(8 * k - 7)) // 2
    return m, k - m * (m - 1) // 2


def from_hypergeometric(job, k, m, l, f):
    """The mean ('E') or, by formula 2.104, the variance ('V'), in the arithmetic of f = 2F1(1, l; m+1; -2/(m-1))."""
    inner = m * (m - 1) // 2
    if job == "E":
        return f * k / inner
    square = (inner * m - (inner * (m - 1) + (l - 1) * m) * f) / (inner + m)
    return (square - f * f) * k**2 / inner**2


def guard(job, k):
    return 2 + (math.ceil(2 * math.log10(k)) if job == "V" else 0)


def with_backend(mpmath):
    """mpmath's version, and what counts for its speed: gmpy2, where it is there, instead of Python's own integers."""
    gmpy = mpmath.libmp.backend.gmpy
    return mpmath.__version__ + (f" + gmpy2 {gmpy.version()}" if gmpy else "")


class Thesis:
    """Nothing but the digits asked for."""

    def __init__(self):
        import mpmath

        self.mp = mpmath
        self.version = f"mpmath {with_backend(mpmath)}"

    def value(self, job, k, digits):
        with self.mp.workdps(digits):
            m, l = place(k)
            f = self.mp.hyp2f1(1, l, m + 1, self.mp.mpf(-2) / (m - 1))
            return from_hypergeometric(job, k, m, l, f)

    def text(self, value, digits):
        return self.mp.nstr(value, digits + 5)


class Mpmath(Thesis):
    """With guard digits."""

    def __init__(self):
        super().__init__()
        self.version = with_backend(self.mp)

    def value(self, job, k, digits):
        return super().value(job, k, digits + guard(job, k))


class Sympy:
    def __init__(self):
        import mpmath
        import sympy

        self.mp, self.sympy = mpmath, sympy
        self.version = f"{sympy.__version__} + mpmath {with_backend(mpmath)}"

    def value(self, job, k, digits):
        m, l = place(k)
        f = self.sympy.N(self.sympy.hyper([1, l], [m + 1], self.sympy.Rational(-2, m - 1)), digits)
        return from_hypergeometric(job, k, m, l, f)

    def text(self, value, digits):
        return self.mp.nstr(self.mp.make_mpf(value._mpf_), digits + 5)


class PythonFlint:
    def __init__(self):
        import flint

        self.flint = flint
        self.version = f"{flint.__version__} + FLINT {flint.__FLINT_VERSION__}"

    def enclosure(self, job, k, bits):
        self.flint.ctx.prec = bits
        m, l = place(k)
        f = (self.flint.arb(-2) / (m - 1)).hypgeom_2f1(1, l, m + 1)
        return from_hypergeometric(job, k, m, l, f)

    def value(self, job, k, digits):
        target = math.ceil(digits * math.log2(10)) + 1
        bits = target + 20 + (int(2 * math.log2(k)) if job == "V" else 0)
        while (got := (ball := self.enclosure(job, k, bits)).rel_accuracy_bits()) < target:
            bits += target - max(got, 0) + 16
        return ball

    def text(self, value, digits):
        return f"{value.str(digits + 5, radius=False)} {value.rel_accuracy_bits()}"


class Scipy:
    def __init__(self):
        import scipy

        self.hyp2f1 = scipy.special.hyp2f1
        self.version = scipy.__version__

    def value(self, job, k, _digits):
        m, l = place(k)
        return from_hypergeometric(job, k, m, l, float(self.hyp2f1(1, l, m + 1, -2 / (m - 1))))

    def text(self, value, _digits):
        return f"{value:.16e}"


TOOLS = {"mpmath": Mpmath, "thesis": Thesis, "sympy": Sympy, "python-flint": PythonFlint, "scipy": Scipy}


def seconds(call):
    """The least seconds a call took, over up to 7 rounds of at least a millisecond, as far as half a second goes."""
    timer, calls, begin = timeit.Timer(call), 1, timeit.default_timer()
    while (best := timer.timeit(calls)) < 1e-3:
        calls *= 2
    for _ in range(6):
        if timeit.default_timer() - begin < 0.5:
            best = min(best, timer.timeit(calls))
    return best / calls


def point(tool, job, k, digits):
    def call():
        return tool.value(job, k, digits)

    try:
        print("point", job, k, digits, f"{seconds(call):.4g}", tool.text(call(), digits), flush=True)
    except (ArithmeticError, ValueError) as error:
        print("no value:", type(tool).__name__, job, k, digits, error, file=sys.stderr)


def main():
    words = sys.argv[1:]
    if len(words) < 2 or words[0] not in TOOLS or (words[1] == "points") != (len(words) in (4, 5)):
        sys.exit(__doc__)
    tool = TOOLS[words[0]]()
    if words[1] == "version":
        print(tool.version)
        return
    sys.set_int_max_str_digits(0)
    for k in map(int, words[2].split(",")):
        for digits in map(int, words[3].split(",")):
            for job in (words[4:] or ["EV"])[0]:
                point(tool, job, k, digits)


if __name__ == "__main__":
    main()
