"""Two fibers pressed together: what keeps them apart counts in gaps, energies, powers and particle stress.

Usage: check_repulsion.py SKEIN SCENE FOLDER
In a linear strain the work of the flow is the particle stress times the strain rate, which ties the columns together."""

import json
import pathlib
import sys

import h5py
import numpy as np

from checks import check, run_command, skein

OVERRIDES = [f"fiber[{i}].{key}" for i in (0, 1) for key in ("sections=20", "nodes_per_section=9")] + ["time.end=1.2"]
OVERRIDES += ["output.frame_interval=0.01"]
RATE, RADIUS = 2.5, 0.005


def run_and_analyze(program, scene, folder, *overrides):
    """The summary, and a dictionary of [n_fibers, n_frames] columns."""
    skein(*run_command(program, scene, folder, [*OVERRIDES, *overrides]), "-q")
    summary = json.loads(skein(program, "analyze", folder, "--json").stdout)
    with h5py.File(folder / "analysis" / "diagnostics.h5") as file:
        names = ["energy", "background_power", "dissipation", "stresslet_xx", "stresslet_yy"]
        columns = {name: np.array([file[f"fiber_{i}/{name}"][()] for i in (0, 1)]) for name in names}
    return summary, columns


def main():
    program, scene, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    summary, columns = run_and_analyze(program, scene, folder / "repelled")
    without, _ = run_and_analyze(program, scene, folder / "others", "repulsion.strength=0")
    gap, gap_without = summary["smallest_gap"], without["smallest_gap"]
    check(0.3 * RADIUS < gap < 0.7 * RADIUS, f"the gap is {gap}, not about half of the range")
    check(gap_without < 0.6 * gap, f"{gap_without} without the repulsion, {gap} with it")

    for fiber in summary["fibers"]:
        check(fiber["energy_defect"] < 1e-3, f"the power balance closes to {fiber['energy_defect']} only")
    power = columns["background_power"].sum(axis=0)
    stress = RATE * (columns["stresslet_yy"] - columns["stresslet_xx"]).sum(axis=0)
    error = np.abs(power - stress)[1:].max() / np.abs(power).max()
    check(error < 1e-10, f"the flow's work is not particle stress times strain rate, by {error}")

    with h5py.File(folder / "repelled" / "trajectory.h5") as run:
        last = run["/observables/energy/value"][-1]
    check(np.allclose(columns["energy"][:, -1], last, rtol=1e-9), "energies differ from the run's")
    said = skein(program, "validate", scene).stdout
    check("repulsion: of strength 2.5 where gaps are below 0.005" in said, said)
    print(f"check_repulsion: gaps {gap:.2g} and {gap_without:.2g}, stress and power agree to {error:.1e}")


if __name__ == "__main__":
    main()
