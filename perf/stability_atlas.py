"""The largest stable step of each method, by bisection, over spring stiffness, blob, nodes and sections; as CSV and picture.

    /usr/bin/python3 perf/stability_atlas.py build/openmp/bin/work_precision [folder] [full]

One parameter at a time is moved away from the middle: 6 nodes on a section, 28 sections (L = 0.139) and the paper's
bending stiffness; `full` takes 18 nodes and 80 sections. A step is stable when a run of 400 steps, or to t = 0.5 where
that takes longer, ends without a fault, its nodes in the last step no faster than the shear rate times the length: a mode
that grows by 5 % a step is 3e8 times larger then, and sections may also oscillate from step to step for ever. Steps above 0.5 are not
tried: RKC2 adds stages, so that it is stable wherever its error is tolerable. Every point is kept in the folder.
"""

import csv
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

MARKERS = {"sections ovalize": "o", "sections ovalize without bursting": "o", "Newton's method stalls": "s",
           "GMRES stalls": "X", "none up to the largest step tried": "^"}
WORDS = {"o": "sections ovalize", "s": "Newton's method stalls", "X": "GMRES stalls", "^": "stable as far as tried"}
METHODS = ("euler", "bs3", "rk4", "rkc2", "trbdf2")
LARGEST = 0.5


def parameters(full):
    nodes, sections = (18, 80) if full else (6, 28)
    middle = {"stiffness": 1.0, "blob": 1.0, "nodes": nodes, "sections": sections}
    rows = {"stiffness": (0.01, 0.1, 1.0, 10.0, 100.0), "blob": (0.5, 0.7, 1.0, 1.4, 2.0), "nodes": (6, 9, 12, 18, 24),
            "sections": (20, 40, 80, 160)}
    return middle, rows


def way_of(text):
    """What a failed run died of, in few words."""
    if "Newton" in text:
        return "Newton's method stalls"
    if "GMRES" in text:
        return "GMRES stalls"
    if "farther than" in text or "not finite" in text:
        return "sections ovalize"
    return "other"


def attempt(program, method, point, step):
    end = max(400.0 * step, 0.5) if method in ("rkc2", "trbdf2") else 400.0 * step
    command = [program, f"method={method}", f"step={step:.6g}", f"max_step={max(step, 0.1)}", f"end={min(end, 5.0):.6g}",
               "tolerance=1e-4", "sample=1e9", *(f"{key}={value}" for key, value in point.items())]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode == 0 and float(result.stdout.split("speed=")[1]) > 1.0:
        return False, "sections ovalize without bursting"
    return result.returncode == 0, way_of(result.stdout)


def bisect(program, method, point):
    low, high, way = None, LARGEST, "none up to the largest step tried"
    stable, found = attempt(program, method, point, LARGEST)
    if stable:
        return LARGEST, way
    way, low = found, LARGEST
    while True:
        low /= 4.0
        stable, found = attempt(program, method, point, low)
        if stable:
            break
        way, high = found, low
        if low < 1e-9:
            return 0.0, way
    while high / low > 1.01:
        middle = (low * high) ** 0.5
        stable, found = attempt(program, method, point, middle)
        low, high, way = (middle, high, way) if stable else (low, middle, found)
    return low, way


def main():
    program = sys.argv[1]
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "stability_atlas")
    folder.mkdir(parents=True, exist_ok=True)
    middle, rows = parameters("full" in sys.argv[3:])
    known_file = folder / "points.json"
    known = json.loads(known_file.read_text()) if known_file.exists() else {}
    figure, axes = plt.subplots(1, len(rows), figsize=(15, 4.5), sharey=True, constrained_layout=True)
    with open(folder / "stability_atlas.csv", "w", newline="", encoding="ascii") as table:
        writer = csv.writer(table)
        writer.writerow(["method", "varied", "value", *middle, "largest_stable_step", "way_it_fails"])
        for axis, (name, values) in zip(axes, rows.items()):
            for method in METHODS:
                steps, ways = [], []
                for value in values:
                    point = {**middle, name: value}
                    key = json.dumps([method, point])
                    if key not in known:
                        known[key] = bisect(program, method, point)
                        known_file.write_text(json.dumps(known, indent=0))
                        print(method, point, *known[key], flush=True)
                    step, way = known[key]
                    steps.append(step)
                    ways.append(way)
                    writer.writerow([method, name, value, *point.values(), f"{step:.4g}", way])
                (line,) = axis.loglog(values, steps, "-", label=method)
                for value, step, way in zip(values, steps, ways):
                    axis.plot(value, step, MARKERS.get(way, "D"), color=line.get_color(), markersize=7)
            axis.set_xticks(values, [f"{value:g}" for value in values])
            axis.minorticks_off()
            axis.set_xlabel({"stiffness": "k over the paper's", "blob": "blob over the paper's",
                             "nodes": "nodes on a section", "sections": "sections"}[name])
            axis.grid(True, which="both", alpha=0.2)
    axes[0].set_ylabel(f"largest stable step (at most {LARGEST} is tried)")
    axes[0].legend()
    seen = {MARKERS[way]: WORDS[MARKERS[way]] for _, way in known.values() if way in MARKERS}
    axes[-1].legend(handles=[Line2D([], [], color="0.4", marker=marker, linestyle="", label=words)
                             for marker, words in seen.items()], loc="lower left", title="beyond it")
    figure.savefig(folder / "stability_atlas.png", dpi=120)
    print(folder / "stability_atlas.png")


main()
