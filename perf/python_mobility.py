#!/usr/bin/python3
"""What Python adds to an evaluation of the fast multipole method: python_mobility.py BENCH_FMM, with skein on PYTHONPATH.

The same points, tolerances and threads in both; the library's time is that of `bench_fmm uniform` at 100 000 points. The two
take turns, so that what else the machine does meets both. Ends with 1 where Python takes more than 5 % longer.
"""
import csv
import statistics
import subprocess
import sys
import time

import numpy as np

import skein

N, VISCOSITY, TURNS, REPEATS = 100_000, 1.7, 3, 5


def library_seconds(bench, tolerance):
    output = subprocess.run([bench, "uniform", f"only={N}"], check=True, capture_output=True, text=True).stdout
    rows = csv.DictReader(line for line in output.splitlines() if line and not line.startswith("#"))
    found = [float(row["fmm_ms"]) for row in rows if int(row["nodes"]) == N and float(row["tolerance"]) == tolerance]
    return 1e-3 * found[0]


def python_seconds(mobility, arrays):
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        mobility(*arrays)
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main():
    random = np.random.default_rng(1)
    positions = np.asfortranarray(random.uniform(0.0, 1.0, (N, 3)))
    forces = np.asfortranarray(random.uniform(-1.0, 1.0, (N, 3)))
    arrays = positions, forces, np.full(N, 0.1 * N ** (-1.0 / 3.0))
    worst = 0.0
    for tolerance in (1e-4, 1e-6):
        mobility = skein.Mobility(tolerance, VISCOSITY)
        mobility(*arrays)  # operators
        turns = [(library_seconds(sys.argv[1], tolerance), python_seconds(mobility, arrays)) for _ in range(TURNS)]
        library, python = (min(times) for times in zip(*turns))
        worst = max(worst, python / library - 1.0)
        print(f"{N} points at {tolerance:g}: library {1e3 * library:.1f} ms, Python {1e3 * python:.1f} ms, "
              f"{100.0 * (python / library - 1.0):+.1f} %")
    return int(worst > 0.05)


sys.exit(main())
