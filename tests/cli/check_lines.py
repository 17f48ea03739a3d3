"""A scene whose fiber is a chain or rigid moves like its tube, and all verbs serve: check_lines.py SKEIN CONFIGS FOLDER

The tubes' own figures stand below."""

import csv
import json
import pathlib
import sys

import h5py
import numpy as np

from checks import certificate, check, kill_and_resume, run_command, skein


class Line:
    """What a model is asked of, and what its tube says, by `skein analyze` of the scene's run."""

    def __init__(self, model, scene, end, length, n_nodes, tolerance, **known):
        self.scene, self.length, self.n_nodes, self.tolerance, self.known = scene, length, n_nodes, tolerance, known
        self.model = model
        self.overrides = [f'fiber.model="{model}"', f"time.end={end}", "output.frame_interval=0.05",
                          "checkpoint.simulated_interval=1"]


LINES = [
    Line("chain", "lagrone2019_L0523.toml", 26, 0.522681, 52, 0.1, half_periods=24.56, hook_radius=0.0188,
         snaking_speed=0.0311),
    Line("rigid", "lagrone2019_L0139.toml", 12, 0.138919, 14, 0.03, half_periods=10.89),
]
RADIUS = 0.005


def check_line(program, line, scene, folder):
    whole, killed = folder / "whole", folder / "killed"
    skein(*run_command(program, scene, whole, line.overrides), "-q")
    kill_and_resume(run_command(program, scene, killed, line.overrides), killed)
    check(certificate(program, whole) == certificate(program, killed), "a killed run goes on otherwise")

    fiber = json.loads(skein(program, "analyze", whole, "--json").stdout)["fibers"][0]
    for name, known in line.known.items():
        found = fiber[name][0] if isinstance(fiber[name], list) else fiber[name]
        check(abs(found / known - 1.0) < line.tolerance, f"{name} of the {line.model}: {found}, the tube's: {known}")

    with h5py.File(whole / "trajectory.h5") as file:
        position = file["/particles/fibers/position/value"][()]
        check(position.shape[1:] == (line.n_nodes, 3), f"positions of shape {position.shape}")
        length = file["/parameters/fiber_length"][0]
        check(abs(length - line.length) < 1e-6, f"the fiber's length is {length}")
        check(file["/parameters/fiber_radius"][0] == RADIUS, "the fiber has another radius than the tube")
        check(file["/connectivity/surface"].shape == (line.n_nodes - 1, 4), "links are not what is drawn")
    if line.model == "rigid":
        check_rigid(position, whole)

    skein(program, "field", whole, "--time", 9, "-o", folder / "field.vti")
    said = skein(program, "validate", whole / "scene.toml").stdout
    check(f"{line.model}" in said and f"of {line.n_nodes} nodes" in said, f"the run's scene is another: {said}")
    check(("above 306.4 bends grow" in said) == (line.model == "rigid"), f"what bends is not told: {said}")
    skein(program, "info", whole)
    skein(program, "plot", whole)
    check((whole / "plots" / "shapes.png").is_file(), "no picture of shapes")
    print(f"check_lines: {line.model}: " + ", ".join(f"{name} {fiber[name]}" for name in line.known))


def check_rigid(position, run):
    """Frames between steps are those of a rigid body, too; what drags on it, drags on the fluid at every moment."""
    arms = position[:, -1] - position[:, 0]
    shares = np.linspace(0.0, 1.0, position.shape[1])
    bent = position - position[:, :1] - shares[None, :, None] * arms[:, None, :]
    check(np.abs(bent).max() < 1e-14, f"a rigid fiber is bent by {np.abs(bent).max()}")
    lengths = np.linalg.norm(arms, axis=1)
    check(np.ptp(lengths) < 1e-14, "a rigid fiber changes its length")
    with open(run / "analysis" / "diagnostics.csv") as table:
        rows = list(csv.DictReader(table))
    check(min(float(row["viscosity_contribution [length^3]"]) for row in rows) > 0.0, "a fiber makes the fluid thinner")
    check({float(row["energy [force*length]"]) for row in rows} == {0.0}, "a rigid fiber stores energy")


def check_threads(program, configs, folder):
    """Many rigid fibers, whose forces are found by iterations: the same bits with one thread and with two."""
    certificates = []
    for threads in (1, 2):
        run = folder / f"threads_{threads}"
        overrides = ['fiber.model="rigid"', "placement.count=12", "time.end=0.2"]
        scene = configs / "random_suspension.toml"
        skein(*run_command(program, scene, run, overrides, threads), "-q")
        certificates.append(certificate(program, run))
    check(certificates[0] == certificates[1], "another number of threads computes otherwise")


def main():
    program, configs, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    for line in LINES:
        check_line(program, line, configs / line.scene, folder / line.model)
    check_threads(program, configs, folder)


if __name__ == "__main__":
    main()
