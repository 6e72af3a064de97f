"""Strategies 1 and 2 as one would simulate them with numpy: U alone, whole arrays over runs and photons.

    python3 simulation.py M R      M shells of strategy 2, R runs on one core: simulation STRATEGY numpy SECONDS PHOTONS

For each photon the sums of k/U - 1 and of its square over the runs, as ours. Photons are taken some hundreds at a time, so
that the arrays stay in the cache's reach.
"""

import sys
import time

import numpy

TOGETHER = 400


def sums(k, volumes):
    error = k / volumes - 1.0
    return error.sum(axis=0), numpy.einsum("ij,ij->j", error, error)


def one(random, photons, runs):
    for first in range(1, photons + 1, TOGETHER):
        k = numpy.arange(first, min(first + TOGETHER, photons + 1), dtype=float)
        volumes = random.random((runs, len(k)))
        volumes += k - 1.0
        sums(k, volumes)


def two(random, shells, runs):
    inner = 0
    for count in range(1, shells + 1):
        volumes = random.random((runs, count))
        volumes.sort(axis=1)
        volumes *= count
        volumes += inner
        sums(numpy.arange(inner + 1.0, inner + count + 1.0), volumes)
        inner += count


def main():
    shells, runs = int(sys.argv[1]), int(sys.argv[2])
    photons = shells * (shells + 1) // 2
    random = numpy.random.default_rng(1)
    for strategy, job, size in ((1, one, photons), (2, two, shells)):
        start = time.perf_counter()
        job(random, size, runs)
        print(f"simulation {strategy} numpy {time.perf_counter() - start:.6e} {photons * runs}")


if __name__ == "__main__":
    main()
