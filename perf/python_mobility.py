#!/usr/bin/python3
"""What Python adds to an evaluation of the fast multipole method: python_mobility.py BENCH_POINTS [N], with skein on PYTHONPATH.

The library's evaluations are those of `bench_points`, another process with the same points, forces, tolerance and threads. The
two take turns, one evaluation each, so that what else the machine does meets both; what is compared is the median of the ratios
of neighbours in time. Python's calls are skein.mobility's: with arrays in Fortran's order, which are used where they are, and with
rows of x, y, z, which are copied. All velocities are compared to the bit. Ends with 1 where Python takes more than 5 % longer
than the library with the same checks.
"""
import os
import statistics
import subprocess
import sys
import tempfile
import time

# Threads of the process whose turn it is not sleep, in both.
os.environ.setdefault("OMP_WAIT_POLICY", "passive")

import numpy as np

import skein

VISCOSITY, TURNS = 1.7, 25


class Library:
    """Evaluations by bench_points."""

    def __init__(self, bench, path, tolerance, check_every):
        self.process = subprocess.Popen([bench, path, repr(tolerance), str(check_every)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def evaluate(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def timed(arrays, tolerance):
    start = time.perf_counter()
    found = skein.mobility(*arrays, tolerance=tolerance, viscosity=VISCOSITY)
    return time.perf_counter() - start, found


def compare(bench, folder, arrays, tolerance):
    """@returns by how much Python takes longer than the library with the same checks"""
    positions, forces, blobs = arrays
    path = os.path.join(folder, "points")
    np.concatenate([positions.ravel("F"), forces.ravel("F"), blobs]).tofile(path)
    rows = np.ascontiguousarray(positions), np.ascontiguousarray(forces), blobs
    checked, unchecked = (Library(bench, path, tolerance, every) for every in (1, 0))
    times = []
    for turn in range(TURNS + 1):
        there = checked.evaluate(), unchecked.evaluate()
        here, found = timed(arrays, tolerance)
        copied, same = timed(rows, tolerance)
        if turn > 0:  # the first makes operators
            times.append((*there, here, copied))
    checked.close()
    unchecked.close()
    of_library = np.fromfile(path + ".velocity").reshape(3, -1).T
    assert np.array_equal(found.velocities, of_library) and np.array_equal(same.velocities, of_library), "bits differ"
    middle = [1e3 * statistics.median(column) for column in zip(*times)]
    more = [100.0 * (statistics.median(row[2 + kind] / row[base] for row in times) - 1.0)
            for kind, base in ((0, 0), (1, 0), (0, 1))]
    print(f"{len(blobs)} points at {tolerance:g}: library {middle[0]:.1f} ms, Python {middle[2]:.1f} ms ({more[0]:+.1f} %), rows "
          f"{middle[3]:.1f} ms ({more[1]:+.1f} %); library without checks {middle[1]:.1f} ms (Python {more[2]:+.1f} %)", flush=True)
    return more[0]


def main(bench, n=100_000):
    random = np.random.default_rng(1)
    arrays = (np.asfortranarray(random.uniform(0.0, 1.0, (n, 3))), np.asfortranarray(random.uniform(-1.0, 1.0, (n, 3))),
              np.full(n, 0.1 * n ** (-1.0 / 3.0)))
    with tempfile.TemporaryDirectory() as folder:
        return int(max(compare(bench, folder, arrays, tolerance) for tolerance in (1e-4, 1e-6)) > 5.0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
