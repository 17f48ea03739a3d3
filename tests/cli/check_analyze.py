"""`skein analyze` on an S-turn made here, of six nodes a section with the paper's bending rigidity.

Usage: check_analyze.py SKEIN SCENE FOLDER
Its numbers are compared with NumPy's, taken from the saved centreline: another language and other formulas."""

import csv
import json
import pathlib
import sys

import h5py
import numpy as np

from checks import check, run_command, skein

OVERRIDES = ["fiber.nodes_per_section=6", "fiber.sections=39", "fiber.spring_stiffness=0.0409", "time.end=8.5",
             "output.frame_interval=0.02"]


def read_table(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name.split(" [")[0]: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def turning_by_tangents(line):
    """[n_sections - 2] angles between successive segments, counter-clockwise."""
    heading = np.unwrap(np.arctan2(np.diff(line[:, 1]), np.diff(line[:, 0])))
    return np.diff(heading)


def main():
    program, scene, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    skein(*run_command(program, scene, folder, OVERRIDES), "-q")
    summary = json.loads(skein(program, "analyze", folder, "--json").stdout)
    fiber = summary["fibers"][0]
    check(fiber["regime"] == "S", f"an S-turn is called {fiber['regime']}")
    check([c["regime"] for c in fiber["changes"]] == ["tumble", "S", "tumble"], f"changes {fiber['changes']}")
    check(fiber["wave"] == "standing", f"its waves are {fiber['wave']}")
    check(fiber["hook_radius"] is None, "an S-turn has no hooks")
    check(summary["nodes_inside"] == summary["crossings"] == 0 and summary["depth"] == 0.0, f"contact in {summary}")
    check(fiber["energy_defect"] < 2e-3, f"the power balance closes to {fiber['energy_defect']} only")

    with h5py.File(folder / "trajectory.h5") as run:
        times = run["/observables/centreline/time"][()]
        lines = run["/observables/centreline/value"][()]
        step_times, energy = run["/observables/energy/time"][()], run["/observables/energy/value"][:, 0]
        defect = run["/observables/symmetry_defect/value"][-1, 0]
    table = read_table(folder / "analysis" / "diagnostics.csv")
    check(np.array_equal(table["time"], times), "the table's times are not the frames'")
    check(len(times) == 426 == summary["frames"], "frames are missing")
    ends = lines[:, -1] - lines[:, 0]
    angle = np.degrees(np.unwrap(-np.arctan2(ends[:, 1], ends[:, 0])))
    check(np.allclose(table["angle"], angle, atol=1e-9), "the angle is not that of the ends")
    check(np.allclose(table["distance"], np.linalg.norm(ends, axis=1), rtol=1e-12), "the distance is not that of the ends")
    check(fiber["angle_from"] == "direction of the flow", f"angles count from the {fiber['angle_from']}")
    height = np.abs(lines[:, :, 2] - lines[:, :, 2].mean(axis=1, keepdims=True)).max(axis=1)
    check(np.allclose(table["out_of_flow_plane"], height, atol=1e-15), "the flow's plane is not that of z")
    check((table["out_of_plane"] <= 1.01 * height + 1e-15).all(), "the fiber's own plane is not its best")
    length = np.linalg.norm(np.diff(lines, axis=1), axis=2).sum(axis=1)
    check(np.allclose(table["centreline_length"], length, rtol=1e-12), "the centreline's length")
    upright = np.interp(90.0, angle, times)
    check(abs(fiber["passages"][0]["time"] - upright) < 1e-6, f"upright at {fiber['passages'][0]}, not {upright}")
    on_steps = np.interp(times[1:], step_times, energy)
    check(np.allclose(table["energy"][1:], on_steps, rtol=0.02, atol=1e-3 * energy.max()), "energies differ from the run's")
    check(abs(table["symmetry_defect"][-1] - defect) < 1e-12 + 1e-6 * defect, "symmetry defect differs from the run's")
    folded = int(np.argmax(table["total_turning"]))
    turning = np.degrees(np.abs(turning_by_tangents(lines[folded])).sum())
    check(abs(table["total_turning"][folded] / turning - 1.0) < 0.1, f"total turning {table['total_turning'][folded]}, not {turning}")
    balance = table["background_power"] - table["dissipation"] - table["elastic_power"]
    check(np.abs(balance).max() < 1e-12 * np.abs(table["dissipation"]).max(), "powers do not add up")
    check((table["dissipation"] >= 0.0).all(), "the fluid gives energy")
    # Shear 2.5: S:E / (2 mu E:E) = S_xy / 2.5, whatever the other components are.
    check(np.allclose(table["viscosity_contribution"], table["stresslet_xy"] / 2.5, rtol=1e-6), "viscosity and particle stress")

    with h5py.File(folder / "analysis" / "diagnostics.h5") as file:
        curvature = file["fiber_0/signed_curvature"][()]
        points, tracks = file["fiber_0/track_points"][()], file["fiber_0/tracks"][()]
    check(curvature.shape == lines.shape[:2], "signed curvature by frame and section")
    spacing = np.linalg.norm(np.diff(lines[folded], axis=0), axis=1)
    expected = turning_by_tangents(lines[folded]) / (0.5 * (spacing[1:] + spacing[:-1]))
    check(np.allclose(curvature[folded, 1:-1], expected, atol=0.1 * np.abs(expected).max()), "signed curvature")
    check(len(tracks) == 2 and set(points[:, 0]) == {0.0, 1.0}, f"{len(tracks)} tracks")

    events = [json.loads(line) for line in (folder / "events.jsonl").read_text().splitlines()]
    regimes = [(e["regime"], e["time"]) for e in events if e["event"] == "regime"]
    check([r for r, _ in regimes] == ["S", "tumble"], f"events while running: {regimes}")
    check(regimes[0][1] == fiber["changes"][1]["time"], "the event's time is not that of the analysis")

    elsewhere = folder / "elsewhere"
    shapes = skein(program, "analyze", folder, "--no-forces", "-o", elsewhere).stdout
    check("regime S" in shapes and "energy" not in shapes, shapes)
    check("no node inside of another surface; no centreline passed through another" in shapes, shapes)
    check("energy" not in read_table(elsewhere / "diagnostics.csv"), "forces were not asked for")
    skein(program, "analyze", folder / "nothing", codes=(66,))
    print(f"check_analyze: {len(times)} frames, power balance {fiber['energy_defect']:.1e}")


if __name__ == "__main__":
    main()
