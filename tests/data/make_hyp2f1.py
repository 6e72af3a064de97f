"""Writes hyp2f1.csv: reference values of Gauss's hypergeometric function.

    pip install python-flint mpmath
    python3 make_hyp2f1.py > hyp2f1.csv

Each value is a rigorous ball of FLINT (Arb), refined until 50 digits are proved, and compared with
mpmath's value to 25 digits where mpmath gives one. `none` marks points without a real value, by
the rules of DLMF 15.2, written down here by hand and not computed.
"""

import random
import sys
from fractions import Fraction

import flint
import mpmath
from flint import arb, ctx, fmpq

DIGITS = 50
BITS = (256, 1024, 4096)


def ball(x):
    return arb(fmpq(x.numerator, x.denominator))


def value(a, b, c, z):
    """The value as a decimal text with DIGITS digits, or None where Arb finds none."""
    # The flags tell Arb which differences are integers although 1/3 is a ball.
    flags = {
        "ab": (a - b).denominator == 1,
        "ac": (a - c).denominator == 1,
        "bc": (b - c).denominator == 1,
        "abc": (a + b - c).denominator == 1,
    }
    for bits in BITS:
        ctx.prec = bits
        result = ball(z).hypgeom_2f1(ball(a), ball(b), ball(c), **flags)
        if result.is_finite() and result.rel_accuracy_bits() > 4 * DIGITS:
            break
        if result == 0 or (result.is_finite() and result.contains(0) and bits == BITS[-1]):
            return "0"
    else:
        return None
    mpmath.mp.dps = 40
    text = result.str(DIGITS, radius=False)
    try:
        args = [mpmath.mpf(x.numerator) / x.denominator for x in (a, b, c, z)]
        other = mpmath.hyp2f1(*args, maxterms=10**5)
        close = abs(other - mpmath.mpf(text)) <= mpmath.mpf(10) ** -25 * abs(other)
        if not close:
            print("mpmath differs at", a, b, c, z, text, other, file=sys.stderr)
    except (mpmath.libmp.NoConvergence, ZeroDivisionError, ValueError, OverflowError):
        pass
    return text


def points():
    """Arguments by kind."""
    F = Fraction
    rng = random.Random(1)
    for m in (1, 2, 3, 10, 100, 1000):
        for l in sorted({1, (m + 1) // 2, m}):
            for z in (F(-1, 10**6), F(-2, m), F(-1, 2), F(-3, 4), F(-1), F(-7, 2), F(-100), F(-10**6)):
                yield F(1), F(l), F(m + 1), z
    yield F(1), F(50), F(101), F(-100, 4950)
    yield F(1), F(10**5), F(2 * 10**5 + 1), F(-2, 2 * 10**5 - 1)
    yield F(1), F(3), F(10**3), F(-5)
    yield F(1), F(5 * 10**11), F(10**12), F(-1, 10**6)
    for _ in range(160):
        a, b, c = (F(rng.randint(-60, 60), rng.choice((1, 1, 2, 3, 7))) for _ in range(3))
        z = rng.choice((F(rng.randint(-400, 99), 100), F(rng.randint(-50, 0)), F(rng.randint(9000, 9999), 10000)))
        if not (c.denominator == 1 and c <= 0):
            yield a, b, c, z
    for excess in range(-3, 5):
        for z in (F(4, 5), F(999, 1000), F(10**9 - 1, 10**9)):
            a, b = F(1, 4), F(7, 2)
            yield a, b, a + b + excess, z
            if 5 + excess > 0:
                yield F(2), F(3), F(5 + excess), z
    # Polynomials, beyond z = 1 too, and with a pole of the parameter c after the last term.
    for z in (F(-9), F(1, 2), F(1), F(2), F(100)):
        yield F(-3), F(5, 2), F(1, 3), z
        yield F(-20), F(31), F(7), z
        yield F(0), F(5), F(2), z
    # Gauss's sum.
    for a, b, c in ((F(1), F(1), F(3)), (F(1, 2), F(1, 3), F(2)), (F(-1, 2), F(1, 2), F(1)), (F(7), F(1, 2), F(9))):
        yield a, b, c, F(1)


NONE = (
    # z > 1 and no polynomial; z = 1 with c <= a + b; c a nonpositive integer.
    "1,1,2,2", "1/2,1/3,1,3/2", "1,1,2,1", "1,1,3/2,1", "1,1,0,1/2", "1,1,-3,1/2", "-4,1,-3,1/2",
)
# Polynomials with c = -m, degree n <= m (DLMF 15.2.5), by hand: 1 + ... summed as fractions.
LIMITS = ((-2, 3, -2, Fraction(1, 2)), (-2, 3, -5, Fraction(4)), (0, 3, 0, Fraction(4)), (-1, -7, -3, Fraction(-2)))


def polynomial(a, b, c, z):
    total, term = Fraction(1), Fraction(1)
    degree = min(-x for x in (a, b) if x <= 0)
    for n in range(degree):
        term *= Fraction((a + n) * (b + n), (c + n) * (n + 1)) * z
        total += term
    return total


def main():
    print(f"# python-flint {flint.__version__} (FLINT {flint.__FLINT_VERSION__}), mpmath {mpmath.__version__}")
    print("# made by make_hyp2f1.py; value correct to 49 of 50 digits, `none`: no real value")
    print("a,b,c,z,value")
    for a, b, c, z in dict.fromkeys(points()):
        text = value(a, b, c, z)
        if text is None:
            print("not finite:", a, b, c, z, file=sys.stderr)
        else:
            print(f"{a},{b},{c},{z},{text}")
    for a, b, c, z in LIMITS:
        exact = polynomial(a, b, c, z)
        ctx.prec = 400
        print(f"{a},{b},{c},{z},{ball(exact).str(DIGITS, radius=False)}")
    for line in NONE:
        print(f"{line},none")


if __name__ == "__main__":
    main()
