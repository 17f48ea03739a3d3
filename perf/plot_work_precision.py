"""Evaluations and processor time against error on three shear orbits, every method: runs what is missing, then draws.

    /usr/bin/python3 perf/plot_work_precision.py build/openmp/bin/work_precision [folder] [nodes per section]
        [full] [orbits=0.139,0.196,0.523]

Two runs at a time, a thread each. Results stay in the folder, one line and one file of positions for each run: a call
that was broken off goes on where it was, a second call only draws. `auto` takes no run of its own, only a look at what it
chooses. Explicit methods are bound by stability: they run on the shortest orbit only, `full` takes them on all three.
The reference is RKC2 at a hundredth of the smallest tolerance (a tenth with 12 nodes on a section or more); the error is
the largest distance of a node from it at any sample. The table also sets the sum of the controller's estimates against
the true error, both as root mean squares over nodes: against the largest of all samples, and against that at the end,
where the flow may have taken most of it back.
"""

import concurrent.futures
import os
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


def call(program, *arguments):
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}
    result = subprocess.run([program, *arguments], capture_output=True, text=True, check=False, env=environment)
    if result.returncode < 0:
        sys.exit(f"{' '.join(arguments)} was killed")
    return result.stdout


def run(program, folder, length, end, nodes, method, tolerance):
    stem = folder / f"L{length}-n{nodes}-{method}-{tolerance}"
    line = stem.with_suffix(stem.suffix + ".txt")
    positions = stem.with_suffix(stem.suffix + ".bin")
    if not line.exists():
        line.write_text(call(program, f"method={method}", f"tolerance={tolerance}", f"length={length}", f"end={end}",
                             f"nodes={nodes}", "max_step=0.5", f"output={positions}"))
    fields = dict(word.split("=", 1) for word in line.read_text().splitlines()[-1].split() if "=" in word)
    count = int(fields["nodes"]) * int(fields["sections"])
    return fields, np.fromfile(positions).reshape(-1, count, 3)


def chosen(program, folder, length, nodes, tolerance):
    """The method that auto takes: a look costs some ten evaluations."""
    note = folder / f"L{length}-n{nodes}-auto-{tolerance}.txt"
    if not note.exists():
        note.write_text(call(program, "method=auto", f"tolerance={tolerance}", f"length={length}", "end=1e-9",
                             f"nodes={nodes}", "max_step=0.5"))
    return dict(word.split("=", 1) for word in note.read_text().split() if "=" in word)["integrator"]


def main():
    full = "full" in sys.argv
    asked = [word.split("=")[1].split(",") for word in sys.argv[1:] if word.startswith("orbits=")]
    orbits = {title: orbit for title, orbit in ORBITS.items() if not asked or str(orbit[0]) in asked[0]}
    words = [word for word in sys.argv[1:] if word != "full" and not word.startswith("orbits=")]
    program = words[0]
    folder = pathlib.Path(words[1] if len(words) > 1 else "work_precision")
    nodes = int(words[2]) if len(words) > 2 else 6
    folder.mkdir(parents=True, exist_ok=True)
    exact = "1e-8" if nodes < 12 else "1e-7"

    runs = [(*orbit, nodes, method, tolerance) for orbit in orbits.values() for method in METHODS
            for tolerance in TOLERANCES if full or method in ("rkc2", "trbdf2") or orbit == (0.139, 6.0)]
    runs += [(*orbit, nodes, "rkc2", exact) for orbit in orbits.values()]
    runs.sort(key=lambda one: one[0] / float(one[4]))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for _ in pool.map(lambda one: run(program, folder, *one), runs):
            pass

    figure, axes = plt.subplots(2, len(orbits), figsize=(1 + 4 * len(orbits), 7), sharey="row", squeeze=False,
                                constrained_layout=True)
    print("orbit,method,tolerance,evaluations,seconds,error,error over tolerance,estimates over largest error,"
          "estimates over error at the end,chosen")
    for column, (title, (length, end)) in enumerate(orbits.items()):
        _, reference = run(program, folder, length, end, nodes, "rkc2", exact)
        choice = {t: chosen(program, folder, length, nodes, t) for t in TOLERANCES}
        taken = {"work": [], "seconds": [], "error": []}
        for method in METHODS:
            work, seconds, errors = [], [], []
            for tolerance in TOLERANCES:
                if (length, end, nodes, method, tolerance) not in runs:
                    continue
                fields, positions = run(program, folder, length, end, nodes, method, tolerance)
                if len(positions) < len(reference):
                    print(f"{title},{method},{tolerance},failed", flush=True)
                    continue
                distance = np.linalg.norm(positions - reference, axis=2) / float(fields["length"])
                true = np.sqrt(np.mean(distance ** 2, axis=1))
                error = distance.max()
                work.append(int(fields["evaluations"]))
                seconds.append(float(fields["cpu"]))
                errors.append(error)
                if choice[tolerance] == method:
                    for key, value in zip(taken, (work[-1], seconds[-1], error)):
                        taken[key].append(value)
                print(title.replace(",", ""), method, tolerance, work[-1], seconds[-1], f"{error:.3g}",
                      f"{error / float(tolerance):.3g}", f"{float(fields['reported']) / true.max():.3g}",
                      f"{float(fields['reported']) / true[-1]:.3g}",
                      "auto" if choice[tolerance] == method else "", sep=",", flush=True)
            if work:
                axes[0, column].loglog(errors, work, "o-", color=COLOURS[method], label=method)
                axes[1, column].loglog(errors, seconds, "o-", color=COLOURS[method], label=method)
        for row, key in enumerate(("work", "seconds")):
            axes[row, column].loglog(taken["error"], taken[key], "ko", markersize=11, fillstyle="none", label="auto takes")
        axes[0, column].set_title(f"{title}, {nodes} nodes a section")
        axes[1, column].set_xlabel("largest error / L")
        for axis in axes[:, column]:
            axis.grid(True, which="both", alpha=0.2)
    axes[0, 0].set_ylabel("evaluations")
    axes[1, 0].set_ylabel("processor time, one thread, s")
    axes[0, 0].legend()
    figure.savefig(folder / "work_precision.png", dpi=120)
    print(folder / "work_precision.png")


main()
