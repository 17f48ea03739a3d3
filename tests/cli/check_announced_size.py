"""The megabytes that a run announces against those that its folder has in the end: check_announced_size.py PROGRAM FOLDER

Within a fifth, for runs whose frames are larger and smaller than what is said of them, and for one of steps alone.
"""

import os
import re
import subprocess
import sys

PROGRAM, FOLDER = sys.argv[1:3]

SMALL = "[fiber]\nsections = 4\nnodes_per_section = 3\nblob = 0.0045\n[time]\nstep = 0.02\n"
LARGE = "[fiber]\nsections = 1200\nspring_stiffness = 1e-4\n[time]\nstep = 0.0005\nmax_step = 0.0005\n"
RUNS = {
    "one frame of few nodes": (SMALL, ["time.end=0.0"]),
    "a few frames": (SMALL, ["time.end=0.5"]),
    "many small frames": (SMALL, ["time.end=4.0", "output.frame_interval=5e-4"]),
    "in single precision": (SMALL, ["time.end=1.0", "output.frame_interval=5e-4", "output.precision=single"]),
    "many steps": (SMALL, ["time.end=4.0", "time.step=5e-4", "output.frame_interval=1.0"]),
    "many checkpoints": (SMALL, ["time.end=2.0", "checkpoint.simulated_interval=0.1", "checkpoint.keep=100"]),
    "large frames": (LARGE, ["time.end=0.001", "output.frame_interval=0.00025", "hydrodynamics.tolerance=1e-3"]),
}


def folder_size(path):
    return sum(os.path.getsize(os.path.join(folder, name)) for folder, _, names in os.walk(path) for name in names)


def main():
    os.makedirs(FOLDER, exist_ok=True)
    failed = []
    for name, (scene, overrides) in RUNS.items():
        file, folder = os.path.join(FOLDER, "scene.toml"), os.path.join(FOLDER, name.replace(" ", "_"))
        with open(file, "w") as stream:
            stream.write(scene)
        command = [PROGRAM, "run", file, "-o", folder, "--overwrite"]
        for override in overrides:
            command += ["--set", override]
        result = subprocess.run(command, capture_output=True, text=True, timeout=200)
        assert result.returncode == 0, result.stderr
        with open(os.path.join(folder, "run.log")) as stream:
            announced = float(re.search(r"([0-9.e+]+) MB in the folder", stream.read()).group(1))
        written = 1e-6 * folder_size(folder)
        print(f"{name}: announced {announced:g} MB, written {written:.4g} MB")
        if not 0.8 < announced / written < 1.2:
            failed.append(name)
    sys.exit(f"not within a fifth: {', '.join(failed)}" if failed else 0)


main()
