"""Runs with the fast multipole method: threads, misses, and what is said of them. check_fmm_run.py SKEIN FOLDER

The scene is a fiber at rest in a fluid at rest: its forces are rounding errors, and velocities so far below their forces'
own flow that the method misses its tolerance. Nothing else is as sure to make it miss in a test.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

from checks import check

NUMERICAL = 76
TOLERANCE = 1e-4
SHEARED = [f"hydrodynamics.tolerance={TOLERANCE}", "hydrodynamics.check_every=10", "time.end=0.02"]
AT_REST = ["flow.kind=none", *SHEARED, "time.end=0.004"]


def run(program, folder, overrides, threads=1):
    shutil.rmtree(folder, ignore_errors=True)
    scene = folder.with_suffix(".toml")
    scene.write_text('[fiber]\nsections = 120\n[hydrodynamics]\nmethod = "fmm"\n[time]\nmax_step = 0.001\n')
    command = [program, "run", scene, "-o", folder]
    for override in overrides:
        command += ["--set", override]
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120)


def steps(folder, name):
    with h5py.File(folder / "trajectory.h5") as file:
        return file[f"/observables/{name}/value"][()]


def positions(folder):
    with h5py.File(folder / "trajectory.h5") as file:
        return file["/particles/fibers/position/value"][()]


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)

    one, two = folder / "one_thread", folder / "two_threads"
    result = run(program, one, SHEARED)
    check(result.returncode == 0, result.stderr)
    check("fast multipole method, harmonic far field of order 6" in result.stderr, "no method in the first lines")
    check("checks against direct sums, 0 above the tolerance" in result.stderr, "no checks in the cost card")
    check(run(program, two, SHEARED, threads=2).returncode == 0, "two threads")
    check(np.array_equal(positions(one), positions(two)), "one and two threads end differently")
    info = subprocess.run([program, "info", one], capture_output=True, text=True).stdout
    check("mobility: fast multipole method, harmonic far field of order 6" in info, info)
    error = steps(one, "velocity_error")
    check(np.isfinite(error).any() and 0.0 < np.nanmax(error) < TOLERANCE, f"errors {np.nanmax(error)}")
    check(np.all(steps(one, "fmm_order") == 6) and not steps(one, "fmm_misses").any(), "order or misses of a good run")

    direct = folder / "direct"
    check(run(program, direct, [*SHEARED, "hydrodynamics.method=direct"]).returncode == 0, "direct")
    check(np.isnan(steps(direct, "velocity_error")).all() and not steps(direct, "fmm_order").any(), "a direct sum has no error")
    moved = np.abs(positions(direct) - positions(direct)[0]).max()
    apart = np.abs(positions(direct) - positions(one)).max()
    check(0.0 < apart < TOLERANCE * moved, f"{apart} from the direct run, moved by {moved}")

    unchecked = folder / "unchecked"
    check(run(program, unchecked, [*SHEARED, "hydrodynamics.check_every=0"]).returncode == 0, "unchecked")
    check(np.array_equal(positions(unchecked), positions(one)), "checks change the result")

    missed = folder / "missed"
    result = run(program, missed, AT_REST)
    check(result.returncode == 0, result.stderr)
    log = (missed / "run.log").read_text()
    check(log.count("at order 6 misses tolerance = 0.0001: its error at 64 checked targets is") == 1, log)
    check(result.stderr.count("misses") == 1, result.stderr)
    events = [json.loads(line) for line in (missed / "events.jsonl").read_text().splitlines()]
    misses = steps(missed, "fmm_misses")
    check(len([e for e in events if e["event"] == "miss"]) == misses[-1] > 0, "a miss without an event")
    check(steps(missed, "fmm_order")[-1] > 6, "the order was not raised")

    stopped = folder / "stopped"
    result = run(program, stopped, [*AT_REST, "hydrodynamics.on_miss=stop"])
    check(result.returncode == NUMERICAL, f"exit code {result.returncode}: {result.stderr}")
    check("misses tolerance = 0.0001" in result.stderr and "the last good state, t = 0" in result.stderr, result.stderr)
    check(list((stopped / "checkpoints").glob("*.checkpoint")), "no checkpoint of the last good state")
    check(subprocess.run([program, "verify", stopped], capture_output=True).returncode == 0, "verify")


if __name__ == "__main__":
    main()
