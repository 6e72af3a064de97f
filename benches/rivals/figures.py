"""All tools at single points as a CSV file: time against correct digits. README.md says what stands in it."""

import collections
import csv
import decimal
import math
import os
import pathlib
import platform
import sys
import tempfile

from tools import build_doubles, build_flint, error, output_and_cost, package, pari, points, say

PHOTONS = (4, 100, 5050, 10**6, 10**8, 10**12)
DIGITS = (15, 30, 50, 100, 300, 1000, 3000, 10000)
QUANTITIES = {"E": "mean", "V": "variance"}
# Seconds. A call that takes longer is left out, and a photon that takes twice as long is not asked for again at as many
# digits.
LIMIT = 2.0
HEADER = ("tool", "version", "quantity", "k", "digits asked", "digits right", "seconds")

# `most` is the largest number of digits asked for, `cap` the largest number of right digits that counts beyond them.
Tool = collections.namedtuple("Tool", "name program version most cap", defaults=(DIGITS[-1], 3))


def tools(ours, folder):
    """Our own side, which the others are measured by, and the rivals that are there."""
    doubles = {"most": 15, "cap": 2}
    gsl = build_doubles(folder, "GSL", "apt install libgsl-dev", ["-DGSL"], ["-lgsl", "-lgslcblas", "-lm"])
    boost = build_doubles(folder, "Boost", "apt install libboost-math-dev", [], [])
    found = (
        ("claimcheck", ours, {}),
        ("C FLINT", build_flint(folder), {}),
        ("python-flint", package("python-flint", "packages.py", "python-flint", module="flint"), {}),
        ("mpmath", package("mpmath", "packages.py", "mpmath"), {}),
        ("PARI/GP", pari(), {}),
        ("thesis's way", package("mpmath", "packages.py", "thesis"), {}),
        ("sympy", package("sympy", "packages.py", "sympy"), {"most": 100}),
        ("scipy", package("scipy", "packages.py", "scipy"), doubles),
        ("GSL", gsl, doubles),
        ("Boost", boost, doubles),
    )
    return [Tool(name, program, version(program), **limits) for name, program, limits in found if program]


def version(program):
    return output_and_cost([*program, "version"])[0].strip()


def truths(found):
    """Every value to more digits than any tool is asked for, from a tool that certifies."""
    table = {}
    sure = next((tool for tool in found if tool.name in ("C FLINT", "python-flint")), None)
    if not sure:
        sys.exit("correct digits need C FLINT 3 or python-flint")
    points(sure.program, "truth", PHOTONS, DIGITS[-1] + 20, table, "EV")
    return {(job, k): value for (_, job, k, _), (_, value, _) in table.items()}


def measure(found, rounds):
    """All measurements, by tool name, job, photon and digits: the least seconds of the rounds, value, bits proved."""
    table, end = {}, {}
    for number in range(rounds):
        for digits in DIGITS:
            say(f"round {number + 1} of {rounds}, {digits} digits")
            for tool in found:
                photons = [k for k in PHOTONS if digits < end.get((tool.name, k), tool.most + 1)]
                if photons:
                    points(tool.program, tool.name, photons, digits, table, "EV")
                for k in photons:
                    if all(table.get((tool.name, job, k, digits), (0,))[0] > 2 * LIMIT for job in QUANTITIES):
                        end[tool.name, k] = digits
    return table


def correct_digits(value, truth):
    """-log10 of the relative error of a decimal text."""
    off, truth = error(value, truth)
    if not off.is_finite():
        return 0.0
    short = decimal.Context(prec=20)
    return float(-short.log10(short.divide(off, truth))) if off else math.inf


def digits_right(tool, asked, truth, value, bits=None):
    """Rounded down to one decimal. A tool that certifies counts as what it proves."""
    right = int(bits) * math.log10(2) if bits else correct_digits(value, truth)
    return math.floor(10 * max(0.0, min(right, asked + tool.cap))) / 10


def rows(found, table, truth):
    for tool in found:
        for job, quantity in QUANTITIES.items():
            for k in PHOTONS:
                for asked in DIGITS:
                    seconds, *answer = table.get((tool.name, job, k, asked), (math.inf,))
                    if seconds <= LIMIT:
                        right = digits_right(tool, asked, truth[job, k], *answer)
                        yield tool.name, tool.version, quantity, k, asked, f"{right:.1f}", f"{seconds:.3g}"


def processor():
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return (names or [platform.processor() or platform.machine()])[0]


def write_figures(path, ours, rounds):
    with tempfile.TemporaryDirectory() as folder:
        found = tools(ours, pathlib.Path(folder))
        truth = truths(found)
        table = measure(found, rounds)
    with open(path, "w", newline="") as out:
        out.write(
            "# Rivals at single photons of strategy 2, E_k (mean) and Var_k (variance): time of a call and digits right.\n"
            f"# python3 benches/rivals/run.py --figures FILE --rounds {rounds}\n"
            f"# {processor()}, {os.cpu_count()} cores\n"
        )
        writer = csv.writer(out, lineterminator="\n", quoting=csv.QUOTE_NONE)
        writer.writerow(HEADER)
        writer.writerows(rows(found, table, truth))
