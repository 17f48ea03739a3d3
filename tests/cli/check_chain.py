"""A scene with model = "chain" added moves like its tube, and all verbs serve: check_chain.py SKEIN SCENE FOLDER

SCENE is the paper's fiber of length 0.523; the tube's own figures stand below."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np

# Of the tube, by `skein analyze` of this scene's run.
HALF_PERIOD, HOOK_RADIUS, SNAKING_SPEED = 24.56, 0.0188, 0.0311
TOLERANCE = 0.1
RADIUS, LENGTH, N_NODES = 0.005, 0.522681, 52
OVERRIDES = ["fiber.model=\"chain\"", "time.end=26", "output.frame_interval=0.05", "checkpoint.simulated_interval=1"]


def check(condition, message):
    if not condition:
        sys.exit(f"check_chain: {message}")


def skein(*arguments):
    result = subprocess.run([*map(str, arguments)], capture_output=True, text=True)
    check(result.returncode == 0, f"{arguments}: exit code {result.returncode}: {result.stderr}")
    return result.stdout


def run_command(program, scene, folder):
    shutil.rmtree(folder, ignore_errors=True)
    sets = [word for override in OVERRIDES for word in ("--set", override)]
    return [str(word) for word in (program, "run", scene, "-o", folder, "-q", "--threads", 1, *sets)]


def certificate(program, folder):
    """A hash of all that a run has computed."""
    line = next(line for line in skein(program, "verify", folder).splitlines() if line.startswith("certificate"))
    return line.split()[-1]


def kill_and_resume(program, scene, folder):
    """A run that is killed as soon as it has made checkpoints, and resumed with another number of threads."""
    process = subprocess.Popen(run_command(program, scene, folder))
    while process.poll() is None and len(list(folder.glob("checkpoints/*.checkpoint"))) < 2:
        time.sleep(0.001)
    if process.poll() is None:
        process.send_signal(signal.SIGKILL)
    process.wait()
    if process.returncode != 0:
        skein(program, "resume", folder, "-q", "--threads", 2)


def near(found, known, what):
    check(abs(found / known - 1.0) < TOLERANCE, f"{what} {found}, the tube's is {known}")


def main():
    program, scene, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    whole, killed = folder / "whole", folder / "killed"
    subprocess.run(run_command(program, scene, whole), check=True)
    kill_and_resume(program, scene, killed)
    check(certificate(program, whole) == certificate(program, killed), "a killed run goes on otherwise")

    fiber = json.loads(skein(program, "analyze", whole, "--json"))["fibers"][0]
    near(fiber["half_periods"][0], HALF_PERIOD, "the half period is")
    near(fiber["hook_radius"], HOOK_RADIUS, "the radius of hooks is")
    near(fiber["snaking_speed"], SNAKING_SPEED, "the snaking speed is")

    with h5py.File(whole / "trajectory.h5") as file:
        position = file["/particles/fibers/position/value"][()]
        check(position.shape[1:] == (N_NODES, 3), f"positions of shape {position.shape}")
        length = file["/parameters/fiber_length"][0]
        check(abs(length - LENGTH) < 1e-6, f"the chain's length is {length}")
        check(file["/parameters/fiber_radius"][0] == RADIUS, "the chain has another radius than the tube")
        check(file["/connectivity/surface"].shape == (N_NODES - 1, 4), "links are not what is drawn")

    skein(program, "field", whole, "--time", 9, "-o", folder / "field.vti")
    check("a chain of 52 nodes" in skein(program, "validate", whole / "scene.toml"), "the run's scene is no chain")
    skein(program, "plot", whole)
    check((whole / "plots" / "shapes.png").is_file(), "no picture of shapes")
    print(f"check_chain: half period {fiber['half_periods'][0]:.4g}, hooks of radius {fiber['hook_radius']:.4g}, "
          f"snaking at {fiber['snaking_speed']:.4g}")


if __name__ == "__main__":
    main()
