"""The same scene run twice, and with 1 and 2 threads, must give bitwise equal frames and series.

Usage: check_determinism.py SKEIN SCENE FOLDER"""

import os
import shutil
import subprocess
import sys

import h5py

OVERRIDES = ["time.end=0.2", "output.frame_interval=0.02"]


def run(program, scene, folder, threads, method):
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads))
    command = [program, "run", scene, "-o", folder, "--overwrite", "-q"]
    for override in OVERRIDES + method:
        command += ["--set", override]
    subprocess.run(command, env=environment, check=True)


def arrays(folder):
    found = {}
    with h5py.File(os.path.join(folder, "trajectory.h5"), "r") as file:
        for group in ("particles", "observables"):
            file[group].visititems(
                lambda name, item: found.__setitem__(name, item[()].tobytes()) if isinstance(item, h5py.Dataset) else None
            )
    return found


def main():
    program, scene, folder = sys.argv[1:]
    failures = 0
    for name, method in {
        "rkc2": ["time.method=rkc2", "time.step=0.0"],
        "euler": ["time.method=euler", "time.step=1e-4", "time.end=0.02", "output.frame_interval=0.005"],
    }.items():
        runs = {}
        for label, threads in {"first": 1, "again": 1, "two_threads": 2}.items():
            place = f"{folder}_{name}_{label}"
            shutil.rmtree(place, ignore_errors=True)
            run(program, scene, place, threads, method)
            runs[label] = arrays(place)
        reference = runs.pop("first")
        assert len(reference) > 10, "hardly anything to compare"
        for label, other in runs.items():
            different = [key for key in reference if reference[key] != other.get(key)]
            failures += len(different)
            print(f"{name}, {label}: {len(reference)} arrays compared, {len(different)} differ {different}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
