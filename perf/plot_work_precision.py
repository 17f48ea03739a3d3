"""Evaluations and wall time against error on three shear orbits, every method: runs what is missing, then draws.

    /usr/bin/python3 perf/plot_work_precision.py build/openmp/bin/work_precision [folder] [nodes per section]

Results stay in the folder, one line and one file of positions for each run: a second call only draws. The reference is
RKC2 at a hundredth of the smallest tolerance; the error is the largest distance of a node from it at any sample.
"""

import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

ORBITS = {"L = 0.139, t = 6": (0.139, 6.0), "L = 0.196, t = 8": (0.196, 8.0), "L = 0.523, t = 10": (0.523, 10.0)}
TOLERANCES = ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6")
METHODS = ("rkc2", "trbdf2", "bs3", "rk4")
COLOURS = {"rkc2": "tab:blue", "trbdf2": "tab:orange", "bs3": "tab:green", "rk4": "tab:red"}


def run(program, folder, length, end, nodes, method, tolerance):
    stem = folder / f"L{length}-n{nodes}-{method}-{tolerance}"
    line = stem.with_suffix(stem.suffix + ".txt")
    positions = stem.with_suffix(stem.suffix + ".bin")
    if not line.exists():
        command = [program, f"method={method}", f"tolerance={tolerance}", f"length={length}", f"end={end}",
                   f"nodes={nodes}", "max_step=0.5", f"output={positions}"]
        line.write_text(subprocess.run(command, capture_output=True, text=True, check=False).stdout)
    fields = dict(word.split("=", 1) for word in line.read_text().splitlines()[-1].split() if "=" in word)
    count = int(fields["nodes"]) * int(fields["sections"])
    return fields, np.fromfile(positions).reshape(-1, count, 3)


def main():
    program = sys.argv[1]
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "work_precision")
    nodes = int(sys.argv[3]) if len(sys.argv) > 3 else 6
    folder.mkdir(parents=True, exist_ok=True)
    figure, axes = plt.subplots(2, len(ORBITS), figsize=(13, 7), sharey="row", constrained_layout=True)
    for column, (title, (length, end)) in enumerate(ORBITS.items()):
        _, reference = run(program, folder, length, end, nodes, "rkc2", "1e-8" if nodes < 12 else "1e-7")
        for method in METHODS:
            work, seconds, errors = [], [], []
            for tolerance in TOLERANCES:
                fields, positions = run(program, folder, length, end, nodes, method, tolerance)
                if len(positions) < len(reference):
                    continue  # the run failed
                distance = np.linalg.norm(positions - reference, axis=2).max() / float(fields["length"])
                work.append(int(fields["evaluations"]))
                seconds.append(float(fields["seconds"]))
                errors.append(distance)
                print(title, method, tolerance, fields["evaluations"], fields["seconds"], f"{distance:.3g}",
                      f"{distance / float(tolerance):.3g}", sep=",", flush=True)
            axes[0, column].loglog(errors, work, "o-", color=COLOURS[method], label=method)
            axes[1, column].loglog(errors, seconds, "o-", color=COLOURS[method], label=method)
        axes[0, column].set_title(f"{title}, {nodes} nodes a section")
        for axis in axes[:, column]:
            axis.grid(True, which="both", alpha=0.2)
            axis.set_xlabel("largest error / L")
    axes[0, 0].set_ylabel("evaluations")
    axes[1, 0].set_ylabel("wall time, s")
    axes[0, 0].legend()
    figure.savefig(folder / "work_precision.png", dpi=120)
    print(folder / "work_precision.png")


main()
