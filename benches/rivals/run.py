"""Compares this program with C FLINT 3, mpmath, the thesis's own way and numpy, in one run, and prints ratios.

    python3 benches/rivals/run.py [--quick] [--rounds N] [--ours PROGRAM] [--sweeps | --simulation]
    python3 benches/rivals/run.py --figures FILE [--rounds N] [--ours PROGRAM]

The second form writes time and correct digits of all of them at single points as a CSV file.

Standard library only. Each rival that is not there is skipped with a message that says how to get it; see
README.md beside this file. The jobs are interleaved: in each round every tool runs each job once, one after
the other, and the least time of the rounds counts.
"""

import argparse
import pathlib
import sys
import tempfile

from figures import write_figures
from tools import build_flint, build_ours, error, output_and_cost, package, points

PHOTONS = (4, 10, 55, 100, 1000, 5050, 10**4, 10**5, 10**6, 10**8, 10**12)
DOUBLES = ((4, 100000), (72 * 10**6, 73 * 10**6), (10**12, 10**12 + 10**6))
# Shells of strategy 2, and runs.
SIMULATION = (400, 1000)
SWEEPS = ((4, 5050, 15), (4, 5050, 50), (4, 100000, 15), (4, 100000, 50), (4, 100000, 1000))


def correct_digits(value, truth):
    """How many digits of a decimal text are right."""
    off, truth = error(value, truth)
    return max(0, truth.adjusted() - off.adjusted()) if off else sys.maxsize


def median(values):
    values = sorted(values)
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else (values[middle - 1] + values[middle]) / 2


def print_points(table, digits, photons):
    print(f"\nsingle points, {digits} digits: microseconds a call")
    print(f"{'':22}" + "".join(f"{k:>10.0e}" if k > 10**4 else f"{k:>10}" for k in photons) + "   median ratio to C FLINT")
    tools = sorted({(tool, job) for tool, job, _, count in table if count == digits}, key=lambda t: (t[1], t[0]))
    for tool, job in tools:
        costs = [table[tool, job, k, digits][0] for k in photons]
        base = [table.get(("C FLINT", job, k, digits)) for k in photons]
        ratio = f"{median([b[0] / c for b, c in zip(base, costs)]):10.2f}x as fast" if all(base) else ""
        print(f"{job} {tool:20}" + "".join(f"{1e6 * c:>10.2f}" for c in costs) + ratio)


def print_digits(table, digits, photons):
    for tool in ("ours", "mpmath", "thesis"):
        for job in "EV":
            rows = [(table.get((tool, job, k, digits)), table.get(("C FLINT", job, k, digits))) for k in photons]
            if all(value and truth for value, truth in rows):
                right = [min(digits, correct_digits(v[1], t[1])) for v, t in rows]
                print(f"{job} {tool + ', digits right':20}" + "".join(f"{d:>10}" for d in right))


def print_sweeps(costs):
    print("\nsweeps, E_k and Var_k of all photons: CPU seconds (microseconds a photon)")
    for first, last, digits in SWEEPS:
        row = {tool: cost for (tool, *job), cost in costs.items() if job == [first, last, digits]}
        if not row:
            continue
        each = 1e6 / (last - first + 1)
        text = "   ".join(f"{tool} {cost:.4f} ({cost * each:.3f})" for tool, cost in row.items())
        if {"ours", "C FLINT"} <= row.keys():
            text += f"   ratio {row['C FLINT'] / row['ours']:.1f}"
        print(f"k = {first}..{last}, {digits} digits: {text}")


def doubles(program, first, last, costs):
    text, _ = output_and_cost([*program, "doubles", str(first), str(last)])
    for line in text.splitlines():
        lanes, seconds = line.split()[1], float(line.split()[4])
        key = (lanes, first, last)
        costs[key] = min(seconds, costs.get(key, seconds))


def print_doubles(costs, sweeps):
    print("\ndoubles with proved bounds, E_k - 1 and Var_k of all photons, one core: seconds (photons a second)")
    for (lanes, first, last), cost in costs.items():
        rival = sweeps.get(("C FLINT", first, last, 15))
        ratio = f"   ratio to C FLINT at 15 digits {rival / cost:.0f}" if rival else ""
        print(f"k = {first}..{last}, {lanes}: {cost:.6f} ({(last - first + 1) / cost:.2e}){ratio}")


def simulation(program, costs):
    text, _ = output_and_cost([*program, *map(str, SIMULATION)])
    for line in text.splitlines():
        _, strategy, tool, seconds, photons = line.split()
        key = (strategy, tool)
        costs[key] = max(int(photons) / float(seconds), costs.get(key, 0.0))


def print_simulation(costs):
    shells, runs = SIMULATION
    print(f"\nsimulation, U alone, {shells * (shells + 1) // 2} photons, {runs} runs, one core: photons a second")
    for (strategy, tool), speed in sorted(costs.items()):
        rival = costs.get((strategy, "numpy"))
        ratio = f"   ratio to numpy {speed / rival:.2f}" if rival and tool != "numpy" else ""
        print(f"strategy {strategy}, {tool}: {speed:.3e}{ratio}")


def simulations(ours, rounds):
    numpy, costs = package("numpy", "simulation.py"), {}
    for _ in range(rounds):
        simulation([*ours, "simulation"], costs)
        if numpy:
            simulation(numpy, costs)
    print_simulation(costs)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="one round, up to 1000 digits, no sweep at 1000")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--sweeps", action="store_true", help="sweeps only")
    parser.add_argument("--simulation", action="store_true", help="simulation only")
    parser.add_argument("--figures", type=pathlib.Path, metavar="FILE", help="time and digits at single points, as CSV")
    parser.add_argument("--ours", type=pathlib.Path, help="our own side, built already")
    options = parser.parse_args()
    rounds = 1 if options.quick else options.rounds
    ours = [str(options.ours or build_ours())]
    if options.figures:
        write_figures(options.figures, ours, rounds)
        return
    if options.simulation:
        simulations(ours, rounds)
        return
    with tempfile.TemporaryDirectory() as folder:
        tools = {"ours": ours}
        flint = build_flint(pathlib.Path(folder))
        if flint:
            tools["C FLINT"] = flint
        mpmath = {name: package("mpmath", "packages.py", name) for name in ("mpmath", "thesis")}
        table, costs, double_costs = {}, {}, {}
        targets = () if options.sweeps else (15, 50, 100, 1000) if options.quick else (15, 50, 100, 1000, 10000)
        for _ in range(rounds):
            for digits in targets:
                for name, program in tools.items():
                    points(program, name, PHOTONS, digits, table)
                for name, program in mpmath.items():
                    if program and digits <= 1000:
                        points(program, name, PHOTONS, digits, table)
            for first, last, digits in SWEEPS:
                if options.quick and digits > 50:
                    continue
                for name, program in tools.items():
                    _, cost = output_and_cost([*program, "sweep", str(first), str(last), str(digits)])
                    key = (name, first, last, digits)
                    costs[key] = min(cost, costs.get(key, cost))
            for first, last in DOUBLES:
                doubles(tools["ours"], first, last, double_costs)
    for digits in targets:
        print_points(table, digits, PHOTONS)
        print_digits(table, digits, PHOTONS)
    print_sweeps(costs)
    print_doubles(double_costs, costs)
    if not options.sweeps:
        simulations(ours, rounds)


if __name__ == "__main__":
    main()
