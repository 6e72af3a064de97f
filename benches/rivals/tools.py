"""Finds, builds and runs the tools that are compared.

A tool that is not there is None, after a message that says how to get it.
"""

import decimal
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def say(*words):
    print(*words, file=sys.stderr, flush=True)


def skipped(name, how):
    say(f"skipped: {name} ({how})")


def compiled(compiler, source, program, *choices):
    """The program, by the first choice of flags that compiles: [before the source], [after it]."""
    for before, after in choices:
        command = [compiler, "-O2", "-march=native", *before, str(HERE / source), "-o", str(program), *after]
        if subprocess.run(command, capture_output=True).returncode == 0:
            return [str(program)]
    return None


def flint_flags():
    """Compiler flags to try, best first: the folder named by FLINT, what pkg-config says, the system's."""
    prefix = os.environ.get("FLINT")
    if prefix:
        library = pathlib.Path(prefix) / "lib" / "libflint.a"
        link = [str(library)] if library.exists() else [f"-L{prefix}/lib", "-lflint"]
        yield [f"-I{prefix}/include"], link
    if shutil.which("pkg-config"):
        found = subprocess.run(["pkg-config", "--cflags", "--libs", "flint"], capture_output=True, text=True)
        if found.returncode == 0:
            yield [], found.stdout.split()
    yield [], ["-lflint"]


def build_ours():
    command = ["cargo", "build", "--release", "--example", "rivals", "--locked"]
    if subprocess.run(command, cwd=ROOT).returncode:
        sys.exit("our own side does not build")
    target = os.environ.get("CARGO_TARGET_DIR", ROOT / "target")
    return ROOT / target / "release" / "examples" / "rivals"


def build_flint(folder):
    compiler = shutil.which(os.environ.get("CC", "cc"))
    if not compiler:
        return skipped("C FLINT", "no C compiler; set CC")
    libraries = ["-lmpfr", "-lgmp", "-lm", "-lpthread"]
    choices = ((before, [*after, *libraries]) for before, after in flint_flags())
    return compiled(compiler, "flint.c", folder / "flint", *choices) or skipped(
        "C FLINT 3", "its library was not found; README.md says how to get it, then set FLINT"
    )


def build_doubles(folder, name, how, before, after):
    """A library of C or C++ with 2F1 in doubles."""
    compiler = shutil.which(os.environ.get("CXX", "c++"))
    if not compiler:
        return skipped(name, "no C++ compiler; set CXX")
    return compiled(compiler, "doubles.cpp", folder / name, (before, after)) or skipped(name, how)


def package(name, script, *words, module=None):
    """A script that needs a package of Python, and the words it takes."""
    if subprocess.run([sys.executable, "-c", f"import {module or name}"], capture_output=True).returncode:
        return skipped(" ".join(words) or name, f"pip install {name}")
    return [sys.executable, str(HERE / script), *words]


def pari():
    if not shutil.which("gp"):
        return skipped("PARI/GP", "apt install pari-gp, or another package with the program gp")
    return ["sh", "-c", 'echo "tool_$1(${2:+[$2], [$3]})" | gp -q -f -s 256M "$0"', str(HERE / "pari.gp")]


def output_and_cost(command):
    """What a program prints, and the CPU seconds it took."""
    with tempfile.TemporaryFile("w+") as out:
        child = subprocess.Popen(command, stdout=out)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode:
            sys.exit(f"failed: {' '.join(map(str, command))}")
        out.seek(0)
        return out.read(), usage.ru_utime + usage.ru_stime


def points(program, name, photons, digits, table, *jobs):
    """Runs single points and keeps the least seconds of all runs, the value, and more words if the tool says more."""
    text, _ = output_and_cost([*program, "points", ",".join(map(str, photons)), str(digits), *jobs])
    for line in text.splitlines():
        _, job, k, count, seconds, *value = line.split()
        key = (name, job, int(k), int(count))
        best = min(float(seconds), table.get(key, (float("inf"),))[0])
        table[key] = (best, *value)


def error(value, truth):
    """The error of a decimal text and the truth."""
    value, truth = decimal.Decimal(value), decimal.Decimal(truth)
    return decimal.Context(prec=100000).subtract(value, truth).copy_abs(), truth.copy_abs()
